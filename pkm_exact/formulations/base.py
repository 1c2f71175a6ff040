"""What a formulation of the forward kinematics problem is: unknowns, equations, and the way back to poses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz_mpoly

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring, primitive
from pkm_exact.geometry.problem import ForwardProblem

Expression = fmpq_mpoly
"""A polynomial over Q in the unknowns of a formulation."""


@dataclass(frozen=True)
class PoseMap:
    """Polynomials in a formulation's unknowns that give the pose of a solution.

    Attributes
    ----------
    quaternion_products : 4 x 4 tuple of fmpq_mpoly
        On every solution, e_k e_l times one common non-zero factor (see ``geometry.rotation``).
    position : tuple of 3 fmpq_mpoly
        Rational coordinates of the mobile frame's origin C.
    """

    quaternion_products: tuple[tuple[Expression, ...], ...]
    position: tuple[Expression, ...]


@dataclass(frozen=True)
class FormulatedProblem:
    """A forward kinematics problem written as a polynomial system.

    Attributes
    ----------
    code : str
        Code of the formulation.
    system : PolynomialSystem
        The formulation's own equations: primitive polynomials over Z.
    pose_map : PoseMap
        In the unknowns of the first branch.
    fibre : int
        Number of solutions of the first branch over each pose, conditions met (2 for quaternions: q and -q).
    branches : tuple of PolynomialSystem
        Systems whose solutions together are those of ``system`` that are finite poses or mirror images: the system
        itself, or localised, or split by chirality. The first holds every pose, the others none.
    conditions : tuple of fmpq_mpoly
        Polynomials in the unknowns of the first branch that vanish at the poses but not at its other solutions.
    mirrors : tuple of ForwardProblem
        Robots with mirrored joints whose poses are the solutions that are no poses of the given robot: those of the
        other branches, or those that do not meet the conditions.
    multiplicity : int
        How often ``system`` counts each solution of the branches: 2 for every joint that is its own mirror image.
    is_chart : bool
        Whether some poses may have no finite coordinates here (half turns, gimbal lock).
    """

    code: str
    system: PolynomialSystem
    pose_map: PoseMap
    fibre: int
    branches: tuple[PolynomialSystem, ...]
    conditions: tuple[Expression, ...] = ()
    mirrors: tuple[ForwardProblem, ...] = ()
    multiplicity: int = 1
    is_chart: bool = False


def rational_ring(unknowns: Sequence[str]) -> tuple[fmpq_mpoly_ctx, tuple[Expression, ...]]:
    """The ring Q[unknowns] and its generators."""
    context = fmpq_mpoly_ctx.get(tuple(unknowns), Ordering.degrevlex)
    return context, context.gens()


def rational(value: Fraction | int) -> fmpq:
    """A FLINT rational from an exact Python number."""
    return fmpq(value.numerator, value.denominator)


def over_integers(unknowns: Sequence[str], polynomials: Sequence[Expression]) -> PolynomialSystem:
    """The system of the primitive integer multiples of the given polynomials, zero polynomials left out."""
    multiples = (integer_multiple(unknowns, polynomial)[0] for polynomial in polynomials)
    return PolynomialSystem(tuple(unknowns), tuple(primitive(multiple) for multiple in multiples if multiple))


def integer_multiple(unknowns: Sequence[str], polynomial: Expression) -> tuple[fmpz_mpoly, int]:
    """The polynomial times the least common denominator of its coefficients, and that denominator."""
    terms = polynomial.to_dict()
    denominator = lcm(*(int(value.q) for value in terms.values())) if terms else 1
    context = polynomial_ring(unknowns)
    return context.from_dict({exponents: (value * denominator).p for exponents, value in terms.items()}), denominator


def dot(metric: Sequence[fmpq], left: Sequence[Any], right: Sequence[Any]) -> Any:
    """Scalar product with Gram diagonal ``metric``, of vectors of rationals or polynomials."""
    return sum((g * (a * b) for g, a, b in zip(metric, left, right, strict=True)), 0 * (left[0] * right[0]))


def cross(left: Sequence[Any], right: Sequence[Any]) -> list[Any]:
    """Coordinatewise vector product."""
    return [
        left[1] * right[2] - left[2] * right[1],
        left[2] * right[0] - left[0] * right[2],
        left[0] * right[1] - left[1] * right[0],
    ]


def matrix_vector(matrix: Sequence[Sequence[Any]], vector: Sequence[Any]) -> list[Any]:
    """Product of a 3 x 3 matrix and a vector."""
    return [row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2] for row in matrix]

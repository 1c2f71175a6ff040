"""Displacement-based formulations: the unknowns are the position C and the rotation of the platform.

Constraints are linear in |C|^2, R^-1 C, C and R (``constraints.form``). A leg gives |C + R B - A|^2 = l^2, that is
(Rolland 2008, equations (4), (9), (12), (14), with the factor 2 that they lack, and l^2 for l)

    |C|^2 + 2 C.(R B) - 2 A.C - 2 A.(R B) + |A|^2 + |B|^2 - l^2 = 0
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from flint import fmpq, fmpq_mpoly_ctx, fmpz_mat, fmpz_poly

from pkm_exact.constraints.form import Form
from pkm_exact.formulations.acceptance import needs_all_motions
from pkm_exact.formulations.base import (
    Expression,
    FormulatedProblem,
    PoseMap,
    cross,
    dot,
    over_integers,
    rational,
    rational_ring,
)
from pkm_exact.formulations.moved_platform import moved_platform
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import quaternion_norm, quaternion_products, scaled_rotation

POSITION_UNKNOWNS = ("c1", "c2", "c3")
ROTATION_UNKNOWNS = tuple(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))
PLACEMENT_UNKNOWNS = POSITION_UNKNOWNS + ROTATION_UNKNOWNS
QUATERNION_UNKNOWNS = ("q0", "q1", "q2", "q3")


def constraint_equations(
    problem: ForwardProblem, position: Sequence[Expression], rotation: Sequence[Sequence[Expression]]
) -> list[Expression]:
    """The equations of the constraints for a position and a rotation matrix given as polynomials."""
    metric = [rational(g) for g in problem.metric]
    columns = [[rotation[i][j] for i in range(3)] for j in range(3)]
    turned = [dot(metric, column, position) * (1 / g) for column, g in zip(columns, metric, strict=True)]
    entries = [entry for row in rotation for entry in row]
    coordinates = [dot(metric, position, position), *turned, *position, *entries]

    def value(form: Form) -> Expression:
        *weights, constant = map(rational, form)
        total: Expression = 0 * coordinates[0] + constant
        for weight, coordinate in zip(weights, coordinates, strict=True):
            if weight:
                total += weight * coordinate
        return total

    equations = [value(form) for form in problem.forms]
    return equations + [value(q.linear) - rational(q.factor) * value(q.root) ** 2 for q in problem.squares]


def rotation_equations(
    rotation: Sequence[Sequence[Expression]], unit: Expression, metric: Sequence[fmpq]
) -> list[Expression]:
    """Quadrics whose span is the degree-2 part of the ideal of rotations, homogenised by ``unit``.

    R^T G R = h^2 G, R G^-1 R^T = h^2 G^-1 and h cof(R) = G R G^-1 h: 21 equations of rank 20.
    """
    columns = [[rotation[i][j] for i in range(3)] for j in range(3)]
    inverse = [1 / g for g in metric]
    equations = []
    for i in range(3):
        for j in range(i, 3):
            equations.append(dot(metric, columns[i], columns[j]) - (metric[i] * unit**2 if i == j else 0))
            equations.append(dot(inverse, rotation[i], rotation[j]) - (inverse[i] * unit**2 if i == j else 0))
    for j in range(3):
        cofactors = cross(columns[(j + 1) % 3], columns[(j + 2) % 3])
        equations += [cofactors[i] - metric[i] * inverse[j] * (unit * rotation[i][j]) for i in range(3)]
    return equations


def _placement() -> tuple[fmpq_mpoly_ctx, tuple[Expression, ...], list[list[Expression]]]:
    """The ring of C and R, and both in its unknowns."""
    context, generators = rational_ring(PLACEMENT_UNKNOWNS)
    return context, generators[:3], [list(generators[3 + 3 * i : 6 + 3 * i]) for i in range(3)]


@dataclass(frozen=True)
class AFD3:
    """Rotation matrix with its six quadrics.

    Unknowns C and r_ij. Equations: 6 legs and R G^-1 R^T = G^-1. Half of the 80 solutions are reflections, det R = -1;
    the determinant filter drops them. (For a planar platform a reflection moves the joints as a rotation does, but
    it is no pose of the frame.)
    Source: Rolland 2008, section 4.1.3, equations (13) to (20).
    """

    code: str = "AFD3"
    title: str = "position and rotation matrix, orthogonality"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: all motions must be possible, constraints may be any."""
        return needs_all_motions(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns c1..c3, r11..r33."""
        context, position, rotation = _placement()
        metric = [rational(g) for g in problem.metric]
        inverse = [1 / g for g in metric]
        equations = constraint_equations(problem, position, rotation)
        for i in range(3):
            equations += [dot(inverse, rotation[i], rotation[j]) - (inverse[i] if i == j else 0) for j in range(i, 3)]
        system = over_integers(PLACEMENT_UNKNOWNS, equations)
        determinant = sum((a * b for a, b in zip(rotation[0], cross(rotation[1], rotation[2]), strict=True)), -1)
        products = quaternion_products(rotation, context.constant(1), metric)
        pose_map = PoseMap(tuple(map(tuple, products)), tuple(position))
        return FormulatedProblem(
            self.code,
            system,
            pose_map,
            fibre=1,
            branches=(system,),
            conditions=(determinant,),
            mirrors=(reflected(problem),),
        )


def reflected(problem: ForwardProblem) -> ForwardProblem:
    """The robot with mirrored platform joints: R diag(1, 1, -1) is a rotation if det R = -1."""
    one, zero = Fraction(1), Fraction(0)
    mirror = ((one, zero, zero), (zero, one, zero), (zero, zero, -one))
    return moved_platform(problem, mirror)


@dataclass(frozen=True)
class AFD4:
    """Rotation matrix with a Groebner basis of SO(3).

    Unknowns C and r_ij. Equations: 6 legs and the 20 quadrics of the reduced degree reverse lexicographic Groebner
    basis of {R R^T = I, R^T R = I, R = cof R}; they do not depend on the robot. 40 solutions, one for each pose.
    Source: Rolland 2008, section 4.1.4 (which counts 24 equations; the reduced basis has 20).
    """

    code: str = "AFD4"
    title: str = "position and rotation matrix, Groebner basis of SO(3)"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: all motions must be possible, constraints may be any."""
        return needs_all_motions(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns c1..c3, r11..r33."""
        context, position, rotation = _placement()
        metric = [rational(g) for g in problem.metric]
        unit = context.constant(1)
        equations = constraint_equations(problem, position, rotation)
        equations += reduced(rotation_equations(rotation, unit, metric))
        products = quaternion_products(rotation, unit, metric)
        pose_map = PoseMap(tuple(map(tuple, products)), tuple(position))
        system = over_integers(PLACEMENT_UNKNOWNS, equations)
        return FormulatedProblem(self.code, system, pose_map, fibre=1, branches=(system,))


@dataclass(frozen=True)
class AFD5:
    """Unit quaternions.

    Unknowns C and q_0..q_3. Equations: 6 legs with R(q) and N(q) = 1. Each pose is met twice, as q and -q: 80
    solutions.
    Source: Rolland 2008, section 4.1.5.
    """

    code: str = "AFD5"
    title: str = "position and unit quaternion"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: all motions must be possible, constraints may be any."""
        return needs_all_motions(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns c1..c3, q0..q3."""
        unknowns = POSITION_UNKNOWNS + QUATERNION_UNKNOWNS
        _, generators = rational_ring(unknowns)
        position, quaternion = generators[:3], generators[3:]
        metric = [rational(g) for g in problem.metric]
        products = [[left * right for right in quaternion] for left in quaternion]
        equations = constraint_equations(problem, position, scaled_rotation(products, metric))
        equations.append(quaternion_norm(products, metric) - 1)
        pose_map = PoseMap(tuple(map(tuple, products)), tuple(position))
        system = over_integers(unknowns, equations)
        return FormulatedProblem(self.code, system, pose_map, fibre=2, branches=(system,))


def reduced(polynomials: Sequence[Expression]) -> list[Expression]:
    """Reduced row echelon form of polynomials with respect to their monomials: a basis of their span.

    Each has coprime integer coefficients, the leading one positive.
    """
    context = polynomials[0].context()
    terms = [polynomial.to_dict() for polynomial in polynomials]
    columns = sorted(
        {exponents for row in terms for exponents in row},
        key=lambda exponents: (sum(exponents), [-value for value in reversed(exponents)]),
        reverse=True,
    )
    rows = []
    for row in terms:
        denominator = lcm(*(int(value.q) for value in row.values()))
        rows.append([(row[column] * denominator).p if column in row else 0 for column in columns])
    echelon, _, rank = fmpz_mat(rows).rref()
    basis = []
    for values in echelon.table()[:rank]:
        content = fmpz_poly(values).content()
        if next(value for value in values if value) < 0:
            content = -content
        basis.append(
            context.from_dict(
                {column: fmpq(value // content) for column, value in zip(columns, values, strict=True) if value}
            )
        )
    return basis

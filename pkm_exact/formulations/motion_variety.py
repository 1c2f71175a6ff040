"""The formulation on the projective variety of rigid motions, where constraints are linear.

In the 17 homogeneous coordinates (h : R : C : u : s), u = R^T C and s = |C|^2, rigid motions form a variety X of
dimension 6 and degree 40 in P^16, cut out by 37 quadrics (Gallet, Nawratil and Schicho, "Bond theory for pentapods and
hexapods", J. Geometry 106, 2015). A leg is a hyperplane:

    (|A|^2 + |B|^2 - l^2) h + s - 2 A.C + 2 B.u - 2 A^T R B = 0
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq, fmpq_mat

from pkm_exact.formulations.base import (
    Expression,
    FormulatedProblem,
    PoseMap,
    cross,
    dot,
    matrix_vector,
    over_integers,
    rational,
    rational_ring,
)
from pkm_exact.formulations.displacement import reduced, rotation_equations
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import quaternion_products

# Solved for from left to right: the translation first, so that R and s remain where the robot allows it.
MOTION_COORDINATES = ("u1", "u2", "u3", "c1", "c2", "c3", "s", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)))


def hyperplane(form: Sequence[Fraction | int]) -> list[fmpq]:
    """Coefficients of a linear form on rigid motions on ``MOTION_COORDINATES`` and, last, on h.

    Examples
    --------
    >>> hyperplane(range(17))[5:8]
    [6, 0, 7]
    """
    square, *others = map(rational, form)
    return [*others[:6], square, *others[6:]]


def motion_quadrics(coordinates: Sequence[Expression], unit: Expression, metric: Sequence[fmpq]) -> list[Expression]:
    """The quadrics of X at coordinates in the order of ``MOTION_COORDINATES``; 38 of rank 37.

    With a Gram matrix G: G u h = R^T G C, C.C = u.u = s h, and C x (R e_j) = G R G^-1 (u x e_j).
    """
    turned, position, square = coordinates[0:3], coordinates[3:6], coordinates[6]
    rotation = [coordinates[7 + 3 * i : 10 + 3 * i] for i in range(3)]
    columns = [[rotation[i][j] for i in range(3)] for j in range(3)]
    equations = rotation_equations(rotation, unit, metric)
    equations += [value - unit * c for value, c in zip(matrix_vector(rotation, turned), position, strict=True)]
    equations += [dot(metric, columns[j], position) - metric[j] * (unit * turned[j]) for j in range(3)]
    equations += [dot(metric, vector, vector) - square * unit for vector in (position, turned)]
    for j in range(3):
        axis = [fmpq(int(i == j)) for i in range(3)]
        right = [value * (1 / g) for value, g in zip(cross(turned, axis), metric, strict=True)]
        image = [g * value for value, g in zip(matrix_vector(rotation, right), metric, strict=True)]
        equations += [a - b for a, b in zip(cross(position, columns[j]), image, strict=True)]
    return equations


def _cylinders(problem: ForwardProblem, coordinates: Sequence[Expression], unit: Expression) -> list[Expression]:
    """The quadrics linear h - factor root^2 of cylinders, on the section."""

    def value(form: Sequence[Fraction]) -> Expression:
        *weights, constant = hyperplane(form)
        total = constant * unit
        for weight, coordinate in zip(weights, coordinates, strict=True):
            total += weight * coordinate
        return total

    return [value(q.linear) - rational(q.factor) * value(q.root) ** 2 for q in problem.squares]


@dataclass(frozen=True)
class SE3:
    """The motion variety cut by hyperplanes: for six of them 37 quadrics in 10 unknowns.

    All linear forms that vanish, those of the constraints and those of a smaller group of motions, are solved for as
    many of the sixteen affine coordinates (which ones depends on the robot; a planar one cannot give C and u), and the
    solution is substituted into the quadrics of X, joined by those of cylinders. 40 solutions on a general hexapod, one
    for each pose, and every intermediate degree is as on X: no degree falls.
    """

    code: str = "SE3"
    title: str = "linear section of the variety of rigid motions"

    def refusal(self, problem: ForwardProblem) -> str | None:  # noqa: ARG002 - others refuse some
        """None: it takes every problem."""
        return None

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in those of ``MOTION_COORDINATES`` that the linear forms leave free."""
        metric, size = [rational(g) for g in problem.metric], len(MOTION_COORDINATES)
        hyperplanes = [*map(hyperplane, problem.forms), *map(hyperplane, problem.motion.forms)]
        entries = [value for row in hyperplanes for value in row]
        echelon, rank = fmpq_mat(len(hyperplanes), size + 1, entries).rref()
        pivots = [next(j for j in range(size + 1) if echelon[row, j] != 0) for row in range(rank)]
        free = [j for j in range(size) if j not in pivots]
        unknowns = tuple(MOTION_COORDINATES[j] for j in free)
        context, generators = rational_ring(unknowns)
        unit = context.constant(1)
        coordinates: list[Expression] = [unit] * size
        for j, generator in zip(free, generators, strict=True):
            coordinates[j] = generator
        for row, pivot in enumerate(pivots):
            value = -echelon[row, size] * unit
            for j, generator in zip(free, generators, strict=True):
                value -= echelon[row, j] * generator
            if pivot < size:
                coordinates[pivot] = value
        quadrics = motion_quadrics(coordinates, unit, metric) + _cylinders(problem, coordinates, unit)
        if size in pivots:
            quadrics.append(unit)  # the linear forms force h = 0: no finite pose
        equations = reduced(quadrics)
        rotation = [coordinates[7 + 3 * i : 10 + 3 * i] for i in range(3)]
        products = quaternion_products(rotation, unit, metric)
        pose_map = PoseMap(tuple(map(tuple, products)), tuple(coordinates[3:6]))
        system = over_integers(unknowns, equations)
        return FormulatedProblem(self.code, system, pose_map, fibre=1, branches=(system,))

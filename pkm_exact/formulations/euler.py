"""Euler-angle formulations: three angles about coordinate axes, by cosines and sines or by half-angle tangents.

R = R_a(theta_1) R_b(theta_2) R_c(theta_3) for a convention "abc", two neighbouring letters different; "zyx" are the
navigation angles (yaw, pitch, roll). In a Gram metric the rotation about axis i, with (i, j, k) cyclic, has the
entries r_jj = r_kk = c, r_jk = -s / g_j, r_kj = s / g_k, where s is sin(theta) times sqrt(g_j g_k): rational again,
with c^2 + s^2 / (g_j g_k) = 1.

A pose has two triples of angles. At the gimbal lock of the convention it has infinitely many; such a pose, and one
with theta_j = pi for half-angle tangents, is missing here: these formulations are charts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from pkm_exact.formulations.acceptance import needs_all_motions, needs_linear_constraints
from pkm_exact.formulations.base import (
    Expression,
    FormulatedProblem,
    PoseMap,
    over_integers,
    rational,
    rational_ring,
)
from pkm_exact.formulations.displacement import POSITION_UNKNOWNS, constraint_equations
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC, quaternion_products

NAVIGATION = "zyx"


@dataclass(frozen=True)
class AFD1:
    """Cosines and sines of three angles.

    Unknowns C and c_j, s_j. Equations: 6 legs with R(c, s) and 3 circles. Each pose is met by two triples: 80
    solutions.
    Source: Rolland 2008, section 4.1.1, equations (9) and (10).

    Attributes
    ----------
    convention : str
        Axes of the three rotations; default the navigation angles.
    """

    convention: str = NAVIGATION
    code: str = "AFD1"
    title: str = "position, cosines and sines of Euler angles"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: all motions must be possible, constraints may be any."""
        return needs_all_motions(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns c1..c3, cos1, sin1, .., sin3."""
        axes = convention_axes(self.convention)
        unknowns = POSITION_UNKNOWNS + tuple(f"{name}{j}" for j in (1, 2, 3) for name in ("cos", "sin"))
        context, generators = rational_ring(unknowns)
        metric = [rational(g) for g in problem.metric]
        cosines, sines = generators[3::2], generators[4::2]
        rotation = euler_rotation(axes, cosines, sines, metric, context.constant(1))
        equations = constraint_equations(problem, generators[:3], rotation)
        for axis, c, s in zip(axes, cosines, sines, strict=True):
            equations.append(c * c + s * s * circle_weight(axis, metric) - 1)
        system = over_integers(unknowns, equations)
        products = quaternion_products(rotation, context.constant(1), metric)
        pose_map = PoseMap(tuple(map(tuple, products)), tuple(generators[:3]))
        return FormulatedProblem(self.code, system, pose_map, fibre=2, branches=(system,), is_chart=True)


@dataclass(frozen=True)
class AFD2:
    """Tangents of half the angles.

    Unknowns C and t_j, tan(theta_j / 2) in the scale of the metric. Equations: 6 legs times prod(1 + t_j^2), of degree
    8. They vanish on sets of positive dimension where a factor 1 + t_j^2 is 0. What is solved is the localisation away
    from there: y_j = 1 / (1 + t_j^2) and z_j = t_j y_j are joined as unknowns, which leaves legs of degree 4, since
    cos(theta_j) = 2 y_j - 1 and sin(theta_j) = 2 z_j. Each pose is met by two triples: 80 solutions.
    Source: Rolland 2008, section 4.1.2, equations (11) and (12), whose leg equation lacks the factor 2.

    Attributes
    ----------
    convention : str
        Axes of the three rotations; default the navigation angles.
    """

    convention: str = NAVIGATION
    code: str = "AFD2"
    title: str = "position and half-angle tangents of Euler angles"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: all motions must be possible, constraints linear."""
        return needs_linear_constraints(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns c1..c3, t1..t3; solved with y1..y3, z1..z3 beside them."""
        axes = convention_axes(self.convention)
        own = (*POSITION_UNKNOWNS, "t1", "t2", "t3")
        metric = [rational(g) for g in problem.metric]
        system = over_integers(own, self._cleared_legs(problem, own, axes, metric))
        unknowns = ("t1", "t2", "t3", *POSITION_UNKNOWNS, "y1", "z1", "y2", "z2", "y3", "z3")
        context, generators = rational_ring(unknowns)
        tangents, position, y, z = generators[:3], generators[3:6], generators[6::2], generators[7::2]
        cosines = [2 * value - 1 for value in y]
        sines = [2 * value for value in z]
        rotation = euler_rotation(axes, cosines, sines, metric, context.constant(1))
        equations = constraint_equations(problem, position, rotation)
        for axis, t, a, b in zip(axes, tangents, y, z, strict=True):
            weight = circle_weight(axis, metric)
            equations += [t * a - b, a + weight * (t * b) - 1, a * a + weight * (b * b) - a]
        products = quaternion_products(rotation, context.constant(1), metric)
        pose_map = PoseMap(tuple(map(tuple, products)), tuple(position))
        localised = over_integers(unknowns, equations)
        return FormulatedProblem(self.code, system, pose_map, fibre=2, branches=(localised,), is_chart=True)

    @staticmethod
    def _cleared_legs(
        problem: ForwardProblem, unknowns: Sequence[str], axes: Sequence[int], metric: Sequence[fmpq]
    ) -> list[Expression]:
        """The legs times prod(1 + t_j^2), from homogeneous rotations: the leg equation is linear in (R, 1)."""
        context, generators = rational_ring(unknowns)
        position, tangents = generators[:3], generators[3:]
        weights = [circle_weight(axis, metric) for axis in axes]
        squares = [w * (t * t) for w, t in zip(weights, tangents, strict=True)]
        units = [1 + square for square in squares]
        rotation = euler_rotation(
            axes, [1 - square for square in squares], [2 * t for t in tangents], metric, context.constant(1), units
        )
        unit = units[0] * units[1] * units[2]
        zero = [[0 * unit] * 3 for _ in range(3)]
        still = constraint_equations(problem, position, zero)
        moving = constraint_equations(problem, position, rotation)
        return [a * unit + (b - a) for a, b in zip(still, moving, strict=True)]


def convention_axes(convention: str) -> tuple[int, int, int]:
    """Axis numbers of a convention.

    Examples
    --------
    >>> convention_axes("zxz")
    (2, 0, 2)
    """
    first, second, third = ("xyz".index(letter) for letter in convention)
    return first, second, third


def circle_weight(axis: int, metric: Sequence[fmpq]) -> fmpq:
    """1 / (g_j g_k) for the two other axes: the coefficient of s^2 in the circle's equation."""
    _, j, k = CYCLIC[axis]
    return 1 / (metric[j] * metric[k])


def euler_rotation(
    axes: Sequence[int],
    cosines: Sequence[Expression],
    sines: Sequence[Expression],
    metric: Sequence[fmpq],
    one: Expression,
    units: Sequence[Expression] | None = None,
) -> list[list[Expression]]:
    """Product of three rotations about coordinate axes; with ``units`` each one is multiplied by its unit."""
    product: list[list[Expression]] = [[one if i == j else 0 * one for j in range(3)] for i in range(3)]
    for number, axis in enumerate(axes):
        i, j, k = CYCLIC[axis]
        factor = [[0 * one] * 3 for _ in range(3)]
        factor[i][i] = one if units is None else units[number]
        factor[j][j] = factor[k][k] = cosines[number]
        factor[j][k] = sines[number] * (-1 / metric[j])
        factor[k][j] = sines[number] * (1 / metric[k])
        product = [
            [row[0] * factor[0][m] + row[1] * factor[1][m] + row[2] * factor[2][m] for m in range(3)] for row in product
        ]
    return product

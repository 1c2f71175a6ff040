"""Position-based formulations: the unknowns are the positions P_1, P_2, P_3 of three platform joints.

With v1 = P_2 - P_1, v2 = P_3 - P_1 and v3 = G^-1 (v1 x v2), every joint stands at P_1 + a v1 + b v2 + c v3; a, b, c are
its coordinates in the frame u1 = B_2 - B_1, u2 = B_3 - B_1, u3 = G^-1 (u1 x u2), which is not normalised, so that they
are rational (Rolland 2008, section 3.2, normalises it). Any three joints that are not collinear will do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from flint import fmpq, fmpq_mpoly_ctx

from pkm_exact.formulations.acceptance import needs_six_legs
from pkm_exact.formulations.base import (
    Expression,
    FormulatedProblem,
    cross,
    dot,
    over_integers,
    rational,
    rational_ring,
)
from pkm_exact.formulations.platform import (
    PlatformFrame,
    Triple,
    edge_square,
    edge_vectors,
    platform_frame,
    pose_from_points,
)
from pkm_exact.geometry.problem import ForwardProblem

POINT_UNKNOWNS = tuple(f"{axis}{point}" for point in (1, 2, 3) for axis in "xyz")


def _points() -> tuple[fmpq_mpoly_ctx, list[list[Expression]]]:
    context, generators = rational_ring(POINT_UNKNOWNS)
    return context, [list(generators[3 * i : 3 * i + 3]) for i in range(3)]


def _leg_equations(
    problem: ForwardProblem, frame: PlatformFrame, points: Sequence[Sequence[Expression]]
) -> list[Expression]:
    """|P_1 + a v1 + b v2 + c v3 - A|^2 - l^2 for every leg."""
    metric = [rational(g) for g in problem.metric]
    v1, v2, v3 = edge_vectors(points, metric)
    equations = []
    for leg, (a, b, c) in zip(problem.distances, frame.coordinates, strict=True):
        offset = [points[0][i] + a * v1[i] + b * v2[i] + c * v3[i] - rational(leg.base[i]) for i in range(3)]
        equations.append(dot(metric, offset, offset) - rational(leg.length_squared))
    return equations


def _distance(
    problem: ForwardProblem, frame: PlatformFrame, points: Sequence[Sequence[Expression]], i: int, j: int
) -> Expression:
    """|P_i - P_j|^2 - |B_i - B_j|^2 for two points of the frame."""
    metric = [rational(g) for g in problem.metric]
    edge = [a - b for a, b in zip(points[i], points[j], strict=True)]
    difference: Expression = dot(metric, edge, edge) - edge_square(problem, frame.legs[i], frame.legs[j])
    return difference


@dataclass(frozen=True)
class AFP1:
    """Three points with distances.

    Equations: 6 legs (of degree 4 where c is not 0: the source calls all nine quadratic) and the 3 distances between
    the three joints. 40 solutions, one for each pose.
    Source: Rolland 2008, section 4.2.1, equations (28) to (30).

    Attributes
    ----------
    triple : tuple of 3 int, optional
        The legs of the three joints, from 0; default the first three that are not collinear.
    """

    triple: Triple | None = None
    code: str = "AFP1"
    title: str = "positions of three platform joints, distances"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: it needs six legs."""
        return needs_six_legs(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns x1, y1, z1, ..., z3."""
        context, points = _points()
        frame = platform_frame(problem, self.triple)
        equations = _leg_equations(problem, frame, points)
        equations += [_distance(problem, frame, points, i, j) for i, j in combinations(range(3), 2)]
        system = over_integers(POINT_UNKNOWNS, equations)
        pose_map = pose_from_points(problem, frame, points, context.constant(1))
        return FormulatedProblem(self.code, system, pose_map, fibre=1, branches=(system,))


@dataclass(frozen=True)
class AFP2:
    """Three points with two distances and a scalar product.

    Equations: 6 legs, |v1|^2, |v2|^2 and v1.v2. They generate the same ideal as those of AFP1.
    Source: Rolland 2008, section 4.2.2, equation (31), whose F_9 has a vector product where the scalar product is
    meant.

    Attributes
    ----------
    triple : tuple of 3 int, optional
        As for AFP1.
    """

    triple: Triple | None = None
    code: str = "AFP2"
    title: str = "positions of three platform joints, distances and angle"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: it needs six legs."""
        return needs_six_legs(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns x1, y1, z1, ..., z3."""
        context, points = _points()
        frame = platform_frame(problem, self.triple)
        metric = [rational(g) for g in problem.metric]
        equations = _leg_equations(problem, frame, points)
        equations += [_distance(problem, frame, points, 0, j) for j in (1, 2)]
        v1, v2, _ = edge_vectors(points, metric)
        equations.append(dot(metric, v1, v2) - dot(metric, frame.axes[0], frame.axes[1]))
        system = over_integers(POINT_UNKNOWNS, equations)
        pose_map = pose_from_points(problem, frame, points, context.constant(1))
        return FormulatedProblem(self.code, system, pose_map, fibre=1, branches=(system,))


@dataclass(frozen=True)
class AFP3:
    """Three points with recombined equations.

    Unknowns P_1, P_2, P_3: positions of three platform joints that are not collinear. With v1 = P_2 - P_1,
    v2 = P_3 - P_1, v3 = G^-1 (v1 x v2), every joint stands at P_1 + a v1 + b v2 + c v3. Equations: the legs of the
    three joints; their sums with the three distance conditions, which leaves P_i.P_j and linear terms; the other three
    legs with |P_i|^2, P_i.P_j and the products of v1, v2, v3 replaced by linear terms and constants, of degree 3 (2 if
    c = 0). 40 solutions, one for each pose.
    Source: Rolland 2008, section 4.2.3, equations (32) to (36); with u3 not normalised, so that a, b, c are rational.
    """

    triple: Triple | None = None
    code: str = "AFP3"
    title: str = "positions of three platform joints, recombined"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: it needs six legs."""
        return needs_six_legs(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns x1, y1, z1, ..., z3."""
        context, generators = rational_ring(POINT_UNKNOWNS)
        unit = context.constant(1)
        metric = [rational(g) for g in problem.metric]
        points = [list(generators[3 * i : 3 * i + 3]) for i in range(3)]
        frame = platform_frame(problem, self.triple)
        bases = [[rational(value) for value in problem.distances[index].base] for index in frame.legs]
        squares = [rational(problem.distances[index].length_squared) for index in frame.legs]
        legs = [
            dot(metric, p, p) - 2 * dot(metric, p, a) + dot(metric, a, a) - square
            for p, a, square in zip(points, bases, squares, strict=True)
        ]
        # On the solutions |P_i|^2 = linear[i][i] and P_i.P_j = linear[i][j].
        linear = [[0 * unit] * 3 for _ in range(3)]
        for i in range(3):
            linear[i][i] = dot(metric, points[i], points[i]) - legs[i]
        for i, j in combinations(range(3), 2):
            edge = edge_square(problem, frame.legs[i], frame.legs[j])
            linear[i][j] = linear[j][i] = (linear[i][i] + linear[j][j] - edge) * fmpq(1, 2)
        recombined = [dot(metric, points[i], points[j]) - linear[i][j] for i, j in combinations(range(3), 2)]
        others = [
            _reduced_leg(problem, frame, index, points, linear)
            for index in range(len(problem.distances))
            if index not in frame.legs
        ]
        system = over_integers(POINT_UNKNOWNS, legs + recombined + others)
        pose_map = pose_from_points(problem, frame, points, unit)
        return FormulatedProblem(self.code, system, pose_map, fibre=1, branches=(system,))


def _reduced_leg(
    problem: ForwardProblem,
    frame: PlatformFrame,
    index: int,
    points: Sequence[Sequence[Expression]],
    linear: Sequence[Sequence[Expression]],
) -> Expression:
    """|P_1 + a v1 + b v2 + c v3 - A|^2 - l^2 modulo the equations of the three points."""
    metric = [rational(g) for g in problem.metric]
    leg = problem.distances[index]
    base = [rational(value) for value in leg.base]
    a, b, c = frame.coordinates[index]
    weights = (1 - a - b, a, b)
    plane = sum((weights[i] * weights[j] * linear[i][j] for i in range(3) for j in range(3)), 0 * linear[0][0])
    toward = sum((weights[i] * dot(metric, points[i], base) for i in range(3)), 0 * linear[0][0])
    v1 = [q - p for p, q in zip(points[0], points[1], strict=True)]
    v2 = [q - p for p, q in zip(points[0], points[2], strict=True)]
    normal = cross(v1, v2)  # G v3
    # v3 is orthogonal to v1 and v2, and v3.P_1 = det(P_1, P_2, P_3).
    volume = sum((p * n for p, n in zip(points[0], cross(points[1], points[2]), strict=True)), 0 * linear[0][0])
    height = volume - sum((value * n for value, n in zip(base, normal, strict=True)), 0 * linear[0][0])
    u3 = frame.axes[2]
    constant = c * c * dot(metric, u3, u3) + dot(metric, base, base) - rational(leg.length_squared)
    reduced: Expression = plane - 2 * toward + 2 * c * height + constant
    return reduced

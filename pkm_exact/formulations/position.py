"""Position-based formulations: the unknowns are the positions of three platform joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from flint import fmpq, fmpq_mat

from pkm_exact.errors import InputError
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
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import quaternion_products

POINT_UNKNOWNS = tuple(f"{axis}{point}" for point in (1, 2, 3) for axis in "xyz")


@dataclass(frozen=True)
class PlatformFrame:
    """Affine frame of the platform on three of its joints.

    Attributes
    ----------
    legs : tuple of 3 int
        The legs, counted from 0, whose platform joints B_i, B_j, B_k span the frame.
    axes : 3 x 3 tuple of fmpq
        u1 = B_j - B_i, u2 = B_k - B_i, u3 = G^-1 (u1 x u2): rational, not normalised.
    coordinates : 6 x 3 tuple of fmpq
        (a, b, c) of every joint: B - B_i = a u1 + b u2 + c u3.
    """

    legs: tuple[int, int, int]
    axes: tuple[tuple[fmpq, ...], ...]
    coordinates: tuple[tuple[fmpq, ...], ...]


def platform_frame(problem: ForwardProblem) -> PlatformFrame:
    """The affine frame on the first three platform joints that are not collinear.

    Raises
    ------
    InputError
        If all platform joints lie on one line.
    """
    metric = [rational(g) for g in problem.metric]
    joints = [[rational(value) for value in leg.platform] for leg in problem.legs]
    for legs in combinations(range(len(joints)), 3):
        origin, first, second = (joints[index] for index in legs)
        u1 = [b - a for a, b in zip(origin, first, strict=True)]
        u2 = [b - a for a, b in zip(origin, second, strict=True)]
        u3 = [value / g for value, g in zip(cross(u1, u2), metric, strict=True)]
        if any(u3):
            break
    else:
        raise InputError(
            "platform.joints: all platform joints lie on one line, but a formulation by three points "
            "needs three that do not; use --formulation SE3"
        )
    matrix = fmpq_mat([[u1[i], u2[i], u3[i]] for i in range(3)])
    offsets = fmpq_mat([[joint[i] - origin[i] for joint in joints] for i in range(3)])
    coordinates = matrix.solve(offsets)
    table = tuple(tuple(coordinates[i, j] for i in range(3)) for j in range(len(joints)))
    return PlatformFrame((legs[0], legs[1], legs[2]), (tuple(u1), tuple(u2), tuple(u3)), table)


def pose_from_points(
    problem: ForwardProblem, frame: PlatformFrame, points: Sequence[Sequence[Expression]], unit: Expression
) -> PoseMap:
    """The pose from the positions of the frame's three joints: R = (v1 v2 v3) (u1 u2 u3)^-1, C = P - R B."""
    metric = [rational(g) for g in problem.metric]
    v1 = [b - a for a, b in zip(points[0], points[1], strict=True)]
    v2 = [b - a for a, b in zip(points[0], points[2], strict=True)]
    v3 = [(1 / g) * value for value, g in zip(cross(v1, v2), metric, strict=True)]
    inverse = fmpq_mat([[axis[i] for axis in frame.axes] for i in range(3)]).inv()
    rotation = [
        [v1[i] * inverse[0, j] + v2[i] * inverse[1, j] + v3[i] * inverse[2, j] for j in range(3)] for i in range(3)
    ]
    joint = [rational(value) for value in problem.legs[frame.legs[0]].platform]
    position = [points[0][i] - sum((rotation[i][j] * joint[j] for j in range(3)), 0 * unit) for i in range(3)]
    return PoseMap(tuple(map(tuple, quaternion_products(rotation, unit, metric))), tuple(position))


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

    code: str = "AFP3"
    title: str = "positions of three platform joints, recombined"

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns x1, y1, z1, ..., z3."""
        context, generators = rational_ring(POINT_UNKNOWNS)
        unit = context.constant(1)
        metric = [rational(g) for g in problem.metric]
        points = [list(generators[3 * i : 3 * i + 3]) for i in range(3)]
        frame = platform_frame(problem)
        bases = [[rational(value) for value in problem.legs[index].base] for index in frame.legs]
        squares = [rational(problem.legs[index].length_squared) for index in frame.legs]
        legs = [
            dot(metric, p, p) - 2 * dot(metric, p, a) + dot(metric, a, a) - square
            for p, a, square in zip(points, bases, squares, strict=True)
        ]
        # On the solutions |P_i|^2 = linear[i][i] and P_i.P_j = linear[i][j].
        linear = [[0 * unit] * 3 for _ in range(3)]
        for i in range(3):
            linear[i][i] = dot(metric, points[i], points[i]) - legs[i]
        for i, j in combinations(range(3), 2):
            edge = _edge_square(problem, frame, i, j)
            linear[i][j] = linear[j][i] = (linear[i][i] + linear[j][j] - edge) * fmpq(1, 2)
        recombined = [dot(metric, points[i], points[j]) - linear[i][j] for i, j in combinations(range(3), 2)]
        others = [
            _reduced_leg(problem, frame, index, points, linear)
            for index in range(len(problem.legs))
            if index not in frame.legs
        ]
        system = over_integers(POINT_UNKNOWNS, legs + recombined + others)
        return FormulatedProblem(self.code, system, pose_from_points(problem, frame, points, unit), fibre=1)


def _edge_square(problem: ForwardProblem, frame: PlatformFrame, i: int, j: int) -> fmpq:
    metric = [rational(g) for g in problem.metric]
    left, right = (problem.legs[frame.legs[index]].platform for index in (i, j))
    edge = [rational(a - b) for a, b in zip(left, right, strict=True)]
    square: fmpq = dot(metric, edge, edge)
    return square


def _reduced_leg(
    problem: ForwardProblem,
    frame: PlatformFrame,
    index: int,
    points: Sequence[Sequence[Expression]],
    linear: Sequence[Sequence[Expression]],
) -> Expression:
    """|P_1 + a v1 + b v2 + c v3 - A|^2 - l^2 modulo the equations of the three points."""
    metric = [rational(g) for g in problem.metric]
    leg = problem.legs[index]
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

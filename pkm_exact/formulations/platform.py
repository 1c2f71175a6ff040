"""Affine frames of the platform on three of its joints, and poses from the positions of such joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from flint import fmpq, fmpq_mat

from pkm_exact.errors import InputError
from pkm_exact.formulations.base import Expression, PoseMap, cross, dot, rational
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import quaternion_products

Triple = tuple[int, int, int]
"""Three legs, counted from 0, whose platform joints are not collinear."""


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


def platform_frame(problem: ForwardProblem, triple: Triple | None = None) -> PlatformFrame:
    """The affine frame on a triple of platform joints, by default the first that is not collinear.

    Raises
    ------
    InputError
        If the given triple, or every triple, is collinear.
    """
    metric = [rational(g) for g in problem.metric]
    joints = [[rational(value) for value in leg.platform] for leg in problem.distances]
    candidates = [triple] if triple is not None else list(combinations(range(len(joints)), 3))
    for legs in candidates:
        origin, first, second = (joints[index] for index in legs)
        u1 = [b - a for a, b in zip(origin, first, strict=True)]
        u2 = [b - a for a, b in zip(origin, second, strict=True)]
        u3 = [value / g for value, g in zip(cross(u1, u2), metric, strict=True)]
        if any(u3):
            break
    else:
        numbers = (
            "all platform joints" if triple is None else "platform joints " + ", ".join(str(k + 1) for k in triple)
        )
        raise InputError(
            f"platform.joints: {numbers} lie on one line, but a formulation by points needs three that do not; "
            f"use {'--formulation SE3' if triple is None else 'another triple'}"
        )
    matrix = fmpq_mat([[u1[i], u2[i], u3[i]] for i in range(3)])
    offsets = fmpq_mat([[joint[i] - origin[i] for joint in joints] for i in range(3)])
    coordinates = matrix.solve(offsets)
    table = tuple(tuple(coordinates[i, j] for i in range(3)) for j in range(len(joints)))
    return PlatformFrame((legs[0], legs[1], legs[2]), (tuple(u1), tuple(u2), tuple(u3)), table)


def edge_square(problem: ForwardProblem, i: int, j: int) -> fmpq:
    """|B_i - B_j|^2 of two platform joints, legs counted from 0."""
    metric = [rational(g) for g in problem.metric]
    edge = [rational(a - b) for a, b in zip(problem.distances[i].platform, problem.distances[j].platform, strict=True)]
    square: fmpq = dot(metric, edge, edge)
    return square


def edge_vectors(
    points: Sequence[Sequence[Expression]], metric: Sequence[fmpq]
) -> tuple[list[Expression], list[Expression], list[Expression]]:
    """v1 = P_2 - P_1, v2 = P_3 - P_1 and v3 = G^-1 (v1 x v2): the images of the axes of the platform frame."""
    v1 = [b - a for a, b in zip(points[0], points[1], strict=True)]
    v2 = [b - a for a, b in zip(points[0], points[2], strict=True)]
    v3 = [(1 / g) * value for value, g in zip(cross(v1, v2), metric, strict=True)]
    return v1, v2, v3


def pose_from_points(
    problem: ForwardProblem, frame: PlatformFrame, points: Sequence[Sequence[Expression]], unit: Expression
) -> PoseMap:
    """The pose from the positions of the frame's three joints: R = (v1 v2 v3) (u1 u2 u3)^-1, C = P - R B."""
    metric = [rational(g) for g in problem.metric]
    v1, v2, v3 = edge_vectors(points, metric)
    inverse = fmpq_mat([[axis[i] for axis in frame.axes] for i in range(3)]).inv()
    rotation = [
        [v1[i] * inverse[0, j] + v2[i] * inverse[1, j] + v3[i] * inverse[2, j] for j in range(3)] for i in range(3)
    ]
    joint = [rational(value) for value in problem.distances[frame.legs[0]].platform]
    position = [points[0][i] - sum((rotation[i][j] * joint[j] for j in range(3)), 0 * unit) for i in range(3)]
    return PoseMap(tuple(map(tuple, quaternion_products(rotation, unit, metric))), tuple(position))

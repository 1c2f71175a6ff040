"""Proofs that a robot moves although its legs are locked.

Rigid motions form a variety of dimension 6 on which each leg is a hyperplane. If the six leg forms have rank r < 6 (an
architecture singularity), every component of the set of poses has dimension at least 6 - r; one finite pose, real or
complex, then proves a self-motion through it. Such a pose is found by joining 6 - r further legs, chosen at random, and
solving: every pose of the longer list of legs is one of the robot's.

If base and platform are congruent, A_i = d + R B_i for one rotation R, and all legs are equal, the platform can move on
a sphere without turning: every pose (C, R) with |C - d| = l has these leg lengths.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from random import Random

from flint import fmpq, fmpq_mat

from pkm_exact.formulations.base import rational
from pkm_exact.formulations.motion_variety import leg_hyperplane
from pkm_exact.geometry.problem import ForwardProblem, Leg, Vector
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.poses.representation import PoseRepresentation


@dataclass(frozen=True)
class SelfMotion:
    """A proof that the poses form a set of positive dimension.

    Attributes
    ----------
    dimension : int
        The set of poses has at least this dimension at each of the poses below.
    legs : tuple of Leg
        Further legs.
    representation : PoseRepresentation
        Complex poses, verified, in which the robot's legs and the further ones have their lengths.
    """

    dimension: int
    legs: tuple[Leg, ...]
    representation: PoseRepresentation


def leg_rank(problem: ForwardProblem) -> int:
    """Rank over Q of the leg forms on the 17 coordinates of rigid motions."""
    metric = [rational(g) for g in problem.metric]
    return int(fmpq_mat([leg_hyperplane(leg, metric) for leg in problem.legs]).rank())


def extended_problems(problem: ForwardProblem, count: int, seed: int) -> Iterator[ForwardProblem]:
    """The problem with ``count`` further legs, random joints of the size of the robot's own, again and again."""
    random = Random(seed)
    size = 1 + max(abs(value) for leg in problem.legs for value in (*leg.base, *leg.platform)).__ceil__()
    square = 1 + max(leg.length_squared for leg in problem.legs).__ceil__()
    while True:
        further = []
        for _ in range(count):
            x, y, z, u, v, w = (Fraction(random.randint(-size, size)) for _ in range(6))
            further.append(Leg((x, y, z), (u, v, w), Fraction(random.randint(1, square))))
        yield replace(problem, legs=problem.legs + tuple(further))


@dataclass(frozen=True)
class TranslationalMotion:
    """A sphere of poses: A_i = offset + R B_i for all legs, which have one length l; then C - offset is any vector of
    that length.

    Attributes
    ----------
    rotation : 3 x 3 tuple of Fraction
        R, in rational coordinates.
    offset : tuple of 3 Fraction
    """

    rotation: tuple[Vector, Vector, Vector]
    offset: Vector
    dimension: int = 2


def translational_motion(problem: ForwardProblem) -> TranslationalMotion | None:
    """The sphere of poses of a robot with congruent base and platform and equal legs, or None."""
    legs = problem.legs
    if problem.planar or len({leg.length_squared for leg in legs}) != 1:
        return None
    for first, second, third in combinations(legs, 3):
        triple = (first, second, third)
        u = _axes([leg.platform for leg in triple], problem.metric)
        v = _axes([leg.base for leg in triple], problem.metric)
        if not any(u[2]):
            continue
        matrix = fmpq_mat([[rational(axis[i]) for axis in v] for i in range(3)])
        matrix *= fmpq_mat([[rational(axis[i]) for axis in u] for i in range(3)]).inv()
        gram = fmpq_mat([[g if i == j else 0 for j in range(3)] for i, g in enumerate(problem.metric)])
        if matrix.transpose() * gram * matrix != gram:
            return None
        x, y, z = (_vector([matrix[i, j] for j in range(3)]) for i in range(3))
        rotation = (x, y, z)
        offsets = {_difference(leg.base, _image(rotation, leg.platform)) for leg in legs}
        return TranslationalMotion(rotation, offsets.pop()) if len(offsets) == 1 else None
    return None


def _axes(points: Sequence[Vector], metric: Sequence[int]) -> tuple[Vector, Vector, Vector]:
    """P_2 - P_1, P_3 - P_1 and G^-1 times their vector product."""
    a, b = _difference(points[1], points[0]), _difference(points[2], points[0])
    x, y, z = ((a[j] * b[k] - a[k] * b[j]) / metric[i] for i, j, k in CYCLIC)
    return a, b, (x, y, z)


def _difference(left: Vector, right: Vector) -> Vector:
    x, y, z = (a - b for a, b in zip(left, right, strict=True))
    return x, y, z


def _image(rotation: Sequence[Vector], vector: Vector) -> Vector:
    x, y, z = (sum((r * v for r, v in zip(row, vector, strict=True)), Fraction(0)) for row in rotation)
    return x, y, z


def _vector(values: Sequence[fmpq]) -> Vector:
    x, y, z = (Fraction(int(value.p), int(value.q)) for value in values)
    return x, y, z

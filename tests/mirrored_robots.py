"""Planar robots with a fourfold pose and a double one."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from samples import placed

from pkm_exact import Robot
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.problem import ForwardProblem

STRAIGHT = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))


def vectors(*points: Sequence[Fraction | int]) -> list[Vector]:
    """Points as tuples of fractions."""
    return [(Fraction(x), Fraction(y), Fraction(z)) for x, y, z in points]


def mirrored(b: int, height: int, top: int) -> Robot | None:
    """A mirror-symmetric 3-RPR robot with a fourfold pose (C = 0, R = 1) and a double one (a half turn).

    All legs point to the origin, A_i = a_i B_i, in a pose that is its own mirror image; so they do after a half turn.
    Such poses are double at least. At R = 1 the legs' second derivative along the turn is made to vanish as well:
    sum m_i a_i / (1 - a_i) |B_i|^2 = 0 where sum m_i B_i = 0; then symmetry leaves no less than four. None if the
    numbers give no robot.
    """
    x, y, z = map(Fraction, (b, height, top))
    if not all((x, y, z)) or x * x + y * y == z * y:
        return None
    a = z * (y - z) / (x * x + y * y - z * y)
    if a in (0, 1):
        return None
    ratio = a / (1 - a) * (x * x + y * y) / (y * z)
    if ratio == -1:
        return None
    platform = vectors((-x, y, 0), (x, y, 0), (0, z, 0))
    factors = (a, a, ratio / (1 + ratio))
    base = vectors(*([f * c for c in joint] for f, joint in zip(factors, platform, strict=True)))
    return Robot("mirrored", "3-RPR", "m", "made up", tuple(base), tuple(platform))


def problem_at_home(robot: Robot) -> ForwardProblem:
    legs = placed(robot.base_joints, robot.platform_joints, vectors((0, 0, 0))[0], STRAIGHT).problem.distances
    return robot.problem([leg.length_squared for leg in legs])

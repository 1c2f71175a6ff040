"""Mechanisms as lists of constraints, with what is known of the number of their poses."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from random import Random

from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SCHOENFLIES, SPATIAL, TRANSLATION

F = Fraction
TRIANGLE = (1, 3, 1)
"""The metric in which points at 0, 120 and 240 degrees are rational."""
RADIAL = ((F(1), F(0), F(0)), (F(-1, 2), F(1, 2), F(0)), (F(-1, 2), F(-1, 2), F(0)))
TANGENT = ((F(0), F(1), F(0)), (F(-3, 2), F(-1, 2), F(0)), (F(3, 2), F(-1, 2), F(0)))
ORIGIN = (F(0), F(0), F(0))


def vector(x: Fraction | int, y: Fraction | int, z: Fraction | int) -> Vector:
    return F(x), F(y), F(z)


def times(factor: Fraction | int, point: Vector, height: Fraction | int = 0) -> Vector:
    return factor * point[0], factor * point[1], F(height)


def random_vectors(seed: int) -> Callable[[], Vector]:
    random = Random(seed)
    return lambda: (F(random.randint(-9, 9)), F(random.randint(-9, 9)), F(random.randint(-9, 9)))


def mixed(spheres: int, planes: int, carries: int = 0, seed: int = 100) -> ForwardProblem:
    """So many random constraints of each of three types."""
    draw, random = random_vectors(seed), Random(seed + 1)
    found: list[Constraint] = [Distance(draw(), draw(), F(random.randint(50, 300))) for _ in range(spheres)]
    found += [InPlane(draw(), F(random.randint(-20, 20)), draw()) for _ in range(planes)]
    found += [Carries(draw(), F(random.randint(-20, 20)), draw()) for _ in range(carries)]
    return ForwardProblem(tuple(found))


def line_and_spheres(seed: int = 7) -> ForwardProblem:
    """A point on a line, and four legs."""
    draw, random = random_vectors(seed), Random(seed)
    legs = [Distance(draw(), draw(), F(random.randint(50, 300))) for _ in range(4)]
    return ForwardProblem((OnLine(draw(), draw(), draw()), *legs))


def three_lines(seed: int = 8) -> ForwardProblem:
    draw = random_vectors(seed)
    return ForwardProblem(tuple(OnLine(draw(), draw(), draw()) for _ in range(3)))


def point_and_spheres(seed: int = 9) -> ForwardProblem:
    draw, random = random_vectors(seed), Random(seed)
    legs = [Distance(draw(), draw(), F(random.randint(50, 300))) for _ in range(3)]
    return ForwardProblem((AtPoint(draw(), draw()), *legs))


def three_rps() -> ForwardProblem:
    """Three legs, each in a plane through the axis of the base."""
    found: list[Constraint] = []
    for k, length in enumerate((F(13, 10), F(3, 2), F(7, 5))):
        platform = times(F(7, 10), RADIAL[k])
        found += [Distance(times(F(6, 5), RADIAL[k]), platform, length**2), InPlane(TANGENT[k], F(0), platform)]
    return ForwardProblem(tuple(found), TRIANGLE)


def pssc(heights: tuple[Fraction, Fraction, Fraction]) -> ForwardProblem:
    """3-PSS with a cylindrical joint between base and platform: R = r = 7, l = 7/2."""
    points = [vector(F(7, 2), F(-7, 2), 0), vector(F(7, 2), F(7, 2), 0), vector(-7, 0, 0)]
    found: list[Constraint] = [
        InPlane(vector(1, 0, 0), F(0), ORIGIN),
        InPlane(vector(0, 1, 0), F(0), ORIGIN),
        Angle(vector(0, 1, 0), vector(1, 0, 0), F(0)),
    ]
    found += [Distance((p[0], p[1], z), p, F(49, 4)) for p, z in zip(points, heights, strict=True)]
    return ForwardProblem(tuple(found), TRIANGLE)


def delta() -> ForwardProblem:
    """A Delta robot: three spheres, and no turning."""
    height = F(173, 100) * F(24, 25)
    reach = F(174, 100) + F(173, 100) * F(7, 25)
    legs = [Distance(times(reach, axis, -height), ORIGIN, F(266, 100) ** 2) for axis in RADIAL]
    return ForwardProblem(tuple(legs), TRIANGLE, TRANSLATION)


def h4() -> ForwardProblem:
    """The H4: four legs on a platform that turns about the third axis."""
    base, legs = ((-48, -48), (-48, 48), (6, 48), (48, -6)), []
    sides, signs = (-1, -1, 1, 1), (-1, 1, 1, -1)
    heights, squares = (F(1302, 100), F(-749, 100), F(968, 100), F(1577, 100)), (5292, 5292, 3528, 3528)
    for (x, y), side, sign, height, square in zip(base, sides, signs, heights, squares, strict=True):
        legs.append(Distance(vector(x, y - 6 * sign, height), vector(6 * side, 0, 0), F(square)))
    return ForwardProblem(tuple(legs), (1, 1, 1), SCHOENFLIES)


def two_ups_u() -> ForwardProblem:
    """A universal joint and two legs."""
    legs = [Distance(vector(1, y, 0), vector(1, y, 4), length**2) for y, length in ((-1, F(17, 4)), (1, F(15, 4)))]
    return ForwardProblem((AtPoint(ORIGIN, ORIGIN), Angle(vector(0, 1, 0), vector(1, 0, 0), F(0)), *legs))


def cylinders() -> ForwardProblem:
    """A platform that only moves, three of whose points have known distances from axes."""
    radii = ((1, F(5)), (2, F(13)), (3, F(10)))
    axes = (vector(1, 0, 0), vector(0, 1, 0), vector(0, 0, 1))
    found = [AxisDistance(vector(0, k, 1), axes[k - 1], vector(k, 1, 0), square) for k, square in radii]
    return ForwardProblem(tuple(found), (1, 1, 1), TRANSLATION)


def cylinder_and_planes() -> ForwardProblem:
    """A point at a known distance from an axis, and five points in planes."""
    draw = random_vectors(5)
    return ForwardProblem((*mixed(0, 5, seed=3).constraints, AxisDistance(draw(), draw(), draw(), F(30))))


__all__ = ["SPATIAL", *(name for name in dir() if not name.startswith("_"))]

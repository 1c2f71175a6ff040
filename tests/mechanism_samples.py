"""Published mechanisms as constraints, with the number of complex poses that they have.

Geometry on equilateral triangles is rational in the metric (1, 3, 1): ``RADIAL`` and ``TANGENTIAL`` are directions at
0, 120 and 240 degrees.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from random import Random

from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import PLANAR, SCHOENFLIES, SPHERICAL, TRANSLATION
from pkm_exact.solution import Solution

TRIANGULAR = (1, 3, 1)


def vector(*values: Fraction | int | str) -> Vector:
    x, y, z = map(Fraction, values)
    return x, y, z


ORIGIN = vector(0, 0, 0)
RADIAL = [vector(1, 0, 0), vector("-1/2", "1/2", 0), vector("-1/2", "-1/2", 0)]
TANGENTIAL = [vector(0, 1, 0), vector("-3/2", "-1/2", 0), vector("3/2", "-1/2", 0)]


def times(factor: Fraction | int | str, direction: Vector, height: Fraction | int | str = 0) -> Vector:
    x, y, _ = (Fraction(factor) * value for value in direction)
    return x, y, Fraction(height)


def distance(base: Vector, platform: Vector, square: Fraction | int | str) -> Distance:
    return Distance(base, platform, Fraction(square))


def plane(normal: Vector, offset: Fraction | int | str, platform: Vector) -> InPlane:
    return InPlane(normal, Fraction(offset), platform)


class Some:
    """Random constraints with small integers."""

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)

    def point(self) -> Vector:
        return vector(*(self.random.randint(-9, 9) for _ in range(3)))

    def number(self) -> Fraction:
        return Fraction(self.random.randint(-20, 20))

    def distance(self) -> Distance:
        return distance(self.point(), self.point(), self.random.randint(50, 300))

    def in_plane(self) -> InPlane:
        return InPlane(self.point(), self.number(), self.point())

    def carries(self) -> Carries:
        return Carries(self.point(), self.number(), self.point())

    def on_line(self) -> OnLine:
        return OnLine(self.point(), self.point(), self.point())

    def at_point(self) -> AtPoint:
        return AtPoint(self.point(), self.point())


def general(seed: int, **counts: int) -> ForwardProblem:
    """So many random constraints of each type."""
    some = Some(seed)
    constraints: list[Constraint] = []
    for name, count in counts.items():
        constraints += [getattr(some, name)() for _ in range(count)]
    return ForwardProblem(tuple(constraints))


def hinged(lengths: Sequence[str], base: str, platform: str) -> ForwardProblem:
    """3-RPS: three legs, each in a plane through the axis of the base."""
    constraints: list[Constraint] = []
    for direction, normal, length in zip(RADIAL, TANGENTIAL, lengths, strict=True):
        constraints.append(distance(times(base, direction), times(platform, direction), Fraction(length) ** 2))
        constraints.append(plane(normal, 0, times(platform, direction)))
    return ForwardProblem(tuple(constraints), TRIANGULAR)


def supported(heights: Sequence[str], base: str, platform: str, length: str) -> ForwardProblem:
    """3-PSS+C: three rods on vertical slides, and a joint that keeps the platform's centre on a vertical axis."""
    joints = [("1/2", "-1/2"), ("1/2", "1/2"), ("-1", "0")]
    constraints: list[Constraint] = [
        plane(vector(1, 0, 0), 0, ORIGIN),
        plane(vector(0, 1, 0), 0, ORIGIN),
        Angle(vector(0, 1, 0), vector(1, 0, 0), Fraction(0)),
    ]
    for (x, y), height in zip(joints, heights, strict=True):
        foot = times(base, vector(x, y, 0), height)
        constraints.append(distance(foot, times(platform, vector(x, y, 0)), Fraction(length) ** 2))
    return ForwardProblem(tuple(constraints), TRIANGULAR)


def delta() -> ForwardProblem:
    """Rotary Delta: three parallelograms on cranks, which keep the platform from turning."""
    arm, rod, radius = Fraction(173, 100), Fraction(266, 100), Fraction(174, 100)
    turns = [("7/25", "24/25"), ("3/5", "4/5"), ("5/13", "12/13")]
    legs = (
        distance(times(radius + arm * Fraction(c), direction, -arm * Fraction(s)), ORIGIN, rod**2)
        for (c, s), direction in zip(turns, RADIAL, strict=True)
    )
    return ForwardProblem(tuple(legs), TRIANGULAR, TRANSLATION)


def h4() -> ForwardProblem:
    """H4: four rods, the platform translates and turns about the vertical."""
    slides = ("1302/100", "-749/100", "968/100", "1577/100")
    feet = ((-48, -48), (-48, 48), (6, 48), (48, -6))
    along, across, squares = (-1, -1, 1, 1), (-1, 1, 1, -1), (5292, 5292, 3528, 3528)
    legs = (
        distance(vector(x, y - 6 * e, q), vector(6 * d, 0, 0), square)
        for (x, y), d, e, q, square in zip(feet, along, across, slides, squares, strict=True)
    )
    return ForwardProblem(tuple(legs), motion=SCHOENFLIES)


def two_legs_and_universal_joint() -> ForwardProblem:
    """2-UPS+U: the centre fixed, one axis of the platform perpendicular to one of the base, two legs."""
    joint = (AtPoint(ORIGIN, ORIGIN), Angle(vector(0, 1, 0), vector(1, 0, 0), Fraction(0)))
    legs = (
        distance(vector(1, -1, 0), vector(1, -1, 4), Fraction(17, 4) ** 2),
        distance(vector(1, 1, 0), vector(1, 1, 4), Fraction(15, 4) ** 2),
    )
    return ForwardProblem((*joint, *legs))


def cartesian() -> ForwardProblem:
    """3-PRRR with its first turning joints driven: three cylinders, at the half tangents (0, 1, 1/4)."""
    side, first, second, rail = (Fraction(x) for x in ("0.105", "0.5", "0.373", "0.9144"))
    third = (Fraction(15, 17), Fraction(8, 17))
    axes = [
        (vector(0, side + first, 0), vector(1, 0, 0)),
        (vector(side + first, 0, 0), vector(0, 1, 0)),
        (vector(first * third[0], rail - side - first * third[1], 0), vector(0, 0, 1)),
    ]
    cylinders = (AxisDistance(point, direction, ORIGIN, second**2) for point, direction in axes)
    return ForwardProblem(tuple(cylinders), motion=TRANSLATION)


def sliding() -> ForwardProblem:
    """3-PRRR with its slides driven: each is a coordinate of the platform, whatever the axes of the guides."""
    planes = (plane(vector(*(int(i == k) for i in range(3))), Fraction(k + 1, 7), ORIGIN) for k in range(3))
    return ForwardProblem(tuple(planes), motion=TRANSLATION)


def turning_lines() -> ForwardProblem:
    """3-RPR whose turning joints are driven: three lines in the plane."""
    normals = [vector(1, "1/3", 0), vector(-2, "1/5", 0), vector("1/7", 1, 0)]
    corners = [("-1/2", "-1/6"), ("1/2", "-1/6"), ("0", "1/3")]
    lines = []
    for normal, (x, y) in zip(normals, corners, strict=True):
        foot = times("1/2", vector(x, y, 0))
        offset = sum((g * n * a for g, n, a in zip(TRIANGULAR, normal, foot, strict=True)), Fraction(0))
        lines.append(plane(normal, offset, times("1/5", vector(x, y, 0))))
    return ForwardProblem(tuple(lines), TRIANGULAR, PLANAR)


def spherical() -> ForwardProblem:
    """Three legs on a platform that turns about a point."""
    some = Some(4)
    return ForwardProblem(tuple(some.distance() for _ in range(3)), motion=SPHERICAL)


MECHANISMS: dict[str, tuple[Callable[[], ForwardProblem], int]] = {
    "6 planes": (lambda: general(106, in_plane=6), 8),
    "5 planes, 1 sphere": (lambda: general(105, distance=1, in_plane=5), 16),
    "4 planes, 2 spheres": (lambda: general(104, distance=2, in_plane=4), 32),
    "3 planes, 3 spheres": (lambda: general(103, distance=3, in_plane=3), 40),
    "2 planes, 4 spheres": (lambda: general(102, distance=4, in_plane=2), 40),
    "1 plane, 5 spheres": (lambda: general(101, distance=5, in_plane=1), 40),
    "5 planes of the base, 1 of the platform": (lambda: general(3, in_plane=5, carries=1), 16),
    "3 planes of the base, 3 of the platform": (lambda: general(5, in_plane=3, carries=3), 20),
    "4 planes of the base, 2 of the platform": (lambda: general(11, in_plane=4, carries=2), 20),
    "4 planes of the base, 1 of the platform, sphere": (lambda: general(12, in_plane=4, carries=1, distance=1), 32),
    "3 planes of the base, 2 of the platform, sphere": (lambda: general(13, in_plane=3, carries=2, distance=1), 40),
    "3 lines": (lambda: general(8, on_line=3), 8),
    "1 line, 4 spheres": (lambda: general(7, on_line=1, distance=4), 28),
    "1 point, 3 spheres": (lambda: general(9, at_point=1, distance=3), 8),
    "point, line, sphere": (lambda: general(10, at_point=1, on_line=1, distance=1), 4),
    "3-RPS": (lambda: hinged(("13/10", "3/2", "7/5"), "6/5", "7/10"), 16),
    "3-PSS+C": (lambda: supported(("0", "1/2", "-1/4"), "7", "7", "7/2"), 24),
    "Delta": (delta, 2),
    "H4": (h4, 8),
    "2-UPS+U": (two_legs_and_universal_joint, 8),
    "3-RPR, driven in turns": (turning_lines, 2),
    "3-PRRR, driven in turns": (cartesian, 8),
    "3-PRRR, sliding": (sliding, 1),
    "3 legs about a point": (spherical, 8),
}
"""Each with its number of complex poses."""


@cache
def solved(name: str) -> Solution:
    """The exact solution, once in a test process."""
    return solve(MECHANISMS[name][0]())

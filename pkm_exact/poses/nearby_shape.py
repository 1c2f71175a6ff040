"""The exact robot that decimals may stand for: equal legs, hexagons of equal angles, chords that are parallel.

What lies within a few units of the last digit written is looked for in floating point, for it only serves to name a
robot. What is said of that robot is decided exactly, on coordinates with sqrt(3).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import atan2, hypot, pi, sin, sqrt
from typing import Final, TypeAlias

from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.hexagons import HEXAGON_METRIC, semi_regular_hexagon
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.coaxial_motion import screws
from pkm_exact.poses.self_motion import form_rank

Place: TypeAlias = tuple[float, float, float]

UNITS: Final = 4
"""Of the last digit by which a rounded joint may be off."""
PAIRINGS: Final = tuple(
    ((0, first), (a, b), (c, d))
    for first in range(1, 6)
    for a, b, c, d in (
        (rest[0], rest[k], *(x for n, x in enumerate(rest) if n not in (0, k)))
        for rest in [[n for n in range(1, 6) if n != first]]
        for k in range(1, 4)
    )
)
"""The six legs in three pairs, in all ways."""


@dataclass(frozen=True)
class NearbyShape:
    """What holds of a robot up to the digits that are written, and what follows where it holds exactly.

    Attributes
    ----------
    facts : tuple of str
    is_singular : bool
        Whether the leg equations of that robot are dependent: an architecture singularity.
    moves : bool
        Whether it has a real motion with its legs locked.
    """

    facts: tuple[str, ...]
    is_singular: bool = False
    moves: bool = False


def nearby_shape(problem: ForwardProblem, digit: Fraction) -> NearbyShape:
    """The shape within a few units of the last digit.

    Examples
    --------
    >>> half = [(118177, 20838), (41042, 112763), (-77135, 91925)]
    >>> turn = [*half, *((-x, -y) for x, y in half)]
    >>> base = [(Fraction(x, 1000), Fraction(y, 1000), Fraction(0)) for x, y in turn]
    >>> platform = [tuple(value / 2 for value in joint) for joint in base]
    >>> legs = tuple(Distance(a, b, Fraction(22500)) for a, b in zip(base, platform))
    >>> found = nearby_shape(ForwardProblem(legs), Fraction(1, 1000))
    >>> found.facts
    ('base and platform are regular hexagons', 'all legs are equal')
    >>> found.is_singular, found.moves
    (True, True)
    """
    if problem.motion.is_planar or not problem.has_only_distances or len(problem.distances) != 6:
        return NearbyShape(())
    slack = UNITS * float(digit)
    base, platform = (_places(side, problem.metric) for side in _sides(problem))
    hexagons = _hexagon(base, slack), _hexagon(platform, slack)
    lengths = [sqrt(leg.length_squared) for leg in problem.distances]
    equal = max(lengths) - min(lengths) <= slack
    facts = list(_shapes(*hexagons))
    if equal:
        facts.append("all legs are equal")
    if None in hexagons:
        facts += _parallel(base, platform, slack)
    first, second = hexagons
    exact = None if first is None or second is None or not equal else _exact(first, second, lengths, digit)
    if exact is None:
        return NearbyShape(tuple(facts))
    return NearbyShape(tuple(facts), form_rank(exact) < len(exact.distances), screws(exact))


@dataclass(frozen=True)
class _Hexagon:
    """A hexagon of equal angles: the sides p and q in turn, and the corner at which each joint stands."""

    p: float
    q: float
    corners: tuple[int, ...]
    slack: float

    @property
    def is_regular(self) -> bool:
        return abs(self.p - self.q) <= self.slack


def _sides(problem: ForwardProblem) -> tuple[list[Vector], list[Vector]]:
    return [leg.base for leg in problem.distances], [leg.platform for leg in problem.distances]


def _places(joints: Sequence[Vector], metric: Sequence[int]) -> list[Place]:
    """Relative to the centroid, in ordinary coordinates."""
    means = [sum(axis, Fraction(0)) / len(joints) for axis in zip(*joints, strict=True)]
    rows = ((sqrt(g) * float(x - m) for x, m, g in zip(joint, means, metric, strict=True)) for joint in joints)
    return [(x, y, z) for x, y, z in rows]


def _hexagon(places: Sequence[Place], slack: float) -> _Hexagon | None:
    """The hexagon of equal angles that six joints nearly are, in whatever order, or None."""
    radius = sqrt(sum(x * x + y * y + z * z for x, y, z in places) / len(places))
    plane = _in_plane(places)
    if plane is None or radius <= 2 * slack or any(abs(z) > slack for _, _, z in plane):
        return None
    if any(abs(hypot(x, y) - radius) > slack for x, y, _ in plane):
        return None
    order = sorted(range(6), key=lambda k: atan2(plane[k][1], plane[k][0]))
    angles = [atan2(plane[k][1], plane[k][0]) for k in order]
    steps = [(angles[(n + 1) % 6] - angles[n]) % (2 * pi) for n in range(6)]
    chords = [2 * radius * abs(sin(step / 2)) for step in steps]
    if any(abs(chords[n] - chords[n % 2]) > slack for n in range(6)) or min(chords) <= 2 * slack:
        return None
    corners = tuple(order.index(k) for k in range(6))
    return _Hexagon(sum(chords[0::2]) / 3, sum(chords[1::2]) / 3, corners, slack)


def _in_plane(places: Sequence[Place]) -> list[Place] | None:
    """Coordinates along two axes in the plane of the widest triangle of joints, and the distance from it."""
    triangles = ((_minus(b, a), _minus(c, a)) for a, b, c in combinations(places, 3))
    u, w = max(triangles, key=lambda sides: _size(_cross(*sides)))
    normal = _cross(u, w)
    if not _size(normal):
        return None
    u, normal = _unit(u), _unit(normal)
    v = _cross(normal, u)
    return [(_dot(place, u), _dot(place, v), _dot(place, normal)) for place in places]


def _shapes(base: _Hexagon | None, platform: _Hexagon | None) -> Iterator[str]:
    found = {"base": base, "platform": platform}
    for adjective, wanted in (("regular hexagon", True), ("hexagon of equal angles", False)):
        names = [name for name, shape in found.items() if shape is not None and shape.is_regular is wanted]
        if len(names) == 2:
            yield f"base and platform are {adjective.replace('hexagon', 'hexagons')}"
        elif names:
            yield f"the {names[0]} is a {adjective}"


def _parallel(base: Sequence[Place], platform: Sequence[Place], slack: float) -> Iterator[str]:
    """Pairings of the legs whose chords are parallel, in the base and in the platform."""
    for pairing in PAIRINGS:
        if _are_parallel(base, pairing, slack) and _are_parallel(platform, pairing, slack):
            chords = ", ".join(f"{i + 1}-{j + 1}" for i, j in pairing)
            yield f"the chords {chords} of base and platform are parallel"


def _are_parallel(places: Sequence[Place], pairing: Sequence[tuple[int, int]], slack: float) -> bool:
    chords = sorted((_minus(places[i], places[j]) for i, j in pairing), key=_size)
    longest = chords[-1]
    return _size(chords[0]) > 2 * slack and all(
        _size(_cross(chord, longest)) <= 2 * slack * _size(longest) for chord in chords[:-1]
    )


def _exact(base: _Hexagon, platform: _Hexagon, lengths: Sequence[float], digit: Fraction) -> ForwardProblem | None:
    """The robot of two exact hexagons and one leg length, similar if they are nearly so; lengths are rounded."""
    square = _rounded(sum(lengths) / len(lengths), digit) ** 2
    if not square:
        return None
    p, q = _rounded(base.p, digit), _rounded(base.q, digit)
    sides = p, p if base.is_regular else q
    corners = [
        [corners[corner] for corner in shape.corners]
        for shape, corners in (
            (base, semi_regular_hexagon(*sides)),
            (platform, semi_regular_hexagon(*_similar(platform, sides, digit))),
        )
    ]
    legs = tuple(Distance(a, b, square) for a, b in zip(*corners, strict=True))
    return ForwardProblem(legs, HEXAGON_METRIC)


def _similar(shape: _Hexagon, sides: tuple[Fraction, Fraction], digit: Fraction) -> tuple[Fraction, Fraction]:
    """The sides of a hexagon, a multiple of the given ones, in this or the other order, if they nearly are one."""
    p = _rounded(shape.p, digit)
    for first, second in (sides, sides[::-1]):
        if abs(shape.p * float(second) - shape.q * float(first)) <= shape.slack * float(first + second):
            return p, p * second / first
    return p, p if shape.is_regular else _rounded(shape.q, digit)


def _rounded(value: float, digit: Fraction) -> Fraction:
    return round(Fraction(value) / digit) * digit


def _minus(a: Place, b: Place) -> Place:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def _cross(a: Place, b: Place) -> Place:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _dot(a: Place, b: Place) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _size(a: Place) -> float:
    return sqrt(_dot(a, a))


def _unit(a: Place) -> Place:
    size = _size(a)
    return a[0] / size, a[1] / size, a[2] / size

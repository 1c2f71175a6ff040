"""The table ``[limits]`` of a model file. What a robot has no use for is refused, not ignored."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, Slide
from pkm_exact.geometry.fields import known_keys, list_field, required
from pkm_exact.geometry.kinds import Kind
from pkm_exact.geometry.limits import NAMES, Cones, Limits, Pair
from pkm_exact.geometry.rational import parse_positive, parse_rational, parse_vector
from pkm_exact.wording import shown

_WHERE: Final = "limits"


@dataclass(frozen=True)
class LimitedParts:
    """How many parts of each sort a robot has, for the table of its limits.

    Attributes
    ----------
    lengths, slides, angles : int
        Actuators of each sort.
    legs : int
        Legs or rods, from a base point to a platform point.
    standing : bool
        Whether the lower ends of the legs stand on the base; those on cranks turn with them.
    dimension : int
        Coordinates of a position.
    """

    lengths: int
    slides: int
    angles: int
    legs: int
    standing: bool
    dimension: int

    @staticmethod
    def of_kind(kind: Kind) -> LimitedParts:
        """Those of a robot with legs."""
        chain = kind.chain
        lengths, slides, angles = (kind.legs * (chain is found) for found in (None, Slide, Crank))
        standing = chain is not Crank
        return LimitedParts(lengths, slides, angles, kind.legs, standing=standing, dimension=kind.dimension)


def read_limits(table: object, parts: LimitedParts) -> Limits:
    """The limits in the table of that name.

    Examples
    --------
    >>> parts = LimitedParts(3, 0, 0, 3, standing=True, dimension=2)
    >>> read_limits({"lengths": [1, "5/2"], "position": [[0, 1], [0, 1]]}, parts).lengths[2]
    (Fraction(1, 1), Fraction(5, 2))
    """
    if not isinstance(table, dict):
        raise InputError(f"{_WHERE}: {shown(table)} is not a table; write [limits] and lengths = [1, 2] below it")
    known_keys(table, NAMES, _WHERE)
    if not table:
        raise InputError(f"{_WHERE}: is empty; give one of {', '.join(NAMES)}, or leave it out")
    found: dict[str, Any] = {}
    for key, read in _READERS.items():
        if key in table:
            found[key] = read(table[key], f"{_WHERE}.{key}", parts)
    return Limits(**found)


def _actuators(key: str, sort: str) -> Callable[[object, str, LimitedParts], tuple[Pair, ...]]:
    """The reader of the limits of one sort of actuators."""

    def read(value: object, where: str, parts: LimitedParts) -> tuple[Pair, ...]:
        count = getattr(parts, key)
        if not count:
            raise InputError(f"{where}: the robot has no actuated {sort}; remove it")
        return _pairs(value, where, count, positive=key == "lengths")

    return read


def _base_cones(value: object, where: str, parts: LimitedParts) -> Cones:
    if not parts.standing:
        raise InputError(f"{where}: the rods stand on cranks, whose joints turn with them; remove it")
    return _cones(value, where, parts)


def _leg_distance(value: object, where: str, parts: LimitedParts) -> Fraction:
    if parts.dimension == 2:
        raise InputError(f"{where}: the legs of a planar robot lie in parallel planes; remove it")
    if parts.legs < 2:
        raise InputError(f"{where}: there are not two legs; remove it")
    return parse_positive(value, where)


def _position(value: object, where: str, parts: LimitedParts) -> tuple[Pair, ...]:
    rows = list_field(value, where, parts.dimension)
    if len(rows) != parts.dimension:
        raise InputError(f"{where}: {len(rows)} pairs; give {parts.dimension}, one per coordinate")
    return tuple(_pair(row, f"{where}[{i}]") for i, row in enumerate(rows, 1))


def _pairs(value: object, where: str, count: int, *, positive: bool) -> tuple[Pair, ...]:
    """One pair for all, or one for each."""
    rows = list_field(value, where, count)
    if not any(isinstance(row, list) for row in rows):
        return (_pair(rows, where, positive=positive),) * count
    if len(rows) != count:
        raise InputError(f"{where}: {len(rows)} pairs; give one for all, or {count}")
    return tuple(_pair(row, f"{where}[{i}]", positive=positive) for i, row in enumerate(rows, 1))


def _pair(row: object, where: str, *, positive: bool = False) -> Pair:
    if not isinstance(row, list) or len(row) != 2:
        raise InputError(f"{where}: {shown(row)} is not a pair; give [least, greatest]")
    least, greatest = (parse_rational(value, f"{where}[{i}]") for i, value in enumerate(row, 1))
    if least > greatest:
        raise InputError(f"{where}: {shown(least)} is greater than {shown(greatest)}; give [least, greatest]")
    if positive and least < 0:
        raise InputError(f"{where}[1]: {shown(least)} is negative; a length is 0 or more")
    return least, greatest


def _cones(value: object, where: str, parts: LimitedParts) -> Cones:
    if not isinstance(value, dict):
        raise InputError(f"{where}: {shown(value)} is not a table; write {{ axes = [0, 0, 1], angle = 45 }}")
    known_keys(value, ("axes", "angle"), where)
    rows = list_field(required(value, "axes", f"{where}."), f"{where}.axes", parts.legs)
    one = not any(isinstance(row, list) for row in rows)
    if not one and len(rows) != parts.legs:
        raise InputError(
            f"{where}.axes: {len(rows)} vector{'s' * (len(rows) != 1)}; give {parts.legs}, or one for all without the "
            f"outer brackets, as [{', '.join('0' * (parts.dimension - 1))}, 1]"
        )
    axes = [
        parse_vector(row, f"{where}.axes" if one else f"{where}.axes[{i}]", parts.dimension)
        for i, row in enumerate([rows] if one else rows, 1)
    ]
    for i, axis in enumerate(axes, 1):
        if not any(axis):
            raise InputError(f"{where}.axes[{i}]: is 0; give a direction that is not")
    given = required(value, "angle", f"{where}.")
    angles = given if isinstance(given, list) else [given]
    if len(angles) not in (1, parts.legs):
        raise InputError(f"{where}.angle: {len(angles)} angles; give one for all, or {parts.legs}")
    degrees = [_cone_angle(angle, f"{where}.angle") for angle in angles]
    return Cones(tuple(axes) * (parts.legs if one else 1), tuple(degrees) * (parts.legs // len(degrees)))


def _cone_angle(value: object, where: str) -> Fraction:
    angle = parse_rational(value, where)
    if not 0 < angle <= 180:
        raise InputError(f"{where}: {shown(value)} is out of range; give degrees, more than 0 and at most 180")
    return angle


_READERS: Final[dict[str, Callable[[object, str, LimitedParts], Any]]] = {
    "lengths": _actuators("lengths", "leg length"),
    "slides": _actuators("slides", "slide or offset"),
    "angles": _actuators("angles", "crank angle"),
    "base_cones": _base_cones,
    "platform_cones": lambda value, where, parts: _cones(value, where, parts),
    "leg_distance": _leg_distance,
    "position": _position,
}

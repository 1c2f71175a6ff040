"""The one spelling of a pose: exact bounds for certificates and JSON, decimals for what people read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

from pkm_exact.poses.pose import Pose
from pkm_exact.roots.interval import Interval, decimal


def ends(interval: Interval) -> list[str]:
    """Both ends, exactly.

    Examples
    --------
    >>> from fractions import Fraction
    >>> ends(Interval(Fraction(0), Fraction(1, 2)))
    ['0', '1/2']
    """
    cell = interval.cell
    if cell is None:
        return [str(interval.lo), str(interval.hi)]
    low, high, exponent = cell
    return [_dyadic(low, exponent), _dyadic(high, exponent)]


def _dyadic(value: int, exponent: int) -> str:
    """The value times 2^-exponent, as a fraction is written."""
    if value & 1 and exponent:
        return f"{value}{_below(exponent)}"
    twos = min((value & -value).bit_length() - 1, exponent) if value else exponent
    return f"{value >> twos}/{1 << exponent - twos}" if twos < exponent else str(value >> twos)


@lru_cache(maxsize=64)
def _below(exponent: int) -> str:
    """A denominator, which in an answer hundreds of ends have in common."""
    return f"/{1 << exponent}"


def pose_entry(pose: Pose) -> dict[str, Any]:
    """A pose as certificates and JSON output have it: the bounds of its box, and its multiplicity if it is proved."""
    return {
        "parameter": None if pose.parameter is None else ends(pose.parameter),
        "position": [ends(value) for value in pose.position],
        "rotation": [[ends(value) for value in row] for row in pose.rotation],
        "quaternion": [ends(value) for value in pose.quaternion],
        "multiplicity": pose.multiplicity,
    }


def pose_of(entry: Mapping[str, Any]) -> Pose:
    """The box of a pose from its entry, without what else is known of it."""
    x, y, z = map(_interval, entry["position"])
    q0, q1, q2, q3 = map(_interval, entry["quaternion"])
    rotation = tuple(tuple(map(_interval, row)) for row in entry["rotation"])
    return Pose(None, (x, y, z), rotation, (q0, q1, q2, q3))


def _interval(texts: Sequence[str]) -> Interval:
    return Interval(Fraction(texts[0]), Fraction(texts[1]))


def pose_decimals(pose: Pose) -> dict[str, list[str]]:
    """Position and quaternion as decimals whose last digit is right to within one unit."""
    return {
        "position": [decimal(value) for value in pose.position],
        "quaternion": [decimal(value) for value in pose.quaternion],
    }

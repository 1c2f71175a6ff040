"""Joints and metric of a robot as they are given: so many, exact, and no leg twice."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.kinds import Joints, Kind
from pkm_exact.geometry.rational import parse_vector
from pkm_exact.motions.motion import Motion
from pkm_exact.wording import shown


def parse_joints(rows: Sequence[object], where: str, kind: Kind) -> Joints:
    """As many vectors as the kind has legs; with third coordinate 0 if it is planar, where two are to be given."""
    if len(rows) != kind.legs:
        raise InputError(
            f"{where}: {len(rows)} rows; give {kind.legs} joints of {kind.dimension} coordinates, one per leg"
            f"{_other_count(len(rows), kind)}"
        )
    return tuple(parse_vector(row, f"{where}[{i}]", kind.dimension) for i, row in enumerate(rows, 1))


def _other_count(count: int, kind: Kind) -> str:
    """The kind that has so many legs, if machines with any number of legs have one."""
    chains = {"": "RPR", "cranks": "RRR", "slides": "PRR"} if kind.motion.is_planar else {"": "UPS"}
    chain = chains.get(kind.chain_table)
    return f', or write kind = "{count}-{chain}"' if chain and count > 1 else ""


def in_plane(row: object) -> object:
    """The row without the third coordinate 0 that joints of planar robots have once they are read."""
    if isinstance(row, tuple) and len(row) == 3 and isinstance(row[2], Fraction) and row[2] == 0:
        return row[:2]
    return row


def parse_metric(row: object, motion: Motion) -> Metric:
    """Three positive integers: the Gram diagonal. In place of p/q write p q, and divide that coordinate by q.

    For planar motions the third does not matter; it is 1 if it is left out.
    """
    numbers = []
    if motion.is_planar and isinstance(row, list | tuple) and len(row) == 2:
        row = [*row, 1]
    for i, number in enumerate(parse_vector(row, "metric"), 1):
        if number <= 0 or number.denominator != 1:
            raise InputError(f"metric[{i}]: {shown(number)} is not a positive integer; give one such as 1 or 3")
        numbers.append(number.numerator)
    g1, g2, g3 = numbers
    return g1, g2, g3


def refuse_equal_legs(base: Joints, platform: Joints, where: str = "base.joints and platform.joints") -> None:
    """Merged joints are legal (TSSM, MSSM robots); two legs between the same two points are one leg."""
    seen: dict[tuple[Vector, Vector], int] = {}
    for number, ends in enumerate(zip(base, platform, strict=True), 1):
        first = seen.setdefault(ends, number)
        if first != number:
            raise InputError(
                f"{where}: legs {first} and {number} join the same two points; give each leg its own pair of joints"
            )

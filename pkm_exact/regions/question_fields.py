"""Numbers in question files."""

from __future__ import annotations

from fractions import Fraction

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import list_field
from pkm_exact.geometry.limits import Pair
from pkm_exact.geometry.rational import parse_rational
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.wording import shown


def dimension(machine: RegionMachine) -> int:
    """Coordinates of a position."""
    return 2 if machine.motion == "planar" else 3


def read_pair(row: object, where: str) -> Pair:
    """Two numbers, the first less than the second."""
    values = read_numbers(row, where, 2)
    if values[0] >= values[1]:
        raise InputError(f"{where}: {shown(values[0])} is not less than {shown(values[1])}; give [least, greatest]")
    return values[0], values[1]


def read_numbers(row: object, where: str, count: int) -> tuple[Fraction, ...]:
    """So many numbers, exactly."""
    rows = list_field(row, where, count)
    if len(rows) != count:
        raise InputError(f"{where}: {len(rows)} numbers; give {count}")
    return tuple(parse_rational(value, f"{where}[{i}]") for i, value in enumerate(rows, 1))

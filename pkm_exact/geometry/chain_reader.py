"""Tables of a model file that describe joints and actuated chains: [base], [platform], [cranks], [slides], [rods]."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Chain, Crank, Slide
from pkm_exact.geometry.fields import known_keys, list_field, required, table_field
from pkm_exact.geometry.hexagons import HEXAGON_METRIC, semi_regular_hexagon
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.kinds import KINDS, Joints
from pkm_exact.geometry.problem import Vector
from pkm_exact.geometry.rational import parse_positive, parse_vector
from pkm_exact.geometry.robot import LEGS, parse_joints
from pkm_exact.wording import shown

CHAIN_TABLES: Final = ("cranks", "slides", "rods")
_RODS: Final = ("length", "lengths", "lengths_squared")


def read_joints(table: dict[str, Any], key: str, metric: Metric) -> Joints:
    """The six joints of ``[base]`` or ``[platform]``, as coordinates or as a semi-regular hexagon."""
    value = table_field(table, key, "joints = [...]")
    known_keys(value, ("joints", "hexagon"), key)
    if "hexagon" not in value:
        rows = list_field(required(value, "joints", f"{key}."), f"{key}.joints", LEGS)
        return parse_joints(rows, f"{key}.joints")
    where = f"{key}.hexagon"
    if "joints" in value:
        raise InputError(f"{key}: joints and hexagon given; give one of them")
    hexagon = value["hexagon"]
    if not isinstance(hexagon, dict):
        raise InputError(f"{where}: {shown(hexagon)} is not a table; write {{ sides = [4, 1], height = 0 }}")
    known_keys(hexagon, ("sides", "height"), where)
    if metric != HEXAGON_METRIC:
        raise InputError(f"{where}: its corners are rational only in the metric [1, 3, 1]; write metric = [1, 3, 1]")
    sides = list_field(required(hexagon, "sides", f"{where}."), f"{where}.sides", 2)
    if len(sides) != 2:
        raise InputError(f"{where}.sides: {len(sides)} numbers; give 2, the lengths of sides 1-2 and 2-3")
    try:
        return semi_regular_hexagon(sides[0], sides[1], hexagon.get("height", 0))
    except InputError as error:
        raise InputError(f"{where}.{error}") from None


def read_chains(table: dict[str, Any], kind: str) -> tuple[Chain, ...]:
    """The six cranks or slides of a kind that has them."""
    wanted = KINDS[kind].chain_table
    for key in CHAIN_TABLES:
        if key in table and key not in (wanted, "rods" if wanted else ""):
            raise InputError(f"{key}: a {kind} robot has none; remove the table or write another kind")
    if not wanted:
        return ()
    rods = _rods(table_field(table, "rods", "lengths = [...]"))
    if wanted == "cranks":
        cranks = table_field(table, "cranks", "at_0 = [...] and at_90 = [...]")
        known_keys(cranks, ("at_0", "at_90"), "cranks")
        pairs = zip(_vectors(cranks, "cranks", "at_0"), _vectors(cranks, "cranks", "at_90"), rods, strict=True)
        return tuple(Crank(at_0, at_90, rod) for at_0, at_90, rod in pairs)
    slides = table_field(table, "slides", "directions = [...]")
    known_keys(slides, ("direction", "directions"), "slides")
    if len(slides) != 1:
        found = "both" if slides else "none of them"
        raise InputError(f"slides: {found} given; give exactly one of direction, directions")
    if "direction" in slides:
        common = parse_vector(slides["direction"], "slides.direction")
        return tuple(Slide(common, rod) for rod in rods)
    directions = _vectors(slides, "slides", "directions")
    return tuple(Slide(direction, rod) for direction, rod in zip(directions, rods, strict=True))


def _vectors(table: dict[str, Any], name: str, key: str) -> tuple[Vector, ...]:
    where = f"{name}.{key}"
    rows = list_field(required(table, key, f"{name}."), where, LEGS)
    if len(rows) != LEGS:
        raise InputError(f"{where}: {len(rows)} rows; give {LEGS} vectors of 3 coordinates, one per leg")
    return tuple(parse_vector(row, f"{where}[{i}]") for i, row in enumerate(rows, 1))


def _rods(table: dict[str, Any]) -> tuple[Fraction, ...]:
    """Squared lengths of the six rods."""
    known_keys(table, _RODS, "rods")
    given = [key for key in _RODS if key in table]
    if len(given) != 1:
        raise InputError(f"rods: {' and '.join(given) or 'none of them'} given; give exactly one of {', '.join(_RODS)}")
    key = given[0]
    where = f"rods.{key}"
    if key == "length":
        return (parse_positive(table[key], where) ** 2,) * LEGS
    values = list_field(table[key], where, LEGS)
    if len(values) != LEGS:
        raise InputError(f"{where}: {len(values)} values; give {LEGS}, one per leg")
    numbers = [parse_positive(value, f"{where}[{i}]") for i, value in enumerate(values, 1)]
    return tuple(n * n if key == "lengths" else n for n in numbers)

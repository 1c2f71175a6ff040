"""Tables of a model file that describe joints and actuated chains: [base], [platform], [cranks], [slides], [rods]."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Chain, Crank, Slide
from pkm_exact.geometry.exact_cranks import exact_crank
from pkm_exact.geometry.fields import known_keys, list_field, required, table_field
from pkm_exact.geometry.hexagons import HEXAGON_METRIC, semi_regular_hexagon
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.joints import parse_joints
from pkm_exact.geometry.kinds import Joints, Kind
from pkm_exact.geometry.planar_rotation import quarter_turn
from pkm_exact.geometry.rational import parse_positive, parse_vector
from pkm_exact.geometry.written_digits import finest_digit
from pkm_exact.wording import shown

CHAIN_TABLES: Final = ("cranks", "slides", "rods")
_RODS: Final = ("length", "lengths", "lengths_squared")


def read_joints(table: dict[str, Any], key: str, kind: Kind, metric: Metric) -> Joints:
    """The joints of ``[base]`` or ``[platform]``, as coordinates or, for six, as a semi-regular hexagon.

    If the platform has a tool point, from there: it is then the point whose position a pose is given by.
    """
    value = table_field(table, key, "joints = [...]")
    has_tool = key == "platform" and "tool" in value
    joints = _joints(value, key, kind, metric)
    if not has_tool:
        return joints
    x, y, z = parse_vector(value["tool"], "platform.tool", kind.dimension)
    return tuple((a - x, b - y, c - z) for a, b, c in joints)


def _joints(value: dict[str, Any], key: str, kind: Kind, metric: Metric) -> Joints:
    forms = ("joints",) if kind.motion.is_planar else ("joints", "hexagon")
    known_keys(value, (*forms, "tool") if key == "platform" else forms, key)
    if "hexagon" not in value:
        rows = list_field(required(value, "joints", f"{key}."), f"{key}.joints", kind.legs)
        return parse_joints(rows, f"{key}.joints", kind)
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


def read_chains(table: dict[str, Any], name: str, kind: Kind, metric: Metric) -> tuple[Chain, ...]:
    """The cranks or slides, one per leg, of a kind (called ``name``) that has them."""
    wanted = kind.chain_table
    for key in CHAIN_TABLES:
        if key in table and key not in (wanted, "rods" if wanted else ""):
            raise InputError(f"{key}: a {name} robot has none; remove the table or write another kind")
    if not wanted:
        return ()
    rods = _rods(table_field(table, "rods", "lengths = [...]"), kind.legs)
    if wanted == "cranks":
        return _cranks(table, kind, metric, rods)
    slides = table_field(table, "slides", "directions = [...]")
    known_keys(slides, ("direction", "directions"), "slides")
    if len(slides) != 1:
        found = "both" if slides else "none of them"
        raise InputError(f"slides: {found} given; give exactly one of direction, directions")
    if "direction" in slides:
        common = parse_vector(slides["direction"], "slides.direction", kind.dimension)
        return tuple(Slide(common, rod) for rod in rods)
    directions = _vectors(slides, "slides", "directions", kind)
    return tuple(Slide(direction, rod) for direction, rod in zip(directions, rods, strict=True))


def _cranks(table: dict[str, Any], kind: Kind, metric: Metric, rods: tuple[Fraction, ...]) -> tuple[Crank, ...]:
    cranks = table_field(table, "cranks", "at_0 = [...] and at_90 = [...]")
    known_keys(cranks, ("at_0", "at_90"), "cranks")
    at_0 = _vectors(cranks, "cranks", "at_0", kind)
    if kind.motion.is_planar and "at_90" not in cranks:
        at_90 = tuple(quarter_turn(vector, metric, "cranks.at_0") for vector in at_0)
    else:
        at_90 = _vectors(cranks, "cranks", "at_90", kind)
    return tuple(Crank(*vectors) for vectors in zip(at_0, at_90, rods, strict=True))


def exact_cranks(table: dict[str, Any], chains: tuple[Chain, ...], metric: Metric) -> tuple[tuple[Chain, ...], str]:
    """Cranks written in decimals made exact, and a sentence that says so; as they are if they are exact or no such.

    Those that are not even nearly cranks stay as they are too, to be refused.
    """
    digit = finest_digit(table.get("cranks"))
    if digit is None or metric != UNIT_METRIC:
        return chains, ""
    found, changed, most = list(chains), [], Fraction(0)
    for place, crank in enumerate(chains):
        if isinstance(crank, Crank) and not crank.is_exact(metric):
            made = exact_crank(crank.at_0, crank.at_90, digit)
            if made is not None:
                found[place] = replace(crank, at_0=made[0], at_90=made[1])
                changed.append(str(place + 1))
                most = max(most, made[2])
    if not changed:
        return chains, ""
    legs = f"leg {changed[0]}" if len(changed) == 1 else f"legs {', '.join(changed)}"
    return tuple(found), (
        f"cranks, {legs}: at_0 and at_90 are not exactly perpendicular and equally long as written; exact vectors "
        f"stand in for them, whose coordinates differ by at most {float(most):.1g}, and what is proved is proved for "
        "those"
    )


def _vectors(table: dict[str, Any], name: str, key: str, kind: Kind) -> tuple[Vector, ...]:
    where = f"{name}.{key}"
    rows = list_field(required(table, key, f"{name}."), where, kind.legs)
    if len(rows) != kind.legs:
        raise InputError(
            f"{where}: {len(rows)} rows; give {kind.legs} vectors of {kind.dimension} coordinates, one per leg"
        )
    return tuple(parse_vector(row, f"{where}[{i}]", kind.dimension) for i, row in enumerate(rows, 1))


def _rods(table: dict[str, Any], legs: int) -> tuple[Fraction, ...]:
    """Squared lengths of the rods."""
    known_keys(table, _RODS, "rods")
    given = [key for key in _RODS if key in table]
    if len(given) != 1:
        raise InputError(f"rods: {' and '.join(given) or 'none of them'} given; give exactly one of {', '.join(_RODS)}")
    key = given[0]
    where = f"rods.{key}"
    if key == "length":
        return (parse_positive(table[key], where) ** 2,) * legs
    values = list_field(table[key], where, legs)
    if len(values) != legs:
        raise InputError(f"{where}: {len(values)} values; give {legs}, one per leg")
    numbers = [parse_positive(value, f"{where}[{i}]") for i, value in enumerate(values, 1)]
    return tuple(n * n if key == "lengths" else n for n in numbers)

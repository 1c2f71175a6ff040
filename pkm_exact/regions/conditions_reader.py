"""The table ``[conditions]`` of question files."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, list_field, required
from pkm_exact.geometry.rational import parse_positive
from pkm_exact.regions.index_quotients import INDEX_NAMES
from pkm_exact.regions.question_fields import read_numbers
from pkm_exact.regions.region_conditions import CONDITIONS, Conditions
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.wording import shown

VALUED: Final = ("working_modes", "indices", "length", "forces")
"""Keys whose values are not true or false."""


def read_conditions(table: dict[str, Any], machine: RegionMachine) -> Conditions:
    """What is asked of every pose.

    Raises
    ------
    InputError
        With field, value and remedy.
    """
    same = {"no_constraint_singularity": "no_type_2", "one_working_mode": "no_type_1"}
    known_keys(table, (*CONDITIONS, *same, *VALUED), "conditions")
    asked = set()
    for key, value in table.items():
        if key in VALUED:
            continue
        if not isinstance(value, bool):
            raise InputError(f"conditions.{key}: {shown(value)} is neither true nor false; write one of them")
        if value:
            asked.add(same.get(key, key))
    indices, length = _indices(table)
    load, most = _load(table, machine)
    if not asked and not indices and not load:
        raise InputError(f"conditions: nothing is asked; set one of {', '.join(CONDITIONS)} to true")
    names = tuple(name for name in CONDITIONS if name in asked)
    return Conditions(names, _modes(table, machine), indices, length, load, most)


def _modes(table: dict[str, Any], machine: RegionMachine) -> tuple[int, ...]:
    if "working_modes" not in table:
        return (0,) * len(machine.legs)
    words = list_field(table["working_modes"], "conditions.working_modes", len(machine.legs))
    if len(words) != len(machine.legs) or not all(word in ("+", "-") for word in words):
        raise InputError(
            f'conditions.working_modes: give {len(machine.legs)} signs, one for each leg, such as ["+", "-", "+"]'
        )
    return tuple(1 if word == "+" else -1 for word in words)


def _indices(table: dict[str, Any]) -> tuple[tuple[tuple[str, Fraction], ...], Fraction | None]:
    """Bounds of indices, and the length that turns are multiplied by."""
    length = parse_positive(table["length"], "conditions.length") if "length" in table else None
    given = table.get("indices", {})
    if not isinstance(given, dict):
        raise InputError(f"conditions.indices: {shown(given)} is not a table; write {{ transmission = 0.5 }}")
    known_keys(given, INDEX_NAMES, "conditions.indices")
    return tuple((name, parse_positive(given[name], f"conditions.indices.{name}")) for name in sorted(given)), length


def _load(table: dict[str, Any], machine: RegionMachine) -> tuple[tuple[Fraction, ...], Fraction]:
    """A load on the platform, and the greatest force that may bear it."""
    if "forces" not in table:
        return (), Fraction(0)
    given, count = table["forces"], len(machine.twist)
    if not isinstance(given, dict):
        raise InputError(f"conditions.forces: {shown(given)} is not a table; write {{ load = [..], most = 100 }}")
    known_keys(given, ("load", "most"), "conditions.forces")
    load = read_numbers(required(given, "load", "conditions.forces."), "conditions.forces.load", count)
    if not any(load):
        raise InputError("conditions.forces.load: is 0; give a force, or a moment")
    return load, parse_positive(required(given, "most", "conditions.forces."), "conditions.forces.most")

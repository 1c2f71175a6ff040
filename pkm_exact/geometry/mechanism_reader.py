"""Mechanisms in model files: ``kind = "constraints"``, with a table for each constraint.

What a table may hold follows from the type's own fields and their roles; nothing here knows a type by name, but for the
two spellings of a value that is a square, as ``length`` and ``length_squared``, and an angle in place of a product.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.constraint_types import CONSTRAINTS
from pkm_exact.constraints.form import SIZE
from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, label, list_field, required, table_field, truth
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.joints import parse_metric
from pkm_exact.geometry.limits_reader import LimitedParts, read_limits
from pkm_exact.geometry.mechanism import MOST_CONSTRAINTS, LockedValues, Mechanism
from pkm_exact.geometry.polar_vectors import PolarVector
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.geometry.rational import parse_positive, parse_rational, parse_vector
from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import MOTIONS, SPATIAL
from pkm_exact.wording import shown

_KEYS: Final = (
    *["schema", "name", "kind", "motion", "unit", "source", "metric", "constraints", "limits", "configurations"],
)
_SQUARED: Final = "_squared"


def read_mechanism(table: dict[str, Any], head: Mapping[str, str]) -> Mechanism:
    """The mechanism that the tables of a model file describe.

    Parameters
    ----------
    table : dict
        The whole file, of kind "constraints".
    head : mapping
        Name, unit and source, read already.
    """
    known_keys(table, _KEYS, "")
    motion = read_motion(table)
    metric = parse_metric(table["metric"], motion) if "metric" in table else UNIT_METRIC
    rows = _tables(table, "constraints", required=True)
    if len(rows) > MOST_CONSTRAINTS:
        raise InputError(f"constraints: {len(rows)} given; give 1 to {MOST_CONSTRAINTS}")
    found = [_constraint(row, f"constraints[{i}]", motion, metric) for i, row in enumerate(rows, 1)]
    actuated = tuple(constraint.name for constraint, is_actuated in found if is_actuated)
    constraints = tuple(constraint for constraint, _ in found)
    who = head["name"], head["unit"], head["source"]
    mechanism = Mechanism(*who, constraints, actuated, motion, metric)
    if "limits" in table:
        mechanism = replace(mechanism, limits=read_limits(table["limits"], limited_parts(mechanism)))
    rows = _tables(table, "configurations", required=False)
    locked = tuple(_configuration(row, f"configurations[{i}]", mechanism) for i, row in enumerate(rows, 1))
    return replace(mechanism, configurations=locked) if locked else mechanism


def limited_parts(mechanism: Mechanism) -> LimitedParts:
    """Lengths, slides and offsets, and cranks that are actuated, and the legs, which stand on the base or on drives."""
    sorts = list(map(mechanism.sort_of, mechanism.actuated))
    legs = sum(found.type == "distance" for found in mechanism.constraints)
    dimension = 2 if mechanism.motion.is_planar else 3
    lengths, slides, angles = (sorts.count(sort) for sort in ("lengths", "slides", "angles"))
    standing = not any(drive.is_crank for drive in mechanism.drives)
    return LimitedParts(lengths, slides, angles, legs, standing=standing, dimension=dimension)


def read_motion(table: dict[str, Any]) -> Motion:
    """The group of motions that a model file names; all rigid motions if it names none."""
    if "motion" not in table:
        return SPATIAL
    name = label(table, "motion", "")
    if name not in MOTIONS:
        raise InputError(f"motion: {shown(name)} is unknown; use one of: {', '.join(MOTIONS)}")
    return MOTIONS[name]


def _tables(table: dict[str, Any], key: str, *, required: bool) -> list[dict[str, Any]]:
    rows = table.get(key, [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        raise InputError(f"{key}: {shown(rows)} is not a list of tables; write [[{key}]] above each")
    if required and not rows:
        raise InputError(f"{key}: is missing; add a table [[{key}]] for each joint, leg or sensor")
    return rows


def _constraint(row: dict[str, Any], where: str, motion: Motion, metric: Metric) -> tuple[Constraint, bool]:
    """The constraint of a table, and whether it is actuated; then its value is 1 until a configuration sets it."""
    name = label(row, "name", f"{where}.")
    type_ = label(row, "type", f"{where}.")
    if type_ not in CONSTRAINTS:
        raise InputError(f"{where}.type: {shown(type_)} is unknown; use one of: {', '.join(CONSTRAINTS)}")
    found = CONSTRAINTS[type_]
    where = f"{where} ({shown(name)})"
    value = found.value_field
    spellings = () if value is None else value_keys(found)
    others = [field for field in found.fields if field != value]
    known_keys(row, ("name", "type", "actuated", *others, *spellings), where)
    is_actuated = truth(row, "actuated", where)
    if is_actuated and value is None:
        raise InputError(f"{where}.actuated: the type {type_} has no value that an actuator could set; remove it")
    data = {field: _field(row, field, found.fields[field], where, motion) for field in others}
    if value is not None:
        given = [key for key in spellings if key in row]
        if is_actuated and given:
            raise InputError(f"{where}.{given[0]}: is left to the configurations; remove it, or remove actuated")
        if not is_actuated and len(given) != 1:
            wanted = " or ".join(spellings)
            raise InputError(f"{where}: {' and '.join(given) or 'no value'} given; give {wanted}, or actuated = true")
        data[value] = Fraction(1)
    if value is not None and not is_actuated:
        written = row[given[0]]
        if isinstance(written, PolarVector) and value == "product":
            written = written.product(data["base"], data["platform"], metric)
        data[value] = _value(written, given[0], found, f"{where}.{given[0]}")
    built: Any = found
    return built(**data, name=name), is_actuated


def value_keys(found: type[Constraint]) -> tuple[str, ...]:
    """The keys that give the value of a type: for a square its root too.

    Examples
    --------
    >>> [value_keys(CONSTRAINTS[type_]) for type_ in ("distance", "in-plane")]
    [('length', 'length_squared'), ('offset',)]
    """
    value = found.value_field
    if value is None:
        return ()
    return (value.removesuffix(_SQUARED), value) if value.endswith(_SQUARED) else (value,)


def exact_value(value: object, found: type[Constraint], where: str, *, squared: bool = False) -> Fraction:
    """The value of a constraint from a number as files and command lines have it: a length, not its square.

    Raises
    ------
    InputError
        If it is no exact number, or not positive where it must be.
    """
    field = found.value_field or ""
    if found.fields[field] != Role.POSITIVE:
        return parse_rational(value, where)
    number = parse_positive(value, where)
    return number * number if field.endswith(_SQUARED) and not squared else number


def _value(value: object, key: str, found: type[Constraint], where: str) -> Fraction:
    return exact_value(value, found, where, squared=key.endswith(_SQUARED))


def _field(row: dict[str, Any], field: str, role: Role, where: str, motion: Motion) -> Any:
    value = required(row, field, f"{where}.")
    place = f"{where}.{field}"
    if role == Role.NUMBER:
        return parse_rational(value, place)
    if role == Role.COEFFICIENTS:
        numbers = list_field(value, place, SIZE)
        if len(numbers) != SIZE:
            raise InputError(f"{place}: {len(numbers)} numbers; give {SIZE}: of |C|^2, R^-1 C, C, R by rows, and 1")
        found = tuple(parse_rational(number, f"{place}[{i}]") for i, number in enumerate(numbers, 1))
        if not any(found[:-1]):
            raise InputError(f"{place}: all but the last are 0; give a form that depends on the pose")
        return found
    return parse_vector(value, place, 2 if motion.is_planar else 3)


def _configuration(row: dict[str, Any], where: str, mechanism: Mechanism) -> LockedValues:
    known_keys(row, ("name", "values", "values_squared", "pose"), where)
    name = label(row, "name", f"{where}.")
    where = f"{where} ({shown(name)})"
    if "pose" in row:
        if "values" in row or "values_squared" in row:
            raise InputError(f"{where}: pose and values given; give one of them")
        found = mechanism.values_at(*read_pose(row["pose"], f"{where}.pose", mechanism.motion, mechanism.metric))
        return LockedValues(name, tuple(found[constraint] for constraint in mechanism.actuated))
    types = {constraint.name: type(constraint) for constraint in mechanism.constraints}
    values: dict[str, Fraction] = {}
    for key in ("values", "values_squared"):
        given = table_field(row, key, 'values = { "leg 1" = "13/10" }') if key in row else {}
        for constraint, value in given.items():
            place = f"{where}.{key}.{shown(constraint)}"
            if constraint not in mechanism.actuated:
                known = ", ".join(mechanism.actuated) or "none"
                raise InputError(f"{place}: is not an actuated constraint; the actuated ones are: {known}")
            if constraint in values:
                raise InputError(f"{place}: is in values too; give it once")
            if key == "values_squared" and not (types[constraint].value_field or "").endswith(_SQUARED):
                raise InputError(f"{place}: {types[constraint].type} has no squared value; give it in values")
            values[constraint] = exact_value(value, types[constraint], place, squared=key == "values_squared")
    missing = [constraint for constraint in mechanism.actuated if constraint not in values]
    if missing:
        raise InputError(f"{where}.values: {', '.join(missing)} missing; give a value for every actuated constraint")
    return LockedValues(name, tuple(values[constraint] for constraint in mechanism.actuated))

"""Configurations of a model file: locked actuators by name, as lengths, joint values or a pose."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Any

from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn, angle_in_degrees
from pkm_exact.geometry.chains import JointValue, cosine_and_sine, parse_cosine_and_sine
from pkm_exact.geometry.fields import known_keys, label, list_field, truth
from pkm_exact.geometry.inverse import distance_squared
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.pose_reader import read_pose
from pkm_exact.geometry.rational import MAX_COMPUTED_DIGITS, bounded, parse_positive, parse_rational
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.wording import shown


def read_configuration(row: dict[str, Any], where: str, robot: Robot) -> Configuration:
    """The configuration that a table describes, for a robot of known kind."""
    kind = KINDS[robot.kind]
    keys = kind.joint_keys
    known_keys(row, ("name", *keys, *(("exact",) if "degrees" in keys else ())), where)
    name = label(row, "name", f"{where}.")
    given = [key for key in keys if key in row]
    if len(given) != 1:
        found = " and ".join(given) or "none of them"
        wanted = f"exactly one of {', '.join(keys)}" if len(keys) > 1 else keys[0]
        raise InputError(f"{where} ({shown(name)}): {found} given; give {wanted}")
    key = given[0]
    field = f"{where}.{key}"
    if key == "pose":
        return Configuration(name, _lengths_squared_at(row[key], field, robot))
    values = list_field(row[key], field, kind.legs)
    if len(values) != kind.legs:
        raise InputError(f"{field}: {len(values)} values; give {kind.legs}, one per leg")
    if robot.chains:
        exact = truth(row, "exact", where)
        locked = [_joint_value(key, value, f"{field}[{i}]", exact=exact) for i, value in enumerate(values, 1)]
        stand_ins = tuple(
            replace(entry, name=f"leg {i}") for i, (_, entry) in enumerate(locked, 1) if entry is not None
        )
        try:
            return replace(robot.lock(name, [value for value, _ in locked]), stand_ins=stand_ins)
        except InputError as error:
            raise InputError(f"{where}: {error}") from None
    numbers = [parse_positive(value, f"{field}[{i}]") for i, value in enumerate(values, 1)]
    return Configuration(name, tuple(n * n if key == "lengths" else n for n in numbers))


def _joint_value(key: str, value: object, where: str, *, exact: bool) -> tuple[JointValue, StandIn | None]:
    if key == "cos_sin":
        return parse_cosine_and_sine(value, where), None
    if key == "degrees":
        return angle_in_degrees(value, where, exact=exact)
    number = parse_rational(value, where)
    return cosine_and_sine(number) if key == "half_tangents" else number, None


def _lengths_squared_at(pose: object, where: str, robot: Robot) -> tuple[Fraction, ...]:
    position, turn = read_pose(pose, where, KINDS[robot.kind].motion, robot.metric)
    squares = []
    for leg, (a, b) in enumerate(zip(robot.base_joints, robot.platform_joints, strict=True), 1):
        square = distance_squared(a, b, position, turn, robot.metric)
        if square == 0:
            raise InputError(f"{where}: leg {leg} has length 0 at this pose; give another pose")
        squares.append(bounded(square, square, f"{where}: the squared length of leg {leg}", MAX_COMPUTED_DIGITS))
    return tuple(squares)

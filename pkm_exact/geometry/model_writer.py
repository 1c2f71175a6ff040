"""A robot with legs, cranks or slides as the text of a model file, exactly: what is read back is the same robot."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import Crank, Slide
from pkm_exact.geometry.inverse import UNIT_METRIC
from pkm_exact.geometry.limits import Cones, Limits, Pair
from pkm_exact.geometry.nominal_pose import NominalPose
from pkm_exact.geometry.ordinary_pose import model_position, model_quaternion, quaternion_of
from pkm_exact.geometry.rational import finite_decimal, rational_root
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.geometry.tolerances import Tolerances

_NEAREST = Fraction(1, 10**12)


def robot_text(robot: Robot) -> str:
    """The text of a model file.

    In a metric with square roots a nominal pose, which only serves comparisons, is written to 1e-12.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot, robot_from_toml
    >>> robot = read_robot("models/3-rrr.toml")
    >>> robot_from_toml(robot_text(robot)) == robot
    True
    """
    return "\n\n".join("\n".join(part) for part in map(list, _parts(robot)) if part) + "\n"


def _parts(robot: Robot) -> Iterator[Iterator[str]]:
    yield _head(robot)
    yield _table("base", [("joints", _rows(robot, robot.base_joints))])
    yield _table("platform", [("joints", _rows(robot, robot.platform_joints))])
    yield from _chains(robot)
    if robot.tolerances is not None:
        yield _tolerances(robot.tolerances)
    if robot.limits is not None:
        yield _limits(robot, robot.limits)
    if robot.nominal is not None:
        yield _nominal(robot, robot.nominal)
    for configuration in robot.configurations:
        yield _configuration(robot, configuration)


def _head(robot: Robot) -> Iterator[str]:
    yield "schema = 1"
    for key in ("name", "kind", "unit", "source"):
        yield f"{key} = {json.dumps(getattr(robot, key), ensure_ascii=False)}"
    if robot.metric != UNIT_METRIC:
        yield f"metric = [{', '.join(map(str, robot.metric))}]"
    if robot.cables:
        yield "cables = true"


def _table(name: str, entries: Sequence[tuple[str, str]]) -> Iterator[str]:
    yield f"[{name}]"
    for key, value in entries:
        yield f"{key} = {value}"


def _chains(robot: Robot) -> Iterator[Iterator[str]]:
    if not robot.chains:
        return
    first = robot.chains[0]
    if isinstance(first, Slide):
        directions = [chain.direction for chain in robot.chains if isinstance(chain, Slide)]
        yield _table("slides", [("directions", _rows(robot, directions))])
    else:
        cranks = [chain for chain in robot.chains if isinstance(chain, Crank)]
        vectors = [("at_0", [c.at_0 for c in cranks]), ("at_90", [c.at_90 for c in cranks])]
        yield _table("cranks", [(key, _rows(robot, rows)) for key, rows in vectors])
    yield _table("rods", [("lengths_squared", _list([chain.rod_squared for chain in robot.chains]))])


def _tolerances(tolerances: Tolerances) -> Iterator[str]:
    return _table("tolerances", [(key, _number(getattr(tolerances, key))) for key in ("base", "platform", "lengths")])


def _limits(robot: Robot, limits: Limits) -> Iterator[str]:
    entries = []
    for key in limits.names:
        value = getattr(limits, key)
        if isinstance(value, Cones):
            text = f"{{ axes = {_rows(robot, value.axes, ', ')}, angle = {_list(value.angles)} }}"
        elif isinstance(value, Fraction):
            text = _number(value)
        else:
            text = _pairs(value)
        entries.append((key, text))
    return _table("limits", entries)


def _pairs(pairs: Sequence[Pair]) -> str:
    return f"[{', '.join(map(_list, pairs))}]"


def _nominal(robot: Robot, nominal: NominalPose) -> Iterator[str]:
    position = model_position(nominal.position, robot.metric, _NEAREST)
    quaternion = model_quaternion(quaternion_of(nominal.rotation), robot.metric, _NEAREST)
    if position is None or quaternion is None:
        return iter(())
    if robot.motion.is_planar:
        turn = ("half_tangent", _number(quaternion[3] / quaternion[0])) if quaternion[0] else ("cos_sin", "[-1, 0]")
        return _table("nominal", [("position", _list(position[:2])), turn])
    return _table("nominal", [("position", _list(position)), ("quaternion", _list(quaternion))])


def _configuration(robot: Robot, configuration: Configuration) -> Iterator[str]:
    yield "[[configurations]]"
    yield f"name = {json.dumps(configuration.name, ensure_ascii=False)}"
    if not robot.chains:
        lengths = [rational_root(square) for square in configuration.lengths_squared]
        known = [length for length in lengths if length is not None]
        if len(known) == len(lengths):
            yield f"lengths = {_list(known)}"
        else:
            yield f"lengths_squared = {_list(configuration.lengths_squared)}"
    elif isinstance(robot.chains[0], Slide):
        yield f"slides = {_list([v for v in configuration.joint_values if isinstance(v, Fraction)])}"
    else:
        pairs = [value for value in configuration.joint_values if isinstance(value, tuple)]
        yield f"cos_sin = {_pairs(pairs)}"


def _rows(robot: Robot, rows: Sequence[Vector], separator: str = ",\n    ") -> str:
    dimension = 2 if robot.motion.is_planar else 3
    lines = separator.join(_list(row[:dimension]) for row in rows)
    return f"[\n    {lines},\n]" if "\n" in separator else f"[{lines}]"


def _list(numbers: Sequence[Fraction]) -> str:
    return f"[{', '.join(map(_number, numbers))}]"


def _number(number: Fraction) -> str:
    """An integer, a decimal that ends and is not long, or a fraction in quotes."""
    decimal = finite_decimal(number)
    return decimal if decimal is not None and len(decimal) <= 20 else f'"{number}"'

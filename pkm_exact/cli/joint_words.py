"""Joint values on the command line as a configuration of a robot, which then has it under a name of its own."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Final

import click

from pkm_exact.cli.arguments import JointWord
from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import angle_in_degrees
from pkm_exact.geometry.chains import Crank, JointValue, cosine_and_sine
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.robot import Configuration, Robot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pkm_exact.geometry.angle_degrees import StandIn

NAME: Final = "joints given"


def joint_configuration(robot: Robot | Mechanism, words: Sequence[JointWord]) -> tuple[Robot | Mechanism, str]:
    """The robot with a further configuration at these joint values, and the configuration's name.

    What stands in for an angle that is not rational is noted on stderr.

    Raises
    ------
    InputError
        If the values do not fit the robot.
    """
    actuated = robot.actuated
    if len(words) != len(actuated):
        raise InputError(f"--joints: {len(words)} values; give {len(actuated)}, for {', '.join(actuated)}")
    if isinstance(robot, Mechanism):
        return _of_mechanism(robot, words)
    if not robot.chains:
        lengths = [_number(word, f"--joints, {name}") for word, name in zip(words, actuated, strict=True)]
        for length, name in zip(lengths, actuated, strict=True):
            if length <= 0:
                raise InputError(f"--joints, {name}: {length} is no length; give one greater than 0")
        locked = Configuration(NAME, tuple(length * length for length in lengths))
    else:
        cranks = isinstance(robot.chains[0], Crank)
        values = [_value(word, f"--joints, {name}", cranks) for word, name in zip(words, actuated, strict=True)]
        locked = robot.lock(NAME, values)
    return replace(robot, configurations=(*robot.configurations, locked)), NAME


def _of_mechanism(robot: Mechanism, words: Sequence[JointWord]) -> tuple[Mechanism, str]:
    values: list[JointValue] = []
    for word, name, is_length in zip(words, robot.actuated, robot.are_lengths, strict=True):
        drive, where = robot.drive(name), f"--joints, {name}"
        if drive is not None and drive.is_crank:
            values.append(_value(word, where, True, drive.weight))
            continue
        number = _number(word, where)
        if is_length and number <= 0:
            raise InputError(f"{where}: {number} is no length; give one greater than 0")
        values.append(number * number if is_length else number)
    locked = LockedValues(NAME, tuple(values))
    return replace(robot, configurations=(*robot.configurations, locked)), NAME


def _value(word: JointWord, where: str, is_crank: bool, weight: int = 1) -> JointValue:
    number, in_degrees = word
    if not is_crank:
        return _number(word, where)
    if not in_degrees:
        return cosine_and_sine(number, weight)
    point, stand_in = angle_in_degrees(number, where, weight)
    _say(stand_in)
    return point


def _number(word: JointWord, where: str) -> Fraction:
    number, in_degrees = word
    if in_degrees:
        raise InputError(f"{where}: is no angle; give a number without deg")
    return number


def _say(stand_in: StandIn | None) -> None:
    if stand_in is not None:
        click.echo(f"note: {stand_in}", err=True)

"""Joint values as people write them, as a configuration of a robot, which then has it under a name of its own."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Final, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import angle_in_degrees
from pkm_exact.geometry.chains import Crank, JointValue, cosine_and_sine
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.rational import NumberText, parse_rational
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from pkm_exact.geometry.angle_degrees import StandIn

NAME: Final = "joints given"
JointWord: TypeAlias = tuple[Fraction, bool]
"""A joint value, and whether it is an angle in degrees."""


def joint_word(text: str, where: str) -> JointWord:
    """A number, exact, or one of degrees.

    Examples
    --------
    >>> joint_word("30deg", "h1"), joint_word("1/2", "h1")
    ((Fraction(30, 1), True), (Fraction(1, 2), False))
    """
    bare = text.removesuffix("deg").rstrip()
    if not bare:
        raise InputError(f"{where}: {shown(text)} is no joint value; give a number, or an angle such as 30deg")
    return parse_rational(bare if "/" in bare else NumberText(bare), where), bare != text


def joint_configuration(
    robot: Robot | Mechanism, words: Sequence[JointWord], where: str, said: Callable[[StandIn], None] | None = None
) -> tuple[Robot | Mechanism, str]:
    """The robot with a further configuration at these joint values, and the configuration's name.

    Parameters
    ----------
    robot : Robot or Mechanism
    words : sequence of JointWord
    where : str
        What messages begin with.
    said : callable, optional
        Gets what stands in for an angle that is not rational.

    Raises
    ------
    InputError
        If the values do not fit the robot.
    """
    actuated = robot.actuated
    if len(words) != len(actuated):
        raise InputError(f"{where}: {len(words)} values; give {len(actuated)}, for {', '.join(actuated)}")
    if isinstance(robot, Mechanism):
        return _of_mechanism(robot, words, where, said)
    if not robot.chains:
        lengths = [_number(word, f"{where}, {name}") for word, name in zip(words, actuated, strict=True)]
        for length, name in zip(lengths, actuated, strict=True):
            if length <= 0:
                raise InputError(f"{where}, {name}: {length} is no length; give one greater than 0")
        locked = Configuration(NAME, tuple(length * length for length in lengths))
    else:
        cranks = isinstance(robot.chains[0], Crank)
        values = [_value(word, f"{where}, {name}", said, cranks) for word, name in zip(words, actuated, strict=True)]
        locked = robot.lock(NAME, values)
    return replace(robot, configurations=(*robot.configurations, locked)), NAME


def _of_mechanism(
    robot: Mechanism, words: Sequence[JointWord], where: str, said: Callable[[StandIn], None] | None
) -> tuple[Mechanism, str]:
    values: list[JointValue] = []
    for word, name, is_length in zip(words, robot.actuated, robot.are_lengths, strict=True):
        drive, place = robot.drive(name), f"{where}, {name}"
        if drive is not None and drive.is_crank:
            values.append(_value(word, place, said, True, drive.weight))
            continue
        number = _number(word, place)
        if is_length and number <= 0:
            raise InputError(f"{place}: {number} is no length; give one greater than 0")
        values.append(number * number if is_length else number)
    locked = LockedValues(NAME, tuple(values))
    return replace(robot, configurations=(*robot.configurations, locked)), NAME


def _value(
    word: JointWord, where: str, said: Callable[[StandIn], None] | None, is_crank: bool, weight: int = 1
) -> JointValue:
    number, in_degrees = word
    if not is_crank:
        return _number(word, where)
    if not in_degrees:
        return cosine_and_sine(number, weight)
    point, stand_in = angle_in_degrees(number, where, weight)
    if stand_in is not None and said is not None:
        said(stand_in)
    return point


def _number(word: JointWord, where: str) -> Fraction:
    number, in_degrees = word
    if in_degrees:
        raise InputError(f"{where}: is no angle; give a number without deg")
    return number

"""Joint values as people write them, as a configuration of a robot, which then has it under a name of its own."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import atan2, degrees, sqrt
from typing import TYPE_CHECKING, Final, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import angle_in_degrees
from pkm_exact.geometry.chains import CosSin, Crank, JointValue, cosine_and_sine
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.rational import NumberText, finite_decimal, parse_rational
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.wording import counted, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pkm_exact.geometry.angle_degrees import StandIn
    from pkm_exact.geometry.machine import Machine

NAME: Final = "joints given"
JointWord: TypeAlias = tuple[Fraction, bool]
"""A joint value, and whether it is an angle in degrees."""
LIKELY_DEGREES: Final = 5
"""A half tangent above it, of an angle of more than 157 degrees, may have been meant as degrees."""


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
    robot: Robot | Mechanism, words: Sequence[JointWord], where: str
) -> tuple[Robot | Mechanism, str]:
    """The robot with a further configuration at these joint values, and the configuration's name.

    What stands in for an angle that is not rational, and that a large half tangent was perhaps meant as degrees, are
    among the ``stand_ins`` of the configuration.

    Parameters
    ----------
    robot : Robot or Mechanism
    words : sequence of JointWord
    where : str
        What messages begin with.

    Raises
    ------
    InputError
        If the values do not fit the robot.
    """
    actuated = robot.actuated
    if len(words) != len(actuated):
        raise InputError(f"{where}: {len(words)} values; give {len(actuated)}, for {', '.join(actuated)}")
    if isinstance(robot, Mechanism):
        return _of_mechanism(robot, words, where)
    if not robot.chains:
        lengths = [_number(word, f"{where}, {name}") for word, name in zip(words, actuated, strict=True)]
        for length, name in zip(lengths, actuated, strict=True):
            if length <= 0:
                raise InputError(f"{where}, {name}: {length} is no length; give one greater than 0")
        locked = Configuration(NAME, tuple(length * length for length in lengths))
    else:
        found: list[tuple[JointValue, StandIn | str | None]] = [
            (_number(word, f"{where}, {name}"), None) if weight is None else _angle(word, f"{where}, {name}", weight)
            for word, name, weight in zip(words, actuated, crank_weights(robot), strict=True)
        ]
        stand_ins = _together([note for _, note in found if note is not None])
        locked = replace(robot.lock(NAME, [value for value, _ in found]), stand_ins=stand_ins)
    return replace(robot, configurations=(*robot.configurations, locked)), NAME


def _together(notes: Sequence[StandIn | str]) -> tuple[StandIn | str, ...]:
    """What is to be known of joint values; that half tangents are large once for all of them."""
    large = [note for note in notes if isinstance(note, str)]
    others = [note for note in notes if not isinstance(note, str)]
    if len(large) > 1:
        large = [f"{large[0]}; so of {counted(len(large) - 1, 'other joint')}"]
    return (*large, *others)


def crank_weights(robot: Machine) -> tuple[int | None, ...]:
    """For each actuator the weight w of its circle c^2 + w s^2 = 1 if it is a crank, otherwise None.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> crank_weights(Robot.load("models/3-rrr.toml")), crank_weights(Robot.load("models/3-rpr-merlet-p.toml"))
    ((1, 1, 1), (None, None, None))
    """
    if isinstance(robot, Mechanism):
        drives = [robot.drive(name) for name in robot.actuated]
        return tuple(drive.weight if drive is not None and drive.is_crank else None for drive in drives)
    is_crank = isinstance(robot, Robot) and bool(robot.chains) and isinstance(robot.chains[0], Crank)
    return tuple(1 if is_crank else None for _ in robot.actuated)


def half_tangent_on_path(word: JointWord, where: str, weight: int | None) -> tuple[Fraction, StandIn | str | None]:
    """The half tangent of a crank on a path, or the value of another actuator; and what is to be known of it.

    A path is straight in half tangents, so that it never comes to 180 degrees.

    Examples
    --------
    >>> half_tangent_on_path((Fraction(90), True), "line 1, h1", 1)
    (Fraction(1, 1), None)
    """
    number, in_degrees = word
    if weight is None:
        return _number(word, where), None
    if in_degrees and abs(number) >= 180:
        raise InputError(
            f"{where}: {number} degrees; give an angle between -180 and 180, as a path, which is straight in half "
            "tangents, does not come to 180"
        )
    (c, s), note = _angle(word, where, weight)
    return s / (1 + c), note


def _of_mechanism(robot: Mechanism, words: Sequence[JointWord], where: str) -> tuple[Mechanism, str]:
    values: list[JointValue] = []
    stand_ins: list[StandIn | str] = []
    for word, name, is_length, weight in zip(
        words, robot.actuated, robot.are_lengths, crank_weights(robot), strict=True
    ):
        place = f"{where}, {name}"
        if weight is not None:
            value, note = _angle(word, place, weight)
            values.append(value)
            stand_ins += [] if note is None else [note]
            continue
        number = _number(word, place)
        if is_length and number <= 0:
            raise InputError(f"{place}: {number} is no length; give one greater than 0")
        values.append(number * number if is_length else number)
    locked = LockedValues(NAME, tuple(values), _together(stand_ins))
    return replace(robot, configurations=(*robot.configurations, locked)), NAME


def _angle(word: JointWord, where: str, weight: int) -> tuple[CosSin, StandIn | str | None]:
    """Cosine and sine of a crank, and what is to be known of them."""
    number, in_degrees = word
    if in_degrees:
        return angle_in_degrees(number, where, weight)
    large = _perhaps_degrees(number, where, weight) if abs(number) > LIKELY_DEGREES else None
    return cosine_and_sine(number, weight), large


def _perhaps_degrees(number: Fraction, where: str, weight: int) -> str:
    """That a large half tangent was taken as such; the angle is for show."""
    angle = degrees(2 * atan2(float(number) * sqrt(weight), 1))
    text = finite_decimal(number) or str(number)
    return f"{where}: {text} is taken as a half tangent, an angle of {angle:.4g} degrees; write {text}deg for degrees"


def _number(word: JointWord, where: str) -> Fraction:
    number, in_degrees = word
    if in_degrees:
        raise InputError(f"{where}: is no angle; give a number without deg")
    return number

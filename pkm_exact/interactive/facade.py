"""What ``Robot.solve`` is asked, made exact and handed to an engine; what is wrong with it is said before any work."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.mechanism import LockedValues
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rational import NumberText, parse_positive
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.policy import SMALLEST_WIDTH
from pkm_exact.wording import shown

METHODS: Final = ("exact", "krawczyk")


@dataclass(frozen=True)
class Question:
    """The arguments of ``Robot.solve`` that say what is to be solved, and how."""

    lengths: Any = None
    configuration: Configuration | LockedValues | str | None = None
    method: str = METHODS[0]
    formulation: str | None = None
    width: object = None
    squared: bool = False
    doubles_are_exact: bool = False


def posed(robot: Machine, question: Question) -> tuple[str | None, ForwardProblem]:
    """The name of the configuration, None if lengths are given, and the forward kinematics problem.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> posed(robot, Question(["12.5", 15, 12]))[1].distances[0].length_squared
    Fraction(625, 4)
    >>> posed(robot, Question([12.5, 15, 12]))
    Traceback (most recent call last):
    pkm_exact.errors.InputError: lengths, leg 1: 12.5 is a binary float, which is seldom the number that was meant; \
write "12.5" or Fraction(25, 2), or say doubles_are_exact=True if it is
    """
    if question.lengths is None:
        if question.squared or question.doubles_are_exact:
            raise InputError("lengths: squared and doubles_are_exact are about given lengths; give them as well")
        chosen = question.configuration
        if not isinstance(chosen, Configuration | LockedValues):
            chosen = robot.configuration(chosen)
        return chosen.name, robot.problem(chosen)
    if question.configuration is not None:
        raise InputError("lengths: a configuration has lengths of its own; give lengths or a configuration, not both")
    values = _lengths(robot, question)
    return None, robot.problem_at(values, squared=question.squared)


def _lengths(robot: Machine, question: Question) -> list[Fraction]:
    lengths = question.lengths
    if isinstance(lengths, str):
        raise InputError(
            f"lengths: {shown(lengths)} is a text; give a list of numbers, or configuration={shown(lengths)}"
        )
    if isinstance(robot, Robot) and robot.chains:
        names = ", ".join(shown(configuration.name) for configuration in robot.configurations) or "none"
        raise InputError(
            f"lengths: the rods of a {robot.kind} robot have fixed lengths; give a configuration, by its name (known: "
            f"{names}) or made by robot.lock(name, joint values)"
        )
    legs = len(robot.actuated)
    if isinstance(lengths, bytes | bytearray | Set | Mapping):
        raise InputError(
            f"lengths: {type(lengths).__name__} is no list of numbers in the order of the legs; give a list of {legs}"
        )
    try:
        values = list(lengths)
    except TypeError:
        raise InputError(f"lengths: {shown(lengths)} is no list; give a list of {legs} numbers, one per leg") from None
    if len(values) != legs:
        given = "1 number" if len(values) == 1 else f"{len(values)} numbers"
        raise InputError(f"lengths: {given} given, but a {robot.kind} robot has {legs} legs; give {legs}, one per leg")
    return [
        exact_length(value, f"lengths, leg {leg}", doubles_are_exact=question.doubles_are_exact)
        for leg, value in enumerate(values, 1)
    ]


def exact_length(value: object, where: str, *, doubles_are_exact: bool = False) -> Fraction:
    """A positive number, exactly; a float only if it is meant to be the rational number that it is in binary."""
    if not isinstance(value, str | int | float | Fraction) and getattr(value, "shape", None) == ():
        value = value.item()  # type: ignore[attr-defined]  # a number of numpy's
    if isinstance(value, float):
        if not isfinite(value):
            raise InputError(f"{where}: {value!r} is not a finite number; give one")
        if not doubles_are_exact:
            written = float(value)
            raise InputError(
                f"{where}: {written!r} is a binary float, which is seldom the number that was meant; write "
                f'"{written!r}" or {Fraction(repr(written))!r}, or say doubles_are_exact=True if it is'
            )
        value = Fraction(value)
    if isinstance(value, str) and "/" not in value:
        value = NumberText(value)  # with an exponent too, as on the command line
    return parse_positive(value, where)


def options(question: Question) -> dict[str, Any]:
    """The keyword arguments of the engine."""
    method = question.method
    found: dict[str, Any] = {}
    if method not in METHODS:
        remedy = f"use one of: {', '.join(METHODS)}"
        if method == "newton":
            remedy += "; its poses are uncertified, see pkm_exact.numeric.newton_iteration.solve_newton"
        raise InputError(f"method: {shown(method)} is unknown; {remedy}")
    if question.formulation is not None:
        if method != "exact":
            raise InputError("formulation: belongs to the method exact; leave it out or choose that method")
        if not isinstance(question.formulation, str):
            raise InputError(
                f"formulation: {shown(question.formulation)} is no code; use one of: {', '.join(formulation_codes())}"
            )
        found["formulation"] = question.formulation
    if question.width is not None:
        found["width"] = exact_width(question.width)
    return found


def exact_width(value: object) -> Fraction:
    """The width of boxes that a value denotes."""
    if isinstance(value, float) or hasattr(value, "dtype"):
        written = str(value)
        raise InputError(f'width: {written} is a binary float, not exact; write it as a string, "{written}"')
    width = exact_length(value, "width")
    if not SMALLEST_WIDTH <= width <= 1:
        raise InputError(f"width: {shown(value)} is out of range; give a number from 2^-4096 to 1")
    return width

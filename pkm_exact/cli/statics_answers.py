"""What the options of ``statics`` ask about a pose: loads, limits and stiffnesses, read from the command line."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import click

from pkm_exact.errors import InputError
from pkm_exact.statics.asked_answers import StaticsAnswers, asked_answers
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.forces import moved_load


def answers(
    at: AtPose, load: str | None, load_at: str | None, limits: Sequence[str], stiffness: str | None
) -> StaticsAnswers:
    """All that was asked for.

    Raises
    ------
    InputError
        If an option cannot be used at this pose.
    """
    given = given_limits(limits)
    if load_at is not None and load is None:
        raise click.UsageError("--load-at: belongs to --load, give that as well.")
    if not at.actuated and (given or load is not None or stiffness is not None):
        why = "no constraint is actuated; set actuated = true in the model, of a certificate give --model"
        raise InputError(f"--limits, --load, --stiffness: {why}")
    if not at.actuated:
        return asked_answers(at, {})
    return asked_answers(
        at,
        given,
        None if load is None else _load(at, load, load_at),
        None if stiffness is None else _stiffnesses(at, stiffness),
    )


def given_limits(words: Sequence[str]) -> dict[str, Any]:
    """What --limits denotes: KEY=NUMBER or KEY=NUMBER,NUMBER,.."""
    found: dict[str, Any] = {}
    for word in words:
        key, equals, values = word.partition("=")
        if not equals or not values:
            raise click.UsageError(f"--limits: {word!r} is not KEY=VALUES; write speeds=1/2 or forces=1,2,3.")
        if key in found:
            raise click.UsageError(f"--limits: {key} is given twice, give it once.")
        found[key] = [value.strip() for value in values.split(",")]
    return found


def _load(at: AtPose, text: str, where: str | None) -> list[Any]:
    """The load about the platform's origin, a component for each freedom."""
    from pkm_exact.cli.given_pose import numbers

    planar = at.motion.is_planar
    count = text.count(",") + 1
    wanted = (2, 3) if planar else (3, 6)
    if count not in wanted:
        raise click.UsageError(f"--load: {count} numbers given, {wanted[0]} or {wanted[1]} are needed between commas.")
    values = numbers(text, "--load", count)
    whole = [Fraction(0)] * 6
    places = (0, 1, 5) if planar else range(6)
    for place, value in zip(places, values, strict=False):
        whole[place] = value
    if where is not None:
        offset = numbers(where, "--load-at", 2 if planar else 3)
        whole = moved_load(whole, at.arm([*offset, Fraction(0)][:3]))
    for place, value in enumerate(whole):
        if place not in at.motion.twist and not (isinstance(value, Fraction) and value == 0):
            # Joints that are not declared bear it: the platform has no such motion.
            whole[place] = Fraction(0)
    return [whole[place] for place in at.motion.twist]


def _stiffnesses(at: AtPose, text: str) -> list[Fraction]:
    from pkm_exact.cli.given_pose import numbers

    count = text.count(",") + 1
    values = numbers(text, "--stiffness", count)
    if any(value <= 0 for value in values):
        raise click.UsageError("--stiffness: a number is not positive, give numbers greater than 0.")
    return values * len(at.actuated) if count == 1 else values

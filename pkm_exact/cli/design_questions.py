"""The design of a first model: from options, and from answers on the terminal where those are left out."""

from __future__ import annotations

import sys
from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli.circle_options import PARTS, circles, motor_direction, numbers, on_circle
from pkm_exact.errors import InputError
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.templates import DEFAULT_DECIMALS, MOST_DECIMALS
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.templates.design import Design

_SIDES: Final = {False: ("400,200", "100,300"), True: ("600,500,500", "160,100,100")}


ALIASES: Final = {"6-6": "6-UPS"}


def asked_design(given: dict[str, Any], *, interview: bool) -> Design:
    """The design that the options give, the rest asked for."""
    from pkm_exact.templates.design import Design, has_cranks, with_rods
    from pkm_exact.templates.layout import default_decimals

    kind = given["kind"]
    if interview:
        click.echo("A first model: a symmetric robot, to be changed by hand. Kinds:", err=True)
        for code in KINDS:
            click.echo(f"  {code}  {KINDS[code].description}", err=True)
        kind = ask("Kind", next(iter(KINDS)), click.Choice([*KINDS, *ALIASES]))
    kind = ALIASES.get(kind, kind)
    planar = KINDS[kind].motion.is_planar
    if interview:
        click.echo(_EXPLANATION[planar], err=True)
    pairs = circles(given, kind)
    if interview and has_cranks(kind) and not planar:
        _ask_for_arms(given, on_circles=pairs is not None)
    sides = [_sides(given, kind, part, default) for part, default in zip(PARTS, _SIDES[planar], strict=True)]
    height = _height(given, planar=planar)
    crank = None
    if has_cranks(kind):
        crank = _length(given["crank"], "--crank", "Length of the cranks", "150")
    elif given["crank"] is not None:
        raise click.UsageError(f"--crank: a {kind} robot has none; leave it out.")
    digits = given["digits"]
    if given["exact"]:
        digits = None
    elif digits is None and interview:
        digits = ask("Decimals to round the joints to, or exact", str(DEFAULT_DECIMALS), _digits)
    elif digits is None:
        digits = DEFAULT_DECIMALS if pairs else default_decimals((sides[0], sides[1]))
    turn = motor_direction(given, cranks_on_circles=pairs is not None and crank is not None)
    design = Design(kind, sides[0], sides[1], height, crank, digits, pairs, motor_direction=turn)
    return design if given["rod"] is None else with_rods(design, _length(given["rod"], "--rod", "", ""))


def _ask_for_arms(given: dict[str, Any], *, on_circles: bool) -> None:
    """Rods, or the height in their place, and how the motors stand, where that is not given."""
    if given["rod"] is None and given["height"] is None:
        rod = ask("Length of the rods, or 0 to give the height in its place", "0", str)
        given["rod"] = None if rod.strip() == "0" else rod
    if on_circles and given["motor_direction"] is None:
        given["motor_direction"] = ask(
            "Direction of the cranks at 0 degrees, from the tangent away from the other joint of the pair: 90 outward, "
            "180 towards it",
            "0",
            str,
        )


def _height(given: dict[str, Any], *, planar: bool) -> Fraction:
    """The height that is given or asked for; 1 if it follows from that of the rods."""
    if given["rod"] is None:
        return _length(given["height"], "--height", _HEIGHT[planar], "300" if planar else "500")
    if given["height"] is not None:
        raise click.UsageError("--height and --rod exclude each other: one follows from the other.")
    return Fraction(1)


def _digits(text: str) -> int | None:
    return None if text == "exact" else int(click.IntRange(0, MOST_DECIMALS)(text))


_EXPLANATION: Final = {
    False: (
        "Base and platform are hexagons of equal angles with two side lengths in turn:\nP for the sides 1-2, 3-4, 5-6 "
        "and Q for 2-3, 4-5, 6-1. Usually the base has its long\nsides where the platform has its short ones. One of "
        "them may be 0 (a triangle)."
    ),
    True: "Base and platform are triangles, given by their sides 1-2, 2-3, 3-1.",
}
_HEIGHT: Final = {
    False: "Height of the platform above the base at home",
    True: "Height (y) of the platform's joint 1 at home",
}


def _sides(given: dict[str, Any], kind: str, part: str, default: str) -> tuple[Fraction, ...]:
    from pkm_exact.templates.design import require_sides

    by_sides, circle = given[f"{part}_sides"], given[f"{part}_circle"]
    if given["platform_shift"] is not None:
        return ()
    if by_sides is not None and circle is not None:
        raise click.UsageError(f"--{part}-sides and --{part}-circle exclude each other.")
    if circle is not None:
        return on_circle(circle, kind, f"--{part}-circle")

    def sides(text: str) -> tuple[Fraction, ...]:
        given_sides = tuple(numbers(text, f"--{part}-sides"))
        require_sides(KINDS[kind], given_sides, f"--{part}-sides")
        return given_sides

    if by_sides is not None:
        return sides(by_sides)
    names = "A,B,C" if KINDS[kind].motion.is_planar else "P,Q"
    answer: tuple[Fraction, ...] = ask(f"Sides of the {part}, {names}", default, sides)
    return answer


def _length(text: str | None, option: str, question: str, default: str) -> Fraction:
    def length(text: str) -> Fraction:
        number = numbers(text, option)
        if len(number) != 1 or number[0] <= 0:
            raise click.UsageError(f"{option}: {shown(text)} is not a length; give one number greater than 0.")
        return number[0]

    return length(text) if text is not None else ask(question, default, length)


def can_ask() -> bool:
    """Whether somebody sits at a terminal."""
    return sys.stdin is not None and sys.stdin.isatty() and sys.stderr is not None and sys.stderr.isatty()


def ask(question: str, default: str, parse: Callable[[str], Any]) -> Any:
    """The answer, asked for on stderr until it can be used; an empty one is the default."""

    def value(text: str) -> Any:
        try:
            return parse(text)
        except InputError as error:
            raise click.UsageError(str(error)) from None

    return click.prompt(question, default=default, value_proc=value, err=True)

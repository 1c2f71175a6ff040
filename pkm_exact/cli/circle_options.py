"""Options of ``new`` that put joints on circles, by radius and angles in degrees."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.errors import InputError
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.templates.rings import Ring

PARTS: Final = ("base", "platform")
MOST_DIGITS: Final = 30
"""Of a number given here: more is no length of a machine."""


def circles(given: dict[str, Any], kind: str) -> tuple[Ring, Ring] | None:
    """Pairs of joints on circles, if the shift between them is given."""
    from pkm_exact.templates.rings import BOTTOM, Ring

    if given["platform_shift"] is None:
        if given["base_azimuth"] is not None:
            raise click.UsageError("--base-azimuth: needs --platform-shift too; 60 is that of the common hexapod.")
        return None
    if any(given[f"{part}_sides"] is not None or given[f"{part}_circle"] is None for part in PARTS):
        raise click.UsageError("--platform-shift: goes with --base-circle and --platform-circle; give both.")
    angles = [_one_number(given[key], f"--{key.replace('_', '-')}") for key in ("base_azimuth", "platform_shift")]
    azimuth, shift = angles[0] if angles[0] is not None else BOTTOM, angles[1] or Fraction(0)
    rows = [_radius_and_angle(given[f"{part}_circle"], kind, f"--{part}-circle") for part in PARTS]
    return Ring(*rows[0], azimuth), Ring(*rows[1], azimuth + shift)


def motor_direction(given: dict[str, Any], *, cranks_on_circles: bool) -> Fraction:
    """The angle of the cranks that is given; 0 if none is."""
    text = given["motor_direction"]
    if text is not None and not cranks_on_circles:
        raise click.UsageError(
            "--motor-direction: is for cranks on circles; give --crank and --platform-shift as well."
        )
    return _one_number(text, "--motor-direction") or Fraction(0)


def _one_number(text: str | None, option: str) -> Fraction | None:
    if text is None:
        return None
    found = numbers(text, option)
    if len(found) != 1 or abs(found[0]) > 360:
        raise click.UsageError(f"{option}: {shown(text)} is no angle; give one number of degrees from -360 to 360.")
    return found[0]


def on_circle(text: str, kind: str, option: str) -> tuple[Fraction, ...]:
    from pkm_exact.templates.layout import sides_on_circle

    return sides_on_circle(*_radius_and_angle(text, kind, option))


def _radius_and_angle(text: str, kind: str, option: str) -> tuple[Fraction, Fraction]:
    if KINDS[kind].motion.is_planar:
        raise click.UsageError(f"{option}: a {kind} robot is planar; give the sides of its triangles instead.")
    found = numbers(text, option)
    if len(found) != 2:
        raise click.UsageError(f"{option}: {len(found)} numbers given; give radius and angle, with a comma between.")
    radius, degrees = found
    if radius <= 0 or not 0 <= degrees <= 120:
        raise click.UsageError(f"{option}: {shown(text)} is out of range; give a radius, and an angle from 0 to 120.")
    return radius, degrees


def numbers(text: str, option: str) -> list[Fraction]:
    """Exact numbers with commas between."""
    from pkm_exact.geometry.rational import NumberText, bounded, parse_rational

    words = [word.strip() for word in text.split(",")]
    try:
        return [
            bounded(parse_rational(word if "/" in word else NumberText(word), option), word, option, MOST_DIGITS)
            for word in words
        ]
    except InputError as error:
        raise click.UsageError(str(error)) from None

"""A model file from a CSV file of joints, for ``new --csv``."""

from __future__ import annotations

import sys
from dataclasses import replace
from fractions import Fraction
from math import sqrt
from pathlib import Path
from typing import Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.circle_options import numbers
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.joint_arrays import describe_rounding, read_joints_csv
from pkm_exact.geometry.model_writer import robot_text
from pkm_exact.geometry.nominal_pose import NominalPose
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.templates.model_text import toml_number
from pkm_exact.wording import counted, printable

_NOT_WITH_CSV = (
    "base_sides",
    "platform_sides",
    "base_circle",
    "platform_circle",
    "platform_shift",
    "base_azimuth",
    "crank",
    "rod",
    "motor_direction",
)


_ZERO = Fraction(0)
_UNTURNED = (Fraction(1), _ZERO, _ZERO, _ZERO)


def write_from_csv(path: str, output: str | None, name: str | None, given: dict[str, Any]) -> int:
    """Write the model of the joints in a CSV file.

    Raises
    ------
    InputError
        If the file is no table of joints, or the robot is none.
    """
    for key in _NOT_WITH_CSV:
        if given[key] is not None:
            raise click.UsageError(f"--csv and --{key.replace('_', '-')} exclude each other.")
    if given["exact"]:
        raise click.UsageError("--csv and --exact exclude each other: numbers are taken as they are, or with --digits.")
    if output is None:
        raise click.UsageError("--csv: give -o MODEL.toml as well, or -o - for stdout.")
    base, platform, lengths = read_joints_csv(path, given["digits"])
    planar = len(base) == 3
    if len(base) not in (3, 6):
        raise InputError(f"{printable(path)}: {counted(len(base), 'row')}; give 6, one per leg, or 3 if it is planar")
    kind = "3-RPR" if planar else "6-UPS"
    if given["kind"] not in (None, kind, *(() if planar else ("6-6",))):
        raise click.UsageError(f"--csv: {len(base)} rows are those of a {kind} robot; leave --kind out.")
    if (lengths is None) == (given["height"] is None):
        raise click.UsageError("--csv: give either --height, where the platform is at home, or a column length.")
    squares = (
        _squares_at(base, platform, given["height"], planar)
        if lengths is None
        else tuple(length * length for length in lengths)
    )
    nominal = None if lengths is not None else NominalPose(_level(given["height"], planar), rotation_of(_UNTURNED))
    source = f"joints from {Path(path).name}, {describe_rounding(given['digits'])}"
    title = name or ("my robot" if output == "-" else Path(output).stem)
    robot = Robot(
        title,
        kind,
        given["unit"] or "mm",
        source,
        base,
        platform,
        configurations=(Configuration("home", squares),),
        nominal=nominal,
    )
    text = robot_text(robot) if nominal is None else _text_at(robot, nominal)
    if output == "-":
        sys.stdout.write(text)
        return ExitCode.DONE
    arguments.write_output(output, text.encode("utf-8"))
    click.echo(f"{printable(output)}: {kind}, {source}")
    click.echo(f"next: {PROGRAM} solve {printable(output)}")
    return ExitCode.DONE


def _text_at(robot: Robot, nominal: NominalPose) -> str:
    """The model with its configuration as the nominal pose, as people read it, and what may be given in its place."""
    planar = robot.motion.is_planar
    position = ", ".join(toml_number(x) for x in nominal.position[: 2 if planar else 3])
    turn = "half_tangent = 0" if planar else "quaternion = [1, 0, 0, 0]"
    squares = robot.configurations[0].lengths_squared
    lengths = ", ".join(f"{sqrt(square):.8g}" for square in squares)
    return f"""{robot_text(replace(robot, configurations=()))}
# The lengths that the legs have when the platform is level, at this position.
[[configurations]]
name = "home"
pose = {{ position = [{position}], {turn} }}

# Measured lengths, one per leg (here those of home, rounded):
# [[configurations]]
# name = "measured"
# lengths = [{lengths}]
"""


def _squares_at(base: Any, platform: Any, height: str, planar: bool) -> tuple[Fraction, ...]:
    """Squared leg lengths with the platform level at a height, or at y = height if it is planar."""
    position, rotation = _level(height, planar), rotation_of(_UNTURNED)
    squares = tuple(distance_squared(a, b, position, rotation) for a, b in zip(base, platform, strict=True))
    if 0 in squares:
        raise InputError(f"--height: leg {squares.index(0) + 1} would have length 0; give another height")
    return squares


def _level(height: str, planar: bool) -> Vector:
    """Where the platform is at home."""
    found = numbers(height, "--height")
    if len(found) != 1:
        raise click.UsageError("--height: give one number.")
    return (_ZERO, found[0], _ZERO) if planar else (_ZERO, _ZERO, found[0])

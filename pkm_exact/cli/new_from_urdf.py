"""A model file of bodies and joints from a URDF file, for ``new --urdf``."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import printable, shown

if TYPE_CHECKING:
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.geometry.urdf_closures import Closures
    from pkm_exact.geometry.urdf_reader import UrdfMechanism


def write_from_urdf(
    path: str,
    output: str | None,
    *,
    given: dict[str, Any],
    loops: str | None,
    platform: str | None,
    bodies: bool,
) -> int:
    """Write the model of the mechanism in a URDF file: a robot with six legs if it is one, otherwise bodies and joints.

    Raises
    ------
    InputError
        If the file is no URDF file, or has what such mechanisms do not have.
    """
    from pkm_exact.geometry.linkage_text import linkage_text
    from pkm_exact.geometry.model_writer import robot_text
    from pkm_exact.geometry.urdf_closures import read_closures
    from pkm_exact.geometry.urdf_reader import read_urdf

    for key, value in given.items():
        if value not in (None, False, ()):
            raise click.UsageError(f"--urdf and --{key.replace('_', '-')} exclude each other.")
    if output is None:
        raise click.UsageError("--urdf: give -o MODEL.toml as well, or -o - for stdout.")
    closures = None if loops is None else read_closures(loops)
    try:
        found = read_urdf(path, platform, closures)
        legged, words = (None, ()) if bodies else _legged(path, found, platform, closures)
    except InputError as error:
        text = str(error)
        raise InputError(text if text.startswith(path) else f"{path}: {text}") from None
    text = linkage_text(found.linkage) if legged is None else robot_text(legged)
    for note in (*found.notes, *words):
        click.echo(f"{PROGRAM}: note: {printable(path)}: {note}", err=True)
    if output == "-":
        sys.stdout.write(text)
        return ExitCode.DONE
    arguments.require_other_file(Path(output), path, "-o")
    if loops is not None:
        arguments.require_other_file(Path(output), loops, "-o")
    arguments.write_output(output, text.encode("utf-8"))
    linkage, file = found.linkage, printable(shlex.quote(output))
    if legged is None:
        click.echo(f"{printable(output)}: {len(linkage.bodies)} bodies, {len(linkage.joints)} joints")
        click.echo(f"next: {PROGRAM} mobility {file}")
    else:
        click.echo(f"{printable(output)}: six legs, kind {legged.kind}")
        click.echo(f"next: {PROGRAM} solve {file}")
    return ExitCode.DONE


def _legged(
    path: str, found: UrdfMechanism, platform: str | None, closures: Closures | None
) -> tuple[Robot | None, tuple[str, ...]]:
    """The robot with six legs that the mechanism is, if it is one, and what is to be said of that."""
    from pkm_exact.geometry.urdf_reader import read_urdf
    from pkm_exact.templates.legs_of_bodies import NoLegsError, legged_robot, platform_of_legs

    if platform is None:
        body = platform_of_legs(found.linkage)
        if body is None:
            return None, ()
        found = read_urdf(path, body, closures)
    try:
        robot, off = legged_robot(found.linkage, found.origin)
    except NoLegsError as error:
        return None, (f"is not recognised as one with six legs: {error}",)
    missed = f"axes miss the points of the legs by up to {off:.1e}"
    frame = (
        f"the platform is {shown(found.linkage.platform)}, its frame parallel to the base's in the pose of the file, "
        "which is the nominal one; limits of joints are not taken over; --bodies writes bodies and joints instead"
    )
    return robot, (missed, frame) if off else (frame,)

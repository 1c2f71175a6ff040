"""A model file of bodies and joints from a URDF file, for ``new --urdf``."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import printable


def write_from_urdf(path: str, output: str | None, platform: str | None, given: dict[str, Any]) -> int:
    """Write the model of the mechanism in a URDF file.

    Raises
    ------
    InputError
        If the file is no URDF file, or has what such mechanisms do not have.
    """
    from pkm_exact.geometry.linkage_text import linkage_text
    from pkm_exact.geometry.urdf_reader import read_urdf

    for key, value in given.items():
        if value not in (None, False, ()):
            raise click.UsageError(f"--urdf and --{key.replace('_', '-')} exclude each other.")
    if output is None:
        raise click.UsageError("--urdf: give -o MODEL.toml as well, or -o - for stdout.")
    try:
        found = read_urdf(path, platform)
    except InputError as error:
        text = str(error)
        raise InputError(text if text.startswith(path) else f"{path}: {text}") from None
    text = linkage_text(found.linkage)
    for note in found.notes:
        click.echo(f"{PROGRAM}: note: {printable(path)}: {note}", err=True)
    if output == "-":
        sys.stdout.write(text)
        return ExitCode.DONE
    arguments.require_other_file(Path(output), path, "-o")
    arguments.write_output(output, text.encode("utf-8"))
    linkage = found.linkage
    click.echo(f"{printable(output)}: {len(linkage.bodies)} bodies, {len(linkage.joints)} joints")
    click.echo(f"next: {PROGRAM} mobility {printable(shlex.quote(output))}")
    return ExitCode.DONE

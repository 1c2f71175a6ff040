"""A first model file of bodies and joints, for ``new --chains``."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.wording import counted, printable


def write_chains(
    template: str, output: str | None, name: str | None, dimensions: tuple[str, ...], given: dict[str, Any]
) -> int:
    """Write the model of a template, with these dimensions in place of the examples.

    Raises
    ------
    InputError
        If a dimension is none of the template, or what comes out is no mechanism.
    """
    from pkm_exact.geometry.linkage_text import linkage_text
    from pkm_exact.geometry.reader import any_from_toml
    from pkm_exact.templates.chain_templates import template_linkage

    for key, value in given.items():
        if key != "unit" and value not in (None, False, ()):
            raise click.UsageError(f"--chains and --{key.replace('_', '-')} exclude each other.")
    if output is None:
        raise click.UsageError("--chains: give -o MODEL.toml as well, or -o - for stdout.")
    label = name or (template if output == "-" else Path(output).stem)
    linkage = template_linkage(template, dimensions, label, given.get("unit") or "mm")
    text = linkage_text(linkage)
    any_from_toml(text)
    if output == "-":
        sys.stdout.write(text)
        return ExitCode.DONE
    arguments.write_output(output, text.encode("utf-8"))
    bodies = counted(len(linkage.bodies), "body").replace("bodys", "bodies")
    click.echo(f"{printable(output)}: {bodies}, {counted(len(linkage.joints), 'joint')}")
    click.echo(f"next: {PROGRAM} mobility {printable(shlex.quote(output))}")
    return ExitCode.DONE

"""The certificate that ``statics -o`` writes."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM
from pkm_exact.errors import InputError
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.statics.asked_answers import StaticsAnswers


def write_certificate(
    output: str,
    sources: tuple[str, str | None],
    extra: StaticsAnswers,
    solution: Mapping[str, Any] | None,
) -> None:
    """Write a certificate of what was asked; notes say what is not in it.

    Parameters
    ----------
    sources : tuple
        The model or certificate, and the model of a certificate: not to be overwritten.
    solution : mapping or None
        Which pose of which certificate it is.

    Raises
    ------
    InputError
        If there is no such certificate.
    """
    from pkm_exact.certify.build import canonical_bytes
    from pkm_exact.certify.statics_any_build import any_statics_certificate
    from pkm_exact.interactive.robots import read_robot  # it was announced when it was read first

    for file in sources:
        if file is not None:
            arguments.require_other_file(Path(output), file, "-o")
    arguments.require_writable(Path(output), "-o")
    if extra.measures is None:
        raise InputError("-o: there is no J at this pose, and nothing to be certified; give --model, or another pose")
    machine = None if solution is not None else read_robot(sources[0])
    load = extra.load
    if load is not None and not all(isinstance(value, int | Fraction) for value in load):
        raise InputError("-o: --load-at makes moments that are not exact at an enclosed pose; give --load in full")
    content, left_out = any_statics_certificate(machine, extra.measures, load, solution)
    arguments.write_output(output, canonical_bytes(content))
    for name, reason in left_out.items():
        if name not in extra.refused:
            note = f"{printable(output)} does not have {name}: {reason}"
            click.echo(f"{PROGRAM}: note: {note}", err=True)

"""The command ``report``. Everything heavy is imported inside it."""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.wording import printable


@click.command()
@click.argument("certificate", type=arguments.FilePath(), metavar="CERT.json")
@click.option(
    "-o", "--output", type=arguments.FilePath(), metavar="FILE.html", required=True, help="Write the page here."
)
@click.option(
    "--model",
    type=arguments.FilePath(),
    metavar="MODEL",
    help="Its model file, to draw cranks and slides, and to say which limits each pose keeps.",
)
@arguments.near_option("Mark the pose nearest to this one, and begin with it")
@click.option(
    "--limits",
    "limits",
    multiple=True,
    metavar="KEY=VALUES",
    help="What actuators can do, for indices and polytopes; can be repeated: speeds=1/2, forces=4.2, length=0.1, ..",
)
def report(
    certificate: str, output: str, model: str | None, near: tuple[Fraction, ...] | None, limits: tuple[str, ...]
) -> int:
    """Write one web page that shows what the certificate CERT.json proves, and every pose to turn and copy.

    The certificate is checked first. The page holds all its data: it opens without a network, and can be sent around
    as one file.

    \b
    Examples:
      certify-poses report certs/rolland-6-6.json -o rolland.html
      certify-poses report certs/hexa.json --model models/hexa.toml --near 0,0,650,0,0,0 -o hexa.html
      certify-poses report certs/3-rrr.json --limits speeds=1 --limits length=2 -o planar.html

    Exit codes: 0 written; 1 the certificate is rejected, nothing is written. Others as for certify-poses.
    """
    target = Path(output)
    for source, what in ((certificate, "the certificate"), (model, "the model file")):
        if source is not None and Path(source).exists():
            arguments.require_other_file(target, source, "-o", what)
    arguments.require_writable(target, "-o")
    from pkm_exact.cli.statics_answers import given_limits

    given = given_limits(limits)
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.pictures.scene import RejectedError, accepted_with_lines
    from pkm_exact.report_page.words import meaning_of

    try:
        with Progress(verbose=False) as progress:
            progress(f"checking {Path(certificate).name}")
            document, lines = accepted_with_lines(Path(certificate))
    except RejectedError as error:
        click.echo(f"{PROGRAM}: error: {printable(str(error))}", err=True)
        return ExitCode.REJECTED
    page = _page(document, lines, certificate, model, near, given)
    arguments.write_output(target, page.encode("utf-8"))
    sys.stdout.write(f"{printable(output)}: {meaning_of(document).headline}\n")
    return ExitCode.DONE


def _page(
    document: dict[str, object],
    lines: tuple[str, ...],
    certificate: str,
    model: str | None,
    near: tuple[Fraction, ...] | None,
    limits: dict[str, Any],
) -> str:
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.report_page.page import report_page

    if "polynomials" in document:
        raise InputError(
            f"{certificate}: certifies a polynomial system, of which there is no page; use certify-roots check"
        )
    robot = None if model is None else announced_model(model)
    try:
        return report_page(document, lines, Path(certificate).name, robot, limits, near)
    except InputError as error:
        raise InputError(f"{certificate}: {error}") from None

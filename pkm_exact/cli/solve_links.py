"""The command ``solve`` for mechanisms with passive bodies. Everything heavy is imported inside it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click
from click.core import ParameterSource

from pkm_exact.cli import arguments
from pkm_exact.cli.main import ExitCode
from pkm_exact.errors import InputError

if TYPE_CHECKING:
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.mechanism import LockedValues

_NOT_FOR_LINKS: Final = (
    ("lengths", "--lengths: belongs to robots with legs; give --joints, or name a configuration"),
    ("formulation", "--formulation: a mechanism with passive bodies has one polynomial system; leave it out"),
    ("tolerance", "--tolerance: is for robots with legs; leave it out"),
    ("near", "--near: a mechanism with passive bodies has no nominal pose; leave it out"),
    ("feasible", "--feasible: a mechanism with passive bodies has no limits; leave it out"),
)


@dataclass(frozen=True)
class Request:
    """What the command line asks of a mechanism with passive bodies."""

    model: str
    configuration: str | None
    joints: tuple[arguments.JointWord, ...] | None
    method: str
    start: tuple[float, ...] | None
    width: Fraction
    time_limit: float | None
    output: str | None
    layout: str
    verbose: bool


def solve_links_model(links: Links, asked: Request) -> ExitCode:
    """Solve, print, write the certificate; the exit code."""
    _require_fitting(asked)
    links, chosen = _chosen(links, asked)
    if asked.output is not None:
        arguments.require_other_file(Path(asked.output), asked.model, "-o")
        arguments.require_writable(Path(asked.output), "-o")
    from pkm_exact.cli.links_report import report_links
    from pkm_exact.interactive.limited_solve import solve_within_limits
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.links.link_engine import solve_links

    options: dict[str, Any] = {"width": asked.width}
    if asked.time_limit is not None:
        options["solver"] = partial(solve_within_limits, seconds=asked.time_limit, megabytes=None)
    with Progress(verbose=asked.verbose) as progress:
        try:
            solution = solve_links(links, chosen, progress=progress, **options)
        except InputError as error:
            raise InputError(f"{asked.model}: {error}") from None
    if asked.output is not None and solution.system is not None:
        from pkm_exact.certify.system_build import system_certificate_bytes

        title = f"{links.name}, configuration {chosen.name}"
        arguments.write_output(asked.output, system_certificate_bytes(solution.system, title))
        click.echo(f"note: {asked.output}: the certificate is about the polynomial system of all bodies", err=True)
    report_links(solution, asked.layout, verbose=asked.verbose)
    return ExitCode.DONE if solution.is_complete else ExitCode.WEAKER_CLAIM


def _require_fitting(asked: Request) -> None:
    """Refuse an option that means nothing for mechanisms with passive bodies."""
    context = click.get_current_context()
    for name, sentence in _NOT_FOR_LINKS:
        if context.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise InputError(f"{asked.model}: {sentence}")
    if asked.layout not in ("table", "json"):
        raise InputError(
            f"{asked.model}: --format {asked.layout}: has no place for several bodies; choose table or json"
        )
    if asked.method != "exact":
        raise InputError(
            f"{asked.model}: --method {asked.method}: is not for mechanisms with passive bodies; leave it out"
        )


def _chosen(links: Links, asked: Request) -> tuple[Links, LockedValues]:
    try:
        if asked.joints is None:
            return links, links.configuration(asked.configuration)
        from pkm_exact.cli.joint_words import joint_configuration

        declared, name = joint_configuration(links.declared, asked.joints)
        return links, declared.configuration(name)
    except InputError as error:
        raise InputError(f"{asked.model}: {error}") from None

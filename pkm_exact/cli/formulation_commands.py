"""The commands ``formulations`` and ``export``. Everything heavy is imported inside a command."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError
from pkm_exact.export.targets import TARGETS
from pkm_exact.formulations.registry import formulation_codes

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.robot import Configuration


@click.command()
@click.argument("model", type=arguments.FilePath())
@arguments.configuration_option
@click.option(
    "--json", "output", type=arguments.FilePath(), metavar="FILE", help="Write the rows to this file as well."
)
@click.option(
    "--only",
    "codes",
    callback=arguments.codes,
    metavar="CODES",
    help="Formulations, with commas between: SE3,AFD1:zxz.  [default: all]",
)
@click.option(
    "--timeout",
    callback=arguments.timeout,
    metavar="S",
    default="600",
    show_default=True,
    help="Seconds for each formulation.",
)
def formulations(
    model: str, configuration: str | None, output: str | None, codes: tuple[str, ...], timeout: float
) -> int:
    """Solve one configuration of the robot in the file MODEL in every formulation, and compare.

    Prints the size of each system, the number of its solutions, and the time of each stage. The real poses are compared
    box by box with those of the formulation SE3.

    Exit codes: 0 every formulation ended and its poses are those of SE3; 3 one did not end or does not apply, or its
    poses differ or could not be compared. Others as for certify-poses.

    \b
    Examples:
      certify-poses formulations models/mourrain-l.toml --only SE3,AFD4,AFD5
      certify-poses formulations models/rolland-6-6.toml --timeout 60 --json formulations.json
    """
    from pkm_exact.cli.model_reading import announced_model

    robot = announced_model(model)
    chosen, problem = arguments.chosen_problem(robot, model, configuration)
    if output is not None:
        arguments.require_other_file(Path(output), model, "--json")
        arguments.require_writable(Path(output), "--json")

    from pkm_exact.cli.formulations_table import print_tables
    from pkm_exact.comparison.compare import compare_formulations
    from pkm_exact.interactive.progress import Progress

    with Progress(verbose=False) as progress:
        rows = compare_formulations(problem, codes, seconds=timeout, progress=progress)
    if output is not None:
        name, metric = chosen.name if chosen else None, list(map(str, robot.metric))
        content = {"model": model, "configuration": name, "metric": metric, "rows": [row.as_object() for row in rows]}
        arguments.write_output(output, (json.dumps(content, indent=1) + "\n").encode("utf-8"), "--json")
    print_tables(_title(robot, chosen), rows)
    return ExitCode.DONE if all(row.agrees for row in rows) else ExitCode.WEAKER_CLAIM


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.option(
    "--formulation",
    callback=arguments.code,
    metavar="CODE",
    default=formulation_codes()[0],
    show_default=True,
    help=f"System of equations: {', '.join(formulation_codes())}, or with an option: AFD1:zxz, AFP1:124.",
)
@click.option("--to", "target", type=click.Choice(TARGETS), required=True, help="Program to write for.")
@arguments.configuration_option
@click.option(
    "--localised",
    is_flag=True,
    help="The system that is solved, where it is not the formulation's own: AFD2 without 1 + t^2 = 0, AFP4 without "
    "mirrored joints.",
)
@click.option(
    "-o", "--output", type=arguments.FilePath(), metavar="FILE", help="Write to this file.  [default: stdout]"
)
def export(
    model: str, formulation: str, target: str, configuration: str | None, localised: bool, output: str | None
) -> int:
    """Write the equations of a formulation for the robot in the file MODEL, exactly, as input of another program.

    The polynomials are primitive over the integers; their common zeros are the solutions of the formulation. Only
    phcpack rounds the coefficients, when it reads them.

    \b
    Examples:
      certify-poses export models/mourrain-l.toml --to msolve -o mourrain-l.ms
      certify-poses export models/mourrain-l.toml --to singular --formulation AFD5
    """
    from pkm_exact.cli.model_reading import announced_model

    robot = announced_model(model)
    chosen, problem = arguments.chosen_problem(robot, model, configuration)
    if output is not None:
        arguments.require_other_file(Path(output), model, "-o")
        arguments.require_writable(Path(output), "-o")

    from pkm_exact.export.targets import export as exported
    from pkm_exact.formulations.registry import formulation_for

    try:
        formulated = formulation_for(formulation, problem).formulate(problem)
    except InputError as error:
        raise InputError(f"{model}: {error}") from None
    system = formulated.branches[0] if localised else formulated.system
    heading = f"{_title(robot, chosen)}, formulation {formulation}{' as solved' if localised else ''}"
    text = exported(system, target, heading)
    if output is None:
        sys.stdout.write(text)
    else:
        arguments.write_output(output, text.encode("utf-8"))
    return ExitCode.DONE


def _title(robot: Machine, configuration: Configuration | None) -> str:
    return f"{robot.name} ({robot.kind}), configuration {configuration.name if configuration else 'none'}"

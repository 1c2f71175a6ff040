"""The command ``compare``. Everything heavy is imported inside it."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError

MOST_STARTS = 10_000


@click.command()
@click.argument("model", type=arguments.FilePath())
@arguments.configuration_option
@arguments.lengths_option
@click.option(
    "--starts",
    type=click.IntRange(1, MOST_STARTS),
    default=100,
    show_default=True,
    help="Random start poses; path tracking has starts of its own.",
)
@click.option(
    "--json", "output", type=arguments.FilePath(), metavar="FILE", help="Write where every start ended to this file."
)
def compare(
    model: str, configuration: str | None, lengths: tuple[Fraction, ...] | None, starts: int, output: str | None
) -> int:
    """Run the usual numeric methods on the robot in the file MODEL and hold them against its certified poses.

    Newton's method from the home pose and from random poses, Levenberg-Marquardt from the same, and path tracking from
    all solutions of a generic robot. Prints which certified poses were found and which were missed, how often each was
    hit, poses that are none, and the true error of what was found, with certified bounds: the greatest displacement of
    a platform joint. The starts are the same in every run.

    Exit codes: 0 the certified list is complete, whatever the methods found of it; 3 it is not proved complete, or
    there is none as solutions form a set of positive dimension (then nothing is compared, nor written to FILE). Others
    as for certify-poses.

    \b
    Examples:
      certify-poses compare models/rolland-6-6.toml
      certify-poses compare models/dietmaier.toml --starts 1000 --json dietmaier.json
    """
    if configuration is not None and lengths is not None:
        raise click.UsageError("--configuration and --lengths exclude each other.")
    from pkm_exact.cli.model_reading import announced_model

    robot = announced_model(model)
    chosen, problem = arguments.chosen_problem(robot, model, configuration, lengths)
    if output is not None:
        arguments.require_other_file(Path(output), model, "--json")
        arguments.require_writable(Path(output), "--json")

    from pkm_exact.cli.compare_table import print_certified, print_comparison
    from pkm_exact.cli.report import configuration_object
    from pkm_exact.comparison.numeric import NothingToCompareError, compare_numeric
    from pkm_exact.interactive.progress import Progress

    name = chosen.name if chosen else None
    with Progress(verbose=False) as progress:
        try:
            comparison = compare_numeric(problem, starts=starts, progress=progress)
        except NothingToCompareError as error:
            print_certified(robot, name, error.solution)
            click.echo(f"nothing was compared: {error}")
            return ExitCode.WEAKER_CLAIM
        except InputError as error:
            raise InputError(f"{model}: {error}") from None
    if output is not None:
        entry = configuration_object(robot, name, problem)
        content = {
            "model": model,
            "configuration": entry,
            "unit": robot.unit,
            "metric": list(map(str, robot.metric)),
            **comparison.as_object(),
        }
        arguments.write_output(output, (json.dumps(content, indent=1) + "\n").encode("utf-8"), "--json")
    print_comparison(robot, name, comparison)
    return ExitCode.DONE if comparison.solution.is_complete else ExitCode.WEAKER_CLAIM

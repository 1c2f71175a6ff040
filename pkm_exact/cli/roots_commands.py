"""The commands of ``certify-roots``. Everything heavy is imported inside a command, so that ``--help`` is quick."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.check_command import check_all, files_in
from pkm_exact.cli.program import ExitCode
from pkm_exact.cli.shell_completion import roots_completion

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

_OPTIONS_OF_THE_PROGRAM = ("-h", "--help", "--version")


class _SolvingUnlessTold(click.Group):
    """A group whose first word may be left out where it is ``solve``."""

    def parse_args(self, context: click.Context, args: list[str]) -> list[str]:
        """The words with ``solve`` before them, unless they begin with a command or an option of the program itself."""
        if args and args[0] not in self.commands and args[0] not in _OPTIONS_OF_THE_PROGRAM:
            args = ["solve", *args]
        return super().parse_args(context, args)

    def shell_complete(self, context: click.Context, incomplete: str) -> list[CompletionItem]:
        """The commands, and files: the first word may be the system's."""
        from click.shell_completion import CompletionItem

        return [*super().shell_complete(context, incomplete), CompletionItem(incomplete, type="file")]


def _show_version(context: click.Context, _option: click.Parameter, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        from pkm_exact.support.installation import version_lines

        for line in version_lines():
            click.echo(line)
        context.exit()


@click.group(cls=_SolvingUnlessTold, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_version,
    help="Show the versions of all that matters, and exit.",
)
def certify_roots() -> None:
    """Find every solution of a polynomial system exactly, and certify it. Without a command, FILE is solved.

    \b
    Examples:
      certify-roots circle.ms -o circle.json
      certify-roots check circle.json

    Exit codes: 0 done and complete, or accepted; 1 a certificate was rejected; 2 bad input or usage; 3 done, but the
    claim is weaker than complete; 4 no answer; 130 interrupted; 141 the reader of the output went away.
    """


@certify_roots.command(short_help="All solutions of a system, and a certificate.")
@click.argument("file", type=arguments.FilePath())
@arguments.width_option
@click.option(
    "--only",
    type=click.Choice(["real"]),
    help="Leave the complex solutions out of the table's headline; JSON has their numbers in any case.",
)
@click.option(
    "--oracle",
    type=click.Choice(["internal", "msolve"]),
    default="internal",
    show_default=True,
    help="Who finds the solutions: this program, or an installed msolve, whose answer is verified.",
)
@click.option(
    "--time-limit",
    callback=arguments.time_limit,
    metavar="S",
    help="Seconds after which it is given up, exit code 4.  [default: none]",
)
@click.option(
    "--memory",
    type=click.IntRange(64, 1 << 20),
    metavar="MB",
    help="Megabytes of memory that it may use, exit code 4 beyond.  [default: no limit]",
)
@arguments.certificate_option
@arguments.layout_option("What to print: decimals, or exact bounds as json.")
@click.option("-v", "--verbose", is_flag=True, help="Say more: sizes, times of the stages, stages on a terminal.")
def solve(
    file: str,
    width: Fraction,
    only: str | None,
    oracle: str,
    time_limit: float | None,
    memory: int | None,
    output: str | None,
    layout: str,
    verbose: bool,
) -> int:
    """Find all solutions of the polynomial system in FILE, and prove that they are all.

    FILE is in msolve's format: a line of variables, the line 0, then polynomials with commas between them. Prints the
    real solutions and, with -o, writes a certificate of all complex ones.

    \b
    Examples:
      certify-roots circle.ms -o circle.json
      certify-roots circle.ms --format json --width 1e-30
    """
    from pkm_exact.systems.system_sources import read_system

    system = read_system(file)
    if output is not None:
        arguments.require_other_file(Path(output), file, "-o", "the system's file")
        arguments.require_writable(Path(output), "-o")
    from pkm_exact.interactive.limited_solve import solve_within_limits
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.interactive.system_answers import solve_system

    solver = solve_system
    if time_limit is not None or memory is not None:
        solver = partial(solve_within_limits, seconds=time_limit, megabytes=memory)
    with Progress(verbose=verbose) as progress:
        solution = solver(system, width=width, oracle=oracle, progress=progress)
    data = None if output is None else solution.certificate(Path(file).name).data
    if output is not None and data is not None:
        arguments.write_output(output, data)
    from pkm_exact.cli.roots_report import report_roots
    from pkm_exact.interactive.system_answers import is_beyond_checkers
    from pkm_exact.wording import TOO_LARGE

    report_roots(Path(file).name, solution, layout, only_real=only == "real", verbose=verbose)
    if data is not None and is_beyond_checkers(solution, data):
        click.echo(f"{output}: {TOO_LARGE}", err=True)
    return ExitCode.DONE if solution.is_complete else ExitCode.WEAKER_CLAIM


@certify_roots.command(short_help="Replay certificates.")
@click.argument("paths", nargs=-1, required=True, type=arguments.FilePath(), metavar="CERT...")
@click.option("--pure", is_flag=True, help="Use the second checker: plain Python, no libraries, slower, same verdicts.")
def check(paths: tuple[str, ...], pure: bool) -> int:
    """Replay certificates with a program that shares nothing with the solver.

    CERT is a certificate, or a folder: all *.json in it. Prints one line per claim. Exit code: 0 all accepted; 1 at
    least one was rejected; otherwise 2, at least one could not be read or is not a certificate.

    \b
    Examples:
      certify-roots check circle.json
      certify-roots check --pure circle.json
    """
    return check_all(list(files_in(paths)), pure=pure)


certify_roots.add_command(roots_completion)

"""The commands ``solve`` and ``check``. Everything heavy is imported inside a command, so that ``--help`` is quick."""

from __future__ import annotations

import sys
from fractions import Fraction
from pathlib import Path
from typing import Final

import click

import pkm_exact
from pkm_exact.cli import arguments, tolerance_report
from pkm_exact.cli.compare_commands import compare
from pkm_exact.cli.formulation_commands import export, formulations
from pkm_exact.cli.legs import legs
from pkm_exact.cli.main import ExitCode
from pkm_exact.cli.methods import METHODS, report_uncertified, require_fitting, solved
from pkm_exact.cli.track import track
from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.wording import printable

MAX_CERTIFICATE_BYTES: Final = 64 << 20


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(pkm_exact.__version__, message="%(prog)s %(version)s")
def certify_poses() -> None:
    """Find every pose of a parallel robot exactly, and certify it.

    Exit codes: 0 done and complete, or accepted; 1 a certificate was rejected; 2 bad input or usage; 3 done, but the
    claim is weaker than complete; 4 no answer.
    """


certify_poses.add_command(formulations)
certify_poses.add_command(export)
certify_poses.add_command(legs)
certify_poses.add_command(compare)
certify_poses.add_command(track)


@certify_poses.command(short_help="All real poses of a robot, and a certificate.")
@click.argument("model", type=click.Path())
@arguments.configuration_option
@arguments.lengths_option
@click.option(
    "--method",
    type=click.Choice(METHODS),
    default=METHODS[0],
    show_default=True,
    help="exact: elimination. krawczyk: continuation, then proof. newton: one pose from a start, nothing proved.",
)
@click.option(
    "--formulation",
    callback=arguments.code,
    metavar="CODE",
    default=formulation_codes()[0],
    show_default=True,
    help=f"System of equations to solve: {', '.join(formulation_codes())}, or with an option: AFD1:zxz, AFP1:124.",
)
@click.option(
    "--start",
    callback=arguments.start,
    metavar="X,Y,Z,Q0,..,Q3",
    help="For newton: position and quaternion to start from. X,Y,DEGREES if planar.  [default: a home pose, the "
    "platform over the base]",
)
@click.option(
    "--width",
    callback=arguments.width,
    metavar="W",
    default="1e-9",
    show_default=True,
    help="Greatest width of a box, exact: 1e-9 or 1/1000.",
)
@click.option(
    "--time-limit",
    callback=arguments.time_limit,
    metavar="S",
    help="Seconds after which exact or krawczyk is given up, and uncertified poses are the answer.  [default: none]",
)
@click.option(
    "--tolerance",
    callback=tolerance_report.parse,
    is_flag=False,
    flag_value=tolerance_report.OF_THE_MODEL,
    metavar="[T]",
    help="Boxes for all robots whose joints and lengths are off by at most T; without T, by the model's tolerances.",
)
@click.option("-o", "--output", type=click.Path(), metavar="CERT.json", help="Write the certificate to this file.")
@click.option(
    "--format",
    "layout",
    type=click.Choice(["table", "json", "csv"]),
    default="table",
    show_default=True,
    help="What to print: decimals, or exact bounds as json or csv.",
)
@click.option("-v", "--verbose", is_flag=True, help="Say more: method, box widths, stages on a terminal.")
def solve(
    model: str,
    configuration: str | None,
    lengths: tuple[Fraction, ...] | None,
    method: str,
    formulation: str,
    start: tuple[float, ...] | None,
    width: Fraction,
    time_limit: float | None,
    tolerance: Fraction | str | None,
    output: str | None,
    layout: str,
    verbose: bool,
) -> int:
    """Find all real poses of the robot in the file MODEL for one configuration, or for given leg lengths.

    Prints the poses and, with -o, writes a certificate that `certify-poses check` replays. A pose of the method newton,
    and those found instead of a certified answer when --time-limit is over, are uncertified: points and not boxes, exit
    code 3, and no certificate.

    \b
    Examples:
      certify-poses solve models/rolland-6-6.toml -o rolland.json
      certify-poses solve models/hexa.toml --configuration level --time-limit 10
      certify-poses solve models/rolland-6-6.toml --method newton --start 0,0,800,1,0,0,0
    """
    if configuration is not None and lengths is not None:
        raise click.UsageError("--configuration and --lengths exclude each other.")
    require_fitting(click.get_current_context(), method)
    tolerance_report.require_fitting(click.get_current_context(), tolerance, method, layout)
    from pkm_exact.geometry.reader import read_robot

    robot = read_robot(model)
    chosen, problem = arguments.chosen_problem(robot, model, configuration, lengths)
    name = chosen.name if chosen else None
    tolerances = None if tolerance is None else tolerance_report.chosen_tolerances(robot, model, tolerance)
    if output is not None:
        arguments.require_other_file(Path(output), model, "-o")
        arguments.require_writable(Path(output), "-o")

    from pkm_exact.cli.progress import Progress
    from pkm_exact.numeric.uncertified import UncertifiedSolution

    with Progress(verbose=verbose) as progress:
        try:
            solution = solved(problem, method, formulation, start, width, time_limit, progress)
        except InputError as error:
            raise InputError(f"{model}: {error}") from None
    if isinstance(solution, UncertifiedSolution):
        return report_uncertified(robot, name, solution, layout, output, verbose=verbose)
    if tolerances is not None:
        with Progress(verbose=verbose) as progress:
            return tolerance_report.report_tolerances(
                robot, name, solution, tolerances, output, layout, verbose=verbose, progress=progress
            )
    if output is not None:
        from pkm_exact.certify.build import certificate, write_certificate

        try:
            write_certificate(Path(output), certificate(robot, name, solution))
        except OSError as error:
            raise InputError(f"{output}: cannot be written ({error.strerror}); give another path to -o") from None

    from pkm_exact.cli.report import report
    from pkm_exact.verdict import Claim

    report(robot, name, solution, layout, verbose=verbose)
    return ExitCode.DONE if solution.claim in (Claim.COMPLETE, Claim.INCONSISTENT) else ExitCode.WEAKER_CLAIM


@certify_poses.command(short_help="Replay certificates.")
@click.argument("certificates", nargs=-1, required=True, type=click.Path(), metavar="CERT.json...")
@click.option("--pure", is_flag=True, help="Use the second checker: one file of plain Python, slower, same verdicts.")
def check(certificates: tuple[str, ...], pure: bool) -> int:
    """Replay certificates with a program that shares nothing with the solver.

    Prints one line per claim. Exit code: 0 all accepted; 1 at least one was rejected; otherwise 2, at least one could
    not be read or is not a certificate. The second checker knows pose certificates only, not those of tolerances.

    \b
    Examples:
      certify-poses check certs/*.json
      certify-poses check --pure rolland.json
    """
    codes = [_check(Path(name), pure=pure) for name in certificates]
    if ExitCode.REJECTED in codes:
        return ExitCode.REJECTED
    return max(codes)


def _check(path: Path, *, pure: bool) -> ExitCode:
    name = printable(str(path))
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_CERTIFICATE_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        click.echo(f"certify-poses: error: {name}: cannot be read ({reason}); give the path of a certificate", err=True)
        return ExitCode.BAD_INPUT
    status, lines = _verdict(data, pure=pure)
    for line in lines:
        sys.stdout.write(f"{name}: {printable(line)}\n")
    sys.stdout.write(f"{name}: {status}\n")
    sys.stdout.flush()
    if status == "accepted":
        return ExitCode.DONE
    return ExitCode.REJECTED if status == "rejected" else ExitCode.BAD_INPUT


def _verdict(data: bytes, *, pure: bool) -> tuple[str, tuple[str, ...]]:
    """Status and lines by one of the two checkers, which share nothing."""
    if pure:
        from pkm_exact.certify.pure import check_bytes as check_plainly

        plain = check_plainly(data)
        return str(plain.status), tuple(plain.lines)
    from pkm_exact.certify.check import check_bytes

    verdict = check_bytes(data)
    return str(verdict.status), verdict.lines

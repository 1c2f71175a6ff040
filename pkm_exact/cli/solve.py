"""The command ``solve``. Everything heavy is imported inside it."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click

from pkm_exact.cli import arguments, tolerance_report
from pkm_exact.cli.feasible_poses import SORTS
from pkm_exact.cli.methods import METHODS, report_uncertified, require_fitting, solved
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import formulation_codes

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine

_WITH_NOTES: Final = ("table", "json")
"""The layouts that have a place for sentences."""


@click.command()
@click.argument("model", type=arguments.FilePath())
@arguments.configuration_option
@arguments.lengths_option
@arguments.joints_option
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
    help="For newton, and for krawczyk of a mechanism with passive bodies: position and quaternion to start from. "
    "X,Y,DEGREES if planar.  [default: a home pose, the platform over the base]",
)
@arguments.width_option
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
@arguments.certificate_option
@arguments.layout_option(
    "What to print: decimals as a table or as csv, or exact bounds as json or csv_exact.",
    ("table", "json", "csv", "csv_exact"),
)
@arguments.near_option("Mark the pose nearest to this one")
@click.option("--feasible", is_flag=True, help="List only the poses that are proved to keep all limits of the model.")
@click.option("--nearest", is_flag=True, help="List only the pose nearest to --near, or to the model's nominal pose.")
@click.option(
    "--sort",
    type=click.Choice(SORTS),
    default=SORTS[0],
    show_default=True,
    help="Order of the list; every pose keeps its number.",
)
@click.option(
    "--joined",
    is_flag=True,
    help="Say which poses are proved to be joined by motions of the platform without a singular pose.",
)
@click.option(
    "--names-from",
    "source",
    type=arguments.FilePath(),
    metavar="CERT.json",
    help="Carry the names of the poses from a certificate of this robot, along certified branches of regular poses.",
)
@click.option("-v", "--verbose", is_flag=True, help="Say more: method, box widths, stages on a terminal.")
def solve(
    model: str,
    configuration: str | None,
    lengths: tuple[Fraction, ...] | None,
    joints: tuple[arguments.JointWord, ...] | None,
    method: str,
    formulation: str,
    start: tuple[float, ...] | None,
    width: Fraction,
    time_limit: float | None,
    tolerance: Fraction | str | None,
    output: str | None,
    layout: str,
    near: tuple[Fraction, ...] | None,
    feasible: bool,
    nearest: bool,
    sort: str,
    joined: bool,
    source: str | None,
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
      certify-poses solve models/3-rpr-merlet-p.toml --lengths 7.1,5.1,5 --names-from certs/3-rpr-merlet-p.json
      certify-poses solve models/rolland-6-6.toml --method newton --start 0,0,800,1,0,0,0
    """
    _require_one([("--configuration", configuration), ("--lengths", lengths), ("--joints", joints)])
    from pkm_exact.cli.model_reading import announced_solvable
    from pkm_exact.geometry.model_kinds import is_links

    robot = announced_solvable(model)
    if is_links(robot):
        from pkm_exact.cli.solve_links import Request, solve_links_model

        asked = Request(model, configuration, joints, method, start, width, time_limit, output, layout, verbose)
        return solve_links_model(robot, asked)
    require_fitting(click.get_current_context(), method)
    tolerance_report.require_fitting(click.get_current_context(), tolerance, method, layout)
    _require_place(layout, tolerance, joined=joined)
    from pkm_exact.geometry.nominal_pose import nominal_from_numbers
    from pkm_exact.geometry.robot import jointed

    if near is not None:
        robot = replace(robot, nominal=nominal_from_numbers(near, "--near", robot.motion))
    _require_choosable(robot, model, method, feasible=feasible, nearest=nearest, sort=sort, joined=joined)
    if joints is not None:
        from pkm_exact.geometry.given_joints import joint_configuration

        robot, configuration = joint_configuration(robot, joints, "--joints")
    chosen, problem = arguments.chosen_problem(robot, model, configuration, lengths)
    name = chosen.name if chosen else None
    from pkm_exact.cli.names_from import named_poses, with_names

    reference = named_poses(source, problem, method)
    tolerances = (
        None
        if tolerance is None
        else tolerance_report.chosen_tolerances(jointed(robot, "--tolerance"), model, tolerance)
    )
    _require_output(output, model, source)

    from pkm_exact.cli.joint_words import say_joint_notes
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.solution import Solution

    with Progress(verbose=verbose) as progress:
        try:
            solution = solved(problem, method, formulation, start, width, time_limit, progress)
        except InputError as error:
            raise InputError(f"{model}: {error}") from None
    say_joint_notes(robot, name, unless=isinstance(solution, Solution) and tolerance is None and layout in _WITH_NOTES)
    if not isinstance(solution, Solution):
        return report_uncertified(robot, name, solution, layout, output, verbose=verbose)
    from pkm_exact.cli.feasible_poses import ShownPoses

    shown = ShownPoses.of(robot, name, solution, feasible_only=feasible)
    shown = with_names(shown, solution, source, reference, verbose=verbose)
    shown = (shown.only_nearest() if nearest else shown).arranged(sort, robot.nominal)
    if tolerances is not None:
        with Progress(verbose=verbose) as progress:
            return tolerance_report.report_tolerances(
                jointed(robot, "--tolerance"),
                name,
                solution,
                tolerances,
                output,
                layout,
                shown=shown,
                verbose=verbose,
                progress=progress,
            )
    if output is not None:
        from pkm_exact.certify.build import certificate_bytes

        arguments.write_output(output, certificate_bytes(robot, name, solution))

    from pkm_exact.cli.modes import joined_modes
    from pkm_exact.cli.report import report

    groups = joined_modes(robot, solution, verbose=verbose) if joined else None
    report(robot, name, solution, layout, verbose=verbose, shown=shown, joined=groups)
    return ExitCode.DONE if solution.is_complete else ExitCode.WEAKER_CLAIM


def _require_output(output: str | None, model: str, source: str | None) -> None:
    """Refuse an output that is an input, or cannot be written."""
    if output is None:
        return
    arguments.require_other_file(Path(output), model, "-o")
    if source is not None:
        arguments.require_other_file(Path(output), source, "-o", "the certificate of the names")
    arguments.require_writable(Path(output), "-o")


def _require_choosable(
    robot: Machine, model: str, method: str, *, feasible: bool, nearest: bool, sort: str, joined: bool
) -> None:
    """Refuse a choice or an order of poses that the model, or the method, has nothing to say about."""
    if joined:
        from pkm_exact.cli.modes import require_joinable

        require_joinable(robot, method)
    if feasible and (robot.limits is None or method == "newton"):
        what = "the model has no limits; add a table [limits]" if robot.limits is None else "it is for certified poses"
        raise InputError(f"{model}: --feasible: {what}, or leave the option out")
    if (nearest or sort == "nearest") and (robot.nominal is None or method == "newton"):
        what = "nearest to what? give --near" if robot.nominal is None else "it is for certified poses"
        raise InputError(f"{model}: --{'nearest' if nearest else 'sort'}: {what}, or leave the option out")


def _require_place(layout: str, tolerance: object, *, joined: bool) -> None:
    """Refuse --joined where its answer has no place."""
    if joined and (tolerance is not None or layout not in _WITH_NOTES):
        what = "--tolerance: poses of many robots" if tolerance is not None else f"--format {layout}: rows of poses"
        raise click.UsageError(f"--joined: has no place beside {what}; use table or json without a tolerance.")


def _require_one(given: list[tuple[str, object]]) -> None:
    """Refuse two of options that exclude each other."""
    names = [name for name, value in given if value is not None]
    if len(names) > 1:
        raise click.UsageError(f"{names[0]} and {names[1]} exclude each other.")

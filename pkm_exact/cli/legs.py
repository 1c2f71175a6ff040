"""The command ``legs``: inverse kinematics, exact leg lengths and joint values at a rational pose."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.given_pose import given_pose, pose_of, pose_options
from pkm_exact.cli.program import ExitCode
from pkm_exact.cli.shell_completion import configurations
from pkm_exact.errors import InputError

if TYPE_CHECKING:
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.redundant_drives import Standing


@click.command()
@click.argument("model", type=arguments.FilePath())
@pose_options(required=True)
@click.option(
    "--width",
    callback=arguments.width,
    metavar="W",
    default="1e-9",
    show_default=True,
    help="Greatest width of a bound on an irrational number, exact: 1e-9 or 1/1000.",
)
@click.option(
    "--configuration",
    metavar="NAME",
    shell_complete=configurations,
    help="Where redundant slides and cranks stand, which the pose leaves free (default: the first configuration).",
)
@arguments.layout_option("What to print: decimals, or exact values and bounds as json.")
def legs(
    model: str,
    position: str,
    nearest: Fraction | None,
    in_metric: bool,
    width: Fraction,
    configuration: str | None,
    layout: str,
    **turns: str | None,
) -> int:
    """Print what the legs of the robot in the file MODEL must be for its platform to stand at a pose.

    Leg lengths where these are actuated; else every crank angle or slide position, all working modes; of a mechanism
    declared by constraints the values of all of them, and whether those that are not actuated hold. Of a machine on a
    carriage the leg lengths, the carriage where a configuration has it. Coordinates are
    ordinary ones, as in every output. In the table, a line to copy into a configuration comes first if the values are
    rational.

    \b
    Examples:
      certify-poses legs models/rolland-6-6.toml --position 0,0,650 --quaternion 9,1,0,-1
      certify-poses legs models/hexa.toml --position 0,0,650 --cayley 0,1/9,0 --format json
      certify-poses legs models/rolland-6-6.toml --position 0,0,650 --rpy 0,10,-2.5
      certify-poses legs models/3-rpr-merlet-p.toml --position 5,9/2 --half-tangent 1/3
    """
    # Before the file is read: what is wrong with the words is said first.
    given = given_pose(position, in_metric=in_metric, nearest=nearest, **turns)
    from pkm_exact.cli import constraint_values_report, legs_report
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.geometry.mechanism import Mechanism as Declared

    robot = announced_model(model)
    place, rotation, used = pose_of(given, robot, model)
    answer: dict[str, Any] | str
    as_json = layout == "json"
    if isinstance(robot, Declared):
        report = constraint_values_report.as_object if as_json else constraint_values_report.as_text
        answer = report(_standing(robot, configuration), place, rotation, width, used)
    elif configuration is not None:
        raise InputError(f"--configuration: {_NOTHING_FREE}")
    else:
        answer = (legs_report.as_object if as_json else legs_report.as_text)(robot, place, rotation, width, used)
    sys.stdout.write(answer if isinstance(answer, str) else json.dumps(answer, indent=1) + "\n")
    return ExitCode.DONE


_NOTHING_FREE: Final = "the pose says what all joint values are; leave it out"


def _standing(robot: Mechanism, configuration: str | None) -> Standing:
    """The machine with its redundant drives locked; refused if a configuration is named and there are none."""
    from pkm_exact.geometry.redundant_drives import Standing, redundant_drives, standing

    if redundant_drives(robot):
        return standing(robot, robot.configuration(configuration))
    if configuration is not None:
        raise InputError(f"--configuration: {_NOTHING_FREE}")
    return Standing(robot)

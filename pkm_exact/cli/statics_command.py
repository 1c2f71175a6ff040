"""The command ``statics``: what a machine can do at a pose. Everything heavy is imported inside it."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.given_pose import GivenPose, given_pose, pose_of, pose_options
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.cli.shell_completion import configurations
from pkm_exact.errors import InputError
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.statics.asked_answers import StaticsAnswers
    from pkm_exact.statics.at_pose import AtPose


@click.command()
@click.argument("source", type=arguments.FilePath(), metavar="MODEL|CERT")
@click.option("--pose", "number", type=click.IntRange(min=1), metavar="K", help="Pose number K of the solution.")
@pose_options(required=False)
@click.option("--configuration", metavar="NAME", shell_complete=configurations, help="Configuration of the model file.")
@click.option("--modes", metavar="SIGNS", help="Working mode at --position: + or - (or its number) for each joint.")
@click.option("--model", type=arguments.FilePath(), metavar="MODEL", help="The model file of CERT, for its drives.")
@click.option(
    "--load", metavar="FX,..,MZ", help="Force, or force and moment, on the platform: which actuator forces bear it."
)
@click.option(
    "--load-at", metavar="X,Y,Z", help="Where the force acts, in the platform's frame.  [default: its origin]"
)
@click.option(
    "--limits",
    "limits",
    multiple=True,
    metavar="KEY=VALUES",
    help="What actuators can do, or is wanted; can be repeated: speeds=1/2, forces=4.2, length=0.1, ..",
)
@click.option("--stiffness", metavar="K1,..", help="Of the actuators: the stiffness matrix of the platform.")
@click.option(
    "-o",
    "--output",
    type=arguments.FilePath(),
    metavar="CERT.json",
    help="Write a certificate of polytopes, ellipsoid, singular values and, with --load, forces.",
)
@click.option(
    "--plot",
    "picture",
    type=arguments.FilePath(),
    metavar="FILE",
    help="Draw the polytopes of --limits speeds and forces, the ellipsoid in the first: a .png, .svg or .pdf file.",
)
@arguments.layout_option("What to print: decimals, or exact bounds as json.")
def statics(
    source: str,
    number: int | None,
    position: str | None,
    nearest: Fraction | None,
    in_metric: bool,
    configuration: str | None,
    modes: str | None,
    model: str | None,
    load: str | None,
    load_at: str | None,
    limits: tuple[str, ...],
    stiffness: str | None,
    output: str | None,
    picture: str | None,
    layout: str,
    **turns: str | None,
) -> int:
    """Print what a machine can do at a pose: wrenches, Jacobians, singularities, indices, forces.

    MODEL is a model file: the pose is given by --position and a rotation, exactly, or it is pose K of the solution of a
    configuration. CERT is a certificate, which is checked first; its poses are enclosed by its boxes.

    \b
    Examples:
      certify-poses statics models/rolland-6-6.toml --position 0,0,650 --quaternion 9,1,0,-1
      certify-poses statics models/linapod-n.toml --position 0,0,0 --quaternion 1,0,0,0 --modes ++++++
      certify-poses statics models/3-rpr-merlet-p.toml --pose 1 --limits speeds=0.2 --limits length=3 --load 0,-10
      certify-poses statics models/3-rpr-merlet-p.toml --pose 1 --limits speeds=0.2 --limits length=3 --plot pose.svg
      certify-poses statics certs/3-rps.json --pose 2 --format json
    """
    if picture is not None:
        _require_picture(picture, source, model, output)
    given = _given(number, position, in_metric=in_metric, nearest=nearest, **turns)
    if _is_certificate(source):
        for name, value in (("--position", position), ("--configuration", configuration), ("--modes", modes)):
            if value is not None:
                raise click.UsageError(f"{name}: is for a model file; of a certificate give --pose K.")
        certified, used = _at_certified_pose(source, number, model), None
        if certified is None:
            return ExitCode.REJECTED
        found, solution = certified
    else:
        if model is not None:
            raise click.UsageError("--model: is for a certificate.")
        (found, used), solution = _at_pose_of_model(source, number, given, configuration, modes), None
    from pkm_exact.cli import statics_output, statics_report
    from pkm_exact.cli.statics_answers import answers

    extra = answers(found, load, load_at, limits, stiffness)
    drawn = None if picture is None else _drawn(picture, extra)
    if output is not None:
        statics_output.write_certificate(output, (source, model), extra, solution)
    if picture is not None and drawn is not None:
        arguments.write_output(picture, drawn)
    if layout == "json":
        sys.stdout.write(json.dumps(statics_report.as_object(found, used, extra), indent=1) + "\n")
    else:
        sys.stdout.write(statics_report.as_text(found, used, extra))
    return ExitCode.DONE


def _given(number: int | None, position: str | None, **options: Any) -> GivenPose | None:
    """The pose that the options give, if they give one."""
    if position is not None:
        if number is not None:
            raise click.UsageError("--pose and --position exclude each other.")
        return given_pose(position, **options)
    if any(value for key, value in options.items() if key not in ("in_metric", "nearest")):
        raise click.UsageError("--position: is missing, give the platform's origin as well.")
    return None


def _require_picture(picture: str, source: str, model: str | None, output: str | None) -> None:
    """Refuse a file that cannot be drawn to, before any work begins."""
    from pkm_exact.pictures.output import picture_format
    from pkm_exact.pictures.style import require_matplotlib

    path = Path(picture)
    picture_format(path)
    for file, what in ((source, "the model or certificate"), (model, "the model file"), (output, "the certificate")):
        if file is not None:
            arguments.require_other_file(path, file, "--plot", what)
    arguments.require_writable(path, "--plot")
    require_matplotlib()


def _drawn(picture: str, extra: StaticsAnswers) -> bytes:
    """The content of the picture."""
    from pkm_exact.pictures.output import figure_bytes, picture_format
    from pkm_exact.pictures.statics_picture import statics_figure

    limits = None if extra.measures is None else extra.measures.limits
    if extra.measures is None or limits is None or (limits.speeds is None and limits.forces is None):
        raise InputError(
            "--plot: there is nothing to draw; give --limits speeds=.., forces=.. or both, and a pose with J"
        )
    try:
        figure = statics_figure(extra.measures, extra.ellipsoid)
    except InputError as error:
        raise InputError(f"--plot: {error}") from None
    return figure_bytes(figure, picture_format(Path(picture)))


def _is_certificate(source: str) -> bool:
    """Whether a file is JSON, by its name or its first character."""
    if source.endswith(".json"):
        return True
    if source.endswith(".toml"):
        return False
    try:
        with Path(source).open("rb") as stream:
            return stream.read(64).lstrip()[:1] == b"{"
    except OSError:
        return False


def _at_pose_of_model(
    source: str, number: int | None, given: Any, configuration: str | None, modes: str | None
) -> tuple[AtPose, Fraction | None]:
    """The machine at an exact pose, and by how much that may be off; or at a pose of its solution."""
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.statics.at_pose import at_rational_pose
    from pkm_exact.statics.machine_at_pose import machine_at_solution
    from pkm_exact.statics.placement import held_at

    robot = announced_model(source)
    try:
        if given is not None:
            chosen = None if configuration is None else robot.configuration(configuration)
            place, rotation, used = pose_of(given, robot, source)
            found = held_at(robot, place, rotation, chosen, modes)
            return at_rational_pose(robot, found, place, rotation), used
        if modes is not None:
            raise InputError("--modes: belongs to --position; the joint values of a solution are its configuration's")
        return _solved(robot, source, number, configuration, machine_at_solution), None
    except InputError as error:
        text = str(error)
        raise InputError(text if text.startswith(source) else f"{source}: {text}") from None


def _solved(robot: Machine, source: str, number: int | None, configuration: str | None, ask: Any) -> AtPose:
    from pkm_exact.engine import solve
    from pkm_exact.interactive.progress import Progress

    chosen, problem = arguments.chosen_problem(robot, source, configuration)
    with Progress(verbose=False) as progress:
        solution = solve(problem, progress=progress)
    found: AtPose = ask(robot, problem, solution.poses[_chosen(number, len(solution.poses)) - 1], chosen)
    return found


def _chosen(number: int | None, count: int) -> int:
    """Which pose is meant."""
    if count == 0:
        raise InputError("--pose: there is no real pose; give --position and a rotation")
    if number is None:
        if count > 1:
            raise InputError(f"--pose: is missing; there are {count} poses, give a number from 1 to {count}")
        return 1
    if number > count:
        raise InputError(f"--pose: {number} is too large; there are {count} poses, give a number from 1 to {count}")
    return number


def _at_certified_pose(source: str, number: int | None, model: str | None) -> tuple[AtPose, dict[str, Any]] | None:
    """The machine at a pose of an accepted certificate, and which pose that is; None if it is rejected."""
    from pkm_exact.certify.statics_of_poses import at_certified_poses
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.pictures.scene import RejectedError, accepted_document

    try:
        document = accepted_document(Path(source))
    except RejectedError as error:
        click.echo(f"{PROGRAM}: error: {printable(str(error))}", err=True)
        return None
    if "poses" not in document or "robot" not in document:
        raise InputError(f"{source}: is no certificate of poses; give one that certify-poses solve wrote")
    if model is None:
        note = "legs of a certificate are taken as actuators; --model MODEL says how slides or cranks drive them"
        click.echo(f"{PROGRAM}: note: {printable(source)}: {note}", err=True)
    try:
        place = _chosen(number, len(document["poses"])) - 1
    except InputError as error:
        raise InputError(f"{source}: {error}") from None
    machine = None if model is None else announced_model(model)
    try:
        return at_certified_poses(document, machine, [place])[0], {"digest": document["digest"], "pose": place + 1}
    except InputError as error:
        raise InputError(f"{model or source}: {error}") from None

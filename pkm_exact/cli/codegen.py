"""The command ``codegen``: a robot's kinematics as C files for controllers. Everything heavy is imported inside it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError
from pkm_exact.files import write_all
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.following.follower import Followed
    from pkm_exact.geometry.nominal_pose import NominalPose
    from pkm_exact.interactive.robots import Robot
    from pkm_exact.solution import Solution


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.option("-o", "--output", type=arguments.FilePath(), metavar="DIR", required=True, help="Folder for the files.")
@arguments.configuration_option
@click.option(
    "--pose",
    type=click.IntRange(1),
    metavar="K",
    help="Number of the pose, as `solve` prints them, where example and test begin.  [default: the one nearest to the "
    "model's nominal pose; without that the best conditioned]",
)
@click.option("--name", metavar="NAME", help="What files and functions begin with.  [default: that of the model file]")
@click.option("--force", is_flag=True, help="Overwrite files that exist.")
def codegen(model: str, output: str, configuration: str | None, pose: int | None, name: str | None, force: bool) -> int:
    """Write the kinematics of the robot in the file MODEL as C: NAME.h, NAME.c, NAME_example.c and NAME_test.c.

    C99 without allocation or libraries. Forward kinematics follows the pose from one set of joint values to the next:
    with each pose it says how far it may be off, whether it is proved to be the only one near, and whether it is proved
    to be of the same assembly mode as the last. The test compares 10,000 poses with inverse kinematics.

    \b
    Examples:
      certify-poses codegen models/rolland-6-6.toml -o controller
      certify-poses codegen models/3-rrr.toml -o controller --pose 2 --name arm
    """
    from pkm_exact.cli.model_reading import announced_robot
    from pkm_exact.following.c_files import c_files, checked_name, name_for
    from pkm_exact.interactive.robots import Robot

    announced_robot(model, "codegen")
    robot = Robot.load(model)
    stem = checked_name(name or name_for(Path(model).stem))
    home = _home(robot, model, configuration, pose)
    files = c_files(stem, home.tables, home, Path(model).name)
    folder = Path(output)
    _require_room(folder, list(files), force)
    try:
        write_all(folder, {file_name: text.encode("utf-8") for file_name, text in files.items()})
    except OSError as error:
        raise InputError(
            f"{error.filename or folder}: cannot be written ({error.strerror}), so nothing was; give -o the path of "
            "another folder"
        ) from None
    shown = printable(str(folder))
    click.echo(f"{shown}: {', '.join(files)}")
    click.echo(f"next: cd {shown} && cc -std=c99 -O2 {stem}_test.c {stem}.c -lm -o {stem}_test && ./{stem}_test")
    return ExitCode.DONE


def _home(robot: Robot, model: str, configuration: str | None, pose: int | None) -> Followed:
    """A pose of the configuration of which following can prove something."""
    from pkm_exact.following.following_start import joint_values
    from pkm_exact.interactive.progress import Progress

    try:
        chosen = robot.configuration(configuration)
    except InputError as error:
        raise InputError(f"{model}: {error}") from None
    with Progress(verbose=False) as progress:
        solution = robot.solve(configuration=chosen.name, progress=progress)
    number = _number(solution, model, pose, robot.nominal)
    home = robot.follow(joint_values(robot, chosen), solution.poses[number - 1])
    if not home.is_proved:
        raise InputError(
            f"{model}: in doubles nothing can be proved of this pose, it is too near to a singular one; give --pose or "
            "--configuration with a better one"
        )
    return home


def _number(solution: Solution, model: str, pose: int | None, nominal: NominalPose | None) -> int:
    """The pose asked for, or the one nearest to the nominal pose, or that with the least condition number."""
    from pkm_exact.poses.nearest_pose import nearest_pose

    count = len(solution.poses)
    if count == 0:
        raise InputError(f"{model}: this configuration has no real pose to begin at; give --configuration with another")
    if pose is not None:
        if pose > count:
            raise InputError(f"--pose: {pose} is not among the {count} poses of this configuration; give 1 to {count}")
        return pose
    nearest = nearest_pose(solution.poses, nominal) if nominal is not None else None
    if nearest is not None:
        return nearest.numbers[0]
    conditions = [entry.condition.hi if entry.condition is not None else None for entry in solution.poses]
    known = [(value, number) for number, value in enumerate(conditions, 1) if value is not None]
    return min(known)[1] if known else 1


def _require_room(folder: Path, names: list[str], force: bool) -> None:
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is not a folder; give -o the path of one")
    for name in names:
        if (folder / name).exists() and not force:
            raise InputError(f"{folder / name}: exists; give -o another folder, or --force to overwrite it")

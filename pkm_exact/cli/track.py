"""The command ``track``: one assembly mode along a joint path. Everything heavy is imported inside it."""

from __future__ import annotations

import time
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click
from click.core import ParameterSource

from pkm_exact.cli import arguments
from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.stages import Amount
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pkm_exact.cli.intended_report import Intended
    from pkm_exact.cli.track_store import TrackStore
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.path_reader import JointPath
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.numeric.tracked_branch import BranchPoint, TrackedSample
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution

_SUFFIXES: Final = (".csv", ".json")
_SECONDS_PER_SYNC: Final = 2.0
_SECONDS_PER_LINE: Final = 0.1


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.argument("path", type=arguments.FilePath(), metavar="PATH.csv")
@click.option(
    "--start",
    "number",
    callback=arguments.start_pose,
    metavar="POSE",
    help="The pose to follow: its number or name in the list that `solve` prints for the path's first row, or near: "
    "the one nearest to the model's nominal pose. Not for poses.",
)
@click.option(
    "--working-modes",
    "modes",
    metavar="SIGNS",
    help="For a path of poses of slides or cranks: a sign for each leg, such as +,-,+.",
)
@click.option(
    "--intended",
    type=arguments.FilePath(),
    metavar="POSES.csv",
    help="Poses that are meant at the rows of a path of joint values, as a path of poses: say where they part.",
)
@click.option(
    "--within",
    metavar="LENGTH,DEGREES",
    help="How far the branch may be from the intended poses, exact: 0.1,0.05.",
)
@arguments.width_option
@click.option(
    "-o",
    "--output",
    type=arguments.FilePath(),
    required=True,
    metavar="OUT",
    help="Write the samples to OUT.csv or OUT.json.",
)
@click.option("--exact", is_flag=True, help="In a .csv file exact bounds, not decimals; a .json file has them always.")
@click.option("-v", "--verbose", is_flag=True, help="Say more: stages and rows on a terminal.")
def track(
    model: str,
    path: str,
    number: int | str | None,
    modes: str | None,
    intended: str | None,
    within: str | None,
    width: Fraction,
    output: str,
    exact: bool,
    verbose: bool,
) -> int:
    """Follow one pose of the robot in the file MODEL along a path of joint values, and prove that it is one branch.

    PATH.csv has one row per sample: leg lengths (slide positions q1,.., or half tangents h1,.. of crank angles, or the
    angles as 30deg; values of actuated constraints under their names), all exact, and before them, if wanted, the
    time; between rows the path is straight in these values, for cranks in half tangents. OUT gets a certified box of
    the pose at every row. Every step in between is proved to stay on the same branch, away from singularities; where
    that cannot be proved, OUT ends there, with exit code 3.

    With columns of poses instead (x,y,z,roll,pitch,yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll), or x,y,z,q0,..,q3;
    planar x,y,theta; named in the first line) the joint values follow from them, and over every whole step it is
    proved that the poses are reached, away from singularities, within the limits; or it is said where that ends.

    With --intended the poses that are meant at the rows are compared with the branch: a path through a singularity may
    be followed well, and be another motion.

    An interrupted run leaves OUT.partial beside OUT; the same command goes on from there.

    \b
    Example:
      certify-poses track models/rolland-6-6.toml path.csv --start 10 -o poses.csv
    """
    target = Path(output)
    if target.suffix.lower() not in _SUFFIXES:
        raise click.UsageError(f"-o: {printable(output)} ends neither in .csv nor in .json; give it one of these.")
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.geometry.pose_path_reader import read_pose_path

    robot = announced_model(model)
    poses = read_pose_path(path, robot)
    arguments.require_other_file(target, model, "-o")
    arguments.require_other_file(target, path, "-o", "the file of the path")
    arguments.require_writable(target, "-o")
    if poses is not None:
        if number is not None:
            raise click.UsageError("--start: the poses of the path say themselves which are meant; leave it out.")
        _refuse_for_poses(click.get_current_context())
        from pkm_exact.cli.pose_track import follow_poses

        return follow_poses(robot, poses, target, modes, verbose=verbose)
    if number is None or modes is not None:
        what = "--working-modes: is for a path of poses" if modes is not None else "--start: is missing"
        raise click.UsageError(f"{what}; a path of joint values needs --start and nothing else.")
    from pkm_exact.cli.intended_report import intended as read_intended

    if intended is not None:
        arguments.require_other_file(target, intended, "-o", "the file of the intended poses")
    wanted = read_intended(intended, within, robot)
    return _track_joints(robot, (model, path), number, width, target, wanted, exact=exact, verbose=verbose)


def _refuse_for_poses(context: click.Context) -> None:
    """Refuse options that have no effect on a path of poses, whose joint values are written with guaranteed digits."""
    for parameter in ("width", "exact", "intended", "within"):
        if context.get_parameter_source(parameter) is not ParameterSource.DEFAULT:
            raise click.UsageError(f"--{parameter}: is for a path of joint values; leave it out for one of poses.")


def _track_joints(
    robot: Robot | Mechanism,
    files: tuple[str, str],
    number: int | str,
    width: Fraction,
    target: Path,
    wanted: Intended | None,
    *,
    exact: bool,
    verbose: bool,
) -> int:
    """Follow a pose along a path of joint values, and write the samples; files are those of model and path."""
    from pkm_exact.cli.intended_report import compared, said
    from pkm_exact.cli.joint_words import say_notes
    from pkm_exact.cli.track_report import start_line, written
    from pkm_exact.cli.track_store import TrackStore
    from pkm_exact.geometry.path_reader import read_path
    from pkm_exact.interactive.progress import Progress

    model, path = files
    joints = read_path(path, robot)
    say_notes(joints.stand_ins)
    if wanted is not None:
        wanted.read_with(joints)
    if number == arguments.NEAR:
        number = _nearest(robot, model, joints, width, verbose=verbose)
    if isinstance(number, str):
        number = _named(robot, joints, number, width, verbose=verbose)
    with TrackStore(target, _job(robot, joints, number, width)) as store, Progress(verbose=verbose) as progress:
        try:
            stopped = _follow(robot, joints, number, width, store, progress)
        except InputError as error:
            if not store.records:
                store.remove()
            raise InputError(f"{path}: {error}") from None
        except KeyboardInterrupt:
            click.echo(f"{PROGRAM}: interrupted after row {len(store.records)}; the same command goes on", err=True)
            raise
        try:
            off = None if wanted is None else compared(wanted, store.records)
            written(target, robot, joints, number, store.records, stopped, exact=exact, intended=off)
        except OSError as error:
            raise InputError(f"{target}: cannot be written ({error.strerror}); give another path to -o") from None
        store.remove()
    click.echo(start_line(number, proved=store.records[0]["start_proved"]))
    steps = sum(record["steps"] for record in store.records)
    click.echo(
        f"{len(store.records)} of {len(joints.rows)} rows, {steps} certified steps: one branch, det J "
        f"{'>' if store.records[0]['point']['det_sign'] > 0 else '<'} 0 all along"
    )
    is_meant = off is None or not (off["parted_at_row"] or off["undecided_rows"])
    if wanted is not None and off is not None:
        click.echo(said(wanted, off))
    if stopped is not None:
        click.echo(stopped["reason"])
    return ExitCode.DONE if stopped is None and is_meant else ExitCode.WEAKER_CLAIM


def _nearest(robot: Robot | Mechanism, model: str, joints: JointPath, width: Fraction, *, verbose: bool) -> int:
    """The number of the pose at the first row that is nearest to the nominal one."""
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.poses.nearest_pose import nearest_pose

    if robot.nominal is None:
        raise InputError(
            f"{model}: --start near: the model has no nominal pose; add a table [nominal] or give a number"
        )
    with Progress(verbose=verbose) as progress:
        found = nearest_pose(_solution(robot, joints, width, progress).poses, robot.nominal)
    if found is None:
        raise InputError(f"{model}: --start near: the first row has no pose; give other joint values")
    if len(found.numbers) > 1:
        raise InputError(
            f"{model}: --start near: poses {', '.join(map(str, found.numbers))} are equally near; give one of these"
        )
    return found.numbers[0]


def _named(robot: Robot | Mechanism, joints: JointPath, name: str, width: Fraction, *, verbose: bool) -> int:
    """The number of the pose at the first row that has a name."""
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.poses.pose_names import pose_names

    with Progress(verbose=verbose) as progress:
        names = pose_names(_solution(robot, joints, width, progress).poses, robot.motion)
    if name not in names:
        raise InputError(
            f"--start {name}: the first row has no pose of that name; give one of {', '.join(names) or 'another row'}"
        )
    return names.index(name) + 1


def _job(robot: Robot | Mechanism, joints: JointPath, number: int, width: Fraction) -> str:
    """All that the samples depend on."""
    import pkm_exact
    from pkm_exact.geometry.mechanism import Mechanism

    if isinstance(robot, Mechanism):
        made_of: tuple[object, ...] = (robot.motion, robot.constraints, robot.actuated, robot.drives)
    else:
        made_of = (robot.base_joints, robot.platform_joints, robot.chains)
    parts = (robot.kind, robot.metric, *made_of, joints, number, width)
    return repr((pkm_exact.__version__, robot.name, robot.unit, *parts))


def _follow(
    robot: Robot | Mechanism, joints: JointPath, number: int, width: Fraction, store: TrackStore, progress: Progress
) -> dict[str, Any] | None:
    """Add what is missing to the store; return where and why the branch ends, if it does."""
    from pkm_exact.cli.track_report import point_of, record_of, stop_of
    from pkm_exact.numeric.tracked_branch import TrackingStopped
    from pkm_exact.numeric.trajectory import track_branch

    start: Pose | BranchPoint
    poses: tuple[Pose, ...] = ()
    if store.records:
        start, proved = point_of(store.records[-1]["point"]), store.records[0]["start_proved"]
    else:
        solution = _solution(robot, joints, width, progress)
        poses, proved = solution.poses, solution.is_complete
        if number > len(poses):
            raise InputError(f"--start {number}: the first row has {len(poses)} poses; give a number up to that")
        start = poses[number - 1]
    shown = _Shown(progress, len(joints.rows))
    samples = track_branch(robot, joints.rows, start, poses=poses, width=width, on_step=shown)
    try:
        for sample in _synced(samples, store):
            store.add(record_of(sample, start_proved=proved))
    except TrackingStopped as stop:
        return stop_of(stop, joints)
    return None


def _solution(robot: Robot | Mechanism, joints: JointPath, width: Fraction, progress: Progress) -> Solution:
    from pkm_exact.numeric.path_forms import problem_at
    from pkm_exact.numeric_engine import solve_krawczyk

    return solve_krawczyk(problem_at(robot, joints.rows[0]), width=width, progress=progress)


def _synced(samples: Iterator[TrackedSample], store: TrackStore) -> Iterator[TrackedSample]:
    last = time.monotonic()
    for sample in samples:
        yield sample
        if time.monotonic() - last > _SECONDS_PER_SYNC:
            store.sync()
            last = time.monotonic()


class _Shown:
    """Shows how far the branch is proved, a few times a second."""

    def __init__(self, progress: Progress, rows: int) -> None:
        self._progress, self._rows, self._last = progress, rows, 0.0
        progress("following the branch")

    def __call__(self, row: int, reached: Fraction) -> None:
        now = time.monotonic()
        if now - self._last < _SECONDS_PER_LINE:
            return
        self._last = now
        detail = f"{100 * float(reached):.3g} % of the way to the next"
        self._progress.amount(Amount(row + 1, self._rows, "rows", detail=detail))

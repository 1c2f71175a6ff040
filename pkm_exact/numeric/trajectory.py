"""Following one assembly mode along a joint path: one continuous branch of poses, proved from row to row.

Between two rows the path is straight in the joint values. Every step is proved by a tube (``tube``) that holds exactly
one solution for each path parameter; the box in which the branch leaves a tube lies in the first slice of the next one,
so that both hold the same branch. At every row the branch's solution is proved in a narrow box, which lies in the last
slice of the tube that leads there and enters the first one that leads on. The Jacobian is regular all along: the sign
of its determinant is that of the start.

Where no tube can be proved for the smallest step, the branch ends: a singularity is there, or too near to be excluded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from flint import acb, acb_mat, arb, arb_mat

from pkm_exact.errors import InputError, InternalContradictionError
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.centred import CentredFrames, CentredRobot, centred_frames, centred_robot
from pkm_exact.numeric.charts import in_chart
from pkm_exact.numeric.linearisation import Linearisation, chart_weights
from pkm_exact.numeric.nominal import certified_point, certified_pose, core_radii, exact_integer
from pkm_exact.numeric.path_forms import JointRow
from pkm_exact.numeric.pose_maps import pose_map
from pkm_exact.numeric.problem_path import ProblemPath, RobotRows
from pkm_exact.numeric.tracked_branch import BranchPoint, TrackedSample, TrackingStopped, TrackPolicy
from pkm_exact.numeric.tube import FloatPath, Prediction, Tube, floats, predict, prove, station
from pkm_exact.poses.boxes import DEFAULT_WIDTH, Enclosures, disjoint_cells, exponent_for_width, pose_in_cells
from pkm_exact.poses.jacobian import pose_jacobians
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision

STEP_PRECISION: Final = 96
"""Bits of the balls in which a step is proved."""
GUARD_BITS: Final = 64


def track_branch(
    robot: Machine,
    rows: Sequence[JointRow],
    start: Pose | BranchPoint,
    *,
    poses: Sequence[Pose] = (),
    width: Fraction = DEFAULT_WIDTH,
    policy: TrackPolicy | None = None,
    on_step: Callable[[int, Fraction], None] | None = None,
) -> Iterator[TrackedSample]:
    """The poses of one branch at all rows of a path, each proved to be joined to the one before.

    Parameters
    ----------
    robot : Machine
    rows : sequence of tuples of Fraction
        Leg lengths, slide positions, or half tangents of crank angles; of a mechanism lengths, offsets and products:
        the path is straight between them.
    start : Pose or BranchPoint
        A certified regular pose for the first row; or a point of an earlier run, and only what follows it is yielded.
    poses : sequence of Pose, optional
        The list in which the start was found: its box must be the only one that meets the branch.
    width : Fraction
        Largest width of a box of a pose, in any coordinate.
    policy : TrackPolicy, optional
    on_step : callable, optional
        Gets the row and how far on the way to the next one the branch is proved, after every step.

    Raises
    ------
    InputError
        If the start is singular, or a row has values that the robot cannot have; if a mechanism has quadrics among its
        constraints, or not as many equations as freedoms.
    TrackingStopped
        If the branch cannot be followed farther; all samples before it were yielded.

    Examples
    --------
    >>> from pkm_exact import solve
    >>> from pkm_exact.geometry.robot import Robot
    >>> joints = lambda *rows: tuple(tuple(map(Fraction, row)) for row in rows)
    >>> corners = joints((0, 0), (10, 0), (3, 10)), joints((0, 0), (4, 0), (2, 2))
    >>> robot = Robot("example", "3-RPR", "m", "made up", *corners)
    >>> rows = joints((7, 5, 5), ("7.5", 5, 5))
    >>> poses = solve(robot.problem([length * length for length in rows[0]])).poses
    >>> [(sample.row, sample.det_sign) for sample in track_branch(robot, rows, poses[0])]
    [(0, -1), (1, -1)]
    """
    if isinstance(start, Pose):
        _require_regular(start)
    run = _Run(RobotRows(robot, rows), width, policy or TrackPolicy(), on_step)
    return run.samples(start, poses)


def followed_pose(
    path: ProblemPath, start: Pose, poses: Sequence[Pose], *, width: Fraction = DEFAULT_WIDTH
) -> TrackedSample:
    """The pose of the last robot of a path that a branch of regular poses joins to one of the first.

    Parameters
    ----------
    path : ProblemPath
    start : Pose
        Of the first robot; its Jacobian is not looked at.
    poses : sequence of Pose
        All poses of the first robot.
    width : Fraction
        Largest width of the box found, in any coordinate.

    Raises
    ------
    InputError
        If the start is singular or nearly so, or the robots are not of one make.
    TrackingStopped
        If the branch cannot be followed so far.

    Examples
    --------
    >>> from pkm_exact import read_robot, solve
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> near, far = robot.problem(robot.configuration()), robot.problem([Fraction(n) for n in (51, 26, 26)])
    >>> poses = solve(near).poses
    >>> [followed_pose(ProblemPath((near, far)), pose, poses).det_sign for pose in poses]
    [-1, 1]
    """
    *_, last = _Run(path, width, TrackPolicy(), None).samples(start, poses)
    return last


def _require_regular(start: Pose) -> None:
    if start.jacobian is None or start.jacobian.det_sign == 0:
        raise InputError("start: the pose is singular, or not proved regular; no single branch leads on from it")


def _require_tracked(problem: ForwardProblem) -> None:
    if problem.squares:
        raise InputError(
            "constraints: one is a quadric (axis-distance), but a branch can be followed only where all are linear; "
            "solve row by row (`sweep`)"
        )
    if len(problem.forms) != problem.motion.dimension:
        raise InputError(
            f"constraints: {len(problem.forms)} equations for {problem.motion.dimension} freedoms, but a branch can be "
            "followed only where there are as many; solve row by row (`sweep`)"
        )


@dataclass(frozen=True)
class _Run:
    path: RobotRows | ProblemPath
    width: Fraction
    policy: TrackPolicy
    on_step: Callable[[int, Fraction], None] | None

    def samples(self, start: Pose | BranchPoint, poses: Sequence[Pose]) -> Iterator[TrackedSample]:
        problem = self.path.problem(0)
        _require_tracked(problem)
        self.path.require()
        frames = centred_frames(problem)
        if isinstance(start, BranchPoint):
            point, near = start, self._again(frames, start)
        else:
            near = self._start(frames, start, poses or [start])
            point = self._branch_point(0, near, 0, self._sign(frames, near))
            yield TrackedSample(self._boxed(frames, 0, near), 0, point)
        for row in range(point.row, len(self.path) - 1):
            tube, steps, halvings = self._followed(frames, row, near, point.halvings)
            near = self._arrived(frames, row + 1, tube)
            point = self._branch_point(row + 1, near, halvings, point.det_sign)
            yield TrackedSample(self._boxed(frames, row + 1, near), steps, point)

    def _start(self, frames: CentredFrames, start: Pose, poses: Sequence[Pose]) -> Linearisation:
        with working_precision(self._exponent + GUARD_BITS):
            near = certified_pose(self._robot_at(0, frames), start, poses, self._exponent)
        if near is None:
            raise InputError("start: no box with exactly one pose was proved around it; it is nearly singular")
        return near

    @property
    def _exponent(self) -> int:
        """Grid of the boxes at rows: half of it suffices for the boxes of poses."""
        return 2 * (exponent_for_width(self.width) + 128)

    def _robot_at(self, row: int, frames: CentredFrames) -> CentredRobot:
        try:
            return centred_robot(self.path.problem(row), frames)
        except InputError as error:
            raise InputError(f"row {row + 1}: {error}") from None

    def _followed(self, frames: CentredFrames, row: int, near: Linearisation, halvings: int) -> tuple[Tube, int, int]:
        """The tube that reaches the next row, the number of steps, and the length of the next."""
        with working_precision(STEP_PRECISION):
            path = FloatPath.of(self.path.forms(frames, row))
            entering = _core_ball(near, self._exponent)
            here = predict(path, floats(entering)[:, 0], 0.0)
            reached, steps = Fraction(0), 0
            while here is not None:
                length = min(Fraction(1, 1 << halvings), 1 - reached)
                step = _step(path, here, entering, reached, length)
                if step is None:
                    if halvings >= self.policy.smallest_step:
                        raise TrackingStopped(row, reached, reached + length)
                    halvings += 1
                    continue
                tube, here, entering = step
                reached, steps = reached + length, steps + 1
                if self.on_step is not None:
                    self.on_step(row, reached)
                if tube.contraction < self.policy.easy:
                    halvings = max(0, halvings - 1)
                if reached == 1:
                    return tube, steps, halvings
        raise InternalContradictionError(f"row {row + 1}: Newton's method leaves a proved pose")

    def _arrived(self, frames: CentredFrames, row: int, tube: Tube) -> Linearisation:
        """The solution at a row, proved in a narrow box in the last slice of the tube that leads there."""
        with working_precision(self._exponent + GUARD_BITS):
            point = acb_mat([[acb(value.mid())] for value in tube.leaving.entries()])
            near = certified_point(self._robot_at(row, frames), point, self._exponent)
            if near is None or not tube.holds(in_chart(_core_ball(near, self._exponent), tube.weights)):
                raise InternalContradictionError(f"row {row + 1}: the pose at the end of a proved step was not found")
        return near

    def _branch_point(self, row: int, near: Linearisation, halvings: int, sign: int) -> BranchPoint:
        unit = arb(2) ** self._exponent
        with working_precision(2 * self._exponent):
            centre = tuple(exact_integer(value.real * unit) for value in near.centre.entries())
        return BranchPoint(row, near.chart, self._exponent, centre, halvings, sign)

    def _again(self, frames: CentredFrames, point: BranchPoint) -> Linearisation:
        """The solution at a row at which an earlier run stood, proved once more."""
        with working_precision(self._exponent + GUARD_BITS):
            robot = self._robot_at(point.row, frames)
            unit = arb(2) ** -point.exponent
            centre = acb_mat([[acb(value * unit)] for value in point.centre])
            near = certified_point(robot, centre, self._exponent)
            if near is None or self._branch_point(point.row, near, point.halvings, point.det_sign) != point:
                raise InputError(f"row {point.row + 1}: the interrupted run does not fit the path; start again")
        return near

    def _boxed(self, frames: CentredFrames, row: int, near: Linearisation) -> Pose:
        """The box of the pose at a row, on the grid on which solutions are listed."""
        _, cells = disjoint_cells(self._enclosures(frames, row, near), 1, self.width)
        return pose_in_cells(cells[0], None)

    def _sign(self, frames: CentredFrames, near: Linearisation) -> int:
        """That of det J at the start of the branch itself, which a list may not have, if it is not complete."""
        (jacobian,) = pose_jacobians(self._enclosures(frames, 0, near), self.path.problem(0), [None])
        return jacobian.det_sign or 0

    def _enclosures(self, frames: CentredFrames, row: int, near: Linearisation) -> Enclosures:
        """Those of the one solution near the branch at a row, as narrow as asked."""

        def enclosures(precision: int, indices: Sequence[int]) -> Iterable[list[arb]]:
            exponent = max(self._exponent, 2 * precision)
            with working_precision(exponent + GUARD_BITS):
                finer = near if exponent == self._exponent else self._finer(frames, row, near, exponent)
                x = finer.around(core_radii(finer.robot.size, exponent))
                values = pose_map(finer.robot, x).values[:16]
            return [values for _ in indices]

        return enclosures

    def _finer(self, frames: CentredFrames, row: int, near: Linearisation, exponent: int) -> Linearisation:
        robot = self._robot_at(row, frames)
        finer = certified_point(robot, near.centre, exponent)
        if finer is not None:
            weights = chart_weights(near.chart, robot.problem.motion)
            x = in_chart(finer.around(core_radii(robot.size, exponent)), weights)
            differences = (x - near.centre).entries()
            if all(abs(d.real) < r for d, r in zip(differences, core_radii(robot.size, self._exponent), strict=True)):
                return finer
        raise InternalContradictionError(f"row {row + 1}: the box of a proved pose cannot be narrowed")


def _core_ball(near: Linearisation, exponent: int) -> arb_mat:
    """The narrow box around a proved solution."""
    box = near.around(core_radii(near.robot.size, exponent))
    return arb_mat([[value.real] for value in box.entries()])


def _step(
    path: FloatPath, here: Prediction, entering: arb_mat, reached: Fraction, length: Fraction
) -> tuple[Tube, Prediction, arb_mat] | None:
    """The tube of one step, and the branch at its end: a prediction, and balls that hold it; None if not proved."""
    half = length / 2
    between = predict(path, here.point + float(half) * here.first, float(reached + half))
    tube = None if between is None else prove(path, between, entering, reached + half, half)
    end = None if tube is None else predict(path, floats(tube.end)[:, 0], float(reached + length))
    if tube is None or end is None:
        return None
    # The solution at the end is that of the branch: its box lies in the last slice of the tube, which holds no other.
    leaving = station(path, end, reached + length)
    if leaving is None or not tube.holds(in_chart(leaving, tube.weights)):
        return None
    return tube, end, leaving

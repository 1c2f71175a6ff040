"""One robot with many length vectors: arrays in, arrays out, every row certified by itself.

The numeric engine solves each row from one start section near the robot (``nearby``). Lengths are exact numbers; poses
come out as floating-point midpoints with half-widths that are rounded upwards, so that the exact value of each
coordinate provably lies within its half-width of the midpoint.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pkm_exact.batch.row_solver import TOGETHER, RowSolver
from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_jointed_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.indices.index import Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.interactive.answer_notes import digit_notes
from pkm_exact.interactive.facade import exact_length, exact_width
from pkm_exact.numeric.poses import Charted
from pkm_exact.policy import Policy
from pkm_exact.poses.arrays import array_value, rotations_of
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.pose import Interval, Pose

if TYPE_CHECKING:
    from scipy.spatial.transform import Rotation

ERROR: Final = "error"
"""In place of the claim of a row that could not be solved."""

Record: TypeAlias = np.void

ROW: Final = np.dtype(
    [("claim", "U32"), ("method", "U8"), ("count", "i8"), ("complex_solutions", "i8"), ("note", object)]
)


def pose_dtype() -> np.dtype[np.void]:
    """The type of an entry of ``ManySolutions.poses``."""
    return np.dtype(
        [
            ("row", "i8"),
            ("position", "f8", (3,)),
            ("position_half_width", "f8", (3,)),
            ("rotation", "f8", (3, 3)),
            ("rotation_half_width", "f8", (3, 3)),
            ("quaternion", "f8", (4,)),
            ("quaternion_half_width", "f8", (4,)),
            *((index.name, "i8" if index.is_integer else "f8") for index in shown_in(Output.ARRAYS)),
        ]
    )


@dataclass(frozen=True, eq=False)
class ManySolutions:
    """The poses of one robot at many length vectors.

    Attributes
    ----------
    rows : structured array, one entry per length vector
        ``claim`` as in ``Claim``, or "error"; ``method``, "krawczyk" or "exact"; ``count`` of real poses;
        ``complex_solutions``; ``note``, which says why the exact engine answered, or what the error is.
    poses : structured array, one entry per real pose
        ``row`` from 0, then ``position`` (3), ``rotation`` (3, 3) and ``quaternion`` (4, real part first), each with
        its ``.._half_width``: the exact value lies within it of the midpoint. Then the indices: ``det_sign`` of the leg
        Jacobian, 0 at a singular pose, 2 if it was not decided; ``condition``, infinite or nan then.

    Examples
    --------
    >>> from pkm_exact import solve_many
    >>> found = solve_many("models/3-rpr-merlet-p.toml", [[7, 5, 5], ["7.1", 5, 5]])
    >>> [int(count) for count in found.rows["count"]], found.poses["position"].shape
    ([2, 2], (4, 3))
    """

    rows: NDArray[Record]
    poses: NDArray[Record]

    @property
    def fallbacks(self) -> int:
        """Number of rows that the exact engine answered in place of the numeric one."""
        return int(np.count_nonzero(self.rows["method"] == "exact"))

    @property
    def errors(self) -> int:
        """Number of rows without an answer."""
        return int(np.count_nonzero(self.rows["claim"] == ERROR))

    def rotations(self) -> Rotation:
        """The rotations of all poses, in their order, for scipy; it must be installed.

        Raises
        ------
        PkmExactError
            If scipy is not installed.
        """
        return rotations_of(self.poses["quaternion"], "rotations")

    def __str__(self) -> str:
        claims, counts = np.unique(self.rows["claim"], return_counts=True)
        parts = [f"{count} {claim.replace('-', ' ')}" for claim, count in zip(claims, counts, strict=True)]
        return (
            f"{len(self.rows)} length vectors, {len(self.poses)} real poses; rows: {', '.join(parts) or 'none'}; "
            f"answered by the exact engine: {self.fallbacks}"
        )

    def __repr__(self) -> str:
        return f"ManySolutions({len(self.rows)} rows, {len(self.poses)} poses)"

    def _repr_html_(self) -> str:
        from pkm_exact.interactive.display import many_html

        return many_html(str(self), list(self.rows))


def solve_many(
    robot: Robot | str | Path,
    lengths: ArrayLike | Sequence[Sequence[object]],
    *,
    squared: bool = False,
    doubles_are_exact: bool = False,
    width: Fraction | int | str = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Callable[[int], None] | None = None,
) -> ManySolutions:
    """All real poses of a robot at each of many length vectors; an error in one row does not stop the others.

    Parameters
    ----------
    robot : Robot or path
        Actuated by its leg lengths; or the path of its model file.
    lengths : (n, 6) array, or (n, 3) of a planar robot
        Exact: integers, fractions, decimals, or strings such as "1250.5", "1.2505e3" or "2501/2".
    squared : bool
        Whether they are squared lengths.
    doubles_are_exact : bool
        Floating-point numbers are refused, unless this says that each is meant to be the rational number that it is
        in binary.
    width : Fraction or str
        Largest width of a box, in every coordinate (unit of length, or 1 for rotations).
    policy : Policy, optional
        Limits and random choices.
    progress : callable, optional
        Gets the number of rows that are done, after each.

    Raises
    ------
    InputError
        If the robot is not actuated by its lengths, the array has the wrong shape, or a number in it is a binary float.

    Examples
    --------
    >>> joints = lambda *rows: tuple(tuple(map(Fraction, row)) for row in rows)
    >>> corners = joints((0, 0), (10, 0), (3, 10)), joints((0, 0), (4, 0), (2, 2))
    >>> found = solve_many(Robot("example", "3-RPR", "m", "made up", *corners), [[7, 5, 5], ["7.5", 5, "-1"]])
    >>> [(str(row["claim"]), int(row["count"])) for row in found.rows], found.poses["det_sign"].tolist()
    ([('complete', 2), ('error', 0)], [-1, 1])
    >>> found.rows["note"][1]
    'lengths, row 2, leg 3: -1 is not positive; give a number greater than 0'
    """
    if not isinstance(robot, Robot):
        robot = read_jointed_robot(Path(robot), "solve_many")
    policy, width = policy or Policy(), exact_width(width)
    problems = [
        _problem(robot, row, number, squared, doubles_are_exact)
        for number, row in enumerate(_table(robot, lengths, doubles_are_exact), 1)
    ]
    solver = RowSolver.of([problem for problem in problems if isinstance(problem, ForwardProblem)], width, policy)
    rows, poses = np.zeros(len(problems), ROW), []
    for first in range(0, len(problems), TOGETHER):
        few = problems[first : first + TOGETHER]
        near = iter(solver.near([problem for problem in few if isinstance(problem, ForwardProblem)]))
        for number, problem in enumerate(few, first):
            known = next(near) if isinstance(problem, ForwardProblem) else None
            rows[number], found = _row(solver, number, problem, known, robot.written_digit)
            poses.append(found)
            if progress is not None:
                progress(number + 1)
    return ManySolutions(rows, np.concatenate([np.zeros(0, pose_dtype()), *poses]))


def _table(robot: Robot, lengths: Any, doubles_are_exact: bool) -> list[list[object]]:
    """The rows of the array, entries as Python's own numbers and strings."""
    if robot.chains:
        raise InputError(f"lengths: the rods of a {robot.kind} robot have fixed lengths; solve its configurations")
    try:
        # Not the type that numpy would choose: it turns large integers into floating-point numbers.
        array = lengths if isinstance(lengths, np.ndarray) else np.array(lengths, dtype=object)
    except ValueError:
        raise InputError("lengths: the rows are not equally long; give one length per leg in each") from None
    legs = KINDS[robot.kind].legs
    if array.ndim != 2 or array.shape[1] != legs:
        raise InputError(f"lengths: an array of shape {array.shape}; give rows of {legs} numbers, one per leg")
    rows: list[list[object]] = array.tolist()
    if not doubles_are_exact:
        _refuse_floats(rows)
    return rows


def _refuse_floats(rows: Sequence[Sequence[object]]) -> None:
    """A float is a slip of the program that calls, not of the data of one row: nothing is solved."""
    for number, row in enumerate(rows, 1):
        for leg, value in enumerate(row, 1):
            if isinstance(value, float | np.floating):
                raise InputError(
                    f"lengths, row {number}, leg {leg}: {value!r} is a binary float, not exact; give strings such as "
                    '"1250.5", or say that each float is meant to be the rational number that it is in binary '
                    "(doubles_are_exact=True)"
                )


def _problem(
    robot: Robot, row: Sequence[object], number: int, squared: bool, doubles_are_exact: bool
) -> ForwardProblem | str:
    try:
        values = [
            exact_length(value, f"lengths, row {number}, leg {leg}", doubles_are_exact=doubles_are_exact)
            for leg, value in enumerate(row, 1)
        ]
        return robot.problem(values if squared else [value * value for value in values])
    except PkmExactError as error:
        return str(error)


def _row(
    solver: RowSolver, number: int, problem: ForwardProblem | str, near: Charted | None, digit: Fraction | None
) -> tuple[tuple[Any, ...], NDArray[Record]]:
    """The entries of one row and of its poses."""
    if isinstance(problem, str):
        return (ERROR, "", 0, 0, problem), np.zeros(0, pose_dtype())
    try:
        solution = solver.solution(problem, near)
        poses = np.array([_entry(number, pose) for pose in solution.poses], pose_dtype())
    except PkmExactError as error:
        return (ERROR, "", 0, 0, f"lengths, row {number + 1}: {error}"), np.zeros(0, pose_dtype())
    notes = "; ".join((*solution.notes, *digit_notes(problem, solution.poses, digit)))
    return (solution.claim.value, solution.method, len(poses), solution.complex_solutions, notes), poses


def _entry(number: int, pose: Pose) -> tuple[Any, ...]:
    """A pose as an entry of the array ``poses``."""
    indices = (array_value(index, pose) for index in shown_in(Output.ARRAYS))
    rotation = [_balls(row) for row in pose.rotation]
    matrices = [middles for middles, _ in rotation], [widths for _, widths in rotation]
    return (number, *_balls(pose.position), *matrices, *_balls(pose.quaternion), *indices)


def _balls(intervals: Iterable[Interval]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    middles, widths = zip(*(ball_of(interval) for interval in intervals), strict=True)
    return middles, widths


def ball_of(interval: Interval) -> tuple[float, float]:
    """Midpoint and half-width in floating point: the interval is covered, exactly.

    Raises
    ------
    PkmExactError
        If the interval is out of reach of floating point.

    Examples
    --------
    >>> middle, half_width = ball_of(Interval(Fraction(1, 3), Fraction(1, 3)))
    >>> middle, 0 < half_width < 1e-16
    (0.3333333333333333, True)
    """
    try:
        return interval.ball()
    except OverflowError:
        raise PkmExactError("a coordinate is too large for floating point; solve this row by itself") from None

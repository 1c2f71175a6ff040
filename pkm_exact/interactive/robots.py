"""The robot as users have it in hand: the data of a model file, and the questions that can be asked about it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Literal, Self

import pkm_exact.geometry.mechanism as mechanisms
import pkm_exact.geometry.reader as reader
import pkm_exact.geometry.robot as robots
from pkm_exact.errors import InputError
from pkm_exact.geometry.machine import Machine
from pkm_exact.interactive.facade import Question, options, posed
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.following.follower import Followed
    from pkm_exact.following.leg_tables import Array, LegTables
    from pkm_exact.geometry.mechanism import LockedValues
    from pkm_exact.geometry.robot import Configuration
    from pkm_exact.interactive.answers import Solution
    from pkm_exact.policy import Policy
    from pkm_exact.poses.pose import Pose
    from pkm_exact.regions.index_extremes import IndexRange
    from pkm_exact.regions.joint_ranges import JointRange
    from pkm_exact.regions.largest_region import LargestAnswer
    from pkm_exact.regions.region_designs import Designs
    from pkm_exact.regions.region_solver import RegionAnswer
    from pkm_exact.regions.singularity_locus import Locus
    from pkm_exact.statics.at_pose import AtPose


class Asked(Machine):
    """What can be asked of every robot."""

    def _repr_html_(self) -> str:
        from pkm_exact.interactive.display import robot_html

        return robot_html(self)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """The robot in a model file, of this class; ``read_robot`` takes files of every kind.

        Raises
        ------
        InputError
            If the file cannot be read, is not a model, or is one of another class; the message says what to do.

        Examples
        --------
        >>> print(Robot.load("models/3-rpr-merlet-p.toml"))
        Merlet 3-RPR (3-RPR, lengths in 1), configurations: home
        >>> print(Mechanism.load("models/delta.toml"))
        Delta (delta, lengths in 1), configurations: home, level
        """
        found = read_robot(path)
        if isinstance(found, cls):
            return found
        raise InputError(
            f"{printable(os.fspath(path))}: kind: {found.kind} is not one of {cls.__name__}; load it with "
            f"{type(found).__name__}.load or read_robot"
        )

    def solve(
        self,
        lengths: Sequence[object] | None = None,
        *,
        configuration: Configuration | LockedValues | str | None = None,
        method: Literal["exact", "krawczyk"] = "exact",
        formulation: str | None = None,
        width: Fraction | int | str | None = None,
        squared: bool = False,
        doubles_are_exact: bool = False,
        policy: Policy | None = None,
        progress: Callable[[str], None] | bool | None = None,
    ) -> Solution:
        """All real poses for a configuration, or for given leg lengths, each in a box, and what is proved of the list.

        Parameters
        ----------
        lengths : sequence of int, Fraction, Decimal or str, optional
            One per leg, exact: 1250, "1250.5", "2501/2", Fraction(2501, 2).
        configuration : str or Configuration, optional
            Instead of lengths; the first of the robot if neither is given.
        method : {"exact", "krawczyk"}
            Elimination over the rationals, or path tracking and proof by Krawczyk's operator.
        formulation : str, optional
            For the method exact: code of the system of equations that is solved, by default SE3.
        width : Fraction, int or str, optional
            Greatest width of a box, exact: "1e-12". By default 10^-9.
        squared : bool
            Whether the lengths given are squared ones.
        doubles_are_exact : bool
            Floats are refused, unless this says that each is meant to be the rational number that it is in binary.
        policy : Policy, optional
            Limits and random choices.
        progress : callable or bool, optional
            Gets a line when a stage starts; True shows progress on a terminal or in a notebook.

        Raises
        ------
        InputError
            If the arguments do not fit the robot; the message says what would.
        PkmExactError
            If there is no answer.

        Examples
        --------
        >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
        >>> print(robot.solve())
        6 complex solutions, 2 real poses; complete
        >>> print(robot.solve(["7.1", "26/5", 5], method="krawczyk", width="1e-12"))
        6 complex solutions, 2 real poses; complete
        """
        from pkm_exact.interactive.questions import solve, solve_krawczyk

        question = Question(lengths, configuration, method, formulation, width, squared, doubles_are_exact)
        name, problem = posed(self, question)
        chosen = options(question) | {"policy": policy}
        with _shown(progress) as show:
            engine: Callable[..., Solution] = solve_krawczyk if method == "krawczyk" else solve
            return replace(engine(problem, progress=show, **chosen), robot=self, configuration=name)

    def at(
        self,
        pose: Mapping[str, Any] | Pose,
        *,
        configuration: Configuration | LockedValues | str | None = None,
        modes: str | None = None,
    ) -> AtPose:
        """The machine at a pose: wrenches, Jacobians, ranks and singularities, exact or enclosed.

        Parameters
        ----------
        pose : mapping or Pose
            A pose as model files have it, exact and in the coordinates of the file: {"position": [..], "quaternion":
            [..]}, or {"position": [x, y], "half_tangent": t} in the plane; or a pose of a solution.
        configuration : str or Configuration, optional
            That of the solution, by default the first; at an exact pose, whose joint values slides or cranks have.
        modes : str, optional
            At an exact pose of slides or cranks, instead: a sign for each leg (``statics.placement.equations_at``).

        Raises
        ------
        InputError
            If the machine cannot be there.

        Examples
        --------
        >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
        >>> robot.at(robot.solve().poses[0]).jacobian.to_numpy().shape
        (3, 3)
        """
        from pkm_exact.statics.machine_at_pose import machine_at

        return machine_at(self, pose, configuration, modes)

    def region(
        self, question: str | os.PathLike[str], *, workers: int = 1
    ) -> RegionAnswer | LargestAnswer | Locus | IndexRange | tuple[JointRange, ...] | Designs:
        """The answer to a question about all poses of a region.

        Parameters
        ----------
        question : str or path
            The path of a question file, or its text with the tables [region], [conditions] and [answer].
        workers : int
            Processes; the answer does not depend on them.

        Raises
        ------
        InputError
            If the question is not one about this robot; the message says what to do. The answer "threshold" varies a
            number of a model file: it has the command only.

        Examples
        --------
        >>> text = "[region]\\nposition = [[4, 6], [4, 6]]\\ndegrees = [-5, 5]\\n"
        >>> text += "[conditions]\\nno_type_2 = true\\n[answer]\\nkind = 'all'"
        >>> Robot.load("models/3-rpr-merlet-p.toml").region(text).is_proved
        True
        """
        from pkm_exact.regions.index_extremes import index_range
        from pkm_exact.regions.joint_ranges import joint_ranges
        from pkm_exact.regions.largest_region import largest
        from pkm_exact.regions.question_reader import of_size, question_from_toml, read_question
        from pkm_exact.regions.region_designs import designs
        from pkm_exact.regions.region_legs import region_machine
        from pkm_exact.regions.region_solver import answered
        from pkm_exact.regions.region_workers import workers as working
        from pkm_exact.regions.singularity_locus import locus

        machine = region_machine(self)
        is_text = isinstance(question, str) and "\n" in question
        asked = question_from_toml(str(question), machine) if is_text else read_question(question, machine)
        if asked.answer.kind == "threshold":
            raise InputError("answer.kind: a threshold varies a number of a model file; use `certify-poses region`")
        if asked.answer.kind == "locus":
            return locus(machine, asked)
        if asked.answer.kind == "designs":
            return designs(machine, asked)
        if asked.answer.kind == "extremes":
            return joint_ranges(machine, asked) if asked.answer.of == "joint_values" else index_range(machine, asked)
        with working(machine, workers) as run:
            if asked.answer.kind == "largest":
                return largest(machine, asked, lambda size: of_size(asked, machine, size), run=run)
            return answered(machine, asked, run=run)


@dataclass(frozen=True, repr=False)
class Robot(Asked, robots.Robot):
    __doc__ = robots.Robot.__doc__

    @classmethod
    def from_arrays(
        cls,
        base: Iterable[Iterable[object]],
        platform: Iterable[Iterable[object]],
        *,
        digits: int | None = None,
        doubles_are_exact: bool = False,
        name: str = "robot",
        unit: str = "mm",
        source: str = "arrays of joints",
    ) -> Self:
        """The 6-UPS robot with these joints, or the 3-RPR robot if there are three legs.

        Parameters
        ----------
        base, platform : n x 3 arrays of numbers, or n x 2 if planar
            A joint a row, leg by leg; numpy arrays or lists, in ordinary coordinates.
        digits : int, optional
            Decimals to which every number is rounded. Floats need this, or
        doubles_are_exact : bool
            that each is meant to be the rational number that it is in binary.
        name, unit, source : str

        Raises
        ------
        InputError
            If the joints are none of a robot, or it is not said how floats are meant.

        Examples
        --------
        >>> robot = Robot.from_arrays([[0, 0], [10, 0], [3, 10]], [[0, 0], [4.0, 0], [2, 2.0000001]], digits=4)
        >>> robot.kind, robot.platform_joints[2][1]
        ('3-RPR', Fraction(2, 1))
        """
        from pkm_exact.geometry.joint_arrays import exact_joints

        joints = [
            exact_joints(rows, where, digits, doubles_are_exact=doubles_are_exact)
            for rows, where in ((base, "base"), (platform, "platform"))
        ]
        kind = "3-RPR" if len(joints[0]) == 3 else "6-UPS"
        return cls(name, kind, unit, source, joints[0], joints[1])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the robot as a model file, from which the same robot is read; the file appears whole or not at all.

        Raises
        ------
        InputError
            If it cannot be written.

        Examples
        --------
        >>> import tempfile, pathlib
        >>> robot = Robot.load("models/hexa.toml")
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "copy.toml"
        >>> robot.save(path)
        >>> Robot.load(path) == robot
        True
        """
        from pkm_exact.files import write_whole
        from pkm_exact.geometry.model_writer import robot_text

        try:
            write_whole(path, robot_text(self).encode("utf-8"))
        except OSError as error:
            raise InputError(f"{path}: cannot be written ({error.strerror}); give another path") from None

    def in_unit(self, unit: str) -> Robot:
        """The same robot with all lengths in another unit, exactly: mm, cm, m, in or ft.

        Raises
        ------
        InputError
            If this unit, or that of the robot, is not known.

        Examples
        --------
        >>> Robot.load("models/rolland-6-6.toml").in_unit("in").base_joints[0][0]
        Fraction(464141, 25400)
        """
        from pkm_exact.geometry.length_units import in_unit

        return in_unit(self, unit)

    def follow(
        self, values: Sequence[float] | Array, start: Followed | Pose | tuple[Sequence[float], Sequence[float]]
    ) -> Followed:
        """The pose to which the robot moves from a start when its actuators move evenly to the joint values given.

        For control loops, in doubles: Newton's iteration, and a proof afterwards, every rounding bounded, that the pose
        is the only one near and of the same assembly mode as the last (``following.follower``).

        Parameters
        ----------
        values : sequence of float
            One per leg, each exactly the double that it is: lengths, angles of cranks in radians, positions of slides.
        start : Followed, Pose, or position and quaternion
            What this method returned last; or where to begin: a pose of a solution, or a position (3 numbers, 2 in the
            plane) with a quaternion of any norm, scalar first, both in ordinary coordinates.

        Returns
        -------
        Followed
            With ``is_proved`` and ``same_mode``: what was proved. If ``is_proved`` is False, the numbers are a guess.

        Raises
        ------
        InputError
            If the values do not fit the robot, or the start is no pose.

        Examples
        --------
        >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
        >>> pose = robot.follow([7.08, 5.1, 5.0], robot.solve().poses[1])
        >>> pose = robot.follow([7.09, 5.11, 5.01], pose)
        >>> pose.same_mode, pose.position.round(3).tolist()[:2], pose.position_bound < 1e-9
        (True, [5.027, 5.0], True)
        """
        from pkm_exact.following.follower import Followed
        from pkm_exact.following.following_start import first_pose, follow_to, study_point

        given = _checked_values(self, values)
        if isinstance(start, Followed) and (start.tables.robot is self or start.tables.robot == self):
            return follow_to(start, given)
        tables = _tables(self)
        place, turn = start if isinstance(start, tuple) else (start.position, start.quaternion)
        point = study_point(tables, [float(x) for x in place], [float(x) for x in turn])
        return first_pose(tables, given, point)


@dataclass(frozen=True, repr=False)
class Mechanism(Asked, mechanisms.Mechanism):
    __doc__ = mechanisms.Mechanism.__doc__


def read_robot(path: str | os.PathLike[str]) -> Robot | Mechanism:
    """The robot that a model file describes.

    Raises
    ------
    InputError
        If the file cannot be read or does not describe a robot; the message is one sentence that starts with the path.

    Examples
    --------
    >>> read_robot("models/3-rrr.toml").kind
    '3-RRR'
    """
    found = reader.read_robot(path)
    data = {entry.name: getattr(found, entry.name) for entry in fields(found)}
    return Mechanism(**data) if isinstance(found, mechanisms.Mechanism) else Robot(**data)


def _checked_values(robot: Robot, values: Sequence[float] | Array) -> Array:
    import numpy as np

    found: Array = np.array(values, dtype=float)
    count = len(robot.actuated)
    if found.shape != (count,) or not np.all(np.isfinite(found)):
        raise InputError(
            f"values: {printable(str(values)[:80])} are no joint values; give {count} numbers, one per leg"
        )
    if not robot.chains and not np.all(found > 0):
        raise InputError(f"values: {printable(str(values)[:80])} are no leg lengths; give numbers greater than 0")
    return found


@lru_cache(maxsize=8)
def _tables(robot: Robot) -> LegTables:
    """The same for robots that are equal; so a pose of one of them goes on with another."""
    from pkm_exact.following.leg_tables import leg_tables

    return leg_tables(robot)


def _shown(progress: Callable[[str], None] | bool | None) -> Any:
    """A context with the callable for an engine."""
    if progress is True:
        from pkm_exact.interactive.progress import Progress

        return Progress(verbose=False, notebook=True)
    return nullcontext(progress or None)

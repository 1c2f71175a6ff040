"""What is proved at the values of the sliders: all poses, and which of them the robot is meant to be in.

At first that is the pose nearest to the nominal one, or the best conditioned. From values to values it is followed by a
certified branch of regular poses, straight in squared lengths; where that is not proved, the nearest pose is shown,
and said to be no more than that.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.given_joints import JointWord, joint_configuration
from pkm_exact.interactive.display import headline
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.nominal_pose import NominalPose
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.pictures.drawn_robot import Scene
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution

_JOINED: Final = "joined to the one before by regular poses, which is proved"
_NEAREST: Final = "nearest to the one before; it is not proved that regular poses join them"


@dataclass(frozen=True)
class LiveAnswer:
    """What is shown.

    Attributes
    ----------
    solution : Solution
    scene : Scene
    names : tuple of str
        Of the poses.
    place : int or None
        Of the pose that is solid, from 0; None if there is none.
    why : str
        Why it is that one.
    notes : tuple of str
    """

    solution: Solution
    scene: Scene
    names: tuple[str, ...]
    place: int | None
    why: str
    notes: tuple[str, ...] = ()

    @property
    def pose(self) -> Pose | None:
        """The pose that is solid."""
        return None if self.place is None else self.solution.poses[self.place]

    def lines(self) -> list[str]:
        """What is said of it, line by line."""
        found = [f"{headline(self.solution)}."]
        if self.place is not None:
            view, name = self.scene.poses[self.place], self.names[self.place]
            sign = {1: "positive", -1: "negative", 0: "0, singular", None: "not decided"}[view.det_sign]
            condition = "" if view.condition is None else f", condition number {view.condition:.4g}"
            found.append(f"Solid: pose {view.number}, {name}, {self.why}. det J is {sign}{condition}.")
            found += [] if view.limits is None else [f"Limits of the model kept: {view.limits}."]
        return [*found, *self.notes]


def first_answer(robot: Robot | Mechanism, configuration: str | None = None) -> LiveAnswer:
    """What is proved at a configuration of the model.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> answer = first_answer(read_robot("models/3-rpr-merlet-p.toml"))
    >>> answer.place, answer.why, len(answer.scene.poses)
    (0, 'the best conditioned', 2)
    """
    solution, scene = _solved(robot, robot.configuration(configuration).name)
    place, why = _first(solution.poses, robot.nominal)
    return _answer(solution, scene, place, why)


def next_answer(robot: Robot | Mechanism, words: Sequence[JointWord], before: LiveAnswer) -> LiveAnswer:
    """What is proved at values of the actuators, after another answer.

    Raises
    ------
    InputError
        If the robot cannot have these values.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> words = [(Fraction(x), False) for x in ("7.1", "5.1", "5")]
    >>> next_answer(robot, words, first_answer(robot)).why
    'joined to the one before by regular poses, which is proved'
    """
    moved, name = joint_configuration(robot, words, "sliders")
    solution, scene = _solved(moved, name)
    place, why = _followed(before, solution)
    stand_ins = tuple(
        str(note) for note in getattr(moved.configuration(name), "stand_ins", ()) if isinstance(note, str)
    )
    return _answer(solution, scene, place, why, stand_ins)


def _solved(robot: Robot | Mechanism, name: str) -> tuple[Solution, Scene]:
    from pkm_exact.certify.build import certificate
    from pkm_exact.numeric_engine import solve_krawczyk
    from pkm_exact.pictures.scene import scene_of

    solution = solve_krawczyk(robot.problem(robot.configuration(name)))
    return solution, scene_of(certificate(robot, name, solution), robot)


def _answer(solution: Solution, scene: Scene, place: int | None, why: str, notes: tuple[str, ...] = ()) -> LiveAnswer:
    from pkm_exact.poses.pose_names import pose_names

    names = pose_names(solution.poses, solution.problem.motion)
    return LiveAnswer(solution, scene, names, place, why, tuple(map(printable, (*solution.notes, *notes))))


def _first(poses: Sequence[Pose], nominal: NominalPose | None) -> tuple[int | None, str]:
    from pkm_exact.poses.nearest_pose import nearest_pose

    if not poses:
        return None, ""
    near = None if nominal is None else nearest_pose(poses, nominal)
    if near is not None:
        return near.numbers[0] - 1, "the nearest to the nominal pose"
    conditions = [inf if pose.condition is None else float(pose.condition) for pose in poses]
    return conditions.index(min(conditions)), "the best conditioned"


def _followed(before: LiveAnswer, solution: Solution) -> tuple[int | None, str]:
    """The place of the pose that the last one leads to, and what is proved of that."""
    from pkm_exact.geometry.nominal_pose import NominalPose
    from pkm_exact.numeric.carried_names import end_of_branch
    from pkm_exact.numeric.problem_path import ProblemPath
    from pkm_exact.poses.nearest_pose import nearest_pose

    start = before.pose
    if start is None or not solution.poses:
        return _first(solution.poses, None)
    if before.solution.is_complete and solution.is_complete:
        path = ProblemPath((before.solution.problem, solution.problem))
        try:
            path.require()
            place = end_of_branch(path, start, before.solution.poses, solution.poses)
        except InputError:
            place = ""  # more than values differs
        if isinstance(place, int):
            return place, _JOINED
    x, y, z = (bounds.midpoint for bounds in start.position)
    rows = tuple((a.midpoint, b.midpoint, c.midpoint) for a, b, c in start.rotation)
    near = nearest_pose(solution.poses, NominalPose((x, y, z), (rows[0], rows[1], rows[2])))
    return (None if near is None else near.numbers[0] - 1), _NEAREST

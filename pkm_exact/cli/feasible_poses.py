"""The poses that ``solve`` lists, with what is proved of the limits of the robot at each of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.wording import counted

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.nominal_pose import NominalPose
    from pkm_exact.numeric.carried_names import CarriedNames
    from pkm_exact.poses.limit_checks import LimitVerdict
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution


SORTS: Final = ("number", "x", "y", "z", "condition", "nearest")
"""What poses can be sorted by."""


@dataclass(frozen=True)
class ShownPoses:
    """All poses of a solution, or those that are proved feasible, with their numbers in the whole list.

    Attributes
    ----------
    poses : tuple of Pose
    numbers : tuple of int
        From 1, those of the whole list.
    verdicts : tuple of mappings
        For each pose the verdict on every limit of the robot; empty ones if it has none.
    names : tuple of str
        The limits of the robot.
    notes : tuple of str
        How many poses are not listed, and why.
    nearest : tuple of int
        Numbers of the poses nearest to the nominal one.
    pose_names : tuple of str
        The names of the poses (``poses.pose_names``), or those that were carried to them from a certificate.
    """

    poses: tuple[Pose, ...]
    numbers: tuple[int, ...]
    verdicts: tuple[Mapping[str, LimitVerdict], ...]
    names: tuple[str, ...]
    notes: tuple[str, ...] = ()
    nearest: tuple[int, ...] = ()
    pose_names: tuple[str, ...] = ()

    @staticmethod
    def of(robot: Machine, configuration: str | None, solution: Solution, *, feasible_only: bool = False) -> ShownPoses:
        """The poses to list."""
        from pkm_exact.poses.pose_names import pose_names

        shown = ShownPoses(
            solution.poses,
            tuple(range(1, len(solution.poses) + 1)),
            tuple({} for _ in solution.poses),
            (),
            nearest=_nearest(robot, solution),
            pose_names=pose_names(solution.poses, solution.problem.motion),
        )
        if robot.limits is None:
            return shown
        from pkm_exact.poses.limit_checks import LimitVerdict, limit_verdicts, together

        locked = None if configuration is None else robot.configuration(configuration)
        verdicts = limit_verdicts(robot, locked, solution.problem, solution.poses)
        shown = replace(shown, verdicts=tuple(verdicts), names=robot.limits.names)
        if not feasible_only:
            return shown
        found = [together(verdict.values()) for verdict in verdicts]
        kept = [place for place, verdict in enumerate(found) if verdict is LimitVerdict.YES]
        left_out = _left_out(found.count(LimitVerdict.NO), found.count(LimitVerdict.UNDECIDED))
        return replace(shown._at(kept), notes=(left_out,) if found else ())

    def named(self, found: CarriedNames) -> ShownPoses:
        """With names that were carried from a certificate."""
        names = tuple(found.names[number - 1] for number in self.numbers)
        return replace(self, pose_names=names, notes=(*self.notes, *found.notes))

    def only_nearest(self) -> ShownPoses:
        """Only the pose nearest to the nominal one, or those that may be."""
        kept = [place for place, number in enumerate(self.numbers) if number in self.nearest]
        return replace(
            self._at(kept), notes=(*self.notes, f"listed: the nearest of {counted(len(self.poses), 'pose')}")
        )

    def arranged(self, key: str, nominal: NominalPose | None) -> ShownPoses:
        """In increasing order of a key of ``SORTS``; each keeps its number."""
        return self._at(sorted(range(len(self.poses)), key=lambda place: _sort_value(self, key, place, nominal)))

    def _at(self, places: Sequence[int]) -> ShownPoses:
        return replace(
            self,
            poses=tuple(self.poses[place] for place in places),
            numbers=tuple(self.numbers[place] for place in places),
            verdicts=tuple(self.verdicts[place] for place in places),
            pose_names=tuple(self.pose_names[place] for place in places),
        )

    def label(self, place: int) -> str:
        """The number of a pose, marked if it is the nearest to the nominal one."""
        number = self.numbers[place]
        return f"{number}*" if (number,) == self.nearest else str(number)

    @property
    def headings(self) -> tuple[str, ...]:
        """Of the table's columns after those of the poses."""
        return ("name", "limits") if self.names else ("name",)

    def cells(self, place: int) -> tuple[str, ...]:
        """What stands in them."""
        name = self.pose_names[place]
        if not self.names:
            return (name,)
        from pkm_exact.poses.limit_checks import in_words

        return name, in_words(self.verdicts[place])

    @property
    def columns(self) -> tuple[str, ...]:
        """Of the CSV file after those of the poses."""
        return ("feasible", *(f"limit_{name}" for name in self.names)) if self.names else ()

    def fields(self, place: int) -> list[str]:
        """What stands in them."""
        if not self.names:
            return []
        from pkm_exact.poses.limit_checks import together

        verdicts = self.verdicts[place]
        return [str(together(verdicts.values())), *(str(verdicts[name]) for name in self.names)]

    def entry(self, place: int) -> dict[str, Any]:
        """What JSON has of them: the name, the number where it is not that of the row, and the limits if there are."""
        name = {"name": self.pose_names[place]}
        if not self.names:
            in_order = self.numbers == tuple(range(1, len(self.numbers) + 1))
            return name if in_order else name | {"number": self.numbers[place]}
        feasible, *others = self.fields(place)
        limits = dict(zip(self.names, others, strict=True))
        return name | {"number": self.numbers[place], "feasible": feasible, "limits": limits}


def _sort_value(shown: ShownPoses, key: str, place: int, nominal: NominalPose | None) -> tuple[float, int]:
    """What a pose is sorted by; only for show, so that its middle will do."""
    pose, number = shown.poses[place], shown.numbers[place]
    if key == "condition":
        found = None if pose.condition is None else float(pose.condition.hi)
    elif key == "nearest":
        from pkm_exact.poses.nearest_pose import nearest_pose

        near = None if nominal is None else nearest_pose([pose], nominal)
        found = None if near is None else near.distance
    else:
        found = float(number) if key == "number" else float(pose.position["xyz".index(key)].midpoint)
    return (inf if found is None else found), number


def _nearest(robot: Machine, solution: Solution) -> tuple[int, ...]:
    if robot.nominal is None:
        return ()
    from pkm_exact.poses.nearest_pose import nearest_pose

    found = nearest_pose(solution.poses, robot.nominal)
    return () if found is None else found.numbers


def _left_out(broken: int, undecided: int) -> str:
    """How many poses are not listed.

    >>> _left_out(3, 1), _left_out(0, 0)
    ('not listed: 3 poses that break a limit, and 1 on or too near a limit to be decided', 'all poses keep all limits')
    """
    if not broken and not undecided:
        return "all poses keep all limits"
    poses = "pose that breaks" if broken == 1 else "poses that break"
    rest = f", and {undecided} on or too near a limit to be decided" if undecided else ""
    return f"not listed: {broken} {poses} a limit{rest}"

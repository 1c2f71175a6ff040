"""Names of poses carried from one robot to another of the same make, along branches of regular poses.

The path between the two robots is straight in their data (``problem_path``): in squared lengths, and in the joints of
legs where they differ. Each pose of the first robot is followed along it, with a proof of every step. Branches do not
meet, so that no two names arrive at one pose. A branch that ends at a singularity, or too near one to be told from it,
carries its name nowhere.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import floor
from typing import TYPE_CHECKING, Final

from pkm_exact.errors import InputError
from pkm_exact.failures.contradiction import require
from pkm_exact.numeric.problem_path import ProblemPath
from pkm_exact.numeric.tracked_branch import TrackingStopped
from pkm_exact.numeric.trajectory import followed_pose
from pkm_exact.poses.pose_names import pose_signatures, told_apart
from pkm_exact.wording import counted

if TYPE_CHECKING:
    from fractions import Fraction

    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution

_BEYOND: Final = "where a branch is not proved farther, a singularity is neither found nor excluded"
NEW: Final = "new-"
"""What the names of poses begin with to which none was carried."""


@dataclass(frozen=True)
class NamedPoses:
    """All poses of a robot, which was solved before, with their names.

    Attributes
    ----------
    source : str
        Where they come from, for messages.
    problem : ForwardProblem
    poses : tuple of Pose
        Proved to be all.
    names : tuple of str
    """

    source: str
    problem: ForwardProblem
    poses: tuple[Pose, ...]
    names: tuple[str, ...]


@dataclass(frozen=True)
class CarriedNames:
    """The names of the poses of a list, and what became of those that were to be carried.

    Attributes
    ----------
    names : tuple of str
        A name for each pose; one that begins with ``NEW`` was not carried to it.
    lost : tuple of pairs
        Names that arrived at no pose, with the reason.
    source : str
    """

    names: tuple[str, ...]
    lost: tuple[tuple[str, str], ...]
    source: str

    @property
    def carried(self) -> int:
        """How many poses have the name of one that was followed."""
        return sum(not name.startswith(NEW) for name in self.names)

    @property
    def notes(self) -> tuple[str, ...]:
        """What is proved of the names, in sentences."""
        total = self.carried + len(self.lost)
        first = (
            f"names from {self.source}: {self.carried} of {counted(total, 'pose')} followed to here, each by a "
            "certified branch of regular poses; the path is straight in squared lengths and joints, along another "
            "one a name may arrive at another pose"
        )
        if not self.lost:
            return (first,)
        return first, f"carried to no pose: {'; '.join(f'{name}, {reason}' for name, reason in self.lost)}; {_BEYOND}"


def carried_names(
    reference: NamedPoses, solution: Solution, progress: Callable[[str], None] | None = None
) -> CarriedNames:
    """The names of the poses of a solution, carried from a reference.

    Raises
    ------
    InputError
        If the robots are not of one make, the solution is not proved to be complete, or its constraints cannot be
        followed.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact import read_robot, solve
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> first, second = (solve(robot.problem([Fraction(n)] * 3)) for n in (40, 45))
    >>> names = tuple(f"mode {k}" for k, _ in enumerate(first.poses))
    >>> found = carried_names(NamedPoses("before", first.problem, first.poses, names), second)
    >>> found.names, found.lost
    (('mode 0', 'mode 1'), ())
    """
    path = ProblemPath((reference.problem, solution.problem))
    path.require()
    if not solution.is_complete:
        raise InputError("the list of poses is not proved to be complete, so that a name may belong to a missing one")
    found: dict[int, str] = {}
    lost = []
    for name, start in zip(reference.names, reference.poses, strict=True):
        if progress is not None:
            progress(f"following {name}")
        place = end_of_branch(path, start, reference.poses, solution.poses)
        if isinstance(place, str):
            lost.append((name, place))
        else:
            require(place not in found, "two branches of regular poses arrive at one pose")
            found[place] = name
    signatures = pose_signatures(solution.poses, solution.problem.motion)
    others = [place for place, _ in enumerate(solution.poses) if place not in found]
    new = zip(others, told_apart([f"{NEW}{signatures[place]}" for place in others]), strict=True)
    named = found | dict(new)
    return CarriedNames(tuple(named[place] for place, _ in enumerate(solution.poses)), tuple(lost), reference.source)


def end_of_branch(path: ProblemPath, start: Pose, starts: Sequence[Pose], ends: Sequence[Pose]) -> int | str:
    """The place in a list of the pose that a branch arrives at, or why there is none; both lists are complete.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact import read_robot, solve
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> first, second = (solve(robot.problem([Fraction(n)] * 3)) for n in (40, 45))
    >>> end_of_branch(ProblemPath((first.problem, second.problem)), first.poses[1], first.poses, second.poses)
    1
    """
    try:
        sample = followed_pose(path, start, starts)
    except TrackingStopped as stop:
        return f"its branch proved for {_percent(stop.reached)} of the way"
    except InputError:
        return "singular, or too nearly for a branch to begin"
    places = [place for place, pose in enumerate(ends) if _meet(pose, sample.pose)]
    require(bool(places), "a branch of regular poses arrives at no pose of a complete list")
    return places[0] if len(places) == 1 else "its branch arrives where boxes of two poses meet"


def _meet(one: Pose, other: Pose) -> bool:
    """Whether the boxes have a position and a rotation in common."""
    first, second = ([*pose.position, *(entry for row in pose.rotation for entry in row)] for pose in (one, other))
    return all(a.overlaps(b) for a, b in zip(first, second, strict=True))


def _percent(share: Fraction) -> str:
    """Rounded down.

    >>> from fractions import Fraction
    >>> _percent(Fraction(2, 3)), _percent(Fraction(1, 2))
    ('66.6 %', '50 %')
    """
    return f"{float(floor(1000 * share)) / 10:g} %"

"""Assembly modes: poses grouped by the sign of the determinant of the leg Jacobian.

Between poses of different sign the platform cannot pass, with moving actuators, without meeting a singularity.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution

_GROUPS: Final = {1: "positive", -1: "negative", 0: "singular", None: "undecided"}
_WORDS: Final = {
    "positive": "with det J > 0",
    "negative": "with det J < 0",
    "singular": "with det J = 0",
    "undecided": "with det J not decided",
}


def assembly_modes(poses: Sequence[Pose]) -> dict[str, list[int]]:
    """Places of the poses in the list, from 0, under the keys positive, negative, singular and undecided.

    Examples
    --------
    >>> assembly_modes([])
    {'positive': [], 'negative': [], 'singular': [], 'undecided': []}
    """
    found: dict[str, list[int]] = {group: [] for group in _GROUPS.values()}
    for place, pose in enumerate(poses):
        found[_GROUPS[None if pose.jacobian is None else pose.jacobian.det_sign]].append(place)
    return found


def require_joinable(robot: Machine, method: str) -> None:
    """Refuse --joined before anything is solved, for a robot or a method that it is not for."""
    from pkm_exact.errors import InputError
    from pkm_exact.regions.joined_modes import joinable_machine

    if method == "newton":
        raise InputError("--joined: is for certified poses; leave it out or choose another method")
    joinable_machine(robot)


@dataclass(frozen=True)
class JoinedPoses:
    """Which poses are proved to be joined by motions without a singular pose.

    Attributes
    ----------
    groups : tuple of tuples of int
        By the numbers of the poses, from 1, whether they are listed or not.
    are_all : bool
        Whether no two groups, and no pose in none, can be joined, by the signs of det J.
    """

    groups: tuple[tuple[int, ...], ...]
    are_all: bool

    def in_words(self, listed: Collection[int]) -> str:
        """A sentence; poses that are not among those listed are named."""
        return joined_in_words(self.groups, are_all=self.are_all, listed=listed)


def joined_modes(robot: Machine, solution: Solution, *, verbose: bool) -> JoinedPoses:
    """The groups of a solution."""
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.regions.joined_modes import joined_poses

    with Progress(verbose=verbose) as progress:
        groups = joined_poses(robot, solution, progress)
    signs = [solution.poses[group[0] - 1].det_sign for group in groups]
    grouped = {number for group in groups for number in group}
    alone = [pose for number, pose in enumerate(solution.poses, 1) if number not in grouped and pose.det_sign != 0]
    return JoinedPoses(groups, len(set(signs)) == len(signs) and not alone)


def joined_in_words(groups: Sequence[Sequence[int]], *, are_all: bool, listed: Collection[int]) -> str:
    """Groups of poses that are joined, by their numbers.

    Examples
    --------
    >>> joined_in_words([(1, 4), (2,), (3,)], are_all=False, listed=(1, 2, 3))
    'joined by motions without a singular pose: {1, 4}; of other pairs with the same sign of det J it is not known; \
limits and collisions are not looked at; not listed: 4'
    """
    known = ["{" + ", ".join(map(str, group)) + "}" for group in groups if len(group) > 1]
    rest = "" if are_all else "; of other pairs with the same sign of det J it is not known"
    missing = sorted({number for group in groups if len(group) > 1 for number in group} - set(listed))
    rest += "; limits and collisions are not looked at"
    rest += f"; not listed: {', '.join(map(str, missing))}" if missing else ""
    return f"joined by motions without a singular pose: {', '.join(known) or 'none found'}{rest}"


def summary(modes: dict[str, list[int]], numbers: Sequence[int]) -> str:
    """How many poses each group has and which, by their numbers; groups without poses are left out.

    Examples
    --------
    >>> summary({"positive": [0, 2], "negative": [], "singular": [1], "undecided": []}, (1, 2, 3))
    '2 poses with det J > 0 (1, 3), 1 with det J = 0 (2)'
    """
    parts: list[str] = []
    for group, places in modes.items():
        if places:
            noun = "" if parts else " pose" if len(places) == 1 else " poses"
            parts.append(f"{len(places)}{noun} {_WORDS[group]} ({', '.join(str(numbers[place]) for place in places)})")
    return ", ".join(parts)

"""Assembly modes: poses grouped by the sign of the determinant of the leg Jacobian.

Between poses of different sign the platform cannot pass, with moving actuators, without meeting a singularity.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pkm_exact.poses.pose import Pose

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

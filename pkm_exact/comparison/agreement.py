"""Whether two lists of certified poses are the same, decided by their boxes and not by a tolerance."""

from __future__ import annotations

from collections.abc import Sequence

from pkm_exact.poses.pose import Interval, Pose


def same_poses(left: Sequence[Pose], right: Sequence[Pose]) -> bool | None:
    """Whether each box of one list overlaps exactly one box of the other.

    Every box holds exactly one pose of its list. A box that is disjoint from all of the other list holds a pose that
    the other list has not: then the answer is "no", and it is certain. If the boxes overlap in pairs and are otherwise
    disjoint the answer is "yes"; where both lists are complete that is certain too, since a pose in a box of one list
    lies in some box of the other, and only one overlaps. None if a box overlaps two, which narrower boxes would decide.

    Examples
    --------
    >>> same_poses((), ())
    True
    """
    overlaps = [[_overlap(a, b) for b in right] for a in left]
    counts = [sum(row) for row in overlaps] + [sum(row[j] for row in overlaps) for j in range(len(right))]
    if 0 in counts:
        return False
    return True if set(counts) <= {1} else None


def _overlap(left: Pose, right: Pose) -> bool:
    return all(a.overlaps(b) for a, b in zip(_coordinates(left), _coordinates(right), strict=True))


def _coordinates(pose: Pose) -> list[Interval]:
    return [*pose.position, *(entry for row in pose.rotation for entry in row)]

"""Names of poses that do not depend on how many others there are, nor on their order.

A name such as P-U-EU has three parts, each proved of the pose's box:

    P    the sign of det J: P, N, or 0 where the pose is singular
    U    the axis of the base frame that the position is nearest to in direction, seen from the origin of that frame
    EU   those that the platform's first and third axis are nearest to; of a planar robot the first alone

Axes are E, W (x and -x), N, S (y and -y), U, D (z and -z). X stands where the box does not decide a part: there is no
sign, or two axes are equally near, or too nearly to be told. A part changes only where det J is 0 or two axes are
equally near. Poses of one list that have all parts in common are told apart by .1, .2, .., in the order of the list,
which is not stable.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from pkm_exact.motions.motion import Motion
    from pkm_exact.poses.pose import Pose
    from pkm_exact.roots.interval import Interval

_SIGNS: Final = {1: "P", -1: "N", 0: "0", None: "X"}
_AXES: Final = ("EW", "NS", "UD")
_UNDECIDED: Final = "X"


def pose_names(poses: Sequence[Pose], motion: Motion) -> tuple[str, ...]:
    """The names of all poses of a list, no two alike.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> pose_names(robot.solve().poses, robot.motion)
    ('N-N-S', 'P-X-E')
    """
    return told_apart(pose_signatures(poses, motion))


def pose_signatures(poses: Sequence[Pose], motion: Motion) -> list[str]:
    """The parts of the names of poses, which may be those of several."""
    return [pose_signature(pose.position, pose.rotation, pose.det_sign, motion) for pose in poses]


def told_apart(signatures: Sequence[str]) -> tuple[str, ...]:
    """Each with a number behind it if it is there more than once.

    Examples
    --------
    >>> told_apart(["P-U-EU", "N-D-EU", "P-U-EU"])
    ('P-U-EU.1', 'N-D-EU', 'P-U-EU.2')
    """
    total, sofar, names = Counter(signatures), Counter[str](), []
    for signature in signatures:
        sofar[signature] += 1
        names.append(signature if total[signature] == 1 else f"{signature}.{sofar[signature]}")
    return tuple(names)


def pose_signature(
    position: Sequence[Interval], rotation: Sequence[Sequence[Interval]], det_sign: int | None, motion: Motion
) -> str:
    """The parts of a name, from the box of a pose and the sign of det J."""
    axes = 2 if motion.is_planar else 3
    parts = [_SIGNS[det_sign], _direction(position[:axes])]
    if motion.rotation_support != (0,):
        columns = (0,) if motion.is_planar else (0, 2)
        parts.append("".join(_direction([row[k] for row in rotation[:axes]]) for k in columns))
    return "-".join(parts)


def _direction(vector: Sequence[Interval]) -> str:
    """The axis that all vectors of a box are nearest to."""
    cells = [interval.cell for interval in vector]
    grids = {None if cell is None else cell[2] for cell in cells}
    # Mostly all are on one grid, whose units do not matter.
    ends: Sequence[tuple[Any, Any]] = [cell[:2] for cell in cells if cell is not None]
    if len(grids) > 1 or None in grids:
        ends = [(interval.lo, interval.hi) for interval in vector]
    sizes = [_size(low, high) for low, high in ends]
    # An axis that is nearer than all others has the greatest of the least values.
    least, axis = max((size[0], axis) for axis, size in enumerate(sizes))
    others = [most for other, (_, most) in enumerate(sizes) if other != axis]
    if others and least <= max(others):
        return _UNDECIDED
    return _AXES[axis][0 if ends[axis][0] > 0 else 1]


def _size(low: Any, high: Any) -> tuple[Any, Any]:
    """Bounds of the absolute value."""
    if low > 0:
        return low, high
    return (-high, -low) if high < 0 else (0, max(-low, high))

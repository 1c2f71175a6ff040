"""Whether boxes of poses have room for poses of the robot: of all at once, in doubles.

What ``poses.pose_consistency`` asks in ball arithmetic; where rounding could matter, it is left to that.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import chain, islice
from operator import attrgetter
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.form import SIZE
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.double_rounding import gamma, rounded
from pkm_exact.numeric.study_system import Real
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.pose_consistency import require_on_robot

Asked: TypeAlias = tuple[Sequence[Pose], ForwardProblem, Sequence[int]]
"""Poses, whose they are, and their chart."""
_FEW: Final = 16
"""Roundings in a row, at most."""


def require_poses_on_robot(
    poses: Sequence[Pose],
    problem: ForwardProblem,
    exponent: int,
    chart: Sequence[int],
    decided: Sequence[bool] | None = None,
) -> None:
    """Every box has room for a pose of the robot: legs, rotation, quaternion and chart.

    Parameters
    ----------
    poses : sequence of Pose
    problem : ForwardProblem
    exponent : int
        Of the grid of the boxes.
    chart : sequence of 4 int
        w: the quaternion has the sign for which w.e > 0.
    decided : sequence of bool, optional
        What ``poses_have_room`` says of the poses, if it is known already.

    Raises
    ------
    InternalContradictionError
    """
    if decided is None:
        (decided,) = poses_have_room([(poses, problem, chart)])
    left = [pose for pose, has_room in zip(poses, decided, strict=True) if not has_room]
    require_on_robot(left, problem, exponent, chart)


def poses_have_room(several: Sequence[Asked]) -> list[list[bool]]:
    """For which boxes of poses doubles tell that there is room: of one robot at several lengths at once.

    Parameters
    ----------
    several : sequence of (sequence of Pose, ForwardProblem, sequence of 4 int)
        Poses, problem and chart.
    """
    if not all(problem.has_only_distances for _, problem, _ in several):
        return [[False] * len(poses) for poses, _, _ in several]
    joints = [_joints(problem) for _, problem, _ in several]
    if any(of_row != joints[0] for of_row in joints):
        return [found for asked in several for found in poses_have_room([asked])]
    found = iter(_have_room(several).tolist() if any(poses for poses, _, _ in several) else [])
    return [list(islice(found, len(poses))) for poses, _, _ in several]


def _joints(problem: ForwardProblem) -> tuple[object, ...]:
    """In what robots at several lengths agree."""
    return problem.metric, problem.motion, [(leg.base, leg.platform) for leg in problem.distances]


def _have_room(several: Sequence[Asked]) -> NDArray[np.bool_]:
    """Where there is room, and rounding is far smaller than the boxes: of all poses, one problem after another."""
    poses, problem = [pose for listed, _, _ in several for pose in listed], several[0][1]
    each = np.arange(len(several)).repeat([len(listed) for listed, _, _ in several])
    try:
        ends = _ends(poses)
        base, platform = (
            np.array([rounded(getattr(leg, side)) for leg in problem.distances]) for side in ("base", "platform")
        )
        squares = np.array([rounded(leg.length_squared for leg in asked.distances) for _, asked, _ in several])[each]
    except OverflowError:
        return np.zeros(len(poses), dtype=bool)
    axes, charts = np.sqrt(np.array(problem.metric, dtype=float)), np.array([chart for _, _, chart in several])[each]
    with np.errstate(all="ignore"):
        middle, radius = (ends[..., 1] + ends[..., 0]) / 2, (ends[..., 1] - ends[..., 0]) / 2
        parts = [
            _reach(middle, radius, base * axes, platform * axes, squares),
            _moves(middle, radius, problem.motion, axes),
            _are_turns(middle, radius),
            _have_sign(middle, radius, charts, axes),
        ]
    found: NDArray[np.bool_] = np.logical_and.reduce(parts)
    return found


def _ends(poses: Sequence[Pose]) -> Real:
    """(p, 16, 2): those of position, rotation and quaternion, rounded."""
    parts = (part for pose in poses for part in (pose.position, *pose.rotation, pose.quaternion))
    intervals = [*chain.from_iterable(parts)]
    cells = [*map(attrgetter("cell"), intervals)]
    if None in cells:
        ends = np.array([(float(interval.lo), float(interval.hi)) for interval in intervals])
    else:
        *numbers, exponents = zip(*cells, strict=True)
        ends = np.ldexp(np.array(numbers, dtype=np.float64), -np.array(exponents, dtype=np.intp)).T
    return ends.reshape(len(poses), -1, 2)


def _fits(value: Real, radius: Real, size: Real) -> NDArray[np.bool_]:
    """For each pose whether all values, off by roundings of sums of this size, are within the radius of 0."""
    lost = gamma(_FEW) * size
    are_small = (np.abs(value) + lost <= radius) & (lost < radius / 16)
    return np.asarray(are_small.all(axis=1), dtype=np.bool_)


def _reach(middle: Real, radius: Real, base: Real, platform: Real, squares: Real) -> NDArray[np.bool_]:
    """Whether |C + R B - A|^2 = l^2 is possible for every leg."""
    turn, wide = (part[:, 3:12].reshape(-1, 3, 3) for part in (middle, radius))
    place, around = middle[:, None, :3], np.abs(platform) @ wide.transpose(0, 2, 1) + radius[:, None, :3]
    leg = place + platform @ turn.transpose(0, 2, 1) - base
    sizes = np.abs(place) + np.abs(platform) @ np.abs(turn).transpose(0, 2, 1) + np.abs(base)
    reach = (around * (2 * np.abs(leg) + around)).sum(axis=2)
    size = (sizes * (2 * np.abs(leg) + gamma(_FEW) * sizes)).sum(axis=2) + squares
    return _fits((leg * leg).sum(axis=2) - squares, reach, size)


def _moves(middle: Real, radius: Real, motion: Motion, axes: Real) -> NDArray[np.bool_]:
    """Whether the forms that vanish on all motions can be 0; where |C|^2 is in them, it is not said."""
    if not motion.forms:
        return np.ones(len(middle), dtype=np.bool_)
    forms = np.array(motion.forms, dtype=float).reshape(-1, SIZE)
    if forms[:, 0].any():
        return np.zeros(len(middle), dtype=np.bool_)
    rotation = forms[:, 7:16] * (axes[None, :] / axes[:, None]).ravel()
    rows = np.concatenate([forms[:, 1:4] / axes, forms[:, 4:7] / axes, rotation], axis=1)
    turned, sizes, around = (_turned_back(part) for part in (middle, np.abs(middle), np.abs(middle) + radius))
    values = np.concatenate([turned, middle[:, :12]], axis=1) @ rows.T + forms[:, 16]
    reach = np.concatenate([around - sizes, radius[:, :12]], axis=1) @ np.abs(rows).T
    size = np.concatenate([sizes, np.abs(middle[:, :12])], axis=1) @ np.abs(rows).T + np.abs(forms[:, 16])
    return _fits(values, reach, size)


def _turned_back(pose: Real) -> Real:
    """u = R^T C."""
    turned: Real = (pose[:, :3, None] * pose[:, 3:12].reshape(-1, 3, 3)).sum(axis=1)
    return turned


def _are_turns(middle: Real, radius: Real) -> NDArray[np.bool_]:
    """Whether the matrix can be that of the unit quaternion."""
    q, around = middle[:, 12:], radius[:, 12:]
    products = (q[:, :, None] * q[:, None, :]).reshape(-1, 16)
    sizes = np.abs(q)
    wide = (sizes + around)[:, :, None] * (sizes + around)[:, None, :] - sizes[:, :, None] * sizes[:, None, :]
    table = _turn_forms()
    values = products @ table.T
    values[:, :9] -= middle[:, 3:12]
    values[:, 9] -= 1
    reach = wide.reshape(-1, 16) @ np.abs(table).T
    reach[:, :9] += radius[:, 3:12]
    return _fits(values, reach, np.full(values.shape, 8.0))


@cache
def _turn_forms() -> Real:
    """(10, 16): matrix of a unit quaternion, by rows, and square of its norm, in products of its entries."""
    table = np.zeros((10, 4, 4))
    for i, j, k in CYCLIC:
        table[4 * i, range(4), range(4)] = [1 if axis in (0, 1 + i) else -1 for axis in range(4)]
        for row, sign in ((3 * k + j, 1), (3 * j + k, -1)):
            table[row, 1 + j, 1 + k], table[row, 0, 1 + i] = 2, 2 * sign
    table[9, range(4), range(4)] = 1
    return table.reshape(10, 16)


def _have_sign(middle: Real, radius: Real, charts: NDArray[np.int_], axes: Real) -> NDArray[np.bool_]:
    """Whether w.e > 0 is possible, by more than roundings."""
    weights = charts / np.concatenate([[np.prod(axes)], axes])
    values, reach = (
        (numbers[:, 12:] * of).sum(axis=1) for numbers, of in ((middle, weights), (radius, np.abs(weights)))
    )
    found: NDArray[np.bool_] = np.greater(values, -reach / 2)
    return found

"""Which poses of a locked robot can be joined by a motion of the platform without a singular pose on the way.

Two poses whose det J have different signs cannot. Of two with one sign it may be so or not: a straight way between
them, or one by a pose that is drawn at random, is proved to be free of singular poses (``pose_path``), or the answer is
"not known". Which ways are worth a proof is seen in floating point. A way runs from the middle of one box to the middle
of the other, and det J is shown not to be 0 in both boxes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations, pairwise
from random import Random
from typing import TYPE_CHECKING, Final, cast

import numpy as np
from flint import arb, arb_mat

from pkm_exact.balls import ball, hull
from pkm_exact.digests import digest
from pkm_exact.errors import InputError
from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.pose_path_reader import PLANAR, QUATERNIONS
from pkm_exact.poses.jacobian import characteristic_length
from pkm_exact.poses.planar_coordinates import angle_in_degrees
from pkm_exact.precision import working_precision
from pkm_exact.regions.pose_path import PRECISION, PathRefusedError, PosePathProof, Row
from pkm_exact.regions.region_legs import OwnLength, RegionMachine, region_machine

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pkm_exact.geometry.machine import Machine
    from pkm_exact.poses.pose import Pose
    from pkm_exact.roots.interval import Interval
    from pkm_exact.solution import Solution

TRIES: Final = 60
"""Ways by a pose between, after the straight one."""
SAMPLES: Final = 33
"""Places between two rows of a way at which det J is looked at before a proof is tried."""
LEAST_SHARE: Final = 1e-3
"""Of det J at the ends: below that no proof is tried."""
_GRID: Final = 10**6


def joinable_machine(robot: Machine) -> RegionMachine:
    """The legs of a robot whose poses can be joined.

    Raises
    ------
    InputError
        If they are not all of variable length, or not as many as the freedoms of the platform.
    """
    try:
        machine = region_machine(robot)
    except InputError:
        machine = None
    own = machine is not None and all(isinstance(leg.actuator, OwnLength) for leg in machine.legs)
    if machine is None or machine.forms or len(machine.legs) != len(machine.twist) or not own:
        raise InputError(
            "--joined: is for robots whose legs are of variable length, one for each freedom; leave it out"
        )
    return machine


def joined_poses(
    robot: Machine, solution: Solution, progress: Callable[[str], None] | None = None
) -> tuple[tuple[int, ...], ...]:
    """Groups of numbers of poses, from 1: those of a group are proved to be joined. Of other pairs nothing is known.

    Singular poses, and those whose sign is not decided, are in no group. Limits of the robot are not looked at.

    Raises
    ------
    InputError
        If the legs of the robot are not all of variable length, or not as many as the freedoms of the platform.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> joined_poses(robot, robot.solve())
    ((1,), (2,))
    """
    machine = joinable_machine(robot)
    length, random = (
        characteristic_length(solution.problem),
        Random(digest(*(leg.length_squared for leg in solution.problem.distances))),
    )
    planar = solution.problem.motion.is_planar
    groups = [
        {number}
        for number, pose in enumerate(solution.poses, 1)
        if _sign(pose) and _is_regular_box(machine, pose, planar=planar)
    ]
    for one, other in combinations([min(group) for group in groups], 2):
        first, second = (next(group for group in groups if number in group) for number in (one, other))
        a, b = solution.poses[one - 1], solution.poses[other - 1]
        if first is second or _sign(a) != _sign(b):
            continue
        if progress is not None:
            progress(f"from pose {one} to pose {other}")
        if any(_is_free(machine, way, length) for way in _ways(a, b, random, planar=planar)):
            groups.remove(second)
            first |= second
    return tuple(tuple(sorted(group)) for group in groups)


def _sign(pose: Pose) -> int:
    return 0 if pose.jacobian is None else pose.jacobian.det_sign or 0


def _is_free(machine: RegionMachine, way: tuple[tuple[str, ...], Sequence[Row]], length: Fraction) -> bool:
    if not _seems_free(machine, way[1]):
        return False
    proof = PosePathProof(machine, None, way[0], way[1], (1,) * len(machine.legs), length)
    try:
        for _ in proof.samples():
            pass
    except PathRefusedError:
        return False
    return True


def _seems_free(machine: RegionMachine, rows: Sequence[Row]) -> bool:
    """Whether det J, with |det J| not much less than at the ends, keeps its sign at many places of a way."""
    scale = np.sqrt([float(g) for g in machine.metric])
    a, b = (
        np.array([[float(x) for x in joint] for joint in joints]) * scale
        for joints in zip(*((leg.base, leg.platform) for leg in machine.legs), strict=True)
    )
    shares = np.linspace(0, 1, SAMPLES)[:, None]
    values = []
    for one, other in pairwise(rows):
        first, last = (np.array([float(x) for x in row]) for row in (one, other))
        points = first + shares * (last - first)
        if len(first) == 3:
            half = np.radians(points[:, 2]) / 2
            c, q = (
                np.pad(points[:, :2], ((0, 0), (0, 1))),
                np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], 1),
            )
        else:
            c, q = points[:, :3], points[:, 3:]
        arms = np.einsum("kij,nj->kni", _float_rotations(q), b)
        lines = c[:, None, :] + arms - a
        wrenches = np.concatenate([lines, np.cross(arms, lines)], axis=2)[..., list(machine.twist)]
        values.append(np.linalg.det(wrenches / np.linalg.norm(lines, axis=2, keepdims=True)))
    found = np.concatenate(values) * np.sign(values[0][0])
    return bool(found.min() > LEAST_SHARE * min(found[0], found[-1]))


def _float_rotations(q: NDArray[np.float64]) -> NDArray[np.float64]:
    w, x, y, z = (q / np.maximum(np.linalg.norm(q, axis=1, keepdims=True), 1e-9)).T
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _ways(a: Pose, b: Pose, random: Random, *, planar: bool) -> Iterator[tuple[tuple[str, ...], list[Row]]]:
    """Straight ones, both ways round, and ways by a pose that is somewhere between, or off to a side."""
    start, ends = _row(a, planar=planar), _ends(b, planar=planar)
    columns = PLANAR if planar else QUATERNIONS
    for end in ends:
        yield columns, [start, end]
    for _ in range(TRIES):
        end = random.choice(ends)
        share = Fraction(random.randint(0, _GRID), _GRID)
        size = [max(abs(x - y), Fraction(1, 4)) for x, y in zip(start, end, strict=True)]
        by = tuple(
            x + share * (y - x) + s * Fraction(random.randint(-_GRID, _GRID), _GRID)
            for x, y, s in zip(start, end, size, strict=True)
        )
        yield columns, [start, by, end]


def _row(pose: Pose, *, planar: bool) -> Row:
    position = [bounds.midpoint for bounds in pose.position]
    if planar:
        return (*position[:2], _angle(pose).midpoint)
    return (*position, *(bounds.midpoint for bounds in pose.quaternion))


def _ends(pose: Pose, *, planar: bool) -> list[Row]:
    row = _row(pose, planar=planar)
    if planar:
        return [(*row[:2], row[2] + turn) for turn in (0, 360, -360)]
    return [row, (*row[:3], *(-x for x in row[3:]))]


def _angle(pose: Pose) -> Interval:
    angle = angle_in_degrees(pose.rotation[0][0], pose.rotation[1][0])
    require(angle is not None, "a rotation whose cosine and sine may both be 0")
    return cast("Interval", angle)


def _is_regular_box(machine: RegionMachine, pose: Pose, *, planar: bool) -> bool:
    """Whether det J is not 0 for all positions, and quaternions or angles, in the bounds of a pose."""
    with working_precision(PRECISION):
        scales = [arb(g).sqrt() for g in machine.metric]
        c = [hull(x.lo, x.hi) for x in pose.position]
        r = (
            _turn(hull(_angle(pose).lo, _angle(pose).hi))
            if planar
            else _rotation([hull(x.lo, x.hi) for x in pose.quaternion])
        )
        rows = []
        for leg in machine.legs:
            a, b = ([s * ball(x) for s, x in zip(scales, joint, strict=True)] for joint in (leg.base, leg.platform))
            arm = [sum((r[i][k] * b[k] for k in range(3)), arb(0)) for i in range(3)]
            line = [c[i] + arm[i] - a[i] for i in range(3)]
            moment = [arm[i] * line[j] - arm[j] * line[i] for i, j in ((1, 2), (2, 0), (0, 1))]
            wrench = [*line, *moment]
            rows.append([wrench[axis] for axis in machine.twist])
        return not arb_mat(rows).det().contains(0)


def _turn(degrees: arb) -> list[list[arb]]:
    cos, sin = (degrees / 180).cos_pi(), (degrees / 180).sin_pi()
    return [[cos, -sin, arb(0)], [sin, cos, arb(0)], [arb(0), arb(0), arb(1)]]


def _rotation(q: Sequence[arb]) -> list[list[arb]]:
    w, x, y, z = q
    n = w * w + x * x + y * y + z * z
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return [[entry / n for entry in row] for row in rows]

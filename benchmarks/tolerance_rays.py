"""How far random and chosen robots show a pose to be regular, in floating point: nothing is proved here.

Along rays of errors of the data the pose is followed by Newton's method until the sign of det J changes or the method
fails: such a robot, or one just before it, has lost the pose. The rays go to random corners of the data, to the two
where |det J| falls and grows fastest at first, and then, from the nearest robots that were lost, to the corner that is
nearest to their fold: if u is in the kernel of J^T there, the data at which the pose is lost have to first order the
normal u^T dF/dp, and the corner with the signs of this normal meets them first. The last step is repeated. Still more
rays may come nearer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.pose import Pose

STEPS = 400
NEAREST = 24
"""Rays from whose ends others are made."""
ROUNDS = 6
WIDER = 2.0
"""How far these others go, in times the least error at which a pose was lost."""
NEWTON = 6
RESIDUAL = 1e-9
"""Of the longest number among the data: a greater one is no pose."""
Real = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FirstLost:
    """Least tolerances at which a robot lost the pose: among random corners, and among all that were tried."""

    random: float
    directed: float
    corner: Real
    """Of the data, from which the latter comes: -1, 0 or 1 for base joint, platform joint and length of each leg."""


@dataclass(frozen=True, eq=False)
class Robots:
    """Robots with their poses: data (m, 7 legs), positions (m, 3), rotations (m, 3, 3)."""

    data: Real
    c: Real
    rotation: Real


def first_lost(problem: ForwardProblem, pose: Pose, greatest: float, rays: int, seed: int = 1) -> FirstLost:
    """The least tolerances up to ``greatest`` at which a robot was seen to have lost the pose."""
    nominal = _data(problem)
    moving = np.ones((len(problem.distances), 7), dtype=bool)
    if problem.motion.is_planar:
        moving[:, [2, 5]] = False
    corners = np.sign(np.random.default_rng(seed).uniform(-1, 1, (rays, len(nominal)))) * moving.ravel()
    ends, folds = _ends(problem, pose, nominal, corners, greatest)
    random = float(ends.min())
    steepest = _steepest(problem, pose, nominal, moving.ravel())
    corners, least = np.concatenate([corners, steepest]), random
    more, more_folds = _ends(problem, pose, nominal, steepest, greatest)
    ends, folds = np.concatenate([ends, more]), np.concatenate([folds, more_folds])
    corner = corners[ends.argmin()]
    for _ in range(ROUNDS):
        least = min(least, float(ends.min()))
        nearest = np.argsort(ends, kind="stable")[:NEAREST]
        corners = np.unique(folds[nearest][ends[nearest] < greatest], axis=0)
        if not len(corners):
            break
        greatest = min(greatest, WIDER * least)
        ends, folds = _ends(problem, pose, nominal, corners, greatest)
        if ends.min() < least:
            corner = corners[ends.argmin()]
    return FirstLost(random, min(least, float(ends.min())), corner)


def _data(problem: ForwardProblem) -> Real:
    """Base joint, platform joint and length of each leg, one after another, in ordinary coordinates."""
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    lengths = [float(leg.length_squared) ** 0.5 for leg in problem.distances]
    rows: list[list[float]] = [
        [float(x) * scale for x, scale in zip((*leg.base, *leg.platform, 1), (*scales, *scales, length), strict=True)]
        for leg, length in zip(problem.distances, lengths, strict=True)
    ]
    return np.array(rows).ravel()


def _ends(problem: ForwardProblem, pose: Pose, nominal: Real, corners: Real, greatest: float) -> tuple[Real, Real]:
    """For each ray the error at which the pose is lost, or ``greatest``, and the corner nearest to its fold."""
    robots = _starts(pose, np.tile(nominal, (len(corners), 1)))
    robots, _, dets = _newton(problem, robots)
    sign, ends, folds = np.sign(dets), np.full(len(corners), float(greatest)), np.zeros_like(corners)
    alive = np.arange(len(corners))
    for step in range(1, STEPS + 1):
        errors = greatest * (step / STEPS) ** 2
        moved = Robots(nominal + errors * corners[alive], robots.c, robots.rotation)
        there, off, dets = _newton(problem, moved)
        lost = (np.sign(dets) != sign[alive]) | ~(off < RESIDUAL * np.abs(nominal).max())
        ends[alive[lost]] = errors
        folds[alive[lost]] = _folds(problem, Robots(moved.data[lost], robots.c[lost], robots.rotation[lost]), nominal)
        alive = alive[~lost]
        robots = Robots(moved.data[~lost], there.c[~lost], there.rotation[~lost])
        if not len(alive):
            break
    return ends, folds


def _folds(problem: ForwardProblem, robots: Robots, nominal: Real) -> Real:
    """Corners of the data that are nearest to where the poses are lost, from robots just before."""
    jacobian, _, _, units = _jacobian(problem, robots)
    kernel = np.linalg.svd(jacobian)[0][..., -1]
    back = np.einsum("mji,mnj->mni", robots.rotation, units)
    normal = np.concatenate([-units, back, -np.ones((*units.shape[:2], 1))], axis=2) * kernel[..., None]
    normal = np.where(np.abs(normal) < 1e-12, 0, normal).reshape(robots.data.shape)
    side = np.sign(((robots.data - nominal) * normal).sum(axis=1))
    return np.asarray(np.sign(normal) * side[:, None])


def _steepest(problem: ForwardProblem, pose: Pose, nominal: Real, moving: NDArray[np.bool_]) -> Real:
    """To first order the corner of the data towards which |det J| falls fastest, and the opposite one."""
    step = 1e-6 * np.abs(nominal).max()
    moved = nominal + step * np.concatenate([np.diag(moving), np.zeros((1, len(nominal)))])
    dets = _newton(problem, _starts(pose, moved))[2]
    falls = -np.sign((dets[:-1] - dets[-1]) * dets[-1]) * moving
    return np.array([falls, -falls])


def _starts(pose: Pose, data: Real) -> Robots:
    c = np.array([float(x.midpoint) for x in pose.position])
    rotation = np.array([[float(x.midpoint) for x in row] for row in pose.rotation])
    return Robots(data, np.tile(c, (len(data), 1)), np.tile(rotation, (len(data), 1, 1)))


def _newton(problem: ForwardProblem, robots: Robots) -> tuple[Robots, Real, Real]:
    """The robots at their poses, residuals and determinants, after some steps."""
    columns = _columns(problem)
    for _ in range(NEWTON):
        jacobian, now, lengths, _ = _jacobian(problem, robots)
        move = np.zeros((len(lengths), 6))
        move[:, columns] = (np.linalg.pinv(jacobian) @ (lengths - now)[..., None])[..., 0]
        robots = Robots(robots.data, robots.c + move[:, :3], _turned(robots.rotation, move[:, 3:]))
    jacobian, now, lengths, _ = _jacobian(problem, robots)
    return robots, np.abs(lengths - now).max(axis=1), np.linalg.det(jacobian)


def _columns(problem: ForwardProblem) -> list[int]:
    return [0, 1, 5] if problem.motion.is_planar else list(range(6))


def _jacobian(problem: ForwardProblem, robots: Robots) -> tuple[Real, Real, Real, Real]:
    """Of the legs' lengths; the lengths as they are and as they should be; unit vectors along the legs."""
    parts = robots.data.reshape(len(robots.data), len(problem.distances), 7)
    arms = np.einsum("mij,mnj->mni", robots.rotation, parts[..., 3:6])
    lines = robots.c[:, None, :] + arms - parts[..., :3]
    now = np.linalg.norm(lines, axis=2)
    units = lines / now[..., None]
    jacobian = np.concatenate([units, np.cross(arms, units)], axis=2)[..., _columns(problem)]
    return jacobian, now, parts[..., 6], units


def _turned(rotation: Real, turn: Real) -> Real:
    """Rotations after turns by vectors, by Rodrigues' formula."""
    angle = np.linalg.norm(turn, axis=1)[:, None, None]
    axis = np.divide(turn[:, :, None], angle, out=np.zeros((len(turn), 3, 1)), where=angle > 0)[..., 0]
    x, y, z = axis.T
    zero = np.zeros_like(x)
    cross = np.moveaxis(np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]), 2, 0)
    return np.asarray((np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)) @ rotation)

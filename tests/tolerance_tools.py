"""Robots within tolerance, and their true poses by Newton's method in floating point, many at once."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.motions.motion import Motion
from pkm_exact.poses.pose import Pose

Real = NDArray[np.float64]


@dataclass(frozen=True)
class Robots:
    """Many robots in ordinary coordinates: joints (m, n, 3), lengths (m, n)."""

    base: Real
    platform: Real
    lengths: Real
    motion: Motion


def errors_of(problem: ForwardProblem, count: int, seed: int) -> tuple[Real, Real, Real]:
    """Errors relative to the tolerances; every other robot at a corner, where errors are largest."""
    random = np.random.default_rng(seed)
    legs = len(problem.distances)
    found = [random.uniform(-1, 1, shape) for shape in ((count, legs, 3), (count, legs, 3), (count, legs))]
    for errors in found:
        errors[::2] = np.sign(errors[::2])
    if problem.motion.is_planar:
        found[0][..., 2] = found[1][..., 2] = 0
    return found[0], found[1], found[2]


def robots_with(problem: ForwardProblem, tolerances: Tolerances, errors: tuple[Real, Real, Real]) -> Robots:
    """The robots with these errors, in times the tolerances."""
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    base = np.array([[float(x) for x in leg.base] for leg in problem.distances]) * scales
    platform = np.array([[float(x) for x in leg.platform] for leg in problem.distances]) * scales
    lengths = np.sqrt([float(leg.length_squared) for leg in problem.distances])
    return Robots(
        base + float(tolerances.base) * errors[0],
        platform + float(tolerances.platform) * errors[1],
        lengths + float(tolerances.lengths) * errors[2],
        problem.motion,
    )


def poses_near(robots: Robots, pose: Pose) -> Real:
    """(m, 16): position, rotation and quaternion of the pose of each robot near a nominal one; exact but for rounding.

    Newton's method on |C + R B - A| = l, with rotations multiplied from the left.
    """
    count = len(robots.lengths)
    c = np.tile([float(x.midpoint) for x in pose.position], (count, 1))
    q = np.tile([float(x.midpoint) for x in pose.quaternion], (count, 1))
    for _ in range(12):
        rotation = rotations(q)
        arms = np.einsum("mij,mnj->mni", rotation, robots.platform)
        lines = c[:, None, :] + arms - robots.base
        lengths = np.linalg.norm(lines, axis=2)
        units = lines / lengths[..., None]
        jacobian = np.concatenate([units, np.cross(arms, units)], axis=2)
        columns = [0, 1, 5] if robots.motion.is_planar else list(range(6))
        step = np.zeros((count, 6))
        step[:, columns] = np.linalg.solve(jacobian[..., columns], (robots.lengths - lengths)[..., None])[..., 0]
        c += step[:, :3]
        turn = np.concatenate([np.ones((count, 1)), step[:, 3:] / 2], axis=1)
        q = _product(turn, q)
        q /= np.linalg.norm(q, axis=1, keepdims=True)
    size = np.abs(robots.lengths).max() + np.abs(robots.platform).max() + np.abs(robots.base).max()
    assert np.abs(robots.lengths - lengths).max() < 1e-13 * size
    return np.concatenate([c, rotations(q).reshape(count, 9), q], axis=1)


def rotations(q: Real) -> Real:
    """Rotation matrices of unit quaternions (m, 4)."""
    w, x, y, z = q.T
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def _product(p: Real, q: Real) -> Real:
    real = p[:, :1] * q[:, :1] - (p[:, 1:] * q[:, 1:]).sum(axis=1, keepdims=True)
    return np.concatenate([real, p[:, :1] * q[:, 1:] + q[:, :1] * p[:, 1:] + np.cross(p[:, 1:], q[:, 1:])], axis=1)


def exact_robot(problem: ForwardProblem, tolerances: Tolerances, errors: tuple[Real, Real, Real]) -> ForwardProblem:
    """The first of the robots with these errors, exactly; the metric must be that of ordinary coordinates."""
    assert problem.metric == (1, 1, 1)

    def off(value: Fraction, tolerance: Fraction, error: float) -> Fraction:
        return value + tolerance * Fraction(error).limit_denominator(1000)

    legs = []
    for k, leg in enumerate(problem.distances):
        base = tuple(off(x, tolerances.base, errors[0][0, k, i]) for i, x in enumerate(leg.base))
        platform = tuple(off(x, tolerances.platform, errors[1][0, k, i]) for i, x in enumerate(leg.platform))
        # The square of the length's decimal is exact; the length itself need not be rational.
        length = Fraction(float(leg.length_squared) ** 0.5) + tolerances.lengths * Fraction(errors[2][0, k]) * Fraction(
            99, 100
        )
        legs.append(Distance(base, platform, length * length))
    return ForwardProblem(tuple(legs), problem.metric, problem.motion)

"""From one pose of a moving robot to the next, in doubles, with a proof that it is the right one.

Newton's iteration finds a pose x; what is said of it is proved afterwards, with a bound for every rounding
(u = 2^-53). Let F be the leg equations, Study's condition and a chart a.x = c (``leg_tables``), Y about F'(x)^-1, and
in the maximum norm

    |Y F(x)| <= z,    |I - Y F'(y)| <= k(r) = e + r K   for |y - x| <= r.

Where k(r) < 1 and z <= (1 - k(r)) r there is exactly one solution within r of x, it is not singular, and it is within
z / (1 - k(r)) of x: y - Y F(y) is a contraction (Rump, Acta Numerica 19 (2010), section 13). If that holds with one r
for the joint values of both poses and all on the way from one to the other, and the last pose is within r of x, then
poses that are not singular join the last one to this: both are of the same assembly mode.

Sums of n products are off by at most n u / (1 - n u) times the sum of their absolute values, in whatever order they are
added (Higham, Accuracy and Stability of Numerical Algorithms, section 3.1). The constants here have room for that.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from pkm_exact.following.leg_ends import LegEnds, leg_ends, way_between
from pkm_exact.following.leg_tables import Array, LegTables
from pkm_exact.following.rounding import FORM_ERROR, OUTWARD, SLOPE_ERROR, TINY, U

STEPS: Final = 12
_SMALL_STEP: Final = 1e-13
_POSE_ERROR: Final = 64 * U


@dataclass(frozen=True, eq=False)
class Followed:
    """A pose that follows the actuators, with what is proved of it.

    Attributes
    ----------
    position : array of 3
        Of the platform's frame, in the robot's unit of length, ordinary coordinates.
    rotation : 3 x 3 array
    quaternion : array of 4
        Unit, scalar first.
    position_bound, rotation_bound : float
        How far any coordinate of the position, any entry of the rotation matrix is from the true ones, at most;
        infinite if nothing is proved.
    is_proved : bool
        Whether it is proved that exactly one pose for these joint values is that near, and that it is not singular.
    same_mode : bool
        Whether it is proved that all joint values between the last and these have a pose, that these poses join the
        last to this, and that none of them is singular. False means: not proved.
    values : array
        Joint values: lengths, crank angles in radians, or positions of slides.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> found = robot.follow([7.08, 5.1, 5.0], robot.solve().poses[1])
    >>> found.is_proved, found.same_mode, found.position_bound < 1e-9
    (True, True, True)
    """

    position: Array
    rotation: Array
    quaternion: Array
    position_bound: float
    rotation_bound: float
    is_proved: bool
    same_mode: bool
    values: Array
    tables: LegTables
    point: Array
    radius: float


@dataclass(frozen=True, eq=False)
class _Near:
    """The equations near a point: Y, the values there and how far these are off, e and K, and the chart."""

    point: Array
    inverse: Array
    residual: Array
    off: Array
    e: float
    curvature: float


def next_pose(tables: LegTables, values: Sequence[float] | Array, last: Followed) -> Followed:
    """The pose near the last one for the joint values given, and whether it is proved to be of the same mode."""
    given = np.array(values, dtype=float)
    ends = leg_ends(tables, given)
    chart: Array = tables.norm @ last.point
    constant = float(chart @ last.point)
    quadrics, sizes = _quadrics(tables, ends)
    point = _newton(quadrics, last.point, chart, constant)
    near = None if point is None else _near(tables, ends, quadrics, sizes, point, chart, constant)
    radius = None if near is None else _radius(near)
    if point is None or near is None or radius is None:
        return unproved(tables, given, last.point if point is None else point)
    same = last.is_proved and _is_same_mode(tables, ends, near, last, chart, constant)
    return _handed_out(tables, given, point, radius, same)


def settled(tables: LegTables, values: Sequence[float] | Array, point: Array) -> Followed:
    """The pose near a point in Study coordinates, which is the first: of no mode that is known."""
    given = np.array(values, dtype=float)
    return next_pose(tables, given, unproved(tables, given, point / np.sqrt(point @ tables.norm @ point)))


def unproved(tables: LegTables, values: Array, point: Array) -> Followed:
    """A point of which nothing is proved."""
    infinite = float("inf")
    return _handed_out(tables, values, point, infinite, False)


# The equations


def _quadrics(tables: LegTables, ends: LegEnds) -> tuple[Array, Array]:
    """All quadratic forms, and the sums of the absolute values that each entry is made from."""
    legs = tables.legs + ends.squares[:, None, None] * tables.norm
    sizes = np.abs(tables.legs) + ends.sizes[:, None, None] * np.abs(tables.norm)
    if tables.robot.chains:
        legs = legs + np.einsum("ji,jimn->jmn", ends.places, tables.moved)
        sizes = sizes + np.einsum("ji,jimn->jmn", np.abs(ends.places), np.abs(tables.moved))
    if tables.study is None:
        return legs, sizes
    return np.concatenate([legs, tables.study[None]]), np.concatenate([sizes, np.abs(tables.study)[None]])


def _newton(quadrics: Array, point: Array, chart: Array, constant: float) -> Array | None:
    """A point where all values are about 0; None if none is found."""
    size = 4 * float(np.max(np.abs(point)))
    jacobian = np.vstack([np.empty_like(quadrics[:, 0]), chart])
    for _ in range(STEPS):
        slopes = quadrics @ point
        jacobian[:-1] = 2 * slopes
        try:
            step = np.linalg.solve(jacobian, np.append(slopes @ point, chart @ point - constant))
        except np.linalg.LinAlgError:
            return None
        point = point - step
        length = float(np.max(np.abs(step)))
        if not length < size:  # it has run away, or is not a number
            return None
        if length < _SMALL_STEP * size:
            return point
    return None


def _near(
    tables: LegTables,
    ends: LegEnds,
    quadrics: Array,
    sizes: Array,
    point: Array,
    chart: Array,
    constant: float,
) -> _Near | None:
    slopes, slope_sizes = quadrics @ point, sizes @ np.abs(point)
    jacobian = np.vstack([2 * slopes, chart])
    try:
        inverse: Array = np.linalg.inv(jacobian)
    except np.linalg.LinAlgError:
        return None
    absolute = np.abs(inverse)
    residual = np.append(slopes @ point, chart @ point - constant)
    chart_size = np.abs(chart) @ np.abs(point) + abs(constant)
    off = FORM_ERROR * np.append(slope_sizes @ np.abs(point), chart_size) + TINY
    off[: len(ends.off)] += ends.value_off(tables, point, residual)
    deviation = np.abs(inverse @ jacobian - np.eye(len(point)))
    deviation += SLOPE_ERROR * (absolute @ np.vstack([2 * slope_sizes, np.abs(chart)]))
    deviation += absolute[:, : len(ends.off)] @ ends.slope_off(tables, point)
    curved = np.abs(np.tensordot(inverse[:, :-1], quadrics, 1)).sum(axis=(1, 2))
    curved += FORM_ERROR * (absolute[:, :-1] @ sizes.sum(axis=(1, 2)))
    curved += absolute[:, : len(ends.off)] @ ends.curvature_off(tables)
    e, curvature = float(np.max(deviation.sum(axis=1))), 2 * float(np.max(curved))
    return _Near(point, inverse, residual, off * OUTWARD, e * OUTWARD, curvature * OUTWARD)


# What is proved


def _distance(near: _Near, residual: Array, off: Array) -> float:
    """z for these values of the equations."""
    absolute = np.abs(near.inverse)
    moved = np.abs(near.inverse @ residual) + 16 * U * (absolute @ np.abs(residual)) + absolute @ off
    return float(np.max(moved)) * OUTWARD


def _radius(near: _Near) -> float | None:
    """How far the one solution is, at most; None if there is no proof."""
    z = _distance(near, near.residual, near.off)
    k = (near.e + 2 * z * near.curvature) * OUTWARD
    return z / (1 - k) * OUTWARD if k <= 0.5 else None


def _is_same_mode(tables: LegTables, ends: LegEnds, near: _Near, last: Followed, chart: Array, constant: float) -> bool:
    """Whether one ball has exactly one pose for all joint values on the way, and the last pose is in it."""
    before = leg_ends(tables, last.values)
    legs, point = len(ends.off), near.point
    way = way_between(tables, before, ends, ends.reach(tables, point, near.residual))
    quadrics, sizes = _quadrics(tables, before)
    first = near.residual.copy()
    first[:legs] = (quadrics[:legs] @ point) @ point
    off = near.off.copy()
    off[:legs] += FORM_ERROR * ((sizes[:legs] @ np.abs(point)) @ np.abs(point)) + TINY
    off[:legs] += before.value_off(tables, point, first) + way.bend * float(point @ tables.norm @ point) * OUTWARD
    z = max(_distance(near, near.residual, off), _distance(near, first, off))
    at_point, further = way.slope_change(tables, near.inverse, point)
    away = (float(np.max(np.abs(point - last.point))) + _last_off(last, chart, constant)) * OUTWARD
    return _is_contained(z, (near.e + at_point) * OUTWARD, (near.curvature + further) * OUTWARD, away)


def _is_contained(z: float, e: float, curvature: float, away: float) -> bool:
    """Whether a radius r of at least ``away`` has e + r K < 1 and z <= (1 - e - r K) r."""
    radius = away
    for _ in range(4):
        k = (e + radius * curvature) * OUTWARD
        if not k < 1:
            return False
        if z <= (1 - k) * radius * (2 - OUTWARD):
            return True
        radius = max(radius, z / (1 - k)) * (1 + 2.0**-6)
    return False


def _last_off(last: Followed, chart: Array, constant: float) -> float:
    """How far the last pose is from its point, both brought to the chart a.x = c."""
    total = float(np.sum(np.abs(chart)))
    size = float(np.max(np.abs(last.point))) + last.radius
    shift = total * (last.radius + 20 * U * size)
    room = abs(constant) - shift
    return (last.radius + size * shift / room) * OUTWARD if room > 0 else float("inf")


# The pose


def _handed_out(tables: LegTables, values: Array, point: Array, radius: float, same: bool) -> Followed:
    absolute = np.abs(point)
    forms = np.concatenate([tables.pose, tables.norm[None]])
    slopes, sizes = forms @ point, np.abs(forms)
    slope_sizes = sizes @ absolute
    numbers = slopes @ point
    norm = float(numbers[-1])
    entries = numbers[:-1] / norm
    bounds = np.full(len(entries), np.inf)
    if radius < np.inf:
        change = (2 * radius * slope_sizes.sum(axis=1) + radius**2 * sizes.sum(axis=(1, 2))) * OUTWARD
        room = norm * (1 - _POSE_ERROR) - change[-1]
        if room > 0:
            bounds = (change[:-1] + np.abs(entries) * change[-1]) / room
            bounds = (bounds + _POSE_ERROR * (slope_sizes[:-1] @ absolute) / norm + TINY) * OUTWARD
    root = np.sqrt(norm)
    quaternion = np.zeros(4)
    rotating = [place for place, index in enumerate(tables.support) if index < 4]
    quaternion[[tables.support[place] for place in rotating]] = point[rotating] / root
    scaled = point / root
    is_proved = bool(np.all(np.isfinite(bounds)))
    return Followed(
        position=entries[:3] * tables.unit,
        rotation=entries[3:].reshape(3, 3),
        quaternion=quaternion * tables.roots,
        position_bound=float(np.max(bounds[:3])) * tables.unit,
        rotation_bound=float(np.max(bounds[3:])),
        is_proved=is_proved,
        same_mode=same and is_proved,
        values=values,
        tables=tables,
        point=scaled,
        radius=(radius / root + 8 * U * float(np.max(np.abs(scaled)))) * OUTWARD,
    )

"""The leg equations of a robot as tables of doubles, for following its pose while its actuators move.

In Study coordinates x = (e, f) (``geometry.study``), with lengths in a unit s near the robot's size, leg j asks

    f_j(x) = x^T (Q_j + sum_i A_ji P_ji) x + v_j N(e) = 0,   v_j = |A_j|^2 - l_j^2,

where A_j is the lower end of the leg: fixed, or put somewhere by a crank or a slide. Study's condition is one more
quadric. Every entry is the double next to the exact number, so that its relative error is at most 2^-53.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.form import Form, form, outer, scaled
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, Slide
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.study import STUDY_CONDITION, Quadric, motion_quadrics

Array = NDArray[np.float64]

COORDINATES: Final = 12
"""Of a pose as it is handed out: position, and rotation matrix by rows."""

_ZERO: Final = (Fraction(0),) * 3


@dataclass(frozen=True, eq=False)
class LegTables:
    """A robot for following: n Study coordinates, m legs, k = 3 if cranks or slides move the lower ends, else 0.

    Attributes
    ----------
    robot : Robot
    support : tuple of int
        Which Study coordinates there are.
    legs : m x n x n array
        Q_j; with |A_j|^2 N(e) and the terms of A_j in it where A_j is fixed.
    moved : m x k x n x n array
        P_ji.
    study : n x n array, or None
        Study's condition, where it is one.
    norm : n x n array
        N(e).
    pose : 12 x n x n array
        N(e) times the ordinary position and rotation matrix.
    unit : float
        s, a power of two.
    roots : array of 4
        Of the quaternion: q_k = roots[k] e_k / sqrt(N(e)).
    weights : array of 3
        The metric.
    base, at_0, at_90, platform : m x 3 arrays
        Joints, and lower ends, in units of s: base + cos at_0 + sin at_90 for cranks, base + position at_0 for slides.
    rods_squared : array of m
        In units of s^2; all 0 if the legs themselves are actuated.
    """

    robot: Robot
    support: tuple[int, ...]
    legs: Array
    moved: Array
    study: Array | None
    norm: Array
    pose: Array
    unit: float
    roots: Array
    weights: Array
    base: Array
    at_0: Array
    at_90: Array
    rods_squared: Array
    platform: Array

    @property
    def is_cranked(self) -> bool:
        """Whether the actuators are cranks."""
        return bool(self.robot.chains) and isinstance(self.robot.chains[0], Crank)


def leg_tables(robot: Robot) -> LegTables:
    """The tables of a robot.

    Raises
    ------
    InputError
        If its platform is not held by as many legs as it has freedoms.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_jointed_robot
    >>> tables = leg_tables(read_jointed_robot("models/3-rpr-merlet-p.toml", "following"))
    >>> tables.legs.shape, tables.study is None, tables.unit
    ((3, 4, 4), True, 16.0)
    """
    unit = _unit(robot)
    metric, support = robot.metric, robot.motion.support
    quadrics = motion_quadrics(metric)
    roots = [Fraction(isqrt(g << 240), 1 << 120) for g in metric]

    def array(rows: list[Form]) -> Array:
        return np.array([_matrix(_combined(row, quadrics), support) for row in rows])

    base = [tuple(x / unit for x in joint) for joint in robot.base_joints]
    platform = [tuple(x / unit for x in joint) for joint in robot.platform_joints]
    forms, moved = [], []
    for a, b in zip(base, platform, strict=True):
        square = sum((g * x * x for g, x in zip(metric, b, strict=True)), Fraction(0))
        held = form(Fraction(1), scaled(metric, b, 2), constant=square)
        rows = [_moved_form(i, b, metric) for i in range(3)]
        if robot.chains:
            moved.append(array(rows))
        else:
            weights = sum((g * x * x for g, x in zip(metric, a, strict=True)), Fraction(0))
            held = _sum([held, form(constant=weights), *(_times(x, row) for x, row in zip(a, rows, strict=True))])
        forms.append(held)
    n = len(support)
    return LegTables(
        robot=robot,
        support=support,
        legs=array(forms),
        moved=np.array(moved) if moved else np.zeros((len(base), 0, n, n)),
        study=_matrix(STUDY_CONDITION, support) if robot.motion.has_study_condition else None,
        norm=array([form(constant=Fraction(1))])[0],
        pose=array(_pose_forms(roots)),
        unit=float(unit),
        roots=_doubles([roots[0] * roots[1] * roots[2], *roots]),
        weights=np.array(metric, dtype=float),
        base=_doubles(base),
        at_0=_doubles([_vector(chain, "first", unit) for chain in robot.chains] or [_ZERO] * len(base)),
        at_90=_doubles([_vector(chain, "second", unit) for chain in robot.chains] or [_ZERO] * len(base)),
        platform=_doubles(platform),
        rods_squared=_doubles([chain.rod_squared / unit**2 for chain in robot.chains] or [Fraction(0)] * len(base)),
    )


def _vector(chain: Crank | Slide, which: str, unit: Fraction) -> tuple[Fraction, ...]:
    """In units of s; the position of a slide is not."""
    if isinstance(chain, Slide):
        return tuple(x / unit for x in chain.direction) if which == "first" else _ZERO
    return tuple(x / unit for x in (chain.at_0 if which == "first" else chain.at_90))


def _unit(robot: Robot) -> Fraction:
    """A power of two at least as large as any coordinate of a joint, and less than twice the largest."""
    rows = [*robot.base_joints, *robot.platform_joints]
    size = max(abs(x) * isqrt(4 * g) / 2 for row in rows for x, g in zip(row, robot.metric, strict=True))
    if size == 0:
        raise InputError("joints: all are in one point; there is nothing to follow")
    unit = Fraction(1)
    while unit < size:
        unit *= 2
    while unit / 2 >= size:
        unit /= 2
    return unit


def _moved_form(i: int, b: tuple[Fraction, ...], metric: tuple[int, int, int]) -> Form:
    """The derivative of |C + R B - A|^2 - |A|^2 by A_i: -2 times the product of axis i with C + R B."""
    axis = [Fraction(int(i == k)) for k in range(3)]
    return form(position=scaled(metric, axis, -2), rotation=outer(metric, axis, b, -2))


def _pose_forms(roots: list[Fraction]) -> list[Form]:
    """The ordinary position, in units of s, and the ordinary rotation matrix by rows."""
    rows = [[Fraction(0)] * 17 for _ in range(COORDINATES)]
    for i in range(3):
        rows[i][4 + i] = roots[i]
        for j in range(3):
            rows[3 + 3 * i + j][7 + 3 * i + j] = roots[i] / roots[j]
    return [tuple(row) for row in rows]


def _times(factor: Fraction, row: Form) -> Form:
    return tuple(factor * x for x in row)


def _sum(rows: list[Form]) -> Form:
    return tuple(sum(column, Fraction(0)) for column in zip(*rows, strict=True))


def _combined(row: Form, quadrics: list[Quadric]) -> dict[tuple[int, int], Fraction]:
    total: dict[tuple[int, int], Fraction] = {}
    for coefficient, quadric in zip(row, quadrics, strict=True):
        for key, value in quadric.items():
            total[key] = total.get(key, Fraction(0)) + coefficient * value
    return total


def _matrix(quadric: dict[tuple[int, int], Fraction] | Quadric, support: tuple[int, ...]) -> Array:
    """The symmetric matrix of a quadratic form on the coordinates that there are."""
    place = {index: position for position, index in enumerate(support)}
    matrix = np.zeros((len(support), len(support)))
    for (k, m), value in quadric.items():
        if k in place and m in place:
            entry = float(value) if k == m else float(value / Fraction(2))
            matrix[place[k], place[m]] = matrix[place[m], place[k]] = entry
    return matrix


def _doubles(rows: object) -> Array:
    return np.array(rows, dtype=object).astype(float)

"""The six wrench indices of planar machines at thousands of poses, each between certified bounds.

A machine exerts F = sum s_k g_k, |s_k| <= 1, with g_k = (f_x, f_y, m_z) the wrench of an actuator at its greatest
force: a zonotope in three dimensions. With N = g_i x g_j and h = sum_k |N.g_k| its facets are N.F = +-h, so that

    pure F_is         min h / |(N_x, N_y)|          force in every direction, without moment
    pure m_z          min h / |N_z|                 moment without force
    absolute F_is     min_k sum_j |n_k.g_j|         force in every direction, whatever the moment; n_k normal to f_k
    absolute F_av     the greatest force of a vertex
    pure F_av         the greatest force where an edge meets m_z = 0
    absolute m_z      sum_k |m_k|

Reference: Firmani, Zibil, Nokleby and Podhorodeski, in Parallel Manipulators: Towards New Applications (2008), chapter
6, whose six indices these are; the closed forms are ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from itertools import combinations, product
from typing import Final

import numpy as np

from pkm_exact.errors import InputError
from pkm_exact.statics.interval_arrays import Array, Intervals

CHUNK: Final = 2048
"""Poses at once: what then fits into the caches."""


@dataclass(frozen=True)
class WrenchIndices:
    """The six indices, an interval for each pose.

    Attributes
    ----------
    pure_isotropic_force, pure_available_force, absolute_isotropic_force, absolute_available_force : Intervals
    pure_moment, absolute_moment : Intervals
    """

    pure_isotropic_force: Intervals
    pure_available_force: Intervals
    absolute_isotropic_force: Intervals
    absolute_available_force: Intervals
    pure_moment: Intervals
    absolute_moment: Intervals


def wrench_indices(generators: Intervals) -> WrenchIndices:
    """The indices of machines whose actuators exert these wrenches at their greatest forces.

    Parameters
    ----------
    generators : Intervals of shape (actuators, 3, poses)

    Examples
    --------
    >>> found = wrench_indices(Intervals.exactly(np.eye(3)[:, :, None]))
    >>> bool(found.pure_isotropic_force.lo[0] <= 1 <= found.pure_isotropic_force.hi[0])
    True
    >>> bool(found.absolute_available_force.lo[0] <= 2**0.5 <= found.absolute_available_force.hi[0])
    True
    """
    if generators.lo.ndim != 3 or generators.lo.shape[1] != 3 or generators.lo.shape[0] < 3:
        raise InputError("generators: are not of shape (actuators, 3, poses) with 3 actuators at least")
    count = generators.lo.shape[2]
    parts = [_indices(generators[:, :, start : start + CHUNK]) for start in range(0, count, CHUNK)]
    return WrenchIndices(*(_joined([getattr(part, entry.name) for part in parts]) for entry in fields(WrenchIndices)))


def _joined(parts: Sequence[Intervals]) -> Intervals:
    return Intervals(np.concatenate([part.lo for part in parts]), np.concatenate([part.hi for part in parts]))


def _indices(generators: Intervals) -> WrenchIndices:
    columns = [[generators[k, j] for j in range(3)] for k in range(generators.lo.shape[0])]
    pure_force, pure_moment = _through_facets(columns)
    moment, force = _total([abs(g[2]) for g in columns]), _greatest_force(columns)
    found = _greatest_without_moment(columns)
    low = np.maximum(found.lo, _near_vertices(columns, moment, force))
    return WrenchIndices(pure_force, Intervals(low, found.hi), _least_width(columns), force, pure_moment, moment)


Columns = Sequence[Sequence[Intervals]]


def _total(values: Sequence[Intervals]) -> Intervals:
    found = values[0]
    for value in values[1:]:
        found = found + value
    return found


def _minor(a: Sequence[Intervals], b: Sequence[Intervals], i: int, j: int) -> Intervals:
    return a[i] * b[j] - a[j] * b[i]


def _through_facets(columns: Columns) -> tuple[Intervals, Intervals]:
    """The pure isotropic force and moment."""
    force = moment = Intervals.exactly(np.full(columns[0][0].lo.shape, np.inf))
    for one, two in combinations(range(len(columns)), 2):
        a, b = columns[one], columns[two]
        x, y, z = _minor(a, b, 1, 2), _minor(a, b, 2, 0), _minor(a, b, 0, 1)
        others = [g for k, g in enumerate(columns) if k not in (one, two)]
        reach = _total([abs(_total([x * g[0], y * g[1], z * g[2]])) for g in others])
        force = force.least(reach.ratio((x.square() + y.square()).root()))
        moment = moment.least(reach.ratio(abs(z)))
    return force, moment


def _least_width(columns: Columns) -> Intervals:
    """The absolute isotropic force: half the least width of the polygon of forces."""
    found = Intervals.exactly(np.full(columns[0][0].lo.shape, np.inf))
    for one, a in enumerate(columns):
        reach = _total([abs(_minor(a, b, 0, 1)) for two, b in enumerate(columns) if two != one])
        found = found.least(reach.ratio((a[0].square() + a[1].square()).root()))
    return found


def _greatest_force(columns: Columns) -> Intervals:
    """The absolute available force: at one of all sums, of which opposite ones are alike."""
    found = Intervals.exactly(np.zeros(columns[0][0].lo.shape))
    for signs in product((1, -1), repeat=len(columns) - 1):
        x, y = (_signed(columns, (1, *signs), j) for j in (0, 1))
        found = found.greatest((x.square() + y.square()).root())
    return found


def _signed(columns: Columns, signs: Sequence[int], j: int) -> Intervals:
    return _total([g[j] if s > 0 else -g[j] for g, s in zip(columns, signs, strict=True)])


def _greatest_without_moment(columns: Columns) -> Intervals:
    """The pure available force: below by edges that surely meet m_z = 0, above by all that may."""
    shape = columns[0][0].lo.shape
    low, high = np.zeros(shape), np.zeros(shape)
    for k, edge in enumerate(columns):
        others = [g for index, g in enumerate(columns) if index != k]
        for signs in product((1, -1), repeat=len(others) - 1):
            x, y, m = (_signed(others, (1, *signs), j) for j in range(3))
            sure = abs(m).hi < abs(edge[2]).lo
            may = abs(m).lo <= abs(edge[2]).hi
            place = (-(m / edge[2])).clipped(-1, 1)
            force = ((x + place * edge[0]).square() + (y + place * edge[1]).square()).root()
            low = np.where(sure, np.maximum(low, force.lo), low)
            high = np.where(may, np.maximum(high, force.hi), high)
    return Intervals(low, high)


def _near_vertices(columns: Columns, moment: Intervals, force: Intervals) -> Array:
    """A lower bound of the same that holds where an edge ends at m_z = 0, or nearly.

    From a vertex V with moment m on to the vertex W of greatest moment M of the other sign, m_z = 0 is met after the
    share t = |m| / (|m| + M) of the way, where the force is at least (1 - t) |V| - t |W|.
    """
    found = np.zeros(moment.lo.shape)
    for signs in product((1, -1), repeat=len(columns) - 1):
        x, y, m = (_signed(columns, (1, *signs), j) for j in range(3))
        share = abs(m).ratio(abs(m) + moment).clipped(0, 1)
        rest = Intervals.exactly(np.float64(1)) - share
        bound = rest * (x.square() + y.square()).root() - share * force
        found = np.fmax(found, bound.lo)
    return found


def median(values: Intervals) -> tuple[float, float]:
    """Bounds of the median: the median of the bounds."""
    return float(np.median(values.lo)), float(np.median(values.hi))


def least(values: Intervals) -> tuple[float, float]:
    """Bounds of the least value."""
    return float(values.lo.min()), float(values.hi.min())

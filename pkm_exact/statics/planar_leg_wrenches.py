"""Wrenches of the legs of planar machines with the platform not turned, at many positions, between certified bounds.

With B the base joint, p the platform joint from the platform's origin, P = C + p, and x the product of the plane:

    RRR, first R      (P - E) / ((E - B) x (P - E))          E the elbow; with the second R also
         second R     -(P - B) / the same
    RPR, first R      (P - B) turned by 90 degrees, / |P - B|^2;       its P also  (P - B) / |P - B|
    PRR, P            v / (v.u)                              v = P - slider, u the rail; with the R also
         R            u turned by 90 degrees / (v.u)

Each is a force (f_x, f_y) for a unit of the actuator's force or moment, its moment about the platform's origin p x f.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pkm_exact.statics.interval_arrays import Intervals


@dataclass(frozen=True)
class PlanarLeg:
    """Base joint, or a point of the rail, and platform joint of a leg.

    Attributes
    ----------
    base, platform : pairs of Intervals
    """

    base: tuple[Intervals, Intervals]
    platform: tuple[Intervals, Intervals]


def rrr(leg: PlanarLeg, position: Any, lengths: tuple[float, float], *, both: bool = False) -> list[list[Intervals]]:
    """The wrenches of a leg with two links; the elbow is to the left of the way from base to platform joint."""
    x, y, size = _way(leg, position)
    first, second = (Intervals.exactly(np.float64(length)) for length in lengths)
    # E - B is along d by c |d| and across it by s |d|, with c = (|d|^2 + l1^2 - l2^2) / (2 |d|^2).
    along = (size + first.square() - second.square()) / (size + size)
    across = (first.square() / size - along.square()).root()
    ex, ey = along * x - across * y, along * y + across * x
    vx, vy = x - ex, y - ey
    area = ex * vy - ey * vx
    found = [_wrench(leg, vx / area, vy / area)]
    if both:
        found.append(_wrench(leg, -(x / area), -(y / area)))
    return found


def rpr(leg: PlanarLeg, position: Any, *, both: bool = False) -> list[list[Intervals]]:
    """The wrenches of a telescopic leg that a motor turns at its base; with its length actuated too."""
    x, y, size = _way(leg, position)
    found = [_wrench(leg, -(y / size), x / size)]
    if both:
        length = size.root()
        found.append(_wrench(leg, x / length, y / length))
    return found


def prr(
    leg: PlanarLeg, position: Any, rail: tuple[Any, Any], length: float, *, both: bool = False
) -> list[list[Intervals]]:
    """The wrenches of a leg of fixed length on a slider, which stands ahead on its rail."""
    x, y, _ = _way(leg, position)
    ux, uy = rail
    across = y * ux - x * uy
    ahead = (Intervals.exactly(np.float64(length)).square() - across.square()).root()
    # v = P - slider = across n - ahead u, n the rail turned by 90 degrees.
    vx, vy = -(across * uy) - ahead * ux, across * ux - ahead * uy
    found = [_wrench(leg, -(vx / ahead), -(vy / ahead))]
    if both:
        found.append(_wrench(leg, uy / ahead, -(ux / ahead)))
    return found


def stacked(wrenches: list[list[Intervals]], limits: list[float]) -> Intervals:
    """Wrenches at the greatest forces, as ``wrench_indices`` takes them."""
    scaled = [[value * Intervals.exactly(limit) for value in g] for g, limit in zip(wrenches, limits, strict=True)]
    return Intervals(
        np.array([[value.lo for value in g] for g in scaled]), np.array([[value.hi for value in g] for g in scaled])
    )


def _way(leg: PlanarLeg, position: Any) -> tuple[Intervals, Intervals, Intervals]:
    """From base to platform joint, and its squared length."""
    x, y = (c + p - b for c, p, b in zip(position, leg.platform, leg.base, strict=True))
    return x, y, x.square() + y.square()


def _wrench(leg: PlanarLeg, fx: Intervals, fy: Intervals) -> list[Intervals]:
    px, py = leg.platform
    return [fx, fy, px * fy - py * fx]

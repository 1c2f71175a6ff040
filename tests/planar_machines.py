"""The planar machines of chapter 6 of Parallel Manipulators (2008), as matching its table 4 recovered them.

Triangles have their corners at 210, 330 and 90 degrees, squares at 225, 315, 45 and 135, base and platform alike; rails
go from corner to corner. Edges are 0.5 and 0.2 m, of the square with rails 0.43; links 0.2 m, rods on slides 0.23.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from pkm_exact.statics.interval_arrays import Intervals
from pkm_exact.statics.planar_leg_wrenches import PlanarLeg, prr, rpr, rrr, stacked

LAYOUTS = {
    "3-RRR": ("RRR", 3, False),
    "3-RPR": ("RPR", 3, False),
    "3-PRR": ("PRR", 3, False),
    "RRR in-branch": ("RRR", 3, True),
    "RPR in-branch": ("RPR", 3, True),
    "PRR in-branch": ("PRR", 3, True),
    "4-RRR": ("RRR", 4, False),
    "4-RPR": ("RPR", 4, False),
    "4-PRR": ("PRR", 4, False),
}


def number(numerator: float, denominator: float = 1.0) -> Intervals:
    return Intervals.exactly(np.float64(numerator)) / Intervals.exactly(np.float64(denominator))


def _corners(count: int, edge: Intervals) -> list[tuple[Intervals, Intervals]]:
    one = number(1)
    if count == 3:
        root = number(3).root()
        half, upright = number(1, 2), root / number(2)
        turns = [(-upright, -half), (upright, -half), (number(0), one)]
        radius = edge / root
    else:
        diagonal = one / number(2).root()
        turns = [(diagonal * number(x), diagonal * number(y)) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        radius = edge / number(2).root()
    return [(radius * x, radius * y) for x, y in turns]


def _rails(count: int) -> list[tuple[Intervals, Intervals]]:
    if count == 4:
        return [(number(x), number(y)) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    half, upright = number(1, 2), number(3).root() / number(2)
    return [(number(1), number(0)), (-half, upright), (-half, -upright)]


def _legs(kind: str, count: int) -> list[PlanarLeg]:
    edge = number(43, 100) if (kind, count) == ("PRR", 4) else number(1, 2)
    pairs = zip(_corners(count, edge), _corners(count, number(1, 5)), strict=True)
    return [PlanarLeg(base, platform) for base, platform in pairs]


def wrenches(layout: str, x: Any, y: Any) -> Intervals:
    """The wrenches at positions in units of a millimetre, at the greatest torques and forces: 4.2 Nm, 10 N, 2.1 Nm."""
    kind, count, both = LAYOUTS[layout]
    position = tuple(Intervals.exactly(np.asarray(values, dtype=float)) / number(1000) for values in (x, y))
    found: list[list[Intervals]] = []
    for leg, rail in zip(_legs(kind, count), _rails(count), strict=True):
        if kind == "RRR":
            found += rrr(leg, position, (0.2, 0.2), both=both)
        elif kind == "RPR":
            found += rpr(leg, position, both=both)
        else:
            found += prr(leg, position, rail, 0.23, both=both)
    limits = {"RRR": (4.2, 2.1), "RPR": (4.2, 10.0), "PRR": (10.0, 2.1)}[kind]
    return stacked(found, list(limits if both else limits[:1]) * count)


def workspace(layout: str) -> tuple[Any, Any]:
    """All positions of a grid of 1 mm that the legs reach and do not only touch."""
    kind, count, _ = LAYOUTS[layout]
    steps = np.arange(-500, 501)
    x, y = (values.ravel() for values in np.meshgrid(steps, steps))
    inside = np.ones(x.shape, bool)
    for leg, (ux, uy) in zip(_legs(kind, count), _rails(count), strict=True):
        dx, dy = (
            values / 1000 + float(p.lo) - float(b.lo)
            for values, p, b in zip((x, y), leg.platform, leg.base, strict=True)
        )
        if kind == "PRR":
            inside &= np.abs(dy * float(ux.lo) - dx * float(uy.lo)) < 0.23 - 1e-9
        else:
            inside &= dx * dx + dy * dy < 0.16 - 1e-9
    return x[inside], y[inside]

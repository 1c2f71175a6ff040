"""Boxes on grids so coarse that N(e) is, or is not, proved to be other than 0 on them by a little."""

from __future__ import annotations

from fractions import Fraction
from functools import partial

from certificate_subjects import Content
from forged_margins import ACCEPTED, REJECTED, Case
from held_mechanisms import Pose, listing

ZERO = Fraction(0)
BITS = 7
"""The half width of a box, four units of the grid, is 1/32."""


def _in_place(weight: int, x: Fraction = ZERO) -> Content:
    """A translation held in (x, 0, 0) by three planes, in the chart where e0 is 1 / weight, and a box around it.

    On the grid e0 is m = 2^7 / weight, to the nearest integer. Krawczyk's operator proves the box for m > 8 (1 + x),
    and N(e) is not 0 on it where m^2 > 4 (2 m + 4): from 10 on.
    """
    at = Pose((1, 0, 0, 0), (0, x, 0, 0))
    planes = [at.in_plane(n, (0, 0, 0)) for n in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    content = listing("translation", [at], planes)
    unit = Fraction(1 << BITS, weight)
    centre = [hex(round(v * unit)) for v in (*at.e, *at.f)]
    boxes = {
        "chart": [weight, 0, 0, 0],
        "real": [{"exponents": [BITS, BITS], "centre": centre}],
        "complex": [],
    }
    poses = [{**pose, "parameter": None} for pose in content["poses"]]
    how = {"claim": "complete", "completeness_route": "product-bound", "method": "krawczyk"}
    return content | how | {"representation": None, "krawczyk": boxes, "poses": poses}


GRIDS: dict[str, Case] = {
    f"e0 is nearly {(1 << BITS) / weight:.2f} units of the grid": (partial(_in_place, weight), status)
    for weight, status in ((9, ACCEPTED), (13, ACCEPTED), (14, REJECTED))
} | {
    f"the same at {x}": (partial(_in_place, 13, Fraction(x)), status)
    for x, status in (("1/8", ACCEPTED), ("1/2", REJECTED))
}

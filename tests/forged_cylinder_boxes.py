"""Boxes around a pose on a cylinder that are as wide as can be proved, or a little wider."""

from __future__ import annotations

from fractions import Fraction
from functools import partial

from forged_margins import ACCEPTED, REJECTED, Case
from held_mechanisms import Content, Pose, listing

AT = Pose((1, 0, 0, 0), (0, 1, 0, 0))
"""C = (1, 0, 0)."""


def in_a_wide_box(radius: Fraction, exponents: tuple[int, int]) -> Content:
    """A translation in the first direction, on a cylinder; the box has 4 units of the grid on each side."""
    point = (1 - radius, Fraction(0), Fraction(-1))
    held = [AT.in_plane((0, 1, 0), (0, 0, 0)), AT.in_plane((0, 0, 1), (0, 0, 0))]
    content = listing("translation", [AT], [*held, AT.axis_distance(point, (0, 0, 1), (0, 0, 0))])
    first, second = exponents
    centre = [1 << first, 0, 0, 0, 0, 1 << second, 0, 0]
    box = {"exponents": list(exponents), "centre": [hex(x) for x in centre]}
    poses = [{**pose, "parameter": None} for pose in content["poses"]]
    boxes = {"chart": [1, 0, 0, 0], "real": [box], "complex": []}
    return content | {"method": "krawczyk", "representation": None, "krawczyk": boxes, "poses": poses}


WIDE: dict[str, Case] = {
    f"a box on a cylinder of radius {radius} 2^-20, on the grids 2^-{exponents[0]} and 2^-{exponents[1]}": (
        partial(in_a_wide_box, Fraction(radius, 1 << 20), exponents),
        status,
    )
    for radius, exponents, status in (
        (18_000, (40, 10), ACCEPTED),
        (15_000, (40, 10), REJECTED),
        (5_864_448, (6, 6), REJECTED),
    )
}

"""Certificates of which each shows one condition of a checker that no other table does."""

from __future__ import annotations

from copy import deepcopy
from fractions import Fraction
from functools import partial
from typing import Any

from certificate_subjects import subject
from certificate_tools import tolerant_certificate
from flint import fmpz_poly
from forged_neighbours import _turned
from forged_primes import Case
from handmade_systems import complete, listed, represented
from held_mechanisms import Content, Pose, listing

from pkm_exact.constraints.angle import Angle

HOME = Pose((1, 0, 0, 0), (0, 1, 2, 3))
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def _four_legs() -> Content:
    """A platform that does not turn: four legs determine it, by differences alone, though two poses are the bound."""
    legs = [HOME.distance(a, (0, 0, 0)) for a in ((0, 0, 0), (5, 0, 0), (0, 5, 0), (0, 0, 7))]
    return listing("translation", [HOME], legs) | {"claim": "complete", "completeness_route": "modular-rank"}


def _ellipses(poses: int) -> Content:
    """A point of a plane on two ellipses that touch in (1, 0) and meet in (0, 1) and (2, 1); the last may be left out.

    Four are all, with multiplicity; as many as two poses that both count twice.
    """
    meetings = [Pose((1, 0, 0, 0), (0, x, y, 0)) for x, y in ((0, 1), (1, 0), (2, 1))]
    touching, origin = meetings[1], (0, 0, 0)
    tubes = [touching.axis_distance((1, y, 0), (0, slope, 1), origin) for slope, y in ((1, Fraction(3, 2)), (2, 3))]
    content = listing("translation", meetings[:poses], [touching.in_plane(Z, origin), *tubes])
    shown = [{**pose, "multiplicity": m} for pose, m in zip(content["poses"], (1, 2, 1), strict=False)]
    complete_ = {"claim": "complete", "completeness_route": "modular-rank", "complex_solutions": 4}
    return content | complete_ | {"poses": shown}


def _turns_held_doubly() -> Content:
    """Three forms on R that are dependent to first order at R = 1: the last is the sum of two, and a symmetric one."""
    at = Pose((1, 0, 0, 0), (0, 0, 0, 0))
    one, two, symmetric = (1, 2, -3, 4, 5, 1, 2, 0, 7), (2, 1, 1, 0, -4, 3, 5, 1, -2), (0, 3, 1, 3, 6, -2, 1, -2, 4)
    last = [sum(entries) for entries in zip(one, two, symmetric, strict=True)]
    return listing("spherical", [at], [at.linear((*[0] * 7, *form)) for form in (one, two, last)], None)


def _in_a_box(*normals: tuple[Any, ...], at: Pose = HOME, grid: int = 7) -> Content:
    """A translation held by planes, the box of its pose, and all claimed that three planes prove."""
    content = listing("translation", [at], [at.in_plane(n, (0, 0, 0)) for n in normals])
    centre = [hex(round(Fraction(value) * (1 << grid))) for value in (*at.e, *at.f)]
    boxes = {"chart": [1, 0, 0, 0], "real": [{"exponents": [grid, grid], "centre": centre}], "complex": []}
    poses = [{**pose, "parameter": None} for pose in content["poses"]]
    how = {"claim": "complete", "completeness_route": "product-bound", "method": "krawczyk"}
    return content | how | {"representation": None, "krawczyk": boxes, "poses": poses}


def _between_near_planes() -> Content:
    """The precision that the grid of the poses needs gives no place of the pose: 360 bits are lost on the way."""
    place = Pose((1, 0, 0, 0), (0, Fraction(1, 3), 2, Fraction(1, 7)))
    return _in_a_box(X, Y, (1, 1, Fraction(1, 1 << 360)), at=place, grid=400)


def _told_by_one_entry() -> Content:
    """Two poses whose boxes agree in all but the last entry of the rotation; the second one has the lower parameter."""
    poses = []
    for thousandths in (-1100, 50):
        x, z = (Fraction(turn, 1000 << 32) for turn in (thousandths, 3467))  # half the angles about the axes
        turned = (1 + x + 3 * z, -1 + x + 3 * z, -3 - z + 3 * x, -3 + z - 3 * x)
        poses.append(Pose(turned, (0, 0, 0, 0)))
    return listing("spherical", poses, [poses[0].at_point((0, 0, 0))], None, form=(0, -1, 0, 0, 0, 0, 0, 0))


def _half_turned(*grids: tuple[int, int]) -> Content:
    """An upright platform held at a point by three legs, turned so that the cosine is 5/3: e3 = i/2, and the conjugate.

    It is listed once for each grid; with the mirrored place there are four solutions.
    """
    up, (x, y, z) = Fraction(1, 2), (1, 2, 3)
    legs = [HOME.distance(a, (0, 0, 0)) for a in ((0, 0, 0), (5, 0, 0), (0, 5, 0))]
    constraints = [*legs, Angle(_vector(X), _vector(X), Fraction(5, 3))]
    content = listing("schoenflies", [HOME], constraints)
    point = [(1, 0), (0, 0), (0, 0), (0, up), (0, -z * up), (x, y * up), (y, -x * up), (z, 0)]
    boxes = [
        {
            "exponents": list(grid),
            "centre": [[hex(int(part * (1 << grid[k // 4]))) for part in pair] for k, pair in enumerate(point)],
        }
        for grid in grids
    ]
    number = 2 * len(grids)
    counts: Content = {"complex_solutions": number, "distinct_solutions": number, "real_poses": 0, "box_exponent": 0}
    parts = {"chart": [1, 0, 0, 0], "real": [], "complex": boxes}
    claim = ("complete", "product-bound") if number == 4 else ("not-proven-complete", None)
    counts |= dict(zip(("claim", "completeness_route"), claim, strict=True))
    how: dict[str, Any] = {"method": "krawczyk", "representation": None, "poses": [], "krawczyk": parts}
    return content | counts | how


def _vector(values: tuple[int, int, int]) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = map(Fraction, values)
    return x, y, z


def _no_algebra(multiplicity: int) -> Content:
    """x y is -y: the products of x and y do not commute. (0, 0), simple, is the only solution, and counts for three."""
    texts = ("x^2-x", "x*y+y", "y^2-x")
    shown = represented([(0, 0)], (1, 1))
    return listed("x,y", texts, shown, multiplicities=multiplicity) | complete("exact-elimination", 3, elimination=[])


def _nothing_multiplied() -> Content:
    """One unknown, and a step that names an element by itself."""
    shown = represented([(1,)], (1,))
    return listed("x", ("x^2-x", "x^2+x-2"), shown) | complete("exact-elimination", 1, elimination=[["0"]])


T, LONG = fmpz_poly([0, 1]), 3**4000
PLANAR, COARSE = (
    partial(subject, "tolerance, planar, complete"),
    partial(tolerant_certificate, "3-rpr-merlet-p", "1/100"),
)
NO_SOLUTION, TWO, BOUND = "not proved to hold a solution", "not proved to hold at most one", "a bound of the pose"
OTHER_RADII = (
    (PLANAR, "pairs", 0, "outer", (1,), Fraction(1024, 3), f"pair 1: {NO_SOLUTION}"),
    (PLANAR, "pairs", 0, "outer", (2,), Fraction(1024, 24), f"pair 1: {NO_SOLUTION}"),
    (PLANAR, "pairs", 0, "outer", (3,), Fraction(1024, 32), f"pair 1: {NO_SOLUTION}"),
    (PLANAR, "boxes", 0, "inner", (2,), Fraction(1024, 880), f"box of pose 1: {BOUND}"),
    (PLANAR, "boxes", 1, "inner", (2,), Fraction(1024, 1023), "box of pose 2: the inner box is not contained"),
    (PLANAR, "boxes", 1, "inner", (3,), Fraction(1024, 1023), "box of pose 2: the inner box is not contained"),
    (COARSE, "boxes", 0, "outer", (0, 1, 2, 3), Fraction(165, 32), f"box of pose 1: {TWO}"),
)
"""Radii of tolerance certificates that are a little too large, each by a factor; what is true of smaller ones."""


def _with_radii(make: Any, part: str, number: int, key: str, places: tuple[int, ...], factor: Fraction) -> Content:
    content: Content = deepcopy(make())
    radii = content[part][number][key]
    for place in places:
        radii[place] = hex(int(int(radii[place], 16) * factor))
    return content


MEET = "boxes: complex box 1 and complex box 2 meet"
SINGLES: dict[str, Case] = {
    "four legs of a platform that does not turn": (_four_legs, "accepted", ""),
    "turns held by forms that are dependent to first order": (_turns_held_doubly, "accepted", ""),
    "ellipses that touch and meet twice": (partial(_ellipses, 3), "accepted", ""),
    "ellipses that touch and meet twice, one simple pose left out": (partial(_ellipses, 2), "rejected", "claim: "),
    "a box with three planes": (partial(_in_a_box, X, Y, Z), "accepted", ""),
    **{
        f"a box with {number} of three planes": (
            partial(_in_a_box, *(X, Y, Z)[:number]),
            "rejected",
            "boxes: the constraints are not as many",
        )
        for number in (1, 2)
    },
    "poses that one entry of the rotation tells apart": (_told_by_one_entry, "accepted", ""),
    "a box between planes that are nearly dependent": (_between_near_planes, "accepted", ""),
    "a complex box, f on a finer grid": (partial(_half_turned, (16, 20)), "accepted", ""),
    "a complex box twice, f on a finer grid": (partial(_half_turned, (16, 20), (16, 20)), "rejected", MEET),
    "a complex box twice, e on a finer grid": (partial(_half_turned, (20, 16), (20, 16)), "rejected", MEET),
    **{
        f"no algebra, and a solution that counts {m} times": (partial(_no_algebra, m), "rejected", "elimination")
        for m in (1, 2, 3)
    },
    "one unknown, and an element by itself": (_nothing_multiplied, "accepted", ""),
    **{
        f"{part} {number} {key}, {places}, {factor} times as large": (
            partial(_with_radii, make, part, number, key, places, factor),
            "rejected",
            reason,
        )
        for make, part, number, key, places, factor, reason in OTHER_RADII
    },
    "a root 3/8 of a polynomial with long coefficients": (
        lambda: _turned((8 * T - 3) * (LONG * T - 2 * LONG - 1)),
        "accepted",
        "",
    ),
}

"""Forged and honest certificates of boxes around solutions: one solution twice, in other charts and on other grids."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache

from certificate_subjects import Content, subject

from pkm_exact.certify import pure

BOXED = "planar, boxes"
BITS = 400
Point = tuple[tuple[Fraction, Fraction], ...]
"""Real and imaginary parts of (e, f)."""


@cache
def solution(kind: str, number: int) -> Point:
    """A solution of the robot of ``BOXED``, to about 400 bits, in the chart of its certificate."""
    content = subject(BOXED)
    metric, base, platform = pure.a_robot(content["robot"], "robot")
    legs = tuple(map(pure.Leg, base, platform, pure.a_configuration(content["configuration"], len(base))))
    boxes = pure.a_list_of_boxes(content["krawczyk"], "krawczyk")
    system = pure.chart_system(legs, metric, boxes.w)
    box = system.restricted((boxes.real if kind == "real" else boxes.others)[number])
    finer = pure.narrowed(system, box, BITS)
    assert finer is not None
    x = dict(zip(system.places, finer.centre, strict=True))
    return tuple((x[k].re, x[k].im) if k in x else (Fraction(0), Fraction(0)) for k in range(8))


def in_chart(point: Point, chart: Sequence[int]) -> Point:
    """The same solution with w.e = 1 for another w."""
    re, im = (sum((w * part[i] for w, part in zip(chart, point, strict=False)), Fraction(0)) for i in (0, 1))
    size = re * re + im * im
    return tuple(((x * re + y * im) / size, (y * re - x * im) / size) for x, y in point)


def conjugate(point: Point) -> Point:
    """The conjugate solution."""
    return tuple((x, -y) for x, y in point)


def on_grid(point: Point, a: int, b: int, *, real: bool = False) -> Content:
    """The box of a solution on a grid."""
    rows = [
        [hex(round(part * (1 << (a if k < 4 else b)))) for part in parts[: 1 if real else 2]]
        for k, parts in enumerate(point)
    ]
    return {"exponents": [a, b], "centre": [row[0] for row in rows] if real else rows}


def listed(chart: Sequence[int], *pairs: Content) -> Content:
    """A certificate of boxes of complex solutions alone."""
    counts = dict.fromkeys(("complex_solutions", "distinct_solutions"), 2 * len(pairs))
    boxes = {"chart": list(chart), "real": [], "complex": list(pairs)}
    none: Content = {"poses": [], "real_poses": 0, "box_exponent": 0, "completeness_route": None}
    return {**subject(BOXED), **counts, **none, "claim": "not-proven-complete", "krawczyk": boxes}


OWN = (3, 0, 0, 1)
NEARLY_REAL = (10**9, 0, 0, 1)
"""A chart in which e0 is real but for 10^-18."""


def _one(number: int, grid: tuple[int, int], chart: Sequence[int] = OWN, turned: bool = False) -> Content:
    point = in_chart(solution("complex", number), chart)
    return on_grid(conjugate(point) if turned else point, *grid)


def _twice(first: tuple[int, int], second: tuple[int, int]) -> Content:
    """One solution on two grids, in order."""
    boxes = [_one(0, first), _one(0, second)]
    return listed(OWN, *sorted(boxes, key=_order))


def _order(box: Content) -> list[Fraction]:
    units = [Fraction(1, 1 << box["exponents"][k // 4]) for k in range(8)]
    return [int(part, 16) * unit for parts, unit in zip(box["centre"], units, strict=True) for part in parts]


def _upright(chart: Sequence[int], number: int) -> bool:
    """Which of a pair of conjugate solutions is listed on a fine grid: whether it is the one in the certificate."""
    return next(y for _, y in in_chart(solution("complex", number), chart) if y) > 0


def _with_conjugate() -> Content:
    """A solution on a fine grid and the conjugate one on a coarse grid, where e0 is real and e3 decides."""
    number = 0
    turned = not _upright(NEARLY_REAL, number)
    boxes = [_one(number, (80, 60), NEARLY_REAL, turned), _one(number, (45, 42), NEARLY_REAL, not turned)]
    return listed(NEARLY_REAL, *sorted(boxes, key=_order))


def _first_part(unit: int, turned: bool) -> Content:
    """The first imaginary part is about one unit of the grid, or minus one."""
    point = in_chart(solution("complex", 0), NEARLY_REAL)
    size = abs(point[0][1])
    a = next(a for a in range(200) if round(size * (1 << a)) == unit)
    return listed(NEARLY_REAL, _one(0, (a, 60), NEARLY_REAL, turned))


UNIT_CHART = (1, 0, 0, 0)
LAST_CHART = (0, 0, 0, 1)
GRIDS = {
    "narrow enough by a little": (
        *((OWN, 0, False, (11, 8)), (OWN, 0, False, (12, 11)), (OWN, 0, False, (16, 9))),
        *((LAST_CHART, 0, False, (10, 9)), (UNIT_CHART, 0, True, (12, 9))),
    ),
    "too wide by a little": ((OWN, 0, False, (11, 9)), (OWN, 0, False, (13, 14)), (OWN, 0, False, (12, 12))),
    "too wide in imaginary parts alone": ((OWN, 0, False, (11, 7)),),
    "too wide in a real part alone": ((UNIT_CHART, 1, True, (9, 5)), ((1, 0, 0, 2), 1, False, (20, 29))),
    "too wide in the first coordinate alone": ((LAST_CHART, 0, False, (9, 5)), (LAST_CHART, 0, False, (10, 4))),
    "too wide in the last coordinate alone": ((OWN, 0, False, (11, 10)),),
    "too wide in one of the others": ((LAST_CHART, 0, False, (10, 10)), (OWN, 0, False, (12, 7))),
}
"""Grids on which the image of a box is, or is not, within the box: chart, solution, whether conjugate, exponents."""
Case = tuple[Callable[[], Content], str, str]
BOXES: dict[str, Case] = {
    **{
        f"one solution on the grids {first} and {second}": (
            lambda first=first, second=second: _twice(first, second),  # type: ignore[misc]
            "rejected",
            "boxes: complex box 1 and complex box 2 meet",
        )
        for first in ((28, 25), (40, 40), (28, 40), (36, 25))
        for second in ((28, 25), (40, 40), (28, 40), (50, 35))
    },
    "a solution and its conjugate, as another one": (_with_conjugate, "rejected", "boxes: complex box 1 and complex"),
    "a nearly real solution": (
        lambda: listed(NEARLY_REAL, _one(0, (80, 60), NEARLY_REAL, not _upright(NEARLY_REAL, 0))),
        "accepted",
        "",
    ),
    "a nearly real solution, the wrong one": (
        lambda: listed(NEARLY_REAL, _one(0, (80, 60), NEARLY_REAL, _upright(NEARLY_REAL, 0))),
        "rejected",
        "boxes: complex box 1 is not the one",
    ),
    "e0 is real": (
        lambda: listed(UNIT_CHART, _one(0, (30, 30), UNIT_CHART, not _upright(UNIT_CHART, 0))),
        "accepted",
        "",
    ),
    "e0 is real, the wrong one": (
        lambda: listed(UNIT_CHART, _one(0, (30, 30), UNIT_CHART, _upright(UNIT_CHART, 0))),
        "rejected",
        "boxes: complex box 1 is not the one",
    ),
    "the first imaginary part is one unit": (
        lambda: _first_part(1, not _upright(NEARLY_REAL, 0)),
        "accepted",
        "",
    ),
    "the first imaginary part is minus one unit": (
        lambda: _first_part(1, _upright(NEARLY_REAL, 0)),
        "rejected",
        "boxes: complex box 1 is not the one",
    ),
    "two solutions": (lambda: listed(OWN, _one(0, (28, 25)), _one(1, (28, 25))), "accepted", ""),
    "two solutions in the wrong order": (
        lambda: listed(OWN, _one(1, (28, 25)), _one(0, (28, 25))),
        "rejected",
        "boxes: the complex ones",
    ),
    "two solutions on different grids": (lambda: listed(OWN, _one(0, (36, 25)), _one(1, (28, 32))), "accepted", ""),
    **{
        f"{words}: {grid} in the chart {chart}": (
            lambda chart=chart, number=number, turned=turned, grid=grid: listed(  # type: ignore[misc]
                chart, _one(number, grid, chart, turned)
            ),
            *(("accepted", "") if "enough" in words else ("rejected", "boxes: not proved that complex box 1")),
        )
        for words, rows in GRIDS.items()
        for chart, number, turned, grid in rows
    },
    "a coarse grid of e and a fine one of f": (
        lambda: listed(OWN, _one(0, (28, 70))),
        "rejected",
        "boxes: not proved that complex box 1",
    ),
    "a fine grid of e and a coarse one of f": (
        lambda: listed(OWN, _one(0, (70, 28))),
        "rejected",
        "boxes: not proved that complex box 1",
    ),
    "a fine grid of e0 alone and a coarse one of f": (
        lambda: listed((0, 0, 0, 1), _one(0, (70, 28), (0, 0, 0, 1), not _upright((0, 0, 0, 1), 0))),
        "rejected",
        "boxes: not proved that complex box 1",
    ),
}

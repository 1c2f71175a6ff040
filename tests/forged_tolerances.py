"""Tolerance certificates in which one bound is a little narrower than what is proved, or one box wider, or askew."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from math import isqrt

from certificate_subjects import Content, subject
from certificate_tools import Path_, at, tolerant_certificate, with_entry

from pkm_exact.certify.checker.study_motion import motion

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"

ROBOTS: dict[str, tuple[Callable[[], Content], Fraction]] = {
    "tolerance 10^-5": (lambda: subject("tolerance, planar, complete"), Fraction(1, 1 << 12)),
    "tolerance 10^-2": (partial(tolerant_certificate, "3-rpr-merlet-p", "1/100"), Fraction(1, 8)),
}
"""And how much narrower, in widths of the bound: by more than the solver leaves, and checkers may differ."""
BOUNDS = (
    *(("position", k) for k in (0, 1)),
    *(("rotation", i, j) for i in (0, 1) for j in (0, 1)),
    *(("quaternion", k) for k in (0, 3)),
    *(("centroid", k) for k in (0, 1)),
)


def _changed(make: Callable[[], Content], path: Path_, change: Callable[[list[str]], list[str]]) -> Content:
    content = {key: value for key, value in make().items() if key != "digest"}
    return with_entry(content, path, change(at(content, path)))


def _narrower(end: int, part: Fraction, bounds: list[str]) -> list[str]:
    values = [Fraction(text) for text in bounds]
    step = part * (values[1] - values[0])
    return [str(values[0] + step if end == 0 else values[0]), str(values[1] - step if end == 1 else values[1])]


def _smaller(part: Fraction, error: str) -> str:
    return str(Fraction(error) * (1 - part))


def _cases() -> Iterator[tuple[str, Case]]:
    for name, (make, part) in ROBOTS.items():
        yield name, (make, ACCEPTED)
        for box in (0, -1) if len(make()["boxes"]) > 1 else (0,):
            for bound in BOUNDS:
                for end in (0, 1):
                    path = ("boxes", box, *bound)
                    said = f"{name}, {'.'.join(map(str, path))} narrower at end {end}"
                    yield said, (partial(_changed, make, path, partial(_narrower, end, part)), REJECTED)
            for key in ("position_error", "rotation_error"):
                yield (
                    f"{name}, boxes.{box}.{key} smaller",
                    (partial(_changed, make, ("boxes", box, key), partial(_smaller, part)), REJECTED),  # type: ignore[arg-type]
                )


# Boxes so much wider that they hardly are, or are not, proved

TIMES: tuple[tuple[str, Path_, int | None, int], ...] = (
    *(("tolerance 10^-5", ("pairs", 0, "outer"), place, n) for place, n in ((1, 3), (2, 24), (3, 32))),
    ("tolerance 10^-5", ("boxes", 0, "inner"), 2, 880),
    ("tolerance 10^-2", ("boxes", 0, "outer"), None, 198),
)
"""In one unknown, or in all, 1024 / (n + 1) times as wide is proved, 1024 / n times is not."""


def _wider(place: int | None, factor: Fraction, widths: list[str]) -> list[str]:
    return [hex(int(int(w, 16) * factor)) if place in (None, k) else w for k, w in enumerate(widths)]


def _widths() -> Iterator[tuple[str, Case]]:
    for name, path, place, n in TIMES:
        for m, answer in ((n, REJECTED), (n + 1, ACCEPTED)):
            said = f"{name}, {'.'.join(map(str, path))}: 1024/{m} times {'all' if place is None else place}"
            yield said, (partial(_changed, ROBOTS[name][0], path, partial(_wider, place, Fraction(1024, m))), answer)


# A robot that is made for its pose: e = (-5/4, 0, 0, 1), f = (0, f1, f2, 0)

BASE, PLATFORM = ((-50, 10), (9, 12), (-50, 20)), ((0, 0), (5, -2), (-1, -1))
ORIGINS, UNIT, GRID = ((-1, -14), (-1, -3)), 64, Fraction(1, 1 << 104)
SLACK, INNER, OUTER, TOLERANCE = (Fraction(1, 10**digits) for digits in (6, 8, 4, 13))
E0, F1, F2 = Fraction(-5, 4), Fraction(43, 256), Fraction(-21, 128)
Numbers = list[Fraction]


def _on_grid(value: Fraction) -> str:
    return hex(-(-value // GRID))


def _around(*values: Fraction) -> list[list[str]]:
    """Bounds, and those of a third coordinate, which is 0."""
    return [*([str(value - SLACK), str(value + SLACK)] for value in values), ["0", "0"]]


def _made(radius: Fraction, e0: Fraction = Fraction(0), f1: Fraction = Fraction(0)) -> Content:
    """The box around the pose has this radius in e0; the pose itself may be off its centre."""
    e, f = (E0 + e0, Fraction(0), Fraction(0), Fraction(1)), (Fraction(0), F1 + f1, F2, Fraction(0))
    placed = motion(e, f, (1, 1, 1))
    rotation = [[x / placed.norm for x in row[:2]] for row in placed.rotation[:2]]

    def turned(point: tuple[int, int]) -> Numbers:
        return [row[0] * point[0] + row[1] * point[1] for row in rotation]

    centroid = [x / placed.norm * UNIT + o for x, o in zip(placed.position, ORIGINS[0], strict=False)]
    position = [x - y for x, y in zip(centroid, turned(ORIGINS[1]), strict=True)]
    squares = [
        sum(((c + x - y) ** 2 for c, x, y in zip(position, turned(b), a, strict=True)), Fraction(0))
        for a, b in zip(BASE, PLATFORM, strict=True)
    ]
    root = Fraction(isqrt(placed.norm.numerator * 10**40 // placed.norm.denominator), 10**20)
    none = ["0", "0"]
    w, z = _around(E0 / root, 1 / root)[:2]
    box = {
        "pose": 1,
        "chart": [[0, 0], [0, 0], [0, 0], [1, 0]],
        "centre": [[_on_grid(x), "0x0"] for x in (E0, Fraction(1), F1, F2)],
        "outer": [_on_grid(x) for x in (radius, OUTER, OUTER / UNIT, OUTER / UNIT)],
        "inner": [_on_grid(x) for x in (INNER, INNER, INNER / UNIT, INNER / UNIT)],
        "position": _around(*position),
        "rotation": [*(_around(*row) for row in rotation), [none, *_around(Fraction(1))[::-1]]],
        "quaternion": [w, none, none, z],
        "centroid": _around(*centroid),
        "position_error": str(SLACK),
        "rotation_error": str(SLACK),
    }
    content = {key: value for key, value in tolerant_certificate("3-rpr-merlet-p", "1/100").items() if key != "digest"}
    joints = {"base": _points(BASE), "platform": _points(PLATFORM)}
    return content | {
        "robot": content["robot"] | {"name": "made up", "source": "made up"} | joints,
        "configuration": {"name": "home", "lengths_squared": list(map(str, squares))},
        "tolerances": dict.fromkeys(("base", "platform", "lengths"), str(TOLERANCE)),
        "frames": dict(zip(("base", "platform"), _points(ORIGINS), strict=True)) | {"unit": str(UNIT)},
        "boxes": [box],
        "unproved": [2],
        "pairs": [],
        "complete": False,
    }


def _points(points: Sequence[tuple[int, int]]) -> list[list[str]]:
    return [[str(x), str(y), "0"] for x, y in points]


NEAREST, HARDLY = GRID * (Fraction(1, 2) + Fraction(1, 1 << 20)), Fraction(1, 1 << 216)
"""How far the pose may be from the centre, and by how much it is farther."""
NARROW = Fraction(1, 1 << 9)
MADE: dict[str, Case] = {
    "a box made for its pose": (partial(_made, NARROW), ACCEPTED),
    "a box made for its pose, too wide in one unknown": (partial(_made, Fraction(1, 8)), REJECTED),
    **{
        f"a pose just too far from the grid point in {unknown}, end {sign}": (
            partial(_made, NARROW, **{unknown: sign * (NEAREST + HARDLY)}),
            REJECTED,
        )
        for unknown in ("e0", "f1")
        for sign in (1, -1)
    },
}
TIGHT: dict[str, Case] = dict((*_cases(), *_widths())) | MADE

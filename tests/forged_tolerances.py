"""Tolerance certificates in which one bound is a little narrower than what is proved, in all else as they should be."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial

from certificate_subjects import Content, subject
from certificate_tools import Path_, at, tolerant_certificate, with_entry

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


TIGHT: dict[str, Case] = dict(_cases())

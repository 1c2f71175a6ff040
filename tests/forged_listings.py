"""Certificates that list some of the real poses, or intervals of the parameter that do not hold one root each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import isqrt, prod

from certificate_subjects import Content
from flint import fmpz_poly
from forged_representations import fit_real_poses, turning

from pkm_exact.certify.checker.descartes import real_roots

T = fmpz_poly([0, 1])

POLYNOMIALS: dict[str, fmpz_poly] = {
    "T - 3": T - 3,
    "T^2 - 2": T**2 - 2,
    "T^2 - T - 1": T**2 - T - 1,
    "T^3 - 2": T**3 - 2,
    "T^3 - 3 T + 1": T**3 - 3 * T + 1,
    "T^3 - 3 T - 1": T**3 - 3 * T - 1,
    "T^4 - 5 T^2 + 5": T**4 - 5 * T**2 + 5,
    "T^4 - T^2 - 1": T**4 - T**2 - 1,
    "T^6 - 6 T^4 + 3 T^2 - 2, where a value of the chain at 0 is 0": T**6 - 6 * T**4 + 3 * T**2 - 2,
    "T^6 - 6 T^4 + 9 T^2 - 1": T**6 - 6 * T**4 + 9 * T**2 - 1,
    "T^5 + T + 1, where degrees fall by more than 1": T**5 + T + 1,
    "T^6 - 6 T^3 + 7": T**6 - 6 * T**3 + 7,
    "two real roots of five": (T**3 - T - 7) * (T**2 + T + 5) * (T - 4),
    "four real roots of ten": (T**4 - 9 * T**2 + T + 3) * (T**6 + T + 9),
    "ten rational roots": prod((7 * T - n * abs(n) for n in range(-4, 5)), start=T + 3),
    "twenty real roots": prod((3 * T - n for n in range(-29, 30, 3)), start=T**2 + 2),
    "two close roots of four": ((3 * T - 1) ** 2 * (1 << 90) - 1) * (T**2 - 3),
}


def listing(
    h: fmpz_poly, kept: Sequence[int] | None = None, intervals: dict[int, tuple[str, str]] | None = None
) -> Content:
    """Poses that are turned about an axis, by angles whose half tangents are roots of h: those of these places alone.

    Some have other intervals of the parameter.
    """
    content = turning(h, 60)
    fit_real_poses(content, None)
    if kept is not None:
        content["poses"] = [content["poses"][place] for place in kept]
    for place, ends in (intervals or {}).items():
        content["poses"][place] = content["poses"][place] | {"parameter": list(ends)}
    number = len(content["poses"])
    return content | {"real_poses": number, "box_exponent": content["box_exponent"] if number else 0}


FEWER: dict[str, Callable[[], Content]] = {
    f"{number} fewer: {name}": (lambda h=h, number=number: listing(h, range(number, len(real_roots(h)))))
    for name, h in POLYNOMIALS.items()
    for number in (1, 2, 3, 4)
    if number <= len(real_roots(h))
}

ROOTS = (T - 5) * (4 * T + 1) * (3 * T + 10) * (T**2 - 2) * (T**2 + 7)
"""With the roots 5, -1/4, -10/3, and the irrational ones of 2."""


def _places() -> dict[str, int]:
    """The places in the list of the roots -10/3, -1/4 and 5, and of the square root of 2."""
    ends = [Fraction(pose["parameter"][0]) for pose in listing(ROOTS)["poses"]]
    values = {"-10/3": -10 / 3, "-1/4": -0.25, "5": 5, "root": 2**0.5}
    return {name: min(range(len(ends)), key=lambda k: abs(float(ends[k]) - value)) for name, value in values.items()}


def _cell(place: int, grid: int = 32) -> tuple[str, str]:
    return str(Fraction(place, 1 << grid)), str(Fraction(place + 1, 1 << grid))


AT = _places()
OTHERS = [place for place in range(5) if place != AT["root"]]

INTERVALS: dict[str, Callable[[], Content]] = {
    name: (lambda kept=kept, intervals=intervals: listing(ROOTS, kept, intervals))
    for name, (kept, intervals) in {
        "a point twice, a root left out": ([AT["5"], *OTHERS], None),
        "an interval twice, a root left out": ([AT["-10/3"], *OTHERS], None),
        "a point, and an interval around it, a root left out": ([AT["5"], *OTHERS], {0: ("9/2", "11/2")}),
        "an interval in another one, a root left out": ([AT["-10/3"], *OTHERS], {0: ("-4", "-3")}),
        "an interval without a root": (range(5), {AT["root"]: ("6", "7")}),
        "an interval around two roots": (range(5), {AT["root"]: ("-1", "3/2")}),
        "an interval around three roots": (range(5), {AT["root"]: ("-2", "3/2")}),
        "a point that is no root": (range(5), {AT["root"]: ("3/2", "3/2")}),
        "the ends of an interval the wrong way": (range(5), {AT["root"]: ("3/2", "1")}),
        "an interval that ends at its root": (range(5), {AT["5"]: ("9/2", "5")}),
        "an interval that begins at its root": (range(5), {AT["5"]: ("5", "11/2")}),
        "two intervals that end at a root, another one left out": (
            [AT["5"], *OTHERS],
            {0: ("4", "5"), 1 + OTHERS.index(AT["5"]): ("5", "6")},
        ),
        "an interval that is too wide": (range(5), {AT["root"]: ("1", "3/2")}),
        "an interval around a point": (range(5), {AT["5"]: ("9/2", "11/2")}),
        "intervals of two roots in each other's place": (
            range(5),
            {AT["5"]: ("-1/4", "-1/4"), AT["-1/4"]: ("5", "5")},
        ),
        "a cell without a root": (range(5), {AT["root"]: _cell(6 << 32)}),
        "a cell without a root, below all roots": (range(5), {AT["-10/3"]: _cell(-6 << 32)}),
        "a cell beside the root": (range(5), {AT["root"]: _cell(isqrt(2 << 64) + 1)}),
        "a point of the grid that is no root": (range(5), {AT["5"]: (_cell((5 << 32) + 1)[0],) * 2}),
        "a cell that ends at its root": (range(5), {AT["5"]: _cell((5 << 32) - 1)}),
        "a cell that begins at its root": (range(5), {AT["5"]: _cell(5 << 32)}),
        "two cells that end at a root, another one left out": (
            [AT["5"], *OTHERS],
            {0: _cell((5 << 32) - 1), 1 + OTHERS.index(AT["5"]): _cell(5 << 32)},
        ),
        "a cell of a finer grid": (range(5), {AT["root"]: _cell(isqrt(2 << 66), 33)}),
        "a cell of a coarser grid": (range(5), {AT["root"]: _cell(isqrt(2 << 62), 31)}),
        "a point, and a cell at it, a root left out": ([AT["5"], *OTHERS], {0: _cell(5 << 32)}),
        "an interval far too wide": (range(5), {AT["5"]: ("9/2", "9" * 3000)}),
        "an interval with many digits": (range(5), {AT["root"]: ("1", "9" * 5000)}),
        "an interval on a grid that is too fine": (range(5), {AT["root"]: ("1", f"{(3 << 4999) + 1}/{1 << 5000}")}),
        "an interval over 3": (range(5), {AT["root"]: ("4/3", "5/3")}),
    }.items()
}

LISTINGS = FEWER | INTERVALS


def far_out() -> Content:
    """A root of 2^5000, which is listed."""
    content, root = listing(T - 5), str(1 << 5000)
    far = turning(T - (1 << 5000), 60)
    content["poses"][0] = content["poses"][0] | {"parameter": [root, root]}
    return content | {"representation": far["representation"]}

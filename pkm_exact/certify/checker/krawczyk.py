"""Boxes with exactly one solution each: Krawczyk's operator, replayed in ball arithmetic.

The unknowns x are those coordinates of (e, f) that are not 0 for every pose. The equations are the quadratic forms of
the legs and of e.f (the latter but for planar robots), and w.e = 1. For a box X around m and any matrix Y the image

    K(X) = m - Y F(m) + (1 - Y F'(X)) (X - m)

contains all solutions in X; if it lies in the interior of X, there is exactly one, and it is simple.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Final, TypeAlias

from flint import acb, acb_mat, arb, arb_mat, ctx, fmpz_mat

from pkm_exact.certify.checker.budget import ball_cost, charge, limbs
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric, combination, leg_form, motion
from pkm_exact.certify.checker.verdict import MAX_PRECISION, rejected

REACH: Final = 4
"""A coordinate differs from the centre by at most 4 units of its grid, real and imaginary parts each."""
NEAREST: Final = arb(1) / 2 + arb(2) ** -20
"""A centre is no farther from the solution than this, in units of its grid."""
NARROWINGS: Final = 32
"""Times that an enclosure is narrowed at one precision; the width is about squared each time."""
GUARD: Final = 64
"""Bits beyond twice those of a box that are tried first; then twice as many, as long as they do not suffice."""

Parts: TypeAlias = tuple[int, int]


@dataclass(frozen=True)
class Box:
    """Coordinates (e, f) within ``REACH`` units of the centre; those of e are 2^-exponents[0], of f 2^-exponents[1]."""

    exponents: tuple[int, int]
    centre: tuple[Parts, ...]
    real: bool

    def conjugate(self) -> Box:
        """The box of the conjugate points."""
        return Box(self.exponents, tuple((real, -imaginary) for real, imaginary in self.centre), self.real)

    def is_disjoint(self, other: Box) -> bool:
        """Whether the boxes are apart in some coordinate."""
        for place, (one, two) in enumerate(zip(self.centre, other.centre, strict=True)):
            exponents = self.exponents[place // 4], other.exponents[place // 4]
            up, higher = (max(exponents) - exponent for exponent in exponents)
            gap = REACH * ((1 << up) + (1 << higher))
            if any(abs((a << up) - (b << higher)) > gap for a, b in zip(one, two, strict=True)):
                return True
        return False


@dataclass(frozen=True)
class Isolated:
    """The boxes of a certificate: real ones, and one of each pair of conjugate ones, in the chart w.e = 1."""

    chart: tuple[int, ...]
    real: tuple[Box, ...]
    pairs: tuple[Box, ...]

    @property
    def count(self) -> int:
        """How many solutions the boxes stand for."""
        return len(self.real) + 2 * len(self.pairs)


class Equations:
    """The equations of the poses in a chart; 2 Q_k is the symmetric matrix of the k-th quadratic form."""

    def __init__(self, legs: Sequence[Leg], metric: Metric, chart: Sequence[int]) -> None:
        self.metric = metric
        self.planar = len(legs) == PLANAR_LEGS
        self.kept = (0, 3, 5, 6) if self.planar else tuple(range(8))
        self._legs = legs
        self._weights = [acb(chart[k]) if k < 4 else acb(0) for k in self.kept]

    @cached_property
    def _polar(self) -> fmpz_mat:
        """All 2 Q_k, one below the other: from the values at sums of two unit vectors."""
        forms = [leg_form(leg, self.metric) for leg in self._legs]

        def values(*places: int) -> list[int]:
            point = [places.count(place) for place in range(8)]
            placed = motion(point[:4], point[4:], self.metric)
            study = [] if self.planar else [int(placed.study)]
            return [*study, *(int(combination(form, placed.coordinates())) for form in forms)]

        single = {k: values(k) for k in self.kept}
        double = {(k, m): values(k, m) for k in self.kept for m in self.kept}
        count = len(self.kept) - 1
        rows = [
            [double[k, m][q] - single[k][q] - single[m][q] for m in self.kept] for q in range(count) for k in self.kept
        ]
        return fmpz_mat(rows)

    @cached_property
    def _polar_words(self) -> int:
        """Size of the largest coefficient of the forms."""
        return limbs(max(int(abs(value).bit_length()) for value in self._polar.entries()))

    def derivative(self, x: acb_mat) -> acb_mat:
        """F' at x."""
        size = x.nrows()
        return acb_mat(size, size, [*(acb_mat(arb_mat(self._polar)) * x).entries(), *self._weights])

    def value(self, derivative: acb_mat, x: acb_mat) -> acb_mat:
        """F at x, by Euler's identity for quadratic forms."""
        product = (derivative * x).entries()
        return acb_mat(len(product), 1, [*(entry / 2 for entry in product[:-1]), product[-1] - 1])

    def image(self, m: acb_mat, spread: acb_mat) -> acb_mat | None:
        """K(X) - m for X = m + spread and an exact m; None if F'(m) cannot be inverted."""
        size = m.nrows()
        products = 2 * size**3 + 2 * self._polar.nrows() * size + 4 * size**2
        charge(10**5 + products * ball_cost(limbs(ctx.prec) + self._polar_words))
        at = self.derivative(m)
        try:
            inverse = _middle(at.inv())
        except ZeroDivisionError:
            return None
        unit = acb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        return (unit - inverse * self.derivative(m + spread)) * spread - inverse * self.value(at, m)

    def norm(self, x: acb_mat) -> acb:
        """N(e)."""
        g = self.metric
        weights = {0: g[0] * g[1] * g[2], 1: g[0], 2: g[1], 3: g[2]}
        return sum((weights[k] * v * v for k, v in zip(self.kept, x.entries(), strict=True) if k < 4), acb(0))


def check_isolated(isolated: Isolated, equations: Equations) -> Iterator[str]:
    """Every box holds exactly one solution, with N(e) not 0; no two hold the same; complex ones are not real."""
    if any(weight for k, weight in enumerate(isolated.chart) if k not in equations.kept):
        raise rejected("boxes: the chart has a weight for a coordinate that is 0 for every pose")
    numbered = [("real", k, box) for k, box in enumerate(isolated.real, 1)]
    numbered += [("complex", k, box) for k, box in enumerate(isolated.pairs, 1)]
    for kind, number, box in numbered:
        if any(box.centre[k] != (0, 0) for k in range(8) if k not in equations.kept):
            raise rejected(f"boxes: {kind} box {number} leaves the plane of the robot")
        if not any(_is_proved(equations, box, bits) for bits in _precisions(box)):
            raise rejected(f"boxes: not proved that {kind} box {number} holds exactly one solution")
        if not _is_nearest(equations, box):
            raise rejected(f"boxes: the centre of {kind} box {number} is not the grid point nearest to the solution")
    yield f"boxes: each of {len(numbered)} holds exactly one solution, simple, and N(e) is not 0 there"
    _check_pairs(isolated.pairs)
    charge(2 * 10**5 * len(numbered) ** 2)
    for (kind, i, one), (other_kind, j, two) in combinations(numbered, 2):
        if not (one.is_disjoint(two) and one.is_disjoint(two.conjugate())):
            raise rejected(f"boxes: {kind} box {i} and {other_kind} box {j} meet")
    yield f"boxes: pairwise disjoint, {isolated.count} solutions with conjugate ones, {len(isolated.real)} of them real"


def _check_pairs(pairs: Sequence[Box]) -> None:
    """The complex boxes hold no real solution, and are listed as they must be."""
    for number, box in enumerate(pairs, 1):
        if not box.is_disjoint(box.conjugate()):
            raise rejected(f"boxes: complex box {number} meets its conjugate")
        if next((imaginary for _, imaginary in box.centre if imaginary), 0) <= 0:
            raise rejected(f"boxes: complex box {number} is not the one of its pair that is listed")
    if list(pairs) != sorted(pairs, key=_key):
        raise rejected("boxes: the complex ones are not listed in their order")


def _key(box: Box) -> list[Fraction]:
    """The centre, by which complex boxes are ordered."""
    return [Fraction(part, 1 << box.exponents[k // 4]) for k, parts in enumerate(box.centre) for part in parts]


def _reaches(equations: Equations, box: Box) -> list[arb]:
    """Half the widths of the box, exactly."""
    return [REACH * arb(2) ** -box.exponents[k // 4] for k in equations.kept]


def _place(equations: Equations, box: Box) -> tuple[acb_mat, acb_mat]:
    """The centre, exact at the precision in force, and balls around 0 that hold the rest."""
    units = [arb(2) ** -box.exponents[k // 4] for k in equations.kept]
    size = len(units)
    m = [acb(unit * box.centre[k][0], unit * box.centre[k][1]) for unit, k in zip(units, equations.kept, strict=True)]
    balls = [arb(0, reach) for reach in _reaches(equations, box)]
    return acb_mat(size, 1, m), acb_mat(size, 1, [acb(ball, arb(0) if box.real else ball) for ball in balls])


def _precisions(box: Box) -> Iterator[int]:
    """Precisions to try: how many bits are lost depends on the robot."""
    sizes = [abs(part).bit_length() for parts in box.centre for part in parts]
    bits = 2 * max(*box.exponents, *sizes) + GUARD
    yield bits
    while 2 * bits <= MAX_PRECISION:
        bits *= 2
        yield bits


def _is_proved(equations: Equations, box: Box, bits: int) -> bool:
    """Whether K maps the box into its interior, and N(e) is not 0 in it."""
    with ctx.workprec(bits):
        m, spread = _place(equations, box)
        image = equations.image(m, spread)
        if image is None or equations.norm(m + spread).contains(0):
            return False
        return all(
            abs(value.real) < reach and (value.imag == 0 if box.real else abs(value.imag) < reach)
            for value, reach in zip(image.entries(), _reaches(equations, box), strict=True)
        )


def _is_nearest(equations: Equations, box: Box) -> bool:
    """Whether the centre is the grid point nearest to the solution in a box that was proved."""
    reaches = _reaches(equations, box)
    for bits in _precisions(box):
        for image, m in _images(equations, box, bits):
            with ctx.workprec(bits):
                centre, _ = _place(equations, box)
                offsets = [
                    abs(part) * (REACH / reach)
                    for entry, reach in zip((m - centre + image).entries(), reaches, strict=True)
                    for part in (entry.real, entry.imag)
                ]
            if all(offset < NEAREST for offset in offsets):
                return True
            if any(offset > NEAREST for offset in offsets):
                return False
    return False


def narrowed(equations: Equations, box: Box, precision: int) -> list[arb] | None:
    """An enclosure of the solution in a real box that was proved, to about ``precision`` bits: all eight (e, f).

    None if too many bits are lost on the way; more of them will serve.
    """
    goal, bits = arb(2) ** -precision, 2 * precision + GUARD
    for image, m in _images(equations, box, bits):
        with ctx.workprec(bits):
            x = (m + image).entries()
        if all(entry.real.rad() < goal * (1 + abs(entry.real.mid())) for entry in x):
            found = [arb(0)] * 8
            for k, entry in zip(equations.kept, x, strict=True):
                found[k] = entry.real
            return found
    return None


def _images(equations: Equations, box: Box, bits: int) -> Iterator[tuple[acb_mat, acb_mat]]:
    """K(X) - m and m, for the box and then for one enclosure K(X) after another, as long as they get narrower."""
    with ctx.workprec(bits):
        m, spread = _place(equations, box)
    for _ in range(NARROWINGS):
        with ctx.workprec(bits):
            image = equations.image(m, spread)
        if image is None:
            return
        yield image, m
        with ctx.workprec(bits):
            x = m + image
            m = _middle(x)
            balls = [acb(arb(0, v.real.rad()), arb(0) if box.real else arb(0, v.imag.rad())) for v in x.entries()]
            if not any(new.real.rad() < old.real.rad() for new, old in zip(balls, spread.entries(), strict=True)):
                return
            spread = acb_mat(x.nrows(), 1, balls)


def _middle(matrix: acb_mat) -> acb_mat:
    """The exact midpoints of the entries."""
    entries = [acb(entry.real.mid(), entry.imag.mid()) for entry in matrix.entries()]
    return acb_mat(matrix.nrows(), matrix.ncols(), entries)

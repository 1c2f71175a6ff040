"""Isolating intervals of the real roots of an integer polynomial, on a dyadic grid.

FLINT encloses all complex roots of a squarefree integer polynomial rigorously and tells the real ones (a real root
comes back with imaginary part exactly 0). From the enclosures the grid cell of each root is decided exactly, so that
the intervals depend on the polynomial alone, not on a precision.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any, cast

from flint import acb, arb, arb_poly, fmpq, fmpz, fmpz_poly

from pkm_exact.errors import InternalContradictionError
from pkm_exact.failures.contradiction import require
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

COARSEST_EXPONENT = 32
"""Intervals are at most 2^-32 wide."""
NEAR_BITS = 128
"""Beyond those that balls shall have: values near roots lose them."""
MOST_COMPLEX_ROOTS = 64
"""Degree up to which all complex roots are enclosed; it takes the time of the degree's third power, or more."""


@dataclass(frozen=True)
class RealRoot:
    """The cell [cell, cell + 1] / 2^exponent of a real root, or the root itself if ``is_exact`` (cell / 2^exponent)."""

    cell: int
    exponent: int
    is_exact: bool

    @property
    def lo(self) -> Fraction:
        """Lower end."""
        return Fraction(self.cell, 1 << self.exponent)

    @property
    def hi(self) -> Fraction:
        """Upper end."""
        return Fraction(self.cell + (not self.is_exact), 1 << self.exponent)


def real_root_enclosures(polynomial: fmpz_poly, precision: int) -> list[arb]:
    """One ball around each real root of a squarefree polynomial, increasing, with about ``precision`` accurate bits."""
    with working_precision(precision):
        pairs = cast("list[tuple[acb, int]]", polynomial.complex_roots())
        roots = [root.real for root, _ in pairs if root.imag == 0]
        above = sum(1 for root, _ in pairs if root.imag > 0)
    degree = int(polynomial.degree())
    require(len(roots) + 2 * above == degree, "roots are missing", real=len(roots), above=above, degree=degree)
    return sorted(roots, key=lambda ball: _midpoint(ball))


def refined_enclosures(polynomial: fmpz_poly, enclosures: Sequence[arb], precision: int) -> list[arb] | None:
    """Balls around the same simple roots with about ``precision`` accurate bits, by Newton's operator, or None.

    If a ball X with middle m has a root and the derivative no zero in it, the root lies in m - f(m) / f'(X).

    Examples
    --------
    >>> rough = real_root_enclosures(fmpz_poly([-2, 0, 1]), 30)
    >>> [ball.rel_accuracy_bits() > 190 for ball in refined_enclosures(fmpz_poly([-2, 0, 1]), rough, 200)]
    [True, True]
    """
    with working_precision(precision + 16):
        value, slope = arb_poly(polynomial), arb_poly(polynomial.derivative())
        found = []
        for given in enclosures:
            ball = given
            while ball.rad() and ball.rel_accuracy_bits() < precision:
                middle = ball.mid()
                smaller = middle - value(middle) / slope(ball)
                if not 2 * smaller.rad() < ball.rad():
                    return None
                ball = smaller
            found.append(ball)
    return found


def enclosures_near(polynomial: fmpz_poly, near: Sequence[arb | acb], precision: int) -> list[arb] | None:
    """One ball around each real root of a polynomial f, increasing, if numbers near all roots are given; or None.

    The disc around z of radius n |f(z) / f'(z)| has a root, n the degree (Laguerre). So n disjoint discs have one each.
    That in a disc around a real number is real, as its conjugate lies in the same disc.

    Parameters
    ----------
    polynomial : fmpz_poly
    near : sequence of arb and acb
        Real numbers, and of two conjugate ones one.
    precision : int

    Examples
    --------
    >>> h, root = fmpz_poly([-2, 0, 1]), arb(2).sqrt()
    >>> len(enclosures_near(h, [root, -root], 40)), enclosures_near(h, [root, root], 40)
    (2, None)
    """
    degree = int(polynomial.degree())
    real = [value for value in near if isinstance(value, arb)]
    if not near or 2 * len(near) - len(real) != degree:
        return None
    with working_precision(precision + NEAR_BITS):
        value, slope = arb_poly(polynomial), arb_poly(polynomial.derivative())
        discs: list[Any] = []
        for given in (*real, *(value for value in near if isinstance(value, acb))):
            exact: Any = given
            middle = (+exact).mid()
            radius = arb(0, (degree * value(middle) / slope(middle)).abs_upper())
            discs.append(middle + radius if isinstance(middle, arb) else middle + acb(radius, radius))
    above = discs[len(real) :]
    if not all(disc.is_finite() for disc in discs) or any(disc.imag.contains(0) for disc in above):
        return None
    # A disc around a real number reaches beyond the real line, perhaps as far as to one of those above it.
    plane = [acb(disc, disc - disc.mid()) for disc in discs[: len(real)]] + above
    if any(one.overlaps(other) for one, other in combinations(plane, 2)):
        return None
    return sorted(discs[: len(real)], key=_midpoint)


def isolate_real_roots(polynomial: fmpz_poly) -> tuple[RealRoot, ...]:
    """The real roots of a squarefree polynomial, increasing, in cells of the coarsest grid that separates them.

    Examples
    --------
    >>> [(root.lo, root.hi) for root in isolate_real_roots(fmpz_poly([0, -1, 4]))]
    [(Fraction(0, 1), Fraction(0, 1)), (Fraction(1, 4), Fraction(1, 4))]
    """
    return tuple(root for root, _ in isolated_and_enclosed(polynomial))


def isolated_and_enclosed(polynomial: fmpz_poly, near: Sequence[arb | acb] = ()) -> tuple[tuple[RealRoot, arb], ...]:
    """The same, each with a ball around it that has about as many bits as were needed.

    Numbers ``near`` all roots, as ``enclosures_near`` has them, save time if they are.
    """
    precision = 256
    exponent = COARSEST_EXPONENT
    known = enclosures_near(polynomial, near, precision)
    enclosures = _enclosures(polynomial, precision) if known is None else known
    while True:
        cells = [_cell(polynomial, ball, exponent) for ball in enclosures]
        if None in cells:
            precision *= 2
            enclosures = _enclosures(polynomial, precision)
            continue
        roots = tuple(RealRoot(cell[0], exponent, cell[1]) for cell in cells if cell is not None)
        if all(
            left.hi < right.lo or (left.hi == right.lo and not (left.is_exact or right.is_exact))
            for left, right in pairwise(roots)
        ):
            break
        exponent += 1
    for root in roots:
        if not _is_isolating(polynomial, root):
            raise InternalContradictionError("an enclosure of a real root is not confirmed by a change of sign")
    return tuple(zip(roots, enclosures, strict=True))


def _enclosures(polynomial: fmpz_poly, precision: int) -> list[arb]:
    """One ball around each real root, increasing: by all complex roots, or where these are many by Descartes' rule."""
    found = None
    if is_counted_once(polynomial):
        from pkm_exact.roots.sign_changes import descartes_enclosures

        found = descartes_enclosures(polynomial, precision // 2)
    return real_root_enclosures(polynomial, precision) if found is None else found


def is_counted_once(polynomial: fmpz_poly) -> bool:
    """Whether Descartes' rule finds the roots, as the degree is great; otherwise it counts them a second time."""
    return bool(polynomial.degree() > MOST_COMPLEX_ROOTS)


def _cell(polynomial: fmpz_poly, ball: arb, exponent: int) -> tuple[int, bool] | None:
    """Cell of the root and whether it is the cell's lower end exactly; None if the ball is too wide to tell."""
    low, high = _scaled_ends(ball, exponent)
    first, last = low.__floor__(), high.__floor__()
    if last - first > 1:
        return None
    for candidate in {first, last}:
        if low <= candidate <= high and polynomial(fmpq(candidate, fmpz(1) << exponent)) == 0:
            return candidate, True
    return (first, False) if first == last else None


def _scaled_ends(ball: arb, exponent: int) -> tuple[Fraction, Fraction]:
    """Exact ends of a ball, times 2^exponent."""
    middle = _midpoint(ball)
    mantissa, power = ball.rad().man_exp()
    radius = Fraction(int(mantissa)) * Fraction(2) ** int(power)
    scale = 1 << exponent
    return (middle - radius) * scale, (middle + radius) * scale


def _midpoint(ball: arb) -> Fraction:
    mantissa, power = ball.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(power)


def _is_isolating(polynomial: fmpz_poly, root: RealRoot) -> bool:
    values = [polynomial(fmpq(end.numerator, end.denominator)) for end in (root.lo, root.hi)]
    return values[0] == 0 if root.is_exact else values[0] * values[1] < 0


def has_root(polynomial: fmpz_poly, interval: Interval) -> bool:
    """Whether a squarefree polynomial has a root in a closed interval that is known to hold at most one.

    Examples
    --------
    >>> has_root(fmpz_poly([-2, 0, 1]), Interval(Fraction(1), Fraction(2)))
    True
    """
    low, high = (polynomial(fmpq(end.numerator, end.denominator)) for end in (interval.lo, interval.hi))
    return bool(low == 0 or high == 0 or low * high < 0)

"""Coefficients of a univariate representation from refined solutions, in fixed point: integers times 2^-place.

With t the values of the separating form, h = prod (T - t), and the numerators over h' are n_i = sum x_i h / (T - t).
Real solutions give factors of degree 1, conjugate pairs of degree 2; two at a time are joined.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from flint import arb, fmpz, fmpz_poly

from pkm_exact.geometry.study import Quadric
from pkm_exact.numeric.refined_solutions import Point, RefinedSolutions
from pkm_exact.precision import working_precision

BOUNDARY: Final = arb(2) ** -64
"""Where N(e) is a smaller part of its terms than this, a solution is taken for one on the boundary of rigid motions."""


@dataclass(frozen=True, eq=False)
class RootFactor:
    """A monic factor of h and, of some coordinates, the numerators over its derivative; times 2^place.

    Attributes
    ----------
    degree : int
    relation : fmpz_poly
        The factor without its leading term.
    numerators : list of fmpz_poly
    """

    degree: int
    relation: fmpz_poly
    numerators: list[fmpz_poly]

    def times(self, other: RootFactor, place: int) -> RootFactor:
        """The product. Leading terms only shift what they are multiplied with."""
        pairs = zip(self.numerators, other.numerators, strict=True)
        return RootFactor(
            self.degree + other.degree,
            self._product(self.relation, other, place) + other.relation.left_shift(self.degree),
            [self._product(m, other, place, n) + n.left_shift(self.degree) for m, n in pairs],
        )

    def _product(self, left: fmpz_poly, other: RootFactor, place: int, right: fmpz_poly | None = None) -> fmpz_poly:
        """A polynomial by the other factor, but for what ``right`` takes of this one's leading term."""
        low = left * other.relation
        if right is not None:
            low += right * self.relation
        return fmpz_poly([value >> place for value in low.coeffs()]) + left.left_shift(other.degree)


def root_factors(
    solutions: RefinedSolutions, form: Sequence[int], wanted: Sequence[int], place: int
) -> list[RootFactor]:
    """T - t of each real solution, T^2 - 2 Re(t) T + |t|^2 of each pair, with the numerators of some coordinates."""
    factors = []
    with working_precision(2 * place):  # exact but for the division by powers of 2
        for x in solutions.points[: solutions.count]:
            numerators = [fmpz_poly([fixed(x[k], place)]) for k in wanted]
            factors.append(RootFactor(1, fmpz_poly([fixed(-value_of(form, x), place)]), numerators))
        for x in solutions.points[solutions.count :]:
            t = value_of(form, x)
            relation = [fixed(t.real * t.real + t.imag * t.imag, place), fixed(-2 * t.real, place)]
            numerators = []
            for k in wanted:
                product = x[k].real * t.real + x[k].imag * t.imag
                numerators.append(fmpz_poly([fixed(-2 * product, place), fixed(2 * x[k].real, place)]))
            factors.append(RootFactor(2, fmpz_poly(relation), numerators))
    return factors


def joined(factors: Sequence[RootFactor], place: int) -> RootFactor:
    """The product of all."""
    while len(factors) > 1:
        pairs = zip(factors[::2], factors[1::2], strict=False)
        rest = factors[len(factors) - len(factors) % 2 :]
        factors = [*(a.times(b, place) for a, b in pairs), *rest]
    return factors[0]


def padded(polynomial: fmpz_poly, size: int) -> list[fmpz]:
    """Coefficients, lowest degree first, with zeros up to the given number."""
    values = polynomial.coeffs()
    return values + [fmpz(0)] * (size - len(values))


def leading_coefficients(
    solutions: RefinedSolutions, form: Sequence[int], wanted: Sequence[int], second: fmpz, place: int
) -> list[fmpz]:
    """The first two coefficients of some numerators, given the second of h: sums over the solutions, times 2^place."""
    found = []
    with working_precision(2 * place):
        values = [value_of(form, x) for x in solutions.points]
        for k in wanted:
            first, last = arb(0), arb(0)
            for number, (x, t) in enumerate(zip(solutions.points, values, strict=True)):
                if number < solutions.count:
                    first, last = first + x[k], last + x[k] * t
                else:
                    first, last = first + 2 * x[k].real, last + 2 * (x[k] * t).real
            found += [fixed(first, place), fixed(last, place) + (fixed(first, place) * second >> place)]
    return found


def root_of_norms(solutions: RefinedSolutions, norm: Quadric, bits: int) -> arb | None:
    """The square root of the product of N(e) over all solutions, with about so many bits.

    None if some N(e) is 0 but for roundings: of points on the boundary of the rigid motions.
    """
    product = arb(1)
    with working_precision(bits):
        for number, point in enumerate(solutions.points):
            x = solutions.equations.coordinates(point)
            value = sum(coefficient * (x[k] * x[m]) for (k, m), coefficient in norm.items())
            if not abs(value) > sum(coefficient * abs(x[k] * x[m]) for (k, m), coefficient in norm.items()) * BOUNDARY:
                return None
            product *= value if number < solutions.count else value.real * value.real + value.imag * value.imag
        return product.sqrt()


def value_of(form: Sequence[int], x: Point) -> arb:
    """The value of a form on the free coordinates."""
    return sum((c * value for c, value in zip(form, x, strict=True) if c), arb(0))


def fixed(value: arb, place: int) -> fmpz:
    """The middle of a ball, times 2^place."""
    mantissa, exponent = value.mid().man_exp()
    shift = int(exponent) + place
    return mantissa << shift if shift >= 0 else mantissa >> -shift

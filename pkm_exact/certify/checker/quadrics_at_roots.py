"""Whether quadrics in the numerators (E, F) vanish at every root of the eliminant: by values at integers. All exact.

Let h0 be primitive of degree D, E and F of smaller degree, V = Q(E, F) with a quadric Q over Z. V has degree 2 D - 2 at
most. If h0 divides V over Q, it does so over Z (Gauss), and the quotient q has degree D - 2 at most: at every integer x
that is no root, h0(x) divides V(x), and the differences of order D - 1 of the quotients at integers in a row are 0. If
so at 2 D - 1 integers, the quotients are values of a polynomial q over Q of degree D - 2 at most; V - q h0 has degree
2 D - 2 at most and 2 D - 1 zeros: h0 divides V. Products of numbers at these take less time than those of polynomials.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from operator import mul

from flint import fmpz, fmpz_mat, fmpz_poly

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER


@dataclass(frozen=True)
class Values:
    """Of a polynomial, at integers in a row: a ring, where sums and multiples are those of polynomials.

    Attributes
    ----------
    packed : fmpz_poly
        With the values as its coefficients.
    """

    packed: fmpz_poly

    @cached_property
    def listed(self) -> list[fmpz]:
        """The values, but for some that are 0 at the end."""
        return self.packed.coeffs()

    def __add__(self, other: Values) -> Values:
        return Values(self.packed + other.packed)

    def __sub__(self, other: Values) -> Values:
        return Values(self.packed - other.packed)

    def __mul__(self, other: Values) -> Values:
        # Where one of them has no coefficients left, the values are 0.
        return Values(fmpz_poly([*map(mul, self.listed, other.listed)]))

    def __rmul__(self, scalar: int) -> Values:
        return Values(scalar * self.packed)


def values_at(places: range, polynomial: fmpz_poly) -> Values:
    """The values of a polynomial at some integers."""
    charge(len(places) * _value_cost(places, polynomial))
    return Values(fmpz_poly([polynomial(place) for place in places]))


def integers_beside(h0: fmpz_poly) -> tuple[range, Values]:
    """2 D - 1 integers in a row, none a root of h0, whose degree is D, and the values of h0 there.

    Of the rows that are tried no two have an integer in common: D at most have a root.
    """
    size = int(h0.degree())
    places = range(-size, size - 1)
    while True:
        charge(len(places) * _value_cost(places, h0))
        values = [h0(place) for place in places]
        if all(values):
            return places, Values(fmpz_poly(values))
        places = range(places.stop, places.stop + len(places))


def are_multiples(values: Sequence[Values], divisors: Values) -> list[bool]:
    """Which polynomials of degree 2 D - 2 at most, with these values, h0 divides, whose own are the divisors."""
    charge(sum(_division_cost(row, divisors) for row in values))
    divided = [[*map(divmod, row.listed, divisors.listed)] for row in values]
    zeros = [0] * len(divisors.listed)
    quotients = fmpz_mat([([quotient for quotient, _ in row] + zeros)[: len(zeros)] for row in divided])
    differences = (quotients * _differences(len(zeros) // 2)).tolist()
    return [not any(rest for _, rest in row) and not any(left) for row, left in zip(divided, differences, strict=True)]


@lru_cache(maxsize=GREATEST_NUMBER)
def _differences(order: int) -> fmpz_mat:
    """What the values at 2 k + 1 integers in a row are multiplied by to become their differences of order k."""
    signed = [int(value) for value in (fmpz_poly([1, -1]) ** order).coeffs()]
    columns = [[0] * place + signed + [0] * (order - place) for place in range(order + 1)]
    return fmpz_mat([*map(list, zip(*columns, strict=True))])


def _value_cost(places: range, polynomial: fmpz_poly) -> int:
    """Operations for a value of a polynomial."""
    terms, place = int(polynomial.length()), max(abs(places[0]), abs(places[-1]))
    words = limbs(int(polynomial.height_bits()) + terms * place.bit_length())
    return 500 + terms * (100 + 4 * words)


def _division_cost(values: Values, divisors: Values) -> int:
    """Operations for the quotients of all values and their differences."""
    words = _words([values, divisors])
    number = len(divisors.packed)
    return 10**5 + number * (2 * _product_cost(words) + number * (100 + 2 * words))


def quadrics_cost(numerators: Sequence[Values], forms: Sequence[Sequence[int]], common: int) -> int:
    """Operations for the values of a motion's quantities, from those of (E, F), and of forms in them at (common E, F).

    The numbers in the quantities count as one of the forms.
    """
    words = _words(numerators)
    scalar = limbs(max(abs(value).bit_length() for form in forms for value in form))
    multiple = 100 + 2 * (2 * words + scalar) * scalar
    longest = 2 * words + scalar + limbs(common.bit_length())
    products = 30 * _product_cost(words) + 2 * len(forms) * _product_cost(longest)
    return 2 * 10**6 + max(len(value.packed) for value in numerators) * (products + (80 + 20 * len(forms)) * multiple)


def _words(values: Sequence[Values]) -> int:
    return limbs(max(int(value.packed.height_bits()) for value in values))


def _product_cost(words: int) -> int:
    """Operations for a product of numbers of so many words."""
    return 1000 + 20 * words * words.bit_length()

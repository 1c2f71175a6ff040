"""Rational univariate representations over Q, and their exact verification."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce
from math import gcd

from flint import acb, arb, fmpz, fmpz_poly, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.digests import digest


@dataclass(frozen=True)
class UnivariateRepresentation:
    """All solutions at once: x_i = n_i(t) / h'(t) at the roots t of a squarefree h.

    Attributes
    ----------
    form : tuple of int
        Coefficients c_i of the separating form: t = sum c_i x_i.
    eliminant : tuple of int
        h, lowest degree first, leading coefficient positive.
    numerators : tuple of tuple of int
        The n_i. All coefficients of h and of the n_i together have greatest common divisor 1.
    near : sequence of arb and acb
        Numbers near the roots, real for real ones, one of each conjugate pair of the others: not proved, and often not
        known.

    Examples
    --------
    >>> golden = UnivariateRepresentation((1,), (-1, -1, 1), ((2, 1),))
    >>> golden.degree
    2
    """

    form: tuple[int, ...]
    eliminant: tuple[int, ...]
    numerators: tuple[tuple[int, ...], ...]
    near: Sequence[arb | acb] = field(default=(), repr=False, compare=False)

    def __getstate__(self) -> dict[str, object]:
        """For copies and other processes: without FLINT's numbers, which are made again when they are needed."""
        return {name: self.__dict__[name] for name in self.__dataclass_fields__} | {"near": ()}

    @property
    def degree(self) -> int:
        """Number of distinct solutions."""
        return len(self.eliminant) - 1

    @property
    def bits(self) -> int:
        """Size of the largest coefficient of h."""
        return max(abs(value).bit_length() for value in self.eliminant)

    @cached_property
    def polynomial(self) -> fmpz_poly:
        """h as a FLINT polynomial."""
        return fmpz_poly(list(self.eliminant))

    @cached_property
    def primitive_polynomial(self) -> fmpz_poly:
        """h divided by its content: what divides in Z[T] exactly if h divides in Q[T]."""
        content = self.polynomial.content()
        return fmpz_poly([value // content for value in self.polynomial.coeffs()])

    @cached_property
    def numerator_polynomials(self) -> tuple[fmpz_poly, ...]:
        """The n_i as FLINT polynomials."""
        return tuple(fmpz_poly(list(numerator)) for numerator in self.numerators)

    def vanishes(self, value: fmpz_poly) -> bool:
        """Whether a polynomial in T is 0 at every root of h (h squarefree)."""
        return bool(divmod(value, self.primitive_polynomial)[1].is_zero())

    @property
    def is_separated(self) -> bool:
        """Whether the form takes the value t at every root: then distinct roots are distinct solutions."""
        combined = fmpz_poly([0, -1]) * self.polynomial.derivative()
        for coefficient, numerator in zip(self.form, self.numerator_polynomials, strict=True):
            combined += coefficient * numerator
        return self.vanishes(combined)

    @property
    def is_squarefree(self) -> bool:
        """Whether h has no multiple root."""
        return are_coprime(self.primitive_polynomial, self.primitive_polynomial.derivative())


def are_coprime(left: fmpz_poly, right: fmpz_poly) -> bool:
    """Whether two integer polynomials have no common complex root.

    Coprime images modulo a prime that does not divide the leading coefficient of ``left`` prove it; only if the images
    have a factor in common is the greatest common divisor over Q computed.

    Examples
    --------
    >>> are_coprime(fmpz_poly([-1, 0, 1]), fmpz_poly([2, 1])), are_coprime(fmpz_poly([-1, 0, 1]), fmpz_poly([1, 1]))
    (True, False)
    """
    usable = primes_from(digest(map(int, left.coeffs())), 62)
    prime = next(prime for prime in usable if int(left.leading_coefficient()) % prime)
    images = [nmod_poly([int(value) % prime for value in polynomial.coeffs()], prime) for polynomial in (left, right)]
    return int(images[0].gcd(images[1]).degree()) == 0 or int(left.gcd(right).degree()) == 0


def from_common_fractions(
    form: Sequence[int],
    eliminant: Sequence[int | fmpz],
    denominator: int,
    numerators: Sequence[Sequence[int | fmpz]],
    scale: int,
) -> UnivariateRepresentation:
    """The representation with h = eliminant / denominator and n_i = numerators_i / scale, made jointly primitive."""
    common = denominator * scale // gcd(denominator, scale)
    h = fmpz_poly([*eliminant]) * (common // denominator)
    polynomials = [fmpz_poly([*numerator]) * (common // scale) for numerator in numerators]
    content = reduce(fmpz.gcd, (polynomial.content() for polynomial in polynomials), h.content())
    lists = [tuple(int(value // content) for value in each.coeffs()) for each in (h, *polynomials)]
    return UnivariateRepresentation(tuple(form), lists[0], tuple(lists[1:]))


def union(parts: Sequence[UnivariateRepresentation]) -> UnivariateRepresentation:
    """The representation of all the solutions of several, which have no value of the common form in common.

    With h the product of the h_k, the numerators are sum_k n_k prod_{j != k} h_j.
    """
    combined = parts[0]
    for part in parts[1:]:
        left, right = combined.polynomial, part.polynomial
        numerators = [
            a * right + b * left
            for a, b in zip(combined.numerator_polynomials, part.numerator_polynomials, strict=True)
        ]
        lists = [[int(value) for value in numerator.coeffs()] for numerator in numerators]
        h = [int(value) for value in (left * right).coeffs()]
        combined = from_common_fractions(combined.form, h, 1, lists, 1)
    return combined

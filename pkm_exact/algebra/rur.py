"""Rational univariate representations modulo a prime, from the trace form.

For a separating form T with distinct values t_1..t_d on the zeros, and multiplicities m_i,

    h(T) = prod (T - t_i),     g_x(T) = sum_i m_i x(i) prod_{j != i} (T - t_j),

so that x(i) = g_x(t_i) / g_1(t_i) for every coordinate x (Rouillier, "Solving zero-dimensional systems through the
rational univariate representation", AAECC 9, 1999). The g_x come from the traces of x T^k.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import nmod_mat, nmod_poly

from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.quotient import QuotientAlgebra
from pkm_exact.algebra.representation import UnivariateRepresentation


@dataclass(frozen=True)
class ModularRepresentation:
    """A rational univariate representation modulo a prime.

    Attributes
    ----------
    eliminant : nmod_poly
        h, monic and squarefree.
    denominator : nmod_poly
        g_1, coprime to h.
    numerators : tuple of nmod_poly
        g_x for every coordinate x.
    """

    eliminant: nmod_poly
    denominator: nmod_poly
    numerators: tuple[nmod_poly, ...]

    @property
    def degree(self) -> int:
        """Number of distinct solutions."""
        return int(self.eliminant.degree())

    @property
    def is_simple(self) -> bool:
        """Whether all solutions have the same multiplicity: g_1 is a constant times h'."""
        derivative = self.eliminant.derivative()
        scale = self.denominator.leading_coefficient() / derivative.leading_coefficient()
        return bool(self.denominator == derivative * scale)

    def parts(self, fibre: int = 1) -> dict[int, ModularRepresentation]:
        """The solutions of each multiplicity by themselves, multiplicities in multiples of ``fibre``.

        Raises
        ------
        UnluckyPrimeError
            If a multiplicity is none.
        """
        derivative = self.eliminant.derivative()
        multiplicity = self.denominator * derivative.xgcd(self.eliminant)[1] % self.eliminant
        found: dict[int, ModularRepresentation] = {}
        rest, count = self.eliminant, 1
        total = int(self.denominator[self.degree - 1])
        while rest.degree() > 0:
            if count * fibre > total:
                raise UnluckyPrimeError(f"solutions have no multiplicity in multiples of {fibre}")
            part = rest.gcd(multiplicity - count * fibre)
            if part.degree() > 0:
                part = part / part.leading_coefficient()
                rest = rest // part
                slope = part.derivative()
                numerators = tuple(coordinate * slope % part for coordinate in self.shape())
                found[count] = ModularRepresentation(part, slope, numerators)
            count += 1
        return found

    def shape(self) -> tuple[nmod_poly, ...]:
        """The coordinates as polynomials in T modulo h: g_x / g_1."""
        inverse = self.denominator.xgcd(self.eliminant)[1]
        return tuple(numerator * inverse % self.eliminant for numerator in self.numerators)

    def is_image_of(self, lifted: UnivariateRepresentation) -> bool:
        """Whether it is a representation over Q modulo the prime; no if that has no image with as many solutions."""
        prime = self.eliminant.modulus()
        h = nmod_poly(lifted.polynomial, prime)
        if h.degree() != lifted.degree or h != self.eliminant * h.leading_coefficient():
            return False
        slope = h.derivative()
        return all(
            ((nmod_poly(numerator, prime) * self.denominator - own * slope) % h).degree() < 0
            for numerator, own in zip(lifted.numerator_polynomials, self.numerators, strict=True)
        )


def squarefree_part(polynomial: nmod_poly) -> nmod_poly:
    """Monic polynomial with the same zeros, each once (characteristic above the degree)."""
    part = polynomial // polynomial.gcd(polynomial.derivative())
    return part / part.leading_coefficient()


def distinct_values(algebra: QuotientAlgebra, form: nmod_mat) -> int:
    """Number of distinct values of an element on the zeros."""
    return int(squarefree_part(algebra.matrix(form).charpoly()).degree())


def modular_representation(
    algebra: QuotientAlgebra, form: nmod_mat, coordinates: Sequence[nmod_mat]
) -> ModularRepresentation:
    """The representation of the given coordinates by the values of ``form``.

    Whether ``form`` separates the zeros is for the caller to test, by the degree of the eliminant.
    """
    matrix = algebra.matrix(form)
    eliminant = squarefree_part(matrix.charpoly())
    degree = int(eliminant.degree())
    weighted = [algebra.trace] + [algebra.matrix(coordinate) * algebra.trace for coordinate in coordinates]
    powers = [algebra.one]
    for _ in range(degree - 1):
        powers.append(powers[-1] * matrix)
    numerators = []
    for column in weighted:
        traces = [(power * column)[0, 0] for power in powers]
        series = nmod_poly([int(value) for value in reversed(traces)], algebra.prime)
        numerators.append((eliminant * series).right_shift(degree))
    return ModularRepresentation(eliminant, numerators[0], tuple(numerators[1:]))

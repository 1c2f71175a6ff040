"""A polynomial system as square equations for Newton lifting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from flint import fmpz_mod_poly, fmpz_mpoly, fmpz_poly

from pkm_exact.algebra.residue_ring import ResidueRing, integer_polynomial
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring


@dataclass(frozen=True)
class SystemEquations:
    """Random combinations of a system's polynomials, as many as there are unknowns.

    Solutions of the system are solutions of the combinations; a simple one stays simple for all but few choices.

    Attributes
    ----------
    system : PolynomialSystem
    seed : int
        Seed of the combinations.
    """

    system: PolynomialSystem
    seed: int

    @cached_property
    def combinations(self) -> tuple[fmpz_mpoly, ...]:
        """The square system."""
        random = Random(self.seed)
        context = polynomial_ring(self.system.unknowns)
        combined = []
        for _ in self.system.unknowns:
            total = context.constant(0)
            for polynomial in self.system.polynomials:
                total += random.randrange(-(1 << 16), 1 << 16) * polynomial
            combined.append(total)
        return tuple(combined)

    @cached_property
    def derivatives(self) -> tuple[tuple[fmpz_mpoly, ...], ...]:
        """Partial derivatives of the square system."""
        size = len(self.system.unknowns)
        return tuple(tuple(polynomial.derivative(j) for j in range(size)) for polynomial in self.combinations)

    def values(self, ring: ResidueRing, point: Sequence[fmpz_poly]) -> list[fmpz_poly]:
        """The square system at a point."""
        values = PointProducts(ring, [ring.polynomials(coordinate) for coordinate in point])
        return [integer_polynomial(values.evaluate(polynomial)) for polynomial in self.combinations]

    def combined(self, values: list[fmpz_mod_poly]) -> list[fmpz_mod_poly]:
        """The values themselves."""
        return values

    def jacobian(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> list[list[fmpz_mod_poly]]:
        """The Jacobian matrix at a point."""
        values = PointProducts(ring, point)
        return [[values.evaluate(polynomial) for polynomial in row] for row in self.derivatives]

    def completion(self, form: Sequence[int]) -> None:  # noqa: ARG002  # the protocol names it
        """None: no coordinates are known to follow from others."""
        return


class PointProducts:
    """Monomials at a point of a residue ring, each multiplied out once."""

    def __init__(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> None:
        self.ring = ring
        self.point = point
        self.known: dict[tuple[int, ...], fmpz_mod_poly] = {(0,) * len(point): ring.one}
        self.integral: dict[tuple[int, ...], fmpz_poly] = {}
        self.products: dict[tuple[int, ...], fmpz_poly] = {}

    def value(self, polynomial: fmpz_mpoly) -> fmpz_mod_poly:
        """A polynomial with small coefficients at the point, summed over Z and reduced once."""
        total = fmpz_poly()
        for exponents, coefficient in polynomial.to_dict().items():
            total += self.product(tuple(map(int, exponents))) * int(coefficient)
        return self.ring.reduce(self.ring.polynomials(total))

    def product(self, exponents: tuple[int, ...]) -> fmpz_poly:
        """A monomial at the point, as the product over Z of its two halves."""
        if exponents not in self.products:
            first, left = [0] * len(exponents), sum(exponents) // 2
            for index, exponent in enumerate(exponents):
                first[index] = min(exponent, left)
                left -= first[index]
            rest = tuple(a - b for a, b in zip(exponents, first, strict=True))
            self.products[exponents] = self.half(rest) * self.half(tuple(first)) if any(first) else self.half(rest)
        return self.products[exponents]

    def half(self, exponents: tuple[int, ...]) -> fmpz_poly:
        """A monomial at the point, reduced, as a polynomial over Z."""
        if exponents not in self.integral:
            if sum(exponents) > 1:
                self.known[exponents] = self.ring.reduce(self.ring.polynomials(self.product(exponents)))
            self.integral[exponents] = integer_polynomial(self.monomial(exponents))
        return self.integral[exponents]

    def evaluate(self, polynomial: fmpz_mpoly) -> fmpz_mod_poly:
        """A polynomial at the point."""
        total = self.ring.one * 0
        for exponents, coefficient in polynomial.to_dict().items():
            total += self.monomial(tuple(map(int, exponents))) * int(coefficient)
        return total

    def monomial(self, exponents: tuple[int, ...]) -> fmpz_mod_poly:
        """A monomial at the point."""
        if exponents not in self.known:
            index = next(i for i, exponent in enumerate(exponents) if exponent)
            smaller = (*exponents[:index], exponents[index] - 1, *exponents[index + 1 :])
            self.known[exponents] = self.ring.multiply(self.monomial(smaller), self.point[index])
        return self.known[exponents]

"""A polynomial system as square equations for Newton lifting: its polynomials evaluated, then combined at random.

Combinations of the values serve as well as those of the polynomials, which would lose their few terms.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from flint import fmpz_mod_poly, fmpz_mpoly, fmpz_poly

from pkm_exact.algebra.equations import PointProducts
from pkm_exact.algebra.residue_ring import ResidueRing, combination, integer_polynomial
from pkm_exact.algebra.system import PolynomialSystem

_LARGEST_WEIGHT = 1 << 16


@dataclass(frozen=True)
class MixedEquations:
    """As many combinations of a system's values as there are unknowns (``algebra.newton.Equations``).

    Attributes
    ----------
    system : PolynomialSystem
    seed : int
        Of the combinations. With nearly all of them a simple solution stays simple.
    """

    system: PolynomialSystem
    seed: int

    @cached_property
    def weights(self) -> tuple[tuple[int, ...], ...]:
        """One row for each equation."""
        random = Random(self.seed)
        count = len(self.system.polynomials)
        return tuple(tuple(random.randrange(1, _LARGEST_WEIGHT) for _ in range(count)) for _ in self.system.unknowns)

    @cached_property
    def derivatives(self) -> tuple[tuple[fmpz_mpoly, ...], ...]:
        """Partial derivatives of the polynomials."""
        size = len(self.system.unknowns)
        return tuple(tuple(polynomial.derivative(j) for j in range(size)) for polynomial in self.system.polynomials)

    def values(self, ring: ResidueRing, point: Sequence[fmpz_poly]) -> list[fmpz_poly]:
        """The left-hand sides at a point."""
        products = PointProducts(ring, [ring.polynomials(coordinate) for coordinate in point])
        values = [products.value(polynomial) for polynomial in self.system.polynomials]
        return [integer_polynomial(combination(row, values)) for row in self.weights]

    def combined(self, values: list[fmpz_mod_poly]) -> list[fmpz_mod_poly]:
        """The values themselves."""
        return values

    def jacobian(self, ring: ResidueRing, point: Sequence[fmpz_mod_poly]) -> list[list[fmpz_mod_poly]]:
        """The Jacobian matrix at a point."""
        products = PointProducts(ring, point)
        columns = [[products.evaluate(row[j]) for row in self.derivatives] for j in range(len(self.system.unknowns))]
        return [[combination(row, column) for column in columns] for row in self.weights]

    def completion(self, form: Sequence[int]) -> None:  # noqa: ARG002  # the protocol names it
        """None: no coordinates are known to follow from others."""
        return

"""p-adic Newton lifting of a univariate representation, all solutions at once.

Given q and x_1..x_n modulo p^k with F(x) = 0 and sum c_i x_i = T modulo q, one step doubles k: solve
J(x) d = F(x) modulo q, replace x by x - d, and move the parameter so that the form is T again (Giusti, Lecerf and
Salvy, "A Groebner free alternative for polynomial system solving", J. Complexity 17, 2001). It needs simple solutions:
the Jacobian must be a unit modulo q and p. What is reconstructed from the limit is verified over Q elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, count, zip_longest
from typing import Protocol

from flint import fmpz, fmpz_mod_poly, fmpz_poly, nmod_poly

from pkm_exact.algebra.completion import Completion
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.residue_ring import ResidueRing, coefficients, combination, integer_polynomial

Element = fmpz_mod_poly


class Equations(Protocol):
    """n equations in n unknowns that can be evaluated in a residue ring."""

    def values(self, ring: ResidueRing, point: Sequence[fmpz_poly]) -> list[fmpz_poly]:
        """Left-hand sides at a point, as polynomials over Z, reduced or not."""
        ...

    def combined(self, values: list[Element]) -> list[Element]:
        """The combinations of them that are solved: as many as there are unknowns."""
        ...

    def jacobian(self, ring: ResidueRing, point: Sequence[Element]) -> list[list[Element]]:
        """The matrix of partial derivatives at a point, reduced; every leading principal minor a unit."""
        ...

    def completion(self, form: Sequence[int]) -> Completion | None:
        """A way from the first coordinates to all, if there is one for the separating form."""
        ...


@dataclass(frozen=True)
class PadicRepresentation:
    """q and the coordinates as polynomials modulo q, with coefficients in [0, ``modulus``)."""

    modulus: int
    relation: fmpz_poly
    point: tuple[fmpz_poly, ...]

    @cached_property
    def eliminant(self) -> tuple[int, ...]:
        """Coefficients of q, lowest degree first."""
        return tuple(map(int, self.relation.coeffs()))

    @cached_property
    def coordinates(self) -> tuple[tuple[int, ...], ...]:
        """Those of the coordinates."""
        return tuple(tuple(map(int, coordinate.coeffs())) for coordinate in self.point)


FACTORED = ((1, 4), (4, 12))
"""First precisions of the Jacobian, each with the last exponent it serves: a step is cheap beside a factorisation."""
STEADY = (12, 60)
"""The same, to be doubled from there on: fine steps, because what lies beyond the precision needed is wasted."""


def precision_schedule(limit: int) -> Iterator[tuple[int, int]]:
    """Exponents of p to reach, each with the precision of the factorisation that serves the step.

    The large ones are even: FLINT asks of every modulus whether it is prime, and sees at once that a square is not.

    Examples
    --------
    >>> list(precision_schedule(50))
    [(2, 1), (3, 1), (4, 1), (8, 4), (12, 4), (24, 12), (36, 12), (48, 12)]
    """
    reached = 1
    for factored, last in chain(FACTORED, ((STEADY[0] << k, STEADY[1] << k) for k in count())):
        for target in range(reached - reached % factored + factored, last + 1, factored):
            if target > limit:
                return
            yield target, factored
        reached = last


def lift(
    equations: Equations, form: Sequence[int], eliminant: nmod_poly, coordinates_mod_p: Sequence[nmod_poly], limit: int
) -> Iterator[PadicRepresentation]:
    """Representations modulo growing powers of p (``precision_schedule``).

    Parameters
    ----------
    equations : Equations
        As many as there are coordinates; they vanish at the given solutions modulo p.
    form : sequence of int
        Coefficients of the separating form on the coordinates; constant 0.
    eliminant : nmod_poly
        q modulo p, monic and squarefree.
    coordinates_mod_p : sequence of nmod_poly
        The coordinates modulo q and p.
    limit : int
        Largest exponent of p.

    Raises
    ------
    UnluckyPrimeError
        If the Jacobian is not a unit: a multiple solution, or an unlucky prime or combination of equations.
    """
    prime = int(eliminant.modulus())
    reached = PadicRepresentation(prime, _integral(eliminant), tuple(map(_integral, coordinates_mod_p)))
    before, factored = 1, 0
    quotients: list[fmpz_poly] = []
    factors: _Factors | None = None
    for target, wanted in precision_schedule(limit):
        if factors is None or wanted > factored:
            ring = ResidueRing(prime**wanted, tuple(value % prime**wanted for value in reached.eliminant))
            factors, factored = _factored_jacobian(equations, ring, reached.point, factors, prime), wanted
        step = _Step(equations, form, factors, before, reached, prime**target)
        before, reached, quotients = reached.modulus, *step.taken(quotients)
        yield reached


def _integral(polynomial: nmod_poly) -> fmpz_poly:
    return fmpz_poly([int(value) for value in polynomial.coeffs()])


def is_regular(equations: Equations, eliminant: nmod_poly, coordinates_mod_p: Sequence[nmod_poly]) -> bool:
    """Whether the Jacobian is a unit at all the given solutions modulo p.

    "Yes" proves that the solutions over Q with these images are simple and isolated; "no" may be the prime's fault.
    """
    prime = int(eliminant.modulus())
    ring = ResidueRing(prime, tuple(int(value) for value in eliminant.coeffs()))
    point = [_integral(coordinate) for coordinate in coordinates_mod_p]
    try:
        _factored_jacobian(equations, ring, point, None, prime)
    except UnluckyPrimeError:
        return False
    return True


@dataclass(frozen=True)
class _Step:
    """One Newton step to the modulus ``target``; the corrections are found in the ring of the factors.

    The equations have values F = Q q + r with r divisible by the modulus that was reached. Q modulo that which had been
    reached ``before`` is known from there, so that F - Q q is divisible by it, and the quotient has few digits to be
    divided by q.
    """

    equations: Equations
    form: Sequence[int]
    factors: _Factors
    before: int
    reached: PadicRepresentation
    target: int

    @cached_property
    def wide(self) -> ResidueRing:
        """The ring at the modulus that is wanted."""
        return ResidueRing(self.target, self.reached.eliminant)

    def taken(self, quotients: Sequence[fmpz_poly]) -> tuple[PadicRepresentation, list[fmpz_poly]]:
        """What is reached, and the quotients modulo the target."""
        ring, modulus, old = self.factors.ring, self.reached.modulus, self.reached.point
        residuals, quotients = self._residuals(quotients)
        corrections = self.factors.solve(self.equations.combined(residuals))
        # The form's value at the corrected point is T + shift; like the correction, the shift is a multiple of the old
        # modulus. Lifting the coefficients of the point has itself moved the form by such a multiple.
        value = self.wide.polynomials(combination(self.form, old) - fmpz_poly([0, 1]))
        carry = _divided(integer_polynomial(self.wide.reduce(value)), modulus, ring)
        shift = carry - combination(self.form, corrections)
        point = []
        for coordinate, correction in zip(old, corrections, strict=True):
            change = correction * -1
            if shift:
                change -= ring.multiply(ring.polynomials(coordinate).derivative(), shift)
            point.append(coordinate + modulus * integer_polynomial(change))
        relation = self.reached.relation
        if shift:
            relation += modulus * integer_polynomial(ring.multiply(ring.relation.derivative(), shift) * -1)
        return PadicRepresentation(self.target, relation, tuple(point)), quotients

    def _residuals(self, quotients: Sequence[fmpz_poly]) -> tuple[list[Element], list[fmpz_poly]]:
        """The equations' values divided by the modulus, in the ring of the factors; the quotients modulo the target."""
        relation, before, digits = self.reached.relation, self.before, self.target // self.before
        narrow = ResidueRing(digits, tuple(value % digits for value in self.reached.eliminant))
        residuals, further = [], []
        for value, quotient in zip_longest(self.equations.values(self.wide, self.reached.point), quotients):
            rest = value - quotient * relation if quotient else value
            added, residual = narrow.divided(_divided(rest, before, narrow))
            residuals.append(_divided(integer_polynomial(residual), self.reached.modulus // before, self.factors.ring))
            further.append((quotient or 0) + before * integer_polynomial(added))
        return residuals, further


def _divided(value: fmpz_poly, divisor: int, ring: ResidueRing) -> Element:
    """value / divisor, which divides it modulo the product of the divisor and the ring's modulus, in the ring."""
    exact = fmpz(divisor)
    return ring.polynomials(fmpz_poly([coefficient // exact for coefficient in value.coeffs()]))


@dataclass(frozen=True)
class _Factors:
    """An LU factorisation in a ring: lower rows, unit upper rows, and the inverses of the pivots."""

    ring: ResidueRing
    lower: list[list[Element]]
    upper: list[list[Element]]
    inverses: list[Element]

    def solve(self, right: Sequence[Element]) -> list[Element]:
        """The solution of J d = right."""
        ring, size = self.ring, len(right)
        forward: list[Element] = []
        for i in range(size):
            total = right[i]
            for k in range(i):
                total -= self.lower[i][k] * forward[k]
            forward.append(ring.multiply(ring.reduce(total), self.inverses[i]))
        backward: list[Element] = [forward[-1]] * size
        for i in range(size - 1, -1, -1):
            total = forward[i]
            for k in range(i + 1, size):
                total -= self.upper[i][k] * backward[k]
            backward[i] = ring.reduce(total)
        return backward


def _factored_jacobian(
    equations: Equations, ring: ResidueRing, point: Sequence[fmpz_poly], previous: _Factors | None, prime: int
) -> _Factors:
    """Crout's factorisation; inverses of the pivots known at a lower precision are refined, not found anew."""
    matrix = equations.jacobian(ring, [ring.polynomials(coordinate) for coordinate in point])
    size = len(matrix)
    lower = [list(row) for row in matrix]
    upper = [list(row) for row in matrix]
    pivots: list[Element] = []
    for k in range(size):
        for i in range(k, size):
            total = matrix[i][k]
            for j in range(k):
                total -= lower[i][j] * upper[j][k]
            lower[i][k] = ring.reduce(total)
        if previous is None:
            pivots.append(_inverse_modulo_prime(lower[k][k], ring, prime))
        else:
            pivots.append(_refined_inverse(lower[k][k], previous.inverses[k], previous.ring.modulus, ring))
        for j in range(k + 1, size):
            total = matrix[k][j]
            for i in range(k):
                total -= lower[k][i] * upper[i][j]
            upper[k][j] = ring.multiply(ring.reduce(total), pivots[k])
    return _Factors(ring, lower, upper, pivots)


def _refined_inverse(value: Element, start: Element, modulus: int, ring: ResidueRing) -> Element:
    inverse = ring.convert(coefficients(start))
    while modulus < ring.modulus:
        inverse += ring.multiply(inverse, ring.one - ring.multiply(value, inverse))
        modulus *= modulus
    return inverse


def _inverse_modulo_prime(value: Element, ring: ResidueRing, prime: int) -> Element:
    """The inverse in a ring of modulus ``prime``."""
    relation = nmod_poly(list(ring.relation_coefficients), prime)
    divisor, inverse, _ = nmod_poly(coefficients(value), prime).xgcd(relation)
    if divisor.degree() != 0:
        raise UnluckyPrimeError(f"the Jacobian is not a unit modulo {prime}")
    return ring.convert(int(coefficient) for coefficient in inverse.coeffs())

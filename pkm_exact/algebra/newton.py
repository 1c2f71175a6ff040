"""p-adic Newton lifting of a univariate representation, all solutions at once.

Given q and x_1..x_n modulo p^k with F(x) = 0 and sum c_i x_i = T modulo q, one step doubles k: solve
J(x) d = F(x) modulo q, replace x by x - d, and move the parameter so that the form is T again (Giusti, Lecerf and
Salvy, "A Groebner free alternative for polynomial system solving", J. Complexity 17, 2001). It needs simple solutions:
the Jacobian must be a unit modulo q and p. What is reconstructed from the limit is verified over Q elsewhere.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, count
from typing import Protocol

from flint import fmpz_mod_poly, nmod_poly

from pkm_exact.algebra.completion import Completion
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.residue_ring import ResidueRing, coefficients, combination

Element = fmpz_mod_poly


class Equations(Protocol):
    """n equations in n unknowns that can be evaluated in a residue ring."""

    def values(self, ring: ResidueRing, point: Sequence[Element]) -> list[Element]:
        """The left-hand sides at a point, reduced."""
        ...

    def jacobian(self, ring: ResidueRing, point: Sequence[Element]) -> list[list[Element]]:
        """The matrix of partial derivatives at a point, reduced; every leading principal minor a unit."""
        ...

    def completion(self, form: Sequence[int]) -> Completion | None:
        """A way from the first coordinates to all, if there is one for the separating form."""
        ...


@dataclass(frozen=True)
class PadicRepresentation:
    """q and the coordinates as polynomials modulo q, with coefficients modulo ``modulus``."""

    modulus: int
    eliminant: tuple[int, ...]
    coordinates: tuple[tuple[int, ...], ...]


FACTORED = ((1, 4), (4, 20))
"""First precisions of the Jacobian, each with the last exponent it serves: a step is cheap beside a factorisation."""
STEADY = (10, 60)
"""The same, to be doubled from there on: fine steps, because what lies beyond the precision needed is wasted."""


def precision_schedule(limit: int) -> Iterator[tuple[int, int]]:
    """Exponents of p to reach, each with the precision of the factorisation that serves the step.

    The large ones are even: FLINT asks of every modulus whether it is prime, and sees at once that a square is not.

    Examples
    --------
    >>> list(precision_schedule(50))
    [(2, 1), (3, 1), (4, 1), (8, 4), (12, 4), (16, 4), (20, 4), (30, 10), (40, 10), (50, 10)]
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
    relation = [int(value) for value in eliminant.coeffs()]
    point = [[int(value) for value in coordinate.coeffs()] for coordinate in coordinates_mod_p]
    precision, factored = 1, 0
    factors: _Factors | None = None
    for target, wanted in precision_schedule(limit):
        if factors is None or wanted > factored:
            ring = ResidueRing(prime**wanted, tuple(value % prime**wanted for value in relation))
            factors, factored = _factored_jacobian(equations, ring, point, factors, prime), wanted
        relation, point = _step(equations, prime**precision, prime**target, relation, point, form, factors)
        precision = target
        yield PadicRepresentation(prime**precision, tuple(relation), tuple(map(tuple, point)))


def is_regular(equations: Equations, eliminant: nmod_poly, coordinates_mod_p: Sequence[nmod_poly]) -> bool:
    """Whether the Jacobian is a unit at all the given solutions modulo p.

    "Yes" proves that the solutions over Q with these images are simple and isolated; "no" may be the prime's fault.
    """
    prime = int(eliminant.modulus())
    ring = ResidueRing(prime, tuple(int(value) for value in eliminant.coeffs()))
    point = [[int(value) for value in coordinate.coeffs()] for coordinate in coordinates_mod_p]
    try:
        _factored_jacobian(equations, ring, point, None, prime)
    except UnluckyPrimeError:
        return False
    return True


def _step(
    equations: Equations,
    modulus: int,
    target: int,
    relation: Sequence[int],
    point: Sequence[Sequence[int]],
    form: Sequence[int],
    factors: _Factors,
) -> tuple[list[int], list[list[int]]]:
    """One Newton step from ``modulus`` to ``target``; the corrections are found in the ring of the factors."""
    wide, ring = ResidueRing(target, tuple(relation)), factors.ring
    old = [wide.convert(coordinate) for coordinate in point]
    corrections = factors.solve([_quotient(value, modulus, ring) for value in equations.values(wide, old)])
    # The form's value at the corrected point is T + shift; like the correction, the shift is a multiple of the old
    # modulus. Lifting the coefficients of the point has itself moved the form by such a multiple.
    carry = _quotient(wide.reduce(combination(form, old) - wide.convert((0, 1))), modulus, ring)
    shift = carry - combination(form, corrections)
    new = []
    for coordinate, correction in zip(point, corrections, strict=True):
        slope = ring.convert(coordinate).derivative()
        change = correction * -1 - ring.multiply(slope, shift)
        new.append(_add_multiple(coordinate, change, modulus, target))
    change = ring.multiply(ring.relation.derivative(), shift) * -1
    return _add_multiple(relation, change, modulus, target), new


def _quotient(value: Element, modulus: int, ring: ResidueRing) -> Element:
    """value / modulus, which divides it, in a ring of lower precision."""
    return ring.convert(coefficient // modulus for coefficient in coefficients(value))


def _add_multiple(base: Sequence[int], change: Element, scale: int, modulus: int) -> list[int]:
    added = coefficients(change)
    size = max(len(base), len(added))
    padded = list(base) + [0] * (size - len(base))
    for index, value in enumerate(added):
        padded[index] = (padded[index] + scale * value) % modulus
    return padded


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
    equations: Equations, ring: ResidueRing, point: Sequence[Sequence[int]], previous: _Factors | None, prime: int
) -> _Factors:
    """Crout's factorisation; inverses of the pivots known at a lower precision are refined, not found anew."""
    matrix = equations.jacobian(ring, [ring.convert(coordinate) for coordinate in point])
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

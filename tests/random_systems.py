"""Small random systems of all sorts, and counts of their solutions that share nothing with the engine."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from flint import fmpz_mpoly, fmpz_poly

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring

NAMES = ("x", "y", "z")


def random_system(seed: int) -> PolynomialSystem:
    """Two or three unknowns, degrees up to 3, short coefficients; some with factors, squares or a common part."""
    random = Random(seed)
    names = NAMES[: random.choice((2, 2, 3))]
    size = len(names)
    count = size + random.choice((0, 0, 0, 0, 1, -1)) if size == 2 else size + random.choice((0, 0, 0, 1))
    polynomials: list[fmpz_mpoly] = []
    while len(polynomials) < max(count, 1):
        found = _polynomial(random, names)
        sort = random.randrange(8)
        if sort == 0:
            found *= _polynomial(random, names, 1)
        elif sort == 1:
            found = _polynomial(random, names, 1) ** 2 + random.choice((0, 0, 1)) * _polynomial(random, names, 1)
        elif sort == 2 and polynomials:
            found = polynomials[-1] * _polynomial(random, names, 1) + random.choice((0, 1)) * found
        if not found.is_zero() and found.total_degree() <= 4:
            polynomials.append(found)
    return PolynomialSystem(names, tuple(polynomials))


def _polynomial(random: Random, names: tuple[str, ...], degree: int | None = None) -> fmpz_mpoly:
    most = degree or random.choice((1, 2, 2, 3) if len(names) == 2 else (1, 2, 2))
    terms = {}
    for _ in range(random.randrange(2, 6)):
        exponents = [0] * len(names)
        for _ in range(random.randrange(most + 1)):
            exponents[random.randrange(len(names))] += 1
        terms[tuple(exponents)] = random.choice((-3, -2, -1, 1, 2, 3, 7))
    return polynomial_ring(names).from_dict(terms)


@dataclass(frozen=True)
class PlaneCount:
    """Of two curves in the plane: intersections with multiplicity, and distinct ones."""

    total: int
    distinct: int


def plane_count(system: PolynomialSystem) -> PlaneCount | None:
    """By a resultant after a general shear; None if the system has not two unknowns and polynomials or a common curve.

    With y constant in front of its greatest power in one polynomial, the roots of the resultant are the x of the
    solutions, as often as these are multiple; after a general shear different solutions have different x.
    """
    if len(system.unknowns) != 2 or len(system.polynomials) != 2:
        return None
    ring = polynomial_ring(system.unknowns)
    x, y = ring.gens()
    counts = set()
    for shear in (1009, 2003):
        first, second = (polynomial.compose(x + shear * y, y, ctx=ring) for polynomial in system.polynomials)
        resultant = first.resultant(second, 1)
        if resultant.is_zero():
            return None
        h = fmpz_poly(_coefficients(resultant))
        distinct = sum(int(factor.degree()) for factor, _ in h.factor()[1])
        counts.add(PlaneCount(int(h.degree()), distinct))
    (found,) = counts
    return found


def _coefficients(polynomial: fmpz_mpoly) -> list[int]:
    terms = {int(key[0]): int(value) for key, value in polynomial.to_dict().items()}
    return [terms.get(power, 0) for power in range(max(terms) + 1)]

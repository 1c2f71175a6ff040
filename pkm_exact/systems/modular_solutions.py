"""The solutions of a system modulo a prime, by the values of a linear form that separates them.

Where the powers of the form span the quotient algebra, as they do for simple solutions, every coordinate is a
polynomial in it (shape lemma): one linear system. Otherwise the traces tell (``algebra.rur``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, islice
from random import Random

from flint import nmod_mat, nmod_poly

from pkm_exact.algebra.quotient import QuotientAlgebra
from pkm_exact.algebra.rur import ModularRepresentation, distinct_values, modular_representation

RANDOM_FORMS = 6
"""Forms with random coefficients that are tried after the unknowns themselves."""
SMALL_FORMS = 2
"""Of these, those with different coefficients, up to the number of unknowns."""
_LARGEST = 99


@dataclass(frozen=True)
class SeparatedSolutions:
    """A form, and the representation of all solutions by its values modulo a prime."""

    form: tuple[int, ...]
    modular: ModularRepresentation


def separated(algebra: QuotientAlgebra, seed: int) -> SeparatedSolutions | None:
    """The first form that separates all solutions; None if none that was tried does."""
    size = algebra.ring.size
    for form in islice(candidate_forms(size, seed), size + RANDOM_FORMS):
        modular = in_shape(algebra, form)
        if modular is not None:
            return SeparatedSolutions(form, modular)
    count = most_values(algebra, seed)
    for form in islice(candidate_forms(size, seed), size + RANDOM_FORMS):
        modular = represented(algebra, form)
        if modular.degree == count:
            return SeparatedSolutions(form, modular)
    return None


def candidate_forms(size: int, seed: int) -> Iterator[tuple[int, ...]]:
    """Linear forms to try: the last unknown, .., the first one, and then random ones, small ones first.

    The coefficients of what is lifted are as long as the values of the form at all solutions together.
    """
    yield from (tuple(int(place == index) for place in range(size)) for index in reversed(range(size)))
    random = Random(seed)
    for _ in range(SMALL_FORMS):
        yield tuple(random.choice((-1, 1)) * weight for weight in random.sample(range(1, size + 1), size))
    while True:
        yield tuple(random.randrange(1, _LARGEST) for _ in range(size))


def most_values(algebra: QuotientAlgebra, seed: int) -> int:
    """The number of distinct solutions: the values of a random combination of the unknowns."""
    random = Random(seed)
    weights = [random.randrange(1, algebra.prime) for _ in range(algebra.ring.size)]
    return distinct_values(algebra, _element(algebra, weights))


def represented(algebra: QuotientAlgebra, form: Sequence[int]) -> ModularRepresentation:
    """The representation by the values of a form, by traces; whether the form separates is seen by its degree."""
    coordinates = [algebra.one * matrix for matrix in algebra.unknowns]
    return modular_representation(algebra, _element(algebra, form), coordinates)


def in_shape(algebra: QuotientAlgebra, form: Sequence[int]) -> ModularRepresentation | None:
    """The representation where all solutions are simple and the form separates them; otherwise None."""
    size, prime = algebra.dimension, algebra.prime
    matrix = _combined(algebra, form)
    rows = [algebra.one]
    for _ in range(size):
        rows.append(rows[-1] * matrix)
    powers = nmod_mat(size, size, list(chain.from_iterable(row.entries() for row in rows[:size])), prime)
    targets = [rows[size], *(algebra.one * unknown for unknown in algebra.unknowns)]
    right = nmod_mat(len(targets), size, list(chain.from_iterable(row.entries() for row in targets)), prime)
    try:
        found = powers.transpose().solve(right.transpose()).transpose().tolist()
    except ZeroDivisionError:
        return None
    top, *coordinates = ([int(value) for value in row] for row in found)
    eliminant = nmod_poly([-value % prime for value in top] + [1], prime)
    slope = eliminant.derivative()
    if eliminant.gcd(slope).degree() > 0:
        return None
    numerators = tuple(nmod_poly(row, prime) * slope % eliminant for row in coordinates)
    return ModularRepresentation(eliminant, slope, numerators)


def _element(algebra: QuotientAlgebra, form: Sequence[int]) -> nmod_mat:
    return algebra.one * _combined(algebra, form)


def _combined(algebra: QuotientAlgebra, form: Sequence[int]) -> nmod_mat:
    total = nmod_mat(algebra.dimension, algebra.dimension, algebra.prime)
    for weight, matrix in zip(form, algebra.unknowns, strict=True):
        if weight:
            total += matrix * weight
    return total

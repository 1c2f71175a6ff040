"""The variety of rigid motions in P^16 and its boundary, by quadrics, and its sections by linear forms modulo a prime.

Coordinates are (|C|^2; u; C; R; h), in the order of ``constraints.form``. At the boundary h = 0, as a set, R = v w^T is
a product of isotropic vectors, C is a multiple of v and G u one of w (``docs/completeness.md``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import gcd, lcm
from types import MappingProxyType
from typing import TypeAlias

from flint import fmpq_mpoly, fmpz, fmpz_mat, nmod_mat

from pkm_exact.algebra.graded_quotient import pairs
from pkm_exact.algebra.reduction import row_echelon
from pkm_exact.constraints.form import SIZE
from pkm_exact.formulations.base import dot, matrix_vector, rational, rational_ring
from pkm_exact.formulations.motion_variety import MOTION_COORDINATES, motion_quadrics

Quadric: TypeAlias = Mapping[tuple[int, int], int]
"""Integer coefficients on products of two of the 17 coordinates, the smaller index first."""
IntegerForm: TypeAlias = Sequence[int]
HORIZON: IntegerForm = (0,) * (SIZE - 1) + (1,)
"""The form h: its zeros are at infinity."""

_NAMES = ("s", "u1", "u2", "u3", "c1", "c2", "c3", *(f"r{i}{j}" for i in "123" for j in "123"), "h")


@lru_cache(maxsize=32)
def variety_quadrics(metric: tuple[int, int, int]) -> tuple[Quadric, ...]:
    """The quadrics that define the variety of rigid motions; they vanish nowhere else.

    Examples
    --------
    >>> len(variety_quadrics((1, 1, 1)))
    38
    """
    values = _coordinates()
    ordered = [values[name] for name in MOTION_COORDINATES]
    return _cleared(motion_quadrics(ordered, values["h"], [rational(g) for g in metric]))


@lru_cache(maxsize=32)
def boundary_quadrics(metric: tuple[int, int, int]) -> tuple[Quadric, ...]:
    """Quadrics on the 16 coordinates but h that define the boundary, every general point of it once.

    Examples
    --------
    >>> len(boundary_quadrics((1, 1, 1)))
    56
    """
    values = _coordinates()
    g = [rational(value) for value in metric]
    u, c = ([values[f"{letter}{i}"] for i in (1, 2, 3)] for letter in "uc")
    r = [[values[f"r{i}{j}"] for j in (1, 2, 3)] for i in (1, 2, 3)]
    columns = [*([r[i][j] for i in range(3)] for j in range(3)), c]
    rows = [*r, [scale * value for scale, value in zip(g, u, strict=True)]]
    found = [
        left[i] * right[k] - left[k] * right[i]
        for vectors in (columns, rows)
        for number, left in enumerate(vectors)
        for right in vectors[:number]
        for i in range(3)
        for k in range(i)
    ]
    found += [dot(g, left, right) for n, left in enumerate(columns) for right in columns[: n + 1]]
    inverse = [1 / value for value in g]
    found += [dot(inverse, left, right) for n, left in enumerate(r) for right in r[: n + 1]]
    found += [*matrix_vector(r, u), dot(g, u, u)]
    return _cleared(found)


def restricted(quadrics: Sequence[Quadric], forms: Sequence[IntegerForm], prime: int) -> tuple[int, list[list[int]]]:
    """Quadrics on the common zeros of integer forms, modulo a prime: number of unknowns, coefficients on ``pairs``."""
    basis = zero_space(forms, prime)
    size = basis.ncols()
    coordinates = [[(k, int(value)) for k, value in enumerate(row) if value] for row in basis.tolist()]
    found = _substituted(quadrics, coordinates, size)
    return size, [[value % prime for value in values] for values in found]


def _substituted(
    quadrics: Sequence[Quadric], coordinates: Sequence[Sequence[tuple[int, int]]], size: int
) -> list[list[int]]:
    """Quadrics on ``pairs`` of unknowns, by each coordinate's unknowns with their coefficients."""
    place = {pair: number for number, pair in enumerate(pairs(size))}
    places = [[place[min(i, j), max(i, j)] for j in range(size)] for i in range(size)]
    found = []
    for quadric in quadrics:
        values = [0] * len(place)
        for (i, j), value in quadric.items():
            for k, left in coordinates[i]:
                factor, line = value * left, places[k]
                for m, right in coordinates[j]:
                    values[line[m]] += factor * right
        found.append(values)
    return found


@dataclass(frozen=True)
class IntegerSection:
    """Quadrics on the common zeros of integer forms, over the integers, to be taken modulo any number of primes.

    Attributes
    ----------
    basis : fmpz_mat
        As columns the 17 coordinates by those that are free, each column times what makes it integral.
    quadrics : fmpz_mat
        A row each, on ``pairs`` of the free coordinates.
    """

    basis: fmpz_mat
    quadrics: fmpz_mat

    @staticmethod
    def of(quadrics: Sequence[Quadric], forms: Sequence[IntegerForm]) -> IntegerSection:
        """The section of independent or dependent forms."""
        rows, denominator, rank = fmpz_mat([list(form) for form in forms]).rref()
        table = rows.tolist()
        pivots = [next(column for column in range(SIZE) if table[row][column]) for row in range(rank)]
        free = [column for column in range(SIZE) if column not in pivots]
        columns = []
        for column in free:
            values = [fmpz(0)] * SIZE
            values[column] = denominator
            for row, pivot in enumerate(pivots):
                values[pivot] = -table[row][column]
            content = gcd(*map(int, values))
            columns.append([value // content for value in values])
        coordinates = [[(k, int(column[i])) for k, column in enumerate(columns) if column[i]] for i in range(SIZE)]
        found = _substituted(quadrics, coordinates, len(free))
        basis = fmpz_mat(columns).transpose()
        return IntegerSection(basis, fmpz_mat(found))

    def modulo(self, prime: int) -> tuple[nmod_mat, nmod_mat] | None:
        """Basis and quadrics modulo a prime; None if the basis is none there."""
        basis = nmod_mat(self.basis, prime)
        return (basis, nmod_mat(self.quadrics, prime)) if basis.rank() == basis.ncols() else None


def zero_space(forms: Sequence[IntegerForm], prime: int) -> nmod_mat:
    """A basis of the common zeros of forms modulo a prime, as columns: the 17 coordinates by those that are free."""
    echelon, pivots = row_echelon(
        nmod_mat(len(forms), SIZE, [value % prime for form in forms for value in form], prime)
    )
    free = [column for column in range(SIZE) if column not in pivots]
    basis = nmod_mat(SIZE, len(free), prime)
    for number, column in enumerate(free):
        basis[column, number] = 1
        for row, pivot in enumerate(pivots):
            basis[pivot, number] = -echelon[row, column]
    return basis


def _coordinates() -> dict[str, fmpq_mpoly]:
    _, generators = rational_ring(_NAMES)
    return dict(zip(_NAMES, generators, strict=True))


def _cleared(polynomials: Sequence[fmpq_mpoly]) -> tuple[Quadric, ...]:
    found = []
    for polynomial in polynomials:
        terms = {
            tuple(index for index, exponent in enumerate(exponents) for _ in range(int(exponent))): value
            for exponents, value in polynomial.to_dict().items()
        }
        denominator = lcm(*(int(value.q) for value in terms.values()))
        found.append(MappingProxyType({(i, j): int(value * denominator) for (i, j), value in terms.items()}))
    return tuple(found)

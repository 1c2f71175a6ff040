"""The finite poses of a robot in as few affine coordinates as linear algebra over Q leaves.

The linear forms are solved for coordinates and the solution is substituted into the quadrics of rigid motions and of
the constraints. Where combinations of these are linear, they are further forms: a platform point that stays in a place
makes u and |C|^2 linear in R, a platform that does not turn has u = C. This goes on until no combination is linear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

from flint import fmpq, fmpq_mat

from pkm_exact.algebra.graded_quotient import pairs
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.rigid_motions import IntegerForm, Quadric, variety_quadrics
from pkm_exact.constraints.form import SIZE
from pkm_exact.motions.motion import Motion

ORDER = (1, 2, 3, 4, 5, 6, 0, *range(7, SIZE))
"""Columns: u, C, |C|^2, R, 1; forms are solved for those on the left first."""
_NAMES = ("s", "u1", "u2", "u3", "c1", "c2", "c3", *(f"r{i}{j}" for i in "123" for j in "123"))


@dataclass(frozen=True)
class ClosedSection:
    """The poses as common zeros of quadrics none of whose combinations is linear.

    Attributes
    ----------
    forms : tuple of 17 fmpq each
        A basis of the linear forms found, on the coordinates in ``ORDER``: a reduced echelon form.
    unknowns : tuple of int
        The coordinates (indices in a form) that they leave free, in ``ORDER``.
    quadrics : tuple of tuple of fmpq
        A reduced echelon form, on the monomials of ``monomials(len(unknowns))``.
    is_empty : bool
        Whether 1 = 0 was found: there is no finite pose, not even a complex one.
    """

    forms: tuple[tuple[fmpq, ...], ...]
    unknowns: tuple[int, ...]
    quadrics: tuple[tuple[fmpq, ...], ...]
    is_empty: bool

    @cached_property
    def system(self) -> PolynomialSystem:
        """The quadrics as a system over the integers; of the polynomial 1 alone if there is no pose."""
        names = tuple(_NAMES[index] for index in self.unknowns)
        ring = polynomial_ring(names)
        if self.is_empty:
            return PolynomialSystem(names, (ring.constant(1),))
        exponents = monomials(len(names))
        polynomials = []
        for quadric in self.quadrics:
            row = fmpq_mat([list(quadric)]).numer_denom()[0].entries()
            terms = {key: value for key, value in zip(exponents, row, strict=True) if value}
            polynomials.append(ring.from_dict(terms).primitive()[1])
        return PolynomialSystem(names, tuple(polynomials))


def closed_section(conditions: Conditions) -> ClosedSection:
    """The closed section of a robot.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import MOTIONS
    >>> [len(closed_section(Conditions((), (), (1, 1, 1), motion)).forms) for motion in MOTIONS.values()]
    [0, 9, 8, 12, 7]
    """
    quadrics = (*variety_quadrics(conditions.metric), *conditions.quadrics)
    forms = [[fmpq(form[j]) for j in ORDER] for form in (*conditions.forms, *conditions.motion.forms)]
    while True:
        basis, pivots = _echelon(forms)
        free = [column for column in range(SIZE - 1) if column not in pivots]
        unknowns = tuple(ORDER[column] for column in free)
        if SIZE - 1 in pivots:
            return ClosedSection(tuple(map(tuple, basis)), unknowns, (), is_empty=True)
        rows, leads = _echelon(_substituted(quadrics, basis, pivots, free))
        size = len(free)
        if rows and leads[-1] == len(rows[0]) - 1:
            return ClosedSection(tuple(map(tuple, basis)), unknowns, (), is_empty=True)
        linear = [row for row, lead in zip(rows, leads, strict=True) if lead >= size * (size + 1) // 2]
        if not linear:
            return ClosedSection(tuple(map(tuple, basis)), unknowns, tuple(map(tuple, rows)), is_empty=False)
        forms = basis
        for row in linear:
            form = [fmpq(0)] * SIZE
            for column, value in zip([*free, SIZE - 1], row[-size - 1 :], strict=True):
                form[column] = value
            forms.append(form)


@lru_cache(maxsize=64)
def motion_forms(motion: Motion, metric: tuple[int, int, int]) -> tuple[tuple[fmpq, ...], ...]:
    """A basis of all linear forms that vanish on a group of motions, on the coordinates in ``ORDER``."""
    return closed_section(Conditions((), (), metric, motion)).forms


def rank_of(rows: Sequence[Sequence[fmpq]]) -> int:
    """Rank over Q; 0 if there are no rows."""
    return int(fmpq_mat([list(row) for row in rows]).rank()) if rows else 0


def ordered(form: IntegerForm) -> list[fmpq]:
    """A form on the coordinates in ``ORDER``."""
    return [fmpq(form[j]) for j in ORDER]


def monomials(size: int) -> list[tuple[int, ...]]:
    """Exponents of the monomials of degree 2, 1 and 0, decreasing in the degree reverse lexicographic order.

    Examples
    --------
    >>> monomials(2)
    [(2, 0), (1, 1), (0, 2), (1, 0), (0, 1), (0, 0)]
    """
    return [tuple((k == i) + (k == j) for k in range(size)) for i, j in _decreasing(size)]


def _decreasing(size: int) -> list[tuple[int, int]]:
    """The same as pairs of indices, ``size`` for the factor 1."""
    return sorted(pairs(size + 1), key=lambda pair: (pair[1], pair[0]))


def _echelon(rows: Sequence[Sequence[fmpq]]) -> tuple[list[list[fmpq]], list[int]]:
    """The rows of the reduced echelon form that are not 0, and the columns of their pivots."""
    if not rows:
        return [], []
    echelon, rank = fmpq_mat([list(row) for row in rows]).rref()
    found = echelon.table()[:rank]
    return found, [next(column for column, value in enumerate(row) if value != 0) for row in found]


def _substituted(
    quadrics: Sequence[Quadric], basis: Sequence[Sequence[fmpq]], pivots: Sequence[int], free: Sequence[int]
) -> list[list[fmpq]]:
    """Quadrics at the coordinates that the forms give, the last one 1."""
    columns = [*free, SIZE - 1]
    zero = fmpq(0)
    values: dict[int, list[tuple[int, fmpq]]] = {ORDER[column]: [(k, fmpq(1))] for k, column in enumerate(columns)}
    for row, pivot in zip(basis, pivots, strict=True):
        values[ORDER[pivot]] = [(k, -row[column]) for k, column in enumerate(columns) if row[column] != 0]
    place = {pair: number for number, pair in enumerate(_decreasing(len(free)))}
    found = []
    for quadric in quadrics:
        entries = [zero] * len(place)
        for (i, j), coefficient in quadric.items():
            for k, left in values[i]:
                for m, right in values[j]:
                    entries[place[min(k, m), max(k, m)]] += coefficient * left * right
        found.append(entries)
    return found

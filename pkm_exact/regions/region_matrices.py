"""The matrix of wrenches without its determinant: smaller rows, how large the determinant would be, signs at points."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product as combinations_of
from math import lcm
from typing import Any, Final

from flint import fmpq, fmpz_mat

from pkm_exact.errors import InputError
from pkm_exact.regions.chart import Chart, Polynomial, PosePolynomials, rational
from pkm_exact.regions.placed_legs import PlacedLeg
from pkm_exact.regions.region_determinants import leg_row, structural_rows
from pkm_exact.regions.region_legs import OwnLength, RegionMachine

Rows = tuple[tuple[Polynomial, ...], ...]

MOST_OF_DETERMINANT: Final = 10_000
"""Coefficients of a determinant, at most, beyond which the matrix is not expanded."""


def smaller_rows(machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg]) -> Rows:
    """The rows of ``wrench_rows``, those of legs of own length over N.

    With b = N R B, o = C - A and e = N o + b, b x e is N (b x o), so that N divides all of the row.

    Raises
    ------
    InputError
        If there are not as many as freedoms.
    """
    found = [
        own_row(leg, machine, pose) if isinstance(leg.leg.actuator, OwnLength) else leg_row(leg, pose, machine)
        for leg in placed
    ]
    found += structural_rows(machine, pose)
    require_square(len(found), machine)
    return tuple(map(tuple, found))


def require_square(rows: int, machine: RegionMachine) -> None:
    """Refuse more or fewer equations than freedoms."""
    if rows != len(machine.twist):
        raise InputError(
            f"conditions.no_type_2: {rows} equations for {len(machine.twist)} freedoms; regions know "
            "this condition where there are as many"
        )


def own_row(leg: PlacedLeg, machine: RegionMachine, pose: PosePolynomials) -> list[Polynomial]:
    """That of a leg of own length over N: (g_i e_i; g_j g_k (b x o)_i)."""
    (g1, g2, g3), b, n = machine.metric, leg.arm, pose.norm
    offset = [divmod(c - n * rational(a), n)[0] for c, a in zip(pose.position, leg.leg.base, strict=True)]
    wrench = [g * e for g, e in zip(machine.metric, leg.rod, strict=True)] + [
        g2 * g3 * (b[1] * offset[2] - b[2] * offset[1]),
        g3 * g1 * (b[2] * offset[0] - b[0] * offset[2]),
        g1 * g2 * (b[0] * offset[1] - b[1] * offset[0]),
    ]
    return [wrench[j] for j in machine.twist]


def has_matrix(chart: Chart) -> bool:
    """Whether positions are variables or numbers, and no number of the robot varies: then N divides N (C - A)."""
    return chart.arc is None and chart.line is None and not chart.parameters


def determinant_size(rows: Sequence[Sequence[Polynomial]], variables: int) -> int:
    """How many coefficients the determinant of a matrix has at most: from the degrees of its rows and columns.

    Parameters
    ----------
    rows : sequence of sequences of polynomials
    variables : int
        Of the chart; the others are roots.

    Examples
    --------
    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> x, y = fmpq_mpoly_ctx.get(("x", "y"), Ordering.lex).gens()
    >>> determinant_size(((x * x, x), (y, x)), 1)
    8
    """
    degrees = [[[max(0, int(d)) for d in entry.degrees()] for entry in row] for row in rows]
    size, roots = 1, set[int]()
    for k in range(variables):
        by_rows = sum(max(entry[k] for entry in row) for row in degrees)
        by_columns = sum(max(entry[k] for entry in column) for column in zip(*degrees, strict=True))
        size *= 1 + min(by_rows, by_columns)
    for row in degrees:
        for entry in row:
            roots |= {k for k, degree in enumerate(entry[variables:]) if degree}
    return size << len(roots)


class MatrixAtPoints:
    """A matrix of polynomials whose determinant is wanted at many rational points, exactly.

    All entries share the values of the monomials at a point, as integers over one denominator; a row is multiplied by a
    positive number.

    Parameters
    ----------
    rows : sequence of sequences of fmpq_mpoly
        Each root is in one row, and linear there.
    pose : PosePolynomials
        Of whose ring they are.
    variables : int
        Of the chart; the others are roots.

    Examples
    --------
    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> ring = fmpq_mpoly_ctx.get(("x", "y"), Ordering.lex)
    >>> x, y = ring.gens()
    >>> matrix = MatrixAtPoints(((x + y, 2 * x), (x, x)), PosePolynomials(ring, x, (), ()), 1)
    >>> print(matrix.determinant_at((Fraction(3),)))
    3*y - 9
    """

    def __init__(self, rows: Rows, pose: PosePolynomials, variables: int) -> None:
        terms = [[_terms(entry, variables) for entry in row] for row in rows]
        self._ring, self._variables = pose.ring, variables
        monomials = {e: None for row in terms for entry in row for _, e in entry}
        self._monomials = list(monomials) or [(0,) * variables]
        self._degree = max(map(sum, self._monomials))
        place = {exponents: k for k, exponents in enumerate(self._monomials)}
        self._options: list[list[tuple[int, ...]]] = []
        table = []
        for row in terms:
            common = lcm(*(int(value.q) for entry in row for value in entry.values()))
            roots = sorted({root for entry in row for root, _ in entry}, key=lambda root: (any(root), root))
            self._options.append(roots or [(0,) * (len(pose.ring.names()) - variables)])
            for root in self._options[-1]:
                for entry in row:
                    numbers = [0] * len(place)
                    for (of, exponents), value in entry.items():
                        if of == root:
                            numbers[place[exponents]] = int(value * common)
                    table.append(numbers)
        self._table = fmpz_mat(table)

    def determinant_at(self, point: Sequence[Fraction]) -> Polynomial:
        """The determinant at a point up to a positive factor, with the roots as variables."""
        values = self._table * fmpz_mat(len(self._monomials), 1, self._powers(point))
        size, numbers = len(self._options), values.entries()
        rows, first = [], 0
        for roots in self._options:
            rows.append([numbers[first + size * k : first + size * (k + 1)] for k in range(len(roots))])
            first += size * len(roots)
        total: dict[tuple[int, ...], Any] = {}
        for choice in combinations_of(*(range(len(roots)) for roots in self._options)):
            chosen = [roots[k] for roots, k in zip(self._options, choice, strict=True)]
            key = (0,) * self._variables + tuple(map(sum, zip(*chosen, strict=True)))
            matrix = fmpz_mat([options[k] for options, k in zip(rows, choice, strict=True)])
            total[key] = total.get(key, 0) + matrix.det()
        return self._ring.from_dict({key: fmpq(value) for key, value in total.items()})

    def _powers(self, point: Sequence[Fraction]) -> list[int]:
        """The monomials at a point, times the same power of its denominator."""
        common = lcm(*(x.denominator for x in point))
        numerators = [x.numerator * (common // x.denominator) for x in point]
        powers = [[n**k for k in range(self._degree + 1)] for n in (*numerators, common)]
        values = []
        for exponents in self._monomials:
            value = powers[-1][self._degree - sum(exponents)]
            for of, k in zip(powers, exponents, strict=False):
                value *= of[k]
            values.append(value)
        return values


def _terms(entry: Polynomial, variables: int) -> dict[tuple[tuple[int, ...], tuple[int, ...]], Any]:
    """The coefficients of a polynomial by the powers of the roots and those of the variables."""
    found = {tuple(map(int, exponents)): value for exponents, value in entry.to_dict().items()}
    return {(powers[variables:], powers[:variables]): value for powers, value in found.items()}

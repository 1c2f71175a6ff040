"""The matrix of wrenches without its determinant: smaller rows, how large the determinant would be, signs at points."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import product as combinations_of
from typing import Any, Final

from flint import fmpq_mat

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


def determinant_at(rows: Rows, point: Sequence[Fraction], pose: PosePolynomials) -> Polynomial:
    """The determinant at a point of the chart, with the roots as variables: each is in one row, and linear there.

    Examples
    --------
    >>> from flint import Ordering, fmpq_mpoly_ctx
    >>> ring = fmpq_mpoly_ctx.get(("x", "y"), Ordering.lex)
    >>> x, y = ring.gens()
    >>> pose = PosePolynomials(ring, x, (), ())
    >>> print(determinant_at(((x + y, 2 * x), (x, x)), (Fraction(3),), pose))
    3*y - 9
    """
    at = [rational(x) for x in point]
    zeros = [rational(0)] * (len(pose.ring.names()) - len(at))
    used = [sorted({k for entry in row for k, d in enumerate(entry.degrees()[len(at) :]) if d > 0}) for row in rows]
    values = []
    for row, roots in zip(rows, used, strict=True):
        constant = [entry(*at, *zeros) for entry in row]
        slopes = []
        for root in roots:
            ones = [rational(int(k == root)) for k in range(len(zeros))]
            slopes.append([entry(*at, *ones) - value for entry, value in zip(row, constant, strict=True)])
        values.append([constant, *slopes])
    total: dict[tuple[int, ...], Any] = {}
    for choice in combinations_of(*(range(len(options)) for options in values)):
        matrix = fmpq_mat([options[k] for options, k in zip(values, choice, strict=True)])
        chosen = {roots[k - 1] for roots, k in zip(used, choice, strict=True) if k}
        key = (0,) * len(at) + tuple(int(k in chosen) for k in range(len(zeros)))
        total[key] = total.get(key, rational(0)) + matrix.det()
    return pose.ring.from_dict(total)

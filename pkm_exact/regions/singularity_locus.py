"""Where a machine is singular: the determinant of its constraints as an exact polynomial of the pose, factored.

With slides and cranks the roots y of their discriminants are variables too (``formula``), y_k that of leg k.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import gcd, lcm
from typing import Any, Final

from flint import fmpz_poly

from pkm_exact.errors import InputError
from pkm_exact.regions.chart import Polynomial, rational
from pkm_exact.regions.crossings import crossings
from pkm_exact.regions.region_conditions import constraint_rows, placed_legs
from pkm_exact.regions.region_determinants import determinant
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.roots.interval import Interval

MOST_TERMS: Final = 20_000
"""Larger determinants are not factored."""


@dataclass(frozen=True)
class Locus:
    """The poses of a chart at which locked actuators do not hold the platform.

    Attributes
    ----------
    variables : tuple of str
        Of the chart, then the roots.
    factors : tuple of (str, int)
        Polynomials over the integers that are not positive everywhere by their form, with their multiplicities; the
        determinant is their product times a number, and powers of norms 1 + w t^2. None: it is never 0, or always.
    is_identical : bool
        Whether the determinant is 0 at every pose.
    points : tuple of Interval, or None
        If one variable moves: isolating intervals of the singular poses in the region.
    undecided : tuple of Interval
        Where singular poses are neither isolated nor excluded.
    is_redundant : bool
        Whether there are more equations than freedoms: then the factors are common to all determinants, and there may
        be singular poses besides, in sets of less dimension.
    """

    variables: tuple[str, ...]
    factors: tuple[tuple[str, int], ...]
    is_identical: bool
    points: tuple[Interval, ...] | None
    is_redundant: bool = False
    undecided: tuple[Interval, ...] = ()


def locus(machine: RegionMachine, question: RegionQuestion) -> Locus:
    """The singularity locus in the chart of a question.

    Raises
    ------
    InputError
        As ``region_conditions.asked_of``, and if there are fewer equations than freedoms.
    """
    chart = question.chart
    pose, rows = constraint_rows(machine, chart, question.conditions)
    size, variables = len(machine.twist), tuple(map(str, pose.ring.gens()))
    if len(rows) < size:
        raise InputError(f"conditions.no_type_2: {len(rows)} equations do not hold {size} freedoms anywhere")
    common = pose.constant(0)
    for chosen in combinations(rows, size):
        common = common.gcd(determinant(chosen, pose.constant(0)))
    redundant = len(rows) > size
    if common.is_zero():
        return Locus(variables, (), True, None, redundant)
    if len(common) > MOST_TERMS:
        return Locus(variables, ((spelled(common), 1),), False, None, redundant)
    norms = {spelled(factor) for factor, _ in pose.norm.factor()[1]}
    kept = [(factor, int(power)) for factor, power in common.factor()[1] if spelled(factor) not in norms]
    points, undecided = _points(machine, question, [factor for factor, _ in kept])
    factors = tuple((spelled(factor), power) for factor, power in kept)
    return Locus(variables, factors, False, points, redundant, undecided)


def _points(
    machine: RegionMachine, question: RegionQuestion, factors: Sequence[Polynomial]
) -> tuple[tuple[Interval, ...] | None, tuple[Interval, ...]]:
    """The singular poses, and where they are not decided, if one variable moves."""
    chart = question.chart
    if len(chart.variables) > 1:
        return None, ()
    _, placed = placed_legs(machine, chart, question.conditions)
    roots = [leg.root for leg in placed if leg.root is not None]
    points: list[Interval] = []
    undecided: list[Interval] = []
    for factor in factors:
        if not roots:
            points += roots_in(factor, *chart.box[0])
            continue
        found = crossings(factor, roots, *chart.box[0])
        points += found.zeros
        undecided += found.undecided
    return tuple(sorted(points, key=_start)), tuple(sorted(undecided, key=_start))


def _start(interval: Interval) -> Fraction:
    return interval.lo


def spelled(polynomial: Polynomial) -> str:
    """The polynomial with the least integer coefficients, the first of them positive."""
    values = [Fraction(int(v.p), int(v.q)) for v in polynomial.to_dict().values()]
    scale = Fraction(lcm(*(v.denominator for v in values)), gcd(*(v.numerator for v in values)))
    return str(polynomial * rational(scale if values[0] > 0 else -scale))


def roots_in(factor: Polynomial, low: Fraction, high: Fraction) -> Iterator[Interval]:
    """Isolating intervals of the real roots of an irreducible polynomial of one variable in [low, high]."""
    scale = lcm(*(int(value.q) for value in factor.to_dict().values()))
    coefficients = [0] * (int(factor.degrees()[0]) + 1)
    for exponents, value in factor.to_dict().items():
        coefficients[int(exponents[0])] = int(value.p) * (scale // int(value.q))
    if len(coefficients) == 2:
        root = Fraction(-coefficients[0], coefficients[1])
        yield from [Interval(root, root)] if low <= root <= high else []
        return
    polynomial: Any = fmpz_poly(coefficients)
    for value, _ in polynomial.complex_roots():
        if value.imag == 0:
            near = _exact(value.real.lower()), _exact(value.real.upper())
            yield from _within(lambda x: polynomial(rational(x)) > 0, near, low, high)


def _within(
    is_positive: Callable[[Fraction], bool], near: tuple[Fraction, Fraction], low: Fraction, high: Fraction
) -> list[Interval]:
    """What lies in [low, high] of an interval about one simple irrational root; nothing if the root does not."""
    first, last = near
    if first < low < last:
        if is_positive(low) is is_positive(last):
            return []
        first = low
    if first < high < last:
        if is_positive(first) is is_positive(high):
            return []
        last = high
    return [Interval(first, last)] if low <= first and last <= high else []


def _exact(value: Any) -> Fraction:
    mantissa, exponent = value.mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)

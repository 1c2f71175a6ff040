"""A univariate representation over Q proposed from numerical solutions: far quicker than lifting, and not proved here.

Newton's method takes the solutions that doubles know to thousands of bits, in real arithmetic where they are real. With
t the values of the separating form, h = prod (T - t) and the numerators n_i = sum x_i h / (T - t) have rational
coefficients; lattice reduction finds their common denominators, for reals modulo 1, times 2^B, are like residues modulo
2^B. Wrong proposals, as from lost or doubled solutions, fit no denominator, or fail the exact verification that every
representation must pass, wherever it comes from.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, lcm, log2
from typing import Final

import numpy as np
from flint import arb, fmpz, fmpz_poly

from pkm_exact.algebra.reconstruction import LATTICE_RESIDUES, MARGIN_BITS, common_fraction
from pkm_exact.algebra.representation import UnivariateRepresentation, from_common_fractions
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.refined_solutions import RefinedSolutions, refined_solutions
from pkm_exact.numeric.seeds import has_seeds, seeds
from pkm_exact.numeric.study_system import Complex, rational_coordinates
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.poses.study_equations import Chart, free_coordinates
from pkm_exact.precision import working_precision

WORTHWHILE: Final = 384
"""Fewer bits are lifted as quickly."""
SPARE_BITS: Final = 48
"""For what sums and products of the roots lose beside their sizes."""
GROWTH: Final = 1.3
"""Of the bits of denominators that are looked for, from one attempt to the next."""
ATTEMPTS: Final = 3
CLOSE: Final = 2.0**-24
"""Relative distance of values of the form that doubles may not tell apart."""
DOUBLED: Final = 3
LEAST_DOUBLED: Final = 600
"""Newton's method doubles the bits up to a part of the expected ones, or so many; inverses serve from there on."""


def proposed_representation(
    problem: ForwardProblem,
    chart: Chart,
    form: Sequence[int],
    degree: int,
    limit_bits: int,
    watch: Callable[[int], None] | None = None,
) -> UnivariateRepresentation | None:
    """The representation on the free coordinates of the chart, probably; None if there is nothing to propose.

    Parameters
    ----------
    problem : ForwardProblem
    chart : tuple of 4 int
    form : sequence of 8 int
        Separating.
    degree : int
        Number of solutions, all of them simple.
    limit_bits : int
        More are not asked for.
    watch : callable, optional
        Gets the bits that are reached.
    """
    expected = expected_bits(problem, degree)
    if expected < WORTHWHILE or not has_seeds(problem):
        return None
    try:
        found = seeds(problem)
    except OverflowError:
        return None
    points = rational_coordinates(found.points, found.section)
    values = points[:, :4] @ np.array(chart, dtype=float)
    if len(points) != degree or not np.all(values):
        return None
    points /= values[:, None]
    if not _are_separated(points @ np.array(form, dtype=float)):
        return None
    solutions = refined_solutions(problem, chart, points)
    if solutions is None:
        return None
    refinement = _Refinement(
        solutions, _margin(points, form), max(expected // DOUBLED, LEAST_DOUBLED), limit_bits, watch
    )
    return _proposed(refinement, [form[k] for k in free_coordinates(chart, problem)], expected + expected // 16)


def _are_separated(roots: Complex) -> bool:
    """Whether doubles tell the values of the form apart."""
    distances = np.abs(roots[:, None] - roots[None])
    np.fill_diagonal(distances, np.inf)
    return bool((distances > CLOSE * np.maximum(np.abs(roots), 1)).all())


def _margin(points: Complex, form: Sequence[int]) -> int:
    """Bits by which coefficients of h and the numerators may be larger than 1, and less exact than the solutions."""
    roots = np.abs(points @ np.array(form, dtype=float)).tolist()
    return ceil(sum(log2(max(root, 1)) for root in roots) + log2(max(float(np.abs(points).max()), 1))) + SPARE_BITS


@dataclass(eq=False)
class _Refinement:
    """Solutions with more and more bits.

    Attributes
    ----------
    solutions : RefinedSolutions
    margin : int
        Coefficients have so many bits less behind the point.
    doubling : int
        Up to which bits Newton's method doubles them.
    limit : int
    watch : callable, optional
    """

    solutions: RefinedSolutions
    margin: int
    doubling: int
    limit: int
    watch: Callable[[int], None] | None

    def factors(self, form: Sequence[int], bits: int) -> list[_Factor]:
        """Factors of h that are right to so many bits behind the point; none beyond the limit."""
        place = bits + self.margin
        if place > self.limit:
            return []
        self.solutions = self.solutions.refined(place, self.doubling)
        if self.watch is not None:
            self.watch(place)
        return _factors(self.solutions, form, place)


def _proposed(refinement: _Refinement, form: Sequence[int], bits: int) -> UnivariateRepresentation | None:
    """The representation, from solutions that are refined until denominators are found."""
    found = None
    for _ in range(ATTEMPTS):
        factors = refinement.factors(form, bits)
        if not factors:
            return None
        place = bits + refinement.margin
        found = _fractions(_product([factor.relation for factor in factors], place), place, bits)
        if found is not None:
            break
        bits = int(GROWTH * bits)
    if found is None:
        return None
    h, denominator = found
    length = denominator.bit_length()
    numerators = _Numerators(factors, place, bits - length, len(h) - 1, denominator)
    rotation = sum(k < 4 for k in refinement.solutions.equations.free)
    first = numerators.fractions(range(rotation))
    if numerators.fractions([len(form) - 1]) is None:
        bits = length + _bits_for(length)
        place = bits + refinement.margin
        factors = refinement.factors(form, bits)
        if not factors:
            return None
        numerators = _Numerators(factors, place, bits - length, len(h) - 1, denominator)
    second = numerators.fractions(range(rotation, len(form)))
    if first is None or second is None:
        return None
    common = lcm(first[1], second[1])
    lists = [[value * (common // scale) for value in values] for part, scale in (first, second) for values in part]
    return from_common_fractions(form, h, denominator, lists, denominator * common)


def _bits_for(length: int) -> int:
    """Of reals, to find a common denominator of so many bits."""
    return length + length // LATTICE_RESIDUES + 2 * MARGIN_BITS


@dataclass(frozen=True, eq=False)
class _Numerators:
    """The numerators over h', from factors of h.

    Attributes
    ----------
    factors : list of _Factor
    place : int
        The factors' coefficients are multiplied by 2^place.
    bits : int
        So many of a numerator times the denominator of h are right behind the point.
    degree : int
    denominator : int
    """

    factors: list[_Factor]
    place: int
    bits: int
    degree: int
    denominator: int

    def fractions(self, wanted: Sequence[int]) -> tuple[list[list[int]], int] | None:
        """Of some coordinates, times the denominator of h, as integers over one denominator."""
        factors = [_Factor(f.relation, [f.numerators[k] for k in wanted]) for f in self.factors]
        values = [
            value * self.denominator
            for numerator in _joined(factors, self.place).numerators
            for value in _padded(numerator, self.degree)
        ]
        found = _fractions(values, self.place, self.bits)
        if found is None:
            return None
        flat = iter(found[0])
        return [[next(flat) for _ in range(self.degree)] for _ in wanted], found[1]


def _fractions(values: Sequence[fmpz], place: int, bits: int) -> tuple[list[int], int] | None:
    """Integers n_j and one d with values_j / 2^place = n_j / d, if so many bits behind the point tell."""
    modulus = 1 << bits
    found = common_fraction([(value >> (place - bits)) % modulus for value in values], modulus)
    if found is None:
        return None
    half = fmpz(1) << (place - 1)
    return [int((value * found[1] + half) >> place) for value in values], found[1]


def _padded(polynomial: fmpz_poly, size: int) -> list[fmpz]:
    values = polynomial.coeffs()
    return values + [fmpz(0)] * (size - len(values))


@dataclass(frozen=True, eq=False)
class _Factor:
    """A factor of h and, of each coordinate, the numerator over its derivative; times 2^place."""

    relation: fmpz_poly
    numerators: list[fmpz_poly]


def _factors(solutions: RefinedSolutions, form: Sequence[int], place: int) -> list[_Factor]:
    """T - t of each real solution, T^2 - 2 Re(t) T + |t|^2 of each pair."""
    factors = []
    with working_precision(2 * place):  # exact but for the division by powers of 2
        for x in solutions.points[: solutions.count]:
            t = sum(c * value for c, value in zip(form, x, strict=True) if c)
            relation = [_rounded(-t, place), fmpz(1) << place]
            factors.append(_Factor(fmpz_poly(relation), [fmpz_poly([_rounded(value, place)]) for value in x]))
        for x in solutions.points[solutions.count :]:
            t = sum(c * value for c, value in zip(form, x, strict=True) if c)
            norm = t.real * t.real + t.imag * t.imag
            relation = [_rounded(norm, place), _rounded(-2 * t.real, place), fmpz(1) << place]
            numerators = [
                fmpz_poly(
                    [
                        _rounded(-2 * (value.real * t.real + value.imag * t.imag), place),
                        _rounded(2 * value.real, place),
                    ]
                )
                for value in x
            ]
            factors.append(_Factor(fmpz_poly(relation), numerators))
    return factors


def _rounded(value: arb, place: int) -> fmpz:
    """The middle of a ball, times 2^place."""
    mantissa, exponent = value.mid().man_exp()
    shift = int(exponent) + place
    return mantissa << shift if shift >= 0 else mantissa >> -shift


def _product(relations: Sequence[fmpz_poly], place: int) -> list[fmpz]:
    while len(relations) > 1:
        pairs = zip(relations[::2], relations[1::2], strict=False)
        rest = list(relations[len(relations) - len(relations) % 2 :])
        relations = [_scaled(a * b, place) for a, b in pairs] + rest
    return relations[0].coeffs()


def _joined(factors: Sequence[_Factor], place: int) -> _Factor:
    while len(factors) > 1:
        last = len(factors) == 2
        joined = []
        for a, b in zip(factors[::2], factors[1::2], strict=False):
            relation = a.relation if last else _scaled(a.relation * b.relation, place)
            numerators = [
                _scaled(n * b.relation + m * a.relation, place) for n, m in zip(a.numerators, b.numerators, strict=True)
            ]
            joined.append(_Factor(relation, numerators))
        factors = joined + list(factors[len(factors) - len(factors) % 2 :])
    return factors[0]


def _scaled(polynomial: fmpz_poly, place: int) -> fmpz_poly:
    return fmpz_poly([value >> place for value in polynomial.coeffs()])

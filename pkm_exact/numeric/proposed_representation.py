"""A univariate representation over Q proposed from numerical solutions: far quicker than lifting, and not proved here.

Newton's method takes the solutions that doubles know to thousands of bits, in real arithmetic where they are real. With
t the values of the separating form, h = prod (T - t) and the numerators n_i = sum x_i h / (T - t) have rational
coefficients; lattice reduction finds their common denominators, for reals modulo 1, times 2^B, are like residues modulo
2^B. Wrong proposals, as from lost or doubled solutions, fit no denominator, or fail the exact verification that every
representation must pass, wherever it comes from.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations
from math import ceil, gcd, lcm, log2
from typing import Final

import numpy as np
from flint import acb, arb, fmpz

from pkm_exact.algebra.reconstruction import LATTICE_RESIDUES, MARGIN_BITS, common_fraction
from pkm_exact.algebra.representation import UnivariateRepresentation, from_common_fractions
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, motion_quadrics
from pkm_exact.numeric.refined_solutions import FIRST_BITS, RefinedSolutions, refined_solutions
from pkm_exact.numeric.root_factors import (
    fixed,
    joined,
    leading_coefficients,
    padded,
    root_factors,
    root_of_norms,
    value_of,
)
from pkm_exact.numeric.seeds import has_seeds, seeds
from pkm_exact.numeric.study_system import Complex, rational_coordinates
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.poses.modular import Form
from pkm_exact.poses.pose_denominators import PoseDenominators
from pkm_exact.poses.study_equations import Chart
from pkm_exact.precision import working_precision

WORTHWHILE: Final = 384
"""Fewer bits are lifted as quickly."""
SPARE_BITS: Final = 48
"""For what sums and products of the roots lose beside their sizes."""
GROWTH: Final = 1.3
"""Of the bits of denominators that are looked for, from one attempt to the next."""
ATTEMPTS: Final = 3
SURE_BITS: Final = 160
"""Behind the point, of numbers that are integers but for a factor of few bits."""
ROOT_BITS: Final = 512
"""Of the roots that are handed on."""
FEW_BITS: Final = 32
"""By which denominators are mostly longer at most than at other lengths."""
CLOSE: Final = 2.0**-24
"""Relative distance of values of the form that doubles may not tell apart."""
NEVER: Final = 2.0**-36
"""Relative size of what is 0 in doubles."""
SEPARATED, SAME = 40, 72
"""Values differ by more than 2^-40, or by less than 2^-72, or it is not told which."""


def proposed_representation(
    problem: ForwardProblem,
    chart: Chart,
    form: Sequence[int],
    degree: int,
    limit_bits: int,
    watch: Callable[[int], None] | None = None,
    shared: PoseDenominators | None = None,
    points: Complex | None = None,
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
    shared : PoseDenominators, optional
        Of the same robot at other lengths; it gets what is found first.
    points : (p, 8) complex array, optional
        ``approximate_solutions``, if they are known.
    """
    points = approximate_solutions(problem) if points is None else points
    if points is None or len(points) != degree:
        return None
    values = points[:, :4] @ np.array(chart, dtype=float)
    if not np.all(values):
        return None
    points = points / values[:, None]
    if not _are_separated(points @ np.array(form, dtype=float)):
        return None
    solutions = refined_solutions(problem, chart, points)
    return None if solutions is None else _represented(problem, points, form, solutions, limit_bits, watch, shared)


def first_representation(
    problem: ForwardProblem,
    charts: Sequence[Chart],
    forms: Callable[[Chart], Sequence[Form]],
    limit_bits: int,
    watch: Callable[[int], None] | None = None,
    shared: PoseDenominators | None = None,
    points: Complex | None = None,
) -> FirstRepresentation | None:
    """The representation of all solutions that are found, in the first chart and by the first form that seem to serve.

    Parameters
    ----------
    problem : ForwardProblem
    charts : sequence of chart
        To be tried.
    forms : callable
        Those to be tried in a chart.
    limit_bits : int
    watch : callable, optional
        Gets the bits that are reached.
    shared : PoseDenominators, optional
    points : (p, 8) complex array, optional
        ``approximate_solutions``, if they are known.
    """
    points = approximate_solutions(problem) if points is None else points
    if points is None or not len(points):
        return None
    sizes = np.abs(points[:, :4]).max(axis=1)
    number = 0
    while True:
        values = points[:, :4] @ np.array(charts[number], dtype=float)
        least = float(np.min(np.abs(values) / sizes))
        if least > CLOSE:
            break
        number += 1
        if least > NEVER or number == len(charts):
            return None
    chart = charts[number]
    points = points / values[:, None]
    solutions = refined_solutions(problem, chart, points)
    if solutions is None:
        return None
    tried = forms(chart)
    for place, form in enumerate(tried):
        found = _separates(points, solutions, form)
        if found is None:
            return None
        if found:
            lifted = _represented(problem, points, form, solutions, limit_bits, watch, shared)
            return None if lifted is None else FirstRepresentation(chart, lifted, charts[:number], tried[:place])
    return None


@dataclass(frozen=True)
class FirstRepresentation:
    """A representation on the free coordinates of a chart, and what was tried before.

    Attributes
    ----------
    chart : tuple of 4 int
    univariate : UnivariateRepresentation
    charts, forms : sequence
        Charts that seem to miss a pose, and forms that seem to take a value twice.
    """

    chart: Chart
    univariate: UnivariateRepresentation
    charts: Sequence[Chart]
    forms: Sequence[Form]


def approximate_solutions(problem: ForwardProblem) -> Complex | None:
    """Solutions (e, f) in doubles, (p, 8), if the template is one for the problem and the numbers are long enough."""
    if expected_bits(problem, problem.solution_bound) < WORTHWHILE or not has_seeds(problem):
        return None
    try:
        found = seeds(problem)
    except OverflowError:
        return None
    return rational_coordinates(found.points, found.section)


def _represented(
    problem: ForwardProblem,
    points: Complex,
    form: Sequence[int],
    solutions: RefinedSolutions,
    limit_bits: int,
    watch: Callable[[int], None] | None,
    shared: PoseDenominators | None,
) -> UnivariateRepresentation | None:
    expected = expected_bits(problem, len(points))
    if expected < WORTHWHILE:
        return None
    refinement = _Refinement(
        solutions,
        [form[k] for k in solutions.equations.free],
        motion_quadrics(problem.metric)[-1],
        _margin(points, form),
        limit_bits,
        watch,
    )
    return _proposed(refinement, expected + expected // 16, shared)


def _separates(points: Complex, solutions: RefinedSolutions, form: Form) -> bool | None:
    """Whether a form seems to take as many values as there are solutions; None if values are too close to tell."""
    if _are_separated(points @ np.array(form, dtype=float)):
        return True
    with working_precision(FIRST_BITS):
        values = [acb(value_of([form[k] for k in solutions.equations.free], x)) for x in solutions.points]
        values += [acb(value.real, -value.imag) for value in values[solutions.count :]]
        distances = [_bits_below(a - b) for a, b in combinations(values, 2)]
    if any(SEPARATED < distance < SAME for distance in distances):
        return None
    return all(distance <= SEPARATED for distance in distances)


def _bits_below(value: acb) -> int:
    """About minus the binary logarithm of the size."""
    mantissa, exponent = value.abs_upper().man_exp()
    return -int(mantissa.bit_length() + exponent) if mantissa else FIRST_BITS


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
    """Solutions with more and more bits, and what follows from them in fixed point.

    Attributes
    ----------
    solutions : RefinedSolutions
    form : sequence of int
        On the free coordinates.
    norm : Quadric
        N(e).
    margin : int
        Coefficients have so many bits less behind the point than solutions.
    limit : int
    watch : callable, optional
    bits : int
        So many are right behind the point.
    """

    solutions: RefinedSolutions
    form: Sequence[int]
    norm: Quadric
    margin: int
    limit: int
    watch: Callable[[int], None] | None
    bits: int = 0

    @property
    def rotation(self) -> int:
        """How many of the coordinates are e's."""
        return sum(k < 4 for k in self.solutions.equations.free)

    def has(self, bits: int) -> bool:
        """Whether so many bits are right behind the point, after refinement if need be; not beyond the limit."""
        if bits + self.margin > self.limit:
            return False
        if bits > self.bits:
            self.solutions = self.solutions.refined(bits + self.margin)
            self.bits = bits
            if self.watch is not None:
                self.watch(bits + self.margin)
        return True

    def roots(self) -> list[arb | acb]:
        """The values of the form, one of each conjugate pair."""
        with working_precision(ROOT_BITS):
            return [value_of(self.form, x) for x in self.solutions.points]

    def relation(self) -> _Fixed:
        """The coefficients of h."""
        place = self.bits + self.margin
        whole = joined(root_factors(self.solutions, self.form, (), place), place)
        return _Fixed([*padded(whole.relation, whole.degree), fmpz(1) << place], place)

    def numerators(self, wanted: Sequence[int], bits: int) -> _Fixed:
        """The coefficients of some coordinates' numerators, one list after the other, with so many bits."""
        place = bits + self.margin
        whole = joined(root_factors(self.solutions, self.form, wanted, place), place)
        return _Fixed([value for each in whole.numerators for value in padded(each, whole.degree)], place)

    def samples(self, wanted: Sequence[int], relation: Sequence[fmpz]) -> _Fixed:
        """Some of these coefficients, without the others."""
        place = self.bits + self.margin
        second = (relation[-2] << place) // relation[-1]
        return _Fixed(leading_coefficients(self.solutions, self.form, wanted, second, place), place)

    def root_of_norms(self) -> arb | None:
        """(prod N(e))^(1/2); None if some N(e) is nearly 0."""
        return root_of_norms(self.solutions, self.norm, max(self.bits + self.margin, FIRST_BITS))


@dataclass(frozen=True)
class _Fixed:
    """Numbers times 2^place."""

    values: Sequence[fmpz]
    place: int

    def times(self, factor: fmpz | int) -> _Fixed:
        """All by an integer."""
        return _Fixed([value * factor for value in self.values], self.place)

    def times_fixed(self, factor: fmpz) -> _Fixed:
        """All by another such number."""
        return _Fixed([value * factor >> self.place for value in self.values], self.place)

    def fractions(self, bits: int) -> tuple[list[fmpz], int] | None:
        """Integers n_j and one d with the numbers n_j / d, if so many bits behind the point tell."""
        modulus = 1 << bits
        shift = self.place - bits
        found = common_fraction([(value >> shift) % modulus for value in self.values], modulus)
        if found is None:
            return None
        half = fmpz(1) << (self.place - 1)
        return [(value * found[1] + half) >> self.place for value in self.values], found[1]


def _proposed(refinement: _Refinement, bits: int, shared: PoseDenominators | None) -> UnivariateRepresentation | None:
    """The representation, from solutions that are refined until denominators are found.

    None as well if a point on the boundary of the rigid motions is among them: poses are wanted.
    """
    root = refinement.root_of_norms()
    if root is None:
        return None
    relation = None if shared is None else _relation_nearby(refinement, shared, root)
    boundary, scale = (None, 0) if relation is None or shared is None else (shared.boundary, shared.translation)
    if relation is None:
        relation = _relation(refinement, bits)
    if relation is None:
        return None
    if not scale:
        boundary, scale = _boundary(refinement, relation[-1]), _translation_scale(refinement, relation)
    count, last = refinement.rotation, len(refinement.form)
    first = _numerators(refinement, range(count), relation, 1)
    second = _numerators(refinement, range(count, last), relation, scale)
    if not scale or first is None or second is None:
        return None
    if shared is not None and shared.boundary is None:
        shared.boundary, shared.translation = boundary, second[1]
    leading, common = int(relation[-1]), lcm(first[1], second[1])
    lists = [[value * (common // scale) for value in values] for part, scale in (first, second) for values in part]
    found = from_common_fractions(refinement.form, relation, leading, lists, leading * common)
    return replace(found, near=refinement.roots())


def _relation_nearby(refinement: _Refinement, shared: PoseDenominators, root: arb) -> list[fmpz] | None:
    """h over Z by what is known from other lengths, with the bits that f will need; the root is (prod N(e))^(1/2)."""
    boundary = shared.boundary
    if boundary is None:
        return None
    size = arb(boundary.numerator) / (root * boundary.denominator)
    if not refinement.has(_bits_of(size) + shared.translation.bit_length() + SURE_BITS + FEW_BITS):
        return None
    place, finer = refinement.bits + refinement.margin, refinement.root_of_norms()
    if finer is None:
        return None
    with working_precision(place + SURE_BITS):
        leading = arb((boundary.numerator, place)) / (finer * boundary.denominator)
    relation = refinement.relation()
    found = relation.times_fixed(fixed(leading, 0)).fractions(SURE_BITS)
    return found[0] if found is not None and found[0][-1] > 0 else None


def _relation(refinement: _Refinement, bits: int) -> list[fmpz] | None:
    """h over Z; lattice reduction finds its leading coefficient."""
    for _ in range(ATTEMPTS):
        if not refinement.has(bits):
            return None
        found = refinement.relation().fractions(bits)
        if found is not None:
            return found[0]
        bits = int(GROWTH * bits)
    return None


def _numerators(
    refinement: _Refinement, wanted: Sequence[int], relation: Sequence[fmpz], scale: int
) -> tuple[list[list[fmpz]], int] | None:
    """The numerators of some coordinates times the leading coefficient of h, over one denominator, near ``scale``."""
    bits = int(relation[-1].bit_length()) + scale.bit_length() + SURE_BITS
    if not scale or not refinement.has(bits):
        return None
    found = refinement.numerators(wanted, bits).times(relation[-1] * scale).fractions(SURE_BITS)
    if found is None:
        return None
    size = len(relation) - 1
    return [found[0][start : start + size] for start in range(0, len(found[0]), size)], scale * found[1]


def _translation_scale(refinement: _Refinement, relation: Sequence[fmpz]) -> int:
    """What the numerators of f have as a denominator beyond the leading coefficient of h; 0 if it is not found."""
    translation = range(refinement.rotation, len(refinement.form))
    leading = relation[-1]
    length = int(leading.bit_length())

    def samples() -> _Fixed:
        return refinement.samples(translation, relation).times(leading)

    found = samples().fractions(refinement.bits - length)
    if found is not None:
        return found[1]
    boundary = _boundary(refinement, leading)
    if boundary is not None and refinement.has(length + boundary.numerator.bit_length() + SURE_BITS):
        found = samples().times(boundary.numerator).fractions(SURE_BITS)
        if found is not None:
            multiple = boundary.numerator * found[1]
            return multiple // gcd(multiple, *map(int, found[0]))
    if not refinement.has(length + length + length // LATTICE_RESIDUES + 2 * MARGIN_BITS):
        return 0
    found = samples().fractions(refinement.bits - length)
    return 0 if found is None else found[1]


def _boundary(refinement: _Refinement, leading: fmpz) -> Fraction | None:
    """The leading coefficient of h times (prod N(e))^(1/2), if that is a fraction with few bits below."""
    root = refinement.root_of_norms()
    if root is None:
        return None
    with working_precision(refinement.bits + refinement.margin):
        value = root * leading
    bits = _bits_of(value)
    if bits + SURE_BITS > refinement.bits:
        return None
    found = _Fixed([fixed(value, SURE_BITS)], SURE_BITS).fractions(SURE_BITS)
    if found is None:
        return None
    with working_precision(refinement.bits + refinement.margin):
        return Fraction(int(fixed(value * found[1] + arb(0.5), 0)), found[1])


def _bits_of(value: arb) -> int:
    """Before the point."""
    return int(fixed(value, 0).bit_length())

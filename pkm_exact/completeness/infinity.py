"""The points of a section of the variety of rigid motions at infinity, exactly, and how often they count at least.

Modulo a prime they come from the graded algebra of the boundary's section: where the dimension stays the same, products
with a form that vanishes at no point are invertible, and quotients of coordinates are matrices that commute. From their
traces follows the representation modulo the prime (``algebra.rur``); primes are joined until it is one over Q that
passes every check. What is returned is proved, whatever primes were used; that no point is missing is not needed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from random import Random

from flint import fmpz_poly, nmod_mat, nmod_poly

from pkm_exact.algebra.graded_quotient import Chosen, Degree, graded_parts
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.lifting import lift_by_primes
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.rur import ModularRepresentation, squarefree_part
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.rigid_motions import HORIZON, IntegerSection, Quadric, boundary_quadrics, variety_quadrics
from pkm_exact.completeness.shared_boundary import SharedBoundary
from pkm_exact.constraints.form import SIZE
from pkm_exact.digests import digest
from pkm_exact.errors import ReconstructionError

SETTLED = 3
"""Degree after which the dimension of a finite section hardly ever grows."""
LAST_DEGREE = 8
"""Of the graded algebra: a section that is not finite grows for ever."""
FEWEST_TERMS = 3
"""In charts and separating forms that are tried first."""
MOST_POINTS = 40
"""More than that many points, with multiplicity, are none of use: the section has no more, finite ones included."""
MISSES = 12
"""Primes without an image of the points, one after another, after which the first one is taken for unlucky."""
FEW = 3
"""Unknowns whose relations the quick way takes."""


@dataclass(frozen=True)
class PointsAtInfinity:
    """Points of the boundary on linear forms: z = Z(t) / h'(t) at the roots t of h, in a chart w.z = 1.

    Attributes
    ----------
    chart : tuple of 16 int
        w, on (|C|^2; u; C; R).
    univariate : UnivariateRepresentation
        On the same 16 coordinates.
    singular : int
        Number of those points at which the variety of rigid motions is singular.
    """

    chart: tuple[int, ...]
    univariate: UnivariateRepresentation
    singular: int

    @property
    def multiplicity(self) -> int:
        """Number of the points, singular ones counted twice: at least so often they count in the section."""
        return self.univariate.degree + self.singular


def points_at_infinity(
    conditions: Conditions,
    primes: Iterator[int],
    limit_bits: int,
    *,
    is_quick: bool = False,
    shared: SharedBoundary | None = None,
) -> PointsAtInfinity | None:
    """All points at infinity on the conditions, verified over Q; None if there are none or too many, or at a limit.

    Parameters
    ----------
    conditions : Conditions
    primes : iterator of int
        To compute with.
    limit_bits : int
        Of the product of the primes used.
    is_quick : bool
        Whether few relations are taken, which nearly always suffice.
    shared : SharedBoundary, optional
        Of robots with the same conditions at infinity; it gets the sections that are found.
    """
    known = [] if shared is None else shared.of(conditions).sections[is_quick]
    sections = _sections(conditions, primes, known, FEW if is_quick else None)
    section = next(sections)
    if section is None or not section.dimension:
        return None
    random = Random(conditions.digest)
    distinct = section.distinct
    for terms in range(FEWEST_TERMS, SIZE):
        chart = _random_form(random, terms)
        for _ in range(2):
            form = _random_form(random, terms)
            image = section.representation(chart, form)
            if image is not None and image.degree == distinct:
                return _lifted(conditions, sections, (chart, form, image), limit_bits)
    return None


def _sections(
    conditions: Conditions, primes: Iterator[int], known: list[_Section], first: int | None
) -> Iterator[_Section | None]:
    """Those that are known, and then at further primes, which become known."""
    yield from list(known)
    chosen: Chosen = {}
    boundary = IntegerSection.of(
        [*boundary_quadrics(conditions.metric), *conditions.quadrics], [*conditions.forms, HORIZON]
    )
    for prime in primes:
        section = _Section.at(boundary, prime, chosen, first)
        if section is not None:
            known.append(section)
        yield section


def _lifted(
    conditions: Conditions,
    sections: Iterator[_Section | None],
    start: tuple[tuple[int, ...], tuple[int, ...], ModularRepresentation],
    limit_bits: int,
) -> PointsAtInfinity | None:
    chart, form, first = start

    def images() -> Iterator[ModularRepresentation]:
        yield first
        misses = 0
        for section in sections:
            image = None if section is None else section.representation(chart, form)
            misses = 0 if image is not None else misses + 1
            if image is not None:
                yield image
            elif misses > MISSES:
                return

    try:
        found = lift_by_primes(form, images(), limit_bits, lambda found: is_at_infinity(chart, found, conditions))
    except (ReconstructionError, UnluckyPrimeError):
        return None
    return PointsAtInfinity(chart, found, singular_points(found, conditions.metric))


def is_at_infinity(chart: Sequence[int], found: UnivariateRepresentation, conditions: Conditions) -> bool:
    """Whether, exactly, the roots of h are distinct points of the variety at infinity that meet the conditions."""
    z = found.numerator_polynomials
    if _value(chart, z) != found.polynomial.derivative() or not (found.is_squarefree and found.is_separated):
        return False
    if any(_value(form[:-1], z) for form in conditions.forms):
        return False
    quadrics = (*variety_quadrics(conditions.metric), *conditions.quadrics)
    return all(found.vanishes(_quadric_value(quadric, z)) for quadric in quadrics)


def singular_points(found: UnivariateRepresentation, metric: tuple[int, int, int]) -> int:
    """At how many of the points the variety is singular: R = 0, or 2 C (G u)^T = |C|^2 R."""
    z = found.numerator_polynomials
    square, u, c, r = z[0], z[1:4], z[4:7], z[7:16]
    h = found.primitive_polynomial
    crossed, without = h, h
    for i in range(3):
        for j in range(3):
            entry = r[3 * i + j]
            crossed = crossed.gcd(2 * metric[j] * c[i] * u[j] - square * entry)
            without = without.gcd(entry)
    both = crossed.gcd(without)
    return int(crossed.degree() + without.degree() - both.degree())


def _value(form: Sequence[int], z: Sequence[fmpz_poly]) -> fmpz_poly:
    total = fmpz_poly()
    for coefficient, value in zip(form, z, strict=True):
        if coefficient:
            total += coefficient * value
    return total


def _quadric_value(quadric: Quadric, z: Sequence[fmpz_poly]) -> fmpz_poly:
    """The value where the last coordinate is 0."""
    total = fmpz_poly()
    for (i, j), coefficient in quadric.items():
        if j < SIZE - 1:
            total += coefficient * z[i] * z[j]
    return total


def _random_form(random: Random, terms: int) -> tuple[int, ...]:
    """A form with so many coefficients 1 or -1: the fewer, the shorter are the numbers of the representation."""
    places = random.sample(range(SIZE - 1), terms)
    return tuple(random.choice((-1, 1)) if place in places else 0 for place in range(SIZE - 1))


@dataclass(frozen=True)
class _Section:
    """The boundary on the forms, modulo a prime: products with unknowns from one degree to the next, both as large."""

    prime: int
    basis: nmod_mat
    part: Degree

    @classmethod
    def at(cls, boundary: IntegerSection, prime: int, chosen: Chosen, first: int | None) -> _Section | None:
        """None if the dimension does not settle."""
        reduced = boundary.modulo(prime)
        if reduced is None:
            return None
        basis, equations = reduced
        below = -1
        quadrics = [[int(value) for value in row] for row in equations.tolist()]
        for part in islice(graded_parts(basis.ncols(), quadrics, prime, chosen, first), LAST_DEGREE):
            if part.degree > 1 and part.dimension == below:
                return cls(prime, basis, part)
            if part.dimension > MOST_POINTS or (part.degree > SETTLED and part.dimension > below):
                return None
            below = part.dimension
        return cls(prime, basis, part) if part.dimension == 0 else None

    @property
    def dimension(self) -> int:
        """Number of points, with multiplicity, modulo the prime."""
        return self.part.dimension

    @property
    def distinct(self) -> int:
        """Number of points: the values of a form chosen at random."""
        random = Random(digest(self.prime, self.dimension))
        chart, form = ([random.randrange(self.prime) for _ in range(SIZE - 1)] for _ in range(2))
        image = self.representation(chart, form)
        return -1 if image is None else image.degree

    def representation(self, chart: Sequence[int], form: Sequence[int]) -> ModularRepresentation | None:
        """All 16 coordinates in the chart, by the values of the form; None if the chart misses a point."""
        scale = self._product(chart)
        if scale.rank() < self.dimension:
            return None
        inverse = scale.inv()
        matrix = self._product(form) * inverse
        eliminant = squarefree_part(matrix.charpoly())
        degree = int(eliminant.degree())
        traces = self._traces(matrix, [unknown * inverse for unknown in self.part.unknowns], degree)
        weighted = [(eliminant * nmod_poly(series[::-1], self.prime)).right_shift(degree) for series in traces]
        numerators = []
        for coordinate in range(SIZE - 1):
            total = nmod_poly([0], self.prime)
            for unknown, value in enumerate(weighted[1:]):
                if self.basis[coordinate, unknown]:
                    total += value * self.basis[coordinate, unknown]
            numerators.append(total)
        return ModularRepresentation(eliminant, weighted[0], tuple(numerators))

    def _traces(self, matrix: nmod_mat, values: Sequence[nmod_mat], count: int) -> list[list[int]]:
        """For 1 and every value the traces of its products with the first powers of a matrix."""
        size = self.dimension
        one = nmod_mat(size, size, [int(i == j) for i in range(size) for j in range(size)], self.prime)
        powers = [one]
        for _ in range(count - 1):
            powers.append(powers[-1] * matrix)
        left = nmod_mat(count, size**2, [entry for power in powers for entry in power.entries()], self.prime)
        columns = [value.transpose().entries() for value in (one, *values)]
        right = nmod_mat(len(columns), size**2, [entry for column in columns for entry in column], self.prime)
        table = left * right.transpose()
        return [[int(table[power, index]) for power in range(count)] for index in range(len(columns))]

    def _product(self, form: Sequence[int]) -> nmod_mat:
        """Products with a form on the 16 coordinates."""
        total = nmod_mat(self.dimension, self.dimension, self.prime)
        for unknown, matrix in enumerate(self.part.unknowns):
            weight = sum(c * int(self.basis[j, unknown]) for j, c in enumerate(form) if c) % self.prime
            if weight:
                total += matrix * weight
        return total

"""The poses of a formulated problem modulo a prime, as elements of its quotient algebra."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count, islice
from random import Random
from typing import Final

from flint import fmpq_mpoly, nmod_mat

from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.quotient import QuotientAlgebra
from pkm_exact.algebra.rur import ModularRepresentation, distinct_values, modular_representation
from pkm_exact.algebra.system import modular_image
from pkm_exact.formulations.base import FormulatedProblem, integer_multiple
from pkm_exact.geometry.study import translation_coordinates
from pkm_exact.poses.study_equations import Chart, dependent_coordinate

Form = tuple[int, ...]
"""Coefficients of a linear form on the Study coordinates (e0, .., e3, f0, .., f3)."""

COMMON_CHOICES: Final = 2
"""Random charts, and pairs of forms, that are tried with every robot, before those that follow from its own data."""


@dataclass(frozen=True)
class ModularPoses:
    """Study coordinates in the quotient algebra of a formulation, modulo one prime.

    Attributes
    ----------
    formulated : FormulatedProblem
    algebra : QuotientAlgebra
        Of the first branch, with the conditions joined: every solution is a pose.
    metric : tuple of 3 int
        Gram diagonal.
    """

    formulated: FormulatedProblem
    algebra: QuotientAlgebra
    metric: tuple[int, int, int]

    @property
    def count(self) -> int:
        """Number of poses with multiplicity.

        Raises
        ------
        UnluckyPrimeError
            If the solutions do not fall into poses.
        """
        number, rest = divmod(self.algebra.dimension, self.formulated.fibre)
        if rest:
            raise UnluckyPrimeError(f"modulo {self.algebra.prime} not every pose is covered equally often")
        return number

    @cached_property
    def position(self) -> tuple[nmod_mat, ...]:
        """The three elements C_i."""
        return tuple(self._element(value) for value in self.formulated.pose_map.position)

    @cached_property
    def _products(self) -> tuple[tuple[nmod_mat, ...], ...]:
        products = self.formulated.pose_map.quaternion_products
        elements = {(k, m): self._element(products[k][m]) for k in range(4) for m in range(k, 4)}
        return tuple(tuple(elements[min(k, m), max(k, m)] for m in range(4)) for k in range(4))

    def quaternion(self, chart: Chart) -> tuple[nmod_mat, ...] | None:
        """The four elements e_k with w.e = 1, or None if some pose has w.e = 0 modulo the prime."""
        scaled = [_combination(chart, [row[k] for row in self._products]) for k in range(4)]
        denominator = self.algebra.matrix(_combination(chart, scaled))
        if denominator.rank() < self.algebra.dimension:
            return None
        inverse = denominator.inv()
        return tuple(value * inverse for value in scaled)

    def coordinates(self, chart: Chart) -> tuple[nmod_mat, ...] | None:
        """(e0, .., e3, f0, .., f3) in a chart, or None if the chart misses a pose."""
        quaternion = self.quaternion(chart)
        if quaternion is None:
            return None
        products = [[value * matrix for value in quaternion] for matrix in map(self.algebra.matrix, self.position)]
        return (*quaternion, *translation_coordinates(products, self.metric))

    def distinct_poses(self, coordinates: Sequence[nmod_mat], seed: int) -> int:
        """Number of distinct poses: the values of a random combination of all coordinates."""
        random = Random(seed)
        weights = [random.randrange(1, self.algebra.prime) for _ in coordinates]
        return distinct_values(self.algebra, _combination(weights, coordinates))

    def representation(
        self, coordinates: Sequence[nmod_mat], form: Form, wanted: Sequence[int]
    ) -> ModularRepresentation:
        """The representation of the wanted coordinates by the values of a form."""
        return modular_representation(
            self.algebra, _combination(form, coordinates), [coordinates[index] for index in wanted]
        )

    def _element(self, polynomial: fmpq_mpoly) -> nmod_mat:
        return _element(self.formulated, self.algebra, polynomial)


def modular_poses(
    formulated: FormulatedProblem, algebra: QuotientAlgebra | None, metric: tuple[int, int, int]
) -> ModularPoses | None:
    """The poses among the solutions of the first branch; None if there are infinitely many solutions.

    Raises
    ------
    UnluckyPrimeError
        If the prime divides a denominator.
    """
    if algebra is None:
        return None
    for condition in formulated.conditions:
        if algebra.dimension == 0:  # no solution is left that could meet it or not
            break
        algebra = algebra.quotient_by(_element(formulated, algebra, condition))
    return ModularPoses(formulated, algebra, metric)


def _element(formulated: FormulatedProblem, algebra: QuotientAlgebra, polynomial: fmpq_mpoly) -> nmod_mat:
    branch = formulated.branches[0]
    cleared, denominator = integer_multiple(branch.unknowns, polynomial)
    image = modular_image(cleared, branch.monomials, algebra.prime)
    if denominator % algebra.prime == 0:
        raise UnluckyPrimeError(f"a coordinate of the poses has the denominator {algebra.prime}")
    return algebra.element(image) * pow(denominator, -1, algebra.prime)


def candidate_charts(seed: int, own: int) -> Iterator[Chart]:
    """Charts to try: the coordinate ones, then random ones, first by ``seed``, then by the robot's ``own``.

    The last non-zero weight is 1.

    Examples
    --------
    >>> from itertools import islice
    >>> list(islice(candidate_charts(0, 1), 4))
    [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)]
    """
    yield from ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
    for random, size, number in ((Random(seed), 9, COMMON_CHOICES), (Random(own), 99, None)):
        for _ in count() if number is None else range(number):
            x, y, z = (random.randrange(-size, size + 1) for _ in range(3))
            yield x, y, z, 1


def common_charts(seed: int) -> list[Chart]:
    """Those of the charts that are tried with every robot."""
    return list(islice(candidate_charts(seed, seed), 4 + COMMON_CHOICES))


def common_forms(chart: Chart, seed: int) -> list[Form]:
    """Those of the forms that are tried with every robot."""
    return list(islice(candidate_forms(chart, seed, seed), 3 + 2 * COMMON_CHOICES - 1))


def candidate_forms(chart: Chart, seed: int, own: int) -> Iterator[Form]:
    """Separating forms to try: quaternion coordinates, which give the shortest eliminants, then random combinations.

    These are drawn first by ``seed``, then by the robot's ``own``. The coordinate that the chart determines gets
    coefficient 0.
    """
    free = [k for k in range(4) if k != dependent_coordinate(chart)]
    for k in reversed(free):
        yield tuple(int(index == k) for index in range(8))
    random = Random(seed)
    for number in count():
        if number == COMMON_CHOICES:
            random = Random(own)
        for indices in (free, [*free, 4, 5, 6, 7]):
            form = [0] * 8
            for index in indices:
                form[index] = random.randrange(-3 - 2 * number, 4 + 2 * number)
            if any(form):
                yield tuple(form)


def _combination(scalars: Sequence[int], values: Sequence[nmod_mat]) -> nmod_mat:
    total = values[0] * scalars[0]
    for scalar, value in zip(scalars[1:], values[1:], strict=True):
        if scalar:
            total += value * scalar
    return total

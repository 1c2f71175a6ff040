"""The points at infinity of a system, where they are finitely many, and what they leave of a bound by degrees."""

from __future__ import annotations

from random import Random

from pkm_exact.algebra.groebner import OutOfReachError
from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.errors import ReconstructionError
from pkm_exact.policy import Policy
from pkm_exact.systems.bezout import product_of_degrees, total_degrees
from pkm_exact.systems.regularity import derivatives, has_full_rank, total_weight, weights_at
from pkm_exact.systems.solution_search import SolutionSearch
from pkm_exact.systems.system_solution import InfinitePoints
from pkm_exact.systems.top_forms import homogeneous, is_finite_in_space, terms_of, top_form

_LARGEST = 99


def with_room_left(system: PolynomialSystem, weight: int, policy: Policy) -> tuple[InfinitePoints, int] | None:
    """The points at infinity, and how many finite solutions they leave room for, with multiplicity.

    None if they are infinitely many or not found, or leave less than the weight of solutions that are known.
    """
    size = len(system.unknowns)
    bound = product_of_degrees(total_degrees(system), size)
    if bound is None or not weight < bound <= policy.dimension_limit or not is_finite_in_space(system, policy):
        return None
    ring = polynomial_ring(system.unknowns)
    random = Random(policy.seed_for(system.digest, "chart at infinity"))
    chart = tuple(random.randrange(1, _LARGEST) for _ in range(size))
    plane = sum((w * x for w, x in zip(chart, ring.gens(), strict=True)), ring.constant(-1))
    tops = [ring.from_dict(dict(top_form(terms_of(polynomial)))) for polynomial in system.polynomials]
    try:
        found = SolutionSearch(PolynomialSystem(system.unknowns, (*tops, plane)), policy).found()
    except (OutOfReachError, ReconstructionError):
        return None
    if found.representation is None:
        return None
    points = InfinitePoints(chart, found.representation, 0)
    multiplicity = infinite_weight(system, points, policy)
    if weight + multiplicity > bound:
        return None
    return InfinitePoints(chart, found.representation, multiplicity), bound - multiplicity


def infinite_weight(system: PolynomialSystem, points: InfinitePoints, policy: Policy) -> int:
    """The sum of the weights of points at infinity: the rows of the homogeneous Jacobian, and the chart's."""
    size = len(system.unknowns)
    names = ("_", *system.unknowns)
    ring = polynomial_ring(names)
    table = derivatives([ring.from_dict(dict(homogeneous(f))) for f in system.polynomials], size + 1)
    table.append([ring.constant(value) for value in (0, *points.chart)])
    found = points.univariate
    placed = UnivariateRepresentation((0, *found.form), found.eliminant, ((), *found.numerators))
    if has_full_rank(table, placed, policy):
        return placed.degree
    return total_weight(weights_at(table, placed, policy, square=len(system.polynomials) == size))

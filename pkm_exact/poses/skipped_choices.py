"""Charts and separating forms that a search by primes passes over, told from a representation over Q.

The search takes the first chart that misses no pose modulo a prime, and the first form with as many values as poses.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import nmod_mat, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.digests import digest
from pkm_exact.poses.modular import Form
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.study_equations import Chart


def are_passed_over(representation: PoseRepresentation, charts: Sequence[Chart], forms: Sequence[Form]) -> bool:
    """Whether each of the charts misses a pose, and none of the forms separates all, modulo a prime.

    Parameters
    ----------
    representation : PoseRepresentation
        Verified.
    charts : sequence of chart
    forms : sequence of form
    """
    if not charts and not forms:
        return True
    univariate = representation.univariate
    leading = univariate.eliminant[-1]
    prime = next(prime for prime in primes_from(digest(univariate.eliminant), 62) if leading % prime)
    relation = nmod_poly(univariate.polynomial, prime)
    values = [nmod_poly(numerator, prime) for numerator in univariate.numerator_polynomials]
    unit = relation.derivative().xgcd(relation)[1]
    if any(_value(chart, values[:4]).gcd(relation).degree() == 0 for chart in charts):
        return False
    return not any(_are_distinct(_value(form, values) * unit % relation, relation) for form in forms)


def _value(form: Sequence[int], values: Sequence[nmod_poly]) -> nmod_poly:
    total = values[0] * 0
    for coefficient, value in zip(form, values, strict=True):
        total += value * coefficient
    return total


def _are_distinct(value: nmod_poly, relation: nmod_poly) -> bool:
    """Whether a polynomial has different values at the roots of the relation."""
    size, prime = int(relation.degree()), int(relation.modulus())
    rows, power = [], value
    for _ in range(size):
        entries = power.coeffs()
        rows.append([int(entry) for entry in entries] + [0] * (size - len(entries)))
        power = power.left_shift(1) % relation
    found = nmod_mat(size, size, [entry for row in rows for entry in row], prime).charpoly()
    return bool(found.gcd(found.derivative()).degree() == 0)

"""Points of a mechanism at infinity: that they lie there, on the motions, and how often they count. All exact.

The closure X of the rigid motions in P^16 meets the hyperplane where the last coordinate, the 1, is 0. A point there is
z = Z(t) / h'(t) at a root t of the eliminant h. X is singular exactly where R = 0, or 2 C (G u)^T = s R; an isolated
point of the section counts twice at least there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from itertools import combinations_with_replacement
from math import gcd
from typing import Any

from flint import fmpz_poly

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.mechanism_document import Infinity
from pkm_exact.certify.checker.mechanism_forms import Mechanism, cleared
from pkm_exact.certify.checker.solutions import modulo, primitive_part, proved_coprime, vanishes
from pkm_exact.certify.checker.study_motion import Metric, combination
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER, rejected


def check_infinity(infinity: Infinity, mechanism: Mechanism) -> Iterator[str]:
    """The points are distinct, lie at infinity on all forms, quadrics and motions, and count as said."""
    h, z = infinity.eliminant, infinity.coordinates
    bits = max(int(value.height_bits()) for value in (h, *z))
    charge(6 * 400 * int(h.degree() + 1) ** 2 * limbs(2 * bits))
    if h.degree() > GREATEST_NUMBER:
        raise rejected(f"infinity: more than {GREATEST_NUMBER} points, all that there can be")
    if h.leading_coefficient() < 0 or gcd(*(int(value.content()) for value in (h, *z))) != 1:
        raise rejected("infinity: not in lowest terms with positive leading coefficient")
    h0, slope = primitive_part(h), h.derivative()
    if not proved_coprime(h0, lambda p: modulo(h0.derivative(), p)):
        raise rejected("infinity: the eliminant is not proved squarefree")
    if any(value.degree() >= h.degree() for value in z):
        raise rejected("infinity: a numerator has not a smaller degree than the eliminant")
    if combination(infinity.chart, z) != slope:
        raise rejected("infinity: w.z is not 1 at the roots of the eliminant")
    if combination(infinity.separating_form, z) != fmpz_poly([0, 1]) * slope - h.degree() * h:
        raise rejected("infinity: the values of the separating form are not the roots of the eliminant")
    if any(combination(cleared(form)[:-1], z) for form in mechanism.linear):
        raise rejected("infinity: a point is not on all constraints")
    if not all(vanishes(value, h0) for value in _quadrics(z, mechanism.metric)):
        raise rejected("infinity: a point is not one of the closure of the rigid motions")
    doubled = _singular(z, h0, mechanism.metric)
    if infinity.multiplicity != h.degree() + doubled:
        raise rejected(f"infinity: {infinity.multiplicity} claimed, {h.degree()} points count {h.degree() + doubled}")
    yield f"infinity: {h.degree()} points, {doubled} of them singular on the motions, count {infinity.multiplicity}"


def _parts(z: Sequence[Any]) -> tuple[Any, list[Any], list[Any], list[list[Any]]]:
    """|C|^2, u, C and R."""
    return z[0], list(z[1:4]), list(z[4:7]), [list(z[7 + 3 * i : 10 + 3 * i]) for i in range(3)]


def _quadrics(z: Sequence[fmpz_poly], metric: Metric) -> Iterator[fmpz_poly]:
    """What vanishes on the closure at infinity, multiplied by the metric where it divides.

    R = a b^T then, with isotropic a and b, C and u are multiples of a and G^-1 b or R is 0: no further quadric of the
    motions says more.
    """
    _, u, c, r = _parts(z)
    g = metric
    volume = g[0] * g[1] * g[2]
    yield combination(g, [value * value for value in c])
    for i, j in combinations_with_replacement(range(3), 2):
        yield combination(g, [r[k][i] * r[k][j] for k in range(3)])
        yield combination([volume // value for value in g], [r[i][k] * r[j][k] for k in range(3)])
    for i in range(3):
        yield combination((1, 1, 1), [r[i][j] * u[j] for j in range(3)])
        yield combination(g, [r[j][i] * c[j] for j in range(3)])
    yield combination(g, [value * value for value in u])


def _singular(z: Sequence[fmpz_poly], h0: fmpz_poly, metric: Metric) -> int:
    """The number of roots of h0 at which X is singular."""
    s, u, c, r = _parts(z)
    turning = [2 * metric[j] * (c[i] * u[j]) - s * r[i][j] for i in range(3) for j in range(3)]
    at_cone = _common(h0, turning)
    at_centre = _common(h0, [entry for row in r for entry in row])
    return int(at_cone.degree() + at_centre.degree() - at_cone.gcd(at_centre).degree())


def _common(h0: fmpz_poly, values: Sequence[fmpz_poly]) -> fmpz_poly:
    """The greatest common divisor of h0 and some polynomials, over Q."""
    return reduce(lambda common, value: common.gcd(value), values, h0)

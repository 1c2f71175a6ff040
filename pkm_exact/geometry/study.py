"""Poses as points of the Study quadric, in a Gram metric: eight rational homogeneous coordinates, every leg a quadric.

A pose (C, R) has the coordinates (e0, .., e3, f0, .., f3) up to scale. e gives the rotation (``geometry.rotation``),
and f the translation,

    f0 = -(g1 C1 e1 + g2 C2 e2 + g3 C3 e3)
    f_i = g_i e0 C_i + C_j e_k - C_k e_j,   (i, j, k) = (1, 2, 3), (2, 3, 1), (3, 1, 2)

so that e0 f0 + e1 f1 + e2 f2 + e3 f3 = 0 (Study's condition). For G = I, f = C e as quaternions, twice the usual dual
part. Then N(e) times each of

    |C|^2;  u = R^-1 C;  C;  R;  1

is a quadratic form in (e, f), and every leg is linear in these 17 quantities (``leg_form``), hence a quadric.
References: Study, Geometrie der Dynamen (1903); Husty, "An algorithm for solving the direct kinematics of general
Stewart-Gough platforms", Mech. Mach. Theory 31 (1996).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import permutations
from math import lcm
from typing import Any

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC

Quadric = dict[tuple[int, int], int]
"""Coefficients of the products x_k x_l, k <= l, of the eight coordinates x = (e, f)."""

PLANAR_SUPPORT = (0, 3, 5, 6)
"""The Study coordinates e0, e3, f1, f2 of planar motions; the others are 0, and Study's condition holds by itself."""

STUDY_CONDITION: Quadric = {(0, 4): 1, (1, 5): 1, (2, 6): 1, (3, 7): 1}


def translation_coordinates(products: Sequence[Sequence[Any]], metric: Sequence[int]) -> list[Any]:
    """f0..f3 from the products ``products[i][k] = C_i e_k`` (i = 0..2, k = 0..3), in any ring.

    Examples
    --------
    >>> translation_coordinates([[c * e for e in (1, 0, 0, 0)] for c in (5, 6, 7)], (1, 1, 1))
    [0, 5, 6, 7]
    """
    g1, g2, g3 = metric
    coordinates = [-1 * (g1 * products[0][1] + g2 * products[1][2] + g3 * products[2][3])]
    for i, j, k in CYCLIC:
        coordinates.append(metric[i] * products[i][0] + products[j][k + 1] - products[k][j + 1])
    return coordinates


def motion_quadrics(metric: Sequence[int]) -> list[Quadric]:
    """N(e) times (|C|^2; u1, u2, u3; C1, C2, C3; r11, r12, .., r33; 1) as quadratic forms in (e, f).

    Examples
    --------
    >>> motion_quadrics((1, 1, 1))[-1]
    {(0, 0): 1, (1, 1): 1, (2, 2): 1, (3, 3): 1}
    """
    g = metric
    volume = g[0] * g[1] * g[2]
    square = {(4, 4): 1} | {(5 + i, 5 + i): volume // g[i] for i in range(3)}
    turned: list[Quadric] = []
    position: list[Quadric] = []
    for i, j, k in CYCLIC:
        common = {(0, 5 + i): g[j] * g[k], (1 + i, 4): -1}
        turned.append(common | {(1 + j, 5 + k): -g[j], (1 + k, 5 + j): g[k]})
        position.append(common | {(1 + j, 5 + k): g[j], (1 + k, 5 + j): -g[k]})
    rotation: dict[tuple[int, int], Quadric] = {}
    for i, j, k in CYCLIC:
        rotation[i, i] = {(0, 0): volume, (1 + i, 1 + i): g[i], (1 + j, 1 + j): -g[j], (1 + k, 1 + k): -g[k]}
    for i, j, k in permutations(range(3)):
        sign = -1 if (i, j, k) in CYCLIC else 1
        rotation[i, j] = {(1 + min(i, j), 1 + max(i, j)): 2 * g[j], (0, 1 + k): 2 * sign * g[j] * g[k]}
    norm = {(0, 0): volume} | {(1 + i, 1 + i): g[i] for i in range(3)}
    return [square, *turned, *position, *(rotation[i, j] for i in range(3) for j in range(3)), norm]


def leg_form(leg: Distance, metric: Sequence[int]) -> list[int]:
    """Integer coefficients of a leg on (|C|^2; u; C; R; 1), cleared of denominators; dots with G:

    |C|^2 + 2 B.u - 2 A.C - 2 A.(R B) + |A|^2 + |B|^2 - l^2

    Examples
    --------
    >>> half, zero = Fraction(1, 2), Fraction(0)
    >>> leg_form(Distance((half, zero, zero), (zero, zero, zero), Fraction(1)), (1, 1, 1))
    [4, 0, 0, 0, -4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -3]
    """
    row = [Fraction(1)]
    row += [2 * g * b for g, b in zip(metric, leg.platform, strict=True)]
    row += [-2 * g * a for g, a in zip(metric, leg.base, strict=True)]
    row += [-2 * metric[i] * leg.base[i] * leg.platform[j] for i in range(3) for j in range(3)]
    squares = sum((g * (a * a + b * b) for g, a, b in zip(metric, leg.base, leg.platform, strict=True)), Fraction(0))
    row.append(squares - leg.length_squared)
    denominator = lcm(*(value.denominator for value in row))
    return [int(value * denominator) for value in row]


def leg_quadric(leg: Distance, metric: Sequence[int]) -> Quadric:
    """A leg as a quadratic form in (e, f): it vanishes at the poses in which the leg has its length."""
    quadric: Quadric = {}
    for coefficient, form in zip(leg_form(leg, metric), motion_quadrics(metric), strict=True):
        for key, value in form.items():
            quadric[key] = quadric.get(key, 0) + coefficient * value
    return {key: value for key, value in quadric.items() if value}


def support(problem: ForwardProblem) -> tuple[int, ...]:
    """Indices of the Study coordinates that are not 0 for every pose of the problem."""
    return problem.motion.support


def pose_quadrics(problem: ForwardProblem) -> list[Quadric]:
    """Quadratic forms in (e, f) that vanish at the poses, and with the support at nothing else with N(e) not 0."""
    return list(_pose_quadrics(problem))


@lru_cache(maxsize=4)
def _pose_quadrics(problem: ForwardProblem) -> tuple[Quadric, ...]:
    """The same; every step of a solve asks for them."""
    legs = [leg_quadric(leg, problem.metric) for leg in problem.distances]
    support = set(problem.motion.support)
    condition = [STUDY_CONDITION] if problem.motion.has_study_condition else []
    kept = [{key: value for key, value in quadric.items() if set(key) <= support} for quadric in (*condition, *legs)]
    return tuple(quadric for quadric in kept if quadric)


def evaluate(quadric: Quadric, products: Sequence[Sequence[Any]]) -> Any:
    """The value of a non-zero quadratic form from the products ``products[k][l] = x_k x_l``, k <= l, in any ring."""
    terms = iter(quadric.items())
    (k, m), coefficient = next(terms)
    total = products[k][m] * coefficient
    for (k, m), coefficient in terms:
        total = total + products[k][m] * coefficient
    return total

"""Poses as points of the Study quadric, in a Gram metric: eight rational homogeneous coordinates, constraints quadrics.

A pose (C, R) has the coordinates (e0, .., e3, f0, .., f3) up to scale. e gives the rotation (``geometry.rotation``),
and f the translation,

    f0 = -(g1 C1 e1 + g2 C2 e2 + g3 C3 e3)
    f_i = g_i e0 C_i + C_j e_k - C_k e_j,   (i, j, k) = (1, 2, 3), (2, 3, 1), (3, 1, 2)

so that e0 f0 + e1 f1 + e2 f2 + e3 f3 = 0 (Study's condition). For G = I, f = C e as quaternions, twice the usual dual
part. Then N(e) times each of

    |C|^2;  u = R^-1 C;  C;  R;  1

is a quadratic form in (e, f), and what is linear in these 17 quantities (``constraints.form``) is a quadric.
References: Study, Geometrie der Dynamen (1903); Husty, "An algorithm for solving the direct kinematics of general
Stewart-Gough platforms", Mech. Mach. Theory 31 (1996).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import permutations, product
from typing import Any

from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.constraints.form import integral
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC

Quadric = dict[tuple[int, int], int]
"""Coefficients of the products x_k x_l, k <= l, of the eight coordinates x = (e, f)."""

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
    return [dict(quadric) for quadric in _motion_quadrics(tuple(metric))]


@lru_cache(maxsize=8)
def _motion_quadrics(g: tuple[int, ...]) -> tuple[Quadric, ...]:
    """The same, not to be changed."""
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
    return (square, *turned, *position, *(rotation[i, j] for i in range(3) for j in range(3)), norm)


def form_quadric(form: Sequence[int], metric: Sequence[int]) -> Quadric:
    """A linear form on rigid motions, with integer coefficients, as a quadratic form in (e, f).

    Examples
    --------
    >>> from pkm_exact.constraints.form import SIZE
    >>> form_quadric([0] * (SIZE - 1) + [1], (1, 1, 1)) == motion_quadrics((1, 1, 1))[-1]
    True
    """
    quadric: Quadric = {}
    for coefficient, values in zip(form, _motion_quadrics(tuple(metric)), strict=True):
        if coefficient:
            for key, value in values.items():
                quadric[key] = quadric.get(key, 0) + coefficient * value
    return {key: value for key, value in quadric.items() if value}


@dataclass(frozen=True)
class Quartic:
    """The form weight N(e) linear - factor root^2 of degree 4 in (e, f): a cylinder.

    Attributes
    ----------
    linear, root : Quadric
    weight, factor : int
    """

    linear: Quadric
    root: Quadric
    weight: int
    factor: int

    def value(self, linear: Any, root: Any, norm: Any) -> Any:
        """Its value from those of the quadratic forms and of N(e), in any ring."""
        return norm * linear * self.weight - root * root * self.factor


def support(problem: ForwardProblem) -> tuple[int, ...]:
    """Indices of the Study coordinates that are not 0 for every pose of the problem."""
    return problem.motion.support


def pose_quadrics(problem: ForwardProblem) -> list[Quadric]:
    """Quadratic forms in (e, f) that vanish at the poses.

    Together with ``pose_quartics``, and with the support, they vanish at nothing else with N(e) not 0.
    """
    return [*_pose_quadrics(problem)[0], *_pose_quadrics(problem)[1]]


def linear_quadrics(problem: ForwardProblem) -> list[Quadric]:
    """Those of them that linear forms on rigid motions give, and Study's condition: none is a cylinder."""
    return list(_pose_quadrics(problem)[0])


def pose_quartics(problem: ForwardProblem) -> list[Quartic]:
    """The cylinders that are no quadratic forms in (e, f)."""
    return list(_pose_quadrics(problem)[2])


@lru_cache(maxsize=64)
def _pose_quadrics(problem: ForwardProblem) -> tuple[tuple[Quadric, ...], tuple[Quadric, ...], tuple[Quartic, ...]]:
    """The same; every step of a solve asks for them."""
    kept = set(problem.motion.support)

    def restricted(quadric: Quadric) -> Quadric:
        return quadric if len(kept) == 8 else {key: value for key, value in quadric.items() if set(key) <= kept}

    condition = [restricted(STUDY_CONDITION)] if problem.motion.has_study_condition else []
    linear = [restricted(form_quadric(integral(form), problem.metric)) for form in problem.forms]
    cylinders, quartics = [], []
    norm = restricted(motion_quadrics(problem.metric)[-1])
    for square in problem.squares:
        quartic = _quartic(square, problem.metric, restricted)
        quotient = _quotient(quartic, norm)
        if quotient is None:
            quartics.append(quartic)
        else:
            cylinders.append(quotient)
    return tuple(filter(None, (*condition, *linear))), tuple(filter(None, cylinders)), tuple(quartics)


def _quartic(square: SquareForm, metric: Sequence[int], restricted: Callable[[Quadric], Quadric]) -> Quartic:
    """The quartic of a quadric linear - factor root^2 on rigid motions, over the integers."""
    linear, root, weight, factor = square.over_integers()
    return Quartic(restricted(form_quadric(linear, metric)), restricted(form_quadric(root, metric)), weight, factor)


def _quotient(quartic: Quartic, norm: Quadric) -> Quadric | None:
    """The quartic divided by e0^2, where that is a factor: of translations, whose only quaternion coordinate is e0."""
    if set(norm) != {(0, 0)} or any(0 not in key for key in quartic.root):
        return None
    root = {key[1]: value for key, value in quartic.root.items()}
    quotient = {key: value * norm[0, 0] * quartic.weight for key, value in quartic.linear.items()}
    for (k, left), (m, right) in product(root.items(), root.items()):
        key = min(k, m), max(k, m)
        quotient[key] = quotient.get(key, 0) - quartic.factor * left * right
    return {key: value for key, value in quotient.items() if value}


def evaluate(quadric: Quadric, products: Sequence[Sequence[Any]]) -> Any:
    """The value of a non-zero quadratic form from the products ``products[k][l] = x_k x_l``, k <= l, in any ring."""
    terms = iter(quadric.items())
    (k, m), coefficient = next(terms)
    total = products[k][m] * coefficient
    for (k, m), coefficient in terms:
        total = total + products[k][m] * coefficient
    return total

"""The translation of a pose from its rotation: differences of legs are linear in it.

In Study coordinates (e, f) a linear constraint is c S(f) + (bilinear in e and f) + (quadratic in e), with the same form
S for all of them, c = 0 for planes, and Study's condition is bilinear. Differences that cancel S, planes and Study's
condition are linear equations M(e) f = m(e). Where M(e) has full rank they give f, modulo a prime in the ring of all
rotations at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from random import Random

from flint import nmod_poly

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, linear_quadrics, support


@dataclass(frozen=True)
class LinearTranslation:
    """As many combinations of the linear equations as there are unknowns f.

    Attributes
    ----------
    chart : tuple of 4 int
        w; coordinates are scaled so that w.e = 1.
    dependent : int
        Index of the coordinate of weight 1 that the chart determines.
    rotation : tuple of int
        Indices of the free coordinates e.
    unknowns : tuple of int
        Indices of the coordinates f that are not 0 for every pose.
    equations : tuple of Quadric
        The combinations: forms of bidegree (1, 1) and (2, 0) in (e, f).
    """

    chart: tuple[int, int, int, int]
    dependent: int
    rotation: tuple[int, ...]
    unknowns: tuple[int, ...]
    equations: tuple[Quadric, ...]

    @property
    def known(self) -> int:
        """Number of coordinates that the others are found from."""
        return len(self.rotation)

    def modulo(self, eliminant: nmod_poly, numerators: Sequence[nmod_poly]) -> list[nmod_poly] | None:
        """The numerators of f over h' modulo a prime from those of the free e, or None if M(e) is not a unit there."""
        e = self._rotation(eliminant.derivative(), numerators)
        products = {(k, m): e[k] * e[m] for k in e for m in e if k <= m}
        matrix, right = [], []
        for equation in self.equations:
            row = dict.fromkeys(self.unknowns, eliminant * 0)
            constant = eliminant * 0
            for (k, m), coefficient in equation.items():
                if m < 4:
                    constant -= products[k, m] * coefficient
                else:
                    row[m] += e[k] * coefficient
            matrix.append(list(row.values()))
            right.append(constant % eliminant)
        return _solution(matrix, right, eliminant)

    def _rotation(self, slope: nmod_poly, numerators: Sequence[nmod_poly]) -> dict[int, nmod_poly]:
        e = dict(zip(self.rotation, numerators, strict=True))
        value = slope
        for k, numerator in e.items():
            value = value - numerator * self.chart[k]
        return e | {self.dependent: value}


def linear_translation(
    problem: ForwardProblem, chart: tuple[int, int, int, int], dependent: int, seed: int
) -> LinearTranslation | None:
    """Random combinations of the linear equations; None if there are fewer equations than unknowns, or no unknowns."""
    coordinates = support(problem)
    unknowns = tuple(k for k in coordinates if k >= 4)
    if not unknowns:
        return None
    rotation = tuple(k for k in coordinates if k < 4 and k != dependent)
    square = (unknowns[0], unknowns[0])
    forms = linear_quadrics(problem)
    legs = [form for form in forms if square in form]
    linear = [form for form in forms if square not in form]
    linear += [_combination((legs[0][square], -leg[square]), (leg, legs[0])) for leg in legs[1:]]
    if len(linear) < len(unknowns):
        return None
    random = Random(seed)
    equations = [_combination([random.randrange(1, 1 << 16) for _ in linear], linear) for _ in unknowns]
    return LinearTranslation(chart, dependent, rotation, unknowns, tuple(equations))


def _combination(weights: Sequence[int], forms: Sequence[Quadric]) -> Quadric:
    total: Quadric = {}
    for weight, form in zip(weights, forms, strict=True):
        for key, value in form.items():
            total[key] = total.get(key, 0) + weight * value
    return {key: value for key, value in total.items() if value}


def _solution(matrix: list[list[nmod_poly]], right: list[nmod_poly], relation: nmod_poly) -> list[nmod_poly] | None:
    """The solution of a square linear system modulo ``relation``, by elimination; None if a pivot is not a unit."""
    size = len(right)
    for k in range(size):
        divisor, inverse, _ = matrix[k][k].xgcd(relation)
        if divisor.degree() != 0:
            return None
        matrix[k] = [value * inverse % relation for value in matrix[k][k + 1 :]]
        right[k] = right[k] * inverse % relation
        for i in range(k + 1, size):
            factor = matrix[i][k]
            row = matrix[i]
            row[k + 1 :] = [
                (value - factor * above) % relation for value, above in zip(row[k + 1 :], matrix[k], strict=True)
            ]
            right[i] = (right[i] - factor * right[k]) % relation
    for k in range(size - 2, -1, -1):
        total = right[k]
        for value, known in zip(matrix[k], right[k + 1 :], strict=True):
            total = total - value * known
        right[k] = total % relation
    return right

"""The Jacobian of a problem: for every constraint the derivative along a twist of the platform, exactly or in balls.

A row has as many entries as the platform has freedoms (``motions.motion.Motion.twist``). Of a quadric L - k M^2 it is
the wrench of L, less 2 k M times that of M. The pose is regular where the rows have full rank: as the constraints are
equations on a manifold of that dimension, it is then isolated and simple.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat

from pkm_exact.balls import ball
from pkm_exact.constraints.form import Form, integral, ordinary, rational_wrench, value_at, wrench
from pkm_exact.geometry.problem import ForwardProblem

_ORDINARY = (1, 1, 1)


def exact_rows(problem: ForwardProblem, quantities: Sequence[Any], scalar: Callable[[int], Any]) -> list[list[Any]]:
    """The rows in rational coordinates over a ring, of integer multiples of the constraints.

    Over a field in which N(e) and the metric are not 0 their rank is that of the Jacobian, or less where a multiple is
    0.

    Parameters
    ----------
    problem : ForwardProblem
    quantities : sequence of 17
        N(e) times (|C|^2; u; C; R; 1) at the pose (``geometry.study.motion_quadrics``). Columns of forces are
        multiplied by N(e), those of moments by its square.
    scalar : callable
        The ring's element that an integer is; it can be divided by the numbers of the metric.
    """
    position, norm = quantities[4:7], quantities[16]
    rotation = [quantities[7 + 3 * i : 10 + 3 * i] for i in range(3)]

    def row(form: Sequence[int]) -> list[Any]:
        values = [scalar(value) for value in form]
        homogeneous = [*values[:4], *(norm * value for value in values[4:16]), values[16]]
        found = rational_wrench(homogeneous, position, rotation, problem.metric)
        return [found[k] for k in problem.motion.twist]

    rows = [row(integral(form)) for form in problem.forms]
    for square in problem.squares:
        linear, root, weight, factor = square.over_integers()
        value = norm * scalar(root[16])
        for coefficient, quantity in zip(root[:16], quantities[:16], strict=True):
            value = value + quantity * scalar(coefficient)
        slope, pairs = value * scalar(-2 * factor), zip(row(linear), row(root), strict=True)
        rows.append([norm * scalar(weight) * left + slope * right for left, right in pairs])
    return rows


class BallRows:
    """The rows in ordinary coordinates, as balls at the precision in force: unit forces, moments divided by a length.

    Parameters
    ----------
    problem : ForwardProblem
    length : Fraction
        Makes turns comparable to translations.
    """

    def __init__(self, problem: ForwardProblem, length: Fraction) -> None:
        self._twist, self._per_length = problem.motion.twist, arb(length.denominator) / length.numerator
        roots = [arb(g).sqrt() for g in problem.metric]

        def balls(form: Form) -> list[arb]:
            return ordinary([ball(value) for value in form], roots)

        self._forms, self._squares = [], []
        forms = iter(problem.forms)
        for found in problem.constraints:
            squares = found.squares(problem.metric)
            scales = [ball(scale).rsqrt() for scale in found.scales(problem.metric, length)]
            linear = len(scales) - len(squares)
            self._forms += [(balls(next(forms)), scale) for scale in scales[:linear]]
            for square, scale in zip(squares, scales[linear:], strict=True):
                self._squares.append((balls(square.linear), balls(square.root), ball(square.factor), scale))

    def at(self, position: Sequence[arb], rotation: Sequence[Sequence[arb]]) -> arb_mat:
        """The Jacobian at a pose: a row for every form, then for every quadric."""
        rows = [self._row(wrench(form, position, rotation), scale) for form, scale in self._forms]
        for linear, root, factor, scale in self._squares:
            value = 2 * factor * value_at(root, position, rotation, _ORDINARY)
            pairs = zip(wrench(linear, position, rotation), wrench(root, position, rotation), strict=True)
            rows.append(self._row([left - value * right for left, right in pairs], scale))
        return arb_mat(rows)

    def _row(self, found: Sequence[arb], scale: arb) -> list[arb]:
        parts = [value * scale for value in found[:3]] + [value * scale * self._per_length for value in found[3:]]
        return [parts[k] for k in self._twist]


def least_multiplicity(problem: ForwardProblem, rank: int) -> int:
    """A lower bound of the multiplicity of an isolated pose from the rank of the Jacobian there.

    Let c be the freedoms that are lost. Equations with independent derivatives, as many as the rank, define a smooth
    manifold of dimension c; the others, combined with them, have derivative 0 on it. If there are c others, the
    multiplicity is 2^c at least (Fulton, Intersection Theory, 12.4). If there are more, it is 1 + c at least: they lie
    in the square of the maximal ideal.

    Examples
    --------
    >>> least_multiplicity(ForwardProblem(()), 6)
    1
    """
    lost = problem.motion.dimension - rank
    return 1 << lost if problem.equation_count == problem.motion.dimension else 1 + lost

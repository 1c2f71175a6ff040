"""Jacobians at poses where doubles do not suffice, as near singular ones: with entries that are sums of two doubles.

N(e) times an entry is a quadratic form in Study coordinates x = (e, f), so that it is known as well as x is, which is
far better than as a double. With C = f e* / N and R d = e d e* / N, products of quaternions and e* the conjugate,

    C x (R d) = (C R d - R d C) / 2 = (f d e* + e d f*) / (2 N),

by Study's condition. So the rows of a Jacobian, (2 c_s C + R c_u + c_C; (R c_u) x C + sum_j R_j x c_Rj), are linear in
22 values of forms that are the same for all robots: N times 1, C, R, and 2 C x R_k. The singular values are those of
``double_jacobians``, the smallest of them from more exact products. For the metric (1, 1, 1).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cache, partial
from math import isqrt
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.form import SIZE, Form
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import Quadric, motion_quadrics
from pkm_exact.numeric.double_forms import DoubleForms
from pkm_exact.numeric.double_jacobians import decided
from pkm_exact.numeric.double_krawczyk import DoubleSolution
from pkm_exact.numeric.double_poses import forms_at, second_derivatives, study_points
from pkm_exact.numeric.double_rounding import LARGE, OUTWARD, SMALL, U, gamma, two_product, two_sum, twofold_sums
from pkm_exact.numeric.quaternions import quaternion_product
from pkm_exact.numeric.study_system import Real
from pkm_exact.poses.leg_jacobian import LegJacobian

BITS: Final = 200
"""Of the coefficients, before they are rounded to two doubles."""
LEAST_BITS: Final = 120
"""Of a factor of coefficients, at least: it is then off by 2^-119 of itself at most."""
TERMS: Final = 9
"""Values that an entry of a Jacobian is a sum of, at most."""

Twofold = tuple[Real, Real, Real]
"""Heads and tails, whose sums are meant, and how far these are off at most."""


def fine_jacobians(
    problem: ForwardProblem,
    solutions: Sequence[DoubleSolution],
    support: Sequence[int],
    length: Fraction,
    each: Sequence[ForwardProblem] | None = None,
) -> list[LegJacobian | None]:
    """The Jacobians at these poses; None where pairs of doubles do not decide them.

    Parameters
    ----------
    problem : ForwardProblem
    solutions : sequence of DoubleSolution
    support : sequence of int
        Which of the eight Study coordinates they have.
    length : Fraction
        Makes turns comparable to translations.
    each : sequence of ForwardProblem, optional
        That of each pose, where it is not the same for all: of one robot, with other lengths.
    """
    size = problem.motion.dimension
    if problem.metric != (1, 1, 1) or problem.equation_count != size or problem.squares or not solutions:
        return [None] * len(solutions)
    with np.errstate(all="ignore"):
        try:
            values = _values(study_points(solutions, support))
            jacobians = _entries(
                _of_each([problem] if each is None else each, length), values, list(problem.motion.twist)
            )
            norm = values[0][:, 0]
            is_good = (np.abs(jacobians[0]) < LARGE).all(axis=(1, 2)) & np.isfinite(jacobians[2]).all(axis=(1, 2))
            is_good &= (np.abs(values[0]) < LARGE).all(axis=1) & (values[2][:, 0] < U * norm)
            head, tail, bound = jacobians
            head[~is_good], tail[~is_good], bound[~is_good] = np.eye(size), 0.0, 1.0
            found = decided(head, np.abs(tail) + bound, length, partial(_product, jacobians), norm)
        except (OverflowError, np.linalg.LinAlgError):
            return [None] * len(solutions)
    return [entry if good else None for entry, good in zip(found, is_good.tolist(), strict=True)]


@cache
def _forms() -> tuple[DoubleForms, Real]:
    """The 22 forms, 2 C x R_k row by row, and their second derivatives, (22, 8, 8)."""
    motion = motion_quadrics((1, 1, 1))
    crosses = [_crossed(axis) for axis in range(3)]
    quadrics = [motion[16], *motion[4:16], *(crosses[k][i] for i in range(3) for k in range(3))]
    return DoubleForms.of(quadrics), second_derivatives(quadrics)


def _values(place: tuple[Real, Real, Real]) -> Twofold:
    """(p, 22) each: the forms at points p - d, given with how far these are off."""
    first, second, off = forms_at(*_forms(), place)
    return *two_sum(first, second), off


def _crossed(axis: int) -> list[Quadric]:
    """The three forms of f d e* + e d f*, with d the unit vector of an axis."""
    unit = [[int(i == j) for j in range(4)] for i in range(4)]
    quadrics: list[Quadric] = [{} for _ in range(3)]
    for i, left in enumerate(unit):
        turned = quaternion_product(left, unit[axis + 1])
        for j, right in enumerate(unit):
            values = quaternion_product(turned, [right[0], *(-value for value in right[1:])])[1:]
            for quadric, value in zip(quadrics, values, strict=True):
                for place in ((j, 4 + i), (i, 4 + j)):
                    quadric[place] = quadric.get(place, 0) + value
    return [{place: value for place, value in quadric.items() if value} for quadric in quadrics]


@cache
def _places() -> tuple[NDArray[np.intp], NDArray[np.intp], Real]:
    """For each entry of a row, (6, 9) each: which of the values, times which coefficient of a form, times what."""
    values, coefficients = np.zeros((2, 6, TERMS), dtype=np.intp)
    factors = np.zeros((6, TERMS))
    for i, j, k in CYCLIC:
        axes = range(3)
        force = [(0, 4 + i, 1.0), (1 + i, 0, 2.0), *((4 + 3 * i + axis, 1 + axis, 1.0) for axis in axes)]
        moment = [(13 + 3 * i + axis, 1 + axis, -0.5) for axis in axes]
        moment += [(4 + 3 * j + axis, 7 + 3 * k + axis, 1.0) for axis in axes]
        moment += [(4 + 3 * k + axis, 7 + 3 * j + axis, -1.0) for axis in axes]
        for row, terms in ((i, force), (3 + i, moment)):
            for place, (value, coefficient, factor) in enumerate(terms):
                values[row, place], coefficients[row, place], factors[row, place] = value, coefficient, factor
    return values, coefficients, factors


def _of_each(problems: Sequence[ForwardProblem], length: Fraction) -> Twofold:
    """(p, m, 6, 9) each: the coefficients for each problem, of which neighbours may be the same."""
    found = {id(problem): problem for problem in problems}
    tables = {key: _coefficients(problem, length) for key, problem in found.items()}
    first, second, off = (np.stack([tables[id(problem)][part] for problem in problems]) for part in range(3))
    return first, second, off


def _coefficients(problem: ForwardProblem, length: Fraction) -> Twofold:
    """(m, 6, 9) each: what the values are multiplied with.

    Integers n, in units of 2^-b, are rounded to two doubles, which is off by u^2 of them; they were rounded down twice.
    """
    scales = [scale for found in problem.constraints for scale in found.scales(problem.metric, length)]
    rows, shifts = zip(
        *(_scaled(form, scale, length) for form, scale in zip(problem.forms, scales, strict=True)), strict=True
    )
    heads = [[float(value) for value in row] for row in rows]
    tails = [
        [float(value - int(head)) if value else 0.0 for value, head in zip(*pair, strict=True)]
        for pair in zip(rows, heads, strict=True)
    ]
    tables = np.ldexp(np.array([heads, tails, np.full(np.shape(heads), 2.0)]), -np.array(shifts)[:, None])
    tables[2] += 2 * U * U * np.abs(tables[0])
    _, places, factors = _places()
    chosen = tables[:, :, np.arange(6)[:, None] // 3 * (SIZE - 1) + places] * factors
    return chosen[0], chosen[1], np.abs(chosen[2])


def _scaled(form: Form, scale: Fraction, length: Fraction) -> tuple[list[int], int]:
    """The coefficients divided by the root of the scale, and then by the length too, times 2^b, as integers; b.

    With T = 2^b / root, rounded down, T c is rounded down; 0 stands for what no entry is made of.
    """
    shift = BITS + max(0, scale.numerator.bit_length() - scale.denominator.bit_length()) // 2
    root = isqrt((scale.denominator << 2 * shift) // scale.numerator)
    turning = root * length.denominator // length.numerator
    if min(root, turning).bit_length() < LEAST_BITS:
        raise OverflowError("numbers of very different sizes")
    numbers = [(value.numerator, value.denominator) for value in form[:-1]]
    force = [a * root // b for a, b in numbers[:7]]
    moment = [a * turning // b for a, b in (*numbers[1:4], *numbers[7:])]
    return [*force, *[0] * 9, 0, *moment[:3], *[0] * 3, *moment[3:]], shift


def _entries(coefficients: Twofold, values: Twofold, moving: list[int]) -> Twofold:
    """(p, m, n) each: the Jacobians times N, from coefficients for each pose, or one for all.

    With a the coefficients, a' their tails, and so on, a v = p + e exactly, and a term is p + (e + a v' + a' v): what
    is left out or rounded is below 12 u^2 |p|, for nine terms less than 12 u^2 sigma (``twofold_sums``).
    """
    places = _places()[0][moving]
    a, a_tail, a_off = (part[:, :, moving] for part in coefficients)
    v, v_tail, v_off = (part[:, None, places] for part in values)
    terms, rest = two_product(*np.broadcast_arrays(a, v))
    head, tail, bound = twofold_sums(terms, rest + a * v_tail + a_tail * v)
    sizes = np.abs(a)
    off = (sizes * v_off + a_off * (np.abs(v) + v_off)).sum(axis=-1)
    return *two_sum(head, tail), (3 * bound + off) * OUTWARD + SMALL


def _product(jacobians: Twofold, left: Real, right: Real) -> tuple[Real, Real]:
    """u^T A v for each matrix, and how far it is off at most.

    With u v = w + w' exactly, and w a = p + e, a term is p + (e + w a' + w' a), as above.
    """
    head, tail, bound = jacobians
    w, w_tail = two_product(*np.broadcast_arrays(left[:, :, None], right[:, None, :]))
    terms, rest = two_product(w, head)
    rows = (part.reshape(len(head), -1) for part in (terms, rest + w * tail + w_tail * head))
    first, second, off = twofold_sums(*rows)
    value: Real = first + second
    around = (np.abs(w) * (1 + gamma(1)) * bound).sum(axis=(1, 2))
    return value, (3 * off + around + U * np.abs(value)) * OUTWARD + SMALL

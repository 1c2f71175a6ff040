"""Platforms that turn about a point, held by linear forms: nets of quadrics in (e0, .., e3) through given jets."""

from __future__ import annotations

import json
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations_with_replacement
from typing import Any

from flint import fmpq_mat
from mechanism_certificates import made

from pkm_exact.constraints.linear import LinearForm
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SPHERICAL

Jet = Sequence[Sequence[int]]
"""Coefficients of a curve e(t): a quadric vanishes on it to this order."""
_PAIRS = list(combinations_with_replacement(range(4), 2))
_SQUARES = ((1, 1, 1, 1), (1, 1, -1, -1), (1, -1, 1, -1), (1, -1, -1, 1))
"""4 e_k^2 / N as a combination of 1, r11, r22 and r33."""
_CROSSED = {1: ((3, 2), (2, 3)), 2: ((1, 3), (3, 1)), 3: ((2, 1), (1, 2))}
"""4 e_0 e_k / N is a difference of two entries of R."""


def _conditions(jet: Jet) -> list[list[int]]:
    """What they ask of the coefficients of a quadric."""
    return [
        [sum(jet[m][i] * jet[order - m][j] for m in range(order + 1)) for i, j in _PAIRS] for order in range(len(jet))
    ]


def _form(quadric: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """A quadric as a linear form on motions."""
    form = [Fraction(0)] * 17

    def add(value: Fraction, i: int, j: int) -> None:
        form[7 + 3 * (i - 1) + (j - 1)] += value / 4

    for (i, j), value in zip(_PAIRS, quadric, strict=True):
        if i == j:
            form[16] += value * _SQUARES[i][0] / 4
            for k in (1, 2, 3):
                add(value * _SQUARES[i][k], k, k)
        elif i == 0:
            plus, minus = _CROSSED[j]
            add(value, *plus)
            add(-value, *minus)
        else:
            add(value, i, j)
            add(value, j, i)
    return tuple(form)


def through(*jets: Jet) -> ForwardProblem:
    """The mechanism whose poses are the common points of the quadrics through some jets, seven conditions in all."""
    kernel, rank = fmpq_mat([row for jet in jets for row in _conditions(jet)]).rref()
    pivots = [next(j for j in range(len(_PAIRS)) if kernel[i, j]) for i in range(rank)]
    forms = []
    for free in (j for j in range(len(_PAIRS)) if j not in pivots):
        quadric = [Fraction(int(j == free)) for j in range(len(_PAIRS))]
        for i, pivot in enumerate(pivots):
            quadric[pivot] = -Fraction(int(kernel[i, free].p), int(kernel[i, free].q))
        forms.append(LinearForm(_form(quadric)))
    return ForwardProblem(tuple(forms), motion=SPHERICAL)


@cache
def _triple_and_double() -> bytes:
    triple = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))
    double = ((1, 1, 2, 3), (0, 1, -1, 1))
    return made(lambda: through(triple, double, [(0, 1, 0, 2)], [(1, 0, -1, 1)]))


def triple_and_double() -> dict[str, Any]:
    """A triple pose, a double one and three simple ones."""
    content: dict[str, Any] = json.loads(_triple_and_double())
    del content["digest"]
    return content

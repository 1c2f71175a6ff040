"""Speeds of actuators where an equation has several of them, or an actuator several equations.

All equations are W t = R q'. A choice S of as many equations as actuators with R_S regular gives q' = J t,
J = R_S^-1 W_S, and what the other equations demand of the twist alone is (W_r - R_r J) t = 0. Rows are *apart* in this
form: each actuator has its own, with rate 1, and no actuator enters the others. Which S is taken changes nothing in J
on the twists that are allowed; at a pose where one choice is singular another one may be regular.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.radicals import RootSum
from pkm_exact.statics.actuated_equations import Held
from pkm_exact.statics.ball_rows import BallRow
from pkm_exact.statics.exact_rows import ExactRow
from pkm_exact.statics.ranks import proved_rank, root_sum_rank


def exact_rates(rows: Sequence[ExactRow], places: Sequence[int], count: int) -> list[list[RootSum]]:
    """The rows of R at these places, so many columns."""
    return [[rows[place].rates.get(k, RootSum()) for k in range(count)] for place in places]


def ball_rates(rows: Sequence[BallRow], places: Sequence[int], count: int) -> list[list[arb]]:
    """The same in balls."""
    return [[rows[place].rates.get(k, arb(0)) for k in range(count)] for place in places]


def regular_choice(held: Held, exact: Sequence[ExactRow] | None, balls: Sequence[BallRow]) -> Held:
    """The machine with equations for its actuators whose R is regular at a pose, if those that it has are not.

    As it is, if they are, or no others are found; in balls a choice is taken if it is proved to be regular.
    """
    count = len(held.actuators)
    if held.is_redundant or not count or not held.is_entangled:
        return held
    own = [actuator.equation for actuator in held.actuators]
    entered = [index for index, equation in enumerate(held.equations) if equation.rates]
    if exact is not None:
        if root_sum_rank(exact_rates(exact, own, count)) == count:
            return held
        chosen: list[int] = []
        for place in [*own, *(index for index in entered if index not in own)]:
            if root_sum_rank(exact_rates(exact, [*chosen, place], count)) > len(chosen):
                chosen.append(place)
    else:
        if proved_rank(arb_mat(ball_rates(balls, own, count))) == count:
            return held
        chosen = _far_from_singular(ball_rates(balls, entered, count), entered)
        if len(chosen) == count and proved_rank(arb_mat(ball_rates(balls, chosen, count))) < count:
            return held
    return held.given_by(chosen) if len(chosen) == count else held


def _far_from_singular(rates: list[list[arb]], places: Sequence[int]) -> list[int]:
    """Places of a minor that is large in floating point."""
    left = np.array([[float(entry.mid()) for entry in row] for row in rates])
    if not np.isfinite(left).all():
        return []
    found = []
    for _ in range(min(left.shape)):
        r, c = np.unravel_index(np.argmax(np.abs(left)), left.shape)
        if left[r, c] == 0:
            break
        found.append(places[int(r)])
        left = left - np.outer(left[:, c], left[r, :]) / left[r, c]
        left[r, :] = left[:, c] = 0
    return found


def exact_rows_apart(held: Held, rows: Sequence[ExactRow]) -> tuple[ExactRow, ...] | None:
    """Rows apart at an exact pose; None where R_S is singular, or quotients are out of reach."""
    own, count = [actuator.equation for actuator in held.actuators], len(held.actuators)
    try:
        given = solved(exact_rates(rows, own, count), [rows[place].wrench for place in own])
        if given is None:
            return None
        found = []
        for index, row in enumerate(rows):
            if index in own:
                place = own.index(index)
                wrench, rates = tuple(given[place]), {place: RootSum.of(1)}
            else:
                wrench, rates = _without(row.wrench, row.rates, given), {}
            found.append(replace(row, wrench=wrench, rates=rates))
    except InputError:
        return None
    return tuple(found)


def solved(matrix: Sequence[Sequence[RootSum]], right: Sequence[Sequence[Any]]) -> list[list[Any]] | None:
    """A^-1 B by Gauss and Jordan over sums of square roots; None if A is singular.

    Examples
    --------
    >>> from fractions import Fraction
    >>> two = RootSum.root(Fraction(2))
    >>> print(*solved([[two, RootSum()], [two, two]], [[two], [Fraction(0)]]))
    [RootSum(terms=((1, Fraction(1, 1)),))] [RootSum(terms=((1, Fraction(-1, 1)),))]
    """
    count = len(matrix)
    left = [[*map(RootSum.of, row), *map(RootSum.of, rest)] for row, rest in zip(matrix, right, strict=True)]
    for column in range(count):
        pivot = min(
            (r for r in range(column, count) if left[r][column].terms),
            key=lambda r: len(left[r][column].terms),
            default=None,
        )
        if pivot is None:
            return None
        left[column], left[pivot] = left[pivot], left[column]
        inverse = left[column][column].inverse()
        left[column] = [value * inverse for value in left[column]]
        for r in range(count):
            factor = left[r][column]
            if r != column and factor.terms:
                left[r] = [x - factor * y for x, y in zip(left[r], left[column], strict=True)]
    return [row[count:] for row in left]


def ball_rows_apart(held: Held, rows: Sequence[BallRow]) -> tuple[BallRow, ...] | None:
    """Rows apart in balls, at the precision in force; None where R_S is or may be singular."""
    own, count = [actuator.equation for actuator in held.actuators], len(held.actuators)
    try:
        matrix = arb_mat(ball_rates(rows, own, count)).solve(arb_mat([list(rows[place].wrench) for place in own]))
    except ZeroDivisionError:
        return None
    given, found = matrix.tolist(), []
    for index, row in enumerate(rows):
        if index in own:
            place = own.index(index)
            found.append(BallRow(tuple(given[place]), {place: arb(1)}))
        else:
            found.append(BallRow(_without(row.wrench, row.rates, given), {}))
    return tuple(found)


def _without(wrench: Sequence[Any], rates: Mapping[int, Any], given: Sequence[Sequence[Any]]) -> tuple[Any, ...]:
    """W_r - R_r J."""
    found = list(wrench)
    for actuator, rate in rates.items():
        found = [x - rate * y for x, y in zip(found, given[actuator], strict=True)]
    return tuple(found)

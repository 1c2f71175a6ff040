"""The wrenches of constraints at an exact pose, one row each, and the twists of the platform that they leave."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector, rational_wrench, value_at
from pkm_exact.geometry.inverse import Matrix, Metric
from pkm_exact.motions.motion import Motion
from pkm_exact.screws.exact_matrix import Row, null_space
from pkm_exact.screws.screw import cross


def wrench_rows(constraint: Constraint, metric: Metric, position: Vector, rotation: Matrix) -> tuple[Row, ...]:
    """The derivatives of a constraint along twists of the platform, in rational coordinates (v; w).

    Of a quadric L = k M^2 it is the wrench of L less 2 k M times that of M.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.geometry.inverse import rotation_of
    >>> zero = (Fraction(0),) * 3
    >>> turn = rotation_of((Fraction(1), *zero))
    >>> (row,) = wrench_rows(Distance(zero, zero, Fraction(9)), (1, 1, 1), (Fraction(3), *zero[:2]), turn)
    >>> [int(value) for value in row]
    [6, 0, 0, 0, 0, 0]
    """
    rows = [tuple(rational_wrench(form, position, rotation, metric)) for form in constraint.forms(metric)]
    for square in constraint.squares(metric):
        slope = 2 * square.factor * Fraction(value_at(square.root, position, rotation, metric))
        pairs = zip(
            rational_wrench(square.linear, position, rotation, metric),
            rational_wrench(square.root, position, rotation, metric),
            strict=True,
        )
        rows.append(tuple(one - slope * other for one, other in pairs))
    return tuple(rows)


def within(rows: Iterable[Row], motion: Motion) -> list[Row]:
    """The components along the twists of a group of motions."""
    return [tuple(row[k] for k in motion.twist) for row in rows]


def twists_left(rows: Sequence[Row], motion: Motion, metric: Metric, position: Vector) -> tuple[Row, ...]:
    """A basis of the twists of a group that wrenches do no work on, as (s; G v) for ``screws.free_motions``.

    Wrenches are given for the velocity of the platform's origin, at ``position``, and for turns W with the entries W_kj
    = g_j w_i. Their axis has the direction s_i = g_j g_k w_i in the coordinates of the file, and G v becomes G v + C x
    s for the velocity of the point at the origin.
    """
    found = []
    for free in null_space(within(rows, motion), len(motion.twist)):
        twist = [Fraction(0)] * 6
        for place, value in zip(motion.twist, free, strict=True):
            twist[place] = value
        turn = [value * (metric[0] * metric[1] * metric[2] // g) for g, value in zip(metric, twist[3:], strict=True)]
        moment = [g * value for g, value in zip(metric, twist[:3], strict=True)]
        found.append((*turn, *(m + shift for m, shift in zip(moment, cross(position, turn), strict=True))))
    return tuple(found)

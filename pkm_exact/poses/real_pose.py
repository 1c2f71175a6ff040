"""Whether a robot has a real pose at all, decided exactly where that is elementary.

One point. If the joints of one side lie in one point, that point has known distances from the joints of the other side,
and the rotation is free. With y its place from joint P_0, seen in the frame of the P_i, and d_i = P_i - P_0,

    2 d_i.y = |d_i|^2 - l_i^2 + l_0^2,    |y|^2 = l_0^2.

The first equations give the part of y in the span of the d_i, rationally; the rest of y is perpendicular to it and its
square is a rational number q. So there is a real pose iff q is not negative (and 0 if nothing is perpendicular).

Two legs. Joints A_i, A_j and their ends B_i, B_j are the corners of a quadrilateral with four known sides, and none is
longer than the other three together.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations

from flint import arb, fmpq_mat

from pkm_exact.balls import ball
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.formulations.base import rational
from pkm_exact.geometry.inverse import Metric, dot
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.precision import working_precision

PRECISION = 256
"""Bits with which sides of a quadrilateral are compared."""


def has_real_point(joints: Sequence[Vector], squares: Sequence[Fraction], metric: Metric) -> bool:
    """Whether some real point has given distances from the joints, if some complex one does.

    Examples
    --------
    >>> joints = [tuple(map(Fraction, joint)) for joint in ((0, 0, 0), (4, 0, 0), (0, 4, 0))]
    >>> [has_real_point(joints, [Fraction(square)] * 3, (1, 1, 1)) for square in (7, 8, 9)]
    [False, True, True]
    """
    shifts = [_difference(joint, joints[0]) for joint in joints]
    chosen = _independent(shifts)
    if not chosen:
        return True
    rows = [shifts[k] for k in chosen]
    sides = [(dot(shifts[k], shifts[k], metric) - squares[k] + squares[0]) / 2 for k in chosen]
    gram = fmpq_mat([[rational(dot(a, b, metric)) for b in rows] for a in rows])
    right = fmpq_mat([[rational(side)] for side in sides])
    square = (right.transpose() * gram.solve(right))[0, 0]
    return bool(rational(squares[0]) >= square)


def _difference(left: Vector, right: Vector) -> Vector:
    x, y, z = (a - b for a, b in zip(left, right, strict=True))
    return x, y, z


def _independent(vectors: Sequence[Vector]) -> list[int]:
    """Places of vectors that are a basis of what all of them span."""
    chosen: list[int] = []
    for place in range(len(vectors)):
        tried = [*chosen, place]
        if fmpq_mat([[rational(x) for x in vectors[k]] for k in tried]).rank() == len(tried):
            chosen = tried
    return chosen


def are_out_of_reach(problem: ForwardProblem) -> bool:
    """Whether two legs are proved to have no real places: one side of their quadrilateral is too long.

    "No" does not mean that there is a real pose.
    """
    with working_precision(PRECISION):
        return any(_is_open(*pair, problem.metric) for pair in combinations(problem.distances, 2))


def _is_open(first: Distance, second: Distance, metric: Metric) -> bool:
    squares = [first.length_squared, second.length_squared]
    for a, b in ((first.base, second.base), (first.platform, second.platform)):
        side = _difference(a, b)
        squares.append(dot(side, side, metric))
    sides = [ball(square).sqrt() for square in squares]
    return any(2 * side > sum(sides, arb(0)) for side in sides)

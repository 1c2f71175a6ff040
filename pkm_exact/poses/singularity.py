"""The exact rank of the leg Jacobian at the roots of an irreducible factor of the eliminant.

The leg lines (d, b x d), with d = C + R B - A the leg and b = R B its arm, are computed in the field Q[T] / f. There
every element is 0 or a unit, so that elimination decides each entry. Rational coordinates change the columns by
factors other than 0; a planar robot has three lines with three coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import lcm

from flint import fmpq_poly, fmpz_poly

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import evaluate, motion_quadrics
from pkm_exact.poses.representation import PoseRepresentation


def jacobian_rank(representation: PoseRepresentation, problem: ForwardProblem, factor: fmpz_poly) -> int:
    """Rank of the leg Jacobian at every root of an irreducible factor of h, exactly."""
    modulus = fmpq_poly(factor)
    x = [fmpq_poly(numerator) % modulus for numerator in representation.univariate.numerator_polynomials]
    products = [[left * right % modulus if m >= k else left for m, right in enumerate(x)] for k, left in enumerate(x)]
    values = [evaluate(quadric, products) for quadric in motion_quadrics(problem.metric)]
    position, rotation, norm = values[4:7], [values[7 + 3 * i : 10 + 3 * i] for i in range(3)], values[16]
    joints = [value for leg in problem.legs for value in (*leg.base, *leg.platform)]
    scale = lcm(*(value.denominator for value in joints))
    rows = []
    for leg in problem.legs:
        base = [int(value * scale) for value in leg.base]
        platform = [int(value * scale) for value in leg.platform]
        arm = [row[0] * platform[0] + row[1] * platform[1] + row[2] * platform[2] for row in rotation]
        line = [c * scale + a - norm * b for c, a, b in zip(position, arm, base, strict=True)]
        moment = [(arm[j] * line[k] - arm[k] * line[j]) % modulus for _, j, k in CYCLIC]
        rows.append([line[0], line[1], moment[2]] if problem.planar else [*line, *moment])
    return _rank(rows, modulus)


def _rank(rows: Sequence[Sequence[fmpq_poly]], modulus: fmpq_poly) -> int:
    """Rank of a matrix over the field Q[T] / modulus."""
    left = [list(row) for row in rows]
    rank = 0
    for column in range(len(rows[0])):
        pivot = next((row for row in left if not (row[column] % modulus).is_zero()), None)
        if pivot is None:
            continue
        rank += 1
        left.remove(pivot)
        inverse = (pivot[column] % modulus).xgcd(modulus)[1]
        for row in left:
            ratio = row[column] * inverse % modulus
            for index in range(column, len(row)):
                row[index] = (row[index] - ratio * pivot[index]) % modulus
    return rank

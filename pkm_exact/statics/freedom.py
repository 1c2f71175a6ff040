"""J on the twists that the constraints allow, scaled: what indices and polytopes are computed from.

Constraints that are not actuated, W_s t = R_s q', leave the twists with (W_s - R_s J) t = 0; B is a basis of them. With
no such constraint B is the unit matrix. Turns are measured by a length L, (v, L w), and actuators by greatest speeds,
if they are given.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import gcd, lcm
from typing import Any

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.exact_rows import column_squares
from pkm_exact.statics.pose_rows import PoseRows
from pkm_exact.statics.ranks import pivots, proved_rank, rationalised


@dataclass(frozen=True)
class Directions:
    """The rows of J, exactly: each is a positive weight times a row of integers, in rational coordinates.

    Attributes
    ----------
    rows : tuple of tuples of int
    weights : tuple of RootSum
    squares : tuple of Fraction
        k_j: ordinary wrenches are sqrt(k_j) times the rational ones, ordinary twists the rational ones by sqrt(k_j).
    """

    rows: tuple[tuple[int, ...], ...]
    weights: tuple[RootSum, ...]
    squares: tuple[Fraction, ...]


@dataclass(frozen=True, eq=False)
class Freedom:
    """J of a machine at a pose, on the twists that its constraints allow.

    Attributes
    ----------
    at : PoseRows
    """

    at: PoseRows

    def __post_init__(self) -> None:
        if self.at.jacobian is None:
            raise InputError(
                "statics: there is no J at this pose; give actuators, or a pose without type-1 singularity"
            )

    @property
    def has_both(self) -> bool:
        """Whether translations and turns both are among the motions: norms of twists then need a length."""
        places = self.at.motion.twist
        return any(k < 3 for k in places) and any(k >= 3 for k in places)

    @property
    def units(self) -> set[str]:
        """Of the actuators."""
        return {actuator.unit for actuator in self.at.held.actuators}

    @cached_property
    def ball_jacobian(self) -> arb_mat:
        """J in balls, unscaled."""
        with working_precision(BITS):
            exact = self.at.exact_jacobian
            if exact is not None:
                return arb_mat([[ball_of(value) for value in row] for row in exact])
            rows = []
            for k, actuator in enumerate(self.at.held.actuators):
                row = self.at.ball_rows[actuator.equation]
                rows.append([entry / row.rates[k] for entry in row.wrench])
            return arb_mat(rows)

    @cached_property
    def _allowed(self) -> list[list[arb]]:
        """A basis of the allowed twists in balls, unscaled; the unit vectors if all are."""
        count = len(self.at.twist)
        structural = self.at.held.structural
        unit = [[arb(int(i == k)) for i in range(count)] for k in range(count)]
        if not structural:
            return unit
        jacobian = self.ball_jacobian
        rows = []
        for index in structural:
            row = self.at.ball_rows[index]
            entries = list(row.wrench)
            for actuator, rate in row.rates.items():
                entries = [x - rate * jacobian[actuator, j] for j, x in enumerate(entries)]
            rows.append(entries)
        return ball_kernel(rows, count)

    def scaled(self, length: Fraction | None, speeds: Sequence[Fraction] | None = None) -> arb_mat:
        """J on an orthonormal basis of the allowed twists, turns times the length, rows by greatest speeds."""
        with working_precision(BITS):
            factors = [arb(1) if k < 3 or length is None else ball_of(length) for k in self.at.motion.twist]
            basis = _orthonormal([[x * f for x, f in zip(v, factors, strict=True)] for v in self._allowed])
            columns = arb_mat([[v[j] / factors[j] for v in basis] for j in range(len(factors))])
            found = self.ball_jacobian * columns
            if speeds is None:
                return found
            return arb_mat(
                [[found[i, j] / ball_of(speed) for j in range(found.ncols())] for i, speed in enumerate(speeds)]
            )

    @cached_property
    def directions(self) -> Directions | None:
        """J exactly, as integer rows with weights; None at an enclosed pose or where rows are not such multiples."""
        at = self.at
        if at.exact_rows is None or at.held.structural:
            return None
        rows, weights = [], []
        for k, actuator in enumerate(at.held.actuators):
            row = at.exact_rows[actuator.equation]
            ratio = rationalised(row.wrench)
            if ratio is None or not any(ratio):
                return None
            place = next(j for j, x in enumerate(ratio) if x)
            scale = Fraction(lcm(*(x.denominator for x in ratio)))
            integers = [int(x * scale) for x in ratio]
            scale /= gcd(*integers)
            weight = RootSum.of(row.wrench[place]) * (1 / (ratio[place] * scale)) * row.rates[k].inverse()
            sign = weight.sign()
            rows.append(tuple(int(x * scale) * sign for x in ratio))
            weights.append(weight * sign)
        return Directions(tuple(rows), tuple(weights), tuple(column_squares(at.metric, at.motion.twist)))


def ball_kernel(rows: list[list[Any]], count: int) -> list[list[arb]]:
    """A basis of the vectors that all rows annihilate.

    Raises
    ------
    InputError
        If it is not proved that the rows are independent.
    """
    matrix = arb_mat(rows)
    if proved_rank(matrix) < len(rows):
        raise InputError(
            "statics: the constraints that are not actuated are or may be dependent here; no basis of twists"
        )
    columns = pivots(matrix)[: len(rows)]
    free = [j for j in range(count) if j not in columns]
    square = arb_mat([[row[j] for j in columns] for row in rows])
    rest = arb_mat([[row[j] for j in free] for row in rows])
    solved = square.inv() * rest
    basis = []
    for k, place in enumerate(free):
        vector = [arb(0)] * count
        vector[place] = arb(1)
        for i, j in enumerate(columns):
            vector[j] = -solved[i, k]
        basis.append(vector)
    return basis


def _orthonormal(vectors: list[list[arb]]) -> list[list[arb]]:
    """Gram and Schmidt's basis of the same space."""
    found: list[list[arb]] = []
    for vector in vectors:
        rest = vector
        for other in found:
            product = sum((a * b for a, b in zip(rest, other, strict=True)), arb(0))
            rest = [a - product * b for a, b in zip(rest, other, strict=True)]
        norm = sum((a * a for a in rest), arb(0)).sqrt()
        found.append([a / norm for a in rest])
    return found

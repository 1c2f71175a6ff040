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
from pkm_exact.statics.ball_rows import BITS, BallRow
from pkm_exact.statics.exact_rows import column_squares
from pkm_exact.statics.free_components import FreeComponents, free_components
from pkm_exact.statics.pose_rows import PoseRows
from pkm_exact.statics.ranks import kernel, pivots, proved_rank, rationalised


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
                if not self.at.held.is_redundant
                else "statics: there is no J, as speeds of the actuators do not follow from the twist; see forward_map"
            )

    @property
    def forward(self) -> Any:
        """T in t = T q', where the twist follows from the actuators and not they from it; else None."""
        return None

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
                row = self._ball_rows[actuator.equation]
                rows.append([entry / row.rates[k] for entry in row.wrench])
            return arb_mat(rows)

    @property
    def _ball_rows(self) -> Sequence[BallRow]:
        """Rows with one for every actuator that has no other: there are, as there is J."""
        return self.at.ball_apart or ()

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
            row = self._ball_rows[index]
            entries = list(row.wrench)
            for actuator, rate in row.rates.items():
                entries = [x - rate * jacobian[actuator, j] for j, x in enumerate(entries)]
            rows.append(entries)
        return ball_kernel(rows, count)

    def basis(self, length: Fraction | None) -> arb_mat:
        """An orthonormal basis of the allowed twists as columns, turns times the length: they are (v, L w)."""
        with working_precision(BITS):
            factors = self._factors(length)
            vectors = _orthonormal([[x * f for x, f in zip(v, factors, strict=True)] for v in self._allowed])
            return arb_mat([[v[j] for v in vectors] for j in range(len(factors))])

    def _factors(self, length: Fraction | None) -> list[arb]:
        return [arb(1) if k < 3 or length is None else ball_of(length) for k in self.at.motion.twist]

    def scaled(self, length: Fraction | None, speeds: Sequence[Fraction] | None = None) -> arb_mat:
        """J on an orthonormal basis of the allowed twists, turns times the length, rows by greatest speeds."""
        with working_precision(BITS):
            rows = zip(self.basis(length).tolist(), self._factors(length), strict=True)
            found = self.ball_jacobian * arb_mat([[x / factor for x in row] for row, factor in rows])
            if speeds is None:
                return found
            return arb_mat(
                [[found[i, j] / ball_of(speed) for j in range(found.ncols())] for i, speed in enumerate(speeds)]
            )

    @cached_property
    def directions(self) -> Directions | None:
        """J exactly, as integer rows with weights; None at an enclosed pose or where rows are not such multiples."""
        at = self.at
        if at.exact_apart is None or at.held.structural:
            return None
        rows = []
        for k, actuator in enumerate(at.held.actuators):
            row = at.exact_apart[actuator.equation]
            ratio = rationalised(row.wrench)
            if ratio is None or not any(ratio):
                return None
            place = next(j for j, x in enumerate(ratio) if x)
            rows.append((ratio, RootSum.of(row.wrench[place]) * (1 / ratio[place]) * row.rates[k].inverse()))
        return directions_of(rows, column_squares(at.metric, at.motion.twist))

    @cached_property
    def free(self) -> FreeComponents:
        """Components of a twist that determine the others; all of them where every constraint is actuated."""
        count = len(self.at.twist)
        if not self.at.held.structural:
            unit = tuple(tuple(Fraction(int(i == k)) for i in range(count)) for k in range(count))
            return FreeComponents(tuple(range(count)), unit)
        with working_precision(BITS):
            exact = self._exactly_allowed
            basis = self._allowed if exact is None else exact
            if not basis:
                raise InputError("statics: the constraints that are not actuated leave the platform no twist here")
            ordinary = [1.0] * count
            if exact is not None:
                ordinary = [float(k) ** -0.5 for k in column_squares(self.at.metric, self.at.motion.twist)]
            return free_components(basis, [a * b for a, b in zip(ordinary, self._lever_scales, strict=True)])

    @property
    def _lever_scales(self) -> list[float]:
        """1 for translations, for turns a length of the machine: of the moments of its constraints by their forces."""
        wrenches = self.at.wrenches.to_numpy()[list(self.at.held.structural)]
        turning = [k >= 3 for k in self.at.motion.twist]
        forces = max((abs(row[j]) for row in wrenches for j, turns in enumerate(turning) if not turns), default=0.0)
        moments = max((abs(row[j]) for row in wrenches for j, turns in enumerate(turning) if turns), default=0.0)
        lever = moments / forces if forces and moments else 1.0
        return [lever if turns else 1.0 for turns in turning]

    @property
    def components(self) -> tuple[str, ...]:
        """Names of the free components of twists."""
        return tuple(self.at.twist[place] for place in self.free.places)

    @cached_property
    def _exactly_allowed(self) -> list[list[Fraction]] | None:
        """A rational basis of the allowed twists, in rational coordinates; None where they have none that is known."""
        at = self.at
        if at.exact_apart is None:
            return None
        rows = []
        for index in at.held.structural:
            row = at.exact_apart[index]
            entries = [RootSum.of(x) for x in row.wrench]
            for actuator, rate in row.rates.items():
                own = at.exact_apart[at.held.actuators[actuator].equation]
                factor = rate * own.rates[actuator].inverse()
                entries = [x - factor * y for x, y in zip(entries, own.wrench, strict=True)]
            ratio = rationalised(entries)
            if ratio is None:
                return None
            rows.append(ratio)
        return kernel(rows, len(at.twist))

    @cached_property
    def free_directions(self) -> Directions | None:
        """The same as ``directions`` for the free components: the rows of J E."""
        at = self.at
        if not at.held.structural:
            return self.directions
        if self._exactly_allowed is None or at.exact_apart is None:
            return None
        rows = []
        for k, actuator in enumerate(at.held.actuators):
            row = at.exact_apart[actuator.equation]
            entries = [
                sum((RootSum.of(x) * e[j] for x, e in zip(row.wrench, self.free.expansion, strict=True)), RootSum())
                for j in range(len(self.free.places))
            ]
            ratio = rationalised(entries)
            if ratio is None or not any(ratio):
                return None
            place = next(j for j, x in enumerate(ratio) if x)
            rows.append((ratio, entries[place] * (1 / ratio[place]) * row.rates[k].inverse()))
        squares = column_squares(at.metric, at.motion.twist)
        return directions_of(rows, [squares[place] for place in self.free.places])

    @cached_property
    def expansion(self) -> arb_mat:
        """E in balls and ordinary coordinates: all components of a twist from the free ones."""
        with working_precision(BITS):
            found = self.free
            if any(isinstance(x, arb) for row in found.expansion for x in row):
                return arb_mat([list(row) for row in found.expansion])
            roots = [RootSum.root(k) for k in column_squares(self.at.metric, self.at.motion.twist)]
            return arb_mat(
                [
                    [ball_of(roots[place] * roots[i].inverse() * x) for place, x in zip(found.places, row, strict=True)]
                    for i, row in enumerate(found.expansion)
                ]
            )

    @cached_property
    def free_jacobian(self) -> arb_mat:
        """J E in balls: speeds of the actuators by the free components of the twist."""
        with working_precision(BITS):
            return self.ball_jacobian * self.expansion if self.at.held.structural else self.ball_jacobian


def directions_of(rows: Sequence[tuple[list[Fraction], RootSum]], squares: Sequence[Fraction]) -> Directions:
    """Rows that are a number times a rational row, as positive weights times integer rows."""
    integral, weights = [], []
    for ratio, factor in rows:
        scale = Fraction(lcm(*(x.denominator for x in ratio)))
        scale /= gcd(*(int(x * scale) for x in ratio))
        weight = factor * (1 / scale)
        sign = weight.sign()
        integral.append(tuple(int(x * scale) * sign for x in ratio))
        weights.append(weight * sign)
    return Directions(tuple(integral), tuple(weights), tuple(squares))


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

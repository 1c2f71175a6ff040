"""Machines with more actuators than equations for them: twists follow from the actuators, t = T q', not they from them.

So it is where J_q is singular, too. With W t = R q' for all equations, as many as freedoms, and W regular, T = W^-1 R.
Actuators whose forces bear a load f do no work with it: s = -T^T f, so that a load has one answer, however many
actuators there are. Twists of limited speeds are a zonotope, the image of a box; wrenches of limited forces, those f'
with |T^T f'| within limits, a section of a box.

Reference: Gosselin and Schreiber, Kinematically redundant spatial parallel mechanisms for singularity avoidance and
large orientational workspace, IEEE Trans. Robotics 32 (2016), 286-300, for J_x t = J_q q' with J_q not square.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, Final

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.polytopes.zonotope import Zonotope
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.ball_zonotope import ball_zonotope, section_by_facets
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.entangled_rows import ball_rates, exact_rates, solved
from pkm_exact.statics.exact_rows import column_squares
from pkm_exact.statics.forces import Forces
from pkm_exact.statics.freedom import Directions, directions_of
from pkm_exact.statics.pose_rows import WRENCH, PoseRows
from pkm_exact.statics.ranks import rationalised, root_sum_rank

_DEPENDENT: Final = (
    "statics: the wrenches are or may be dependent here, so that no twist follows from the actuators; give another pose"
)


@dataclass(frozen=True, eq=False)
class ForwardMap:
    """T of a machine at a pose.

    Attributes
    ----------
    at : PoseRows

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/carriage-hexapod.toml")
    >>> at = robot.at({"position": ["3/2", 7, 9], "quaternion": [1, 0, 0, 0]}, configuration=robot.configuration(None))
    >>> ForwardMap(at).matrix.shape
    (6, 9)
    """

    at: PoseRows

    def __post_init__(self) -> None:
        at = self.at
        if not at.is_forward:
            raise InputError("statics: speeds of the actuators follow from the twist here; see the attribute jacobian")
        if len(at.equations) != len(at.twist):
            raise InputError(
                f"statics: {len(at.equations)} constraints for {len(at.twist)} freedoms: speeds of the actuators do "
                "not follow from the twist, and not all speeds are possible; only J_x and J_q are given"
            )
        if self.exact is None and self._solved is None:
            raise InputError(_DEPENDENT)

    @cached_property
    def exact(self) -> list[list[RootSum]] | None:
        """T in rational coordinates, as sums of square roots; None at an enclosed pose or out of reach."""
        rows = self.at.exact_rows
        if rows is None:
            return None
        try:
            return solved(
                [[RootSum.of(x) for x in row.wrench] for row in rows],
                exact_rates(rows, range(len(rows)), len(self.at.actuated)),
            )
        except InputError:
            return None

    @cached_property
    def _solved(self) -> arb_mat | None:
        rows = self.at.ball_rows
        with working_precision(BITS):
            try:
                rates = arb_mat(ball_rates(rows, range(len(rows)), len(self.at.actuated)))
                return arb_mat([list(row.wrench) for row in rows]).solve(rates)
            except ZeroDivisionError:
                return None

    @cached_property
    def balls(self) -> arb_mat:
        """T in balls and ordinary coordinates: a row for each component of the twist."""
        if self.exact is None:
            if self._solved is None:
                raise InputError(_DEPENDENT)
            return self._solved
        with working_precision(BITS):
            return arb_mat([[ball_of(x) for x in row] for row in self._ordinary(self.exact)])

    @cached_property
    def matrix(self) -> EnclosedMatrix:
        """T in ordinary coordinates."""
        names = [f"q'({name})" for name in self.at.actuated]
        if self.exact is None:
            return EnclosedMatrix.of(self.at.twist, names, self.balls.tolist())
        return EnclosedMatrix.exactly(self.at.twist, names, self._ordinary(self.exact))

    def _ordinary(self, rows: Sequence[Sequence[RootSum]]) -> list[list[RootSum]]:
        roots = [RootSum.root(1 / k) for k in self._squares]
        return [[root * x for x in row] for root, row in zip(roots, rows, strict=True)]

    @property
    def _squares(self) -> list[Fraction]:
        return column_squares(self.at.metric, self.at.motion.twist)

    @cached_property
    def directions(self) -> Directions | None:
        """The columns of T: positive weights times integers, in rational coordinates; None if they are not so."""
        if self.exact is None:
            return None
        rows = []
        for column in zip(*self.exact, strict=True):
            ratio = rationalised(column)
            if ratio is None or not any(ratio):
                return None
            place = next(j for j, x in enumerate(ratio) if x)
            rows.append((ratio, column[place] * (1 / ratio[place])))
        return directions_of(rows, [1 / k for k in self._squares])

    def _zonotope(self, found: Directions, speeds: Sequence[Fraction]) -> Zonotope:
        low = tuple(-x for x in speeds)
        return Zonotope(found.rows, tuple(map(_short, found.weights)), low, tuple(speeds), found.squares)

    def velocity_polytope(self, speeds: Sequence[Fraction]) -> Polytope:
        """The twists of all speeds within limits: a zonotope."""
        if self.exact is not None and root_sum_rank(self.exact) < len(self.exact):
            raise InputError("polytope: the actuators do not move the platform in all ways; it has no interior")
        with working_precision(BITS):
            if self.directions is None:
                return ball_zonotope(self.balls.transpose().tolist(), [-x for x in speeds], speeds)
            return self._zonotope(self.directions, speeds).polytope()

    def velocity_section(self, speeds: Sequence[Fraction], kept: Sequence[int]) -> Polytope:
        """Those of them whose components at other places than the kept ones are 0."""
        with working_precision(BITS):
            if self.directions is None:
                return section_by_facets(self.velocity_polytope(speeds), kept)
            whole = self._zonotope(self.directions, speeds)
            return whole.section({j: Fraction(0) for j in range(whole.dimension) if j not in kept}).polytope()

    def wrench_polytope(self, low: Sequence[Fraction], high: Sequence[Fraction]) -> Polytope:
        """The wrenches on the environment that forces within limits exert: s = T^T f within them."""
        return self.wrench_section(low, high, range(len(self.at.twist)))

    def wrench_section(self, low: Sequence[Fraction], high: Sequence[Fraction], kept: Sequence[int]) -> Polytope:
        """Those of them whose components at other places than the kept ones are 0."""
        found = self.directions
        with working_precision(BITS):
            if found is None:
                rows: Any = [[row[j] for j in kept] for row in self.balls.transpose().tolist()]
                ends = [[ball_of(x) for x in side] for side in (low, high)]
                squares: tuple[Fraction, ...] = ()
            else:
                rows = [[Fraction(row[j]) for j in kept] for row in found.rows]
                inverse = [weight.inverse() for weight in found.weights]
                ends = [[_short(w * x) for w, x in zip(inverse, side, strict=True)] for side in (low, high)]
                squares = tuple(self._squares[j] for j in kept)
            return Slabs(tuple(map(tuple, rows)), tuple(ends[0]), tuple(ends[1]), squares).polytope()

    def forces(self, load: Sequence[Any]) -> Forces:
        """The actuator forces that bear a load about the platform's origin: s = -T^T f, the only ones."""
        if len(load) != len(self.at.twist):
            raise InputError(f"load: {len(load)} components; give {len(self.at.twist)}: {', '.join(self.at.twist)}")
        names, exact = self.at.actuated, self.exact is not None and not any(isinstance(x, arb) for x in load)
        with working_precision(BITS):
            if exact and self.exact is not None:
                rows = self._ordinary(self.exact)
                values: list[Any] = [
                    sum((RootSum.of(-1 * x) * row[k] for x, row in zip(load, rows, strict=True)), RootSum())
                    for k in range(len(names))
                ]
                signs: tuple[int | None, ...] = tuple(value.sign() for value in values)
            else:
                values = (self.balls.transpose() * arb_mat([[-ball_of(x)] for x in load])).entries()
                signs = tuple(1 if x > 0 else -1 if x < 0 else 0 if x.is_zero() else None for x in values)
            shown = tuple(map(str, values)) if exact else None
            return Forces(names, tuple(map(interval_of, values)), signs, shown, is_unique=True)

    def stiffness(self, stiffnesses: Sequence[Fraction]) -> EnclosedMatrix:
        """The wrench for each unit of a small displacement: the inverse of T diag(1 / k) T^T."""
        columns = self.balls
        if len(stiffnesses) != columns.ncols():
            raise InputError(f"stiffness: {len(stiffnesses)} numbers; give {columns.ncols()}, one each actuator")
        with working_precision(BITS):
            soft = arb_mat(
                [[x / ball_of(k) for x, k in zip(row, stiffnesses, strict=True)] for row in columns.tolist()]
            )
            try:
                found = (soft * columns.transpose()).inv()
            except ZeroDivisionError:
                raise InputError("stiffness: T has or may have dependent rows here; give another pose") from None
        names = [WRENCH[k] for k in self.at.motion.twist]
        return EnclosedMatrix.of(names, self.at.twist, found.tolist())


def _short(value: RootSum) -> Any:
    rational = value.rational
    return value if rational is None else rational

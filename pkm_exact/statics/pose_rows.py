"""A machine at a pose: its constraint wrenches, Jacobians, ranks and singularities.

With t = (v, w) the twist of the platform, v the velocity of its frame's origin, w its angular velocity, both in
coordinates of the base, ordinary and unscaled:

    J_x t = J_q q',    q' = J t

J_x has the wrenches of the actuated constraints as rows, J = J_q^-1 J_x. J_q is diagonal if each of them has one
actuator. The other constraints allow only twists with W_s t = 0. With more actuators than equations for them J_q has
more columns than rows, and there is no J: q' does not follow from t (``forward_map``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, Final

from flint import arb

from pkm_exact.balls import ball, hull
from pkm_exact.geometry.inverse import Metric
from pkm_exact.motions.motion import Motion
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.actuated_equations import Equation, Held
from pkm_exact.statics.ball_rows import BITS, BallPose, BallRow, enclosed
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.entangled_rows import ball_rates, ball_rows_apart, exact_rows_apart
from pkm_exact.statics.exact_rows import ExactRow, column_squares, exact_row
from pkm_exact.statics.singularity_kinds import Kinds, Singularity, kinds_at_rational_pose, kinds_in_balls

TWIST: Final = ("vx", "vy", "vz", "wx", "wy", "wz")
WRENCH: Final = ("fx", "fy", "fz", "mx", "my", "mz")


@dataclass(frozen=True, repr=False, eq=False)
class PoseRows:
    """A machine at a pose: its equations, their rows and what follows from their ranks.

    Attributes
    ----------
    name, unit : str
        Of the machine, and its unit of length.
    motion : Motion
    metric : tuple of 3 int
    held : Held
        The equations of all constraints and the actuators.
    position, rotation
        In rational coordinates of the metric where the pose is exact; else the box, in ordinary coordinates.
    is_exact : bool
    known_rank : int or None
        Exact rank of all wrenches, where it is known beforehand.
    is_multiple : bool
        Whether the pose is proved to be a multiple solution.
    """

    name: str
    unit: str
    motion: Motion
    metric: Metric
    held: Held
    position: Any
    rotation: Any
    is_exact: bool
    known_rank: int | None = field(default=None)
    is_multiple: bool = field(default=False)

    @property
    def twist(self) -> tuple[str, ...]:
        """The components of a twist that the motion has: vx, vy, vz, wx, wy, wz."""
        return tuple(TWIST[k] for k in self.motion.twist)

    @property
    def actuated(self) -> tuple[str, ...]:
        """Names of the actuators, in the order of the rows of J."""
        return tuple(actuator.name for actuator in self.held.actuators)

    @property
    def equations(self) -> tuple[Equation, ...]:
        """Of all constraints, in their order."""
        return self.held.equations

    @cached_property
    def exact_rows(self) -> tuple[ExactRow, ...] | None:
        """The rows of all equations, exactly; None at an enclosed pose."""
        if not self.is_exact:
            return None
        where = self.position, self.rotation, self.metric, self.motion.twist
        return tuple(exact_row(equation, *where) for equation in self.equations)

    @cached_property
    def ball_rows(self) -> tuple[BallRow, ...]:
        """The rows of all equations in balls and ordinary coordinates."""
        with working_precision(BITS):
            if self.exact_rows is not None:
                return tuple(enclosed(row, self.metric, self.motion.twist) for row in self.exact_rows)
            position = [_hull(entry) for entry in self.position]
            rotation = [[_hull(entry) for entry in row] for row in self.rotation]
            pose = BallPose(position, rotation, self.metric)
            return tuple(pose.row(equation, self.motion.twist) for equation in self.equations)

    @cached_property
    def exact_apart(self) -> tuple[ExactRow, ...] | None:
        """The same rows with one for every actuator that has no other; None where there is no J, or it is not exact."""
        if self.exact_rows is None or self.held.is_redundant:
            return None
        return self.exact_rows if self.held.is_diagonal else exact_rows_apart(self.held, self.exact_rows)

    @cached_property
    def ball_apart(self) -> tuple[BallRow, ...] | None:
        """The same in balls and ordinary coordinates; None where there is or may be no J."""
        if self.held.is_redundant or not self.held.actuators:
            return None
        if not self.held.is_diagonal:
            with working_precision(BITS):
                return ball_rows_apart(self.held, self.ball_rows)
        places = enumerate(self.held.actuators)
        return None if any(self.ball_rows[x.equation].rates[k].contains(0) for k, x in places) else self.ball_rows

    @cached_property
    def wrenches(self) -> EnclosedMatrix:
        """The wrenches of all constraints, at unit force; the moment is about the platform's origin."""
        columns = [WRENCH[k] for k in self.motion.twist]
        return self._unit_wrenches(range(len(self.equations)), columns)

    @cached_property
    def J_x(self) -> EnclosedMatrix:
        """The wrenches of the actuated constraints: J_x t = J_q q'."""
        return self._unit_wrenches(self._actuated, self.twist)

    def _unit_wrenches(self, chosen: Sequence[int], columns: Sequence[str]) -> EnclosedMatrix:
        names = [self.equations[index].name for index in chosen]
        if self.exact_rows is None:
            return EnclosedMatrix.of(names, columns, [self.ball_rows[index].wrench for index in chosen])
        roots = self._column_roots
        rows = []
        for row in (self.exact_rows[index] for index in chosen):
            size = RootSum.root(1 / row.size_squared)
            rows.append([size * (root * entry) for root, entry in zip(roots, row.wrench, strict=True)])
        return EnclosedMatrix.exactly(names, columns, rows)

    @cached_property
    def J_q(self) -> EnclosedMatrix:
        """What actuators do: J_x t = J_q q'; diagonal if every equation has one actuator."""
        rows = ball_rates(self.ball_rows, self._actuated, len(self.actuated))
        names = [self.equations[index].name for index in self._actuated]
        return EnclosedMatrix.of(names, [f"q'({name})" for name in self.actuated], rows)

    @cached_property
    def jacobian(self) -> EnclosedMatrix | None:
        """J in q' = J t; None if nothing is actuated, J_q is or may be singular, or q' does not follow from t."""
        exact = self.exact_jacobian
        if exact is not None:
            return EnclosedMatrix.exactly(self.actuated, self.twist, exact)
        if self.ball_apart is None or (self.exact_rows is not None and self.held.is_diagonal):
            return None
        found = []
        with working_precision(BITS):
            for k, actuator in enumerate(self.held.actuators):
                row = self.ball_apart[actuator.equation]
                found.append([entry / row.rates[k] for entry in row.wrench])
        return EnclosedMatrix.of(self.actuated, self.twist, found)

    @property
    def is_forward(self) -> bool:
        """Whether there are actuators and no J: at most the twist follows from them, not they from it."""
        return bool(self.held.actuators) and self.jacobian is None

    @cached_property
    def exact_jacobian(self) -> tuple[tuple[RootSum, ...], ...] | None:
        """J as sums of square roots; None where there is no J or it is enclosed."""
        if self.exact_apart is None:
            return None
        found = []
        for index, actuator in enumerate(self.held.actuators):
            row = self.exact_apart[actuator.equation]
            rate = row.rates[index]
            if not rate.terms:
                return None
            inverse = rate.inverse()
            entries = zip(self._column_roots, row.wrench, strict=True)
            found.append(tuple(root * (inverse * entry) for root, entry in entries))
        return tuple(found) or None

    @cached_property
    def _column_roots(self) -> list[RootSum]:
        """By what an entry of a rational wrench is multiplied to be one of the ordinary wrench."""
        return [RootSum.root(k) for k in column_squares(self.metric, self.motion.twist)]

    @cached_property
    def kinds(self) -> Kinds:
        """Ranks and singularities."""
        if self.exact_rows is not None:
            return kinds_at_rational_pose(self.held, self.exact_rows, self.motion, self.metric)
        with working_precision(BITS):
            where = self.motion, self.metric, self.known_rank
            return kinds_in_balls(self.held, self.ball_rows, *where, is_multiple=self.is_multiple)

    @property
    def rank(self) -> int | None:
        """The rank of the wrenches of all constraints, exactly; None where it is not decided."""
        return self.kinds.rank

    @property
    def singular(self) -> tuple[str, ...]:
        """Names of the singularities that are proved: "type-1", "type-2", "constraint", "architecture"."""
        return tuple(found.name for found in self.kinds.found)

    @property
    def singularities(self) -> tuple[Singularity, ...]:
        """The same with the constraints that cause them."""
        return self.kinds.found

    @property
    def _actuated(self) -> tuple[int, ...]:
        """Indices of the equations that J_x and J_q have as rows."""
        return self.held.driven

    def arm(self, point: Sequence[Fraction]) -> list[Any]:
        """From the platform's origin to a point of the platform, in ordinary coordinates of base and platform.

        Exact sums of square roots at an exact pose, else balls.
        """
        if self.is_exact:
            g = self.metric
            return [
                sum((RootSum.root(Fraction(g[i], g[j])) * (row[j] * point[j]) for j in range(3)), RootSum())
                for i, row in enumerate(self.rotation)
            ]
        with working_precision(BITS):
            return [sum((_hull(row[j]) * ball(point[j]) for j in range(3)), arb(0)) for row in self.rotation]

    def __str__(self) -> str:
        rank = "not decided" if self.rank is None else str(self.rank)
        kinds = "; ".join(map(str, self.singularities)) or "no singularity proved"
        return f"{self.name} at a pose: {len(self.equations)} constraints of rank {rank}; {kinds}"


def _hull(entry: Interval) -> arb:
    lo, hi = Fraction(entry.lo), Fraction(entry.hi)
    return hull(lo, hi)

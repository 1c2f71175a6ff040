"""Where actuators put the lower ends of legs, in doubles, how far that is off, and what lies between two joint values.

Lengths are in the unit s of the tables. A lower end A and the length l enter the leg's equation by A and
v = |A|^2 - l^2 (``leg_tables``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pkm_exact.following.leg_tables import Array, LegTables
from pkm_exact.following.rounding import ENDS_ERROR, OUTWARD, U


@dataclass(frozen=True, eq=False)
class LegEnds:
    """Lower ends and v at joint values; of actuated legs A is part of the tables.

    Attributes
    ----------
    values : array of m
        The joint values.
    places : m x 3 array
        A.
    squares : array of m
        v, as computed.
    sizes : array of m
        |A|^2 + l^2, from which v is computed.
    off : array of m
        Distance of A from where it is exactly, at most, in ordinary coordinates.
    """

    values: Array
    places: Array
    squares: Array
    sizes: Array
    off: Array

    def lengths(self, tables: LegTables) -> Array:
        """|A|."""
        found: Array = np.sqrt((self.places * self.places) @ tables.weights) * OUTWARD
        return found

    def value_off(self, tables: LegTables, point: Array, residual: Array) -> Array:
        """By how much the equations' values change with the true lower ends: N (2 |C + R B - A| + off) off."""
        norm = float(point @ tables.norm @ point) * OUTWARD
        found: Array = norm * (2 * self.reach(tables, point, residual) + self.off) * self.off * OUTWARD
        return found

    def reach(self, tables: LegTables, point: Array, residual: Array) -> Array:
        """|C + R B - A| at a point where the equations have these values."""
        norm = float(point @ tables.norm @ point)
        found: Array = np.sqrt(tables.rods_squared + np.abs(residual[: len(self.off)]) / norm) * OUTWARD
        return found

    def slope_off(self, tables: LegTables, point: Array) -> Array:
        """The same of their derivatives, row by row."""
        return _slope_change(tables, self.off, self._raised(tables), np.abs(point))

    def curvature_off(self, tables: LegTables) -> Array:
        """The same of the sums of the entries of their quadratic forms."""
        if not tables.robot.chains:
            return np.zeros(len(self.off))
        moved = np.abs(tables.moved).sum(axis=(1, 2, 3))
        found: Array = self.off * moved + self._raised(tables) * np.abs(tables.norm).sum()
        return found

    def _raised(self, tables: LegTables) -> Array:
        if not tables.robot.chains:
            return np.zeros(len(self.off))
        found: Array = (2 * self.lengths(tables) + self.off) * self.off * OUTWARD
        return found


def leg_ends(tables: LegTables, values: Array) -> LegEnds:
    """The lower ends at joint values. The platform's sine and cosine are taken to be right to two units of the last."""
    if not tables.robot.chains:
        squares = (values / tables.unit) ** 2
        none = np.zeros(len(values))
        return LegEnds(values, np.zeros((len(values), 3)), -squares, squares, none)
    first, second = values[:, None], np.zeros((len(values), 1))
    if tables.is_cranked:
        first, second = np.cos(first), np.sin(first)
    places = tables.base + first * tables.at_0 + second * tables.at_90
    sizes = np.abs(tables.base) + np.abs(first) * np.abs(tables.at_0) + np.abs(second) * np.abs(tables.at_90)
    weighted = (places * places) @ tables.weights
    off = ENDS_ERROR * np.sqrt((sizes * sizes) @ tables.weights) * OUTWARD
    return LegEnds(values, places, weighted - tables.rods_squared, weighted + tables.rods_squared, off)


@dataclass(frozen=True, eq=False)
class Way:
    """What bounds the equations between two joint values, each going evenly from one to the other.

    Attributes
    ----------
    moved : array of m
        Greatest distance of A on the way from where it ends.
    raised : array of m
        The same of v.
    bend : array of m
        How far |C + R B - A|^2 - l^2 is on the way from what is between its values at the ends, at most, for the pose
        at the end of the way.
    """

    moved: Array
    raised: Array
    bend: Array

    def slope_change(self, tables: LegTables, inverse: Array, point: Array) -> tuple[float, float]:
        """How far Y F'(y) changes on the way: at the point, and the more by r where y is r away."""
        weights = np.abs(inverse[:, : len(self.moved)])
        at_point = weights @ _slope_change(tables, self.moved, self.raised, np.abs(point)).sum(axis=1)
        further = weights @ _slope_change(tables, self.moved, self.raised, np.ones(len(point))).sum(axis=1)
        return float(np.max(at_point)) * OUTWARD, float(np.max(further)) * OUTWARD


def way_between(tables: LegTables, before: LegEnds, after: LegEnds, reach: Array) -> Way:
    """Bounds for all joint values between two; ``reach`` is |C + R B - A| at the end of the way."""
    change = np.abs(after.values - before.values) * (1 + 4 * U)
    if not tables.robot.chains:
        raised = np.abs(after.squares - before.squares) + 4 * U * (after.sizes + before.sizes)
        # l^2 is t (1 - t) (l' - l)^2 below what is between its ends, which differs from leg to leg.
        return Way(np.zeros(len(change)), raised, (change / tables.unit) ** 2 / 4 * OUTWARD)
    arm = np.sqrt((tables.at_0 * tables.at_0) @ tables.weights) * OUTWARD
    moved = (arm * change + before.off + after.off) * OUTWARD
    raised = (2 * after.lengths(tables) + moved) * moved * OUTWARD
    # On a line t (1 - t) |A' - A|^2; on an arc the second derivative by the angle is at most 2 r |C + R B - A| + 2 r^2.
    bend = (arm * change) ** 2 / 4
    if tables.is_cranked:
        bend = change**2 / 4 * arm * (reach + arm + arm * change)
    return Way(moved, raised, bend * OUTWARD)


def _slope_change(tables: LegTables, moved: Array, raised: Array, absolute: Array) -> Array:
    """How far 2 (Q x)_j changes, row by row, if A moves by that much and v by that much, where |x| is given."""
    found: Array = 2 * raised[:, None] * (np.abs(tables.norm) @ absolute)
    if tables.robot.chains:
        found = found + 2 * moved[:, None] * (np.abs(tables.moved).sum(axis=1) @ absolute)
    return found

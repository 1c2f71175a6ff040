"""A branch of poses as it is written down, and a robot with tolerances in the coordinates of its basis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product as all_of
from typing import Final

import numpy as np

from pkm_exact.balls import ball
from pkm_exact.numeric.centred import NORM, POSITION, ROTATION, TURNED, gradient_forms
from pkm_exact.numeric.data_errors import DataErrors
from pkm_exact.numeric.enclosed_arrays import Enclosed, Real, enclosed, exact, join, product
from pkm_exact.numeric.linearisation import Linearisation

PLACE_BITS: Final = 48
"""Centres, radii and the box of s are multiples of 2^-48, in the centred unit."""
BASIS_BITS: Final = 10
CLAIM_BITS: Final = 16
"""What is claimed of a cell are multiples of 2^-16."""
WEIGHT_BITS: Final = 32
"""Weights are multiples of 2^-32."""
MARGIN: Final = 2.0**-12
"""What the solver leaves to a checker's rounding, of 1."""


Box = tuple[tuple[int, int], ...]
"""Intervals of s, in units of 2^-48."""
Cut = tuple[int, int]
"""How a box of s is cut: the leg, from 1, and the place; or ``CELL`` or ``LEFT_OUT``."""
CELL: Final = (0, 0)
LEFT_OUT: Final = (-1, 0)
"""No robot has s there."""


@dataclass(frozen=True)
class BranchCell:
    """A cell as it is written down, in units of the grids above.

    Attributes
    ----------
    centre : tuple of int
        m, on the coordinates that are kept.
    radius : int
        r: of the balls in the coordinates y.
    slope, bend : int
        At least the greatest eigenvalue of a symmetric part of B(z); the greatest norm of B(y) for a unit vector y.
    metric : tuple of rows of int
        P: the symmetric part of P f' is definite at the poses of all robots of the cell.
    weights : tuple of rows of int
        By which this is shown, for each leg and each of its errors.
    """

    centre: tuple[int, ...]
    radius: int
    slope: int
    bend: int
    metric: tuple[tuple[int, ...], ...]
    weights: tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class ProvedBranch:
    """A branch of poses over all robots within tolerance.

    Attributes
    ----------
    basis : tuple of rows
        A, on the coordinates that are kept, in units of 2^-10.
    reach : tuple of int
        Half widths of L.
    cuts : tuple of Cut
        How L is cut: of each box in turn, first the lower part with all that is in it.
    cells : tuple of BranchCell
        In that order.
    """

    basis: tuple[tuple[int, ...], ...]
    reach: tuple[int, ...]
    cuts: tuple[Cut, ...]
    cells: tuple[BranchCell, ...]


def boxes_of(reach: Sequence[int], cuts: Sequence[Cut]) -> tuple[list[Box], list[Box]]:
    """The cells, and the boxes that are left out."""
    cells: list[Box] = []
    left_out: list[Box] = []
    todo: list[Box] = [tuple((-r, r) for r in reach)]
    for leg, place in cuts:
        box = todo.pop()
        if leg > 0:
            low, high = box[leg - 1]
            if not low < place < high:
                raise ValueError(f"a box is cut outside of it, at {place}")
            todo += [(*box[: leg - 1], half, *box[leg:]) for half in ((place, high), (low, place))]
        else:
            (left_out if leg else cells).append(box)
    if todo:
        raise ValueError(f"{len(todo)} boxes are neither cut nor cells nor left out")
    return cells, left_out


def signs_of(count: int) -> Enclosed:
    """The corners of a cube, one of each two opposite ones."""
    return exact([(1, *signs) for signs in all_of((1, -1), repeat=count - 1)])


class BranchRobot:
    """A robot with tolerances, in the coordinates y of a basis for all cells."""

    def __init__(self, near: Linearisation, errors: DataErrors, basis: Sequence[Sequence[int]]) -> None:
        robot = near.robot
        motion = robot.problem.motion
        self.near, self.size = near, robot.size
        self.legs = len(robot.legs.lengths)
        self.first = self.size - 1 - self.legs
        self.axes = list(range(2 if motion.is_planar else 3))
        motions = np.array([[float(int(v)) for v in row] for row in gradient_forms(motion).tolist()])
        self.motions = exact(motions.reshape(-1, self.size, self.size))
        self.weights = [near.chart[k][0] for k in motion.rotation_support]
        sizes = [abs(w) for w in self.weights]
        self.solved = sizes.index(max(sizes))
        self.kept = [k for k in range(self.size) if k != self.solved]
        self.basis = self.completed([[Fraction(v, 2**BASIS_BITS) for v in row] for row in basis], Fraction(0))
        forms = enclosed([[value.real for value in row] for row in robot.forms.tolist()])
        self.quadrics = product("ik,kab->iab", forms, self.motions)
        self.bends = product("iab,ap,bq->ipq", self.quadrics, self.basis, self.basis)
        self.joints = [enclosed(points) for points in (robot.legs.base, robot.legs.platform)]
        self.lengths = enclosed(robot.legs.lengths)
        bounds = (errors.base, errors.platform, errors.lengths)
        self.errors = [exact(float(bound.abs_upper()) * (1 + 2.0**-50)) for bound in bounds]
        self.single = self.changes(self.motions)
        self.bent_errors = product("leab,ap,bq->lepq", self.single, self.basis, self.basis)
        self.bent_cubes = product("ve,lepq->vlpq", signs_of(self.single.mid.shape[1]), self.bent_errors)
        """Second derivatives of what a leg's errors add to first order, at the corners of their cube."""

    def completed(self, rows: Sequence[Sequence[Fraction]], constant: Fraction) -> Enclosed:
        """All rows from those of the kept coordinates: the other from w.x = constant."""
        places = [k for k in range(len(self.weights)) if k != self.solved]
        sums = [
            (constant - sum(self.weights[k] * value for k, value in zip(places, column, strict=False)))
            / self.weights[self.solved]
            for column in zip(*rows, strict=True)
        ]
        full = [*rows[: self.solved], sums, *rows[self.solved :]]
        return enclosed([[ball(Fraction(value)) for value in row] for row in full])

    def point(self, centre: Sequence[int]) -> Enclosed:
        """m."""
        return self.completed([[Fraction(v, 2**PLACE_BITS)] for v in centre], Fraction(1))[:, 0]

    def changes(self, at: Enclosed) -> Enclosed:
        """What single errors add to first order, from quantities or their derivatives: legs x errors x .."""
        da, db, dl = self.errors
        base, platform = self.joints
        norm, position, turned = at[NORM], at[POSITION:ROTATION], at[TURNED:POSITION]
        turn = Enclosed(*(part[ROTATION:NORM].reshape(3, 3, *part.shape[1:]) for part in (at.mid, at.rad)))
        ones = exact(np.ones(self.legs))
        along = product("jk...,lk->lj...", turn, platform) + product("j...,l->lj...", position, ones)
        along = along - product("lj,...->lj...", base, norm)
        back = product("j...,l->lj...", turned, ones) + product("lj,...->lj...", platform, norm)
        back = back - product("kj...,lk->lj...", turn, base)
        return join(
            product(",,l...->l...", exact(-2.0), da, along[:, self.axes]),
            product(",,l...->l...", exact(2.0), db, back[:, self.axes]),
            product(",l,...->l...", exact(-2.0), self.lengths, product(",...->...", dl, norm))[:, None],
            axis=1,
        )

    def rest(self, at: Enclosed) -> Real:
        """Bounds for what is of second order in the errors, the same for all legs."""
        da, db, dl = (float(e.mid) for e in self.errors)
        turn = [at[ROTATION + 3 * j + k].most for j in self.axes for k in self.axes]
        total = at[NORM].most * (len(self.axes) * (da * da + db * db) + dl * dl) + 2 * da * db * np.sum(turn, axis=0)
        return np.asarray(total * (1 + 2.0**-36))

    def values(self, x: Enclosed) -> Enclosed:
        """F(x), but for the chart."""
        return product("iab,a,b->i", self.quadrics, x, x).half()

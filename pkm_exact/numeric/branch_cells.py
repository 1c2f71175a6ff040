"""Cells of a branch of poses in doubles: what can be proved of them, roughly. Nothing here is proved."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.branch_robot import PLACE_BITS, Box
from pkm_exact.numeric.centred import NORM, POSITION, ROTATION, TURNED, gradient_forms
from pkm_exact.numeric.data_errors import DataErrors
from pkm_exact.numeric.linearisation import Linearisation

Real = NDArray[np.float64]

SLACK: Final = 0.94
"""What is proved leaves a part of 1 to what doubles do not see."""
NEWTON: Final = 12
NEAR: Final = 0.3
"""How far a centre may be moved, beside where the Jacobian may be singular."""
WIDER: Final = 1.5
"""The box of s beside the errors of the equations at the nominal pose, at first."""


@dataclass(frozen=True, eq=False)
class BranchFamily:
    """The nominal robot with other lengths, in doubles.

    Attributes
    ----------
    forms : (n - 1) x n x n
        2 Q of the equations but the chart.
    motions : 18 x n x n
        2 M of the quantities.
    chart, centre : n
    base, platform : legs x 3
    lengths : legs
    errors : three numbers
        Tolerances of base joints, platform joints, lengths.
    wider : legs
        The box of s beside the errors of the equations at the nominal pose, in times ``WIDER``.
    axes : int
        Along which joints can err.
    """

    forms: Real
    motions: Real
    chart: Real
    centre: Real
    base: Real
    platform: Real
    lengths: Real
    errors: tuple[float, float, float]
    wider: Real
    axes: int

    @property
    def first(self) -> int:
        """Place of the first leg among the equations."""
        return len(self.forms) - len(self.lengths)

    @cached_property
    def is_bounded(self) -> bool:
        """Whether errors change every leg, and by a number."""
        reach = self.changes(self.values(self.centre))
        return bool(np.isfinite(reach).all() and (reach > 2.0 ** (8 - PLACE_BITS)).all())

    @cached_property
    def box(self) -> Box:
        """Of s, in units of 2^-48."""
        reach = WIDER * self.wider * self.changes(self.values(self.centre)) * 2**PLACE_BITS
        return tuple((-int(r), int(r)) for r in np.ceil(reach))

    def values(self, x: Real) -> Real:
        """The quantities at x, or at the columns of x."""
        return np.asarray(np.einsum("ki...,i...->k...", np.tensordot(self.motions, x, 1), x) / 2)

    @cached_property
    def solved(self) -> int:
        """The coordinate for which the chart is solved: that of the greatest weight."""
        return int(np.abs(self.chart).argmax())

    @cached_property
    def kept(self) -> list[int]:
        """The other coordinates."""
        return [k for k in range(len(self.centre)) if k != self.solved]

    @cached_property
    def vertices(self) -> Real:
        """Of the cube [-1, 1]^legs, one of each two opposite ones."""
        signs = np.array(list(product((1.0, -1.0), repeat=len(self.lengths) - 1)))
        return np.concatenate([np.ones((len(signs), 1)), signs], axis=1)

    def basis(self, rows: Real) -> Real:
        """n x (n - 1): the rows of the other coordinates, and the one that the chart asks for."""
        full = np.zeros((len(self.centre), len(self.kept)))
        full[self.kept] = rows
        full[self.solved] = -(self.chart[self.kept] @ rows) / self.chart[self.solved]
        return full

    def changes(self, at: Real) -> Real:
        """Bounds for what errors do to the legs' equations, from quantities or their derivatives: legs x .."""
        da, db, dl = self.errors
        norm, position, turned = at[NORM], at[POSITION:ROTATION], at[TURNED:POSITION]
        turn = at[ROTATION:NORM].reshape(3, 3, *at.shape[1:])
        used = range(self.axes)
        rest = np.abs(norm) * (self.axes * (da * da + db * db) + dl * dl)
        rest = rest + 2 * da * db * np.abs(turn[np.ix_(used, used)]).sum(axis=(0, 1))
        found = []
        for a, b, length in zip(self.base, self.platform, self.lengths, strict=True):
            along = position + np.einsum("jk...,k->j...", turn, b) - np.multiply.outer(a, norm)
            back = turned + np.multiply.outer(b, norm) - np.einsum("kj...,k->j...", turn, a)
            change = da * np.abs(along[: self.axes]).sum(axis=0) + db * np.abs(back[: self.axes]).sum(axis=0)
            found.append(2 * (change + length * dl * np.abs(norm)) + rest)
        return np.array(found)


def branch_family(near: Linearisation, errors: DataErrors, wider: Real | None = None) -> BranchFamily:
    """The family around a real pose."""
    robot = near.robot
    motion = robot.problem.motion
    size = robot.size
    motions = np.array([[float(int(v)) for v in row] for row in gradient_forms(motion).tolist()])
    motions = motions.reshape(-1, size, size)
    rows = np.array([[float(v.real.mid()) for v in row] for row in robot.forms.tolist()])
    turning = motion.rotation_support
    chart = np.zeros(size)
    chart[: len(turning)] = [near.chart[k][0] for k in turning]
    return BranchFamily(
        np.tensordot(rows, motions, 1),
        motions,
        chart,
        np.array([float(v.real.mid()) for v in near.centre.entries()]),
        np.array([[float(x.mid()) for x in joint] for joint in robot.legs.base]),
        np.array([[float(x.mid()) for x in joint] for joint in robot.legs.platform]),
        np.array([float(x.mid()) for x in robot.legs.lengths]),
        (float(errors.base.upper()), float(errors.platform.upper()), float(errors.lengths.upper())),
        np.ones(len(robot.legs.lengths)) if wider is None else wider,
        2 if motion.is_planar else 3,
    )


class Cell:
    """A cell of the box of s: its middle, half widths, and the pose at the middle."""

    def __init__(self, family: BranchFamily, start: Real, box: Box) -> None:
        ends = np.array(box, dtype=np.float64) / 2**PLACE_BITS
        self.family, self.half = family, (ends[:, 1] - ends[:, 0]) / 2
        middle = (ends[:, 0] + ends[:, 1]) / 2
        shift = np.zeros(len(start))
        shift[family.first : -1] = middle
        shift[-1] = -1
        x, off = start, np.inf
        for _ in range(NEWTON):
            slope = np.concatenate([family.forms @ x, family.chart[None]])
            value = np.append(slope[:-1] @ x / 2, slope[-1] @ x) + shift
            off = float(np.abs(value).max())
            try:
                x = x - np.linalg.solve(slope, value)
            except np.linalg.LinAlgError:
                break
        self.has_pose = bool(np.isfinite(x).all() and off < 1e-10)
        self.centre, self.slope = x, family.forms @ x

    def errors(self, basis: Real) -> Real:
        """About the greatest errors of the legs in the cell: at its corners, to first order."""
        family = self.family
        corners = np.concatenate([family.vertices, -family.vertices]) * self.half
        moves = basis @ np.linalg.inv(self.slope @ basis)[:, family.first :]
        return np.asarray(family.changes(family.values(self.centre[:, None] - moves @ corners.T)).max(axis=1))

    def shape(self, basis: Real) -> CellShape:
        """The second derivatives in the coordinates of a basis, at a centre from which poses differ least."""
        family, bends = self.family, basis.T @ self.family.forms @ basis
        inverse: Real = np.linalg.inv(self.slope @ basis).astype(np.float64)
        bend = np.tensordot(inverse, bends, 1)
        shifts = inverse[:, family.first :] * self.half
        moved = -np.einsum("pqr,qi,ri->p", bend, shifts, shifts) / 4
        centre = self.centre
        if np.linalg.norm(moved) * _norm(bend) < NEAR:
            centre = centre + basis @ moved
            inverse = np.linalg.inv(family.forms @ centre @ basis)
            bend = np.tensordot(inverse, bends, 1)
        return CellShape(family.vertices, centre, inverse[:, family.first :], bend, _norm(bend))


def _norm(bend: Real) -> float:
    flat = bend.reshape(len(bend), -1)
    return float(np.sqrt(np.linalg.eigvalsh(flat @ flat.T)[-1]))


@dataclass(frozen=True, eq=False)
class CellShape:
    """A cell in the coordinates of a basis, of any size.

    Attributes
    ----------
    vertices : corners x legs
    centre : n
    on_legs : (n - 1) x legs
        What s of 1 adds to y.
    bend : (n - 1) x (n - 1) x (n - 1)
        B.
    size : float
        Its norm.
    """

    vertices: Real
    centre: Real
    on_legs: Real
    bend: Real
    size: float

    def bounds(self, halves: Real) -> list[CellBounds]:
        """What can be proved for some half widths, a row for each."""
        shifts = self.on_legs * halves[:, None, :]
        turns = np.einsum("pqr,kri->kipq", self.bend, shifts)
        at = np.tensordot(self.vertices, turns, (1, 1))
        slopes = np.abs(np.linalg.eigvalsh((at + np.swapaxes(at, -1, -2)) / 2)).max(axis=(0, 2))
        pairs = np.einsum("kipq,kqj->kpij", turns, shifts)
        first, second = np.triu_indices(halves.shape[1], 1)
        crossed = pairs[..., first, second] @ (self.vertices[:, first] * self.vertices[:, second]).T
        squares = np.diagonal(pairs, axis1=2, axis2=3) @ np.concatenate([self.vertices, -self.vertices]).T / 4
        residuals = np.linalg.norm(crossed[..., None] + squares[:, :, None], axis=1).max(axis=(1, 2))
        return [CellBounds(float(slope), self.size, float(off)) for slope, off in zip(slopes, residuals, strict=True)]


@dataclass(frozen=True)
class CellBounds:
    """Bounds in a cell, in doubles: see ``branch_robot.BranchCell``."""

    slope: float
    bend: float
    residual: float

    @property
    def radius(self) -> float:
        """Somewhat more than the least radius that is proved, up to the one where most is left; 0 if there is none."""
        free = 1 - self.slope
        square = free * free - 4 * self.bend * self.residual
        if free <= 0 or square < 0:
            return 0.0
        least = (free - square**0.5) / (2 * self.bend)
        return float(min(1.3 * least, free / (2 * self.bend)))

    @property
    def excess(self) -> float:
        """Below 1 if there is one pose for each s. The less, the farther a basis reaches."""
        return float(self.slope + 2 * (self.bend * self.residual) ** 0.5)

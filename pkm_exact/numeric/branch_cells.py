"""Cells of a branch of poses in doubles: what can be proved of them, roughly. Nothing here is proved."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.numeric.branch_robot import PLACE_BITS
from pkm_exact.numeric.centred import NORM, POSITION, ROTATION, TURNED, gradient_forms
from pkm_exact.numeric.data_errors import DataErrors
from pkm_exact.numeric.linearisation import Linearisation

Real = NDArray[np.float64]

SLACK: Final = 0.94
"""What is proved leaves a part of 1 to what doubles do not see."""
NEWTON: Final = 12
WIDER: Final = 1.3
"""The box of s beside the errors of the equations at the nominal pose."""


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
    axes : int
        Along which joints can err.
    turning : int
        How many of the first coordinates are those of e.
    """

    forms: Real
    motions: Real
    chart: Real
    centre: Real
    base: Real
    platform: Real
    lengths: Real
    errors: tuple[float, float, float]
    axes: int
    turning: int

    @property
    def first(self) -> int:
        """Place of the first leg among the equations."""
        return len(self.forms) - len(self.lengths)

    @cached_property
    def reach(self) -> Real:
        """Half widths of the box of s."""
        values = np.einsum("kij,i,j->k", self.motions, self.centre, self.centre) / 2
        return np.asarray(np.ceil(WIDER * self.changes(values) * 2**PLACE_BITS) / 2**PLACE_BITS)

    @cached_property
    def signs(self) -> Real:
        """Of the errors of a leg, one of each two opposite ones."""
        signs = np.array(list(product((1.0, -1.0), repeat=2 * self.axes)))
        return np.concatenate([np.ones((len(signs), 1)), signs], axis=1)

    def bent_errors(self, basis: Real) -> Real:
        """Second derivatives of what each error adds, in the coordinates of a basis."""
        return np.asarray(basis.T @ self.single @ basis)

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

    @cached_property
    def single(self) -> Real:
        """2 K of what each error adds to its leg's equation to first order: legs x errors x n x n."""
        return self.directions(self.motions)

    def directions(self, at: Real) -> Real:
        """What each error adds to its leg to first order, from quantities or their derivatives: legs x errors x .."""
        da, db, dl = self.errors
        norm, position, turned = at[NORM], at[POSITION:ROTATION], at[TURNED:POSITION]
        turn = at[ROTATION:NORM].reshape(3, 3, *at.shape[1:])
        found = []
        for a, b, length in zip(self.base, self.platform, self.lengths, strict=True):
            along = position + np.einsum("jk...,k->j...", turn, b) - np.multiply.outer(a, norm)
            back = turned + np.multiply.outer(b, norm) - np.einsum("kj...,k->j...", turn, a)
            parts = [-2 * da * along[: self.axes], 2 * db * back[: self.axes], -2 * length * dl * norm[None]]
            found.append(np.concatenate(parts))
        return np.array(found)


def branch_family(near: Linearisation, errors: DataErrors) -> BranchFamily:
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
        2 if motion.is_planar else 3,
        len(turning),
    )


class Cell:
    """A cell of the box of s: its middle, half widths, and the pose at the middle."""

    def __init__(self, family: BranchFamily, start: Real, middle: Real, half: Real) -> None:
        self.family, self.middle, self.half = family, middle, half
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

    def bounds(self, basis: Real, half: Real | None = None, *, joints: bool = True) -> CellBounds:
        """What can be proved of the cell, or of one with other half widths, in the coordinates of a basis.

        Without ``joints`` what the data add is taken at the centre, which is done sooner.
        """
        family = self.family
        reach = self.half if half is None else half
        inverse: Real = np.linalg.inv(self.slope @ basis).astype(np.float64)
        bend = np.tensordot(inverse, basis.T @ family.forms @ basis, 1)
        shifts = inverse[:, family.first :] * reach
        turns = np.einsum("pqr,ri->ipq", bend, shifts)
        at = np.tensordot(family.vertices, turns, 1)
        slope = float(np.abs(np.linalg.eigvalsh((at + np.swapaxes(at, 1, 2)) / 2)).max())
        pairs = np.einsum("ipq,qj->pij", turns, shifts)
        images = family.vertices @ pairs @ family.vertices.T
        flat = bend.reshape(len(bend), -1)
        residual = float(np.linalg.norm(images, axis=0).max() / 2)
        first = CellBounds(slope, float(np.sqrt(np.linalg.eigvalsh(flat @ flat.T)[-1])), residual, 0.0, 0.0)
        if not joints:
            return replace(first, joints=self._joints_at_centre(basis, inverse[:, family.first :]))
        share, errors = self._joints(basis, inverse[:, family.first :], shifts, first.radius)
        return replace(first, joints=share, errors=errors)

    def _joints_at_centre(self, basis: Real, on_legs: Real) -> float:
        """Roughly what errors of the data add to f' at the centre."""
        steep = np.linalg.norm(self.steepness @ basis, axis=(1, 2)) + 1e-300
        weights = np.sqrt(np.linalg.norm(on_legs, axis=0) / steep)
        return float(np.linalg.norm(on_legs / weights, 2) * np.linalg.norm(weights * steep))

    @cached_property
    def steepness(self) -> Real:
        """Derivatives of what each error adds, at the centre."""
        return np.asarray(np.einsum("lkij,j->lki", self.family.single, self.centre))

    def _joints(self, basis: Real, on_legs: Real, shifts: Real, radius: float) -> tuple[float, float]:
        """What errors of the data add to f', and to the legs beside the box of s."""
        family = self.family
        signs = family.signs
        bent = np.tensordot(signs, family.bent_errors(basis), (1, 1))
        rows = np.einsum("lkij,j,ip->lkp", family.single, self.centre, basis)
        values = np.einsum("lkij,i,j->lk", family.single, self.centre, self.centre) / 2
        turned = np.einsum("vlpq,qi->vlpi", bent, shifts)
        away = np.abs(turned).sum(axis=3) + radius * np.linalg.norm(bent, axis=3)
        line = np.tensordot(signs, rows, (1, 1))
        steep = np.linalg.norm(np.abs(line) + away, axis=2).max(axis=0) + 1e-300
        far = float(np.linalg.norm(family.vertices @ shifts.T, axis=1).max()) + radius
        reach = np.abs(np.tensordot(signs, values, (1, 1))) + np.abs(line @ shifts).sum(axis=2)
        reach += radius * np.linalg.norm(line, axis=2) + far * np.linalg.norm(away, axis=2) / 2
        weights = np.sqrt(np.linalg.norm(on_legs, axis=0) / steep)
        share = float(np.linalg.norm(on_legs / weights, 2) * np.linalg.norm(weights * steep))
        da, db, dl = family.errors
        norm = float(self.centre[: family.turning] @ self.centre[: family.turning])
        rest = 1.1 * norm * (3 * (da * da + db * db) + dl * dl + 18 * da * db)
        return share, float(((reach.max(axis=0) + rest) / family.reach).max())


@dataclass(frozen=True)
class CellBounds:
    """Bounds in a cell, in doubles: see ``branch_proof.BranchCell``."""

    slope: float
    bend: float
    residual: float
    joints: float
    errors: float

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
    def cost(self) -> float:
        """The less, the farther a basis reaches."""
        return float(self.slope + 2 * (self.bend * self.residual) ** 0.5 + 0.3 * self.joints)

    @property
    def excess(self) -> float:
        """Below 1 if all is proved."""
        exists = self.slope + 2 * (self.bend * self.residual) ** 0.5
        radius = self.radius
        if not radius:
            return float(1 + exists)
        regular = self.slope + self.bend * radius + 1.03 * self.joints
        return float(max(exists, regular, 1.01 * SLACK * self.errors))

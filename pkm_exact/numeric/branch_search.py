"""Where to look for the branch of poses that begins at a nominal pose: cells, centres and a basis.

The search is in doubles; what it finds is proved by ``branch_proof``. The box of s, with as many dimensions as there
are legs, is cut in halves until in each cell the equations are monotone far enough around its poses, in the
coordinates of one basis for all cells.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from flint import arb

from pkm_exact.numeric.branch_cells import SLACK, BranchFamily, Cell, Real, branch_family
from pkm_exact.numeric.branch_proof import CellProof, proved_cells
from pkm_exact.numeric.branch_robot import (
    BASIS_BITS,
    CLAIM_BITS,
    PLACE_BITS,
    Box,
    BranchCell,
    BranchRobot,
    ProvedBranch,
    boxes_of,
)
from pkm_exact.numeric.data_errors import DataErrors
from pkm_exact.numeric.linearisation import Linearisation

CELLS: Final = 48
"""Most cells of a branch."""
LARGEST: Final = 1e6
"""More than the entries and the condition number of a basis."""
STEPS: Final = 12
"""Changes of the basis that are tried, for each of its entries."""
SEED: Final = 1
CHANGED: Final = 0.12
"""Part of the entries that a change of the basis touches."""


class BranchSearch:
    """The search for a branch around one pose, for any tolerances; the basis is the same for all.

    Parameters
    ----------
    near : Linearisation
        Around a real pose.
    errors : DataErrors
        Of all tolerances as they are asked about.
    core : arb
        How far the nominal pose may be from the centre.
    """

    def __init__(self, near: Linearisation, errors: DataErrors, core: arb) -> None:
        self.near, self.core = near, core
        self.branch: ProvedBranch | None = None
        family = branch_family(near, errors)
        self.rows: Real | None = None
        if not (np.isfinite(family.reach).all() and (family.reach > 0).all()):
            return
        root = Cell(family, family.centre, np.zeros(len(family.reach)), family.reach)
        if root.has_pose:
            try:
                rows = np.rint(_best_rows(root) * 2**BASIS_BITS)
            except np.linalg.LinAlgError:
                return
            good = np.isfinite(rows).all() and np.abs(rows).max() < LARGEST and np.linalg.cond(rows) < LARGEST
            self.rows = rows if good else None

    def cells(self, errors: DataErrors) -> tuple[BranchFamily, list[tuple[int, Cell | None]]] | None:
        """The cells for some tolerances, as far as doubles tell; None if there are too many."""
        family = branch_family(self.near, errors)
        if self.rows is None or not (family.reach > 0).all():
            return None
        root = Cell(family, family.centre, np.zeros(len(family.reach)), family.reach)
        try:
            tree = _tree(root, family.basis(self.rows / 2**BASIS_BITS))
        except np.linalg.LinAlgError:
            return None
        return None if tree is None else (family, tree)

    def proved(self, errors: DataErrors) -> list[CellProof] | None:
        """The cells for some tolerances, proved; None if they are not."""
        found = self.cells(errors)
        if found is None or self.rows is None:
            return None
        family, tree = found
        rows = tuple(tuple(int(v) for v in row) for row in self.rows)
        basis = family.basis(self.rows / 2**BASIS_BITS)
        robot = BranchRobot(self.near, errors, rows)
        reach = tuple(int(r) for r in family.reach * 2**PLACE_BITS)
        splits = tuple(leg for leg, _ in tree)
        cells = [cell for _, cell in tree if cell is not None]
        boxes = boxes_of(reach, splits)
        written = tuple(_written(robot, cell, basis, box) for cell, box in zip(cells, boxes, strict=True))
        self.branch = ProvedBranch(rows, reach, splits, written)
        return proved_cells(robot, self.branch, self.core)


def _best_rows(root: Cell) -> Real:
    """A basis in which much is proved: changed at random while that helps."""
    family = root.family
    inverse = np.linalg.inv(np.concatenate([root.slope, family.chart[None]]))
    rotation, sizes, _ = np.linalg.svd(inverse[family.kept][:, :-1])
    rows = rotation * np.sqrt(sizes)
    best, step = root.bounds(family.basis(rows), joints=False).cost, 0.3
    generator = np.random.default_rng(SEED)
    for _ in range(STEPS * rows.size):
        change = generator.normal(size=rows.shape) * (generator.random(rows.shape) < CHANGED)
        tried = rows + step * rows @ change
        cost = root.bounds(family.basis(tried), joints=False).cost
        if cost < best:
            best, rows, step = cost, tried, min(1.5 * step, 0.5)
        else:
            step = max(0.98 * step, 1e-3)
    return np.asarray(rows)


def _tree(root: Cell, basis: Real) -> list[tuple[int, Cell | None]] | None:
    """Legs across which boxes are cut, and cells, in the order in which a branch has them."""
    found: list[tuple[int, Cell | None]] = []
    todo, legs = [root], np.eye(len(root.half))
    while todo:
        cell = todo.pop()
        if not cell.has_pose or len(todo) + sum(leaf is not None for _, leaf in found) >= CELLS:
            return None
        if cell.bounds(basis).excess < SLACK:
            found.append((0, cell))
            continue
        halves = [cell.half / (1 + axis) for axis in legs]
        leg = int(np.argmin([cell.bounds(basis, half).excess for half in halves]))
        shift = halves[leg] * legs[leg]
        # The lower half is looked at first: it is put on top.
        todo += [Cell(cell.family, cell.centre, cell.middle + sign * shift, halves[leg]) for sign in (1, -1)]
        found.append((leg + 1, None))
    return found


def _written(robot: BranchRobot, cell: Cell, basis: Real, box: Box) -> BranchCell:
    """A cell in integers."""
    bounds = cell.bounds(basis)
    centre = tuple(int(v) for v in np.rint(cell.centre[cell.family.kept] * 2**PLACE_BITS))
    radius = int(bounds.radius * 2**PLACE_BITS)
    first = BranchCell(centre, radius, _claimed(bounds.slope), _claimed(bounds.bend), 1)
    proof = CellProof(robot, first, box)
    greatest = np.linalg.eigvalsh(proof.joint_matrix.mid)[-1]
    return replace(first, joints=_claimed(float(max(greatest, 0.0)) ** 0.5))


def _claimed(value: float) -> int:
    return int(value * (1 + 2**-10) * 2**CLAIM_BITS) + 2

"""Where to look for the branch of poses that begins at a nominal pose: a basis and a metric to begin with, and trees.

The search is in doubles; what it finds is proved by ``branch_proof``. The box of s, with as many dimensions as there
are legs, is cut until in each cell the equations are monotone far enough around its poses, in the coordinates of one
basis for all cells, and the Jacobians of all robots are definite in a metric of the cell (``branch_tree``).
"""

from __future__ import annotations

from typing import Final

import numpy as np
from flint import arb

from pkm_exact.numeric.branch_basis import best_rows
from pkm_exact.numeric.branch_cells import BranchFamily, Cell, Real, branch_family
from pkm_exact.numeric.branch_proof import proved_cells
from pkm_exact.numeric.branch_robot import BASIS_BITS, BranchRobot, ProvedBranch
from pkm_exact.numeric.branch_tree import FULL, BranchTree, TreeSearch, first_metric, integers
from pkm_exact.numeric.cell_proof import CellProof
from pkm_exact.numeric.data_errors import DataErrors
from pkm_exact.numeric.linearisation import Linearisation

LARGEST: Final = 1e6
"""More than the entries and the condition number of a basis."""
METRIC_STEPS: Final = 150
PASSES: Final = 6
"""Boxes of s that are tried, each wider."""
NEARLY: Final = 0.985
ROOM: Final = 1.03
"""Where more than this part of the room to an end is filled, it is made wider, by more than was found."""
APART: Final = 1.06
"""By how much s must exceed errors of a leg where it is left out, at first."""


class BranchSearch:
    """The search for a branch around one pose, for any tolerances; the basis is the same for all.

    Parameters
    ----------
    near : Linearisation
        Around a real pose.
    errors : DataErrors
        Of tolerances as they are asked about, and small.
    core : arb
        How far the nominal pose may be from the centre.
    """

    def __init__(self, near: Linearisation, errors: DataErrors, core: arb) -> None:
        self.near, self.core = near, core
        self.branch: ProvedBranch | None = None
        self.rows: tuple[tuple[int, ...], ...] | None = None
        family = branch_family(near, errors)
        if not family.is_bounded:
            return
        root = Cell(family, family.centre, family.box)
        if not root.has_pose:
            return
        try:
            rows = np.rint(best_rows(root) * 2**BASIS_BITS)
            if np.isfinite(rows).all() and np.abs(rows).max() < LARGEST and np.linalg.cond(rows) < LARGEST:
                self.rows = integers(rows)
                robot = BranchRobot(near, errors, self.rows)
                self.metric = first_metric(robot, root, self._basis(family), METRIC_STEPS)
        except np.linalg.LinAlgError:
            self.rows = None

    def _basis(self, family: BranchFamily) -> Real:
        return family.basis(np.array(self.rows) / 2**BASIS_BITS)

    def found(self, errors: DataErrors) -> tuple[BranchRobot, BranchTree] | None:
        """The cells for some tolerances, as far as doubles tell; None if there are too many."""
        if self.rows is None:
            return None
        robot = BranchRobot(self.near, errors, self.rows)
        wider = np.ones((len(self.near.robot.legs.lengths), 2))
        for _ in range(PASSES):
            family = branch_family(self.near, errors, wider.max(axis=1))
            if not family.is_bounded:
                return None
            try:
                tree = TreeSearch(family, robot, self._basis(family), self.metric, APART * wider).found()
            except np.linalg.LinAlgError:
                return None
            if tree is None or (tree.filled < FULL).all():
                return None if tree is None else (robot, tree)
            wider *= np.where(tree.filled < NEARLY, 1, np.maximum(tree.filled, 1) * ROOM)
        return None

    def proved(self, found: tuple[BranchRobot, BranchTree] | None) -> list[CellProof] | None:
        """The cells, proved; None if they are not."""
        if found is None or self.rows is None:
            return None
        robot, tree = found
        self.branch = ProvedBranch(self.rows, tree.reach, tree.cuts, tree.cells)
        return proved_cells(robot, self.branch, self.core)

"""How the box of s is cut into cells that doubles promise to be provable, and what is left out as no robot is there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from pkm_exact.numeric.branch_cells import SLACK, BranchFamily, Cell, CellBounds, CellShape, Real
from pkm_exact.numeric.branch_metric import Metric, best_metric
from pkm_exact.numeric.branch_regularity import CellErrors
from pkm_exact.numeric.branch_robot import (
    CELL,
    CLAIM_BITS,
    LEFT_OUT,
    MARGIN,
    PLACE_BITS,
    WEIGHT_BITS,
    Box,
    BranchCell,
    BranchRobot,
    Cut,
)
from pkm_exact.numeric.cell_proof import CellProof

CELLS: Final = 64
"""Most cells of a branch."""
DOUBTFUL: Final = 2
"""So many times as many cells are foreseen where the search ends at once."""
NODES: Final = 16
"""Most entries of a tree for each of these cells."""
METRIC_STEPS: Final = (4, 40)
"""Steps towards a metric in a cell, and in a cell where that is not enough."""
DEFINITE: Final = 0.97
"""Greatest eigenvalue that is left of 1 by a metric."""
TRIMMED: Final = 0.06
"""Part of a cell's width that is worth to be left out."""
SMALL_ENOUGH: Final = 3.5
"""Excess of cells in which errors of legs are foreseen well enough."""
FULL: Final = 1 - 2 * MARGIN


@dataclass(frozen=True, eq=False)
class Node:
    """A box of s, a pose near those of it, and the ends (leg, 0 or 1) beyond which there are no robots."""

    box: Box
    start: Real
    ends: frozenset[tuple[int, int]]

    def cut(self, leg: int, place: int, side: int) -> Node:
        """The lower (0) or upper (1) part."""
        ends = [place if side == 1 else self.box[leg][0], place if side == 0 else self.box[leg][1]]
        box = (*self.box[:leg], (ends[0], ends[1]), *self.box[leg + 1 :])
        return replace(self, box=box, ends=self.ends - {(leg, 1 - side)})


@dataclass(frozen=True, eq=False)
class BranchTree:
    """What was found.

    Attributes
    ----------
    reach : tuple of int
    cuts, cells
        As in ``branch_robot.ProvedBranch``.
    filled : legs x 2
        Greatest error of a leg at its lower and upper ends beyond which there should be no robots, of 1.
    """

    reach: tuple[int, ...]
    cuts: tuple[Cut, ...]
    cells: tuple[BranchCell, ...]
    filled: Real


class TreeSearch:
    """The search for a tree.

    Parameters
    ----------
    family : BranchFamily
    robot : BranchRobot
    basis : n x (n - 1)
    metric : (n - 1) x (n - 1)
        To begin with in each cell.
    apart : legs x 2
        By how much s must exceed errors of a leg where it is left out, at lower and upper ends.
    """

    def __init__(self, family: BranchFamily, robot: BranchRobot, basis: Real, metric: Real, apart: Real) -> None:
        self.family, self.robot, self.basis, self.metric, self.apart = family, robot, basis, metric, apart
        self.cuts: list[Cut] = []
        self.cells: list[BranchCell] = []
        self.filled = np.zeros_like(apart)

    def found(self) -> BranchTree | None:
        """The tree; None if it has too many cells, or one without a pose."""
        box = self.family.box
        ends = frozenset((leg, side) for leg in range(len(box)) for side in (0, 1))
        todo: list[tuple[Node | None, float]] = [(Node(box, self.family.centre, ends), 1.0)]
        while todo:
            node, _ = todo.pop()
            if node is None:
                self.cuts.append(LEFT_OUT)
                continue
            more = self._grown(node)
            if more is None:
                return None
            todo += more
            foreseen = len(self.cells) + sum(count for _, count in todo)
            if foreseen > DOUBTFUL * CELLS or len(self.cells) + len(todo) > NODES * CELLS or len(self.cells) > CELLS:
                return None
        return BranchTree(tuple(high for _, high in box), tuple(self.cuts), tuple(self.cells), self.filled)

    def _grown(self, node: Node) -> list[tuple[Node | None, float]] | None:
        """A cell is found, or the box is cut: nodes that are to be looked at, the last one first."""
        todo: list[tuple[Node | None, float]] = []
        cell = Cell(self.family, node.start, node.box)
        if not cell.has_pose:
            return None
        bounds = cell.shape(self.basis).bounds(cell.half[None])[0]
        if bounds.excess < SMALL_ENOUGH:
            trimmed = self._trimmed(node, cell, todo)
            if trimmed is None:
                self.cuts.append(LEFT_OUT)
                return todo
            if trimmed is not node:
                node, cell = trimmed, Cell(self.family, cell.centre, trimmed.box)
                if not cell.has_pose:
                    return None
        legs = np.eye(len(node.box))
        halves = cell.half / (1 + np.concatenate([0 * legs[:1], legs]))
        shape = cell.shape(self.basis)
        bounds, *parts = shape.bounds(halves)
        if bounds.excess < SLACK and self._is_cell(node, shape, bounds):
            return todo
        leg = int(np.argmin([part.excess for part in parts]))
        place = (node.box[leg][0] + node.box[leg][1]) // 2
        self.cuts.append((leg + 1, place))
        count = max(1.0, parts[leg].excess / SLACK) ** len(parts)
        there = replace(node, start=cell.centre)
        return [*todo, (there.cut(leg, place, 1), count), (there.cut(leg, place, 0), count)]

    def _trimmed(self, node: Node, cell: Cell, todo: list[tuple[Node | None, float]]) -> Node | None:
        """What is left where robots may have s; None if nothing is."""
        greatest = self.apart * cell.errors(self.basis)[:, None] * 2**PLACE_BITS
        most = [(int(below), int(above)) for below, above in np.ceil(greatest)]
        for leg, (below, above) in enumerate(most):
            low, high = node.box[leg]
            if low >= above or -high >= below:
                return None
        for leg, (below, above) in enumerate(most):
            low, high = node.box[leg]
            worth = TRIMMED * (high - low)
            if high - above > worth:
                self.cuts.append((leg + 1, above))
                todo.append((None, 0.0))
                node = node.cut(leg, above, 0)
                node = replace(node, ends=node.ends | {(leg, 1)})
            if -below - low > worth:
                self.cuts += [(leg + 1, -below), LEFT_OUT]
                node = node.cut(leg, -below, 1)
                node = replace(node, ends=node.ends | {(leg, 0)})
        return node

    def _is_cell(self, node: Node, shape: CellShape, bounds: CellBounds) -> bool:
        """Whether a metric is found in which the Jacobians are definite."""
        proof = _proof(self.robot, node.box, shape.centre[self.family.kept], bounds)
        errors = CellErrors(proof)
        corners = errors.in_doubles()
        for steps in METRIC_STEPS:
            metric = best_metric(corners, self.metric, steps, DEFINITE)
            if metric.share < DEFINITE:
                self.cuts.append(CELL)
                self.cells.append(_with_metric(proof.cell, metric))
                self._fill(node, errors)
                return True
        return False

    def _fill(self, node: Node, errors: CellErrors) -> None:
        """Errors of legs at the ends beyond which there should be no robots."""
        for leg, side in node.ends:
            end = node.box[leg][side]
            filled = errors.legs.greatest[leg] * 2**PLACE_BITS / abs(end)
            if filled >= FULL:
                part = (*node.box[:leg], (end, end), *node.box[leg + 1 :])
                filled = errors.on_part(part)[leg] * 2**PLACE_BITS / abs(end)
            self.filled[leg, side] = max(self.filled[leg, side], filled)


def first_metric(robot: BranchRobot, root: Cell, basis: Real, steps: int) -> Real:
    """A metric for one cell with all errors, which should be small."""
    shape = root.shape(basis)
    whole = shape.bounds(root.half[None])[0]
    start = np.eye(basis.shape[1])
    if not whole.radius:
        return start
    return best_metric(
        CellErrors(_proof(robot, root.family.box, shape.centre[root.family.kept], whole)).in_doubles(), start, steps
    ).matrix


def _proof(robot: BranchRobot, box: Box, kept: Real, bounds: CellBounds) -> CellProof:
    """The proof of a cell, without its metric."""
    unit = 2**PLACE_BITS
    centre = tuple(int(v) for v in np.rint(kept * unit))
    written = BranchCell(centre, int(bounds.radius * unit), claimed(bounds.slope), claimed(bounds.bend), (), ())
    return CellProof(robot, written, box)


def _with_metric(cell: BranchCell, metric: Metric) -> BranchCell:
    return replace(
        cell,
        metric=integers(metric.matrix * 2**CLAIM_BITS),
        weights=integers(np.maximum(metric.weights * 2**WEIGHT_BITS, 1)),
    )


def integers(rows: Real) -> tuple[tuple[int, ...], ...]:
    """A matrix, rounded."""
    return tuple(tuple(int(v) for v in row) for row in np.rint(rows))


def claimed(value: float) -> int:
    """Somewhat more than a bound that doubles have."""
    return int(value * (1 + 2**-10) * 2**CLAIM_BITS) + 2

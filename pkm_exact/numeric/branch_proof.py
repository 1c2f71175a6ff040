"""Proof that a pose continues over all robots within tolerance without a singularity, in doubles with bounds of errors.

For s in a box L with as many dimensions as there are legs let x(s) be a solution of F(x) + s = 0 (s on the legs). L is
cut into cells with one pose for each s (``cell_proof``), which are joined at their faces, and boxes that are left out.
The errors of the data add E(x, p) to the legs, so a pose of the robot with errors p on the branch is a fixed point of
s -> E(x(s), p). That none is singular, and none at the end of a cell where there is no other, is shown cell by cell
(``branch_regularity``): see ``docs/tolerances.md``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

from pkm_exact.numeric.branch_regularity import CellErrors, is_regular
from pkm_exact.numeric.branch_robot import Box, BranchRobot, ProvedBranch, boxes_of
from pkm_exact.numeric.cell_proof import CellProof, places
from pkm_exact.numeric.enclosed_arrays import Enclosed, above, enclosed, exact, lengths, product


def joins(one: CellProof, other: CellProof, s: Enclosed) -> bool:
    """Whether two cells have the same pose at a common s."""
    family = one.family
    start = one.start(s)
    step = one.value(one.centre + product("ap,p->a", family.basis, start), s)
    x = one.centre + product("ap,p->a", family.basis, start - step)
    here, there = (above(lengths(cell.value(x, s)) / cell.free) for cell in (one, other))
    return one.holds(x, s, here) and other.holds(x, s, there)


def faces(boxes: Sequence[Box], others: Sequence[Box]) -> list[tuple[int, int, Box]]:
    """Pairs of boxes, one of each list, with a common face of all dimensions but one, and the face."""
    if not others:
        return []
    found: list[tuple[int, int, Box]] = []
    lows, highs = np.moveaxis(np.array(others), 2, 0)
    for i, box in enumerate(np.array(boxes)):
        low, high = np.maximum(box[:, 0], lows), np.minimum(box[:, 1], highs)
        touching = (low <= high).all(axis=1) & ((low == high).sum(axis=1) == 1)
        found += [(i, int(j), _ends(low[j], high[j])) for j in np.flatnonzero(touching)]
    return found


def _ends(low: NDArray[Any], high: NDArray[Any]) -> Box:
    return tuple((int(a), int(b)) for a, b in zip(low, high, strict=True))


def outer_faces(reach: Sequence[int], boxes: Sequence[Box]) -> list[tuple[int, Box]]:
    """Boxes with a face on the boundary of L, and the face."""
    return [
        (place, (*box[:leg], (end, end), *box[leg + 1 :]))
        for place, box in enumerate(boxes)
        for leg, (low, high) in enumerate(box)
        for end, outer in ((low, -reach[leg]), (high, reach[leg]))
        if end == outer
    ]


def proved_cells(family: BranchRobot, branch: ProvedBranch, core: arb) -> list[CellProof] | None:
    """The cells, if all is proved; ``core`` is how far the nominal solution may be from the centre."""
    boxes, left_out = boxes_of(branch.reach, branch.cuts)
    cells, errors = [], []
    for cell, box in zip(branch.cells, boxes, strict=True):
        cells.append(CellProof(family, cell, box))
        errors.append(CellErrors(cells[-1]))
        if not (cells[-1].is_monotone() and is_regular(errors[-1])):
            return None
    for i, j, face in faces(boxes, boxes):
        if i < j and not joins(cells[i], cells[j], places(face)[0]):
            return None
    ends = [(i, face) for i, _, face in faces(boxes, left_out)] + outer_faces(branch.reach, boxes)
    if not all(errors[i].leaves(face) for i, face in ends):
        return None
    start = next((k for k, box in enumerate(boxes) if all(low <= 0 <= high for low, high in box)), None)
    centre = enclosed([v.real + arb(0, core) for v in family.near.centre.entries()])
    return cells if start is not None and cells[start].holds(centre, exact(np.zeros(family.legs)), 0.0) else None

"""Bounds of the poses on a branch, over all robots within tolerance."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Final

import numpy as np
from flint import acb, acb_mat, arb

from pkm_exact.balls import ball
from pkm_exact.numeric.cell_proof import CellProof
from pkm_exact.numeric.centred import NORM, POSITION, origins
from pkm_exact.numeric.deviations import POSITION_ROWS, QUATERNION_ROWS, PoseBounds
from pkm_exact.numeric.enclosed_arrays import Enclosed, Real, above, enclosed, join, lengths, product
from pkm_exact.numeric.linearisation import Linearisation
from pkm_exact.numeric.pose_maps import interval, pose_map
from pkm_exact.roots.interval import Interval

WIDER: Final = 1 + 2.0**-30


def branch_bounds(
    near: Linearisation, cells: Sequence[CellProof], core: arb, attained: Sequence[Fraction]
) -> PoseBounds | None:
    """Bounds for the pose that each robot within tolerance has on the branch; None if they are too wide for an angle.

    Parameters
    ----------
    near : Linearisation
        Around the nominal pose, which is at most ``core`` from the centre.
    cells : sequence of CellProof
    core : arb
    attained : two Fraction
        Errors of position and rotation that some robot has.
    """
    nominal = enclosed(pose_map(near.robot, near.around([core] * near.robot.size)).values)
    ranges: list[tuple[Enclosed, Real]] = []
    distances: list[float] = []
    chords: list[float] = []
    for cell in cells:
        value, effect, off = _effects(near, cell)
        ranges.append((value, effect.most.sum(axis=1) + off))
        for rows, greatest in ((POSITION_ROWS, distances), (QUATERNION_ROWS, chords)):
            greatest.append(_greatest(value - nominal, effect, off, list(rows), cell))
    chord = max(chords)
    if not chord < 1:
        return None
    angle = float((4 * (arb(chord) / 2).asin()).upper()) * WIDER
    components = []
    for k in range(len(nominal.mid)):
        balls = [arb(value.mid[k], (value.rad[k] + reach[k]) * WIDER) for value, reach in ranges]
        hull = balls[0]
        for other in balls[1:]:
            hull = hull.union(other)
        components.append(interval(hull))
    ends = (interval(arb(value)).hi for value in (max(distances), angle))
    return PoseBounds(tuple(components), *(Interval(low, high) for low, high in zip(attained, ends, strict=True)))


def _effects(near: Linearisation, cell: CellProof) -> tuple[Enclosed, Enclosed, Real]:
    """The components at the centre, what each leg changes, and what the distance from the prediction does."""
    centre = acb_mat(len(cell.centre.mid), 1, [acb(arb(m, r)) for m, r in zip(*_parts(cell.centre), strict=True)])
    rows = _chord_slopes(near, cell)
    off = lengths(rows) * cell.distance * WIDER
    return enclosed(pose_map(near.robot, centre).values), product("kp,pi->ki", rows, cell.shifts), off


def _parts(values: Enclosed) -> tuple[list[float], list[float]]:
    return values.mid.tolist(), values.rad.tolist()


def _chord_slopes(near: Linearisation, cell: CellProof) -> Enclosed:
    """Rows v with g(m + A y) - g(m) = v y, one for each y that poses have, of the 19 components g.

    For a quotient r = q / N of quadrics it is (q' - r(m) N')(m + A y / 2) A / N(m + A y); and for e / sqrt(N)
    it is (A_e - e(m) N'(m + A y / 2) A / (sqrt(N(m)) (sqrt(N) + sqrt(N(m))))) / sqrt(N).
    """
    family, m = cell.family, cell.centre
    slopes = product("kab,b->ka", family.motions, m)
    values = product("ka,a->k", slopes, m).half()
    there = _reciprocal(values[NORM])
    tangents = product("ka,ap->kp", slopes, family.basis)
    bends = product("kab,ap,bq->kpq", family.motions, family.basis, family.basis)
    quotients = list(range(POSITION, NORM))
    ratios = product("k,->k", values[quotients], there)
    rows = tangents[quotients] - product("k,p->kp", ratios, tangents[NORM])
    bent = bends[quotients] - product("k,pq->kpq", ratios, bends[NORM])
    reach = product("kpq,qi->kpi", join(bent, bends[NORM][None]), cell.shifts).most.sum(axis=2)
    reach = (reach + lengths(join(bent, bends[NORM][None])) * cell.distance) / 2 * WIDER
    rows = Enclosed(rows.mid, (rows.rad + reach[:-1]) * WIDER)
    norm_row = Enclosed(tangents[NORM].mid, (tangents[NORM].rad + reach[-1]) * WIDER)
    across = product("p,pi->i", norm_row, cell.shifts).most.sum() + lengths(norm_row) * cell.distance
    norm = Enclosed(values[NORM].mid, (values[NORM].rad + across) * WIDER)
    rows = product("kp,->kp", rows, _reciprocal(norm))
    return join(*_components(near, cell, rows, norm, values[NORM], norm_row))


def _components(
    near: Linearisation, cell: CellProof, rows: Enclosed, norm: Enclosed, norm_there: Enclosed, norm_row: Enclosed
) -> list[Enclosed]:
    """Rows of position, rotation, quaternion, centroid from those of centred position and rotation."""
    family = cell.family
    unit = enclosed([ball(near.robot.frames.unit)])[0]
    centroid = product(",kp->kp", unit, rows[:3])
    turn = Enclosed(*(part[3:].reshape(3, 3, -1) for part in (rows.mid, rows.rad)))
    position = centroid - product("ijp,j->ip", turn, enclosed(origins(near.robot)[1]))
    roots = [enclosed([arb(float(n.mid), float(n.rad)).sqrt()])[0] for n in (norm, norm_there)]
    factor = _reciprocal(product(",->", roots[1], roots[0] + roots[1]))
    turning = near.robot.problem.motion.rotation_support
    count = len(turning)
    own = family.basis[:count] - product("a,p,->ap", cell.centre[:count], norm_row, factor)
    own = product("ap,->ap", own, _reciprocal(roots[0]))
    quaternion = Enclosed(*(np.zeros((4, rows.mid.shape[1])) for _ in range(2)))
    for place, k in enumerate(turning):
        quaternion.mid[k], quaternion.rad[k] = own.mid[place], own.rad[place]
    return [position, rows[3:], quaternion, centroid]


def _reciprocal(value: Enclosed) -> Enclosed:
    return enclosed([1 / arb(float(value.mid), float(value.rad))])[0]


def _greatest(change: Enclosed, effect: Enclosed, off: Real, rows: list[int], cell: CellProof) -> float:
    """The greatest length of the change of some components: at a corner."""
    signs = join(cell.corners, -cell.corners)
    there = product("vi,ki->vk", signs, effect[rows])
    shift = Enclosed(*(np.broadcast_to(part[rows], there.mid.shape) for part in (change.mid, change.rad)))
    return above(lengths(there + shift) + np.sqrt((off[rows] ** 2).sum()))

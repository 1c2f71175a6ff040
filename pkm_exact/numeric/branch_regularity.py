"""Proof that no robot within tolerance is singular at its poses of a cell, in doubles with bounds of errors.

In a cell of ``cell_proof`` the Jacobian of a robot, W (F'(m + A y) + E'(m + A y, p)) A, is the sum of a matrix that
is linear in y and of u g^T t for each error t of the data, with the column u of W of its leg and g linear in y. For
a matrix P, numbers w > 0 and z

    z.P u g.z t >= - (w (P u.z)^2 + (g.z)^2 / w) / 2   if |t| <= 1,

so z.P f' z is at least a function of y that is concave: if it is positive for all z at the corners of the
parallelotope, with room for the distance of the poses from it, the Jacobian is regular.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from pkm_exact.numeric.branch_metric import CornerMatrices
from pkm_exact.numeric.branch_robot import CLAIM_BITS, MARGIN, PLACE_BITS, WEIGHT_BITS, Box, BranchRobot, signs_of
from pkm_exact.numeric.cell_proof import CellProof
from pkm_exact.numeric.centred import NORM
from pkm_exact.numeric.enclosed_arrays import Enclosed, Real, above, are_positive, exact, join, lengths, product


class LegErrors:
    """What the errors of the data do to the legs' equations at poses m + A y.

    Parameters
    ----------
    family : BranchRobot
    centre : Enclosed
        m.
    shifts : Enclosed
        y is in a parallelotope around 0 that these vectors span, or as far from it as
    away : float
        says.
    """

    def __init__(self, family: BranchRobot, centre: Enclosed, shifts: Enclosed, away: float) -> None:
        self.family, self.centre, self.shifts, self.away = family, centre, shifts, away

    @cached_property
    def surroundings(self) -> Enclosed:
        """All m + A y."""
        basis = self.family.basis
        reach = product("kp,pi->ki", basis, self.shifts).most.sum(axis=1) + lengths(basis) * self.away
        return Enclosed(self.centre.mid, (self.centre.rad + reach) * (1 + 2.0**-36))

    @cached_property
    def motions(self) -> Enclosed:
        """Derivatives of the quantities there."""
        return product("kab,b->ka", self.family.motions, self.surroundings)

    @cached_property
    def rows(self) -> Enclosed:
        """Derivatives of what single errors add to first order, at the centre."""
        return product("leab,b->lea", self.family.single, self.centre)

    @cached_property
    def line(self) -> Enclosed:
        """The same along A."""
        return product("lea,ap->lep", self.rows, self.family.basis)

    @cached_property
    def greatest(self) -> Real:
        """The greatest change of each leg's equation.

        At y = sum of t_i times shift i, |t_i| <= 1, what errors at a corner of their cube add is c + sum of b_i t_i +
        sum of q_ij t_i t_j. But for the squares, from 0 to 1, that is linear in each t_i, so greatest at a corner.
        """
        family, bent, shifts = self.family, self.family.bent_cubes, self.shifts
        rest = family.rest(product("ka,a->k", self.motions, self.surroundings).half())
        signs = signs_of(family.single.mid.shape[1])
        line = product("ve,lep->vlp", signs, self.line)
        turned = product("vlpq,qi->vlpi", bent, shifts)
        pairs = product("vlpi,pj->vlij", turned, shifts).half()
        first, second = np.triu_indices(family.legs, 1)
        value = product("ve,lea,a->vl", signs, self.rows, self.centre).half()[..., None]
        mixed = pairs[..., first, second] + pairs[..., second, first]
        terms = join(value, product("vlp,pi->vli", line, shifts), mixed, axis=2)
        corners = signs_of(family.legs).mid
        corners = np.concatenate([corners, -corners])
        places = np.concatenate([np.ones((len(corners), 1)), corners, corners[:, first] * corners[:, second]], axis=1)
        at = product("vlk,wk->vlw", terms, exact(places))
        squares = pairs[..., range(family.legs), range(family.legs)]
        upward = np.maximum(squares.mid + squares.rad, 0).sum(axis=2)
        downward = np.maximum(squares.rad - squares.mid, 0).sum(axis=2)
        reach = np.maximum((at.mid + at.rad).max(axis=2) + upward, (at.rad - at.mid).max(axis=2) + downward)
        beside = np.sqrt(((turned.most.sum(axis=3) + self.away * lengths(bent)) ** 2).sum(axis=2))
        reach = reach + self.away * (lengths(line) + beside)
        return np.asarray((reach.max(axis=0) + rest) * (1 + 2.0**-30))


class CellErrors:
    """What the errors of the data do in a cell, at the poses of the nominal robot with lengths of the cell."""

    def __init__(self, cell: CellProof) -> None:
        self.cell, self.family, self.away = cell, cell.family, cell.distance
        self.legs = LegErrors(cell.family, cell.centre, cell.shifts, self.away)

    def on_part(self, box: Box) -> Real:
        """The greatest change of each leg's equation where s is in a part of the cell."""
        return LegErrors(self.family, *self.cell.poses_of(box)).greatest

    def leaves(self, box: Box) -> bool:
        """Whether no robot has its s in a part of the cell."""
        least = np.array([float(max(low, -high, 0)) for low, high in box]) / 2**PLACE_BITS * (1 - MARGIN)
        return bool((self.legs.greatest < least).any() or (self.on_part(box) < least).any())

    @cached_property
    def rest(self) -> Real:
        """For each leg the greatest length of what is added to its g: of second order, and beside the corners."""
        steep = self.family.rest(product("ka,ap->kp", self.legs.motions, self.family.basis))
        bent = self.family.bent_cubes
        flat = Enclosed(*(part.reshape(*part.shape[:2], -1) for part in (bent.mid, bent.rad)))
        away = self.away * lengths(flat).max(axis=0)
        return np.asarray((away + np.sqrt((steep**2).sum())) * (1 + 2.0**-36))

    @cached_property
    def slopes(self) -> Enclosed:
        """B(y) at all corners of the parallelotope."""
        return product("apq,vp->vaq", self.cell.bends, self.cell.points)

    @cached_property
    def effects(self) -> Enclosed:
        """g at all corners: corners x legs x errors x q."""
        bent = product("lepq,vp->vleq", self.family.bent_errors, self.cell.points)
        return bent + self.legs.line

    @property
    def off(self) -> float:
        """Norm of what is not at the corners."""
        return above(self.cell.off + self.cell.bend * self.away)

    def in_doubles(self) -> CornerMatrices:
        """To look for a metric."""
        return CornerMatrices(self.slopes.mid, self.effects.mid, self.cell.on_legs.mid, self.off, self.rest)


def is_regular(errors: CellErrors) -> bool:
    """Whether no robot is singular at its poses of the cell."""
    x = errors.legs.surroundings
    norm = product("ab,a,b->", errors.family.motions[NORM], x, x).half()
    return bool(norm.mid - norm.rad > 0 and is_definite(errors))


def is_definite(errors: CellErrors) -> bool:
    """Whether the symmetric part of P f' is, at the poses of all robots."""
    cell = errors.cell
    metric = exact(np.array(cell.cell.metric) / 2**CLAIM_BITS)
    weights = exact(np.array(cell.cell.weights) / 2**WEIGHT_BITS)
    if not (weights.mid > 0).all():
        return False
    size = exact(np.linalg.norm(metric.mid, 2) * (1 + 2.0**-20))
    if not are_positive(product(",,aq->aq", size, size, cell.unit) - product("ap,qp->aq", metric, metric)):
        return False
    inverse = Enclosed(1 / weights.mid, 2.0**-50 / weights.mid)
    on_legs = product("pq,qi->pi", metric, cell.on_legs)
    sizes = lengths(Enclosed(on_legs.mid.T, on_legs.rad.T))
    lost = product("pi,qi,ie->pq", on_legs, on_legs, weights)
    lost = lost + product("vlep,vleq,le->vpq", errors.effects, errors.effects, inverse)
    rest = above(errors.off * float(size.mid) + float((sizes * errors.rest).sum()))
    kept = metric + product("pa,vaq->vpq", metric, errors.slopes)
    return are_positive(kept - lost.half() - product(",pq->pq", exact(rest), cell.unit))

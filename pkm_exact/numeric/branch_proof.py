"""Proof that a pose continues over all robots within tolerance without a singularity, in doubles with bounds of errors.

For s in a box L with as many dimensions as there are legs let x(s) be a solution of F(x) + s = 0 (s on the legs). L is
cut into cells. In a cell with middle c, and the coordinates x = m + A y of the chart, let f(y) = W (F(m + A y) + s)
with W near the inverse of F'(m) A. F is quadratic, so with B(y) = W F''(A ., A y)

    f'(y) = W F'(m) A + B(y),   f(z) = W (F(m) + c) + (W F'(m) A - 1) z + B(z) z / 2   at z = -W (s - c).

If the symmetric parts of f' are positive in a convex set, f is injective there; if they are at least mu in the ball of
radius r around z, and |f(z)| < mu r, there is one zero in the ball, at most |f(z)| / mu from z. The z are a
parallelotope, and B is linear: its corners are enough. The errors of the data add E(x, p) to the legs, so a pose of
the robot p with errors p on the branch is a fixed point of s -> E(x(s), p): see ``docs/tolerances.md``.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from itertools import product as all_of

import numpy as np
from flint import arb

from pkm_exact.balls import ball
from pkm_exact.numeric.branch_robot import (
    CLAIM_BITS,
    MARGIN,
    PLACE_BITS,
    Box,
    BranchCell,
    BranchRobot,
    ProvedBranch,
    boxes_of,
)
from pkm_exact.numeric.centred import NORM
from pkm_exact.numeric.enclosed_arrays import Enclosed, Real, are_positive, enclosed, exact, join, lengths, product


def signs_of(count: int) -> Enclosed:
    """The corners of a cube, one of each two opposite ones."""
    return exact([(1, *signs) for signs in all_of((1, -1), repeat=count - 1)])


def above(value: float | Real) -> float:
    """The greatest of some bounds, with room for the rounding of what they were added from."""
    return float(np.max(value)) * (1 + 2.0**-36)


class CellProof:
    """What is proved in a cell."""

    def __init__(self, family: BranchRobot, cell: BranchCell, box: Box) -> None:
        unit = 2**PLACE_BITS
        self.family, self.cell = family, cell
        self.middle = enclosed([ball((low + high) / (2 * unit)) for low, high in box])
        half = enclosed([ball((high - low) / (2 * unit)) for low, high in box])
        self.centre = family.point(cell.centre)
        self.radius = cell.radius / unit
        self.slope, self.bend, self.joints = (v / 2**CLAIM_BITS for v in (cell.slope, cell.bend, cell.joints))
        jacobian = product("iab,a,bq->iq", family.quadrics, self.centre, family.basis)
        self.inverse = exact(np.linalg.inv(jacobian.mid))
        self.unit = exact(np.eye(family.size - 1))
        self.off = above(np.sqrt(((product("ai,iq->aq", self.inverse, jacobian) - self.unit).most ** 2).sum()))
        self.bends = product("ai,ipq->apq", self.inverse, family.bends)
        self.on_legs = self.inverse[:, family.first :]
        self.shifts = product("ai,i->ai", self.on_legs, half)
        self.corners = signs_of(family.legs)
        self.turned = product("apq,pi->iaq", self.bends, self.shifts)

    def value(self, x: Enclosed, s: Enclosed) -> Enclosed:
        """W (F(x) + s)."""
        values, first = self.family.values(x), self.family.first
        return product("ai,i->a", self.inverse, join(values[:first], values[first:] + s))

    @cached_property
    def farthest(self) -> float:
        """The greatest length of a z."""
        return above(lengths(product("vi,ai->va", self.corners, self.shifts)))

    @cached_property
    def residual(self) -> float:
        """At least the greatest |f(z)|."""
        pairs = product("iaq,qj->aij", self.turned, self.shifts)
        images = product("vi,aij,uj->vua", self.corners, pairs, self.corners)
        at_centre = lengths(self.value(self.centre, self.middle))
        return above(above(lengths(images)) / 2 + self.off * self.farthest + at_centre)

    @cached_property
    def free(self) -> float:
        """mu: at least the least eigenvalue of the symmetric part of f'."""
        return float(1 - above(self.slope + self.bend * self.radius + self.off)) - 2.0**-36

    @cached_property
    def distance(self) -> float:
        """How far the solution is from z at most."""
        return above(self.residual / self.free)

    def is_monotone(self) -> bool:
        """Whether slope and bend are what they claim, and there is one pose for each s of the cell."""
        parts = product("vi,iaq->vaq", self.corners, self.turned)
        squares = product("apq,bpq->ab", self.bends, self.bends)
        scale = exact(np.array(self.slope))
        for sign in (1.0, -1.0):
            if not are_positive(product(",aq->aq", scale, self.unit) + product(",vaq->vaq", exact(sign), parts)):
                return False
        return (
            are_positive(product(",,aq->aq", exact(self.bend), exact(self.bend), self.unit) - squares)
            and self.free > 0
            and self.residual < (1 - MARGIN) * self.free * self.radius
        )

    @cached_property
    def surroundings(self) -> Enclosed:
        """All m + A y, for y in the balls of radius r."""
        basis = self.family.basis
        reach = product("kp,pi->ki", basis, self.shifts).most.sum(axis=1) + lengths(basis) * self.radius
        return Enclosed(self.centre.mid, (self.centre.rad + reach) * (1 + 2.0**-36))

    @cached_property
    def leg_errors(self) -> tuple[Real, Real]:
        """Of each leg the greatest change of its equation, and the greatest length of what f' gains before W."""
        family, x = self.family, self.surroundings
        slopes = product("kab,b->ka", family.motions, x)
        rest = family.rest(product("ka,a->k", slopes, x).half())
        steep_rest = family.rest(product("ka,ap->kp", slopes, family.basis))
        rows = product("leab,b->lea", family.single, self.centre)
        signs = signs_of(family.single.mid.shape[1])
        values = product("ve,lea,a->vl", signs, rows, self.centre).most / 2
        line = product("ve,lep->vlp", signs, product("lea,ap->lep", rows, family.basis))
        bent = product("ve,lepq->vlpq", signs, family.bent_errors)
        away = product("vlpq,qi->vlpi", bent, self.shifts).most.sum(axis=3) + self.radius * lengths(bent)
        steep = np.sqrt(((line.most + away) ** 2).sum(axis=2)).max(axis=0) + np.sqrt((steep_rest**2).sum())
        reach = values + product("vlp,pi->vli", line, self.shifts).most.sum(axis=2) + self.radius * lengths(line)
        reach = reach + (self.farthest + self.radius) * np.sqrt((away**2).sum(axis=2)) / 2
        return (reach.max(axis=0) + rest) * (1 + 2.0**-30), steep * (1 + 2.0**-30)

    @cached_property
    def joint_matrix(self) -> Enclosed:
        """A symmetric matrix; errors of the data add to f' a matrix whose norm squared is at most its eigenvalue.

        The greatest norm of the sum of u_i v_i^T, for vectors v_i up to lengths t_i: by Cauchy's inequality the square
        is at most (sum of |u_i| t_i) times the norm of the sum of u_i u_i^T t_i / |u_i|.
        """
        steep = self.leg_errors[1]
        sizes = lengths(Enclosed(self.on_legs.mid.T, self.on_legs.rad.T))
        total = above(float((sizes * steep).sum()))
        weights = exact(steep / sizes * (1 + 2.0**-30))
        return product(",ai,bi,i->ab", exact(total), self.on_legs, self.on_legs, weights)

    def is_regular(self, reach: Real) -> bool:
        """Whether no robot is singular at its poses of the cell, and all of them have s in L."""
        x = self.surroundings
        norm = product("ab,a,b->", self.family.motions[NORM], x, x).half()
        return bool(
            norm.mid - norm.rad > 0
            and (self.leg_errors[0] < (1 - MARGIN) * reach).all()
            and are_positive(product(",,aq->aq", exact(self.joints), exact(self.joints), self.unit) - self.joint_matrix)
            and self.joints < (1 - MARGIN) * self.free
        )

    def start(self, s: Enclosed) -> Enclosed:
        """z of s."""
        return -product("ai,i->a", self.on_legs, s - self.middle)

    def holds(self, x: Enclosed, s: Enclosed, off: float) -> bool:
        """Whether all within a distance ``off`` from x, in the coordinates y, is in the ball of the cell for s.

        y with A y = x - m, for the kept coordinates; y is V (x - m) + (1 - V A) y for V near the inverse of A.
        """
        family = self.family
        basis = family.basis[family.kept]
        near = exact(np.linalg.inv(basis.mid))
        moved = product("pk,k->p", near, (x - self.centre)[family.kept])
        left = float(np.sqrt(((product("pk,kq->pq", near, basis) - self.unit).most ** 2).sum())) * (1 + 2.0**-36)
        if not left < 2.0**-20:
            return False
        wrong = 2 * left * above(lengths(moved))
        away = above(lengths(moved - self.start(s)))
        return bool(above(away + wrong + off) < (1 - MARGIN) * self.radius)


def joins(one: CellProof, other: CellProof, s: Enclosed) -> bool:
    """Whether two cells have the same pose at a common s."""
    family = one.family
    start = one.start(s)
    step = one.value(one.centre + product("ap,p->a", family.basis, start), s)
    x = one.centre + product("ap,p->a", family.basis, start - step)
    here, there = (above(lengths(cell.value(x, s)) / cell.free) for cell in (one, other))
    return one.holds(x, s, here) and other.holds(x, s, there)


def faces(boxes: Sequence[Box]) -> list[tuple[int, int, list[Fraction]]]:
    """Pairs of cells with a common face of all dimensions but one, and the middle of it."""
    found = []
    for i, j in combinations(range(len(boxes)), 2):
        common = [(max(a[0], b[0]), min(a[1], b[1])) for a, b in zip(boxes[i], boxes[j], strict=True)]
        flat = [low == high for low, high in common]
        if sum(flat) == 1 and all(low <= high for low, high in common):
            found.append((i, j, [(low + high) / 2 for low, high in common]))
    return found


def proved_cells(family: BranchRobot, branch: ProvedBranch, core: arb) -> list[CellProof] | None:
    """The cells, if all is proved; ``core`` is how far the nominal solution may be from the centre."""
    unit = 2**PLACE_BITS
    boxes = boxes_of(branch.reach, branch.splits)
    reach = np.array([r / unit for r in branch.reach])
    cells = []
    for cell, box in zip(branch.cells, boxes, strict=True):
        proof = CellProof(family, cell, box)
        if not (proof.is_monotone() and proof.is_regular(reach)):
            return None
        cells.append(proof)
    for i, j, middle in faces(boxes):
        if not joins(cells[i], cells[j], enclosed([ball(v / unit) for v in middle])):
            return None
    start = next(k for k, box in enumerate(boxes) if all(low <= 0 <= high for low, high in box))
    centre = enclosed([v.real + arb(0, core) for v in family.near.centre.entries()])
    return cells if cells[start].holds(centre, exact(np.zeros(family.legs)), 0.0) else None

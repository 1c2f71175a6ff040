"""A cell of a branch of poses: one pose for each s of it, proved in doubles with bounds of errors.

In a cell with middle c, and the coordinates x = m + A y of the chart, let f(y) = W (F(m + A y) + s) with W near the
inverse of F'(m) A. F is quadratic, so with B(y) = W F''(A ., A y)

    f'(y) = W F'(m) A + B(y),   f(z) = W (F(m) + c) + (W F'(m) A - 1) z + B(z) z / 2   at z = -W (s - c).

If the symmetric parts of f' are positive in a convex set, f is injective there; if they are at least mu in the ball of
radius r around z, and |f(z)| < mu r, there is one zero in the ball, at most |f(z)| / mu from z. The z are a
parallelotope, and B is linear: its corners are enough.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cached_property
from typing import Final

import numpy as np

from pkm_exact.balls import ball
from pkm_exact.numeric.branch_robot import CLAIM_BITS, MARGIN, PLACE_BITS, Box, BranchCell, BranchRobot, signs_of
from pkm_exact.numeric.enclosed_arrays import (
    Enclosed,
    Real,
    above,
    are_positive,
    enclosed,
    exact,
    join,
    lengths,
    product,
)

NEWTON: Final = 3


def _span(shifts: Enclosed) -> float:
    """At least the length of every sum of these columns, each at most once, with any signs."""
    return above(np.sqrt((shifts.most.sum(axis=1) ** 2).sum()))


def places(box: Box) -> tuple[Enclosed, Enclosed]:
    """Middle and half widths of a box of s."""
    unit = 2**PLACE_BITS
    middle = enclosed([ball(Fraction(low + high, 2 * unit)) for low, high in box])
    return middle, enclosed([ball(Fraction(high - low, 2 * unit)) for low, high in box])


class CellProof:
    """What is proved in a cell."""

    def __init__(self, family: BranchRobot, cell: BranchCell, box: Box) -> None:
        unit = 2**PLACE_BITS
        self.family, self.cell = family, cell
        self.middle, half = places(box)
        self.centre = family.point(cell.centre)
        self.radius = cell.radius / unit
        self.slope, self.bend = cell.slope / 2**CLAIM_BITS, cell.bend / 2**CLAIM_BITS
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
    def points(self) -> Enclosed:
        """All corners of the z."""
        return product("vi,pi->vp", join(self.corners, -self.corners), self.shifts)

    @cached_property
    def farthest(self) -> float:
        """The greatest length of a z."""
        return above(lengths(product("vi,ai->va", self.corners, self.shifts)))

    @cached_property
    def residual(self) -> float:
        """At least the greatest |f(z)|."""
        pairs = product("iaq,qj->aij", self.turned, self.shifts)
        return above(self.image(self.value(self.centre, self.middle), pairs) + self.off * self.farthest)

    def image(self, value: Enclosed, pairs: Enclosed) -> float:
        """At least the length of a vector plus a half of the sum of t_i t_j times the pairs' vectors, all |t_i| <= 1.

        With the squares of the t_i as numbers of their own, from 0 to 1, it is linear in each: greatest at a corner.
        """
        legs = range(self.family.legs)
        squares = pairs[:, legs, legs].half().half()
        first, second = np.triu_indices(len(legs), 1)
        mixed = (pairs[:, first, second] + pairs[:, second, first]).half()
        corners = self.corners.mid
        crossed = product("ak,vk->va", mixed, exact(corners[:, first] * corners[:, second]))
        turned = product("ai,ui->ua", squares, join(self.corners, -self.corners))
        turned = turned + (value + product("ai,i->a", squares, exact(np.ones(len(legs)))))[None]
        return above(lengths(crossed[:, None] + turned[None]))

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
            and self.bend > 0
            and self.free > 0
            and self.residual < (1 - MARGIN) * self.free * self.radius
        )

    def start(self, s: Enclosed) -> Enclosed:
        """z of s."""
        return -product("ai,i->a", self.on_legs, s - self.middle)

    def poses_of(self, box: Box) -> tuple[Enclosed, Enclosed, float]:
        """Of a part of the cell: a centre and shifts for each leg; poses are so far from that parallelotope at most.

        With V near the inverse of F'(n) A at the centre n = m + A u let z' = u - V (s - b), b the part's middle:
        f(z') = W (F(n) + b) + (W - W F'(n) A V) (s - b) + B(V (s - b)) V (s - b) / 2. If z' is in X, the pose is at
        most |f(z')| / mu from it.
        """
        family = self.family
        middle, half = places(box)
        start = exact(self._approximate(middle))
        centre = self.centre + product("ap,p->a", family.basis, start)
        jacobian = product("iab,a,bq->iq", family.quadrics, centre, family.basis)
        on_legs = exact(np.linalg.inv(jacobian.mid)[:, family.first :])
        shifts = product("ai,i->ai", on_legs, half)
        apart = above(lengths(start - self.start(middle))) + _span(product("ai,i->ai", self.on_legs - on_legs, half))
        if not above(apart) < (1 - MARGIN) * self.radius:
            middle = self.centre + product("ap,p->a", family.basis, self.start(middle))
            return middle, product("ai,i->ai", self.on_legs, half), self.distance
        left = self.on_legs - product("ai,iq,qj->aj", self.inverse, jacobian, on_legs)
        pairs = product("apj,pi->aij", product("apq,qj->apj", self.bends, shifts), shifts)
        residual = self.image(self.value(centre, middle), pairs) + _span(product("ai,i->ai", left, half))
        return centre, shifts, above(above(residual) / self.free)

    def _approximate(self, s: Enclosed) -> Real:
        """About the pose at s, by Newton's method."""
        family, basis = self.family, self.family.basis.mid
        shift = np.zeros(len(family.quadrics.mid))
        shift[family.first :] = s.mid
        y = self.start(s).mid
        for _ in range(NEWTON):
            slope = family.quadrics.mid @ (self.centre.mid + basis @ y)
            value = slope @ (self.centre.mid + basis @ y) / 2 + shift
            y = y - np.linalg.solve(slope @ basis, value)
        return np.asarray(y)

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

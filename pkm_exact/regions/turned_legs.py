"""A leg by itself, at positions and turns of its own: also at all turns by at most an angle about any axis.

Of all turns R by at most an angle about any axis, R B runs through the cap of directions at most that angle from B:
turns about axes perpendicular to B reach all of it. With a = s n_1 + t n_2, n_i perpendicular to B,

    (1 + |a|^2) R B = (1 - |a|^2) B + 2 a x B,    |a| = tan(angle / 2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from flint import Ordering, fmpq, fmpq_mpoly_ctx

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.rotation import scaled_rotation
from pkm_exact.regions.chart import POSITIONS, Chart, PosePolynomials, pose_polynomials, rational
from pkm_exact.regions.formula import Atom
from pkm_exact.regions.joint_quotients import rational_root
from pkm_exact.regions.placed_legs import PlacedLeg, placed_leg
from pkm_exact.regions.region_legs import OwnLength, RegionLeg, RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_shapes import inside_atom

_CAP: Final = ("a1", "a2")


@dataclass(frozen=True, eq=False)
class TurnedLeg:
    """A leg at positions that are fixed or not, and turns: its polynomials, and what they run through."""

    placed: PlacedLeg
    names: tuple[str, ...]
    box: tuple[tuple[Fraction, Fraction], ...]
    shape: tuple[Atom, ...]

    @property
    def roots(self) -> tuple[Any, ...]:
        """Its D, if it has one."""
        return () if self.placed.root is None else (self.placed.root,)

    @property
    def reaches(self) -> tuple[Atom, ...]:
        """That its rod reaches."""
        return () if self.placed.root is None else (Atom("it reaches", self.placed.root),)


def turned_leg(
    machine: RegionMachine, question: RegionQuestion, k: int, leg: RegionLeg, center: tuple[Fraction, ...] | None
) -> TurnedLeg:
    """Leg k, or another in its place, at the positions of a region, or at one, and its turns."""
    chart, mode = question.chart, question.conditions.modes[k] or 1
    place: tuple[Any, ...] = chart.position if center is None else center
    names = tuple(name for name in chart.variables if name not in POSITIONS or center is None)
    box = tuple(pair for name, pair in zip(chart.variables, chart.box, strict=True) if name in names)
    root = () if isinstance(leg.actuator, OwnLength) else ("s",)
    if question.any_axis is None:
        pose = pose_polynomials(Chart(place, chart.quaternion, chart.turns, names, box), machine.metric, root)
        cap: tuple[Atom, ...] = ()
    else:
        pose, cap, sides = _cap(machine.metric, leg.platform, place, question.any_axis, names, root)
        names, box = (*names, *(_CAP if sides else ())), (*box, *sides)
    placed = placed_leg(leg, pose, machine.metric, mode, len(names) if root else -1)
    shape = () if center is not None else tuple(inside_atom(part, pose) for part in question.shape)
    return TurnedLeg(placed, names, box, (*shape, *cap))


def every_pose(machine: RegionMachine, question: RegionQuestion) -> PosePolynomials:
    """The poses of a region; with turns about any axis, of the quaternion (1, a1, a2, a3)."""
    chart = question.chart
    if question.any_axis is None:
        return pose_polynomials(chart, machine.metric)
    ring = fmpq_mpoly_ctx.get((*chart.variables, "a1", "a2", "a3"), Ordering.lex)
    named = dict(zip(ring.names(), ring.gens(), strict=True))
    axis = [named[name] for name in ("a1", "a2", "a3")]
    return _turned_pose(ring, axis, machine.metric, chart.position)


def _turned_pose(ring: fmpq_mpoly_ctx, axis: Sequence[Any], g: Metric, place: Sequence[Any]) -> PosePolynomials:
    """The poses at a place, turned by the quaternion (1, axis)."""
    named = dict(zip(ring.names(), ring.gens(), strict=True))
    quaternion = [ring.constant(fmpq(1)), *axis]
    products = [[a * b for b in quaternion] for a in quaternion]
    norm = sum((w * products[k + 1][k + 1] for k, w in enumerate(g)), ring.constant(fmpq(g[0] * g[1] * g[2])))
    position = tuple(norm * (named[x] if isinstance(x, str) else ring.constant(rational(x))) for x in place)
    return PosePolynomials(ring, norm, position, tuple(map(tuple, scaled_rotation(products, g))))


def _cap(
    g: Metric, joint: Vector, place: Sequence[Any], most: Fraction, names: Sequence[str], root: Sequence[str]
) -> tuple[PosePolynomials, tuple[Atom, ...], tuple[tuple[Fraction, Fraction], ...]]:
    """Turns about axes perpendicular to a joint: the square of the tangent of half the angle is at most ``most``."""
    turns = _CAP if any(joint) else ()
    ring = fmpq_mpoly_ctx.get((*names, *turns, *root), Ordering.lex)
    named = dict(zip((*names, *turns, *root), ring.gens(), strict=True))
    zero = ring.constant(fmpq(0))
    size = g[0] * g[1] * g[2]
    first, second = _perpendicular(joint, g) if turns else ((Fraction(0),) * 3,) * 2
    axis = [
        named[turns[0]] * rational(x) + named[turns[1]] * rational(y) if turns else zero
        for x, y in zip(first, second, strict=True)
    ]
    pose = _turned_pose(ring, axis, g, place)
    if not turns:
        return pose, (), ()
    bounds = []
    for vector in (first, second):
        length = sum((w * x * x for w, x in zip(g, vector, strict=True)), Fraction(0)) / size
        end = rational_root(most / length, 1)
        bounds.append((-end, end))
    return pose, (Atom("within the angle", ring.constant(rational(most * size + size)) - pose.norm),), tuple(bounds)


def _perpendicular(joint: Vector, g: Metric) -> tuple[Vector, Vector]:
    """Two vectors perpendicular to one that is not 0 and to each other, in the metric."""
    covector = [w * x for w, x in zip(g, joint, strict=True)]
    k = max(range(3), key=lambda i: abs(covector[i]))
    i, j = (k + 1) % 3, (k + 2) % 3
    first = [Fraction(0)] * 3
    first[i], first[k] = covector[k], -covector[i]
    if not any(first):
        first[j] = Fraction(1)
    other = [w * x for w, x in zip(g, first, strict=True)]
    second = [covector[a] * other[b] - covector[b] * other[a] for a, b in ((1, 2), (2, 0), (0, 1))]
    scale = max(map(abs, first)), max(map(abs, second))
    return tuple(x / scale[0] for x in first), tuple(x / scale[1] for x in second)  # type: ignore[return-value]

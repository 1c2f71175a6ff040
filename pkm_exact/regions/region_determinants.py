"""Rows of wrenches all over a chart, and their determinant."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from pkm_exact.constraints.form import rational_wrench
from pkm_exact.regions.chart import Polynomial, PosePolynomials, rational
from pkm_exact.regions.placed_legs import PlacedLeg
from pkm_exact.regions.region_legs import RegionMachine


def wrench_rows(machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg]) -> list[list[Polynomial]]:
    """Of all legs, and then of the structure, on the freedoms of the motion group."""
    return [*(leg_row(leg, pose, machine) for leg in placed), *structural_rows(machine, pose)]


def structural_rows(machine: RegionMachine, pose: PosePolynomials) -> list[list[Polynomial]]:
    """Of joints that are not actuated."""
    return [structural_row(form, machine, pose) for form in machine.forms]


def leg_row(leg: PlacedLeg, pose: PosePolynomials, machine: RegionMachine) -> list[Polynomial]:
    """The wrench of a leg: N times the force along its rod, and the moment."""
    g1, g2, g3 = machine.metric
    k, b = leg.rod, leg.arm
    moment = [
        g2 * g3 * (b[1] * k[2] - b[2] * k[1]),
        g3 * g1 * (b[2] * k[0] - b[0] * k[2]),
        g1 * g2 * (b[0] * k[1] - b[1] * k[0]),
    ]
    wrench = [pose.norm * g * x for g, x in zip(machine.metric, k, strict=True)] + moment
    return [wrench[j] for j in machine.twist]


def structural_row(form: Sequence[Fraction], machine: RegionMachine, pose: PosePolynomials) -> list[Polynomial]:
    """The wrench of a linear form: its force times N^2, its moment likewise."""
    n, values = pose.norm, [pose.constant(value) for value in form]
    metric: Any = [rational(g) for g in machine.metric]
    scaled = [*values[:4], *(n * value for value in values[4:16]), values[16]]
    found = rational_wrench(scaled, pose.position, pose.rotation, metric)
    wrench = [*(n * x for x in found[:3]), *found[3:]]
    return [wrench[j] for j in machine.twist]


def determinant(rows: Sequence[Sequence[Polynomial]], zero: Polynomial) -> Polynomial:
    """The determinant of a matrix of polynomials, by minors of its first rows: no division.

    Examples
    --------
    >>> from flint import Ordering, fmpq, fmpq_mpoly_ctx
    >>> ring = fmpq_mpoly_ctx.get(("x",), Ordering.lex)
    >>> (x,) = ring.gens()
    >>> print(determinant([[x, x + 1], [x - 1, x]], ring.constant(fmpq(0))))
    1
    """
    minors: dict[int, Polynomial] = {0: zero + 1}
    for row in rows:
        following: dict[int, Polynomial] = {}
        for columns, minor in minors.items():
            for k, entry in enumerate(row):
                if columns >> k & 1 or entry.is_zero():
                    continue
                term = -entry * minor if (columns >> k).bit_count() % 2 else entry * minor
                wider = columns | 1 << k
                following[wider] = following[wider] + term if wider in following else term
        minors = following
    return minors.get((1 << len(rows)) - 1, zero)

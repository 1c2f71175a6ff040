"""Whether friction closes a grasp in space: whether its contacts bear every load, by proof either way.

Contact forces x within their cones K exert G x. Every load is borne exactly if G has rank 6 on the span of K and some x
in the inside of the cones (relative to that span) has G x = 0: a linear image of a convex cone is everything exactly if
0 is in the relative inside of it, and it spans. If not, some twist w that is not 0 has w.G x >= 0 for all x in K: no
contact opposes it, and a load that does work on it is not borne.

Either is looked for in floating point, which decides nothing: x, and for w the values of the dual cones, as centres of
second-order cones. What is found is proved exactly: x is projected on ker G over the rationals, and the true cones are
asked; w is rounded, and the dual cones are asked.

Reference: Murray, Li and Sastry, A Mathematical Introduction to Robotic Manipulation (1994), section 5.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from typing import Any

import numpy as np

from pkm_exact.polytopes.rationals import as_fraction, rational_matrix
from pkm_exact.statics.proposed_closure import DENOMINATORS, Columns
from pkm_exact.statics.ranks import kernel, left_kernel
from pkm_exact.statics.spatial_grasp import (
    SpatialContact,
    is_never_opposed,
    is_within_cone,
    spatial_grasp_matrix,
)

Array = np.ndarray[Any, np.dtype[np.float64]]
Vector = tuple[Fraction, ...]


class Closure(Enum):
    """What was proved of a grasp."""

    CLOSED = "closed by friction"
    OPEN = "not closed by friction"
    UNDECIDED = "not decided"


@dataclass(frozen=True)
class FrictionClosure:
    """A verdict and its proof.

    Attributes
    ----------
    verdict : Closure
    forces : tuple of vectors, one for each contact, or None
        Of a closed grasp: contact forces in the inside of their cones that exert nothing together.
    twist : tuple of 6 rational numbers, or None
        Of an open one: (v, w) of the object about the origin, on which no contact force does negative work.
    """

    verdict: Closure
    forces: tuple[Vector, ...] | None = None
    twist: Vector | None = None

    def __str__(self) -> str:
        if self.forces is not None:
            return (
                "closed by friction: every load is borne (proved: contact forces in the inside of their cones balance, "
                "and those of the contacts span all wrenches)"
            )
        if self.twist is not None:
            twist = ", ".join(map(str, self.twist))
            return (
                f"not closed by friction (proved): no contact force does negative work on the twist ({twist}) of the "
                "object, so that a load that does work on it is not borne"
            )
        return (
            "not decided: the grasp is at, or very near, the limit between closed and open; neither contact forces in "
            "the inside of their cones that balance were found, nor a rational twist that no contact opposes"
        )


def friction_closure(contacts: Sequence[SpatialContact]) -> FrictionClosure:
    """Whether contacts with their friction bear every load, with a proof.

    "Not decided" is possible only where a grasp is at, or very near, the limit between the two.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> def fingers(torsion):
    ...     return [
    ...         SpatialContact((-x, zero, zero), (x, zero, zero), Fraction(1, 2), torsion) for x in (one, -one)
    ...     ]
    >>> found = friction_closure(fingers(Fraction(1, 10)))
    >>> found.verdict.value, [[str(x) for x in force] for force in found.forces]
    ('closed by friction', [['1', '0', '0', '0'], ['-1', '0', '0', '0']])
    >>> print(friction_closure(fingers(None)))
    not closed by friction (proved): no contact force does negative work on the twist (0, 0, 0, 1, 0, 0) of the object, so that a load that does work on it is not borne
    """  # noqa: E501
    span = _span(contacts)
    matrix = rational_matrix(spatial_grasp_matrix(contacts)) * rational_matrix(span)
    rows = [[as_fraction(x) for x in row] for row in matrix.tolist()]
    unopposed = left_kernel(rows)
    if unopposed:
        return FrictionClosure(Closure.OPEN, twist=tuple(unopposed[0]))
    basis = kernel(rows, len(rows[0]))
    columns = Columns(contacts)
    forces = _balanced(contacts, span, basis, columns.balanced_forces()) if basis else None
    if forces is not None:
        return FrictionClosure(Closure.CLOSED, forces=forces)
    proposed = columns.separating_twist()
    for twist in (*columns.rounded(proposed), *_of_faces(rows, columns, proposed)):
        if any(twist) and all(is_never_opposed(contact, twist) for contact in contacts):
            return FrictionClosure(Closure.OPEN, twist=twist)
    return FrictionClosure(Closure.UNDECIDED)


def _of_faces(rows: Sequence[Sequence[Fraction]], columns: Columns, proposed: Array) -> list[Vector]:
    """Twists near one on which some contacts do no work at all: those that do little on it, exactly none."""
    found, seen = [], set()
    for idle in columns.idle(proposed):
        unmoved = left_kernel([[row[k] for k in idle] for row in rows]) if idle not in seen else []
        seen.add(idle)
        if not unmoved:
            continue
        basis = np.array([[float(x) for x in vector] for vector in unmoved])
        found += [
            tuple(sum((p * v[k] for p, v in zip(near, unmoved, strict=True)), Fraction(0)) for k in range(6))
            for near in columns.rounded_in(basis, proposed)
        ]
    return found


def _span(contacts: Sequence[SpatialContact]) -> list[list[Fraction]]:
    """Columns that span what the cones span, among all columns of the grasp matrix."""
    width = sum(contact.width for contact in contacts)
    columns, start = [], 0
    for contact in contacts:
        ways = [[Fraction(int(k == axis)) for k in range(3)] for axis in range(3)]
        zero = [Fraction(0)]
        chosen = ways if contact.friction else [list(contact.normal)]
        columns += [[*zero * start, *way, *zero * (width - start - 3)] for way in chosen]
        if contact.torsion:
            columns.append([Fraction(int(k == start + 3)) for k in range(width)])
        start += contact.width
    return [list(row) for row in zip(*columns, strict=True)]


def _balanced(
    contacts: Sequence[SpatialContact],
    span: Sequence[Sequence[Fraction]],
    basis: Sequence[Sequence[Fraction]],
    near: Array,
) -> tuple[Vector, ...] | None:
    """Forces with G x = 0, exactly, near those given, if they are in the inside of their cones."""
    columns = np.array([[float(x) for x in row] for row in span])
    kernels = np.array([[float(x) for x in row] for row in basis]).T
    shares = np.linalg.lstsq(columns @ kernels, near, rcond=None)[0]
    largest = float(np.abs(shares).max())
    if not np.isfinite(largest) or largest == 0:
        return None
    for denominator in DENOMINATORS:
        parts = [Fraction(float(x) / largest).limit_denominator(denominator) for x in shares]
        inner = [
            sum((p * row[k] for p, row in zip(parts, basis, strict=True)), Fraction(0)) for k in range(len(basis[0]))
        ]
        whole = [sum((x * y for x, y in zip(row, inner, strict=True)), Fraction(0)) for row in span]
        forces, start = [], 0
        for contact in contacts:
            forces.append(tuple(whole[start : start + contact.width]))
            start += contact.width
        if all(is_within_cone(c, x, strictly=True) for c, x in zip(contacts, forces, strict=True)):
            return tuple(forces)
    return None

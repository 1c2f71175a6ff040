"""Contact forces that balance, and twists that no contact opposes, proposed in floating point.

Of a contact with unit normal n and unit vectors across it, forces are (f_n, f_t, f_u, z). With mu and gamma the scaled
(f_n, (f_t, f_u) / mu) and, if it is soft, (f_n', z / gamma) with f_n = f_n' lie in second-order cones. A twist does the
work a_n f_n + .. + b z, never negative if a_n = u + u' with (u, mu a_t, mu a_u) and (u', gamma b) in such cones.
Points are taken from the middle of the contacts, and by their greatest distance from it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from typing import Any, Final

import numpy as np

from pkm_exact.screws.screw import cross
from pkm_exact.statics.cone_centre import cone_centre
from pkm_exact.statics.spatial_grasp import SpatialContact

DENOMINATORS: Final = (1, 2, 3, 6, 12, 60, 10**3, 10**5, 10**8, 10**12)
"""What is proposed is rounded to these, one after another: short numbers first."""

Array = np.ndarray[Any, np.dtype[np.float64]]
Vector = tuple[Fraction, ...]


class Columns:
    """Scaled directions of contact forces, and their wrenches.

    Attributes
    ----------
    sizes : list of int
        Dimensions of the cones.
    wrenches : array of shape (6, sum of sizes)
        Those of the second cone of a soft contact without its normal force, which is that of the first.
    equal : list of pairs
        Places of normal forces that are the same.
    """

    def __init__(self, contacts: Sequence[SpatialContact]) -> None:
        points = [contact.point for contact in contacts]
        self.contacts = contacts
        self.middle = tuple(sum((Fraction(p[k]) for p in points), Fraction(0)) / len(points) for k in range(3))
        away = (abs(x - c) for p in points for x, c in zip(p, self.middle, strict=True))
        self.length = max(away) or Fraction(1)
        self.sizes: list[int] = []
        self.equal: list[tuple[int, int]] = []
        self._forces: list[tuple[int, Array]] = []
        columns: list[Array] = []
        for number, contact in enumerate(contacts):
            for force in self._directions(contact):
                self._forces.append((number, force))
                columns.append(self._wrench(contact, force))
        self.wrenches = np.array(columns).T

    def _directions(self, contact: SpatialContact) -> list[Array]:
        """Contact forces, scaled by friction, along the coordinates of the contact's cones."""
        normal = np.array(list(map(float, contact.normal)))
        size = float(np.linalg.norm(normal))
        normal = normal / size
        one = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
        one = one / np.linalg.norm(one)
        first = sum(self.sizes)
        ways = [normal]
        if contact.friction:
            ways += [float(contact.friction) * way for way in (one, np.cross(normal, one))]
        self.sizes.append(len(ways))
        found = [np.concatenate([way, np.zeros(contact.width - 3)]) for way in ways]
        if contact.torsion:
            self.equal.append((first, first + len(ways)))
            self.sizes.append(2)
            found += [np.zeros(4), np.array([0.0, 0.0, 0.0, float(contact.torsion) / size])]
        return found

    def _wrench(self, contact: SpatialContact, force: Array) -> Array:
        arm = np.array([float((x - c) / self.length) for x, c in zip(contact.point, self.middle, strict=True)])
        moment = np.cross(arm, force[:3])
        if contact.width == 4:
            moment = moment + force[3] * np.array(list(map(float, contact.normal))) / float(self.length)
        return np.concatenate([force[:3], moment])

    def balanced_forces(self) -> Array:
        """Contact forces, one contact after another, that nearly balance if some in their cones do."""
        same = np.zeros((len(self.equal), sum(self.sizes)))
        for row, (one, other) in zip(same, self.equal, strict=True):
            row[one], row[other] = 1.0, -1.0
        shares = cone_centre(self.sizes, np.vstack([self.wrenches, same]))
        found = [np.zeros(contact.width) for contact in self.contacts]
        for share, (number, force) in zip(shares, self._forces, strict=True):
            found[number] += share * force
        return np.concatenate(found)

    def separating_twist(self) -> Array:
        """A twist on which contact forces do nearly no negative work if there is one."""
        added = [other for _, other in self.equal]
        total = np.eye(sum(self.sizes))
        for one, other in self.equal:
            total[one, other] = 1.0
        total, works = np.delete(total, added, axis=0), np.delete(self.wrenches, added, axis=1).T
        # Values of work are in the range of W: those across it are none.
        across = np.linalg.svd(works)[0][:, 6:].T
        values = total @ cone_centre(self.sizes, across @ total)
        return np.asarray(np.linalg.lstsq(works, values, rcond=None)[0])

    def rounded(self, twist: Array) -> Iterator[Vector]:
        """Rational twists near one, about the origin."""
        largest = float(np.abs(twist).max())
        if not np.isfinite(largest) or largest == 0:
            return
        for denominator in DENOMINATORS:
            parts = [Fraction(float(x) / largest).limit_denominator(denominator) for x in twist]
            turn = [x / self.length for x in parts[3:]]
            yield (*(x - y for x, y in zip(parts[:3], cross(turn, self.middle), strict=True)), *turn)

    def idle(self, twist: Array) -> Iterator[tuple[int, ...]]:
        """Places, among columns that span the cones, of the contacts that do least work: one, two and so on."""
        work, place, parts = np.abs(twist @ self.wrenches), 0, []
        most = np.zeros(len(self.contacts))
        for value, (number, _) in zip(work, self._forces, strict=True):
            most[number] = max(most[number], value)
        for contact in self.contacts:
            width = (3 if contact.friction else 1) + bool(contact.torsion)
            parts.append(tuple(range(place, place + width)))
            place += width
        order = np.argsort(most)
        for count in range(1, len(order)):
            yield tuple(sorted(k for number in order[:count] for k in parts[number]))

    def rounded_in(self, basis: Array, twist: Array) -> Iterator[list[Fraction]]:
        """Rational coefficients of a basis of twists about the origin for one near a twist about the middle."""
        turn = twist[3:] / float(self.length)
        whole = np.concatenate([twist[:3] - np.cross(turn, list(map(float, self.middle))), turn])
        shares = np.linalg.lstsq(basis.T, whole, rcond=None)[0]
        largest = float(np.abs(shares).max())
        if not np.isfinite(largest) or largest == 0:
            return
        for denominator in DENOMINATORS:
            yield [Fraction(float(x) / largest).limit_denominator(denominator) for x in shares]

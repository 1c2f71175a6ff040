"""Grasps in space: which wrench contacts exert on an object, which forces are internal or within friction cones.

A contact at p with inward normal n exerts a force f and, if it is soft, a moment z n about its normal: the columns
(e_k, p x e_k) and (0, n) of the grasp matrix G, in coordinates of the base. Internal forces are ker G. With
Coulomb friction mu and torsional friction gamma, a length,

    f.n >= 0,   |f|^2 |n|^2 <= (1 + mu^2) (f.n)^2,   |z| |n|^2 <= gamma f.n

which are the true cones, rational for a rational normal of any length.

References: Zatsiorsky and Latash, in Parallel Manipulators: Towards New Applications (2008), chapter 20; Murray, Li and
Sastry, A Mathematical Introduction to Robotic Manipulation (1994), section 5.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.errors import InputError
from pkm_exact.screws.screw import cross, dot
from pkm_exact.statics.ranks import kernel

Triple = tuple[Fraction, Fraction, Fraction]


@dataclass(frozen=True)
class SpatialContact:
    """A contact in space.

    Attributes
    ----------
    point, normal : triples of Fraction
        The normal points into the object; of any length but 0.
    friction : Fraction
        Tangential force by normal force, at most; 0 without friction.
    torsion : Fraction or None
        Moment about the normal by normal force, at most: a length. None for a hard contact, which exerts none.
    """

    point: Triple
    normal: Triple
    friction: Fraction = Fraction(0)
    torsion: Fraction | None = None

    def __post_init__(self) -> None:
        for name, value in (("point", self.point), ("normal", self.normal)):
            if len(value) != 3 or not all(isinstance(x, int | Fraction) for x in value):
                raise InputError(f"contact: its {name} is not three rational numbers; give three of type Fraction")
        if not any(self.normal):
            raise InputError("contact: its normal is 0; give the direction into the object")
        for name, number in (("friction", self.friction), ("torsion", self.torsion)):
            if number is not None and not (isinstance(number, int | Fraction) and number >= 0):
                raise InputError(f"contact: its {name} is not a rational number from 0; give one of type Fraction")

    @property
    def width(self) -> int:
        """How many columns it has in the grasp matrix."""
        return 3 if self.torsion is None else 4


def spatial_grasp_matrix(contacts: Sequence[SpatialContact]) -> list[list[Fraction]]:
    """G, with the rows F_x, F_y, F_z, M_x, M_y, M_z: of every contact three forces, and the moment if it is soft.

    Returns
    -------
    list of 6 rows
        Of 3 columns for each hard contact and 4 for each soft one; moments are about the origin.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> soft = SpatialContact((-one, zero, zero), (one, zero, zero), torsion=one)
    >>> [[str(x) for x in row] for row in spatial_grasp_matrix([soft])][3:]
    [['0', '0', '0', '1'], ['0', '0', '1', '0'], ['0', '-1', '0', '0']]
    """
    if not contacts:
        raise InputError("grasp: no contacts; give one at least")
    columns = []
    for contact in contacts:
        for axis in range(3):
            force = tuple(Fraction(int(axis == k)) for k in range(3))
            columns.append([*force, *cross(contact.point, force)])
        if contact.torsion is not None:
            columns.append([Fraction(0)] * 3 + list(map(Fraction, contact.normal)))
    return [list(row) for row in zip(*columns, strict=True)]


def spatial_internal_forces(contacts: Sequence[SpatialContact]) -> list[list[Fraction]]:
    """A basis of the contact forces that exert nothing together: ker G, exactly.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> pair = [SpatialContact((-x, zero, zero), (x, zero, zero)) for x in (one, -one)]
    >>> [[str(x) for x in force] for force in spatial_internal_forces(pair)]
    [['-1', '0', '0', '1', '0', '0']]
    """
    rows = spatial_grasp_matrix(contacts)
    return kernel(rows, len(rows[0]))


def is_within_cone(contact: SpatialContact, force: Sequence[Fraction], *, strictly: bool = False) -> bool:
    """Whether a contact can exert a force, and a moment if it is soft: exactly, by its true cone.

    Parameters
    ----------
    force : sequence of 3 or 4 rational numbers
        As in the columns of the grasp matrix.
    strictly : bool
        Whether it must be in the inside of the cone; without friction, of the ray of normal forces.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> finger = SpatialContact((zero, zero, zero), (zero, zero, one), Fraction(1, 2))
    >>> edge = (Fraction(3, 10), Fraction(2, 5), one)
    >>> is_within_cone(finger, edge), is_within_cone(finger, edge, strictly=True)
    (True, False)
    """
    if len(force) != contact.width:
        raise InputError(f"force: {len(force)} numbers; give {contact.width}, as the columns of the grasp matrix")
    n, mu = contact.normal, contact.friction
    along, size = dot(force[:3], n), dot(n, n)
    rooms = [along]
    if mu:
        rooms.append((1 + mu * mu) * along * along - dot(force[:3], force[:3]) * size)
    elif any(cross(force[:3], n)):
        return False
    if contact.torsion:
        rooms.append(contact.torsion * along - abs(force[3]) * size)
    elif contact.torsion is not None and force[3]:
        return False
    return all(room > 0 if strictly else room >= 0 for room in rooms)


def is_never_opposed(contact: SpatialContact, twist: Sequence[Fraction]) -> bool:
    """Whether no force within the cone does negative work on a twist (v, w) of the object about the origin, exactly.

    The work of (f, z) is a.f + b z with a = v + w x p, b = n.w. With c = a - |b| gamma n / |n|^2 it is at least c.f,
    and can be that; this is never negative if c lies in the dual cone: c.n >= 0 and mu^2 |c x n|^2 <= (c.n)^2.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> finger = SpatialContact((zero, zero, zero), (zero, zero, one), Fraction(1, 2))
    >>> rest = [zero] * 3
    >>> is_never_opposed(finger, [2 * one, zero, one, *rest]), is_never_opposed(finger, [3 * one, zero, one, *rest])
    (True, False)
    """
    n, point = contact.normal, contact.point
    moved = [v + x for v, x in zip(twist[:3], cross(twist[3:], point), strict=True)]
    if contact.torsion:
        share = abs(dot(n, twist[3:])) * contact.torsion / dot(n, n)
        moved = [x - share * y for x, y in zip(moved, n, strict=True)]
    across, along = cross(moved, n), dot(moved, n)
    return along >= 0 and contact.friction**2 * dot(across, across) <= along * along

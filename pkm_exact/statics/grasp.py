"""Grasps: which wrench contact forces exert on an object, which of them are internal, and whether friction closes them.

In the plane, a contact at p with inward normal n exerts a normal force and a tangential one, and, if its point may
migrate, a moment: columns (n, p x n), (t, p x t), (0, 1) of the grasp matrix G, F = G f. Internal forces are ker G.
With Coulomb friction mu, the forces at a contact are the combinations of the two edges of its cone, n + mu t and n - mu
t, with coefficients that are not negative. The grasp is closed if these wrenches bear every load: they span, and some
combination with positive coefficients is 0.

References: Zatsiorsky and Latash, in Parallel Manipulators: Towards New Applications (2008), chapter 20; Murray, Li and
Sastry, A Mathematical Introduction to Robotic Manipulation (1994), section 5.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.polytopes.rationals import rational_matrix
from pkm_exact.statics.forces import has_positive_vector
from pkm_exact.statics.ranks import kernel, left_kernel

Pair = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Contact:
    """A contact in the plane.

    Attributes
    ----------
    point, normal : pairs of Fraction
        The normal points into the object; of any length, which is the unit of the contact's forces.
    has_moment : bool
        Whether the contact exerts a moment too: where its point may migrate.
    """

    point: Pair
    normal: Pair
    has_moment: bool = False


def grasp_matrix(contacts: Sequence[Contact]) -> list[list[Fraction]]:
    """G, with the rows F_x, F_y, M_z: of every contact the normal and the tangential force, and its moment.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> [[str(x) for x in row] for row in grasp_matrix([Contact((zero, -one), (zero, one))])]
    [['0', '-1'], ['1', '0'], ['0', '-1']]
    """
    columns = []
    for contact in contacts:
        x, y = contact.normal
        columns += [_wrench(contact.point, (x, y)), _wrench(contact.point, (-y, x))]
        if contact.has_moment:
            columns.append([Fraction(0), Fraction(0), Fraction(1)])
    return [list(row) for row in zip(*columns, strict=True)]


def internal_forces(contacts: Sequence[Contact]) -> list[list[Fraction]]:
    """A basis of the contact forces that exert nothing together: ker G, exactly."""
    rows = grasp_matrix(contacts)
    return kernel(rows, len(rows[0]))


def is_closed_by_friction(contacts: Sequence[Contact], friction: Fraction) -> bool:
    """Whether contacts without moments, with this coefficient of friction, bear every load. Decided exactly.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> opposite = [Contact((-one, zero), (one, zero)), Contact((one, zero), (-one, zero))]
    >>> is_closed_by_friction(opposite, Fraction(1, 10)), is_closed_by_friction(opposite, zero)
    (True, False)
    """
    edges = []
    for contact in contacts:
        x, y = contact.normal
        edges += [_wrench(contact.point, (x - side * y, y + side * x)) for side in (friction, -friction)]
    if rational_matrix(edges).rank() < 3:
        return False
    return has_positive_vector(left_kernel(edges))


def _wrench(point: Pair, force: Pair) -> list[Fraction]:
    return [force[0], force[1], point[0] * force[1] - point[1] * force[0]]

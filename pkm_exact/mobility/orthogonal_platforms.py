"""Orthogonal platforms: legs in groups of four about an axis whose Gramian M^T K M is diagonal, exactly.

A leg with the tilt f and the azimuth b has the unit direction u and the moment v, u.v = 0,

    u = (sin f cos b, sin f sin b, cos f),   v = x (sin b, -cos b, 0) + y (cos f cos b, cos f sin b, -sin f).

Groups of n > 2 legs of equal f, x, y and weight k at regular azimuths are orthogonal together if

    sum k n sin(f) x = 0   and   sum k n sin(2 f) y = 0.

Both are linear in x and y, so that the last group follows from the others. Here n = 4, the one number of legs whose
regular azimuths have rational cosines and sines. Reference: Ukidve, McInroy and Jafari in Parallel Manipulators:
Towards New Applications (2008), ch. 3, theorem 4, with x and y of its (34) restored.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.screws.exact_matrix import Row
from pkm_exact.screws.screw import cross

CosSin = tuple[Fraction, Fraction]
"""Rational cosine and sine of an angle."""


@dataclass(frozen=True)
class LegGroup:
    """Four legs at right angles about the axis.

    Attributes
    ----------
    tilt, azimuth : tuple of Fraction
        Cosine and sine: of the legs to the axis, and of the first leg about it.
    x, y : Fraction
        Moments of the legs.
    weight : Fraction
        k, such as a stiffness; positive.
    """

    tilt: CosSin
    azimuth: CosSin
    x: Fraction
    y: Fraction
    weight: Fraction = Fraction(1)

    def rows(self) -> tuple[Row, ...]:
        """Direction and moment of each leg: a row of the inverse Jacobian M."""
        c, s = self.tilt
        cb, sb = self.azimuth
        found = []
        for a, b in ((cb, sb), (-sb, cb), (-cb, -sb), (sb, -cb)):
            moment = (self.x * b + self.y * c * a, -self.x * a + self.y * c * b, -self.y * s)
            found.append((s * a, s * b, c, *moment))
        return tuple(found)


def completed(groups: Sequence[LegGroup], tilt: CosSin, azimuth: CosSin, weight: Fraction = Fraction(1)) -> LegGroup:
    """The further group that makes groups orthogonal.

    Raises
    ------
    InputError
        If cosine and sine of an angle do not fit, a weight is not positive, or no group with this tilt does it.

    Examples
    --------
    >>> three, four, zero, one = Fraction(3, 5), Fraction(4, 5), Fraction(0), Fraction(1)
    >>> first = LegGroup((three, four), (one, zero), Fraction(2), one)
    >>> last = completed([first], (four, three), (zero, one))
    >>> print(last.x, last.y)
    -8/3 -1
    """
    for group in (*groups, LegGroup(tilt, azimuth, Fraction(0), Fraction(0), weight)):
        for name, (c, s) in (("tilt", group.tilt), ("azimuth", group.azimuth)):
            if c * c + s * s != 1:
                raise InputError(f"{name}: {c}, {s} are not cosine and sine of an angle; their squares add up to 1")
        if group.weight <= 0:
            raise InputError(f"weight: {group.weight} is not positive; give one that is")
    first = sum((g.weight * g.tilt[1] * g.x for g in groups), Fraction(0))
    second = sum((g.weight * g.tilt[0] * g.tilt[1] * g.y for g in groups), Fraction(0))
    c, s = tilt
    if (s == 0 and first) or (c * s == 0 and second):
        raise InputError("tilt: legs along the axis or across it cannot balance the others; give another angle")
    x = -first / (weight * s) if s else Fraction(0)
    y = -second / (weight * c * s) if c * s else Fraction(0)
    return LegGroup(tilt, azimuth, x, y, weight)


def weighted_gramian(groups: Sequence[LegGroup]) -> tuple[Row, ...]:
    """M^T K M."""
    rows = [(group.weight, row) for group in groups for row in group.rows()]
    return tuple(tuple(sum((k * r[i] * r[j] for k, r in rows), Fraction(0)) for j in range(6)) for i in range(6))


def leg_joints(row: Row, along: Fraction, length: Fraction) -> tuple[Vector, Vector]:
    """Joints of base and platform of a leg at home, the platform's frame being that of the base.

    The platform's joint is u x v + t u: the choice of t is free.

    Parameters
    ----------
    row : Row
        Direction and moment.
    along : Fraction
        t.
    length : Fraction
        Of the leg, positive.
    """
    u, v = (row[0], row[1], row[2]), (row[3], row[4], row[5])
    p = cross(u, v)
    joint = (p[0] + along * u[0], p[1] + along * u[1], p[2] + along * u[2])
    return (joint[0] - length * u[0], joint[1] - length * u[1], joint[2] - length * u[2]), joint

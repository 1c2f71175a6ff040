"""The rotation and position that fit measured points best, enclosed for all readings within their intervals.

With all legs read, the platform's joints P_j are known to be at Q_j, within bounds. The rotation that minimises
sum |C + R P_j - Q_j|^2 belongs to the eigenvector of the largest eigenvalue of Horn's matrix N, a quaternion; C is the
mean of Q_j - R P_j. The eigenvalue is the largest root of the quartic l^4 - 2 |H|^2 l^2 - 8 det(H) l + det N with
H = sum (Q_j - mean)(P_j - mean)^T. Reference: chapter 7 of *Parallel Manipulators* (2008); Horn, J. Opt. Soc. Am. A 4
(1987).

Two steps prove the enclosure for every N in the box: Krawczyk's operator has one eigenvector with e.e0 = 1 and its
eigenvalue in a box, and s - N + k e0 e0^T is positive definite for an s below that eigenvalue, so that no other
eigenvalue is above s. What this does not prove is refused.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

import numpy as np
from flint import arb, arb_mat

from pkm_exact.balls import ball, box_around_zero, hull, unit_matrix
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.numeric.pose_maps import interval
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

_BITS: Final = 192
_ROUNDS: Final = 12
"""How often a box is made larger before it is given up."""

Place = tuple[Interval, Interval, Interval]
"""Where a measured point is."""


@dataclass(frozen=True)
class FittedPose:
    """Bounds of the best fit, for all readings within theirs.

    Attributes
    ----------
    position : Place
    rotation : tuple of Place
        By rows.
    eigenvalue : Interval
        The largest one of Horn's matrix.
    """

    position: Place
    rotation: tuple[Place, Place, Place]
    eigenvalue: Interval


def sensed_place(base: Vector, triad: Sequence[Vector], angles: tuple[Interval, Interval], length: Interval) -> Place:
    """Where a leg ends, by both angles of its universal joint, in radians, and its length.

    Parameters
    ----------
    base : Vector
        Where the leg starts.
    triad : sequence of Vector
        i, j and k of the joint: i the fixed axis; perpendicular unit vectors, right-handed, checked exactly.
    angles : tuple of Interval
        About i, and from i to the leg.
    length : Interval

    Examples
    --------
    >>> e = [tuple(map(Fraction, v)) for v in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    >>> still, two = Interval(Fraction(0), Fraction(0)), Interval(Fraction(2), Fraction(2))
    >>> [float(x) for x in sensed_place(e[2], e, (still, still), two)]
    [2.0, 0.0, 1.0]
    """
    i, j, k = triad
    grams = [sum((a * b for a, b in zip(u, v, strict=True)), Fraction(0)) for u in triad for v in triad]
    if (
        grams != [1, 0, 0, 0, 1, 0, 0, 0, 1]
        or i[0] * (j[1] * k[2] - j[2] * k[1]) + i[1] * (j[2] * k[0] - j[0] * k[2]) + i[2] * (j[0] * k[1] - j[1] * k[0])
        != 1
    ):
        raise InputError("triad: not three perpendicular unit vectors, right-handed; give exact ones")
    with working_precision(_BITS):
        first, second, long = (hull(x.lo, x.hi) for x in (*angles, length))
        parts = second.cos(), -second.sin() * first.sin(), -second.sin() * first.cos()
        x, y, z = (
            interval(ball(base[n]) + long * (parts[0] * ball(i[n]) + parts[1] * ball(j[n]) + parts[2] * ball(k[n])))
            for n in range(3)
        )
    return x, y, z


def fitted_pose(joints: Sequence[Vector], places: Sequence[Place]) -> FittedPose:
    """Bounds of the pose that fits best, whatever the readings within their bounds.

    Parameters
    ----------
    joints : sequence of Vector
        In the platform's frame, at least three.
    places : sequence of Place
        Where they are, within bounds; ordinary coordinates.

    Raises
    ------
    InputError
        If it is not proved that there is one best rotation for all readings: joints or places nearly on a line, or
        bounds that are too wide.

    Examples
    --------
    >>> joints = [tuple(map(Fraction, c)) for c in ((1, 0, 0), (0, 1, 0), (0, 0, 0))]
    >>> places = [tuple(Interval(Fraction(x), Fraction(x)) for x in c) for c in ((0, 1, 5), (-1, 0, 5), (0, 0, 5))]
    >>> found = fitted_pose(joints, places)
    >>> [round(float(x), 9) + 0.0 for x in found.rotation[0]], round(float(found.position[2]), 9)
    ([0.0, -1.0, 0.0], 5.0)
    """
    if len(joints) != len(places) or len(joints) < 3:
        raise InputError(f"joints, places: {len(joints)} and {len(places)}; give as many of both, three at least")
    with working_precision(_BITS):
        centre = [sum((p[n] for p in joints), Fraction(0)) / len(joints) for n in range(3)]
        measured = [[hull(x.lo, x.hi) for x in place] for place in places]
        moments = [
            [
                sum((q[i] * ball(p[j] - centre[j]) for p, q in zip(joints, measured, strict=True)), arb(0))
                for j in range(3)
            ]
            for i in range(3)
        ]
        value, quaternion = _greatest_eigenvector(horn_matrix(moments))
        rows = _rotation(quaternion)
        means = [sum((q[n] for q in measured), arb(0)) / len(joints) for n in range(3)]
        position = [
            m - sum((r * ball(c) for r, c in zip(row, centre, strict=True)), arb(0))
            for m, row in zip(means, rows, strict=True)
        ]
        x, y, z = (_place(row) for row in rows)
        return FittedPose(_place(position), (x, y, z), interval(value))


def horn_matrix(moments: Sequence[Sequence[arb]]) -> arb_mat:
    """N of H = sum Q P^T: e^T N e = trace(R^T H) for unit quaternions e, scalar first.

    >>> horn_matrix([[1, 0, 0], [0, 1, 0], [0, 0, 1]])[0, 0] == 3
    True
    """
    (a, b, c), (d, e, f), (g, h, i) = moments
    return arb_mat(
        [
            [a + e + i, h - f, c - g, d - b],
            [h - f, a - e - i, b + d, c + g],
            [c - g, b + d, e - a - i, f + h],
            [d - b, c + g, f + h, i - a - e],
        ]
    )


def _greatest_eigenvector(matrix: arb_mat) -> tuple[arb, list[arb]]:
    """The largest eigenvalue and its eigenvector, of a length near 1, for all symmetric matrices in a ball."""
    middle = np.array([[float(matrix[i, j].mid()) for j in range(4)] for i in range(4)])
    if not np.isfinite(middle).all():
        raise InputError(_REFUSED)
    values, vectors = np.linalg.eigh(middle)
    guess = [arb(float(x)) for x in (*vectors[:, 3], values[3])]
    box = _eigenpair(matrix, guess)
    between = arb(float(values[2] + values[3]) / 2)
    if box is None or not between < box[4]:
        raise InputError(_REFUSED)
    lift = arb(2 * float(values[3] - values[2]))
    shifted = [[between * int(i == j) - matrix[i, j] + lift * guess[i] * guess[j] for j in range(4)] for i in range(4)]
    if not all(arb_mat([row[:k] for row in shifted[:k]]).det() > 0 for k in range(1, 5)):
        raise InputError(_REFUSED)
    return box[4], box[:4]


_REFUSED: Final = (
    "places: it is not proved that there is one best rotation for all readings; read more precisely, or see that the"
    " joints are not on a line"
)


def _eigenpair(matrix: arb_mat, guess: list[arb]) -> list[arb] | None:
    """Krawczyk's operator on N e = l e, e.e0 = 1: the one solution near the guess, for every N in the ball."""
    chart = [value * (1 / sum((x * x for x in guess[:4]), arb(0))).mid() for value in guess[:4]]
    start = arb_mat(5, 1, guess)
    try:
        inverse = arb_mat(5, 5, [x.mid() for x in _slope(matrix, guess, chart).inv().entries()])
    except ZeroDivisionError:
        return None
    vector = arb_mat(4, 1, guess[:4])
    left = [*(matrix * vector - vector * guess[4]).entries()]
    left.append(sum((c * x for c, x in zip(chart, guess, strict=False)), arb(-1)))
    newton = inverse * arb_mat(5, 1, left)
    radii = [x.abs_upper() * 2 + arb(2) ** -100 for x in newton.entries()]
    for _ in range(_ROUNDS):
        around = box_around_zero(radii)
        box = [*(start + around).entries()]
        image = (unit_matrix(5) - inverse * _slope(matrix, box, chart)) * around - newton
        if all(x.abs_upper() < r for x, r in zip(image.entries(), radii, strict=True)):
            return [*(start + image).entries()]
        radii = [(x.abs_upper() + r) * arb("1.1") for x, r in zip(image.entries(), radii, strict=True)]
        radii = [r.abs_upper() for r in radii]
    return None


def _slope(matrix: arb_mat, at: Sequence[arb], chart: Sequence[arb]) -> arb_mat:
    rows = [[matrix[i, j] - (at[4] if i == j else 0) for j in range(4)] + [-at[i]] for i in range(4)]
    return arb_mat([*rows, [*chart, arb(0)]])


def _rotation(quaternion: Sequence[arb]) -> list[list[arb]]:
    a, b, c, d = quaternion
    norm = a * a + b * b + c * c + d * d
    rows = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]
    return [[x / norm for x in row] for row in rows]


def _place(values: Sequence[arb]) -> Place:
    x, y, z = (interval(value) for value in values)
    return x, y, z

"""The pose from more sensors than freedoms, by linear equations: the corrected solution of chapter 7.

Leg i measures W_i (C + R P_i - B_i) = d_i, W_i the projection to what is measured and d_i the leg's vector along it.
The least squares over the position C and all nine entries of R are linear: with W the sum of all W_i

    C = W^-1 sum (W_j B_j + d_j - W_j R P_j),
    W_i R P_i - W_i W^-1 sum W_j R P_j = W_i B_i - W_i W^-1 sum W_j B_j + d_i - W_i W^-1 sum d_j

where equation 10.5 of *Parallel Manipulators* (2008), chapter 7, lacks the last W_i. The matrix that is found is a
rotation if the readings are exact; the rotation nearest to it is another question.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import fmpq_mat

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.screws.exact_matrix import flint_matrix, rank, rows_of


@dataclass(frozen=True)
class LegReading:
    """What the sensors of a leg read.

    Attributes
    ----------
    base, joint : Vector
        Joints of base and platform, each in its frame.
    projection : tuple of Vector
        W: symmetric, W W = W, rational.
    leg : Vector
        The leg's vector along what is measured: 0 for a plane or a line through the base's joint.
    """

    base: Vector
    joint: Vector
    projection: tuple[Vector, Vector, Vector]
    leg: Vector


@dataclass(frozen=True)
class LinearPose:
    """The least squares of linear readings.

    Attributes
    ----------
    position : Vector
    matrix : tuple of Vector
        In place of the rotation, by rows.
    residual : Fraction
        Sum of the squares of what is left of all equations: 0 if the readings fit.
    is_rotation : bool
        Whether the matrix is a rotation, exactly.
    """

    position: Vector
    matrix: tuple[Vector, Vector, Vector]
    residual: Fraction
    is_rotation: bool


def plane_of_leg(base: Vector, joint: Vector, normal: Vector) -> LegReading:
    """One angle of a universal joint is read: the leg lies in the plane with a normal of any length."""
    return LegReading(base, joint, _along(normal), _NONE)


def line_of_leg(base: Vector, joint: Vector, direction: Vector) -> LegReading:
    """Both angles are read: the leg lies on a line with a direction of any length."""
    rows = _along(direction)
    x, y, z = ((e[0] - p[0], e[1] - p[1], e[2] - p[2]) for e, p in zip(_UNIT, rows, strict=True))
    return LegReading(base, joint, (x, y, z), _NONE)


def point_of_leg(base: Vector, joint: Vector, leg: Vector) -> LegReading:
    """Both angles and the length are read: the vector of the leg."""
    return LegReading(base, joint, _UNIT, leg)


def linear_pose(readings: Sequence[LegReading]) -> LinearPose:
    """The position and the matrix that fit all readings best, by exact linear equations.

    Raises
    ------
    InputError
        If the readings do not determine them: the position, or the matrix, where the rank of P_W is below 9.

    Examples
    --------
    >>> corners = [tuple(map(Fraction, c)) for c in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
    >>> up = (Fraction(0), Fraction(0), Fraction(5))
    >>> found = linear_pose([point_of_leg(corner, corner, up) for corner in corners])
    >>> print(*found.position, found.is_rotation, found.residual)
    0 0 5 True 0
    """
    whole = sum((flint_matrix(r.projection, 3) for r in readings), start=fmpq_mat(3, 3))
    if whole.rank() < 3:
        raise InputError("readings: they do not determine the position, whatever the rotation; read more")
    inverse = whole.inv()
    projections = [flint_matrix(reading.projection, 3) for reading in readings]
    levers = [w * _lever(reading.joint) for w, reading in zip(projections, readings, strict=True)]
    rights = [w * _column(r.base) + _column(r.leg) for w, r in zip(projections, readings, strict=True)]
    all_levers, all_rights = sum(levers, start=fmpq_mat(3, 9)), sum(rights, start=fmpq_mat(3, 1))
    # W_i before W^-1: what is printed lacks it for the legs' vectors.
    matrix = [a - w * inverse * all_levers for a, w in zip(levers, projections, strict=True)]
    right = [b - w * inverse * all_rights for b, w in zip(rights, projections, strict=True)]
    normal = sum((m.transpose() * m for m in matrix), start=fmpq_mat(9, 9))
    found_rank = rank(rows_of(normal), 9)
    if found_rank < 9:
        raise InputError(
            f"readings: they determine {found_rank} of 9 entries of the matrix; read more, or use that it is a rotation"
        )
    entries = normal.inv() * sum((m.transpose() * b for m, b in zip(matrix, right, strict=True)), start=fmpq_mat(9, 1))
    left = [m * entries - b for m, b in zip(matrix, right, strict=True)]
    values = _fractions(entries)
    rows = _vector(values[:3]), _vector(values[3:6]), _vector(values[6:])
    position = _vector(_fractions(inverse * (all_rights - all_levers * entries)))
    residual = sum((x * x for column in left for x in _fractions(column)), Fraction(0))
    return LinearPose(position, rows, residual, _is_rotation(rows))


_NONE: Vector = (Fraction(0), Fraction(0), Fraction(0))
_UNIT: tuple[Vector, Vector, Vector] = (
    (Fraction(1), Fraction(0), Fraction(0)),
    (Fraction(0), Fraction(1), Fraction(0)),
    (Fraction(0), Fraction(0), Fraction(1)),
)


def _along(direction: Vector) -> tuple[Vector, Vector, Vector]:
    """The projection to a direction."""
    square = sum((x * x for x in direction), Fraction(0))
    if square == 0:
        raise InputError("direction: is 0; give one that is not")
    x, y, z = ((a * direction[0] / square, a * direction[1] / square, a * direction[2] / square) for a in direction)
    return x, y, z


def _lever(joint: Vector) -> fmpq_mat:
    """The matrix that takes the entries of R, by rows, to R P."""
    rows = [[joint[k - 3 * i] if 3 * i <= k < 3 * i + 3 else Fraction(0) for k in range(9)] for i in range(3)]
    return flint_matrix(rows, 9)


def _column(vector: Vector) -> fmpq_mat:
    return flint_matrix([[x] for x in vector], 1)


def _fractions(column: fmpq_mat) -> list[Fraction]:
    return [row[0] for row in rows_of(column)]


def _vector(values: Sequence[Fraction]) -> Vector:
    x, y, z = values
    return x, y, z


def _is_rotation(rows: Sequence[Sequence[Fraction]]) -> bool:
    matrix = flint_matrix(rows, 3)
    product = matrix * matrix.transpose()
    return bool(product == flint_matrix(_UNIT, 3) and matrix.det() == 1)

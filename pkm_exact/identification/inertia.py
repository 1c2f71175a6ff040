"""Inertial parameters of a body: how the power of its inertia depends on them, and whether a body can have them.

A point p of the body has the position C + Q p. Along a virtual motion it moves by dC + dQ p, and its acceleration less
that of gravity is A + B p. With the mass m, the first moments h = (mx, my, mz) and the second moments S the power is

    m dC.A + h.(dC B + dQ^T A) + sum S_jk (dQ^T B)_jk

in the metric: linear in ten parameters. S and the inertia are the same by Sxx = (Iyy + Izz - Ixx) / 2 and Sxy = -Ixy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.screws.exact_matrix import Row, flint_matrix

INERTIAL: Final = ("m", "mx", "my", "mz", "Ixx", "Ixy", "Ixz", "Iyy", "Iyz", "Izz")
"""Names of the ten parameters, about the origin of the body's frame."""

Field = tuple[Sequence[Fraction], Sequence[Sequence[Fraction]]]
"""A vector and a matrix by rows: what is at the body's point p is the vector plus the matrix times p."""


def power_row(virtual: Field, acceleration: Field, metric: Metric = UNIT_METRIC) -> Row:
    """The power of a body's inertia along a virtual motion, by parameters.

    In a metric g coordinate x is the ordinary one divided by its square root, and so are mx, Ixy and Ixz.

    Examples
    --------
    >>> still = [[Fraction(0)] * 3] * 3
    >>> lift = ([Fraction(0), Fraction(0), Fraction(1)], still)
    >>> fall = ([Fraction(0), Fraction(0), Fraction(10)], still)
    >>> [int(x) for x in power_row(lift, fall)]
    [10, 0, 0, 0, 0, 0, 0, 0, 0, 0]
    """
    (shift, turn), (start, slope) = virtual, acceleration

    def dot(u: Sequence[Fraction], v: Sequence[Fraction]) -> Fraction:
        return sum((g * a * b for g, a, b in zip(metric, u, v, strict=True)), Fraction(0))

    turns, slopes = list(zip(*turn, strict=True)), list(zip(*slope, strict=True))
    first = [dot(shift, slopes[k]) + dot(turns[k], start) for k in range(3)]
    second = [[dot(turns[j], slopes[k]) for k in range(3)] for j in range(3)]
    # g_k S_kk = (sum of the principal moments) / 2 - I_kk, in every metric.
    diagonal = [second[k][k] / metric[k] for k in range(3)]
    half = sum(diagonal, Fraction(0)) / 2
    mixed = [-(second[j][k] + second[k][j]) for j, k in ((0, 1), (0, 2), (1, 2))]
    ixx, iyy, izz = (half - value for value in diagonal)
    return (dot(shift, start), *first, ixx, mixed[0], mixed[1], iyy, mixed[2], izz)


@dataclass(frozen=True)
class Feasibility:
    """Whether a body of positive mass can have inertial parameters.

    Attributes
    ----------
    minors : tuple of 4 Fraction
        Leading minors of the pseudo-inertia, the matrix of second, first and zeroth moments.
    """

    minors: tuple[Fraction, ...]

    @property
    def is_feasible(self) -> bool:
        """Whether all are positive: exactly if some distribution of mass, not all in a plane, has these moments."""
        return all(minor > 0 for minor in self.minors)


def feasibility(parameters: Sequence[Fraction | int]) -> Feasibility:
    """The leading minors of the pseudo-inertia for ten parameters in the order of ``INERTIAL``, ordinary coordinates.

    That the principal moments of inertia are positive is not enough: they fulfil the triangle inequalities too.

    Examples
    --------
    >>> ball = [1, 0, 0, 0, 1, 0, 0, 1, 0, 1]
    >>> feasibility(ball).is_feasible, feasibility([1, 0, 0, 0, 1, 0, 0, 1, 0, 3]).is_feasible
    (True, False)
    """
    m, x, y, z, ixx, ixy, ixz, iyy, iyz, izz = (Fraction(value) for value in parameters)
    half = (ixx + iyy + izz) / 2
    matrix = [
        [half - ixx, -ixy, -ixz, x],
        [-ixy, half - iyy, -iyz, y],
        [-ixz, -iyz, half - izz, z],
        [x, y, z, m],
    ]
    found = []
    for size in range(1, 5):
        value = flint_matrix([row[:size] for row in matrix[:size]], size).det()
        found.append(Fraction(int(value.p), int(value.q)))
    return Feasibility(tuple(found))

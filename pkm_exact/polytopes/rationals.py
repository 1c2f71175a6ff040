"""Rational numbers of Python as those of FLINT, and back."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import fmpq, fmpq_mat


def rational_matrix(rows: Sequence[Sequence[Any]]) -> fmpq_mat:
    """The rows as a matrix of FLINT's.

    >>> rational_matrix([[Fraction(1, 2), Fraction(3)]])
    [1/2, 3]
    """
    entries = [fmpq(Fraction(value).numerator, Fraction(value).denominator) for row in rows for value in row]
    return fmpq_mat(len(rows), len(rows[0]), entries)


def as_fraction(value: fmpq) -> Fraction:
    """A number of FLINT's as one of Python's."""
    return Fraction(int(value.p), int(value.q))

"""Intervals on a grid are written as those with the same ends in fractions."""

from __future__ import annotations

import pickle
from copy import copy
from fractions import Fraction

from budgets import budget
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.poses.pose_spelling import ends
from pkm_exact.roots.interval import Interval, decimal


@budget(50)
@given(st.integers(-(2**80), 2**80), st.integers(0, 5), st.integers(0, 90))
def test_cells_are_written_as_fractions_are(low: int, width: int, exponent: int) -> None:
    cell = Interval.on_grid(low, low + width, exponent)
    plain = Interval(Fraction(low, 1 << exponent), Fraction(low + width, 1 << exponent))
    assert plain.cell is None
    assert (decimal(cell), ends(cell)) == (decimal(plain), ends(plain))
    for interval in (cell, plain):
        copies = copy(interval), pickle.loads(pickle.dumps(interval))  # noqa: S301
        assert [(other.lo, other.hi, other.cell) for other in copies] == [(plain.lo, plain.hi, interval.cell)] * 2

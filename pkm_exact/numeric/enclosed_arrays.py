"""Arrays of real numbers with bounds of their errors, in doubles: sums of products, lengths, definite matrices.

Every sum of at most ``TERMS`` products of at most three doubles is off by less than ``ROUNDING`` times the sum of the
absolute values, in whatever order it is taken: (TERMS + 3) 2^-53 is less. Nothing here is so small that it underflows
beside what it is added to: ``TINY`` is added to bounds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from flint import arb
from numpy.typing import NDArray

Real = NDArray[np.float64]

TERMS: Final = 2**12
ROUNDING: Final = 2.0**-38
TINY: Final = 2.0**-400


@dataclass(frozen=True, eq=False)
class Enclosed:
    """Real numbers, each within ``rad`` of ``mid``."""

    mid: Real
    rad: Real

    @property
    def most(self) -> Real:
        """Bounds of the absolute values."""
        return np.asarray((np.abs(self.mid) + self.rad) * (1 + ROUNDING) + TINY)

    def __add__(self, other: Enclosed) -> Enclosed:
        rounding = ROUNDING * (np.abs(self.mid) + np.abs(other.mid))
        return Enclosed(self.mid + other.mid, (self.rad + other.rad) * (1 + ROUNDING) + rounding + TINY)

    def __neg__(self) -> Enclosed:
        return Enclosed(-self.mid, self.rad)

    def __sub__(self, other: Enclosed) -> Enclosed:
        return self + -other

    def __getitem__(self, place: Any) -> Enclosed:
        return Enclosed(self.mid[place], self.rad[place])

    def half(self) -> Enclosed:
        """Half of it, exactly but for underflow."""
        return Enclosed(self.mid / 2, self.rad / 2 + TINY)


def exact(values: Any) -> Enclosed:
    """Doubles, as they are."""
    mid = np.asarray(values, dtype=np.float64)
    return Enclosed(mid, np.zeros_like(mid))


def enclosed(values: Sequence[arb | Sequence[arb]]) -> Enclosed:
    """Balls, a list or a list of rows.

    Examples
    --------
    >>> third = enclosed([arb(1) / 3])
    >>> bool(0 < third.rad[0] < 1e-16)
    True
    """
    array = np.array([_ends(row) if isinstance(row, arb) else [_ends(v) for v in row] for row in values])
    return Enclosed(array[..., 0], array[..., 1])


def _ends(value: arb) -> tuple[float, float]:
    middle = float(value.mid())
    off = float(abs(value - arb(middle)).upper())
    return middle, off * (1 + ROUNDING) + TINY


def product(places: str, *factors: Enclosed) -> Enclosed:
    """Sums of products, as ``numpy.einsum`` has them.

    Examples
    --------
    >>> square = product("i,i->", exact([1.0, 3.0]), exact([1.0, 3.0]))
    >>> bool(abs(square.mid - 10) <= square.rad)
    True
    """
    sizes = [np.abs(factor.mid) for factor in factors]
    below = np.einsum(places, *sizes, optimize=False)
    above = np.einsum(places, *(size + factor.rad for size, factor in zip(sizes, factors, strict=True)), optimize=False)
    mid = np.einsum(places, *(factor.mid for factor in factors), optimize=False)
    return Enclosed(mid, (above - below) + ROUNDING * above + TINY)


def join(*parts: Enclosed, axis: int = 0) -> Enclosed:
    """Arrays one after another."""
    return Enclosed(np.concatenate([p.mid for p in parts], axis), np.concatenate([p.rad for p in parts], axis))


def lengths(values: Enclosed) -> Real:
    """Bounds of the lengths of vectors, along the last axis."""
    return np.asarray(np.sqrt((values.most**2).sum(axis=-1)) * (1 + ROUNDING) + TINY)


def above(value: float | Real) -> float:
    """The greatest of some bounds, with room for the rounding of what they were added from."""
    return float(np.max(value)) * (1 + 2.0**-36)


def are_positive(matrices: Enclosed) -> bool:
    """Whether symmetric matrices are positive definite, along the last two axes.

    By Cholesky's decomposition of a matrix less c, which ends only if the matrix less c is within (n + 2) 2^-53 of its
    trace from a positive semidefinite one (S. Rump, "Verification of positive definiteness", BIT 46 (2006), 433-452).

    Examples
    --------
    >>> are_positive(exact([[2.0, 1.0], [1.0, 1.0]])), are_positive(exact([[1.0, 1.0], [1.0, 1.0]]))
    (True, False)
    """
    size = matrices.mid.shape[-1]
    mid = (matrices.mid + np.swapaxes(matrices.mid, -1, -2)) / 2
    if not np.isfinite(mid).all() or not np.isfinite(matrices.rad).all():
        return False
    trace = np.abs(np.trace(mid, axis1=-2, axis2=-1))
    shift = np.sqrt((matrices.rad**2).sum(axis=(-1, -2))) * (1 + ROUNDING) + ROUNDING * trace + TINY
    try:
        np.linalg.cholesky(mid - shift[..., None, None] * np.eye(size))
    except np.linalg.LinAlgError:
        return False
    return True

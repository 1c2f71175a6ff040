"""Boxes in Study coordinates that hold exactly one solution each, as Krawczyk's operator proves them."""

from __future__ import annotations

from dataclasses import dataclass, field
from operator import itemgetter

RADIUS = 4
"""Half the width of a box, in units of its grid."""
ROOM = 2
"""Boxes must be mapped into what is this many times smaller: checkers round otherwise, and need some room."""


@dataclass(frozen=True, slots=True)
class Box:
    """A box around a solution (e, f), in the chart of the list it belongs to.

    Attributes
    ----------
    exponents : tuple of 2 int
        The grids of e and f: their coordinates are integers times 2^-exponent, and differ from the centre by at most
        ``RADIUS`` times that, real and imaginary parts each.
    centre : tuple of 8 pairs of int
        Real and imaginary parts.
    is_real : bool
        Whether the box holds real points only: its centre is real.
    """

    exponents: tuple[int, int]
    centre: tuple[tuple[int, int], ...]
    is_real: bool = field(init=False, repr=False, compare=False)
    _hash: int = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        # Both are asked for several times in a solve.
        object.__setattr__(self, "is_real", not any(map(itemgetter(1), self.centre)))
        object.__setattr__(self, "_hash", hash((self.exponents, self.centre)))

    def __hash__(self) -> int:
        return self._hash

    def exponent(self, index: int) -> int:
        """The exponent of coordinate number 0 to 7."""
        return self.exponents[index // 4]

    def is_disjoint(self, other: Box) -> bool:
        """Whether the two boxes have no point in common."""
        return any(self._are_apart(other, index) for index in range(8))

    def conjugate(self) -> Box:
        """The box of the complex conjugate points."""
        return Box(self.exponents, tuple((real, -imaginary) for real, imaginary in self.centre))

    def _are_apart(self, other: Box, index: int) -> bool:
        mine, theirs = self.exponent(index), other.exponent(index)
        finest = max(mine, theirs)
        reach = (RADIUS << (finest - mine)) + (RADIUS << (finest - theirs))
        pairs = zip(self.centre[index], other.centre[index], strict=True)
        return any(abs((a << (finest - mine)) - (b << (finest - theirs))) > reach for a, b in pairs)


@dataclass(frozen=True)
class IsolatedSolutions:
    """Boxes in a chart, pairwise disjoint, each with exactly one solution.

    Attributes
    ----------
    chart : tuple of 4 int
        w in w.e = 1.
    real : tuple of Box
        Real boxes.
    pairs : tuple of Box
        Complex boxes disjoint from their conjugates: each stands for itself and its conjugate.
    """

    chart: tuple[int, ...]
    real: tuple[Box, ...]
    pairs: tuple[Box, ...]

    @property
    def count(self) -> int:
        """Number of distinct solutions."""
        return len(self.real) + 2 * len(self.pairs)

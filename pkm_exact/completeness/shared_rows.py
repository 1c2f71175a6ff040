"""What many problems have in common that differ in lengths alone: a matter of time only, no answer rests on it."""

from __future__ import annotations

from dataclasses import dataclass, field

from pkm_exact.completeness.shared_boundary import SharedBoundary
from pkm_exact.poses.pose_denominators import PoseDenominators

DOUBTFUL = 2
"""So many more rows that needed an elimination than rows that did not, and no other row is tried without."""


@dataclass
class SharedRows:
    """What the first rows found, for the others.

    Attributes
    ----------
    denominators : PoseDenominators
    boundary : SharedBoundary
    misses : int
        Rows that needed an elimination, less those that did not.
    """

    denominators: PoseDenominators = field(default_factory=PoseDenominators)
    boundary: SharedBoundary = field(default_factory=SharedBoundary)
    misses: int = 0

    @property
    def may_go_directly(self) -> bool:
        """Whether it is worth the while to try a row without an elimination."""
        return self.misses < DOUBTFUL

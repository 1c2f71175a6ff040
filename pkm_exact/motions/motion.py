"""A group of rigid motions as a projective variety: what completeness and the equations need to know of it.

A motion (C, R) is the point (|C|^2; u; C; R; 1), u = R^-1 C, of P^16, and a constraint on it is a linear form on these
17 coordinates. Motions of a smaller group satisfy further linear forms by themselves, and the closure of the group is a
variety of its own dimension and degree: as many isolated points as ``degree`` are the most that linear forms leave.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

IntegerForm: TypeAlias = tuple[int, ...]
"""Coefficients on (|C|^2; u1, u2, u3; C1, C2, C3; r11, r12, .., r33; 1)."""


@dataclass(frozen=True)
class Motion:
    """A group of rigid motions.

    Attributes
    ----------
    name : str
        As model files and certificates name it.
    title : str
        In words.
    dimension : int
        Number of freedoms.
    degree : int
        Degree of the closure in P^16 (``docs/completeness.md`` has the proofs).
    forms : tuple of 17 int each
        Linear forms that vanish on the motions, in every metric.
    support : tuple of int
        Indices of the Study coordinates (e0, .., e3, f0, .., f3) that are not 0 for every motion.
    twist : tuple of int
        Indices of the components of a twist (v1, v2, v3, w1, w2, w3) that are not 0 for every motion.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import MOTIONS
    >>> MOTIONS["planar"].dimension, MOTIONS["planar"].degree, MOTIONS["planar"].has_study_condition
    (3, 6, False)
    """

    name: str
    title: str
    dimension: int
    degree: int
    forms: tuple[IntegerForm, ...]
    support: tuple[int, ...]
    twist: tuple[int, ...]

    def __repr__(self) -> str:
        return f"Motion({self.name!r})"

    @property
    def rotation_support(self) -> tuple[int, ...]:
        """Indices of those of e0, .., e3 that are not 0 for every motion."""
        return tuple(k for k in self.support if k < 4)

    @property
    def has_study_condition(self) -> bool:
        """Whether e.f = 0 is a condition on the support; otherwise it holds by itself."""
        return any(k + 4 in self.support for k in self.support)

    @property
    def is_planar(self) -> bool:
        """Whether joints are points of the plane of the first two axes: third coordinates are 0 and not given."""
        return self.name == "planar"

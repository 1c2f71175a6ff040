"""Factors of denominators that the representations of one robot's poses have in common, nearly, at all lengths."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass
class PoseDenominators:
    """What the denominators of one robot's representations have nearly in common at all lengths.

    With a the leading coefficient of h and N(e) the norms of the quaternions, a (prod N(e))^(1/2) is the resultant of
    the legs and the boundary of rigid motions, where lengths drop out. Factors of few bits come and go.

    Attributes
    ----------
    boundary : Fraction or None
        That number, once it is known.
    translation : int
        What f has as a denominator beyond a.
    """

    boundary: Fraction | None = None
    translation: int = 1

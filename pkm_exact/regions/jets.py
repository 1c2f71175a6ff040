"""Functions of a path parameter on an interval: a value in the middle, all values, and all slopes, enclosed.

By the mean value theorem every value lies in m + d h, m the value in the middle, d the slopes and h the interval about
0: what that gives is as narrow as the square of the interval.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from flint import arb

from pkm_exact.balls import ball


@dataclass(frozen=True, eq=False)
class Jet:
    """A function on an interval.

    Attributes
    ----------
    middle : arb
        Its value in the middle.
    slope : arb
        Its derivative, all over the interval.
    half : arb
        The interval about its middle, [-h, h].
    """

    middle: arb
    slope: arb
    half: arb

    @property
    def value(self) -> arb:
        """All values.

        Examples
        --------
        >>> s = parameter(Fraction(1), Fraction(1, 4))
        >>> bool((s * s - s * s).value.contains(0)), bool((s * s).value.contains(arb(1)))
        (True, True)
        """
        return self.middle + self.slope * self.half

    def __add__(self, other: Jet | int) -> Jet:
        if isinstance(other, int):
            return Jet(self.middle + other, self.slope, self.half)
        return Jet(self.middle + other.middle, self.slope + other.slope, self.half)

    __radd__ = __add__

    def __sub__(self, other: Jet) -> Jet:
        return Jet(self.middle - other.middle, self.slope - other.slope, self.half)

    def __neg__(self) -> Jet:
        return Jet(-self.middle, -self.slope, self.half)

    def __mul__(self, other: Jet | arb | int) -> Jet:
        if not isinstance(other, Jet):
            return Jet(self.middle * other, self.slope * other, self.half)
        slope = self.slope * other.value + self.value * other.slope
        return Jet(self.middle * other.middle, slope, self.half)

    __rmul__ = __mul__

    def __truediv__(self, other: Jet) -> Jet:
        """The quotient; not finite where the divisor is not bounded away from 0."""
        value = other.value
        slope = (self.slope * value - self.value * other.slope) / (value * value)
        return Jet(self.middle / other.middle, slope, self.half)

    def root(self) -> Jet:
        """The square root of a function that is positive."""
        return Jet(self.middle.sqrt(), self.slope / (2 * self.value.sqrt()), self.half)

    def cos_sin_of_degrees(self) -> tuple[Jet, Jet]:
        """Cosine and sine of an angle in degrees."""
        unit = arb.pi() / 180
        (s0, c0), (s, c) = (self.middle * unit).sin_cos(), (self.value * unit).sin_cos()
        turn = self.slope * unit
        return Jet(c0, -s * turn, self.half), Jet(s0, c * turn, self.half)


def parameter(middle: Fraction, half: Fraction) -> Jet:
    """The parameter itself on [middle - half, middle + half]."""
    return Jet(ball(middle), arb(1), arb(0, ball(half)))


def constant(value: arb, like: Jet) -> Jet:
    """A function that does not change."""
    return Jet(value, arb(0), like.half)

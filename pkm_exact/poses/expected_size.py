"""How large the univariate representation of a robot's poses will be: an estimate, for the display of progress alone.

By the arithmetic theorem of Bezout (Bost, Gillet and Soule, "Heights of projective varieties and positive Green forms",
J. Amer. Math. Soc. 7, 1994) the height of a section of a variety of degree D by hyperplanes is bounded, up to what
depends on the variety alone, by D times the sum of the heights of the hyperplanes. Of that bound the representations
of spatial robots need between 0.2 and 0.5, measured with quaternions as coordinates.
"""

from __future__ import annotations

from fractions import Fraction

from pkm_exact.constraints.form import Form, integral
from pkm_exact.geometry.problem import ForwardProblem

SHARE = Fraction(2, 5)


def expected_bits(problem: ForwardProblem, solutions: int) -> int:
    """About how many bits a modulus needs from which so many solutions of a robot are reconstructed.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> zero, one = (Fraction(0),) * 3, (Fraction(1),) * 3
    >>> expected_bits(ForwardProblem((Distance(zero, one, Fraction(1, 1000)),) * 6), 40)
    1152
    """
    return int(SHARE * solutions * sum(map(_height, problem.forms)))


def _height(form: Form) -> int:
    """Bits of the largest coefficient of a hyperplane over the integers."""
    return max(map(abs, integral(form))).bit_length()

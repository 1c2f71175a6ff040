"""How large the univariate representation of a robot's poses will be: an estimate, for the display of progress alone.

By the arithmetic theorem of Bezout (Bost, Gillet and Soule, "Heights of projective varieties and positive Green forms",
J. Amer. Math. Soc. 7, 1994) the height of a section of a variety of degree D by hyperplanes is bounded, up to what
depends on the variety alone, by D times the sum of the heights of the hyperplanes. Of that bound the representations
of spatial robots need between 0.2 and 0.5, measured with quaternions as coordinates.
"""

from __future__ import annotations

from fractions import Fraction
from math import lcm

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.problem import ForwardProblem

SHARE = Fraction(2, 5)


def expected_bits(problem: ForwardProblem, solutions: int) -> int:
    """About how many bits a modulus needs from which so many solutions of a robot are reconstructed.

    Examples
    --------
    >>> zero, one = (Fraction(0),) * 3, (Fraction(1),) * 3
    >>> expected_bits(ForwardProblem((Distance(zero, one, Fraction(1, 1000)),) * 6), 40)
    1152
    """
    return int(SHARE * solutions * sum(_height(leg, problem) for leg in problem.distances))


def _height(leg: Distance, problem: ForwardProblem) -> int:
    """Bits of the largest coefficient of the leg's equation, a hyperplane, over the integers."""
    squares = [
        sum((g * x * x for g, x in zip(problem.metric, joint, strict=True)), Fraction(0))
        for joint in (leg.base, leg.platform)
    ]
    products = [2 * a * b for a in leg.base for b in leg.platform]
    values = [Fraction(1), sum(squares) - leg.length_squared, *(2 * x for x in (*leg.base, *leg.platform)), *products]
    scale = lcm(*(value.denominator for value in values))
    return max(abs(int(value * scale)) for value in values).bit_length()

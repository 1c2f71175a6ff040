"""How large the univariate representation of a robot's poses will be: an estimate, on which nothing rests but time.

By the arithmetic theorem of Bezout (Bost, Gillet and Soule, "Heights of projective varieties and positive Green forms",
J. Amer. Math. Soc. 7, 1994) the height of a section of a variety of degree D by hyperplanes is bounded, up to what
depends on the variety alone, by D times the sum of the heights of the hyperplanes. Of that bound the representations
of spatial robots need between 0.2 and 0.5, measured with quaternions as coordinates.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm

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
    forms = problem.forms
    unit = _common_unit(forms)
    return int(SHARE * solutions * min(sum(map(_height, each)) for each in (forms, _measured(forms, unit))))


def _common_unit(forms: Sequence[Form]) -> Fraction:
    """The largest length of which all coefficients that are lengths are multiples."""
    lengths = [value for form in forms for value in form[1:7] if value]
    return (
        Fraction(gcd(*(x.numerator for x in lengths)), lcm(*(x.denominator for x in lengths)))
        if lengths
        else Fraction(1)
    )


def _measured(forms: Sequence[Form], unit: Fraction) -> list[Form]:
    """The forms of the robot whose lengths are divided by a unit."""
    return [(form[0], *(x / unit for x in form[1:7]), *(x / unit**2 for x in form[7:])) for form in forms]


def _height(form: Form) -> int:
    """Bits of the largest coefficient of a hyperplane, as integers without a common factor."""
    coefficients = integral(form)
    return (max(map(abs, coefficients)) // max(gcd(*coefficients), 1)).bit_length()

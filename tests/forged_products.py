"""Certificates of systems of higher degree: honest ones, and false ones that show one step of how products are proved.

The plain checker proposes numerators of products of coordinates by what they are modulo p^e with p = 2^61 - 1, and
proves them before it uses them.
"""

from __future__ import annotations

from fractions import Fraction
from math import isqrt, prod

from forged_strides import Row, _system
from handmade_systems import Content, hexadecimal, listed, multiplied, represented
from tables_of_rows import merged

from pkm_exact.certify import pure

P = (1 << 61) - 1
LONG = 10**59 + 7


def _at(a: int, text: str) -> Content:
    """One point, (a, 0)."""
    return _system({1: 1, 0: -a}, [{1: 1}, {}], text)


def _with_content() -> Content:
    """x = 0 and y = 1 / c, where c, a factor of all of the eliminant, is 0 modulo the first primes that are tried."""
    c = prod(pure.good_primes([0, 1]))
    representation = {"separating_form": [1, 0], "eliminant": hexadecimal([0, c]), "numerators": [[], ["0x1"]]}
    return listed("x,y", ("x", f"{c}*y-1", "x*y^2"), representation, multiplicities=1)


def _short_modulo(e: int) -> Content:
    """x^3 = a c at x = a, where a^2 is a short c modulo p^e, but another number."""
    a = isqrt(P**e << 20) + 1
    return _at(a, f"x^3-{a * (a * a - (P**e << 20))}")


def _fractions(*texts: str) -> Content:
    """x = 1/3 and 1/5, y = -2/7 and 3/2, z = 0."""
    points = [(Fraction(1, 3), Fraction(-2, 7), 0), (Fraction(1, 5), Fraction(3, 2), 0)]
    return listed("x,y,z", texts, represented(points, (1, 1, 0)), multiplicities=None)


def _long_quotient(number: int) -> Content:
    """Of points T = z next to each other, x is 0 at one half, y at the other and u at all: x y is h by a much longer q.

    Halves of h are multiplied by what makes most of them polynomials in z^2, which have fewer terms.
    """
    unit = 1024
    h, halves = [Fraction(1)], []
    for place in range(2):
        roots = range(unit + place, unit + number, 2)
        for root in roots:
            h = multiplied(h, [-root, unit])
        half = [Fraction(1)]
        for root in roots[1:]:
            half = multiplied(half, [-root * root, 0, unit * unit])
        halves.append([int(c) for c in multiplied(half, [-roots[0], unit])])
    eliminant = [int(c) for c in h]
    last = [(power - number) * c for power, c in enumerate(eliminant[:-1])]
    representation = {
        "separating_form": [0, 0, 1, 0],
        "eliminant": hexadecimal(eliminant),
        "numerators": [hexadecimal(each) for each in (*halves, last, [])],
    }
    return listed("x,y,z,u", ("x*y", "u"), representation, multiplicities=None)


EQUATIONS = ("15*x^3-8*x^2+x", "14*y^3-17*y^2-6*y", "14*x^2*y^3-17*x^2*y^2-6*x^2*y")
PRODUCTS: dict[str, Row] = {
    "the cube of a long number": (_at(LONG, f"x^3-{LONG**3}"), "accepted"),
    "not the cube of a long number": (_at(LONG, f"x^3-{LONG**3 + 1}"), "rejected"),
    "roots that meet modulo a prime": (_system({2: 1, 1: -P}, [{1: 1}, {}], f"x^3-{P}*x^2"), "accepted"),
    "roots that meet modulo a prime, a term more": (_system({2: 1, 1: -P}, [{1: 1}, {}], f"x^3-{P}*x^2+x"), "rejected"),
    "roots whose squares are 0 modulo a prime": (_system({2: 1, 0: -P}, [{1: 1}, {}], f"x^4-{P}*x^2"), "accepted"),
    "fractions": (_fractions(*EQUATIONS), "accepted"),
    "fractions, a wrong coefficient": (_fractions(*EQUATIONS[:2], "14*x^2*y^3+x^2*y^2-6*x^2*y+x-y"), "rejected"),
    "fractions, a wrong sum of products": (_fractions("15*x^3-7*x^2+x", *EQUATIONS), "rejected"),
    "a content that is 0 modulo some primes": (_with_content(), "accepted"),
    "a quotient that is longer than usual": (_long_quotient(46), "accepted"),
}
FORGED: dict[str, Row] = {f"a square that is short modulo p^{e}": (_short_modulo(e), "rejected") for e in range(3, 9)}
ROWS: dict[str, Row] = merged(PRODUCTS, FORGED)

"""More certificates of polynomial systems made by hand, with what both checkers must say of them."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt
from typing import Any

from handmade_systems import (
    BILINEAR,
    CORNERS,
    ENDS,
    LINE,
    PAIR,
    SQUARES,
    Content,
    at_infinity,
    complete,
    handmade,
    hexadecimal,
    listed,
    multiplied,
    represented,
    system_content,
    trimmed,
)
from tables_of_rows import merged, put

from pkm_exact.certify import pure
from pkm_exact.certify.checker.solutions import PRIMES

Row = tuple[Content, str]
"""A certificate without its digest, and the verdict."""

MADE = handmade()


def none(texts: tuple[str, ...], route: str | None, names: str = "x,y", **entries: Any) -> Content:
    return system_content(names, texts, claim="inconsistent", completeness_route=route, complex_solutions=0, **entries)


def counted(texts: tuple[str, ...], points: Any, infinity: Content, total: int, **options: Any) -> Content:
    return listed("x,y", texts, points, **options, **complete("counting-at-infinity", total, infinity=infinity))


def slices(
    texts: tuple[str, ...], forms: Any, constants: Any, point: Any, form: tuple[int, ...], names: str = "x,y"
) -> Content:
    """Of a line: the point for each constant."""
    entries = [{"constant": str(a), "representation": represented([point(Fraction(a))], form)} for a in constants]
    witness = {"cause": "more-solutions-than-bound", "forms": forms, "slices": entries}
    return system_content(names, texts, claim="positive-dimensional-proved", witness=witness)


# Multiplicities

FAT = ("x^2", "x*y", "y^2")
"""Multiplicity 3 at the origin, where all three derivatives are 0: with two polynomials the weight would be 4."""
STAIRS = ("x^2-x", "x*y", "y^4-6*y^3+11*y^2-6*y")
STEPS = [(0, 0), (1, 0), (0, 1), (0, 2), (0, 3)]
CURVED = ("x^2-2*x-y+3", "x*y-2*x-y+2", "y^2-4*y+4")
"""Multiplicity 3 at (1, 2): y = 2 + (x - 1)^2, and (x - 1)^3 is 0; the weight is 2."""
CONICS = ("x^2+y^2-5", "x*y-2", "x^3+x*y^2+x*y-5*x-2")
"""The third follows from the others; the algebra does not close, but the top forms leave room for four."""
MEETINGS = [(1, 2), (2, 1), (-1, -2), (-2, -1)]
ROOTS = (-3, -2, -1, 2, 4)


def _nodal() -> tuple[tuple[str, str], list[tuple[Fraction, Fraction]]]:
    """Two cubics with nodes at the point (0 : 0 : 1) at infinity, and five points beside it.

    x y + a + x^3 and (1 - x^2) y + q: then (1 - x^2) (a + x^3) - x q has the roots asked for.
    """
    r = [1]
    for root in ROOTS:
        r = [a - root * b for a, b in zip([0, *r], [*r, 0], strict=True)]
    r = [-c for c in r]
    a = r[0]
    left = [a, 0, -a, 1, 0, -1]
    q = [x - y for x, y in zip(left, r, strict=True)][1:]
    q_text = "+".join(f"{c}*x^{k}" if k else f"{c}" for k, c in enumerate(q) if c).replace("+-", "-").replace("^1", "")
    points = [(Fraction(x), -Fraction(a + x**3, x)) for x in ROOTS]
    return (f"x*y+x^3+{a}".replace("+-", "-"), f"y-x^2*y+{q_text}".replace("+-", "-")), points


NODES, BESIDE = _nodal()
FIRST, PLAIN = PRIMES[0], pure.PRIMES[0]
DOUBLE_END = ("x^2-y", "x^2+x-2*y")
"""Meet twice at (0 : 0 : 1)."""
ONE_END = at_infinity([(0, 1)], (0, 1), (0, 1), 2)


def _beside(name: str, prime: int) -> dict[str, Row]:
    """Systems of one simple and one double solution, that look regular modulo the prime: all is called simple."""
    lost = represented([(0,), (Fraction(1, prime),)], (1,))
    alike = represented([(0, 0), (prime, 1)], (1, 0))
    square = (f"{prime**2}*x^3-{2 * prime}*x^2+x",)
    twin = (f"x-{prime}*y", "y^3-2*y^2+y")
    return {
        f"a double solution lost modulo {name}": (listed("x", square, lost, exponent=70, multiplicities=1), "rejected"),
        f"a double solution lost modulo {name}, unknown": (
            listed("x", square, lost, exponent=70, multiplicities=None),
            "accepted",
        ),
        f"solutions alike modulo {name}": (listed("x,y", twin, alike, multiplicities=1), "rejected"),
        f"solutions alike modulo {name}, unknown": (listed("x,y", twin, alike, multiplicities=None), "accepted"),
    }


def _triple(prime: int) -> Row:
    """Three times the roots of a prime, where h has a double root modulo the prime."""
    texts = (f"x^6-{3 * prime}*x^4+{3 * prime**2}*x^2-{prime**3}", "y-1")
    h = {"separating_form": [1, 0], "eliminant": hexadecimal([-prime, 0, 1])}
    h["numerators"] = [hexadecimal([2 * prime]), hexadecimal([0, 2])]
    return listed("x,y", texts, h, multiplicities=3) | complete("exact-elimination", 6, elimination=[]), "accepted"


def _many_forms(number: int) -> Content:
    return MADE["many"] | {"witness": MADE["many"]["witness"] | {"forms": [[0, 1, 0]] * number}}


def one(*coefficients: int) -> Content:
    """The representation of all roots of a polynomial in x."""
    degree = len(coefficients) - 1
    numerator = trimmed([(k - degree) * c for k, c in enumerate(coefficients[:-1])])
    return {"separating_form": [1], "eliminant": hexadecimal(coefficients), "numerators": [hexadecimal(numerator)]}


def ranked(
    names: str, texts: tuple[str, ...], points: Content, multiplicities: Any, total: int, **options: Any
) -> Content:
    """Complete by ranks."""
    return listed(names, texts, points, multiplicities=multiplicities, **options) | complete("modular-rank", total)


def _summed(terms: dict[str, Any]) -> str:
    """A polynomial from its monomials and their coefficients."""
    return "+".join(f"{value}*{monomial}" if monomial else f"{value}" for monomial, value in terms.items() if value)


def _lost_factor() -> Content:
    """Three of four roots: at one of them, modulo the prime, and at no root without it, the derivative is 0.

    It is 0 for T = 0, which is the root P modulo P; a weight 2 there would fill the place of the root left out.
    """
    h = [-2 * P, 3 * P + 2, -P - 3, 1]
    x = Fraction(6 * P, 3 * P + 2)
    left_out = x + 1 / (1 / (x - P) + 1 / (x - 1) + 2 / (x - 2))
    found = [Fraction(left_out.denominator)]
    for root in (P, 1, 2, 2, left_out):
        found = [a - root * b for a, b in zip([Fraction(0), *found], [*found, Fraction(0)], strict=True)]
    text = _summed({f"x^{k}" if k else "": c for k, c in enumerate(found)})
    return ranked("x", (text.replace("+-", "-").replace("x^1+", "x+").replace("x^1-", "x-"),), one(*h), [1, 2, 1], 5)


def _long_coefficient() -> Content:
    """(a x - 1) (b x^4 + 1) = 0, and y is a over its derivative, near 1; the first enclosure of that is about 0."""
    a, b = 3 << 100, 1 << 340
    points = one(-1, a, 0, 0, -b, a * b)
    points |= {"separating_form": [1, 0], "numerators": [*points["numerators"], hexadecimal([a])]}
    texts = (f"{a * b}*x^5-{b}*x^4+{a}*x-1", f"{5 * a * b}*x^4*y-{4 * b}*x^3*y+{a}*y-{a}")
    return listed("x,y", texts, points)


def _lost_rank(bits: int, *more: str) -> Content:
    """Two of three points: at (1, 0) the second gradient is a multiple of the first one modulo the prime only."""
    k = 1 << 40
    first = P // k << bits
    second = (P << bits) - first * k
    texts = (f"x^2-{k}*x*y-x", f"{first}*x^2-{first}*x+{second}*x*y+y^2", *more)
    names, points = ("x,y,z", [(0, 0, 0), (1, 0, 0)]) if more else ("x,y", [(0, 0), (1, 0)])
    weight = 4 if more else 2
    return ranked(names, texts, represented(points, (1, *(0 for _ in points[0][1:]))), weight, 2 * weight)


def _reversed(content: Content) -> Content:
    """The polynomials in the other order."""
    return content | {"polynomials": content["polynomials"][::-1]}


def _divisible_at_one_power() -> Content:
    """A polynomial whose value (M + 1) T^2 + M at T = 2^56 is M h, for h = T^2 + 2^56 / M T + 1, and at no other T.

    With y = T / h' and z = 1 / h' it has coefficients of 22 bits, for which the plain checker looks at 2^56 first, and
    sees that h does not divide it by the quotient alone, which is too large.
    """
    m = 1 << 20
    slope = (1 << 56) // m
    h = {"separating_form": [1, 0, 0], "eliminant": hexadecimal([1, slope, 1])}
    h["numerators"] = [hexadecimal([-2, -slope]), hexadecimal([0, 1]), hexadecimal([1])]
    return listed("x,y,z", (f"{m + 1}*y^2+{m}*z^2",), h, multiplicities=None)


def _rooted(*factors: list[int], exponent: int = 8) -> Content:
    """All roots of a product of polynomials in x, as many as its degree."""
    h = [Fraction(1)]
    for factor in factors:
        h = multiplied(h, factor)
    whole = [int(c) for c in h]
    terms = {f"x^{k}" if k > 1 else "x" * k: c for k, c in reversed(list(enumerate(whole)))}
    options: Content = complete("refined-bezout", len(h) - 1)
    return listed("x", (_summed(terms).replace("+-", "-"),), one(*whole), exponent=exponent, **options)


def _closer_than_grids() -> Content:
    """The roots 0 and 3/2 of a cell of the grid 2^-4097, which both checkers refuse to look at."""
    content = _rooted([0, 1], [-3, 1 << 4097], exponent=4200)
    h = one(0, -3, 1 << 4098)
    ends = [str(Fraction(n, 1 << 4097)) for n in (1, 2)]
    values = [str(Fraction((3 << 102) + n, 1 << 4200)) for n in (-1, 1)]
    solutions = [content["solutions"][0], {"parameter": ends, "values": [values], "multiplicity": 1}]
    return content | {"polynomials": [[f"{1 << 4098}*x^2", "-3*x"]], "representation": h, "solutions": solutions}


def _as_large(root: int) -> Content:
    """A root, an integer that may be larger than both checkers look at."""
    content = _rooted([-7, 1])
    ends = [str(Fraction((root << 8) + n, 1 << 8)) for n in (-1, 1)]
    solution = {**content["solutions"][0], "parameter": [str(root)] * 2, "values": [ends]}
    return content | {"polynomials": [["x", str(-root)]], "representation": one(-root, 1), "solutions": [solution]}


NEAR = [(1 << 4000) + 1, -6 << 4000, 9 << 4000]
"""Roots 2^-2000 above and below 1/3 in the complex plane."""
FINE: dict[str, Row] = {
    "roots apart on the finest grid that there is": (_rooted([0, 1], [-3, 1 << 4097], exponent=4200), "accepted"),
    "roots closer than that": (_closer_than_grids(), "too-large"),
    "a root as large as may be": (_as_large((1 << 4094) - 1), "accepted"),
    **{f"a root of {n + 1} bits": (_as_large(1 << n), "too-large") for n in (4094, 4200)},
    "three roots in a cell of the coarsest grid, where a sign changes": (
        _rooted(*([-k, 1 << 40] for k in (3, 5, 7)), exponent=48),
        "accepted",
    ),
    "a root whose value takes many bits to see, before another": (_rooted([-1, 3], NEAR, [-1, 1]), "accepted"),
    "a root whose value takes many bits to see, behind another": (_rooted([-1, 3], NEAR, [1, 1]), "accepted"),
    "a dyadic root where rounding hides that the value is 0": (
        _rooted([-2437, 1 << 13], [1, *[0] * 12, (1 << 237) + 1]),
        "accepted",
    ),
    **{
        f"{' and '.join(texts)}, {said} times": (
            ranked("x,y", texts, represented([(0, 0)], (1, 0)), said, said),
            "accepted" if said == number else "rejected",
        )
        for texts, number in ((("x^2", "y^3"), 6), (("x^3-y^3", "x*y^2"), 9))
        for said in (number, number + 1)
    },
    "fewer polynomials than variables, nothing said of multiplicity": (
        listed("x,y", ("x^2-1",), represented([(1, 0)], (1, 0)), multiplicities=None),
        "accepted",
    ),
    "fewer polynomials than variables, a solution called simple": (
        listed("x,y", ("x^2-1",), represented([(1, 0)], (1, 0)), multiplicities=1),
        "rejected",
    ),
}

P = (1 << pure.MERSENNE[0]) - 1
BITS = pure.MERSENNE[0] + 9
CELLS = 3 << 32
"""Roots 1 and 5 times the inverse of this are in neighbouring cells of the coarsest grid, and no ends of them."""
MEET = isqrt(3 * P) | 1
CLOSE = (MEET**2 - 3 * P) // 4
"""T^2 - MEET T + CLOSE has the discriminant 3 P."""


def _cube(c: int, b: int, a: int) -> str:
    """Of c + b x + a x^2."""
    found = [1]
    for _ in range(3):
        found = [c * x + b * y + a * z for x, y, z in zip([*found, 0, 0], [0, *found, 0], [0, 0, *found], strict=True)]
    return "+".join(f"{value}*x^{k}" if k > 1 else (f"{value}*x" if k else f"{value}") for k, value in enumerate(found))


LINED = represented([(0, 0), (1, 0)], (1, 0))
MIXED: dict[str, Row] = {
    "a polynomial divisible by the eliminant at one power of 2 alone": (_divisible_at_one_power(), "rejected"),
    "double roots of 2": (ranked("x", ("x^6-7*x^4+16*x^2-12",), one(6, 0, -5, 0, 1), [1, 2, 2, 1], 6), "accepted"),
    "double roots of 2, called simple": (
        ranked("x", ("x^6-7*x^4+16*x^2-12",), one(6, 0, -5, 0, 1), [2, 1, 1, 2], 6),
        "rejected",
    ),
    "double roots of 3": (ranked("x", ("x^6-8*x^4+21*x^2-18",), one(6, 0, -5, 0, 1), [2, 1, 1, 2], 6), "accepted"),
    "a double root of 0": (ranked("x", ("x^4-2*x^2",), one(0, -2, 0, 1), [1, 2, 1], 4), "accepted"),
    "a simple root of 0": (ranked("x", ("x^5-4*x^3+4*x",), one(0, -2, 0, 1), [2, 1, 2], 5), "accepted"),
    "a double and a simple root": (ranked("x", ("x^3-x^2",), one(0, -1, 1), [2, 1], 3), "accepted"),
    "a double and a simple root, the other way": (ranked("x", ("x^3-x^2",), one(0, -1, 1), [1, 2], 3), "rejected"),
    "a double root, times a prime": (ranked("x", (f"{P}*x^3-{P}*x^2",), one(0, -1, 1), [2, 1], 3), "accepted"),
    "a double root, a prime, another": (
        ranked("x", (f"{P}*x^3-{P}*x^2", "x^4-2*x^3+x^2"), one(0, -1, 1), [2, 1], 3),
        "accepted",
    ),
    "a double root, another, a prime": (
        ranked("x", ("x^4-2*x^3+x^2", f"{P}*x^3-{P}*x^2"), one(0, -1, 1), [2, 1], 3),
        "accepted",
    ),
    "double points, a prime before": (ranked("x,y", (f"{P}*x^2-{P}*x", "y^2"), LINED, 2, 4), "accepted"),
    "double points, a prime behind": (
        ranked("x,y", ("x^2", f"{P}*y^2-{P}*y"), represented([(0, 0), (0, 1)], (0, 1)), 2, 4),
        "accepted",
    ),
    "a double root at a fraction of a prime": (
        ranked("x", (f"{P**2}*x^3-{2 * P}*x^2+x",), one(0, -1, P), [1, 2], 3, exponent=BITS),
        "accepted",
    ),
    "a double root at a prime": (
        ranked("x", (f"x^3-{2 * P}*x^2+{P**2}*x",), one(0, -P, 1), [1, 2], 3),
        "accepted",
    ),
    "lines that touch": (
        ranked("x,y", ("2*x+2*y", "x^2+2*x+2*y"), represented([(0, 0)], (1, 1)), 2, 2),
        "accepted",
    ),
    "planes that touch": (
        ranked("x,y,z", ("x+y+3*z", "y+2*z", "z^2+x+2*y+5*z"), represented([(0, 0, 0)], (1, 1, 1)), 2, 2),
        "accepted",
    ),
    "planes that touch, in another order": (
        ranked("x,y,z", ("z^2+x+2*y+5*z", "y+2*z", "3*x+4*y+11*z"), represented([(0, 0, 0)], (1, 1, 1)), 2, 2),
        "accepted",
    ),
    **{f"triple roots of a prime, {n}": _triple((1 << n) - 1) for n in pure.MERSENNE[:2]},
    **{
        f"a triple root at a fraction of a prime, {n}": (
            listed(
                "x",
                (f"{((1 << n) - 1) ** 3}*x^4-{3 * ((1 << n) - 1) ** 2}*x^3+{3 * ((1 << n) - 1)}*x^2-x",),
                one(0, -1, (1 << n) - 1),
                multiplicities=[1, 3],
                exponent=n + 9,
            )
            | complete("exact-elimination", 4, elimination=[]),
            "accepted",
        )
        for n in pure.MERSENNE[:1]
    },
    "large and small polynomials": (
        listed("x", ("x^2-1", f"{10**60}*x^2-{10**60}"), one(-1, 0, 1), **complete("refined-bezout", 2)),
        "accepted",
    ),
    "small and large polynomials": (
        listed("x", (f"{10**60}*x^2-{10**60}", "x^2-1"), one(-1, 0, 1), **complete("refined-bezout", 2)),
        "accepted",
    ),
    "close roots": (
        listed("x", (f"{1 << 90}*x^2-x",), one(0, -1, 1 << 90), exponent=100, **complete("refined-bezout", 2)),
        "accepted",
    ),
    "a root at the prime whose derivative is 0 modulo it alone": (_lost_factor(), "rejected"),
    "a gradient that is a multiple of another modulo the prime": (_lost_rank(26), "rejected"),
    "a gradient of which another is a multiple modulo the prime": (_reversed(_lost_rank(26)), "rejected"),
    "gradients that are so in space": (_lost_rank(26, "z^2"), "rejected"),
    "a double root at 0, a simple one at a prime": (
        ranked("x", (f"x^3-{P}*x^2",), one(0, -P, 1), [2, 1], 3),
        "accepted",
    ),
    "a fourfold point, and a simple one that meets it modulo the prime": (
        ranked(
            "x,y",
            (f"x*y-{P}*y^2", f"x^3-{P * P - P}*x*y-x^2"),
            represented([(0, 0), (P, 1), (1, 0)], (1, 0)),
            [4, 1, 1],
            6,
        ),
        "accepted",
    ),
    "a kernel of long numbers": (
        ranked("x,y", (f"x^2-{1 << 60}*x+y", f"{1 << 60}*x-y"), represented([(0, 0)], (1, 0)), 2, 2),
        "accepted",
    ),
    "double roots in cells side by side": (
        ranked(
            "x",
            (f"{CELLS**4}*x^4-{12 * CELLS**3}*x^3+{46 * CELLS**2}*x^2-{60 * CELLS}*x+25",),
            one(5, -6 * CELLS, CELLS**2),
            2,
            4,
            exponent=40,
        ),
        "accepted",
    ),
    "triple roots that meet modulo a prime": (
        listed("x", (_cube(CLOSE, -MEET, 1),), one(CLOSE, -MEET, 1), multiplicities=3)
        | complete("exact-elimination", 6, elimination=[]),
        "accepted",
    ),
    "gradients that are alike at opposite points": (
        listed(
            "x,y",
            ("x+y^2-1", "x*y+y^3-y+x^2"),
            represented([(0, -1), (0, 1)], (0, 1)),
            multiplicities=None,
        ),
        "accepted",
    ),
    "gradients that are alike at opposite points, called simple": (
        listed("x,y", ("x+y^2-1", "x*y+y^3-y+x^2"), represented([(0, -1), (0, 1)], (0, 1)), multiplicities=1),
        "rejected",
    ),
    "a root near 0 and a long coefficient": (_long_coefficient(), "accepted"),
    "what does not commute": (
        listed(
            "x,y",
            ("x^2-y", "x*y-2*x", "y^2-x"),
            represented([(0, 0)], (1, 1)),
            **complete("exact-elimination", 1, elimination=[]),
        ),
        "rejected",
    ),
    "an unknown that there is not, and no list of solutions": (
        put(put(MADE["elimination"], [["0", "9"]], "elimination"), 5, "solutions"),
        "malformed",
    ),
    "an unknown that there is not": (put(MADE["elimination"], [["0", "9"]], "elimination"), "rejected"),
    "another parameter of a multiple solution": (
        put(MADE["multiple"], ["-1", "-1"], "solutions", 0, "parameter"),
        "rejected",
    ),
    "groups of a line, of double points": (
        listed(
            "x,y",
            LINE,
            represented([(0, 0), (0, 5)], (0, 1)),
            multiplicities=2,
            **complete("multihomogeneous-bezout", 2, groups=[[0], [1]]),
        ),
        "rejected",
    ),
    "groups of a line": (
        listed(
            "x,y",
            LINE,
            represented([(0, 0), (0, 1)], (0, 1)),
            **complete("multihomogeneous-bezout", 2, groups=[[0], [1]]),
        ),
        "rejected",
    ),
    "another parameter": (put(MADE["bezout"], ["-2", "-2"], "solutions", 0, "parameter"), "rejected"),
    "a line, cut twice": (
        slices(("x*y-x",), [[1, 0, 0], [0, 1, 0]], [3, 4, 5], lambda a: (Fraction(0), a), (0, 1)),
        "accepted",
    ),
    "a line, cut twice, two points": (
        slices(("x*y-x",), [[1, 0, 0], [0, 1, 0]], [3, 4], lambda a: (Fraction(0), a), (0, 1)),
        "rejected",
    ),
    "64 forms that are read": (_many_forms(64), "rejected"),
    "a long name that does not occur": (
        MADE["nothing"] | {"variables": ["a" * 33, "y"], "polynomials": [["y"]]},
        "malformed",
    ),
    "a bad name that does not occur": (
        MADE["nothing"] | {"variables": ["9", "y"], "polynomials": [["y"]]},
        "malformed",
    ),
    "a bad name that does not occur, last": (
        MADE["nothing"] | {"variables": ["y", "9"], "polynomials": [["y"]]},
        "malformed",
    ),
}

WEIGHTS: dict[str, Row] = {
    "a fat point, said to count 4, and another point left out": (
        listed("x,y", ("x^3 - x^2", *FAT[1:]), represented([(0, 0)], (1, 1)), multiplicities=4)
        | complete("modular-rank", 4),
        "rejected",
    ),
    "a point of a line": (listed("x,y", ("x - 1",), represented([(1, 0)], (1, 1)), multiplicities=None), "accepted"),
    "a point of a line, called simple": (listed("x,y", ("x - 1",), represented([(1, 0)], (1, 1))), "rejected"),
    "a fat point": (
        listed("x,y", FAT, represented([(0, 0)], (1, 1)), multiplicities=3) | complete("modular-rank", 3),
        "accepted",
    ),
    "a fat point of two": (
        listed("x,y", FAT[::2], represented([(0, 0)], (1, 1)), multiplicities=4) | complete("modular-rank", 4),
        "accepted",
    ),
    "a fat point of two, called three": (
        listed("x,y", FAT[::2], represented([(0, 0)], (1, 1)), multiplicities=3) | complete("modular-rank", 3),
        "rejected",
    ),
    "three polynomials, one of them twice": (
        listed("x,y", (*FAT[::2], "2*x^2"), represented([(0, 0)], (1, 1)), multiplicities=4)
        | complete("modular-rank", 4),
        "accepted",
    ),
    "three polynomials, one of them twice, called three": (
        listed("x,y", (*FAT[::2], "2*x^2"), represented([(0, 0)], (1, 1)), multiplicities=3)
        | complete("modular-rank", 3),
        "rejected",
    ),
    "stairs": (listed("x,y", STAIRS, represented(STEPS, (5, 1)), **complete("modular-rank", 5)), "accepted"),
    "stairs, not all": (
        listed("x,y", STAIRS, represented(STEPS[1:], (5, 1)), **complete("modular-rank", 4)),
        "rejected",
    ),
    "stairs by the product of the degrees": (
        listed("x,y", STAIRS, represented(STEPS, (5, 1)), **complete("refined-bezout", 5)),
        "rejected",
    ),
    "a curved point": (
        listed("x,y", CURVED, represented([(1, 2)], (1, 1)), multiplicities=3)
        | complete("exact-elimination", 3, elimination=[]),
        "accepted",
    ),
    "a curved point, called double": (
        listed("x,y", CURVED, represented([(1, 2)], (1, 1)), multiplicities=2)
        | complete("exact-elimination", 3, elimination=[]),
        "rejected",
    ),
    "a curved point, by ranks": (
        listed("x,y", CURVED, represented([(1, 2)], (1, 1)), multiplicities=2) | complete("modular-rank", 2),
        "rejected",
    ),
    "conics": (
        listed("x,y", CONICS, represented(MEETINGS, (1, 0)), **complete("exact-elimination", 4, elimination=[])),
        "accepted",
    ),
    "conics, not all": (
        listed("x,y", CONICS, represented(MEETINGS[1:], (1, 0)), **complete("exact-elimination", 3, elimination=[])),
        "rejected",
    ),
    "three of four, called four": (
        listed("x,y", SQUARES, represented(CORNERS[1:], (1, 1)), **complete("exact-elimination", 4, elimination=[])),
        "rejected",
    ),
    "a triple and a double solution": (
        listed("x", ("x^5-2*x^4+x^3",), represented([(0,), (1,)], (1,)), multiplicities=[3, 2])
        | complete("exact-elimination", 5, elimination=[]),
        "accepted",
    ),
    "a triple and a double solution, called alike": (
        listed("x", ("x^5-2*x^4+x^3",), represented([(0,), (1,)], (1,)), multiplicities=[3, 3])
        | complete("exact-elimination", 5, elimination=[]),
        "rejected",
    ),
    "a linear polynomial among others": (
        listed(
            "x,y",
            ("x-y", "2*x*y-y^2-1", "2*x^2*y-x*y^2-x"),
            represented([(1, 1), (-1, -1)], (1, 0)),
            **complete("modular-rank", 2),
        ),
        "accepted",
    ),
    **{
        f"a triple root of {name}": _triple(prime) for name, prime in (("the first prime", FIRST), ("the other", PLAIN))
    },
    "half of the corners": (
        listed("x,y", (*SQUARES, "x-1"), represented(CORNERS[2:], (0, 1)), **complete("refined-bezout", 2)),
        "rejected",
    ),
    "half of the corners, as they are": (
        listed("x,y", (*SQUARES, "x-1"), represented(CORNERS[2:], (0, 1))),
        "accepted",
    ),
    "half of the corners, by ranks": (
        listed("x,y", (*SQUARES, "x-1"), represented(CORNERS[2:], (0, 1)), **complete("modular-rank", 2)),
        "accepted",
    ),
    "four points of a line": (
        listed(
            "x,y",
            LINE,
            represented([(0, k) for k in range(4)], (0, 1)),
            multiplicities=1,
            **complete("refined-bezout", 4),
        ),
        "rejected",
    ),
    "four points of a line, unknown": (
        listed("x,y", LINE, represented([(0, k) for k in range(4)], (0, 1)), multiplicities=None),
        "accepted",
    ),
    "a fourfold root": (
        listed(
            "x,y",
            SQUARES,
            {
                "separating_form": [1, 0],
                "eliminant": hexadecimal([1, 0, 2, 0, 1]),
                "numerators": [hexadecimal([-4, 0, -4]), hexadecimal([7, 0, 7])],
            },
            multiplicities=None,
        )
        | {"distinct_solutions": 4},
        "rejected",
    ),
    **_beside("the first prime", FIRST),
    **_beside("the first prime of the plain checker", PLAIN),
}


def _long(place: int) -> Content:
    """One numerator with h added, in a coordinate that the form has not."""
    content = listed(
        "x,y",
        ("x^2-1", "x-y"),
        represented([(-1, -1), (1, 1)], (1, 0) if place else (0, 1)),
        **complete("refined-bezout", 2),
    )
    representation = content["representation"]
    h = [int(c, 16) for c in representation["eliminant"]]
    old = [int(c, 16) for c in representation["numerators"][place]]
    sums = [x + y for x, y in zip(h, [*old, *[0] * (len(h) - len(old))], strict=True)]
    return put(content, hexadecimal(sums), "representation", "numerators", place)


MEET = ("4*x^2-8*x+3", "y+5*x-15/2")
"""(1/2, 5) and (3/2, 0)."""
TOUCH = ("4*x^2-8*x+3", "x-y")
BOXES: dict[str, Row] = {
    **{f"a long numerator {k}": (_long(k), "rejected") for k in (0, 1)},
    "boxes apart in y alone": (
        listed(
            "x,y",
            MEET,
            represented([(Fraction(1, 2), 5), (Fraction(3, 2), 0)], (2, 0)),
            exponent=0,
            **complete("refined-bezout", 2),
        )
        | {"box_exponent": 0},
        "accepted",
    ),
    "boxes that touch": (
        listed(
            "x,y",
            TOUCH,
            represented([(Fraction(1, 2),) * 2, (Fraction(3, 2),) * 2], (2, 0)),
            exponent=0,
            **complete("refined-bezout", 2),
        )
        | {"box_exponent": 0},
        "rejected",
    ),
    "boxes that touch, the other way": (
        listed(
            "x,y",
            ("4*x^2-8*x+3", "x+y-2"),
            represented([(Fraction(1, 2), Fraction(3, 2)), (Fraction(3, 2), Fraction(1, 2))], (2, 0)),
            exponent=0,
            **complete("refined-bezout", 2),
        )
        | {"box_exponent": 0},
        "rejected",
    ),
}

# Points at infinity

INFINITY: dict[str, Row] = {
    "an end twice": (counted(DOUBLE_END, represented([(0, 0), (1, 1)], (1, 0)), ONE_END, 2), "accepted"),
    "an end twice, called once": (
        counted(DOUBLE_END, represented([(0, 0), (1, 1)], (1, 0)), put(ONE_END, 1, "multiplicity"), 2),
        "rejected",
    ),
    "an end twice, called thrice": (
        counted(DOUBLE_END, represented([(0, 0), (1, 1)], (1, 0)), put(ONE_END, 3, "multiplicity"), 2),
        "rejected",
    ),
    "an end twice, but for a solution": (counted(DOUBLE_END, represented([(1, 1)], (1, 0)), ONE_END, 1), "rejected"),
    "an end twice, of three polynomials": (
        counted((*DOUBLE_END, DOUBLE_END[0]), represented([(0, 0), (1, 1)], (1, 0)), ONE_END, 2),
        "accepted",
    ),
    "an end of another chart": (
        counted(DOUBLE_END, represented([(0, 0), (1, 1)], (1, 0)), put(ONE_END, [0, 2], "chart"), 2),
        "rejected",
    ),
    "an end of another form": (
        counted(DOUBLE_END, represented([(0, 0), (1, 1)], (1, 0)), put(ONE_END, [0, 2], "separating_form"), 2),
        "rejected",
    ),
    "an end twice and another once": (
        counted(
            ("x^2*y-3*x^2-y^2+3*y", "x^2*y+x*y-2*y^2-4*x^2-4*x+8*y"),
            represented([(0, 0), (1, 1), (2, 4), (-2, 4), (2, 3), (-3, 3)], (1, 10)),
            at_infinity([(1, 0), (0, 1)], (1, 1), (1, 2), 3),
            6,
        ),
        "accepted",
    ),
    "an end four times": (counted(NODES, represented(BESIDE, (1, 0)), put(ONE_END, 4, "multiplicity"), 5), "accepted"),
    "an end four times, called three": (
        counted(NODES, represented(BESIDE, (1, 0)), put(ONE_END, 3, "multiplicity"), 5),
        "rejected",
    ),
    "an end of three polynomials": (
        counted((*NODES, NODES[0]), represented(BESIDE, (1, 0)), put(ONE_END, 4, "multiplicity"), 5),
        "rejected",
    ),
    "ends, one more": (counted(BILINEAR, represented(PAIR, (1, 0)), put(ENDS, 3, "multiplicity"), 2), "rejected"),
    "ends, one less": (counted(BILINEAR, represented(PAIR, (1, 0)), put(ENDS, 1, "multiplicity"), 2), "rejected"),
    **{
        f"ends on one polynomial alone {k}, {weight}": (
            counted(
                SQUARES,
                represented(CORNERS[4 - number :], (1, 1)),
                at_infinity([(k, 1 - k)], (1, 1), (1, 2), weight),
                number,
            ),
            "rejected",
        )
        for k in (0, 1)
        for weight, number in ((1, 3), (2, 2))
    },
    **{
        f"an end on no polynomial, {weight}": (
            counted(
                SQUARES,
                represented(CORNERS[4 - number :], (1, 1)),
                at_infinity([(Fraction(1, 2), Fraction(1, 2))], (1, 1), (2, 0), weight),
                number,
            ),
            "rejected",
        )
        for weight, number in ((1, 3), (2, 2))
    },
    **{
        f"an end of a long coordinate {k}": (
            put(
                counted(BILINEAR, represented(PAIR, (1, 0)), ENDS, 2),
                [*MADE["infinity"]["infinity"]["coordinates"][k], "0x0"],
                "infinity",
                "coordinates",
                k,
            ),
            "malformed",
        )
        for k in (0, 1)
    },
}

# Nothing listed, and witnesses

FORM = [[0, 1, 0]]
AXIS = ("x*y-y", "x*y-2*y")
"""The line y = 0, that x cuts."""
TILTED = ("x^2+x*y-x-y", "x^2+x*y-2*x-2*y")
"""The line x + y = 0."""


def _at(a: Fraction) -> tuple[Fraction, ...]:
    return (Fraction(0), a)


def _line(constants: Any, forms: Any = FORM) -> Content:
    return slices(LINE, forms, constants, _at, (0, 1))


def _of_high_powers() -> Content:
    """One solution, of which a = b = 1, c = 2; but a^8 c and b^9 were one monomial if exponents had three bits."""
    names = tuple("abcdefghijklmnop")
    texts = (*(f"{name}-1" for name in names[:2]), *(f"{name}-2" for name in names[2:]))
    step = [*("0" + " 0" * k + " 2" for k in range(8)), *("1" + " 1" * k for k in range(9)), "2"]
    return none(texts, "exact-elimination", ",".join(names), elimination=[step])


CLAIMS: dict[str, Row] = {
    "none, a constant": (none(("5",), "exact-elimination", elimination=[]), "accepted"),
    "none, a constant alone": (none(("5",), "exact-elimination", "x", elimination=[]), "accepted"),
    "none, of high powers": (_of_high_powers(), "rejected"),
    "none, where a row must be reduced by a multiple of an element": (
        none(
            ("y^2+x-2", "2*x^2*y+x*y+1", "x*y^2+x^2"),
            "exact-elimination",
            elimination=[["0 1", "1", "1 0"], ["0 0", "2", "3 1"]],
        ),
        "accepted",
    ),
    "none, a constant by ranks": (none(("x", "5"), "modular-rank"), "accepted"),
    "none, a constant before, by ranks": (none(("5", "x"), "modular-rank"), "accepted"),
    "none, by another route": (none(("x", "x-1", "y"), "refined-bezout"), "rejected"),
    "none, by no route": (none(("x", "x-1", "y"), None), "rejected"),
    "none, with a number": (MADE["none, rank"] | {"complex_solutions": 1}, "rejected"),
    "none, without a number": (MADE["none, rank"] | {"complex_solutions": None}, "rejected"),
    "none, called complete": (MADE["none, rank"] | {"claim": "complete", "complex_solutions": None}, "rejected"),
    "none, by steps, called complete": (
        MADE["none, elimination"] | {"claim": "complete", "complex_solutions": None},
        "rejected",
    ),
    "none, by steps, called complete, 0": (MADE["none, elimination"] | {"claim": "complete"}, "rejected"),
    "nothing, with a number": (MADE["nothing"] | {"complex_solutions": 0}, "rejected"),
    "nothing, with three": (MADE["nothing"] | {"complex_solutions": 3}, "rejected"),
    "nothing, distinct": (MADE["nothing"] | {"distinct_solutions": 1}, "rejected"),
    "nothing, detected, with a number": (MADE["detected"] | {"complex_solutions": 0}, "rejected"),
    "solutions without a representation": (
        MADE["some"] | {"representation": None, "distinct_solutions": 0},
        "rejected",
    ),
    "a claim without a route": (MADE["bezout"] | {"completeness_route": None}, "rejected"),
    "a route without a claim": (MADE["some"] | {"completeness_route": "modular-rank"}, "rejected"),
    "a curve beside a route": (MADE["many"] | {"completeness_route": "refined-bezout"}, "rejected"),
    "few polynomials with solutions": (
        MADE["few"] | {"solutions": MADE["bezout"]["solutions"][:1], "real_solutions": 1},
        "rejected",
    ),
    "few polynomials with a form": (put(MADE["few"], FORM, "witness", "forms"), "rejected"),
    "few polynomials of three": (
        listed("x,y", ("x-1", "y-1", "x+y-2"), represented([(1, 1)], (1, 1)))
        | {
            "claim": "positive-dimensional-proved",
            "solutions": [],
            "real_solutions": 0,
            "distinct_solutions": 0,
            "box_exponent": 0,
            "witness": MADE["few"]["witness"],
        },
        "rejected",
    ),
    "many solutions with solutions": (
        MADE["many"] | {"solutions": MADE["bezout"]["solutions"][:1], "real_solutions": 1, "box_exponent": 8},
        "rejected",
    ),
    "a line along x": (slices(AXIS, [[1, 0, 0]], range(3, 8), lambda a: (a, Fraction(0)), (1, 0)), "accepted"),
    "a line cut aslant": (
        slices(LINE, [[3, 2, 1]], range(3, 8), lambda a: (Fraction(0), (a - 1) / 2), (0, 2)),
        "accepted",
    ),
    "a tilted line": (slices(TILTED, [[1, 0, -1]], range(3, 8), lambda a: (a + 1, -a - 1), (1, 0)), "accepted"),
    "a plane, cut by a line": (
        slices(("x*y-x",), [[1, 1, -1], [1, 2, 0]], ["1", "2"], lambda a: (2 - a, a - 1), (1, 0)),
        "rejected",
    ),
    "slices twice, first": (_line([3, 3, 4, 5, 6]), "rejected"),
    "slices twice, last": (_line([3, 4, 5, 6, 6]), "rejected"),
    "slices that fall, first": (_line([4, 3, 5, 6, 7]), "rejected"),
    "slices that fall, last": (_line([3, 4, 5, 7, 6]), "rejected"),
    "slices between": (_line(["1/2", "2/3", "3/4", "4/5", "5/6"]), "accepted"),
    "four slices": (_line([3, 4, 5, 6]), "rejected"),
    "no slice": (_line([]), "rejected"),
    "a constant form, cut where it is": (_line([5], [[0, 0, 5]]), "rejected"),
    "a form of nothing, first": (_line(range(3, 8), [[0, 0, 0], [0, 1, 0]]), "rejected"),
    "a form of nothing, last": (_line(range(3, 8), [[0, 1, 0], [0, 0, 0]]), "rejected"),
    "a constant form, first": (_line(range(3, 8), [[0, 0, 5], [0, 1, 0]]), "rejected"),
    "a constant form, last": (_line(range(3, 8), [[0, 1, 0], [0, 0, 5]]), "rejected"),
}

# The format

THREE = system_content("x,y,z", ("x*y-1", "z-2"))
ALGEBRA = MADE["algebra"]


def _groups(value: Any) -> Content:
    return THREE | {"groups": value}


def _steps(value: Any) -> Content:
    return ALGEBRA | {"elimination": [[value]]}


def _named(name: Any) -> Content:
    return system_content("x,y", SQUARES) | {"variables": [name, "y"], "polynomials": [[f"{name}^2", "-1"]]}


def _polynomial(*terms: Any, names: str = "x,y") -> Content:
    return system_content(names, ("y",) if "y" in names else ("x",)) | {"polynomials": [list(terms)]}


def _witness(**entries: Any) -> Content:
    return MADE["many"] | {"witness": MADE["many"]["witness"] | entries}


NINES = "9" * 3999
TERMS: dict[str, str] = {
    "9*x^9": "accepted",
    "90*x^19*y^19": "accepted",
    "19*x": "accepted",
    "x^10": "accepted",
    "x^63*y": "accepted",
    "x^64": "accepted",
    "-x": "accepted",
    "-2*x": "accepted",
    "-1": "accepted",
    "1": "accepted",
    "y^64": "accepted",
    "109*y": "accepted",
    "x^65": "too-large",
    "x^99": "too-large",
    "x^64*y": "too-large",
    "x^100": "malformed",
    "x^9999": "malformed",
    "x^99999": "malformed",
    "x^1": "malformed",
    "x^0": "malformed",
    "x^01": "malformed",
    "01*x": "malformed",
    "0": "malformed",
    "0*x": "malformed",
    "00": "malformed",
    "1*x": "malformed",
    "-1*x": "malformed",
    "--x": "malformed",
    "+x": "malformed",
    "x*x": "malformed",
    "y*x": "malformed",
    "x*2": "malformed",
    "2*3": "malformed",
    "": "malformed",
    "*": "malformed",
    "x*": "malformed",
    "*x": "malformed",
    "x**y": "malformed",
    "x^": "malformed",
    "^2": "malformed",
    "x^-1": "malformed",
    "x^y": "malformed",
    "z": "malformed",
    "2x": "malformed",
    "x y": "malformed",
    " x": "malformed",
    "x ": "malformed",
    "1/2*x": "malformed",
    "1.5*x": "malformed",
    "x^2^2": "malformed",
    "-": "malformed",
    "-0": "malformed",
    "2*-x": "malformed",
    f"1{NINES}*x": "accepted",
    f"-1{NINES}": "accepted",
    f"11{NINES}*x": "too-large",
    f"-11{NINES}": "too-large",
    "\u0663": "malformed",
    "x^\u0663": "malformed",
    "x^2*x": "malformed",
    "x*y*x": "malformed",
}
GOOD_NAMES = (
    "A",
    "Z",
    "a",
    "z",
    "_",
    "_0",
    "_9",
    "x0",
    "x9",
    "zz",
    "ZA",
    "xA",
    "xZ",
    "xa",
    "xz",
    "x_",
    "a" * 32,
    "AZaz_09",
)
BAD_NAMES = (
    "",
    "0",
    "9x",
    "a" * 33,
    "x-",
    "x y",
    "x.y",
    "\u00e9",
    "x\u00e9",
    "x\u0663",
    "[",
    "`",
    "{",
    "@",
    "x/",
    "x:",
    "x[",
    "x`",
    "x{",
    "x@",
    "y",
)
STEPS_OF: dict[str, str] = {
    **dict.fromkeys(
        (
            "2",
            "9",
            "10",
            "18",
            "19",
            "90",
            "99",
            "100",
            "109",
            "190",
            "999999",
            "0 2",
            "0 8",
            "0 9",
            "0 10",
            "0 19",
            "0 59",
            "0 60",
            "0 61",
            "0 63",
            "0 0 2",
        ),
        "rejected",
    ),
    **dict.fromkeys(
        (
            "00",
            "01",
            "09",
            "1000000",
            "0 00",
            "0 01",
            "0 64",
            "0 70",
            "0 99",
            "0 100",
            "0  0",
            " 0",
            "0 ",
            "",
            "x",
            "0,0",
            "-1",
            "0 1 0",
            "0 -1",
            "0" + " 0" * 65,
            "\u0663",
            "0 \u0663",
        ),
        "malformed",
    ),
}
MANY = [f"x{k}" for k in range(65)]
FORMAT: dict[str, Row] = {
    **{f"the term {term[:20]!r}, {len(term)}": (_polynomial(term), status) for term, status in TERMS.items()},
    **{f"the name {name!r}": (_named(name), "accepted") for name in GOOD_NAMES},
    **{f"the name {name!r} is none": (_named(name), "malformed") for name in BAD_NAMES},
    **{f"the step {step[:20]!r}, {len(step)}": (_steps(step), status) for step, status in STEPS_OF.items()},
    "a term of a long name": (_polynomial("x" * 4001), "malformed"),
    "a name of no text": (_named(5), "malformed"),
    "a step of no text": (_steps(5), "malformed"),
    "a step of 64 factors": (_steps("0" + " 0" * 64), "accepted"),
    "steps of no list": (ALGEBRA | {"elimination": [5]}, "malformed"),
    "5000 products": (ALGEBRA | {"elimination": [[5] * 5000]}, "malformed"),
    "5001 products": (ALGEBRA | {"elimination": [[5] * 5001]}, "too-large"),
    "a bad name last": (MADE["nothing"] | {"variables": ["x", "9"]}, "malformed"),
    "64 variables": (system_content("x0", ("x0",)) | {"variables": MANY[:64]}, "accepted"),
    "65 variables": (system_content("x0", ("x0",)) | {"variables": MANY}, "too-large"),
    "variables of no list": (MADE["nothing"] | {"variables": 5}, "malformed"),
    "variables in a text": (MADE["nothing"] | {"variables": "xy"}, "malformed"),
    "a title of no text": (MADE["nothing"] | {"title": 5}, "malformed"),
    "notes of no list": (MADE["nothing"] | {"notes": "none"}, "malformed"),
    "a note of no text": (MADE["nothing"] | {"notes": [5]}, "malformed"),
    "some notes": (MADE["nothing"] | {"notes": ["one", "two"]}, "accepted"),
    "polynomials of no list": (MADE["nothing"] | {"polynomials": 5}, "malformed"),
    "a polynomial of no list": (MADE["nothing"] | {"polynomials": ["x"]}, "malformed"),
    "a polynomial of no term": (MADE["nothing"] | {"polynomials": [[], ["x"]]}, "malformed"),
    "a polynomial of no term, last": (MADE["nothing"] | {"polynomials": [["x"], []]}, "malformed"),
    "a term of no text": (_polynomial(5), "malformed"),
    "256 polynomials": (MADE["nothing"] | {"polynomials": [["x"]] * 256}, "accepted"),
    "257 polynomials": (MADE["nothing"] | {"polynomials": [["x"]] * 257}, "too-large"),
    "terms that increase": (_polynomial("y", "x"), "malformed"),
    "terms that increase, last": (_polynomial("x^2", "y", "x"), "malformed"),
    "terms that increase, first": (_polynomial("x", "x^2", "1"), "malformed"),
    "a term twice": (_polynomial("x", "x"), "malformed"),
    "a term twice, last": (_polynomial("x^2", "x", "2*x"), "malformed"),
    "terms of a degree": (_polynomial("x^2", "x*y", "y^2", "x", "y", "1"), "accepted"),
    "x z before y^2": (_polynomial("x^2", "x*z", "y^2", names="x,y,z"), "malformed"),
    "y^2 before x z": (_polynomial("x^2", "y^2", "x*z", names="x,y,z"), "accepted"),
    "the greatest grid": (MADE["nothing"] | {"box_exponent": pure.MAX_BOX_EXPONENT}, "rejected"),
    "a finer grid": (MADE["nothing"] | {"box_exponent": pure.MAX_BOX_EXPONENT + 1}, "too-large"),
    "groups in order": (_groups([[0, 2], [1]]), "rejected"),
    "three groups": (_groups([[0], [1], [2]]), "rejected"),
    "a group out of order, first": (_groups([[2, 0], [1]]), "malformed"),
    "a group alone out of order": (_groups([[1, 0], [2]]), "malformed"),
    "a group out of order, last": (_groups([[0], [2, 1]]), "malformed"),
    "groups out of order": (_groups([[1], [0, 2]]), "malformed"),
    "groups out of order, last": (_groups([[0], [2], [1]]), "malformed"),
    "a group of nothing": (_groups([[0, 1, 2], []]), "malformed"),
    "a group of nothing, first": (_groups([[], [0, 1, 2]]), "malformed"),
    "a variable in no group": (_groups([[0], [1]]), "malformed"),
    "a variable twice": (_groups([[0], [1], [2], [2]]), "malformed"),
    "a variable twice, in a group": (_groups([[0], [1, 2, 2]]), "malformed"),
    "a variable more": (_groups([[0], [1, 2, 3]]), "malformed"),
    "one group of all": (_groups([[0, 1, 2]]), "malformed"),
    "no group": (_groups([]), "malformed"),
    "groups of no list": (_groups(5), "malformed"),
    "a group of no list": (_groups([5]), "malformed"),
    "a group of true": (_groups([[False, True], [2]]), "malformed"),
    "5000 slices": (_witness(slices=[5] * 5000), "malformed"),
    "64 forms": (_witness(forms=[5] * 64), "malformed"),
    "slices of no list": (_witness(slices=5), "malformed"),
    "forms of no list": (_witness(forms=5), "malformed"),
    "a form of two": (_witness(forms=[[0, 1]]), "malformed"),
    "a form of four": (_witness(forms=[[0, 1, 0, 0]]), "malformed"),
    "a cause of its own": (_witness(cause="none"), "malformed"),
    "65 forms": (_witness(forms=[[0, 1, 0]] * 65), "too-large"),
    "a slice of a float": (put(MADE["many"], "1.5", "witness", "slices", 0, "constant"), "malformed"),
    "a slice not in lowest terms": (put(MADE["many"], "6/2", "witness", "slices", 0, "constant"), "malformed"),
    "version 0": (MADE["nothing"] | {"version": 0}, "malformed"),
    "a true version": (MADE["nothing"] | {"version": True}, "malformed"),
    "a route of its own": (MADE["nothing"] | {"completeness_route": "proof"}, "malformed"),
    "a claim of its own": (MADE["nothing"] | {"claim": "some"}, "malformed"),
    **{
        f"{key} below 0": (MADE["nothing"] | {key: -1}, "malformed")
        for key in ("complex_solutions", "distinct_solutions", "real_solutions", "box_exponent")
    },
    **{
        f"{key} true": (MADE["nothing"] | {key: True}, "malformed")
        for key in ("complex_solutions", "distinct_solutions", "real_solutions", "box_exponent")
    },
    **{
        f"a representation with {value} under {key}": (put(MADE["some"], value, "representation", key), "malformed")
        for key, values in {
            "separating_form": ([1], [1, 1, 1], 5, ["1", "1"], [True, 1]),
            "eliminant": ([], ["0x1"], 5, ["1", "1"]),
            "numerators": ([], [["0x1"]], [["0x1"]] * 3, 5),
        }.items()
        for value in values
    },
    "an infinity of nothing": (put(MADE["infinity"], ["0x1"], "infinity", "eliminant"), "malformed"),
    "a multiplicity below 0": (put(MADE["infinity"], -1, "infinity", "multiplicity"), "malformed"),
    "a chart of one": (put(MADE["infinity"], [1], "infinity", "chart"), "malformed"),
    "a chart of three": (put(MADE["infinity"], [1, 1, 1], "infinity", "chart"), "malformed"),
    "coordinates of one": (put(MADE["infinity"], [["0x1"]], "infinity", "coordinates"), "malformed"),
    "a solution of one value": (put(MADE["some"], [["0", "1"]], "solutions", 0, "values"), "malformed"),
    "a solution of three values": (put(MADE["some"], [["0", "1"]] * 3, "solutions", 0, "values"), "malformed"),
    "a parameter of one end": (put(MADE["some"], ["0"], "solutions", 0, "parameter"), "malformed"),
    "a multiplicity of a solution below 0": (put(MADE["some"], -1, "solutions", 0, "multiplicity"), "malformed"),
    "a true multiplicity": (put(MADE["some"], True, "solutions", 0, "multiplicity"), "malformed"),
}

ROWS: dict[str, Row] = merged(MIXED, FINE, WEIGHTS, BOXES, INFINITY, CLAIMS, FORMAT)

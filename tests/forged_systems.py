"""Forged certificates of polynomial systems: each is consistent but for one thing, and only one check sees it.

Each row has the content and a pattern for the reason; digests are computed again by whoever tries them.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from fractions import Fraction
from typing import Any

from handmade_systems import (
    BILINEAR,
    CORNERS,
    DOUBLE,
    ENDS,
    LINE,
    PAIR,
    SQUARES,
    TANGENT,
    Content,
    at_infinity,
    complete,
    handmade,
    hexadecimal,
    listed,
    represented,
    system_content,
)

Forgery = tuple[Callable[[], Content], str]


def _changed(name: str, *path: Any, value: Any) -> Callable[[], Content]:
    """An honest certificate with another entry."""

    def made() -> Content:
        content = deepcopy(handmade()[name])
        entry = content
        for key in path[:-1]:
            entry = entry[key]
        entry[path[-1]] = value
        return content

    return made


def _entries(name: str, **entries: Any) -> Callable[[], Content]:
    """An honest certificate with other entries."""
    return lambda: deepcopy(handmade()[name]) | entries


# Checks 1 and 2


def _multiple_root() -> Content:
    """h = (T^2 + 1)^2: h and N are multiples of T^2 + 1, so that any polynomial of degree 2 vanishes modulo h."""
    representation = {
        "separating_form": [1, 0],
        "eliminant": hexadecimal([1, 0, 2, 0, 1]),
        "numerators": [hexadecimal([-4, 0, -4]), hexadecimal([7, 0, 7])],
    }
    return listed("x,y", SQUARES, representation, **complete("refined-bezout", 4))


def _scaled(factor: int) -> Content:
    """The representation with all coefficients multiplied."""
    content = deepcopy(handmade()["bezout"])
    representation = content["representation"]
    for each in (representation["eliminant"], *representation["numerators"]):
        each[:] = hexadecimal([factor * int(coefficient, 16) for coefficient in each])
    return content


def _long_numerators() -> Content:
    """N_1 + h and N_2 - h: the same values at the roots."""
    content = deepcopy(handmade()["bezout"])
    representation = content["representation"]
    h = [int(coefficient, 16) for coefficient in representation["eliminant"]]
    for sign, each in zip((1, -1), representation["numerators"], strict=True):
        values = [int(coefficient, 16) for coefficient in each] + [0] * (len(h) - len(each))
        each[:] = hexadecimal([value + sign * coefficient for value, coefficient in zip(values, h, strict=True)])
    return content


def _one_solution_twice() -> Content:
    """The corner (1, 2) at two roots, instead of another corner."""
    points = [(-1, -2), (-1, 2), (1, 2), (1, 2)]
    content = listed("x,y", SQUARES, represented(points, (1, 1), (0, 0, 0, 1)), **complete("refined-bezout", 4))
    content["representation"]["separating_form"] = [1, 1]
    return content


# Check 4


def _without_a_real_solution() -> Content:
    content = deepcopy(handmade()["some"])
    del content["solutions"][0]
    return content | {"real_solutions": 2}


def _swapped() -> Content:
    content = deepcopy(handmade()["bezout"])
    content["solutions"][:2] = reversed(content["solutions"][:2])
    return content


def _meeting_boxes() -> Content:
    """Solutions 1/4 apart in boxes of width 2."""
    texts = ("4*x^2-x", "y")
    points = [(0, 0), (Fraction(1, 4), 0)]
    return listed("x,y", texts, represented(points, (4, 0)), exponent=0, **complete("refined-bezout", 2)) | {
        "box_exponent": 0
    }


# Checks 5 to 8


def _double_called_simple() -> Content:
    return listed("x,y", TANGENT, represented([(0, 0)], (1, 1)), multiplicities=1)


def _double_called_unknown() -> Content:
    return listed("x,y", SQUARES, represented(CORNERS[1:], (1, 1)), multiplicities=None)


def _more_polynomials_than_unknowns() -> Content:
    """x^2, y^2 and x y: multiplicity 3; with two polynomials it would be 4."""
    content = listed("x,y", ("x^2", "y^2", "x*y"), represented([(0, 0)], (1, 1)), multiplicities=4)
    return content | complete("modular-rank", 4)


def _route(route: str, **entries: Any) -> Content:
    """Three of four solutions, called all."""
    return listed("x,y", SQUARES, represented(CORNERS[1:], (1, 1)), **complete(route, 3, **entries))


def _groups_of_more_polynomials() -> Content:
    """The bilinear pair with a third polynomial that vanishes there: no multihomogeneous number, which needs two."""
    texts = (*BILINEAR, "x*y+x+y-5")
    return listed("x,y", texts, represented(PAIR, (1, 0)), **complete("multihomogeneous-bezout", 2, groups=[[0], [1]]))


def _groups_with_a_multiple_solution() -> Content:
    """x y = 1, x y - 2x - 2y + 3: one double solution, and one more is made room for by no one."""
    texts = ("x*y-1", "x*y-2*x-2*y+3")
    content = listed("x,y", texts, represented([(1, 1)], (1, 0)), multiplicities=2)
    return content | complete("multihomogeneous-bezout", 2, groups=[[0], [1]])


def _elimination_of_fewer() -> Content:
    """What the top forms leave is 4, the weight of the solution 2; the algebra gives 4, not 2."""
    content = listed("x,y", TANGENT, represented([(0, 0)], (1, 1)), multiplicities=2)
    return content | complete("exact-elimination", 2, elimination=[])


def _algebra_that_does_not_close() -> Content:
    """The matrices of x^2 = y, x y = 1, y^2 = 2 do not commute: there is no solution at all of them."""
    texts = ("x^2-y", "x*y-1", "y^2-x")
    points = represented([(1, 1)], (1, 1))
    return listed("x,y", texts, points, multiplicities=3, **complete("exact-elimination", 3, elimination=[]))


# Check 9


def _infinity(texts: tuple[str, ...], points: Any, infinity: Content, total: int, **options: Any) -> Content:
    return listed("x,y", texts, points, **options, **complete("counting-at-infinity", total, infinity=infinity))


def _one_end_twice() -> Content:
    """The end (0 : 1 : 0) at two roots."""
    ends = deepcopy(ENDS)
    twice = represented([(1, 0), (1, 0)], (1, 2), (0, 1))
    return _infinity(
        BILINEAR,
        represented(PAIR, (1, 0)),
        ends | {"eliminant": twice["eliminant"]} | {"coordinates": twice["numerators"]},
        2,
    )


def _end_elsewhere() -> Content:
    """(0 : 1 : 1) is on no hyperbola."""
    ends = at_infinity([(1, 0), (Fraction(1, 2), Fraction(1, 2))], (1, 1), (1, 2), 2)
    return _infinity(BILINEAR, represented(PAIR, (1, 0)), ends, 2)


def _end_off_the_chart() -> Content:
    """One end twice: as (1, 0) and as (2, 0), which are different vectors."""
    ends = at_infinity([(1, 0), (2, 0)], (1, 1), (1, 1), 2)
    return _infinity(BILINEAR, represented(PAIR, (1, 0)), ends, 2)


def _too_few_ends() -> Content:
    return _infinity(BILINEAR, represented(PAIR, (1, 0)), at_infinity([(1, 0)], (1, 1), (1, 2), 1), 2)


def _heavier_ends() -> Content:
    ends = at_infinity([(1, 0)], (1, 1), (1, 2), 2)
    return _infinity(BILINEAR, represented(PAIR, (1, 0)), ends, 2)


def _line_at_infinity() -> Content:
    """x = 0 at infinity is common to all three quadrics; 3 of its points weigh 6, two solutions 2: 8 in all."""
    texts = ("x*y+y-2", "x*z+z-2", "3*x^2+3*x*y-10*x+4")
    ends = [(0, 1 - k, k) for k in (0, 2, 3)]
    infinity = at_infinity(ends, (0, 1, 1), (0, 1, 2), 6)
    points = represented([(1, 1, 1), (2, Fraction(2, 3), Fraction(2, 3))], (1, 0, 0))
    return listed("x,y,z", texts, points, **complete("counting-at-infinity", 2, infinity=infinity))


# Checks 10 and 11


def _slices_of(texts: tuple[str, ...], constants: range, forms: Any = None, **entries: Any) -> Content:
    slices = [{"constant": str(a), "representation": represented([(0, a)], (0, 1))} for a in constants]
    witness = {"cause": "more-solutions-than-bound", "forms": forms or [[0, 1, 0]], "slices": slices}
    return system_content("x,y", texts, claim="positive-dimensional-proved", witness=witness, **entries)


def _without_forms() -> Content:
    witness: Content = deepcopy(handmade()["many"]["witness"])
    return witness | {"forms": []}


def _few(texts: tuple[str, ...], point: tuple[int, int]) -> Content:
    witness = {"cause": "fewer-polynomials", "forms": [], "slices": []}
    points = represented([point], (1, 1))
    return system_content("x,y", texts, claim="positive-dimensional-proved", witness=witness, representation=points)


def _none(texts: tuple[str, ...], route: str, **entries: Any) -> Content:
    return system_content("x,y", texts, claim="inconsistent", completeness_route=route, complex_solutions=0, **entries)


FORGERIES: dict[str, Forgery] = {
    "1: multiple root": (_multiple_root, "eliminant: .*squarefree"),
    "1: common factor": (lambda: _scaled(2), "eliminant: "),
    "1: sign": (lambda: _scaled(-1), "eliminant: "),
    "1: long numerators": (_long_numerators, "(representation|eliminant|solutions): .*degree"),
    "2: one solution twice": (_one_solution_twice, "separating form"),
    "2: another form": (_changed("some", "representation", "separating_form", value=[1, 2]), "separating form"),
    "3: no solution": (lambda: listed("x,y", SQUARES, represented([(1, 2), (1, 3)], (1, 1))), "polynomials: "),
    "3: a constant": (lambda: listed("x,y", ("x-1", "5"), represented([(1, 2)], (1, 1))), "polynomials: "),
    "4: a real solution missing": (_without_a_real_solution, "real solutions: "),
    "4: order": (_swapped, "real solutions: |boxes: "),
    "4: boxes meet": (_meeting_boxes, "boxes: .*disjoint"),
    "4: number": (_entries("some", real_solutions=2), "real solutions: "),
    "4: grid without a solution": (_entries("nothing", box_exponent=3), "boxes: "),
    "5: multiple, called simple": (_double_called_simple, "multiplicity: "),
    "5: simple, called unknown": (_double_called_unknown, "multiplicity: "),
    "5: more polynomials than unknowns": (_more_polynomials_than_unknowns, "complex solutions: "),
    "6: three of four, Bezout": (lambda: _route("refined-bezout"), "claim: "),
    "6: three of four, groups": (lambda: _route("multihomogeneous-bezout", groups=[[0], [1]]), "groups: "),
    "6: groups, three polynomials": (_groups_of_more_polynomials, "groups: "),
    "6: groups, a multiple solution": (_groups_with_a_multiple_solution, "groups: "),
    "6: other groups": (
        lambda: (
            listed("x,y", DOUBLE, represented([(0, -1), (0, 1)], (1, 1)), multiplicities=2)
            | complete("multihomogeneous-bezout", 4, groups=[[0], [1]])
        ),
        "groups: ",
    ),
    "8: three of four, rank": (lambda: _route("modular-rank"), "claim: |modular rank: "),
    "8: no number": (
        lambda: listed("x,y", BILINEAR, represented(PAIR, (1, 0)), **complete("modular-rank", 2)),
        "claim: |modular rank: ",
    ),
    "9: one end twice": (_one_end_twice, "(at infinity|infinity): "),
    "9: an end elsewhere": (_end_elsewhere, "(at infinity|infinity): "),
    "9: an end off the chart": (_end_off_the_chart, "(at infinity|infinity|chart): "),
    "9: too few ends": (_too_few_ends, "(at infinity|infinity|claim): "),
    "9: heavier ends": (_heavier_ends, "(at infinity|infinity): "),
    "9: a line at infinity": (_line_at_infinity, "(at infinity|infinity): .*finite"),
    "9: fewer polynomials": (
        lambda: _infinity(("x*y-1",), represented([(1, 1)], (1, 0)), ENDS, 1, multiplicities=None),
        "infinity: ",
    ),
    "10: three of four, elimination": (lambda: _route("exact-elimination", elimination=[]), "elimination: |claim: "),
    "10: an elimination leaves more": (_elimination_of_fewer, "complex solutions: |multiplicity: "),
    "10: an algebra does not close": (_algebra_that_does_not_close, "elimination: |claim: "),
    "10: multiplicity": (_changed("algebra", "solutions", 0, "multiplicity", value=3), "multiplicity: "),
    "10: total": (_entries("algebra", complex_solutions=3), "complex solutions: "),
    "10: distinct": (_entries("some", distinct_solutions=4), "distinct solutions: "),
    "10: less than is proved": (
        _entries("bezout", claim="not-proven-complete", completeness_route=None, complex_solutions=None),
        "claim: ",
    ),
    "10: another route": (_entries("bezout", completeness_route="modular-rank"), "claim: "),
    "10: detected beside solutions": (_entries("some", claim="positive-dimensional-detected"), "claim: "),
    "10: none beside solutions": (
        _entries("some", claim="inconsistent", completeness_route="modular-rank", complex_solutions=0),
        "(claim|modular rank): ",
    ),
    "10: a number that is not proved": (_entries("some", complex_solutions=3), "complex solutions: "),
    "10: solutions without a representation": (_entries("some", representation=None), "representation: "),
    "10: complete without a representation": (
        lambda: system_content("x,y", SQUARES, **complete("modular-rank", 4)),
        "(complex solutions|claim): ",
    ),
    "10: groups beside another route": (_entries("bezout", groups=[[0], [1]]), "groups: "),
    "10: no groups": (_entries("groups", groups=None), "groups: "),
    "10: infinity beside another route": (_entries("groups", infinity=ENDS), "infinity: "),
    "10: no elimination": (_entries("algebra", elimination=None), "elimination: "),
    "10: an elimination beside another route": (_entries("rank", elimination=[]), "elimination: "),
    "10: a witness beside solutions": (_entries("some", witness=handmade()["many"]["witness"]), "witness: "),
    "10: none, but solutions": (lambda: _none(SQUARES, "modular-rank"), "claim: "),
    "10: none, but at infinity": (lambda: _none(("x", "x-1"), "modular-rank"), "claim: "),
    "10: none, an elimination without a constant": (
        lambda: _none(("x*y-1", "x"), "exact-elimination", elimination=[]),
        "claim: |elimination: ",
    ),
    "10: steps to nothing": (lambda: _none(("x*y-1", "x"), "exact-elimination", elimination=[["7"]]), "elimination: "),
    "11: no witness": (_entries("few", witness=None), "witness: "),
    "11: as many polynomials as unknowns": (lambda: _few(SQUARES, (1, 2)), "witness: "),
    "11: few polynomials, no solution": (lambda: _few(("x*y-1",), (1, 2)), "polynomials: "),
    "11: few polynomials, no point": (_entries("few", representation=None), "(witness|representation): "),
    "11: constants fall": (lambda: _slices_of(LINE, range(7, 2, -1)), "witness: "),
    "11: a constant form": (lambda: _slices_of(LINE, range(3, 8), [[0, 0, 1], [0, 1, 0]]), "witness: "),
    "11: no form": (lambda: handmade()["many"] | {"witness": _without_forms()}, "witness: "),
    "11: slices beside few polynomials": (
        _changed(
            "few", "witness", "slices", value=[{"constant": "1", "representation": represented([(0, 1)], (0, 1))}]
        ),
        "witness: ",
    ),
    "11: no more than the bound": (lambda: _slices_of(LINE, range(3, 7)), "witness: "),
    "11: a slice elsewhere": (lambda: _slices_of(("x*y-1", "x*y-2"), range(3, 8)), "slice.*: "),
    "11: a point off its slice": (lambda: _slices_of(LINE, range(3, 8)) | {"witness": _off_its_slice()}, "slice.*: "),
    "11: a representation beside slices": (
        _entries("many", representation=represented([(0, 1)], (0, 1))),
        "(witness|representation): ",
    ),
    "11: fewer conditions than unknowns": (lambda: _slices_of(("x*y-x",), range(3, 8)), "witness: "),
    "11: solutions counted": (_entries("many", distinct_solutions=5), "witness: "),
    "11: a route": (_entries("many", completeness_route="modular-rank"), "(witness|claim): "),
    "11: a number of solutions": (_entries("many", complex_solutions=5), "witness: "),
}


def _off_its_slice() -> Content:
    """The solution of the last slice once more, for a greater constant."""
    witness: Content = deepcopy(handmade()["many"]["witness"])
    witness["slices"][-1]["representation"] = witness["slices"][-2]["representation"]
    return witness


MALFORMED: dict[str, Callable[[], Content]] = {
    "one group": _entries("groups", groups=[[0, 1]]),
    "a variable in two groups": _entries("groups", groups=[[0], [0, 1]]),
    "a variable in no group": _entries("groups", groups=[[0], []]),
    "groups in another order": _entries("groups", groups=[[1], [0]]),
    "two variables with one name": _entries("some", variables=["x", "x"]),
    "no variable": _entries("nothing", variables=[], polynomials=[["5"]]),
    "no polynomial": _entries("nothing", polynomials=[]),
    "a numerator is missing": _changed("some", "representation", "numerators", value=[["0x1"]]),
    "a constant eliminant": _changed("some", "representation", "eliminant", value=["0x1"]),
    "version": _entries("some", version=2),
    "an unknown claim": _entries("some", claim="proved"),
    "a negative number": _entries("some", distinct_solutions=-1),
}

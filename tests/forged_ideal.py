"""Mobility certificates of version 3, honest ones and forgeries made by hand: the local ring, and algebraic curves."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from forged_mobility import Row, legs
from forged_second_order import (
    ARM,
    BENNETT,
    FIRST,
    FIVE,
    FLAT,
    HELD,
    LEGS,
    LONG,
    OPEN,
    RODS,
    SCREWS,
    SIGNS,
    SLIDES,
    STRETCHED,
    TIGHT,
    TRIANGLE,
    TURNED_SCREWS,
    TWICE,
    TWO_LOOPS,
    hinges,
    ring,
)
from handmade_mobility import Content, O, X, Y, Z, certificate, joint, subgroups, texts
from tables_of_rows import merged, put

PRIME = (1 << 61) - 1


def ideal(
    mobility: tuple[int, int],
    platform: tuple[int, int],
    above: Any = ("rank", [], 0),
    below: Any = None,
    known: Any = (),
) -> Content:
    """The entry; ``below`` by argument, locked freedoms, legs, vectors and curves."""
    why = dict(zip(("argument", "section", "degree"), (above[0], texts(above[1]), above[2]), strict=True))
    how = None
    if below is not None:
        argument, locked, legs, vectors, curves = (*below, *[[]] * 4)[:5]
        how = {"argument": argument, "locked": locked, "legs": legs, "vectors": texts(vectors), "curves": list(curves)}
    names = ("argument", "least", "most", "platform_least", "platform_most", "dependencies", "above", "below")
    return dict(zip(names, ("ideal", *mobility, *platform, list(known), why, how), strict=True))


def third(content: Content, entry: Any) -> Content:
    return content | {"version": 3, "finite": entry}


def curve(relation: Any, *halves: Any) -> Content:
    return {"relation": texts(relation), "halves": texts(list(halves))}


def _curves(*found: Content, low: int = 1, least: int | None = None, most: int = 1) -> Content:
    count = len(found) if least is None else least
    return ideal((count, most), (low, min(most, 6)), below=("curves", [], [], [], found))


IS_U = [[0], [1]]
"""u = 0."""
STILL: Any = [[[0]], [1]]
MOVES: Any = [[[0, 1]], [1]]
U: Any = [[[0], [1]], [1]]
RATIONAL = [[[[0, -1]], [1, 2]], [[[0, 1]], [1]]] * 2
"""Half tangents of Bennett's linkage: -s / (1 + 2 s) and s."""
PLAIN = curve(IS_U, *RATIONAL)
HYPERBOLA = curve([[0, 1], [1, 2]], *[MOVES, U] * 2)
"""The first is s, the second u, with s + u + 2 s u = 0."""
BACK = [[[0, -2], [1]], [1, 4]]
PARABOLA = curve([[0, -1], [1], [1]], *[BACK, U] * 2)
"""The second is u with u + u^2 = s, the first -u / (1 + 2 u) = (u - 2 s) / (1 + 4 s)."""
AXES = [(-2, 0, -2), (0, 2, -2), (2, 0, -2), (0, -2, -2)]
SLIDE_ON_TOP = joint("arm", "P", "top", "aside", O, [X])
HANGING = certificate([*ring([(1, 0, 0), (0, 1, 1), (-1, 0, 0), (0, -1, 1)], AXES), SLIDE_ON_TOP], [], [])
"""Bennett's linkage with a slide on its top."""
SWINGS = [curve(IS_U, *RATIONAL, STILL), curve(IS_U, *[STILL] * 4, MOVES)]
SCALED = certificate(hinges(0, 1, 3, axes=[(0, 0, PRIME)]), [], [])
"""A stretched triangle, the axes of a length that the prime divides."""
FAR_AWAY = certificate(hinges(0, f"1/{PRIME}", 3), [], [])  # type: ignore[arg-type]
LOCAL = ("local", [[1]], 3)


def turned(v: Any) -> tuple[Any, ...]:
    """A rotation about (1, 1, 1), which mixes all coordinates."""
    x, y, z = map(Fraction, v)
    return (2 * x - y + 2 * z) / 3, (2 * x + 2 * y - z) / 3, (2 * y - x + 2 * z) / 3


FLAT_TURNED = certificate(ring([turned((x, 0, 0)) for x in (0, 1, 4, 3)], [turned(Z)] * 4), [], [])
SHIFT = [Fraction(1, 2), Fraction(1, 3), Fraction(-1, 5)]
SQUARE = [(1, 0, 0), (0, 1, 1), (-1, 0, 0), (0, -1, 1)]
SHIFTED = certificate(ring([[a + b for a, b in zip(p, SHIFT, strict=True)] for p in SQUARE], AXES), [], [])
PERMUTED = [certificate(ring([p[k:] + p[:k] for p in SQUARE], [a[k:] + a[:k] for a in AXES]), [], []) for k in (1, 2)]
"""Bennett's linkage elsewhere, and with other coordinates."""
ALONG = {
    name: certificate(ring([[x * d for d in line] for x in (0, 1, 3)], [axis] * 3), [], [])
    for name, line, axis in (("y", Y, X), ("z", Z, X))
}
"""Stretched triangles along other lines."""
ROUND = {
    name: certificate(ring([O] * 3, [one, [a + b for a, b in zip(one, other, strict=True)], other]), [], [])
    for name, one, other in (("x", Y, Z), ("y", Z, X), ("z", X, Y))
}
"""Hinges through one point, their axes in a plane."""
PAIRS = certificate(ring([O, O, (0, 3, 0), (0, 3, 0)], [Z, Z, X, X]), [], [])
"""Two pairs of hinges on one axis each."""
CHAIN = certificate(legs([("R", O, [Z])] * 31), [], [])


def with_screw(pitch: str, *, before: bool, first: bool) -> Content:
    """A body held by a screw and a hinge on its axis, beside a stretched triangle."""
    ends = ("base", "held"), ("held", "base")
    screw = joint("h", "H", *ends[not first], O, [Z], pitch=pitch)
    hinge = joint("g", "R", *ends[first], O, [Z])
    pair, triangle = ([screw, hinge] if first else [hinge, screw]), hinges(0, 1, 3)
    return certificate([*pair, *triangle] if before else [*triangle, *pair], [], [])


def screw_at_rest(*, first: bool) -> Content:
    """Two hinges on one axis, and a screw before or behind them."""
    joints = [joint("g", "R", "base", "top", O, [Z]), joint("k", "R", "top", "x", O, [Z])]
    screw = joint("h", "H", "x", "base", O, [Z], pitch="1/3")
    if first:
        screw = joint("h", "H", "base", "x", O, [Z], pitch="1/3")
        joints = [joint("g", "R", "x", "top", O, [Z]), joint("k", "R", "top", "base", O, [Z])]
    return certificate([screw, *joints] if first else [*joints, screw], [], [])


HELD_FAR = certificate(
    [
        joint("h", "R", "base", "held", O, [(0, 0, PRIME)]),
        joint("g", "P", "held", "base", O, [Z]),
        *hinges(0, 1, 3),
    ],
    [],
    [],
)
SIX_POINTS = [(1, 0, 1), (-1, 0, 0), (-1, 0, -1), (-1, -1, 1), (0, -1, 0), (1, 1, -1)]
SIX_AXES = [(1, 0, 0), (1, 1, 0), (1, 1, 0), (1, -1, 0), (1, -1, 0), (1, 0, 0)]
SIX = [certificate(ring(SIX_POINTS[k:] + SIX_POINTS[:k], SIX_AXES[k:] + SIX_AXES[:k]), [], []) for k in range(6)]
"""Hinges with one freedom up to the third order, from each of them on: one equation beside the independent ones."""
BACKWARDS: Any = [[[0, -1]], [1]]
TAIL = certificate([*hinges(0, 1, 3), joint("t", "R", "top", "aside", O, [Z])], [], [])

TRUE: dict[str, tuple[Content, Content]] = {
    "five hinges": (FIVE, ideal((0, 0), (0, 0), LOCAL)),
    **{f"six hinges, {k}": (made, ideal((0, 0), (0, 0), ("local", [[1]], 4))) for k, made in enumerate(SIX)},
    "five hinges, a longer vector": (FIVE, ideal((0, 0), (0, 0), ("local", [["-7/3"]], 3))),
    "five hinges, a greater degree": (FIVE, ideal((0, 0), (0, 0), ("local", [[1]], 12))),
    "five hinges and a dependency": (FIVE, ideal((0, 0), (0, 0), LOCAL, known=[["0", "0", "-1", "1", "0", "0"]])),
    "a stretched triangle": (TRIANGLE, ideal((0, 0), (0, 0), ("local", [[1]], 2))),
    "four in a line": (STRETCHED, ideal((0, 1), (0, 1), ("local", [[0, 1]], 2))),
    "rods in a line": (RODS, ideal((0, 0), (0, 0), ("local", [[1, 0], [0, 1]], 3))),
    "a triangle behind another": (TWO_LOOPS, ideal((0, 0), (0, 0), ("local", [[1]], 2))),
    "three loops": (TWICE, ideal((0, 0), (0, 0), ("local", [[1]], 2))),
    "a flat parallelogram": (
        FLAT,
        ideal((1, 1), (0, 1), ("local", [[0, 1]], 2), ("indefinite", [], [], SIGNS), [FIRST]),
    ),
    "an arm": (ARM, ideal((1, 1), (1, 1), ("local", [[1, 5]], 2), ("regular", ["j0", "j1"]))),
    "an arm along a curve": (
        ARM,
        ideal(
            (1, 1),
            (1, 1),
            ("cone", [[1, 5]], 2),
            ("curves", [], [], [], [curve(IS_U, *[STILL] * 3, MOVES)]),
            [FIRST],
        ),
    ),
    "an arm along a curve, both from the ideal": (
        ARM,
        ideal((1, 1), (1, 1), ("local", [[1, 5]], 2), ("curves", [], [], [], [curve(IS_U, *[STILL] * 3, MOVES)])),
    ),
    "legs of an arm": (
        LEGS,
        ideal(
            (1, 1),
            (1, 1),
            ("local", [[5, 1]], 2),
            ("subgroups", ["a2"], subgroups(("a1 a2 a3", 0), ("b1 b2", 0))["legs"]),
        ),
    ),
    "a tail that moves alone": (
        TAIL,
        ideal((1, 1), (0, 1), ("local", [[1, 0]], 2), ("curves", [], [], [], [curve(IS_U, *[STILL] * 3, MOVES)])),
    ),
    "Bennett's linkage": (BENNETT, _curves(PLAIN)),
    "Bennett's linkage on a hyperbola": (BENNETT, _curves(HYPERBOLA)),
    "Bennett's linkage on a parabola": (BENNETT, _curves(PARABOLA)),
    "Bennett's linkage with fractions": (
        BENNETT,
        _curves(curve([[0, "-1/3"], ["1/3"], ["1/3"]], *[[[[0, "-2/5"], ["1/5"]], ["1/5", "4/5"]], U] * 2)),
    ),
    "Bennett's linkage with powers of u": (
        BENNETT,
        _curves(curve([[0, -1], [1], [1]], *[BACK, [[[0, 1], [0], [-1]], [1]]] * 2)),
    ),
    "a slide on Bennett's linkage": (HANGING, _curves(*SWINGS, low=1, most=2)),
    "a slide on Bennett's linkage first": (HANGING, _curves(*SWINGS[::-1], low=1, most=2)),
    "a hinge": (OPEN, _curves(curve(IS_U, MOVES))),
    "a hinge along a circle": (OPEN, _curves(curve([[0, 2, 1], [2], [1]], [[[0], [1]], [-3, 1]]))),
    "two slides": (SLIDES, _curves(curve(IS_U, MOVES, STILL), curve(IS_U, STILL, MOVES), low=2, most=2)),
    **{f"a triangle along {name}": (made, ideal((0, 0), (0, 0), ("local", [[1]], 2))) for name, made in ALONG.items()},
    **{f"a triangle about {name}": (made, ideal((0, 0), (0, 0), ("local", [[1]], 2))) for name, made in ROUND.items()},
    **{f"Bennett's linkage, permuted, {k}": (made, _curves(PARABOLA)) for k, made in enumerate(PERMUTED)},
    "a flat parallelogram, turned": (FLAT_TURNED, ideal((0, 1), (0, 1), ("local", [[0, 1]], 2))),
    "a relation that falls": (OPEN, _curves(curve([[0], [-1]], MOVES))),
    "a relation with a leading coefficient": (OPEN, _curves(curve([[0], [1], [0, 1]], MOVES))),
    "polynomials of degree 11": (OPEN, _curves(curve([[0], [1]], [[[0, *[1] * 11]], [1, *[0] * 10, 1]]))),
    "sheets up to degree 11": (
        OPEN,
        _curves(curve([[0], [1], *[[0]] * 9, [1]], [[[0, 1], *[[0]] * 10, [1]], [1]])),
    ),
    "two slides together": (SLIDES, _curves(curve(IS_U, MOVES, MOVES), low=1, most=2)),
}
ABOVE, CURVES, MOST = "finite.above: ", "finite.below.curves: ", "finite.most: not the number"
ISOLATED = ABOVE + "the configuration may not be isolated"
PARTS, WORD = "finite.above: not the parts", "finite.argument: not that of its parts"
BELOW = "finite.below: not the parts"
LEAST, LOW, HIGH = "finite.least: not the", "finite.platform_least: not the", "finite.platform_most: not the"
REGULARITY, BEGINS = CURVES + "the relation is not regular", CURVES + "does not begin at the configuration"
OPENED, AT_REST = CURVES + "does not close the loops", CURVES + "does not move"
TOGETHER = CURVES + "two move freedoms of one loop"


def _local(section: Any, degree: int, most: int = 0) -> Content:
    return ideal((0, most), (0, most), ("local", section, degree))


FALSE: dict[str, tuple[Content, Content, str, str]] = {
    "five hinges in the second order": (FIVE, _local([[1]], 2), "rejected", ISOLATED),
    **{
        f"six hinges in the third order, {k}": (made, _local([[1]], 3), "rejected", ISOLATED)
        for k, made in enumerate(SIX)
    },
    "five hinges on nothing": (FIVE, _local([[0]], 3), "rejected", ISOLATED),
    "Bennett's linkage is not isolated": (BENNETT, _local([[1]], 12), "rejected", ISOLATED),
    "a hinge is not isolated": (OPEN, _local([[1]], 2), "rejected", ISOLATED),
    "a flat parallelogram cut along a motion": (FLAT, _local([[1, -1]], 12, 1), "rejected", ISOLATED),
    "a flat parallelogram moves": (FLAT, _local([[1, 0], [0, 1]], 4), "rejected", ISOLATED),
    "the same vector twice": (RODS, _local([[1, 0], [1, 0]], 3), "rejected", ISOLATED),
    "rods in the second order": (RODS, _local([[1, 0], [0, 1]], 2), "rejected", ISOLATED),
    "a section leaves one more": (FIVE, _local([[1]], 3, 1), "rejected", MOST),
    "a section leaves one less": (FLAT, _local([[0, 1]], 2, 0), "rejected", MOST),
    "a short vector": (FLAT, _local([[1]], 2, 1), "malformed", "finite.above.section: not a number for each"),
    "a long vector": (FIVE, _local([[1, 0]], 3), "malformed", "finite.above.section: not a number for each"),
    "more vectors than motions": (FIVE, _local([[1], [1]], 3, -1), "malformed", "finite.most"),
    "no section": (FIVE, _local([], 3, 1), "malformed", PARTS),
    "no degree": (FIVE, _local([[1]], 0), "malformed", PARTS),
    "degree 1": (FIVE, _local([[1]], 1), "malformed", PARTS),
    "degree 13": (FIVE, _local([[1]], 13), "malformed", PARTS),
    "too many monomials": (
        LONG,
        _local([[int(i == j) for j in range(6)] for i in range(4)], 12, 2),
        "too-large",
        ABOVE + "more than 500 monomials",
    ),
    "a section modulo the prime": (
        FIVE,
        _local([[f"1/{PRIME}"]], 3),
        "rejected",
        ABOVE + "the prime divides a denominator",
    ),
    "a mechanism modulo the prime": (
        FAR_AWAY,
        _local([[1]], 2),
        "rejected",
        ABOVE + "the prime divides a denominator",
    ),
    "a minor modulo the prime": (SCALED, _local([[1]], 2), "rejected", ABOVE + "the minor is 0 modulo the prime"),
    "screws": (SCREWS, _local([[1]], 2), "rejected", "finite: a screw of a loop has a pitch"),
    "screws along a curve": (
        SCREWS,
        _curves(curve(IS_U, MOVES, MOVES)),
        "rejected",
        "finite: a screw of a loop has a pitch",
    ),
    **{
        f"a screw of pitch {pitch}, {before}, {first}": (
            with_screw(pitch, before=before, first=first),
            _local([[1]], 2),
            "rejected",
            "finite: a screw of a loop has a pitch",
        )
        for pitch in ("1/3", "-1/3")
        for before in (True, False)
        for first in (True, False)
    },
    **{
        f"screws that turn back, {name}": (
            made,
            _curves(curve(IS_U, MOVES, BACKWARDS)),
            "rejected",
            "finite: a screw of a loop has a pitch",
        )
        for name, made in (("right", SCREWS), ("left", TURNED_SCREWS))
    },
    **{
        f"a screw at rest, {first}": (
            screw_at_rest(first=first),
            _curves(curve(IS_U, *([STILL] * first), MOVES, BACKWARDS, *([STILL] * (not first)))),
            "rejected",
            "finite: a screw of a loop has a pitch",
        )
        for first in (True, False)
    },
    "thirty-one unknowns": (
        CHAIN,
        _local([[int(i == j) for j in range(31)] for i in range(31)], 2),
        "too-large",
        ABOVE + "more than 500 monomials",
    ),
    "a vector and a short one": (
        FLAT,
        _local([[1, 0], [1]], 2),
        "malformed",
        "finite.above.section: not a number for each",
    ),
    "a minor of what is held modulo the prime": (
        HELD_FAR,
        _local([[1]], 3),
        "rejected",
        ABOVE + "the minor is 0 modulo the prime",
    ),
    "Bennett's linkage elsewhere is not isolated": (SHIFTED, _local([[1]], 12), "rejected", ISOLATED),
    **{
        f"Bennett's linkage, permuted, is not isolated, {k}": (made, _local([[1]], 12), "rejected", ISOLATED)
        for k, made in enumerate(PERMUTED)
    },
    "a flat parallelogram, turned, moves": (FLAT_TURNED, _local([[1, 0], [0, 1]], 6), "rejected", ISOLATED),
    **{
        f"a body held along {axis} {'turns' if turns else 'slides'}": (
            HELD[axis],
            _curves(curve(IS_U, *((MOVES, STILL) if turns else (STILL, MOVES)), *[STILL] * 3), low=0),
            "rejected",
            OPENED,
        )
        for axis in HELD
        for turns in (True, False)
    },
    "a relation above 0": (OPEN, _curves(curve([[1], [1]], MOVES)), "rejected", REGULARITY),
    "a relation below 0": (OPEN, _curves(curve([[-1], [1]], MOVES)), "rejected", REGULARITY),
    "a curve from below": (OPEN, _curves(curve(IS_U, [[[-1, 1]], [1]])), "rejected", BEGINS),
    "one slide from elsewhere": (SLIDES, _curves(curve(IS_U, [[[1, 1]], [1]], MOVES), most=2), "rejected", BEGINS),
    **{
        f"speeds that cancel, {k}": (OPEN, _curves(curve(relation, [numerator, [1]])), "rejected", AT_REST)
        for k, (relation, numerator) in enumerate(
            [
                ([[0, 1], [1]], [[0, 1], [1]]),
                ([[0, 1], [1, 5]], [[0, 1], [1]]),
                ([[0, 1], [1]], [[0, 1], [1, 3]]),
                ([[0], [1, 7]], [[0], [1]]),
                ([[0, 1, 3], [1]], [[0, 1, 3], [1]]),
            ]
        )
    },
    "one slide on two curves, as u": (
        SLIDES,
        _curves(curve([[0, -1], [1]], U, STILL), curve([[0, -1], [1]], U, MOVES), low=2, most=2),
        "rejected",
        TOGETHER,
    ),
    "the last slide on two curves": (
        SLIDES,
        _curves(curve(IS_U, STILL, MOVES), curve(IS_U, MOVES, MOVES), low=2, most=2),
        "rejected",
        TOGETHER,
    ),
    "two pairs of one loop": (
        PAIRS,
        _curves(
            curve(IS_U, MOVES, BACKWARDS, STILL, STILL), curve(IS_U, STILL, STILL, MOVES, BACKWARDS), low=1, most=2
        ),
        "rejected",
        TOGETHER,
    ),
    "a curve that leaves the loops": (BENNETT, _curves(curve(IS_U, *[MOVES] * 4)), "rejected", OPENED),
    "a curve on another branch": (
        BENNETT,
        _curves(curve([[0, -1], [1], [2]], *[BACK, U] * 2)),
        "rejected",
        OPENED,
    ),
    "a curve that closes to the second order": (
        BENNETT,
        _curves(curve(IS_U, *[[[[0, -1, 2]], [1]], MOVES] * 2)),
        "rejected",
        OPENED,
    ),
    "a curve that closes with another sign": (
        BENNETT,
        _curves(curve([[0, -1], [1], [1]], *[[[[0, -2], [-1]], [1, 4]], U] * 2)),
        "rejected",
        OPENED,
    ),
    "a line that closes the first loop": (
        TWO_LOOPS,
        _curves(curve(IS_U, *[STILL] * 3, *([[[0, x]], [1]] for x in (2, -3, 1)))),
        "rejected",
        OPENED,
    ),
    "a relation that does not begin": (
        BENNETT,
        _curves(curve([[1, -1], [1], [1]], *[BACK, U] * 2)),
        "rejected",
        REGULARITY,
    ),
    "a relation with two branches": (
        BENNETT,
        _curves(curve([[0, 1], [0, 1], [1]], *RATIONAL)),
        "rejected",
        REGULARITY,
    ),
    "a curve from elsewhere": (OPEN, _curves(curve(IS_U, [[[1, 1]], [1]])), "rejected", BEGINS),
    "a curve to infinity": (OPEN, _curves(curve(IS_U, [[[0, 1]], [0, 1]])), "rejected", BEGINS),
    "a curve at rest": (OPEN, _curves(curve(IS_U, STILL), low=0), "rejected", AT_REST),
    "a curve that begins slowly": (
        BENNETT,
        _curves(curve(IS_U, *[[[[0, 0, -1]], [1, 0, 2]], [[[0, 0, 1]], [1]]] * 2), low=0),
        "rejected",
        AT_REST,
    ),
    "speeds that cancel": (OPEN, _curves(curve([[0, 1], [1]], [[[0, 1], [1]], [1]]), low=0), "rejected", AT_REST),
    "one curve twice": (BENNETT, _curves(PLAIN, PLAIN, most=1), "rejected", TOGETHER),
    "one curve in two ways": (BENNETT, _curves(PLAIN, HYPERBOLA, most=1), "rejected", TOGETHER),
    "one slide on two curves": (
        SLIDES,
        _curves(curve(IS_U, MOVES, STILL), curve(IS_U, MOVES, MOVES), low=2, most=2),
        "rejected",
        TOGETHER,
    ),
    "a curve more": (BENNETT, _curves(PLAIN, least=2), "rejected", LEAST),
    "a curve less": (BENNETT, _curves(PLAIN, least=0), "rejected", LEAST),
    "the platform moves less": (BENNETT, _curves(PLAIN, low=0), "rejected", LOW),
    "the platform moves more": (HANGING, _curves(*SWINGS, low=2, most=2), "rejected", LOW),
    "the platform on a parabola": (BENNETT, _curves(PARABOLA, low=2), "rejected", LOW),
    "a platform that may move more": (
        BENNETT,
        _curves(PLAIN) | {"platform_most": 2},
        "rejected",
        HIGH,
    ),
    "the rank is one": (BENNETT, _curves(PLAIN, most=2), "rejected", MOST),
    "a half too few": (BENNETT, _curves(curve(IS_U, *RATIONAL[:3])), "malformed", CURVES + "not a pair for each"),
    "a half too many": (OPEN, _curves(curve(IS_U, MOVES, STILL)), "malformed", CURVES + "not a pair for each"),
    "a relation without u": (OPEN, _curves(curve([[0, 1]], MOVES)), "malformed", "finite.below.curves[1].relation"),
    "a relation with 0 last": (
        OPEN,
        _curves(curve([[0], [1], [0, 0]], MOVES)),
        "malformed",
        "finite.below.curves[1].relation: not a polynomial with u",
    ),
    "a relation of degree 12 in u": (
        OPEN,
        _curves(curve([[0], [1], *[[0]] * 10, [1]], MOVES)),
        "malformed",
        "finite.below.curves[1].relation: not 1 to 12 polynomials",
    ),
    "a relation of nothing": (OPEN, _curves(curve([[], [1]], MOVES)), "malformed", "finite.below.curves[1].relation"),
    "a numerator of nothing": (OPEN, _curves(curve(IS_U, [[], [1]])), "malformed", "finite.below.curves[1].halves"),
    "a denominator of nothing": (
        OPEN,
        _curves(curve(IS_U, [[[0, 1]], []])),
        "malformed",
        "finite.below.curves[1].halves",
    ),
    "a numerator of degree 12": (
        OPEN,
        _curves(curve(IS_U, [[[0, *[1] * 12]], [1]])),
        "malformed",
        "finite.below.curves[1].halves",
    ),
    "three parts of a half": (
        OPEN,
        _curves(curve(IS_U, [[[0, 1]], [1], [1]])),
        "malformed",
        "finite.below.curves[1].halves[1]: not a list of 2",
    ),
    "nothing of the ideal": (
        OPEN,
        ideal((1, 1), (1, 1), below=("regular",)),
        "malformed",
        WORD,
    ),
    "curves without curves": (OPEN, _curves(least=1), "malformed", BELOW),
    "curves and locked freedoms": (
        SLIDES,
        ideal((1, 2), (1, 2), below=("curves", ["a1"], [], [], [curve(IS_U, STILL, MOVES)])),
        "malformed",
        BELOW,
    ),
    "curves and vectors": (
        OPEN,
        ideal((1, 1), (1, 1), below=("curves", [], [], [[1], [1]], [curve(IS_U, MOVES)])),
        "malformed",
        BELOW,
    ),
    "curves and legs": (
        OPEN,
        ideal((1, 1), (1, 1), below=("curves", [], subgroups(("a", 0))["legs"], [], [curve(IS_U, MOVES)])),
        "malformed",
        BELOW,
    ),
    "subgroups without legs": (
        LEGS,
        ideal((1, 1), (1, 1), ("local", [[5, 1]], 2), ("subgroups", ["a2"], [])),
        "malformed",
        BELOW,
    ),
    "regular with curves": (
        OPEN,
        ideal((1, 1), (1, 1), ("local", [[1]], 2), ("regular", [], [], [], [curve(IS_U, MOVES)])),
        "malformed",
        BELOW,
    ),
    "both signs with freedoms locked": (
        FLAT,
        ideal((1, 1), (0, 1), ("local", [[0, 1]], 2), ("indefinite", ["j0"], [], SIGNS), [FIRST]),
        "malformed",
        BELOW,
    ),
    "both signs at one vector": (
        FLAT,
        ideal((1, 1), (0, 1), ("local", [[0, 1]], 2), ("indefinite", [], [], SIGNS[:1]), [FIRST]),
        "malformed",
        BELOW,
    ),
    **{
        f"the rank with parts of another argument, {k}": (
            OPEN,
            ideal((1, 1), (1, 1), above, ("curves", [], [], [], [curve(IS_U, MOVES)])),
            "malformed",
            PARTS,
        )
        for k, above in enumerate([("rank", [[1]], 0), ("rank", [], 2)])
    },
    "an argument above of its own": (
        OPEN,
        ideal((1, 1), (1, 1), ("words", [], 0), ("curves", [], [], [], [curve(IS_U, MOVES)])),
        "malformed",
        "finite.above.argument",
    ),
    "an argument below of its own": (
        TRIANGLE,
        ideal((0, 0), (0, 0), ("local", [[1]], 2), ("words",)),
        "malformed",
        "finite.below.argument",
    ),
    "an order": (FIVE, ideal((0, 0), (0, 0), ("order", [], 3)), "malformed", "finite.above.argument"),
    "a curve of version 2": (
        OPEN,
        ideal((1, 1), (1, 1), below=("curve", [], [], [], [])),
        "malformed",
        "finite.below.argument",
    ),
    "an argument of version 2": (
        FIVE,
        _local([[1]], 3) | {"argument": "second-order"},
        "malformed",
        "finite.argument",
    ),
    "bounds without their reason": (TIGHT, ideal((0, 0), (0, 0)), "malformed", WORD),
    "nothing in version 3": (OPEN, None, "malformed", "finite: not an object"),
}
_TRUE = {f"ideal: {name}": (third(*pair), "accepted", "finite: mobility") for name, pair in TRUE.items()}
_FALSE = {
    f"ideal: {name}": (third(content, entry), status, line) for name, (content, entry, status, line) in FALSE.items()
}
_ONE: dict[str, Row] = {
    "ideal: version 3 in version 2": (put(_TRUE["ideal: a hinge"][0], 2, "version"), "malformed", "finite"),
    "ideal: version 4": (put(_TRUE["ideal: a hinge"][0], 4, "version"), "malformed", "format: not a"),
}
ROWS: dict[str, Row] = merged(_TRUE, _FALSE, _ONE)

"""Mobility certificates of version 2, honest ones and forgeries made by hand: bounds of the finite mobility."""

from __future__ import annotations

from typing import Any

from forged_mobility import Row, legs
from handmade_mobility import REGULAR, Content, O, X, Y, Z, certificate, joint, subgroups, texts
from tables_of_rows import merged, put


def hinges(*places: int, axes: Any = (Z,), arm: bool = False) -> list[Content]:
    """A loop of joints in a line; an arm turns on the body between the first two of them, else that is the top."""
    count = len(places)
    bodies = ["base", "x" if arm else "top", *(f"b{k}" for k in range(2, count))]
    kind = "R" if len(axes) == 1 else "U"
    found = [joint(f"j{k}", kind, bodies[k], bodies[(k + 1) % count], (x, 0, 0), axes) for k, x in enumerate(places)]
    return [*found, joint("arm", "R", "x", "top", (1, 1, 0), [X])] if arm else found


FIRST = ["0", "0", "0", "-1", "0", "0"]
"""The equation of the line's direction: stretched joints leave it without terms of first order."""
LESS = ["0", "0", "0", "1", "0", "0"]
ROLL = ["1", "0", "0", "0", "0", "0"]
"""The equation of turning about the line."""
OTHER = ["0", "0", "1", "0", "0", "0"]
"""An equation that the hinges do not fulfil by themselves."""


def bounds(
    mobility: tuple[int, int],
    platform: tuple[int, int],
    known: Any = (),
    above: Any = ("rank", [], 0),
    below: Any = None,
) -> Content:
    """The entry; ``below`` by argument, locked freedoms, legs, vectors and curve."""
    names = ("argument", "least", "most", "platform_least", "platform_most", "dependencies", "above", "below")
    why = dict(zip(("argument", "section", "degree"), (above[0], texts(above[1]), above[2]), strict=True))
    why["series"] = texts(above[3]) if len(above) > 3 else []
    how = None
    if below is not None:
        argument, locked, legs, vectors, curve = (*below, *[[]] * 4)[:5]
        how = {"argument": argument, "locked": locked, "legs": legs, "vectors": texts(vectors), "curve": texts(curve)}
    higher = above[0] == "order" or (below or ("",))[0] == "curve"
    word = "higher-order" if higher else "second-order"
    return dict(zip(names, (word, *mobility, *platform, list(known), why, how), strict=True))


def second(content: Content, entry: Any) -> Content:
    return content | {"version": 2, "finite": entry}


DEFINITE = ("definite", [], 0)
TRIANGLE = certificate(hinges(0, 1, 3), [], [])
STRETCHED = certificate(hinges(0, 1, 3, 6), [], [])
FLAT = certificate(hinges(0, 1, 4, 3), [], [])
LONG = certificate(hinges(0, 1, 2, 3, 4, 5, 6, 7), [], [])
ARM = certificate(hinges(0, 1, 3, arm=True), [], [])
RODS = certificate(hinges(0, 1, 3, axes=(Y, Z)), [], [])
OPEN = certificate([joint("a", "R", "base", "top", O, [Z])], [], [])
TIGHT = certificate([joint("a", "R", "base", "top", O, [Z]), joint("b", "R", "base", "top", (1, 0, 0), [Z])], [], [])
SEVEN = certificate(
    [*legs([(k, O, [a]) for k in "PR" for a in (X, Y, Z)]), joint("b", "R", "top", "aside", O, [Z])], [], []
)
"""Six freedoms of the platform, and one of a body aside."""
SLIDE, LINE = ("P", O, [Z]), [("R", (x, 0, 0), [Z]) for x in (0, 1, 3)]
LEGS = certificate(legs([SLIDE, *LINE[:2]], [SLIDE, LINE[2]]), [], [])
"""A stretched triangle that slides along its hinges."""
MANY = [*ROLL[:3], str((1 << 61) - 1), "0", "0"]
"""The sum of the equation of turning and that of the line, the latter a prime number of times."""

SIGNS = [[0, 1], [2, -3]]


def ring(points: Any, axes: Any) -> list[Content]:
    """A loop of hinges; the body behind the first one is the top."""
    bodies = ["base", "top", *(f"b{k}" for k in range(2, len(points)))]
    ends = [*bodies, "base"]
    return [
        joint(f"j{k}", "R", ends[k], ends[k + 1], point, [axis])
        for k, (point, axis) in enumerate(zip(points, axes, strict=True))
    ]


FIVE_POINTS = [(0, 1, -1), (0, -1, 0), (0, 1, 1), (-1, 0, 1), (0, 1, 0)]
FIVE = certificate(ring(FIVE_POINTS, [(1, 0, 1), (1, 1, 0), (1, 0, 1), (1, 0, 0), (1, -1, 0)]), [], [])
"""Five hinges with one freedom to the first and second order, and none in the third."""
TERMS = [[-1, 1, 1, -2, 1], [-1, 2, 1, -4, 0]]
FOLLOWS = ["0", "0", "-1", "1", "0", "0"]
SQUARE = [(1, 0, 0), (0, 1, 1), (-1, 0, 0), (0, -1, 1)]
BENNETT = certificate(ring(SQUARE, [(-2, 0, -2), (0, 2, -2), (2, 0, -2), (0, -2, -2)]), [], [])
TURN = [[[0, -1], [1, 2]], [[0, 1], [1]]] * 2
SQUARED = [[[0, 0, -1], [1, 0, 2]], [[0, 0, 1], [1]]] * 2
FIXED = [
    joint(f"r{k}", "R", a, b, point, [Z])
    for k, (a, b, point) in enumerate([("base", "p", (0, 5, 0)), ("p", "q", (1, 6, 0)), ("q", "base", (3, 5, 0))])
]
TWO_LOOPS = certificate([*FIXED, *hinges(0, 1, 3)], [], [])
"""A triangle of hinges that holds itself, before a stretched one."""
SCREWS = certificate(
    [joint(f"s{k}", "H", *("base", "top")[:: 1 - 2 * k], O, [Z], pitch="1/3") for k in range(2)], [], []
)


def held(axis: Any, before: Any = (), behind: Any = ()) -> Content:
    """A body between a hinge and a slide along one axis, which hold it, and loops before and behind."""
    pair = [joint("h", "R", "base", "held", O, [axis]), joint("g", "P", "held", "base", O, [axis])]
    return certificate([*before, *pair, *behind], [], [])


LINE_OF_THREE = [2, -3, 1]
HELD = {axis: held(axis, behind=hinges(0, 1, 3)) for axis in (X, Y, Z)}
HELD_LAST = {axis: held(axis, before=hinges(0, 1, 3)) for axis in (X, Z)}
TWICE = certificate(
    [
        *(joint(f"h{k}", "R", "base", f"held {k}", O, [X]) for k in range(2)),
        *(joint(f"g{k}", "P", f"held {k}", "base", O, [X]) for k in range(2)),
        *hinges(0, 1, 3),
    ],
    [],
    [],
)
TURNED_SCREWS = certificate(
    [joint(f"s{k}", "H", *("base", "top")[:: 1 - 2 * k], O, [Z], pitch="-1/3") for k in range(2)], [], []
)
SLIDES = certificate(legs([("P", O, [X]), ("P", O, [Y])]), [], [])
LONG_LOOP = certificate(ring([(k, k * k, 0) for k in range(60)], [Z] * 60), [], [])
HUGE = 10**599 + 7


def _along(kind: str, axis: Any, curve: Any) -> tuple[Content, Content]:
    return certificate([joint("a", kind, "base", "top", O, [axis])], [], []), bounds(
        (1, 1), (1, 1), below=("curve", [], [], [], curve)
    )


SLIDING = [
    certificate(
        [
            joint("g", "P", "base", "top", O, [(side, 0, 0)]),
            joint("j0", "R", "top", "b", O, [Z]),
            joint("j1", "R", "b", "base", (0, 1, 0), [Z]),
        ],
        [],
        [],
    )
    for side in (1, -1)
]
"""Two hinges and a slide across their line: speeds whose sum is not 0."""
ACROSS = ["0", "0", "0", "0", "-1", "0"]
FOLDED = certificate(hinges(0, 1, 4, 3, axes=(Y, Z)), [], [])
"""Four universal joints, folded back: forms in four motions."""
SHARED = [[1, 0, -1, 1], [-1, 0, 1, 1]]
"""On the motions z1, z2 of these, the forms are multiples of (z1 + z2)^2 and of z1^2 - z2^2."""


TRUE: dict[str, tuple[Content, Content]] = {
    "a stretched triangle": (TRIANGLE, bounds((0, 0), (0, 0), [FIRST], DEFINITE)),
    "a stretched triangle, its cone": (TRIANGLE, bounds((0, 0), (0, 0), [FIRST], ("cone", [[1]], 2))),
    "a stretched triangle, its cone in degree 12": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [LESS], ("cone", [[-3]], 12)),
    ),
    "a stretched triangle, its rank": (TRIANGLE, bounds((0, 1), (0, 1))),
    "a stretched triangle, its rank and a dependency": (TRIANGLE, bounds((0, 1), (0, 1), [FIRST, ROLL])),
    "four in a line": (STRETCHED, bounds((0, 0), (0, 0), [FIRST, ROLL], DEFINITE)),
    "a flat parallelogram": (
        FLAT,
        bounds((1, 1), (0, 1), [FIRST], ("cone", [[0, 1]], 2), ("indefinite", [], [], SIGNS)),
    ),
    "a flat parallelogram, from above": (FLAT, bounds((0, 1), (0, 1), [ROLL, FIRST], ("cone", [[0, 1]], 2))),
    "a flat parallelogram, from below": (FLAT, bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], SIGNS))),
    "an arm on a stretched triangle": (
        ARM,
        bounds((1, 1), (1, 1), [FIRST], ("cone", [[1, 5]], 2), ("regular", ["j0", "j1"])),
    ),
    "an arm, nothing below": (ARM, bounds((0, 1), (0, 1), [FIRST], ("cone", [[1, 0]], 2))),
    "rods in a line": (RODS, bounds((0, 0), (0, 0), [FIRST, ROLL], ("cone", [[1, 0], [0, 1]], 3))),
    "rods in a line, definite": (RODS, bounds((0, 0), (0, 0), [FIRST], DEFINITE)),
    "rods in a line, modulo a prime": (
        RODS,
        bounds((0, 0), (0, 0), [ROLL, MANY], ("cone", [[1, 0], [0, 1]], 3)),
    ),
    "a hinge": (OPEN, bounds((1, 1), (1, 1), below=("regular",))),
    "a hinge, its leg": (OPEN, bounds((1, 1), (1, 1), below=("subgroups", [], subgroups(("a", 0))["legs"]))),
    "a hinge that is held": (OPEN, bounds((0, 1), (0, 1), below=("regular", ["a"]))),
    "a hinge without equations": (OPEN, bounds((1, 1), (1, 1), [[]], below=("regular",))),
    "five hinges in the third order": (FIVE, bounds((0, 0), (0, 0), [FOLLOWS], ("order", [], 3, TERMS))),
    "five hinges, twice as fast": (
        FIVE,
        bounds((0, 0), (0, 0), [FOLLOWS], ("order", [], 3, [[2 * x for x in TERMS[0]], [4 * x for x in TERMS[1]]])),
    ),
    "five hinges, later": (
        FIVE,
        bounds(
            (0, 0),
            (0, 0),
            [FOLLOWS],
            ("order", [], 3, [TERMS[0], [x + 5 * y for x, y in zip(TERMS[1], TERMS[0], strict=True)]]),
        ),
    ),
    "a stretched triangle in the second order": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], ("order", [], 2, [[2, -3, 1]])),
    ),
    "a stretched triangle behind another": (
        TWO_LOOPS,
        bounds((0, 0), (0, 0), [["0"] * 6 + FIRST], ("order", [], 2, [[0, 0, 0, 2, -3, 1]])),
    ),
    "Bennett's linkage": (BENNETT, bounds((1, 1), (1, 1), below=("curve", [], [], [], TURN))),
    "Bennett's linkage, slowly": (BENNETT, bounds((1, 1), (0, 1), below=("curve", [], [], [], SQUARED))),
    "Bennett's linkage, fractions not reduced": (
        BENNETT,
        bounds((1, 1), (1, 1), below=("curve", [], [], [], [[[0, -1, 1], [1, 1, -2]], *TURN[1:]])),
    ),
    "a hinge along a curve": (OPEN, bounds((1, 1), (1, 1), below=("curve", [], [], [], [[[0, 1, 7], [3]]]))),
    "a stretched triangle, the other way": (TRIANGLE, bounds((0, 0), (0, 0), [LESS], ("order", [], 2, [[2, -3, 1]]))),
    "a stretched triangle, slowly": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], ("order", [], 4, [[0] * 3, LINE_OF_THREE, [0] * 3])),
    ),
    "three loops": (TWICE, bounds((0, 0), (0, 0), [["0"] * 12 + FIRST], DEFINITE)),
    "a body held, and a triangle": (
        HELD[X],
        bounds((0, 0), (0, 0), [["0"] * 6 + FIRST], ("order", [], 2, [[0, 0, *LINE_OF_THREE]])),
    ),
    "Bennett's linkage, denominators below 0": (
        BENNETT,
        bounds((1, 1), (1, 1), below=("curve", [], [], [], [[[0, 1], [-1, -2]], [[0, -1], [-1]]] * 2)),
    ),
    "a slide at rest and one that moves": (
        SLIDES,
        bounds((1, 2), (1, 2), below=("curve", [], [], [], [[[0], [1]], [[0, 1], [1]]])),
    ),
    "a turn about the first axis": _along("R", X, [[[0, 1], [1]]]),
    "a slide along the last axis": _along("P", Z, [[[0, 1], [1]]]),
    "a slide back": _along("P", Y, [[[0, -1], [1]]]),
    "rods in a line, cut obliquely": (RODS, bounds((0, 0), (0, 0), [FIRST, ROLL], ("cone", [[1, 1], [0, 1]], 3))),
    "a stretched triangle, a small form": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [["0", "0", "0", "-1/100", "0", "0"]], DEFINITE),
    ),
    "a flat parallelogram, small values": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [["0", "1/10"], ["1/5", "-3/10"]])),
    ),
    "a slide across two hinges": (SLIDING[0], bounds((0, 0), (0, 0), [ACROSS], DEFINITE)),
    "a slide across two hinges, the other way": (SLIDING[1], bounds((0, 0), (0, 0), [ACROSS], DEFINITE)),
    "hinges that cannot move": (TIGHT, bounds((0, 0), (0, 0), [ROLL])),
    "hinges that cannot move, without a dependency": (TIGHT, bounds((0, 0), (0, 0), below=None)),
    "a triangle, regular when it is held": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], DEFINITE, ("regular", ["j0", "j1"])),
    ),
    "seven motions, six of the platform": (SEVEN, bounds((0, 7), (0, 6))),
    "a chain of eight": (LONG, bounds((0, 0), (0, 0), [FIRST], DEFINITE)),
    "legs of an arm": (
        LEGS,
        bounds(
            (1, 1),
            (1, 1),
            [FIRST],
            ("cone", [[5, 1]], 2),
            ("subgroups", ["a2"], subgroups(("a1 a2 a3", 0), ("b1 b2", 0))["legs"]),
        ),
    ),
}
ABOVE, BELOW, MOST, LEAST = "finite.above: ", "finite.below: ", "finite.most: not the number", "finite.least: not the"
LOW, HIGH, KNOWN = "finite.platform_least: not", "finite.platform_most: not", "finite.dependencies: "
SECTION = ABOVE + "the section of the cone may be more"
GROUPS = subgroups(("a", 0))["legs"]
ORDER, CURVE, WORD = "finite.above.series: ", "finite.below.curve: ", "finite.argument: not that of its parts"
SOLUTION = ABOVE + "the order may have a solution"


def _order(known: Any, k: int, terms: Any, most: int = 0) -> Content:
    return bounds((0, most), (0, most), known, ("order", [], k, terms))


def _curve(curve: Any, low: int = 1, least: int = 1) -> Content:
    return bounds((least, 1), (low, 1), below=("curve", [], [], [], curve))


HIGHER: dict[str, tuple[Content, Content, str, str]] = {
    "two motions in the second order": (
        FLAT,
        _order([FIRST], 2, [[1, 0, -4, 3]]),
        "rejected",
        ABOVE + "the mobility is not 1",
    ),
    "no motion in the second order": (TIGHT, _order([ROLL], 2, [[0, 0]]), "rejected", ABOVE + "the mobility is not 1"),
    "the third order leaves one": (FIVE, _order([FOLLOWS], 3, TERMS, 1), "rejected", MOST),
    "a short term": (FIVE, _order([FOLLOWS], 3, [TERMS[0], TERMS[1][:4]]), "malformed", ORDER + "not a number"),
    "a long term": (FIVE, _order([FOLLOWS], 3, [[*TERMS[0], 0], TERMS[1]]), "malformed", ORDER + "not a number"),
    "terms that begin with 0": (FIVE, _order([FOLLOWS], 3, [[0] * 5, TERMS[0]]), "rejected", SOLUTION),
    "terms of nothing": (FIVE, _order([FOLLOWS], 3, [[0] * 5, [0] * 5]), "rejected", SOLUTION),
    "two motions, in one of which it is rigid": (
        FLAT,
        _order([FIRST], 2, [[2, -3, 0, 1]]),
        "rejected",
        ABOVE + "the mobility is not 1",
    ),
    **{
        f"a {kind} of what is held along {axis}, {step}": (
            HELD[axis],
            _order(
                [["0"] * 6 + FIRST], 2, [[*(step * (kind == known) for known in ("turn", "slide")), *LINE_OF_THREE]]
            ),
            "rejected",
            ORDER + "does not close",
        )
        for axis in HELD
        for kind in ("turn", "slide")
        for step in (1, -1)
    },
    **{
        f"the last body turns about {axis} or slides, {slide}": (
            HELD_LAST[axis],
            _order([FIRST + ["0"] * 6], 2, [[*LINE_OF_THREE, 1 - slide, slide]]),
            "rejected",
            ORDER + "does not close",
        )
        for axis in HELD_LAST
        for slide in (0, 1)
    },
    "an equation of some of the freedoms": (
        HELD[X],
        _order([["1"] + ["0"] * 5 + FIRST], 2, [[0, 0, *LINE_OF_THREE]]),
        "rejected",
        KNOWN + "not one of",
    ),
    "a curve that begins later": (
        BENNETT,
        _curve([[[-1, -1], [3, 2]], [[1, 1], [1]]] * 2),
        "rejected",
        CURVE + "does not begin",
    ),
    **{
        f"a slide that begins elsewhere, {k}": (
            SLIDES,
            bounds((1, 2), (1, 2), below=("curve", [], [], [], pairs)),
            "rejected",
            CURVE + "does not begin",
        )
        for k, pairs in enumerate(
            [
                [[[1], [1]], [[0, 1], [1]]],
                [[[0, 1], [1]], [[1], [1]]],
                [[[-1], [1]], [[0, 1], [1]]],
                [[[0, 1], [1]], [[0, 1], [0, 1]]],
                [[[0, 1], [0, 1]], [[0, 1], [1]]],
            ]
        )
    },
    "a curve that turns what is held": (
        held(X, behind=[joint("a", "P", "base", "top", O, [X])]),
        _curve([[[0, 1], [1]], [[0], [1]], [[0, 1], [1]]]),
        "rejected",
        CURVE + "does not close",
    ),
    "a curve that slides what is held": (
        held(Z, before=[joint("a", "P", "base", "top", O, [X])]),
        _curve([[[0, 1], [1]], [[0], [1]], [[0, 1], [1]]]),
        "rejected",
        CURVE + "does not close",
    ),
    "a curve of screws that close": (SCREWS, _curve([[[0, 1], [1]], [[0, -1], [1]]]), "rejected", "finite: a screw"),
    "a curve of other screws": (TURNED_SCREWS, _curve([[[0, 1], [1]], [[0, -1], [1]]]), "rejected", "finite: a screw"),
    "a long loop of long numbers": (
        LONG_LOOP,
        bounds((1, 57), (1, 6), below=("curve", [], [], [], [[[0, HUGE, HUGE], [1, HUGE]]] * 60)),
        "too-large",
        "work: ",
    ),
    "a first term that is none": (
        FIVE,
        _order([FOLLOWS], 3, [[1, *TERMS[0][1:]], TERMS[1]]),
        "rejected",
        ORDER + "does not close",
    ),
    "a second term that is none": (
        FIVE,
        _order([FOLLOWS], 3, [TERMS[0], [0] * 5]),
        "rejected",
        ORDER + "does not close",
    ),
    "an order too late": (FIVE, _order([FOLLOWS], 4, [*TERMS, [0] * 5]), "rejected", ORDER + "does not close"),
    "an order too early": (FIVE, _order([FOLLOWS], 2, TERMS[:1]), "rejected", SOLUTION),
    "an order of what moves": (BENNETT, _order([], 2, [[-1, 1, -1, 1]]), "rejected", SOLUTION),
    "an order without a dependency": (FIVE, _order([], 3, TERMS), "rejected", SOLUTION),
    "an order with another dependency": (TRIANGLE, _order([ROLL, FIRST], 2, [[2, -3, 1]]), "rejected", SOLUTION),
    "the other loop's equation": (
        TWO_LOOPS,
        _order([[*ROLL, *["0"] * 6]], 2, [[0, 0, 0, 2, -3, 1]]),
        "rejected",
        SOLUTION,
    ),
    "screws in the second order": (SCREWS, _order([ROLL], 2, [[1, 1]]), "rejected", "finite: a screw of a loop"),
    "fewer terms than orders": (FIVE, _order([FOLLOWS], 4, TERMS), "malformed", ABOVE + "not the parts"),
    "more terms than orders": (FIVE, _order([FOLLOWS], 2, TERMS), "malformed", ABOVE + "not the parts"),
    "an order of 1": (FIVE, _order([FOLLOWS], 1, []), "malformed", ABOVE + "not the parts"),
    "an order of 13": (FIVE, _order([FOLLOWS], 13, TERMS[:1] * 12), "malformed", ABOVE + "not the parts"),
    "an order with a section": (
        FIVE,
        bounds((0, 0), (0, 0), [FOLLOWS], ("order", [[1]], 3, TERMS)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a rank with terms": (
        FIVE,
        bounds((0, 1), (0, 1), [], ("rank", [], 0, TERMS)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "definite with terms": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], ("definite", [], 0, [[2, -3, 1]])),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a curve of three": (BENNETT, _curve(TURN[:3]), "malformed", CURVE + "not a pair for each"),
    "a curve of five": (BENNETT, _curve([*TURN, TURN[0]]), "malformed", CURVE + "not a pair for each"),
    "a curve from elsewhere": (BENNETT, _curve([[[1, -1], [1, 2]], *TURN[1:]]), "rejected", CURVE + "does not begin"),
    "a curve to elsewhere": (BENNETT, _curve([*TURN[:3], [[1, 1], [1]]]), "rejected", CURVE + "does not begin"),
    "a curve from infinity": (BENNETT, _curve([[[0, -1], [0, 2]], *TURN[1:]]), "rejected", CURVE + "does not begin"),
    "a curve at rest": (BENNETT, _curve([[[0], [1]]] * 4, 0), "rejected", CURVE + "does not move"),
    "a curve at rest, written long": (BENNETT, _curve([[[0, 0], [1, 2]]] * 4, 0), "rejected", CURVE + "does not move"),
    "a curve of the first order": (
        BENNETT,
        _curve([[[0, -1], [1]], [[0, 1], [1]]] * 2),
        "rejected",
        CURVE + "does not close",
    ),
    "a curve of one hinge": (BENNETT, _curve([*[[[0], [1]]] * 3, [[0, 1], [1]]]), "rejected", CURVE + "does not close"),
    "a curve turned round": (BENNETT, _curve([[[0, 1], [1, 2]], *TURN[1:]]), "rejected", CURVE + "does not close"),
    "a curve of a triangle": (
        TRIANGLE,
        _curve([[[0, 2], [1]], [[0, -3], [1]], [[0, 1], [1]]]),
        "rejected",
        CURVE + "does not close",
    ),
    "a curve of the last loop only": (
        certificate(
            [*hinges(0, 1, 3), joint("l", "R", "base", "aside", O, [Z]), joint("m", "R", "aside", "base", O, [Z])],
            [],
            [],
        ),
        bounds(
            (1, 2),
            (1, 2),
            below=("curve", [], [], [], [*[[[0, x], [1]] for x in (2, -3, 1)], [[0, 1], [1]], [[0, -1], [1]]]),
        ),
        "rejected",
        CURVE + "does not close",
    ),
    "a curve of screws": (SCREWS, _curve([[[0, 1], [1]]] * 2), "rejected", "finite: a screw of a loop"),
    "two motions along a curve": (BENNETT, _curve(TURN, 1, 2), "rejected", LEAST),
    "a platform at rest along a curve": (BENNETT, _curve(TURN, 0), "rejected", LOW),
    "a platform that moves though slowly": (BENNETT, _curve(SQUARED, 1), "rejected", LOW),
    "a curve of 13 coefficients": (OPEN, _curve([[[0, *[1] * 12], [1]]]), "malformed", "finite.below.curve[1]"),
    "a curve of 12 coefficients": (OPEN, _curve([[[0, *[1] * 11], [1] * 12]]), "accepted", "finite: mobility"),
    "a curve of no coefficient": (OPEN, _curve([[[], [1]]]), "malformed", "finite.below.curve[1]"),
    "a curve of no denominator": (OPEN, _curve([[[0, 1], []]]), "malformed", "finite.below.curve[1]"),
    "a curve of single lists": (OPEN, _curve([[[0, 1]]]), "malformed", "finite.below.curve[1]"),
    "no curve": (OPEN, _curve([]), "malformed", BELOW + "not the parts"),
    "a curve with a freedom held": (
        BENNETT,
        bounds((1, 1), (1, 1), below=("curve", ["j0"], [], [], TURN)),
        "malformed",
        BELOW + "not the parts",
    ),
    "a curve with legs": (
        OPEN,
        bounds((1, 1), (1, 1), below=("curve", [], GROUPS, [], [[[0, 1], [1]]])),
        "malformed",
        BELOW + "not the parts",
    ),
    "a curve with vectors": (
        OPEN,
        bounds((1, 1), (1, 1), below=("curve", [], [], [[1], [1]], [[[0, 1], [1]]])),
        "malformed",
        BELOW + "not the",
    ),
    "regular with a curve": (
        OPEN,
        bounds((1, 1), (1, 1), below=("regular", [], [], [], [[[0, 1], [1]]])),
        "malformed",
        BELOW + "not the parts",
    ),
    "a curve of second order": (BENNETT, _curve(TURN) | {"argument": "second-order"}, "malformed", WORD),
    "an order of second order": (FIVE, _order([FOLLOWS], 3, TERMS) | {"argument": "second-order"}, "malformed", WORD),
    "a definite form of higher order": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], DEFINITE) | {"argument": "higher-order"},
        "malformed",
        WORD,
    ),
}
FALSE: dict[str, tuple[Content, Content, str, str]] = {
    "an equation that is none": (TRIANGLE, bounds((0, 0), (0, 0), [OTHER], DEFINITE), "rejected", KNOWN + "not one of"),
    "a second equation that is none": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST, OTHER], DEFINITE),
        "rejected",
        KNOWN + "not one of",
    ),
    "five numbers for six equations": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST[:5]], DEFINITE),
        "malformed",
        KNOWN + "not a number",
    ),
    "seven numbers for six equations": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST, [*FIRST, "0"]], DEFINITE),
        "malformed",
        KNOWN + "not a number",
    ),
    "a number for no equation": (
        OPEN,
        bounds((1, 1), (1, 1), [["1"]], below=("regular",)),
        "malformed",
        KNOWN + "not a",
    ),
    "the rank, one less": (TRIANGLE, bounds((0, 0), (0, 0)), "rejected", MOST),
    "the rank, one more": (TRIANGLE, bounds((0, 2), (0, 2)), "rejected", MOST),
    "definite, one more": (TRIANGLE, bounds((0, 1), (0, 1), [FIRST], DEFINITE), "rejected", MOST),
    "the cone, one less": (FLAT, bounds((0, 0), (0, 0), [FIRST], ("cone", [[0, 1]], 2)), "rejected", MOST),
    "the cone, one more": (FLAT, bounds((0, 2), (0, 2), [FIRST], ("cone", [[0, 1]], 2)), "rejected", MOST),
    "definite without a form": (TRIANGLE, bounds((0, 0), (0, 0), [], DEFINITE), "rejected", ABOVE + "the form"),
    "a negative form": (TRIANGLE, bounds((0, 0), (0, 0), [LESS], DEFINITE), "rejected", ABOVE + "the form"),
    "a form that is 0": (TRIANGLE, bounds((0, 0), (0, 0), [ROLL], DEFINITE), "rejected", ABOVE + "the form"),
    "two negative squares": (STRETCHED, bounds((0, 0), (0, 0), [LESS], DEFINITE), "rejected", ABOVE + "the form"),
    "a form of both signs": (FLAT, bounds((0, 0), (0, 0), [FIRST], DEFINITE), "rejected", ABOVE + "the form"),
    "a form that is 0 somewhere": (ARM, bounds((0, 0), (0, 0), [FIRST], DEFINITE), "rejected", ABOVE + "the form"),
    "a form of an edge": (RODS, bounds((0, 0), (0, 0), [ROLL], DEFINITE), "rejected", ABOVE + "the form"),
    "only the second form is positive": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [ROLL, FIRST], DEFINITE),
        "rejected",
        ABOVE + "the form",
    ),
    "a section in the cone": (FLAT, bounds((0, 1), (0, 1), [FIRST], ("cone", [[1, -1]], 2)), "rejected", SECTION),
    "another section in the cone": (FLAT, bounds((0, 1), (0, 1), [FIRST], ("cone", [[1, -2]], 9)), "rejected", SECTION),
    "a section of nothing": (FLAT, bounds((0, 1), (0, 1), [FIRST], ("cone", [[0, 0]], 2)), "rejected", SECTION),
    "a section twice": (
        RODS,
        bounds((0, 0), (0, 0), [FIRST, ROLL], ("cone", [[1, 1], [1, 1]], 3)),
        "rejected",
        SECTION,
    ),
    "one form on two motions": (
        RODS,
        bounds((0, 0), (0, 0), [FIRST], ("cone", [[1, 0], [0, 1]], 5)),
        "rejected",
        SECTION,
    ),
    "one form twice": (
        RODS,
        bounds((0, 0), (0, 0), [FIRST, LESS], ("cone", [[1, 0], [0, 1]], 3)),
        "rejected",
        SECTION,
    ),
    "a degree too low": (
        RODS,
        bounds((0, 0), (0, 0), [FIRST, ROLL], ("cone", [[1, 0], [0, 1]], 2)),
        "rejected",
        SECTION,
    ),
    "a cone without a form": (FLAT, bounds((0, 1), (0, 1), [], ("cone", [[0, 1]], 2)), "rejected", SECTION),
    "a section of three numbers": (
        FLAT,
        bounds((0, 1), (0, 1), [FIRST], ("cone", [[0, 1, 0]], 2)),
        "malformed",
        "finite.above.section: not a number",
    ),
    "a section of one number": (
        RODS,
        bounds((0, 0), (0, 0), [FIRST, ROLL], ("cone", [[1, 0], [1]], 3)),
        "malformed",
        "finite.above.section: not a number",
    ),
    "too many monomials": (
        LONG,
        bounds((1, 1), (0, 1), [FIRST], ("cone", [[int(i == j) for j in range(6)] for i in range(5)], 10)),
        "too-large",
        ABOVE + "more than 500",
    ),
    "a degree of 1": (
        FLAT,
        bounds((0, 1), (0, 1), [FIRST], ("cone", [[0, 1]], 1)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a degree of 13": (
        FLAT,
        bounds((0, 1), (0, 1), [FIRST], ("cone", [[0, 1]], 13)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a cone without a section": (
        FLAT,
        bounds((0, 2), (0, 2), [FIRST], ("cone", [], 2)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a rank with a section": (
        FLAT,
        bounds((0, 2), (0, 2), [FIRST], ("rank", [[0, 1]], 0)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a rank with a degree": (
        FLAT,
        bounds((0, 2), (0, 2), [FIRST], ("rank", [], 2)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "definite with a degree": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], ("definite", [], 2)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "definite with a section": (
        TRIANGLE,
        bounds((0, 0), (0, 0), [FIRST], ("definite", [[1]], 0)),
        "malformed",
        ABOVE + "not the parts",
    ),
    "a false degree": (TRIANGLE, bounds((0, 1), (0, 1), [], ("rank", [], False)), "malformed", "finite.above.degree"),
    "an argument above of its own": (
        TRIANGLE,
        bounds((0, 1), (0, 1), [], ("words", [], 0)),
        "malformed",
        "finite.above",
    ),
    "a section where two forms share a zero": (
        FOLDED,
        bounds((0, 2), (0, 2), [FIRST, ROLL], ("cone", SHARED, 3)),
        "rejected",
        SECTION,
    ),
    "too many monomials of degree 2": (
        LONG_LOOP,
        bounds((0, 25), (0, 6), [ROLL], ("cone", [[int(i == j) for j in range(57)] for i in range(32)], 2)),
        "too-large",
        ABOVE + "more than 500",
    ),
    "both signs, the first of three numbers": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [[0, 1, 0], [2, -3]])),
        "malformed",
        "finite.below.vectors: not a number",
    ),
    "both signs, the first of one number": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [[1], [2, -3]])),
        "malformed",
        "finite.below.vectors: not a number",
    ),
    "both signs, the last of one number": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [[0, 1], [2]])),
        "malformed",
        "finite.below.vectors: not a number",
    ),
    "less than follows": (OPEN, bounds((0, 1), (1, 1), below=("regular",)), "rejected", LEAST),
    "less of the platform than follows": (OPEN, bounds((1, 1), (0, 1), below=("regular",)), "rejected", LOW),
    "something below from nothing": (TRIANGLE, bounds((1, 1), (0, 1)), "rejected", LEAST),
    "something of the platform from nothing": (TRIANGLE, bounds((0, 1), (1, 1)), "rejected", LOW),
    "more of the platform": (TRIANGLE, bounds((0, 1), (0, 2)), "rejected", HIGH),
    "less of the platform": (TRIANGLE, bounds((0, 1), (0, 0)), "rejected", HIGH),
    "seven motions of a platform": (
        SEVEN,
        bounds((0, 7), (0, 7)),
        "rejected",
        HIGH,
    ),
    "both signs, one more": (
        FLAT,
        bounds((2, 2), (0, 2), [FIRST], below=("indefinite", [], [], SIGNS)),
        "rejected",
        LEAST,
    ),
    "both signs of the platform": (
        FLAT,
        bounds((1, 2), (1, 2), [FIRST], below=("indefinite", [], [], SIGNS)),
        "rejected",
        LOW,
    ),
    "both signs the other way round": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], SIGNS[::-1])),
        "rejected",
        BELOW + "the form",
    ),
    "both signs, none positive": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [[1, -1], [2, -3]])),
        "rejected",
        BELOW + "the form",
    ),
    "both signs, none negative": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [[0, 1], [1, -2]])),
        "rejected",
        BELOW + "the form",
    ),
    "both signs without a form": (
        FLAT,
        bounds((1, 2), (0, 2), [], below=("indefinite", [], [], SIGNS)),
        "rejected",
        BELOW + "the form",
    ),
    "both signs of the second form": (
        FLAT,
        bounds((1, 2), (0, 2), [ROLL, FIRST], below=("indefinite", [], [], SIGNS)),
        "rejected",
        BELOW + "the form",
    ),
    "both signs, three numbers": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [[0, 1], [2, -3, 0]])),
        "malformed",
        "finite.below.vectors: not a number",
    ),
    "both signs, where more is asked": (
        RODS,
        bounds((1, 2), (0, 2), [ROLL], below=("indefinite", [], [], [[1, 1], [1, -1]])),
        "rejected",
        BELOW + "the loops do not ask",
    ),
    "a regular loop that is not": (
        TRIANGLE,
        bounds((1, 1), (0, 1), below=("regular",)),
        "rejected",
        BELOW + "the loops",
    ),
    "a regular loop that is not, one held": (
        ARM,
        bounds((1, 2), (1, 2), [FIRST], below=("regular", ["j0"])),
        "rejected",
        BELOW + "the loops",
    ),
    "an arm that is held": (
        ARM,
        bounds((1, 2), (1, 2), [FIRST], below=("regular", ["j0", "j1", "arm"])),
        "rejected",
        LEAST,
    ),
    "an arm, more below": (
        ARM,
        bounds((2, 2), (1, 2), [FIRST], below=("regular", ["j0", "j1"])),
        "rejected",
        LEAST,
    ),
    "an arm, the platform still": (
        ARM,
        bounds((1, 2), (0, 2), [FIRST], below=("regular", ["j0", "j1"])),
        "rejected",
        LOW,
    ),
    "an arm that is no leg": (
        ARM,
        bounds((1, 2), (1, 2), [FIRST], below=("subgroups", ["j0", "j1"], subgroups(("j0 arm", 0))["legs"])),
        "rejected",
        "finite: not every joint",
    ),
    "legs that do not fill": (
        LEGS,
        bounds((2, 2), (2, 2), [], below=("subgroups", [], subgroups(("a1 a2 a3", 0), ("b1 b2", 0))["legs"])),
        "rejected",
        "finite: ",
    ),
    "freedoms in another order": (
        ARM,
        bounds((1, 2), (1, 2), [FIRST], below=("regular", ["j1", "j0"])),
        "malformed",
        "finite.below.locked: not in the order",
    ),
    "a freedom that is none": (
        OPEN,
        bounds((0, 1), (0, 1), below=("regular", ["b"])),
        "malformed",
        "finite.below.locked",
    ),
    "both signs with a freedom held": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", ["j0"], [], SIGNS)),
        "malformed",
        BELOW + "not the parts",
    ),
    "both signs with legs": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], subgroups(("j0", 0))["legs"], SIGNS)),
        "malformed",
        BELOW + "not the parts",
    ),
    "both signs at one vector": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], SIGNS[:1])),
        "malformed",
        BELOW + "not the parts",
    ),
    "both signs at three vectors": (
        FLAT,
        bounds((1, 2), (0, 2), [FIRST], below=("indefinite", [], [], [*SIGNS, [0, 1]])),
        "malformed",
        BELOW + "not the parts",
    ),
    "regular with legs": (OPEN, bounds((1, 1), (1, 1), below=("regular", [], GROUPS)), "malformed", BELOW + "not the"),
    "regular with vectors": (
        OPEN,
        bounds((1, 1), (1, 1), below=("regular", [], [], [[1], [1]])),
        "malformed",
        BELOW + "not the",
    ),
    "subgroups without legs": (OPEN, bounds((1, 1), (1, 1), below=("subgroups",)), "malformed", BELOW + "not the"),
    "subgroups with vectors": (
        OPEN,
        bounds((1, 1), (1, 1), below=("subgroups", [], GROUPS, [[1], [1]])),
        "malformed",
        BELOW + "not the",
    ),
    "an argument below of its own": (
        OPEN,
        bounds((1, 1), (1, 1), below=("words",)),
        "malformed",
        "finite.below.argument",
    ),
    "a bound below 0": (OPEN, bounds((-1, 1), (1, 1)), "malformed", "finite.least"),
    "nothing in version 2": (OPEN, None, "malformed", "finite: not an object"),
    "version 1 in version 2": (OPEN, REGULAR, "malformed", "finite: not an object"),
    "another argument in version 2": (
        OPEN,
        bounds((1, 1), (1, 1), below=("regular",)) | {"argument": "regular"},
        "malformed",
        "finite.argument",
    ),
}
_TRUE = {f"second: {name}": (second(*pair), "accepted", "finite: mobility") for name, pair in TRUE.items()}
_FALSE = {
    f"second: {name}": (second(content, entry), status, line)
    for name, (content, entry, status, line) in merged(FALSE, HIGHER).items()
}
_ONE: dict[str, Row] = {
    "second: version 2 in version 1": (put(_TRUE["second: a hinge"][0], 1, "version"), "malformed", "finite: not an"),
    "second: version 3": (put(_TRUE["second: a hinge"][0], 3, "version"), "malformed", "finite"),
}
ROWS: dict[str, Row] = merged(_TRUE, _FALSE, _ONE)

"""Certificates that count cells: honest ones, and forged ones of which only one check sees what is wrong.

A cubic in one variable, two roots of which are listed, has as many cells as one likes if an obstruction may be false.
"""

from __future__ import annotations

from typing import Any

from handmade_systems import (
    BILINEAR,
    BILINEAR_CELLS,
    CELLS,
    CROSSINGS,
    CURVES,
    PAIR,
    Content,
    complete,
    handmade,
    listed,
    represented,
)

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and what the last line says."""

CUBIC = ("x^3-6*x^2+11*x-6",)
EVEN = ("x^2+y-5", "x^2*y-8*y+4")
"""Four solutions and four cells; the terms do not tell that solutions where x = 0 are regular."""
EVEN_CELLS = {
    "lifting": ["6 6 0", "4 7 6"],
    "obstructions": ["0 0 -1 0 2 1 1 0 1 1 1 -1", "0 0 -1 0 1 -1 0 2 2 1 0 1 1 2 -1", "0 1 -1 0 2 1 1 1 1 1 2 -1"],
}
CROSS = ("x*y-x-y+1", "x*y-2*x-y+2")
"""The line x = 1; two of its points are as many as the cells."""
CROSS_CELLS = {
    "lifting": ["3 4 1 6", "7 2 1 1"],
    "obstructions": [
        "0 0 1 0 1 -1 1 0 -1 1 1 1",
        "0 1 -1 0 2 1 1 1 1 1 2 -1",
        "0 0 -1 0 2 1 1 1 1 1 3 -1",
        "0 0 1 0 2 -1 1 0 -1 1 2 1",
        "0 0 -1 0 1 1 0 2 1 0 3 -1",
        "0 1 1 0 3 -1 1 1 -1 1 3 1",
        "0 2 1 0 3 -1 1 2 -1 1 3 1",
    ],
}
ALIKE = ("x*y-2*x-y+2", "x*y-5*x-3*y+15")
OPEN = ("x*y-x", "x*y+x+y-5")
OPEN_CELLS = (
    ["4397 12501 63860", "25840 47284 61682 52300"],
    [
        "0 0 -1 0 1 1 1 0 1 1 1 -1",
        "0 0 1 0 1 -1 1 2 -1 1 3 1",
        "0 0 1 0 2 -1 1 0 -1 1 3 1",
        "0 1 1 0 2 -1 1 1 -1 1 3 1",
    ],
)
MEETING = ("x^2-x*y", "x*y+x+y-3")
THROUGH = {
    "first": (
        ["50902 59622 33889", "64062 47551 15270 51398"],
        [
            "0 0 1 0 1 -1 1 1 -1 1 2 1",
            "0 0 1 0 1 -1 1 0 -1 1 2 2 1 3 -1",
            "0 0 1 0 1 -2 0 2 1 1 2 2 1 3 -2",
            "0 0 1 0 2 -1 1 0 -2 1 2 2",
            "0 0 -1 0 2 1 1 1 2 1 3 -2",
        ],
    ),
    "last": (
        ["5470 20124 59124 63209", "47126 47666 26754"],
        [
            "0 0 2 0 1 -2 1 0 1 1 1 -2 1 2 1",
            "0 0 2 0 2 -2 1 0 -1 1 2 1",
            "0 0 1 0 3 -1 1 1 -1 1 2 1",
            "0 1 2 0 3 -2 1 0 -1 1 2 1",
        ],
    ),
}
"""The first vanishes in the origin, where general polynomials with its terms are not regular; the other does not."""
MIDDLE = ["0 0 -1 0 1 2 0 2 -1", "0 1 -1 0 2 2 0 3 -1", "0 0 -2 0 1 3 0 3 -1"]
"""Of x^3, x^2, x and 1, if lifted convexly, only neighbours are lowest together."""
INNER = "0 0 1 0 1 -1 0 2 -1 0 3 1"
"""So it would be a concave lifting for which x^2 and x are not."""

TOGETHER = {"lifting": ["2 0 0 1", "0 0"], "obstructions": [MIDDLE[0], "0 3 -1 1 1 1"]}


FULL = ("3*x*y-4*x-4*y+6", "2*x*y-x-y-1")
"""Both have all four terms, so that coordinates may be 0 as far as one term alone tells."""
BARE = ("x*y-2", "2*x^2*y-2*x-y")
BARE_CELLS = {
    "lifting": ["6 6", "0 4 7 6"],
    "obstructions": ["0 0 -1 0 1 1 1 0 1 1 1 -1", "0 0 -2 0 1 2 1 0 1 1 2 1 1 3 -2"],
}
"""The second polynomial has no constant term."""
EVEN_IN_Y = ("x+y^2-5", "x*y^2-8*x+4")


def _cubic(roots: list[int], lifting: str, obstructions: list[str]) -> Content:
    cells = {"lifting": [lifting], "obstructions": obstructions}
    points = represented([(root,) for root in roots], (1,))
    return listed("x", CUBIC, points, **complete("mixed-volume", len(roots), subdivision=cells))


def _curves(
    points: Any,
    lifting: list[str],
    obstructions: list[str],
    texts: tuple[str, ...] = CURVES,
    form: tuple[int, int] = (1, 0),
) -> Content:
    cells = {"lifting": lifting, "obstructions": obstructions}
    found = represented(points, form)
    return listed("x,y", texts, found, **complete("mixed-volume", len(points), subdivision=cells))


def _many(number: int) -> Content:
    """One solution of x_1 x_2 = 1, x_i = 1."""
    names = [f"x{i}" for i in range(number)]
    texts = ("x0*x1-1", *(f"{name}-1" for name in names[1:]))
    cells = {"lifting": ["0 0"] * number, "obstructions": []}
    points = represented([(1,) * number], (1, *[0] * (number - 1)))
    return listed(",".join(names), texts, points, **complete("mixed-volume", 1, subdivision=cells))


def _part(name: str, key: str, value: Any) -> Content:
    content = handmade()[name]
    return content | {"subdivision": content["subdivision"] | {key: value}}


def _moved() -> Content:
    """The key at the end."""
    content = handmade()["cells"]
    return {key: value for key, value in content.items() if key != "subdivision"} | {"subdivision": CELLS}


def _without() -> Content:
    return {key: value for key, value in handmade()["cells"].items() if key != "subdivision"}


def _called_double() -> Content:
    """Two points of a line of solutions, called complete and double."""
    content = _curves([(1, 3), (1, 5)], CROSS_CELLS["lifting"], CROSS_CELLS["obstructions"], CROSS, (0, 1))
    return content | {"solutions": [solution | {"multiplicity": 2} for solution in content["solutions"]]}


def rows() -> dict[str, Row]:
    """All of them, by name."""
    honest = CELLS["obstructions"]
    bad = "subdivision: "
    return {
        "twelve variables": (_many(12), "accepted", "mixed volume"),
        "thirteen variables": (_many(13), "accepted", "mixed volume"),
        "a solution is missing": (_curves(CROSSINGS[:2], CELLS["lifting"], honest), "rejected", bad),
        "too many cells": (_curves(CROSSINGS, CELLS["lifting"], []), "rejected", bad),
        "weights do not sum to 0": (
            _cubic([1, 2], "2 0 0 1", [MIDDLE[0], "0 3 -1"]),
            "rejected",
            bad,
        ),
        "weights sum to 0 together": (
            listed(
                "x,y",
                (*CUBIC, "y-1"),
                represented([(1, 1), (2, 1)], (1, 0)),
                **complete("mixed-volume", 2, subdivision=TOGETHER),
            ),
            "rejected",
            bad,
        ),
        "vectors do not sum to 0": (
            _curves(CROSSINGS[:2], ["6 6", "0 4 0"], ["1 0 -1 1 1 -1 1 2 2", "1 0 2 1 1 -1 1 2 -1"]),
            "rejected",
            bad,
        ),
        "vectors sum to 0 but for the first variable": (
            _curves(CROSSINGS[:2], ["6 6", "0 4 0"], ["1 1 -1 1 2 1"]),
            "rejected",
            bad,
        ),
        "vectors sum to 0 but for the last variable": (
            _curves(CROSSINGS[:2], ["6 6", "0 4 0"], ["1 0 1 1 1 -1"]),
            "rejected",
            bad,
        ),
        "nothing is lowered": (_cubic([1, 2], "0 0 0 0", [*MIDDLE, INNER]), "rejected", bad),
        "one is raised": (_cubic([1, 2], "1 0 0 1", [*MIDDLE, INNER]), "rejected", bad),
        "a number too many": (_curves(CROSSINGS, ["6 6 5", "0 4 7"], honest), "rejected", bad),
        "a number is missing": (_curves(CROSSINGS, ["6 6", "0 4"], honest), "rejected", bad),
        "a point that there is not": (
            _curves(CROSSINGS, CELLS["lifting"], [*honest, "1 2 -1 1 3 1"]),
            "rejected",
            bad,
        ),
        "a polynomial that there is not": (
            _curves(CROSSINGS, CELLS["lifting"], [*honest, "2 0 -1 2 1 1"]),
            "rejected",
            bad,
        ),
        "weights of one of two do not sum to 0": (
            listed(
                "x,y",
                (*CUBIC, "y-1"),
                represented([(1, 1), (2, 1)], (1, 0)),
                **complete("mixed-volume", 2, subdivision=TOGETHER | {"obstructions": [MIDDLE[0], "0 3 -1"]}),
            ),
            "rejected",
            bad,
        ),
        "the same terms twice": (
            _curves([(1, 5), (3, 2)], CROSS_CELLS["lifting"], CROSS_CELLS["obstructions"], ALIKE),
            "accepted",
            "mixed volume",
        ),
        "without a constant": (
            _curves([(0, 5), (2, 1)], OPEN_CELLS[0], OPEN_CELLS[1], OPEN),
            "accepted",
            "mixed volume",
        ),
        **{
            f"a polynomial without terms of degree 1, {place}": (
                _curves([(0, 3), (1, 1), (-3, -3)], *THROUGH[place], MEETING[:: 1 if place == "first" else -1]),
                "accepted",
                "mixed volume",
            )
            for place in THROUGH
        },
        "weights sum to more than 0": (
            _cubic([1, 2], "0 -9 -16 -21", [*MIDDLE, "0 0 1 0 1 -1 0 2 -1 0 3 2"]),
            "rejected",
            bad,
        ),
        "weights and vectors both sum to 3": (
            _cubic([1, 2], "0 -9 -16 -21", [*MIDDLE, "0 0 2 0 1 -1 0 2 -1 0 3 3"]),
            "rejected",
            bad,
        ),
        "weights and vectors both sum to -1": (
            _cubic([1, 2], "30 21 14 9", [*MIDDLE, "0 0 1 0 1 -1 0 2 -2 0 3 1"]),
            "rejected",
            bad,
        ),
        "the first edge is along y": (
            _curves([(2, 2)], ["0 0", "0 1 0"], ["0 0 1 0 1 -1 1 1 -1 1 2 1"], ("y-2", "x*y+y-6")),
            "accepted",
            "mixed volume",
        ),
        "a choice of no volume": (
            _curves(
                [(2, 2), (-3, 2)],
                ["0 0", "0 10 0 30"],
                ["0 0 -1 0 1 1 1 0 -1 1 1 2 1 3 -1", "1 0 1 1 1 -2 1 2 1"],
                ("y-2", "x^2*y+x*y+y-14"),
            ),
            "accepted",
            "mixed volume",
        ),
        "no edge but the last along x": (
            listed(
                "x,y,z",
                ("y-2", "z-3", "x*y-4"),
                represented([(2, 2, 3)], (1, 0, 0)),
                **complete("mixed-volume", 1, subdivision={"lifting": ["0 0"] * 3, "obstructions": []}),
            ),
            "accepted",
            "mixed volume",
        ),
        "beside the product of the degrees": (
            listed(
                "x",
                CUBIC,
                represented([(1,), (2,), (3,)], (1,)),
                **complete("refined-bezout", 3, subdivision={"lifting": ["0 0 0 0"], "obstructions": []}),
            ),
            "rejected",
            bad,
        ),
        "one cell too many, after one of no volume": (
            _curves([(2, 2)], ["0 0", "0 0 0"], [], ("y-2", "x*y^2+x*y-12")),
            "rejected",
            bad,
        ),
        "ten": (_curves(CROSSINGS, ["10 10", "0 4 7"], honest), "accepted", "mixed volume"),
        "more polynomials than variables": (
            _curves(PAIR, BILINEAR_CELLS["lifting"], BILINEAR_CELLS["obstructions"], (*BILINEAR, BILINEAR[0])),
            "rejected",
            bad,
        ),
        "not isolated": (
            _curves([(1, 3), (1, 5)], CROSS_CELLS["lifting"], CROSS_CELLS["obstructions"], CROSS, (0, 1)),
            "rejected",
            bad,
        ),
        "not isolated, and called double": (_called_double(), "rejected", bad),
        "where x is 0": (
            listed(
                "x,y",
                EVEN,
                represented([(2, 1), (-2, 1), (3, -4), (-3, -4)], (1, 0)),
                **complete("mixed-volume", 4, subdivision=EVEN_CELLS),
            ),
            "accepted",
            "mixed volume",
        ),
        "where y is 0": (
            listed(
                "x,y",
                EVEN_IN_Y,
                represented([(1, 2), (1, -2), (-4, 3), (-4, -3)], (0, 1)),
                **complete("mixed-volume", 4, subdivision=EVEN_CELLS),
            ),
            "accepted",
            "mixed volume",
        ),
        "all terms twice": (
            _curves(PAIR, CROSS_CELLS["lifting"], CROSS_CELLS["obstructions"], FULL),
            "accepted",
            "mixed volume",
        ),
        "no constant term": (
            _curves([(1, 2), (-1, -2)], BARE_CELLS["lifting"], BARE_CELLS["obstructions"], BARE),
            "accepted",
            "mixed volume",
        ),
        "weights of one polynomial do not sum to 0": (
            listed(
                "x,y",
                (*CUBIC, "y-1"),
                represented([(1, 1), (2, 1)], (1, 0)),
                **complete("mixed-volume", 2, subdivision=TOGETHER | {"obstructions": [MIDDLE[0], "0 3 -1"]}),
            ),
            "rejected",
            bad,
        ),
        "lowered by 1": (
            _curves(CROSSINGS, ["1 0", "0 0 0"], honest),
            "accepted",
            "mixed volume",
        ),
        "the first point is none": (
            _curves(CROSSINGS, CELLS["lifting"], [*honest, "0 2 -1 1 2 1"]),
            "rejected",
            bad,
        ),
        "no subdivision": (_without(), "rejected", bad),
        "of another route": (
            handmade()["cells"] | {"completeness_route": "modular-rank"},
            "rejected",
            bad,
        ),
        "at the end": (_moved(), "malformed", "certificate: "),
        "null": (handmade()["cells"] | {"subdivision": None}, "malformed", bad),
        "one text": (_part("cells", "lifting", ["6 6"]), "malformed", "subdivision.lifting"),
        **{
            f"obstruction {text!r}": (_part("cells", "obstructions", [*honest, text]), "malformed", "subdivision.obs")
            for text in (
                "",
                "0 0",
                "0 0 0",
                "0 0 1 0",
                "0 1 1 0 0 -1",
                "0 0 1 0 0 -1",
                "1 0 1 0 0 -1",
                "0 0 1 0 0 1 0 1 -2",
                "0 0 1 0 1 0",
                "0 -1 1",
                "-1 0 1",
            )
        },
        **{
            f"lifting {text!r}": (_part("cells", "lifting", [text, "0 4 7"]), "malformed", "subdivision.lif")
            for text in (
                "06 6",
                "6  6",
                "6 -0",
                "6 +6",
                "6 6 ",
                " 6 6",
                "6 1000000000000000000",
                "1000000000000000000 6",
                "6,6",
                "٦ ٦",
            )
        },
        "eighteen digits": (
            _curves(CROSSINGS, ["999999999999999999 999999999999999999", "0 4 7"], honest),
            "accepted",
            "mixed volume",
        ),
        "negative numbers": (_curves(CROSSINGS, ["-6 -6", "0 4 7"], honest), "accepted", "mixed volume"),
    }

"""Region certificates whose matrix of wrenches is said to be regular, with what both checkers must say of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from random import Random
from typing import Any

import forged_regions
from forged_regions import (
    BROKEN,
    COPLANAR,
    GOOD,
    INSIDE,
    NO_FAILURE,
    ONE_SIGN,
    OUTSIDE,
    PUSHED,
    SMALL,
    TWO_SIGNS,
    Row,
    as_map,
)
from handmade_regions import Content, leg, random_legs, region, second, texts

BESIDE = "conditions: regular has neither"
ORDER = "conditions: none, or not in their order"
UNKNOWN = "conditions[1]"
SECOND = "paving: the part of letter 2"


def regular(content: Content, **entries: Any) -> Content:
    """A certificate of version 1 with no_type_2 as one of version 2 with regular in its place."""
    names = ["regular" if name == "no_type_2" else name for name in content["conditions"]]
    return second(content, **{"conditions": names, **entries})


def determinant_rows() -> Iterator[tuple[str, Row]]:
    """All certificates made by hand that ask for a determinant: the matrix says the same of them."""
    for name, (content, status, line) in forged_regions.ROWS.items():
        if "no_type_2" in content["conditions"] and status != "malformed":
            yield f"{name}, regular", (regular(content), status, line)


def pushed(sizes: Sequence[Any], **entries: Any) -> Content:
    """Three rods, in the directions of the axes at (0, 0, 0) and so long: a move changes all of them alike."""
    return aimed([[Fraction(size) * (k == j) for j in range(3)] for k, size in enumerate(sizes)], **entries)


def aimed(vectors: Sequence[Sequence[Any]], *others: Any, **entries: Any) -> Content:
    """Three legs: rods that are these vectors at (0, 0, 0), and others."""
    rods = [*(leg([-x for x in vector], (0, 0, 0)) for vector in vectors), *others]
    place = {"variables": ["x", "y"], "place": ["x", "y", 0], "axes": [0, 1]}
    return regular(region(rods, **{**PUSHED, **place, **entries}))


def _about(x: Any, y: Any) -> list[list[Fraction]]:
    return [[-Fraction(x), Fraction(x)], [-Fraction(y), Fraction(y)]]


_NEAR = pushed((1, 1, 1), box=_about("1/8", "1/8"))


def _named(*names: str) -> Content:
    return _NEAR | {"conditions": list(names)}


def _limited(most: Any, **entries: Any) -> Content:
    """Rods about 1 long that are at most so long, and regular."""
    content = pushed((1, 1, 1), **{"box": _about("3/4", "1/8"), "conditions": ["limits", "regular"], **entries})
    for entry in content["robot"]["legs"]:
        entry["reach"] = ["0", str(most)]
    return content


def _shown(content: Content, *points: list[str]) -> Content:
    """The claim that poses refute it."""
    said = {"claim": "not-all", "paving": "", "inside": 0, "member": [], "counterexample": list(points)}
    return content | said


def mapped(content: Content, word: str, greatest: str = "0") -> Content:
    """A map of version 2."""
    return as_map(content, word) | {"member": [], "undecided": word.count("u"), "measure": ["0", greatest]}


def _with_pivot(value: int) -> Content:
    """Rods whose inverse has entries of 48 binary digits, in a box such that the second determinant is this."""
    p, q, r, s = (3 << 46) + 1, (1 << 48) - 398, 194718186100966, 259624248134253  # p s - q r = 1
    ends = 1 + p + q, (1 + p + q) * (r + s) + value
    return aimed([(s, -q, 0), (-r, p, 0), (0, 0, 1)], box=[[Fraction(-1, end), Fraction(1, end)] for end in ends])


CASES: dict[str, Row] = {
    # E is h_j / d_i in row i and column j: its spectral radius is the sum of h_i / d_i.
    "spectral radius 3/4, rows of 17/4": (pushed((1, "1/8", 1), box=_about("1/2", "1/32")), "accepted", GOOD),
    "odd middles": (pushed((1, 1, 1), box=[[0, 1], [0, 3]]), "accepted", GOOD),
    "odd middles, larger": (pushed((3, 5, 1), box=[[0, 1], [-2, 3]]), "accepted", GOOD),
    "spectral radius 1": (pushed((1, "1/8", 1), box=_about("1/2", "1/16")), "rejected", INSIDE),
    "spectral radius hardly below 1": (
        pushed((1, "1/8", 1), box=_about("1/2", Fraction(1, 16) - SMALL)),
        "accepted",
        GOOD,
    ),
    "spectral radius hardly above 1": (
        pushed((1, "1/8", 1), box=_about("1/2", Fraction(1, 16) + SMALL)),
        "rejected",
        INSIDE,
    ),
    "the first entry is 1": (pushed((1, 1, 1), box=_about(1, "1/8")), "rejected", INSIDE),
    "the second entry is 1": (pushed((1, 1, 1), box=_about("1/8", 1)), "rejected", INSIDE),
    "negative middles": (pushed((-1, "-1/8", 1), box=_about("1/2", "1/32")), "accepted", GOOD),
    "a singular middle": (pushed((1, 0, 1), box=_about("1/2", "1/32")), "rejected", INSIDE),
    "a column of zeros": (pushed((1, 1, 0), box=_about("1/2", "1/32")), "rejected", INSIDE),
    "halved twice": (
        pushed((1, 1, 1), box=_about("31/32", "31/32"), axes=[0, 1], paving="ssiisii"),
        "rejected",
        "paving: the part of letter 3",
    ),
    "the lower half is singular": (
        pushed((1, 1, 1), box=[["-33/32", "3/4"], ["-1/64", "1/64"]], paving="sii"),
        "rejected",
        SECOND,
    ),
    "the upper half is singular": (
        pushed((-1, 1, 1), box=[["-3/4", "33/32"], ["-1/64", "1/64"]], paving="sii"),
        "rejected",
        "paving: the part of letter 3",
    ),
    "nowhere": (mapped(pushed((1, 0, 1), box=_about("1/2", "1/32")), "o"), "rejected", OUTSIDE),
    "undecided": (mapped(pushed((1, 0, 1), box=_about("1/2", "1/32")), "u", "1/16"), "accepted", "measure"),
    "pivots of 1": (_with_pivot(1), "accepted", GOOD),
    "a pivot of 0": (_with_pivot(0), "rejected", INSIDE),
    "a pivot of -1": (_with_pivot(-1), "rejected", INSIDE),
    "rods hardly longer than 0": (
        aimed(
            [[Fraction(x) * SMALL for x in rod] for rod in ((3, 1, 1), (1, 4, 1), (1, 1, 5))],
            box=_about(SMALL / 8, SMALL / 8),
        ),
        "accepted",
        GOOD,
    ),
    # The name of the condition, and what may stand beside it.
    "version 1": (region(COPLANAR, **{**PUSHED, "conditions": ["regular"]}), "malformed", UNKNOWN),
    "beside no_type_2": (_named("no_type_2", "regular"), "malformed", ORDER),
    "twice": (_named("regular", "regular"), "malformed", "conditions[1]"),
    "not the last": (_named("regular", "no_type_1"), "malformed", "conditions[1]"),
    "no name": (_named(), "malformed", ORDER),
    "another name": (_named("regulars"), "malformed", UNKNOWN),
    "a number in place of names": (_NEAR | {"conditions": 5}, "malformed", "conditions"),
    "a name in place of names": (_NEAR | {"conditions": "regular"}, "malformed", "conditions"),
    "beside a path": (
        regular(
            region(COPLANAR, **{**PUSHED, "variables": ["along"], "place": [0, 0, 0], "box": [[0, 1]]}),
            path=[[1], [0, 1], [0], [0]],
        ),
        "malformed",
        BESIDE,
    ),
    "beside a parameter": (
        regular(region(COPLANAR, **{**PUSHED, "box": [[0, 1]]}), parameters={"base.joints.1.1": [0, 1]}),
        "malformed",
        BESIDE,
    ),
    "fewer rows than freedoms": (
        regular(region(COPLANAR[:2], **{**PUSHED, "modes": [0, 0]})),
        "malformed",
        "conditions: as many",
    ),
    "a mode unnamed": (
        regular(region([*COPLANAR[:2], leg((0, 0, 0), (0, 0, 1), direction=(1, 0, 0), rod=25)], **PUSHED)),
        "malformed",
        "modes",
    ),
    "beside no_type_1": (_named("no_type_1", "regular"), "accepted", GOOD),
    "beside limits": (_limited(2), "accepted", GOOD),
    "beside limits that fail": (_limited(1), "rejected", INSIDE),
    "limits, with what is singular": (_limited(3, box=_about(2, "1/8")), "rejected", INSIDE),
    "limits that fail, shown": (_shown(_limited(1), ["3/4", "0"]), "accepted", BROKEN),
    "limits that hold, shown": (_shown(_limited(2), ["3/4", "0"]), "rejected", NO_FAILURE),
    "singular, shown beside limits": (_shown(_limited(3, box=_about(2, "1/8")), ["-1", "0"]), "accepted", BROKEN),
    "hardly singular, shown": (
        _shown(_limited(3, box=_about(2, "1/8")), [str(SMALL - 1), "0"]),
        "rejected",
        NO_FAILURE,
    ),
    "two signs": (_shown(pushed((1, 1, 1), box=_about(2, 1)), ["-1", "-1"], ["1", "1"]), "accepted", TWO_SIGNS),
    "one sign": (_shown(pushed((1, 1, 1), box=_about(2, 1)), ["1", "0"], ["1", "1"]), "rejected", ONE_SIGN),
    "one sign, a third row is the first with an entry": (
        _shown(aimed([(1, 0, 1), (1, 1, 0), (2, 0, 0)], box=_about(2, 1)), ["-1", "0"], ["1", "0"]),
        "rejected",
        ONE_SIGN,
    ),
    "no rod, beside a slide, shown": (
        _shown(
            aimed(
                [(1, 0, 0), (0, 1, 0)],
                leg((0, 0, -1), (0, 0, 0), direction=(0, 0, 1), rod=25),
                modes=[0, 0, 1],
                box=_about(2, 1),
            ),
            ["-1", "0"],
        ),
        "accepted",
        BROKEN,
    ),
    "a sign and 0": (_shown(pushed((1, 1, 1), box=_about(2, 1)), ["-1", "0"], ["1", "1"]), "rejected", ONE_SIGN),
    "two signs beside joint values": (
        _shown(pushed((1, 1, 1), box=_about(2, 1)), ["-1", "-1"], ["1", "1"]) | {"joints": [["0", "9"]] * 3},
        "malformed",
        "counterexample: neither",
    ),
}


def turned(types: str, seed: int) -> Content:
    """A planar robot that moves and turns in a box about a pose."""
    random = Random(seed)
    content = region(
        motion="planar",
        variables=["x", "y", "yaw"],
        place=["x", "y", 0],
        turns=[[1, 0], [1, 0], ["yaw"]],
        box=[["-1/2", "1"], ["1/3", 1], ["-1/4", "1/5"]],
        conditions=["no_type_2"],
    )
    random_legs(types, content, random)
    return regular(content)


def wide(content: Content, size: Fraction) -> Content:
    """The same about the middle of its box, so many times as wide."""
    box = [[Fraction(end) for end in pair] for pair in content["chart"]["box"]]
    ends = [[(a + b) / 2 - (b - a) / 2 * size, (a + b) / 2 + (b - a) / 2 * size] for a, b in box]
    return content | {"chart": content["chart"] | {"box": texts(ends)}}


def border_rows() -> Iterator[tuple[str, Row]]:
    """The widest boxes that are proved, to 2^-64, and the next ones: every digit of the test matters."""
    for name, size in WIDEST.items():
        types, seed = name.split()
        content = (
            regular(forged_regions.ROWS[f"{name}: not 0"][0]) if types == "determinant" else turned(types, int(seed))
        )
        yield f"{name}, widest", (wide(content, Fraction(size, 1 << 64)), "accepted", GOOD)
        yield f"{name}, wider", (wide(content, Fraction(size + 1, 1 << 64)), "rejected", INSIDE)


WIDEST = {
    "determinant 3": 20046119394478641064264,
    "determinant 6": 11790170781144683812421,
    "determinant 12": 48082055477404935231513,
    "determinant 14": 74469939938289616100062,
    "lll 1": 9711783158888550068,
    "lll 2": 10395294226531680383,
    "lsl 3": 10563669052452975922,
    "lsl 6": 22481585214243036698,
    "lls 1": 13217649514455548745,
    "sll 1": 9397448768150661075,
    "sss 4": 8245418377430189981,
}

ROWS = dict((*determinant_rows(), *border_rows())) | {f"regular, {name}": row for name, row in CASES.items()}

"""Statics certificates made by hand, honest ones and forgeries, with what both checkers must say of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import deepcopy
from fractions import Fraction
from math import isqrt
from typing import Any

from handmade_statics import Content, machine, polytopes
from tables_of_rows import merged, put

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and how its last line begins."""

SMALL = Fraction(1, 10**30)
FLAT = [0, 1]
SQUARE = machine(FLAT, [(1, 0, 0), (0, 1, 0)])
HEXAGON = machine(FLAT, [(1, 0, 0), (0, 1, 0), (1, 1, 0)])
TIED = machine(FLAT, [(1, 1, 0), (1, -1, 0), (7, 1, 0)], speeds=["1", "1", "7/5"])
"""The third side meets a corner of the others: 7 sqrt(2) = 7/5 sqrt(50)."""
ALIKE = machine(FLAT, [(-2, 0, 0), (1, 0, 0), (0, 3, 0), (0, -1, 0)])
BROAD = machine(FLAT, [(1, 0, 0), (0, 1, 0), (1, 1, 0), (1, -1, 0)], speeds=["1", "1", "9", "9"])
"""Two pairs of sides are no facets."""
LINE = machine([0], [(3, 4, 0), (-5, 12, 0)], speeds=["1", "2/7"])
CUBE = machine([0, 1, 2], [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)])
TALL = machine(
    [0, 1, 2], [(1, 0, 0), (0, 1, 0), (0, 0, 2), (1, 1, 0), (2, 2, 0), (0, 3, 4)], speeds=["1", "2", "3/2"] * 2
)
TURNED = machine(
    [0, 1, 5],
    [(1, 0, 0), (0, 1, 0), (1, 1, 0)],
    metric=["2", "3", "5"],
    rotation=[["-5/7", "-6/7", "0"], ["4/7", "-5/7", "0"], ["0", "0", "1"]],
    position=["1/2", "1/3", "1/4"],
    legs=[
        {"base": ["1", "2", "3"], "platform": ["1", "-1", "2"]},
        {"base": ["-1", "3", "1"], "platform": ["2", "1", "-1"]},
        {"base": ["4", "-1", "2"], "platform": ["-1", "2", "1"]},
    ],
    forces=[["1", "2"], ["-2", "1"], ["-3", "-1"]],
)
MACHINES = {
    "a square": SQUARE,
    "a hexagon": HEXAGON,
    "three sides at a corner": TIED,
    "legs alike": ALIKE,
    "sides that are none": BROAD,
    "a line": LINE,
    "roots of 3, 2 and 1": machine(FLAT, [(1, 1, 1), (1, -1, 0), (1, 0, 0)], speeds=["7/10", "7/10", "1"]),
    "roots of 1, 2 and 3": machine(FLAT, [(1, 0, 0), (1, -1, 0), (1, 1, 1)], speeds=["1", "7/10", "7/10"]),
    "roots of 3 and 4": machine(FLAT, [(1, 1, 1), (0, 2, 0), (1, -1, 1)], speeds=["1", "1", "1"]),
    "opposite legs": machine(FLAT, [(1, 0, 0), (0, 1, 0), (0, -1, 0)]),
    "a line turned": machine(
        [5], [(1, 2, 0)], legs=[{"base": ["0", "0", "0"], "platform": ["1", "2", "0"]}], position=["1", "0", "0"]
    ),
    "a cube cut twice": CUBE,
    "a tall one": TALL,
    "in a metric": TURNED,
    "close sides": machine(
        FLAT, [(1, 0, 0), (0, 1, 0), (1, 1, 0)], speeds=["1", "1", str(Fraction(isqrt(2 * 10**150) + 1, 10**75))]
    ),
}
HONEST: dict[str, Content] = {name: polytopes(content) for name, content in MACHINES.items()}


def _changed(content: Content, change: Callable[[Content], Any]) -> Content:
    found = deepcopy(content)
    change(found)
    return found


LISTS = (("velocity_polytope", "vertices"), ("velocity_polytope", "facets"))
LISTS += (("wrench_polytope", "vertices"), ("wrench_polytope", "facets"))


def list_rows() -> dict[str, Row]:
    """Of every list one entry left out, in turn, and one twice."""
    found: dict[str, Row] = {}
    for name in (
        "a square",
        "a hexagon",
        "legs alike",
        "sides that are none",
        "a line",
        "a cube cut twice",
        "in a metric",
    ):
        content = HONEST[name]
        for key, part in LISTS:
            entries = content[key][part]
            for place, other in ((0, 1), (len(entries) - 1, 0)):
                left = put(content, entries[:place] + entries[place + 1 :], key, part)
                found[f"{name}: {key}.{part} without {place}"] = (left, "rejected", f"{key}: not all")
                twice = put(content, [*entries, entries[place]], key, part)
                found[f"{name}: {key}.{part} twice {place}"] = (twice, "rejected", f"{key}: a")
                swapped = put(content, [*entries[:place], entries[other], *entries[place + 1 :]], key, part)
                found[f"{name}: {key}.{part} again {place}"] = (swapped, "rejected", f"{key}: a")
    return found


def _moved(content: Content, place: int, step: Fraction) -> Content:
    line = content["velocity_polytope"]["vertices"][place][0]
    k = next(k for k, x in enumerate(line) if x != "0")
    return put(content, str(Fraction(line[k]) * (1 + step)), "velocity_polytope", "vertices", place, 0, k)


def _offset(content: Content, place: int, step: Fraction) -> Content:
    offset = content["wrench_polytope"]["facets"][place]["offset"]
    k = next(k for k, x in enumerate(offset) if x != "0")
    return put(content, str(Fraction(offset[k]) + step), "wrench_polytope", "facets", place, "offset", k)


OUTSIDE, OTHERS = "velocity_polytope: a vertex lies outside", "velocity_polytope: not all"
HEX, LINED = HONEST["a hexagon"], HONEST["a line"]
POLYTOPES: dict[str, Row] = {
    **{f"honest, {name}": (content, "accepted", "wrench polytope") for name, content in HONEST.items()},
    **{f"a vertex farther {k}": (_moved(HEX, k, SMALL), "rejected", "velocity_polytope") for k in (0, 5)},
    "a vertex nearer": (_moved(LINED, 0, -SMALL), "rejected", OTHERS),
    "a vertex farther": (_moved(LINED, 0, SMALL), "rejected", OUTSIDE),
    "another vertex nearer": (_moved(LINED, 1, -SMALL), "rejected", OTHERS),
    "another vertex farther": (_moved(LINED, 1, SMALL), "rejected", OUTSIDE),
    **{
        f"a facet moved {k}, {step}": (_offset(HONEST[name], k, step), "rejected", "wrench_polytope: a facet is not")
        for name, k in (("a hexagon", 0), ("in a metric", -1), ("a line", 0), ("a line", 1))
        for step in (SMALL, -SMALL)
    },
    "no vertex of wrenches": (
        put(HEX, [], "wrench_polytope", "vertices"),
        "rejected",
        "wrench_polytope: not all vertices",
    ),
    "a vertex of wrenches that is none": (
        put(HEX, [*HEX["wrench_polytope"]["vertices"][1:], [1, 1, -1]], "wrench_polytope", "vertices"),
        "rejected",
        "wrench_polytope",
    ),
    "a vertex of wrenches that is none, first": (
        put(HEX, [[-1, -1, 1], *HEX["wrench_polytope"]["vertices"][1:]], "wrench_polytope", "vertices"),
        "rejected",
        "wrench_polytope",
    ),
    "a vertex of wrenches between opposite legs": (
        machine(
            FLAT,
            [(1, 0, 0), (0, 1, 0), (0, -1, 0)],
            wrench_polytope=HONEST["opposite legs"]["wrench_polytope"]
            | {"vertices": [[1, 1, 1], *HONEST["opposite legs"]["wrench_polytope"]["vertices"][1:]]},
        ),
        "rejected",
        "wrench_polytope",
    ),
    "a vertex in the middle": (
        put(HEX, [*HEX["velocity_polytope"]["vertices"], [["0"] * 3] * 2], "velocity_polytope", "vertices"),
        "rejected",
        "velocity_polytope: not all vertices",
    ),
    "a vertex on a side": (
        put(
            HEX,
            [*HEX["velocity_polytope"]["vertices"], [["1", "0", "0"], ["0", "0", "0"]]],
            "velocity_polytope",
            "vertices",
        ),
        "rejected",
        "velocity_polytope: not all vertices",
    ),
    "a vertex of wrenches more": (
        put(HEX, [*HEX["wrench_polytope"]["vertices"], [1, 1, -1]], "wrench_polytope", "vertices"),
        "rejected",
        "wrench_polytope",
    ),
    "an idle leg, with another sign": (
        machine(
            [0],
            [(1, 1, 0), (0, 1, 0)],
            wrench_polytope={
                "facets": [{"normal": [s], "offset": ["1", "0"]} for s in ("1", "-1")],
                "vertices": [[1, -1], [-1, 1]],
            },
        ),
        "rejected",
        "wrench_polytope: a leg exerts nothing",
    ),
    "a facet of wrenches more": (
        put(
            HEX,
            [*HEX["wrench_polytope"]["facets"], {"normal": ["1", "2"], "offset": ["1", "2", "3"]}],
            "wrench_polytope",
            "facets",
        ),
        "rejected",
        "wrench_polytope: not all facets",
    ),
    "a facet of twists more": (
        put(
            HONEST["sides that are none"],
            [*HONEST["sides that are none"]["velocity_polytope"]["facets"], [4, 1]],
            "velocity_polytope",
            "facets",
        ),
        "rejected",
        "velocity_polytope: not all facets",
    ),
    "the second of two sides": (
        put(
            HONEST["legs alike"],
            [[2, 1] if f == [1, -1] else f for f in HONEST["legs alike"]["velocity_polytope"]["facets"]],
            "velocity_polytope",
            "facets",
        ),
        "rejected",
        "velocity_polytope: not all facets",
    ),
    "wrenches without an interior": (
        machine(FLAT, [(1, 0, 0), (2, 0, 0)], wrench_polytope={"facets": [], "vertices": []}),
        "rejected",
        "wrench_polytope: has no interior",
    ),
    "wrenches along a line, with facets": (
        machine(
            FLAT,
            [(1, 0, 0), (2, 0, 0)],
            wrench_polytope={
                "facets": [{"normal": ["0", s], "offset": ["0", "0"]} for s in ("1", "-1")],
                "vertices": [[1, 1], [-1, -1]],
            },
        ),
        "rejected",
        "wrench_polytope: has no interior",
    ),
    **{
        f"an idle leg {k}": (
            machine(
                [0],
                [(int(k != 0), 1, 0), (int(k != 1), 1, 0)],
                wrench_polytope={
                    "facets": [{"normal": [s], "offset": [str(int(k != 0)), str(int(k != 1))]} for s in ("1", "-1")],
                    "vertices": [[1, 1], [-1, -1]],
                },
            ),
            "rejected",
            "wrench_polytope: a leg exerts nothing",
        )
        for k in (0, 1)
    },
    "twists without bounds": (
        machine(FLAT, [(1, 0, 0), (2, 0, 0)], velocity_polytope={"facets": [], "vertices": []}),
        "rejected",
        "velocity_polytope: is not bounded",
    ),
}

# Ellipsoids: of a square the disc, its volume proved by equal weights


def ellipsoid(matrix: Sequence[Sequence[Any]], weights: Sequence[Any], content: Content = SQUARE) -> Content:
    entry = {
        "weights": [str(Fraction(w)) for w in weights],
        "matrix": [[str(Fraction(x)) for x in row] for row in matrix],
    }
    return content | {"ellipsoid": entry}


HALF = Fraction(1, 2)
PART = Fraction(1, 10**12)
LARGEST, POSITIVE, WEIGHTS = "ellipsoid: not proved", "ellipsoid: not positive definite", "ellipsoid: weights"
BODY = machine([0, 1, 2], [(1, 0, 0), (0, 1, 0), (0, 0, 1)])
FAST = machine([0], [(1, 0, 0), (1, 0, 0)], speeds=["1", "2"])
OBLONG = machine(FLAT, [(1, 0, 0), (1, 2, 0)], speeds=["2", "1/3"])
ELLIPSOIDS: dict[str, Row] = {
    "a disc": (ellipsoid([[1, 0], [0, 1]], [HALF, HALF]), "accepted", "ellipsoid"),
    "a disc, nearly": (ellipsoid([[1, 0], [0, 1 - PART]], [HALF, HALF]), "accepted", "ellipsoid"),
    "a disc, less nearly": (ellipsoid([[1, 0], [0, 1 - PART - SMALL]], [HALF, HALF]), "rejected", LARGEST),
    "a disc too high": (ellipsoid([[1, 0], [0, 1 + SMALL]], [HALF, HALF]), "rejected", "ellipsoid: leaves"),
    "a disc too wide": (ellipsoid([[1 + SMALL, 0], [0, 1]], [HALF, HALF]), "rejected", "ellipsoid: leaves"),
    "no disc": (ellipsoid([[-1, 0], [0, -1]], [HALF, HALF]), "rejected", POSITIVE),
    "no disc, but a hyperbola": (ellipsoid([[1, 0], [0, -1]], [HALF, HALF]), "rejected", POSITIVE),
    "a matrix that is not symmetric": (ellipsoid([[1, SMALL], [0, 1]], [HALF, HALF]), "rejected", POSITIVE),
    "a matrix that is not symmetric, below": (ellipsoid([[1, 0], [SMALL, 1]], [HALF, HALF]), "rejected", POSITIVE),
    "minors of 0": (ellipsoid([[0, 0, 1], [0, -1, 0], [1, 0, 0]], [Fraction(1, 3)] * 3, BODY), "rejected", POSITIVE),
    "two negative axes": (
        ellipsoid([[-1, 0, 0], [0, -1, 0], [0, 0, 1]], [Fraction(1, 3)] * 3, BODY),
        "rejected",
        POSITIVE,
    ),
    "two other negative axes": (
        ellipsoid([[1, 0, 0], [0, -1, 0], [0, 0, -1]], [Fraction(1, 3)] * 3, BODY),
        "rejected",
        POSITIVE,
    ),
    "a ball": (ellipsoid([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [Fraction(1, 3)] * 3, BODY), "accepted", "ellipsoid"),
    **{
        f"a matrix that is not symmetric at {i}, {j}": (
            ellipsoid(
                [[int(a == b) + SMALL * ((a, b) == (i, j)) for b in range(3)] for a in range(3)],
                [Fraction(1, 3)] * 3,
                BODY,
            ),
            "rejected",
            POSITIVE,
        )
        for i in range(3)
        for j in range(3)
        if i != j
    },
    "a weight alone": (ellipsoid([[1]], [1, 0], FAST), "accepted", "ellipsoid"),
    "a negative weight": (ellipsoid([[Fraction(9, 10)]], [Fraction(3, 2), -HALF], FAST), "rejected", WEIGHTS),
    "a negative weight, first": (ellipsoid([[4]], [-HALF, Fraction(3, 2)], FAST), "rejected", WEIGHTS),
    "weights of more than 1": (ellipsoid([[HALF]], [2, 0], FAST), "rejected", WEIGHTS),
    "weights of less than 1": (ellipsoid([[1]], [1 - SMALL, 0], FAST), "rejected", WEIGHTS),
    "weights of a little more than 1": (ellipsoid([[1]], [1 + SMALL, 0], FAST), "rejected", WEIGHTS),
    "other weights": (ellipsoid([[1, 0], [0, 1]], [HALF + PART, HALF - PART]), "accepted", "ellipsoid"),
    "wrong weights": (ellipsoid([[1, 0], [0, 1]], [Fraction(3, 4), Fraction(1, 4)]), "rejected", LARGEST),
    # l^2 = 1 and 5: x^2 <= 4, (x + 2 y)^2 <= 5/9, so that the square of x + 2 y has 5/9, and 4 y^2 4 + 5/9 on average.
    "an oblong": (ellipsoid([[4, -2], [-2, 1 + Fraction(5, 36)]], [HALF, HALF], OBLONG), "accepted", "ellipsoid"),
    "an oblong, the last too wide": (
        ellipsoid([[4, -2], [-2, 1 + Fraction(5, 36) + SMALL]], [HALF, HALF], OBLONG),
        "rejected",
        "ellipsoid: leaves",
    ),
}

# Indices: orthogonal legs, all singular values 1


def indices(
    least: Sequence[Any], greatest: Sequence[Any], condition: Sequence[Any], content: Content = SQUARE
) -> Content:
    names = ("sigma_min", "sigma_max", "condition")
    pairs = zip(names, (least, greatest, condition), strict=True)
    return content | {"indices": {name: [str(Fraction(x)) for x in pair] for name, pair in pairs}}


NEAR, FAR = Fraction(9, 10), Fraction(11, 10)
SLOPE = machine([2, 3], [(0, 0, 1), (0, 0, 1)], legs=[
    {"base": ["0", "0", "0"], "platform": ["0", "0", "1"]}, {"base": ["0", "1", "0"], "platform": ["0", "1", "1"]}
])  # fmt: skip
"""Rows (1, 0) and (1, 1): the second column is of a turn."""
INDICES: dict[str, Row] = {
    "all is 1": (indices([NEAR, 1], [1, FAR], [1, FAR / NEAR]), "accepted", "indices"),
    "sigma_min just above": (
        indices([NEAR, 1 - SMALL], [1, FAR], [1, FAR / NEAR]),
        "rejected",
        "indices: sigma_min is above",
    ),
    "sigma_min just below": (indices([1, 1], [1, FAR], [1, FAR]), "rejected", "indices: sigma_min is below"),
    "sigma_max just above": (indices([NEAR, 1], [1, 1], [1, 1 / NEAR]), "rejected", "indices: sigma_max is above"),
    "sigma_max just below": (
        indices([NEAR, 1], [1 + SMALL, FAR], [1, FAR / NEAR]),
        "rejected",
        "indices: sigma_max is below",
    ),
    "condition above": (indices([NEAR, 1], [1, FAR], [1 + SMALL, FAR / NEAR]), "rejected", "indices: condition"),
    "condition below": (indices([NEAR, 1], [1, FAR], [1, FAR / NEAR - SMALL]), "rejected", "indices: condition"),
    "anything": (indices([0, 9], [0, 9], [0, 10**9]), "rejected", "indices: condition"),
    "anything but 0": (indices([SMALL, 9], [0, 9], [0, 9 / SMALL]), "accepted", "indices"),
    "less than 0": (indices([-1, 1], [1, FAR], [1, FAR / NEAR]), "malformed", ""),
    "little less than 0": (indices([-SMALL, 1], [1, FAR], [1, FAR / NEAR]), "malformed", ""),
    "ends out of order": (indices([NEAR, 1], [FAR, 1], [1, FAR / NEAR]), "malformed", ""),
    # The squares are (3 +- sqrt(5)) / 2 times 1, or with turns times 2 those of (1, 0), (1, 1/2): (9 +- sqrt(65)) / 8.
    "a slope": (
        indices(["618/1000", "619/1000"], ["1618/1000", "1619/1000"], ["26/10", "27/10"], SLOPE),
        "accepted",
        "indices",
    ),
    "a slope, turns times 1": (
        indices(["618/1000", "619/1000"], ["1618/1000", "1619/1000"], ["26/10", "27/10"], SLOPE | {"length": "1"}),
        "accepted",
        "indices",
    ),
    "a slope, turns times 2": (
        indices(["342/1000", "343/1000"], ["1460/1000", "1461/1000"], ["42/10", "43/10"], SLOPE | {"length": "2"}),
        "accepted",
        "indices",
    ),
    "a slope, turns times 3": (
        indices(["342/1000", "343/1000"], ["1460/1000", "1461/1000"], ["42/10", "43/10"], SLOPE | {"length": "3"}),
        "rejected",
        "indices",
    ),
    **{
        f"turns times {x}": (SLOPE | {"length": x}, status, "machine" if status == "accepted" else "")
        for x, status in (("1/2", "accepted"), ("0", "malformed"), ("-1/2", "malformed"), ("-1", "malformed"))
    },
}

# The format


def _with(status: str, value: Any, *path: Any, content: Content | None = None) -> Row:
    return put(BASE if content is None else content, value, *path), status, ""


UNIT = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
BASE = polytopes(SQUARE) | {"ellipsoid": ELLIPSOIDS["a disc"][0]["ellipsoid"], "length": "1"}
BASE |= {"indices": INDICES["all is 1"][0]["indices"]}
LONG = {digits: "1" + "0" * (digits - 1) for digits in (600, 601)}
SIDES, ENDS = ("velocity_polytope", "facets"), ("wrench_polytope", "vertices")
_ARMS = [{"base": [str(-k - 1), "0", "0"], "platform": ["0", "0", "0"]} for k in range(13)]
FORMAT: dict[str, Row] = {
    "as it is": (BASE, "accepted", "indices"),
    "12 legs": (machine([0], [(1, 0, 0)] * 12), "accepted", "machine"),
    "13 legs": (machine([0], [(1, 0, 0)] * 13), "too-large", "legs"),
    "a number of 600 digits": _with("accepted", LONG[600], "speeds", 0, content=SQUARE),
    "a number of 601 digits": _with("too-large", LONG[601], "speeds", 0, content=SQUARE),
    "a denominator of 600 digits": _with("accepted", f"1/{LONG[600]}", "speeds", 0, content=SQUARE),
    "a denominator of 601 digits": _with("too-large", f"1/{LONG[601]}", "speeds", 0, content=SQUARE),
    "a number of 5000 digits": _with("malformed", "1" * 5000 + "x", "speeds", 0, content=SQUARE),
    "a number of no digits": _with("malformed", "", "speeds", 0),
    "a number": _with("malformed", 1, "speeds", 0),
    "a list for a number": _with("malformed", ["1"], "speeds", 0),
    "words for a number": _with("malformed", "one", "speeds", 0),
    "a number that is not in lowest terms": _with("malformed", "2/2", "speeds", 0),
    "a number that is not in lowest terms, 4/2": _with("malformed", "4/2", "speeds", 0),
    "a number that is not in lowest terms, 12/8": _with("malformed", "12/8", "speeds", 0),
    "a rotation by a right angle": (
        machine([0], [(1, 2, 3)], rotation=[["0", "-1", "0"], ["1", "0", "0"], ["0", "0", "1"]]),
        "accepted",
        "machine",
    ),
    "a rotation by another right angle": (
        machine([0], [(1, 2, 3)], rotation=[["0", "0", "1"], ["1", "0", "0"], ["0", "1", "0"]]),
        "accepted",
        "machine",
    ),
    "a number that is not in lowest terms, 2/4": _with("malformed", "2/4", "speeds", 0),
    "a name of no text": _with("malformed", 5, "name"),
    "a unit of no text": _with("malformed", 5, "unit"),
    "a name of 10000 letters": _with("accepted", "x" * 10000, "name"),
    "a name of 10001 letters": _with("too-large", "x" * 10001, "name"),
    "version 2": _with("malformed", 2, "version"),
    "version 0": _with("malformed", 0, "version"),
    "a true version": _with("malformed", True, "version"),
    **{
        f"a metric with {x} at {k}": _with("malformed", x, "metric", k)
        for k in range(3)
        for x in ("0", "-1", "1/2", "3/2")
    },
    "a metric of two": _with("malformed", ["1", "1"], "metric"),
    "a metric of four": _with("malformed", ["1"] * 4, "metric"),
    "a metric in words": _with("malformed", "111", "metric"),
    **{
        f"freedoms {x}": _with("malformed", x, "freedoms", content=machine([0], [(1, 2, 3)] * 8))
        for x in (
            [],
            [0, 0],
            [1, 0],
            [0, 2, 1],
            [-1],
            [-1, 0],
            [6],
            [0, 6],
            [True],
            ["0"],
            [0.0],
            "01",
            0,
            list(range(7)),
            None,
        )
    },
    **{
        f"a freedom {k}": (machine([k], [(1, 2, 3)], position=["1", "2", "4"]), "accepted", "machine") for k in range(6)
    },
    "six freedoms": (machine(range(6), [(1, 2, 3)] * 6), "accepted", "machine"),
    "fewer legs than freedoms": (machine([0, 1, 2], [(1, 2, 3)] * 2), "malformed", "legs"),
    "a position of two": _with("malformed", ["0", "0"], "position"),
    "a rotation of two rows": _with("malformed", UNIT[:2], "rotation"),
    "a rotation of four rows": _with("malformed", [*UNIT, ["0", "0", "0"]], "rotation"),
    "a rotation in words": _with("malformed", "abc", "rotation"),
    **{
        f"a rotation with {x} at {i}, {j}": _with("rejected", x, "rotation", i, j, content=machine([0], [(1, 2, 3)]))
        for i in range(3)
        for j in range(3)
        for x in (("3/5", "-3/5") if i != j else ("3/5", "7/5"))
    },
    **{
        f"a rotation mirrored at {i}": _with("rejected", "-1", "rotation", i, i, content=machine([0], [(1, 2, 3)]))
        for i in range(3)
    },
    "a rotation stretched along x": _with(
        "rejected", [["2", "0", "0"], ["0", "1", "0"], ["0", "0", "1/2"]], "rotation"
    ),
    "a rotation sheared": _with("rejected", [["1", "1", "0"], ["0", "1", "0"], ["0", "0", "1"]], "rotation"),
    "a rotation sheared back": _with("rejected", [["1", "-1", "0"], ["0", "1", "0"], ["0", "0", "1"]], "rotation"),
    "a leg of length 0": (machine([0], [(1, 0, 0), (0, 0, 0)]), "rejected", "legs[2]: has length 0"),
    "a short leg": (machine([0], [(1, 0, 0), (SMALL, 0, 0)]), "accepted", "machine"),
    "a leg of two joints": _with("malformed", {"base": ["1", "0", "0"]}, "legs", 0),
    "a leg the other way": _with("malformed", {"platform": ["1", "0", "0"], "base": ["1", "0", "0"]}, "legs", 0),
    "a leg of no joints": _with("malformed", ["base", "platform"], "legs", 0),
    "legs in words": _with("malformed", "legs", "legs"),
    **{
        f"speeds {x}": _with("malformed", x, "speeds")
        for x in (["0", "1"], ["1", "0"], ["-1", "1"], ["1", "-1/2"], ["1"], ["1"] * 3, "11")
    },
    "a slow leg": _with("accepted", ["1/1000", "1"], "speeds", content=SQUARE),
    **{
        f"forces {x}": _with("malformed", x, "forces")
        for x in (
            [["1", "1"], ["0", "1"]],
            [["0", "1"], ["1", "1"]],
            [["2", "1"], ["0", "1"]],
            [["0", "1"], ["0", "-1"]],
            [["0", "1"]],
            [["0", "1"]] * 3,
            [["0"], ["0", "1"]],
            "ab",
        )
    },
    "forces of 13 legs": _with("malformed", [["0", "1"]] * 12, "forces"),
    "no speeds": _with("malformed", None, "speeds", content=HONEST["a square"] | {"wrench_polytope": None}),
    "no speeds for an ellipsoid": _with("malformed", None, "speeds", content=ELLIPSOIDS["a disc"][0]),
    "no forces": _with("malformed", None, "forces", content=HONEST["a square"] | {"velocity_polytope": None}),
    "neither speeds nor forces": (SQUARE | {"speeds": None, "forces": None}, "accepted", "machine"),
    "only forces": (HONEST["a square"] | {"speeds": None, "velocity_polytope": None}, "accepted", "wrench"),
    "only speeds": (HONEST["a square"] | {"forces": None, "wrench_polytope": None}, "accepted", "velocity"),
    **{
        f"a facet {x}": _with("malformed", x, *SIDES, 0)
        for x in ([0, 1], [3, 1], [1, 0], [1, 2], [1, -2], [-1, 1], [14, 1], [1], [1, 1, 1], [True, 1], ["1", 1], "11")
    },
    "24 facets": _with("rejected", [[1, 1]] * 24, *SIDES),
    "25 facets": _with("too-large", [[1, 1]] * 25, *SIDES),
    "facets in words": _with("malformed", "facets", *SIDES),
    "a facet of leg 12": (
        machine([0], [(1, 0, 0)] * 12, velocity_polytope={"facets": [[12, 1]], "vertices": []}),
        "rejected",
        "",
    ),
    "a vertex of one coordinate": _with("malformed", [["1", "0"]], "velocity_polytope", "vertices", 0),
    "a vertex of three coordinates": _with("malformed", [["1", "0"]] * 3, "velocity_polytope", "vertices", 0),
    "a vertex of a word": _with("malformed", "ab", "velocity_polytope", "vertices", 0),
    "a coordinate of one leg": _with("malformed", ["1"], "velocity_polytope", "vertices", 0, 0),
    "a coordinate of three legs": _with("malformed", ["1"] * 3, "velocity_polytope", "vertices", 0, 0),
    "4096 vertices": _with("malformed", [0] * 4096, "velocity_polytope", "vertices"),
    "4097 vertices": _with("too-large", [0] * 4097, "velocity_polytope", "vertices"),
    "4096 ends": _with("malformed", [0] * 4096, *ENDS),
    "4097 ends": _with("too-large", [0] * 4097, *ENDS),
    "4096 planes": _with("malformed", [0] * 4096, "wrench_polytope", "facets"),
    "4097 planes": _with("too-large", [0] * 4097, "wrench_polytope", "facets"),
    **{
        f"ends {x}": _with("malformed", x, *ENDS, 0)
        for x in ([0, 1], [1, 0], [2, 1], [1, -2], [1], [1, 1, 1], [True, 1], ["1", 1])
    },
    **{
        f"a normal {x}": _with("malformed", x, "wrench_polytope", "facets", 0, "normal")
        for x in (["1/2", "0"], ["0", "1/2"], ["1"], ["1"] * 3)
    },
    "an offset of one": _with("malformed", ["1"], "wrench_polytope", "facets", 0, "offset"),
    "weights of one": _with("malformed", ["1"], "ellipsoid", "weights"),
    "a matrix of a row": _with("malformed", [["1", "0"]], "ellipsoid", "matrix"),
    "a matrix of three rows": _with("malformed", [["1", "0"]] * 3, "ellipsoid", "matrix"),
    "a matrix of six rows": _with("malformed", [["1", "0"]] * 6, "ellipsoid", "matrix"),
    "a matrix of seven rows": _with("malformed", [["1", "0"]] * 7, "ellipsoid", "matrix"),
    "forces of 13 pairs": _with("malformed", [["0", "1"]] * 13, "forces"),
    "a matrix with a short row": _with("malformed", [["1", "0"], ["1"]], "ellipsoid", "matrix"),
    **{
        f"{key} in words": _with("malformed", "words", key)
        for key in ("velocity_polytope", "wrench_polytope", "ellipsoid", "indices")
    },
    **{
        f"{key} of nothing": _with("malformed", {}, key)
        for key in ("velocity_polytope", "wrench_polytope", "ellipsoid", "indices")
    },
    "six freedoms in an ellipsoid": (
        ellipsoid(
            [[int(i == j) for j in range(6)] for i in range(6)],
            [Fraction(1, 6)] * 6,
            machine(range(6), [(1, 2, 3)] * 6),
        ),
        "rejected",
        "ellipsoid",
    ),
    "no rotation, and a leg of no joints": (
        put(put(SQUARE, "2", "rotation", 0, 0), {}, "legs", 1),
        "malformed",
        "legs[2]",
    ),
    "legs of no list": _with("malformed", 5, "legs"),
    "facets of no list": _with("malformed", 5, *SIDES),
    "vertices of no list": _with("malformed", 5, "velocity_polytope", "vertices"),
    "ends of no list": _with("malformed", 5, *ENDS),
    "planes of no list": _with("malformed", 5, "wrench_polytope", "facets"),
    "forces of no list": _with("malformed", 5, "forces"),
    "too many choices in a large file": (
        machine(
            range(5),
            [(1, 2, 3)] * 12,
            name="x" * 10000,
            velocity_polytope={"facets": [], "vertices": [[["0"] * 12] * 5] * 150},
        ),
        "too-large",
        "velocity_polytope: too many",
    ),
    "too many choices": (
        machine(range(5), [(1, 2, 3)] * 12, velocity_polytope={"facets": [], "vertices": []}),
        "too-large",
        "velocity_polytope: too many",
    ),
}

ROWS: dict[str, Row] = merged(POLYTOPES, list_rows(), ELLIPSOIDS, INDICES, FORMAT)

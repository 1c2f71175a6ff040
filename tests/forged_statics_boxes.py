"""Statics certificates of boxes of poses made by hand, honest ones and forgeries, with what checkers must say."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from random import Random
from typing import Any

import numpy as np
from handmade_boxes import Content, around, claims, ellipsoid, leg, machine, wrench_polytope
from tables_of_rows import merged, put

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and how its last line begins."""

HALF, THIRD = Fraction(1, 2), Fraction(1, 3)
FLAT = [0, 1]


def _spun(numbers: list[int]) -> np.ndarray[Any, Any]:
    """The rotation of a quaternion."""
    w, x, y, z = np.array(numbers) / np.linalg.norm(numbers)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def box_of_pose(position: list[float], quaternion: list[int], room: float = 1e-13) -> Content:
    """Position and rotation, with room around them."""
    turned = _spun(quaternion)
    return {
        "position": [around(x, room) for x in position],
        "rotation": [[around(x, room) for x in row] for row in turned],
    }


def _general() -> Content:
    """Everything at once: a metric, a rotation, slides, forms with all coefficients, more legs than free components."""
    random = Random(236)  # rows that are far from dependent

    def point() -> list[int]:
        return [random.randint(-4, 4) for _ in range(3)]

    directions = [None, point(), None, point(), None]
    legs = [leg([8 + x for x in point()], point(), way) for way in directions]
    forms = [[str(Fraction(random.randint(1, 9), random.randint(1, 4))) for _ in range(17)] for _ in range(2)]
    return machine(
        range(6),
        [],
        metric=["2", "3", "5"],
        legs=legs,
        constraints=forms,
        free=[0, 2, 3, 5],
        speeds=["1", "2", "1/2", "3", "1"],
        forces=[["1", "2"], ["-2", "1"], ["-3", "-1"], ["-1", "1"], ["0", "1"]],
        length="3",
        load=["1", "-2", "3", "1", "1", "-1"],
        **box_of_pose([0.5, -0.25, 0.75], [4, 1, -2, 1]),
    )


def _planar() -> Content:
    """A plane in a metric, a turn among the freedoms, as many legs as these."""
    return machine(
        [0, 1, 5],
        [],
        metric=["1", "3", "1"],
        legs=[leg([4, 1, 0], [1, 0, 0]), leg([-3, 2, 0], [0, 1, 0], [1, 2, 0]), leg([1, -5, 0], [1, 1, 0])],
        speeds=["1", "1/2", "3"],
        length="2",
        load=["1", "2", "-3"],
        **box_of_pose([0.25, 0.5, 0.0], [3, 0, 0, 1]),
    )


BARE = {
    "a line": machine([0], [(3, 4, 0), (-5, 12, 0)], speeds=["1", "2"], load=["2"]),
    "a square": machine(FLAT, [(1, 0, 0), (0, 1, 0)], load=["1", "2"]),
    "a square cut": machine(FLAT, [(1, 0, 0), (0, 1, 0), (1, 1, 0)], speeds=["1", "1", "6/5"], load=["1", "2"]),
    "a side that is none": machine(FLAT, [(1, 0, 0), (0, 2, 0), (1, 1, 0)], speeds=["1", "1", "3"]),
    "a plane": _planar(),
    "all at once": _general(),
}
WEIGHTS = {
    "a line": ([1, 0], 1e-3),
    "a square": ([HALF, HALF], 1e-3),
    "a square cut": ([HALF, HALF, 0], 1e-3),
    "a plane": ([THIRD, THIRD, THIRD], 1e-3),
}
BARE["a square cut, four legs"] = machine(
    FLAT, [(1, 0, 0), (0, 1, 0), (1, 1, 0), (1, -1, 0)], speeds=["1", "1", "6/5", "9"]
)
BARE["a plane, no length"] = _planar() | {"length": None}
BARE["slides at speeds of 1"] = machine(
    FLAT, [], legs=[leg([-1, 0, 0], direction=[1, 0, 0]), leg([0, -1, 0], direction=[0, -1, 0])]
)
HONEST = {name: claims(content) for name, content in BARE.items()}
HONEST |= {name: ellipsoid(HONEST[name], weights, gap) for name, (weights, gap) in WEIGHTS.items()}
LINE, SQUARE, CUT, PLANE = (HONEST[name] for name in ("a line", "a square", "a square cut", "a plane"))
GENERAL = HONEST["all at once"]


def intervals_of(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Where intervals stand."""
    if isinstance(value, list) and len(value) == 2 and all(isinstance(x, str) for x in value):
        yield path
    elif isinstance(value, dict | list):
        for key, entry in value.items() if isinstance(value, dict) else enumerate(value):
            yield from intervals_of(entry, (*path, key))


@cache
def _claimed(name: str) -> list[tuple[Any, ...]]:
    """Intervals of claims, not of the pose and of limits."""
    content = HONEST[name]
    keys = ("jacobian", "expansion", "actuator_forces", "velocity_polytope", "wrench_polytope", "indices")
    every = [path for key in keys for path in intervals_of(content[key], (key,))]
    if name != "all at once":
        return every
    few = [path for path in every if path[0] in ("velocity_polytope", "wrench_polytope")]
    return [path for path in every if path not in few] + few[:1] + few[-2:]


def _entry(content: Content, path: tuple[Any, ...]) -> Any:
    found: Any = content
    for key in path:
        found = found[key]
    return found


def _missed(name: str, path: tuple[Any, ...]) -> Iterator[tuple[str, Row]]:
    """The interval that ends, or begins, before what it should contain."""
    content = HONEST[name]
    low, high = map(Fraction, _entry(content, path))
    for way, ends in (
        ("below", [low, low + (high - low) * Fraction(2, 5)]),
        ("above", [high - (high - low) * Fraction(2, 5), high]),
    ):
        changed = put(content, [str(x) for x in ends], *path)
        yield f"{name}: {'.'.join(map(str, path))} {way}", (changed, "rejected", str(path[0]))


BOUNDS: dict[str, Row] = {
    key: row
    for name in ("a line", "a square", "a square cut", "a plane", "all at once")
    for path in _claimed(name)
    for key, row in _missed(name, path)
}


def _vertices(content: Content, *entries: Any) -> Content:
    return put(content, list(entries), "velocity_polytope", "vertices")


V, W = CUT["velocity_polytope"], CUT["wrench_polytope"]
OTHERS, TWICE = "velocity_polytope: not all vertices", "velocity_polytope: a vertex is listed twice"
WRENCHES = "wrench_polytope: not all vertices"
BEYOND = {"sides": [[1, 1], [2, 1]], "at": [["999/1000", "1001/1000"]] * 2}
"""The corner of the square that the third leg cuts off."""
LISTS: dict[str, Row] = {
    **{f"honest, {name}": (content, "accepted", "indices") for name, content in HONEST.items()},
    "a vertex dropped": (_vertices(CUT, *V["vertices"][1:]), "rejected", OTHERS),
    "the last vertex dropped": (_vertices(CUT, *V["vertices"][:-1]), "rejected", OTHERS),
    "a vertex twice": (_vertices(CUT, *V["vertices"], V["vertices"][0]), "rejected", TWICE),
    "a vertex twice, one dropped": (_vertices(CUT, *V["vertices"][1:], V["vertices"][1]), "rejected", TWICE),
    "a corner cut off": (_vertices(CUT, *V["vertices"], BEYOND), "rejected", OTHERS),
    "a corner cut off, for another": (_vertices(CUT, *V["vertices"][1:], BEYOND), "rejected", OTHERS),
    "a facet of twists dropped": (put(CUT, V["facets"][1:], "velocity_polytope", "facets"), "rejected", "velocity"),
    "a facet of twists twice": (
        put(CUT, [*V["facets"], V["facets"][0]], "velocity_polytope", "facets"),
        "rejected",
        "velocity_polytope: a facet is listed twice",
    ),
    "a side that is no facet": (
        put(
            HONEST["a side that is none"],
            [*HONEST["a side that is none"]["velocity_polytope"]["facets"], [3, 1]],
            "velocity_polytope",
            "facets",
        ),
        "rejected",
        "velocity_polytope: not all facets",
    ),
    "a facet of wrenches dropped": (
        put(CUT, W["facets"][1:], "wrench_polytope", "facets"),
        "rejected",
        "wrench_polytope: not all facets",
    ),
    "a facet of wrenches twice": (
        put(CUT, [*W["facets"], W["facets"][0]], "wrench_polytope", "facets"),
        "rejected",
        "wrench_polytope: a facet is listed twice",
    ),
    "a facet of wrenches twice, one dropped": (
        put(CUT, [*W["facets"][1:], W["facets"][1]], "wrench_polytope", "facets"),
        "rejected",
        "wrench_polytope: a facet is listed twice",
    ),
    "a vertex of wrenches dropped": (put(CUT, W["vertices"][1:], "wrench_polytope", "vertices"), "rejected", WRENCHES),
    "a vertex of wrenches that is none": (
        put(CUT, [*W["vertices"], [1, 1, -1]], "wrench_polytope", "vertices"),
        "rejected",
        WRENCHES,
    ),
    "a vertex of wrenches for another": (
        put(CUT, [*W["vertices"][1:], [1, 1, -1]], "wrench_polytope", "vertices"),
        "rejected",
        WRENCHES,
    ),
    "a vertex of wrenches twice": (
        put(CUT, [*W["vertices"], W["vertices"][0]], "wrench_polytope", "vertices"),
        "rejected",
        "wrench_polytope: a vertex is listed twice",
    ),
    "another side": (
        put(SQUARE, -1, "wrench_polytope", "facets", 0, "side"),
        "rejected",
        "wrench_polytope: a facet is listed twice",
    ),
}

# Boxes that are too wide, poses that are singular


def _wide(content: Content, key: str, place: tuple[int, int], ends: list[str], **others: Any) -> Content:
    return put(content, ends, key, *place) | others


NONE: dict[str, Any] = dict.fromkeys(("actuator_forces", "load", "velocity_polytope", "wrench_polytope", "ellipsoid"))
NONE |= {"indices": None}


def _only(content: Content, *kept: str) -> Content:
    return content | {key: value for key, value in NONE.items() if key not in kept}


LEAN = [["-1", "1"], ["-1", "1"], ["0", "0"]]
"""Positions so far apart that the legs of the square may have any direction."""
PULLED = _only(SQUARE) | {"load": ["1", "0"]}
"""A leg of 1/p bears it: from 5/7 to 5/3."""
WIDE: dict[str, Row] = {
    **{
        f"any leg, {key}": (_wide(_only(SQUARE, key, *more), "jacobian", (0, 0), ["-1", "2"]), "rejected", line)
        for key, line, more in (
            ("velocity_polytope", "velocity_polytope: legs may be", ()),
            ("wrench_polytope", "wrench_polytope: ", ()),
            ("actuator_forces", "actuator_forces: not decided", ("load",)),
            ("ellipsoid", "ellipsoid: may leave", ()),
            ("indices", "indices: sigma_min may be below", ()),
        )
    },
    "any leg, any force": (
        _wide(_only(SQUARE, "load"), "jacobian", (0, 0), ["-1", "2"], actuator_forces=[["-1000", "1000"]] * 2),
        "rejected",
        "actuator_forces: not decided",
    ),
    "a leg of 3/5 to 7/5": (
        _wide(PULLED, "jacobian", (0, 0), ["3/5", "7/5"], actuator_forces=[["-3/2", "0"], ["-1", "1"]]),
        "rejected",
        "actuator_forces: one is not",
    ),
    "a leg of 3/5 to 7/5, wide bounds": (
        _wide(PULLED, "jacobian", (0, 0), ["3/5", "7/5"], actuator_forces=[["-9", "9"], ["-9", "9"]]),
        "accepted",
        "forces",
    ),
    "a leg of 3/5 to 7/5, nearly": (
        _wide(PULLED, "jacobian", (0, 0), ["3/5", "7/5"], actuator_forces=[["-8/5", "9"], ["-9", "9"]]),
        "rejected",
        "actuator_forces: one is not",
    ),
    "a leg of 3/5 to 7/5, more nearly": (
        _wide(PULLED, "jacobian", (0, 0), ["3/5", "7/5"], actuator_forces=[["-13/8", "9"], ["-9", "9"]]),
        "rejected",
        "actuator_forces: one is not",
    ),
    "any leg, nothing claimed": (_wide(_only(SQUARE), "jacobian", (0, 0), ["-1", "2"]), "accepted", "machine"),
    "any position": (_only(SQUARE) | {"position": LEAN}, "rejected", "legs[1]: its length may be 0"),
    "no length": (_only(put(SQUARE, ["0", "0", "0"], "legs", 0, "base")), "rejected", "legs[1]: its length may be 0"),
    "a slide across": (
        _only(put(SQUARE, ["0", "0", "1"], "legs", 1, "direction")),
        "rejected",
        "legs[2]: its actuator may not",
    ),
    "a vertex that the third leg may cut off": (
        _wide(_only(HONEST["a side that is none"], "velocity_polytope"), "jacobian", (2, 0), ["1/2", "3"]),
        "rejected",
        "velocity_polytope: whether there is",
    ),
    "two legs in one line, perhaps": (
        _wide(put(_only(CUT, "wrench_polytope"), ["-1", "1"], "jacobian", 2, 1), "jacobian", (2, 0), ["1/2", "1"]),
        "rejected",
        "wrench_polytope: ",
    ),
    "forms that may be dependent": (
        _only(GENERAL) | {"constraints": [GENERAL["constraints"][0]] * 2},
        "rejected",
        "expansion: the constraints",
    ),
    "a box that is a little wide": (
        _only(SQUARE) | {"position": [["-1/1000", "1/1000"]] + [["0", "0"]] * 2},
        "rejected",
        "jacobian",
    ),
}

# Determinants that may be 0, where all else is decided


def _pushed(rod: tuple[Any, ...], arm: tuple[Any, ...]) -> Content:
    """A slide along its rod whose row is the rod and its moment."""
    square = sum(Fraction(x) ** 2 for x in rod)
    return leg([x - y for x, y in zip(arm, rod, strict=True)], arm, [Fraction(x) / square for x in rod])


ANYTHING = ["-1000000", "1000000"]


def _four_legs(volume: list[str]) -> Content:
    """Rows so wide that only the minors are told apart from 0; the determinant of the middles is 60."""
    rods = (((-1, -3, 1), 1), ((-1, -3, -1), 1), ((0, -2, 1), -1), ((2, -3, -3), -1))
    content = machine(range(4), [], legs=[_pushed(rod, (0, arm, 0)) for rod, arm in rods])
    rows = [[*rod, rod[2] * arm] for rod, arm in rods]
    content["jacobian"] = [[[str(x + way * Fraction(123, 500)) for way in (-1, 1)] for x in row] for row in rows]
    found = wrench_polytope(content)
    for facet in found["facets"]:
        facet |= {"normal": [ANYTHING] * 4, "offset": ANYTHING}
    return content | {"wrench_polytope": found | {"volume": volume}}


TURNS = {0: 4, 1: 5, 2: 3, 3: 2, 4: 0, 5: 1}


def _six_legs(volume: list[str]) -> Content:
    """Pairs of legs that may nearly be dependent; the volume of twists is 541."""
    near, far = Fraction(37, 50), Fraction(119, 500)
    legs = []
    for row, other in TURNS.items():
        rod, arm = [Fraction(0)] * 3, [Fraction(0)] * 3
        axis, turn, pushed, turned = (row, other, near, far) if row < 3 else (other, row, far, near)
        rod[axis], arm[({0, 1, 2} - {axis, turn - 3}).pop()] = pushed, turned / pushed
        legs.append(_pushed(tuple(rod), tuple(arm)))
    content = claims(machine(range(6), [], legs=legs))
    ends = {0: ["739/1000", "1261/1000"], 1: ["-477/2000", "477/2000"], 2: ["-1/1000000000", "1/1000000000"]}
    content["jacobian"] = [
        [ends[0 if i == j else 1 if j == TURNS[i] else 2] for j in range(6)] for i in range(6)
    ]  # fmt: skip
    for vertex in content["velocity_polytope"]["vertices"]:
        vertex["at"] = [ANYTHING] * 6
    return _only(put(content, volume, "velocity_polytope", "volume"), "velocity_polytope")


AXES = [[int(i == j) for j in range(3)] for i in range(3)]
VAST = machine(
    range(3), [], legs=[leg([-x for x in axis], (0, 0, 0), [Fraction(x, 1 << 170) for x in axis]) for axis in AXES]
)
"""Rows of 2^170: the determinant of their inverse is 2^-510."""
UNDECIDED: dict[str, Row] = {
    "a volume of 960 called 900 at most": (_four_legs(["-1000000", "900"]), "rejected", "wrench_polytope"),
    "a volume of 541 called 510 at most": (_six_legs(["-10000", "510"]), "rejected", "velocity_polytope: the volume"),
    "vast rows": (_only(claims(VAST), "velocity_polytope"), "accepted", "velocity"),
}

# Ellipsoids


def _round(name: str, matrix: Any = None, weights: Any = None, gap: str | None = None) -> Content:
    content = HONEST[name]
    changed = {"matrix": matrix, "weights": weights, "gap": gap}
    entry = content["ellipsoid"] | {key: value for key, value in changed.items() if value is not None}
    return content | {"ellipsoid": entry}


def _times(name: str, factor: Fraction) -> list[list[str]]:
    return [[str(Fraction(x) * factor) for x in row] for row in HONEST[name]["ellipsoid"]["matrix"]]


DISC = [["99999/100000", "0"], ["0", "99999/100000"]]
POSITIVE, SMALL, WEIGHED = "ellipsoid: not positive", "ellipsoid: not proved", "ellipsoid: weights"
ELLIPSOIDS: dict[str, Row] = {
    **{
        f"{name}, larger": (_round(name, _times(name, 1 + Fraction(2, 10**5))), "rejected", "ellipsoid: may leave")
        for name in ("a line", "a square", "a plane")
    },
    **{
        f"{name}, smaller": (_round(name, _times(name, Fraction(99, 100))), "rejected", SMALL)
        for name in ("a line", "a square", "a plane")
    },
    "a disc": (_round("a square", DISC, None, "1/40000"), "accepted", "ind"),
    "a disc, no gap": (
        _round("a square", DISC, None, "0"),
        "rejected",
        SMALL,
    ),
    "a disc, gap too small": (
        _round("a square", DISC, None, "1/60000"),
        "rejected",
        SMALL,
    ),
    "one leg outside": (
        _round("a square", [["9/10", "0"], ["0", "11/10"]], None, "1/2"),
        "rejected",
        "ellipsoid: may leave",
    ),
    "the other leg outside": (
        _round("a square", [["11/10", "0"], ["0", "9/10"]], None, "1/2"),
        "rejected",
        "ellipsoid: may leave",
    ),
    "not symmetric": (_round("a square", [["9/10", "1/1000"], ["0", "9/10"]], None, "1/2"), "rejected", POSITIVE),
    "not symmetric, below": (
        _round("a square", [["9/10", "0"], ["1/1000", "9/10"]], None, "1/2"),
        "rejected",
        POSITIVE,
    ),
    "two negative axes": (_round("a square", [["-9/10", "0"], ["0", "-9/10"]], None, "1/2"), "rejected", POSITIVE),
    "one negative axis": (_round("a square", [["9/10", "0"], ["0", "-9/10"]], None, "1/2"), "rejected", POSITIVE),
    "an axis of 0": (_round("a square", [["9/10", "0"], ["0", "0"]], None, "1/2"), "rejected", POSITIVE),
    "weights of 2": (_round("a square", None, ["1", "1"]), "rejected", WEIGHED),
    "weights of less": (_round("a square", None, ["1/2", "49/100"], "1/2"), "rejected", WEIGHED),
    "a negative weight": (_round("a square cut", None, ["3/4", "3/4", "-1/2"]), "rejected", WEIGHED),
    "a negative weight, first": (_round("a square cut", None, ["-1/2", "3/4", "3/4"]), "rejected", WEIGHED),
    "other weights": (_round("a square", None, ["1/4", "3/4"], "1/10"), "rejected", SMALL),
    "a weight of 0": (_round("a square", None, ["1", "0"], "9/10"), "rejected", SMALL),
}

# Indices

SIGMA = SQUARE["indices"]


def _bounds(**changed: list[str]) -> Content:
    return SQUARE | {"indices": SIGMA | changed}


INDICES: dict[str, Row] = {
    "wide bounds": (
        _bounds(sigma_min=["1/2", "2"], sigma_max=["1/2", "2"], condition=["1/4", "4"]),
        "accepted",
        "indices",
    ),
    "from 0": (_bounds(sigma_min=["0", "2"], condition=["0", "9"]), "rejected", "indices: condition"),
    "at the value": (_bounds(sigma_min=["1", "2"]), "rejected", "indices: sigma_min may be below"),
    "at the value, above": (
        _bounds(sigma_min=["1/2", "1"], condition=["0", "9"]),
        "rejected",
        "indices: sigma_min may",
    ),
    "sigma_max at the value": (_bounds(sigma_max=["1", "2"]), "rejected", "indices: sigma_max may be below"),
    "sigma_max at the value, above": (_bounds(sigma_max=["1/2", "1"]), "rejected", "indices: sigma_max may be above"),
    **{f"turns times {x}": (PLANE | {"length": x}, "rejected", "indices: ") for x in ("1", "199/100", "201/100", "3")},
    "turns times nothing": (PLANE | {"length": None}, "rejected", "indices: "),
}

# Numbers that are exact: bounds that are met, pivots and products that are 0


def _exact(content: Content, rows: Sequence[Sequence[Any]]) -> Content:
    """With exactly these rows, and nothing claimed."""
    table = [[[str(x)] * 2 for x in row] for row in rows]
    unit = [[[str(int(i == j))] * 2 for j in range(len(rows[0]))] for i in range(len(rows[0]))]
    return _only(content) | {"jacobian": table, "expansion": unit}


SHARP = _exact(SQUARE, [[1, 0], [0, 1]])
UNIT = {"weights": ["1/2", "1/2"], "matrix": [["1", "0"], ["0", "1"]], "gap": "0"}
LOOSE = {"sigma_min": ["1/2", "2"], "sigma_max": ["1/2", "2"], "condition": ["0", "9"]}
BODY = machine([0, 1, 2], [(1, 0, 0), (0, 1, 0), (0, 0, 1)])
MINORS = {"weights": ["1/3"] * 3, "matrix": [["0", "0", "1"], ["0", "-1", "0"], ["1", "0", "0"]], "gap": "1/2"}
ALIKE = machine(FLAT, [(1, 0, 0), (1, 0, 0), (0, 1, 0)])
ALIKE |= {"wrench_polytope": wrench_polytope(ALIKE)}
"""Two legs in one line, of which one is said to be at the end where a product of -1 puts it."""
SHARP_ALIKE = _exact(ALIKE, [[1, 0], [1, 0], [0, 1]]) | {"wrench_polytope": ALIKE["wrench_polytope"]}
SINGLE = machine([0], [(1, 0, 0)])
SHARP_SINGLE = _exact(SINGLE, [[1]])
CORNER = machine(FLAT, [(1, 0, 0), (0, 1, 0), (3, 4, 0)], speeds=["1", "1", "7/5"])
"""The third side goes through two corners of the square."""
TWO = [{"sides": [[1, s], [2, -s]], "at": [[str(s - 1), str(s + 1)], [str(-s - 1), str(-s + 1)]]} for s in (1, -1)]
REST = {"facets": [[1, 1], [1, -1], [2, 1], [2, -1]], "vertices": TWO, "volume": None}
SLANTED = machine(
    FLAT,
    [],
    legs=[leg([-1, 0, 0]), leg([0, -1, 0]), leg([-1, -1, 0], direction=[1, 0, 0])],
    speeds=["1", "1", "2"],
)
WHETHER = "velocity_polytope: whether there is"
CORNERS = [{"sides": [[1, a], [2, b]], "at": [["-9", "9"]] * 2} for a in (1, -1) for b in (1, -1)] + [
    {"sides": [[k, a], [3, a]], "at": [["-9", "9"]] * 2} for k in (1, 2) for a in (1, -1)
]
ALL = {"facets": [[k, s] for k in (1, 2, 3) for s in (1, -1)], "vertices": CORNERS, "volume": None}
TINY = leg([-1, 0, 0], direction=[1 << 320, 0, 0])
SHARP_TINY = _exact(machine([0], [], legs=[TINY]), [[Fraction(1, 1 << 320)]])
"""A row of 2^-320."""
ROUND_TINY = [
    {"legs": [], "side": side, "normal": [[str(side)] * 2], "offset": [str(Fraction(1, 1 << 320))] * 2}
    for side in (1, -1)
]
SMALL_ROW = Fraction(3, 1 << 161)
SHARP_SMALL = _exact(machine([0], [], legs=[leg([-3, -1, 0], direction=[0, 1 << 161, 0])]), [[SMALL_ROW]])
FAINT = str(Fraction(1, 1 << 170))
MET: dict[str, Row] = {
    "corners on a side, dropped": (CORNER | {"velocity_polytope": REST}, "rejected", WHETHER),
    "corners on a side, dropped, exactly": (
        _exact(SLANTED, [[1, 0], [0, 1], [1, 1]]) | {"velocity_polytope": REST},
        "rejected",
        WHETHER,
    ),
    "corners on a side, listed for all pairs of sides, exactly": (
        _exact(SLANTED, [[1, 0], [0, 1], [1, 1]]) | {"velocity_polytope": ALL},
        "rejected",
        WHETHER,
    ),
    "wrenches of a row of 2^-320": (
        SHARP_TINY
        | {
            "wrench_polytope": {
                "facets": ROUND_TINY,
                "vertices": [[1], [-1]],
                "volume": [str(Fraction(1, 1 << 319))] * 2,
            }
        },
        "accepted",
        "wrench",
    ),
    "indices of a row of 3/2^161": (
        SHARP_SMALL
        | {"indices": {"sigma_min": [FAINT, "1"], "sigma_max": [FAINT, "1"], "condition": ["0", str(1 << 170)]}},
        "accepted",
        "indices",
    ),
    "a leg of 2^-160": (_only(machine([0], [(Fraction(1, 1 << 160), 0, 0)])), "accepted", "machine"),
    "forces of legs that may be dependent": (
        _wide(_only(CUT, "load", "actuator_forces"), "jacobian", (0, 0), ["-1", "2"])
        | {"jacobian": [[["-9", "9"], ["-9", "9"]]] * 3},
        "rejected",
        "actuator_forces: not decided",
    ),
    "corners that a side may cut off, dropped": (
        _wide(CORNER | {"velocity_polytope": REST}, "jacobian", (2, 0), ["1/2", "7/10"]),
        "rejected",
        WHETHER,
    ),
    "a disc, exactly": (SHARP | {"ellipsoid": UNIT}, "accepted", "ellipsoid"),
    "a disc, hardly too wide": (
        SHARP | {"ellipsoid": UNIT | {"matrix": [["1", "0"], ["0", "1" + 30 * "0" + "1/1" + 31 * "0"]]}},
        "rejected",
        "ellipsoid: may leave",
    ),
    "minors of 0": (BODY | {"ellipsoid": MINORS}, "rejected", POSITIVE),
    **{
        f"{name}, {key} {end}": (
            content | {"indices": LOOSE | {key: ["1", "2"] if end == "below" else ["1/2", "1"]}},
            "rejected",
            f"indices: {key} may be {end}",
        )
        for name, content in (
            ("exactly", SHARP),
            ("nearly", _only(SQUARE)),
            ("exactly one", SHARP_SINGLE),
            ("nearly one", SINGLE),
        )
        for key in ("sigma_min", "sigma_max")
        for end in ("below", "above")
    },
    "loose bounds": (SHARP | {"indices": LOOSE}, "accepted", "indices"),
    "legs in one line, nearly": (ALIKE, "rejected", "wrench_polytope: more legs"),
    "legs in one line, exactly": (SHARP_ALIKE, "rejected", "wrench_polytope: more legs"),
}

# The format


def _with(status: str, value: Any, *path: Any, content: Content = SQUARE) -> Row:
    return put(content, value, *path), status, ""


LONG = {digits: "1" + "0" * (digits - 1) for digits in (600, 601)}
MANY = _only(machine([0], [(1, 0, 0)] * 12))
FIVE = _only(GENERAL) | {"constraints": [["0"] * 17] * 6}
PLANES = LINE["wrench_polytope"]["facets"]
FACET, VERTEX = ("wrench_polytope", "facets", 0), ("velocity_polytope", "vertices", 0)
NO_TWISTS = {"velocity_polytope": {"facets": [], "vertices": [], "volume": None}}
NO_WRENCHES = {"wrench_polytope": {"facets": [], "vertices": [], "volume": ["0", "1"]}}


@cache
def _twelve(freedoms: int) -> Content:
    """Twelve legs with arms."""
    legs = [leg([k * k - 20, 3 * k - 40, 7], [k % 5, k % 3, k % 7]) for k in range(12)]
    return _only(machine(range(freedoms), [], legs=legs))


HELD = [{5: "1"}, {6: "1"}, {8: "1"}, {9: "1"}, {12: "1"}]
"""Forms that hold all components of a twist but the first."""
FORMAT: dict[str, Row] = {
    "5 constraints": (
        _only(
            machine(
                range(6),
                [(1, 0, 0)],
                constraints=[[form.get(k, "0") for k in range(17)] for form in HELD],
                free=[0],
            )
        ),
        "accepted",
        "machine",
    ),
    "no freedoms at all": (_only(machine([], [(1, 0, 0)])), "malformed", "freedoms"),
    "a freedom twice, and another": (
        _only(CUT)
        | {
            "freedoms": [0, 0, 1],
            "free": [0, 0, 1],
            "jacobian": [[["-9", "9"]] * 3] * 3,
            "expansion": [[["-9", "9"]] * 3] * 3,
        },
        "malformed",
        "freedoms",
    ),
    "one free component without a constraint": (
        _only(SQUARE) | {"free": [0], "jacobian": [[["-9", "9"]]] * 2, "expansion": [[["1", "1"]], [["-9", "9"]]]},
        "malformed",
        "free",
    ),
    "one leg for two free components": (_only(machine(FLAT, [(1, 0, 0)])), "malformed", "legs"),
    "a vertex of wrenches with -2": _with("malformed", [1, -2], "wrench_polytope", "vertices", 0),
    "legs of a facet twice, and another": (
        put(_four_legs(["0", "1000000"]), [1, 1, 2], *FACET, "legs"),
        "malformed",
        "wrench_polytope.facets[1].legs",
    ),
    "short legs": (_only(machine(FLAT, [(HALF, 0, 0), (0, HALF, 0)])), "accepted", "machine"),
    "twists of 59136 choices": (_twelve(6) | NO_TWISTS, "too-large", "velocity_polytope: too many"),
    "twists of 25344 choices": (_twelve(5) | NO_TWISTS, "too-large", "velocity_polytope: too many"),
    "wrenches of 50688 choices": (_twelve(6) | NO_WRENCHES, "too-large", "wrench_polytope: too many"),
    "wrenches of 15840 choices": (_twelve(5) | NO_WRENCHES, "rejected", "wrench_polytope"),
    "the last forces of one": _with("malformed", ["1", "1"], "forces", 1),
    "no speeds, for twists": (_only(SQUARE, "velocity_polytope") | {"speeds": None}, "malformed", ""),
    "no forces, for wrenches": (_only(SQUARE, "wrench_polytope") | {"forces": None}, "malformed", ""),
    "freedoms of 6, free": (_only(SQUARE) | {"freedoms": [0, 6], "free": [0, 6]}, "malformed", ""),
    "freedoms of 0 and false": (_only(SQUARE) | {"freedoms": [False, 1], "free": [0, 1]}, "malformed", ""),
    "12 legs": (MANY, "accepted", "machine"),
    "13 legs": (_only(machine([0], [(1, 0, 0)] * 13)), "too-large", "legs"),
    "6 constraints": (FIVE, "too-large", "constraints"),
    "version 3": _with("malformed", 3, "version"),
    "a solution": _with("accepted", {"digest": "sha256:0", "pose": 1}, "solution"),
    "a solution's pose 0": _with("malformed", {"digest": "sha256:0", "pose": 0}, "solution"),
    "a solution's pose in words": _with("malformed", {"digest": "sha256:0", "pose": "1"}, "solution"),
    "a solution's pose true": _with("malformed", {"digest": "sha256:0", "pose": True}, "solution"),
    "a solution's digest of no text": _with("malformed", {"digest": 1, "pose": 1}, "solution"),
    "a solution's digest of 10000 letters": _with("accepted", {"digest": "x" * 10000, "pose": 1}, "solution"),
    "a solution's digest of 10001 letters": _with("too-large", {"digest": "x" * 10001, "pose": 1}, "solution"),
    "a solution of more": _with("malformed", {"digest": "x", "pose": 1, "more": 1}, "solution"),
    "a name of no text": _with("malformed", 5, "name"),
    "a unit of no text": _with("malformed", 5, "unit"),
    "a name of 10000 letters": _with("accepted", "x" * 10000, "name"),
    "a name of 10001 letters": _with("too-large", "x" * 10001, "name"),
    "a metric of 0": _with("malformed", ["1", "0", "1"], "metric"),
    "a metric of -1": _with("malformed", ["1", "1", "-1"], "metric"),
    "a metric of a half": _with("malformed", ["1", "1", "1/2"], "metric"),
    "no freedoms": _with("malformed", [], "freedoms"),
    "freedoms out of order": _with("malformed", [1, 0], "freedoms"),
    "freedoms twice": _with("malformed", [0, 0], "freedoms"),
    "freedoms of 6": _with("malformed", [0, 6], "freedoms"),
    "freedoms of -1": _with("malformed", [-1, 0], "freedoms"),
    "freedoms of true": _with("malformed", [False, True], "freedoms"),
    "freedoms of no list": _with("malformed", 5, "freedoms"),
    "other freedoms free": _with("malformed", [0, 2], "free"),
    "fewer freedoms free": _with("malformed", [0], "free"),
    "no freedoms free": _with("malformed", [], "free"),
    "free out of order": _with("malformed", [1, 0], "free"),
    "free twice": _with("malformed", [0, 0], "free"),
    "free of true": _with("malformed", [False, True], "free"),
    "fewer legs than free": (
        SQUARE | {"legs": SQUARE["legs"][:1], "speeds": ["1"], "forces": [["-1", "1"]]},
        "malformed",
        "legs",
    ),
    "a direction of two": _with("malformed", ["1", "0"], "legs", 0, "direction"),
    "a base of two": _with("malformed", ["1", "0"], "legs", 0, "base"),
    "a leg of more": _with("malformed", SQUARE["legs"][0] | {"more": 1}, "legs", 0),
    "a form of 16": _with("malformed", ["1"] * 16, "constraints", 0, content=GENERAL),
    "constraints of no list": _with("malformed", None, "constraints"),
    "ends out of order": _with("malformed", ["1", "0"], "position", 0),
    "ends out of order, turned": _with("malformed", ["2", "1"], "rotation", 0, 0),
    "three ends": _with("malformed", ["0", "0", "0"], "position", 0),
    "one end": _with("malformed", ["0"], "position", 0),
    "four intervals": _with("malformed", [["0", "0"]] * 4, "position"),
    "a speed of 0": _with("malformed", ["1", "0"], "speeds"),
    "a negative speed": _with("malformed", ["-1", "1"], "speeds"),
    "a speed of 600 digits": _with("accepted", LONG[600], "speeds", 0, content=_only(SQUARE)),
    "a speed of 601 digits": _with("too-large", LONG[601], "speeds", 0),
    "a speed that is not in lowest terms": _with("malformed", "2/4", "speeds", 0),
    "three speeds": _with("malformed", ["1"] * 3, "speeds"),
    "no speeds": _with("malformed", None, "speeds"),
    "no forces": _with("malformed", None, "forces"),
    "no load": _with("malformed", None, "load"),
    "no speeds, for the ellipsoid": (_only(SQUARE, "ellipsoid") | {"speeds": None}, "malformed", "ellipsoid"),
    "no limits and claims": (_only(SQUARE) | {"speeds": None, "forces": None}, "accepted", "machine"),
    "no actuator forces": _with("malformed", None, "actuator_forces"),
    "forces of one": _with("malformed", ["1", "1"], "forces", 0),
    "forces out of order": _with("malformed", ["1", "-1"], "forces", 0),
    "a length of 0": _with("malformed", "0", "length"),
    "a negative length": _with("malformed", "-1", "length"),
    "a length of a half": _with("accepted", "1/2", "length"),
    "a load of three": _with("malformed", ["1"] * 3, "load"),
    "a row of three": _with("malformed", [["0", "1"]] * 3, "jacobian", 0),
    "three rows": _with("malformed", SQUARE["jacobian"] + SQUARE["jacobian"][:1], "jacobian"),
    "three rows of twists": _with("malformed", SQUARE["expansion"] + SQUARE["expansion"][:1], "expansion"),
    "a row of one": _with("malformed", [["0", "1"]], "expansion", 0),
    "side 0": _with("malformed", [1, 0], "velocity_polytope", "facets", 0),
    "leg 0": _with("malformed", [0, 1], "velocity_polytope", "facets", 0),
    "leg 3": _with("malformed", [3, 1], "velocity_polytope", "facets", 0),
    "side 2": _with("malformed", [1, 2], "velocity_polytope", "facets", 0),
    "a facet of three": _with("malformed", [1, 1, 1], "velocity_polytope", "facets", 0),
    "side 0 of a vertex": _with("malformed", [[1, 1], [2, 0]], *VERTEX, "sides"),
    "leg 3 of a vertex": _with("malformed", [[1, 1], [3, 1]], *VERTEX, "sides"),
    "legs of a vertex out of order": _with("malformed", [[2, 1], [1, 1]], *VERTEX, "sides"),
    "legs of a vertex twice": _with("malformed", [[1, 1], [1, -1]], *VERTEX, "sides"),
    "legs of a vertex of three twice": _with("malformed", [[1, 1], [1, 1], [2, 1]], *VERTEX, "sides", content=PLANE),
    "facets that are no list": _with("malformed", 5, "velocity_polytope", "facets"),
    "vertices that are no list": _with("malformed", 5, "velocity_polytope", "vertices"),
    "a constraint, and all components free": (_only(SQUARE) | {"constraints": [["0"] * 17]}, "malformed", "free"),
    "sides of a vertex, three": _with("malformed", [[1, 1], [2, 1], [2, -1]], *VERTEX, "sides"),
    "a vertex in three": _with("malformed", [["0", "1"]] * 3, *VERTEX, "at"),
    "no volume of twists": _with("malformed", None, "velocity_polytope", "volume"),
    "a volume of twists of more legs": _with("malformed", ["0", "9"], "velocity_polytope", "volume", content=CUT),
    "no volume of wrenches": _with("malformed", None, "wrench_polytope", "volume"),
    "no leg of a facet": _with("malformed", [], *FACET, "legs"),
    "two legs of a facet": _with("malformed", [1, 2], *FACET, "legs"),
    "leg 0 of a facet": _with("malformed", [0], *FACET, "legs"),
    "leg 3 of a facet": _with("malformed", [3], *FACET, "legs"),
    "legs of a facet out of order": _with("malformed", [2, 1], *FACET, "legs", content=PLANE),
    "legs of a facet twice": _with("malformed", [1, 1], *FACET, "legs", content=PLANE),
    "side 0 of a facet": _with("malformed", 0, *FACET, "side"),
    "side true of a facet": _with("malformed", True, *FACET, "side"),
    "side 2 of a facet": _with("malformed", 2, *FACET, "side"),
    "a normal of three": _with("malformed", [["0", "1"]] * 3, *FACET, "normal"),
    "a vertex of wrenches with 0": _with("malformed", [1, 0], "wrench_polytope", "vertices", 0),
    "a vertex of wrenches with 2": _with("malformed", [1, 2], "wrench_polytope", "vertices", 0),
    "a vertex of wrenches with three": _with("malformed", [1, 1, 1], "wrench_polytope", "vertices", 0),
    "4096 vertices": _with("rejected", [LINE["velocity_polytope"]["vertices"][0]] * 4096, *VERTEX[:2], content=LINE),
    "4097 vertices": _with("too-large", [LINE["velocity_polytope"]["vertices"][0]] * 4097, *VERTEX[:2], content=LINE),
    "4096 facets": _with("rejected", [[1, 1]] * 4096, "velocity_polytope", "facets", content=LINE),
    "4097 facets": _with("too-large", [[1, 1]] * 4097, "velocity_polytope", "facets", content=LINE),
    "4096 vertices of wrenches": _with("rejected", [[1, 1]] * 4096, "wrench_polytope", "vertices", content=LINE),
    "4097 vertices of wrenches": _with("too-large", [[1, 1]] * 4097, "wrench_polytope", "vertices", content=LINE),
    "4096 facets of wrenches": _with(
        "rejected", [LINE["wrench_polytope"]["facets"][0]] * 4096, *FACET[:2], content=LINE
    ),
    "4097 facets of wrenches": _with(
        "too-large", [LINE["wrench_polytope"]["facets"][0]] * 4097, *FACET[:2], content=LINE
    ),
    "three weights": _with("malformed", ["0", "1/2", "1/2"], "ellipsoid", "weights"),
    "a matrix of three": _with("malformed", [["1", "0"]] * 3, "ellipsoid", "matrix"),
    "a matrix of rows of three": _with("malformed", [["1", "0", "0"]] * 2, "ellipsoid", "matrix"),
    "a gap of 1": _with("malformed", "1", "ellipsoid", "gap"),
    "a negative gap": _with("malformed", "-1/9", "ellipsoid", "gap"),
    "a gap below 1": _with("accepted", "999/1000", "ellipsoid", "gap"),
    "bounds out of order": _with("malformed", ["2", "1"], "indices", "sigma_min"),
    "a negative bound": _with("malformed", ["-1", "2"], "indices", "sigma_min"),
    "an index of three": _with("malformed", ["1", "2", "3"], "indices", "condition"),
}
ROWS = merged(BOUNDS, LISTS, WIDE, ELLIPSOIDS, INDICES, MET, UNDECIDED, FORMAT)

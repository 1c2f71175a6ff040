"""Statics certificates of machines given by equations, honest ones and forgeries, with what checkers must say."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import Any

from forged_statics_boxes import Row, box_of_pose, intervals_of
from handmade_boxes import Content
from handmade_equations import claims, equation, form, machine
from tables_of_rows import merged, put

HALF = Fraction(1, 2)


def _crossed() -> Content:
    """Two slides, the second of which moves with the first one: J_q is not diagonal."""
    first = equation({4: 1}, {1: {16: 1}, 2: {16: HALF}})
    return machine(
        [0, 1],
        [0, 1],
        [first, equation({5: 1}, {2: {16: 1}})],
        actuators=["1", "4"],
        load=["1", "-2"],
        speeds=["1", "3/4"],
    )


def _general() -> Content:
    """Everything at once: a metric, a rotation, squares, all coefficients, rates in all equations but one."""
    random = Random(2095)  # a system that is far from singular

    def some() -> dict[int, Fraction]:
        return {k: Fraction(random.randint(1, 9), random.randint(1, 4)) * random.choice((1, -1)) for k in range(17)}

    equations = [
        equation(
            some(),
            None if k == 6 else {a: some() for a in ([k + 1, k + 2] if k < 4 else [5])},
            (HALF * (k + 1), some()) if k in (0, 3) else None,
        )
        for k in range(7)
    ]
    return machine(
        range(6),
        [0, 2, 3, 5],
        equations,
        metric=["2", "3", "5"],
        actuators=["1", "2", "3", "4/9", "5"],
        speeds=["1", "2", "1/2", "3", "1"],
        forces=[["1", "2"], ["-2", "1"], ["-3", "-1"], ["-1", "1"], ["0", "1"]],
        length="3",
        load=["1", "-2", "3", "1", "1", "-1"],
        **box_of_pose([0.5, -0.25, 0.75], [4, 1, -2, 1], 3e-15),
    )


def _forward() -> Content:
    """A point with three actuators: both coordinates, and one along the diagonal."""
    return machine(
        [0, 1],
        None,
        [equation({4: 2}, {1: {16: 2}, 3: {16: 1}}), equation({5: 1}, {2: {16: 1}, 3: {16: 1}})],
        actuators=["1", "1", "4"],
        speeds=["1", "1/2", "1/4"],
        forces=[["-1", "2"], ["-2", "1"], ["-1", "5"]],
        load=["1", "-3"],
    )


def _forward_turned() -> Content:
    """A plane in a metric with four actuators, one of them in all equations."""
    return machine(
        [0, 1, 5],
        None,
        [
            equation({4: 1, 7: HALF, 11: 1}, {1: {16: 1}, 4: {4: 1, 16: 1}}),
            equation({5: 1, 8: 1}, {2: {16: 1, 10: 1}, 4: {16: 2}}, (HALF, {4: 1, 16: 1})),
            equation({8: 1, 10: -1, 1: 1}, {3: {16: 1}, 4: {16: HALF}}),
        ],
        metric=["1", "3", "1"],
        actuators=["1", "3", "1", "2"],
        load=["1", "2", "-1"],
        **box_of_pose([0.25, 0.5, 0.0], [3, 0, 0, 1], 3e-15),
    )


HONEST = {
    "crossed": claims(_crossed(), [HALF, HALF]),
    "all at once": claims(_general()),
    "forward": claims(_forward()),
    "forward, turned": claims(_forward_turned()),
}
CROSSED, GENERAL, FORWARD, TURNED = HONEST.values()
CLAIMS = ("jacobian", "expansion", "actuator_forces", "velocity_polytope", "wrench_polytope", "indices")


def _bounds() -> Iterator[tuple[str, Row]]:
    """Of every claim the interval that ends, or begins, before what it should contain; of long lists the first ones."""
    for name, content in HONEST.items():
        every = [path for key in CLAIMS for path in intervals_of(content[key], (key,))]
        few = [path for path in every if path[0] in ("jacobian", "expansion", "actuator_forces")]
        short = name in ("crossed", "forward")
        for number, path in enumerate(every if short else few):
            low, high = map(Fraction, _entry(content, path))
            inside = (high - low) * Fraction(2, 5)
            for way, ends in (("below", (low, low + inside)), ("above", (high - inside, high))):
                if short or (way == "below") == (number % 2 == 0):
                    changed = put(content, list(map(str, ends)), *path)
                    yield f"{name}: {'.'.join(map(str, path))} {way}", (changed, "rejected", str(path[0]))


def _entry(content: Content, path: tuple[Any, ...]) -> Any:
    found: Any = content
    for key in path:
        found = found[key]
    return found


def _moved(content: Content, *path: Any) -> Content:
    """With another number there."""
    return put(content, str(Fraction(_entry(content, path)) + 1), *path)


def _numbers() -> Iterator[tuple[str, Row]]:
    """Each number of a form, of the form of a square and of rates, as P and E are those of others.

    The last three equations alone, with the last actuator, say what E is.
    """
    places = [("equations", 3, "form"), ("equations", 3, "square", "form"), ("equations", 3, "rates", 1, 1)]
    for place in places:
        for k in range(17):
            honest = len(place) == 3 and k == 16
            row = ("accepted", "indices") if honest else ("rejected", "jacobian: an entry")
            yield f"all at once: {'.'.join(map(str, place))} {k}", (_moved(GENERAL, *place, k), *row)
    ways = (("equations", 0, "square", "factor"), ("actuators", 0), ("actuators", 4), ("equations", 0, "form", 2))
    for path in ways:
        yield f"all at once: {'.'.join(map(str, path))}", (_moved(GENERAL, *path), "rejected", "jacobian: an entry")
    ways = (*(("metric", k) for k in range(3)), ("equations", 4, "form", 9))
    for path in (*ways, ("equations", 6, "form", 0), ("equations", 5, "rates", 0, 1, 3)):
        yield f"all at once: {'.'.join(map(str, path))}", (_moved(GENERAL, *path), "rejected", "expansion: an entry")
    for path in (("actuators", 2), ("equations", 0, "rates", 1, 1, 16), ("equations", 0, "form", 4)):
        yield f"forward: {'.'.join(map(str, path))}", (_moved(FORWARD, *path), "rejected", "expansion: an entry")
    for path in (("actuators", 1), ("equations", 0, "rates", 1, 1, 16)):
        yield f"crossed: {'.'.join(map(str, path))}", (_moved(CROSSED, *path), "rejected", "jacobian: an entry")


def _without(content: Content, **entries: Any) -> Content:
    return content | dict.fromkeys(("velocity_polytope", "wrench_polytope", "ellipsoid", "indices")) | entries


LOCKED = machine([0, 1], [0, 1], [equation({4: 1}, {1: {16: 1}}), equation({}, {2: {16: 1}})], actuators=["1", "1"])
"""An actuator that the platform does not move: W has a row of zeros, type 2."""
STUCK = machine([0, 1], None, [equation({4: 1}, {1: {16: 1}}), equation({5: 1}, {1: {16: 1}})], actuators=["1", "1"])
"""Both components move alike, and an actuator nothing: type 1."""
NOTHING = put(CROSSED, form({}), "equations", 1, "rates", 0, 1)
FLAT = _without(FORWARD, equations=[equation({4: 1}, {1: {16: 1}}), equation({4: 1}, {2: {16: 1}})])
TYPE_1, TYPE_2 = "regular: a singularity of type 1", "regular: a singularity of type 2"
UNSOLVED = "equations: twist and speeds"
REGULAR: dict[str, Row] = {
    **{
        f"honest, {name}": (content, "accepted", ("wrench" if "forward" in name else "indices"))
        for name, content in HONEST.items()
    },
    "type 2, said": (put(LOCKED, False, "regular"), "accepted", "machine: 2 actuators in a box of poses, 2 freedoms"),
    "type 2, denied": (LOCKED, "rejected", TYPE_2),
    "type 1, said": (put(STUCK, False, "regular"), "accepted", "machine: 2 actuators move 2 freedoms"),
    "type 1, denied": (STUCK, "rejected", TYPE_1),
    "regular, not said": (put(CROSSED, False, "regular"), "accepted", "indices"),
    "an actuator in no equation": (NOTHING, "rejected", UNSOLVED),
    "wrenches that are dependent": (FLAT, "rejected", UNSOLVED),
}


def _lists(content: Content, where: str) -> Iterator[tuple[str, Row]]:
    found = content[where]
    for what in ("facets", "vertices"):
        for name, entries in (("dropped", found[what][1:]), ("twice", [*found[what], found[what][0]])):
            yield f"{where}: one of the {what} {name}", (put(content, entries, where, what), "rejected", where)


SWAPPED = CROSSED["velocity_polytope"], CROSSED["wrench_polytope"]
TWELVE = [str(k + 1) for k in range(12)]


def _sized(actuators: int, equations: int) -> Content:
    """So many of both, which is all that is wrong."""
    content = _without(CROSSED, load=None, actuator_forces=None)
    return content | {"actuators": ["1"] * actuators, "equations": [equation({4: 1})] * equations}


def _with(value: Any, *path: Any, content: Content = CROSSED, status: str = "malformed", line: str = "") -> Row:
    return put(content, value, *path), status, line or str(path[0])


FORM = CROSSED["equations"][0]["form"]
RATE = CROSSED["equations"][0]["rates"][0]
FORMAT: dict[str, Row] = {
    "a name that is none": _with(7, "name"),
    "a unit that is none": _with(None, "unit"),
    "a long name": _with("x" * 10001, "name", status="too-large"),
    "a long unit": _with("x" * 10001, "unit", status="too-large"),
    "another format": _with("pkm_exact statics", "format", line="format"),
    "from a certificate": _with({"digest": "sha256:", "pose": 1}, "solution", status="accepted", line="indices"),
    "from pose true": _with({"digest": "sha256:", "pose": True}, "solution"),
    "from pose 0": _with({"digest": "sha256:", "pose": 0}, "solution"),
    "a long digest of a solution": _with({"digest": "x" * 10001, "pose": 1}, "solution", status="too-large"),
    "a metric that is not positive": _with(["1", "0", "1"], "metric"),
    "freedoms twice": _with([0, 0], "freedoms"),
    "no freedoms": _with([], "freedoms"),
    "freedoms beyond six": (CROSSED | {"freedoms": [0, 6], "free": [0, 6]}, "malformed", "freedoms"),
    "free ones that are none": _with([0, 2], "free"),
    "no free ones": _with([], "free"),
    "too few free ones": _with([0], "free", line="equations"),
    "a position of two": _with([["0", "0"]] * 2, "position"),
    "a rotation of two rows": _with([[["0", "0"]] * 3] * 2, "rotation"),
    "a rotation of short rows": _with([[["0", "0"]] * 2] * 3, "rotation"),
    "ends that are not in order": _with(["1", "0"], "position", 0),
    "actuators that are none": _with(7, "actuators"),
    "equations that are none": _with(7, "equations"),
    "an actuator of 0": _with("0", "actuators", 0),
    "an actuator below 0": _with("-1", "actuators", 1),
    "an actuator that is no number": _with(1, "actuators", 0),
    "twelve actuators": (_sized(12, 12), "malformed", "speeds"),
    "thirteen actuators": (_sized(13, 13), "too-large", "actuators"),
    "eighteen equations": (_sized(2, 18), "malformed", "equations: not"),
    "nineteen equations": (_sized(2, 19), "too-large", "equations"),
    "an equation too few": _with(CROSSED["equations"][:1], "equations"),
    "an equation of other keys": _with({"form": FORM, "rates": [], "square": None}, "equations", 0),
    "a form of 16": _with(FORM[:-1], "equations", 0, "form"),
    "a form of numbers": _with([*FORM[:-1], 0], "equations", 0, "form"),
    "a square without factor": _with({"form": FORM}, "equations", 0, "square"),
    "a factor of 0": _with({"factor": "0", "form": FORM}, "equations", 0, "square"),
    "a square of 16": _with({"factor": "1", "form": FORM[:-1]}, "equations", 0, "square"),
    "less a square of nothing": _with(
        {"factor": "-1", "form": form({})}, "equations", 0, "square", status="accepted", line="indices"
    ),
    "a square of nothing": _with(
        {"factor": "1", "form": form({})}, "equations", 0, "square", status="accepted", line="indices"
    ),
    "rates that are none": _with(None, "equations", 0, "rates"),
    "a rate of actuator 0": _with([0, RATE[1]], "equations", 0, "rates", 0),
    "a rate of actuator 3": _with([3, RATE[1]], "equations", 0, "rates", 1),
    "a rate of an actuator that is no number": _with([True, RATE[1]], "equations", 0, "rates", 0),
    "rates in another order": _with(CROSSED["equations"][0]["rates"][::-1], "equations", 0, "rates"),
    "a rate twice": _with([RATE, RATE], "equations", 0, "rates"),
    "rates of more than all": _with([RATE] * 3, "equations", 0, "rates"),
    "a rate twice, and another": _with([RATE, RATE, [2, RATE[1]]], "equations", 0, "rates"),
    "a rate by names": _with({"a": 1, "b": RATE[1]}, "equations", 0, "rates", 0),
    "a rate of three": _with([*RATE, "1"], "equations", 0, "rates", 0),
    "a rate without form": _with(RATE[:1], "equations", 0, "rates", 0),
    "a rate that is no list": _with({"1": RATE[1]}, "equations", 0, "rates", 0),
    "a rate that is a number": _with(5, "equations", 0, "rates", 0),
    "forward: a rate twice, and another": _with([RATE, RATE, [2, RATE[1]]], "equations", 0, "rates", content=FORWARD),
    "a rate of 16": _with([1, RATE[1][:-1]], "equations", 0, "rates", 0),
    "speeds of three": _with(["1"] * 3, "speeds"),
    "a speed of 0": _with(["1", "0"], "speeds"),
    "forces of one": _with([["0", "1"]], "forces"),
    "forces without range, the first": _with([["1", "1"], ["0", "1"]], "forces"),
    "forces without range": _with([["0", "1"], ["1", "1"]], "forces"),
    "a length that nothing needs": _with("1/2", "length", status="accepted", line="indices"),
    "a length of 0": _with("0", "length"),
    "a load of three": _with(["1"] * 3, "load"),
    "regular by a number": _with(1, "regular"),
    "regular by a word": _with("true", "regular"),
    "regular, null": _with(None, "regular"),
    "no jacobian": _with(None, "jacobian"),
    "a jacobian of one row": _with(CROSSED["jacobian"][:1], "jacobian"),
    "a jacobian of short rows": _with([row[:1] for row in CROSSED["jacobian"]], "jacobian"),
    "an expansion of one row": _with(CROSSED["expansion"][:1], "expansion"),
    "an expansion of short rows": _with([row[:1] for row in CROSSED["expansion"]], "expansion"),
    "no forces for the load": _with(None, "actuator_forces"),
    "forces without load": _with(None, "load", line="actuator_forces"),
    "a polytope without speeds": _with(None, "speeds", line="velocity_polytope"),
    "a polytope alone without speeds": (
        _without(CROSSED, speeds=None, velocity_polytope=SWAPPED[0]),
        "malformed",
        "velocity_polytope",
    ),
    "an ellipsoid without speeds": (
        _without(CROSSED, speeds=None, ellipsoid=CROSSED["ellipsoid"]),
        "malformed",
        "ellipsoid",
    ),
    "a polytope without forces": _with(None, "forces", line="wrench_polytope"),
    "sums for bounds": _with(SWAPPED[1], "velocity_polytope"),
    "bounds for sums": _with(SWAPPED[0], "wrench_polytope"),
    "forward: sums for bounds": _with(
        FORWARD["velocity_polytope"] | {"facets": [], "volume": None}, "wrench_polytope", content=FORWARD
    ),
    "forward: bounds for sums": _with(FORWARD["wrench_polytope"], "velocity_polytope", content=FORWARD),
    "forward: a jacobian": _with(CROSSED["jacobian"], "jacobian", content=FORWARD),
    "forward: an ellipsoid": _with(CROSSED["ellipsoid"], "ellipsoid", content=FORWARD, line=""),
    "forward: indices": _with(CROSSED["indices"], "indices", content=FORWARD, line=""),
    "forward: an equation too few": _with(FORWARD["equations"][:1], "equations", content=FORWARD),
    "forward: an equation too many": _with(
        [*FORWARD["equations"], FORWARD["equations"][0]], "equations", content=FORWARD
    ),
    "freedoms of 6": (_without(CROSSED, freedoms=[0, 6], free=[0, 6]), "malformed", "freedoms"),
    "actuators that are no list": _with(5, "actuators"),
    "equations that are no list": _with(5, "equations"),
    "a polytope of twists alone, without speeds": (
        _without(CROSSED, speeds=None, velocity_polytope=CROSSED["velocity_polytope"]),
        "malformed",
        "velocity_polytope",
    ),
    "forward: no limits": (_without(FORWARD, speeds=None, forces=None), "accepted", "forces: those that bear the load"),
}
FEW = machine([0, 1], None, [equation({4: 1}, {1: {16: 1}}), equation({5: 1})], actuators=["1"], regular=False)
"""An actuator for two freedoms, the second of which a constraint takes: twists are a segment, which is no zonotope."""
NO_SEGMENT = {"facets": [], "vertices": [], "volume": ["0", "0"]}
FORMAT["forward: fewer actuators than freedoms"] = (FEW, "malformed", "actuators: fewer")
FORMAT["forward: a segment without ends"] = (FEW | {"velocity_polytope": NO_SEGMENT}, "malformed", "actuators: fewer")
ONE = machine([0], [0], [equation({4: 1}, {1: {16: 1}})], actuators=["1"], speeds=["1"])
FORMAT["fewer actuators than free components"] = (
    _sized(1, 1) | {"freedoms": [0, 1], "speeds": ["1"], "forces": [["0", "1"]]},
    "malformed",
    "actuators: fewer",
)
FORMAT["one of all"] = (claims(ONE, [1]), "accepted", "indices")


def _twelve(freedoms: int, number: int = 12, **entries: Any) -> Content:
    """Twelve actuators, or so many, of a point or body in general position, nothing claimed but a polytope."""
    content = machine(
        range(freedoms),
        None,
        [
            equation({4 + k if k < 3 else (12, 13, 8)[k - 3]: 1}, {a + 1: {16: (a + 2) ** k} for a in range(number)})
            for k in range(freedoms)
        ],
        actuators=["1"] * number,
    )
    return content | entries


_LINED = machine(
    range(6),
    [0],
    [equation({k: 1}) for k in (5, 6, 12, 13, 8)] + [equation({4: 13 - a}, {a + 1: {16: 1}}) for a in range(12)],
    actuators=["1"] * 12,
    length="1",
)
"""Twelve actuators, and a rail that leaves one freedom: few choices."""
NO_BOUNDS, NO_SUMS = (
    {"facets": [], "vertices": [], "volume": None},
    {"facets": [], "vertices": [], "volume": ["0", "1"]},
)
MANY = machine(
    range(6),
    [0, 1],
    [equation({k: 1}) for k in (6, 8, 9, 12)] + [equation({4: 1, 5: a}, {a: {16: 1}}) for a in range(1, 13)],
    actuators=["1"] * 12,
)
"""A body of two freedoms, of which twelve actuators make one each."""
SIZES: dict[str, Row] = {
    "twelve of two that are free: bounds": (
        MANY | {"velocity_polytope": NO_BOUNDS},
        "rejected",
        "velocity_polytope: whether",
    ),
    "a larger ellipsoid": (_moved(CROSSED, "ellipsoid", "matrix", 0, 0), "rejected", "ellipsoid"),
    "twelve in six: bounds": (_twelve(6, wrench_polytope=NO_BOUNDS), "too-large", "wrench_polytope: too many choices"),
    "twelve in six: sums": (_twelve(6, velocity_polytope=NO_SUMS), "too-large", "velocity_polytope: too many choices"),
    "eleven in six: sums": (
        _twelve(6, 11, velocity_polytope=NO_SUMS),
        "too-large",
        "velocity_polytope: too many choices",
    ),
    "twelve in five: sums": (_twelve(5, velocity_polytope=NO_SUMS), "rejected", "velocity_polytope: not all facets"),
    "twelve in five: bounds": (_twelve(5, wrench_polytope=NO_BOUNDS), "too-large", "wrench_polytope: too many choices"),
    "twelve along a line in six": (claims(_LINED), "accepted", "indices"),
    "twelve in six: nothing": (_twelve(6), "accepted", "singularities"),
}


def _sharp(third: list[str], vertices: list[tuple[int, int, int, int]]) -> Content:
    """A square of wrenches that a third actuator touches in a corner: without width, so that it is met exactly."""
    both = equation({4: 1}, {1: {16: 1}, 3: {16: 1}}), equation({5: 1}, {2: {16: 1}, 3: {16: 1}})
    content = machine([0, 1], None, list(both), actuators=["1"] * 3, forces=[["-1", "1"], ["-1", "1"], third])
    sides = [[[leg, side], [other, way]] for leg, side, other, way in vertices]
    return content | {
        "expansion": [[[x, x] for x in row] for row in (("1", "0", "1"), ("0", "1", "1"))],
        "wrench_polytope": {
            "facets": [list(side) for side in sorted({tuple(side) for pair in sides for side in pair})],
            "vertices": [{"sides": pair, "at": [["-9", "9"]] * 2} for pair in sides],
            "volume": None,
        },
    }


CORNERS = [(1, a, 2, b) for a in (-1, 1) for b in (-1, 1)]
TOUCHED: dict[str, Row] = {
    f"a corner that is met at the {name}, {what}": (
        _sharp(third, corners),
        "rejected",
        "wrench_polytope: whether there is",
    )
    for name, third, side in (("greatest", ["-5", "2"], 1), ("least", ["-2", "5"], -1))
    for what, corners in (
        ("as it were inside", [*CORNERS, (1, side, 3, side), (2, side, 3, side)]),
        ("as it were outside", [corner for corner in CORNERS if corner != (1, side, 2, side)]),
    )
}
TOUCHED["a corner that is not met"] = (_sharp(["-5", "3"], CORNERS), "accepted", "wrench polytope: 4 vertices")


def _scaled(factor: Fraction, **entries: Any) -> Content:
    found = CROSSED["ellipsoid"]
    matrix = [[str(Fraction(x) * factor) for x in row] for row in found["matrix"]]
    return put(CROSSED, found | {"matrix": matrix} | entries, "ellipsoid")


ELLIPSOIDS: dict[str, Row] = {
    "an ellipsoid that leaves the polytope": (_scaled(1 + Fraction(1, 10**4)), "rejected", "ellipsoid: may leave"),
    "an ellipsoid that is too small": (_scaled(Fraction(1, 2)), "rejected", "ellipsoid: not proved"),
    "weights of more than 1": (_scaled(Fraction(1), weights=["1", "1/2"]), "rejected", "ellipsoid: weights"),
}
LISTS = {
    f"{name}, {key}": row
    for name in ("crossed", "forward")
    for where in ("velocity_polytope", "wrench_polytope")
    for key, row in _lists(HONEST[name], where)
}
SLOW = frozenset(name for name in dict(_numbers()) if name.endswith(("1", "2", "4", "5", "7", "8")))
ROWS = merged(REGULAR, dict(_bounds()), dict(_numbers()), LISTS, TOUCHED, ELLIPSOIDS, FORMAT, SIZES)

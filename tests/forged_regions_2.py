"""Region certificates of version 2 made by hand, with what both checkers must say of them."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from fractions import Fraction
from math import prod, sqrt
from random import Random
from typing import Any

from forged_regions import (
    BEYOND,
    BROKEN,
    COPLANAR,
    CRANK,
    FREE,
    GOOD,
    INSIDE,
    NO_FAILURE,
    OUTSIDE,
    PUSHED,
    Row,
    as_map,
    pointed,
)
from handmade_regions import (
    CIRCLES,
    Content,
    Placed,
    chart_of,
    leg,
    limits_of,
    part,
    point_of,
    put,
    random_legs,
    region,
    second,
    texts,
    vector,
)
from tables_of_rows import merged
from tables_of_rows import put as changed

NOT_MEMBER = "member: is not proved to be in the region"

# Distances of legs

PAIRS = ("ll", "ls", "sl", "ss", "lc", "cl", "sc", "cs", "cc")
CHARTS = ("quaternion x", "yaw y", "turns z", "pitch x")
_ENDS = {(s, t) for s in (0.0, 1.0) for t in (0.0, 1.0)}


def _category(shares: tuple[float, float]) -> Any:
    """Where two legs are nearest: at which ends, at the end of which leg, or inside of both."""
    if shares in _ENDS:
        return shares
    found = tuple(x if x in (0.0, 1.0) else None for x in shares)
    near = any(x is None and not 0.05 < y < 0.95 for x, y in zip(found, shares, strict=True))
    return "unclear" if near else found


def distance_rows() -> Iterator[tuple[str, Row]]:
    """Legs that are just as far apart as they must be, or not, wherever they are nearest."""
    for number, types in enumerate(PAIRS):
        seen: set[Any] = set()
        for seed in range(400):
            random = Random(7000 + 400 * number + seed)
            metric = [1, 1, 1] if "c" in types else random.choice([[2, 3, 5], [1, 3, 1]])
            kind = "quaternion x" if "c" in types else CHARTS[seed % 4]
            content = region(metric=metric, **chart_of(kind, "spatial", random))
            random_legs(types, content, random)
            placed = Placed(content, point_of(content))
            if not placed.reached or min(placed.dot(rod, rod) for rod in placed.rods) < 0.1:
                continue
            distance, shares, way = placed.distance(0, 1)
            where = _category(shares)
            if distance < 0.5 or where == "unclear" or where in seen:
                continue
            seen.add(where)
            yield from _apart(f"{types} nearest at {where}", content, distance, way)
            if len(seen) == 6:
                break
        assert len(seen) == 6, (types, seen)


def _apart(name: str, content: Content, distance: float, way: list[float]) -> Iterator[tuple[str, Row]]:
    least = Fraction(distance).limit_denominator(1 << 20)
    covector = [Fraction(x / distance).limit_denominator(1 << 30) for x in way]
    g = content["robot"]["metric"]
    size = Fraction(sqrt(sum(c * c / Fraction(x) for c, x in zip(covector, g, strict=True)))) + Fraction(1, 1 << 30)
    direction = texts([*covector, size])
    near, far = least * Fraction(99, 100), least * Fraction(101, 100)
    good, bad = (second(content, leg_distance=d, directions=[None]) for d in (near, far))
    yield name, (good, "accepted", GOOD)
    yield f"{name}, fails", (_pointed(good), "rejected", NO_FAILURE)
    yield f"{name}, not, fails", (_pointed(bad), "accepted", BROKEN)
    yield f"{name}, not, outside", (_as_map(bad, "o"), "accepted", "")
    yield f"{name}, not, by a direction", (bad | {"directions": [direction]}, "rejected", INSIDE)


def _pointed(content: Content) -> Content:
    return pointed(content) | {"member": []}


def _as_map(content: Content, word: str) -> Content:
    found = as_map(content, word) | {"member": []}
    if word == "i" and found["measure"] is not None:
        size = prod((Fraction(high) - Fraction(low) for low, high in content["chart"]["box"]), start=Fraction(1))
        found["measure"] = [str(size)] * 2
    return found


# Curves, rods along an axis, joint values

CURVES = (
    ([1], [3, 2], ["1/2", -1], [0, 1, 2]),
    ([1, 0, 1], [4, 1, 2], [1, 2, -1], [3, 0, "1/3"]),
    ([2, 0, 0, 0, 1], [1], [0, 0, 0, 1, 1], [2, 1]),
)


def curve_rows() -> Iterator[tuple[str, Row]]:
    """Limits that hold or do not at a place of a curve."""
    for seed, (path, types, turned) in enumerate(zip(CURVES, ("lsc", "lc", "sl"), (False, True, False), strict=True)):
        random = Random(500 + seed)
        low = Fraction(random.randint(-9, 9), 7)
        chart = {"variables": ["along"], "box": [[low, low + Fraction(1, 1 << 14)]], "place": [0, 0, 0]}
        chart |= {"turns": [[1, 0], [3, 1], [2, -1]]} if turned else {"quaternion": [3, 1, 0, -2]}
        content = second(region(metric=[1, 1, 1], **chart), path=path)
        yield from _limited_rows(f"curve {seed}", content, types, random)


def _limited_rows(name: str, content: Content, types: str, random: Random) -> Iterator[tuple[str, Row]]:
    random_legs(types, content, random)
    content["robot"]["legs"] = [entry | {"axis": entry.get("axis")} for entry in content["robot"]["legs"]]
    good, bad = limits_of(content, random)
    for where, value in good:
        put(content, where, value)
    assert min(Placed(content, point_of(content)).margins()) > 0
    yield f"{name}: all hold", (content, "accepted", GOOD)
    for number, (where, value) in enumerate(bad):
        wrong = deepcopy(content)
        put(wrong, where, value)
        assert min(Placed(wrong, point_of(wrong)).margins()) < 0
        yield f"{name}: {number}", (wrong, "rejected", INSIDE)
        yield f"{name}: {number} fails", (_pointed(wrong), "accepted", BROKEN)


def axis_rows() -> Iterator[tuple[str, Row]]:
    """Rods that slide along an axis: limits of what moves them hold, or do not."""
    for seed, kind in enumerate(("crank", "slide", "crank", "slide")):
        random = Random(600 + seed)
        metric = [1, 1, 1] if kind == "crank" else [2, 3, 5]
        content = region(metric=metric, **chart_of("turns x" if seed < 2 else "quaternion y", "spatial", random))
        if kind == "crank":
            u, v, w = CIRCLES[0]
            axis = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
            actuator: Content = {"u": u, "v": v, "weight": w, "rod": 0}
        else:
            d, axis = vector(random), vector(random)
            share = sum(g * a * b for g, a, b in zip(metric, d, axis, strict=True)) / sum(
                g * a * a for g, a in zip(metric, d, strict=True)
            )
            axis = [a - share * b for a, b in zip(axis, d, strict=True)]
            actuator = {"direction": d, "rod": 0}
        entry = leg(vector(random), vector(random), **(actuator | {"rod": 400}))
        content["robot"]["legs"], content["modes"] = [entry], [1 - 2 * (seed % 2)]
        content = second(content, leg_axes=[axis])
        placed = Placed(content, point_of(content))
        assert placed.reached == (kind == "slide")
        if kind == "crank":  # a rod that is as long as it must be for the crank to stand somewhere
            entry["actuator"]["rod_squared"] = str(_near(content))
            content = second(region_like(content, entry), leg_axes=[axis])
            placed = Placed(content, point_of(content))
        assert placed.reached
        yield f"axis {seed}: reached", (content | {"conditions": ["reachable", "no_type_1"]}, "accepted", GOOD)
        good, bad = limits_of(content, random)
        for where, value in good:
            if "cones" not in str(where[0]):
                put(content, where, value)
        yield f"axis {seed}: all hold", (content, "accepted", GOOD)
        for number, (where, value) in enumerate(bad):
            if "cones" in str(where[0]):
                continue
            wrong = deepcopy(content)
            put(wrong, where, value)
            yield f"axis {seed}: {number}", (wrong, "rejected", INSIDE)
            yield f"axis {seed}: {number} fails", (_pointed(wrong), "accepted", BROKEN)


def region_like(content: Content, entry: Content) -> Content:
    """The certificate of version 1 with this leg."""
    found = deepcopy(content) | {"version": 1}
    for key in ("member", "tube", "joints", "directions"):
        found.pop(key)
    found["chart"].pop("path")
    found["robot"].pop("leg_distance")
    found["robot"]["legs"] = [entry]
    return found


def _near(content: Content) -> Fraction:
    """The squared distance from the platform's end to the crank at some angle, across the axis."""
    found = deepcopy(content)
    found["robot"]["legs"][0]["actuator"] = {"type": "length"}
    placed = Placed(found, point_of(found))
    u = [float(Fraction(x)) for x in content["robot"]["legs"][0]["actuator"]["at_0"]]
    rod = [x - y for x, y in zip(placed.rods[0], u, strict=True)]
    return Fraction(placed.dot(rod, rod)).limit_denominator(50)


def joint_rows() -> Iterator[tuple[str, Row]]:
    """Joint values as a part of what the region is."""
    for seed, types in enumerate(("lsc", "cl", "ss")):
        random = Random(800 + seed)
        content = region(metric=[1, 1, 1], **chart_of(("quaternion x", "turns y", "yaw y")[seed], "spatial", random))
        for _ in range(40):
            random_legs(types, content, random)
            good, bad = limits_of(content, random)
            reaches = [(where, value) for where, value in good if where[0] == "legs"]
            if len(reaches) == len(types):
                break
        joints = [value for _, value in reaches]
        content["conditions"] = ["reachable"]
        found = second(content, joints=joints, member=point_of(content))
        yield f"joints {seed}", (found, "accepted", GOOD)
        yield f"joints {seed}: inside", (_as_map(found, "i"), "accepted", "")
        yield f"joints {seed}: outside", (_as_map(found, "o"), "rejected", OUTSIDE)
        for number, (where, value) in enumerate(bad):
            if where[0] != "legs":
                continue
            wrong = deepcopy(found)
            wrong["joints"][where[1]] = value
            yield f"joints {seed}: {number}", (wrong, "rejected", NOT_MEMBER)
            yield f"joints {seed}: {number}, outside", (_as_map(wrong, "o"), "accepted", "")
            yield f"joints {seed}: {number}, inside", (_as_map(wrong, "i"), "rejected", INSIDE)
            yield f"joints {seed}: {number}, pointed", (_pointed(wrong), "rejected", BEYOND)
            broken = deepcopy(wrong)
            broken["robot"]["legs"][where[1]]["reach"] = value
            broken["conditions"] = ["limits"]
            yield f"joints {seed}: {number}, beyond, good", (broken, "rejected", NOT_MEMBER)
            broken = deepcopy(found) | {"conditions": ["limits"]}
            broken["robot"]["legs"][where[1]]["reach"] = value
            yield f"joints {seed}: {number}, within, bad", (_pointed(broken), "accepted", BROKEN)


# Tubes


def tube_rows() -> Iterator[tuple[str, Row]]:
    """Places a little inside of a tube and outside of it: near a corner, and beside each piece."""
    g = [1, 4, 9]
    corners = [[0, 0, 0], [4, 0, 0], [4, 2, 0], [4, 2, "-5/3"]]
    radius = Fraction(1)
    box = [[-1, 5], ["-1/2", "5/2"], [-2, "1/3"]]
    base = region(
        [leg((100, 0, 0), (0, 0, 0), (0, 1))],
        metric=g,
        variables=["x", "y", "z"],
        place=["x", "y", "z"],
        box=box,
    )
    tube = {"corners": texts(corners), "radius": str(radius)}
    far = second(base, tube=tube)
    sides = {
        "the first corner": ([0, 0, 0], [-1, 0, 0]),
        "the last corner": ([4, 2, "-5/3"], [0, 0, -1]),
        "the first piece": ([2, 0, 0], [0, 0, 1]),
        "the second piece": ([4, 1, 0], [1, 0, 0]),
        "the third piece": ([4, 2, -1], [0, 1, 0]),
    }
    step = Fraction(1, 1000)
    for name, (place, way) in sides.items():
        ends = [
            [Fraction(c) + Fraction(w) * size / root for c, w, root in zip(place, way, (1, 2, 3), strict=True)]
            for size in (radius - step, radius + step)
        ]
        inside = _pointed(far) | {"counterexample": [texts(ends[0])]}
        yield f"in a tube, {name}", (inside, "accepted", BROKEN)
        yield f"out of a tube, {name}", (inside | {"counterexample": [texts(ends[1])]}, "rejected", BEYOND)
        member = second(base, tube=tube, member=ends[0])
        member["robot"]["legs"][0]["reach"] = None
        yield f"a member of a tube, {name}", (member, "accepted", GOOD)
        wrong = deepcopy(member) | {"member": texts(ends[1])}
        yield f"no member of a tube, {name}", (wrong, "rejected", NOT_MEMBER)
        yield f"beyond the box, {name}", (deepcopy(member) | {"member": ["6", "0", "0"]}, "rejected", NOT_MEMBER)
    for k in range(3):
        for side in range(2):
            narrow = deepcopy(member)
            end = Fraction(narrow["chart"]["box"][k][side])
            narrow["chart"]["box"][k][side] = str(end + (1 - 2 * side) * step)
            yield f"a box that cuts a tube, {k}, {side}", (narrow, "rejected", "tube: the box does not hold it")
    crossing = deepcopy(member)
    crossing["chart"]["box"][0] = ["-1", "-3/4"]
    yield "a box at the side of a tube", (crossing, "rejected", "tube: the box does not hold it")
    yield from _paved_tubes(second(base, tube=tube))


def _paved_tubes(content: Content) -> Iterator[tuple[str, Row]]:
    """Parts that lie inside of a tube, or beyond it."""
    content["chart"]["variables"], content["chart"]["position"] = ["x"], ["x", "0", "0"]
    content["tube"] = {"corners": texts([[0, 0, 0], [4, 0, 0]]), "radius": "1"}
    content["robot"]["legs"][0]["reach"] = None
    content["chart"]["box"] = texts([[-1, 7]])  # the tube is from -1 to 5
    rows = (
        ("its parts", "ssiisisuo", ["6", "7"], "accepted", "measure"),
        ("a larger measure", "ssiisisuo", ["7", "7"], "rejected", "measure"),
        ("outside that is inside", "ssioiu", ["0", "0"], "rejected", "paving: the part of letter 4"),
        ("inside that is outside", "ssiisuisui", ["0", "0"], "rejected", "paving: "),
        ("no part of it forgotten", "siso", ["0", "0"], "rejected", "paving: the part of letter 2"),
        ("a part forgotten", "ssiisisu", ["6", "7"], "rejected", "paving: parts of the region are missing"),
    )
    for name, word, measure, status, line in rows:
        undecided = {"undecided": word.count("u"), "axes": [0] * 4, "measure": measure}
        yield f"a tube's map: {name}", (_as_map(content, word) | undecided, status, line)
    # Legs from 101 to 93: all of the tube and a little more within the limits.
    good = deepcopy(content) | {"member": ["0"], "paving": "sisisii", "axes": [0] * 3, "inside": 4}
    good["robot"]["legs"][0]["reach"] = ["94", "101"]
    yield "what is beyond a tube need not be good", (good, "accepted", GOOD)
    yield "what is in a tube must be good", (_narrowed(good), "rejected", "paving: the part of letter 4")
    yield "all of half a tube", (good | {"paving": "sisisi", "inside": 3}, "rejected", "paving: parts")


def _narrowed(content: Content) -> Content:
    found = deepcopy(content)
    found["robot"]["legs"][0]["reach"] = ["96", "101"]
    return found


# Form

TUBE = {"corners": [["-1", "0", "0"], ["7", "0", "0"]], "radius": "1"}
WIDE = second(region(box=[[-2, 8]]), tube=TUBE)
WIDE["robot"]["legs"][0]["reach"] = None
LINE = second(region(variables=["along"], place=[0, 0, 0], box=[[3, 4]]), path=[[1], [0, 1], [0], [0]])
DRIVEN = leg((0, 0, 0), (0, 3, 0), None, direction=(0, 1, 0), rod=25)
BETWEEN = second(region([DRIVEN], modes=[1], conditions=["reachable"]), joints=[[5, 8]])
TURNED = leg((0, 0, 0), (0, 0, 0), None, u=(1, 0, 0), v=(0, 1, 0), rod=9)
CRANKED = second(region([TURNED], modes=[1], conditions=["reachable"], box=[[3, "7/2"]]), joints=[[0, 180]])
APART = second(
    region([leg((0, 0, 0), (0, 0, 0)), leg((0, 9, 0), (0, 9, 0))], modes=[0, 0]),
    leg_distance=8,
    directions=[["0", "1", "0", "1"]],
)
SLIDES = leg((0, 0, 0), (0, 3, 5), None, direction=(0, 1, 0), rod=25)
SLIDING = second(region([SLIDES], modes=[1], conditions=["reachable"]), leg_axes=[[0, 0, 1]])
HEAVY = leg((0, 0, 0), (0, 0, 0), None, u=(-1, 0, 0), v=(0, 0, 2), weight=4, rod=4)
CRANKED_ALONG = second(
    region([leg((0, 0, 0), (0, 0, 9), None, u=(1, 0, 0), v=(0, 1, 0), rod=9)], modes=[1], conditions=["reachable"])
    | {"axes": [0]},
    leg_axes=[[0, 0, 1]],
)
AWAY = _as_map(second(region(box=[[-2, 9]]), tube=TUBE), "u") | {"undecided": 1, "measure": ["0", "11"]}
NINTH = second(
    region(variables=["x", "y"], place=["x", "y", 0], box=[["-1/3", 2], [-2, 7]], metric=[9, 1, 1]),
    tube={"corners": texts([[0, 0, 0], [0, 5, 0]]), "radius": "1"},
)
NINTH = _as_map(NINTH, "u") | {"undecided": 1, "measure": ["0", "21"]}
MIXED = second(
    region([DRIVEN, leg((0, 0, 0), (0, 9, 0))], modes=[1, 0], paving="u", claim="undecided"), leg_distance="1/2"
)
TURNED_ROUND = second(
    region([leg((0, 0, 0), (0, 9, 0)), DRIVEN], modes=[0, 1], paving="u", claim="undecided"), leg_distance="1/2"
)
SHARED = {
    "platform": second(region([leg((0, 0, 0), (0, 0, 0)), leg((0, 9, 0), (0, 0, 0))], modes=[0, 0]), leg_distance=8),
    "base": second(region([leg((0, 0, 0), (0, 9, 0)), leg((0, 0, 0), (0, 0, 0))], modes=[0, 0]), leg_distance=8),
}
ON_ONE = second(
    region([DRIVEN, {**DRIVEN, "platform": ["0", "9", "0"]}], modes=[1, 1]),
    leg_distance="1/2",
    directions=[["0", "1", "0", "1"]],
)
"""Rods on one guide share no joint."""
STANDING = _as_map(second(region(variables=["y"], place=[0, "y", 0], box=[[-2, 8]])), "u") | {"undecided": 1}
STANDING |= {"measure": ["0", "10"], "tube": {"corners": [["0", "-1", "0"], ["0", "7", "0"]], "radius": "1"}}
ROLLING = region(variables=["x", "roll"], place=["x", 0, 0], turns=[["roll"], [1, 0], [1, 0]], box=[[-2, 8], [0, 1]])
ROLLING = _as_map(second(ROLLING, tube=TUBE), "u") | {"undecided": 1}
LEANING = second(
    region([leg((0, 0, 0), (0, 0, 0)), leg((0, 8, 0), (0, 10, 0))], modes=[0, 0], place=["x", 0, 5], box=[[-9, 9]]),
    leg_distance=8,
    directions=[["0", "1", "0", "1"]],
)
"""Nearest at their lower ends, wherever the upper ones are."""
OUT_OF_REACH = second(region([TURNED], modes=[1], conditions=["reachable"], box=[[5, 6]]), joints=[[0, 360]])
SHORT_ROD = leg((0, 0, 0), (0, 3, 0), None, direction=(0, 1, 0), rod=1)
SHORT = second(region([DRIVEN, SHORT_ROD], modes=[1, 1], conditions=["reachable"]), joints=[[5, 8]] * 2)
WHERE: dict[str, tuple[Content, tuple[Any, ...], Any, str, str]] = {
    "a tube along y": (STANDING, ("tube", "radius"), "1/2", "accepted", "measure"),
    "a tube that leaves where x is fixed": (STANDING, ("tube", "corners", 1, 0), "1", "malformed", "tube.corners: one"),
    "a tube with turns": (ROLLING, ("tube", "radius"), "1/2", "accepted", "paving"),
    "legs that lean": (LEANING, ("directions", 0, 3), "1", "accepted", GOOD),
    "legs that lean, exactly": (LEANING, ("directions", 0), None, "rejected", INSIDE),
    "legs that lean, farther apart": (LEANING, ("robot", "leg_distance"), "801/100", "rejected", INSIDE),
    "all angles, where there is none": (_pointed(OUT_OF_REACH), ("modes",), [-1], "rejected", BEYOND),
    "a member that the second leg does not reach": (SHORT, ("member",), ["7/2"], "rejected", NOT_MEMBER),
    "a number in place of conditions": (WIDE, ("conditions",), 5, "malformed", "conditions"),
    "a tube of one corner": (WIDE, ("tube", "corners"), [["0", "0", "0"]], "malformed", ""),
    "a tube of two corners that are one": (WIDE, ("tube", "corners"), [["0", "0", "0"]] * 2, "malformed", ""),
    "a tube of 64 corners": (
        WIDE,
        ("tube", "corners"),
        [["-1", "0", "0"], ["7", "0", "0"]] * 32,
        "accepted",
        GOOD,
    ),
    "a tube of 65 corners": (
        WIDE,
        ("tube", "corners"),
        [["-1", "0", "0"], ["7", "0", "0"]] * 32 + [["-1", "0", "0"]],
        "too-large",
        "",
    ),
    "a tube of nothing": (WIDE, ("tube", "radius"), "0", "malformed", ""),
    "a tube beside a shape": (WIDE, ("shape",), [part(1)], "malformed", "shape: there is one beside"),
    "a tube that leaves where y is fixed": (WIDE, ("tube", "corners", 0, 1), "1", "malformed", "tube.corners: one is"),
    "a tube that leaves where z is fixed": (WIDE, ("tube", "corners", 1, 2), "1", "malformed", "tube.corners: one is"),
    "a tube beside a curve": (
        LINE,
        ("tube",),
        {"corners": [["0"] * 3, ["1", "0", "0"]], "radius": "1"},
        "malformed",
        "",
    ),
    "a curve beside a shape": (LINE, ("shape",), [part(1)], "malformed", "shape: there is one beside"),
    "no member": (LINE, ("member",), [], "malformed", "member: not a value"),
    "a member of two": (LINE, ("member",), ["3", "3"], "malformed", "member: not a value"),
    "a member out of the box": (LINE, ("member",), ["5"], "rejected", NOT_MEMBER),
    "a member at the end of the box": (LINE, ("member",), ["4"], "accepted", GOOD),
    "a curve of three": (LINE, ("chart", "path"), [["1"]] * 3, "malformed", ""),
    "a curve without x": (LINE, ("chart", "path", 1), [], "malformed", "chart.path: not 1 to 5"),
    "a curve of five powers": (LINE, ("chart", "path", 2), ["0"] * 5, "accepted", GOOD),
    "a curve of six powers": (LINE, ("chart", "path", 2), ["0"] * 6, "malformed", "chart.path: not 1 to 5"),
    "a curve over 0": (LINE, ("chart", "path", 0), ["0", "0", "1"], "malformed", "chart.path: its denominator"),
    "a curve over -1": (LINE, ("chart", "path", 0), ["-1"], "malformed", "chart.path: its denominator"),
    "a curve over t": (LINE, ("chart", "path", 0), ["1", "1"], "malformed", "chart.path: its denominator"),
    "a curve over t cubed": (LINE, ("chart", "path", 0), ["1", "0", "0", "1"], "malformed", "chart.path: its"),
    "a curve over 1 - t^2": (LINE, ("chart", "path", 0), ["1", "0", "-1"], "malformed", "chart.path: its denominator"),
    "a curve over 1 + t^4": (LINE, ("chart", "path", 0), ["1", "0", "0", "0", "1"], "rejected", INSIDE),
    "a curve beside a position": (LINE, ("chart", "position", 1), "1", "malformed", "chart.path: there is a position"),
    "a curve without a variable": (LINE, ("chart", "variables"), ["x"], "malformed", ""),
    "a variable without a curve": (LINE, ("chart", "path"), None, "malformed", ""),
    "a curve of a plane": (LINE, ("robot", "motion"), "planar", "accepted", GOOD),
    "a curve over nothing": (LINE, ("chart", "path", 0), [], "malformed", "chart.path: not 1 to 5"),
    "a curve of six powers of z": (LINE, ("chart", "path", 3), ["0"] * 6, "malformed", "chart.path: not 1 to 5"),
    "a curve beside a first coordinate": (LINE, ("chart", "position", 0), "1", "malformed", "chart.path: there is"),
    "a curve beside a last coordinate": (LINE, ("chart", "position", 2), "1", "malformed", "chart.path: there is"),
    "a curve beside a coordinate below 0": (LINE, ("chart", "position", 1), "-1", "malformed", "chart.path: there is"),
    "a tube with two neighbours that are one": (
        WIDE,
        ("tube", "corners"),
        [["-1", "0", "0"], ["-1", "0", "0"], ["7", "0", "0"]],
        "malformed",
        "tube.corners: fewer",
    ),
    "a tube that leaves where y is fixed, below": (
        WIDE,
        ("tube", "corners", 0, 1),
        "-1",
        "malformed",
        "tube.corners: one",
    ),
    "a tube in another box": (
        AWAY | {"measure": ["0", "10"]},
        ("chart", "box", 0),
        ["20", "30"],
        "rejected",
        "tube: the box does not hold it",
    ),
    "a tube beside a box, by less than 1": (
        NINTH | {"measure": ["0", "99/10"]},
        ("chart", "box", 0, 0),
        "9/10",
        "rejected",
        "tube: the box does not",
    ),
    "a tube within a box": (NINTH, ("chart", "box", 0, 0), "-1/3", "accepted", "measure"),
    "a tube of radius 2": (
        changed(AWAY, "2", "tube", "radius") | {"measure": ["0", "12"]},
        ("chart", "box", 0, 0),
        "-3",
        "accepted",
        "measure",
    ),
    "a wider tube of radius 2": (
        changed(AWAY, "2", "tube", "radius") | {"measure": ["0", "23/2"]},
        ("chart", "box", 0, 0),
        "-5/2",
        "rejected",
        "tube: the box does not hold it",
    ),
    "joint values of one leg of two": (
        second(region([DRIVEN, DRIVEN], modes=[1, 1], conditions=["reachable"]), joints=[[5, 8]] * 2),
        ("joints",),
        [["5", "8"]],
        "malformed",
        "joints: not as many",
    ),
    "a slide of no mode": (
        second(region([DRIVEN], modes=[1], conditions=["reachable"])),
        ("modes",),
        [0],
        "accepted",
        GOOD,
    ),
    "two rods on one guide, the first of no mode": (ON_ONE, ("modes",), [0, 1], "malformed", "modes: a working mode"),
    "a short direction": (APART, ("directions", 0), ["0", "1/2", "0", "1/2"], "accepted", GOOD),
    "a slide and a leg at one place": (MIXED, ("directions",), [None], "accepted", "claim: none"),
    "a slide and a leg at one place, not compared": (MIXED, ("directions",), [], "malformed", "directions: not one"),
    "a leg and a slide at one place, not compared": (TURNED_ROUND, ("directions",), [], "malformed", "directions: not"),
    "an axis that leans to the other side": (
        SLIDING,
        ("robot", "legs", 0, "axis"),
        ["0", "-1", "1"],
        "malformed",
        "robot.legs: a slide",
    ),
    "a curve that leaves the plane": (
        changed(LINE, "planar", "robot", "motion"),
        ("chart", "path", 3),
        ["0", "1"],
        "malformed",
        "chart.path: leaves",
    ),
    "a curve that leaves a plane of a robot that may": (
        changed(LINE, "schoenflies", "robot", "motion"),
        ("chart", "path", 3),
        ["0", "1/9"],
        "rejected",
        INSIDE,
    ),
    "joint values of a crank of weight 4": (
        second(region([HEAVY], modes=[1], conditions=["reachable"], box=[[1, 2]]), joints=[[0, 180]]),
        ("joints", 0, 1),
        "270",
        "malformed",
        "joints: limits of a crank",
    ),
    "an axis across one axis of a crank": (
        CRANKED_ALONG,
        ("robot", "legs", 0, "axis"),
        ["0", "1", "1"],
        "malformed",
        "",
    ),
    "an axis across the other axis of a crank": (
        CRANKED_ALONG,
        ("robot", "legs", 0, "axis"),
        ["1", "0", "1"],
        "malformed",
        "robot.legs: a slide or crank",
    ),
    "an axis across both axes of a crank": (CRANKED_ALONG, ("modes",), [-1], "accepted", GOOD),
    "an axis beside cones of the platform": (
        SLIDING,
        ("robot", "platform_cones"),
        [{"axis": ["0", "0", "1"], "degrees": "180"}],
        "malformed",
        "robot.legs: a rod along",
    ),
    "a curve of a sphere": (LINE, ("robot", "motion"), "spherical", "malformed", ""),
    "joint values of two legs": (BETWEEN, ("joints",), [["5", "8"]] * 2, "malformed", "joints: not as many"),
    "joint values out of order": (BETWEEN, ("joints",), [["8", "5"]], "malformed", ""),
    "joint values of a slide below 0": (BETWEEN, ("joints", 0, 0), "-5", "accepted", GOOD),
    "joint values of no mode": (BETWEEN, ("modes",), [0], "malformed", "modes: a working mode"),
    "a length below 0": (second(region(), joints=[[3, 4]]), ("joints", 0, 0), "-1", "malformed", "joints: a length"),
    "a length from 0": (second(region(), joints=[[3, 4]]), ("joints", 0, 0), "0", "accepted", GOOD),
    "an angle of 91 degrees": (CRANKED, ("joints", 0), ["0", "91"], "malformed", "joints: limits of a crank"),
    "an angle of -1 degree": (CRANKED, ("joints", 0), ["-1", "180"], "malformed", "joints: limits of a crank"),
    "angles of right angles": (CRANKED, ("joints", 0), ["0", "180"], "accepted", GOOD),
    "no direction for two legs": (APART, ("directions",), [], "malformed", "directions: not one"),
    "two directions for two legs": (
        APART,
        ("directions",),
        APART["directions"] * 2,
        "malformed",
        "directions: not one",
    ),
    "a direction of nothing": (APART, ("directions", 0), ["0", "0", "0", "0"], "malformed", ""),
    "a direction of three": (APART, ("directions", 0), ["0", "1", "0"], "malformed", ""),
    "a direction that is longer": (
        APART,
        ("directions", 0, 1),
        "9/8",
        "malformed",
        "directions: the last number is less",
    ),
    "a direction that is longer in x": (APART, ("directions", 0, 0), "1", "malformed", "directions: the last number"),
    "a direction that is longer in z": (APART, ("directions", 0, 2), "1", "malformed", "directions: the last number"),
    "a direction that is said to be longer": (APART, ("directions", 0, 3), "9/8", "accepted", GOOD),
    "two parallel legs apart": (APART, ("directions", 0, 3), "1", "accepted", GOOD),
    "two parallel legs farther apart": (APART, ("robot", "leg_distance"), "10", "rejected", INSIDE),
    "a least distance of 0": (APART, ("robot", "leg_distance"), "0", "malformed", ""),
    "no least distance, and a direction": (APART, ("robot", "leg_distance"), None, "malformed", "directions: not one"),
    "a direction that nobody asked for": (APART, ("conditions",), ["reachable"], "malformed", "directions: not one"),
    "a shared platform joint": (SHARED["platform"], ("directions",), [], "accepted", GOOD),
    "a shared platform joint, with a direction": (SHARED["platform"], ("directions",), [None], "malformed", ""),
    "a shared base joint": (SHARED["base"], ("directions",), [], "accepted", GOOD),
    "a shared base joint, with a direction": (SHARED["base"], ("directions",), [None], "malformed", ""),
    "two rods on one guide": (ON_ONE, ("robot", "leg_distance"), "3/2", "accepted", GOOD),
    "two rods on one guide, not compared": (ON_ONE, ("directions",), [], "malformed", "directions: not one"),
    "two rods on one guide, of no mode": (ON_ONE, ("modes",), [1, 0], "malformed", "modes: a working mode"),
    "an axis": (SLIDING, ("robot", "legs", 0, "axis"), ["0", "0", "1"], "accepted", GOOD),
    "no axis": (SLIDING, ("robot", "legs", 0, "axis"), None, "rejected", INSIDE),
    "an axis of nothing": (SLIDING, ("robot", "legs", 0, "axis"), ["0"] * 3, "malformed", "robot.legs: an axis is 0"),
    "an axis along the slide": (
        SLIDING,
        ("robot", "legs", 0, "axis"),
        ["0", "1", "1"],
        "malformed",
        "robot.legs: a slide",
    ),
    "an axis of a leg of its own length": (
        second(region()),
        ("robot", "legs", 0, "axis"),
        ["0", "0", "1"],
        "malformed",
        "robot.legs: an axis is 0, or",
    ),
    "an axis beside cones": (
        SLIDING,
        ("robot", "base_cones"),
        [{"axis": ["0", "0", "1"], "degrees": "180"}],
        "malformed",
        "robot.legs: a rod along",
    ),
    "an axis beside distances": (
        second(
            region([SLIDES, {**SLIDES, "platform": ["0", "3", "9"]}], modes=[1, 1]),
            leg_axes=[[0, 0, 1], None],
            leg_distance=1,
        ),
        ("directions",),
        [None],
        "malformed",
        "robot.legs: a rod along",
    ),
    "version 3": (LINE, ("version",), 3, "malformed", "format: not a pkm_exact region certificate, version 1 or 2"),
    "a true version 2": (
        LINE,
        ("version",),
        True,
        "malformed",
        "format: not a pkm_exact region certificate, version 1 or 2",
    ),
}


def form_rows() -> Iterator[tuple[str, Row]]:
    """Certificates with one entry changed."""
    for name, (content, where, value, status, line) in WHERE.items():
        yield name, (changed(content, value, *where), status, line)
    opposite = second(
        region(COPLANAR, points=[["-3/2"], ["3/2"]], **(PUSHED | {"conditions": ["limits", "no_type_2"]})),
        joints=[[0, 9]] * 3,
    )
    yield "two poses of joint values", (opposite, "malformed", "counterexample: neither one pose")
    yield "two poses of no joint values", (opposite | {"joints": []}, "accepted", "claim: not all poses")


# Designs

UPRIGHT = leg((0, 0, 0), (0, 0, 0), (2, 6))
ROD = leg((0, 0, 0), (0, 3, 0), None, direction=(0, 1, 0), rod=25)
SCALED: Content = second(
    region([leg((1, 0, 0), (0, 0, 0), (2, 6))], box=[[4, 5]]), parameters={"base.scale": [1, 5]}, axes=[0, 0]
)
"""A leg from (p1, 0, 0) to (x, 0, 0), x from 4 to 5: from 2 to 6 long for all x if p1 is at most 2."""
MOVED: Content = second(
    region([UPRIGHT, leg((0, 0, 0), (9, 0, 0), (2, 6))], box=[[4, 5]], modes=[0, 0]),
    parameters={"platform.joints.2.1": [-2, 2]},
    axes=[0, 0],
)
"""The second leg is x + p1 long, 2 to 7."""
LONG = second(
    region([ROD], modes=[1], conditions=["reachable"], box=[[3, 4]]), parameters={"rods.length": [2, 10]}, axes=[0]
)
"""A rod reaches if it is at least x long, x from 3 to 4."""
SIGNS = second(
    region(COPLANAR, **(PUSHED | {"box": [[-2, 2]], "axes": [0, 0, 0]})),
    parameters={"base.joints.1.1": ["-1/4", "1/4"]},
)
"""The determinant of the three rods is 1 + x - p1 at (x, 0, 0)."""
ASIDE = {
    f"{side}.joints.1.{k}": second(
        region([leg((0, 0, 0), (0, 0, 0), (2, 6))]), parameters={f"{side}.joints.1.{k}": [0, 8]}
    )
    for side in ("base", "platform")
    for k in (2, 3)
}
"""A leg from the origin to (x, p1, 0), or turned round, x from 3 to 4."""
WIDER = second(region([leg((0, 0, 0), (1, 0, 0), (2, 6))], box=[[3, 4]]), parameters={"platform.scale": [1, 3]})
"""A leg that is x + p1 long."""
PLACES = tuple((side, k, 3) for side in ("base", "platform") for k in (1, 2))
UNSAID: Content = {"paving": "u", "inside": 0, "undecided": 1}
FOUR = second(
    region([UPRIGHT, leg((0, 0, 0), (0, 0, 0), (2, 6))], modes=[0, 0]),
    parameters={f"{side}.joints.{k}.{axis}": [0, 1] for side, k, axis in PLACES},
)
SHAPED = second(
    region([leg((1, 0, 0), (0, 0, 0), (2, 3))], box=[[4, 5]], shape=[part("9/2", (-1, 0, 0))]),
    parameters={"base.scale": [1, "3/2"]},
    axes=[0, 0],
)
"""Longer than 3 for x above 4 and 3/4 only, and that is not in the region."""
DESIGNS: dict[str, tuple[Content, str, tuple[int, int], str, str]] = {
    # From 1 to 2, to 3, to 5.
    "a scale": (SCALED, "ssyiuu", (1, 2), "accepted", "claim: what the boxes"),
    "a scale, all of it": (SCALED, "yi", (1, 0), "rejected", "paving: what letter 2 says is not proved"),
    "a scale that is bad": (SCALED, "ssyiusunox", (1, 2), "rejected", "paving: it goes on after its end"),
    "a scale that is too large": (SCALED, "ssyiusunsxo", (1, 2), "accepted", "claim: what the boxes"),
    "a scale that is bad for some": (SCALED, "ssyiusnsoxu", (1, 2), "accepted", "claim: what the boxes"),
    "a scale that is not so bad": (SCALED, "ssyiusnou", (1, 2), "rejected", "paving: what letter 8"),
    "a bad box that is not refuted": (SCALED, "ssyiusunsxx", (1, 2), "rejected", "paving: the designs of letter 8"),
    "a bad box of which nothing is said": (SCALED, "ssyiusunx", (1, 2), "rejected", "paving: the designs of letter"),
    "a good box that is called bad": (SCALED, "ssnouu", (0, 2), "rejected", "paving: what letter 4 says"),
    "a good box without its region": (SCALED, "ssyuu", (1, 2), "rejected", "paving: letter 4 does not belong"),
    "half of a region": (SCALED, "ssysiuu", (1, 2), "rejected", "paving: letter 6 does not belong"),
    "a region in halves": (SCALED, "ssysiiuu", (1, 2), "accepted", "claim: what the boxes"),
    "a region in eighths": (SCALED, "ssysisisiiuu", (1, 2), "rejected", "paving: letter 8 halves a part deeper"),
    "a box that is missing": (SCALED, "ssyiu", (1, 1), "rejected", "paving: parts of the region are missing"),
    "a region that is missing": (SCALED, "ssyius", (1, 1), "rejected", "paving: parts of the region are missing"),
    "boxes that go on": (SCALED, "ssyiuuu", (1, 3), "rejected", "paving: it goes on after its end"),
    "an i for designs": (SCALED, "ssiuu", (0, 2), "rejected", "paving: letter 3 says nothing"),
    "an o for designs": (SCALED, "o", (0, 0), "rejected", "paving: letter 1 says nothing"),
    "an undecided part of a bad box": (SCALED, "ssyiusunsuo", (1, 2), "rejected", "paving: letter 10 does not belong"),
    "a good part of a bad box": (SCALED, "ssyiusunsio", (1, 2), "rejected", "paving: letter 10 does not belong"),
    "a bad part of a good box": (SCALED, "ssyouu", (1, 2), "rejected", "paving: letter 4 does not belong"),
    "more good boxes": (SCALED, "ssyiuu", (2, 2), "rejected", "inside, undecided: not as many boxes"),
    "more undecided boxes": (SCALED, "ssyiuu", (1, 3), "rejected", "inside, undecided: not as many boxes"),
    "a coordinate": (MOVED, "sunsxsxo", (0, 1), "rejected", "paving: what letter 8 says"),
    "a coordinate that is good": (MOVED, "ssuyiu", (1, 2), "accepted", "claim: what the boxes"),
    "a coordinate that is not good": (MOVED, "su" + "yi", (1, 1), "rejected", "paving: what letter 4 says"),
    "a rod": (LONG, "ssnouyi", (1, 1), "rejected", "paving: what letter 4 says"),
    "a long rod": (LONG, "ssuyiyi", (2, 1), "accepted", "claim: what the boxes"),
    "a short rod": (LONG, "sssnsxouuyi", (1, 2), "accepted", "claim: what the boxes"),
    "a rod that is not long enough": (LONG, "syiyi", (2, 0), "rejected", "paving: what letter 3 says"),
    **{f"to the side, {key}": (found, "syiu", (1, 1), "accepted", "claim: what") for key, found in ASIDE.items()},
    **{f"too far, {key}": (found, "syiyi", (2, 0), "rejected", "paving: what") for key, found in ASIDE.items()},
    "a scale of the platform": (WIDER, "syiu", (1, 1), "accepted", "claim: what"),
    "a scale of the platform that is too large": (WIDER, "syiyi", (2, 0), "rejected", "paving: what letter 5"),
    "four parameters": (FOUR, "yi", (1, 0), "accepted", "claim: what"),
    "four parameters, one after another": (FOUR, "ssssuuuuu", (0, 5), "accepted", "claim: what"),
    "a good box of which nothing is said": (SCALED, "ssyxuu", (1, 2), "rejected", "paving: letter 4 does not belong"),
    "a bad box that is called good": (SCALED, "ssyiusuyo", (2, 2), "rejected", "paving: letter 9 does not belong"),
    "a sign without a determinant": (SCALED, "ssyiusunsx+", (1, 2), "rejected", "paving: what letter 11 says"),
    "bad beyond the region": (SHAPED, "nsxsxo", (0, 0), "rejected", "paving: what letter 6 says"),
    "a minus where there is none, and a plus": (SIGNS, "nssx-sx+", (0, 0), "rejected", "paving: what letter 5 says"),
    "two signs": (SIGNS, "nsss-xxsx+", (0, 0), "accepted", "claim: what the boxes"),
    "one sign twice": (SIGNS, "nssxxsx+", (0, 0), "rejected", "paving: the designs of letter 1"),
    "the other sign twice": (SIGNS, "nsss-xxx", (0, 0), "rejected", "paving: the designs of letter 1"),
    "a plus that is none": (SIGNS, "nsss+xxsx+", (0, 0), "rejected", "paving: what letter 5 says"),
    "a minus that is none": (SIGNS, "nsss-xxsx-", (0, 0), "rejected", "paving: what letter 10 says"),
    "halved 121 times": (SCALED, "s" * 121 + "u" * 122, (0, 122), "rejected", "paving: letter 121 halves designs"),
    "halved 120 times": (SCALED, "s" * 120 + "u" * 121, (0, 121), "accepted", "claim: what the boxes"),
}
BESIDE = second(region([UPRIGHT]), parameters={"base.scale": [1, 2]}, paving="u", inside=0, undecided=1)
APART_BY: Content = second(
    region([leg((0, 0, 0), (0, 0, 0)), leg((0, 9, 0), (0, 9, 0))], modes=[0, 0]),
    leg_distance=8,
    directions=[["0", "1", "0", "1"]],
    parameters={"platform.scale": ["1/2", 1], "base.joints.2.2": [9, 10]},
    paving="u",
    inside=0,
    undecided=1,
)
SAME: Content = second(
    region([leg((0, 0, 0), (0, 0, 0)), leg((0, 9, 0), (0, 0, 0))], modes=[0, 0]),
    leg_distance=8,
    parameters={"platform.scale": ["1/2", 1]},
    paving="u",
    inside=0,
    undecided=1,
)
ELSEWHERE: dict[str, tuple[Content, tuple[Any, ...], Any, str, str]] = {
    "nothing said of designs": (BESIDE, ("chart", "parameters"), ["base.scale"], "accepted", "claim: what the boxes"),
    "a parameter twice, with a variable each": (
        second(region([UPRIGHT]), parameters={"base.scale": [1, 2], "platform.scale": [1, 2]}, **UNSAID),
        ("chart", "parameters"),
        ["base.scale"] * 2,
        "malformed",
        "chart.parameters: more",
    ),
    "no parameters": (BESIDE, ("chart", "parameters"), [], "malformed", ""),
    "a parameter twice": (BESIDE, ("chart", "parameters"), ["base.scale"] * 2, "malformed", "chart.parameters: more"),
    "five parameters": (
        BESIDE,
        ("chart", "parameters"),
        ["base.scale", *(f"platform.joints.1.{k}" for k in "123"), "platform.joints.2.1"],
        "malformed",
        "chart.parameters: more",
    ),
    **{
        f"a parameter that is none: {key}": (
            BESIDE,
            ("chart", "parameters"),
            [key],
            "malformed",
            "chart.parameters: one",
        )
        for key in (
            "height",
            "base.joints.0.1",
            "base.joints.1.0",
            "base.joints.1.4",
            "base.joints.01.1",
            "base.joint.1.1",
        )
    }
    | {
        f"a parameter that is not quite one: {key}": (BESIDE, ("chart", "parameters"), [key], "malformed", "")
        for key in ("rods.scale", "base.joints.1", "base.joints.1.1.1", "top.joints.1.1", "base.joints.100.1")
    },
    **{
        f"an axis beside parameters, {axes}": (
            second(
                region([SLIDES, {**SLIDES}], modes=[1, 1], conditions=["reachable"], **UNSAID),
                parameters={"base.scale": [1, 2]},
                leg_axes=[[0, 0, 1] if axis else None for axis in axes],
            ),
            ("axes",),
            [0],
            "malformed",
            "chart.parameters: there are forms",
        )
        for axes in ((1, 0), (0, 1))
    },
    "rods of some legs": (
        second(region([ROD, UPRIGHT], modes=[1, 0], **UNSAID), parameters={"rods.length": [1, 2]}),
        ("axes",),
        [0],
        "malformed",
        "chart.parameters: a leg has no rod",
    ),
    "the tenth leg": (
        second(region([UPRIGHT] * 10, modes=[0] * 10, **UNSAID), parameters={"base.joints.10.1": [0, 1]}),
        ("axes",),
        [0],
        "accepted",
        "claim: what",
    ),
    "the first of two legs alone": (
        second(
            region([UPRIGHT, leg((0, 0, 0), (0, 0, 0), (4, 5))], box=[[4, 5]], modes=[0, 0], paving="ssuyiu"),
            parameters={"platform.joints.1.1": [-2, 2]},
            inside=1,
            undecided=2,
        ),
        ("axes",),
        [0],
        "accepted",
        "claim: what",
    ),
    "a coordinate of the first leg": (BESIDE, ("chart", "parameters"), ["base.joints.1.3"], "accepted", ""),
    "a coordinate of the second leg": (
        BESIDE,
        ("chart", "parameters"),
        ["base.joints.2.3"],
        "malformed",
        "chart.parameters: there is no such leg",
    ),
    "rods that are none": (
        BESIDE,
        ("chart", "parameters"),
        ["rods.length"],
        "malformed",
        "chart.parameters: a leg has",
    ),
    "a scale from 0": (BESIDE, ("chart", "box", 1, 0), "0", "malformed", "chart.parameters: a scale or length"),
    "a scale from a little more": (BESIDE, ("chart", "box", 1, 0), "1/9", "accepted", ""),
    "another claim beside parameters": (BESIDE, ("claim",), "undecided", "malformed", ""),
    "designs without parameters": (second(region()), ("claim",), "designs", "malformed", ""),
    "letters of designs elsewhere": (second(region()), ("paving",), "yi", "malformed", "paving: not a word"),
    "a form beside parameters": (BESIDE, ("robot", "forms"), [["0"] * 17], "malformed", "chart.parameters: there are"),
    "joints beside parameters": (BESIDE, ("joints",), [["0", "9"]], "malformed", "chart.parameters: there are"),
    "a measure of designs": (BESIDE, ("measure",), ["0", "1"], "malformed", "measure: claimed where"),
    "no member of designs": (BESIDE, ("member",), [], "malformed", "member: not a value"),
    "a member beyond the designs": (BESIDE, ("member", 1), "3", "rejected", NOT_MEMBER),
    "an axis of a parameter": (BESIDE, ("axes",), [1], "malformed", "axes: one is not"),
    "legs that are scaled alike": (SAME, ("directions",), [], "accepted", ""),
    "legs that are scaled alike, with a direction": (SAME, ("directions",), [None], "malformed", "directions: not one"),
    "a joint that moves, without a direction": (APART_BY, ("directions",), [], "malformed", "directions: not one"),
    "a joint that moves and is scaled": (
        APART_BY,
        ("chart", "parameters"),
        ["base.scale", "base.joints.2.2"],
        "malformed",
        "chart.parameters: there is no such leg, or its",
    ),
    "a joint that leaves another": (
        changed(SAME, ["platform.joints.2.1"], "chart", "parameters"),
        ("directions",),
        [None],
        "accepted",
        "",
    ),
    "a joint that leaves another, not compared": (
        changed(SAME, ["platform.joints.2.1"], "chart", "parameters"),
        ("directions",),
        [],
        "malformed",
        "directions: not one",
    ),
}


FREELY = second(
    region([leg((0, 0, 0), (0, 0, 2), **CRANK, rod=5), leg((0, 0, 50), (0, 0, 60))], **(FREE | {"modes": [1, 0]})),
    leg_distance=1,
    directions=[["0", "0", "1", "1"]],
)
"""A crank that turns freely has no place, and so no distance from another leg."""
FIVE = second(
    region([UPRIGHT, leg((0, 0, 0), (0, 0, 0), (2, 6))], modes=[0, 0]),
    parameters={f"{side}.joints.{k}.{axis}": [0, 1] for side, k, axis in (*PLACES, ("base", 1, 2))},
    **UNSAID,
)
NINE = second(
    region([UPRIGHT] * 9, modes=[0] * 9), parameters={f"platform.joints.9.{k}": [0, 1] for k in (1, 2, 3)}, **UNSAID
)
NEAR = APART_BY | {"paving": "yi", "inside": 1, "undecided": 0}
FAR = changed(NEAR, ["9/10", "1"], "chart", "box", 1) | {"member": ["7/2", "1", "9"]}


def design_rows() -> Iterator[tuple[str, Row]]:
    """Words about designs, and certificates of designs with one entry changed."""
    for name, (content, word, (good, undecided), status, line) in DESIGNS.items():
        found = content | {"paving": word, "inside": good, "undecided": undecided}
        yield f"designs: {name}", (found, status, line)
    yield "designs: five of them", (FIVE, "malformed", "chart.parameters: more than 4")
    yield "designs: of nine legs", (NINE, "accepted", "claim: what")
    yield "a crank that turns freely beside a leg", (FREELY, "rejected", INSIDE)
    yield "a crank that turns freely beside a leg, exactly", (FREELY | {"directions": [None]}, "rejected", INSIDE)
    yield "designs: legs that are scaled towards each other", (NEAR, "rejected", "paving: what letter 2")
    yield "designs: legs that are scaled a little", (FAR, "accepted", "claim: what")
    exactly = FAR | {"directions": [None]}
    yield "designs: legs that are scaled a little, exactly", (exactly, "accepted", "claim: what")
    for name, (content, where, value, status, line) in ELSEWHERE.items():
        yield f"designs: {name}", (changed(content, value, *where), status, line)


ROWS: dict[str, Row] = merged(
    *map(dict, (distance_rows(), curve_rows(), axis_rows(), joint_rows(), tube_rows(), form_rows(), design_rows()))
)

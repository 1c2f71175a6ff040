"""Region certificates made by hand, honest ones and forgeries, with what both checkers must say of them."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from fractions import Fraction
from math import cos, isqrt, radians, sin
from random import Random
from typing import Any

from handmade_regions import (
    ALONG,
    ANGLES,
    Content,
    Placed,
    chart_of,
    cone,
    leg,
    limits_of,
    make_singular,
    part,
    point_of,
    put,
    random_legs,
    region,
    texts,
    vanishing_form,
    vector,
)
from tables_of_rows import merged

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and how its last line begins."""

INSIDE = "paving: the part of letter 1 is not proved to be inside"
OUTSIDE = "paving: the part of letter 1 is not proved to be outside"
EMPTY = "shape: the middle of the box is not in it"
BEYOND = "counterexample: a pose is not one of the region"
GOOD = "claim: all poses of the region are good"
NO_FAILURE = "counterexample: no condition is proved to fail there"
BROKEN = "claim: not all poses of the region are good, as one shows"
ONE_SIGN = "counterexample: the determinants are not proved to have opposite signs"
TWO_SIGNS = "claim: not all poses of the region are good, as the determinant"

LIMITS = (
    *(("ls", "quaternion x"), ("cs", "quaternion y"), ("c", "quaternion z"), ("c", "turns x"), ("c", "turns y")),
    *(("l", "pitch x"), ("s", "roll z"), ("l", "yaw y"), ("lc", "turns z"), ("c", "quaternion x")),
)


def random_rows() -> Iterator[tuple[str, Row]]:
    """Limits that hold or do not, one after another, of robots made at random."""
    for seed, (types, kind) in enumerate(LIMITS):
        random = Random(seed)
        metric = [1, 1, 1] if "c" in types else random.choice([[2, 3, 5], [1, 3, 1], [4, 1, 2]])
        content = region(metric=metric, **chart_of(kind, "spatial", random))
        random_legs(types, content, random)
        good, bad = limits_of(content, random)
        for path, value in good:
            put(content, path, value)
        assert min(Placed(content, point_of(content)).margins()) > 0
        yield f"limits {seed}: all hold", (content, "accepted", GOOD)
        yield f"limits {seed}: none fails", (pointed(content), "rejected", NO_FAILURE)
        for number, (path, value) in enumerate(bad):
            wrong = deepcopy(content)
            put(wrong, path, value)
            assert min(Placed(wrong, point_of(wrong)).margins()) < 0
            where = f"limits {seed}: {'.'.join(map(str, path))}, {number}"
            yield where, (wrong, "rejected", INSIDE)
            yield f"{where} fails", (pointed(wrong), "accepted", BROKEN)
            yield f"{where} outside", (as_map(wrong, "o"), "accepted", "")
        yield from _reaches(seed, content)


def _reaches(seed: int, content: Content) -> Iterator[tuple[str, Row]]:
    """Rods too short: the pose is not reached, whatever is asked."""
    for k, entry in enumerate(content["robot"]["legs"]):
        if entry["actuator"]["type"] == "length":
            continue
        for condition in ("reachable", "no_type_1"):
            fine = deepcopy(content) | {"conditions": [condition]}
            short = deepcopy(fine)
            short["robot"]["legs"][k]["actuator"]["rod_squared"] = "1/1000000"
            assert not Placed(short, point_of(short)).reached
            yield f"limits {seed}: {condition} {k}", (fine, "accepted", GOOD)
            yield f"limits {seed}: {condition} {k}, short", (short, "rejected", INSIDE)
            yield f"limits {seed}: {condition} {k}, short, fails", (pointed(short), "accepted", BROKEN)


def pointed(content: Content) -> Content:
    """The claim that the pose at the point is not good."""
    found = deepcopy(content) | {"claim": "not-all", "paving": "", "inside": 0}
    return found | {"counterexample": [texts(point_of(content))]}


def as_map(content: Content, word: str) -> Content:
    """A map with this word, and its measure."""
    found = deepcopy(content) | {"claim": "map", "paving": word, "inside": word.count("i")}
    if set(found["chart"]["variables"]) <= set("xyz"):
        found["measure"] = ["0", "0"]
    return found


FULL = (
    ("planar", "lll", "quaternion x", 0),
    ("planar", "lsc", "yaw y", 0),
    ("planar", "ss", "turns x", 1),
    ("schoenflies", "lscl", "quaternion z", 0),
    ("schoenflies", "lsl", "yaw", 1),
    ("translation", "lsc", "turns y", 0),
    ("translation", "lc", "turns z", 1),
    ("spherical", "llc", "pitch x", 0),
    ("spherical", "sc", "roll y", 1),
    ("spherical", "ls", "yaw z", 1),
    ("spatial", "llllsl", "quaternion y", 0),
    ("spatial", "lllll", "turns z", 1),
    ("spatial", "llsl", "roll", 2),
    ("spatial", "lllc", "pitch", 2),
    ("spatial", "llll", "yaw", 2),
)


def determinant_rows() -> Iterator[tuple[str, Row]]:
    """Whether the determinant has one sign or two at two poses."""
    for seed, (motion, types, kind, number) in enumerate(FULL):
        random = Random(1000 + seed)
        metric = [1, 1, 1] if "c" in types else random.choice([[2, 3, 5], [1, 3, 1], [4, 1, 2]])
        content = region(metric=metric, **_chart(kind, motion, random))
        content["conditions"], content["robot"]["forms"] = ["no_type_2"], []
        random_legs(types, content, random)
        for _ in range(number):
            content["robot"]["forms"].append(texts(vanishing_form(content, random)))
        placed = Placed(content, point_of(content))
        if placed.reached and abs(placed.determinant()) > 0.05:
            yield f"determinant {seed}: not 0", (content, "accepted", GOOD)
            yield f"determinant {seed}: not 0, there", (pointed(content), "rejected", NO_FAILURE)
        far = _with_both_signs(content, random)
        if far is not None:
            yield from far_rows(seed, content, far)


def _chart(kind: str, motion: str, random: Random) -> Content:
    """As ``chart_of``; a turn alone leaves C where it is."""
    if len(kind.split()) == 2:
        return chart_of(kind, motion, random)
    found = chart_of(f"{kind} z", motion, random)
    if "z" in found["variables"]:
        found["box"].pop(0)
        found["place"][2] = 3
    return found | {"variables": [kind]}


def _with_both_signs(content: Content, random: Random) -> list[list[Fraction]] | None:
    """Three poses, all reached: the determinant has one sign at two of them, and the other at the third."""
    count = len(content["chart"]["variables"])
    found: dict[bool, list[list[Fraction]]] = {True: [], False: []}
    for _ in range(60):
        point = [Fraction(random.randint(-60, 60), 12) for _ in range(count)]
        placed = Placed(content, point)
        value = placed.determinant() if placed.reached else 0
        if abs(value) > 1e-6:
            found[value > 0].append(point)
    one, other = sorted(found.values(), key=len)
    return [*other[:2], one[0]] if one and len(other) > 1 else None


def far_rows(seed: int, content: Content, points: list[list[Fraction]]) -> Iterator[tuple[str, Row]]:
    """Two claims of two poses: one is true."""
    content = deepcopy(content) | {"claim": "not-all", "paving": "", "inside": 0}
    content["chart"]["box"] = [["-9", "9"]] * len(points[0])
    alike, apart = content | {"counterexample": texts(points[:2])}, content | {"counterexample": texts(points[1:])}
    yield f"determinant {seed}: one sign", (alike, "rejected", ONE_SIGN)
    yield f"determinant {seed}: two signs", (apart, "accepted", TWO_SIGNS)


EXACT = (
    ("spatial", 5, "turns z", 1),
    ("spatial", 4, "yaw", 2),
    ("spatial", 4, "roll", 2),
    ("spatial", 4, "pitch", 2),
    ("spatial", 6, "turns x", 0),
    ("planar", 2, "turns y", 1),
    ("planar", 2, "yaw", 1),
    ("schoenflies", 3, "yaw", 1),
    ("schoenflies", 3, "turns z", 1),
    ("translation", 2, "turns z", 1),
    ("spherical", 2, "yaw", 1),
    ("spherical", 2, "roll", 1),
    ("spherical", 3, "pitch", 0),
)


def singular_rows() -> Iterator[tuple[str, Row]]:
    """Legs of own length and forms that are exactly singular at one pose, and not at another."""
    for seed, (motion, legs, kind, number) in enumerate(EXACT):
        random = Random(2000 + seed)
        content = region(metric=[2, 3, 5], **_chart(kind, motion, random))
        content["conditions"] = ["no_type_2"]
        content["robot"]["legs"] = [leg(vector(random), vector(random)) for _ in range(legs)]
        content["modes"] = [0] * legs
        content["robot"]["forms"] = [texts(vanishing_form(content, random)) for _ in range(number)]
        content["chart"]["box"] = [["-9", "9"]]
        make_singular(content, Fraction(random.randint(-9, 9), 4))
        at = content.pop("singular")
        base = content | {"claim": "not-all", "paving": "", "inside": 0}
        yield f"singular {seed}", (base | {"counterexample": [[str(at)]]}, "accepted", BROKEN)
        yield (
            f"singular {seed}: a little aside",
            (
                base | {"counterexample": [[str(at + SMALL_STEP)]]},
                "rejected",
                NO_FAILURE,
            ),
        )


SMALL_STEP = Fraction(1, 1 << 20)

# Shapes, forms and cranks

MOVED = (("quaternion x", [2, 3, 5]), ("roll z", [1, 3, 2]), ("yaw y", [4, 1, 2]))


def shape_rows() -> Iterator[tuple[str, Row]]:
    """Poses a little inside of shapes and outside of them, in plain products, whatever the metric is."""
    for seed, (kind, metric) in enumerate(MOVED):
        random = Random(200 + seed)
        far = leg((0, 0, 0), (1, 2, 3), (1000, 2000))
        content = region([far], metric=metric, **chart_of(kind, "spatial", random))
        c = [Fraction(x).limit_denominator(1 << 40) for x in Placed(content, point_of(content)).place]
        for number, (linear, weights) in enumerate(
            (([2, -3, 5], [0, 0, 0]), ([1, 0, 0], [3, 1, 2]), ([0] * 3, [0, 0, 7]))
        ):
            value = sum(b * x - a * x * x for b, a, x in zip(linear, weights, c, strict=True))
            for step, status, line in ((1, "accepted", BROKEN), (-1, "rejected", BEYOND)):
                wrong = content | {"shape": [part(9), part(-value + Fraction(step, 500), linear, weights), part(8)]}
                yield f"shape {seed}, {number}, {step}", (pointed(wrong), status, line)
            wide = part(-value + Fraction(1, 50), linear, weights), part(-value - Fraction(1, 50), linear, weights)
            for shape, line in ((wide[0], INSIDE), (wide[1], EMPTY)):
                both = content | {"shape": [part(9), shape]}
                yield f"shape {seed}, {number}, all, {line[:5]}", (both, "rejected", line)
                yield f"shape {seed}, {number}, out, {line[:5]}", (as_map(both, "o"), "accepted", "")
            near = deepcopy(content) | {"shape": [wide[1]]}
            near["robot"]["legs"][0]["reach"] = None
            yield f"shape {seed}, {number}, out of it", (as_map(near, "o"), "accepted", "")
            yield f"shape {seed}, {number}, not in it", (as_map(near, "i"), "rejected", INSIDE)


def form_rows() -> Iterator[tuple[str, Row]]:
    """Forms that are 0 all over a chart, and with any of their numbers changed no longer."""
    for seed, kind in enumerate(("turns z", "yaw")):
        random = Random(300 + seed)
        content = region([leg((0, 0, 0), (1, 2, 3))], metric=[2, 3, 5], **_chart(kind, "spatial", random))
        form = vanishing_form(content, random)
        content["robot"]["forms"] = texts([[0] * 17, form])
        yield f"form {seed}", (content, "accepted", GOOD)
        for place in range(17):
            wrong = deepcopy(content)
            wrong["robot"]["forms"][1][place] = str(form[place] + 1)
            yield f"form {seed}: number {place}", (wrong, "rejected", "chart: its poses are not all")


CRANK = {"u": (1, 0, 0), "v": (0, 1, 0)}
AT_180 = {"place": ["x", 1, 2], "box": [[-2, 0]], "modes": [1], "points": [[-1]]}
FREE = {"motion": "spherical", "variables": ["yaw"], "box": [[0, "1/2"]], "place": [0, 0, 0]}
FREE |= {"turns": [[1, 0], [1, 0], ["yaw"]], "modes": [1]}
"""A rod from a crank to a point of the crank's axis: the crank turns freely, h, m and D are 0 at all poses."""


def free_crank(side: str) -> Content:
    """The rod is called within 30 degrees of an axis of the plane of the crank, with which it makes any angle."""
    return region([leg((0, 0, 0), (0, 0, 2), **CRANK, rod=5)], **FREE, **{side: [cone((1, 0, 0), 30)]})


def slide(*reach: Any, **entries: Any) -> Content:
    """q = 3 + y, y^2 = 25 - x^2, x from 3 to 4: from 6 to 7; with the other mode from -1 to 0."""
    driven = leg((0, 0, 0), (0, 3, 0), reach or None, direction=(0, 1, 0), rod=25)
    return region([driven], **{"modes": [1], **entries})


def aside(*reach: Any, box: Any, **entries: Any) -> Content:
    """q = x + y_1 with the mode 1, x - y_1 with -1, y_1^2 = 25 - y^2."""
    driven = leg((0, 0, 0), (0, 0, 0), reach or None, direction=(1, 0, 0), rod=25)
    plane = {"place": ["x", "y", 0], "variables": ["x", "y"], "box": box, "position": []}
    return region([driven], **plane, **{"modes": [1], **entries})


SMALL = Fraction(1, 1 << 60)
COPLANAR = [leg((0, 0, 0), (1, 0, 0)), leg((0, 0, 0), (0, 1, 0)), leg((0, 0, 0), (0, 0, 1))]
"""Pushed by (x, 0, 0): the determinant of what becomes of them is 1 + x."""
PUSHED = {"motion": "translation", "conditions": ["no_type_2"], "modes": [0] * 3, "box": [[-2, 2]]}

CASES: dict[str, Row] = {
    **{
        f"a slide between its ends, mode {mode}, {low} to {high}": (
            aside(low, high, box=[[0, 1], [3, 4]], modes=[mode]),
            "accepted" if good else "rejected",
            GOOD if good else INSIDE,
        )
        for mode, low, high, good in (
            *((1, 3, 5, True), (1, "7/2", 9, False), (1, 0, "9/2", False), (1, 0, "7/2", False)),
            *((-1, -4, -2, True), (-1, "-7/2", 9, False), (-1, -9, "-5/2", False), (-1, -9, "-7/2", False)),
        )
    },
    **{
        f"a slide out of its ends, mode {mode}, {low} to {high}": (
            as_map(aside(low, high, box=[[0, 1], [3, 4]], modes=[mode]), "o"),
            "accepted" if out else "rejected",
            "measure" if out else OUTSIDE,
        )
        for mode, low, high, out in (
            *((1, "9/2", 9, False), (1, "11/2", 9, True), (1, 0, "7/2", False), (1, 0, "5/2", True)),
            *((-1, "-5/2", 9, False), (-1, "-3/2", 9, True), (-1, -9, "-7/2", False), (-1, -9, "-9/2", True)),
        )
    },
    **{
        f"a determinant that is 0 where its root is rational, {points}": (
            region(
                [
                    leg((0, 0, 0), (0, 0, 0), direction=(1, 0, 0), rod=25),
                    leg((-1, "15/4", 0), (0, 0, 0)),
                    leg((0, 0, -1), (0, 0, 0)),
                ],
                variables=["y"],
                place=[0, "y", 0],
                motion="translation",
                modes=[1, 0, 0],
                conditions=["no_type_2"],
                box=[[0, 4]],
                points=points,
            ),
            status,
            line,
        )
        for points, status, line in (
            *(([[3], [4]], "rejected", ONE_SIGN), ([[0], [3]], "rejected", ONE_SIGN)),
            ([[0], [4]], "accepted", TWO_SIGNS),
        )
    },
    **{
        f"a root from {'3 on' if exact else 'less on'}, {high}": (
            aside("-1/2", high, box=[[0, "1/8"], box]),
            "accepted" if good else "rejected",
            GOOD if good else INSIDE,
        )
        for exact, box, high, good in (
            *((True, ["16/5", 4], 4, True), (True, ["16/5", 4], "7/2", False)),
            *((False, [3, "19/5"], "33/8", True), (False, [3, "19/5"], "15/4", False)),
        )
    },
    "a leg, exactly": (region(), "accepted", GOOD),
    "a leg, too short": (region([leg((0,) * 3, (0,) * 3, (3 + SMALL, 4))]), "rejected", INSIDE),
    "a leg, too long": (region([leg((0,) * 3, (0,) * 3, (3, 4 - SMALL))]), "rejected", INSIDE),
    "a leg at its least length": (region(points=[[3]]), "rejected", NO_FAILURE),
    "a leg at its greatest length": (region(points=[[4]]), "rejected", NO_FAILURE),
    "below the box": (region(points=[[3 - SMALL]]), "rejected", BEYOND),
    "above the box": (region(points=[[4 + SMALL]]), "rejected", BEYOND),
    "a leg longer at one end": (region(box=[[3, 5]], points=[[5]]), "accepted", BROKEN),
    "a leg shorter at one end": (region(box=[[2, 3]], points=[[2]]), "accepted", BROKEN),
    "on a shape": (region(box=[[3, 5]], points=[[5]], shape=[part(5, (-1, 0, 0))]), "accepted", BROKEN),
    "a slide": (slide(6 - SMALL, 7 + SMALL), "accepted", GOOD),
    "a slide, too low": (slide(6 + SMALL, 8), "rejected", INSIDE),
    "a slide, too high": (slide(5, 7 - SMALL), "rejected", INSIDE),
    "a slide, the other way": (slide(-1 - SMALL, SMALL, modes=[-1]), "accepted", GOOD),
    "a slide, the other way, too low": (slide(-1 + SMALL, 1, modes=[-1]), "rejected", INSIDE),
    "a slide, the other way, too high": (slide(-2, -SMALL, modes=[-1]), "rejected", INSIDE),
    "a slide in halves": (
        slide(6 - SMALL, 7 + SMALL, box=[[2, 4]], paving="sui", axes=[0], claim="undecided"),
        "accepted",
        "",
    ),
    "a slide in halves, too low": (
        slide(6 + SMALL, 9, box=[[2, 4]], paving="sui", axes=[0], claim="undecided"),
        "rejected",
        "",
    ),
    "a slide in halves, too high": (
        slide(0, 7 - SMALL, box=[[2, 4]], paving="sui", axes=[0], claim="undecided"),
        "rejected",
        "",
    ),
    "a slide in lower halves": (
        slide(6 - SMALL, 7 + SMALL, box=[[3, 5]], paving="siu", axes=[0], claim="undecided"),
        "accepted",
        "",
    ),
    "a slide at its end": (slide(box=[[4, 5]], conditions=["reachable"]), "accepted", GOOD),
    "a slide beyond its end": (slide(box=[[4, 5 + SMALL]], conditions=["reachable"]), "rejected", INSIDE),
    "a slide at its end is singular": (slide(box=[[4, 5]], conditions=["no_type_1"]), "rejected", INSIDE),
    "a slide at its end is singular there": (
        slide(box=[[4, 5]], conditions=["no_type_1"], points=[[5]]),
        "accepted",
        BROKEN,
    ),
    "a slide at its end is reached there": (
        slide(box=[[4, 5]], conditions=["reachable"], points=[[5]]),
        "rejected",
        NO_FAILURE,
    ),
    "a slide in a plane": (slide(6, 7, points=[["18/5"]]), "rejected", NO_FAILURE),
    "a slide not reached": (slide(6, 7, box=[[3, 6]], points=[["11/2"]]), "accepted", BROKEN),
    "outside from its end on": (
        slide(box=[[5, 6]], conditions=["no_type_1"], claim="map", measure=["0", "0"], paving="o"),
        "accepted",
        "",
    ),
    "not outside at its end": (
        slide(box=[[5, 6]], conditions=["reachable"], claim="map", measure=["0", "0"], paving="o"),
        "rejected",
        OUTSIDE,
    ),
    "a mode that does not matter": (slide(modes=[0]), "accepted", GOOD),
    "a mode that does not matter for what is reached": (
        slide(5, 8, modes=[0], conditions=["reachable"]),
        "accepted",
        GOOD,
    ),
    "a mode of limits": (slide(5, 8, modes=[0]), "malformed", "modes"),
    "a mode of cones": (slide(modes=[0], base_cones=[cone((1, 0, 0), 180)]), "malformed", "modes"),
    "a mode of cones of the platform": (slide(modes=[0], platform_cones=[cone((1, 0, 0), 180)]), "malformed", "modes"),
    "a mode of determinants": (slide(modes=[0], conditions=["no_type_2"]), "malformed", "modes"),
    "any cone": (slide(base_cones=[cone((1, 0, 0), 180)]), "accepted", GOOD),
    "a crank beyond a half turn": (
        region([leg((0, 0, 0), (0, 0, 0), (0, 0), **CRANK, rod=5)], **AT_180),
        "accepted",
        BROKEN,
    ),
    "a crank at a half turn": (
        region([leg((0, 0, 0), (0, 0, 0), (180, 180), **CRANK, rod=5)], **AT_180),
        "rejected",
        NO_FAILURE,
    ),
    "a crank at an end": (
        region([leg((0, 0, 0), (0, 0, 0), (90, 180), **CRANK, rod=5)], **AT_180),
        "rejected",
        NO_FAILURE,
    ),
    "a crank at another end": (
        region([leg((0, 0, 0), (0, 0, 0), (180, 270), **CRANK, rod=5)], **AT_180),
        "rejected",
        NO_FAILURE,
    ),
    "a crank before its range": (
        region([leg((0, 0, 0), (0, 0, 0), (-90, 90), **CRANK, rod=5)], **AT_180),
        "accepted",
        BROKEN,
    ),
    "a crank in all of a turn": (
        region([leg((0, 0, 0), (0, 0, 0), (-270, 90), **CRANK, rod=5)], **AT_180),
        "rejected",
        NO_FAILURE,
    ),
    "a crank in more than a turn": (
        region([leg((0, 0, 0), (0, 0, 0), (0, 450), **CRANK, rod=5)], **AT_180),
        "rejected",
        NO_FAILURE,
    ),
    "a free crank in a cone": (free_crank("base_cones"), "rejected", "cones: a leg has no direction"),
    "a free crank in a cone of the platform": (
        free_crank("platform_cones"),
        "rejected",
        "cones: a leg has no direction",
    ),
    "a free crank": (region([leg((0, 0, 0), (0, 0, 2), **CRANK, rod=5)], **FREE), "accepted", GOOD),
    "a leg without length": (
        region([leg((0,) * 3, (0,) * 3)], conditions=["no_type_1"], box=[[0, 1]], points=[[0]]),
        "accepted",
        BROKEN,
    ),
    "a leg with some length": (
        region([leg((0,) * 3, (0,) * 3)], conditions=["no_type_1"], box=[[0, 1]], points=[[SMALL]]),
        "rejected",
        NO_FAILURE,
    ),
    "legs of length 0": (
        region(
            [leg((0, 0, 0), (0, 0, 0))], **{**FREE, "modes": [0]}, conditions=["no_type_1"], claim="map", paving="o"
        ),
        "accepted",
        "",
    ),
    "two signs": (region(COPLANAR, **PUSHED, points=[[-2], [0]]), "accepted", TWO_SIGNS),
    "two signs, the other way": (region(COPLANAR, **PUSHED, points=[[0], [-2]]), "accepted", TWO_SIGNS),
    "one positive sign": (region(COPLANAR, **PUSHED, points=[[1], [2]]), "rejected", ONE_SIGN),
    "one negative sign": (region(COPLANAR, **PUSHED, points=[["-3/2"], [-2]]), "rejected", ONE_SIGN),
    "a sign and 0": (region(COPLANAR, **PUSHED, points=[[-1], [0]]), "rejected", ONE_SIGN),
    "0 and a sign": (region(COPLANAR, **PUSHED, points=[[-2], [-1]]), "rejected", ONE_SIGN),
    "0 twice": (region(COPLANAR, **PUSHED, points=[[-1], [-1]]), "rejected", ONE_SIGN),
    "singular there": (region(COPLANAR, **PUSHED, points=[[-1]]), "accepted", BROKEN),
    "not singular there": (region(COPLANAR, **PUSHED, points=[[-1 + SMALL]]), "rejected", NO_FAILURE),
    "not singular": (region(COPLANAR, **{**PUSHED, "box": [[0, 2]]}), "accepted", GOOD),
    "not singular, negative": (region(COPLANAR, **{**PUSHED, "box": [[-3, -2]]}), "accepted", GOOD),
    "singular at an end": (region(COPLANAR, **{**PUSHED, "box": [[-1, 2]]}), "rejected", INSIDE),
    "singular at the other end": (region(COPLANAR, **{**PUSHED, "box": [[-2, -1]]}), "rejected", INSIDE),
    "never outside": (
        region(COPLANAR, **{**PUSHED, "box": [[0, 2]]}, claim="map", paving="o", measure=["0", "0"]),
        "rejected",
        OUTSIDE,
    ),
    "never outside, negative": (
        as_map(region(COPLANAR, **{**PUSHED, "box": [[-3, -2]]}), "o"),
        "rejected",
        OUTSIDE,
    ),
    "two legs of three": (region(COPLANAR[:2], **{**PUSHED, "modes": [0] * 2}), "malformed", "conditions: as many"),
    "four legs of three": (
        region([*COPLANAR, ALONG], **{**PUSHED, "modes": [0] * 4}),
        "malformed",
        "conditions: as many",
    ),
    "nowhere": (region(points=[]), "malformed", "counterexample: neither"),
    "two poses without a determinant": (region(points=[[3], [4]]), "malformed", "counterexample: neither"),
    "three poses": (region(COPLANAR, **PUSHED, points=[[-2], [0], [1]]), "malformed", "counterexample: neither"),
}

# Bounds of roots, and signs with roots in them

PLANE = {"place": ["x", "y", 0], "variables": ["x", "y"], "box": [[3, 4], [0, 2]], "position": [[3, "7/2"]]}
FREELY = [leg((0, 0, 0), (0, 0, 0))]
AROUND = {"place": ["x", 1, 2], "modes": [1]}

IRRATIONAL = (Fraction(7, 2), Fraction(9, 2))
"""Between these y^2 = 25 - x^2 falls from 51/4 to 19/4."""
NEXT = 1 << 120


def _root(square: Fraction, up: bool) -> Fraction:
    """The root, off by less than 2^-120."""
    return Fraction(isqrt(int(square * NEXT * NEXT)) + up, NEXT)


FAR, NEAR = Fraction(51, 4), Fraction(19, 4)
SLACK = Fraction(1, 1 << 70)


def _rounded(low: Fraction, high: Fraction, mode: int = 1) -> Content:
    return slide(low, high, box=[IRRATIONAL], modes=[mode])


def _short(*reach: Any, **entries: Any) -> Content:
    """y^2 = 1/4 - x^2, x from 3/10 to 4/10: y from 3/10 to 4/10."""
    driven = leg((0, 0, 0), (0, 3, 0), reach or None, direction=(0, 1, 0), rod="1/4")
    return region([driven], **{"modes": [1], "box": [["3/10", "2/5"]], **entries})


TOUCHING = leg((0, 0, 0), (0, 3, 0), (3, 4), direction=(1, 0, 0), rod=9)
"""The rod is at right angles to its slide: D is 0 at all poses."""


def _mixed(*rods: int, points: Any, modes: Any = None, **entries: Any) -> Content:
    """x (1 + s y) times what is alike for further slides, y^2 = rod - x^2; at rod 25 it is x (1 - y) with s = -1."""
    slides = [leg((0, 0, 0), (0, 3, 0), direction=(0, 1, 0), rod=rod) for rod in rods]
    others = [leg((0, 0, 0), (0, 1, 0)), leg((0, 0, 0), (0, 0, 1))][len(rods) - 1 :]
    motion = {"motion": "translation", "conditions": ["no_type_2"], "box": [[-9, 9]]}
    return region(
        [*slides, *others], **motion, modes=modes or [-1] * len(rods) + [0] * len(others), points=points, **entries
    )


def _even(points: Any) -> Content:
    """2 x - y z in the plane z = 0, y^2 = 3 - x^2 and z^2 = 2: it is 0 at x = 1, by roots that are not rational."""
    one = leg((0, 0, 0), (0, 3, 0), direction=(0, 1, 0), rod=3)
    other = leg((0, 0, 0), (0, 2, 0), direction=(1, 0, 0), rod=6)
    form = [0] * 17
    form[6] = 1
    motion = {"motion": "translation", "conditions": ["no_type_2"], "box": [[-1, 1]]}
    return region([one, other], forms=[form], **motion, modes=[1, 1], points=points)


def _cut(least: str) -> Content:
    """x up to a number, where lengths up to 9/2 are allowed; the last quarter is beyond the shape, or not."""
    bounded = leg((0, 0, 0), (0, 0, 0), (3, "9/2"))
    return region([bounded], box=[[3, 5]], shape=[part(least, (-1, 0, 0))], paving="sisii", axes=[0, 0])


ROOTS: dict[str, Row] = {
    "roots, with room": (_rounded(3 + _root(NEAR, False) - SLACK, 3 + _root(FAR, True) + SLACK), "accepted", GOOD),
    "roots, too low": (_rounded(3 + _root(NEAR, True), 9), "rejected", INSIDE),
    "roots, too high": (_rounded(Fraction(1), 3 + _root(FAR, False)), "rejected", INSIDE),
    "a root of 4 and less than 2^-160, too high": (
        region(
            [leg((0, 0, 0), (0, 3, 0), (0, 7), direction=(0, 1, 0), rod=25 + Fraction(1, 1 << 161))],
            modes=[1],
        ),
        "rejected",
        INSIDE,
    ),
    "any angle with an axis, on so large a part": (
        region(
            [leg((0, 0, 0), (0, 0, 0))],
            base_cones=[cone((0, 0, -1), 180)],
            motion="translation",
            variables=["x", "z"],
            place=["x", 0, "z"],
            box=[[-1, 1], [2, 3]],
        ),
        "rejected",
        INSIDE,
    ),
    "a length from 1": (region(FREELY, box=[[1, 2]], conditions=["no_type_1"]), "accepted", GOOD),
    "other roots, with room": (
        _rounded(3 - _root(FAR, True) - SLACK, 3 - _root(NEAR, False) + SLACK, -1),
        "accepted",
        GOOD,
    ),
    "other roots, too low": (_rounded(3 - _root(FAR, False), Fraction(3), -1), "rejected", INSIDE),
    "other roots, too high": (_rounded(Fraction(-9), 3 - _root(NEAR, True), -1), "rejected", INSIDE),
    "small roots": (_short(Fraction(33, 10) - SLACK, Fraction(34, 10) + SLACK), "accepted", GOOD),
    "small roots, too high": (_short(3, Fraction(34, 10) - SLACK), "rejected", INSIDE),
    "small roots, much too high": (_short(3, Fraction(31, 10)), "rejected", INSIDE),
    "small roots, too low": (_short(Fraction(33, 10) + SLACK, 4), "rejected", INSIDE),
    "small roots outside": (as_map(_short(3, "13/4"), "o"), "accepted", ""),
    "a rod that touches": (region([TOUCHING], modes=[1]), "accepted", GOOD),
    "a rod that touches, the other way": (region([TOUCHING], modes=[-1]), "accepted", GOOD),
    "a slide outside of its end": (as_map(slide(0, Fraction(29, 10), box=[[4, 6]]), "o"), "accepted", ""),
    "a slide not outside of its end": (as_map(slide(0, Fraction(7, 2), box=[[4, 6]]), "o"), "rejected", OUTSIDE),
    "signs with a root of 0": (_mixed(25, points=[[3], [5]]), "accepted", TWO_SIGNS),
    "signs with a small root": (_mixed(25, points=[[3], ["49/10"]]), "accepted", TWO_SIGNS),
    "signs with a root, one sign": (_mixed(25, points=[[3], [4]]), "rejected", ONE_SIGN),
    "signs with a root, not reached": (_mixed(25, points=[[3], [6]]), "rejected", ONE_SIGN),
    "signs with a root, hardly reached": (_mixed(25, points=[[3], ["501/100"]]), "rejected", ONE_SIGN),
    "signs with two roots, the first not reached": (_mixed(25, 36, points=[[3], ["11/2"]]), "rejected", ONE_SIGN),
    "signs with two roots, the last not reached": (_mixed(36, 25, points=[[3], ["11/2"]]), "rejected", ONE_SIGN),
    "a mode of determinants, unnamed": (_mixed(25, points=[[3], [5]], modes=[0, 0, 0]), "malformed", "modes"),
    "a sign that is 0 by roots": (_even([[1], ["1/2"]]), "rejected", ONE_SIGN),
    "a sign that is 0 by roots, last": (_even([["1/2"], [1]]), "rejected", ONE_SIGN),
    "a determinant that is 0 by roots": (_even([[1]]), "rejected", NO_FAILURE),
    "(+, 0)": (region(COPLANAR, **PUSHED, points=[[0], [-1]]), "rejected", ONE_SIGN),
    "(0, -)": (region(COPLANAR, **PUSHED, points=[[-1], [-2]]), "rejected", ONE_SIGN),
    "not singular there, negative": (region(COPLANAR, **PUSHED, points=[[-1 - SMALL]]), "rejected", NO_FAILURE),
    "singular everywhere": (region([COPLANAR[0], *COPLANAR[:2]], **PUSHED, points=[[1]]), "accepted", BROKEN),
    "nowhere singular": (region(COPLANAR, **PUSHED, points=[]), "malformed", "counterexample: neither"),
    "beyond a shape that is empty": (region(box=[[3, 5]], points=[[5]], shape=[part(-1)]), "rejected", BEYOND),
    "beyond the box in y": (
        region(FREELY, **{**PLANE, "position": [[3, "7/2"]]}, points=[[4, 9]]),
        "rejected",
        BEYOND,
    ),
    "a leg that is not outside": (
        as_map(region([leg((0,) * 3, (0,) * 3)], box=[[0, 1]], conditions=["no_type_1"]), "o"),
        "rejected",
        OUTSIDE,
    ),
    "a position a unit below": (region(FREELY, box=[[2, 3]], position=[[3, 9]]), "rejected", INSIDE),
    "a position a unit above": (region(FREELY, box=[[9, 10]], position=[[3, 9]]), "rejected", INSIDE),
    "a lower half beyond": (
        region(FREELY, position=[[3, "349/100"]], paving="siu", claim="undecided"),
        "rejected",
        "paving: the part of letter 2",
    ),
    "an upper half beyond": (
        region(FREELY, position=[["351/100", 4]], paving="sui", claim="undecided"),
        "rejected",
        "paving: the part of letter 3",
    ),
    "beyond a first part of a shape": (region(shape=[part(-1), part(1)]), "rejected", EMPTY),
    "the middle on the edge of a shape": (region(shape=[part("-7/2", (1, 0, 0))]), "accepted", GOOD),
    "a map of places": (
        region(
            FREELY,
            variables=["x", "y", "z"],
            place=["x", "y", "z"],
            box=[[2, 4], [0, 3], [1, 2]],
            position=[[2, 4], [0, 3], [1, 2]],
            claim="map",
            measure=["6", "6"],
        ),
        "accepted",
        "measure: between",
    ),
    "beyond a shape": (_cut("449/100"), "accepted", GOOD),
    "not beyond a shape": (_cut("23/5"), "rejected", "paving: the part of letter 5"),
    "a wide map": (
        region(FREELY, box=[[2, 4]], position=[[2, 3]], paving="siu", claim="map", measure=["1", "2"]),
        "accepted",
        "measure: between",
    ),
    "a wide map, narrow": (
        region(FREELY, box=[[2, 4]], position=[[2, 3]], paving="siu", claim="map", measure=["1/2", "1"]),
        "rejected",
        "measure: not that",
    ),
    "a joint that forbids all": (region(forms=[[0] * 16 + [1]]), "rejected", "chart: its poses are not all"),
    "an obtuse cone": (region(base_cones=[cone((-1, 6, 0), 120)]), "accepted", GOOD),
    "an obtuse cone, there": (region(base_cones=[cone((-1, 6, 0), 120)], points=[[3]]), "rejected", NO_FAILURE),
    "an obtuse cone along its axis": (region(base_cones=[cone((1, 0, 0), 120)], points=[[3]]), "rejected", NO_FAILURE),
    "an obtuse cone from behind": (region(base_cones=[cone((-1, 0, 0), 120)], points=[[3]]), "accepted", BROKEN),
    "a right cone, which corners do not prove": (
        slide(box=[[4, 5]], base_cones=[cone((1, 1, 0), 90)]),
        "rejected",
        INSIDE,
    ),
    "a crank all around": (
        region([leg((0, 0, 0), (0, 0, 0), (0, 360), **CRANK, rod=5)], **{**AROUND, "box": [["-11/10", "-9/10"]]}),
        "accepted",
        GOOD,
    ),
    "a crank half around": (
        region([leg((0, 0, 0), (0, 0, 0), (90, 270), **CRANK, rod=5)], **{**AROUND, "box": [["-11/10", "-9/10"]]}),
        "accepted",
        GOOD,
    ),
}

# Words, counts and measures: x from 3 to 4 is in the limits up to 7/2

LETTERS = "paving: the part of letter"


def word(paving: str, claim: str = "map", **entries: Any) -> Content:
    """A paving of these poses."""
    measure = {"measure": ["1", "3/2"] if claim == "map" else None}
    return region(FREELY, **PLANE, **{"axes": [0, 0], **measure, **entries}, claim=claim, paving=paving)


WORDS: dict[str, Row] = {
    "a map": (word("sisuo"), "accepted", "measure: between"),
    "a map along y first": (word("ssisuosisuo", axes=[1, 0, 0]), "accepted", "measure: between"),
    "a map along y": (word("sisuo", axes=[0, 1]), "rejected", f"{LETTERS} 5"),
    "a map of halves along y": (word("sii", axes=[1]), "rejected", f"{LETTERS} 2"),
    "the upper half is not inside": (word("sii"), "rejected", f"{LETTERS} 3 is not proved to be inside"),
    "the upper half is not outside": (word("sio"), "rejected", f"{LETTERS} 3 is not proved to be outside"),
    "a quarter is not inside": (word("sisio"), "rejected", f"{LETTERS} 4 is not proved to be inside"),
    "a half too deep": (word("sisuo", axes=[0]), "rejected", "paving: letter 3 halves"),
    "no halves": (word("sisuo", axes=[]), "rejected", "paving: letter 1 halves"),
    "halves to spare": (word("sisuo", axes=[0, 0, 1]), "accepted", "measure: between"),
    "no part": (word(""), "rejected", "paving: parts of the region are missing"),
    "a part missing": (word("sisu"), "rejected", "paving: parts of the region are missing"),
    "a part more": (word("sisuou"), "rejected", "paving: it goes on"),
    "a least measure": (word("sisuo", measure=["3/4", "3/2"]), "rejected", "measure: not that"),
    "a greatest measure": (word("sisuo", measure=["1", "2"]), "rejected", "measure: not that"),
    "no measure": (word("sisuo", measure=None), "rejected", "measure: not that"),
    "a measure of all": (word("u", "undecided", measure=["0", "2"]), "rejected", "measure: claimed"),
    "nothing decided": (word("u", "undecided"), "accepted", "claim: none but"),
    "some outside": (word("sisuo", "undecided"), "accepted", "claim: none but"),
    "outside alone": (
        region(FREELY, **{**PLANE, "box": [[4, 5], [0, 1]]}, paving="o", claim="undecided"),
        "accepted",
        "claim: none",
    ),
    "all undecided": (
        region(FREELY, **{**PLANE, "box": [[3, "7/2"], [0, 1]]}, claim="undecided"),
        "rejected",
        "claim: all parts",
    ),
    "all of it": (region(FREELY, **{**PLANE, "box": [[3, "7/2"], [0, 1]]}), "accepted", GOOD),
    "all of it, undecided": (word("siu", "all"), "rejected", "claim: not all parts"),
    "all of it, outside": (
        region(FREELY, **{**PLANE, "box": [[4, 5], [0, 1]]}, paving="o"),
        "rejected",
        "claim: not all parts",
    ),
    "one more inside": (word("sisuo", inside=2), "rejected", "inside, undecided"),
    "one less inside": (word("sisuo", inside=0), "rejected", "inside, undecided"),
    "one more undecided": (word("sisuo", undecided=2), "rejected", "inside, undecided"),
    "one less undecided": (word("sisuo", undecided=0), "rejected", "inside, undecided"),
    "a map of turns": (region(FREELY, **FREE | {"modes": [0]}, claim="map"), "accepted", "paving: 1 parts"),
    "a measure of turns": (
        region(FREELY, **FREE | {"modes": [0]}, claim="map", measure=["1", "1"]),
        "rejected",
        "measure: claimed",
    ),
    "a measure of all that is good": (region(measure=["1", "1"]), "rejected", "measure: claimed"),
    **{
        f"beside a pose: {key}": (
            region(box=[[3, 5]], points=[[5]]) | {key: value},
            "malformed",
            "paving: there is one",
        )
        for key, value in {"paving": "i", "inside": 1, "undecided": 1, "measure": ["0", "0"]}.items()
    },
    "a pose beside parts": (region(counterexample=[["3"]]), "malformed", "counterexample: there is one"),
}

# Cones and cranks, angle by angle


def _cosines() -> dict[str, Row]:
    """A leg along x, and axes one degree within the angle of a cone or beyond it."""
    found: dict[str, Row] = {}
    for angle in ANGLES:
        for step, status, line in ((-1, "accepted", GOOD), (1, "rejected", INSIDE)):
            if angle + step <= 180:
                turned = radians(angle + step)
                axis = [Fraction(x).limit_denominator(10**6) for x in (cos(turned), sin(turned), 0)]
                content = region(base_cones=[cone(axis, angle)])
                found[f"a cone of {angle} degrees, {step}"] = (content, status, line)
                if step > 0:
                    found[f"a cone of {angle} degrees, there"] = (pointed(content), "accepted", BROKEN)
    return found


def _quadrants() -> dict[str, Row]:
    """A crank that is somewhere in each quadrant, and ranges of all of them."""
    found: dict[str, Row] = {}
    for angle in (15, 40, 75, 105, 130, 165, 195, 220, 255, 285, 310, 345):
        c, s = (Fraction(x).limit_denominator(100) for x in (cos(radians(angle)), sin(radians(angle))))
        place = {"place": ["x", 2 * s, 2], "box": [[2 * c, 2 * c + Fraction(1, 1 << 14)]], "modes": [1]}
        for start in (0, 90, 180, 270, *((8100,) if angle == 220 else ())):
            crank = leg((0, 0, 0), (0, 0, 0), (start, start + 90), **CRANK, rod="5001/1000")
            content = region([crank], **place)
            margin = min(Placed(content, point_of(content)).margins())
            assert abs(margin) > 1
            good = margin > 0
            name = f"a crank at {angle} degrees from {start} on"
            found[name] = (content, "accepted" if good else "rejected", GOOD if good else INSIDE)
            found[f"{name}, there"] = (
                pointed(content),
                "rejected" if good else "accepted",
                NO_FAILURE if good else BROKEN,
            )
    return found


def _wide_ranges() -> dict[str, Row]:
    """A crank somewhere in three quadrants is nowhere outside of them, though it may be outside of a half of them."""
    found: dict[str, Row] = {}
    for angle in (40, 135, 220, 310):
        c, s = (Fraction(x).limit_denominator(100) for x in (cos(radians(angle)), sin(radians(angle))))
        place = {"place": ["x", 2 * s, 2], "box": [[2 * c, 2 * c + Fraction(1, 1 << 14)]], "modes": [1]}
        for start in (0, 90, 180, 270):
            crank = leg((0, 0, 0), (0, 0, 0), (start, start + 270), **CRANK, rod="5001/1000")
            content = as_map(region([crank], **place), "o")
            good = min(Placed(content, point_of(content)).margins()) > 0
            status, line = ("rejected", OUTSIDE) if good else ("accepted", "measure")
            found[f"a crank at {angle} degrees, out of three quadrants from {start} on"] = content, status, line
    return found


WIDE_CRANK = leg((0, 0, 0), (0, 0, 0), u=(1, 0, 0), v=(0, 2, 0), weight=4, rod="361/100")
UNREACHED = {"place": ["x", 3, 0], "box": [[0, "1/100"]], "modes": [1], "conditions": ["reachable"]}
TALL = leg((0, 0, 0), (0, 1, 0), ("1/2", 9))
ANGLED: dict[str, Row] = {
    **_cosines(),
    **_quadrants(),
    **_wide_ranges(),
    "a crank of weight 4 too far away": (region([WIDE_CRANK], **UNREACHED), "rejected", INSIDE),
    "a crank of weight 4 too far away, there": (pointed(region([WIDE_CRANK], **UNREACHED)), "accepted", BROKEN),
    "no leg": (region([], modes=[]), "malformed", ""),
    "proved by no coefficients of its degree": (region([TALL], box=[[-1, 1]]), "rejected", INSIDE),
    "proved in halves": (region([TALL], box=[[-1, 1]], paving="sii"), "accepted", GOOD),
}

# The format

UNTURNED = [[1, 0], [-2, 0], [1, 0]]
_TURNED: list[list[Any]] = [[[1, 2], *UNTURNED[1:]], [UNTURNED[0], [1, 2], UNTURNED[2]], [*UNTURNED[:2], [1, 2]]]


def _group(motion: str, status: str, line: str = "chart", **entries: Any) -> Row:
    base: Content = {"place": [0, 0, 0] if motion == "spherical" else ["x", 0, 0], "motion": motion}
    if motion == "spherical":
        base |= {"variables": ["yaw"], "turns": [*UNTURNED[:2], ["yaw"]]}
    return region(FREELY, **base | entries), status, GOOD if status == "accepted" else line


GROUPS: dict[str, Row] = {
    "planar, above": _group("planar", "malformed", place=["x", 0, 1]),
    "planar, below": _group("planar", "malformed", place=["x", 0, -1]),
    "planar, a variable height": _group("planar", "malformed", place=[3, 0, "z"], variables=["z"]),
    "planar, turned": _group("planar", "accepted", quaternion=[3, 0, 0, 1]),
    "planar, tilted": _group("planar", "malformed", quaternion=[3, 1, 0, 0]),
    "planar, tilted about y": _group("planar", "malformed", quaternion=[3, 0, 1, 0]),
    "Schoenflies, turned": _group("schoenflies", "accepted", place=["x", 1, 2], quaternion=[3, 0, 0, 1]),
    "Schoenflies, tilted": _group("schoenflies", "malformed", quaternion=[3, 1, 0, 0]),
    "Schoenflies, tilted about y": _group("schoenflies", "malformed", quaternion=[3, 0, 1, 0]),
    "Schoenflies, turning": _group(
        "schoenflies", "accepted", turns=[*UNTURNED[:2], ["yaw"]], variables=["x", "yaw"], box=[[0, 1]] * 2
    ),
    "Schoenflies, tilting": _group(
        "schoenflies", "malformed", turns=[["roll"], *UNTURNED[1:]], variables=["x", "roll"], box=[[0, 1]] * 2
    ),
    "Schoenflies, tilting about y": _group(
        "schoenflies",
        "malformed",
        turns=[UNTURNED[0], ["pitch"], UNTURNED[2]],
        variables=["x", "pitch"],
        box=[[0, 1]] * 2,
    ),
    "spherical": _group("spherical", "accepted", turns=[[1, 2], [2, 1], ["yaw"]]),
    **{
        f"spherical, moved along {'xyz'[k]}": _group("spherical", "malformed", place=[int(i == k) for i in range(3)])
        for k in range(3)
    },
    "spherical, moved back": _group("spherical", "malformed", place=[0, -1, 0]),
    "translation": _group("translation", "accepted", turns=UNTURNED),
    **{
        f"{motion}, turned {k}": _group(
            motion, "accepted" if k == 2 and motion != "translation" else "malformed", turns=turns
        )
        for motion in ("translation", "schoenflies", "planar")
        for k, turns in enumerate(_TURNED)
    },
    **{
        f"translation, turned {k}, by a quaternion": _group(
            "translation", "malformed", quaternion=[1, *(int(k == i) for i in range(3))]
        )
        for k in range(3)
    },
}


def _with(status: str, value: Any, *path: Any, **entries: Any) -> Row:
    content = region(**entries)
    entry = content
    for key in path[:-1]:
        entry = entry[key]
    entry[path[-1]] = value
    return content, status, ""


def _crank(status: str, reach: Any = None, **entries: Any) -> Row:
    return (
        region(
            [leg((0, 0, 0), (0, 0, 0), reach, **{**CRANK, "rod": 16, **entries})], modes=[1], conditions=["reachable"]
        ),
        status,
        "",
    )


ROBOT, CHART = "robot", "chart"
FORMAT: dict[str, Row] = {
    "12 legs": (region([ALONG] * 12), "accepted", GOOD),
    "13 legs": (region([ALONG] * 13), "too-large", "robot.legs: more than 12"),
    "64 forms": (region(forms=[[0] * 17] * 64), "accepted", GOOD),
    "65 forms": (region(forms=[[0] * 17] * 65), "too-large", "robot.forms: more than 64"),
    "64 parts of a shape": (region(shape=[part(1)] * 64), "accepted", GOOD),
    "65 parts of a shape": (region(shape=[part(1)] * 65), "too-large", "shape: more than 64"),
    "120 axes": (region(axes=[0] * 120), "accepted", GOOD),
    "121 axes": (region(axes=[0] * 121), "too-large", "axes: more than 120"),
    "an axis beyond": _with("malformed", [0, 1, 0], "axes"),
    "an axis beyond, first": _with("malformed", [1, 0], "axes"),
    "an axis beyond, last": _with("malformed", [0, 1], "axes"),
    "an axis before": _with("malformed", [0, -1], "axes"),
    "three limits of the position": (region(position=[[3, 4], [0, 0], [0, 0]]), "accepted", GOOD),
    "four limits of the position": (region(position=[[3, 4], [0, 0], [0, 0], [0, 0]]), "malformed", ""),
    "limits out of order": (region(position=[[4, 3]]), "malformed", ""),
    "a shape of 16 numbers": _with("malformed", [["0"] * 16], ROBOT, "forms"),
    "no modes": _with("malformed", [], "modes"),
    **{
        f"a mode {mode}": _with("accepted" if abs(mode) < 2 else "malformed", [mode], "modes")
        for mode in (-2, -1, 1, 2)
    },
    "two modes, the first none": (region([ALONG] * 2, modes=[2, 0]), "malformed", ""),
    "two modes, the last none": (region([ALONG] * 2, modes=[0, 2]), "malformed", ""),
    "a mode of true": _with("malformed", [True], "modes"),
    "a metric of halves, first": _with("malformed", ["1/2", "1", "1"], ROBOT, "metric"),
    "a metric of halves, last": _with("malformed", ["1", "1", "1/2"], ROBOT, "metric"),
    "a metric of 0": _with("malformed", ["1", "0", "1"], ROBOT, "metric"),
    "two cones of a leg": (region(base_cones=[cone((1, 0, 0), 180)] * 2), "malformed", ""),
    "two cones of a leg's end": (region(platform_cones=[cone((1, 0, 0), 180)] * 2), "malformed", ""),
    "one cone of two legs": (region([ALONG] * 2, base_cones=[cone((1, 0, 0), 180)]), "malformed", ""),
    **{
        f"a cone of {angle} degrees": _with(
            "malformed", str(angle), ROBOT, "base_cones", 0, "degrees", base_cones=[cone((1, 0, 0), 30)]
        )
        for angle in (0, 29, 31, 44, 46, 59, 61, 89, 91, 119, 121, 134, 136, 149, 151, 179, 181)
    },
    **{
        f"an axis along {k}": (region(base_cones=[cone([int(i == k) for i in range(3)], 180)]), "accepted", GOOD)
        for k in range(3)
    },
    "a leg from 0 on": (region([leg((0,) * 3, (0,) * 3, (0, 4))]), "accepted", GOOD),
    "a leg from less than 0 on": (region([leg((0,) * 3, (0,) * 3, (-SMALL, 4))]), "malformed", ""),
    "a leg of one length": (region([leg((0,) * 3, (0,) * 3, (3, 3))]), "rejected", INSIDE),
    "a slide from less than 0 on": (slide(-1, 8), "accepted", GOOD),
    "a crank": _crank("accepted"),
    "a crank of right angles": _crank("accepted", (-90, 450)),
    "a crank from 45 degrees": _crank("malformed", (45, 90)),
    "a crank to 135 degrees": _crank("malformed", (90, 135)),
    "a crank of weight 4": _crank("accepted", v=(0, 2, 0), weight=4),
    "a crank of weight 4 with limits": _crank("malformed", (0, 90), v=(0, 2, 0), weight=4),
    "a crank of weight 1/4": _crank("malformed", v=(0, "1/2", 0), weight="1/4"),
    "a crank of another weight": _crank("malformed", v=(0, 2, 0), weight=3),
    "a crank of less weight": _crank("malformed", v=(0, 2, 0), weight=5),
    "a crank of weight 0": _crank("malformed", v=(0, 0, 0), weight=0),
    "a crank of nothing": _crank("malformed", u=(0, 0, 0), v=(0, 0, 0)),
    "a crank that is an ellipse": _crank("malformed", v=(1, 1, 0), weight=2),
    "a crank that is an ellipse, too": _crank("malformed", v=(-1, 1, 0), weight=2),
    "a crank without a rod": _crank("malformed", rod=0),
    "a slide along nothing": (
        region([leg((0,) * 3, (0,) * 3, direction=(0, 0, 0), rod=1)], modes=[1]),
        "malformed",
        "",
    ),
    "a point for a box": (region(box=[[3, 3]]), "malformed", ""),
    "a box from 4 to 3": (region(box=[[4, 3]]), "malformed", ""),
    "two variables, one a point": (region(**{**PLANE, "position": [], "box": [[3, 3], [0, 1]]}), "malformed", ""),
    "two variables, the other a point": (region(**{**PLANE, "position": [], "box": [[3, 4], [1, 1]]}), "malformed", ""),
    "no variables": (region(variables=[], box=[], place=[3, 0, 0], axes=[]), "malformed", ""),
    "a variable twice": (region(variables=["x", "x"], box=[[3, 4]] * 2), "malformed", ""),
    "variables in another order": (
        region(variables=["y", "x"], place=["x", "y", 0], box=[[3, 4]] * 2),
        "malformed",
        "",
    ),
    "a variable that is no coordinate": (region(variables=["w"], place=["w", 0, 0]), "malformed", ""),
    "another variable's place": (region(variables=["x", "y"], place=["y", "x", 0], box=[[3, 4]] * 2), "malformed", ""),
    "a variable in two places": (region(place=["x", "x", 0]), "malformed", ""),
    "a variable without a place": (region(variables=["x", "y"], box=[[3, 4]] * 2), "malformed", ""),
    "a place of a variable that there is not": (region(place=["x", "y", 0]), "malformed", ""),
    "a variable turn without its name": (region(turns=[[1, 0], [1, 0], ["yaw"]]), "malformed", ""),
    "a turn for a place": (region(variables=["x", "yaw"], place=["x", "yaw", 0], box=[[3, 4]] * 2), "malformed", ""),
    "a turn of another name": (
        region(variables=["x", "yaw"], turns=[["yaw"], [1, 0], [1, 0]], box=[[3, 4]] * 2),
        "malformed",
        "",
    ),
    "a place for a turn": (region(turns=[["x"], [1, 0], [1, 0]]), "malformed", ""),
    "a turn of nothing": (region(turns=[[1, 0], [0, 0], [1, 0]]), "malformed", ""),
    "half a turn": (region(turns=[[1, 0], [0, 1], [1, 0]]), "accepted", GOOD),
    "two turns": (region(turns=[[1, 0], [1, 0]]), "malformed", ""),
    "no orientation": _with("malformed", None, CHART, "quaternion"),
    "turns beside a quaternion": _with("malformed", [["1", "0"]] * 3, CHART, "turns"),
    "a quaternion of nothing": (region(quaternion=[0, 0, 0, 0]), "malformed", ""),
    **{
        f"a quaternion of {k} alone": (region(quaternion=[int(i == k) for i in range(4)]), "accepted", GOOD)
        for k in range(4)
    },
    "a quaternion of three": (region(quaternion=[1, 0, 0]), "malformed", ""),
    **{
        f"a weight below 0: {k}": (
            region(shape=[part(1), part(1, weights=[-int(i == k) for i in range(3)])]),
            "malformed",
            "shape: a weight",
        )
        for k in range(3)
    },
    "a weight below 0 in the first part": (
        region(shape=[part(1, weights=(-1, 0, 0)), part(1)]),
        "malformed",
        "shape: a weight",
    ),
    "weights above 0": (region(shape=[part(100, weights=(1, 2, 3))]), "accepted", GOOD),
    "conditions in another order": (region(conditions=["limits", "reachable"]), "malformed", ""),
    "a condition twice": (region(conditions=["limits", "limits"]), "malformed", ""),
    "no condition": (region(conditions=[]), "malformed", ""),
    "two conditions": (region(conditions=["reachable", "limits"]), "accepted", GOOD),
    "a crank of weight 3/2 on a circle": _crank("malformed", weight="3/2"),
    "a leg of its own length and more": _with("malformed", {"type": "length", "more": 1}, ROBOT, "legs", 0, "actuator"),
    "a cone about nothing": (region(base_cones=[cone((0, 0, 0), 30)]), "malformed", ""),
    "a cone of the platform about nothing": (region(platform_cones=[cone((0, 0, 0), 30)]), "malformed", ""),
    "x in the place of y": (region(place=[0, "x", 0]), "malformed", ""),
    "y in the place of x": (region(variables=["y"], place=["y", 0, 0]), "malformed", ""),
    "roll in the place of yaw": (
        region(variables=["roll"], place=[3, 0, 0], turns=[[1, 0], [1, 0], ["roll"]], box=[[0, 1]]),
        "malformed",
        "",
    ),
    "yaw in the place of roll": (
        region(variables=["yaw"], place=[3, 0, 0], turns=[["yaw"], [1, 0], [1, 0]], box=[[0, 1]]),
        "malformed",
        "",
    ),
    "the first variable without a place": (
        region(variables=["x", "y"], place=[0, "y", 0], box=[[3, 4]] * 2),
        "malformed",
        "",
    ),
    "a turn of no list": _with("malformed", 5, CHART, "turns", 0, turns=UNTURNED),
    "a turn of an empty list": _with("malformed", [], CHART, "turns", 0, turns=UNTURNED),
    "a turn of three": _with("malformed", ["1", "0", "0"], CHART, "turns", 0, turns=UNTURNED),
    "a pose of two numbers": (region(points=[[3, 4]]), "malformed", ""),
    "letters of another alphabet": _with("malformed", "j", "paving"),
    "a list of letters": _with("malformed", ["i"], "paving"),
    "a true version": _with("malformed", True, "version"),
    "version 0": _with("malformed", 0, "version"),
    "version 2": _with("malformed", 2, "version"),
    "a claim of its own": _with("malformed", "most", "claim"),
    "a motion of its own": _with("malformed", "cylindrical", ROBOT, "motion"),
    "a leg of its own": _with("malformed", {"type": "rope"}, ROBOT, "legs", 0, "actuator"),
    "a leg of no type": _with("malformed", [], ROBOT, "legs", 0, "actuator"),
    "a name of no text": _with("malformed", 5, ROBOT, "name"),
    "a unit of no text": _with("malformed", 5, ROBOT, "unit"),
    "a source of no text": _with("malformed", 5, ROBOT, "source"),
    "a leg's name of no text": _with("malformed", 5, ROBOT, "legs", 0, "name"),
    "measure out of order": (word("sisuo", measure=["3/2", "1"]), "malformed", ""),
}

ROWS: dict[str, Row] = merged(
    *map(dict, (random_rows(), determinant_rows(), singular_rows(), shape_rows(), form_rows())),
    CASES,
    ROOTS,
    ANGLED,
    WORDS,
    GROUPS,
    FORMAT,
)

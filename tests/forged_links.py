"""Links certificates made by hand, honest ones and forgeries, with what both checkers must say of them."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from handmade_links import (
    Content,
    Joined,
    O,
    X,
    Y,
    Z,
    angle,
    at_point,
    box,
    carries,
    distance,
    in_metric,
    in_plane,
    linear,
    on_cylinder,
    on_line,
    system,
    unknowns_in_metric,
)
from tables_of_rows import merged, put

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and how its last line begins."""

ONE, NOTHING = "not proven complete: one pose", "not proven complete: no solution"
UNPROVED = "box: that it holds exactly one pose is not proved"
SHEARED = "system: its polynomials are not those"


# Poses of one body: unknowns that are integers, and constraints that hold there

TURNED = (0, 0, 1, 1, 0, 0, 0, 1, 0)
"""R by rows: x becomes y, y becomes z, z becomes x."""
OVER = (0, -1, 0, 0, 0, -1, 1, 0, 0)
POSES: dict[str, tuple[str, list[Joined], list[int]]] = {
    "a point in the plane": ("planar:translation", [(0, 1, at_point((3, -2, 5), (1, 1, 5)))], [2, -3]),
    "a point on two rods": (
        "planar:translation",
        [(0, 1, distance(O, (1, 0, 0), 25)), (0, 1, distance((6, 0, 0), (0, 0, 0), 32))],
        [2, 4],
    ),
    "a point on a line": (
        "planar:translation",
        [(0, 1, on_line((1, 2, 0), (3, 4, 0))), (0, 1, in_plane(X, 7))],
        [7, 10],
    ),
    "a turned body": (
        "planar",
        [(0, 1, at_point((1, 2, 0), (3, 4, 0))), (0, 1, in_plane((1, 2, 0), 3))],
        [5, -1, 0, 1],
    ),
    "a body turned back": (
        "planar:planar",
        [(0, 1, at_point((1, 2, 0), (3, 4, 0))), (0, 1, carries((1, 2, 0), 11))],
        [-3, 5, 0, -1],
    ),
    "an upright body": (
        "schoenflies",
        [(0, 1, at_point((1, 2, 5), (3, 4, 7))), (0, 1, distance((9, 9, 9), (1, 1, 1), 152))],
        [4, 6, -2, -1, 0],
    ),
    "a body that does not turn": (
        "translation",
        [
            (0, 1, on_cylinder((1, 0, 0), (0, 3, 4), (2, 1, 0), 13)),
            (0, 1, distance(O, O, 6)),
            (0, 1, in_plane((1, 1, 1), 2)),
        ],
        [1, 2, -1],
    ),
    "a body at a point": (
        "spherical",
        [(0, 1, angle(X, (0, 2, 0), 0)), (0, 1, angle((1, 2, 0), X, 2)), (0, 1, angle(Y, Y, 0))],
        [*TURNED],
    ),
    "a body as it was": (
        "spherical",
        [(0, 1, angle(X, Y)), (0, 1, angle(X, Z)), (0, 1, angle(Y, Z))],
        [1, 0, 0, 0, 1, 0, 0, 0, 1],
    ),
    "a body on six rods": (
        "spatial",
        [
            (0, 1, distance(a, b, sum((p - x) ** 2 for p, x in zip((1 + b[2], 2 + b[0], 3 + b[1]), a, strict=True))))
            for a, b in (
                ((0, 0, 0), (1, 0, 0)),
                ((9, 0, 1), (0, 2, 0)),
                ((0, 7, 0), (0, 0, 3)),
                ((1, 1, 8), (-1, 0, 1)),
                ((-5, 2, 0), (2, -3, 0)),
                ((4, -4, 2), (0, 1, -2)),
            )
        ],
        [1, 2, 3, *TURNED],
    ),
    "a body on a line, with three numbers": (
        "spatial",
        [
            (0, 1, on_line((1, 2, 3), (2, -5, 1))),
            (0, 1, linear(1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, -16)),
            (0, 1, angle(X, X, 0)),
            (0, 1, angle(Y, (0, 3, 1), -1)),
            (0, 1, angle(Z, Z, 0)),
        ],
        [1, 2, 3, *OVER],
    ),
}
# Two bodies, joined with each other in every way that there is

PAIRS: dict[str, tuple[str, list[Joined], list[int]]] = {
    "two bodies in the plane": (
        "planar:planar planar",
        [
            (0, 1, at_point((2, 1, 0), (-1, 3, 0))),
            (0, 1, in_plane((1, 1, 0), 7, (2, 2, 0))),
            (1, 2, at_point((5, 1, 0), (-1, -1, 0))),
            (1, 2, angle(X, (2, 1, 0), -1)),
        ],
        [5, 2, 0, 1, 3, 6, -1, 0],
    ),
    "an upright body on one that turns back": (
        "schoenflies planar",
        [
            (0, 2, at_point((2, 1, 4), (2, 0, 4))),
            (0, 2, carries(X, 3, O)),
            (2, 1, distance((1, 2, 3), (3, 0, 1), 26)),
            (2, 1, on_line((-5, -2, -2), (1, 2, 2), (0, 0, 1))),
            (1, 2, in_plane((0, 1, 2), 2, (1, 2, 0))),
        ],
        [4, 6, 1, -1, 0, 2, 3, 0, -1],
    ),
    "a slide on a body that turns": (
        "planar translation",
        [
            (0, 1, at_point(O)),
            (0, 1, angle(X, (3, 4, 0), -4)),
            (1, 2, carries((2, 0, 1), -11, (0, 3, 0))),
            (1, 2, on_cylinder((0, 1, 2), (1, 2, 2), (1, 1, 0), "74/9")),
            (2, 1, linear(1, 0, 0, 1, 1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 1, -9)),
        ],
        [0, 0, 0, 1, 1, -2, 3],
    ),
}


def _rows() -> dict[str, Row]:
    """Of each pose its box, boxes beside it, and the polynomials, of which something is changed."""
    found: dict[str, Row] = {}
    for name, (motions, joined, centre) in (POSES | PAIRS).items():
        found[f"{name}, a box"] = (box(motions, joined, centre), "accepted", ONE)
        for place in sorted({0, len(centre) - 1}):
            beside = [x + (Fraction(1, 1 << 30) if k == place else 0) for k, x in enumerate(centre)]
            found[f"{name}, a box beside {place}"] = (box(motions, joined, beside), "rejected", UNPROVED)
        honest = system(motions, joined)
        found[f"{name}, a system"] = (honest, "accepted", NOTHING)
        polynomials = honest["system"]["polynomials"]
        for what, others in (("less", polynomials[:-1]), ("turned round", polynomials[::-1])):
            found[f"{name}, a system {what}"] = (put(honest, others, "system", "polynomials"), "rejected", SHEARED)
    return found


# Some of them in metrics, where R^T G R = G; with squares there is a body for each of those above

STRETCHED = (
    *("an upright body", "a body that does not turn", "a body at a point"),
    *("a body on a line, with three numbers", "a point on two rods"),
)
ROOTS = (2, 1, 4)
SQUARES = (4, 1, 16)
SLANTED: tuple[str, list[Joined], list[Any]] = (
    "planar:planar",
    [(0, 1, at_point((1, 2, 0), (3, 1, 0))), (0, 1, in_plane((1, 2, 0), 11, (2, 2, 0)))],
    [1, 0, "1/2", "1/2"],
)
"""Turned by 60 degrees, C + R (3, 1) = (1, 2) with R = ((1/2, -3/2), (1/2, 1/2)) in the metric (1, 3, 1)."""


def _in_metrics() -> dict[str, Row]:
    """Boxes and systems of version 2; with another metric, they are those of another mechanism."""
    found: dict[str, Row] = {}
    single = {name: POSES[name] for name in POSES if name in STRETCHED}
    for name, (motions, plain, numbers) in (single | PAIRS).items():
        joined, centre = in_metric(ROOTS, plain), unknowns_in_metric(ROOTS, motions, numbers)
        found[f"{name}, a box in a metric"] = (box(motions, joined, centre, metric=SQUARES), "accepted", ONE)
        beside = [*centre[:-1], centre[-1] + Fraction(1, 1 << 30)]
        found[f"{name}, a box beside in a metric"] = (
            box(motions, joined, beside, metric=SQUARES),
            "rejected",
            UNPROVED,
        )
        honest = system(motions, joined, SQUARES)
        found[f"{name}, a system in a metric"] = (honest, "accepted", NOTHING)
        others = system(motions, joined)["system"]["polynomials"]
        if others != honest["system"]["polynomials"]:
            forged = put(honest, others, "system", "polynomials")
            found[f"{name}, a system of another metric"] = (forged, "rejected", SHEARED)
    motions, joined, centre = SLANTED
    found["a turn by 60 degrees"] = (box(motions, joined, centre, metric=(1, 3, 1)), "accepted", ONE)
    for g in ((3, 1, 1), (1, 4, 1)):
        found[f"a turn that is none in {g}"] = (box(motions, joined, centre, metric=g), "rejected", UNPROVED)
    some = box(motions, joined, centre, metric=(1, 3, 1))
    halves = (("1/2, 3, 1", ["1/2", "3", "1"]), ("1, 3, 1/2", ["1", "3", "1/2"]), ("1/2", ["1", "1/2", "1"]))
    for what, value in (("two", ["1", "3"]), ("0", ["1", "0", "1"]), *halves, ("none", None)):
        found[f"a metric of {what}"] = (put(some, value, "mechanism", "metric"), "malformed", "")
    found["a metric in version 1"] = (put(some, 1, "version"), "malformed", "")
    found["no metric in version 2"] = (put(SOME_PIN, 2, "version"), "malformed", "")
    return found


# x^2 + y^2 = 1 and y = 0, so that the image of a box about (1, 0) is known

CIRCLE: list[Joined] = [(0, 1, distance(O, O, 1)), (0, 1, in_plane(Y, 0))]
TRAILING: list[Joined] = [
    *((0, 1, at_point(O)), (0, 2, in_plane(X, 1)), (0, 2, in_plane(Y, 1))),
    (1, 2, on_cylinder(O, X, O, 1)),
]
"""Of degree 4: derivatives are not in the middle between their bounds."""
PIN: list[Joined] = [(0, 1, at_point((3, -2, 0)))]
FLAT = "planar:translation"
SOME_PIN = box(FLAT, PIN, [3, -2])


def _reach(status: str, joined: list[Joined], centre: Any, radius: int, exponent: int) -> Row:
    return box(FLAT, joined, centre, radius, exponent), status, ONE if status == "accepted" else UNPROVED


REACH: dict[str, Row] = {
    "half of the circle's radius": _reach("rejected", CIRCLE, [1, 0], 16, 5),
    "less than half of it": _reach("accepted", CIRCLE, [1, 0], 15, 5),
    **{
        f"beside the circle by one unit, {radius}": _reach(status, CIRCLE, ["33/32", 0], radius, 5)
        for radius, status in ((1, "rejected"), (2, "accepted"), (15, "accepted"), (16, "rejected"))
    },
    **{
        f"a pin {step} units aside": _reach(status, PIN, [3 + step, -2], 5, 0)
        for step, status in ((-6, "rejected"), (-5, "rejected"), (-4, "accepted"), (4, "accepted"), (5, "rejected"))
    },
    **{
        f"a pin {step} units away": _reach(status, PIN, [3, -2 + step], 5, 0)
        for step, status in ((-6, "rejected"), (-5, "rejected"), (-4, "accepted"), (4, "accepted"), (5, "rejected"))
    },
    **{
        f"two rods and a wide box, {name}, {radius}": _reach(status, rods, centre, radius, 10)
        for name, rods, centre in (
            ("above", POSES["a point on two rods"][1], [2, 4]),
            ("below", POSES["a point on two rods"][1], [2, -4]),
            ("exchanged", POSES["a point on two rods"][1][::-1], [2, 4]),
        )
        for radius, status in ((1740, "accepted"), (1800, "rejected"))
    },
    **{
        f"a slide at a turning body, {radius}": (
            box("planar:planar translation", TRAILING, [0, 0, 1, 0, 1, 1], radius, 14),
            status,
            ONE if status == "accepted" else UNPROVED,
        )
        for radius, status in ((460, "accepted"), (468, "rejected"))
    },
    "a body that is not held": (
        box("planar:translation translation", PIN, [3, -2, 0, 0]),
        "rejected",
        "box: 2 polynomials in 4 unknowns",
    ),
    "no unknown in any polynomial": _reach(
        "rejected", [(0, 1, angle(X, X, "1/2")), (0, 1, angle(X, Y, "1/2"))], [1, 1], 1, 5
    ),
    "the same polynomial twice": _reach("rejected", [CIRCLE[0]] * 2, [1, 0], 1, 40),
    "a pole of the circle": _reach("rejected", CIRCLE, [0, 0], 1, 40),
}

# Mirrored bodies: the third axis turned round, which no constraint of these sees

MIRRORED: dict[str, Row] = {
    "a body at a point, mirrored": (
        box("spherical", [(0, 1, angle(X, X)), (0, 1, angle(X, Z)), (0, 1, angle(Y, Z))], [0, 1, 0, 1, 0, 0, 0, 0, 1]),
        "rejected",
        "box: that body 1 is turned and not mirrored is not proved",
    ),
    "a second body mirrored": (
        box(
            "planar spherical",
            [
                (0, 1, at_point(O)),
                (0, 1, angle(X, X)),
                *((1, 2, angle(x, y)) for x, y in ((X, Y), (X, Z), (Y, Z))),
            ],
            [0, 0, 0, 1, *(0, -1, 0, 1, 0, 0, 0, 0, -1)],
        ),
        "rejected",
        "box: that body 2 is turned and not mirrored is not proved",
    ),
    "a second body turned": (
        box(
            "planar spherical",
            [
                (0, 1, at_point(O)),
                (0, 1, angle(X, X)),
                *((1, 2, angle(x, y)) for x, y in ((X, Y), (X, Z), (Y, Z))),
            ],
            [0, 0, 0, 1, *(0, -1, 0, 1, 0, 0, 0, 0, 1)],
        ),
        "accepted",
        ONE,
    ),
}

# The format

SOME = SOME_PIN
GIVEN = system(FLAT, PIN)
IDLE: Joined = (0, 1, linear(*[0] * 17))


PINS: list[Joined] = [(0, k, at_point((k, -k, 0))) for k in range(1, 33)]


def _with(status: str, value: Any, *path: Any, content: Content = SOME) -> Row:
    return put(content, value, *path), status, ONE if status == "accepted" else ""


ENTRY: tuple[Any, ...] = ("mechanism", "joined", 0)
FORMAT: dict[str, Row] = {
    "32 bodies": (
        box(f"planar:{'translation ' * 32}", PINS, [x for k in range(1, 33) for x in (k, -k)]),
        "accepted",
        ONE,
    ),
    "33 bodies": _with("malformed", [{"name": "a body", "motion": "translation"}] * 33, "mechanism", "bodies"),
    "64 constraints": (box(FLAT, [*PIN, *[IDLE] * 63], [3, -2]), "accepted", ONE),
    "65 constraints": (box(FLAT, [*PIN, *[IDLE] * 64], [3, -2]), "malformed", "mechanism.joined"),
    "65 unknowns": (box("translation " * 20 + "schoenflies", PIN, [0] * 65), "too-large", "mechanism: more than 64"),
    "a box of radius 1": _with("accepted", 1, "box", "radius"),
    "a box of the largest radius": (box(FLAT, PIN, [3, -2], 10**9, 40), "accepted", ONE),
    "the finest grid": (box(FLAT, PIN, [3, -2], 1, 8192), "accepted", ONE),
    "a finer grid": (box(FLAT, PIN, [3, -2], 1, 8193), "too-large", "box.exponent"),
    "a centre of three": _with("malformed", ["0x0"] * 3, "box", "centre"),
    "a radius of true": _with("malformed", True, "box", "radius"),
    "a platform of 0": _with("malformed", 0, "mechanism", "platform"),
    "a platform of 2": _with("malformed", 2, "mechanism", "platform"),
    "a version of true": _with("malformed", True, "version"),
    "version 0": _with("malformed", 0, "version"),
    "version 2": _with("malformed", 2, "version"),
    "a unit that is none": _with("malformed", None, "mechanism", "unit"),
    "a source that is none": _with("malformed", None, "mechanism", "source"),
    "a body's name that is none": _with("malformed", None, "mechanism", "bodies", 0, "name"),
    "a motion that is none": _with("malformed", "helical", "mechanism", "bodies", 0, "motion"),
    "a joint of the ground": _with("malformed", [0, 0], *ENTRY, "bodies"),
    "a joint of one body": _with("malformed", [1], *ENTRY, "bodies"),
    "a joint of no number": _with("malformed", [0, True], *ENTRY, "bodies"),
    "a joint of less than the ground": _with("malformed", [-1, 1], *ENTRY, "bodies"),
    "planar in words": _with("malformed", "yes", "mechanism", "planar"),
    "a box and a system": ({**SOME, "system": GIVEN["system"]}, "malformed", "method"),
    "neither box nor system": _with("malformed", None, "box"),
    "a system for a box": ({**SOME, "box": None, "system": GIVEN["system"]}, "malformed", "method"),
    "a box for a system": ({**GIVEN, "system": None, "box": SOME["box"]}, "malformed", "method"),
    "a box beside a system": ({**GIVEN, "box": SOME["box"]}, "malformed", "method"),
    **{f"bodies of {value!r}": _with("malformed", value, "mechanism", "bodies") for value in (5, None, "x", {})},
    **{f"constraints of {value!r}": _with("malformed", value, "mechanism", "joined") for value in (5, None, "x", {})},
    "a system of version true": _with("malformed", True, "system", "version", content=GIVEN),
    "a system of version 0": _with("malformed", 0, "system", "version", content=GIVEN),
    "a system of version 2": _with("malformed", 2, "system", "version", content=GIVEN),
    "a system of another format": _with("malformed", "pkm_exact certificate", "system", "format", content=GIVEN),
    **{
        f"a system of the format {name}": _with("malformed", name, "system", "format", content=GIVEN)
        for name in ("pkm_exact system certificate 2", "pkm_exact system", "", None)
    },
    "other unknowns": _with("rejected", ["x1", "y2"], "system", "variables", content=GIVEN),
}
FORMAT["other unknowns"][0]["system"]["polynomials"] = [["x1", "-3"], ["y2", "2"]]

ROWS: dict[str, Row] = merged(_rows(), _in_metrics(), REACH, MIRRORED, FORMAT)

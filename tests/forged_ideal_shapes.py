"""Mobility certificates of version 3 of mechanisms in space and in fractions, and with curves that hardly fail."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from forged_ideal import (
    BEGINS,
    IS_U,
    ISOLATED,
    LOCAL,
    MOVES,
    OPENED,
    PARTS,
    REGULARITY,
    STILL,
    TOGETHER,
    curve,
    ideal,
    third,
)
from forged_mobility import Row
from forged_second_order import ARM, FIVE_POINTS, OPEN, SLIDES, SQUARE, hinges, ring
from forged_second_order import ROWS as SECOND
from handmade_mobility import Content, O, X, Y, Z, certificate, joint
from tables_of_rows import merged, put

THIRDS = [[2, -1, 2], [2, 2, -1], [-1, 2, 2]]
"""Three times a rotation."""


def turned(joints: Sequence[Content]) -> list[Content]:
    """The same joints, turned in space."""

    def moved(vector: Sequence[str]) -> list[str]:
        return [str(sum(Fraction(x) * int(t) for x, t in zip(vector, row, strict=True)) / 3) for row in THIRDS]

    return [
        entry | {"point": moved(entry["point"]), "axes": [moved(axis) for axis in entry["axes"]]} for entry in joints
    ]


def moved_on(joints: Sequence[Content], number: int) -> list[Content]:
    """The same loop from another joint on."""
    points, axes = ([entry[key] for entry in joints] for key in ("point", "axes"))
    points, axes = (values[number:] + values[:number] for values in (points, axes))
    return ring(points, [axis for (axis,) in axes])


FIVE_AXES = [(1, 0, 1), (1, 1, 0), (1, 0, 1), (1, 0, 0), (1, -1, 0)]
OBLIQUE = [
    joint(f"j{k}", "R", one, other, (x, x + 1, 0), [Z])
    for k, (x, one, other) in enumerate(((1, "base", "top"), (2, "top", "side"), (5, "side", "base")))
]
HONEST_2 = next(content for content, status, _ in SECOND.values() if status == "accepted")
LOOPS: dict[str, tuple[list[Content], list[list[int]], int, bool]] = {
    "five hinges": (ring(FIVE_POINTS, FIVE_AXES), [[1]], 3, True),
    "five hinges in the second order": (ring(FIVE_POINTS, FIVE_AXES), [[1]], 2, False),
    "Bennett's linkage": (ring(SQUARE, [(-2, 0, -2), (0, 2, -2), (2, 0, -2), (0, -2, -2)]), [[1]], 6, False),
    "a stretched triangle": (hinges(0, 1, 3), [[1]], 2, True),
    "a stretched triangle on another line": (OBLIQUE, [[1]], 2, True),
    "Bennett's linkage to the twelfth order": (
        ring(SQUARE, [(-2, 0, -2), (0, 2, -2), (2, 0, -2), (0, -2, -2)]),
        [[1]],
        12,
        False,
    ),
    "a flat parallelogram": (hinges(0, 1, 4, 3), [[1, 0], [0, 1]], 4, False),
    "a flat parallelogram, a section": (hinges(0, 1, 4, 3), [[1, 2]], 2, True),
    "four in a line": (hinges(0, 1, 3, 6), [[1, 0], [0, 1]], 4, False),
    "two rods": (hinges(0, 1, 3, axes=(Y, Z)), [[1, 0], [0, 1]], 2, False),
}


def _isolated(name: str, joints: list[Content], section: Any, degree: int, good: bool) -> dict[str, Row]:
    content = certificate(joints, [], [])
    most = len(content["loops"]["null_space"]) - len(section)
    entry = ideal((0, most), (0, most), ("local", section, degree))
    return {name: (third(content, entry), "accepted" if good else "rejected", "finite" if good else ISOLATED)}


SPACE: dict[str, Row] = merged(
    *(_isolated(f"{name}, turned", turned(joints), *rest) for name, (joints, *rest) in LOOPS.items()),
    _isolated("a stretched triangle on a line beside the origin", OBLIQUE, [[1]], 2, True),
    *(
        _isolated(f"{name}, turned, from joint {k}", turned(moved_on(joints, k)), *rest)
        for name, (joints, *rest) in LOOPS.items()
        if all(len(entry["axes"]) == 1 for entry in joints)
        for k in range(1, len(joints))
    ),
)

# Curves


def _along(
    joints: Sequence[Content] | Content, *curves: Content, low: int = 1, most: int = 1, above: Any = ("rank", [], 0)
) -> Content:
    content = joints if isinstance(joints, dict) else certificate(joints, [], [])
    below = ("curves", [], [], [], curves)
    return third(content, ideal((len(curves), most), (low, min(most, 6)), above, below))


def _loop(*kinds: tuple[str, Any, str]) -> list[Content]:
    """A loop of joints at the origin: types, axes and pitches; the body behind the first two is the top."""
    bodies = ["base", *(["top"] if len(kinds) == 2 else ["b", "top"]), *(f"c{k}" for k in range(3, len(kinds))), "base"]
    return [
        joint(f"k{k}", kind, bodies[k], bodies[k + 1], O, [axis], pitch=pitch)
        for k, (kind, axis, pitch) in enumerate(kinds)
    ]


TURNS, SCREW = ("R", Z, "0"), ("H", X, "1")
ABOUT, AGAIN = [[[0], [1]], [1]], [[[0], [-1]], [1]]
"""u and -u."""
BACKWARDS = [[[0, -1]], [1]]
SAME = [[0, -1], [1]]
"""u = s."""
AROUND = [*_loop(TURNS, TURNS, TURNS)]
HELD = [joint(f"h{k}", "R", *("base", "side")[:: 1 - 2 * k], O, [X]) for k in range(2)]
HELICAL = [joint(f"w{k}", "H", *("base", "side")[:: 1 - 2 * k], O, [X], pitch="1") for k in range(2)]
PITCH = "finite: a screw of a loop has a pitch"
CURVES: dict[str, Row] = {
    "two curves in one loop": (
        _along(AROUND, curve(SAME, ABOUT, AGAIN, STILL), curve(SAME, STILL, ABOUT, AGAIN), most=2),
        "rejected",
        TOGETHER,
    ),
    "two curves of different joints in one loop": (
        _along(
            _loop(TURNS, TURNS, TURNS, TURNS),
            curve(SAME, ABOUT, STILL, AGAIN, STILL),
            curve(SAME, STILL, ABOUT, STILL, AGAIN),
            most=3,
        ),
        "rejected",
        TOGETHER,
    ),
    "two slides, the last of them on both curves": (
        _along(SLIDES, curve(IS_U, STILL, MOVES), curve(IS_U, MOVES, MOVES), low=2, most=2),
        "rejected",
        TOGETHER,
    ),
    "one hinge of two moves": (
        _along(_loop(("R", X, "0"), ("R", X, "0")), curve(IS_U, MOVES, STILL)),
        "rejected",
        OPENED,
    ),
    "one slide of two moves": (
        _along(_loop(("P", Z, "0"), ("P", Z, "0")), curve(IS_U, MOVES, STILL)),
        "rejected",
        OPENED,
    ),
    "two hinges move": (
        _along(_loop(("R", X, "0"), ("R", X, "0")), curve(IS_U, MOVES, BACKWARDS)),
        "accepted",
        "finite",
    ),
    "two slides move": (
        _along(_loop(("P", Z, "0"), ("P", Z, "0")), curve(IS_U, MOVES, BACKWARDS)),
        "accepted",
        "finite",
    ),
    "two hinges and a screw first": (
        _along(_loop(SCREW, TURNS, TURNS), curve(IS_U, STILL, MOVES, BACKWARDS)),
        "rejected",
        PITCH,
    ),
    "two hinges and a screw last": (
        _along(_loop(TURNS, TURNS, SCREW), curve(IS_U, MOVES, BACKWARDS, STILL), low=0),
        "rejected",
        PITCH,
    ),
    "two hinges and a hinge first": (
        _along(_loop(("R", X, "0"), TURNS, TURNS), curve(IS_U, STILL, MOVES, BACKWARDS)),
        "accepted",
        "finite",
    ),
    "screws in the first loop": (
        _along([*HELICAL, *_loop(TURNS, TURNS)], curve(IS_U, STILL, STILL, MOVES, BACKWARDS), most=2),
        "rejected",
        PITCH,
    ),
    "screws in the last loop": (
        _along([*_loop(TURNS, TURNS), *HELICAL], curve(IS_U, MOVES, BACKWARDS, STILL, STILL), most=2),
        "rejected",
        PITCH,
    ),
    "hinges in the first loop": (
        _along([*HELD, *_loop(TURNS, TURNS)], curve(IS_U, STILL, STILL, MOVES, BACKWARDS), most=2),
        "accepted",
        "finite",
    ),
    "a relation whose first coefficient is missing": (
        _along(OPEN, curve([[0], [1, 5]], [[[0, 1], ["1/5"]], [1]])),
        "accepted",
        "finite",
    ),
    "a relation with a square": (_along(OPEN, curve([[0, 0, 1], [1]], [[[0, 1], [1]], [1]])), "accepted", "finite"),
    "a relation that ends with 0": (_along(OPEN, curve([[0], [1], [0, 1]], MOVES)), "accepted", "finite"),
    "a relation that is not 0": (_along(OPEN, curve([[1], [1]], MOVES)), "rejected", REGULARITY),
    "one of two begins elsewhere": (_along(SLIDES, curve(IS_U, [[[1, 1]], [1]], MOVES), most=2), "rejected", BEGINS),
    "twelve coefficients": (
        _along(
            OPEN, curve([[0, *[1] * 11], [1, *[0] * 11], *[[1]] * 10], [[[0, 1, *[0] * 10], *[[0]] * 11], [1] * 12])
        ),
        "accepted",
        "finite",
    ),
}

# Screws and the local ring, and words


def _screwed(place: int) -> Row:
    joints = hinges(0, 1, 3)
    bodies = ["base", "top", "b2", "b3"]
    kept = [("R", entry["point"], [Z], "0") for entry in joints]
    kept.insert(place, ("H", O, [X], "1"))
    found = [
        joint(f"j{k}", kind, bodies[k], [*bodies, "base"][k + 1], point, axes, pitch=pitch)
        for k, (kind, point, axes, pitch) in enumerate(kept)
    ]
    return third(certificate(found, [], []), ideal((0, 0), (0, 0), ("local", [[1]], 2))), "rejected", PITCH


OTHERS: dict[str, Row] = {
    **{f"a stretched triangle with a screw at {k}": _screwed(k) for k in (0, 1, 3)},
    "an order without parts": (
        _along(OPEN, curve(IS_U, MOVES), above=("order", [], 0)),
        "malformed",
        "finite.above.argument",
    ),
    "the rank with a section, along a curve": (
        _along(OPEN, curve(IS_U, MOVES), above=("rank", [[1]], 0)),
        "malformed",
        PARTS,
    ),
    "the rank in a degree, along a curve": (
        _along(OPEN, curve(IS_U, MOVES), above=("rank", [], 2)),
        "malformed",
        PARTS,
    ),
    "a curve of version 2 beside an arm": (
        third(ARM, ideal((1, 1), (1, 1), ("local", [[1, 5]], 2), ("curve",))),
        "malformed",
        "finite.below.argument",
    ),
    "a word of its own beside an arm": (
        third(ARM, ideal((1, 1), (1, 1), ("local", [[1, 5]], 2), ("other",))),
        "malformed",
        "finite.below.argument",
    ),
    "version 4 with the entries of version 2": (put(HONEST_2, 4, "version"), "malformed", "format: not a"),
    "a curve of version 2 without parts": (
        third(certificate(ring(FIVE_POINTS, FIVE_AXES), [], []), ideal((0, 0), (0, 0), LOCAL, ("curve",))),
        "malformed",
        "finite.below.argument",
    ),
}
ROWS = {f"ideal, {name}": row for name, row in merged(SPACE, CURVES, OTHERS).items()}

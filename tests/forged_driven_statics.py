"""Statics certificates of version 3 made by hand: legs that slides and cranks drive, and forgeries of them."""

from __future__ import annotations

from copy import deepcopy
from fractions import Fraction

from forged_statics import FLAT, SMALL, TURNED, Content, Row
from handmade_statics import driven, machine, polytopes
from tables_of_rows import merged, put

PAIRS = [["-1", "2"], ["-3", "1"], ["-1", "1"], ["-2", "5"]]
SLIDES = driven(
    machine(FLAT, [(1, 0, 0), (0, 2, 0), (1, 1, 0)], forces=PAIRS[:3]), [(1, 7, 9), (0, Fraction(-1, 3), 0), (1, 0, 0)]
)
"""p = 1, -2/3 and 1: where lengths are 1, 2 and a root of 2."""
MIXED = driven(machine(FLAT, [(1, 1, 0), (1, -1, 0), (0, 3, 0)], forces=PAIRS[:3]), [None, (-2, 0, 0), None])
LINE = driven(machine([0], [(3, 4, 0), (-5, 12, 0)], speeds=["1", "2/7"], forces=PAIRS[:2]), [(-1, 1, 0), (2, 1, 1)])
TIED = driven(
    machine([0, 1, 2], [(3, -4, 8), (3, 4, 8), (-3, 4, 8), (-3, -4, 8)], forces=PAIRS),
    [(0, 0, s) for s in (1, -1, 1, 1)],
)
"""Four sides at every corner above and below: an octahedron, as that of DUAL V."""
METRIC = driven(TURNED, [(1, 2, 0), (0, -1, 1), (1, 0, 0)])
MACHINES = {"slides": SLIDES, "mixed": MIXED, "a line": LINE, "an octahedron": TIED, "in a metric": METRIC}
HONEST: dict[str, Content] = {name: polytopes(content) for name, content in MACHINES.items()}


def _directed(content: Content, place: int, direction: list[str] | None) -> Content:
    return put(content, direction, "legs", place, "direction")


def _reversed(content: Content, place: int) -> Content:
    """A direction turned round: twists stay, wrenches do not where least and greatest forces differ."""
    return _directed(content, place, [str(-Fraction(x)) for x in content["legs"][place]["direction"]])


def _longer(content: Content, place: int, axis: int) -> Content:
    line = list(content["legs"][place]["direction"])
    return _directed(content, place, [str(Fraction(x) + SMALL * (k == axis)) for k, x in enumerate(line)])


def _alone(content: Content, part: str) -> Content:
    """With one of the polytopes only."""
    return content | {name: None for name in ("velocity_polytope", "wrench_polytope") if name != part}


def _unit_indices(content: Content, low: Fraction, high: Fraction) -> Content:
    pair = [str(low), str(high)]
    return content | {"indices": {"sigma_min": pair, "sigma_max": pair, "condition": ["1/2", "2"]}}


def _disc(content: Content, size: Fraction) -> Content:
    matrix = [[str(size), "0"], ["0", str(size)]]
    return content | {"ellipsoid": {"weights": ["1/2", "1/2"], "matrix": matrix}}


TWISTS, WRENCHES = "velocity_polytope: ", "wrench_polytope: "
SQUARE = driven(machine(FLAT, [(2, 0, 0), (0, 3, 0)]), [(5, 0, 0), (0, -5, 0)])
"""p = 10 and -15: both rows have length 1/5."""
EDGE, NEAR = Fraction(1, 5), Fraction(1, 10**15)
WITHOUT, AMONG = deepcopy(SLIDES), deepcopy(machine(FLAT, [(1, 0, 0), (0, 2, 0)]))
del WITHOUT["legs"][1]["direction"]
AMONG["legs"][0]["direction"] = None
DRIVEN: dict[str, Row] = merged(
    {f"driven: honest, {name}": (content, "accepted", "wrench polytope") for name, content in HONEST.items()},
    {
        f"driven: an octahedron, direction {k + 1} longer": (
            _alone(_longer(HONEST["an octahedron"], k, 2), "velocity_polytope"), "rejected", TWISTS
        )
        for k in range(4)
    },
    {
        f"driven: {name}, direction of {place + 1} turned round": (
            _alone(_reversed(HONEST[name], place), "wrench_polytope"), "rejected", WRENCHES
        )
        for name, place in (("slides", 0), ("slides", 1), ("a line", 0), ("a line", 1), ("an octahedron", 1))
    },
    {
        "driven: a direction turned round, twists": (
            _alone(_reversed(HONEST["slides"], 1), "velocity_polytope"), "accepted", "velocity polytope"
        ),
        "driven: a longer direction, other lengths": (_longer(HONEST["slides"], 1, 1), "accepted", "wrench"),
        "driven: a direction along what does not count": (_longer(HONEST["slides"], 0, 2), "accepted", "wrench"),
        "driven: a length instead": (_directed(HONEST["slides"], 2, None), "rejected", TWISTS),
        "driven: a direction instead of a length": (_directed(HONEST["mixed"], 2, ["0", "2", "0"]), "rejected", TWISTS),
        "driven: an octahedron without a vertex": (
            put(HONEST["an octahedron"], HONEST["an octahedron"]["velocity_polytope"]["vertices"][1:],
                "velocity_polytope", "vertices"), "rejected", TWISTS + "not all vertices"
        ),
        "driven: a disc": (_disc(SQUARE, Fraction(25)), "accepted", "ellipsoid"),
        "driven: a disc too wide": (_disc(SQUARE, 25 + SMALL), "rejected", "ellipsoid: leaves"),
        "driven: singular values": (_unit_indices(SQUARE, EDGE - NEAR, EDGE + NEAR), "accepted", "indices"),
        "driven: singular values above": (
            _unit_indices(SQUARE, EDGE - 2 * NEAR, EDGE - NEAR), "rejected", "indices: sigma_min is above"
        ),
        "driven: an actuator that does not move": (
            _directed(SLIDES, 1, ["1", "0", "-1"]), "rejected", "legs[2]: its actuator does not move it"
        ),
        "driven: a leg without length": (
            driven(machine(FLAT, [(1, 0, 0), (0, 0, 0)]), [None, (1, 1, 0)]), "rejected", "legs[2]: has length 0"
        ),
        "driven: a leg without direction": (WITHOUT, "malformed", "legs[2]: not an object with the keys base"),
        "driven: a direction in version 1": (AMONG, "malformed", "legs[1]: not an object with the keys base"),
        "driven: a direction of two": (_directed(SLIDES, 0, ["1", "0"]), "malformed", "legs[1].direction"),
        "driven: a direction of numbers": (
            put(SLIDES, [1, 0, 0], "legs", 0, "direction"), "malformed", "legs[1].direction"
        ),
        "driven: version 5": (put(SLIDES, 5, "version"), "malformed", "format: not a"),
    },
)  # fmt: skip

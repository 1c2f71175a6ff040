"""Mobility certificates made by hand, honest ones and forgeries, with what both checkers must say of them."""

from __future__ import annotations

from copy import deepcopy
from fractions import Fraction
from typing import Any

from handmade_mobility import REGULAR, Content, O, X, Y, Z, certificate, joint, subgroups
from tables_of_rows import merged, put

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and how its last line begins."""


def legs(*chains: list[tuple[str, Any, Any]]) -> list[Content]:
    """Chains of joints (type, point, axes) from base to top, named a1, a2, ..; b1, ..; "-" turns a joint round."""
    found = []
    for letter, chain in zip("abcdef", chains, strict=False):
        bodies = ["base", *(f"{letter}{k}-{k + 1}" for k in range(1, len(chain))), "top"]
        for k, (kind, point, axes) in enumerate(chain):
            ends = (bodies[k], bodies[k + 1]) if kind[-1] != "-" else (bodies[k + 1], bodies[k])
            found.append(joint(f"{letter}{k + 1}", kind.strip("-"), *ends, point, axes))
    return found


FAR, OFF = (1, 2, 3), (2, -1, 1)
PX, PY, PZ = ("P", O, [X]), ("P", O, [Y]), ("P", O, [Z])
HINGES = [("R", O, [Z]), ("R", (3, 0, 0), [Z]), ("R", (3, 4, 0), [Z])]
OTHER_HINGES = [("R", (7, 0, 0), [Z]), ("R", (8, 3, 0), [Z]), ("R", (5, 5, 0), [Z])]
ASIDE = [("R", (0, 0, 7), [X]), ("R", (0, 3, 8), [X]), ("R", (0, 5, 5), [X])]
BALL, OTHER_BALL = ("S", O, []), ("S", FAR, [])
CYLINDER = ("C", FAR, [(1, 2, 2)])
HELIX = joint("a1", "H", "base", "top", FAR, [OFF], pitch="2/3")
SIX = [[int(i == j) for j in range(6)] for i in range(6)]

FINITE = "finite: mobility"
NOTHING = "finite: nothing"
MADE: dict[str, tuple[Content, str]] = {
    "a hinge": (certificate(legs([HINGES[1]]), ["a1"]), NOTHING),
    "a slide": (certificate(legs([PX])), NOTHING),
    "three slides": (certificate(legs([PX, PY, PZ]), ["a2"]), NOTHING),
    "a screw": (certificate([HELIX]), NOTHING),
    "a screw against a hinge": (certificate([HELIX, joint("b1", "R", "top", "base", FAR, [OFF])]), NOTHING),
    "six screws": (certificate([joint("a", "screw", "base", "top", screws=SIX)]), NOTHING),
    "two slides abreast": (certificate(legs([PX], [PX]), ["b1"]), NOTHING),
    "two slides apart": (certificate(legs([PX], [PY])), NOTHING),
    "a slide on a body aside": (certificate([*legs([PX]), joint("b", "P", "base", "aside", O, [Y])]), NOTHING),
    "a body aside that moves alone": (
        certificate([*legs([PX, PY]), joint("b", "S", "a1-2", "aside")], ["a1", "b.2"]),
        NOTHING,
    ),
    "hinges": (certificate(legs(HINGES, OTHER_HINGES), ["a1", "b1"], ["a1", "a3", "b2", "b3"]), NOTHING),
    "hinges, regular": (certificate(legs(HINGES, OTHER_HINGES), [], [], REGULAR), FINITE),
    "hinges, two loops": (
        certificate(legs(HINGES, OTHER_HINGES, [PX, PY, HINGES[0]]), [], ["a1", "c1", "c2"], REGULAR),
        FINITE,
    ),
    "hinges, legs": (
        certificate(legs(HINGES, OTHER_HINGES), [], [], subgroups(("a1 a2 a3", 0), ("b1 b2 b3", 0))),
        FINITE,
    ),
    "hinges in two planes": (
        certificate(legs(HINGES, ASIDE), [], ["a1", "b1"], subgroups(("a1 a2 a3", 0), ("b1 b2 b3", 0))),
        FINITE,
    ),
    "a leg, regular": (certificate(legs([PX, PY]), [], [], REGULAR), FINITE),
    "slides abreast, legs": (certificate(legs([PX], [PX]), [], None, subgroups(("a1", 0), ("b1", 0))), FINITE),
    "slides apart, legs": (certificate(legs([PX], [PY]), [], None, subgroups(("a1", 0), ("b1", 0))), FINITE),
    "slides apart, legs in another order": (
        certificate(legs([PY], [PX]), [], None, subgroups(("b1", 0), ("a1", 0))),
        FINITE,
    ),
    "three planes": (
        certificate(
            legs([PX, PY], [PY, PZ], [("P", O, [(0, 2, 0)]), ("P", O, [OFF])]),
            [],
            ["a1", "a2"],
            subgroups(("a1 a2", 0), ("b1 b2", 0), ("c1 c2", 0)),
        ),
        FINITE,
    ),
    "balls": (certificate(legs([BALL], [OTHER_BALL]), [], ["a1.1", "b1.3"], subgroups(("a1", 0), ("b1", 0))), FINITE),
    "balls and a cylinder": (
        certificate(
            legs([BALL], [OTHER_BALL], [("C", O, [FAR])]), [], ["a1.1"], subgroups(("a1", 0), ("b1", 0), ("c1", 0))
        ),
        FINITE,
    ),
    "a cut leg with the group before": (
        certificate(legs([PX], [PX, ("R", FAR, [Y])]), [], None, subgroups(("a1", 0), ("b1 b2", 1))),
        FINITE,
    ),
    "a cut leg with the group behind": (
        certificate(legs([PX], [("R", FAR, [Y]), PX]), [], None, subgroups(("a1", 0), ("b1 b2", 1))),
        FINITE,
    ),
    "cut legs alike": (
        certificate(
            legs([PX, ("R", FAR, [Y])], [("P", O, [(2, 0, 0)]), ("R", (1, 5, 3), [Y])]),
            [],
            None,
            subgroups(("a1 a2", 1), ("b1 b2", 1)),
        ),
        FINITE,
    ),
    "a cut leg alone": (certificate(legs([PX, ("R", FAR, [Y])]), [], None, subgroups(("a1 a2", 1))), FINITE),
    "cut legs across": (
        certificate(
            legs([BALL, ("P", O, [X]), ("R", OFF, [Y])], [("S", OFF, []), ("P", O, [Z]), ("R", FAR, [X])]),
            [],
            ["a1.1"],
            subgroups(("a1 a2 a3", 3), ("b1 b2 b3", 3)),
        ),
        FINITE,
    ),
    "balls and a cut leg with their group": (
        certificate(
            legs([BALL], [OTHER_BALL], [("R", O, [FAR]), PX]),
            [],
            ["a1.1"],
            subgroups(("a1", 0), ("b1", 0), ("c1 c2", 1)),
        ),
        FINITE,
    ),
    "a ball, a hinge of it and a cut leg with it": (
        certificate(
            legs([BALL], [("R", O, [FAR])], [("R", O, [FAR]), PX]),
            [],
            ["b1"],
            subgroups(("a1", 0), ("b1", 0), ("c1 c2", 1)),
        ),
        FINITE,
    ),
    "cut legs alike, of two dimensions": (
        certificate(
            legs([PX, PY, ("R", FAR, [Y])], [("P", O, [(1, 1, 0)]), ("P", O, [(1, -1, 0)]), ("R", (1, 5, 3), [Y])]),
            [],
            ["a1"],
            subgroups(("a1 a2 a3", 2), ("b1 b2 b3", 2)),
        ),
        FINITE,
    ),
    "slides abreast, passed backwards": (
        certificate(legs([("P-", O, [X])], [PX]), [], None, subgroups(("a1", 0), ("b1", 0))),
        FINITE,
    ),
    "a freedom that does nothing between two": (
        certificate(
            [
                joint("a", "P", "base", "x", O, [X]),
                joint("b", "P", "base", "aside", O, [Z]),
                joint("c", "P", "x", "top", O, [Y]),
            ]
        ),
        NOTHING,
    ),
    "hinges abreast": (certificate(legs([("R", O, [X])], [("R", O, [X])])), NOTHING),
    "a universal joint": (certificate(legs([("U", FAR, [Z, X]), PX]), [], [], subgroups(("a1 a2", 1))), FINITE),
    "a universal joint passed backwards": (
        certificate(legs([("U-", FAR, [X, Z]), PX]), [], [], subgroups(("a1 a2", 1))),
        FINITE,
    ),
    "joints passed backwards": (
        certificate(
            legs([("C-", FAR, [OFF]), ("R-", OFF, [X])], [("R", O, [FAR]), ("U-", OFF, [Y, FAR])]),
            ["a1.2"],
            ["a1.1", "b1", "b2.2"],
        ),
        NOTHING,
    ),
    "a ring": (
        certificate(
            legs([("U", FAR, [X, OFF]), CYLINDER, HINGES[1]], [BALL, ("P", O, [FAR])]), ["a2.1"], ["a1.1", "a3", "b2"]
        ),
        NOTHING,
    ),
    "a loop of the platform's path": (
        certificate(
            [
                joint("a", "R", "base", "x", FAR, [X]),
                joint("b", "P", "top", "x", O, [OFF]),
                joint("c", "C", "base", "top", OFF, [Y]),
                joint("d", "S", "y", "top", FAR),
                joint("e", "S", "x", "y", OFF),
            ],
            ["c.1"],
            ["a", "b"],
        ),
        NOTHING,
    ),
}


def _finite(name: str, argument: Any) -> Content:
    return MADE[name][0] | {"finite": argument}


BEHIND, FILL, CROSS = "finite.legs: a cut behind", "finite: a leg does not fill", "finite: the legs are not transversal"
LEGS: dict[str, Row] = {
    "slides abreast are no regular loop": (_finite("two slides apart", REGULAR), "accepted", FINITE),
    "balls are no regular loop": (_finite("balls", REGULAR), "rejected", "finite: the loops are not regular"),
    "a leg of one joint, cut": (_finite("slides abreast, legs", subgroups(("a1", 1), ("b1", 0))), "malformed", BEHIND),
    "a leg of two joints, cut behind": (_finite("a cut leg alone", subgroups(("a1 a2", 2))), "malformed", BEHIND),
    "a leg that is no group": (_finite("a cut leg alone", subgroups(("a1 a2", 0))), "rejected", FILL),
    "a universal joint cut elsewhere": (_finite("a universal joint", subgroups(("a1 a2", 2))), "rejected", FILL),
    "a universal joint not cut": (_finite("a universal joint", subgroups(("a1 a2", 0))), "rejected", FILL),
    "a universal joint written the other way": (
        certificate(legs([("U", FAR, [X, Z]), PX]), [], [], subgroups(("a1 a2", 1))),
        "rejected",
        FILL,
    ),
    "a universal joint passed backwards, written the other way": (
        certificate(legs([("U-", FAR, [Z, X]), PX]), [], [], subgroups(("a1 a2", 1))),
        "rejected",
        FILL,
    ),
    "legs of the same sum": (
        certificate(
            legs([PX, ("R", FAR, [Y])], [("R", FAR, [Y]), PX]), [], None, subgroups(("a1 a2", 1), ("b1 b2", 1))
        ),
        "rejected",
        CROSS,
    ),
    "balls and slides, cut otherwise": (
        certificate(
            legs([BALL, PX, PY], [PX, PY, BALL]), ["a2"], ["a1.1"], subgroups(("a1 a2 a3", 3), ("b1 b2 b3", 2))
        ),
        "rejected",
        CROSS,
    ),
    "a cut leg without the group": (
        certificate(legs([PX], [PY, ("R", FAR, [Y])]), [], None, subgroups(("a1", 0), ("b1 b2", 1))),
        "rejected",
        CROSS,
    ),
    "balls and a cut leg with their line in its sum": (
        certificate(
            legs([BALL], [OTHER_BALL], [PX, PY, PZ, ("R", O, [X]), ("R", O, [(0, 2, 3)])]),
            [],
            [],
            subgroups(("a1", 0), ("b1", 0), ("c1 c2 c3 c4 c5", 4)),
        ),
        "rejected",
        CROSS,
    ),
    "a line in a cut leg that has it in neither part": (
        certificate(
            legs([PX, PY], [PX, PZ], [BALL, ("C", (0, 0, 1), [Y])]),
            [],
            [],
            subgroups(("a1 a2", 0), ("b1 b2", 0), ("c1 c2", 3)),
        ),
        "rejected",
        CROSS,
    ),
    "a chain of leaps": (
        certificate(
            [
                joint("a", "P", "m", "base", O, [X]),
                joint("b", "P", "n", "m", O, [Y]),
                joint("c", "P", "top", "n", O, [Z]),
            ],
            finite=subgroups(("b a c", 0)),
        ),
        "rejected",
        "finite: the joints of a leg are no chain",
    ),
    "a leg that ends at a later body": (
        certificate(
            [
                *(joint("a", "P", "top", "z", O, [X]), joint("b", "P", "base", "z", O, [X])),
                *(joint("c", "P", "base", "y", O, [X]), joint("d", "P", "y", "z", O, [X])),
            ],
            finite=subgroups(("b a", 0), ("c d", 0)),
        ),
        "rejected",
        "finite: a leg does not end",
    ),
    "a joint twice": (
        _finite("slides abreast, legs", subgroups(("a1", 0), ("a1", 0))),
        "rejected",
        "finite: not every joint",
    ),
    "another joint twice": (
        _finite("slides abreast, legs", subgroups(("b1", 0), ("b1", 0))),
        "rejected",
        "finite: not every joint",
    ),
    "a joint in no leg": (_finite("slides abreast, legs", subgroups(("a1", 0))), "rejected", "finite: not every joint"),
    "a joint too often": (
        _finite("slides abreast, legs", subgroups(("a1", 0), ("b1", 0), ("b1", 0))),
        "rejected",
        "finite: not every joint",
    ),
    "a joint in no leg, aside": (
        _finite("a slide on a body aside", subgroups(("a1", 0))),
        "rejected",
        "finite: not every joint",
    ),
    "a leg that goes on": (
        _finite("a slide on a body aside", subgroups(("a1", 0), ("b", 0))),
        "rejected",
        "finite: a leg does not end",
    ),
    "a leg that ends before": (
        _finite("three slides", subgroups(("a1 a2", 0))),
        "rejected",
        "finite: a leg does not end",
    ),
    "a leg of nothing": (
        _finite("slides abreast, legs", subgroups(("", 0), ("a1", 0), ("b1", 0))),
        "rejected",
        "finite: a leg does not end",
    ),
    "no chain": (
        _finite("three slides", subgroups(("a1 a3", 0))),
        "rejected",
        "finite: the joints of a leg are no chain",
    ),
    "no chain from the base": (
        _finite("three slides", subgroups(("a2 a3", 0))),
        "rejected",
        "finite: the joints of a leg are no chain",
    ),
    "there and back": (_finite("slides abreast, legs", subgroups(("a1 b1 a1", 0))), "rejected", "finite"),
    "through the top": (
        certificate(
            [
                joint("a", "P", "base", "top", O, [X]),
                joint("b", "P", "top", "x", O, [X]),
                joint("c", "P", "x", "top", O, [X]),
            ],
            finite=subgroups(("a b c", 0)),
        ),
        "rejected",
        "finite: not every body",
    ),
    "through the base": (
        certificate(
            [
                joint("a", "P", "base", "x", O, [X]),
                joint("b", "P", "x", "base", O, [X]),
                joint("c", "P", "base", "top", O, [X]),
            ],
            finite=subgroups(("a b c", 0)),
        ),
        "rejected",
        "finite: not every body",
    ),
    "a body twice": (
        certificate(
            [
                joint("a", "P", "base", "x", O, [X]),
                joint("b", "P", "x", "top", O, [X]),
                joint("c", "P", "base", "x", O, [X]),
                joint("d", "P", "x", "top", O, [X]),
            ],
            finite=subgroups(("a b", 0), ("c d", 0)),
        ),
        "rejected",
        "finite: not every body",
    ),
}

# Proofs of ranks

HING = MADE["hinges"][0]
BODY, LOOPS = MADE["a body aside that moves alone"][0], ("loops", "null_space")
SPACE, INSIDE, SHAPE = "loops.null_space: not in", "loops: a place outside", "loops.null_space: not a vector"
OWN = "loops.null_space: not 1 at its own"


def _vectors(content: Content, key: str = "loops") -> list[list[str]]:
    return deepcopy(content[key]["null_space"])


def _proofs() -> dict[str, Row]:
    found: dict[str, Row] = {}
    vectors = _vectors(HING)
    size = len(vectors[0])
    free = [k for k in range(size) if k not in HING["loops"]["columns"]]
    for k in (0, len(vectors) - 1):
        for wrong, name in ((vectors[k][:-1], "short"), ([*vectors[k], "0"], "long"), ([], "of nothing")):
            found[f"vector {k} {name}"] = (put(HING, wrong, *LOOPS, k), "malformed", SHAPE)
        for place in range(size):
            for step, word in (("1/7", "more"), ("-1/7", "less")):
                value = step if vectors[k][place] == "0" else f"{vectors[k][place]}1"
                value = (
                    value if step == "1/7" else "-" + value.removeprefix("-") if vectors[k][place] == "0" else "-1001"
                )
                line = OWN if place in free else SPACE
                found[f"vector {k}, number {place}, {word}"] = (put(HING, value, *LOOPS, k, place), "rejected", line)
    numbers = [[Fraction(x) for x in vector] for vector in vectors]
    for k, other in ((0, 1), (0, -1), (-1, 0), (-1, -2)):
        for name, one, more in (("more", 1, 1), ("less", 1, -1), ("half", Fraction(1, 2), 0), ("twice", 2, 0)):
            mixed = [str(one * x + more * y) for x, y in zip(numbers[k], numbers[other], strict=True)]
            found[f"vector {k}, {name} {other}"] = (put(HING, mixed, *LOOPS, k % len(vectors)), "rejected", OWN)
    found["a vector less"] = (put(HING, vectors[:-1], *LOOPS), "malformed", SHAPE)
    found["a vector more"] = (put(HING, [*vectors, vectors[0]], *LOOPS), "malformed", SHAPE)
    found["vectors in another order"] = (put(HING, vectors[::-1], *LOOPS), "rejected", OWN)
    rows, columns = HING["loops"]["rows"], HING["loops"]["columns"]
    for key, places, most in (("rows", rows, 6), ("columns", columns, size)):
        found[f"the last of {key} outside"] = (put(HING, [*places[:-1], most], "loops", key), "malformed", INSIDE)
        found[f"all {key} outside"] = (
            put(HING, [most + k for k in range(len(places))], "loops", key),
            "malformed",
            INSIDE,
        )
        found[f"{key} that fall"] = (
            put(HING, places[::-1], "loops", key),
            "malformed",
            f"loops.{key}: not in increasing",
        )
        twice = [places[0], *places[:-1]]
        found[f"one of {key} twice"] = (put(HING, twice, "loops", key), "malformed", f"loops.{key}: not in increasing")
        found[f"one of {key} less"] = (put(HING, places[:-1], "loops", key), "malformed", f"loops.{key}: not a list")
        found[f"one of {key} below 0"] = (put(HING, [-1, *places[1:]], "loops", key), "malformed", f"loops.{key}")
        found[f"the last of {key} swapped"] = (
            put(HING, [*places[:-2], places[-1], places[-2]], "loops", key),
            "malformed",
            f"loops.{key}: not in increasing",
        )
        found[f"the first of {key} swapped"] = (
            put(HING, [places[1], places[0], *places[2:]], "loops", key),
            "malformed",
            f"loops.{key}: not in increasing",
        )
        found[f"no list of {key}"] = (put(HING, 5, "loops", key), "malformed", f"loops.{key}")
    found["a rank of one less"] = (put(HING, HING["loops"]["rank"] - 1, "loops", "rank"), "malformed", "loops.rows")
    more = {
        "rank": len(rows) + 1,
        "rows": sorted([*rows, *[k for k in range(6) if k not in rows][:1]]),
        "columns": [*columns, size],
    }
    found["a column more, outside"] = (put(HING, {**more, "null_space": vectors}, "loops"), "malformed", INSIDE)
    none = {"rank": 1, "rows": [0], "columns": [0], "null_space": []}
    found["a column where there is none"] = (
        put(MADE["two slides apart"][0], none, "platform"),
        "malformed",
        "platform: a place outside",
    )
    abreast = legs([("R", O, [X])], [("R", O, [X])])
    found["the first equation unseen"] = (certificate(abreast, unseen=[0]), "rejected", SPACE)
    found["the last equation unseen"] = (certificate(legs([PZ], [PZ]), unseen=[5]), "rejected", SPACE)
    found["a minor of 0"] = (put(HING, [0, 1, 2], "loops", "rows"), "rejected", "loops: the minor is 0")
    alone = MADE["a leg, regular"][0]
    found["a row where there is none"] = (
        put(alone, {"rank": 1, "rows": [0], "columns": [0], "null_space": [["0", "1"]]}, "loops"),
        "malformed",
        INSIDE,
    )
    lost = {"rank": 0, "rows": [], "columns": [], "null_space": [["1", "0"], ["0", "1"]]}
    still = MADE["two slides apart"][0]
    found["a null space of all"] = (put(still, lost, "loops"), "rejected", SPACE)
    for key in BODY["mobility"]:
        for step in (1, -1):
            wrong = put(BODY, BODY["mobility"][key] + step, "mobility", key)
            found[f"{key} {step}"] = (wrong, "rejected", f"mobility.{key}: not the number")
    return found


# Sets of actuators

SETS = "actuator_sets"
ABREAST = MADE["two slides abreast"][0]
FEW = certificate(legs([PX, PY], [PX, PY]))
"""One of a1 and b1, and one of a2 and b2."""


def _sets(content: Content, key: str, sets: Any, *, complete: bool = True) -> Content:
    return put(content, {"complete": complete, "sets": sets}, SETS, key)


ALL = [["a1", "a2"], ["a1", "b2"], ["a2", "b1"], ["b1", "b2"]]
HOLDS, MINIMAL, NOT_ALL = "a set that does not hold it", "a set that is not minimal", "not all minimal sets"
CHOSEN: dict[str, Row] = {
    "all sets": (_sets(_sets(FEW, "platform", ALL), "mechanism", ALL), "accepted", NOTHING),
    "none of them": (_sets(FEW, "platform", []), "rejected", f"{SETS}.platform: {NOT_ALL}"),
    "none of them, not all": (_sets(FEW, "platform", [], complete=False), "accepted", NOTHING),
    "none of the mechanism's": (_sets(FEW, "mechanism", []), "rejected", f"{SETS}.mechanism: {NOT_ALL}"),
    "none of the mechanism's, not all": (_sets(FEW, "mechanism", [], complete=False), "accepted", NOTHING),
    **{
        f"all but {k}": (_sets(FEW, "platform", ALL[:k] + ALL[k + 1 :]), "rejected", f"{SETS}.platform: {NOT_ALL}")
        for k in range(4)
    },
    "the last, not all": (_sets(FEW, "platform", ALL[3:], complete=False), "accepted", NOTHING),
    "a set too small": (_sets(FEW, "platform", [["a1"], *ALL]), "rejected", f"{SETS}.platform: {HOLDS}"),
    "a set too small, not all": (
        _sets(FEW, "platform", [["b2"]], complete=False),
        "rejected",
        f"{SETS}.platform: {HOLDS}",
    ),
    "the last does not hold": (
        _sets(FEW, "platform", [["a1", "a2"], ["a2", "b2"]], complete=False),
        "rejected",
        f"{SETS}.platform: {HOLDS}",
    ),
    "the first does not hold": (
        _sets(FEW, "platform", [["a1", "b1"], ["b1", "b2"]], complete=False),
        "rejected",
        f"{SETS}.platform: {HOLDS}",
    ),
    "the last too large": (
        _sets(FEW, "platform", [["a1", "a2"], ["a1", "a2", "b1"]], complete=False),
        "rejected",
        f"{SETS}.platform: {MINIMAL}",
    ),
    "the first too large": (
        _sets(FEW, "mechanism", [["a1", "a2", "b1"], ["a1", "b1", "b2"]], complete=False),
        "rejected",
        f"{SETS}.mechanism: {MINIMAL}",
    ),
    "all four": (_sets(FEW, "platform", [["a1", "a2", "b1", "b2"]]), "rejected", f"{SETS}.platform: {MINIMAL}"),
    "one that does nothing": (
        _sets(certificate(legs([PX], [PX, PY])), "platform", [["a1", "b2"]], complete=False),
        "rejected",
        f"{SETS}.platform: {MINIMAL}",
    ),
    "one that does nothing, first": (
        _sets(certificate(legs([PX, PY], [PX])), "platform", [["a2", "b1"]], complete=False),
        "rejected",
        f"{SETS}.platform: {MINIMAL}",
    ),
    "one that does nothing, alone": (
        _sets(certificate(legs([PX, PY], [PX])), "platform", [["a2"]], complete=False),
        "rejected",
        f"{SETS}.platform: {HOLDS}",
    ),
    **{
        f"a freedom of set {k} alone not looked at": (
            put(
                _sets(_sets(FEW, "mechanism", [], complete=False), "platform", [ALL[0], ALL[3]], complete=False),
                among,
                SETS,
                "among",
            ),
            "malformed",
            f"{SETS}.platform.sets: a freedom",
        )
        for k, among in ((0, ["a2", "b1", "b2"]), (1, ["a1", "a2", "b1"]))
    },
    "no list of sets": (_sets(FEW, "platform", 5), "malformed", f"{SETS}.platform.sets"),
    "nothing to hold": (_sets(MADE["two slides apart"][0], "platform", [[]]), "accepted", NOTHING),
    "nothing to hold, held": (
        _sets(MADE["two slides apart"][0], "platform", [["a1"]]),
        "rejected",
        f"{SETS}.platform: {MINIMAL}",
    ),
    "nothing to hold, no set": (
        _sets(MADE["two slides apart"][0], "platform", []),
        "rejected",
        f"{SETS}.platform: {NOT_ALL}",
    ),
    "something to hold, by nothing": (_sets(FEW, "platform", [[], *ALL]), "rejected", f"{SETS}.platform: {HOLDS}"),
    "a platform that stands": (
        certificate([joint("a", "P", "base", "aside", O, [Y]), *legs([PX], [PY])], ["a"]),
        "accepted",
        NOTHING,
    ),
    "sets in another order": (
        _sets(FEW, "platform", ALL[::-1]),
        "malformed",
        f"{SETS}.platform.sets: not in their order",
    ),
    "sets in another order of size": (
        _sets(FEW, "platform", [["a1", "a2"], ["b1"]]),
        "malformed",
        f"{SETS}.platform.sets: not in their order",
    ),
    "a set twice": (_sets(FEW, "platform", [ALL[0]] * 2), "malformed", f"{SETS}.platform.sets: not in their order"),
    "a set in another order": (
        _sets(FEW, "platform", [["b1", "a1"]]),
        "malformed",
        f"{SETS}.platform.sets[1]: not in the order",
    ),
    "a set of one twice": (
        _sets(FEW, "platform", [["a1", "a1"]]),
        "malformed",
        f"{SETS}.platform.sets[1]: not in the order",
    ),
    "freedoms not looked at": (
        put(FEW, ["a1", "a2", "b1"], SETS, "among"),
        "malformed",
        f"{SETS}.platform.sets: a freedom",
    ),
    "freedoms not looked at, first": (
        put(FEW, ["a2", "b1", "b2"], SETS, "among"),
        "malformed",
        f"{SETS}.platform.sets: a freedom",
    ),
    "a freedom that is none": (put(FEW, ["a1", "a4"], SETS, "among"), "malformed", f"{SETS}.among"),
    "freedoms in another order": (
        put(FEW, ["b1", "a1"], SETS, "among"),
        "malformed",
        f"{SETS}.among: not in the order",
    ),
    "actuated in another order": (put(FEW, ["b1", "a1"], "actuated"), "malformed", "actuated: not in the order"),
    "actuated twice": (put(FEW, ["a1", "a1"], "actuated"), "malformed", "actuated: not in the order"),
    "65536 sets": (_sets(FEW, "platform", [0] * 65536), "malformed", f"{SETS}.platform.sets[1]"),
    "65537 sets": (_sets(FEW, "platform", [0] * 65537), "too-large", f"{SETS}.platform.sets: more than"),
    "sets in words": (_sets(FEW, "platform", "sets"), "malformed", f"{SETS}.platform.sets"),
    **{
        f"completeness {x}": (put(FEW, x, SETS, "platform", "complete"), "malformed", f"{SETS}.platform.complete")
        for x in (1, 0, None, "true")
    },
}

# The format

MACHINE = "mechanism"
JOINTS = (MACHINE, "joints")
HINGE, SLIDE = MADE["a hinge"][0], MADE["a slide"][0]
RINGS = [joint(f"j{k}", "S", f"b{k}", f"b{k + 1}") for k in range(42)]


def _long(last: str, bodies: int) -> Content:
    """A chain of 126 freedoms and one more joint, without proofs of it."""
    joints = [*RINGS, joint("more", last, "b42", "top", O, [X, Y] if last == "U" else [])]
    names = [*(f"b{k}" for k in range(43)), "top", *(f"aside {k}" for k in range(bodies - 44))]
    joints += [joint(f"aside {k}", "R", "b0", f"aside {k}", O, [X]) for k in range(bodies - 44)]
    content = put(HINGE, {**HINGE[MACHINE], "base": "b0", "bodies": names, "joints": joints}, MACHINE)
    return content | {
        "actuated": [],
        SETS: {"among": [], **{key: {"complete": False, "sets": []} for key in ("platform", MACHINE)}},
    }


def _star(bodies: int) -> Content:
    """A body with so many others around it."""
    joints = [joint(f"j{k}", "R", "b0", f"b{k}", O, [X]) for k in range(1, bodies)]
    content = put(
        HINGE,
        {
            **HINGE[MACHINE],
            "base": "b0",
            "platform": "b1",
            "bodies": [f"b{k}" for k in range(bodies)],
            "joints": joints,
        },
        MACHINE,
    )
    return content | {
        "actuated": [],
        SETS: {"among": [], **{key: {"complete": False, "sets": []} for key in ("platform", MACHINE)}},
    }


def _with(status: str, value: Any, *path: Any, content: Content = HINGE) -> Row:
    return put(content, value, *path), status, ""


def _joint(status: str, **entries: Any) -> Row:
    return put(HINGE, {**HINGE[MACHINE]["joints"][0], **entries}, *JOINTS, 0), status, ""


ZERO3 = ["0"] * 3
FORMAT: dict[str, Row] = {
    "128 freedoms": (_long("U", 44), "malformed", "loops.null_space"),
    "129 freedoms": (_long("S", 44), "too-large", "mechanism.joints"),
    "64 bodies": (_star(64), "malformed", "loops.null_space"),
    "65 bodies": (_star(65), "too-large", "mechanism.bodies"),
    "129 joints": (put(HINGE, [5] * 129, *JOINTS), "too-large", "mechanism.joints"),
    "128 joints": (put(HINGE, [5] * 128, *JOINTS), "malformed", "mechanism.joints[1]"),
    "no joint": (put(HINGE, [], *JOINTS), "malformed", "mechanism.joints"),
    "joints in words": (put(HINGE, "joints", *JOINTS), "malformed", "mechanism.joints"),
    "a body": (put(HINGE, ["base"], MACHINE, "bodies"), "malformed", "mechanism.bodies"),
    "a name of a body twice": (
        put(HINGE, ["base", "top", "top"], MACHINE, "bodies"),
        "malformed",
        "mechanism.bodies: one occurs twice",
    ),
    "a body alone": (
        put(HINGE, ["base", "top", "x"], MACHINE, "bodies"),
        "malformed",
        "mechanism: a body is not connected",
    ),
    "two bodies alone": (
        put(
            put(HINGE, ["base", "top", "x", "y"], MACHINE, "bodies"),
            [*HINGE[MACHINE]["joints"], joint("b", "R", "x", "y", O, [X])],
            *JOINTS,
        ),
        "malformed",
        "mechanism: a body is not connected",
    ),
    "the base alone": (
        put(
            HINGE,
            {**HINGE[MACHINE], "bodies": ["base", "x", "top"], "joints": [joint("b", "R", "x", "top", O, [X])]},
            MACHINE,
        ),
        "malformed",
        "mechanism: a body is not connected",
    ),
    **{
        f"a {key} of no text": (put(HINGE, 5, MACHINE, key), "malformed", f"mechanism.{key}")
        for key in ("name", "unit", "source", "base", "platform")
    },
    "a base that is no body": _with("malformed", "x", MACHINE, "base"),
    "a platform that is no body": _with("malformed", "x", MACHINE, "platform"),
    "a list for a platform": _with("malformed", ["top"], MACHINE, "platform"),
    "the base as platform": _with("malformed", "base", MACHINE, "platform"),
    "the platform as base": _with("malformed", "top", MACHINE, "base"),
    "a joint of no body": _joint("malformed", bodies=["base", "x"]),
    "a joint of one body": _joint("malformed", bodies=["base"]),
    "a joint of three bodies": _joint("malformed", bodies=["base", "top", "top"]),
    "a joint of a body with itself": _joint("malformed", bodies=["top", "top"]),
    "a joint of lists": _joint("malformed", bodies=[["base"], ["top"]]),
    "a joint the other way": _joint("accepted", bodies=["top", "base"]),
    "a joint of another type": _joint("malformed", type="X"),
    "a joint of no text": _joint("malformed", name=5),
    "a hinge with a pitch": _joint("malformed", pitch="1"),
    "a hinge with a negative pitch": _joint("malformed", pitch="-1/2"),
    "a helix without a pitch": _joint("accepted", type="H"),
    "a hinge with two axes": _joint("malformed", axes=[["0", "0", "1"]] * 2),
    "a hinge without an axis": _joint("malformed", axes=[]),
    "a hinge about nothing": _joint("malformed", axes=[ZERO3]),
    "a universal joint of nothing, first": _joint("malformed", type="U", axes=[ZERO3, ["0", "0", "1"]]),
    "a universal joint of nothing, last": _joint("malformed", type="U", axes=[["0", "0", "1"], ZERO3]),
    "a universal joint of one axis": _joint("malformed", type="U"),
    "a ball with an axis": _joint("malformed", type="S"),
    "a hinge with a screw": _joint("malformed", screws=[["1"] * 6]),
    "a point of two": _joint("malformed", point=["0", "0"]),
    **{
        f"a slide with a point {k}": (put(SLIDE, "1", *JOINTS, 0, "point", k), "malformed", "mechanism.joints[1].point")
        for k in range(3)
    },
    "a slide with a negative point": (
        put(SLIDE, "-1", *JOINTS, 0, "point", 0),
        "malformed",
        "mechanism.joints[1].point",
    ),
    "a slide with a pitch": (put(SLIDE, "1", *JOINTS, 0, "pitch"), "malformed", "mechanism.joints[1].pitch"),
    "seven screws that move": (
        certificate([joint("a", "screw", "base", "top", screws=[*SIX, [1] * 6])]),
        "malformed",
        "",
    ),
    "a screw of nothing that moves, first": (
        certificate([joint("a", "screw", "base", "top", screws=[[0] * 6, [1] * 6])]),
        "malformed",
        "",
    ),
    "a screw of nothing that moves, last": (
        certificate([joint("a", "screw", "base", "top", screws=[[1] * 6, [0] * 6])]),
        "malformed",
        "",
    ),
    "no screw": (certificate([*legs([PX]), joint("b", "screw", "top", "aside")]), "malformed", ""),
    "a body apart": (
        certificate([*legs([PX]), joint("b", "R", "y", "z", O, [X])]),
        "malformed",
        "mechanism: a body is not connected",
    ),
    "a body apart, first": (
        certificate([*legs([PX]), joint("b", "R", "aa", "ab", O, [X])], bodies=["aa", "ab", "base", "top"]),
        "malformed",
        "mechanism: a body is not connected",
    ),
    "a body without a joint, first": (
        certificate(legs([PX]), bodies=["x", "base", "top"]),
        "malformed",
        "mechanism: a body is not connected",
    ),
    "axes of no list": _joint("malformed", axes=5),
    "screws of no list": _joint("malformed", screws=5),
    "screws of none": _joint("malformed", type="screw", point=ZERO3, axes=[], screws=[]),
    "a screw": (certificate([joint("a", "screw", "base", "top", screws=[[1, 2, 3, 4, 5, 6]])]), "accepted", NOTHING),
    "seven screws": _joint("malformed", type="screw", point=ZERO3, axes=[], screws=[["1"] * 6] * 7),
    "a screw of nothing, first": _joint("malformed", type="screw", point=ZERO3, axes=[], screws=[["0"] * 6, ["1"] * 6]),
    "a screw of nothing, last": _joint("malformed", type="screw", point=ZERO3, axes=[], screws=[["1"] * 6, ["0"] * 6]),
    "a screw of five": _joint("malformed", type="screw", point=ZERO3, axes=[], screws=[["1"] * 5]),
    "a screw of seven": _joint("malformed", type="screw", point=ZERO3, axes=[], screws=[["1"] * 7]),
    "a screw with an axis": _joint("malformed", type="screw", point=ZERO3, screws=[["1"] * 6]),
    "a screw at a point": _joint("malformed", type="screw", point=["0", "1", "0"], axes=[], screws=[["1"] * 6]),
    "screws in words": _joint("malformed", screws="none"),
    "axes in words": _joint("malformed", axes="z"),
    "two joints of one name": (
        put(ABREAST, "a1", *JOINTS, 1, "name"),
        "malformed",
        "mechanism.joints: one occurs twice",
    ),
    "two balls of one name": (
        put(put(MADE["balls"][0], "a1", *JOINTS, 1, "name"), [], SETS, "among"),
        "malformed",
        "mechanism.joints: one occurs twice",
    ),
    "a hinge that is called as a freedom of a ball": (
        certificate([joint("a", "S", "base", "top"), joint("a.1", "R", "base", "top", FAR, [X])], [], []),
        "malformed",
        "mechanism.joints: one occurs",
    ),
    "a slide that is called as a universal joint": (
        put(certificate(legs([("U", FAR, [Z, X]), PX]), [], []), "a1", *JOINTS, 1, "name"),
        "malformed",
        "mechanism.joints: one occurs twice",
    ),
    "a rank below 0": _with("malformed", -1, "loops", "rank"),
    "a true rank": _with("malformed", True, "loops", "rank"),
    "a rank of one more": _with("malformed", 1, "loops", "rank"),
    "a rank of a fraction": _with("malformed", 0.0, "loops", "rank"),
    "vectors in words": _with("malformed", "none", "loops", "null_space"),
    "a vector in words": _with("malformed", "1", "loops", "null_space", 0),
    "a true count": _with("malformed", True, "mobility", "free"),
    "a count in words": _with("malformed", "1", "mobility", "free"),
    "version 0": _with("malformed", 0, "version"),
    "version 2": _with("malformed", 2, "version"),
    "a true version": _with("malformed", True, "version"),
    "an argument of its own": _with("malformed", {"argument": "true", "legs": []}, "finite"),
    "regular with legs": _with("malformed", {"argument": "regular", "legs": [{"joints": ["a1"], "cut": 0}]}, "finite"),
    "subgroups without legs": _with("malformed", {"argument": "subgroups", "legs": []}, "finite"),
    "a leg of no joint": _with("malformed", subgroups(("a2", 0)), "finite"),
    "a leg cut below 0": _with("malformed", subgroups(("a1", -1)), "finite"),
    "a leg cut in words": _with(
        "malformed", {"argument": "subgroups", "legs": [{"joints": ["a1"], "cut": "0"}]}, "finite"
    ),
    "a hinge, by its leg": (HINGE | {"finite": subgroups(("a1", 0))}, "accepted", FINITE),
}

_HONEST = {f"made: {name}": (content, "accepted", line) for name, (content, line) in MADE.items()}
ROWS: dict[str, Row] = merged(_HONEST, LEGS, _proofs(), CHOSEN, FORMAT)

"""Mobility certificates of small mechanisms made by hand: ranks by elimination, sets of actuators by trying all.

Written from ``docs/certificates-mobility.md``; nothing of the program is used.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any

Content = dict[str, Any]
Rows = list[list[Fraction]]
X, Y, Z, O = (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)  # noqa: E741 - the origin


def texts(values: Any) -> Any:
    """Numbers as certificates spell them, in lists."""
    return [texts(value) for value in values] if isinstance(values, list | tuple) else str(Fraction(values))


def joint(name: str, kind: str, one: str, other: str, point: Any = O, axes: Any = (), **others: Any) -> Content:
    """A joint between two bodies."""
    found = {"name": name, "type": kind, "bodies": [one, other], "point": texts(point), "axes": texts(axes)}
    return found | {"pitch": str(others.get("pitch", 0)), "screws": texts(others.get("screws", ()))}


def twists_of(entry: Content) -> Rows:
    """Of its one-freedom joints."""
    p, h = [Fraction(x) for x in entry["point"]], Fraction(entry["pitch"])
    axes = [[Fraction(x) for x in axis] for axis in entry["axes"]]
    if entry["type"] == "screw":
        return [[Fraction(x) for x in screw] for screw in entry["screws"]]
    if entry["type"] == "S":
        axes = [[Fraction(int(i == j)) for j in range(3)] for i in range(3)]
    zero = [Fraction(0)] * 3
    turns = (
        [] if entry["type"] == "P" else [[*a, *(m + h * x for m, x in zip(_cross(p, a), a, strict=True))] for a in axes]
    )
    return turns + ([zero + axes[0]] if entry["type"] in "PC" else [])


def _cross(u: Sequence[Fraction], v: Sequence[Fraction]) -> list[Fraction]:
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def reduced(rows: Rows) -> tuple[Rows, list[int]]:
    """The reduced echelon form, and its pivots."""
    left, pivots = [list(row) for row in rows], []
    for column in range(len(rows[0]) if rows else 0):
        top = len(pivots)
        place = next((r for r in range(top, len(left)) if left[r][column]), None)
        if place is None:
            continue
        left[top], left[place] = left[place], left[top]
        left[top] = [x / left[top][column] for x in left[top]]
        for r in range(len(left)):
            if r != top and left[r][column]:
                left[r] = [x - left[r][column] * y for x, y in zip(left[r], left[top], strict=True)]
        pivots.append(column)
    return left[: len(pivots)], pivots


def rank(rows: Rows) -> int:
    return len(reduced(rows)[1])


def proof(rows: Rows, columns: int) -> tuple[Content, Rows]:
    """The proof of a rank, and the null space."""
    form, pivots = reduced(rows)
    own = [[row[k] for row in rows] for k in pivots]
    vectors = []
    for free in (k for k in range(columns) if k not in pivots):
        x = [Fraction(int(k == free)) for k in range(columns)]
        for row, pivot in zip(form, pivots, strict=True):
            x[pivot] = -row[free]
        vectors.append(x)
    entry = {"rank": len(pivots), "rows": reduced(own)[1], "columns": pivots, "null_space": texts(vectors)}
    return entry, vectors


def path(joints: Sequence[Content], tree: Sequence[int], start: str, end: str) -> list[tuple[int, int]]:
    """The joints of a tree between two bodies, with the directions in which they are passed."""

    def ways(body: str, used: frozenset[int]) -> Iterator[list[tuple[int, int]]]:
        if body == end:
            yield []
        for place in tree:
            one, other = joints[place]["bodies"]
            if place not in used and body in (one, other):
                for rest in ways(other if body == one else one, used | {place}):
                    yield [(place, 1 if body == one else -1), *rest]

    return next(ways(start, frozenset()))


def block(joints: Sequence[Content], way: Sequence[tuple[int, int]]) -> Rows:
    """The six rows of a way."""
    signs = dict(way)
    columns = [[signs.get(k, 0) * x for x in twist] for k, entry in enumerate(joints) for twist in twists_of(entry)]
    return [[column[i] for column in columns] for i in range(6)]


def _applied(rows: Rows, vectors: Rows) -> Rows:
    return [[sum((a * b for a, b in zip(row, x, strict=True)), Fraction(0)) for x in vectors] for row in rows]


def mechanism(joints: Sequence[Content], base: str = "base", platform: str = "top") -> Content:
    bodies = list(dict.fromkeys([base, *(body for entry in joints for body in entry["bodies"])]))
    names = {"name": "made up", "unit": "1", "source": "made up", "base": base, "platform": platform}
    return {**names, "bodies": bodies, "joints": list(joints)}


def certificate(
    joints: Sequence[Content],
    actuated: Sequence[str] = (),
    among: Sequence[str] | None = None,
    finite: Any = None,
    platform: str = "top",
    unseen: Sequence[int] = (),
    bodies: Sequence[str] = (),
) -> Content:
    """What is true of a mechanism, or would be without the equations at some places; ``bodies`` in another order."""
    machine = mechanism(joints, platform=platform)
    machine["bodies"] = list(bodies) or machine["bodies"]
    part, tree, loops = {body: body for body in machine["bodies"]}, [], []
    for place, entry in enumerate(joints):
        one, other = (part[body] for body in entry["bodies"])
        if one == other:
            loops.append([*path(joints, tree, *entry["bodies"][::-1]), (place, 1)])
        else:
            tree.append(place)
            part = {body: one if where == other else where for body, where in part.items()}
    names: list[str] = []
    for entry in joints:
        number = len(twists_of(entry))
        names += [entry["name"]] if number == 1 else [f"{entry['name']}.{k + 1}" for k in range(number)]
    size, matrix = len(names), [row for loop in loops for row in block(joints, loop)]
    matrix = [[Fraction(0)] * size if k in unseen else row for k, row in enumerate(matrix)]
    proofs, motions = {}, {}
    for key, units in (
        ("", []),
        ("locked_", [[Fraction(int(names[k] == name)) for k in range(size)] for name in actuated]),
    ):
        proofs[f"{key}loops"], motions[key] = proof(matrix + units, size)
        twists = _applied(block(joints, path(joints, tree, "base", platform)), motions[key])
        proofs[f"{key}platform"], _ = proof(twists, len(motions[key]))
        motions[f"{key}twists"] = twists
    free, left = len(motions[""]), len(motions["locked_"])
    counts = {
        "free": free,
        "platform": proofs["platform"]["rank"],
        "gruebler_kutzbach": 6 * (len(machine["bodies"]) - 1 - len(joints)) + size,
        "overconstraint": len(matrix) - proofs["loops"]["rank"],
        "locked": left,
        "locked_platform": proofs["locked_platform"]["rank"],
    }
    looked = names if among is None else list(among)
    every = [[Fraction(int(i == j)) for j in range(free)] for i in range(free)]
    sets: Content = {"among": looked}
    for key, wanted in (("platform", motions["twists"]), ("mechanism", every)):
        sets[key] = {"complete": True, "sets": _minimal(looked, names, motions[""], wanted)}
    head = {"format": "pkm_exact mobility certificate", "version": 1, "mechanism": machine, "actuated": list(actuated)}
    ranks = {key: proofs[key] for key in ("loops", "platform", "locked_loops", "locked_platform")}
    return {**head, **ranks, "mobility": counts, "actuator_sets": sets, "finite": finite}


def _minimal(among: Sequence[str], names: Sequence[str], motions: Rows, wanted: Rows) -> list[list[str]]:
    speeds = {name: [x[k] for x in motions] for k, name in enumerate(names)}
    found: list[tuple[str, ...]] = []
    for size in range(len(among) + 1):
        for chosen in combinations(among, size):
            rows = [speeds[name] for name in chosen]
            if not any(set(known) <= set(chosen) for known in found) and rank(rows + wanted) == rank(rows):
                found.append(chosen)
    return [list(chosen) for chosen in found]


def subgroups(*legs: tuple[str, int]) -> Content:
    """The argument, of legs written as names of joints with spaces between them, and cuts."""
    return {"argument": "subgroups", "legs": [{"joints": names.split(), "cut": cut} for names, cut in legs]}


REGULAR = {"argument": "regular", "legs": []}

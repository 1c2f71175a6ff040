"""Certificates of a platform's mobility made by hand, honest ones and forgeries, with what checkers must say of them.

Written from ``docs/certificates-platform.md``; nothing of the program is used but elimination of ``handmade_mobility``.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from handmade_mobility import Content, Rows, proof, texts
from tables_of_rows import merged, put

Row = tuple[Content, str, str]
"""A certificate without its digest, the verdict, and how its last line begins."""

TWISTS = {"spatial": [0, 1, 2, 3, 4, 5], "planar": [0, 1, 5], "schoenflies": [0, 1, 2, 5]}
TWISTS |= {"translation": [0, 1, 2], "spherical": [3, 4, 5]}
LEVEL = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
QUARTER = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
OBLIQUE = [["2/3", "-1/3", "2/3"], ["2/3", "2/3", "-1/3"], ["-1/3", "2/3", "2/3"]]


def _form(square: Any = 0, turned: Any = (0,) * 3, place: Any = (0,) * 3, turn: Any = (0,) * 9, one: Any = 0) -> Any:
    return [Fraction(x) for x in (square, *turned, *place, *turn, one)]


def leg(base: Any, platform: Any, square: Any = 1, metric: Any = (1, 1, 1)) -> Content:
    a, b = [Fraction(x) for x in base], [Fraction(x) for x in platform]
    one = sum(g * (x * x + y * y) for g, x, y in zip(metric, a, b, strict=True)) - Fraction(square)
    turn = [-2 * g * x * y for g, x in zip(metric, a, strict=True) for y in b]
    forms = [_form(1, _scaled(2, metric, b), _scaled(-2, metric, a), turn, one)]
    return _constraint("distance", forms, base=a, platform=b, length_squared=square)


def _scaled(factor: int, metric: Any, x: Any) -> list[Fraction]:
    return [factor * g * value for g, value in zip(metric, x, strict=True)]


def _constraint(kind: str, forms: Any, **data: Any) -> Content:
    return {"name": "", "type": kind, **{key: texts(value) for key, value in data.items()}, "forms": texts(forms)}


def in_plane(normal: Any, offset: Any, platform: Any) -> Content:
    turn = [n * x for n in normal for x in platform]
    forms = [_form(place=normal, turn=turn, one=-offset)]
    return _constraint("in-plane", forms, normal=normal, offset=offset, platform=platform)


def carries(normal: Any, offset: Any, base: Any) -> Content:
    forms = [_form(turned=[-x for x in normal], turn=[x * m for x in base for m in normal], one=-offset)]
    return _constraint("carries", forms, normal=normal, offset=offset, base=base)


def at_point(point: Any, platform: Any) -> Content:
    forms = [
        _form(place=axis, turn=[x * y for x in axis for y in platform], one=-value)
        for axis, value in zip(LEVEL, point, strict=True)
    ]
    return _constraint("at-point", forms, point=point, platform=platform)


def cylinder(point: Any, direction: Any, platform: Any, square: Any) -> Content:
    whole = leg(point, platform, square)["forms"][0]
    offset = sum(x * y for x, y in zip(point, direction, strict=True))
    root = in_plane(direction, offset, platform)["forms"][0]
    data = {"point": point, "direction": direction, "platform": platform, "radius_squared": square}
    return _constraint("axis-distance", [], **data) | {"forms": [whole, root]}


def row(form: Sequence[Any], position: Any, rotation: Any, g: Any = (1, 1, 1)) -> list[Fraction]:
    """(F; T)."""
    c, x = [Fraction(value) for value in form], [Fraction(value) for value in position]
    r = [[Fraction(value) for value in line] for line in rotation]
    a = [g[i] * sum(r[i][n] * c[1 + n] / g[n] for n in range(3)) for i in range(3)]
    force = [2 * g[i] * c[0] * x[i] + a[i] + c[4 + i] for i in range(3)]
    moment = []
    for j, k in ((1, 2), (2, 0), (0, 1)):
        turn = sum(g[j] * r[j][n] * c[7 + 3 * k + n] - g[k] * r[k][n] * c[7 + 3 * j + n] for n in range(3))
        moment.append(g[k] * a[j] * x[k] - g[j] * a[k] * x[j] + turn)
    return [*force, *moment]


def value(form: Sequence[Any], position: Any, rotation: Any, g: Any = (1, 1, 1)) -> Fraction:
    """At a pose."""
    x, r = [Fraction(v) for v in position], [[Fraction(v) for v in line] for line in rotation]
    turned = [sum(g[i] * r[i][n] * x[i] for i in range(3)) / g[n] for n in range(3)]
    entries = [sum(w * v * v for w, v in zip(g, x, strict=True)), *turned, *x, *(v for line in r for v in line), 1]
    return sum((Fraction(a) * b for a, b in zip(form, entries, strict=True)), Fraction(0))


def rows_of(constraints: Sequence[Content], position: Any, rotation: Any, motion: str, g: Any = (1, 1, 1)) -> Rows:
    """In the columns of a motion."""
    found = []
    for entry in constraints:
        rows = [row(form, position, rotation, g) for form in entry["forms"]]
        if entry["type"] == "axis-distance":
            factor = sum(w * Fraction(v) ** 2 for w, v in zip(g, entry["direction"], strict=True))
            slope = 2 * value(entry["forms"][1], position, rotation, g)
            rows = [[factor * x - slope * y for x, y in zip(*rows, strict=True)]]
        found += [[line[k] for k in TWISTS[motion]] for line in rows]
    return found


def certificate(
    constraints: Sequence[Content],
    actuated: Sequence[int] = (),
    motion: str = "spatial",
    pose: Any = None,
    everywhere: Any = None,
    metric: Any = (1, 1, 1),
) -> Content:
    """What is true; ``everywhere`` is (position, rotation, route, combinations)."""
    labels = {"name": "made up", "unit": "1", "source": "made up"}
    robot = {**labels, "motion": motion, "metric": texts(metric), "constraints": list(constraints)}
    width = len(TWISTS[motion])
    at = always = None
    if pose is not None:
        always = [entry for k, entry in enumerate(constraints) if k not in actuated]
        proofs = [proof(rows_of(chosen, *pose, motion, metric), width)[0] for chosen in (always, constraints)]
        at = {"position": texts(pose[0]), "rotation": texts(pose[1]), "free": proofs[0], "locked": proofs[1]}
    found = None
    if everywhere is not None:
        position, rotation, route, combinations = everywhere
        entry, _ = proof(rows_of(constraints, position, rotation, motion, metric), width)
        head = {"rank": entry["rank"], "position": texts(position), "rotation": texts(rotation)}
        places = {"rows": entry["rows"], "columns": entry["columns"]}
        found = {**head, **places, "route": route, "combinations": texts(combinations)}
    head = {"format": "pkm_exact platform certificate", "version": 1, "robot": robot}
    return {**head, "actuated": list(actuated), "pose": at, "everywhere": found}


BASE = [(0, 0, 0), (7, 1, 0), (3, 8, 1), (-2, 5, 3), (4, -3, 2), (1, 2, -6), (5, 5, 5)]
TOP = [(1, 0, 0), (0, 2, 1), (-1, 1, 0), (2, -1, 3), (0, 0, -2), (3, 1, 1), (1, -1, 2)]
LEGS = [leg(a, b) for a, b in zip(BASE, TOP, strict=True)]
FLAT_LEGS = [leg((*a, 0), (*b, 0)) for a, b in (((0, 0), (0, 0)), ((7, 1), (2, 0)), ((3, 8), (1, 3)))]
TRIANGLE = [leg((*a, 0), (*a, 0)) for a in ((0, 0), (1, 0), (0, 1))]
MERGED = [leg((0, 0, 0), (*b, 0)) for b in ((0, 0), (1, 0), (0, 1))]
HEXAGON = [(1, 0), ("1/2", "1/2"), ("-1/2", "1/2"), (-1, 0), ("-1/2", "-1/2"), ("1/2", "-1/2")]
G3 = (1, 3, 1)
SIX = [leg((*(100 * Fraction(x) for x in c), 0), (*(50 * Fraction(x) for x in c), 0), 1, G3) for c in HEXAGON]
TURN = [[0, 0, 1], ["1/2", "1/2", 0], ["-1/2", "3/2", 0]]
"""In the metric (1, 3, 1)."""
FAR = (3, 1, 4)
PLACED, TURNED = (FAR, LEVEL), (FAR, OBLIQUE)
EQUAL = [LEGS[0], leg(BASE[0], TOP[0], 4), leg(BASE[1], TOP[1])]
SPHERE = [leg(a, b) for a, b in zip(BASE[1:4], TOP[1:4], strict=True)]
SUM_TO_0 = [[1, -1, 0]]
LINEAR = _constraint("linear", [_form(1)], coefficients=_form(1))
ON_PLANE = in_plane((0, 0, 1), 4, (0, 0, 0))
BEARER = carries((0, 1, 0), -1, (0, 0, 0))
ROLLER = cylinder((3, 0, 4), (0, 1, 0), (1, 0, 0), 1)

HONEST: dict[str, tuple[Content, str]] = {
    "legs at a pose": (certificate(LEGS[:6], range(6), pose=PLACED), "everywhere: nothing"),
    "legs at another pose": (certificate(LEGS[:6], range(6), pose=TURNED), "everywhere: nothing"),
    "five legs": (
        certificate(LEGS[:5], range(5), pose=TURNED, everywhere=(*TURNED, "full", [])),
        "everywhere: rank 5, the largest",
    ),
    "seven legs": (certificate(LEGS, range(7), everywhere=(*TURNED, "full", [])), "everywhere: rank 6, the largest"),
    "nothing": (certificate(LEGS[:1]), "everywhere: nothing"),
    "a joint that always holds": (
        certificate([at_point(FAR, (0, 0, 0)), LEGS[0]], [1], pose=TURNED),
        "everywhere: nothing",
    ),
    "planes": (
        certificate([ON_PLANE, BEARER, LEGS[2]], [2], pose=PLACED, everywhere=(*TURNED, "full", [])),
        "everywhere: rank 3, the largest",
    ),
    "a cylinder": (certificate([ROLLER], [], pose=((2, 5, 3), LEVEL)), "everywhere: nothing"),
    "a cylinder that is actuated": (certificate([ROLLER, LEGS[0]], [0, 1], pose=TURNED), "everywhere: nothing"),
    "a planar robot": (
        certificate(FLAT_LEGS, [0, 1, 2], "planar", ((3, 1, 0), QUARTER), ((5, 2, 0), LEVEL, "full", [])),
        "everywhere: rank 3, the largest",
    ),
    "a planar robot that is singular": (
        certificate(TRIANGLE, [0, 1, 2], "planar", ((3, 1, 0), LEVEL), ((3, 1, 0), QUARTER, "full", [])),
        "everywhere: rank 3, the largest",
    ),
    "legs of one base joint": (
        certificate(MERGED, [], "planar", None, ((3, 1, 0), QUARTER, "grid", [])),
        "everywhere: rank 2 at most",
    ),
    "a lift that turns": (
        certificate(LEGS[:4], range(4), "schoenflies", (FAR, QUARTER), (FAR, QUARTER, "full", [])),
        "everywhere: rank 4, the largest",
    ),
    "translations": (
        certificate(LEGS[:3], range(3), "translation", PLACED, (*PLACED, "full", [])),
        "everywhere: rank 3, the largest",
    ),
    "one point that translates": (
        certificate(
            [leg(BASE[0], TOP[0]), leg((1, 1, 0), (2, 1, 0)), LEGS[1]], [], "translation", None, (*PLACED, "grid", [])
        ),
        "everywhere: rank 2 at most",
    ),
    "a wrist": (
        certificate(SPHERE, range(3), "spherical", ((0, 0, 0), OBLIQUE), ((0, 0, 0), OBLIQUE, "full", [])),
        "everywhere: rank 3, the largest",
    ),
    "legs that are equal": (
        certificate(EQUAL, range(3), everywhere=(*TURNED, "combination", SUM_TO_0)),
        "everywhere: rank 2 at most",
    ),
    "three legs that are equal": (
        certificate([EQUAL[0], EQUAL[0], EQUAL[1]], [], everywhere=(*TURNED, "combination", [[1, -1, 0], [0, 3, -3]])),
        "everywhere: rank 1 at most",
    ),
    "legs equal in the plane": (
        certificate(
            [leg((0, 0, 0), (0, 0, 0)), leg((0, 0, 2), (0, 0, 5))],
            [],
            "planar",
            None,
            ((3, 1, 0), LEVEL, "combination", [[2, -2]]),
        ),
        "everywhere: rank 1 at most",
    ),
    "legs equal in the plane, by a grid": (
        certificate(
            [leg((0, 0, 0), (0, 0, 0)), leg((0, 0, 2), (0, 0, 5))],
            [],
            "planar",
            None,
            ((3, 1, 0), LEVEL, "grid", []),
        ),
        "everywhere: rank 1 at most",
    ),
    "aligned hexagons": (
        certificate(SIX, range(6), "spatial", (FAR, TURN), (FAR, TURN, "combination", [[1, -1, 1, -1, 1, -1]]), G3),
        "everywhere: rank 5 at most",
    ),
    "a rank that was met": (
        certificate(TRIANGLE, [], "planar", None, ((3, 1, 0), LEVEL, "none", [])),
        "everywhere: rank 2 was met",
    ),
    "a distance from the origin that does not change": (
        certificate([LINEAR], [], "spherical", None, ((0, 0, 0), OBLIQUE, "grid", [])),
        "everywhere: rank 0 at most",
    ),
}

ROBOT, POSE, EVERYWHERE = "robot", "pose", "everywhere"
FIVE, FLAT, MERGE, SAME = (
    HONEST[name][0] for name in ("five legs", "a planar robot", "legs of one base joint", "legs that are equal")
)
SIX_POSED = HONEST["legs at a pose"][0]
SAME_POSED = certificate(EQUAL, range(3), "spatial", ((50, -3, 4), OBLIQUE), (*TURNED, "combination", SUM_TO_0))
JOINED, CYLINDER, WRIST = (HONEST[name][0] for name in ("a joint that always holds", "a cylinder", "a wrist"))
LIFT, SHIFT, ALIGNED = (HONEST[name][0] for name in ("a lift that turns", "translations", "aligned hexagons"))
NO_TURN, NO_MOTION, NO_HOLD = (
    "rotation: not one in the metric",
    "not one of the motions",
    "pose: a constraint that always",
)
MIRROR = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]
SHEARS = [
    [[1, 1, 0], [0, 1, 0], [0, 0, 1]],
    [[1, 0, "1/3"], [0, 1, 0], [0, 0, 1]],
    [[1, 0, 0], ["1/3", 1, 0], [0, 0, 1]],
    [[2, 0, 0], [0, "1/2", 0], [0, 0, 1]],
    [[1, 0, 0], [0, 1, "-1/3"], [0, 0, 1]],
]


def _everywhere(content: Content, rank: int, route: str, combinations: Any = (), **entries: Any) -> Content:
    """With another claim: the first rows and columns unless others are given."""
    claim = {**content[EVERYWHERE], "rank": rank, "route": route, "combinations": texts(combinations)}
    claim |= {"rows": list(range(rank)), "columns": list(range(rank))}
    return content | {EVERYWHERE: claim | entries}


def _posed(
    legs: Sequence[Content], motion: str, position: Any, rotation: Any, line: str, metric: Any = (1, 1, 1)
) -> Row:
    """With proofs that fit what is no pose."""
    found = certificate(legs, range(len(legs)), motion, (position, rotation), None, metric)
    return found, "rejected", f"pose{line}"


def _met(legs: Sequence[Content], motion: str, position: Any, rotation: Any, line: str) -> Row:
    found = certificate(legs, [], motion, None, (position, rotation, "none", []))
    return found, "rejected", f"everywhere{line}"


def _held(constraints: Sequence[Content], position: Any) -> Row:
    """At a pose where some constraint does not hold, with proofs that fit."""
    return certificate(constraints, [], "spatial", (position, LEVEL)), "rejected", NO_HOLD


ALL_LEGS = certificate(LEGS, range(7), everywhere=(*TURNED, "grid", []))
TWO_OF_PLANE = certificate([FLAT_LEGS[0], FLAT_LEGS[1]], [], "planar", None, ((5, 2, 0), LEVEL, "full", []))
PENCIL = [*LEGS[1:4], *(leg((10, 10, 4), b) for b in ((0, 0, 0), (1, 0, 0), (0, 1, 0)))]
"""Three of the legs are in a plane at the pose with C = (3, 1, 4) and R = 1."""
AT_REST = certificate([LINEAR], [], "spatial", None, ((0, 0, 0), OBLIQUE, "grid", []))
SLIDING = certificate([LINEAR], [], "translation", None, ((0, 0, 0), LEVEL, "grid", []))
ROLLED = certificate([LINEAR], [], "planar", None, ((0, 0, 0), QUARTER, "grid", []))
TURNING = certificate(
    [_constraint("angle", [_form(turn=[1, 0, 0, 0, 0, 0, 0, 0, 0])], base=(1, 0, 0), platform=(1, 0, 0), product=0)],
    [],
    "spherical",
    None,
    ((0, 0, 0), LEVEL, "grid", []),
)

FORGED: dict[str, Row] = {
    "a mirror": _posed(LEGS[:5], "spatial", FAR, MIRROR, "." + NO_TURN),
    "a mirror everywhere": _met(LEGS[:5], "spatial", FAR, MIRROR, "." + NO_TURN),
    **{
        f"a matrix of determinant 1, {k}": _posed(LEGS[:5], "spatial", FAR, rows, "." + NO_TURN)
        for k, rows in enumerate(SHEARS)
    },
    "a shear everywhere": _met(LEGS[:5], "spatial", FAR, SHEARS[0], "." + NO_TURN),
    "a rotation in another metric": _posed(SIX, "spatial", FAR, OBLIQUE, "." + NO_TURN, G3),
    "a rotation in this metric": (
        certificate(SIX, range(6), "spatial", (FAR, TURN), None, G3),
        "accepted",
        "everywhere: nothing",
    ),
    "a tilt in the plane": _posed(FLAT_LEGS, "planar", (3, 1, 0), [[1, 0, 0], [0, 0, -1], [0, 1, 0]], ": " + NO_MOTION),
    "a lift in the plane": _posed(FLAT_LEGS, "planar", (3, 1, 2), LEVEL, ": " + NO_MOTION),
    "a lift in the plane everywhere": _met(FLAT_LEGS, "planar", (3, 1, 2), LEVEL, ": " + NO_MOTION),
    "a turn of a translation": _posed(LEGS[:3], "translation", FAR, QUARTER, ": " + NO_MOTION),
    "a move of a wrist": _posed(SPHERE, "spherical", (1, 0, 0), OBLIQUE, ": " + NO_MOTION),
    "another tilt of a lift": _posed(LEGS[:4], "schoenflies", FAR, OBLIQUE, ": " + NO_MOTION),
    **{
        f"a joint that does not hold along {k}": _held(
            [at_point(FAR, (0, 0, 0))], [FAR[j] + (j == k) for j in range(3)]
        )
        for k in range(3)
    },
    "a joint that holds": (
        certificate([at_point(FAR, (0, 0, 0))], [], "spatial", (FAR, LEVEL)),
        "accepted",
        "everywhere: nothing",
    ),
    "the first of three that does not hold": _held([ON_PLANE, BEARER, at_point((1, 1, 7), (-2, 0, 2))], (3, 1, 5)),
    "the last of three that does not hold": _held([in_plane((1, 0, 0), 3, (0, 0, 0)), BEARER, ON_PLANE], (3, 1, 5)),
    "outside of a cylinder": _held([ROLLER], (2, 5, 6)),
    "within a cylinder": _held([ROLLER], ("5/2", 5, "7/2")),
    "an actuated leg that is called fixed": (
        put(certificate(LEGS[:2], [], pose=TURNED), [1], "actuated"),
        "rejected",
        NO_HOLD,
    ),
    "a fixed joint that is called actuated": (put(JOINED, [0, 1], "actuated"), "malformed", "pose.free: a place"),
    "another null space of the free": (
        put(JOINED, "7", POSE, "free", "null_space", 0, 0),
        "rejected",
        "pose.free.null_space",
    ),
    "another null space of the locked": (
        put(JOINED, "7", POSE, "locked", "null_space", 0, 0),
        "rejected",
        "pose.locked.null_space",
    ),
    "the free as the locked": (
        put(JOINED, JOINED[POSE]["locked"], POSE, "free"),
        "malformed",
        "pose.free: a place outside",
    ),
    "the locked as the free": (put(JOINED, JOINED[POSE]["free"], POSE, "locked"), "rejected", "pose.locked.null_space"),
    "a minor of the locked that is 0": (
        put(certificate(EQUAL, range(3), pose=TURNED), [0, 1], POSE, "locked", "rows"),
        "rejected",
        "pose.locked: the minor",
    ),
    "a cylinder everywhere": (
        CYLINDER | {EVERYWHERE: {**FIVE[EVERYWHERE], "rank": 0, "rows": [], "columns": [], "route": "none"}},
        "rejected",
        "everywhere: a constraint is a quadric",
    ),
    "a row that is none": (_everywhere(FIVE, 1, "none", rows=[5]), "malformed", "everywhere: a place outside"),
    "a column that is none": (_everywhere(FIVE, 1, "none", columns=[6]), "malformed", "everywhere: a place outside"),
    "a column of a turn that is none": (_everywhere(FLAT, 1, "none", columns=[3]), "malformed", "everywhere: a place"),
    "the last column of the plane": (
        _everywhere(FLAT, 1, "none", rows=[1], columns=[2]),
        "accepted",
        "everywhere: rank 1 was",
    ),
    "the last row": (_everywhere(FIVE, 1, "none", rows=[4]), "accepted", "everywhere: rank 1 was met"),
    "a minor that is 0": (_everywhere(SAME, 2, "combination", SUM_TO_0), "rejected", "everywhere: the minor"),
    "less than the largest": (_everywhere(FIVE, 4, "full"), "rejected", "everywhere: the rank is not the largest"),
    "less than all columns": (
        _everywhere(HONEST["seven legs"][0], 5, "full"),
        "rejected",
        "everywhere: the rank is not the largest",
    ),
    "two rows of the plane": (TWO_OF_PLANE, "accepted", "everywhere: rank 2, the largest"),
    "less than two rows of the plane": (
        _everywhere(TWO_OF_PLANE, 1, "full"),
        "rejected",
        "everywhere: the rank is not",
    ),
    "too few numbers": (
        _everywhere(SAME, 2, "combination", [[1, -1]], rows=[0, 2]),
        "malformed",
        "everywhere.combinations: not a number",
    ),
    "too many numbers": (
        _everywhere(SAME, 2, "combination", [[1, -1, 0, 0]], rows=[0, 2]),
        "malformed",
        "everywhere.combinations: not a number",
    ),
    "one combination for two": (
        _everywhere(SAME, 1, "combination", SUM_TO_0),
        "rejected",
        "everywhere: not the rank that",
    ),
    "two combinations for one": (
        _everywhere(SAME, 2, "combination", [*SUM_TO_0, [2, -2, 0]], rows=[0, 2]),
        "rejected",
        "everywhere: not the rank",
    ),
    "a combination twice": (
        _everywhere(SAME, 1, "combination", [*SUM_TO_0, [2, -2, 0]]),
        "rejected",
        "everywhere.combinations: not independent",
    ),
    "a combination of nothing": (
        _everywhere(SAME, 2, "combination", [[0, 0, 0]], rows=[0, 2]),
        "rejected",
        "everywhere.combinations: not independent",
    ),
    "a combination that is not 0": (
        _everywhere(SAME, 2, "combination", [[1, 1, 0]], rows=[0, 2]),
        "rejected",
        "everywhere.combinations: not 0",
    ),
    "the second combination is not 0": (
        _everywhere(SAME, 1, "combination", [*SUM_TO_0, [0, 0, 1]]),
        "rejected",
        "everywhere.combinations: not 0",
    ),
    "a combination that is 0 in the plane only": (
        certificate(
            [leg((0, 0, 0), (0, 0, 0)), leg((0, 0, 2), (0, 0, 5))],
            [],
            "spatial",
            None,
            ((0, 0, 1), LEVEL, "combination", [[2, -2]]),
        ),
        "rejected",
        "everywhere",
    ),
    "a grid of too many poses": (ALL_LEGS, "too-large", "everywhere: a grid of more than 20000"),
    "a grid of as many as may be": (
        certificate(PENCIL, everywhere=(*PLACED, "grid", [])),
        "rejected",
        "everywhere: the rank is greater at a pose of the grid",
    ),
    "a rank at the grid's first pose": (
        _everywhere(TWO_OF_PLANE, 1, "grid"),
        "rejected",
        "everywhere: the rank is greater at a pose",
    ),
    "equal triangles, level": (
        certificate(TRIANGLE, [], "planar", None, ((3, 1, 0), LEVEL, "grid", [])),
        "rejected",
        "everywhere: the rank is greater at a pose",
    ),
    "a distance that changes from the next pose on": (AT_REST, "rejected", "everywhere: the rank is greater at a pose"),
    "a distance that changes with translations": (SLIDING, "rejected", "everywhere: the rank is greater at a pose"),
    "a distance that changes in the plane": (ROLLED, "rejected", "everywhere: the rank is greater at a pose"),
    "an angle that does not change at rest": (TURNING, "rejected", "everywhere: the rank is greater"),
    "the second combination is too short": (
        _everywhere(SAME, 1, "combination", [*SUM_TO_0, [1, -1]]),
        "malformed",
        "everywhere.combinations: not a number",
    ),
    "rows in one number": (_everywhere(FIVE, 1, "none", rows=5), "malformed", "everywhere.rows"),
    "more rows than the rank": (_everywhere(FIVE, 1, "none", rows=[0, 1]), "malformed", "everywhere.rows"),
    "more columns than the rank": (_everywhere(FIVE, 1, "none", columns=[0, 1]), "malformed", "everywhere.columns"),
    "the only actuator is none": (put(FIVE, [5], "actuated"), "malformed", "actuated: no place"),
    "a combination without its route": (
        _everywhere(SAME, 2, "none", SUM_TO_0, rows=[0, 2]),
        "malformed",
        "everywhere.combinations: not those",
    ),
    "a route without its combination": (
        _everywhere(SAME, 2, "combination", [], rows=[0, 2]),
        "malformed",
        "everywhere.combinations: not those",
    ),
    "a route of its own": (_everywhere(FIVE, 5, "words"), "malformed", "everywhere.route"),
    "rows in another order": (
        _everywhere(FIVE, 2, "none", rows=[1, 0]),
        "malformed",
        "everywhere.rows: not in increasing",
    ),
    "a column twice": (
        _everywhere(FIVE, 2, "none", columns=[1, 1]),
        "malformed",
        "everywhere.columns: not in increasing",
    ),
    "a rank of one more": (
        _everywhere(FIVE, 5, "full") | {EVERYWHERE: {**FIVE[EVERYWHERE], "rank": 6}},
        "malformed",
        "everywhere.rows",
    ),
    "a rank below 0": (put(FIVE, -1, EVERYWHERE, "rank"), "malformed", "everywhere.rank"),
    "a position of two": (put(FIVE, ["0", "0"], EVERYWHERE, "position"), "malformed", "everywhere.position"),
    "a rotation of two rows": (put(FIVE, texts(LEVEL[:2]), POSE, "rotation"), "malformed", "pose.rotation"),
    "a rotation of short rows": (put(FIVE, [["1", "0"]] * 3, POSE, "rotation"), "malformed", "pose.rotation"),
    "an actuator that is none": (put(FIVE, [0, 1, 2, 3, 5], "actuated"), "malformed", "actuated: no place"),
    "actuators in another order": (put(FIVE, [1, 0], "actuated"), "malformed", "actuated: not in increasing"),
    "an actuator twice": (put(FIVE, [0, 0, 1], "actuated"), "malformed", "actuated: not in increasing"),
    "an actuator below 0": (put(FIVE, [-1, 0], "actuated"), "malformed", "actuated[1]"),
    "actuators in words": (put(FIVE, "all", "actuated"), "malformed", "actuated"),
    "forms of another leg": (
        put(FIVE, LEGS[1]["forms"], ROBOT, "constraints", 0, "forms"),
        "rejected",
        "robot.constraints[1]: its forms",
    ),
    "no constraint": (put(FIVE, [], ROBOT, "constraints"), "malformed", "robot.constraints"),
    "version 0": (put(FIVE, 0, "version"), "malformed", "format"),
    "version 2": (put(FIVE, 2, "version"), "malformed", "format"),
    "a true version": (put(FIVE, True, "version"), "malformed", "format"),
    "a pose of no object": (put(FIVE, [], POSE), "malformed", "pose: not an object"),
    "everywhere in words": (put(FIVE, "yes", EVERYWHERE), "malformed", "everywhere: not an object"),
}
ROWS: dict[str, Row] = merged({f"made: {n}": (c, "accepted", line) for n, (c, line) in HONEST.items()}, FORGED)

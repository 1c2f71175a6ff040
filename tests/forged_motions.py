"""Certificates of version 2 that mechanisms move, for every cause: honest ones, and others that lack one thing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from held_mechanisms import PLACED, Content, Numbers, Pose, listing, moving
from mechanism_certificates import mechanism_content

from pkm_exact.constraints.constraint import Constraint

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
ANY = [(7, 1, 2), (-3, 5, 1), (-6, -2, 3), (1, -7, -2), (2, 6, -4), (5, -3, 6)]
"""Points in no special position."""
OTHERS = [(1, 2, 0), (-2, 1, 1), (0, -3, 2), (4, 4, 1), (-3, 1, -1), (3, -2, 5)]


def _on_line(point: Numbers, direction: Numbers) -> list[list[Fraction]]:
    return [
        [Fraction(p) + k * Fraction(v) for p, v in zip(point, direction, strict=True)] for k in (-2, -1, 1, 2, 3, 5)
    ]


def _combinations(one: Numbers, other: Numbers) -> list[list[Fraction]]:
    """Directions in a plane."""
    factors = ((1, 0), (0, 1), (1, 1), (2, -1), (1, 3), (-2, 3))
    return [[a * Fraction(x) + b * Fraction(y) for x, y in zip(one, other, strict=True)] for a, b in factors]


# A group of motions leaves all constraints as they are

LINES = {
    "through the origin": ((0, 0, 0), (1, 2, -3)),
    "elsewhere": ((1, -2, 4), (2, 1, 3)),
    **{f"along axis {k + 1}": ((2, 3, 5), tuple(int(k == j) for j in range(3))) for k in range(3)},
}
PLANE = ((1, 2, -1), (3, 0, 2))


def _turned_about_lines(at: Pose) -> Iterator[tuple[str, list[Constraint]]]:
    for name, line in LINES.items():
        joints = _on_line(*line)
        yield f"platform joints on a line {name}", [at.distance(a, b) for a, b in zip(ANY, joints, strict=True)]
        yield f"base joints on a line {name}", [at.distance(a, b) for a, b in zip(joints, ANY, strict=True)]
        planes = [at.in_plane(n, b) for n, b in zip(OTHERS, joints, strict=True)]
        yield f"platform points on a line {name}, in planes", planes
        carried = [at.carries(m, a) for m, a in zip(OTHERS, joints, strict=True)]
        yield f"base points on a line {name}, in planes of the platform", carried
        point, direction = line
        coaxial = [at.axis_distance(p, direction, b) for p, b in zip(joints[:3], ANY, strict=False)]
        yield f"cylinders around a line {name}", [*coaxial, at.distance(point, OTHERS[0])]
        angles = [at.angle(n, direction) for n in (*OTHERS[:2], (1, 1, 4))]
        legs = [at.distance(a, b) for a, b in zip(ANY[:3], joints, strict=False)]
        yield f"angles and joints with a line of the platform {name}", [*angles, *legs]
        angles = [at.angle(direction, m) for m in (*OTHERS[:2], (1, 1, 4))]
        legs = [at.distance(a, b) for a, b in zip(joints, ANY[:3], strict=False)]
        yield f"angles and joints with a line of the base {name}", [*angles, *legs]


def _shifted(at: Pose) -> Iterator[tuple[str, list[Constraint]]]:
    for one, other in (PLANE, ((1, 0, 0), (0, 1, 0)), ((0, 1, 0), (0, 0, 1)), ((0, 0, 1), (1, 0, 0))):
        normals = _combinations(one, other)
        fixed = [at.angle(n, m) for n, m in zip(ANY[:2], OTHERS, strict=False)]
        planes = [at.in_plane(n, b) for n, b in zip(normals[:4], OTHERS, strict=False)]
        yield f"planes along a direction, normals {one} {other}", [*planes, *fixed]
        carried = [at.carries(m, a) for m, a in zip(normals[:4], OTHERS, strict=False)]
        yield f"planes of the platform along a direction, normals {one} {other}", [*carried, *fixed]


def _spoiled(at: Pose, constraints: Sequence[Constraint], place: int) -> list[Constraint]:
    """A leg in no special position in place of one constraint."""
    found = list(constraints)
    found[place] = at.distance((11, -5, 3), (2, 9, -7))
    return found


OTHER_KINDS: dict[str, tuple[str, Pose, Callable[[Pose], list[Constraint]]]] = {
    "Schoenflies, platform joints on a vertical line": (
        "schoenflies",
        Pose((2, 0, 0, 1), (1, 3, 4, -2), (1, 2, 3)),
        lambda at: [at.distance(a, b) for a, b in zip(ANY[:4], _on_line((1, 2, 0), (0, 0, 1)), strict=False)],
    ),
    "Schoenflies, base joints on a vertical line": (
        "schoenflies",
        Pose((2, 0, 0, 1), (1, 3, 4, -2), (1, 2, 3)),
        lambda at: [at.distance(a, b) for a, b in zip(_on_line((1, 2, 0), (0, 0, 1)), ANY[:4], strict=False)],
    ),
    "planar, one joint of the platform": (
        "planar",
        Pose((2, 0, 0, 1), (0, 3, 4, 0), (1, 2, 3)),
        lambda at: [at.distance(a, (2, 3, 0)) for a in ANY[:3]],
    ),
    "planar, one joint of the base": (
        "planar",
        Pose((2, 0, 0, 1), (0, 3, 4, 0), (1, 2, 3)),
        lambda at: [at.distance((2, 3, 0), b) for b in ANY[:3]],
    ),
    "translations, planes along a direction": (
        "translation",
        Pose((1, 0, 0, 0), (0, 3, 4, 5), (1, 2, 3)),
        lambda at: [at.in_plane(n, b) for n, b in zip(_combinations(*PLANE)[:3], ANY, strict=False)],
    ),
    "about a point, base joints on a line": (
        "spherical",
        Pose((2, 1, -1, 3), (0, 0, 0, 0), (1, 2, 3)),
        lambda at: [at.distance(a, b) for a, b in zip(_on_line((0, 0, 0), (1, 2, -3))[:3], ANY, strict=False)],
    ),
    "about a point, platform joints on a line": (
        "spherical",
        Pose((2, 1, -1, 3), (0, 0, 0, 0), (1, 2, 3)),
        lambda at: [at.distance(a, b) for a, b in zip(ANY, _on_line((0, 0, 0), (1, 2, -3))[:3], strict=False)],
    ),
}


def _symmetric() -> Iterator[tuple[str, Case]]:
    every: list[tuple[str, str, Pose, list[Constraint]]] = []
    every += [(name, "spatial", PLACED, found) for name, found in _turned_about_lines(PLACED)]
    every += [(name, "spatial", PLACED, found) for name, found in _shifted(PLACED)]
    every += [(name, kind, at, make(at)) for name, (kind, at, make) in OTHER_KINDS.items()]
    for name, kind, at, constraints in every:
        yield name, (lambda k=kind, at=at, c=constraints: moving(listing(k, [at], c), "symmetry"), ACCEPTED)  # type: ignore[misc]
        yield (
            f"{name}, not said to move really",
            (lambda k=kind, at=at, c=constraints: moving(listing(k, [at], c), "symmetry", real=False), REJECTED),  # type: ignore[misc]
        )
        for place in (0, -1):
            spoiled = _spoiled(at, constraints, place)
            yield (
                f"{name}, but for {'the first' if place == 0 else 'the last'}",
                (lambda k=kind, at=at, c=spoiled: moving(listing(k, [at], c), "symmetry"), REJECTED),  # type: ignore[misc]
            )


SHIFTED = (
    ((3, 1, 2), (1, 0, 2, -1, 3, 0, 1, 1, 2)),
    ((1, -2, 1), (2, 1, 0, 1, -1, 3, 0, 2, 1)),
    ((0, 1, 3), (0, 3, 1, 1, 2, -2, 1, 0, 4)),
    ((2, 0, -1), (1, 1, 1, 0, 3, 2, -1, 2, 0)),
    ((1, 1, 0), (3, -1, 2, 0, 1, 1, 2, 0, 1)),
    ((-1, 2, 2), (0, 2, -1, 3, 1, 0, 1, 1, -3)),
)


def _shifts_of_the_axis() -> Content:
    """Forms in u, C_3 and R that a shift of the platform along its third axis changes by multiples of 1 - r_33."""
    forms = [PLACED.linear((0, *u, 0, 0, -u[2], *rotation)) for u, rotation in SHIFTED]
    return moving(listing("spatial", [PLACED], forms), "symmetry")


def _cylinders(place: int) -> Content:
    """All around one line, but for one of them."""
    point, direction = LINES["elsewhere"]
    axes = [direction] * 3
    axes[place] = (1, 1, -2)
    parts = zip(_on_line(point, direction), axes, ANY, strict=False)
    legs = [PLACED.distance(point, OTHERS[0])]
    return moving(
        listing("spatial", [PLACED], [*(PLACED.axis_distance(*part) for part in parts), *legs], None), "symmetry"
    )


COAXIAL: dict[str, Case] = {
    f"cylinder {n + 1} of three around another line": (partial(_cylinders, n), REJECTED) for n in range(3)
}

# Dependent constraints

IDENTITY = Pose((1, 0, 0, 0), (0, 0, 0, 0))


def _in_line(second: Numbers) -> Content:
    """Two planar legs; where they lie on one line, their rows are dependent."""
    legs = [IDENTITY.distance((0, 0, 0), (1, 0, 0)), IDENTITY.distance((3, 0, 0), second)]
    return listing("planar", [IDENTITY], legs, None)


DEPENDENT: dict[str, Case] = {
    "two planar legs on a line, said to move really": (
        lambda: moving(_in_line((5, 0, 0)), "dependent-forms"),
        REJECTED,
    ),
    "two planar legs on a line": (lambda: moving(_in_line((5, 0, 0)), "dependent-forms", real=False), ACCEPTED),
    "two planar legs": (lambda: moving(_in_line((5, 1, 0)), "dependent-forms"), ACCEPTED),
    "two planar legs, not said to move really": (
        lambda: moving(_in_line((5, 1, 0)), "dependent-forms", real=False),
        REJECTED,
    ),
    "two cylinders and three legs": (
        lambda: moving(
            listing(
                "spatial",
                [PLACED],
                [
                    *(PLACED.axis_distance(p, v, b) for p, v, b in zip(ANY[:2], OTHERS[:2], ANY[4:], strict=True)),
                    *(PLACED.distance(a, b) for a, b in zip(ANY[2:5], OTHERS[2:5], strict=True)),
                ],
                None,
            ),
            "dependent-forms",
        ),
        ACCEPTED,
    ),
    "two cylinders and four legs": (
        lambda: moving(
            listing(
                "spatial",
                [PLACED],
                [
                    *(PLACED.axis_distance(p, v, b) for p, v, b in zip(ANY[:2], OTHERS[:2], ANY[4:], strict=True)),
                    *(PLACED.distance(a, b) for a, b in zip(ANY[2:], OTHERS[2:], strict=True)),
                ],
                None,
            ),
            "dependent-forms",
        ),
        REJECTED,
    ),
    "a leg given twice, and four others": (
        lambda: moving(
            listing(
                "spatial",
                [PLACED],
                [PLACED.distance(a, b) for a, b in zip((ANY[0], *ANY[:5]), (OTHERS[0], *OTHERS[:5]), strict=True)],
                None,
            ),
            "dependent-forms",
        ),
        ACCEPTED,
    ),
}


# Equal legs


def _equal(vectors: Sequence[Numbers], kind: str = "spatial", more: Sequence[Constraint] = ()) -> Content:
    legs = []
    for b, d in zip(ANY, vectors, strict=False):
        joint = b if kind != "planar" else (*b[:2], 0)
        legs.append(IDENTITY.distance([x - Fraction(y) for x, y in zip(joint, d, strict=True)], joint))
    return moving(listing(kind, [IDENTITY], [*legs, *more], None), "equal-legs")


D = (1, 2, 3)
EQUAL: dict[str, Case] = {
    "six equal legs": (lambda: _equal([D] * 6), ACCEPTED),
    "one leg": (lambda: _equal([D]), ACCEPTED),
    "two equal legs": (lambda: _equal([D] * 2), ACCEPTED),
    "equal legs of a planar robot": (lambda: _equal([(1, 2, 0)] * 3, "planar"), ACCEPTED),
    "tilted equal legs of a planar robot": (lambda: _equal([D] * 3, "planar"), ACCEPTED),
    "upright equal legs of a planar robot": (lambda: _equal([(0, 0, 3)] * 3, "planar"), REJECTED),
    "upright equal legs of a spatial robot": (lambda: _equal([(0, 0, 3)] * 6), ACCEPTED),
    "equal legs of a Schoenflies robot": (lambda: _equal([D] * 4, "schoenflies"), REJECTED),
    "equal legs of a platform that keeps its orientation": (lambda: _equal([D] * 3, "translation"), REJECTED),
    "equal legs beside a plane": (
        lambda: _equal([D] * 6, "spatial", [IDENTITY.in_plane((1, 2, 3), (3, 1, 2))]),
        REJECTED,
    ),
    **{
        f"leg {place + 1} of six turned in coordinate {k + 1}": (
            lambda place=place, k=k: _equal(_with_one(place, k)),  # type: ignore[misc]
            REJECTED,
        )
        for place in (0, 1, 5)
        for k in range(3)
    },
}


def _with_one(place: int, k: int) -> list[Numbers]:
    other = [-x if j == k else x for j, x in enumerate(D)]
    return [other if n == place else D for n in range(6)]


# More poses than can be isolated


def _slices(change: Callable[[list[Any]], list[Any]], *, real: bool = True, **entries: Any) -> Content:
    content = mechanism_content("slices")
    found = {**content["self_motion"], "slices": change(content["self_motion"]["slices"]), "real": real}
    return content | {"self_motion": found | entries}


SLICES: dict[str, Case] = {
    "slices by the method krawczyk": (lambda: _slices(lambda cuts: cuts) | {"method": "krawczyk"}, REJECTED),
    "as many poses as can be isolated": (lambda: _slices(lambda cuts: cuts[:-1], real=False), REJECTED),
    "the first two slices in the other order": (lambda: _slices(lambda cuts: [cuts[1], cuts[0], *cuts[2:]]), REJECTED),
    "the last two slices in the other order": (lambda: _slices(lambda cuts: [*cuts[:2], cuts[3], cuts[2]]), REJECTED),
    "a slice twice": (lambda: _slices(lambda cuts: [cuts[0], *cuts[:3]]), REJECTED),
    "no slices": (lambda: _slices(lambda _: []), REJECTED),
    "no forms": (lambda: _slices(lambda cuts: cuts, forms=[]), REJECTED),
    "slices, not said to move really": (lambda: _slices(lambda cuts: cuts, real=False), REJECTED),
    "slices beside a representation": (
        lambda: _slices(lambda cuts: cuts) | {"representation": mechanism_content("parallelogram")["representation"]},
        REJECTED,
    ),
    **{
        f"{part} with another cause": (
            lambda part=part: (
                mechanism_content("parallelogram")  # type: ignore[misc]
                | {
                    "self_motion": mechanism_content("parallelogram")["self_motion"]
                    | {part: mechanism_content("slices")["self_motion"][part]}
                }
            ),
            REJECTED,
        )
        for part in ("forms", "slices")
    },
    "another cause without a representation": (
        lambda: mechanism_content("parallelogram") | {"representation": None},
        REJECTED,
    ),
}

SHIFTS: dict[str, Case] = {"forms that a shift changes by multiples of 1 - r33": (_shifts_of_the_axis, REJECTED)}
MOTIONS: dict[str, Case] = {**dict(_symmetric()), **SHIFTS, **COAXIAL, **DEPENDENT, **EQUAL, **SLICES}

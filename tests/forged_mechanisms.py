"""Forged and honest certificates of version 2: those of version 1 written anew, and claims that do not follow."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

from flint import fmpz_poly
from forged_boxes import BOXES
from forged_completions import without_factor
from forged_poses import POSES
from forgeries import BOXES as AT_INFINITY
from forgeries import CLAIMS, DETECTED, NOTHING, OPEN, POLYNOMIALS
from held_mechanisms import KEYS, PLACED, Content, Pose, listing, mechanism, moving
from mechanism_certificates import mechanism_content
from mechanisms import vector

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance

Case = tuple[Callable[[], Content], str]
"""A certificate and what both checkers must say, "accepted" or "rejected"."""
REJECTED, ACCEPTED = "rejected", "accepted"


# What version 1 says, in version 2


def as_version_2(content: Content, cause: str = "equal-legs", *, real: bool = True) -> Content:
    """A certificate of version 1 in version 2: legs are constraints, and a motion that is proved has a cause."""
    robot, squares = content["robot"], content["configuration"]["lengths_squared"]
    metric = tuple(int(g) for g in robot["metric"])
    joints = zip(robot["base"], robot["platform"], squares, strict=True)
    legs = [Distance(_point(a), _point(b), Fraction(square)) for a, b, square in joints]
    kind = "planar" if len(legs) == 3 else "spatial"
    is_moving = content["claim"] == "positive-dimensional-proved"
    others = {
        "version": 2,
        "robot": mechanism(kind, metric, legs),  # type: ignore[arg-type]
        "configuration": content["configuration"]["name"],
        "infinity": None,
        "self_motion": {"cause": cause, "real": real, "forms": [], "slices": []} if is_moving else None,
    }
    return {key: others.get(key, content.get(key)) for key in KEYS}


def _point(texts: Sequence[str]) -> Any:
    return vector(*map(Fraction, texts))  # type: ignore[arg-type]


OTHERWISE: dict[str, tuple[str, str, bool]] = {
    "forty-one witnesses": (ACCEPTED, "equal-legs", True),
    "complex witnesses of a motion": (ACCEPTED, "equal-legs", False),
    "no first prime tells the roots apart": (ACCEPTED, "symmetry", True),
    "only the last prime tells the roots apart": (ACCEPTED, "symmetry", True),
}
"""What version 2 says of some, with the cause: there is no greatest number of witnesses, and words on real ones."""


def _rewritten() -> Iterator[tuple[str, Case]]:
    every = [(name, forgery.make, forgery.status) for name, forgery in (POLYNOMIALS | AT_INFINITY | CLAIMS).items()]
    every += [(name, make, status) for name, (make, status, _) in (POSES | BOXES).items()]
    for name, make, status in every:
        said, cause, real = OTHERWISE.get(name, (status, "equal-legs", True))
        yield name, (partial(_anew, make, cause, real), said)


def _anew(make: Callable[[], Content], cause: str, real: bool) -> Content:
    return as_version_2(make(), cause, real=real)


# Every type of constraint, in every kind of motion

TYPES: dict[str, Callable[[Pose], Sequence[Constraint]]] = {
    "distance": lambda at: [at.distance((1, 2, 3), (2, -1, 4))],
    "in-plane": lambda at: [at.in_plane((1, -2, 3), (2, 5, 4))],
    "carries": lambda at: [at.carries((3, 1, -2), (1, 2, -5))],
    "angle": lambda at: [at.angle((1, 2, -1), (3, -1, 2))],
    "linear": lambda at: [at.linear([1, -2, 3, 4, 5, -6, 7, 8, -9, 10, 11, 12, -13, 14, 15, 16])],
    "at-point": lambda at: [at.at_point((1, -2, 3))],
    "axis-distance": lambda at: [at.axis_distance((1, 2, 3), (2, -1, 1), (3, 1, -2))],
    **{
        f"on-line along {direction}": lambda at, direction=direction: [at.on_line(direction, (2, -1, 3))]  # type: ignore[misc]
        for direction in (
            (5, 1, 2),
            (1, 5, 2),
            (1, 2, 5),
            (0, 0, 1),
            (6, 0, 0),
            (-3, 3, 0),
            (-5, 2, 1),
            (1, -6, 2),
            (0, 3, -2),
            (2, 0, 1),
        )
    },
}
KINDS = {
    "spatial": PLACED,
    "planar": Pose((2, 0, 0, 1), (0, 3, 4, 0), (1, 2, 3)),
    "schoenflies": Pose((2, 0, 0, 1), (1, 3, 4, -2), (1, 2, 3)),
    "translation": Pose((1, 0, 0, 0), (0, 3, 4, 5), (1, 2, 3)),
    "spherical": Pose((2, 1, -1, 3), (0, 0, 0, 0), (1, 2, 3)),
}
LEGS = [((7, 1, 2), (1, 2, 0)), ((-3, 5, 1), (-2, 1, 1)), ((-6, -2, 3), (0, -3, 2)), ((1, -7, -2), (4, 4, 1))]
LEGS += [((2, 6, -4), (-3, 1, -1)), ((5, -3, 6), (3, -2, 5))]


def _legs(at: Pose, number: int) -> list[Constraint]:
    return [at.distance(*joints) for joints in LEGS[:number]]


def _types() -> Iterator[tuple[str, Case]]:
    for name, make in TYPES.items():
        yield (
            f"{name} and legs",
            (lambda make=make: listing("spatial", [PLACED], [*make(PLACED), *_legs(PLACED, 5)]), ACCEPTED),  # type: ignore[misc]
        )
        yield f"{name}, wrong", (partial(_moved, make), REJECTED)
    for kind, at in KINDS.items():
        number = {"spatial": 6, "schoenflies": 4}.get(kind, 3)
        if kind == "planar":
            number = 4
        yield f"{kind} motions", (partial(_of_kind, kind, at, number), ACCEPTED)


def _of_kind(kind: str, at: Pose, number: int) -> Content:
    return listing(kind, [at], _legs(at, number))


def _moved(make: Callable[[Pose], Sequence[Constraint]]) -> Content:
    """The constraint is that of another pose."""
    elsewhere = Pose((1, 0, 2, 0), (0, 3, 0, 1), (1, 2, 3))
    return listing("spatial", [PLACED], [*make(elsewhere), *_legs(PLACED, 5)])


# Claims that do not follow

CONCURRENT = "more legs than freedoms, a multiple solution"
"""A planar robot with one pose, a double one."""


def _of(name: str, *keys: str, **entries: Any) -> Content:
    """A certificate with other entries; those of ``keys`` are null."""
    return mechanism_content(name) | dict.fromkeys(keys) | entries


def _lacking(name: str, number: int, **entries: Any) -> Content:
    """A certificate without the solutions at the roots of one factor of the eliminant."""
    content = mechanism_content(name)
    factors = [
        factor for factor, _ in fmpz_poly([int(c, 16) for c in content["representation"]["eliminant"]]).factor()[1]
    ]
    found = without_factor(content, factors[number], 1)
    kept = {key: content[key] for key in ("claim", "completeness_route", "elimination")}
    return {key: (found | kept | entries)[key] for key in KEYS}


def _concurrent(total: int, multiplicity: int | None = None) -> Content:
    content = _of(CONCURRENT, **OPEN, complex_solutions=total)
    return content | {"poses": [{**pose, "multiplicity": multiplicity} for pose in content["poses"]]}


def _with_boxes(**entries: Any) -> Content:
    """Two poses in boxes beside a motion that was only detected."""
    return _of("parallelogram", "representation", "self_motion", **DETECTED) | entries


def _multiplicities(content: Content, *multiplicities: int | None) -> Content:
    poses = zip(content["poses"], multiplicities, strict=True)
    return content | {"poses": [{**pose, "multiplicity": multiplicity} for pose, multiplicity in poses]}


COUNTS = ("complex_solutions", "distinct_solutions", "real_poses")
MOVES = {"cause": "symmetry", "real": True, "forms": [], "slices": []}
CLAIMED: dict[str, Case] = {
    "boxes beside a motion that is detected": (_with_boxes, ACCEPTED),
    **{
        f"{key} {step} off, of boxes {beside}": (
            lambda key=key, step=step, make=make: (lambda c: c | {key: c[key] + step})(make()),  # type: ignore[misc]
            REJECTED,
        )
        for key in COUNTS
        for step in (1, -1)
        for beside, make in (
            ("beside a motion that is detected", _with_boxes),
            ("beside a motion that is proved", lambda: _of("parallelogram")),
            ("of an H4", lambda: _of("H4, boxes")),
        )
    },
    **{
        f"both counts {step} off, of boxes beside a motion that is {what}": (
            lambda step=step, make=make: (  # type: ignore[misc]
                lambda c: c | {key: c[key] + step for key in ("complex_solutions", "distinct_solutions")}
            )(make()),
            REJECTED,
        )
        for step in (1, -1)
        for what, make in (("detected", _with_boxes), ("proved", lambda: _of("parallelogram")))
    },
    "boxes by the method krawczyk beside a motion that is detected": (
        lambda: _with_boxes(method="krawczyk"),
        REJECTED,
    ),
    "complex boxes by the method krawczyk beside a motion that is detected, none counted": (
        lambda: _of(
            "planar lines, boxes", **DETECTED, completeness_route=None, complex_solutions=0, distinct_solutions=0
        ),
        REJECTED,
    ),
    "no boxes by the method krawczyk beside a motion that is proved in slices": (
        lambda: _of(
            "slices", **NOTHING, method="krawczyk", krawczyk={"chart": [1, 0, 0, 0], "real": [], "complex": []}
        ),
        REJECTED,
    ),
    "no boxes by the method krawczyk beside an elimination that leaves two monomials": (
        lambda: _of(
            "planar lines, boxes",
            claim="inconsistent",
            completeness_route="exact-elimination",
            elimination=[],
            complex_solutions=0,
            distinct_solutions=0,
            krawczyk={"chart": [1, 0, 0, 0], "real": [], "complex": []},
        ),
        REJECTED,
    ),
    **{
        f"{len(normals)} planes that hold a platform which turns about one axis, said to be alike along one": (
            lambda normals=normals: moving(  # type: ignore[misc]
                listing(
                    "schoenflies",
                    [KINDS["schoenflies"]],
                    [KINDS["schoenflies"].in_plane(n, (k, 2 - k, 2)) for k, n in enumerate(normals)],
                    None,
                ),
                "symmetry",
            ),
            said,
        )
        for normals, said in (
            (((1, 0, 0), (0, 1, 0)), ACCEPTED),
            (((1, 0, 0), (0, 1, 0), (0, 0, 1)), REJECTED),
        )
    },
    "points at infinity beside a motion that is detected": (
        lambda: _of(
            "contradictory leg",
            **DETECTED,
            completeness_route=None,
            infinity=mechanism_content("3-PSS+C, general")["infinity"],
        ),
        REJECTED,
    ),
    **{
        f"a motion of dependent constraints beside {key}": (
            lambda key=key: (  # type: ignore[misc]
                lambda c: c | {"self_motion": c["self_motion"] | {key: mechanism_content("slices")["self_motion"][key]}}
            )(_of("few legs")),
            REJECTED,
        )
        for key in ("forms", "slices")
    },
    **{
        f"multiplicities {here}, of boxes beside a motion that is {what}": (
            lambda here=here, make=make: _multiplicities(make(), *here),  # type: ignore[misc]
            REJECTED,
        )
        for here in ((2, 1), (1, 2), (0, 1), (1, 0), (None, 1), (1, None))
        for what, make in (("detected", _with_boxes), ("proved", lambda: _of("parallelogram")))
    },
    "boxes beside a motion that is detected, by a route": (
        lambda: _with_boxes(completeness_route="modular-rank"),
        REJECTED,
    ),
    "boxes beside a motion that is detected, and a representation": (
        lambda: _with_boxes(representation=mechanism_content("parallelogram")["representation"]),
        REJECTED,
    ),
    "boxes by the method exact, said to be incomplete": (lambda: _with_boxes(**OPEN), REJECTED),
    "boxes by the method exact, said to be complete": (lambda: _of("planar lines, boxes", method="exact"), REJECTED),
    "all poses in boxes beside a motion that is detected": (
        lambda: _of("planar lines, boxes", method="exact", completeness_route=None, **DETECTED),
        REJECTED,
    ),
    "the method krawczyk without boxes": (lambda: _of("planar lines", method="krawczyk"), REJECTED),
    "the method krawczyk without anything": (
        lambda: _of("contradictory leg", method="krawczyk", **OPEN),
        REJECTED,
    ),
    "the method krawczyk with boxes and a representation": (
        lambda: _of("planar lines, boxes", representation=mechanism_content("planar lines")["representation"]),
        REJECTED,
    ),
    "the method krawczyk and a motion": (lambda: _of("parallelogram", "representation", method="krawczyk"), REJECTED),
    **{
        f"nothing, said to be {claim} by no route": (
            lambda claim=claim: _of("contradictory leg", claim=claim, completeness_route=None),  # type: ignore[misc]
            REJECTED,
        )
        for claim in ("inconsistent", "complete", "positive-dimensional-proved")
    },
    "four of eight poses, a motion detected": (
        lambda: _lacking("cylinders", 0, **DETECTED, completeness_route=None, complex_solutions=4),
        REJECTED,
    ),
    "a motion beside poses": (lambda: _of("H4", self_motion=MOVES), REJECTED),
    "a motion beside nothing": (lambda: _of("contradictory leg", self_motion=MOVES), REJECTED),
    "a motion that is proved by nothing": (lambda: _of("few legs", "self_motion"), REJECTED),
    "poses without a representation": (
        lambda: _of(
            "contradictory leg", **{k: mechanism_content("H4")[k] for k in ("poses", "real_poses", "box_exponent")}
        ),
        REJECTED,
    ),
    "a grid without poses": (lambda: _of("contradictory leg", box_exponent=31), REJECTED),
    "a grid beside a motion": (lambda: _of("few legs", box_exponent=31), REJECTED),
    **{
        f"{key} beside {what}": (lambda key=key, name=name: _of(name, **{key: 1}), REJECTED)  # type: ignore[misc]
        for key in COUNTS
        for what, name in (("a motion", "few legs"), ("nothing", "contradictory leg"))
    },
    "nothing, said to be incomplete": (lambda: _of("contradictory leg", **OPEN), ACCEPTED),
    "nothing, a motion detected": (
        lambda: _of("contradictory leg", **DETECTED, completeness_route=None),
        ACCEPTED,
    ),
    **{
        f"nothing, {what}, with {key} 1": (
            lambda key=key, claim=claim: _of("contradictory leg", **claim, **{key: 1}),  # type: ignore[misc]
            REJECTED,
        )
        for key in COUNTS
        for what, claim in (
            ("said to be incomplete", OPEN),
            ("a motion detected", {**DETECTED, "completeness_route": None}),
        )
    },
    "nothing of a robot with poses, said to be inconsistent": (
        lambda: _of(
            "redundant leg", "representation", **NOTHING, claim="inconsistent", completeness_route="modular-rank"
        ),
        REJECTED,
    ),
    "nothing of a robot with poses, said to be inconsistent by an elimination": (
        lambda: _of(
            "H4",
            "representation",
            **NOTHING,
            claim="inconsistent",
            completeness_route="exact-elimination",
            elimination=[],
        ),
        REJECTED,
    ),
    "inconsistent by an elimination": (
        lambda: _of("contradictory leg", completeness_route="exact-elimination", elimination=[]),
        ACCEPTED,
    ),
    "inconsistent by an elimination with a step": (
        lambda: _of("contradictory leg", completeness_route="exact-elimination", elimination=[["0 0"]]),
        REJECTED,
    ),
    "inconsistent by an elimination with an empty step": (
        lambda: _of("contradictory leg", completeness_route="exact-elimination", elimination=[[]]),
        REJECTED,
    ),
    "poses said to be a motion that is detected": (
        lambda: _of("H4", **DETECTED, completeness_route=None),
        REJECTED,
    ),
    **{f"a double pose, {total} in all": (lambda total=total: _concurrent(total), ACCEPTED) for total in (1, 2, 6)},  # type: ignore[misc]
    **{f"a double pose, {total} in all": (lambda total=total: _concurrent(total), REJECTED) for total in (0, 7)},  # type: ignore[misc]
    **{
        f"a double pose, not proved, its multiplicity {m}": (lambda m=m: _concurrent(2, m), REJECTED)  # type: ignore[misc]
        for m in (1, 2)
    },
    **{
        f"four of eight poses, by {route}": (
            lambda route=route: _lacking("cylinders", 0, completeness_route=route, complex_solutions=4),  # type: ignore[misc]
            REJECTED,
        )
        for route in ("product-bound", "modular-rank", "refined-bezout")
    },
    "four of eight poses": (lambda: _lacking("cylinders", 0, **OPEN, complex_solutions=4), ACCEPTED),
    **{
        f"a pose left out of an elimination, {total} in all": (
            lambda total=total: _lacking("3-PSS+C", 0, complex_solutions=total),  # type: ignore[misc]
            REJECTED,
        )
        for total in (23, 24)
    },
    "poses left out beside points at infinity": (lambda: _lacking("3-RPS", 0, complex_solutions=8), REJECTED),
}


# Points at infinity

GENERAL = "3-PSS+C, general"


def _at_infinity(change: Callable[[Content], Content]) -> Content:
    content = mechanism_content(GENERAL)
    return content | {"infinity": content["infinity"] | change(content["infinity"])}


def _times(factor: int, *keys: str) -> Content:
    def rows(value: Any) -> Any:
        return [rows(entry) for entry in value] if isinstance(value, list) else hex(factor * int(value, 16))

    return _at_infinity(lambda infinity: {key: rows(infinity[key]) for key in keys})


def _longer(place: int) -> Content:
    """A coordinate of the points and a multiple of the eliminant, where w and c are 0."""

    def change(infinity: Content) -> Content:
        h = [int(c, 16) for c in infinity["eliminant"]]
        z = [[int(c, 16) for c in row] for row in infinity["coordinates"]]
        longer = [a + b for a, b in zip([*z[place], *[0] * (len(h) - len(z[place]))], h, strict=True)]
        rows = [longer if k == place else row for k, row in enumerate(z)]
        return {"coordinates": [[hex(c) for c in row] for row in rows]}

    return _at_infinity(change)


INFINITY: dict[str, Case] = {
    **{
        f"points at infinity, {' and '.join(keys)} times {factor}": (
            lambda factor=factor, keys=keys: _times(factor, *keys),  # type: ignore[misc]
            REJECTED,
        )
        for factor in (2, -1)
        for keys in (("eliminant", "coordinates"), ("eliminant",), ("coordinates",))
    },
    **{
        f"coordinate {place} has the degree of the eliminant": (partial(_longer, place), REJECTED)
        for place in range(16)
    },
    **{
        f"the {key} at infinity, {place}": (
            lambda key=key, place=place: _at_infinity(  # type: ignore[misc]
                lambda infinity: {key: [w + (n == place) for n, w in enumerate(infinity[key])]}
            ),
            REJECTED,
        )
        for key in ("chart", "separating_form")
        for place in (0, 3)
    },
}

MECHANISMS: dict[str, Case] = {**dict(_rewritten()), **dict(_types()), **CLAIMED, **INFINITY}

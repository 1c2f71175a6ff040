"""Certificates of version 2 around the numbers that motions give: bounds, forms that vanish, entries that are read."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import partial
from typing import Any

from forged_mechanisms import KINDS
from forged_motions import ANY, OTHERS
from held_mechanisms import PLACED, Content, Pose, listing, moving
from mechanism_certificates import mechanism_content

from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED, MALFORMED = "rejected", "accepted", "malformed"

# How many poses there are at most: few constraints leave a pose that is not regular, and its multiplicity open


def _legs(at: Pose, number: int) -> list[Constraint]:
    return [at.distance(a, b) for a, b in zip(ANY[:number], OTHERS, strict=False)]


def _planes(at: Pose, number: int) -> list[Constraint]:
    return [at.in_plane(n, b) for n, b in zip(OTHERS[1 : number + 1], ANY, strict=False)]


def _carried(at: Pose, number: int) -> list[Constraint]:
    return [at.carries(m, a) for m, a in zip(OTHERS[1 : number + 1], ANY, strict=False)]


def _cylinders(at: Pose, number: int) -> list[Constraint]:
    return [at.axis_distance(p, v, b) for p, v, b in zip(ANY[:number], OTHERS[1:], ANY[3:], strict=False)]


def _general(at: Pose, number: int, square: int = 0) -> list[Constraint]:
    """Forms with coefficients in no order; that of |C|^2 is given."""
    return [at.linear([square, *((7 * n + k * k * (n + 2)) % 11 - 5 for k in range(15))]) for n in range(1, number + 1)]


AXES = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
ORIGIN = (0, 0, 0)
BOUNDS: list[tuple[str, Callable[[Pose], list[Constraint]], int]] = [
    ("spatial", lambda at: _planes(at, 1), 8),
    ("spatial", lambda at: _planes(at, 5), 8),
    ("spatial", lambda at: _carried(at, 5), 8),
    ("spatial", lambda at: _legs(at, 1), 16),
    ("spatial", lambda at: _legs(at, 2), 32),
    ("spatial", lambda at: _legs(at, 3), 40),
    ("spatial", lambda at: [*_planes(at, 2), *_carried(at, 1)], 16),
    ("spatial", lambda at: [*_planes(at, 1), *_carried(at, 2)], 16),
    ("spatial", lambda at: [*_planes(at, 2), *_carried(at, 2)], 20),
    ("spatial", lambda at: [*_planes(at, 2), *_carried(at, 2), *_legs(at, 1)], 40),
    ("spatial", lambda at: [*_legs(at, 1), *_planes(at, 2), *_carried(at, 2)], 40),
    ("spatial", lambda at: [*_planes(at, 2), *_legs(at, 1), *_carried(at, 2)], 40),
    ("spatial", lambda at: _cylinders(at, 1), 16),
    ("spatial", lambda at: [*_cylinders(at, 1), *_carried(at, 1)], 32),
    ("spatial", lambda at: [*_cylinders(at, 1), *_carried(at, 3)], 40),
    ("spatial", lambda at: [*_cylinders(at, 1), *_carried(at, 2), *_legs(at, 1)], 80),
    ("planar", lambda at: _planes(at, 1), 2),
    ("planar", lambda at: _planes(at, 2), 2),
    ("planar", lambda at: _carried(at, 2), 2),
    ("planar", lambda at: _legs(at, 1), 4),
    ("planar", lambda at: _legs(at, 2), 6),
    ("planar", lambda at: _general(at, 2), 4),
    ("planar", lambda at: _general(at, 2, 1), 6),
    ("schoenflies", lambda at: _planes(at, 2), 2),
    ("schoenflies", lambda at: _carried(at, 2), 2),
    ("schoenflies", lambda at: _legs(at, 1), 4),
    ("schoenflies", lambda at: _legs(at, 3), 8),
    ("schoenflies", lambda at: _general(at, 3), 4),
    ("schoenflies", lambda at: _general(at, 3, 1), 8),
    ("translation", lambda at: _planes(at, 2), 1),
    ("translation", lambda at: _legs(at, 1), 2),
    ("translation", lambda at: _legs(at, 2), 2),
    ("spherical", lambda at: _legs(at, 2), 8),
    ("spherical", lambda at: _planes(at, 2), 8),
    ("spherical", lambda at: [at.angle((1, 2, 4), (3, 1, -1))], 8),
    ("translation", lambda at: _cylinders(at, 1), 2),
    ("translation", lambda at: _cylinders(at, 2), 4),
    ("schoenflies", lambda at: _cylinders(at, 1), 4),
    *(("spatial", lambda at, n=n: [at.carries(n, ANY[0]), *_planes(at, 3)], 16) for n in AXES),  # type: ignore[misc]
    *(("spatial", lambda at, n=n: [at.in_plane(n, ANY[0]), *_carried(at, 3)], 16) for n in AXES),  # type: ignore[misc]
    ("spatial", lambda at: [at.distance(ANY[0], ORIGIN), *_planes(at, 3)], 16),
    ("spatial", lambda at: [at.distance(ORIGIN, ANY[0]), *_carried(at, 3)], 16),
]
"""The last ones have one column alone of u, C or |C|^2 that counts."""


def _at_most(kind: str, make: Callable[[Pose], list[Constraint]], number: int) -> Content:
    """One pose of which ``number`` is said to be the multiplicity, though it is not proved."""
    at = KINDS[kind]
    return listing(kind, [at], make(at), None) | {"complex_solutions": number}


def _bounds() -> Iterator[tuple[str, Case]]:
    for place, (kind, make, most) in enumerate(BOUNDS):
        yield f"{most} poses at most, {kind} {place}", (partial(_at_most, kind, make, most), ACCEPTED)
        yield f"{most + 1} poses of {most}, {kind} {place}", (partial(_at_most, kind, make, most + 1), REJECTED)


# Forms that vanish on all motions of a kind

PLACES = {name: place for place, name in enumerate(("s", "u1", "u2", "u3", "c1", "c2", "c3"))}
PLACES |= {f"r{i}{j}": 7 + 3 * (i - 1) + j - 1 for i in (1, 2, 3) for j in (1, 2, 3)}
TURNING: list[dict[str, int]] = [{"r13": 1}, {"r23": 1}, {"r31": 1}, {"r32": 1}, {"r33": 1}, {"r11": 1, "r22": -1}]
TURNING += [{"r12": 1, "r21": 2}]
VANISHING: dict[str, list[dict[str, int]]] = {
    "planar": [*TURNING, {"u3": 1}, {"c3": 1}],
    "schoenflies": [*TURNING, {"u3": 1, "c3": -1}],
    "translation": [{name: 1} for name in PLACES if name[0] == "r"] + [{f"u{i}": 1, f"c{i}": -1} for i in (1, 2, 3)],
    "spherical": [{name: 1} for name in PLACES if name[0] != "r"],
}
"""In the metric (1, 2, 3), but for what is subtracted from some."""
DIMENSIONS = {"spatial": 6, "planar": 3, "schoenflies": 4, "translation": 3, "spherical": 3}


def _vanishing(kind: str, form: dict[str, int], factor: int) -> Content:
    """As many constraints as freedoms, but one is a form that vanishes anyway: the others let the platform move."""
    at = KINDS[kind]
    coefficients = [0] * 16
    for name, value in form.items():
        coefficients[PLACES[name]] = factor * value
    constraints = [*_legs(at, DIMENSIONS[kind] - 1), at.linear(coefficients)]
    return moving(listing(kind, [at], constraints, None), "dependent-forms")


def _not_vanishing(kind: str, name: str) -> Content:
    """The same with a coordinate that is not the same for all motions."""
    return _vanishing(kind, {name: 1}, 1)


def _vanishes() -> Iterator[tuple[str, Case]]:
    for kind, forms in VANISHING.items():
        for form in forms:
            said = " + ".join(f"{value} {name}" for name, value in form.items())
            yield f"{said} of {kind} motions", (partial(_vanishing, kind, form, 1), ACCEPTED)
    others = {
        "planar": "c1 u2 r11 r12 s",
        "schoenflies": "c3 u3 r22 r21",
        "translation": "c1 u2 c3 s",
        "spherical": "r11 r33",
    }
    for kind, names in others.items():
        for name in names.split():
            yield f"{name} of {kind} motions", (partial(_not_vanishing, kind, name), REJECTED)


# Nothing is symmetric where only a constant changes


def _everywhere(at: Pose, *, carried: bool) -> Content:
    """Planes in all directions, which moving along any of them leaves parallel, and fixed directions."""
    axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    planes: list[Constraint] = [
        at.carries(n, a) if carried else at.in_plane(n, a) for n, a in zip(axes, ANY, strict=False)
    ]
    fixed = [at.angle(n, m) for n, m in zip(OTHERS[:3], ANY, strict=False)]
    return moving(listing("spatial", [at], [*planes, *fixed], None), "symmetry")


def _beside_vanishing(place: int, form: dict[str, int]) -> Content:
    """Planar legs of one joint, and a form that vanishes added to that of one of them."""
    at = KINDS["planar"]
    legs: list[Constraint] = [at.distance(a, (2, 3, 0)) for a in ANY[:3]]
    coefficients = [Fraction(x) for x in legs[place].forms(at.metric)[0][:16]]
    for name, value in form.items():
        coefficients[PLACES[name]] += 5 * value
    legs[place] = at.linear(coefficients)
    return moving(listing("planar", [at], legs, None), "symmetry")


SYMMETRIC: dict[str, Case] = {
    "planes in all directions": (partial(_everywhere, PLACED, carried=False), REJECTED),
    "planes of the platform in all directions": (partial(_everywhere, PLACED, carried=True), REJECTED),
    **{
        f"planar legs of one joint, leg {place + 1} with {' '.join(form)}": (
            partial(_beside_vanishing, place, form),
            ACCEPTED,
        )
        for place in (0, 1, 2)
        for form in VANISHING["planar"]
    },
}


# What is read


def _read(**entries: Any) -> Content:
    return mechanism_content("H4") | entries


def _robot(**entries: Any) -> Content:
    content = mechanism_content("H4")
    return content | {"robot": content["robot"] | entries}


def _many(number: int) -> Content:
    """The same constraint again and again."""
    legs = mechanism_content("H4")["robot"]["constraints"]
    return _robot(constraints=[*legs, *[legs[0]] * (number - len(legs))])


def _constraint(**entries: Any) -> Content:
    first, *others = mechanism_content("H4")["robot"]["constraints"]
    return _robot(constraints=[first | entries, *others])


def _form_off(step: int) -> Content:
    form = mechanism_content("H4")["robot"]["constraints"][0]["forms"][0]
    return _constraint(forms=[[*form[:-1], str(Fraction(form[-1]) + step)]])


def _long(digits: int) -> Content:
    """A leg whose form has a constant with so many digits below; no pose has its length."""
    a, b, c = 10**599 + 1, 10**598 + 3, 10**597 + 9
    rest = digits - len(str((a * b * c) ** 2))
    joints = (
        (Fraction(1, a), Fraction(1, b), Fraction(1, c)),
        (Fraction(1, 10 ** (rest // 2)), Fraction(0), Fraction(0)),
    )
    leg = Distance(*joints, Fraction(1, 97 if rest % 2 else 1))
    metric = tuple(int(g) for g in mechanism_content("H4")["robot"]["metric"])
    return _constraint(**{k: v for k, v in constraint_entry(leg, metric).items() if k != "name"})  # type: ignore[arg-type]


def _of_lines(path: str, value: Any) -> Content:
    """Planes of the plane, with another entry of the first one."""
    content = mechanism_content("planar lines")
    first, *others = content["robot"]["constraints"]
    return content | {"robot": content["robot"] | {"constraints": [first | {path: value}, *others]}}


READ: dict[str, Case] = {
    "a name of the configuration": (partial(_read, configuration="another"), ACCEPTED),
    "no name of the configuration": (partial(_read, configuration=None), ACCEPTED),
    **{
        f"{key} is {value!r}": (partial(_read, **{key: value}), MALFORMED)
        for key, value in (
            *(("configuration", 5), ("configuration", ["home"]), ("formulation", "SE9"), ("formulation", 5)),
            *(("notes", [5]), ("notes", "a note"), ("notes", None), ("self_motion", 5), ("infinity", [])),
            *(("method", "newton"), ("box_exponent", -1)),
        )
    },
    **{
        f"{key} of the robot is {value!r}": (partial(_robot, **{key: value}), MALFORMED)
        for key, value in (
            *(("name", 5), ("unit", None), ("source", ["x"]), ("motion", "free"), ("motion", None)),
            *(("metric", ["1", "1"]), ("metric", ["1", "1/2", "1"]), ("metric", ["1/2", "1", "1"])),
            *(("metric", ["1", "1", "1/2"]), ("metric", ["1", "0", "1"]), ("constraints", []), ("constraints", {})),
            ("constraints", [5]),
        )
    },
    **{
        f"{key} of a constraint is {value!r}": (partial(_constraint, **{key: value}), MALFORMED)
        for key, value in (
            *(("name", 5), ("type", "screw"), ("type", None), ("length_squared", "0"), ("length_squared", "-1")),
            *(("base", ["0", "0"]), ("platform", None)),
        )
    },
    "a plane without a normal": (partial(_of_lines, "normal", ["0", "0", "0"]), MALFORMED),
    "64 constraints": (partial(_many, 64), ACCEPTED),
    "65 constraints": (partial(_many, 65), MALFORMED),
    "too fine a grid": (partial(_read, box_exponent=8193), "too-large"),
    "forms that are missing": (partial(_constraint, forms=[]), REJECTED),
    **{f"a form with {step} more of 1": (partial(_form_off, step), REJECTED) for step in (1, -1)},
    **{
        f"a form of {digits} digits": (partial(_long, digits), status)
        for digits, status in ((4000, REJECTED), (4001, "too-large"))
    },
    **{
        f"real is {value!r}": (
            lambda value=value: (lambda c: c | {"self_motion": c["self_motion"] | {"real": value}})(  # type: ignore[misc]
                mechanism_content("few legs")
            ),
            MALFORMED,
        )
        for value in (1, 0, None, "true")
    },
}


def _boxes_of(robot: str) -> Content:
    return mechanism_content("H4, boxes") | {"robot": mechanism_content(robot)["robot"]}


def _regular(kind: str, constraints: Callable[[Pose], list[Constraint]]) -> Content:
    at = KINDS[kind]
    claim = {"claim": "complete", "completeness_route": "product-bound"} if kind == "translation" else {}
    return listing(kind, [at], constraints(at)) | claim


REGULAR: dict[str, Case] = {
    "a translation held by three planes": (partial(_regular, "translation", lambda at: _planes(at, 3)), ACCEPTED),
    "a translation held by planes along the axes": (
        partial(_regular, "translation", lambda at: [at.in_plane(n, ANY[0]) for n in AXES]),
        ACCEPTED,
    ),
    **{
        f"turns held by angles, between axes {i + 1} and {j + 1} one of them": (
            partial(
                _regular,
                "spherical",
                lambda at, i=i, j=j: [
                    at.angle(AXES[i], AXES[j]),
                    *(at.angle(n, m) for n, m in zip(OTHERS[:2], ANY, strict=False)),
                ],
            ),
            ACCEPTED,
        )
        for i in range(3)
        for j in range(3)
    },
}

BOXES: dict[str, Case] = {
    "boxes of a robot with a leg too many": (partial(_boxes_of, "contradictory leg"), REJECTED),
    "boxes of a robot with a redundant leg": (partial(_boxes_of, "redundant leg"), ACCEPTED),
    "boxes of a robot with a leg too few": (partial(_boxes_of, "few legs"), REJECTED),
}

NUMBERS: dict[str, Case] = {**dict(_bounds()), **dict(_vanishes()), **SYMMETRIC, **READ, **REGULAR, **BOXES}

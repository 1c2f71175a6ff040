"""Certificates at the margins of what a checker computes: enclosures, isolation, bounds, single coordinates."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from math import ceil, floor, isqrt
from typing import Any

from certificate_subjects import Content, subject
from flint import fmpq_poly, fmpz_poly
from forged_mechanisms import as_version_2
from forged_neighbours import ANY, TURNED, _circle, _near, _turned, witness_of
from forged_poses import held, single
from forged_representations import fit_real_poses, representation_through, set_representation, sliding
from forgeries import DETECTED, TRIANGLE, UNTURNED, on_circle
from held_mechanisms import PLACED, Numbers, Pose, listing, moving

from pkm_exact.certify import pure
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.linear import LinearForm

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"


# Isolation of roots

T = fmpz_poly([0, 1])
ROOTS: dict[str, Case] = {
    "roots 2, 6 and -4, and some between 0 and 1": (
        lambda: _turned((T - 2) * (T - 6) * (T + 4) * (2 * T - 1) * (3 * T - 1) * (3 * T - 2)),
        ACCEPTED,
    ),
    "a root 1/3": (lambda: _turned(3 * T - 1), ACCEPTED),
    "a root 6": (lambda: _turned(T - 6), ACCEPTED),
    "a root 3/8": (lambda: _turned(8 * T - 3), ACCEPTED),
    "roots between which the polynomial is 1 at 0": (lambda: _turned(T * T - 3 * T + 1), ACCEPTED),
    "roots beside which four times the polynomial is 1 at 1/2": (lambda: _turned(T * T + 2 * T - 1), ACCEPTED),
    "a root 1 / (2^127 - 1)": (
        lambda: as_version_2(on_circle([(Fraction(1, (1 << 127) - 1), Fraction(1))], (0, 1, 0))),
        ACCEPTED,
    ),
    "roots 3 and 3 + 2^-32": (lambda: _turned((T - 3) * ((1 << 32) * T - (3 << 32) - 1)), ACCEPTED),
    "a root 2^-40": (lambda: _turned((1 << 40) * T - 1), ACCEPTED),
    "roots 2^-40, -2^-40 and 5": (lambda: _turned(((1 << 80) * T * T - 1) * (T - 5)), ACCEPTED),
    "parameters that differ by 2^-600, the poses much": (
        lambda: _circle(
            _near(Fraction(1, 3), 700),
            (lambda p: (p[0], -p[1]))(_near(Fraction(1, 3) + Fraction(1, 1 << 600), 700)),
        ),
        ACCEPTED,
    ),
}


# Cells of coordinates

UNIT = Fraction(1, 1 << 32)
"""The distance from a grid point up to which a coordinate counts as that point, in units of the grid."""


def _oblong(x: Fraction, exponent: int) -> Content:
    """An unturned pose at (x, 1) of a planar robot with the metric (3, 1, 1): its first coordinate is sqrt(3) x."""
    content = subject("planar, multiple solutions")
    robot = {**content["robot"], "metric": ["3", "1", "1"], "base": TRIANGLE, "platform": TRIANGLE}
    content = {**content, "robot": robot, "box_exponent": exponent}
    content["configuration"] = {"name": None, "lengths_squared": [str(3 * x * x + 1)] * 3}
    # f_i = g_i C_i
    points = [(UNTURNED, (Fraction(0), 3 * x, Fraction(1), Fraction(0)))]
    set_representation(content, representation_through([Fraction(0)], points), (0,) * 8)
    fit_real_poses(content, None)
    return content


def _root_of_3(bits: int) -> Fraction:
    return Fraction(isqrt(3 << 2 * bits), 1 << bits)


def _beside(sign: int, side: int) -> Content:
    """sqrt(3) x is 2^20 + 3/4 and ``sign`` 2^-32 units of the grid 1/4, and on this side of that by 2^-245 or so."""
    value = (1 << 20) + (3 + sign * UNIT) / 4
    x = value / _root_of_3(400) + Fraction(side, 1 << 245)
    return _oblong(x, 2)


def _half_turned(sign: int, side: int) -> Content:
    """A platform held in a point, turned about the third axis: q0 = 1 / sqrt(1 + v^2) is nearly 3/4 + 2^-34."""
    value = (3 + sign * UNIT) / 4
    square = 1 / value**2 - 1
    root = Fraction(isqrt((square.numerator << 800) // square.denominator), 1 << 400)
    h, v = fmpq_poly([0, 1]), root + Fraction(side, 1 << 265)
    content = held(
        h, (1, 0, 0, 0), [fmpq_poly([1]), fmpq_poly(), fmpq_poly(), fmpq_poly()], [fmpq_poly()] * 4, (0,) * 8
    )
    content = single(content, (1, 0, 0, v), (0, 0, 0, 0))
    content["box_exponent"] = 2
    content["poses"] = []
    fit_real_poses(content, 1)
    return {**content, "poses": [{**pose, "multiplicity": None} for pose in content["poses"]]}


def _held_poses(points: Sequence[Numbers], exponent: int) -> Content:
    """A platform held in a point, in some orientations; the parameter is e1 / e0, and grows in this order."""
    content = held(fmpq_poly([0, 1]), (1, 0, 0, 0), [fmpq_poly([1])] + [fmpq_poly()] * 3, [fmpq_poly()] * 4, (0,) * 8)
    scaled = [[Fraction(x) / Fraction(e[0]) for x in e] for e in points]
    rows = representation_through([e[1] for e in scaled], [(e, [Fraction(0)] * 4) for e in scaled])
    set_representation(content, rows, (0, 1, 0, 0, 0, 0, 0, 0))
    content = {**content, "box_exponent": exponent, "poses": []}
    fit_real_poses(content, None)
    return content


ALIKE = (1000, -660, 708, -257), (1000, -706, 759, -268)
"""Orientations of which r33 alone differs, on the grid 1/16: 1 unit and more, and less than 0."""
CELLS: dict[str, Case] = {
    **{
        f"a coordinate at {sign} 2^-32 from a grid point": (
            lambda sign=sign: on_circle(  # type: ignore[misc]
                [(Fraction(1, 2) + sign * UNIT / 4, Fraction(1))], (0, 1, 0), 2
            ),
            ACCEPTED,
        )
        for sign in (1, -1)
    },
    **{
        f"{name}, {sign} 2^-32 from a grid point and on side {side}": (partial(make, sign, side), ACCEPTED)
        for name, make in (("a position that is no rational", _beside), ("a quaternion that is not", _half_turned))
        for sign in (1, -1)
        for side in (1, -1)
    },
    "orientations that differ in r33 alone": (partial(_held_poses, ALIKE, 4), ACCEPTED),
    "positions that differ in C1 alone": (
        lambda: _circle((Fraction(3, 5), Fraction(4, 5)), (Fraction(-3, 5), Fraction(4, 5)), form=(0, 5, 0)),
        ACCEPTED,
    ),
}


# Robots through two poses, and bounds of their numbers


def leg_through(poses: Sequence[Pose], platform: Numbers, base: Numbers, axis: int = 0) -> Distance:
    """A leg of the same length at two poses: one coordinate of its base joint follows."""
    one, other = (pose.image(platform) for pose in poses)
    g, joint = poses[0].metric, [Fraction(x) for x in base]
    difference = [x - y for x, y in zip(one, other, strict=True)]
    right = (poses[0].product(one, one) - poses[0].product(other, other)) / 2
    right -= sum((g[k] * joint[k] * difference[k] for k in range(3) if k != axis), Fraction(0))
    joint[axis] = right / (g[axis] * difference[axis])
    return poses[0].distance(joint, platform)


def _two(metric: tuple[int, int, int] = (1, 1, 1)) -> list[Pose]:
    return [Pose((1, 0, 0, 0), (0, 0, 3, 0), metric), Pose((1, 0, 0, 2), (0, 1, 2, 0), metric)]


PLATFORMS, BASES = ((1, 2, 0), (-3, 1, 0), (2, -5, 0)), ((0, 7, 0), (0, -4, 0), (0, 3, 0))


def _through(metric: tuple[int, int, int], far: int, version: int) -> Content:
    """Three planar legs through two poses; the base joint of one of them is far away."""
    poses = _two(metric)
    joints = zip(PLATFORMS, (*BASES[:2], (0, far, 0)), strict=True)
    legs = [leg_through(poses, b, a) for b, a in joints]
    content = listing("planar", poses, legs, None)
    return content if version == 2 else in_version_1(content, legs)


def in_version_1(content: Content, legs: Sequence[Distance]) -> Content:
    """A certificate of legs in version 1."""
    old = subject("planar, multiple solutions" if len(legs) == 3 else "not proven complete")
    joints = {
        "base": [[str(x) for x in leg.base] for leg in legs],
        "platform": [[str(x) for x in leg.platform] for leg in legs],
    }
    robot = {**old["robot"], "metric": content["robot"]["metric"], **joints}
    squares = [str(leg.length_squared) for leg in legs]
    whole = {**content, "version": 1, "robot": robot, "configuration": {"name": None, "lengths_squared": squares}}
    return {key: whole[key] for key in old if key != "digest"}


BOUNDS: dict[str, Case] = {
    f"{name}, version {version}": (
        lambda metric=metric, far=far, version=version: _simple(_through(metric, far, version)),  # type: ignore[misc]
        ACCEPTED,
    )
    for version in (1, 2)
    for name, metric, far in (
        ("legs through two poses", (1, 1, 1), 3),
        ("legs through two poses, one of them far away", (1, 1, 1), 10**200),
        ("legs through two poses in a large metric", (10**60, 1, 1), 3),
        ("legs through two poses in a metric large along the second axis", (1, 10**60, 1), 3),
    )
}


def _simple(content: Content) -> Content:
    """All multiplicities are 1: the poses are simple."""
    return {**content, "poses": [{**pose, "multiplicity": 1} for pose in content["poses"]]}


# A form that is a multiple of the eliminant but for a high power of the parameter


def _but_for_a_power(power: int, sign: int) -> Content:
    """Complex poses in a line, at which a linear form is t^power / h'(t)^2 up to a factor, which is not 0."""
    h = fmpq_poly([36, 0, 49, 0, 14, 0, 1])  # (t^2 + 1) (t^2 + 4) (t^2 + 9)
    t, slope = fmpq_poly([0, 1]), h.derivative()
    _, inverse, _ = slope.xgcd(h)
    rest = (t**power * inverse) % h
    factor = sign * rest.denom()
    poses = [Pose((1, 0, 0, 0), (0, 0, n, 0)) for n in range(2)]
    content = listing("translation", poses, [LinearForm((*([0] * 4), 1, *([0] * 11), -2))], None)  # type: ignore[arg-type]
    rows = [h, slope, *[fmpq_poly()] * 4, factor * rest + 2 * slope, t * slope - 6 * h, fmpq_poly()]
    set_representation(content, rows, (0, 0, 0, 0, 0, 0, 1, 0))
    return {**content, "poses": [], "real_poses": 0, "box_exponent": 0}


POWERS: dict[str, Case] = {
    f"a form that is {sign} t^{power}": (partial(_but_for_a_power, power, sign), REJECTED)
    for power in (6, 8, 9, 10)
    for sign in (1, -1)
}


# Boxes that differ in one coordinate alone


def boxed(
    poses: Sequence[Pose],
    chart: Sequence[int],
    bits: int = 24,
    to_grid: Callable[[Fraction], int] = round,
    legs: Sequence[Distance] = (),
    exponent: int = 31,
) -> Content:
    """Boxes around the poses of a robot with these legs, or of a planar one with legs through both."""
    legs = legs or [leg_through(poses, b, a) for b, a in zip(PLATFORMS, BASES, strict=True)]
    content = in_version_1(subject("nothing known") | {"robot": {"metric": ["1", "1", "1"]}}, legs)
    scale = next(k for k in range(4) if chart[k])
    real = []
    for pose in poses:
        x = [Fraction(v) / Fraction(pose.e[scale]) for v in (*pose.e, *pose.f)]
        real.append({"exponents": [bits, bits], "centre": [hex(to_grid(v * (1 << bits))) for v in x]})
    content["krawczyk"] = {"chart": list(chart), "real": real, "complex": []}
    metric, base, platform = pure.a_robot(content["robot"], "robot")
    read = tuple(map(pure.Leg, base, platform, pure.a_configuration(content["configuration"], len(legs))))
    boxes = pure.a_list_of_boxes(content["krawczyk"], "krawczyk")
    system = pure.chart_system(read, metric, boxes.w)
    listed = []
    for box, entry in zip(boxes.real, real, strict=True):
        cells = pure.cells_of(partial(pure.at_solution, system, metric, system.restricted(box)), exponent)
        listed.append((cells, entry))
    listed.sort(key=lambda pair: pair[0])
    content["krawczyk"]["real"] = [entry for _, entry in listed]
    content["poses"] = [_pose([list(pure.ends(a, b, exponent)) for a, b in cells]) for cells, _ in listed]
    counts = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses"), len(real))
    return {**content, **counts, "box_exponent": exponent, "method": "krawczyk"}


def _pose(ends: list[Any]) -> Content:
    return {
        "parameter": None,
        "position": ends[:3],
        "rotation": [ends[3:6], ends[6:9], ends[9:12]],
        "quaternion": ends[12:],
        "multiplicity": 1,
    }


def off(coordinate: str, parts: Fraction, sign: int) -> Content:
    """A centre beside the nearest grid point: the solution is 1/2 + ``parts`` 2^-20 units away from it."""
    distance = sign * (Fraction(1, 2) + parts / (1 << 20)) / (1 << 24)
    to_grid = floor if sign > 0 else ceil
    if coordinate == "e0":
        e = (1 + distance) * 2
        return boxed([Pose((e, 0, 0, 2), (0, 4, 6, 0)), Pose((6, 0, 0, 2), (0, 4, 6, 0))], (0, 0, 0, 1), 24, to_grid)
    poses = [Pose((2, 0, 0, 1), (0, 1, 2 * (3 + distance), 0)), Pose((2, 0, 0, 1), (0, 1, 14, 0))]
    return boxed(poses, (1, 0, 0, 0), 24, to_grid)


SINGLE: dict[str, Case] = {
    **{
        f"{coordinate} is {sign} (1/2 + {parts} 2^-20) units from the centre": (
            partial(off, coordinate, parts, sign),
            status,
        )
        for coordinate in ("e0", "f2")
        for sign in (1, -1)
        for parts, status in (
            (Fraction(3, 4), ACCEPTED),
            (Fraction(3, 2), REJECTED),
            (Fraction(1 << 18), REJECTED),
        )
    },
    "boxes that differ in e0 alone": (
        lambda: boxed([Pose((1, 0, 0, 2), (0, 4, 6, 0)), Pose((3, 0, 0, 2), (0, 4, 6, 0))], (0, 0, 0, 1)),
        ACCEPTED,
    ),
    "boxes that differ in f2 alone": (
        lambda: boxed([Pose((2, 0, 0, 1), (0, 1, 3, 0)), Pose((2, 0, 0, 1), (0, 1, 7, 0))], (1, 0, 0, 0)),
        ACCEPTED,
    ),
}

# Legs that are one modulo a prime


def _alike(number: int, first: int, second: int) -> Content:
    """Legs of which two agree modulo 2^127 - 1, said to be dependent; the form of one of them begins with 0."""
    p = (1 << 127) - 1
    pose = Pose((1, 0, 0, 0), (0, 2, 0, 0))
    flat = number == 3
    base, platform = ([(x, y, 0 if flat else z) for x, y, z in side[:number]] for side in (ANY, (*ANY[1:], (3, 1, 4))))
    base[first], platform[first] = (0, 0, 0), (-1, 3, 0 if flat else 5)
    base[second], platform[second] = (p, 2 * p, 0), (2 * p - 1, 3 - p, 0 if flat else 5)
    return witness_of(pose, base, platform)


MODULO: dict[str, Case] = {
    f"{number} legs, {first + 1} and {second + 1} are one modulo a prime": (
        partial(_alike, number, first, second),
        REJECTED,
    )
    for number in (3, 6)
    for first, second in ((0, number - 1), (number - 1, 0), (1, 0))
}

# As many poses of a moving robot as there can be isolated ones, and motions that two arguments prove


def _complete(content: Content, route: str) -> Content:
    return _simple(content) | {"claim": "complete", "completeness_route": route}


TRIPLES = ((3, 4, 5), (5, 12, 13), (8, 15, 17))
POINTS = [(Fraction(x, r), Fraction(y, r)) for a, b, r in TRIPLES for x, y in ((a, b), (b, a))]


def _on_circle(number: int) -> Content:
    return as_version_2(on_circle(POINTS[:number], (0, 1, 0)))


MOVING: dict[str, Case] = {
    "forty poses on a sphere, said to be all": (lambda: _complete(sliding(40), "refined-bezout"), REJECTED),
    **{
        f"six poses on a circle, said to be all by {route}": (
            lambda route=route: _complete(_on_circle(6), route),  # type: ignore[misc]
            REJECTED,
        )
        for route in ("refined-bezout", "product-bound", "modular-rank")
    },
    "all poses in boxes, and a motion": (
        lambda: subject("planar, boxes") | {"method": "exact", "completeness_route": None, **DETECTED},
        REJECTED,
    ),
    "joints in a point, and two legs are one": (
        lambda: witness_of(TURNED["a general pose"], [(1, 2, 0), (1, 2, 0), (5, -3, 0)], [(3, 1, 0)] * 3),
        ACCEPTED,
    ),
    "joints on a line, and two legs are one": (
        lambda: witness_of(PLACED, [*ANY[:5], ANY[0]], [(n, 2 * n, 3 * n) for n in (1, 2, 4, 7, 9, 1)]),
        ACCEPTED,
    ),
    "joints on a line but for the second": (
        lambda: witness_of(PLACED, ANY[:6], [(n, 2 * n, 3 * n + int(n == 2)) for n in (1, 2, 4, 7, 9, 5)]),
        REJECTED,
    ),
}

# Poses where constraints touch, and slices of a mechanism with few of them


def _touching(constraints: Callable[[Pose], list[Constraint]]) -> Content:
    """One pose of a translation, at which two constraints have parallel gradients; its multiplicity is not proved."""
    at = Pose((1, 0, 0, 0), (0, 1, 0, 5))
    return listing("translation", [at], constraints(at), None)


def _few_in_slices() -> Content:
    """A planar leg lets the platform move; five poses in slices, none of them held there."""
    poses = [Pose((1, 0, 0, 0), (0, x, y, 0)) for x, y in sorted(POINTS)]
    legs = [poses[0].distance((0, 0, 0), (0, 0, 0))]
    form = [0] * 17
    form[4] = 1
    slices = [
        {"constant": str(pose.f[1]), "representation": listing("planar", [pose], legs, None)["representation"]}
        for pose in poses
    ]
    content = moving(listing("planar", poses[:1], legs, None), "more-poses-than-bound", real=False)
    motion = content["self_motion"] | {"forms": [[str(c) for c in form]], "slices": slices}
    return content | {"representation": None, "self_motion": motion}


def _in_planes(**entries: Any) -> Content:
    """A translation held by three planes: one pose, and no unknown is left in its section."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 5))
    planes = [at.in_plane(n, (1, 1, 2)) for n in ((1, 0, 2), (0, 1, 1), (3, 1, 1))]
    return listing("translation", [at], planes) | entries


NO_POSE: Content = {
    **dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses", "box_exponent"), 0),
    "representation": None,
    "poses": [],
    "claim": "inconsistent",
}
TOUCHING: dict[str, Case] = {
    "three planes and a pose": (
        lambda: _in_planes(claim="complete", completeness_route="product-bound"),
        ACCEPTED,
    ),
    **{
        f"three planes and a pose, by the elimination {steps}": (
            lambda steps=steps: _in_planes(  # type: ignore[misc]
                claim="complete", completeness_route="exact-elimination", elimination=steps
            ),
            ACCEPTED,
        )
        for steps in ([], [[]])
    },
    "three planes, said to have no pose": (
        lambda: _in_planes(**NO_POSE, completeness_route="modular-rank"),
        REJECTED,
    ),
    "three planes, said to have no pose by an elimination": (
        lambda: _in_planes(**NO_POSE, completeness_route="exact-elimination", elimination=[]),
        REJECTED,
    ),
    "two spheres that touch": (
        lambda: _touching(
            lambda at: [
                at.distance((2, 4, 4), (0, 1, 2)),
                at.distance((0, -2, 10), (0, 1, 2)),
                at.in_plane((1, 2, 5), (1, 1, 1)),
            ]
        ),
        ACCEPTED,
    ),
    "two cylinders that touch": (
        lambda: _touching(
            lambda at: [
                at.axis_distance((0, 0, 1), (0, 0, 2), (0, 0, 0)),
                at.axis_distance((3, 0, 2), (0, 0, 1), (0, 0, 0)),
                at.in_plane((0, 1, 0), (0, 0, 0)),
            ]
        ),
        ACCEPTED,
    ),
    "poses in slices that are not held there": (_few_in_slices, ACCEPTED),
    "poses in slices that are not held there, said to move": (
        lambda: (lambda c: c | {"self_motion": c["self_motion"] | {"real": True}})(_few_in_slices()),
        REJECTED,
    ),
}

MARGINS: dict[str, Case] = {**ROOTS, **CELLS, **BOUNDS, **POWERS, **SINGLE, **MODULO, **MOVING, **TOUCHING}


# What is larger than Python writes


def huge() -> Content:
    """A position of 2^6200 on the grid 2^-7900, by three forms that are multiplied from one to the next."""
    factor = 10**622
    share = Fraction(1, 10**311)
    pose = Pose((1, 0, 0, 0), (0, factor, factor**2, factor**3))
    forms = []
    for place in (4, 5, 6):
        coefficients = [0] * 16
        coefficients[place] = share
        if place > 4:
            coefficients[place - 1] = -factor * share
        forms.append(pose.linear(coefficients))
    content = listing("translation", [pose], forms, None)
    content = {**content, "box_exponent": 7900, "poses": []}
    fit_real_poses(content, 1)
    return content

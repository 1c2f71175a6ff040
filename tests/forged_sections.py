"""Certificates of mechanisms with cylinders in their sections, points at infinity, slices, and unlucky primes."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import prod
from typing import Any

from certificate_subjects import Content
from flint import fmpz_poly
from forged_margins import ACCEPTED, NO_POSE, REJECTED, Case
from held_mechanisms import Numbers, Pose, listing, moving
from mechanism_certificates import made, mechanism_content
from mechanisms import vector

from pkm_exact.certify import pure
from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.certify.checker.solutions import primes_for
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SPHERICAL


def _without_pose(kind: str, constraints: Callable[[Pose], list[Constraint]]) -> Content:
    """Constraints that no pose is to have, by an elimination without steps."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 5))
    return listing(kind, [at], constraints(at), None) | NO_POSE | EMPTY_ELIMINATION


EMPTY_ELIMINATION: Content = {"completeness_route": "exact-elimination", "elimination": []}


def _along_an_axis(at: Pose, wider: int) -> list[Constraint]:
    """Planes keep a point on a line that is parallel to the axis of a cylinder."""
    point, axis = (1, 1, 2), (1, 2, 2)
    cylinder = at.axis_distance((3, 1, 2), axis, point)
    around = replace(cylinder, radius_squared=cylinder.radius_squared + wider)
    return [at.in_plane((2, -1, 0), point), at.in_plane((0, 1, -1), point), around]


SPHERE, LEVEL, UPRIGHT = ([int(k == place) for k in range(16)] for place in (0, 4, 6))
"""|C|^2, C1 and C3."""


def _circle_in_slices(
    points: Sequence[tuple[int, int]], forms: Sequence[Numbers], planes: Sequence[Numbers], *, real: bool
) -> Content:
    """Poses of a translation with C3 = 0, the first of them with |C| = 5, in slices of constant C1."""
    poses = [Pose((1, 0, 0, 0), (0, x, y, 0)) for x, y in points]
    constraints = [poses[0].linear(plane) for plane in planes]
    slices = [
        {
            "constant": str(pose.quantities()[0][0]),
            "representation": listing("translation", [pose], constraints, None)["representation"],
        }
        for pose in poses
    ]
    square = poses[0].distance((0, 0, 0), (0, 0, 0)).length_squared
    spelled = [[*map(str, form), str(-square * form[0])] for form in forms]
    content = moving(listing("translation", poses[:1], constraints, None), "more-poses-than-bound", real=real)
    motion = content["self_motion"] | {"forms": spelled, "slices": slices}
    return content | {"representation": None, "self_motion": motion}


def _complex_sphere(*, real: bool) -> Content:
    """A leg lets a platform move that is not turned; it is shown with C = (i, 3, 0) and its conjugate."""
    at = Pose((1, 0, 0, 0), (0, 2, 2, 0))
    content = listing("translation", [at], [at.distance((0, 0, 0), (0, 0, 0))], None)
    content["representation"] = {
        "chart": [1, 0, 0, 0],
        "separating_form": [0, 0, 0, 0, 0, 1, 0, 0],
        "eliminant": ["0x1", "0x0", "0x1"],
        "quaternion": [["0x0", "0x2"], [], [], []],
        "translation": [[], ["-0x2"], ["0x0", "0x6"], []],
    }
    return moving(content, "dependent-forms", real=real)


def _nearly_dependent(**entries: Any) -> Content:
    """Three planes whose normals are dependent modulo all primes that either checker tries."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 5))
    p = prod({*primes_for(fmpz_poly([0, 1])), *pure.good_primes([0, 1])})
    planes = [at.in_plane(n, (1, 1, 2)) for n in ((1, 0, 0), (0, 1, 0), (1, 1, p))]
    return listing("translation", [at], planes) | entries


def _planar_infinity(**entries: Any) -> Content:
    """A double pose of a planar robot, and two points at infinity that would count twice on spatial motions."""
    at = Pose((1, 0, 0, 0), (0, 1, 0, 0))
    legs = [at.distance((a, 0, 0), (b, 0, 0)) for a, b in ((0, 0), (5, 3), (11, 1))]
    coordinates: list[list[str]] = [[] for _ in range(16)]
    coordinates[5], coordinates[6] = ["0x0", "0x2"], ["-0x2"]  # C = (0, 1, t), t^2 + 1 = 0
    chart, form = ([int(k == place) for k in range(16)] for place in (5, 6))
    infinity = {"chart": chart, "separating_form": form, "eliminant": ["0x1", "0x0", "0x1"]}
    return listing("planar", [at], legs, 2, 2) | {
        "claim": "complete",
        "completeness_route": "counting-at-infinity",
        "infinity": infinity | {"coordinates": coordinates, "multiplicity": 4} | entries,
    }


def _forty_with_planar_infinity() -> Content:
    """Four of the six poses of a planar robot with joints on lines, and 18 points that would count 36 times.

    C = (0, 1, i) and u = k C, and their conjugates, where T = i + k, for k = 1, .., 9.
    """
    poses = [Pose((a, 0, 0, s * b), (0, c, s * d, 0)) for a, b, c, d in ((2, 1, 1, 2), (1, 2, 2, -1)) for s in (1, -1)]
    one, other = poses[0].quantities(), poses[2].quantities()
    dx, dr, du = one[0][0] - other[0][0], one[1][0][0] - other[1][0][0], one[2][0] - other[2][0]
    platform = [a * dx / (du - a * dr) for a in (0, 1, 3)]
    legs = [poses[0].distance((a, 0, 0), (b, 0, 0)) for a, b in zip((0, 1, 3), platform, strict=True)]
    factors = [fmpz_poly([k * k + 1, -2 * k, 1]) for k in range(1, 10)]
    others = [prod(factors[:k] + factors[k + 1 :], start=fmpz_poly([1])) for k in range(9)]
    slope = prod(factors, start=fmpz_poly([1])).derivative()
    found = [fmpz_poly()] * 16
    found[2] = sum(
        (k * f.derivative() * rest for k, f, rest in zip(range(1, 10), factors, others, strict=True)), found[0]
    )
    found[3] = sum((-2 * k * rest for k, rest in enumerate(others, 1)), found[0])
    found[5], found[6] = slope, -2 * sum(others, found[0])
    infinity = {
        "chart": [int(k == 5) for k in range(16)],
        "separating_form": [int(k in (2, 6)) for k in range(16)],
        "eliminant": _hexadecimal(prod(factors, start=fmpz_poly([1]))),
        "coordinates": list(map(_hexadecimal, found)),
        "multiplicity": 36,
    }
    claim = {"claim": "complete", "completeness_route": "counting-at-infinity", "infinity": infinity}
    return listing("planar", poses, legs, 1, 1, (0, 0, 0, 1, 0, 0, 0, 0)) | claim


def _hexadecimal(polynomial: fmpz_poly) -> list[str]:
    return [hex(int(value)) for value in polynomial.coeffs()]


def _beside_a_point() -> Content:
    """A pose that is not at the point where it is held, in one coordinate alone."""
    at, held = (Pose((1, 0, 0, 0), (0, 1, 2, z)) for z in (5, 6))
    content = listing("translation", [at], [held.at_point((1, 1, 2))])
    return content | {"claim": "complete", "completeness_route": "product-bound"}


def _doubled() -> Content:
    """A true representation, all polynomials of it times 2."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 5))
    content = listing("translation", [at], [at.at_point((1, 1, 2))])
    shown = content["representation"]

    def twice(polynomial: list[str]) -> list[str]:
        return [hex(2 * int(c, 16)) for c in polynomial]

    doubled = {key: [twice(polynomial) for polynomial in shown[key]] for key in ("quaternion", "translation")}
    representation = shown | doubled | {"eliminant": twice(shown["eliminant"])}
    complete = {"claim": "complete", "completeness_route": "product-bound"}
    return content | complete | {"representation": representation}


def _free_in_the_plane() -> Content:
    """A planar mechanism whose only constraint holds for all planar motions."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 0))
    return moving(listing("planar", [at], [at.linear(UPRIGHT)], None), "dependent-forms")


def _free_in_a_slice() -> Content:
    """Three planar motions; what they are held by, and what is joined to it, holds for all planar motions."""
    poses = [Pose((1, 0, 0, 0), (0, n, n * n, 0)) for n in range(3)]
    shown = listing("planar", poses, [poses[0].linear([int(place == 3) for place in range(16)])], None)
    content = moving(shown, "more-poses-than-bound", real=False)
    slices = [{"constant": "0", "representation": shown["representation"]}]
    motion = content["self_motion"] | {"forms": [[*map(str, UPRIGHT), "0"]], "slices": slices}
    return content | {"representation": None, "self_motion": motion}


def _vector(texts: Sequence[str]) -> Vector:
    x, y, z = map(Fraction, texts)
    return x, y, z


def _axes_in_fractions() -> Content:
    """Poses on three cylinders in boxes; the directions of the axes are no integers."""
    content = mechanism_content("cylinders, boxes")
    entries = []
    for constraint, scale in zip(content["robot"]["constraints"], ("1/2", "3/5", "7/3"), strict=True):
        point, direction = (_vector(constraint[key]) for key in ("point", "direction"))
        x, y, z = (Fraction(scale) * value for value in direction)
        square = Fraction(constraint["radius_squared"])
        cylinder = AxisDistance(point, (x, y, z), _vector(constraint["platform"]), square, constraint["name"])
        entries.append(constraint_entry(cylinder, (1, 1, 1)))
    return content | {"robot": content["robot"] | {"constraints": entries}}


def _boxes_of_fewer() -> Content:
    """Boxes of a robot with a constraint too few."""
    content = mechanism_content("H4, boxes")
    return content | {"robot": content["robot"] | {"constraints": content["robot"]["constraints"][:-1]}}


def _turned_one_way() -> Content:
    """A platform that turns about a point, all nine entries of R given: no unknown is left."""
    at = Pose((1, 0, 0, 0), (0, 0, 0, 0))
    content = listing("spherical", [at], [at.angle(one, other) for one in AXES for other in AXES])
    return content | {"claim": "complete", "completeness_route": "modular-rank"}


AXES = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]


def _not_turned(held: Callable[[Pose], list[Constraint]]) -> Content:
    """A platform that cannot turn, held by further constraints: what is left of its section is linear."""
    at = Pose((1, 0, 0, 0), (0, 1, 2, 5))
    angles: list[Constraint] = [at.angle(one, other) for one in AXES for other in AXES]
    content = listing("spatial", [at], [*held(at), *angles])
    return content | {"claim": "complete", "completeness_route": "modular-rank"}


def _on_a_great_circle() -> Content:
    """Eight poses of a platform that turns about a point, all of them double: on a cylinder that touches a sphere."""
    v, b = vector(1, 2, 2), vector(2, 1, 0)
    cylinder = AxisDistance(vector(0, 0, 0), v, b, Fraction(5))
    angles = (
        Angle(vector(1, 0, 0), vector(0, 1, 1), Fraction(1, 3)),
        Angle(vector(0, 1, 2), vector(1, 0, 1), Fraction(1, 2)),
    )
    problem = ForwardProblem((*angles, cylinder), motion=SPHERICAL)
    content: Content = json.loads(made(lambda: problem))
    del content["digest"]
    return content


SECTIONS: dict[str, Case] = {
    "a platform that turns about a point, all poses double": (_on_a_great_circle, ACCEPTED),
    "a platform that cannot turn, held in a point": (
        lambda: _not_turned(lambda at: [at.at_point((1, 2, 3))]),
        ACCEPTED,
    ),
    "a platform that cannot turn, three of its planes held": (
        lambda: _not_turned(lambda at: [at.carries(axis, (1, 2, 3)) for axis in AXES]),
        ACCEPTED,
    ),
    "a platform that cannot turn": (_turned_one_way, ACCEPTED),
    "cylinders whose axes are given in fractions, boxes": (_axes_in_fractions, ACCEPTED),
    "boxes of a robot with a constraint too few": (_boxes_of_fewer, REJECTED),
    "a pose beside the point where it is held": (_beside_a_point, REJECTED),
    "a representation that is not in lowest terms": (_doubled, REJECTED),
    "a constraint that holds for all motions, in a slice that is all of them": (_free_in_a_slice, ACCEPTED),
    "a constraint that holds for all motions": (_free_in_the_plane, ACCEPTED),
    "a line beside the axis of a cylinder, at another distance": (
        lambda: _without_pose("translation", lambda at: _along_an_axis(at, 7)),
        ACCEPTED,
    ),
    "a line beside the axis of a cylinder, at another distance, by ranks": (
        lambda: (
            _without_pose("translation", lambda at: _along_an_axis(at, 7))
            | {"completeness_route": "modular-rank", "elimination": None}
        ),
        ACCEPTED,
    ),
    "a line on a cylinder, said to have no pose there": (
        lambda: _without_pose("translation", lambda at: _along_an_axis(at, 0)),
        REJECTED,
    ),
    "a cylinder alone, said to have no pose": (
        lambda: _without_pose("spatial", lambda at: [at.axis_distance((3, 1, 2), (1, 2, 2), (1, 1, 2))]),
        REJECTED,
    ),
    **{
        f"a motion shown with complex poses alone, real: {real}": (
            partial(_complex_sphere, real=real),
            REJECTED if real else ACCEPTED,
        )
        for real in (True, False)
    },
    **{
        f"as many real poses in slices as can be isolated, and one that is not held, real: {real}": (
            partial(_circle_in_slices, [(3, 4), (4, 3), (5, 0)], [LEVEL], [SPHERE, UPRIGHT], real=real),
            REJECTED if real else ACCEPTED,
        )
        for real in (True, False)
    },
    "as many poses in slices of a sphere as can be isolated": (
        partial(_circle_in_slices, [(3, 4), (4, 3)], [SPHERE, LEVEL], [UPRIGHT], real=True),
        REJECTED,
    ),
    "more poses in slices of a sphere, one of them not on it": (
        partial(_circle_in_slices, [(3, 4), (4, 3), (5, 1)], [SPHERE, LEVEL], [UPRIGHT], real=False),
        REJECTED,
    ),
    "planes that are dependent modulo all primes": (
        lambda: _nearly_dependent(claim="complete", **EMPTY_ELIMINATION),
        ACCEPTED,
    ),
    "points at infinity of planar motions": (_planar_infinity, REJECTED),
    "points at infinity that seem to fill those of planar motions": (_forty_with_planar_infinity, REJECTED),
    "points at infinity at the root of a polynomial of degree 1": (
        lambda: _planar_infinity(eliminant=["0x0", "0x1"], coordinates=[[]] * 16),
        REJECTED,
    ),
    "points at infinity at the roots of a constant": (
        lambda: _planar_infinity(eliminant=["0x1"], coordinates=[[]] * 16),
        "malformed",
    ),
}

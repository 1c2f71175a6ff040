"""Links certificates made by hand: bodies whose unknowns are integers, joined so that they cannot move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.links import LinkBody, Links
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.links.link_equations import LinkEquations
from pkm_exact.motions.motion_groups import MOTIONS
from pkm_exact.systems.polynomial_terms import spelled_terms

Content = dict[str, Any]
Numbers = Sequence[Any]
Joined = tuple[int, int, Any]
"""Bodies a and b, and the constraint."""

X, Y, Z, O = (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)  # noqa: E741 - the origin


def vector(values: Numbers) -> tuple[Fraction, ...]:
    return tuple(map(Fraction, values))


def distance(base: Numbers, platform: Numbers, square: Any) -> Any:
    return Distance(vector(base), vector(platform), Fraction(square), "rod")


def in_plane(normal: Numbers, offset: Any, platform: Numbers = O) -> Any:
    return InPlane(vector(normal), Fraction(offset), vector(platform), "plane")


def carries(normal: Numbers, offset: Any, base: Numbers = O) -> Any:
    return Carries(vector(normal), Fraction(offset), vector(base), "carried plane")


def on_line(point: Numbers, direction: Numbers, platform: Numbers = O) -> Any:
    return OnLine(vector(point), vector(direction), vector(platform), "line")


def at_point(point: Numbers, platform: Numbers = O) -> Any:
    return AtPoint(vector(point), vector(platform), "ball joint")


def angle(base: Numbers, platform: Numbers, product: Any = 0) -> Any:
    return Angle(vector(base), vector(platform), Fraction(product), "angle")


def on_cylinder(point: Numbers, direction: Numbers, platform: Numbers, square: Any) -> Any:
    return AxisDistance(vector(point), vector(direction), vector(platform), Fraction(square), "cylinder")


def linear(*coefficients: Any) -> Any:
    return LinearForm(vector(coefficients), "linear")


def in_metric(roots: Sequence[int], joined: Sequence[Joined]) -> list[Joined]:
    """The same constraints in coordinates of which the ordinary ones are these multiples."""
    factors = [Fraction(1), *map(Fraction, roots), *map(Fraction, roots)]
    factors += [Fraction(a, b) for a in roots for b in roots] + [Fraction(1)]
    found = []
    for a, b, each in joined:
        changed = {
            field: tuple(x * k for x, k in zip(value, factors, strict=True))
            if len(value) == len(factors)
            else tuple(x / k for x, k in zip(value, roots, strict=True))
            for field, value in vars(each).items()
            if isinstance(value, tuple)
        }
        found.append((a, b, replace(each, **changed)))
    return found


def unknowns_in_metric(roots: Sequence[int], motions: str, centre: Numbers) -> list[Fraction]:
    """The unknowns of all bodies in these coordinates."""
    planar, words = motions.startswith("planar:"), motions.removeprefix("planar:").split()
    factors: list[Fraction] = []
    for word in words:
        axes = 0 if word == "spherical" else 2 if planar or word == "planar" else 3
        factors += [Fraction(1, root) for root in roots[:axes]]
        if word in ("planar", "schoenflies"):
            factors += [Fraction(1), Fraction(1, roots[0] * roots[1])]
        elif word != "translation":
            factors += [Fraction(b, a) for a in roots for b in roots]
    return [Fraction(x) * factor for x, factor in zip(centre, factors, strict=True)]


def _certificate(motions: str, joined: Sequence[Joined], metric: Metric = (1, 1, 1), **entries: Any) -> Content:
    """Without system and box; motions are words, "planar" before a colon if all bodies move in the plane."""
    planar, words = motions.startswith("planar:"), motions.removeprefix("planar:").split()
    return {
        "format": "pkm_exact links certificate",
        "version": 1 if metric == (1, 1, 1) else 2,
        "mechanism": {
            "name": "made up",
            "unit": "m",
            "source": "made up",
            "planar": planar,
            **({} if metric == (1, 1, 1) else {"metric": list(map(str, metric))}),
            "platform": 1,
            "bodies": [{"name": "a body", "motion": word} for word in words],
            "joined": [
                {"bodies": [a, b], "constraint": constraint_entry(constraint, metric)} for a, b, constraint in joined
            ],
        },
        "configuration": "home",
        "method": "krawczyk",
        "system": None,
        "box": None,
        "notes": [],
    } | entries


def box(
    motions: str,
    joined: Sequence[Joined],
    centre: Numbers,
    radius: int = 1 << 8,
    exponent: int = 40,
    metric: Metric = (1, 1, 1),
) -> Content:
    """Of one pose: the unknowns of all bodies in their order, numbers on the grid."""
    whole = [int(Fraction(value) * (1 << exponent)) for value in centre]
    held = {"exponent": exponent, "radius": radius, "centre": [hex(value) for value in whole]}
    return _certificate(motions, joined, metric, box=held)


def system(motions: str, joined: Sequence[Joined], metric: Metric = (1, 1, 1)) -> Content:
    """Of all polynomials of a mechanism, as the solver writes them, of which nothing is claimed."""
    planar, words = motions.startswith("planar:"), motions.removeprefix("planar:").split()
    constraints = tuple(type(each)(**{**vars(each), "name": f"{number}"}) for number, (_, _, each) in enumerate(joined))
    motion = MOTIONS["planar" if planar else "spatial"]
    declared = Mechanism("made up", "m", "made up", constraints, motion=motion, metric=metric)
    bodies = tuple(LinkBody(f"{number}", MOTIONS[word]) for number, word in enumerate(words))
    links = Links(declared, bodies, tuple((a, b) for a, b, _ in joined), 1)
    found = LinkEquations(links, constraints).system()
    content = {
        "format": "pkm_exact system certificate",
        "version": 1,
        "title": "",
        "variables": list(found.unknowns),
        "polynomials": [spelled_terms(polynomial, found.unknowns) for polynomial in found.polynomials],
        "claim": "not-proven-complete",
        "completeness_route": None,
        "complex_solutions": None,
        "distinct_solutions": 0,
        "real_solutions": 0,
        "representation": None,
        "groups": None,
        "infinity": None,
        "elimination": None,
        "witness": None,
        "box_exponent": 0,
        "solutions": [],
        "notes": [],
    }
    return _certificate(motions, joined, metric, method="exact", system=content)

"""Planar machines with any number of legs: n-RPR, n-RRR and n-PRR, and which of their joints are driven.

As many legs as freedoms are three; with four the machine is redundant (4-RRR: DUAL V), and its values must fit
together. ``driven`` names the actuated joints of every leg:

    RPR    "P" the length;  "R" the direction of the leg;  "RP" both
    RRR    "R" the crank;   "RR" the crank and the direction of the second link
    PRR    "P" the slide;   "PR" the slide and the direction of the link

With two driven joints in a leg (in-branch redundancy) the leg puts its platform joint at a point. Directions are
angles from the first axis. In a metric (g1, g2) with w = g1 g2, a vector (x, y) is turned by 90 degrees to (-g2 y, g1
x) / sqrt(w). Reference: Firmani, Zibil, Nokleby and Podhorodecki in Parallel Manipulators: Towards New Applications
(2008), ch. 6.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import isqrt

from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric, dot
from pkm_exact.geometry.machines.dimension_readers import rods, vectors, word
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimension, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import ORIGIN, along
from pkm_exact.motions.motion_groups import PLANAR

_ONE = Fraction(1)


def turned(vector: Vector, metric: Metric) -> Vector:
    """A vector turned by 90 degrees, times sqrt(w).

    Examples
    --------
    >>> [str(x) for x in turned((Fraction(2), Fraction(1), Fraction(0)), (1, 3, 1))]
    ['-3', '2', '0']
    """
    x, y, _ = vector
    return -metric[1] * y, metric[0] * x, Fraction(0)


def _rpr(given: Dimensions, metric: Metric) -> Assembly:
    driven = given["driven"]
    constraints: list[Constraint] = []
    drives = []
    for k, (foot, joint) in enumerate(zip(given["base"], given["platform"], strict=True), 1):
        if driven == "P":
            constraints.append(Distance(foot, joint, _ONE, f"leg {k}"))
            continue
        across, normals = _across(foot, metric)
        constraints.append(InPlane(ORIGIN, Fraction(0), joint, f"leg {k}"))
        parts = [Part(f"leg {k}", "normal", normals), Part(f"leg {k}", "offset", across)]
        if driven == "RP":
            first, second = _unit(metric), turned(_unit(metric), metric)
            constraints.append(InPlane(ORIGIN, Fraction(0), joint, f"along {k}"))
            parts.append(Part(f"along {k}", "normal", (first, second)))
            parts.append(Part(f"along {k}", "offset", (dot(first, foot, metric), dot(second, foot, metric))))
            drives.append(Drive(f"length {k}", (Part(f"along {k}", "offset", (_ONE,)),)))
        drives.append(Drive(f"direction {k}", tuple(parts), metric[0] * metric[1]))
    legs = range(1, len(given["base"]) + 1)
    groups = {
        "P": (Group(Joint.LENGTH, tuple(f"leg {k}" for k in legs)),),
        "R": (Group(Joint.CRANK, tuple(f"direction {k}" for k in legs)),),
    }
    both = (*groups["R"], Group(Joint.SLIDE, tuple(f"length {k}" for k in legs)))
    return Assembly(tuple(constraints), groups.get(driven, both), tuple(drives))


def _across(foot: Vector, metric: Metric) -> tuple[tuple[Fraction, Fraction], tuple[Vector, Vector]]:
    """What cosine and sine of a leg's direction contribute to the offset and the normal of the line that it lies on."""
    first = _unit(metric)
    weight = metric[0] * metric[1]
    normals = turned(first, metric), along((-weight, first))
    return (dot(normals[0], foot, metric), dot(normals[1], foot, metric)), normals


def _unit(metric: Metric) -> Vector:
    """A unit vector along the first axis."""
    root = isqrt(metric[0])
    if root * root != metric[0]:
        raise InputError(
            f"metric: its first number, {metric[0]}, is no square, so that directions along x have no unit"
        )
    return Fraction(1, root), Fraction(0), Fraction(0)


def _rrr(given: Dimensions, metric: Metric) -> Assembly:
    legs = [
        (foot, joint, (crank, turned(crank, metric)))
        for foot, joint, crank in zip(given["base"], given["platform"], given["at_0"], strict=True)
    ]
    names = tuple(f"crank {k}" for k in range(1, len(legs) + 1))
    if given["driven"] == "R":
        constraints = [
            Distance(foot, joint, square, f"rod {k}")
            for k, ((foot, joint, _), square) in enumerate(zip(legs, _all(given, len(legs)), strict=True), 1)
        ]
        parts = [Part(f"rod {k}", "base", axes) for k, (_, _, axes) in enumerate(legs, 1)]
        drives = [Drive(name, (part,), metric[0] * metric[1]) for name, part in zip(names, parts, strict=True)]
        return Assembly(tuple(constraints), (Group(Joint.CRANK, names),), tuple(drives))
    return _at_points(given, metric, [leg[:2] for leg in legs], [leg[2] for leg in legs], names, Joint.CRANK)


def _prr(given: Dimensions, metric: Metric) -> Assembly:
    feet = list(zip(given["base"], given["platform"], strict=True))
    names = tuple(f"slide {k}" for k in range(1, len(feet) + 1))
    axes: list[tuple[Vector, ...]] = [(direction,) for direction in given["directions"]]
    if given["driven"] == "P":
        rows = enumerate(zip(feet, _all(given, len(feet)), strict=True), 1)
        constraints = [Distance(foot, joint, square, f"rod {k}") for k, ((foot, joint), square) in rows]
        drives = [
            Drive(name, (Part(f"rod {k}", "base", axis),))
            for k, (name, axis) in enumerate(zip(names, axes, strict=True), 1)
        ]
        return Assembly(tuple(constraints), (Group(Joint.SLIDE, names),), tuple(drives))
    return _at_points(given, metric, feet, axes, names, Joint.SLIDE)


def _at_points(
    given: Dimensions,
    metric: Metric,
    feet: list[tuple[Vector, Vector]],
    axes: list[tuple[Vector, ...]],
    names: tuple[str, ...],
    joint: Joint,
) -> Assembly:
    """Legs whose first joint and whose link's direction are both driven."""
    weight = metric[0] * metric[1]
    constraints = []
    drives = []
    for k, ((foot, held), own, square) in enumerate(zip(feet, axes, _all(given, len(feet)), strict=True), 1):
        length = isqrt(square.numerator), isqrt(square.denominator)
        if Fraction(*length) ** 2 != square:
            raise InputError(f"rods: the squared length {square} of rod {k} is no square; drive one joint of each leg")
        link = along((Fraction(*length), _unit(metric)))
        constraints.append(AtPoint(foot, held, f"leg {k}"))
        drives.append(Drive(names[k - 1], (Part(f"leg {k}", "point", own),), weight if joint is Joint.CRANK else 0))
        drives.append(Drive(f"link {k}", (Part(f"leg {k}", "point", (link, turned(link, metric))),), weight))
    links = tuple(f"link {k}" for k in range(1, len(feet) + 1))
    return Assembly(tuple(constraints), (Group(joint, names), Group(Joint.CRANK, links, "link_")), tuple(drives))


def _all(given: Dimensions, count: int) -> tuple[Fraction, ...]:
    """One squared rod for each leg."""
    squares: tuple[Fraction, ...] = given["length"]
    if len(squares) == 1:
        return squares * count
    if len(squares) != count:
        raise InputError(f"rods: {len(squares)} entries; give {count}, one per leg, or length = ... for all")
    return squares


_BASE = [[9, 1], [9, -1], [-9, -1], [-9, 1]]
_PLATFORM = [[2, 0], [2, 0], [-2, 0], [-2, 0]]


def _kind(
    count: int,
    chain: str,
    words: str,
    driven: tuple[str, ...],
    build: Callable[[Dimensions, Metric], Assembly],
    *more: Dimension,
    home: dict[str, str],
) -> MachineKind:
    points = _BASE[:count], _PLATFORM[:count]
    base, platform = (
        vectors("joints", f"joints of the {part}, one per leg", str(rows), count, 2, table=part, name=part)
        for part, rows in zip(("base", "platform"), points, strict=True)
    )
    return MachineKind(
        f"{count}-{chain}",
        f"planar: {words}; any number of legs",
        PLANAR,
        (base, platform, *more, word("driven", "which joints of every leg are driven", driven, table="actuators")),
        build,
        home,
        ((0, 0, 0), (1, 0, 0, 0)),
        own_metric=True,
        any_count=True,
    )


def _links(example: str, first: str = "length") -> Dimension:
    what = f"{first.replace('_', ', ')} of the links; length, lengths, length_squared or lengths_squared"
    return rods(None, example, what, key="length", table="rods", squares="lengths_squared", first=first)


def n_rpr(count: int) -> MachineKind:
    """Legs of actuated length or direction."""
    home = {"pose": '{ position = [1, "1/2"], half_tangent = "1/3" }'}
    return _kind(count, "RPR", "legs of actuated length, or direction", ("P", "R", "RP"), _rpr, home=home)


def n_rrr(count: int) -> MachineKind:
    """Cranks and links."""
    what = "the crank of each leg at 0 degrees; angles are counted counterclockwise"
    cranks = vectors("at_0", what, str([[5, 0]] * count), count, 2, table="cranks")
    home = {"half_tangents": '[3, -3, "-1/3", "1/3"]'}
    return _kind(count, "RRR", "cranks and links", ("R", "RR"), _rrr, cranks, _links("5"), home=home)


def n_prr(count: int) -> MachineKind:
    """Slides and links."""
    slides = vectors("directions", "the direction of each slide", str([[1, 0]] * count), count, 2, table="slides")
    home = {"slides": "[-4, -4, 4, 4]"}
    links = _links("10", "length_squared")
    return _kind(count, "PRR", "slides and links", ("P", "PR"), _prr, slides, links, home=home)

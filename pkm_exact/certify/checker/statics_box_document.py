"""What a statics certificate of version 2 says, read strictly: a machine in a box of poses, and claims about it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.checker.spelling import count, entries, integer, items, positive, rational, text
from pkm_exact.certify.checker.statics_document import MAX_LEGS, MAX_VERTICES, vector_of, whole
from pkm_exact.certify.checker.verdict import malformed, too_large

KEYS: Final = (
    "format",
    "version",
    "name",
    "unit",
    "solution",
    "metric",
    "freedoms",
    "position",
    "rotation",
    "legs",
    "constraints",
    "free",
    "speeds",
    "forces",
    "length",
    "load",
    "jacobian",
    "expansion",
    "actuator_forces",
    "velocity_polytope",
    "wrench_polytope",
    "ellipsoid",
    "indices",
)
MAX_CONSTRAINTS: Final = 5
FORM: Final = 17

Numbers = tuple[Fraction, ...]
Ends = tuple[Fraction, Fraction]
Table = tuple[tuple[Ends, ...], ...]
Side = tuple[int, int]


@dataclass(frozen=True)
class BoxLeg:
    """Joints, and the velocity of the base joint; None where the length is the actuator."""

    base: Numbers
    platform: Numbers
    direction: Numbers | None


@dataclass(frozen=True)
class BoxVelocity:
    """Facets, vertices as sides and coordinates, the volume."""

    facets: tuple[Side, ...]
    vertices: tuple[tuple[tuple[Side, ...], tuple[Ends, ...]], ...]
    volume: Ends | None


@dataclass(frozen=True)
class BoxFacet:
    """A facet of wrenches."""

    legs: tuple[int, ...]
    side: int
    normal: tuple[Ends, ...]
    offset: Ends


@dataclass(frozen=True)
class BoxWrench:
    """Facets, vertices as ends of the forces, the volume."""

    facets: tuple[BoxFacet, ...]
    vertices: tuple[tuple[int, ...], ...]
    volume: Ends


@dataclass(frozen=True)
class BoxEllipsoid:
    """Weights, matrix, and by which part the largest may be larger."""

    weights: Numbers
    matrix: tuple[Numbers, ...]
    gap: Fraction


@dataclass(frozen=True)
class BoxStatics:
    """A certificate; legs and sides are counted from 0."""

    metric: tuple[int, ...]
    freedoms: tuple[int, ...]
    position: tuple[Ends, ...]
    rotation: Table
    legs: tuple[BoxLeg, ...]
    constraints: tuple[Numbers, ...]
    free: tuple[int, ...]
    speeds: Numbers | None
    forces: tuple[Ends, ...] | None
    length: Fraction | None
    load: Numbers | None
    jacobian: Table
    expansion: Table
    actuator_forces: tuple[Ends, ...] | None
    velocity: BoxVelocity | None
    wrench: BoxWrench | None
    ellipsoid: BoxEllipsoid | None
    indices: tuple[Ends, ...] | None


def read_box_statics(body: dict[str, Any]) -> BoxStatics:
    """The content of a certificate; a refusal if it is not one."""
    values = dict(zip(KEYS, entries(body, "certificate", KEYS), strict=True))
    text(values["name"], "name")
    text(values["unit"], "unit")
    if values["solution"] is not None:
        require_solution(values["solution"])
    metric = items(values["metric"], "metric", 3, whole)
    if min(metric) <= 0:
        raise malformed("metric: one is not positive")
    freedoms = places_of(values["freedoms"], "freedoms", range(6))
    for name, most in (("legs", MAX_LEGS), ("constraints", MAX_CONSTRAINTS)):
        if isinstance(values[name], list) and len(values[name]) > most:
            raise too_large(f"{name}: more than {most} entries")
    legs = items(values["legs"], "legs", None, _leg)
    forms = items(values["constraints"], "constraints", None, vector_of(FORM))
    free = places_of(values["free"], "free", freedoms)
    n, f, m = len(freedoms), len(free), len(legs)
    if f != n - len(forms):
        raise malformed("free: not as many as freedoms less constraints")
    if m < f:
        raise malformed("legs: fewer than free components")
    speeds, forces, load = (values[name] for name in ("speeds", "forces", "load"))
    velocity, wrench, ellipsoid, borne = (
        values[name] for name in ("velocity_polytope", "wrench_polytope", "ellipsoid", "actuator_forces")
    )
    for name, claim, needed, given in (
        ("velocity_polytope", velocity, "speeds", speeds),
        ("ellipsoid", ellipsoid, "speeds", speeds),
        ("wrench_polytope", wrench, "forces", forces),
        ("actuator_forces", borne, "load", load),
    ):
        if claim is not None and given is None:
            raise malformed(f"{name}: needs {needed}")
    if load is not None and borne is None:
        raise malformed("actuator_forces: are missing for the load")
    return BoxStatics(
        metric,
        freedoms,
        items(values["position"], "position", 3, ends_of),
        items(values["rotation"], "rotation", 3, rows_of_ends(3)),
        legs,
        forms,
        tuple(freedoms.index(k) for k in free),
        None if speeds is None else items(speeds, "speeds", m, positive),
        None if forces is None else items(forces, "forces", m, range_of),
        None if values["length"] is None else positive(values["length"], "length"),
        None if load is None else items(load, "load", n, rational),
        items(values["jacobian"], "jacobian", m, rows_of_ends(f)),
        items(values["expansion"], "expansion", n, rows_of_ends(f)),
        None if borne is None else items(borne, "actuator_forces", m, ends_of),
        None if velocity is None else velocity_of(velocity, m, f),
        None if wrench is None else wrench_of(wrench, m, f),
        None if ellipsoid is None else ellipsoid_of(ellipsoid, m, f),
        None if values["indices"] is None else indices_of(values["indices"]),
    )


def rows_of_ends(length: int) -> Any:
    """Reads so many intervals."""
    return lambda value, where: items(value, where, length, ends_of)


def ends_of(value: Any, where: str) -> Ends:
    """An interval."""
    low, high = items(value, where, 2, rational)
    if low > high:
        raise malformed(f"{where}: the ends are not in order")
    return low, high


def range_of(value: Any, where: str) -> Ends:
    """Two numbers, the first below the second."""
    low, high = ends_of(value, where)
    if low == high:
        raise malformed(f"{where}: the least is not below the greatest")
    return low, high


def places_of(value: Any, where: str, known: Any) -> tuple[int, ...]:
    """Increasing numbers of those that are known."""
    found = items(value, where, None, integer)
    if not found or list(found) != sorted(set(found)) or not set(found) <= set(known):
        raise malformed(f"{where}: not increasing numbers of those that there are")
    return found


def require_solution(value: Any) -> None:
    """A digest and the number of a pose, which describe."""
    digest, pose = entries(value, "solution", ("digest", "pose"))
    text(digest, "solution.digest")
    if count(pose, "solution.pose") == 0:
        raise malformed("solution.pose: not a number from 1")


def _leg(value: Any, where: str) -> BoxLeg:
    base, platform, direction = entries(value, where, ("base", "platform", "direction"))
    read = vector_of(3)
    return BoxLeg(
        read(base, f"{where}.base"),
        read(platform, f"{where}.platform"),
        None if direction is None else read(direction, f"{where}.direction"),
    )


def _sides(value: Any, where: str, length: int | None, legs: int) -> tuple[Side, ...]:
    found = []
    for leg, side in items(value, where, length, lambda x, w: items(x, w, 2, integer)):
        if not (1 <= leg <= legs and side in (1, -1)):
            raise malformed(f"{where}: not a leg and a side")
        found.append((leg - 1, side))
    return tuple(found)


def _limited(value: Any, where: str) -> None:
    if isinstance(value, list) and len(value) > MAX_VERTICES:
        raise too_large(f"{where}: more than {MAX_VERTICES} entries")


def velocity_of(value: Any, m: int, f: int, where: str = "velocity_polytope") -> BoxVelocity:
    """Facets, vertices and volume of what rows map between ends."""
    facets, vertices, volume = entries(value, where, ("facets", "vertices", "volume"))
    _limited(facets, f"{where}.facets")
    _limited(vertices, f"{where}.vertices")

    def vertex(entry: Any, place: str) -> tuple[tuple[Side, ...], tuple[Ends, ...]]:
        sides, at = entries(entry, place, ("sides", "at"))
        found = _sides(sides, f"{place}.sides", f, m)
        if [leg for leg, _ in found] != sorted({leg for leg, _ in found}):
            raise malformed(f"{place}.sides: legs are not increasing")
        return found, items(at, f"{place}.at", f, ends_of)

    if (volume is None) != (m > f):
        raise malformed(f"{where}.volume: is there exactly if there are as many legs as free components")
    return BoxVelocity(
        _sides(facets, f"{where}.facets", None, m),
        items(vertices, f"{where}.vertices", None, vertex),
        None if volume is None else ends_of(volume, f"{where}.volume"),
    )


def wrench_of(value: Any, m: int, f: int, where: str = "wrench_polytope") -> BoxWrench:
    """Facets, vertices and volume of sums of rows times what is between ends."""
    facets, vertices, volume = entries(value, where, ("facets", "vertices", "volume"))
    _limited(facets, f"{where}.facets")
    _limited(vertices, f"{where}.vertices")

    def facet(entry: Any, place: str) -> BoxFacet:
        legs, side, normal, offset = entries(entry, place, ("legs", "side", "normal", "offset"))
        chosen = items(legs, f"{place}.legs", f - 1, integer)
        if list(chosen) != sorted(set(chosen)) or not set(chosen) <= set(range(1, m + 1)):
            raise malformed(f"{place}.legs: not increasing numbers of legs")
        return BoxFacet(
            tuple(leg - 1 for leg in chosen),
            _sign(side, f"{place}.side"),
            items(normal, f"{place}.normal", f, ends_of),
            ends_of(offset, f"{place}.offset"),
        )

    return BoxWrench(
        items(facets, f"{where}.facets", None, facet),
        items(vertices, f"{where}.vertices", None, lambda x, w: items(x, w, m, _sign)),
        ends_of(volume, f"{where}.volume"),
    )


def _sign(value: Any, where: str) -> int:
    if integer(value, where) not in (1, -1):
        raise malformed(f"{where}: not 1 or -1")
    return int(value)


def ellipsoid_of(value: Any, m: int, f: int) -> BoxEllipsoid:
    """Weights, matrix and gap."""
    weights, matrix, gap = entries(value, "ellipsoid", ("weights", "matrix", "gap"))
    part = rational(gap, "ellipsoid.gap")
    if not 0 <= part < 1:
        raise malformed("ellipsoid.gap: not from 0 to below 1")
    return BoxEllipsoid(
        items(weights, "ellipsoid.weights", m, rational), items(matrix, "ellipsoid.matrix", f, vector_of(f)), part
    )


def indices_of(value: Any) -> tuple[Ends, ...]:
    """Bounds of least and greatest singular value and of the condition."""
    names = ("sigma_min", "sigma_max", "condition")
    found = []
    for name, entry in zip(names, entries(value, "indices", names), strict=True):
        low, high = ends_of(entry, f"indices.{name}")
        if low < 0:
            raise malformed(f"indices.{name}: negative")
        found.append((low, high))
    return tuple(found)

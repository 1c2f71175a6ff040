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
        _solution(values["solution"])
    metric = items(values["metric"], "metric", 3, whole)
    if min(metric) <= 0:
        raise malformed("metric: one is not positive")
    freedoms = _places(values["freedoms"], "freedoms", range(6))
    for name, most in (("legs", MAX_LEGS), ("constraints", MAX_CONSTRAINTS)):
        if isinstance(values[name], list) and len(values[name]) > most:
            raise too_large(f"{name}: more than {most} entries")
    legs = items(values["legs"], "legs", None, _leg)
    forms = items(values["constraints"], "constraints", None, vector_of(FORM))
    free = _places(values["free"], "free", freedoms)
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
        items(values["position"], "position", 3, _ends),
        items(values["rotation"], "rotation", 3, _ends_of(3)),
        legs,
        forms,
        tuple(freedoms.index(k) for k in free),
        None if speeds is None else items(speeds, "speeds", m, positive),
        None if forces is None else items(forces, "forces", m, _range),
        None if values["length"] is None else positive(values["length"], "length"),
        None if load is None else items(load, "load", n, rational),
        items(values["jacobian"], "jacobian", m, _ends_of(f)),
        items(values["expansion"], "expansion", n, _ends_of(f)),
        None if borne is None else items(borne, "actuator_forces", m, _ends),
        None if velocity is None else _velocity(velocity, m, f),
        None if wrench is None else _wrench(wrench, m, f),
        None if ellipsoid is None else _ellipsoid(ellipsoid, m, f),
        None if values["indices"] is None else _indices(values["indices"]),
    )


def _ends_of(length: int) -> Any:
    return lambda value, where: items(value, where, length, _ends)


def _ends(value: Any, where: str) -> Ends:
    low, high = items(value, where, 2, rational)
    if low > high:
        raise malformed(f"{where}: the ends are not in order")
    return low, high


def _range(value: Any, where: str) -> Ends:
    low, high = _ends(value, where)
    if low == high:
        raise malformed(f"{where}: the least is not below the greatest")
    return low, high


def _places(value: Any, where: str, known: Any) -> tuple[int, ...]:
    found = items(value, where, None, integer)
    if not found or list(found) != sorted(set(found)) or not set(found) <= set(known):
        raise malformed(f"{where}: not increasing numbers of those that there are")
    return found


def _solution(value: Any) -> None:
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


def _velocity(value: Any, m: int, f: int) -> BoxVelocity:
    where = "velocity_polytope"
    facets, vertices, volume = entries(value, where, ("facets", "vertices", "volume"))
    _limited(facets, f"{where}.facets")
    _limited(vertices, f"{where}.vertices")

    def vertex(entry: Any, place: str) -> tuple[tuple[Side, ...], tuple[Ends, ...]]:
        sides, at = entries(entry, place, ("sides", "at"))
        found = _sides(sides, f"{place}.sides", f, m)
        if [leg for leg, _ in found] != sorted({leg for leg, _ in found}):
            raise malformed(f"{place}.sides: legs are not increasing")
        return found, items(at, f"{place}.at", f, _ends)

    if (volume is None) != (m > f):
        raise malformed(f"{where}.volume: is there exactly if there are as many legs as free components")
    return BoxVelocity(
        _sides(facets, f"{where}.facets", None, m),
        items(vertices, f"{where}.vertices", None, vertex),
        None if volume is None else _ends(volume, f"{where}.volume"),
    )


def _wrench(value: Any, m: int, f: int) -> BoxWrench:
    where = "wrench_polytope"
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
            items(normal, f"{place}.normal", f, _ends),
            _ends(offset, f"{place}.offset"),
        )

    return BoxWrench(
        items(facets, f"{where}.facets", None, facet),
        items(vertices, f"{where}.vertices", None, lambda x, w: items(x, w, m, _sign)),
        _ends(volume, f"{where}.volume"),
    )


def _sign(value: Any, where: str) -> int:
    if integer(value, where) not in (1, -1):
        raise malformed(f"{where}: not 1 or -1")
    return int(value)


def _ellipsoid(value: Any, m: int, f: int) -> BoxEllipsoid:
    weights, matrix, gap = entries(value, "ellipsoid", ("weights", "matrix", "gap"))
    part = rational(gap, "ellipsoid.gap")
    if not 0 <= part < 1:
        raise malformed("ellipsoid.gap: not from 0 to below 1")
    return BoxEllipsoid(
        items(weights, "ellipsoid.weights", m, rational), items(matrix, "ellipsoid.matrix", f, vector_of(f)), part
    )


def _indices(value: Any) -> tuple[Ends, ...]:
    names = ("sigma_min", "sigma_max", "condition")
    found = []
    for name, entry in zip(names, entries(value, "indices", names), strict=True):
        low, high = _ends(entry, f"indices.{name}")
        if low < 0:
            raise malformed(f"indices.{name}: negative")
        found.append((low, high))
    return tuple(found)

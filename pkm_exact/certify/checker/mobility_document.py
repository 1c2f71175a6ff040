"""The content of a mobility certificate, read into typed values; nothing in it is believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any, Final

from pkm_exact.certify.checker.spelling import choice, count, entries, integer, items, rational, text
from pkm_exact.certify.checker.verdict import malformed, too_large

MOST_BODIES: Final = 64
MOST_FREEDOMS: Final = 128
MOST_SETS: Final = 1 << 16
TYPES: Final = {"R": 1, "P": 1, "H": 1, "C": 1, "U": 2, "S": 0, "screw": 0}
"""Types of joints, with their numbers of axes."""
FREEDOMS: Final = {"R": 1, "P": 1, "H": 1, "C": 2, "U": 2, "S": 3}
ARGUMENTS: Final = ("regular", "subgroups")
ABOVE: Final = ("rank", "cone", "definite", "order")
BELOW: Final = ("regular", "subgroups", "indefinite", "curve")
OF_THE_IDEAL: Final = (("rank", "cone", "definite", "local"), ("regular", "subgroups", "indefinite", "curves"))
"""Arguments above and below of version 3."""
MOST_DEGREE: Final = 12
_KEYS: Final = (
    "format",
    "version",
    "mechanism",
    "actuated",
    "loops",
    "platform",
    "locked_loops",
    "locked_platform",
    "mobility",
    "actuator_sets",
    "finite",
)
_JOINT: Final = ("name", "type", "bodies", "point", "axes", "pitch", "screws")
COUNTS: Final = ("free", "platform", "gruebler_kutzbach", "overconstraint", "locked", "locked_platform")

Vector = tuple[Fraction, ...]


@dataclass(frozen=True)
class Joint:
    """A joint: its bodies by their places in the list, and its geometry."""

    name: str
    type: str
    bodies: tuple[int, int]
    point: Vector
    axes: tuple[Vector, ...]
    pitch: Fraction
    screws: tuple[Vector, ...]

    @property
    def freedoms(self) -> int:
        """The number of its one-freedom joints."""
        return len(self.screws) or FREEDOMS[self.type]


@dataclass(frozen=True)
class RankProof:
    """Places of a minor, and a basis of the null space."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    null_space: tuple[Vector, ...]


@dataclass(frozen=True)
class Sets:
    """Sets of freedoms by their places, and whether they are called all."""

    complete: bool
    sets: tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class LegOfProof:
    """A leg: its joints by their places, from the base to the platform, and where they are cut."""

    joints: tuple[int, ...]
    cut: int


@dataclass(frozen=True)
class Curve:
    """F(s, u), and N(s, u) and D(s) for each freedom: coefficients by powers of u, then of s."""

    relation: tuple[Vector, ...]
    halves: tuple[tuple[tuple[Vector, ...], Vector], ...]


@dataclass(frozen=True)
class SecondOrder:
    """Bounds of the finite mobility, and why it is not greater and not less; freedoms by their places."""

    argument: str
    least: int
    most: int
    platform_least: int
    platform_most: int
    dependencies: tuple[Vector, ...]
    above: str
    section: tuple[Vector, ...]
    degree: int
    series: tuple[Vector, ...]
    below: str | None = None
    locked: tuple[int, ...] = ()
    legs: tuple[LegOfProof, ...] = ()
    vectors: tuple[Vector, ...] = ()
    curve: tuple[tuple[Vector, ...], ...] = ()
    curves: tuple[Curve, ...] = ()


@dataclass(frozen=True)
class MobilityDocument:
    """What a mobility certificate says; bodies and freedoms by their places."""

    bodies: int
    base: int
    platform: int
    joints: tuple[Joint, ...]
    actuated: tuple[int, ...]
    proofs: dict[str, RankProof]
    counts: dict[str, int]
    among: tuple[int, ...]
    sets: dict[str, Sets]
    argument: str | None
    legs: tuple[LegOfProof, ...]
    second_order: SecondOrder | None = None

    @property
    def freedoms(self) -> int:
        """The number of all one-freedom joints."""
        return sum(joint.freedoms for joint in self.joints)


def read_mobility(body: dict[str, Any]) -> MobilityDocument:
    """The content of a mobility certificate, or a refusal if it has not the shape of one."""
    values = dict(zip(_KEYS, entries(body, "certificate", _KEYS), strict=True))
    name, unit, source, base, platform, bodies, joints = entries(
        values["mechanism"], "mechanism", ("name", "unit", "source", "base", "platform", "bodies", "joints")
    )
    for label, value in (("name", name), ("unit", unit), ("source", source)):
        text(value, f"mechanism.{label}")
    known = items(bodies, "mechanism.bodies", None, text)
    _require_size("mechanism.bodies", len(known), 2, MOST_BODIES)
    _require_different("mechanism.bodies", known)
    places = {body_name: place for place, body_name in enumerate(known)}
    if isinstance(joints, list):
        _require_size("mechanism.joints", len(joints), 1, MOST_FREEDOMS)
    read = items(joints, "mechanism.joints", None, lambda value, where: _joint(value, where, places))
    ends = _name_in(base, "mechanism.base", places), _name_in(platform, "mechanism.platform", places)
    if ends[0] == ends[1]:
        raise malformed("mechanism.platform: the base")
    names = _freedom_names(read)
    _require_connected(read, len(known), ends[0])
    freedoms = {freedom: place for place, freedom in enumerate(names)}
    joint_places = {joint.name: place for place, joint in enumerate(read)}
    argument: str | None = None
    legs: tuple[LegOfProof, ...] = ()
    second: SecondOrder | None = None
    if values["version"] == 2:
        second = _second_order(values["finite"], joint_places, freedoms)
    elif values["version"] == 3:
        second = _of_the_ideal(values["finite"], joint_places, freedoms)
    else:
        argument, legs = _finite(values["finite"], joint_places)
    among, sets = _actuator_sets(values["actuator_sets"], freedoms)
    counts = entries(values["mobility"], "mobility", COUNTS)
    keys = ("loops", "platform", "locked_loops", "locked_platform")
    return MobilityDocument(
        len(known),
        *ends,
        read,
        _names(values["actuated"], "actuated", freedoms),
        {key: read_rank_proof(values[key], key) for key in keys},
        {key: integer(value, f"mobility.{key}") for key, value in zip(COUNTS, counts, strict=True)},
        among,
        sets,
        argument,
        legs,
        second,
    )


def _require_size(where: str, found: int, least: int, most: int) -> None:
    if found < least:
        raise malformed(f"{where}: fewer than {least}")
    if found > most:
        raise too_large(f"{where}: more than {most}")


def _require_different(where: str, names: Sequence[object]) -> None:
    if len(set(names)) < len(names):
        raise malformed(f"{where}: one occurs twice")


def _name_in(value: Any, where: str, places: dict[str, int]) -> int:
    if not isinstance(value, str) or value not in places:
        raise malformed(f"{where}: not a name in the list")
    return places[value]


def _vector(length: int) -> Any:
    return lambda value, where: items(value, where, length, rational)


def _joint(value: Any, where: str, places: dict[str, int]) -> Joint:
    name, type_name, bodies, point, axes, pitch, screws = entries(value, where, _JOINT)
    kind = choice(type_name, f"{where}.type", tuple(TYPES))
    ends = items(bodies, f"{where}.bodies", 2, lambda body, place: _name_in(body, place, places))
    if ends[0] == ends[1]:
        raise malformed(f"{where}.bodies: one body twice")
    joint = Joint(
        text(name, f"{where}.name"),
        kind,
        (ends[0], ends[1]),
        items(point, f"{where}.point", 3, rational),
        items(axes, f"{where}.axes", TYPES[kind], _vector(3)),
        rational(pitch, f"{where}.pitch"),
        items(screws, f"{where}.screws", None, _vector(6)),
    )
    _require_geometry(joint, where)
    return joint


def _require_geometry(joint: Joint, where: str) -> None:
    if not all(map(any, joint.axes)):
        raise malformed(f"{where}.axes: an axis is 0")
    if joint.type in ("P", "screw") and any(joint.point):
        raise malformed(f"{where}.point: not 0, though the type has none")
    if joint.type != "H" and joint.pitch:
        raise malformed(f"{where}.pitch: not 0, though the type has none")
    if (joint.type == "screw") != bool(joint.screws) or len(joint.screws) > 6:
        raise malformed(f"{where}.screws: not one to six of the type screw, none of another")
    if not all(map(any, joint.screws)):
        raise malformed(f"{where}.screws: a screw is 0")


def _freedom_names(joints: Sequence[Joint]) -> list[str]:
    found: list[str] = []
    for joint in joints:
        number = joint.freedoms
        found += [joint.name] if number == 1 else [f"{joint.name}.{k}" for k in range(1, number + 1)]
    _require_size("mechanism.joints", len(found), 1, MOST_FREEDOMS)
    _require_different("mechanism.joints", found)
    _require_different("mechanism.joints", [joint.name for joint in joints])
    return found


def _require_connected(joints: Sequence[Joint], bodies: int, base: int) -> None:
    reached, size = {base}, 0
    while len(reached) > size:
        size = len(reached)
        reached |= {body for joint in joints if reached & set(joint.bodies) for body in joint.bodies}
    if len(reached) < bodies:
        raise malformed("mechanism: a body is not connected with the base")


def _names(value: Any, where: str, freedoms: dict[str, int]) -> tuple[int, ...]:
    found = items(value, where, None, lambda name, place: _name_in(name, place, freedoms))
    if not all(a < b for a, b in pairwise(found)):
        raise malformed(f"{where}: not in the order of the freedoms")
    return found


def read_rank_proof(value: Any, where: str) -> RankProof:
    """A minor and a null space."""
    rank, rows, columns, null_space = entries(value, where, ("rank", "rows", "columns", "null_space"))
    number = count(rank, f"{where}.rank")
    found = []
    for key, places in (("rows", rows), ("columns", columns)):
        indices = items(places, f"{where}.{key}", number, count)
        if not all(a < b for a, b in pairwise(indices)):
            raise malformed(f"{where}.{key}: not in increasing order")
        found.append(indices)
    vectors = items(null_space, f"{where}.null_space", None, lambda x, place: items(x, place, None, rational))
    return RankProof(found[0], found[1], vectors)


def _actuator_sets(value: Any, freedoms: dict[str, int]) -> tuple[tuple[int, ...], dict[str, Sets]]:
    among, *lists = entries(value, "actuator_sets", ("among", "platform", "mechanism"))
    chosen = _names(among, "actuator_sets.among", freedoms)
    found = {}
    for key, entry in zip(("platform", "mechanism"), lists, strict=True):
        where = f"actuator_sets.{key}"
        complete, sets = entries(entry, where, ("complete", "sets"))
        if type(complete) is not bool:
            raise malformed(f"{where}.complete: neither true nor false")
        if isinstance(sets, list) and len(sets) > MOST_SETS:
            raise too_large(f"{where}.sets: more than {MOST_SETS}")
        read = items(sets, f"{where}.sets", None, lambda names, place: _names(names, place, freedoms))
        if not all((len(a), a) < (len(b), b) for a, b in pairwise(read)):
            raise malformed(f"{where}.sets: not in their order")
        if not all(set(names) <= set(chosen) for names in read):
            raise malformed(f"{where}.sets: a freedom that is not among those looked at")
        found[key] = Sets(complete, read)
    return chosen, found


def _finite(value: Any, joints: dict[str, int]) -> tuple[str | None, tuple[LegOfProof, ...]]:
    if value is None:
        return None, ()
    argument, legs = entries(value, "finite", ("argument", "legs"))
    word = choice(argument, "finite.argument", ARGUMENTS)

    read = _legs(legs, "finite.legs", joints)
    if bool(read) != (word == "subgroups"):
        raise malformed("finite.legs: not those of the argument")
    return word, read


def _legs(value: Any, where: str, joints: dict[str, int]) -> tuple[LegOfProof, ...]:
    def leg(entry: Any, place: str) -> LegOfProof:
        names, cut = entries(entry, place, ("joints", "cut"))
        places = items(names, f"{place}.joints", None, lambda name, where: _name_in(name, where, joints))
        return LegOfProof(places, count(cut, f"{place}.cut"))

    return items(value, where, None, leg)


def _second_order(value: Any, joints: dict[str, int], freedoms: dict[str, int]) -> SecondOrder:
    keys = ("argument", "least", "most", "platform_least", "platform_most", "dependencies", "above", "below")
    word, *bounds, dependencies, above, below = entries(value, "finite", keys)
    choice(word, "finite.argument", ("second-order", "higher-order"))
    least, most, lower, upper = (count(x, f"finite.{key}") for key, x in zip(keys[1:5], bounds, strict=True))
    why, section, degree, series = entries(above, "finite.above", ("argument", "section", "degree", "series"))
    choice(why, "finite.above.argument", ABOVE)
    cut, terms = _vectors(section, "finite.above.section"), _vectors(series, "finite.above.series")
    number = count(degree, "finite.above.degree")
    fits = 2 <= number <= MOST_DEGREE if why in ("cone", "order") else number == 0
    if not fits or bool(cut) != (why == "cone") or len(terms) != (number - 1 if why == "order" else 0):
        raise malformed("finite.above: not the parts of the argument")
    known = _vectors(dependencies, "finite.dependencies")
    found = SecondOrder(word, least, most, lower, upper, known, why, cut, number, terms)
    if below is not None:
        found = _with_below(found, below, joints, freedoms)
    if (word == "higher-order") != (found.above == "order" or found.below == "curve"):
        raise malformed("finite.argument: not that of its parts")
    return found


def _with_below(found: SecondOrder, value: Any, joints: dict[str, int], freedoms: dict[str, int]) -> SecondOrder:
    how, locked, legs, vectors, curve = entries(
        value, "finite.below", ("argument", "locked", "legs", "vectors", "curve")
    )
    choice(how, "finite.below.argument", BELOW)
    shut, read = _names(locked, "finite.below.locked", freedoms), _legs(legs, "finite.below.legs", joints)
    signs, path = _vectors(vectors, "finite.below.vectors"), items(curve, "finite.below.curve", None, _half)
    fits = bool(read) == (how == "subgroups") and len(signs) == 2 * (how == "indefinite")
    if not fits or bool(path) != (how == "curve") or (shut and (signs or path)):
        raise malformed("finite.below: not the parts of the argument")
    return replace(found, below=how, locked=shut, legs=read, vectors=signs, curve=path)


def _half(value: Any, where: str) -> tuple[Vector, ...]:
    found = items(value, where, 2, lambda x, place: items(x, place, None, rational))
    if not all(1 <= len(part) <= MOST_DEGREE for part in found):
        raise malformed(f"{where}: not 1 to {MOST_DEGREE} coefficients")
    return found


def _vectors(value: Any, where: str) -> tuple[Vector, ...]:
    return items(value, where, None, lambda x, place: items(x, place, None, rational))


# Version 3


def _of_the_ideal(value: Any, joints: dict[str, int], freedoms: dict[str, int]) -> SecondOrder:
    keys = ("argument", "least", "most", "platform_least", "platform_most", "dependencies", "above", "below")
    word, *bounds, dependencies, above, below = entries(value, "finite", keys)
    choice(word, "finite.argument", ("ideal",))
    least, most, lower, upper = (count(x, f"finite.{key}") for key, x in zip(keys[1:5], bounds, strict=True))
    why, section, degree = entries(above, "finite.above", ("argument", "section", "degree"))
    choice(why, "finite.above.argument", OF_THE_IDEAL[0])
    cut, number = _vectors(section, "finite.above.section"), count(degree, "finite.above.degree")
    is_cut = why in ("cone", "local")
    if bool(cut) != is_cut or not (2 <= number <= MOST_DEGREE if is_cut else number == 0):
        raise malformed("finite.above: not the parts of the argument")
    known = _vectors(dependencies, "finite.dependencies")
    found = SecondOrder(word, least, most, lower, upper, known, why, cut, number, ())
    if below is not None:
        found = _with_curves(found, below, joints, freedoms)
    if found.above != "local" and found.below != "curves":
        raise malformed("finite.argument: not that of its parts")
    return found


def _with_curves(found: SecondOrder, value: Any, joints: dict[str, int], freedoms: dict[str, int]) -> SecondOrder:
    how, locked, legs, vectors, curves = entries(
        value, "finite.below", ("argument", "locked", "legs", "vectors", "curves")
    )
    choice(how, "finite.below.argument", OF_THE_IDEAL[1])
    shut, read = _names(locked, "finite.below.locked", freedoms), _legs(legs, "finite.below.legs", joints)
    signs, paths = _vectors(vectors, "finite.below.vectors"), items(curves, "finite.below.curves", None, _curve)
    fits = bool(read) == (how == "subgroups") and len(signs) == 2 * (how == "indefinite")
    if not fits or bool(paths) != (how == "curves") or (shut and (signs or paths)):
        raise malformed("finite.below: not the parts of the argument")
    return replace(found, below=how, locked=shut, legs=read, vectors=signs, curves=paths)


def _curve(value: Any, where: str) -> Curve:
    relation, halves = entries(value, where, ("relation", "halves"))
    read = _sheets(relation, f"{where}.relation")
    if len(read) < 2 or not any(read[-1]):
        raise malformed(f"{where}.relation: not a polynomial with u")
    return Curve(read, items(halves, f"{where}.halves", None, _half_of_curve))


def _half_of_curve(value: Any, where: str) -> tuple[tuple[Vector, ...], Vector]:
    numerator, denominator = items(value, where, 2, lambda part, _: part)
    return _sheets(numerator, f"{where}[1]"), _polynomial(denominator, f"{where}[2]")


def _sheets(value: Any, where: str) -> tuple[Vector, ...]:
    found = items(value, where, None, _polynomial)
    if not 1 <= len(found) <= MOST_DEGREE:
        raise malformed(f"{where}: not 1 to {MOST_DEGREE} polynomials")
    return found


def _polynomial(value: Any, where: str) -> Vector:
    found = items(value, where, None, rational)
    if not 1 <= len(found) <= MOST_DEGREE:
        raise malformed(f"{where}: not 1 to {MOST_DEGREE} coefficients")
    return found

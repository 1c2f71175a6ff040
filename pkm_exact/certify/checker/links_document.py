"""The content of a certificate of a mechanism with passive bodies, as typed values; nothing in it is believed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

from pkm_exact.certify.checker.document import read_metric
from pkm_exact.certify.checker.mechanism_document import MOST_CONSTRAINTS, read_constraint
from pkm_exact.certify.checker.mechanism_forms import GROUPS, Constraint
from pkm_exact.certify.checker.spelling import choice, count, entries, hexadecimal, integer, items, text
from pkm_exact.certify.checker.study_motion import Metric
from pkm_exact.certify.checker.system_document import SystemDocument, read_system_document
from pkm_exact.certify.checker.system_terms import MAX_VARIABLES
from pkm_exact.certify.checker.verdict import MAX_BOX_EXPONENT, malformed, too_large

SYSTEM: Final = ("pkm_exact system certificate", 1)
METHODS: Final = ("exact", "krawczyk")
MOST_BODIES: Final = 32
LARGEST_RADIUS: Final = 10**9
_KEYS: Final = ("format", "version", "mechanism", "configuration", "method", "system", "box", "notes")
_MECHANISM: Final = ("name", "unit", "source", "planar", "platform", "bodies", "joined")
_IN_A_METRIC: Final = ("name", "unit", "source", "planar", "metric", "platform", "bodies", "joined")
_ORDINARY: Final = (1, 1, 1)
_IN_THE_PLANE: Final = ("planar", "translation")


@dataclass(frozen=True)
class Unknowns:
    """Names of the unknowns of a body: of its position by axes, of its turn, or of its rotation by rows."""

    position: tuple[str | None, ...]
    turn: tuple[str, ...]
    rotation: tuple[tuple[str, ...], ...]

    @property
    def names(self) -> list[str]:
        """All, in their order."""
        entries_of_rotation = [name for row in self.rotation for name in row]
        return [*(name for name in self.position if name is not None), *self.turn, *entries_of_rotation]


@dataclass(frozen=True)
class Joined:
    """A constraint between two bodies; ``is_point`` if it joins two points."""

    first: int
    second: int
    constraint: Constraint
    is_point: bool


@dataclass(frozen=True)
class Box:
    """All points within ``radius`` units of the centre, a unit being 2^-exponent."""

    exponent: int
    radius: int
    centre: tuple[int, ...]


@dataclass(frozen=True)
class LinksDocument:
    """What a certificate says."""

    metric: Metric
    bodies: tuple[Unknowns, ...]
    joined: tuple[Joined, ...]
    variables: tuple[str, ...] | None
    system: SystemDocument | None
    box: Box | None

    @property
    def names(self) -> list[str]:
        """The unknowns of all bodies."""
        return [name for body in self.bodies for name in body.names]


def read_links(body: dict[str, Any]) -> LinksDocument:
    """The content of a certificate whose digest has been looked at, or a refusal."""
    values = dict(zip(_KEYS, entries(body, "certificate", _KEYS), strict=True))
    text(values["configuration"], "configuration")
    items(values["notes"], "notes", None, text)
    metric, bodies, joined = _mechanism(values["mechanism"], is_ordinary=values["version"] == 1)
    names = [name for unknowns in bodies for name in unknowns.names]
    if len(names) > MAX_VARIABLES:
        raise too_large(f"mechanism: more than {MAX_VARIABLES} unknowns")
    is_exact = choice(values["method"], "method", METHODS) == "exact"
    system, box = values["system"], values["box"]
    if (system is not None) != is_exact or (box is not None) == is_exact:
        raise malformed("method: system and box are not those of the method")
    return LinksDocument(
        metric,
        bodies,
        joined,
        None if system is None else tuple(_variables(system)),
        None if system is None else read_system_document(system),
        None if box is None else _box(box, len(names)),
    )


def _variables(system: Any) -> list[str]:
    """The variables of a system, whose format is looked at here."""
    is_one = isinstance(system, dict) and (system.get("format"), system.get("version")) == SYSTEM
    if not is_one or type(system["version"]) is not int:
        raise malformed(f"system: not a {SYSTEM[0]}, version {SYSTEM[1]}")
    return list(items(system.get("variables"), "variables", None, text))


def _mechanism(value: Any, *, is_ordinary: bool) -> tuple[Metric, tuple[Unknowns, ...], tuple[Joined, ...]]:
    """The metric is that of version 2; version 1 has none."""
    name, unit, source, planar, *between, platform, bodies, joined = entries(
        value, "mechanism", _MECHANISM if is_ordinary else _IN_A_METRIC
    )
    metric = _ORDINARY if is_ordinary else read_metric(between[0], "mechanism.metric")
    for label, word in (("name", name), ("unit", unit), ("source", source)):
        text(word, f"mechanism.{label}")
    if type(planar) is not bool:
        raise malformed("mechanism.planar: neither true nor false")
    for key, rows, most in (("bodies", bodies, MOST_BODIES), ("joined", joined, MOST_CONSTRAINTS)):
        if isinstance(rows, list) and not 1 <= len(rows) <= most:
            raise malformed(f"mechanism.{key}: not 1 to {most}")
    motions = items(bodies, "mechanism.bodies", None, lambda entry, where: _motion(entry, where, planar))
    if not 1 <= integer(platform, "mechanism.platform") <= len(motions):
        raise malformed("mechanism.platform: not the number of a body")
    read = items(joined, "mechanism.joined", None, lambda entry, where: _joined(entry, where, len(motions), metric))
    return metric, tuple(_unknowns(k, motion, planar) for k, motion in enumerate(motions, 1)), read


def _motion(value: Any, where: str, planar: bool) -> str:
    name, motion = entries(value, where, ("name", "motion"))
    text(name, f"{where}.name")
    return choice(motion, f"{where}.motion", _IN_THE_PLANE if planar else tuple(GROUPS))


def _unknowns(number: int, motion: str, planar: bool) -> Unknowns:
    axes = "" if motion == "spherical" else "xy" if planar or motion == "planar" else "xyz"
    position = tuple(f"{axis}{number}" if axis in axes else None for axis in "xyz")
    turn = (f"c{number}", f"s{number}") if motion in ("planar", "schoenflies") else ()
    free = motion in ("spatial", "spherical")
    rotation = tuple(tuple(f"r{number}_{i}{j}" for j in (1, 2, 3)) for i in (1, 2, 3)) if free else ()
    return Unknowns(position, turn, rotation)


def _joined(value: Any, where: str, bodies: int, metric: Metric) -> Joined:
    pair, constraint = entries(value, where, ("bodies", "constraint"))
    first, second = items(pair, f"{where}.bodies", 2, count)
    if not (first <= bodies and 1 <= second <= bodies and first != second):
        raise malformed(f"{where}.bodies: not two bodies, the second not the ground")
    read = read_constraint(constraint, f"{where}.constraint", metric)
    return Joined(first, second, read, constraint["type"] == "at-point")


def _box(value: Any, size: int) -> Box:
    exponent, radius, centre = entries(value, "box", ("exponent", "radius", "centre"))
    if count(exponent, "box.exponent") > MAX_BOX_EXPONENT:
        raise too_large(f"box.exponent: more than {MAX_BOX_EXPONENT}")
    if not 1 <= integer(radius, "box.radius") <= LARGEST_RADIUS:
        raise malformed(f"box.radius: not from 1 to {LARGEST_RADIUS}")
    return Box(exponent, radius, items(centre, "box.centre", size, hexadecimal))

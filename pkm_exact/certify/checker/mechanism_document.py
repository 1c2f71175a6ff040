"""The content of a certificate of version 2, read into typed values; nothing in it is believed.

The forms that it spells out for each constraint are computed from the constraint's data, and must be those.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from types import MappingProxyType
from typing import Any, Final, TypeAlias

from flint import fmpz_poly

from pkm_exact.certify.checker.document import (
    CLAIMS,
    METHODS,
    ListedPose,
    Representation,
    check_labels,
    check_unproved,
    read_box_exponent,
    read_boxes,
    read_metric,
    read_point,
    read_polynomial,
    read_pose,
    read_representation,
    read_step,
)
from pkm_exact.certify.checker.elimination import Row
from pkm_exact.certify.checker.krawczyk import Isolated
from pkm_exact.certify.checker.mechanism_forms import (
    GROUPS,
    SIZE,
    Constraint,
    Form,
    Mechanism,
    angle,
    at_point,
    axis_distance,
    carries,
    distance,
    in_plane,
    linear,
    on_line,
)
from pkm_exact.certify.checker.spelling import (
    choice,
    count,
    entries,
    integer,
    items,
    positive,
    rational,
    rational_as_text,
    text,
)
from pkm_exact.certify.checker.study_motion import Metric, Point
from pkm_exact.certify.checker.verdict import malformed, rejected

ROUTES: Final = ("refined-bezout", "product-bound", "modular-rank", "counting-at-infinity", "exact-elimination")
CAUSES: Final = ("dependent-forms", "symmetry", "equal-legs", "more-poses-than-bound")
MOST_CONSTRAINTS: Final = 64
_FORM_DIGITS: Final = 4000
"""Of a coefficient of a form, which is made of several numbers of 600."""

_KEYS: Final = (
    "format",
    "version",
    "robot",
    "configuration",
    "formulation",
    "method",
    "claim",
    "completeness_route",
    "complex_solutions",
    "distinct_solutions",
    "real_poses",
    "representation",
    "infinity",
    "elimination",
    "self_motion",
    "krawczyk",
    "box_exponent",
    "poses",
    "notes",
)
_ROBOT: Final = ("name", "unit", "source", "motion", "metric", "constraints")
_INFINITY: Final = ("chart", "separating_form", "eliminant", "coordinates", "multiplicity")
_SELF_MOTION: Final = ("cause", "real", "forms", "slices")


@dataclass(frozen=True)
class Infinity:
    """Points at infinity, Z(t) / h'(t) at the roots t of h; and how often they are said to count."""

    chart: tuple[int, ...]
    separating_form: tuple[int, ...]
    eliminant: fmpz_poly
    coordinates: tuple[fmpz_poly, ...]
    multiplicity: int


@dataclass(frozen=True)
class Slice:
    """The poses at which the last further form has a constant value."""

    constant: Fraction
    representation: Representation


@dataclass(frozen=True)
class SelfMotion:
    """Why the poses form a set of positive dimension."""

    cause: str
    is_real: bool
    forms: tuple[Form, ...]
    slices: tuple[Slice, ...]


@dataclass(frozen=True)
class MechanismDocument:
    """What a certificate of version 2 says."""

    mechanism: Mechanism
    method: str
    claim: str
    route: str | None
    complex_solutions: int
    distinct_solutions: int
    real_poses: int
    representation: Representation | None
    infinity: Infinity | None
    elimination: tuple[tuple[Row, ...], ...] | None
    self_motion: SelfMotion | None
    isolated: Isolated | None
    box_exponent: int
    poses: tuple[ListedPose, ...]


def read_mechanism_document(body: dict[str, Any]) -> MechanismDocument:
    """The content of a certificate whose digest and version have been looked at, or a refusal."""
    values = dict(zip(_KEYS, entries(body, "certificate", _KEYS), strict=True))
    if values["configuration"] is not None:
        text(values["configuration"], "configuration")
    check_unproved(values["formulation"], values["notes"])

    def given(key: str, read: Callable[[Any], Any]) -> Any:
        return None if values[key] is None else read(values[key])

    mechanism = read_mechanism(values["robot"])
    return MechanismDocument(
        mechanism=mechanism,
        method=choice(values["method"], "method", METHODS),
        claim=choice(values["claim"], "claim", CLAIMS),
        route=given("completeness_route", lambda value: choice(value, "completeness_route", ROUTES)),
        complex_solutions=count(values["complex_solutions"], "complex_solutions"),
        distinct_solutions=count(values["distinct_solutions"], "distinct_solutions"),
        real_poses=count(values["real_poses"], "real_poses"),
        representation=given("representation", lambda value: read_representation(value, "representation")),
        infinity=given("infinity", _infinity),
        elimination=given("elimination", lambda value: items(value, "elimination", None, read_step)),
        self_motion=given("self_motion", _self_motion),
        isolated=given("krawczyk", lambda value: read_boxes(value, mechanism.bound)),
        box_exponent=read_box_exponent(values["box_exponent"]),
        poses=items(values["poses"], "poses", None, read_pose),
    )


def read_mechanism(value: Any) -> Mechanism:
    """The entry ``robot``: a group of motions, a metric and constraints."""
    name, unit, source, motion, metric, constraints = entries(value, "robot", _ROBOT)
    check_labels(name, unit, source)
    group = GROUPS[choice(motion, "robot.motion", tuple(GROUPS))]
    exact = read_metric(metric)
    if isinstance(constraints, list) and not 1 <= len(constraints) <= MOST_CONSTRAINTS:
        raise malformed(f"robot.constraints: not 1 to {MOST_CONSTRAINTS}")
    read = items(constraints, "robot.constraints", None, lambda entry, where: read_constraint(entry, where, exact))
    return Mechanism(group, exact, read)


def _direction(value: Any, where: str) -> Point:
    found = read_point(value, where)
    if not any(found):
        raise malformed(f"{where}: 0")
    return found


def _coefficients(value: Any, where: str) -> Form:
    return items(value, where, SIZE, rational)


def _form(value: Any, where: str) -> Form:
    return items(value, where, SIZE, partial(rational, digits=_FORM_DIGITS))


_Fields: TypeAlias = Mapping[str, Callable[[Any, str], Any]]

_TYPES: Final[Mapping[str, tuple[_Fields, Callable[..., Constraint]]]] = MappingProxyType(
    {
        "distance": ({"base": read_point, "platform": read_point, "length_squared": positive}, distance),
        "in-plane": ({"normal": _direction, "offset": rational, "platform": read_point}, in_plane),
        "carries": ({"normal": _direction, "offset": rational, "base": read_point}, carries),
        "on-line": ({"point": read_point, "direction": _direction, "platform": read_point}, on_line),
        "at-point": ({"point": read_point, "platform": read_point}, at_point),
        "angle": ({"base": _direction, "platform": _direction, "product": rational}, angle),
        "axis-distance": (
            {"point": read_point, "direction": _direction, "platform": read_point, "radius_squared": positive},
            axis_distance,
        ),
        "linear": ({"coefficients": _coefficients}, linear),
    }
)
"""The data of each type in their order, and the constraint that they make."""


def read_constraint(value: Any, where: str, metric: Metric) -> Constraint:
    kind = value.get("type") if isinstance(value, dict) else None
    fields, made = _TYPES[choice(kind, f"{where}.type", tuple(_TYPES))]
    name, _, *data, spelled = entries(value, where, ("name", "type", *fields, "forms"))
    text(name, f"{where}.name")
    read = [reader(entry, f"{where}.{key}") for (key, reader), entry in zip(fields.items(), data, strict=True)]
    constraint = made(metric, *read)
    written = [[rational_as_text(value) for value in form] for form in constraint.forms]
    # Otherwise it is said what is wrong with them, if it is not that they are others.
    if (spelled != written or _are_long(written)) and items(spelled, f"{where}.forms", None, _form) != constraint.forms:
        raise rejected(f"{where}: its forms are not those of its data")
    return constraint


def _are_long(forms: Sequence[Sequence[str]]) -> bool:
    return max((len(value) for form in forms for value in form), default=0) > _FORM_DIGITS


def _infinity(value: Any) -> Infinity:
    chart, form, eliminant, coordinates, multiplicity = entries(value, "infinity", _INFINITY)
    h = read_polynomial(eliminant, "infinity.eliminant")
    if h.degree() < 1:
        raise malformed("infinity.eliminant: constant")
    return Infinity(
        items(chart, "infinity.chart", SIZE - 1, integer),
        items(form, "infinity.separating_form", SIZE - 1, integer),
        h,
        items(coordinates, "infinity.coordinates", SIZE - 1, read_polynomial),
        count(multiplicity, "infinity.multiplicity"),
    )


def _self_motion(value: Any) -> SelfMotion:
    cause, is_real, forms, slices = entries(value, "self_motion", _SELF_MOTION)
    if not isinstance(is_real, bool):
        raise malformed("self_motion.real: neither true nor false")
    return SelfMotion(
        choice(cause, "self_motion.cause", CAUSES),
        is_real,
        items(forms, "self_motion.forms", None, _form),
        items(slices, "self_motion.slices", None, _slice),
    )


def _slice(value: Any, where: str) -> Slice:
    constant, representation = entries(value, where, ("constant", "representation"))
    return Slice(
        rational(constant, f"{where}.constant"), read_representation(representation, f"{where}.representation")
    )

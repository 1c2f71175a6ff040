"""The content of a certificate, read into typed values; nothing in it is believed."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

from flint import fmpz_poly

from pkm_exact.certify.checker.elimination import Row
from pkm_exact.certify.checker.krawczyk import Box, Isolated
from pkm_exact.certify.checker.spelling import (
    choice,
    count,
    entries,
    hexadecimal,
    integer,
    items,
    positive,
    rational,
    rational_texts,
    read_sealed,
    text,
)
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric, Point
from pkm_exact.certify.checker.verdict import (
    GREATEST_NUMBER,
    MAX_BOX_EXPONENT,
    MAX_DEGREE,
    MAX_ELIMINATION_ROWS,
    MAX_GRID_EXPONENT,
    malformed,
    rejected,
    too_large,
)

KINDS: Final = {"6-UPS": 6, "3-RPR": PLANAR_LEGS}
"""Kinds of robot, with their numbers of legs."""
FORMULATIONS: Final = re.compile(r"(?:SE3|AFD[1-6]|AFP[1-4])(?::[a-z0-9]{1,10})?", re.ASCII)
METHODS: Final = ("exact", "krawczyk")
CLAIMS: Final = (
    "complete",
    "not-proven-complete",
    "positive-dimensional-detected",
    "positive-dimensional-proved",
    "inconsistent",
)
ROUTES: Final = ("refined-bezout", "exact-elimination")

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
    "elimination",
    "krawczyk",
    "box_exponent",
    "poses",
    "notes",
)
_ROBOT: Final = ("name", "kind", "unit", "source", "metric", "base", "platform")
_REPRESENTATION: Final = ("chart", "separating_form", "eliminant", "quaternion", "translation")
_KRAWCZYK: Final = ("chart", "real", "complex")
_BOX: Final = ("exponents", "centre")
_POSE: Final = ("parameter", "position", "rotation", "quaternion", "multiplicity")

_PRODUCT: Final = re.compile(r"(?:0|[1-9][0-9]{0,5})(?: (?:[0-9]|1[0-5])){0,8}", re.ASCII)

Ends: TypeAlias = tuple[str, str]


@dataclass(frozen=True)
class Representation:
    """(e, f) = (E, F)(t) / h'(t) at the roots t of h: ``eliminant`` h, ``quaternion`` E, ``translation`` F."""

    chart: tuple[int, ...]
    separating_form: tuple[int, ...]
    eliminant: fmpz_poly
    quaternion: tuple[fmpz_poly, ...]
    translation: tuple[fmpz_poly, ...]


@dataclass(frozen=True)
class ListedPose:
    """A pose as it is listed: the ends of its intervals as texts; ``box`` is position, rotation, quaternion."""

    parameter: Ends | None
    box: tuple[Ends, ...]
    multiplicity: int | None


@dataclass(frozen=True)
class Document:
    """What a certificate says."""

    metric: Metric
    legs: tuple[Leg, ...]
    method: str
    claim: str
    route: str | None
    complex_solutions: int
    distinct_solutions: int
    real_poses: int
    representation: Representation | None
    elimination: tuple[tuple[Row, ...], ...] | None
    isolated: Isolated | None
    box_exponent: int
    poses: tuple[ListedPose, ...]


def read(data: bytes) -> Document:
    """The content of a certificate of version 1, or a refusal if it has not the shape of one."""
    return read_document(read_sealed(data))


def read_document(body: dict[str, Any]) -> Document:
    """The content of a certificate whose digest has been looked at."""
    (
        _,
        _,
        robot,
        configuration,
        formulation,
        method,
        claim,
        route,
        complex_solutions,
        distinct_solutions,
        real_poses,
        representation,
        elimination,
        krawczyk,
        box_exponent,
        poses,
        notes,
    ) = entries(body, "certificate", _KEYS)
    metric, base, platform = read_robot(robot)
    check_unproved(formulation, notes)
    return Document(
        metric=metric,
        legs=tuple(map(Leg, base, platform, read_lengths_squared(configuration, len(base)))),
        method=choice(method, "method", METHODS),
        claim=choice(claim, "claim", CLAIMS),
        route=None if route is None else choice(route, "completeness_route", ROUTES),
        complex_solutions=count(complex_solutions, "complex_solutions"),
        distinct_solutions=count(distinct_solutions, "distinct_solutions"),
        real_poses=count(real_poses, "real_poses"),
        representation=None if representation is None else read_representation(representation, "representation"),
        elimination=None if elimination is None else items(elimination, "elimination", None, read_step),
        isolated=None if krawczyk is None else read_boxes(krawczyk, GREATEST_NUMBER),
        box_exponent=read_box_exponent(box_exponent),
        poses=items(poses, "poses", None, read_pose),
    )


def check_unproved(formulation: Any, notes: Any) -> None:
    """Look at the shape of what is there for people and programs, and of which nothing is proved."""
    if not FORMULATIONS.fullmatch(text(formulation, "formulation")):
        raise malformed("formulation: not the code of one")
    items(notes, "notes", None, text)


def read_box_exponent(value: Any) -> int:
    """The exponent of the grid of the poses' boxes."""
    exponent = count(value, "box_exponent")
    if exponent > MAX_BOX_EXPONENT:
        raise too_large(f"box_exponent: more than {MAX_BOX_EXPONENT}")
    return exponent


def read_robot(value: Any) -> tuple[Metric, tuple[Point, ...], tuple[Point, ...]]:
    """Metric, base joints and platform joints."""
    name, kind, unit, source, metric, base, platform = entries(value, "robot", _ROBOT)
    check_labels(name, unit, source)
    number = KINDS[choice(kind, "robot.kind", tuple(KINDS))]
    g = read_metric(metric)
    joints = (items(base, "robot.base", number, read_point), items(platform, "robot.platform", number, read_point))
    if number == PLANAR_LEGS and any(joint[2] for side in joints for joint in side):
        raise malformed("robot: a joint of a planar robot has a third coordinate other than 0")
    if number == PLANAR_LEGS and g[2] != 1:
        raise malformed("robot.metric: the third of a planar robot is not 1")
    return g, *joints


def check_labels(name: Any, unit: Any, source: Any) -> None:
    """Look at the shape of the texts that say which robot it is."""
    for label, content in (("name", name), ("unit", unit), ("source", source)):
        text(content, f"robot.{label}")


def read_metric(value: Any, where: str = "robot.metric") -> Metric:
    """Three positive integers."""
    g = items(value, where, 3, positive)
    if any(number.denominator != 1 for number in g):
        raise malformed(f"{where}: not three integers")
    return int(g[0]), int(g[1]), int(g[2])


def read_point(value: Any, where: str) -> Point:
    """Three rational numbers."""
    x, y, z = items(value, where, 3, rational)
    return x, y, z


def read_lengths_squared(value: Any, number: int) -> tuple[Any, ...]:
    """The squared leg lengths of a configuration."""
    name, lengths_squared = entries(value, "configuration", ("name", "lengths_squared"))
    if name is not None:
        text(name, "configuration.name")
    return items(lengths_squared, "configuration.lengths_squared", number, positive)


def read_representation(value: Any, where: str) -> Representation:
    """A univariate representation of poses."""
    chart, form, eliminant, quaternion, translation = entries(value, where, _REPRESENTATION)
    h = read_polynomial(eliminant, f"{where}.eliminant")
    if h.degree() < 1:
        raise malformed(f"{where}.eliminant: constant")
    return Representation(
        chart=items(chart, f"{where}.chart", 4, integer),
        separating_form=items(form, f"{where}.separating_form", 8, integer),
        eliminant=h,
        quaternion=items(quaternion, f"{where}.quaternion", 4, read_polynomial),
        translation=items(translation, f"{where}.translation", 4, read_polynomial),
    )


def read_polynomial(value: Any, where: str) -> fmpz_poly:
    """A polynomial by its coefficients, lowest degree first."""
    if isinstance(value, list) and len(value) > MAX_DEGREE + 1:
        raise too_large(f"{where}: degree above {MAX_DEGREE}")
    coefficients = items(value, where, None, hexadecimal)
    if coefficients and coefficients[-1] == 0:
        raise malformed(f"{where}: the coefficient of highest degree is 0")
    return fmpz_poly(list(coefficients))


def read_step(value: Any, where: str) -> tuple[Row, ...]:
    """The products of a step of an elimination."""
    if isinstance(value, list) and len(value) > MAX_ELIMINATION_ROWS:
        raise too_large(f"{where}: more than {MAX_ELIMINATION_ROWS} products")
    return items(value, where, None, _product)


def _product(value: Any, where: str) -> Row:
    if not _PRODUCT.fullmatch(text(value, where)):
        raise malformed(f"{where}: not the index of an element and those of the unknowns that multiply it")
    index, *factors = map(int, value.split(" "))
    if factors != sorted(factors):
        raise malformed(f"{where}: the unknowns are not in increasing order")
    return index, tuple(factors)


def read_boxes(value: Any, most: int) -> Isolated:
    """Boxes with one solution each, which are no more than ``most``."""
    chart, real, pairs = entries(value, "krawczyk", _KRAWCZYK)
    if all(isinstance(boxes, list) for boxes in (real, pairs)) and len(real) + 2 * len(pairs) > most:
        raise rejected(f"boxes: more than {most} solutions, all that there can be")
    return Isolated(
        items(chart, "krawczyk.chart", 4, integer),
        items(real, "krawczyk.real", None, lambda box, where: _box(box, where, real=True)),
        items(pairs, "krawczyk.complex", None, lambda box, where: _box(box, where, real=False)),
    )


def _box(value: Any, where: str, *, real: bool) -> Box:
    exponents, centre = entries(value, where, _BOX)
    grid = items(exponents, f"{where}.exponents", 2, count)
    if max(grid) > MAX_GRID_EXPONENT:
        raise too_large(f"{where}.exponents: more than {MAX_GRID_EXPONENT}")
    if real:
        parts = tuple((part, 0) for part in items(centre, f"{where}.centre", 8, hexadecimal))
    else:
        parts = items(centre, f"{where}.centre", 8, _complex)
    if max(abs(part).bit_length() for pair in parts for part in pair) > 2 * MAX_GRID_EXPONENT:
        raise too_large(f"{where}.centre: a coordinate of more than {2 * MAX_GRID_EXPONENT} bits")
    return Box((grid[0], grid[1]), parts, real)


def _complex(value: Any, where: str) -> tuple[int, int]:
    real, imaginary = items(value, where, 2, hexadecimal)
    return real, imaginary


def read_pose(value: Any, where: str) -> ListedPose:
    """A pose as it is listed."""
    parameter, position, rotation, quaternion, multiplicity = entries(value, where, _POSE)
    rows = items(rotation, f"{where}.rotation", 3, lambda row, place: items(row, place, 3, _ends))
    box = (
        *items(position, f"{where}.position", 3, _ends),
        *(entry for row in rows for entry in row),
        *items(quaternion, f"{where}.quaternion", 4, _ends),
    )
    return ListedPose(
        None if parameter is None else _ends(parameter, f"{where}.parameter"),
        box,
        None if multiplicity is None else count(multiplicity, f"{where}.multiplicity"),
    )


def _ends(value: Any, where: str) -> Ends:
    low, high = rational_texts(value, where, 2)
    return low, high

"""The content of a tolerance certificate, read into typed values; nothing in it is believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.checker.document import read_lengths_squared, read_point, read_robot
from pkm_exact.certify.checker.spelling import (
    count,
    entries,
    hexadecimal,
    integer,
    items,
    positive,
    rational,
)
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric
from pkm_exact.certify.checker.verdict import malformed, too_large

DEGREES: Final = {False: 40, True: 6}
"""Degree of the variety of rigid motions, and of planar ones (key: planar)."""
MAX_EXPONENT: Final = 4096
MAX_CENTRE_BITS: Final = 256
"""Bits before the point of a coordinate of a centre, in units of the robot's size."""
MAX_WEIGHT: Final = 10**6
_KEYS: Final = (
    "format",
    "version",
    "robot",
    "configuration",
    "tolerances",
    "frames",
    "exponent",
    "boxes",
    "unproved",
    "pairs",
    "complete",
)
_PLACE: Final = ("chart", "centre", "outer")
_BOUNDS: Final = ("position", "rotation", "quaternion", "centroid")
_BOX: Final = ("pose", *_PLACE, "inner", *_BOUNDS, "position_error", "rotation_error")


@dataclass(frozen=True)
class Place:
    """A box: chart, centre and half widths in units of the grid."""

    chart: tuple[tuple[int, int], ...]
    centre: tuple[tuple[int, int], ...]
    outer: tuple[int, ...]


@dataclass(frozen=True)
class PoseBox:
    """A box of a real pose, and the bounds claimed of the pose."""

    pose: int
    place: Place
    inner: tuple[int, ...]
    components: tuple[tuple[Fraction, Fraction], ...]
    position_error: Fraction
    rotation_error: Fraction


@dataclass(frozen=True)
class ToleranceDocument:
    """What a tolerance certificate says."""

    metric: Metric
    legs: tuple[Leg, ...]
    tolerances: tuple[Fraction, ...]
    origins: tuple[tuple[Fraction, ...], ...]
    unit: Fraction
    exponent: int
    boxes: tuple[PoseBox, ...]
    unproved: tuple[int, ...]
    pairs: tuple[Place, ...]
    complete: bool


def read_tolerances(body: dict[str, Any]) -> ToleranceDocument:
    """The content of a tolerance certificate, or a refusal if it has not the shape of one."""
    _, _, robot, configuration, tolerances, frames, exponent, boxes, unproved, pairs, complete = entries(
        body, "certificate", _KEYS
    )
    metric, base, platform = read_robot(robot)
    squares = read_lengths_squared(configuration, len(base))
    limits = entries(tolerances, "tolerances", ("base", "platform", "lengths"))
    bounds = items(limits, "tolerances", 3, rational)
    if min(bounds) < 0:
        raise malformed("tolerances: negative")
    first, second, unit = entries(frames, "frames", ("base", "platform", "unit"))
    origins = read_point(first, "frames.base"), read_point(second, "frames.platform")
    if type(complete) is not bool:
        raise malformed("complete: neither true nor false")
    grid = count(exponent, "exponent")
    if grid > MAX_EXPONENT:
        raise too_large(f"exponent: more than {MAX_EXPONENT}")
    planar = len(base) == PLANAR_LEGS
    if planar and any(origin[2] for origin in origins):
        raise malformed("frames: an origin of a planar robot has a third coordinate other than 0")
    for name, value in (("boxes", boxes), ("pairs", pairs), ("unproved", unproved)):
        if isinstance(value, list) and len(value) > DEGREES[planar]:
            raise malformed(f"{name}: more than {DEGREES[planar]}")
    size = 4 if planar else 8
    document = ToleranceDocument(
        metric,
        tuple(map(Leg, base, platform, squares)),
        bounds,
        origins,
        positive(unit, "frames.unit"),
        grid,
        items(boxes, "boxes", None, lambda value, where: _pose_box(value, where, size)),
        items(unproved, "unproved", None, count),
        items(pairs, "pairs", None, lambda value, where: _place(entries(value, where, _PLACE), where, size)),
        complete,
    )
    places = [*(box.place for box in document.boxes), *document.pairs]
    parts = (abs(part) for place in places for pair in place.centre for part in pair)
    if max(parts, default=0).bit_length() > grid + MAX_CENTRE_BITS:
        raise too_large(f"centre: a coordinate of more than 2^{MAX_CENTRE_BITS}")
    if planar and any(any(place.chart[1] + place.chart[2]) for place in places):
        raise malformed("chart: a weight for a coordinate that is 0 for every pose of a planar robot")
    return document


def _pose_box(value: Any, where: str, size: int) -> PoseBox:
    pose, chart, centre, outer, inner, *bounds, distance, angle = entries(value, where, _BOX)
    position, rotation, quaternion, centroid = bounds
    turned = items(rotation, f"{where}.rotation", 3, lambda row, place: items(row, place, 3, _ends))
    return PoseBox(
        count(pose, f"{where}.pose"),
        _place([chart, centre, outer], where, size),
        items(inner, f"{where}.inner", size, _radius),
        (
            *items(position, f"{where}.position", 3, _ends),
            *(entry for row in turned for entry in row),
            *items(quaternion, f"{where}.quaternion", 4, _ends),
            *items(centroid, f"{where}.centroid", 3, _ends),
        ),
        positive(distance, f"{where}.position_error"),
        positive(angle, f"{where}.rotation_error"),
    )


def _place(values: Sequence[Any], where: str, size: int) -> Place:
    chart, centre, outer = values
    return Place(
        items(chart, f"{where}.chart", 4, lambda pair, place: _pair(pair, place, _weight)),
        items(centre, f"{where}.centre", size, lambda pair, place: _pair(pair, place, _grid_number)),
        items(outer, f"{where}.outer", size, _radius),
    )


def _pair(value: Any, where: str, read_entry: Any) -> tuple[int, int]:
    real, imaginary = items(value, where, 2, read_entry)
    return real, imaginary


def _weight(value: Any, where: str) -> int:
    number = integer(value, where)
    if abs(number) > MAX_WEIGHT:
        raise too_large(f"{where}: more than {MAX_WEIGHT}")
    return number


def _grid_number(value: Any, where: str) -> int:
    number = hexadecimal(value, where)
    if number.bit_length() > 2 * MAX_EXPONENT:
        raise too_large(f"{where}: more than {2 * MAX_EXPONENT} bits")
    return number


def _radius(value: Any, where: str) -> int:
    number = _grid_number(value, where)
    if number <= 0:
        raise malformed(f"{where}: not positive")
    return number


def _ends(value: Any, where: str) -> tuple[Fraction, Fraction]:
    low, high = items(value, where, 2, rational)
    if low > high:
        raise malformed(f"{where}: ends out of order")
    return low, high

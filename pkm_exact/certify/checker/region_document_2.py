"""Region certificates of version 2: what they say beside what version 1 says."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import combinations, pairwise
from typing import Any, Final

from pkm_exact.certify.checker.region_document import (
    CHART,
    CONDITIONS,
    KEYS,
    LEG,
    REGULAR,
    ROBOT,
    LegEntry,
    RegionDocument,
    Tube,
    Vector,
    read_pair,
    read_region,
    read_vector,
)
from pkm_exact.certify.checker.region_parameters import read_parameters, require_varied, varied_joints
from pkm_exact.certify.checker.spelling import entries, items, positive, rational
from pkm_exact.certify.checker.verdict import malformed, rejected, too_large

MOST_CORNERS: Final = 64
MOST_POWERS: Final = 5
ALONG: Final = "along"
_KEYS: Final = (*KEYS[:5], "tube", "joints", "directions", *KEYS[5:-1], "member", KEYS[-1])
_CHART: Final = (*CHART[:3], "path", *CHART[3:], "parameters")


def read_region_2(body: dict[str, Any]) -> RegionDocument:
    """The content of a region certificate of version 2, or a refusal if it has not the shape of one."""
    values = dict(zip(_KEYS, entries(body, "certificate", _KEYS), strict=True))
    robot = dict(zip((*ROBOT, "leg_distance"), entries(body["robot"], "robot", (*ROBOT, "leg_distance")), strict=True))
    chart = dict(zip(_CHART, entries(body["chart"], "chart", _CHART), strict=True))
    least, path = robot.pop("leg_distance"), _path(chart.pop("path"))
    parameters = read_parameters(chart.pop("parameters"))
    split = items(robot["legs"], "robot.legs", None, _split)
    robot["legs"], axes = [leg for leg, _ in split], [axis for _, axis in split]
    asked, by_matrix = _conditions(values["conditions"])
    plain = {key: values[key] for key in KEYS} | {"robot": robot, "chart": chart, "conditions": asked}
    names = tuple(f"p{k}" for k in range(1, len(parameters) + 1))
    found = read_region(plain, () if path is None else (ALONG,), names)
    member = items(values["member"], "member", None, rational)
    if len(member) != (len(found.variables) if found.claim in ("all", "designs") else 0):
        raise malformed("member: not a value for each variable where the claim is all or designs, or some elsewhere")
    document = replace(
        found,
        legs=tuple(replace(leg, axis=axis) for leg, axis in zip(found.legs, axes, strict=True)),
        leg_distance=None if least is None else positive(least, "robot.leg_distance"),
        path=path,
        tube=_tube(values["tube"]),
        joints=items(values["joints"], "joints", None, read_pair),
        directions=items(values["directions"], "directions", None, _direction),
        member=member,
        parameters=parameters,
        by_matrix=by_matrix,
    )
    if by_matrix and (path is not None or parameters):
        raise malformed("conditions: regular has neither a path nor parameters beside it")
    require_varied(document)
    _require_axes(document)
    _require_place(document)
    _require_joints(document)
    _require_directions(document)
    return document


def compared_pairs(document: RegionDocument) -> list[tuple[int, int]]:
    """The legs that must be apart: those that share no joint, if that is asked for."""
    if document.leg_distance is None or "limits" not in document.conditions:
        return []
    legs = [(leg, *varied_joints(document, k)) for k, leg in enumerate(document.legs)]
    return [(i, j) for i, j in combinations(range(len(legs)), 2) if not _share_a_joint(*legs[i], *legs[j])]


def _share_a_joint(one: LegEntry, base: Any, platform: Any, other: LegEntry, base_2: Any, platform_2: Any) -> bool:
    return bool(platform == platform_2 or (not one.axes and not other.axes and base == base_2))


def _conditions(value: object) -> tuple[object, bool]:
    """The conditions with no_type_2 in the place of regular, and whether that was there."""
    if not isinstance(value, list) or not value or value[-1] != REGULAR:
        return value, False
    return [*value[:-1], CONDITIONS[-1]], True


def _split(value: object, where: str) -> tuple[dict[str, Any], Vector | None]:
    """A leg of version 1, and its axis."""
    *others, axis = entries(value, where, (*LEG, "axis"))
    found = None if axis is None else read_vector(axis, f"{where}.axis")
    return dict(zip(LEG, others, strict=True)), found


def _path(value: object) -> tuple[Vector, ...] | None:
    if value is None:
        return None
    found = items(value, "chart.path", 4, lambda entry, where: items(entry, where, None, rational))
    if any(not 1 <= len(entry) <= MOST_POWERS for entry in found):
        raise malformed(f"chart.path: not 1 to {MOST_POWERS} coefficients")
    weight = found[0]
    if weight[0] <= 0 or any(x < 0 for x in weight) or any(weight[1::2]):
        raise malformed("chart.path: its denominator is not seen to be positive")
    return found


def _tube(value: object) -> Tube | None:
    if value is None:
        return None
    corners, radius = entries(value, "tube", ("corners", "radius"))
    found = items(corners, "tube.corners", None, read_vector)
    if len(found) > MOST_CORNERS:
        raise too_large(f"tube.corners: more than {MOST_CORNERS}")
    if len(found) < 2 or any(one == other for one, other in pairwise(found)):
        raise malformed("tube.corners: fewer than two, or neighbours are the same")
    return Tube(found, positive(radius, "tube.radius"))


def _direction(value: object, where: str) -> Vector | None:
    if value is None:
        return None
    found = items(value, where, 4, rational)
    if found[3] <= 0:
        raise malformed(f"{where}: the last number is not positive")
    return found


def _require_axes(document: RegionDocument) -> None:
    """Rods along an axis are moved across it, and have neither cones nor a distance."""
    for leg in document.legs:
        if leg.axis is None:
            continue
        if not any(leg.axis) or not leg.axes:
            raise malformed("robot.legs: an axis is 0, or that of a leg of its own length")
        for moved in leg.axes:
            if sum(g * a * b for g, a, b in zip(document.metric, leg.axis, moved, strict=True)) != 0:
                raise malformed("robot.legs: a slide or crank does not move across the axis of its rod")
        if document.base_cones or document.platform_cones or compared_pairs(document):
            raise malformed("robot.legs: a rod along an axis has neither cones nor a distance from others")


def _require_place(document: RegionDocument) -> None:
    """Path, tube and shape fit each other, and the motions of the robot."""
    path, tube, place = document.path, document.tube, document.place
    if (path is not None) + (tube is not None) + bool(document.shape) > 1:
        raise malformed("shape: there is one beside a path or a tube, or both of these")
    if path is not None:
        if any(x != 0 for x in place) or 0 not in document.twist:
            raise malformed("chart.path: there is a position beside it, or the robot does not move")
        if 2 not in document.twist and any(path[3]):
            raise malformed("chart.path: leaves the plane")
    if tube is not None:
        fixed = [(k, x) for k, x in enumerate(place) if isinstance(x, Fraction)]
        if any(corner[k] != x for corner in tube.corners for k, x in fixed):
            raise malformed("tube.corners: one is not where a coordinate is fixed")


def _require_joints(document: RegionDocument) -> None:
    if not document.joints:
        return
    if len(document.joints) != len(document.legs):
        raise malformed("joints: not as many as legs")
    for leg, (low, high), mode in zip(document.legs, document.joints, document.modes, strict=True):
        if not leg.axes and low < 0:
            raise malformed("joints: a length is negative")
        if leg.axes and not mode:
            raise malformed("modes: a working mode is needed and not named")
        if len(leg.axes) == 2 and (leg.weight != 1 or low % 90 != 0 or high % 90 != 0):
            raise malformed("joints: limits of a crank that are no multiples of 90 degrees")


def _require_directions(document: RegionDocument) -> None:
    pairs = compared_pairs(document)
    if len(document.directions) != len(pairs):
        raise malformed("directions: not one for every two legs that must be apart")
    if pairs and any(leg.axes and not mode for leg, mode in zip(document.legs, document.modes, strict=True)):
        raise malformed("modes: a working mode is needed and not named")
    for found in document.directions:
        if found is None:
            continue
        square = sum((c * c / g for c, g in zip(found, document.metric, strict=False)), Fraction(0))
        if found[3] ** 2 < square:
            raise malformed("directions: the last number is less than the length of the others")


def require_held(document: RegionDocument) -> None:
    """The box holds all of the tube, so that this is connected, and meant as a whole."""
    if document.tube is None:
        return
    for name, (low, high) in zip(document.variables, document.box, strict=True):
        if name not in document.place:
            continue
        k = document.place.index(name)
        for corner in document.tube.corners:
            for room in (corner[k] - low, high - corner[k]):
                if room < 0 or document.metric[k] * room**2 < document.tube.radius**2:
                    raise rejected("tube: the box does not hold it")

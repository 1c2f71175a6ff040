"""Question files: TOML with the tables ``[region]``, ``[conditions]`` and ``[answer]`` (``docs/regions.md``)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import isqrt
from pathlib import Path
from typing import Any, Final

from flint import arb, fmpq

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, list_field, required
from pkm_exact.geometry.limits import Pair
from pkm_exact.geometry.rational import parse_positive, parse_rational
from pkm_exact.geometry.reader import parsed_toml
from pkm_exact.geometry.rotation_degrees import half_turn_pair, is_exact_turn
from pkm_exact.precision import working_precision
from pkm_exact.regions.answer_reader import read_answer
from pkm_exact.regions.chart import POSITIONS, TURNS, Arc, Chart, Line
from pkm_exact.regions.conditions_reader import read_conditions
from pkm_exact.regions.path_tubes import tube_about
from pkm_exact.regions.question_fields import dimension, read_numbers, read_pair
from pkm_exact.regions.region_conditions import Conditions
from pkm_exact.regions.region_legs import OnHinge, OwnLength, RegionMachine
from pkm_exact.regions.region_question import (
    RegionQuestion,
    WantedAnswer,
)
from pkm_exact.regions.region_shapes import Quadratic, in_model, polygon_shape, round_shape, side
from pkm_exact.wording import printable, shown

_TABLES: Final = ("region", "conditions", "answer")
_SHAPES: Final = ("position", "ball", "cylinder", "prism", "arc", "line", "tube")
_TURNED: Final = ("quaternion", "rpy_degrees", "degrees", "any_axis_degrees")
_MOST_CORNERS: Final = 64


def read_question(path: str | os.PathLike[str], machine: RegionMachine) -> RegionQuestion:
    """The question in a file, about a robot.

    Raises
    ------
    InputError
        With file, field, value and remedy.
    """
    name = os.fspath(path)
    try:
        text = Path(name).read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise InputError(f"{printable(name)}: is not UTF-8 text; save the question as UTF-8") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(f"{printable(name)}: cannot be read ({reason}); give the path of a question file") from None
    try:
        return question_from_toml(text, machine)
    except InputError as error:
        raise InputError(f"{printable(name)}: {error}") from None


def question_from_toml(text: str, machine: RegionMachine) -> RegionQuestion:
    """The question that a text asks."""
    table = parsed_toml(text)
    known_keys(table, _TABLES, "")
    for key in _TABLES:
        if not isinstance(table.get(key), dict):
            raise InputError(f"{key}: is missing or no table; write [{key}] and its keys below it")
    conditions = read_conditions(table["conditions"], machine)
    answer = read_answer(table["answer"], machine)
    region = table["region"]
    known_keys(region, (*_SHAPES, *_TURNED, "joints"), "region")
    if answer.kind == "largest":
        if given := [key for key in (*_SHAPES, "joints") if key in region]:
            raise InputError(f"region.{given[0]}: the answer largest has a shape of its own; remove it")
        largest = largest_question(_turned(region, machine), machine, conditions, answer, Fraction(1))
        return replace(largest, enlarged=largest.enlarged or _has_rounded_angles(region, machine))
    joints = _joints(region, machine, conditions, answer)
    question = _of_poses(region, machine, conditions, answer)
    return replace(question, joints=joints, enlarged=question.enlarged or _has_rounded_angles(region, machine))


def _has_rounded_angles(region: dict[str, Any], machine: RegionMachine) -> bool:
    """Whether an end of an interval of angles is rounded outward: the tangent of its half is not rational."""
    g, arc = machine.metric, region.get("arc")
    if isinstance(arc, dict) and any(parse_rational(end, "region.arc") % 90 for end in arc["degrees"]):
        return True
    turns = [(region.get("degrees"), g[0] * g[1])]
    turns += [(row, g[(k + 1) % 3] * g[(k + 2) % 3]) for k, row in enumerate(region.get("rpy_degrees", ()))]
    ends = [(parse_rational(end, "region"), w) for row, w in turns if isinstance(row, list) for end in row]
    return any(_half_tangent(end, w, -1) != _half_tangent(end, w, 1) for end, w in ends)


def _of_poses(
    region: dict[str, Any], machine: RegionMachine, conditions: Conditions, answer: WantedAnswer
) -> RegionQuestion:
    """The question about the poses of a region, whatever their joint values are."""
    if "arc" in region:
        return RegionQuestion(_on_arc(region, machine), (), conditions, answer)
    if "line" in region:
        return RegionQuestion(_on_line(region, machine), (), conditions, answer)
    if "tube" in region:
        return _in_tube(region, machine, conditions, answer)
    position, shape, enlarged = _shape(region, machine)
    any_axis = _any_axis(region, machine, answer)
    chart = _chart(position, _turned(region, machine))
    if not chart.variables and any_axis is None:
        raise InputError("region: is a single pose; give an interval for a coordinate, or ask `legs`")
    return RegionQuestion(chart, shape, conditions, answer, enlarged or any_axis is not None, any_axis)


def _joints(
    region: dict[str, Any], machine: RegionMachine, conditions: Conditions, answer: WantedAnswer
) -> tuple[Pair, ...]:
    """Between which joint values a region lies: of each leg, in degrees of cranks; nothing if none are given."""
    if "joints" not in region:
        return ()
    where, count = "region.joints", len(machine.legs)
    if answer.kind in ("locus", "designs"):
        raise InputError(f"{where}: does not go with the answer {answer.kind}; remove it")
    if "any_axis_degrees" in region:
        raise InputError(f"{where}: does not go with any_axis_degrees; give rpy_degrees")
    rows = list_field(region["joints"], where, count)
    if len(rows) != count:
        raise InputError(f"{where}: {len(rows)} pairs; give one for each of {count} legs: [[least, greatest], ..]")
    pairs = tuple(read_pair(row, f"{where}[{i}]") for i, row in enumerate(rows, 1))
    for leg, (low, _), mode in zip(machine.legs, pairs, conditions.modes, strict=True):
        if isinstance(leg.actuator, OnHinge):
            raise InputError(f"{where}: {leg.name} is driven at its hinge, whose values regions do not know")
        if isinstance(leg.actuator, OwnLength) and low < 0:
            raise InputError(f"{where}: {shown(low)} is negative; a length is 0 or more")
        if not isinstance(leg.actuator, OwnLength) and not mode:
            raise InputError(
                f"conditions.working_modes: {leg.name} has two working modes, and region.joints depends on them; give "
                'one sign for each leg, such as ["+", "+", "-"]'
            )
    return pairs


def _on_arc(region: dict[str, Any], machine: RegionMachine) -> Chart:
    """The chart of an arc of a circle in a horizontal plane, and of turns."""
    if given := [key for key in (*_SHAPES, "any_axis_degrees") if key in region and key != "arc"]:
        raise InputError(f"region.{given[0]}: given beside an arc; give one of them")
    table, where = region["arc"], "region.arc"
    if not isinstance(table, dict):
        raise InputError(
            f"{where}: {shown(table)} is not a table; write {{ center = [..], radius = r, degrees = [a, b] }}"
        )
    known_keys(table, ("center", "radius", "degrees"), where)
    if 0 not in machine.twist or set(machine.metric) != {1}:
        raise InputError(f"{where}: is for robots that move, in models without metric; give another shape")
    center = read_numbers(required(table, "center", f"{where}."), f"{where}.center", dimension(machine))
    radius = parse_positive(required(table, "radius", f"{where}."), f"{where}.radius")
    low, high = read_pair(required(table, "degrees", f"{where}."), f"{where}.degrees")
    quarter = round((low + high) / 180)
    start = 90 * quarter
    if not -180 < low - start < high - start < 180:
        raise InputError(f"{where}.degrees: {shown(low)} to {shown(high)} is too long; give two arcs")
    ends = _half_tangent(low - start, 1, -1), _half_tangent(high - start, 1, 1)
    u, v = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter % 4]
    height = center[2] if len(center) == 3 else Fraction(0)
    chart = _chart([Fraction(0), Fraction(0), height], _turned(region, machine))
    arc = Arc((center[0], center[1]), radius, (Fraction(u), Fraction(v)))
    return replace(chart, variables=("arc", *chart.variables), box=(ends, *chart.box), arc=arc)


def _on_line(region: dict[str, Any], machine: RegionMachine) -> Chart:
    """The chart of a straight way from one position to another, and of turns."""
    if given := [key for key in (*_SHAPES, "any_axis_degrees") if key in region and key != "line"]:
        raise InputError(f"region.{given[0]}: given beside a line; give one of them")
    table, where = region["line"], "region.line"
    if not isinstance(table, dict):
        raise InputError(f"{where}: {shown(table)} is not a table; write {{ from = [..], to = [..] }}")
    known_keys(table, ("from", "to"), where)
    if 0 not in machine.twist:
        raise InputError(f"{where}: the robot does not move; give angles alone")
    ends = []
    for key in ("from", "to"):
        place = read_numbers(required(table, key, f"{where}."), f"{where}.{key}", dimension(machine))
        if _is_irrational(place, machine.metric):
            raise InputError(f"{where}.{key}: is not rational in the model's metric; give a tube around the way")
        x, y, z = [in_model(c, g, 1) for c, g in zip((*place, Fraction(0))[:3], machine.metric, strict=True)]
        ends.append((x, y, z))
    (a, b, c), (u, v, w) = ends
    if ends[0] == ends[1]:
        raise InputError(f"{where}.to: is where it begins; give another position")
    chart, way = _chart([Fraction(0)] * 3, _turned(region, machine)), Line((a, b, c), (u - a, v - b, w - c))
    whole = (Fraction(0), Fraction(1))
    return replace(chart, variables=("along", *chart.variables), box=(whole, *chart.box), line=way)


def _in_tube(
    region: dict[str, Any], machine: RegionMachine, conditions: Conditions, answer: WantedAnswer
) -> RegionQuestion:
    """All poses near a path of straight pieces."""
    table, where = region["tube"], "region.tube"
    if given := [key for key in (*_SHAPES, "any_axis_degrees") if key in region and key != "tube"]:
        raise InputError(f"region.{given[0]}: given beside a tube; give one of them")
    if not isinstance(table, dict):
        raise InputError(f"{where}: {shown(table)} is not a table; write {{ path = [[..], [..]], radius = r }}")
    known_keys(table, ("path", "radius"), where)
    if 0 not in machine.twist:
        raise InputError(f"{where}: the robot does not move; give angles alone")
    rows = list_field(required(table, "path", f"{where}."), f"{where}.path", 2)
    if not 2 <= len(rows) <= _MOST_CORNERS:
        raise InputError(f"{where}.path: {len(rows)} points; give 2 to {_MOST_CORNERS}")
    corners = [read_numbers(row, f"{where}.path[{i}]", dimension(machine)) for i, row in enumerate(rows, 1)]
    for i, (one, other) in enumerate(pairwise(corners), 2):
        if one == other:
            raise InputError(f"{where}.path[{i}]: is the point before it; remove it")
    radius = parse_positive(required(table, "radius", f"{where}."), f"{where}.radius")
    tube, sides, is_wider = tube_about(corners, radius, machine.metric)
    chart = _chart(sides, _turned(region, machine))
    return RegionQuestion(chart, (), conditions, answer, is_wider, tube=tube)


def _any_axis(region: dict[str, Any], machine: RegionMachine, answer: WantedAnswer) -> Fraction | None:
    """The square of the tangent of half the greatest angle of a turn about any axis, rounded up."""
    if "any_axis_degrees" not in region:
        return None
    where = "region.any_axis_degrees"
    if answer.of != "joint_values" or machine.motion not in ("spatial", "spherical"):
        raise InputError(
            f"{where}: is for the answer extremes, of joint_values, of a robot that turns about every axis; give "
            "rpy_degrees"
        )
    angle = parse_positive(region["any_axis_degrees"], where)
    if angle >= 180:
        raise InputError(f"{where}: {shown(angle)} reaches 180 degrees; give less")
    return _half_tangent(angle, 1, 1) ** 2


def largest_question(
    turned: tuple[Any, Any], machine: RegionMachine, conditions: Conditions, answer: WantedAnswer, size: Fraction
) -> RegionQuestion:
    """Whether all of a cube or ball of a size is good: the edge, or the radius."""
    metric, about = machine.metric, answer.about
    if answer.shape == "ball":
        quadratic, sides = round_shape(about, size, metric)
        return RegionQuestion(
            _chart(list(sides), turned), (quadratic,), conditions, answer, _is_irrational(about, metric)
        )
    pairs = [side((c - size / 2, c + size / 2), g) for c, g in zip(about, metric, strict=False)]
    return RegionQuestion(_chart(list(pairs), turned), (), conditions, answer, not _has_roots(metric[: len(about)]))


def of_size(question: RegionQuestion, machine: RegionMachine, size: Fraction) -> RegionQuestion:
    """The same question about a cube or ball of another size."""
    chart = question.chart
    turns = [
        (chart.box[chart.variables.index(turn)], True) if isinstance(turn, str) else (turn, False)
        for turn in chart.turns
    ]
    found = largest_question((chart.quaternion, turns), machine, question.conditions, question.answer, size)
    return replace(found, enlarged=found.enlarged or question.enlarged)


def _has_roots(metric: Sequence[int]) -> bool:
    return all(isqrt(g) ** 2 == g for g in metric)


def _is_irrational(values: Sequence[Fraction], metric: Sequence[int]) -> bool:
    return any(value and isqrt(g) ** 2 != g for value, g in zip(values, metric, strict=False))


def _chart(position: Sequence[Any], turned: tuple[Any, Any]) -> Chart:
    quaternion, turns = turned
    variables, box, places = [], [], []
    for name, value in zip(POSITIONS, [*position, *[Fraction(0)] * (3 - len(position))], strict=True):
        if isinstance(value, tuple) and value[0] < value[1]:
            variables.append(name)
            box.append(value)
            places.append(name)
        else:
            places.append(value[0] if isinstance(value, tuple) else value)
    names = []
    for name, (value, is_variable) in zip(TURNS, turns, strict=False):
        if is_variable:
            variables.append(name)
            box.append(value)
        names.append(name if is_variable else value)
    return Chart(tuple(places), quaternion, tuple(names), tuple(variables), tuple(box))


def _shape(region: dict[str, Any], machine: RegionMachine) -> tuple[list[Any], tuple[Quadratic, ...], bool]:
    given = [key for key in _SHAPES if key in region]
    if not given and 0 not in machine.twist:
        return [Fraction(0)] * 3, (), False
    if len(given) != 1:
        raise InputError(f"region: {' and '.join(given) or 'no shape'} given; give one of {', '.join(_SHAPES)}")
    key, metric = given[0], machine.metric
    if key == "position":
        return _box(region[key], machine)
    table = region[key]
    if not isinstance(table, dict):
        raise InputError(f"region.{key}: {shown(table)} is not a table; write {{ .. }} with its keys")
    if key == "ball":
        known_keys(table, ("center", "radius"), "region.ball")
        center = read_numbers(required(table, "center", "region.ball."), "region.ball.center", dimension(machine))
        radius = parse_positive(required(table, "radius", "region.ball."), "region.ball.radius")
        quadratic, sides = round_shape(center, radius, metric)
        return list(sides), (quadratic,), _is_irrational(center, metric)
    if dimension(machine) == 2:
        raise InputError(f"region.{key}: the robot is planar; give position or ball")
    keys = ("center", "radius", "height") if key == "cylinder" else ("corners", "sides", "radius", "azimuth", "height")
    known_keys(table, keys, f"region.{key}")
    height = side(read_pair(required(table, "height", f"region.{key}."), f"region.{key}.height"), metric[2])
    if key == "cylinder":
        center = read_numbers(required(table, "center", "region.cylinder."), "region.cylinder.center", 2)
        radius = parse_positive(required(table, "radius", "region.cylinder."), "region.cylinder.radius")
        quadratic, sides = round_shape(center, radius, metric)
        return [*sides, height], (quadratic,), _is_irrational(center, metric) or not _has_roots(metric[2:])
    corners, exact = _corners(table)
    edges, sides = polygon_shape(corners, metric)
    return [*sides, height], edges, not (exact and _has_roots(metric))


def _corners(table: dict[str, Any]) -> tuple[tuple[Pair, ...], bool]:
    """The corners of a prism's base, counterclockwise; those of a regular one a little outside, where not rational."""
    where = "region.prism"
    if "corners" in table:
        rows = list_field(table["corners"], f"{where}.corners", 3)
        if not 3 <= len(rows) <= _MOST_CORNERS:
            raise InputError(f"{where}.corners: {len(rows)} given; give 3 to {_MOST_CORNERS}")
        points = tuple(
            (x, y) for x, y in (read_numbers(row, f"{where}.corners[{i}]", 2) for i, row in enumerate(rows, 1))
        )
        for (x1, y1), (x2, y2), (x3, y3) in zip(
            points, [*points[1:], points[0]], [*points[2:], *points[:2]], strict=True
        ):
            if (x2 - x1) * (y3 - y2) - (y2 - y1) * (x3 - x2) <= 0:
                raise InputError(f"{where}.corners: are not those of a convex polygon, counterclockwise; order them so")
        return points, True
    number = required(table, "sides", f"{where}.")
    if isinstance(number, bool) or not isinstance(number, int) or not 3 <= number <= _MOST_CORNERS:
        raise InputError(f"{where}.sides: {shown(number)} is not a number of sides; give 3 to {_MOST_CORNERS}")
    radius = parse_positive(required(table, "radius", f"{where}."), f"{where}.radius")
    azimuth = parse_rational(table.get("azimuth", 0), f"{where}.azimuth")
    corners = []
    for k in range(number):
        c, s = half_turn_pair(azimuth + Fraction(360 * k, number), Fraction(1, 2**70))
        norm = c * c + s * s
        # Off by less than 2^-69 of the radius: this much larger, its edges lie outside of those asked for.
        wide = radius * (1 + Fraction(number * number, 2**60))
        corners.append(((c * c - s * s) / norm * wide, 2 * c * s / norm * wide))
    return tuple(corners), False


def _box(value: object, machine: RegionMachine) -> tuple[list[Any], tuple[Quadratic, ...], bool]:
    rows = list_field(value, "region.position", dimension(machine))
    if len(rows) != dimension(machine):
        raise InputError(f"region.position: {len(rows)} entries; give {dimension(machine)}, one for each coordinate")
    found, enlarged = [], False
    for i, (row, g) in enumerate(zip(rows, machine.metric, strict=False), 1):
        where = f"region.position[{i}]"
        pair = read_pair(row, where) if isinstance(row, list) else (parse_rational(row, where),) * 2
        irrational = _is_irrational(pair, (g, g))
        if irrational and pair[0] == pair[1]:
            raise InputError(f"{where}: {shown(row)} is not rational in the model's metric; give an interval around it")
        enlarged |= irrational
        found.append(side(pair, g))
    return found, (), enlarged


def _turned(region: dict[str, Any], machine: RegionMachine) -> tuple[Any, Any]:
    """The fixed quaternion, or None, and roll, pitch and yaw, each with whether it is an interval."""
    still = ((Fraction(1), Fraction(0)), False)
    given = [key for key in _TURNED if key in region]
    if len(given) > 1:
        raise InputError(f"region: {' and '.join(given)} given; give one of them")
    if not given:
        if set(machine.twist) & {3, 4, 5}:
            raise InputError(f"region: no orientation given; give one of {', '.join(_turned_keys(machine))}")
        return None, [still] * 3
    key = given[0]
    if key == "any_axis_degrees":
        return None, [still] * 3
    if key not in _turned_keys(machine):
        raise InputError(f"region.{key}: is not for this robot; give one of {', '.join(_turned_keys(machine))}")
    if key == "quaternion":
        numbers = read_numbers(region[key], "region.quaternion", 4)
        if not any(numbers):
            raise InputError("region.quaternion: all four numbers are 0; give one that is not")
        return numbers, []
    if key == "degrees":
        return None, [still, still, _angle(region[key], "region.degrees", 2, machine)]
    rows = list_field(region[key], "region.rpy_degrees", 3)
    if len(rows) != 3:
        raise InputError(f"region.rpy_degrees: {len(rows)} entries; give 3: roll, pitch, yaw")
    return None, [_angle(row, f"region.rpy_degrees[{i + 1}]", i, machine) for i, row in enumerate(rows)]


def _turned_keys(machine: RegionMachine) -> tuple[str, ...]:
    return ("degrees",) if machine.motion in ("planar", "schoenflies") else ("quaternion", "rpy_degrees")


def _angle(value: object, where: str, axis: int, machine: RegionMachine) -> tuple[Pair, bool]:
    weight = machine.metric[(axis + 1) % 3] * machine.metric[(axis + 2) % 3]
    root = isqrt(weight)
    if isinstance(value, list):
        low, high = read_pair(value, where)
        if not -180 < low < high < 180:
            raise InputError(f"{where}: {shown(low)} to {shown(high)} reaches 180 degrees; stay between -180 and 180")
        return (_half_tangent(low, weight, -1), _half_tangent(high, weight, 1)), True
    angle = parse_rational(value, where)
    if angle and root * root != weight:
        raise InputError(
            f"{where}: {shown(angle)} is not rational in the model's metric; give a quaternion of the file"
        )
    if not is_exact_turn(angle):
        raise InputError(
            f"{where}: a turn by {shown(angle)} degrees is not rational; give an interval around it, or a quaternion"
        )
    c, s = half_turn_pair(angle)
    return (c, s / root), False


def _half_tangent(degrees: Fraction, weight: int, way: int) -> Fraction:
    """The half tangent of an angle over sqrt(weight), exactly or outward."""
    if degrees % 90 == 0:
        return in_model(degrees / 90, weight, way)
    with working_precision(256):
        sine, cosine = arb.sin_cos_pi_fmpq(fmpq(degrees.numerator, 360 * degrees.denominator))
        grid = sine / cosine / arb(weight).sqrt() * arb(2) ** 80
        end = grid.upper() if way > 0 else grid.lower()
        whole = (end.ceil() if way > 0 else end.floor()).mid()
        return Fraction(int(str(whole.fmpz())), 2**80)

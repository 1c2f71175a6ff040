"""Region certificates of version 2: what is added to version 1 (``docs/certificates-regions.md``)."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.certificate_entries import texts
from pkm_exact.regions.leg_distances import directions
from pkm_exact.regions.region_conditions import placed_legs

if TYPE_CHECKING:
    from pkm_exact.regions.chart import Arc, Chart, Line
    from pkm_exact.regions.region_legs import RegionMachine
    from pkm_exact.regions.region_question import RegionQuestion
    from pkm_exact.regions.region_solver import RegionAnswer

FORMAT: Final = "pkm_exact region certificate"
VERSION: Final = 2
ALONG: Final = "along"


def needs_second(machine: RegionMachine, question: RegionQuestion) -> bool:
    """Whether version 1 has no word for a question."""
    chart = question.chart
    distances = "limits" in question.conditions.asked and machine.leg_distance is not None
    axes = any(leg.axis is not None for leg in machine.legs)
    return bool(distances or axes or question.joints or question.tube or chart.arc or chart.line)


def second_version(content: dict[str, Any], answer: RegionAnswer) -> dict[str, Any]:
    """The content of version 2, from that of version 1."""
    question, machine = answer.question, answer.machine
    least = machine.leg_distance
    rows = zip(content["robot"]["legs"], machine.legs, strict=True)
    legs = [entry | {"axis": None if leg.axis is None else texts(leg.axis)} for entry, leg in rows]
    robot = content["robot"] | {"legs": legs, "leg_distance": None if least is None else str(least)}
    tube = question.tube
    added = {
        "tube": None if tube is None else {"corners": [texts(x) for x in tube.corners], "radius": str(tube.radius)},
        "joints": [texts(pair) for pair in question.joints],
        "directions": _directions(answer),
    }
    found: dict[str, Any] = {}
    for key, value in content.items():
        if key == "counterexample":
            found["member"] = texts(member_of(answer)) if content["claim"] in ("all", "designs") else []
        found[key] = value
        if key == "shape":
            found |= added
    return found | {"version": VERSION, "robot": robot, "chart": _chart(content["chart"], question.chart)}


def member_of(answer: RegionAnswer) -> tuple[Fraction, ...]:
    """A point of the region: that which was found; the first corner of a tube; the middle of the box."""
    if answer.member is not None:
        return answer.member
    chart, tube = answer.question.chart, answer.question.tube
    middle = [(low + high) / 2 for low, high in chart.box]
    if tube is not None:
        places = dict(zip(chart.position, tube.corners[0], strict=True))
        return tuple(places.get(name, value) for name, value in zip(chart.variables, middle, strict=True))
    return tuple(middle)


def _directions(answer: RegionAnswer) -> list[list[str] | None]:
    question, machine = answer.question, answer.machine
    if "limits" not in question.conditions.asked:
        return []
    pose, placed = placed_legs(machine, question.chart, question.conditions)
    found = directions(machine, pose, placed, question.chart.box)
    return [None if way is None else texts((*way.covector, way.size)) for way in found]


def _chart(content: dict[str, Any], chart: Chart) -> dict[str, Any]:
    curve = chart.arc or chart.line
    found: dict[str, Any] = {}
    for key, value in content.items():
        found[key] = value
        if key == "position":
            found["path"] = None if curve is None else _path(curve, chart)
    if curve is not None:
        found |= {"variables": [ALONG, *content["variables"][1:]], "position": ["0", "0", "0"]}
    return found | {"parameters": [parameter.key for parameter in chart.parameters]}


def _path(curve: Arc | Line, chart: Chart) -> list[list[str]]:
    """Coefficients of the denominator, and of the coordinates times it."""
    from pkm_exact.regions.chart import Line

    if isinstance(curve, Line):
        return [["1"], *(texts(pair) for pair in zip(curve.start, curve.way, strict=True))]
    (x, y), (u, v), r = curve.center, curve.middle, curve.radius
    height = Fraction(chart.position[2])
    rows = [
        (Fraction(1), Fraction(0), Fraction(1)),
        (x + r * u, -2 * r * v, x - r * u),
        (y + r * v, 2 * r * u, y - r * v),
        (height, Fraction(0), height),
    ]
    return [texts(row) for row in rows]

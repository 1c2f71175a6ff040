"""Region certificates: a paving and what follows from it, for the checkers (``docs/certificates-regions.md``)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import sealed
from pkm_exact.certify.certificate_entries import texts
from pkm_exact.certify.region_build_2 import needs_second, second_version
from pkm_exact.errors import InputError
from pkm_exact.regions.region_designs import OPEN, YES, widened
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, RegionLeg, RegionMachine
from pkm_exact.regions.region_solver import RegionAnswer

if TYPE_CHECKING:
    from pkm_exact.geometry.limits import Cones, Pair
    from pkm_exact.regions.chart import Chart
    from pkm_exact.regions.region_designs import Designs
    from pkm_exact.regions.region_question import RegionQuestion

FORMAT: Final = "pkm_exact region certificate"
VERSION: Final = 1
_MATRIX: Final = {"no_type_2": "regular"}
"""What is asked otherwise where the matrix stands in the place of its determinant."""
CONE_ANGLES: Final = (30, 45, 60, 90, 120, 135, 150, 180)
"""In degrees: those whose cosines have rational squares."""


def region_certificate(answer: RegionAnswer) -> dict[str, Any]:
    """The certificate of an answer about all of a region, or of a map, as a JSON object with its digest.

    Raises
    ------
    InputError
        If a limit has an irrational number in it, for which certificates have no word.
    """
    question, machine = answer.question, answer.machine
    require_words(machine, question)
    second = answer.by_matrix or needs_second(machine, question)
    return sealed(second_version(_content(answer), answer) if second else _content(answer))


def designs_certificate(machine: RegionMachine, question: RegionQuestion, found: Designs) -> dict[str, Any]:
    """The certificate of boxes of designs.

    Raises
    ------
    InputError
        As ``region_certificate``.
    """
    require_words(machine, question)
    answer = RegionAnswer(widened(question), machine, found.axes, "")
    counts = {verdict: sum(box.verdict == verdict for box in found.boxes) for verdict in (YES, OPEN)}
    said = {"claim": "designs", "paving": found.word, "inside": counts[YES], "undecided": counts[OPEN]}
    return sealed(second_version(_content(answer) | said, answer))


def _content(answer: RegionAnswer) -> dict[str, Any]:
    """The content of version 1."""
    question, machine, found = answer.question, answer.machine, answer.counterexample
    return {
        "format": FORMAT,
        "version": VERSION,
        "robot": _robot(machine),
        "chart": _chart(question.chart),
        "shape": [
            {"constant": str(part.constant), "linear": texts(part.linear), "weights": texts(part.weights)}
            for part in question.shape
        ],
        "conditions": [_MATRIX.get(name, name) if answer.by_matrix else name for name in question.conditions.asked],
        "modes": list(question.conditions.modes),
        "claim": claim_of(answer),
        "axes": list(answer.axes),
        "paving": answer.word if found is None else "",
        "inside": answer.counts["inside"] if found is None else 0,
        "undecided": answer.counts["undecided"] if found is None else 0,
        "measure": None if answer.measures is None else texts(answer.measures),
        "counterexample": [] if found is None else [texts(point) for point in found.points],
    }


def require_words(machine: RegionMachine, question: RegionQuestion) -> None:
    """Refuse what certificates have no word for.

    Raises
    ------
    InputError
        As ``region_certificate``.
    """
    _require_rational(machine)
    if question.conditions.indices or question.conditions.load:
        raise InputError("-o: certificates have no word for bounds of indices and forces; leave -o out")
    for leg, pair in zip(machine.legs, question.joints, strict=False):
        if isinstance(leg.actuator, OnCrank):
            _require_right_angles(leg, leg.actuator, pair)


def claim_of(answer: RegionAnswer) -> str:
    """What the certificate claims: "map", "all", "not-all", or "undecided"."""
    if answer.question.answer.kind == "map":
        return "map"
    if answer.counterexample is not None:
        return "not-all"
    return "all" if answer.is_proved else "undecided"


def _robot(machine: RegionMachine) -> dict[str, Any]:
    return {
        "name": machine.name,
        "unit": machine.unit,
        "source": machine.source,
        "motion": machine.motion,
        "metric": texts(machine.metric),
        "legs": [_leg(leg) for leg in machine.legs],
        "forms": [texts(form) for form in machine.forms],
        "base_cones": _cones(machine.base_cones),
        "platform_cones": _cones(machine.platform_cones),
        "position": _pairs(machine.position),
    }


def _leg(leg: RegionLeg) -> dict[str, Any]:
    return {
        "name": leg.name,
        "base": texts(leg.base),
        "platform": texts(leg.platform),
        "actuator": _actuator(leg),
        "reach": None if leg.reach is None else texts(leg.reach),
    }


def _actuator(leg: RegionLeg) -> dict[str, Any]:
    found = leg.actuator
    if isinstance(found, OnSlide):
        return {"type": "slide", "direction": texts(found.direction), "rod_squared": str(found.rod_squared)}
    if isinstance(found, OnCrank):
        return {
            "type": "crank",
            "at_0": texts(found.at_0),
            "at_90": texts(found.at_90),
            "weight": str(found.weight),
            "rod_squared": str(found.rod_squared),
        }
    return {"type": "length"}


def _chart(chart: Chart) -> dict[str, Any]:
    return {
        "variables": list(chart.variables),
        "box": _pairs(chart.box),
        "position": [str(value) for value in chart.position],
        "quaternion": None if chart.quaternion is None else texts(chart.quaternion),
        "turns": [[turn] if isinstance(turn, str) else texts(turn) for turn in chart.turns],
    }


def _cones(cones: Cones | None) -> list[dict[str, Any]]:
    if cones is None:
        return []
    return [{"axis": texts(axis), "degrees": str(angle)} for axis, angle in zip(cones.axes, cones.angles, strict=True)]


def _pairs(pairs: Iterable[Any]) -> list[list[str]]:
    return [texts(pair) for pair in pairs]


def _require_rational(machine: RegionMachine) -> None:
    for cones in (machine.base_cones, machine.platform_cones):
        for angle in () if cones is None else cones.angles:
            if angle not in CONE_ANGLES:
                raise InputError(
                    f"-o: a cone of {angle} degrees has no rational cosine squared, and certificates have no word for "
                    f"others; give one of {', '.join(map(str, CONE_ANGLES))}, or leave -o out"
                )
    for leg in machine.legs:
        if leg.axis is not None and (machine.base_cones or machine.platform_cones):
            raise InputError(f"-o: {leg.name}: certificates have no word for cones beside rods along an axis")
        if isinstance(leg.actuator, OnHinge):
            raise InputError(f"-o: {leg.name}: certificates have no word for driven hinges; leave -o out")
        if isinstance(leg.actuator, OnCrank) and leg.reach is not None:
            _require_right_angles(leg, leg.actuator, leg.reach)


def _require_right_angles(leg: RegionLeg, crank: OnCrank, ends: Pair) -> None:
    if crank.weight != 1 or any(end % 90 for end in ends):
        raise InputError(
            f"-o: {leg.name}: certificates have a word only for limits of cranks at multiples of 90 degrees, "
            "with axes of one length; give such, or leave -o out"
        )

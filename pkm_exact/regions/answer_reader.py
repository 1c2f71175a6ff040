"""The table ``[answer]`` of question files."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, required
from pkm_exact.geometry.rational import parse_positive
from pkm_exact.regions.design_parameters import RODS, SCALES, require_apart, require_known
from pkm_exact.regions.question_fields import dimension, read_numbers, read_pair
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import (
    ANSWERS,
    DEFAULT_BOXES,
    DEFAULT_STEPS,
    EXTREMES,
    WantedAnswer,
)
from pkm_exact.wording import shown

MOST_PARAMETERS: Final = 4
DEFAULT_DESIGN_BOXES: Final = 2000
_MOST_STEPS: Final = 120
_MOST_BOXES: Final = 10**8


def read_answer(table: dict[str, Any], machine: RegionMachine) -> WantedAnswer:
    """Which answer is wanted, and how much work may be done for it.

    Raises
    ------
    InputError
        With field, value and remedy.
    """
    known_keys(
        table,
        ("kind", "steps", "boxes", "shape", "about", "precision", "of", "parameter", "between", "parameters"),
        "answer",
    )
    kind = required(table, "kind", "answer.")
    if kind not in ANSWERS:
        raise InputError(f"answer.kind: {shown(kind)} is unknown; use one of: {', '.join(ANSWERS)}")
    if kind == "designs":
        return _designs(table, machine)
    if "parameters" in table:
        raise InputError("answer.parameters: belongs to the kind designs; remove it")
    steps = _count(table.get("steps", DEFAULT_STEPS), "answer.steps", _MOST_STEPS)
    boxes = _count(table.get("boxes", DEFAULT_BOXES), "answer.boxes", _MOST_BOXES)
    of = _extremes_of(table, kind)
    if kind == "threshold":
        return _threshold(table, steps, boxes)
    if given := [key for key in ("parameter", "between") if key in table]:
        raise InputError(f"answer.{given[0]}: belongs to the kind threshold; remove it")
    if kind != "largest":
        for key in ("shape", "about", *(() if of else ("precision",))):
            if key in table:
                raise InputError(f"answer.{key}: belongs to the kind largest; remove it")
        return WantedAnswer(kind, steps, boxes, precision=_precision(table, "1/1000"), of=of)
    shape = required(table, "shape", "answer.")
    if shape not in ("cube", "ball"):
        raise InputError(f"answer.shape: {shown(shape)} is unknown; use one of: cube, ball")
    about = read_numbers(required(table, "about", "answer."), "answer.about", dimension(machine))
    return WantedAnswer(kind, steps, boxes, shape, about, _precision(table, "1/100"))


def _designs(table: dict[str, Any], machine: RegionMachine) -> WantedAnswer:
    known_keys(table, ("kind", "steps", "boxes", "precision", "parameters"), "answer")
    given = required(table, "parameters", "answer.")
    if not isinstance(given, dict) or not 1 <= len(given) <= MOST_PARAMETERS:
        raise InputError(
            f'answer.parameters: give a table of 1 to {MOST_PARAMETERS} numbers, such as {{ "base.scale" = [1, 2] }}'
        )
    found = []
    for key, ends in given.items():
        require_known(key, machine)
        low, high = read_pair(ends, f"answer.parameters.{key}")
        if low <= 0 and (key in SCALES or key == RODS):
            raise InputError(f"answer.parameters.{key}: {shown(low)} is not positive; give numbers greater than 0")
        found.append((key, (low, high)))
    require_apart(list(given))
    return WantedAnswer(
        "designs",
        _count(table.get("steps", DEFAULT_STEPS), "answer.steps", _MOST_STEPS),
        _count(table.get("boxes", DEFAULT_DESIGN_BOXES), "answer.boxes", _MOST_BOXES),
        precision=_precision(table, "1/100"),
        parameters=tuple(found),
    )


def _threshold(table: dict[str, Any], steps: int, boxes: int) -> WantedAnswer:
    if given := [key for key in ("shape", "about") if key in table]:
        raise InputError(f"answer.{given[0]}: belongs to the kind largest; remove it")
    key = required(table, "parameter", "answer.")
    if not isinstance(key, str) or not key:
        raise InputError(
            f"answer.parameter: {shown(key)} is no text; name a number of the model, such as dimensions.height"
        )
    between = read_pair(required(table, "between", "answer."), "answer.between")
    return WantedAnswer(
        "threshold", steps, boxes, precision=_precision(table, "1/1000"), parameter=key, between=between
    )


def _extremes_of(table: dict[str, Any], kind: str) -> str:
    """Of what the least and greatest values are asked; nothing if another answer is."""
    if kind != "extremes":
        if "of" in table:
            raise InputError("answer.of: belongs to the kind extremes; remove it")
        return ""
    found = required(table, "of", "answer.")
    if found not in EXTREMES:
        raise InputError(f"answer.of: {shown(found)} is unknown; use one of: {', '.join(EXTREMES)}")
    return str(found)


def _precision(table: dict[str, Any], usual: str) -> Fraction:
    precision = parse_positive(table.get("precision", usual), "answer.precision")
    if not Fraction(1, 10**6) <= precision <= 1:
        raise InputError(f"answer.precision: {shown(precision)} is out of range; give a number from 1e-6 to 1")
    return precision


def _count(value: object, where: str, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= most:
        raise InputError(f"{where}: {shown(value)} is out of range; give a whole number from 1 to {most}")
    return value

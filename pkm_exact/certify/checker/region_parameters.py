"""Numbers of a robot that vary with a design, in region certificates of version 2."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Final

from pkm_exact.certify.checker.region_document import RegionDocument
from pkm_exact.certify.checker.spelling import items, text
from pkm_exact.certify.checker.verdict import malformed

MOST_PARAMETERS: Final = 4
RODS: Final = "rods.length"
_SCALES: Final = ("base.scale", "platform.scale")
_COORDINATE: Final = re.compile(r"(base|platform)\.joints\.([1-9][0-9]?)\.([1-3])")

Entries = tuple[Fraction | str, ...]


def read_parameters(value: object) -> tuple[str, ...]:
    """Which numbers vary; nothing is known of the legs yet."""
    found = items(value, "chart.parameters", None, text)
    if len(found) > MOST_PARAMETERS or len(set(found)) < len(found):
        raise malformed(f"chart.parameters: more than {MOST_PARAMETERS}, or one twice")
    for key in found:
        if key not in (*_SCALES, RODS) and not _COORDINATE.fullmatch(key):
            raise malformed("chart.parameters: one is no number of the robot")
    return found


def scale_of(document: RegionDocument, side: str) -> str | None:
    """The variable that multiplies all joints of a side."""
    key = f"{side}.scale"
    return f"p{document.parameters.index(key) + 1}" if key in document.parameters else None


def varied_joints(document: RegionDocument, number: int) -> tuple[Entries, Entries]:
    """The joints of a leg, variables in the place of coordinates that vary; scales apart."""
    found = []
    for side in ("base", "platform"):
        entries: list[Fraction | str] = list(getattr(document.legs[number], side))
        for k, key in enumerate(document.parameters, 1):
            fits = _COORDINATE.fullmatch(key)
            if fits and fits[1] == side and int(fits[2]) == number + 1:
                entries[int(fits[3]) - 1] = f"p{k}"
        found.append(tuple(entries))
    return found[0], found[1]


def require_varied(document: RegionDocument) -> None:
    """Refuse parameters that the robot has not, or that move one joint twice."""
    keys = document.parameters
    if not keys:
        return
    if document.forms or document.joints or any(leg.axis is not None for leg in document.legs):
        raise malformed("chart.parameters: there are forms, axes of rods or joint values")
    for key, (low, _) in zip(keys, document.box[-len(keys) :], strict=True):
        fits = _COORDINATE.fullmatch(key)
        if fits is None:
            if low <= 0:
                raise malformed("chart.parameters: a scale or length is not positive")
        elif int(fits[2]) > len(document.legs) or f"{fits[1]}.scale" in keys:
            raise malformed("chart.parameters: there is no such leg, or its joint is scaled too")
    if RODS in keys and not all(leg.axes for leg in document.legs):
        raise malformed("chart.parameters: a leg has no rod")

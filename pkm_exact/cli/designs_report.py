"""For which designs a question is answered yes, as text and as JSON."""

from __future__ import annotations

import json
from fractions import Fraction
from typing import TYPE_CHECKING

from pkm_exact.cli.region_report import ENLARGED, rounded_down, rounded_up
from pkm_exact.regions.region_designs import NO, OPEN, YES, Designs

if TYPE_CHECKING:
    from pkm_exact.regions.region_legs import RegionMachine
    from pkm_exact.regions.region_question import RegionQuestion


def as_text(machine: RegionMachine, asked: RegionQuestion, found: Designs) -> str:
    """A few lines; of one parameter its intervals."""
    names = ", ".join(asked.conditions.names)
    lines = [f"{machine.name}: {names} in a region of {', '.join(asked.chart.variables)}, by {', '.join(found.keys)}"]
    for verdict, what in ((YES, "proved for all designs"), (NO, "for no design"), (OPEN, "undecided")):
        count = sum(box.verdict == verdict for box in found.boxes)
        share = 100 * float(found.share(verdict))
        lines.append(f"{what}: {count} box{'es' * (count != 1)}, {share:.6g} % of the designs asked about")
    if len(found.keys) == 1:
        lines += [f"{found.keys[0]} from {_shown(low)} to {_shown(high)}: {word}" for low, high, word in _runs(found)]
    if asked.enlarged:
        lines.append(ENLARGED)
    return "\n".join(lines) + "\n"


def _shown(value: Fraction) -> str:
    return rounded_down(value) if rounded_down(value) == rounded_up(value) else str(value)


def _runs(found: Designs) -> list[tuple[Fraction, Fraction, str]]:
    """Intervals of one parameter with one verdict, from the least on."""
    runs: list[tuple[Fraction, Fraction, str]] = []
    for box in found.boxes:
        ((low, high),) = box.ends
        if runs and runs[-1][2] == box.verdict and runs[-1][1] == low:
            low = runs.pop()[0]
        runs.append((low, high, box.verdict))
    return runs


def as_json(machine: RegionMachine, asked: RegionQuestion, found: Designs) -> str:
    """The same as a JSON object, with all boxes; numbers are exact rationals as strings."""
    content = {
        "robot": machine.name,
        "answer": "designs",
        "parameters": list(found.keys),
        "shares": {verdict: str(found.share(verdict)) for verdict in (YES, NO, OPEN)},
        "boxes": [
            {"box": [[str(low), str(high)] for low, high in box.ends], "verdict": box.verdict} for box in found.boxes
        ],
        "enlarged": asked.enlarged,
    }
    return json.dumps(content, indent=1) + "\n"

"""How far tolerances are proved, beside how far sampled robots show the poses to be regular.

Proved: the greatest tolerance of all joint coordinates and lengths at once for which a pose has a box, and for which it
is followed without a box. Seen: the least tolerance at which a robot was found, in floating point, that has lost the
pose (``tolerance_rays``): among random corners of the data, and among corners that were chosen as they lead to a fold.
Nothing can be proved beyond the latter, so it is the tolerance that is asked about; random corners alone come nowhere
near the nearest fold of 42 data. No times are measured.
"""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

from tolerance_rays import first_lost

from pkm_exact.engine import solve
from pkm_exact.geometry.reader import read_jointed_robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.tolerance import tolerance_boxes

ROOT = Path(__file__).parent.parent
FILES = (
    ROOT / "tests" / "cases" / "cad3.toml",
    ROOT / "tests" / "cases" / "c06-nominal.toml",
    ROOT / "models" / "mourrain-l.toml",
    ROOT / "models" / "3-rpr-merlet-p.toml",
)
GREATEST = 0.2
"""Of the errors that are sampled, in parts of the longest leg."""
DIGITS = 3
"""Significant ones of the tolerance that is asked about, rounded up."""
COLUMNS = ("pose", "box", "followed", "cells", "lost: random", "lost: directed", "of random", "of directed")


def main() -> None:
    """Measure, and print a Markdown table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", type=Path, default=FILES, help="model files of hexapods or 3-RPR robots")
    parser.add_argument("--rays", type=int, default=200, help="random rays for each pose (default 200)")
    parser.add_argument("--poses", type=int, nargs="+", metavar="N", help="only these poses")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers to FILE as well")
    arguments = parser.parse_args()
    rows = []
    print("| robot, configuration |", " | ".join(COLUMNS), "|\n" + "|---" * (len(COLUMNS) + 1) + "|")
    for path in arguments.files:
        for row in _rows(path, arguments.rays, arguments.poses):
            rows.append(row)
            shares = [row["proved"] / row[seen] for seen in ("random", "directed")]
            numbers = [row[key] for key in ("box", "proved")], [row[key] for key in ("random", "directed")]
            proved, seen = (" | ".join(f"{value:.3g}" for value in pair) for pair in numbers)
            words = f"| {row['robot']}, {row['configuration']} | {row['pose']} | {proved} | {row['cells']} | {seen} |"
            print(words, " | ".join(f"{share:.2f}" for share in shares), "|", flush=True)
    if arguments.json is not None:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


def _rows(path: Path, rays: int, poses: list[int] | None) -> Iterator[dict[str, Any]]:
    robot = read_jointed_robot(path, "bench_tolerances")
    for configuration in robot.configurations:
        problem = robot.problem(configuration)
        solution = solve(problem)
        longest = max(float(leg.length_squared) for leg in problem.distances) ** 0.5
        for number, pose in enumerate(solution.poses, 1):
            if poses is not None and number not in poses:
                continue
            seen = first_lost(problem, pose, GREATEST * longest, rays)
            asked = _rounded_up(seen.directed)
            (box,) = tolerance_boxes(problem, Tolerances.uniform(asked), solution, asked=[number]).boxes
            followed = box.followed
            proved = asked * (box.fraction if followed is None else followed.fraction)
            if proved >= seen.directed:
                raise RuntimeError(f"pose {number} is proved for {float(proved)}, but was seen lost at {seen.directed}")
            yield {
                "robot": robot.name,
                "configuration": configuration.name,
                "pose": number,
                "box": float(box.fraction * asked),
                "proved": float(proved),
                "cells": 0 if followed is None else followed.cells,
                "random": seen.random,
                "directed": seen.directed,
                "corner": [int(sign) for sign in seen.corner],
            }


def _rounded_up(value: float) -> Fraction:
    unit = Fraction(10) ** (math.floor(math.log10(value)) + 1 - DIGITS)
    return math.ceil(Fraction(value) / unit) * unit


if __name__ == "__main__":
    main()

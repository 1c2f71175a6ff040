"""Uncertified poses as a table, one JSON object, or CSV rows: decimals of doubles, and the word "uncertified"."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Iterator
from math import atan2, degrees
from typing import TYPE_CHECKING, Any

from pkm_exact.cli.report import configuration_object, robot_object
from pkm_exact.cli.table import locked_values, print_rows
from pkm_exact.geometry.machine import Machine, locked_at
from pkm_exact.motions.motion import Motion

if TYPE_CHECKING:
    from pkm_exact.numeric.uncertified import NumericPose, UncertifiedSolution

_HEADER = ("", "x", "y", "z", "q0", "q1", "q2", "q3", "residual", "iterations")
_PLANAR_HEADER = ("", "x", "y", "theta", "residual", "iterations")


def report(
    robot: Machine, configuration: str | None, solution: UncertifiedSolution, layout: str, *, verbose: bool
) -> None:
    """Print an uncertified solution to stdout as ``table``, ``json`` or ``csv``."""
    if layout == "json":
        sys.stdout.write(json.dumps(as_object(robot, configuration, solution), indent=1) + "\n")
    elif layout.startswith("csv"):
        csv.writer(sys.stdout, lineterminator="\n").writerows(as_rows(solution))
    else:
        _print_table(robot, configuration, solution, verbose=verbose)


def _print_table(robot: Machine, configuration: str | None, solution: UncertifiedSolution, *, verbose: bool) -> None:
    actuators = locked_at(robot.kind, configuration)
    count = f"{len(solution.poses)} pose{'' if len(solution.poses) == 1 else 's'}"
    lines = [
        f"{robot.name} ({robot.kind}), {actuators}, method {solution.method}",
        f"{count} found; {solution.claim}: nothing is proved about what is listed, nor that there is no other",
    ]
    if verbose:
        lines += [f"source: {robot.source}", locked_values(solution.problem)]
    lines += [f"note: {note}" for note in solution.notes]
    sys.stdout.write("\n".join(lines) + "\n")
    if not solution.poses:
        return
    planar = solution.problem.motion.is_planar
    rotation = "angle [degrees]" if planar else "unit quaternion (scalar first)"
    sys.stdout.write(f"\nposition [{robot.unit}], {rotation}, as computed; no digit is guaranteed\n")
    rows = [_row(number, pose, solution.problem.motion) for number, pose in enumerate(solution.poses, 1)]
    print_rows(rows, _PLANAR_HEADER if planar else _HEADER)


def _row(number: int, pose: NumericPose, motion: Motion) -> tuple[str, ...]:
    values = (*pose.position[:2], _angle(pose)) if motion.is_planar else (*pose.position, *pose.quaternion)
    return str(number), *(f"{value:.12g}" for value in values), f"{pose.residual:.1e}", str(pose.iterations)


def _angle(pose: NumericPose) -> float:
    return degrees(atan2(pose.rotation[1][0], pose.rotation[0][0]))


def as_object(robot: Machine, configuration: str | None, solution: UncertifiedSolution) -> dict[str, Any]:
    """The solution as a JSON object; unlike bounds of certified poses, coordinates are numbers and not strings."""
    return {
        "robot": robot_object(robot),
        "configuration": configuration_object(robot, configuration, solution.problem),
        "method": solution.method,
        "claim": solution.claim,
        "real_poses": len(solution.poses),
        "poses": [
            {
                "position": list(pose.position),
                "rotation": [list(row) for row in pose.rotation],
                "quaternion": list(pose.quaternion),
                "residual": pose.residual,
                "iterations": pose.iterations,
            }
            for pose in solution.poses
        ],
        "notes": list(solution.notes),
    }


def as_rows(solution: UncertifiedSolution) -> Iterator[list[str]]:
    """A header and one row per pose: its number, "uncertified", coordinates and residual."""
    names = ["x", "y", "z", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)), *(f"q{k}" for k in range(4))]
    yield ["pose", "claim", *names, "residual", "iterations"]
    for number, pose in enumerate(solution.poses, 1):
        values = [*pose.position, *(entry for row in pose.rotation for entry in row), *pose.quaternion, pose.residual]
        yield [str(number), solution.claim, *map(repr, values), str(pose.iterations)]

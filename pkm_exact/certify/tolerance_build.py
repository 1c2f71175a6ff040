"""Tolerance certificates: what ``numeric.tolerance`` proved, written down for the checker (``docs/tolerances.md``)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import robot_entry, sealed
from pkm_exact.poses.pose_spelling import ends

if TYPE_CHECKING:
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.numeric.deviations import PoseBounds
    from pkm_exact.numeric.tolerance_result import ProvedBox, ToleranceResult
    from pkm_exact.roots.interval import Interval

FORMAT: Final = "pkm_exact tolerance certificate"
VERSION: Final = 1


def tolerance_certificate(robot: Robot, configuration_name: str | None, result: ToleranceResult) -> dict[str, Any]:
    """The certificate of a tolerance analysis, as a JSON object with its digest.

    Parameters
    ----------
    robot : Robot
        The nominal robot.
    configuration_name : str or None
        Name of the configuration; None if the lengths were given freely.
    result : ToleranceResult

    Raises
    ------
    ValueError
        If the result is one of another problem than the robot's.
    """
    robot = robot.as_gough(robot.configuration(configuration_name) if robot.chains else None)
    squares = [leg.length_squared for leg in result.problem.distances]
    if robot.problem(squares) != result.problem:
        raise ValueError(f"the result is not one of {robot!r}: joints or metric differ")
    tolerances, frames = result.tolerances, result.frames
    return sealed(
        {
            "format": FORMAT,
            "version": VERSION,
            "robot": robot_entry(robot),
            "configuration": {"name": configuration_name, "lengths_squared": _texts(squares)},
            "tolerances": {key: str(getattr(tolerances, key)) for key in ("base", "platform", "lengths")},
            "frames": {"base": _texts(frames.base), "platform": _texts(frames.platform), "unit": str(frames.unit)},
            "exponent": result.exponent,
            "boxes": [_box(box.pose, box.bounds, box.proof) for box in result.boxes if box.bounds and box.proof],
            "unproved": sorted([*(box.pose for box in result.boxes if not box.is_proved), *result.unasked]),
            "pairs": [_place(pair) for pair in sorted(result.pairs, key=lambda pair: (pair.chart, pair.centre))],
            "complete": result.is_complete,
        }
    )


def _box(pose: int, bounds: PoseBounds, proof: ProvedBox) -> dict[str, Any]:
    return {
        "pose": pose,
        **_place(proof),
        "inner": [hex(radius) for radius in proof.inner],
        "position": _all_ends(bounds.position),
        "rotation": [_all_ends(row) for row in bounds.rotation],
        "quaternion": _all_ends(bounds.quaternion),
        "centroid": _all_ends(bounds.centroid),
        "position_error": str(bounds.position_error.hi),
        "rotation_error": str(bounds.rotation_error.hi),
    }


def _place(box: ProvedBox) -> dict[str, Any]:
    return {
        "chart": [list(pair) for pair in box.chart],
        "centre": [[hex(real), hex(imaginary)] for real, imaginary in box.centre],
        "outer": [hex(radius) for radius in box.outer],
    }


def _texts(values: Iterable[object]) -> list[str]:
    return [str(value) for value in values]


def _all_ends(intervals: Iterable[Interval]) -> list[list[str]]:
    return [ends(interval) for interval in intervals]

"""The answer to a row as one line of JSON; the fields are described in ``docs/sweep.md``."""

from __future__ import annotations

import json
from hashlib import sha256
from typing import Any

from pkm_exact.geometry.machine import Machine
from pkm_exact.indices.index import Index, Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.interactive.answer_notes import answer_notes
from pkm_exact.poses.nearest_pose import nearest_pose
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.pose_names import pose_names
from pkm_exact.poses.pose_spelling import pose_decimals
from pkm_exact.poses.roll_pitch_yaw import roll_pitch_yaw
from pkm_exact.roots.interval import Interval, decimal
from pkm_exact.solution import Solution
from pkm_exact.sweep.asked_indices import AskedIndices
from pkm_exact.sweep.lengths import LengthRow


def solution_line(
    row: LengthRow,
    robot: Machine,
    configuration: str | None,
    solution: Solution,
    certificate: bytes,
    asked: AskedIndices | None = None,
    *,
    degrees: bool = False,
) -> bytes:
    """What was found for a row, with the digest of its certificate, and of each pose indices and angles if asked."""
    names = pose_names(solution.poses, solution.problem.motion)
    poses = [{"name": name, **_pose(pose)} for name, pose in zip(names, solution.poses, strict=True)]
    notes = list(answer_notes(robot, configuration, solution))
    if degrees:
        poses = [{**entry, "degrees": _degrees(robot, pose)} for entry, pose in zip(poses, solution.poses, strict=True)]
    if asked is not None:
        values, reasons = asked.at_poses(robot, solution.problem, solution.poses)
        poses = [{**pose, "indices": found} for pose, found in zip(poses, values, strict=True)]
        notes += reasons
    return _line(
        row,
        {
            "claim": str(solution.claim),
            "completeness_route": None if solution.completeness_route is None else str(solution.completeness_route),
            "method": solution.method,
            "complex_solutions": solution.complex_solutions,
            "distinct_solutions": solution.distinct_solutions,
            "real_poses": len(solution.poses),
            "poses": poses,
            **_nearest(robot, solution),
            "notes": notes,
            "certificate_sha256": sha256(certificate).hexdigest(),
        },
    )


def error_line(row: LengthRow, sentence: str) -> bytes:
    """Why a row has no answer."""
    place = f"line {row.line}"
    return _line(row, {"error": sentence if sentence.startswith(place) else f"{place}: {sentence}"})


def _line(row: LengthRow, content: dict[str, Any]) -> bytes:
    lengths = list(row.fields) if row.defect is None else None
    entry = {"row": row.number, "line": row.line, "lengths": lengths, **content}
    return json.dumps(entry, separators=(",", ":"), ensure_ascii=True, allow_nan=False).encode("ascii") + b"\n"


def _pose(pose: Pose) -> dict[str, Any]:
    """Decimals as strings: the last digit is right to within one unit."""
    return {
        **pose_decimals(pose),
        **{index.name: _short(index, pose) for index in shown_in(Output.SWEEP)},
        "multiplicity": pose.multiplicity,
    }


def _nearest(robot: Machine, solution: Solution) -> dict[str, list[int]]:
    """The pose nearest to the nominal one, as ``solve`` writes it, if the model has that."""
    if robot.nominal is None:
        return {}
    found = nearest_pose(solution.poses, robot.nominal)
    return {"nearest_to_nominal": [] if found is None else list(found.numbers)}


def _degrees(robot: Machine, pose: Pose) -> list[str | None]:
    """Roll, pitch and yaw, or the angle in the plane; None where a box does not tell them apart."""
    angles = roll_pitch_yaw(pose)[2:] if robot.motion.is_planar else roll_pitch_yaw(pose)
    return [None if angle is None else decimal(angle) for angle in angles]


def _short(index: Index, pose: Pose) -> str | int | None:
    value = index.value(pose)
    return decimal(value) if isinstance(value, Interval) else value

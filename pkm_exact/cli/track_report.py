"""Samples of ``track`` as records, and as the CSV or JSON file that the command writes."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pkm_exact.cli.report import robot_object
from pkm_exact.files import write_whole
from pkm_exact.geometry.path_reader import TIME, joint_names
from pkm_exact.geometry.rational import finite_decimal

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.path_reader import JointPath
    from pkm_exact.numeric.tracked_branch import BranchPoint, TrackedSample, TrackingStopped
    from pkm_exact.poses.pose import Interval

Record = dict[str, Any]


def record_of(sample: TrackedSample, *, start_proved: bool) -> Record:
    """A sample as a JSON object, and whether the list of the start was complete (``start_line``)."""
    pose, point = sample.pose, sample.point
    return {
        "row": sample.row + 1,
        "position": [_ends(c) for c in pose.position],
        "rotation": [[_ends(entry) for entry in row] for row in pose.rotation],
        "quaternion": [_ends(q) for q in pose.quaternion],
        "steps": sample.steps,
        "start_proved": start_proved,
        "point": {
            "row": point.row,
            "chart": [list(pair) for pair in point.chart],
            "exponent": point.exponent,
            "centre": [hex(value) for value in point.centre],
            "halvings": point.halvings,
            "det_sign": point.det_sign,
        },
    }


def point_of(content: Record) -> BranchPoint:
    """Where a record's branch goes on."""
    from pkm_exact.numeric.tracked_branch import BranchPoint

    return BranchPoint(
        content["row"],
        tuple((real, imaginary) for real, imaginary in content["chart"]),
        content["exponent"],
        tuple(int(value, 16) for value in content["centre"]),
        content["halvings"],
        content["det_sign"],
    )


def stop_of(stop: TrackingStopped, joints: JointPath) -> Record:
    """Where and why the branch ends."""
    content: Record = {
        "after_row": stop.row + 1,
        "lines": [joints.lines[stop.row], joints.lines[stop.row + 1]],
        "certified_to": str(stop.reached),
        "not_certified_to": str(stop.tried),
    }
    reason = f"{stop} (lines {joints.lines[stop.row]} and {joints.lines[stop.row + 1]} of the path)"
    if joints.times is not None:
        before, after = joints.times[stop.row], joints.times[stop.row + 1]
        times = [before + share * (after - before) for share in (stop.reached, stop.tried)]
        content[TIME] = [str(value) for value in times]
        reason += f"; time {float(times[0]):.12g} to {float(times[1]):.12g}"
    return {**content, "reason": reason}


def start_line(number: int, *, proved: bool) -> str:
    """What is proved of where the branch begins.

    Its first box meets that of the pose in the list, and of no other pose there. In a complete list there is no pose
    but those.
    """
    if proved:
        return f"start: pose {number} of the first row's list, which is complete"
    return (
        f"start: a pose in the box of pose {number} of the first row's list; that list is not proved complete, so that "
        "the pose there may be another one, which it does not have"
    )


def written(
    target: Path,
    robot: Machine,
    joints: JointPath,
    number: int,
    records: Sequence[Record],
    stopped: Record | None,
    *,
    exact: bool,
    intended: Record | None = None,
) -> None:
    """Write the output, CSV or JSON by its suffix; it appears whole or not at all. JSON is always exact."""
    if target.suffix.lower() == ".csv":
        text = io.StringIO()
        rows = _rows if exact else _decimal_rows
        csv.writer(text, lineterminator="\n").writerows(rows(robot, joints, records))
        write_whole(target, text.getvalue().encode())
        return
    content = {
        "robot": robot_object(robot),
        "start_pose": number,
        "start_proved": records[0]["start_proved"],
        "rows": len(joints.rows),
        "samples": [_sample(robot, joints, record) for record in records],
        "stopped": stopped,
        **({} if intended is None else {"intended": intended}),
    }
    write_whole(target, (json.dumps(content, indent=1) + "\n").encode("ascii"))


def _sample(robot: Machine, joints: JointPath, record: Record) -> Record:
    place = record["row"] - 1
    content: Record = {"row": record["row"]}
    if joints.times is not None:
        content[TIME] = str(joints.times[place])
    content["joints"] = [str(value) for value in joints.rows[place]]
    content |= {key: record[key] for key in ("position", "rotation", "quaternion")}
    content |= {"det_sign": record["point"]["det_sign"], "steps": record["steps"]}
    if robot.limits is not None:
        feasible, *verdicts = _limit_fields(robot, joints, record)
        content |= {"feasible": feasible, "limits": dict(zip(robot.limits.names, verdicts, strict=True))}
    return content


def _limit_fields(robot: Machine, joints: JointPath, record: Record) -> list[str]:
    """Whether the sample keeps all limits of the robot, and each of them; nothing of a robot without limits."""
    if robot.limits is None:
        return []
    from pkm_exact.numeric.path_forms import locked_at, problem_at
    from pkm_exact.poses.limit_checks import limit_verdicts, together
    from pkm_exact.poses.pose_spelling import pose_of

    row = joints.rows[record["row"] - 1]
    (verdicts,) = limit_verdicts(robot, locked_at(robot, row), problem_at(robot, row), [pose_of(record)])
    return [str(together(verdicts.values())), *(str(verdicts[name]) for name in robot.limits.names)]


def _rows(robot: Machine, joints: JointPath, records: Sequence[Record]) -> Iterator[list[str]]:
    """A header and one row per sample; bounds are exact rationals."""
    names = ["x", "y", "z", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)), *(f"q{k}" for k in range(4))]
    time = [] if joints.times is None else [TIME]
    bounds = [f"{name}_{end}" for name in names for end in ("lo", "hi")]
    limits = () if robot.limits is None else ("feasible", *(f"limit_{name}" for name in robot.limits.names))
    yield ["row", *time, *(f"joint_{name}" for name in joint_names(robot)), *bounds, "det_sign", "steps", *limits]
    for record in records:
        place = record["row"] - 1
        when: list[Fraction] = [] if joints.times is None else [joints.times[place]]
        entries = [*record["position"], *(entry for row in record["rotation"] for entry in row), *record["quaternion"]]
        yield [
            str(record["row"]),
            *map(str, (*when, *joints.rows[place])),
            *(end for entry in entries for end in entry),
            str(record["point"]["det_sign"]),
            str(record["steps"]),
            *_limit_fields(robot, joints, record),
        ]


def _decimal_rows(robot: Machine, joints: JointPath, records: Sequence[Record]) -> Iterator[list[str]]:
    """The same in decimals, right to one unit of the last digit, with angles in degrees."""
    from pkm_exact.poses.pose_spelling import pose_of
    from pkm_exact.poses.roll_pitch_yaw import roll_pitch_yaw

    planar = robot.motion.is_planar
    names = ["x", "y", "degrees"] if planar else ["x", "y", "z", "roll", "pitch", "yaw", "q0", "q1", "q2", "q3"]
    time = [] if joints.times is None else [TIME]
    limits = () if robot.limits is None else ("feasible", *(f"limit_{name}" for name in robot.limits.names))
    yield ["row", *time, *(f"joint_{name}" for name in joint_names(robot)), *names, "det_sign", "steps", *limits]
    for record in records:
        place, pose = record["row"] - 1, pose_of(record)
        when: list[Fraction] = [] if joints.times is None else [joints.times[place]]
        angles = roll_pitch_yaw(pose)
        values = [*pose.position[:2], angles[2]] if planar else [*pose.position, *angles, *pose.quaternion]
        yield [
            str(record["row"]),
            *(finite_decimal(value) or repr(float(value)) for value in (*when, *joints.rows[place])),
            *("" if value is None else str(value) for value in values),
            str(record["point"]["det_sign"]),
            str(record["steps"]),
            *_limit_fields(robot, joints, record),
        ]


def _ends(interval: Interval) -> list[str]:
    return [str(interval.lo), str(interval.hi)]

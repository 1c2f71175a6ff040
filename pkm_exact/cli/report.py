"""A solution as a person or a program wants it: a headline and a table, one JSON object, or CSV rows."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.cli.feasible_poses import ShownPoses
from pkm_exact.cli.modes import JoinedPoses, assembly_modes
from pkm_exact.geometry.robot import Robot
from pkm_exact.indices.index import Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.interactive.answer_notes import answer_notes
from pkm_exact.interactive.display import headline
from pkm_exact.motions.motion import Motion
from pkm_exact.poses.planar_coordinates import planar_coordinates
from pkm_exact.poses.pose_spelling import ends, pose_entry
from pkm_exact.poses.roll_pitch_yaw import roll_pitch_yaw

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution


def report(
    robot: Machine,
    configuration: str | None,
    solution: Solution,
    layout: str,
    *,
    verbose: bool,
    shown: ShownPoses | None = None,
    joined: JoinedPoses | None = None,
) -> None:
    """Print a solution to stdout in one of the layouts; all of its poses, or those that are chosen.

    Which of them are joined is said by the table and by JSON.
    """
    shown = shown or ShownPoses.of(robot, configuration, solution)
    if layout == "json":
        sys.stdout.write(json.dumps(as_object(robot, configuration, solution, shown, joined), indent=1) + "\n")
    elif layout in _ROWS:
        csv.writer(sys.stdout, lineterminator="\n").writerows(_ROWS[layout](solution, shown))
    else:
        from pkm_exact.cli.table import print_table

        print_table(robot, configuration, solution, headline(solution), shown, verbose=verbose)
        if joined is not None:
            sys.stdout.write(f"{joined.in_words(shown.numbers)}\n")


def as_object(
    robot: Machine,
    configuration: str | None,
    solution: Solution,
    shown: ShownPoses | None = None,
    joined: JoinedPoses | None = None,
) -> dict[str, Any]:
    """The solution as a JSON object: bounds are exact rationals as strings, assembly modes indices of poses.

    Joined poses go by their numbers, from 1, which poses have whether they are listed or not.
    """
    shown = shown or ShownPoses.of(robot, configuration, solution)
    joined_notes = [] if joined is None else [joined.in_words(shown.numbers)]
    return {
        "robot": robot_object(robot),
        "configuration": configuration_object(robot, configuration, solution.problem),
        "formulation": solution.formulation,
        "method": solution.method,
        "claim": str(solution.claim),
        "completeness_route": str(solution.completeness_route) if solution.completeness_route else None,
        "real_motion": None if solution.real_motion is None else str(solution.real_motion),
        "complex_solutions": solution.complex_solutions,
        "distinct_solutions": solution.distinct_solutions,
        "real_poses": len(solution.poses),
        "poses": [_pose(pose, solution.problem.motion) | shown.entry(place) for place, pose in enumerate(shown.poses)],
        "assembly_modes": assembly_modes(shown.poses),
        **({} if joined is None else {"joined": [list(group) for group in joined.groups]}),
        **({"nearest_to_nominal": list(shown.nearest)} if robot.nominal is not None else {}),
        "notes": [*answer_notes(robot, configuration, solution), *shown.notes, *joined_notes],
    }


def robot_object(robot: Machine) -> dict[str, Any]:
    """Who it is. Joints, vectors and knees are given by file and certificate in the metric, poses never are."""
    metric = list(map(str, robot.metric))
    return {"name": robot.name, "kind": robot.kind, "unit": robot.unit, "source": robot.source, "metric": metric}


def configuration_object(robot: Machine, name: str | None, problem: ForwardProblem) -> dict[str, Any]:
    """Name and squared lengths; for cranks and slides also the joint values and where they put the rods' lower ends."""
    if not isinstance(robot, Robot):
        return {"name": name, "values": constraint_values(problem)}
    entry: dict[str, Any] = {
        "name": name,
        "lengths_squared": [str(leg.length_squared) for leg in problem.distances],
    }
    if robot.chains:
        values = robot.configuration(name).joint_values
        entry["joint_values"] = [list(map(str, v)) if isinstance(v, tuple) else str(v) for v in values]
        entry["knees"] = [list(map(str, leg.base)) for leg in problem.distances]
    return entry


def constraint_values(problem: ForwardProblem) -> dict[str, str]:
    """The values of all constraints that have one, by name: squared lengths, offsets, products."""
    return {
        constraint.name: str(getattr(constraint, constraint.value_field))
        for constraint in problem.constraints
        if constraint.value_field is not None
    }


def _pose(pose: Pose, motion: Motion) -> dict[str, Any]:
    entry = pose_entry(pose) | {"jacobian": _jacobian(pose)}
    if motion.is_planar:
        entry["planar"] = {name: ends(value) for name, value in planar_coordinates(pose).items()}
    return entry


def _jacobian(pose: Pose) -> dict[str, Any] | None:
    if pose.jacobian is None:
        return None
    return {index.name: index.exact(pose) for index in shown_in(Output.JSON)} | {"length": str(pose.jacobian.length)}


def _who(shown: ShownPoses, place: int) -> tuple[str, str]:
    return str(shown.numbers[place]), shown.pose_names[place]


def as_rows(solution: Solution, shown: ShownPoses) -> Iterator[list[str]]:
    """A header and one row per pose: number, name, the claim about the whole list, multiplicity, exact bounds."""
    names = ["t", "x", "y", "z"]
    names += [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    names += [f"q{k}" for k in range(4)]
    indices = shown_in(Output.CSV)
    further = [column for index in indices for column in index.columns]
    yield [
        "pose",
        "name",
        "claim",
        "multiplicity",
        *(f"{name}_{end}" for name in names for end in ("lo", "hi")),
        *further,
        *shown.columns,
    ]
    for place, pose in enumerate(shown.poses):
        parameter = ["", ""] if pose.parameter is None else ends(pose.parameter)
        entries = [*pose.position, *(entry for row in pose.rotation for entry in row), *pose.quaternion]
        bounds = [end for entry in entries for end in ends(entry)]
        measured = [field for index in indices for field in index.fields(pose)]
        first = [*_who(shown, place), str(solution.claim), str(pose.multiplicity), *parameter]
        yield [*first, *bounds, *measured, *shown.fields(place)]


def as_decimal_rows(solution: Solution, shown: ShownPoses) -> Iterator[list[str]]:
    """The same in decimals, right to one unit of the last digit, with angles in degrees."""
    planar = solution.problem.motion.is_planar
    indices = shown_in(Output.CSV)
    names = ["x", "y", "degrees"] if planar else ["x", "y", "z", "roll", "pitch", "yaw", "q0", "q1", "q2", "q3"]
    further = [column for index in indices for column in index.columns]
    yield ["pose", "name", "claim", "multiplicity", *names, *further, *shown.columns]
    for place, pose in enumerate(shown.poses):
        angles = roll_pitch_yaw(pose)
        values = [*pose.position[:2], angles[2]] if planar else [*pose.position, *angles, *pose.quaternion]
        measured = [field for index in indices for field in index.fields(pose)]
        first = [*_who(shown, place), str(solution.claim), str(pose.multiplicity)]
        yield [*first, *("" if value is None else str(value) for value in values), *measured, *shown.fields(place)]


_ROWS: Final = {"csv": as_decimal_rows, "csv_exact": as_rows}

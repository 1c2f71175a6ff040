"""The poses of a mechanism with passive bodies as a person or a program wants them: a table, or one JSON object."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from pkm_exact.cli.table import print_rows
from pkm_exact.poses.planar_coordinates import angle_in_degrees, planar_coordinates
from pkm_exact.poses.pose_spelling import ends, pose_entry
from pkm_exact.roots.interval import decimal

if TYPE_CHECKING:
    from pkm_exact.links.link_solution import Assembly, LinkSolution
    from pkm_exact.poses.pose import Pose


def report_links(solution: LinkSolution, layout: str, *, verbose: bool) -> None:
    """Print a solution to stdout as ``table`` or ``json``."""
    if layout == "json":
        sys.stdout.write(json.dumps(as_object(solution), indent=1) + "\n")
    else:
        _print_table(solution, verbose=verbose)


def as_object(solution: LinkSolution) -> dict[str, Any]:
    """The solution as a JSON object: bounds are exact rationals as strings; poses are those of the platform first."""
    declared, links = solution.links.declared, solution.links
    values = zip(declared.actuated, solution.configuration.values, strict=True)
    return {
        "robot": {"name": links.name, "kind": links.kind, "unit": declared.unit, "source": declared.source},
        "configuration": {
            "name": solution.configuration.name,
            "values": {name: str(value) for name, value in values},
        },
        "method": solution.method,
        "claim": str(solution.claim),
        "completeness_route": str(solution.completeness_route) if solution.completeness_route else None,
        "complex_solutions": solution.complex_solutions,
        "distinct_solutions": solution.distinct_solutions,
        "real_poses": len(solution),
        "platform": links.bodies[links.platform - 1].name,
        "poses": [_entry(solution, assembly) for assembly in solution],
        "notes": list(solution.notes),
    }


def _entry(solution: LinkSolution, assembly: Assembly) -> dict[str, Any]:
    bodies = {
        body.name: _pose(pose, planar=solution.links.is_planar)
        for body, pose in zip(solution.links.bodies, assembly.poses, strict=True)
    }
    platform = _pose(solution.platform_pose(assembly), planar=solution.links.is_planar)
    return platform | {"multiplicity": assembly.multiplicity, "bodies": bodies}


def _pose(pose: Pose, *, planar: bool) -> dict[str, Any]:
    entry = {key: value for key, value in pose_entry(pose).items() if key in ("position", "rotation", "quaternion")}
    if planar:
        entry["planar"] = {name: ends(value) for name, value in planar_coordinates(pose).items()}
    return entry


def _print_table(solution: LinkSolution, *, verbose: bool) -> None:
    links = solution.links
    lines = [f"{links.name} ({links.kind}), configuration {solution.configuration.name}", str(solution)]
    if verbose and solution.system is not None:
        system = solution.system
        lines.append(f"{len(system.system.polynomials)} polynomials in {len(system.variables)} unknowns")
        lines += [f"{stage}: {seconds:.2f} s" for stage, seconds in system.seconds.items()]
    lines += [f"note: {note}" for note in solution.notes]
    sys.stdout.write("\n".join(lines) + "\n")
    if not solution.assemblies:
        return
    platform = links.bodies[links.platform - 1].name
    rotation = "angle [degrees]" if links.is_planar else "unit quaternion (scalar first)"
    unit = links.declared.unit
    sys.stdout.write(f"\n{platform}: position [{unit}], {rotation}, right to one unit of the last digit\n")
    rows = []
    for number, assembly in enumerate(solution, 1):
        several = "" if assembly.multiplicity == 1 else f" (x{assembly.multiplicity or '?'})"
        rows.append((f"{number}{several}", *_cells(solution.platform_pose(assembly), planar=links.is_planar)))
    coordinates = ("x", "y", "theta") if links.is_planar else ("x", "y", "z", "q0", "q1", "q2", "q3")
    print_rows(rows, ("", *coordinates))


def _cells(pose: Pose, *, planar: bool) -> tuple[str, ...]:
    if not planar:
        return tuple(decimal(value) for value in (*pose.position, *pose.quaternion))
    bounds = planar_coordinates(pose)
    angle = angle_in_degrees(bounds["cos"], bounds["sin"])
    return decimal(bounds["x"]), decimal(bounds["y"]), "?" if angle is None else decimal(angle)

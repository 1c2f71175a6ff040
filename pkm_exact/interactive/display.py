"""Results as a person reads them: what is claimed in plain words, poses as cells of a table, and HTML for notebooks.

All text that comes from a file is escaped. Pictures are embedded where matplotlib is installed, and left out elsewhere.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from importlib.util import find_spec
from typing import TYPE_CHECKING, Final

from pkm_exact.claim import Claim
from pkm_exact.claim_wording import meaning, subject
from pkm_exact.geometry.machine import Machine, locked_at
from pkm_exact.geometry.rational import finite_decimal
from pkm_exact.geometry.robot import Robot, jointed
from pkm_exact.indices.index import Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.interactive.answer_notes import answer_notes
from pkm_exact.motions.motion import Motion
from pkm_exact.roots.interval import decimal
from pkm_exact.wording import counted, printable, three_digits

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pkm_exact.numeric.tolerance_result import ToleranceBox, ToleranceResult
    from pkm_exact.poses.pose import Pose
    from pkm_exact.solution import Solution

_COORDINATES: Final = ("x", "y", "z", "q0", "q1", "q2", "q3")
_PLANAR_COORDINATES: Final = ("x", "y", "theta")

_COUNTED: Final = (Claim.COMPLETE, Claim.NOT_PROVEN_COMPLETE)
_ROWS: Final = 40
"""Rows shown of many; the rest is counted."""
_DOTS_PER_INCH: Final = 80
_LONGEST_TEXT: Final = 30


def headline(solution: Solution) -> str:
    """One sentence that says how many solutions were found and what is claimed of them."""
    words = meaning(solution.claim, solution.real_motion, subject(of_legs=solution.problem.has_only_distances))
    if solution.claim not in _COUNTED:
        return words
    distinct, total = solution.distinct_solutions, solution.complex_solutions
    several = "" if distinct == total else f" ({distinct} distinct)"
    count = f"{counted(total, 'complex solution')}{several}, {counted(len(solution.poses), 'real pose')}"
    route = f" ({solution.completeness_route})" if solution.completeness_route else ""
    return f"{count}; {words}{route}"


def pose_header(motion: Motion) -> tuple[str, ...]:
    """The headings of a table of poses.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> pose_header(PLANAR)
    ('', 'x', 'y', 'theta', 'det J', 'cond J')
    """
    coordinates = _PLANAR_COORDINATES if motion.is_planar else _COORDINATES
    return "", *coordinates, *(index.heading for index in shown_in(Output.TABLE))


def pose_cells(number: int, pose: Pose, motion: Motion) -> tuple[str, ...]:
    """A pose as a row of a table, under ``pose_header``: decimals right to one unit of the last."""
    multiple = "" if pose.multiplicity == 1 else f" (x{pose.multiplicity or '?'})"
    coordinates = _planar(pose) if motion.is_planar else tuple(decimal(c) for c in (*pose.position, *pose.quaternion))
    return f"{number}{multiple}", *coordinates, *(index.text(pose) for index in shown_in(Output.TABLE))


def _planar(pose: Pose) -> tuple[str, ...]:
    from pkm_exact.poses.planar_coordinates import angle_in_degrees, planar_coordinates

    bounds = planar_coordinates(pose)
    angle = angle_in_degrees(bounds["cos"], bounds["sin"])
    return decimal(bounds["x"]), decimal(bounds["y"]), "?" if angle is None else decimal(angle)


def solution_html(solution: Solution, robot: Machine | None, configuration: str | None) -> str:
    """Who was solved, what is claimed, the poses in a table, and a picture of them if one can be drawn."""
    planar = solution.problem.motion.is_planar
    parts = [_paragraph(headline(solution))]
    if robot is not None:
        locked = locked_at(robot.kind, configuration)
        parts.insert(0, f"<p><b>{_text(robot.name)}</b> ({_text(robot.kind)}), {_text(locked)}</p>")
    if solution.poses:
        rotation = "angle theta [degrees]" if planar else "unit quaternion, scalar first"
        unit = "the robot's unit" if robot is None else robot.unit
        rows = [pose_cells(number, pose, solution.problem.motion) for number, pose in enumerate(solution.poses, 1)]
        parts.append(_table(pose_header(solution.problem.motion), rows))
        parts.append(_paragraph(f"position [{unit}], {rotation}; right to one unit of the last digit"))
        parts.append(_picture(solution, robot, configuration))
    parts += [_paragraph(f"note: {note}") for note in answer_notes(robot, configuration, solution)]
    return _block(parts)


def solution_figure(solution: Solution, robot: Machine, configuration: str | None) -> Figure:
    """All real poses side by side.

    Raises
    ------
    PkmExactError
        If matplotlib is not installed.
    """
    from pkm_exact.poses.arrays import required

    required("matplotlib", "plot", 'pip install "pkm_exact[plots]"')
    from pkm_exact.pictures.scene import scene_of_solution
    from pkm_exact.pictures.views import poses_figure

    return poses_figure(scene_of_solution(jointed(robot, "plot"), configuration, solution))


def _picture(solution: Solution, robot: Machine | None, configuration: str | None) -> str:
    """The picture as part of the HTML; nothing without matplotlib, or where coordinates are too large to be drawn."""
    if robot is None or find_spec("matplotlib") is None:
        return ""
    from pkm_exact.errors import InputError
    from pkm_exact.pictures.output import figure_bytes

    try:
        data = figure_bytes(solution_figure(solution, robot, configuration), "png", dpi=_DOTS_PER_INCH)
    except InputError as error:
        return _paragraph(f"no picture: {error}")
    return f'<img alt="the real poses side by side" src="data:image/png;base64,{b64encode(data).decode("ascii")}"/>'


def robot_html(robot: Machine) -> str:
    """Name and origin of a robot, its joints or constraints as they were given, and its configurations."""
    axes = "xy" if robot.motion.is_planar else "xyz"
    header, rows = _joint_rows(robot, axes) if isinstance(robot, Robot) else _constraint_rows(robot)
    parts = [f"<p><b>{_text(robot.name)}</b> ({_text(robot.kind)}), {_text(robot.source)}</p>", _table(header, rows)]
    scales = tuple(robot.metric[: len(axes)])
    if set(scales) != {1}:
        roots = ", ".join(f"sqrt({g})" for g in scales)
        parts.append(_paragraph(f"coordinates are to be multiplied by {roots}"))
    names = ", ".join(configuration.name for configuration in robot.configurations[:_ROWS]) or "none"
    more = ", ..." if len(robot.configurations) > _ROWS else ""
    return _block([*parts, _paragraph(f"unit of length: {robot.unit}; configurations: {names}{more}")])


def _joint_rows(robot: Robot, axes: str) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    header = ("", *(f"base {axis}" for axis in axes), *(f"platform {axis}" for axis in axes))
    return header, [
        (str(leg), *(_number(x) for joint in (base, platform) for x in joint[: len(axes)]))
        for leg, (base, platform) in enumerate(zip(robot.base_joints, robot.platform_joints, strict=True), 1)
    ]


def _constraint_rows(robot: Machine) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """The constraints of a mechanism, each with what it asks."""
    from pkm_exact.geometry.mechanism import Mechanism

    if not isinstance(robot, Mechanism):
        return ("constraint", "type", "actuated"), []
    drives = {part.constraint: f"by {drive.name}" for drive in robot.drives for part in drive.parts}
    own = dict.fromkeys(robot.actuated, "yes")
    return ("constraint", "type", "actuated"), [
        (constraint.name, constraint.title, (own | drives).get(constraint.name, "")) for constraint in robot.constraints
    ]


def many_html(summary: str, records: Sequence[Mapping[str, object]]) -> str:
    """The sum of all rows, and the first of them."""
    rows = [
        (str(number), str(row["claim"]).replace("-", " "), str(row["method"]), str(row["count"]), str(row["note"]))
        for number, row in enumerate(records[:_ROWS], 1)
    ]
    left = len(records) - len(rows)
    parts = [_paragraph(summary), _table(("row", "claim", "method", "real poses", "note"), rows)]
    return _block([*parts, _paragraph(f"and {left} more") if left else ""])


def tolerance_html(result: ToleranceResult) -> str:
    """What is proved for all robots within tolerance, and the box of every pose."""
    axes = 2 if result.problem.motion.is_planar else 3
    header = ("pose", *"xyz"[:axes], "position error", "proved for", "dominated by")
    return _block([_paragraph(str(result)), _table(header, [_tolerance_cells(box, axes) for box in result.boxes])])


def _tolerance_cells(box: ToleranceBox, axes: int) -> tuple[str, ...]:
    dominant = "" if box.dominant is None else str(box.dominant)
    followed = box.followed
    share = f"{three_digits(100 * (box.fraction if followed is None else followed.fraction))} %"
    share += "" if followed is None else ", followed"
    bounds = followed.bounds if followed is not None and followed.is_whole else box.bounds
    if bounds is None:
        return str(box.pose), *("?" for _ in range(axes + 1)), share, dominant
    position = (repr(bound).strip("[]") for bound in bounds.position[:axes])
    return str(box.pose), *position, f"at most {three_digits(bounds.position_error.hi, up=True)}", share, dominant


def _number(value: Fraction) -> str:
    """A rational number as it is, cut off if it is long."""
    text = finite_decimal(value) or str(value)
    return text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}…"


def _text(value: str) -> str:
    from html import escape

    return escape(printable(value))


def _paragraph(text: str) -> str:
    return f"<p>{_text(text)}</p>"


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [("th", header), *(("td", row) for row in rows)]
    body = "".join(
        "<tr>" + "".join(f'<{tag} style="text-align: right">{_text(cell)}</{tag}>' for cell in cells) + "</tr>\n"
        for tag, cells in lines
    )
    return f"<table>\n{body}</table>"


def _block(parts: Iterable[str]) -> str:
    return "<div>\n" + "\n".join(part for part in parts if part) + "\n</div>"

"""Leg lengths and joint values at a pose, as a JSON object or as a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from math import atan2, ceil, degrees, floor, prod
from typing import Any, Final

from pkm_exact.cli.report import robot_object
from pkm_exact.cli.table import decimal
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.inverse import Matrix, distance_squared
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.ordinary_pose import OrdinaryMatrix, ordinary_position, ordinary_rotation
from pkm_exact.geometry.quartic_roots import ValueAtRoot
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.surds import Surd
from pkm_exact.geometry.working_modes import (
    CrankMode,
    EnclosedCrank,
    FreeCrank,
    Mode,
    PairedMode,
    SlideMode,
    platform_point,
    working_modes,
)
from pkm_exact.poses.pose import Interval

_LONGEST_EXACT: Final = 50
_LONGEST_NEAR: Final = 12
_LARGEST_DENOMINATOR: Final = 10**9
_ANGLE_WIDTH: Final = Fraction(1, 1 << 60)


def lengths_squared(robot: Robot, position: Vector, rotation: Matrix) -> list[Fraction]:
    """Squared distances between the joints of each leg."""
    pairs = zip(robot.base_joints, robot.platform_joints, strict=True)
    return [distance_squared(a, b, position, rotation, robot.metric) for a, b in pairs]


def joint_modes(robot: Robot, position: Vector, rotation: Matrix) -> list[tuple[Mode, ...]]:
    """The working modes of each chain."""
    chains = zip(robot.chains, robot.base_joints, robot.platform_joints, strict=True)
    return [working_modes(c, a, platform_point(b, position, rotation), robot.metric) for c, a, b in chains]


def pose_object(robot: Machine, position: Vector, rotation: Matrix, nearest: Fraction | None = None) -> dict[str, Any]:
    """Who was asked, and the pose in ordinary coordinates."""
    place, rows = ordinary_position(position, robot.metric), ordinary_rotation(rotation, robot.metric)
    answer: dict[str, Any] = {
        "robot": robot_object(robot),
        "metric": list(map(str, robot.metric)),
        "pose": {"position": list(map(str, place)), "rotation": [list(map(str, row)) for row in rows]},
        "nearest": None if nearest is None else str(nearest),
    }
    if robot.motion.is_planar:
        names = ("x", "y", "cos", "sin")
        answer["pose"]["planar"] = dict(zip(names, map(str, _planar(place, rows)), strict=True))
    return answer


def as_object(
    robot: Robot, position: Vector, rotation: Matrix, width: Fraction, nearest: Fraction | None = None
) -> dict[str, Any]:
    """The answer as a JSON object: every number exact, as "p", "p/q" or "p + q*sqrt(n)", and with bounds.

    The pose is in ordinary coordinates; ``nearest`` is by how much it may differ from the one that was asked for.
    """
    answer = pose_object(robot, position, rotation, nearest)
    if not robot.chains:
        squares = lengths_squared(robot, position, rotation)
        lengths = [exact_and_bounds(Surd.root_of(square), width) for square in squares]
        return answer | {"lengths_squared": list(map(str, squares)), "lengths": lengths}
    modes = joint_modes(robot, position, rotation)
    free = any(isinstance(mode, FreeCrank) for leg in modes for mode in leg)
    return answer | {
        "working_modes": None if free else prod(map(len, modes)),
        "legs": [[mode_object(mode, width) for mode in leg] for leg in modes],
    }


def mode_object(mode: Mode, width: Fraction) -> dict[str, Any]:
    """A working mode: exact numbers with bounds."""
    if isinstance(mode, PairedMode):
        return {"joints": {name: mode_object(value, width) for name, value in mode.values}}
    if isinstance(mode, SlideMode):
        return {"position": exact_and_bounds(mode.position, width)}
    if isinstance(mode, FreeCrank):
        return {"free": True}
    if isinstance(mode, EnclosedCrank):
        polynomial = list(map(str, mode.half_tangent.root.polynomial))
        tangent_object = _enclosed(mode.half_tangent, width) | {"polynomial": polynomial}
        return {"cos": _enclosed(mode.cos, width), "sin": _enclosed(mode.sin, width), "half_tangent": tangent_object}
    tangent = None if mode.half_tangent is None else exact_and_bounds(mode.half_tangent, width)
    return {"cos": exact_and_bounds(mode.cos, width), "sin": exact_and_bounds(mode.sin, width), "half_tangent": tangent}


def exact_and_bounds(value: Surd, width: Fraction) -> dict[str, Any]:
    """A number exactly, and with rational bounds."""
    return {"exact": str(value), "bounds": list(map(str, value.enclosure(width)))}


def _enclosed(value: ValueAtRoot, width: Fraction) -> dict[str, Any]:
    exact = value.radicals
    return {"exact": None if exact is None else str(exact), "bounds": list(map(str, value.enclosure(width)))}


def pose_lines(robot: Machine, position: Vector, rotation: Matrix, nearest: Fraction | None = None) -> list[str]:
    """The same as lines of a text; decimals where the pose is only near the one that was asked for."""
    ordinary, entries = ordinary_position(position, robot.metric), ordinary_rotation(rotation, robot.metric)

    def listed(values: Iterable[Surd]) -> str:
        return ", ".join(_brief(value, nearest) for value in values)

    if robot.motion.is_planar:
        x, y, c, s = _planar(ordinary, entries)
        place = f"position ({listed((x, y))}), cosine and sine ({listed((c, s))})"
    else:
        place = f"position ({listed(ordinary)}), rotation matrix ({'; '.join(map(listed, entries))})"
    lines = [f"{robot.name} ({robot.kind}), {place}"]
    if nearest is not None:
        lines.append(f"the pose is off by at most {nearest} from the one given, which is not rational here")
    return lines


def _brief(value: Surd, nearest: Fraction | None) -> str:
    """The number exactly; in decimals if it is long and only near another one."""
    exact = str(value)
    return exact if nearest is None or len(exact) <= _LONGEST_NEAR else surd_decimal(value, nearest)


def as_text(robot: Robot, position: Vector, rotation: Matrix, width: Fraction, nearest: Fraction | None = None) -> str:
    """The answer as a headline, a line for a configuration if there is one, and a table."""
    lines = pose_lines(robot, position, rotation, nearest)
    if robot.chains:
        lines += _chain_lines(robot, joint_modes(robot, position, rotation), width)
    else:
        squares = lengths_squared(robot, position, rotation)
        lines += ["" if nearest else f"{_assignment('lengths_squared', squares)}\n"]
        lengths = [Surd.root_of(square) for square in squares]
        table = [(f"{i}", surd_decimal(x, width), short(str(x))) for i, x in enumerate(lengths, 1)]
        lines += aligned([("leg", f"length [{robot.unit}]", "exact"), *table])
    return "".join(f"{line}\n" for line in lines)


def _planar(position: Sequence[Surd], rotation: OrdinaryMatrix) -> tuple[Surd, Surd, Surd, Surd]:
    """A planar pose as x, y, cosine and sine."""
    return position[0], position[1], rotation[0][0], rotation[1][0]


def _chain_lines(robot: Robot, modes: list[tuple[Mode, ...]], width: Fraction) -> Iterator[str]:
    unreached = [str(i) for i, leg in enumerate(modes, 1) if not leg]
    if unreached:
        yield f"out of reach: leg {', '.join(unreached)}"
    elif any(isinstance(mode, FreeCrank) for leg in modes for mode in leg):
        yield "infinitely many working modes: the rod's upper end lies on a motor's axis"
    else:
        count = prod(map(len, modes))
        yield f"{count} working mode{'' if count == 1 else 's'}"
    line = _configuration_line(modes)
    if line:
        yield line
    if not any(modes):
        return
    yield ""
    is_crank = KINDS[robot.kind].chain is Crank
    header = (
        ("leg", "angle [degrees]", "cos", "sin", "half tangent") if is_crank else ("leg", f"position [{robot.unit}]")
    )
    rows = [(*_row(i, mode, width),) for i, leg in enumerate(modes, 1) for mode in leg]
    yield from aligned([(*header, "exact"), *rows])


def _row(leg: int, mode: Mode, width: Fraction) -> tuple[str, ...]:
    if isinstance(mode, SlideMode):
        return str(leg), surd_decimal(mode.position, width), short(str(mode.position))
    if not isinstance(mode, CrankMode):
        return str(leg), "any", "", "", "", "any angle"
    cosine, sine, angle = surd_decimal(mode.cos, width), surd_decimal(mode.sin, width), _degrees(mode)
    if mode.half_tangent is None:
        return str(leg), angle, cosine, sine, "infinite", "180 degrees"
    return str(leg), angle, cosine, sine, surd_decimal(mode.half_tangent, width), short(str(mode.half_tangent))


def _degrees(mode: CrankMode) -> str:
    """The angle, right to one unit of the last digit; the other columns have bounds."""
    cosine, sine = (float(sum(value.enclosure(_ANGLE_WIDTH)) / 2) for value in (mode.cos, mode.sin))
    return f"{degrees(atan2(sine, cosine)):.6f}"


def _configuration_line(modes: list[tuple[Mode, ...]]) -> str | None:
    """The first working mode whose joint values are all rational, as a line of a model file."""
    chosen = [next((mode for mode in leg if _is_rational(mode)), None) for leg in modes]
    slides = [mode.position.p for mode in chosen if isinstance(mode, SlideMode)]
    if len(slides) == len(modes):
        return _assignment("slides", slides)
    cranks = [mode for mode in chosen if isinstance(mode, CrankMode)]
    if len(cranks) < len(modes):
        return None
    tangents = [mode.half_tangent.p for mode in cranks if mode.half_tangent is not None]
    if len(tangents) == len(modes):
        return _assignment("half_tangents", tangents)
    return f"cos_sin = [{', '.join(f'[{_quoted(mode.cos.p)}, {_quoted(mode.sin.p)}]' for mode in cranks)}]"


def _is_rational(mode: Mode) -> bool:
    if isinstance(mode, SlideMode):
        return mode.position.is_rational
    return isinstance(mode, CrankMode) and mode.cos.is_rational and mode.sin.is_rational


def _assignment(key: str, values: list[Fraction]) -> str:
    return f"{key} = [{', '.join(map(_quoted, values))}]"


def _quoted(value: Fraction) -> str:
    return str(value) if value.denominator == 1 else f'"{value}"'


def surd_decimal(value: Surd | ValueAtRoot, width: Fraction) -> str:
    """Decimals that are right to one unit of the last: all of them, if they end, else as many as the width asks for.

    >>> surd_decimal(Surd(Fraction(0), Fraction(1, 10**20), 2 * 10**40), Fraction(1, 1000))
    '1.414'
    """
    low, high = value.enclosure(width)
    ends = isinstance(value, Surd) and value.is_rational and value.p.denominator <= _LARGEST_DENOMINATOR
    if (high - low) * 1000 < width and not ends:
        low, high = floor(low / width) * width, ceil(high / width) * width
    return decimal(Interval(low, high))


def short(text: str) -> str:
    """The text, if it is not too long for a table."""
    return text if len(text) <= _LONGEST_EXACT else "long: see --format json"


def aligned(rows: list[tuple[str, ...]]) -> list[str]:
    """The rows as lines whose columns end below each other."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]

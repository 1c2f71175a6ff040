"""The option ``--tolerance`` of ``solve``: boxes for all robots within tolerance, as a table or JSON, and certified."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError
from pkm_exact.geometry.rational import NumberText, parse_positive
from pkm_exact.wording import three_digits

if TYPE_CHECKING:
    from collections.abc import Callable

    from pkm_exact.cli.feasible_poses import ShownPoses
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.geometry.tolerances import Tolerances
    from pkm_exact.numeric.deviations import PoseBounds
    from pkm_exact.numeric.tolerance_result import ToleranceBox, ToleranceResult
    from pkm_exact.roots.interval import Interval
    from pkm_exact.solution import Solution

OF_THE_MODEL: Final = "of the model"
"""What ``--tolerance`` without a number stands for."""
_DEGREES: Final = (Fraction(180 * 10**16, 31415926535897933), Fraction(180 * 10**16, 31415926535897932))
"""Bounds for 180 / pi."""


def parse(context: click.Context, _option: click.Parameter, value: str | None) -> Fraction | str | None:
    """The number that --tolerance denotes, or ``OF_THE_MODEL``."""
    if value is None or value == OF_THE_MODEL:
        return value
    try:
        return parse_positive(value if "/" in value else NumberText(value), "--tolerance")
    except InputError as error:
        raise click.UsageError(
            f"{error}; for the tolerances of the model itself write --tolerance after MODEL.", context
        ) from None


def require_fitting(context: click.Context, given: object, method: str, layout: str) -> None:
    """Refuse what makes no sense together with --tolerance."""
    if given is None:
        return
    if method == "newton":
        raise click.UsageError(
            "--tolerance: a pose of the method newton is uncertified; use exact or krawczyk.", context
        )
    if layout.startswith("csv"):
        raise click.UsageError("--tolerance: has no csv output; use table or json.", context)


def chosen_tolerances(robot: Machine, model: str, given: Fraction | str) -> Tolerances:
    """The tolerances of the model, or the given number for all data."""
    from pkm_exact.geometry.robot import jointed
    from pkm_exact.geometry.tolerances import Tolerances

    if isinstance(given, Fraction):
        return Tolerances.uniform(given)
    legs = jointed(robot, "--tolerance")
    if legs.tolerances is None:
        raise InputError(f"{model}: tolerances: is missing; add [tolerances] or give --tolerance a number")
    return legs.tolerances


def report_tolerances(
    robot: Robot,
    name: str | None,
    solution: Solution,
    tolerances: Tolerances,
    output: str | None,
    layout: str,
    *,
    shown: ShownPoses,
    verbose: bool,
    progress: Callable[[str], None],
) -> ExitCode:
    """Analyse the poses shown, write the certificate and print: first nominal poses, then boxes for all robots."""
    from pkm_exact.certify.build import canonical_bytes
    from pkm_exact.certify.tolerance_build import tolerance_certificate
    from pkm_exact.cli.report import as_object, report
    from pkm_exact.numeric.tolerance import tolerance_boxes

    result = tolerance_boxes(solution.problem, tolerances, solution, progress, asked=shown.numbers)
    if output is not None:
        arguments.write_output(output, canonical_bytes(tolerance_certificate(robot, name, result)))
    if layout == "json":
        content = {**as_object(robot, name, solution, shown), "tolerance": tolerance_object(result)}
        sys.stdout.write(json.dumps(content, indent=1) + "\n")
    else:
        report(robot, name, solution, layout, verbose=verbose, shown=shown)
        _print(robot, result)
    done = result.is_proved if result.unasked else result.is_complete
    return ExitCode.DONE if done else ExitCode.WEAKER_CLAIM


def tolerance_object(result: ToleranceResult) -> dict[str, Any]:
    """The result as a JSON object: bounds are exact rationals as strings, angles in radians."""
    tolerances = result.tolerances
    return {
        "tolerances": {key: str(getattr(tolerances, key)) for key in ("base", "platform", "lengths")},
        "complete": result.is_complete,
        "proved_solutions": result.proved_solutions,
        "boxes": [_box_object(box) for box in result.boxes],
        **({"unasked": list(result.unasked)} if result.unasked else {}),
    }


def _box_object(box: ToleranceBox) -> dict[str, Any]:
    entry: dict[str, Any] = {
        "pose": box.pose,
        "proved": box.is_proved,
        "proved_fraction": str(box.fraction),
        "dominant": None if box.dominant is None else str(box.dominant),
    }
    if box.bounds is not None:
        entry |= _bounds_object(box.bounds)
    if box.followed is not None:
        followed = box.followed
        entry["followed"] = {
            "fraction": str(followed.fraction),
            "cells": followed.cells,
            **_bounds_object(followed.bounds),
        }
    return entry


def _bounds_object(bounds: PoseBounds) -> dict[str, Any]:
    return {
        "position": [_ends(bound) for bound in bounds.position],
        "rotation": [[_ends(bound) for bound in row] for row in bounds.rotation],
        "quaternion": [_ends(bound) for bound in bounds.quaternion],
        "centroid": [_ends(bound) for bound in bounds.centroid],
        "position_error": _ends(bounds.position_error),
        "rotation_error": _ends(bounds.rotation_error),
    }


def _ends(interval: Interval) -> list[str]:
    return [str(interval.lo), str(interval.hi)]


def _print(robot: Robot, result: ToleranceResult) -> None:
    from pkm_exact.cli.table import print_rows

    planar = result.problem.motion.is_planar
    axes = ("x", "y") if planar else ("x", "y", "z")
    t = result.tolerances
    sys.stdout.write(
        f"\ntolerances [{robot.unit}]: base joints {three_digits(t.base)}, platform joints {three_digits(t.platform)}, "
        f"lengths {three_digits(t.lengths)}\n{result}\n\n"
        f"half widths of the boxes and greatest errors over all robots within tolerance: position [{robot.unit}], "
        "rotation [degrees]; the greatest error lies between the two numbers\n"
    )
    header = ("", *(f"+-{axis}" for axis in axes), "position error", "rotation error", "proved for", "dominated by")
    print_rows([_row(box, len(axes)) for box in result.boxes], header)
    for box in result.boxes:
        if not box.is_proved:
            sys.stdout.write(f"{_singular(box)}\n")


def _row(box: ToleranceBox, axes: int) -> tuple[str, ...]:
    dominant = "" if box.dominant is None else str(box.dominant)
    followed = box.followed
    bounds = followed.bounds if followed is not None and followed.is_whole else box.bounds
    share = _percent(box.fraction) if followed is None else f"{_percent(followed.fraction)}, followed"
    if bounds is None:
        return str(box.pose), *("?" for _ in range(axes + 2)), share, dominant
    widths = (three_digits(interval.width / 2, up=True) for interval in bounds.position[:axes])
    distance, angle = bounds.position_error, bounds.rotation_error
    return (
        str(box.pose),
        *widths,
        f"{three_digits(distance.lo)} to {three_digits(distance.hi, up=True)}",
        f"{three_digits(angle.lo * _DEGREES[0])} to {three_digits(angle.hi * _DEGREES[1], up=True)}",
        share,
        dominant,
    )


def _singular(box: ToleranceBox) -> str:
    if not box.fraction:
        return f"pose {box.pose}: singular, or too close to a singularity for any tolerance"
    followed = box.followed
    if followed is not None and followed.is_whole:
        return (
            f"pose {box.pose}: followed over all robots within tolerance, and none is singular there; the numbers are "
            "bounds of the pose that the nominal one becomes, but there may be other poses within them: a box that "
            f"holds one only is proved for {_percent(box.fraction)} of the tolerance. The certificate does not cover "
            "this, and lists the pose as not proved"
        )
    share = f"pose {box.pose}: proved for {_percent(box.fraction)} of the tolerance"
    if followed is not None:
        share += f" with a box, and followed for {_percent(followed.fraction)} without a singularity"
    return (
        f"{share}, not for all of it: beyond, a "
        f"singularity is neither found nor excluded; what moves the platform most is the {box.dominant}"
    )


def _percent(fraction: Fraction) -> str:
    return f"{three_digits(100 * fraction)} %"

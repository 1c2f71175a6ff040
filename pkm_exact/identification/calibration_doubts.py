"""What speaks against a calibration: other units, radians, exchanged columns, fits that run away. Floating point."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import dist, sqrt
from statistics import median
from typing import TYPE_CHECKING, Final

from pkm_exact.wording import with_unit

if TYPE_CHECKING:
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.identification.calibration_fit import LegFit
    from pkm_exact.identification.measured_poses import MeasuredPose

_OTHER_UNIT: Final = 5.0
"""How many times longer or shorter than the model's the lengths read must be."""
_BETTER: Final = 25.0
"""By how much another order of the columns must lessen the sum of the squared residuals of the model."""


def doubts(robot: Robot, measured: Sequence[MeasuredPose], fits: Sequence[LegFit]) -> tuple[str, ...]:
    """The reasons not to believe a fit, in words; none of them is a proof."""
    read = [[float(pose.lengths[leg]) for pose in measured] for leg in range(len(fits))]
    of_model = [
        [length + off for length, off in zip(lengths, fit.before, strict=True)]
        for lengths, fit in zip(read, fits, strict=True)
    ]
    tables = (*_units(robot, read, of_model), *_columns(read, of_model), *_radians(robot, measured, of_model))
    return (*tables, *_run_away(robot, fits))


def _units(robot: Robot, read: list[list[float]], of_model: list[list[float]]) -> Iterator[str]:
    ratios = [a / b for leg in zip(read, of_model, strict=True) for a, b in zip(*leg, strict=True) if b]
    ratio = median(ratios) if ratios else 1.0
    if not 1 / _OTHER_UNIT < ratio < _OTHER_UNIT:
        yield (
            f"the lengths read are about {ratio:.4g} times those of the model at these poses; give positions, lengths "
            f"{with_unit('and model in one unit', robot.unit)}"
        )


def _columns(read: list[list[float]], of_model: list[list[float]]) -> Iterator[str]:
    """Whether the columns fit the legs much better in another order."""
    from scipy.optimize import linear_sum_assignment

    squares = [
        [sum((a - b) ** 2 for a, b in zip(model, lengths, strict=True)) for lengths in read] for model in of_model
    ]
    order = [int(column) for column in linear_sum_assignment(squares)[1]]
    given = sum(squares[leg][leg] for leg in range(len(read)))
    best = sum(squares[leg][column] for leg, column in enumerate(order))
    if best * _BETTER < given:
        count = len(read) * len(read[0])
        moved = [f"l{column + 1} for leg {leg + 1}" for leg, column in enumerate(order) if leg != column]
        yield (
            f"the columns of lengths look exchanged: with {', '.join(moved)} the model is off by "
            f"{sqrt(best / count):.2g} instead of {sqrt(given / count):.2g} (root of the mean square)"
        )


def _radians(robot: Robot, measured: Sequence[MeasuredPose], of_model: list[list[float]]) -> Iterator[str]:
    """Whether the model fits much better if the angles, taken as degrees, are radians."""
    from scipy.spatial.transform import Rotation

    given = better = 0.0
    for k, pose in enumerate(measured):
        # Roll, pitch and yaw as numbers, as they were given.
        numbers = Rotation.from_matrix([[float(x) for x in row] for row in pose.rotation]).as_euler("xyz", degrees=True)
        turned = Rotation.from_euler("xyz", numbers).as_matrix()
        place = [float(x) for x in pose.position]
        for leg, (base, joint) in enumerate(zip(robot.base_joints, robot.platform_joints, strict=True)):
            at = [
                c + sum(r * float(b) for r, b in zip(row, joint, strict=True))
                for c, row in zip(place, turned, strict=True)
            ]
            read = float(pose.lengths[leg])
            given += (of_model[leg][k] - read) ** 2
            better += (dist(at, [float(a) for a in base]) - read) ** 2
    if better * _BETTER < given:
        count = len(measured) * len(of_model)
        yield (
            f"the angles look like radians: taken so the model is off by {sqrt(better / count):.2g} instead of "
            f"{sqrt(given / count):.2g} (root of the mean square); give them in degrees"
        )


def _run_away(robot: Robot, fits: Sequence[LegFit]) -> Iterator[str]:
    """Whether a joint or an offset changes, or has a standard deviation, of more than the robot's size."""
    size = max(
        dist(map(float, a), map(float, b))
        for joints in (robot.base_joints, robot.platform_joints)
        for a, b in combinations(joints, 2)
    )
    changed, loose, unfinished = [], [], []
    for leg, fit in enumerate(fits):
        for name, change, spread in _parts(robot, leg, fit):
            changed += [name] if not change <= size else []
            loose += [name] if not spread <= size else []
        unfinished += [] if fit.is_minimum else [f"leg {leg + 1}"]
    than = f"than base and platform are wide, {with_unit(f'{size:.3g}', robot.unit)}"
    if changed:
        yield f"{_names(changed)}: changed by more {than}; the fit has left the model"
    if loose:
        yield f"{_names(loose)}: standard deviation greater {than}; the measurements do not tell where it is"
    if unfinished:
        yield f"{_names(unfinished)}: the search ended before a minimum"


def _parts(robot: Robot, leg: int, fit: LegFit) -> Iterator[tuple[str, float, float]]:
    """Name, change and standard deviation of both joints of a leg, and of its offset."""
    from pkm_exact.identification.calibration_text import model_values

    size = 2 if robot.motion.is_planar else 3
    before = model_values(robot, leg, len(fit.values))
    squares = [(value - float(old)) ** 2 for value, old in zip(fit.values, before, strict=True)]
    spreads = [row[k] for k, row in enumerate(fit.covariance)]
    for name, start in ((f"A{leg + 1}", 0), (f"B{leg + 1}", size), (f"offset {leg + 1}", 2 * size)):
        entries = slice(start, min(start + size, len(squares)))
        if squares[entries]:
            yield name, sqrt(sum(squares[entries])), sqrt(max(sum(spreads[entries]), 0.0))


def _names(names: Sequence[str]) -> str:
    return ", ".join(names)

"""The equations along a straight piece of a joint path: polynomials of degree 2 in the path parameter.

Between two rows of joint values the values are v(s) = v_0 + s (v_1 - v_0), 0 <= s <= 1. The row of a leg (``centred``)
is then a polynomial of degree 2 in s:

    legs      l = v(s):                 |A|^2 + |B|^2 - l^2
    slides    K = A + v(s) d:           K and |K|^2
    cranks    (1 + t^2) times the row with t = v(s) = tan(angle / 2), for K = A + cos(angle) u + sin(angle) v with
              |u| = |v| and u.v = 0 gives |K|^2 linear in cosine and sine

so that three exact values of s determine it. So do they for constraints of a mechanism: lengths appear squared, offsets
and products as they are, all in the constant term; slides as above, and cranks with the factor 1 + w t^2 (of a half
tangent t divided by sqrt(w)), if nothing else moves the constraint.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final, TypeAlias

from flint import arb, arb_mat

from pkm_exact.balls import ball
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import in_frames
from pkm_exact.errors import InputError, InternalContradictionError
from pkm_exact.geometry.chains import Crank, JointValue, cosine_and_sine
from pkm_exact.geometry.kinds import gough_legs, knees
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.centred import CentredFrames, centred_form, centred_leg, form_size, study_row
from pkm_exact.wording import shown

JointRow: TypeAlias = tuple[Fraction, ...]
"""Leg lengths, slide positions, or half tangents of crank angles; lengths, offsets and products of a mechanism."""
STATIONS: Final = (Fraction(0), Fraction(1, 2), Fraction(1))
"""Shares of a piece of a path at which its equations are evaluated."""


@dataclass(frozen=True, eq=False)
class PathForms:
    """The equations between two rows: Study's condition where it is one, and the constraints.

    Attributes
    ----------
    motion : Motion
    coefficients : tuple of three (n - 1) x 18 matrices
        Of 1, s and s^2.
    """

    motion: Motion
    coefficients: tuple[arb_mat, arb_mat, arb_mat]


def problem_at(robot: Machine, values: JointRow) -> ForwardProblem:
    """The problem of a row of joint values.

    Raises
    ------
    InputError
        If a length is not positive, or two rods join the same two points.
    """
    if not isinstance(robot, Robot):
        return robot.problem_at(values)
    if not robot.chains:
        for leg, value in enumerate(values, 1):
            if value <= 0:
                raise InputError(f"length of leg {leg}: {value} is not positive; give a length greater than 0")
        return robot.problem([value * value for value in values])
    return robot.problem(_locked(robot, values))


def locked_at(robot: Machine, values: JointRow) -> Configuration | None:
    """The configuration in which cranks or slides have the values of a row; None of a robot without any."""
    return _locked(robot, values) if isinstance(robot, Robot) and robot.chains else None


def _locked(robot: Robot, values: JointRow) -> Configuration:
    return robot.lock("row", [cosine_and_sine(v) if has_cranks(robot) else v for v in values])


def path_forms(robot: Machine, frames: CentredFrames, first: JointRow, last: JointRow) -> PathForms:
    """The equations between two rows, at the precision in force."""
    stations = [tuple(a + s * (b - a) for a, b in zip(first, last, strict=True)) for s in STATIONS]
    found = [
        _leg_rows(robot, frames, values) if isinstance(robot, Robot) else _form_rows(robot, frames, values, first)
        for values in stations
    ]
    return quadratic(robot.motion, found)


def quadratic(motion: Motion, found: Sequence[list[list[arb]]]) -> PathForms:
    """The equations from the rows of the constraints at the three ``STATIONS``."""
    study = [study_row()] if motion.has_study_condition else []
    start, between, end = (arb_mat(study + rows) for rows in found)
    square = 2 * (start - 2 * between + end)
    return PathForms(motion, (start, end - start - square, square))


def _leg_rows(robot: Robot, frames: CentredFrames, values: JointRow) -> list[list[arb]]:
    rows = []
    for leg, value in zip(_legs(robot, values), values, strict=True):
        weight = ball(1 + value * value) if has_cranks(robot) else arb(1)
        rows.append([weight * entry for entry in centred_leg(leg, frames, robot.metric)])
    return rows


def _form_rows(robot: Machine, frames: CentredFrames, values: JointRow, first: JointRow) -> list[list[arb]]:
    """The rows of constraints, each divided by one number all along the path."""
    forms, before = (problem_at(robot, row).forms for row in (values, first))
    weights = _form_weights(robot, values)
    sizes = [form_size(in_frames(form, frames.base, frames.platform, frames.unit, robot.metric)) for form in before]
    return [
        [ball(weight) * entry for entry in centred_form(form, frames, robot.metric, size)]
        for form, size, weight in zip(forms, sizes, weights, strict=True)
    ]


def _form_weights(robot: Machine, values: JointRow) -> list[Fraction]:
    """By what each form is multiplied to be a polynomial of degree 2 in the path parameter."""
    if not isinstance(robot, Mechanism):
        raise InternalContradictionError("the constraints of a path belong to no mechanism")
    weights = {constraint.name: Fraction(1) for constraint in robot.constraints}
    for name, value in zip(robot.actuated, values, strict=True):
        drive = robot.drive(name)
        if drive is not None and drive.is_crank:
            weights |= dict.fromkeys((part.constraint for part in drive.parts), 1 + drive.weight * value * value)
    return [weights[found.name] for found in robot.constraints for _ in found.forms(robot.metric)]


def require_quadratic(robot: Machine) -> None:
    """Refuse a mechanism whose forms are no polynomials of degree 2 along a path: where a crank shares a constraint.

    Raises
    ------
    InputError
    """
    if not isinstance(robot, Mechanism):
        return
    movers: dict[str, list[tuple[str, bool]]] = {}
    for name in robot.actuated:
        drive = robot.drive(name)
        moved = {name} if drive is None else {part.constraint for part in drive.parts}
        for constraint in moved:
            movers.setdefault(constraint, []).append((name, drive is not None and drive.is_crank))
    for constraint, found in movers.items():
        if len(found) > 1 and any(is_crank for _, is_crank in found):
            raise InputError(
                f"constraint {shown(constraint)}: a crank moves it, and so does another actuator "
                f"({', '.join(name for name, _ in found)}), but a branch can be followed only where each crank has "
                "constraints of its own; solve row by row (`sweep`)"
            )


def has_cranks(robot: Robot) -> bool:
    """Whether the joint values are half tangents."""
    return bool(robot.chains) and isinstance(robot.chains[0], Crank)


def _legs(robot: Robot, values: Sequence[Fraction]) -> tuple[Distance, ...]:
    """The legs, or rods, anywhere between two rows."""
    if not robot.chains:
        return gough_legs(robot.base_joints, robot.platform_joints, tuple(value * value for value in values))
    turned: tuple[JointValue, ...] = tuple(map(cosine_and_sine, values)) if has_cranks(robot) else tuple(values)
    feet = knees(robot.base_joints, robot.chains, turned)
    return gough_legs(feet, robot.platform_joints, tuple(chain.rod_squared for chain in robot.chains))

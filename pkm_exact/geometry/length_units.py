"""Units of length that are known, and a robot in another one of them: exactly, and only where it is asked for."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import Final, TypeVar

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Chain, Crank, JointValue, Slide
from pkm_exact.geometry.kinds import Joints
from pkm_exact.geometry.limits import Limits, Pair
from pkm_exact.geometry.nominal_pose import NominalPose
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.wording import shown

METRES: Final = {
    "mm": Fraction(1, 1000),
    "cm": Fraction(1, 100),
    "m": Fraction(1),
    "in": Fraction(254, 10000),
    "ft": Fraction(3048, 10000),
}
"""How many metres one of each is, exactly."""

AnyRobot = TypeVar("AnyRobot", bound=Robot)


def factor_between(old: str, new: str) -> Fraction:
    """By what lengths in one unit are multiplied to be lengths in another.

    Raises
    ------
    InputError
        If one is not known.

    Examples
    --------
    >>> factor_between("in", "mm")
    Fraction(127, 5)
    """
    for unit, where in ((old, "unit"), (new, "--unit")):
        if unit not in METRES:
            raise InputError(f"{where}: {shown(unit)} is no unit that is known; use one of: {', '.join(METRES)}")
    return METRES[old] / METRES[new]


def in_unit(robot: AnyRobot, unit: str) -> AnyRobot:
    """The same robot with all lengths in another unit. Angles and directions stay.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_jointed_robot
    >>> robot = read_jointed_robot("models/rolland-6-6.toml", "convert")
    >>> metres = in_unit(robot, "m")
    >>> metres.base_joints[0][0], metres.configuration().lengths_squared[0], metres.unit
    (Fraction(464141, 1000000), Fraction(25, 16), 'm')
    >>> in_unit(metres, "mm").base_joints == robot.base_joints
    True
    """
    factor = factor_between(robot.unit, unit)
    nominal = robot.nominal
    return replace(
        robot,
        unit=unit,
        source=f"{robot.source}; converted from {robot.unit} to {unit}",
        base_joints=_joints(robot.base_joints, factor),
        platform_joints=_joints(robot.platform_joints, factor),
        chains=tuple(_chain(chain, factor) for chain in robot.chains),
        configurations=tuple(_configuration(entry, factor) for entry in robot.configurations),
        tolerances=None if robot.tolerances is None else robot.tolerances.scaled(factor),
        limits=None if robot.limits is None else _limits(robot.limits, factor),
        nominal=None if nominal is None else NominalPose(_scaled(nominal.position, factor), nominal.rotation),
        written_digit=None if robot.written_digit is None else robot.written_digit * factor,
    )


def _scaled(vector: Vector, factor: Fraction) -> Vector:
    x, y, z = vector
    return x * factor, y * factor, z * factor


def _joints(joints: Joints, factor: Fraction) -> Joints:
    return tuple(_scaled(joint, factor) for joint in joints)


def _chain(chain: Chain, factor: Fraction) -> Chain:
    rod = chain.rod_squared * factor**2
    if isinstance(chain, Slide):
        return replace(chain, rod_squared=rod)
    return Crank(_scaled(chain.at_0, factor), _scaled(chain.at_90, factor), rod)


def _configuration(entry: Configuration, factor: Fraction) -> Configuration:
    def value(found: JointValue) -> JointValue:
        return found if isinstance(found, tuple) else found * factor

    return replace(
        entry,
        lengths_squared=tuple(square * factor**2 for square in entry.lengths_squared),
        joint_values=tuple(map(value, entry.joint_values)),
        written_digit=None if entry.written_digit is None else entry.written_digit * factor,
    )


def _limits(limits: Limits, factor: Fraction) -> Limits:
    def pairs(found: tuple[Pair, ...]) -> tuple[Pair, ...]:
        return tuple((low * factor, high * factor) for low, high in found)

    return replace(
        limits,
        lengths=pairs(limits.lengths),
        slides=pairs(limits.slides),
        leg_distance=None if limits.leg_distance is None else limits.leg_distance * factor,
        position=pairs(limits.position),
    )

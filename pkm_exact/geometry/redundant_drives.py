"""Drives that a pose leaves free: slides and cranks that move only legs whose own lengths are actuated.

A hexapod on a carriage reaches a pose wherever its carriage stands, with other lengths of its legs. So its inverse
kinematics is asked with the carriage at the values of a configuration.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.mechanism import LockedValues, Mechanism


@dataclass(frozen=True)
class Standing:
    """A mechanism whose redundant drives stand still.

    Attributes
    ----------
    mechanism : Mechanism
        Without these drives.
    configuration : str or None
        Where they stand; None if there are none.
    values : tuple of (str, value)
        Names of the redundant drives with what they are locked at.
    """

    mechanism: Mechanism
    configuration: str | None = None
    values: tuple[tuple[str, JointValue], ...] = ()


def redundant_drives(mechanism: Mechanism) -> tuple[str, ...]:
    """Names of the drives all of whose constraints are actuated themselves.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> redundant_drives(read_robot("models/carriage-hexapod.toml")), redundant_drives(read_robot("models/delta.toml"))
    (('X', 'Y', 'tilt'), ())
    """
    own = {name for name in mechanism.actuated if mechanism.drive(name) is None}
    return tuple(drive.name for drive in mechanism.drives if {part.constraint for part in drive.parts} <= own)


def standing(mechanism: Mechanism, configuration: LockedValues) -> Standing:
    """The mechanism with its redundant drives at the values of a configuration.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> robot = read_robot("models/carriage-hexapod.toml")
    >>> found = standing(robot, robot.configuration())
    >>> found.mechanism.actuated, [name for name, _ in found.values]
    (('leg 1', 'leg 2', 'leg 3', 'leg 4', 'leg 5', 'leg 6'), ['X', 'Y', 'tilt'])
    """
    free = redundant_drives(mechanism)
    if not free:
        return Standing(mechanism)
    values = dict(zip(mechanism.actuated, configuration.values, strict=True))
    constraints = {constraint.name: constraint for constraint in mechanism.constraints}
    for drive in mechanism.drives:
        if drive.name in free:
            constraints = drive.moved(constraints, values[drive.name], f"configuration {configuration.name}")
    still = replace(
        mechanism,
        constraints=tuple(constraints.values()),
        drives=tuple(drive for drive in mechanism.drives if drive.name not in free),
        actuated=tuple(name for name in mechanism.actuated if name not in free),
        configurations=(),
    )
    return Standing(still, configuration.name, tuple((name, values[name]) for name in free))

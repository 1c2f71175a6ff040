"""Where following begins: a pose in ordinary coordinates as a point in Study coordinates, and the legs there."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2
from typing import Final

import numpy as np

from pkm_exact.errors import InputError
from pkm_exact.following.follower import Followed, next_pose, settled
from pkm_exact.following.leg_tables import Array, LegTables
from pkm_exact.geometry.robot import Configuration, Robot

MOST_HALVINGS: Final = 8
"""Of a way whose poses are not proved to be of one mode at once."""


def study_point(tables: LegTables, position: Sequence[float], quaternion: Sequence[float]) -> Array:
    """A pose in Study coordinates, with N(e) about 1.

    Raises
    ------
    InputError
        If the quaternion is 0 or a number is none.

    Examples
    --------
    >>> from pkm_exact.following.leg_tables import leg_tables
    >>> from pkm_exact.geometry.reader import read_jointed_robot
    >>> tables = leg_tables(read_jointed_robot("models/3-rpr-merlet-p.toml", "following"))
    >>> study_point(tables, (5, 5), (1, 0, 0, 0)).tolist()
    [1.0, 0.0, 0.3125, 0.3125]
    """
    place = np.zeros(3)
    place[: len(position)] = position
    c = place / tables.unit / np.sqrt(tables.weights)
    e = np.array(quaternion, dtype=float) / tables.roots
    if not (np.all(np.isfinite(place)) and np.all(np.isfinite(e)) and np.any(e)):
        raise InputError("start: is no pose; give a position, and a quaternion that is not 0")
    g = tables.weights
    f = [-float((g * c) @ e[1:])]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        f.append(float(g[i] * e[0] * c[i] + c[j] * e[k + 1] - c[k] * e[j + 1]))
    point = np.concatenate([e, f])[list(tables.support)]
    found: Array = point / np.sqrt(point @ tables.norm @ point)
    return found


def lengths_at(tables: LegTables, point: Array) -> Array:
    """The lengths of actuated legs at a point, about: the roots of their equations' values without them."""
    squares = (tables.legs @ point) @ point / float(point @ tables.norm @ point)
    found: Array = np.sqrt(np.maximum(squares, 0)) * tables.unit
    return found


def joint_values(robot: Robot, configuration: Configuration) -> Array:
    """The joint values of a configuration as doubles: lengths, crank angles in radians, positions.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_jointed_robot
    >>> robot = read_jointed_robot("models/3-rpr-merlet-p.toml", "following")
    >>> joint_values(robot, robot.configuration()).tolist()
    [7.0710678118654755, 5.0990195135927845, 5.0]
    """
    if not robot.chains:
        lengths: Array = np.sqrt(np.array([float(square) for square in configuration.lengths_squared]))
        return lengths
    return np.array(
        [
            atan2(float(value[1]), float(value[0])) if isinstance(value, tuple) else float(value)
            for value in configuration.joint_values
        ]
    )


def first_pose(tables: LegTables, values: Array, point: Array) -> Followed:
    """The pose for joint values that follows from a start.

    Of actuated legs the lengths at the start are known: the way begins there, so that the mode is the start's.
    """
    if tables.robot.chains:
        return settled(tables, values, point)
    return follow_to(settled(tables, lengths_at(tables, point), point), values)


def follow_to(last: Followed, values: Array) -> Followed:
    """The next pose; where it is not proved at once to be of the same mode, on a way of up to 2^8 steps.

    Nothing else is proved of it on the shorter steps than in one: that all joint values between have a pose.
    """
    found = next_pose(last.tables, values, last)
    if found.same_mode or not last.is_proved:
        return found
    at, goal, step, current = 0.0, np.array(values, dtype=float), 0.5, last
    while step >= 2.0**-MOST_HALVINGS:
        further = min(1.0, at + step)
        place = goal if further == 1.0 else last.values + further * (goal - last.values)
        tried = next_pose(last.tables, place, current)
        if not tried.same_mode:
            step /= 2
            continue
        if further == 1.0:
            return tried
        at, current, step = further, tried, 2 * step
    return found

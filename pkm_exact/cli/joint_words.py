"""The option ``--joints`` as a configuration of a robot; what stands in for an angle is noted on stderr."""

from __future__ import annotations

from collections.abc import Sequence

import click

from pkm_exact.cli.arguments import JointWord
from pkm_exact.geometry import given_joints
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot


def joint_configuration(robot: Robot | Mechanism, words: Sequence[JointWord]) -> tuple[Robot | Mechanism, str]:
    """The robot with a further configuration at these joint values, and the configuration's name.

    Raises
    ------
    InputError
        If the values do not fit the robot.
    """
    return given_joints.joint_configuration(
        robot, words, "--joints", lambda stand_in: click.echo(f"note: {stand_in}", err=True)
    )

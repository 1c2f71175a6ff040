"""What is to be known of the joint values of a configuration, on stderr, where the answer itself has no notes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from pkm_exact.geometry.angle_degrees import stand_in_sentences
from pkm_exact.geometry.machine import Machine

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pkm_exact.geometry.angle_degrees import StandIn


def say_joint_notes(robot: Machine, configuration: str | None, *, unless: bool = False) -> None:
    """Say what stands in for angles in degrees, and which numbers are taken as half tangents."""
    for entry in () if unless else robot.configurations:
        if entry.name == configuration:
            say_notes(getattr(entry, "stand_ins", ()))


def say_notes(found: Sequence[StandIn | str]) -> None:
    """The sentences on stderr."""
    for note in stand_in_sentences(found):
        click.echo(f"note: {note}", err=True)

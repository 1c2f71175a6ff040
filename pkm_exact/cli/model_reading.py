"""Models as commands read them: one line on stderr says so if the coordinates in the file are not ordinary ones."""

from __future__ import annotations

from collections.abc import Sequence
from math import isqrt
from typing import TYPE_CHECKING

import click

from pkm_exact.cli.program import PROGRAM
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from os import PathLike

    from pkm_exact.geometry.linkage import Linkage
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.robot import Robot


def announced_model(path: str) -> Robot | Mechanism:
    """The robot that a model file describes (``geometry.reader.read_robot``)."""
    from pkm_exact.geometry.reader import read_robot

    robot = read_robot(path)
    _announce(robot, path)
    return robot


def announced_any(path: str) -> Robot | Mechanism | Linkage:
    """The same, or the mechanism of bodies and joints of a file of that kind (``geometry.reader.read_any``)."""
    from pkm_exact.geometry.model_kinds import is_links

    found = _announced(path)
    return announced_model(path) if is_links(found) else found  # the former refuses it


def announced_solvable(path: str) -> Robot | Mechanism | Links:
    """The robot that a model file describes, or the mechanism with passive bodies of a file of that kind."""
    from pkm_exact.geometry.model_kinds import is_linkage

    found = _announced(path)
    return announced_model(path) if is_linkage(found) else found  # the former refuses it


def _announced(path: str) -> Robot | Mechanism | Linkage | Links:
    from pkm_exact.geometry.model_kinds import is_linkage, is_links
    from pkm_exact.geometry.reader import read_any

    found = read_any(path)
    if not is_linkage(found) and not is_links(found):
        _announce(found, path)
    return found


def announced_robot(path: str | PathLike[str], question: str) -> Robot:
    """The same for a question that needs joints (``geometry.reader.read_jointed_robot``)."""
    from pkm_exact.geometry.reader import read_jointed_robot

    robot = read_jointed_robot(path, question)
    _announce(robot, str(path))
    return robot


def _announce(robot: Robot | Mechanism, path: str) -> None:
    note = metric_note(robot.metric[: 2 if robot.motion.is_planar else 3])
    if note is not None:
        click.echo(f"{PROGRAM}: note: {printable(path)}: {note}", err=True)
    angles = [found.off for found in robot.stand_ins if not isinstance(found, str)]
    if angles:
        click.echo(
            f"{PROGRAM}: note: {printable(path)}: exact angles next to those in degrees are taken, off by at most "
            f"{float(max(angles)):.0e} degrees where cosine and sine are not rational",
            err=True,
        )


def metric_note(metric: Sequence[int]) -> str | None:
    """How ordinary coordinates come from those in the file, or None if they are the same.

    Examples
    --------
    >>> metric_note((1, 3, 1))
    'metric [1, 3, 1]: the ordinary y is sqrt(3) times the y in the file; poses given here or printed are ordinary'
    >>> metric_note((1, 1, 1)) is None
    True
    """
    scaled = [
        f"the ordinary {axis} is {_root(g)} times the {axis} in the file"
        for axis, g in zip("xyz", metric, strict=False)
        if g != 1
    ]
    if not scaled:
        return None
    return f"metric [{', '.join(map(str, metric))}]: {', '.join(scaled)}; poses given here or printed are ordinary"


def _root(g: int) -> str:
    root = isqrt(g)
    return str(root) if root * root == g else f"sqrt({g})"

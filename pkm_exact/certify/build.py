"""Certificates: what a solve found, written down so that a program that shares nothing with the solver can replay it.

The format is described field by field in ``docs/certificates.md``; its schema is ``certificate-1.schema.json`` in
this folder. What version 1 cannot say is written in version 2 (``build_constraints``). The same input gives the same
bytes: nothing in a certificate depends on the time, the machine, a precision or a prime.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build_constraints import constraints_content
from pkm_exact.certify.certificate_entries import claim_entries, pose_entries, steps_entry, texts
from pkm_exact.certify.sealing import canonical_bytes as canonical_bytes
from pkm_exact.certify.sealing import digest_of
from pkm_exact.certify.sealing import sealed as sealed
from pkm_exact.claim import CompletenessRoute
from pkm_exact.files import write_whole
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.solution import Solution

FORMAT: Final = "pkm_exact certificate"
VERSION: Final = 1
_ROUTES: Final = (None, CompletenessRoute.REFINED_BEZOUT, CompletenessRoute.EXACT_ELIMINATION)


def certificate(robot: Machine, configuration_name: str | None, solution: Solution) -> dict[str, Any]:
    """The certificate of a solution, as a JSON object with its digest.

    Parameters
    ----------
    robot : Robot
        The robot whose problem was solved.
    configuration_name : str or None
        Name of the configuration; None if the lengths were given freely.
    solution : Solution
        What the solver found.

    Raises
    ------
    ValueError
        If the solution answers another problem than the robot's.

    Examples
    --------
    >>> from pkm_exact import read_robot, solve
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> content = certificate(robot, "home", solve(robot.problem(robot.configuration())))
    >>> content["claim"], content["real_poses"]
    ('complete', 2)
    """
    return sealed(_content(robot, configuration_name, solution))


def certificate_bytes(robot: Machine, configuration_name: str | None, solution: Solution) -> bytes:
    """What ``write_certificate`` writes of a solution, spelled out only once; errors as ``certificate``."""
    body = canonical_bytes(_content(robot, configuration_name, solution))
    return body.removesuffix(b"\n}\n") + f',\n "digest": "{digest_of(body)}"\n}}\n'.encode("ascii")


def _content(machine: Machine, configuration_name: str | None, solution: Solution) -> dict[str, Any]:
    """The certificate without its digest, of version 1 where that can say it."""
    if not isinstance(machine, Robot):
        if not (isinstance(machine, Mechanism) and machine.asks(solution.problem)):
            raise ValueError(f"the solution is not one of {machine!r}: constraints or metric differ")
        return constraints_content(machine, configuration_name, solution)
    # The checker knows legs only: cranks and slides are certified as the 6-UPS robot with their knees as base joints.
    robot = machine.as_gough(machine.configuration(configuration_name) if machine.chains else None)
    lengths_squared = [leg.length_squared for leg in solution.problem.distances]
    if robot.problem(lengths_squared) != solution.problem:
        raise ValueError(f"the solution is not one of {robot!r}: joints or metric differ")
    if not is_of_version_1(solution):
        return constraints_content(robot, configuration_name, solution)
    return {
        "format": FORMAT,
        "version": VERSION,
        "robot": robot_entry(robot),
        "configuration": {"name": configuration_name, "lengths_squared": texts(lengths_squared)},
        **claim_entries(solution),
        "elimination": steps_entry(solution),
        **pose_entries(solution),
    }


def is_of_version_1(solution: Solution) -> bool:
    """Whether version 1 has the words for what is proved of a robot with as many legs as freedoms."""
    from pkm_exact.completeness.pose_slices import MorePoses

    return solution.completeness_route in _ROUTES and not isinstance(solution.self_motion, MorePoses)


def robot_entry(robot: Robot) -> dict[str, Any]:
    """The robot as certificates spell it; the third axis of a planar one enters nothing, its metric is written as 1."""
    metric = (*robot.metric[:2], 1) if KINDS[robot.kind].motion.is_planar else robot.metric
    return {
        "name": robot.name,
        "kind": robot.kind,
        "unit": robot.unit,
        "source": robot.source,
        "metric": texts(metric),
        "base": [texts(joint) for joint in robot.base_joints],
        "platform": [texts(joint) for joint in robot.platform_joints],
    }


def write_certificate(path: str | os.PathLike[str], content: dict[str, Any]) -> None:
    """Write a certificate to a file, which appears whole or not at all.

    Raises
    ------
    OSError
        If the file cannot be written; what stood there before is then untouched.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from pkm_exact import Robot, certificate, check_bytes, solve
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> content = certificate(robot, None, solve(robot.problem(robot.configuration())))
    >>> with TemporaryDirectory() as folder:
    ...     write_certificate(Path(folder) / "it.json", content)
    ...     str(check_bytes((Path(folder) / "it.json").read_bytes()).status)
    'accepted'
    """
    write_whole(path, canonical_bytes(content))

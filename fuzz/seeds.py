"""Good inputs for each target to begin with."""

from __future__ import annotations

from targets import PLAIN, ROOT

from pkm_exact import Robot, certificate, read_robot, solve, solve_krawczyk
from pkm_exact.certify.build import canonical_bytes

SMALL = 12_000
"""Bytes of golden certificates that serve as seeds: quick to check."""


def seeds(target: str) -> list[bytes]:
    """Good inputs to begin with."""
    if target == "model":
        return [path.read_bytes() for path in sorted((ROOT / "models").glob("*.toml"))]
    if target == "path":
        return [b"l1,l2,l3\n7,5,5\n7.5,5,5\n", b"time,l1,l2,l3\n0,7,5,5\n1,15/2,5,5e0\n", b"# none\n\n7,5,5\n7,5,5\n"]
    if target == "command":
        return [bytes([255 - 1 - index]) for index in range(len(PLAIN))] + [bytes([index]) for index in range(64)]
    found = [path.read_bytes() for path in sorted((ROOT / "certs").glob("*.json")) if path.stat().st_size < SMALL]
    return [*found, *_other_certificates()]


def _other_certificates() -> list[bytes]:
    """Of the kinds that no golden file has: Krawczyk's operator, and a robot that moves."""
    robot = read_robot(ROOT / "models" / "3-rpr-merlet-p.toml")
    configuration = robot.configuration()
    problem = robot.problem(configuration)
    parallelogram = Robot("parallelogram", "3-RPR", "m", "made up", robot.base_joints, robot.base_joints)
    documents = [
        certificate(robot, configuration.name, solve_krawczyk(problem)),
        certificate(parallelogram, None, solve(parallelogram.problem([25, 25, 25]))),
    ]
    return [canonical_bytes(document) for document in documents]

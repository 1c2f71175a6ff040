"""Good inputs for each target to begin with."""

from __future__ import annotations

from targets import PLAIN, ROOT

from pkm_exact import Robot, Tolerances, certificate, read_robot, solve, solve_krawczyk, solve_system, tolerance_boxes
from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.tolerance_build import tolerance_certificate

SMALL = 12_000
"""Bytes of golden certificates that serve as seeds: quick to check."""
SMALL_SYSTEM = 200
"""The same of systems."""
SYSTEMS = (
    b"x,y\n0\nx^2+y^2-4,\nx*y-1\n",
    b"x\n0\n7/3*x^3-x\n",
    b"x, y\r\n0\r\n-x*y+1,\r\nx-1/2*y^2\r\n",
    b"x,y\n0\nx-1,\nx-2\n",
    b"x,y\n0\nx*y-x,\nx^2-x\n",
)
SMALL_TOLERANCES = Tolerances.uniform("1/1000000")


def seeds(target: str) -> list[bytes]:
    """Good inputs to begin with."""
    if target == "model":
        return [path.read_bytes() for path in sorted((ROOT / "models").glob("*.toml"))]
    if target == "path":
        return [b"l1,l2,l3\n7,5,5\n7.5,5,5\n", b"time,l1,l2,l3\n0,7,5,5\n1,15/2,5,5e0\n", b"# none\n\n7,5,5\n7,5,5\n"]
    if target == "lengths":
        return [
            b"l1,l2,l3\n7,5,5\n# none\n7.5,5,1e1\n",
            b"7,5,5\r\n,,\r\n15/2,x,5\r\n",
            b"\xef\xbb\xbfl1,l2,l3\n\n7,5\n",
        ]
    if target == "system":
        files = sorted((ROOT / "tests" / "systems").glob("*.ms"))
        return [*(path.read_bytes() for path in files if path.stat().st_size < SMALL_SYSTEM), *SYSTEMS]
    if target == "command":
        return [bytes([255 - 1 - index]) for index in range(len(PLAIN))] + [bytes([index]) for index in range(64)]
    found = [path.read_bytes() for path in sorted((ROOT / "certs").glob("*.json")) if path.stat().st_size < SMALL]
    return [*found, *_other_certificates()]


def _other_certificates() -> list[bytes]:
    """Of the kinds that no golden file has: Krawczyk's operator, a robot that moves, tolerances, polynomial systems."""
    robot = read_robot(ROOT / "models" / "3-rpr-merlet-p.toml")
    configuration = robot.configuration()
    problem = robot.problem(configuration)
    parallelogram = Robot("parallelogram", "3-RPR", "m", "made up", robot.base_joints, robot.base_joints)
    documents = [
        certificate(robot, configuration.name, solve_krawczyk(problem)),
        certificate(parallelogram, None, solve(parallelogram.problem([25, 25, 25]))),
        tolerance_certificate(robot, configuration.name, tolerance_boxes(problem, SMALL_TOLERANCES, solve(problem))),
    ]
    systems = (["x^2 + y^2 - 4", "x*y - 1"], ["x^2", "y^2 - 1"], ["x*y - 1", "x*y - 2"], ["x*y - x", "x^2 - x"])
    solved = [solve_system(polynomials).certificate().data for polynomials in systems]
    return [*(canonical_bytes(document) for document in documents), *solved]

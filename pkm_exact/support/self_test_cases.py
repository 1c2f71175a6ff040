"""Whether an installation works: two small robots and a system solved, certified, checked, and forgeries refused.

Needs nothing but the package. Every check is against what must be so by mathematics: a pose that the robot was built
around, the degree 40 (6 in the plane) of the variety of motions, and certificates that two checkers replay.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from pkm_exact.geometry.robot import Robot
    from pkm_exact.interactive.system_answers import SystemSolution
    from pkm_exact.solution import Solution

_PLANAR: Final = """
schema = 1
name = "selftest, planar"
kind = "3-RPR"
unit = "1"
source = "a general 3-RPR robot, made up"
base = { joints = [[0, 0], [10, 0], [3, 10]] }
platform = { joints = [[0, 0], [4, 0], [2, 2]] }
[[configurations]]
name = "home"
pose = { position = [5, 4], half_tangent = "1/3" }
"""
_SPATIAL: Final = """
schema = 1
name = "selftest"
kind = "6-UPS"
unit = "1"
source = "a general 6-6 robot, made up"
base = { joints = [[0, 0, 0], [1, -1, -2], [3, -1, -2], [3, 1, -1], [1, 2, -2], [4, 0, 0]] }
platform = { joints = [[0, 0, 0], [1, 0, 1], [0, 1, 1], [-1, 0, 1], [0, -1, 0], [1, 1, 1]] }
[[configurations]]
name = "home"
pose = { position = [1, -1, 2], quaternion = [3, 1, -1, 2] }
"""
_SYSTEM: Final = ("x^2 + y^2 = 4", "x*y = 1")
"""A circle and a hyperbola: four points, all real."""
_PRIME: Final = 2**62 - 57
_PLANAR_HOME: Final = (Fraction(5), Fraction(4), Fraction(0))
_SPATIAL_HOME: Final = (Fraction(1), Fraction(-1), Fraction(2))


class FailedCheckError(Exception):
    """A check did not come out as it must; the message says how."""


@dataclass(frozen=True)
class Check:
    """The outcome of one check.

    Attributes
    ----------
    name : str
    passed : bool
    detail : str
        What was found, or what went wrong.
    """

    name: str
    passed: bool
    detail: str


def run_checks() -> Iterator[Check]:
    """All checks, one after another; what goes wrong in one ends that check only."""
    robots = _Robots()
    checks: tuple[tuple[str, Callable[[], str]], ...] = (
        ("FLINT's arithmetic", _arithmetic),
        ("3-RPR, exact", robots.planar_is_right),
        ("6-6, exact", robots.exact_is_right),
        ("6-6, krawczyk", robots.krawczyk_is_right),
        ("both methods agree", robots.methods_agree),
        ("polynomial system", robots.system_is_right),
        ("certificates accepted", robots.certificates_are_accepted),
        ("forgeries rejected", robots.forgeries_are_rejected),
    )
    for name, check in checks:
        try:
            yield Check(name, True, check())
        except FailedCheckError as error:
            yield Check(name, False, str(error))
        except Exception as error:  # whatever a broken installation does
            yield Check(name, False, f"{type(error).__name__}: {error}")


def _require(holds: bool, failure: str) -> None:
    if not holds:
        raise FailedCheckError(failure)


def _arithmetic() -> str:
    """Rationals, matrices modulo a prime of 62 bits, and balls around real numbers."""
    from flint import arb, fmpq, fmpz_mat, nmod_mat

    _require(fmpq(1, 3) + fmpq(1, 6) == fmpq(1, 2), "1/3 + 1/6 is not 1/2")
    rows = [[2, 1, _PRIME], [1, 3, 1], [1, 1, _PRIME + 1]]
    expected = _determinant(rows)
    _require(int(fmpz_mat(rows).det()) == expected, "a determinant is wrong")
    _require(int(nmod_mat(fmpz_mat(rows), _PRIME).det()) == expected % _PRIME, "a residue is wrong")
    _require(bool((arb(2).sqrt() ** 2).contains(2)), "the square of sqrt(2) does not enclose 2")
    return "rationals, residues, balls"


def _determinant(rows: list[list[int]]) -> int:
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


class _Robots:
    """The two robots and the system; what is computed of them is kept for the checks that follow."""

    @cached_property
    def planar_robot(self) -> Robot:
        from pkm_exact.geometry.reader import robot_from_toml
        from pkm_exact.geometry.robot import jointed

        return jointed(robot_from_toml(_PLANAR), "selftest")

    @cached_property
    def robot(self) -> Robot:
        from pkm_exact.geometry.reader import robot_from_toml
        from pkm_exact.geometry.robot import jointed

        return jointed(robot_from_toml(_SPATIAL), "selftest")

    @cached_property
    def planar(self) -> Solution:
        from pkm_exact.engine import solve

        return solve(self.planar_robot.problem(self.planar_robot.configuration()))

    @cached_property
    def exact(self) -> Solution:
        from pkm_exact.engine import solve

        return solve(self.robot.problem(self.robot.configuration()))

    @cached_property
    def krawczyk(self) -> Solution:
        from pkm_exact.numeric_engine import solve_krawczyk

        return solve_krawczyk(self.robot.problem(self.robot.configuration()))

    @cached_property
    def certificates(self) -> list[dict[str, Any]]:
        """Those of the planar robot, of the exact engine, and of the krawczyk method."""
        from pkm_exact.certify.build import certificate

        return [
            certificate(self.planar_robot, "home", self.planar),
            certificate(self.robot, "home", self.exact),
            certificate(self.robot, "home", self.krawczyk),
        ]

    def planar_is_right(self) -> str:
        return _right(self.planar, "exact", 6, _PLANAR_HOME)

    def exact_is_right(self) -> str:
        return _right(self.exact, "exact", 40, _SPATIAL_HOME)

    def krawczyk_is_right(self) -> str:
        return _right(self.krawczyk, "krawczyk", 40, _SPATIAL_HOME)

    def methods_agree(self) -> str:
        """Both list the same number of poses, and their boxes meet one to one."""
        exact, krawczyk = self.exact.poses, self.krawczyk.poses
        _require(len(exact) == len(krawczyk), f"{len(exact)} and {len(krawczyk)} poses")
        for number, (one, other) in enumerate(zip(exact, krawczyk, strict=True), 1):
            for a, b in zip((*one.position, *one.quaternion), (*other.position, *other.quaternion), strict=True):
                _require(a.lo <= b.hi and b.lo <= a.hi, f"the boxes of pose {number} do not meet")
        return f"{len(exact)} poses, box by box"

    @cached_property
    def system(self) -> SystemSolution:
        from pkm_exact.interactive.system_answers import solve_system

        return solve_system(_SYSTEM)

    def system_is_right(self) -> str:
        """As many solutions as degrees admit; at each real one the first equation holds in interval arithmetic."""
        found = self.system
        _require(str(found.claim) == "complete", f"the claim is {found.claim}")
        _require(found.complex_solutions == len(found) == 4, f"{found.complex_solutions} solutions, {len(found)} real")
        for number, solution in enumerate(found, 1):
            squares = [sorted((value.lo**2, value.hi**2)) for value in solution.values]
            low, high = (sum(square[end] for square in squares) for end in (0, 1))
            _require(low <= 4 <= high, f"solution {number} is not on the circle")
        return "4 solutions, 4 real, complete"

    def certificates_are_accepted(self) -> str:
        contents = [*self.certificates, self._system_content()]
        for content in contents:
            for name, status in _verdicts(content):
                of = content.get("method", "certify-roots")
                _require(status == "accepted", f"{name} says {status} of the certificate by {of}")
        plain = sum(map(_is_for_the_plain_checker, contents))
        return f"{len(contents)} by the checker, {plain} by the plain one as well"

    def _system_content(self) -> dict[str, Any]:
        content: dict[str, Any] = json.loads(self.system.certificate().data)
        return content

    def forgeries_are_rejected(self) -> str:
        """A pose too few, a pose elsewhere, another robot, another system: each with a digest that fits."""
        from pkm_exact.certify.build import sealed

        forgeries = 0
        robot = (_without_a_pose, _with_a_pose_elsewhere, _of_another_robot)
        cases = [
            *((content, robot) for content in self.certificates[:2]),
            (self._system_content(), (_of_another_system,)),
        ]
        for content, forges in cases:
            for forge in forges:
                forged = {key: value for key, value in json.loads(json.dumps(content)).items() if key != "digest"}
                forge(forged)
                for name, status in _verdicts(sealed(forged)):
                    _require(status == "rejected", f"{name} says {status} of one: {forge.__doc__}")
                forgeries += 1
        return f"{forgeries}, each by both checkers"


def _right(solution: Solution, method: str, number: int, home: tuple[Fraction, ...]) -> str:
    """Complete, with the number of solutions that a general robot has, and the pose it was built around among them."""
    _require(str(solution.claim) == "complete", f"the claim is {solution.claim}")
    _require(solution.method == method, f"the method was {solution.method}")
    _require(solution.complex_solutions == number, f"{solution.complex_solutions} solutions, not {number}")
    held = [pose for pose in solution.poses if all(c.lo <= x <= c.hi for c, x in zip(pose.position, home, strict=True))]
    _require(len(held) == 1, f"the known pose is in {len(held)} boxes, not in one")
    return f"{number} solutions, {len(solution.poses)} real, complete"


def _verdicts(content: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """What the two checkers say."""
    from pkm_exact.certify import check, pure
    from pkm_exact.certify.build import canonical_bytes

    data = canonical_bytes(content)
    yield "the checker", str(check.check_bytes(data).status)
    if _is_for_the_plain_checker(content):
        yield "the plain checker", str(pure.check_bytes(data).status)


def _is_for_the_plain_checker(content: dict[str, Any]) -> bool:
    """It takes seconds for 40 boxes around complex solutions; a self-test is to be quick."""
    return content.get("method") != "krawczyk"


def _without_a_pose(content: dict[str, Any]) -> None:
    """A pose is left out."""
    del content["poses"][-1]
    content["real_poses"] -= 1


def _with_a_pose_elsewhere(content: dict[str, Any]) -> None:
    """A pose is moved."""
    interval = content["poses"][0]["position"][0]
    interval[:] = [str(Fraction(end) + 1) for end in interval]


def _of_another_robot(content: dict[str, Any]) -> None:
    """A joint is moved."""
    joint = content["robot"]["platform"][0]
    joint[0] = str(Fraction(joint[0]) + 1)


def _of_another_system(content: dict[str, Any]) -> None:
    """A constant is changed."""
    content["polynomials"][0][-1] = "-5"

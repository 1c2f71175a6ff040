"""Does a certificate come out again? Checked, solved once more as it says, and compared byte by byte.

A certificate says what was solved (robot, lengths), by which method and formulation, and on which grid its boxes lie;
with the default policy that fixes every byte. One that was made in Python with another seed has another representation
of the same poses: it is accepted, and differs. The robot can be taken from a model file instead, to see whether that
has changed since.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from itertools import zip_longest
from typing import TYPE_CHECKING, Any, Final, TypeAlias, cast

from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.certified_machine import (
    certified_configuration,
    certified_machine,
    certified_problem,
    certified_squares,
)
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.mobility_build import FORMAT as MOBILITY_FORMAT
from pkm_exact.certify.mobility_build import certified_linkage, mobility_certificate
from pkm_exact.certify.platform_build import FORMAT as PLATFORM_FORMAT
from pkm_exact.certify.platform_build import certified_mobility, platform_certificate
from pkm_exact.certify.system_build import FORMAT as SYSTEM_FORMAT
from pkm_exact.certify.system_build import system_certificate
from pkm_exact.certify.tolerance_build import FORMAT as TOLERANCE_FORMAT
from pkm_exact.certify.tolerance_build import tolerance_certificate
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric_engine import FALLBACK_NOTE, solve_exactly_instead, solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.stages import Progress
from pkm_exact.systems.system_engine import solved_system
from pkm_exact.systems.system_sources import polynomial_system
from pkm_exact.wording import counted, shown

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.solution import Solution

Place: TypeAlias = tuple[str | int, ...]
"""Where an entry stands in a certificate: keys and indices from the outermost one on."""

_PROOF: Final = ("representation", "elimination", "krawczyk", "digest")
"""What may depend on random choices, if they are not the default ones."""


class Outcome(StrEnum):
    """What became of a certificate."""

    SAME = "same bytes"
    DIFFERENT = "differs"
    REJECTED = "rejected"
    MALFORMED = "malformed"
    TOO_LARGE = "too large"


@dataclass(frozen=True)
class Recomputation:
    """A certificate held against what is computed now.

    Attributes
    ----------
    outcome : Outcome
    detail : str
        In words: what it certifies, where it differs first, or why it was not accepted.
    data : bytes or None
        The certificate as it is now; None if the given one was not accepted.
    """

    outcome: Outcome
    detail: str
    data: bytes | None

    def __str__(self) -> str:
        return f"{self.outcome}{',' if self.outcome == Outcome.SAME else ':'} {self.detail}"


def recompute(
    data: bytes, *, robot: Machine | None = None, policy: Policy | None = None, progress: Progress | None = None
) -> Recomputation:
    """Check a certificate, solve its robot again in the same way and compare all bytes.

    Parameters
    ----------
    data : bytes
        Content of a certificate of poses, of tolerances, of a mobility (of a mechanism or of a platform) or of a
        polynomial system.
    robot : Machine, optional
        A robot or mechanism whose configuration of the same name is to be solved (its lengths, if the certificate's
        have no name); by default the one that is written in the certificate.
    policy : Policy, optional
        The one with which it was made, if not the default one.
    progress : callable, optional
        Gets one line when a stage starts.

    Raises
    ------
    InputError
        If the robot has no such configuration, or no bytes are given.
    PkmExactError
        As ``engine.solve``.

    Examples
    --------
    >>> from pkm_exact.certify.build import certificate
    >>> joints = lambda *rows: tuple(tuple(map(Fraction, row)) for row in rows)
    >>> corners = joints((0, 0), (10, 0), (3, 10)), joints((0, 0), (4, 0), (2, 2))
    >>> robot = Robot("example", "3-RPR", "m", "made up", *corners)
    >>> data = canonical_bytes(certificate(robot, None, solve(robot.problem([50, 26, 25]))))
    >>> print(recompute(data))
    same bytes, complete, 2 poses
    >>> changed = Robot("example", "3-RPR", "m", "made up", corners[0], joints((0, 0), (4, 0), (2, 1)))
    >>> print(recompute(data, robot=changed))
    differs: first at robot.platform[2][1]: '2' in the file, '1' now
    """
    if not isinstance(data, bytes):
        raise InputError("certificate: recompute takes the bytes of the file; give Certificate.load(path).data")
    verdict = check_bytes(data)
    if verdict.status != "accepted":
        outcome = {"rejected": Outcome.REJECTED, "malformed": Outcome.MALFORMED}.get(verdict.status, Outcome.TOO_LARGE)
        return Recomputation(outcome, verdict.lines[-1], None)
    content = json.loads(data)
    if content["format"] == SYSTEM_FORMAT:
        answers = _system_answers(content, robot, policy, progress)
    elif content["format"] == PLATFORM_FORMAT:
        answers = _platform_answers(content, robot)
    elif content["format"] == MOBILITY_FORMAT:
        answers = _mobility_answers(content, robot)
    else:
        answers = _answers(content, _Question.of(content, robot), policy, progress or (lambda _: None))
    for found in answers:
        if canonical_bytes(found) == data:
            return Recomputation(Outcome.SAME, _summary(content), data)
    answer = canonical_bytes(found)
    again = check_bytes(answer)
    require(again.status == "accepted", "the checker does not accept what was solved", line=again.lines[-1])
    return Recomputation(Outcome.DIFFERENT, _difference(content, found), answer)


@dataclass(frozen=True)
class _Question:
    """What is to be solved: robot, name of the configuration, and problem."""

    robot: Machine
    name: str | None
    problem: ForwardProblem

    @classmethod
    def of(cls, content: dict[str, Any], robot: Machine | None) -> _Question:
        name = certified_configuration(content)
        if robot is not None and name is not None:
            return cls(robot, name, robot.problem(robot.configuration(name)))
        if not isinstance(robot, Robot):
            return cls(robot or certified_machine(content), name, certified_problem(content))
        return cls(robot, name, robot.problem(certified_squares(content)))


def _answers(
    content: dict[str, Any], asked: _Question, policy: Policy | None, progress: Progress
) -> Iterator[dict[str, Any]]:
    """The certificates that may have been meant; one, if the content says how it was made."""
    if content["format"] == TOLERANCE_FORMAT:
        yield from _tolerance_answers(content, asked, policy, progress)
        return
    width = Fraction(2, 1 << content["box_exponent"])
    options: dict[str, Any] = {"width": width, "policy": policy, "progress": progress}
    if content["method"] == "krawczyk":
        solution = solve_krawczyk(asked.problem, **options)
    elif content["notes"] and content["notes"][-1].startswith(FALLBACK_NOTE):
        solution = solve_exactly_instead(asked.problem, **options)
    else:
        solution = solve(asked.problem, formulation=content["formulation"], **options)
    yield certificate(asked.robot, asked.name, solution)


def _system_answers(
    content: dict[str, Any], robot: Machine | None, policy: Policy | None, progress: Progress | None
) -> Iterator[dict[str, Any]]:
    """The certificate of the polynomial system that is written in one."""
    if robot is not None:
        raise InputError("certificate: is one of a polynomial system, and not of a robot; recompute it without a model")
    polynomials = ["+".join(terms) for terms in content["polynomials"]]
    system = polynomial_system(polynomials, content["variables"])
    width = Fraction(2, 1 << content["box_exponent"])
    yield system_certificate(solved_system(system, width=width, policy=policy, progress=progress), content["title"])


def _mobility_answers(content: dict[str, Any], robot: Machine | None) -> Iterator[dict[str, Any]]:
    """The certificate of the mechanism of bodies and joints that is written in one."""
    from pkm_exact.mobility.analysis import mobility_of

    if robot is not None:
        raise InputError("certificate: is one of a mobility, and not of a robot; recompute it without a model")
    linkage, among = certified_linkage(content), content["actuator_sets"]["among"]
    yield mobility_certificate(mobility_of(linkage, content["actuated"], among))


def _platform_answers(content: dict[str, Any], robot: Machine | None) -> Iterator[dict[str, Any]]:
    """The certificate of the platform's mobility, with the constraints that are written in one."""
    if robot is not None:
        raise InputError("certificate: is one of a mobility, with constraints of its own; recompute it without a model")
    labels = (content["robot"]["name"], content["robot"]["unit"], content["robot"]["source"])
    yield platform_certificate(certified_mobility(content), labels)


def _tolerance_answers(
    content: dict[str, Any], asked: _Question, policy: Policy | None, progress: Progress
) -> Iterator[dict[str, Any]]:
    """By each method: which one found the nominal poses is not written down, as the proof does not depend on it."""
    from pkm_exact.numeric.tolerance import tolerance_boxes

    tolerances = Tolerances(**content["tolerances"])
    engines: tuple[Callable[..., Solution], ...] = (solve_krawczyk, solve)
    for engine in engines:
        solution = engine(asked.problem, policy=policy, progress=progress)
        boxed = [box["pose"] for box in content["boxes"] if 1 <= box["pose"] <= len(solution.poses)]
        chosen = boxed if content["unproved"] else None  # of the others nothing is said
        result = tolerance_boxes(asked.problem, tolerances, solution, progress, chosen)
        require(isinstance(asked.robot, Robot), "a certificate of tolerances of a robot that has no joints")
        yield tolerance_certificate(cast("Robot", asked.robot), asked.name, result)


def _summary(content: dict[str, Any]) -> str:
    """What a certificate says, in a few words."""
    if content["format"] == TOLERANCE_FORMAT:
        proved = len(content["boxes"])
        total = proved + len(content["unproved"])
        claim = "complete within tolerance" if content["complete"] else "not proven complete within tolerance"
        return f"{claim}, {proved} of {total} poses proved"
    if content["format"] == PLATFORM_FORMAT:
        return "mobility of a platform"
    if content["format"] == MOBILITY_FORMAT:
        return f"mobility {content['mobility']['free']}, of the platform {content['mobility']['platform']}"
    if content["format"] == SYSTEM_FORMAT:
        return f"{content['claim'].replace('-', ' ')}, {counted(content['real_solutions'], 'real solution')}"
    return f"{content['claim'].replace('-', ' ')}, {counted(content['real_poses'], 'pose')}"


def _difference(file: dict[str, Any], now: dict[str, Any]) -> str:
    """Where two certificates differ first, and how much that means."""
    path, left, right = next(_differences(file, now, ()))
    text = f"first at {_spelled(path)}: {_value(left)} in the file, {_value(right)} now"
    if _without_proof(file) == _without_proof(now):
        text += "; robot, claim and poses are the same, only their proof was found in another way"
    return text


def _without_proof(content: dict[str, Any]) -> dict[str, Any]:
    """What does not depend on the choice of a separating form."""
    kept = {key: value for key, value in content.items() if key not in _PROOF}
    return {**kept, "poses": [{**pose, "parameter": None} for pose in content.get("poses", [])]}


def _differences(left: Any, right: Any, path: Place) -> Iterator[tuple[Place, Any, Any]]:
    """Paths and values of the leaves that differ, in order; of lists of different lengths, first the lists."""
    if isinstance(left, dict) and isinstance(right, dict):
        for key in [*left, *(key for key in right if key not in left)]:
            yield from _differences(left.get(key), right.get(key), (*path, key))
    elif isinstance(left, list) and isinstance(right, list):
        if len(left) != len(right):
            yield path, left, right
        for index, pair in enumerate(zip_longest(left, right)):
            yield from _differences(*pair, (*path, index))
    elif left != right:
        yield path, left, right


def _spelled(path: Place) -> str:
    """A path as in ``poses[3].position[0][1]``; the first entry is number 0.

    Examples
    --------
    >>> _spelled(("poses", 3, "position", 0, 1))
    'poses[3].position[0][1]'
    """
    return "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path).removeprefix(".")


def _value(value: Any) -> str:
    return "nothing" if value is None else f"{len(value)} entries" if isinstance(value, list) else shown(value)

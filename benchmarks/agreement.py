"""Whether the numeric engine and the exact one agree: number of poses, every box, every sign of a Jacobian.

Robots: 6-6 robots with random joints, at the lengths of a random pose. Lengths: random length vectors of Rolland's
robot, tracked from one start near it. A symmetric family: a shipped robot of it at the lengths of a random pose. Every
case is made from its own number, so that a run can be split by --first and --count; the cases of different runs add up.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, partial
from pathlib import Path
from random import Random
from time import perf_counter

from pkm_exact import read_robot, solve
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Robot
from pkm_exact.numeric.nearby import nearby_start
from pkm_exact.numeric.start import StartSection
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.solution import Solution

LIFTED = Policy(lifting="newton")
"""The exact engine finds its representation without the solutions in doubles that the numeric engine starts from."""
MODELS = Path(__file__).parent.parent / "models"
MODEL = MODELS / "rolland-6-6.toml"
FAMILIES = ("ssm-exact", "ssm-rounded", "mssm", "tssm", "linuxcnc-hexapod")
REACH = 150
"""Lengths differ from those of the home configuration by so many units at most."""


@dataclass(frozen=True)
class Case:
    """A problem, and the start from which the numeric engine solves it."""

    problem: ForwardProblem
    start: StartSection | None = None


def main() -> int:
    """Compare, print a summary, and tell by the exit code whether all cases agree."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", choices=CASES, help="which cases")
    parser.add_argument("--first", type=int, default=0, help="number of the first case (default 0)")
    parser.add_argument("--count", type=int, help="how many (default 1000 robots, 200 of the others)")
    arguments = parser.parse_args()
    make, usual = CASES[arguments.cases]
    count = usual if arguments.count is None else arguments.count
    tally: Counter[str] = Counter()
    seconds = {"numeric": 0.0, "exact": 0.0}
    real: Counter[int] = Counter()
    for number in range(arguments.first, arguments.first + count):
        case = make(number)
        before = perf_counter()
        numeric = solve_krawczyk(case.problem, start=case.start)
        between = perf_counter()
        exact = solve(case.problem, policy=LIFTED)
        seconds["numeric"] += between - before
        seconds["exact"] += perf_counter() - between
        outcome = _outcome(numeric, exact)
        tally[outcome] += 1
        real[len(exact.poses)] += 1
        if outcome != "agree":
            print(f"{arguments.cases} {number}: {outcome}: {numeric}; exact: {exact}; {numeric.notes}", flush=True)
        if (number + 1) % 10 == 0:
            print(f"{arguments.cases} {number + 1}: {dict(tally)}", file=sys.stderr, flush=True)
    print(_summary(arguments.cases, arguments.first, count, tally, seconds, real))
    return int(set(tally) - {"agree", "fallback"} != set())


def random_robot(number: int) -> Case:
    random = Random(f"robot {number}")
    place, axis = _vector(random), _vector(random)
    turn = rotation_of((Fraction(random.randint(0, 1000), 100), *axis))
    pairs = [(_vector(random), _vector(random)) for _ in range(6)]
    legs = [Distance(a, b, distance_squared(a, b, place, turn)) for a, b in pairs]
    return Case(ForwardProblem(tuple(legs)))


def _vector(random: Random) -> Vector:
    x, y, z = (Fraction(random.randint(-1000, 1000), 100) for _ in range(3))
    return x, y, z


def _random_lengths(number: int) -> Case:
    random, (robot, start) = Random(f"lengths {number}"), _rolland()
    lengths = [1250 + Fraction(random.randint(-100, 100), 100) * REACH for _ in robot.base_joints]
    return Case(robot.problem([length * length for length in lengths]), start)


def _of_family(name: str, number: int) -> Case:
    """The shipped robot at a pose within its size of the place that its lengths belong to, turned by half at most."""
    random, problem = Random(f"{name} {number}"), _shipped(name)
    reach = round(float(max(leg.length_squared for leg in problem.distances)) ** 0.5)
    turn = rotation_of((Fraction(1), *(Fraction(random.randint(-100, 100), 100) for _ in range(3))), problem.metric)
    x, y, z = (Fraction(random.randint(-100, 100) * reach, 200) for _ in range(3))
    place = (x, y, z + reach)
    legs = [
        replace(leg, length_squared=distance_squared(leg.base, leg.platform, place, turn, problem.metric))
        for leg in problem.distances
    ]
    return Case(replace(problem, constraints=tuple(legs)))


@cache
def _shipped(name: str) -> ForwardProblem:
    robot = read_robot(MODELS / f"{name}.toml")
    return robot.problem(robot.configuration())


@cache
def _rolland() -> tuple[Robot, StartSection | None]:
    robot = read_robot(MODEL)
    return robot, nearby_start(robot.problem(robot.configuration()))


CASES: dict[str, tuple[Callable[[int], Case], int]] = {
    "robots": (random_robot, 1000),
    "lengths": (_random_lengths, 200),
    **{name: (partial(_of_family, name), 200) for name in FAMILIES},
}
"""How a case is made from its number, and how many are usual."""


def _outcome(numeric: Solution, exact: Solution) -> str:
    if numeric.method != "krawczyk":
        return "fallback"
    if numeric.claim != exact.claim or numeric.complex_solutions != exact.complex_solutions:
        return "other claim"
    if len(numeric.poses) != len(exact.poses):
        return "other number of poses"
    if not all(map(_are_equal, numeric.poses, exact.poses)):
        return "other boxes"
    return "agree"


def _are_equal(one: Pose, other: Pose) -> bool:
    """Whether boxes and signs are equal; quaternions up to their sign."""
    same = one.position == other.position and one.rotation == other.rotation
    signs = [pose.jacobian.det_sign if pose.jacobian else None for pose in (one, other)]
    quaternions = one.quaternion, tuple(Interval(-q.hi, -q.lo) for q in one.quaternion)
    return same and signs[0] == signs[1] and other.quaternion in quaternions


def _summary(
    name: str, first: int, count: int, tally: Counter[str], seconds: dict[str, float], real: Counter[int]
) -> str:
    outcomes: Sequence[str] = [f"{key}: {value}" for key, value in tally.most_common()]
    poses = ", ".join(f"{key} ({real[key]})" for key in sorted(real))
    return (
        f"{name} {first} to {first + count - 1}: {', '.join(outcomes)}\n"
        f"real poses (cases): {poses}\n"
        f"seconds per case: numeric {seconds['numeric'] / count:.3f}, exact {seconds['exact'] / count:.3f}"
    )


if __name__ == "__main__":
    sys.exit(main())

"""Robots, their solutions, poses and exact interval arithmetic that several test modules share.

What is solved here is solved once in a test process: ask for ``solved("rolland-6-6")`` wherever its solution is needed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import isqrt
from pathlib import Path
from random import Random
from typing import Any

from pkm_exact.algebra.modular_elimination import Elimination
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.geometry.inverse import distance_squared, rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric.tolerance_result import ToleranceResult
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.solution import Solution

MODELS = sorted((Path(__file__).parent.parent / "models").glob("*.toml"))
METRICS = [(1, 1, 1), (1, 3, 1)]
REFERENCE = ("rolland-6-6", "dietmaier", "mourrain-l", "similar-planar-s", "robocrane-r")
"""Robots with published counts; the others are variations."""
CODES = ("SE3", "AFD4", "AFP3", "AFD5")
"""Formulations fast enough to be solved on every robot."""


@cache
def model(name: str) -> Robot:
    """A shipped robot."""
    return read_robot(next(path for path in MODELS if path.stem == name))


@cache
def shipped(name: str) -> ForwardProblem:
    """The first configuration of a shipped robot."""
    robot = model(name)
    return robot.problem(robot.configuration())


@cache
def solved(name: str, code: str = "SE3") -> Solution:
    """The solution of a shipped robot, computed once in a test process."""
    return solve(shipped(name), formulation=code)


@cache
def boxed(name: str) -> Solution:
    """The answer of the numeric engine for a shipped robot."""
    return solve_krawczyk(shipped(name))


@cache
def tolerant(name: str, tolerance: str) -> ToleranceResult:
    """The poses of a shipped robot, all of whose numbers are known up to this tolerance."""
    return tolerance_boxes(shipped(name), Tolerances.uniform(tolerance), boxed(name))


@dataclass(frozen=True)
class Placed:
    """A robot whose legs have the lengths that a known rational pose gives them."""

    problem: ForwardProblem
    position: Vector
    rotation: tuple[Vector, Vector, Vector]


def placed(
    base: Sequence[Vector],
    platform: Sequence[Vector],
    position: Vector,
    quaternion: Sequence[Fraction],
    metric: tuple[int, int, int] = (1, 1, 1),
) -> Placed:
    """The robot with the given joints, locked at the given pose."""
    q0, q1, q2, q3 = quaternion
    rotation = rotation_of((q0, q1, q2, q3), metric)
    legs = tuple(
        Distance(a, b, distance_squared(a, b, position, rotation, metric)) for a, b in zip(base, platform, strict=True)
    )
    return Placed(ForwardProblem(legs, metric), position, rotation)


def random_vector(random: Random, size: int = 9) -> Vector:
    """A vector with small rational coordinates."""
    x, y, z = (Fraction(random.randint(-size, size), random.randint(1, 3)) for _ in range(3))
    return x, y, z


def random_placed(random: Random, quaternion: Sequence[Fraction], metric: tuple[int, int, int]) -> Placed:
    """A general 6-6 with random rational joints at a random rational position."""
    joints = [random_vector(random) for _ in range(12)]
    return placed(joints[:6], joints[6:], random_vector(random), quaternion, metric)


def system(names: str, *texts: str) -> PolynomialSystem:
    """The polynomial system with the given unknowns and polynomials, written as Python expressions."""
    unknowns = tuple(names.split())
    scope = dict(zip(unknowns, polynomial_ring(unknowns).gens(), strict=True))
    return PolynomialSystem(unknowns, tuple(eval(text, scope) for text in texts))  # noqa: S307


def katsura(n: int) -> PolynomialSystem:
    """Katsura's system in n + 1 unknowns: 2^n solutions, all simple."""
    unknowns = tuple(f"x{i}" for i in range(n + 1))
    context = polynomial_ring(unknowns)
    x = context.gens()

    def at(index: int) -> Any:
        return x[abs(index)] if abs(index) <= n else context.constant(0)

    total = x[0] + 2 * sum(x[1:], context.constant(0)) - 1
    convolutions = [sum((at(i) * at(m - i) for i in range(-n, n + 1)), context.constant(0)) - x[m] for m in range(n)]
    return PolynomialSystem(unknowns, (total, *convolutions))


def cyclic(n: int) -> PolynomialSystem:
    """The cyclic n-roots problem."""
    unknowns = tuple(f"x{i}" for i in range(n))
    context = polynomial_ring(unknowns)
    x = context.gens()
    polynomials = []
    for length in range(1, n):
        total = context.constant(0)
        for start in range(n):
            term = context.constant(1)
            for index in range(length):
                term *= x[(start + index) % n]
            total += term
        polynomials.append(total)
    product = context.constant(1)
    for unknown in x:
        product *= unknown
    return PolynomialSystem(unknowns, (*polynomials, product - 1))


def random_quadrics(unknowns: int, seed: int, size: int = 5) -> PolynomialSystem:
    """As many dense quadrics as unknowns: 2^n simple solutions for all but few seeds."""
    random = Random(seed)
    names = tuple(f"x{i}" for i in range(unknowns))
    context = polynomial_ring(names)
    x = [context.constant(1), *context.gens()]
    polynomials = []
    for _ in range(unknowns):
        total = context.constant(0)
        for i, left in enumerate(x):
            for right in x[i:]:
                total += random.choice([c for c in range(-size, size + 1) if c]) * left * right
        polynomials.append(total)
    return PolynomialSystem(names, tuple(polynomials))


def images(polynomials: PolynomialSystem, policy: Policy | None = None) -> Iterator[Any]:
    """Modular images of a system at one prime after another."""
    elimination = Elimination(polynomials, policy or Policy())
    while True:
        yield elimination.following()


def add(left: Interval, right: Interval) -> Interval:
    """Sum of two intervals."""
    return Interval(left.lo + right.lo, left.hi + right.hi)


def multiply(left: Interval, right: Interval) -> Interval:
    """Product of two intervals."""
    ends = [a * b for a in (left.lo, left.hi) for b in (right.lo, right.hi)]
    return Interval(min(ends), max(ends))


def square(value: Interval) -> Interval:
    """Square of an interval."""
    ends = sorted((value.lo * value.lo, value.hi * value.hi))
    return Interval(Fraction(0) if value.contains(Fraction(0)) else ends[0], ends[1])


def root(value: int) -> Interval:
    """A narrow interval around the square root of an integer."""
    scale = 1 << 64
    floor = isqrt(value * scale * scale)
    exact = floor * floor == value * scale * scale
    return Interval(Fraction(floor, scale), Fraction(floor + (not exact), scale))


def exact(value: Fraction | int) -> Interval:
    """The interval of one rational."""
    return Interval(Fraction(value), Fraction(value))


def leg_length_squared(leg: Distance, metric: Sequence[int], pose: Pose) -> Interval:
    """The squared length of a leg over a whole box of poses, in ordinary coordinates."""
    scales = [root(g) for g in metric]
    base = [multiply(scale, exact(value)) for scale, value in zip(scales, leg.base, strict=True)]
    platform = [multiply(scale, exact(value)) for scale, value in zip(scales, leg.platform, strict=True)]
    total = exact(0)
    for i in range(3):
        entry = add(pose.position[i], multiply(exact(-1), base[i]))
        for j in range(3):
            entry = add(entry, multiply(pose.rotation[i][j], platform[j]))
        total = add(total, square(entry))
    return total

"""The exact rank of the leg Jacobian at the roots of an irreducible factor of the eliminant, and what is special there.

The leg lines (d, b x d), with d = C + R B - A the leg and b = R B its arm, are computed in the field Q[T] / f. There
every element is 0 or a unit, so that elimination decides each entry. Rational coordinates change the columns by
factors other than 0; a planar robot has three lines with three coordinates.

Two kinds of singular pose have a name, both with a rank of 3 at most: all joints lie in one plane (the lines of a plane
have rank 3), and all leg lines meet in one point, finite or infinitely far (so have the lines through a point).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import islice
from math import lcm

from flint import fmpq_poly, fmpz_poly, nmod_poly

from pkm_exact.algebra.newton import is_regular
from pkm_exact.algebra.primes import primes_from
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import evaluate, motion_quadrics
from pkm_exact.policy import Policy
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.study_equations import StudyEquations

Element = fmpq_poly
"""An element of the field Q[T] / f."""


class SpecialPose(StrEnum):
    """Positions of joints and leg lines that make a pose singular."""

    PLANE = "all joints lie in one plane"
    POINT = "all leg lines meet in one point"
    PARALLEL = "all leg lines are parallel"


@dataclass(frozen=True)
class Singularity:
    """What is known of the leg Jacobian at a pose.

    Attributes
    ----------
    rank : int
        Exact; the number of legs if the pose is not singular after all.
    special : tuple of SpecialPose
        All that apply, decided exactly. Empty at a pose that is not singular.
    """

    rank: int
    special: tuple[SpecialPose, ...] = ()


def are_isolated(
    representation: PoseRepresentation, problem: ForwardProblem, policy: Policy, factor: fmpz_poly | None = None
) -> bool:
    """Whether the Jacobian of the legs is proved regular at every pose, by its image modulo some prime.

    "No" means that no proof was found at the primes tried. With a ``factor`` of h only its roots are looked at.
    """
    h = representation.univariate.polynomial
    looked_at = h if factor is None else factor
    seed = policy.seed_for(problem.digest, "regularity")
    usable = (prime for prime in primes_from(seed, policy.prime_bits) if int(h.leading_coefficient()) % prime)
    for attempt, prime in enumerate(islice(usable, policy.attempts)):
        eliminant = nmod_poly([int(value) % prime for value in looked_at.coeffs()], prime)
        slope = nmod_poly([int(value) % prime for value in h.derivative().coeffs()], prime)
        divisor, inverse, _ = slope.xgcd(eliminant)
        if divisor.degree() != 0:
            continue
        equations = StudyEquations(problem, representation.chart, seed + attempt)
        numerators = [representation.univariate.numerators[k] for k in equations.free]
        point = [
            nmod_poly([value % prime for value in numerator], prime) * inverse % eliminant for numerator in numerators
        ]
        if is_regular(equations, eliminant / eliminant.leading_coefficient(), point):
            return True
    return False


def singularity(representation: PoseRepresentation, problem: ForwardProblem, factor: fmpz_poly) -> Singularity:
    """The rank of the leg Jacobian at every root of an irreducible factor of h, and what is special if it drops."""
    field = fmpq_poly(factor)
    base, arms, lines = _legs(representation, problem, field)
    rows = []
    for arm, line in zip(arms, lines, strict=True):
        moment = _cross(arm, line)
        rows.append([line[0], line[1], moment[2]] if problem.motion.is_planar else [*line, *moment])
    rank = _rank(rows, field)
    if rank == len(problem.distances):
        return Singularity(rank)
    special = []
    shifts = [[x - y for x, y in zip(joint, base[0], strict=True)] for joint in base[1:]]
    if not problem.motion.is_planar and _rank([*shifts, *lines], field) <= 2:
        special.append(SpecialPose.PLANE)
    if _rank(lines, field) == 1:
        special.append(SpecialPose.PARALLEL)
    elif _have_common_point(base, lines, field):
        special.append(SpecialPose.POINT)
    return Singularity(rank, tuple(special))


def _legs(
    representation: PoseRepresentation, problem: ForwardProblem, field: Element
) -> tuple[list[list[Element]], list[list[Element]], list[list[Element]]]:
    """Base joints A, arms N R B and legs N (C + R B - A), each times a common denominator of all joints."""
    x = [fmpq_poly(numerator) % field for numerator in representation.univariate.numerator_polynomials]
    products = [[left * right % field if m >= k else left for m, right in enumerate(x)] for k, left in enumerate(x)]
    values = [evaluate(quadric, products) for quadric in motion_quadrics(problem.metric)]
    position, rotation, norm = values[4:7], [values[7 + 3 * i : 10 + 3 * i] for i in range(3)], values[16]
    scale = lcm(*(value.denominator for leg in problem.distances for value in (*leg.base, *leg.platform)))
    base, arms, lines = [], [], []
    for leg in problem.distances:
        base.append([fmpq_poly([int(value * scale)]) for value in leg.base])
        platform = [int(value * scale) for value in leg.platform]
        arms.append([row[0] * platform[0] + row[1] * platform[1] + row[2] * platform[2] for row in rotation])
        lines.append([c * scale + b - norm * a for c, b, a in zip(position, arms[-1], base[-1], strict=True)])
    return base, arms, lines


def _have_common_point(base: Sequence[Sequence[Element]], lines: Sequence[Sequence[Element]], field: Element) -> bool:
    """Whether some P lies on every leg line: P x d = A x d, linear equations that must be consistent."""
    rows = []
    for joint, line in zip(base, lines, strict=True):
        right = _cross(joint, line)
        for i, j, k in CYCLIC:
            row = [line[0] * 0] * 3
            row[j], row[k] = line[k], line[j] * -1
            rows.append([*row, right[i]])
    return _rank([row[:3] for row in rows], field) == _rank(rows, field)


def _cross(left: Sequence[Element], right: Sequence[Element]) -> list[Element]:
    return [left[j] * right[k] - left[k] * right[j] for _, j, k in CYCLIC]


def _rank(rows: Sequence[Sequence[Element]], field: Element) -> int:
    """Rank of a matrix over the field."""
    left = [[value % field for value in row] for row in rows]
    rank = 0
    for column in range(len(rows[0])):
        pivot = next((row for row in left if not row[column].is_zero()), None)
        if pivot is None:
            continue
        rank += 1
        left.remove(pivot)
        inverse = pivot[column].xgcd(field)[1]
        for row in left:
            ratio = row[column] * inverse % field
            for index in range(column, len(row)):
                row[index] = (row[index] - ratio * pivot[index]) % field
    return rank

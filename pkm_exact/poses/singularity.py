"""The exact rank of the Jacobian at the roots of an irreducible factor of the eliminant, and what is special there.

The wrenches of the constraints (``poses.wrenches``) are computed in the field Q[T] / f. There every element is 0 or a
unit, so that elimination decides each entry. Rational coordinates change the columns by factors other than 0.

Of legs of known length two kinds of singular pose have a name, both with a rank of 3 at most: all joints lie in one
plane (the lines of a plane have rank 3), and all leg lines meet in one point, finite or infinitely far (so have the
lines through a point).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from itertools import islice
from math import lcm, prod
from random import Random
from typing import Any

from flint import fmpq, fmpq_poly, fmpz_poly, nmod, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import evaluate, motion_quadrics
from pkm_exact.policy import Policy
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.wrenches import exact_rows

Element = fmpq_poly
"""An element of the field Q[T] / f."""


class SpecialPose(StrEnum):
    """Positions of joints and leg lines that make a pose singular."""

    PLANE = "all joints lie in one plane"
    POINT = "all leg lines meet in one point"
    PARALLEL = "all leg lines are parallel"


@dataclass(frozen=True)
class Singularity:
    """What is known of the Jacobian at a pose.

    Attributes
    ----------
    rank : int
        Exact; the number of freedoms if the pose is not singular after all.
    special : tuple of SpecialPose
        All that apply, decided exactly. Empty at a pose that is not singular.
    """

    rank: int
    special: tuple[SpecialPose, ...] = ()


def are_isolated(
    representation: PoseRepresentation,
    problem: ForwardProblem,
    policy: Policy,
    factor: fmpz_poly | None = None,
    further: int = 0,
) -> bool:
    """Whether the Jacobian is proved regular at every pose, by its image modulo some prime.

    "No" means that no proof was found at the primes tried. With a ``factor`` of h only its roots are looked at. With
    ``further`` rows chosen at random it is proved that at most so many freedoms are left.
    """
    h = representation.univariate.polynomial
    looked_at = h if factor is None else factor
    seed = policy.seed_for(problem.digest, "regularity")
    needed = prod(problem.metric) * int(h.leading_coefficient())
    usable = (prime for prime in primes_from(seed, policy.prime_bits) if needed % prime)
    random = Random(seed)
    for prime in islice(usable, policy.attempts):
        modulus = nmod_poly([int(value) % prime for value in looked_at.coeffs()], prime)
        x = [
            nmod_poly([value % prime for value in numerator], prime) % modulus
            for numerator in representation.univariate.numerators
        ]
        quantities = [value % modulus for value in _quantities(x, problem.metric)]
        # Coordinates are x / h', and N(e) divides columns: both must be units for the rank to be that of the Jacobian.
        slope = nmod_poly([int(value) % prime for value in h.derivative().coeffs()], prime)
        if any(unit.gcd(modulus).degree() != 0 for unit in (slope, quantities[16])):
            continue
        rows = exact_rows(problem, quantities, partial(_residue, prime))
        rows += [[nmod_poly([random.randrange(prime)], prime) for _ in problem.motion.twist] for _ in range(further)]
        if _have_full_rank([[value % modulus for value in row] for row in rows], modulus, random):
            return True
    return False


def _residue(prime: int, value: int) -> nmod:
    return nmod(value % prime, prime)


def _have_full_rank(rows: list[list[nmod_poly]], relation: nmod_poly, random: Random) -> bool:
    """Whether random combinations of the rows are a matrix that is regular at every root of the relation.

    Elimination in the ring: the pivots must be units.
    """
    size, prime = len(rows[0]), int(relation.modulus())
    if len(rows) < size:
        return False
    weights = [[random.randrange(1, prime) for _ in rows] for _ in range(size)]
    left = [[_combined(line, column) % relation for column in zip(*rows, strict=True)] for line in weights]
    for k in range(size):
        divisor, inverse, _ = left[k][k].xgcd(relation)
        if divisor.degree() != 0:
            return False
        for row in left[k + 1 :]:
            ratio = row[k] * inverse % relation
            for place in range(k + 1, size):
                row[place] = (row[place] - ratio * left[k][place]) % relation
    return True


def _combined(weights: Sequence[int], values: Sequence[nmod_poly]) -> nmod_poly:
    total = values[0] * weights[0]
    for weight, value in zip(weights[1:], values[1:], strict=True):
        total += value * weight
    return total


def _quantities(x: Sequence[Any], metric: Sequence[int]) -> list[Any]:
    """N(e) times (|C|^2; u; C; R; 1) at the coordinates (e, f), in any ring."""
    products = [[left * right if m >= k else left for m, right in enumerate(x)] for k, left in enumerate(x)]
    return [evaluate(quadric, products) for quadric in motion_quadrics(metric)]


def singularity(representation: PoseRepresentation, problem: ForwardProblem, factor: fmpz_poly) -> Singularity:
    """The rank of the Jacobian at every root of an irreducible factor of h, and what is special if it drops."""
    field = fmpq_poly(factor)
    x = [fmpq_poly(numerator) % field for numerator in representation.univariate.numerator_polynomials]
    quantities = [value % field for value in _quantities(x, problem.metric)]
    rank = _rank(exact_rows(problem, quantities, fmpq), field)
    special: list[SpecialPose] = []
    if rank == problem.motion.dimension or not problem.has_only_distances:
        return Singularity(rank)
    base, lines = _legs(problem, quantities)
    shifts = [[x - y for x, y in zip(joint, base[0], strict=True)] for joint in base[1:]]
    if not problem.motion.is_planar and _rank([*shifts, *lines], field) <= 2:
        special.append(SpecialPose.PLANE)
    if _rank(lines, field) == 1:
        special.append(SpecialPose.PARALLEL)
    elif _have_common_point(base, lines, field):
        special.append(SpecialPose.POINT)
    return Singularity(rank, tuple(special))


def _legs(problem: ForwardProblem, quantities: Sequence[Element]) -> tuple[list[list[Element]], list[list[Element]]]:
    """Base joints A and legs N (C + R B - A), each times a common denominator of all joints."""
    position, rotation, norm = quantities[4:7], [quantities[7 + 3 * i : 10 + 3 * i] for i in range(3)], quantities[16]
    scale = lcm(*(value.denominator for leg in problem.distances for value in (*leg.base, *leg.platform)))
    base, lines = [], []
    for leg in problem.distances:
        base.append([fmpq_poly([int(value * scale)]) for value in leg.base])
        platform = [int(value * scale) for value in leg.platform]
        arm = [row[0] * platform[0] + row[1] * platform[1] + row[2] * platform[2] for row in rotation]
        lines.append([c * scale + b - norm * a for c, b, a in zip(position, arm, base[-1], strict=True)])
    return base, lines


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

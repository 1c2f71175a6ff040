"""The last gate before an answer: a solution that contradicts itself does not get through.

What an engine has proved, it has proved; this looks at the result as a whole, along other ways, and cheaply. The counts
must fit each other and the degree of the variety of motions, solutions that are not real come in pairs, the
representation must vanish on the robot modulo a prime, boxes must lie apart and on the robot
(``poses.pose_consistency``), and what is claimed must come with what proves it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Final

from flint import fmpq, fmpz_poly, nmod_mat, nmod_poly

from pkm_exact.algebra.primes import primes_from
from pkm_exact.claim import Claim, CompletenessRoute, RealMotion
from pkm_exact.completeness.completeness_proof import CompletenessProof
from pkm_exact.completeness.pose_slices import MorePoses
from pkm_exact.digests import digest
from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import evaluate, linear_quadrics, motion_quadrics, pose_quadrics, pose_quartics
from pkm_exact.poses.pose_consistency import (
    has_degree_zero,
    require_apart,
    require_consistent_jacobians,
    require_degree_zero,
    require_on_robot,
)
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.self_motion import SelfMotion
from pkm_exact.roots.counting import roots_in_gaps
from pkm_exact.solution import Solution

OTHER_BITS: Final = 61
"""Size of the primes used here: by default the engines have none of this size."""
_PROVED = (Claim.COMPLETE, Claim.INCONSISTENT)


def consistent(solution: Solution) -> Solution:
    """The solution itself, if it does not contradict itself.

    Raises
    ------
    InternalContradictionError
        If it does.
    """
    _require_consistent(solution)
    return solution


def require_all_consistent(solutions: Sequence[Solution]) -> None:
    """Many solutions by isolating boxes, of one robot at several lengths: what doubles tell is asked of all at once.

    Raises
    ------
    InternalContradictionError
        If one contradicts itself.
    """
    from pkm_exact.numeric.box_consistency import boxes_have_room
    from pkm_exact.numeric.pose_room import poses_have_room

    listed = [(found, found.isolated) for found in solutions if found.isolated is not None]
    boxes = boxes_have_room([(isolated, found.problem) for found, isolated in listed])
    poses = poses_have_room([(found.poses, found.problem, isolated.chart) for found, isolated in listed])
    rooms = {id(found): rooms for (found, _), *rooms in zip(listed, boxes, poses, strict=True)}
    for found in solutions:
        _require_consistent(found, *rooms.get(id(found), ()))


def _require_consistent(
    solution: Solution, boxes: Sequence[bool] | None = None, poses: Sequence[bool] | None = None
) -> None:
    """Where doubles tell that boxes of solutions and of poses have room, it may be known already."""
    _require_proof_of_claim(solution)
    _require_counts(solution)
    for representation in _representations(solution):
        _require_representation(representation, solution.problem)
    if solution.isolated is not None:
        from pkm_exact.numeric.box_consistency import require_sound_boxes

        counts = {"poses": len(solution.poses), "distinct": solution.distinct_solutions}
        require(solution.isolated.count == counts["distinct"], "the boxes are not as many as the solutions", **counts)
        require(len(solution.isolated.real) == counts["poses"], "real boxes are not as many as the poses", **counts)
        require_sound_boxes(solution.isolated, solution.problem, boxes)
    if isinstance(solution.self_motion, SelfMotion):
        _require_mobility(solution.self_motion, solution.problem)
    if isinstance(solution.self_motion, MorePoses):
        _require_slices(solution.self_motion, solution.problem)
    _require_poses(solution, poses)


def _require_proof_of_claim(solution: Solution) -> None:
    """A claim comes with its proof, and a proof with its claim."""
    proof, claim = solution.completeness, solution.claim
    facts = {"claim": claim, "route": solution.completeness_route}
    require((proof is not None) == (claim in _PROVED), "claim and proof of completeness do not fit", **facts)
    moves = solution.self_motion is not None
    unreal = solution.real_motion is RealMotion.NO_REAL_POSE
    require(not (unreal and solution.poses), "real poses, but it is proved that there is none", **facts)
    require(moves == (claim == Claim.POSITIVE_DIMENSIONAL_PROVED), "claim and proof of motion do not fit", **facts)
    if claim == Claim.INCONSISTENT:
        require(not solution.poses and solution.complex_solutions == 0, "poses of a robot that has none", **facts)
    if proof is None:
        return
    counts = {"total": proof.total, "complex": solution.complex_solutions, "distinct": solution.distinct_solutions}
    require(proof.total == solution.complex_solutions, "the proof is one of another number of solutions", **counts)
    degree = solution.problem.solution_bound
    if proof.route == CompletenessRoute.REFINED_BEZOUT:
        require(solution.distinct_solutions == proof.total == degree, "fewer solutions than the degree", **counts)
    if proof.route == CompletenessRoute.COUNTING_AT_INFINITY:
        beyond = 0 if proof.infinity is None else proof.infinity.multiplicity
        require(proof.total + beyond == degree, "fewer solutions and points at infinity than the degree", **counts)
    _require_multiplicities(proof, solution)


def _require_multiplicities(proof: CompletenessProof, solution: Solution) -> None:
    """The factors have all solutions, and their multiplicities the sum that the proof has."""
    found = proof.multiplicities or ((None, 1),)
    degrees = [solution.distinct_solutions if factor is None else int(factor.degree()) for factor, _ in found]
    total = sum(degree * multiplicity for degree, (_, multiplicity) in zip(degrees, found, strict=True))
    require(sum(degrees) == solution.distinct_solutions, "the factors have another number of roots", degrees=degrees)
    require(total == proof.total, "the multiplicities do not sum to the number of solutions", sum=total)


def _require_counts(solution: Solution) -> None:
    """Real ones, distinct ones, all: each at most the next, and the others come in conjugate pairs."""
    real, distinct, count = len(solution.poses), solution.distinct_solutions, solution.complex_solutions
    facts = {"real": real, "distinct": distinct, "complex": count}
    require(real <= distinct <= count, "the numbers of solutions are out of order", **facts)
    require((distinct - real) % 2 == 0, "solutions that are not real come in pairs", **facts)
    limit = solution.problem.solution_bound
    require(distinct <= limit, "more solutions than the variety of motions allows", limit=limit, **facts)
    if solution.claim == Claim.COMPLETE:
        multiplicities = [pose.multiplicity for pose in solution.poses]
        rest = count - sum(multiplicity or 0 for multiplicity in multiplicities)
        require(count <= limit, "more solutions than the variety of motions allows", limit=limit, **facts)
        require(None not in multiplicities, "a complete list has a pose of unknown multiplicity", **facts)
        require(rest >= 0 and rest % 2 == 0, "solutions that are not real come in pairs", rest=rest, **facts)


def _representations(solution: Solution) -> list[PoseRepresentation]:
    """That of the poses, and that of the witnesses of a self-motion."""
    found = [] if solution.representation is None else [solution.representation]
    if isinstance(solution.self_motion, SelfMotion):
        found.append(solution.self_motion.representation)
    return found


def _require_representation(representation: PoseRepresentation, problem: ForwardProblem) -> None:
    """Modulo a prime: w.e = h', c.(e, f) = T h', and the legs and Study's condition vanish, at all roots of h.

    This holds for every prime that does not divide the leading coefficient, if it holds over Q.
    """
    h = representation.univariate.polynomial
    usable = primes_from(digest(problem.digest, "representation"), OTHER_BITS)
    prime = next(prime for prime in usable if int(h.leading_coefficient()) % prime)
    modulus, slope = _image(h, prime), _image(h.derivative(), prime)
    x = [_image(numerator, prime) for numerator in representation.univariate.numerator_polynomials]
    zero, unknown = nmod_poly([0], prime), nmod_poly([0, 1], prime)
    chart = sum((weight * value for weight, value in zip(representation.chart, x[:4], strict=True)), zero)
    require(chart == slope, "the chart of a representation does not hold", prime=prime)
    form = sum((weight * value for weight, value in zip(representation.separating_form, x, strict=True)), zero)
    require((form - unknown * slope) % modulus == zero, "a separating form has other values", prime=prime)
    products = [[x[k] * x[m] % modulus if k <= m else zero for m in range(8)] for k in range(8)]
    values = [evaluate(quadric, products) for quadric in pose_quadrics(problem)]
    norm = evaluate(motion_quadrics(problem.metric)[-1], products)
    for quartic in pose_quartics(problem):
        linear, root = (evaluate(quadric, products) if quadric else zero for quadric in (quartic.linear, quartic.root))
        values.append(quartic.value(linear, root, norm))
    for number, value in enumerate(values):
        require(value % modulus == zero, "solutions are not on the robot", equation=number, prime=prime)


def _image(polynomial: fmpz_poly, prime: int) -> nmod_poly:
    return nmod_poly(polynomial, prime)


def _require_mobility(motion: SelfMotion, problem: ForwardProblem) -> None:
    """The rank of the legs modulo a prime, as quadrics, is at most the one over Q that is said."""
    prime = next(primes_from(digest(problem.digest, "mobility"), OTHER_BITS))
    quadrics = linear_quadrics(problem)[problem.motion.has_study_condition :]
    places = sorted({place for quadric in quadrics for place in quadric})
    rows = [quadric.get(place, 0) % prime for quadric in quadrics for place in places]
    rank = nmod_mat(len(quadrics), len(places), rows, prime).rank()
    said = motion.mobility.rank
    require(rank <= said, "the rank of the legs is greater modulo a prime than over Q", modular=rank, said=said)
    require(motion.mobility.dimension > 0, "a self-motion of dimension 0", dimension=motion.mobility.dimension)
    if motion.real is RealMotion.NO_REAL_POSE:
        gaps = roots_in_gaps(motion.representation.univariate.primitive_polynomial, [])
        require(gaps != [True], "a witness is real, but no pose is")


def _require_slices(motion: MorePoses, problem: ForwardProblem) -> None:
    """Slices with different constants, whose poses are on the robot, and more of them than can be isolated."""
    constants = [found.constant for found in motion.slices]
    require(all(a < b for a, b in pairwise(constants)), "two slices are the same", slices=len(constants))
    require(motion.count > motion.bound, "no more poses than can be isolated", poses=motion.count, bound=motion.bound)
    for found in motion.slices:
        _require_representation(found.representation, motion.problem_of(problem, found))


def _require_poses(solution: Solution, have_room: Sequence[bool] | None) -> None:
    """Boxes apart, on the robot and in the intervals of their parameters; Jacobians; signs."""
    problem, poses, representation = solution.problem, solution.poses, solution.representation
    require_apart(poses)
    require_consistent_jacobians(poses, problem)
    if solution.claim == Claim.COMPLETE and has_degree_zero(problem):
        require_degree_zero(poses)
    if representation is not None:
        require_on_robot(poses, problem, solution.box_exponent, representation.chart, representation.separating_form)
        _require_all_roots(solution, representation.univariate.primitive_polynomial)
    elif solution.isolated is not None:
        from pkm_exact.numeric.pose_room import require_poses_on_robot

        require_poses_on_robot(poses, problem, solution.box_exponent, solution.isolated.chart, have_room)


def _require_all_roots(solution: Solution, h: fmpz_poly) -> None:
    """Each interval has a real root of h, by the change of sign, and no other number is one, by another count."""
    intervals = sorted((pose.parameter for pose in solution.poses if pose.parameter), key=lambda place: place.lo)
    require(len(intervals) == len(solution.poses), "a pose has no parameter", intervals=len(intervals))
    for number, place in enumerate(intervals):
        low, high = _sign(h, place.lo), _sign(h, place.hi)
        require(low * high <= 0 and (low or high or place.width == 0), "an interval has no root", interval=number)
    gaps = roots_in_gaps(h, intervals)
    require(True not in gaps, "a real root has no pose", gaps=gaps.count(True))


def _sign(h: fmpz_poly, point: Fraction) -> int:
    value = h(fmpq(point.numerator, point.denominator))
    return (value > 0) - (value < 0)

"""Whether a real motion is proved, where the complex poses form a set of positive dimension.

Floating point finds a place where all legs seem to have their lengths; further legs are joined there, with rational
data, until a pose is fixed, and that pose is certified. Proved then is one of these.

Turning. The joints of one side lie on a line, or in a point: one real pose is enough, for the platform turns from there
about a real line or point. The pose is a real root of a verified representation; or exists by ``poses.real_pose``.

A regular pose. The leg forms have rank r. Take r independent legs and further ones, six in all (three if planar), and a
real pose in a box with exactly one solution of these: the Jacobian of the six is regular there, that of the r has rank
r. So near the pose the r legs have their lengths on a real manifold of dimension 6 - r, and the others too, for their
forms are combinations of the r.

A motion that is known by its form (``poses.coaxial_motion``), where no pose is regular.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from random import Random
from typing import Final

import numpy as np

from pkm_exact.claim import RealMotion
from pkm_exact.completeness.completeness_proof import has_as_many_legs_as_freedoms
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.formulations.registry import formulation_codes
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import support, translation_coordinates
from pkm_exact.numeric.certification import isolated_solutions
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.levenberg_marquardt import DescentPolicy, distinct_poses, levenberg_marquardt
from pkm_exact.numeric.numeric_mechanism import numeric_machine
from pkm_exact.numeric.uncertified import NumericPose
from pkm_exact.policy import Policy
from pkm_exact.poses.coaxial_motion import screws
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.real_pose import are_out_of_reach, has_real_point
from pkm_exact.poses.search import PoseSearch
from pkm_exact.poses.self_motion import Cause, SelfMotion, form_rank, is_of_legs, size_of
from pkm_exact.poses.singularity import are_isolated
from pkm_exact.roots.isolation import real_root_enclosures
from pkm_exact.stages import Stages

STARTS: Final = 40
"""From which a real pose is looked for in floating point."""
TRIED: Final = 4
"""Of the poses found, those near which one is to be certified."""
BITS: Final = 16
"""Of the squared length of a further leg."""
CHART_SIZE: Final = 8
"""Size of the integers in the chart w.e = 1 near a pose."""
ROOT_BITS: Final = 64

_POINTS: Final = {Cause.PLATFORM_POINT: "base", Cause.BASE_POINT: "platform"}
"""The side whose joints have known distances from the point."""
_KEEPING: Final = (Cause.PLATFORM_MOTION, Cause.BASE_MOTION)
_TURNING: Final = (*_POINTS, Cause.PLATFORM_LINE, Cause.BASE_LINE)


def with_real_motion(problem: ForwardProblem, motion: SelfMotion, policy: Policy) -> SelfMotion:
    """The same proof with what is proved of real motions; with poses that prove one, where certificates tell it."""
    if not has_as_many_legs_as_freedoms(problem):
        shown = next(_witnesses(problem, motion, policy), None)
        if shown is not None:
            return shown
    return replace(motion, real=real_motion(problem, motion, policy) if is_of_legs(problem) else RealMotion.OPEN)


def real_motion(problem: ForwardProblem, motion: SelfMotion, policy: Policy) -> RealMotion:
    """What is proved of real motions of a robot with legs only."""
    causes = motion.mobility.causes
    for cause, side in _POINTS.items():
        if cause in causes:
            joints = [getattr(leg, side) for leg in problem.distances]
            exists = has_real_point(joints, [leg.length_squared for leg in problem.distances], problem.metric)
            return RealMotion.PROVED if exists else RealMotion.NO_REAL_POSE
    if are_out_of_reach(problem):
        return RealMotion.NO_REAL_POSE
    if screws(problem):
        return RealMotion.PROVED
    turns = any(cause in _TURNING for cause in causes)
    if turns and _has_real_root(motion.representation):
        return RealMotion.PROVED
    return RealMotion.PROVED if _is_proved(problem, motion, policy, turns=turns) else RealMotion.OPEN


def _witnesses(problem: ForwardProblem, motion: SelfMotion, policy: Policy) -> Iterator[SelfMotion]:
    """Proofs of a real motion, whatever the constraints: by the poses that are known, or others where they hold."""
    if _are_witnesses(problem, motion, motion.legs, motion.representation, policy):
        yield replace(motion, real=RealMotion.PROVED)
    for pose in _approximate_poses(problem, policy.seed):
        further = _further_legs(problem, motion.mobility.dimension, pose, policy.seed)
        extended = replace(problem, constraints=(*problem.constraints, *further))
        representation = PoseSearch(extended, formulation_codes()[0], policy, Stages()).found()[1]
        if representation is not None and _are_witnesses(problem, motion, further, representation, policy):
            yield SelfMotion(motion.mobility, tuple(further), representation, RealMotion.PROVED)


def _are_witnesses(
    problem: ForwardProblem,
    motion: SelfMotion,
    legs: Sequence[Distance],
    representation: PoseRepresentation,
    policy: Policy,
) -> bool:
    """Whether poses in which further legs have their lengths prove a real motion under constraints of any type.

    If a motion keeps all of them, it goes on from there. If the pose is regular for them and the further legs together,
    as many as freedoms, the independent ones among them define a real manifold of positive dimension there, on which
    the others hold too.
    """
    if not _has_real_root(representation):
        return False
    if any(cause in _KEEPING for cause in motion.mobility.causes):
        return True
    extended = replace(problem, constraints=(*problem.constraints, *legs))
    missing = problem.motion.dimension - motion.mobility.rank - len(problem.squares)
    return len(legs) == missing > 0 and are_isolated(representation, extended, policy)


def _is_proved(problem: ForwardProblem, motion: SelfMotion, policy: Policy, *, turns: bool) -> bool:
    rank, degrees = motion.mobility.rank, problem.motion.dimension
    for pose in _approximate_poses(problem, policy.seed):
        if rank < degrees and _is_regular(problem, rank, pose, policy.seed):
            return True
        if turns and _turns(problem, motion, pose, policy):
            return True
    return False


def _approximate_poses(problem: ForwardProblem, seed: int) -> Iterator[NumericPose]:
    """Places where the constraints hold as far as floating point tells; none beyond its reach."""
    try:
        robot = numeric_machine(problem)
    except InputError:
        return iter(())
    limits = DescentPolicy(starts=STARTS, seed=seed)
    return islice(iter(distinct_poses(robot, levenberg_marquardt(robot, limits), limits.distinct)), TRIED)


def _is_regular(problem: ForwardProblem, rank: int, pose: NumericPose, seed: int) -> bool:
    """Whether a real pose near the given one is certified, regular for as many legs as are independent."""
    legs = _independent_legs(problem, rank)
    further = _further_legs(problem, problem.motion.dimension - rank, pose, seed)
    x = _study_coordinates(pose, problem.metric)
    weights = [round(CHART_SIZE * float(value)) for value in x[:4] / np.linalg.norm(x[:4])]
    system = ChartSystem(replace(problem, constraints=(*legs, *further)), weights)
    point = x[list(support(problem))] / float(x[:4] @ weights)
    return bool(isolated_solutions(system, point[None].astype(np.complex128)).real)


def _independent_legs(problem: ForwardProblem, rank: int) -> list[Distance]:
    """The first legs whose forms are a basis."""
    chosen: list[Distance] = []
    for leg in problem.distances:
        if len(chosen) < rank and form_rank(replace(problem, constraints=(*chosen, leg))) == len(chosen) + 1:
            chosen.append(leg)
    return chosen


def _further_legs(problem: ForwardProblem, count: int, pose: NumericPose, seed: int) -> list[Distance]:
    """Legs between random points, with the lengths that they have at a pose, rounded."""
    random = Random(seed)
    size = size_of(problem)
    scales = np.sqrt(np.array(problem.metric, dtype=float))
    legs: list[Distance] = []
    while len(legs) < count:
        x, y, z, u, v, w = (Fraction(random.randint(-size, size)) for _ in range(6))
        base: Vector = (x, y, Fraction(0) if problem.motion.is_planar else z)
        platform: Vector = (u, v, Fraction(0) if problem.motion.is_planar else w)
        a, b = (scales * [float(value) for value in joint] for joint in (base, platform))
        line = np.array(pose.position) + np.array(pose.rotation) @ b - a
        square = _rounded(float(line @ line))
        if square:
            legs.append(Distance(base, platform, square))
    return legs


def _rounded(value: float) -> Fraction:
    """To ``BITS`` bits."""
    exact = Fraction(value)
    if not exact:
        return exact
    unit = Fraction(2) ** (exact.numerator.bit_length() - exact.denominator.bit_length() - BITS)
    return round(exact / unit) * unit


def _study_coordinates(pose: NumericPose, metric: Sequence[int]) -> np.typing.NDArray[np.float64]:
    """(e, f) of a pose, in rational coordinates with respect to the metric."""
    scales = np.sqrt(np.array(metric, dtype=float))
    e = np.array(pose.quaternion) / np.array([scales.prod(), *scales])
    position = np.array(pose.position) / scales
    return np.array([*e, *translation_coordinates(np.outer(position, e).tolist(), metric)])


def _turns(problem: ForwardProblem, motion: SelfMotion, pose: NumericPose, policy: Policy) -> bool:
    """Whether a real pose is certified that has further lengths, as near the given one."""
    further = _further_legs(problem, motion.mobility.dimension, pose, policy.seed)
    extended = replace(problem, constraints=(*problem.distances, *further))
    search = PoseSearch(extended, formulation_codes()[0], policy, Stages())
    representation = search.found()[1]
    return representation is not None and _has_real_root(representation)


def _has_real_root(representation: PoseRepresentation) -> bool:
    return bool(real_root_enclosures(representation.univariate.primitive_polynomial, ROOT_BITS))

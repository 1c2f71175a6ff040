"""Proofs that the poses of a robot form curves or surfaces. Whether real ones are among them is another question
(``numeric.real_motion``): only then the robot moves although its actuators are locked.

Few or dependent constraints. Rigid motions form a variety of dimension 6 on which a leg is a hyperplane, as are most
constraints; planar motions have dimension 3. If the forms have rank r on a group of motions of dimension d, and there
are q quadrics, every component of the set of poses has dimension at least d - r - q. If that is positive (an
architecture singularity, if there are as many legs as freedoms), one finite pose, real or complex, lies on such a set.

Collinear joints. If the platform joints of legs lie on a line, the platform can be turned about it, whatever the pose;
if they lie in one point, about that point in any way. The same holds for the base, and for whatever motion keeps
constraints of other types (``poses.symmetry``). Again one finite pose is enough.

Such a pose is found by joining further legs, chosen at random, until finitely many poses are left, and solving: every
pose of the longer list of constraints is one of the robot's.

Congruent halves. If A_i = d + R B_i for one rotation R, and all legs are equal, the platform can move on a sphere (a
planar one on a circle) without turning: every pose (C, R) with |C - d| = l has these leg lengths.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from fractions import Fraction
from itertools import combinations
from random import Random

from flint import fmpq, fmpq_mat, fmpz_mat

from pkm_exact.claim import RealMotion
from pkm_exact.constraints.constraint import Role
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.formulations.base import rational
from pkm_exact.geometry.inverse import dot
from pkm_exact.geometry.planar_rotation import turn_of
from pkm_exact.geometry.problem import ForwardProblem, points
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import linear_quadrics
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.poses.symmetry import base_freedom, platform_freedom


class Cause(StrEnum):
    """Why every pose lies on a curve or surface of poses."""

    DEPENDENT_LEGS = "dependent leg forms"
    FEW = "fewer constraints than freedoms"
    SIMILAR_ON_CONIC = "similar base and platform on a conic"
    PLATFORM_LINE = "platform joints on a line"
    BASE_LINE = "base joints on a line"
    PLATFORM_POINT = "coincident platform joints"
    BASE_POINT = "coincident base joints"
    PLATFORM_MOTION = "a motion in the platform's frame that keeps all constraints"
    BASE_MOTION = "a motion in the fixed frame that keeps all constraints"


@dataclass(frozen=True)
class Mobility:
    """That the set of poses, if there are any, has at least a certain dimension everywhere, and why.

    Attributes
    ----------
    dimension : int
        At least 1.
    rank : int
        Of the linear forms of the constraints.
    causes : tuple of Cause
        All that apply; each is a proof by itself, the dimension is the greatest that one of them gives.
    """

    dimension: int
    rank: int
    causes: tuple[Cause, ...]


@dataclass(frozen=True)
class SelfMotion:
    """A proof that the poses form a set of positive dimension.

    Attributes
    ----------
    mobility : Mobility
        The set of poses has at least its dimension at each of the poses below.
    legs : tuple of Distance
        Further legs.
    representation : PoseRepresentation
        Complex poses, verified, which the robot's constraints admit and in which the further legs have their lengths.
    real : RealMotion
        What is proved of real ones.
    """

    mobility: Mobility
    legs: tuple[Distance, ...]
    representation: PoseRepresentation
    real: RealMotion = RealMotion.OPEN


def mobility(problem: ForwardProblem) -> Mobility | None:
    """What the constraints alone tell of the dimension of the set of poses, or None if it may be 0.

    Examples
    --------
    >>> zero = Fraction(0)
    >>> base = [(Fraction(x), Fraction(x * x), Fraction(x**3)) for x in range(6)]
    >>> legs = tuple(Distance(joint, (Fraction(n * n), zero, zero), Fraction(99)) for n, joint in enumerate(base))
    >>> mobility(ForwardProblem(legs))
    Mobility(dimension=1, rank=6, causes=(<Cause.PLATFORM_LINE: 'platform joints on a line'>,))
    """
    found = _by_joints(problem) if is_of_legs(problem) else _by_symmetry(problem)
    rank = form_rank(problem)
    freedom = problem.motion.dimension - rank - len(problem.squares)
    if freedom > 0:
        found[_dependence(problem)] = freedom
    return Mobility(max(found.values()), rank, tuple(found)) if found else None


def is_of_legs(problem: ForwardProblem) -> bool:
    """Whether it is a robot with legs of known length only, in space or in the plane."""
    return bool(problem.constraints) and problem.has_only_distances and problem.motion in (SPATIAL, PLANAR)


def _by_joints(problem: ForwardProblem) -> dict[Cause, int]:
    """Joints on a line or in a point."""
    found: dict[Cause, int] = {}
    for joints, point, line in (
        ([leg.platform for leg in problem.distances], Cause.PLATFORM_POINT, Cause.PLATFORM_LINE),
        ([leg.base for leg in problem.distances], Cause.BASE_POINT, Cause.BASE_LINE),
    ):
        spanned = affine_dimension(joints)
        if spanned == 0:
            found[point] = 1 if problem.motion.is_planar else 3
        elif spanned == 1 and not problem.motion.is_planar:
            found[line] = 1
    return found


def _by_symmetry(problem: ForwardProblem) -> dict[Cause, int]:
    """Motions that keep all constraints, whatever their types."""
    freedoms = ((Cause.PLATFORM_MOTION, platform_freedom(problem)), (Cause.BASE_MOTION, base_freedom(problem)))
    return {cause: dimension for cause, dimension in freedoms if dimension}


def affine_dimension(points: Sequence[Vector]) -> int:
    """Dimension of the line, plane or space that points span; 0 if they coincide."""
    return int(fmpq_mat([[rational(x) for x in _difference(point, points[0])] for point in points]).rank())


def form_rank(problem: ForwardProblem) -> int:
    """Rank over Q of the linear forms of all constraints, as functions on the motions of the problem."""
    quadrics, known = linear_quadrics(problem), int(problem.motion.has_study_condition)
    places = sorted({place for quadric in quadrics for place in quadric})
    rows = [quadric.get(place, 0) for quadric in quadrics for place in places]
    return int(fmpz_mat(len(quadrics), len(places), rows).rank()) - known


def _dependence(problem: ForwardProblem) -> Cause:
    """Why the forms leave a freedom: there are too few, or they depend, in a known way if it is one."""
    if problem.equation_count < problem.motion.dimension:
        return Cause.FEW
    if not is_of_legs(problem) or problem.motion.is_planar:
        return Cause.DEPENDENT_LEGS
    base, platform = [leg.base for leg in problem.distances], [leg.platform for leg in problem.distances]
    if affine_dimension(base) != 2:
        return Cause.DEPENDENT_LEGS
    squares = []
    for i, j in combinations(range(len(base)), 2):
        lines = _difference(base[i], base[j]), _difference(platform[i], platform[j])
        squares.append([rational(dot(line, line, problem.metric)) for line in lines])
    one = Fraction(1)
    quadratic = [[one, *point, *(point[i] * point[j] for i in range(3) for j in range(i + 1))] for point in base]
    conic = fmpq_mat([[rational(value) for value in row] for row in quadratic])
    similar = fmpq_mat(squares).rank() == 1 and affine_dimension(platform) == 2
    return Cause.SIMILAR_ON_CONIC if similar and conic.rank() < len(base) else Cause.DEPENDENT_LEGS


def size_of(problem: ForwardProblem) -> int:
    """An integer beyond all coordinates of points of base and platform."""
    joints = [*points(problem, Role.BASE_POINT), *points(problem, Role.PLATFORM_POINT)]
    return 1 + max((abs(value) for joint in joints for value in joint), default=Fraction(1)).__ceil__()


def extended_problem(problem: ForwardProblem, count: int, seed: int) -> ForwardProblem:
    """The problem with ``count`` further legs, random joints of the size of the robot's own."""
    random = Random(seed)
    size = size_of(problem)
    squares = [found.length_squared for found in problem.constraints if isinstance(found, Distance)]
    square = 1 + max(squares, default=Fraction(size * size)).__ceil__()
    further = []
    for _ in range(count):
        x, y, z, u, v, w = (Fraction(random.randint(-size, size)) for _ in range(6))
        if problem.motion.is_planar:
            z = w = Fraction(0)
        further.append(Distance((x, y, z), (u, v, w), Fraction(random.randint(1, square))))
    return replace(problem, constraints=(*problem.constraints, *further))


@dataclass(frozen=True)
class TranslationalMotion:
    """A sphere of poses: A_i = offset + R B_i for all legs, which have one length l; then C - offset is any vector of
    that length. In the plane it is a circle.

    Attributes
    ----------
    rotation : 3 x 3 tuple of Fraction
        R, in rational coordinates.
    offset : tuple of 3 Fraction
    """

    rotation: tuple[Vector, Vector, Vector]
    offset: Vector

    @property
    def real(self) -> RealMotion:
        """Proved: the length of a leg is real and not 0, and so is R."""
        return RealMotion.PROVED


def translational_motion(problem: ForwardProblem) -> TranslationalMotion | None:
    """The sphere or circle of poses of a robot with congruent base and platform and equal legs, or None."""
    if not is_of_legs(problem):
        return None
    legs = problem.distances
    if len({leg.length_squared for leg in legs}) != 1:
        return None
    rotation = _planar_rotation(problem) if problem.motion.is_planar else _spatial_rotation(problem)
    if rotation is None:
        return None
    offsets = {_difference(leg.base, _image(rotation, leg.platform)) for leg in legs}
    return TranslationalMotion(rotation, offsets.pop()) if len(offsets) == 1 else None


def _spatial_rotation(problem: ForwardProblem) -> tuple[Vector, Vector, Vector] | None:
    """The rotation that takes the platform's shape to the base's, from three joints that are not on a line."""
    for triple in combinations(problem.distances, 3):
        u = _axes([leg.platform for leg in triple], problem.metric)
        v = _axes([leg.base for leg in triple], problem.metric)
        if not any(u[2]):
            continue
        matrix = fmpq_mat([[rational(axis[i]) for axis in v] for i in range(3)])
        matrix *= fmpq_mat([[rational(axis[i]) for axis in u] for i in range(3)]).inv()
        gram = fmpq_mat([[g if i == j else 0 for j in range(3)] for i, g in enumerate(problem.metric)])
        if matrix.transpose() * gram * matrix != gram:
            return None
        x, y, z = (_vector([matrix[i, j] for j in range(3)]) for i in range(3))
        return x, y, z
    return None


def _planar_rotation(problem: ForwardProblem) -> tuple[Vector, Vector, Vector] | None:
    """The rotation of the plane that takes the platform's shape to the base's, from two joints."""
    for first, second in combinations(problem.distances, 2):
        u, v = _difference(second.platform, first.platform), _difference(second.base, first.base)
        square = dot(u, u, problem.metric)
        if square:
            if dot(v, v, problem.metric) != square:
                return None
            return turn_of((dot(u, v, problem.metric) / square, (u[0] * v[1] - u[1] * v[0]) / square), problem.metric)
    return None


def _axes(points: Sequence[Vector], metric: Sequence[int]) -> tuple[Vector, Vector, Vector]:
    """P_2 - P_1, P_3 - P_1 and G^-1 times their vector product."""
    a, b = _difference(points[1], points[0]), _difference(points[2], points[0])
    x, y, z = ((a[j] * b[k] - a[k] * b[j]) / metric[i] for i, j, k in CYCLIC)
    return a, b, (x, y, z)


def _difference(left: Vector, right: Vector) -> Vector:
    x, y, z = (a - b for a, b in zip(left, right, strict=True))
    return x, y, z


def _image(rotation: Sequence[Vector], vector: Vector) -> Vector:
    x, y, z = (sum((r * v for r, v in zip(row, vector, strict=True)), Fraction(0)) for row in rotation)
    return x, y, z


def _vector(values: Sequence[fmpq]) -> Vector:
    x, y, z = (Fraction(int(value.p), int(value.q)) for value in values)
    return x, y, z

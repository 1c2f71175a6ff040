"""A robot in ball arithmetic: ordinary coordinates, origins at the centroids of the joints, unit of length its size.

In these coordinates a pose is x = (e, f) up to a factor (``geometry.study`` for G = I), and the 17 quantities
(|C|^2; u; C; R; 1) N(e), and Study's condition as the 18th, are quadratic forms x^T M_k x. A leg is a row of 18
coefficients on them (``leg_row``), and the n equations in n unknowns, in a chart w.e = 1, are

    F(x) = (L G(x) x / 2, w.e - 1),   G(x) = (2 M_k x)_k.

Everything is rounded outward at the precision in force.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, cached_property
from typing import Any, Final, TypeAlias

from flint import acb, acb_mat, arb, arb_mat, fmpz_mat

from pkm_exact.balls import Balls, ball
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Form, Vector, in_frames, ordinary
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import STUDY_CONDITION, motion_quadrics
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.quaternions import quaternion_product
from pkm_exact.numeric.study_system import landmarks

QUANTITIES: Final = 18
"""Number of quadratic forms: 17 coordinates of a rigid motion, and Study's condition."""
SQUARE, TURNED, POSITION, ROTATION, NORM, STUDY = 0, 1, 4, 7, 16, 17
"""Where |C|^2, u, C, R, 1 and Study's condition begin among them."""

Chart: TypeAlias = tuple[tuple[int, int], ...]
"""w in w.e = 1: real and imaginary parts of four Gaussian integers."""


@dataclass(frozen=True)
class CentredFrames:
    """New frames and unit of length: a coordinate x becomes (x - origin) / unit, in rational coordinates.

    Attributes
    ----------
    base, platform : vector of 3 Fraction
        Origins, with respect to the metric of the model.
    unit : Fraction
        A power of two.
    """

    base: Vector
    platform: Vector
    unit: Fraction


def centred_frames(problem: ForwardProblem) -> CentredFrames:
    """The frames at the centroids, and a unit of about the size of the robot.

    Origins are moved along those axes only along which the platform can move: the motions remain the same group.
    """
    base, platform = landmarks(problem)
    origins = [_along(problem.motion, _centroid(points)) for points in (base, platform)]
    squares = [leg.length_squared for leg in problem.constraints if isinstance(leg, Distance)]
    for points, origin in zip((base, platform), origins, strict=True):
        for point in points:
            terms = (g * (x - m) ** 2 for g, x, m in zip(problem.metric, point, origin, strict=True))
            squares.append(sum(terms, Fraction(0)))
    greatest = max(squares) or Fraction(1)
    bits = greatest.numerator.bit_length() - greatest.denominator.bit_length()
    return CentredFrames(origins[0], origins[1], Fraction(2) ** (bits // 2))


def _along(motion: Motion, point: Vector) -> Vector:
    x, y, z = (value if axis in motion.twist else Fraction(0) for axis, value in enumerate(point))
    return x, y, z


def _centroid(joints: Sequence[Vector]) -> Vector:
    x, y, z = (sum(axis, Fraction(0)) / len(joints) for axis in zip(*joints, strict=True))
    return x, y, z


def centred_joint(joint: Vector, origin: Vector, unit: Fraction, metric: Sequence[int]) -> list[arb]:
    """Ordinary coordinates of a joint in a centred frame."""
    return [arb(g).sqrt() * ball((x - m) / unit) for g, x, m in zip(metric, joint, origin, strict=True)]


def leg_row(base: Sequence[arb], platform: Sequence[arb], square: arb) -> list[arb]:
    """The 18 coefficients of |C|^2 + 2 B.u - 2 A.C - 2 A.(R B) + |A|^2 + |B|^2 - l^2."""
    row = [arb(1), *(2 * b for b in platform), *(-2 * a for a in base)]
    row += [-2 * a * b for a in base for b in platform]
    constant = sum((a * a for a in base), arb(0)) + sum((b * b for b in platform), arb(0)) - square
    return [*row, constant, arb(0)]


def centred_leg(leg: Distance, frames: CentredFrames, metric: Sequence[int]) -> list[arb]:
    """The 18 coefficients of a leg in centred frames."""
    base = centred_joint(leg.base, frames.base, frames.unit, metric)
    platform = centred_joint(leg.platform, frames.platform, frames.unit, metric)
    return leg_row(base, platform, ball(leg.length_squared / frames.unit**2))


def centred_form(form: Form, frames: CentredFrames, metric: Metric, size: Fraction | None = None) -> list[arb]:
    """The 18 coefficients of a constraint of any type in centred frames, divided by ``size``, by default its own."""
    moved = in_frames(form, frames.base, frames.platform, frames.unit, metric)
    factor = 1 / (size or form_size(moved))
    return [*ordinary([ball(value * factor) for value in moved], [arb(g).sqrt() for g in metric]), arb(0)]


def form_size(form: Form) -> Fraction:
    """The size of the largest coefficient, roughly: a power of two."""
    greatest = max(abs(value) for value in form)
    return Fraction(2) ** (greatest.numerator.bit_length() - greatest.denominator.bit_length())


def study_row() -> list[arb]:
    """The coefficients of Study's condition."""
    return [arb(0)] * STUDY + [arb(1)]


@cache
def gradient_forms(motion: Motion) -> fmpz_mat:
    """All 2 M_k, one below the other, on the coordinates that are not 0 for every pose."""
    kept = motion.support
    rows: list[list[int]] = []
    for quadric in (*motion_quadrics((1, 1, 1)), STUDY_CONDITION):
        matrix = [[0] * 8 for _ in range(8)]
        for (k, m), value in quadric.items():
            matrix[k][m] += value
            matrix[m][k] += value
        rows += [[matrix[k][m] for m in kept] for k in kept]
    return fmpz_mat(rows)


@cache
def gradients_of_gradients(motion: Motion) -> fmpz_mat:
    """All 2 M_k, each a row of n^2 entries."""
    size = len(motion.support)
    return fmpz_mat(QUANTITIES, size**2, gradient_forms(motion).entries())


@cache
def _gradient_balls(motion: Motion, kind: Any) -> Balls:
    return kind(arb_mat(gradient_forms(motion)))


def gradients(points: Balls, motion: Motion) -> list[Balls]:
    """G at points or in boxes that are the columns of a matrix: the derivatives of the 18 quantities, 18 x n each."""
    size = len(motion.support)
    kind: Any = type(points)
    entries = (_gradient_balls(motion, kind) * points).transpose().entries()
    stride = QUANTITIES * size
    return [kind(QUANTITIES, size, entries[k * stride : (k + 1) * stride]) for k in range(points.ncols())]


def quantities(slopes: Balls, x: Balls) -> list[acb]:
    """The 18 quantities at x, from G(x)."""
    return [value / 2 for value in (slopes * x).entries()]


def quantities_at(x: Balls, motion: Motion) -> list[acb]:
    """The 18 quantities at a point or in a box."""
    return quantities(gradients(x, motion)[0], x)


@dataclass(frozen=True, eq=False)
class CentredLegs:
    """The legs of a robot in its centred frames.

    Attributes
    ----------
    base, platform : list of 3 balls per leg
    lengths : list of arb
    """

    base: list[list[arb]]
    platform: list[list[arb]]
    lengths: list[arb]


@dataclass(frozen=True, eq=False)
class CentredRobot:
    """A locked robot in its centred frames, every number a ball.

    Attributes
    ----------
    problem : ForwardProblem
    frames : CentredFrames
    forms : (n - 1) x 18 matrix
        Study's condition where it is one, and the constraints.
    """

    problem: ForwardProblem
    frames: CentredFrames
    forms: acb_mat

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.problem.motion.support)

    @cached_property
    def legs(self) -> CentredLegs:
        """The legs of a Gough platform or its planar sister, at the precision in force when first asked for.

        Raises
        ------
        InputError
            If it is another robot.
        """
        legs, frames, metric = self.problem.gough_legs, self.frames, self.problem.metric
        return CentredLegs(
            [centred_joint(leg.base, frames.base, frames.unit, metric) for leg in legs],
            [centred_joint(leg.platform, frames.platform, frames.unit, metric) for leg in legs],
            [ball(leg.length_squared / frames.unit**2).sqrt() for leg in legs],
        )


def centred_robot(problem: ForwardProblem, frames: CentredFrames) -> CentredRobot:
    """The robot at the precision in force."""
    rows = [study_row()] if problem.motion.has_study_condition else []
    if problem.has_only_distances:
        rows += [centred_leg(leg, frames, problem.metric) for leg in problem.distances]
    else:
        rows += [centred_form(form, frames, problem.metric) for form in problem.forms]
    return CentredRobot(problem, frames, acb_mat(arb_mat(rows)))


def origins(robot: CentredRobot) -> tuple[list[arb], list[arb]]:
    """Ordinary coordinates of the centred frames' origins in the frames of the model."""
    zero: Vector = (Fraction(0),) * 3
    metric = robot.problem.metric
    one = Fraction(1)
    return (
        centred_joint(robot.frames.base, zero, one, metric),
        centred_joint(robot.frames.platform, zero, one, metric),
    )


def centred_point(e: Sequence[acb], f: Sequence[acb], robot: CentredRobot) -> acb_mat:
    """The coordinates x of a pose (e, f) given in ordinary coordinates of the model's frames.

    f becomes (f + e b - a e) / unit, with a and b the origins as quaternions.
    """
    a, b = ([acb(0), *map(acb, origin)] for origin in origins(robot))
    right, left = quaternion_product(e, b), quaternion_product(a, e)
    unit = ball(robot.frames.unit)
    moved = [(value + r - v) / unit for value, r, v in zip(f, right, left, strict=True)]
    full = [*e, *moved]
    kept = robot.problem.motion.support
    return acb_mat(robot.size, 1, [full[k] for k in kept])

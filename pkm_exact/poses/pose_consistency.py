"""Does a list of poses agree with the robot, with its own Jacobians and with the numbers it came from?

Nothing here proves a pose; the engines do. These are conditions that every right list meets, computed along other ways
than those of the engines and in a small fraction of their time: a list that fails one is not an answer.

Signs. Let there be as many equations as freedoms. The left-hand sides are a map from the motions, an oriented manifold
without boundary, to a space of the same dimension. If |C|^2 has a coefficient other than 0 in one of the forms, as it
has for a leg, that form grows with |C|, as rotations are bounded: it is bounded below, and bounded above only where C
is. So the map is proper, and not onto. The same holds of turns about a point, a compact manifold. The degree of such a
map is 0 (Milnor, Topology from the Differentiable Viewpoint, section 5), and where the list is complete the local
degrees of its poses sum to 0. At a regular pose the local degree is the sign of the determinant of the Jacobian; at one
of multiplicity m it is m modulo 2, and at most m in absolute value (Eisenbud and Levine, Annals of Mathematics 106,
1977). Of planes alone nothing is said: three of them may meet in one point.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

from flint import arb, arb_mat, fmpz_mat

from pkm_exact.balls import ball, hull
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Form, ordinary, value_at
from pkm_exact.errors import InternalContradictionError
from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import CYCLIC
from pkm_exact.geometry.study import translation_coordinates
from pkm_exact.poses.boxes import meeting_boxes
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.wrenches import least_multiplicity
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval

_VELOCITIES = 3
"""The first components of a twist are those of the velocity."""
GUARD_BITS = 64
"""Boxes on the grid 2^-k are put into the equations with k + 64 bits."""


def require_consistent_jacobians(poses: Sequence[Pose], problem: ForwardProblem) -> None:
    """Rank, sign, singular values and multiplicity of every pose agree.

    Raises
    ------
    InternalContradictionError
    """
    full, has_signs = problem.motion.dimension, problem.equation_count == problem.motion.dimension
    for number, pose in enumerate(poses):
        jacobian, multiplicity = pose.jacobian, pose.multiplicity
        if jacobian is None:
            raise InternalContradictionError("a pose has no Jacobian", {"pose": number})
        rank, sign, is_regular = jacobian.rank, jacobian.det_sign, jacobian.rank == full
        if not 0 <= rank <= full:
            wrong = "the rank of a Jacobian is out of range"
        elif sign not in ((1, -1) if has_signs else (None,)) if is_regular else sign != 0:
            wrong = "sign and rank of a Jacobian disagree"
        elif not jacobian.sigma_min.is_above_zero == is_regular == (jacobian.condition is not None):
            wrong = "rank and singular values of a Jacobian disagree"
        elif multiplicity is not None and not (
            multiplicity == 1 if is_regular else multiplicity >= least_multiplicity(problem, rank)
        ):
            wrong = "multiplicity and rank of a Jacobian disagree"
        else:
            continue
        facts = {"pose": number, "rank": rank, "sign": sign, "multiplicity": multiplicity}
        raise InternalContradictionError(wrong, facts)


def has_degree_zero(problem: ForwardProblem) -> bool:
    """Whether the constraints are proved to be a map of degree 0, so that signs cancel. "No" means: not by this proof.

    Examples
    --------
    >>> has_degree_zero(ForwardProblem(()))
    False
    """
    if problem.equation_count != problem.motion.dimension:
        return False
    moves = any(k < _VELOCITIES for k in problem.motion.twist)
    return not moves or any(form[0] for form in problem.forms)


def require_degree_zero(poses: Sequence[Pose]) -> None:
    """The signs of a complete list of poses cancel, up to what multiple poses can make up for.

    Raises
    ------
    InternalContradictionError
    """
    regular = sum(pose.jacobian.det_sign or 0 for pose in poses if pose.jacobian is not None)
    multiple = sum(pose.multiplicity or 0 for pose in poses if pose.jacobian is not None and not pose.jacobian.det_sign)
    require(
        abs(regular) <= multiple and (regular - multiple) % 2 == 0,
        "the signs of the leg Jacobians of a complete list do not cancel",
        sum=regular,
        multiple=multiple,
    )


def require_apart(poses: Sequence[Pose]) -> None:
    """No two boxes meet, and no two poses have the same place in their lists of parameters.

    Raises
    ------
    InternalContradictionError
    """
    for first, second in meeting_boxes([pose.box for pose in poses]):
        require(False, "the boxes of two poses meet", first=first, second=second)
    parameters = sorted((pose.parameter for pose in poses if pose.parameter is not None), key=lambda place: place.lo)
    for left, right in pairwise(parameters):
        require(left.hi <= right.lo and left != right, "two poses have one parameter", left=left, right=right)


def require_on_robot(
    poses: Sequence[Pose],
    problem: ForwardProblem,
    exponent: int,
    chart: Sequence[int],
    form: Sequence[int] | None = None,
) -> None:
    """Every box has room for a pose of the robot: legs, rotation, quaternion, chart and parameter.

    Parameters
    ----------
    poses : sequence of Pose
    problem : ForwardProblem
    exponent : int
        Of the grid of the boxes.
    chart : sequence of 4 int
        w: the quaternion has the sign for which w.e > 0.
    form : sequence of 8 int, optional
        c: the parameter is c.(e, f) with w.e = 1.

    Raises
    ------
    InternalContradictionError
    """
    if not poses:
        return
    with working_precision(exponent + GUARD_BITS):
        robot = _Robot(problem)
        rows = _enclosures(poses, exponent)
        for number, has_lengths in enumerate(robot.have_lengths(rows)):
            require(has_lengths, "a box has no room for the leg lengths", pose=number)
        for number, values in enumerate(rows):
            require(robot.admits(values), "a box has no room for a constraint", pose=number)
        for number, (pose, values) in enumerate(zip(poses, rows, strict=True)):
            c, rotation, q = values[:3], [values[3:6], values[6:9], values[9:12]], values[12:]
            require(_is_turn(rotation, q), "rotation matrix and quaternion disagree", pose=number)
            e = robot.rational_quaternion(q)
            scale = _dot(chart, e)
            require(not scale <= 0, "a quaternion has the wrong sign", pose=number, chart=tuple(chart))
            if form is not None and pose.parameter is not None and scale > 0:
                value = _dot(form, [*e, *robot.translation(c, e)]) / scale
                place = _enclosing(pose.parameter)
                require(value.overlaps(place), "a box does not belong to its parameter", pose=number, value=value)


class _Robot:
    """Joints and squared lengths in ordinary coordinates, as balls."""

    def __init__(self, problem: ForwardProblem) -> None:
        self.metric = problem.metric
        legs = [found for found in problem.constraints if isinstance(found, Distance)]
        self.axes = [arb(g).sqrt() for g in problem.metric]
        self.volume = self.axes[0] * self.axes[1] * self.axes[2]
        self.joints = self._joints(legs) if legs else None
        """B, 1 and -A: what R, C and 1 are multiplied with."""
        self.squares = [ball(leg.length_squared) for leg in legs]
        others = replace(problem, constraints=tuple(found for found in problem.constraints if found not in legs))
        self.forms = [self._ordinary(form) for form in (*others.forms, *map(_fractions, problem.motion.forms))]
        self.quadrics = [
            (self._ordinary(square.linear), self._ordinary(square.root), ball(square.factor))
            for square in problem.squares
        ]

    def _joints(self, legs: Sequence[Distance]) -> arb_mat:
        platform, base = (
            [
                [ball(value) * axis for value in row]
                for axis, row in zip(self.axes, zip(*side, strict=True), strict=True)
            ]
            for side in ([leg.platform for leg in legs], [leg.base for leg in legs])
        )
        return arb_mat([*platform, [arb(1)] * len(legs), *([-value for value in row] for row in base)])

    def _ordinary(self, form: Form) -> list[arb]:
        return ordinary([ball(value) for value in form], self.axes)

    def admits(self, values: Sequence[arb]) -> bool:
        """Whether every other constraint, and what the motions satisfy by themselves, is possible at a pose."""
        place = values[:3], [values[3:6], values[6:9], values[9:12]], (1, 1, 1)
        linear = all(value_at(form, *place).contains(0) for form in self.forms)
        return linear and all(
            (value_at(left, *place) - factor * at_root * at_root).contains(0)
            for left, root, factor in self.quadrics
            for at_root in [value_at(root, *place)]
        )

    def have_lengths(self, rows: Sequence[Sequence[arb]]) -> Iterator[bool]:
        """For each pose whether |C + R B - A|^2 = l^2 is possible for every leg."""
        if self.joints is None:
            return
        units = [[arb(int(i == j)) for j in range(3)] for i in range(3)]
        parts = [[*values[3 + 3 * i : 6 + 3 * i], values[i], *units[i]] for values in rows for i in range(3)]
        lines = (arb_mat(parts) * self.joints).tolist()
        for place in range(0, len(lines), 3):
            yield all(
                (x * x + y * y + z * z).overlaps(square)
                for x, y, z, square in zip(*lines[place : place + 3], self.squares, strict=True)
            )

    def rational_quaternion(self, q: Sequence[arb]) -> list[arb]:
        """e, up to a positive factor, with respect to the metric."""
        return [q[0] / self.volume, *(value / axis for value, axis in zip(q[1:], self.axes, strict=True))]

    def translation(self, c: Sequence[arb], e: Sequence[arb]) -> list[arb]:
        """f of the pose, times the same factor as e."""
        position = [value / axis for value, axis in zip(c, self.axes, strict=True)]
        return translation_coordinates([[value * entry for entry in e] for value in position], self.metric)


def _is_turn(rows: Sequence[Sequence[arb]], q: Sequence[arb]) -> bool:
    """Whether the matrix can be that of the unit quaternion: by its trace and its skew and symmetric parts."""
    squares = [value * value for value in q]
    norm = squares[0] + squares[1] + squares[2] + squares[3]
    if not norm.contains(1):
        return False
    for i, j, k in CYCLIC:
        diagonal = squares[0] + squares[i + 1] - squares[j + 1] - squares[k + 1]
        skew, symmetric = 2 * q[0] * q[i + 1], 2 * q[j + 1] * q[k + 1]
        if not (
            rows[i][i].overlaps(diagonal)
            and rows[k][j].overlaps(symmetric + skew)
            and rows[j][k].overlaps(symmetric - skew)
        ):
            return False
    return True


def _dot(weights: Sequence[int], values: Sequence[arb]) -> arb:
    total = arb(0)
    for weight, value in zip(weights, values, strict=True):
        if weight:
            total += weight * value
    return total


def _fractions(form: Sequence[int]) -> Form:
    return tuple(map(Fraction, form))


def _enclosures(poses: Sequence[Pose], exponent: int) -> list[list[arb]]:
    """Position (3), rotation (9) and quaternion (4) of each pose, as balls that are its intervals, exactly."""
    middles, radii = [], []
    for pose in poses:
        for interval in (*pose.box, *pose.quaternion):
            low, high = _in_cells(interval.lo, exponent), _in_cells(interval.hi, exponent)
            middles.append(low + high)
            radii.append(high - low)
    # Boxes are one or two cells wide: few balls around 0, made once each.
    balls = {radius: arb(0, radius) for radius in set(radii)}
    size = len(poses)
    whole = arb_mat(fmpz_mat(size, 16, middles)) + arb_mat(size, 16, [balls[radius] for radius in radii])
    rows: list[list[arb]] = (whole * arb(2) ** -(exponent + 1)).tolist()
    return rows


def _in_cells(value: Fraction, exponent: int) -> int:
    """The number times 2^exponent, of a number on that grid."""
    return value.numerator << exponent + 1 - value.denominator.bit_length()


def _enclosing(interval: Interval) -> arb:
    """A ball around an interval with rational ends."""
    return hull(interval.lo, interval.hi)

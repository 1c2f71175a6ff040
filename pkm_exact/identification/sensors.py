"""More sensors than actuators: when a linear method finds the pose, and which sensor tells poses apart.

The legs' sensors give linear equations W (C + R P - B) = d in the position C and the nine entries of R, P the platform
joint and W the projection to what is measured: u u^T for the plane in which a leg lies, 1 - v v^T for its line, 1 for
its point. With C eliminated the matrix of R is P_W; the linear method of chapter 7 of *Parallel Manipulators* (2008)
has one solution exactly if its rank is 9. What the method cannot do the constraints of R may do: that is a question
about poses, not about a rank.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Form, Vector, ordinary
from pkm_exact.errors import InputError
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.screws.exact_matrix import Row, null_space, rank
from pkm_exact.solution import Solution


@dataclass(frozen=True)
class Reading:
    """What the sensors of a leg measure of its platform joint.

    Attributes
    ----------
    joint : Vector
        In the platform's frame.
    rows : tuple of Vector
        Directions along which the joint's position is known: one if a plane is measured, two for a line, three for a
        point.
    """

    joint: Vector
    rows: tuple[Vector, ...]


def plane_reading(joint: Vector, normal: Vector) -> Reading:
    """One angle of a universal joint: the leg lies in a plane."""
    return Reading(joint, (normal,))


def line_reading(joint: Vector, direction: Vector) -> Reading:
    """Both angles: the platform joint lies on a line.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> reading = line_reading((one, zero, zero), (zero, zero, one))
    >>> [[int(x) for x in row] for row in reading.rows]
    [[1, 0, 0], [0, 1, 0]]
    """
    found = null_space([direction], 3)
    if len(found) != 2:
        raise InputError("direction: is 0; give one that is not")
    return Reading(joint, tuple((row[0], row[1], row[2]) for row in found))


def point_reading(joint: Vector) -> Reading:
    """Both angles and the length: the place of the platform joint."""
    one, zero = Fraction(1), Fraction(0)
    return Reading(joint, ((one, zero, zero), (zero, one, zero), (zero, zero, one)))


@dataclass(frozen=True)
class LinearMethod:
    """Whether the linear method has one solution.

    Attributes
    ----------
    readings : int
        Number of scalar measurements.
    position_rank : int
        Of the equations in the position alone; 3 if it can be eliminated.
    rank : int
        Of P_W: 9 if the rotation is determined.
    """

    readings: int
    position_rank: int
    rank: int

    @property
    def is_unique(self) -> bool:
        """Whether position and rotation are determined by linear equations alone."""
        return self.position_rank == 3 and self.rank == 9


def linear_method(readings: Sequence[Reading]) -> LinearMethod:
    """The rank of P_W, exactly.

    Examples
    --------
    >>> corners = [tuple(map(Fraction, c)) for c in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
    >>> linear_method([point_reading(c) for c in corners]), linear_method([point_reading(c) for c in corners[:3]]).rank
    (LinearMethod(readings=12, position_rank=3, rank=9), 6)
    """
    positions: list[Row] = []
    every: list[Row] = []
    for reading in readings:
        for row in reading.rows:
            positions.append(tuple(row))
            every.append((*row, *(x * p for x in row for p in reading.joint)))
    first = rank(positions, 3)
    return LinearMethod(len(every), first, rank(every, 12) - first)


@dataclass(frozen=True)
class SensorReport:
    """What a further sensor reads at each pose.

    Attributes
    ----------
    values : tuple of Interval
        Bounds of its value at each pose: a squared length, an offset, a product, up to a constant.
    confused : tuple of tuples of int
        For each pose the others, counted from 1, that the bounds do not tell from it.
    gap : Fraction
        Readings at different poses that are told apart differ by more than this.
    is_complete : bool
        Whether the poses are proved to be all.
    """

    values: tuple[Interval, ...]
    confused: tuple[tuple[int, ...], ...]
    gap: Fraction
    is_complete: bool

    @property
    def is_unique(self) -> bool:
        """Whether it is proved that the reading leaves one pose, whichever the robot stands in."""
        return self.is_complete and not any(self.confused)


def sensor_report(solution: Solution, sensor: Constraint) -> SensorReport:
    """Whether a sensor makes the forward kinematics of a solved problem unique.

    Parameters
    ----------
    solution : Solution
        All poses for the lengths that are measured already.
    sensor : Constraint
        What is measured besides: of one linear form, such as the distance of two points; its value does not matter.

    Raises
    ------
    InputError
        If the sensor is not one linear form on rigid motions.

    Examples
    --------
    >>> from pkm_exact import Distance, Robot
    >>> solution = Robot.load("models/3-rpr-merlet-p.toml").solve()
    >>> spring = Distance((Fraction(30), Fraction(0), Fraction(0)), (Fraction(0),) * 3, Fraction(1))
    >>> sensor_report(solution, spring).is_unique
    True
    """
    metric = solution.problem.metric
    forms = sensor.forms(metric)
    if len(forms) != 1 or sensor.squares(metric):
        raise InputError("sensor: not one linear form on rigid motions; give a distance, a plane or an angle")
    if any(g != 1 for g in metric):
        raise InputError("sensor: the problem's metric is not (1, 1, 1); give the robot in ordinary coordinates")
    form = tuple(ordinary(forms[0], [1, 1, 1]))
    values = [_value(form, pose) for pose in solution.poses]
    confused, gaps = [], []
    for k, one in enumerate(values):
        others = []
        for j, other in enumerate(values):
            distance = max(one.lo - other.hi, other.lo - one.hi)
            if j != k and distance <= 0:
                others.append(j + 1)
            elif j != k:
                gaps.append(distance)
        confused.append(tuple(others))
    complete = str(solution.claim) in ("complete", "inconsistent")
    return SensorReport(tuple(values), tuple(confused), min(gaps, default=Fraction(0)), complete)


def _value(form: Form, pose: Pose) -> Interval:
    """Bounds of a form at a pose: its box."""
    position, rotation = list(pose.position), [list(row) for row in pose.rotation]
    turned = [_sum([_times(rotation[i][j], position[i]) for i in range(3)]) for j in range(3)]
    square = _sum([_square(x) for x in position])
    entries = [square, *turned, *position, *(x for row in rotation for x in row), Interval(Fraction(1), Fraction(1))]
    return _sum([_scaled(x, factor) for x, factor in zip(entries, form, strict=True)])


def _sum(intervals: Sequence[Interval]) -> Interval:
    return Interval(sum((x.lo for x in intervals), Fraction(0)), sum((x.hi for x in intervals), Fraction(0)))


def _times(one: Interval, other: Interval) -> Interval:
    ends = [a * b for a in (one.lo, one.hi) for b in (other.lo, other.hi)]
    return Interval(min(ends), max(ends))


def _square(x: Interval) -> Interval:
    found = _times(x, x)
    return Interval(max(found.lo, Fraction(0)), found.hi)


def _scaled(x: Interval, factor: Fraction) -> Interval:
    ends = (x.lo * factor, x.hi * factor)
    return Interval(min(ends), max(ends))

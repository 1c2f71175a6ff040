"""Which limits of a robot a certified pose keeps: by comparisons that hold for every pose of its box.

Actuators are compared exactly: their values are rational. Cones, distances of legs and positions are enclosed over the
box, and a limit that the enclosure meets is undecided: the pose is on it, or nearer than the box is wide.

The distance of two legs is bounded from below by a direction n, from floating point, across which all points of one lie
on one side of those of the other (two convex sets are apart by max over n of min n.p - max n.q); from above by two of
their points.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from fractions import Fraction
from itertools import combinations
from math import isfinite, sqrt
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq

from pkm_exact.balls import ball, hull
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.limits import Cones, Limits, Pair
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot
from pkm_exact.precision import working_precision

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.pose import Pose

PRECISION = 256
"""Bits of the comparisons: more than boxes usually have."""

Point = Sequence[arb]


class LimitVerdict(StrEnum):
    """Whether a limit is kept."""

    YES = "yes"
    NO = "no"
    UNDECIDED = "undecided"


def together(verdicts: Iterable[LimitVerdict]) -> LimitVerdict:
    """Whether all are kept.

    Examples
    --------
    >>> print(together([LimitVerdict.YES, LimitVerdict.UNDECIDED]), together([]))
    undecided yes
    """
    found = set(verdicts)
    return next((v for v in (LimitVerdict.NO, LimitVerdict.UNDECIDED) if v in found), LimitVerdict.YES)


def in_words(verdicts: Mapping[str, LimitVerdict]) -> str:
    """Whether all limits are kept, and which are not, or not surely.

    Examples
    --------
    >>> in_words({"lengths": LimitVerdict.YES, "position": LimitVerdict.NO})
    'no (position)'
    """
    verdict = together(verdicts.values())
    if verdict is LimitVerdict.YES:
        return str(verdict)
    return f"{verdict} ({', '.join(name for name, found in verdicts.items() if found is verdict)})"


def limit_verdicts(
    machine: Machine, locked: Any, problem: ForwardProblem, poses: Sequence[Pose]
) -> list[dict[str, LimitVerdict]]:
    """For each pose, what is proved of every limit that the robot has; nothing at all of a robot without limits.

    Parameters
    ----------
    machine : Machine
    locked : Configuration or None
        Of cranks and slides, the joint values; None if the legs themselves are actuated.
    problem : ForwardProblem
        The one that the poses solve.
    poses : sequence of Pose

    Examples
    --------
    >>> from dataclasses import replace
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> limited = replace(robot, limits=Limits(lengths=((Fraction(1), Fraction(7)),) * 3))
    >>> solution = robot.solve()
    >>> [str(v["lengths"]) for v in limit_verdicts(limited, None, solution.problem, solution.poses)]
    ['no', 'no']
    """
    limits: Limits | None = machine.limits
    if limits is None:
        return [{} for _ in poses]
    with working_precision(PRECISION):
        actuators = _actuator_verdicts(limits, machine, locked, problem)
        sharing = _sharing(machine)
        return [actuators | _pose_verdicts(limits, problem, pose, sharing) for pose in poses]


def _actuator_verdicts(
    limits: Limits, machine: Machine, locked: Any, problem: ForwardProblem
) -> dict[str, LimitVerdict]:
    values = _actuator_values(machine, locked, problem)
    found = {}
    for name, holds in (("lengths", _within_squares), ("slides", _within), ("angles", _angle_within)):
        pairs: tuple[Pair, ...] = getattr(limits, name)
        if pairs:
            compare: Callable[[Any, Pair], LimitVerdict] = holds
            found[name] = together(compare(value, pair) for value, pair in zip(values[name], pairs, strict=True))
    return found


def _actuator_values(machine: Machine, locked: Any, problem: ForwardProblem) -> Mapping[str, Sequence[Any]]:
    """The values of the actuators, by the limit that each falls under: squared lengths, positions, (cos, sin)."""
    if isinstance(machine, Robot):
        if not machine.chains:
            return {"lengths": [leg.length_squared for leg in problem.distances]}
        return {"slides": locked.joint_values, "angles": locked.joint_values}
    if not isinstance(machine, Mechanism):
        return {}
    values = machine.values_of({found.name: found for found in problem.constraints}) or ()
    sorts = list(map(machine.sort_of, machine.actuated))
    return {
        sort: [value for own, value in zip(sorts, values, strict=True) if own == sort]
        for sort in ("lengths", "slides", "angles")
    }


def _within_squares(square: Fraction, pair: Pair) -> LimitVerdict:
    return _within(square, (pair[0] ** 2, pair[1] ** 2))


def _within(value: Fraction, pair: Pair) -> LimitVerdict:
    return LimitVerdict.YES if pair[0] <= value <= pair[1] else LimitVerdict.NO


def _angle_within(direction: tuple[Fraction, Fraction], pair: Pair) -> LimitVerdict:
    return turned_within(ball(direction[0]), ball(direction[1]), pair)


def turned_within(c: arb, s: arb, pair: Pair) -> LimitVerdict:
    """Whether an angle, given by multiples of cosine and sine, lies between two in degrees, whole turns aside."""
    least, greatest = pair
    if greatest - least >= 360:
        return LimitVerdict.YES

    def turned(angle: Fraction, towards: int) -> tuple[arb, arb]:
        """Cosine and sine of what the direction is beyond an angle, or short of it."""
        share = fmpq(angle.numerator, 180 * angle.denominator)
        a, b = arb.cos_pi_fmpq(share), arb.sin_pi_fmpq(share)
        return c * a + s * b, towards * (s * a - c * b)

    (cosine, after), (_, before) = turned(least, 1), turned(greatest, -1)
    if greatest - least > 180:
        return _any((at_least(after), at_least(before)))
    if least == greatest:
        return together((at_least(after), at_least(before), at_least(cosine)))
    if greatest - least == 180:
        return at_least(after)
    return together((at_least(after), at_least(before)))


def _any(verdicts: Iterable[LimitVerdict]) -> LimitVerdict:
    found = set(verdicts)
    return next((v for v in (LimitVerdict.YES, LimitVerdict.UNDECIDED) if v in found), LimitVerdict.NO)


def at_least(value: arb) -> LimitVerdict:
    """Whether an enclosed number is 0 or more."""
    return LimitVerdict.YES if value >= 0 else LimitVerdict.NO if value < 0 else LimitVerdict.UNDECIDED


def _pose_verdicts(
    limits: Limits, problem: ForwardProblem, pose: Pose, sharing: Callable[[Any, Any], bool]
) -> dict[str, LimitVerdict]:
    roots = [arb(g).sqrt() for g in problem.metric]
    position = [hull(c.lo, c.hi) for c in pose.position]
    rotation = [[hull(entry.lo, entry.hi) for entry in row] for row in pose.rotation]
    found = {}
    legs = [c for c in problem.constraints if isinstance(c, Distance)]
    feet = [_ordinary(leg.base, roots) for leg in legs]
    arms = [_turned(rotation, _ordinary(leg.platform, roots)) for leg in legs]
    tips = [[c + b for c, b in zip(position, arm, strict=True)] for arm in arms]
    if limits.base_cones is not None:
        axes = [_ordinary(axis, roots) for axis in limits.base_cones.axes]
        found["base_cones"] = _in_cones(limits.base_cones, axes, feet, tips)
    if limits.platform_cones is not None:
        axes = [_turned(rotation, _ordinary(axis, roots)) for axis in limits.platform_cones.axes]
        found["platform_cones"] = _in_cones(limits.platform_cones, axes, tips, feet)
    if limits.leg_distance is not None:
        found["leg_distance"] = are_apart(ball(limits.leg_distance), legs, feet, tips, sharing)
    if limits.position:
        sides = zip(position, roots, limits.position, strict=False)
        found["position"] = together(
            at_least(side) for c, root, (low, high) in sides for side in (c - ball(low) * root, ball(high) * root - c)
        )
    return found


def _ordinary(point: Vector, roots: Sequence[arb]) -> list[arb]:
    return [ball(x) * root for x, root in zip(point, roots, strict=True)]


def _turned(rotation: Sequence[Sequence[arb]], point: Point) -> list[arb]:
    return [_dot(row, point) for row in rotation]


def _dot(left: Point, right: Point) -> arb:
    total = arb(0)
    for a, b in zip(left, right, strict=True):
        total += a * b
    return total


def _minus(left: Point, right: Point) -> list[arb]:
    return [a - b for a, b in zip(left, right, strict=True)]


def _in_cones(cones: Cones, axes: Sequence[Point], here: Sequence[Point], there: Sequence[Point]) -> LimitVerdict:
    return together(
        in_cone(axis, _minus(end, start), angle)
        for axis, start, end, angle in zip(axes, here, there, cones.angles, strict=True)
    )


def in_cone(axis: Point, leg: Point, angle: Fraction) -> LimitVerdict:
    """Whether axis.leg >= cos(angle) |axis| |leg|."""
    cosine = arb.cos_pi_fmpq(fmpq(angle.numerator, 180 * angle.denominator))
    square = _dot(axis, axis) * _dot(leg, leg)
    size = square.sqrt() if square > 0 else arb(0).union(square.abs_upper().sqrt())
    return at_least(_dot(axis, leg) - cosine * size)


def _sharing(machine: Machine) -> Callable[[Any, Any], bool]:
    """Whether two legs of a machine share a joint: not if each stands on a slide or crank of its own, which meet."""
    drives = machine.drives if isinstance(machine, Mechanism) else ()
    own = {entry.name: entry for entry in machine.constraints} if isinstance(machine, Mechanism) else {}

    def movers(name: str) -> set[str]:
        return {
            drive.name for drive in drives for part in drive.parts if (part.constraint, part.field) == (name, "base")
        }

    def share_a_joint(leg: Any, other: Any) -> bool:
        if leg.platform == other.platform:
            return True
        if leg.base != other.base or (isinstance(machine, Robot) and machine.chains):
            return False
        first, second = movers(leg.name), movers(other.name)
        stand: Any = (own.get(leg.name, leg), own.get(other.name, other))
        return first == second and bool(stand[0].base == stand[1].base)

    return share_a_joint


def are_apart(
    least: arb,
    legs: Sequence[Any],
    feet: Sequence[Point],
    tips: Sequence[Point],
    share_a_joint: Callable[[Any, Any], bool],
) -> LimitVerdict:
    """Whether all legs that share no joint are at least that far apart, as segments."""
    segments = list(zip(legs, feet, tips, strict=True))
    return together(
        distance_verdict(least, (foot, tip), (other_foot, other_tip))
        for (leg, foot, tip), (other, other_foot, other_tip) in combinations(segments, 2)
        if not share_a_joint(leg, other)
    )


def distance_verdict(least: arb, one: tuple[Point, Point], other: tuple[Point, Point]) -> LimitVerdict:
    shares = nearest_shares(_floats(one), _floats(other))
    if shares is None:
        return LimitVerdict.UNDECIDED
    s, t = map(arb, shares)
    between = _minus(
        [a + s * (b - a) for a, b in zip(*one, strict=True)], [a + t * (b - a) for a, b in zip(*other, strict=True)]
    )
    direction = [arb(float(value.mid())) for value in between]
    square, norm = _dot(between, between), _dot(direction, direction)
    if square < least * least:
        return LimitVerdict.NO
    gaps = [_dot(direction, p) - _dot(direction, q) for p in one for q in other]
    if norm > 0 and all(gap >= 0 and gap * gap >= least * least * norm for gap in gaps):
        return LimitVerdict.YES
    return LimitVerdict.UNDECIDED


def _floats(segment: tuple[Point, Point]) -> tuple[list[float], list[float]]:
    first, second = ([float(value.mid()) for value in point] for point in segment)
    return first, second


def nearest_shares(
    one: tuple[Sequence[float], Sequence[float]], other: tuple[Sequence[float], Sequence[float]]
) -> tuple[float, float] | None:
    """How far along two segments their nearest points are, in floating point; None if it gets out of range.

    Examples
    --------
    >>> nearest_shares(((0, 0, 0), (2, 0, 0)), ((1, 1, -1), (1, 1, 3)))
    (0.5, 0.25)
    """
    u, v, w = ([b - a for a, b in zip(*pair, strict=True)] for pair in (one, other, (other[0], one[0])))
    uu, uv, vv, uw, vw = (_product(a, b) for a, b in ((u, u), (u, v), (v, v), (u, w), (v, w)))
    gram = uu * vv - uv * uv
    if not (isfinite(gram) and sqrt(uu * vv) > 0):
        return None
    s = _clamped((uv * vw - vv * uw) / gram) if gram > 1e-14 * uu * vv else 0.0
    t = _clamped((s * uv + vw) / vv)
    return _clamped((t * uv - uw) / uu), t


def _product(left: Sequence[float], right: Sequence[float]) -> float:
    return sum(a * b for a, b in zip(left, right, strict=True))


def _clamped(value: float) -> float:
    return min(1.0, max(0.0, value))

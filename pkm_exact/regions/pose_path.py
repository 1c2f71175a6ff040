"""Paths of poses, proved over every whole step: reachable, away from singularities, within limits.

On an interval of the path parameter the Jacobian J is enclosed with its slope (``jets``): with M near the inverse of J
in the middle, M J = M J_0 + (M J') h. If all of I - M J is of norm e < 1, J is regular all over the interval, with

    sigma_min >= (1 - e) / |M|,   |det J| >= (1 - e)^n / |det M|,   condition <= |J| |M| / (1 - e)

(norms of Frobenius and of spectra). Intervals are halved until that is so; where they get too short, a singularity is
there, or too near to be excluded. Rows of J are unit wrenches of the legs, moments divided by a length.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, Final

import numpy as np
from flint import arb, arb_mat

from pkm_exact.balls import ball, unit_matrix
from pkm_exact.errors import InputError
from pkm_exact.geometry.limits import Limits
from pkm_exact.poses.jacobian import largest_singular_value
from pkm_exact.poses.limit_checks import (
    LimitVerdict,
    are_apart,
    at_least,
    in_cone,
    together,
    turned_within,
)
from pkm_exact.precision import working_precision
from pkm_exact.regions.jets import Jet, constant, parameter
from pkm_exact.regions.region_legs import OnCrank, OnSlide, RegionLeg, RegionMachine

PRECISION: Final = 128
FINEST: Final = 24
"""Steps are not made shorter than 2^-24 of the way between two rows."""
_LIMITS_FINEST: Final = 10
_CONTRACTION: Final = 0.5

Row = tuple[Fraction, ...]


@dataclass(frozen=True)
class Place:
    """Somewhere on a path: after which row, from 0, and which parts of the way to the next one it lies between."""

    row: int
    low: Fraction
    high: Fraction


class PathRefusedError(InputError):
    """The path cannot be followed on."""

    def __init__(self, place: Place, reason: str) -> None:
        super().__init__(reason)
        self.place, self.reason = place, reason


@dataclass
class PathFacts:
    """What is proved along a path, as far as it is followed.

    Attributes
    ----------
    det_sign : int
        That of the Jacobian, all along.
    steps : int
    least_sigma, least_determinant, greatest_condition : pair of arb or None
        A bound that holds all along, and a bound that is met.
    limits : dict
        For each limit where it is broken or undecided first; nothing while it is kept.
    """

    det_sign: int = 0
    steps: int = 0
    least_sigma: tuple[arb, arb] | None = None
    least_determinant: tuple[arb, arb] | None = None
    greatest_condition: tuple[arb, arb] | None = None
    limits: dict[str, tuple[LimitVerdict, Place]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class _At:
    """A machine on an interval of the path: everything in ordinary coordinates."""

    position: list[Jet]
    rotation: list[list[Jet]]
    feet: list[list[Jet]]
    tips: list[list[Jet]]
    arms: list[list[Jet]]
    rods: list[list[Jet]]
    values: list[Any]


class PosePathProof:
    """Proves a path of poses of a robot.

    Parameters
    ----------
    machine : RegionMachine
    limits : Limits or None
    columns : tuple of str
        As in ``geometry.pose_path_reader``.
    rows : sequence of rows
    modes : tuple of int
        Working modes of the legs.
    length : Fraction
        Divides moments.
    """

    def __init__(
        self,
        machine: RegionMachine,
        limits: Limits | None,
        columns: tuple[str, ...],
        rows: Sequence[Row],
        modes: tuple[int, ...],
        length: Fraction,
    ) -> None:
        self._machine, self._limits, self._columns, self._rows, self._modes = machine, limits, columns, rows, modes
        self._length = length
        self.facts = PathFacts()

    def samples(self, on_step: Callable[[int, Fraction], None] | None = None) -> Iterator[tuple[int, list[arb], int]]:
        """For every row its number, the joint values and the sign of the determinant; the steps between are proved.

        Raises
        ------
        PathRefusedError
            Where a rod does not reach, or the Jacobian is not proved regular.
        """
        with working_precision(PRECISION):
            found = self._sample(0)
        yield 0, *found
        for row in range(len(self._rows) - 1):
            with working_precision(PRECISION):
                self._between(row, on_step)
                found = self._sample(row + 1)
            yield row + 1, *found

    def _sample(self, row: int) -> tuple[list[arb], int]:
        last = row == len(self._rows) - 1
        place = Place(row, Fraction(0), Fraction(0))
        try:
            at = self._at(row - 1 if last else row, Fraction(1 if last else 0), Fraction(0))
        except _OutOfReachError as error:
            raise PathRefusedError(place, str(error)) from None
        jacobian = self._jacobian(at)
        sign = _sign(jacobian[0].det()) if jacobian[0].nrows() == jacobian[0].ncols() else 0
        if not sign:
            raise PathRefusedError(place, "the pose is singular, or too near a singularity to be decided")
        self.facts.det_sign = self.facts.det_sign or sign
        return [self._joint_value(value) for value in at.values], sign

    def _joint_value(self, value: Any) -> arb:
        if isinstance(value, tuple):
            return arb.atan2(value[1].value, value[0].value) * 180 / arb.pi()
        found: arb = value.value
        return found

    def _between(self, row: int, on_step: Callable[[int, Fraction], None] | None) -> None:
        waiting = [(Fraction(0), Fraction(1), 0)]
        while waiting:
            low, high, depth = waiting.pop()
            middle, half = (low + high) / 2, (high - low) / 2
            reason = self._step(row, middle, half)
            if reason is None or (reason == "limits" and depth >= _LIMITS_FINEST):
                self._keep(row, low, high, middle, half)
                if on_step is not None:
                    on_step(row, high)
                continue
            if depth >= FINEST and reason != "limits":
                raise PathRefusedError(Place(row, low, high), reason)
            waiting += [(middle, high, depth + 1), (low, middle, depth + 1)]

    def _step(self, row: int, middle: Fraction, half: Fraction) -> str | None:
        """Why nothing is proved on an interval; None if all is."""
        try:
            at = self._at(row, middle, half)
        except _OutOfReachError as error:
            return str(error)
        jacobian = self._jacobian(at)
        if _contraction(*jacobian) is None:
            return "the determinant of the Jacobian cannot be bounded away from zero"
        broken = {name for name, (verdict, _) in self.facts.limits.items() if verdict is LimitVerdict.NO}
        undecided = {name for name, verdict in self._verdicts(at).items() if verdict is LimitVerdict.UNDECIDED}
        return "limits" if undecided - broken else None

    def _keep(self, row: int, low: Fraction, high: Fraction, middle: Fraction, half: Fraction) -> None:
        """What a proved step says of the path."""
        facts, at = self.facts, self._at(row, middle, half)
        facts.steps += 1
        for name, verdict in self._verdicts(at).items():
            known = facts.limits.get(name)
            first = known is None or (known[0] is LimitVerdict.UNDECIDED and verdict is LimitVerdict.NO)
            if first and verdict is not LimitVerdict.YES:
                facts.limits[name] = verdict, Place(row, low, high)
        middles, slopes, span = self._jacobian(at)
        found = _contraction(middles, slopes, span)
        if found is None:
            return
        share, inverse = found
        size, norm = largest_singular_value(middles), largest_singular_value(inverse)
        if size is None or norm is None:
            return
        slope = _frobenius(slopes) * span.rad()
        rest, dimension = 1 - share, middles.nrows()
        facts.least_sigma = _lesser(facts.least_sigma, rest / norm, 1 / norm * (1 + share))
        here = abs(middles.det())
        facts.least_determinant = _lesser(facts.least_determinant, rest**dimension / abs(inverse.det()), here)
        worst, seen = (size + slope) * norm / rest, size * norm / (1 + share)
        found_condition = facts.greatest_condition
        if found_condition is None:
            facts.greatest_condition = worst.upper(), seen.lower()
        else:
            facts.greatest_condition = found_condition[0].max(worst.upper()), found_condition[1].max(seen.lower())

    def _at(self, row: int, middle: Fraction, half: Fraction) -> _At:
        s = parameter(middle, half)
        before, after = self._rows[row], self._rows[row + 1]
        moving = {
            name: constant(ball(a), s) + s * ball(b - a) if a != b else constant(ball(a), s)
            for name, a, b in zip(self._columns, before, after, strict=True)
        }
        zero = constant(arb(0), s)
        position = [moving.get(name, zero) for name in ("x", "y", "z")]
        rotation = _rotation(moving, s)
        roots = [arb(g).sqrt() for g in self._machine.metric]
        feet, tips, arms, rods, values = [], [], [], [], []
        for leg, mode in zip(self._machine.legs, self._modes, strict=True):
            joint = [ball(x) * root for x, root in zip(leg.platform, roots, strict=True)]
            arm = [sum((entry * b for entry, b in zip(line, joint, strict=True)), zero) for line in rotation]
            tip = [c + b for c, b in zip(position, arm, strict=True)]
            base = [constant(ball(x) * root, s) for x, root in zip(leg.base, roots, strict=True)]
            foot, value = _lower_end(leg, mode, base, tip, roots)
            feet.append(foot)
            tips.append(tip)
            arms.append(arm)
            rods.append([t - f for t, f in zip(tip, foot, strict=True)])
            values.append(value)
        return _At(position, rotation, feet, tips, arms, rods, values)

    def _jacobian(self, at: _At) -> tuple[arb_mat, arb_mat, arb]:
        """J in the middle, its slopes, and the interval about the middle."""
        rows = []
        for rod, arm in zip(at.rods, at.arms, strict=True):
            size = _dot(rod, rod).root()
            unit = [x / size for x in rod]
            moment = [
                (arm[1] * unit[2] - arm[2] * unit[1]) * (1 / ball(self._length)),
                (arm[2] * unit[0] - arm[0] * unit[2]) * (1 / ball(self._length)),
                (arm[0] * unit[1] - arm[1] * unit[0]) * (1 / ball(self._length)),
            ]
            wrench = [*unit, *moment]
            rows.append([wrench[k] for k in self._machine.twist])
        half = at.position[0].half
        middles = arb_mat([[x.middle for x in line] for line in rows])
        return middles, arb_mat([[x.slope for x in line] for line in rows]), half

    def _verdicts(self, at: _At) -> dict[str, LimitVerdict]:
        limits = self._limits
        if limits is None:
            return {}
        found = {}
        for name in ("lengths", "slides", "angles"):
            pairs = getattr(limits, name)
            if pairs:
                values = [v for v, leg in zip(at.values, self._machine.legs, strict=True) if leg.reach is not None]
                reach = [leg.reach for leg in self._machine.legs if leg.reach is not None]
                found[name] = together(_within(v, pair) for v, pair in zip(values, reach, strict=True))
        roots = [arb(g).sqrt() for g in self._machine.metric]
        feet, tips = ([[x.value for x in point] for point in points] for points in (at.feet, at.tips))
        rods = [[x.value for x in rod] for rod in at.rods]
        if limits.base_cones is not None:
            axes = [[ball(x) * r for x, r in zip(axis, roots, strict=True)] for axis in limits.base_cones.axes]
            found["base_cones"] = together(
                in_cone(a, rod, angle) for a, rod, angle in zip(axes, rods, limits.base_cones.angles, strict=True)
            )
        if limits.platform_cones is not None:
            turned = [
                [
                    sum((e.value * ball(x) * r for e, x, r in zip(line, axis, roots, strict=True)), arb(0))
                    for line in at.rotation
                ]
                for axis in limits.platform_cones.axes
            ]
            found["platform_cones"] = together(
                in_cone(a, [-x for x in rod], angle)
                for a, rod, angle in zip(turned, rods, limits.platform_cones.angles, strict=True)
            )
        if limits.leg_distance is not None:
            found["leg_distance"] = are_apart(ball(limits.leg_distance), self._machine.legs, feet, tips)
        if limits.position:
            sides = zip(at.position, roots, limits.position, strict=False)
            found["position"] = together(
                at_least(side)
                for c, root, (low, high) in sides
                for side in (c.value - ball(low) * root, ball(high) * root - c.value)
            )
        return found


class _OutOfReachError(Exception):
    pass


def _within(value: Any, pair: tuple[Fraction, Fraction]) -> LimitVerdict:
    if isinstance(value, tuple):
        return turned_within(value[0].value, value[1].value, pair)
    return together((at_least(value.value - ball(pair[0])), at_least(ball(pair[1]) - value.value)))


def _lower_end(
    leg: RegionLeg, mode: int, base: list[Jet], tip: list[Jet], roots: Sequence[arb]
) -> tuple[list[Jet], Any]:
    """Where a leg or rod stands, and the joint value: a length, a position, or cosine and sine."""
    e = [t - b for t, b in zip(tip, base, strict=True)]
    if isinstance(leg.actuator, OnSlide):
        d = [constant(ball(x) * root, e[0]) for x, root in zip(leg.actuator.direction, roots, strict=True)]
        a, p = _dot(d, d), _dot(d, e)
        rest = _dot(e, e) - constant(ball(leg.actuator.rod_squared), a)
        q = (p + mode * _positive_root(p * p - a * rest, leg)) / a
        return [b + q * x for b, x in zip(base, d, strict=True)], q
    if isinstance(leg.actuator, OnCrank):
        crank = leg.actuator
        u = [constant(ball(x) * root, e[0]) for x, root in zip(crank.at_0, roots, strict=True)]
        v = [constant(ball(x) * root, e[0]) for x, root in zip(crank.at_90, roots, strict=True)]
        a, p = 2 * _dot(u, e), 2 * _dot(v, e)
        h = _dot(e, e) + _dot(u, u) - constant(ball(crank.rod_squared), a)
        share = arb(1) / crank.weight
        m = a * a + p * p * share
        y = _positive_root((m - h * h) * share, leg)
        cosine, sine = (a * h - mode * p * y) / m, (p * h * share + mode * a * y) / m
        foot = [b + cosine * x + sine * z for b, x, z in zip(base, u, v, strict=True)]
        return foot, (cosine, sine * arb(crank.weight).sqrt())
    return base, _dot(e, e).root()


def _positive_root(square: Jet, leg: RegionLeg) -> Jet:
    if not square.value > 0:
        raise _OutOfReachError(f"{leg.name} does not reach, or only just")
    return square.root()


def _dot(left: Sequence[Jet], right: Sequence[Jet]) -> Jet:
    return left[0] * right[0] + left[1] * right[1] + left[2] * right[2]


def _rotation(moving: dict[str, Jet], s: Jet) -> list[list[Jet]]:
    one, zero = constant(arb(1), s), constant(arb(0), s)
    if "q0" in moving:
        return _of_quaternion([moving[f"q{k}"] for k in range(4)])
    names = ("", "", "theta") if "theta" in moving else ("roll", "pitch", "yaw")
    rotation = [[one if i == j else zero for j in range(3)] for i in range(3)]
    for axis, name in enumerate(names):
        if name in moving:
            c, sine = moving[name].cos_sin_of_degrees()
            i, j = (axis + 1) % 3, (axis + 2) % 3
            first = [c * x - sine * y for x, y in zip(rotation[i], rotation[j], strict=True)]
            rotation[j] = [sine * x + c * y for x, y in zip(rotation[i], rotation[j], strict=True)]
            rotation[i] = first
    return rotation


def _of_quaternion(q: list[Jet]) -> list[list[Jet]]:
    norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    found: list[list[Jet]] = [[norm] * 3 for _ in range(3)]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        squares = [x * x for x in q]
        found[i][i] = (squares[0] + squares[1 + i] - squares[1 + j] - squares[1 + k]) / norm
        mixed, turn = q[1 + i] * q[1 + j], q[0] * q[1 + k]
        found[i][j], found[j][i] = 2 * (mixed - turn) / norm, 2 * (mixed + turn) / norm
    return found


def _contraction(middles: arb_mat, slopes: arb_mat, span: arb) -> tuple[arb, arb_mat] | None:
    """A bound of |I - M J| below 1, and M; None if there is none."""
    entries = [float(x.mid()) for x in middles.entries()]
    size = middles.nrows()
    if size != middles.ncols() or not np.isfinite(entries).all():
        return None
    try:
        inverse = np.linalg.inv(np.array(entries).reshape(size, size))
    except np.linalg.LinAlgError:
        return None
    if not np.isfinite(inverse).all():
        return None
    near = arb_mat(inverse.tolist())
    share = _frobenius(unit_matrix(size) - near * middles) + _frobenius(near * slopes) * span.rad()
    return (share.abs_upper(), near) if share < _CONTRACTION else None


def _frobenius(matrix: arb_mat) -> arb:
    total = arb(0)
    for entry in matrix.entries():
        total += abs(entry).abs_upper() ** 2
    return total.abs_upper().sqrt().abs_upper()


def _lesser(known: tuple[arb, arb] | None, certain: arb, seen: arb) -> tuple[arb, arb]:
    if known is None:
        return certain.lower(), seen.upper()
    return known[0].min(certain.lower()), known[1].min(seen.upper())


def _sign(value: arb) -> int:
    return 1 if value > 0 else -1 if value < 0 else 0

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
from functools import reduce
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
from pkm_exact.regions.jets import constant, parameter
from pkm_exact.regions.leg_distances import share_a_joint
from pkm_exact.regions.machine_on_path import MachineOnPath, OutOfReachError, machine_on_path
from pkm_exact.regions.region_legs import RegionMachine

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
        except OutOfReachError as error:
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
        except OutOfReachError as error:
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
        size, norm = spectral_norm(middles), spectral_norm(inverse)
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

    def _at(self, row: int, middle: Fraction, half: Fraction) -> MachineOnPath:
        s = parameter(middle, half)
        moving = {
            name: constant(ball(a), s) + s * ball(b - a) if a != b else constant(ball(a), s)
            for name, a, b in zip(self._columns, self._rows[row], self._rows[row + 1], strict=True)
        }
        return machine_on_path(self._machine, self._modes, moving, s)

    def _jacobian(self, at: MachineOnPath) -> tuple[arb_mat, arb_mat, arb]:
        """J in the middle, its slopes, and the interval about the middle."""
        rows = at.jacobian(self._machine.twist, self._length)
        middles = arb_mat([[x.middle for x in line] for line in rows])
        return middles, arb_mat([[x.slope for x in line] for line in rows]), at.position[0].half

    def _verdicts(self, at: MachineOnPath) -> dict[str, LimitVerdict]:
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
            found["leg_distance"] = are_apart(ball(limits.leg_distance), self._machine.legs, feet, tips, share_a_joint)
        if limits.position:
            sides = zip(at.position, roots, limits.position, strict=False)
            found["position"] = together(
                at_least(side)
                for c, root, (low, high) in sides
                for side in (c.value - ball(low) * root, ball(high) * root - c.value)
            )
        return found


def _within(value: Any, pair: tuple[Fraction, Fraction]) -> LimitVerdict:
    if isinstance(value, tuple):
        return turned_within(value[0].value, value[1].value, pair)
    return together((at_least(value.value - ball(pair[0])), at_least(ball(pair[1]) - value.value)))


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


def spectral_norm(matrix: arb_mat) -> arb:
    """An enclosure of the largest singular value: roughly, where it is not computed well."""
    found = largest_singular_value(matrix)
    if found is not None:
        return found
    return reduce(arb.max, (abs(entry).abs_lower() for entry in matrix.entries())).union(_frobenius(matrix))


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

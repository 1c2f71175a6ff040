"""A machine whose pose moves along a path: where its legs stand, as functions of the path parameter on an interval.

Rod of a slide B + q d and of a crank B + c u + s v: q, c and s solve |T - foot|^2 = rod^2, T the joint of the platform.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import arb

from pkm_exact.balls import ball
from pkm_exact.regions.jets import Jet, constant
from pkm_exact.regions.region_legs import OnCrank, OnSlide, RegionLeg, RegionMachine


class OutOfReachError(Exception):
    """A rod does not reach its actuator, or that is not decided."""


@dataclass(frozen=True, eq=False)
class MachineOnPath:
    """A machine on an interval of a path: functions of its parameter, in ordinary coordinates.

    Attributes
    ----------
    position : list of 3 Jet
    rotation : 3 x 3 list of Jet
    feet, tips : list of points
        Lower and upper ends of legs or rods.
    arms, rods : list of vectors
        From the platform's origin to the tips, and from the feet to the tips.
    values : list
        Joint values: lengths, positions, or pairs of cosine and sine.
    """

    position: list[Jet]
    rotation: list[list[Jet]]
    feet: list[list[Jet]]
    tips: list[list[Jet]]
    arms: list[list[Jet]]
    rods: list[list[Jet]]
    values: list[Any]

    def jacobian(self, twist: Sequence[int], length: Fraction) -> list[list[Jet]]:
        """Unit wrenches of the legs as rows, moments divided by a length; of (f, m) the columns of a twist."""
        rows = []
        for rod, arm in zip(self.rods, self.arms, strict=True):
            size = _dot(rod, rod).root()
            unit = [x / size for x in rod]
            moment = [
                (arm[1] * unit[2] - arm[2] * unit[1]) * (1 / ball(length)),
                (arm[2] * unit[0] - arm[0] * unit[2]) * (1 / ball(length)),
                (arm[0] * unit[1] - arm[1] * unit[0]) * (1 / ball(length)),
            ]
            wrench = [*unit, *moment]
            rows.append([wrench[k] for k in twist])
        return rows


def machine_on_path(machine: RegionMachine, modes: Sequence[int], moving: Mapping[str, Jet], s: Jet) -> MachineOnPath:
    """The machine at poses whose coordinates are functions of s; those that are not named are 0.

    Parameters
    ----------
    machine : RegionMachine
    modes : sequence of int
        Working modes of the legs.
    moving : mapping from columns, as in ``geometry.pose_path_reader``, to Jet
    s : Jet
        The parameter of the path.

    Raises
    ------
    OutOfReachError
        If a rod does not reach, or only just.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> from pkm_exact.regions.jets import parameter
    >>> from pkm_exact.regions.region_legs import region_machine
    >>> robot = region_machine(read_robot("models/3-rpr-merlet-p.toml"))
    >>> s = parameter(Fraction(1), Fraction(1, 8))
    >>> at = machine_on_path(robot, (1, 1, 1), {"x": s + s + s, "y": s + s + s + s}, s)
    >>> at.values[0].middle, at.values[0].slope.contains(5)
    (5.00000000000000, True)
    """
    zero = constant(arb(0), s)
    position = [moving.get(name, zero) for name in ("x", "y", "z")]
    rotation = rotation_on_path(moving, s)
    roots = [arb(g).sqrt() for g in machine.metric]
    feet, tips, arms, rods, values = [], [], [], [], []
    for leg, mode in zip(machine.legs, modes, strict=True):
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
    return MachineOnPath(position, rotation, feet, tips, arms, rods, values)


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
        raise OutOfReachError(f"{leg.name} does not reach, or only just")
    return square.root()


def _dot(left: Sequence[Jet], right: Sequence[Jet]) -> Jet:
    return left[0] * right[0] + left[1] * right[1] + left[2] * right[2]


def rotation_on_path(moving: Mapping[str, Jet], s: Jet) -> list[list[Jet]]:
    """The rotation of a pose whose coordinates are functions of s, as in ``machine_on_path``."""
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

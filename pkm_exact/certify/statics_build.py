"""Certificates of what a machine of legs can do at an exact pose.

The format is described in ``docs/certificates-statics.md``; its schema is ``statics-certificate-1.schema.json`` in this
folder.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import sealed
from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot
from pkm_exact.polytopes.rationals import as_fraction, rational_matrix
from pkm_exact.polytopes.slabs import Slabs, outer_sides
from pkm_exact.radicals import RootSum
from pkm_exact.statics.capability import wrench_zonotope
from pkm_exact.statics.measures import Measures, RefusedError

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.roots.interval import Interval
    from pkm_exact.statics.pose_rows import PoseRows

FORMAT: Final = "pkm_exact statics certificate"
VERSION: Final = 1
MOST_LEGS: Final = 12
_BITS: Final = 64
_SHRINK: Final = 1 - Fraction(1, 1 << 60)
NEARLY: Final = 1 - Fraction(1, 10**12)


def statics_certificate(machine: Machine, measures: Measures) -> dict[str, Any]:
    """The certificate of a machine's polytopes, ellipsoid and singular values, as far as limits are known.

    Raises
    ------
    InputError
        If the pose is not exact, or the machine is not one of legs whose lengths are actuated.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> at = robot.at({"position": [5, "9/2"], "half_tangent": "1/3"})
    >>> content = statics_certificate(robot, at.measures(speeds=1, forces=1, length=3))
    >>> len(content["velocity_polytope"]["vertices"]), len(content["wrench_polytope"]["facets"])
    (8, 6)
    """
    at = measures.freedom.at
    legs = [{"base": _texts(base), "platform": _texts(platform)} for base, platform in _legs(machine, at)]
    rows = [[Fraction(x) / 2 for x in row.wrench] for row in at.exact_rows or ()]
    squares = [equation.rates[0].value_squared or Fraction(0) for equation in at.equations]
    return sealed(exact_content(VERSION, measures, legs, Driven(rows, squares)))


@dataclass(frozen=True)
class Driven:
    """Rows R_i of the legs in rational coordinates and the squares of what they are divided by, l_i."""

    rows: list[list[Fraction]]
    squares: list[Fraction]


def exact_content(
    version: int, measures: Measures, legs: Sequence[Mapping[str, Any]], driven: Driven
) -> dict[str, Any]:
    """The content of a certificate of an exact pose, without its digest."""
    at, limits = measures.freedom.at, measures.limits
    ends = limits.force_ends
    return {
        "format": FORMAT,
        "version": version,
        "name": at.name,
        "unit": at.unit,
        "metric": list(map(str, at.metric)),
        "freedoms": list(at.motion.twist),
        "position": _texts(at.position),
        "rotation": [_texts(row) for row in at.rotation],
        "legs": list(legs),
        "speeds": None if limits.speeds is None else _texts(limits.speeds),
        "forces": None if ends is None else [_texts(pair) for pair in zip(*ends, strict=True)],
        "length": None if limits.length is None else str(limits.length),
        "velocity_polytope": None if limits.speeds is None else _velocity(driven, limits.speeds),
        "wrench_polytope": None if ends is None else _wrench(measures, driven.rows, *ends),
        "ellipsoid": None if limits.speeds is None else _ellipsoid(measures, driven, limits.speeds),
        "indices": _indices(measures),
    }


def is_for_legs_alone(machine: Machine, at: PoseRows) -> bool:
    """Whether this version has a certificate: of an exact pose, and legs whose lengths are actuated."""
    return _joints(machine, at) is not None


def _legs(machine: Machine, at: PoseRows) -> list[tuple[Any, Any]]:
    found = _joints(machine, at)
    if found is None:
        raise InputError("certificate: is for exact poses of machines of legs whose lengths are actuated, 12 at most")
    return found


def _joints(machine: Machine, at: PoseRows) -> list[tuple[Any, Any]] | None:
    if not at.is_exact or not 1 <= len(at.held.actuators) <= MOST_LEGS or at.held.structural:
        return None
    if isinstance(machine, Robot) and not machine.chains:
        return list(zip(machine.base_joints, machine.platform_joints, strict=True))
    if isinstance(machine, Mechanism) and not machine.drives:
        legs = [found for found in machine.constraints if isinstance(found, Distance)]
        if len(legs) == len(machine.constraints):
            return [(leg.base, leg.platform) for leg in legs]
    return None


def _texts(values: Sequence[Any]) -> list[str]:
    return [str(Fraction(value)) for value in values]


def _velocity(driven: Driven, speeds: Sequence[Fraction]) -> dict[str, Any]:
    rows, squares = driven.rows, driven.squares
    bounds = []
    for speed, square in zip(speeds, squares, strict=True):
        bound = speed * RootSum.root(square)
        bounds.append(bound if bound.rational is None else bound.rational)
    slabs = Slabs(tuple(map(tuple, rows)), tuple(-1 * x for x in bounds), tuple(bounds))
    keys = sorted(slabs.corners())
    return {
        "facets": [[index + 1, side] for index, side in sorted(outer_sides(keys))],
        "vertices": [_vertex(key, rows, speeds) for key in keys],
    }


def _vertex(key: Sequence[tuple[int, int]], rows: list[list[Fraction]], speeds: Sequence[Fraction]) -> list[list[str]]:
    """The coordinates of a vertex as coefficients of the lengths, by independent legs whose sides it is on."""
    chosen: list[tuple[int, int]] = []
    for index, side in key:
        if rational_matrix([rows[k] for k, _ in chosen] + [rows[index]]).rank() > len(chosen):
            chosen.append((index, side))
    inverse = rational_matrix([rows[k] for k, _ in chosen]).inv()
    found = []
    for j in range(len(chosen)):
        line = [Fraction(0)] * len(rows)
        for place, (k, side) in enumerate(chosen):
            line[k] = as_fraction(inverse[j, place]) * side * speeds[k]
        found.append(_texts(line))
    return found


def _wrench(
    measures: Measures, rows: Sequence[Sequence[Fraction]], low: Sequence[Fraction], high: Sequence[Fraction]
) -> dict[str, Any] | None:
    facets = []
    zonotope = wrench_zonotope(measures.freedom, low, high)
    if zonotope is None or not all(map(any, rows)):
        return None  # not exact, or a leg exerts nothing: its force is at no end of its range at a vertex
    try:
        planes = zonotope.hyperplanes
    except PkmExactError:
        return None  # no interior: nothing to be certified
    for normal, _ in planes:
        for side in (1, -1):
            outer = [side * x for x in normal]
            values = [sum((a * b for a, b in zip(outer, row, strict=True)), Fraction(0)) for row in rows]
            reach = [max(value * lo, value * hi) for value, lo, hi in zip(values, low, high, strict=True)]
            facets.append({"normal": _texts(outer), "offset": _texts(reach)})
    return {"facets": facets, "vertices": [list(cell) for cell in zonotope.cells]}


def _ellipsoid(measures: Measures, driven: Driven, speeds: Sequence[Fraction]) -> dict[str, Any] | None:
    """A rational ellipsoid in the polytope that the weights prove to be nearly the largest; None if they do not."""
    from pkm_exact.statics.largest_ellipsoid import largest_ellipsoid

    at, rows = measures.freedom.at, driven.rows
    bounds = [speed * speed * square for speed, square in zip(speeds, driven.squares, strict=True)]
    try:
        found = largest_ellipsoid(measures.freedom.scaled(measures.limits.length, speeds), at.twist)
    except PkmExactError:
        return None
    weights = short_weights(found.weights)
    n = len(rows[0])
    scaled = [[n * w * x / b for x in row] for w, row, b in zip(weights, rows, bounds, strict=True)]
    dual = rational_matrix(rows).transpose() * rational_matrix(scaled)
    if dual.det() == 0:
        return None
    inverse = dual.inv()
    reach = rational_matrix(rows) * inverse * rational_matrix(rows).transpose()
    # A leg that the platform's motions leave as long as it is bounds nothing.
    room = min(bound / as_fraction(reach[k, k]) for k, bound in enumerate(bounds) if reach[k, k])
    exact = [[min(room, Fraction(1)) * _SHRINK * as_fraction(inverse[i, j]) for j in range(n)] for i in range(n)]
    matrix = [[_rounded(exact[i][j], exact[i][i] * exact[j][j]) for j in range(n)] for i in range(n)]
    table = rational_matrix(matrix)
    reach = rational_matrix(rows) * table * rational_matrix(rows).transpose()
    inside = all(as_fraction(reach[k, k]) <= bound for k, bound in enumerate(bounds))
    if not inside or as_fraction(table.det() * dual.det()) < NEARLY:
        return None
    return {"weights": _texts(weights), "matrix": [_texts(row) for row in matrix]}


def short_weights(weights: Sequence[Fraction]) -> list[Fraction]:
    """The weights to 64 bits, with sum 1."""
    if all(weight.denominator < 1 << _BITS for weight in weights):
        return list(weights)
    found = [Fraction((weight.numerator << _BITS) // weight.denominator, 1 << _BITS) for weight in weights]
    largest = max(range(len(found)), key=lambda k: found[k])
    found[largest] += 1 - sum(found)
    return found


def _rounded(value: Fraction, scale_squared: Fraction) -> Fraction:
    """The value to 2^-80 of the root of a number, or better."""
    root = isqrt((scale_squared.numerator << 200) // scale_squared.denominator)
    shift = 80 - root.bit_length() + 100
    grid = Fraction(2) ** shift
    return Fraction(round(value * grid)) / grid


def _indices(measures: Measures) -> dict[str, Any] | None:
    from pkm_exact.statics.index_rows import enclosed_indices

    try:
        measures.require_norms()
    except RefusedError:
        return None
    values, _ = enclosed_indices(measures)
    if "sigma_min" not in values or values["sigma_min"].lo <= 0:
        return None
    least, greatest = (_widened(values[name]) for name in ("sigma_min", "sigma_max"))
    condition = _dyadic(greatest[0] / least[1], up=False), _dyadic(greatest[1] / least[0], up=True)
    return {"sigma_min": _texts(least), "sigma_max": _texts(greatest), "condition": _texts(condition)}


def _widened(value: Interval) -> tuple[Fraction, Fraction]:
    """Bounds with few digits, strictly outside."""
    slack = Fraction(1, 1 << 44)
    return _dyadic(value.lo * (1 - slack), up=False), _dyadic(value.hi * (1 + slack), up=True)


def _dyadic(value: Fraction, *, up: bool) -> Fraction:
    """A number of 48 bits below or above one that is positive."""
    shift = 48 - value.numerator.bit_length() + value.denominator.bit_length()
    scaled = value * Fraction(2) ** shift
    whole = -((-scaled.numerator) // scaled.denominator) if up else scaled.numerator // scaled.denominator
    return whole / Fraction(2) ** shift

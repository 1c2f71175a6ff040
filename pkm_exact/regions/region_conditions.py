"""What is asked of every pose of a region, as a formula (``docs/regions.md`` has the proofs)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.form import rational_wrench, value_at
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.limits import Cones
from pkm_exact.regions.chart import POSITIONS, Chart, Polynomial, PosePolynomials, moved, pose_polynomials, rational
from pkm_exact.regions.formula import All, Atom, Formula, Sign, Some
from pkm_exact.regions.near_angles import squared_cosines, turn_directions
from pkm_exact.regions.placed_legs import PlacedLeg, placed_leg, product, without_squares
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, OwnLength, RegionMachine

CONDITIONS: Final = ("reachable", "limits", "no_type_1", "no_type_2")
"""In the order of certificates. That no constraint is singular is part of the last."""


@dataclass(frozen=True)
class Conditions:
    """What is asked of a pose.

    Attributes
    ----------
    asked : tuple of str
        Some of ``CONDITIONS``, in their order.
    modes : tuple of int
        For each leg the sign of its working mode; 0 where none is named.
    """

    asked: tuple[str, ...]
    modes: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Asked:
    """A formula, and the polynomials whose roots are variables of it.

    Attributes
    ----------
    formula : Formula
    roots : tuple of polynomials
        The D_i, in the order of the legs that have one.
    determinant : polynomial or None
        Of the constraints, if it is asked for: its sign separates poses.
    pose : PosePolynomials
    """

    formula: Formula
    roots: tuple[Polynomial, ...]
    determinant: Polynomial | None
    pose: PosePolynomials


def asked_of(machine: RegionMachine, chart: Chart, conditions: Conditions) -> Asked:
    """The formula of the conditions on a chart.

    Raises
    ------
    InputError
        If the structure of the robot does not allow all poses of the chart, or working modes are needed and not named.
    """
    pose, placed = placed_legs(machine, chart, conditions)
    _require_modes(machine, conditions)
    parts: list[Formula] = []
    parts += [Atom(f"{leg.leg.name} reaches", leg.root) for leg in placed if leg.root is not None]
    if "limits" in conditions.asked:
        parts += [part for leg in placed for part in _reach(leg)]
        parts += _cones(machine, placed, pose) + _position(machine, pose)
    if "no_type_1" in conditions.asked:
        parts += [_keeps_its_mode(leg) for leg in placed]
    determinant = None
    if "no_type_2" in conditions.asked:
        determinant = constraint_determinant(machine, pose, placed)
        parts.append(Atom("the determinant of the constraints", determinant, Sign.NOT_ZERO))
    roots = tuple(leg.root for leg in placed if leg.root is not None)
    return Asked(All(tuple(parts)), roots, determinant, pose)


def placed_legs(
    machine: RegionMachine, chart: Chart, conditions: Conditions
) -> tuple[PosePolynomials, list[PlacedLeg]]:
    """The poses of a chart, which the structure allows, and the legs there."""
    driven = [k for k, leg in enumerate(machine.legs) if isinstance(leg.actuator, OnSlide | OnCrank)]
    pose = pose_polynomials(chart, machine.metric, tuple(f"s{k + 1}" for k in driven))
    for form in machine.forms:
        if not form_at(form, pose, machine.metric).is_zero():
            raise InputError(
                "region: its poses are not all among those that the joints of the mechanism allow; fix the coordinates "
                "that these fix"
            )
    places = {k: len(chart.variables) + i for i, k in enumerate(driven)}
    placed = [
        placed_leg(leg, pose, machine.metric, conditions.modes[k] or 1, places.get(k, -1))
        for k, leg in enumerate(machine.legs)
    ]
    return pose, placed


def constraint_rows(
    machine: RegionMachine, chart: Chart, conditions: Conditions
) -> tuple[PosePolynomials, list[list[Polynomial]]]:
    """The wrenches of legs and structure on a chart, on the freedoms of the motion group.

    Raises
    ------
    InputError
        As ``asked_of``.
    """
    pose, placed = placed_legs(machine, chart, conditions)
    _require_modes(machine, replace(conditions, asked=("no_type_2",)))
    return pose, _rows(machine, pose, placed)


def form_at(form: Sequence[Fraction], pose: PosePolynomials, metric: Metric) -> Polynomial:
    """N^2 times the value of a linear form."""
    n, values = pose.norm, [pose.constant(value) for value in form]
    scaled = [*values[:4], *(n * value for value in values[4:16]), n * n * values[16]]
    exact: Any = [rational(g) for g in metric]
    found: Polynomial = value_at(scaled, pose.position, pose.rotation, exact)
    return found


def _require_modes(machine: RegionMachine, conditions: Conditions) -> None:
    for k, leg in enumerate(machine.legs):
        if isinstance(leg.actuator, OwnLength | OnHinge) or conditions.modes[k]:
            continue
        if "no_type_2" in conditions.asked or ("limits" in conditions.asked and leg.reach is not None):
            raise InputError(
                f"conditions.working_modes: {leg.name} has two working modes, and what is asked depends on them; give "
                'one sign for each leg, such as ["+", "+", "-"]'
            )


def _keeps_its_mode(leg: PlacedLeg) -> Atom:
    if leg.root is None:
        return Atom(f"{leg.leg.name} has a length", leg.value[0], Sign.POSITIVE)
    return Atom(f"{leg.leg.name} keeps its working mode", leg.root, Sign.POSITIVE)


def _reach(leg: PlacedLeg) -> list[Formula]:
    if leg.leg.reach is None:
        return []
    low, high = leg.leg.reach
    if isinstance(leg.leg.actuator, OnCrank):
        return [_turned(leg, low, high)]
    value, unit = leg.value
    if not isinstance(leg.leg.actuator, OnSlide):
        low, high = low * low, high * high
    name = leg.leg.name
    return [
        Atom(f"{name} above its least value", value - rational(low) * unit),
        Atom(f"{name} below its greatest value", rational(high) * unit - value),
    ]


def _turned(leg: PlacedLeg, low: Fraction, high: Fraction) -> Formula:
    """Whether a crank's angle is between two, in degrees: its direction left of one and right of the other."""
    cosine, sine = leg.value
    parts = []
    for angle, side, what in ((low, 1, "beyond its least angle"), (high, -1, "short of its greatest angle")):
        tight, loose = (side * (rational(c) * sine - rational(s) * cosine) for c, s in turn_directions(angle, side))
        parts.append(Atom(f"{leg.leg.name} {what}", tight, loose=loose))
    if high - low >= 360:
        return All(())
    if low == high:
        tight, loose = (rational(c) * cosine + rational(s) * sine for c, s in turn_directions(low, 1))
        parts.append(Atom(f"{leg.leg.name} at its angle", tight, loose=loose))
    return Some(tuple(parts)) if high - low > 180 else All(tuple(parts))


def _cones(machine: RegionMachine, placed: Sequence[PlacedLeg], pose: PosePolynomials) -> list[Formula]:
    found: list[Formula] = []
    for k, leg in enumerate(placed):
        if machine.base_cones is not None:
            axis: list[Any] = [pose.constant(x) for x in machine.base_cones.axes[k]]
            found.append(_cone(machine, machine.base_cones, k, leg, pose, axis, leg.rod, "base"))
        if machine.platform_cones is not None:
            tip = moved(pose, machine.platform_cones.axes[k])
            axis = [p - c for p, c in zip(tip, pose.position, strict=True)]
            rod = [-x for x in leg.rod]
            found.append(_cone(machine, machine.platform_cones, k, leg, pose, axis, rod, "platform"))
    return found


def _cone(
    machine: RegionMachine,
    cones: Cones,
    k: int,
    leg: PlacedLeg,
    pose: PosePolynomials,
    axis: Sequence[Any],
    rod: Sequence[Any],
    side: str,
) -> Formula:
    """Whether axis.rod >= cos |axis| |rod|, squared on the side on which the product has the cosine's sign."""
    g, name = machine.metric, f"{leg.leg.name} in its cone of the {side}"
    along = product(g, axis, rod)
    square = without_squares(along * along, leg, pose)
    size = product(g, axis, axis) * without_squares(product(g, rod, rod), leg, pose)
    if size.is_zero():
        raise InputError(f"{name}: the leg has no direction at any pose of the region; leave limits out, or that leg")
    tight, loose = (square - rational(c) * size for c in squared_cosines(cones.angles[k]))
    if cones.angles[k] <= 90:
        return All((Atom(name, along), Atom(name, tight, loose=loose)))
    return Some((Atom(name, along), Atom(name, -tight, loose=-loose)))


def _position(machine: RegionMachine, pose: PosePolynomials) -> list[Formula]:
    found: list[Formula] = []
    for axis, c, (low, high) in zip(POSITIONS, pose.position, machine.position, strict=False):
        found += [
            Atom(f"{axis} above its least value", c - rational(low) * pose.norm),
            Atom(f"{axis} below its greatest value", rational(high) * pose.norm - c),
        ]
    return found


def constraint_determinant(machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg]) -> Polynomial:
    """That of the wrenches of legs and structure, on the freedoms of the motion group.

    Raises
    ------
    InputError
        If there are not as many as freedoms.
    """
    rows = _rows(machine, pose, placed)
    if len(rows) != len(machine.twist):
        raise InputError(
            f"conditions.no_type_2: {len(rows)} equations for {len(machine.twist)} freedoms; regions know "
            "this condition where there are as many"
        )
    return determinant(rows, pose.constant(0))


def _rows(machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg]) -> list[list[Polynomial]]:
    g1, g2, g3 = machine.metric
    rows = []
    for leg in placed:
        k, b = leg.rod, leg.arm
        moment = [
            g2 * g3 * (b[1] * k[2] - b[2] * k[1]),
            g3 * g1 * (b[2] * k[0] - b[0] * k[2]),
            g1 * g2 * (b[0] * k[1] - b[1] * k[0]),
        ]
        wrench = [pose.norm * g * x for g, x in zip(machine.metric, k, strict=True)] + moment
        rows.append([wrench[j] for j in machine.twist])
    return rows + [_structural(form, machine, pose) for form in machine.forms]


def _structural(form: Sequence[Fraction], machine: RegionMachine, pose: PosePolynomials) -> list[Polynomial]:
    """The wrench of a linear form: its force times N^2, its moment likewise."""
    n, values = pose.norm, [pose.constant(value) for value in form]
    metric: Any = [rational(g) for g in machine.metric]
    scaled = [*values[:4], *(n * value for value in values[4:16]), values[16]]
    found = rational_wrench(scaled, pose.position, pose.rotation, metric)
    wrench = [*(n * x for x in found[:3]), *found[3:]]
    return [wrench[j] for j in machine.twist]


def determinant(rows: Sequence[Sequence[Polynomial]], zero: Polynomial) -> Polynomial:
    """The determinant of a matrix of polynomials, by minors of its first rows: no division.

    Examples
    --------
    >>> from flint import Ordering, fmpq, fmpq_mpoly_ctx
    >>> ring = fmpq_mpoly_ctx.get(("x",), Ordering.lex)
    >>> (x,) = ring.gens()
    >>> print(determinant([[x, x + 1], [x - 1, x]], ring.constant(fmpq(0))))
    1
    """
    minors: dict[int, Polynomial] = {0: zero + 1}
    for row in rows:
        following: dict[int, Polynomial] = {}
        for columns, minor in minors.items():
            for k, entry in enumerate(row):
                if columns >> k & 1 or entry.is_zero():
                    continue
                term = -entry * minor if (columns >> k).bit_count() % 2 else entry * minor
                wider = columns | 1 << k
                following[wider] = following[wider] + term if wider in following else term
        minors = following
    return minors.get((1 << len(rows)) - 1, zero)

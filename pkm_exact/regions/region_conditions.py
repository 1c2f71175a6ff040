"""What is asked of every pose of a region, as a formula (``docs/regions.md`` has the proofs)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.form import value_at
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.limits import Cones
from pkm_exact.regions.chart import POSITIONS, Chart, Polynomial, PosePolynomials, moved, pose_polynomials, rational
from pkm_exact.regions.design_parameters import varied_legs
from pkm_exact.regions.formula import All, Atom, Formula, Regular, Sign, Some
from pkm_exact.regions.index_quotients import force_polynomials, index_square
from pkm_exact.regions.leg_distances import legs_apart
from pkm_exact.regions.near_angles import BESIDE, squared_cosines, turn_directions
from pkm_exact.regions.placed_legs import PlacedLeg, placed_leg, without_squares
from pkm_exact.regions.region_determinants import determinant, structural_rows, wrench_rows
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, OwnLength, RegionMachine, product
from pkm_exact.regions.region_matrices import determinant_size, has_matrix, require_square, smaller_rows

CONDITIONS: Final = ("reachable", "limits", "no_type_1", "no_type_2")
"""In the order of certificates. That no constraint is singular is part of the last."""


_DETERMINANT: Final = "the determinant of the constraints"


@dataclass(frozen=True)
class Conditions:
    """What is asked of a pose.

    Attributes
    ----------
    asked : tuple of str
        Some of ``CONDITIONS``, in their order.
    modes : tuple of int
        For each leg the sign of its working mode; 0 where none is named.
    indices : tuple of pairs of str and Fraction
        Indices that are greater than a bound.
    length : Fraction or None
        By which turns are multiplied in them.
    load : tuple of Fraction
        A wrench on the platform, by the freedoms of the motion group; empty if no forces are asked for.
    most_force : Fraction
        What the forces of the actuators that bear it do not exceed.
    """

    asked: tuple[str, ...]
    modes: tuple[int, ...]
    indices: tuple[tuple[str, Fraction], ...] = ()
    length: Fraction | None = None
    load: tuple[Fraction, ...] = ()
    most_force: Fraction = Fraction(0)

    @property
    def names(self) -> tuple[str, ...]:
        """All that is asked, in words."""
        found = (*self.asked, *(f"{name} > {float(bound):g}" for name, bound in self.indices))
        return (*found, f"forces up to {float(self.most_force):g}") if self.load else found

    @property
    def needs_modes(self) -> bool:
        """Whether a working mode matters, whatever the limits."""
        return "no_type_2" in self.asked or bool(self.indices or self.load)


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
    placed : tuple of PlacedLeg
    matrix : Regular or None
        In the place of the determinant, where that is large.
    """

    formula: Formula
    roots: tuple[Polynomial, ...]
    determinant: Polynomial | None
    pose: PosePolynomials
    placed: tuple[PlacedLeg, ...] = ()
    matrix: Regular | None = None


def asked_of(
    machine: RegionMachine, chart: Chart, conditions: Conditions, *, most_of_determinant: int | None = None
) -> Asked:
    """The formula of the conditions on a chart.

    Parameters
    ----------
    machine : RegionMachine
    chart : Chart
    conditions : Conditions
    most_of_determinant : int, optional
        How many coefficients the determinant may have for it to be expanded; by default it is, whatever its size.

    Raises
    ------
    InputError
        If the structure of the robot does not allow all poses of the chart, or working modes are needed and not named.
    """
    pose, placed = placed_legs(machine, chart, conditions)
    require_modes(machine, conditions)
    if "limits" in conditions.asked and not machine.is_limited:
        raise InputError("conditions.limits: the model has no limits; give it a table [limits], or leave this out")
    parts: list[Formula] = []
    parts += [Atom(f"{leg.leg.name} reaches", leg.root) for leg in placed if leg.root is not None]
    if "limits" in conditions.asked:
        parts += [part for leg in placed for part in within_reach(leg)]
        parts += _cones(machine, placed, pose) + _position(machine, pose)
        parts += legs_apart(machine, pose, placed, chart.box)
    if "no_type_1" in conditions.asked:
        parts += [_keeps_its_mode(leg) for leg in placed]
    determinant, matrix = None, None
    if "no_type_2" in conditions.asked:
        matrix = _matrix(machine, chart, pose, placed, most_of_determinant)
        if matrix is None:
            determinant = constraint_determinant(machine, pose, placed)
            parts.append(Atom(_DETERMINANT, determinant, Sign.NOT_ZERO))
        else:
            parts.append(matrix)
    parts += _indices(machine, pose, placed, conditions) + _forces(machine, pose, placed, conditions)
    roots = tuple(leg.root for leg in placed if leg.root is not None)
    return Asked(All(tuple(parts)), roots, determinant, pose, tuple(placed), matrix)


def _matrix(
    machine: RegionMachine, chart: Chart, pose: PosePolynomials, placed: Sequence[PlacedLeg], most: int | None
) -> Regular | None:
    """The matrix in the place of its determinant, if that has more coefficients than ``most``."""
    if most is None or not has_matrix(chart):
        return None
    if determinant_size(wrench_rows(machine, pose, placed), len(chart.variables)) <= most:
        return None
    return Regular(_DETERMINANT, smaller_rows(machine, pose, placed))


def _indices(
    machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg], conditions: Conditions
) -> list[Formula]:
    """That the square of each index is greater than that of its bound; where it has no value, it is not."""
    found: list[Formula] = []
    for name, bound in conditions.indices:
        above, below = index_square(name, machine, pose, placed, structural_rows(machine, pose), conditions.length)
        found.append(Atom(f"{name} above {float(bound):g}", above - rational(bound * bound) * below, Sign.POSITIVE))
    return found


def _forces(
    machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg], conditions: Conditions
) -> list[Formula]:
    if not conditions.load:
        return []
    whole, parts = force_polynomials(
        conditions.load, conditions.most_force, machine, pose, placed, structural_rows(machine, pose)
    )
    names = [f"{leg.leg.name} bears the load" for leg in placed]
    atoms = [Atom(name, part) for name, part in zip(names, parts, strict=True)]
    return [Atom("the load is borne", whole, Sign.NOT_ZERO), *atoms]


def placed_legs(
    machine: RegionMachine, chart: Chart, conditions: Conditions
) -> tuple[PosePolynomials, list[PlacedLeg]]:
    """The poses of a chart, which the structure allows, and the legs there."""
    driven = [k for k, leg in enumerate(machine.legs) if isinstance(leg.actuator, OnSlide | OnCrank)]
    pose = pose_polynomials(chart, machine.metric, tuple(f"s{k + 1}" for k in driven))
    require_allowed(machine, pose)
    places = {k: len(chart.variables) + i for i, k in enumerate(driven)}
    placed = [
        placed_leg(leg, pose, machine.metric, conditions.modes[k] or 1, places.get(k, -1))
        for k, leg in enumerate(varied_legs(machine, chart, pose))
    ]
    return pose, placed


def require_allowed(machine: RegionMachine, pose: PosePolynomials) -> None:
    """Refuse poses at which a joint that is not actuated does not hold."""
    for form in machine.forms:
        if not form_at(form, pose, machine.metric).is_zero():
            raise InputError(
                "region: its poses are not all among those that the joints of the mechanism allow; fix the coordinates "
                "that these fix"
            )


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
    require_modes(machine, conditions, always=True)
    return pose, wrench_rows(machine, pose, placed)


def form_at(form: Sequence[Fraction], pose: PosePolynomials, metric: Metric) -> Polynomial:
    """N^2 times the value of a linear form."""
    n, values = pose.norm, [pose.constant(value) for value in form]
    scaled = [*values[:4], *(n * value for value in values[4:16]), n * n * values[16]]
    exact: Any = [rational(g) for g in metric]
    found: Polynomial = value_at(scaled, pose.position, pose.rotation, exact)
    return found


def require_modes(machine: RegionMachine, conditions: Conditions, *, always: bool = False) -> None:
    """Refuse a question that depends on working modes, or any with ``always``, if they are not named."""
    for k, leg in enumerate(machine.legs):
        if isinstance(leg.actuator, OwnLength | OnHinge) or conditions.modes[k]:
            continue
        limited = leg.reach is not None or machine.base_cones or machine.platform_cones or machine.leg_distance
        if always or conditions.needs_modes or ("limits" in conditions.asked and limited):
            raise InputError(
                f"conditions.working_modes: {leg.name} has two working modes, and what is asked depends on them; give "
                'one sign for each leg, such as ["+", "+", "-"]'
            )


def _keeps_its_mode(leg: PlacedLeg) -> Atom:
    if leg.root is None:
        return Atom(f"{leg.leg.name} has a length", leg.value[0], Sign.POSITIVE)
    return Atom(f"{leg.leg.name} keeps its working mode", leg.root, Sign.POSITIVE)


def within_reach(leg: PlacedLeg) -> list[Formula]:
    """That the joint value of a leg is within its reach, if it has one."""
    if leg.leg.reach is None:
        return []
    low, high = leg.leg.reach
    if isinstance(leg.leg.actuator, OnCrank):
        return [turned_within(leg, low, high)]
    value, unit = leg.value
    if not isinstance(leg.leg.actuator, OnSlide):
        low, high = low * low, high * high
    name = leg.leg.name
    return [
        Atom(f"{name} above its least value", value - rational(low) * unit),
        Atom(f"{name} below its greatest value", rational(high) * unit - value),
    ]


def turned_within(leg: PlacedLeg, low: Fraction, high: Fraction) -> Formula:
    """Whether a crank's angle is between two, in degrees: its direction left of one and right of the other."""
    cosine, sine = leg.value
    ends = []
    for angle, side, what in ((low, 1, "beyond its least angle"), (high, -1, "short of its greatest angle")):
        tight, loose = (side * (rational(c) * sine - rational(s) * cosine) for c, s in turn_directions(angle, side))
        ends.append((f"{leg.leg.name} {what}", tight, loose))
    parts = tuple(Atom(name, tight, loose=loose) for name, tight, loose in ends)
    if high - low >= 360:
        return All(())
    if low == high:
        tight, loose = (rational(c) * cosine + rational(s) * sine for c, s in turn_directions(low, 1))
        return All((*parts, Atom(f"{leg.leg.name} at its angle", tight, loose=loose)))
    if abs(high - low - 180) <= 2 * BESIDE:
        # Beside the ends the range may be wider than half a turn, or not: both must hold, and it fails where both do.
        inner = tuple(Atom(name, tight, loose=sine * 0) for name, tight, _ in ends)
        outer = tuple(Atom(name, loose) for name, _, loose in ends)
        return All((*inner, Some(outer)))
    return Some(parts) if high - low > 180 else All(parts)


def _cones(machine: RegionMachine, placed: Sequence[PlacedLeg], pose: PosePolynomials) -> list[Formula]:
    found: list[Formula] = []
    rods = [leg for leg in placed if not isinstance(leg.leg.actuator, OnHinge) and leg.leg.axis is None]
    for k, leg in enumerate(rods):
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
    rows = wrench_rows(machine, pose, placed)
    require_square(len(rows), machine)
    return determinant(rows, pose.constant(0))

"""Which joint values a region of poses needs: of each leg the least and the greatest, enclosed.

A ball of positions is not gone through. Let r be its radius, v the platform joint for its centre, L the rod, and s(q)
its lower end on the slide. In the working mode "-" (the rod points along the slide) the joint values of all poses of
the ball lie between those at which

    |v - s(q)| = L + r  (least),    |v - s(q)| = L - r  (greatest)

and are these where the sphere about s(q) touches the ball, from outside or around it; in the mode "+" the other way
round. That holds if all of the ball is reached. A leg of own length has |v - A| - r and |v - A| + r.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, TypeAlias

from pkm_exact.errors import InputError
from pkm_exact.geometry.limits import Pair
from pkm_exact.regions.compiled_formula import compiled_formula
from pkm_exact.regions.extremes import greatest
from pkm_exact.regions.formula import All, Formula, Some, atoms_of, beyond
from pkm_exact.regions.joint_quotients import JointQuotient, joint_quotient, rational_root
from pkm_exact.regions.paving import INSIDE, SPLIT, Part, pave
from pkm_exact.regions.region_conditions import asked_of, placed_legs, require_allowed
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, OwnLength, RegionLeg, RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_shapes import ball_of
from pkm_exact.regions.region_solver import axes_of
from pkm_exact.regions.turned_legs import TurnedLeg, every_pose, turned_leg
from pkm_exact.roots.interval import Interval

_Found: TypeAlias = tuple[Interval, bool]
"""A value, and whether it is as precise as asked for."""


@dataclass(frozen=True)
class JointRange:
    """What a leg needs.

    Attributes
    ----------
    name : str
    unit : str
        "deg" of a crank; otherwise that of the robot.
    least, greatest : Interval
        They enclose the least and the greatest value.
    is_precise : bool
        Whether both are enclosed to the precision asked for.
    """

    name: str
    unit: str
    least: Interval
    greatest: Interval
    is_precise: bool

    @property
    def stroke(self) -> Interval:
        """The greatest value less the least."""
        return Interval(max(self.greatest.lo - self.least.hi, Fraction(0)), self.greatest.hi - self.least.lo)


def common_range(ranges: Sequence[JointRange]) -> JointRange | None:
    """The range that serves all legs alike; None if their values have different units.

    Examples
    --------
    >>> ends = [Interval(Fraction(k), Fraction(k)) for k in (1, 2, 3, 5)]
    >>> ranges = [JointRange("a", "m", ends[0], ends[2], True), JointRange("b", "m", ends[1], ends[3], True)]
    >>> str(common_range(ranges).stroke)
    '4.000000000000000'
    """
    if len({found.unit for found in ranges}) != 1:
        return None
    least, greatest = (
        Interval(choose(x.lo for x in ends), choose(x.hi for x in ends))
        for ends, choose in (([x.least for x in ranges], min), ([x.greatest for x in ranges], max))
    )
    return JointRange("all", ranges[0].unit, least, greatest, all(found.is_precise for found in ranges))


def joint_ranges(
    machine: RegionMachine, question: RegionQuestion, *, progress: Callable[[str], None] | None = None
) -> tuple[JointRange, ...]:
    """Least and greatest joint value of each leg over the good poses of a region.

    Raises
    ------
    InputError
        If it is not known for such a robot or region, or no pose is shown to be good.
    """
    for k, leg in enumerate(machine.legs):
        if isinstance(leg.actuator, OnHinge):
            raise InputError(f"answer.of: joint values of driven hinges ({leg.name}) are not known here")
        if not isinstance(leg.actuator, OwnLength) and not question.conditions.modes[k]:
            raise InputError(
                f"conditions.working_modes: {leg.name} has two working modes; give one sign for each leg, such as "
                '["+", "+", "-"]'
            )
    extreme = _way(machine, question)
    found = []
    for k, leg in enumerate(machine.legs):
        if progress is not None:
            progress(f"joint values of {leg.name}")
        (least, first), (most, second) = (extreme(k, way) for way in (-1, 1))
        unit = "deg" if isinstance(leg.actuator, OnCrank) else machine.unit
        found.append(JointRange(leg.name, unit, least, most, first and second))
    return tuple(found)


def _way(machine: RegionMachine, question: RegionQuestion) -> Callable[[int, int], _Found]:
    """How the extremes are found: of leg k, the least (-1) or the greatest (1).

    A leg is looked at by itself only where all poses of the region are good, for all legs: its own values are those of
    good poses then.
    """
    ball = ball_of(question.shape, machine.metric)
    is_plain = question.conditions.names == ("reachable",) and not question.joints
    if question.any_axis is not None and not is_plain:
        raise InputError("region.any_axis_degrees: goes with the condition reachable alone")
    is_straight = not any(isinstance(leg.actuator, OnCrank) or leg.axis is not None for leg in machine.legs)
    if ball is not None and is_plain and is_straight:
        require_allowed(machine, every_pose(machine, question))
        return lambda k, way: _about_ball(machine, question, k, ball, way)
    if question.any_axis is None:
        return lambda k, way: _in_chart(machine, question, k, way)
    require_allowed(machine, every_pose(machine, question))
    for k, leg in enumerate(machine.legs):
        if not isinstance(leg.actuator, OwnLength):
            _require_reached(machine, question, k, leg, None)
    return lambda k, way: _best(turned_leg(machine, question, k, machine.legs[k], None), machine, question, way)


def _in_chart(machine: RegionMachine, question: RegionQuestion, k: int, way: int) -> _Found:
    """By the variables of the region, under all its conditions."""
    chart = question.chart
    asked = asked_of(machine, chart, question.conditions)
    _, placed = placed_legs(machine, chart, question.conditions)
    formula: Formula = All((question.region(asked, machine.metric), asked.formula))
    wanted = joint_quotient(placed[k], asked.roots, _middle(chart.box))
    return _extreme(wanted, formula, asked.roots, machine, question, chart.variables, chart.box, way)


def _middle(box: Sequence[Pair]) -> list[Fraction]:
    return [(low + high) / 2 for low, high in box]


def _extreme(
    wanted: JointQuotient,
    formula: Formula,
    roots: Sequence[Any],
    machine: RegionMachine,
    question: RegionQuestion,
    names: Sequence[str],
    box: Sequence[Pair],
    way: int,
) -> _Found:
    atoms = list({id(atom): atom for atom in atoms_of(formula)}.values())
    ready = compiled_formula(formula, atoms, roots, box)
    axes = axes_of(machine, names, box, question.answer.steps)
    precision, boxes = question.answer.precision, question.answer.boxes
    found = greatest(wanted.quotient, ready, box, axes, precision=precision, boxes=boxes, sign=way)
    if found is None:
        raise InputError(
            f"answer.of: joint values of {wanted.leg.name} are not bounded with the work allowed, or no pose is shown "
            "to be good; raise answer.steps or answer.boxes, or ask less of the poses"
        )
    return wanted.value(found.value), found.is_precise


def _about_ball(
    machine: RegionMachine, question: RegionQuestion, k: int, ball: tuple[tuple[Fraction, ...], Fraction], way: int
) -> _Found:
    """For a ball of positions: that of its centre with another rod, or more or less by the radius."""
    leg, (center, square) = machine.legs[k], ball
    radius, slide = rational_root(square, 1), leg.actuator
    if not isinstance(slide, OnSlide):
        value, is_precise = _at_center(machine, question, k, leg, center, way)
        moved = (max(end + way * radius, Fraction(0)) for end in (value.lo, value.hi))
        return Interval(*moved), is_precise
    outward = way * question.conditions.modes[k]
    roots = {rational_root(slide.rod_squared, side) for side in (-1, 1)}
    shorter = min(roots) - radius
    if shorter <= 0:
        raise InputError(f"region.ball: {leg.name} does not reach all of it; give a smaller one")
    _require_reached(machine, question, k, replace(leg, actuator=replace(slide, rod_squared=shorter**2)), center)
    ends = []
    for root in roots:  # on both sides of L where that is irrational: the value lies between theirs
        other = replace(leg, actuator=replace(slide, rod_squared=(root + outward * radius) ** 2))
        ends.append(_at_center(machine, question, k, other, center, way))
    values = [value for value, _ in ends]
    between = Interval(min(value.lo for value in values), max(value.hi for value in values))
    return between, all(is_precise for _, is_precise in ends)


def _at_center(
    machine: RegionMachine, question: RegionQuestion, k: int, leg: RegionLeg, center: tuple[Fraction, ...], way: int
) -> _Found:
    return _best(turned_leg(machine, question, k, leg, center), machine, question, way)


def _best(turned: TurnedLeg, machine: RegionMachine, question: RegionQuestion, way: int) -> _Found:
    formula = All((*turned.shape, *turned.reaches))
    wanted = joint_quotient(turned.placed, turned.roots, _middle(turned.box))
    return _extreme(wanted, formula, turned.roots, machine, question, turned.names, turned.box, way)


def _require_reached(
    machine: RegionMachine, question: RegionQuestion, k: int, leg: RegionLeg, center: tuple[Fraction, ...] | None
) -> None:
    """Refuse a region of which a leg, or at the centre of a ball another in its place, does not reach all."""
    turned = turned_leg(machine, question, k, leg, center)
    formula = Some((beyond(All(turned.shape)), All(turned.reaches)))
    ready = compiled_formula(formula, atoms_of(formula), turned.roots, turned.box)
    axes = axes_of(machine, turned.names, turned.box, question.answer.steps)
    start = Part(0, (0,) * len(turned.box))
    word = pave(ready, axes, start, len(axes), most=question.answer.boxes, stop_outside=True).word
    if set(word) - {INSIDE, SPLIT}:
        where = "region" if center is None else "region.ball"
        raise InputError(f"{where}: that {leg.name} reaches all of it is not proved; give a smaller one")

"""The least and the greatest value of an index over the good poses of a region, enclosed."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.errors import InputError
from pkm_exact.geometry.limits import Pair
from pkm_exact.regions.compiled_formula import compiled_formula
from pkm_exact.regions.extremes import Extreme, Quotient, greatest
from pkm_exact.regions.formula import All, Formula, atoms_of
from pkm_exact.regions.index_quotients import index_square
from pkm_exact.regions.joint_quotients import rational_root
from pkm_exact.regions.region_conditions import asked_of, placed_legs, require_modes
from pkm_exact.regions.region_determinants import structural_rows
from pkm_exact.regions.region_legs import RegionMachine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import axes_of
from pkm_exact.roots.interval import Interval


@dataclass(frozen=True)
class IndexRange:
    """Least and greatest value of an index, each with the box in which it is taken.

    Attributes
    ----------
    name : str
    least, greatest : Interval
    least_at, greatest_at : tuple of pairs of Fraction
        By the variables of the chart; wherever the value is taken, it is in it.
    is_precise : bool
        Whether both are enclosed to the precision asked for.
    """

    name: str
    least: Interval
    greatest: Interval
    least_at: tuple[Pair, ...]
    greatest_at: tuple[Pair, ...]
    is_precise: bool


def index_range(machine: RegionMachine, question: RegionQuestion) -> IndexRange:
    """The extremes of the index that a question asks for.

    Poses at which it has no value, as a leg is at a singularity of its own, do not count.

    Raises
    ------
    InputError
        If it is not known for such a robot, or no pose is shown to be good.
    """
    chart, name = question.chart, question.answer.of
    asked = asked_of(machine, chart, question.conditions)
    require_modes(machine, question.conditions, always=True)
    pose, placed = placed_legs(machine, chart, question.conditions)
    above, below = index_square(name, machine, pose, placed, structural_rows(machine, pose), question.conditions.length)
    common = above.gcd(below)
    quotient = Quotient(above / common, below / common)
    formula: Formula = All((question.region(asked, machine.metric), asked.formula))
    atoms = list({id(atom): atom for atom in atoms_of(formula)}.values())
    ready = compiled_formula(formula, atoms, asked.roots, chart.box)
    axes = axes_of(machine, chart.variables, chart.box, question.answer.steps)
    precision, boxes = question.answer.precision, question.answer.boxes
    for sign in (1, -1):  # which the common factor may have changed in both
        wanted = Quotient(quotient.numerator * sign, quotient.denominator * sign)
        found = [
            greatest(wanted, ready, chart.box, axes, precision=precision, boxes=boxes, sign=way) for way in (-1, 1)
        ]
        if None not in found:
            break
    least, most = found
    if least is None or most is None:
        raise InputError(f"answer.of: {name} is not bounded with the work allowed, or no pose is shown to be good")
    return IndexRange(name, _root(least), _root(most), least.where, most.where, least.is_precise and most.is_precise)


def _root(found: Extreme) -> Interval:
    low, high = max(found.value.lo, Fraction(0)), max(found.value.hi, Fraction(0))
    return Interval(rational_root(low, -1), rational_root(high, 1))

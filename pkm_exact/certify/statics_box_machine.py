"""What a statics certificate of a box of poses says of its machine: legs, slides, forms, the box, P and E."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from flint import arb, arb_mat

from pkm_exact.balls import ball, hull
from pkm_exact.certify.widened import Ends, hulls, widened, widened_all
from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.constraints.form import ordinary, wrench
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.radicals import RootSum
from pkm_exact.statics.actuated_equations import AnyForm, Equation
from pkm_exact.statics.at_pose import AtPose, at_box
from pkm_exact.statics.freedom import Freedom

MOST_LEGS: Final = 12
MOST_CONSTRAINTS: Final = 5
_LEGS: Final = (
    "certificate: is for machines whose actuators drive legs, 12 at most, by lengths, slides or cranks, "
    "with rational joints"
)
_HINGES: Final = (
    "certificate: constraints that are not actuated must be linear forms with rational coefficients, 5 at most, "
    "which no actuator moves"
)

Point = tuple[Fraction, ...]


@dataclass(frozen=True)
class BoxedLeg:
    """Joints, and the velocity of the base joint at unit speed; None where the length is what is actuated."""

    base: Point
    platform: Point
    direction: Point | None


@dataclass(frozen=True, eq=False)
class BoxedMachine:
    """A machine in a box of poses, in ordinary coordinates, with what is listed of P and E.

    Attributes
    ----------
    at : AtPose
        In the box.
    legs : tuple of BoxedLeg
    constraints : tuple of forms
    position, rotation
        Intervals.
    free : tuple of int
        Components of twists.
    jacobian, expansion : rows of intervals
    """

    at: AtPose
    legs: tuple[BoxedLeg, ...]
    constraints: tuple[tuple[Fraction, ...], ...]
    position: tuple[Ends, ...]
    rotation: tuple[tuple[Ends, ...], ...]
    free: tuple[int, ...]
    jacobian: list[list[Ends]]
    expansion: list[list[Ends]]

    @property
    def rows(self) -> arb_mat:
        """P as it is listed."""
        return hulls(self.jacobian)

    @property
    def twists(self) -> arb_mat:
        """E as it is listed."""
        return hulls(self.expansion)


def is_of_legs(at: AtPose) -> bool:
    """Whether all actuators drive legs with rational joints, and the other constraints are rational forms."""
    if at.held.is_redundant:
        return False
    try:
        for k in range(len(at.held.actuators)):
            boxed_leg(at, k)
        for index in at.held.structural:
            _form(at.equations[index])
    except InputError:
        return False
    return True


def boxed_machine(at: AtPose) -> BoxedMachine:
    """The machine of a pose, at the precision in force.

    Raises
    ------
    InputError
        If it is not one of those that have certificates, or the box is too wide.
    """
    legs = tuple(boxed_leg(at, k) for k in range(len(at.held.actuators)))
    if not 1 <= len(legs) <= MOST_LEGS:
        raise InputError(_LEGS)
    constraints = tuple(_form(at.equations[index]) for index in at.held.structural)
    if len(constraints) > MOST_CONSTRAINTS:
        raise InputError(_HINGES)
    position, rotation = box_of(at)
    place = [hull(*ends) for ends in position], [[hull(*ends) for ends in row] for row in rotation]
    boxed = at if not at.is_exact else in_box(at, position, rotation)
    freedoms = at.motion.twist
    free = Freedom(boxed).free.places
    roots = [arb(g).sqrt() for g in at.metric]
    expansion = _expansion([_row(form, roots, *place, freedoms) for form in constraints], free, len(freedoms))
    jacobian = arb_mat([_leg_row(leg, roots, *place, freedoms) for leg in legs]) * expansion
    listed = [
        [(Fraction(int(free[j] == i)),) * 2 if i in free else widened(expansion[i, j], 1) for j in range(len(free))]
        for i in range(len(freedoms))
    ]
    entries = widened_all(jacobian.entries())
    rows = [entries[k : k + len(free)] for k in range(0, len(entries), len(free))]
    return BoxedMachine(boxed, legs, constraints, position, rotation, tuple(freedoms[k] for k in free), rows, listed)


@dataclass(frozen=True)
class _Named:
    """What a box takes from a machine."""

    at: AtPose

    @property
    def name(self) -> str:
        return self.at.name

    @property
    def unit(self) -> str:
        return self.at.unit

    @property
    def motion(self) -> Any:
        return self.at.motion

    @property
    def metric(self) -> Metric:
        return self.at.metric


def boxed_leg(at: AtPose, number: int) -> BoxedLeg:
    """The leg that an actuator drives; a refusal if it drives anything else, or all is not rational."""
    equation = at.equations[at.held.actuators[number].equation]
    form, rates = equation.form, equation.rates
    if len(rates) != 1 or rates[0].actuator != number:
        raise InputError(_LEGS)
    base, platform = _joints(form, at.metric)
    if rates[0].stepped is None:
        if rates[0].value_squared is None:
            raise InputError(_LEGS)
        return BoxedLeg(base, platform, None)
    (up, joint), (down, other) = (_joints(step, at.metric) for step in rates[0].stepped)
    if joint != platform or other != platform:
        raise InputError(_LEGS)
    return BoxedLeg(base, platform, tuple((x - y) / 2 for x, y in zip(up, down, strict=True)))


def _joints(form: AnyForm, metric: Metric) -> tuple[Point, Point]:
    """A and B of |C + R B - A|^2 = l^2."""
    values = _rational(form, _LEGS)
    base = tuple(-values[4 + i] / (2 * metric[i]) for i in range(3))
    platform = tuple(values[1 + i] / (2 * metric[i]) for i in range(3))
    outer = [-2 * metric[i] * base[i] * platform[j] for i in range(3) for j in range(3)]
    if values[0] != 1 or list(values[7:16]) != outer:
        raise InputError(_LEGS)
    return base, platform


def _form(equation: Equation) -> tuple[Fraction, ...]:
    if equation.rates:
        raise InputError(_HINGES)
    return _rational(equation.form, _HINGES)


def _rational(form: AnyForm, refusal: str) -> tuple[Fraction, ...]:
    if isinstance(form, SquareForm):
        raise InputError(refusal)
    found = []
    for value in form:
        exact = RootSum.of(value).rational
        if exact is None:
            raise InputError(refusal)
        found.append(Fraction(exact))
    return tuple(found)


def in_box(at: AtPose, position: Sequence[Ends], rotation: Sequence[Sequence[Ends]]) -> AtPose:
    """The machine of an exact pose in a box around it."""
    return at_box(_Named(at), at.held, *_intervals(position, rotation), at.rank)


def box_of(at: AtPose) -> tuple[tuple[Ends, ...], tuple[tuple[Ends, ...], ...]]:
    """The box of a pose, or a narrow one around an exact pose."""
    if not at.is_exact:
        return (
            tuple((Fraction(x.lo), Fraction(x.hi)) for x in at.position),
            tuple(tuple((Fraction(x.lo), Fraction(x.hi)) for x in row) for row in at.rotation),
        )
    g = at.metric

    def ends(square: Fraction, value: Any) -> Ends:
        found = interval_of(RootSum.root(square) * value)
        return Fraction(found.lo), Fraction(found.hi)

    position = tuple(ends(Fraction(g[i]), x) for i, x in enumerate(at.position))
    rotation = tuple(
        tuple(ends(Fraction(g[i], g[j]), x) for j, x in enumerate(row)) for i, row in enumerate(at.rotation)
    )
    return position, rotation


def _intervals(position: Sequence[Ends], rotation: Sequence[Sequence[Ends]]) -> tuple[Any, Any]:
    from pkm_exact.roots.interval import Interval

    return [Interval(*ends) for ends in position], [[Interval(*ends) for ends in row] for row in rotation]


def _row(form: Sequence[Fraction], roots: Any, position: Any, rotation: Any, freedoms: Sequence[int]) -> list[arb]:
    found = wrench(ordinary([ball(value) for value in form], roots), position, rotation)
    return [found[k] for k in freedoms]


def _leg_row(leg: BoxedLeg, roots: Any, position: Any, rotation: Any, freedoms: Sequence[int]) -> list[arb]:
    """(d; a x d) by |d| or by the speed along d."""
    joint = [root * ball(x) for root, x in zip(roots, leg.platform, strict=True)]
    arm = [sum((r * x for r, x in zip(row, joint, strict=True)), arb(0)) for row in rotation]
    base = [root * ball(x) for root, x in zip(roots, leg.base, strict=True)]
    d = [c + a - b for c, a, b in zip(position, arm, base, strict=True)]
    if leg.direction is None:
        rate = sum((x * x for x in d), arb(0)).nonnegative_part().sqrt()
    else:
        rate = sum((root * ball(n) * x for root, n, x in zip(roots, leg.direction, d, strict=True)), arb(0))
    if rate.contains(0):
        raise InputError(
            "certificate: a leg may be singular of type 1 in the box; give another pose, or a narrower box"
        )
    moment = [arm[1] * d[2] - arm[2] * d[1], arm[2] * d[0] - arm[0] * d[2], arm[0] * d[1] - arm[1] * d[0]]
    whole = [*d, *moment]
    return [whole[k] / rate for k in freedoms]


def _expansion(rows: Sequence[Sequence[arb]], free: Sequence[int], count: int) -> arb_mat:
    """E from W t = 0."""
    found = arb_mat(
        count, len(free), [int(i in free and free.index(i) == j) for i in range(count) for j in range(len(free))]
    )
    others = [k for k in range(count) if k not in free]
    if not rows:
        return found
    if len(rows) != len(others):
        raise InputError("certificate: constraints that are not actuated must be independent at the pose")
    try:
        solved = arb_mat([[row[k] for k in others] for row in rows]).solve(
            arb_mat([[row[k] for k in free] for row in rows])
        )
    except ZeroDivisionError:
        raise InputError("certificate: the box is too wide for a basis of twists; give a narrower one") from None
    for i, place in enumerate(others):
        for j in range(len(free)):
            found[place, j] = -solved[i, j]
    return found

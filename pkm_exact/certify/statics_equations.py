"""What a statics certificate of version 4 says of its machine: equations with rates of actuators, P and E."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from flint import arb, arb_mat

from pkm_exact.balls import ball, hull
from pkm_exact.certify.statics_box_machine import box_of, in_box
from pkm_exact.certify.statics_box_parts import is_definite
from pkm_exact.certify.widened import Ends, hulls, widened, widened_all
from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.constraints.form import ordinary, value_at, wrench
from pkm_exact.errors import InputError
from pkm_exact.radicals import RootSum
from pkm_exact.statics.actuated_equations import AnyForm, Equation, Rate
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.freedom import Freedom

MOST_ACTUATORS: Final = 12
MOST_EQUATIONS: Final = 18
_RATIONAL: Final = (
    "certificate: coefficients of constraints, and how actuators move them, must be rational but for one square root "
    "each actuator; a pose of a solution (--pose) has the joint values of its configuration"
)
_MANY: Final = "certificate: is for 1 to 12 actuators and up to 18 constraints"
_DEPENDENT: Final = "certificate: there must be as many independent constraints as freedoms and actuators leave"
_ORDINARY: Final = (1, 1, 1)

Numbers = tuple[Fraction, ...]


@dataclass(frozen=True)
class CertifiedEquation:
    """Its form, the factor and form of its square if it has one, and the forms of its rates by actuators."""

    form: Numbers
    square: tuple[Fraction, Numbers] | None
    rates: tuple[tuple[int, Numbers], ...]


@dataclass(frozen=True, eq=False)
class EquationMachine:
    """A machine in a box of poses, and what is listed of P and E.

    Attributes
    ----------
    at : AtPose
        In the box.
    actuators : tuple of Fraction
        The squares that rates are multiplied by the roots of.
    equations : tuple of CertifiedEquation
    position, rotation
        Intervals.
    free : tuple of int, or None
        Components of twists; None if the twist follows from the actuators.
    jacobian : rows of intervals, or None
    expansion : rows of intervals
    regular : bool
        Whether no pose of the box is singular.
    """

    at: AtPose
    actuators: Numbers
    equations: tuple[CertifiedEquation, ...]
    position: tuple[Ends, ...]
    rotation: tuple[tuple[Ends, ...], ...]
    free: tuple[int, ...] | None
    jacobian: list[list[Ends]] | None
    expansion: list[list[Ends]]
    regular: bool

    @property
    def rows(self) -> arb_mat:
        """P as it is listed; Q, if there is none."""
        return self.twists.transpose() if self.jacobian is None else hulls(self.jacobian)

    @property
    def twists(self) -> arb_mat:
        """E as it is listed."""
        return hulls(self.expansion)


def equation_machine(at: AtPose) -> EquationMachine:
    """The machine of a pose, at the precision in force.

    Raises
    ------
    InputError
        If it is not one of those that have certificates, or the box is too wide.
    """
    actuators, equations = certified_equations(at)
    position, rotation = box_of(at)
    boxed = at if not at.is_exact else in_box(at, position, rotation)
    freedoms = at.motion.twist
    place = [hull(*ends) for ends in position], [[hull(*ends) for ends in row] for row in rotation]
    rows = _Rows(at.metric, *place)
    w = [[row[k] for k in freedoms] for row in map(rows.row, equations)]
    r = [rows.rates(equation, actuators) for equation in equations]
    free = None if at.is_forward else Freedom(boxed).free.places
    solved = _solved(w, r, free, len(freedoms))
    listed = free or ()
    whole = solved[: len(freedoms)]
    expansion = [
        [(Fraction(int(listed[j] == i)),) * 2 for j in range(len(listed))] if i in listed else widened_row(row)
        for i, row in enumerate(whole)
    ]
    jacobian = None if free is None else _rows_of(solved[len(freedoms) :])
    return EquationMachine(
        boxed,
        actuators,
        equations,
        position,
        rotation,
        None if free is None else tuple(freedoms[k] for k in free),
        jacobian,
        expansion,
        _is_regular(w, r, forward=free is None),
    )


def widened_row(row: Sequence[arb]) -> list[Ends]:
    """Intervals around a row of E."""
    return [widened(x, 1) for x in row]


def _rows_of(rows: Sequence[Sequence[arb]]) -> list[list[Ends]]:
    width = len(rows[0])
    entries = widened_all([x for row in rows for x in row])
    return [entries[k : k + width] for k in range(0, len(entries), width)]


def certified_equations(at: AtPose) -> tuple[Numbers, tuple[CertifiedEquation, ...]]:
    """Squares of the actuators and all equations with rational forms.

    Raises
    ------
    InputError
        If one is not rational, or they are too many.
    """
    held = at.held
    if not (1 <= len(held.actuators) <= MOST_ACTUATORS and 1 <= len(held.equations) <= MOST_EQUATIONS):
        raise InputError(_MANY)
    rates = [{rate.actuator: _rate_form(rate, equation) for rate in equation.rates} for equation in held.equations]
    squares: list[Fraction] = []
    for k in range(len(held.actuators)):
        entries = [RootSum.of(x) for row in rates for x in row.get(k, ())]
        squares.append(_common_square(entries))
    found = []
    for equation, row in zip(held.equations, rates, strict=True):
        form, square = equation.form, None
        if isinstance(form, SquareForm):
            square, form = (form.factor, _rational(form.root, Fraction(1))), form.linear
        pairs = tuple((k, _rational(row[k], squares[k])) for k in sorted(row))
        found.append(CertifiedEquation(_rational(form, Fraction(1)), square, pairs))
    return tuple(squares), tuple(found)


def _rate_form(rate: Rate, equation: Equation) -> Sequence[Any]:
    """The form of a rate: a length's root is one of its coefficients."""
    if rate.stepped is not None:
        up, down = rate.stepped
        if isinstance(up, SquareForm) or isinstance(down, SquareForm) or isinstance(equation.form, SquareForm):
            up, down = _linear(up, equation.form), _linear(down, equation.form)
        return [(b - a) * Fraction(1, 2) for a, b in zip(up, down, strict=True)]
    value = RootSum.of(1) if rate.value_squared is None else 2 * RootSum.root(rate.value_squared)
    return [Fraction(0)] * 16 + [value]


def _linear(form: AnyForm, own: AnyForm) -> Any:
    """The linear part of a form whose square the actuator does not move."""
    pair = [part for part in (form, own) if isinstance(part, SquareForm)]
    roots = [[part.factor, *map(RootSum.of, part.root)] for part in pair]
    if len(pair) < 2 or roots[0] != roots[1]:
        raise InputError("certificate: an actuator must not move the axis that a distance is measured from")
    return pair[0].linear


def _common_square(entries: Sequence[RootSum]) -> Fraction:
    """A number whose root all entries are rational multiples of."""
    for entry in entries:
        if len(entry.terms) == 1:
            return Fraction(entry.terms[0][0])
        if entry.terms:
            raise InputError(_RATIONAL)
    raise InputError("certificate: an actuator moves nothing at this pose")


def _rational(form: Sequence[Any], square: Fraction) -> Numbers:
    inverse = RootSum.root(square).inverse()
    found = [(inverse * value).rational for value in form]
    if any(value is None for value in found):
        raise InputError(_RATIONAL)
    return tuple(Fraction(value or 0) for value in found)


class _Rows:
    """Rows and values of forms in a box."""

    def __init__(self, metric: Sequence[int], position: Sequence[arb], rotation: Sequence[Sequence[arb]]) -> None:
        self._roots = [arb(g).sqrt() for g in metric]
        self._place = position, rotation

    def _in_balls(self, form: Numbers) -> list[arb]:
        return ordinary([ball(value) for value in form], self._roots)

    def row(self, equation: CertifiedEquation) -> list[arb]:
        """W_i."""
        found: list[arb] = wrench(self._in_balls(equation.form), *self._place)
        if equation.square is None:
            return found
        factor, root = equation.square
        slope = 2 * ball(factor) * self._value(root)
        return [x - slope * y for x, y in zip(found, wrench(self._in_balls(root), *self._place), strict=True)]

    def _value(self, form: Numbers) -> Any:
        return value_at(self._in_balls(form), *self._place, _ORDINARY)

    def rates(self, equation: CertifiedEquation, squares: Numbers) -> list[arb]:
        """r_i."""
        found = [arb(0)] * len(squares)
        for k, form in equation.rates:
            found[k] = ball(squares[k]).sqrt() * self._value(form)
        return found


def _solved(w: list[list[arb]], r: list[list[arb]], free: Sequence[int] | None, n: int) -> list[list[arb]]:
    """The rows of E, then of P; of E alone where nothing is free."""
    m = len(r[0])
    others = [k for k in range(n) if free is None or k not in free]
    if len(w) != len(others) + (0 if free is None else m) or (free is None and m < n):
        raise InputError(_DEPENDENT)
    left = [
        [row[k] for k in others] + ([] if free is None else [-x for x in rates])
        for row, rates in zip(w, r, strict=True)
    ]
    right = r if free is None else [[-row[k] for k in free] for row in w]
    try:
        found = arb_mat(left).solve(arb_mat(right)).tolist()
    except ZeroDivisionError:
        raise InputError("certificate: the box is too wide, or the pose is or may be singular; give another") from None
    if free is None:
        return [list(row) for row in found]
    whole = [[arb(int(k == place)) for place in free] for k in range(n)]
    for line, place in zip(found, others, strict=False):
        whole[place] = list(line)
    return [*whole, *map(list, found[len(others) :])]


def _is_regular(w: list[list[arb]], r: list[list[arb]], *, forward: bool) -> bool:
    """Whether pivots exclude the singularities in the box that the solution of all equations does not exclude."""
    rows, rates = arb_mat(w), arb_mat(r)
    return is_definite(rates * rates.transpose() if forward else rows.transpose() * rows) is True

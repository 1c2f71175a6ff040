"""The equations of a robot's legs around a point, of the nominal robot or of all robots within tolerance.

For F the nominal equations and E what errors of the data do to them (``data_errors``), Krawczyk's operator is

    K(X, P) = m - Y (F(m) + E(m, P)) + (1 - Y F'(X, P)) (X - m)

and loses nothing in the parameters. If it lies in the interior of X, then for every p in P the box X holds exactly one
zero of F + E, and the Jacobian is regular there, all over X.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from flint import acb, acb_mat, arb, arb_mat

from pkm_exact.balls import Balls, unit_matrix
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.centred import NORM, CentredRobot, Chart, gradients, quantities, quantities_at
from pkm_exact.numeric.charts import chart_row, chart_values
from pkm_exact.numeric.data_errors import DataErrors, form_errors, leg_errors
from pkm_exact.numeric.krawczyk_operator import Equations, around_zero, contraction, holds_one, inflated

ENLARGEMENTS: Final = 16
"""Boxes tried one after another, each somewhat larger than the image of the one before."""
GROWTH: Final = 1.125
"""By how much a box is larger than the image that should lie in it."""
NEWTON_STEPS: Final = 40
SETTLED_BITS: Final = 30
"""The last step is this many bits smaller than a unit of the grid: which grid point is nearest is then certain."""


def chart_weights(chart: Chart, motion: Motion) -> list[acb]:
    """w on those of the coordinates of e that are not 0 for every motion."""
    return [acb(*chart[k]) for k in motion.rotation_support]


def centred_jacobian(robot: CentredRobot, forms: acb_mat, chart: Chart, slopes: acb_mat) -> acb_mat:
    """F' from the rows of the equations, the chart, and G."""
    motion = robot.problem.motion
    last = chart_row(chart_weights(chart, motion), motion)
    return acb_mat(robot.size, robot.size, (forms * slopes).entries() + last)


@dataclass(frozen=True, eq=False)
class Linearisation:
    """The equations of the nominal robot around a point (``krawczyk_operator.Equations``).

    Attributes
    ----------
    robot : CentredRobot
    chart : Chart
    centre : n x 1 matrix
        m, exact.
    inverse : n x n matrix
        Y, exact.
    values : n x 1 matrix
        F(m).
    quantities : list of 18 acb
        At m.
    """

    robot: CentredRobot
    chart: Chart
    centre: acb_mat
    inverse: acb_mat
    values: acb_mat
    quantities: list[acb]

    @cached_property
    def is_real(self) -> bool:
        """Whether chart and centre are real: then so is everything that is computed from them."""
        return all(v.imag == 0 for v in self.centre.entries()) and all(imaginary == 0 for _, imaginary in self.chart)

    @cached_property
    def residual(self) -> acb_mat:
        """Y F(m)."""
        return self.inverse * self.values

    def jacobian(self, box: acb_mat) -> acb_mat:
        """Y F'(X), with X given moved to 0."""
        return self.jacobian_of(self.robot.forms, box)

    def jacobian_of(self, forms: acb_mat, box: acb_mat) -> acb_mat:
        """The same for other rows of the equations."""
        slopes = gradients(self.centre + box, self.robot.problem.motion)[0]
        return self.inverse * centred_jacobian(self.robot, forms, self.chart, slopes)

    def around(self, radii: Sequence[arb]) -> Balls:
        """The box with these radii around m; a little larger where Arb rounds."""
        return self.centre + around_zero(self, radii)

    def with_errors(self, errors: DataErrors | None) -> Equations:
        """The equations of all robots with such errors in their data; None stands for no error."""
        if errors is None:
            return self
        totals = [leg.total for leg in leg_errors(self.robot, errors, self.quantities)]
        padded = [acb(0)] * (self.robot.size - 1 - len(totals)) + totals + [acb(0)]
        residual = self.inverse * (self.values + acb_mat(self.robot.size, 1, padded))
        return TolerantEquations(self, self.robot.forms + form_errors(self.robot, errors), residual)


@dataclass(frozen=True, eq=False)
class TolerantEquations:
    """The equations of all robots within tolerance around a point (``krawczyk_operator.Equations``).

    Attributes
    ----------
    nominal : Linearisation
    forms : (n - 1) x 18 matrix
        The rows of the equations.
    residual : n x 1 matrix
        Y (F(m) + E(m, P)).
    """

    nominal: Linearisation
    forms: acb_mat
    residual: acb_mat

    @property
    def is_real(self) -> bool:
        """Whether the point is real."""
        return self.nominal.is_real

    def jacobian(self, box: acb_mat) -> acb_mat:
        """Y F'(X, P), with X given moved to 0."""
        return self.nominal.jacobian_of(self.forms, box)


def linearise(robot: CentredRobot, chart: Chart, centre: acb_mat) -> Linearisation | None:
    """The linearisation at an exact point; None if the Jacobian cannot be inverted."""
    slopes = gradients(centre, robot.problem.motion)[0]
    jacobian = centred_jacobian(robot, robot.forms, chart, slopes)
    try:
        inverse = jacobian.inv().mid()
    except ZeroDivisionError:
        return None
    return Linearisation(robot, chart, centre, inverse, chart_values(jacobian, centre), quantities(slopes, centre))


def refined(robot: CentredRobot, chart: Chart, point: acb_mat, exponent: int) -> acb_mat | None:
    """The limit of Newton's method, to a small part of 2^-exponent; None without convergence."""
    point = point.mid()
    for _ in range(NEWTON_STEPS):
        jacobian = centred_jacobian(robot, robot.forms, chart, gradients(point, robot.problem.motion)[0])
        try:
            step = jacobian.solve(chart_values(jacobian, point), algorithm="approx").mid()
        except ZeroDivisionError:
            return None
        point = (point - step).mid()
        size = max(abs(v).upper() for v in point.entries())
        if not size.is_finite():
            return None
        if max(abs(v).upper() for v in step.entries()) < arb(2) ** -(exponent + SETTLED_BITS):
            return point
    return None


def inverse_jacobians(near: Linearisation, errors: DataErrors | None, radii: Sequence[arb]) -> arb_mat | None:
    """Enclosures of the inverses V of the matrices in F'(X, P), real; None if one may be singular.

    With M = 1 - Y F' they are V = Y + M Y + M^2 Y + .., so V - Y is at most (1 - |M|)^-1 |M| |Y|, for |M| the matrix of
    upper bounds, if its spectral radius is below 1: then the sum of its powers is that inverse, and not negative.
    """
    size, equations = near.robot.size, near.with_errors(errors)
    left = contraction(equations, around_zero(equations, radii))
    bounds = arb_mat(size, size, [value.real.abs_upper() for value in left.entries()])
    inverse = arb_mat(size, size, [value.real for value in near.inverse.entries()])
    try:
        powers = (unit_matrix(size) - bounds).inv()
    except ZeroDivisionError:
        return None
    if not all(value.is_finite() and value >= 0 for value in powers.entries()):
        return None
    reaches = powers * bounds * arb_mat(size, size, [abs(value) for value in inverse.entries()])
    return inverse + arb_mat(size, size, [arb(0, value.upper()) for value in reaches.entries()])


def enclosing_radii(near: Linearisation, errors: DataErrors | None, exponent: int) -> Sequence[arb] | None:
    """Radii, on the grid 2^-exponent, of a small box that Krawczyk's operator maps into its interior.

    Starts with the enlargement of first order, |Y (F(m) + E(m, P))|. None if no such box was found.
    """

    def enlarged(values: Sequence[acb]) -> list[arb]:
        sizes = (abs(value.real).max(abs(value.imag)).upper() for value in values)
        return [up(GROWTH * size, exponent) for size in sizes]

    equations = near.with_errors(errors)
    found = inflated(equations, enlarged(equations.residual.entries()), enlarged, ENLARGEMENTS)
    return None if found is None else found[0]


def is_proved(near: Linearisation, errors: DataErrors | None, radii: Sequence[arb]) -> bool:
    """Whether the box with these radii holds exactly one solution for every robot, and N(e) is not 0 in it."""
    if not holds_one(near.with_errors(errors), radii):
        return False
    return not quantities_at(near.around(radii), near.robot.problem.motion)[NORM].contains(0)


def up(value: arb, exponent: int) -> arb:
    """The least number on the grid 2^-exponent above a number that is not negative."""
    unit = arb(2) ** exponent
    return ((value.upper() * unit).ceil().upper() + 1) / unit


def rounded(point: acb_mat, exponent: int) -> acb_mat:
    """The nearest point of the grid 2^-exponent."""
    entries = [acb(_rounded(v.real, exponent), _rounded(v.imag, exponent)) for v in point.entries()]
    return acb_mat(point.nrows(), 1, entries)


def _rounded(value: arb, exponent: int) -> arb:
    unit = arb(2) ** exponent
    return (value.mid() * unit + arb(0.5)).floor().mid() / unit

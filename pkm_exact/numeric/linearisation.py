"""The equations of a robot's legs around a point, of the nominal robot or of all robots within tolerance.

For F the nominal equations and E what errors of the data do to them (``data_errors``), Krawczyk's operator is

    K(X, P) = m - Y (F(m) + E(m, P)) + (1 - Y F'(X, P)) (X - m)

and loses nothing in the parameters at m. The equations of every robot are quadrics, F(x) = x^T Q x and so on, so that

    Y F'(X) = Y F'(m) + (2 Y Q) (X - m),

where 2 Y Q is computed before a box comes in: a sum of balls does not know which of them are one unknown, and may be
wider by a factor of 60. As F_p(x) - F_p(m) = F_p'((x + m) / 2) (x - m), F' on the box of half the size is enough to
show a zero in X (``Slopes``), and F' on X to show that there is no second one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from flint import acb, acb_mat, arb, arb_mat

from pkm_exact.balls import Balls, unit_matrix
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.centred import (
    NORM,
    CentredRobot,
    Chart,
    gradients,
    gradients_of_gradients,
    quantities,
    quantities_at,
)
from pkm_exact.numeric.charts import chart_row, chart_values
from pkm_exact.numeric.data_errors import DataErrors, leg_errors
from pkm_exact.numeric.krawczyk_operator import around_zero, contraction, inflated, is_inside, krawczyk

ENLARGEMENTS: Final = 16
"""Boxes tried one after another, each somewhat larger than the image of the one before."""
GROWTH: Final = 1.125
"""By how much a box is larger than the image that should lie in it."""
NARROWINGS: Final = 6
"""Times that a box is replaced by what may hold its solutions. Checkers do so oftener."""
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

    @cached_property
    def slope(self) -> acb_mat:
        """Y F'(m)."""
        slopes = gradients(self.centre, self.robot.problem.motion)[0]
        return self.inverse * centred_jacobian(self.robot, self.robot.forms, self.chart, slopes)

    @cached_property
    def curvature(self) -> acb_mat:
        """Derivatives of Y F' by x, n^2 x n: for every entry of that matrix, row by row, a row."""
        size = self.robot.size
        quadrics = acb_mat(gradients_of_gradients(self.robot.problem.motion))
        rows = (self.robot.forms * quadrics).entries() + [acb(0)] * size**2
        return acb_mat(size**2, size, (self.inverse * acb_mat(size, size**2, rows)).entries())

    def jacobian(self, box: acb_mat) -> acb_mat:
        """Y F'(X), with X given moved to 0."""
        size = self.robot.size
        return self.slope + acb_mat(size, size, (self.curvature * box).entries())

    def around(self, radii: Sequence[arb]) -> Balls:
        """The box with these radii around m; a little larger where Arb rounds."""
        return self.centre + around_zero(self, radii)

    def with_errors(self, errors: DataErrors | None) -> Linearisation | TolerantEquations:
        """The equations of all robots with such errors in their data; None stands for no error."""
        if errors is None:
            return self
        totals = [leg.total for leg in leg_errors(self.robot, errors, self.quantities)]
        residual = self.inverse * (self.values + padded(totals, self.robot.size))
        return TolerantEquations(self, errors, residual)


@dataclass(frozen=True, eq=False)
class TolerantEquations:
    """The equations of all robots within tolerance around a point (``krawczyk_operator.Equations``).

    Attributes
    ----------
    nominal : Linearisation
    errors : DataErrors
    residual : n x 1 matrix
        Y (F(m) + E(m, P)).
    """

    nominal: Linearisation
    errors: DataErrors
    residual: acb_mat

    @property
    def is_real(self) -> bool:
        """Whether the point is real."""
        return self.nominal.is_real

    def jacobian(self, box: acb_mat) -> acb_mat:
        """Y F'(X, P), with X given moved to 0. E is linear in the quantities: its derivatives are E of theirs."""
        near, robot = self.nominal, self.nominal.robot
        slopes = gradients(near.centre + box, robot.problem.motion)[0].transpose().tolist()
        columns = [[leg.total for leg in leg_errors(robot, self.errors, column)] for column in slopes]
        changes = [padded(column, robot.size).entries() for column in columns]
        return near.jacobian(box) + near.inverse * acb_mat(changes).transpose()


def padded(legs: Sequence[acb], size: int) -> acb_mat:
    """Values of the equations of the legs as a column, 0 for the other equations."""
    return acb_mat(size, 1, [acb(0)] * (size - 1 - len(legs)) + [*legs, acb(0)])


@dataclass(frozen=True, eq=False)
class Slopes:
    """Equations that are quadrics, with F'((X + m) / 2) in place of F'(X) (``krawczyk_operator.Equations``).

    F(x) - F(m) = F'((x + m) / 2) (x - m), so that x -> x - Y F(x) maps a box X into its image: if that lies in X, there
    is a zero in it, and every zero in X lies in the image. It need not be the only one.
    """

    equations: Linearisation | TolerantEquations

    @property
    def is_real(self) -> bool:
        """Whether the point is real."""
        return self.equations.is_real

    @property
    def residual(self) -> acb_mat:
        """Y F(m)."""
        return self.equations.residual

    def jacobian(self, box: acb_mat) -> acb_mat:
        """Y F'((X + m) / 2), with X given moved to 0."""
        return self.equations.jacobian(box / 2)


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
    """Enclosures of the inverses V of the matrices in F'((X + m) / 2, P), real; None if one may be singular.

    With M = 1 - Y F' they are V = Y + M Y + M^2 Y + .., so V - Y is at most (1 - |M|)^-1 |M| |Y|, for |M| the matrix of
    upper bounds, if its spectral radius is below 1: then the sum of its powers is that inverse, and not negative.
    """
    left = contraction(Slopes(near.with_errors(errors)), around_zero(near, radii))
    bounds = arb_mat([[value.real.abs_upper() for value in row] for row in left.tolist()])
    powers = sum_of_powers(bounds)
    if powers is None:
        return None
    inverse = arb_mat([[value.real for value in row] for row in near.inverse.tolist()])
    reaches = powers * bounds * arb_mat([[abs(value) for value in row] for row in inverse.tolist()])
    return inverse + arb_mat([[arb(0, value.upper()) for value in row] for row in reaches.tolist()])


def sum_of_powers(bounds: arb_mat) -> arb_mat | None:
    """1 + B + B^2 + .. of a matrix that is not negative; None if its spectral radius may not be below 1."""
    try:
        powers = (unit_matrix(bounds.nrows()) - bounds).inv()
    except ZeroDivisionError:
        return None
    # An inverse that is not negative is that sum: (1 - B)^-1 = 1 + .. + B^k + B^(k+1) (1 - B)^-1, term by term bounded.
    return powers if all(value.is_finite() and value >= 0 for value in powers.entries()) else None


def enclosing_radii(near: Linearisation, errors: DataErrors | None, exponent: int) -> Sequence[arb] | None:
    """Radii, on the grid 2^-exponent, of a small box in whose interior there is a solution of every robot.

    Starts with the enlargement of first order, |Y (F(m) + E(m, P))|. None if no such box was found.
    """

    def enlarged(values: Sequence[acb]) -> list[arb]:
        sizes = (abs(value.real).max(abs(value.imag)).upper() for value in values)
        return [up(GROWTH * size, exponent) for size in sizes]

    equations = Slopes(near.with_errors(errors))
    found = inflated(equations, enlarged(equations.residual.entries()), enlarged, ENLARGEMENTS)
    return None if found is None else found[0]


def is_proved(near: Linearisation, errors: DataErrors | None, radii: Sequence[arb]) -> bool:
    """Whether the box with these radii holds exactly one solution for every robot, and N(e) is not 0 in it."""
    equations = near.with_errors(errors)
    image = krawczyk(Slopes(equations), around_zero(near, radii))
    return is_inside(equations, image, radii) and has_at_most_one(near, errors, radii)


def has_at_most_one(near: Linearisation, errors: DataErrors | None, radii: Sequence[arb]) -> bool:
    """Whether no robot has two solutions in the box, and N(e) is not 0 in it.

    Where F' is regular all over a box there is one solution at most: F(x) - F(y) = F'((x + y) / 2) (x - y). Where that
    is not proved, a narrower box holds all solutions of the box: x - m = (x - m) - Y F(x) lies in the image of X. Of
    complex numbers, the bounds are those of absolute values.
    """
    if quantities_at(near.around(radii), near.robot.problem.motion)[NORM].contains(0):
        return False
    equations = near.with_errors(errors)
    for _ in range(NARROWINGS + 1):
        if _is_regular(equations, around_zero(near, radii)):
            return True
        image = krawczyk(Slopes(equations), around_zero(near, radii)).moved.entries()
        sizes = [abs(value.real).max(abs(value.imag)).upper() for value in image]
        if not any(size < radius for size, radius in zip(sizes, radii, strict=True)):
            return False
        radii = [radius.min(size).upper() for size, radius in zip(sizes, radii, strict=True)]
    return False


def _is_regular(equations: Linearisation | TolerantEquations, box: Balls) -> bool:
    """Whether F' is regular all over a box, given moved to 0, for every robot."""
    left = contraction(equations, box)
    return sum_of_powers(arb_mat([[value.abs_upper() for value in row] for row in left.tolist()])) is not None


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

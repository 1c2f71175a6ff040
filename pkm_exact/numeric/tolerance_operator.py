"""Krawczyk's operator with parameters: proof that a box holds exactly one pose for every robot within tolerance.

Let E_i(x, p) be by how much the equation of leg i changes if its data A, B, l are off by a, b, t. With d = C + R B - A,

    E_i = N(e) (2 d.(R b - a) - 2 l t + |R b - a|^2 - t^2)

exactly. Every leg has data of its own, so at a point x the E_i fill a box independently, and for any matrix Y

    K(X, P) = m - Y (F(m) + E(m, P)) + (1 - Y F'(X, P)) (X - m)

loses nothing in the parameters. If it lies in the interior of X, then for every p in P the box X holds exactly one zero
of F + E, and the Jacobian is regular there, all over X.

References: Krawczyk, Computing 4 (1969); Neumaier, Interval Methods for Systems of Equations (1990), section 5.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from flint import acb, acb_mat, arb, arb_mat

from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric import centred
from pkm_exact.numeric.centred import (
    CentredRobot,
    Chart,
    ball,
    gradients,
    identity,
    quantities,
    system_jacobian,
    system_values,
    with_chart,
)

ENLARGEMENTS: Final = 16
"""Boxes tried one after another, each somewhat larger than the image of the one before."""
GROWTH: Final = 1.125
"""By how much a box is larger than the image that should lie in it."""
NEWTON_STEPS: Final = 40
SETTLED_BITS: Final = 30
"""The last step is this many bits smaller than a unit of the grid: which grid point is nearest is then certain."""


@dataclass(frozen=True)
class DataErrors:
    """Bounds of the errors of the data, as balls around 0 in the centred unit; None stands for no error.

    Attributes
    ----------
    base, platform, lengths : arb
    """

    base: arb
    platform: arb
    lengths: arb


def data_errors(robot: CentredRobot, tolerances: Tolerances) -> DataErrors:
    """The tolerances in the centred unit of length."""
    unit = robot.frames.unit
    return DataErrors(
        *(_around_zero(ball(t / unit)) for t in (tolerances.base, tolerances.platform, tolerances.lengths))
    )


def _around_zero(bound: arb) -> arb:
    return arb(0, bound.abs_upper())


@dataclass(frozen=True)
class LegErrors:
    """What the errors of a leg's data do to its equation at a point.

    Attributes
    ----------
    influences : tuple of acb
        Derivatives by the data: base joint, platform joint, length.
    bounds : tuple of arb
        Of the data, in the same order: balls around 0.
    rest : acb
        Bounds for the terms of second order.
    """

    influences: tuple[acb, ...]
    bounds: tuple[arb, ...]
    rest: acb

    @property
    def linear(self) -> acb:
        """Bounds for the terms of first order."""
        terms = (value * bound for value, bound in zip(self.influences, self.bounds, strict=True))
        return sum(terms, acb(0))

    @property
    def total(self) -> acb:
        """Bounds for E_i."""
        return self.linear + self.rest


def leg_errors(robot: CentredRobot, errors: DataErrors, values: Sequence[acb]) -> list[LegErrors]:
    """The E_i at a point (or in a box), from the quantities there."""
    axes = range(2 if robot.problem.motion.is_planar else 3)
    norm = values[centred.NORM]
    position, turned = values[centred.POSITION : centred.ROTATION], values[centred.TURNED : centred.POSITION]
    rotation = [values[centred.ROTATION + 3 * i : centred.ROTATION + 3 * i + 3] for i in range(3)]
    square = sum((errors.base * errors.base + errors.platform * errors.platform for _ in axes), arb(0))
    mixed = sum((2 * rotation[j][k] * (errors.base * errors.platform) for j in axes for k in axes), acb(0))
    rest = norm * (square - errors.lengths * errors.lengths) - mixed
    found = []
    for a, b, length in zip(robot.base, robot.platform, robot.lengths, strict=True):
        line = [position[j] + sum((rotation[j][k] * b[k] for k in axes), acb(0)) - a[j] * norm for j in axes]
        # N R^-1 d = N (u + B - R^-1 A)
        back = [turned[k] + b[k] * norm - sum((rotation[j][k] * a[j] for j in axes), acb(0)) for k in axes]
        influences = (*(-2 * v for v in line), *(2 * v for v in back), -2 * length * norm)
        bounds = (*(errors.base for _ in axes), *(errors.platform for _ in axes), errors.lengths)
        found.append(LegErrors(influences, bounds, rest))
    return found


def form_errors(robot: CentredRobot, errors: DataErrors) -> acb_mat:
    """By how much the rows of the legs may change."""
    zero = arb(0)
    third = zero if robot.problem.motion.is_planar else arb(1)
    da = [errors.base, errors.base, errors.base * third]
    db = [errors.platform, errors.platform, errors.platform * third]
    rows = [] if robot.problem.motion.is_planar else [[zero] * centred.QUANTITIES]
    for a, b, length in zip(robot.base, robot.platform, robot.lengths, strict=True):
        row = [zero, *(2 * v for v in db), *(-2 * v for v in da)]
        row += [-2 * (a[i] * db[j] + da[i] * b[j] + da[i] * db[j]) for i in range(3) for j in range(3)]
        constant = sum((2 * v * dv + dv * dv for v, dv in zip((*a, *b), (*da, *db), strict=True)), zero)
        row += [constant - 2 * length * errors.lengths - errors.lengths * errors.lengths, zero]
        rows.append(row)
    return acb_mat(arb_mat(rows))


@dataclass(frozen=True, eq=False)
class Linearisation:
    """The equations around a point: what Krawczyk's operator needs.

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

    @property
    def is_real(self) -> bool:
        """Whether chart and centre are real: then so is everything that is computed from them."""
        return all(v.imag == 0 for v in self.centre.entries()) and all(imaginary == 0 for _, imaginary in self.chart)


def middle(matrix: acb_mat) -> acb_mat:
    """The midpoints of the entries, exact."""
    entries = [acb(entry.real.mid(), entry.imag.mid()) for entry in matrix.entries()]
    return acb_mat(matrix.nrows(), matrix.ncols(), entries)


def linearise(robot: CentredRobot, chart: Chart, centre: acb_mat) -> Linearisation | None:
    """The linearisation at an exact point; None if the Jacobian cannot be inverted."""
    slopes = gradients(centre)
    jacobian = system_jacobian(robot.forms, slopes, chart)
    try:
        inverse = middle(jacobian.inv())
    except ZeroDivisionError:
        return None
    return Linearisation(robot, chart, centre, inverse, system_values(jacobian, centre), quantities(slopes, centre))


def refined(robot: CentredRobot, chart: Chart, point: acb_mat, exponent: int) -> acb_mat | None:
    """The limit of Newton's method, to a small part of 2^-exponent; None without convergence."""
    point = middle(point)
    for _ in range(NEWTON_STEPS):
        jacobian = system_jacobian(robot.forms, gradients(point), chart)
        try:
            step = middle(jacobian.solve(system_values(jacobian, point), algorithm="approx"))
        except ZeroDivisionError:
            return None
        point = middle(point - step)
        size = max(abs(v).upper() for v in point.entries())
        if not size.is_finite():
            return None
        if max(abs(v).upper() for v in step.entries()) < arb(2) ** -(exponent + SETTLED_BITS):
            return point
    return None


def spread(radii: Sequence[arb], *, real: bool) -> acb_mat:
    """Balls around 0 with these radii, in the real and the imaginary part; a little larger where Arb rounds."""
    balls = [arb(0, radius) for radius in radii]
    return acb_mat(len(balls), 1, [acb(value, arb(0) if real else value) for value in balls])


def values_with_errors(near: Linearisation, errors: DataErrors | None) -> acb_mat:
    """F(m) + E(m, P)."""
    if errors is None:
        return near.values
    totals = [leg.total for leg in leg_errors(near.robot, errors, near.quantities)]
    size = near.robot.size
    padded = [acb(0)] * (size - 1 - len(totals)) + totals + [acb(0)]
    return near.values + acb_mat(size, 1, padded)


def jacobian_in(near: Linearisation, box: acb_mat, changed: acb_mat | None) -> acb_mat:
    """F'(X, P), with X given moved to 0, and the errors of the forms if there are any."""
    slopes = gradients(near.centre + box)
    forms = near.robot.forms if changed is None else near.robot.forms + changed
    return with_chart(forms * slopes, near.chart)


def inverse_jacobians(near: Linearisation, box: acb_mat, changed: acb_mat | None) -> arb_mat | None:
    """Enclosures of the inverses V of the matrices in F'(X, P), real; None if one may be singular.

    With M = 1 - Y F' they are V = Y + M Y + M^2 Y + .., so V - Y is at most (1 - |M|)^-1 |M| |Y|, for |M| the matrix of
    upper bounds, if its spectral radius is below 1: then the sum of its powers is that inverse, and not negative.
    """
    size = near.robot.size
    contraction = identity(size) - near.inverse * jacobian_in(near, box, changed)
    bounds = arb_mat(size, size, [value.real.abs_upper() for value in contraction.entries()])
    inverse = arb_mat(size, size, [value.real for value in near.inverse.entries()])
    try:
        powers = (arb_mat([[int(i == j) for j in range(size)] for i in range(size)]) - bounds).inv()
    except ZeroDivisionError:
        return None
    if not all(value.is_finite() and value >= 0 for value in powers.entries()):
        return None
    reaches = powers * bounds * arb_mat(size, size, [abs(value) for value in inverse.entries()])
    return inverse + arb_mat(size, size, [arb(0, value.upper()) for value in reaches.entries()])


def image(near: Linearisation, box: acb_mat, right: acb_mat, changed: acb_mat | None) -> list[acb]:
    """K(X, P) - m."""
    contraction = identity(near.robot.size) - near.inverse * jacobian_in(near, box, changed)
    return (contraction * box - near.inverse * right).entries()


def is_inside(values: Sequence[acb], radii: Sequence[arb], *, real: bool) -> bool:
    """Whether the values lie in the interior of the box with these radii around 0."""
    return all(
        abs(value.real) < radius and (value.imag == 0 if real else abs(value.imag) < radius)
        for value, radius in zip(values, radii, strict=True)
    )


def enclosing_radii(near: Linearisation, errors: DataErrors | None, exponent: int) -> list[arb] | None:
    """Radii, on the grid 2^-exponent, of a small box that Krawczyk's operator maps into its interior.

    Starts with the enlargement of first order, |Y (F(m) + E(m, P))|. None if no such box was found.
    """
    right = values_with_errors(near, errors)
    changed = None if errors is None else form_errors(near.robot, errors)
    radii = enlarged((near.inverse * right).entries(), exponent)
    for _ in range(ENLARGEMENTS):
        found = image(near, spread(radii, real=near.is_real), right, changed)
        if is_inside(found, radii, real=near.is_real):
            return radii
        radii = enlarged(found, exponent)
        if not all(radius < 1 for radius in radii):
            return None
    return None


def holds_one(near: Linearisation, errors: DataErrors | None, radii: Sequence[arb]) -> bool:
    """Whether the box with these radii holds exactly one solution for every robot, and N(e) is not 0 in it."""
    right = values_with_errors(near, errors)
    changed = None if errors is None else form_errors(near.robot, errors)
    box = spread(radii, real=near.is_real)
    if not is_inside(image(near, box, right, changed), radii, real=near.is_real):
        return False
    around = near.centre + box
    return not quantities(gradients(around), around)[centred.NORM].contains(0)


def enlarged(values: Sequence[acb], exponent: int) -> list[arb]:
    """Radii on a grid of a box around 0 that has the values well inside."""
    sizes = (abs(value.real).max(abs(value.imag)).upper() for value in values)
    return [up(GROWTH * size, exponent) for size in sizes]


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

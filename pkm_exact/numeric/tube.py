"""One certified step along a path: a tube that holds exactly one solution for every path parameter of the step.

On |t| <= h around the middle of a step, the tube is x(t) + B with x(t) = m + v t + a t^2 and a box B around 0. With
F(x, t) the equations, quadrics in x with coefficients of degree 2 in t, and any matrix Y,

    K_t(B) = - Y F(x(t), t) + (1 - Y F'(x(t) + B, t)) B.

If it lies in the interior of B for all |t| <= h, each t has exactly one solution in its slice of the tube, the Jacobian
is regular all over the tube, and so these solutions form one smooth branch. F(x(t), t) and F' are polynomials in t;
their coefficients are computed first, so that what cancels does so before intervals are put in.

m, v, a and Y come from floating point and prove nothing by themselves.

References: Krawczyk, Computing 4 (1969); Kearfott and Xing, "An interval step control for continuation methods", SIAM
J. Numer. Anal. 31 (1994).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Final

import numpy as np
from flint import arb, arb_mat
from numpy.typing import NDArray

from pkm_exact.motions.motion import Motion
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.numeric.centred import QUANTITIES, ball, gradient_forms
from pkm_exact.numeric.path_forms import PathForms

Real = NDArray[np.float64]

NEWTON_STEPS: Final = 8
SMALL: Final = 1e-8
"""A Newton step this small, relative to the point, ends the iteration: what is left is its square, or noise."""
ENLARGEMENTS: Final = 4
GROWTH: Final = 1.25
ROOM: Final = 1.0625
"""By how much more than the entering box the tube is wide where it begins."""
FLOOR: Final = 2.0**-46
"""Least half width of a tube, relative to the point: room for the rounding of m, v and a."""


@dataclass(frozen=True, eq=False)
class Tube:
    """A proved step.

    Attributes
    ----------
    weights : list of int
        w, on the coordinates of e.
    leaving : arb_mat
        A column of balls that hold the branch at the end of the step.
    radii : list of arb
        Half widths of the tube.
    end : arb_mat
        x(h).
    contraction : float
        How much of the width of the box the operator leaves: small if a longer step might do.
    """

    weights: list[int]
    leaving: arb_mat
    radii: list[arb]
    end: arb_mat
    contraction: float

    def holds(self, point: arb_mat) -> bool:
        """Whether a ball, in the chart of the tube, lies in its last slice."""
        return _fits(point, self.end, self.radii)


def _fits(point: arb_mat, centre: arb_mat, radii: Sequence[arb]) -> bool:
    return all(abs(d) <= r for d, r in zip((point - centre).entries(), radii, strict=True))


@cache
def _float_forms(motion: Motion) -> Real:
    """2 M_k as an array (18, n, n)."""
    size = len(motion.support)
    entries = gradient_forms(motion).entries()
    return np.array([int(value) for value in entries], dtype=float).reshape(QUANTITIES, size, size)


def real_gradients(points: arb_mat) -> list[arb_mat]:
    """G at points that are the columns of a matrix: an 18 x n matrix each."""
    size, count = points.nrows(), points.ncols()
    product = arb_mat(gradient_forms(PLANAR if size == len(PLANAR.support) else SPATIAL)) * points
    entries = product.transpose().entries()
    stride = QUANTITIES * size
    return [arb_mat(QUANTITIES, size, entries[k * stride : (k + 1) * stride]) for k in range(count)]


def weights_at(point: Real) -> list[int]:
    """w near e: the chart in which |e| is small and in no direction far."""
    e = point[: len(point) // 2]
    return [int(value) for value in np.rint(32 * e / np.linalg.norm(e))]


def in_weights(point: arb_mat, weights: Sequence[int]) -> arb_mat:
    """The same projective point with w.e = 1."""
    product = sum((w * point[k, 0] for k, w in enumerate(weights)), arb(0))
    return arb_mat(point.nrows(), 1, [value / product for value in point.entries()])


@dataclass(frozen=True, eq=False)
class Prediction:
    """m, v, a and Y in floating point, and the chart."""

    weights: list[int]
    point: Real
    first: Real
    second: Real
    inverse: Real


def floats(matrix: arb_mat) -> Real:
    """The midpoints, rounded."""
    return np.array([float(value.mid()) for value in matrix.entries()]).reshape(matrix.nrows(), matrix.ncols())


@dataclass(frozen=True, eq=False)
class FloatPath:
    """The equations between two rows, in balls and in floating point."""

    forms: PathForms
    coefficients: tuple[Real, Real, Real]

    @staticmethod
    def of(forms: PathForms) -> FloatPath:
        """Both, from balls."""
        first, second, third = (floats(matrix) for matrix in forms.coefficients)
        return FloatPath(forms, (first, second, third))


def predict(path: FloatPath, near: Real, middle: float) -> Prediction | None:
    """The solution at the middle of a step and the Taylor polynomial of the branch there; None without convergence."""
    size = len(near)
    forms = _float_forms(PLANAR if size == len(PLANAR.support) else SPATIAL)
    weights = weights_at(near)
    chart = np.zeros(size)
    chart[: len(weights)] = weights
    x = near / (chart @ near)
    zeroth, first, second = path.coefficients
    upper = zeroth + middle * first + middle * middle * second
    slope = first + 2 * middle * second
    try:
        for _ in range(NEWTON_STEPS):
            gradients = forms @ x
            jacobian = np.vstack([upper @ gradients, chart])
            values = np.append(upper @ (gradients @ x) / 2, chart @ x - 1)
            step = np.linalg.solve(jacobian, values)
            x = x - step
            if np.abs(step).max() < SMALL * np.abs(x).max():
                break
        else:
            return None
        gradients = forms @ x
        inverse = np.linalg.inv(np.vstack([upper @ gradients, chart]))
    except np.linalg.LinAlgError:
        return None
    v = -inverse @ np.append(slope @ (gradients @ x) / 2, 0)
    along = forms @ v
    bent = upper @ (along @ v) / 2 + slope @ (along @ x) + second @ (gradients @ x) / 2
    a = -inverse @ np.append(bent, 0)
    if not all(np.isfinite(values).all() for values in (x, v, a, inverse)):
        return None
    return Prediction(weights, x, v, a, inverse)


def prove(path: FloatPath, prediction: Prediction, entering: arb_mat, middle: Fraction, half: Fraction) -> Tube | None:
    """The tube over [middle - half, middle + half], if it is proved and holds the entering box at its beginning.

    Parameters
    ----------
    path : FloatPath
    prediction : Prediction
        At the middle.
    entering : arb_mat
        Balls that hold the branch at the beginning, in any chart.
    middle, half : Fraction
        Dyadic.
    """
    m, v, a = (_column(values) for values in (prediction.point, prediction.first, prediction.second))
    h = ball(half)
    both, square = arb(0, h), (h * h) * arb(0.5, 0.5)
    expansion = _expand(path.forms, prediction, (m, v, a), ball(middle))
    residual = expansion.residual(both, square)
    start = in_weights(entering, prediction.weights) - (m - h * v + (h * h) * a)
    # The box must hold what enters, whatever the operator makes of it.
    least = [ROOM * abs(d).upper() + FLOOR * abs(c).upper() for d, c in zip(start.entries(), m.entries(), strict=True)]
    contraction = expansion.contraction(both, square)
    radii = [(2 * abs(r)).max(b).upper() for r, b in zip(residual.entries(), least, strict=True)]
    for _ in range(ENLARGEMENTS):
        box = arb_mat(len(radii), 1, [arb(0, r) for r in radii])
        left = (contraction - expansion.widened(box, both, square)) * box
        image = (left - residual).entries()
        if all(abs(value) < r for value, r in zip(image, radii, strict=True)):
            end = m + h * v + (h * h) * a
            share = max(float((abs(value) / r).upper()) for value, r in zip(left.entries(), radii, strict=True))
            return Tube(prediction.weights, end + arb_mat(len(radii), 1, image), radii, end, share)
        radii = [(GROWTH * abs(value)).max(b).upper() for value, b in zip(image, least, strict=True)]
        if not all(r < 1 for r in radii):
            return None
    return None


def station(path: FloatPath, prediction: Prediction, at: Fraction) -> arb_mat | None:
    """Balls around the predicted point that hold exactly one solution for this one parameter; None if not proved."""
    tube = prove(path, prediction, _column(prediction.point), at, Fraction(0))
    return None if tube is None else tube.leaving


def _square(values: Real) -> arb_mat:
    size = len(values)
    return arb_mat(size, size, [arb(value) for value in values.ravel().tolist()])


def _unit(size: int) -> arb_mat:
    return arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])


def _column(values: Real) -> arb_mat:
    return arb_mat(len(values), 1, [arb(value) for value in values.tolist()])


@dataclass(frozen=True, eq=False)
class _Expansion:
    """Coefficients of powers of t: of Y F(x(t), t), of Y F'(x(t), t), and of the rows of the equations."""

    values: list[arb_mat]
    jacobians: list[arb_mat]
    rows: tuple[arb_mat, arb_mat, arb_mat]
    inverse: arb_mat

    def residual(self, both: arb, square: arb) -> arb_mat:
        """Bounds for Y F(x(t), t)."""
        return _polynomial(self.values, both, square)

    def contraction(self, both: arb, square: arb) -> arb_mat:
        """Bounds for 1 - Y F'(x(t), t)."""
        return _unit(self.inverse.nrows()) - _polynomial(self.jacobians, both, square)

    def widened(self, box: arb_mat, both: arb, square: arb) -> arb_mat:
        """Bounds for Y (F'(x(t) + B, t) - F'(x(t), t))."""
        upper = _polynomial(list(self.rows), both, square) * real_gradients(box)[0]
        return self.inverse * _padded(upper)


def _polynomial(coefficients: Sequence[arb_mat], both: arb, square: arb) -> arb_mat:
    """Bounds for the sum of the coefficients times powers of t; ``square`` bounds t^2."""
    total, power = coefficients[0], arb(1)
    for k, coefficient in enumerate(coefficients[1:], 1):
        if k % 2:
            total = total + coefficient * (power * both)
        else:
            power = power * square
            total = total + coefficient * power
    return total


def _padded(upper: arb_mat) -> arb_mat:
    """A row of zeros below: that of the chart, which does not change."""
    return arb_mat(upper.nrows() + 1, upper.ncols(), upper.entries() + [arb(0)] * upper.ncols())


def _expand(forms: PathForms, prediction: Prediction, curve: tuple[arb_mat, ...], middle: arb) -> _Expansion:
    size = len(prediction.point)
    inverse = _square(prediction.inverse)
    zeroth, first, second = forms.coefficients
    rows = (zeroth + middle * first + (middle * middle) * second, first + (2 * middle) * second, second)
    m, v, a = curve
    slopes = real_gradients(arb_mat([column.entries() for column in curve]).transpose())
    gm, gv, ga = slopes
    quantities = [gm * m, 2 * (gm * v), 2 * (gm * a) + gv * v, 2 * (gv * a), ga * a]
    values = [
        inverse * _with_last(total * arb(0.5), last)
        for total, last in zip(_product(rows, quantities), _chart_values(prediction.weights, curve), strict=True)
    ]
    jacobians = [_padded(total) for total in _product(rows, slopes)]
    chart = [arb(w) for w in prediction.weights] + [arb(0)] * (size - len(prediction.weights))
    jacobians[0] = arb_mat(size, size, jacobians[0].entries()[:-size] + chart)
    return _Expansion(values, [inverse * matrix for matrix in jacobians], rows, inverse)


def _product(rows: Sequence[arb_mat], factors: Sequence[arb_mat]) -> list[arb_mat]:
    """The coefficients of a product of polynomials."""
    found: list[arb_mat | None] = [None] * (len(rows) + len(factors) - 1)
    for i, row in enumerate(rows):
        for j, factor in enumerate(factors):
            term, sofar = row * factor, found[i + j]
            found[i + j] = term if sofar is None else sofar + term
    return [total for total in found if total is not None]


def _chart_values(weights: Sequence[int], curve: Sequence[arb_mat]) -> list[arb]:
    """w.x(t) - 1, as many coefficients as F has."""
    sums = [sum((w * column[k, 0] for k, w in enumerate(weights)), arb(0)) for column in curve]
    return [sums[0] - 1, *sums[1:], *[arb(0)] * 4]


def _with_last(column: arb_mat, last: arb) -> arb_mat:
    return arb_mat(column.nrows() + 1, 1, [*column.entries(), last])

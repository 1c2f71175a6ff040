"""The equations along a step of a path, around a curve that is near the branch there.

With F(x, t) quadrics in x with coefficients of degree 2 in t, and x(t) = m + v t + a t^2, both F(x(t), t) and
F'(x(t), t) are polynomials in t. Their coefficients are multiplied by Y first, so that what cancels does so before an
interval is put in for t.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from flint import arb, arb_mat

from pkm_exact.numeric.centred import gradients
from pkm_exact.numeric.charts import chart_row
from pkm_exact.numeric.path_forms import PathForms

Curve: TypeAlias = tuple[arb_mat, arb_mat, arb_mat]
"""m, v and a, columns."""


@dataclass(frozen=True, eq=False)
class PathEquations:
    """The equations around a curve, for all |t| <= h (``krawczyk_operator.Equations``).

    Attributes
    ----------
    forms : PathForms
    rows : (n - 1) x 18 matrix
        Bounds for the rows of the equations.
    inverse : n x n matrix
        Y.
    residual : n x 1 matrix
        Bounds for Y F(x(t), t).
    on_curve : n x n matrix
        Bounds for Y F'(x(t), t).
    is_real : True
    """

    forms: PathForms
    rows: arb_mat
    inverse: arb_mat
    residual: arb_mat
    on_curve: arb_mat
    is_real: bool = True

    def jacobian(self, box: arb_mat) -> arb_mat:
        """Bounds for Y F'(x(t) + B, t): F' is linear in x, so that what B adds is bounded by itself."""
        widened = _padded(self.rows * gradients(box, self.forms.motion)[0])
        return self.on_curve + self.inverse * widened


def path_equations(
    forms: PathForms, weights: Sequence[int], curve: Curve, inverse: arb_mat, middle: arb, half: arb
) -> PathEquations:
    """The equations for path parameters middle + t, |t| <= half.

    Parameters
    ----------
    forms : PathForms
    weights : sequence of int
        w in w.e = 1.
    curve : Curve
    inverse : arb_mat
        Y.
    middle, half : arb
    """
    size = inverse.nrows()
    zeroth, first, second = forms.coefficients
    rows = (zeroth + middle * first + (middle * middle) * second, first + (2 * middle) * second, second)
    m, v, a = curve
    slopes = gradients(arb_mat([column.entries() for column in curve]).transpose(), forms.motion)
    gm, gv, ga = slopes
    quantities = [gm * m, 2 * (gm * v), 2 * (gm * a) + gv * v, 2 * (gv * a), ga * a]
    values = [
        inverse * arb_mat(size, 1, [*(total * arb(0.5)).entries(), last])
        for total, last in zip(_product(rows, quantities), _chart_values(weights, curve), strict=True)
    ]
    jacobians = [_padded(total) for total in _product(rows, slopes)]
    jacobians[0] = arb_mat(size, size, jacobians[0].entries()[:-size] + chart_row(weights, forms.motion))
    residual, on_curve = _range(values, half), _range([inverse * matrix for matrix in jacobians], half)
    return PathEquations(forms, _range(rows, half), inverse, residual, on_curve)


def _range(coefficients: Sequence[arb_mat], half: arb) -> arb_mat:
    """Bounds for a polynomial over |t| <= half, with matrices as coefficients."""
    both, square = arb(0, half), (half * half) * arb(0.5, 0.5)
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


def _product(rows: Sequence[arb_mat], factors: Sequence[arb_mat]) -> list[arb_mat]:
    """The coefficients of a product of polynomials."""
    found: list[arb_mat | None] = [None] * (len(rows) + len(factors) - 1)
    for i, row in enumerate(rows):
        for j, factor in enumerate(factors):
            term, sofar = row * factor, found[i + j]
            found[i + j] = term if sofar is None else sofar + term
    return [total for total in found if total is not None]


def _chart_values(weights: Sequence[int], curve: Curve) -> list[arb]:
    """w.x(t) - 1, as many coefficients as F has."""
    sums = [sum((w * column[k, 0] for k, w in enumerate(weights)), arb(0)) for column in curve]
    return [sums[0] - 1, *sums[1:], *[arb(0)] * 4]

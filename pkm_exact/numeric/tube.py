"""One certified step along a path: a tube that holds exactly one solution for every path parameter of the step.

On |t| <= h around the middle of a step, the tube is x(t) + B with x(t) = m + v t + a t^2 and a box B around 0. With
F(x, t) the equations, quadrics in x with coefficients of degree 2 in t, and any matrix Y,

    K_t(B) = - Y F(x(t), t) + (1 - Y F'(x(t) + B, t)) B.

If it lies in the interior of B for all |t| <= h, each t has exactly one solution in its slice of the tube, the Jacobian
is regular all over the tube, and so these solutions form one smooth branch. m, v, a and Y come from floating point and
prove nothing by themselves.

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

from pkm_exact.balls import ball
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.centred import QUANTITIES, gradient_forms
from pkm_exact.numeric.charts import chart_row, in_chart
from pkm_exact.numeric.krawczyk_operator import inflated
from pkm_exact.numeric.path_equations import path_equations
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
    radii : sequence of arb
        Half widths of the tube.
    end : arb_mat
        x(h).
    contraction : float
        How much of the width of the box the operator leaves: small if a longer step might do.
    """

    weights: list[int]
    leaving: arb_mat
    radii: Sequence[arb]
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


def weights_at(point: Real, motion: Motion) -> list[int]:
    """w near e: the chart in which |e| is small and in no direction far."""
    e = point[: len(motion.rotation_support)]
    return [int(value) for value in np.rint(32 * e / np.linalg.norm(e))]


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
    motion = path.forms.motion
    forms = _float_forms(motion)
    weights = weights_at(near, motion)
    chart = np.array(chart_row(weights, motion), dtype=float)
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
    h, inverse = ball(half), _square(prediction.inverse)
    equations = path_equations(path.forms, prediction.weights, (m, v, a), inverse, ball(middle), h)
    start = in_chart(entering, prediction.weights) - (m - h * v + (h * h) * a)
    # The box must hold what enters, whatever the operator makes of it.
    least = [ROOM * abs(d).upper() + FLOOR * abs(c).upper() for d, c in zip(start.entries(), m.entries(), strict=True)]

    def enlarged(values: Sequence[arb], factor: float = GROWTH) -> list[arb]:
        return [(factor * abs(value)).max(b).upper() for value, b in zip(values, least, strict=True)]

    found = inflated(equations, enlarged(equations.residual.entries(), 2), enlarged, ENLARGEMENTS)
    if found is None:
        return None
    radii, image = found
    end = m + h * v + (h * h) * a
    share = max(float((abs(value) / r).upper()) for value, r in zip(image.contracted.entries(), radii, strict=True))
    return Tube(prediction.weights, end + image.moved, radii, end, share)


def station(path: FloatPath, prediction: Prediction, at: Fraction) -> arb_mat | None:
    """Balls around the predicted point that hold exactly one solution for this one parameter; None if not proved."""
    tube = prove(path, prediction, _column(prediction.point), at, Fraction(0))
    return None if tube is None else tube.leaving


def _square(values: Real) -> arb_mat:
    size = len(values)
    return arb_mat(size, size, [arb(value) for value in values.ravel().tolist()])


def _column(values: Real) -> arb_mat:
    return arb_mat(len(values), 1, [arb(value) for value in values.tolist()])

"""The largest ellipsoid {x : x^T S^-1 x <= 1} in a polytope {x : |a_i x| <= 1}, with a proof of how good it is.

It is in the polytope where a_i S a_i^T <= 1 for all i, and S of greatest determinant is wanted (Loewner and John; Krut
et al., Robotica 22 (2004), equations 37 to 50). For any weights l_i >= 0 with sum 1 let M = n sum l_i a_i^T a_i. Then

    S in the polytope   =>   tr M S <= n   =>   det S <= 1 / det M
    M^-1 / (1 + d) is in the polytope,     1 + d = max a_i M^-1 a_i^T >= 1

So M^-1 is optimal if d = 0, and else nearly: the eigenvalues x of M^1/2 S* M^1/2 for the optimal S* have sum at most n
and product at least (1 + d)^-n, so that each x - 1 - log x <= g = n log(1 + d) and 1 - sqrt(2 g) <= x <= 1 + g +
sqrt(g^2 + 2 g). The eigenvalues of S* are those of M^-1 times factors between these (Ostrowski). The weights may come
from anywhere: they are proposed in floating point, refined by Newton's method on the sides that touch, and proved.

In a box that is too wide for M^-1, X near M^-1/2 serves: with e the norm of X^T M X - 1, eigenvalues of M^-1 are those
of X X^T times numbers between 1 / (1 + e) and 1 / (1 - e), a_i M^-1 a_i^T is at most |a_i X|^2 / (1 - e), and
X X^T / max |a_i X|^2 lies in the polytope.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.eigenvalues import eigenvalues, inverse_root, norm
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix

_STEPS = 2000
_GRID = 1 << 150
_SMALL_DENOMINATOR = 720
_WIDE = "ellipsoid: the pose is not enclosed narrowly enough"


@dataclass(frozen=True)
class LargestEllipsoid:
    """The largest ellipsoid, enclosed.

    Attributes
    ----------
    weights : tuple of Fraction
        l_i: the certificate.
    gap : Interval
        d; what M^-1 must shrink by at most to be in the polytope.
    half_axes : tuple of Interval
        Of the largest ellipsoid, in increasing order.
    matrix : EnclosedMatrix
        M^-1 / (1 + d): an ellipsoid that is in the polytope; in the coordinates that were asked for.
    touching : tuple of int
        Indices of the sides whose weight is not 0.
    """

    weights: tuple[Fraction, ...]
    gap: Interval
    half_axes: tuple[Interval, ...]
    matrix: EnclosedMatrix
    touching: tuple[int, ...]

    @property
    def index(self) -> Interval:
        """Greatest by least half axis."""
        low, high = self.half_axes[0], self.half_axes[-1]
        return Interval(max(Fraction(1), high.lo / low.hi), high.hi / low.lo) if low.lo > 0 else high


def largest_ellipsoid(rows: arb_mat, names: Sequence[str], shown: arb_mat | None = None) -> LargestEllipsoid:
    """The largest ellipsoid in {x : |rows x| <= 1}, about the origin.

    Parameters
    ----------
    rows : arb_mat
        At least as many as columns, of full rank.
    names : sequence of str
        Of the coordinates.
    shown : arb_mat, optional
        Coordinates y = shown x in which the matrix is wanted, and which the names are of; by default x.

    Raises
    ------
    InputError
        If the rows are not of full rank, or too wide.

    Examples
    --------
    >>> found = largest_ellipsoid(arb_mat([[1, 0], [0, 2], [1, 0]]), ["x", "y"])
    >>> print(*found.half_axes, found.gap.hi < 1e-30)
    0.500000000000000 1.000000000000000 True
    """
    with working_precision(BITS):
        weights = proposed_weights(rows)
        try:
            found = _proved(rows, weights, names, shown)
        except InputError:
            return _proved_nearby(rows, weights, names, shown)
        simple = _simple(weights)
        if simple is None:
            return found
        other = _proved(rows, simple, names, shown)
        return other if other.gap.hi <= found.gap.hi else found


def _proved(
    rows: arb_mat, weights: Sequence[Fraction], names: Sequence[str], shown: arb_mat | None
) -> LargestEllipsoid:
    """What the weights prove."""
    count, n = rows.nrows(), rows.ncols()
    weighted = arb_mat([[n * ball_of(weights[i]) * rows[i, j] for j in range(n)] for i in range(count)])
    try:
        inverse = (rows.transpose() * weighted).inv()
    except ZeroDivisionError:
        raise InputError("ellipsoid: the polytope is or may be unbounded; give a regular pose") from None
    reach = rows * inverse * rows.transpose()
    largest = reach[0, 0]
    for i in range(1, count):
        largest = largest.max(reach[i, i])
    gap = (largest - 1).max(arb(0))
    values = eigenvalues((inverse + inverse.transpose()) / 2)
    if values is None or not values[0] > 0 or not gap < 1:
        raise InputError(_WIDE)
    factor = _between(n, gap)
    return _found(weights, gap, [value * factor for value in values], inverse / (1 + gap), names, shown)


def _between(n: int, gap: arb) -> arb:
    """By which factors eigenvalues of the largest one may differ from those of M^-1."""
    bound = (n * (1 + gap.abs_upper()).log()).abs_upper()
    below, above = 1 - (2 * bound).sqrt(), 1 + bound + (bound * bound + 2 * bound).sqrt()
    return below.max(arb(0)).union(above)


def _found(
    weights: Sequence[Fraction],
    gap: arb,
    squares: list[arb],
    inner: arb_mat,
    names: Sequence[str],
    shown: arb_mat | None,
) -> LargestEllipsoid:
    """The answer: an ellipsoid in the polytope, and the squares of the half axes of the largest one."""
    matrix = inner if shown is None else shown * inner * shown.transpose()
    return LargestEllipsoid(
        tuple(weights),
        interval_of(gap),
        tuple(interval_of(value.nonnegative_part().sqrt()) for value in squares),
        EnclosedMatrix.of(names, names, matrix.tolist()),
        tuple(index for index, weight in enumerate(weights) if weight),
    )


def _proved_nearby(
    rows: arb_mat, weights: Sequence[Fraction], names: Sequence[str], shown: arb_mat | None
) -> LargestEllipsoid:
    """The same by X near M^-1/2, where the box is too wide for M^-1."""
    count, n = rows.nrows(), rows.ncols()
    weighted = arb_mat([[n * ball_of(weights[i]) * rows[i, j] for j in range(n)] for i in range(count)])
    x = inverse_root(rows.transpose() * weighted)
    if x is None:
        raise InputError(_WIDE)
    reach = rows * x
    near = x.transpose() * (rows.transpose() * weighted) * x
    defect = norm([near[i, j] - int(i == j) for i in range(n) for j in range(n)])
    most = arb(0)
    for i in range(count):
        most = most.max(sum((reach[i, j] * reach[i, j] for j in range(n)), arb(0)).abs_upper())
    gap = (most / (1 - defect) - 1).abs_upper()
    if not defect < 1 or not gap < 1:
        raise InputError(_WIDE)
    inner = x * x.transpose() / most
    values = eigenvalues(x * x.transpose())
    if values is None or not values[0] > 0:
        raise InputError(_WIDE)
    factor = _between(n, gap) / (1 + arb(0, defect))
    return _found(weights, gap, [value * factor for value in values], inner, names, shown)


def proposed_weights(rows: arb_mat) -> list[Fraction]:
    """Weights with sum 1 that nearly prove the largest one: multiplicative steps, then Newton's."""
    count, n = rows.nrows(), rows.ncols()
    a = np.array([float(entry.mid()) for entry in rows.entries()]).reshape(count, n)
    if not np.isfinite(a).all() or np.linalg.matrix_rank(a) < n:
        raise InputError("ellipsoid: the polytope is or may be unbounded; give a regular pose")
    weights = np.full(count, 1 / count)
    for _ in range(_STEPS):
        try:
            inverse = np.linalg.inv(a.T @ (weights[:, None] * a))
        except np.linalg.LinAlgError:
            raise InputError("ellipsoid: the polytope is or may be unbounded; give a regular pose") from None
        reach = np.einsum("ij,jk,ik->i", a, inverse, a)
        weights = weights * reach / n
        if reach.max() < n * (1 + 1e-9):
            break
    kept = [index for index in range(count) if weights[index] > 1e-5]
    return _normalised(count, kept, _refined(rows, kept, weights))


def _refined(rows: arb_mat, kept: Sequence[int], weights: np.ndarray[Any, Any]) -> list[Any]:
    """Newton's method for a_i M^-1 a_i^T = 1 at the sides that touch."""
    n = rows.ncols()
    with mpmath.workdps(60):
        a = mpmath.matrix(len(kept), n)
        for k, i in enumerate(kept):
            for j in range(n):
                mantissa, power = rows[i, j].mid().man_exp()
                a[k, j] = mpmath.ldexp(mpmath.mpf(int(mantissa)), int(power))
        found = mpmath.matrix([mpmath.mpf(float(weights[i])) for i in kept])
        start = found.copy()
        try:
            for _ in range(8):
                reach = a * (n * a.T * mpmath.diag(list(found)) * a) ** -1 * a.T
                squares = mpmath.matrix(len(kept), len(kept))
                for i in range(len(kept)):
                    for j in range(len(kept)):
                        squares[i, j] = n * reach[i, j] ** 2
                found = found + mpmath.lu_solve(squares, mpmath.matrix([reach[i, i] - 1 for i in range(len(kept))]))
        except ZeroDivisionError:
            return list(start)
        return list(found) if min(found) > 0 and max(found) < 2 else list(start)


def _normalised(count: int, kept: Sequence[int], values: Sequence[Any]) -> list[Fraction]:
    """Rational weights with sum 1."""
    with mpmath.workdps(60):
        whole = [max(int(mpmath.nint(value * _GRID)), 0) for value in values]
    found = [Fraction(0)] * count
    for index, value in zip(kept, whole, strict=True):
        found[index] = Fraction(value, sum(whole))
    return found


def _simple(weights: Sequence[Fraction]) -> list[Fraction] | None:
    """Weights with small denominators near these, if their sum is 1."""
    found = [weight.limit_denominator(_SMALL_DENOMINATOR) for weight in weights]
    return found if sum(found) == 1 else None

"""Jacobians at many poses at once, in doubles with bounds: signs of determinants, and singular values.

They are those of ``poses.jacobian``. With A computed to within E entry by entry, and singular vectors U, V of it that
are guesses, U^T A V is nearly diagonal: its singular values are within the Frobenius norm of all that is not (its other
entries, |U|^T E |V|, and roundings) of the diagonal (Weyl). The smallest and the largest are known better if a gap is
between them and the others: without the other entries of its row and its column, of norm x, such a one is the diagonal
entry, and with them it moves by x^2 / gap at most (Li and Li, "A note on eigenvalues of perturbed Hermitian matrices",
Linear Algebra Appl. 395 (2005), theorem 2, for the matrix with blocks 0, B, B^T, 0, whose eigenvalues are the singular
values of B and their negatives). Those of A are these times factors between the extreme singular values of U^-1 and
V^-1, which |U^T U - 1| bounds. The sign of the determinant is that of the factorisation P A = L R with partial
pivoting: L R is off by gamma(n) |L| |R| entry by entry (Higham, Accuracy and Stability of Numerical Algorithms, theorem
9.3), where |l| <= 1 and |r| <= 2^(n-1) max |a|. If that and E together are smaller than the smallest singular value,
all matrices on the way from L R to A are regular, and their determinants have one sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from math import sqrt
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from pkm_exact.constraints.form import ordinary
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.double_poses import DoubleCoordinates
from pkm_exact.numeric.double_rounding import LARGE, OUTWARD, SMALL, gamma, rounded
from pkm_exact.numeric.study_system import Real
from pkm_exact.poses.jacobian import FINEST_EXPONENT, OUTPUT_BITS
from pkm_exact.poses.leg_jacobian import LegJacobian
from pkm_exact.roots.interval import Interval

_FEW: Final = 18
"""Roundings in a row in an entry of a Jacobian: data (8), sums of up to six products of two or three factors (8)."""
DOUBT: Final = 2.0**-44
"""Ends of intervals that are relatively closer to the grid of the intervals returned are not decided by doubles."""
ROUNDED: Final = 1 + 2.0**-49
"""For less than a dozen roundings in a row."""
Finer: TypeAlias = Callable[[Real, Real], tuple[Real, Real]]
"""Of vectors u and v, (p, n) each, u^T A v and how far it is off at most."""
_NEXT: Final = [1, 2, 0]
_LAST: Final = [2, 0, 1]
"""The axes after and before each."""


def double_jacobians(
    problem: ForwardProblem,
    found: DoubleCoordinates,
    length: Fraction,
    each: Sequence[ForwardProblem] | None = None,
) -> list[LegJacobian | None]:
    """The Jacobians at poses whose coordinates are given; None where doubles do not decide them.

    Parameters
    ----------
    problem : ForwardProblem
    found : DoubleCoordinates
        Of p poses.
    length : Fraction
        Makes turns comparable to translations.
    each : sequence of ForwardProblem, optional
        That of each pose, where it is not the same for all: of one robot, with other lengths.
    """
    count, size = len(found.values), problem.motion.dimension
    if problem.equation_count != size or problem.squares or not count:
        return [None] * count
    with np.errstate(all="ignore"):
        try:
            matrices, off = _rows(
                problem, forms_of_each([problem] if each is None else each, length), float(length), found
            )
            is_good = (np.isfinite(matrices) & np.isfinite(off) & (np.abs(matrices) < LARGE)).all(axis=(1, 2))
            is_good &= (np.abs(found.values) < LARGE).all(axis=1)
            matrices[~is_good], off[~is_good] = np.eye(size), 1.0
            return decided(matrices, off, length)
        except (OverflowError, np.linalg.LinAlgError):
            return [None] * count


def forms_of_each(problems: Sequence[ForwardProblem], length: Fraction) -> Real:
    """(p, m, 17): the forms of each problem in ordinary coordinates, divided by the size of their wrenches.

    Problems may be the same.
    """
    several = {id(problem): problem for problem in problems}
    found, first = [], problems[0]
    numbers, linear = _numbers(first), [form[:-1] for form in first.forms]
    for problem in several.values():
        table = numbers
        if problem is not first:
            # At other lengths of one robot it is the constants that differ.
            are_alike = [form[:-1] for form in problem.forms] == linear
            table = numbers.copy() if are_alike else _numbers(problem)
            table[:, -1] = rounded(form[-1] for form in problem.forms)
        scales = [size for constraint in problem.constraints for size in constraint.scales(problem.metric, length)]
        found.append(table / np.array([sqrt(size) for size in scales])[:, None])
    places = {key: place for place, key in enumerate(several)}
    tables: Real = np.array(found)[[places[id(problem)] for problem in problems]]
    return tables


def _numbers(problem: ForwardProblem) -> Real:
    """(m, 17): the forms in ordinary coordinates."""
    roots = [sqrt(g) for g in problem.metric]
    return np.array([ordinary(rounded(form), roots) for form in problem.forms])


def _rows(problem: ForwardProblem, forms: Real, length: float, found: DoubleCoordinates) -> tuple[Real, Real]:
    """The Jacobians, and how far their entries are off at most, from forms (p, m, 17) of each, or (1, m, 17) of all."""
    tables = forms[..., 0], forms[..., 1:4], forms[..., 4:7], forms[..., 7:16].reshape(*forms.shape[:2], 3, 3)
    c, r = found.values[:, :3], found.values[:, 3:12].reshape(-1, 3, 3)
    c_off, r_off = found.errors[:, :3], found.errors[:, 3:12].reshape(-1, 3, 3)

    def wrenches(c: Real, r: Real, tables: Sequence[Real], sign: int) -> tuple[Real, Real, Real]:
        """a, the force and the moment; with absolute values and sign 1, what they are at most."""
        square, turned, position, rotation = tables
        moved = turned @ r.transpose(0, 2, 1)
        force = 2 * square[..., None] * c[:, None] + moved + position
        sums = r[:, None] @ rotation.transpose(0, 1, 3, 2)
        moment = _crossed(moved, c[:, None], sign) + sums[..., _NEXT, _LAST] + sign * sums[..., _LAST, _NEXT]
        return moved, force, moment

    _, force, moment = wrenches(c, r, tables, -1)
    sizes = [np.abs(table) for table in tables]
    moved, most_force, most_moment = wrenches(np.abs(c), np.abs(r), sizes, 1)
    moved_off, force_off, moment_off = wrenches(c_off, r_off, sizes, 1)
    force_off -= sizes[2]  # what does not depend on the pose is not off by that
    moment_off += _crossed(moved, c_off[:, None], 1) + _crossed(moved_off, np.abs(c)[:, None], 1)
    force_off += gamma(_FEW) * (most_force + 2 * sizes[2])
    moment_off += gamma(_FEW) * most_moment
    twist = list(problem.motion.twist)
    matrices = np.concatenate([force, moment / length], axis=2)[:, :, twist]
    off = np.concatenate([force_off, moment_off / length], axis=2)[:, :, twist]
    return matrices, (off + gamma(4) * np.abs(matrices)) * OUTWARD + SMALL


def _crossed(left: Real, right: Real, sign: int) -> Real:
    """Products of vectors (.., 3): with sign -1 the vector product, with 1 what it is at most."""
    found: Real = left[..., _NEXT] * right[..., _LAST] + sign * left[..., _LAST] * right[..., _NEXT]
    return found


def decided(
    matrices: Real, off: Real, length: Fraction, finer: Finer | None = None, scale: float | Real = 1.0
) -> list[LegJacobian | None]:
    """Determinants and singular values, of matrices with these bounds of their entries' errors.

    Parameters
    ----------
    matrices, off : (p, n, n) arrays
    length : Fraction
    finer : callable, optional
        Of vectors u and v, (p, n) each, gives u^T A v and how far it is off at most, where that is known better.
    scale : (p,) array, optional
        The Jacobians are the matrices divided by it; it is off by three roundings at most.
    """
    size = matrices.shape[1]
    left, _, right = np.linalg.svd(matrices)
    products = left.transpose(0, 2, 1) @ matrices @ right.transpose(0, 2, 1)
    around = np.abs(left.transpose(0, 2, 1)) @ (np.abs(matrices) * 2 * gamma(size + 1) + off)
    rest = around @ np.abs(right.transpose(0, 2, 1)) * (1 + gamma(4 * size))
    diagonal = np.einsum("pii->pi", products).copy()
    lacking = np.abs(products * (1 - np.eye(size))) + rest
    if finer is not None:
        diagonal[:, -1], lacking[:, -1, -1] = finer(left[:, :, -1], right[:, -1])
    unit = [_norm(np.abs(v.transpose(0, 2, 1) @ v - np.eye(size)) + gamma(2 * size)) for v in (left, right)]
    is_unit = (unit[0] < 1 / 4) & (unit[1] < 1 / 4)
    stretch = np.sqrt((1 + unit[0]) * (1 + unit[1])) * ROUNDED
    shrink = np.sqrt((1 - unit[0]) * (1 - unit[1])) / ROUNDED
    least, largest = (
        ((middle - radius) / stretch, (middle + radius) / shrink) for middle, radius in _extremes(diagonal, lacking)
    )
    growth = gamma(size) * size**2 * 2.0 ** (size - 1) * np.abs(matrices).max(axis=(1, 2))
    is_regular = is_unit & (least[0] > (growth + _norm(off)) * OUTWARD + SMALL)
    signs = np.linalg.slogdet(matrices)[0]
    smallest = _intervals(least[0] / scale, least[1] / scale, is_regular)
    conditions = _intervals(largest[0] / least[1], largest[1] / least[0], is_regular)
    return [
        LegJacobian(int(sign), size, sigma, condition, length) if sigma and condition and sign else None
        for sign, sigma, condition in zip(signs.tolist(), smallest, conditions, strict=True)
    ]


def _extremes(diagonal: Real, lacking: Real) -> Iterator[tuple[Real, Real]]:
    """The smallest and the largest singular value of nearly diagonal matrices, and how far they are off at most.

    Parameters
    ----------
    diagonal : (p, n) array
        Of the matrices.
    lacking : (p, n, n) array
        How much there is beside it, at most.
    """
    count, size = diagonal.shape
    sizes, shift, rows = np.abs(diagonal), _norm(lacking), np.arange(count)
    order = np.argsort(sizes, axis=1)
    beside = lacking * (1 - np.eye(size))
    crosses = (beside * beside).sum(axis=1) + (beside * beside).sum(axis=2)
    for place, neighbour in ((0, min(1, size - 1)), (-1, max(-2, -size))):
        chosen = order[:, place]
        middle = sizes[rows, chosen]
        # Half of what is surely between it and the others: roundings cannot matter.
        gap = np.abs(sizes[rows, order[:, neighbour]] - middle) / 2 - shift
        radius = (lacking[rows, chosen, chosen] + crosses[rows, chosen] / np.where(gap > 0, gap, 1)) * OUTWARD + SMALL
        yield middle, np.where(gap > 0, np.minimum(radius, shift), shift)


def _norm(matrices: Real) -> Real:
    """Frobenius norms, rounded upwards."""
    found: Real = np.sqrt((matrices * matrices).sum(axis=(1, 2))) * OUTWARD
    return found


def _intervals(low: Real, high: Real, chosen: NDArray[np.bool_]) -> list[Interval | None]:
    """Between neighbours of the grid with ``OUTPUT_BITS`` significant bits, where values lie for certain."""
    low, high = low * (1 - DOUBT), high * (1 + DOUBT)
    shifts = OUTPUT_BITS + 1 - np.frexp(high)[1]
    first, last = np.floor(np.ldexp(low, shifts)), np.ceil(np.ldexp(high, shifts))
    is_sure = chosen & (last == first + 1) & (low > 0) & np.isfinite(last) & (shifts <= FINEST_EXPONENT)
    rows = zip(np.where(is_sure, first, 0).astype(np.int64).tolist(), shifts.tolist(), is_sure.tolist(), strict=True)
    return [_dyadic(value, shift) if sure else None for value, shift, sure in rows]


def _dyadic(value: int, shift: int) -> Interval:
    """From a value times 2^-shift to the next one."""
    if shift < 0:
        return Interval.on_grid(value << -shift, value + 1 << -shift, 0)
    return Interval.on_grid(value, value + 1, shift)

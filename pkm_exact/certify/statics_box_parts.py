"""The claims of a statics certificate of a box, each from P and E as they are listed, in balls."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product
from typing import Any, Final

from flint import arb, arb_mat

from pkm_exact.balls import ball
from pkm_exact.certify.widened import texts, widened, widened_all
from pkm_exact.errors import InputError
from pkm_exact.polytopes.rationals import rational_matrix
from pkm_exact.polytopes.signs import UndecidedError, sign

MOST_CHOICES: Final = 20_000
_WIDE: Final = (
    "the box does not tell which faces there are: it is too wide, or more of them meet than usual, which no box proves "
    "(an exact pose may)"
)
_LEAST: Final = Fraction(1, 1 << 44)


def actuator_forces(rows: arb_mat, twists: arb_mat, load: Sequence[Fraction]) -> list[list[str]]:
    """The forces that bear a load; those of least norm if there are others."""
    wanted = -(twists.transpose() * arb_mat([[ball(x)] for x in load]))
    try:
        if rows.nrows() == rows.ncols():
            found = rows.transpose().solve(wanted)
        else:
            found = rows * (rows.transpose() * rows).solve(wanted)
    except ZeroDivisionError:
        raise UndecidedError("the box is not narrow enough, or the actuators cannot bear every load") from None
    return [texts(ends) for ends in widened_all(found.entries())]


def velocity_entry(rows: arb_mat, ends: Sequence[tuple[Fraction, Fraction]], room: int = 1) -> dict[str, Any]:
    """The polytope of what rows map between ends: vertices where n sides and no more meet."""
    m, n = rows.nrows(), rows.ncols()
    vertices: list[dict[str, Any]] = []
    _require_few(m, n, n)
    for chosen in combinations(range(m), n):
        others = [k for k in range(m) if k not in chosen]
        inverse = _inverse(rows, chosen)
        reach = _picked(rows, others) * inverse if others else None
        for signs in product((-1, 1), repeat=n):
            bounds = arb_mat([[ball(ends[k][s > 0])] for s, k in zip(signs, chosen, strict=True)])
            values: list[arb] = [] if reach is None else (reach * bounds).entries()
            found = [_side(value, *ends[k]) for k, value in zip(others, values, strict=True)]
            if all(side > 0 for side in found):
                point = widened_all((inverse * bounds).entries(), room)
                sides = [[k + 1, s] for k, s in zip(chosen, signs, strict=True)]
                vertices.append({"sides": sides, "at": [texts(pair) for pair in point]})
            elif not any(side < 0 for side in found):
                raise UndecidedError(_WIDE)
    facets = sorted({tuple(side) for vertex in vertices for side in vertex["sides"]})
    volume = None
    if m == n:
        total = 1 / abs(rows.det())
        for low, high in ends:
            total *= ball(high - low)
        volume = texts(widened(total, 0, room))
    return {"facets": [list(side) for side in facets], "vertices": vertices, "volume": volume}


def _side(value: arb, low: Fraction, high: Fraction) -> int:
    """1 between the ends, -1 outside, 0 if that is not decided."""
    bottom, top = ball(low), ball(high)
    if value < bottom or value > top:
        return -1
    return 1 if value > bottom and value < top else 0


def wrench_entry(rows: arb_mat, ends: Sequence[tuple[Fraction, Fraction]], room: int = 1) -> dict[str, Any]:
    """The polytope of wrenches: n - 1 rows and no more in every facet."""
    m, n = rows.nrows(), rows.ncols()
    _require_few(m, n - 1, n)
    facets, cells = [], set()
    for chosen in combinations(range(m), n - 1):
        normal = _vector_product(_picked(rows, chosen) if chosen else None, n)
        values = {k: sum((a * rows[k, j] for j, a in enumerate(normal)), arb(0)) for k in range(m) if k not in chosen}
        signs = {k: sign(value) for k, value in values.items()}
        if 0 in signs.values():
            raise UndecidedError(_WIDE)
        for side in (1, -1):
            offset = sum((side * v * ball(ends[k][side * signs[k] > 0]) for k, v in values.items()), arb(0))
            facets.append(
                {
                    "legs": [k + 1 for k in chosen],
                    "side": side,
                    "normal": [texts(pair) for pair in widened_all([side * x for x in normal], room)],
                    "offset": texts(widened(offset, _size(values.values(), ends), room)),
                }
            )
            for picked in product((-1, 1), repeat=n - 1):
                cell = {k: side * s for k, s in signs.items()} | dict(zip(chosen, picked, strict=True))
                cells.add(tuple(cell[k] for k in range(m)))
    total = arb(0)
    for chosen in combinations(range(m), n):
        part = abs(_picked(rows, chosen).det())
        for k in chosen:
            part *= ball(ends[k][1] - ends[k][0])
        total += part
    return {
        "facets": facets,
        "vertices": [list(cell) for cell in sorted(cells)],
        "volume": texts(widened(total, 0, room)),
    }


def _size(values: Any, ends: Sequence[tuple[Fraction, Fraction]]) -> arb:
    """A bound of what is added up in an offset."""
    most = max(max(abs(low), abs(high)) for low, high in ends)
    return ball(most) * sum((abs(value).abs_upper() for value in values), arb(0))


def ellipsoid_entry(rows: arb_mat, speeds: Sequence[Fraction], weights: Sequence[Fraction]) -> dict[str, Any]:
    """A rational ellipsoid in the polytope of twists, and how much larger another one may be."""
    m, n = rows.nrows(), rows.ncols()
    inverse = [1 / speed**2 for speed in speeds]
    middle = [[_short(rows[i, j].mid()) for j in range(n)] for i in range(m)]
    scaled = [[n * w * x * q for x in row] for w, q, row in zip(weights, inverse, middle, strict=True)]
    dual = rational_matrix(middle).transpose() * rational_matrix(scaled)
    if dual.det() == 0:
        raise UndecidedError("the weights prove nothing")
    exact = dual.inv()
    whole = [[Fraction(int(exact[i, j].p), int(exact[i, j].q)) for j in range(n)] for i in range(n)]
    balls = arb_mat([[ball(x) for x in row] for row in whole])
    reach = rows * balls * rows.transpose()
    most = arb(1)
    for k in range(m):
        most = most.max(reach[k, k] * ball(inverse[k]))
    room = (1 / (most.abs_upper() * (1 + arb(2) ** -40))).lower()
    shrunk = arb_mat([[room * ball(whole[i][j]) for j in range(n)] for i in range(n)])
    matrix = [[_short(shrunk[min(i, j), max(i, j)].mid()) for j in range(n)] for i in range(n)]
    total = arb(0)
    for chosen in combinations(range(m), n):
        part = _picked(rows, chosen).det()
        part = part * part
        for k in chosen:
            part *= ball(weights[k] * inverse[k])
        total += part
    share = arb_mat([[ball(x) for x in row] for row in matrix]).det() * total * n**n
    gap = 4 * (1 - share).abs_upper()
    if not gap < 1:
        raise UndecidedError("the box is not narrow enough for an ellipsoid that is nearly the largest")
    return {
        "weights": [str(w) for w in weights],
        "matrix": [[str(x) for x in row] for row in matrix],
        "gap": str(_rounded_up(gap)),
    }


def indices_entry(rows: arb_mat, twists: arb_mat, scales: Sequence[Fraction], near: Sequence[Any]) -> dict[str, Any]:
    """Bounds of singular values that pivots decide: about enclosures of the least and the greatest."""
    gram = rows.transpose() * rows
    scaled = arb_mat([[ball(s) * x for x in row] for s, row in zip(scales, twists.tolist(), strict=True)])
    norm = twists.transpose() * scaled
    (low, high), (least, most) = near
    below = _decided(low, -1, lambda s: is_definite(gram - s * s * norm) is True)
    above = _decided(high, 1, lambda s: is_definite(gram - s * s * norm) is False)
    under = _decided(least, -1, lambda s: is_definite(s * s * norm - gram) is False)
    over = _decided(most, 1, lambda s: is_definite(s * s * norm - gram) is True)
    condition = _dyadic(under / above, up=False), _dyadic(over / below, up=True)
    return {
        "sigma_min": [str(below), str(above)],
        "sigma_max": [str(under), str(over)],
        "condition": [str(x) for x in condition],
    }


def _decided(start: Fraction, way: int, holds: Any) -> Fraction:
    """A bound beyond the start at which a question is decided, and twice as far."""
    slack = _LEAST
    while slack < Fraction(1, 8):
        if holds(ball(start * (1 + way * slack))):
            return _dyadic(start * (1 + 2 * way * slack), up=way > 0)
        slack *= 2
    raise UndecidedError("the box is not narrow enough for bounds of singular values")


def is_definite(matrix: arb_mat) -> bool | None:
    """Whether a symmetric matrix is positive definite, by pivots in order; None where they do not tell.

    >>> is_definite(arb_mat([[2, 1], [1, 2]])), is_definite(arb_mat([[0]])), is_definite(arb_mat([[-1]]))
    (True, None, False)
    """
    left = matrix.tolist()
    for k in range(len(left)):
        pivot = left[k][k]
        if pivot < 0:
            return False
        if not pivot > 0:
            return None
        for row in left[k + 1 :]:
            factor = row[k] / pivot
            row[:] = [x - factor * y for x, y in zip(row, left[k], strict=True)]
    return True


def _picked(rows: arb_mat, chosen: Sequence[int]) -> arb_mat:
    return arb_mat([[rows[k, j] for j in range(rows.ncols())] for k in chosen])


def _inverse(rows: arb_mat, chosen: Sequence[int]) -> arb_mat:
    try:
        return _picked(rows, chosen).inv()
    except ZeroDivisionError:
        raise UndecidedError(_WIDE) from None


def _vector_product(rows: arb_mat | None, n: int) -> list[arb]:
    if rows is None:
        return [arb(1)]
    table = rows.tolist()
    minors = (arb_mat([row[:j] + row[j + 1 :] for row in table]).det() for j in range(n))
    return [-minor if j % 2 else minor for j, minor in enumerate(minors)]


def _require_few(count: int, size: int, signs: int) -> None:
    from math import comb

    if comb(count, size) << signs > MOST_CHOICES:
        raise InputError("it has too many choices of legs for a certificate")


def _short(value: arb) -> Fraction:
    """A midpoint to 80 bits."""
    mantissa, power = (int(part) for part in value.man_exp())
    shift = max(0, abs(mantissa).bit_length() - 80)
    mantissa, power = mantissa >> shift, power + shift
    return Fraction(mantissa << power) if power >= 0 else Fraction(mantissa, 1 << -power)


def _rounded_up(value: arb) -> Fraction:
    return _dyadic(_short(value.abs_upper()) * (1 + _LEAST), up=True)


def _dyadic(value: Fraction, *, up: bool) -> Fraction:
    """A number of 48 bits below or above one that is positive; 0 is itself."""
    if value == 0:
        return value
    shift = 48 - value.numerator.bit_length() + value.denominator.bit_length()
    scaled = value * Fraction(2) ** shift
    whole = -((-scaled.numerator) // scaled.denominator) if up else scaled.numerator // scaled.denominator
    return whole / Fraction(2) ** shift

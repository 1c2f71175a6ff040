"""The rigid motions that six legs allow, as quadrics in affine coordinates: the ideal that an elimination works in.

On the coordinates (u, C, s, R), u = R^-1 C and s = |C|^2, each leg is linear and the rigid motions are the common zeros
of the quadrics of ``motion_quadrics``. The legs are solved for coordinates from the left of ``ORDER``, as many as they
determine, and the solution is substituted into the quadrics; the rest are the unknowns of the section, in this order.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import chain, combinations_with_replacement
from math import gcd
from typing import Any, Final, TypeAlias

from flint import Ordering, fmpz, fmpz_mat, fmpz_mpoly, fmpz_mpoly_ctx

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.echelon import pivots_of
from pkm_exact.certify.checker.packed_monomials import Monomial
from pkm_exact.certify.checker.study_motion import CYCLIC, PLANAR_LEGS, Leg, Metric, combination, leg_form, times

ORDER: Final = ("u1", "u2", "u3", "c1", "c2", "c3", "s", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)))
"""Coordinates; the legs are solved for those on the left first, and unknowns decrease in the monomial order."""

_PLANE: Final = tuple(
    [int(name == fixed) for name in ORDER] + [-int(fixed == "r33")]
    for fixed in ("u3", "c3", "r13", "r23", "r31", "r32", "r33")
)
"""What keeps a planar robot in the plane of the first two axes: these coordinates, minus 1 for r33, are 0."""

Polynomial: TypeAlias = dict[Monomial, int]
"""Coefficients by exponents."""

RING: Final = fmpz_mpoly_ctx.get(("x",), Ordering.lex)
"""Quadrics in unknowns are polynomials in x^1, x^3, x^9, ..: the exponents of a monomial are digits to base 3."""


def unknowns(legs: Sequence[Leg], metric: Metric) -> list[int]:
    """The places in ``ORDER`` of the coordinates that are the unknowns of the section."""
    return _solved(legs, metric)[3]


def _solved(legs: Sequence[Leg], metric: Metric) -> tuple[fmpz_mat, fmpz, list[int], list[int]]:
    """A multiple of the echelon form of the leg equations on ``ORDER`` and 1, of which; its pivots; what they leave."""
    rows = []
    for leg in legs:
        form = leg_form(leg, metric)  # on (1, R, C, u, s)
        rows.append([*form[13:16], *form[10:13], form[16], *form[1:10], form[0]])
    if len(legs) == PLANAR_LEGS:
        rows += _PLANE
    words = limbs(max(map(int.bit_length, chain.from_iterable(rows))))
    charge(10**6 + len(rows) * words * (10**5 + 3000 * words))
    echelon, lead, rank = fmpz_mat(rows).rref()
    pivots = pivots_of(echelon, int(rank))
    return echelon, lead, pivots, [j for j in range(len(ORDER)) if j not in pivots]


def section(legs: Sequence[Leg], metric: Metric) -> tuple[int, list[Polynomial]]:
    """Number of unknowns, and the quadrics that vanish at the poses (with 1, if no finite pose can exist)."""
    echelon, lead, pivots, free = _solved(legs, metric)
    quadrics = [RING.constant(1)] if len(ORDER) in pivots else []
    quadrics += motion_quadrics(substituted(echelon, lead, pivots, free), metric)
    return len(free), terms_of(quadrics, len(free))


def substituted(echelon: fmpz_mat, lead: fmpz | int, pivots: Sequence[int], free: Sequence[int]) -> list[fmpz_mpoly]:
    """``lead`` times the coordinates and 1, as the forms leave them, in the free ones."""
    size = len(ORDER)
    powers = dict(zip((*free, size), unknown_powers(len(free)), strict=True))
    values = [RING.from_dict({(powers.get(j, 0),): lead}) for j in range(size + 1)]
    for row, pivot in enumerate(pivots):
        if pivot < size:
            values[pivot] = RING.from_dict({(power,): -echelon[row, j] for j, power in powers.items()})
    return values


def unknown_powers(number: int) -> list[int]:
    """The powers of x that stand for so many unknowns and for 1."""
    return [3**place for place in range(number)] + [0]


def terms_of(quadrics: Sequence[fmpz_mpoly], number: int) -> list[Polynomial]:
    """Quadrics in so many unknowns but for those that are 0, each divided by what its coefficients have in common."""
    monomials = _monomials(number)
    found = []
    for quadric in quadrics:
        if not quadric:
            continue
        values = [*map(int, quadric.coeffs())]
        words = limbs(max(map(int.bit_length, values)))
        charge(len(values) * (2000 + 4 * words * words))
        content = gcd(*values)
        found.append(
            {monomials[power]: value // content for power, value in zip(quadric.monoms(), values, strict=True)}
        )
    return found


@lru_cache(maxsize=len(ORDER))
def _monomials(number: int) -> dict[tuple[int, ...], Monomial]:
    """The monomials of degree 2 at most in so many unknowns, by the powers of x that stand for them."""
    powers = unknown_powers(number)
    return {
        (powers[i] + powers[j],): tuple((i == place) + (j == place) for place in range(number))
        for i, j in combinations_with_replacement(range(number + 1), 2)
    }


def motion_quadrics(values: Sequence[Any], metric: Metric) -> list[Any]:
    """R^T G R = G, R G^-1 R^T = G^-1, cof R = G R G^-1, R u = C, R^T G C = G u, C.C = u.u = s,
    C x (R v) = G R G^-1 (u x v) for the unit vectors v: they hold for rigid motions, and with R = (r_ij) for no others.

    Each is multiplied by numbers of the metric where it would have others in denominators, and homogeneous in the
    coordinates and the last value, which stands for 1.
    """
    sizes = (int(x.height_bits()) for value in values for x in value.coeffs())
    words = limbs(max(sizes, default=0)) + limbs(max(metric).bit_length())
    charge(2 * 10**7 + words * (10**6 + 2000 * words))
    g, volume = metric, metric[0] * metric[1] * metric[2]
    u, c, s, one = values[0:3], values[3:6], values[6], values[16]
    r = [values[7 + 3 * i : 10 + 3 * i] for i in range(3)]
    unit = one * one
    found = []
    for i in range(3):
        for j in range(3):
            if i <= j:  # both are symmetric
                columns = combination(g, [r[k][i] * r[k][j] for k in range(3)])
                rows = combination([volume // value for value in g], [r[i][k] * r[j][k] for k in range(3)])
                found += [columns - g[i] * unit, rows - volume // g[i] * unit] if i == j else [columns, rows]
            (i1, i2), (j1, j2) = CYCLIC[i][1:], CYCLIC[j][1:]
            minor = r[i1][j1] * r[i2][j2] - r[i1][j2] * r[i2][j1]
            found.append(times(g[j], minor) - times(g[i], r[i][j] * one))
        found.append(r[i][0] * u[0] + r[i][1] * u[1] + r[i][2] * u[2] - c[i] * one)
        found.append(combination(g, [r[k][i] * c[k] for k in range(3)]) - times(g[i], u[i] * one))
    found.append(combination(g, [value * value for value in c]) - s * one)
    found.append(combination(g, [value * value for value in u]) - s * one)
    for axis, up, down in CYCLIC:
        for i, j, k in CYCLIC:
            # The coordinate i of G R G^-1 (u x v) for the unit vector v along ``axis``, times g_up g_down.
            image = times(g[down], r[i][up] * u[down]) - times(g[up], r[i][down] * u[up])
            found.append(times(g[up] * g[down], c[j] * r[k][axis] - c[k] * r[j][axis]) - times(g[i], image))
    return found

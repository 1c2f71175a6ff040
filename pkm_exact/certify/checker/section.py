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
from pkm_exact.certify.checker.packed_monomials import Code, Packed, Packing, packing_for
from pkm_exact.certify.checker.study_motion import CYCLIC, PLANAR_LEGS, Leg, Metric, combination, leg_form, times

ORDER: Final = ("u1", "u2", "u3", "c1", "c2", "c3", "s", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)))
"""Coordinates; the legs are solved for those on the left first, and unknowns decrease in the monomial order."""

_PLANE: Final = tuple(
    [int(name == fixed) for name in ORDER] + [-int(fixed == "r33")]
    for fixed in ("u3", "c3", "r13", "r23", "r31", "r32", "r33")
)
"""What keeps a planar robot in the plane of the first two axes: these coordinates, minus 1 for r33, are 0."""

Quadric: TypeAlias = tuple[tuple[tuple[int, int], int], ...]
"""Coefficients of products of two values, after their places, of which the first is not the larger one."""

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


def section(legs: Sequence[Leg], metric: Metric) -> tuple[Packing, list[Packed]]:
    """The quadrics that vanish at the poses (with 1, if no finite pose can exist), and their monomials."""
    echelon, lead, pivots, free = _solved(legs, metric)
    quadrics = [RING.constant(1)] if len(ORDER) in pivots else []
    quadrics += motion_quadrics(substituted(echelon, lead, pivots, free), metric)
    return terms_of(quadrics, len(free))


def substituted(echelon: fmpz_mat, lead: fmpz | int, pivots: Sequence[int], free: Sequence[int]) -> list[fmpz_mpoly]:
    """``lead`` times the coordinates and 1, as the forms leave them, in the free ones."""
    size = echelon.ncols() - 1
    powers = dict(zip((*free, size), unknown_powers(len(free)), strict=True))
    values = [RING.from_dict({(powers.get(j, 0),): lead}) for j in range(size + 1)]
    for row, pivot in zip(echelon.tolist(), pivots, strict=False):
        if pivot < size:
            values[pivot] = RING.from_dict({(power,): -row[j] for j, power in powers.items() if row[j]})
    return values


def unknown_powers(number: int) -> list[int]:
    """The powers of x that stand for so many unknowns and for 1."""
    return [3**place for place in range(number)] + [0]


def terms_of(quadrics: Sequence[fmpz_mpoly], number: int) -> tuple[Packing, list[Packed]]:
    """Quadrics in so many unknowns but for those that are 0 or multiples of others, primitive, in any order."""
    present = [quadric for quadric in quadrics if quadric]
    packing = packing_for(number, 2, sum(map(len, present)))
    codes = _codes(packing)
    found: dict[tuple[int, int, int], list[Packed]] = {}
    for quadric in present:
        values = [*map(int, quadric.coeffs())]
        words = limbs(max(map(int.bit_length, values)))
        charge(len(values) * (2000 + 4 * words * words))
        content = gcd(*values) if values[0] > 0 else -gcd(*values)
        if content != 1:
            values = [value // content for value in values]
        alike = found.setdefault((len(values), values[0], values[-1]), [])
        polynomial = dict(zip(map(codes.__getitem__, quadric.monoms()), values, strict=True))
        if polynomial not in alike:
            alike.append(polynomial)
    return packing, [*chain.from_iterable(found.values())]


@lru_cache(maxsize=2 * len(ORDER))
def _codes(packing: Packing) -> dict[tuple[int, ...], Code]:
    """The monomials of degree 2 at most, by the powers of x that stand for them."""
    number = packing.size
    powers = unknown_powers(number)
    return {
        (powers[i] + powers[j],): packing.packed(tuple((i == place) + (j == place) for place in range(number)))
        for i, j in combinations_with_replacement(range(number + 1), 2)
    }


def motion_quadrics(values: Sequence[fmpz_mpoly], metric: Metric) -> list[fmpz_mpoly]:
    """The quadrics of ``motion_forms`` at polynomials for the coordinates and for 1."""
    sizes = (int(x.height_bits()) for value in values for x in value.coeffs())
    words = limbs(max(sizes, default=0)) + limbs(max(metric).bit_length())
    charge(2 * 10**7 + words * (10**6 + 2000 * words))
    return evaluated(motion_forms(metric), values)


def evaluated(quadrics: Sequence[Quadric], values: Sequence[fmpz_mpoly]) -> list[fmpz_mpoly]:
    """Quadrics at polynomials; most have products in common, many of which are 0."""
    products: dict[tuple[int, int], fmpz_mpoly] = {}
    found = []
    for quadric in quadrics:
        total = RING.constant(0)
        for places, coefficient in quadric:
            product = products.get(places)
            if product is None:
                product = products[places] = values[places[0]] * values[places[1]]
            if product:
                total += times(coefficient, product)
        found.append(total)
    return found


@lru_cache(maxsize=16)
def motion_forms(metric: Metric) -> tuple[Quadric, ...]:
    """The quadrics that define the rigid motions, in the coordinates and 1, each divided by what it has in common."""
    powers = unknown_powers(len(ORDER))
    places = {powers[i] + powers[j]: (i, j) for i, j in combinations_with_replacement(range(len(powers)), 2)}
    quadrics = []
    for form in _motion_quadrics([RING.from_dict({(power,): 1}) for power in powers], metric):
        content = gcd(*map(int, form.coeffs()))
        quadrics.append(tuple((places[power], int(value) // content) for (power,), value in form.to_dict().items()))
    return tuple(quadrics)


def _motion_quadrics(values: Sequence[Any], metric: Metric) -> list[Any]:
    """R^T G R = G, R G^-1 R^T = G^-1, cof R = G R G^-1, R u = C, R^T G C = G u, C.C = u.u = s,
    C x (R v) = G R G^-1 (u x v) for the unit vectors v: they hold for rigid motions, and with R = (r_ij) for no others.

    Each is multiplied by numbers of the metric where it would have others in denominators, and homogeneous in the
    coordinates and the last value, which stands for 1.
    """
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

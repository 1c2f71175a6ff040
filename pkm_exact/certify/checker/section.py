"""The rigid motions that six legs allow, as quadrics in affine coordinates: the ideal that an elimination works in.

On the coordinates (u, C, s, R), u = R^-1 C and s = |C|^2, each leg is linear and the rigid motions are the common zeros
of the quadrics of ``motion_quadrics``. The legs are solved for coordinates from the left of ``ORDER``, as many as they
determine, and the solution is substituted into the quadrics; the rest are the unknowns of the section, in this order.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz, fmpz_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.study_motion import CYCLIC, PLANAR_LEGS, Leg, Metric, leg_form

ORDER: Final = ("u1", "u2", "u3", "c1", "c2", "c3", "s", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)))
"""Coordinates; the legs are solved for those on the left first, and unknowns decrease in the monomial order."""

_PLANE: Final = (("u3", 0), ("c3", 0), ("r13", 0), ("r23", 0), ("r31", 0), ("r32", 0), ("r33", -1))
"""What keeps a planar robot in the plane of the first two axes: these coordinates, minus 1 for r33, are 0."""

Terms = dict[tuple[int, ...], fmpq]
"""A polynomial: coefficients by exponents."""


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
        rows += [[int(name == fixed) for name in ORDER] + [constant] for fixed, constant in _PLANE]
    words = limbs(max(abs(value).bit_length() for row in rows for value in row))
    charge(10**6 + len(rows) * words * (10**5 + 3000 * words))
    echelon, lead, rank = fmpz_mat(rows).rref()
    size = len(ORDER)
    pivots = [next(j for j in range(size + 1) if echelon[row, j] != 0) for row in range(rank)]
    return echelon, lead, pivots, [j for j in range(size) if j not in pivots]


def section(legs: Sequence[Leg], metric: Metric) -> tuple[int, list[Terms]]:
    """Number of unknowns, and the quadrics that vanish at the poses (with 1, if no finite pose can exist)."""
    echelon, lead, pivots, free = _solved(legs, metric)
    size = len(ORDER)
    ring = fmpq_mpoly_ctx.get(tuple(ORDER[j] for j in free), Ordering.degrevlex)
    values: list[fmpq_mpoly] = [ring.constant(1)] * size
    for j, unknown in zip(free, ring.gens(), strict=True):
        values[j] = unknown
    units = [(j, tuple(int(j == other) for other in free)) for j in (*free, size)]
    for row, pivot in enumerate(pivots):
        if pivot < size:
            values[pivot] = ring.from_dict({unit: fmpq(-echelon[row, j], lead) for j, unit in units})
    quadrics = [ring.constant(1)] if size in pivots else []
    quadrics += motion_quadrics(values, metric)
    terms = [{tuple(map(int, key)): value for key, value in quadric.to_dict().items()} for quadric in quadrics]
    return len(free), [polynomial for polynomial in terms if polynomial]


def motion_quadrics(values: Sequence[Any], metric: Metric) -> list[Any]:
    """R^T G R = G, R G^-1 R^T = G^-1, cof R = G R G^-1, R u = C, R^T G C = G u, C.C = u.u = s,
    C x (R v) = G R G^-1 (u x v) for the unit vectors v: they hold for rigid motions, and with R = (r_ij) for no others.
    """
    sizes = (int(x.height_bits()) for value in values for x in value.coeffs())
    words = limbs(max(sizes, default=0)) + limbs(max(metric).bit_length())
    charge(2 * 10**7 + words * (10**6 + 2000 * words))
    g = [fmpq(value) for value in metric]
    u, c, s = values[0:3], values[3:6], values[6]
    r = [values[7 + 3 * i : 10 + 3 * i] for i in range(3)]
    found = []
    for i in range(3):
        for j in range(3):
            unit = int(i == j)
            if i <= j:  # both are symmetric
                found.append(sum((g[k] * r[k][i] * r[k][j] for k in range(3)), -unit * g[i]))
                found.append(sum((1 / g[k] * r[i][k] * r[j][k] for k in range(3)), -unit / g[i]))
            (i1, i2), (j1, j2) = CYCLIC[i][1:], CYCLIC[j][1:]
            found.append(r[i1][j1] * r[i2][j2] - r[i1][j2] * r[i2][j1] - g[i] / g[j] * r[i][j])
        found.append(sum((r[i][k] * u[k] for k in range(3)), -c[i]))
        found.append(sum((g[k] * r[k][i] * c[k] for k in range(3)), -g[i] * u[i]))
    found.append(sum((g[k] * c[k] * c[k] for k in range(3)), -s))
    found.append(sum((g[k] * u[k] * u[k] for k in range(3)), -s))
    for axis, up, down in CYCLIC:
        # u x v for the unit vector v along ``axis``
        turned = {up: u[down], down: -u[up]}
        for i, j, k in CYCLIC:
            image = sum((g[i] / g[m] * r[i][m] * value for m, value in turned.items()), 0)
            found.append(c[j] * r[k][axis] - c[k] * r[j][axis] - image)
    return found

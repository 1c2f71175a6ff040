"""Points at infinity of certificates, changed so that only one thing is wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import gcd, lcm
from typing import Any

from flint import fmpq_poly, fmpz_poly

Content = dict[str, Any]
Values = list[fmpq_poly]


def eliminant_of(infinity: Content) -> fmpz_poly:
    """h."""
    return fmpz_poly([int(text, 16) for text in infinity["eliminant"]])


def factors_of(infinity: Content) -> list[fmpz_poly]:
    """The irreducible factors of h."""
    return [factor for factor, _ in eliminant_of(infinity).factor()[1]]


def points_at(infinity: Content, factor: fmpz_poly) -> Values:
    """The 16 coordinates of the points at the roots of a factor of h, as polynomials modulo it."""
    modulus, slope = fmpq_poly(factor), fmpq_poly(eliminant_of(infinity).derivative())
    inverse = (slope % modulus).xgcd(modulus)[1]
    numerators = [fmpq_poly([int(text, 16) for text in z]) for z in infinity["coordinates"]]
    return [z * inverse % modulus for z in numerators]


def infinity_of(
    parts: Sequence[tuple[fmpz_poly, Values]], chart: Sequence[int], form: Sequence[int], multiplicity: int
) -> Content:
    """The entry with points at the roots of coprime factors, in lowest terms."""
    whole = fmpq_poly([1])
    for factor, _ in parts:
        whole *= fmpq_poly(factor)
    numerators = [fmpq_poly([0])] * 16
    for factor, values in parts:
        others = whole / fmpq_poly(factor) if len(parts) > 1 else fmpq_poly([1])
        slope = fmpq_poly(factor).derivative() * others
        inverse = (others % fmpq_poly(factor)).xgcd(fmpq_poly(factor))[1] if len(parts) > 1 else fmpq_poly([1])
        # whole' is factor' others at the roots of the factor; others is 0 at the other roots
        numerators = [
            n + others * (inverse * slope * value % fmpq_poly(factor))
            for n, value in zip(numerators, values, strict=True)
        ]
    polynomials = [whole, *numerators]
    denominator = lcm(*(int(q.denom()) for q in polynomials))
    integers = [[int(c * denominator) for c in q.coeffs()] for q in polynomials]
    content = gcd(*(c for q in integers for c in q)) * (-1 if integers[0][-1] < 0 else 1)
    h, *z = [[hex(c // content) for c in q] for q in integers]
    return {
        "chart": list(chart),
        "separating_form": list(form),
        "eliminant": h,
        "coordinates": z,
        "multiplicity": multiplicity,
    }


def changed_points(
    infinity: Content, change: Callable[[Values], Values], chart: Sequence[int] | None = None
) -> Content:
    """The entry with a change of all points."""
    h = eliminant_of(infinity)
    weights = infinity["chart"] if chart is None else chart
    values = change(points_at(infinity, h))
    return infinity_of([(h, values)], weights, infinity["separating_form"], infinity["multiplicity"])


def isotropic_points() -> Content:
    """Twenty singular points with R = 0, u = 0: s = k and C = (1, i, 0) at t = k + i, and their conjugates."""
    t, parts = fmpq_poly([0, 1]), []
    for k in range(10):
        values = [fmpq_poly([0])] * 16
        values[0], values[4], values[5] = fmpq_poly([k]), fmpq_poly([1]), t - k
        parts.append((fmpz_poly([k * k + 1, -2 * k, 1]), values))
    chart, form = [0] * 16, [0] * 16
    chart[4] = form[0] = form[5] = 1
    return infinity_of(parts, chart, form, 40)

"""Sections that hold a curve, on which enough points are shown to count for all: no quadric may be wrong.

Honest counting at infinity would be a proof; the curve alone tells that it is none.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from operator import attrgetter
from random import Random

from flint import fmpq, fmpq_poly, fmpz_mat, fmpz_poly
from forged_at_infinity import _no_pose
from forged_infinity import infinity_of
from forged_primes import Case
from held_mechanisms import Content, Pose, listing

from pkm_exact.constraints.linear import LinearForm

T = fmpq_poly([0, 1])


def _turn(n: int) -> Pose:
    """By the angle whose half has the tangent 3 n, about the axis through (1, 0, -1) along (1, 2, 2)."""
    return Pose((1, n, 2 * n, 2 * n), (0, 4 * n, -6 * n, 4 * n))


def _coordinates(n: int) -> list[Fraction]:
    """1 + 9 n^2 times s, u, C, R and 1: quadratic in n."""
    position, rotation, turned = _turn(n).quantities()
    square = sum((x * x for x in position), Fraction(0))
    values = [square, *turned, *position, *(x for row in rotation for x in row), Fraction(1)]
    return [(1 + 9 * n * n) * value for value in values]


def _forms(known: Sequence[Sequence[int]]) -> list[list[int]]:
    """Six forms of small integers that vanish at some points, of 17 coordinates."""
    # The rows of [1 | 1000 known^T], reduced: those that are 0 on the right are short forms.
    unit = [[int(j == k) for j in range(17)] + [1000 * row[k] for row in known] for k in range(17)]
    short = [[int(x) for x in row[:17]] for row in fmpz_mat(unit).lll().tolist() if not any(row[17:])]
    random = Random(3)
    weights = [[random.randint(-2, 2) for _ in short] for _ in range(6)]
    return [[sum(w * row[k] for w, row in zip(each, short, strict=True)) for k in range(17)] for each in weights]


def _turning() -> Content:
    """Six forms that hold for all turns about an axis; 18 of these count twice each, and so do two at infinity."""
    known = [[int(x) for x in _coordinates(n)] for n in (-1, 0, 1)]
    constraints = [LinearForm(tuple(map(Fraction, form))) for form in _forms(known)]
    along = [fmpq_poly([fmpq(b), fmpq(c - a, 2), fmpq(a + c - 2 * b, 2)]) for a, b, c in zip(*known, strict=True)]
    poses = [_turn(n) for n in range(18)]
    complete = {"claim": "complete", "completeness_route": "counting-at-infinity", "infinity": _at_its_ends(along)}
    return listing("spatial", poses, constraints, 2, 2) | complete | {"notes": ["." * 9999] * 12}


def _at_its_ends(along: Sequence[fmpq_poly]) -> Content:
    """The points of the curve at infinity, where 9 n^2 + 1 = 0: R = a b^T there and s R = 2 C u^T."""
    modulus = fmpq_poly([1, 0, 9])
    one = 15
    inverse = (along[one] % modulus).xgcd(modulus)[1]
    values = [value * inverse % modulus for value in along[:16]]
    place = next(k for k, value in enumerate(values) if value.degree() == 1)
    start, slope = values[place][0], values[place][1]
    h = (T - start) ** 2 + slope**2 / 9
    factor = fmpz_poly([int(c) for c in (h * h.denom()).coeffs()])
    chart, form = ([int(k == which) for k in range(16)] for which in (one, place))
    return infinity_of([(factor, [value((T - start) / slope) for value in values])], chart, form, 4)


def _lines(point: Sequence[complex], imaginary: int, chart: Mapping[int, int], form: Mapping[int, int]) -> Content:
    """A point at infinity and its conjugate, on lines along which |C|^2 changes: pairs of them count for all.

    In the chart its imaginary part is 0, and the separating form is ``imaginary`` times i.
    """
    parts = []
    for k in range(1, 21 if any(point[7:]) else 11):  # where R is 0 each counts twice
        i = (T - k) / imaginary
        values = [int(complex(x).real) + int(complex(x).imag) * i for x in point]
        parts.append((fmpz_poly([k * k + imaginary**2, -2 * k, 1]), [fmpq_poly([k]), *values[1:]]))
    weights = [[entries.get(k, 0) for k in range(16)] for entries in (chart, {0: 1} | dict(form))]
    known = [[int(part(complex(x))) for x in (*point, 0)] for part in (attrgetter("real"), attrgetter("imag"))]
    return _no_pose(_forms([[1, *[0] * 16], *known]), infinity_of(parts, weights[0], weights[1], 40))


NOT_FINITE = "section: not proved finite"
CURVES: dict[str, Case] = {
    "turns about an axis": (_turning, "rejected", NOT_FINITE),
    "lines at infinity where R is 0": (
        lambda: _lines([0, 3, 4, 5j, *[0] * 12], 5, {1: -1, 2: 1}, {3: 1}),
        "rejected",
        NOT_FINITE,
    ),
    "lines at infinity where C is 0": (
        lambda: _lines([*[0] * 7, *[x * y for x in (0, 1, 1j) for y in (0, 1, 1j)]], 1, {11: 1}, {12: 1}),
        "rejected",
        NOT_FINITE,
    ),
}

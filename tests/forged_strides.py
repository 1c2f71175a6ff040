"""Certificates of systems whose eliminant is a polynomial in T^m: honest ones, and others wrong in one part only.

With x = T all coordinates are polynomials in the root, p(T); a value is a sum of T^r V_r(T^m), r = 0, .., m - 1.
There is one polynomial, in more unknowns: so nothing is known but that the points listed are on it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from handmade_systems import Content, hexadecimal, listed, trimmed
from tables_of_rows import merged

Row = tuple[Content, str]
"""A certificate without its digest, and the verdict."""

SIXTH = {6: 1, 3: -3, 0: 1}
EIGHTH = {8: 1, 6: -10, 4: 35, 2: -50, 0: 24}
"""(T^2 - 1) (T^2 - 2) (T^2 - 3) (T^2 - 4)."""
MODULI = {2: EIGHTH, 3: SIXTH}
ONE = {0: 1}


def _text(polynomial: Mapping[int, int], name: str = "x") -> str:
    """In the spelling of certificates."""
    terms = [f"{value}*{name}^{power}" if power else f"{value}" for power, value in polynomial.items() if value]
    return "+".join(terms).replace("+-", "-")


def _added(*polynomials: Mapping[int, int]) -> dict[int, int]:
    powers = {power for polynomial in polynomials for power in polynomial}
    return {power: sum(each.get(power, 0) for each in polynomials) for power in sorted(powers, reverse=True)}


def _raised(polynomial: Mapping[int, int], steps: int) -> dict[int, int]:
    return {power + steps: value for power, value in polynomial.items()}


def _numerator(h: Mapping[int, int], p: Mapping[int, int]) -> list[int]:
    """What a monic h leaves of p h'."""
    degree = max(h)
    rest = [0] * (degree + max(h) + max(p, default=0))
    for power, value in p.items():
        for other, factor in h.items():
            if other:
                rest[power + other - 1] += value * other * factor
    for top in range(len(rest) - 1, degree - 1, -1):
        lead = rest[top]
        for other, factor in h.items():
            rest[top - degree + other] -= lead * factor
    return trimmed(rest)


def _system(
    h: Mapping[int, int],
    coordinates: Sequence[Mapping[int, int]],
    *texts: str,
    form: Sequence[int] = (),
    added: Sequence[Mapping[int, int]] = (),
) -> Content:
    """Of x, y, ..: polynomials in T at the roots of h; ``added`` to their numerators."""
    numerators = [_numerator(h, p) for p in coordinates]
    for numerator, more in zip(numerators, added, strict=False):
        numerator += [0] * (max(h) - len(numerator))
        for power, value in more.items():
            numerator[power] += value
    representation = {
        "separating_form": list(form or (1, *(0 for _ in coordinates[1:]))),
        "eliminant": hexadecimal([h.get(power, 0) for power in range(max(h) + 1)]),
        "numerators": [hexadecimal(trimmed(numerator)) for numerator in numerators],
    }
    return listed("x,y,z"[: 2 * len(coordinates) - 1], texts, representation, multiplicities=None)


def _values(m: int) -> dict[str, Row]:
    """A further polynomial, its value 0 in all parts, or in all but one."""
    h = MODULI[m]
    multiple = _added(*(_raised(h, r) for r in range(m)))
    points = [{1: 1}, {2: 1}, {3: -4}]
    found = {
        f"{m} parts": (_system(h, points, _text(multiple)), "accepted"),
        f"{m} parts, of products": (_system(h, points, "y^3-x^6+z^2-16*x^2*y^2+x*z+4*y^2+y*z+4*x^5"), "accepted"),
    }
    for r in range(m):
        wrong = _text(_added(multiple, {r: 1}))
        found[f"{m} parts, only {r} wrong"] = _system(h, points, wrong), "rejected"
        other = f"y^3-x^6+z+4*x^3+x^{r}*z*y+4*x^{r + 1}*y^2+x^{r}"
        found[f"{m} parts, only {r} of products wrong"] = _system(h, points, other), "rejected"
    return found


def _numerators(m: int) -> dict[str, Row]:
    """A numerator with one term more, in each part."""
    h = MODULI[m]
    found: dict[str, Row] = {}
    for power in range(m + 1):
        more = {power: 2}
        found[f"{m} parts, T^{power} more in y"] = (
            _system(h, [{1: 1}, {2: 1}], "y-x^2", added=[{}, more]),
            "rejected",
        )
        found[f"{m} parts, T^{power} more in x"] = (
            _system(h, [{1: 1}, {}], _text(h), form=(1, 1), added=[more, {power: -2}]),
            "rejected",
        )
    for r in range(m):
        y = {1: 1, 2: 1, 3: 1, 4: 1}
        kept = {power: value for power, value in y.items() if power % m != r}
        text = f"y-{_text(y).replace('+', '-')}"
        found[f"{m} parts, y in all"] = _system(h, [{1: 1}, y], text), "accepted"
        found[f"{m} parts, part {r} of y lost"] = _system(h, [{1: 1}, kept], text), "rejected"
    return found


def _not_in_powers() -> dict[str, Row]:
    """Eliminants that are polynomials in T only, though the numerators, or the degree, are of a larger step."""
    sparse, odd, even = {6: 1, 1: -1}, {5: 1, 3: -3, 1: 1}, {4: 1, 2: -3, 1: 1, 0: 1}
    pure = {6: 1, 0: -2}
    return {
        "numerators of one term": (_system(sparse, [{1: 1}, {}], _text(sparse)), "accepted"),
        "numerators of one term, a power": (_system(sparse, [{1: 1}, {}], "x^6"), "rejected"),
        "an odd eliminant": (_system(odd, [{1: 1}, {3: 1}], "y+x^5-4*x^3+x"), "accepted"),
        "an odd eliminant, 0 forgotten": (_system(odd, [{1: 1}, {3: 1}], "x^4-3*x^2+1"), "rejected"),
        "an odd term": (_system(even, [{1: 1}, {2: 1}], "y-x^2"), "accepted"),
        "an odd term forgotten": (_system(even, [{1: 1}, {2: 1}], "x^4-3*x^2+1"), "rejected"),
        "one root": (_system({1: 1, 0: -2}, [{1: 1}, {}], "x-2+y"), "accepted"),
        "a root at 0": (_system({1: 1}, [{1: 1}, {0: 3}], "x+y-3"), "accepted"),
        "a root at 0, and another place": (_system({1: 1}, [{1: 1}, {0: 3}], "x+y"), "rejected"),
        "a pure power": (_system(pure, [{1: 1}, {4: 1}], "x^2*y-2"), "accepted"),
        "a pure power, a wrong constant": (_system(pure, [{1: 1}, {4: 1}], "x^2*y-3"), "rejected"),
        "a pure power, a wrong exponent": (_system(pure, [{1: 1}, {4: 1}], "x*y-2"), "rejected"),
    }


ROWS: dict[str, Row] = merged(_values(2), _values(3), _numerators(2), _numerators(3), _not_in_powers())

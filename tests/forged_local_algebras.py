"""Systems with multiple solutions whose parameters are conjugate: the local algebras are over number fields.

All are made by hand: u and v vanish at the solutions, fulfil equations whose local algebra is known, and z has a
minimal polynomial.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import prod
from typing import Any

from flint import Ordering, fmpz, fmpz_mpoly, fmpz_mpoly_ctx
from forged_system_cases import FIRST, Row, counted, one
from handmade_systems import ENDS, Content, complete, hexadecimal, listed, multiplied, represented, trimmed

X, Y, Z = fmpz_mpoly_ctx.get(("x", "y", "z"), Ordering.lex).gens()
Local = Callable[[Any, Any], tuple[fmpz_mpoly, ...]]

CUBIC = (-1, -1, 0, 1)
"""z^3 - z - 1."""
SQUARE_ROOT = (-2, 0, 1)
TWO = (-2, 1)
LOCAL: dict[str, tuple[Local, int]] = {
    "curved": (lambda u, v: (u**2 - v, u * v, v**2), 3),
    "flat": (lambda u, v: (u**2, v**3, u * v**2), 5),
    "long": (lambda u, v: (u**3 - v, u**2 * v, u * v**2, v**2), 5),
    "oblique": (lambda u, v: (3 * u**2 + u * v - 2 * v, u * v + v**2, v**2), 3),
    "parabola": (lambda u, v: (u**2 - v, u**4 - v**2, v**3), 6),
    "turning": (lambda u, v: (u**2 - Z * v, u * v, v**2), 3),
    "square and cube": (lambda u, v: (u**2, v**3), 6),
    "curved over the field": (lambda u, v: (2 * v**2 + (1 + Z) * u, 2 * v**3 + (1 + Z) * u * v - u * v**2, u**2), 4),
}
"""Polynomials in u and v, and the dimension of the algebra."""
PLACES: dict[str, tuple[fmpz_mpoly, fmpz_mpoly, tuple[int, ...], tuple[int, ...]]] = {
    "at (z, z)": (X - Z, Y - Z, (0, 1), (0, 1)),
    "at (z, 1 - z)": (X - Z, X + Y - 1, (0, 1), (1, -1)),
    "at (z, z), exchanged": (Y - Z, X - Z, (0, 1), (0, 1)),
    "at (2, 3 z)": (X - 2, Y - 3 * Z + X - 2, (2,), (0, 3)),
}
"""u, v, and x and y there as polynomials in z."""


def along(minimal: tuple[int, ...], *values: tuple[int, ...]) -> Content:
    """The solutions (values at z, .., z) at the roots z, the parameters, of a polynomial with leading coefficient 1."""
    degree = len(minimal) - 1
    slope = [k * c for k, c in enumerate(minimal)][1:]
    numerators = []
    for value in (*values, (0, 1)):
        product = [int(c) for c in multiplied(value, slope)]
        while len(product) > degree:
            top, shift = product.pop(), len(product) - degree
            product = [c - top * minimal[k - shift] if k >= shift else c for k, c in enumerate(product)]
        numerators.append(hexadecimal(trimmed(product)))
    form = [0] * len(values) + [1]
    return {"separating_form": form, "eliminant": hexadecimal(minimal), "numerators": numerators}


def fat(local: str, place: str, minimal: tuple[int, ...], said: int = 0) -> Content:
    """All solutions are of one kind; their multiplicity is called as it is, or another."""
    (make, number), (u, v, *values) = LOCAL[local], PLACES[place]
    texts = [*make(u, v), sum((c * Z**k for k, c in enumerate(minimal)), 0 * Z)]
    points = along(minimal, *values)
    total = number * (len(minimal) - 1)
    made = listed("x,y,z", [str(text).replace(" ", "") for text in texts], points, multiplicities=said or number)
    return made | complete("modular-rank", total)


CONJUGATE: dict[str, Row] = {
    f"{local} {place}": (fat(local, place, minimal), "accepted")
    for place, minimal in zip(PLACES, (TWO, CUBIC, CUBIC, SQUARE_ROOT), strict=True)
    for local in LOCAL
}


def powers(*factors: tuple[tuple[int, ...], int], multiplicities: list[int], exponent: int = 40) -> Content:
    """The roots of a product of powers of polynomials in x."""
    all_, once = [Fraction(1)], [Fraction(1)]
    for factor, power in factors:
        once = multiplied(once, factor)
        for _ in range(power):
            all_ = multiplied(all_, factor)
    text = "+".join(f"{int(c)}*x^{k}" if k else f"{int(c)}" for k, c in enumerate(all_) if c).replace("+-", "-")
    points = one(*map(int, once))
    made = listed("x", (text,), points, exponent=exponent if multiplicities else 0, multiplicities=multiplicities)
    return made | complete("modular-rank", len(all_) - 1)


HIDDEN = (
    (35441, -49236),
    (-7513, 72181),
    (-66652, 74827),
    (-10256, -5756),
    (16342, 23765),
    (-32278, -6629),
    (15792, 35802),
    (23424, -106656),
)
"""Times any number, entries of an echelon form that twelve combinations of its rows and columns do not show: 0."""


def hidden(places: tuple[int, ...], said: int = 4) -> Content:
    """Ten variables, of which linear equations leave two: a solution of multiplicity 4.

    The entries of their echelon form are 0 modulo those of the first primes that are named, and not modulo others.
    """
    primes = [number for number in range((1 << 63) - 25, (1 << 63) - 400, -2) if fmpz(number).is_prime()]
    large = prod(primes[place - 1] for place in places)
    names = [f"x{i}" for i in range(10)]
    equations = [f"{names[i]}+{a * large}*x8+{b * large}*x9" for i, (a, b) in enumerate(HIDDEN)]
    a, b = (value * large for value in HIDDEN[0])
    texts = (*equations, "x8^2", "x9^2", f"x0*x8+{a}*x8^2+{b}*x8*x9")
    origin = represented([(0,) * 10], (1, *[0] * 9))
    spelled = [text.replace("+-", "-") for text in texts]
    return listed(",".join(names), spelled, origin, multiplicities=said) | complete("modular-rank", said)


SQUARE_ROOT_OF_3 = (-3, 0, 1)
THREE, ONE, NOTHING = (-3, 1), (-1, 1), (0, 1)
TOO_DEAR = 8, 1000
FAR_TOO_DEAR = 10, 1300
"""Degrees and digits: functionals take more than their part of the work, or more than all; the algebra does not."""


def dear(degree: int, digits: int) -> Content:
    """Three times the roots of a number, none of them real."""
    made = powers(((10**digits + 7, *[0] * (degree - 1), 1), 3), multiplicities=[])
    return made | complete("exact-elimination", 3 * degree, elimination=[])


FAR = 10**150 + 7


def laborious(points: Content, multiplicities: list[int], *factors: tuple[tuple[int, ...], int]) -> Content:
    """x is a number, y = z, and z a root of a product of powers: functionals take more than their part of the work.

    For a last polynomial, which follows from the others: it has high degrees in all variables and large coefficients.
    """
    product = [Fraction(1)]
    for factor, power in factors:
        for _ in range(power):
            product = multiplied(product, factor)
    terms = [(int(value), k) for k, value in enumerate(product) if value]
    texts = (
        f"x-{FAR}",
        "y-z",
        "+".join(f"{value}*z^{k}" for value, k in terms),
        "+".join(f"{value * 10**3700}*x^20*y^10*z^{k}" for value, k in terms),
    )
    made = listed("x,y,z", [text.replace("+-", "-") for text in texts], points, multiplicities=multiplicities)
    return made | complete("exact-elimination", len(product) - 1, elimination=[])


LABORIOUS = {
    "ten and two": laborious(represented([(FAR, 1, 1), (FAR, 2, 2)], (0, 0, 1)), [10, 2], (ONE, 10), (TWO, 2)),
    "ten times the roots of the first prime": laborious(
        {
            "separating_form": [0, 0, 1],
            "eliminant": hexadecimal([-FIRST, 0, 1]),
            "numerators": [hexadecimal([0, 2 * FAR]), *[hexadecimal([2 * FIRST])] * 2],
        },
        [10, 10],
        ((-FIRST, 0, 1), 10),
    ),
}

SECOND = ("x-y^2", "z-x", "x^2", "y^2*z")

ROWS: dict[str, Row] = {
    **CONJUGATE,
    **{
        f"large numbers that are 0 modulo primes {places}, multiplicity {said}": (
            hidden(places, said),
            "accepted" if said == 4 else "rejected",
        )
        for places in ((1, 2), (1, 2, 4, 5), (1, 2, 3, 4))
        for said in (3, 4, 5)
    },
    "three at 20, two at 1": (powers((ONE, 2), ((-20, 1), 3), multiplicities=[2, 3]), "accepted"),
    **{
        f"two variables of second order, multiplicity {said}": (
            listed("x,y,z", SECOND, represented([(0,) * 3], (0, 1, 0)), multiplicities=said)
            | complete("modular-rank", said),
            "accepted" if said == 4 else "rejected",
        )
        for said in (3, 4)
    },
    "too dear for functionals": (dear(*TOO_DEAR), "accepted"),
    "a double solution, and two at infinity": (
        counted(("x*y-1", "x*y+x+y-3"), represented([(1, 1)], (1, 1)), ENDS, 2, multiplicities=2),
        "accepted",
    ),
    "a double solution, and two at infinity, called simple": (
        counted(("x*y-1", "x*y+x+y-3"), represented([(1, 1)], (1, 1)), ENDS, 2, multiplicities=1),
        "rejected",
    ),
    "three, two and one": (powers((ONE, 3), (TWO, 2), (THREE, 1), multiplicities=[3, 2, 1]), "accepted"),
    "three, two and one, and irrational": (
        powers((SQUARE_ROOT, 3), (SQUARE_ROOT_OF_3, 2), (ONE, 1), multiplicities=[2, 3, 1, 3, 2]),
        "accepted",
    ),
    "three and two, exchanged": (
        powers((SQUARE_ROOT, 3), (SQUARE_ROOT_OF_3, 2), (ONE, 1), multiplicities=[3, 2, 1, 2, 3]),
        "rejected",
    ),
    "a double one that is exact, and others": (
        powers((NOTHING, 3), (ONE, 3), (THREE, 2), multiplicities=[3, 3, 2]),
        "accepted",
    ),
    "in cells that touch": (
        powers(((-1, 3), 3), ((-(1 << 32) - 3, 3 << 32), 3), multiplicities=[3, 3]),
        "accepted",
    ),
    "twice, in cells that touch": (
        powers(((-1, 3), 2), ((-(1 << 32) - 3, 3 << 32), 2), multiplicities=[2, 2]),
        "accepted",
    ),
    "beside 2^-100": (
        powers((NOTHING, 3), ((-1, 1 << 100), 3), multiplicities=[3, 3], exponent=110),
        "accepted",
    ),
}

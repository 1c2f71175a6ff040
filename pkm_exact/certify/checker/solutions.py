"""The complex solutions: that the roots of the eliminant are poses of the robot, and distinct ones. All exact.

h is the eliminant, D its degree, (E, F) the numerators; at a root t of h the point is (e, f) = (E, F)(t) / h'(t).
Proofs modulo a prime: let p be a prime that does not divide the leading coefficient of h0, the primitive part of h.
A common factor of h0 and an integer polynomial g keeps its degree modulo p, because its leading coefficient divides
that of h0. So if h0 and g are coprime modulo p, no root of h is one of g.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from hashlib import sha256
from itertools import islice
from math import gcd, prod
from typing import Any, Final

from flint import fmpz, fmpz_poly, nmod_poly
from flint.utils.flint_exceptions import DomainError

from pkm_exact.certify.checker.budget import charge, limbs, polynomials_cost
from pkm_exact.certify.checker.document import Representation
from pkm_exact.certify.checker.quadrics_at_roots import are_multiples, integers_beside, quadrics_cost, values_at
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric, combination, leg_form, motion
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER, rejected

PRIMES: Final = tuple((1 << 63) - offset for offset in (25, 165))
"""Primes of the checker's own; any prime serves, several because one may divide something by accident."""
MORE_PRIMES: Final = 4
"""How many others are tried after these, which follow from the eliminant: no robot meets them by accident."""


def primitive_part(h: fmpz_poly) -> fmpz_poly:
    """h divided by the greatest common divisor of its coefficients."""
    charge(_content_cost(h))
    content = h.content()
    return fmpz_poly([coefficient // content for coefficient in h.coeffs()])


def _content_cost(polynomial: fmpz_poly) -> int:
    """Operations for the content of a polynomial and the division by it."""
    words = limbs(int(polynomial.height_bits()))
    return int(polynomial.length()) * (1000 + words * (80 + words // 8))


def charge_products(representation: Representation, number: int) -> None:
    """Charge so many products of a numerator, or of the eliminant, and one of them."""
    polynomials = (representation.eliminant, *representation.quaternion, *representation.translation)
    words = max(limbs(int(polynomial.height_bits())) for polynomial in polynomials)
    charge(number * polynomials_cost(2 * max(int(polynomial.length()) for polynomial in polynomials), words))


def check_eliminant(representation: Representation) -> Iterator[str]:
    """h is squarefree of degree at most 40, its leading coefficient positive, all coefficients in lowest terms."""
    h = representation.eliminant
    if h.degree() > GREATEST_NUMBER:
        raise rejected(f"eliminant: degree {h.degree()}, but six legs have at most {GREATEST_NUMBER} isolated poses")
    polynomials = (h, *representation.quaternion, *representation.translation)
    charge(sum(map(_content_cost, polynomials)))
    if h.leading_coefficient() < 0 or gcd(*(int(polynomial.content()) for polynomial in polynomials)) != 1:
        raise rejected("eliminant: not in lowest terms with positive leading coefficient")
    h0 = primitive_part(h)
    if not proved_coprime(h0, lambda p: modulo(h0.derivative(), p)):
        raise rejected("eliminant: not proved squarefree")
    yield f"eliminant: squarefree of degree {h.degree()}"


def check_distinct(representation: Representation) -> Iterator[str]:
    """w.e = 1 and the separating form is t at every root t: different roots give different (e, f).

    Both as identities of polynomials: w.E = h', and c.(E, F) = T h' - D h, where both sides have degree below D.
    """
    h, slope = representation.eliminant, representation.eliminant.derivative()
    numerators = (*representation.quaternion, *representation.translation)
    if any(numerator.degree() >= h.degree() for numerator in numerators):
        raise rejected("representation: a numerator has not a smaller degree than the eliminant")
    if combination(representation.chart, representation.quaternion) != slope:
        raise rejected("chart: w.e is not 1 at the roots of the eliminant")
    yield "chart: w.e = 1 at every solution"
    if combination(representation.separating_form, numerators) != fmpz_poly([0, 1]) * slope - h.degree() * h:
        raise rejected("separating form: its values are not the roots of the eliminant")
    yield f"separating form: takes {h.degree()} different values, the solutions are distinct"


def check_poses(representation: Representation, legs: Sequence[Leg], metric: Metric) -> Iterator[str]:
    """At every root of h: e.f = 0, N(e) is not 0, and the six legs have their lengths. Degrees were checked before.

    The entries of E have most of the denominator in common: without it numbers are shorter by a third.
    """
    h0 = primitive_part(representation.eliminant)
    e, f = representation.quaternion, representation.translation
    if len(legs) == PLANAR_LEGS and any((e[1], e[2], f[0], f[3])):
        raise rejected("motion: e1, e2, f0 and f3 are not all 0, but the robot is planar")
    forms = [*_without_squares([leg_form(leg, metric) for leg in legs])]
    places, divisors = integers_beside(h0)
    charge(sum(map(_content_cost, e)))
    common = gcd(*(int(value.content()) for value in e))
    primitive = [value / common for value in e]
    turn, shift = ([values_at(places, value) for value in part] for part in (primitive, f))
    charge(quadrics_cost([*turn, *shift], [*forms, [prod(metric)]], common))
    placed = motion(turn, shift, metric)
    *coordinates, square = placed.coordinates()
    values = [placed.study]
    for *form, squares in forms:
        value = common * combination(form[:10], coordinates[:10]) + combination(form[10:], coordinates[10:])
        values.append(common * value + squares * square if squares else value)
    study, *hold = are_multiples(values, divisors)
    if not study:
        raise rejected("motion: e.f is not 0 at every root of the eliminant")
    if not proved_coprime(h0, lambda p: _norm([modulo(value, p) for value in primitive], metric)):
        raise rejected("motion: not proved that N(e) is nowhere 0")
    yield "motion: e.f = 0 and N(e) is not 0, every solution is a rigid motion"
    if not all(hold):
        raise rejected(f"legs: leg {hold.index(False) + 1} does not have its length at every solution")
    yield f"legs: all {len(legs)} have their lengths at every solution"


def _norm(e: Sequence[nmod_poly], metric: Metric) -> Any:
    """N(e) modulo a prime."""
    return combination((prod(metric), *metric), [value * value for value in e])


def _without_squares(forms: Sequence[Sequence[int]]) -> Iterator[Sequence[int]]:
    """The first form, and multiples of the others minus multiples of it, without |C|^2, of which none is 0."""
    first, *others = forms
    yield first
    for form in others:
        yield [first[-1] * one - form[-1] * other for one, other in zip(form, first, strict=True)]


def irreducible_factors(h0: fmpz_poly) -> list[fmpz_poly]:
    """The irreducible factors of a primitive squarefree polynomial, over Z."""
    words = limbs(int(h0.height_bits()))
    charge(2 * 10**7 + words * (10**6 + 1000 * words))
    return [factor for factor, _ in h0.factor()[1]]


def algebraic_cost(factor: fmpz_poly, representation: Representation, degree: int) -> int:
    """Operations for a product in Q[T] / factor of forms of a degree, in sum, in the numerators.

    To reduce a polynomial modulo a factor makes its coefficients longer by those of the factor, for each power of T.
    """
    numerators = (*representation.quaternion, *representation.translation)
    words = max(limbs(int(value.height_bits())) for value in numerators)
    words += int(representation.eliminant.degree()) * limbs(int(factor.height_bits()))
    return 4 * polynomials_cost(2 * int(factor.length()), degree * words)


def proved_coprime(h0: fmpz_poly, image: Callable[[int], nmod_poly], *, briefly: bool = False) -> bool:
    """Whether h0 is coprime, modulo one of the primes, to a polynomial over Z that is given by its images.

    Briefly: modulo the first of those that follow from h0, which few polynomials meet by accident.
    """
    primes = islice(primes_for(h0), len(PRIMES), len(PRIMES) + 1) if briefly else primes_for(h0)
    usable = (p for p in primes if int(h0.leading_coefficient()) % p)
    for p in usable:
        charge(100 * int(h0.length()) ** 2)
        if modulo(h0, p).gcd(image(p)).degree() == 0:
            return True
    return False


def primes_for(h: fmpz_poly) -> Iterator[int]:
    """Primes to try with a polynomial, of 63 bits."""
    yield from PRIMES
    digest = sha256(",".join(hex(int(value)) for value in h.coeffs()).encode()).digest()
    for place in range(MORE_PRIMES):
        n = 1 << 62 | int.from_bytes(digest[8 * place : 8 * place + 8]) >> 2 | 1
        while not fmpz(n).is_prime():
            n += 2
        yield n


def modulo(polynomial: fmpz_poly, p: int) -> nmod_poly:
    """The image of a polynomial modulo a prime."""
    charge(int(polynomial.length()) * (500 + 20 * limbs(int(polynomial.height_bits()))))
    return nmod_poly(polynomial, p)


def vanishes(value: fmpz_poly, h0: fmpz_poly) -> bool:
    """Whether h0, primitive, divides an integer polynomial over Q; it then divides it over Z (Gauss)."""
    # If it does not, the coefficients of the quotient grow by those of h0 from one to the next.
    steps = max(int(value.length() - h0.length()), 0) + 1
    words = limbs(int(value.height_bits())) + steps * limbs(int(h0.height_bits()))
    charge(3 * polynomials_cost(steps + int(h0.length()), words))
    try:
        value / h0
    except DomainError:  # a remainder is left
        return False
    return True

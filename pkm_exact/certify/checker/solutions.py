"""The complex solutions: that the roots of the eliminant are poses of the robot, and distinct ones. All exact.

h is the eliminant, D its degree, (E, F) the numerators; at a root t of h the point is (e, f) = (E, F)(t) / h'(t).
Proofs modulo a prime: let p be a prime that does not divide the leading coefficient of h0, the primitive part of h.
A common factor of h0 and an integer polynomial g keeps its degree modulo p, because its leading coefficient divides
that of h0. So if h0 and g are coprime modulo p, no root of h is one of g.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import gcd
from typing import Final

from flint import fmpz_poly, nmod_poly

from pkm_exact.certify.checker.document import Representation
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric, combination, leg_form, motion
from pkm_exact.certify.checker.verdict import GREATEST_NUMBER, rejected

PRIMES: Final = tuple((1 << 63) - offset for offset in (25, 165, 259, 301, 375, 387))
"""Primes of the checker's own; any prime serves, several because one may divide something by accident."""


def primitive_part(h: fmpz_poly) -> fmpz_poly:
    """h divided by the greatest common divisor of its coefficients."""
    return fmpz_poly([coefficient // h.content() for coefficient in h.coeffs()])


def check_eliminant(representation: Representation) -> Iterator[str]:
    """h is squarefree of degree at most 40, its leading coefficient positive, all coefficients in lowest terms."""
    h = representation.eliminant
    if h.degree() > GREATEST_NUMBER:
        raise rejected(f"eliminant: degree {h.degree()}, but six legs have at most {GREATEST_NUMBER} isolated poses")
    polynomials = (h, *representation.quaternion, *representation.translation)
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
    """At every root of h: e.f = 0, N(e) is not 0, and the six legs have their lengths."""
    h0 = primitive_part(representation.eliminant)
    e, f = representation.quaternion, representation.translation
    if len(legs) == PLANAR_LEGS and any((e[1], e[2], f[0], f[3])):
        raise rejected("motion: e1, e2, f0 and f3 are not all 0, but the robot is planar")
    placed = motion(representation.quaternion, representation.translation, metric)
    if not vanishes(placed.study, h0):
        raise rejected("motion: e.f is not 0 at every root of the eliminant")
    if not proved_coprime(h0, lambda p: modulo(placed.norm, p)):
        raise rejected("motion: not proved that N(e) is nowhere 0")
    yield "motion: e.f = 0 and N(e) is not 0, every solution is a rigid motion"
    coordinates = placed.coordinates()
    for number, leg in enumerate(legs, 1):
        if not vanishes(combination(leg_form(leg, metric), coordinates), h0):
            raise rejected(f"legs: leg {number} does not have its length at every solution")
    yield f"legs: all {len(legs)} have their lengths at every solution"


def proved_coprime(h0: fmpz_poly, image: Callable[[int], nmod_poly]) -> bool:
    """Whether h0 is coprime, modulo one of the primes, to a polynomial over Z that is given by its images."""
    usable = (p for p in PRIMES if int(h0.leading_coefficient()) % p)
    return any(modulo(h0, p).gcd(image(p)).degree() == 0 for p in usable)


def modulo(polynomial: fmpz_poly, p: int) -> nmod_poly:
    """The image of a polynomial modulo a prime."""
    return nmod_poly([int(coefficient) % p for coefficient in polynomial.coeffs()], p)


def vanishes(value: fmpz_poly, h0: fmpz_poly) -> bool:
    """Whether h0, primitive, divides an integer polynomial over Q; it then divides it over Z (Gauss)."""
    return not divmod(value, h0)[1]

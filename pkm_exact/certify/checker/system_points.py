"""The complex solutions of a system: that the roots of an eliminant are solutions, and distinct ones. All exact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from math import gcd
from operator import mul

from flint import fmpz, fmpz_poly

from pkm_exact.certify.checker.budget import charge, limbs, polynomials_cost
from pkm_exact.certify.checker.solutions import modulo, primitive_part, proved_coprime
from pkm_exact.certify.checker.study_motion import combination
from pkm_exact.certify.checker.system_document import InfinitePoints, Points
from pkm_exact.certify.checker.system_terms import Monomial, Terms, degree, top_form
from pkm_exact.certify.checker.verdict import rejected


def check_points(points: Points, polynomials: Sequence[Mapping[Monomial, int]], where: str = "") -> Iterator[str]:
    """Every root of the eliminant is a solution of all polynomials, and different roots are different solutions."""
    yield from check_distinct_points(points, where)
    values = _Values(points)
    for number, polynomial in enumerate(polynomials, 1):
        if not values.are_zero(polynomial):
            raise rejected(f"{where}polynomials: number {number} is not 0 at every root of the eliminant")
    yield f"{where}polynomials: all {len(polynomials)} are 0 at every root of the eliminant"


def check_distinct_points(points: Points, where: str = "") -> Iterator[str]:
    """The eliminant is squarefree, and the form takes the value t at every root t."""
    h, numerators = points.eliminant, points.numerators
    bits = max(int(value.height_bits()) for value in (h, *numerators))
    charge((len(numerators) + 2) * int(h.length()) * (2000 + 100 * limbs(bits) * (1 + limbs(bits) // 8)))
    if h.leading_coefficient() < 0 or gcd(*(int(value.content()) for value in (h, *numerators))) != 1:
        raise rejected(f"{where}eliminant: not in lowest terms with positive leading coefficient")
    h0, slope = primitive_part(h), h.derivative()
    if not proved_coprime(h0, lambda p: modulo(h0.derivative(), p)):
        raise rejected(f"{where}eliminant: not proved squarefree")
    if any(numerator.degree() >= h.degree() for numerator in numerators):
        raise rejected(f"{where}representation: a numerator has not a smaller degree than the eliminant")
    yield f"{where}eliminant: squarefree of degree {h.degree()}"
    if combination(points.form, numerators) != fmpz_poly([0, 1]) * slope - h.degree() * h:
        raise rejected(f"{where}separating form: its values are not the roots of the eliminant")
    yield f"{where}separating form: takes {h.degree()} different values, the solutions are distinct"


def check_at_infinity(infinity: InfinitePoints, polynomials: Sequence[Terms]) -> Iterator[str]:
    """The points are distinct, in their chart, and common to all polynomials at infinity."""
    yield from check_distinct_points(infinity.points, "infinity: ")
    if combination(infinity.chart, infinity.points.numerators) != infinity.points.eliminant.derivative():
        raise rejected("infinity: w.z is not 1 at the roots of the eliminant")
    values = _Values(infinity.points)
    if not all(values.are_zero(top_form(polynomial)) for polynomial in polynomials):
        raise rejected("infinity: a point is not on all polynomials")
    yield f"infinity: {infinity.points.eliminant.degree()} points are common to all polynomials"


def _divides(h0: fmpz_poly, value: fmpz_poly) -> bool:
    """Whether h0, primitive, divides a polynomial over Z: first modulo a prime, so that what is divided, divides.

    The prime follows from the polynomials; with a remainder the numbers of an exact division would grow.
    """
    words, steps = limbs(int(value.height_bits())), max(int(value.length() - h0.length()), 0) + 1
    charge(int(value.length()) * (1000 + 100 * words))
    digest = sha256(",".join(hex(int(entry)) for entry in (*h0.coeffs(), *value.coeffs())).encode()).digest()
    p = 1 << 61 | int.from_bytes(digest[:8]) >> 3 | 1
    while not fmpz(p).is_prime():
        p += 2
    charge(polynomials_cost(steps + int(h0.length()), 8))
    modulus = modulo(h0, p)
    if modulus.degree() == h0.degree() and modulo(value, p) % modulus:
        return False
    charge(3 * polynomials_cost(steps + int(h0.length()), words + limbs(int(h0.height_bits()))))
    return not divmod(value, h0)[1]


class _Values:
    """h'^d F(N / h') for polynomials F of degree d; products are kept.

    If h is a polynomial in T^m, and each N_i one times T^r_i, all is computed with polynomials in S = T^m. A value is a
    sum of T^r V_r(S) with r < m. What h0 leaves of each has exponents r, r + m, .. only: it is 0 for all or not for the
    sum.
    """

    def __init__(self, points: Points) -> None:
        h0, slope = primitive_part(points.eliminant), points.eliminant.derivative()
        self.stride = m = _stride(h0, points.numerators)
        self.modulus = fmpz_poly(h0.coeffs()[::m])
        self.places = [_lowest(numerator) % m for numerator in points.numerators]
        self.numerators = [fmpz_poly(n.coeffs()[r::m]) for r, n in zip(self.places, points.numerators, strict=True)]
        self.slope = fmpz_poly(slope.coeffs()[m - 1 :: m])
        self.words = limbs(max(int(value.height_bits()) for value in (slope, *points.numerators)))
        self.terms = int(self.slope.length())
        self.known: dict[Monomial, fmpz_poly] = {(0,) * len(self.numerators): fmpz_poly([1])}
        self.powers = [fmpz_poly([1])]

    def are_zero(self, polynomial: Mapping[Monomial, int]) -> bool:
        """Whether h0 divides the value."""
        return all(_divides(self.modulus, part) for part in self.of(polynomial).values())

    def of(self, polynomial: Mapping[Monomial, int]) -> dict[int, fmpz_poly]:
        """V_r by r."""
        most = degree(polynomial)
        while len(self.powers) <= most:
            self._charge(len(self.powers))
            self.powers.append(self.powers[-1] * self.slope)
        parts: dict[tuple[int, int], fmpz_poly] = {}
        for monomial, value in polynomial.items():
            total = sum(monomial)
            words = limbs(abs(value).bit_length())
            charge(self.terms * max(total, 1) * (1000 + 20 * words * (1 + total * self.words)))
            power = sum(map(mul, self.places, monomial)) + (self.stride - 1) * (most - total)
            over, place = divmod(power, self.stride)
            part = value * self._monomial(monomial).left_shift(over)
            parts[total, place] = parts.get((total, place), 0) + part
        result: dict[int, fmpz_poly] = {}
        for (low, place), part in parts.items():
            if low < most:
                self._charge(most, limbs(int(part.height_bits())))
                part = part * self.powers[most - low]
            result[place] = result.get(place, 0) + part
        return result

    def _monomial(self, monomial: Monomial) -> fmpz_poly:
        pending = [monomial]
        while pending[-1] not in self.known:
            axis = next(i for i, exponent in enumerate(pending[-1]) if exponent)
            last = pending[-1]
            pending.append((*last[:axis], last[axis] - 1, *last[axis + 1 :]))
        reached = pending.pop()
        while pending:
            larger = pending.pop()
            axis = next(i for i, exponent in enumerate(larger) if exponent)
            self._charge(sum(larger))
            self.known[larger] = self.known[reached] * self.numerators[axis]
            reached = larger
        return self.known[monomial]

    def _charge(self, factors: int, words: int = 0) -> None:
        """For a product with so many factors in all."""
        charge(polynomials_cost(factors * self.terms, max(words, factors * self.words)))


def _stride(h: fmpz_poly, numerators: Sequence[fmpz_poly]) -> int:
    """The greatest m for which h is a polynomial in T^m, and all numerators are such ones times powers of T."""
    m = int(h.degree())
    for value in (h, *numerators):
        lowest = _lowest(value)
        m = gcd(m, *(power - lowest for power, coefficient in enumerate(value.coeffs()) if coefficient))
    return m


def _lowest(value: fmpz_poly) -> int:
    """The least exponent; 0 if there is none."""
    return next((power for power, coefficient in enumerate(value.coeffs()) if coefficient), 0)

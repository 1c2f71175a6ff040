"""The complex solutions of a system: that the roots of an eliminant are solutions, and distinct ones. All exact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from math import gcd

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
    h0 = primitive_part(points.eliminant)
    values = _Values(points.numerators, points.eliminant.derivative())
    for number, polynomial in enumerate(polynomials, 1):
        if not _divides(h0, values.of(polynomial)):
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
    slope = infinity.points.eliminant.derivative()
    if combination(infinity.chart, infinity.points.numerators) != slope:
        raise rejected("infinity: w.z is not 1 at the roots of the eliminant")
    h0 = primitive_part(infinity.points.eliminant)
    values = _Values(infinity.points.numerators, slope)
    if not all(_divides(h0, values.of(top_form(polynomial))) for polynomial in polynomials):
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
    """h'^d F(N / h') for polynomials F of degree d; products are kept."""

    def __init__(self, numerators: Sequence[fmpz_poly], slope: fmpz_poly) -> None:
        self.numerators = numerators
        self.slope = slope
        self.words = limbs(max(int(value.height_bits()) for value in (slope, *numerators)))
        self.terms = int(slope.length())
        self.known: dict[Monomial, fmpz_poly] = {(0,) * len(numerators): fmpz_poly([1])}
        self.powers = [fmpz_poly([1])]

    def of(self, polynomial: Mapping[Monomial, int]) -> fmpz_poly:
        most = degree(polynomial)
        while len(self.powers) <= most:
            self._charge(len(self.powers))
            self.powers.append(self.powers[-1] * self.slope)
        parts = [fmpz_poly() for _ in range(most + 1)]
        for monomial, value in polynomial.items():
            total = sum(monomial)
            words = limbs(abs(value).bit_length())
            charge(self.terms * max(total, 1) * (1000 + 20 * words * (1 + total * self.words)))
            parts[total] += value * self._monomial(monomial)
        result = fmpz_poly()
        for low, part in enumerate(parts):
            if part and low == most:
                result += part
            elif part:
                self._charge(most, limbs(int(part.height_bits())))
                result += part * self.powers[most - low]
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

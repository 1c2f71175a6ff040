"""Whether polynomials are 0 at all solutions of a representation, exactly."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from typing import Final, TypeAlias

from flint import fmpz_mpoly, fmpz_poly

from pkm_exact.algebra.representation import UnivariateRepresentation
from pkm_exact.algebra.strided import Strided, stride, strided
from pkm_exact.algebra.system import PolynomialSystem

_Exponents: TypeAlias = tuple[int, ...]
_FACTORED_DEGREE: Final = 4
"""From which on a polynomial's terms have fewer products if they are factored, though products are then not kept."""


def satisfies(representation: UnivariateRepresentation, system: PolynomialSystem) -> bool:
    """Whether every polynomial of the system vanishes, exactly, at every solution of the representation."""
    h = representation.primitive_polynomial
    step = stride(h)
    modulus = fmpz_poly(h.coeffs()[::step])
    numerators = [strided(numerator, step) for numerator in representation.numerator_polynomials]
    evaluate = _homogeneous_evaluator(numerators, strided(representation.polynomial.derivative(), step))
    return all(evaluate(polynomial).is_multiple(modulus) for polynomial in system.polynomials)


def _homogeneous_evaluator(numerators: Sequence[Strided], denominator: Strided) -> Callable[[fmpz_mpoly], Strided]:
    """A function that gives denominator^deg(F) F(numerators / denominator); products are kept between calls."""
    zero = Strided(denominator.step, {})
    values: dict[_Exponents, Strided] = {(0,) * len(numerators): Strided(denominator.step, {0: fmpz_poly([1])})}
    powers: dict[int, Strided] = {}

    def monomial(exponents: _Exponents) -> Strided:
        if exponents not in values:
            index = next(i for i, exponent in enumerate(exponents) if exponent)
            values[exponents] = monomial(_lowered(exponents, index)) * numerators[index]
        return values[exponents]

    def form(terms: dict[_Exponents, int], degree: int) -> Strided:
        index = _most_frequent(terms) if degree >= _FACTORED_DEGREE else None
        if index is None:
            return sum((value * monomial(exponents) for exponents, value in terms.items()), zero)
        inner = {_lowered(exponents, index): value for exponents, value in terms.items() if exponents[index]}
        others = {exponents: value for exponents, value in terms.items() if not exponents[index]}
        return numerators[index] * form(inner, degree - 1) + form(others, degree)

    def scaled(value: Strided, power: int) -> Strided:
        if power and power not in powers:
            powers[power] = denominator**power
        return value * powers[power] if power else value

    def evaluate(polynomial: fmpz_mpoly) -> Strided:
        degree = int(polynomial.total_degree())
        by_degree: dict[int, dict[_Exponents, int]] = {}
        for exponents, coefficient in polynomial.to_dict().items():
            key = tuple(map(int, exponents))
            by_degree.setdefault(sum(key), {})[key] = int(coefficient)
        return sum((scaled(form(terms, own), degree - own) for own, terms in by_degree.items()), zero)

    return evaluate


def _lowered(exponents: _Exponents, index: int) -> _Exponents:
    return (*exponents[:index], exponents[index] - 1, *exponents[index + 1 :])


def _most_frequent(terms: Collection[_Exponents]) -> int | None:
    """The variable that is in most terms, in two at least."""
    counts = [sum(map(bool, column)) for column in zip(*terms, strict=True)]
    most = max(counts, default=0)
    return counts.index(most) if most > 1 else None

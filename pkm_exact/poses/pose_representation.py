"""The univariate representation of the poses of a robot, and its exact verification."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, reduce

from flint import fmpz, fmpz_poly

from pkm_exact.algebra.representation import UnivariateRepresentation, are_coprime
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, motion_quadrics, pose_quadrics, pose_quartics, support
from pkm_exact.poses.study_equations import Chart, dependent_coordinate, free_coordinates

SQUARE = (4, 4)
_LONG = 64
"""Bits from which it is worth the while to take a content out."""


@dataclass(frozen=True)
class PoseRepresentation:
    """All complex poses: (e, f) = (E(t), F(t)) / h'(t) at the roots t of h, with w.e = 1.

    Attributes
    ----------
    chart : tuple of 4 int
        w.
    univariate : UnivariateRepresentation
        On the Study coordinates (e0, e1, e2, e3, f0, f1, f2, f3) of ``geometry.study``.
    """

    chart: Chart
    univariate: UnivariateRepresentation

    def __getstate__(self) -> dict[str, object]:
        """For copies and other processes: without FLINT's polynomials, which are made again when they are needed."""
        return {name: self.__dict__[name] for name in self.__dataclass_fields__}

    @property
    def separating_form(self) -> tuple[int, ...]:
        """Coefficients of t on (e0, .., e3, f0, .., f3)."""
        return self.univariate.form

    @property
    def eliminant(self) -> tuple[int, ...]:
        """Coefficients of h, lowest degree first."""
        return self.univariate.eliminant

    @property
    def quaternion(self) -> tuple[tuple[int, ...], ...]:
        """Coefficients of E_0..E_3, lowest degree first."""
        return self.univariate.numerators[:4]

    @property
    def translation(self) -> tuple[tuple[int, ...], ...]:
        """Coefficients of F_0..F_3, lowest degree first."""
        return self.univariate.numerators[4:]

    @cached_property
    def denominator(self) -> fmpz_poly:
        """h'."""
        return self.univariate.polynomial.derivative()

    def is_verified(self, problem: ForwardProblem) -> bool:
        """Whether, exactly over Q, every root of h is a pose of the robot and distinct roots are distinct poses."""
        x = self.univariate.numerator_polynomials
        chart_value = fmpz_poly()
        for weight, numerator in zip(self.chart, x[:4], strict=True):
            chart_value += weight * numerator
        if chart_value != self.denominator:
            return False
        if not (self.univariate.is_squarefree and self.univariate.is_separated):
            return False
        if any(numerator for k, numerator in enumerate(x) if k not in support(problem)):
            return False
        quadrics, quartics = _with_square_in_one(pose_quadrics(problem)), pose_quartics(problem)
        parts = [part for quartic in quartics for part in (quartic.linear, quartic.root)]
        *values, norm = _values([*quadrics, *parts, motion_quadrics(problem.metric)[-1]], x, len(quadrics))
        pairs = zip(values[len(quadrics) :: 2], values[len(quadrics) + 1 :: 2], strict=True)
        values = values[: len(quadrics)]
        values += [quartic.value(*pair, norm) for quartic, pair in zip(quartics, pairs, strict=True)]
        return are_coprime(self.univariate.primitive_polynomial, norm) and all(map(self.univariate.vanishes, values))


def _with_square_in_one(quadrics: Sequence[Quadric]) -> list[Quadric]:
    """Combinations that vanish where the forms do: f_k^2, the longest numbers of all, is in one of them, if it can be.

    Examples
    --------
    >>> _with_square_in_one([{(4, 4): 2, (0, 4): 1}, {(4, 4): 3}, {(0, 0): 1}])
    [{(4, 4): 2, (0, 4): 1}, {(0, 4): -3}, {(0, 0): 1}]
    """
    first = next((form for form in quadrics if form.get(SQUARE)), None)
    if first is None:
        return list(quadrics)
    own = first[SQUARE]
    found = []
    for form in quadrics:
        other = form.get(SQUARE, 0)
        keys = [*form, *(key for key in first if key not in form)] if other and form is not first else []
        combined = {key: own * form.get(key, 0) - other * first.get(key, 0) for key in keys}
        found.append({key: value for key, value in combined.items() if value} if keys else form)
    return [form for form in found if form]


def _values(quadrics: Sequence[Quadric], x: Sequence[fmpz_poly], scaled: int) -> list[fmpz_poly]:
    """The quadratic forms at x, but for a factor of the first, of which so many are only to be 0 or not.

    Each product is formed once, of polynomials freed of contents that are long.
    """
    contents = [content if content.bit_length() > _LONG else fmpz(1) for content in (value.content() for value in x)]
    shorter = [value if content == 1 else _divided(value, content) for value, content in zip(x, contents, strict=True)]
    products = {(k, m): shorter[k] * shorter[m] for k, m in sorted({pair for form in quadrics for pair in form})}
    values = []
    for number, quadric in enumerate(quadrics):
        parts: dict[fmpz, fmpz_poly] = {}
        for (k, m), coefficient in quadric.items():
            content = contents[k] * contents[m]
            parts[content] = parts.get(content, fmpz_poly()) + products[k, m] * coefficient
        common = reduce(fmpz.gcd, parts) if number < scaled else fmpz(1)
        total = fmpz_poly()
        for content, part in parts.items():
            total += part * (content // common)
        values.append(total)
    return values


def _divided(polynomial: fmpz_poly, divisor: fmpz) -> fmpz_poly:
    return fmpz_poly([value // divisor for value in polynomial.coeffs()])


def pose_representation(chart: Chart, problem: ForwardProblem, lifted: UnivariateRepresentation) -> PoseRepresentation:
    """All eight coordinates from those that were lifted: w.e = 1 gives the dependent one, whose weight is 1."""
    dependent, free = dependent_coordinate(chart), free_coordinates(chart, problem)
    form, numerators = [0] * 8, [fmpz_poly()] * 8
    for k, coefficient, numerator in zip(free, lifted.form, lifted.numerator_polynomials, strict=True):
        form[k], numerators[k] = coefficient, numerator
    value = lifted.polynomial.derivative()
    for k in range(4):
        if k != dependent:
            value -= chart[k] * numerators[k]
    numerators[dependent] = value
    lists = tuple(tuple(int(coefficient) for coefficient in numerator.coeffs()) for numerator in numerators)
    return PoseRepresentation(chart, UnivariateRepresentation(tuple(form), lifted.eliminant, lists, lifted.near))

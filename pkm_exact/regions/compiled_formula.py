"""Formulas ready for many boxes: every atom as Bernstein coefficients in doubles, with a bound of their errors.

A polynomial that has roots y_i in it is linear in each: over a box its values lie between the least and the greatest of
its coefficients at the 2^m corners of the intervals of its y_i, which follow from those of the D_i.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.errors import InputError
from pkm_exact.regions.bernstein import UNIT, Pair, Real, bernstein_coefficients, error_factor, on_sub_boxes
from pkm_exact.regions.bernstein import subdivision_matrices as subdivision
from pkm_exact.regions.chart import Polynomial
from pkm_exact.regions.formula import All, Atom, Formula, Regular, Sign, matrices_of
from pkm_exact.regions.matrix_regularity import CompiledMatrix, compiled_matrix, proved_regular

MOST_COEFFICIENTS: Final = 1 << 20
"""Of one polynomial; more are refused."""
_SLACK: Final = 1 + 2.0**-30
"""Room for the rounding of the bounds of errors themselves."""
_LEAST: Final = 2.0**-900

Truth = NDArray[np.int8]
"""1 where it holds all over a box, -1 where it holds nowhere in it, 0 otherwise."""


@dataclass(frozen=True, eq=False)
class Compiled:
    """A polynomial on the box of a chart.

    Attributes
    ----------
    roots : tuple of int
        Which of the roots are in it.
    degrees : tuple of int
        In the variables of the chart.
    tensor : array
        Coefficients: two along the axis of every root, for y^0 and y^1, then one axis for each variable.
    sizes : array
        Bounds of |coefficients|, for each combination of the roots.
    exponent : int
        The polynomial is 2^exponent times what the tensor says.
    """

    roots: tuple[int, ...]
    degrees: tuple[int, ...]
    tensor: Real
    sizes: Real
    exponent: int = 0


def compiled(
    polynomial: Polynomial, box: Sequence[Pair], scales: Sequence[int], degrees: Sequence[int] | None = None
) -> Compiled:
    """A polynomial of a chart and roots, in doubles.

    Parameters
    ----------
    polynomial : fmpq_mpoly
    box : sequence of pairs of Fraction
        Of the variables of the chart, which come first.
    scales : sequence of int
        y_i is taken in units of 2^scale.
    degrees : sequence of int, optional
        In all variables; at least those of the polynomial, which are taken by default.
    """
    count = len(box)
    degrees = degrees_of(polynomial) if degrees is None else degrees
    inner = degrees[:count]
    roots = tuple(k for k, d in enumerate(degrees[count:]) if d)
    size = int(np.prod([d + 1 for d in inner])) << len(roots)
    if size > MOST_COEFFICIENTS:
        raise InputError(f"conditions: a polynomial has {size} coefficients; ask of fewer variables or conditions")
    parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        powers = tuple(map(int, exponents))
        parts.setdefault(tuple(powers[count + k] for k in roots), {})[powers[:count]] = coefficient
    shape = (2,) * len(roots) + tuple(d + 1 for d in inner)
    exact: dict[tuple[int, ...], list[Fraction]] = {}
    for combination, terms in parts.items():
        unit = Fraction(2) ** sum(scales[k] for k, used in zip(roots, combination, strict=True) if used)
        exact[combination] = [value * unit for value in bernstein_coefficients(terms, inner, box)]
    greatest = max((abs(value) for values in exact.values() for value in values), default=Fraction(0))
    exponent = _exponent(greatest)
    power = Fraction(2) ** -exponent
    tensor = np.zeros(shape)
    for combination, values in exact.items():
        tensor[combination] = np.array([float(value * power) for value in values]).reshape(shape[len(roots) :])
    flat = np.abs(tensor).reshape(*shape[: len(roots)], -1).max(axis=-1) if tensor.size else np.zeros(())
    # What is too small for a double became 0: a bound of its size must not.
    least = np.zeros(shape[: len(roots)])
    for combination, values in exact.items():
        least[combination] = _LEAST if any(values) else 0.0
    return Compiled(roots, tuple(inner), tensor, np.maximum(flat, least) * _SLACK, exponent)


def degrees_of(polynomial: Polynomial) -> list[int]:
    """In all variables; FLINT gives -1 for the polynomial that is 0."""
    return [max(0, int(d)) for d in polynomial.degrees()]


def root_scale(polynomial: Polynomial, box: Sequence[Pair], count: int) -> int:
    """A unit for the root of a polynomial on a box: 2^scale, near the root of its greatest coefficient."""
    terms = {tuple(map(int, key))[:count]: value for key, value in polynomial.to_dict().items()}
    degrees = degrees_of(polynomial)[:count]
    values = bernstein_coefficients(terms, degrees, box)
    return _exponent(max(map(abs, values), default=Fraction(0))) // 2


def _exponent(value: Fraction) -> int:
    return value.numerator.bit_length() - value.denominator.bit_length() if value else 0


@dataclass(frozen=True, eq=False)
class CompiledFormula:
    """A formula on the box of a chart.

    Attributes
    ----------
    formula : Formula
    atoms : dict
        For each atom, by its identity, its polynomial and the loose one.
    roots : tuple of Compiled
        The D_i, each in units of 4^scale.
    variables : int
    scales : tuple of int
        Those of the y_i.
    matrices : dict
        For each condition on a matrix, by its identity, that matrix.
    """

    formula: Formula
    atoms: dict[int, tuple[Compiled, Compiled]]
    roots: tuple[tuple[Compiled, float], ...]
    variables: int
    scales: tuple[int, ...] = ()
    matrices: dict[int, CompiledMatrix] = field(default_factory=dict)

    @property
    def numbers(self) -> int:
        """How many coefficients the largest of its parts has."""
        sizes = [part.tensor.size for pair in self.atoms.values() for part in pair]
        return max([*sizes, *(matrix.size for matrix in self.matrices.values()), 1])

    @cached_property
    def work(self) -> int:
        """How many coefficients all of its parts have: what a box costs, about."""
        parts = {id(part): part.tensor.size for pair in self.atoms.values() for part in pair}
        matrices = sum(matrix.size for matrix in self.matrices.values())
        return 1 + sum(parts.values()) + sum(root.tensor.size for root, _ in self.roots) + matrices

    def truths(self, depths: Sequence[int], places: NDArray[np.int64]) -> Truth:
        """What is proved of the formula on many boxes.

        Parameters
        ----------
        depths : sequence of int
            How often each variable's interval was halved.
        places : array (n, k)
            Which of the 2^depth parts the box has.
        """
        return self.truths_in(View(depths, places))

    def root_ends(self, view: View) -> list[tuple[Real, Real]]:
        """Bounds of the y_i over the boxes of a view, each in its unit."""
        ends = []
        for root, factor in self.roots:
            low, high = view.range_of(root, [])
            ends.append((_root(low * factor, up=False), _root(high * factor, up=True)))
        return ends

    def truths_in(self, view: View) -> Truth:
        """``truths`` of the boxes of a view."""
        return self._truth(self.formula, view, self.root_ends(view), {})

    def _truth(self, formula: Formula, view: View, ends: list[tuple[Real, Real]], done: dict[int, Truth]) -> Truth:
        if isinstance(formula, Atom):
            if id(formula) not in done:
                done[id(formula)] = self._atom(formula, view, ends)
            return done[id(formula)]
        if isinstance(formula, Regular):
            if id(formula) not in done:
                matrix = self.matrices[id(formula)]
                regular = proved_regular(matrix, [view.matrices(column.degrees) for column in matrix.columns], ends)
                done[id(formula)] = regular.astype(np.int8)
            return done[id(formula)]
        start, choose = (1, np.minimum) if isinstance(formula, All) else (-1, np.maximum)
        found: Truth = np.full(view.count, start, dtype=np.int8)
        for part in formula.parts:
            found = choose(found, self._truth(part, view, ends, done))
        return found

    def _atom(self, atom: Atom, view: View, ends: list[tuple[Real, Real]]) -> Truth:
        tight, loose = self.atoms[id(atom)]
        low, high = view.range_of(tight, ends)
        strictly = atom.sign is not Sign.NOT_NEGATIVE
        holds = low > 0 if strictly else low >= 0
        if atom.sign is Sign.NOT_ZERO:
            return np.where(holds | (high < 0), 1, 0).astype(np.int8)
        greatest = high if loose is tight else view.range_of(loose, ends)[1]
        fails = greatest <= 0 if strictly else greatest < 0
        return np.where(holds, 1, np.where(fails, -1, 0)).astype(np.int8)


def compiled_formula(
    formula: Formula, atoms: Sequence[Atom], roots: Sequence[Polynomial], box: Sequence[Pair]
) -> CompiledFormula:
    """A formula with all its polynomials in doubles."""
    count = len(box)
    scales = [root_scale(root, box, count) for root in roots]
    found = []
    for root, scale in zip(roots, scales, strict=True):
        # Its tensor is normalised by a power of two; the factor leads from there to units of 4^scale.
        part = compiled(root, box, scales)
        exact = _largest(root, box, count)
        found.append((part, 2.0 ** (_exponent(exact) - 2 * scale)))
    made: dict[int, tuple[Compiled, Compiled]] = {}
    for atom in atoms:
        tight = compiled(atom.polynomial, box, scales)
        loose = tight if atom.loose is None else compiled(atom.loose, box, scales)
        made[id(atom)] = tight, loose
    matrices = {id(part): compiled_matrix(part.rows, box, scales) for part in matrices_of(formula)}
    return CompiledFormula(formula, made, tuple(found), count, tuple(scales), matrices)


def _largest(polynomial: Polynomial, box: Sequence[Pair], count: int) -> Fraction:
    terms = {tuple(map(int, key))[:count]: value for key, value in polynomial.to_dict().items()}
    degrees = degrees_of(polynomial)[:count]
    return max(map(abs, bernstein_coefficients(terms, degrees, box)), default=Fraction(0))


def _root(values: Real, *, up: bool) -> Real:
    """Square roots, rounded outward; of negative numbers 0."""
    found = np.sqrt(np.maximum(values, 0.0))
    return np.nextafter(np.nextafter(found, np.inf), np.inf) if up else np.maximum(found * (1 - 4 * UNIT), 0.0)


class View:
    """Boxes, and the matrices that lead to them, made once for each degree."""

    def __init__(self, depths: Sequence[int], places: NDArray[np.int64]) -> None:
        self.count = len(places)
        self._depths, self._places = depths, places
        self._matrices: dict[tuple[int, int], Real] = {}

    def _matrix(self, variable: int, degree: int) -> Real:
        key = variable, degree
        if key not in self._matrices:
            width = 2.0 ** -self._depths[variable]
            values, inverse = np.unique(self._places[:, variable], return_inverse=True)
            left: Real = (values * width).astype(np.float64)
            right: Real = ((values + 1) * width).astype(np.float64)
            matrices = subdivision(degree, left, right)
            self._matrices[key] = matrices[inverse]
        return self._matrices[key]

    def matrices(self, degrees: Sequence[int]) -> list[Real]:
        """Those that lead to the boxes, for each variable."""
        return [self._matrix(k, degree) for k, degree in enumerate(degrees)]

    def coefficients_of(self, part: Compiled, ends: Sequence[tuple[Real, Real]]) -> tuple[Real, Real]:
        """The coefficients over the boxes, of each in a row, and how far off they are at most."""
        found = on_sub_boxes(part.tensor, self.matrices(part.degrees), first=len(part.roots))
        sizes = np.broadcast_to(part.sizes, (self.count, *part.sizes.shape))
        for root in part.roots:
            low, high = ends[root]
            shape = (self.count,) + (1,) * (found.ndim - 2)
            constant, slope = found[:, 0], found[:, 1]
            # The corners of this root become the last axis; the next root comes to the front.
            found = np.stack([constant + slope * low.reshape(shape), constant + slope * high.reshape(shape)], axis=-1)
            wide = high.reshape((self.count,) + (1,) * (sizes.ndim - 2))
            sizes = sizes[:, 0] + sizes[:, 1] * wide
        factor = error_factor(part.degrees) + UNIT * (4 * len(part.roots) + 8)
        error = sizes.reshape(self.count) * factor * _SLACK
        return found.reshape(self.count, -1), error * _SLACK

    def range_of(self, part: Compiled, ends: Sequence[tuple[Real, Real]]) -> tuple[Real, Real]:
        """Bounds of a polynomial over the boxes."""
        flat, error = self.coefficients_of(part, ends)
        return flat.min(axis=1) - error, flat.max(axis=1) + error

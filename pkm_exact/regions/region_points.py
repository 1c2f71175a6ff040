"""Formulas at single rational points of a chart, decided exactly; where they fail, a counterexample."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from flint import arb

from pkm_exact.precision import working_precision
from pkm_exact.regions.chart import Polynomial, rational
from pkm_exact.regions.formula import All, Atom, Formula, Regular, Sign
from pkm_exact.regions.region_conditions import Asked
from pkm_exact.regions.region_matrices import MatrixAtPoints

Point = tuple[Fraction, ...]

_PRECISIONS: Final = (64, 256, 1024)


@dataclass(frozen=True)
class Counterexample:
    """Why a question about all of a region is answered no.

    Attributes
    ----------
    points : tuple of points
        One at which a condition fails; or two between which the determinant changes its sign.
    reason : str
        What fails.
    """

    points: tuple[Point, ...]
    reason: str


class PointJudge:
    """Decides formulas at rational points.

    Parameters
    ----------
    asked : Asked
    region : Formula
        Holds at the points of the region.
    """

    def __init__(self, asked: Asked, region: Formula) -> None:
        self._asked, self._region = asked, region
        self._known: dict[tuple[int, Point], int | None] = {}
        self._matrices: dict[int, MatrixAtPoints] = {}

    def is_inside(self, point: Point) -> bool:
        """Whether a point of the box is one of the region."""
        return self._truth(self._region, point) == 1

    def failing(self, point: Point) -> str | None:
        """The name of a condition that fails at a point, for certain; None if none is known to."""
        return self._failing(self._asked.formula, point)

    def determinant_sign(self, point: Point) -> int:
        """The sign of the determinant, 0 if it is not decided."""
        if self._asked.matrix is not None:
            return self._matrix_sign(self._asked.matrix, point) or 0
        if self._asked.determinant is None:
            return 0
        return self._sign(self._asked.determinant, point) or 0

    def _failing(self, formula: Formula, point: Point) -> str | None:
        if isinstance(formula, Atom | Regular):
            return formula.name if self._truth(formula, point) == -1 else None
        names = [self._failing(part, point) for part in formula.parts]
        if isinstance(formula, All):
            return next((name for name in names if name is not None), None)
        return names[0] if names and None not in names else None

    def _truth(self, formula: Formula, point: Point) -> int:
        if isinstance(formula, Atom):
            return self._atom(formula, point)
        if isinstance(formula, Regular):
            sign = self._matrix_sign(formula, point)
            return 0 if sign is None else 1 if sign else -1
        truths = [self._truth(part, point) for part in formula.parts]
        return min(truths, default=1) if isinstance(formula, All) else max(truths, default=-1)

    def _atom(self, atom: Atom, point: Point) -> int:
        sign = self._sign(atom.polynomial, point)
        if sign is not None and self._holds(atom.sign, sign):
            return 1
        loose = sign if atom.loose is None else self._sign(atom.loose, point)
        return 0 if loose is None or self._holds(atom.sign, loose) else -1

    @staticmethod
    def _holds(wanted: Sign, sign: int) -> bool:
        return {Sign.POSITIVE: sign > 0, Sign.NOT_NEGATIVE: sign >= 0, Sign.NOT_ZERO: sign != 0}[wanted]

    def _matrix_sign(self, matrix: Regular, point: Point) -> int | None:
        key = id(matrix), point
        if key not in self._known:
            if id(matrix) not in self._matrices:
                self._matrices[id(matrix)] = MatrixAtPoints(matrix.rows, self._asked.pose, len(point))
            self._known[key] = self._sign(self._matrices[id(matrix)].determinant_at(point), point)
        return self._known[key]

    def _sign(self, polynomial: Polynomial, point: Point) -> int | None:
        """The sign of a polynomial at a point, with the roots that belong to it; None if it is not decided."""
        count = len(point)
        at = [rational(x) for x in point]
        parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
        for exponents, coefficient in polynomial.to_dict().items():
            powers = tuple(map(int, exponents))
            parts.setdefault(powers[count:], {})[powers[:count] + (0,) * (len(powers) - count)] = coefficient
        ring = self._asked.pose.ring
        zeros = [rational(0)] * len(self._asked.roots)
        values = {key: ring.from_dict(terms)(*at, *zeros) for key, terms in parts.items()}
        if not any(any(key) for key in values):
            total = sum(values.values(), rational(0))
            return (total > 0) - (total < 0)
        squares = [root(*at, *zeros) for root in self._asked.roots]
        if any(square < 0 for square in squares):
            return None
        for precision in _PRECISIONS:
            with working_precision(precision):
                sum_ = arb(0)
                for key, value in values.items():
                    term = arb(value)
                    for used, square in zip(key, squares, strict=True):
                        term = term * arb(square).sqrt() if used else term
                    sum_ += term
                if sum_ > 0 or sum_ < 0:
                    return 1 if sum_ > 0 else -1
        return None


class CounterexampleSearch:
    """Points looked at one after another, until one refutes that all of a region is good.

    Two points refute it only if the region is connected.
    """

    def __init__(self, judge: PointJudge, *, is_connected: bool = True) -> None:
        self._judge, self._is_connected = judge, is_connected
        self._signs: dict[int, Point] = {}
        self.found: Counterexample | None = None

    def look_at(self, points: Sequence[Point]) -> None:
        """Look at points until a counterexample is found."""
        for point in points:
            if self.found is not None:
                return
            if not self._judge.is_inside(point):
                continue
            reason = self._judge.failing(point)
            if reason is not None:
                self.found = Counterexample((point,), reason)
                return
            sign = self._judge.determinant_sign(point) if self._is_connected else 0
            if sign and -sign in self._signs:
                ends = self._signs[-sign], point
                self.found = Counterexample(ends, "the determinant of the constraints changes its sign")
                return
            if sign:
                self._signs.setdefault(sign, point)

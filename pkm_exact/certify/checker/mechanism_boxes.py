"""The equations of a mechanism's poses in a chart, for boxes with one solution each (``krawczyk``).

Linear forms are quadratic in the Study coordinates; a cylinder, (v.v) N F - H^2, is of degree 4. For polynomials of any
degree F(x) - F(y) is the mean of F' between x and y, times x - y, and the mean lies in F'(X), a convex set.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import lcm

from flint import acb, acb_mat, arb, arb_mat, fmpz_mat

from pkm_exact.certify.checker.krawczyk import Equations
from pkm_exact.certify.checker.mechanism_forms import Form, Mechanism, cleared, quantities
from pkm_exact.certify.checker.mechanism_motion import independent
from pkm_exact.certify.checker.study_motion import combination, motion
from pkm_exact.certify.checker.verdict import rejected


class MechanismEquations(Equations):
    """As many equations as coordinates of the support: independent forms, cylinders, e.f, and w.e - 1."""

    def __init__(self, mechanism: Mechanism, chart: Sequence[int]) -> None:
        if mechanism.rank + len(mechanism.quadrics) != mechanism.group.dimension:
            raise rejected("boxes: the constraints are not as many as freedoms, independent ones counted")
        self.metric = mechanism.metric
        self.kept = mechanism.group.support
        self._mechanism = mechanism
        self._weights = [acb(chart[k]) if k < 4 else acb(0) for k in self.kept]

    @cached_property
    def _polar(self) -> fmpz_mat:
        """2 Q of the linear forms and of e.f, then of F and H of each cylinder, at last of N."""
        forms = [cleared(form) for form in independent(self._mechanism)]
        for quadric in self._mechanism.quadrics:
            forms += [cleared(quadric.whole), cleared(quadric.root)]
        count = self._quadratic - self._mechanism.group.has_study_condition

        def values(*places: int) -> list[int]:
            point = [places.count(place) for place in range(8)]
            placed = motion(point[:4], point[4:], self.metric)
            found = [int(combination(form, quantities(placed))) for form in forms]
            study = [int(placed.study)] if self._mechanism.group.has_study_condition else []
            return [*found[:count], *study, *found[count:], int(placed.norm)]

        single = {k: values(k) for k in self.kept}
        double = {(k, m): values(k, m) for k in self.kept for m in self.kept}
        rows = [
            [double[k, m][q] - single[k][q] - single[m][q] for m in self.kept]
            for q in range(len(single[self.kept[0]]))
            for k in self.kept
        ]
        return fmpz_mat(rows)

    @property
    def _quadratic(self) -> int:
        """Number of equations of degree 2."""
        return len(self.kept) - 1 - len(self._mechanism.quadrics)

    def derivative(self, x: acb_mat) -> acb_mat:
        """F' at x."""
        size, count = x.nrows(), self._quadratic
        slopes = acb_mat(arb_mat(self._polar)) * x
        entries = slopes.entries()
        rows = [entries[size * q : size * (q + 1)] for q in range(len(entries) // size)]
        found, further, norm_row = rows[:count], rows[count:-1], rows[-1]
        norm = _half(norm_row, x)
        for quadric, whole_row, root_row in zip(self._mechanism.quadrics, further[::2], further[1::2], strict=True):
            # The forms were cleared of denominators apart.
            factor = quadric.factor / _scale(quadric.whole)
            weight, square = arb(factor.numerator) / factor.denominator, arb(1) / _scale(quadric.root) ** 2
            whole, root = _half(whole_row, x), _half(root_row, x)
            found.append(
                [
                    weight * (n * whole + norm * f) - 2 * square * root * h
                    for n, f, h in zip(norm_row, whole_row, root_row, strict=True)
                ]
            )
        return acb_mat(size, size, [value for row in (*found, self._weights) for value in row])

    def value(self, derivative: acb_mat, x: acb_mat) -> acb_mat:
        """F at x, by Euler's identity for homogeneous polynomials."""
        product = (derivative * x).entries()
        degrees = [2] * self._quadratic + [4] * len(self._mechanism.quadrics)
        parts = [entry / degree for entry, degree in zip(product[:-1], degrees, strict=True)]
        return acb_mat(len(product), 1, [*parts, product[-1] - 1])


def _half(row: Sequence[acb], x: acb_mat) -> acb:
    """The value of a quadratic form whose derivative is the row."""
    return sum((slope * value for slope, value in zip(row, x.entries(), strict=True)), acb(0)) / 2


def _scale(form: Form) -> int:
    """By which integer ``cleared`` multiplies a form."""
    return lcm(*(value.denominator for value in form))

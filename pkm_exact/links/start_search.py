"""From a start to a real zero of polynomials, in doubles: Levenberg and Marquardt's method. Uncertified.

Each polynomial is divided by its greatest coefficient. A step solves (J^T J + d I) v = -J^T f; the damping d falls
where |f| does, and grows where a step is taken back.

Reference: D. W. Marquardt, "An algorithm for least-squares estimation of nonlinear parameters" (1963).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pkm_exact.algebra.system import PolynomialSystem

Real: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True)
class SearchPolicy:
    """Limits of a search.

    Attributes
    ----------
    steps : int
        Most steps, those taken back included.
    residual : float
        Greatest |f| at what counts as a zero.
    first, least, greatest : float
        Damping: the first, the least, and that at which the search ends.
    """

    steps: int = 500
    residual: float = 1e-11
    first: float = 1e-3
    least: float = 1e-15
    greatest: float = 1e8


DEFAULT: Final = SearchPolicy()


class FloatPolynomials:
    """Polynomials in doubles, term by term."""

    def __init__(self, system: PolynomialSystem) -> None:
        self.count, self.size = len(system.polynomials), len(system.unknowns)
        owners, exponents, coefficients = [], [], []
        for number, polynomial in enumerate(system.polynomials):
            terms = {tuple(map(int, key)): int(value) for key, value in polynomial.to_dict().items()}
            largest = max(map(abs, terms.values()))
            for key, value in terms.items():
                owners.append(number)
                exponents.append(key)
                coefficients.append(value / largest)
        self.owners = np.array(owners)
        self.exponents = np.array(exponents)
        self.coefficients = np.array(coefficients)

    def values(self, x: Real) -> Real:
        """All values at a point."""
        return self._summed(self.coefficients * np.prod(x**self.exponents, axis=1))

    def jacobian(self, x: Real) -> Real:
        """All derivatives at a point, a row for each polynomial."""
        columns = []
        for place in range(self.size):
            lowered = self.exponents.copy()
            lowered[:, place] = np.maximum(lowered[:, place] - 1, 0)
            slopes = self.coefficients * self.exponents[:, place] * np.prod(x**lowered, axis=1)
            columns.append(self._summed(slopes))
        return np.stack(columns, axis=1)

    def _summed(self, terms: Real) -> Real:
        total: Real = np.zeros(self.count)
        np.add.at(total, self.owners, terms)
        return total


def descent(
    polynomials: FloatPolynomials, start: Real, free: NDArray[np.bool_], policy: SearchPolicy = DEFAULT
) -> Real:
    """Where the search from a start ends, only the free unknowns being changed.

    Examples
    --------
    >>> from pkm_exact.systems.system_sources import polynomial_system
    >>> circle = FloatPolynomials(polynomial_system(["x^2 + y^2 - 25", "x - y - 1"]))
    >>> descent(circle, np.array([5.0, 2.0]), np.array([True, True])).round(6).tolist()
    [4.0, 3.0]
    """
    x, damping = start.copy(), policy.first
    with np.errstate(all="ignore"):
        f = polynomials.values(x)
        for _ in range(policy.steps):
            if float(np.abs(f).max()) <= policy.residual / 1000 or damping > policy.greatest:
                break
            jacobian = polynomials.jacobian(x)[:, free]
            matrix = jacobian.T @ jacobian + damping * np.eye(jacobian.shape[1])
            moved = x.copy()
            moved[free] -= np.linalg.solve(matrix, jacobian.T @ f)
            after = polynomials.values(moved)
            if float(after @ after) < float(f @ f):
                x, f, damping = moved, after, max(damping / 10, policy.least)
            else:
                damping *= 10
    return x

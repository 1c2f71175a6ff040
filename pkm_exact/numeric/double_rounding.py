"""What rounding does to sums and products of doubles, at most: bounds that are proved beforehand.

Doubles are those of IEEE 754, rounded to nearest, u = 2^-53. LAPACK's inverses and singular vectors count as guesses;
of sums and products, those inside numpy's and BLAS's included, this is used:

1. A sum of n products is off by at most gamma(n) = n u / (1 - n u) times the sum of their absolute values, in whatever
   order it is added, fused or not; products by 0 do not count (Higham, Accuracy and Stability of Numerical Algorithms,
   sections 3.1 and 3.5). Real and imaginary part of n complex products are sums of 2 n real ones, and by
   Cauchy-Schwarz both are off by at most gamma(2 n) sum |a_k| |b_k|, the modulus by sqrt(2) times that.
2. Bounds are themselves sums and products of numbers that are not negative. Each operation loses a factor 1 - u at
   most; there are far less than 2^12 in a row, so that ``OUTWARD`` makes up for them.
3. Numbers beyond ``LARGE`` = 2^150 are refused. An operation that underflows, to 0 or gradually, is off by less than
   2^-1022; there are less than 2^30 in a bound, and each is multiplied by at most five numbers up to 2^160 later on:
   all of it is below 2^-190, which is below ``SMALL``.
4. a b = p + e exactly with p the rounded product and e by Veltkamp's splitting and Dekker's formula (Numerische
   Mathematik 18, 1971), but for underflow.
5. With sigma a power of 2 and |p_k| <= sigma / 2^M, n < 2^M, let q_k = (sigma + p_k) - sigma in doubles. Then q_k is
   a multiple of u sigma, q_k and p_k - q_k are exact, |p_k - q_k| <= u sigma, and the sum of the q_k is exact in any
   order (Rump, Ogita and Oishi, SIAM J. Sci. Comput. 31 (2008), lemma 3.3).
"""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

U: Final = 2.0**-53
"""The unit roundoff."""
OUTWARD: Final = 1 + 2.0**-40
"""For the roundings of bounds themselves."""
LARGE: Final = 2.0**150
"""Numbers that are greater are refused."""
SMALL: Final = 2.0**-180
"""For what underflows, all in all."""
_SPLITTER: Final = 2.0**27 + 1

Real: TypeAlias = NDArray[np.float64]


def gamma(products: int) -> float:
    """n u / (1 - n u), rounded up.

    Examples
    --------
    >>> 2**-53 <= gamma(1) < 1.001 * 2**-53
    True
    """
    return products * U * OUTWARD


def are_moderate(*tables: NDArray[np.inexact[Any]]) -> NDArray[np.bool_]:
    """For each row of tables whether none of its numbers is infinite, nan or too large for what is used here.

    Examples
    --------
    >>> are_moderate(np.array([[1.0, 2.0], [3.0, np.inf]]), np.ones((2, 1))).tolist()
    [True, False]
    """
    found: NDArray[np.bool_] = np.logical_and.reduce([(np.abs(table) <= LARGE).all(axis=1) for table in tables])
    return found


def two_product(a: Real, b: Real) -> tuple[Real, Real]:
    """The rounded products and what they lack.

    Examples
    --------
    >>> p, e = two_product(np.array([2.0**30 + 1]), np.array([2.0**30 - 1]))
    >>> int(p[0]) + int(e[0]) == 2**60 - 1
    True
    """
    p: Real = a * b
    a_head, a_tail = _halves(a)
    b_head, b_tail = _halves(b)
    return p, a_tail * b_tail - (((p - a_head * b_head) - a_tail * b_head) - a_head * b_tail)


def two_sum(a: Real, b: Real) -> tuple[Real, Real]:
    """The rounded sums and what they lack, exactly (Knuth, The Art of Computer Programming 2, section 4.2.2).

    Examples
    --------
    >>> two_sum(np.array([1.0]), np.array([2.0**-60]))
    (array([1.]), array([8.67361738e-19]))
    """
    total = a + b
    part = total - a
    return total, (a - (total - part)) + (b - part)


def _halves(a: Real) -> tuple[Real, Real]:
    """Two numbers of 26 bits each whose sum it is."""
    scaled = _SPLITTER * a
    head = scaled - (scaled - a)
    return head, a - head


def twofold_sums(terms: Real, rest: Real) -> tuple[Real, Real, Real]:
    """The sums of terms and of the rest, over the last axis, as if added with twice as many bits.

    Parameters
    ----------
    terms, rest : (.., n) arrays
        |rest| <= 4 u times the largest of the n terms, in absolute value.

    Returns
    -------
    head, tail : (..) arrays
        Their sum is the result.
    bound : (..) array
        How far it is off at most.

    Notes
    -----
    The sum of the q_k is exact. What is left, p_k - q_k and the rest, is at most 5 u sigma each, and added in doubles:
    n numbers with n roundings each are off by at most gamma(n) n 5 u sigma < 6 n^2 u^2 sigma.

    Examples
    --------
    >>> head, tail, bound = twofold_sums(np.array([[1e17, 1.0, -1e17]]), np.zeros((1, 3)))
    >>> float(head[0] + tail[0]), bool(bound[0] < 1e-10)
    (1.0, True)
    """
    count = terms.shape[-1]
    largest = np.abs(terms).max(axis=-1)
    sigma = np.ldexp(1.0, np.frexp(largest)[1] + count.bit_length())
    parts = (sigma[..., None] + terms) - sigma[..., None]
    tail = ((terms - parts) + rest).sum(axis=-1)
    return parts.sum(axis=-1), tail, 6 * count**2 * U**2 * sigma + SMALL


def rounded(values: Iterable[Fraction]) -> list[float]:
    """The doubles next to numbers; to those of fractions in a third of the time that ``float`` takes.

    Examples
    --------
    >>> rounded([Fraction(1, 3), Fraction(-2)])
    [0.3333333333333333, -2.0]

    Raises
    ------
    OverflowError
        If a number is too large for a double.
    """
    return [value.numerator / value.denominator if type(value) is Fraction else float(value) for value in values]

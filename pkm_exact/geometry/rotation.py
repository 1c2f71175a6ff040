"""Rotations in a Gram metric, parametrised by rational quaternion coordinates.

For G = diag(g1, g2, g3) a rotation matrix R satisfies R^T G R = G and det R = 1; it acts on rational coordinates.
With e = (e0, e1, e2, e3) up to scale, the ordinary quaternion is
q = (sqrt(g1 g2 g3) e0, sqrt(g1) e1, sqrt(g2) e2, sqrt(g3) e3), so that every formula below stays rational:

    N(e)     = g1 g2 g3 e0^2 + g1 e1^2 + g2 e2^2 + g3 e3^2
    N R_ii   = g1 g2 g3 e0^2 + g_i e_i^2 - g_j e_j^2 - g_k e_k^2
    N R_ij   = 2 g_j (e_i e_j + s g_k e0 e_k),   s = -1 for (i, j) = (1, 2), (2, 3), (3, 1), else +1

For G = I these are the formulas of Euler and Rodrigues.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations
from typing import Any

CYCLIC = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


def quaternion_norm(products: Sequence[Sequence[Any]], metric: Sequence[Any]) -> Any:
    """N(e) from the products ``products[k][l] = e_k e_l`` (any commutative ring).

    Examples
    --------
    >>> quaternion_norm([[a * b for b in (1, 2, 3, 4)] for a in (1, 2, 3, 4)], (1, 1, 1))
    30
    """
    g1, g2, g3 = metric
    return g1 * g2 * g3 * products[0][0] + g1 * products[1][1] + g2 * products[2][2] + g3 * products[3][3]


def scaled_rotation(products: Sequence[Sequence[Any]], metric: Sequence[Any]) -> list[list[Any]]:
    """N(e) R from the products ``products[k][l] = e_k e_l``, as a 3 x 3 list (any commutative ring).

    Examples
    --------
    >>> scaled_rotation([[a * b for b in (1, 1, 0, 0)] for a in (1, 1, 0, 0)], (1, 1, 1))
    [[2, 0, 0], [0, 0, -2], [0, 2, 0]]
    """
    square = [metric[0] * metric[1] * metric[2] * products[0][0]]
    square += [metric[i] * products[i + 1][i + 1] for i in range(3)]
    matrix: list[list[Any]] = [[None] * 3 for _ in range(3)]
    for i, j, k in CYCLIC:
        matrix[i][i] = square[0] + square[i + 1] - square[j + 1] - square[k + 1]
    for i, j, k in permutations(range(3)):
        sign = -1 if (i, j, k) in CYCLIC else 1
        matrix[i][j] = 2 * metric[j] * (products[i + 1][j + 1] + sign * metric[k] * products[0][k + 1])
    return matrix


def quaternion_products(rotation: Sequence[Sequence[Any]], one: Any, metric: Sequence[Any]) -> list[list[Any]]:
    """The products 4 e_k e_l of a quaternion with N(e) = 1, linear in the rotation matrix.

    Parameters
    ----------
    rotation : 3 x 3 entries in a ring that contains the inverses of the metric
    one : the ring's 1 (or the homogenising unknown)
    metric : Gram diagonal

    Examples
    --------
    >>> quaternion_products([[1, 0, 0], [0, 1, 0], [0, 0, 1]], 1, (1, 1, 1))[0]
    [4, 0, 0, 0]
    """
    trace = rotation[0][0] + rotation[1][1] + rotation[2][2]
    inverse = [1 / g if g != 1 else 1 for g in metric]
    products: list[list[Any]] = [[None] * 4 for _ in range(4)]
    products[0][0] = (one + trace) * (inverse[0] * inverse[1] * inverse[2])
    for i, j, k in CYCLIC:
        products[i + 1][i + 1] = (one + 2 * rotation[i][i] - trace) * inverse[i]
        mixed = (rotation[k][j] * inverse[j] - rotation[j][k] * inverse[k]) * inverse[i]
        products[0][i + 1] = products[i + 1][0] = mixed
        pair = rotation[i][j] * inverse[j] + rotation[j][i] * inverse[i]
        products[i + 1][j + 1] = products[j + 1][i + 1] = pair
    return products


def composition_matrix(right: Sequence[int], metric: Sequence[int]) -> list[list[int]]:
    """The 4 x 4 matrix that takes quaternion coordinates of R to those of R Q, up to scale, for Q given by ``right``.

    Examples
    --------
    >>> composition_matrix((2, 1, 0, 0), (1, 1, 1))
    [[2, -1, 0, 0], [1, 2, 0, 0], [0, 0, 2, 1], [0, 0, -1, 2]]
    """
    volume = metric[0] * metric[1] * metric[2]
    b = right
    matrix = [[volume * b[0], *(-metric[i] * b[i + 1] for i in range(3))], [0] * 4, [0] * 4, [0] * 4]
    for i, j, k in CYCLIC:
        # volume / g_i = g_j g_k
        matrix[i + 1][0] = volume * b[i + 1]
        matrix[i + 1][i + 1] = volume * b[0]
        matrix[i + 1][j + 1] = metric[j] * metric[k] * b[k + 1]
        matrix[i + 1][k + 1] = -metric[j] * metric[k] * b[j + 1]
    return matrix

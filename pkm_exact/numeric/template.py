"""All solutions of six linear forms on the variety of rigid motions at once, in floating point, as first guesses.

Six forms leave eleven of the 17 coordinates z; in a random basis of them no solution, also none at infinity, has z_0
near 0. The 37 quadrics of the variety leave, of the homogeneous polynomials in the other ten, dimensions 1, 10, 18, 10
and 1 in degrees 0 to 4, and of all polynomials a quotient algebra of dimension 40. Its products with z_0 are found
degree by degree, from the relations x_i (x_j a) = x_j (x_i a), by orthogonal triangular factorisations:

    degree 2   x_i x_j  in  1, x, and an orthonormal basis q of the 18
    degree 3   x_i q_a  in  1, x, q, and ten f_b
    degree 4   x_0 f_b  in  1, x, q, f, and one e
    x_0 e = x_k (x_0 f) - x_0 (x_k f - e)  for an f with x_0 f free of e and x_k f = e + ..

so that degree 5 is not needed. Eigenvectors of the matrix of x_0 (Stickelberger) hold the values of 1 and x, and with
them all 17 coordinates. Robots with symmetries have fewer finite solutions; those at infinity are found as well.

Nothing here is certified, and how good the guesses are is not known.

References: Byroed, Josephson and Astroem, "Fast and stable polynomial equation solving and its application to computer
vision", IJCV 84 (2009), on elimination by orthogonal factorisations; Mourrain, "A new criterion for normal form
algorithms", AAECC 13 (1999).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.completeness.rigid_motions import variety_quadrics
from pkm_exact.constraints.form import SIZE
from pkm_exact.numeric.study_system import Complex, Real

SEED: Final = 20081125
FREE: Final = 11
"""Coordinates that six forms leave."""
INNER: Final = FREE - 1
QUADRICS: Final = 37
SECOND: Final = INNER * (INNER + 1) // 2 - QUADRICS
THIRD: Final = 10
"""Dimensions of the parts of degree 2 and 3."""
LED: Final = 3
"""So many i, in a random basis, give relations enough, of the same quality as all: 218 of rank 170."""
UP_TO: Final = (1 + INNER, 1 + INNER + SECOND, 1 + INNER + SECOND + THIRD)
"""Dimensions of the parts up to degree 1, 2 and 3."""


def motion_seeds(forms: Real) -> Complex:
    """The 17 coordinates of all common zeros on the variety of rigid motions, roughly.

    Parameters
    ----------
    forms : (6, 17) array
        On (|C|^2; u; C; R; h), in ordinary coordinates.

    Returns
    -------
    (40, 17) complex array
        Projective points, those at infinity (h = 0) included.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the forms are special in a way that the construction does not bear.
    """
    tables = _tables()
    basis = np.linalg.qr(forms.T, mode="complete")[0][:, len(forms) :] @ tables.turn
    second = _second(basis.T @ tables.quadrics @ basis)
    third = _third(second, tables.triples)
    matrix = _product_with_first(second, third)
    vectors = np.linalg.eig(matrix)[1].astype(np.complex128)  # real where all solutions are
    found: Complex = vectors[:FREE].T @ basis.T
    return found


@dataclass(frozen=True)
class _Tables:
    """What is the same for all robots.

    Attributes
    ----------
    quadrics : (37, 17, 17) array
        An orthonormal basis of the quadrics on the variety.
    turn : (11, 11) array
        A random orthogonal matrix.
    triples : three (r,) arrays of int
        Indices i < j and k >= i of the relations x_i (x_j x_k) = x_j (x_i x_k), for some i.
    """

    quadrics: Real
    turn: Real
    triples: tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]


@cache
def _tables() -> _Tables:
    found = variety_quadrics((1, 1, 1))
    matrices = np.zeros((len(found), SIZE, SIZE))
    for matrix, quadric in zip(matrices, found, strict=True):
        for (i, j), value in quadric.items():
            matrix[i, j] += value / 2
            matrix[j, i] += value / 2
    orthonormal = np.linalg.svd(matrices.reshape(len(found), -1), full_matrices=False)[2][:QUADRICS]
    turn = np.linalg.qr(np.random.default_rng(SEED).standard_normal((FREE, FREE)))[0]
    i, j, k = np.array(
        [(i, j, k) for i in range(LED) for j in range(i + 1, INNER) for k in range(i, INNER)], dtype=np.intp
    ).T
    return _Tables(orthonormal.reshape(QUADRICS, SIZE, SIZE), turn, (i, j, k))


def _second(quadrics: Real) -> Real:
    """(10, 10, 29): x_i x_j in 1, x and q, from the quadrics on z."""
    i, j = np.triu_indices(INNER)
    weights = np.where(i == j, 1, np.sqrt(2))
    top = quadrics[:, 1:, 1:][:, i, j] * weights
    low = np.concatenate([quadrics[:, :1, 0], 2 * quadrics[:, 0, 1:]], axis=1)
    rotation, triangle = np.linalg.qr(top.T, mode="complete")
    bound, free = rotation[:, :QUADRICS], rotation[:, QUADRICS:]
    lower = -bound @ np.linalg.solve(triangle[:QUADRICS].T, low)
    values = np.concatenate([lower, free], axis=1) / weights[:, None]
    place = np.empty((INNER, INNER), dtype=np.intp)
    place[i, j] = place[j, i] = np.arange(len(i))
    table: Real = values[place]
    return table


def _third(second: Real, triples: tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]) -> Real:
    """(10, 18, 39): x_i q_a in 1, x, q and f."""
    i, j, k = triples
    one, two, _ = UP_TO
    # x_i times the part of x_j x_k below degree 2: (j, k, i, 29).
    low = np.tensordot(second[:, :, 1:one], second, axes=([2], [1]))
    axes = np.arange(INNER)
    low[:, :, axes, 1 + axes] += second[:, :, :1]
    count = np.arange(len(i))
    top = np.zeros((len(i), INNER, SECOND))
    top[count, i] = second[j, k, one:]
    top[count, j] -= second[i, k, one:]
    relations = np.concatenate([top.reshape(len(i), -1), low[j, k, i] - low[i, k, j]], axis=1)
    return _normal_forms(relations, INNER * SECOND, THIRD).reshape(INNER, SECOND, two + THIRD)


def _product_with_first(second: Real, third: Real) -> Real:
    """(40, 40): x_0 times each of 1, x, q, f, e."""
    one, two, three = UP_TO
    below = np.zeros((INNER, two, three))  # x_i times each of 1, x, q
    below[:, 0, 1:one] = np.eye(INNER)
    below[:, 1:one, :two] = second
    below[:, one:] = third
    top = np.zeros((INNER - 1, SECOND, INNER, THIRD))
    top[:, :, 0] = third[1:, :, two:]
    others = np.arange(INNER - 1)
    top[others, :, 1 + others] -= third[0, :, two:]
    low = third[1:, :, :two] @ below[0] - third[0, :, :two] @ below[1:]
    relations = np.concatenate([top.reshape(-1, INNER * THIRD), low.reshape(-1, three)], axis=1)
    fourth = _normal_forms(relations, INNER * THIRD, 1).reshape(INNER, THIRD, three + 1)  # x_i f_b
    matrix = np.zeros((three + 1, three + 1))
    matrix[:two, :three] = below[0]
    matrix[two:three] = fourth[0]
    matrix[three] = _last(below, fourth)
    return matrix


def _last(below: Real, fourth: Real) -> Real:
    """(40,): x_0 e."""
    _, two, three = UP_TO
    tops = fourth[:, :, three]
    first = tops[0] / np.linalg.norm(tops[0])
    rest = tops - np.outer(tops @ first, first)
    k = 1 + int(np.argmax(np.linalg.norm(rest[1:], axis=1)))
    chosen = rest[k] / (rest[k] @ rest[k])  # x_0 f has no e, x_k f has it once

    def times(unknown: int, value: Real) -> Real:
        product: Real = value[two:] @ fourth[unknown]
        product[:three] += value[:two] @ below[unknown]
        return product

    f = np.concatenate([np.zeros(two), chosen])
    last: Real = times(k, times(0, f)[:three]) - times(0, times(k, f)[:three])
    return last


def _normal_forms(relations: Real, symbols: int, dimension: int) -> Real:
    """(symbols, l + dimension): symbols in what is lower and an orthonormal basis of what relations leave of them.

    Relations are rows on the symbols, then on the l lower ones; their rank on the symbols is ``symbols - dimension``.
    """
    triangle = np.asarray(np.linalg.qr(relations, mode="r"))
    rank = symbols - dimension
    solved = np.linalg.solve(triangle[:rank, :rank], triangle[:rank, rank:])
    free = np.linalg.qr(np.concatenate([-solved[:, :dimension], np.eye(dimension)]))[0]
    low = np.concatenate([-solved[:, dimension:], np.zeros((dimension, solved.shape[1] - dimension))])
    return np.concatenate([low - free @ (free.T @ low), free], axis=1)

"""All solutions of six linear forms on the variety of rigid motions at once, in floating point, as first guesses.

Six forms leave eleven of the 17 coordinates z; in a random basis of them no solution, also none at infinity, has z_0
near 0. The 37 quadrics of the variety leave, of the homogeneous polynomials in the other ten, dimensions 1, 10, 18, 10
and 1 in degrees 0 to 4, and of all polynomials a quotient algebra of dimension 40. Its products with z_0 are found
degree by degree, in the basis 1, x, b, a, f, e, by orthogonal triangular factorisations:

    degree 2   x_i x_j in 1, x, ten b_k = x_0 x_k, and an orthonormal basis a of eight others
    degree 3   x_i a_m in 1, x, b, a, and ten f_k = x_0 b_k
    degree 4   x_0 f_k in 1, x, b, a, f, and one e
    x_0 e = x_k (x_0 f) - x_0 (x_k f - e)  for an f with x_0 f free of e and x_k f = e + ..

so that degree 5 is not needed. With x_i b_k = x_0 (x_i x_k) the relations x_i (x_j x_k) = x_j (x_i x_k) ask for no
products but x_0 b and x_i a: 90 unknowns in place of 180 products of degree 3. And with n = a_m less those b that make
x_0 n free of f, x_j (x_0 n) = x_0 (x_j n) asks for x_0 f alone: ten unknowns. If x_0 or x_0^2 were not one to one from
degree 1 on, which no robot has shown so far, the guesses would be bad. Eigenvectors of the matrix of x_0
(Stickelberger) hold the values of 1 and x, and with them all 17 coordinates. Robots with symmetries have fewer finite
solutions; those at infinity are found as well.

Nothing here is certified, and how good the guesses are is not known.

References: Byroed, Josephson and Astroem, "Fast and stable polynomial equation solving and its application to computer
vision", IJCV 84 (2009), on elimination by orthogonal factorisations; Mourrain, "A new criterion for normal form
algorithms", AAECC 13 (1999).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any, Final

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
OTHERS: Final = SECOND - INNER
"""So many of degree 2 are no multiples of x_0."""
LED: Final = (1, 2)
"""These i, in a random basis, give relations enough, of the same quality as all: 128 of rank 80."""
FURTHER: Final = LED[-1] + 1
"""The first axis after these."""
ONE, TWO, THREE = 1 + INNER, 1 + INNER + SECOND, 1 + INNER + SECOND + THIRD
"""Dimensions of the parts up to degree 1, 2 and 3."""
A: Final = ONE + INNER
"""Where a begins; from ``ONE`` on are b, from ``TWO`` on f."""


def motion_seeds(forms: Real) -> Complex:
    """The 17 coordinates of all common zeros on the variety of rigid motions, roughly.

    Parameters
    ----------
    forms : (k, 6, 17) array
        On (|C|^2; u; C; R; h), in ordinary coordinates; of k robots, or lengths, at once.

    Returns
    -------
    (k, s, 17) complex array
        Projective points, those at infinity (h = 0) included; of two conjugate ones, one. 40 of them and the conjugate
        ones that are left out, if k is 1; else, where others have more, some conjugate ones as well.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the forms, of one of them, are special in a way that the construction does not bear.
    """
    tables = _tables()
    basis = np.linalg.qr(_turned(forms), mode="complete")[0][..., forms.shape[1] :] @ tables.turn
    second = _with_multiples(_second(_turned(basis)[:, None] @ (tables.quadrics @ basis[:, None])))
    matrices = _products_with_first(_third(second))
    values, vectors = np.linalg.eig(matrices)
    # Eigenvalues of real matrices come in conjugate pairs, exactly.
    are_left_out = values.imag < 0
    order = np.argsort(are_left_out, axis=1, kind="stable")[:, : values.shape[1] - int(are_left_out.sum(axis=1).min())]
    chosen = np.take_along_axis(vectors[:, :FREE], order[:, None], axis=2)
    found: Complex = _turned(chosen).astype(np.complex128) @ _turned(basis)  # real where all solutions are
    return found


def _turned(matrices: NDArray[Any]) -> NDArray[Any]:
    """Transposes."""
    found: NDArray[Any] = np.swapaxes(matrices, -1, -2)
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
    pairs : two (55,) arrays of int
        i <= j.
    place : (10, 10) array of int
        Where i, j or j, i is among the pairs.
    led : two (17,) arrays of int
        Places of i in ``LED``, and k >= i, of the relations x_i (x_j x_k) = x_j (x_i x_k), j > 2.
    """

    quadrics: Real
    turn: Real
    pairs: tuple[NDArray[np.intp], NDArray[np.intp]]
    place: NDArray[np.intp]
    led: tuple[NDArray[np.intp], NDArray[np.intp]]


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
    first, second = np.triu_indices(INNER)
    table = np.empty((INNER, INNER), dtype=np.intp)
    table[first, second] = table[second, first] = np.arange(len(first))
    place, k = np.array([(n, k) for n, i in enumerate(LED) for k in range(i, INNER)], dtype=np.intp).T
    return _Tables(orthonormal.reshape(QUADRICS, SIZE, SIZE), turn, (first, second), table, (place, k))


def _second(quadrics: Real) -> Real:
    """(k, 10, 10, 29): x_i x_j in 1, x and an orthonormal basis of the 18, from the quadrics on z."""
    (i, j), place = _tables().pairs, _tables().place
    weights = np.where(i == j, 1, np.sqrt(2))
    top = quadrics[..., 1 + i, 1 + j] * weights
    low = np.concatenate([quadrics[..., :1, 0], 2 * quadrics[..., 0, 1:]], axis=2)
    rotation, triangle = np.linalg.qr(_turned(top), mode="complete")
    bound, free = rotation[..., :QUADRICS], rotation[..., QUADRICS:]
    lower = -bound @ np.linalg.solve(_turned(triangle[:, :QUADRICS]), low)
    values = np.concatenate([lower, free], axis=2) / weights[:, None]
    table: Real = values[:, place]
    return table


def _with_multiples(second: Real) -> Real:
    """The same in 1, x, b and a: b_k is x_0 x_k as a whole, what it has in lower degrees included."""
    count = len(second)
    rotation, triangle = np.linalg.qr(_turned(second[:, 0, :, ONE:]), mode="complete")
    top = second[..., ONE:].reshape(count, -1, SECOND) @ rotation
    multiples = _turned(np.linalg.solve(triangle[:, :INNER], _turned(top[..., :INNER])))
    low = second[..., :ONE].reshape(count, -1, ONE) - multiples @ second[:, 0, :, :ONE]
    table = np.concatenate([low, multiples, top[..., INNER:]], axis=2).reshape(count, INNER, INNER, TWO)
    table[:, 0] = np.eye(INNER, TWO, ONE)
    table[:, :, 0] = table[:, 0]
    return table


def _known(second: Real) -> Real:
    """(k, 10, 21, 47): x_i times 1, x and b, in x_0 a, then 1, x, b, a, then x_0 b."""
    known, axes = np.zeros((len(second), INNER, A, OTHERS + THREE)), np.arange(INNER)
    known[:, axes, 0, OTHERS + 1 + axes] = 1
    known[:, :, 1:ONE, OTHERS:-THIRD] = second
    known[:, :, ONE:, OTHERS + 1] = second[..., 0]  # x_i b_k is x_0 times x_i x_k
    known[:, :, ONE:, OTHERS + ONE : OTHERS + A] = second[..., 1:ONE]
    known[:, :, ONE:, :OTHERS] = second[..., A:]
    known[:, :, ONE:, -THIRD:] = second[..., ONE:A]
    return known


def _third(second: Real) -> Real:
    """(k, 10, 29, 39): x_i times each of 1, x, b and a, in 1, x, b, a and f.

    For each j, x_j a is in the relations x_i (x_j x_k) = x_j (x_i x_k) alone, with the same coefficients for all j.
    """
    several, (i, k), known = len(second), _tables().led, _known(second)
    led, rest = second[:, 1:FURTHER], INNER - LED[-1]
    # Without x_i a and x_j a; j = 2 or further.
    rows = second[:, LED[-1] :, :, :A].reshape(several, 1, -1, A) @ known[:, 1:FURTHER]
    rows = rows.reshape(several, len(LED), rest, INNER, -1)
    others = led[..., :A].reshape(several, 1, -1, A) @ known[:, LED[-1] :]
    rows -= others.reshape(several, rest, len(LED), INNER, -1).swapaxes(1, 2)
    # With x_1 a and x_2 a before.
    blocks = np.zeros((several, INNER - FURTHER, len(i), len(LED) * OTHERS + rows.shape[-1]))
    blocks[:, :, : INNER - 1, :OTHERS] = second[:, FURTHER:, 1:, A:]
    blocks[:, :, INNER - 1 :, OTHERS : 2 * OTHERS] = second[:, FURTHER:, 2:, A:]
    blocks[..., 2 * OTHERS :] = rows[:, i, 1:, k].transpose(1, 2, 0, 3)
    first = np.concatenate([second[:, 2, 1:, A:], -second[:, 1, 1:, A:], rows[:, 0, 0, 1:]], axis=2)
    rotation, triangle = np.linalg.qr(led[:, i, k, A:], mode="complete")
    solving = _turned(rotation).copy()
    solving[:, :OTHERS] = np.linalg.solve(triangle[:, :OTHERS], solving[:, :OTHERS])
    solved = solving[:, None] @ blocks
    free = np.concatenate([solved[:, :, OTHERS:].reshape(several, -1, first.shape[2]), first], axis=1)
    few = _solved(free, 3 * OTHERS)  # x_1 a, x_2 a, x_0 a
    below = np.empty((several, INNER, TWO, THREE))
    below[:, :, :A] = known[..., OTHERS:]
    below[:, :, ONE:A] += second[..., A:] @ few[:, None, 2 * OTHERS :]
    below[:, 0, A:] = few[:, 2 * OTHERS :]
    below[:, 1:FURTHER, A:] = few[:, : 2 * OTHERS].reshape(several, 2, OTHERS, THREE)
    below[:, FURTHER:, A:] = solved[:, :, :OTHERS, : 3 * OTHERS] @ few[:, None] + solved[:, :, :OTHERS, 3 * OTHERS :]
    return below


def _products_with_first(below: Real) -> Real:
    """(k, 40, 40): x_0 times each of 1, x, b, a, f, e."""
    several = len(below)
    free = np.empty((several, 1, OTHERS, SECOND))
    free[..., :INNER], free[..., INNER:] = -below[:, :1, A:, TWO:], np.eye(OTHERS)
    moved = free @ below[:, :, ONE:]  # x_j n
    products = moved[:, 1:].reshape(several, -1, THREE)
    low = products[..., :TWO] @ below[:, 0] - (moved[:, :1, :, :TWO] @ below[:, 1:]).reshape(several, -1, THREE)
    fourth = _normal_forms(products[..., TWO:], low, 1)  # x_0 f
    matrices = np.zeros((several, THREE + 1, THREE + 1))
    matrices[:, :TWO, :THREE] = below[:, 0]
    matrices[:, TWO:THREE] = fourth
    matrices[:, THREE:] = _last(below, fourth)
    return matrices


def _last(below: Real, fourth: Real) -> Real:
    """(k, 1, 40): x_0 e."""
    tops = fourth[:, None, :, THREE:]
    first = tops / np.linalg.norm(tops, axis=2, keepdims=True)
    values = (below[:, 1:, ONE:A, TWO:] @ tops)[..., 0]  # e in x_j f_k = x_0 (x_j b_k)
    rest = values - (values @ first[:, 0]) * first[:, 0, :, 0][:, None]
    each, sizes = np.arange(len(below)), (rest * rest).sum(axis=2)
    k = np.argmax(sizes, axis=1)
    chosen = rest[each, k] / sizes[each, k][:, None]  # x_0 f has no e, x_k f has it once
    beside = below[each, 1 + k]

    def first_times(value: Real) -> Real:
        product: Real = value[..., TWO:] @ fourth
        product[..., :THREE] += value[..., :TWO] @ below[:, 0]
        return product

    def other_times(value: Real) -> Real:
        product = first_times(value[..., TWO:] @ beside[:, ONE:A])
        product[..., :THREE] += value[..., :TWO] @ beside
        return product

    f = np.concatenate([np.zeros((len(below), 1, TWO)), chosen[:, None]], axis=2)
    last: Real = other_times(first_times(f)[..., :THREE]) - first_times(other_times(f)[..., :THREE])
    return last


def _solved(relations: Real, rank: int) -> Real:
    """(k, rank, s - rank): the first symbols in the others, from relations that are rows on s symbols.

    Their rank is the number of the first ones: on all symbols that are of the highest degree.
    """
    rotation, triangle = np.linalg.qr(relations[..., :rank])
    found: Real = -np.linalg.solve(triangle, _turned(rotation) @ relations[..., rank:])
    return found


def _normal_forms(symbols: Real, low: Real, dimension: int) -> Real:
    """(k, s, l + dimension): all symbols in what is lower and an orthonormal basis of what relations leave of them.

    Relations are rows on the symbols and on the l lower ones; their rank on the symbols is s - dimension.
    """
    width, several, rank = low.shape[2], len(low), symbols.shape[2] - dimension
    solved = _solved(np.concatenate([symbols[..., :rank], low, symbols[..., rank:]], axis=2), rank)
    units = np.broadcast_to(np.eye(dimension), (several, dimension, dimension))
    free = np.linalg.qr(np.concatenate([solved[..., width:], units], axis=1))[0]
    below = np.concatenate([solved[..., :width], np.zeros((several, dimension, width))], axis=1)
    return np.concatenate([below - free @ (_turned(free) @ below), free], axis=2)

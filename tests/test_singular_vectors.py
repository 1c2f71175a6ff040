"""Approximate singular vectors in plain Python: orthogonal, diagonal, and as good as numpy's, whatever the matrix."""

from __future__ import annotations

from random import Random

import numpy as np
import pytest
from flint import arb_mat

from pkm_exact.poses import singular_vectors as module
from pkm_exact.poses.jacobian import largest_singular_value
from pkm_exact.poses.singular_vectors import singular_vectors


def _matrix(seed: int) -> list[list[float]]:
    """Of any shape and rank with at most four rows or columns, entries of very different sizes among them."""
    random = Random(seed)
    columns = random.randint(1, 4)
    rows = columns + random.choice((0, 0, 1, 3))
    table = [[random.gauss(0, 1) for _ in range(columns)] for _ in range(rows)]
    if seed % 3 == 1:
        table = [[value * 10.0 ** random.randint(-18, 3) for value in row] for row in table]
    if seed % 3 == 2:
        table = [[row[0] * (column + 1) for column in range(columns)] for row in table]
    return [list(row) for row in zip(*table, strict=True)] if seed % 5 == 0 else table


@pytest.mark.parametrize("seed", range(45))
def test_they_are_orthogonal_and_the_matrix_is_diagonal_in_them(seed: int) -> None:
    table = _matrix(seed)
    a, (u, v) = np.array(table), map(np.array, singular_vectors(table))
    assert np.abs(u.T @ u - np.eye(len(u))).max() < 1e-14
    assert np.abs(v.T @ v - np.eye(len(v))).max() < 1e-14
    inner = u.T @ a @ v
    values = np.linalg.svd(a, compute_uv=False)
    diagonal = np.abs(np.diagonal(inner))
    np.fill_diagonal(inner, 0)
    assert np.abs(inner).max() < 1e-14 * values[0]
    assert np.allclose(sorted(diagonal), sorted(values), rtol=0, atol=1e-14 * values[0])


@pytest.mark.parametrize("table", [[[0.0, 0.0], [0.0, 0.0]], [[0.0], [0.0], [0.0]], [[1e-200, 0.0], [2e-200, 1.0]]])
def test_zeros_and_numbers_whose_squares_vanish(table: list[list[float]]) -> None:
    u, v = map(np.array, singular_vectors(table))
    assert np.abs(u.T @ u - np.eye(len(u))).max() < 1e-15
    assert np.abs(v.T @ v - np.eye(len(v))).max() < 1e-15


def test_the_largest_singular_value_is_enclosed_closely() -> None:
    # Of ((1, 1), (0, 1)) it is the golden ratio.
    found = largest_singular_value(arb_mat([[1, 1], [0, 1]]))
    assert found is not None
    assert float(found.rad()) < 1e-13
    assert found.contains((arb_mat([[5]])[0, 0].sqrt() + 1) / 2)


def test_larger_matrices_are_numpy_s() -> None:
    table = [[float(3 * i + j * j) for j in range(6)] for i in range(6)]
    left, right = singular_vectors(table)
    u, _, v = np.linalg.svd(np.array(table))
    assert left == u.tolist()
    assert right == v.T.tolist()
    assert module.FEW < 6

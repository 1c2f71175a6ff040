"""Matrices modulo many primes at once, and numbers from their residues."""

from itertools import islice
from math import prod
from random import Random

import pytest
from flint import fmpz_mat, nmod_mat

from pkm_exact.certify.checker.residues import centred, combined, images, primes


def _some(rows: int, columns: int, bits: int) -> fmpz_mat:
    random = Random(f"{rows} {columns} {bits}")
    values = [random.choice((0, 1, 1)) * random.randint(-(1 << bits), 1 << bits) for _ in range(rows * columns)]
    return fmpz_mat(rows, columns, values)


@pytest.mark.parametrize(("bits", "count"), [(5, 3), (2000, 5), (2200, 40), (7000, 17)])
def test_images_are_those_modulo_each_prime(bits: int, count: int) -> None:
    matrix, chosen = _some(3, 4, bits), list(islice(primes(), count))
    found = list(images(matrix, chosen))
    assert [p for p, _ in found] == chosen
    assert all(image == nmod_mat(matrix, p) for p, image in found)


@pytest.mark.parametrize("count", [1, 2, 3, 8, 21])
def test_residues_tell_the_numbers_nearest_to_zero(count: int) -> None:
    chosen = list(islice(primes(), count))
    modulus = prod(chosen)
    matrix = _some(2, 3, modulus.bit_length() - 6)
    parts = [(p, fmpz_mat([[int(v) for v in row] for row in image.tolist()])) for p, image in images(matrix, chosen)]
    assert combined(parts, 1) == (modulus, matrix.entries())
    assert combined(parts, -7) == (modulus, [-7 * value for value in matrix.entries()])
    assert combined(parts, modulus - 1)[1] == [-value for value in matrix.entries()]
    assert centred(matrix[0, 0] + 3 * modulus, modulus) == matrix[0, 0]

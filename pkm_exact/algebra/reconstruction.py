"""Rational reconstruction: from residues modulo a large integer back to rationals with one common denominator.

Many residues a_j of rationals n_j / d with a common d determine it from little more than max |n_j| of modulus: the
vector (w d, n_1, .., n_k) is the shortest of the lattice spanned by (w, a_1, .., a_k) and the multiples of the modulus,
and lattice reduction (LLL) finds it. What is reconstructed is verified elsewhere; here it must only fit all residues.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from flint import fmpz, fmpz_mat

from pkm_exact.digests import digest

MARGIN_BITS = 32
"""Every numerator must be smaller than the modulus by this factor, or the reconstruction is not believed."""
LATTICE_RESIDUES = 5
"""Combinations of residues that a lattice is built from; with more a smaller modulus suffices, but LLL takes longer."""


def common_fraction(
    residues: Sequence[int | fmpz], modulus: int, denominator: int = 1, weight_bits: int = 0
) -> tuple[list[int], int] | None:
    """Integers n_j and one d > 0 with n_j = a_j d modulo the modulus, all of them small; None if there are none.

    Parameters
    ----------
    residues : sequence of int
        The a_j.
    modulus : int
    denominator : int
        A known divisor of d, or 1.
    weight_bits : int
        How many bits longer than the unknown factor of d the n_j are expected to be: right guesses need the smallest
        modulus, wrong ones a larger one.

    Examples
    --------
    >>> modulus = 2**255 - 19
    >>> common_fraction([pow(6, -1, modulus), 5 * pow(4, -1, modulus) % modulus], modulus)
    ([2, 15], 12)
    """
    wide, scale = fmpz(modulus), fmpz(denominator)
    values = [fmpz(residue) * scale % wide for residue in residues]
    weights = [weight_bits]
    while True:
        large = [value for value in values if not _is_small(_symmetric(value, wide), wide)]
        if not large:
            return [int(_symmetric(value, wide)) for value in values], int(scale)
        sample = _sample(large)
        factor = next((found for weight in weights if (found := _missing_factor(sample, wide, weight))), fmpz(0))
        scale *= factor
        if factor <= 1 or not _is_small(scale, wide):
            return None
        # The sample may lack a factor that the other residues need, most often a small one: look again.
        values = [value * factor % wide for value in values]
        weights = [max(modulus.bit_length() - 2 * MARGIN_BITS, 0), weight_bits]


def _sample(values: Sequence[fmpz]) -> Sequence[fmpz]:
    """A few combinations of the residues, which together have the same common denominator, almost certainly."""
    if len(values) <= LATTICE_RESIDUES:
        return values
    random = Random(digest(len(values), int(values[0])))
    weights = [[random.randrange(1, 1 << 8) for _ in values] for _ in range(LATTICE_RESIDUES)]
    combined = fmpz_mat(weights) * fmpz_mat([[value] for value in values])
    return [combined[row, 0] for row in range(LATTICE_RESIDUES)]


def _is_small(value: fmpz, modulus: fmpz) -> bool:
    return bool(value.bit_length() + MARGIN_BITS < modulus.bit_length())


def _missing_factor(sample: Sequence[fmpz], modulus: fmpz, weight_bits: int) -> fmpz:
    """A common denominator of the sample, or 0 if the modulus is too small to show one."""
    weight = fmpz(1) << weight_bits
    size = len(sample)
    rows = [[weight, *sample]]
    rows += [[modulus if column == row + 1 else fmpz(0) for column in range(size + 1)] for row in range(size)]
    factor = abs(fmpz_mat(rows).lll()[0, 0]) // weight
    if not factor:
        return fmpz(0)
    numerators = [_symmetric(residue * factor, modulus) for residue in sample]
    small = all(_is_small(numerator, modulus) for numerator in numerators)
    return factor if small and _is_convincing(factor, numerators, modulus) else fmpz(0)


def _is_convincing(factor: fmpz, numerators: Sequence[fmpz], modulus: fmpz) -> bool:
    """Whether a denominator and numerators are together too short to fit residues that have nothing in common."""
    spare = sum(modulus.bit_length() - numerator.bit_length() for numerator in numerators)
    return bool(factor.bit_length() + MARGIN_BITS < spare)


def _symmetric(value: fmpz, modulus: fmpz) -> fmpz:
    value %= modulus
    return value - modulus if 2 * value > modulus else value

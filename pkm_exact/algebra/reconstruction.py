"""Rational reconstruction: from residues modulo a large integer back to rationals with one common denominator.

Many residues a_j of rationals n_j / d with a common d determine it from little more than max |n_j| of modulus: the
vector (w d, n_1, .., n_k) is the shortest of the lattice spanned by (w, a_1, .., a_k) and the multiples of the modulus,
and lattice reduction (LLL) finds it. What is reconstructed is verified elsewhere; here it must only fit all residues.
"""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpz_mat

MARGIN_BITS = 32
"""Every numerator must be smaller than the modulus by this factor, or the reconstruction is not believed."""
LATTICE_RESIDUES = 8
"""Residues in one lattice: more would need less of the modulus, but cost more."""


def common_fraction(residues: Sequence[int], modulus: int, denominator: int = 1) -> tuple[list[int], int] | None:
    """Integers and one positive common denominator with the given residues, or None if the modulus is too small.

    Parameters
    ----------
    residues : sequence of int
    modulus : int
    denominator : int
        A known divisor of the common denominator.

    Examples
    --------
    >>> modulus = 2**255 - 19
    >>> common_fraction([pow(6, -1, modulus), 5 * pow(4, -1, modulus) % modulus], modulus)
    ([2, 15], 12)
    """
    while True:
        numerators = _numerators(residues, modulus, denominator)
        if numerators is not None:
            return numerators, denominator
        scaled = (residue * denominator % modulus for residue in residues)
        large = [value for value in scaled if not _is_small(_symmetric(value, modulus), modulus)]
        factor = _missing_factor(large[:: max(1, len(large) // LATTICE_RESIDUES)][:LATTICE_RESIDUES], modulus)
        if factor <= 1:
            return None
        denominator *= factor  # the sample may lack a factor that the other residues need: look again
        if not _is_small(denominator, modulus):
            return None


def _is_small(value: int, modulus: int) -> bool:
    return abs(value) < modulus >> MARGIN_BITS


def _missing_factor(sample: Sequence[int], modulus: int) -> int:
    """A common denominator of the sample, or 0 if the modulus is too small to show one."""
    for weight_bits in (modulus.bit_length() // 2, 0):
        factor = _common_denominator(sample, modulus, 1 << weight_bits)
        numerators = _numerators(sample, modulus, factor) if factor else None
        if numerators is not None and _is_convincing(factor, numerators, modulus):
            return factor
    return 0


def _is_convincing(factor: int, numerators: Sequence[int], modulus: int) -> bool:
    """Whether a denominator and numerators are together too short to fit residues that have nothing in common."""
    spare = sum(modulus.bit_length() - numerator.bit_length() for numerator in numerators)
    return factor.bit_length() + MARGIN_BITS < spare


def _numerators(residues: Sequence[int], modulus: int, denominator: int) -> list[int] | None:
    """The residues times the denominator, if all are small."""
    numerators = []
    for residue in residues:
        value = _symmetric(residue * denominator, modulus)
        if not _is_small(value, modulus):
            return None
        numerators.append(value)
    return numerators


def _common_denominator(residues: Sequence[int], modulus: int, weight: int) -> int:
    """The denominator that the shortest vector of the lattice stands for; 0 if it stands for none."""
    size = len(residues)
    rows = [[weight, *residues]]
    rows += [[modulus if column == row + 1 else 0 for column in range(size + 1)] for row in range(size)]
    shortest = fmpz_mat(rows).lll()[0, 0]
    return abs(int(shortest)) // weight


def _symmetric(value: int, modulus: int) -> int:
    value %= modulus
    return value - modulus if 2 * value > modulus else value

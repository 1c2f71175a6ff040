"""From representations modulo primes or prime powers to one over Q."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import log2

from flint import nmod_poly

from pkm_exact.algebra.newton import Equations, PadicRepresentation, lift
from pkm_exact.algebra.reconstruction import common_fraction
from pkm_exact.algebra.representation import UnivariateRepresentation, from_common_fractions
from pkm_exact.algebra.residue_ring import ResidueRing, coefficients
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.errors import ReconstructionError


def lift_by_newton(
    equations: Equations, form: Sequence[int], modular: ModularRepresentation, limit_bits: int
) -> UnivariateRepresentation:
    """The representation over Q of which ``modular`` is the image modulo p, for simple solutions.

    Raises
    ------
    UnluckyPrimeError
        If a solution is not simple modulo p.
    ReconstructionError
        If ``limit_bits`` of precision do not suffice.
    """
    prime = int(modular.eliminant.modulus())
    steps = lift(equations, form, modular.eliminant, modular.shape(), int(limit_bits / log2(prime)))
    for step in steps:
        found = _reconstructed(form, step.modulus, step.eliminant, partial(_numerators, step))
        if found is not None:
            return found
    raise ReconstructionError(f"no representation over Q appeared within {limit_bits} bits")


def lift_by_primes(
    form: Sequence[int], images: Iterator[ModularRepresentation], limit_bits: int
) -> UnivariateRepresentation:
    """The representation over Q from its images modulo many primes (Chinese remainders).

    Raises
    ------
    ReconstructionError
        If ``limit_bits`` of precision do not suffice.
    """
    residues: list[int] = []
    modulus, count, attempt_at = 1, 0, 2
    degree = -1
    for image in images:
        if image.degree != degree:
            if image.degree < degree:
                continue  # the form separates less at this prime: unlucky
            degree, residues, modulus, count, attempt_at = image.degree, [], 1, 0, 2
        prime = int(image.eliminant.modulus())
        vector = _image_vector(image)
        if modulus == 1:
            residues = vector
        else:
            inverse = pow(modulus % prime, -1, prime)
            residues = [
                old + modulus * ((new - old) * inverse % prime) for old, new in zip(residues, vector, strict=True)
            ]
        modulus *= prime
        count += 1
        if count == attempt_at:
            attempt_at += 1 + attempt_at // 8
            lists = [residues[start : start + degree] for start in range(0, len(residues), degree)]
            found = _reconstructed(form, modulus, [*lists[0], 1], partial(tuple, lists[1:]))
            if found is not None:
                return found
        if modulus.bit_length() > limit_bits:
            break
    raise ReconstructionError(f"no representation over Q appeared within {limit_bits} bits")


def _image_vector(image: ModularRepresentation) -> list[int]:
    """Coefficients of h without the leading 1, then of the numerators over h', each padded to the degree."""
    derivative = image.eliminant.derivative()
    vector = _padded(image.eliminant, image.degree)
    for coordinate in image.shape():
        vector += _padded(coordinate * derivative % image.eliminant, image.degree)
    return vector


def _padded(polynomial: nmod_poly, size: int) -> list[int]:
    values = [int(value) for value in polynomial.coeffs()][:size]
    return values + [0] * (size - len(values))


def _numerators(step: PadicRepresentation) -> list[list[int]]:
    ring = ResidueRing(step.modulus, step.eliminant)
    derivative = ring.relation.derivative()
    return [coefficients(ring.multiply(ring.convert(coordinate), derivative)) for coordinate in step.coordinates]


def _reconstructed(
    form: Sequence[int], modulus: int, eliminant: Sequence[int], numerators: Callable[[], Sequence[Sequence[int]]]
) -> UnivariateRepresentation | None:
    """The representation over Q, or None if the modulus is too small; the numerators are asked for late."""
    found = common_fraction(eliminant, modulus)
    if found is None:
        return None
    h, denominator = found
    lists = numerators()
    flat = common_fraction([value for numerator in lists for value in numerator], modulus, denominator)
    if flat is None:
        return None
    values, scale = iter(flat[0]), flat[1]
    return from_common_fractions(
        form, h, denominator, [[next(values) for _ in numerator] for numerator in lists], scale
    )

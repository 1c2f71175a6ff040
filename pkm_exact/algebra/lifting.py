"""From representations modulo primes or prime powers to one over Q.

Fractions that fit all residues may still be wrong: where the coefficients are nearly dependent, as beside a multiple
solution, short ones fit long before the right ones do. So a caller says what it accepts, and lifting goes on otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from math import log2
from typing import Final, TypeAlias

from pkm_exact.algebra.completion import CommonFractions, complete, padded
from pkm_exact.algebra.groebner import UnluckyPrimeError
from pkm_exact.algebra.newton import Equations, PadicRepresentation, lift
from pkm_exact.algebra.reconstruction import common_fraction
from pkm_exact.algebra.representation import UnivariateRepresentation, from_common_fractions
from pkm_exact.algebra.residue_ring import ResidueRing, coefficients
from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.errors import ReconstructionError

Acceptance: TypeAlias = Callable[[UnivariateRepresentation], bool]
"""Whether a representation over Q is right, exactly."""
SKIPPED: Final = 12
"""Primes with fewer solutions that are passed over, before those with more are suspected."""


def lift_by_newton(
    equations: Equations,
    form: Sequence[int],
    modular: ModularRepresentation,
    limit_bits: int,
    accept: Acceptance | None = None,
    watch: Callable[[int], None] | None = None,
) -> UnivariateRepresentation:
    """The representation over Q of which ``modular`` is the image modulo p, for simple solutions.

    It is the first one that fits and is accepted. ``watch`` gets the bits of each modulus that is reached.

    Raises
    ------
    UnluckyPrimeError
        If a solution is not simple modulo p.
    ReconstructionError
        If ``limit_bits`` of precision do not suffice.
    """
    prime = int(modular.eliminant.modulus())
    completion = equations.completion(form)
    steps = lift(equations, form, modular.eliminant, modular.shape(), int(limit_bits / log2(prime)))
    for step in steps:
        if watch is not None:
            watch(step.modulus.bit_length())
        count = len(form) if completion is None else completion.known
        found = _reconstructed(step.modulus, step.eliminant, partial(_numerators, step, 0, count))
        if found is not None and completion is not None:
            missing = [value for numerator in _numerators(step, count, len(form)) for value in numerator]
            found = complete(found, completion, (step.modulus, missing), limit_bits)
            if found is None:
                completion = None
                found = _reconstructed(step.modulus, step.eliminant, partial(_numerators, step, 0, len(form)))
        lifted = _accepted(form, found, accept)
        if lifted is not None:
            return lifted
    raise ReconstructionError(f"no representation over Q appeared within {limit_bits} bits")


def _accepted(
    form: Sequence[int], found: CommonFractions | None, accept: Acceptance | None
) -> UnivariateRepresentation | None:
    if found is None:
        return None
    lifted = from_common_fractions(form, found.eliminant, found.denominator, found.numerators, found.scale)
    return lifted if accept is None or accept(lifted) else None


def lift_by_primes(
    form: Sequence[int],
    images: Iterator[ModularRepresentation],
    limit_bits: int,
    accept: Acceptance | None = None,
    watch: Callable[[int], None] | None = None,
) -> UnivariateRepresentation:
    """The representation over Q from its images modulo many primes: the first that fits and is accepted.

    ``watch`` gets the bits of the modulus after each prime.

    Raises
    ------
    UnluckyPrimeError
        If some prime has more solutions than the others.
    ReconstructionError
        If ``limit_bits`` of precision do not suffice.
    """
    residues: list[int] = []
    modulus, count, attempt_at = 1, 0, 2
    degree, skipped = -1, 0
    for image in images:
        if image.degree != degree:
            if image.degree < degree:  # the form separates less at this prime: unlucky
                skipped += 1
                if skipped > SKIPPED:
                    raise UnluckyPrimeError(f"there are {degree} solutions at few primes only")
                continue
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
        if watch is not None:
            watch(modulus.bit_length())
        if count == attempt_at:
            attempt_at += 1 + attempt_at // 8
            lists = [residues[start : start + degree] for start in range(0, len(residues), degree)]
            found = _reconstructed(modulus, [*lists[0], 1], partial(tuple, lists[1:]))
            lifted = _accepted(form, found, accept)
            if lifted is not None:
                return lifted
        if modulus.bit_length() > limit_bits:
            break
    raise ReconstructionError(f"no representation over Q appeared within {limit_bits} bits")


def _image_vector(image: ModularRepresentation) -> list[int]:
    """Coefficients of h without the leading 1, then of the numerators over h', each padded to the degree."""
    derivative = image.eliminant.derivative()
    vector = padded(image.eliminant, image.degree + 1)[:-1]
    for coordinate in image.shape():
        vector += padded(coordinate * derivative % image.eliminant, image.degree)
    return vector


def _numerators(step: PadicRepresentation, start: int, end: int) -> list[list[int]]:
    """Numerators over h' of the coordinates from ``start`` to ``end``, padded to the degree."""
    ring = ResidueRing(step.modulus, step.eliminant)
    derivative = ring.relation.derivative()
    degree = len(step.eliminant) - 1
    numerators = []
    for coordinate in step.coordinates[start:end]:
        values = coefficients(ring.multiply(ring.convert(coordinate), derivative))
        numerators.append(values + [0] * (degree - len(values)))
    return numerators


def _reconstructed(
    modulus: int, eliminant: Sequence[int], numerators: Callable[[], Sequence[Sequence[int]]]
) -> CommonFractions | None:
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
    return CommonFractions(h, denominator, [[next(values) for _ in numerator] for numerator in lists], scale)

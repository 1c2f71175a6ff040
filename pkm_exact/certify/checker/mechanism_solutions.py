"""The complex solutions of a mechanism: roots of an eliminant are poses of it, distinct, and regular. All exact.

The proofs modulo a prime are those of ``solutions``. The derivative of a form along a twist is a row of six entries;
where the rows of all constraints have the full rank m, the dimension of the motions, a pose is isolated and simple.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import gcd, lcm
from random import Random
from typing import Any, Final

from flint import fmpq_poly, fmpz_poly

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.document import Representation
from pkm_exact.certify.checker.mechanism_forms import Form, Mechanism, quadric_value, quantities
from pkm_exact.certify.checker.multiplicity import Residue, determinant
from pkm_exact.certify.checker.solutions import (
    algebraic_cost,
    check_distinct,
    irreducible_factors,
    modulo,
    primitive_part,
    proved_coprime,
    vanishes,
)
from pkm_exact.certify.checker.study_motion import CYCLIC, Motion, combination, motion
from pkm_exact.certify.checker.verdict import Refusal, rejected

_LARGEST_WEIGHT: Final = 1 << 16
"""Of the rows of more constraints than freedoms, combined at random: any that give a regular matrix serve."""
_PRODUCT: Final = 6
"""Operations charged for a pair of words in a product of polynomials."""


def check_solutions(representation: Representation, mechanism: Mechanism, where: str = "") -> Iterator[str]:
    """Every root of the eliminant is a pose that all constraints admit, and different roots are different poses."""
    try:
        for line in _check_solutions(representation, mechanism):
            yield f"{where}{line}"
    except Refusal as refusal:
        raise Refusal(refusal.status, f"{where}{refusal.line}") from None


def _check_solutions(representation: Representation, mechanism: Mechanism) -> Iterator[str]:
    h = representation.eliminant
    numerators = (*representation.quaternion, *representation.translation)
    charge(_cost(representation) * (200 + 40 * len(mechanism.constraints)))
    if h.leading_coefficient() < 0 or gcd(*(int(value.content()) for value in (h, *numerators))) != 1:
        raise rejected("eliminant: not in lowest terms with positive leading coefficient")
    h0 = primitive_part(h)
    if not proved_coprime(h0, lambda p: modulo(h0.derivative(), p)):
        raise rejected("eliminant: not proved squarefree")
    yield f"eliminant: squarefree of degree {h.degree()}"
    yield from check_distinct(representation)
    if any(value for k, value in enumerate(numerators) if k not in mechanism.group.support):
        raise rejected("motion: a coordinate that is 0 for every motion of the platform is not")
    placed = motion(representation.quaternion, representation.translation, mechanism.metric)
    if not vanishes(placed.study, h0):
        raise rejected("motion: e.f is not 0 at every root of the eliminant")
    if not proved_coprime(h0, lambda p: modulo(placed.norm, p)):
        raise rejected("motion: not proved that N(e) is nowhere 0")
    yield "motion: e.f = 0 and N(e) is not 0, every solution is a rigid motion"
    values = quantities(placed)
    for number, constraint in enumerate(mechanism.constraints, 1):
        held = [combination(form, values) for form in constraint.integral]
        if constraint.quadric is not None:
            held.append(quadric_value(constraint.quadric, values, placed.norm))
        if not all(vanishes(value, h0) for value in held):
            raise rejected(f"constraints: number {number} does not hold at every solution")
    yield f"constraints: all {len(mechanism.constraints)} hold at every solution"


def _cost(representation: Representation) -> int:
    """Of a product of two polynomials of the representation."""
    numerators = (representation.eliminant, *representation.quaternion, *representation.translation)
    bits = max(int(value.height_bits()) for value in numerators)
    return int(_PRODUCT * (representation.eliminant.degree() + 1) ** 2 * limbs(2 * bits))


def rows(mechanism: Mechanism, placed: Motion) -> list[list[Any]]:
    """The derivatives of all constraints along the twists of the motions, in the ring of ``placed``.

    That of a form is multiplied by N^2, that of a cylinder by N^3, each by a common denominator too: no row changes
    whether it depends on others.
    """
    found = [_row(form, mechanism, placed) for form in mechanism.integral]
    for quadric in mechanism.quadrics:
        scale = lcm(*(value.denominator for form in (quadric.whole, quadric.root) for value in form))
        whole, root = ([int(value * scale) for value in form] for form in (quadric.whole, quadric.root))
        value = 2 * quadric.factor.denominator * combination(root, quantities(placed))
        factor = quadric.factor.numerator * scale * placed.norm
        pairs = zip(_row(whole, mechanism, placed), _row(root, mechanism, placed), strict=True)
        found.append([factor * left - value * right for left, right in pairs])
    return [[row[twist] for twist in mechanism.group.twists] for row in found]


def _row(form: Sequence[int], mechanism: Mechanism, placed: Motion) -> list[Any]:
    """N^2 (2 c_s C + a + c_C; a x C + sum_j R_j x c_Rj), a = R c_u, with c_u, c_C and c_Rj divided by the metric.

    All is multiplied by the product of the metric, so that integers remain.
    """
    g = mechanism.metric
    volume = g[0] * g[1] * g[2]
    turned = [volume // g[i] * form[1 + i] for i in range(3)]
    position = [volume // g[i] * form[4 + i] for i in range(3)]
    norm, place, rotation = placed.norm, placed.position, placed.rotation
    moved = [combination(turned, row) for row in rotation]
    force = [norm * (2 * volume * form[0] * place[i] + moved[i] + position[i] * norm) for i in range(3)]
    moment = []
    for _, j, k in CYCLIC:
        first = [volume // g[k] * form[7 + 3 * k + n] for n in range(3)]
        second = [volume // g[j] * form[7 + 3 * j + n] for n in range(3)]
        crossed = combination(first, rotation[j]) - combination(second, rotation[k])
        moment.append(moved[j] * place[k] - moved[k] * place[j] + norm * crossed)
    return [*force, *moment]


def are_regular(
    factor: fmpz_poly, representation: Representation, mechanism: Mechanism, *, briefly: bool = False
) -> bool:
    """Whether the rows are proved to have full rank at every root of a primitive factor of h, modulo some prime."""
    if len(mechanism.linear) + len(mechanism.quadrics) < mechanism.group.dimension:
        return False
    numerators = (*representation.quaternion, *representation.translation)
    charge(_PRODUCT * 4000 * (1 + int(factor.degree())) ** 2)

    def minor(p: int) -> Any:
        matrix = _rows_at([modulo(x, p) for x in numerators], modulo(factor, p), mechanism)
        return determinant(_square(matrix, mechanism.group.dimension)).value

    return proved_coprime(factor, minor, briefly=briefly)


def irregular_factors(representation: Representation, mechanism: Mechanism) -> list[fmpz_poly]:
    """The irreducible factors of h at whose roots the rows have not full rank, exactly over Q; at others they have."""
    factors = irreducible_factors(primitive_part(representation.eliminant))
    if mechanism.rank + len(mechanism.quadrics) < mechanism.group.dimension:
        return factors
    doubtful = [factor for factor in factors if not are_regular(factor, representation, mechanism, briefly=True)]
    return [factor for factor in doubtful if _rank(factor, representation, mechanism) < mechanism.group.dimension]


def full_rank_with(forms: Sequence[Form], representation: Representation, mechanism: Mechanism) -> bool:
    """Whether the rows of some of the mechanism's forms, and of its quadrics, are independent at all roots of h.

    They are completed by random rows to a square matrix, which is regular at all roots modulo a prime.
    """
    size = mechanism.group.dimension
    numerators = (*representation.quaternion, *representation.translation)
    h0 = primitive_part(representation.eliminant)
    cylinders = tuple(constraint for constraint in mechanism.constraints if constraint.quadric)
    part = Mechanism(mechanism.group, mechanism.metric, cylinders).with_forms(forms)
    charge(_PRODUCT * 4000 * (1 + int(h0.degree())) ** 2)
    if len(part.linear) + len(part.quadrics) > size:
        return False

    def minor(p: int) -> Any:
        modulus = modulo(h0, p)
        matrix = _rows_at([modulo(x, p) for x in numerators], modulus, part)
        random = Random(size)
        one = Residue(modulo(fmpz_poly([1]), p), modulus)
        while len(matrix) < size:
            matrix.append([random.randrange(1, _LARGEST_WEIGHT) * one for _ in range(size)])
        return determinant(matrix).value

    return proved_coprime(h0, minor)


def _square(matrix: list[list[Any]], size: int) -> list[list[Any]]:
    """The matrix, or as many random combinations of its rows as it has columns."""
    if len(matrix) == size:
        return matrix
    random = Random(len(matrix))
    weights = [[random.randrange(1, _LARGEST_WEIGHT) for _ in matrix] for _ in range(size)]
    return [[combination(row, [entry[column] for entry in matrix]) for column in range(size)] for row in weights]


def _rows_at(point: Sequence[Any], modulus: Any, mechanism: Mechanism) -> list[list[Any]]:
    """The rows at (e, f), in the residue ring of a polynomial over a field."""
    x = [Residue(value % modulus, modulus) for value in point]
    return rows(mechanism, motion(x[:4], x[4:], mechanism.metric))


def _rank(factor: fmpz_poly, representation: Representation, mechanism: Mechanism) -> int:
    """The rank over the field Q[T] / factor."""
    numerators = (*representation.quaternion, *representation.translation)
    modulus = fmpq_poly(factor)
    # Entries of the rows are forms of degree 6 at most; after an elimination they are quotients of minors of them.
    products = 36 * (len(mechanism.linear) + len(mechanism.quadrics)) + 12 * int(factor.degree())
    charge(products * algebraic_cost(factor, representation, 72))
    left = [[entry.value for entry in row] for row in _rows_at([fmpq_poly(x) for x in numerators], modulus, mechanism)]
    rank = 0
    for column in range(mechanism.group.dimension):
        pivot = next((row for row in left if row[column]), None)
        if pivot is None:
            continue
        left.remove(pivot)
        rank += 1
        inverse = pivot[column].xgcd(modulus)[1]
        scaled = [entry * inverse % modulus for entry in pivot]
        left = [
            [(a - row[column] * b) % modulus for a, b in zip(row, scaled, strict=True)] if row[column] else row
            for row in left
        ]
    return rank


def form_minus(form: Form, constant: Fraction) -> Form:
    """The form with a constant subtracted."""
    return (*form[:-1], form[-1] - constant)

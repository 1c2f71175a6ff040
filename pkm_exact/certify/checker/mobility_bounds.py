"""Bounds of a finite mobility, of versions 2 and 3 of ``docs/certificates-mobility.md``."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations_with_replacement
from math import comb
from typing import Final

from flint import fmpq, fmpq_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.mobility_closure import check_curve, check_order
from pkm_exact.certify.checker.mobility_curves import check_curves
from pkm_exact.certify.checker.mobility_document import MobilityDocument, SecondOrder
from pkm_exact.certify.checker.mobility_groups import bracket, check_legs, group_dimensions
from pkm_exact.certify.checker.mobility_local import check_local
from pkm_exact.certify.checker.mobility_machine import Machine, Rows, exact, rank_of, times, words_of
from pkm_exact.certify.checker.verdict import malformed, rejected, too_large

MOST_MONOMIALS: Final = 500
Form = list[list[fmpq]]
"""The symmetric matrix of a quadratic form."""


def check_second_order(document: MobilityDocument, claim: SecondOrder, machine: Machine, motions: Rows) -> str:
    """The bounds of the finite mobility, with the motions as the null space of the loops."""
    dependencies = _dependencies(claim, machine)
    forms = [_form(machine, motions, u) for u in dependencies]
    if claim.above == "order":
        check_order(claim, machine, dependencies, motions)
    if claim.above == "local":
        check_local(claim, machine, document.proofs["loops"], motions)
    else:
        _check_above(claim, forms, len(motions))
    _check_below(document, claim, machine, forms, len(motions))
    if claim.platform_most != min(claim.most, 6):
        raise rejected("finite.platform_most: not the number that follows")
    least, most = claim.least, claim.most
    found = str(least) if least == most else f"{least} to {most}"
    return f"finite: mobility {found} near the configuration, by the argument {claim.argument}"


def _dependencies(claim: SecondOrder, machine: Machine) -> Rows:
    vectors = [[exact(x) for x in u] for u in claim.dependencies]
    if any(len(u) != len(machine.matrix) for u in vectors):
        raise malformed("finite.dependencies: not a number for each equation")
    if vectors:
        columns = [list(column) for column in zip(*machine.matrix, strict=True)]
        if any(map(any, times(columns, vectors))):
            raise rejected("finite.dependencies: not one of the equations")
    return vectors


def _form(machine: Machine, motions: Rows, u: Sequence[fmpq]) -> Form:
    """Q_u on the motions: the sum over i < j of s_i s_j u.[S_i, S_j] (q_i)(q_j)."""
    count = len(motions)
    total = fmpq_mat(count, count)
    for number, loop in enumerate(machine.loops):
        weights = u[6 * number : 6 * number + 6]
        passed = machine.passed(loop)
        size = words_of(machine.twists) + words_of([weights]) + words_of(motions)
        charge(len(passed) ** 2 * (9000 + 60 * size * size) + count * len(passed) * (len(passed) + count) * 900 * size)
        table = fmpq_mat(len(passed), len(passed))
        for j, (second, after) in enumerate(passed):
            for i, (first, before) in enumerate(passed[:j]):
                product = bracket(machine.twists[first], machine.twists[second])
                table[i, j] = before * after * sum((w * x for w, x in zip(weights, product, strict=True)), fmpq(0))
        speeds = fmpq_mat(count, len(passed), [motion[column] for motion in motions for column, _ in passed])
        total += speeds * table * speeds.transpose()
    whole = total + total.transpose()
    return [[whole[i, j] / 2 for j in range(count)] for i in range(count)]


def _value(form: Form, y: Sequence[fmpq]) -> fmpq:
    image = times(form, [list(y)])
    return sum((a * row[0] for a, row in zip(y, image, strict=True)), fmpq(0))


def _check_above(claim: SecondOrder, forms: Sequence[Form], mobility: int) -> None:
    most = claim.most
    if claim.above == "rank":
        if most != mobility:
            raise rejected("finite.most: not the number that follows")
        return
    if claim.above in ("definite", "order"):
        if most != 0:
            raise rejected("finite.most: not the number that follows")
        if claim.above == "definite" and (not forms or not _is_positive(forms[0])):
            raise rejected("finite.above: the form is not positive")
        return
    section = [[exact(x) for x in vector] for vector in claim.section]
    if any(len(vector) != mobility for vector in section):
        raise malformed("finite.above.section: not a number for each motion")
    if most != mobility - len(section):
        raise rejected("finite.most: not the number that follows")
    cut = [_cut(form, section) for form in forms]
    if not _are_all_monomials(cut, len(section), claim.degree):
        raise rejected("finite.above: the section of the cone may be more than 0")


def _is_positive(form: Form) -> bool:
    """Whether all leading minors are positive."""
    size = len(form)
    words = size * words_of(form)
    charge(3000 + size**4 * (300 + words * words))
    return all(fmpq_mat([row[:k] for row in form[:k]]).det() > 0 for k in range(1, size + 1))


def _cut(form: Form, section: Rows) -> Form:
    """The form on combinations of vectors: S A S^T."""
    images = times(form, section)
    return times([list(column) for column in zip(*images, strict=True)], section)


def _are_all_monomials(forms: Sequence[Form], count: int, degree: int) -> bool:
    """Whether monomials times forms span all monomials of a degree."""
    number = comb(count + degree - 1, degree)
    if number > MOST_MONOMIALS:
        raise too_large(f"finite.above: more than {MOST_MONOMIALS} monomials")
    places = {m: k for k, m in enumerate(combinations_with_replacement(range(count), degree))}
    factors = list(combinations_with_replacement(range(count), degree - 2))
    charge(2000 * len(forms) * len(factors) * number)
    rows = []
    for form in forms:
        for factor in factors:
            row = [fmpq(0)] * number
            for i in range(count):
                for j in range(count):
                    row[places[tuple(sorted((i, j, *factor)))]] += form[i][j]
            rows.append(row)
    return rank_of(rows) == number


def _check_below(
    document: MobilityDocument, claim: SecondOrder, machine: Machine, forms: Sequence[Form], mobility: int
) -> None:
    if claim.below is None:
        expected = (0, 0)
    elif claim.below == "indefinite":
        rank = document.freedoms - mobility
        if group_dimensions(machine) != rank + 1:
            raise rejected("finite.below: the loops do not ask one thing more")
        _check_signs(claim, forms, mobility)
        expected = (mobility - 1, 0)
    elif claim.below == "curve":
        expected = (1, check_curve(claim, machine))
    elif claim.below == "curves":
        expected = check_curves(claim, machine)
    else:
        expected = _with_locked(document, claim, machine)
    for key, given, follows in zip(
        ("least", "platform_least"), (claim.least, claim.platform_least), expected, strict=True
    ):
        if given != follows:
            raise rejected(f"finite.{key}: not the number that follows")


def _with_locked(document: MobilityDocument, claim: SecondOrder, machine: Machine) -> tuple[int, int]:
    """The mobility and that of the platform with freedoms locked, proved to be finite."""
    locked = claim.locked
    rank = rank_of(machine.without(machine.matrix, locked))
    if claim.below == "regular":
        if group_dimensions(machine, locked) != rank:
            raise rejected("finite.below: the loops are not regular")
    else:
        check_legs(document, claim.legs, machine, locked)
    both = machine.without([*machine.matrix, *machine.platform], locked)
    return document.freedoms - len(locked) - rank, rank_of(both) - rank


def _check_signs(claim: SecondOrder, forms: Sequence[Form], mobility: int) -> None:
    vectors = [[exact(x) for x in y] for y in claim.vectors]
    if any(len(y) != mobility for y in vectors):
        raise malformed("finite.below.vectors: not a number for each motion")
    if not forms or _value(forms[0], vectors[0]) <= 0 or _value(forms[0], vectors[1]) >= 0:
        raise rejected("finite.below: the form has not both signs")

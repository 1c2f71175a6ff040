"""Groups that the joints of loops and legs generate: what proves a finite mobility, with freedoms locked too."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import reduce
from itertools import combinations

from flint import fmpq

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.mobility_document import LegOfProof, MobilityDocument
from pkm_exact.certify.checker.mobility_machine import Machine, Rows, cross, matrix_of, rank_of, words_of
from pkm_exact.certify.checker.verdict import malformed, rejected


def group_dimensions(machine: Machine, locked: Collection[int] = ()) -> int:
    """The dimensions of the groups that the loops generate, summed up."""
    return sum(len(closure(machine.along(loop, locked))) for loop in machine.loops)


def check_legs(
    document: MobilityDocument, legs: Sequence[LegOfProof], machine: Machine, locked: Collection[int] = ()
) -> None:
    """The legs fill groups, or products of two, that are transversal."""
    groups: list[Rows] = []
    products: list[tuple[Rows, Rows]] = []
    used: list[int] = []
    between: list[int] = []
    for leg in legs:
        path = chain_of(document, leg.joints)
        used += leg.joints
        between += [document.joints[place].bodies[1 if sign == 1 else 0] for place, sign in path[:-1]]
        twists = machine.along(path, locked)
        if leg.cut >= max(1, len(twists)):
            raise malformed("finite.legs: a cut behind the leg's joints")
        parts = [twists[: leg.cut], twists[leg.cut :]] if leg.cut else [twists]
        algebras = [closure(part) for part in parts]
        if len(echelon_rows([row for algebra in algebras for row in algebra])) != rank_of(twists):
            raise rejected("finite: a leg does not fill its groups")
        if len(algebras) == 1:
            groups.append(algebras[0])
        elif (algebras[0], algebras[1]) not in products:
            products.append((algebras[0], algebras[1]))
    if sorted(used) != list(range(len(document.joints))):
        raise rejected("finite: not every joint is in one leg")
    inner = set(range(document.bodies)) - {document.base, document.platform}
    if sorted(between) != sorted(inner):
        raise rejected("finite: not every body is in one leg")
    if not _are_transversal(groups, products):
        raise rejected("finite: the legs are not transversal")


def chain_of(document: MobilityDocument, places: Sequence[int]) -> list[tuple[int, int]]:
    """The joints of a leg with the directions in which they are passed."""
    body, found = document.base, []
    for place in places:
        one, other = document.joints[place].bodies
        if body not in (one, other):
            raise rejected("finite: the joints of a leg are no chain")
        sign = 1 if body == one else -1
        body = other if sign == 1 else one
        found.append((place, sign))
    if body != document.platform:
        raise rejected("finite: a leg does not end at the platform")
    return found


def _are_transversal(groups: Sequence[Rows], products: Sequence[tuple[Rows, Rows]]) -> bool:
    spaces: list[Rows] = []
    common = reduce(meet, groups) if groups else None
    if common is not None:
        spaces.append(common)
    spaces += [
        echelon_rows([*pair[0], *pair[1]])
        for pair in products
        if common is None or not any(len(echelon_rows([*common, *part])) == len(part) for part in pair)
    ]
    together = reduce(meet, spaces)
    return 6 - len(together) == sum(6 - len(space) for space in spaces)


def echelon_rows(rows: Rows) -> Rows:
    """The reduced echelon form, without rows of 0."""
    rank = rank_of(rows)
    return [list(row) for row in matrix_of(rows, 6).rref()[0].tolist()[:rank]] if rank else []


def meet(one: Rows, other: Rows) -> Rows:
    """The intersection of two spaces of rows of six."""
    if not one or not other:
        return []
    rows = [*one, *([-value for value in row] for row in other)]
    words = 6 * words_of(rows)
    charge(10_000 + 6 * 6 * 12 * (300 + words * words))
    columns = [list(column) for column in zip(*rows, strict=True)]
    reduced = matrix_of(columns, len(rows)).rref()
    pivots = [next(k for k, value in enumerate(row) if value) for row in reduced[0].tolist()[: reduced[1]]]
    found = []
    for free in (k for k in range(len(rows)) if k not in pivots):
        factors = [fmpq(0)] * len(rows)
        factors[free] = fmpq(1)
        for row, pivot in zip(reduced[0].tolist(), pivots, strict=False):
            factors[pivot] = -row[free]
        found.append([sum((f * row[k] for f, row in zip(factors, one, strict=False)), fmpq(0)) for k in range(6)])
    return echelon_rows(found)


def closure(rows: Rows) -> Rows:
    """The closure under the Lie product, as a reduced echelon form."""
    found = echelon_rows(rows)
    while True:
        words = words_of(found)
        charge(15 * (20_000 + 100 * words * words))
        larger = echelon_rows([*found, *(bracket(a, b) for a, b in combinations(found, 2))])
        if len(larger) == len(found):
            return found
        found = larger


def bracket(one: Sequence[fmpq], other: Sequence[fmpq]) -> list[fmpq]:
    turn = cross(one[:3], other[:3])
    slide = [a + b for a, b in zip(cross(one[:3], other[3:]), cross(one[3:], other[:3]), strict=True)]
    return turn + slide

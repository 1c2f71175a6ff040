"""Checks mobility certificates of version 3 with Python's integers and nothing else.

The part of ``pure_mobility.py``, beside this file, for bounds from the ideal of the loops and from curves. Written from
the definition of the format and its proofs, ``docs/certificates-mobility.md``. It shares no line with the other
checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations_with_replacement
from math import comb, lcm
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure
else:
    import pure

__all__ = ["Curve", "a_curve", "check_curves", "check_local"]

Row: TypeAlias = tuple[Fraction, ...]
Passed: TypeAlias = Sequence[Sequence[tuple[int, int]]]
"""For each loop the places of the one-freedom joints with 1 or -1, in the order in which they are passed."""

Q: Final = 2**61 - 1
MAX_DEGREE: Final = 12
MAX_MONOMIALS: Final = 500

HAMILTON: Final = (
    *((0, 1, 0, -1), (0, 2, 1, -1), (0, 3, 2, -1)),
    *((1, 0, 0, 1), (1, 2, 2, 1), (1, 3, 1, -1)),
    *((2, 0, 1, 1), (2, 3, 0, 1), (2, 1, 2, -1)),
    *((3, 0, 2, 1), (3, 1, 1, 1), (3, 2, 0, -1)),
)
"""Entry a of a quaternion p times a vector u has the term p_b u_c with this sign: a, b, c and the sign."""
VECTOR: Final = (1, 2, 3, 5, 6, 7)


def terms_of_product() -> Iterator[tuple[int, int, int, int]]:
    """The same for a dual quaternion, eight numbers, times w + e v, six numbers."""
    for a, b, c, sign in HAMILTON:
        yield a, b, c, sign
        yield a + 4, b + 4, c, sign
        yield a + 4, b, c + 3, sign


def straight(twists: Sequence[Row], loops: Passed) -> None:
    """Refuse a screw with a pitch in a loop."""
    for loop in loops:
        for place, _ in loop:
            w, v = twists[place][:3], twists[place][3:]
            pitch = sum((a * b for a, b in zip(w, v, strict=True)), Fraction(0))
            pure.require(not pitch, "finite: a screw of a loop has a pitch")


# ---------------------------------------------------------------------------------------------------------------------
# The local ring
# ---------------------------------------------------------------------------------------------------------------------


class Truncated(NamedTuple):
    """Monomials up to a degree by their places, and where the product of two of them is."""

    degrees: tuple[int, ...]
    products: tuple[tuple[int, ...], ...]

    def times(self, a: Sequence[int], b: Sequence[int]) -> list[int]:
        """The product of polynomials."""
        found = [0] * len(self.degrees)
        for x, targets in zip(a, self.products, strict=True):
            if x:
                for y, target in zip(b, targets, strict=False):
                    found[target] += x * y
        return [value % Q for value in found]

    @property
    def cost(self) -> int:
        """Operations for a product."""
        return 1000 + 250 * sum(map(len, self.products))


def truncated(unknowns: int, degree: int) -> Truncated:
    """The polynomials in so many unknowns up to a degree."""
    number = comb(unknowns + degree, degree)
    pure.affordable(number <= MAX_MONOMIALS, f"finite.above: more than {MAX_MONOMIALS} monomials")
    pure.spend(3000 * number * number)
    names: list[tuple[int, ...]] = []
    for k in range(degree + 1):
        names += combinations_with_replacement(range(unknowns), k)
    place = {name: k for k, name in enumerate(names)}
    products = [tuple(place[tuple(sorted(a + b))] for b in names if len(a + b) <= degree) for a in names]
    return Truncated(tuple(map(len, names)), tuple(products))


def residue(x: Fraction) -> int:
    """A rational number modulo the prime."""
    pure.require(x.denominator % Q, "finite.above: the prime divides a denominator")
    pure.spend(pure.division_cost(61, 61) + pure.division_cost(pure.most_bits([x.numerator, x.denominator]), 61))
    return x.numerator * pow(x.denominator, -1, Q) % Q


def check_local(
    twists: Sequence[Row],
    loops: Passed,
    matrix: Sequence[Sequence[Fraction]],
    places: tuple[Sequence[int], Sequence[int]],
    directions: Sequence[Row],
    degree: int,
) -> None:
    """Prove that all monomials of the degree are in the ideal; directions are motions, places those of a minor."""
    straight(twists, loops)
    ring = truncated(len(directions), degree)
    rows, columns = places
    inverse = inverted([[residue(matrix[i][j]) for j in columns] for i in rows])
    screws = [[residue(x) for x in twist] for twist in twists]
    half = []
    for k in range(len(twists)):
        linear = [residue(direction[k]) for direction in directions]
        half.append([0, *linear, *[0] * (len(ring.degrees) - 1 - len(linear))])
    parts = vector_parts(screws, loops, half, ring)
    for _ in range(degree):
        pure.spend(300 * len(rows) ** 2 * len(ring.degrees))
        for column, factors in zip(columns, inverse, strict=True):
            for k in range(len(ring.degrees)):
                half[column][k] -= sum(f * parts[row][k] for f, row in zip(factors, rows, strict=True))
            half[column] = [value % Q for value in half[column]]
        parts = vector_parts(screws, loops, half, ring)
    others = [part for k, part in enumerate(parts) if k not in rows]
    pure.require(
        contains_top(others, ring, degree), "finite.above: the configuration may not be isolated on the section"
    )


def inverted(minor: list[list[int]]) -> list[list[int]]:
    """The inverse modulo the prime."""
    size = len(minor)
    pure.spend(1000 + 600 * size**3)
    rows = [[*row, *(int(i == k) for i in range(size))] for k, row in enumerate(minor)]
    for k in range(size):
        place = next((i for i in range(k, size) if rows[i][k]), -1)
        pure.require(place >= 0, "finite.above: the minor is 0 modulo the prime")
        rows[k], rows[place] = rows[place], rows[k]
        factor = pow(rows[k][k], -1, Q)
        rows[k] = [x * factor % Q for x in rows[k]]
        rows = [
            row if i == k else [(x - row[k] * y) % Q for x, y in zip(row, rows[k], strict=True)]
            for i, row in enumerate(rows)
        ]
    return [row[size:] for row in rows]


def vector_parts(
    screws: Sequence[Sequence[int]], loops: Passed, half: Sequence[Sequence[int]], ring: Truncated
) -> list[list[int]]:
    """The six vector parts of each loop."""
    size = len(ring.degrees)
    found = []
    for loop in loops:
        product = [[int(k == entry == 0) for k in range(size)] for entry in range(8)]
        for place, sign in loop:
            pure.spend(8 * ring.cost + 36 * 200 * size)
            turned = [[0] * size for _ in range(8)]
            for a, b, c, one in terms_of_product():
                factor = one * sign * screws[place][c]
                if factor:
                    turned[a] = [x + factor * y for x, y in zip(turned[a], product[b], strict=True)]
            moved = [ring.times(half[place], [x % Q for x in part]) for part in turned]
            product = [[(x + y) % Q for x, y in zip(*pair, strict=True)] for pair in zip(product, moved, strict=True)]
        found += [product[k] for k in VECTOR]
    return found


def contains_top(parts: Sequence[Sequence[int]], ring: Truncated, degree: int) -> bool:
    """Whether multiples of the parts span all monomials of the degree: rows that begin there are as many."""
    size = len(ring.degrees)
    pivots: dict[int, list[int]] = {}
    for part in parts:
        for power, targets in zip(ring.degrees, ring.products, strict=True):
            if power > degree - 2 or not any(part):
                continue
            row = [0] * size
            for x, target in zip(part, targets, strict=False):
                row[target] = x
            pure.spend(400 * size)
            for place in range(size):
                if row[place] and place in pivots:
                    pure.spend(250 * size)
                    factor = row[place]
                    row = [(x - factor * y) % Q for x, y in zip(row, pivots[place], strict=True)]
                elif row[place]:
                    factor = pow(row[place], -1, Q)
                    pivots[place] = [x * factor % Q for x in row]
                    break
    return all(place in pivots for place in range(size) if ring.degrees[place] == degree)


# ---------------------------------------------------------------------------------------------------------------------
# Curves
# ---------------------------------------------------------------------------------------------------------------------

Flat: TypeAlias = dict[tuple[int, int], int]
"""The coefficients, none 0, of a polynomial in s and u, by powers of s and u."""


class Curve(NamedTuple):
    """F, and N and D for each freedom, by powers of u, then of s."""

    relation: tuple[Row, ...]
    halves: tuple[tuple[tuple[Row, ...], Row], ...]


def a_polynomial(value: Any, where: str) -> Row:
    """A polynomial in s."""
    found: Row = pure.a_list(pure.a_rational)(value, where)
    pure.well_formed(1 <= len(found) <= MAX_DEGREE, f"{where}: not 1 to {MAX_DEGREE} coefficients")
    return found


def in_both(value: Any, where: str) -> tuple[Row, ...]:
    """A polynomial in s and u."""
    found: tuple[Row, ...] = pure.a_list(a_polynomial)(value, where)
    pure.well_formed(1 <= len(found) <= MAX_DEGREE, f"{where}: not 1 to {MAX_DEGREE} polynomials")
    return found


def a_curve(value: Any, where: str) -> Curve:
    """A curve."""
    relation, halves = pure.an_object(value, where, "relation halves")
    read = in_both(relation, f"{where}.relation")
    pure.well_formed(len(read) > 1 and any(read[-1]), f"{where}.relation: not a polynomial with u")

    def a_half(entry: Any, place: str) -> tuple[tuple[Row, ...], Row]:
        both = pure.a_list(lambda part, _: part, 2)(entry, place)
        return in_both(both[0], f"{place}[1]"), a_polynomial(both[1], f"{place}[2]")

    return Curve(read, pure.a_list(a_half)(halves, f"{where}.halves"))


def coefficient(sheets: Sequence[Row], power_of_s: int, power_of_u: int) -> Fraction:
    """One coefficient."""
    for row in sheets[power_of_u : power_of_u + 1]:
        for value in row[power_of_s : power_of_s + 1]:
            return value
    return Fraction(0)


def check_curves(twists: Sequence[Row], loops: Passed, curves: Sequence[Curve]) -> list[Row]:
    """Prove that the curves are configurations, independent of each other; their speeds."""
    speeds = [speeds_of(curve, len(twists)) for curve in curves]
    moving = [[any(map(any, numerator)) for numerator, _ in curve.halves] for curve in curves]
    alone: Iterator[list[int]] = ([k] for k in range(len(twists)))
    for places in (*([k for k, _ in loop] for loop in loops), *alone):
        number = sum(any(moves[k] for k in places) for moves in moving)
        pure.require(number < 2, "finite.below.curves: two move freedoms of one loop")
    straight(twists, loops)
    for curve in curves:
        halves = [flat_half(numerator, denominator) for numerator, denominator in curve.halves]
        relation = flat(curve.relation, 1)[0]
        for loop in loops:
            product: list[Flat] = [{(0, 0): 1}, *({} for _ in range(7))]
            for place, sign in loop:
                product = with_joint(product, halves[place], [sign * x for x in twists[place]])
                product = remainder(product, relation)
            closed = not any(product[k] for k in VECTOR)
            pure.require(closed, "finite.below.curves: does not close the loops")
    return speeds


def speeds_of(curve: Curve, size: int) -> Row:
    """The speeds at the configuration, from which the curve begins."""
    pure.well_formed(len(curve.halves) == size, "finite.below.curves: not a pair for each freedom")
    by_s, by_u = coefficient(curve.relation, 1, 0), coefficient(curve.relation, 0, 1)
    regular = not coefficient(curve.relation, 0, 0) and by_u
    pure.require(regular, "finite.below.curves: the relation is not regular at the configuration")
    begins = all(not coefficient(numerator, 0, 0) and denominator[0] for numerator, denominator in curve.halves)
    pure.require(begins, "finite.below.curves: does not begin at the configuration")
    pure.spend(20_000 * size)
    found = []
    for numerator, denominator in curve.halves:
        change = coefficient(numerator, 1, 0) - coefficient(numerator, 0, 1) * by_s / by_u
        found.append(change / denominator[0])
    pure.require(any(found), "finite.below.curves: does not move")
    return tuple(found)


def flat(sheets: Sequence[Row], factor: int) -> tuple[Flat, int]:
    """A polynomial in integers, times what is returned too."""
    scale = lcm(factor, *(x.denominator for row in sheets for x in row))
    found = {}
    for j, row in enumerate(sheets):
        for i, value in enumerate(row):
            if value:
                found[i, j] = int(value * scale)
    return found, scale


def flat_half(numerator: Sequence[Row], denominator: Row) -> tuple[Flat, Flat]:
    """N and D times one integer."""
    both = lcm(*(x.denominator for row in (*numerator, denominator) for x in row))
    return flat(numerator, both)[0], flat((denominator,), both)[0]


def bits_of(parts: Sequence[Mapping[tuple[int, int], int]]) -> int:
    """Of the longest coefficient."""
    return pure.most_bits([value for part in parts for value in part.values()])


def multiplied(one: Mapping[tuple[int, int], int], other: Mapping[tuple[int, int], int]) -> Flat:
    """The product."""
    pure.spend(len(one) * len(other) * (300 + pure.product_cost(bits_of([one]), bits_of([other]))))
    found: Flat = {}
    for (i, j), x in one.items():
        for (k, m), y in other.items():
            found[i + k, j + m] = found.get((i + k, j + m), 0) + x * y
    return {power: value for power, value in found.items() if value}


def combined(terms: Sequence[tuple[int, Mapping[tuple[int, int], int]]]) -> Flat:
    """The sum of multiples."""
    found: Flat = {}
    for factor, part in terms:
        pure.spend(len(part) * (300 + pure.product_cost(factor.bit_length(), bits_of([part]))))
        for power, value in part.items():
            found[power] = found.get(power, 0) + factor * value
    return {power: value for power, value in found.items() if value}


def with_joint(product: Sequence[Flat], half: tuple[Flat, Flat], twist: Sequence[Fraction]) -> list[Flat]:
    """The product times D + N (w + e v), times an integer."""
    numerator, denominator = half
    scale = lcm(*(x.denominator for x in twist))
    whole = [int(x * scale) for x in twist]
    found = []
    for entry in range(8):
        terms = [(sign * whole[c], product[b]) for a, b, c, sign in terms_of_product() if a == entry]
        stays, moves = multiplied(product[entry], denominator), multiplied(combined(terms), numerator)
        found.append(combined([(scale, stays), (1, moves)]))
    return found


def remainder(product: Sequence[Flat], relation: Flat) -> list[Flat]:
    """Parts of a degree in u below that of F: times a power of its last coefficient, less multiples of it."""
    degree = max(j for _, j in relation)
    last = {(i, 0): value for (i, j), value in relation.items() if j == degree}
    found = list(product)
    while True:
        top = max((j for part in found for _, j in part), default=0)
        if top < degree:
            return found
        following = []
        for part in found:
            head = {(i, top - degree): value for (i, j), value in part.items() if j == top}
            following.append(combined([(1, multiplied(part, last)), (-1, multiplied(head, relation))]))
        found = following

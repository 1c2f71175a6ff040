"""Checks certificates of polynomial systems with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate; spelling,
verdicts, real roots, eliminations and algebras are there. Written from the definition of the format and its proofs,
``docs/certificates-systems.md``; the sections below have its order and its notation. It shares no line with the other
checker.

Points are homogeneous here: a solution at a root of h is (h' : N_1 : .. : N_n), a point at infinity (0 : Z_1 : ..
: Z_n), and polynomials are made homogeneous by x_0. So the value of F in a representation is F^h at its point, and the
matrices of derivatives differ from those of the specification by powers of h' only, which is nowhere 0.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from hashlib import sha256
from itertools import combinations, pairwise
from math import comb, gcd, isqrt, lcm, prod
from random import Random
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure
else:
    import pure

__all__ = ["replayed"]

Forms: TypeAlias = dict[pure.Monomial, int]  # homogeneous: the first exponent is that of x_0
Polynomial: TypeAlias = pure.Polynomial

MAX_VARIABLES: Final = 64
MAX_POLYNOMIALS: Final = 256
MAX_POLYNOMIAL_DEGREE: Final = 64
MAX_TERMS: Final = 1 << 16
MAX_DIGITS: Final = 4000
MAX_NUMBER: Final = 2000
MAX_HOMOGENEOUS_NUMBER: Final = 20_000
MAX_GRADE: Final = 200
MAX_FORMS: Final = 64
MAX_STATES: Final = 1 << 20
ATTEMPTS: Final = 3
"""Primes that are tried."""
PART_FOR_MULTIPLICITIES: Final = 4
"""One part of so many of the work allowed may be spent on them before an algebra is tried."""

# ---------------------------------------------------------------------------------------------------------------------
# Format
# ---------------------------------------------------------------------------------------------------------------------

FORMAT: Final = "pkm_exact system certificate"
NAME: Final = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,31}", re.ASCII)
FACTOR: Final = re.compile(r"(-?[1-9][0-9]*)|([A-Za-z_][A-Za-z0-9_]{0,31})(?:\^([1-9][0-9]?))?", re.ASCII)
PRODUCT: Final = re.compile(r"(?:0|[1-9][0-9]{0,5})(?: (?:[0-9]|[1-5][0-9]|6[0-3])){0,64}", re.ASCII)

ROUTES: Final = (
    "refined-bezout",
    "multihomogeneous-bezout",
    "mixed-volume",
    "modular-rank",
    "counting-at-infinity",
    "exact-elimination",
)
CAUSES: Final = ("fewer-polynomials", "more-solutions-than-bound")
KEYS: Final = (
    "format version title variables polynomials claim completeness_route complex_solutions distinct_solutions "
    "real_solutions representation groups infinity elimination witness box_exponent solutions notes"
)
KEYS_WITH_CELLS: Final = KEYS.replace(" witness", " subdivision witness")
NUMBERS: Final = re.compile(r"(?:0|-?[1-9][0-9]{0,17})( (?:0|-?[1-9][0-9]{0,17}))*", re.ASCII)


@dataclass(frozen=True)
class Infinity:
    """Points at infinity, with the chart w.z = 1, and the sum of their weights."""

    points: pure.Representation
    multiplicity: int


@dataclass(frozen=True)
class Cells:
    """The number by which each point of each support is lifted, and obstructions: weights of points."""

    lifting: tuple[tuple[int, ...], ...]
    obstructions: tuple[dict[tuple[int, int], int], ...]


@dataclass(frozen=True)
class Witness:
    """What proves a positive dimension; slices are constants with representations."""

    cause: str
    forms: tuple[tuple[int, ...], ...]
    slices: tuple[tuple[Fraction, pure.Representation], ...]


@dataclass(frozen=True)
class Solution:
    """A solution as listed: ends of intervals as texts."""

    parameter: pure.Ends
    values: tuple[pure.Ends, ...]
    multiplicity: int | None


@dataclass(frozen=True)
class Certificate:
    """What a certificate says."""

    number: int
    polynomials: tuple[pure.Terms, ...]
    claim: str
    route: str | None
    complex_solutions: int | None
    distinct_solutions: int
    real_solutions: int
    representation: pure.Representation | None
    groups: tuple[tuple[int, ...], ...] | None
    infinity: Infinity | None
    elimination: tuple[pure.Step, ...] | None
    cells: Cells | None
    witness: Witness | None
    box_exponent: int
    solutions: tuple[Solution, ...]


def some_names(value: Any, where: str) -> tuple[str, ...]:
    """The names of the variables."""
    names: tuple[str, ...] = tuple(pure.a_list(pure.a_text)(value, where))
    pure.well_formed(names, f"{where}: none")
    pure.affordable(len(names) <= MAX_VARIABLES, f"{where}: more than {MAX_VARIABLES}")
    pure.well_formed(all(map(NAME.fullmatch, names)) and len(set(names)) == len(names), f"{where}: not different names")
    return names


def a_term(places: Mapping[str, int], value: Any, where: str) -> tuple[pure.Monomial, int]:
    """A monomial and its coefficient, in the one spelling."""
    text = pure.a_text(value, where)
    coefficient, exponents, last = 1, [0] * len(places), -1
    negative = re.match(r"-[A-Za-z_]", text) is not None
    words = text[negative:].split("*")
    for number, word in enumerate(words):
        match = FACTOR.fullmatch(word)
        if match is None:
            raise pure.Refusal("malformed", f"{where}: not a coefficient and powers of variables")
        digits, name, power = match.groups()
        if digits:
            pure.well_formed(number == 0, f"{where}: a coefficient after a variable")
            pure.affordable(len(digits.removeprefix("-")) <= MAX_DIGITS, f"{where}: more than {MAX_DIGITS} digits")
            coefficient = int(digits)
            trivial = len(words) > 1 and coefficient in (1, -1)
            pure.well_formed(not trivial, f"{where}: a coefficient 1 before variables")
            continue
        place = places.get(name, -1)
        pure.well_formed(place > last, f"{where}: not the variables, once each, in their order")
        pure.well_formed(power != "1", f"{where}: a power 1")
        exponents[place], last = int(power or 1), place
    degree = sum(exponents)
    pure.affordable(degree <= MAX_POLYNOMIAL_DEGREE, f"{where}: degree above {MAX_POLYNOMIAL_DEGREE}")
    return tuple(exponents), -coefficient if negative else coefficient


def a_system(names: Sequence[str], value: Any, where: str) -> tuple[pure.Terms, ...]:
    """The polynomials, terms decreasing."""
    places = {name: place for place, name in enumerate(names)}
    few = not isinstance(value, list) or len(value) <= MAX_POLYNOMIALS
    pure.affordable(few, f"{where}: more than {MAX_POLYNOMIALS}")
    lists = pure.a_list(pure.a_list(partial(a_term, places)))(value, where)
    pure.well_formed(lists, f"{where}: none")
    pure.affordable(sum(map(len, lists)) <= MAX_TERMS, f"{where}: more than {MAX_TERMS} terms")
    for number, terms in enumerate(lists):
        keys = [pure.order(monomial) for monomial, _ in terms]
        falling = bool(keys) and all(a > b for a, b in pairwise(keys))
        pure.well_formed(falling, f"{where}[{number}]: no terms, or not in decreasing order")
    return tuple(map(dict, lists))


def a_representation(number: int, value: Any, where: str) -> pure.Representation:
    """A rational univariate representation of points with so many coordinates."""
    c, h, numerators = pure.an_object(value, where, "separating_form eliminant numerators")
    return some_points(number, [0] * number, c, h, numerators, where, "numerators")


def some_points(number: int, w: Any, c: Any, h: Any, values: Any, where: str, name: str) -> pure.Representation:
    """The entries that representations of finite points and of those at infinity have in common."""
    eliminant = pure.a_polynomial(h, f"{where}.eliminant")
    pure.well_formed(len(eliminant) > 1, f"{where}.eliminant: constant")
    integers = pure.a_list(pure.an_integer, number)
    return pure.Representation(
        w=tuple(integers(w, f"{where}.chart")),
        c=tuple(integers(c, f"{where}.separating_form")),
        h=eliminant,
        numerators=tuple(pure.a_list(pure.a_polynomial, number)(values, f"{where}.{name}")),
    )


def an_infinity(number: int, value: Any, where: str) -> Infinity:
    """The points at infinity."""
    w, c, h, z, times = pure.an_object(value, where, "chart separating_form eliminant coordinates multiplicity")
    points = some_points(number, w, c, h, z, where, "coordinates")
    return Infinity(points, pure.a_number(times, f"{where}.multiplicity"))


def some_groups(number: int, value: Any, where: str) -> tuple[tuple[int, ...], ...]:
    """Groups of variables: each in one of them."""
    groups = tuple(map(tuple, pure.a_list(pure.a_list(pure.a_number))(value, where)))
    members = [place for group in groups for place in group]
    fits = len(groups) >= 2 and all(groups) and sorted(members) == list(range(number))
    falls = fits and all(list(group) == sorted(group) for group in groups) and sorted(groups) == list(groups)
    pure.well_formed(falls, f"{where}: not at least two groups, in order, with every variable in one of them")
    return groups


def a_product(value: Any, where: str) -> tuple[int, ...]:
    """The index of an element, then those of unknowns."""
    text = pure.a_text(value, where)
    fits = PRODUCT.fullmatch(text)
    pure.well_formed(fits, f"{where}: not the index of an element and those of the unknowns that multiply it")
    index, *factors = map(int, text.split(" "))
    pure.well_formed(factors == sorted(factors), f"{where}: the unknowns are not in increasing order")
    return index, *factors


def a_step(value: Any, where: str) -> pure.Step:
    """The products of a step of an elimination."""
    few = not isinstance(value, list) or len(value) <= pure.MAX_PRODUCTS
    pure.affordable(few, f"{where}: more than {pure.MAX_PRODUCTS} products")
    return pure.a_list(a_product)(value, where)  # type: ignore[no-any-return]


def a_slice(number: int, value: Any, where: str) -> tuple[Fraction, pure.Representation]:
    """The constant of the last form, and the solutions."""
    constant, representation = pure.an_object(value, where, "constant representation")
    found = pure.a_rational(constant, f"{where}.constant")
    return found, a_representation(number, representation, f"{where}.representation")


def some_integers(value: Any, where: str) -> tuple[int, ...]:
    """Integers in one text."""
    text = pure.a_text(value, where)
    pure.well_formed(NUMBERS.fullmatch(text), f"{where}: not integers with spaces between them")
    return tuple(map(int, text.split(" ")))


def an_obstruction(value: Any, where: str) -> dict[tuple[int, int], int]:
    """The weight of each point of an obstruction, which is a support and a number in it."""
    integers = some_integers(value, where)
    triples = [integers[start : start + 3] for start in range(0, len(integers), 3)]
    whole = len(integers) % 3 == 0 and all(i >= 0 and k >= 0 and weight != 0 for i, k, weight in triples)
    rising = whole and all(one[:2] < other[:2] for one, other in pairwise(triples))
    pure.well_formed(rising, f"{where}: not points, each after the one before, with weights")
    return {(i, k): weight for i, k, weight in triples}


def some_cells(number: int, value: Any, where: str) -> Cells:
    """What bounds a mixed volume."""
    lifting, obstructions = pure.an_object(value, where, "lifting obstructions")
    return Cells(
        pure.a_list(some_integers, number)(lifting, f"{where}.lifting"),
        pure.a_list(an_obstruction)(obstructions, f"{where}.obstructions"),
    )


def a_witness(number: int, value: Any, where: str) -> Witness:
    """What proves a positive dimension."""
    cause, forms, slices = pure.an_object(value, where, "cause forms slices")
    cause = pure.one_of(CAUSES)(cause, f"{where}.cause")
    few = not isinstance(forms, list) or len(forms) <= MAX_FORMS
    pure.affordable(few, f"{where}.forms: more than {MAX_FORMS}")
    rows = tuple(map(tuple, pure.a_list(pure.a_list(pure.an_integer, number + 1))(forms, f"{where}.forms")))
    listed = tuple(pure.a_list(partial(a_slice, number))(slices, f"{where}.slices"))
    return Witness(cause, rows, listed)


def a_solution(number: int, value: Any, where: str) -> Solution:
    """A real solution as listed."""
    parameter, values, multiplicity = pure.an_object(value, where, "parameter values multiplicity")
    return Solution(
        tuple(pure.an_interval(parameter, f"{where}.parameter")),
        tuple(map(tuple, pure.a_list(pure.an_interval, number)(values, f"{where}.values"))),
        pure.nullable(pure.a_number)(multiplicity, f"{where}.multiplicity"),
    )


def read(body: dict[str, Any]) -> Certificate:
    """The content of a certificate."""
    version = body.get("version")
    pure.well_formed(type(version) is int and version == 1, "format: not a system certificate, version 1")
    keys = KEYS_WITH_CELLS if "subdivision" in body else KEYS
    values = dict(zip(keys.split(), pure.an_object(body, "certificate", keys), strict=True))

    def entry(key: str, read: pure.Reader) -> Any:
        return read(values[key], key)

    entry("title", pure.a_text)
    entry("notes", pure.a_list(pure.a_text))
    names = entry("variables", some_names)
    number = len(names)
    exponent = entry("box_exponent", pure.a_number)
    pure.affordable(exponent <= pure.MAX_BOX_EXPONENT, f"box_exponent: more than {pure.MAX_BOX_EXPONENT}")
    return Certificate(
        number=number,
        polynomials=entry("polynomials", partial(a_system, names)),
        claim=entry("claim", pure.one_of(pure.CLAIMS)),
        route=entry("completeness_route", pure.nullable(pure.one_of(ROUTES))),
        complex_solutions=entry("complex_solutions", pure.nullable(pure.a_number)),
        distinct_solutions=entry("distinct_solutions", pure.a_number),
        real_solutions=entry("real_solutions", pure.a_number),
        representation=entry("representation", pure.nullable(partial(a_representation, number))),
        groups=entry("groups", pure.nullable(partial(some_groups, number))),
        infinity=entry("infinity", pure.nullable(partial(an_infinity, number))),
        elimination=entry("elimination", pure.nullable(pure.a_list(a_step))),
        cells=entry("subdivision", partial(some_cells, number)) if keys is KEYS_WITH_CELLS else None,
        witness=entry("witness", pure.nullable(partial(a_witness, number))),
        box_exponent=exponent,
        solutions=entry("solutions", pure.a_list(partial(a_solution, number))),
    )


# ---------------------------------------------------------------------------------------------------------------------
# Notation: homogeneous polynomials and their values at points
# ---------------------------------------------------------------------------------------------------------------------


def degree_of(terms: Mapping[pure.Monomial, int]) -> int:
    """The greatest degree of a term."""
    return max(map(sum, terms))


def homogeneous(terms: Mapping[pure.Monomial, int]) -> Forms:
    """F^h."""
    degree = degree_of(terms)
    return {(degree - sum(monomial), *monomial): value for monomial, value in terms.items()}


def top_form(terms: Mapping[pure.Monomial, int]) -> pure.Terms:
    """The terms of greatest degree."""
    degree = degree_of(terms)
    return {monomial: value for monomial, value in terms.items() if sum(monomial) == degree}


def slope_by(form: Forms, place: int) -> Forms:
    """The derivative by a variable."""
    found = {}
    for monomial, value in form.items():
        if monomial[place]:
            found[(*monomial[:place], monomial[place] - 1, *monomial[place + 1 :])] = value * monomial[place]
    return found


class Values:
    """Values of homogeneous polynomials at one point in any ring; a product of variables is formed once."""

    def __init__(self, coordinates: Sequence[Any], cost: Callable[[Any, Any], int] | None = None) -> None:
        self.coordinates = coordinates
        self.cost = cost
        self.known: dict[pure.Monomial, Any] = {}

    def monomial(self, monomial: pure.Monomial) -> Any:
        """The product of powers of coordinates, the degree being 1 at least."""
        if monomial not in self.known:
            place = next(place for place, exponent in enumerate(monomial) if exponent)
            rest = (*monomial[:place], monomial[place] - 1, *monomial[place + 1 :])
            value = self.coordinates[place]
            if any(rest):
                other = self.monomial(rest)
                if self.cost is not None:
                    pure.spend(self.cost(value, other))
                value = value * other
            self.known[monomial] = value
        return self.known[monomial]

    def value(self, form: Forms) -> Any:
        """The value of a polynomial; None for 0, and the number itself if the degree is 0.

        Terms with the same power of x_0 are summed before they are multiplied by it.
        """
        parts: dict[int, Any] = {}
        for (power, *others), value in form.items():
            part = self.times(value, self.monomial((0, *others))) if any(others) else value
            parts[power] = parts[power] + part if power in parts else part
        total: Any = None
        for power, part in parts.items():
            if power:
                part = self.times(part, self.monomial((power, *(0 for _ in self.coordinates[1:]))))
            total = part if total is None else total + part
        return total

    def times(self, a: Any, b: Any) -> Any:
        """The product."""
        if self.cost is not None:
            pure.spend(self.cost(a, b))
        return a * b


def product_of_integers(a: int, b: int) -> int:
    """What a product costs."""
    return pure.product_cost(a.bit_length(), b.bit_length())


def size_at(form: Forms, sizes: Sequence[int]) -> int:
    """A bound for the size of the value, from those of the coordinates."""
    return sum(abs(value) * prod(s**e for s, e in zip(sizes, m, strict=True) if e) for m, value in form.items())


class Points:
    """The points of a representation: numerators of homogeneous coordinates."""

    def __init__(self, representation: pure.Representation, first: Polynomial) -> None:
        self.representation = representation
        self.h0 = pure.primitive_part(representation.h)
        self.coordinates = [first, *representation.numerators]
        self.sizes = [max(pure.size(each), 1) for each in self.coordinates]

    def at_power(self, k: int) -> Values:
        """Values at T = 2^k."""
        return Values([pure.at_power(each, k) for each in self.coordinates], product_of_integers)

    def modulo(self, g: Polynomial, m: int) -> tuple[pure.Residues, Values]:
        """Values modulo m and a polynomial."""
        ring = pure.Residues(g, m)
        return ring, Values([ring.element(each) for each in self.coordinates])

    def vanish(self, polynomials: Sequence[pure.Terms]) -> list[bool]:
        """Whether each polynomial is 0 at all points, the homogeneous coordinate being 1, or 0 and in no term."""
        products = Products(self, polynomials)
        parts = [(place, part) for place, each in enumerate(polynomials) for part in products.parts(each)]
        holds = products.divisible([part for _, part in parts])
        wrong = {place for (place, _), answer in zip(parts, holds, strict=True) if not answer}
        return [bool(degree_of(each)) and place not in wrong for place, each in enumerate(polynomials)]


Halves: TypeAlias = tuple[pure.Monomial, pure.Monomial]
Sums: TypeAlias = dict[tuple[Halves, int], int]
"""A sum of products of two numerators and a power of S: the factor of each."""

SPARE: Final = 32
"""Bits by which a quotient may be longer than is usual before a bound for all quotients is asked for."""


class Products:
    """Numerators of products of coordinates, each proved from those of two shorter ones.

    h0 is a polynomial in S = T^m, and h' = T^(m - 1) n_0, N_i = T^r n_i with 0 <= r < m and n_i in S, for the greatest
    such m. So x_i = T^-o n_i / n_0, o = m - 1 - r, and a product x^a is T^-o n_a / n_0 with 0 <= o < m and n_a over Q
    of a degree below that of h0 in S. As x^a = x^b x^c, n_b n_c - n_a n_0 S^e is a multiple of h0, where e = 1 if the
    o of b and c sum to m or more, otherwise 0. A polynomial is 0 at all roots T of S if and only if its terms with the
    same o sum to 0. So all there is to divide are sums of products of two. Each n_a is proposed by what it is modulo a
    number, its coefficients being hardly longer than those of the coordinates as a rule, and proved by this equation.
    """

    def __init__(self, points: Points, polynomials: Sequence[pure.Terms]) -> None:
        slope, numerators = pure.derivative(points.representation.h), points.representation.numerators
        pure.spend(300 * sum(map(len, (points.h0, slope, *numerators))))
        exponents = [[power for power, value in enumerate(each) if value] for each in (points.h0, slope, *numerators)]
        self.m = m = gcd(*exponents[0], *(power - each[0] for each in exponents[1:] for power in each))
        starts = [each[0] % m if each else 0 for each in exponents[1:]]
        self.lacks = [m - 1 - start for start in starts[1:]]
        self.h0, self.h = points.h0[::m], points.representation.h[::m]
        self.one = (0,) * len(numerators)
        units = [tuple(int(i == k) for i in range(len(numerators))) for k in range(len(numerators))]
        parts = [each[start::m] for start, each in zip(starts, (slope, *numerators), strict=True)]
        self.known = {key: (1, part) for key, part in zip((self.one, *units), parts, strict=True)}
        self.halves = halved(polynomials)
        self.wanted = sorted({part for pair in self.halves.values() for part in pair if sum(part) > 1}, key=sum)

    def lack(self, monomial: pure.Monomial) -> int:
        """o."""
        return sum(lack * exponent for lack, exponent in zip(self.lacks, monomial, strict=True)) % self.m

    def carry(self, pair: Halves) -> int:
        """e."""
        return int(sum(map(self.lack, pair)) >= self.m)

    def parts(self, polynomial: pure.Terms) -> list[pure.Terms]:
        """The terms with each o."""
        found: dict[int, dict[pure.Monomial, int]] = {}
        for monomial, value in polynomial.items():
            found.setdefault(self.lack(monomial), {})[monomial] = value
        return list(found.values())

    def divisible(self, parts: Sequence[pure.Terms]) -> list[bool]:
        """Whether each of the sums is 0 at all points."""
        bits = pure.most_bits(value for _, numerator in self.known.values() for value in numerator)
        bits += bits // 16 + 64
        while True:
            if self.propose(bits):
                sums = [self.defining(monomial) for monomial in self.wanted] + list(map(self.sums, parts))
                for spare in (SPARE, None):
                    answers = self.include(sums, spare)
                    if all(answers):
                        break
                if all(answers[: len(self.wanted)]):
                    return answers[len(self.wanted) :]
            bits *= 2

    def defining(self, monomial: pure.Monomial) -> Sums:
        """a_b a_c (a_a n_b n_c - n_a n_0 S^e), which proves the numerator of a product."""
        pair = self.halves[monomial]
        scales = [self.known[each][0] for each in (monomial, *pair)]
        return {(pair, 0): scales[0], ((self.one, monomial), self.carry(pair)): -scales[1] * scales[2]}

    def sums(self, part: pure.Terms) -> Sums:
        """The products for a part, with S^(1 - e) if m > 1: then 0 is no root of h0, which has no multiple ones."""
        pairs = {monomial: self.halves.get(monomial, (self.one, monomial)) for monomial in part}
        scales = {monomial: prod(self.known[each][0] for each in pair) for monomial, pair in pairs.items()}
        bits = pure.most_bits(scales.values()) * len(part)
        pure.spend(len(part) * (1000 + pure.division_cost(bits, bits)))
        scale = lcm(*scales.values())
        return {
            (pairs[m], int(self.m > 1) - self.carry(pairs[m])): value * (scale // scales[m])
            for m, value in part.items()
        }

    def include(self, sums: Sequence[Sums], spare: int | None) -> list[bool]:
        """Whether h0 divides each sum: False is certain if ``spare`` is None."""
        sizes = {key: max(pure.size(numerator), 1) for key, (_, numerator) in self.known.items()}
        bounds = [sum(abs(value) * sizes[b] * sizes[c] for ((b, c), _), value in each.items()) for each in sums]
        multiples = pure.Multiples(self.h0, max(bounds), spare=spare)
        at: dict[pure.Monomial, int] = {}
        products: dict[Halves, int] = {}

        def product(pair: Halves) -> int:
            if pair not in products:
                for key in pair:
                    if key not in at:
                        at[key] = pure.at_power(self.known[key][1], multiples.k)
                pure.spend(product_of_integers(at[pair[0]], at[pair[1]]))
                products[pair] = at[pair[0]] * at[pair[1]]
            return products[pair]

        answers = []
        for each in sums:
            total = 0
            for (pair, power), value in each.items():
                pure.spend(product_of_integers(value, product(pair)))
                total += value * product(pair) << power * multiples.k
            answers.append(multiples.include(total))
        return answers

    def propose(self, bits: int) -> bool:
        """Numerators for all products that are wanted, if their coefficients are not longer; nothing is proved of them.

        They are what they are modulo a power of a prime and h0, there divided by n_0 and S^e.
        """
        if not self.wanted:
            return True
        ring, inverses = self.inverted(bits + bits // 16 + 32)
        values = {key: pure.reduced(numerator, ring.m) for key, (_, numerator) in self.known.items() if sum(key) < 2}
        quotients: dict[tuple[pure.Monomial, int], Polynomial] = {}
        for monomial in self.wanted:
            one, other = pair = self.halves[monomial]
            key = other, self.carry(pair)
            if key not in quotients:
                quotients[key] = ring.product(values[other], inverses[key[1]])
            values[monomial] = ring.product(values[one], quotients[key])
            lifted = lifted_values([values[monomial]], ring.m, ring.m >> bits // 16 + 16)
            if lifted is None:
                return False
            self.known[monomial] = lifted[0], lifted[1][0]
        return True

    def inverted(self, bits: int) -> tuple[LongResidues, list[Polynomial]]:
        """Residues modulo a number of so many bits or more, and among them 1 / n_0 and, if m > 1, 1 / (n_0 S)."""
        slope = self.known[self.one][1]
        for p in pure.good_primes(self.h):  # h may have a content that is 0 modulo those for h0
            ring = LongResidues(self.h0, p)
            divisor = ring.product(pure.reduced(slope, p), [0, 1]) if self.m > 1 else pure.reduced(slope, p)
            try:
                inverse = pure.inverse_modulo(divisor, pure.reduced(self.h0, p), p)
            except ValueError:
                continue
            power, most = 1, -(-bits // (p.bit_length() - 1))
            while power < most:  # Newton's iteration
                power = min(2 * power, most)
                ring = LongResidues(self.h0, p**power)
                divisor = pure.reduced(slope, ring.m)
                divisor = ring.product(divisor, [0, 1]) if self.m > 1 else divisor
                inverse = ring.product(inverse, less_two(ring.product(inverse, divisor), ring.m))
            return ring, [ring.product(inverse, [0, 1]), inverse] if self.m > 1 else [inverse]
        raise pure.Refusal("too-large", "polynomials: no prime at which the points are distinct was found")


class LongResidues:
    """Products in (Z / m)[S] / (g) by three of integers: quotients are found by the reciprocal of g, once for all."""

    def __init__(self, g: Polynomial, m: int) -> None:
        self.m = m
        pure.spend(len(g) * (500 + pure.product_cost(m.bit_length(), m.bit_length())) + m.bit_length() ** 2 // 8)
        inverse = pow(g[-1], -1, m)
        self.g = [coefficient * inverse % m for coefficient in g]
        reverse, self.reciprocal, known = self.g[::-1], [1], 1
        while known < len(g):  # Newton's iteration, terms of a power series
            known *= 2
            rest = less_two(pure.product(reverse[:known], self.reciprocal, m)[:known], m)
            self.reciprocal = pure.product(self.reciprocal, rest, m)[:known]

    def product(self, a: Polynomial, b: Polynomial) -> Polynomial:
        """The product."""
        degree = len(self.g) - 1
        whole = pure.product(a, b, self.m)
        length = max(len(whole) - degree, 0)
        if not length:
            return whole
        quotient = pure.product(whole[degree:][::-1], self.reciprocal[:length], self.m)[:length]
        multiple = pure.product(pure.padded(quotient, length)[::-1], self.g, self.m)
        return pure.reduced((x - y for x, y in zip(whole[:degree], multiple, strict=False)), self.m)


def less_two(polynomial: Polynomial, m: int) -> Polynomial:
    """2 less a polynomial, modulo m."""
    return pure.reduced([2 - polynomial[0], *(-value for value in polynomial[1:])], m)


def halved(polynomials: Sequence[pure.Terms]) -> dict[pure.Monomial, Halves]:
    """Each monomial of degree 2 or more as a product of two, and so on: those that can be parts of many others."""
    found: dict[pure.Monomial, Halves] = {}
    pending = [monomial for polynomial in polynomials for monomial in polynomial]
    often = Counter(part for monomial in pending for pair in runs(monomial) for part in pair)
    while pending:
        monomial = pending.pop()
        if sum(monomial) > 1 and monomial not in found:
            found[monomial] = min(runs(monomial), key=lambda pair: (-often[pair[0]] - often[pair[1]], pair))
            pending += found[monomial]
    return found


def runs(monomial: pure.Monomial) -> list[Halves]:
    """Half of the factors, one after another in a circle, and the others."""
    factors = [place for place, exponent in enumerate(monomial) for _ in range(exponent)]
    half = len(factors) // 2
    pure.spend(len(factors) * (2000 + 200 * len(monomial)))
    found = []
    for start in range(len(factors)):
        some = [0] * len(monomial)
        for place in (factors + factors)[start : start + half]:
            some[place] += 1
        found.append((tuple(some), tuple(e - part for e, part in zip(monomial, some, strict=True))))
    return found


def finite_points(representation: pure.Representation) -> Points:
    """(h' : N)."""
    return Points(representation, pure.derivative(representation.h))


# ---------------------------------------------------------------------------------------------------------------------
# Checks 1 to 3: the roots of the eliminant are distinct solutions
# ---------------------------------------------------------------------------------------------------------------------


def check_representation(representation: pure.Representation, where: str = "") -> Iterator[str]:
    """Checks 1 and 2."""
    h, numerators = representation.h, representation.numerators
    degree = len(h) - 1
    pure.require(degree <= MAX_NUMBER, f"{where}eliminant: degree {degree} is above {MAX_NUMBER}")
    numbers = [*h, *(coefficient for numerator in numerators for coefficient in numerator)]
    pure.spend(2 * len(numbers) * pure.division_cost(pure.most_bits(numbers), pure.most_bits(h)))
    lowest = h[-1] > 0 and gcd(*numbers) == 1
    pure.require(lowest, f"{where}eliminant: not in lowest terms with positive leading coefficient")
    h0 = pure.primitive_part(h)
    squarefree = any(pure.is_coprime(h0, pure.derivative(h0), p) for p in pure.good_primes(h0))
    pure.require(squarefree, f"{where}eliminant: not proved squarefree")
    small = all(len(numerator) <= degree for numerator in numerators)
    pure.require(small, f"{where}representation: a numerator has not a smaller degree than the eliminant")
    yield f"{where}eliminant: squarefree of degree {degree}"
    expected = [(power - degree) * coefficient for power, coefficient in enumerate(h[:-1])]  # T h' - D h
    takes = combined(representation.c, numerators, degree) == expected
    pure.require(takes, f"{where}separating form: its values are not the roots of the eliminant")
    yield f"{where}separating form: takes {degree} different values, the solutions are distinct"


def combined(scalars: Sequence[int], numerators: Sequence[Polynomial], length: int) -> list[int]:
    """The combination of polynomials, so many coefficients."""
    total = [0] * length
    for scalar, numerator in zip(scalars, numerators, strict=True):
        pure.spend(len(numerator) * (200 + pure.product_cost(scalar.bit_length(), pure.most_bits(numerator))))
        for power, coefficient in enumerate(numerator if scalar else ()):
            total[power] += scalar * coefficient
    return total


def check_solutions(representation: pure.Representation, polynomials: Sequence[pure.Terms], where: str = "") -> str:
    """Check 3."""
    points = finite_points(representation)
    for number, holds in enumerate(points.vanish(polynomials), 1):
        pure.require(holds, f"{where}polynomials: number {number} is not 0 at every root of the eliminant")
    return f"{where}polynomials: all {len(polynomials)} are 0 at every root of the eliminant"


def checked(representation: pure.Representation, polynomials: Sequence[pure.Terms], where: str = "") -> Iterator[str]:
    """Checks 1 to 3."""
    yield from check_representation(representation, where)
    yield check_solutions(representation, polynomials, where)


# ---------------------------------------------------------------------------------------------------------------------
# Check 4: real solutions
# ---------------------------------------------------------------------------------------------------------------------


def check_real(certificate: Certificate, representation: pure.Representation) -> Iterator[str]:
    """Check 4."""
    h0 = pure.primitive_part(representation.h)
    roots = pure.isolated(h0)
    listed, exponent = certificate.solutions, certificate.box_exponent
    same = len(listed) == len(roots)
    pure.require(same, f"real solutions: {len(listed)} listed, the eliminant has {len(roots)} real roots")
    boxes = [pure.cells_of(partial(coordinates_at, representation, h0, root), exponent) for root in roots]
    order = sorted(range(len(roots)), key=boxes.__getitem__)
    bits = pure.most_bits(end for cells in boxes for pair in cells for end in pair)
    pure.affordable(bits <= pure.MAX_CELL_BITS, f"boxes: a coordinate of more than {pure.MAX_CELL_BITS} bits")
    pure.spend(len(roots) * certificate.number * (8 * (5000 + pure.division_cost(bits, bits)) + 1000 * len(roots)))
    for number, (solution, place) in enumerate(zip(listed, order, strict=True), 1):
        root = roots[place]
        same = solution.parameter == pure.ends(root.m, root.m + (not root.exact), root.k)
        line = f"real solutions: solution {number} does not have the isolating interval of real root {place + 1}"
        pure.require(same, line)
        same = solution.values == tuple(pure.ends(low, high, exponent) for low, high in boxes[place])
        pure.require(same, f"boxes: the box of solution {number} is not that of its root")
    yield f"real solutions: {len(roots)}, one for each real root of the eliminant"
    yield f"boxes: all {certificate.number * len(roots)} intervals are those of the values, on the grid 2^-{exponent}"
    for (i, one), (j, other) in combinations(enumerate((boxes[place] for place in order), 1), 2):
        apart = any(a[1] < b[0] or b[1] < a[0] for a, b in zip(one, other, strict=True))
        pure.require(apart, f"boxes: those of solutions {i} and {j} are not disjoint")
    yield "boxes: pairwise disjoint"


def coordinates_at(
    representation: pure.Representation, h0: Polynomial, root: pure.Root, p: int
) -> list[pure.Interval] | None:
    """Enclosures of N_i(t) / h'(t); None if the precision does not suffice."""
    finer = pure.refined(h0, root, max(p, root.k))
    slope, *values = pure.enclosed([pure.derivative(representation.h), *representation.numerators], finer, p)
    return None if slope.contains_zero() else [value.over(slope) for value in values]


# ---------------------------------------------------------------------------------------------------------------------
# Check 5: ranks of matrices of derivatives, and weights
# ---------------------------------------------------------------------------------------------------------------------


class Part(NamedTuple):
    """A factor of h0, modulo a prime or over Z, at whose roots a matrix has this rank.

    ``kernel`` has, for each column that has no pivot, the column and the entries at the pivots, modulo the prime.
    """

    factor: Polynomial
    rank: int
    pivots: tuple[int, ...]
    kernel: tuple[tuple[int, tuple[Polynomial, ...]], ...]


class Slopes:
    """The matrix of the derivatives of forms by some of the variables, at points."""

    def __init__(self, points: Points, forms: Sequence[Forms], columns: Sequence[int]) -> None:
        self.points = points
        self.entries = [[slope_by(form, place) for place in columns] for form in forms]
        self.width = len(columns)

    def modulo(self, g: Polynomial, p: int) -> tuple[pure.Residues, list[list[pure.Residue]]]:
        """The matrix modulo a prime and a polynomial."""
        ring, values = self.points.modulo(g, p)

        def entry(form: Forms) -> pure.Residue:
            value = values.value(form)
            return value if isinstance(value, pure.Residue) else ring.element([value] if value else [])

        return ring, [[entry(form) for form in row] for row in self.entries]


def ranks_modulo(slopes: Slopes, g: Polynomial, p: int) -> list[Part]:
    """Factors of g, squarefree modulo p, at the roots of which the rank is the same: by Gauss and Jordan.

    Where a pivot is neither 0 nor a unit, g falls into two factors, and each is done anew (Della Dora, Dicrescenzo and
    Duval 1985).
    """
    pending, parts = [g], []
    while pending:
        factor = pending.pop()
        ring, rows = slopes.modulo(factor, p)
        pivots: list[int] = []
        split: Polynomial | None = None
        for column in range(slopes.width):
            start = len(pivots)
            row = next((i for i in range(start, len(rows)) if any(rows[i][column].value)), None)
            if row is None:
                continue
            entry = rows[row][column].polynomial()
            try:
                inverse = pure.inverse_modulo(entry, ring.g, p)
            except ValueError:
                split = pure.common_divisor(ring.g, entry, p)
                break
            rows[start], rows[row] = rows[row], rows[start]
            scale = ring.element(inverse)
            rows[start] = [scale * each if any(each.value) else each for each in rows[start]]
            clear_column(rows, start, column)
            pivots.append(column)
        if split is not None:
            pending += [split, pure.divided(ring.g, split, p)[0]]
            continue
        free = [column for column in range(slopes.width) if column not in pivots]
        kernel = tuple((c, tuple(rows[i][c].polynomial() for i in range(len(pivots)))) for c in free)
        parts.append(Part(ring.g, len(pivots), tuple(pivots), kernel))
    return parts


def clear_column(rows: list[list[pure.Residue]], pivot: int, column: int) -> None:
    """Subtract multiples of the row of the pivot, which is 1, from the others."""
    for number, row in enumerate(rows):
        factor = row[column]
        if number != pivot and any(factor.value):
            rows[number] = [
                each - factor * other if any(other.value) else each
                for each, other in zip(row, rows[pivot], strict=True)
            ]


def ranks(slopes: Slopes, greatest: int) -> list[Part]:
    """Factors of h0 over Z with the ranks at their roots, those below ``greatest`` proved to be no greater.

    The rank is at least that modulo a prime that does not divide the leading coefficient. It is at most that if there
    are so many vectors in the kernel: those modulo a large prime, lifted to rational numbers and multiplied by the
    derivative of the factor, which keeps them short, are put into the equations.
    """
    h0 = slopes.points.h0
    for p in pure.good_primes(h0):
        if all(part.rank == greatest for part in ranks_modulo(slopes, h0, p)):
            return [Part(h0, greatest, (), ())]
    for n in pure.MERSENNE:
        p = (1 << n) - 1
        if h0[-1] % p and pure.is_coprime(h0, pure.derivative(h0), p):
            parts = ranks_modulo(slopes, h0, p)
            lifted = [lifted_part(slopes, part, p) for part in parts if part.rank < greatest]
            found = [part for part in lifted if part is not None]
            if len(found) == len(lifted):
                rest = sum(len(part.factor) - 1 for part in found) < len(h0) - 1
                return [*found, *[Part(h0, greatest, (), ())] * rest]
    raise pure.Refusal("too-large", "regular: the ranks at the solutions are not decided")


def lifted_part(slopes: Slopes, part: Part, p: int) -> Part | None:
    """The factor over Z, if it is one and the rank at its roots is proved; otherwise None."""
    h0 = slopes.points.h0
    a = h0 if len(part.factor) == len(h0) else pure.lifted_factor(part.factor, p)
    if not pure.is_factor(a, h0):
        return None
    ring = pure.Residues(part.factor, p)
    slope = ring.element(pure.derivative(a))
    vectors = []
    for column, entries in part.kernel:
        values = [(slope * ring.element(entry)).polynomial() for entry in entries]
        lifted = lifted_values(values, p, isqrt(p) >> 8)
        if lifted is None:
            return None
        denominator, numerators = lifted
        vector: list[Polynomial] = [[] for _ in range(slopes.width)]
        vector[column] = [denominator * value for value in pure.derivative(a)]
        for place, numerator in zip(part.pivots, numerators, strict=True):
            vector[place] = [-value for value in numerator]
        vectors.append(vector)
    return Part(a, part.rank, part.pivots, ()) if are_orthogonal(slopes, a, vectors) else None


def lifted_values(values: Sequence[Polynomial], p: int, bound: int) -> tuple[int, list[Polynomial]] | None:
    """A denominator and integer polynomials whose quotients are the given ones modulo p; None if they are not short.

    Numerators are up to a bound, and the denominator times this is less than p by 16 bits.
    """
    lead = 1
    for value in (coefficient for each in values for coefficient in each):
        rest = value * lead % p
        if bound < rest < p - bound:
            lead *= pure.least_denominator(rest, p, bound)
        if lead * bound > p >> 16:
            return None
    found = [[rest - p if 2 * (rest := value * lead % p) > p else rest for value in each] for each in values]
    short = all(abs(value) <= bound for each in found for value in each)
    return (lead, found) if short else None


def are_orthogonal(slopes: Slopes, a: Polynomial, vectors: Sequence[Sequence[Polynomial]]) -> bool:
    """Whether all rows of the matrix are orthogonal to vectors at the roots of a, over Q."""
    points = slopes.points
    for row in slopes.entries:
        degree = max((sum(next(iter(form))) for form in row if form), default=0)
        sizes = [size_at(form, points.sizes) for form in row]
        bound = max(sum(s * max(pure.size(v), 1) for s, v in zip(sizes, vector, strict=True)) for vector in vectors)
        total = degree * (len(points.h0) - 1) + len(a)
        multiples = pure.Multiples(a, max(bound, 1), -(-total // (len(a) - 1)) + 1)
        values = points.at_power(multiples.k)
        entries = [values.value(form) or 0 for form in row]
        for vector in vectors:
            at = [pure.at_power(each, multiples.k) for each in vector]
            pure.spend(sum(product_of_integers(x, y) for x, y in zip(entries, at, strict=True)))
            if not multiples.include(sum(x * y for x, y in zip(entries, at, strict=True))):
                return False
    return True


class Weighed(NamedTuple):
    """Factors of h0 over Z with the weights of the points at their roots; the last may be h0, for all other roots."""

    parts: tuple[tuple[Polynomial, int], ...]
    total: int

    def regular(self) -> bool:
        """Whether all weights are 1."""
        return all(weight == 1 for _, weight in self.parts)


def weighed(slopes: Slopes, dimension: int) -> Weighed:
    """The weights: 1 if the rank is n, else 2^c with as many polynomials as variables, 1 + c with others."""
    found, left, total = [], len(slopes.points.h0) - 1, 0
    for part in ranks(slopes, dimension):
        lack = dimension - part.rank
        weight = 1 << lack if len(slopes.entries) == dimension else 1 + lack
        number = len(part.factor) - 1 if lack else left
        left -= number
        total += number * weight
        found.append((part.factor, weight))
    return Weighed(tuple(found), total)


def weights_of(weights: Weighed, h0: Polynomial) -> dict[pure.Ends, int]:
    """The weights of the real solutions, by their parameters."""
    found = {}
    for root in pure.isolated(h0):
        key = pure.ends(root.m, root.m + (not root.exact), root.k)
        found[key] = 1
        for factor, weight in weights.parts:
            if weight > 1 and pure.has_root(factor, root):
                found[key] = weight
    return found


# ---------------------------------------------------------------------------------------------------------------------
# Check 5: multiplicities, by functionals of growing order
# ---------------------------------------------------------------------------------------------------------------------

Sparse: TypeAlias = dict[int, Fraction]
"""A vector without its zeros."""


@dataclass(frozen=True)
class Number:
    """An element of Q[T] / (a), where a is squarefree: coefficients of 1, T, .., T^(d - 1)."""

    a: Polynomial
    value: tuple[Fraction, ...]

    def __add__(self, other: Number) -> Number:
        self.spend(other, len(self.value))
        return Number(self.a, tuple(x + y for x, y in zip(self.value, other.value, strict=True)))

    def __rmul__(self, scalar: int | Fraction) -> Number:
        pure.spend(len(self.value) * pure.fraction_cost(bits_of(scalar), self.bits()))
        return Number(self.a, tuple(scalar * x for x in self.value))

    def __mul__(self, other: Number) -> Number:
        """The product, by Horner's rule."""
        self.spend(other, 2 * len(self.value) ** 2)
        total = (Fraction(0),) * len(self.value)
        for factor in reversed(self.value):
            total = times_root(self.a, total)
            total = tuple(x + factor * y for x, y in zip(total, other.value, strict=True))
        return Number(self.a, total)

    def bits(self) -> int:
        """The size of the longest coefficient."""
        return max(map(bits_of, self.value))

    def spend(self, other: Number, operations: int) -> None:
        """Count operations with the coefficients of both, which grow by those of a."""
        bits = self.bits() + len(self.a) * pure.most_bits(self.a)
        pure.spend(operations * pure.fraction_cost(bits, other.bits()))


def bits_of(value: int | Fraction) -> int:
    """The size of a number."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def times_root(a: Polynomial, value: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """T times an element of Q[T] / (a)."""
    top = value[-1] / a[-1]
    return tuple(x - top * y for x, y in zip((Fraction(0), *value[:-1]), a[:-1], strict=True))


def number_in(a: Polynomial, polynomial: Polynomial) -> Number:
    """The class of an integer polynomial."""
    bits = pure.most_bits(polynomial) + len(polynomial) * pure.most_bits(a)
    pure.spend(len(polynomial) * len(a) * pure.fraction_cost(bits, pure.most_bits(a)))
    total = (Fraction(0),) * (len(a) - 1)
    for coefficient in reversed(polynomial):
        low, *rest = times_root(a, total)
        total = (low + coefficient, *rest)
    return Number(a, total)


class Expansion:
    """F^h(h', N + y) as a polynomial in y_1, .., y_n over Q[T] / (a), order by order; y_i is h' (x_i - z_i)."""

    def __init__(self, a: Polynomial, form: Forms, values: Values) -> None:
        self.form = form
        self.values = values
        self.one = number_in(a, [1])
        self.known: dict[pure.Monomial, Number] = {}

    def extend(self, order: int) -> None:
        """Find the coefficients of the products of so many y."""
        for (power, *others), value in self.form.items():
            for part, ways in divisors(others, order):
                rest = (power, *(e - c for e, c in zip(others, part, strict=True)))
                term = value * ways * (self.values.monomial(rest) if any(rest) else self.one)
                self.known[part] = self.known[part] + term if part in self.known else term


def divisors(exponents: Sequence[int], order: int) -> Iterator[tuple[pure.Monomial, int]]:
    """Products of so many variables that divide a monomial, with the number of ways to choose them from its factors."""
    pure.spend(3000)
    if not exponents:
        yield (), 1
        return
    first, *rest = exponents
    for c in range(max(order - sum(rest), 0), min(first, order) + 1):
        for part, ways in divisors(rest, order - c):
            yield (c, *part), ways * comb(first, c)


class Functionals:
    """D_k over Q: the first d of its basis are T^q times the value at z, for q < d; the others are 0 at 1.

    ``axes[i][b]`` has the coordinates of y_i times element b of the basis, ``root[b]`` those of T times it.
    """

    def __init__(self, a: Polynomial, number: int, tuples: Sequence[Sparse], smaller: Functionals | None) -> None:
        degree, self.a = len(a) - 1, a
        self.length = degree + len(tuples)
        units = [{q + 1: Fraction(1)} for q in range(degree - 1)]
        last = {q: Fraction(-c, a[-1]) for q, c in enumerate(a[:-1]) if c}
        self.axes: list[list[Sparse]] = [[{} for _ in range(degree)] for _ in range(number)]
        self.root: list[Sparse] = [*units, last]
        if smaller is not None:
            self.adopt(tuples, smaller)

    def adopt(self, tuples: Sequence[Sparse], smaller: Functionals) -> None:
        """Take in the functionals with these products with y_1, .., y_n, one after another, in the smaller space.

        Each has a 1 at a place of its own, its first; what is there are the coordinates of all.
        """
        degree, length = len(self.a) - 1, smaller.length
        place = {min(each): degree + number for number, each in enumerate(tuples)}
        inside: list[Sparse] = [{} for _ in range(length)]
        for b in range(length):
            if b < degree:
                inside[b][b] = Fraction(1)
            for axis, rows in enumerate(smaller.axes):
                for column, value in rows[b].items():
                    if axis * length + column in place:
                        inside[b][place[axis * length + column]] = value
        for each in tuples:
            parts: list[Sparse] = [{} for _ in self.axes]
            turned: Sparse = {}
            for column, value in each.items():
                axis, b = divmod(column, length)
                add_multiple(parts[axis], value, inside[b])
                if degree > 1:
                    moved = {axis * length + c: entry for c, entry in smaller.root[b].items()}
                    add_multiple(turned, value, {place[c]: entry for c, entry in moved.items() if c in place})
            for rows, part in zip(self.axes, parts, strict=True):
                rows.append(part)
            self.root.append(turned)

    def larger(self, expansions: Sequence[Expansion]) -> Functionals:
        """D_(k+1)."""
        number = len(self.axes)
        equations = [*self.commuting(), *(row for each in expansions for row in self.vanishing(each))]
        rows: list[pure.Terms] = [
            {(column,): value for column, value in zip(row, pure.cleared(list(row.values())), strict=True)}
            for row in equations
        ]
        reduced = pure.echelon_form(rows)  # the largest column first
        pivots = {next(iter(row))[0]: row for row in reduced}
        by_column: dict[int, Sparse] = {c: {c: Fraction(1)} for c in range(number * self.length) if c not in pivots}
        for pivot, row in pivots.items():
            pure.spend(5000 * len(row))
            for (column,), value in row.items():
                if column != pivot:
                    by_column[column][pivot] = Fraction(-value, row[(pivot,)])
        return Functionals(self.a, number, list(by_column.values()), self)

    def commuting(self) -> Iterator[Sparse]:
        """Equations for the products L_i of a functional with the y_i, one after another: y_j L_i = y_i L_j."""
        columns = [transposed(rows, self.length) for rows in self.axes]
        for i, j in combinations(range(len(columns)), 2):
            for left, right in zip(columns[j], columns[i], strict=True):
                pure.spend(1000 * (len(left) + len(right)))
                row = {i * self.length + b: value for b, value in left.items()}
                row |= {j * self.length + b: -value for b, value in right.items()}
                if row:
                    yield row

    def vanishing(self, expansion: Expansion) -> Iterator[Sparse]:
        """Equations for the same: the functional is 0 at a polynomial."""
        degree = len(self.a) - 1
        roots = [number_in(self.a, [0] * q + [1]) for q in range(degree)]
        at: dict[pure.Monomial, dict[int, Number]] = {(0,) * len(self.axes): dict(enumerate(roots))}
        rows: list[Sparse] = [{} for _ in range(degree)]
        for monomial, coefficient in expansion.known.items():
            if any(coefficient.value):
                axis = next(i for i, c in enumerate(monomial) if c)
                for b, value in self.values_at(lowered(monomial, axis), at).items():
                    for row, entry in zip(rows, (value * coefficient).value, strict=True):
                        if entry:
                            add_multiple(row, entry, {axis * self.length + b: Fraction(1)})
        return (row for row in rows if row)

    def values_at(self, monomial: pure.Monomial, at: dict[pure.Monomial, dict[int, Number]]) -> dict[int, Number]:
        """Those of the basis at a product of some y."""
        if monomial not in at:
            axis = next(i for i, c in enumerate(monomial) if c)
            smaller = self.values_at(lowered(monomial, axis), at)
            found: dict[int, Number] = {}
            for b, row in enumerate(self.axes[axis]):
                for term in (value * smaller[c] for c, value in row.items() if c in smaller):
                    found[b] = found[b] + term if b in found else term
            at[monomial] = found
        return at[monomial]


def lowered(monomial: pure.Monomial, axis: int) -> pure.Monomial:
    """The monomial divided by a variable."""
    return (*monomial[:axis], monomial[axis] - 1, *monomial[axis + 1 :])


def transposed(rows: Sequence[Sparse], length: int) -> list[Sparse]:
    """The columns."""
    found: list[Sparse] = [{} for _ in range(length)]
    for b, row in enumerate(rows):
        for column, value in row.items():
            found[column][b] = value
    return found


def add_multiple(target: Sparse, factor: Fraction, row: Mapping[int, Fraction]) -> None:
    """Add a multiple of a vector."""
    pure.spend(sum(pure.fraction_cost(bits_of(factor), bits_of(value)) for value in row.values()))
    for column, value in row.items():
        total = target.get(column, Fraction(0)) + factor * value
        if total:
            target[column] = total
        else:
            target.pop(column, None)


def local_algebras(points: Points, forms: Sequence[Forms], a: Polynomial) -> tuple[int, Polynomial]:
    """The sum of the multiplicities m(t) of isolated solutions at the roots t of a, and V with V(t) = m(t) a'(t)."""
    numbers = Values([number_in(a, each) for each in points.coordinates])
    expansions = [Expansion(a, form, numbers) for form in forms]
    space = Functionals(a, len(points.coordinates) - 1, [], None)
    for order in range(1, MAX_NUMBER + 2):
        for expansion in expansions:
            expansion.extend(order)
        larger = space.larger(expansions)
        if larger.length == space.length:
            break
        space = larger
    sums = power_sums(space, len(a) - 1)
    v = [sum(x * y for x, y in zip(a[i:], sums, strict=False)) for i in range(1, len(a))]
    return space.length, [int(x) for x in v]  # integers, m being constant on the roots of each factor over Q


def power_sums(space: Functionals, number: int) -> list[Fraction]:
    """The traces of 1, T, T^2, ..: the sums of m(t) t^j."""
    sums = [Fraction(space.length)] + [Fraction(0)] * (number - 1)
    for b in range(space.length):
        vector: Sparse = {b: Fraction(1)}
        for j in range(1, number):
            further: Sparse = {}
            for column, value in vector.items():
                add_multiple(further, value, space.root[column])
            vector = further
            sums[j] += vector.get(b, Fraction(0))
    return sums


def multiplicities(points: Points, forms: Sequence[Forms], weights: Weighed) -> tuple[int, Polynomial]:
    """The sum of all multiplicities m(t), the solutions being isolated, and V with V(t) = m(t) h0'(t) at the roots."""
    h0 = points.h0
    total, v = len(h0) - 1, pure.derivative(h0)
    for a, weight in weights.parts:
        if weight > 1:
            number, part = local_algebras(points, forms, a)
            total += number - (len(a) - 1)
            surplus = [x - y for x, y in zip(part, pure.derivative(a), strict=True)]
            rest = quotient(h0, a)
            pure.spend(
                len(surplus) * len(rest) * (300 + pure.product_cost(pure.most_bits(surplus), pure.most_bits(rest)))
            )
            for i, x in enumerate(surplus):
                for j, y in enumerate(rest):
                    v[i + j] += x * y
    return total, v


def quotient(b: Polynomial, a: Polynomial) -> Polynomial:
    """b / a over Z."""
    pure.spend(len(a) * len(b) * (300 + pure.product_cost(pure.most_bits(a), 2 * pure.most_bits(b))))
    rest, found = list(b), [0] * (len(b) - len(a) + 1)
    for place in reversed(range(len(found))):
        found[place] = rest[place + len(a) - 1] // a[-1]
        for power, coefficient in enumerate(a, place):
            rest[power] -= found[place] * coefficient
    return found


# ---------------------------------------------------------------------------------------------------------------------
# Check 6: bounds
# ---------------------------------------------------------------------------------------------------------------------


def bezout(degrees: Sequence[int], number: int) -> int | None:
    """The product of the n greatest degrees; None if there are fewer."""
    return prod(sorted(degrees)[-number:]) if len(degrees) >= number else None


def multihomogeneous(polynomials: Sequence[pure.Terms], groups: Sequence[Sequence[int]]) -> int:
    """b', a coefficient of a product of linear forms: factor by factor, powers above those asked for left out.

    Examples
    --------
    >>> multihomogeneous([{(1, 1): 1}, {(1, 1): 2, (0, 0): 1}], [[0], [1]])
    2
    """
    most = tuple(map(len, groups))
    coefficients = {(0,) * len(groups): 1}
    for terms in polynomials:
        degrees = [max(sum(m[place] for place in group) for m in terms) for group in groups]
        pure.affordable(len(coefficients) <= MAX_STATES, f"groups: more than {MAX_STATES} terms in their product")
        pure.spend(len(coefficients) * len(groups) * 3000)
        further: dict[tuple[int, ...], int] = {}
        for powers, value in coefficients.items():
            for place, degree in enumerate(degrees):
                if degree and powers[place] < most[place]:
                    key = (*powers[:place], powers[place] + 1, *powers[place + 1 :])
                    further[key] = further.get(key, 0) + value * degree
        coefficients = further
    return coefficients.get(most, 0)


# ---------------------------------------------------------------------------------------------------------------------
# Check 12: mixed volumes
# ---------------------------------------------------------------------------------------------------------------------


def check_cells(certificate: Certificate, cells: Cells, solutions: int) -> None:
    """The terms that occur admit no more solutions than these, which are regular."""
    number = certificate.number
    supports = [sorted({*terms, (0,) * number}, key=pure.order, reverse=True) for terms in certificate.polynomials]
    fits = [len(row) for row in cells.lifting] == [len(points) for points in supports]
    pure.require(fits, "subdivision: the numbers are not those of the terms")
    clashes = [lowest_nowhere(weights, supports, cells.lifting) for weights in cells.obstructions]
    volume = 0
    for edges in unobstructed(supports, clashes):
        pure.spend(5000 + 300 * number**3)
        volume += volume_of([[b - a for a, b in zip(one, other, strict=True)] for one, other in edges])
        pure.require(volume <= solutions, f"subdivision: there is room for more than {solutions} solutions")


def lowest_nowhere(
    weights: Mapping[tuple[int, int], int],
    supports: Sequence[Sequence[pure.Monomial]],
    lifting: Sequence[Sequence[int]],
) -> frozenset[tuple[int, int]]:
    """The points that an obstruction shows not to be lowest together."""
    pure.spend(len(weights) * (3000 + 400 * len(supports)))
    known = all(i < len(supports) and k < len(supports[i]) for i, k in weights)
    pure.require(known, "subdivision: an obstruction has points that there are not")
    for i in range(len(supports)):
        level = sum(weight for (j, _), weight in weights.items() if i == j)
        along = sum(weight * supports[j][k][i] for (j, k), weight in weights.items())
        pure.require(level == along == 0, "subdivision: the weights of an obstruction do not sum to 0")
    falls = sum(weight * lifting[i][k] for (i, k), weight in weights.items()) < 0
    pure.require(falls, "subdivision: an obstruction does not lower the sum of the numbers")
    return frozenset(place for place, weight in weights.items() if weight < 0)


def unobstructed(
    supports: Sequence[Sequence[pure.Monomial]], clashes: Sequence[frozenset[tuple[int, int]]]
) -> Iterator[list[tuple[pure.Monomial, pure.Monomial]]]:
    """Two points of each support, small supports first, that have none of the sets of points among them."""
    order = sorted(range(len(supports)), key=lambda i: (len(supports[i]), i))
    rank = {i: place for place, i in enumerate(order)}
    meeting: list[dict[int, list[frozenset[tuple[int, int]]]]] = [{} for _ in order]
    for clash in clashes:
        last = max(rank[i] for i, _ in clash)
        for k in {k for i, k in clash if rank[i] == last}:
            meeting[last].setdefault(k, []).append(clash)

    def chosen(level: int, places: frozenset[tuple[int, int]]) -> Iterator[frozenset[tuple[int, int]]]:
        if level == len(order):
            yield places
            return
        i = order[level]
        for pair in combinations(range(len(supports[i])), 2):
            near = [clash for k in pair for clash in meeting[level].get(k, ())]
            pure.spend(4000 + 200 * len(places) + 400 * len(near))
            further = places | {(i, k) for k in pair}
            if not any(map(further.issuperset, near)):
                yield from chosen(level + 1, further)

    for places in chosen(0, frozenset()):
        ends = sorted(places)
        yield [(supports[i][k], supports[i][j]) for (i, k), (_, j) in zip(ends[::2], ends[1::2], strict=True)]


def volume_of(rows: Sequence[Sequence[int]]) -> int:
    """The absolute value of the determinant, by elimination without fractions (Bareiss).

    Examples
    --------
    >>> volume_of([[0, 2], [3, 4]]), volume_of([[1, 2], [2, 4]])
    (6, 0)
    """
    left, last = [list(row) for row in rows], 1
    while left:
        place = next((number for number, row in enumerate(left) if row[0]), None)
        if place is None:
            return 0
        pivot = left.pop(place)
        left = [[(pivot[0] * b - row[0] * a) // last for a, b in zip(pivot[1:], row[1:], strict=True)] for row in left]
        last = pivot[0]
    return abs(last)


# ---------------------------------------------------------------------------------------------------------------------
# Checks 7 and 8: elements, and the number of homogeneous polynomials
# ---------------------------------------------------------------------------------------------------------------------


def elements_of(certificate: Certificate) -> pure.Elimination:
    """The elements of an elimination."""
    elements = pure.echelon_form(certificate.polynomials)
    return pure.followed(tuple(range(certificate.number)), elements, certificate.elimination or ())


def primes_of(forms: Iterable[Mapping[pure.Monomial, int]]) -> list[int]:
    """Primes of 31 bits for which nothing is built: they follow from the polynomials."""
    words = (f"{monomial}:{value:x}" for form in forms for monomial, value in sorted(form.items()))
    digest = sha256(";".join(words).encode()).digest()
    starts = (int.from_bytes(digest[8 * k : 8 * k + 4], "big") >> 2 | 1 << 30 | 1 for k in range(ATTEMPTS))
    return [next(n for n in range(start, 1 << 32, 2) if pure.is_prime(n)) for start in starts]


SLOT: Final = 16
"""Bytes for an entry of a packed row: residues have 31 bits; 2^16 times a product is added, then 2^17 such are."""

SUMS: Final = 1 << 16
"""So often is a multiple of another row added to one before it is reduced."""


class Relations:
    """Linear relations of symbols modulo a prime: each symbol is free, or a combination of free ones.

    A combination is one integer, with the residue of symbol number s at byte ``SLOT s``; residues are reduced late.
    """

    def __init__(self, symbols: int, p: int) -> None:
        self.symbols = symbols
        self.p = p
        self.known: dict[int, int] = {}
        self.added: dict[int, int] = {}

    def unpacked(self, value: int) -> list[int]:
        """The residues."""
        pure.spend(150 * self.symbols)
        data = value.to_bytes(SLOT * self.symbols, "little")
        return [int.from_bytes(data[i : i + SLOT], "little") % self.p for i in range(0, len(data), SLOT)]

    def packed(self, residues: Sequence[int]) -> int:
        """One integer."""
        return int.from_bytes(b"".join(residue.to_bytes(SLOT, "little") for residue in residues), "little")

    def reduced(self, relation: Mapping[int, int]) -> list[int]:
        """The combination of free symbols, for that of any symbols."""
        pure.spend(len(relation) * (500 + 3 * self.symbols))
        total = 0
        for symbol, value in relation.items():
            total += value % self.p * self.known.get(symbol, 1 << (8 * SLOT * symbol))
        return self.unpacked(total)

    def add(self, relation: Mapping[int, int]) -> None:
        """One relation more."""
        residues = self.reduced(relation)
        lead = next((symbol for symbol, value in enumerate(residues) if value), None)
        if lead is None:
            return
        factor = -pow(residues[lead], -1, self.p)
        residues[lead] = 0
        row = self.packed([value * factor % self.p for value in residues])
        shift, mask = 8 * SLOT * lead, (1 << (8 * SLOT)) - 1
        pure.spend(len(self.known) * (500 + 3 * self.symbols) + 300 * self.symbols)
        for symbol, known in self.known.items():
            entry = (known >> shift) & mask
            if entry:
                value = known - (entry << shift) + entry % self.p * row
                self.added[symbol] += 1
                if self.added[symbol] == SUMS:
                    value, self.added[symbol] = self.packed(self.unpacked(value)), 0
                self.known[symbol] = value
        self.known[lead], self.added[lead] = row, 0


Vector: TypeAlias = dict[int, int]


def graded(number: int, forms: Sequence[Mapping[pure.Monomial, int]], p: int, most: int) -> list[int] | None:
    """dim A_0, dim A_1, .. up to the last that is not 0; None if their sum is too large, or they do not end.

    A = S / J modulo p. ``maps[i][c]`` is x_i c for the c-th element of the basis of the part of A of one degree less.
    If they end, n general combinations of the polynomials, of the greatest degrees d_i, are a regular sequence, and A
    is 0 above the sum of the d_i - 1 (Macaulay); so nothing is looked for further on.
    """
    words = [word_of(form) for form in forms]
    if any(not word and value % p for each in words for word, value in each):
        return []
    dimensions, maps = [1], [[{0: 1}] for _ in range(number)]
    starts: dict[tuple[int, ...], Vector] = {(): {0: 1}}
    below = 0
    last = sum(sorted(degree_of(form) - 1 for form in forms)[-number:])
    for degree in range(1, min(MAX_GRADE, last if len(forms) >= number else -1) + 2):
        size = dimensions[-1]
        relations = Relations(number * size, p)
        entries = number * size * (below * number * (number - 1) // 2 + len(forms) + 1)
        pure.affordable(entries <= pure.MAX_ENTRIES_OF_A_MATRIX << 4, "bound: a matrix with too many entries")
        if degree > 1:
            for relation in commuting(maps, size):
                relations.add(relation)
        for each in words:
            if each and len(each[0][0]) == degree:
                relations.add(relation_of(each, starts, size))
        free = {s: k for k, s in enumerate(s for s in range(number * size) if s not in relations.known)}
        maps = mapped(relations, free, number, size)
        starts = continued(words, starts, maps, degree, p)
        below, size = size, len(free)
        if not size:
            return dimensions
        dimensions.append(size)
        if sum(dimensions) > most:
            return None
    return None


def word_of(form: Mapping[pure.Monomial, int]) -> list[tuple[tuple[int, ...], int]]:
    """The monomials as words in the variables, with their coefficients."""
    return [
        (tuple(place for place, exponent in enumerate(monomial) for _ in range(exponent)), value)
        for monomial, value in form.items()
    ]


def commuting(maps: Sequence[Sequence[Vector]], size: int) -> Iterator[Vector]:
    """x_i (x_j c) = x_j (x_i c), of symbols x_i a with the number ``i size + a``."""
    for i, j in combinations(range(len(maps)), 2):
        for left, right in zip(maps[j], maps[i], strict=True):
            relation = {i * size + place: value for place, value in left.items()}
            relation |= {j * size + place: -value for place, value in right.items()}
            yield relation


def relation_of(words: Sequence[tuple[tuple[int, ...], int]], starts: Mapping[Any, Vector], size: int) -> Vector:
    """A polynomial whose degree is now reached, each word written as its last variable times what is before it."""
    relation: Vector = {}
    for word, value in words:
        pure.spend(300 * len(starts[word[:-1]]))
        for place, entry in starts[word[:-1]].items():
            symbol = word[-1] * size + place
            relation[symbol] = relation.get(symbol, 0) + value * entry
    return relation


def mapped(relations: Relations, free: Mapping[int, int], number: int, size: int) -> list[list[Vector]]:
    """The products of the variables and the last basis, in the new one."""
    found = []
    for i in range(number):
        row: list[Vector] = []
        for symbol in range(i * size, (i + 1) * size):
            if symbol in free:
                row.append({free[symbol]: 1})
            else:
                values = relations.unpacked(relations.known[symbol])
                row.append({free[s]: value for s, value in enumerate(values) if value})
        found.append(row)
    return found


def continued(
    words: Sequence[Sequence[tuple[tuple[int, ...], int]]],
    starts: Mapping[Any, Vector],
    maps: Sequence[Sequence[Vector]],
    degree: int,
    p: int,
) -> dict[tuple[int, ...], Vector]:
    """The values in A of the beginnings, of this length, of words that are longer."""
    found: dict[tuple[int, ...], Vector] = {}
    for word in {word[:degree] for each in words for word, _ in each if len(word) > degree}:
        total: Vector = {}
        for place, value in starts[word[:-1]].items():
            image = maps[word[-1]][place]
            pure.spend(300 * len(image))
            for other, entry in image.items():
                total[other] = (total.get(other, 0) + value * entry) % p
        found[word] = total
    return found


def number_of(number: int, forms: Sequence[Mapping[pure.Monomial, int]], most: int, extra: bool = False) -> int | None:
    """The number of homogeneous polynomials (check 8), with a random linear form if ``extra``; None if not found."""
    for p in primes_of(forms):
        random = Random(p)
        further = [{tuple(int(i == k) for k in range(number)): random.randrange(1, p) for i in range(number)}]
        dimensions = graded(number, [*forms, *further * extra], p, most)
        if dimensions is not None:
            return sum(dimensions)
    return None


# ---------------------------------------------------------------------------------------------------------------------
# Check 9: points at infinity
# ---------------------------------------------------------------------------------------------------------------------


def check_infinity(certificate: Certificate, infinity: Infinity) -> None:
    """The points are distinct common points at infinity, their weights sum to what is said, and all are isolated."""
    number, representation = certificate.number, infinity.points
    pure.require(len(certificate.polynomials) >= number, "infinity: there are fewer polynomials than variables")
    for _ in check_representation(representation, "infinity: "):
        pass
    length = len(representation.h) - 1
    chart = combined(representation.w, representation.numerators, length) == pure.derivative(representation.h)
    pure.require(chart, "infinity: w.z is not 1 at the roots of the eliminant")
    points = Points(representation, [])
    forms = list(map(homogeneous, certificate.polynomials))
    for place, holds in enumerate(points.vanish(list(map(top_form, certificate.polynomials))), 1):
        pure.require(holds, f"infinity: polynomial {place} is not 0 at every point")
    weights = weighed(Slopes(points, forms, range(number + 1)), number)  # the kernel has the point, and c vectors more
    same = infinity.multiplicity == weights.total
    pure.require(same, f"infinity: multiplicity {infinity.multiplicity} claimed, {weights.total} proved")
    finite = number_of(number + 1, forms, MAX_HOMOGENEOUS_NUMBER, extra=True)
    pure.require(finite is not None, "infinity: not proved that the common points are finitely many")


# ---------------------------------------------------------------------------------------------------------------------
# Check 10: counts and claims
# ---------------------------------------------------------------------------------------------------------------------


class Proved(NamedTuple):
    """The strongest claim that is proved; ``multiplicity`` by parameter, None where they are not known."""

    claim: str
    route: str | None
    total: int | None
    multiplicity: dict[pure.Ends, int] | None
    line: str


def check_parts(certificate: Certificate) -> None:
    """What a certificate must have depends on its route and claim."""
    route = certificate.route
    for key, value, of in (
        ("groups", certificate.groups, "multihomogeneous-bezout"),
        ("infinity", certificate.infinity, "counting-at-infinity"),
        ("elimination", certificate.elimination, "exact-elimination"),
        ("subdivision", certificate.cells, "mixed-volume"),
    ):
        pure.require((value is not None) == (route == of), f"{key}: not as the route {route or 'null'} needs")
    positive = certificate.claim == "positive-dimensional-proved"
    pure.require((certificate.witness is not None) == positive, "witness: not as the claim needs")
    fits = (route is not None) == (certificate.claim in ("complete", "inconsistent"))
    pure.require(fits, f"claim: {certificate.claim} by {route or 'no route'}")


def check_claims(certificate: Certificate) -> Iterator[str]:
    """Check 10."""
    listed = len(certificate.solutions)
    same = certificate.real_solutions == listed
    pure.require(same, f"real solutions: {certificate.real_solutions} claimed, {listed} listed")
    pure.require(listed or not certificate.box_exponent, "boxes: a grid is given, but there is no solution")
    if certificate.witness is not None:
        yield from check_positive_dimension(certificate, certificate.witness)
    elif certificate.representation is None:
        yield from nothing_listed(certificate)
    else:
        yield from solutions_listed(certificate, certificate.representation)


def nothing_listed(certificate: Certificate) -> Iterator[str]:
    """Without a representation there may be no solution at all, or nothing is claimed."""
    nothing = not certificate.distinct_solutions and not certificate.solutions
    pure.require(nothing, "representation: missing, but solutions are claimed")
    claim = certificate.claim, certificate.route
    total = 0 if certificate.claim == "inconsistent" else None
    same = certificate.complex_solutions == total and type(certificate.complex_solutions) is type(total)
    pure.require(same, "complex solutions: not what the claim needs")
    if claim == ("inconsistent", "exact-elimination"):
        elements = elements_of(certificate).elements
        constant = any(degree_of(element) == 0 for element in elements)
        pure.require(constant, "claim: inconsistent, but the elimination comes to no constant")
        yield INCONSISTENT
    elif claim == ("inconsistent", "modular-rank"):
        forms = list(map(homogeneous, certificate.polynomials))
        found = number_of(certificate.number + 1, forms, MAX_HOMOGENEOUS_NUMBER)
        pure.require(found is not None, "claim: not proved that the polynomials have no common zero")
        yield INCONSISTENT
    elif claim == ("not-proven-complete", None):
        yield "not proven complete: no solution is listed, and none is excluded"
    elif claim == ("positive-dimensional-detected", None):
        yield "positive dimension detected: evidence found by the solver, no proof"
    else:
        raise pure.Refusal("rejected", f"claim: {certificate.claim} is not proved by what is in the certificate")


INCONSISTENT: Final = "inconsistent: 1 = 0 follows from the polynomials, there is no solution, real or complex"


def solutions_listed(certificate: Certificate, representation: pure.Representation) -> Iterator[str]:
    """The claim, the counts and the multiplicities beside solutions."""
    number = len(representation.h) - 1
    distinct = certificate.distinct_solutions
    pure.require(distinct == number, f"distinct solutions: {distinct} claimed, {number} proved")
    columns = range(1, certificate.number + 1)
    forms = list(map(homogeneous, certificate.polynomials))
    weights = weighed(Slopes(finite_points(representation), forms, columns), certificate.number)
    if certificate.infinity is not None:
        check_infinity(certificate, certificate.infinity)
    proved = proved_of_all(certificate, representation, weights)
    claimed = f"{certificate.claim} by {certificate.route or 'no route'}"
    pure.require(
        (certificate.claim, certificate.route) == (proved.claim, proved.route),
        f"claim: {claimed}, but what is proved is {proved.claim} by {proved.route or 'no route'}",
    )
    total = certificate.complex_solutions
    pure.require(total == proved.total, f"complex solutions: {total} claimed, {proved.total} proved")
    for place, solution in enumerate(certificate.solutions, 1):
        expected = None if proved.multiplicity is None else proved.multiplicity.get(solution.parameter)
        same = solution.multiplicity == expected
        pure.require(same, f"multiplicity: that of solution {place} differs from what is proved")
    if weights.regular():
        yield f"complex solutions: {number}, each isolated and simple"
    elif proved.total is None:
        yield f"complex solutions: {number} distinct; not proved that all are simple"
    else:
        yield f"complex solutions: {number} distinct, {proved.total} with multiplicity"
    yield proved.line


def proved_of_all(certificate: Certificate, representation: pure.Representation, weights: Weighed) -> Proved:
    """The first argument that applies."""
    number, total = len(representation.h) - 1, weights.total
    regular = weights.regular()
    by_weight = weights_of(weights, pure.primitive_part(representation.h))
    bound = bezout([degree_of(terms) for terms in certificate.polynomials], certificate.number)
    if regular and number == bound:
        line = f"complete: {number} isolated solutions are the product of the degrees, there is no other"
        return Proved("complete", "refined-bezout", number, by_weight, line)
    if certificate.groups is not None:
        square = len(certificate.polynomials) == certificate.number
        closes = regular and square and number == multihomogeneous(certificate.polynomials, certificate.groups)
        pure.require(closes, f"groups: {number} solutions are not proved to be all by their number")
        line = f"complete: {number} isolated solutions are the multihomogeneous Bezout number, there is no other"
        return Proved("complete", "multihomogeneous-bezout", number, by_weight, line)
    if certificate.cells is not None:
        pure.require(regular, "subdivision: not all solutions are isolated and simple")
        check_cells(certificate, certificate.cells, number)
        line = f"complete: {number} isolated solutions are the mixed volume of the terms, there is no other"
        return Proved("complete", "mixed-volume", number, by_weight, line)
    if certificate.infinity is not None:
        further = certificate.infinity.multiplicity
        total, by_weight = filled(certificate, representation, weights, (bound or 0) - further)
        line = f"infinity: {total} solutions and {further} at infinity, but the degrees leave room for {bound}"
        pure.require(total + further == bound, line)
        line = (
            f"complete: {total} solutions and {further} at infinity, with multiplicity, are the product of the "
            "degrees, there is no other"
        )
        return Proved("complete", "counting-at-infinity", total, by_weight, line)
    if certificate.elimination is not None:
        return proved_by_elimination(certificate, representation, weights)
    if certificate.route == "modular-rank":
        found = number_of(certificate.number, list(map(top_form, certificate.polynomials)), MAX_NUMBER)
        if found is not None:
            total, by_weight = filled(certificate, representation, weights, found)
        pure.require(found == total, f"modular rank: {total} solutions, not proved that there are no others")
        return Proved("complete", "modular-rank", total, by_weight, room_for(total))
    line = f"not proven complete: {number} solutions are proved, others are not excluded"
    return Proved("not-proven-complete", None, None, by_weight if regular else None, line)


def filled(
    certificate: Certificate, representation: pure.Representation, weights: Weighed, number: int
) -> tuple[int, dict[pure.Ends, int]]:
    """The weights, and their sum, if this is the number there can be; else the multiplicities of isolated solutions."""
    points = finite_points(representation)
    if weights.total == number or weights.regular():
        return weights.total, weights_of(weights, points.h0)
    total, v = multiplicities(points, list(map(homogeneous, certificate.polynomials)), weights)
    return total, pure.multiplicities(v, representation)


def room_for(number: int) -> str:
    """The last line where elements, or their top forms, leave room for so many solutions."""
    return f"complete: polynomials that vanish at all solutions leave room for {number}, there is no other"


def proved_by_elimination(
    certificate: Certificate,
    representation: pure.Representation,
    weights: Weighed,
) -> Proved:
    """Complete if the solutions fill what the top forms leave, or by the algebra of all solutions."""
    elimination = elements_of(certificate)
    left = number_of(certificate.number, list(map(top_form, elimination.elements)), MAX_NUMBER)
    if left is not None:
        few = pure.attempted(partial(filled, certificate, representation, weights, left), PART_FOR_MULTIPLICITIES)
        if few is not None and few[0] == left:
            return Proved("complete", "exact-elimination", left, few[1], room_for(left))
    basis = elimination.basis(MAX_NUMBER)
    line = f"elimination: it leaves {len(basis)} monomials, the solutions are not proved to fill them"
    pure.require(basis, line)
    algebra = pure.quotient_algebra(elimination, basis)
    powers = partial(powers_modulo, representation)
    v = pure.multiplicity_polynomial(algebra, representation, powers, certificate.number) if algebra else None
    if v is None:
        raise pure.Refusal("rejected", line)
    found = pure.multiplicities(v, representation)
    return Proved("complete", "exact-elimination", len(basis), found, room_for(len(basis)))


def powers_modulo(representation: pure.Representation, weights: Sequence[int], p: int) -> list[list[int]]:
    """1, u, .., u^(D - 1) modulo p and h0, for the combination u of the variables; ValueError if p is not suitable.

    It is above the leading coefficient.
    """
    h0 = pure.primitive_part(representation.h)
    ring = pure.Residues(h0, p)
    slope = ring.element(pure.derivative(representation.h))
    values = [ring.element(numerator) for numerator in representation.numerators]
    return pure.powers_of_quotient(pure.combination(weights, values), slope)


# ---------------------------------------------------------------------------------------------------------------------
# Check 11: positive dimension
# ---------------------------------------------------------------------------------------------------------------------


def check_positive_dimension(certificate: Certificate, witness: Witness) -> Iterator[str]:
    """The solutions are infinitely many."""
    nothing = not (certificate.solutions or certificate.distinct_solutions) and certificate.complex_solutions is None
    pure.require(
        nothing and certificate.route is None, "witness: beside it solutions are listed, or a number or route given"
    )
    if witness.cause == CAUSES[0]:
        yield from few_polynomials(certificate)
    else:
        yield from many_solutions(certificate, witness)
    yield "positive dimension: complex solutions are infinitely many; that real ones are is not proved"


def few_polynomials(certificate: Certificate) -> Iterator[str]:
    """A solution exists, and the polynomials are combinations of fewer than n."""
    representation, witness = certificate.representation, certificate.witness
    if representation is None or witness is None or witness.forms or witness.slices:
        raise pure.Refusal("rejected", "witness: not a representation of a solution, without forms and slices")
    yield from checked(representation, certificate.polynomials)
    rank = len(pure.echelon_form(certificate.polynomials))
    line = f"witness: {rank} polynomials are independent, not fewer than the {certificate.number} variables"
    pure.require(rank < certificate.number, line)


def many_solutions(certificate: Certificate, witness: Witness) -> Iterator[str]:
    """Slices have more solutions than isolated ones are possible."""
    pure.require(certificate.representation is None, "witness: a representation is given beside slices")
    fits = witness.forms and all(any(row[:-1]) for row in witness.forms)
    pure.require(fits, "witness: there is no form, or a constant one")
    rising = all(a < b for (a, _), (b, _) in pairwise(witness.slices))
    pure.require(rising, "witness: the constants of the slices do not increase")
    number = certificate.number
    *fixed, last = (form_of(form, number) for form in witness.forms)
    degrees = [degree_of(terms) for terms in certificate.polynomials] + [1] * len(fixed)
    bound = bezout(degrees, number)
    if bound is None:
        raise pure.Refusal("rejected", "witness: with the forms there are fewer polynomials than variables")
    total = 0
    for place, (constant, representation) in enumerate(witness.slices, 1):
        moved = {m: value * constant.denominator for m, value in last.items()}
        moved[(0,) * number] = moved.get((0,) * number, 0) - constant.numerator
        forms = [*fixed, {m: value for m, value in moved.items() if value}]
        yield from checked(representation, [*certificate.polynomials, *forms], f"slice {place}: ")
        total += len(representation.h) - 1
    pure.require(total > bound, f"witness: {total} solutions, but {bound} can be isolated")
    yield f"witness: {total} solutions, of which {bound} at most are isolated"


def form_of(row: Sequence[int], number: int) -> pure.Terms:
    """A linear form as a polynomial."""
    monomials = [tuple(int(i == k) for i in range(number)) for k in range(number + 1)]
    return {monomial: value for monomial, value in zip(monomials, row, strict=True) if value}


# ---------------------------------------------------------------------------------------------------------------------
# All checks
# ---------------------------------------------------------------------------------------------------------------------


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    return checks(read(body))


def checks(certificate: Certificate) -> Iterator[str]:
    """One line per claim that is proved; witnesses of a positive dimension are checked with the claim."""
    check_parts(certificate)
    representation = certificate.representation
    if representation is not None and certificate.witness is None:
        yield from checked(representation, certificate.polynomials)
        yield from check_real(certificate, representation)
    yield from check_claims(certificate)

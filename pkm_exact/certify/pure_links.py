"""Checks certificates of mechanisms with passive bodies with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate; constraints are
read by ``pure_mechanism.py``, systems replayed by ``pure_system.py``. Written from the definition of the format,
``docs/certificates-links.md``; the sections below have its order and its notation. It shares no line with the other
checker.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import lcm
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure, pure_mechanism, pure_system
else:
    import pure
    import pure_mechanism
    import pure_system

__all__ = ["replayed"]

Poly: TypeAlias = dict[pure.Monomial, Fraction]

MAX_BODIES: Final = 32
MAX_JOINED: Final = 64
MAX_UNKNOWNS: Final = 64
MAX_RADIUS: Final = 10**9
ORDINARY: Final = (1, 1, 1)

# ---------------------------------------------------------------------------------------------------------------------
# Format
# ---------------------------------------------------------------------------------------------------------------------

KEYS: Final = "format version mechanism configuration method system box notes"
MOTIONS: Final = ("spatial", "planar", "schoenflies", "translation", "spherical")
MOTIONS_OF_THE_PLANE: Final = ("planar", "translation")


class Body(NamedTuple):
    """Places of the unknowns of C, of (c, s) and of R by rows among all of them; None where it has none."""

    c: tuple[int | None, int | None, int | None]
    turn: tuple[int, int] | None
    r: tuple[tuple[int, ...], ...] | None


class Joined(NamedTuple):
    """Bodies a and b, 0 being the ground, and the constraint."""

    a: int
    b: int
    constraint: pure_mechanism.Constraint


class Box(NamedTuple):
    """K, r and the centre."""

    exponent: int
    radius: int
    centre: tuple[int, ...]


@dataclass(frozen=True)
class Certificate:
    """What a certificate says."""

    metric: pure.Metric
    names: tuple[str, ...]
    bodies: tuple[Body, ...]
    joined: tuple[Joined, ...]
    variables: list[str] | None
    system: pure_system.Certificate | None
    box: Box | None


def a_boolean(value: Any, where: str) -> bool:
    """True or false."""
    pure.well_formed(type(value) is bool, f"{where}: neither true nor false")
    return bool(value)


def a_motion(planar: bool, value: Any, where: str) -> str:
    """The motion of a body; its name is not used."""
    name, motion = pure.an_object(value, where, "name motion")
    pure.a_text(name, f"{where}.name")
    return str(pure.one_of(MOTIONS_OF_THE_PLANE if planar else MOTIONS)(motion, f"{where}.motion"))


def numbered(motions: Sequence[str], *, planar: bool) -> tuple[tuple[str, ...], tuple[Body, ...]]:
    """The names of all unknowns, and their places."""
    names: list[str] = []

    def new(name: str) -> int:
        names.append(name)
        return len(names) - 1

    bodies = []
    for k, motion in enumerate(motions, 1):
        moves = (motion != "spherical", motion != "spherical", motion not in ("spherical", "planar") and not planar)
        x, y, z = (new(f"{axis}{k}") if moved else None for axis, moved in zip("xyz", moves, strict=True))
        turn = r = None
        if motion in ("planar", "schoenflies"):
            turn = new(f"c{k}"), new(f"s{k}")
        elif motion != "translation":
            r = tuple(tuple(new(f"r{k}_{i}{j}") for j in (1, 2, 3)) for i in (1, 2, 3))
        bodies.append(Body((x, y, z), turn, r))
    return tuple(names), tuple(bodies)


def a_metric(value: Any, where: str) -> pure.Metric:
    """g, three positive integers."""
    weights = pure.a_list(pure.a_positive_rational, 3)(value, where)
    pure.well_formed(all(weight.denominator == 1 for weight in weights), f"{where}: not three integers")
    x, y, z = map(int, weights)
    return x, y, z


def a_joined(bodies: int, metric: pure.Metric, value: Any, where: str) -> Joined:
    """A constraint and its bodies."""
    pair, constraint = pure.an_object(value, where, "bodies constraint")
    a, b = pure.a_list(pure.a_number, 2)(pair, f"{where}.bodies")
    fits = a <= bodies and 1 <= b <= bodies and a != b
    pure.well_formed(fits, f"{where}.bodies: not two bodies, the second not the ground")
    return Joined(a, b, pure_mechanism.a_constraint(metric, constraint, f"{where}.constraint"))


def a_few(most: int, read: pure.Reader, value: Any, where: str) -> tuple[Any, ...]:
    """A list of one to so many."""
    few = not isinstance(value, list) or 1 <= len(value) <= most
    pure.well_formed(few, f"{where}: not 1 to {most}")
    return tuple(pure.a_list(read)(value, where))


def a_box(number: int, value: Any, where: str) -> Box:
    """The box."""
    exponent, radius, centre = pure.an_object(value, where, "exponent radius centre")
    grid = pure.a_number(exponent, f"{where}.exponent")
    pure.affordable(grid <= pure.MAX_BOX_EXPONENT, f"{where}.exponent: more than {pure.MAX_BOX_EXPONENT}")
    reach = pure.an_integer(radius, f"{where}.radius")
    pure.well_formed(1 <= reach <= MAX_RADIUS, f"{where}.radius: not from 1 to {MAX_RADIUS}")
    return Box(grid, reach, tuple(pure.a_list(pure.a_hexadecimal, number)(centre, f"{where}.centre")))


def read(body: dict[str, Any]) -> Certificate:
    """The content of a certificate."""
    version = body.get("version")
    known = type(version) is int and version in (1, 2)
    pure.well_formed(known, "format: not a links certificate, version 1 or 2")
    _, _, mechanism, configuration, method, system, box, notes = pure.an_object(body, "certificate", KEYS)
    pure.a_text(configuration, "configuration")
    pure.a_list(pure.a_text)(notes, "notes")
    name, unit, source, planar, *weights, platform, bodies, joined = pure.an_object(
        mechanism, "mechanism", f"name unit source planar {'metric ' * (version == 2)}platform bodies joined"
    )
    labels = name, unit, source
    metric = a_metric(weights[0], "mechanism.metric") if weights else ORDINARY
    for key, label in zip(("name", "unit", "source"), labels, strict=True):
        pure.a_text(label, f"mechanism.{key}")
    is_planar = a_boolean(planar, "mechanism.planar")
    motions = a_few(MAX_BODIES, partial(a_motion, is_planar), bodies, "mechanism.bodies")
    chosen = pure.an_integer(platform, "mechanism.platform")
    pure.well_formed(1 <= chosen <= len(motions), "mechanism.platform: not the number of a body")
    constraints = a_few(MAX_JOINED, partial(a_joined, len(motions), metric), joined, "mechanism.joined")
    names, places = numbered(motions, planar=is_planar)
    pure.affordable(len(names) <= MAX_UNKNOWNS, f"mechanism: more than {MAX_UNKNOWNS} unknowns")
    exact = pure.one_of(pure.METHODS)(method, "method") == "exact"
    given = (system is not None) == exact and (box is None) == exact
    pure.well_formed(given, "method: system and box are not those of the method")
    if system is not None:
        its = isinstance(system, dict) and system.get("format") == pure_system.FORMAT
        first = its and type(system.get("version")) is int and system["version"] == 1
        pure.well_formed(first, "system: not a certificate of a system, version 1")
    return Certificate(
        metric=metric,
        names=names,
        bodies=places,
        joined=constraints,
        variables=None if system is None else system.get("variables"),
        system=None if system is None else pure_system.read(system),
        box=None if box is None else a_box(len(names), box, "box"),
    )


# ---------------------------------------------------------------------------------------------------------------------
# Unknowns and polynomials
# ---------------------------------------------------------------------------------------------------------------------


def plus(*terms: tuple[Fraction | int, Poly]) -> Poly:
    """A combination of polynomials."""
    found: Poly = {}
    for factor, polynomial in terms:
        if factor:
            for monomial, value in polynomial.items():
                found[monomial] = found.get(monomial, Fraction(0)) + factor * value
    return {monomial: value for monomial, value in found.items() if value}


def times(one: Poly, other: Poly) -> Poly:
    """The product."""
    bits = pure_mechanism.cost(max(one.values(), key=size_of, default=Fraction(0)))
    bits += pure_mechanism.cost(max(other.values(), key=size_of, default=Fraction(0)))
    pure.spend(len(one) * len(other) * (10_000 + bits))
    found: Poly = {}
    for m, x in one.items():
        for n, y in other.items():
            key = tuple(a + b for a, b in zip(m, n, strict=True))
            found[key] = found.get(key, Fraction(0)) + x * y
    return {monomial: value for monomial, value in found.items() if value}


def size_of(value: Fraction) -> int:
    """The bits of the longer of numerator and denominator."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def scalar(weights: Sequence[Fraction | int], u: Sequence[Poly], v: Sequence[Poly]) -> Poly:
    """w_1 u_1 v_1 + w_2 u_2 v_2 + w_3 u_3 v_3."""
    return plus(*((weight, times(x, y)) for weight, x, y in zip(weights, u, v, strict=True)))


class Placed(NamedTuple):
    """C, and R by rows."""

    c: list[Poly]
    r: list[list[Poly]]

    def columns(self) -> list[list[Poly]]:
        """Those of R."""
        return [[row[j] for row in self.r] for j in range(3)]


class Mechanism:
    """The polynomials of a certificate's mechanism."""

    def __init__(self, certificate: Certificate) -> None:
        self.certificate = certificate
        self.number = len(certificate.names)
        self.g = certificate.metric
        self.inverses = [Fraction(1, weight) for weight in self.g]
        still = Body((None, None, None), None, None)
        self.placed = [self.place(body) for body in (still, *certificate.bodies)]

    def constant(self, value: int) -> Poly:
        """A constant."""
        return {(0,) * self.number: Fraction(value)} if value else {}

    def unknown(self, place: int, factor: int = 1) -> Poly:
        """A multiple of an unknown."""
        return {tuple(int(i == place) for i in range(self.number)): Fraction(factor)}

    def place(self, body: Body) -> Placed:
        """C and R of a body."""
        c = [{} if place is None else self.unknown(place) for place in body.c]
        r = [[self.constant(int(i == j)) for j in range(3)] for i in range(3)]
        if body.turn is not None:
            cosine, sine = body.turn
            r[0][0] = r[1][1] = self.unknown(cosine)
            r[0][1], r[1][0] = self.unknown(sine, -self.g[1]), self.unknown(sine, self.g[0])
        if body.r is not None:
            r = [[self.unknown(place) for place in row] for row in body.r]
        return Placed(c, r)

    def polynomials(self, *, all_of_them: bool) -> list[pure.Terms]:
        """In their order, over Z; without R R^T - 1 and the cofactors unless all are wanted."""
        found: list[Poly] = []
        for body, placed in zip(self.certificate.bodies, self.placed[1:], strict=True):
            if body.turn is not None:
                c, s = (self.unknown(place) for place in body.turn)
                w = self.g[0] * self.g[1]
                found.append(plus((1, times(c, c)), (w, times(s, s)), (-1, self.constant(1))))
            if body.r is not None:
                found += self.rotation(placed, all_of_them=all_of_them)
        for joined in self.certificate.joined:
            found += self.constraint(joined)
        return [cleared(polynomial) for polynomial in found if polynomial]

    def rotation(self, placed: Placed, *, all_of_them: bool) -> Iterator[Poly]:
        """R^T G R - G, R G^-1 R^T - G^-1, g_j times cofactors less g_i times entries."""
        sides: list[tuple[list[list[Poly]], Sequence[Fraction | int]]] = [(placed.columns(), self.g)]
        if all_of_them:
            sides.append((placed.r, self.inverses))
        for vectors, weights in sides:
            for i in range(3):
                for j in range(i, 3):
                    yield plus((1, scalar(weights, vectors[i], vectors[j])), (-weights[i] * (i == j), self.constant(1)))
        if all_of_them:
            r = placed.r
            for i in range(3):
                for j in range(3):
                    k, m, p, q = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
                    minor = ((self.g[j], times(r[k][p], r[m][q])), (-self.g[j], times(r[k][q], r[m][p])))
                    yield plus(*minor, (-self.g[i], r[i][j]))

    def inverse_times(self, placed: Placed, vector: Sequence[Poly]) -> list[Poly]:
        """R^-1 v = G^-1 R^T G v."""
        return [
            scalar([weight * inverse for weight in self.g], column, vector)
            for column, inverse in zip(placed.columns(), self.inverses, strict=True)
        ]

    def constraint(self, joined: Joined) -> Iterator[Poly]:
        """What a constraint asks."""
        one, two, constraint = self.placed[joined.a], self.placed[joined.b], joined.constraint
        if constraint.type == "at-point":
            x, b = constraint.data
            for i in range(3):
                terms = [(value, two.r[i][j]) for j, value in enumerate(b)]
                terms += [(-value, one.r[i][j]) for j, value in enumerate(x)]
                yield plus((1, two.c[i]), (-1, one.c[i]), *terms)
            return
        d = [plus((1, after), (-1, before)) for before, after in zip(one.c, two.c, strict=True)]
        seen = [scalar(self.g, d, d), *self.inverse_times(two, d), *self.inverse_times(one, d)]
        entries = [self.inverse_times(one, column) for column in two.columns()]
        seen += [entries[j][i] for i in range(3) for j in range(3)]
        seen.append(self.constant(1))
        values = [plus(*zip(form, seen, strict=True)) for form in constraint.forms]
        if constraint.weight is None:
            yield from values
        else:
            f, h = values
            yield plus((1, f), (-1 / constraint.weight, times(h, h)))


def cleared(polynomial: Poly) -> pure.Terms:
    """Multiplied by the least common denominator."""
    denominator = lcm(*(value.denominator for value in polynomial.values()))
    return {monomial: int(value * denominator) for monomial, value in polynomial.items()}


# ---------------------------------------------------------------------------------------------------------------------
# Checks
# ---------------------------------------------------------------------------------------------------------------------


def check_system(certificate: Certificate, found: pure_system.Certificate) -> Iterator[str]:
    """Check 2."""
    same = tuple(certificate.variables or ()) == certificate.names
    pure.require(same, "system: its variables are not the unknowns of the bodies")
    same = list(found.polynomials) == Mechanism(certificate).polynomials(all_of_them=True)
    pure.require(same, "system: its polynomials are not those of the mechanism")
    number, unknowns = len(found.polynomials), len(certificate.names)
    yield f"mechanism: the system has its {number} polynomials in the {unknowns} unknowns of its bodies"
    yield from pure_system.checks(found)


def check_box(certificate: Certificate, box: Box) -> Iterator[str]:
    """Checks 3 and 4."""
    polynomials = Mechanism(certificate).polynomials(all_of_them=False)
    n = len(certificate.names)
    pure.require(len(polynomials) == n, f"box: {len(polynomials)} polynomials in {n} unknowns, not as many")
    pure.require(holds_one(polynomials, box), "box: that it holds exactly one pose is not proved")
    for number, body in enumerate(certificate.bodies, 1):
        if body.r is not None:
            line = f"box: that body {number} is turned and not mirrored is not proved"
            pure.require(is_turned(body.r, box), line)
    yield f"box: it holds exactly one pose of all bodies, {n} unknowns, and it is regular"
    yield "not proven complete: one pose is proved, others are not excluded"


class Bounds(NamedTuple):
    """All numbers from low to high, in units that are known elsewhere."""

    low: int
    high: int

    def __add__(self, other: Bounds) -> Bounds:  # type: ignore[override]
        return Bounds(self.low + other.low, self.high + other.high)

    def __mul__(self, other: Bounds) -> Bounds:  # type: ignore[override]
        low, *_, high = sorted(x * y for x in self for y in other)
        return Bounds(low, high)


def scaled_value(terms: Mapping[pure.Monomial, int], x: Sequence[Bounds], k: int, degree: int) -> Bounds:
    """A polynomial of a degree at most ``degree`` at x in units of 2^-k, in units of 2^(-k degree)."""
    total = Bounds(0, 0)
    for monomial, value in terms.items():
        product = Bounds(value, value)
        for bounds, exponent in zip(x, monomial, strict=True):
            for _ in range(exponent):
                product = product * bounds
        shift = k * (degree - sum(monomial))
        total = total + Bounds(product.low << shift, product.high << shift)
    return total


def slope(terms: Mapping[pure.Monomial, int], place: int) -> pure.Terms:
    """The derivative by an unknown."""
    return {
        (*monomial[:place], monomial[place] - 1, *monomial[place + 1 :]): value * monomial[place]
        for monomial, value in terms.items()
        if monomial[place]
    }


def holds_one(polynomials: Sequence[pure.Terms], box: Box) -> bool:
    """Check 3. All numbers are exact: F' in units of 2^(-K degree), Y in units of 2^-p."""
    n, k = len(polynomials), box.exponent
    slopes = [[slope(terms, place) for place in range(n)] for terms in polynomials]
    degree = max((sum(monomial) for row in slopes for terms in row for monomial in terms), default=0)
    middle = [Bounds(m, m) for m in box.centre]
    around = [Bounds(m - box.radius, m + box.radius) for m in box.centre]
    bits = (degree + 1) * (k + pure.most_bits(box.centre)) + pure.most_bits(v for t in polynomials for v in t.values())
    count = sum(len(terms) for row in slopes for terms in row)
    pure.spend(40 * count * pure.product_cost(bits, bits))
    at_m = [[scaled_value(terms, middle, k, degree).low for terms in row] for row in slopes]
    in_x = [[scaled_value(terms, around, k, degree) for terms in row] for row in slopes]
    values = [scaled_value(terms, middle, k, degree + 1).low for terms in polynomials]
    matrix = [[pure.Gaussian(Fraction(value, 1 << k * degree), Fraction(0)) for value in row] for row in at_m]
    for p in precisions(k):
        y = [[round(entry.re * (1 << p)) for entry in row] for row in pure.near_inverse(matrix, p)]
        pure.spend(3 * n**3 * pure.product_cost(bits, p + pure.most_bits(v for row in y for v in row)))
        if is_contracted(y, in_x, values, box.radius, p + k * degree):
            return True
    return False


def precisions(k: int) -> Iterator[int]:
    """Bits of Y to try."""
    p = 2 * k + 64
    while p <= pure.MAX_PRECISION + 4 * k:
        yield p
        p *= 2


def is_contracted(
    y: Sequence[Sequence[int]], slopes: Sequence[Sequence[Bounds]], values: Sequence[int], radius: int, scale: int
) -> bool:
    """Whether |Y F(m)|_i + sum_j |1 - Y F'(X)|_ij r < r for every i, in units of 2^(-K - scale)."""
    for i, weights in enumerate(y):
        reach = abs(sum(a * b for a, b in zip(weights, values, strict=True)))
        for j in range(len(y)):
            ends = [sorted((a * row[j].low, a * row[j].high)) for a, row in zip(weights, slopes, strict=True)]
            low, high = (sum(side) for side in zip(*ends, strict=True))
            unit = (i == j) << scale
            reach += radius * max(abs(unit - low), abs(unit - high))
        if reach >= radius << scale:
            return False
    return True


def is_turned(places: Iterable[Iterable[int]], box: Box) -> bool:
    """Check 4: the determinant is positive all over the box, entry by entry in units of 2^-K."""
    r = [[Bounds(box.centre[place] - box.radius, box.centre[place] + box.radius) for place in row] for row in places]
    even = odd = 0
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        even += (r[0][i] * r[1][j] * r[2][k]).low
        odd += (r[0][i] * r[1][k] * r[2][j]).high
    return even > odd


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    return checks(read(body))


def checks(certificate: Certificate) -> Iterator[str]:
    """One line per claim that is proved."""
    if certificate.system is not None:
        yield from check_system(certificate, certificate.system)
    if certificate.box is not None:
        yield from check_box(certificate, certificate.box)

"""Checks certificates of mobility with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate. Written from
the definition of the format and its proofs, ``docs/certificates-mobility.md``; the sections below have its order, and
``pure_mobility_ideal.py`` has what version 3 has more. It shares no line with the other checker.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement, pairwise, zip_longest
from math import comb, gcd, lcm
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure, pure_mobility_ideal
else:
    import pure
    import pure_mobility_ideal

__all__ = ["replayed"]

Row: TypeAlias = tuple[Fraction, ...]
Integers: TypeAlias = list[int]

FORMAT: Final = "pkm_exact mobility certificate"
MAX_BODIES: Final = 64
MAX_FREEDOMS: Final = 128
MAX_SETS: Final = 1 << 16
MAX_DEGREE: Final = 12
MAX_MONOMIALS: Final = 500
PRIME: Final = (1 << 61) - 1
AXES: Final = {"R": 1, "P": 1, "H": 1, "C": 1, "U": 2, "S": 0, "screw": 0}
KEYS: Final = (
    "format version mechanism actuated loops platform locked_loops locked_platform mobility actuator_sets finite"
)
COUNTS: Final = "free platform gruebler_kutzbach overconstraint locked locked_platform"
ZERO: Final = (Fraction(0),) * 3

# ---------------------------------------------------------------------------------------------------------------------
# Format
# ---------------------------------------------------------------------------------------------------------------------


class Joint(NamedTuple):
    """A joint with the twists of its one-freedom joints, in order."""

    name: str
    ends: tuple[str, str]
    twists: tuple[Row, ...]


class RankProof(NamedTuple):
    """A minor by rows and columns, and the null space."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]
    null_space: tuple[Row, ...]


@dataclass(frozen=True)
class Mechanism:
    """Bodies, joints and the names of freedoms."""

    base: str
    platform: str
    bodies: tuple[str, ...]
    joints: tuple[Joint, ...]
    freedoms: tuple[str, ...]


def cross(u: Sequence[Fraction], v: Sequence[Fraction]) -> Row:
    """The vector product."""
    return tuple(u[i] * v[j] - u[j] * v[i] for i, j in ((1, 2), (2, 0), (0, 1)))


def a_joint(value: Any, where: str, bodies: Sequence[str]) -> Joint:
    """A joint."""
    values = pure.an_object(value, where, "name type bodies point axes pitch screws")
    name = pure.a_text(values[0], f"{where}.name")
    kind = pure.one_of(AXES)(values[1], f"{where}.type")
    one, other = pure.a_list(name_in(bodies), 2)(values[2], f"{where}.bodies")
    pure.well_formed(one != other, f"{where}.bodies: one body twice")
    numbers = pure.a_list(pure.a_rational, 3)
    point = numbers(values[3], f"{where}.point")
    axes = vectors(3, AXES[kind])(values[4], f"{where}.axes")
    pitch = pure.a_rational(values[5], f"{where}.pitch")
    screws = vectors(6, None)(values[6], f"{where}.screws")
    pure.well_formed(all(map(any, axes)), f"{where}.axes: an axis is 0")
    has_point = kind not in ("P", "screw")
    pure.well_formed(has_point or not any(point), f"{where}.point: not 0, though the type has none")
    pure.well_formed(kind == "H" or not pitch, f"{where}.pitch: not 0, though the type has none")
    fits = 1 <= len(screws) <= 6 if kind == "screw" else not screws
    pure.well_formed(fits, f"{where}.screws: not one to six of the type screw, none of another")
    pure.well_formed(all(map(any, screws)), f"{where}.screws: a screw is 0")
    if kind == "S":
        axes = tuple(tuple(Fraction(int(i == j)) for j in range(3)) for i in range(3))
    turns = [] if kind == "P" else [(*axis, *added(cross(point, axis), pitch, axis)) for axis in axes]
    slides = [(*ZERO, *axes[0])] if kind in ("P", "C") else []
    return Joint(name, (one, other), (*turns, *slides, *screws))


def vectors(size: int, number: int | None) -> pure.Reader:
    """The reader of a list of vectors."""

    def reader(value: Any, where: str) -> tuple[Row, ...]:
        pure.well_formed(isinstance(value, list) and number in (None, len(value)), f"{where}: not a list" + _of(number))
        found = [pure.a_list(pure.a_rational, size)(entry, f"{where}[{k}]") for k, entry in enumerate(value, 1)]
        return tuple(found)

    return reader


def _of(number: int | None) -> str:
    return "" if number is None else f" of {number}"


def added(u: Sequence[Fraction], factor: Fraction, v: Sequence[Fraction]) -> Row:
    """u + factor v."""
    return tuple(a + factor * b for a, b in zip(u, v, strict=True))


def name_in(names: Sequence[str]) -> pure.Reader:
    """The reader of a name that is in a list."""

    def reader(value: Any, where: str) -> str:
        pure.well_formed(isinstance(value, str) and value in names, f"{where}: not a name in the list")
        return str(value)

    return reader


def sized(where: str, found: int, least: int, most: int) -> None:
    """Refuse a list that is too short or too long."""
    pure.well_formed(found >= least, f"{where}: fewer than {least}")
    pure.affordable(found <= most, f"{where}: more than {most}")


def different(where: str, names: Sequence[str]) -> None:
    """Refuse a name that occurs twice."""
    pure.well_formed(len(set(names)) == len(names), f"{where}: one occurs twice")


def a_mechanism(value: Any) -> Mechanism:
    """Bodies and joints."""
    values = pure.an_object(value, "mechanism", "name unit source base platform bodies joints")
    for key, text in zip(("name", "unit", "source"), values[:3], strict=True):
        pure.a_text(text, f"mechanism.{key}")
    bodies = pure.a_list(pure.a_text)(values[5], "mechanism.bodies")
    sized("mechanism.bodies", len(bodies), 2, MAX_BODIES)
    different("mechanism.bodies", bodies)
    if isinstance(values[6], list):
        sized("mechanism.joints", len(values[6]), 1, MAX_FREEDOMS)
    joints = pure.a_list(lambda entry, where: a_joint(entry, where, bodies))(values[6], "mechanism.joints")
    base = name_in(bodies)(values[3], "mechanism.base")
    platform = name_in(bodies)(values[4], "mechanism.platform")
    pure.well_formed(base != platform, "mechanism.platform: the base")
    freedoms: list[str] = []
    for joint in joints:
        count = len(joint.twists)
        freedoms += [joint.name] if count == 1 else (f"{joint.name}.{k + 1}" for k in range(count))
    sized("mechanism.joints", len(freedoms), 1, MAX_FREEDOMS)
    different("mechanism.joints", freedoms)
    different("mechanism.joints", [joint.name for joint in joints])
    part = parts(bodies, joints)
    connected = all(part[body] == part[base] for body in bodies)
    pure.well_formed(connected, "mechanism: a body is not connected with the base")
    return Mechanism(base, platform, bodies, joints, tuple(freedoms))


def parts(bodies: Sequence[str], joints: Sequence[Joint]) -> dict[str, str]:
    """For each body one that stands for all that joints connect with it."""
    part = {body: body for body in bodies}
    for joint in joints:
        one, other = (part[end] for end in joint.ends)
        part = {body: one if where == other else where for body, where in part.items()}
    return part


def in_order(names: Sequence[str]) -> pure.Reader:
    """The reader of names, as places in a list, in increasing order."""

    def reader(value: Any, where: str) -> tuple[int, ...]:
        found = pure.a_list(name_in(names))(value, where)
        places = tuple(names.index(name) for name in found)
        pure.well_formed(all(a < b for a, b in pairwise(places)), f"{where}: not in the order of the freedoms")
        return places

    return reader


def a_rank_proof(value: Any, where: str) -> RankProof:
    """A minor and a null space."""
    rank, *lists, space = pure.an_object(value, where, "rank rows columns null_space")
    number = pure.a_number(rank, f"{where}.rank")
    found = []
    for key, entry in zip(("rows", "columns"), lists, strict=True):
        same = isinstance(entry, list) and len(entry) == number
        pure.well_formed(same, f"{where}.{key}: not a list of {number}")
        places = pure.a_list(pure.a_number)(entry, f"{where}.{key}")
        pure.well_formed(all(a < b for a, b in pairwise(places)), f"{where}.{key}: not in increasing order")
        found.append(places)
    null_space = pure.a_list(pure.a_list(pure.a_rational))(space, f"{where}.null_space")
    return RankProof(found[0], found[1], null_space)


# ---------------------------------------------------------------------------------------------------------------------
# Matrices
# ---------------------------------------------------------------------------------------------------------------------

Way: TypeAlias = list[tuple[int, int]]
"""Joints by their places, each with 1 or -1 for the direction in which it is passed."""


def loops_of(mechanism: Mechanism) -> tuple[list[Way], Way]:
    """The loops, and the way from the base to the platform."""
    forest: dict[str, list[tuple[str, int, int]]] = {body: [] for body in mechanism.bodies}
    part = {body: body for body in mechanism.bodies}
    loops = []
    for place, joint in enumerate(mechanism.joints):
        one, other = joint.ends
        if part[one] == part[other]:
            loops.append([*way(forest, other, one), (place, 1)])
            continue
        forest[one].append((other, place, 1))
        forest[other].append((one, place, -1))
        kept, gone = part[one], part[other]
        part = {body: kept if where == gone else where for body, where in part.items()}
    return loops, way(forest, mechanism.base, mechanism.platform)


def way(forest: Mapping[str, Sequence[tuple[str, int, int]]], start: str, end: str) -> Way:
    """The only way in a forest from one body to another."""
    pure.spend(1000 * len(forest))
    stack: list[tuple[str, str, Way]] = [(start, "", [])]
    while stack:
        body, before, path = stack.pop()
        if body == end:
            return path
        for following, place, sign in forest[body]:
            if following != before:
                stack.append((following, body, [*path, (place, sign)]))
    raise pure.Refusal("malformed", "mechanism: a body is not connected with the base")


def block(mechanism: Mechanism, path: Way) -> list[list[Fraction]]:
    """The six rows of a way."""
    signs = dict(path)
    columns = [
        [signs.get(place, 0) * value for value in twist]
        for place, joint in enumerate(mechanism.joints)
        for twist in joint.twists
    ]
    pure.spend(6000 * len(columns))
    return [[Fraction(column[k]) for column in columns] for k in range(6)]


def longest(rows: Sequence[Sequence[Fraction]]) -> int:
    """Bits of the longest numerator or denominator."""
    numbers = (part for row in rows for x in row for part in (x.numerator, x.denominator))
    return pure.most_bits(numbers)


def whole(row: Sequence[Fraction | int]) -> Integers:
    """A multiple of a row in integers without a common factor."""
    denominator = lcm(*(x.denominator for x in row))
    found = [x.numerator * (denominator // x.denominator) for x in row]
    divisor = gcd(*found)
    return [x // divisor for x in found] if divisor > 1 else found


def echelon(rows: Sequence[Sequence[Fraction | int]]) -> list[tuple[int, Integers]]:
    """Rows in integers that span the same, each with the place at which it begins; later rows are 0 there."""
    found: list[tuple[int, Integers]] = []
    for row in rows:
        rest = reduced(whole(row), found)
        place = next((k for k, value in enumerate(rest) if value), None)
        if place is not None:
            found.append((place, rest))
    return found


def reduced(row: Integers, eliminated: Sequence[tuple[int, Integers]]) -> Integers:
    """A multiple of the row, not 0 times, less multiples of eliminated ones, 0 at their places."""
    for place, other in eliminated:
        if row[place]:
            bits = pure.most_bits(row) + pure.most_bits(other)
            pure.spend(len(row) * (400 + 3 * pure.product_cost(bits, bits)))
            factor, lead = row[place], other[place]
            row = [lead * x - factor * y for x, y in zip(row, other, strict=True)]
            divisor = gcd(*row)
            if divisor > 1:
                row = [x // divisor for x in row]
    return row


def rank_of(rows: Sequence[Sequence[Fraction]]) -> int:
    """The rank."""
    return len(echelon(rows)) if rows and rows[0] else 0


def applied(rows: Sequence[Sequence[Fraction]], x: Sequence[Fraction]) -> list[Fraction]:
    """A x."""
    terms = sum(1 for value in x if value)
    pure.spend(len(rows) * (300 * len(x) + terms * pure.fraction_cost(longest(rows), longest([x]))))
    return [sum((a * b for a, b in zip(row, x, strict=True) if a and b), Fraction(0)) for row in rows]


def proved(proof: RankProof, rows: Sequence[Sequence[Fraction]], size: int, where: str) -> list[Row]:
    """The null space of a matrix with columns of this number, if the proof shows it."""
    inside = all(place < len(rows) for place in proof.rows) and all(place < size for place in proof.columns)
    pure.well_formed(inside, f"{where}: a place outside the matrix")
    free = sorted(set(range(size)) - set(proof.columns))
    fits = len(proof.null_space) == len(free) and all(len(x) == size for x in proof.null_space)
    pure.well_formed(fits, f"{where}.null_space: not a vector for each other column")
    for own, x in zip(free, proof.null_space, strict=True):
        units = all(x[place] == int(place == own) for place in free)
        pure.require(units, f"{where}.null_space: not 1 at its own column and 0 at the others")
    for x in proof.null_space:
        pure.require(not any(applied(rows, x)), f"{where}.null_space: not in the null space")
    minor = [[rows[i][j] for j in proof.columns] for i in proof.rows]
    pure.require(rank_of(minor) == len(minor), f"{where}: the minor is 0")
    return list(proof.null_space)


def twists_at(rows: Sequence[Sequence[Fraction]], motions: Sequence[Row]) -> list[list[Fraction]]:
    """The six rows of the platform's twist in motions."""
    columns = [applied(rows, x) for x in motions]
    return [[column[k] for column in columns] for k in range(6)]


# ---------------------------------------------------------------------------------------------------------------------
# Sets
# ---------------------------------------------------------------------------------------------------------------------


class Sets(NamedTuple):
    """Sets of freedoms by their places, and whether they are called all."""

    complete: bool
    sets: tuple[tuple[int, ...], ...]


def actuator_sets(value: Any, names: Sequence[str]) -> tuple[tuple[int, ...], dict[str, Sets]]:
    """Among which freedoms sets were looked for, and those found."""
    among, *lists = pure.an_object(value, "actuator_sets", "among platform mechanism")
    chosen = in_order(names)(among, "actuator_sets.among")
    found = {}
    for key, entry in zip(("platform", "mechanism"), lists, strict=True):
        where = f"actuator_sets.{key}"
        complete, sets = pure.an_object(entry, where, "complete sets")
        pure.well_formed(isinstance(complete, bool), f"{where}.complete: neither true nor false")
        pure.affordable(not isinstance(sets, list) or len(sets) <= MAX_SETS, f"{where}.sets: more than {MAX_SETS}")
        read = pure.a_list(in_order(names))(sets, f"{where}.sets")
        ordered = all((len(a), a) < (len(b), b) for a, b in pairwise(read))
        pure.well_formed(ordered, f"{where}.sets: not in their order")
        inside = all(place in chosen for places in read for place in places)
        pure.well_formed(inside, f"{where}.sets: a freedom that is not among those looked at")
        found[key] = Sets(complete, read)
    return chosen, found


def check_sets(key: str, claimed: Sets, among: Sequence[int], speeds: Sequence[Row], wanted: Sequence[Row]) -> str:
    """The line of a list of sets."""
    where = f"actuator_sets.{key}"
    rows = {place: whole(speeds[place]) for place in among if any(speeds[place])}
    aims = [aim for _, aim in echelon([row for row in wanted if any(row)])] if wanted and wanted[0] else []

    def hold(places: Sequence[int]) -> bool:
        basis: list[tuple[int, Integers]] = []
        for place in places:
            extend(basis, rows.get(place, [0]))
        return not any(any(reduced(aim, basis)) for aim in aims)

    def is_minimal(places: Sequence[int]) -> bool:
        return not any(hold([place for place in places if place != left]) for left in places)

    for places in claimed.sets:
        pure.require(hold(places), f"{where}: a set that does not hold it")
        pure.require(is_minimal(places), f"{where}: a set that is not minimal")
    number = len(claimed.sets)
    if not claimed.complete:
        return f"{key} sets: {number} minimal sets hold it, there may be others"
    known = set(claimed.sets)
    for places in candidates(rows, aims):
        pure.require(places in known or not is_minimal(places), f"{where}: not all minimal sets")
    return f"{key} sets: {number} minimal sets hold it, there is no other among {len(among)} freedoms"


def extend(basis: list[tuple[int, Integers]], row: Integers) -> bool:
    """Add a row to eliminated ones, if it is independent of them."""
    if not any(row):
        return False
    rest = reduced(row, basis)
    place = next((k for k, value in enumerate(rest) if value), None)
    if place is None:
        return False
    basis.append((place, rest))
    return True


def candidates(rows: Mapping[int, Integers], aims: Sequence[Integers]) -> Iterator[tuple[int, ...]]:
    """Independent sets that hold, and no part of which that comes first does: all minimal sets are among them."""
    order = sorted(rows)
    stack: list[tuple[tuple[int, ...], list[tuple[int, Integers]], list[Integers]]] = [((), [], list(aims))]
    while stack:
        places, basis, left = stack.pop()
        if not left:
            yield places
            continue
        pure.spend(5000)
        for place in order:
            if places and place <= places[-1]:
                continue
            larger = list(basis)
            if extend(larger, rows[place]):
                rest = [aim for aim in (reduced(aim, larger[-1:]) for aim in left) if any(aim)]
                stack.append(((*places, place), larger, rest))


# ---------------------------------------------------------------------------------------------------------------------
# Finite mobility
# ---------------------------------------------------------------------------------------------------------------------


class Leg(NamedTuple):
    """A leg: names of its joints from the base to the platform, and where it is cut."""

    joints: tuple[str, ...]
    cut: int


def finite_argument(value: Any, names: Sequence[str]) -> tuple[str, tuple[Leg, ...]] | None:
    """The argument for the finite mobility."""
    if value is None:
        return None
    word, legs = pure.an_object(value, "finite", "argument legs")
    argument = pure.one_of(("regular", "subgroups"))(word, "finite.argument")

    read = some_legs(names)(legs, "finite.legs")
    pure.well_formed(bool(read) == (argument == "subgroups"), "finite.legs: not those of the argument")
    return argument, read


def some_legs(names: Sequence[str]) -> pure.Reader:
    """The reader of a list of legs."""

    def a_leg(entry: Any, where: str) -> Leg:
        joints, cut = pure.an_object(entry, where, "joints cut")
        read = pure.a_list(name_in(names))(joints, f"{where}.joints")
        return Leg(read, pure.a_number(cut, f"{where}.cut"))

    return pure.a_list(a_leg)


def passed(mechanism: Mechanism, path: Way) -> list[tuple[int, int]]:
    """The places of the one-freedom joints in the order in which they are passed, with 1 or -1."""
    starts = [0]
    for joint in mechanism.joints:
        starts.append(starts[-1] + len(joint.twists))
    found = []
    for place, sign in path:
        found += [(k, sign) for k in range(starts[place], starts[place + 1])[::sign]]
    return found


def along(mechanism: Mechanism, path: Way, held: Collection[int] = ()) -> list[Row]:
    """The twists of the one-freedom joints in the order in which they are passed, without those that are held."""
    twists = [twist for joint in mechanism.joints for twist in joint.twists]
    return [twists[k] for k, _ in passed(mechanism, path) if k not in held]


def canonical(rows: Sequence[Sequence[Fraction]]) -> list[Row]:
    """The reduced echelon form, with leading ones: equal spaces have equal forms."""
    eliminated = sorted(echelon(rows))
    found = []
    for number, (place, row) in enumerate(eliminated):
        rest = reduced(row, eliminated[number + 1 :])
        found.append(tuple(Fraction(x, rest[place]) for x in rest))
    return found


def product(one: Row, other: Row) -> Row:
    """The Lie product."""
    turn = cross(one[:3], other[:3])
    return (*turn, *added(cross(one[:3], other[3:]), Fraction(1), cross(one[3:], other[:3])))


def algebra(twists: Sequence[Row]) -> list[Row]:
    """The closure under the Lie product."""
    found = canonical(twists)
    while True:
        bits = longest(found)
        pure.spend(15 * 12 * pure.fraction_cost(bits, bits))
        larger = canonical([*found, *(product(a, b) for k, a in enumerate(found) for b in found[:k])])
        if len(larger) == len(found):
            return found
        found = larger


def meet(one: Sequence[Row], other: Sequence[Row]) -> list[Row]:
    """The intersection: where the annihilators of both vanish."""
    return annihilator([*annihilator(one), *annihilator(other)])


def annihilator(rows: Sequence[Row]) -> list[Row]:
    """A basis of the x with a.x = 0 for all rows a."""
    found = canonical(rows)
    places = [next(k for k, value in enumerate(row) if value) for row in found]
    basis = []
    for free in (k for k in range(6) if k not in places):
        x = [Fraction(int(k == free)) for k in range(6)]
        for place, row in zip(places, found, strict=True):
            x[place] = -row[free]
        basis.append(tuple(x))
    return basis


def check_finite(mechanism: Mechanism, loops: Sequence[Way], claim: tuple[str, tuple[Leg, ...]], rank: int) -> None:
    """Prove that the finite mobility is the instantaneous one."""
    argument, legs = claim
    if argument == "regular":
        pure.require(dimension_of_groups(mechanism, loops) == rank, "finite: the loops are not regular")
    else:
        check_legs(mechanism, legs)


def dimension_of_groups(mechanism: Mechanism, loops: Sequence[Way], held: Collection[int] = ()) -> int:
    """The sum of the dimensions of the groups of the loops."""
    return sum(len(algebra(along(mechanism, loop, held))) for loop in loops)


def check_legs(mechanism: Mechanism, legs: Sequence[Leg], held: Collection[int] = ()) -> None:
    """Prove that the legs fill groups, or products of two, and that these are transversal."""
    whole_groups: list[list[Row]] = []
    cut_legs: list[tuple[list[Row], list[Row]]] = []
    used: list[str] = []
    inner: list[str] = []
    for leg in legs:
        path, bodies = chain_of(mechanism, leg)
        used += leg.joints
        inner += bodies
        twists = along(mechanism, path, held)
        pure.well_formed(leg.cut < max(1, len(twists)), "finite.legs: a cut behind the leg's joints")
        first, second = algebra(twists[: leg.cut]), algebra(twists[leg.cut :])
        filled = rank_of([*first, *second]) == rank_of(twists)
        pure.require(filled, "finite: a leg does not fill its groups")
        if not leg.cut:
            whole_groups.append(second)
        elif (first, second) not in cut_legs:
            cut_legs.append((first, second))
    each = sorted(used) == sorted(joint.name for joint in mechanism.joints)
    pure.require(each, "finite: not every joint is in one leg")
    others = [body for body in mechanism.bodies if body not in (mechanism.base, mechanism.platform)]
    pure.require(sorted(inner) == sorted(others), "finite: not every body is in one leg")
    pure.require(are_transversal(whole_groups, cut_legs), "finite: the legs are not transversal")


def chain_of(mechanism: Mechanism, leg: Leg) -> tuple[Way, list[str]]:
    """The joints of a leg with their directions, and the bodies between them."""
    places = {joint.name: place for place, joint in enumerate(mechanism.joints)}
    bodies = [mechanism.base]
    path = []
    for name in leg.joints:
        one, other = mechanism.joints[places[name]].ends
        pure.require(bodies[-1] in (one, other), "finite: the joints of a leg are no chain")
        forward = bodies[-1] == one
        bodies.append(other if forward else one)
        path.append((places[name], 1 if forward else -1))
    pure.require(bodies[-1] == mechanism.platform, "finite: a leg does not end at the platform")
    return path, bodies[1:-1]


def are_transversal(groups: Sequence[list[Row]], cut_legs: Sequence[tuple[list[Row], list[Row]]]) -> bool:
    """Whether the codimensions sum up to that of the intersection."""
    spaces: list[list[Row]] = []
    if groups:
        common = groups[0]
        for group in groups[1:]:
            common = canonical(meet(common, group))
        spaces.append(common)
        cut_legs = [pair for pair in cut_legs if all(rank_of([*part, *common]) > len(part) for part in pair)]
    spaces += [canonical([*first, *second]) for first, second in cut_legs]
    normals = [row for space in spaces for row in annihilator(space)]
    return rank_of(normals) == len(normals)


# ---------------------------------------------------------------------------------------------------------------------
# Version 2
# ---------------------------------------------------------------------------------------------------------------------

Square: TypeAlias = list[list[Fraction]]
"""A symmetric matrix, of a quadratic form."""


class Bounds(NamedTuple):
    """Bounds of the mobility near the configuration, those of the platform, and what proves them."""

    argument: str
    mobility: tuple[int, int]
    platform: tuple[int, int]
    dependencies: tuple[Row, ...]
    above: str
    section: tuple[Row, ...]
    degree: int
    series: tuple[Row, ...]
    below: str | None = None
    held: tuple[int, ...] = ()
    legs: tuple[Leg, ...] = ()
    signs: tuple[Row, ...] = ()
    curve: tuple[tuple[Row, ...], ...] = ()
    curves: tuple[pure_mobility_ideal.Curve, ...] = ()


def some_bounds(value: Any, joints: Sequence[str], freedoms: Sequence[str]) -> Bounds:
    """The entry ``finite``."""
    word, least, most, low, high, dependencies, above, below = pure.an_object(
        value, "finite", "argument least most platform_least platform_most dependencies above below"
    )
    argument = pure.one_of(("second-order", "higher-order"))(word, "finite.argument")
    mobility = pure.a_number(least, "finite.least"), pure.a_number(most, "finite.most")
    platform = pure.a_number(low, "finite.platform_least"), pure.a_number(high, "finite.platform_most")
    some_rows = pure.a_list(pure.a_list(pure.a_rational))
    upper, section, degree, series = pure.an_object(above, "finite.above", "argument section degree series")
    pure.one_of(("rank", "cone", "definite", "order"))(upper, "finite.above.argument")
    cut, number = some_rows(section, "finite.above.section"), pure.a_number(degree, "finite.above.degree")
    terms = some_rows(series, "finite.above.series")
    numbered = 2 <= number <= MAX_DEGREE if upper in ("cone", "order") else number == 0
    fits = numbered and bool(cut) == (upper == "cone") and len(terms) == (number - 1 if upper == "order" else 0)
    pure.well_formed(fits, "finite.above: not the parts of the argument")
    known = some_rows(dependencies, "finite.dependencies")
    found = Bounds(argument, mobility, platform, known, upper, cut, number, terms)
    if below is not None:
        found = with_below(found, below, joints, freedoms)
    higher = found.above == "order" or found.below == "curve"
    pure.well_formed(higher == (argument == "higher-order"), "finite.argument: not that of its parts")
    return found


def with_below(bounds: Bounds, value: Any, joints: Sequence[str], freedoms: Sequence[str]) -> Bounds:
    """The same with the entry ``below``."""
    lower, held, legs, vectors, curve = pure.an_object(value, "finite.below", "argument locked legs vectors curve")
    pure.one_of(("regular", "subgroups", "indefinite", "curve"))(lower, "finite.below.argument")
    shut = in_order(freedoms)(held, "finite.below.locked")
    some_rows = pure.a_list(pure.a_list(pure.a_rational))
    read, signs = some_legs(joints)(legs, "finite.below.legs"), some_rows(vectors, "finite.below.vectors")
    path = pure.a_list(a_half_tangent)(curve, "finite.below.curve")
    sizes = {"regular": (False, 0, False), "subgroups": (True, 0, False), "indefinite": (False, 2, False)}
    sizes["curve"] = (False, 0, True)
    fits = (bool(read), len(signs), bool(path)) == sizes[lower] and not (shut and (signs or path))
    pure.well_formed(fits, "finite.below: not the parts of the argument")
    return bounds._replace(below=lower, held=shut, legs=read, signs=signs, curve=path)


def bounds_of_the_ideal(value: Any, joints: Sequence[str], freedoms: Sequence[str]) -> Bounds:
    """The entry ``finite`` of version 3."""
    word, least, most, low, high, dependencies, above, below = pure.an_object(
        value, "finite", "argument least most platform_least platform_most dependencies above below"
    )
    argument = pure.one_of(("ideal",))(word, "finite.argument")
    mobility = pure.a_number(least, "finite.least"), pure.a_number(most, "finite.most")
    platform = pure.a_number(low, "finite.platform_least"), pure.a_number(high, "finite.platform_most")
    some_rows = pure.a_list(pure.a_list(pure.a_rational))
    upper, section, degree = pure.an_object(above, "finite.above", "argument section degree")
    pure.one_of(("rank", "cone", "definite", "local"))(upper, "finite.above.argument")
    cut, number = some_rows(section, "finite.above.section"), pure.a_number(degree, "finite.above.degree")
    sized_right = (cut and 2 <= number <= MAX_DEGREE) if upper in ("cone", "local") else not cut and not number
    pure.well_formed(sized_right, "finite.above: not the parts of the argument")
    known = some_rows(dependencies, "finite.dependencies")
    found = Bounds(argument, mobility, platform, known, upper, cut, number, ())
    if below is not None:
        found = with_curves(found, below, joints, freedoms)
    used = found.above == "local" or found.below == "curves"
    pure.well_formed(used, "finite.argument: not that of its parts")
    return found


def with_curves(bounds: Bounds, value: Any, joints: Sequence[str], freedoms: Sequence[str]) -> Bounds:
    """The same with the entry ``below`` of version 3."""
    lower, held, legs, vectors, curves = pure.an_object(value, "finite.below", "argument locked legs vectors curves")
    pure.one_of(("regular", "subgroups", "indefinite", "curves"))(lower, "finite.below.argument")
    shut = in_order(freedoms)(held, "finite.below.locked")
    read = some_legs(joints)(legs, "finite.below.legs")
    signs = pure.a_list(pure.a_list(pure.a_rational))(vectors, "finite.below.vectors")
    paths = pure.a_list(pure_mobility_ideal.a_curve)(curves, "finite.below.curves")
    expected = (lower == "subgroups", 2 if lower == "indefinite" else 0, lower == "curves")
    locks = lower in ("regular", "subgroups") or not shut
    fits = locks and (bool(read), len(signs), bool(paths)) == expected
    pure.well_formed(fits, "finite.below: not the parts of the argument")
    return bounds._replace(below=lower, held=shut, legs=read, signs=signs, curves=paths)


def a_half_tangent(value: Any, where: str) -> tuple[Row, ...]:
    """The coefficients of numerator and denominator."""
    found: tuple[Row, ...] = pure.a_list(pure.a_list(pure.a_rational), 2)(value, where)
    fits = all(1 <= len(part) <= MAX_DEGREE for part in found)
    pure.well_formed(fits, f"{where}: not 1 to {MAX_DEGREE} coefficients")
    return found


def check_bounds(
    mechanism: Mechanism,
    loops: Sequence[Way],
    bounds: Bounds,
    matrices: Sequence[Sequence[Sequence[Fraction]]],
    motions: Sequence[Row],
    minor: RankProof,
) -> str:
    """The line of the bounds, if all is proved; ``matrices`` are M and P, ``minor`` proves the rank of M."""
    m, p = matrices
    ways = [passed(mechanism, loop) for loop in loops]
    twists = [twist for joint in mechanism.joints for twist in joint.twists]
    for u in bounds.dependencies:
        pure.well_formed(len(u) == len(m), "finite.dependencies: not a number for each equation")
        columns = [list(column) for column in zip(*m, strict=True)]
        pure.require(not any(applied(columns, u)), "finite.dependencies: not one of the equations")
    forms = [form_of(mechanism, loops, u, motions) for u in bounds.dependencies]
    if bounds.above == "order":
        check_order(mechanism, loops, bounds, len(motions))
    check_above(bounds, forms, len(motions))
    if bounds.above == "local":
        directions = [tuple(applied(list(zip(*motions, strict=True)), vector)) for vector in bounds.section]
        pure_mobility_ideal.check_local(twists, ways, m, (minor.rows, minor.columns), directions, bounds.degree)
    least, low = (0, 0)
    if bounds.below == "indefinite":
        one_more = dimension_of_groups(mechanism, loops) == len(mechanism.freedoms) - len(motions) + 1
        pure.require(one_more, "finite.below: the loops do not ask one thing more")
        right = all(len(y) == len(motions) for y in bounds.signs)
        pure.well_formed(right, "finite.below.vectors: not a number for each motion")
        both = bool(forms) and value_of(forms[0], bounds.signs[0]) > 0 > value_of(forms[0], bounds.signs[1])
        pure.require(both, "finite.below: the form has not both signs")
        least = len(motions) - 1
    elif bounds.below == "curve":
        least, low = 1, check_curve(mechanism, loops, bounds.curve, p)
    elif bounds.below == "curves":
        speeds = pure_mobility_ideal.check_curves(twists, ways, bounds.curves)
        least, low = len(speeds), rank_of([applied(p, x) for x in speeds])
    elif bounds.below is not None:
        kept = [k for k in range(len(mechanism.freedoms)) if k not in bounds.held]
        rest = [[row[k] for k in kept] for row in m]
        rank = rank_of(rest)
        if bounds.below == "regular":
            regular = dimension_of_groups(mechanism, loops, bounds.held) == rank
            pure.require(regular, "finite.below: the loops are not regular")
        else:
            check_legs(mechanism, bounds.legs, bounds.held)
        least, low = len(kept) - rank, rank_of([*rest, *([row[k] for k in kept] for row in p)]) - rank
    pure.require(bounds.mobility[0] == least, "finite.least: not the number that follows")
    pure.require(bounds.platform[0] == low, "finite.platform_least: not the number that follows")
    pure.require(bounds.platform[1] == min(bounds.mobility[1], 6), "finite.platform_most: not the number that follows")
    known = " to ".join(map(str, sorted(set(bounds.mobility))))
    return f"finite: mobility {known} near the configuration, by the argument {bounds.argument}"


def form_of(mechanism: Mechanism, loops: Sequence[Way], u: Row, motions: Sequence[Row]) -> Square:
    """Q_u: along each loop the Lie products of the sum of the x_i so far with the next one."""
    count = len(motions)
    twists = [twist for joint in mechanism.joints for twist in joint.twists]
    found = [[Fraction(0)] * count for _ in range(count)]
    for number, loop in enumerate(loops):
        weights = u[6 * number : 6 * number + 6]
        sums: list[Row] = [(Fraction(0),) * 6] * count
        for k, sign in passed(mechanism, loop):
            bits = longest([*sums, twists[k], weights]) + longest([[motion[k] for motion in motions]])
            pure.spend(count * (count + 20) * 8 * pure.fraction_cost(bits, bits))
            products = [product(done, twists[k]) for done in sums]
            values = [sum((w * x for w, x in zip(weights, each, strict=True)), Fraction(0)) for each in products]
            for a in range(count):
                for b in range(count):
                    found[a][b] += values[a] * sign * motions[b][k]
            sums = [added(done, sign * motion[k], twists[k]) for done, motion in zip(sums, motions, strict=True)]
    return [[(found[a][b] + found[b][a]) / 2 for b in range(count)] for a in range(count)]


def value_of(form: Square, y: Row) -> Fraction:
    """Q(y)."""
    return sum((a * b for a, b in zip(y, applied(form, y), strict=True)), Fraction(0))


def check_above(bounds: Bounds, forms: Sequence[Square], mobility: int) -> None:
    """Prove that the mobility near the configuration is not greater."""
    most = mobility
    if bounds.above in ("order", "definite"):
        most = 0
    elif bounds.above in ("cone", "local"):
        right = all(len(vector) == mobility for vector in bounds.section)
        pure.well_formed(right, "finite.above.section: not a number for each motion")
        most = mobility - len(bounds.section)
    pure.require(bounds.mobility[1] == most, "finite.most: not the number that follows")
    if bounds.above == "definite":
        pure.require(bool(forms) and is_positive(forms[0]), "finite.above: the form is not positive")
    elif bounds.above == "cone":
        cut = []
        for form in forms:
            images = [applied(form, vector) for vector in bounds.section]
            cut.append([applied(images, vector) for vector in bounds.section])
        proved_0 = are_all_monomials(cut, len(bounds.section), bounds.degree)
        pure.require(proved_0, "finite.above: the section of the cone may be more than 0")


Poly: TypeAlias = list[Fraction]
"""Coefficients, lowest degree first."""

HAMILTON: Final = (
    *((0, 1, 1, -1), (0, 2, 2, -1), (0, 3, 3, -1)),
    *((1, 0, 1, 1), (1, 2, 3, 1), (1, 3, 2, -1)),
    *((2, 0, 2, 1), (2, 3, 1, 1), (2, 1, 3, -1)),
    *((3, 0, 3, 1), (3, 1, 2, 1), (3, 2, 1, -1)),
)
"""Entry a of p times a vector u has the term p_b u_c with this sign: a, b, c and the sign."""


def check_order(mechanism: Mechanism, loops: Sequence[Way], bounds: Bounds, mobility: int) -> None:
    """Prove that the only curve there can be leaves the configurations at the order k."""
    pure.require(mobility == 1, "finite.above: the mobility is not 1")
    size, k = len(mechanism.freedoms), bounds.degree
    fits = all(len(term) == size for term in bounds.series)
    pure.well_formed(fits, "finite.above.series: not a number for each freedom")
    halves = [([Fraction(0), *(term[i] for term in bounds.series)], [Fraction(1)]) for i in range(size)]
    parts = closures(mechanism, loops, halves, k)
    closed = not any(any(part[:k]) for part in parts)
    pure.require(closed, "finite.above.series: does not close the loops to its order")
    left = [part[k] for part in parts]
    open_end = bool(bounds.dependencies) and any(applied([bounds.dependencies[0]], left))
    pure.require(open_end, "finite.above: the order may have a solution")


def check_curve(
    mechanism: Mechanism, loops: Sequence[Way], curve: Sequence[tuple[Row, ...]], p: Sequence[Sequence[Fraction]]
) -> int:
    """Prove that half tangents close the loops; 1 if the platform moves with their speeds, else 0."""
    pure.well_formed(len(curve) == len(mechanism.freedoms), "finite.below.curve: not a pair for each freedom")
    begins = all(numerator[0] == 0 != denominator[0] for numerator, denominator in curve)
    pure.require(begins, "finite.below.curve: does not begin at the configuration")
    pure.require(any(any(numerator) for numerator, _ in curve), "finite.below.curve: does not move")
    halves = [(list(numerator), list(denominator)) for numerator, denominator in curve]
    closed = not any(any(part) for part in closures(mechanism, loops, halves, None))
    pure.require(closed, "finite.below.curve: does not close the loops")
    speeds = [sum(numerator[1:2], Fraction(0)) / denominator[0] for numerator, denominator in curve]
    return int(any(applied(p, speeds)))


def closures(
    mechanism: Mechanism, loops: Sequence[Way], halves: Sequence[tuple[Poly, Poly]], order: int | None
) -> list[Poly]:
    """The six vector parts of each loop, up to an order if there is one."""
    twists = [twist for joint in mechanism.joints for twist in joint.twists]
    found = []
    for loop in loops:
        product: list[Poly] = [[Fraction(1)]] + [[Fraction(0)] for _ in range(7)]
        for k, sign in passed(mechanism, loop):
            w, v = ([sign * x for x in half] for half in (twists[k][:3], twists[k][3:]))
            straight = sum((a * b for a, b in zip(w, v, strict=True)), Fraction(0)) == 0
            pure.require(straight, "finite: a screw of a loop has a pitch")
            real, dual = product[:4], product[4:]
            turned = [*hamilton(((real, w),)), *hamilton(((real, v), (dual, w)))]
            numerator, denominator = halves[k]
            product = [
                combined(multiplied(a, denominator, order), multiplied(b, numerator, order))
                for a, b in zip(product, turned, strict=True)
            ]
        found += [*product[1:4], *product[5:8]]
    return found


def hamilton(products: Sequence[tuple[Sequence[Poly], Sequence[Fraction]]]) -> list[Poly]:
    """The sum of quaternions times vectors."""
    found: list[Poly] = [[], [], [], []]
    for p, u in products:
        for a, b, c, sign in HAMILTON:
            found[a] = combined(found[a], [sign * u[c - 1] * x for x in p[b]])
    return found


def combined(a: Sequence[Fraction], b: Sequence[Fraction]) -> Poly:
    """The sum of polynomials."""
    pure.spend((len(a) + len(b)) * 2 * pure.fraction_cost(longest([a]), longest([b])))
    return [x + y for x, y in zip_longest(a, b, fillvalue=Fraction(0))]


def multiplied(a: Sequence[Fraction], b: Sequence[Fraction], order: int | None) -> Poly:
    """The product of polynomials, up to an order if there is one."""
    pure.spend(len(a) * len(b) * 2 * pure.fraction_cost(longest([a]), longest([b])))
    found = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            found[i + j] += x * y
    return found if order is None else found[: order + 1]


def is_positive(form: Square) -> bool:
    """Whether completing squares, one coordinate after another, gives positive ones only, for all coordinates."""
    rows = [list(row) for row in form]
    while rows:
        bits = longest(rows)
        pure.spend(len(rows) ** 2 * 3 * pure.fraction_cost(bits, bits))
        first, *others = rows
        if first[0] <= 0:
            return False
        rows = [[x - row[0] / first[0] * y for x, y in zip(row[1:], first[1:], strict=True)] for row in others]
    return True


def are_all_monomials(forms: Sequence[Square], count: int, degree: int) -> bool:
    """Whether all monomials of a degree are combinations of products of monomials with forms."""
    number = comb(count + degree - 1, degree)
    pure.affordable(number <= MAX_MONOMIALS, f"finite.above: more than {MAX_MONOMIALS} monomials")
    names = {name: place for place, name in enumerate(combinations_with_replacement(range(count), degree))}
    rows = []
    for form in forms:
        for others in combinations_with_replacement(range(count), degree - 2):
            pure.spend(1000 * number)
            row = [Fraction(0)] * number
            for a, b in combinations_with_replacement(range(count), 2):
                row[names[tuple(sorted((a, b, *others)))]] = form[a][b] * (1 if a == b else 2)
            rows.append(whole(row))
    return rank_modulo(rows, PRIME) == number or len(echelon(rows)) == number


def rank_modulo(rows: Sequence[Integers], p: int) -> int:
    """The rank modulo a prime: that over the rational numbers is not less."""
    found: list[tuple[int, Integers]] = []
    for row in rows:
        pure.spend(len(row) * (300 + pure.division_cost(pure.most_bits(row), 61)) + len(found) * len(row) * 200)
        rest = [x % p for x in row]
        for place, other in found:
            if rest[place]:
                factor = rest[place]
                rest = [(x - factor * y) % p for x, y in zip(rest, other, strict=True)]
        place = next((k for k, x in enumerate(rest) if x), -1)
        if place >= 0:
            inverse = pow(rest[place], -1, p)
            found.append((place, [x * inverse % p for x in rest]))
    return len(found)


# ---------------------------------------------------------------------------------------------------------------------
# The checks
# ---------------------------------------------------------------------------------------------------------------------


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    version = body.get("version")
    known = body.get("format") == FORMAT and type(version) is int and version in (1, 2, 3)
    pure.well_formed(known, f"format: not a {FORMAT}, version 1, 2 or 3")
    content = dict(zip(KEYS.split(), pure.an_object(body, "certificate", KEYS), strict=True))
    mechanism = a_mechanism(content["mechanism"])
    names = [joint.name for joint in mechanism.joints]
    finite: tuple[str, tuple[Leg, ...]] | Bounds | None
    if version == 1:
        finite = finite_argument(content["finite"], names)
    elif version == 3:
        finite = bounds_of_the_ideal(content["finite"], names, mechanism.freedoms)
    else:
        finite = some_bounds(content["finite"], names, mechanism.freedoms)
    among, sets = actuator_sets(content["actuator_sets"], mechanism.freedoms)
    counts = dict(zip(COUNTS.split(), pure.an_object(content["mobility"], "mobility", COUNTS), strict=True))
    actuated = in_order(mechanism.freedoms)(content["actuated"], "actuated")
    keys = ("loops", "platform", "locked_loops", "locked_platform")
    proofs = {key: a_rank_proof(content[key], key) for key in keys}
    claimed = {key: pure.an_integer(value, f"mobility.{key}") for key, value in counts.items()}
    return checks(mechanism, actuated, proofs, claimed, among, sets, finite)


def checks(
    mechanism: Mechanism,
    actuated: Sequence[int],
    proofs: Mapping[str, RankProof],
    claimed: Mapping[str, int],
    among: Sequence[int],
    sets: Mapping[str, Sets],
    finite: tuple[str, tuple[Leg, ...]] | Bounds | None,
) -> Iterator[str]:
    """One line per claim that is proved."""
    loops, path = loops_of(mechanism)
    size = len(mechanism.freedoms)
    matrix = [row for loop in loops for row in block(mechanism, loop)]
    platform = block(mechanism, path)
    motions = proved(proofs["loops"], matrix, size, "loops")
    rank, free = size - len(motions), len(motions)
    yield f"loops: rank {rank} of {len(matrix)} equations in {size} freedoms, mobility {free}"
    twists = twists_at(platform, motions)
    moving = free - len(proved(proofs["platform"], twists, free, "platform"))
    yield f"platform: {moving} freedoms"
    units = [[Fraction(int(k == place)) for k in range(size)] for place in actuated]
    left = proved(proofs["locked_loops"], [*matrix, *units], size, "locked_loops")
    rest = twists_at(platform, left)
    still = len(left) - len(proved(proofs["locked_platform"], rest, len(left), "locked_platform"))
    yield f"actuators: {len(actuated)} locked leave mobility {len(left)}, of the platform {still}"
    counted = 6 * (len(mechanism.bodies) - 1 - len(mechanism.joints)) + size
    found = (free, moving, counted, len(matrix) - rank, len(left), still)
    for key, value in zip(COUNTS.split(), found, strict=True):
        pure.require(claimed[key] == value, f"mobility.{key}: not the number that follows")
    yield f"mobility: {free}, by the formula of Gruebler and Kutzbach {counted}"
    speeds = [tuple(x[k] for x in motions) for k in range(size)]
    every = [tuple(Fraction(int(i == j)) for j in range(free)) for i in range(free)]
    yield check_sets("platform", sets["platform"], among, speeds, [tuple(row) for row in twists])
    yield check_sets("mechanism", sets["mechanism"], among, speeds, every)
    if finite is None:
        yield "finite: nothing is claimed"
        return
    if isinstance(finite, Bounds):
        yield check_bounds(mechanism, loops, finite, (matrix, platform), motions, proofs["loops"])
        return
    check_finite(mechanism, loops, finite, rank)
    yield f"finite: mobility {free} near the configuration, by the argument {finite[0]}"

"""Checks certificates of what a machine can do at all poses of a box, with Python's integers and nothing else.

The part of the plain checker that ``pure_statics.py``, beside this file, uses for version 2. Written from the
definition of the format, ``docs/certificates-statics.md``; the functions below have its order and its notation. It
shares no line with the other checker. Intervals are those of ``pure.py``, with ends in steps of 2^-P.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import comb
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure, pure_statics
    from pkm_exact.certify.pure import Interval
else:
    import pure
    import pure_statics
    from pure import Interval

__all__ = ["replayed"]

KEYS: Final = (
    "format version name unit solution metric freedoms position rotation legs constraints free speeds forces length "
    "load jacobian expansion actuator_forces velocity_polytope wrench_polytope ellipsoid indices"
)
MAX_CONSTRAINTS: Final = 5
MAX_CHOICES: Final = 20_000
P: Final = 320
ONE: Final = 1 << P
SHORT: Final = 80
"""Bits of the numbers that approximate inverses are computed with."""

Ends: TypeAlias = tuple[Fraction, Fraction]
Row: TypeAlias = tuple[Fraction, ...]
Line: TypeAlias = list[Interval]
Sides: TypeAlias = tuple[tuple[int, int], ...]


@dataclass(frozen=True)
class Machine:
    """What is not a claim: metric, box, legs, forms, limits; legs are counted from 0, free components as places."""

    metric: tuple[int, ...]
    freedoms: tuple[int, ...]
    position: Line
    rotation: list[Line]
    legs: list[tuple[Row, Row, Row | None]]
    forms: list[Row]
    free: list[int]


@dataclass(frozen=True)
class Listed:
    """P and E as they are listed, and limits."""

    p: list[Line]
    e: list[Line]
    speeds: Row | None
    forces: list[Ends] | None
    length: Fraction | None
    load: Row | None


# ---------------------------------------------------------------------------------------------------------------------
# Intervals
# ---------------------------------------------------------------------------------------------------------------------


def interval(low: Fraction, high: Fraction | None = None) -> Interval:
    """Around a number, or from one to another, outward."""
    top = low if high is None else high
    return Interval((low.numerator << P) // low.denominator, -((-top.numerator << P) // top.denominator), P)


def whole(value: int) -> Interval:
    """An integer, exactly."""
    return Interval(value << P, value << P, P)


def total(terms: Iterable[Interval]) -> Interval:
    """The sum."""
    found = whole(0)
    for term in terms:
        found = found + term
    return found


def scalar(left: Sequence[Interval], right: Sequence[Interval]) -> Interval:
    """The sum of products."""
    return total(a * b for a, b in zip(left, right, strict=True))


def negative(value: Interval) -> Interval:
    """The opposite numbers."""
    return Interval(-value.high, -value.low, P)


def size(value: Interval) -> Interval:
    """Around the absolute values."""
    return Interval(max(value.low, -value.high), max(value.high, -value.low), P)


def lies_in(value: Interval, ends: Ends) -> bool:
    """Whether all its numbers are between two rational ones."""
    low, high = ends
    return low.numerator << P <= value.low * low.denominator and value.high * high.denominator <= high.numerator << P


def lie_in(values: Sequence[Interval], ends: Sequence[Ends]) -> bool:
    """The same for all."""
    return all(lies_in(value, pair) for value, pair in zip(values, ends, strict=True))


def column(rows: Sequence[Line], k: int) -> Line:
    """A column of a matrix."""
    return [row[k] for row in rows]


def solved(a: list[Line], b: list[Line]) -> list[Line] | None:
    """Around A^-1 B for all matrices in the intervals; None if it is not shown that all A are regular.

    With Y near A^-1 and D = 1 - Y A, the solution is X = Y B + D X, so that |X - Y B| <= r / (1 - r) max |Y B| for the
    norm r < 1 of D by rows.
    """
    n = len(a)
    near = approximate_inverse(a)
    if near is None:
        return None
    y = [[interval(x) for x in row] for row in near]
    d = [[whole(int(i == j)) - scalar(y[i], column(a, j)) for j in range(n)] for i in range(n)]
    norm = max(sum(entry.largest() for entry in row) for row in d)
    if 2 * norm >= ONE:
        return None
    columns = []
    for k in range(len(b[0])):
        start = [scalar(row, column(b, k)) for row in y]
        most = max(entry.largest() for entry in start)
        room = -(-norm * most // (ONE - norm))
        x = [Interval(entry.low - room, entry.high + room, P) for entry in start]
        for _ in range(2):
            x = [entry + scalar(row, x) for entry, row in zip(start, d, strict=True)]
        columns.append(x)
    return [[x[i] for x in columns] for i in range(n)]


def approximate_inverse(a: list[Line]) -> list[list[Fraction]] | None:
    """Of the middles, rounded: whatever it is, nothing false follows from it."""
    middles = [[(entry.low + entry.high) >> 1 for entry in row] for row in a]
    shift = max(max(abs(x).bit_length() for row in middles for x in row) - SHORT, 0)
    pure.spend(100_000 * len(a) ** 3)
    found = pure_statics.inverted([[Fraction(x >> shift) for x in row] for row in middles])
    return found and [[x * Fraction(1 << P, 1 << shift) for x in row] for row in found]


def determinant(rows: Sequence[Line]) -> Interval:
    """Of a square matrix A: as a sum of products; and, with Y near A^-1, as that of Y A, near 1, by that of Y."""
    expanded = expansion_of(rows)
    near = approximate_inverse(list(rows)) if len(rows) > 2 else None
    if near is None:
        return expanded
    scale = interval(pure_statics.determinant([list(row) for row in near]))
    if scale.contains_zero():
        return expanded
    y = [[interval(x) for x in row] for row in near]
    unit = [[scalar(row, column(rows, j)) for j in range(len(rows))] for row in y]
    other = expansion_of(unit).over(scale)
    return Interval(max(expanded.low, other.low), min(expanded.high, other.high), P)


def expansion_of(rows: Sequence[Line]) -> Interval:
    """The determinant by expansion along one row after another: places are sums of 2^j for columns j."""
    found = {0: whole(1)}
    for row in rows:
        larger: dict[int, Interval] = {}
        for chosen, value in found.items():
            for j in range(len(rows)):
                if not chosen >> j & 1:
                    term = row[j] * value
                    term = negative(term) if (chosen >> j).bit_count() % 2 else term
                    place = chosen | 1 << j
                    larger[place] = larger[place] + term if place in larger else term
        found = larger
    return found[(1 << len(rows)) - 1]


# ---------------------------------------------------------------------------------------------------------------------
# Reading
# ---------------------------------------------------------------------------------------------------------------------


def ends_of(value: Any, where: str) -> Ends:
    """An interval."""
    low, high = pure_statics.vector(value, where, 2)
    pure.well_formed(low <= high, f"{where}: the ends are not in order")
    return low, high


def row_of(value: Any, where: str, length: int) -> list[Ends]:
    """So many intervals."""
    return [ends_of(x, f"{where}[{k}]") for k, x in enumerate(pure_statics.entries_of(value, where, length), 1)]


def table_of(value: Any, where: str, height: int, width: int) -> list[list[Ends]]:
    """Rows of intervals."""
    rows = pure_statics.entries_of(value, where, height)
    return [row_of(row, f"{where}[{k}]", width) for k, row in enumerate(rows, 1)]


def places_of(value: Any, where: str, known: Sequence[int]) -> tuple[int, ...]:
    """Increasing numbers of those known."""
    pure.well_formed(isinstance(value, list) and value, f"{where}: not a list of 1 or more")
    good = all(type(x) is int and x in known for x in value) and value == sorted(set(value))
    pure.well_formed(good, f"{where}: not increasing numbers of those that there are")
    return tuple(value)


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    values = dict(zip(KEYS.split(), pure_statics.fields(body, "certificate", KEYS), strict=True))
    for where in ("name", "unit"):
        text_of(values[where], where)
    if values["solution"] is not None:
        digest, pose = pure_statics.fields(values["solution"], "solution", "digest pose")
        text_of(digest, "solution.digest")
        pure.well_formed(type(pose) is int and pose >= 1, "solution.pose: not a number from 1")
    machine = read_machine(values)
    m, n, f = len(machine.legs), len(machine.freedoms), len(machine.free)
    speeds = None if values["speeds"] is None else pure_statics.vector(values["speeds"], "speeds", m)
    pure.well_formed(speeds is None or min(speeds) > 0, "speeds: one is not positive")
    forces = None if values["forces"] is None else row_of(values["forces"], "forces", m)
    good = forces is None or all(low < high for low, high in forces)
    pure.well_formed(good, "forces: a least one is not below the greatest")
    length = None if values["length"] is None else pure_statics.rational(values["length"], "length")
    pure.well_formed(length is None or length > 0, "length: not positive")
    load = None if values["load"] is None else pure_statics.vector(values["load"], "load", n)
    p = table_of(values["jacobian"], "jacobian", m, f)
    e = table_of(values["expansion"], "expansion", n, f)
    needs = {"velocity_polytope": speeds, "ellipsoid": speeds, "wrench_polytope": forces, "actuator_forces": load}
    for name, limit in needs.items():
        pure.well_formed(values[name] is None or limit is not None, f"{name}: its limits or the load are missing")
    borne = None if load is None else row_of(values["actuator_forces"], "actuator_forces", m)
    claims = (
        borne,
        None if values["velocity_polytope"] is None else read_velocity(values["velocity_polytope"], m, f),
        None if values["wrench_polytope"] is None else read_wrench(values["wrench_polytope"], m, f),
        None if values["ellipsoid"] is None else read_ellipsoid(values["ellipsoid"], m, f),
        None if values["indices"] is None else pure_statics.read_indices(values["indices"]),
    )
    intervals = [[[interval(*pair) for pair in row] for row in rows] for rows in (p, e)]
    listed = Listed(intervals[0], intervals[1], speeds, forces, length, load)
    return checks(machine, (p, e), listed, claims)


def text_of(value: Any, where: str) -> None:
    """A text that is not too long."""
    pure.well_formed(isinstance(value, str), f"{where}: not a text")
    pure.affordable(len(value) <= pure.MAX_TEXT, f"{where}: more than {pure.MAX_TEXT} characters")


def read_machine(values: dict[str, Any]) -> Machine:
    """Legs, forms and the box."""
    metric = pure_statics.integers(values["metric"], "metric", 3)
    pure.well_formed(min(metric) > 0, "metric: one is not positive")
    freedoms = places_of(values["freedoms"], "freedoms", range(6))
    position = row_of(values["position"], "position", 3)
    rotation = table_of(values["rotation"], "rotation", 3, 3)
    legs = []
    for k, leg in enumerate(pure_statics.list_of(values["legs"], "legs", pure_statics.MAX_LEGS), 1):
        a, b, way = pure_statics.fields(leg, f"legs[{k}]", "base platform direction")
        joints = [pure_statics.vector(x, f"legs[{k}].{name}", 3) for x, name in ((a, "base"), (b, "platform"))]
        direction = None if way is None else pure_statics.vector(way, f"legs[{k}].direction", 3)
        legs.append((joints[0], joints[1], direction))
    listed = pure_statics.list_of(values["constraints"], "constraints", MAX_CONSTRAINTS)
    forms = [pure_statics.vector(form, f"constraints[{k}]", 17) for k, form in enumerate(listed, 1)]
    free = places_of(values["free"], "free", freedoms)
    pure.well_formed(len(free) == len(freedoms) - len(forms), "free: not as many as freedoms less constraints")
    pure.well_formed(len(legs) >= len(free), "legs: fewer than free components")
    box = [interval(*pair) for pair in position], [[interval(*pair) for pair in row] for row in rotation]
    return Machine(metric, freedoms, *box, legs, forms, [freedoms.index(k) for k in free])


def sides_of(value: Any, where: str, m: int) -> Sides:
    """Sides of legs, counted from 0."""
    found = []
    for k, entry in enumerate(value, 1):
        leg, side = pure_statics.integers(entry, f"{where}[{k}]", 2, range(-1, m + 1))
        pure.well_formed(leg >= 1 and side in (-1, 1), f"{where}[{k}]: not a leg and a side")
        found.append((leg - 1, side))
    return tuple(found)


def read_velocity(
    value: Any, m: int, f: int, where: str = "velocity_polytope"
) -> tuple[Sides, list[tuple[Sides, list[Ends]]], Ends | None]:
    """Facets, vertices, volume."""
    most = pure_statics.MAX_VERTICES
    facets, vertices, volume = pure_statics.fields(value, where, "facets vertices volume")
    sides = sides_of(pure_statics.list_of(facets, f"{where}.facets", most), f"{where}.facets", m)
    points = []
    for k, vertex in enumerate(pure_statics.list_of(vertices, f"{where}.vertices", most), 1):
        place = f"{where}.vertices[{k}]"
        meeting, at = pure_statics.fields(vertex, place, "sides at")
        chosen = sides_of(pure_statics.entries_of(meeting, f"{place}.sides", f), f"{place}.sides", m)
        good = all(chosen[j][0] < chosen[j + 1][0] for j in range(f - 1))
        pure.well_formed(good, f"{place}.sides: legs are not increasing")
        points.append((chosen, row_of(at, f"{place}.at", f)))
    pure.well_formed((volume is None) == (m > f), f"{where}.volume: is not there, or should not be")
    return sides, points, None if volume is None else ends_of(volume, f"{where}.volume")


def read_wrench(
    value: Any, m: int, f: int, where: str = "wrench_polytope"
) -> tuple[list[tuple[Any, ...]], list[tuple[int, ...]], Ends]:
    """Facets as legs, side, normal and offset; vertices as ends of the forces; volume."""
    most = pure_statics.MAX_VERTICES
    facets, vertices, volume = pure_statics.fields(value, where, "facets vertices volume")
    planes = []
    for k, facet in enumerate(pure_statics.list_of(facets, f"{where}.facets", most), 1):
        place = f"{where}.facets[{k}]"
        legs, side, normal, offset = pure_statics.fields(facet, place, "legs side normal offset")
        chosen = pure_statics.integers(legs, f"{place}.legs", f - 1, range(1, m + 1))
        pure.well_formed(list(chosen) == sorted(set(chosen)), f"{place}.legs: not increasing")
        pure.well_formed(type(side) is int and side in (1, -1), f"{place}.side: not 1 or -1")
        normals, reach = row_of(normal, f"{place}.normal", f), ends_of(offset, f"{place}.offset")
        planes.append((tuple(leg - 1 for leg in chosen), side, normals, reach))
    ends = []
    for k, vertex in enumerate(pure_statics.list_of(vertices, f"{where}.vertices", most), 1):
        found = pure_statics.integers(vertex, f"{where}.vertices[{k}]", m, range(-1, 2))
        pure.well_formed(0 not in found, f"{where}.vertices[{k}]: 0 is no end")
        ends.append(found)
    return planes, ends, ends_of(volume, f"{where}.volume")


def read_ellipsoid(value: Any, m: int, f: int) -> tuple[Row, list[Row], Fraction]:
    """Weights, matrix, gap."""
    weights, matrix, gap = pure_statics.fields(value, "ellipsoid", "weights matrix gap")
    lines = pure_statics.entries_of(matrix, "ellipsoid.matrix", f)
    rows = [pure_statics.vector(line, f"ellipsoid.matrix[{k}]", f) for k, line in enumerate(lines, 1)]
    part = pure_statics.rational(gap, "ellipsoid.gap")
    pure.well_formed(0 <= part < 1, "ellipsoid.gap: not from 0 to below 1")
    return pure_statics.vector(weights, "ellipsoid.weights", m), rows, part


# ---------------------------------------------------------------------------------------------------------------------
# Checks
# ---------------------------------------------------------------------------------------------------------------------


def checks(
    machine: Machine, bounds: tuple[list[list[Ends]], list[list[Ends]]], listed: Listed, claims: tuple[Any, ...]
) -> Iterator[str]:
    """One line for each claim that is proved."""
    borne, velocity, wrench, ellipsoid, indices = claims
    m, f = len(machine.legs), len(machine.free)
    for name, claim, number in (("velocity_polytope", velocity, f), ("wrench_polytope", wrench, f - 1)):
        few = claim is None or comb(m, number) << f <= MAX_CHOICES
        pure.affordable(few, f"{name}: too many choices of legs")
    check_rows(machine, *bounds)
    yield f"machine: {m} legs in a box of poses, {f} freedoms, J in its bounds"
    if borne is not None and listed.load is not None:
        check_forces(listed, listed.load, borne)
        yield "forces: those that bear the load, within their bounds"
    if velocity is not None and listed.speeds is not None:
        check_velocity(listed.p, both_ways(listed.speeds), *velocity)
        yield f"velocity polytope: {len(velocity[1])} vertices, {len(velocity[0])} facets, and no others"
    if wrench is not None and listed.forces is not None:
        check_wrench(listed.p, listed.forces, *wrench)
        yield f"wrench polytope: {len(wrench[1])} vertices, {len(wrench[0])} facets, and no others"
    if ellipsoid is not None and listed.speeds is not None:
        check_ellipsoid(listed, listed.speeds, *ellipsoid)
        yield "ellipsoid: in the velocity polytope, and no larger one but for the part that is said"
    if indices is not None:
        check_indices(listed, machine.freedoms, indices)
        yield "indices: singular values and condition within their bounds"


def check_rows(machine: Machine, p: list[list[Ends]], e: list[list[Ends]]) -> None:
    """Check 1."""
    h = [whole(g).root() for g in machine.metric]
    n, free = len(machine.freedoms), machine.free
    others = [k for k in range(n) if k not in free]
    expansion = [[whole(int(k == place)) for place in free] for k in range(n)]
    if others:
        rows = [form_row(form, h, machine) for form in machine.forms]
        v, u = ([[row[k] for k in places] for row in rows] for places in (others, free))
        found = solved(v, u)
        if found is None:
            raise pure.Refusal("rejected", "expansion: the constraints may leave other components free")
        for line, place in zip(found, others, strict=True):
            expansion[place] = [negative(x) for x in line]
    for line, bounds in zip(expansion, e, strict=True):
        pure.require(lie_in(line, bounds), "expansion: an entry is not within its bounds")
    for number, (leg, bounds) in enumerate(zip(machine.legs, p, strict=True), 1):
        row = leg_row(leg, number, h, machine)
        entries = [scalar(row, column(expansion, k)) for k in range(len(free))]
        pure.require(lie_in(entries, bounds), f"jacobian: an entry of leg {number} is not within its bounds")


def cross(a: Sequence[Interval], b: Sequence[Interval]) -> Line:
    """The vector product."""
    return [a[j] * b[k] - a[k] * b[j] for j, k in ((1, 2), (2, 0), (0, 1))]


def leg_row(leg: tuple[Row, Row, Row | None], number: int, h: Line, machine: Machine) -> Line:
    """J_i: (d; a x d) by p_i."""
    base, joint, direction = leg
    b = [x * interval(y) for x, y in zip(h, joint, strict=True)]
    a = [scalar(row, b) for row in machine.rotation]
    start = [x * interval(y) for x, y in zip(h, base, strict=True)]
    d = [c + x - y for c, x, y in zip(machine.position, a, start, strict=True)]
    if direction is None:
        square = scalar(d, d)
        pure.require(square.low > 0, f"legs[{number}]: its length may be 0")
        p = square.root()
    else:
        p = scalar([x * interval(y) for x, y in zip(h, direction, strict=True)], d)
        pure.require(not p.contains_zero(), f"legs[{number}]: its actuator may not move it")
    row = [*d, *cross(a, d)]
    return [row[k].over(p) for k in machine.freedoms]


def form_row(form: Row, h: Line, machine: Machine) -> Line:
    """W: (2 c_s C + R c_u + c_C; (R c_u) x C + sum_j R_j x c_Rj), in ordinary coordinates."""
    c, r = machine.position, machine.rotation
    c_u = [interval(form[1 + k]).over(h[k]) for k in range(3)]
    c_c = [interval(form[4 + k]).over(h[k]) for k in range(3)]
    c_r = [[(interval(form[7 + 3 * i + j]) * h[j]).over(h[i]) for j in range(3)] for i in range(3)]
    arm = [scalar(row, c_u) for row in r]
    force = [interval(2 * form[0]) * c[k] + arm[k] + c_c[k] for k in range(3)]
    parts = [cross(arm, c), *(cross(column(r, j), column(c_r, j)) for j in range(3))]
    moment = [total(part[k] for part in parts) for k in range(3)]
    return [[*force, *moment][k] for k in machine.freedoms]


def check_forces(listed: Listed, load: Row, borne: list[Ends]) -> None:
    """Check 2: s = -P (P^T P)^-1 E^T F, or -P^-T E^T F."""
    p, f = listed.p, len(listed.p[0])
    wanted = [[negative(scalar(column(listed.e, k), [interval(x) for x in load]))] for k in range(f)]
    back = [column(p, k) for k in range(f)]
    if len(p) == f:
        found = solved(back, wanted)
    else:
        inner = solved([[scalar(x, y) for y in back] for x in back], wanted)
        found = inner and [[scalar(row, column(inner, 0))] for row in p]
    if found is None:
        raise pure.Refusal("rejected", "actuator_forces: not decided in this box")
    pure.require(lie_in(column(found, 0), borne), "actuator_forces: one is not within its bounds")


def both_ways(speeds: Row) -> list[Ends]:
    """Ends of what is limited both ways alike."""
    return [(-speed, speed) for speed in speeds]


def check_velocity(
    p: list[Line],
    ends: Sequence[Ends],
    facets: Sides,
    vertices: list[tuple[Sides, list[Ends]]],
    volume: Ends | None,
    where: str = "velocity_polytope",
) -> None:
    """Check 3: all points where f sides meet, and which are vertices."""
    f = len(p[0])
    found: dict[Sides, Line] = {}
    for chosen in combinations(range(len(p)), f):
        unit = [[whole(int(i == j)) for j in range(f)] for i in range(f)]
        inverse = solved([p[k] for k in chosen], unit)
        if inverse is None:
            raise pure.Refusal("rejected", f"{where}: legs may be dependent, or the box is too wide")
        for signs in product((-1, 1), repeat=f):
            right = [interval(ends[k][side == 1]) for side, k in zip(signs, chosen, strict=True)]
            s = [scalar(row, right) for row in inverse]
            others = [(scalar(row, s), *map(interval, ends[k])) for k, row in enumerate(p) if k not in chosen]
            if all(least.high < value.low and value.high < most.low for value, least, most in others):
                found[tuple(zip(chosen, signs, strict=True))] = s
                continue
            outside = any(value.high < least.low or value.low > most.high for value, least, most in others)
            pure.require(outside, f"{where}: whether there is a vertex is not decided in this box")
    points = dict(vertices)
    pure.require(len(points) == len(vertices), f"{where}: a vertex is listed twice")
    pure.require(points.keys() == found.keys(), f"{where}: not all vertices are listed, or others are")
    good = all(lie_in(s, points[sides]) for sides, s in found.items())
    pure.require(good, f"{where}: a vertex is not within its bounds")
    pure.require(len(set(facets)) == len(facets), f"{where}: a facet is listed twice")
    wanted = {side for sides in found for side in sides}
    pure.require(set(facets) == wanted, f"{where}: not all facets are listed, or others are")
    if volume is not None:
        room = whole(1)
        for low, high in ends:
            room = room * interval(high - low)
        part = determinant(p)
        pure.require(not part.contains_zero(), f"{where}: the volume is not decided in this box")
        pure.require(lies_in(room.over(size(part)), volume), f"{where}: the volume is not within its bounds")


def check_wrench(
    p: list[Line],
    forces: Sequence[Ends],
    facets: list[tuple[Any, ...]],
    vertices: list[tuple[int, ...]],
    volume: Ends,
    where: str = "wrench_polytope",
) -> None:
    """Check 4: the vector products of all f - 1 rows, and at which ends the forces of the others are."""
    f, m = len(p[0]), len(p)
    planes = {(legs, side): (normal, offset) for legs, side, normal, offset in facets}
    pure.require(len(planes) == len(facets), f"{where}: a facet is listed twice")
    wanted = {(legs, side) for legs in combinations(range(m), f - 1) for side in (1, -1)}
    pure.require(planes.keys() == wanted, f"{where}: not all facets are listed, or others are")
    cells: set[tuple[int, ...]] = set()
    for legs in combinations(range(m), f - 1):
        first = [determinant([p[k][:j] + p[k][j + 1 :] for k in legs]) for j in range(f)]
        first = [negative(x) if j % 2 else x for j, x in enumerate(first)]
        for side in (1, -1):
            normal = first if side == 1 else [negative(x) for x in first]
            bounds, reach = planes[legs, side]
            pure.require(lie_in(normal, bounds), f"{where}: a normal is not within its bounds")
            signs, offset = {}, whole(0)
            for k in range(m):
                if k not in legs:
                    value = scalar(normal, p[k])
                    decided = not value.contains_zero()
                    pure.require(decided, f"{where}: more legs than usual may lie in a hyperplane")
                    signs[k] = 1 if value.low > 0 else -1
                    offset = offset + value * interval(forces[k][value.low > 0])
            pure.require(lies_in(offset, reach), f"{where}: an offset is not within its bounds")
            for others in product((-1, 1), repeat=f - 1):
                ends = signs | dict(zip(legs, others, strict=True))
                cells.add(tuple(ends[k] for k in range(m)))
    pure.require(len(set(vertices)) == len(vertices), f"{where}: a vertex is listed twice")
    pure.require(set(vertices) == cells, f"{where}: not all vertices are listed, or others are")
    ranges = [interval(high - low) for low, high in forces]
    found = total(
        times([size(determinant([p[k] for k in chosen])), *(ranges[k] for k in chosen)])
        for chosen in combinations(range(m), f)
    )
    pure.require(lies_in(found, volume), f"{where}: the volume is not within its bounds")


def times(factors: Sequence[Interval]) -> Interval:
    """The product."""
    found = factors[0]
    for factor in factors[1:]:
        found = found * factor
    return found


def check_ellipsoid(listed: Listed, q: Row, weights: Row, matrix: list[Row], gap: Fraction) -> None:
    """Check 5: S positive definite, P_i S P_i^T <= q_i^2, det S det M >= 1 - gap."""
    p, f = listed.p, len(listed.p[0])
    bits = max(x.numerator.bit_length() + x.denominator.bit_length() for line in matrix for x in line)
    pure.spend(10**7 * (1 + (f * bits // 300) ** 2))
    symmetric = all(matrix[i][j] == matrix[j][i] for i in range(f) for j in range(f))
    definite = symmetric and pure_statics.is_definite([list(line) for line in matrix])
    pure.require(definite, "ellipsoid: not positive definite")
    pure.require(min(weights) >= 0 and sum(weights) == 1, "ellipsoid: weights are negative, or their sum is not 1")
    s = [[interval(x) for x in line] for line in matrix]
    for row, speed in zip(p, q, strict=True):
        reach = scalar(row, [scalar(line, row) for line in s])
        pure.require(reach.high <= interval(speed * speed).low, "ellipsoid: may leave the velocity polytope")
    parts = [interval(w / (speed * speed)) for w, speed in zip(weights, q, strict=True)]
    dual = total(
        times([*[determinant([p[k] for k in chosen])] * 2, *(parts[k] for k in chosen)])
        for chosen in combinations(range(len(p)), f)
    )
    exact = pure_statics.determinant([list(line) for line in matrix])
    share = interval(exact * f**f) * dual
    pure.require(share.low >= interval(1 - gap).high, "ellipsoid: not proved to be as large as that")


def check_indices(listed: Listed, freedoms: Sequence[int], indices: list[Row]) -> None:
    """Check 6: pivots of K - s^2 G."""
    p, e, f = listed.p, listed.e, len(listed.p[0])
    turn = Fraction(1) if listed.length is None else listed.length**2
    scales = [interval(turn) if k >= 3 else whole(1) for k in freedoms]
    gram = [[scalar(column(p, i), column(p, j)) for j in range(f)] for i in range(f)]
    norm = [
        [scalar(column(e, i), [a * b for a, b in zip(scales, column(e, j), strict=True)]) for j in range(f)]
        for i in range(f)
    ]

    def positive(s: Fraction, sign: int) -> bool | None:
        factor = interval(s * s)
        return is_positive([[sign * (gram[i][j] - factor * norm[i][j]) for j in range(f)] for i in range(f)])

    least, greatest, condition = indices
    pure.require(positive(least[0], 1) is True, "indices: sigma_min may be below its bounds")
    pure.require(positive(least[1], 1) is False, "indices: sigma_min may be above its bounds")
    pure.require(positive(greatest[1], -1) is True, "indices: sigma_max may be above its bounds")
    pure.require(positive(greatest[0], -1) is False, "indices: sigma_max may be below its bounds")
    good = condition[0] * least[1] <= greatest[0] and condition[1] * least[0] >= greatest[1]
    pure.require(good, "indices: condition may not be between its bounds")


def is_positive(rows: list[Line]) -> bool | None:
    """Whether a symmetric matrix is positive definite, by its pivots; None if they do not tell."""
    left = [list(row) for row in rows]
    for k in range(len(left)):
        pivot = left[k][k]
        if pivot.high < 0:
            return False
        if pivot.low <= 0:
            return None
        for r in range(k + 1, len(left)):
            factor = left[r][k].over(pivot)
            left[r] = [x - factor * y for x, y in zip(left[r], left[k], strict=True)]
    return True

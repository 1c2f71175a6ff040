"""Checks certificates of what a machine can do at a pose, with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate. Written from
the definition of the format and its proofs, ``docs/certificates-statics.md``; the functions below have its order and
its notation. It shares no line with the other checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import comb, gcd, isqrt, lcm
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure
else:
    import pure

__all__ = ["replayed"]

Row: TypeAlias = tuple[Fraction, ...]

FORMAT: Final = "pkm_exact statics certificate"
KEYS: Final = (
    "format version name unit metric freedoms position rotation legs speeds forces length "
    "velocity_polytope wrench_polytope ellipsoid indices"
)
MAX_LEGS: Final = 12
MAX_CANDIDATES: Final = 20_000
MAX_VERTICES: Final = 4096
NEARLY: Final = 1 - Fraction(1, 10**12)


@dataclass(frozen=True)
class Machine:
    """Rows R_i and squared lengths of the legs, and the squares k_j of the columns."""

    rows: tuple[Row, ...]
    squares: tuple[Fraction, ...]
    columns: tuple[Fraction, ...]
    turning: tuple[bool, ...]

    @property
    def freedoms(self) -> int:
        """n."""
        return len(self.columns)

    def effort(self, *others: Sequence[Fraction]) -> int:
        """How much longer sums and products take than those of short numbers: more with more digits."""
        numbers = [x for row in (*self.rows, self.squares, *others) for x in row]
        bits = max(x.numerator.bit_length() + x.denominator.bit_length() for x in numbers)
        return 1 + (self.freedoms * bits // 300) ** 2


# ---------------------------------------------------------------------------------------------------------------------
# Reading
# ---------------------------------------------------------------------------------------------------------------------


def rational(value: Any, where: str) -> Fraction:
    """A number "p" or "p/q" in lowest terms, of at most 600 digits."""
    pure.well_formed(isinstance(value, str) and len(value) <= 1300, f"{where}: not a rational number in quotes")
    pure.well_formed(pure.RATIONAL.fullmatch(value), f"{where}: not a rational number p or p/q")
    parts = value.split("/")
    pure.affordable(max(map(len, parts)) <= 600, f"{where}: more than 600 digits")
    pure.spend(4000)
    number = Fraction(int(parts[0]), int(parts[-1]) if len(parts) == 2 else 1)
    pure.well_formed(str(number) == value, f"{where}: not in lowest terms")
    return number


def entries_of(value: Any, where: str, length: int) -> list[Any]:
    """A list of so many."""
    pure.well_formed(isinstance(value, list) and len(value) == length, f"{where}: not a list of {length}")
    return list(value)


def vector(value: Any, where: str, length: int) -> Row:
    """So many rational numbers."""
    return tuple(rational(entry, f"{where}[{k}]") for k, entry in enumerate(entries_of(value, where, length), 1))


def fields(value: Any, where: str, keys: str) -> list[Any]:
    """The values of an object with these keys in this order."""
    names = keys.split()
    good = isinstance(value, dict) and list(value) == names
    pure.well_formed(good, f"{where}: not an object with the keys {', '.join(names)}, in this order")
    return list(value.values())


def list_of(value: Any, where: str, most: int) -> list[Any]:
    """A list that is not too long."""
    pure.well_formed(isinstance(value, list), f"{where}: not a list")
    pure.affordable(len(value) <= most, f"{where}: more than {most} entries")
    return list(value)


def integers(value: Any, where: str, length: int, allowed: range | None = None) -> tuple[int, ...]:
    """So many integers, from a range or as texts."""
    if allowed is None:
        found = vector(value, where, length)
        pure.well_formed(all(x.denominator == 1 for x in found), f"{where}: not integers")
        return tuple(map(int, found))
    good = all(type(x) is int and x in allowed for x in entries_of(value, where, length))
    pure.well_formed(good, f"{where}: not {length} integers from {allowed.start} to {allowed.stop - 1}")
    return tuple(value)


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    if body.get("version") == 2:
        return pure.checks_beside("pure_statics_box", "a statics certificate of version 2")(body)
    if body.get("version") == 4:
        return pure.checks_beside("pure_statics_equations", "a statics certificate of version 4")(body)
    pure.well_formed(
        body.get("format") == FORMAT and type(body.get("version")) is int and body["version"] in (1, 3),
        f"format: not a {FORMAT}, version 1, 2, 3 or 4",
    )
    values = fields(body, "certificate", KEYS)
    name, unit = values[2:4]
    for text, where in ((name, "name"), (unit, "unit")):
        pure.well_formed(isinstance(text, str), f"{where}: not a text")
        pure.affordable(len(text) <= pure.MAX_TEXT, f"{where}: more than {pure.MAX_TEXT} characters")
    machine = read_machine(values[4:9], driven=body["version"] == 3)
    count, n = len(machine.rows), machine.freedoms
    speeds = None if values[9] is None else vector(values[9], "speeds", count)
    pure.well_formed(speeds is None or min(speeds) > 0, "speeds: one is not positive")
    forces = None
    if values[10] is not None:
        pairs = entries_of(values[10], "forces", count)
        forces = [vector(pair, f"forces[{k}]", 2) for k, pair in enumerate(pairs, 1)]
        pure.well_formed(all(low < high for low, high in forces), "forces: a least one is not below the greatest")
    length = None if values[11] is None else rational(values[11], "length")
    pure.well_formed(length is None or length > 0, "length: not positive")
    velocity = None if values[12] is None else read_velocity(values[12], count, n)
    wrench = None if values[13] is None else read_wrench(values[13], count, n)
    ellipsoid = None if values[14] is None else read_ellipsoid(values[14], count, n)
    indices = None if values[15] is None else read_indices(values[15])
    pure.well_formed(velocity is None or speeds is not None, "velocity_polytope: needs speeds")
    pure.well_formed(ellipsoid is None or speeds is not None, "ellipsoid: needs speeds")
    pure.well_formed(wrench is None or forces is not None, "wrench_polytope: needs forces")
    return checks(machine, speeds, forces, length, (velocity, wrench, ellipsoid, indices))


def read_machine(values: Sequence[Any], *, driven: bool) -> Machine:
    """The legs at the pose: R_i, l_i^2 and k_j; of driven ones R_i times the sign of p_i, and p_i^2."""
    metric = integers(values[0], "metric", 3)
    pure.well_formed(min(metric) > 0, "metric: one is not positive")
    pure.well_formed(isinstance(values[1], list), "freedoms: not a list")
    pure.well_formed(1 <= len(values[1]) <= 6, "freedoms: not 1 to 6 numbers")
    freedoms = integers(values[1], "freedoms", len(values[1]), range(6))
    pure.well_formed(list(freedoms) == sorted(set(freedoms)), "freedoms: not increasing")
    position = vector(values[2], "position", 3)
    lines = entries_of(values[3], "rotation", 3)
    rotation = [vector(line, f"rotation[{k}]", 3) for k, line in enumerate(lines, 1)]
    legs = list_of(values[4], "legs", MAX_LEGS)
    joints = [leg_of(leg, f"legs[{number}]", driven=driven) for number, leg in enumerate(legs, 1)]
    pure.well_formed(len(joints) >= len(freedoms), "legs: fewer than freedoms")
    for i, j in product(range(3), range(3)):
        found = sum((g * r[i] * r[j] for g, r in zip(metric, rotation, strict=True)), Fraction(0))
        pure.require(found == (metric[i] if i == j else 0), "rotation: not one in the metric")
    pure.require(determinant([list(line) for line in rotation]) == 1, "rotation: its determinant is not 1")
    rows, squares = [], []
    for number, (a, b, direction) in enumerate(joints, 1):
        arm = [sum((r * x for r, x in zip(line, b, strict=True)), Fraction(0)) for line in rotation]
        d = [c + x - y for c, x, y in zip(position, arm, a, strict=True)]
        square = sum((g * x * x for g, x in zip(metric, d, strict=True)), Fraction(0))
        pure.require(square > 0, f"legs[{number}]: has length 0")
        whole = [g * x for g, x in zip(metric, d, strict=True)]
        for j, k in ((1, 2), (2, 0), (0, 1)):
            whole.append(metric[j] * metric[k] * (arm[j] * d[k] - arm[k] * d[j]))
        if direction is not None:
            speed = sum((g * n * x for g, n, x in zip(metric, direction, d, strict=True)), Fraction(0))
            pure.require(speed != 0, f"legs[{number}]: its actuator does not move it")
            square, whole = speed**2, [-x for x in whole] if speed < 0 else whole
        rows.append(tuple(whole[place] for place in freedoms))
        squares.append(square)
    g1, g2, g3 = metric
    columns = [Fraction(1, g) for g in (g1, g2, g3, g2 * g3, g3 * g1, g1 * g2)]
    turning = tuple(place >= 3 for place in freedoms)
    return Machine(tuple(rows), tuple(squares), tuple(columns[place] for place in freedoms), turning)


def leg_of(value: Any, where: str, *, driven: bool) -> tuple[Row, Row, Row | None]:
    """The joints of a leg, and the velocity of its base joint; None where its length is what is actuated."""
    base, platform, *others = fields(value, where, "base platform direction" if driven else "base platform")
    direction = vector(others[0], f"{where}.direction", 3) if driven and others[0] is not None else None
    return vector(base, f"{where}.base", 3), vector(platform, f"{where}.platform", 3), direction


def read_velocity(value: Any, count: int, n: int) -> tuple[list[tuple[int, int]], list[tuple[Row, ...]]]:
    """Facets as (leg, side), vertices as n rows of coefficients of the lengths."""
    facets, vertices = fields(value, "velocity_polytope", "facets vertices")
    sides = []
    for k, facet in enumerate(list_of(facets, "velocity_polytope.facets", 2 * MAX_LEGS), 1):
        where = f"velocity_polytope.facets[{k}]"
        leg, side = integers(facet, where, 2, range(-1, MAX_LEGS + 1))
        pure.well_formed(1 <= leg <= count and side in (-1, 1), f"{where}: not a leg and a side")
        sides.append((leg - 1, side))
    points = []
    for k, vertex in enumerate(list_of(vertices, "velocity_polytope.vertices", MAX_VERTICES), 1):
        where = f"velocity_polytope.vertices[{k}]"
        lines = entries_of(vertex, where, n)
        points.append(tuple(vector(line, f"{where}[{j}]", count) for j, line in enumerate(lines, 1)))
    return sides, points


def read_wrench(value: Any, count: int, n: int) -> tuple[list[tuple[tuple[int, ...], Row]], list[tuple[int, ...]]]:
    """Facets as normals with the coefficients of 1 / l_i in their offsets, vertices as ends of the forces."""
    facets, vertices = fields(value, "wrench_polytope", "facets vertices")
    planes = []
    for k, facet in enumerate(list_of(facets, "wrench_polytope.facets", MAX_VERTICES), 1):
        where = f"wrench_polytope.facets[{k}]"
        normal, offset = fields(facet, where, "normal offset")
        planes.append((integers(normal, f"{where}.normal", n), vector(offset, f"{where}.offset", count)))
    ends = []
    for k, vertex in enumerate(list_of(vertices, "wrench_polytope.vertices", MAX_VERTICES), 1):
        where = f"wrench_polytope.vertices[{k}]"
        found = integers(vertex, where, count, range(-1, 2))
        pure.well_formed(0 not in found, f"{where}: 0 is no end")
        ends.append(found)
    return planes, ends


def read_ellipsoid(value: Any, count: int, n: int) -> tuple[Row, list[Row]]:
    """Weights and matrix."""
    weights, matrix = fields(value, "ellipsoid", "weights matrix")
    lines = entries_of(matrix, "ellipsoid.matrix", n)
    found = [vector(line, f"ellipsoid.matrix[{k}]", n) for k, line in enumerate(lines, 1)]
    return vector(weights, "ellipsoid.weights", count), found


def read_indices(value: Any) -> list[Row]:
    """The bounds of sigma_min, sigma_max and condition."""
    found = []
    for name, pair in zip(
        ("sigma_min", "sigma_max", "condition"),
        fields(value, "indices", "sigma_min sigma_max condition"),
        strict=True,
    ):
        ends = vector(pair, f"indices.{name}", 2)
        pure.well_formed(0 <= ends[0] <= ends[1], f"indices.{name}: not two bounds in order")
        found.append(ends)
    return found


# ---------------------------------------------------------------------------------------------------------------------
# Checks
# ---------------------------------------------------------------------------------------------------------------------


def checks(
    machine: Machine, speeds: Row | None, forces: list[Row] | None, length: Fraction | None, parts: tuple[Any, ...]
) -> Iterator[str]:
    """One line for each claim that is proved."""
    velocity, wrench, ellipsoid, indices = parts
    yield f"machine: {len(machine.rows)} legs at a pose, {machine.freedoms} freedoms"
    if velocity is not None and speeds is not None:
        check_velocity(machine, speeds, *velocity)
        yield f"velocity polytope: {len(velocity[1])} vertices, {len(velocity[0])} facets, and no others"
    if wrench is not None and forces is not None:
        check_wrench(machine, forces, *wrench)
        yield f"wrench polytope: {len(wrench[1])} vertices, {len(wrench[0])} facets, and no others"
    if ellipsoid is not None and speeds is not None:
        check_ellipsoid(machine, speeds, *ellipsoid)
        yield "ellipsoid: in the velocity polytope, and no larger one but for a part in 10^12 of the volume"
    if indices is not None:
        check_indices(machine, length, indices)
        yield "indices: singular values and condition within their bounds"


def check_velocity(
    machine: Machine, speeds: Row, facets: list[tuple[int, int]], vertices: list[tuple[Row, ...]]
) -> None:
    """Check 1: all vertices are found anew, by every choice of n legs at their greatest speeds."""
    count, n = len(machine.rows), machine.freedoms
    choices = comb(count, n) << n
    pure.affordable(choices <= MAX_CANDIDATES, "velocity_polytope: too many choices of legs")
    pure.spend((choices + 1) * count * count * 60_000 * machine.effort(speeds))
    pure.require(rank([list(row) for row in machine.rows]) == n, "velocity_polytope: is not bounded")
    found: set[frozenset[tuple[int, int]]] = set()
    for chosen in combinations(range(count), n):
        inverse = inverted([list(machine.rows[k]) for k in chosen])
        if inverse is None:
            continue
        for signs in product((-1, 1), repeat=n):
            point = tuple(in_lengths(line, chosen, signs, speeds, count) for line in inverse)
            sides = tight(machine, speeds, point)
            if sides is not None:
                found.add(sides)
    listed = set()
    for vertex in vertices:
        sides = tight(machine, speeds, vertex)
        pure.require(sides is not None, "velocity_polytope: a vertex lies outside")
        listed.add(sides)
    pure.require(len(listed) == len(vertices), "velocity_polytope: a vertex is listed twice")
    pure.require(listed == found, "velocity_polytope: not all vertices are listed, or others are")
    on = {side: frozenset(key for key in found if side in key) for key in found for side in key}
    maximal = {side for side, keys in on.items() if not any(keys < other for other in on.values())}
    alike: dict[frozenset[frozenset[tuple[int, int]]], tuple[int, int]] = {}
    for side in sorted(maximal):
        alike.setdefault(on[side], side)
    pure.require(len(facets) == len(set(facets)), "velocity_polytope: a facet is listed twice")
    pure.require(set(facets) == set(alike.values()), "velocity_polytope: not all facets are listed, or others are")


def in_lengths(line: Sequence[Fraction], chosen: Sequence[int], signs: Sequence[int], speeds: Row, count: int) -> Row:
    """A coordinate of a candidate, as coefficients of the lengths."""
    found = [Fraction(0)] * count
    for x, k, s in zip(line, chosen, signs, strict=True):
        found[k] = x * s * speeds[k]
    return tuple(found)


def tight(machine: Machine, speeds: Row, point: Sequence[Row]) -> frozenset[tuple[int, int]] | None:
    """The sides on which a point lies; None if it is outside."""
    found = set()
    for k, (row, speed) in enumerate(zip(machine.rows, speeds, strict=True)):
        value = [
            sum((x * line[i] for x, line in zip(row, point, strict=True)), Fraction(0)) for i in range(len(speeds))
        ]
        for side in (1, -1):
            rest = [-side * x for x in value]
            rest[k] += speed
            sign = root_sum_sign(rest, machine.squares)
            if sign < 0:
                return None
            if sign == 0:
                found.add((k, side))
    return frozenset(found)


def root_sum_sign(coefficients: Sequence[Fraction], squares: Sequence[Fraction]) -> int:
    """The sign of the sum of c_i sqrt(q_i): 0 if in every class of roots the sum is, else shown by bounds."""
    classes: list[tuple[Fraction, Fraction]] = []
    for c, q in zip(coefficients, squares, strict=True):
        if not c:
            continue
        for place, (total, known) in enumerate(classes):
            ratio = rational_root(q / known)
            if ratio is not None:
                classes[place] = total + c * ratio, known
                break
        else:
            classes.append((c, q))
    left = [(c, q) for c, q in classes if c]
    if not left:
        return 0
    bits = 64
    while True:
        pure.spend(5000 * len(left) * (1 + bits // 64))
        low = high = Fraction(0)
        for c, q in left:
            floor = isqrt((q.numerator << 2 * bits) // q.denominator)
            ends = c * Fraction(floor, 1 << bits), c * Fraction(floor + 1, 1 << bits)
            low, high = low + min(ends), high + max(ends)
        if low > 0 or high < 0:
            return 1 if low > 0 else -1
        bits *= 2


def rational_root(value: Fraction) -> Fraction | None:
    """The root, if it is rational."""
    p, q = isqrt(value.numerator), isqrt(value.denominator)
    return Fraction(p, q) if p * p == value.numerator and q * q == value.denominator else None


def check_wrench(
    machine: Machine, forces: list[Row], facets: list[tuple[tuple[int, ...], Row]], vertices: list[tuple[int, ...]]
) -> None:
    """Check 2: all hyperplanes that n - 1 rows span, and all cells between them, are found anew."""
    count, n = len(machine.rows), machine.freedoms
    choices = comb(count, n - 1)
    pure.spend((choices + MAX_VERTICES) * count * n * n * 10_000 * machine.effort(*forces))
    rows = [primitive(row) for row in machine.rows]
    normals = {}
    for chosen in combinations(rows, n - 1):
        normal = annihilator([list(row) for row in chosen], n)
        if normal is not None:
            normals[normal] = [sum(a * b for a, b in zip(normal, row, strict=True)) for row in rows]
    pure.require(rank([list(map(Fraction, row)) for row in rows]) == n, "wrench_polytope: has no interior")
    idle = "wrench_polytope: a leg exerts nothing, so that its force has no end at a vertex"
    pure.require(all(any(row) for row in rows), idle)
    wanted = {}
    for normal in normals:
        for side in (1, -1):
            outer = tuple(side * x for x in normal)
            reach = []
            for row, (low, high) in zip(machine.rows, forces, strict=True):
                value = sum((a * b for a, b in zip(outer, row, strict=True)), Fraction(0))
                reach.append(value * (high if value > 0 else low))
            wanted[outer] = tuple(reach)
    listed = dict(facets)
    pure.require(len(listed) == len(facets), "wrench_polytope: a facet is listed twice")
    pure.require(set(listed) == set(wanted), "wrench_polytope: not all facets are listed, or others are")
    pure.require(listed == wanted, "wrench_polytope: a facet is not where the forces reach")
    cells = cells_of(list(range(count)), [], rows, n)
    pure.require(len(set(vertices)) == len(vertices), "wrench_polytope: a vertex is listed twice")
    pure.require(set(vertices) == cells, "wrench_polytope: not all vertices are listed, or others are")


def cells_of(places: list[int], fixed: list[list[int]], rows: list[tuple[int, ...]], n: int) -> set[tuple[int, ...]]:
    """The signs of x.g for the rows g at these places, for all x in general position, of those orthogonal to fixed."""
    size = n - len(fixed)
    if size == 1:
        first = rows[places[0]]
        signs = tuple(1 if sum(a * b for a, b in zip(first, rows[k], strict=True)) > 0 else -1 for k in places)
        return {signs, tuple(-s for s in signs)}
    seen = set()
    cells: set[tuple[int, ...]] = set()
    for chosen in combinations(places, size - 1):
        pure.spend(100_000)
        normal = annihilator([*(list(rows[k]) for k in chosen), *fixed], n)
        if normal is None or normal in seen:
            continue
        seen.add(normal)
        values = [sum(a * b for a, b in zip(normal, rows[k], strict=True)) for k in places]
        flat = [k for k, value in zip(places, values, strict=True) if value == 0]
        for inner in cells_of(flat, [*fixed, list(normal)], rows, n):
            known = dict(zip(flat, inner, strict=True))
            for side in (1, -1):
                cells.add(tuple(known.get(k, side if v > 0 else -side) for k, v in zip(places, values, strict=True)))
    return cells


def check_ellipsoid(machine: Machine, speeds: Row, weights: Row, matrix: list[Row]) -> None:
    """Check 3: a positive definite S, R_i S R_i <= q_i^2 l_i^2, and det S det M at least 1 - 10^-12."""
    n = machine.freedoms
    pure.spend(10**7 * machine.effort(speeds, weights, *matrix))
    symmetric = all(matrix[i][j] == matrix[j][i] for i in range(n) for j in range(n))
    pure.require(symmetric and is_definite([list(line) for line in matrix]), "ellipsoid: not positive definite")
    pure.require(min(weights) >= 0 and sum(weights) == 1, "ellipsoid: weights are negative, or their sum is not 1")
    bounds = [speed * speed * square for speed, square in zip(speeds, machine.squares, strict=True)]
    for row, bound in zip(machine.rows, bounds, strict=True):
        value = sum((row[i] * matrix[i][j] * row[j] for i in range(n) for j in range(n)), Fraction(0))
        pure.require(value <= bound, "ellipsoid: leaves the velocity polytope")
    dual = [
        [
            n
            * sum(
                (w * row[i] * row[j] / b for w, row, b in zip(weights, machine.rows, bounds, strict=True)), Fraction(0)
            )
            for j in range(n)
        ]
        for i in range(n)
    ]
    ratio = determinant([list(line) for line in matrix]) * determinant(dual)
    pure.require(ratio >= NEARLY, "ellipsoid: not proved to be the largest")


def check_indices(machine: Machine, length: Fraction | None, indices: list[Row]) -> None:
    """Check 4: singular values by the definiteness of K - s^2 G."""
    least, greatest, condition = indices
    n = machine.freedoms
    pure.spend(10**7 * machine.effort(*indices))
    gram = [
        [
            sum((row[i] * row[j] / q for row, q in zip(machine.rows, machine.squares, strict=True)), Fraction(0))
            for j in range(n)
        ]
        for i in range(n)
    ]
    turn = 1 if length is None else length * length
    scales = [(turn if turning else 1) / k for turning, k in zip(machine.turning, machine.columns, strict=True)]

    def definite(s: Fraction, sign: int) -> bool:
        return is_definite(
            [[sign * (gram[i][j] - (s * s * scales[i] if i == j else 0)) for j in range(n)] for i in range(n)]
        )

    pure.require(definite(least[0], 1), "indices: sigma_min is below its bounds")
    pure.require(not definite(least[1], 1), "indices: sigma_min is above its bounds")
    pure.require(definite(greatest[1], -1), "indices: sigma_max is above its bounds")
    pure.require(not definite(greatest[0], -1), "indices: sigma_max is below its bounds")
    good = condition[0] * least[1] <= greatest[0] and condition[1] * least[0] >= greatest[1]
    pure.require(good, "indices: condition is not between its bounds")


# ---------------------------------------------------------------------------------------------------------------------
# Linear algebra
# ---------------------------------------------------------------------------------------------------------------------


def primitive(row: Row) -> tuple[int, ...]:
    """The positive multiple with coprime integers."""
    scale = lcm(*(x.denominator for x in row))
    whole = [int(x * scale) for x in row]
    divisor = gcd(*whole) or 1
    return tuple(x // divisor for x in whole)


def reduced(rows: list[list[Fraction]]) -> tuple[list[list[Fraction]], list[int]]:
    """The echelon form, and its pivots."""
    left = [list(row) for row in rows]
    pivots: list[int] = []
    for column in range(len(left[0]) if left else 0):
        place = next((r for r in range(len(pivots), len(left)) if left[r][column]), None)
        if place is None:
            continue
        top = len(pivots)
        left[top], left[place] = left[place], left[top]
        pivot = left[top][column]
        left[top] = [x / pivot for x in left[top]]
        for r, row in enumerate(left):
            if r != top and row[column]:
                left[r] = [x - row[column] * y for x, y in zip(row, left[top], strict=True)]
        pivots.append(column)
    return left, pivots


def rank(rows: list[list[Fraction]]) -> int:
    """The rank."""
    return len(reduced(rows)[1])


def inverted(rows: list[list[Fraction]]) -> list[list[Fraction]] | None:
    """The inverse; None if there is none."""
    n = len(rows)
    whole, pivots = reduced([row + [Fraction(int(i == k)) for i in range(n)] for k, row in enumerate(rows)])
    return [row[n:] for row in whole] if pivots == list(range(n)) else None


def annihilator(rows: list[list[int]], n: int) -> tuple[int, ...] | None:
    """The primitive integers orthogonal to n - 1 independent rows, the first that is not 0 positive; else None."""
    if not rows:
        return (1,)
    whole, pivots = reduced([[Fraction(x) for x in row] for row in rows])
    if len(pivots) != n - 1:
        return None
    free = next(c for c in range(n) if c not in pivots)
    found = [Fraction(0)] * n
    found[free] = Fraction(1)
    for row, column in zip(whole, pivots, strict=False):
        found[column] = -row[free]
    sign = 1 if next(x for x in found if x) > 0 else -1
    return primitive(tuple(sign * x for x in found))


def determinant(rows: list[list[Fraction]]) -> Fraction:
    """The determinant."""
    left, found = [list(row) for row in rows], Fraction(1)
    for column in range(len(left)):
        place = next((r for r in range(column, len(left)) if left[r][column]), None)
        if place is None:
            return Fraction(0)
        if place != column:
            left[column], left[place], found = left[place], left[column], -found
        pivot = left[column][column]
        found *= pivot
        for r in range(column + 1, len(left)):
            factor = left[r][column] / pivot
            left[r] = [x - factor * y for x, y in zip(left[r], left[column], strict=True)]
    return found


def is_definite(rows: list[list[Fraction]]) -> bool:
    """Whether a symmetric matrix is positive definite: all pivots are positive."""
    left = [list(row) for row in rows]
    for column in range(len(left)):
        pivot = left[column][column]
        if pivot <= 0:
            return False
        for r in range(column + 1, len(left)):
            factor = left[r][column] / pivot
            left[r] = [x - factor * y for x, y in zip(left[r], left[column], strict=True)]
    return True

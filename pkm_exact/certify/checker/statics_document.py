"""What a statics certificate says, read strictly: a machine of legs at a rational pose, and claims about it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.checker.spelling import choice, entries, integer, items, positive, rational, text
from pkm_exact.certify.checker.verdict import malformed, rejected, too_large

FORMAT: Final = "pkm_exact statics certificate"
KEYS: Final = (
    "format",
    "version",
    "name",
    "unit",
    "metric",
    "freedoms",
    "position",
    "rotation",
    "legs",
    "speeds",
    "forces",
    "length",
    "velocity_polytope",
    "wrench_polytope",
    "ellipsoid",
    "indices",
)
MAX_LEGS: Final = 12
MAX_VERTICES: Final = 4096

Numbers = tuple[Fraction, ...]


@dataclass(frozen=True)
class VelocityClaim:
    """Facets as legs and sides, vertices as coefficients of the legs' lengths."""

    facets: tuple[tuple[int, int], ...]
    vertices: tuple[tuple[Numbers, ...], ...]


@dataclass(frozen=True)
class WrenchClaim:
    """Facets as normals and coefficients of the inverse lengths, vertices as ends of the forces."""

    facets: tuple[tuple[tuple[int, ...], Numbers], ...]
    vertices: tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class EllipsoidClaim:
    """Weights and matrix."""

    weights: Numbers
    matrix: tuple[Numbers, ...]


@dataclass(frozen=True)
class StaticsDocument:
    """A certificate: rows of the legs in rational coordinates, squared lengths, and claims."""

    rows: tuple[Numbers, ...]
    squares: Numbers
    columns: Numbers
    turning: tuple[bool, ...]
    speeds: Numbers | None
    forces: tuple[Numbers, ...] | None
    length: Fraction | None
    velocity: VelocityClaim | None
    wrench: WrenchClaim | None
    ellipsoid: EllipsoidClaim | None
    indices: tuple[Numbers, ...] | None


def effort(document: StaticsDocument, *others: Numbers) -> int:
    """How much longer exact arithmetic takes than with short numbers."""
    numbers = [x for row in (*document.rows, document.squares, *others) for x in row]
    bits = max(x.numerator.bit_length() + x.denominator.bit_length() for x in numbers)
    return 1 + (len(document.columns) * bits // 300) ** 2


def read_statics(body: dict[str, Any], *, is_driven: bool = False) -> StaticsDocument:
    """The content of a certificate of version 1, or of version 3 if it is driven; a refusal if it is not one."""
    values = dict(zip(KEYS, entries(body, "certificate", KEYS), strict=True))
    choice(values["format"], "format", (FORMAT,))
    text(values["name"], "name")
    text(values["unit"], "unit")
    rows, squares, columns, turning = _machine(values, _driven_leg if is_driven else _leg)
    count, n = len(rows), len(columns)
    speeds = values["speeds"]
    speeds = None if speeds is None else items(speeds, "speeds", count, positive)
    forces = values["forces"]
    forces = None if forces is None else items(forces, "forces", count, _ends)
    length = None if values["length"] is None else positive(values["length"], "length")
    claims = {name: values[name] for name in KEYS[12:]}
    for name, needed, there in (
        ("velocity_polytope", "speeds", speeds),
        ("ellipsoid", "speeds", speeds),
        ("wrench_polytope", "forces", forces),
    ):
        if claims[name] is not None and there is None:
            raise malformed(f"{name}: needs {needed}")
    return StaticsDocument(
        rows,
        squares,
        columns,
        turning,
        speeds,
        forces,
        length,
        None if claims["velocity_polytope"] is None else _velocity(claims["velocity_polytope"], count, n),
        None if claims["wrench_polytope"] is None else _wrench(claims["wrench_polytope"], count, n),
        None if claims["ellipsoid"] is None else _ellipsoid(claims["ellipsoid"], count, n),
        None if claims["indices"] is None else _indices(claims["indices"]),
    )


def whole(value: Any, where: str) -> int:
    """An integer, as a text."""
    number = rational(value, where)
    if number.denominator != 1:
        raise malformed(f"{where}: not an integer")
    return int(number)


def vector_of(length: int) -> Any:
    """Reads so many rational numbers."""
    return lambda value, where: items(value, where, length, rational)


def _limited(value: Any, where: str, most: int) -> None:
    if isinstance(value, list) and len(value) > most:
        raise too_large(f"{where}: more than {most} entries")


def _ends(value: Any, where: str) -> Numbers:
    low, high = items(value, where, 2, rational)
    if low >= high:
        raise malformed(f"{where}: the least is not below the greatest")
    return low, high


def _machine(values: dict[str, Any], leg: Any) -> tuple[tuple[Numbers, ...], Numbers, Numbers, tuple[bool, ...]]:
    g = items(values["metric"], "metric", 3, whole)
    if min(g) <= 0:
        raise malformed("metric: one is not positive")
    freedoms = items(values["freedoms"], "freedoms", None, integer)
    if not freedoms or list(freedoms) != sorted(set(freedoms)) or not set(freedoms) <= set(range(6)):
        raise malformed("freedoms: not increasing numbers from 0 to 5")
    c = items(values["position"], "position", 3, rational)
    r = items(values["rotation"], "rotation", 3, vector_of(3))
    _limited(values["legs"], "legs", MAX_LEGS)
    legs = items(values["legs"], "legs", None, leg)
    if len(legs) < len(freedoms):
        raise malformed("legs: fewer than freedoms")
    _require_rotation(r, g)
    rows, squares = [], []
    for number, (a, b, n) in enumerate(legs, 1):
        arm = [line[0] * b[0] + line[1] * b[1] + line[2] * b[2] for line in r]
        d = [c[i] + arm[i] - a[i] for i in range(3)]
        square = g[0] * d[0] ** 2 + g[1] * d[1] ** 2 + g[2] * d[2] ** 2
        if square == 0:
            raise rejected(f"legs[{number}]: has length 0")
        force = [g[i] * d[i] for i in range(3)]
        speed = Fraction(1) if n is None else sum((x * y for x, y in zip(force, n, strict=True)), Fraction(0))
        if speed == 0:
            raise rejected(f"legs[{number}]: its actuator does not move it")
        side = 1 if speed > 0 else -1
        # The moment of the covariant force, in rational coordinates.
        moment = [g[k] * (g[j] * arm[j]) * d[k] - g[j] * (g[k] * arm[k]) * d[j] for j, k in ((1, 2), (2, 0), (0, 1))]
        rows.append(tuple(side * (*force, *moment)[place] for place in freedoms))
        squares.append(square if n is None else speed * speed)
    inverse = [Fraction(1, x) for x in (*g, g[1] * g[2], g[2] * g[0], g[0] * g[1])]
    return tuple(rows), tuple(squares), tuple(inverse[k] for k in freedoms), tuple(k >= 3 for k in freedoms)


def _leg(value: Any, where: str) -> tuple[Numbers, Numbers, Numbers | None]:
    """Joints of a leg whose length is actuated."""
    base, platform = entries(value, where, ("base", "platform"))
    return items(base, f"{where}.base", 3, rational), items(platform, f"{where}.platform", 3, rational), None


def _driven_leg(value: Any, where: str) -> tuple[Numbers, Numbers, Numbers | None]:
    """Joints, and how the actuator moves the base joint; None where the length is what is actuated."""
    base, platform, direction = entries(value, where, ("base", "platform", "direction"))
    return (
        items(base, f"{where}.base", 3, rational),
        items(platform, f"{where}.platform", 3, rational),
        None if direction is None else items(direction, f"{where}.direction", 3, rational),
    )


def _require_rotation(r: tuple[Numbers, ...], g: tuple[int, ...]) -> None:
    columns = list(zip(*r, strict=True))
    for i in range(3):
        for j in range(3):
            total = sum((g[k] * columns[i][k] * columns[j][k] for k in range(3)), Fraction(0))
            if total != (g[i] if i == j else 0):
                raise rejected("rotation: not one in the metric")
    (a, b, c), (d, e, f), (x, y, z) = r
    if a * e * z + b * f * x + c * d * y - c * e * x - b * d * z - a * f * y != 1:
        raise rejected("rotation: its determinant is not 1")


def _velocity(value: Any, count: int, n: int) -> VelocityClaim:
    where = "velocity_polytope"
    facets, vertices = entries(value, where, ("facets", "vertices"))
    _limited(facets, f"{where}.facets", 2 * MAX_LEGS)
    _limited(vertices, f"{where}.vertices", MAX_VERTICES)
    sides = []
    for leg, side in items(facets, f"{where}.facets", None, lambda x, w: items(x, w, 2, integer)):
        if not (1 <= leg <= count and side in (1, -1)):
            raise malformed(f"{where}.facets: not a leg and a side")
        sides.append((leg - 1, side))
    points = items(vertices, f"{where}.vertices", None, lambda x, w: items(x, w, n, vector_of(count)))
    return VelocityClaim(tuple(sides), points)


def _wrench(value: Any, count: int, n: int) -> WrenchClaim:
    where = "wrench_polytope"
    facets, vertices = entries(value, where, ("facets", "vertices"))
    _limited(facets, f"{where}.facets", MAX_VERTICES)
    _limited(vertices, f"{where}.vertices", MAX_VERTICES)

    def facet(entry: Any, place: str) -> tuple[tuple[int, ...], Numbers]:
        normal, offset = entries(entry, place, ("normal", "offset"))
        return items(normal, f"{place}.normal", n, whole), items(offset, f"{place}.offset", count, rational)

    def end(entry: Any, place: str) -> int:
        if integer(entry, place) not in (1, -1):
            raise malformed(f"{place}: no end of a range")
        return int(entry)

    ends = items(vertices, f"{where}.vertices", None, lambda x, w: items(x, w, count, end))
    return WrenchClaim(items(facets, f"{where}.facets", None, facet), ends)


def _ellipsoid(value: Any, count: int, n: int) -> EllipsoidClaim:
    weights, matrix = entries(value, "ellipsoid", ("weights", "matrix"))
    return EllipsoidClaim(
        items(weights, "ellipsoid.weights", count, rational), items(matrix, "ellipsoid.matrix", n, vector_of(n))
    )


def _indices(value: Any) -> tuple[Numbers, ...]:
    names = ("sigma_min", "sigma_max", "condition")
    found = []
    for name, entry in zip(names, entries(value, "indices", names), strict=True):
        low, high = items(entry, f"indices.{name}", 2, rational)
        if not 0 <= low <= high:
            raise malformed(f"indices.{name}: not two bounds in order")
        found.append((low, high))
    return tuple(found)

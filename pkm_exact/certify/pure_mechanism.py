"""Checks certificates of version 2, any mechanism as constraints, with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate; what versions 1
and 2 have in common is there. Written from the definition of the format and its proofs, ``docs/certificates-2.md``; the
sections below have its order and its notation. It shares no line with the other checker.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from itertools import chain, combinations, pairwise
from math import gcd
from random import Random
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure
else:
    import pure

__all__ = ["replayed"]

Form: TypeAlias = tuple[Fraction, ...]  # of |C|^2, u (3), C (3), R by rows (9), 1
Quadratic: TypeAlias = dict[tuple[int, int], Fraction]  # in the 17 coordinates, first index not above the second

MAX_CONSTRAINTS: Final = 64
MAX_DIGITS_OF_A_FORM: Final = 4000
MAX_DEGREE_OF_MONOMIALS: Final = 12
MAX_ENTRIES: Final = 1 << 25  # of relations in a graded algebra
DEGREE: Final = 40
"""Degree of the variety of rigid motions in P^16."""

ATTEMPTS: Final = 3
"""Primes that are tried."""

# ---------------------------------------------------------------------------------------------------------------------
# Forms
# ---------------------------------------------------------------------------------------------------------------------

ZERO: Final = Fraction(0)
NO_VECTOR: Final = (ZERO,) * 3
ONE: Final = 16  # the index of the coordinate 1


def new_form(
    square: Fraction | int = 0,
    turned: Sequence[Fraction | int] = NO_VECTOR,
    position: Sequence[Fraction | int] = NO_VECTOR,
    rotation: Sequence[Sequence[Fraction | int]] = (NO_VECTOR,) * 3,
    constant: Fraction | int = 0,
) -> Form:
    """A form by its parts."""
    entries = (square, *turned, *position, *(entry for row in rotation for entry in row), constant)
    return tuple(Fraction(entry) for entry in entries)


def sparse_form(entries: Mapping[int, int]) -> Form:
    """A form by its coefficients that are not 0."""
    return tuple(Fraction(entries.get(place, 0)) for place in range(17))


def outer(g: pure.Metric, x: pure.Point, y: pure.Point) -> list[list[Fraction]]:
    """g_i x_i y_j."""
    return [[weight * a * b for b in y] for weight, a in zip(g, x, strict=True)]


def scaled(factor: Fraction | int, g: pure.Metric, x: pure.Point) -> list[Fraction]:
    """The multiple of G x."""
    return [factor * weight * a for weight, a in zip(g, x, strict=True)]


def forms_of_distance(g: pure.Metric, a: pure.Point, b: pure.Point, square: Fraction) -> list[Form]:
    """|C + R B - A|^2 = l^2."""
    constant = pure.scalar_product(g, a, a) + pure.scalar_product(g, b, b) - square
    rotation = [[-2 * entry for entry in row] for row in outer(g, a, b)]
    return [new_form(1, scaled(2, g, b), scaled(-2, g, a), rotation, constant)]


def forms_in_plane(g: pure.Metric, n: pure.Point, d: Fraction, b: pure.Point) -> list[Form]:
    """n.(C + R B) = d."""
    return [new_form(position=scaled(1, g, n), rotation=outer(g, n, b), constant=-d)]


def forms_carrying(g: pure.Metric, m: pure.Point, d: Fraction, a: pure.Point) -> list[Form]:
    """m.R^-1 (A - C) = d."""
    return [new_form(turned=scaled(-1, g, m), rotation=outer(g, a, m), constant=-d)]


def forms_on_line(g: pure.Metric, x: pure.Point, v: pure.Point, b: pure.Point) -> list[Form]:
    """C + R B = X + t v: v_k y_i - v_i y_k = v_k X_i - v_i X_k, k being the axis with the greatest g_k v_k^2."""
    k = max(range(3), key=lambda axis: g[axis] * v[axis] ** 2)
    found = []
    for i in ((k + 1) % 3, (k + 2) % 3):
        lead = [v[k] if axis == i else -v[i] if axis == k else ZERO for axis in range(3)]
        rotation = [[factor * entry for entry in b] for factor in lead]
        found.append(new_form(position=lead, rotation=rotation, constant=v[i] * x[k] - v[k] * x[i]))
    return found


def forms_at_point(g: pure.Metric, x: pure.Point, b: pure.Point) -> list[Form]:
    """C + R B = X."""
    axes = [tuple(Fraction(int(i == axis)) for axis in range(3)) for i in range(3)]
    return [
        new_form(position=scaled(1, g, axis), rotation=outer(g, axis, b), constant=-weight * value)
        for axis, weight, value in zip(axes, g, x, strict=True)
    ]


def forms_of_angle(g: pure.Metric, n: pure.Point, m: pure.Point, product: Fraction) -> list[Form]:
    """n.(R m) = c."""
    return [new_form(rotation=outer(g, n, m), constant=-product)]


def forms_of_axis_distance(g: pure.Metric, x: pure.Point, v: pure.Point, b: pure.Point, square: Fraction) -> list[Form]:
    """F and H of the quadric (v.v) F = H^2."""
    return [*forms_of_distance(g, x, b, square), *forms_in_plane(g, v, pure.scalar_product(g, v, x), b)]


def linear_form(_g: pure.Metric, coefficients: Form) -> list[Form]:
    """The form itself."""
    return [coefficients]


def a_direction(value: Any, where: str) -> pure.Point:
    """Three rationals, not all 0."""
    direction: pure.Point = a_point(value, where)
    pure.well_formed(any(direction), f"{where}: 0")
    return direction


a_point: Final = pure.a_list(pure.a_rational, 3)
coefficients_of_a_form: Final = pure.a_list(pure.a_rational, 17)

TYPES: Final[dict[str, tuple[dict[str, pure.Reader], Callable[..., list[Form]]]]] = {
    "distance": (
        {"base": a_point, "platform": a_point, "length_squared": pure.a_positive_rational},
        forms_of_distance,
    ),
    "in-plane": ({"normal": a_direction, "offset": pure.a_rational, "platform": a_point}, forms_in_plane),
    "carries": ({"normal": a_direction, "offset": pure.a_rational, "base": a_point}, forms_carrying),
    "on-line": ({"point": a_point, "direction": a_direction, "platform": a_point}, forms_on_line),
    "at-point": ({"point": a_point, "platform": a_point}, forms_at_point),
    "angle": ({"base": a_direction, "platform": a_direction, "product": pure.a_rational}, forms_of_angle),
    "axis-distance": (
        {
            "point": a_point,
            "direction": a_direction,
            "platform": a_point,
            "radius_squared": pure.a_positive_rational,
        },
        forms_of_axis_distance,
    ),
    "linear": ({"coefficients": coefficients_of_a_form}, linear_form),
}
"""The data of each type of constraint, and the forms that follow from them."""

# ---------------------------------------------------------------------------------------------------------------------
# Motions
# ---------------------------------------------------------------------------------------------------------------------

ABOUT_THE_THIRD_AXIS: Final = ({9: 1}, {12: 1}, {13: 1}, {14: 1}, {15: 1, ONE: -1}, {7: 1, 11: -1})
"""r13, r23, r31, r32, r33 - 1, r11 - r22; g1 r12 + g2 r21 comes with them."""


def fixed_forms(name: str, g: pure.Metric) -> list[Form]:
    """L: a basis of all forms that vanish on the motions."""
    turn = [*ABOUT_THE_THIRD_AXIS, {8: g[0], 10: g[1]}]
    found: dict[str, Sequence[Mapping[int, int]]] = {
        "spatial": [],
        "planar": [{3: 1}, {6: 1}, *turn],
        "schoenflies": [{3: 1, 6: -1}, *turn],
        "translation": [
            *({7 + 3 * i + j: 1, ONE: -int(i == j)} for i in range(3) for j in range(3)),
            *({1 + i: 1, 4 + i: -1} for i in range(3)),
        ],
        "spherical": [{place: 1} for place in range(7)],
    }
    return [sparse_form(entries) for entries in found[name]]


class Kind(NamedTuple):
    """Motions in which a platform is kept: dimension m, degrees d, d', d'', coordinates and twists that are not 0."""

    name: str
    dimension: int
    degrees: tuple[int, int, int]
    support: tuple[int, ...]
    twists: tuple[int, ...]


MOTIONS: Final = {
    kind.name: kind
    for kind in (
        Kind("spatial", 6, (DEGREE, 8, 20), tuple(range(8)), tuple(range(6))),
        Kind("planar", 3, (6, 2, 4), (0, 3, 5, 6), (0, 1, 5)),
        Kind("schoenflies", 4, (8, 2, 4), (0, 3, 4, 5, 6, 7), (0, 1, 2, 5)),
        Kind("translation", 3, (2, 1, 1), (0, 5, 6, 7), (0, 1, 2)),
        Kind("spherical", 3, (8, 8, 8), (0, 1, 2, 3), (3, 4, 5)),
    )
}


class Span:
    """Vectors over Q that are independent, in echelon form."""

    def __init__(self, vectors: Sequence[Sequence[Fraction]] = ()) -> None:
        self.rows: list[tuple[int, list[Fraction]]] = []
        for vector in vectors:
            self.add(vector)

    def remainder(self, vector: Sequence[Fraction]) -> list[Fraction]:
        """What is left of a vector modulo the span: a linear map, whose kernel is the span."""
        rest = list(vector)
        for pivot, row in self.rows:
            pure.spend(3000 * len(rest) + sum(map(cost, rest)) + sum(map(cost, row)))
            factor = rest[pivot]
            if factor:
                rest = [x - factor * y for x, y in zip(rest, row, strict=True)]
        return rest

    def add(self, vector: Sequence[Fraction]) -> bool:
        """Add a vector; whether it was not in the span."""
        rest = self.remainder(vector)
        pivot = next((place for place, value in enumerate(rest) if value), None)
        if pivot is None:
            return False
        self.rows.append((pivot, [value / rest[pivot] for value in rest]))
        return True


def cost(value: Fraction) -> int:
    """Operations for a few products with a fraction in lowest terms."""
    bits = max(value.numerator.bit_length(), value.denominator.bit_length())
    return 20 * pure.product_cost(bits, bits)


# ---------------------------------------------------------------------------------------------------------------------
# Robots, and how many isolated poses they have at most
# ---------------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Constraint:
    """A constraint by its forms, computed from its data; ``weight`` is v.v of a quadric, None of linear forms."""

    type: str
    data: tuple[Any, ...]
    forms: tuple[Form, ...]
    weight: Fraction | None


class Quadric(NamedTuple):
    """(v.v) F h - H^2."""

    weight: Fraction
    f: Form
    h: Form


@dataclass(frozen=True)
class Robot:
    """Constraints on the motions of a kind, and further linear forms for slices."""

    kind: Kind
    metric: pure.Metric
    constraints: tuple[Constraint, ...]
    further: tuple[Form, ...] = ()

    @cached_property
    def fixed(self) -> list[Form]:
        """L."""
        return fixed_forms(self.kind.name, self.metric)

    @cached_property
    def linear(self) -> list[Form]:
        """The linear forms."""
        return [form for c in self.constraints if c.weight is None for form in c.forms] + list(self.further)

    @cached_property
    def quadrics(self) -> list[Quadric]:
        """The quadrics."""
        return [Quadric(c.weight, *c.forms) for c in self.constraints if c.weight is not None]

    @cached_property
    def independent(self) -> list[Form]:
        """The linear forms that are not, modulo L, combinations of those before them."""
        span = Span(self.fixed)
        return [form for form in self.linear if span.add(form)]

    @cached_property
    def number_of_rows(self) -> int:
        """The rank of the linear forms, and k."""
        return len(self.independent) + len(self.quadrics)

    def rank_of_columns(self, places: Sequence[int]) -> int:
        """The rank of some columns of the linear forms and L, less that of L."""
        span = Span([[form[place] for place in places] for form in self.fixed])
        return sum(span.add([form[place] for place in places]) for form in self.linear)

    def bounds(self) -> tuple[int, int]:
        """b1, and b: no more poses than these are isolated."""
        whole, second, third = self.kind.degrees
        k = len(self.quadrics)
        found = [whole << k, second << (k + self.rank_of_columns((0, 1, 2, 3)))]
        if not k:
            found.append(second << self.rank_of_columns((0, 4, 5, 6)))
        if not any(form[0] for form in self.linear):
            found.append(third << k)
        return found[0], min(found)


# ---------------------------------------------------------------------------------------------------------------------
# Format
# ---------------------------------------------------------------------------------------------------------------------

KEYS: Final = (
    "format version robot configuration formulation method claim completeness_route complex_solutions "
    "distinct_solutions real_poses representation infinity elimination self_motion krawczyk box_exponent poses notes"
)
ROUTES: Final = ("refined-bezout", "product-bound", "modular-rank", "counting-at-infinity", "exact-elimination")
CAUSES: Final = ("dependent-forms", "symmetry", "equal-legs", "more-poses-than-bound")


@dataclass(frozen=True)
class PointsAtInfinity:
    """z = Z(t) / h'(t) at the roots t of h, with w.z = 1 and c.z = t."""

    w: tuple[int, ...]
    c: tuple[int, ...]
    h: pure.Polynomial
    numerators: tuple[pure.Polynomial, ...]
    multiplicity: int


@dataclass(frozen=True)
class SelfMotion:
    """Why the poses form a set of positive dimension."""

    cause: str
    real: bool
    forms: tuple[Form, ...]
    slices: tuple[tuple[Fraction, pure.Representation], ...]


@dataclass(frozen=True)
class Certificate(pure.Certificate):
    """What a certificate of version 2 says; ``legs`` are those of a robot that has legs only."""

    robot: Robot
    infinity: PointsAtInfinity | None
    self_motion: SelfMotion | None


a_list_of_forms: Final = pure.a_list(pure.a_list(partial(pure.a_rational, digits=MAX_DIGITS_OF_A_FORM), 17))


def a_constraint(g: pure.Metric, value: Any, where: str) -> Constraint:
    """A constraint, whose forms must be those of its data."""
    kind = value.get("type") if isinstance(value, dict) else None
    pure.one_of(TYPES)(kind, f"{where}.type")
    readers, forms_of = TYPES[str(kind)]
    name, _, *data, listed = pure.an_object(value, where, f"name type {' '.join(readers)} forms")
    pure.a_text(name, f"{where}.name")
    entries = tuple(read(v, f"{where}.{key}") for (key, read), v in zip(readers.items(), data, strict=True))
    forms = tuple(forms_of(g, *entries))
    same = a_list_of_forms(listed, f"{where}.forms") == forms
    pure.require(same, f"{where}: its forms are not those of its data")
    weight = pure.scalar_product(g, entries[1], entries[1]) if kind == "axis-distance" else None
    return Constraint(str(kind), entries, forms, weight)


def a_robot(value: Any, where: str) -> Robot:
    """Motion, metric and constraints."""
    name, unit, source, motion, metric, constraints = pure.an_object(
        value, where, "name unit source motion metric constraints"
    )
    for label, text in (("name", name), ("unit", unit), ("source", source)):
        pure.a_text(text, f"{where}.{label}")
    kind = MOTIONS[pure.one_of(MOTIONS)(motion, f"{where}.motion")]
    weights = pure.a_list(pure.a_positive_rational, 3)(metric, f"{where}.metric")
    pure.well_formed(all(x.denominator == 1 for x in weights), f"{where}.metric: not three integers")
    g = (int(weights[0]), int(weights[1]), int(weights[2]))
    few = not isinstance(constraints, list) or 1 <= len(constraints) <= MAX_CONSTRAINTS
    pure.well_formed(few, f"{where}.constraints: not 1 to {MAX_CONSTRAINTS} constraints")
    return Robot(kind, g, pure.a_list(partial(a_constraint, g))(constraints, f"{where}.constraints"))


def some_points_at_infinity(value: Any, where: str) -> PointsAtInfinity:
    """Points at infinity."""
    w, c, h, numerators, multiplicity = pure.an_object(
        value, where, "chart separating_form eliminant coordinates multiplicity"
    )
    eliminant = pure.a_polynomial(h, f"{where}.eliminant")
    pure.well_formed(len(eliminant) > 1, f"{where}.eliminant: constant")
    return PointsAtInfinity(
        w=pure.a_list(pure.an_integer, 16)(w, f"{where}.chart"),
        c=pure.a_list(pure.an_integer, 16)(c, f"{where}.separating_form"),
        h=eliminant,
        numerators=pure.a_list(pure.a_polynomial, 16)(numerators, f"{where}.coordinates"),
        multiplicity=pure.a_number(multiplicity, f"{where}.multiplicity"),
    )


def a_boolean(value: Any, where: str) -> bool:
    """True or false."""
    pure.well_formed(isinstance(value, bool), f"{where}: not true or false")
    return bool(value)


def a_slice(value: Any, where: str) -> tuple[Fraction, pure.Representation]:
    """A constant and the poses there."""
    constant, representation = pure.an_object(value, where, "constant representation")
    return (
        pure.a_rational(constant, f"{where}.constant"),
        pure.a_representation(representation, f"{where}.representation"),
    )


def a_self_motion(value: Any, where: str) -> SelfMotion:
    """A cause with what proves it."""
    cause, real, forms, slices = pure.an_object(value, where, "cause real forms slices")
    return SelfMotion(
        cause=pure.one_of(CAUSES)(cause, f"{where}.cause"),
        real=a_boolean(real, f"{where}.real"),
        forms=a_list_of_forms(forms, f"{where}.forms"),
        slices=pure.a_list(a_slice)(slices, f"{where}.slices"),
    )


def some_boxes(most: int, value: Any, where: str) -> pure.Boxes:
    """Boxes around real and around complex solutions, which are not more than there can be."""
    chart, real, others = pure.an_object(value, where, "chart real complex")
    lists = isinstance(real, list) and isinstance(others, list)
    few = not lists or len(real) + 2 * len(others) <= most
    pure.require(few, f"boxes: more than {most} solutions, all that there can be")
    return pure.Boxes(
        pure.a_list(pure.an_integer, 4)(chart, f"{where}.chart"),
        pure.a_list(partial(pure.a_box, real=True))(real, f"{where}.real"),
        pure.a_list(partial(pure.a_box, real=False))(others, f"{where}.complex"),
    )


def read(body: dict[str, Any]) -> Certificate:
    """The content of a certificate."""
    pure.well_formed(body.get("format") == "pkm_exact certificate", "format: not a pkm_exact certificate, version 2")
    values = dict(zip(KEYS.split(), pure.an_object(body, "certificate", KEYS), strict=True))

    def entry(key: str, reader: pure.Reader) -> Any:
        return reader(values[key], key)

    entry("configuration", pure.nullable(pure.a_text))
    is_code = pure.FORMULATION.fullmatch(entry("formulation", pure.a_text))
    pure.well_formed(is_code, "formulation: not the code of one")
    entry("notes", pure.a_list(pure.a_text))
    # Of two faults the first decides: what can only be rejected comes where the other checker comes to it.
    robot: Robot = entry("robot", a_robot)
    only_legs = all(constraint.type == "distance" for constraint in robot.constraints)
    return Certificate(
        metric=robot.metric,
        legs=tuple(pure.Leg(*constraint.data) for constraint in robot.constraints) if only_legs else (),
        method=entry("method", pure.one_of(pure.METHODS)),
        claim=entry("claim", pure.one_of(pure.CLAIMS)),
        route=entry("completeness_route", pure.nullable(pure.one_of(ROUTES))),
        counts=(
            entry("complex_solutions", pure.a_number),
            entry("distinct_solutions", pure.a_number),
            entry("real_poses", pure.a_number),
        ),
        representation=entry("representation", pure.nullable(pure.a_representation)),
        elimination=entry("elimination", pure.nullable(pure.a_list(pure.a_step))),
        infinity=entry("infinity", pure.nullable(some_points_at_infinity)),
        self_motion=entry("self_motion", pure.nullable(a_self_motion)),
        boxes=entry("krawczyk", pure.nullable(partial(some_boxes, robot.bounds()[1]))),
        box_exponent=entry("box_exponent", an_exponent),
        poses=entry("poses", pure.a_list(pure.a_pose)),
        robot=robot,
    )


def an_exponent(value: Any, where: str) -> int:
    """Of the grid of the boxes."""
    exponent = pure.a_number(value, where)
    pure.affordable(exponent <= pure.MAX_BOX_EXPONENT, f"{where}: more than {pure.MAX_BOX_EXPONENT}")
    return exponent


# ---------------------------------------------------------------------------------------------------------------------
# Checks 4 and 5: rigid motions at which the constraints hold
# ---------------------------------------------------------------------------------------------------------------------


def quantities(placed: pure.Motion) -> list[Any]:
    """N times the 17 coordinates, in the order of a form."""
    return [placed.square, *placed.turned, *placed.position, *placed.by_rows(), placed.norm]


def integer_quadric(quadric: Quadric) -> tuple[int, list[int], int, list[int]]:
    """(a, F, b, H) over Z, for which a F h - b H^2 is a multiple of the quadric."""
    scale, *f = pure.cleared([Fraction(1), *quadric.f])
    unit, *h = pure.cleared([Fraction(1), *quadric.h])
    a, b = pure.cleared([quadric.weight * unit * unit, Fraction(scale)])
    return a, f, b, h


def check_poses(representation: pure.Representation, robot: Robot) -> Iterator[str]:
    """Checks 4 and 5."""
    h0, g = pure.primitive_part(representation.h), robot.metric
    kept = not any(n for place, n in enumerate(representation.numerators) if place not in robot.kind.support)
    pure.require(kept, f"motion: a coordinate is not 0 that is 0 for every motion of the kind {robot.kind.name}")
    forms = [pure.cleared(form) for form in robot.linear]
    multiples, placed = pure.evaluated(representation, g, max(map(pure.size, forms), default=1))
    pure.require(multiples.include(placed.study), "motion: e.f is not 0 at every root of the eliminant")
    regular = any(pure.is_coprime(h0, pure.norm_modulo(representation, g, p), p) for p in pure.good_primes(h0))
    pure.require(regular, "motion: not proved that N(e) is nowhere 0")
    yield "motion: e.f = 0 and N(e) is not 0, every solution is a rigid motion"
    values = quantities(placed)
    for form in forms:
        holds = multiples.include(pure.combination(form, values))
        pure.require(holds, "constraints: a linear form is not 0 at every solution")
    for quadric in map(integer_quadric, robot.quadrics):
        holds = is_quadric_zero(representation, g, quadric)
        pure.require(holds, "constraints: a quadric is not 0 at every solution")
    number = len(robot.constraints) + bool(robot.further)
    yield f"constraints: all {number} hold at every solution"


def is_quadric_zero(
    representation: pure.Representation, g: pure.Metric, quadric: tuple[int, list[int], int, list[int]]
) -> bool:
    """Whether h0 divides a N F - b H^2, of degree 4 in (E, F)."""
    bound = value_of(quadric, pure.sized_motion(representation, g)).size
    multiples = pure.Multiples(pure.primitive_part(representation.h), bound, 4)
    values = [pure.at_power(numerator, multiples.k) for numerator in representation.numerators]
    return multiples.include(value_of(quadric, pure.motion(values[:4], values[4:], g)))


def value_of(quadric: tuple[int, list[int], int, list[int]], placed: pure.Motion) -> Any:
    """a N F - b H^2."""
    a, f, b, h = quadric
    values = quantities(placed)
    height = pure.combination(h, values)
    return a * (values[ONE] * pure.combination(f, values)) - b * (height * height)


# ---------------------------------------------------------------------------------------------------------------------
# Check 7: regular solutions
# ---------------------------------------------------------------------------------------------------------------------


class Slope(NamedTuple):
    """c' = G^-1 c, times ``scale``: of a form's derivative."""

    scale: int
    square: int
    turned: list[int]
    position: list[int]
    rotation: list[list[int]]


def slope_of(form: Form, g: pure.Metric) -> Slope:
    """The integers that give the derivative."""
    inverse = [Fraction(1, weight) for weight in g]
    vectors = [form[place + i] * inverse[i] for place in (1, 4) for i in range(3)]
    turns = [form[7 + 3 * i + j] * inverse[i] for i in range(3) for j in range(3)]
    scale, square, *entries = pure.cleared([Fraction(1), form[0], *vectors, *turns])
    return Slope(scale, square, entries[:3], entries[3:6], [entries[6 + 3 * i : 9 + 3 * i] for i in range(3)])


def derivative_row(slope: Slope, placed: pure.Motion, twists: Sequence[int]) -> list[Any]:
    """The derivative for v, times N, and for w, times N^2; of the columns those of the twists."""
    rotation, position = placed.rotation, placed.position
    a = [pure.combination(slope.turned, row) for row in rotation]
    row = []
    for twist in twists:
        if twist < 3:
            move = pure.combination([2 * slope.square, slope.position[twist]], [position[twist], placed.norm])
            row.append(move + a[twist])
        else:
            _, j, k = pure.CYCLIC[twist - 3]
            turn = pure.combination(
                [*slope.rotation[k], *(-x for x in slope.rotation[j])], [*rotation[j], *rotation[k]]
            )
            row.append(a[j] * position[k] - a[k] * position[j] + placed.norm * turn)
    return row


class Slopes:
    """The rows of all constraints that are not, modulo L, combinations of those before."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        self.linear = [slope_of(form, robot.metric) for form in robot.independent]
        self.quadrics = []
        for quadric in robot.quadrics:
            f, h = slope_of(quadric.f, robot.metric), slope_of(quadric.h, robot.metric)
            unit, *value = pure.cleared([Fraction(1), *quadric.h])
            weights = pure.cleared([quadric.weight / f.scale, Fraction(2, unit * h.scale)])
            self.quadrics.append((weights, f, h, value))
        self.dimension = robot.kind.dimension
        self.number = robot.number_of_rows

    def at(self, placed: pure.Motion) -> list[list[Any]]:
        """The rows at a pose; those of quadrics times N."""
        twists = self.robot.kind.twists
        rows = [derivative_row(slope, placed, twists) for slope in self.linear]
        for (a, b), f, h, value in self.quadrics:
            left, right = a * placed.norm, b * pure.combination(value, quantities(placed))
            pairs = zip(derivative_row(f, placed, twists), derivative_row(h, placed, twists), strict=True)
            rows.append([left * x - right * y for x, y in pairs])
        return rows


def mixed(rows: Sequence[Sequence[Any]], number: int, random: Random) -> list[list[Any]]:
    """So many combinations of the rows, with random coefficients; the rows themselves if they are as many."""
    if len(rows) == number:
        return [list(row) for row in rows]
    found = []
    for _ in range(number):
        weights = [random.randrange(1, RANDOM) for _ in rows]
        found.append([pure.combination(weights, column) for column in zip(*rows, strict=True)])
    return found


RANDOM: Final = 1 << 16


def determinant_at(
    slopes: Slopes, representation: pure.Representation, h0: pure.Polynomial, p: int, completed: int = 0
) -> pure.Polynomial:
    """The determinant of m combinations of rows modulo p and h0, ``completed`` of them random."""
    spend_on_determinants(slopes.dimension, len(h0), p.bit_length())
    placed = pure.motion_modulo(representation, slopes.robot.metric, h0, p)
    random = Random(p)
    rows = mixed(slopes.at(placed), slopes.dimension - completed, random)
    ring = placed.norm.ring
    for _ in range(completed):
        rows.append([ring.element([random.randrange(1, RANDOM)]) for _ in range(slopes.dimension)])
    return pure.determinant(rows).polynomial()  # type: ignore[no-any-return]


def spend_on_determinants(dimension: int, length: int, bits: int) -> None:
    """Count the work for a determinant, and its rows, in a ring of residues."""
    products = (dimension << dimension) + 200
    pure.spend(products * length * (2000 + pure.product_cost(bits, 2 * bits * length)))


def are_regular(slopes: Slopes, representation: pure.Representation, completed: int = 0) -> bool:
    """Whether a determinant of the rows, completed by random ones, is coprime to h0 modulo a prime."""
    if slopes.number + completed < slopes.dimension:
        return False
    h0 = pure.primitive_part(representation.h)
    return any(
        pure.is_coprime(h0, determinant_at(slopes, representation, h0, p, completed), p) for p in pure.good_primes(h0)
    )


def irregular_factor(slopes: Slopes, representation: pure.Representation) -> pure.Polynomial:
    """The factor of h0, primitive, whose roots are the solutions that are not regular; 1 if all are.

    Modulo a prime it is the greatest common divisor of h0 and a determinant; that the rows are dependent at all of its
    roots is then proved over Q, and that the determinant is not 0 at the others, modulo the prime.
    """
    h0 = pure.primitive_part(representation.h)
    if slopes.number < slopes.dimension:
        return h0
    if are_regular(slopes, representation):
        return [1]
    for p in ((1 << n) - 1 for n in pure.MERSENNE):
        if not h0[-1] % p:
            continue
        determinant = determinant_at(slopes, representation, h0, p)
        common = pure.common_divisor(pure.reduced(h0, p), determinant, p)
        factor = h0 if len(common) == len(h0) else pure.lifted_factor(common, p)
        if len(factor) > 1 and not (pure.is_factor(factor, h0) and are_dependent(slopes, representation, factor)):
            continue
        others = pure.divided(pure.reduced(h0, p), common, p)[0]
        if len(pure.common_divisor(others, determinant, p)) == 1:
            return factor
    raise pure.Refusal("too-large", "regular: not decided at which solutions the rows are dependent")


def are_dependent(slopes: Slopes, representation: pure.Representation, a: pure.Polynomial) -> bool:
    """Whether the rank of the rows is less than m at all roots of a factor of h0, over Q.

    With m rows, if their determinant is 0. With more: for some r < m the first r + 1 columns have rank r at most. Of r
    combinations of the rows these columns have minors, a vector k, that is nowhere 0 modulo a prime, or r = 0; all
    rows are orthogonal to it.
    """
    if slopes.number == slopes.dimension:
        (value,) = large_determinants(slopes, representation, a, None)
        return not value
    ranks = (r for r in reversed(range(1, slopes.dimension)) if has_nonzero_minors(slopes, representation, a, r))
    return not any(large_determinants(slopes, representation, a, next(ranks, 0)))


def combined(slopes: Slopes, placed: pure.Motion, rank: int) -> list[list[Any]]:
    """So many combinations of the rows."""
    return mixed(slopes.at(placed), rank, Random(rank))


def has_nonzero_minors(slopes: Slopes, representation: pure.Representation, a: pure.Polynomial, rank: int) -> bool:
    """Whether the vector of minors is not 0 at any root of a: a random row is not orthogonal to it there."""
    for p in pure.good_primes(a):
        spend_on_determinants(slopes.dimension, len(a), p.bit_length())
        placed = pure.motion_modulo(representation, slopes.robot.metric, a, p)
        random = Random(p)
        row = [placed.norm.ring.element([random.randrange(1, RANDOM)]) for _ in range(slopes.dimension)]
        minors = pure.determinant([*combined(slopes, placed, rank), row]).polynomial()
        if pure.is_coprime(a, minors, p):
            return True
    return False


def large_determinants(
    slopes: Slopes, representation: pure.Representation, a: pure.Polynomial, rank: int | None
) -> Iterator[pure.Polynomial]:
    """The determinant of the rows, or those of each row below combinations, modulo a.

    A determinant is a polynomial in T of a degree d and of a size S at most; l^d times its remainder, l being the
    leading coefficient of a, has integer coefficients of a size of at most S size(a)^d. They are computed modulo a
    greater number.
    """
    m = slopes.dimension
    pure.spend(slopes.number * m << m)
    bounds = determinants(slopes, pure.sized_motion(representation, slopes.robot.metric), rank)
    bound = max(each.size * pure.size(a) ** each.degree for each in bounds)
    n = pure.exponent_above(bound, a[-1])
    spend_on_determinants(m, len(a), n)
    placed = pure.motion_modulo(representation, slopes.robot.metric, a, (1 << n) - 1)
    for each in determinants(slopes, placed, rank):
        spend_on_determinants(m, len(a), n)
        yield each.polynomial()


def determinants(slopes: Slopes, placed: pure.Motion, rank: int | None) -> Iterator[Any]:
    """That of the rows, or those of each row below combinations, in the first columns."""
    rows = slopes.at(placed)
    if rank is None:
        yield pure.determinant(rows)
        return
    above = combined(slopes, placed, rank)
    for row in rows:
        yield pure.determinant([*above, row])


# ---------------------------------------------------------------------------------------------------------------------
# Check 8: the section
# ---------------------------------------------------------------------------------------------------------------------


def variable(place: int, number: int) -> pure.Monomial:
    """The monomial of an unknown."""
    return tuple(int(place == other) for other in range(number))


def quadrics_of_motions(g: pure.Metric) -> list[Quadratic]:
    """The quadrics of X, homogeneous in the 17 coordinates."""
    coordinates = [{variable(place, 16): Fraction(1)} for place in (*range(1, 7), 0, *range(7, 16))]
    one: pure.Affine = {(0,) * 16: Fraction(1)}
    found = []
    for polynomial in pure.motion_quadrics(coordinates, g, one):
        quadratic = {}
        for monomial, value in polynomial.items():
            places = [place for place, exponent in enumerate(monomial) for _ in range(exponent)]
            first, second = (*places, ONE, ONE)[:2]
            quadratic[first, second] = value
        found.append(quadratic)
    return found


def quadratic_of(quadric: Quadric) -> Quadratic:
    """(v.v) F h - H^2."""
    found: Quadratic = {}
    for place, value in enumerate(quadric.f):
        found[place, ONE] = quadric.weight * value
    for one, x in enumerate(quadric.h):
        for other, y in enumerate(quadric.h):
            key = min(one, other), max(one, other)
            found[key] = found.get(key, ZERO) - x * y
    return {key: value for key, value in found.items() if value}


def all_quadrics(robot: Robot) -> list[Quadratic]:
    """Those of X and of the robot."""
    return [*quadrics_of_motions(robot.metric), *map(quadratic_of, robot.quadrics)]


def affine_coordinates(forms: Sequence[Form]) -> tuple[tuple[int, ...], list[pure.Affine]] | None:
    """The places of the unknowns in (u, C, |C|^2, R) and the 17 coordinates; None if 1 = 0 follows from the forms."""
    order = (*range(1, 7), 0, *range(7, 17))  # of the columns
    rows: list[pure.Terms] = [
        {(-n,): value for n, value in enumerate(pure.cleared([form[i] for i in order])) if value} for form in forms
    ]
    pivots = {-next(iter(row))[0]: row for row in pure.echelon_form(rows)}
    if ONE in pivots:
        return None
    places = tuple(place for place in range(16) if place not in pivots)
    one = (0,) * len(places)
    monomials = {place: variable(n, len(places)) for n, place in enumerate(places)} | {ONE: one}
    found: list[pure.Affine] = [{one: Fraction(1)}] * 17
    for column, index in enumerate(order):
        if column in pivots:
            (_, lead), *rest = pivots[column].items()
            found[index] = {monomials[-other]: Fraction(-value, lead) for (other,), value in rest}
        else:
            found[index] = {monomials[column]: Fraction(1)}
    return places, found


def section(robot: Robot) -> tuple[tuple[int, ...], list[pure.Terms]]:
    """The unknowns, by their places in (u, C, |C|^2, R), and the elements: of degree 2, or 1 alone."""
    forms = [*robot.linear, *robot.fixed]
    quadrics = all_quadrics(robot)
    while True:
        solved = affine_coordinates(forms)
        if solved is None:
            return (), [{(): 1}]
        places, coordinates = solved
        polynomials = [
            pure.added(*((value, pure.multiplied(coordinates[i], coordinates[j])) for (i, j), value in q.items()))
            for q in quadrics
        ]
        elements = pure.echelon_form([pure.cleared_terms(p) for p in polynomials if p])
        degrees = [sum(next(iter(element))) for element in elements]
        if 0 in degrees:
            return (), [{(): 1}]
        lines = [element for element, degree in zip(elements, degrees, strict=True) if degree == 1]
        if not lines:
            return places, elements
        forms += [line_form(line, places) for line in lines]


def line_form(line: pure.Terms, places: Sequence[int]) -> Form:
    """A polynomial of degree 1 in the unknowns as a form."""
    entries = {}
    for monomial, value in line.items():
        column = places[monomial.index(1)] if any(monomial) else ONE
        entries[0 if column == 6 else column + 1 if column < 6 else column] = value
    return sparse_form(entries)


def eliminated(certificate: Certificate) -> pure.Elimination:
    """The elimination, from the section on."""
    places, elements = section(certificate.robot)
    if not places and elements:
        pure.require(not certificate.elimination, "elimination: steps, but it is proved at once that there is no pose")
    return pure.followed(places, elements, certificate.elimination or ())


# ---------------------------------------------------------------------------------------------------------------------
# Checks 12 and 13: points at infinity
# ---------------------------------------------------------------------------------------------------------------------


def primes_of(robot: Robot) -> list[int]:
    """Primes on which no robot is built: they follow from it."""
    numbers = [number for form in robot.linear for number in pure.cleared(form)]
    numbers += [
        number for quadric in robot.quadrics for form in (quadric.f, quadric.h) for number in pure.cleared(form)
    ]
    return list(pure.good_primes([*numbers, 1]))[-ATTEMPTS:]


def solved_relations(relations: Iterable[Mapping[int, int]], p: int) -> dict[int, dict[int, int]]:
    """The reduced echelon form modulo a prime: rows by their pivots, which are 1 and left out."""
    solved: dict[int, dict[int, int]] = {}
    for relation in relations:
        row: dict[int, int] = {}
        for column, value in relation.items():
            known = solved.get(column)
            if known is None:
                row[column] = row.get(column, 0) + value
            else:
                pure.spend(len(known) * 500)
                for other, entry in known.items():
                    row[other] = row.get(other, 0) - value * entry
        pure.spend(400 * len(row))
        row = {column: rest for column, value in row.items() if (rest := value % p)}
        if not row:
            continue
        lead = min(row)
        inverse = pow(row.pop(lead), -1, p)
        row = {column: value * inverse % p for column, value in row.items()}
        pure.spend(100 * len(solved) + 400 * len(row))
        for pivot, known in solved.items():
            if lead in known:
                factor = known.pop(lead)
                pure.spend(400 * len(row) + 100 * len(known))
                total = known | {column: known.get(column, 0) - factor * value for column, value in row.items()}
                solved[pivot] = {column: rest for column, value in total.items() if (rest := value % p)}
        solved[lead] = row
    return solved


def commuting(products: Sequence[Sequence[Mapping[int, int]]], size: int) -> Iterator[dict[int, int]]:
    """The relations x_i (x_j c) = x_j (x_i c), of symbols x_i a with the number ``i size + a``."""
    for i, j in combinations(range(len(products)), 2):
        for left, right in zip(products[j], products[i], strict=True):
            relation = {i * size + place: value for place, value in left.items()}
            relation |= {j * size + place: -value for place, value in right.items()}
            yield relation


def graded_dimensions(number: int, quadrics: Sequence[Mapping[tuple[int, int], int]], most: int, p: int) -> list[int]:
    """dim A_0, dim A_1, .. modulo a prime, up to the first 0, or to that of degree ``most``.

    A = S / J, J generated by the quadrics. ``multiplied[i]`` are the products of x_i and the basis of A_(t-1).
    """
    found = [1, number]
    products = [[{i: 1}] for i in range(number)]
    while found[-1] and len(found) <= most:
        size = found[-1]
        entries = number * size * (found[-2] * number * (number - 1) // 2 + len(quadrics))
        pure.affordable(entries <= MAX_ENTRIES, f"section: a matrix of more than {MAX_ENTRIES} entries")
        relations = commuting(products, size)
        if len(found) == 2:
            relations = chain(
                relations, ({i * size + j: value for (i, j), value in quadric.items()} for quadric in quadrics)
            )
        solved = solved_relations(relations, p)
        free = {symbol: place for place, symbol in enumerate(s for s in range(number * size) if s not in solved)}
        products = [
            [
                {free[symbol]: 1}
                if symbol in free
                else {free[other]: -value for other, value in solved[symbol].items()}
                for symbol in range(i * size, (i + 1) * size)
            ]
            for i in range(number)
        ]
        found.append(len(free))
    return found


def poses_at_most(robot: Robot) -> int | None:
    """Check 13: a number that the solutions, with multiplicity, do not exceed; None if it is not found."""
    places, elements = section(robot)
    if elements == [{(): 1}] and not places:
        return 0
    tops = []
    for element in elements:
        top = {}
        for monomial, value in element.items():
            if sum(monomial) == 2:
                i, j = (place for place, exponent in enumerate(monomial) for _ in range(exponent))
                top[i, j] = value
        tops.append(top)
    for p in primes_of(robot):
        dimensions = graded_dimensions(len(places), tops, MAX_DEGREE_OF_MONOMIALS + 1, p)
        if not dimensions[-1]:
            return sum(dimensions)
    return None


def is_finite(robot: Robot) -> bool:
    """Whether the section of X by the forms is finite, points at infinity included; of no cylinders."""
    quadrics = [dict(zip(q, pure.cleared(list(q.values())), strict=True)) for q in quadrics_of_motions(robot.metric)]
    forms = [dict(enumerate(pure.cleared(form))) for form in robot.linear]
    return any(is_finite_modulo(forms, quadrics, p) for p in primes_of(robot))


def is_finite_modulo(
    forms: Sequence[Mapping[int, int]], quadrics: Sequence[Mapping[tuple[int, int], int]], p: int
) -> bool:
    """Whether, modulo a prime, forms, quadrics and a random form have all monomials of some degree."""
    random = Random(p)
    solved = solved_relations([*forms, {place: random.randrange(p) for place in range(17)}], p)
    unknowns = {place: number for number, place in enumerate(c for c in range(17) if c not in solved)}
    coordinates = [
        {unknowns[place]: 1}
        if place in unknowns
        else {unknowns[other]: -value for other, value in solved[place].items()}
        for place in range(17)
    ]
    found = []
    for quadric in quadrics:
        total: dict[tuple[int, int], int] = {}
        for (i, j), value in quadric.items():
            for one, x in coordinates[i].items():
                for other, y in coordinates[j].items():
                    key = min(one, other), max(one, other)
                    total[key] = (total.get(key, 0) + value * x * y) % p
        found.append(total)
    return not graded_dimensions(len(unknowns), found, MAX_DEGREE_OF_MONOMIALS, p)[-1]


def check_infinity(infinity: PointsAtInfinity, robot: Robot, weight: int) -> Iterator[str]:
    """Check 12."""
    fits = robot.kind.name == "spatial" and not robot.quadrics
    pure.require(fits, "infinity: the points count for spatial motions without cylinders only")
    degree = len(infinity.h) - 1
    pure.require(degree <= DEGREE, f"infinity: more than {DEGREE} points")
    check_points(infinity)
    padded = [pure.padded(numerator, degree) for numerator in infinity.numerators]
    for form in robot.linear:
        weights = pure.cleared(form)[:16]
        inside = not any(pure.combination(weights, column) for column in zip(*padded, strict=True))
        pure.require(inside, "infinity: a linear form is not 0 at every point")
    check_points_on_motions(infinity, robot.metric)
    singular = number_of_singular(infinity, robot.metric)
    count = degree + singular
    pure.require(infinity.multiplicity == count, f"infinity: multiplicity {infinity.multiplicity}, proved is {count}")
    yield f"infinity: {degree} points, {singular} of them singular on the motions, count {count}"
    full = weight + count == DEGREE
    pure.require(full, f"infinity: {weight} solutions and {count} at infinity are not {DEGREE}")
    pure.require(is_finite(robot), "section: not proved finite")
    yield "section: finite, points at infinity included"


def check_points(infinity: PointsAtInfinity) -> None:
    """The points are distinct: eliminant, chart and separating form."""
    h, degree = infinity.h, len(infinity.h) - 1
    numbers = [*h, *(coefficient for numerator in infinity.numerators for coefficient in numerator)]
    pure.spend(2 * len(numbers) * pure.division_cost(pure.most_bits(numbers), pure.most_bits(h)))
    content = gcd(*h, *(coefficient for numerator in infinity.numerators for coefficient in numerator))
    pure.require(h[-1] > 0 and content == 1, "infinity: not in lowest terms with positive leading coefficient")
    h0 = pure.primitive_part(h)
    squarefree = any(pure.is_coprime(h0, pure.derivative(h0), p) for p in pure.good_primes(h0))
    pure.require(squarefree, "infinity: the eliminant is not proved squarefree")
    small = all(len(numerator) <= degree for numerator in infinity.numerators)
    pure.require(small, "infinity: a coordinate has not a smaller degree than the eliminant")
    columns = list(zip(*(pure.padded(numerator, degree) for numerator in infinity.numerators), strict=True))
    slope = pure.derivative(h)
    pure.require([pure.combination(infinity.w, column) for column in columns] == slope, "infinity: w.z is not 1")
    expected = [(power - degree) * coefficient for power, coefficient in enumerate(h[:-1])]
    form = [pure.combination(infinity.c, column) for column in columns]
    pure.require(form == expected, "infinity: the separating form does not take the roots as values")


def check_points_on_motions(infinity: PointsAtInfinity, g: pure.Metric) -> None:
    """h0 divides the quadrics of X, the last coordinate being 0."""
    quadrics = []
    for quadratic in quadrics_of_motions(g):
        kept = {key: value for key, value in quadratic.items() if key[1] != ONE}
        quadrics.append(dict(zip(kept, pure.cleared(list(kept.values())), strict=True)))
    largest = max(map(pure.size, infinity.numerators))
    scale = max(pure.size(list(quadric.values())) for quadric in quadrics)
    multiples = pure.Multiples(pure.primitive_part(infinity.h), scale * largest**2)
    z = [pure.at_power(numerator, multiples.k) for numerator in infinity.numerators]
    terms, bits = sum(map(len, quadrics)), pure.most_bits(z)
    pure.spend(terms * (pure.product_cost(bits, bits) + pure.product_cost(scale.bit_length(), 2 * bits)))
    for quadric in quadrics:
        inside = multiples.include(sum(value * z[i] * z[j] for (i, j), value in quadric.items()))
        pure.require(inside, "infinity: a point is not a limit of rigid motions")


def number_of_singular(infinity: PointsAtInfinity, g: pure.Metric) -> int:
    """The number of points where X is singular."""
    square, *others = infinity.numerators
    turned, position, rotation = others[:3], others[3:6], others[6:]
    tangents = []
    for i in range(3):
        for j in range(3):
            left = exact_product(position[i], turned[j])
            right = exact_product(square, rotation[3 * i + j])
            length = max(len(left), len(right))
            pairs = zip(pure.padded(left, length), pure.padded(right, length), strict=True)
            tangents.append([2 * g[j] * x - y for x, y in pairs])
    h0 = pure.primitive_part(infinity.h)
    one, other = degree_of_common_roots(h0, tangents), degree_of_common_roots(h0, rotation)
    return one + other - degree_of_common_roots(h0, [*tangents, *rotation])


def exact_product(a: pure.Polynomial, b: pure.Polynomial) -> pure.Polynomial:
    """The product over Z."""
    k = (pure.size(a) * pure.size(b)).bit_length() + 2
    pure.spend(pure.product_cost(k * len(a), k * len(b)))
    return pure.digits(pure.at_power(a, k) * pure.at_power(b, k), k)


def degree_of_common_roots(h0: pure.Polynomial, polynomials: Sequence[pure.Polynomial]) -> int:
    """The degree of the greatest common divisor over Q, not less modulo a prime; that it is as great is proved."""
    for p in ((1 << n) - 1 for n in (61, *pure.MERSENNE)):
        if not h0[-1] % p:
            continue
        pure.spend(len(polynomials) * len(h0) ** 2 * (1000 + pure.product_cost(p.bit_length(), p.bit_length())))
        common = pure.reduced(h0, p)
        for polynomial in polynomials:
            rest = pure.divided(pure.reduced(polynomial, p), common, p)[1] if len(common) > 1 else []
            common = pure.common_divisor(common, rest, p)
        if len(common) == 1:
            return 0
        factor = h0 if len(common) == len(h0) else pure.lifted_factor(common, p)
        if pure.is_factor(factor, h0) and all(
            pure.is_factor(factor, polynomial) for polynomial in polynomials if any(polynomial)
        ):
            return len(factor) - 1
    raise pure.Refusal("too-large", "infinity: not decided at which points the motions are singular")


# ---------------------------------------------------------------------------------------------------------------------
# Check 11: boxes
# ---------------------------------------------------------------------------------------------------------------------

Matrix: TypeAlias = list[list[int]]


class Expanded(NamedTuple):
    """A quadratic form q at m + h: value and derivative at m, and bounds of what they change by."""

    value: pure.Gaussian
    slope: list[pure.Gaussian]
    change: Fraction
    bend: list[Fraction]


def expanded(matrix: Matrix, x: Sequence[pure.Gaussian], reach: Sequence[Fraction]) -> Expanded:
    """With q(m + h) - q(m) = (M m).h + h.(M h) / 2 and q'(m + h) - q'(m) = M h."""
    bits = max(map(pure.most_bits, matrix))
    pure.spend(6 * len(x) ** 2 * pure.fraction_cost(pure.bits_of(x) + bits, pure.bits_of(x) + bits))
    slope = [pure.dot(row, x) for row in matrix]
    bend = [sum((abs(v) * h for v, h in zip(row, reach, strict=True)), ZERO) for row in matrix]
    change = sum((s.size() * h + b * h / 2 for s, b, h in zip(slope, bend, reach, strict=True)), ZERO)
    value = Fraction(1, 2) * pure.total(a * b for a, b in zip(slope, x, strict=True))
    return Expanded(value, slope, change, bend)


@dataclass(frozen=True)
class Quartic:
    """a N F - b H^2, the quadratic forms given by their matrices."""

    a: int
    b: int
    norm: Matrix
    f: Matrix
    h: Matrix

    def parts(self, x: Sequence[pure.Gaussian], reach: Sequence[Fraction]) -> list[Expanded]:
        """N, F and H near a point."""
        bits = pure.bits_of(x) + max(pure.most_bits(row) for matrix in (self.norm, self.f, self.h) for row in matrix)
        pure.spend(12 * len(x) ** 2 * pure.fraction_cost(bits, bits))
        return [expanded(matrix, x, reach) for matrix in (self.norm, self.f, self.h)]

    def value(self, x: Sequence[pure.Gaussian]) -> pure.Gaussian:
        """The value."""
        norm, f, h = self.parts(x, [ZERO] * len(x))
        return self.a * (norm.value * f.value) - self.b * (h.value * h.value)

    def slope(self, x: Sequence[pure.Gaussian]) -> list[pure.Gaussian]:
        """The derivative a (N' F + N F') - 2 b H H'."""
        norm, f, h = self.parts(x, [ZERO] * len(x))
        return [
            self.a * (n * f.value + norm.value * s) - (2 * self.b) * (h.value * t)
            for n, s, t in zip(norm.slope, f.slope, h.slope, strict=True)
        ]

    def bend(self, x: Sequence[pure.Gaussian], reach: Sequence[Fraction]) -> list[Fraction]:
        """Bounds of what the derivative changes by."""
        norm, f, h = self.parts(x, reach)

        def changed(one: Expanded, other: Expanded, j: int) -> Fraction:
            """The change of one' other: |one'| |d other| + |d one'| (|other| + |d other|)."""
            return one.slope[j].size() * other.change + one.bend[j] * (other.value.size() + other.change)

        return [
            self.a * (changed(norm, f, j) + changed(f, norm, j)) + 2 * self.b * changed(h, h, j)
            for j in range(len(reach))
        ]


@dataclass(frozen=True)
class System(pure.System):
    """Equations of which the first ones may be of degree 4."""

    quartics: tuple[Quartic, ...]

    def slopes(self, x: Sequence[pure.Gaussian]) -> list[list[pure.Gaussian]]:
        """F'(x)."""
        return [*(quartic.slope(x) for quartic in self.quartics), *super().slopes(x)]

    def bends(self, x: Sequence[pure.Gaussian], reach: Sequence[Fraction]) -> list[list[Fraction]]:
        """Bounds of |F'(x + h) - F'(x)|."""
        return [*(quartic.bend(x, reach) for quartic in self.quartics), *super().bends(x, reach)]

    def values(self, x: Sequence[pure.Gaussian], slopes: Sequence[Sequence[pure.Gaussian]]) -> list[pure.Gaussian]:
        """F(x)."""
        number = len(self.quartics)
        return [*(quartic.value(x) for quartic in self.quartics), *super().values(x, slopes[number:])]


def system_of(robot: Robot, chart: Sequence[int]) -> System:
    """The equations for boxes: as many as unknowns."""
    square = robot.number_of_rows == robot.kind.dimension
    pure.require(square, "boxes: there are not as many independent constraints as freedoms")
    places, g = robot.kind.support, robot.metric
    bound = robot.kind.name in ("spatial", "schoenflies")
    forms = [plain_form(pure.cleared(form)) for form in robot.independent]
    matrix = pure.matrices(places, g)
    norm = matrix(lambda placed: placed.norm)
    quartics = []
    for a, f, b, h in map(integer_quadric, robot.quadrics):
        of_f, of_h = (matrix(partial(pure.form_value, plain_form(form))) for form in (f, h))
        quartics.append(Quartic(a, b, norm, of_f, of_h))
    plain = pure.study_system(places, forms, g, chart, is_bound=bound)
    return System(plain.places, plain.forms, plain.chart, plain.norm, tuple(quartics))


def plain_form(form: Sequence[int]) -> list[int]:
    """A form in the order of ``pure``: of 1, R, C, u, |C|^2."""
    return [form[ONE], *form[7:16], *form[4:7], *form[1:4], form[0]]


# ---------------------------------------------------------------------------------------------------------------------
# Check 14: self-motions
# ---------------------------------------------------------------------------------------------------------------------


def number_of_real_roots(representation: pure.Representation) -> int:
    """How many of the poses are real."""
    return len(pure.real_roots(pure.primitive_part(representation.h)))


def has_symmetry(robot: Robot) -> bool:
    """Whether a motion of the platform, or of the base, of the kind leaves all forms as they are, modulo L."""
    forms = [*robot.linear, *(form for quadric in robot.quadrics for form in (quadric.f, quadric.h))]
    fixed = Span(robot.fixed)
    for rates in (rates_of_platform, rates_of_base):
        changes = Span()
        for twist in robot.kind.twists:
            t, w = [[Fraction(int(twist == place + i)) for i in range(3)] for place in (0, 3)]
            rate = rates(robot.metric, t, w)
            vector = [value for form in forms for value in fixed.remainder(changed_form(form, rate))]
            if not changes.add(vector):
                return True
    return False


def changed_form(form: Form, rate: Sequence[Mapping[int, Fraction]]) -> list[Fraction]:
    """The rate of a form: the combination of those of the coordinates."""
    found = [ZERO] * 17
    for coefficient, entries in zip(form, rate, strict=True):
        if coefficient:
            for place, value in entries.items():
                found[place] += coefficient * value
    return found


def turning(g: pure.Metric, w: Sequence[Fraction]) -> list[list[Fraction]]:
    """W with W x = G^-1 (w x x)."""
    found = [[ZERO] * 3 for _ in range(3)]
    for i, j, k in pure.CYCLIC:
        found[i][k] = w[j] / g[i]
        found[i][j] = -w[k] / g[i]
    return found


def rates_of_platform(g: pure.Metric, t: Sequence[Fraction], w: Sequence[Fraction]) -> list[dict[int, Fraction]]:
    """s: 2 t.u, u: t - W u, C: R t, R: R W."""
    turn = turning(g, w)
    return [
        {1 + i: 2 * g[i] * t[i] for i in range(3)},
        *({ONE: t[i], **{1 + j: -turn[i][j] for j in range(3)}} for i in range(3)),
        *({7 + 3 * i + j: t[j] for j in range(3)} for i in range(3)),
        *({7 + 3 * i + k: turn[k][j] for k in range(3)} for i in range(3) for j in range(3)),
        {},
    ]


def rates_of_base(g: pure.Metric, t: Sequence[Fraction], w: Sequence[Fraction]) -> list[dict[int, Fraction]]:
    """s: 2 t.C, u: G^-1 R^T G t, C: t + W C, R: W R."""
    turn = turning(g, w)
    return [
        {4 + i: 2 * g[i] * t[i] for i in range(3)},
        *({7 + 3 * j + i: g[j] * t[j] / g[i] for j in range(3)} for i in range(3)),
        *({ONE: t[i], **{4 + j: turn[i][j] for j in range(3)}} for i in range(3)),
        *({7 + 3 * k + j: turn[i][k] for k in range(3)} for i in range(3) for j in range(3)),
        {},
    ]


def legs_are_equal(certificate: Certificate, representation: pure.Representation) -> bool:
    """Whether R B_i - A_i is the same for all legs, at all poses."""
    planar_or_spatial = certificate.robot.kind.name in ("spatial", "planar")
    if not planar_or_spatial or not certificate.legs:
        return False
    return len(certificate.legs) == 1 or pure.legs_are_one_vector(certificate, representation)


def path_is_real(certificate: Certificate) -> bool:
    """Whether the sphere or circle of equal legs has more than one real point: in the plane legs may stand upright."""
    leg, robot = certificate.legs[0], certificate.robot
    upright = robot.metric[2] * (leg.base[2] - leg.platform[2]) ** 2 if robot.kind.name == "planar" else 0
    return bool(leg.length_squared > upright)


def checked(representation: pure.Representation, robot: Robot, where: str = "") -> Iterator[str]:
    """Checks 1 to 5."""
    try:
        yield from (f"{where}{line}" for line in pure.check_eliminant(representation, pure.MAX_DEGREE))
        yield from (f"{where}{line}" for line in pure.check_distinct(representation))
        yield from (f"{where}{line}" for line in check_poses(representation, robot))
    except pure.Refusal as refusal:
        raise pure.Refusal(refusal.status, f"{where}{refusal.line}") from None


def check_slices(self_motion: SelfMotion, robot: Robot) -> Generator[str, None, bool]:
    """More poses in slices than can be isolated; returns whether more than that are real and regular."""
    pure.require(self_motion.forms, "self-motion: no form to cut with")
    *others, last = self_motion.forms
    increasing = all(a < b for (a, _), (b, _) in pairwise(self_motion.slices))
    pure.require(increasing, "self-motion: the constants of the slices do not increase")
    number = real = 0
    for place, (constant, representation) in enumerate(self_motion.slices, 1):
        cut = replace(robot, further=(*others, (*last[:ONE], last[ONE] - constant)))
        yield from checked(representation, cut, f"slice {place}: ")
        number += len(representation.h) - 1
        if are_regular(Slopes(cut), representation):
            real += number_of_real_roots(representation)
    bound = replace(robot, further=tuple(others)).bounds()[1]
    pure.require(number > bound, f"self-motion: {number} poses in slices are not more than {bound}")
    yield f"self-motion: {number} poses, more than the {bound} that can be isolated"
    return real > bound


def check_self_motion(certificate: Certificate, self_motion: SelfMotion) -> Iterator[str]:
    """Check 14."""
    representation = certificate.representation
    if self_motion.cause == "more-poses-than-bound":
        pure.require(representation is None, "self-motion: the poses are in slices, not in a representation")
        real = yield from check_slices(self_motion, certificate.robot)
    else:
        alone = not self_motion.forms and not self_motion.slices
        if representation is None or not alone:
            raise pure.Refusal("rejected", "self-motion: needs a representation, and neither forms nor slices")
        yield from checked(representation, certificate.robot)
        real = yield from check_cause(certificate, self_motion.cause, representation)
    pure.require(self_motion.real == real, "self-motion: what is claimed of real poses is not what is proved")
    if real:
        yield "self-motion: real poses form a curve at least; the mechanism moves with its actuators locked"
    else:
        yield "self-motion: complex poses form it; that one of them is real, and the mechanism moves, is not proved"


def check_cause(
    certificate: Certificate, cause: str, representation: pure.Representation
) -> Generator[str, None, bool]:
    """One of the first three causes; returns whether a real motion is proved."""
    robot = certificate.robot
    real = number_of_real_roots(representation) > 0
    if cause == "dependent-forms":
        free = robot.kind.dimension - robot.number_of_rows
        pure.require(free > 0, "self-motion: the constraints are not dependent")
        yield "self-motion: the constraints are dependent, their poses form sets of positive dimension"
        return real and are_regular(Slopes(robot), representation, free)
    if cause == "symmetry":
        pure.require(has_symmetry(robot), "self-motion: no motion of the platform or of the base leaves all forms")
        yield "self-motion: a group of motions leaves all constraints as they are"
        return real
    equal = legs_are_equal(certificate, representation)
    pure.require(equal, "self-motion: the legs are not the same vector at every pose")
    yield "self-motion: all legs are the same vector, their poses form a sphere or circle"
    return real and path_is_real(certificate)


# ---------------------------------------------------------------------------------------------------------------------
# Checks 9 and 10: counts and claims
# ---------------------------------------------------------------------------------------------------------------------


class Listed(NamedTuple):
    """The solutions that are listed: D, W, and the factor of h0 at whose roots the weight is 2."""

    number: int
    weight: int
    double: pure.Polynomial


def check_parts(certificate: Certificate) -> None:
    """What a certificate must have depends on its method, claim and route."""
    boxes = certificate.boxes is not None
    if certificate.method == "krawczyk":
        alone = boxes and certificate.representation is None and certificate.self_motion is None
        pure.require(alone, "method: krawczyk needs boxes, and neither a representation nor a self-motion")
    else:
        beside = not boxes or certificate.claim.startswith("positive-dimensional")
        pure.require(beside, "method: exact, but boxes around solutions, and no positive dimension is claimed")
    moving = certificate.claim == "positive-dimensional-proved"
    pure.require((certificate.self_motion is not None) == moving, "claim: it does not fit the self-motion")
    for part, route in (
        (certificate.infinity, "counting-at-infinity"),
        (certificate.elimination, "exact-elimination"),
    ):
        pure.require((part is not None) == (certificate.route == route), f"claim: the route is not {route}")


def check_claims(certificate: Certificate) -> Iterator[str]:
    """The claim is what is proved, no more and no less."""
    claimed, listed = certificate.counts[2], len(certificate.poses)
    pure.require(claimed == listed, f"real poses: {claimed} claimed, {listed} listed")
    check_parts(certificate)
    if certificate.claim.startswith("positive-dimensional"):
        yield from check_positive_dimension(certificate)
    else:
        yield from solutions(certificate)
    pure.require(listed or not certificate.box_exponent, "boxes: a grid is given, but there is no pose")


def check_positive_dimension(certificate: Certificate) -> Iterator[str]:
    """A set of positive dimension, and isolated poses beside it in boxes."""
    pure.require(certificate.route is None, "claim: beside positive dimension, completeness is claimed")
    number = 0 if certificate.boxes is None else certificate.boxes.number()
    if certificate.boxes is not None and certificate.method == "exact":
        bound = certificate.robot.bounds()[1]
        pure.require(number < bound, f"claim: {bound} isolated solutions are all that there are")
        check_simple(certificate, number)
        yield f"isolated: {number} solutions lie on no curve of poses"
    else:
        nothing = not (number or any(certificate.counts))
        pure.require(nothing, "claim: beside positive dimension, isolated solutions are claimed without boxes")
    if certificate.self_motion is not None:
        yield from check_self_motion(certificate, certificate.self_motion)
        return
    pure.require(certificate.representation is None, "claim: positive dimension is not proved by the representation")
    yield "positive dimension detected: evidence found by the solver, no proof"


def check_simple(certificate: Certificate, number: int) -> None:
    """The counts and multiplicities of solutions in boxes."""
    total, distinct, _ = certificate.counts
    same = total == distinct == number
    pure.require(same, f"complex solutions: {total}, {distinct} distinct claimed, {number} proved")
    for place, pose in enumerate(certificate.poses, 1):
        pure.require(pose.multiplicity == 1, f"multiplicity: that of pose {place} differs from what is proved")


def listed_solutions(certificate: Certificate) -> Listed:
    """The solutions in the representation, in boxes, or none."""
    if certificate.representation is not None:
        factor = irregular_factor(Slopes(certificate.robot), certificate.representation)
        number = len(certificate.representation.h) - 1
        return Listed(number, number + len(factor) - 1, factor)
    number = 0 if certificate.boxes is None else certificate.boxes.number()
    return Listed(number, number, [1])


def solutions(certificate: Certificate) -> Iterator[str]:
    """The claim, the counts and the multiplicities, where no positive dimension is claimed."""
    listed = listed_solutions(certificate)
    total, distinct, _ = certificate.counts
    pure.require(listed.number or not certificate.poses, "representation: missing, but solutions are claimed")
    pure.require(distinct == listed.number, f"distinct solutions: {distinct} claimed, {listed.number} proved")
    if certificate.infinity is not None:
        yield from check_infinity(certificate.infinity, certificate.robot, listed.weight)
    proved = proved_of_all(certificate, listed)
    pure.require(
        (certificate.claim, certificate.route) == (proved.claim, proved.route),
        f"claim: {certificate.claim} by {certificate.route or 'no route'}, but what is proved is {proved.claim} by "
        f"{proved.route or 'no route'}",
    )
    pure.require(proved.total in (None, total), f"complex solutions: {total} claimed, {proved.total} proved")
    if proved.total is None:
        possible = listed.number <= total <= max(listed.number, certificate.robot.bounds()[1])
        pure.require(possible, f"complex solutions: {total} claimed, {listed.number} distinct ones proved")
    for place, pose in enumerate(certificate.poses, 1):
        expected = None if proved.multiplicity is None else proved.multiplicity.get(pose.parameter or ("", ""), 1)
        same = pose.multiplicity == expected
        pure.require(same, f"multiplicity: that of pose {place} differs from what is proved")
    yield last_line(listed, proved)


def last_line(listed: Listed, proved: pure.Proved) -> str:
    """What is proved, in words."""
    if proved.claim == "complete":
        counts = f"{listed.number} distinct, {proved.total} with multiplicity"
        return f"complete: {counts}, by {proved.route}; there is no other solution"
    if proved.claim == "inconsistent":
        return "inconsistent: no pose, real or complex, has what the constraints ask"
    return f"not proven complete: {listed.number} solutions are proved, others are not excluded"


def proved_of_all(certificate: Certificate, listed: Listed) -> pure.Proved:
    """The strongest claim that is proved."""
    simple = listed.number == listed.weight
    claim = "complete" if listed.number else "inconsistent"
    weights = weights_of_poses(certificate, listed)
    if certificate.infinity is not None:
        return pure.Proved(claim, "counting-at-infinity", listed.weight, not simple, weights)
    if certificate.elimination is not None:
        return proved_by_elimination(certificate, listed, claim)
    if listed.number:
        first, bound = certificate.robot.bounds()
        if simple and listed.number == bound:
            route = "refined-bezout" if bound == first else "product-bound"
            return pure.Proved(claim, route, listed.number, False, {})
    if certificate.route == "modular-rank":
        most = poses_at_most(certificate.robot)
        pure.require(most == listed.weight, f"claim: {listed.weight} solutions, not proved that there are no others")
        return pure.Proved(claim, "modular-rank", listed.weight, not simple, weights)
    return pure.Proved("not-proven-complete", None, listed.number if simple else None, False, {} if simple else None)


def weights_of_poses(certificate: Certificate, listed: Listed) -> dict[pure.Ends, int]:
    """2 for the real solutions that are not regular, by their parameters."""
    if certificate.representation is None or len(listed.double) == 1:
        return {}
    return pure.doubled(listed.double, certificate.representation)


def proved_by_elimination(certificate: Certificate, listed: Listed, claim: str) -> pure.Proved:
    """Complete if the weights fill what is left, or by the algebra of all poses."""
    elimination = eliminated(certificate)
    basis = elimination.basis(certificate.robot.bounds()[0])
    simple = listed.number == listed.weight
    if listed.weight == len(basis):
        weights = weights_of_poses(certificate, listed)
        return pure.Proved(claim, "exact-elimination", len(basis), not simple, weights)
    representation = certificate.representation
    line = f"elimination: it leaves {len(basis)} monomials, the solutions are not proved to fill them"
    if representation is None or simple:
        raise pure.Refusal("rejected", line)
    algebra = pure.quotient_algebra(elimination, basis)
    powers = partial(pure.powers_modulo, representation, certificate.robot.metric, elimination.places)
    v = algebra and pure.multiplicity_polynomial(algebra, representation, powers, len(elimination.places))
    if not v:
        raise pure.Refusal("rejected", line)
    found = pure.multiplicities(v, representation)
    return pure.Proved(claim, "exact-elimination", len(basis), True, found)


# ---------------------------------------------------------------------------------------------------------------------
# All checks
# ---------------------------------------------------------------------------------------------------------------------


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    return checks(read(body))


def checks(certificate: Certificate) -> Iterator[str]:
    """One line per claim that is proved; witnesses of a self-motion are checked with the claim."""
    representation = certificate.representation
    if representation is not None and certificate.claim != "positive-dimensional-proved":
        yield from checked(representation, certificate.robot)
        yield from pure.check_real_poses(certificate, representation)
    if certificate.boxes is not None:
        system = system_of(certificate.robot, certificate.boxes.w)
        yield from pure.check_boxes(system, certificate.boxes)
        yield from pure.check_poses_in_boxes(certificate, certificate.boxes, system)
    yield from check_claims(certificate)

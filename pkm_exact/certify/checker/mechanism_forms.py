"""Mechanisms as the checker knows them: groups of motions, and constraints as linear forms and quadrics on motions.

A form has 17 rational coefficients, of |C|^2, u = R^-1 C (3), C (3), R by rows (9) and 1. With the metric G = diag(g)
and the product u.v = g1 u1 v1 + g2 u2 v2 + g3 u3 v3:

    distance    |C|^2 + 2 B.u - 2 A.C - 2 A.(R B) + A.A + B.B - l^2
    in-plane    n.C + n.(R B) - d
    carries     -m.u + A.(R m) - d
    angle       n.(R m) - c

A point on a line or at a point is on two or three planes. A cylinder is the quadric (v.v) F - H^2 of two forms.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import chain
from math import lcm
from operator import mul
from types import MappingProxyType
from typing import Any, Final, TypeAlias

from flint import fmpz_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.study_motion import Metric, Motion, Point, combination

Form: TypeAlias = tuple[Fraction, ...]
Row: TypeAlias = tuple[int, ...]
"""A form with integer coefficients."""

SIZE: Final = 17
_NAMES: Final = ("s", "u1", "u2", "u3", "c1", "c2", "c3", *(f"r{i}{j}" for i in "123" for j in "123"), "1")
_PLACE: Final = {name: place for place, name in enumerate(_NAMES)}
_ZERO: Final = Fraction(0)


def _form(**coefficients: int) -> Row:
    """The form with these coefficients; "one" is that of 1."""
    row = [0] * SIZE
    for name, value in coefficients.items():
        row[_PLACE["1" if name == "one" else name]] = value
    return tuple(row)


def _turn_forms(metric: Metric) -> tuple[Row, ...]:
    """R turns about the third axis."""
    zeros = tuple(_form(**{name: 1}) for name in ("r13", "r23", "r31", "r32"))
    return (*zeros, _form(r33=1, one=-1), _form(r11=1, r22=-1), _form(r12=metric[0], r21=metric[1]))


def _spatial(_metric: Metric) -> tuple[Row, ...]:
    return ()


def _planar(metric: Metric) -> tuple[Row, ...]:
    return (_form(u3=1), _form(c3=1), *_turn_forms(metric))


def _schoenflies(metric: Metric) -> tuple[Row, ...]:
    return (_form(u3=1, c3=-1), *_turn_forms(metric))


def _translation(_metric: Metric) -> tuple[Row, ...]:
    fixed = tuple(_form(**{f"r{i}{j}": 1}, one=-int(i == j)) for i in (1, 2, 3) for j in (1, 2, 3))
    return (*fixed, *(_form(**{f"u{i}": 1, f"c{i}": -1}) for i in (1, 2, 3)))


def _spherical(_metric: Metric) -> tuple[Row, ...]:
    return tuple(_form(**{name: 1}) for name in ("s", "u1", "u2", "u3", "c1", "c2", "c3"))


@dataclass(frozen=True)
class Group:
    """A group of motions, a variety in P^16.

    Attributes
    ----------
    dimension : int
    degree, plain_degree, squareless_degree : int
        Of its closure; of its image in the coordinates (R, 1) and C or u; in those without |C|^2.
    forms : callable
        A basis of the forms that vanish on it, for a metric.
    support : tuple of int
        Places in (e0, .., e3, f0, .., f3) that are not always 0.
    twists : tuple of int
        Places in (v1, v2, v3, w1, w2, w3) that are not always 0.
    """

    dimension: int
    degree: int
    plain_degree: int
    squareless_degree: int
    forms: Callable[[Metric], tuple[Row, ...]]
    support: tuple[int, ...]
    twists: tuple[int, ...]

    @property
    def has_study_condition(self) -> bool:
        """Whether e.f = 0 is a condition on the support."""
        return any(k + 4 in self.support for k in self.support)


GROUPS: Final[Mapping[str, Group]] = MappingProxyType(
    {
        "spatial": Group(6, 40, 8, 20, _spatial, tuple(range(8)), tuple(range(6))),
        "planar": Group(3, 6, 2, 4, _planar, (0, 3, 5, 6), (0, 1, 5)),
        "schoenflies": Group(4, 8, 2, 4, _schoenflies, (0, 3, 4, 5, 6, 7), (0, 1, 2, 5)),
        "translation": Group(3, 2, 1, 1, _translation, (0, 5, 6, 7), (0, 1, 2)),
        "spherical": Group(3, 8, 8, 8, _spherical, (0, 1, 2, 3), (3, 4, 5)),
    }
)


@dataclass(frozen=True)
class Quadric:
    """factor F - H^2, which vanishes at the poses: a cylinder, factor being v.v."""

    factor: Fraction
    whole: Form
    root: Form


@dataclass(frozen=True)
class Leg:
    """Base joint, platform joint and squared length of a constraint of the type distance."""

    base: Point
    platform: Point
    length_squared: Fraction


@dataclass(frozen=True)
class Constraint:
    """What a constraint asks: linear forms, and a quadric if it is a cylinder; its joints if it is a leg."""

    linear: tuple[Form, ...] = ()
    quadric: Quadric | None = None
    leg: Leg | None = None

    @cached_property
    def integral(self) -> list[Row]:
        """The linear forms, each times a denominator."""
        return [tuple(cleared(form)) for form in self.linear]

    @property
    def forms(self) -> tuple[Form, ...]:
        """All forms that a certificate spells out for it."""
        return self.linear if self.quadric is None else (self.quadric.whole, self.quadric.root)


@dataclass(frozen=True)
class Mechanism:
    """A group of motions, a metric, and constraints."""

    group: Group
    metric: Metric
    constraints: tuple[Constraint, ...]

    @property
    def linear(self) -> list[Form]:
        """The linear forms of all constraints."""
        return [form for constraint in self.constraints for form in constraint.linear]

    @property
    def quadrics(self) -> list[Quadric]:
        """The quadrics of all cylinders."""
        return [constraint.quadric for constraint in self.constraints if constraint.quadric is not None]

    @cached_property
    def vanishing(self) -> tuple[Row, ...]:
        """The forms that vanish on all motions of the group."""
        return self.group.forms(self.metric)

    def with_forms(self, forms: Sequence[Form]) -> Mechanism:
        """The mechanism with further linear forms."""
        return Mechanism(self.group, self.metric, (*self.constraints, Constraint(tuple(forms))))

    @cached_property
    def integral(self) -> list[Row]:
        """The linear forms, each times a denominator."""
        return [row for constraint in self.constraints for row in constraint.integral]

    @property
    def rank(self) -> int:
        """The rank of the linear forms on the motions of the group."""
        return self._rank_of(range(SIZE))

    @cached_property
    def bound(self) -> int:
        """No more isolated poses than this, by the degrees of the motions in different coordinates."""
        group, cylinders, linear = self.group, len(self.quadrics), self.linear
        bounds = [group.degree << cylinders, group.plain_degree << (cylinders + self._rank_of((0, 1, 2, 3)))]
        if not cylinders:
            bounds.append(group.plain_degree << self._rank_of((0, 4, 5, 6)))
        if not any(form[0] for form in linear):
            bounds.append(group.squareless_degree << cylinders)
        return min(bounds)

    @property
    def least_bound(self) -> int:
        """What the bound is at least, whatever the forms are."""
        return self.group.plain_degree << len(self.quadrics)

    @property
    def degree_bound(self) -> int:
        """The bound by the degree of the group's own variety."""
        return self.group.degree << len(self.quadrics)

    def _rank_of(self, columns: Sequence[int]) -> int:
        """The rank of some columns of the linear forms, beside the forms that vanish on the group."""
        rows = [[form[column] for column in columns] for form in (*self.integral, *self.vanishing)]
        return _rank(rows) - _rank(rows[len(self.integral) :])


def rank_beside(forms: Sequence[Form], others: Sequence[Sequence[Fraction | int]]) -> int:
    """The rank of some forms together with others, less that of the others."""
    return _rank(list(map(cleared, [*forms, *others]))) - _rank(list(map(cleared, others)))


def _rank(rows: Sequence[Sequence[int]]) -> int:
    return int(matrix(rows).rank()) if rows else 0


def matrix(rows: Sequence[Sequence[int]]) -> fmpz_mat:
    """Integer coefficients, a form in a row, of which the rank or the echelon form is asked."""
    words = len(rows[0]) * limbs(max(map(int.bit_length, chain.from_iterable(rows))))
    charge(len(rows) * len(rows[0]) * (2000 + min(len(rows), len(rows[0])) * (500 + words * words // 2)))
    return fmpz_mat(rows)


def cleared(form: Sequence[Fraction | int]) -> list[int]:
    """The form times the least common denominator of its coefficients."""
    return _numerators(form)[0]


def quantities(placed: Motion) -> list[Any]:
    """N times (|C|^2; u; C; R; 1) in the order of forms."""
    rotation = (entry for row in placed.rotation for entry in row)
    return [placed.square, *placed.turned, *placed.position, *rotation, placed.norm]


def quadric_value(quadric: Quadric, values: Sequence[Any], norm: Any) -> Any:
    """A multiple of factor N F - H^2, from N times the quantities."""
    scale = lcm(*(value.denominator for form in (quadric.whole, quadric.root) for value in form))
    whole, root = (combination([int(x * scale) for x in form], values) for form in (quadric.whole, quadric.root))
    return quadric.factor.numerator * scale * (norm * whole) - quadric.factor.denominator * (root * root)


def product(metric: Metric, left: Sequence[Fraction], right: Sequence[Fraction]) -> Fraction:
    """The product of two vectors."""
    return _sum(_scaled(metric, left, 1), right)


def _sum(left: Sequence[Fraction], right: Sequence[Fraction]) -> Fraction:
    return left[0] * right[0] + left[1] * right[1] + left[2] * right[2]


def _joined(
    square: int, turned: Sequence[Fraction], position: Sequence[Fraction], rotation: Sequence[Fraction], one: Fraction
) -> Form:
    return (Fraction(square), *turned, *position, *rotation, one)


def _scaled(metric: Metric, vector: Sequence[Fraction], factor: int) -> list[Fraction]:
    return [factor * g * x for g, x in zip(metric, vector, strict=True)]


def _outer(metric: Metric, left: Sequence[Fraction], right: Sequence[Fraction], factor: int) -> list[Fraction]:
    return [x * y for x in _scaled(metric, left, factor) for y in right]


_NONE: Final = (_ZERO,) * 3


def distance(metric: Metric, base: Point, platform: Point, square: Fraction) -> Constraint:
    """A leg of squared length ``square``: in integers, as there are many of its kind."""
    (a, a_divisor), (b, b_divisor) = (_numerators(point) for point in (base, platform))
    position = [-2 * g * x for g, x in zip(metric, a, strict=True)]
    turned = [2 * g * y for g, y in zip(metric, b, strict=True)]
    rotation = [x * y for x in position for y in b]
    both = a_divisor * b_divisor
    norms = sum(map(mul, turned, b)) * a_divisor**2 - sum(map(mul, position, a)) * b_divisor**2
    constant = _fraction(norms // 2, both * both) - square
    parts = ((turned, b_divisor), (position, a_divisor), (rotation, both))
    form = (Fraction(1), *(_fraction(value, divisor) for part, divisor in parts for value in part), constant)
    return Constraint((form,), leg=Leg(base, platform, square))


def _numerators(values: Sequence[Fraction | int]) -> tuple[list[int], int]:
    """The numbers times their least common denominator, and this."""
    denominator = lcm(*(value.denominator for value in values))
    return [value.numerator * (denominator // value.denominator) for value in values], denominator


def _fraction(value: int, divisor: int) -> Fraction:
    return Fraction(value) if divisor == 1 else Fraction(value, divisor)


def _in_plane(metric: Metric, normal: Sequence[Fraction], offset: Fraction, platform: Point) -> Form:
    return _joined(0, _NONE, _scaled(metric, normal, 1), _outer(metric, normal, platform, 1), -offset)


def in_plane(metric: Metric, normal: Point, offset: Fraction, platform: Point) -> Constraint:
    """A platform point in a plane of the base."""
    return Constraint((_in_plane(metric, normal, offset, platform),))


def carries(metric: Metric, normal: Point, offset: Fraction, base: Point) -> Constraint:
    """A base point in a plane of the platform."""
    return Constraint((_joined(0, _scaled(metric, normal, -1), _NONE, _outer(metric, base, normal, 1), -offset),))


def angle(metric: Metric, base: Point, platform: Point, value: Fraction) -> Constraint:
    """The product of a direction of the base and one of the platform."""
    return Constraint((_joined(0, _NONE, _NONE, _outer(metric, base, platform, 1), -value),))


def on_line(metric: Metric, point: Point, direction: Point, platform: Point) -> Constraint:
    """A platform point on a line: v_k y_i - v_i y_k is that of the point, for the two axes i after the largest, k."""
    k = max(range(3), key=lambda axis: (metric[axis] * direction[axis] ** 2, -axis))
    forms = []
    for i in ((k + 1) % 3, (k + 2) % 3):
        row = [_ZERO] * SIZE
        row[4 + i], row[4 + k] = direction[k], -direction[i]
        for j in range(3):
            row[7 + 3 * i + j], row[7 + 3 * k + j] = direction[k] * platform[j], -direction[i] * platform[j]
        row[16] = direction[i] * point[k] - direction[k] * point[i]
        forms.append(tuple(row))
    return Constraint(tuple(forms))


def at_point(metric: Metric, point: Point, platform: Point) -> Constraint:
    """A platform point at a base point."""
    forms = []
    for i in range(3):
        axis = [Fraction(int(j == i)) for j in range(3)]
        forms.append(_in_plane(metric, axis, metric[i] * point[i], platform))
    return Constraint(tuple(forms))


def axis_distance(metric: Metric, point: Point, direction: Point, platform: Point, square: Fraction) -> Constraint:
    """A platform point at the squared distance ``square`` from an axis."""
    whole = distance(metric, point, platform, square).linear[0]
    root = _in_plane(metric, direction, product(metric, direction, point), platform)
    return Constraint(quadric=Quadric(product(metric, direction, direction), whole, root))


def linear(_metric: Metric, coefficients: Form) -> Constraint:
    """Any form."""
    return Constraint((coefficients,))

"""What a mechanism with passive bodies asks of the poses of its bodies, as polynomials over the rational numbers.

The k-th body has the unknowns xk, yk, zk for its position C, and for its rotation R either ck, sk (turns about the
third axis) or rk_11, .., rk_33; those that its motion does not change are left out. So no pose is lost or met twice,
and joints at a point are linear. With d = C_b - C_a, the motion of body b seen from a has the 17 coordinates

    (d.d; R_b^-1 d; R_a^-1 d; R_a^-1 R_b; 1)

in which constraints are linear forms (``constraints.form``), or a form minus a square. In a metric with the Gram
diagonal g, G = diag(g), all coordinates are the file's: R^T G R = G, R^-1 = G^-1 R^T G, and the cofactor of r_ij times
g_j is g_i r_ij. A turn has c^2 + g_1 g_2 s^2 = 1 (``geometry.planar_rotation``).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from flint import fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.systems.input_limits import INPUT_LIMITS
from pkm_exact.systems.polynomial_grammar import rational_ring
from pkm_exact.systems.system_sources import polynomial_system

if TYPE_CHECKING:
    from pkm_exact.geometry.links import Links

Polynomial: TypeAlias = Any
"""An ``fmpq_mpoly``, or a rational number."""
AXES: Final = (0, 1, 2)
_CYCLIC: Final = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


@dataclass(frozen=True)
class BodyUnknowns:
    """The unknowns of a body by their places in its pose; entries that are not unknown are constant.

    Attributes
    ----------
    position : tuple of 3 str or None
    turn : tuple of 2 str, or None
        Cosine and sine, of a body that turns about the third axis only.
    rotation : 3 x 3 tuple of str, or None
    """

    position: tuple[str | None, str | None, str | None]
    turn: tuple[str, str] | None
    rotation: tuple[tuple[str, ...], ...] | None

    @property
    def names(self) -> tuple[str, ...]:
        """All of them, in their order."""
        turned = self.turn or ()
        entries = [name for row in self.rotation or () for name in row]
        return (*(name for name in self.position if name), *turned, *entries)


def body_unknowns(links: Links) -> tuple[BodyUnknowns, ...]:
    """The unknowns of all bodies, in order."""
    return tuple(_unknowns(links, number) for number in range(1, len(links.bodies) + 1))


def _unknowns(links: Links, number: int) -> BodyUnknowns:
    motion = links.bodies[number - 1].motion
    flat = links.is_planar or motion.is_planar
    moves = [axis in motion.twist and not (flat and axis == 2) for axis in AXES]
    x, y, z = (f"{letter}{number}" if moved else None for letter, moved in zip("xyz", moves, strict=True))
    if 5 not in motion.twist:
        return BodyUnknowns((x, y, z), None, None)
    if 3 not in motion.twist:
        return BodyUnknowns((x, y, z), (f"c{number}", f"s{number}"), None)
    return BodyUnknowns((x, y, z), None, tuple(tuple(f"r{number}_{i}{j}" for j in "123") for i in "123"))


@dataclass(frozen=True)
class _Placed:
    """Position and rotation of a body, as polynomials."""

    position: tuple[Polynomial, ...]
    rotation: tuple[tuple[Polynomial, ...], ...]


class LinkEquations:
    """The equations of a mechanism, its actuators locked.

    Parameters
    ----------
    links : Links
    constraints : sequence of Constraint
        With their values (``Links.locked``).

    Raises
    ------
    InputError
        If there are too many unknowns.
    """

    def __init__(self, links: Links, constraints: Sequence[Constraint]) -> None:
        self.links = links
        self.constraints = tuple(constraints)
        self.bodies = body_unknowns(links)
        self.names = tuple(name for body in self.bodies for name in body.names)
        if len(self.names) > INPUT_LIMITS.variables:
            raise InputError(
                f"bodies: {len(self.names)} unknowns in all, at most {INPUT_LIMITS.variables} are possible; give fewer "
                "bodies, or some of them a smaller motion"
            )

    @property
    def metric(self) -> Metric:
        """The Gram diagonal of all coordinates."""
        return self.links.declared.metric

    @property
    def ring(self) -> fmpq_mpoly_ctx:
        """The polynomials in all unknowns."""
        return rational_ring(self.names)

    @cached_property
    def placed(self) -> tuple[_Placed, ...]:
        """The poses of the ground and of all bodies."""
        ring = self.ring
        unknowns = dict(zip(self.names, ring.gens(), strict=True))
        zero, one = ring.constant(0), ring.constant(1)
        unit = tuple(tuple(one if i == j else zero for j in AXES) for i in AXES)
        found = [_Placed((zero,) * 3, unit)]
        for body in self.bodies:
            position = tuple(zero if name is None else unknowns[name] for name in body.position)
            rotation = unit
            if body.turn is not None:
                c, s = (unknowns[name] for name in body.turn)
                rotation = ((c, -self.metric[1] * s, zero), (self.metric[0] * s, c, zero), (zero, zero, one))
            elif body.rotation is not None:
                rotation = tuple(tuple(unknowns[name] for name in row) for row in body.rotation)
            found.append(_Placed(position, rotation))
        return tuple(found)

    def system(self) -> PolynomialSystem:
        """All of them over Z: rotations first, body by body, then the constraints in their order.

        Raises
        ------
        InputError
            If the numbers in them are too long.
        """
        polynomials = [*self.rotations(spare=True), *self.constraint_polynomials()]
        return polynomial_system(polynomials, self.names)

    def rotations(self, *, spare: bool) -> Iterator[fmpq_mpoly]:
        """What makes rotations of matrices: R^T R = 1; with what follows from it and det R = 1, if ``spare``."""
        g = self.metric
        for body, placed in zip(self.bodies, self.placed[1:], strict=True):
            if body.turn is not None:
                (c, minus, _), (s, _, _), _ = placed.rotation
                yield c * c - minus * s - 1
            elif body.rotation is not None:
                columns = tuple(zip(*placed.rotation, strict=True))
                yield from _orthonormal(columns, [fmpq(weight) for weight in g])
                if spare:
                    yield from _orthonormal(placed.rotation, [fmpq(1, weight) for weight in g])
                    yield from _right_handed(placed.rotation, g)

    def constraint_polynomials(self) -> Iterator[fmpq_mpoly]:
        """What the constraints ask."""
        for constraint, (first, second) in zip(self.constraints, self.links.joined, strict=True):
            a, b = self.placed[first], self.placed[second]
            if isinstance(constraint, AtPoint):
                yield from _joined(constraint, a, b)
                continue
            seen = _seen(a, b, self.metric)
            for form in constraint.forms(self.metric):
                yield _value(form, seen)
            for square in constraint.squares(self.metric):
                root = _value(square.root, seen)
                yield _value(square.linear, seen) - _rational(square.factor) * root * root


def _orthonormal(vectors: Sequence[Sequence[Polynomial]], weights: Sequence[fmpq]) -> Iterator[fmpq_mpoly]:
    """The products of the columns, or of the rows with the inverse weights, are the weights."""
    for i in AXES:
        for j in range(i, 3):
            yield _dot(_weighted(weights, vectors[i]), vectors[j]) - (weights[i] if i == j else 0)


def _right_handed(rows: Sequence[Sequence[Polynomial]], metric: Metric) -> Iterator[fmpq_mpoly]:
    """Each entry is its cofactor, but for their weights."""
    for i, a, b in _CYCLIC:
        for j, c, d in _CYCLIC:
            yield metric[j] * (rows[a][c] * rows[b][d] - rows[a][d] * rows[b][c]) - metric[i] * rows[i][j]


def _joined(constraint: AtPoint, a: _Placed, b: _Placed) -> Iterator[fmpq_mpoly]:
    """A point of one body is one of the other: linear, if it is said in the coordinates of the ground."""
    point, other = _moved(b, constraint.platform), _moved(a, constraint.point)
    for left, right in zip(point, other, strict=True):
        yield left - right


def _moved(placed: _Placed, point: Sequence[Fraction]) -> list[Polynomial]:
    return [
        origin + _dot([_rational(x) for x in point], row)
        for origin, row in zip(placed.position, placed.rotation, strict=True)
    ]


def _seen(a: _Placed, b: _Placed, metric: Metric) -> list[Polynomial]:
    """The 17 coordinates of the motion of b seen from a."""
    g = [fmpq(weight) for weight in metric]
    d = [second - first for first, second in zip(a.position, b.position, strict=True)]
    heavy = _weighted(g, d)
    of_a, of_b = (
        tuple(
            [x if weight == 1 else x / weight for x in column]
            for column, weight in zip(zip(*placed.rotation, strict=True), g, strict=True)
        )
        for placed in (a, b)
    )
    turned, position = ([_dot(column, heavy) for column in columns] for columns in (of_b, of_a))
    columns = tuple(zip(*b.rotation, strict=True))
    rotation = [_dot(left, _weighted(g, right)) for left in of_a for right in columns]
    return [_dot(d, heavy), *turned, *position, *rotation, 1]


def _weighted(weights: Sequence[fmpq], vector: Sequence[Polynomial]) -> list[Polynomial]:
    return [x if weight == 1 else weight * x for weight, x in zip(weights, vector, strict=True)]


def _value(form: Sequence[Fraction], seen: Sequence[Polynomial]) -> Polynomial:
    return _dot([_rational(value) for value in form], seen)


def _dot(left: Sequence[Polynomial], right: Sequence[Polynomial]) -> Polynomial:
    total = left[0] * right[0]
    for x, y in zip(left[1:], right[1:], strict=True):
        total = total + x * y
    return total


def _rational(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)

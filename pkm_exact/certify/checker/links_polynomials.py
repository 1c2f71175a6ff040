"""The polynomials of a mechanism with passive bodies, derived from its constraints.

With d = C_b - C_a a constraint on body b, seen from body a, is one on the motion (d.d; R_b^-1 d; R_a^-1 d; R_a^-1 R_b;
1), products those of the metric: R^-1 = G^-1 R^T G.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any, TypeAlias

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.links_document import Joined, LinksDocument, Unknowns
from pkm_exact.certify.checker.study_motion import Metric
from pkm_exact.certify.checker.system_terms import Terms

_COST = 2 * 10**6
"""Operations charged for a constraint whose numbers fill one word."""
_AXES = (0, 1, 2)
Entry: TypeAlias = Any


@dataclass(frozen=True)
class _Body:
    """Position and rotation, by entries in the ring of all unknowns."""

    origin: list[Entry]
    turned: list[list[Entry]]

    def point(self, place: Sequence[Fraction]) -> list[Entry]:
        """Where a point of the body is."""
        return [self.origin[i] + sum(_number(place[j]) * self.turned[i][j] for j in _AXES) for i in _AXES]

    def components(self, vector: Sequence[Entry], g: Metric) -> list[Entry]:
        """R^-1 times a vector."""
        return [sum(fmpq(g[i], g[j]) * self.turned[i][j] * vector[i] for i in _AXES) for j in _AXES]


def polynomials_of(document: LinksDocument, *, spare: bool) -> list[Terms]:
    """All that are not 0, over Z; with those of rotations that follow from R^T R = 1 and det R = 1, if ``spare``."""
    ring = fmpq_mpoly_ctx.get(tuple(document.names), Ordering.degrevlex)
    gens = dict(zip(document.names, ring.gens(), strict=True))
    zero, one = ring.constant(0), ring.constant(1)
    g = document.metric
    bodies = [_placed(body, gens, (zero, one), g) for body in (Unknowns((None,) * 3, (), ()), *document.bodies)]
    found: list[fmpq_mpoly] = []
    for unknowns, body in zip(document.bodies, bodies[1:], strict=True):
        if unknowns.turn:
            c, s = (gens[name] for name in unknowns.turn)
            found.append(c**2 + g[0] * g[1] * s**2 - 1)
        if unknowns.rotation:
            found += _of_rotation(body.turned, g, spare=spare)
    for joined in document.joined:
        charge(_COST * _words(joined))
        found += _of_constraint(joined, bodies[joined.first], bodies[joined.second], g)
    return [terms for terms in map(_over_integers, found) if terms]


def _words(joined: Joined) -> int:
    numbers = [x for form in joined.constraint.forms for x in form]
    return max(limbs(max(x.numerator.bit_length(), x.denominator.bit_length())) for x in numbers) ** 2


def _placed(
    unknowns: Unknowns, gens: dict[str, fmpq_mpoly], constants: tuple[fmpq_mpoly, fmpq_mpoly], g: Metric
) -> _Body:
    zero, one = constants
    origin = [zero if name is None else gens[name] for name in unknowns.position]
    turned = [[one if i == j else zero for j in _AXES] for i in _AXES]
    if unknowns.turn:
        c, s = (gens[name] for name in unknowns.turn)
        turned[0][:2], turned[1][:2] = [c, -g[1] * s], [g[0] * s, c]
    if unknowns.rotation:
        turned = [[gens[name] for name in row] for row in unknowns.rotation]
    return _Body(origin, turned)


def _of_rotation(r: list[list[Entry]], g: Metric, *, spare: bool) -> Iterator[fmpq_mpoly]:
    pairs = [(i, j) for i in _AXES for j in _AXES if i <= j]
    for i, j in pairs:
        yield sum(g[k] * r[k][i] * r[k][j] for k in _AXES) - g[i] * int(i == j)
    if not spare:
        return
    for i, j in pairs:
        yield sum(fmpq(1, g[k]) * r[i][k] * r[j][k] for k in _AXES) - fmpq(int(i == j), g[i])
    for i in _AXES:
        for j in _AXES:
            (a, b), (c, d) = (((i + 1) % 3, (i + 2) % 3), ((j + 1) % 3, (j + 2) % 3))
            yield g[j] * (r[a][c] * r[b][d] - r[a][d] * r[b][c]) - g[i] * r[i][j]


def _of_constraint(joined: Joined, a: _Body, b: _Body, g: Metric) -> Iterator[fmpq_mpoly]:
    if joined.is_point:
        yield from _joined_points(joined, a, b, g)
        return
    d = [b.origin[i] - a.origin[i] for i in _AXES]
    columns = [[b.turned[k][j] for k in _AXES] for j in _AXES]
    seen = [a.components(column, g) for column in columns]
    between = [seen[j][i] for i in _AXES for j in _AXES]
    motion = [sum(g[i] * d[i] * d[i] for i in _AXES), *b.components(d, g), *a.components(d, g), *between]
    constraint = joined.constraint
    for form in constraint.linear:
        yield _value(form, motion)
    if constraint.quadric is not None:
        quadric = constraint.quadric
        yield _value(quadric.whole, motion) - _value(quadric.root, motion) ** 2 / _number(quadric.factor)


def _joined_points(joined: Joined, a: _Body, b: _Body, g: Metric) -> Iterator[fmpq_mpoly]:
    """The forms of type at-point are g_i (C_i + R_i1 B_1 + R_i2 B_2 + R_i3 B_3 - X_i)."""
    forms = joined.constraint.linear
    on_b = [forms[0][7 + j] / g[0] for j in _AXES]
    on_a = [-form[16] / weight for form, weight in zip(forms, g, strict=True)]
    for x, y in zip(b.point(on_b), a.point(on_a), strict=True):
        yield x - y


def _value(form: Sequence[Fraction], motion: Sequence[Entry]) -> Entry:
    return sum((_number(x) * y for x, y in zip(form[:-1], motion, strict=True) if x), _number(form[-1]) + 0 * motion[0])


def _number(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def _over_integers(polynomial: fmpq_mpoly) -> Terms:
    terms = {tuple(map(int, key)): value for key, value in polynomial.to_dict().items()}
    denominator = lcm(*(int(value.q) for value in terms.values()))
    return {key: int(value.p) * (denominator // int(value.q)) for key, value in terms.items()}

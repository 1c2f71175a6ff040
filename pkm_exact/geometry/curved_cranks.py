"""Inverse kinematics of a crank whose constraint is quadratic in cosine and sine: a rod on a collar that turns freely.

With cosine (1 - w t^2) / (1 + w t^2) and sine 2 t / (1 + w t^2) the equation becomes one of degree 4 in the half
tangent t, found by evaluating it at a few angles, exactly. It has up to four real roots, one of them infinite where its
degree is less. A direction v that a crank turns divides an equation by |v|^2, by which it is multiplied first.

    a t^4 + b t^3 + c t^2 + d t + e:  27 D = 4 I^3 - J^2,  I = 12 a e - 3 b d + c^2,
                                      J = 72 a c e + 9 b c d - 27 (a d^2 + b^2 e) - 2 c^3

D is the discriminant (Cayley). It is 0 where two roots meet, infinite ones and those that are not real among them.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import lcm
from typing import Final, TypeAlias

from pkm_exact.constraints.constraint import Linear, Role
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import CosSin, cosine_and_sine
from pkm_exact.geometry.drives import Drive
from pkm_exact.geometry.inverse import Matrix, dot
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.quartic_roots import PolynomialRoot, ValueAtRoot, quotient_at, real_roots
from pkm_exact.geometry.surds import Surd, quadratic_roots
from pkm_exact.geometry.working_modes import CrankMode, EnclosedCrank, FreeCrank
from pkm_exact.radicals import RootSum
from pkm_exact.wording import shown

CurvedMode: TypeAlias = CrankMode | EnclosedCrank | FreeCrank
_DEGREE: Final = 4
_EXTRA: Final = 3
"""Angles at which the equation found is tried."""
_HALF_TURN: Final = CrankMode(Surd(Fraction(-1)), Surd(Fraction(0)), None)


def curved_modes(
    mechanism: Mechanism, drive: Drive, position: Vector, rotation: Matrix
) -> tuple[tuple[CurvedMode, ...], Fraction]:
    """All angles of a crank at which its constraint holds, in increasing half tangent, and the discriminant.

    Raises
    ------
    InputError
        If the equation is not of degree four in the half tangent, or has no meaning at an angle.
    """
    equation = _equation(mechanism, drive, position, rotation)
    quartic = _quartic(drive, equation)
    scale = lcm(*(c.denominator for c in quartic))
    integers = [int(c * scale) for c in quartic]
    if not any(integers):
        return (FreeCrank(),), Fraction(0)
    modes: list[CurvedMode] = [_mode(root, drive.weight) for root in real_roots(integers)]
    if not integers[_DEGREE]:
        modes.append(_HALF_TURN)
    for mode in modes:
        if isinstance(mode, CrankMode) and mode.cos.is_rational and mode.sin.is_rational:
            _meant(drive, equation((mode.cos.p, mode.sin.p)))
    return tuple(modes), discriminant(quartic)


def discriminant(quartic: list[Fraction]) -> Fraction:
    """Of a polynomial of degree 4, or less with a root at infinity; coefficients from the constant one up.

    Examples
    --------
    >>> rows = [1, 0, -2, 0, 1], [-1, 0, 0, 0, 1], [6, 1, -4, 1, 0]
    >>> [int(discriminant([Fraction(x) for x in row])) for row in rows]
    [0, -256, 144]
    """
    e, d, c, b, a = quartic
    first = 12 * a * e - 3 * b * d + c * c
    second = 72 * a * c * e + 9 * b * c * d - 27 * (a * d * d + b * b * e) - 2 * c**3
    return (4 * first**3 - second**2) / 27


def _equation(
    mechanism: Mechanism, drive: Drive, position: Vector, rotation: Matrix
) -> Callable[[CosSin], Fraction | None]:
    """The constraint at an angle, times the square of a direction that is turned; None where that is 0."""
    part = drive.parts[0]
    constraints = {found.name: found for found in mechanism.constraints}
    is_direction = constraints[part.constraint].fields[part.field] is Role.BASE_DIRECTION
    divides = is_direction and not isinstance(constraints[part.constraint], Linear)

    def at(value: CosSin) -> Fraction | None:
        found = drive.moved(constraints, value, drive.name)[part.constraint]
        factor = Fraction(1)
        if divides:
            direction = getattr(found, part.field)
            factor = dot(direction, direction, mechanism.metric)
        return mechanism.equation_at(found, position, rotation) * factor if factor else None

    return at


def _meant(drive: Drive, value: Fraction | None) -> Fraction:
    if value is None:
        raise InputError(f"{shown(drive.name)}: a direction turned by it is 0 at an angle; give another geometry")
    return value


def _quartic(drive: Drive, at: Callable[[CosSin], Fraction | None]) -> list[Fraction]:
    """The equation in the half tangent, by Lagrange's formula."""
    w, places, values = drive.weight, [], []
    for k in range(_DEGREE + 1 + _EXTRA):
        t = Fraction((k + 1) // 2 * (-1) ** k)
        places.append(t)
        values.append(_meant(drive, at(cosine_and_sine(t, w))) * (1 + w * t * t) ** 2)
    found = [Fraction(0)] * (_DEGREE + 1)
    for t, value in zip(places[: _DEGREE + 1], values, strict=False):
        basis = [value]
        for other in places[: _DEGREE + 1]:
            if other != t:
                shifted = zip([Fraction(0), *basis], [*basis, Fraction(0)], strict=True)
                basis = [(x - other * y) / (t - other) for x, y in shifted]
        found = [x + y for x, y in zip(found, basis, strict=True)]
    for t, value in zip(places, values, strict=True):
        if sum((c * t**k for k, c in enumerate(found)), Fraction(0)) != value:
            raise InputError(
                f"{shown(drive.name)}: its equation at a pose is not of degree four in the half tangent; ask about "
                "another actuator"
            )
    return found


def _mode(root: PolynomialRoot, weight: int) -> CurvedMode:
    """Cosine and sine of a half tangent, in the field that it generates."""
    one, none, two, w = Fraction(1), Fraction(0), Fraction(2), Fraction(weight)
    cosine, sine = (quotient_at(numerator, [one, none, w], root) for numerator in ([one, none, -w], [none, two]))
    if len(root.polynomial) > 3:
        return EnclosedCrank(ValueAtRoot((none, one), root), cosine, sine)
    tangent = _surd(root)
    return CrankMode(_along(tangent, cosine), _along(tangent, sine), tangent)


def _surd(root: PolynomialRoot) -> Surd:
    if len(root.polynomial) == 2:
        return Surd(root.bounds[0])
    c, b, a = map(Fraction, root.polynomial)
    lower, upper = quadratic_roots(a, b / 2, c)
    middle = -b / (2 * a)
    return lower if (RootSum.of(root.radicals or middle) - middle).sign() < 0 else upper


def _along(tangent: Surd, value: ValueAtRoot) -> Surd:
    constant, slope = (*value.coefficients, Fraction(0), Fraction(0))[:2]
    return tangent.scaled(slope).plus(constant)

"""One pose of all bodies near a start, in a box of which Krawczyk's operator proves that it holds exactly one.

The equations are as many as the unknowns: c^2 + s^2 = 1, R^T R = 1, and those of the constraints. R^T R = 1 leaves
det R = 1 or -1, which the box decides. Nothing is said of other poses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Final

from flint import arb, arb_mat, fmpz_mpoly

from pkm_exact.balls import box_around_zero, hull
from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.links.link_equations import AXES, LinkEquations
from pkm_exact.links.link_poses import body_pose, unknowns_width
from pkm_exact.links.link_solution import KRAWCZYK, Assembly, LinkSolution, StartBox
from pkm_exact.numeric.krawczyk_operator import is_inside, krawczyk
from pkm_exact.poses.boxes import DEFAULT_WIDTH, exponent_for_width
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.stages import Progress, Stages
from pkm_exact.systems.system_sources import polynomial_system
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.algebra.system import PolynomialSystem
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.mechanism import LockedValues

GRID_BITS: Final = 16
"""The grid of a box is finer than the box is wide by so many bits."""
GUARD_BITS: Final = 64
ROOM: Final = 2
"""Boxes must be mapped into what is this many times smaller: checkers round otherwise, and need some room."""
TRIES: Final = 6
"""Boxes that are tried, each narrower by half the bits."""
_PROVED: Final = "one pose is proved, regular and alone in its box; how many others there are is not said"


class NotFoundError(PkmExactError):
    """No pose was found or proved near the start; this says nothing about the poses that there are."""


def solve_from_start(
    links: Links,
    configuration: LockedValues | None = None,
    *,
    width: Fraction = DEFAULT_WIDTH,
    progress: Progress | None = None,
) -> LinkSolution:
    """One real pose of all bodies near their starts, in a box that holds exactly one.

    Parameters
    ----------
    links : Links
        Bodies without a start are brought near first, the others held.
    configuration : LockedValues, optional
        Values of the actuators; by default those of the first configuration.
    width : Fraction
        Greatest width of the box, for each coordinate of position and rotation.
    progress : callable, optional
        Gets the name of each stage.

    Raises
    ------
    InputError
        If there are not as many equations as unknowns.
    NotFoundError
        If the search ends elsewhere, or where nothing is proved.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_links
    >>> found = solve_from_start(read_links("models/links/four-bar.toml"))
    >>> print(found)
    1 real pose near the start; not proven complete: each solution is certified, but others are not excluded
    """
    chosen = configuration or links.configuration()
    equations = LinkEquations(links, links.locked(chosen))
    system = square_system(equations)
    stages = Stages(progress)
    stages.enter("search from the start")
    point = _found(equations, system)
    stages.enter("Krawczyk's operator")
    box = _boxed(system, point, unknowns_width(width, equations.metric))
    _require_proper(equations, box)
    stages.leave()
    values = dict(zip(equations.names, box.intervals, strict=True))
    poses = tuple(body_pose(body, values, 1, box.exponent, equations.metric) for body in equations.bodies)
    return LinkSolution(links, chosen, KRAWCZYK, None, (Assembly(poses, 1),), (_PROVED,), box)


def square_system(equations: LinkEquations) -> PolynomialSystem:
    """As many equations as unknowns.

    Raises
    ------
    InputError
        If there are more or fewer.
    """
    found = [*equations.rotations(spare=False), *equations.constraint_polynomials()]
    given = [polynomial for polynomial in found if polynomial.to_dict()]
    if len(given) != len(equations.names):
        what = "hold the bodies by more constraints" if len(given) < len(equations.names) else "leave out constraints"
        raise InputError(
            f"constraints: {len(given)} equations in {len(equations.names)} unknowns, and the method krawczyk needs as "
            f"many equations as unknowns; {what}, or use the method exact"
        )
    return polynomial_system(given, equations.names)


def _found(equations: LinkEquations, system: PolynomialSystem) -> list[Fraction]:
    """A point in doubles where the equations nearly hold."""
    import numpy as np

    from pkm_exact.links.start_search import DEFAULT, FloatPolynomials, descent

    start, held = _start(equations)
    polynomials = FloatPolynomials(system)
    x = np.array(list(map(float, start)))
    free = ~np.array(held)
    if free.any() and not free.all():
        x = descent(polynomials, x, free)
    x = descent(polynomials, x, np.ones(len(x), dtype=bool))
    off = float(np.abs(polynomials.values(x)).max())
    if not off <= DEFAULT.residual:
        raise NotFoundError(
            f"no pose found: the search from the start ends where the constraints are off by {off:.1e}; give starts of "
            "bodies nearer to a pose"
        )
    return [Fraction(float(value)) for value in x]


def _start(equations: LinkEquations) -> tuple[list[Fraction], list[bool]]:
    """The unknowns at the starts of the bodies, and whether each was given."""
    zero, one = Fraction(0), Fraction(1)
    unturned = tuple(tuple(one if i == j else zero for j in AXES) for i in AXES)
    values, held = [], []
    for body, unknowns in zip(equations.links.bodies, equations.bodies, strict=True):
        position, rotation = body.start or ((zero,) * 3, unturned)
        found = [value for value, name in zip(position, unknowns.position, strict=True) if name is not None]
        if unknowns.turn is not None:
            found += [rotation[0][0], rotation[1][0] / equations.metric[0]]
        elif unknowns.rotation is not None:
            found += [value for row in rotation for value in row]
        values += found
        held += [body.start is not None] * len(found)
    return values, held


@dataclass(frozen=True, eq=False)
class PolynomialsNear:
    """A square system near an exact point (``krawczyk_operator.Equations``)."""

    system: PolynomialSystem
    point: arb_mat
    inverse: arb_mat

    is_real = True

    @staticmethod
    def at(system: PolynomialSystem, point: arb_mat) -> PolynomialsNear | None:
        """None if no matrix Y is found."""
        slopes = _jacobian(system, point)
        size = point.nrows()
        unit = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        try:
            return PolynomialsNear(system, point, slopes.solve(unit, algorithm="approx"))
        except ZeroDivisionError:
            return None

    @cached_property
    def residual(self) -> arb_mat:
        """Y F(m)."""
        values = [_value(polynomial, self.point.entries()) for polynomial in self.system.polynomials]
        return self.inverse * arb_mat(len(values), 1, values)

    def jacobian(self, box: arb_mat) -> arb_mat:
        """Y F'(m + box)."""
        return self.inverse * _jacobian(self.system, self.point + box)


def _jacobian(system: PolynomialSystem, point: arb_mat) -> arb_mat:
    size, x = point.nrows(), point.entries()
    entries = [_value(f.derivative(j), x) for f in system.polynomials for j in range(size)]
    return arb_mat(len(system.polynomials), size, entries)


def _value(polynomial: fmpz_mpoly, x: Sequence[arb]) -> arb:
    total = arb(0)
    for exponents, coefficient in polynomial.to_dict().items():
        term = arb(coefficient)
        for place, exponent in enumerate(exponents):
            for _ in range(int(exponent)):
                term *= x[place]
        total += term
    return total


def _boxed(system: PolynomialSystem, point: Sequence[Fraction], width: Fraction) -> StartBox:
    """A box of at most this width with exactly one zero."""
    bits = exponent_for_width(width)
    for _ in range(TRIES):
        with working_precision(2 * bits + 4 * GUARD_BITS):
            refined = _refined(system, point, bits)
            if refined is not None:
                exponent = bits + GRID_BITS
                centre = tuple(round(_exact(value) * (1 << exponent)) for value in refined)
                box = StartBox(exponent, centre, 1 << (GRID_BITS - 1))
                if _is_proved(system, box):
                    return box
        bits += bits // 2 + GUARD_BITS
    raise NotFoundError(
        "no box around the pose that was found is proved to hold exactly one: the mechanism may be singular there; "
        "give another start, or use the method exact"
    )


def _refined(system: PolynomialSystem, point: Sequence[Fraction], bits: int) -> list[arb] | None:
    """Newton's method from a point in doubles, to more than so many bits."""
    x = arb_mat(len(point), 1, [arb(value.numerator) / value.denominator for value in point])
    for _ in range(2 * (bits + GUARD_BITS).bit_length()):
        near = PolynomialsNear.at(system, x)
        if near is None:
            return None
        step = near.residual
        x = arb_mat(x.nrows(), 1, [value.mid() for value in (x - step).entries()])
        if all(abs(value) < arb(2) ** -(bits + GRID_BITS + GUARD_BITS) for value in step.entries()):
            return list(x.entries())
    return None


def _exact(value: arb) -> Fraction:
    exact = value.mid().fmpq()
    return Fraction(int(exact.p), int(exact.q))


def _is_proved(system: PolynomialSystem, box: StartBox) -> bool:
    unit = arb(2) ** -box.exponent
    near = PolynomialsNear.at(system, arb_mat(len(box.centre), 1, [value * unit for value in box.centre]))
    if near is None:
        return False
    radii = [box.radius * unit] * len(box.centre)
    image = krawczyk(near, box_around_zero(radii))
    return is_inside(near, image, [radius / ROOM for radius in radii])


def _require_proper(equations: LinkEquations, box: StartBox) -> None:
    """Refuse a box in which a rotation is a reflection."""
    values = dict(zip(equations.names, box.intervals, strict=True))
    for body, unknowns in zip(equations.links.bodies, equations.bodies, strict=True):
        if unknowns.rotation is not None and not _determinant(unknowns.rotation, values) > 0:
            raise NotFoundError(
                f"no pose found: the search from the start ends where {shown(body.name)} is mirrored, or the box is so "
                "wide that it may be; give starts nearer to a pose, or a smaller --width"
            )


def _determinant(names: Sequence[Sequence[str]], values: dict[str, Interval]) -> arb:
    """Its values all over the box."""
    (a, b, c), (d, e, f), (g, h, i) = ([hull(values[name].lo, values[name].hi) for name in row] for row in names)
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)

"""Inverse kinematics of actuated chains: every joint value that puts a platform joint where it is.

With P the platform joint in the fixed frame, w = A - P, and r^2 the rod's squared length, |K - P|^2 = r^2 reads

    slide    |d|^2 q^2 + 2 (d.w) q + |w|^2 - r^2 = 0
    crank    a cos + b sin = g,    a = 2 u.w,  b = 2 v.w,  g = r^2 - |w|^2 - |u|^2

so a chain has two working modes, or one (stretched: a singularity of the leg), or none (P is out of reach). The crank's
solutions are cos = (a g - b s) / m, sin = (b g + a s) / m with m = a^2 + b^2 and s = +-sqrt(m - g^2), and its half
tangent is sin / (1 + cos). References: Merlet, Parallel Robots (2006), ch. 3 (inverse kinematics, working modes).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import Chain, Crank, Slide
from pkm_exact.geometry.inverse import Matrix, Metric, dot
from pkm_exact.geometry.quartic_roots import ValueAtRoot
from pkm_exact.geometry.surds import Surd, quadratic_roots


@dataclass(frozen=True)
class SlideMode:
    """A position of a slide that reaches the platform joint."""

    position: Surd


@dataclass(frozen=True)
class CrankMode:
    """An angle of a crank that reaches the platform joint; ``half_tangent`` is None at 180 degrees."""

    cos: Surd
    sin: Surd
    half_tangent: Surd | None


@dataclass(frozen=True)
class FreeCrank:
    """Every angle of the crank reaches the platform joint, which lies on the motor's axis."""


@dataclass(frozen=True)
class EnclosedCrank:
    """An angle of a crank whose half tangent is a root of an irreducible polynomial of degree 3 or 4.

    Where that is a sum of square roots, so are all three: ``radicals`` of each.
    """

    half_tangent: ValueAtRoot
    cos: ValueAtRoot
    sin: ValueAtRoot


@dataclass(frozen=True)
class PairedMode:
    """Values of two drives that hold a leg together, by their names."""

    values: tuple[tuple[str, Mode], ...]


Mode: TypeAlias = "SlideMode | CrankMode | FreeCrank | EnclosedCrank | PairedMode"


def platform_point(joint: Vector, position: Vector, rotation: Matrix) -> Vector:
    """A platform joint in the fixed frame, C + R B.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> turn = ((zero, -one, zero), (one, zero, zero), (zero, zero, one))
    >>> [str(x) for x in platform_point((one, zero, zero), (zero, zero, Fraction(5)), turn)]
    ['0', '1', '5']
    """
    x, y, z = (
        c + sum(r * b for r, b in zip(row, joint, strict=True)) for c, row in zip(position, rotation, strict=True)
    )
    return x, y, z


def working_modes(chain: Chain, base: Vector, point: Vector, metric: Metric) -> tuple[Mode, ...]:
    """The joint values at which the chain's rod reaches ``point``, a point of the fixed frame.

    Slides in increasing position; cranks by the sign of the root, the minus sign first. An empty answer means that
    the point is out of reach of this chain.

    Examples
    --------
    >>> zero = (Fraction(0),) * 3
    >>> slide = Slide((0, 0, 1), 25)
    >>> [str(mode.position) for mode in working_modes(slide, zero, (Fraction(3), Fraction(0), Fraction(1)), (1, 1, 1))]
    ['-3', '5']
    """
    a1, a2, a3 = (a - p for a, p in zip(base, point, strict=True))
    offset = (a1, a2, a3)
    rest = dot(offset, offset, metric) - chain.rod_squared
    if isinstance(chain, Slide):
        d = chain.direction
        return tuple(map(SlideMode, quadratic_roots(dot(d, d, metric), dot(d, offset, metric), rest)))
    return _crank_modes(chain, offset, rest, metric)


def _crank_modes(chain: Crank, offset: Vector, rest: Fraction, metric: Metric) -> tuple[Mode, ...]:
    a = 2 * dot(chain.at_0, offset, metric)
    b = 2 * dot(chain.at_90, offset, metric)
    g = -rest - dot(chain.at_0, chain.at_0, metric)
    m = a * a + b * b
    if m == 0:
        return (FreeCrank(),) if g == 0 else ()
    square = m - g * g
    if square < 0:
        return ()
    root = Surd.root_of(square)
    signs = (Fraction(-1), Fraction(1)) if square else (Fraction(1),)
    modes = []
    for sign in signs:
        s = root.scaled(sign)
        cos = s.scaled(-b / m).plus(a * g / m)
        sin = s.scaled(a / m).plus(b * g / m)
        modes.append(CrankMode(cos, sin, half_tangent(cos, sin)))
    return tuple(modes)


def half_tangent(cos: Surd, sin: Surd) -> Surd | None:
    """sin / (1 + cos), for cosine and sine of one angle that share their root; None at 180 degrees."""
    n = max(cos.n, sin.n)
    p, q = 1 + cos.p, cos.q
    norm = p * p - q * q * n
    if norm == 0:
        return None
    value_p, value_q = (sin.p * p - sin.q * q * n) / norm, (sin.q * p - sin.p * q) / norm
    return Surd(value_p, value_q, n) if value_q else Surd(value_p)

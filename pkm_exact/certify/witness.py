"""Complex poses that witness a self-motion, in the form in which certificates list solutions."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import TYPE_CHECKING

from pkm_exact.geometry.rotation import quaternion_products
from pkm_exact.geometry.study import translation_coordinates

if TYPE_CHECKING:
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.self_motion import TranslationalMotion

Lists = list[list[int]]


def translation_witnesses(problem: ForwardProblem, motion: TranslationalMotion) -> dict[str, list[int] | Lists]:
    """Two opposite poses on the sphere or circle of a robot with congruent base and platform.

    They lie along the third axis, C = d + (0, 0, x) with g3 x^2 = l^2, or in the plane along the second one. The
    rotation is constant; (e, f) = p + x q, and T is an entry of f that moves.

    Returns
    -------
    dict
        Integer lists under the keys chart, separating_form, eliminant, quaternion, translation.
    """
    g = problem.metric
    products = quaternion_products(motion.rotation, Fraction(1), [Fraction(value) for value in g])
    unit = next(k for k in range(4) if products[k][k])
    e = [value / products[unit][unit] for value in products[unit]]
    fixed = [*e, *translation_coordinates([[c * x for x in e] for c in motion.offset], g)]
    along = 1 if problem.motion.is_planar else 2
    axis = [Fraction(int(k == along)) for k in range(3)]
    moved = [*[Fraction(0)] * 4, *translation_coordinates([[c * x for x in e] for c in axis], g)]
    index = next(k for k, value in enumerate(moved) if value)
    center, slope = fixed[index], moved[index]
    square = problem.distances[0].length_squared / g[along] * slope**2
    monic = [center**2 - square, -2 * center]
    numerators = [_numerator(p - q * center / slope, q / slope, monic) for p, q in zip(fixed, moved, strict=True)]
    eliminant, *rest = _in_lowest_terms([[*monic, Fraction(1)], *numerators])
    return {
        "chart": [int(k == unit) for k in range(4)],
        "separating_form": [int(k == index) for k in range(8)],
        "eliminant": eliminant,
        "quaternion": rest[:4],
        "translation": rest[4:],
    }


def _numerator(constant: Fraction, slope: Fraction, monic: Sequence[Fraction]) -> list[Fraction]:
    """(constant + slope T) h' modulo h = T^2 + b T + a, monic = (a, b); lowest degree first."""
    a, b = monic
    return [constant * b - 2 * slope * a, 2 * constant - slope * b]


def _in_lowest_terms(rows: Sequence[Sequence[Fraction]]) -> Lists:
    scale = lcm(*(value.denominator for row in rows for value in row))
    integers = [[int(value * scale) for value in row] for row in rows]
    content = gcd(*(value for row in integers for value in row))
    return [[value // content for value in row] for row in integers]

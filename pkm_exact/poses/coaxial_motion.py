"""The screwing motion of similar circles: joints on circles, base and platform similar, all legs equal.

Let the base joints lie on a circle of radius r about an axis, and the platform be similar to the base by a factor k.
With the platform on the same axis, parallel to the base, turned from the base's shape by an angle t and at a height h,
all legs have the same length:

    l^2 = h^2 + r^2 + (k r)^2 - 2 k r^2 cos(t).

For given l this is a curve of real poses iff l is greater than |r - k r|: h and t vary together. The leg Jacobian has
rank 3 there, so that no test of regular poses finds it.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Metric, dot
from pkm_exact.geometry.problem import ForwardProblem


def screws(problem: ForwardProblem) -> bool:
    """Whether the robot has this motion, decided exactly.

    Examples
    --------
    >>> from pkm_exact.constraints.distance import Distance
    >>> circle = ((5, 0), (3, 4), (-3, 4), (-5, 0), (-3, -4), (4, -3))
    >>> base = [(Fraction(x), Fraction(y), Fraction(0)) for x, y in circle]
    >>> platform = [(Fraction(x, 2), Fraction(y, 2), Fraction(1)) for x, y in circle]
    >>> robot = lambda square: ForwardProblem(tuple(Distance(*ab, Fraction(square)) for ab in zip(base, platform)))
    >>> screws(robot(7)), screws(robot(6))
    (True, False)
    """
    squares = {leg.length_squared for leg in problem.distances}
    if problem.motion.is_planar or len(squares) != 1:
        return False
    base, platform = [leg.base for leg in problem.distances], [leg.platform for leg in problem.distances]
    radius, factor = _circle(base, problem.metric), _factor(base, platform, problem.metric)
    if radius is None or factor is None:
        return False
    # l > |r - k r|, in terms of r^2 and k^2, which are rational
    rest = radius * (1 + factor) - squares.pop()
    return rest < 0 or rest * rest < 4 * factor * radius * radius


def _circle(points: Sequence[Vector], metric: Metric) -> Fraction | None:
    """The square of the radius of the circle that all points lie on, or None."""
    for first, second, third in combinations(points, 3):
        a, b = _difference(second, first), _difference(third, first)
        aa, ab, bb = dot(a, a, metric), dot(a, b, metric), dot(b, b, metric)
        area = aa * bb - ab * ab
        if area:
            # The centre is first + u a + v b, as far from first as from second and third.
            u, v = (bb * (aa - ab)) / (2 * area), (aa * (bb - ab)) / (2 * area)
            x, y, z = (p + u * s + v * t for p, s, t in zip(first, a, b, strict=True))
            spokes = [_difference(point, (x, y, z)) for point in points]
            plane = (_determinant(a, b, spoke) for spoke in spokes)
            radii = {dot(spoke, spoke, metric) for spoke in spokes}
            return radii.pop() if len(radii) == 1 and not any(plane) else None
    return None


def _factor(base: Sequence[Vector], platform: Sequence[Vector], metric: Metric) -> Fraction | None:
    """The square of the factor by which the platform is similar to the base, or None."""
    ratios = set()
    for i, j in combinations(range(len(base)), 2):
        a, b = _difference(base[i], base[j]), _difference(platform[i], platform[j])
        square, other = dot(a, a, metric), dot(b, b, metric)
        if square:
            ratios.add(other / square)
        elif other:
            return None
    return ratios.pop() if len(ratios) == 1 and all(ratios) else None


def _difference(left: Vector, right: Vector) -> Vector:
    x, y, z = (a - b for a, b in zip(left, right, strict=True))
    return x, y, z


def _determinant(a: Vector, b: Vector, c: Vector) -> Fraction:
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])

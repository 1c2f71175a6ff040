"""What the platform can do at a pose with actuators of limited speed and force: polytopes of twists and wrenches.

    {t : |q'_i| <= greatest speed},  q' = J t        twists: a box cut by the range of J
    {J^T s : lo_i <= s_i <= hi_i}                    wrenches on the environment: a zonotope

Where constraints are not actuated, twists and wrenches are those in the free components (``free_components``): a twist
has others that follow, and of wrenches that differ by what the constraints bear one is listed. Exact where the pose is
and the rows of J are rational up to square roots of numbers; else in balls, if these are narrow enough to tell which
faces there are.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product
from typing import Any

from flint import arb, arb_mat

from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.polytopes.polytope import Facet, Polytope
from pkm_exact.polytopes.signs import UndecidedError, sign
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.polytopes.zonotope import Zonotope
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.freedom import Freedom


def velocity_slabs(freedom: Freedom, speeds: Sequence[Fraction]) -> Slabs:
    """The twists that the actuators can follow, in rational coordinates where they are exact."""
    exact = freedom.free_directions
    if exact is None:
        jacobian = freedom.free_jacobian
        rows: Any = tuple(tuple(jacobian[i, j] for j in range(jacobian.ncols())) for i in range(jacobian.nrows()))
        return Slabs(rows, tuple(-ball_of(x) for x in speeds), tuple(ball_of(x) for x in speeds))
    bounds = [_short(weight.inverse() * speed) for weight, speed in zip(exact.weights, speeds, strict=True)]
    integral = tuple(tuple(map(Fraction, row)) for row in exact.rows)
    return Slabs(integral, tuple(-1 * x for x in bounds), tuple(bounds), tuple(1 / k for k in exact.squares))


def velocity_polytope(freedom: Freedom, speeds: Sequence[Fraction]) -> Polytope:
    """The same by vertices and facets."""
    with working_precision(BITS):
        return velocity_slabs(freedom, speeds).polytope()


def velocity_section(freedom: Freedom, speeds: Sequence[Fraction], kept: Sequence[int]) -> Polytope:
    """The twists whose components at other places than the kept ones are 0, by vertices and facets."""
    with working_precision(BITS):
        whole = velocity_slabs(freedom, speeds)
        rows = tuple(tuple(row[j] for j in kept) for row in whole.rows)
        squares = tuple(whole.squares[j] for j in kept) if whole.squares else ()
        return Slabs(rows, whole.low, whole.high, squares).polytope()


def wrench_zonotope(freedom: Freedom, low: Sequence[Fraction], high: Sequence[Fraction]) -> Zonotope | None:
    """The wrenches that the actuators can exert, exactly; None if they are not exact."""
    exact = freedom.free_directions
    if exact is None:
        return None
    weights = tuple(map(_short, exact.weights))
    return Zonotope(exact.rows, weights, tuple(low), tuple(high), exact.squares)


def wrench_polytope(freedom: Freedom, low: Sequence[Fraction], high: Sequence[Fraction]) -> Polytope:
    """The same by vertices and facets, exact or in balls."""
    with working_precision(BITS):
        found = wrench_zonotope(freedom, low, high)
        if found is not None:
            return found.polytope()
        jacobian = freedom.free_jacobian
        rows = [[jacobian[i, j] for j in range(jacobian.ncols())] for i in range(jacobian.nrows())]
        return _ball_zonotope(rows, low, high)


def wrench_section(
    freedom: Freedom, low: Sequence[Fraction], high: Sequence[Fraction], kept: Sequence[int]
) -> Polytope:
    """The wrenches whose components at other places than the kept ones are 0, by vertices and facets."""
    with working_precision(BITS):
        found = wrench_zonotope(freedom, low, high)
        if found is not None:
            return found.section({j: Fraction(0) for j in range(found.dimension) if j not in kept}).polytope()
        facets = wrench_polytope(freedom, low, high).facets
        pairs = list(zip(facets[::2], facets[1::2], strict=True))  # of opposite normals, as _ball_zonotope has them
        rows = tuple(tuple(up.normal[j] for j in kept) for up, _ in pairs)
        return Slabs(rows, tuple(-down.offset for _, down in pairs), tuple(up.offset for up, _ in pairs)).polytope()


def _short(value: RootSum) -> Any:
    """As a fraction if it is rational: these are faster."""
    rational = value.rational
    return value if rational is None else rational


def _ball_zonotope(rows: list[list[arb]], low: Sequence[Fraction], high: Sequence[Fraction]) -> Polytope:
    """A zonotope of balls in general position, which is proved: n - 1 generators and no more in each facet."""
    n, count = len(rows[0]), len(rows)
    vertices: dict[tuple[int, ...], tuple[arb, ...]] = {}
    planes = []
    for chosen in combinations(range(count), n - 1):
        minor = [rows[index] for index in chosen]
        normal = [
            (-1) ** j * (arb_mat([row[:j] + row[j + 1 :] for row in minor]).det() if n > 1 else arb(1))
            for j in range(n)
        ]
        products = [sum((a * b for a, b in zip(normal, row, strict=True)), arb(0)) for row in rows]
        signs = [0 if index in chosen else sign(value) for index, value in enumerate(products)]
        if any(s == 0 for index, s in enumerate(signs) if index not in chosen):
            raise UndecidedError("more wrenches than usual lie in a hyperplane, in an enclosed pose")
        planes.append((normal, products, signs, chosen))
    for _, _, signs, chosen in planes:
        for side in (1, -1):
            for ends in product((-1, 1), repeat=n - 1):
                cell = [side * s for s in signs]
                for index, end in zip(chosen, ends, strict=True):
                    cell[index] = end
                vertices.setdefault(tuple(cell), ())
    cells = sorted(vertices)
    points = []
    for ends_of in cells:
        lengths = [ball_of(high[k] if s > 0 else low[k]) for k, s in enumerate(ends_of)]
        points.append(tuple(sum((x * row[j] for x, row in zip(lengths, rows, strict=True)), arb(0)) for j in range(n)))
    facets = []
    for normal, products, signs, chosen in planes:
        for side in (1, -1):
            wanted = {index: side * s for index, s in enumerate(signs) if index not in chosen}
            on = tuple(k for k, cell in enumerate(cells) if all(cell[index] == s for index, s in wanted.items()))
            offset = sum(
                (side * products[index] * ball_of(high[index] if s > 0 else low[index]) for index, s in wanted.items()),
                arb(0),
            )
            facets.append(Facet(tuple(side * x for x in normal), offset, on))
    return Polytope(tuple(points), tuple(facets), (Fraction(1),) * n)


def ordinary_vertices(polytope: Polytope) -> list[list[Any]]:
    """The vertices in ordinary coordinates, as intervals."""
    roots = [RootSum.root(square) for square in polytope.squares]
    with working_precision(BITS):
        return [
            [interval_of(_times(value, root)) for value, root in zip(vertex, roots, strict=True)]
            for vertex in polytope.vertices
        ]


def ordinary_facets(polytope: Polytope) -> list[tuple[list[Any], Any]]:
    """Normals and offsets in ordinary coordinates, as intervals: normal.x <= offset."""
    roots = [RootSum.root(1 / square) for square in polytope.squares]
    with working_precision(BITS):
        return [
            (
                [interval_of(_times(value, root)) for value, root in zip(facet.normal, roots, strict=True)],
                interval_of(facet.offset),
            )
            for facet in polytope.facets
        ]


def _times(value: Any, root: RootSum) -> Any:
    return value * ball_of(root) if isinstance(value, arb) else root * value

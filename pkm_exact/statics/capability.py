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
from typing import Any

from flint import arb

from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.polytopes.slabs import Slabs
from pkm_exact.polytopes.zonotope import Zonotope
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.ball_zonotope import ball_zonotope, section_by_facets
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
    if freedom.forward is not None:
        found: Polytope = freedom.forward.velocity_polytope(speeds)
        return found
    with working_precision(BITS):
        return velocity_slabs(freedom, speeds).polytope()


def velocity_section(freedom: Freedom, speeds: Sequence[Fraction], kept: Sequence[int]) -> Polytope:
    """The twists whose components at other places than the kept ones are 0, by vertices and facets."""
    if freedom.forward is not None:
        found: Polytope = freedom.forward.velocity_section(speeds, kept)
        return found
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
    if freedom.forward is not None:
        section: Polytope = freedom.forward.wrench_polytope(low, high)
        return section
    with working_precision(BITS):
        found = wrench_zonotope(freedom, low, high)
        if found is not None:
            return found.polytope()
        jacobian = freedom.free_jacobian
        rows = [[jacobian[i, j] for j in range(jacobian.ncols())] for i in range(jacobian.nrows())]
        return ball_zonotope(rows, low, high)


def wrench_section(
    freedom: Freedom, low: Sequence[Fraction], high: Sequence[Fraction], kept: Sequence[int]
) -> Polytope:
    """The wrenches whose components at other places than the kept ones are 0, by vertices and facets."""
    if freedom.forward is not None:
        section: Polytope = freedom.forward.wrench_section(low, high, kept)
        return section
    with working_precision(BITS):
        found = wrench_zonotope(freedom, low, high)
        if found is not None:
            return found.section({j: Fraction(0) for j in range(found.dimension) if j not in kept}).polytope()
        return section_by_facets(wrench_polytope(freedom, low, high), kept)


def _short(value: RootSum) -> Any:
    """As a fraction if it is rational: these are faster."""
    rational = value.rational
    return value if rational is None else rational


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

"""A zonotope whose generators are enclosed, if these are in general position, which is proved."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of
from pkm_exact.polytopes.polytope import Facet, Polytope
from pkm_exact.polytopes.signs import UndecidedError, sign
from pkm_exact.polytopes.slabs import Slabs


def ball_zonotope(rows: list[list[arb]], low: Sequence[Fraction], high: Sequence[Fraction]) -> Polytope:
    """A zonotope of balls in general position, which is proved: n - 1 generators and no more in each facet."""
    n, count = len(rows[0]), len(rows)
    _require_enough(count, n)
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


def _require_enough(count: int, n: int) -> None:
    """Refuse fewer generators than dimensions: nothing else would be noticed."""
    if count < n:
        raise InputError("polytope: the generators do not span the space, so that it has no interior")


def section_by_facets(zonotope: Polytope, kept: Sequence[int]) -> Polytope:
    """The points of a zonotope whose components at other places are 0, by vertices and facets."""
    facets = zonotope.facets
    pairs = list(zip(facets[::2], facets[1::2], strict=True))  # of opposite normals, as ``ball_zonotope`` has them
    rows = tuple(tuple(up.normal[j] for j in kept) for up, _ in pairs)
    return Slabs(rows, tuple(-down.offset for _, down in pairs), tuple(up.offset for up, _ in pairs)).polytope()

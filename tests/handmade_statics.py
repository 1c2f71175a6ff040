"""Statics certificates of small machines made by hand: polytopes by looking at them, in doubles.

``polytopes`` fills in what is true of a machine with at most three freedoms, as the doubles show it, with the exact
coefficients. Nothing of the program is used.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import gcd, lcm, sqrt
from random import Random
from typing import Any

Content = dict[str, Any]
Numbers = Sequence[Any]
UNTURNED = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]


def machine(freedoms: Sequence[int], rods: Sequence[Numbers], **entries: Any) -> Content:
    """Legs to the origin that come along these vectors, without a claim."""
    legs = [{"base": [str(-Fraction(x)) for x in rod], "platform": ["0", "0", "0"]} for rod in rods]
    content: Content = {
        "format": "pkm_exact statics certificate",
        "version": 1,
        "name": "made up",
        "unit": "m",
        "metric": ["1", "1", "1"],
        "freedoms": list(freedoms),
        "position": ["0", "0", "0"],
        "rotation": UNTURNED,
        "legs": legs,
        "speeds": ["1"] * len(rods),
        "forces": [["-1", "1"]] * len(rods),
        "length": None,
        "velocity_polytope": None,
        "wrench_polytope": None,
        "ellipsoid": None,
        "indices": None,
    }
    return content | entries


def driven(content: Content, directions: Sequence[Numbers | None]) -> Content:
    """The same as version 3, with how actuators move the base joints."""
    legs = [
        leg | {"direction": None if n is None else [str(Fraction(x)) for x in n]}
        for leg, n in zip(content["legs"], directions, strict=True)
    ]
    return content | {"version": 3, "legs": legs}


def rows_of(content: Content) -> tuple[list[list[Fraction]], list[float]]:
    """The rows R_i and the lengths; of driven legs the rows as positive p_i divide them, and these."""
    g = [Fraction(x) for x in content["metric"]]
    c = [Fraction(x) for x in content["position"]]
    r = [[Fraction(x) for x in row] for row in content["rotation"]]
    rows, lengths = [], []
    for entry in content["legs"]:
        a, b = ([Fraction(x) for x in entry[key]] for key in ("base", "platform"))
        arm = [sum(x * y for x, y in zip(row, b, strict=True)) for row in r]
        d = [x + y - z for x, y, z in zip(c, arm, a, strict=True)]
        moment = [
            g[1] * g[2] * (arm[1] * d[2] - arm[2] * d[1]),
            g[2] * g[0] * (arm[2] * d[0] - arm[0] * d[2]),
            g[0] * g[1] * (arm[0] * d[1] - arm[1] * d[0]),
        ]
        whole = [*(w * x for w, x in zip(g, d, strict=True)), *moment]
        direction, side = entry.get("direction"), 1
        size = sqrt(sum(w * x * x for w, x in zip(g, d, strict=True)))
        if direction is not None:
            speed = sum((w * Fraction(n) * x for w, n, x in zip(g, direction, d, strict=True)), Fraction(0))
            side, size = (1 if speed > 0 else -1), abs(float(speed))
        rows.append([side * Fraction(whole[k]) for k in content["freedoms"]])
        lengths.append(size)
    return rows, lengths


def inverse(rows: Sequence[Sequence[Fraction]]) -> list[list[Fraction]] | None:
    """Of a small matrix, by Gauss and Jordan."""
    n = len(rows)
    left = [[*row, *(Fraction(int(i == k)) for i in range(n))] for k, row in enumerate(rows)]
    for column in range(n):
        place = next((r for r in range(column, n) if left[r][column]), None)
        if place is None:
            return None
        left[column], left[place] = left[place], left[column]
        left[column] = [x / left[column][column] for x in left[column]]
        for r in range(n):
            if r != column:
                left[r] = [x - left[r][column] * y for x, y in zip(left[r], left[column], strict=True)]
    return [row[n:] for row in left]


def velocity_polytope(content: Content) -> Content:
    """What is true: vertices where n sides meet, facets that have n vertices in general position."""
    rows, lengths = rows_of(content)
    n, count, speeds = len(rows[0]), len(rows), [Fraction(x) for x in content["speeds"]]
    found: dict[tuple[float, ...], list[list[Fraction]]] = {}
    for chosen in combinations(range(count), n):
        solved = inverse([rows[k] for k in chosen])
        for signs in product((1, -1), repeat=n) if solved else ():
            point = []
            for line in solved or ():
                coefficients = [Fraction(0)] * count
                for k, s, x in zip(chosen, signs, line, strict=True):
                    coefficients[k] = s * x * speeds[k]
                point.append(coefficients)
            place = tuple(
                round(sum(float(c) * size for c, size in zip(line, lengths, strict=True)), 9) + 0.0 for line in point
            )
            if all(room >= -1e-7 for _, room in _rooms(rows, lengths, speeds, place)):
                found.setdefault(place, point)
    facets: dict[frozenset[Any], tuple[int, int]] = {}
    for k in range(count):
        for side in (-1, 1):
            on = [p for p in found if abs(dict(_rooms(rows, lengths, speeds, p))[k, side]) < 1e-7]
            if _dimension(on) == n - 1:
                facets.setdefault(frozenset(on), (k + 1, side))
    vertices = [[[str(c) for c in line] for line in point] for point in found.values()]
    return {"facets": [list(facet) for facet in facets.values()], "vertices": vertices}


def _rooms(rows: Any, lengths: Any, speeds: Any, place: Numbers) -> Iterator[tuple[tuple[int, int], float]]:
    for k, row in enumerate(rows):
        value = sum(float(x) * y for x, y in zip(row, place, strict=True))
        for side in (-1, 1):
            yield (k, side), float(speeds[k]) * lengths[k] - side * value


def _dimension(points: Sequence[Numbers]) -> int:
    """Of the plane through points, -1 without any: at most 2 here."""
    if not points:
        return -1
    steps = [[x - y for x, y in zip(p, points[0], strict=True)] for p in points[1:]]
    if not steps:
        return 0
    return 2 if any(_cross_size(a, b) > 1e-6 for a, b in combinations(steps, 2)) else 1


def _cross_size(a: Numbers, b: Numbers) -> float:
    return max(abs(a[i] * b[j] - a[j] * b[i]) for i in range(len(a)) for j in range(len(a)))


def wrench_polytope(content: Content) -> Content:
    """What is true: normals of n - 1 rows, and the ends at which forces are in some direction."""
    rows, _ = rows_of(content)
    forces = [[Fraction(x) for x in pair] for pair in content["forces"]]
    n = len(rows[0])
    facets = {}
    for chosen in combinations(rows, n - 1):
        normal = _normal(chosen, n)
        if any(normal):
            whole = [int(x * lcm(*(y.denominator for y in normal))) for x in normal]
            for side in (1, -1):
                outer = tuple(side * x // gcd(*whole) for x in whole)
                values = [sum(x * y for x, y in zip(outer, row, strict=True)) for row in rows]
                reach = [str(max(v * low, v * high)) for v, (low, high) in zip(values, forces, strict=True)]
                facets[outer] = {"normal": [str(x) for x in outer], "offset": reach}
    random, signs = Random(1), set()
    normals = [[x / sqrt(sum(y * y for y in normal)) for x in normal] for normal in facets]
    for _ in range(1500):
        weights = [random.gauss(0, 1) for _ in normals]
        way = [sum(w * normal[k] for w, normal in zip(weights, normals, strict=True)) for k in range(n)]
        signs.add(tuple(1 if sum(float(x) * y for x, y in zip(row, way, strict=True)) > 0 else -1 for row in rows))
    return {"facets": list(facets.values()), "vertices": [list(entry) for entry in sorted(signs)]}


def _normal(rows: Sequence[Sequence[Fraction]], n: int) -> list[Fraction]:
    if n == 1:
        return [Fraction(1)]
    if n == 2:
        return [-rows[0][1], rows[0][0]]
    (a, b, c), (d, e, f) = rows
    return [b * f - c * e, c * d - a * f, a * e - b * d]


def polytopes(content: Content) -> Content:
    """The machine with both polytopes."""
    return content | {
        "velocity_polytope": velocity_polytope(content),
        "wrench_polytope": wrench_polytope(content),
    }

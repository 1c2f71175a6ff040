"""Statics certificates of boxes of poses, made by hand: what is true by definition, in doubles, with room around it.

Nothing of the program is used. Rows of forms are central differences of their values along twists, exact for
these polynomials of degree 2; the rest follows what the page of the format says, at the middle of the box.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations, product
from typing import Any

import numpy as np

Content = dict[str, Any]
UNTURNED = [[[str(int(i == j))] * 2 for j in range(3)] for i in range(3)]
NEAR, ROOM = 1e-9, 1e-4


def machine(freedoms: Sequence[int], rods: Sequence[Sequence[Any]], **entries: Any) -> Content:
    """Legs to the origin that come along these vectors, without constraints and claims."""
    content: Content = {
        "format": "pkm_exact statics certificate",
        "version": 2,
        "name": "made up",
        "unit": "m",
        "solution": None,
        "metric": ["1", "1", "1"],
        "freedoms": list(freedoms),
        "position": [["0", "0"]] * 3,
        "rotation": UNTURNED,
        "legs": [leg([-Fraction(x) for x in rod]) for rod in rods],
        "constraints": [],
        "free": list(freedoms),
        "speeds": ["1"] * len(rods),
        "forces": [["-1", "1"]] * len(rods),
        "length": None,
        "load": None,
        **dict.fromkeys(("jacobian", "expansion", "actuator_forces", "velocity_polytope", "wrench_polytope")),
        **dict.fromkeys(("ellipsoid", "indices")),
    }
    content |= entries
    if isinstance(entries.get("legs"), list):
        count = len(content["legs"])
        content |= {"speeds": ["1"] * count, "forces": [["-1", "1"]] * count} | entries
    rows, twists = rows_of(content)
    content["jacobian"] = [[around(x, NEAR) for x in row] for row in rows]
    content["expansion"] = [[around(x, NEAR) for x in row] for row in twists]
    return content


def leg(base: Sequence[Any], platform: Sequence[Any] = (0, 0, 0), direction: Sequence[Any] | None = None) -> Content:
    """As the certificate has it."""
    points = [None if p is None else [str(Fraction(x)) for x in p] for p in (base, platform, direction)]
    return dict(zip(("base", "platform", "direction"), points, strict=True))


def around(value: float, room: float) -> list[str]:
    """An interval with room on both sides, more for numbers greater than 1."""
    middle, half = Fraction(float(value)), Fraction(room) * max(1, abs(Fraction(float(value))))
    return [str(Fraction(round((middle + way * half) * 10**15), 10**15)) for way in (-1, 1)]


def number(pair: Sequence[str]) -> float:
    """The middle of an interval."""
    return float((Fraction(pair[0]) + Fraction(pair[1])) / 2)


def rows_of(content: Content) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """P and E."""
    h = np.sqrt([float(x) for x in content["metric"]])
    position = np.array([number(pair) for pair in content["position"]])
    rotation = np.array([[number(pair) for pair in row] for row in content["rotation"]])
    freedoms, free = content["freedoms"], [content["freedoms"].index(k) for k in content["free"]]
    rows = []
    for entry in content["legs"]:
        base, joint = (h * [float(Fraction(x)) for x in entry[key]] for key in ("base", "platform"))
        arm = rotation @ joint
        d = position + arm - base
        way = entry["direction"]
        rate = np.linalg.norm(d) if way is None else (h * [float(Fraction(x)) for x in way]) @ d
        rows.append(np.concatenate([d, np.cross(arm, d)])[freedoms] / rate)
    twists = np.zeros((len(freedoms), len(free)))
    twists[free] = np.eye(len(free))
    others = [k for k in range(len(freedoms)) if k not in free]
    if others:
        forms = np.array([slopes(form, h, position, rotation) for form in content["constraints"]])[:, freedoms]
        twists[others] = -np.linalg.solve(forms[:, others], forms[:, free])
    return np.array(rows) @ twists, twists


def value_of(form: Sequence[str], h: Any, position: Any, rotation: Any) -> float:
    """A form at a pose in ordinary coordinates."""
    values = np.array([float(Fraction(x)) for x in form])
    whole = [position @ position, *(rotation.T @ position) / h, *position / h, *(rotation * h / h[:, None]).ravel(), 1]
    return float(values @ whole)


def slopes(form: Sequence[str], h: Any, position: Any, rotation: Any) -> list[float]:
    """The derivative of a form along six twists."""
    found = []
    for k in range(6):
        v, w = np.eye(3)[k] if k < 3 else np.zeros(3), np.eye(3)[k - 3] if k >= 3 else np.zeros(3)
        spin = np.cross(np.eye(3), w)
        ends = [value_of(form, h, position + way * v, rotation + way * spin @ rotation) for way in (1, -1)]
        found.append((ends[0] - ends[1]) / 2)
    return found


def claims(content: Content, **gap: float) -> Content:
    """The machine with all that is true of it."""
    p, e = rows_of(content)
    q = np.array([float(Fraction(x)) for x in content["speeds"]])
    found = content | {
        "velocity_polytope": bounds_polytope(p, np.stack([-q, q], axis=1)),
        "wrench_polytope": wrench_polytope(content),
        "indices": singular_values(content, p, e),
    }
    if content["load"] is not None:
        load = -e.T @ [float(Fraction(x)) for x in content["load"]]
        forces = p @ np.linalg.solve(p.T @ p, load)
        found["actuator_forces"] = [around(x, ROOM) for x in forces]
    return found


def wrench_polytope(content: Content) -> Content:
    """That of forces alone."""
    p, _ = rows_of(content)
    return sums_polytope(p, np.array([[float(Fraction(x)) for x in pair] for pair in content["forces"]]))


def bounds_polytope(p: Any, ends: Any) -> Content:
    """That of what the rows map between ends."""
    m, f = p.shape
    vertices = []
    for chosen in map(list, combinations(range(m), f)):
        for signs in product((-1, 1), repeat=f):
            point = np.linalg.solve(p[chosen], [ends[k, int(s > 0)] for k, s in zip(chosen, signs, strict=True)])
            if all(ends[k, 0] < p[k] @ point < ends[k, 1] for k in range(m) if k not in chosen):
                sides = [[k + 1, s] for k, s in zip(chosen, signs, strict=True)]
                vertices.append({"sides": sides, "at": [around(x, ROOM) for x in point]})
    facets = sorted({tuple(side) for vertex in vertices for side in vertex["sides"]})
    volume = around(np.prod(ends[:, 1] - ends[:, 0]) / abs(np.linalg.det(p)), ROOM) if m == f else None
    return {"facets": [list(side) for side in facets], "vertices": vertices, "volume": volume}


def sums_polytope(p: Any, ends: Any) -> Content:
    """That of sums of rows times numbers between ends."""
    m, f = p.shape
    facets, cells = [], set()
    for chosen in combinations(range(m), f - 1):
        minors = [np.delete(p[list(chosen)], j, 1) for j in range(f)]
        normal = np.array([(-1) ** j * (np.linalg.det(minor) if f > 1 else 1.0) for j, minor in enumerate(minors)])
        for side in (1, -1):
            values = {k: side * normal @ p[k] for k in range(m) if k not in chosen}
            offset = sum(max(v * ends[k, 0], v * ends[k, 1]) for k, v in values.items())
            facets.append(
                {
                    "legs": [k + 1 for k in chosen],
                    "side": side,
                    "normal": [around(side * x, ROOM) for x in normal],
                    "offset": around(offset, ROOM),
                }
            )
            for picked in product((-1, 1), repeat=f - 1):
                cell = {k: 1 if v > 0 else -1 for k, v in values.items()} | dict(zip(chosen, picked, strict=True))
                cells.add(tuple(cell[k] for k in range(m)))
    choices = list(map(list, combinations(range(m), f)))
    volume = sum(abs(np.linalg.det(p[c])) * np.prod(ends[c, 1] - ends[c, 0]) for c in choices)
    return {"facets": facets, "vertices": [list(cell) for cell in sorted(cells)], "volume": around(volume, ROOM)}


def singular_values(content: Content, p: Any, e: Any) -> Content:
    """Bounds of the least and the greatest one, and of the condition."""
    length = 1.0 if content["length"] is None else float(Fraction(content["length"]))
    scale = np.array([length**2 if k >= 3 else 1.0 for k in content["freedoms"]])
    root = np.linalg.cholesky(e.T @ (scale[:, None] * e))
    values = np.linalg.svd(p @ np.linalg.inv(root).T, compute_uv=False)
    least, greatest = values[-1], values[0]
    bounds = {"sigma_min": around(least, ROOM), "sigma_max": around(greatest, ROOM)}
    return bounds | {"condition": around(greatest / least, 4 * ROOM / min(1, least))}


def ellipsoid(content: Content, weights: Sequence[Any], gap: float, shrink: float = 1e-5) -> Content:
    """That of given weights, a little smaller, and by which part a larger one might be."""
    return content | {"ellipsoid": ellipsoid_of(rows_of(content)[0], content["speeds"], weights, gap, shrink)}


def ellipsoid_of(p: Any, speeds: Sequence[Any], weights: Sequence[Any], gap: float, shrink: float = 1e-5) -> Content:
    """That of rows and greatest speeds."""
    q = np.array([float(Fraction(x)) for x in speeds])
    w = np.array([float(Fraction(x)) for x in weights])
    dual = p.shape[1] * (p.T * w / q**2) @ p
    matrix = np.linalg.inv(dual) * (1 - shrink)
    whole = [[str(Fraction(round((matrix[i, j] + matrix[j, i]) / 2 * 10**12), 10**12)) for j in range(len(matrix))]
             for i in range(len(matrix))]  # fmt: skip
    return {"weights": [str(Fraction(x)) for x in weights], "matrix": whole, "gap": str(Fraction(gap))}

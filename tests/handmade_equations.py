"""Statics certificates of machines given by equations, made by hand: what is true by definition, in doubles.

Nothing of the program is used. W and r are values and central differences of forms, P and E solve W t = r q' in the
middle of the box; the rest is that of ``handmade_boxes``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from handmade_boxes import (
    NEAR,
    ROOM,
    UNTURNED,
    Content,
    around,
    bounds_polytope,
    ellipsoid_of,
    number,
    singular_values,
    slopes,
    sums_polytope,
    value_of,
)

Sparse = Mapping[int, Any]


def form(entries: Sparse) -> list[str]:
    """17 numbers, those that are not named 0: 1 to 3 of u, 4 to 6 of C, 7 to 15 of R, 16 of 1."""
    return [str(Fraction(entries.get(k, 0))) for k in range(17)]


def equation(
    entries: Sparse, rates: Mapping[int, Sparse] | None = None, square: tuple[Any, Sparse] | None = None
) -> Content:
    """As the certificate has it; a rate that is a number is one everywhere."""
    return {
        "form": form(entries),
        "square": None if square is None else {"factor": str(Fraction(square[0])), "form": form(square[1])},
        "rates": [[k, form(rate)] for k, rate in sorted((rates or {}).items())],
    }


def machine(freedoms: Sequence[int], free: Sequence[int] | None, equations: list[Content], **entries: Any) -> Content:
    """Equations in a box, without claims but those of P and E."""
    count = len(entries["actuators"])
    content: Content = {
        "format": "pkm_exact statics certificate",
        "version": 4,
        "name": "made up",
        "unit": "m",
        "solution": None,
        "metric": ["1", "1", "1"],
        "freedoms": list(freedoms),
        "position": [["0", "0"]] * 3,
        "rotation": UNTURNED,
        "actuators": [],
        "equations": equations,
        "free": None if free is None else list(free),
        "speeds": ["1"] * count,
        "forces": [["-1", "1"]] * count,
        "length": None,
        "load": None,
        "regular": True,
        **dict.fromkeys(("jacobian", "expansion", "actuator_forces", "velocity_polytope", "wrench_polytope")),
        **dict.fromkeys(("ellipsoid", "indices")),
    }
    content |= {key: value for key, value in entries.items() if key in content}
    p, e = rows_of(content)
    content["jacobian"] = None if p is None else [[around(x, NEAR) for x in row] for row in p]
    content["expansion"] = [[around(x, NEAR) for x in row] for row in e]
    return content


def matrices(content: Content) -> tuple[Any, Any]:
    """W and r."""
    h = np.sqrt([float(x) for x in content["metric"]])
    place = (
        h,
        np.array([number(x) for x in content["position"]]),
        np.array([list(map(number, row)) for row in content["rotation"]]),
    )
    w, r = [], []
    for entry in content["equations"]:
        row = np.array(slopes(entry["form"], *place))
        if entry["square"] is not None:
            root = entry["square"]["form"]
            row = row - 2 * float(Fraction(entry["square"]["factor"])) * value_of(root, *place) * np.array(
                slopes(root, *place)
            )
        w.append(row[content["freedoms"]])
        rates = np.zeros(len(content["actuators"]))
        for k, rate in entry["rates"]:
            rates[k - 1] = np.sqrt(float(Fraction(content["actuators"][k - 1]))) * value_of(rate, *place)
        r.append(rates)
    return np.array(w), np.array(r)


def rows_of(content: Content) -> tuple[Any, Any]:
    """P, or None, and E."""
    w, r = matrices(content)
    if content["free"] is None:
        return None, np.linalg.solve(w, r)
    n, free = len(content["freedoms"]), [content["freedoms"].index(k) for k in content["free"]]
    others = [k for k in range(n) if k not in free]
    found = np.linalg.solve(np.hstack([w[:, others], -r]), -w[:, free])
    e = np.zeros((n, len(free)))
    e[free], e[others] = np.eye(len(free)), found[: len(others)]
    return found[len(others) :], e


def claims(content: Content, weights: Sequence[Any] | None = None) -> Content:
    """The machine with all that is true of it."""
    p, e = rows_of(content)
    q = np.array([float(Fraction(x)) for x in content["speeds"]])
    speeds, forces = (
        np.stack([-q, q], axis=1),
        np.array([[float(Fraction(x)) for x in pair] for pair in content["forces"]]),
    )
    if p is None:
        found = content | {
            "velocity_polytope": sums_polytope(e.T, speeds),
            "wrench_polytope": bounds_polytope(e.T, forces),
        }
    else:
        found = content | {
            "velocity_polytope": bounds_polytope(p, speeds),
            "wrench_polytope": sums_polytope(p, forces),
            "indices": singular_values(content, p, e),
        }
    if weights is not None:
        found["ellipsoid"] = ellipsoid_of(p, content["speeds"], weights, 1e-3)
    if content["load"] is not None:
        load = -e.T @ [float(Fraction(x)) for x in content["load"]]
        borne = load if p is None else p @ np.linalg.solve(p.T @ p, load)
        found["actuator_forces"] = [around(x, ROOM) for x in borne]
    return found

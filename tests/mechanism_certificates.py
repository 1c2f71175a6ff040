"""Certificates of mechanisms, version 2: one for each way to prove something, each made once in a test process."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from pathlib import Path
from typing import Any

from certificate_tools import golden
from mechanism_samples import cartesian, spherical, turning_lines
from mechanisms import F, delta, h4, mixed, point_and_spheres, pssc, three_rps, vector

from pkm_exact.certify.build import canonical_bytes, certificate, sealed
from pkm_exact.certify.certificate_entries import representation_entry, texts
from pkm_exact.completeness.slices import more_poses
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.solution import Solution

ROOT = Path(__file__).parent.parent
Content = dict[str, Any]


def machine_of(problem: ForwardProblem) -> Mechanism:
    """The mechanism with these constraints."""
    named = []
    for number, constraint in enumerate(problem.constraints, 1):
        data = {field: getattr(constraint, field) for field in constraint.fields}
        named.append(type(constraint)(**data, name=f"constraint {number}"))
    return Mechanism("mechanism", "1", "made up", tuple(named), motion=problem.motion, metric=problem.metric)


def made(problem: Callable[[], ForwardProblem], engine: Callable[[ForwardProblem], Solution] = solve) -> bytes:
    """The certificate of a mechanism."""
    machine = machine_of(problem())
    content = certificate(machine, "home", engine(machine.problem(machine.configuration())))
    assert content["version"] == 2
    return canonical_bytes(content)


def few_legs(left_out: int) -> ForwardProblem:
    """The H4 without one of its legs."""
    legs = h4().constraints
    return replace(h4(), constraints=legs[:left_out] + legs[left_out + 1 :])


def concurrent() -> ForwardProblem:
    """Four planar legs whose lines meet in a point: one pose, a double one, as their rows have rank 2."""
    legs = []
    for (x, y), factor in zip(((0, 0), (4, 0), (0, 4), (5, 3)), (2, -1, 3, -2), strict=True):
        base, platform = vector(3 + factor * (x - 3), 5 + factor * (y - 5), 0), vector(x, y, 0)
        legs.append(Distance(base, platform, F(1 - factor) ** 2 * ((x - 3) ** 2 + (y - 5) ** 2)))
    return ForwardProblem(tuple(legs), motion=PLANAR)


def wrong_leg() -> ForwardProblem:
    """The H4 with a fifth leg that is where the first one is, but has another length."""
    problem = h4()
    first = problem.constraints[0]
    assert isinstance(first, Distance)
    return replace(problem, constraints=(*problem.constraints, replace(first, length_squared=F(5291))))


def redundant() -> ForwardProblem:
    """The H4 with a fifth leg that says nothing new."""
    problem = h4()
    return replace(problem, constraints=(*problem.constraints, problem.constraints[0]))


def on_a_line() -> ForwardProblem:
    """Six legs to a platform whose joints lie on a line, at the pose C = (1, 2, 3), R = 1."""
    base = [(0, 0, 1), (5, 1, 0), (4, 7, 2), (-3, 6, 1), (-5, -2, 3), (1, -4, -2)]
    platform = [vector(Fraction(n * n, 3), n * n, 0) for n in range(6)]
    legs = []
    for a, b in zip(base, platform, strict=True):
        square = sum(((c + x - y) ** 2 for c, x, y in zip((1, 2, 3), b, a, strict=True)), F(0))
        legs.append(Distance(vector(*a), b, square))
    return ForwardProblem(tuple(legs), motion=SPATIAL)


def parallelogram() -> ForwardProblem:
    """A planar platform on three equal parallel legs."""
    corners = [vector(0, 0, 0), vector(4, 0, 0), vector(0, 4, 0)]
    return ForwardProblem(tuple(Distance(corner, corner, F(9)) for corner in corners), motion=PLANAR)


def boxed_cylinders() -> bytes:
    """The cylinders with boxes around their solutions, all of them real and, in the chart e0 = 1, f = C."""
    content = mechanism_content("cylinders")
    grid, boxes = 1 << 20, []
    for pose in content["poses"]:
        position = [round(Fraction(low) * grid) for low, _ in pose["position"]]
        boxes.append({"exponents": [20, 20], "centre": list(map(hex, (grid, 0, 0, 0, 0, *position)))})
        pose["parameter"] = None
    parts = {"krawczyk": {"chart": [1, 0, 0, 0], "real": boxes, "complex": []}, "method": "krawczyk"}
    return canonical_bytes(sealed(content | parts | {"representation": None}))


def slices() -> bytes:
    """The parallelogram again: as more poses than can be isolated, on four slices."""
    found = more_poses(parallelogram(), Policy(short_proofs=True))
    assert found is not None
    listed = [
        {"constant": str(cut.constant), "representation": representation_entry(cut.representation)}
        for cut in found.slices
    ]
    forms = [texts(form) for form in found.forms]
    motion = {"cause": "more-poses-than-bound", "real": True, "forms": forms, "slices": listed}
    return canonical_bytes(sealed(mechanism_content("parallelogram") | {"representation": None, "self_motion": motion}))


def planar_legs(name: str) -> ForwardProblem:
    """The legs of a shipped planar robot."""
    content = golden(name)
    robot, squares = content["robot"], content["configuration"]["lengths_squared"]
    joints = zip(robot["base"], robot["platform"], squares, strict=True)
    legs = [Distance(vector(*map(F, a)), vector(*map(F, b)), F(square)) for a, b, square in joints]
    g = [int(value) for value in robot["metric"]]
    return ForwardProblem(tuple(legs), (g[0], g[1], g[2]), PLANAR)


MADE: dict[str, Callable[[], bytes]] = {
    "3-RPS": partial(made, three_rps),
    "3-RPS, boxes": partial(made, three_rps, solve_krawczyk),
    "H4": partial(made, h4),
    "H4, boxes": partial(made, h4, solve_krawczyk),
    "Delta": partial(made, delta),
    "about a point": partial(made, spherical),
    "planar lines": partial(made, turning_lines),
    "planar lines, boxes": partial(made, turning_lines, solve_krawczyk),
    "six planes": partial(made, partial(mixed, 0, 6)),
    "cylinders": partial(made, cartesian),
    "cylinders, boxes": boxed_cylinders,
    "point and spheres": partial(made, point_and_spheres),
    "3-PSS+C": partial(made, partial(pssc, (F(0),) * 3)),
    "3-PSS+C, general": partial(made, partial(pssc, (F(0), F(1, 2), F(-1, 4)))),
    "redundant leg": partial(made, redundant),
    "contradictory leg": partial(made, wrong_leg),
    "more legs than freedoms, a multiple solution": partial(made, concurrent),
    "few legs, real": partial(made, partial(few_legs, 0)),
    "few legs": partial(made, partial(few_legs, 3)),
    "joints on a line": partial(made, on_a_line),
    "planar, a triple pose": partial(made, partial(planar_legs, "3-rpr-triple")),
    "planar, a double pose": partial(made, partial(planar_legs, "3-rpr-double-q")),
    "six planes of the platform": partial(made, partial(mixed, 0, 0, 6)),
    "three planes of each": partial(made, partial(mixed, 0, 3, 3)),
    "parallelogram": partial(made, parallelogram),
    "slices": slices,
}
"""By what is certified."""


@cache
def mechanism_bytes(name: str) -> bytes:
    """The certificate with this name."""
    return MADE[name]()


def mechanism_content(name: str) -> Content:
    """The same, parsed anew: it may be changed."""
    content: Content = json.loads(mechanism_bytes(name))
    return content

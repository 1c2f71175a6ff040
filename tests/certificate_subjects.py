"""Certificates of every kind, to be changed: what the solvers write, and weaker ones made of that."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, partial
from types import ModuleType
from typing import Any

import forged_ideal
import forged_platform
import forged_second_order
import pytest
from certificate_tools import boxed_certificate, golden, tolerant_certificate, without_proof
from mechanism_certificates import mechanism_content

from pkm_exact.certify.build import certificate
from pkm_exact.certify.mobility_build import mobility_certificate
from pkm_exact.engine import solve
from pkm_exact.geometry.reader import read_linkage
from pkm_exact.geometry.robot import Robot
from pkm_exact.mobility.analysis import mobility_of
from pkm_exact.policy import Policy

Content = dict[str, Any]
FIRST_VERSION = Policy(short_proofs=False)
"""For certificates of version 1, whatever shorter proofs there are."""


def _open(name: str, tolerance: str) -> Content:
    content = tolerant_certificate(name, tolerance)
    assert content["unproved"]
    assert not content["complete"]
    return content


def _unproved(name: str) -> Content:
    """With multiple solutions, and without the elimination that counts them."""
    content = without_proof(golden(name))
    return {**content, "poses": [{**pose, "multiplicity": None} for pose in content["poses"]]}


def _nothing() -> Content:
    none: Content = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses", "box_exponent"), 0)
    none |= {"representation": None, "elimination": None, "poses": [], "completeness_route": None}
    return {**golden("3-rpr-triple"), **none, "claim": "not-proven-complete"}


def _mobility(name: str) -> Content:
    return mobility_certificate(mobility_of(read_linkage(f"models/chains/{name}.toml")))


def _rigid(made: ModuleType) -> Content:
    content, entry = made.TRUE["five hinges in the third order"]
    found: Content = made.second(content, entry)
    return found


def _nothing_finite() -> Content:
    return {**_mobility("seven-link-oblique"), "version": 1, "finite": None}


CIRCLE = tuple(
    (Fraction(x, r), Fraction(y, r), Fraction(0))
    for x, y, r in ((3, 4, 5), (5, 0, 5), (-3, 4, 5), (-5, 0, 5), (5, -12, 13), (-4, -3, 5))
)


def _made_up(kind: str, base: Any, platform: Any, squares: Any, metric: Any = (1, 1, 1)) -> Content:
    robot = Robot("made up", kind, "m", "made up", tuple(base), tuple(platform), metric)
    return certificate(robot, None, solve(robot.problem(squares), policy=FIRST_VERSION))


def _congruent() -> Content:
    return _made_up("6-UPS", CIRCLE, [(-x, -y, z) for x, y, z in CIRCLE], [Fraction(5)] * 6, (1, 3, 1))


def _similar() -> Content:
    """At C = (0, 0, 2) and R by the angle with cosine 4/5 about the third axis."""
    squares = [
        (Fraction(2, 5) * x - Fraction(3, 10) * y - x) ** 2 + (Fraction(3, 10) * x + Fraction(2, 5) * y - y) ** 2 + 4
        for x, y, _ in CIRCLE
    ]
    return _made_up("6-UPS", CIRCLE, [(x / 2, y / 2, z) for x, y, z in CIRCLE], squares)


def _parallelogram() -> Content:
    """It turns on a circle; two more poses turn the platform over."""
    corners = tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, 0), (0, 4)))
    content = _made_up("3-RPR", corners, corners, (9, 9, 9))
    assert content["krawczyk"] is not None
    return content


def _held(step: int, wrong: int) -> Content:
    """A platform with joints on a line, by ``step``, at C = (1, 2, 3), R = 1; the square of leg 1 is so much wrong."""
    base = [(Fraction(x), Fraction(y), Fraction(z)) for x, y, z in ((0, 0, 1), (5, 1, 0), (4, 7, 2), (-3, 6, 1))]
    base += [(Fraction(-5), Fraction(-2), Fraction(3)), (Fraction(1), Fraction(-4), Fraction(-2))]
    platform = [(Fraction(step * n * n, 3), Fraction(step * n * n), Fraction(0)) for n in range(6)]
    squares = [
        sum(((c + x - y) ** 2 for c, x, y in zip((1, 2, 3), b, a, strict=True)), Fraction(0))
        for a, b in zip(base, platform, strict=True)
    ]
    return _made_up("6-UPS", base, platform, [squares[0] + wrong, *squares[1:]])


MECHANISMS = {
    "spatial-2": {"3-RPS": 0, "3-RPS, boxes": 0, "six planes": 10, "point and spheres": 10},
    "spatial-2-infinity": {"3-PSS+C, general": 6},
    "spatial-2-elimination": {"3-PSS+C": 6},
    "kept-2": {
        "H4": 10,
        "H4, boxes": 2,
        "Delta": 10,
        "about a point": 10,
        "planar lines": 10,
        "planar lines, boxes": 10,
        "cylinders": 6,
        "cylinders, boxes": 2,
        "redundant leg": 10,
        "more legs than freedoms, a multiple solution": 10,
    },
    "inconsistent-2": {"contradictory leg": 10},
    "moving-2": {"few legs, real": 10, "few legs": 10, "joints on a line": 10, "parallelogram": 6},
    "moving-2-slices": {"slices": 6},
}
"""Certificates of version 2, by kind, and how many changes a quick run makes: spatial motions, others, .."""


@dataclass(frozen=True)
class Subject:
    """A certificate to be changed, how often in a quick run, and in a complete one: every change if None."""

    make: Callable[[], Content]
    quick: int = 30
    complete: int | None = None


SUBJECTS = {
    "general 6-6, representation": Subject(partial(golden, "mourrain-l"), complete=1500),
    "general 6-6, boxes": Subject(partial(boxed_certificate, "mourrain-l"), 0, 200),
    "general 6-6 of Rolland, representation": Subject(partial(golden, "rolland-6-6"), 0, 60),
    "general 6-6 of Rolland, boxes": Subject(partial(boxed_certificate, "rolland-6-6"), 0, 60),
    "special robot, exact elimination": Subject(partial(golden, "similar-planar-s"), complete=1500),
    "special robot, 28 solutions": Subject(partial(golden, "ssm-exact"), 0, 200),
    "Gram metric, exact elimination": Subject(partial(golden, "robocrane-r"), 4, 200),
    "chain 6-RUS, representation": Subject(partial(golden, "hexa"), 0, 100),
    "chain 6-RUS in a Gram metric, boxes": Subject(partial(boxed_certificate, "hexa"), 0, 100),
    "planar, representation": Subject(partial(golden, "3-rrr"), complete=1500),
    "planar, multiple solutions": Subject(partial(golden, "3-rpr-triple")),
    "planar, boxes": Subject(partial(boxed_certificate, "3-rpr-merlet-p")),
    "tolerance, planar, complete": Subject(partial(tolerant_certificate, "3-rpr-merlet-p", "1/100000")),
    "tolerance-open, planar": Subject(partial(_open, "3-rrr", "1/75"), complete=1500),
    "tolerance, spatial, complete": Subject(partial(tolerant_certificate, "mourrain-l", "1/1000000000000"), 4, 200),
    "tolerance, Rolland, complete": Subject(partial(tolerant_certificate, "rolland-6-6", "1/1000000000000000"), 0, 60),
    "moving, congruent hexagons": Subject(_congruent),
    "moving, dependent legs": Subject(_similar),
    "moving, joints in a point": Subject(partial(_held, 0, 0)),
    "moving, joints on a line": Subject(partial(_held, 1, 0)),
    "moving beside isolated poses": Subject(_parallelogram),
    "inconsistent, joints in a point": Subject(partial(_held, 0, 1)),
    "inconsistent, joints on a line": Subject(partial(_held, 1, 1), 0, 60),
    "mobility, Sarrus": Subject(partial(_mobility, "sarrus"), 29, complete=2000),
    "mobility, seven-link": Subject(partial(_mobility, "seven-link"), 20, complete=2000),
    "mobility, planar loops": Subject(partial(_mobility, "peaucellier"), 0, complete=2000),
    "mobility, nothing finite": Subject(_nothing_finite, 0, complete=1000),
    "platform, five legs": Subject(lambda: forged_platform.FIVE, 15, complete=1500),
    "platform, six legs": Subject(lambda: forged_platform.SIX_POSED, 0, complete=1000),
    "platform, equal legs": Subject(lambda: forged_platform.SAME_POSED, 15, complete=1000),
    "mobility-2, Bennett": Subject(partial(_mobility, "bennett"), 15, complete=1000),
    "mobility-2, rigid in the third order": Subject(lambda: _rigid(forged_second_order), 15, complete=1000),
    "mobility-2, seven-link": Subject(partial(_mobility, "seven-link-oblique"), 20, complete=2000),
    "mobility-3, Bricard": Subject(partial(_mobility, "bricard"), 15, complete=1500),
    "mobility-3, five hinges": Subject(lambda: forged_ideal.ROWS["ideal: five hinges"][0], 15, complete=1000),
    "unproved multiplicities": Subject(partial(_unproved, "3-rpr-triple")),
    "not proven complete": Subject(lambda: without_proof(golden("similar-planar-s")), complete=1500),
    "nothing known": Subject(_nothing),
    **{
        f"{sort}, {name}": Subject(partial(mechanism_content, name), quick, 100 if "boxes" in name else 400)
        for sort, names in MECHANISMS.items()
        for name, quick in names.items()
    },
}
"""Certificates of every kind, by name; the first word of the name is the kind that ``FREE`` speaks of."""

EACH = [pytest.param(name, marks=() if entry.quick else pytest.mark.slow) for name, entry in SUBJECTS.items()]
"""The names as parameters of a test; the larger certificates are for the slow tests."""
OF_POSES = [entry for entry in EACH if not str(entry.values[0]).startswith(("mobility", "platform"))]
"""Those that are about poses, of which there are pictures and pages."""


@cache
def subject(name: str) -> Content:
    """The certificate with this name."""
    return SUBJECTS[name].make()

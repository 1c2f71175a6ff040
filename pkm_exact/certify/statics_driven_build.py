"""Certificates of what legs that slides and cranks drive can do at an exact pose: version 3 of statics.

The format is described in ``docs/certificates-statics.md``; its schema is ``statics-certificate-3.schema.json`` in this
folder. Unlike a box, an exact pose tells faces apart that meet where usually fewer do.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.build import sealed
from pkm_exact.certify.statics_box_machine import MOST_LEGS, BoxedLeg, boxed_leg
from pkm_exact.certify.statics_build import Driven, exact_content
from pkm_exact.errors import InputError
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.measures import Measures

FORMAT: Final = "pkm_exact statics certificate"
VERSION: Final = 3


def driven_legs(at: AtPose) -> list[BoxedLeg] | None:
    """The legs of a machine at an exact pose, if it has nothing else and all is rational; else None."""
    if not at.is_exact or at.held.structural or not 1 <= len(at.held.actuators) <= MOST_LEGS:
        return None
    try:
        return [boxed_leg(at, k) for k in range(len(at.held.actuators))]
    except InputError:
        return None


def statics_driven_certificate(measures: Measures) -> dict[str, Any]:
    """The certificate of polytopes, ellipsoid and singular values, as far as limits are known.

    Raises
    ------
    InputError
        If the pose is not exact, or the machine has anything but legs with rational joints.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/dual-v.toml")
    >>> at = robot.at({"position": [0, 0], "half_tangent": 0}, modes="+-+-")
    >>> content = statics_driven_certificate(at.measures(speeds=1, forces=1))
    >>> len(content["velocity_polytope"]["vertices"]), len(content["velocity_polytope"]["facets"])
    (6, 8)
    """
    at: AtPose = measures.freedom.at  # type: ignore[assignment]
    legs = driven_legs(at)
    if legs is None:
        raise InputError("certificate: is for exact poses of machines of legs alone, 12 at most, with rational joints")
    rows, squares = [], []
    for leg in legs:
        row, divisor = _row(at, leg)
        rows.append(row)
        squares.append(divisor)
    entries = [
        {
            "base": list(map(str, leg.base)),
            "platform": list(map(str, leg.platform)),
            "direction": None if leg.direction is None else list(map(str, leg.direction)),
        }
        for leg in legs
    ]
    return sealed(exact_content(VERSION, measures, entries, Driven(rows, squares)))


def _row(at: AtPose, leg: BoxedLeg) -> tuple[list[Fraction], Fraction]:
    """R_i times the sign of p_i, and p_i^2; of a leg whose length is actuated R_i and l_i^2."""
    g = at.metric
    arm = [sum((Fraction(r) * b for r, b in zip(line, leg.platform, strict=True)), Fraction(0)) for line in at.rotation]
    d = [Fraction(c) + x - a for c, x, a in zip(at.position, arm, leg.base, strict=True)]
    row = [
        *(w * x for w, x in zip(g, d, strict=True)),
        *(g[j] * g[k] * (arm[j] * d[k] - arm[k] * d[j]) for j, k in ((1, 2), (2, 0), (0, 1))),
    ]
    kept = [Fraction(row[place]) for place in at.motion.twist]
    if leg.direction is None:
        return kept, sum((w * x * x for w, x in zip(g, d, strict=True)), Fraction(0))
    speed = sum((w * n * x for w, n, x in zip(g, leg.direction, d, strict=True)), Fraction(0))
    return [-x for x in kept] if speed < 0 else kept, speed * speed

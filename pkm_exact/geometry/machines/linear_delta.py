"""Deltas with linear motors: three slides, three parallelograms, a platform that only moves.

Carriage i stands at r_A e_i + q (h e_i + v e_z); a rod of length L leads from it to P + r_B e_i. With (h, v) = (0, 1)
the slides are vertical (linear Delta), with (1, 0) they form a star in the base (Triglide). Reference: Schoettler,
Raatz and Hesselbach in Parallel Manipulators: Towards New Applications (2008), ch. 11.
"""

from __future__ import annotations

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, rods, vector
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import METRIC, RADIAL, UP, along
from pkm_exact.motions.motion_groups import TRANSLATION


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - that of the triangle
    """Three rods whose lower ends stand on carriages."""
    outwards, upwards, _ = given["direction"]
    constraints, drives = [], []
    for number, (radial, square) in enumerate(zip(RADIAL, given["rod"], strict=True), 1):
        foot, joint = along((given["base_radius"], radial)), along((given["platform_radius"], radial))
        constraints.append(Distance(foot, joint, square, f"rod {number}"))
        line = Part(f"rod {number}", "base", (along((outwards, radial), (upwards, UP)),))
        drives.append(Drive(f"slide {number}", (line,)))
    return Assembly(tuple(constraints), (Group(Joint.SLIDE, tuple(x.name for x in drives)),), tuple(drives))


def _kind(name: str, description: str, radius: str, direction: tuple[int, int], home: str) -> MachineKind:
    return MachineKind(
        name,
        description,
        TRANSLATION,
        (
            length("base_radius", "from the centre to the slides' zeros", radius, may_be_zero=True),
            length("platform_radius", "from the platform's centre to its joints", "40", may_be_zero=True),
            rods(3, "250"),
            vector(
                "direction",
                "of a slide: outwards and upwards, per unit of its position",
                str(list(direction)),
                2,
                direction,
            ),
        ),
        assemble,
        {"slides": home},
        metric=METRIC,
    )


LINEAR_DELTA = _kind(
    "linear-delta", "translations: three vertical slides, three parallelograms", "150", (0, 1), "[300, 310, 280]"
)
TRIGLIDE = _kind(
    "triglide", "translations: three slides in a star, three parallelograms", "0", (1, 0), "[200, 210, 190]"
)

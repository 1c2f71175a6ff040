"""The Delta with rotary motors (Clavel): three cranks, three parallelograms, a platform that only moves.

With e_i the radial direction of arm i and P the platform's centre, the parallelogram keeps the platform from turning
and is one rod of length L1 from the knee (r_A + L2 cos) e_i - L2 sin e_z to P + r_B e_i. Two poses, mirrored in the
plane of the knees; arms turn downwards. Reference: Laribi, Romdhane and Zeghloul, "Advanced synthesis of the DELTA
parallel robot for a specified workspace", in Parallel Manipulators: Towards New Applications (2008), ch. 10, with the
signs of its (7).
"""

from __future__ import annotations

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, rods
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import METRIC, RADIAL, UP, along
from pkm_exact.motions.motion_groups import TRANSLATION


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - that of the triangle
    """Three rods whose lower ends stand on cranks."""
    arm = given["arm"]
    constraints, drives = [], []
    for number, (radial, square) in enumerate(zip(RADIAL, given["rod"], strict=True), 1):
        foot, joint = along((given["base_radius"], radial)), along((given["platform_radius"], radial))
        constraints.append(Distance(foot, joint, square, f"rod {number}"))
        circle = Part(f"rod {number}", "base", (along((arm, radial)), along((-arm, UP))))
        drives.append(Drive(f"arm {number}", (circle,), weight=1))
    return Assembly(tuple(constraints), (Group(Joint.CRANK, tuple(x.name for x in drives)),), tuple(drives))


DELTA = MachineKind(
    "delta",
    "translations: three cranks, three parallelograms",
    TRANSLATION,
    (
        length("base_radius", "from the base's centre to the motors' axes", "1.74"),
        length("platform_radius", "from the platform's centre to its joints", "0", may_be_zero=True),
        length("arm", "length of the cranks", "1.73"),
        rods(3, "2.66"),
    ),
    assemble,
    {"half_tangents": '["3/4", "1/2", "2/3"]'},
    metric=METRIC,
)

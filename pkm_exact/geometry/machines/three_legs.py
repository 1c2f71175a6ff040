"""Three legs on hinges: 3-RPS, and 3-PRS with its errors. Each leg stays in a plane; its upper end is a ball joint.

The hinge of leg i keeps it in the plane through the axis of the base in the direction e_i: for a platform joint B_i,
t_i.(C + R B_i - A_i) = 0 with t_i tangential. Lengths are actuated (3-RPS), or the feet stand on slides (3-PRS). Errors
of the hinges' axes are added to t_i, errors of their places to A_i. Sixteen complex poses in general, with errors or
without. Reference: Tang and Huang in Parallel Manipulators: Towards New Applications (2008), ch. 15, (46) to (50).
"""

from __future__ import annotations

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric, dot
from pkm_exact.geometry.machines.dimension_readers import length, rods, vector, vectors
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import METRIC, RADIAL, TANGENTIAL, UP, along
from pkm_exact.motions.motion_groups import SPATIAL


def three_rps(given: Dimensions, metric: Metric) -> Assembly:
    """Three legs of actuated length, each in a plane."""
    constraints: list[Constraint] = []
    for number, (radial, normal) in enumerate(zip(RADIAL, TANGENTIAL, strict=True), 1):
        foot, joint = along((given["base_radius"], radial)), along((given["platform_radius"], radial))
        constraints.append(Distance(foot, joint, given["platform_radius"], f"leg {number}"))
        constraints.append(InPlane(normal, dot(normal, foot, metric), joint, f"hinge {number}"))
    return Assembly(tuple(constraints), (Group(Joint.LENGTH, ("leg 1", "leg 2", "leg 3")),))


def three_prs(given: Dimensions, metric: Metric) -> Assembly:
    """Three rods on carriages, each in a plane; hinges and their places may have errors."""
    outwards, upwards, _ = given["direction"]
    constraints: list[Constraint] = []
    drives = []
    for k, (radial, tangent) in enumerate(zip(RADIAL, TANGENTIAL, strict=True)):
        foot = along((given["base_radius"], radial), (1, given["joint_errors"][k]))
        joint, normal = along((given["platform_radius"], radial)), along((1, tangent), (1, given["axis_errors"][k]))
        rod, hinge = f"rod {k + 1}", f"hinge {k + 1}"
        constraints.append(Distance(foot, joint, given["rod"][k], rod))
        constraints.append(InPlane(normal, dot(normal, foot, metric), joint, hinge))
        step = along((outwards, radial), (upwards, UP))
        shift = dot(normal, step, metric)
        hinges = (Part(hinge, "offset", (shift,)),) if shift else ()
        drives.append(Drive(f"slide {k + 1}", (Part(rod, "base", (step,)), *hinges)))
    return Assembly(tuple(constraints), (Group(Joint.SLIDE, tuple(x.name for x in drives)),), tuple(drives))


_RADII = (
    length("base_radius", "from the base's centre to the hinges", '"6/5"'),
    length("platform_radius", "from the platform's centre to its joints", '"7/10"'),
)
THREE_RPS = MachineKind(
    "3-RPS",
    "three legs of actuated length on hinges",
    SPATIAL,
    _RADII,
    three_rps,
    {"lengths": '["13/10", "3/2", "7/5"]'},
    metric=METRIC,
)
THREE_PRS = MachineKind(
    "3-PRS",
    "three rods on slides and hinges",
    SPATIAL,
    (
        *_RADII,
        rods(3, "1"),
        vector("direction", "of a slide: outwards and upwards, per unit of its position", "[0, 1]", 2, (0, 1)),
        vectors(
            "axis_errors",
            "added to the hinges' directions, which are tangential and of length sqrt(3)",
            "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]",
            3,
            optional=True,
        ),
        vectors(
            "joint_errors", "added to the places of the hinges", "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]", 3, optional=True
        ),
    ),
    three_prs,
    {"slides": '["1/10", "1/5", 0]'},
    metric=METRIC,
)

"""Machines whose platform a central joint guides: 3-PSS+C, 2-UPS+U.

3-PSS+C (reflector support): rods of length l on vertical slides at R, ball joints of the platform at r, at -60, 60
and 180 degrees; a passive leg keeps the platform's centre on the vertical axis and the platform from turning about
it. Reference: Tang and Huang in Parallel Manipulators: Towards New Applications (2008), ch. 15, (7) with A13 and A21
corrected.

2-UPS+U (joint of the mobile robot JL-I): the centre is held by a universal joint, R = Ry Rx; struts lead from (K,
-+K, 0) to (K, -+K, L). The source prints T = Ry Rx Rz with the lower anchors turned by Rz, as if the joint did not
turn with them: both models are here, the second with the turn as a third actuator. Reference: Wang et al., ibid., ch.
16, (5) to (12).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, rods, word
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import METRIC, ORIGIN, RADIAL, UP, along
from pkm_exact.motions.motion_groups import SPATIAL

_ZERO: Final = Fraction(0)
_ONE: Final = Fraction(1)
_X: Final[Vector] = (_ONE, _ZERO, _ZERO)
_Y: Final[Vector] = (_ZERO, _ONE, _ZERO)


def _pss_c(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - that of the triangle
    constraints: list[Constraint] = [
        InPlane(_X, _ZERO, ORIGIN, "axis x"),
        InPlane(_Y, _ZERO, ORIGIN, "axis y"),
        Angle(_Y, _X, _ZERO, "universal joint"),
    ]
    drives = []
    for k, radial in enumerate((RADIAL[1], RADIAL[2], RADIAL[0]), 1):
        foot, joint = along((-given["base_radius"], radial)), along((-given["platform_radius"], radial))
        constraints.append(Distance(foot, joint, given["rod"][k - 1], f"rod {k}"))
        drives.append(Drive(f"slide {k}", (Part(f"rod {k}", "base", (UP,)),)))
    return Assembly(tuple(constraints), (Group(Joint.SLIDE, tuple(x.name for x in drives)),), tuple(drives))


def _ups_u(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - no turns in the plane
    k, height = given["half_width"], given["height"]
    constraints: tuple[Constraint, ...] = (
        AtPoint(ORIGIN, ORIGIN, "centre"),
        Angle(_Y, _X, _ZERO, "universal joint"),
        Distance((k, -k, _ZERO), (k, -k, height), _ONE, "leg 1"),
        Distance((k, k, _ZERO), (k, k, height), _ONE, "leg 2"),
    )
    lengths = Group(Joint.LENGTH, ("leg 1", "leg 2"))
    if given["mounted"] == "plate":
        return Assembly(constraints, (lengths,))
    # Rz A = c A + s (-y, x); the axis that the universal joint keeps level is R Rz^-1 e_x.
    held = tuple(Distance(ORIGIN, leg.platform, _ONE, leg.name) for leg in constraints[2:] if isinstance(leg, Distance))
    joint = Angle(_Y, ORIGIN, _ZERO, "universal joint")
    turn = Drive(
        "turn",
        (
            Part("universal joint", "platform", (_X, (_ZERO, -_ONE, _ZERO))),
            Part("leg 1", "base", ((k, -k, _ZERO), (k, k, _ZERO))),
            Part("leg 2", "base", ((k, k, _ZERO), (-k, k, _ZERO))),
        ),
        weight=1,
    )
    groups = lengths, Group(Joint.CRANK, ("turn",))
    return Assembly((constraints[0], joint, *held), groups, (turn,))


THREE_PSS_C: Final = MachineKind(
    "3-PSS+C",
    "three rods on vertical slides, the centre kept on an axis",
    SPATIAL,
    (
        length("base_radius", "from the axis to the slides", "7"),
        length("platform_radius", "from the platform's centre to its joints", "7"),
        rods(3, "3.5"),
    ),
    _pss_c,
    {"slides": '[0, "1/2", "-1/4"]'},
    metric=METRIC,
)
TWO_UPS_U: Final = MachineKind(
    "2-UPS+U",
    "turns about two axes: two legs and a universal joint",
    SPATIAL,
    (
        length("half_width", "K: the struts are at (K, -+K)", "1"),
        length("height", "L: of the upper anchors over the joint", "4"),
        word(
            "mounted",
            "plate: the universal joint turns with the plate; base: it does not (the printed model)",
            ("plate", "base"),
        ),
    ),
    _ups_u,
    {"lengths": '["17/4", "15/4"]'},
    ((0, 0, 0), (1, 0, 0, 0)),
)

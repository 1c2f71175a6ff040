"""The reconfigurable robot with other fixed legs than P-FUS: R-TUS, UP-VS, CP-VS and R-TCS, 3 to 6 freedoms.

Fixed legs stand at 0, 120 and 240 degrees; in the mode of m freedoms 6 - m of them have a locked hinge that keeps their
platform joint in the vertical plane through the axis, and m - 3 cranks with rods are attached between them, as in
``reconfigurable``. With d from the leg's base joint to its platform joint, and r outwards, z up:

    R-TUS    a crank in the vertical plane and a rod                  |d - l1 u| = l2,  u = r cos + z sin
    UP-VS    an actuated length                                       |d| = s
    CP-VS    a strut of actuated length, upright on a collar that slides along the guide u = z - r and turns about it:
             s = |d x u| / |u|; with a locked hinge (r + z).d = 2 q,  q = s / sqrt(2)
    R-TCS    a rod of length l2, upright on a collar on a crank along u:
             |d x u| = l2; with a locked hinge (z cos - r sin).d = l2

The angle between strut and guide of CP-VS is not printed; it is 90 degrees here, as it is in R-TCS. Reference:
Finistauri, Xi and Petz in Parallel Manipulators: Towards New Applications (2008), ch. 18, table 8.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Final

from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, word
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimension, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.reconfigurable import detachable
from pkm_exact.geometry.machines.triangle import METRIC, ORIGIN, RADIAL, TANGENTIAL, UP, along
from pkm_exact.motions.motion_groups import SPATIAL

_ZERO: Final = Fraction(0)
_ONE: Final = Fraction(1)
_MODE: Final = "of the mode: as many legs as that are attached"
_DETACHED: Final = '"4/7"', '"5/8"', '"5/9"'
"""Half tangents of the detachable cranks of examples."""


def _homes(fixed: Callable[[int], dict[str, tuple[str, ...]]]) -> dict[tuple[str, str], dict[str, str]]:
    """Examples with more freedoms: the values of the fixed legs, then those of detachable cranks."""
    found = {}
    for free in (1, 2, 3):
        values = fixed(free)
        values["half_tangents"] = (*values.get("half_tangents", ()), *_DETACHED[:free])
        found["freedoms", str(3 + free)] = {key: f"[{', '.join(row)}]" for key, row in values.items() if row}
    return found


class _Legs:
    """What the fixed legs are made of, while they are assembled."""

    def __init__(self, given: Dimensions) -> None:
        self.given = given
        self.constraints: list[Constraint] = []
        self.drives: list[Drive] = []
        self.names: dict[Joint, list[str]] = {}
        self.feet: list[tuple[str, Vector]] = []

    def joints(self, radial: Vector) -> tuple[Vector, Vector]:
        """Base joint and platform joint of a leg."""
        return along((self.given["base_radius"], radial)), along((self.given["platform_radius"], radial))

    def driven(self, joint: Joint, drive: Drive) -> None:
        """Add a drive."""
        self.drives.append(drive)
        self.named(joint, drive.name)

    def named(self, joint: Joint, name: str) -> None:
        """Add the name of an actuator."""
        self.names.setdefault(joint, []).append(name)


def _crank_and_rod(legs: _Legs, k: int, radial: Vector, *, locked: bool) -> None:  # noqa: ARG001 - both alike
    base, joint = legs.joints(radial)
    arm = legs.given["crank"]
    legs.constraints.append(Distance(base, joint, legs.given["rod"] ** 2, f"rod {k}"))
    circle = along((arm, radial)), along((arm, UP))
    legs.driven(Joint.CRANK, Drive(f"crank {k}", (Part(f"rod {k}", "base", circle),), weight=1))


def _strut(legs: _Legs, k: int, radial: Vector, *, locked: bool) -> None:  # noqa: ARG001 - both alike
    base, joint = legs.joints(radial)
    legs.constraints.append(Distance(base, joint, _ONE, f"leg {k}"))
    legs.named(Joint.LENGTH, f"leg {k}")


def _strut_on_guide(legs: _Legs, k: int, radial: Vector, *, locked: bool) -> None:
    base, joint = legs.joints(radial)
    if locked:
        offset = legs.given["base_radius"]
        legs.feet.append((f"strut {k}", base))
        legs.constraints.append(InPlane(along((1, radial), (1, UP)), offset, joint, f"strut {k}"))
        part = Part(f"strut {k}", "offset", (Fraction(2),))
        legs.driven(Joint.SLIDE, Drive(f"slide {k}", (part,)))
    else:
        legs.constraints.append(AxisDistance(base, along((-1, radial), (1, UP)), joint, _ONE, f"strut {k}"))
        legs.named(Joint.LENGTH, f"strut {k}")


def _rod_on_crank(legs: _Legs, k: int, radial: Vector, *, locked: bool) -> None:
    base, joint = legs.joints(radial)
    rod = legs.given["rod"]
    if locked:
        legs.feet.append((f"rod {k}", base))
        legs.constraints.append(InPlane(ORIGIN, rod, joint, f"rod {k}"))
        normal = Part(f"rod {k}", "normal", (UP, along((-1, radial))))
        parts: tuple[Part, ...] = normal, Part(f"rod {k}", "offset", (_ZERO, -legs.given["base_radius"]))
    else:
        legs.constraints.append(AxisDistance(base, ORIGIN, joint, rod * rod, f"rod {k}"))
        parts = (Part(f"rod {k}", "direction", (radial, UP)),)
    legs.driven(Joint.CRANK, Drive(f"crank {k}", parts, weight=1))


def _assembled(leg: Callable[..., None]) -> Callable[[Dimensions, Metric], Assembly]:
    """The recipe of a robot with three fixed legs of a sort."""

    def build(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - that of the triangle
        legs = _Legs(given)
        for k, (radial, normal) in enumerate(zip(RADIAL, TANGENTIAL, strict=True), 1):
            locked = k <= 6 - int(given["freedoms"])
            leg(legs, k, radial, locked=locked)
            if locked:
                _, joint = legs.joints(radial)
                legs.constraints.append(InPlane(normal, _ZERO, joint, f"hinge {k}"))
        rods, cranks = detachable(given)
        for crank in cranks:
            legs.driven(Joint.CRANK, crank)
        groups = tuple(Group(joint, tuple(names)) for joint, names in legs.names.items())
        return Assembly((*legs.constraints, *rods), groups, tuple(legs.drives), feet=tuple(legs.feet))

    return build


def _dimensions(*own: Dimension, detached: str = "150") -> tuple[Dimension, ...]:
    return (
        length("base_radius", "of the base's joints", "100"),
        length("platform_radius", "of the platform's joints", "50"),
        *own,
        length("arm", "length of the detachable cranks", detached),
        length("link", "length of the rods on detachable cranks", detached),
        word("freedoms", _MODE, ("3", "4", "5", "6")),
    )


R_TUS: Final = MachineKind(
    "R-TUS",
    "a tripod of cranks with rods, with a detachable one, three to six freedoms",
    SPATIAL,
    _dimensions(length("crank", "length of the fixed cranks", "125"), length("rod", "length of their rods", "125")),
    _assembled(_crank_and_rod),
    {"half_tangents": '["1/2", "2/3", "3/5"]'},
    ((0, 0, 150), (1, 0, 0, 0)),
    METRIC,
    homes=_homes(lambda _: {"half_tangents": ('"1/2"', '"2/3"', '"3/5"')}),
)
UP_VS: Final = MachineKind(
    "UP-VS",
    "a tripod of legs of actuated length with a detachable one of cranks, three to six freedoms",
    SPATIAL,
    _dimensions(),
    _assembled(_strut),
    {"lengths": "[150, 160, 145]"},
    ((0, 0, 120), (1, 0, 0, 0)),
    METRIC,
    homes=_homes(lambda _: {"lengths": ("150", "160", "145")}),
)
CP_VS: Final = MachineKind(
    "CP-VS",
    "a tripod of struts on inclined guides with a detachable one of cranks, three to six freedoms",
    SPATIAL,
    _dimensions(),
    _assembled(_strut_on_guide),
    {"slides": "[50, 50, 50]"},
    ((0, 0, 150), (1, 0, 0, 0)),
    METRIC,
    homes=_homes(lambda free: {"slides": ("50", "53", "47")[: 3 - free], "lengths": ("70", "75", "66")[:free]}),
)
R_TCS: Final = MachineKind(
    "R-TCS",
    "a tripod of cranks with rods on collars, with a detachable one of cranks, three to six freedoms",
    SPATIAL,
    _dimensions(length("rod", "length of the rods", "150"), detached="250"),
    _assembled(_rod_on_crank),
    {"half_tangents": '["1/3", "1/3", "1/3"]'},
    ((0, 0, 150), (1, 0, 0, 0)),
    METRIC,
    homes=_homes(lambda _: {"half_tangents": ('"1/3"', '"2/5"', '"3/8"')}),
)

"""The Cartesian parallel manipulator, 3-PRRR: in each limb a slide and three hinges along one axis of coordinates.

Three limbs keep the platform from turning. With the slides driven, ``driven = "P"``, its position is read off them.
With the first hinges driven, ``driven = "R"``, each limb keeps the platform at the distance L2 from an axis through the
end of its crank L1: three cylinders, and eight complex poses always, since y^2 + z^2, z^2 + x^2 and x^2 + y^2 vanish
together only at 0.

Reference: Elkady et al. in Parallel Manipulators: Towards New Applications (2008), ch. 13, (3) to (9).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, word
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import ORIGIN
from pkm_exact.motions.motion_groups import TRANSLATION

_ZERO: Final = Fraction(0)
_ONE: Final = Fraction(1)
_AXES: Final[tuple[Vector, ...]] = ((_ONE, _ZERO, _ZERO), (_ZERO, _ONE, _ZERO), (_ZERO, _ZERO, _ONE))


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - axes of coordinates
    """Three planes, or three cylinders."""
    if given["driven"] == "P":
        planes = tuple(InPlane(axis, _ZERO, ORIGIN, f"limb {k}") for k, axis in enumerate(_AXES, 1))
        return Assembly(planes, (Group(Joint.OFFSET, tuple(plane.name for plane in planes)),))
    side, arm, link, rail = (given[key] for key in ("half_side", "arm", "link", "rail"))
    limbs: tuple[tuple[Vector, tuple[Vector, Vector]], ...] = (
        ((_ZERO, side, _ZERO), ((_ZERO, arm, _ZERO), (_ZERO, _ZERO, arm))),
        ((side, _ZERO, _ZERO), ((_ZERO, _ZERO, arm), (arm, _ZERO, _ZERO))),
        ((_ZERO, rail - side, _ZERO), ((arm, _ZERO, _ZERO), (_ZERO, -arm, _ZERO))),
    )
    cylinders = []
    drives = []
    for k, (axis, (point, circle)) in enumerate(zip(_AXES, limbs, strict=True), 1):
        cylinders.append(AxisDistance(point, axis, ORIGIN, link * link, f"limb {k}"))
        drives.append(Drive(f"hinge {k}", (Part(f"limb {k}", "point", circle),), weight=1))
    return Assembly(tuple(cylinders), (Group(Joint.CRANK, tuple(x.name for x in drives)),), tuple(drives))


CARTESIAN: Final = MachineKind(
    "3-PRRR",
    "translations: three limbs along the axes, driven by their first hinges or their slides",
    TRANSLATION,
    (
        length("half_side", "L, half the side of the platform", "0.105"),
        length("arm", "L1, from the driven hinge to the second", "0.5"),
        length("link", "L2, from the second hinge to the third", "0.373"),
        length("rail", "D, how far the third rail is off", "0.9144"),
        word("driven", "which joints are driven: the hinges R or the slides P", ("R", "P")),
    ),
    assemble,
    {"half_tangents": '[0, 1, "1/4"]'},
    ((0, 1, 0), (1, 0, 0, 0)),
    homes={("driven", "P"): {"offsets": '["1/2", "2/5", "3/5"]'}},
)

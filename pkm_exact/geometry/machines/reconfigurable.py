"""P-FUS: a tripod on inclined slides with a detachable tripod of cranks, in modes of three to six freedoms.

Fixed legs at 0, 120 and 240 degrees: a carriage at the radius R - q and the height q (slides inwards and up at 45
degrees, q = s / sqrt(2) of the stroke s), a rod to the platform. Detachable legs at 60, 180 and 300 degrees: a crank
in the vertical plane through the axis, and a rod. In the mode of m freedoms 6 - m legs are detached; as many fixed
legs have a locked hinge that keeps their platform joint in the vertical plane through the axis. 16, 32, 40 and 40
complex poses for 3, 4, 5 and 6 freedoms. Reference: Finistauri, Xi and Petz in Parallel Manipulators: Towards New
Applications (2008), ch. 18, tables 3 and 8.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, word
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import METRIC, RADIAL, TANGENTIAL, UP, along
from pkm_exact.motions.motion_groups import SPATIAL

_BETWEEN: Final = tuple(along((-1, RADIAL[k])) for k in (2, 0, 1))
"""At 60, 180 and 300 degrees."""


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - that of the triangle
    """Rods on carriages, of which some stay in planes, and rods on cranks."""
    base, platform, rod = given["base_radius"], given["platform_radius"], given["rod"]
    detached = 6 - int(given["freedoms"])
    constraints: list[Constraint] = []
    slides = []
    for k, (radial, normal) in enumerate(zip(RADIAL, TANGENTIAL, strict=True), 1):
        joint = along((platform, radial))
        constraints.append(Distance(along((base, radial)), joint, rod * rod, f"rod {k}"))
        slides.append(Drive(f"slide {k}", (Part(f"rod {k}", "base", (along((-1, radial), (1, UP)),)),)))
        if k <= detached:
            constraints.append(InPlane(normal, Fraction(0), joint, f"hinge {k}"))
    rods, cranks = detachable(given)
    groups = [Group(Joint.SLIDE, tuple(x.name for x in slides))]
    if cranks:
        groups.append(Group(Joint.CRANK, tuple(x.name for x in cranks)))
    return Assembly((*constraints, *rods), tuple(groups), (*slides, *cranks))


def detachable(given: Dimensions) -> tuple[list[Constraint], list[Drive]]:
    """Rods on cranks at 60, 180 and 300 degrees: as many as the mode has freedoms beyond three."""
    base, platform, arm, link = (given[key] for key in ("base_radius", "platform_radius", "arm", "link"))
    rods: list[Constraint] = []
    cranks = []
    for k, radial in enumerate(_BETWEEN[: int(given["freedoms"]) - 3], 4):
        rods.append(Distance(along((base, radial)), along((platform, radial)), link * link, f"rod {k}"))
        circle = along((arm, radial)), along((arm, UP))
        cranks.append(Drive(f"crank {k}", (Part(f"rod {k}", "base", circle),), weight=1))
    return rods, cranks


P_FUS: Final = MachineKind(
    "P-FUS",
    "a tripod on inclined slides with a detachable one of cranks, three to six freedoms",
    SPATIAL,
    (
        length("base_radius", "of the base's joints", "100"),
        length("platform_radius", "of the platform's joints", "50"),
        length("rod", "length of the rods on slides", "100"),
        length("arm", "length of the cranks", "150"),
        length("link", "length of the rods on cranks", "150"),
        word("freedoms", "of the mode: as many legs as that are attached", ("3", "4", "5", "6")),
    ),
    assemble,
    {"slides": "[30, 35, 27]"},
    ((0, 0, 60), (1, 0, 0, 0)),
    METRIC,
    homes={
        ("freedoms", "4"): {"slides": "[30, 35, 27]", "half_tangents": '["5/3"]'},
        ("freedoms", "5"): {"slides": "[30, 35, 27]", "half_tangents": '["6/5", "3/2"]'},
        ("freedoms", "6"): {"slides": "[30, 35, 27]", "half_tangents": '[1, "1/2", 1]'},
    },
)

"""H4: four rods on vertical slides, lateral bars that do not turn, a platform that moves and turns about the vertical.

    |C + R h_i + d_i - A_i - q_i e_z| = l_i

h_i is where the bar of rod i is hinged to the platform, d_i leads along the bar to the rod and does not turn. Eight
complex poses. Reference: Wu and Yin in Parallel Manipulators: Towards New Applications (2008), ch. 19, (14).
"""

from __future__ import annotations

from typing import Final

from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import rods, vectors
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import UP, along
from pkm_exact.motions.motion_groups import SCHOENFLIES


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - vectors are given
    """Four rods whose lower ends stand on carriages; what does not turn is taken to the base."""
    legs = []
    drives = []
    rows = zip(given["base"], given["bars"], given["platform"], given["rod"], strict=True)
    for k, (foot, bar, joint, square) in enumerate(rows, 1):
        legs.append(Distance(along((1, foot), (-1, bar)), joint, square, f"rod {k}"))
        drives.append(Drive(f"slide {k}", (Part(f"rod {k}", "base", (UP,)),)))
    return Assembly(tuple(legs), (Group(Joint.SLIDE, tuple(x.name for x in drives)),), tuple(drives), given["bars"])


H4: Final = MachineKind(
    "H4",
    "translations and turns about the vertical: four rods on vertical slides",
    SCHOENFLIES,
    (
        vectors("base", "a point on each slide", "[[-48, -48, 0], [-48, 48, 0], [6, 48, 0], [48, -6, 0]]", 4),
        vectors("platform", "where the bars are hinged", "[[-6, 0, 0], [-6, 0, 0], [6, 0, 0], [6, 0, 0]]", 4),
        vectors("bars", "from there along the bars to the rods", "[[0, -6, 0], [0, 6, 0], [0, 6, 0], [0, -6, 0]]", 4),
        rods(
            4,
            "[5292, 5292, 3528, 3528]",
            "squared lengths of the rods; or rods, rod, rod_squared",
            first="rods_squared",
        ),
    ),
    assemble,
    {"slides": '["13.02", "-7.49", "9.68", "15.77"]'},
    ((0, 0, -42), (1, 0, 0, 0)),
)

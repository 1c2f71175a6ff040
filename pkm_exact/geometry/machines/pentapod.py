"""The pentapod: five legs of actuated length to collars on a tool's axis, which hold the axis but not the spin about
it.

The platform's third axis is the tool; collar i is at the height t_i. With the spin free, the poses are curves.
``spin = "held"`` adds n.(R e_x) = 0, the tool's first axis perpendicular to a direction n of the base: each position of
the axis is then met twice, half a turn of the tool apart, so that these are half as many as the poses. There are eight
in general: |C + t_i a - A_i|^2 = l_i^2 is linear in |C|^2, C.a, C and a, and three quadrics are left.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import numbers, vector, vectors, word
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import UP, along
from pkm_exact.motions.motion_groups import SPATIAL


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - lengths are given
    """Five legs to points of one line, and what holds the spin."""
    rows = enumerate(zip(given["base"], given["collars"], strict=True), 1)
    legs: list[Constraint] = [
        Distance(foot, along((height, UP)), Fraction(1), f"leg {k}") for k, (foot, height) in rows
    ]
    group = Group(Joint.LENGTH, tuple(leg.name for leg in legs))
    if given["spin"] == "held":
        if not any(given["reference"]):
            raise InputError("dimensions.reference: is 0; give a direction")
        first = (Fraction(1), Fraction(0), Fraction(0))
        legs.append(Angle(given["reference"], first, Fraction(0), "spin"))
    return Assembly(tuple(legs), (group,))


_FEET: Final = "[[-4, 3, 9], [4, 3, 9], [-4, -3, 9], [4, -3, 9], [0, -5, 9]]"
PENTAPOD: Final = MachineKind(
    "pentapod",
    "a tool held by five legs of actuated length, free to spin about its axis",
    SPATIAL,
    (
        vectors("base", "joints of the base, one per leg", _FEET, 5),
        numbers("collars", "heights of the collars on the tool's axis", '[-2, "-3/2", "-1/2", "1/2", 0]', 5),
        word("spin", "held: the tool's first axis is perpendicular to reference; free", ("held", "free")),
        vector("reference", "a direction of the base", "[0, 1, 0]", 3, (0, 1, 0)),
    ),
    assemble,
    {"pose": '{ position = ["1/2", "1/3", 1], quaternion = [9, 1, -1, 0] }'},
    ((1, 0, 1), (1, 0, 0, 0)),
    own_metric=True,
)

"""The spherical 3-RRR: all axes pass through one point, about which the platform turns.

Crank i turns about the axis a_i and carries the axis w_i of the middle hinge; the link keeps the angle between w_i
and the axis R v_i of the platform. With w_i(0) = z + u, z along a_i and u perpendicular to it,

    w_i = z + c u + s (a_i x u),    c = cos(angle),  s = sin(angle) / |a_i|,    w_i.(R v_i) = the link's product

so that |a_i|^2 may be any integer. At most eight poses. Reference: Gosselin, Sefrioui and Richard, "On the direct
kinematics of general spherical three-degree-of-freedom parallel manipulators", ASME J. Mech. Des. 116 (1994).
"""

from __future__ import annotations

from typing import Final

from pkm_exact.constraints.angle import Angle
from pkm_exact.errors import InputError
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric, cross, dot
from pkm_exact.geometry.machines.dimension_readers import numbers, vectors
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import along
from pkm_exact.geometry.polar_vectors import PolarVector
from pkm_exact.motions.motion_groups import SPHERICAL


def assemble(given: Dimensions, metric: Metric) -> Assembly:
    """Three products of directions, of which one is on a crank."""
    links = []
    drives = []
    rows = zip(given["axes"], given["links"], given["platform"], given["products"], strict=True)
    for k, (axis, link, held, product) in enumerate(rows, 1):
        norm = dot(axis, axis, metric)
        if norm <= 0 or norm.denominator != 1:
            raise InputError(
                f"dimensions.axes[{k}]: its square is {norm}; give a vector whose square is a positive integer"
            )
        if isinstance(product, PolarVector):
            product = product.product(link, held, metric)
        still = along((dot(axis, link, metric) / norm, axis))
        turning = along((1, link), (-1, still))
        if not any(turning):
            raise InputError(f"dimensions.links[{k}]: is parallel to its crank's axis; give one that the crank turns")
        links.append(Angle(still, held, product, f"link {k}"))
        circle = Part(f"link {k}", "base", (turning, cross(axis, turning)))
        drives.append(Drive(f"crank {k}", (circle,), int(norm)))
    if any(not any(vector) for vector in given["platform"]):
        raise InputError("dimensions.platform: a direction is 0; give one that is not")
    return Assembly(tuple(links), (Group(Joint.CRANK, tuple(x.name for x in drives)),), tuple(drives))


SPHERICAL_3_RRR: Final = MachineKind(
    "spherical-3-RRR",
    "turns about a point: three cranks whose axes meet there",
    SPHERICAL,
    (
        vectors("axes", "of the cranks; their squares are integers", "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", 3),
        vectors(
            "links",
            "axes of the middle hinges, the cranks at 0",
            '[[0, "3/5", "4/5"], ["4/5", 0, "3/5"], ["3/5", "4/5", 0]]',
            3,
        ),
        vectors(
            "platform",
            "axes of the platform's hinges",
            '[[0, "-4/5", "3/5"], ["3/5", 0, "-4/5"], ["-4/5", "3/5", 0]]',
            3,
        ),
        numbers(
            "products",
            "cosines of the links' angles, times the lengths of both directions; or angles as { degrees = 60 }",
            '["1/5", "-1/4", "1/3"]',
            3,
            angles=True,
        ),
    ),
    assemble,
    {"half_tangents": '["1/5", "-1/4", "1/3"]'},
    ((0, 0, 0), (1, 0, 0, 0)),
)

"""Legs of actuated length in space: any number of them, about a fixed point, and what their joints measure.

n-UPS      n legs between base and platform: fewer than six leave motions, more must fit together
n-UPS+S    the platform's origin is held by a ball joint at the base's (an ankle, a wrist): three legs hold it
ranges     a point at known distances from anchors, in the plane or in space
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import vectors
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import ORIGIN, UP
from pkm_exact.motions.motion_groups import SPATIAL, SPHERICAL, TRANSLATION

_ONE: Final = Fraction(1)
_BASE: Final = [[6, 0, 0], [0, 5, 1], [-5, 1, 0], [1, -6, 0], [4, 4, 0], [-3, 5, -1], [-4, -4, 1], [5, -3, 0]]
_PLATFORM: Final = [[3, 1, 0], [1, 3, 1], [-2, 1, 0], [0, -3, 1], [2, 2, -1], [-1, 2, 0], [-2, -1, 2], [3, -2, 0]]


def _legs(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - lengths are given
    pairs = enumerate(zip(given["base"], given["platform"], strict=True), 1)
    legs = tuple(Distance(foot, joint, _ONE, f"leg {k}") for k, (foot, joint) in pairs)
    return Assembly(legs, (Group(Joint.LENGTH, tuple(leg.name for leg in legs)),))


def _ranges(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001
    legs: list[Constraint] = [
        Distance(anchor, ORIGIN, _ONE, f"range {k}") for k, anchor in enumerate(given["anchors"], 1)
    ]
    group = Group(Joint.LENGTH, tuple(leg.name for leg in legs))
    if all(anchor[2] == 0 for anchor in given["anchors"]):
        legs.append(InPlane(UP, Fraction(0), ORIGIN, "plane"))
    return Assembly(tuple(legs), (group,))


def _kind(name: str, words: str, count: int, home: dict[str, str], *, about_a_point: bool) -> MachineKind:
    base, platform = (
        vectors("joints", f"joints of the {part}, one per leg", str(rows[:count]), count, table=part, name=part)
        for part, rows in (("base", _BASE), ("platform", _PLATFORM))
    )
    return MachineKind(
        name,
        words,
        SPHERICAL if about_a_point else SPATIAL,
        (base, platform),
        _legs,
        home,
        ((0, 0, 0 if about_a_point else 6), (1, 0, 0, 0)),
        own_metric=True,
        any_count=True,
    )


def n_ups(count: int) -> MachineKind:
    """Legs in space."""
    home = {"pose": '{ position = [1, "1/2", 6], quaternion = [9, 1, -1, 2] }'}
    return _kind(f"{count}-UPS", "legs of actuated length, any number of them", count, home, about_a_point=False)


def n_ups_s(count: int) -> MachineKind:
    """Legs about a fixed point."""
    home = {"pose": "{ quaternion = [9, 1, -1, 2] }"}
    words = "turns about the origin: legs of actuated length, any number of them"
    return _kind(f"{count}-UPS+S", words, count, home, about_a_point=True)


RANGES: Final = MachineKind(
    "ranges",
    "a point at known distances from anchors, in the plane if they have two coordinates",
    TRANSLATION,
    (vectors("anchors", "where the distances are measured from", "[[0, 0], [60, 0]]", None, None),),
    _ranges,
    {"lengths_squared": "[4225, 4825]"},
    ((25, 60, 0), (1, 0, 0, 0)),
    own_metric=True,
)

"""The types of constraints by their names. One row adds a type; the tests ask every row."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane

CONSTRAINTS: Final[Mapping[str, type[Constraint]]] = MappingProxyType(
    {found.type: found for found in (Distance, InPlane, Carries, OnLine, AtPoint, Angle, AxisDistance, LinearForm)}
)
"""By type, in the order of the documentation."""

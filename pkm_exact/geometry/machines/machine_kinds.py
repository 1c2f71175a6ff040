"""The machines by their names. One row adds a machine; the tests ask every row."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

from pkm_exact.geometry.machines.carriage import CARRIAGE
from pkm_exact.geometry.machines.cartesian import CARTESIAN
from pkm_exact.geometry.machines.central_joint import THREE_PSS_C, TWO_UPS_U
from pkm_exact.geometry.machines.delta import DELTA
from pkm_exact.geometry.machines.h_four import H4
from pkm_exact.geometry.machines.linear_delta import LINEAR_DELTA, TRIGLIDE
from pkm_exact.geometry.machines.machine_kind import MachineKind
from pkm_exact.geometry.machines.pentapod import PENTAPOD
from pkm_exact.geometry.machines.planar_legs import n_prr, n_rpr, n_rrr
from pkm_exact.geometry.machines.point_slides import BIGLIDE, PMAR, V_SHAPE, X_Y
from pkm_exact.geometry.machines.reconfigurable import P_FUS
from pkm_exact.geometry.machines.reconfigurable_branches import CP_VS, R_TCS, R_TUS, UP_VS
from pkm_exact.geometry.machines.space_legs import RANGES, n_ups, n_ups_s
from pkm_exact.geometry.machines.spherical_cranks import SPHERICAL_3_RRR
from pkm_exact.geometry.machines.three_legs import THREE_PRS, THREE_RPS
from pkm_exact.geometry.mechanism import MOST_CONSTRAINTS

_FAMILIES: Final[Mapping[str, Callable[[int], MachineKind]]] = MappingProxyType(
    {"UPS": n_ups, "UPS+S": n_ups_s, "RPR": n_rpr, "RRR": n_rrr, "PRR": n_prr}
)
_ROWS: Final = (
    *(DELTA, LINEAR_DELTA, TRIGLIDE, CARTESIAN, H4),
    *(THREE_RPS, THREE_PRS, THREE_PSS_C, TWO_UPS_U, P_FUS, PENTAPOD, CARRIAGE),
    *(R_TUS, UP_VS, CP_VS, R_TCS),
    *(SPHERICAL_3_RRR, n_ups_s(3), n_ups(8), n_rpr(4), n_rrr(4), n_prr(4)),
    *(RANGES, BIGLIDE, V_SHAPE, PMAR, X_Y),
)

MACHINES: Final[Mapping[str, MachineKind]] = MappingProxyType({kind.name: kind for kind in _ROWS})
"""By name; of machines with any number of legs one that stands for all."""


def machine_kind(name: str) -> MachineKind | None:
    """The machine of a name, with any number of legs where that makes sense; None if there is none.

    Examples
    --------
    >>> machine_kind("5-UPS").name, machine_kind("delta").name, machine_kind("0-UPS") is None
    ('5-UPS', 'delta', True)
    """
    if name in MACHINES:
        return MACHINES[name]
    found = re.fullmatch(r"([1-9][0-9]?)-(.+)", name, re.ASCII)
    if found is None or found[2] not in _FAMILIES or int(found[1]) > MOST_CONSTRAINTS:
        return None
    return _FAMILIES[found[2]](int(found[1]))

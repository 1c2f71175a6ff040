"""The machines by their names. One row adds a machine; the tests ask every row."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from pkm_exact.geometry.machines.delta import DELTA
from pkm_exact.geometry.machines.linear_delta import LINEAR_DELTA, TRIGLIDE
from pkm_exact.geometry.machines.machine_kind import MachineKind
from pkm_exact.geometry.machines.three_legs import THREE_PRS, THREE_RPS

_ROWS: Final = (DELTA, LINEAR_DELTA, TRIGLIDE, THREE_RPS, THREE_PRS)

MACHINES: Final[Mapping[str, MachineKind]] = MappingProxyType({kind.name: kind for kind in _ROWS})
"""By name."""

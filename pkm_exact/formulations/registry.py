"""The formulations by their codes. Importing this module is cheap: an entry is loaded when it is asked for."""

from __future__ import annotations

from importlib import import_module
from typing import cast

from pkm_exact.errors import InputError
from pkm_exact.formulations.protocol import Formulation

_ENTRIES = {
    "SE3": ("pkm_exact.formulations.motion_variety", "SE3"),
    "AFD4": ("pkm_exact.formulations.displacement", "AFD4"),
    "AFD5": ("pkm_exact.formulations.displacement", "AFD5"),
    "AFP3": ("pkm_exact.formulations.position", "AFP3"),
}


def formulation_codes() -> tuple[str, ...]:
    """Codes of all formulations, the default first."""
    return tuple(_ENTRIES)


def formulation(code: str) -> Formulation:
    """The formulation with the given code.

    Raises
    ------
    InputError
        If there is none of that code.
    """
    entry = _ENTRIES.get(code)
    if entry is None:
        raise InputError(f"formulation: {code!r} is unknown; use one of {', '.join(_ENTRIES)}")
    module, name = entry
    return cast(Formulation, getattr(import_module(module), name)())

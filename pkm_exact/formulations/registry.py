"""The formulations by their codes. Importing this module is cheap: an entry is loaded when it is asked for.

A code may carry an option after a colon: the Euler convention of AFD1 and AFD2 ("AFD1:zxz"), the three legs whose
joints AFP1 to AFP4 start from ("AFP1:124").
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, cast

from pkm_exact.errors import InputError
from pkm_exact.formulations.protocol import Formulation

if TYPE_CHECKING:
    from pkm_exact.geometry.problem import ForwardProblem

_ENTRIES = {
    "SE3": ("motion_variety", None),
    "AFD1": ("euler", "convention"),
    "AFD2": ("euler", "convention"),
    "AFD3": ("displacement", None),
    "AFD4": ("displacement", None),
    "AFD5": ("displacement", None),
    "AFD6": ("dual_quaternion", None),
    "AFP1": ("position", "triple"),
    "AFP2": ("position", "triple"),
    "AFP3": ("position", "triple"),
    "AFP4": ("six_points", "triple"),
}


def formulation_codes() -> tuple[str, ...]:
    """Codes of all formulations, the default first.

    Examples
    --------
    >>> formulation_codes()[0]
    'SE3'
    """
    return tuple(_ENTRIES)


def formulation(code: str) -> Formulation:
    """The formulation with the given code, and option if any.

    Raises
    ------
    InputError
        If there is none of that code, or the option does not fit.
    """
    name, values = _parsed(code)
    module, _ = _ENTRIES[name]
    return cast(Formulation, getattr(import_module(f"pkm_exact.formulations.{module}"), name)(**values))


def formulation_for(code: str, problem: ForwardProblem) -> Formulation:
    """The formulation with the given code, to write this problem in.

    Raises
    ------
    InputError
        As ``formulation``, and if the formulation cannot write such constraints or motions.
    """
    found, first = formulation(code), formulation_codes()[0]
    reason = found.refusal(problem)
    if reason is not None:
        raise InputError(f"formulation: {code} is for {reason}; use {first}")
    return found


def checked_code(code: str) -> str:
    """The code itself, if ``formulation`` accepts it; nothing is loaded to find out.

    Raises
    ------
    InputError
        As ``formulation``.

    Examples
    --------
    >>> checked_code("AFD1:zxz")
    'AFD1:zxz'
    """
    _parsed(code)
    return code


def _parsed(code: str) -> tuple[str, dict[str, Any]]:
    """The name and the arguments that a code denotes."""
    name, colon, option = code.partition(":")
    if name not in _ENTRIES:
        raise InputError(f"formulation: {code[:40]!r} is unknown; use one of {', '.join(_ENTRIES)}")
    _, field = _ENTRIES[name]
    if not colon:
        return name, {}
    if field is None:
        raise InputError(f"formulation: {name} takes no option, but {code[:40]!r} has one; write {name}")
    return name, {field: _convention(option) if field == "convention" else _triple(option)}


def _convention(option: str) -> str:
    if len(option) != 3 or set(option) - set("xyz") or option[0] == option[1] or option[1] == option[2]:
        raise InputError(
            f"formulation: {option[:40]!r} is no Euler convention; give three of x, y, z, none twice in a row, "
            "such as zyx or zxz"
        )
    return option


def _triple(option: str) -> tuple[int, int, int]:
    if len(option) != 3 or set(option) - set("123456") or len(set(option)) != 3:
        raise InputError(f"formulation: {option[:40]!r} is no triple of legs; give three of 1 to 6, such as 124")
    legs = sorted(int(digit) - 1 for digit in option)
    return legs[0], legs[1], legs[2]

"""Certificates of statics, of the version that a machine and its pose have."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.statics_box_build import statics_box_certificate
from pkm_exact.certify.statics_box_machine import is_of_legs
from pkm_exact.certify.statics_build import is_for_legs_alone, statics_certificate
from pkm_exact.certify.statics_driven_build import driven_legs, statics_driven_certificate
from pkm_exact.certify.statics_equations_build import statics_equation_certificate
from pkm_exact.statics.measures import Measures

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.statics.at_pose import AtPose

_NOT_CERTIFIED: Final = {
    "wrench_polytope": ("forces", "it has no interior, or a leg exerts nothing"),
    "ellipsoid": ("speeds", "none is proved to be nearly the largest"),
    "indices": ("", "singular values need a length where translations and turns mix, and a regular pose"),
}
"""Parts that version 1 may lack although their limits are given, and why."""


def any_statics_certificate(
    machine: Machine | None,
    measures: Measures,
    load: Sequence[Fraction] | None = None,
    solution: Mapping[str, Any] | None = None,
) -> tuple[dict[str, Any], dict[str, str]]:
    """The certificate of what was asked, and why parts of it are not there.

    Version 1 at an exact pose of legs alone, version 3 if slides and cranks drive them and no load is given, else
    version 2 of machines whose actuators drive legs, version 4 of others.

    Raises
    ------
    InputError
        If there is none of this machine, or the box is too wide.
    """
    at: AtPose = measures.freedom.at  # type: ignore[assignment]
    left_out = dict[str, str]()
    if at.is_forward:
        return statics_equation_certificate(measures, load, solution)
    if machine is not None and is_for_legs_alone(machine, at):
        content = statics_certificate(machine, measures)
    elif load is None and driven_legs(at) is not None:
        content = statics_driven_certificate(measures)
    elif is_of_legs(at):
        return statics_box_certificate(measures, load, solution)
    else:
        return statics_equation_certificate(measures, load, solution)
    for name, (limit, reason) in _NOT_CERTIFIED.items():
        if content[name] is None and (limit == "" or content[limit] is not None):
            left_out[name] = reason
    if load is not None:
        left_out["actuator_forces"] = "at an exact pose of legs alone they are exact as they are printed"
    return content, left_out

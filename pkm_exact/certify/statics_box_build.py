"""Certificates of what a machine can do at every pose of a box: version 2 of statics.

The format is described in ``docs/certificates-statics.md``; its schema is ``statics-certificate-2.schema.json`` in this
folder. Everything is enclosed from what is listed before it, with room for twice the width.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from math import frexp
from typing import TYPE_CHECKING, Any, Final

from flint import arb, arb_mat

from pkm_exact.certify.build import sealed
from pkm_exact.certify.statics_box_machine import BoxedMachine, boxed_machine
from pkm_exact.certify.statics_box_parts import (
    actuator_forces,
    ellipsoid_entry,
    indices_entry,
    velocity_entry,
    wrench_entry,
)
from pkm_exact.certify.statics_build import is_for_legs_alone, short_weights, statics_certificate
from pkm_exact.certify.statics_driven_build import driven_legs, statics_driven_certificate
from pkm_exact.certify.widened import texts
from pkm_exact.errors import PkmExactError
from pkm_exact.precision import working_precision
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.largest_ellipsoid import proposed_weights
from pkm_exact.statics.measures import Measures, RefusedError

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.statics.at_pose import AtPose

_NOT_CERTIFIED: Final = {
    "wrench_polytope": ("forces", "it has no interior, or a leg exerts nothing"),
    "ellipsoid": ("speeds", "none is proved to be nearly the largest"),
    "indices": ("", "singular values need a length where translations and turns mix, and a regular pose"),
}
"""Parts that version 1 may lack although their limits are given, and why."""
FORMAT: Final = "pkm_exact statics certificate"
VERSION: Final = 2


def statics_box_certificate(
    measures: Measures, load: Sequence[Fraction] | None = None, solution: Mapping[str, Any] | None = None
) -> tuple[dict[str, Any], dict[str, str]]:
    """The certificate of a machine in the box of a pose, and why parts of it are not there.

    Parameters
    ----------
    measures : Measures
        Of an enclosed pose, or of an exact one, which becomes a box.
    load : sequence of Fraction, optional
        On the platform about its origin, a component for each freedom of the motion.
    solution : mapping, optional
        The digest of the certificate of poses and the number of the pose.

    Raises
    ------
    InputError
        If the machine is not one of legs that move with rational directions, or a box is too wide.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/3-rps.toml")
    >>> at = robot.at(robot.solve().poses[0])
    >>> content, left_out = statics_box_certificate(at.measures(speeds=1, length=3))
    >>> content["free"], len(content["velocity_polytope"]["vertices"]), left_out
    ([2, 3, 4], 8, {})
    """
    at: AtPose = measures.freedom.at  # type: ignore[assignment]
    limits, left_out = measures.limits, dict[str, str]()
    ends = None if limits.force_ends is None else list(zip(*limits.force_ends, strict=True))
    with working_precision(BITS):
        machine = boxed_machine(at)
        rows, twists = machine.rows, machine.twists

        def tried(name: str, needed: Any, make: Callable[[], Any]) -> Any:
            if needed is None:
                return None
            try:
                return make()
            except PkmExactError as error:
                left_out[name] = str(error)
                return None

        borne = tried("actuator_forces", load, lambda: actuator_forces(rows, twists, load or ()))
        velocity = tried("velocity_polytope", limits.speeds, lambda: velocity_entry(rows, limits.speeds or ()))
        wrench = tried("wrench_polytope", ends, lambda: wrench_entry(rows, ends or []))
        ellipsoid = tried("ellipsoid", limits.speeds, lambda: _ellipsoid(machine, limits.speeds or ()))
        indices = tried("indices", True, lambda: _indices(machine, measures))
    content = {
        "format": FORMAT,
        "version": VERSION,
        "name": at.name,
        "unit": at.unit,
        "solution": None if solution is None else dict(solution),
        **_pose_entries(machine),
        "speeds": None if limits.speeds is None else list(map(str, limits.speeds)),
        "forces": None if ends is None else [list(map(str, pair)) for pair in ends],
        "length": None if limits.length is None else str(limits.length),
        "load": None if load is None or borne is None else list(map(str, load)),
        "jacobian": [[texts(pair) for pair in row] for row in machine.jacobian],
        "expansion": [[texts(pair) for pair in row] for row in machine.expansion],
        "actuator_forces": borne,
        "velocity_polytope": velocity,
        "wrench_polytope": wrench,
        "ellipsoid": ellipsoid,
        "indices": indices,
    }
    return sealed(content), left_out


def any_statics_certificate(
    machine: Machine | None,
    measures: Measures,
    load: Sequence[Fraction] | None = None,
    solution: Mapping[str, Any] | None = None,
) -> tuple[dict[str, Any], dict[str, str]]:
    """The certificate of what was asked, and why parts of it are not there.

    Version 1 at an exact pose of legs alone, version 3 if slides and cranks drive them and no load is given, else
    version 2.
    """
    at: AtPose = measures.freedom.at  # type: ignore[assignment]
    left_out = dict[str, str]()
    if machine is not None and is_for_legs_alone(machine, at):
        content = statics_certificate(machine, measures)
    elif load is None and driven_legs(at) is not None:
        content = statics_driven_certificate(measures)
    else:
        return statics_box_certificate(measures, load, solution)
    for name, (limit, reason) in _NOT_CERTIFIED.items():
        if content[name] is None and (limit == "" or content[limit] is not None):
            left_out[name] = reason
    if load is not None:
        left_out["actuator_forces"] = "at an exact pose of legs alone they are exact as they are printed"
    return content, left_out


def _pose_entries(machine: BoxedMachine) -> dict[str, Any]:
    """Machine and box."""
    at = machine.at
    legs = [
        {
            "base": list(map(str, leg.base)),
            "platform": list(map(str, leg.platform)),
            "direction": None if leg.direction is None else list(map(str, leg.direction)),
        }
        for leg in machine.legs
    ]
    return {
        "metric": list(map(str, at.metric)),
        "freedoms": list(at.motion.twist),
        "position": [texts(pair) for pair in machine.position],
        "rotation": [[texts(pair) for pair in row] for row in machine.rotation],
        "legs": legs,
        "constraints": [list(map(str, form)) for form in machine.constraints],
        "free": list(machine.free),
    }


def _ellipsoid(machine: BoxedMachine, speeds: Sequence[Fraction]) -> dict[str, Any]:
    from pkm_exact.polytopes.enclosures import ball_of

    rows = machine.rows
    sizes = [_power(max(abs(float(x.mid())) for x in column)) for column in rows.transpose().tolist()]
    scaled = [
        [x / (ball_of(speed) * size) for x, size in zip(row, sizes, strict=True)]
        for speed, row in zip(speeds, rows.tolist(), strict=True)
    ]
    return ellipsoid_entry(rows, speeds, short_weights(proposed_weights(arb_mat(scaled))))


def _indices(machine: BoxedMachine, measures: Measures) -> dict[str, Any]:
    measures.require_norms()
    if len(measures.freedom.units) > 1:
        raise RefusedError("mixes actuators of different units: the certificate has singular values of J unscaled")
    length = measures.limits.length
    scales = [Fraction(1) if k < 3 or length is None else length**2 for k in machine.at.motion.twist]
    near = Measures(Freedom(machine.at), measures.limits).singular_values
    pairs = [_positive(near[0]), _positive(near[-1])]
    return indices_entry(machine.rows, machine.twists, scales, pairs)


def _power(value: float) -> arb:
    """A power of 2 near a number: weights do not depend on the units of the coordinates."""
    return arb(2) ** frexp(value)[1]


def _positive(value: Any) -> tuple[Fraction, Fraction]:
    from pkm_exact.polytopes.enclosures import interval_of

    found = interval_of(value)
    return Fraction(found.lo), Fraction(found.hi)

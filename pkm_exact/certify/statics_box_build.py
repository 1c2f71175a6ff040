"""Certificates of what a machine can do at every pose of a box: version 2 of statics.

The format is described in ``docs/certificates-statics.md``; its schema is ``statics-certificate-2.schema.json`` in this
folder. Everything is enclosed from what is listed before it, with room for twice the width.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import sealed
from pkm_exact.certify.statics_box_claims import attempts, both_ways, box_ellipsoid, box_indices
from pkm_exact.certify.statics_box_machine import BoxedMachine, boxed_machine
from pkm_exact.certify.statics_box_parts import actuator_forces, velocity_entry, wrench_entry
from pkm_exact.certify.widened import texts
from pkm_exact.precision import working_precision
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.measures import Measures

if TYPE_CHECKING:
    from pkm_exact.statics.at_pose import AtPose

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
        rows, twists, tried = machine.rows, machine.twists, attempts(left_out)
        borne = tried("actuator_forces", load, lambda: actuator_forces(rows, twists, load or ()))
        velocity = tried("velocity_polytope", limits.speeds, lambda: velocity_entry(rows, both_ways(limits.speeds)))
        wrench = tried("wrench_polytope", ends, lambda: wrench_entry(rows, ends or []))
        ellipsoid = tried("ellipsoid", limits.speeds, lambda: box_ellipsoid(rows, limits.speeds or ()))
        indices = tried("indices", True, lambda: box_indices(machine.at, rows, twists, measures))
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

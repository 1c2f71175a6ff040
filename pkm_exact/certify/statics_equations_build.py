"""Certificates of what any machine can do at every pose of a box: version 4 of statics.

The format is described in ``docs/certificates-statics.md``; its schema is ``statics-certificate-4.schema.json`` in this
folder. It is version 2 with equations in place of legs; machines of legs have version 2.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from flint import arb_mat

from pkm_exact.balls import ball
from pkm_exact.certify.build import sealed
from pkm_exact.certify.statics_box_claims import attempts, both_ways, box_ellipsoid, box_indices
from pkm_exact.certify.statics_box_parts import actuator_forces, velocity_entry, wrench_entry
from pkm_exact.certify.statics_equations import CertifiedEquation, EquationMachine, equation_machine
from pkm_exact.certify.widened import texts, widened_all
from pkm_exact.precision import working_precision
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.measures import Measures, RefusedError

if TYPE_CHECKING:
    from pkm_exact.statics.at_pose import AtPose

FORMAT: Final = "pkm_exact statics certificate"
VERSION: Final = 4
_ROOM: Final = 8
"""Radii that are left to a checker whose determinants are wider."""
_OTHERS: Final = "is certified of machines with J only"


def statics_equation_certificate(
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
        If constraints are not rational, or a box is too wide.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> robot = read_robot("models/3-rpr-turned.toml")
    >>> at = robot.at(robot.solve().poses[0])
    >>> content, left_out = statics_equation_certificate(at.measures(speeds=1, length=1))
    >>> content["actuators"], content["regular"], len(content["velocity_polytope"]["vertices"]), left_out
    (['3', '3', '3'], True, 8, {})
    """
    at: AtPose = measures.freedom.at  # type: ignore[assignment]
    limits, left_out = measures.limits, dict[str, str]()
    ends = None if limits.force_ends is None else list(zip(*limits.force_ends, strict=True))
    with working_precision(BITS):
        machine = equation_machine(at)
        claims = _claims(machine, measures, load, ends, left_out)
    borne, velocity, wrench, ellipsoid, indices = claims
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
        "regular": machine.regular,
        "jacobian": None if machine.jacobian is None else [[texts(x) for x in row] for row in machine.jacobian],
        "expansion": [[texts(pair) for pair in row] for row in machine.expansion],
        "actuator_forces": borne,
        "velocity_polytope": velocity,
        "wrench_polytope": wrench,
        "ellipsoid": ellipsoid,
        "indices": indices,
    }
    return sealed(content), left_out


def _claims(
    machine: EquationMachine,
    measures: Measures,
    load: Sequence[Fraction] | None,
    ends: list[tuple[Fraction, Fraction]] | None,
    left_out: dict[str, str],
) -> list[Any]:
    """Forces, polytopes, ellipsoid and indices, each None if it is not asked for or not decided."""
    rows, twists, speeds, forward = machine.rows, machine.twists, measures.limits.speeds, machine.free is None

    tried = attempts(left_out)

    def others(make: Callable[[], Any]) -> Any:
        if forward:
            raise RefusedError(_OTHERS)
        return make()

    reach = both_ways(speeds)
    return [
        tried("actuator_forces", load, lambda: _forces(machine, load or ())),
        tried("velocity_polytope", speeds, lambda: (wrench_entry if forward else velocity_entry)(rows, reach, _ROOM)),
        tried("wrench_polytope", ends, lambda: (velocity_entry if forward else wrench_entry)(rows, ends or [], _ROOM)),
        tried("ellipsoid", speeds, lambda: others(lambda: box_ellipsoid(rows, speeds or ()))),
        tried("indices", True, lambda: others(lambda: box_indices(machine.at, rows, twists, measures))),
    ]


def _forces(machine: EquationMachine, load: Sequence[Fraction]) -> list[list[str]]:
    if machine.jacobian is not None:
        return actuator_forces(machine.rows, machine.twists, load)
    found = machine.rows * arb_mat([[-ball(x)] for x in load])
    return [texts(pair) for pair in widened_all(found.entries())]


def _pose_entries(machine: EquationMachine) -> dict[str, Any]:
    """Machine and box."""
    at = machine.at
    return {
        "metric": list(map(str, at.metric)),
        "freedoms": list(at.motion.twist),
        "position": [texts(pair) for pair in machine.position],
        "rotation": [[texts(pair) for pair in row] for row in machine.rotation],
        "actuators": list(map(str, machine.actuators)),
        "equations": list(map(_equation, machine.equations)),
        "free": None if machine.free is None else list(machine.free),
    }


def _equation(equation: CertifiedEquation) -> dict[str, Any]:
    square = equation.square
    return {
        "form": list(map(str, equation.form)),
        "square": None if square is None else {"factor": str(square[0]), "form": list(map(str, square[1]))},
        "rates": [[k + 1, list(map(str, form))] for k, form in equation.rates],
    }

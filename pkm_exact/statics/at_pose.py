"""A machine at a pose, and what is asked about it: indices, polytopes, ellipsoids, forces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from flint import arb_mat

from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.rational import parse_rational
from pkm_exact.polytopes.polytope import Polytope
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.actuated_equations import Held
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.capability import velocity_polytope, wrench_polytope
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.entangled_rows import regular_choice
from pkm_exact.statics.forces import Forces, forces
from pkm_exact.statics.forward_map import ForwardMap
from pkm_exact.statics.index_rows import enclosed_indices
from pkm_exact.statics.largest_ellipsoid import LargestEllipsoid, largest_ellipsoid
from pkm_exact.statics.limits_of_actuators import ActuatorLimits
from pkm_exact.statics.measures import Measures
from pkm_exact.statics.pose_rows import PoseRows
from pkm_exact.statics.redundant_kinematics import measures_of


@dataclass(frozen=True, repr=False, eq=False)
class AtPose(PoseRows):
    """A machine at a pose, with the attributes of its rows (``PoseRows``).

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
    >>> at = robot.at({"position": [5, "9/2"], "half_tangent": "1/3"})
    >>> at.jacobian.to_numpy().shape, at.rank, at.singular
    ((3, 3), 3, ())
    >>> print(at.jacobian.columns, at.jacobian[0, 0].width < 1e-15)
    ('vx', 'vy', 'wz') True
    """

    def indices(self, **limits: Any) -> dict[str, Interval]:
        """The values of all indices that have one, enclosed (``statics.index_rows`` has definitions and units).

        Parameters
        ----------
        limits
            As for ``statics.limits_of_actuators``: speeds, forces, length, .., exact.

        Raises
        ------
        InputError
            If there is no J, or a limit cannot be used.

        Examples
        --------
        >>> from pkm_exact import Robot
        >>> robot = Robot.load("models/3-rpr-merlet-p.toml")
        >>> at = robot.at({"position": [5, "9/2"], "half_tangent": "1/3"})
        >>> sorted(at.indices(speeds=1))
        ['v_iso_p', 'w_iso_o']
        >>> at.indices(length=4)["condition"].width < 1e-12
        True
        """
        return enclosed_indices(self.measures(**limits))[0]

    @cached_property
    def forward(self) -> EnclosedMatrix | None:
        """T in t = T q', where there is no J (``statics.forward_map``); None where there is."""
        return ForwardMap(self).matrix if self.is_forward else None

    def measures(self, **limits: Any) -> Measures:
        """What indices are computed from."""
        return measures_of(self, ActuatorLimits.of(limits, len(self.actuated)))

    def velocity_polytope(self, speeds: Any) -> Polytope:
        """The twists that actuators with these greatest speeds can follow; one number is that of all."""
        measures = self.measures(speeds=speeds)
        return velocity_polytope(measures.freedom, measures.known("speeds"))

    def wrench_polytope(self, forces: Any, least: Any = None) -> Polytope:
        """The wrenches that actuators with these greatest forces can exert; ``least`` ones are 0 for cables."""
        given = {"forces": forces} if least is None else {"forces": forces, "least_forces": least}
        measures = self.measures(**given)
        low, high = measures.limits.force_ends or ((), ())
        return wrench_polytope(measures.freedom, low, high)

    def ellipsoid(self, speeds: Any, length: Any = None) -> LargestEllipsoid:
        """The largest ellipsoid of twists in the velocity polytope, turns multiplied by the length.

        Its half axes are those among the twists that constraints allow; its matrix is in the free components.
        """
        measures = self.measures(**{"speeds": speeds} | ({} if length is None else {"length": length}))
        measures.require_norms()
        freedom, size = measures.freedom, measures.limits.length
        rows = freedom.scaled(size, measures.known("speeds"))
        if self.is_forward or not self.held.structural:
            return largest_ellipsoid(rows, self.twist)
        basis = freedom.basis(size).tolist()
        free = arb_mat([basis[place] for place in freedom.free.places])
        return largest_ellipsoid(rows, freedom.components, free)

    def forces(self, load: Sequence[Any]) -> Forces:
        """The actuator forces that bear a load on the platform, about its origin (``statics.forces``)."""
        return self.borne([parse_rational(x, f"load[{k}]") for k, x in enumerate(load, 1)])

    def borne(self, load: Sequence[Any]) -> Forces:
        """The same of a load that has been read, or that is enclosed."""
        return ForwardMap(self).forces(load) if self.is_forward else forces(self, load)

    def __repr__(self) -> str:
        return f"<AtPose: {self}>"


def at_rational_pose(machine: Any, held: Held, position: Vector, rotation: Matrix) -> AtPose:
    """A machine at a rational pose of its metric."""
    who = machine.name, machine.unit, machine.motion, machine.metric
    return _regular(AtPose(*who, held, position, rotation, is_exact=True))


def at_box(
    machine: Any,
    held: Held,
    position: Sequence[Interval],
    rotation: Sequence[Sequence[Interval]],
    rank: int | None,
    *,
    is_multiple: bool = False,
) -> AtPose:
    """A machine at a pose that lies in a box of ordinary coordinates."""
    who = machine.name, machine.unit, machine.motion, machine.metric
    box = tuple(position), tuple(map(tuple, rotation))
    return _regular(AtPose(*who, held, *box, is_exact=False, known_rank=rank, is_multiple=is_multiple))


def _regular(at: AtPose) -> AtPose:
    """The same with equations for the speeds of its actuators that give them at this pose, if there are such."""
    held = at.held
    if not held.is_entangled:
        return at
    with working_precision(BITS):
        chosen = regular_choice(held, at.exact_rows, () if at.is_exact else at.ball_rows)
    return at if chosen is held else replace(at, held=chosen)

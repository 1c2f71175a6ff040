"""The legs of a robot as regions see them: base joint, platform joint, and what the actuator does between them."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final, TypeAlias

from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Form, Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, Slide
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.limits import Cones, Limits, Pair
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.robot import Robot, jointed
from pkm_exact.wording import shown

PLUS: Final = 1
MINUS: Final = -1
_ZERO: Final = Fraction(0)


@dataclass(frozen=True)
class OwnLength:
    """The leg's length is actuated."""


@dataclass(frozen=True)
class OnSlide:
    """The lower end of a rod stands at A + q d.

    Attributes
    ----------
    direction : vector of 3 Fraction
    rod_squared : Fraction
    """

    direction: Vector
    rod_squared: Fraction


@dataclass(frozen=True)
class OnCrank:
    """The lower end of a rod stands at A + c u + s v, c^2 + w s^2 = 1, |v|^2 = w |u|^2, u.v = 0.

    Attributes
    ----------
    at_0, at_90 : vector of 3 Fraction
        u and v.
    weight : int
        w.
    rod_squared : Fraction
    """

    at_0: Vector
    at_90: Vector
    weight: int
    rod_squared: Fraction


@dataclass(frozen=True)
class OnHinge:
    """The leg's direction is actuated: its platform joint lies in a plane that turns, n.(C + R B) = o.

    Attributes
    ----------
    normals : tuple of 2 vectors
        n = c normals[0] + s normals[1].
    offsets : tuple of 2 Fraction
        o = c offsets[0] + s offsets[1].
    """

    normals: tuple[Vector, Vector]
    offsets: tuple[Fraction, Fraction]


Actuator: TypeAlias = OwnLength | OnSlide | OnCrank | OnHinge


@dataclass(frozen=True)
class RegionLeg:
    """A leg, or rod, from A (or what moves A) to the platform joint B.

    Attributes
    ----------
    name : str
    base, platform : vector of 3 Fraction
    actuator : OwnLength, OnSlide or OnCrank
    reach : pair of Fraction or None
        Least and greatest length, position of the slide, or angle of the crank in degrees; None without a limit.
    axis : vector of 3 Fraction or None
        Of a rod that also slides along an axis: what counts is perpendicular to it, and so are slide and crank.
    """

    name: str
    base: Vector
    platform: Vector
    actuator: Actuator
    reach: Pair | None = None
    axis: Vector | None = None


@dataclass(frozen=True)
class RegionMachine:
    """A robot whose joint values follow from its pose.

    Attributes
    ----------
    name, unit, source : str
    metric : tuple of 3 int
    twist : tuple of int
        Components of a twist that the platform is capable of.
    legs : tuple of RegionLeg
    forms : tuple of Form
        Linear forms of joints that are not actuated: they must vanish all over a region.
    base_cones, platform_cones : Cones or None
    position : tuple of pairs
        The box of the limits; empty if there is none.
    leg_distance : Fraction or None
        The least distance of two legs.
    """

    name: str
    unit: str
    source: str
    metric: Metric
    motion: str
    twist: tuple[int, ...]
    legs: tuple[RegionLeg, ...]
    forms: tuple[Form, ...] = ()
    base_cones: Cones | None = None
    platform_cones: Cones | None = None
    position: tuple[Pair, ...] = ()
    leg_distance: Fraction | None = None

    @property
    def is_limited(self) -> bool:
        """Whether it has any limits."""
        own = any(leg.reach is not None for leg in self.legs)
        return own or bool(self.base_cones or self.platform_cones or self.position or self.leg_distance)


def region_machine(machine: Machine) -> RegionMachine:
    """The legs of a robot, with its limits.

    Raises
    ------
    InputError
        If joint values do not follow from the pose leg by leg, or a limit is not of a sort that regions know.
    """
    limits = machine.limits or Limits()
    legs, forms = (
        _mechanism_legs(machine, limits)
        if isinstance(machine, Mechanism)
        else (
            _robot_legs(jointed(machine, "region"), limits),
            (),
        )
    )
    return RegionMachine(
        machine.name,
        machine.unit,
        machine.source,
        machine.metric,
        machine.motion.name,
        machine.motion.twist,
        legs,
        forms,
        limits.base_cones,
        limits.platform_cones,
        limits.position,
        limits.leg_distance,
    )


def _robot_legs(robot: Robot, limits: Limits) -> tuple[RegionLeg, ...]:
    pairs: tuple[Pair | None, ...] = (
        limits.lengths or limits.slides or limits.angles or (None,) * len(robot.base_joints)
    )
    chains: tuple[Any, ...] = robot.chains or (None,) * len(pairs)
    found = []
    rows = zip(robot.base_joints, robot.platform_joints, chains, pairs, strict=True)
    for number, (base, platform, chain, pair) in enumerate(rows, 1):
        actuator: Actuator = OwnLength()
        if isinstance(chain, Slide):
            actuator = OnSlide(chain.direction, chain.rod_squared)
        elif isinstance(chain, Crank):
            actuator = OnCrank(chain.at_0, chain.at_90, 1, chain.rod_squared)
        found.append(RegionLeg(f"leg {number}", base, platform, actuator, pair))
    return tuple(found)


def _mechanism_legs(mechanism: Mechanism, limits: Limits) -> tuple[tuple[RegionLeg, ...], tuple[Form, ...]]:
    """The legs of a mechanism: distances that are actuated, or whose base point is; all else is structure."""
    moved = {part.constraint: (drive, part) for drive in mechanism.drives for part in drive.parts}
    reach = _reach(mechanism, limits)
    legs, forms = [], []
    for found in mechanism.constraints:
        if isinstance(found, InPlane) and found.name in moved:
            legs.append(_hinged(found, mechanism))
            continue
        if isinstance(found, AxisDistance) and found.name in moved:
            legs.append(_sliding(found, *moved[found.name], reach, mechanism.metric))
            continue
        actuated = found.name in mechanism.actuated
        if not actuated and found.name not in moved:
            if found.squares(mechanism.metric):
                raise InputError(
                    f"constraint {shown(found.name)}: is a quadric, which regions do not know; ask of another robot"
                )
            forms += list(found.forms(mechanism.metric))
            continue
        if not isinstance(found, Distance) or (actuated and found.name in moved):
            raise InputError(
                f"constraint {shown(found.name)}: regions know legs of actuated length, and rods on one slide or "
                "crank; ask of another robot"
            )
        if actuated:
            legs.append(RegionLeg(found.name, found.base, found.platform, OwnLength(), reach.get(found.name)))
            continue
        legs.append(_driven(found, *moved[found.name], reach))
    return tuple(legs), tuple(forms)


def _hinged(found: InPlane, mechanism: Mechanism) -> RegionLeg:
    """A leg whose hinge on the base is driven: both normal and offset turn with it."""
    drives = [drive for drive in mechanism.drives if any(part.constraint == found.name for part in drive.parts)]
    parts: dict[str, Any] = {part.field: part.axes for part in drives[0].parts}
    alone = len(drives) == 1 and drives[0].is_crank and set(parts) == {"normal", "offset"} and len(drives[0].parts) == 2
    if not alone or any(found.normal) or found.offset:
        raise InputError(
            f"constraint {shown(found.name)}: regions know planes that turn with one hinge; ask of another robot"
        )
    if mechanism.limits is not None and mechanism.limits.angles:
        raise InputError("limits.angles: regions do not know this limit of driven hinges; remove it from the model")
    zero = (Fraction(0),) * 3
    return RegionLeg(found.name, zero, found.platform, OnHinge(parts["normal"], parts["offset"]))


def _reach(mechanism: Mechanism, limits: Limits) -> dict[str, Pair]:
    """The limits of the actuators, by their names."""
    found: dict[str, Pair] = {}
    for sort in ("lengths", "slides", "angles"):
        names = [name for name in mechanism.actuated if mechanism.sort_of(name) == sort]
        pairs: tuple[Pair, ...] = getattr(limits, sort)
        found |= dict(zip(names, pairs, strict=bool(pairs)))
    return found


def _sliding(found: AxisDistance, drive: Drive, part: Part, reach: dict[str, Pair], metric: Metric) -> RegionLeg:
    """A rod at a distance from an axis that a crank or slide moves, perpendicular to the axis."""
    across = all(product(metric, axis, found.direction) == 0 for axis in part.axes)
    if part.field != "point" or len(drive.parts) != 1 or not across:
        raise InputError(f"{shown(drive.name)}: moves more than the axis of one rod, across it; ask of another robot")
    axes: Any = part.axes
    actuator: Actuator = OnSlide(axes[0], found.radius_squared)
    if drive.is_crank:
        actuator = OnCrank(axes[0], axes[1], drive.weight, found.radius_squared)
    return RegionLeg(found.name, found.point, found.platform, actuator, reach.get(drive.name), found.direction)


def product(metric: Metric, left: Any, right: Any) -> Any:
    """That of two vectors in the metric."""
    g = metric
    return g[0] * left[0] * right[0] + g[1] * left[1] * right[1] + g[2] * left[2] * right[2]


def _driven(found: Distance, drive: Drive, part: Part, reach: dict[str, Pair]) -> RegionLeg:
    if part.field != "base" or len(drive.parts) != 1:
        raise InputError(f"{shown(drive.name)}: moves more than the base point of one rod; ask of another robot")
    axes: Any = part.axes
    actuator: Actuator = OnSlide(axes[0], found.length_squared)
    if drive.is_crank:
        actuator = OnCrank(axes[0], axes[1], drive.weight, found.length_squared)
    return RegionLeg(found.name, found.base, found.platform, actuator, reach.get(drive.name))

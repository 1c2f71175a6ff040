"""Mechanisms of bodies and joints in one configuration: serial chains, trees and any number of closed loops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.joint_types import JOINT_TYPES, JointGeometry, SixCoordinates
from pkm_exact.geometry.kind_names import CHAINS_KIND
from pkm_exact.wording import shown

MOST_BODIES: Final = 64
MOST_FREEDOMS: Final = 128
"""Bounds what a model file asks for."""


@dataclass(frozen=True)
class Joint:
    """A joint between two bodies.

    Attributes
    ----------
    name, type : str
        ``type`` is a key of ``JOINT_TYPES``.
    bodies : tuple of 2 str
        The joint's motion is that of the second body relative to the first.
    geometry : JointGeometry
    actuated : tuple of int
        Which of its one-freedom joints are actuated, counted from 1.
    """

    name: str
    type: str
    bodies: tuple[str, str]
    geometry: JointGeometry
    actuated: tuple[int, ...] = ()

    @property
    def twists(self) -> tuple[SixCoordinates, ...]:
        """Of its one-freedom joints, in their order."""
        return JOINT_TYPES[self.type].twists(self.geometry)

    @property
    def freedoms(self) -> tuple[str, ...]:
        """How its freedoms are called: as the joint, or joint.1, joint.2, .. if there are several."""
        count = len(self.twists)
        return (self.name,) if count == 1 else tuple(f"{self.name}.{k}" for k in range(1, count + 1))


@dataclass(frozen=True)
class Linkage:
    """A mechanism of bodies and joints.

    Attributes
    ----------
    name, unit, source : str
        Its name, the unit of length, and where the numbers come from.
    bodies : tuple of str
    joints : tuple of Joint
    base, platform : str
        The body that stands still, and the one that is asked about.

    Examples
    --------
    >>> from fractions import Fraction
    >>> x = (Fraction(1), Fraction(0), Fraction(0))
    >>> rail = Joint("rail", "P", ("ground", "slide"), JointGeometry(axes=(x,)), (1,))
    >>> Linkage("slide", "mm", "an example", ("ground", "slide"), (rail,), "ground", "slide").freedoms
    ('rail',)
    """

    name: str
    unit: str
    source: str
    bodies: tuple[str, ...]
    joints: tuple[Joint, ...]
    base: str
    platform: str
    kind: str = CHAINS_KIND

    def __post_init__(self) -> None:
        if not 2 <= len(self.bodies) <= MOST_BODIES:
            raise InputError(f"bodies: {len(self.bodies)} given; give 2 to {MOST_BODIES}")
        _refuse_equal("bodies", self.bodies)
        _refuse_equal("joints", [name for joint in self.joints for name in {joint.name, *joint.freedoms}])
        if len(self.freedoms) > MOST_FREEDOMS:
            raise InputError(f"joints: {len(self.freedoms)} freedoms in all; at most {MOST_FREEDOMS} are possible")
        for key, name in (("base", self.base), ("platform", self.platform)):
            if name not in self.bodies:
                raise InputError(f"{key}: {shown(name)} is not the name of a body; use one that is")
        if self.base == self.platform:
            raise InputError(f"platform: {shown(self.platform)} is the base too; name another body")
        for i, joint in enumerate(self.joints, 1):
            self._require_joint(joint, f"joints[{i}] ({shown(joint.name)})")
        self._require_connected()

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Names of all one-freedom joints, in order."""
        return tuple(name for joint in self.joints for name in joint.freedoms)

    @property
    def actuated(self) -> tuple[str, ...]:
        """Names of the actuated ones."""
        return tuple(joint.freedoms[k - 1] for joint in self.joints for k in joint.actuated)

    def _require_joint(self, joint: Joint, where: str) -> None:
        for body in joint.bodies:
            if body not in self.bodies:
                raise InputError(f"{where}.bodies: {shown(body)} is not the name of a body; use one that is")
        if joint.bodies[0] == joint.bodies[1]:
            raise InputError(f"{where}.bodies: {shown(joint.bodies[0])} twice; name two bodies")
        if joint.actuated and not 1 <= min(joint.actuated) <= max(joint.actuated) <= len(joint.twists):
            raise InputError(f"{where}.actuated: a freedom that the joint has not; it has {len(joint.twists)}")

    def _require_connected(self) -> None:
        """Refuse a body that no chain of joints connects with the base."""
        reached, added = {self.base}, True
        while added:
            new = {body for joint in self.joints if reached & set(joint.bodies) for body in joint.bodies} - reached
            reached, added = reached | new, bool(new)
        for body in self.bodies:
            if body not in reached:
                raise InputError(f"bodies: no chain of joints connects {shown(body)} with {shown(self.base)}; add one")


def _refuse_equal(where: str, names: Sequence[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise InputError(f"{where}: the name {shown(name)} is used twice; rename one of them")
        seen.add(name)

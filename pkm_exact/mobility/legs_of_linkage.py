"""The legs of a parallel mechanism: what connects base and platform without the rest, and what each leg forbids.

Without base and platform the bodies fall into parts; a part with its joints is a leg if it touches both, and a joint
between base and platform is one by itself. Once the platform's twist is given, legs move independently: the platform
has those twists that every leg allows, and a wrench that no leg allows it to give way to is a common constraint.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import reduce

from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.mobility.instantaneous_mobility import Instantaneous, instantaneous
from pkm_exact.screws.screw_system import ScrewSystem


@dataclass(frozen=True)
class Leg:
    """A leg by itself.

    Attributes
    ----------
    number : int
        Legs are counted from 1, in the order of their first joints.
    linkage : Linkage
        Base, platform and what is between them.
    twists : ScrewSystem
        What the platform could do if it had no other leg.
    freedoms : int
        Of the leg by itself.
    """

    number: int
    linkage: Linkage
    twists: ScrewSystem
    freedoms: int

    @property
    def constraints(self) -> ScrewSystem:
        """The wrenches that it transmits whatever its joints do."""
        return self.twists.reciprocal()


def legs_of(linkage: Linkage, locked: Collection[str] = ()) -> tuple[Leg, ...]:
    """The legs of a mechanism.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> legs = legs_of(read_linkage("models/chains/3-pprr.toml"))
    >>> [(leg.freedoms, leg.twists.rank) for leg in legs]
    [(4, 3), (4, 3), (4, 3)]
    """
    found: list[Leg] = []
    for joints in _parts(linkage):
        touched = {body for joint in joints for body in joint.bodies}
        if not {linkage.base, linkage.platform} <= touched:
            continue
        bodies = tuple(body for body in linkage.bodies if body in touched)
        leg = replace(linkage, bodies=bodies, joints=tuple(joints))
        alone = instantaneous(leg, locked)
        found.append(Leg(len(found) + 1, leg, alone.platform, alone.total))
    return tuple(found)


def common_constraints(legs: Collection[Leg]) -> ScrewSystem:
    """The wrenches that every leg transmits.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> found = common_constraints(legs_of(read_linkage("models/chains/5-rrr-rr.toml")))
    >>> print(found.constraints())
    1 force along (0, 0, 1) through (0, 0, 0)
    """
    return reduce(lambda one, other: one | other, (leg.twists for leg in legs), ScrewSystem(())).reciprocal()


def counted_with_common(found: Instantaneous, common: ScrewSystem) -> int:
    """The count of freedoms with d = 6 less the number of common constraints in place of 6."""
    linkage = found.linkage
    free = len(linkage.freedoms) - len(found.locked)
    return (6 - common.rank) * (len(linkage.bodies) - 1 - len(linkage.joints)) + free


def _parts(linkage: Linkage) -> list[list[Joint]]:
    """The joints of each part into which the bodies fall without base and platform, in the order of the joints."""
    ends = {linkage.base, linkage.platform}
    part = {body: body for body in linkage.bodies if body not in ends}
    for joint in linkage.joints:
        inner = [body for body in joint.bodies if body not in ends]
        if len(inner) == 2:
            one, other = (part[body] for body in inner)
            part = {body: one if where == other else where for body, where in part.items()}
    joints: dict[str, list[Joint]] = {}
    for joint in linkage.joints:
        inner = [body for body in joint.bodies if body not in ends]
        # "" and the joint's name cannot be those of bodies in a part.
        joints.setdefault(part[inner[0]] if inner else f"\0{joint.name}", []).append(joint)
    return list(joints.values())

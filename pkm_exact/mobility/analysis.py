"""All that is asked of the mobility of a mechanism of bodies and joints, in one answer."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from pkm_exact.errors import InputError
from pkm_exact.geometry.linkage import Linkage
from pkm_exact.mobility.actuation import (
    Actuation,
    ActuatorSets,
    actuation,
    sets_that_hold_the_mechanism,
    sets_that_hold_the_platform,
)
from pkm_exact.mobility.finite_mobility import Finite, finite
from pkm_exact.mobility.instantaneous_mobility import Instantaneous, instantaneous
from pkm_exact.mobility.legs_of_linkage import Leg, common_constraints, counted_with_common, legs_of
from pkm_exact.screws.screw_system import ScrewSystem
from pkm_exact.wording import shown


@dataclass(frozen=True)
class LinkageMobility:
    """How a mechanism can move in its configuration.

    Attributes
    ----------
    free : Instantaneous
        With all actuators free.
    locked : Instantaneous
        With the actuators locked.
    finite : Finite
        What is proved beyond the first order, with all actuators free.
    legs : tuple of Leg
    common : ScrewSystem
        Wrenches that all legs transmit.
    counted_with_common : int
        Gruebler's count with d = 6 less the number of these.
    actuation : Actuation
        What the actuators do.
    hold_platform, hold_mechanism : ActuatorSets
        All minimal sets of freedoms that hold the platform, and the whole mechanism, when they are locked.

    Examples
    --------
    >>> from pkm_exact import mobility_of, read_linkage
    >>> found = mobility_of(read_linkage("models/chains/sarrus.toml"))
    >>> found.free.total, found.finite.least, found.free.counted
    (1, 1, 0)
    """

    free: Instantaneous
    locked: Instantaneous
    finite: Finite
    legs: tuple[Leg, ...]
    common: ScrewSystem
    counted_with_common: int
    actuation: Actuation
    among: tuple[str, ...]
    hold_platform: ActuatorSets
    hold_mechanism: ActuatorSets

    @property
    def linkage(self) -> Linkage:
        """The mechanism."""
        return self.free.linkage


def mobility_of(
    linkage: Linkage, actuated: Collection[str] | None = None, among: Collection[str] | None = None
) -> LinkageMobility:
    """How a mechanism of bodies and joints can move: exact ranks, freedoms in words, and which actuators hold it.

    Parameters
    ----------
    linkage : Linkage
    actuated : collection of str, optional
        Names of joints or of freedoms that are actuated; those of the model by default.
    among : collection of str, optional
        Of which joints or freedoms minimal sets are looked for; of all by default.

    Raises
    ------
    InputError
        If a name is not that of a joint or of a freedom.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> found = mobility_of(read_linkage("models/chains/seven-link.toml"))
    >>> found.free.total, str(found.free.platform.free_motions()), found.locked.platform.rank
    (2, '1 translation along (0, 0, 1)', 0)
    """
    names = linkage.actuated if actuated is None else freedoms_named(linkage, actuated, "actuated")
    lockable = linkage.freedoms if among is None else freedoms_named(linkage, among, "among")
    free, legs = instantaneous(linkage), legs_of(linkage)
    common = common_constraints(legs)
    return LinkageMobility(
        free,
        instantaneous(linkage, names),
        finite(free),
        legs,
        common,
        counted_with_common(free, common),
        actuation(free, names),
        lockable,
        sets_that_hold_the_platform(free, lockable),
        sets_that_hold_the_mechanism(free, lockable),
    )


def freedoms_named(linkage: Linkage, names: Collection[str], where: str) -> tuple[str, ...]:
    """The freedoms that names of joints and freedoms mean, in the order of the mechanism.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> freedoms_named(read_linkage("models/chains/3-upu.toml"), ["P2", "U1"], "actuated")
    ('U1.1', 'U1.2', 'P2')
    """
    meant: set[str] = set()
    of_joints = {joint.name: joint.freedoms for joint in linkage.joints}
    for name in names:
        if name not in of_joints and name not in linkage.freedoms:
            known = ", ".join(of_joints)
            raise InputError(f"{where}: {shown(name)} is not the name of a joint or of a freedom; use some of: {known}")
        meant |= set(of_joints.get(name, (name,)))
    return tuple(name for name in linkage.freedoms if name in meant)

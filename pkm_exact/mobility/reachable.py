"""Where a leg can take the platform: a group of motions, or a product of two, if the leg reaches all of it nearby.

The joints of a leg in their order generate a group; cut in two, two groups G and H, and the leg takes the platform to
poses in G H, a manifold whose tangent space is the sum of the two algebras. If the leg's twists fill that space, the
leg reaches a neighbourhood in the manifold, by a submersion.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import reduce

from pkm_exact.geometry.linkage import Linkage
from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.mobility.legs_of_linkage import Leg, legs_of
from pkm_exact.mobility.loops import find_loops
from pkm_exact.screws.screw import Screw
from pkm_exact.screws.screw_system import ScrewSystem


@dataclass(frozen=True)
class Reachable:
    """A product of groups that a leg fills near the configuration.

    Attributes
    ----------
    factors : tuple of ScrewSystem
        The algebra of the group, or of the two groups from the base to the platform.
    cut : int
        How many one-freedom joints, from the base, belong to the first group; 0 if there is one group.
    """

    factors: tuple[ScrewSystem, ...]
    cut: int = 0

    @property
    def tangent(self) -> ScrewSystem:
        """The sum of the algebras."""
        return reduce(lambda one, other: one | other, self.factors)


def reachable(leg: Leg, locked: frozenset[str]) -> Reachable | None:
    """The product of groups that a leg fills; None if it is no serial chain, or fills none.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> leg = legs_of(read_linkage("models/chains/5-rrr-rr.toml"))[0]
    >>> [factor.rank for factor in reachable(leg, frozenset()).factors]
    [3, 3]
    """
    if not _is_serial(leg.linkage):
        return None
    loops, names = find_loops(leg.linkage), leg.linkage.freedoms
    along = [Screw.from_coordinates(loops.twists[k]) for k, _ in loops.to_platform if names[k] not in locked]
    for cut in range(len(along)):
        parts = [part for part in (along[:cut], along[cut:]) if part]
        found = Reachable(tuple(ScrewSystem.span(part).algebra() for part in parts), cut)
        if found.tangent.rank == leg.twists.rank:
            return found
    return Reachable((ScrewSystem(()),)) if not along else None


def legs_are_transversal(found: Instantaneous) -> bool:
    """Whether all joints are in serial legs that fill such manifolds, and these are transversal to each other."""
    legs = legs_of(found.linkage, found.locked)
    if sum(len(leg.linkage.joints) for leg in legs) != len(found.linkage.joints):
        return False
    filled = [reachable(leg, frozenset(found.locked)) for leg in legs]
    groups: list[Reachable] = []
    products: list[Reachable] = []
    for manifold in filled:
        if manifold is None:
            return False
        (groups if len(manifold.factors) == 1 else products).append(manifold)
    distinct = list(dict.fromkeys(product.factors for product in products))
    tangents = [reduce(lambda one, other: one | other, factors) for factors in distinct]
    if groups:
        common = reduce(lambda one, other: one & other, [group.tangent for group in groups])
        # A group within a factor of a product is within the product.
        kept = [not any(common <= factor for factor in factors) for factors in distinct]
        tangents = [tangent for tangent, stays in zip(tangents, kept, strict=True) if stays] + [common]
    codimension = sum(6 - tangent.rank for tangent in tangents)
    together = reduce(lambda one, other: one & other, tangents)
    return 6 - together.rank == codimension


def _is_serial(linkage: Linkage) -> bool:
    """Whether the joints form one chain from the base to the platform."""
    ends = {linkage.base, linkage.platform}
    degrees = {body: sum(body in joint.bodies for joint in linkage.joints) for body in linkage.bodies}
    return all(degree == (1 if body in ends else 2) for body, degree in degrees.items())

"""Mobility certificates of version 2: bounds of the finite mobility that need the second order."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from pkm_exact.geometry.linkage import Linkage
    from pkm_exact.mobility.analysis import LinkageMobility
    from pkm_exact.mobility.second_order_proof import SecondOrderProof

FORMAT: Final = "pkm_exact mobility certificate"
VERSION: Final = 2


def finite_entry(found: LinkageMobility, proof: SecondOrderProof) -> dict[str, Any]:
    """The entry ``finite`` of version 2.

    Examples
    --------
    >>> from pkm_exact import mobility_of, read_linkage
    >>> from pkm_exact.mobility.second_order_proof import second_order_proof
    >>> found = mobility_of(read_linkage("models/chains/seven-link-oblique.toml"))
    >>> entry = finite_entry(found, second_order_proof(found.free, found.finite))
    >>> entry["least"], entry["most"], entry["above"]["argument"], entry["below"]["locked"]
    (1, 1, 'cone', ['G'])
    """
    finite = found.finite
    below = None
    if proof.below is not None:
        below = {
            "argument": proof.below,
            "locked": list(finite.locked),
            "legs": legs_entry(found.linkage, finite.locked) if proof.below == "subgroups" else [],
            "vectors": [list(map(str, row)) for row in proof.signs],
            "curve": [[list(map(str, part)) for part in pair] for pair in proof.curve],
        }
    return {
        "argument": "second-order" if proof.is_of_second_order else "higher-order",
        "least": finite.least,
        "most": finite.most,
        "platform_least": finite.platform_least,
        "platform_most": min(finite.most, 6),
        "dependencies": [list(map(str, row)) for row in proof.dependencies],
        "above": {
            "argument": proof.above,
            "section": [list(map(str, row)) for row in proof.section],
            "degree": proof.degree,
            "series": [list(map(str, row)) for row in proof.series],
        },
        "below": below,
    }


def legs_entry(linkage: Linkage, locked: Collection[str] = ()) -> list[dict[str, Any]]:
    """The legs with their cuts, for the argument "subgroups"."""
    from pkm_exact.mobility.legs_of_linkage import legs_of
    from pkm_exact.mobility.reachable import reachable

    legs = []
    for leg in legs_of(linkage, locked):
        filled = reachable(leg, frozenset(locked))
        legs.append({"joints": _in_order(leg.linkage), "cut": filled.cut if filled else 0})
    return legs


def _in_order(leg: Linkage) -> list[str]:
    """The joints of a serial leg from the base to the platform."""
    body, names = leg.base, []
    left = list(leg.joints)
    while left:
        joint = next(joint for joint in left if body in joint.bodies)
        left.remove(joint)
        names.append(joint.name)
        body = joint.bodies[1] if joint.bodies[0] == body else joint.bodies[0]
    return names

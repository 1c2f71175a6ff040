"""Mobility certificates: ranks by minors and null spaces, for the checkers (``docs/certificates-mobility.md``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import sealed
from pkm_exact.geometry.joint_types import JOINT_TYPES

if TYPE_CHECKING:
    from pkm_exact.geometry.linkage import Joint, Linkage
    from pkm_exact.mobility.actuation import ActuatorSets
    from pkm_exact.mobility.analysis import LinkageMobility
    from pkm_exact.mobility.instantaneous_mobility import Instantaneous
    from pkm_exact.screws.exact_matrix import Row

FORMAT: Final = "pkm_exact mobility certificate"
VERSION: Final = 1
MOST_OF_SOME: Final = 100
"""Sets of actuators in a certificate whose list is not called complete."""


def mobility_certificate(found: LinkageMobility) -> dict[str, Any]:
    """The certificate of the mobility of a mechanism, as a JSON object with its digest.

    Examples
    --------
    >>> from pkm_exact import check_bytes, mobility_of, read_linkage
    >>> from pkm_exact.certify.build import canonical_bytes
    >>> content = mobility_certificate(mobility_of(read_linkage("models/chains/sarrus.toml")))
    >>> check_bytes(canonical_bytes(content)).lines[1]
    'loops: rank 5 of 6 equations in 6 freedoms, mobility 1'
    """
    free, locked = found.free, found.locked
    size = len(found.linkage.freedoms)
    units = [
        tuple(Fraction(int(name == other)) for other in found.linkage.freedoms) for name in found.actuation.actuated
    ]
    matrix = free.loops.matrix
    version, finite = _finite(found)
    return sealed(
        {
            "format": FORMAT,
            "version": version,
            "mechanism": _mechanism(found.linkage),
            "actuated": list(found.actuation.actuated),
            "loops": rank_proof(matrix, size),
            "platform": rank_proof(_twists(free), free.total),
            "locked_loops": rank_proof([*matrix, *units], size),
            "locked_platform": rank_proof(_twists(locked), locked.total),
            "mobility": {
                "free": free.total,
                "platform": free.platform.rank,
                "gruebler_kutzbach": free.counted,
                "overconstraint": free.overconstraint,
                "locked": locked.total,
                "locked_platform": locked.platform.rank,
            },
            "actuator_sets": {
                "among": list(found.among),
                "platform": listed_sets(found.hold_platform, found.linkage),
                "mechanism": listed_sets(found.hold_mechanism, found.linkage),
            },
            "finite": finite,
        }
    )


def rank_proof(rows: Sequence[Row], columns: int) -> dict[str, Any]:
    """A minor that is not 0, and a basis of the null space.

    Examples
    --------
    >>> rank_proof([(Fraction(1), Fraction(2)), (Fraction(2), Fraction(4))], 2)
    {'rank': 1, 'rows': [0], 'columns': [0], 'null_space': [['-2', '1']]}
    """
    from pkm_exact.screws.exact_matrix import echelon, null_space

    _, pivots = echelon(rows, columns)
    _, independent = echelon([[row[k] for row in rows] for k in pivots], len(rows))
    return {
        "rank": len(pivots),
        "rows": list(independent),
        "columns": list(pivots),
        "null_space": [list(map(str, x)) for x in null_space(rows, columns)],
    }


def _twists(found: Instantaneous) -> list[Row]:
    """The six coordinates of the platform's twist in the motions."""
    from pkm_exact.mobility.instantaneous_mobility import images

    return [tuple(row) for row in zip(*images(found.speeds, found.loops.platform), strict=True)] or [()] * 6


def _mechanism(linkage: Linkage) -> dict[str, Any]:
    return {
        "name": linkage.name,
        "unit": linkage.unit,
        "source": linkage.source,
        "base": linkage.base,
        "platform": linkage.platform,
        "bodies": list(linkage.bodies),
        "joints": [_joint(joint) for joint in linkage.joints],
    }


def _joint(joint: Joint) -> dict[str, Any]:
    geometry, fields = joint.geometry, JOINT_TYPES[joint.type].fields
    return {
        "name": joint.name,
        "type": joint.type,
        "bodies": list(joint.bodies),
        "point": _texts(geometry.point) if "point" in fields else ["0"] * 3,
        "axes": [_texts(axis) for axis in geometry.axes],
        "pitch": str(geometry.pitch) if "pitch" in fields else "0",
        "screws": [_texts(screw) for screw in geometry.screws],
    }


def certified_linkage(content: Mapping[str, Any]) -> Linkage:
    """The mechanism of an accepted certificate.

    Examples
    --------
    >>> from pkm_exact import mobility_of, read_linkage
    >>> linkage = read_linkage("models/chains/sarrus.toml")
    >>> found = certified_linkage(mobility_certificate(mobility_of(linkage)))
    >>> [joint.twists for joint in found.joints] == [joint.twists for joint in linkage.joints]
    True
    """
    from pkm_exact.geometry.joint_types import JointGeometry
    from pkm_exact.geometry.linkage import Joint, Linkage

    found = content["mechanism"]

    def vector(entry: Sequence[str]) -> Any:
        return tuple(map(Fraction, entry))

    joints = tuple(
        Joint(
            joint["name"],
            joint["type"],
            (joint["bodies"][0], joint["bodies"][1]),
            JointGeometry(
                vector(joint["point"]),
                tuple(map(vector, joint["axes"])),
                Fraction(joint["pitch"]),
                tuple(map(vector, joint["screws"])),
            ),
        )
        for joint in found["joints"]
    )
    name, unit, source, base, platform = (found[key] for key in ("name", "unit", "source", "base", "platform"))
    return Linkage(name, unit, source, tuple(found["bodies"]), joints, base, platform)


def _texts(values: Sequence[Fraction]) -> list[str]:
    return [str(value) for value in values]


def listed_sets(sets: ActuatorSets, linkage: Linkage) -> dict[str, Any]:
    """Sets of actuators as certificates have them: all of a complete list, or some."""
    places = {name: place for place, name in enumerate(linkage.freedoms)}
    ordered = sorted(sets.sets, key=lambda names: (len(names), [places[name] for name in names]))
    if not sets.is_complete:  # nothing is said of the others anyway
        ordered = ordered[:MOST_OF_SOME]
    return {"complete": sets.is_complete, "sets": [list(names) for names in ordered]}


def _finite(found: LinkageMobility) -> tuple[int, dict[str, Any] | None]:
    """The version that has the words for it, and the argument for the finite mobility."""
    from pkm_exact.certify import mobility_second_build, mobility_third_build
    from pkm_exact.mobility.finite_mobility import Argument
    from pkm_exact.mobility.second_order_proof import second_order_proof

    argument = found.finite.argument
    if argument is Argument.REGULAR:
        return VERSION, {"argument": str(argument), "legs": []}
    if argument is Argument.SUBGROUPS:
        return VERSION, {"argument": str(argument), "legs": mobility_second_build.legs_entry(found.linkage)}
    proof = second_order_proof(found.free, found.finite)
    if proof is None:
        return VERSION, None
    if proof.is_of_the_ideal:
        return mobility_third_build.VERSION, mobility_third_build.finite_entry(found, proof)
    return mobility_second_build.VERSION, mobility_second_build.finite_entry(found, proof)

"""The mobility of a mechanism of bodies and joints, as text or as a JSON object."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

from pkm_exact.mobility.actuation import ActuatorSets
from pkm_exact.mobility.analysis import LinkageMobility
from pkm_exact.mobility.finite_mobility import Finite
from pkm_exact.mobility.instantaneous_mobility import Instantaneous
from pkm_exact.mobility.legs_of_linkage import Leg
from pkm_exact.screws.free_motions import FreeMotions
from pkm_exact.screws.screw_system import ScrewSystem
from pkm_exact.wording import counted, printable

SHOWN_SETS: Final = 12
"""Sets of actuators in the text; the JSON object has all that were listed."""
_WIDTH: Final = 24


def linkage_text(found: LinkageMobility) -> str:
    """The answer in words."""
    return "\n".join(_lines(found)) + "\n"


def _lines(found: LinkageMobility) -> Iterator[str]:
    linkage, free = found.linkage, found.free
    equations = 6 * len(free.loops.loops)
    parts = (
        counted(len(linkage.bodies), "body").replace("bodys", "bodies"),
        counted(len(linkage.joints), "joint"),
        counted(len(linkage.freedoms), "freedom"),
        counted(len(free.loops.loops), "loop"),
    )
    yield f"{printable(linkage.name)} (chains, lengths in {printable(linkage.unit)}): {', '.join(parts)}"
    yield _row("instantaneous mobility", f"{free.total}: the {equations} equations of the loops have rank {free.rank}")
    yield _row("Gruebler and Kutzbach", f"{free.counted}: {_overconstraint(free)}")
    if found.common.rank:
        yield _row("with d = " + str(6 - found.common.rank), str(found.counted_with_common))
    yield _row("finite mobility", finite_text(found.finite))
    yield _row(f"platform {printable(linkage.platform)}", f"{free.platform.rank}: {free.platform.free_motions()}")
    if free.still:
        yield _row("never moving", ", ".join(map(printable, free.still)))
    for names in free.passive:
        yield _row("passive freedom", f"{_listed(names)} move, the platform does not")
    for leg in found.legs:
        joints = " ".join(printable(joint.name) for joint in leg.linkage.joints)
        motion = f"{counted(leg.freedoms, 'freedom')}, platform {leg.twists.rank}"
        yield _row(f"leg {leg.number}", f"{joints}: {motion}; transmits {leg.constraints.constraints()}")
    yield _row("common to all legs", str(found.common.constraints()))
    yield from _actuators(found)


def _actuators(found: LinkageMobility) -> Iterator[str]:
    done = found.actuation
    if done.actuated:
        yield _row("actuated", f"{_listed(done.actuated)}: degree {done.degree}, redundancy {done.redundancy}")
        left = f"mobility {done.left}, platform {done.left_of_platform}: {found.locked.platform.free_motions()}"
        yield _row("  locked", left)
    for what, sets in (("holding the platform", found.hold_platform), ("holding all", found.hold_mechanism)):
        yield _row(what, _sets_text(sets))


def _sets_text(sets: ActuatorSets) -> str:
    if not sets.sets:
        return "no set of these joints" if sets.is_complete else "none found, not all were looked at"
    if sets.sets == ((),):
        return "nothing is needed"
    listed = ", ".join(f"{{{_listed(names)}}}" for names in sets.sets[:SHOWN_SETS])
    more = ", .." if len(sets.sets) > SHOWN_SETS or not sets.is_complete else ""
    number = f"{len(sets.sets)} minimal sets" if len(sets.sets) > 1 else "1 minimal set"
    return f"{number if sets.is_complete else f'at least {number}, not all were looked at'}: {listed}{more}"


def _overconstraint(free: Instantaneous) -> str:
    if not free.overconstraint:
        return "no equation follows from the others"
    follow = "equation follows" if free.overconstraint == 1 else "equations follow"
    return f"{free.overconstraint} {follow} from the others"


def finite_text(found: Finite) -> str:
    """The finite mobility, or its bounds, and why."""
    platform = _between(found.platform_least, found.platform_most)
    if not found.is_known:
        return f"not known, {found.least} to {found.most}; the platform's {platform}"
    held = f" and by locking {_listed(found.locked)}" if found.locked else ""
    return f"{found.least}, proved ({found.argument}{held}); the platform's {platform}"


def _between(least: int, most: int) -> str:
    return str(least) if least == most else f"{least} to {most}"


def _row(label: str, text: str) -> str:
    return f"{label:<{_WIDTH}} {text}"


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(map(printable, names))


def linkage_object(found: LinkageMobility) -> dict[str, Any]:
    """The answer as a JSON object."""
    linkage, free, locked = found.linkage, found.free, found.locked
    return {
        "model": {
            "name": linkage.name,
            "kind": linkage.kind,
            "unit": linkage.unit,
            "bodies": list(linkage.bodies),
            "joints": [joint.name for joint in linkage.joints],
            "freedoms": list(linkage.freedoms),
            "base": linkage.base,
            "platform": linkage.platform,
        },
        "loops": [[[linkage.freedoms[index], sign] for index, sign in loop] for loop in free.loops.loops],
        "instantaneous": _instantaneous_object(free),
        "gruebler_kutzbach": free.counted,
        "with_common_constraints": found.counted_with_common,
        "overconstraint": free.overconstraint,
        "finite": _finite_object(found.finite),
        "never_moving": list(free.still),
        "passive": [list(names) for names in free.passive],
        "legs": [_leg_object(leg) for leg in found.legs],
        "common_constraints": system_object(found.common, found.common.constraints()),
        "actuation": {
            "actuated": list(found.actuation.actuated),
            "degree": found.actuation.degree,
            "redundancy": found.actuation.redundancy,
            "locked": _instantaneous_object(locked),
        },
        "actuator_sets": {
            "platform": _sets_object(found.hold_platform),
            "mechanism": _sets_object(found.hold_mechanism),
        },
    }


def _instantaneous_object(found: Instantaneous) -> dict[str, Any]:
    return {
        "mobility": found.total,
        "rank": found.rank,
        "speeds": [list(map(str, row)) for row in found.speeds],
        "platform": system_object(found.platform, found.platform.free_motions()),
    }


def system_object(system: ScrewSystem, sorted_out: FreeMotions) -> dict[str, Any]:
    """A screw system as a JSON object: its rank, in words, and a basis (s; s0)."""
    return {
        "number": system.rank,
        "words": str(sorted_out),
        "translations": [list(map(str, vector)) for vector in sorted_out.translations],
        "turns": [
            {"axis": list(map(str, screw.direction)), "moment": list(map(str, screw.moment))}
            for screw in sorted_out.turns
        ],
        "basis": [list(map(str, row)) for row in system.basis],
    }


def _finite_object(found: Finite) -> dict[str, Any]:
    return {
        "mobility": found.least if found.is_known else None,
        "least": found.least,
        "most": found.most,
        "argument": str(found.argument),
        "locked": list(found.locked),
        "platform": {"least": found.platform_least, "most": found.platform_most},
    }


def _leg_object(leg: Leg) -> dict[str, Any]:
    return {
        "joints": [joint.name for joint in leg.linkage.joints],
        "freedoms": leg.freedoms,
        "platform": system_object(leg.twists, leg.twists.free_motions()),
        "constraints": system_object(leg.constraints, leg.constraints.constraints()),
    }


def _sets_object(sets: ActuatorSets) -> dict[str, Any]:
    return {"complete": sets.is_complete, "sets": [list(names) for names in sets.sets]}

"""The freedoms of a platform at a pose and at every pose, as text or as a JSON object."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pkm_exact.cli.model_reading import metric_note
from pkm_exact.geometry.machine import Machine
from pkm_exact.mobility.generic_rank import GenericRank, Route
from pkm_exact.mobility.platform_mobility import PlatformMobility, PoseMobility
from pkm_exact.screws.free_motions import FreeMotions, point_text
from pkm_exact.wording import printable


def as_text(robot: Machine, found: PlatformMobility) -> str:
    """The answer in words."""
    return "\n".join(_lines(robot, found)) + "\n"


def _lines(robot: Machine, found: PlatformMobility) -> Iterator[str]:
    yield f"{printable(robot.name)} ({robot.kind}, lengths in {printable(robot.unit)}): {found.motion.title}"
    if metric_note(found.metric):
        yield f"coordinates of the file, in its metric [{', '.join(map(str, found.metric))}]"
    names = ", ".join(map(printable, found.actuated)) or "nothing"
    if found.at is not None:
        at = found.at
        yield f"at the position {point_text(at.position)}"
        yield f"actuators free           {at.free.number}: {at.free}"
        if found.sharing:
            names_of = ", ".join(map(printable, found.sharing))
            yield f"                         or fewer: what the constraints of {names_of} share is left out"
        yield f"locked                   {at.locked.number}: {at.locked}; locked are {names}"
        free = f"{at.structural_rank} with the actuators free"
        yield f"rank                     {at.rank} of {found.motion.dimension}, {free}"
        yield f"                         {verdict(found, at)}"
    yield f"at every pose            {everywhere_text(found)}"


def verdict(found: PlatformMobility, at: PoseMobility) -> str:
    """What the ranks at a pose mean."""
    if not at.locked.number:
        return "the actuators hold the platform"
    everywhere = found.everywhere
    if everywhere is not None and everywhere.route is not Route.NONE and at.rank == everywhere.rank:
        return "the actuators do not hold the platform, here or at any pose"
    if everywhere is not None and at.rank < everywhere.rank:
        return f"singular pose: the rank is {everywhere.rank} at other poses of {found.motion.title}"
    return "the actuators do not hold the platform to the first order"


def everywhere_text(found: PlatformMobility) -> str:
    """The largest rank at any pose, in words."""
    rank = found.everywhere
    if rank is None:
        return "not looked at: a constraint is no linear form, or there is none"
    if rank.route is Route.FULL:
        return f"rank {rank.rank}, the largest possible, at almost every pose of {found.motion.title}"
    if rank.route is Route.NONE:
        return f"rank {rank.rank} was met, a larger one is not excluded"
    text = f"rank {rank.rank} at most, of {rank.most} possible, at every pose of {found.motion.title}: proved by "
    if rank.route is Route.COMBINATION:
        return text + f"one sum of the wrenches that is 0 at all, with factors {point_text(rank.combination)}"
    return text + "an identity of polynomials"


def as_object(robot: Machine, found: PlatformMobility) -> dict[str, Any]:
    """The answer as a JSON object."""
    at, everywhere = found.at, found.everywhere
    return {
        "model": {"name": robot.name, "kind": robot.kind, "unit": robot.unit, "metric": list(map(str, found.metric))},
        "motion": found.motion.name,
        "structural": list(found.structural),
        "actuated": list(found.actuated),
        "sharing": list(found.sharing),
        "pose": None if at is None else _pose_object(found, at),
        "everywhere": None if everywhere is None else _everywhere_object(everywhere),
    }


def _pose_object(found: PlatformMobility, at: PoseMobility) -> dict[str, Any]:
    return {
        "position": list(map(str, at.position)),
        "rotation": [list(map(str, row)) for row in at.rotation],
        "rank": at.rank,
        "structural_rank": at.structural_rank,
        "free": _motions_object(at.free),
        "locked": _motions_object(at.locked),
        "verdict": verdict(found, at),
    }


def _motions_object(found: FreeMotions) -> dict[str, Any]:
    return {
        "number": found.number,
        "words": str(found),
        "translations": [list(map(str, vector)) for vector in found.translations],
        "turns": [list(map(str, screw.coordinates)) for screw in found.turns],
    }


def _everywhere_object(found: GenericRank) -> dict[str, Any]:
    return {
        "rank": found.rank,
        "possible": found.most,
        "route": str(found.route),
        "proved": found.route is not Route.NONE,
        "architecture_singularity": found.is_architecture_singularity,
        "cayley": list(map(str, found.pose[:3])),
        "position": list(map(str, found.pose[3:])),
        "combination": list(map(str, found.combination)),
    }

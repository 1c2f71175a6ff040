"""The content of a certificate of a platform's mobility, read into typed values; nothing in it is believed."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any, Final

from pkm_exact.certify.checker.mechanism_document import read_mechanism
from pkm_exact.certify.checker.mechanism_forms import Mechanism
from pkm_exact.certify.checker.mobility_document import RankProof, read_rank_proof
from pkm_exact.certify.checker.spelling import choice, count, entries, items, rational
from pkm_exact.certify.checker.verdict import malformed

ROUTES: Final = ("full", "combination", "grid", "none")
_KEYS: Final = ("format", "version", "robot", "actuated", "pose", "everywhere")
_EVERYWHERE: Final = ("rank", "position", "rotation", "rows", "columns", "route", "combinations")

Vector = tuple[Fraction, ...]


@dataclass(frozen=True)
class Placed:
    """Position and rotation matrix."""

    position: Vector
    rotation: tuple[Vector, ...]


@dataclass(frozen=True)
class AtPose:
    """What is claimed at a pose."""

    placed: Placed
    free: RankProof
    locked: RankProof


@dataclass(frozen=True)
class Everywhere:
    """What is claimed at every pose: the rank, where it is met, and why it is not greater."""

    placed: Placed
    rows: tuple[int, ...]
    columns: tuple[int, ...]
    route: str
    combinations: tuple[Vector, ...]


@dataclass(frozen=True)
class PlatformDocument:
    """What a certificate of a platform's mobility says."""

    mechanism: Mechanism
    actuated: tuple[int, ...]
    pose: AtPose | None
    everywhere: Everywhere | None


def read_platform(body: dict[str, Any]) -> PlatformDocument:
    """The content of a certificate, or a refusal if it has not the shape of one."""
    _, _, robot, actuated, pose, everywhere = entries(body, "certificate", _KEYS)
    mechanism = read_mechanism(robot)
    locked = items(actuated, "actuated", None, count)
    _require_increasing(locked, "actuated")
    if locked and locked[-1] >= len(mechanism.constraints):
        raise malformed("actuated: no place of a constraint")
    return PlatformDocument(
        mechanism,
        locked,
        None if pose is None else _at_pose(pose),
        None if everywhere is None else _everywhere(everywhere),
    )


def _require_increasing(places: tuple[int, ...], where: str) -> None:
    if not all(a < b for a, b in pairwise(places)):
        raise malformed(f"{where}: not in increasing order")


def _placed(position: Any, rotation: Any, where: str) -> Placed:
    return Placed(
        items(position, f"{where}.position", 3, rational),
        items(rotation, f"{where}.rotation", 3, lambda row, place: items(row, place, 3, rational)),
    )


def _at_pose(value: Any) -> AtPose:
    position, rotation, free, locked = entries(value, "pose", ("position", "rotation", "free", "locked"))
    proofs = read_rank_proof(free, "pose.free"), read_rank_proof(locked, "pose.locked")
    return AtPose(_placed(position, rotation, "pose"), *proofs)


def _everywhere(value: Any) -> Everywhere:
    rank, position, rotation, rows, columns, route, combinations = entries(value, "everywhere", _EVERYWHERE)
    number, found = count(rank, "everywhere.rank"), []
    for key, places in (("rows", rows), ("columns", columns)):
        found.append(items(places, f"everywhere.{key}", number, count))
        _require_increasing(found[-1], f"everywhere.{key}")
    word = choice(route, "everywhere.route", ROUTES)
    vectors = items(combinations, "everywhere.combinations", None, lambda x, place: items(x, place, None, rational))
    if bool(vectors) != (word == "combination"):
        raise malformed("everywhere.combinations: not those of the route")
    return Everywhere(_placed(position, rotation, "everywhere"), found[0], found[1], word, vectors)

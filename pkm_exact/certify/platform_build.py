"""Certificates of a platform's mobility: ranks at a pose and at every pose (``docs/certificates-platform.md``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import sealed
from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.certify.certificate_entries import texts
from pkm_exact.certify.mobility_build import rank_proof

if TYPE_CHECKING:
    from pkm_exact.constraints.constraint import Constraint
    from pkm_exact.mobility.generic_rank import GenericRank
    from pkm_exact.mobility.platform_mobility import PlatformMobility, PoseMobility
    from pkm_exact.screws.exact_matrix import Row

FORMAT: Final = "pkm_exact platform certificate"
VERSION: Final = 1
_ROUTES: Final = {
    "full at a pose": "full",
    "one combination": "combination",
    "polynomial identity": "grid",
    "not known": "none",
}


def platform_certificate(found: PlatformMobility, labels: tuple[str, str, str]) -> dict[str, Any]:
    """The certificate of what holds the platform of a machine with this name, unit and source.

    Examples
    --------
    >>> from pkm_exact import check_bytes, platform_mobility, read_robot
    >>> from pkm_exact.certify.build import canonical_bytes
    >>> robot = read_robot("models/3-rps.toml")
    >>> content = platform_certificate(platform_mobility(robot), (robot.name, robot.unit, robot.source))
    >>> check_bytes(canonical_bytes(content)).lines[-1]
    'everywhere: rank 6, the largest possible, at almost every pose'
    """
    constraints = found.constraints
    if found.at is not None:
        constraints = tuple(
            _with_its_length(c, found, found.at) if k in found.locks else c for k, c in enumerate(constraints)
        )
    name, unit, source = labels
    return sealed(
        {
            "format": FORMAT,
            "version": VERSION,
            "robot": {
                "name": name,
                "unit": unit,
                "source": source,
                "motion": found.motion.name,
                "metric": texts(found.metric),
                "constraints": [constraint_entry(constraint, found.metric) for constraint in constraints],
            },
            "actuated": list(found.locks),
            "pose": None if found.at is None else _pose_entry(found, found.at),
            "everywhere": None if found.everywhere is None else _everywhere_entry(found, found.everywhere),
        }
    )


def _with_its_length(constraint: Constraint, found: PlatformMobility, at: PoseMobility) -> Constraint:
    """A leg that an actuator locks, with the length that it has at the pose."""
    from pkm_exact.constraints.distance import Distance
    from pkm_exact.constraints.form import value_at

    if not isinstance(constraint, Distance):
        return constraint
    (form,) = constraint.forms(found.metric)
    square = constraint.length_squared + Fraction(value_at(form, at.position, at.rotation, found.metric))
    return replace(constraint, length_squared=square) if square > 0 else constraint


def _pose_entry(found: PlatformMobility, at: PoseMobility) -> dict[str, Any]:
    always = [k for k in range(len(found.constraints)) if k not in found.locks]
    width = len(found.motion.twist)
    return {
        "position": texts(at.position),
        "rotation": [texts(row) for row in at.rotation],
        "free": rank_proof(_rows(found, always, at.position, at.rotation), width),
        "locked": rank_proof(_rows(found, range(len(found.constraints)), at.position, at.rotation), width),
    }


def _rows(found: PlatformMobility, places: Sequence[int], position: Any, rotation: Any) -> list[Row]:
    from pkm_exact.mobility.constraint_rows import within, wrench_rows

    rows = (row for k in places for row in wrench_rows(found.constraints[k], found.metric, position, rotation))
    return within(rows, found.motion)


def _everywhere_entry(found: PlatformMobility, rank: GenericRank) -> dict[str, Any]:
    from pkm_exact.geometry.inverse import rotation_of
    from pkm_exact.mobility.generic_rank import placed

    angles, place = placed(rank.pose, found.motion)
    position = tuple(map(Fraction, place))
    e1, e2, e3 = map(Fraction, angles)
    rotation = rotation_of((Fraction(1), e1, e2, e3), found.metric)
    proof = rank_proof(_rows(found, range(len(found.constraints)), position, rotation), len(found.motion.twist))
    return {
        "rank": rank.rank,
        "position": texts(position),
        "rotation": [texts(row) for row in rotation],
        "rows": proof["rows"],
        "columns": proof["columns"],
        "route": _ROUTES[str(rank.route)],
        "combinations": [texts(row) for row in rank.combinations],
    }


def certified_mobility(content: Mapping[str, Any]) -> PlatformMobility:
    """The mobility of the robot of an accepted certificate, found again.

    Examples
    --------
    >>> from pkm_exact import platform_mobility, read_robot
    >>> robot = read_robot("models/3-rps.toml")
    >>> content = platform_certificate(platform_mobility(robot), ("", "m", ""))
    >>> certified_mobility(content).everywhere.rank
    6
    """
    from pkm_exact.certify.certified_machine import certified_constraint
    from pkm_exact.mobility.platform_mobility import mobility_of_constraints
    from pkm_exact.motions.motion_groups import MOTIONS

    robot, pose, at = content["robot"], content["pose"], None
    if pose is not None:
        at = _vector(pose["position"]), tuple(map(_vector, pose["rotation"]))
    constraints = tuple(map(certified_constraint, robot["constraints"]))
    g1, g2, g3 = map(int, robot["metric"])
    names = [constraint.name for constraint in constraints]
    return mobility_of_constraints(constraints, names, content["actuated"], MOTIONS[robot["motion"]], (g1, g2, g3), at)


def _vector(entry: Sequence[str]) -> Any:
    return tuple(map(Fraction, entry))

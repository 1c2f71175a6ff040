"""The robot as a certificate has it, to be solved again or drawn; of both versions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.constraint_types import CONSTRAINTS
from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Robot
from pkm_exact.motions.motion_groups import MOTIONS

_KINDS: Final = {("spatial", 6): "6-UPS", ("planar", 3): "3-RPR"}
_NUMBERS: Final = (Role.NUMBER, Role.POSITIVE)


def certified_machine(content: Mapping[str, Any]) -> Machine:
    """The robot of an accepted certificate: legs without names are a ``Robot``, other constraints a ``Mechanism``."""
    robot = content["robot"]
    if "constraints" not in robot:
        base, platform = (tuple(map(_vector, robot[side])) for side in ("base", "platform"))
        return Robot(robot["name"], robot["kind"], robot["unit"], robot["source"], base, platform, _metric(robot))
    constraints = tuple(map(certified_constraint, robot["constraints"]))
    legs = [found for found in constraints if isinstance(found, Distance) and not found.name]
    kind = _KINDS.get((robot["motion"], len(legs)))
    if kind is None or len(legs) < len(constraints):
        motion, names = MOTIONS[robot["motion"]], (robot["name"], robot["unit"], robot["source"])
        return Mechanism(*names, constraints, motion=motion, metric=_metric(robot))
    base, platform = tuple(leg.base for leg in legs), tuple(leg.platform for leg in legs)
    return Robot(robot["name"], kind, robot["unit"], robot["source"], base, platform, _metric(robot))


def is_of_legs(content: Mapping[str, Any]) -> bool:
    """Whether the robot of a certificate has legs without names only, as many as its motions have freedoms."""
    robot = content["robot"]
    if "constraints" not in robot:
        return True
    legs = [entry for entry in robot["constraints"] if entry["type"] == Distance.type and not entry["name"]]
    return (robot["motion"], len(legs)) in _KINDS and len(legs) == len(robot["constraints"])


def certified_problem(content: Mapping[str, Any]) -> ForwardProblem:
    """The problem that an accepted certificate answers; it may have legs that models may not have."""
    robot = content["robot"]
    if "constraints" in robot:
        return ForwardProblem(
            tuple(map(certified_constraint, robot["constraints"])), _metric(robot), MOTIONS[robot["motion"]]
        )
    joints = zip(*(map(_vector, robot[side]) for side in ("base", "platform")), strict=True)
    squares = certified_squares(content)
    legs = tuple(Distance(a, b, square) for (a, b), square in zip(joints, squares, strict=True))
    return ForwardProblem(legs, _metric(robot), KINDS[robot["kind"]].motion)


def certified_squares(content: Mapping[str, Any]) -> list[Fraction]:
    """The squared lengths of a robot all of whose constraints are legs."""
    if "constraints" in content["robot"]:
        return [Fraction(entry["length_squared"]) for entry in content["robot"]["constraints"]]
    return [Fraction(text) for text in content["configuration"]["lengths_squared"]]


def certified_configuration(content: Mapping[str, Any]) -> str | None:
    """The name of the configuration, if it has one."""
    found = content["configuration"]
    name: str | None = found["name"] if isinstance(found, Mapping) else found
    return name


def certified_constraint(entry: Mapping[str, Any]) -> Constraint:
    """A constraint as a certificate has it."""
    kind: Any = CONSTRAINTS[entry["type"]]
    data: dict[str, Any] = {
        field: Fraction(entry[field]) if role in _NUMBERS else tuple(map(Fraction, entry[field]))
        for field, role in kind.fields.items()
    }
    found: Constraint = kind(**data, name=entry["name"])
    return found


def _metric(robot: Mapping[str, Any]) -> tuple[int, int, int]:
    g1, g2, g3 = map(int, robot["metric"])
    return g1, g2, g3


def _vector(texts: Sequence[str]) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = map(Fraction, texts)
    return x, y, z

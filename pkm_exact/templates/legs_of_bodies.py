"""Six-leg platforms recognised among bodies and joints: UPS and SPS legs, and PUS legs on slides.

A leg is a chain of joints from the base to the platform with one slide and turns on both sides of it, or behind it:

    UPS    turns about axes that meet in A, a slide along the line from A to B, turns about axes that meet in B
    PUS    a slide that carries A, turns about axes that meet in A, turns about axes that meet in B

with two or three turns in A and B each. Where the twists of a chain have rank 6, the leg asks no more of the platform
than the distance of A and B: a 6-UPS or 6-PUS robot. Points in decimals, and turned frames, are met to ``NEARLY``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import sqrt
from typing import TYPE_CHECKING, Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Slide
from pkm_exact.geometry.inverse import cross, rotation_of
from pkm_exact.geometry.nominal_pose import NominalPose
from pkm_exact.geometry.robot import Configuration, Robot
from pkm_exact.screws.exact_matrix import rank, solution
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.geometry.linkage import Joint, Linkage

LEGS: Final = 6
NEARLY: Final = 1e-9
"""How far axes may be from a point, in the unit of length, and a slide's direction from its line, as a sine."""
_UNTURNED: Final = rotation_of((Fraction(1), Fraction(0), Fraction(0), Fraction(0)))


class NoLegsError(InputError):
    """A mechanism is not recognised as one with six legs; the message says why."""


@dataclass(frozen=True)
class _Leg:
    base: Vector
    platform: Vector
    slide: Vector | None
    off: float


def legged_robot(linkage: Linkage, origin: Vector) -> tuple[Robot, float]:
    """The robot with six legs that a mechanism is in its configuration, and how far off its axes are from it at most.

    Parameters
    ----------
    linkage : Linkage
        Its platform is the one that the legs bear.
    origin : vector of 3 Fraction
        Of the platform's frame, whose axes are parallel to those of the base in this configuration.

    Raises
    ------
    NoLegsError
        If it is not one of six legs of one kind.
    """
    legs = [_leg(chain) for chain in _chains(linkage)]
    if len(legs) != LEGS:
        raise NoLegsError(f"it has {len(legs)} chains from base to platform, not {LEGS}")
    slides = [leg.slide for leg in legs if leg.slide is not None]
    if len(slides) not in (0, LEGS):
        raise NoLegsError("some legs stand on slides and others do not")
    platform = tuple(_minus(leg.platform, origin) for leg in legs)
    rods = [_square(_minus(leg.platform, leg.base)) for leg in legs]
    robot = Robot(
        linkage.name,
        "6-PUS" if slides else "6-UPS",
        linkage.unit,
        linkage.source,
        tuple(leg.base for leg in legs),
        platform,
        chains=tuple(Slide(way, rod) for way, rod in zip(slides, rods, strict=True)) if slides else (),
        nominal=NominalPose(origin, _UNTURNED),
    )
    home = robot.lock("home", [Fraction(0)] * LEGS) if slides else Configuration("home", tuple(rods))
    return replace(robot, configurations=(home,)), max(leg.off for leg in legs)


def platform_of_legs(linkage: Linkage) -> str | None:
    """The only body besides the base at which six joints end, if there is one."""
    ends = [body for joint in linkage.joints for body in joint.bodies]
    found = [body for body in linkage.bodies if body != linkage.base and ends.count(body) == LEGS]
    return found[0] if len(found) == 1 else None


def _chains(linkage: Linkage) -> list[list[Joint]]:
    """The joints of each chain from base to platform, in their order."""
    left = list(linkage.joints)
    chains = []
    for first in [joint for joint in linkage.joints if linkage.base in joint.bodies]:
        here = linkage.base
        chain: list[Joint] = []
        following: Joint | None = first
        while following is not None:
            left.remove(following)
            chain.append(following)
            here = following.bodies[1] if following.bodies[0] == here else following.bodies[0]
            if here == linkage.platform:
                break
            onward = [joint for joint in left if here in joint.bodies]
            if len(onward) != 1:
                raise NoLegsError(f"the chain from joint {shown(first.name)} ends or branches at body {shown(here)}")
            following = onward[0]
        chains.append(chain)
    if left:
        raise NoLegsError(f"joint {shown(left[0].name)} is in no chain from base to platform")
    return chains


def _leg(chain: Sequence[Joint]) -> _Leg:
    where = f"the leg of joint {shown(chain[0].name)}"
    kinds = [joint.type for joint in chain]
    if kinds.count("P") != 1 or not set(kinds) <= {"P", "R", "S"}:
        raise NoLegsError(f"{where} is a chain of joints {', '.join(kinds)}, not turns and one slide")
    if rank([twist for joint in chain for twist in joint.twists], 6) < 6:
        raise NoLegsError(f"{where} asks more of the platform than a distance")
    place = kinds.index("P")
    slide = chain[place].geometry.axes[0]
    before, behind = chain[:place], chain[place + 1 :]
    if not before:
        before, behind = _split(behind, where)
    (a, off_a), (b, off_b) = _meeting(before, where), _meeting(behind, where)
    along = _minus(b, a)
    if not any(along):
        raise NoLegsError(f"{where} has length 0")
    if place:
        off = sqrt(_square(cross(slide, along)) / (_square(slide) * _square(along)))
        if off > NEARLY:
            raise NoLegsError(f"the slide of {where} is not along the line of its joints")
        return _Leg(a, b, None, max(off_a, off_b, off))
    return _Leg(a, b, _unit(slide, where), max(off_a, off_b))


def _split(turns: Sequence[Joint], where: str) -> tuple[Sequence[Joint], Sequence[Joint]]:
    """The turns of a rod at its two ends: the first two or three meet, and so do the others."""
    for count in range(1, len(turns)):
        one, other = turns[:count], turns[count:]
        if all(2 <= sum(len(joint.twists) for joint in part) <= 3 for part in (one, other)):
            try:
                _meeting(one, where), _meeting(other, where)
            except NoLegsError:
                continue
            return one, other
    raise NoLegsError(f"the turns of {where} do not meet in two points")


def _meeting(turns: Sequence[Joint], where: str) -> tuple[Vector, float]:
    """The point in which the axes of some turns meet, and how far off they are."""
    freedoms = sum(len(joint.twists) for joint in turns)
    if not 2 <= freedoms <= 3:
        raise NoLegsError(f"{where} has {freedoms} turns at one end, not two or three")
    points = [joint.geometry.point for joint in turns]
    ball = next((joint.geometry.point for joint in turns if joint.type == "S"), None)
    lines = [(joint.geometry.point, joint.geometry.axes[0]) for joint in turns if joint.type == "R"]
    candidates = [ball] if ball is not None else [points[0], *points[1:], *_crossings(lines)]
    offs = [max((_distance(point, *line) for line in lines), default=0.0) for point in candidates]
    best = min(range(len(offs)), key=lambda k: offs[k])
    if offs[best] > NEARLY:
        raise NoLegsError(f"turns of {where} do not meet in a point")
    return candidates[best], offs[best]


def _crossings(lines: Sequence[tuple[Vector, Vector]]) -> list[Vector]:
    """Where the first two lines cross, if they do exactly."""
    if len(lines) < 2:
        return []
    (p, d), (q, e) = lines[:2]
    found = solution([[x, -y] for x, y in zip(d, e, strict=True)], _minus(q, p), 2)
    if found is None:
        return []
    x, y, z = (a + found[0] * b for a, b in zip(p, d, strict=True))
    return [(x, y, z)]


def _unit(way: Vector, where: str) -> Vector:
    """A slide's direction, if it is a unit vector as far as decimals go."""
    if abs(float(_square(way)) - 1) > NEARLY:
        raise NoLegsError(f"the axis of the slide of {where} is no unit vector; scale it in the file")
    return way


def _distance(point: Vector, foot: Vector, way: Vector) -> float:
    return sqrt(_square(cross(_minus(point, foot), way)) / _square(way))


def _minus(a: Vector, b: Vector) -> Vector:
    x, y, z = (u - v for u, v in zip(a, b, strict=True))
    return x, y, z


def _square(a: Vector) -> Fraction:
    return sum((x * x for x in a), Fraction(0))

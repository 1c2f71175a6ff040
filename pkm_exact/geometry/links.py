"""Mechanisms with passive bodies: each body has a motion of its own, constraints join any two bodies or the ground.

What the constraints ask is what they ask of a platform (``geometry.mechanism``): of the motion of their second body
seen from their first. Their values and configurations are those of a mechanism that has all of them on one platform.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Matrix
from pkm_exact.geometry.kind_names import LINKS_KIND
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.motions.motion import Motion
from pkm_exact.wording import shown

GROUND: Final = "base"
"""What constraints call the body that stands still."""
MOST_BODIES: Final = 32
_TURNLESS: Final = "translation"


@dataclass(frozen=True)
class LinkBody:
    """A body that moves.

    Attributes
    ----------
    name : str
    motion : Motion
        In which joints that are not declared one by one keep it.
    start : tuple of Vector and Matrix, or None
        A pose that is meant to be near, exact: where one solution is looked for.
    """

    name: str
    motion: Motion
    start: tuple[Vector, Matrix] | None = None


@dataclass(frozen=True)
class Links:
    """A mechanism of bodies that constraints join.

    Attributes
    ----------
    declared : Mechanism
        All constraints with their names, values, actuators and configurations. Its motion is the one that bodies have
        by default; if that is planar, all bodies move in the plane.
    bodies : tuple of LinkBody
        The ground is not among them.
    joined : tuple of (int, int)
        For each constraint its two bodies: 0 is the ground, k the k-th body. It is asked of the second, seen from the
        first.
    platform : int
        Number of the body that is asked about, from 1.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_links
    >>> four_bar = read_links("models/links/four-bar.toml")
    >>> [body.name for body in four_bar.bodies], four_bar.joined[0]
    (['coupler', 'rocker'], (0, 1))
    """

    declared: Mechanism
    bodies: tuple[LinkBody, ...]
    joined: tuple[tuple[int, int], ...]
    platform: int
    kind: str = LINKS_KIND

    def __post_init__(self) -> None:
        require_names([body.name for body in self.bodies])
        for body in self.bodies:
            if self.is_planar and not (body.motion.is_planar or body.motion.name == _TURNLESS):
                raise InputError(
                    f"bodies, {shown(body.name)}: {body.motion.name} is no motion of a planar mechanism; use planar or "
                    f"{_TURNLESS}"
                )

    def __repr__(self) -> str:
        return f"Links({self.name!r}, {len(self.bodies)} bodies)"

    @property
    def name(self) -> str:
        """Its name."""
        return self.declared.name

    @property
    def is_planar(self) -> bool:
        """Whether all bodies move in the plane of the first two axes."""
        return self.declared.motion.is_planar

    def configuration(self, name: str | None = None) -> LockedValues:
        """The configuration called ``name``, or the first one if ``name`` is None."""
        found: LockedValues = self.declared.configuration(name)
        return found

    def locked(self, configuration: LockedValues) -> tuple[Constraint, ...]:
        """All constraints, with the values of the actuated ones."""
        return self.declared.locked(configuration.values, f"configuration {shown(configuration.name)}")

    def with_start(self, pose: tuple[Vector, Matrix]) -> Links:
        """The same with another pose of the platform near which a solution is looked for."""
        bodies = list(self.bodies)
        bodies[self.platform - 1] = replace(bodies[self.platform - 1], start=pose)
        return replace(self, bodies=tuple(bodies))


def require_names(names: Sequence[str]) -> None:
    """Refuse too many bodies, and two of one name."""
    if not 1 <= len(names) <= MOST_BODIES:
        raise InputError(f"bodies: {len(names)} given; give 1 to {MOST_BODIES}")
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"bodies: the name {shown(name)} is used twice; rename one of them")


def number_of(name: object, bodies: Sequence[str], where: str) -> int:
    """The number of a body by its name, 0 for the ground.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    if name == GROUND:
        return 0
    if not isinstance(name, str) or name not in bodies:
        raise InputError(f"{where}: {shown(name)} is not the name of a body; use {', '.join((GROUND, *bodies))}")
    return bodies.index(name) + 1

"""What solving a mechanism with passive bodies returns: the poses of all bodies, and what is proved of the list."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Final

from pkm_exact.claim import Claim
from pkm_exact.roots.interval import Interval
from pkm_exact.systems.system_claims import SystemRoute, meaning_of
from pkm_exact.wording import counted

if TYPE_CHECKING:
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.mechanism import LockedValues
    from pkm_exact.poses.pose import Pose
    from pkm_exact.systems.system_solution import SystemSolution

EXACT: Final = "exact"
KRAWCZYK: Final = "krawczyk"


@dataclass(frozen=True)
class Assembly:
    """One way in which the mechanism is assembled.

    Attributes
    ----------
    poses : tuple of Pose
        Of all bodies, in their order.
    multiplicity : int or None
        Of the solution; None where it is not proved.
    """

    poses: tuple[Pose, ...]
    multiplicity: int | None


@dataclass(frozen=True)
class StartBox:
    """A box of all unknowns, on a grid of spacing 2^-exponent: within ``radius`` units of its centre.

    Attributes
    ----------
    exponent : int
    centre : tuple of int
        One for each unknown, in units of the grid.
    radius : int
    """

    exponent: int
    centre: tuple[int, ...]
    radius: int

    @property
    def intervals(self) -> tuple[Interval, ...]:
        """The bounds of all unknowns."""
        unit = Fraction(1, 1 << self.exponent)
        return tuple(Interval((m - self.radius) * unit, (m + self.radius) * unit) for m in self.centre)


@dataclass(frozen=True, repr=False)
class LinkSolution:
    """The real solutions of a mechanism, its actuators locked.

    It can be iterated, and its ``len`` is the number of assemblies. Boxes of different assemblies are disjoint in some
    coordinate of some body; the platform may stand at the same pose in several.

    Attributes
    ----------
    links : Links
    configuration : LockedValues
    method : {"exact", "krawczyk"}
    system : SystemSolution or None
        The solutions of the polynomial system of all bodies, of the method exact.
    assemblies : tuple of Assembly
        In the order of their boxes.
    notes : tuple of str
    box : StartBox or None
        Of all unknowns, of the method krawczyk.

    Examples
    --------
    >>> from pkm_exact import read_links, solve_links
    >>> found = solve_links(read_links("models/links/four-bar.toml"))
    >>> len(found), found.is_complete, found.complex_solutions
    (2, True, 2)
    """

    links: Links
    configuration: LockedValues
    method: str
    system: SystemSolution | None
    assemblies: tuple[Assembly, ...]
    notes: tuple[str, ...] = ()
    box: StartBox | None = None

    @property
    def claim(self) -> Claim:
        """What is proved about the list."""
        return Claim.NOT_PROVEN_COMPLETE if self.system is None else self.system.claim

    @property
    def completeness_route(self) -> SystemRoute | None:
        """The argument, where the claim is proved."""
        return None if self.system is None else self.system.completeness_route

    @property
    def is_complete(self) -> bool:
        """Whether it is proved that no solution is missing (or that there is none)."""
        return self.system is not None and self.system.is_complete

    @property
    def complex_solutions(self) -> int | None:
        """Number of complex solutions with multiplicity; None where it is not proved."""
        return None if self.system is None else self.system.complex_solutions

    @property
    def distinct_solutions(self) -> int | None:
        """Number of distinct complex solutions found; None for a single box."""
        return None if self.system is None else self.system.distinct_solutions

    def platform_pose(self, assembly: Assembly) -> Pose:
        """The pose of the body that is asked about."""
        return assembly.poses[self.links.platform - 1]

    def __len__(self) -> int:
        return len(self.assemblies)

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[Assembly]:
        return iter(self.assemblies)

    def __str__(self) -> str:
        words = meaning_of(self.claim)
        route = f" ({self.completeness_route})" if self.completeness_route else ""
        real = counted(len(self), "real pose")
        if self.system is None:
            return f"{real} near the start; {words}"
        if self.system.representation is None:
            return f"{words}{route}"
        if self.complex_solutions is None:
            return f"{self.distinct_solutions} distinct complex solutions found, {real}; {words}"
        several = "" if self.distinct_solutions == self.complex_solutions else f" ({self.distinct_solutions} distinct)"
        return f"{counted(self.complex_solutions, 'complex solution')}{several}, {real}; {words}{route}"

    def __repr__(self) -> str:
        return f"<LinkSolution: {self.claim}, {len(self)} real>"

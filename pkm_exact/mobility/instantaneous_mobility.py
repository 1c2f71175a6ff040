"""Instantaneous mobility: the speeds that the loops leave, exactly, beside what counting freedoms predicts.

With M the matrix of the loops, of n freedoms, the mechanism has n - rank M of them, and the platform those twists that
these speeds give it. Gruebler's and Kutzbach's count, 6 (bodies - 1 - joints) + n, is what it would be if all equations
of the loops were independent: it is too small by the overconstraint, 6 times the number of loops less rank M.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from pkm_exact.geometry.linkage import Linkage
from pkm_exact.mobility.loops import Loops, find_loops
from pkm_exact.screws.exact_matrix import Row, null_space, product, rank
from pkm_exact.screws.screw_system import ScrewSystem


@dataclass(frozen=True)
class Instantaneous:
    """The instantaneous mobility of a mechanism in its configuration.

    Attributes
    ----------
    loops : Loops
    locked : tuple of str
        Freedoms whose speeds are 0.
    rank : int
        Of the equations of the loops, in the speeds of the freedoms that are not locked.
    speeds : tuple of rows
        A basis of the speeds of all freedoms that the loops allow.
    platform : ScrewSystem
        The twists of the platform.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_linkage
    >>> found = instantaneous(read_linkage("models/chains/sarrus.toml"))
    >>> found.rank, found.total, found.counted, found.overconstraint, str(found.platform.free_motions())
    (5, 1, 0, 1, '1 translation along (0, 0, 1)')
    """

    loops: Loops
    locked: tuple[str, ...]
    rank: int
    speeds: tuple[Row, ...]
    platform: ScrewSystem

    @property
    def linkage(self) -> Linkage:
        """The mechanism."""
        return self.loops.linkage

    @property
    def total(self) -> int:
        """Freedoms of the whole mechanism."""
        return len(self.speeds)

    @property
    def counted(self) -> int:
        """Freedoms by the formula of Gruebler and Kutzbach; it may be negative."""
        linkage = self.linkage
        free = len(linkage.freedoms) - len(self.locked)
        return 6 * (len(linkage.bodies) - 1 - len(linkage.joints)) + free

    @property
    def overconstraint(self) -> int:
        """Equations of the loops that follow from the others."""
        return 6 * len(self.loops.loops) - self.rank

    @cached_property
    def still(self) -> tuple[str, ...]:
        """Freedoms that no motion uses, though they are not locked."""
        names = self.linkage.freedoms
        return tuple(
            name for k, name in enumerate(names) if name not in self.locked and not any(row[k] for row in self.speeds)
        )

    @cached_property
    def passive(self) -> tuple[tuple[str, ...], ...]:
        """For each motion that leaves the platform at rest, of a basis of them, the freedoms that it uses."""
        names = self.linkage.freedoms
        return tuple(
            tuple(name for name, value in zip(names, row, strict=True) if value)
            for row in at_rest(self.speeds, self.loops.platform)
        )


def instantaneous(linkage: Linkage, locked: Collection[str] = ()) -> Instantaneous:
    """The instantaneous mobility of a mechanism, with some freedoms locked."""
    loops = find_loops(linkage)
    names = linkage.freedoms
    shut = [k for k, name in enumerate(names) if name in locked]
    units = [tuple(Fraction(int(i == k)) for i in range(len(names))) for k in shut]
    speeds = null_space([*loops.matrix, *units], len(names))
    free = [[value for k, value in enumerate(row) if k not in shut] for row in loops.matrix]
    twists = ScrewSystem.of_rows(images(speeds, loops.platform))
    return Instantaneous(loops, tuple(names[k] for k in shut), rank(free, len(names) - len(shut)), speeds, twists)


def images(speeds: Sequence[Row], platform: Sequence[Row]) -> tuple[Row, ...]:
    """The platform's twist for each row of speeds."""
    return product(speeds, list(zip(*platform, strict=True))) if speeds else ()


def at_rest(speeds: Sequence[Row], platform: Sequence[Row]) -> tuple[Row, ...]:
    """A basis of the combinations of speeds that leave the platform at rest."""
    if not speeds:
        return ()
    factors = null_space(list(zip(*images(speeds, platform), strict=True)), len(speeds))
    return product(factors, speeds) if factors else ()

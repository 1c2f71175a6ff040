"""Linear systems of screws: spans, sums, intersections and reciprocal systems, exactly."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from pkm_exact.screws.exact_matrix import Row, echelon, null_space, rank
from pkm_exact.screws.free_motions import TWISTS, WRENCHES, FreeMotions, free_motions
from pkm_exact.screws.screw import Screw


@dataclass(frozen=True, repr=False)
class ScrewSystem:
    """A linear space of screws: all twists that joints allow, or all wrenches that they transmit.

    Attributes
    ----------
    basis : tuple of rows of 6 Fraction
        The reduced row echelon form of (s; s0), so that equal spaces have equal bases. ``ScrewSystem.span`` makes it.

    Examples
    --------
    >>> planar = ScrewSystem.span(
    ...     [Screw.couple((1, 0, 0)), Screw.couple((0, 1, 0)), Screw.line((0, 0, 0), (0, 0, 1))]
    ... )
    >>> planar.rank, planar.reciprocal().rank
    (3, 3)
    >>> print(planar.free_motions())
    2 translations perpendicular to (0, 0, 1), 1 rotation about an axis along (0, 0, 1) through (0, 0, 0)
    """

    basis: tuple[Row, ...]

    @classmethod
    def span(cls, screws: Iterable[Screw]) -> ScrewSystem:
        """All linear combinations of screws.

        Examples
        --------
        >>> from pkm_exact import Screw
        >>> ScrewSystem.span([Screw.line((0, 0, 0), (1, 0, 0)), Screw.line((0, 0, 0), (2, 0, 0))]).rank
        1
        """
        return cls.of_rows([screw.coordinates for screw in screws])

    @classmethod
    def of_rows(cls, rows: Sequence[Sequence[Fraction | int]]) -> ScrewSystem:
        """All linear combinations of rows of six coordinates.

        Examples
        --------
        >>> ScrewSystem.of_rows([(1, 0, 0, 0, 0, 0), (0, 0, 0, 1, 0, 0)]).rank
        2
        """
        return cls(echelon(rows, 6)[0])

    @classmethod
    def all(cls) -> ScrewSystem:
        """All screws.

        Examples
        --------
        >>> ScrewSystem.all().rank
        6
        """
        return cls.of_rows([[int(i == j) for j in range(6)] for i in range(6)])

    @property
    def rank(self) -> int:
        """The dimension."""
        return len(self.basis)

    def screws(self) -> tuple[Screw, ...]:
        """The basis as screws.

        Examples
        --------
        >>> len(ScrewSystem.all().screws())
        6
        """
        return tuple(Screw.from_coordinates(row) for row in self.basis)

    def reciprocal(self) -> ScrewSystem:
        """All screws that are reciprocal to every one of these: of twists the wrenches of constraint, and back.

        Examples
        --------
        >>> ball = ScrewSystem.span(Screw.line((0, 0, 5), axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
        >>> all(wrench.pitch == 0 for wrench in ball.reciprocal().screws())
        True
        """
        return ScrewSystem.of_rows(null_space([(*row[3:], *row[:3]) for row in self.basis], 6))

    def __or__(self, other: ScrewSystem) -> ScrewSystem:
        """The sum: what one of the two, or both together, allow."""
        return ScrewSystem.of_rows([*self.basis, *other.basis])

    def __and__(self, other: ScrewSystem) -> ScrewSystem:
        """The intersection: what both allow."""
        return (self.reciprocal() | other.reciprocal()).reciprocal()

    def __contains__(self, screw: Screw) -> bool:
        return rank([*self.basis, screw.coordinates], 6) == self.rank

    def __le__(self, other: ScrewSystem) -> bool:
        """Whether it is a subspace of the other one."""
        return (self | other).rank == other.rank

    def algebra(self) -> ScrewSystem:
        """The least system with these screws that is closed under the Lie product: that of the group they generate.

        Examples
        --------
        >>> two = ScrewSystem.span(Screw.line((0, 0, 0), axis) for axis in ((1, 0, 0), (0, 1, 0)))
        >>> two.algebra().rank
        3
        """
        found = self
        while True:
            screws = found.screws()
            products = [one.bracket(other).coordinates for i, one in enumerate(screws) for other in screws[:i]]
            larger = ScrewSystem.of_rows([*found.basis, *products])
            if larger.rank == found.rank:
                return found
            found = larger

    def free_motions(self) -> FreeMotions:
        """Number, type and direction of the motions, if it is a system of twists.

        Examples
        --------
        >>> print(ScrewSystem.of_rows([(0, 0, 0, 0, 0, 1), (0, 0, 1, 0, 0, 0)]).free_motions())
        1 translation along (0, 0, 1), 1 rotation about an axis along (0, 0, 1) through (0, 0, 0)
        """
        return free_motions(self.basis, TWISTS)

    def constraints(self) -> FreeMotions:
        """Number, type and direction of forces and couples, if it is a system of wrenches.

        Examples
        --------
        >>> print(ScrewSystem.of_rows([(0, 0, 0, 1, 0, 0)]).constraints())
        1 couple along (1, 0, 0)
        """
        return free_motions(self.basis, WRENCHES)

    def __repr__(self) -> str:
        return f"ScrewSystem(rank={self.rank})"

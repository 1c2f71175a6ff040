"""What doubles tell of real poses: cells of their coordinates, and Jacobians; of one robot, or of rows at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.double_jacobians import double_jacobians
from pkm_exact.numeric.double_krawczyk import DoubleSolution
from pkm_exact.numeric.double_poses import DoubleCoordinates, double_cells, double_coordinates
from pkm_exact.numeric.fine_jacobians import fine_jacobians
from pkm_exact.poses.jacobian import characteristic_length
from pkm_exact.poses.leg_jacobian import LegJacobian
from pkm_exact.roots.interval import Interval


@dataclass(frozen=True, eq=False)
class PosesInDoubles:
    """Poses whose solutions doubles have found, in order.

    Attributes
    ----------
    coordinates : DoubleCoordinates
    exponent : int
    cells : list of lists of Interval or None
        On the grid 2^-exponent; None where doubles do not decide them.
    jacobians : list of LegJacobian or None
        Likewise.
    """

    coordinates: DoubleCoordinates
    exponent: int
    cells: list[list[Interval | None]]
    jacobians: list[LegJacobian | None]

    @classmethod
    def of(
        cls,
        problems: Sequence[ForwardProblem],
        support: Sequence[int],
        solutions: Sequence[Sequence[DoubleSolution]],
        exponent: int,
    ) -> PosesInDoubles:
        """Those of a robot, or of one at several lengths, one after another."""
        together = [solution for row in solutions for solution in row]
        each = [problem for problem, row in zip(problems, solutions, strict=True) for _ in row]
        coordinates = double_coordinates(together, support, problems[0].metric)
        jacobians = _jacobians(problems[0], each if len(problems) > 1 else None, support, together, coordinates)
        return cls(coordinates, exponent, double_cells(coordinates, exponent), jacobians)

    def parts(self, counts: Sequence[int]) -> list[PosesInDoubles]:
        """Parts of these sizes."""
        ends = np.cumsum(counts).tolist()
        places = [slice(end - count, end) for end, count in zip(ends, counts, strict=True)]
        values, errors = self.coordinates.values, self.coordinates.errors
        return [
            PosesInDoubles(
                DoubleCoordinates(values[place], errors[place]),
                self.exponent,
                self.cells[place],
                self.jacobians[place],
            )
            for place in places
        ]

    def cells_on(self, exponent: int) -> list[list[Interval | None]]:
        """The cells of another grid as well."""
        found = self.cells if exponent == self.exponent else double_cells(self.coordinates, exponent)
        return [list(row) for row in found]


def _jacobians(
    problem: ForwardProblem,
    each: Sequence[ForwardProblem] | None,
    support: Sequence[int],
    solutions: Sequence[DoubleSolution],
    coordinates: DoubleCoordinates,
) -> list[LegJacobian | None]:
    length = characteristic_length(problem)
    found = double_jacobians(problem, coordinates, length, each)
    rest = [place for place, jacobian in enumerate(found) if jacobian is None]
    if rest:
        others = None if each is None else [each[place] for place in rest]
        finer = fine_jacobians(problem, [solutions[place] for place in rest], support, length, others)
        for place, jacobian in zip(rest, finer, strict=True):
            found[place] = jacobian
    return found

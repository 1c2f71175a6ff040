"""Many length vectors of one robot, each solved as if it were alone, from what is found once for all of them.

The numeric engine tracks short paths from a start section near the robot (``numeric.nearby``). The start is a matter of
time only: what is proved lies on fixed grids, so that the answer has the same boxes whatever it was tracked from.
"""

from __future__ import annotations

import gc
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Final

import numpy as np

from pkm_exact.completeness.shared_rows import SharedRows
from pkm_exact.engine import solve_row
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.nearby import from_home, nearby_start
from pkm_exact.numeric.poses import Charted
from pkm_exact.numeric.rows_together import rows_together
from pkm_exact.numeric.start import StartSection
from pkm_exact.numeric_engine import solve_exactly_instead, solve_krawczyk, with_answers
from pkm_exact.policy import Policy
from pkm_exact.solution import Solution

METHODS: Final = ("krawczyk", "exact")
SOME: Final = 5
"""Rows that tell whether they are near enough to each other."""
TOGETHER: Final = 32
"""Rows that go through arrays together at most: they stay in the cache."""
KEPT: Final = 2**24
"""Bytes: several times what the arrays of such rows take."""
SHARED_START: Final = 3
"""Rows from which a start section of their own pays."""


@dataclass(frozen=True)
class RowSolver:
    """How rows are solved: by which method, from which start, or that the numeric engine need not be tried.

    Attributes
    ----------
    method : {"krawczyk", "exact"}
    width : Fraction
        Largest width of a box, in every coordinate.
    policy : Policy
    start : StartSection or None
        Near the robot; None if the generic one is used.
    is_numeric : bool
        Whether the numeric engine is tried at all.
    shared : SharedRows
        What the exact engine finds at the first rows for the others. A matter of time only, too.
    """

    method: str
    width: Fraction
    policy: Policy
    start: StartSection | None = None
    is_numeric: bool = True
    shared: SharedRows = field(default_factory=SharedRows, repr=False, compare=False)

    @classmethod
    def of(
        cls, problems: Sequence[ForwardProblem], width: Fraction, policy: Policy, method: str = METHODS[0]
    ) -> RowSolver:
        """The solver of rows like the given ones."""
        middle = _middle(problems) if method == "krawczyk" else None
        if middle is None:
            return cls(method, width, policy)
        try:
            start = nearby_start(middle, policy.seed)
        except OverflowError:
            return cls(method, width, policy)
        if start is not None and not _leads_on(start, problems):
            start = replace(start, home=None)
        # A robot with fewer solutions for all lengths: their number will not prove any list complete.
        return cls(method, width, policy, start, is_numeric=start is not None)

    def near(self, problems: Sequence[ForwardProblem]) -> list[Charted | None]:
        """What can be found of rows at once, for ``solution``."""
        if self.start is None or not self.is_numeric or len(problems) < 2:
            return [None] * len(problems)
        keep_freed_memory()
        with _without_collector():
            return with_answers(rows_together(problems, self.start, self.width), self.width, self.policy)

    def solution(self, problem: ForwardProblem, near: Charted | None = None) -> Solution:
        """The answer to one row.

        Raises
        ------
        PkmExactError
            As ``engine.solve``, if that has to be called.
        """
        if near is not None and near.answer is not None:
            return near.answer
        if self.method == "exact":
            return solve_row(problem, width=self.width, policy=self.policy, shared=self.shared)
        if self.is_numeric:
            return solve_krawczyk(problem, width=self.width, policy=self.policy, start=self.start, near=near)
        return solve_exactly_instead(problem, width=self.width, policy=self.policy)


@contextmanager
def _without_collector() -> Iterator[None]:
    """Nothing looks for cycles meanwhile: it would look at each interval of many rows a dozen times, and find none."""
    is_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if is_enabled:
            gc.enable()


def keep_freed_memory() -> None:
    """Keep the memory of freed arrays for the next ones, where the C library goes by the largest block freed (glibc).

    It gives memory back to the system where more than twice as much as that is unused, and rows would ask for theirs
    again each time: a twelfth of a row. The block of this is never written to, and so takes no memory.
    """
    np.empty(KEPT, dtype=np.uint8)


def _leads_on(start: StartSection, problems: Sequence[ForwardProblem]) -> bool:
    """Whether Newton's method leads from the solutions at home to those of most of a few rows."""
    few = problems[:: max(1, len(problems) // SOME)][:SOME]
    try:
        return 2 * sum(from_home(problem, start) is not None for problem in few) > len(few)
    except OverflowError:
        return False


def _middle(problems: Sequence[ForwardProblem]) -> ForwardProblem | None:
    """The row nearest to the mean of all; None if they are too few or too large for a start section of their own."""
    if len(problems) < SHARED_START:
        return None
    try:
        squares = np.array([problem_values(problem) for problem in problems])
    except OverflowError:
        return None
    with np.errstate(all="ignore"):
        distances = np.linalg.norm(squares - squares.mean(axis=0), axis=1)
    return problems[int(np.argmin(distances))]


def problem_values(problem: ForwardProblem) -> list[float]:
    """In what rows of one robot differ: the values of its constraints, those of lengths squared."""
    values = (getattr(found, found.value_field) for found in problem.constraints if found.value_field is not None)
    return [float(value) for value in values]

"""What kind of singularity a pose is, told apart by exact ranks, and which constraints cause it.

With q' the speeds of the actuators, t the twist of the platform, W the wrenches of all constraints, f freedoms:

    type 1        J_q is singular: an actuator moves, and the platform need not (Gosselin and Angeles, 1990); with more
                  actuators than equations for them, where that is so everywhere: its rank is below that of its pattern
    type 2        rank W < f although all actuators are locked: the platform moves, or bears some load badly
    constraint    the wrenches of the constraints that are not actuated have a smaller rank than elsewhere (Zlatanov,
                  Bonev and Gosselin, 2002)
    architecture  rank W < f at every pose: the forms themselves are dependent (Ma and Angeles, 1992)
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any, Final

from flint import arb_mat

from pkm_exact.constraints.constraint import SquareForm
from pkm_exact.digests import digest
from pkm_exact.geometry.inverse import Metric, rotation_of
from pkm_exact.motions.motion import Motion
from pkm_exact.polytopes.rationals import rational_matrix
from pkm_exact.statics.actuated_equations import Equation, Held
from pkm_exact.statics.ball_rows import BallRow
from pkm_exact.statics.entangled_rows import ball_rates, exact_rates
from pkm_exact.statics.exact_rows import ExactRow, exact_row
from pkm_exact.statics.ranks import left_kernel, proved_rank, rationalised, root_sum_rank

TYPE_1: Final = "type-1"
TYPE_2: Final = "type-2"
CONSTRAINT: Final = "constraint"
ARCHITECTURE: Final = "architecture"
MEANINGS: Final = {
    TYPE_1: "the actuator moves, and the platform need not",
    TYPE_2: "with all actuators locked the platform still has a velocity that no constraint resists",
    CONSTRAINT: "the constraints that are not actuated resist fewer motions than they do at a pose chosen at random",
    ARCHITECTURE: "the constraints are dependent at every pose",
}
DEPENDENT: Final = "rows of J_q are dependent here, though not by which actuators enter which constraints"


@dataclass(frozen=True)
class Singularity:
    """A singularity of a pose.

    Attributes
    ----------
    name : str
        "type-1", "type-2", "constraint" or "architecture".
    constraints : tuple of str
        Those that cause it: whose wrenches are dependent, or whose actuator is.
    meaning : str
        If it is not that of the name.
    """

    name: str
    constraints: tuple[str, ...]
    meaning: str = ""

    def __str__(self) -> str:
        return f"{self.name} ({', '.join(self.constraints)}): {self.meaning or MEANINGS[self.name]}"


@dataclass(frozen=True)
class Kinds:
    """What is known of the singularities at a pose.

    Attributes
    ----------
    rank, structural_rank : int or None
        Of all wrenches, and of those that are not actuated; None where it is not decided.
    found : tuple of Singularity
        Proved.
    undecided : tuple of str
        Names of those that were neither proved nor excluded.
    """

    rank: int | None
    structural_rank: int | None
    found: tuple[Singularity, ...]
    undecided: tuple[str, ...]


def kinds_at_rational_pose(held: Held, rows: Sequence[ExactRow], motion: Motion, metric: Metric) -> Kinds:
    """All four, decided exactly; of the last, that it is there is said only if the forms prove it."""
    equations, structural = held.equations, held.structural
    names, count = [equation.name for equation in equations], motion.dimension
    wrenches = [rationalised(row.wrench) for row in rows]
    found: list[Singularity] = []
    undecided: list[str] = []
    found += _type_1(held, rows)
    rank, causes = _rank_and_causes([row.wrench for row in rows], wrenches, range(len(rows)))
    below, structural_causes = _rank_and_causes([row.wrench for row in rows], wrenches, structural)
    usual = generic_rank([equations[index] for index in structural], motion, metric) if structural else 0
    if below < usual:
        found.append(Singularity(CONSTRAINT, tuple(names[index] for index in structural_causes)))
    if rank < min(count, len(rows)):
        if is_architecture([equation.form for equation in equations], motion):
            found.append(Singularity(ARCHITECTURE, tuple(names[index] for index in causes)))
        elif generic_rank(equations, motion, metric) == rank:
            undecided.append(ARCHITECTURE)
        if below == usual:
            found.append(Singularity(TYPE_2, tuple(names[index] for index in causes)))
    return Kinds(rank, below, tuple(found), tuple(undecided))


def kinds_in_balls(
    held: Held, rows: Sequence[BallRow], motion: Motion, metric: Metric, rank: int | None, *, is_multiple: bool = False
) -> Kinds:
    """The same where the pose is enclosed; ``rank`` is the exact one of all wrenches, where it is known.

    At a multiple solution of as many equations as freedoms it is proved to be smaller than these.
    """
    equations, structural, count = held.equations, held.structural, motion.dimension
    every = tuple(equation.name for equation in equations)
    found: list[Singularity] = []
    rates, wanted = ball_rates(rows, held.driven, len(held.actuators)), _pattern_rank(held)
    undecided = [TYPE_1] if wanted and proved_rank(arb_mat(rates)) < wanted else []
    proved = _proved(rows, range(len(rows)))
    if rank is None and proved == min(count, len(rows)):
        rank = proved
    is_multiple = is_multiple and len(rows) == count
    if rank is None and is_multiple and proved == count - 1:
        rank = proved
    below, usual = _proved(rows, structural), 0
    if structural:
        usual = generic_rank([equations[index] for index in structural], motion, metric)
    if below < usual:
        undecided.append(CONSTRAINT)
    if rank is None and is_multiple and below == usual:
        found.append(Singularity(TYPE_2, every))
    elif rank is None:
        undecided.append(TYPE_2)
    elif rank < min(count, len(rows)):
        if is_architecture([equation.form for equation in equations], motion):
            found.append(Singularity(ARCHITECTURE, every))
        if below == usual:
            found.append(Singularity(TYPE_2, every))
        else:
            undecided.append(TYPE_2)
    return Kinds(rank, below if below == usual else None, tuple(found), tuple(undecided))


def _pattern_rank(held: Held) -> int:
    """The rank of J_q if the numbers that are not 0 for sure had no relations."""
    if not held.is_redundant:
        return len(held.actuators)
    matched: dict[int, int] = {}

    def place(index: int, seen: set[int]) -> bool:
        for rate in held.equations[index].rates:
            if rate.actuator not in seen:
                seen.add(rate.actuator)
                if rate.actuator not in matched or place(matched[rate.actuator], seen):
                    matched[rate.actuator] = index
                    return True
        return False

    return sum(place(index, set()) for index in held.driven)


def _type_1(held: Held, rows: Sequence[ExactRow]) -> list[Singularity]:
    """Whether J_q is singular at an exact pose, and which actuators move alone; or which constraints none moves."""
    count, driven = len(held.actuators), held.driven
    if not count:
        return []
    rates = exact_rates(rows, driven, count)
    rank = root_sum_rank(rates)
    if rank == _pattern_rank(held):
        return []
    if held.is_redundant:
        causes = [k for k in range(len(driven)) if root_sum_rank(rates[:k] + rates[k + 1 :] or [[]]) == rank]
        names = tuple(held.equations[driven[k]].name for k in causes)
        return [Singularity(TYPE_1, names, DEPENDENT)]
    alone = [k for k in range(count) if root_sum_rank([row[:k] + row[k + 1 :] for row in rates]) == rank]
    return [Singularity(TYPE_1, tuple(held.actuators[k].name for k in alone))]


def _proved(rows: Sequence[BallRow], places: Iterable[int]) -> int:
    chosen = [list(rows[index].wrench) for index in places]
    return proved_rank(arb_mat(chosen)) if chosen else 0


def _rank_and_causes(
    exact: Sequence[Sequence[Any]], wrenches: Sequence[list[Fraction] | None], places: Sequence[int]
) -> tuple[int, tuple[int, ...]]:
    """The rank of some rows, and those that a dependency has."""
    chosen = [wrenches[index] for index in places]
    if not chosen:
        return 0, ()
    rational = [row for row in chosen if row is not None]
    if len(rational) < len(chosen):
        rank = root_sum_rank([exact[index] for index in places])
        return rank, tuple(places) if rank < len(places) else ()
    dependencies = left_kernel(rational)
    causes = tuple(index for k, index in enumerate(places) if any(z[k] for z in dependencies))
    return len(chosen) - len(dependencies), causes


def is_architecture(forms: Sequence[Any], motion: Motion) -> bool:
    """Whether wrenches are dependent at every pose because the forms without their constants are.

    "No" does not mean that there is a regular pose.
    """
    if any(isinstance(form, SquareForm) for form in forms):
        return False
    rows = [rationalised(form[:16]) for form in forms]
    exact = [row for row in rows if row is not None]
    if len(exact) < len(rows):
        return False
    fixed = [[Fraction(value) for value in form[:16]] for form in motion.forms]
    together = rational_matrix([*exact, *fixed]).rank()
    own = rational_matrix(fixed).rank() if fixed else 0
    return bool(together - own < min(len(rows), motion.dimension))


def generic_rank(equations: Sequence[Equation], motion: Motion, metric: Metric) -> int:
    """The rank of the wrenches at a rational pose of the motion chosen at random: as large as it gets, almost surely.

    It is proved that there is a pose with this rank.
    """
    random = Random(digest("generic rank", motion.name, len(equations)))
    best = 0
    for _ in range(2):
        position, rotation = _random_pose(motion, metric, random)
        rows = [
            rationalised(exact_row(equation, position, rotation, metric, motion.twist).wrench) for equation in equations
        ]
        rational = [row for row in rows if row is not None]
        best = max(best, int(rational_matrix(rational).rank()) if rational else 0)
    return best


def _random_pose(motion: Motion, metric: Metric, random: Random) -> tuple[Any, Any]:
    """A rational pose of the motion."""
    turns = [Fraction(random.randint(1, 99), 100) if k in motion.support else Fraction(0) for k in range(4)]
    position = tuple(Fraction(random.randint(-99, 99), 10) if k in motion.twist else Fraction(0) for k in range(3))
    return position, rotation_of((turns[0], turns[1], turns[2], turns[3]), metric)

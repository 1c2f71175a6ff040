"""What a set of measurements says of parameters: an observation matrix, its rank, and its null space in words.

Measurements are linear in the parameters p, or linearised: each is a row w, and w.p is what is measured. Parameters
that differ by an element of the null space cannot be told apart. The rows of the reduced echelon form are the base
parameters: combinations that the measurements determine, and all such combinations are combinations of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, islice
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.screws.exact_matrix import Row, echelon, null_space, rank
from pkm_exact.wording import shown

MOST_PLANS: Final = 2000
"""Plans of one size that are looked at; beyond, a plan is found that is irreducible, perhaps not the smallest."""


@dataclass(frozen=True)
class Identification:
    """What can be identified.

    Attributes
    ----------
    parameters : tuple of str
        In the order of the columns of the echelon form: earlier ones are preferred as leading ones.
    base : tuple of rows
        Base parameters: each with 1 at a parameter at which the others are 0.
    null_space : tuple of rows
        Changes of the parameters that no measurement shows.

    Examples
    --------
    >>> found = identify([[1, 1, 0], [2, 2, 0]], ["mass 1", "mass 2", "inertia"])
    >>> found.rank, found.base_in_words()
    (1, ('mass 1 + mass 2',))
    >>> found.unseen, found.seen_alone
    (('inertia',), ())
    """

    parameters: tuple[str, ...]
    base: tuple[Row, ...]
    null_space: tuple[Row, ...]

    @property
    def rank(self) -> int:
        """How many combinations are determined."""
        return len(self.base)

    @property
    def unseen(self) -> tuple[str, ...]:
        """Parameters that no measurement depends on."""
        return tuple(name for k, name in enumerate(self.parameters) if not any(row[k] for row in self.base))

    @property
    def seen_alone(self) -> tuple[str, ...]:
        """Parameters that are determined by themselves."""
        return tuple(name for k, name in enumerate(self.parameters) if not any(x[k] for x in self.null_space))

    def base_in_words(self) -> tuple[str, ...]:
        """The base parameters as sums."""
        return tuple(combination_text(row, self.parameters) for row in self.base)

    def confused(self) -> tuple[str, ...]:
        """For each element of a basis of the null space the change that no measurement shows."""
        return tuple(
            f"nothing shows a change of {combination_text(x, self.parameters, ' by ')}" for x in self.null_space
        )

    def determines(self, combination: Sequence[Fraction]) -> bool:
        """Whether a combination of the parameters, by its coefficients in their order, is determined."""
        return rank([*self.base, combination], len(self.parameters)) == self.rank


def combination_text(row: Sequence[Fraction], names: Sequence[str], by: str = "") -> str:
    """A combination in words; with ``by`` a list of changes.

    >>> combination_text([Fraction(1), Fraction(-3, 2)], ["a", "b"]), combination_text([1, 0], ["a", "b"], " by ")
    ('a - 3/2*b', 'a by 1')
    """
    pairs = [(value, name) for value, name in zip(row, names, strict=True) if value]
    if by:
        return ", ".join(f"{name}{by}{value}" for value, name in pairs)
    text = ""
    for value, name in pairs:
        sign = ("-" if value < 0 else "") if not text else (" - " if value < 0 else " + ")
        size = abs(value)
        text += f"{sign}{name}" if size == 1 else f"{sign}{size}*{name}"
    return text


def identify(
    rows: Sequence[Sequence[Fraction | int]], parameters: Sequence[str], preferred: Sequence[str] = ()
) -> Identification:
    """What measurements determine of parameters.

    Parameters
    ----------
    rows : sequence of rows
        One for each measurement, as many entries as parameters.
    parameters : sequence of str
        Different names.
    preferred : sequence of str, optional
        Parameters that are to lead combinations, where that is possible; by default in the given order.
    """
    names = list(parameters)
    for name in preferred:
        if name not in names:
            raise InputError(f"preferred: {shown(name)} is not one of the parameters; use some of them")
    order = [*(names.index(name) for name in preferred), *(k for k, name in enumerate(names) if name not in preferred)]
    columns = [[row[k] for k in order] for row in rows]
    found, _ = echelon(columns, len(names))
    return Identification(tuple(names[k] for k in order), found, null_space(columns, len(names)))


@dataclass(frozen=True)
class Plan:
    """A choice of measurements.

    Attributes
    ----------
    chosen : tuple of int
        Indices of groups of rows: of poses, trajectories or sensors.
    rank : int
        Which is that of all groups together.
    is_smallest : bool
        Whether no choice of fewer groups has it; otherwise none can be left out, but that was not proved.
    """

    chosen: tuple[int, ...]
    rank: int
    is_smallest: bool


def minimal_plan(groups: Sequence[Sequence[Sequence[Fraction | int]]], parameters: int) -> Plan:
    """The fewest groups of measurements that determine as much as all of them, or an irreducible choice.

    Examples
    --------
    >>> minimal_plan([[[1, 0]], [[1, 1], [2, 2]], [[1, 0], [0, 1]]], 2)
    Plan(chosen=(2,), rank=2, is_smallest=True)
    """
    spans = [echelon(rows, parameters)[0] for rows in groups]
    whole = rank([row for span in spans for row in span], parameters)
    chosen = list(range(len(spans)))
    for place in range(len(spans)):
        left = [k for k in chosen if k != place]
        if rank([row for k in left for row in spans[k]], parameters) == whole:
            chosen = left
    for size in range(len(chosen)):
        tried = list(islice(combinations(range(len(spans)), size), MOST_PLANS + 1))
        if len(tried) > MOST_PLANS:
            return Plan(tuple(chosen), whole, is_smallest=False)
        for some in tried:
            if rank([row for k in some for row in spans[k]], parameters) == whole:
                return Plan(some, whole, is_smallest=True)
    return Plan(tuple(chosen), whole, is_smallest=True)

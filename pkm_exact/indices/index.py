"""What an index is: a number at a pose with a name, a meaning and one spelling for each kind of output."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Final, Protocol, TypeAlias

from pkm_exact.roots.interval import Interval

Value: TypeAlias = Interval | int | None
"""An enclosure, an exact integer, or None where nothing is certified or the index has no value."""


class Jacobian(Protocol):
    """What is certified of a Jacobian (``poses.jacobian``)."""

    @property
    def rank(self) -> int:
        """Exactly."""
        ...

    @property
    def sigma_min(self) -> Interval:
        """The least singular value."""
        ...

    @property
    def condition(self) -> Interval | None:
        """The condition number; None at a singular pose."""
        ...


class Measured(Protocol):
    """What an index is computed from: a pose, or what a picture knows of one."""

    @property
    def det_sign(self) -> int | None:
        """Sign of the determinant of the Jacobian; 0 at a singular pose, None where it is not certified."""
        ...

    @property
    def jacobian(self) -> Jacobian | None:
        """What is certified of the Jacobian."""
        ...


class Output(StrEnum):
    """Where poses are shown."""

    TABLE = "table"
    JSON = "json"
    CSV = "csv"
    PAGE = "page"
    ARRAYS = "arrays"
    SWEEP = "sweep"


EVERYWHERE: Final = frozenset(Output)


@dataclass(frozen=True)
class Index:
    """A number at a pose.

    Attributes
    ----------
    name : str
        Key of JSON, column of CSV files and of sweeps, name of arrays.
    heading : str
        Of a column of a table.
    meaning : str
        In words, with its unit if it has one.
    value : callable
        Of what is measured at a pose: exact, or enclosed.
    text : callable
        The same for a table, short.
    number : callable
        The same for arrays and for sorting: a double.
    is_integer : bool
        Whether the value is an integer; else it is an interval.
    undecided : int or None
        In arrays of integers, what stands where nothing is certified; None for arrays of floats, which have nan.
    outputs : frozenset of Output
        Where it is shown.
    words : callable or None
        The same for a person who reads about one pose; ``text`` if None.
    """

    name: str
    heading: str
    meaning: str
    value: Callable[[Measured], Value]
    text: Callable[[Measured], str]
    number: Callable[[Measured], float | None]
    is_integer: bool = False
    undecided: int | None = None
    outputs: frozenset[Output] = EVERYWHERE
    words: Callable[[Measured], str] | None = None

    def in_words(self, pose: Measured) -> str:
        """What is said of the index at one pose."""
        return (self.words or self.text)(pose)

    def exact(self, pose: Measured) -> list[str] | int | None:
        """The value as JSON has it: both ends of an enclosure as texts, an integer, or None."""
        value = self.value(pose)
        return [str(value.lo), str(value.hi)] if isinstance(value, Interval) else value

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of a CSV file: one of an integer, two of an enclosure."""
        return (self.name,) if self.is_integer else (f"{self.name}_lo", f"{self.name}_hi")

    def fields(self, pose: Measured) -> list[str]:
        """What stands in these columns; nothing where there is no value."""
        value = self.exact(pose)
        if value is None:
            return [""] * len(self.columns)
        return value if isinstance(value, list) else [str(value)]

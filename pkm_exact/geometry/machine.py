"""What all robots offer, whatever they are made of: a name, configurations, and the problem that each of them poses."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from difflib import get_close_matches
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.kind_names import CONSTRAINTS_KIND
from pkm_exact.geometry.limits import Limits
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion import Motion
from pkm_exact.wording import printable, shown

if TYPE_CHECKING:
    from pkm_exact.geometry.nominal_pose import NominalPose

LISTED: Final = 20
"""Configurations named in a message; of more there is said that there are more."""


def locked_at(kind: str, configuration: str | None) -> str:
    """How outputs say what a robot's actuators are locked at.

    Examples
    --------
    >>> locked_at("6-UPS", None), locked_at("constraints", "home")
    ('given leg lengths', 'configuration home')
    """
    if configuration:
        return f"configuration {configuration}"
    return "given values" if kind == CONSTRAINTS_KIND else "given leg lengths"


class Machine(ABC):
    """A robot: who it is, how it may move, and what its actuators can be locked at.

    Attributes
    ----------
    name, unit, source : str
        Its name, the unit of length, and where the numbers come from.
    kind : str
        What it is made of, as model files name it.
    metric : tuple of 3 int
        Gram diagonal: the ordinary coordinate is sqrt(metric[i]) times the rational one.
    configurations : tuple
        Locked actuators under names; the first one is the default.
    limits : Limits or None
        How far actuators, passive joints, legs and platform may go.
    nominal : NominalPose or None
        The pose in which it is meant to be.
    cables : bool
        Whether its legs are cables, which only pull.
    """

    name: str
    kind: str
    unit: str
    source: str
    metric: Metric
    configurations: tuple[Any, ...]
    limits: Limits | None
    nominal: NominalPose | None
    cables: bool

    @property
    @abstractmethod
    def motion(self) -> Motion:
        """What the platform is capable of."""

    @property
    @abstractmethod
    def actuated(self) -> tuple[str, ...]:
        """How the locked values are called, in their order."""

    @property
    @abstractmethod
    def are_lengths(self) -> tuple[bool, ...]:
        """For each of them whether users give a length, which is positive."""

    @abstractmethod
    def problem(self, locked: Any) -> ForwardProblem:
        """The forward kinematics problem of a configuration, or of locked values in their order."""

    @abstractmethod
    def problem_at(self, values: Sequence[Fraction], *, squared: bool = False) -> ForwardProblem:
        """The problem for values as users give them, in the order of ``actuated``: lengths, unless they are squared.

        Raises
        ------
        InputError
            If there are not as many as actuators, or one is not possible.
        """

    def configuration(self, name: str | None = None) -> Any:
        """The configuration called ``name``, or the first one if ``name`` is None.

        Raises
        ------
        InputError
            If there is none of that name, or none at all.
        """
        if not self.configurations:
            raise InputError(f"configurations: {shown(self.name)} has none; {self._instead_of_configurations()}")
        if name is None:
            return self.configurations[0]
        for configuration in self.configurations:
            if configuration.name == name:
                return configuration
        known = ", ".join(configuration.name for configuration in self.configurations[:LISTED])
        more = ", ..." if len(self.configurations) > LISTED else ""
        close = get_close_matches(str(name), [configuration.name for configuration in self.configurations], 1)
        guess = f", did you mean {shown(close[0])}?" if close else ""
        raise InputError(f"configuration: {shown(name)} is unknown{guess}; use one of: {known}{more}")

    def _instead_of_configurations(self) -> str:
        return f"give the values of {', '.join(self.actuated[:LISTED])} instead"

    def __str__(self) -> str:
        names = ", ".join(printable(configuration.name) for configuration in self.configurations[:LISTED])
        more = ", ..." if len(self.configurations) > LISTED else ""
        found = f"configurations: {names}{more}" if names else "no configurations"
        return f"{printable(self.name)} ({self.kind}, lengths in {printable(self.unit)}), {found}"

"""What a recipe is: from a few dimensions to constraints, and the actuators that move them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType
from typing import Any, Final, TypeAlias

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.drives import Drive
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.motions.motion import Motion

Dimensions: TypeAlias = Mapping[str, Any]
"""Numbers, vectors and words of a machine by the names of its dimensions, read already."""


class Joint(StrEnum):
    """What an actuator is, and how configurations give its value."""

    LENGTH = "lengths"
    SLIDE = "slides"
    CRANK = "cranks"
    OFFSET = "offsets"


@dataclass(frozen=True)
class Group:
    """Actuators of one sort, whose values stand in one list of a configuration.

    Attributes
    ----------
    joint : Joint
    names : tuple of str
        In the order of the list.
    prefix : str
        Before the keys, where a machine has two groups of a sort: "elbow_" for ``elbow_half_tangents``.
    """

    joint: Joint
    names: tuple[str, ...]
    prefix: str = ""

    @property
    def keys(self) -> tuple[str, ...]:
        """The keys by one of which a configuration gives the values."""
        return tuple(f"{self.prefix}{key}" for key in _KEYS[self.joint])


_KEYS: Final = {
    Joint.LENGTH: ("lengths", "lengths_squared"),
    Joint.SLIDE: ("slides",),
    Joint.CRANK: ("half_tangents", "cos_sin", "degrees"),
    Joint.OFFSET: ("offsets",),
}


@dataclass(frozen=True)
class Assembly:
    """A machine taken apart: what keeps its platform, and what moves that.

    Attributes
    ----------
    constraints : tuple of Constraint
        Each with a name of its own.
    groups : tuple of Group
        Names of constraints whose own values are given, or of drives.
    drives : tuple of Drive
    bars : tuple of Vector
        For each leg, where the machine has them: from the platform's joint along a bar that does not turn to the leg's
        end. The leg's constraint has both ends without it. For pictures.
    feet : tuple of (str, Vector)
        Of planes that stand for a strut, upright on a rail or a crank: the plane's name, and where that begins. For
        pictures.
    """

    constraints: tuple[Constraint, ...]
    groups: tuple[Group, ...]
    drives: tuple[Drive, ...] = ()
    bars: tuple[Vector, ...] = ()
    feet: tuple[tuple[str, Vector], ...] = ()


@dataclass(frozen=True)
class Dimension:
    """A key of a model file that describes a machine.

    Attributes
    ----------
    key : str
    what : str
        In a few words, for comments of first models and the documentation.
    read : callable
        Takes the table that the key stands in, the key and its place, and returns what the recipe needs.
    example : str
        A value as a model file has it.
    is_optional : bool
        Whether the key may be left out; ``read`` is then given None in place of a value.
    table : str
        In which table of the file the key stands.
    also : tuple of str
        Other keys by which the same may be given.
    name : str
        How the recipe calls it, if not by its key.
    """

    key: str
    what: str
    read: Callable[[Mapping[str, Any], str], Any]
    example: str
    is_optional: bool = False
    table: str = "dimensions"
    also: tuple[str, ...] = ()
    name: str = ""


@dataclass(frozen=True)
class MachineKind:
    """A recipe.

    Attributes
    ----------
    name : str
        In the field's notation, as model files have it.
    description : str
        In a few words.
    motion : Motion
        In which the platform is kept by joints that are no constraints of their own.
    dimensions : tuple of Dimension
    build : callable
        From the dimensions and the metric to constraints and actuators.
    home : mapping of str to str
        A configuration of the example, as a model file has it.
    pose : tuple of 3 and 4 int
        Position and quaternion of a pose that the passive joints of the example admit, in the metric.
    metric : tuple of 3 int
        That of all coordinates.
    has_modes : bool
        Whether every actuator has values of its own at a pose; not where two of them move one constraint.
    any_count : bool
        Whether the number that its name begins with may be another one (``machine_kinds.machine_kind``).
    own_metric : bool
        Whether a model file may give another one: no recipe with triangles lets it.
    homes : mapping of (str, str) to mapping
        Configurations of the example where a dimension has a word that asks for other joint values.
    """

    name: str
    description: str
    motion: Motion
    dimensions: tuple[Dimension, ...]
    build: Callable[[Dimensions, Metric], Assembly]
    home: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    pose: tuple[tuple[int, int, int], tuple[int, int, int, int]] = ((0, 0, 1), (1, 0, 0, 0))
    metric: Metric = UNIT_METRIC
    has_modes: bool = True
    any_count: bool = False
    own_metric: bool = False
    homes: Mapping[tuple[str, str], Mapping[str, str]] = field(default_factory=lambda: MappingProxyType({}))

    def home_with(self, chosen: Mapping[str, str]) -> Mapping[str, str]:
        """A configuration for dimensions that are given as a model file has them."""
        words = ((key, value.strip('"')) for key, value in chosen.items())
        return next((self.homes[word] for word in words if word in self.homes), self.home)

    @property
    def tables(self) -> tuple[str, ...]:
        """The tables of a model file that describe it."""
        return tuple(dict.fromkeys(dimension.table for dimension in self.dimensions))

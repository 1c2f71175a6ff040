"""A parallel robot with exact geometry, and the forward kinematics problems it poses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric
from pkm_exact.geometry.kinds import KINDS, Joints
from pkm_exact.geometry.problem import ForwardProblem, Vector
from pkm_exact.geometry.rational import parse_positive, parse_vector
from pkm_exact.wording import shown

LEGS: Final = 6
_LISTED: Final = 20


def _six(values: Sequence[object], where: str) -> tuple[Fraction, ...]:
    if len(values) != LEGS:
        raise InputError(f"{where}: {len(values)} values; give {LEGS}, one per leg")
    return tuple(parse_positive(value, f"{where}[{i}]") for i, value in enumerate(values, 1))


@dataclass(frozen=True)
class Configuration:
    """Locked actuators under a name.

    Attributes
    ----------
    name : str
        Unique among the configurations of a robot.
    lengths_squared : tuple of 6 Fraction
        Squared leg lengths, positive, in squared units of length.
    """

    name: str
    lengths_squared: tuple[Fraction, ...]

    def __post_init__(self) -> None:
        where = f"configuration {shown(self.name)}, lengths_squared"
        object.__setattr__(self, "lengths_squared", _six(self.lengths_squared, where))


@dataclass(frozen=True)
class Robot:
    """A parallel robot: exact joint coordinates, how they are joined, and named configurations.

    Attributes
    ----------
    name, unit, source : str
        Its name, the unit of length, and where the numbers come from.
    kind : str
        Key of the recipe in ``KINDS`` that turns joints and joint values into constraints.
    base_joints, platform_joints : tuple of 6 vectors of 3 Fraction
        Joint centres in the fixed and in the mobile frame, rational coordinates with respect to ``metric``.
    metric : tuple of 3 int
        Gram diagonal, positive integers: the ordinary coordinate is sqrt(metric[i]) times the rational one.
    configurations : tuple of Configuration
        In the order of the model file; the first one is the default.

    Examples
    --------
    >>> corners = tuple((Fraction(x), Fraction(y), Fraction(0)) for x in (0, 1, 2) for y in (0, 1))
    >>> robot = Robot("example", "6-UPS", "m", "made up", corners, corners)
    >>> robot.problem((4, 4, 4, 4, 4, "4.01")).legs[5].length_squared
    Fraction(401, 100)
    """

    name: str
    kind: str
    unit: str
    source: str
    base_joints: Joints
    platform_joints: Joints
    metric: Metric = UNIT_METRIC
    configurations: tuple[Configuration, ...] = ()

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InputError(f"kind: {shown(self.kind)} is unknown; use one of: {', '.join(KINDS)}")
        object.__setattr__(self, "base_joints", parse_joints(self.base_joints, "base.joints"))
        object.__setattr__(self, "platform_joints", parse_joints(self.platform_joints, "platform.joints"))
        object.__setattr__(self, "metric", parse_metric(self.metric))
        _refuse_equal_legs(self.base_joints, self.platform_joints)
        _refuse_equal_names(self.configurations)

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, kind={self.kind!r})"

    def configuration(self, name: str | None = None) -> Configuration:
        """The configuration called ``name``, or the first one if ``name`` is None."""
        if not self.configurations:
            raise InputError(f"configurations: {shown(self.name)} has none; give the six leg lengths instead")
        if name is None:
            return self.configurations[0]
        for configuration in self.configurations:
            if configuration.name == name:
                return configuration
        known = ", ".join(configuration.name for configuration in self.configurations[:_LISTED])
        more = ", ..." if len(self.configurations) > _LISTED else ""
        raise InputError(f"configuration: {shown(name)} is unknown; use one of: {known}{more}")

    def problem(self, lengths_squared: Sequence[Fraction | int | str]) -> ForwardProblem:
        """The forward kinematics problem for six squared leg lengths, exact and positive."""
        values = _six(lengths_squared, "lengths_squared")
        return ForwardProblem(KINDS[self.kind](self.base_joints, self.platform_joints, values), self.metric)


def parse_joints(rows: Sequence[object], where: str) -> Joints:
    """Six vectors of three rational numbers."""
    if len(rows) != LEGS:
        raise InputError(f"{where}: {len(rows)} rows; give {LEGS} joints of 3 coordinates, one per leg")
    return tuple(parse_vector(row, f"{where}[{i}]") for i, row in enumerate(rows, 1))


def parse_metric(row: object) -> Metric:
    """Three positive integers: the Gram diagonal. In place of p/q write p q, and divide that coordinate by q."""
    numbers = []
    for i, number in enumerate(parse_vector(row, "metric"), 1):
        if number <= 0 or number.denominator != 1:
            raise InputError(f"metric[{i}]: {shown(number)} is not a positive integer; give one such as 1 or 3")
        numbers.append(number.numerator)
    g1, g2, g3 = numbers
    return g1, g2, g3


def _refuse_equal_legs(base: Joints, platform: Joints) -> None:
    """Merged joints are legal (TSSM, MSSM robots); two legs between the same two points are one leg."""
    seen: dict[tuple[Vector, Vector], int] = {}
    for number, ends in enumerate(zip(base, platform, strict=True), 1):
        first = seen.setdefault(ends, number)
        if first != number:
            raise InputError(
                f"base.joints and platform.joints: legs {first} and {number} join the same two points; "
                "give each leg its own pair of joints"
            )


def _refuse_equal_names(configurations: tuple[Configuration, ...]) -> None:
    names: set[str] = set()
    for configuration in configurations:
        if configuration.name in names:
            raise InputError(f"configurations: the name {shown(configuration.name)} is used twice; rename one of them")
        names.add(configuration.name)

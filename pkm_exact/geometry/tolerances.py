"""Tolerances of a robot: how far its joints and lengths may be from the numbers in the model file."""

from __future__ import annotations

from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys
from pkm_exact.geometry.rational import parse_rational
from pkm_exact.wording import shown

_KEYS: Final = ("joints", "base", "platform", "lengths")


@dataclass(frozen=True)
class Tolerances:
    """Greatest errors of the data of a robot, in its unit of length.

    The robots within tolerance are those whose every datum differs from its nominal value by at most these numbers,
    each independently of all others: 7 data per leg, or 5 of a planar robot. Joint coordinates are ordinary ones,
    whatever the metric of the model; so the balls of these radii about the joints are within tolerance too. Legs that
    share a joint may differ in it, as the legs of a real robot do.

    Attributes
    ----------
    base, platform : Fraction
        Of every coordinate of a base joint (the knees, if there are cranks or slides) and of a platform joint.
    lengths : Fraction
        Of every leg length (of the rods, if there are cranks or slides).

    Examples
    --------
    >>> Tolerances(Fraction(1, 1000), Fraction(1, 1000), Fraction(0)).scaled(Fraction(1, 2)).base
    Fraction(1, 2000)
    """

    base: Fraction
    platform: Fraction
    lengths: Fraction

    def __post_init__(self) -> None:
        for field in fields(self):
            value = parse_rational(getattr(self, field.name), f"tolerances.{field.name}")
            if value < 0:
                raise InputError(f"tolerances.{field.name}: {shown(value)} is negative; give 0 or a positive number")
            object.__setattr__(self, field.name, value)
        if not any((self.base, self.platform, self.lengths)):
            raise InputError("tolerances: all are 0; give at least one that is positive")

    @staticmethod
    def uniform(value: Fraction | int | str) -> Tolerances:
        """The same tolerance for every datum.

        Examples
        --------
        >>> str(Tolerances.uniform("1/1000").lengths)
        '1/1000'
        """
        number = parse_rational(value, "tolerance")
        return Tolerances(number, number, number)

    def scaled(self, factor: Fraction) -> Tolerances:
        """All tolerances times a positive factor."""
        return Tolerances(self.base * factor, self.platform * factor, self.lengths * factor)


def read_tolerances(table: object) -> Tolerances:
    """The tolerances in the table of that name of a model file.

    Examples
    --------
    >>> read_tolerances({"joints": "1/1000", "lengths": "1/500"})
    Tolerances(base=Fraction(1, 1000), platform=Fraction(1, 1000), lengths=Fraction(1, 500))
    """
    if not isinstance(table, dict):
        raise InputError(f'tolerances: {shown(table)} is not a table; write [tolerances] and joints = "0.001" below it')
    known_keys(table, _KEYS, "tolerances")
    sides = [key for key in ("base", "platform") if key in table]
    if "joints" in table and sides:
        raise InputError(f"tolerances: joints and {sides[0]} given; give joints, or base and platform")
    values: dict[str, Any] = {key: table.get("joints", 0) for key in ("base", "platform")} | {"lengths": 0} | table
    values.pop("joints", None)
    return Tolerances(**values)

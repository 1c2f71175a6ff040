"""The mechanism with passive bodies as a certificate has it, and where its bodies stand, to be drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.certified_machine import certified_constraint
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric

FORMAT: Final = "pkm_exact links certificate"
Numbers = tuple[Fraction, Fraction, Fraction]


@dataclass(frozen=True)
class JoinedConstraint:
    """What holds the second of two bodies, seen from the first; the ground has number 0."""

    first: int
    second: int
    constraint: Constraint


@dataclass(frozen=True)
class BodyPlace:
    """Position and rotation matrix of a body, the middles of their certified bounds, and what these are off at most.

    All in the coordinates of the metric.
    """

    position: Numbers
    rotation: tuple[Numbers, Numbers, Numbers]
    half_width: Fraction


def joined_constraints(content: Mapping[str, Any]) -> tuple[JoinedConstraint, ...]:
    """The constraints of an accepted links certificate, with the bodies that they join."""
    return tuple(
        JoinedConstraint(entry["bodies"][0], entry["bodies"][1], certified_constraint(entry["constraint"]))
        for entry in content["mechanism"]["joined"]
    )


def assemblies(content: Mapping[str, Any]) -> Iterator[tuple[tuple[BodyPlace, ...], int | None]]:
    """The places of all bodies in each assembly of an accepted links certificate, and its multiplicity."""
    if content["system"] is None:
        box = content["box"]
        unit = Fraction(1, 1 << box["exponent"])
        centre, half = [int(text, 16) * unit for text in box["centre"]], box["radius"] * unit
        yield _places(content["mechanism"], [(value, half) for value in centre]), 1
        return
    for entry in content["system"]["solutions"]:
        bounds = [(Fraction(lo), Fraction(hi)) for lo, hi in entry["values"]]
        balls = [((lo + hi) / 2, (hi - lo) / 2) for lo, hi in bounds]
        yield _places(content["mechanism"], balls), entry["multiplicity"]


def _places(mechanism: Mapping[str, Any], balls: Sequence[tuple[Fraction, Fraction]]) -> tuple[BodyPlace, ...]:
    """The unknowns of all bodies one after the other, as docs/certificates-links.md has them."""
    metric = certified_metric(mechanism)
    unknowns, widths, found = (value for value, _ in balls), [half for _, half in balls], []
    for body in mechanism["bodies"]:
        motion = body["motion"]
        free = 0 if motion == "spherical" else 2 if mechanism["planar"] or motion == "planar" else 3
        x, y, z = [next(unknowns) for _ in range(free)] + [Fraction(0)] * (3 - free)
        found.append(BodyPlace((x, y, z), _rotation(motion, unknowns, metric), max(widths)))
    return tuple(found)


def certified_metric(mechanism: Mapping[str, Any]) -> Metric:
    """The Gram diagonal of a mechanism's coordinates."""
    x, y, z = map(int, mechanism.get("metric", UNIT_METRIC))
    return x, y, z


def _rotation(motion: str, unknowns: Iterator[Fraction], metric: Metric) -> tuple[Numbers, Numbers, Numbers]:
    zero, one = Fraction(0), Fraction(1)
    if motion in ("planar", "schoenflies"):
        c, s = next(unknowns), next(unknowns)
        return (c, -metric[1] * s, zero), (metric[0] * s, c, zero), (zero, zero, one)
    if motion == "translation":
        return (one, zero, zero), (zero, one, zero), (zero, zero, one)
    first, second, third = ((next(unknowns), next(unknowns), next(unknowns)) for _ in range(3))
    return first, second, third

"""Indices, polytopes, ellipsoid, forces and stiffness at a pose: asked by options, spelled for JSON and for people."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

import click

from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.poses.pose_spelling import ends
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.capability import ordinary_facets, ordinary_vertices
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix, shown_number
from pkm_exact.statics.failures_of_actuators import relative_manipulability
from pkm_exact.statics.forces import Forces, forces, moved_load
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.index_rows import STATICS_INDICES, enclosed_indices, unit_of
from pkm_exact.statics.largest_ellipsoid import LargestEllipsoid
from pkm_exact.statics.limits_of_actuators import ActuatorLimits
from pkm_exact.statics.measures import Measures
from pkm_exact.statics.stiffness import stiffness as stiffness_matrix

MOST_FAILURES: Final = 2


@dataclass(frozen=True)
class StaticsAnswers:
    """What was asked beyond the matrices.

    Attributes
    ----------
    measures : Measures or None
        None if there is no J.
    indices : dict of Interval
    refused : dict of str
        Why others have no value: indices, polytopes, ..
    polytopes : dict
        Velocity and wrench polytopes, by their names in JSON.
    ellipsoid, forces, stiffness
        None if not asked for, or refused.
    failures : dict
        r^2 by sets of failed actuators.
    """

    measures: Measures | None
    indices: dict[str, Interval]
    refused: dict[str, str]
    polytopes: dict[str, Any]
    ellipsoid: LargestEllipsoid | None = None
    forces: Forces | None = None
    stiffness: EnclosedMatrix | None = None
    failures: dict[tuple[int, ...], Any] | None = None

    def as_object(self) -> dict[str, Any]:
        """The same as JSON has it."""
        definitions = {index.name: index for index in STATICS_INDICES}
        names = () if self.measures is None else self.measures.freedom.at.actuated
        length = None if self.measures is None else self.measures.limits.length
        return {
            "length": None if length is None else str(length),
            "indices": {
                name: {
                    "value": ends(value),
                    "unit": unit_of(definitions[name], self.measures) if self.measures is not None else "",
                    "definition": definitions[name].definition,
                    "source": definitions[name].source,
                }
                for name, value in self.indices.items()
            },
            "velocity_polytope": _polytope(self.polytopes.get("velocity_polytope")),
            "wrench_polytope": _polytope(self.polytopes.get("wrench_polytope")),
            "ellipsoid": _ellipsoid(self.ellipsoid),
            "forces": _forces(self.forces),
            "stiffness": None if self.stiffness is None else self.stiffness.as_object(),
            "failures": None
            if self.failures is None
            else [
                {"failed": [names[index] for index in chosen], "r_squared": str(square)}
                for chosen, square in self.failures.items()
            ],
            "refused": self.refused,
        }

    def lines(self) -> list[str]:
        """The same for people."""
        found: list[str] = []
        if self.measures is not None and self.indices:
            length = self.measures.limits.length
            scale = "" if length is None else f", turns multiplied by the length {length}"
            found += ["", f"indices{scale}"]
            for index in STATICS_INDICES:
                if index.name in self.indices:
                    unit = unit_of(index, self.measures)
                    value = shown_number(self.indices[index.name])
                    found.append(f"{index.name:>15}  {value} {'' if unit == '1' else unit}".rstrip())
        for name, polytope in self.polytopes.items():
            found += ["", f"{name.replace('_', ' ')}: {len(polytope.vertices)} vertices, {len(polytope.facets)} facets"]
            found.append(f"volume {shown_number(polytope.volume)}")
        if self.ellipsoid is not None:
            axes = ", ".join(map(shown_number, self.ellipsoid.half_axes))
            found += ["", f"largest ellipsoid in the velocity polytope: half axes {axes}"]
        if self.forces is not None:
            kind = "" if self.forces.is_unique else ", those of least norm: there are others"
            found += ["", f"forces that bear the load, positive where they push{kind}"]
            for name, force in zip(self.forces.names, self.forces.values, strict=True):
                found.append(f"{name:>15}  {shown_number(force)}")
        if self.stiffness is not None:
            found += ["", "stiffness", str(self.stiffness)]
        if self.refused:
            found += ["", *(f"no {name}: {reason}" for name, reason in self.refused.items())]
        return found


def answers(
    at: AtPose, load: str | None, load_at: str | None, limits: Sequence[str], stiffness: str | None
) -> StaticsAnswers:
    """All that was asked for.

    Raises
    ------
    InputError
        If an option cannot be used at this pose.
    """
    given = given_limits(limits)
    if load_at is not None and load is None:
        raise click.UsageError("--load-at: belongs to --load, give that as well.")
    refused: dict[str, str] = {}
    measures = None
    if at.jacobian is not None:
        measures = Measures(Freedom(at), ActuatorLimits.of(given, len(at.actuated)))
    elif given or load is not None or stiffness is not None:
        raise InputError("--limits, --load, --stiffness: there is no J at this pose; give --model, or another pose")
    if measures is None:
        return StaticsAnswers(None, {}, refused, {})
    indices, refused = enclosed_indices(measures)
    polytopes = {
        "velocity_polytope": _tried("velocity_polytope", refused, lambda: _velocity(at, measures)),
        "wrench_polytope": _tried("wrench_polytope", refused, lambda: _wrenches(at, measures)),
    }
    return StaticsAnswers(
        measures,
        indices,
        refused,
        {name: found for name, found in polytopes.items() if found is not None},
        _tried("ellipsoid", refused, lambda: _largest(at, measures)),
        None if load is None else forces(at, _load(at, load, load_at)),
        None if stiffness is None else stiffness_matrix(measures.freedom, _stiffnesses(at, stiffness)),
        _tried("failures", refused, lambda: _failures(measures)),
    )


def _tried(name: str, refused: dict[str, str], ask: Callable[[], Any]) -> Any:
    """The answer; or None, and why there is none."""
    try:
        return ask()
    except PkmExactError as error:
        refused[name] = str(error)
        return None


def _velocity(at: AtPose, measures: Measures) -> Any:
    return at.velocity_polytope(measures.known("speeds"))


def _wrenches(at: AtPose, measures: Measures) -> Any:
    return at.wrench_polytope(measures.known("forces"), measures.limits.least_forces)


def _largest(at: AtPose, measures: Measures) -> Any:
    return at.ellipsoid(measures.known("speeds"), measures.limits.length)


def _failures(measures: Measures) -> Any:
    """r^2 of one failure where actuators are redundant and J is exact."""
    exact = measures.freedom.at.exact_jacobian
    if exact is None or len(exact) <= len(exact[0]) or measures.freedom.at.held.structural:
        return None
    found: dict[tuple[int, ...], Any] = {}
    for failed in range(1, min(MOST_FAILURES, len(exact) - len(exact[0])) + 1):
        found |= relative_manipulability(exact, failed)
    return found


def given_limits(words: Sequence[str]) -> dict[str, Any]:
    """What --limits denotes: KEY=NUMBER or KEY=NUMBER,NUMBER,.."""
    found: dict[str, Any] = {}
    for word in words:
        key, equals, values = word.partition("=")
        if not equals or not values:
            raise click.UsageError(f"--limits: {word!r} is not KEY=VALUES; write speeds=1/2 or forces=1,2,3.")
        if key in found:
            raise click.UsageError(f"--limits: {key} is given twice, give it once.")
        found[key] = [value.strip() for value in values.split(",")]
    return found


def _load(at: AtPose, text: str, where: str | None) -> list[Any]:
    """The load about the platform's origin, a component for each freedom."""
    from pkm_exact.cli.given_pose import numbers

    planar = at.motion.is_planar
    count = text.count(",") + 1
    wanted = (2, 3) if planar else (3, 6)
    if count not in wanted:
        raise click.UsageError(f"--load: {count} numbers given, {wanted[0]} or {wanted[1]} are needed between commas.")
    values = numbers(text, "--load", count)
    whole = [Fraction(0)] * 6
    places = (0, 1, 5) if planar else range(6)
    for place, value in zip(places, values, strict=False):
        whole[place] = value
    if where is not None:
        offset = numbers(where, "--load-at", 2 if planar else 3)
        whole = moved_load(whole, at.arm([*offset, Fraction(0)][:3]))
    for place, value in enumerate(whole):
        if place not in at.motion.twist and not (isinstance(value, Fraction) and value == 0):
            # Joints that are not declared bear it: the platform has no such motion.
            whole[place] = Fraction(0)
    return [whole[place] for place in at.motion.twist]


def _stiffnesses(at: AtPose, text: str) -> list[Fraction]:
    from pkm_exact.cli.given_pose import numbers

    count = text.count(",") + 1
    values = numbers(text, "--stiffness", count)
    if any(value <= 0 for value in values):
        raise click.UsageError("--stiffness: a number is not positive, give numbers greater than 0.")
    return values * len(at.actuated) if count == 1 else values


def _polytope(found: Any) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "vertices": [[ends(value) for value in vertex] for vertex in ordinary_vertices(found)],
        "facets": [
            {"normal": [ends(value) for value in normal], "offset": ends(offset), "vertices": list(facet.vertices)}
            for (normal, offset), facet in zip(ordinary_facets(found), found.facets, strict=True)
        ],
        "volume": ends(found.volume),
    }


def _ellipsoid(found: LargestEllipsoid | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "half_axes": [ends(axis) for axis in found.half_axes],
        "index": ends(found.index),
        "matrix": found.matrix.as_object(),
        "weights": list(map(str, found.weights)),
        "gap": ends(found.gap),
    }


def _forces(found: Forces | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "names": list(found.names),
        "values": [ends(value) for value in found.values],
        "signs": list(found.signs),
        "exact": None if found.exact is None else list(found.exact),
        "unique": found.is_unique,
    }

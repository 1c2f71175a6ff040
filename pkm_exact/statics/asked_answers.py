"""All that is asked about a machine at a pose: indices, polytopes, ellipsoid, forces and stiffness, or why not.

What cannot be said is in ``refused``, with its reason. Spelled for JSON and for people.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.poses.pose_spelling import ends
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.capability import ordinary_facets, ordinary_vertices
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix, shown_number
from pkm_exact.statics.failures_of_actuators import relative_manipulability
from pkm_exact.statics.forces import Forces
from pkm_exact.statics.forward_map import ForwardMap
from pkm_exact.statics.index_rows import STATICS_INDICES, enclosed_indices, unit_of
from pkm_exact.statics.largest_ellipsoid import LargestEllipsoid
from pkm_exact.statics.limits_of_actuators import ActuatorLimits
from pkm_exact.statics.measures import Measures
from pkm_exact.statics.pose_rows import TWIST, WRENCH
from pkm_exact.statics.redundant_kinematics import measures_of
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
    load : list or None
        What the forces bear.
    """

    measures: Measures | None
    indices: dict[str, Interval]
    refused: dict[str, str]
    polytopes: dict[str, Any]
    ellipsoid: LargestEllipsoid | None = None
    forces: Forces | None = None
    stiffness: EnclosedMatrix | None = None
    failures: dict[tuple[int, ...], Any] | None = None
    load: Sequence[Any] | None = None

    @property
    def _is_partial(self) -> bool:
        """Whether some components of a twist follow from others, as constraints are not actuated."""
        return self.measures is not None and len(self.measures.freedom.free.places) < len(
            self.measures.freedom.at.twist
        )

    def components(self, name: str) -> list[str]:
        """Which components of twists or wrenches the polytope of this name has."""
        if self.measures is None or not self.polytopes:
            return []
        names, freedom = TWIST if name == "velocity_polytope" else WRENCH, self.measures.freedom
        return [names[freedom.at.motion.twist[place]] for place in freedom.free.places]

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
            "polytope_components": self.components("velocity_polytope"),
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
            where = f" in {', '.join(self.components(name))}" if self._is_partial else ""
            size = f"{len(polytope.vertices)} vertices, {len(polytope.facets)} facets"
            found += ["", f"{name.replace('_', ' ')}{where}: {size}"]
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


def asked_answers(
    at: AtPose,
    limits: Mapping[str, Any],
    load: Sequence[Any] | None = None,
    stiffness: Sequence[Fraction] | None = None,
) -> StaticsAnswers:
    """All that can be said of a machine at a pose with these limits of its actuators.

    Parameters
    ----------
    at : AtPose
    limits : mapping
        As for ``statics.limits_of_actuators``: speeds, forces, length, ..
    load : sequence of numbers, optional
        About the platform's origin, a component for each freedom of the motion.
    stiffness : sequence of Fraction, optional
        Of each actuator.

    Examples
    --------
    >>> from pkm_exact import Robot
    >>> at = Robot.load("models/3-rpr-merlet-p.toml").at({"position": [5, "9/2"], "half_tangent": "1/3"})
    >>> found = asked_answers(at, {"speeds": ["1/5"]})
    >>> sorted(found.polytopes), found.refused["wrench_polytope"]
    (['velocity_polytope'], 'needs limits: forces')
    """
    if not at.held.actuators:
        return StaticsAnswers(None, {}, {}, {})
    try:
        measures = measures_of(at, ActuatorLimits.of(limits, len(at.actuated)))
    except InputError as error:
        if not at.is_forward or limits or load is not None or stiffness is not None:
            raise
        return StaticsAnswers(None, {}, {"forward": str(error)}, {})
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
        None if load is None else at.borne(load),
        None if stiffness is None else _stiffness(measures, stiffness),
        _tried("failures", refused, lambda: _failures(measures)),
        load,
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


def _stiffness(measures: Measures, stiffness: Sequence[Fraction]) -> EnclosedMatrix:
    forward: ForwardMap | None = measures.freedom.forward
    return stiffness_matrix(measures.freedom, stiffness) if forward is None else forward.stiffness(stiffness)


def _failures(measures: Measures) -> Any:
    """r^2 of one failure where actuators are redundant and J is exact."""
    exact = measures.freedom.at.exact_jacobian
    if exact is None or len(exact) <= len(exact[0]) or measures.freedom.at.held.structural:
        return None
    found: dict[tuple[int, ...], Any] = {}
    for failed in range(1, min(MOST_FAILURES, len(exact) - len(exact[0])) + 1):
        found |= relative_manipulability(exact, failed)
    return found


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

"""Certificates of version 2: any mechanism, as constraints, and the ways to completeness that version 1 does not have.

The format is described in ``docs/certificates-2.md``; its schema is ``certificate-2.schema.json`` in this folder.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.certificate_entries import (
    claim_entries,
    coefficients,
    pose_entries,
    representation_entry,
    steps_entry,
    texts,
)

if TYPE_CHECKING:
    from pkm_exact.completeness.infinity import PointsAtInfinity
    from pkm_exact.completeness.pose_slices import MorePoses
    from pkm_exact.constraints.constraint import Constraint
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.poses.pose_representation import PoseRepresentation
    from pkm_exact.poses.self_motion import SelfMotion
    from pkm_exact.solution import Solution

FORMAT: Final = "pkm_exact certificate"
VERSION: Final = 2


def constraints_content(machine: Machine, configuration_name: str | None, solution: Solution) -> dict[str, Any]:
    """The certificate of a solution without its digest; the solution must be one of the machine."""
    problem, proof = solution.problem, solution.completeness
    return {
        "format": FORMAT,
        "version": VERSION,
        "robot": {
            "name": machine.name,
            "unit": machine.unit,
            "source": machine.source,
            "motion": problem.motion.name,
            "metric": texts(problem.metric),
            "constraints": [constraint_entry(constraint, problem.metric) for constraint in problem.constraints],
        },
        "configuration": configuration_name,
        **claim_entries(solution),
        "infinity": None if proof is None or proof.infinity is None else infinity_entry(proof.infinity),
        "elimination": steps_entry(solution),
        "self_motion": _self_motion(solution),
        **pose_entries(solution),
    }


def constraint_entry(constraint: Constraint, metric: tuple[int, int, int]) -> dict[str, Any]:
    """A constraint with its data and the forms that follow from them.

    Examples
    --------
    >>> from pkm_exact.constraints.at_point import AtPoint
    >>> zero = (Fraction(0),) * 3
    >>> entry = constraint_entry(AtPoint(zero, zero, "ball joint"), (1, 1, 1))
    >>> list(entry), len(entry["forms"])
    (['name', 'type', 'point', 'platform', 'forms'], 3)
    """
    data = {field: getattr(constraint, field) for field in constraint.fields}
    parts = [form for square in constraint.squares(metric) for form in (square.linear, square.root)]
    return {
        "name": constraint.name,
        "type": constraint.type,
        **{field: str(value) if isinstance(value, Fraction) else texts(value) for field, value in data.items()},
        "forms": [texts(form) for form in (*constraint.forms(metric), *parts)],
    }


def infinity_entry(found: PointsAtInfinity) -> dict[str, Any]:
    """Points at infinity."""
    return {
        "chart": list(found.chart),
        "separating_form": list(found.univariate.form),
        "eliminant": coefficients(found.univariate.eliminant),
        "coordinates": [coefficients(numerator) for numerator in found.univariate.numerators],
        "multiplicity": found.multiplicity,
    }


def _self_motion(solution: Solution) -> dict[str, Any] | None:
    """Why the poses form a set of positive dimension, and whether the certificate proves a real motion."""
    from pkm_exact.claim import RealMotion
    from pkm_exact.completeness.pose_slices import MorePoses
    from pkm_exact.poses.self_motion import Cause, SelfMotion

    dependent = (Cause.DEPENDENT_LEGS, Cause.FEW, Cause.SIMILAR_ON_CONIC)
    motion = solution.self_motion
    if motion is None:
        return None
    if isinstance(motion, MorePoses):
        return _slices(motion, is_real=motion.real is RealMotion.PROVED)
    if isinstance(motion, SelfMotion):
        symmetric = any(cause not in dependent for cause in motion.mobility.causes)
        is_real = _is_real(motion, solution.problem, symmetric=symmetric)
        cause = "symmetry" if symmetric else "dependent-forms"
        return {"cause": cause, "real": is_real, "forms": [], "slices": []}
    return {"cause": "equal-legs", "real": True, "forms": [], "slices": []}


def _slices(motion: MorePoses, *, is_real: bool) -> dict[str, Any]:
    slices = [
        {"constant": str(found.constant), "representation": representation_entry(found.representation)}
        for found in motion.slices
    ]
    forms = [texts(form) for form in motion.forms]
    return {"cause": "more-poses-than-bound", "real": is_real, "forms": forms, "slices": slices}


def _is_real(motion: SelfMotion, problem: ForwardProblem, *, symmetric: bool) -> bool:
    """Whether a witness is real and, without a symmetry, no more freedoms are left there than the forms leave."""
    from pkm_exact.policy import Policy
    from pkm_exact.poses.singularity import are_isolated

    if not _has_real_root(motion.representation):
        return False
    free = problem.motion.dimension - motion.mobility.rank - len(problem.squares)
    return symmetric or are_isolated(motion.representation, problem, Policy(), further=free)


def _has_real_root(found: PoseRepresentation) -> bool:
    from pkm_exact.roots.isolation import real_root_enclosures

    return bool(real_root_enclosures(found.univariate.polynomial, 64))

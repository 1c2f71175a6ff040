"""The choice of a chart of rotations and of a separating form, tested modulo a prime."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import islice

from pkm_exact.algebra.rur import ModularRepresentation
from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.policy import Policy
from pkm_exact.poses.modular import Form, ModularPoses, candidate_charts, candidate_forms
from pkm_exact.poses.study_equations import Chart, free_coordinates


@dataclass(frozen=True)
class Parameters:
    """A chart that holds all poses, a form that separates them, and the representation modulo the first prime."""

    chart: Chart
    form: Form
    modular: ModularRepresentation


def choose_parameters(poses: ModularPoses, problem: ForwardProblem, policy: Policy) -> Parameters | None:
    """The first chart that misses no pose, and the first form that takes as many values as there are poses."""
    own = policy.seed_for(problem.digest, poses.algebra.prime)
    for chart in islice(candidate_charts(policy.seed, own), policy.attempts):
        coordinates = poses.coordinates(chart)
        if coordinates is None:
            continue
        count = poses.distinct_poses(coordinates, own)
        require(0 < count <= poses.count, "more distinct poses than poses", distinct=count, poses=poses.count)
        free = free_coordinates(chart, problem)
        forms = (form for form in candidate_forms(chart, policy.seed, own) if any(form[k] for k in free))
        for form in islice(forms, policy.attempts):
            modular = poses.representation(coordinates, form, free)
            if modular.degree == count:
                return Parameters(chart, form, modular)
    return None

"""The dual-quaternion formulation: Study coordinates with a normalised rotation part."""

from __future__ import annotations

from dataclasses import dataclass

from pkm_exact.formulations.acceptance import needs_all_motions
from pkm_exact.formulations.base import FormulatedProblem, PoseMap, over_integers, rational_ring
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import evaluate, motion_quadrics, pose_quadrics, pose_quartics

STUDY_UNKNOWNS = ("e0", "e1", "e2", "e3", "f0", "f1", "f2", "f3")


@dataclass(frozen=True)
class AFD6:
    """Dual quaternions.

    Unknowns e (rotation) and f (translation, see ``geometry.study``). Equations: the constraints as quadrics in (e, f),
    Study's condition e.f = 0, and N(e) = 1, which removes e = 0, a component of positive dimension. Each pose is met as
    (e, f) and -(e, f): 80 solutions.
    Source: Rolland 2008, section 4.1.6, equations (24) to (27), there of degree 4; Husty 1996.
    """

    code: str = "AFD6"
    title: str = "dual quaternion"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: all motions must be possible, constraints may be any."""
        return needs_all_motions(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns e0..e3, f0..f3."""
        _, x = rational_ring(STUDY_UNKNOWNS)
        products = [[left * right for right in x] for left in x]
        quadrics = motion_quadrics(problem.metric)
        norm = evaluate(quadrics[-1], products)
        condition, *equations = [evaluate(quadric, products) for quadric in pose_quadrics(problem)]
        for quartic in pose_quartics(problem):
            linear, root = (evaluate(quadric, products) for quadric in (quartic.linear, quartic.root))
            equations.append(quartic.value(linear, root, norm))
        equations += [condition, norm - 1]
        system = over_integers(STUDY_UNKNOWNS, equations)
        position = tuple(evaluate(quadric, products) for quadric in quadrics[4:7])
        pose_map = PoseMap(tuple(tuple(row[:4]) for row in products[:4]), position)
        return FormulatedProblem(self.code, system, pose_map, fibre=2, branches=(system,))

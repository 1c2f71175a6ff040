"""The six-point formulation: the unknowns are the positions of all platform joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import combinations, product

from pkm_exact.formulations.acceptance import needs_six_legs
from pkm_exact.formulations.base import Expression, FormulatedProblem, dot, over_integers, rational, rational_ring
from pkm_exact.formulations.platform import (
    PlatformFrame,
    Triple,
    edge_square,
    edge_vectors,
    platform_frame,
    pose_from_points,
)
from pkm_exact.geometry.problem import ForwardProblem

SIX_POINT_UNKNOWNS = tuple(f"{axis}{point}" for point in range(1, 7) for axis in "xyz")


@dataclass(frozen=True)
class AFP4:
    """Six points with distances.

    Equations: 6 legs |P_i - A_i|^2 = l_i^2, the 3 distances among three joints that are not collinear, and the
    distances of the other three joints from these: 18 quadrics in 18 unknowns.

    Distances do not tell a joint from its mirror image in the plane of the three. With
    w_k = P_k - P_1 - a_k v1 - b_k v2 the equations give w_k.v1 = w_k.v2 = 0 and |w_k|^2 = c_k^2 |v3|^2, and |v3|^2 is a
    constant other than 0, so that w_k = +-c_k v3. The solutions are therefore the union over the signs of those with
    the three equations w_k = +-c_k v3 joined, and this splitting is what is solved: 8 branches of 40 solutions each on
    a general robot, 320 in all. Only the branch of all plus signs is the rigid platform. Joints in the plane (c_k = 0)
    split nothing: there the mirror images coincide, and a branch counts once what the 18 quadrics count double.
    Source: Rolland 2008, section 4.2.4, equations (37) and (38).

    Attributes
    ----------
    triple : tuple of 3 int, optional
        The legs of the three joints, from 0; default the first three that are not collinear.
    """

    triple: Triple | None = None
    code: str = "AFP4"
    title: str = "positions of all six platform joints"

    def refusal(self, problem: ForwardProblem) -> str | None:
        """Why it cannot write the problem: it needs six legs."""
        return needs_six_legs(problem)

    def formulate(self, problem: ForwardProblem) -> FormulatedProblem:
        """The problem in the unknowns x1, y1, z1, ..., z6."""
        context, generators = rational_ring(SIX_POINT_UNKNOWNS)
        points = [list(generators[3 * i : 3 * i + 3]) for i in range(6)]
        frame = platform_frame(problem, self.triple)
        metric = [rational(g) for g in problem.metric]
        equations = []
        for point, leg in zip(points, problem.distances, strict=True):
            offset = [a - rational(b) for a, b in zip(point, leg.base, strict=True)]
            equations.append(dot(metric, offset, offset) - rational(leg.length_squared))
        others = [k for k in range(6) if k not in frame.legs]
        pairs = [*combinations(frame.legs, 2), *((i, k) for k in others for i in frame.legs)]
        for i, j in pairs:
            edge = [a - b for a, b in zip(points[i], points[j], strict=True)]
            equations.append(dot(metric, edge, edge) - edge_square(problem, i, j))
        system = over_integers(SIX_POINT_UNKNOWNS, equations)
        choices = [(1, -1) if frame.coordinates[k][2] != 0 else (1,) for k in others]
        branches = tuple(
            over_integers(SIX_POINT_UNKNOWNS, equations + self._chirality(problem, frame, points, others, signs))
            for signs in product(*choices)
        )
        mirrors = tuple(_mirrored(problem, frame, others, signs) for signs in list(product(*choices))[1:])
        first_three = [points[k] for k in frame.legs]
        pose_map = pose_from_points(problem, frame, first_three, context.constant(1))
        # With c_k = 0, w_k = t v3 and t^2 = 0: every solution stands twice.
        multiplicity = 2 ** choices.count((1,))
        return FormulatedProblem(
            self.code, system, pose_map, fibre=1, branches=branches, mirrors=mirrors, multiplicity=multiplicity
        )

    @staticmethod
    def _chirality(
        problem: ForwardProblem,
        frame: PlatformFrame,
        points: Sequence[Sequence[Expression]],
        others: Sequence[int],
        signs: Sequence[int],
    ) -> list[Expression]:
        """w_k - sign c_k v3, coordinate by coordinate."""
        metric = [rational(g) for g in problem.metric]
        first_three = [points[k] for k in frame.legs]
        v1, v2, v3 = edge_vectors(first_three, metric)
        equations = []
        for k, sign in zip(others, signs, strict=True):
            a, b, c = frame.coordinates[k]
            equations += [points[k][i] - first_three[0][i] - a * v1[i] - b * v2[i] - sign * c * v3[i] for i in range(3)]
        return equations


def _mirrored(
    problem: ForwardProblem, frame: PlatformFrame, others: Sequence[int], signs: Sequence[int]
) -> ForwardProblem:
    """The robot whose joints with a minus sign are mirrored in the plane of the triple: B - 2 c u3."""
    legs = list(problem.distances)
    for k, sign in zip(others, signs, strict=True):
        if sign < 0:
            shift = [2 * frame.coordinates[k][2] * value for value in frame.axes[2]]
            x, y, z = (
                b - Fraction(int(value.p), int(value.q)) for b, value in zip(legs[k].platform, shift, strict=True)
            )
            legs[k] = replace(legs[k], platform=(x, y, z))
    return replace(problem, constraints=tuple(legs))

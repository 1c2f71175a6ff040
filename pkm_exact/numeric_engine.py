"""The certified numeric engine: floating point finds all solutions, Krawczyk's operator proves them, counting the rest.

If 40 solutions (6 of a planar robot) are certified, they are all, by the refined theorem of Bezout; if the robot has
fewer finite ones, by a short proof (``completeness.short_proof``), such as exact points at infinity for the others. If
none closes, or some solutions are too close to each other, the exact engine answers instead, and says so.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Final, TypeAlias

from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.completeness.completeness_proof import CompletenessProof, goes_shortly
from pkm_exact.completeness.conditions import Conditions
from pkm_exact.completeness.short_proof import can_close, short_proof
from pkm_exact.engine import solve
from pkm_exact.errors import PkmExactError
from pkm_exact.failures.contradiction import attached, require
from pkm_exact.final_checks import consistent, require_all_consistent
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.nearby import from_home
from pkm_exact.numeric.poses import Approximations, Charted, approximations, certified_solutions, is_tracked, real_poses
from pkm_exact.numeric.poses_in_doubles import PosesInDoubles
from pkm_exact.numeric.seeds import has_seeds, seeds
from pkm_exact.numeric.start import StartSection
from pkm_exact.policy import Policy
from pkm_exact.poses.boxes import DEFAULT_WIDTH, exponent_for_width
from pkm_exact.poses.isolated_solutions import IsolatedSolutions
from pkm_exact.solution import Solution, Statistics
from pkm_exact.stages import Stages

Search: TypeAlias = tuple[str, Callable[[], Approximations | Charted | None]]
"""The name of a stage, and what finds solutions in it."""
ATTEMPTS: Final = 2
"""Times that all paths are tracked, each time along other paths, before the exact engine takes over."""
PATHS: Final = "path tracking"
NEIGHBOUR: Final = "Newton's method from a neighbour"
TEMPLATE: Final = "elimination template"
"""Stages in which floating point finds solutions."""
FORMULATION: Final = "AFD6"
"""The equations are those of the constraints and Study's condition in Study coordinates."""
FALLBACK_NOTE: Final = "the numeric engine did not"
"""How the note begins that says that the exact engine answered in its place."""


def solve_krawczyk(
    problem: ForwardProblem,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Callable[[str], None] | None = None,
    start: StartSection | None = None,
    near: Charted | None = None,
) -> Solution:
    """The answer to ``pkm_exact.solve_krawczyk``, which says what is asked and what is raised, as data only.

    What is found near the start's home already (``rows_together``) can be given.
    """
    policy, stages = policy or Policy(), Stages(progress)
    exponent_for_width(width)  # refuses what is no width before the work
    with attached(problem, stages, method="krawczyk", width=width, policy=policy):
        found = (
            _by_numbers(problem, width, policy, stages, _searches(problem, policy, stages, start, near))
            if is_tracked(problem)
            else None
        )
        if found is not None:
            return consistent(found)
    return solve_exactly_instead(problem, width=width, policy=policy, progress=progress)


def with_answers(rows: Sequence[Charted | None], width: Fraction, policy: Policy) -> list[Charted | None]:
    """Rows of ``rows_together`` with their answers, which pass the last gate together.

    If one of them does not, no row has an answer: each is solved by itself then, and says why.
    """
    known = [near for near in rows if near is not None and near.poses is not None]
    with suppress(PkmExactError):
        answers = {id(near): _answer(near, width, policy) for near in known}
        require_all_consistent([found for found in answers.values() if found is not None])
        return [near and replace(near, answer=answers.get(id(near))) for near in rows]
    return list(rows)


def _answer(near: Charted, width: Fraction, policy: Policy) -> Solution | None:
    """What becomes of a row, before the last gate."""
    return _by_numbers(near.problem, width, policy, Stages(), iter([(NEIGHBOUR, lambda: near)]))


def _by_numbers(
    problem: ForwardProblem, width: Fraction, policy: Policy, stages: Stages, searches: Iterator[Search]
) -> Solution | None:
    """The answer of the numeric engine, or None if it cannot certify all solutions."""
    degree, most = problem.solution_bound, -1
    for stage, find in searches:
        stages.enter(stage)
        try:
            found = find()
        except OverflowError:
            break
        if found is None:
            continue
        stages.enter("Krawczyk operator")
        system, isolated = certified_solutions(problem, found, stages.amount)
        count = isolated.count
        require(count <= degree, "more solutions than the variety of motions allows", certified=count, degree=degree)
        if count <= most:
            break  # another way finds no more: so it will be
        most = count
        proof = _proof(problem, count, policy, stages)
        if proof is not None:
            poses = found.poses if isinstance(found, Charted) else None
            return _solution((system, isolated, poses), proof, width, stages)
        if not can_close(Conditions.of(problem), policy):
            break
    stages.leave()
    return None


def _searches(
    problem: ForwardProblem, policy: Policy, stages: Stages, start: StartSection | None, near: Charted | None
) -> Iterator[Search]:
    """Ways to find all solutions, each with the name of its stage. What is certified does not depend on the way."""
    ways: list[Search] = []
    if near is not None:
        yield NEIGHBOUR, lambda: near
    elif start is not None:
        yield NEIGHBOUR, partial(from_home, problem, start)
    if start is not None:
        ways.append((PATHS, partial(approximations, problem, start, 0, stages.amount)))
    if has_seeds(problem):
        ways.insert(
            0 if start and start.has_long_paths else len(ways), (TEMPLATE, partial(seeds, problem, conjugates=False))
        )
    yield from ways
    for attempt in range(ATTEMPTS):
        yield PATHS, partial(approximations, problem, None, policy.seed * attempt, stages.amount)


def _proof(problem: ForwardProblem, count: int, policy: Policy, stages: Stages) -> CompletenessProof | None:
    """A proof that so many simple solutions are all, or None."""
    if count == problem.solution_bound:
        return CompletenessProof(CompletenessRoute.REFINED_BEZOUT, count)
    # That there is no pose at all is for the exact engine to prove: it has a claim for it.
    if not count or not goes_shortly(problem, policy):
        return None
    stages.enter("completeness")
    proof = short_proof(Conditions.of(problem), count, count, policy)
    return None if proof is None else CompletenessProof(proof.route, count, infinity=proof.infinity)


def solve_exactly_instead(
    problem: ForwardProblem,
    *,
    width: Fraction = DEFAULT_WIDTH,
    policy: Policy | None = None,
    progress: Callable[[str], None] | None = None,
) -> Solution:
    """What the exact engine finds, with a note that the numeric one did not suffice.

    Raises
    ------
    PkmExactError
        As ``pkm_exact.solve``.
    """
    exact = solve(problem, width=width, policy=policy, progress=progress)
    # How many solutions were certified depends on rounding, and so on the machine: it is not for a certificate.
    reason = (
        f"certify all of the {problem.solution_bound} solutions that would prove its list complete"
        if is_tracked(problem)
        else "start: it is for as many linear constraints as freedoms"
    )
    note = f"{FALLBACK_NOTE} {reason}; the exact engine answered instead"
    return replace(exact, notes=(*exact.notes, note))


def _solution(
    found: tuple[ChartSystem, IsolatedSolutions, PosesInDoubles | None],
    proof: CompletenessProof,
    width: Fraction,
    stages: Stages,
) -> Solution:
    """The answer when all solutions are certified; what doubles tell of the poses may be known already."""
    system, isolated, known = found
    stages.enter("boxes and Jacobians")
    isolated, exponent, poses = real_poses(system, isolated, width, known)
    stages.leave()
    return Solution(
        problem=system.problem,
        formulation=FORMULATION,
        method="krawczyk",
        claim=Claim.COMPLETE,
        completeness=proof,
        complex_solutions=isolated.count,
        distinct_solutions=isolated.count,
        representation=None,
        box_exponent=exponent,
        poses=poses,
        isolated=isolated,
        statistics=Statistics(seconds=dict(stages.seconds)),
    )

"""All formulations on one robot: one row each, its poses compared with those of the reference formulation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from pkm_exact.claim_wording import without_a_list
from pkm_exact.comparison.agreement import same_poses
from pkm_exact.comparison.row import Row, Status
from pkm_exact.comparison.worker import Outcome, run_apart
from pkm_exact.formulations.registry import checked_code, formulation_codes
from pkm_exact.geometry.problem import ForwardProblem


def compare_formulations(
    problem: ForwardProblem,
    codes: Sequence[str] | None = None,
    *,
    seconds: float | None = None,
    progress: Callable[[str], None] | None = None,
) -> tuple[Row, ...]:
    """One row for every formulation, in the order of the codes.

    Formulations run one after the other, each in a process of its own, so that their times compare. The reference is
    the default formulation; it is solved even if no row for it is asked.

    Parameters
    ----------
    problem : ForwardProblem
    codes : sequence of str, optional
        Codes of formulations, options allowed; default all.
    seconds : float, optional
        Time limit of each formulation; without it each may take for ever.
    progress : callable, optional
        Gets one line when a stage starts.

    Raises
    ------
    InputError
        If a code is unknown.
    """
    wanted = [checked_code(code) for code in codes] if codes is not None else list(formulation_codes())
    reference = formulation_codes()[0]
    runs = list(dict.fromkeys((reference, *wanted)))
    known = {}
    for number, code in enumerate(runs, 1):
        if progress is not None:
            progress(f"formulation {number} of {len(runs)}, {code}: start")
        known[code] = run_apart(problem, code, seconds, progress)
    return tuple(_compared(known[code], known[reference]) for code in dict.fromkeys(wanted))


def _without_poses(row: Row) -> str:
    return "it has no list of poses" if row.result is None else without_a_list(row.result.claim)


def _compared(outcome: Outcome, reference: Outcome) -> Row:
    """The row with its agreement decided, or with the reason why it is not."""
    row = outcome.row
    if row.status is not Status.DONE:
        return row
    if outcome.poses is None:
        return replace(row, reason=f"{_without_poses(row)}; nothing is compared")
    if reference.poses is None:
        why = reference.row.reason or _without_poses(reference.row)
        return replace(row, reason=f"there is nothing to compare with, for the reference {reference.row.code}: {why}")
    agrees = same_poses(outcome.poses, reference.poses)
    reason = "the boxes are too wide to tell which poses belong together" if agrees is None else None
    return replace(row, agrees=agrees, reason=reason)

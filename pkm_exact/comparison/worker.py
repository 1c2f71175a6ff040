"""One formulation in a process of its own, which can be ended when its time is over."""

from __future__ import annotations

from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from pkm_exact.comparison.measure import measure
from pkm_exact.comparison.row import ResultFigures, Row, Status, SystemFigures
from pkm_exact.errors import InputError, InternalError, PkmExactError
from pkm_exact.failures.failure_report import reported
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.poses.pose import Pose
from pkm_exact.processes import end_with_parent, messages, process_apart
from pkm_exact.stages import Amount, Progress, Relay, tell


@dataclass(frozen=True)
class Outcome:
    """A row whose agreement is not decided yet, and the real poses that decide it; None if they cannot be compared."""

    row: Row
    poses: tuple[Pose, ...] | None = None


def run_apart(problem: ForwardProblem, code: str, seconds: float | None, progress: Progress | None = None) -> Outcome:
    """The outcome of one formulation, measured in a new process that is killed after the given time."""
    with process_apart(_work, problem, code) as (receiver, process):
        return _outcome(receiver, process, code, seconds, progress or (lambda _: None))


def _outcome(receiver: Connection, process: Any, code: str, seconds: float | None, progress: Progress) -> Outcome:
    system: SystemFigures | None = None
    stage = "start"
    try:
        for message in messages(receiver, seconds):
            match message:
                case SystemFigures():
                    system = message
                case str():
                    stage = message
                    progress(f"{code}: {stage}")
                case Amount():
                    tell(progress, message)
                case Status() as status, str(reason):
                    return Outcome(Row(code, status, reason, system))
                case ResultFigures() as figures, tuple() as poses:
                    compared = None if figures.real_poses is None else poses
                    return Outcome(Row(code, Status.DONE, None, system, figures), compared)
    except TimeoutError:
        reason = f"it did not end within {seconds:g} seconds; it was at the stage: {stage}"
        return Outcome(Row(code, Status.TIMEOUT, reason, system))
    except EOFError:
        process.join()
    reason = f"its process ended with code {process.exitcode} at the stage: {stage}"
    return Outcome(Row(code, Status.NO_ANSWER, reason, system))


def _work(sender: Connection, problem: ForwardProblem, code: str) -> None:
    """What the process does: messages on the way, and at the end figures and poses or a sentence."""
    end_with_parent()
    try:
        sender.send(measure(problem, code, written=sender.send, progress=Relay(sender.send)))
    except InputError as error:
        sender.send((Status.NOT_APPLICABLE, str(error)))
    except InternalError as error:
        sender.send((Status.NO_ANSWER, reported(error)))
    except PkmExactError as error:
        sender.send((Status.NO_ANSWER, str(error)))
    except MemoryError:
        sender.send((Status.NO_ANSWER, "the memory is exhausted"))
    except Exception as error:
        sender.send((Status.NO_ANSWER, reported(error)))

"""A certified engine with a time limit, and the uncertified answer if it does not keep to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from io import BytesIO
from multiprocessing.connection import Connection
from multiprocessing.reduction import ForkingPickler
from typing import Any, Final

from flint import fmpq, fmpq_mat, fmpz, fmpz_mat, fmpz_poly

from pkm_exact.errors import InternalError, PkmExactError
from pkm_exact.failures.failure_report import internal_error
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.levenberg_marquardt import solve_levenberg_marquardt
from pkm_exact.numeric.numeric_mechanism import numeric_machine
from pkm_exact.numeric.uncertified import UncertifiedSolution
from pkm_exact.processes import end_with_parent, messages, process_apart
from pkm_exact.solution import Solution
from pkm_exact.stages import Relay, Relayed


def solve_within(
    engine: Callable[..., Solution],
    problem: ForwardProblem,
    seconds: float,
    *,
    progress: Callable[[str], None] | None = None,
) -> Solution | UncertifiedSolution:
    """The solution of a certified engine; if it does not end in time, poses by Levenberg-Marquardt, uncertified.

    The engine runs in a process of its own, which is killed when the time is over.

    Parameters
    ----------
    engine : callable
        Takes the problem and ``progress``; a function of a module, with options bound by ``functools.partial``.
    problem : ForwardProblem
    seconds : float
        Time limit by the clock on the wall, the start of the process included.
    progress : callable, optional
        Gets one line when a stage starts.

    Raises
    ------
    PkmExactError
        What the engine raises; or that its process came to an end without an answer.
    InputError
        If a number of the robot is out of reach of floating point.
    """
    numeric_machine(problem)  # what floating point cannot hold is refused before the time is spent
    relayed = Relayed(progress)
    with process_apart(_work, engine, problem) as (receiver, process):
        try:
            solution: Solution = relayed.outcome(messages(receiver, seconds))
            return solution
        except TimeoutError:
            pass
        except EOFError:
            process.join()
            raise PkmExactError(relayed.ended(process.exitcode)) from None
    return _fallback(problem, seconds, relayed.stage)


def _fallback(problem: ForwardProblem, seconds: float, stage: str) -> UncertifiedSolution:
    found = solve_levenberg_marquardt(problem)
    note = (
        f"the certified engine did not end within the time limit of {seconds:g} seconds (stage: {stage}); these poses "
        "are an uncertified answer in its place: some may be missing, and some may be none"
    )
    return replace(found, notes=(note, *found.notes))


def _work(sender: Connection, engine: Callable[..., Solution], problem: ForwardProblem) -> None:
    """What the process does: the names of stages on the way, and at the end a solution or an exception."""
    end_with_parent()
    try:
        sender.send_bytes(_packed(engine(problem, progress=Relay(sender.send))))
    except InternalError as error:
        sender.send(internal_error(error))
    except (PkmExactError, MemoryError) as error:
        sender.send(error)
    except Exception as error:
        sender.send(internal_error(error))


def _packed(solution: Solution) -> bytes:
    """What ``Connection.send`` would send, but able to hold exact FLINT values."""
    stream = BytesIO()
    _ExactPickler(stream).dump(solution)
    return stream.getvalue()


class _ExactPickler(ForkingPickler):
    """Takes of a dataclass its fields, not what it keeps for later use beside them, and of FLINT what is listed."""

    def reducer_override(self, value: object) -> Any:
        arguments = _ARGUMENTS.get(type(value))
        if arguments is not None:
            return type(value), arguments(value)
        if is_dataclass(value) and not isinstance(value, type):
            # A class that says what copies have is asked.
            own: Any = value.__getstate__() if "__getstate__" in type(value).__dict__ else {}
            names = [field.name for field in fields(value) if field.init]
            return type(value), tuple(own[name] if name in own else getattr(value, name) for name in names)
        return NotImplemented


_ARGUMENTS: Final[dict[type, Callable[[Any], tuple[Any, ...]]]] = {
    fmpz: lambda value: (int(value),),
    fmpq: lambda value: (int(value.p), int(value.q)),
    fmpz_poly: lambda value: ([int(coefficient) for coefficient in value.coeffs()],),
    fmpz_mat: lambda value: (value.nrows(), value.ncols(), value.entries()),
    fmpq_mat: lambda value: (value.nrows(), value.ncols(), value.entries()),
}
"""What the constructor of an exact FLINT type takes to make the value again."""

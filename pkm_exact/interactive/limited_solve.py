"""Solving a polynomial system in a process of its own, which is ended when its time is over or its memory used up."""

from __future__ import annotations

import os
from dataclasses import fields
from fractions import Fraction
from multiprocessing.connection import Connection
from typing import Any

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.errors import InternalError, PkmExactError, UnexpectedError
from pkm_exact.interactive.system_answers import SystemSolution, solve_system
from pkm_exact.processes import end_in_order, end_with_parent, messages, process_apart
from pkm_exact.stages import Progress, Relay, Relayed

_Terms = list[dict[tuple[int, ...], int]]


def solve_within_limits(
    system: PolynomialSystem,
    *,
    seconds: float | None,
    megabytes: int | None,
    width: Fraction,
    oracle: str = "internal",
    progress: Progress | None = None,
) -> SystemSolution:
    """As ``solve_system``, within a time by the clock on the wall and an amount of memory.

    Raises
    ------
    PkmExactError
        What the engine raises; or that a limit was reached, or its process ended without an answer.
    """
    terms = [{tuple(map(int, key)): int(value) for key, value in f.to_dict().items()} for f in system.polynomials]
    with process_apart(_work, system.unknowns, terms, megabytes, width, oracle) as (receiver, process):
        relayed = Relayed(progress)
        try:
            return SystemSolution(system=system, **relayed.outcome(messages(receiver, seconds)))
        except MemoryError:
            raise _out_of_memory(megabytes, relayed.stage) from None
        except TimeoutError:
            raise PkmExactError(
                f"not solved within the time limit of {seconds:g} seconds (stage: {relayed.stage}); give it more"
            ) from None
        except EOFError:
            process.join()
            if megabytes is not None and process.exitcode:
                raise _out_of_memory(megabytes, relayed.stage) from None
            raise PkmExactError(relayed.ended(process.exitcode)) from None


def _out_of_memory(megabytes: int | None, stage: str) -> PkmExactError:
    limit = "" if megabytes is None else f" of {megabytes} MB"
    return PkmExactError(f"the memory{limit} does not suffice (stage: {stage}); give it more, or a smaller system")


def _work(
    sender: Connection, unknowns: tuple[str, ...], terms: _Terms, megabytes: int | None, width: Fraction, oracle: str
) -> None:
    """What the process does: the names of stages on the way, and at the end what was found, or an exception."""
    end_with_parent()
    end_in_order()
    try:
        if megabytes is not None:
            _limit_memory(megabytes)
        ring = polynomial_ring(unknowns)
        system = PolynomialSystem(unknowns, tuple(ring.from_dict(polynomial) for polynomial in terms))
        found = solve_system(system, width=width, oracle=oracle, progress=Relay(sender.send))
        content: dict[str, Any] = {entry.name: getattr(found, entry.name) for entry in fields(found)}
        del content["system"]
        sender.send(content)
    except InternalError as error:
        sender.send(PkmExactError(str(error)))
    except (PkmExactError, MemoryError) as error:
        sender.send(error)
    except Exception as error:
        sender.send(UnexpectedError(f"{type(error).__name__}: {error}"))


def _limit_memory(megabytes: int) -> None:
    """From here on the process gets no more memory than this, where the system can say so."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for stream in (1, 2):  # FLINT writes lines of its own before it ends the process
        os.dup2(nowhere, stream)

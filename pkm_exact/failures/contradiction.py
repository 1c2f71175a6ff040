"""What a step must find, if the program is right: or else an exception with the facts, and never an answer.

``require`` is called where mathematics restricts the result of a step, and costs next to nothing there. The engines
join what they were computing (``attached``); the command line writes all of it to a file to send (``failure_report``).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.errors import InputError, InternalContradictionError

if TYPE_CHECKING:
    from pkm_exact.constraints.constraint import Constraint
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.stages import Stages

CIRCUMSTANCES: Final = "pkm_exact_circumstances"
"""The attribute of an exception that says in plain JSON values what was being computed."""


def require(condition: object, sentence: str, **facts: object) -> None:
    """Go on only if a condition holds that cannot fail in a correct program.

    Parameters
    ----------
    condition : object
        Something true or false.
    sentence : str
        What is wrong if it does not hold.
    facts
        The numbers that show it.

    Raises
    ------
    InternalContradictionError
        If it does not hold.

    Examples
    --------
    >>> require(16 % 2 == 0, "the solutions that are not real come in pairs", count=16)
    """
    if not condition:
        raise InternalContradictionError(sentence, facts)


@contextmanager
def attached(problem: ForwardProblem, stages: Stages, **options: object) -> Iterator[None]:
    """Join to an exception that leaves the block which problem was being solved, how, and at which stage.

    The innermost block counts.
    """
    try:
        yield
    except InputError:
        raise
    except Exception as error:
        attach(error, problem, stage=stages.current, options={name: str(value) for name, value in options.items()})
        raise


def attach(error: Exception, problem: ForwardProblem, **more: object) -> None:
    """Join the problem, and more in plain JSON values, to an exception that has no problem yet."""
    if not hasattr(error, CIRCUMSTANCES):
        setattr(error, CIRCUMSTANCES, {"problem": _spelled(problem), **more})


def _spelled(problem: ForwardProblem) -> dict[str, Any]:
    """The problem, exactly, in plain JSON values."""
    frame = {"metric": [str(g) for g in problem.metric], "motion": problem.motion.name}
    if not problem.has_only_distances:
        return {**frame, "constraints": [_constraint(found) for found in problem.constraints]}
    return {
        **frame,
        "base": [[str(value) for value in leg.base] for leg in problem.distances],
        "platform": [[str(value) for value in leg.platform] for leg in problem.distances],
        "lengths_squared": [str(leg.length_squared) for leg in problem.distances],
    }


def _constraint(found: Constraint) -> dict[str, Any]:
    """Its type, name and fields."""
    values = {name: getattr(found, name) for name in found.fields}
    spelled = {key: list(map(str, x)) if isinstance(x, tuple) else str(x) for key, x in values.items()}
    return {"type": found.type, "name": found.name, **spelled}

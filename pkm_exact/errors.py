"""The exceptions of pkm_exact: one family, each message a sentence that says what to do."""

from __future__ import annotations

from typing import Any


class PkmExactError(Exception):
    """Base class of every error that pkm_exact raises on purpose.

    Examples
    --------
    >>> issubclass(InputError, PkmExactError)
    True
    """


class InputError(PkmExactError):
    """Input that cannot be used: names the file, the field, the value and the remedy.

    Examples
    --------
    >>> from pkm_exact import read_robot
    >>> try:
    ...     read_robot("nowhere.toml")
    ... except InputError as error:
    ...     print(error)
    nowhere.toml: no such file; give the path of a model file
    """


class ReconstructionError(PkmExactError):
    """A lift from modular images did not settle within the limits of the policy."""


class InternalError(PkmExactError):
    """Something that a correct program never does; no answer is given (``failures``).

    Attributes
    ----------
    facts : dict
        What was found, by name: numbers and texts.
    """

    def __init__(self, sentence: str, facts: dict[str, Any] | None = None) -> None:
        super().__init__(sentence)
        self.facts = dict(facts or {})


class InternalContradictionError(InternalError):
    """Two steps of an engine disagree."""


class UnexpectedError(InternalError):
    """An exception that nobody raised on purpose."""

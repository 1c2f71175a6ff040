"""Which stage a solve is in, how far it has come, and what each has cost."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any, TypeAlias


@dataclass(frozen=True)
class Amount:
    """How much of a stage is done.

    Attributes
    ----------
    done : int
    total : int or None
        All there is to do, as far as it is known.
    unit : str
        What is counted.
    bound : {"", "about", "at least"}
        What ``total`` is: a number that is known, an estimate, or one that may still grow.
    detail : str
        What else there is to say.

    Examples
    --------
    >>> print(Amount(1200, 5300, "bits", "about"))
    1200 of about 5300 bits
    >>> print(Amount(3, None, "matrices", detail="degree 7"))
    3 matrices, degree 7
    """

    done: int
    total: int | None
    unit: str
    bound: str = ""
    detail: str = ""

    def __str__(self) -> str:
        of = "" if self.total is None else f" of {self.bound} {self.total}" if self.bound else f" of {self.total}"
        return f"{self.done}{of} {self.unit}{', ' if self.detail else ''}{self.detail}"


Progress: TypeAlias = Callable[[str], None]
"""Gets the name of a stage when it starts; if it has a method ``amount``, that gets how much of it is done."""
Watch: TypeAlias = Callable[[Amount], None]


def tell(progress: Progress | None, amount: Amount) -> None:
    """Say how much is done to a progress that wants to know; others get names of stages only."""
    watch: Watch | None = getattr(progress, "amount", None)
    if watch is not None:
        watch(amount)


@dataclass(frozen=True)
class Relay:
    """A progress in another process: what it gets is sent, names of stages as text and amounts as they are."""

    send: Callable[[object], None]

    def __call__(self, stage: str) -> None:
        self.send(stage)

    def amount(self, amount: Amount) -> None:
        """Send how much is done."""
        self.send(amount)


@dataclass
class Relayed:
    """The other end of a relay: tells a progress here what a progress in another process was told.

    Attributes
    ----------
    progress : Progress or None
    stage : str
        The last one that was announced.

    Examples
    --------
    >>> relayed = Relayed(print)
    >>> relayed.outcome(["boxes", Amount(1, 2, "boxes"), {"poses": 4}]), relayed.stage
    boxes
    ({'poses': 4}, 'boxes')
    """

    progress: Progress | None
    stage: str = "start"

    def outcome(self, messages: Iterable[object]) -> Any:
        """The first message that is neither the name of a stage nor an amount; it is raised if it is an exception."""
        for message in messages:
            if isinstance(message, BaseException):
                raise message
            if isinstance(message, Amount):
                tell(self.progress, message)
            elif isinstance(message, str):
                self.stage = message
                if self.progress is not None:
                    self.progress(message)
            else:
                return message
        raise EOFError

    def ended(self, code: object) -> str:
        """What is said of a process that ended without an outcome."""
        return f"the process of the engine ended with code {code} at the stage: {self.stage}"


@dataclass(frozen=True)
class Prefixed:
    """A progress that passes everything on, the names of stages behind a text."""

    progress: Progress
    prefix: str

    def __call__(self, stage: str) -> None:
        self.progress(f"{self.prefix}{stage}")

    def amount(self, amount: Amount) -> None:
        """Pass on how much is done."""
        tell(self.progress, amount)


@dataclass
class Stages:
    """Announces stages and measures them.

    Attributes
    ----------
    progress : callable or None
        Gets the name of a stage when it starts; if it has a method ``amount``, that gets how much of it is done.
    seconds : dict of str to float
        Time of each stage that has ended.
    """

    progress: Progress | None = None
    seconds: dict[str, float] = field(default_factory=dict)
    _current: tuple[str, float] | None = None

    @property
    def current(self) -> str | None:
        """The stage that has been entered last and not been left."""
        return None if self._current is None else self._current[0]

    def enter(self, stage: str) -> None:
        """Leave the current stage, if any, and start another."""
        self.leave()
        self._current = (stage, perf_counter())
        if self.progress is not None:
            self.progress(stage)

    def amount(self, amount: Amount) -> None:
        """So much of the current stage is done."""
        tell(self.progress, amount)

    def leave(self) -> None:
        """The current stage has ended."""
        if self._current is not None:
            stage, start = self._current
            self.seconds[stage] = self.seconds.get(stage, 0.0) + perf_counter() - start
            self._current = None

"""Which stage a solve is in, and what each has cost."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import perf_counter


@dataclass
class Stages:
    """Announces stages and measures them.

    Attributes
    ----------
    progress : callable or None
        Gets the name of a stage when it starts.
    seconds : dict of str to float
        Time of each stage that has ended.
    """

    progress: Callable[[str], None] | None = None
    seconds: dict[str, float] = field(default_factory=dict)
    _current: tuple[str, float] | None = None

    def enter(self, stage: str) -> None:
        """Leave the current stage, if any, and start another."""
        self.leave()
        self._current = (stage, perf_counter())
        if self.progress is not None:
            self.progress(stage)

    def leave(self) -> None:
        """The current stage has ended."""
        if self._current is not None:
            stage, start = self._current
            self.seconds[stage] = self.seconds.get(stage, 0.0) + perf_counter() - start
            self._current = None

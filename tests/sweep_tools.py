"""Solvers that sweeps are tested with, in a module of their own: each worker process loads it, and little else."""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass, replace
from pathlib import Path

from samples import solved

from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.poses import Charted
from pkm_exact.solution import Solution


@dataclass(frozen=True)
class Quick(RowSolver):
    """Answers a problem without solving it, to test what is around."""

    def solution(self, problem: ForwardProblem, _near: Charted | None = None) -> Solution:
        return replace(solved("3-rpr-merlet-p"), problem=problem)


@dataclass(frozen=True)
class Deadly(Quick):
    """Kills its process at one length vector; at another one, only if the file is not there yet."""

    folder: str = ""

    def solution(self, problem: ForwardProblem, _near: Charted | None = None) -> Solution:
        first = problem.distances[0].length_squared
        once = Path(self.folder) / "once"
        if first == 13**2 or (first == 11**2 and not once.exists()):
            if first == 11**2:
                once.write_text("seen")
            os.kill(os.getpid(), signal.SIGKILL)
        return super().solution(problem)


@dataclass(frozen=True)
class Unloadable(Quick):
    """Cannot be sent to another process."""

    def __setstate__(self, state: object) -> None:
        os._exit(7)

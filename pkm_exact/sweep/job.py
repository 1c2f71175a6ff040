"""What a sweep does with each row: everything that the answer depends on, in one object that processes can be sent."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from hashlib import sha256
from itertools import islice
from pathlib import Path
from typing import Final

import pkm_exact
from pkm_exact.batch.row_solver import RowSolver
from pkm_exact.certify.build import certificate_bytes
from pkm_exact.errors import InputError, InternalError, PkmExactError
from pkm_exact.failures.failure_report import internal_error
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Robot
from pkm_exact.numeric.poses import Charted
from pkm_exact.policy import Policy
from pkm_exact.sweep.asked_indices import AskedIndices
from pkm_exact.sweep.lengths import LengthRow, LengthsFile, problem_of, robot_at
from pkm_exact.sweep.record import error_line, solution_line

FIRST_ROWS: Final = 256
"""Rows at the beginning of a file whose lengths say where the start section is put."""


@dataclass(frozen=True)
class Answer:
    """What is found for one row.

    Attributes
    ----------
    number : int
        Of the row.
    line : bytes
        Of the output.
    certificate : bytes or None
        If certificates are wanted and the row has one.
    """

    number: int
    line: bytes
    certificate: bytes | None = None


@dataclass(frozen=True)
class SweepJob:
    """How the rows of a file are answered.

    Attributes
    ----------
    robot : Robot
    names : tuple of str
        Of the columns.
    solver : RowSolver
    squared : bool
        Whether rows have squared lengths.
    certificates : bool
        Whether certificates are wanted, not only their digests.
    indices : AskedIndices or None
        What else is wanted at each pose.
    joints : bool
        Whether rows have joint values, as those of cranks and slides.
    table : bool
        Whether the output is a table; poses have their angles in degrees as well then.
    """

    robot: Machine
    names: tuple[str, ...]
    solver: RowSolver
    squared: bool
    certificates: bool
    indices: AskedIndices | None = None
    joints: bool = False
    table: bool = False

    def answers(self, rows: Sequence[LengthRow]) -> Iterator[Answer]:
        """The answers to some rows, in their order; what can be is found of all of them at once."""
        known = self._known(rows) if len(rows) > 1 else {}
        for row in rows:
            yield self.answer(row, known.pop(row.number, None))

    def _known(self, rows: Sequence[LengthRow]) -> dict[int, Charted]:
        """What is found at once; nothing, whatever happens: rows are solved by themselves then."""
        problems: dict[int, ForwardProblem] = {}
        with suppress(Exception):
            for row in rows:
                with suppress(PkmExactError):
                    robot, name = robot_at(self.robot, row, self.names) if self.joints else (self.robot, None)
                    problems[row.number] = _problem(robot, name, row, self.names, squared=self.squared)
            near = self.solver.near(list(problems.values()))
            return {number: found for number, found in zip(problems, near, strict=True) if found is not None}
        return {}

    def answer(self, row: LengthRow, near: Charted | None = None) -> Answer:
        """The answer to a row, whatever happens on the way: the other rows are not affected."""
        try:
            robot, name = robot_at(self.robot, row, self.names) if self.joints else (self.robot, None)
            problem = _problem(robot, name, row, self.names, squared=self.squared) if near is None else near.problem
            solution = self.solver.solution(problem, near)
            data = certificate_bytes(robot, name, solution)
            line = solution_line(row, robot, name, solution, data, self.indices, degrees=self.table)
            return Answer(row.number, line, data if self.certificates else None)
        except InternalError as error:
            sentence = _internal(error)
        except InputError as error:
            sentence = str(error)
        except PkmExactError as error:
            sentence = f"no answer: {error}"
        except MemoryError:
            sentence = "no answer: the memory is exhausted; solve this row by itself"
        except Exception as error:
            sentence = _internal(error)
        return Answer(row.number, error_line(row, sentence))


def _problem(
    robot: Machine, name: str | None, row: LengthRow, names: tuple[str, ...], *, squared: bool
) -> ForwardProblem:
    return problem_of(robot, row, names, squared=squared) if name is None else robot.problem(robot.configuration(name))


def _internal(error: Exception) -> str:
    return f"no answer: internal error: {internal_error(error)}; solve this row by itself for a report to send"


def sweep_job(
    robot: Machine,
    lengths: LengthsFile,
    *,
    method: str,
    width: Fraction,
    policy: Policy,
    squared: bool,
    certificates: bool,
    indices: AskedIndices | None = None,
    joints: bool = False,
    table: bool = False,
) -> SweepJob:
    """The job for a file. The start section is that of the first rows, however many are solved by whom."""
    problems = list(_problems(robot, lengths, squared=squared, joints=joints)) if method == "krawczyk" else []
    solver = RowSolver.of(problems, width, policy, method)
    return SweepJob(robot, lengths.names, solver, squared, certificates, indices, joints, table)


def _problems(robot: Machine, lengths: LengthsFile, *, squared: bool, joints: bool) -> Iterable[ForwardProblem]:
    """Those of the first rows that pose one."""
    for row in islice(lengths.rows(), FIRST_ROWS):
        try:
            at, name = robot_at(robot, row, lengths.names) if joints else (robot, None)
            yield _problem(at, name, row, lengths.names, squared=squared)
        except InputError:
            continue


def identity(job: SweepJob, lengths: LengthsFile, certificates: Path | None) -> str:
    """A digest of all that the output depends on. The start section is no part of it: answers do not depend on it."""
    folder = None if certificates is None else os.path.realpath(certificates)
    robot = job.robot
    joints = (robot.kind, robot.metric, *_geometry(robot))
    words = (pkm_exact.__version__, robot.name, robot.unit, robot.source, joints, lengths.digest)
    options: tuple[object, ...] = (job.solver.method, job.solver.width, job.solver.policy, job.squared, folder)
    if job.indices is not None:
        options = (*options, job.indices)
    if job.joints:
        options = (*options, "joints")
    if job.table:
        options = (*options, "table")
    return sha256(repr((words, options)).encode()).hexdigest()


def _geometry(robot: Machine) -> tuple[object, ...]:
    """What the poses of a robot depend on beside its metric and its values."""
    if isinstance(robot, Robot):
        return robot.base_joints, robot.platform_joints, robot.written_digit, *robot.chains
    return (robot,)

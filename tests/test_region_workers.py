"""However the parts of a region are shared out, and whichever task is done first, their pavings are the same."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from typing import Any

import pytest
from samples import model

from pkm_exact.regions import paving_tasks
from pkm_exact.regions.paving import Part, Paved
from pkm_exact.regions.paving_tasks import PartsInOrder, Task, done
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_legs import region_machine
from pkm_exact.regions.region_question import RegionQuestion
from pkm_exact.regions.region_solver import PreparedQuestion, answered, pave_part, prepared

SQUARE = "[region]\nposition = [[0, 12], [-2, 10]]\ndegrees = 0\n[conditions]\nreachable = true\n[answer]\n"
QUESTIONS = {
    "map": f"{SQUARE}kind = 'map'\nsteps = 9\n",
    "more undecided than allowed": f"{SQUARE}kind = 'map'\nsteps = 14\nboxes = 20\n",
    "all": f"{SQUARE}kind = 'all'\nsteps = 14\n",
}
PARTS = (Part(0, (0, 0)), Part(2, (1, 1)), Part(3, (3, 0)))


class _Future:
    def __init__(self, work: Callable[[], Any]) -> None:
        self.result, self.called = work, list[Callable[[Any], object]]()

    def add_done_callback(self, fn: Callable[[Any], object], /) -> None:
        self.called.append(fn)


class _Processes:
    """Tasks done in any order, all before a paving is asked for."""

    def __init__(self, ready: PreparedQuestion, failing: int = -1) -> None:
        self.ready, self.failing = ready, failing
        self.sent, self.tasks = list[_Future](), list[Task]()

    def paved(self, parts: Sequence[Part]) -> list[Paved]:
        chosen = random.Random(5)
        pavings = PartsInOrder(self.ready, parts, self.submit, processes=3, room=7)
        while self.sent:
            future = self.sent.pop(chosen.randrange(len(self.sent)))
            future.called[0](future)
        return list(pavings)

    def submit(self, task: Task, _: int) -> _Future:
        number = len(self.tasks)
        self.tasks.append(task)
        self.sent.append(_Future(lambda: self.do(number)))
        return self.sent[-1]

    def do(self, number: int) -> Any:
        if number == self.failing:
            raise RuntimeError("a process has ended")
        return done(self.ready, self.tasks[number])


def _ready(name: str) -> PreparedQuestion:
    machine = region_machine(model("3-rrr"))
    return prepared(machine, question_from_toml(QUESTIONS[name], machine))


@pytest.fixture
def small_tasks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(paving_tasks, "NUMBERS_OF_A_TASK", 600)
    monkeypatch.setattr(paving_tasks, "LEAST_NUMBERS", 200)


@pytest.mark.usefixtures("small_tasks")
@pytest.mark.parametrize("name", QUESTIONS)
def test_parts_shared_out_in_pieces_have_the_same_pavings(name: str) -> None:
    ready = _ready(name)
    processes = _Processes(ready)
    expected = [pave_part(ready, part) for part in PARTS]
    assert processes.paved(PARTS) == expected
    assert any(not task.is_whole for task in processes.tasks)
    assert all(paved.open_parts for paved in expected)
    assert (name == "map") == all(part.depth == 9 for paved in expected for part in paved.open_parts)


@pytest.mark.usefixtures("small_tasks")
def test_what_fails_in_a_process_is_said() -> None:
    with pytest.raises(RuntimeError, match="has ended"):
        _Processes(_ready("map"), failing=3).paved(PARTS)


def test_after_a_counterexample_no_more_is_sent() -> None:
    machine = region_machine(model("3-rrr"))
    question = question_from_toml(QUESTIONS["all"], machine)
    made: list[_Processes] = []

    class Run:
        def begin(self, question: RegionQuestion) -> None:
            pass

        def paved(self, ready: PreparedQuestion, parts: Sequence[Part]) -> PartsInOrder:
            made.append(_Processes(ready))
            return PartsInOrder(ready, parts, made[0].submit, processes=2, room=1)

    assert answered(machine, question, run=Run()).counterexample is not None
    (task,) = made[0].sent
    task.called[0](task)
    assert len(made[0].tasks) == 1

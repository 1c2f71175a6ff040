"""Progress: on a terminal after a second, and nowhere else."""

import io
import os
import re
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from fractions import Fraction
from functools import partial
from multiprocessing import Pipe
from pathlib import Path
from random import Random
from typing import Any

import pytest
from samples import solved

from pkm_exact.comparison.compare import compare_formulations
from pkm_exact.comparison.numeric import compare_numeric
from pkm_exact.comparison.worker import run_apart
from pkm_exact.constraints.distance import Distance
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.interactive import progress as progress_module
from pkm_exact.interactive.progress import PATIENCE, Progress
from pkm_exact.numeric.fallback import solve_within
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.policy import Policy
from pkm_exact.poses.expected_size import expected_bits
from pkm_exact.stages import Amount, Relay, Stages, tell

ROOT = Path(__file__).parent.parent
ERASED = re.compile(r"\r\x1b\[K")


def _problem(name: str) -> ForwardProblem:
    robot = read_robot(ROOT / "models" / f"{name}.toml")
    return robot.problem(robot.configuration())


class Recorder:
    """Stages, and the amounts that were told in each."""

    def __init__(self) -> None:
        self.stages: list[str] = []
        self.amounts: dict[str, list[Amount]] = {}

    def __call__(self, stage: str) -> None:
        self.stages.append(stage)

    def amount(self, amount: Amount) -> None:
        self.amounts.setdefault(self.stages[-1], []).append(amount)


def _recorded(work: Callable[..., object], *arguments: Any, **options: Any) -> Recorder:
    recorder = Recorder()
    work(*arguments, progress=recorder, **options)
    return recorder


def _grows(amounts: list[Amount]) -> bool:
    return [amount.done for amount in amounts] == sorted(amount.done for amount in amounts)


# What is told.


def test_the_exact_engine_tells_pairs_and_bits() -> None:
    problem, by_elimination = _problem("rolland-6-6"), partial(solve, policy=Policy(eliminate=True))
    found = _recorded(by_elimination, problem).amounts
    pairs, bits = found["Groebner basis"], found["numeric lifting"]
    without = _recorded(solve, problem).amounts
    assert "Groebner basis" not in without
    assert without["numeric lifting"] == bits
    assert len(pairs) > 2
    assert all(
        amount.bound == "at least" and amount.total is not None and amount.done < amount.total for amount in pairs
    )
    assert _grows(bits)
    assert all(amount.total is None or amount.done < amount.total for amount in bits)
    assert bits[0].bound == "about"


@pytest.mark.parametrize("name", ["rolland-6-6", "mourrain-l", pytest.param("dietmaier", marks=pytest.mark.slow)])
def test_the_estimate_of_the_lifting_is_one(name: str) -> None:
    problem = _problem(name)
    reached = _recorded(solve, problem, policy=Policy(lifting="newton")).amounts["p-adic lifting"][-1].done
    assert reached / 2 < expected_bits(problem, 40) < reached * 2


@pytest.mark.parametrize("unit", [Fraction(10**60), Fraction(1, 10**60)])
def test_the_estimate_does_not_depend_on_the_unit_of_length(unit: Fraction) -> None:
    random = Random(5)
    joints = [[tuple(Fraction(random.randint(-9, 9)) for _ in range(3)) for _ in range(2)] for _ in range(6)]
    expected = [
        expected_bits(
            ForwardProblem(
                tuple(Distance(*(tuple(u * x for x in point) for point in pair), 99 * u * u) for pair in joints)
            ),
            40,
        )
        for u in (Fraction(1), unit)
    ]
    assert expected[0] == expected[1] > 0


def test_lifting_by_primes_tells_bits() -> None:
    bits = _recorded(solve, _problem("3-rpr-merlet-p"), policy=Policy(lifting="multimodular")).amounts[
        "lifting by primes"
    ]
    assert len(bits) > 1
    assert _grows(bits)


def test_exact_elimination_tells_matrices() -> None:
    matrices = _recorded(solve, _problem("similar-planar-s")).amounts["completeness"]
    counted = [amount for amount in matrices if amount.unit == "exact matrices"]
    assert [amount.done for amount in counted] == list(range(len(counted)))
    assert {amount.total for amount in counted} == {len(counted)}


def test_the_numeric_engine_tells_paths() -> None:
    found = _recorded(solve_krawczyk, _problem("3-rrr")).amounts
    paths, certified = found["path tracking"], found["Krawczyk operator"]
    assert _grows(paths)
    assert {amount.total for amount in paths} == {6}
    assert (paths[-1].done, certified[-1].done) == (6, 6)


def test_tolerance_boxes_tell_poses_and_pairs() -> None:
    problem = _problem("3-rpr-merlet-p")
    found = _recorded(
        lambda progress: tolerance_boxes(problem, Tolerances.uniform("0.0001"), solve(problem), progress)
    ).amounts
    assert [(amount.done, amount.total) for amount in found["tolerance boxes"]] == [(0, 2), (1, 2)]
    assert [(amount.done, amount.total) for amount in found["solutions that are not real"]] == [(0, 2), (1, 2)]


def test_the_comparison_tells_starts() -> None:
    found = _recorded(compare_numeric, _problem("3-rpr-merlet-p"), starts=7).amounts["newton"]
    assert [amount.done for amount in found if amount.unit == "starts"] == list(range(7))
    assert [amount.done for amount in found if amount.unit == "ends judged"] == list(range(7))


def test_amounts_come_from_other_processes() -> None:
    problem = _problem("3-rpr-merlet-p")
    assert _recorded(solve_within, solve, problem, 60).amounts["p-adic lifting"]
    assert _recorded(lambda progress: run_apart(problem, "SE3", 60, progress)).amounts["SE3: p-adic lifting"]


def test_the_formulations_are_counted() -> None:
    recorder = _recorded(compare_formulations, _problem("3-rpr-merlet-p"), ["AFD5"])
    assert [stage for stage in recorder.stages if stage.startswith("formulation ")] == [
        "formulation 1 of 2, SE3: start",
        "formulation 2 of 2, AFD5: start",
    ]


def test_a_plain_callable_gets_names_of_stages_only() -> None:
    lines: list[str] = []
    solve(_problem("3-rpr-merlet-p"), progress=lines.append)
    assert {type(line) for line in lines} == {str}
    assert len(lines) < 15


def test_what_is_told_changes_nothing() -> None:
    assert solve(_problem("mssm"), progress=Recorder()) == solved("mssm")


def test_a_relay_sends_both() -> None:
    receiver, sender = Pipe(duplex=False)
    relay = Relay(sender.send)
    relay("a stage")
    tell(relay, Amount(1, 2, "paths"))
    assert (receiver.recv(), receiver.recv()) == ("a stage", Amount(1, 2, "paths"))
    tell(None, Amount(1, 2, "paths"))


# What is shown.


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def _on_terminal(monkeypatch: pytest.MonkeyPatch, *, patience: float) -> Terminal:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(progress_module, "PATIENCE", patience)
    return terminal


def test_nothing_is_written_in_the_first_second(monkeypatch: pytest.MonkeyPatch) -> None:
    assert PATIENCE == 1
    terminal = _on_terminal(monkeypatch, patience=1e9)
    with Progress(verbose=False) as progress:
        progress("lifting")
        progress.amount(Amount(3, 4, "paths"))
    assert terminal.getvalue() == ""


def test_an_amount_is_shown_and_erased(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0)
    with Progress(verbose=False) as progress:
        progress("lifting")
        time.sleep(0.1)
        progress.amount(Amount(30, 40, "paths"))
    text = terminal.getvalue()
    assert "s  lifting: [===============     ] 30 of 40 paths" in text
    assert text.endswith("\r\x1b[K")
    assert "\n" not in text


def test_an_estimate_says_so_and_has_no_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0)
    with Progress(verbose=False) as progress:
        progress("lifting")
        time.sleep(0.1)
        progress.amount(Amount(30, 40, "bits", "about"))
    assert "lifting: 30 of about 40 bits" in terminal.getvalue()


def test_the_clock_goes_on_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0.3)
    with Progress(verbose=False) as progress:
        progress("silent")
        waited = time.monotonic()
        while "silent" not in terminal.getvalue() and time.monotonic() < waited + 60:
            time.sleep(0.05)
    assert "silent" in terminal.getvalue()


def test_nothing_is_shown_after_the_end_or_between(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0)
    with Progress(verbose=False) as progress:
        progress("one")
        progress.clear()
        before = terminal.getvalue()
        time.sleep(0.5)
        assert terminal.getvalue() == before
    time.sleep(0.5)
    assert terminal.getvalue() == before
    assert "refresh" not in "".join(thread.name for thread in threading.enumerate())


def test_verbose_leaves_one_line_per_stage(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0)
    with Progress(verbose=True) as progress:
        progress("one")
        progress("two")
    lines = ERASED.sub("", terminal.getvalue()).splitlines()
    assert [line.split()[-1] for line in lines] == ["one", "two"]


def test_a_hostile_name_cannot_write_to_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0)
    with Progress(verbose=False) as progress:
        progress("checking \x1b[2J.json")
    assert "\x1b[2J" not in terminal.getvalue()


def test_lines_are_cut_to_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = _on_terminal(monkeypatch, patience=0)
    with Progress(verbose=False) as progress:
        progress("x" * 500)
    assert max(len(line) for line in ERASED.split(terminal.getvalue())) < 80


def test_without_a_terminal_nothing_is_written(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress_module, "PATIENCE", 0)
    with Progress(verbose=True) as progress:
        progress("one")
        progress.amount(Amount(1, 2, "paths"))
    assert stream.getvalue() == ""


def test_stages_measure_and_tell() -> None:
    recorder = Recorder()
    stages = Stages(recorder)
    stages.enter("one")
    stages.amount(Amount(1, 2, "things"))
    stages.leave()
    assert stages.seconds.keys() == {"one"}
    assert recorder.amounts == {"one": [Amount(1, 2, "things")]}


# Commands on a pseudo terminal.


def _shown(arguments: list[str], folder: Path) -> str:
    """What a command writes to stderr when that is a terminal."""
    pty = pytest.importorskip("pty")
    master, slave = pty.openpty()
    command = [sys.executable, "-m", "pkm_exact.cli.main", *arguments]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=slave, cwd=folder) as process:
        os.close(slave)
        parts = []
        while True:
            try:
                part = os.read(master, 65536)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            parts.append(part)
    os.close(master)
    assert process.returncode in (0, 3)
    return b"".join(parts).decode()


SLOW = [
    (
        ["solve", "models/rolland-6-6.toml", "--formulation", "AFD2"],
        r"Groebner basis: \d+ of at least \d+ critical pairs",
    ),
    (
        ["check", "--pure", *(f"certs/{name}.json" for name in ("rolland-6-6", "dietmaier", "6-6p", "6-6pp"))],
        r"checking [-\w]+\.json: \[[= ]*\] [0-3] of 4 files",
    ),
]


@pytest.mark.slow
@pytest.mark.parametrize(("arguments", "pattern"), SLOW, ids=lambda value: str(value[:2]))
def test_a_long_command_shows_how_far_it_is(arguments: list[str], pattern: str) -> None:
    text = _shown(arguments, ROOT)
    assert re.search(pattern, text), text
    assert text.endswith("\r\x1b[K")


def test_a_terminal_sees_the_stages_of_a_verbose_run() -> None:
    lines = ERASED.sub("", _shown(["solve", "models/3-rpr-merlet-p.toml", "-v"], ROOT)).splitlines()
    assert [line.split("s  ")[1] for line in lines][:3] == ["self-motion", "formulation", "Groebner basis"]


def test_a_pipe_sees_nothing() -> None:
    command = [sys.executable, "-m", "pkm_exact.cli.main", "solve", "models/mourrain-l.toml", "-v"]
    done = subprocess.run(command, capture_output=True, cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, b"")

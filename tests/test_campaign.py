"""The campaign of nearly degenerate robots: one of fifty here, and that a run which is killed goes on where it was."""

import json
from collections.abc import Callable
from pathlib import Path

import campaign
import pytest
from campaign import (
    FAMILIES,
    METHODS,
    SHARE,
    Outcome,
    Worker,
    disagreements,
    journal,
    model,
    names,
    run,
    summary,
    tried,
)
from certificate_tools import golden_bytes

from pkm_exact import PkmExactError
from pkm_exact.certify import pure
from pkm_exact.certify.check import Status, Verdict
from pkm_exact.geometry.reader import robot_from_toml

FEW = ["planar-0", "planar-1", "spatial-0"]


def _attempt(seen: list[tuple[str, str]], failing: str = "") -> Callable[[str, str], Outcome]:
    def attempt(name: str, method: str) -> Outcome:
        seen.append((name, method))
        return Outcome(name, method, "complete 6/6/2", "no" if name == failing else "", 0.1)

    return attempt


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", names(SHARE))
def test_both_checkers_accept_what_is_written(name: str, method: str) -> None:
    assert tried(name, method).failure == ""


@pytest.mark.parametrize("method", METHODS)
def test_a_robot_is_solved_and_its_certificate_checked_twice(method: str) -> None:
    found = tried("planar-1", method)
    assert found.failure == ""
    assert found.answer.startswith("complete")


def test_there_are_as_many_robots_as_are_said_all_different_and_all_models() -> None:
    every = {name: model(name) for name in names()}
    assert {family: sum(name.startswith(family) for name in every) for family in FAMILIES} == FAMILIES
    assert len({text.partition("source")[2] for text in every.values()}) == len(every)
    for name in names(10):
        robot_from_toml(every[name])
    assert model("spatial-7") == model("spatial-7")


def test_the_tests_take_two_per_cent_of_both_families() -> None:
    chosen = names(SHARE)
    assert len(chosen) * 50 == sum(FAMILIES.values())
    assert sum(name.startswith("spatial") for name in chosen) == 6


def test_a_run_that_was_killed_goes_on_where_it_was(tmp_path: Path) -> None:
    path, first, second = tmp_path / "new" / "journal.jsonl", [], []

    def killed(name: str, method: str) -> Outcome:
        if len(first) == 3:
            raise KeyboardInterrupt
        return _attempt(first)(name, method)

    with pytest.raises(KeyboardInterrupt):
        run(path, FEW, killed)
    with path.open("a", encoding="utf-8") as file:
        file.write('{"robot": "planar-1", "meth')
    done = run(path, FEW, _attempt(second))
    assert [*first, *second] == [(name, method) for name in FEW for method in METHODS]
    assert done == journal(path)
    assert run(path, FEW, _attempt([])) == done


def test_what_failed_is_tried_again_if_asked_for(tmp_path: Path) -> None:
    path, again = tmp_path / "journal.jsonl", []
    run(path, FEW, _attempt([], failing="planar-1"))
    assert run(path, FEW, _attempt([])) == journal(path)
    assert sum(bool(outcome.failure) for outcome in journal(path)) == 2
    run(path, FEW, _attempt(again), again=True)
    assert again == [("planar-1", method) for method in METHODS]
    assert not any(outcome.failure for outcome in journal(path))


def test_methods_that_disagree_are_found() -> None:
    done = [Outcome("a", "exact", "complete 6/6/2", "", 1.0), Outcome("a", "krawczyk", "complete 6/6/4", "", 1.0)]
    assert disagreements(done) == ["a: complete 6/6/2 and complete 6/6/4"]
    assert disagreements(done[:1]) == []
    assert "krawczyk: 1 robots, 0 failures; complete 1; 1 s" in summary(done)


def test_whoever_refuses_a_certificate_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    data = golden_bytes("3-rpr-merlet-p")
    assert campaign.refusal(data) == ""
    assert campaign.refusal(data[:-2]).startswith("the checker: malformed")
    right = pure.check_bytes(data)
    monkeypatch.setattr(pure, "check_bytes", lambda _: pure.Verdict("rejected", ("not so",)))
    assert campaign.refusal(data) == "the plain checker: rejected: not so"
    monkeypatch.setattr(pure, "check_bytes", lambda _: right)
    monkeypatch.setattr(campaign, "check_bytes", lambda _: Verdict(Status.ACCEPTED, ("another",)))
    assert campaign.refusal(data).startswith("verdicts differ")


def test_no_answer_is_a_failure_and_so_is_whatever_else_goes_wrong(monkeypatch: pytest.MonkeyPatch) -> None:
    def gives_up(_: object) -> None:
        raise PkmExactError("too hard")

    monkeypatch.setitem(METHODS, "exact", gives_up)
    monkeypatch.setitem(METHODS, "krawczyk", lambda _: 1 // 0)
    assert tried("planar-0", "exact").failure == "no answer: PkmExactError: too hard"
    assert "ZeroDivisionError" in tried("planar-0", "krawczyk").failure


@pytest.mark.slow
def test_a_robot_that_takes_too_long_is_a_failure_and_the_next_one_is_tried() -> None:
    worker = Worker(0.01)
    assert worker("spatial-1", "exact").failure == "no end within 0 seconds"
    worker.limit = 300
    assert worker("planar-1", "exact").failure == ""


def test_the_command_shows_a_robot(capsys: pytest.CaptureFixture[str]) -> None:
    assert campaign.main(["--show", "planar-3"]) == 0
    assert capsys.readouterr().out == model("planar-3") + "\n"


def test_the_command_says_whether_anything_failed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(campaign, "BUILD", tmp_path)
    monkeypatch.setattr(campaign, "Worker", lambda _: _attempt([], failing="planar-0"))
    assert campaign.main(["--share", "500"]) == 1
    assert len((tmp_path / "journal.jsonl").read_text().splitlines()) == 6
    assert json.loads((tmp_path / "journal.jsonl").read_text().splitlines()[0])["robot"] == "planar-0"
    monkeypatch.setattr(campaign, "Worker", lambda _: _attempt([]))
    assert campaign.main(["--share", "500", "--again"]) == 0

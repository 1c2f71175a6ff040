"""The self-test passes here, and fails where it must."""

import sys
from dataclasses import replace
from importlib import import_module, metadata

import pytest

from pkm_exact.cli.main import main
from pkm_exact.errors import InternalContradictionError
from pkm_exact.support.installation import extras
from pkm_exact.support.self_test_cases import Check, run_checks

Capture = pytest.CaptureFixture[str]


def _outcomes() -> dict[str, Check]:
    return {check.name: check for check in run_checks()}


def test_everything_passes_here(capsys: Capture) -> None:
    assert main(["selftest"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.count(" ok: ") == len(_outcomes()) == 8
    assert "FAILED" not in out
    assert out.endswith("everything works\n")


def test_optional_packages_are_listed(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    wanted = [
        "numpy>=1.26",
        'no-such-package>=3.8; extra == "plots"',
        'sympy>=1.12 ; extra == "more"',
        'pytest>=8; extra == "test"',
        'pkm_exact[plots]; extra == "more"',
    ]
    monkeypatch.setattr(metadata, "requires", lambda _: wanted)
    assert extras() == {"no-such-package": None, "sympy": metadata.version("sympy")}
    main(["selftest"])
    out = capsys.readouterr().out
    assert "\noptional: no-such-package not installed\n" in out
    assert f"\noptional: sympy         {metadata.version('sympy')}\n" in out


@pytest.mark.parametrize("module", ["pkm_exact.certify.check", "pkm_exact.certify.pure"])
def test_a_checker_that_accepts_all_is_noticed(module: str, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    checker = import_module(module)
    accepted = checker.check_bytes
    verdicts = []

    def accept(data: bytes) -> object:
        verdicts.append(verdicts[0] if verdicts else accepted(data))
        return verdicts[-1]

    monkeypatch.setattr(checker, "check_bytes", accept)
    assert main(["selftest"]) == 4
    out, err = capsys.readouterr()
    assert out.count("FAILED") == 1
    assert "forgeries rejected      FAILED" in out
    assert "everything works" not in out
    assert err == "certify-poses: error: 1 check failed; reinstall the package, or report these lines\n"


def test_an_engine_that_fails_is_noticed(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    def fail(*_: object, **__: object) -> None:
        raise InternalContradictionError("made up \x1b[2J")

    monkeypatch.setattr(import_module("pkm_exact.engine"), "solve", fail)
    outcomes = _outcomes()
    assert outcomes["FLINT's arithmetic"].passed
    assert outcomes["6-6, krawczyk"].passed
    assert not outcomes["3-RPR, exact"].passed
    assert not outcomes["both methods agree"].passed
    assert main(["selftest"]) == 4
    assert "\x1b" not in capsys.readouterr().out


def test_a_missing_pose_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    engine = import_module("pkm_exact.numeric_engine")
    solve = engine.solve_krawczyk

    def lose(*arguments: object, **options: object) -> object:
        solution = solve(*arguments, **options)
        return replace(solution, poses=solution.poses[1:])

    monkeypatch.setattr(engine, "solve_krawczyk", lose)
    assert not _outcomes()["both methods agree"].passed


def test_without_flint_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "flint", None)
    outcomes = _outcomes()
    assert not outcomes["FLINT's arithmetic"].passed
    assert "ModuleNotFoundError" in outcomes["FLINT's arithmetic"].detail

"""Certificates come out again, byte by byte; whatever has changed is found, named, and has its exit code."""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from certificate_tools import golden, golden_bytes, leaves, neighbours, with_entry

from pkm_exact import (
    Policy,
    Robot,
    Tolerances,
    certificate,
    read_robot,
    recompute,
    solve,
    solve_krawczyk,
    tolerance_boxes,
)
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.tolerance_build import tolerance_certificate
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError, ReconstructionError
from pkm_exact.failures.failure_report import FORMAT as REPORT
from pkm_exact.recomputation import Outcome
from pkm_exact.recomputation import recompute as recomputed

ROOT = Path(__file__).parent.parent
MODELS = ROOT / "models"
SCRIPT = ROOT / "scripts" / "certify-in-ci.sh"
QUICK = ("3-rrr", "3-rpr-merlet-p")
Capture = pytest.CaptureFixture[str]


def _of(name: str, solver: Callable[..., Any], **options: Any) -> bytes:
    robot = read_robot(MODELS / f"{name}.toml")
    configuration = robot.configuration()
    solution = solver(robot.problem(configuration), **options)
    return canonical_bytes(certificate(robot, configuration.name, solution))


def _parallelogram() -> bytes:
    corners = tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, 0), (0, 4)))
    robot = Robot("parallelogram", "3-RPR", "m", "made up", corners, corners)  # type: ignore[arg-type]
    return canonical_bytes(certificate(robot, None, solve(robot.problem((9, 9, 9)))))


def _inconsistent() -> bytes:
    robot = read_robot(MODELS / "mourrain-l.toml")
    line = tuple((Fraction(k), Fraction(0), Fraction(0)) for k in range(6))
    flat = Robot("flat", "6-UPS", "m", "made up", robot.base_joints, line)
    return canonical_bytes(certificate(flat, None, solve(flat.problem(["1", "1", "0.64", "4", "4", "4"]))))


def _tolerances(solver: Callable[..., Any], size: str) -> bytes:
    robot = read_robot(MODELS / "3-rpr-merlet-p.toml")
    problem = robot.problem(robot.configuration())
    result = tolerance_boxes(problem, Tolerances.uniform(size), solver(problem))
    return canonical_bytes(tolerance_certificate(robot, "home", result))


KINDS: dict[str, tuple[Callable[[], bytes], str]] = {
    "golden": (lambda: golden_bytes("mourrain-l"), "complete, 4 poses"),
    "cranks": (lambda: golden_bytes("3-rrr"), "complete, 6 poses"),
    "multiple": (lambda: golden_bytes("3-rpr-double-q"), "complete, 1 pose"),
    "narrow": (lambda: _of("3-rrr", solve, width=Fraction(1, 10**40)), "complete, 6 poses"),
    "coarse": (lambda: _of("3-rrr", solve, width=Fraction(1)), "complete, 6 poses"),
    "formulation": (lambda: _of("mourrain-l", solve, formulation="AFP3:124"), "complete, 4 poses"),
    "krawczyk": (lambda: _of("mourrain-l", solve_krawczyk, width=Fraction(1, 10**20)), "complete, 4 poses"),
    "fallback": (lambda: _of("3-rpr-triple", solve_krawczyk), "complete, 2 poses"),
    "moving with isolated poses": (_parallelogram, "positive dimensional proved, 2 poses"),
    "inconsistent": (_inconsistent, "inconsistent, 0 poses"),
    "tolerances": (lambda: _tolerances(solve, "0.0001"), "complete within tolerance, 2 of 2 poses proved"),
    "tolerances by krawczyk": (lambda: _tolerances(solve_krawczyk, "0.0001"), "complete within tolerance, 2 of 2 "),
    "wide tolerances": (lambda: _tolerances(solve, "1"), "not proven complete within tolerance, 0 of 2 poses proved"),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_certificate_comes_out_again(kind: str) -> None:
    make, summary = KINDS[kind]
    data = make()
    found = recomputed(data)
    assert (found.outcome, found.data) == (Outcome.SAME, data), found
    assert str(found).startswith(f"same bytes, {summary}")


def test_another_seed_changes_the_proof_alone_and_can_be_given() -> None:
    policy = Policy(seed=7)
    data = _of("similar-planar-s", solve, policy=policy)
    assert recomputed(data, policy=policy).outcome is Outcome.SAME
    found = recomputed(data)
    assert found.outcome is Outcome.DIFFERENT
    assert found.detail.startswith("first at representation.")
    assert "only their proof was found in another way" in found.detail


def test_a_changed_model_is_named() -> None:
    robot = read_robot(MODELS / "3-rpr-merlet-p.toml")
    base = (robot.base_joints[0], (Fraction(11), Fraction(0), Fraction(0)), robot.base_joints[2])
    changed = Robot(
        robot.name,
        robot.kind,
        robot.unit,
        robot.source,
        base,
        robot.platform_joints,
        configurations=robot.configurations,
    )
    found = recomputed(golden_bytes("3-rpr-merlet-p"), robot=changed)
    assert str(found) == "differs: first at robot.base[1][0]: '10' in the file, '11' now"
    assert found.data is not None
    assert recomputed(found.data, robot=changed).outcome is Outcome.SAME


def _changes(name: str) -> Iterator[tuple[Any, bytes]]:
    content = golden(name)
    for path, value in leaves(content):
        for other in neighbours(value)[:1]:
            yield path, canonical_bytes(sealed(with_entry(content, path, other)))


def test_no_change_of_a_certificate_comes_out_the_same() -> None:
    """Sealed again, the checker accepts other descriptions; the comparison with the model finds them."""
    robot = read_robot(MODELS / "3-rpr-merlet-p.toml")
    accepted = set()
    for path, data in _changes("3-rpr-merlet-p"):
        if path[0] in ("poses", "elimination", "representation", "digest"):
            continue  # many, and all for the checker; the digest is made to fit
        try:
            found = recomputed(data, robot=robot)
        except InputError as error:
            accepted.add(path)
            assert "is unknown" in str(error)
            continue
        assert found.outcome is not Outcome.SAME, path
        if found.outcome is Outcome.DIFFERENT:
            accepted.add(path)
            assert f"first at {'.'.join(map(str, path))}" in found.detail
    described = {("robot", "name"), ("robot", "unit"), ("robot", "source"), ("configuration", "name")}
    assert described <= accepted <= described | {("formulation",)}


def _command(words: list[str], capsys: Capture) -> tuple[int, list[str], str]:
    code = main(["check", "--recompute", *words])
    out, err = capsys.readouterr()
    return code, out.splitlines(), err


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Models and certificates of two quick robots, in the current folder."""
    for name in QUICK:
        for kind, suffix in (("models", "toml"), ("certs", "json")):
            (tmp_path / kind).mkdir(exist_ok=True)
            shutil.copy(ROOT / kind / f"{name}.{suffix}", tmp_path / kind)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def test_a_folder_has_a_line_per_file_and_a_total(folder: Path, capsys: Capture) -> None:
    assert _command(["--models", "models", "certs"], capsys) == (
        0,
        [
            f"{Path('certs/3-rpr-merlet-p.json')}: same bytes, complete, 2 poses",
            f"{Path('certs/3-rrr.json')}: same bytes, complete, 6 poses",
            "2 certificates: 2 same bytes",
        ],
        "",
    )
    assert main(["check", "certs"]) == 0
    assert capsys.readouterr().out.count("accepted") == 2


def test_exit_codes_say_what_is_wrong(folder: Path, capsys: Capture) -> None:
    certs = folder / "certs"
    _edit(folder / "models/3-rpr-merlet-p.toml", "10", "11")
    assert _command(["certs"], capsys)[0] == 0, "the robots in the certificates are unchanged"
    code, lines, _ = _command(["--models", "models", "certs"], capsys)
    assert (code, lines[-1]) == (1, "2 certificates: 1 differs, 1 same bytes")
    (certs / "3-rrr.json").write_text("{}\n", encoding="ascii")
    code, lines, _ = _command(["certs/3-rrr.json"], capsys)
    assert (code, lines[0].split(":")[1]) == (2, " malformed")
    assert _command(["--models", "models", "certs"], capsys)[0] == 1, "a difference counts more"
    _edit(certs / "3-rpr-merlet-p.json", '"complete"', '"COMPLETE"')
    code, lines, _ = _command(["certs/3-rpr-merlet-p.json"], capsys)
    assert (code, lines[0].split(":")[1]) == (1, " rejected")
    code, lines, _ = _command(["nothing.json"], capsys)
    assert (code, "cannot be read" in lines[0]) == (2, True)


def test_a_model_that_is_gone_is_named(folder: Path, capsys: Capture) -> None:
    certs = folder / "certs"
    shutil.copy(certs / "3-rrr.json", certs / "3-rrr.first.json")
    assert _command(["--models", "models", "certs"], capsys)[0] == 0, "NAME.anything.json belongs to NAME.toml"
    shutil.copy(certs / "3-rrr.json", certs / "other.json")
    code, lines, _ = _command(["--models", "models", "certs/other.json"], capsys)
    assert code == 2
    assert lines[0].startswith(f"{Path('certs/other.json')}: unusable: there is no {Path('models/other.toml')}")
    _edit(folder / "models/3-rrr.toml", 'name = "six"', 'name = "seven"')
    code, lines, _ = _command(["--models", "models", "certs/3-rrr.json"], capsys)
    assert (code, "'six' is unknown" in lines[0]) == (2, True)


def test_update_writes_what_differs_and_nothing_else(folder: Path, capsys: Capture) -> None:
    certs = folder / "certs"
    _edit(folder / "models/3-rpr-merlet-p.toml", "10", "11")
    (certs / "3-rrr.json").write_text("{}\n", encoding="ascii")
    code, lines, _ = _command(["--update", "--models", "models", "certs"], capsys)
    assert (code, lines[-1]) == (2, "2 certificates: 1 updated, 1 malformed")
    assert (certs / "3-rrr.json").read_text(encoding="ascii") == "{}\n"
    assert _command(["--models", "models", "certs/3-rpr-merlet-p.json"], capsys)[0] == 0
    assert len(list(certs.iterdir())) == 2


def test_options_that_do_not_fit_are_refused(folder: Path, capsys: Capture) -> None:
    for words in (["--pure", "--recompute"], ["--update"], ["--models", "models"], ["--recompute", "--models", "no"]):
        assert main(["check", *words, "certs"]) == 2
        out, err = capsys.readouterr()
        assert (out, err.count("\n")) == ("", 1)
    (folder / "empty").mkdir()
    assert main(["check", "empty"]) == 2
    assert "has no *.json in it" in capsys.readouterr().err


def test_a_limit_that_is_met_is_no_answer(folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    def gives_up(*_: object, **__: object) -> None:
        raise ReconstructionError("nothing appeared")

    monkeypatch.setattr(sys.modules["pkm_exact.recomputation"], "solve", gives_up)
    code, lines, _ = _command(["certs"], capsys)
    assert (code, lines[-1]) == (4, "2 certificates: 2 no answer")


def test_a_failure_is_no_answer_and_leaves_a_report(
    folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr(sys.modules["pkm_exact.recomputation"], "solve", fails)
    code, lines, _ = _command(["certs/3-rrr.json"], capsys)
    assert code == 4
    [report] = folder.glob("pkm_exact-report-*.json")
    assert report.name in lines[0]
    assert json.loads(report.read_text(encoding="ascii"))["format"] == REPORT


def test_it_is_public() -> None:
    assert recompute(golden_bytes("3-rpr-merlet-p")).outcome == "same bytes"


def _script(folder: Path, *words: str, **variables: str) -> tuple[int, str]:
    program = f"{sys.executable} -m pkm_exact.cli.main"
    environment = {**os.environ, "CERTIFY_POSES": program, "PYTHONPATH": str(ROOT), **variables}
    command = ["sh", str(SCRIPT), *words]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


@pytest.mark.skipif(shutil.which("sh") is None, reason="needs a POSIX shell")
def test_the_script_for_continuous_integration(folder: Path) -> None:
    code, text = _script(folder)
    assert (code, text.splitlines()[-1]) == (0, "2 certificates: 2 same bytes")
    model, certificate_ = folder / "models/3-rpr-merlet-p.toml", folder / "certs/3-rpr-merlet-p.json"
    certificate_.unlink()
    code, text = _script(folder)
    assert code == 1
    assert text.splitlines()[0].startswith("models/3-rpr-merlet-p.toml: no certificate certs/3-rpr-merlet-p.json; make")
    assert _script(folder, "update")[0] == 0
    assert certificate_.read_bytes() == golden_bytes("3-rpr-merlet-p")
    _edit(model, "10", "11")
    (folder / "certs/3-rrr.json").write_bytes(golden_bytes("3-rrr").replace(b'"0x', b'"0x1', 1))
    code, text = _script(folder)
    assert code == 1
    assert re.findall("differs: first at|rejected: digest", text) == ["differs: first at", "rejected: digest"]
    certificate_.write_bytes(golden_bytes("3-rpr-merlet-p"))
    model.unlink()
    (folder / "certs/3-rrr.json").write_bytes(b"")
    assert _script(folder)[0] == 2


@pytest.mark.skipif(shutil.which("sh") is None, reason="needs a POSIX shell")
def test_the_script_names_what_it_misses(folder: Path) -> None:
    assert _script(folder, "nonsense") == (2, "certify-in-ci: nonsense: is unknown; use check or update\n")
    assert _script(folder, MODELS="nowhere")[0] == 2
    code, text = _script(folder, CERTIFY_POSES="no-such-command")
    assert (code, "no-such-command: is not installed" in text) == (2, True)
    _edit(folder / "models/3-rrr.toml", "kind", "kinds")
    (folder / "certs/3-rrr.json").unlink()
    assert _script(folder, "update")[0] == 2
    assert not (folder / "certs/3-rrr.json").exists()


def test_the_page_on_continuous_integration_names_the_script_and_what_it_prints() -> None:
    page = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
    assert SCRIPT.relative_to(ROOT).as_posix() in page
    variables = set(re.findall(r"\$\{([A-Z_]+):-", SCRIPT.read_text(encoding="utf-8")))
    assert all(f"`{name}`" in page for name in variables)
    assert [str(outcome) for outcome in Outcome if str(outcome) not in page] == []

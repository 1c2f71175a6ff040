"""The command ``certify-roots``: what it prints, its exit codes, and what it says of input that it cannot use."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from pkm_exact.certify.checker import budget
from pkm_exact.cli.main import ROOTS, ExitCode, main
from pkm_exact.cli.roots_commands import certify_roots
from pkm_exact.interactive import system_answers

Capture = pytest.CaptureFixture[str]
CIRCLE = "x,y\n0\nx^2+y^2-1,\nx-y\n"


def run(*words: str) -> int:
    """Its exit code."""
    return main(words, ROOTS)


@pytest.fixture
def circle(tmp_path: Path) -> str:
    """A file with a system."""
    path = tmp_path / "circle.ms"
    path.write_text(CIRCLE)
    return str(path)


def test_a_table_a_certificate_and_its_check(circle: str, tmp_path: Path, capsys: Capture) -> None:
    target = str(tmp_path / "circle.json")
    assert run(circle, "-o", target) == ExitCode.DONE
    out = capsys.readouterr().out
    assert (
        "2 complex solutions, 2 real solutions; complete: it is proved that there is no other (refined-bezout)" in out
    )
    assert "1  -0.707106781  -0.707106781\n2   0.707106781   0.707106781" in out
    assert run("check", target) == main(["check", target]) == ExitCode.DONE
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1] == f"{target}: accepted"
    content = json.loads(Path(target).read_text())
    content["solutions"][0]["multiplicity"] = 2
    Path(target).write_text(json.dumps(content, indent=1) + "\n")
    assert run("check", target) == ExitCode.REJECTED


def test_json_has_the_keys_that_scripts_rely_on(circle: str, capsys: Capture) -> None:
    assert run(circle, "--format", "json", "--width", "1/8", "--only", "real") == ExitCode.DONE
    found = json.loads(capsys.readouterr().out)
    assert (found["claim"], found["completeness_route"]) == ("complete", "refined-bezout")
    assert (found["complex_solutions"], found["distinct_solutions"], found["real_solutions"]) == (2, 2, 2)
    assert found["solutions"][1] == {"values": {"x": ["11/16", "3/4"], "y": ["11/16", "3/4"]}, "multiplicity": 1}


@pytest.mark.parametrize(
    ("system", "code", "words"),
    [
        (
            "x,y\n0\nx*y-1,\nx*y-2\n",
            0,
            "inconsistent: there is no solution, not even a complex one (exact-elimination)",
        ),
        ("x,y\n0\nx*y-1\n", 3, "infinitely many complex solutions, proved"),
        ("x,y\n0\nx^2,y^2-1", 0, "4 complex solutions (2 distinct), 2 real solutions"),
    ],
)
def test_exit_codes_follow_the_claim(system: str, code: int, words: str, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "system.ms"
    path.write_text(system)
    assert run(str(path)) == code
    assert words in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "has fewer than three lines; write variables, 0, and polynomials"),
        ("x,y\n7\nx,\ny\n", "line 2: the characteristic is '7'; only systems over the rational numbers"),
        ("x,x\n0\nx\n", "variables: 'x' occurs twice; name each once"),
        ("x,2y\n0\nx\n", "variable 2: '2y' is not a name"),
        ("x,y\n0\nx+z\n", "polynomial 1: 'z' is not among the variables"),
        ("x,y\n0\nx,,y\n", "polynomial 2: ends where a number, a name or a bracket is expected"),
        ("x,y\n0\nx-x\n", "polynomials: all are 0, and every point is a solution"),
        ("x\n0\nx^65\n", "polynomial 1: an exponent of 65; at most 64 is possible"),
        ("x\n0\nx^99999999\n", "polynomial 1: an exponent of 99999999; at most 64 is possible"),
        ('{\n "claim": "complete",\n "x": 1\n}', "is JSON, as certificates are; use check for it"),
        ("x\n0\n" + "(" * 60 + "x" + ")" * 60 + "\n", "brackets are nested more than 50 deep"),
        ("x\n0\n" + "9" * 5000 + "*x\n", "is too long; use at most 4000 digits"),
        ("x\n0\n__import__('os').system('x')\n", "cannot be read; use numbers, names and"),
        ("x\n0\nx \xe9\n", "is not ASCII"),
        (",".join(f"x{i}" for i in range(65)) + "\n0\nx0\n", "variables: 65 given, at most 64 are possible"),
        ("x,y,z,u,v,w\n0\n(x+y+z+u+v+w+1)^40\n", "more than 65536 terms"),
        ("x\n0\n" + ",".join(["x"] * 257), "polynomials: 257 given, at most 256 are possible"),
        ("x\n0\n1/x\n", "something is divided by a variable"),
        ("x\n0\nx/0\n", "something is divided by 0"),
    ],
)
def test_bad_files_get_one_sentence(text: str, sentence: str, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "bad.ms"
    path.write_text(text, encoding="latin-1")
    assert run(str(path), "-o", str(tmp_path / "cert.json")) == ExitCode.BAD_INPUT
    err = capsys.readouterr().err
    assert err.startswith(f"certify-roots: error: {path}: ")
    assert sentence in err
    assert err.count("\n") == 1
    assert not (tmp_path / "cert.json").exists()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["missing.ms"], "missing.ms: cannot be read"),
        (["{circle}", "--width", "0"], "--width: 0 is not positive"),
        (
            ["{circle}", "--oracle", "delphi"],
            "--oracle: 'delphi' is not one of 'internal', 'msolve'; see certify-roots",
        ),
        (["{circle}", "--memory", "300MB"], "--memory: '300MB' is not a whole number; give one from 64 to 1048576"),
        (["{circle}", "--memory", "63"], "--memory: 63 is out of range; give a whole number from 64 to 1048576"),
        (["{circle}", "-o", "{circle}"], "is the system's file itself"),
        (["check", "missing.json"], "certify-roots: error: missing.json: cannot be read"),
        (["check"], "missing argument 'CERT...'; see certify-roots check --help"),
    ],
)
def test_bad_words_get_one_sentence(words: list[str], sentence: str, circle: str, capsys: Capture) -> None:
    assert run(*(word.format(circle=circle) for word in words)) == ExitCode.BAD_INPUT
    assert sentence in capsys.readouterr().err


def test_a_certificate_that_checkers_cannot_afford_is_not_written_without_a_word(
    circle: str, tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = str(tmp_path / "cert.json")
    monkeypatch.setattr(system_answers, "LEAST_IN_DOUBT", 0)
    assert run(circle, "-o", path) == ExitCode.DONE
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(budget, "BASE", 0)
    monkeypatch.setattr(budget, "PER_BYTE", 1)
    assert run(circle, "-o", path) == ExitCode.DONE
    assert f"{path}: to check it takes more work than checkers allow" in capsys.readouterr().err
    with pytest.warns(UserWarning, match="to check it takes more work than checkers allow"):
        system_answers.solve_system(["x^2 = 2"]).save(path)


def test_limits_end_in_a_sentence(circle: str, capsys: Capture) -> None:
    assert run(circle, "--time-limit", "1e-3") == ExitCode.NO_ANSWER
    assert "no answer: not solved within the time limit of 0.001 seconds" in capsys.readouterr().err


def test_within_limits_the_answer_is_the_same(circle: str, capsys: Capture) -> None:
    assert run(circle) == ExitCode.DONE
    alone = capsys.readouterr().out
    assert run(circle, "--time-limit", "300", "--memory", "4000") == ExitCode.DONE
    assert capsys.readouterr().out == alone


@pytest.mark.parametrize("name", ["", *certify_roots.commands])
def test_every_help_has_examples(name: str, capsys: Capture) -> None:
    assert run(*([name] if name else []), "--help") == ExitCode.DONE
    assert "Examples:\n    certify-roots" in capsys.readouterr().out


def test_commands_for_robots_say_that_it_is_none(circle: str, tmp_path: Path, capsys: Capture) -> None:
    target = str(tmp_path / "circle.json")
    assert run(circle, "-o", target) == ExitCode.DONE
    for words in (["report", target, "-o", str(tmp_path / "x.html")], ["plot", target, "-o", str(tmp_path / "x.svg")]):
        assert main(words) == ExitCode.BAD_INPUT
        assert "internal" not in capsys.readouterr().err
    assert main(["check", "--recompute", target]) == ExitCode.DONE
    assert "same bytes, complete, 2 real solutions" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="limits of memory as Linux has them")
def test_little_memory_ends_in_one_sentence() -> None:
    """FLINT's own lines do not appear."""
    command = [sys.executable, "-c", "import sys; from pkm_exact.cli.main import roots_main; sys.exit(roots_main())"]
    file = Path(__file__).parent / "systems" / "virasoro.ms"
    done = subprocess.run([*command, str(file), "--memory", "150"], capture_output=True, text=True, check=False)
    assert done.returncode == ExitCode.NO_ANSWER
    assert done.stdout == ""
    assert re.fullmatch(r"certify-roots: error: no answer: the memory of 150 MB does not suffice .*\n", done.stderr)

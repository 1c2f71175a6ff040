"""The command: exit codes, sentences on stderr, exact output, and files that appear whole or not at all."""

import csv
import io
import json
import math
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest

from pkm_exact.claim import Claim, CompletenessRoute
from pkm_exact.cli.main import main
from pkm_exact.cli.report import as_object, headline
from pkm_exact.cli.table import decimal
from pkm_exact.errors import ReconstructionError
from pkm_exact.geometry.reader import read_robot
from pkm_exact.poses.pose import Interval
from pkm_exact.solution import Solution

ROOT = Path(__file__).parent.parent
MODEL = str(ROOT / "models" / "mourrain-l.toml")
Capture = pytest.CaptureFixture[str]

# The modules by their names: the package exports a function called solve as well.
SOLVE = import_module("pkm_exact.engine")
CHECK = import_module("pkm_exact.certify.check")


@pytest.fixture(scope="module")
def solution() -> Solution:
    robot = read_robot(MODEL)
    return SOLVE.solve(robot.problem(robot.configuration().lengths_squared))


@pytest.fixture
def quick(solution: Solution, monkeypatch: pytest.MonkeyPatch) -> Solution:
    """Commands answer with one real solution that was computed before."""
    monkeypatch.setattr(SOLVE, "solve", lambda problem, **_: replace(solution, problem=problem))
    return solution


@pytest.fixture
def stays_empty(tmp_path: Path) -> Iterator[Path]:
    """A folder in which nothing may appear."""
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


def _fails(words: list[str], part: str, capsys: Capture, code: int = 2) -> None:
    assert main(words) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.startswith("certify-poses: error: ")
    assert part in err


BAD_USAGE = [
    (["solve"], "missing argument 'MODEL'"),
    (["solve", "missing.toml"], "missing.toml: no such file"),
    (["solve", str(ROOT)], "is a directory"),
    (["solve", MODEL, "--configuration", "nowhere"], "'nowhere' is unknown; use one of: home"),
    (["solve", MODEL, "--configuration", "home", "--lengths", "1,1,1,1,1,1"], "exclude each other"),
    (["solve", MODEL, "--lengths", "1,1,1,1,1"], "lengths: 5 values; give 6, one per leg"),
    (["solve", MODEL, "--lengths", "1,1,1,1,1,-1"], "--lengths, number 6: -1 is not positive"),
    (["solve", MODEL, "--lengths", "1,1,1,1,1,nan"], "--lengths, number 6: nan is not a finite number"),
    (["solve", MODEL, "--lengths", "1,1,1,1,1,__import__('os')"], "--lengths, number 6: __import__"),
    (["solve", MODEL, "--lengths", "1,1,1,1,1," + "1" * 100_000], "is too long; use at most 200 digits"),
    (["solve", MODEL, "--lengths", "1,1,1,1,1,1e999999999"], "1e999999999 is too long"),
    (["solve", MODEL, "--formulation", "AFD99"], "--formulation: 'AFD99' is unknown; use one of SE3, AFD1"),
    (["solve", MODEL, "--formulation", "AFD1:zzy"], "'zzy' is no Euler convention"),
    (["solve", MODEL, "--width", "0"], "--width: 0 is not positive"),
    (["solve", MODEL, "--width", "wide"], "--width: wide is not a number"),
    (["solve", MODEL, "--width", "2"], "--width: '2' is out of range"),
    (["solve", MODEL, "--format", "yaml"], "'yaml' is not one of 'table', 'json', 'csv'"),
    (["solve", MODEL, "-o", str(ROOT)], "is a directory; give -o the path of a file"),
    (["solve", MODEL, "-o", str(ROOT / "nowhere" / "c.json")], "does not exist; create it"),
    (["solve", MODEL, "--nonsense"], "no such option"),
    (["prove", MODEL], "no such command 'prove'"),
    (["check"], "missing argument 'PATH...'"),
    (["check", "missing.json"], "missing.json: cannot be read (No such file or directory)"),
]


@pytest.mark.parametrize(("words", "part"), BAD_USAGE, ids=range(len(BAD_USAGE)))
def test_bad_usage_gives_one_sentence_and_exit_code_2(words: list[str], part: str, capsys: Capture) -> None:
    _fails(words, part, capsys)


BAD_MODELS = {
    "toml": ("lengths = [1,", "lengths = [1,,", "not valid TOML"),
    "kind": ("6-UPS", "6-XYZ", "kind: '6-XYZ' is unknown; use one of: 6-UPS"),
    "five legs": ("    [2, 0, 0],\n", "", "base.joints: 5 rows; give 6"),
    "two numbers": ("[1, 0, 1]", "[1, 0]", "platform.joints[2]: a list of 2"),
    "nan": ('"4/5"', "nan", "configurations[1].lengths[3]: nan is not a finite number"),
    "negative": ('"4/5"', "-0.8", "configurations[1].lengths[3]: -0.8 is not positive"),
    "million": ('"4/5"', "8" * 10**6, "(1000000 digits) is too long a number"),
    "code": ('"4/5"', "\"exec('1')\"", "configurations[1].lengths[3]: \"exec('1')\" is not a number"),
}


@pytest.mark.parametrize("name", BAD_MODELS)
def test_a_bad_model_gives_one_sentence_and_no_file(name: str, tmp_path: Path, capsys: Capture) -> None:
    old, new, part = BAD_MODELS[name]
    path = tmp_path / "bad.toml"
    path.write_text(Path(MODEL).read_text().replace(old, new, 1))
    _fails(["solve", str(path), "-o", str(tmp_path / "cert.json")], f"{path}: ", capsys)
    assert main(["solve", str(path), "-o", str(tmp_path / "cert.json")]) == 2
    assert part in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == [path]


def test_linear_algebra_has_one_thread_unless_the_user_says_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    main(["--version"])
    assert (os.environ["OPENBLAS_NUM_THREADS"], os.environ["OMP_NUM_THREADS"]) == ("1", "3")


def test_no_command_shows_the_help(capsys: Capture) -> None:
    assert main([]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "Usage: certify-poses" in err


def test_table(quick: Solution, capsys: Capture) -> None:
    assert main(["solve", MODEL]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    lines = out.split("\n")
    assert lines[0] == "Mourrain L (6-UPS), configuration home, formulation SE3"
    assert lines[1].startswith("40 complex solutions, 4 real poses; complete: ")
    assert [line.split()[0] for line in lines[-5:-1]] == ["1", "2", "3", "4"]
    assert "-0.555382830" in out
    assert main(["solve", MODEL, "-v"]) == 0
    out = capsys.readouterr().out
    assert "method: exact; claim: complete; route: refined-bezout" in out
    assert "Groebner basis: none, as" in out


def test_details_tell_of_the_basis_if_there_is_one(capsys: Capture) -> None:
    assert main(["solve", str(ROOT / "models" / "3-rpr-merlet-p.toml"), "-v"]) == 0
    assert re.search(r"Groebner basis: \d+ elements, quotient of dimension 6; primes: 1", capsys.readouterr().out)


def test_json(quick: Solution, capsys: Capture) -> None:
    assert main(["solve", MODEL, "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["robot"]["name"] == "Mourrain L"
    assert answer["configuration"] == {"name": "home", "lengths_squared": ["1", "1", "16/25", "4", "4", "4"]}
    assert (answer["claim"], answer["completeness_route"]) == ("complete", "refined-bezout")
    assert (answer["complex_solutions"], answer["distinct_solutions"], answer["real_poses"]) == (40, 40, 4)
    assert (answer["formulation"], answer["method"]) == ("SE3", "exact")
    assert isinstance(answer["notes"], list)
    for found, pose in zip(answer["poses"], quick.poses, strict=True):
        assert [[Fraction(lo), Fraction(hi)] for lo, hi in found["position"]] == [[c.lo, c.hi] for c in pose.position]
        assert [len(row) for row in found["rotation"]] == [3, 3, 3]
        assert len(found["quaternion"]) == 4
        assert found["multiplicity"] == 1


def test_csv(quick: Solution, capsys: Capture) -> None:
    assert main(["solve", MODEL, "--format", "csv_exact"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert [row["pose"] for row in rows] == ["1", "2", "3", "4"]
    assert all(row["claim"] == "complete" for row in rows)
    assert [Fraction(row["r32_hi"]) for row in rows] == [pose.rotation[2][1].hi for pose in quick.poses]
    assert None not in rows[0]


def test_csv_has_decimals_and_angles_in_degrees(quick: Solution, capsys: Capture) -> None:
    assert main(["solve", MODEL, "--format", "csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert len(rows) == len(quick.poses)
    for row, pose in zip(rows, quick.poses, strict=True):
        assert [float(row[axis]) for axis in "xyz"] == pytest.approx([float(x) for x in pose.position], abs=1e-8)
        if row["yaw"] and row["roll"]:
            a, b, c = (math.radians(float(row[name])) for name in ("roll", "pitch", "yaw"))
            matrix = [
                [math.cos(c) * math.cos(b), math.cos(c) * math.sin(b) * math.sin(a) - math.sin(c) * math.cos(a)],
                [math.sin(c) * math.cos(b), math.sin(c) * math.sin(b) * math.sin(a) + math.cos(c) * math.cos(a)],
                [-math.sin(b), math.cos(b) * math.sin(a)],
            ]
            for found, wanted in zip(matrix, pose.rotation, strict=True):
                assert found == pytest.approx([float(x) for x in wanted[:2]], abs=1e-7)
    assert main(["solve", str(ROOT / "models" / "3-rpr-merlet-p.toml"), "--format", "csv"]) == 0
    assert capsys.readouterr().out.splitlines()[0].startswith("pose,name,claim,multiplicity,x,y,degrees")


def test_given_lengths_are_exact_and_have_no_name(quick: Solution, capsys: Capture) -> None:
    assert main(["solve", MODEL, "--lengths", "1, 1,4/5,2,2.0,2e0", "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["configuration"] == {"name": None, "lengths_squared": ["1", "1", "16/25", "4", "4", "4"]}


def test_options_reach_the_engine(solution: Solution, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    seen = {}

    def record(_: object, **options: object) -> Solution:
        seen.update(options)
        return solution

    monkeypatch.setattr(SOLVE, "solve", record)
    assert main(["solve", MODEL, "--formulation", "AFD1:zxz", "--width", "1e-30"]) == 0
    assert (seen["formulation"], seen["width"]) == ("AFD1:zxz", Fraction(1, 10**30))
    seen["progress"]("a stage")
    assert capsys.readouterr().err == ""


def test_solve_then_check(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "cert.json"
    assert main(["solve", MODEL, "-o", str(path)]) == 0
    assert list(tmp_path.iterdir()) == [path]
    capsys.readouterr()
    assert main(["check", str(path)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.split("\n")[-2] == f"{path}: accepted"
    assert len(out.split("\n")) > 3


def test_a_weaker_claim_has_exit_code_3(
    solution: Solution, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    weaker = replace(solution, claim=Claim.NOT_PROVEN_COMPLETE, completeness=None)
    monkeypatch.setattr(SOLVE, "solve", lambda problem, **_: replace(weaker, problem=problem))
    path = tmp_path / "cert.json"
    assert main(["solve", MODEL, "-o", str(path)]) == 3
    assert "4 real poses; not proven complete" in capsys.readouterr().out
    assert path.is_file()


def test_a_tampered_certificate_is_rejected(quick: Solution, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "cert.json"
    assert main(["solve", MODEL, "-o", str(path)]) == 0
    path.write_text(path.read_text().replace('"real_poses": 4', '"real_poses": 5'))
    capsys.readouterr()
    assert main(["check", str(path)]) == 1
    assert f"{path}: rejected" in capsys.readouterr().out


def test_both_checkers_print_the_same(capsys: Capture) -> None:
    certificate = str(Path(__file__).parent.parent / "certs" / "3-rrr.json")
    assert main(["check", certificate]) == 0
    fast = capsys.readouterr().out
    assert main(["check", "--pure", certificate]) == 0
    assert capsys.readouterr().out == fast
    assert main(["check", "--pure", __file__]) == 2


def test_check_combines_the_verdicts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    def verdict(data: bytes) -> SimpleNamespace:
        return SimpleNamespace(status=data.decode(), lines=("claim one: \x1b[2J", "claim two"))

    monkeypatch.setattr(CHECK, "check_bytes", verdict)
    paths = {}
    for status in ("accepted", "rejected", "malformed", "too-large"):
        paths[status] = str(tmp_path / status)
        Path(paths[status]).write_text(status)
    assert main(["check", paths["accepted"], paths["accepted"]]) == 0
    assert main(["check", paths["accepted"], paths["rejected"], paths["malformed"]]) == 1
    assert main(["check", paths["accepted"], paths["malformed"]]) == 2
    assert main(["check", paths["too-large"]]) == 2
    capsys.readouterr()
    assert main(["check", paths["accepted"], str(tmp_path / "missing")]) == 2
    out, err = capsys.readouterr()
    name = paths["accepted"]
    assert out == f"{name}: claim one: \\x1b[2J\n{name}: claim two\n{name}: accepted\n"
    assert err.count("\n") == 1


@pytest.mark.parametrize("options", [[], ["--pure"]])
def test_a_model_is_no_certificate(options: list[str], capsys: Capture) -> None:
    path = str(Path(__file__).parent.parent / "models" / "3-rrr.toml")
    assert main(["check", path, *options]) == 2
    lines = capsys.readouterr().out.splitlines()
    assert lines[-2:] == [f"{path}: give a certificate, as it is written with -o CERT.json", f"{path}: malformed"]


def test_an_engine_that_gives_up_has_exit_code_4(
    monkeypatch: pytest.MonkeyPatch, stays_empty: Path, capsys: Capture
) -> None:
    def give_up(*_: object, **__: object) -> None:
        raise ReconstructionError("the lift did not settle; raise the limit")

    monkeypatch.setattr(SOLVE, "solve", give_up)
    words = ["solve", MODEL, "-o", str(stays_empty / "cert.json")]
    _fails(words, "no answer: the lift did not settle", capsys, code=4)


def test_an_interrupt_is_quiet(monkeypatch: pytest.MonkeyPatch, stays_empty: Path, capsys: Capture) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(SOLVE, "solve", interrupt)
    assert main(["solve", MODEL, "-o", str(stays_empty / "cert.json")]) == 130
    out, err = capsys.readouterr()
    assert out == ""
    assert err.strip() == ""


def test_a_failing_write_leaves_nothing(
    quick: Solution, monkeypatch: pytest.MonkeyPatch, stays_empty: Path, capsys: Capture
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    _fails(["solve", MODEL, "-o", str(stays_empty / "cert.json")], "(No space left on device)", capsys)


@pytest.mark.skipif(os.name != "posix", reason="needs POSIX pipes")
def test_a_closed_pipe_is_no_traceback() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    command = [sys.executable, "-m", "pkm_exact.cli.main", "--help"]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, check=False, cwd=ROOT)
    os.close(writer)
    assert done.returncode == 141
    assert done.stderr == ""


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
def test_a_full_disk_is_no_traceback() -> None:
    command = [sys.executable, "-m", "pkm_exact.cli.main", "--help"]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False, cwd=ROOT)
    assert done.returncode == 2
    assert done.stderr.startswith("certify-poses: error: the output cannot be written (No space left on device)")


def test_headlines_say_what_is_claimed(solution: Solution) -> None:
    route = CompletenessRoute.REFINED_BEZOUT
    assert headline(solution).endswith(f"it is proved that there is no other ({route})")
    weaker = replace(solution, claim=Claim.NOT_PROVEN_COMPLETE, completeness=None, complex_solutions=41)
    assert headline(weaker).startswith("41 complex solutions (40 distinct), 4 real poses; not proven complete: ")
    for claim in (Claim.POSITIVE_DIMENSIONAL_DETECTED, Claim.POSITIVE_DIMENSIONAL_PROVED, Claim.INCONSISTENT):
        empty = replace(solution, claim=claim, completeness=None, representation=None, poses=())
        assert not headline(empty)[0].isdigit()
        answer = as_object(read_robot(MODEL), None, empty)
        assert (answer["claim"], answer["poses"], answer["completeness_route"]) == (claim.value, [], None)


@pytest.mark.parametrize(
    ("lo", "hi", "text"),
    [
        ("1/3", "1/3", "0.333333333333333"),
        ("-1250", "-1250", "-1250.000000000000000"),
        ("-1/1000", "1/1000", "0.00"),
        ("999999/1000000", "1000001/1000000", "1.00000"),
        ("0", "1", "0"),
        ("-0.05", "-0.049", "-0.050"),
    ],
)
def test_decimals_show_what_the_box_guarantees(lo: str, hi: str, text: str) -> None:
    interval = Interval(Fraction(lo), Fraction(hi))
    assert decimal(interval) == text
    unit = Fraction(1, 10 ** len(text.partition(".")[2]))
    assert max(abs(interval.lo - Fraction(text)), abs(interval.hi - Fraction(text))) <= unit


def test_the_model_is_not_overwritten_by_its_certificate(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = tmp_path / "robot.toml"
    text = (ROOT / "models" / "robocrane-r.toml").read_text()
    model.write_text(text)
    assert main(["solve", str(model), "-o", str(model)]) == 2
    assert "is the model file itself" in capsys.readouterr().err
    assert model.read_text() == text


def test_a_byte_order_mark_and_a_closed_output_do_no_harm(tmp_path: Path) -> None:
    model = tmp_path / "robot.toml"
    model.write_bytes(b"\xef\xbb\xbf" + (ROOT / "models" / "3-rpr-merlet-p.toml").read_bytes())
    start = "import sys; from pkm_exact.cli.main import main; sys.exit(main())"
    command = f"exec {sys.executable} -c '{start}' solve {model} >&-"
    done = subprocess.run(["sh", "-c", command], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")

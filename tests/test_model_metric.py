"""A metric other than 1 is said by every command that reads such a model, and poses are ordinary everywhere else."""

from __future__ import annotations

import json
import re
from decimal import Decimal
from pathlib import Path

import pytest
from samples import MODELS

from pkm_exact.cli.main import main
from pkm_exact.cli.model_reading import metric_note
from pkm_exact.geometry.reader import read_robot

TRAP = str(Path(__file__).parent / "cases" / "trap.toml")
"""Joints in millimetres under the metric of the hexagon that they took the place of."""
EXACT = next(str(path) for path in MODELS if path.stem == "robocrane-r")
CERTIFICATE = str(Path(EXACT).parent.parent / "certs" / "robocrane-r.json")
NOTE = "metric [1, 3, 1]: the ordinary y is sqrt(3) times the y in the file"
Capture = pytest.CaptureFixture[str]


def path_of(rows: list[str], folder: Path) -> str:
    path = folder / "path.csv"
    path.write_text("\n".join(rows) + "\n")
    return str(path)


def words_of(command: str, model: str, folder: Path) -> list[str]:
    home = ",".join(["4"] * 6)
    return {
        "solve": ["solve", model],
        "compare": ["compare", model, "--starts", "1", "--json", str(folder / "compared.json")],
        "formulations": ["formulations", model, "--only", "SE3", "--json", str(folder / "rows.json")],
        "export": ["export", model, "--to", "msolve"],
        "legs": ["legs", model, "--position", "0,0,3", "--quaternion", "1,0,0,0"],
        "sweep": ["sweep", model, path_of([home], folder), "-o", str(folder / "swept.jsonl"), "--workers", "1"],
        "track": ["track", model, path_of([home, home], folder), "--start", "1", "-o", str(folder / "out.json")],
        "plot": ["plot", CERTIFICATE, "--model", model, "-o", str(folder / "robot.png")],
        "report": ["report", CERTIFICATE, "--model", model, "-o", str(folder / "robot.html")],
    }[command]


COMMANDS = [
    "solve",
    "export",
    "legs",
    "report",
    *(pytest.param(c, marks=pytest.mark.slow) for c in ("compare", "formulations", "sweep", "track", "plot")),
]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_that_reads_a_model_says_its_metric(command: str, tmp_path: Path, capsys: Capture) -> None:
    main(words_of(command, EXACT, tmp_path))
    err = capsys.readouterr().err
    assert err.splitlines()[0] == f"certify-poses: note: {EXACT}: {NOTE}; poses given here or printed are ordinary"
    assert err.count("metric") == 1


def test_no_command_reads_a_model_without_saying_so() -> None:
    """All of them read models by one module; completion shows names only, ``new`` reads
    what it has written, of chains too, and ``region`` the text of a model once more that it has read as all do."""
    reading = {
        path.stem
        for path in (Path(__file__).parent.parent / "pkm_exact" / "cli").glob("*.py")
        if re.search(r"geometry\.reader import", path.read_text(encoding="utf-8"))
    }
    assert reading == {"model_reading", "shell_completion", "new", "new_chains", "region"}


def test_ordinary_models_need_no_note(capsys: Capture) -> None:
    main(["legs", str(next(p for p in MODELS if p.stem == "mourrain-l")), "--position", "0,0,3", "--cayley", "0,0,0"])
    assert capsys.readouterr().err == ""
    assert metric_note((1, 1)) is None
    assert metric_note((2, 9, 1)) == (
        "metric [2, 9, 1]: the ordinary x is sqrt(2) times the x in the file, the ordinary y is 3 times the y in the "
        "file; poses given here or printed are ordinary"
    )


@pytest.mark.parametrize(
    "model", [pytest.param(EXACT, id="exact"), pytest.param(TRAP, id="trap", marks=pytest.mark.slow)]
)
def test_a_printed_pose_is_the_same_when_it_is_pasted_back(model: str, capsys: Capture) -> None:
    """The trap means what its file says, another robot than the one meant; each output says so."""
    assert main(["solve", model, "--format", "json"]) == 0
    out, err = capsys.readouterr()
    assert NOTE in err
    answer = json.loads(out)
    assert answer["robot"]["metric"] == ["1", "3", "1"]
    pose = answer["poses"][0]
    position, quaternion = (",".join(map(_decimal, pose[key])) for key in ("position", "quaternion"))
    words = ["legs", model, f"--position={position}", f"--quaternion={quaternion}", "--nearest", "1e-12"]
    assert main([*words, "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    for length, square in zip(found["lengths"], read_robot(model).configuration().lengths_squared, strict=True):
        assert _number(length["bounds"][0]) == pytest.approx(float(square) ** 0.5, rel=1e-8)


def test_a_trap_is_announced(capsys: Capture) -> None:
    assert main(["legs", TRAP, "--position", "0,0,200", "--quaternion", "1,0,0,0"]) == 0
    assert NOTE in capsys.readouterr().err


def _number(text: str) -> float:
    numerator, _, denominator = text.partition("/")
    return float(Decimal(numerator) / Decimal(denominator or 1))


def _decimal(bounds: list[str]) -> str:
    return f"{sum(map(_number, bounds)) / 2:.15f}"

"""The benchmarks run: a small one, on a small robot."""

from __future__ import annotations

import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from tolerance_tools import exact_robot

from pkm_exact.backends.msolve_program import find_msolve
from pkm_exact.engine import solve
from pkm_exact.geometry.reader import read_jointed_robot
from pkm_exact.geometry.tolerances import Tolerances

SCRIPTS = Path(__file__).parent.parent / "benchmarks"


def _run(script: str, *arguments: str, limit: float = 120) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, SCRIPTS / script, *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False)


def test_engines_in_process(tmp_path: Path) -> None:
    words = ["--runs", "1", "--robots", "3-rpr-merlet-p", "--family", "--parts", "engines"]
    done = _run("bench.py", "--output", str(tmp_path), *words)
    assert done.returncode == 0, done.stderr
    results = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert set(results) == {"machine", "engines", "limits"}
    for method in ("exact", "krawczyk"):
        entry = results["engines"]["3-rpr-merlet-p"][method]
        assert entry["method"] == method
        assert 0 < sum(seconds for (seconds,) in entry["stages"].values()) <= entry["seconds"][0]
    assert {"date", "processor", "cores", "memory", "versions"} <= set(results["machine"])
    assert "| 3-rpr-merlet-p | " in (tmp_path / "report.md").read_text(encoding="utf-8")
    assert (tmp_path / "engines.svg").stat().st_size > 1000


def test_symmetric_robots_beside_msolve_and_shares_of_proofs(tmp_path: Path) -> None:
    words = ["--runs", "1", "--symmetric", "3-rpr-merlet-p", "--shipped", "3-rpr-merlet-p", "--parts"]
    done = _run("bench.py", "--output", str(tmp_path), *words, "symmetric", "proofs")
    results = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    entry = results["symmetric"]["3-rpr-merlet-p"]
    assert entry["seconds"][0] > 0, done.stderr
    (whole,), (proof,) = (results["proofs"]["3-rpr-merlet-p"][key] for key in ("processor", "proof"))
    assert 0 < proof < whole
    assert len(results["limits"]) == len(("beside msolve", "seconds", "share"))
    assert "| 3-rpr-merlet-p | exact-elimination | " in (tmp_path / "report.md").read_text(encoding="utf-8")


@pytest.mark.slow
def test_programs_side_by_side(tmp_path: Path) -> None:
    words = ["--runs", "1", "--limit", "20", "--robots", "3-rpr-merlet-p", "--family"]
    done = _run("bench.py", "--output", str(tmp_path), *words, "--parts", "programs")
    assert done.returncode == 0, done.stderr
    results = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    entries = results["whole processes"]["robots"]["3-rpr-merlet-p"]
    for method in ("exact", "krawczyk"):
        assert entries[method]["answer"] == "2 real, complete"
        assert all(run["memory"] > 1e7 and run["seconds"] > 0 for run in entries[method]["runs"])
    if "msolve" in entries:
        assert entries["msolve"]["answer"] == "6 complex, 2 real"
    assert "| pkm_exact, exact |" in (tmp_path / "report.md").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.largest
def test_growth(tmp_path: Path) -> None:
    words = ["--runs", "1", "--limit", "30", "--digits", "2", "4", "--batches", "1", "3"]
    done = _run("bench.py", "--output", str(tmp_path), *words, "--parts", "digits", "batches", limit=500)
    results = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert [point["digits"] for point in results["digits"]["exact"]] == [2, 4], done.stderr
    assert all(each["code"] == 0 and each["poses"] > 0 for each in results["batches"])
    assert len(results["batches"]) == len(("exact", "krawczyk")) * len((1, 3)) * len((1, 2))


@pytest.mark.slow
@pytest.mark.skipif(find_msolve() is None, reason="the program msolve is not installed")
def test_polynomial_systems_side_by_side(tmp_path: Path) -> None:
    done = _run("bench_systems.py", "--runs", "1", "--json", str(tmp_path / "times.json"), "trinks", "cohn2")
    assert done.returncode == 0, done.stderr
    rows = json.loads((tmp_path / "times.json").read_text(encoding="utf-8"))
    assert [(row["name"], row["degree"]) for row in rows] == [("trinks", 10), ("cohn2", None)]
    assert rows[0]["claim"] == "complete"
    assert all(0 < seconds < 100 for seconds in rows[0]["seconds"].values())
    assert done.stdout.count("\n| ") == 2
    assert _run("bench_systems.py", "no-such-system").returncode == 2


def test_a_command_that_does_not_end_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(SCRIPTS))
    from measure import run

    done = run([sys.executable, "-c", "import time; print('begun', flush=True); time.sleep(60)"], 0.5, tmp_path)
    assert done.code is None
    assert done.output == "begun\n"
    words = "block = bytearray(100 << 20); print(len(block)); raise SystemExit(7)"
    done = run([sys.executable, "-c", words], 60, tmp_path)
    assert done.code == 7
    assert 100 << 20 <= done.memory < 200 << 20


def test_zonotopes_are_measured(tmp_path: Path) -> None:
    done = _run("bench_zonotope.py", "--runs", "1", "--json", str(tmp_path / "times.json"))
    rows = json.loads((tmp_path / "times.json").read_text())
    assert [(row["facets"], row["vertices"]) for row in rows] == [(30, 32), (70, 84), (112, 240)], done.stderr
    assert all(row["agree"] and row["seconds"]["pkm_exact"] > 0 for row in rows)


def test_statics_are_measured(tmp_path: Path) -> None:
    words = ["--runs", "1", "--poses", "3000", "--rows", "2", "--json", str(tmp_path / "figures.json")]
    done = _run("bench_statics.py", *words)
    assert done.returncode in (0, 1), done.stderr
    found = json.loads((tmp_path / "figures.json").read_text())
    assert found["poses_a_second"] > 0 < found["columns_of_a_pose"]
    assert 0 <= found["widest"] < 1e-9


@pytest.mark.slow
def test_tolerances_are_measured(tmp_path: Path) -> None:
    """What is proved ends before the first robot that is seen to have lost the pose, and there exact poses vanish."""
    path = SCRIPTS.parent / "models" / "3-rpr-merlet-p.toml"
    done = _run("bench_tolerances.py", str(path), "--rays", "20", "--poses", "2", "--json", str(tmp_path / "rows.json"))
    assert done.returncode == 0, done.stderr
    rows = json.loads((tmp_path / "rows.json").read_text())
    assert [row["pose"] for row in rows] == [2]
    robot = read_jointed_robot(path, "this test")
    problem = robot.problem(robot.configuration())
    for row in rows:
        assert 0 < row["box"] < row["proved"] < row["directed"] <= row["random"] < 1
        tolerance = Fraction(row["directed"]).limit_denominator(10**5)
        errors = np.array(row["corner"], dtype=float).reshape(1, 3, 7)
        for factor, count in ((Fraction(97, 100), 2), (Fraction(103, 100), 0)):
            parts = errors[..., :3], errors[..., 3:6], errors[..., 6]
            assert len(solve(exact_robot(problem, Tolerances.uniform(factor * tolerance), parts)).poses) == count


@pytest.mark.slow
def test_following_is_measured(tmp_path: Path) -> None:
    done = _run("bench_following.py", "--runs", "1", "--json", str(tmp_path / "times.json"))
    assert done.returncode in (0, 1), done.stderr
    rows = json.loads((tmp_path / "times.json").read_text())
    assert [row["robot"] for row in rows][:2] == ["rolland-6-6", "hexa"]
    assert all(row["wrong"] == 0 and row["Python"] > 0 for row in rows)

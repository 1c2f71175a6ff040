"""Commands on mechanisms declared by constraints: what the constraints are at a pose, and sweeps of their values."""

import json
from fractions import Fraction
from pathlib import Path

import pytest

from pkm_exact import InputError, Mechanism, Robot, check, read_robot
from pkm_exact.cli.main import main

MODEL = str(Path(__file__).parent / "cases" / "3-rps.toml")
Capture = pytest.CaptureFixture[str]


def test_legs_gives_the_values_of_all_constraints_and_what_holds(capsys: Capture) -> None:
    pose = ["--position", "0,0,1", "--quaternion", "1,0,0,0"]
    assert main(["legs", MODEL, *pose, "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    found = {entry["name"]: entry for entry in answer["constraints"]}
    assert list(found) == ["leg 1", "leg 2", "leg 3", "hinge 1", "hinge 2", "hinge 3"]
    assert found["leg 1"]["value_squared"] == "5/4"
    assert found["leg 1"]["value"]["exact"] == "1/2*sqrt(5)"
    low, high = map(Fraction, found["leg 1"]["value"]["bounds"])
    assert low**2 <= Fraction(5, 4) <= high**2
    assert (found["leg 1"]["actuated"], found["leg 1"]["holds"]) == (True, None)
    assert (found["hinge 1"]["value"]["exact"], found["hinge 1"]["holds"]) == ("0", True)


def test_legs_says_which_constraints_do_not_hold(capsys: Capture) -> None:
    assert main(["legs", MODEL, "--position", "1,0,1", "--quaternion", "1,0,0,0", "--format", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert {entry["name"]: entry["holds"] for entry in answer["constraints"]}["hinge 2"] is False


def test_legs_prints_lines_for_a_configuration(capsys: Capture) -> None:
    assert main(["legs", MODEL, "--position", "0,0,1", "--quaternion", "1,0,0,0"]) == 0
    out = capsys.readouterr().out
    assert 'values_squared = { "leg 1" = "5/4", "leg 2" = "5/4", "leg 3" = "5/4" }' in out
    assert "hinge 1  in-plane" in out


def test_a_rotation_of_the_wrong_kind_is_refused(capsys: Capture) -> None:
    assert main(["legs", MODEL, "--position", "0,0", "--half-tangent", "0"]) == 2
    assert "--half-tangent is for planar robots" in capsys.readouterr().err


def test_a_sweep_takes_the_values_of_actuated_constraints(tmp_path: Path, capsys: Capture) -> None:
    rows, out, certificates = tmp_path / "values.csv", tmp_path / "out.jsonl", tmp_path / "certificates"
    rows.write_text("leg 1,leg 2,leg 3\n13/10,13/10,1.3\n0,1,1\n1,1\n")
    words = ["sweep", MODEL, str(rows), "-o", str(out), "--workers", "1", "--certificates", str(certificates)]
    assert main(words) == 3
    first, second, third = map(json.loads, out.read_text().splitlines())
    assert (first["claim"], first["complex_solutions"], first["real_poses"]) == ("complete", 16, 8)
    assert second["error"] == "line 3: values, 'leg 1': 0 is not positive; give a length greater than 0"
    assert third["error"] == "line 4: 2 values; give 3: leg 1, leg 2, leg 3"
    (file,) = certificates.iterdir()
    assert check(file)
    capsys.readouterr()


def test_a_mechanism_without_actuators_has_nothing_to_sweep(tmp_path: Path, capsys: Capture) -> None:
    model, rows = tmp_path / "fixed.toml", tmp_path / "values.csv"
    model.write_text(
        'schema = 1\nname = "it"\nkind = "constraints"\nunit = "m"\nsource = "made up"\n'
        '[[constraints]]\nname = "a"\ntype = "at-point"\npoint = [0, 0, 0]\nplatform = [0, 0, 0]\n'
    )
    rows.write_text("1\n")
    assert main(["sweep", str(model), str(rows), "-o", str(tmp_path / "out")]) == 2
    assert "it has no actuated constraints; solve its configurations one by one" in capsys.readouterr().err


def test_files_are_loaded_by_the_class_of_their_kind() -> None:
    mechanism = Mechanism.load(MODEL)
    assert mechanism == read_robot(MODEL)
    assert str(mechanism.solve()) == "16 complex solutions, 8 real poses; complete"
    with pytest.raises(InputError, match=r"is not one of Robot; load it with Mechanism\.load or read_robot"):
        Robot.load(MODEL)

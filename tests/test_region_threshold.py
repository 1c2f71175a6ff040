"""Thresholds: between which values of a number of the model an answer changes."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from samples import MODELS

from pkm_exact import InputError
from pkm_exact.cli.main import main
from pkm_exact.geometry.reader import robot_with

FILES = {path.stem: path for path in MODELS}
LINES = (
    "[region]\nposition = [0, 0, 0]\nrpy_degrees = [[-45, 45], [-45, 45], 0]\n[conditions]\nno_type_2 = true\n"
    "[answer]\nkind = 'threshold'\nparameter = 'dimensions.height'\n"
)


@pytest.mark.slow
def test_the_threshold_of_a_reconfigurable_joint(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Chapter 16: singularity-free from 2 sqrt(2) on; both answers hold, and the one that is yes has a certificate."""
    question, target = tmp_path / "question.toml", tmp_path / "out.json"
    question.write_text(f"{LINES}between = [2.8, 2.9]\n")
    model = str(FILES["2-ups-u"])
    assert main(["region", model, str(question), "--format", "json", "-o", str(target)]) == 0
    content = json.loads(capsys.readouterr().out)
    low, high = map(Fraction, content["between"])
    assert low * low < 8 < high * high
    assert high - low <= Fraction(1, 1000) * high
    assert content["verdicts"] == ["refuted", "proved"]
    assert main(["check", str(target)]) == 0
    assert json.loads(target.read_text())["robot"]["legs"][0]["platform"][2] == str(high)


def test_what_does_not_change_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    question, model = tmp_path / "question.toml", str(FILES["2-ups-u"])
    for lines, said in (
        (f"{LINES}between = [3, 4]", "the answer is yes at both ends"),
        (f"{LINES}between = [2, '5/2']", "the answer is no at both ends"),
        (f"{LINES}between = [4, 3]", "not less than"),
        (LINES, "between: is missing"),
        (f"{LINES.replace('dimensions.height', 'dimensions.depth')}between = [3, 4]", "is not in the model"),
        (f"{LINES.replace('dimensions.height', 'dimensions')}between = [3, 4]", "is no number of the model"),
        (f"{LINES.replace('dimensions.height', 'name')}between = [3, 4]", "is no number of the model"),
        (f"{LINES.replace('dimensions.height', 'schema')}between = [3, 4]", "is no number of the model"),
        (f"{LINES.replace('threshold', 'all')}", "belongs to the kind threshold"),
        (f"{LINES}between = [2.8, 2.9]\nshape = 'cube'", "belongs to the kind largest"),
    ):
        question.write_text(f"{lines}\n")
        assert main(["region", model, str(question), "-o", str(tmp_path / "a.json")]) == 2
        assert said in capsys.readouterr().err
        assert not (tmp_path / "a.json").exists()


def test_numbers_of_a_model_are_found_and_changed() -> None:
    text = FILES["3-rpr-merlet-p"].read_text()
    robot = robot_with(text, "base.joints.2.1", Fraction(31, 2))
    assert robot.base_joints[1][0] == Fraction(31, 2)  # type: ignore[union-attr]
    for key in ("base.joints.9.1", "base.joints.0.1", "base.joints.x.1", "name.first", "base.joints.2"):
        with pytest.raises(InputError, match=r"answer\.parameter"):
            robot_with(text, key, Fraction(1))

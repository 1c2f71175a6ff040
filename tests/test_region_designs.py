"""For which designs a question about a region is answered yes: against the answers of single designs."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from samples import MODELS, model

from pkm_exact import InputError, Robot
from pkm_exact.cli.main import main
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_designs import NO, OPEN, YES, Designs, designs
from pkm_exact.regions.region_legs import RegionLeg, RegionMachine, region_machine
from pkm_exact.regions.region_solver import answered

FILES = {path.stem: path for path in MODELS}
SQUARE = "position = [[4, 6], [4, 6]]\ndegrees = 0"
Change = Callable[[RegionLeg, int, Mapping[str, Fraction]], RegionLeg]


def text_of(region: str, conditions: str, parameters: str, more: str = "") -> str:
    """A question about designs."""
    answer = f"kind = 'designs'\nparameters = {{ {parameters} }}\n{more}"
    return f"[region]\n{region}\n[conditions]\n{conditions}\n[answer]\n{answer}\n"


def agree(machine: RegionMachine, text: str, change: Change, steps: int = 30) -> Designs:
    """The designs; those in the middle of decided boxes have the answers of the robot with these numbers."""
    question = question_from_toml(text, machine)
    found = designs(machine, question)
    answer = replace(question.answer, kind="all", parameters=(), steps=steps)
    for box in found.boxes:
        values = {key: (low + high) / 2 for key, (low, high) in zip(found.keys, box.ends, strict=True)}
        if box.verdict == OPEN:
            continue
        legs = tuple(change(leg, k, values) for k, leg in enumerate(machine.legs))
        one = answered(replace(machine, legs=legs), replace(question, answer=answer))
        assert one.is_proved is (box.verdict == YES), values
        assert (one.counterexample is not None) is (box.verdict == NO), values
    assert sum(found.share(verdict) for verdict in (YES, NO, OPEN)) == 1
    return found


def _scaled(vector: Any, factor: Fraction) -> Any:
    return tuple(x * factor for x in vector)


def test_sizes_of_base_and_platform_that_have_no_singularity() -> None:
    """Both at once; every box is decided as its middle is."""
    machine = region_machine(model("3-rpr-merlet-p"))
    parameters = "'base.scale' = [1, 1.4], 'platform.scale' = [0.9, 1.1]"
    text = text_of(SQUARE, "no_type_2 = true", parameters, "precision = 0.25")
    found = agree(
        machine,
        text,
        lambda leg, _, values: replace(
            leg,
            base=_scaled(leg.base, values["base.scale"]),
            platform=_scaled(leg.platform, values["platform.scale"]),
        ),
    )
    assert {box.verdict for box in found.boxes} == {YES, NO, OPEN}
    assert found.share(OPEN) < Fraction(3, 4)


def test_a_joint_may_stand_between_these_places() -> None:
    machine = region_machine(model("3-rpr-merlet-p"))
    text = text_of(SQUARE, "no_type_2 = true", "'base.joints.2.1' = [5, 40]", "precision = 0.05")

    def change(leg: RegionLeg, number: int, values: Mapping[str, Fraction]) -> RegionLeg:
        return replace(leg, base=(values["base.joints.2.1"], *leg.base[1:])) if number == 1 else leg

    found = agree(machine, text, change)
    assert {box.verdict for box in found.boxes} == {YES, NO, OPEN}
    assert found.share(OPEN) < Fraction(1, 4)


def test_how_long_rods_must_be_for_all_to_be_reached() -> None:
    """Rods on slides: longer ones reach farther."""
    machine = region_machine(model("3-prr"))
    x, y = Fraction(31, 5), Fraction(19, 5)
    region = f"position = [['{x}', '{x + 1}'], ['{y}', '{y + 1}']]\ndegrees = 0"
    text = text_of(region, "reachable = true", "'rods.length' = [1, 12]", "precision = 0.05")

    def change(leg: RegionLeg, _: int, values: Mapping[str, Fraction]) -> RegionLeg:
        actuator: Any = leg.actuator
        return replace(leg, actuator=replace(actuator, rod_squared=values["rods.length"] ** 2))

    found = agree(machine, text, change)
    words = [box.verdict for box in found.boxes]
    assert words == sorted(words, key=[NO, OPEN, YES].index)
    assert {NO, YES} <= set(words)


def test_the_command_and_programs_have_the_boxes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    question = tmp_path / "question.toml"
    question.write_text(text_of(SQUARE, "no_type_2 = true", "'base.scale' = [1, 1.5]", "precision = '1/4'"))
    command = ["region", str(FILES["3-rpr-merlet-p"]), str(question)]
    assert main(command) == 0
    out = capsys.readouterr().out
    assert "base.scale from 1 to " in out
    assert ": no\n" in out
    assert main([*command, "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    found = Robot.load(FILES["3-rpr-merlet-p"]).region(question)
    assert isinstance(found, Designs)
    assert [box["verdict"] for box in content["boxes"]] == [box.verdict for box in found.boxes]
    assert Fraction(content["shares"]["yes"]) == found.share(YES)
    ends = [tuple(map(Fraction, box["box"][0])) for box in content["boxes"]]
    assert ends[0][0] == 1
    assert ends[-1][1] == Fraction(3, 2)
    assert all(one[1] == other[0] for one, other in pairwise(ends))
    assert main([*command, "-o", str(tmp_path / "a.json")]) == 0
    assert main(["check", str(tmp_path / "a.json")]) == 0
    assert main(["check", "--pure", str(tmp_path / "a.json")]) == 0
    assert main([*command, "--picture", str(tmp_path / "a.png")]) == 2
    assert "designs has no picture" in capsys.readouterr().err


def test_how_many_boxes_there_may_be_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pkm_exact.regions.region_designs.MOST_BOXES", 8)
    machine = region_machine(model("3-rpr-merlet-p"))
    text = text_of(SQUARE, "no_type_2 = true", "'base.scale' = [1, 1.5]", "precision = '1/1000'")
    found = designs(machine, question_from_toml(text, machine))
    assert 4 <= len(found.boxes) <= 8
    assert sum(found.share(verdict) for verdict in (YES, NO, OPEN)) == 1


@pytest.mark.parametrize(
    ("name", "parameters", "said"),
    [
        ("3-rpr-merlet-p", "", "give a table of 1 to 4 numbers"),
        ("3-rpr-merlet-p", "'height' = [1, 2]", "'height' is unknown; give base.scale"),
        ("3-rpr-merlet-p", "'base.joints.4.1' = [1, 2]", "'base.joints.4.1' is unknown"),
        ("3-rpr-merlet-p", "'base.joints.1.3' = [1, 2]", "'base.joints.1.3' is unknown"),
        ("3-rpr-merlet-p", "'base.scale' = [2, 1]", "2 is not less than 1"),
        ("3-rpr-merlet-p", "'rods.length' = [1, 2]", "no rods on slides or cranks"),
        ("3-rpr-turned", "'base.scale' = [1, 2]", "and no other joints"),
        ("3-rpr-merlet-p", "'base.scale' = [0, 2]", "0 is not positive"),
        ("3-rpr-merlet-p", "'base.scale' = [1, 2], 'base.joints.1.1' = [1, 2]", "move one joint; give one of them"),
    ],
)
def test_parameters_that_are_none_are_refused(name: str, parameters: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        question_from_toml(text_of(SQUARE, "no_type_2 = true", parameters), region_machine(model(name)))

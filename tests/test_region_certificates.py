"""Region certificates: accepted by both checkers as they are, and by neither with a part left out, added or renamed."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from fractions import Fraction
from importlib import resources
from pathlib import Path
from random import Random
from typing import Any

import jsonschema
import pytest
from region_certificates import QUESTIONS, SECOND, content_of, verdicts
from samples import MODELS

from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_counted
from pkm_exact.certify.checker import budget
from pkm_exact.certify.pure import check_counted as plainly_counted
from pkm_exact.cli import region
from pkm_exact.cli.main import main

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
SCHEMAS = {
    version: json.loads(
        resources.files("pkm_exact.certify").joinpath(f"region-certificate-{version}.schema.json").read_text("utf-8")
    )
    for version in (1, 2)
}
SQUARE = "[region]\nposition = [[0, 9], [0, 9]]\ndegrees = 0\n[conditions]\n"
CLAIMS = {
    "all of a planar robot": "all",
    "two poses": "not-all",
    "one pose": "not-all",
    "undecided": "undecided",
    "a ball": "all",
    "a prism of a Delta": "all",
    "turns with joints": "all",
    "legs apart": "all",
    "legs too near": "not-all",
    "a tube": "all",
    "a tube that is too wide": "not-all",
    "a straight way": "all",
    "a straight way through a singularity": "not-all",
    "an arc": "all",
    "joint values": "all",
    "joint values that do not suffice": "undecided",
}


SLOW = ("turns with joints", "singularities of cranks")


def _marked(names: Iterable[str]) -> list[Any]:
    return [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in names]


@pytest.mark.parametrize("name", _marked([*QUESTIONS, *SECOND]))
def test_both_checkers_accept_what_is_written(name: str) -> None:
    content = content_of(name)
    assert content["version"] == (2 if name in SECOND else 1)
    assert content["claim"] == CLAIMS.get(name, "map")
    first, second = verdicts(content)
    assert first[0] == second[0] == "accepted"
    assert first[1] == second[1]
    jsonschema.Draft202012Validator(SCHEMAS[content["version"]]).validate(sealed(content))


def _both(content: dict[str, Any], status: str, line: str) -> None:
    for found, lines in verdicts(content):
        assert (found, lines[-1]) == (status, line), lines


def test_a_part_left_out_is_rejected_by_both() -> None:
    for name in ("limits of legs", "a map of angles"):
        content = content_of(name)
        content["paving"] = content["paving"][:-1]
        _both(content, "rejected", "paving: parts of the region are missing")
    content = content_of("a ball")
    content["paving"] = "s" + content["paving"]
    _both(content, "rejected", "paving: parts of the region are missing")


def test_a_part_too_many_is_rejected_by_both() -> None:
    """Parts that overlap could be counted twice in an area: there is no place for them."""
    content = content_of("limits of legs")
    content["paving"] += "i"
    content["inside"] += 1
    _both(content, "rejected", "paving: it goes on after its end")


@pytest.mark.parametrize(("old", "new", "word"), [("u", "i", "inside"), ("u", "o", "outside"), ("i", "o", "outside")])
@pytest.mark.parametrize(
    "name", _marked(["limits of legs", "limits of slides", "limits of cranks", "singularities of cranks"])
)
def test_a_part_called_what_it_is_not_is_rejected_by_both(name: str, old: str, new: str, word: str) -> None:
    content = content_of(name)
    places = [place for place, letter in enumerate(content["paving"]) if letter == old]
    for place in Random(name).sample(places, 1):
        changed = content_of(name)
        changed["paving"] = f"{content['paving'][:place]}{new}{content['paving'][place + 1 :]}"
        _both(changed, "rejected", f"paving: the part of letter {place + 1} is not proved to be {word}")


def test_an_outside_part_is_not_inside() -> None:
    content = content_of("limits of legs")
    place = content["paving"].index("o")
    content["paving"] = content["paving"].replace("o", "i", 1)
    _both(content, "rejected", f"paving: the part of letter {place + 1} is not proved to be inside")


def _with(name: str, change: Callable[[dict[str, Any]], None]) -> dict[str, Any]:
    content = content_of(name)
    change(content)
    return content


FRAUDS: dict[str, tuple[str, Callable[[dict[str, Any]], None], str]] = {
    "more parts inside": (
        "limits of legs",
        lambda c: c.update(inside=c["inside"] + 1),
        "inside, undecided: not as many",
    ),
    "fewer undecided": (
        "limits of legs",
        lambda c: c.update(undecided=c["undecided"] - 1),
        "inside, undecided: not as many",
    ),
    "a larger area": ("limits of legs", lambda c: c["measure"].__setitem__(1, "99"), "measure: not that of the parts"),
    "a smaller area": ("limits of legs", lambda c: c["measure"].__setitem__(0, "0"), "measure: not that of the parts"),
    "an area of nothing": ("a ball", lambda c: c.update(measure=["0", "1"]), "measure: claimed where there is none"),
    "all of an undecided region": ("undecided", lambda c: c.update(claim="all"), "claim: not all parts are inside"),
    "undecided what is proved": ("a ball", lambda c: c.update(claim="undecided"), "claim: all parts are inside"),
    "a deeper halving": ("limits of legs", lambda c: c.update(axes=c["axes"][:2]), "paving: letter"),
    "a larger box": (
        "all of a planar robot",
        lambda c: c["chart"]["box"].__setitem__(0, ["-20", "20"]),
        "paving: the part of letter 1",
    ),
    "a pose beyond the box": (
        "one pose",
        lambda c: c["counterexample"][0].__setitem__(0, "41"),
        "counterexample: a pose is not",
    ),
    "a pose that is good": (
        "one pose",
        lambda c: c.update(counterexample=[["0", "5"]]),
        "counterexample: no condition",
    ),
    "two poses of one sign": (
        "two poses",
        lambda c: c.update(counterexample=[c["counterexample"][0]] * 2),
        "counterexample: the determinants",
    ),
    "a region without poses": (
        "a ball",
        lambda c: c["shape"].append({"constant": "-1", "linear": ["0"] * 3, "weights": ["0"] * 3}),
        "shape: the middle of the box is not in it",
    ),
    "two halves that do not meet": (
        "a prism of a Delta",
        lambda c: c["shape"].extend(
            {"constant": "-1/4", "linear": [sign, "0", "0"], "weights": ["0"] * 3} for sign in ("1", "-1")
        ),
        "shape: the middle of the box is not in it",
    ),
    "joints that forbid the poses": (
        "turns with joints",
        lambda c: c["robot"]["forms"][0].__setitem__(16, "1"),
        "chart: its poses are not all among",
    ),
}


@pytest.mark.parametrize("name", FRAUDS)
def test_frauds_are_rejected_by_both(name: str) -> None:
    subject, change, line = FRAUDS[name]
    for status, lines in verdicts(_with(subject, change)):
        assert status == "rejected"
        assert lines[-1].startswith(line)


def test_a_pose_beyond_a_ball_refutes_nothing() -> None:
    content = content_of("a ball")
    content |= {"claim": "not-all", "paving": "", "inside": 0}
    content["counterexample"] = [["60", "60", "830", "0"]]
    _both(content, "rejected", "counterexample: a pose is not one of the region")


def test_a_region_that_holds_its_middle_has_poses() -> None:
    """A part of the shape that is 0 there takes none of them away for certain: still accepted."""
    content = content_of("a ball")
    content["shape"].append({"constant": "0", "linear": ["1", "0", "0"], "weights": ["0"] * 3})
    assert [status for status, _ in verdicts(content)] == ["accepted"] * 2


MALFORMED: dict[str, tuple[str, Callable[[dict[str, Any]], None]]] = {
    "another letter": ("a ball", lambda c: c.update(paving="x")),
    "no word": ("a ball", lambda c: c.update(paving=["i"])),
    "an axis of nothing": ("a ball", lambda c: c.update(axes=[4])),
    "conditions out of order": ("a ball", lambda c: c["conditions"].reverse()),
    "no conditions": ("a ball", lambda c: c.update(conditions=[])),
    "a strange condition": ("a ball", lambda c: c.update(conditions=["good"])),
    "a mode of 2": ("a ball", lambda c: c["modes"].__setitem__(0, 2)),
    "modes of other legs": ("a ball", lambda c: c["modes"].pop()),
    "no mode where it matters": ("singularities of cranks", lambda c: c["modes"].__setitem__(0, 0)),
    "no mode for limits": ("limits of slides", lambda c: c["modes"].__setitem__(0, 0)),
    "a claim of its own": ("a ball", lambda c: c.update(claim="most")),
    "ends out of order": ("a ball", lambda c: c["chart"]["box"][0].reverse()),
    "a point for an interval": ("a ball", lambda c: c["chart"]["box"].__setitem__(0, ["1", "1"])),
    "variables out of order": ("a ball", lambda c: c["chart"]["variables"].reverse()),
    "a variable that is nowhere": ("a ball", lambda c: c["chart"]["position"].__setitem__(0, "0")),
    "a variable in another place": ("a ball", lambda c: c["chart"]["position"].__setitem__(0, "y")),
    "a turn of nothing": ("a ball", lambda c: c["chart"]["turns"].__setitem__(0, ["0", "0"])),
    "a planar robot that leaves its plane": (
        "all of a planar robot",
        lambda c: c["chart"]["position"].__setitem__(2, "1"),
    ),
    "a planar robot that tilts": ("all of a planar robot", lambda c: c["chart"]["turns"].__setitem__(0, ["1", "1"])),
    "a Delta that turns": ("a prism of a Delta", lambda c: c["chart"]["turns"].__setitem__(2, ["1", "1"])),
    "a negative weight": ("a ball", lambda c: c["shape"][0]["weights"].__setitem__(0, "-1")),
    "a crank that is no circle": (
        "limits of cranks",
        lambda c: c["robot"]["legs"][0]["actuator"]["at_90"].__setitem__(1, "5"),
    ),
    "a crank that is not there": (
        "limits of cranks",
        lambda c: c["robot"]["legs"][0]["actuator"].update(at_0=["0"] * 3, at_90=["0"] * 3),
    ),
    "a crank with odd limits": ("limits of cranks", lambda c: c["robot"]["legs"][0].update(reach=["0", "10"])),
    "a slide without direction": (
        "limits of slides",
        lambda c: c["robot"]["legs"][0]["actuator"].update(direction=["0"] * 3),
    ),
    "a leg of another sort": ("a ball", lambda c: c["robot"]["legs"][0]["actuator"].update(type="rope")),
    "a negative length": ("limits of legs", lambda c: c["robot"]["legs"][0].update(reach=["-1", "3"])),
    "a cone of 31 degrees": ("limits of legs", lambda c: c["robot"]["base_cones"][0].update(degrees="31")),
    "a cone about nothing": ("limits of legs", lambda c: c["robot"]["base_cones"][0].update(axis=["0"] * 3)),
    "two cones of three legs": ("limits of legs", lambda c: c["robot"]["base_cones"].pop()),
    "half a metric": ("a ball", lambda c: c["robot"].update(metric=["1", "1/2", "1"])),
    "no legs": ("a ball", lambda c: c["robot"].update(legs=[])),
    "five legs for six freedoms": ("a ball", lambda c: (c["robot"]["legs"].pop(), c["modes"].pop())),
    "a paving beside a counterexample": ("one pose", lambda c: c.update(paving="u")),
    "a counterexample beside a paving": ("a ball", lambda c: c.update(counterexample=[["0", "0", "770", "0"]])),
    "three poses": ("two poses", lambda c: c.update(counterexample=c["counterexample"] + c["counterexample"][:1])),
    "two poses without a determinant": ("one pose", lambda c: c.update(counterexample=c["counterexample"] * 2)),
    "another version": ("a ball", lambda c: c.update(version=2)),
    "a key too many": ("a ball", lambda c: c.update(more=1)),
}


@pytest.mark.parametrize("name", MALFORMED)
def test_what_is_no_certificate_is_malformed_for_both(name: str) -> None:
    subject, change = MALFORMED[name]
    assert [status for status, _ in verdicts(_with(subject, change))] == ["malformed"] * 2


@pytest.mark.parametrize("name", _marked(["limits of legs", "singularities of cranks"]))
def test_a_changed_robot_is_no_longer_proved(name: str) -> None:
    """Joints moved far away: some part is not what the paving says; both checkers say the same."""
    content = content_of(name)
    for leg in range(len(content["robot"]["legs"])):
        changed = content_of(name)
        joint = changed["robot"]["legs"][leg]["platform"]
        joint[0] = str(Fraction(joint[0]) + 3)
        first, second = verdicts(changed)
        assert first == second
        assert first[0] == "rejected"


def test_work_is_linear_in_the_parts() -> None:
    """Twice the parts, twice the work, in both checkers."""
    from region_certificates import machine_of

    from pkm_exact.certify.region_build import region_certificate
    from pkm_exact.regions.question_reader import question_from_toml
    from pkm_exact.regions.region_legs import region_machine
    from pkm_exact.regions.region_solver import answered

    machine = region_machine(machine_of(*QUESTIONS["limits of legs"][:2]))
    spent = []
    for steps in (6, 10):
        text = f"{SQUARE}limits = true\n[answer]\nkind = 'map'\nsteps = {steps}"
        content = region_certificate(answered(machine, question_from_toml(text, machine)))
        data = canonical_bytes(content)
        letters = len(content["paving"])
        counts = [count(data)[1].spent - 1000 * len(data) for count in (check_counted, plainly_counted)]
        spent.append([count / letters for count in counts])
    assert all(b < 1.6 * a for a, b in zip(*spent, strict=True))


def test_the_command_writes_and_the_checkers_read(tmp_path: Path, capsys: Capture) -> None:
    question, target = tmp_path / "question.toml", tmp_path / "out.json"
    question.write_text(f"{SQUARE}reachable = true\n[answer]\nkind = 'map'\nsteps = 9\n")
    model = str(FILES["3-rrr"])
    assert main(["region", model, str(question), "-o", str(target)]) == 0
    assert not (tmp_path / "out.json.partial").exists()
    assert main(["check", str(target)]) == 0
    assert main(["check", "--pure", str(target)]) == 0
    capsys.readouterr()
    for command in (
        ["plot", str(target), "-o", str(tmp_path / "a.png")],
        ["report", str(target), "-o", str(tmp_path / "a.html")],
    ):
        assert main(command) == 2
        assert "region" in capsys.readouterr().err
    assert main(["region", model, str(question), "-o", str(question)]) == 2


def test_an_interrupted_map_goes_on_to_the_same_bytes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from pkm_exact.regions import region_solver

    question, target = tmp_path / "question.toml", tmp_path / "out.json"
    question.write_text(f"{SQUARE}reachable = true\n[answer]\nkind = 'map'\nsteps = 11\n")
    command = ["region", str(FILES["3-rrr"]), str(question), "-o", str(target)]
    assert main(command) == 0
    whole = target.read_bytes()
    target.unlink()
    pave_part, done = region_solver.pave_part, []

    def interrupted(*given: Any) -> Any:
        if len(done) == 5:
            raise KeyboardInterrupt
        done.append(given[1])
        return pave_part(*given)

    monkeypatch.setattr(region_solver, "pave_part", interrupted)
    assert main(command) == 130
    assert not target.exists()
    assert len((tmp_path / "out.json.partial").read_text().splitlines()) == 6
    monkeypatch.setattr(region_solver, "pave_part", pave_part)
    assert main(command) == 0
    assert target.read_bytes() == whole


def test_a_certificate_that_checkers_cannot_afford_is_not_written_without_a_word(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    question, target = tmp_path / "question.toml", str(tmp_path / "out.json")
    question.write_text(f"{SQUARE}reachable = true\n[answer]\nkind = 'map'\nsteps = 4\n")
    command = ["region", str(FILES["3-rrr"]), str(question), "-o", target]
    monkeypatch.setattr(region, "MANY_PARTS", 1)
    assert main(command) == 0
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(budget, "BASE", 0)
    monkeypatch.setattr(budget, "PER_BYTE", 1)
    assert main(command) == 0
    assert f"{target}: to check it takes more work than checkers allow" in capsys.readouterr().err


def test_limits_without_rational_cosines_have_no_certificate(tmp_path: Path, capsys: Capture) -> None:
    text = FILES["3-rpr-merlet-p"].read_text()
    table = "[limits]\nbase_cones = { axes = [1, 1], angle = 50 }\n[[configurations]]"
    robot, question = tmp_path / "robot.toml", tmp_path / "question.toml"
    robot.write_text(text.replace("[[configurations]]", table, 1))
    question.write_text(f"{SQUARE}limits = true\n[answer]\nkind = 'map'\nsteps = 3\n")
    assert main(["region", str(robot), str(question)]) == 0
    assert main(["region", str(robot), str(question), "-o", str(tmp_path / "out.json")]) == 2
    assert "no rational cosine squared" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("variables", [pytest.param(6, marks=pytest.mark.largest), 3])
def test_long_numbers_are_charged_by_their_length(variables: int) -> None:
    """Six slides whose numbers have 600 digits: a determinant that nobody could wait for is not begun."""
    random = Random(variables)

    def number() -> str:
        return str(Fraction(random.randrange(10**599, 10**600), random.randrange(10**599, 10**600)))

    def numbers() -> list[str]:
        return [number() for _ in range(3)]

    names = ("x", "y", "z", "roll", "pitch", "yaw")[:variables]
    legs = [
        {"name": str(k), "base": numbers(), "platform": numbers()}
        | {"actuator": {"type": "slide", "direction": numbers(), "rod_squared": number()}, "reach": None}
        for k in range(6)
    ]
    content = content_of("two poses") | {
        "robot": {"name": "long", "unit": "m", "source": "made up", "motion": "spatial", "metric": ["1", "1", "1"]}
        | {"legs": legs, "forms": [], "base_cones": [], "platform_cones": [], "position": []},
        "chart": {
            "variables": list(names),
            "box": [["0", "1"]] * variables,
            "position": ["x", "y", "z"],
            "quaternion": None if variables == 6 else ["1", "0", "0", number()],
            "turns": [[name] for name in names[3:]],
        },
        "modes": [1] * 6,
        "claim": "not-all",
        "counterexample": [["1/2"] * variables],
    }
    assert [found for found, _ in verdicts(content)] == ["too-large", "too-large"]

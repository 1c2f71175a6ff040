"""Certificates of a platform's mobility: what is written is accepted, and both checkers say what is true."""

import json
from pathlib import Path

import pytest
from certificate_tools import CERTS
from forged_platform import ROWS, SIX

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import Status, check_bytes
from pkm_exact.cli.main import main

ROOT = CERTS.parent


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    data = canonical_bytes(sealed(content))
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == status, verdict.lines
        assert verdict.lines[-1].startswith(line), verdict.lines


QUESTIONS = {
    "rolland-6-6": ["--at", "0,0,650,9,1,0,-1"],
    "ssm-exact": ["--at", "0,0,500,1,0,0,0", "--actuated", "leg 1,leg 2,leg 3"],
    "3-rpr-merlet-p": ["--at", "5,9/2,1/3"],
    "3-rps": ["--at", "0,0,1/2,1,0,0,0"],
    "8-8": [],
    "3-prs": [],
    "h4": ["--actuated", "slide 1,slide 2,slide 3,slide 4"],
    "delta": [],
    "spherical-3-rrr": [],
    "3-prrr": [],
    "robocrane-r": ["--at", "1/10,1/20,1/5,10,1,1,2"],
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_what_is_written_is_accepted_and_comes_out_again(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "platform.json"
    assert main(["mobility", str(ROOT / "models" / f"{name}.toml"), *QUESTIONS[name], "-o", str(path)]) == 0
    data = path.read_bytes()
    one, other = check_bytes(data), pure.check_bytes(data)
    assert one.status is Status.ACCEPTED
    assert (other.status, other.lines) == ("accepted", one.lines)
    assert main(["check", "--recompute", str(path)]) == 0
    capsys.readouterr()
    assert main(["report", str(path), "-o", str(tmp_path / "page.html")]) == 2
    assert "lists no poses of a robot" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("path", sorted((ROOT / "models").glob("*.toml")), ids=lambda path: path.stem)
def test_every_model_has_a_certificate(path: Path, tmp_path: Path) -> None:
    target = tmp_path / "platform.json"
    assert main(["mobility", str(path), "-o", str(target)]) == 0
    assert check_bytes(target.read_bytes()).status is Status.ACCEPTED
    assert pure.check_bytes(target.read_bytes()).status == "accepted"


def _model(path: Path, legs: list[tuple[str, str]], motion: str, metric: str = "[1, 1, 1]") -> Path:
    text = f'schema = 1\nname = "legs"\nkind = "constraints"\nmotion = "{motion}"\nunit = "1"\nsource = "a test"\n'
    text += f"metric = {metric}\n"
    for k, (base, platform) in enumerate(legs, 1):
        text += f'[[constraints]]\nname = "leg {k}"\ntype = "distance"\nbase = {base}\nplatform = {platform}\n'
        text += "actuated = true\n"
    path.write_text(text)
    return path


def test_identities_for_every_pose_have_certificates(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The hypothetical robot of chapter 18, by one combination; legs of one base joint in the plane, by a grid."""
    hexagons = [(_listed(entry["base"]), _listed(entry["platform"])) for entry in SIX]
    merged = [("[0, 0]", f"[{x}, {y}]") for x, y in ((0, 0), (1, 0), (0, 1))]
    for legs, motion, metric, route, rank in (
        (hexagons, "spatial", "[1, 3, 1]", "combination", 5),
        (merged, "planar", "[1, 1, 1]", "grid", 2),
    ):
        path = tmp_path / f"{route}.json"
        assert main(["mobility", str(_model(tmp_path / "legs.toml", legs, motion, metric)), "-o", str(path)]) == 0
        assert json.loads(path.read_bytes())["everywhere"]["route"] == route
        capsys.readouterr()
        for option in ([], ["--pure"]):
            assert main(["check", *option, str(path)]) == 0
            assert f"everywhere: rank {rank} at most, at every pose" in capsys.readouterr().out


def _listed(numbers: list[str]) -> str:
    return json.dumps(numbers)


def test_a_drive_stands_for_what_it_moves(capsys: pytest.CaptureFixture[str]) -> None:
    """With two arms of a Delta locked, and at every pose; what is no actuator is named among those that are."""
    model = str(ROOT / "models" / "delta.toml")
    assert main(["mobility", model, "--actuated", "arm 1,arm 2", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["structural"], found["actuated"]) == (["rod 3"], ["rod 1", "rod 2"])
    assert main(["mobility", model, "--actuated", "slide 1"]) == 2
    assert "use some of: arm 1, arm 2, arm 3, rod 1, rod 2, rod 3" in capsys.readouterr().err
    assert main(["mobility", str(ROOT / "models" / "h4.toml"), "--at", "0,0,-42,1,0,0,0"]) == 2
    assert "does not hold at this pose with the actuators of the configuration" in capsys.readouterr().err


def test_drives_that_move_several_constraints_are_named(capsys: pytest.CaptureFixture[str]) -> None:
    """The platform may have fewer freedoms without them than without all that they move."""
    words = ["--at", "0,0,4,1,0,0,0"]
    assert main(["mobility", str(ROOT / "models" / "carriage-hexapod.toml"), *words]) == 0
    assert "or fewer: what the constraints of X, Y, tilt share is left out" in capsys.readouterr().out
    for name, sharing in (("3-prs", ["slide 1", "slide 2", "slide 3"]), ("delta", [])):
        assert main(["mobility", str(ROOT / "models" / f"{name}.toml"), "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["sharing"] == sharing

"""Pictures of mechanisms with passive bodies: bodies meet in pins, bars have their lengths, lines their joints."""

import json
from functools import cache
from math import dist, isclose, sqrt
from pathlib import Path

import pytest

from pkm_exact.certify.certified_links import joined_constraints
from pkm_exact.cli.main import main
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.distance import Distance
from pkm_exact.pictures.captions import statement, title
from pkm_exact.pictures.drawn_robot import BAR, BODY, Point, PoseView, Scene
from pkm_exact.pictures.scene import scene_of

CERTS = Path(__file__).parent.parent / "certs" / "links"
NAMES = sorted(path.stem for path in CERTS.glob("*.json"))


@cache
def _scene(name: str) -> Scene:
    return scene_of(json.loads((CERTS / f"{name}.json").read_bytes()))


def _bodies(name: str, pose: PoseView) -> dict[int, tuple[Point, ...]]:
    """The joints of all bodies that are drawn, by their numbers; 0 is the ground."""
    asked = json.loads((CERTS / f"{name}.json").read_bytes())["mechanism"]["platform"]
    passive = {part.number: part.points for part in pose.parts if part.kind == BODY}
    return {0: _scene(name).base, asked: pose.platform, **passive}


@pytest.mark.parametrize("name", NAMES)
def test_bodies_meet_in_their_pins(name: str) -> None:
    document = json.loads((CERTS / f"{name}.json").read_bytes())
    pins = [one for one in joined_constraints(document) if isinstance(one.constraint, AtPoint)]
    scene = _scene(name)
    assert len(scene.poses) == (1 if document["system"] is None else document["system"]["real_solutions"])
    for pose in scene.poses:
        bodies = _bodies(name, pose)
        for pin in pins:
            pairs = [(p, q) for p in bodies[pin.first] for q in bodies[pin.second]]
            assert min(dist(p, q) for p, q in pairs) < 1e-6 * scene.size


@pytest.mark.parametrize("name", ["3-rrr-links", "5-strut-pentapod", "micabo-h-links"])
def test_bars_have_their_lengths(name: str) -> None:
    document = json.loads((CERTS / f"{name}.json").read_bytes())
    squares = [
        float(one.constraint.length_squared)
        for one in joined_constraints(document)
        if isinstance(one.constraint, Distance)
    ]
    for pose in _scene(name).poses:
        bars = [part.points for part in pose.parts if part.kind == BAR]
        assert all(isclose(dist(*ends), sqrt(square), rel_tol=1e-6) for ends, square in zip(bars, squares, strict=True))


def test_a_slider_stands_on_its_rail() -> None:
    scene = _scene("micabo-h-links")
    for pose in scene.poses:
        sliders = [part.points[0] for part in pose.parts if part.kind == BODY]
        rails = [part.points for part in pose.parts if part.kind == "line"]
        assert len(rails) == len(sliders) == 6
        middles = [tuple((a + b) / 2 for a, b in zip(*rail, strict=True)) for rail in rails]
        assert all(min(dist(slider, middle) for middle in middles) < 1e-6 * scene.size for slider in sliders)


def test_words_say_nothing_of_a_jacobian() -> None:
    scene = _scene("watt")
    assert statement(scene) == "2 real poses of 4 complex solutions; complete"
    assert [title(pose) for pose in scene.poses] == ["1", "2"]
    assert statement(_scene("5-rrr-rr")) == "1 real pose listed; not proven complete"


@pytest.mark.parametrize("options", [[], ["--pose", "2"], ["--overlay"]])
def test_the_command_draws_them(options: list[str], tmp_path: Path) -> None:
    target = tmp_path / "watt.svg"
    assert main(["plot", str(CERTS / "watt.json"), "-o", str(target), *options]) == 0
    text = target.read_text(encoding="utf-8")
    assert "det J" not in text
    assert text.startswith("<?xml")


def test_a_model_is_refused_in_a_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = CERTS.parent.parent / "models" / "links" / "watt.toml"
    target = tmp_path / "watt.png"
    assert main(["plot", str(CERTS / "watt.json"), "-o", str(target), "--model", str(model)]) == 2
    assert "has all of it; leave out the model" in capsys.readouterr().err
    assert not target.exists()

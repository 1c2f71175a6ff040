"""The live view: sliders, what is proved where they stand, its colours, and the page in a real browser."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from samples import model

from pkm_exact.cli.main import main
from pkm_exact.geometry.limits import Limits
from pkm_exact.live.live_answer import first_answer, next_answer
from pkm_exact.live.sliders import sliders
from pkm_exact.live.stage_items import BANDS, BROKEN, UNDECIDED, Lines, Surface, legend, stage_items
from pkm_exact.live.viser_view import LiveView, as_label, as_text

ROOT = Path(__file__).parent.parent
PLANE = "3-rpr-merlet-p"


@pytest.mark.parametrize("name", [PLANE, "3-rrr", "3-prr", "delta", "h4", "rolland-6-6"])
def test_sliders_stand_at_the_configuration(name: str) -> None:
    robot = model(name)
    found = sliders(robot)
    assert len(found) == len(robot.actuated)
    words = [one.word(one.value) for one in found]
    before = first_answer(robot)
    after = next_answer(robot, words, before)
    assert after.why.startswith("joined")
    assert before.pose is not None
    assert after.pose is not None
    for one, other in zip(before.pose.position, after.pose.position, strict=True):
        assert abs(float(one) - float(other)) < 0.02 * before.scene.size
    for one in found:
        assert one.low <= one.value <= one.high
        assert (one.high - one.low) / one.step >= 900


def test_sliders_keep_to_the_limits_of_the_model() -> None:
    bounds = tuple((Fraction(k), Fraction(k + 8)) for k in (2, 3, 4))
    found = sliders(replace(model(PLANE), limits=Limits(lengths=bounds)))
    assert [(one.low, one.high) for one in found] == [(2, 10), (3, 11), (4, 12)]
    turned = sliders(replace(model("3-rrr"), limits=Limits(angles=((Fraction(0), Fraction(60)),) * 3)))
    assert (turned[0].low, turned[0].high, turned[0].name) == (0, 60, "leg 1 [degrees]")
    assert turned[0].word(31.25) == (Fraction(f"{31.25:.{turned[0].digits}f}"), True)


def test_the_solid_pose_is_followed_by_a_proof_or_said_not_to_be() -> None:
    robot = model(PLANE)
    start = replace(first_answer(robot), place=1)
    words = [(Fraction(x), False) for x in ("7.2", "5.1", "5.1")]
    after = next_answer(robot, words, start)
    assert after.why == "joined to the one before by regular poses, which is proved"
    assert after.pose is not None
    assert after.pose.det_sign == 1
    incomplete = replace(start, solution=replace(start.solution, claim=start.solution.claim.NOT_PROVEN_COMPLETE))
    assert "not proved" in next_answer(robot, words, incomplete).why
    none = next_answer(robot, [(Fraction(1, 10), False)] * 3, after)
    assert none.place is None
    assert len(none.lines()) == 1
    assert next_answer(robot, words, none).why == "the best conditioned"


def test_colours_say_what_is_proved() -> None:
    limits = Limits(lengths=tuple((Fraction(1), Fraction(6)) for _ in range(3)))
    robot = replace(model(PLANE), limits=limits)
    answer = first_answer(robot)
    items = {item.name: item for item in stage_items(answer)}
    assert any("Limits of the model kept: no (lengths)" in line for line in answer.lines())
    for view in answer.scene.poses:
        body, legs = items[f"pose {view.number}"], items[f"pose {view.number} legs"]
        assert view.condition is not None
        assert body.colour == next(colour for most, _, colour in BANDS if view.condition <= most)
        assert legs.colour == BROKEN[1]
        assert isinstance(body, Surface)
        assert isinstance(legs, Lines)
        assert (body.opacity == 1) == (view.number - 1 == answer.place)
        assert np.allclose(legs.segments[:, 1], view.platform, rtol=1e-6)
    assert BROKEN[0] in legend(with_limits=True)
    assert BROKEN[0] not in legend(with_limits=False)
    singular = first_answer(model("3-rpr-double-q"))
    colours = {item.colour for item in stage_items(singular) if getattr(item, "place", None) is not None}
    assert UNDECIDED[1] in colours


class _Handle(SimpleNamespace):
    def on_update(self, call: Callable[[Any], None]) -> None:
        self.call = call

    on_click = on_update

    def remove(self) -> None:
        self.stage.pop(self.name)

    def move(self, value: float) -> None:
        self.value = value
        self.call(None)


class _Viser:
    """What the view needs of viser, without a browser."""

    def __init__(self, **options: Any) -> None:
        print("a greeting")
        self.options, self.stage, self.handles, self.texts = options, dict[str, _Handle](), [], []
        self.scene = self.gui = self
        self.initial_camera = SimpleNamespace()

    ViserServer = property(lambda _: _Viser)

    def get_port(self) -> int:
        return int(self.options["port"])

    def set_up_direction(self, _: str) -> None: ...
    def configure_theme(self, **_: Any) -> None: ...
    def stop(self) -> None:
        self.stage.clear()

    def sleep_forever(self) -> None:
        raise KeyboardInterrupt

    atomic = staticmethod(nullcontext)

    def add_markdown(self, content: str) -> _Handle:
        self.texts.append(_Handle(content=content))
        return self.texts[-1]

    def add_slider(self, label: str, low: float, high: float, step: float, value: float) -> _Handle:
        assert low <= value <= high
        assert step > 0
        self.handles.append(_Handle(label=label, value=value))
        return self.handles[-1]

    def _added(self, name: str, *arrays: Any, **options: Any) -> _Handle:
        assert name not in self.stage
        self.stage[name] = _Handle(name=name, stage=self.stage, arrays=arrays, options=options)
        return self.stage[name]

    add_line_segments = add_mesh_simple = _added


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "viser", SimpleNamespace(ViserServer=_Viser))  # type: ignore[arg-type]


@pytest.mark.usefixtures("fake")
def test_the_page_follows_the_sliders(capsys: pytest.CaptureFixture[str]) -> None:
    view = LiveView(model(PLANE), None, 8080)
    server: Any = view._server
    assert server.options["host"] == "127.0.0.1"
    assert capsys.readouterr().out == ""
    assert "2 real poses; complete" in server.texts[1].content
    assert [handle.label for handle in server.handles] == ["leg 1", "leg 2", "leg 3"]
    assert set(server.stage) == {f"/{item.name}" for item in stage_items(view.answer)}
    points = np.concatenate([np.reshape(handle.arrays[0], (-1, 3)) for handle in server.stage.values()])
    assert np.abs(points).max() < 2
    before = view.answer
    server.handles[0].move(7.2)
    assert view.answer is not before
    assert "joined to the one before" in server.texts[1].content
    again = view.answer
    server.handles[0].move(7.2)
    assert view.answer is again
    assert again.place is not None
    server.stage[f"/pose {2 - again.place}"].call(None)
    assert view.answer.place == 1 - again.place
    assert "chosen here" in server.texts[1].content
    server.handles[0].move(-1.0)
    assert server.texts[1].content.startswith("No answer: sliders, leg 1: -1 is no length")
    assert server.stage
    view.stop()


@pytest.mark.usefixtures("fake")
def test_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["view", str(ROOT / f"models/{PLANE}.toml"), "--port", "8099", "--near", "5,5,0"]
    assert main(words) == 130
    assert capsys.readouterr().out == "http://127.0.0.1:8099 (Ctrl-C ends it)\n"
    assert main(["view", str(ROOT / "models/links/watt.toml")]) == 2
    assert main(["view", str(ROOT / f"models/{PLANE}.toml"), "--configuration", "nowhere"]) == 2
    assert "nowhere" in capsys.readouterr().err


def test_without_viser_one_sentence_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "viser", None)
    assert main(["view", str(ROOT / f"models/{PLANE}.toml")]) == 2
    error = capsys.readouterr().err
    assert 'pip install "pkm_exact[view]"' in error
    assert error.count("\n") == 1


def test_names_of_a_model_are_no_markup() -> None:
    assert as_text("<img src=x> [a](b) `c`\x1b") == r"\<img src=x\> \[a\](b) \`c\`\\x1b"
    assert len(as_label("x" * 500)) == 40


BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
FLAGS = ("headless", "no-sandbox", "disable-dev-shm-usage", "no-first-run", "enable-unsafe-swiftshader")


@pytest.fixture
def chromium(tmp_path: Path) -> Iterator[Any]:
    pytest.importorskip("viser", reason="viser is not installed: pip install 'pkm_exact[view]'")
    selenium = pytest.importorskip("selenium.webdriver")
    driver = shutil.which("chromedriver")
    if not (BROWSER and driver):
        pytest.skip("no chromium with chromedriver is installed")
    options = selenium.ChromeOptions()
    options.binary_location = BROWSER
    for flag in (*FLAGS, "window-size=1200,800", f"user-data-dir={tmp_path}"):
        options.add_argument(f"--{flag}")
    options.set_capability("goog:loggingPrefs", {"performance": "ALL"})
    found = selenium.Chrome(options=options, service=selenium.ChromeService(executable_path=driver))
    found.get("about:blank")
    yield found
    found.quit()


def _waited(chromium: Any, words: str) -> str:
    """The text of the page once it has these words."""
    from selenium.webdriver.support.ui import WebDriverWait

    def text(_: Any) -> str | None:
        found = str(chromium.execute_script("return document.body.innerText"))
        return found if words in found else None

    return str(WebDriverWait(chromium, 60).until(text))


def test_a_slider_in_a_real_browser(chromium: Any) -> None:
    view = LiveView(model("rolland-6-6"), None, 8123)
    try:
        chromium.get_log("performance")
        chromium.get(view.address)
        assert "Rolland 6-6" in _waited(chromium, "16 real poses; complete")
        thumbs = chromium.find_elements("css selector", "[role=slider]")
        assert [thumb.get_attribute("aria-valuenow") for thumb in thumbs] == ["1250"] * 6
        thumbs[0].send_keys("\ue010")  # the key End
        assert "joined to the one before" in _waited(chromium, " 4 real poses; complete")
        assert float(view._handles[0].value) == 1500
        assert len(view.answer.scene.poses) == 4
        assert _colours(chromium.get_screenshot_as_png()) > 100
        calls = [entry["message"] for entry in chromium.get_log("performance")]
        assert not [call for call in calls if "requestWillBeSent" in call and "https://" in call]
    finally:
        view.stop()


def _colours(data: bytes) -> int:
    """How many pixels of the stage are neither white nor grey."""
    from io import BytesIO

    import matplotlib.image

    pixels = matplotlib.image.imread(BytesIO(data), format="png")[200:700, 50:800, :3]
    return int((np.ptp(pixels, axis=2) > 0.3).sum())

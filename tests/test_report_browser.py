"""The web page of a certificate in a real browser: mouse, touch, keyboard, both themes, small screens, no network."""

from __future__ import annotations

import csv
import io
import json
import shutil
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from certificate_tools import golden
from samples import model, solved
from test_report_page import HOSTILE, data_of, page, written

from pkm_exact import Robot, certificate, read_robot, solve
from pkm_exact.cli.feasible_poses import ShownPoses
from pkm_exact.cli.main import main
from pkm_exact.cli.report import as_rows

if TYPE_CHECKING:
    from selenium.webdriver.chrome.webdriver import WebDriver

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
DRIVER = shutil.which("chromedriver")
pytestmark = pytest.mark.skipif(not (BROWSER and DRIVER), reason="no chromium with chromedriver is installed")

FLAGS = [
    "headless",
    "no-sandbox",  # tests may run as root; only files of ours are opened
    "disable-gpu",
    "disable-dev-shm-usage",
    "no-first-run",
    "disable-background-networking",
    "disable-component-update",
    "disable-quic",
    "disable-sync",
]
CERTS = Path(__file__).parent.parent / "certs"


@pytest.fixture(scope="module")
def chromium(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WebDriver]:
    selenium = pytest.importorskip("selenium.webdriver", reason="selenium is not installed: pip install '.[test]'")
    options = selenium.ChromeOptions()
    options.binary_location = BROWSER
    for flag in (*FLAGS, f"user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(f"--{flag}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = selenium.Chrome(options=options, service=selenium.ChromeService(executable_path=DRIVER))
    driver.get("about:blank")  # the browser's own first page loads things
    yield driver
    driver.quit()


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("pages")
    for name in ("rolland-6-6", "3-rpr-merlet-p"):
        assert main(["report", str(CERTS / f"{name}.json"), "-o", str(folder / f"{name}.html")]) == 0
    return folder


class Tab:
    """A page in the browser, and what is read off it."""

    def __init__(self, driver: WebDriver, path: Path) -> None:
        self.driver = driver
        self.path = path
        for kind in ("browser", "performance"):
            driver.get_log(kind)
        driver.get(path.as_uri())
        # A page that was not drawn yet is deaf to keys and touch.
        driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")

    def run(self, script: str, *arguments: Any) -> Any:
        return self.driver.execute_script(script, *arguments)

    def send(self, command: str, **arguments: Any) -> Any:
        return self.driver.execute_cdp_cmd(command, arguments)

    def element(self, selector: str) -> Any:
        return self.driver.find_element("css selector", selector)

    def click(self, selector: str) -> None:
        self.element(selector).click()

    def press(self, key: str, code: int = 0) -> None:
        text = key if len(key) == 1 else "\r" if key == "Enter" else ""
        for kind in ("keyDown", "keyUp"):
            more = {"text": text} if text and kind == "keyDown" else {}
            self.send("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code or ord(key[0]), **more)

    def middle(self, selector: str) -> dict[str, float]:
        """Of an element, in the window, after it was scrolled there."""
        script = (
            "const node = document.querySelector(arguments[0]); node.scrollIntoView({block: 'center'});"
            "const box = node.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2];"
        )
        x, y = self.run(script, selector)
        return {"x": x, "y": y}

    def touch(self, kind: str, *points: dict[str, float]) -> None:
        self.send("Input.dispatchTouchEvent", type=kind, touchPoints=list(points))

    @property
    def legs(self) -> list[list[float]]:
        """Ends of the legs in the picture, and the number of the pose."""
        script = (
            "const svg = document.querySelector('#view svg');"
            "const ends = (leg) => ['x1', 'y1', 'x2', 'y2'].map((key) => Number(leg.getAttribute(key)));"
            "const legs = [...svg.querySelectorAll('.leg')].filter((leg) => !leg.closest('.ghost'));"
            "legs.sort((a, b) => a.getAttribute('class').localeCompare(b.getAttribute('class')));"
            "return [[Number(svg.dataset.pose)], ...legs.map(ends)];"
        )
        found: list[list[float]] = self.run(script)
        return found

    @property
    def announced(self) -> str:
        return str(self.run("return document.getElementById('announcement').textContent"))

    @property
    def order(self) -> list[int]:
        rows = self.run("return [...document.querySelectorAll('#pose-table tbody tr')].map((row) => row.dataset.pose)")
        return [int(number) for number in rows]

    @property
    def current(self) -> list[int]:
        script = "return [...document.querySelectorAll(arguments[0])].map((row) => row.dataset.pose)"
        chosen = self.run(script, "#pose-table tbody tr[aria-current]")
        assert chosen == self.run(script, "#pose-table tbody tr[tabindex='0']")
        return [int(number) for number in chosen]

    def colour(self, selector: str, name: str = "background-color") -> str:
        script = "return getComputedStyle(document.querySelector(arguments[0])).getPropertyValue(arguments[1])"
        return str(self.run(script, selector, name))


@pytest.fixture
def rolland(chromium: WebDriver, pages: Path) -> Iterator[Tab]:
    yield from _opened(chromium, pages / "rolland-6-6.html")


@pytest.fixture
def planar(chromium: WebDriver, pages: Path) -> Iterator[Tab]:
    yield from _opened(chromium, pages / "3-rpr-merlet-p.html")


def _opened(driver: WebDriver, path: Path) -> Iterator[Tab]:
    """The page, which must have neither complained nor asked for anything when the test is over."""
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", _screen(1400, 900))
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", _media("light"))
    driver.execute_cdp_cmd("Emulation.setFocusEmulationEnabled", {"enabled": True})
    tab = Tab(driver, path)
    yield tab
    assert driver.get_log("browser") == []
    messages = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    sent = [entry["params"] for entry in messages if entry["method"] == "Network.requestWillBeSent"]
    # A page of the browser's own, such as that of a new tab, may still be loading its parts.
    asked = {entry["request"]["url"] for entry in sent if not entry["documentURL"].startswith("chrome:")}
    assert asked == {path.as_uri()}
    assert tab.run("return performance.getEntriesByType('resource').length") == 0


def _screen(width: int, height: int, *, mobile: bool = False) -> dict[str, Any]:
    return {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile}


def _media(scheme: str, motion: str = "reduce") -> dict[str, Any]:
    return {
        "features": [
            {"name": "prefers-color-scheme", "value": scheme},
            {"name": "prefers-reduced-motion", "value": motion},
        ]
    }


def test_a_click_on_a_row_shows_its_pose(rolland: Tab) -> None:
    before = rolland.legs
    assert before[0] == [1]
    assert len(before) == 7
    rolland.click("tr[data-pose='5'] td:nth-child(4)")
    after = rolland.legs
    assert after[0] == [5]
    assert all(one != other for one, other in zip(before, after, strict=True))
    assert "Pose 5 of 16" in rolland.announced
    assert "det J is negative" in rolland.announced
    assert rolland.current == [5]
    assert rolland.element("#pose-title").text == "Pose 5 of 16"
    expected = data_of(page("rolland-6-6"))["poses"][4]
    assert rolland.element("#pose-lines dd").text == f"({', '.join(expected['position'])})"
    bounds = rolland.run(
        "return [...document.querySelectorAll('#pose-box tr')].map((r) => [...r.cells].map((c) => c.textContent))"
    )
    assert bounds == expected["bounds"]
    matrix = rolland.run("return [...document.querySelectorAll('#pose-matrix td')].map((c) => c.textContent)")
    assert matrix == [entry for row in expected["rotation"] for entry in row]


def test_the_keyboard_does_the_same(rolland: Tab) -> None:
    rolland.run("document.querySelector('#pose-table tr[tabindex=\"0\"]').focus()")
    first = rolland.legs
    rolland.press("ArrowDown", 40)
    assert (rolland.current, rolland.legs[0]) == ([2], [2])
    assert rolland.legs != first
    assert "Pose 2 of 16" in rolland.announced
    for key, code, number in (("End", 35, 16), ("ArrowDown", 40, 16), ("ArrowUp", 38, 15), ("Home", 36, 1)):
        rolland.press(key, code)
        assert (rolland.current, rolland.legs[0]) == ([number], [number])
    assert rolland.legs == first
    rolland.press("Enter", 13)
    rolland.press("ArrowDown", 40)
    rolland.press(" ", 32)
    assert rolland.run("return document.activeElement.dataset.pose") == "2"
    ticked = rolland.run(
        "return [...document.querySelectorAll('tr[aria-selected=true]')].map((row) => row.dataset.pose)"
    )
    assert ticked == ["1", "2"]
    assert rolland.element("#ticked").text == "2 ticked"


def test_everything_is_reached_by_tab_and_the_skip_link_comes_first(rolland: Tab) -> None:
    name = "const e = document.activeElement; return e.id || e.ariaLabel || e.dataset.pose || e.textContent.trim()"
    seen: list[str] = []
    while "Commands" not in seen:
        rolland.press("Tab", 9)
        seen.append(rolland.run(name))
        assert rolland.run("return document.activeElement.matches(':focus-visible')"), seen
    assert seen[0] == "Skip to the poses"
    for name in ("theme", "view", "previous", "ghosts", "Top", "digits", "CSV, decimals", "cond J", "1"):
        assert name in seen
    assert "2" not in seen
    assert len(seen) == len(set(seen))
    rolland.run("document.querySelector('.skip').focus()")
    assert rolland.run("return document.querySelector('.skip').getBoundingClientRect().top") >= 0


def test_touch_chooses_turns_and_zooms(rolland: Tab) -> None:
    rolland.send("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    point = rolland.middle("tr[data-pose='7'] td:nth-child(4)")
    rolland.touch("touchStart", point)
    rolland.touch("touchEnd")
    assert (rolland.current, rolland.legs[0]) == ([7], [7])
    place = rolland.middle("#view")
    before, scrolled = rolland.legs, rolland.run("return scrollY")
    rolland.touch("touchStart", place)
    rolland.touch("touchMove", {"x": place["x"] + 60, "y": place["y"] + 40})
    rolland.touch("touchEnd")
    turned = rolland.legs
    assert turned != before
    assert rolland.run("return scrollY") == scrolled
    fingers = [{"x": place["x"] + dx, "y": place["y"], "id": k} for k, dx in enumerate((-20, 20))]
    rolland.touch("touchStart", *fingers)
    rolland.touch("touchMove", *({**finger, "x": place["x"] + 4 * (finger["x"] - place["x"])} for finger in fingers))
    rolland.touch("touchEnd")
    assert _extent(rolland.legs) == pytest.approx(4 * _extent(turned), rel=0.01)
    rolland.send("Emulation.setTouchEmulationEnabled", enabled=False)


def _extent(legs: list[list[float]]) -> float:
    return max(abs(leg[0] - leg[2]) + abs(leg[1] - leg[3]) for leg in legs[1:])


def _wheel(tab: Tab, by: float) -> None:
    tab.send("Input.dispatchMouseEvent", type="mouseWheel", deltaX=0, deltaY=by, **tab.middle("#view"))
    tab.run("return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


def test_the_picture_is_turned_and_zoomed_by_mouse_and_keys(rolland: Tab) -> None:
    start = rolland.legs
    place = rolland.middle("#view")
    for kind, dx in (("mousePressed", 0), ("mouseMoved", 80), ("mouseReleased", 80)):
        rolland.send(
            "Input.dispatchMouseEvent",
            type=kind,
            x=place["x"] + dx,
            y=place["y"],
            button="left",
            buttons=1,
            clickCount=1,
        )
    turned = rolland.legs
    assert turned != start
    _wheel(rolland, -200)
    assert _extent(rolland.legs) == pytest.approx(_extent(turned) * 1.3499, rel=0.01)
    rolland.click("[data-preset='reset']")
    assert rolland.legs == start
    views = [start]
    for name in ("top", "front", "side"):
        rolland.click(f"[data-preset='{name}']")
        assert rolland.legs not in views
        views.append(rolland.legs)
    rolland.run("document.getElementById('view').focus()")
    for key, view in (("f", views[2]), ("t", views[1]), ("0", start)):
        rolland.press(key)
        assert rolland.legs == view
    rolland.press("ArrowLeft", 37)
    assert rolland.legs != start
    rolland.press("ArrowRight", 39)
    assert rolland.legs == start
    rolland.press("+", 187)
    assert _extent(rolland.legs) == pytest.approx(1.25 * _extent(start), rel=0.01)
    rolland.press("-", 189)
    assert _extent(rolland.legs) == pytest.approx(_extent(start), rel=0.01)
    rolland.press("PageDown", 34)
    assert rolland.legs[0] == [2]


def test_standard_views_are_true_projections(rolland: Tab) -> None:
    """From above x runs to the right and y upwards, from the front z runs upwards, both to one scale."""
    base = data_of(page("rolland-6-6"))["base"]
    for name, axis in (("top", 1), ("front", 2)):
        rolland.click(f"[data-preset='{name}']")
        feet = [leg[:2] for leg in rolland.legs[1:]]
        scale = (feet[0][0] - feet[4][0]) / (base[0][0] - base[4][0])
        assert scale > 0
        for foot, joint in zip(feet, base, strict=True):
            assert foot[0] - feet[0][0] == pytest.approx(scale * (joint[0] - base[0][0]), abs=0.02)
            assert feet[0][1] - foot[1] == pytest.approx(scale * (joint[axis] - base[0][axis]), abs=0.02)


def test_next_pose_and_ghosts(rolland: Tab) -> None:
    rolland.click("#next")
    assert rolland.current == [2]
    rolland.click("#previous")
    rolland.click("#previous")
    assert rolland.current == [16]
    ghosts = "return document.querySelectorAll('.ghost .platform').length"
    assert rolland.run(ghosts) == 0
    rolland.click("#ghosts")
    assert (rolland.run(ghosts), rolland.element("#ghosts").get_attribute("aria-pressed")) == (15, "true")
    assert rolland.legs[0] == [16]
    rolland.click("#ghosts")
    assert rolland.run(ghosts) == 0


def test_the_table_scrolls_to_the_pose_and_the_page_does_not(rolland: Tab) -> None:
    rolland.send("Emulation.setDeviceMetricsOverride", **_screen(375, 500, mobile=True))
    rolland.driver.refresh()
    rolland.middle("#previous")
    place = rolland.run("return scrollY")
    seen = (
        "const row = document.querySelector('tr[aria-current]').getBoundingClientRect();"
        "const table = document.querySelector('.tall').getBoundingClientRect();"
        "const head = document.querySelector('#pose-table thead').offsetHeight;"
        "return row.top >= table.top + head - 1 && row.bottom <= table.bottom + 1;"
    )
    for button, number in (("#previous", 16), ("#previous", 15), ("#next", 16), ("#next", 1)):
        rolland.run("document.querySelector(arguments[0]).click()", button)
        assert rolland.current == [number]
        assert rolland.run(seen)
        assert rolland.run("return scrollY") == place


def test_a_tap_on_a_row_shows_the_picture_on_a_small_screen(rolland: Tab) -> None:
    rolland.send("Emulation.setDeviceMetricsOverride", **_screen(375, 740, mobile=True))
    rolland.driver.refresh()
    seen = (
        "const box = document.querySelector('#view').getBoundingClientRect();"
        "return box.top >= 0 && box.bottom <= innerHeight;"
    )
    rolland.middle("tr[data-pose='9']")
    assert not rolland.run(seen)
    rolland.run("document.querySelector(\"tr[data-pose='9'] td:nth-child(4)\").click()")
    assert (rolland.current, rolland.legs[0]) == ([9], [9])
    assert rolland.run(seen)


@pytest.mark.parametrize("width", [1280, 1366, 1440])
def test_no_column_of_the_table_is_cut_off(rolland: Tab, width: int) -> None:
    rolland.send("Emulation.setDeviceMetricsOverride", **_screen(width, 740, mobile=False))
    rolland.driver.refresh()
    assert rolland.run("const box = document.querySelector('.tall'); return box.scrollWidth <= box.clientWidth;")


def test_the_picture_comes_before_the_proof(rolland: Tab) -> None:
    order = "return [...document.querySelectorAll('main > *')].map((node) => node.id || node.className)"
    found = rolland.run(order)
    assert found.index("claim") < found.index("poses") < found.index("reasons")


def test_a_pose_is_not_called_the_third_of_one(chromium: WebDriver, tmp_path: Path) -> None:
    """Where only one pose has a box, its number is that of the whole list."""
    certificate, page = tmp_path / "one.json", tmp_path / "one.html"
    words = ["solve", "models/3-rrr.toml", "--method", "krawczyk", "--near", "6.2,-3.8,-8", "--nearest"]
    assert main([*words, "--tolerance", "0.001", "-o", str(certificate)]) == 0
    assert main(["report", str(certificate), "-o", str(page)]) == 0
    assert Tab(chromium, page).element("#pose-title").text == "Pose 3 (listed: 1)"


def test_the_pose_that_is_meant_is_shown_first(chromium: WebDriver, tmp_path: Path) -> None:
    page = tmp_path / "near.html"
    assert main(["report", str(CERTS / "3-rpr-merlet-p.json"), "--near", "5,5,1", "-o", str(page)]) == 0
    tab = Tab(chromium, page)
    assert tab.current == [2]
    assert tab.element("tr[data-pose='2'] th").text == "2*"
    assert tab.element("tr[data-pose='1'] th").text == "1"
    assert tab.element("#view-corner").text == "Pose 2, nearest to the one that is meant"


def test_columns_are_sorted_both_ways(rolland: Tab) -> None:
    data = data_of(page("rolland-6-6"))
    column = data["columns"].index("condition")
    conditions = {pose["number"]: float(pose["cells"][column]) for pose in data["poses"]}
    header = rolland.element("#pose-table thead th:nth-child(11)")
    assert header.text.startswith("cond J")
    rolland.click("#pose-table thead th:nth-child(11) button")
    values = [conditions[number] for number in rolland.order]
    assert values == sorted(values)
    assert rolland.order != list(range(1, 17))
    assert header.get_attribute("aria-sort") == "ascending"
    assert "Sorted by cond J" in rolland.announced
    assert rolland.run("return document.querySelectorAll('[aria-sort]').length") == 1
    rolland.click("#next")
    assert rolland.current == [rolland.order[(rolland.order.index(1) + 1) % 16]]
    rolland.click("#pose-table thead th:nth-child(11) button")
    values = [conditions[number] for number in rolland.order]
    assert values == sorted(values, reverse=True)
    assert header.get_attribute("aria-sort") == "descending"
    rolland.click("#pose-table thead th:nth-child(3) button")
    positions = [float(data["poses"][number - 1]["position"][0]) for number in rolland.order]
    assert positions == sorted(positions)


def _copied(tab: Tab, kind: str) -> str:
    tab.click(f"[data-copy='{kind}']")
    return str(tab.element("#copied-text").get_property("value"))


def test_copies_are_exact(rolland: Tab) -> None:
    expected, solution = io.StringIO(), solved("rolland-6-6")
    shown = ShownPoses.of(model("rolland-6-6"), "home", solution)
    csv.writer(expected, lineterminator="\n").writerows(as_rows(solution, shown))
    assert _copied(rolland, "exact") == expected.getvalue()
    rows = list(csv.DictReader(io.StringIO(_copied(rolland, "csv"))))
    entries = json.loads(_copied(rolland, "quaternion"), parse_float=str)
    assert len(rows) == len(entries) == 16
    for row, entry, pose in zip(rows, entries, data_of(page("rolland-6-6"))["poses"], strict=True):
        assert [row["x"], row["y"], row["z"]] == entry["position"] == pose["position"]
        assert [row[f"q{k}"] for k in range(4)] == entry["quaternion"] == pose["quaternion"]
        assert row["det_sign"] in ("1", "-1")


def test_ticked_rows_are_copied_in_the_order_of_the_table(rolland: Tab) -> None:
    for number in (9, 3):
        rolland.click(f"tr[data-pose='{number}'] input")
    assert rolland.current == [1]
    assert [row.split(",")[0] for row in _copied(rolland, "csv").splitlines()] == ["pose", "3", "9"]
    rolland.click("#pose-table thead th:nth-child(3) button")
    rolland.click("#pose-table thead th:nth-child(3) button")
    assert [row.split(",")[0] for row in _copied(rolland, "exact").splitlines()] == ["pose", "9", "3"]
    rolland.click("#pose-table thead input")
    assert len(_copied(rolland, "csv").splitlines()) == 17
    rolland.click("#pose-table thead input")
    assert rolland.element("#ticked").text == "none ticked: all 16"


def test_with_a_clipboard_the_text_is_in_it(rolland: Tab) -> None:
    rolland.send("Browser.grantPermissions", permissions=["clipboardReadWrite", "clipboardSanitizedWrite"])
    rolland.send("Page.bringToFront")
    text = _copied(rolland, "quaternion")
    assert rolland.run("return navigator.clipboard.readText()") == text
    assert rolland.element("#copied-label").text == "Copied to the clipboard: 16 poses"
    assert "Copied 16 poses" in rolland.announced
    rolland.send("Browser.resetPermissions")


def test_without_a_clipboard_the_text_is_selected(rolland: Tab) -> None:
    rolland.run("Object.defineProperty(navigator, 'clipboard', {value: undefined})")
    text = _copied(rolland, "csv")
    assert rolland.run("return document.activeElement.id") == "copied-text"
    assert rolland.run("return getSelection().toString()") == text
    assert "clipboard is not available" in rolland.announced


def test_all_digits(rolland: Tab) -> None:
    cell = "tr[data-pose='1'] td:nth-child(3)"
    short = rolland.element(cell).text
    rolland.click("#digits")
    full = rolland.element(cell).text
    assert full == data_of(page("rolland-6-6"))["poses"][0]["position"][0]
    assert len(full) > len(short)
    rolland.click("#digits")
    assert rolland.element(cell).text == short


def test_light_and_dark(rolland: Tab) -> None:
    def colours() -> list[str]:
        return [rolland.colour("body"), rolland.colour("h1", "color"), rolland.colour("#view .leg-1", "stroke")]

    light = colours()
    rolland.click("#theme")
    dark = colours()
    assert all(one != other for one, other in zip(light, dark, strict=True))
    rolland.click("#theme")
    assert colours() == light
    rolland.send("Emulation.setEmulatedMedia", **_media("dark"))
    rolland.driver.refresh()
    assert colours() == dark
    assert rolland.element("#theme").get_attribute("aria-pressed") == "true"
    rolland.click("#theme")
    assert colours() == light


def test_reduced_motion_is_obeyed(rolland: Tab) -> None:
    script = (
        "const now = () => document.querySelector('#view .leg-1').getAttribute('x1');"
        "document.querySelector('[data-preset=top]').click(); const first = now();"
        "return new Promise((done) => setTimeout(() => done(first === now()), 600));"
    )
    assert rolland.run(script)
    rolland.click("[data-preset='reset']")
    rolland.send("Emulation.setEmulatedMedia", **_media("light", "no-preference"))
    assert not rolland.run(script)


@pytest.mark.parametrize(("name", "width"), [("rolland", 320), ("rolland", 375), ("rolland", 1280), ("planar", 375)])
def test_no_screen_is_too_narrow(request: pytest.FixtureRequest, name: str, width: int) -> None:
    tab = request.getfixturevalue(name)
    tab.send("Emulation.setDeviceMetricsOverride", **_screen(width, 740, mobile=width < 700))
    tab.driver.refresh()
    tab.run("document.querySelectorAll('details').forEach((node) => { node.open = true; })")
    tab.click("#digits")
    assert tab.run("return document.documentElement.scrollWidth") <= width
    outside = (
        "const within = '.scroll, pre, .skip, .unseen, svg';"
        "return [...document.querySelectorAll('body *')].filter((node) => !node.closest(within)"
        " && node.getBoundingClientRect().right > innerWidth + 1).map((node) => node.outerHTML.slice(0, 80))"
    )
    assert tab.run(outside) == []
    if width < 700:
        small = (
            "return [...document.querySelectorAll('main button, header button')].filter((b) => !b.closest('thead'))"
            ".filter((b) => b.getBoundingClientRect().height < 44).length"
        )
        assert tab.run(small) == 0


def test_a_planar_robot_is_moved_not_turned(planar: Tab) -> None:
    before = planar.legs
    assert len(before) == 4
    planar.click("tr[data-pose='2'] td:nth-child(3)")
    assert planar.legs[0] == [2]
    assert "Pose 2 of 2" in planar.announced
    planar.click("#previous")
    assert planar.legs == before
    planar.run("document.getElementById('view').focus()")
    planar.press("ArrowRight", 39)
    moved = planar.legs
    shifts = {
        tuple(round(b - a, 2) for a, b in zip(*pair, strict=True)) for pair in zip(before[1:], moved[1:], strict=True)
    }
    assert shifts == {(30, 0, 30, 0)}
    assert planar.run("return document.querySelectorAll('[data-preset]').length") == 1


@pytest.mark.parametrize(("scale", "offset"), [(10**90, 0), (Fraction(1, 10**90), 0), (1, 10**25)])
def test_robots_of_any_size_and_place(chromium: WebDriver, tmp_path: Path, scale: Fraction, offset: int) -> None:
    model = read_robot(CERTS.parent / "models" / "3-rpr-merlet-p.toml")
    base = [[x * scale + offset for x in joint[:2]] for joint in model.base_joints]
    platform = [[x * scale for x in joint[:2]] for joint in model.platform_joints]
    robot = Robot("any", "3-RPR", "m", "made up", base, platform)  # type: ignore[arg-type]
    squares = [square * scale * scale for square in model.configuration().lengths_squared]
    path = tmp_path / "any.html"
    path.write_text(
        written(certificate(robot, None, solve(robot.problem(squares), width=Fraction(scale, 10**9)))), encoding="utf-8"
    )
    for tab in _opened(chromium, path):
        tab.click("#ghosts")
        tab.click("#next")
        assert tab.legs[0] == [2]
        assert tab.run("return document.querySelectorAll('.grid-line').length") < 90
        assert all(abs(end) < 3000 for leg in tab.legs[1:] for end in leg)


def test_it_prints_without_buttons(rolland: Tab) -> None:
    rolland.send("Emulation.setEmulatedMedia", media="print")
    shown = (
        "return [...document.querySelectorAll('button')].filter((b) => !b.closest('thead') && b.offsetParent).length"
    )
    assert rolland.run(shown) == 0
    assert rolland.run("return document.querySelector('#view svg').getBoundingClientRect().height") > 100
    rolland.send("Emulation.setEmulatedMedia", media="")


def test_hostile_texts_run_nothing(chromium: WebDriver, tmp_path: Path) -> None:
    content = golden("3-rpr-merlet-p")
    content["robot"] = {**content["robot"], "name": HOSTILE, "unit": HOSTILE, "source": HOSTILE}
    content["notes"] = [HOSTILE]
    path = tmp_path / "hostile.html"
    path.write_text(written(content), encoding="utf-8")
    for tab in _opened(chromium, path):
        tab.click("#next")
        _copied(tab, "exact")
        assert tab.run("return typeof hacked") == "undefined"
        assert tab.run("return document.querySelectorAll('script').length") == 2
        assert tab.element("h1").text.startswith("</script><script>hacked=1</script><img src=x onerror=hacked=1>")


def test_the_policy_stops_what_is_not_the_page(chromium: WebDriver, pages: Path, tmp_path: Path) -> None:
    """A script, a style and an image put into the page afterwards are refused by the browser."""
    text = (pages / "3-rpr-merlet-p.html").read_text(encoding="utf-8")
    path = tmp_path / "changed.html"
    more = "<script>hacked=1</script><img src='other.png'><style>h1 { color: rgb(1, 2, 3) }</style>"
    path.write_text(text.replace("</main>", more + "</main>"), encoding="utf-8")
    tab = Tab(chromium, path)
    assert tab.run("return typeof hacked") == "undefined"
    assert tab.colour("h1", "color") != "rgb(1, 2, 3)"
    complaints = [entry["message"] for entry in chromium.get_log("browser")]
    assert len([line for line in complaints if "Content Security Policy" in line]) == 3

"""The web page of a certificate, read without a browser: structure, numbers, and what cannot break out of it."""

import json
import re
import sys
import tomllib
from base64 import b64encode
from collections import Counter
from fractions import Fraction
from functools import cache
from hashlib import sha256
from html.parser import HTMLParser
from importlib.resources import files
from itertools import product
from pathlib import Path
from subprocess import run
from typing import Any

import pytest
from certificate_subjects import OF_POSES, subject
from certificate_tools import golden, golden_bytes
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import Status, check_bytes
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.geometry.reader import read_robot
from pkm_exact.report_page.markup import element, embedded_json
from pkm_exact.report_page.numerals import bound, distance, exact, root_of, shortened, times_root
from pkm_exact.report_page.page import report_page
from pkm_exact.roots.interval import Interval, decimal

ROOT = Path(__file__).parent.parent
ROLLAND = str(ROOT / "certs" / "rolland-6-6.json")
HOSTILE = (
    "</script><script>hacked=1</script><img src=x onerror=hacked=1> \u2028\u2029\x00\u202e$name ${x} \"'&amp; ]]>-->"
)
Capture = pytest.CaptureFixture[str]


class Page(HTMLParser):
    """Elements, texts and the contents of scripts of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.cells: list[list[str]] = []
        self.raw: dict[str, list[str]] = {"script": [], "style": []}
        self.text = ""
        self.tables: dict[str, int] = Counter()
        self._table = ""
        self.feed(text)
        self.close()
        assert not self.open, "elements that are not closed"

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = dict(attrs)
        assert len(values) == len(attrs), "an attribute twice"
        self.elements.append((tag, values))
        if tag not in ("meta", "link", "input", "br"):
            self.open.append(tag)
        if tag in self.raw:
            self.raw[tag].append("")
        if tag == "table":
            self._table = values.get("id") or values.get("class") or ""
        if tag == "tr":
            self.cells.append([])
            self.tables[self._table] += 1
        if tag in ("td", "th"):
            self.cells[-1].append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag, f"{tag} closed in the wrong place"

    def handle_data(self, data: str) -> None:
        place = self.open[-1] if self.open else ""
        if place in self.raw:
            self.raw[place][-1] += data
        elif self.cells and any(tag in ("td", "th") for tag in self.open):
            self.cells[-1][-1] += data
        else:
            self.text += data

    def attribute(self, name: str) -> list[str]:
        return [value or "" for _, values in self.elements for key, value in values.items() if key == name]


def written(content: dict[str, Any], file: str = "cert.json") -> str:
    """The page of a certificate that the checker accepts."""
    content = sealed(content)
    verdict = check_bytes(canonical_bytes(content))
    assert verdict.status is Status.ACCEPTED
    return report_page(content, verdict.lines, file)


@cache
def page(name: str) -> Page:
    return Page(written(golden(name)))


def data_of(page: Page) -> dict[str, Any]:
    places = [values for tag, values in page.elements if tag == "script"]
    assert [values.get("type") for values in places] == ["application/json", None]
    return json.loads(page.raw["script"][0])


def require_sound(page: Page) -> None:
    """What holds for every page: identities, references, nothing loaded, nothing run but the one script."""
    ids = page.attribute("id")
    assert len(ids) == len(set(ids))
    references = [word for key in ("aria-labelledby", "aria-describedby", "for") for word in page.attribute(key)]
    assert set(references) <= set(ids)
    targets = page.attribute("href")
    assert all(target == "data:," or target[1:] in ids for target in targets)
    assert "#" in targets[1][:1]
    names = {name for _, values in page.elements for name in values}
    assert not names & {"src", "srcset", "action", "style", "background", "poster", "data", "ping"}
    assert not [name for name in names if name.startswith("on")]
    (style,), script = page.raw["style"], page.raw["script"][1]
    assert not re.search(r"url\(|@import|//", style)
    assert not re.search(r"fetch\(|XMLHttp|WebSocket|sendBeacon|import\(|\beval\b|innerHTML|\bFunction\(", script)
    (policy,) = [v["content"] or "" for _, v in page.elements if v.get("http-equiv") == "Content-Security-Policy"]
    assert policy.startswith("default-src 'none';")
    for kind, text in (("script", script), ("style", style)):
        digest = b64encode(sha256(text.encode()).digest()).decode()
        assert f"{kind}-src 'sha256-{digest}'" in policy
    assert "unsafe" not in policy


@pytest.mark.parametrize(
    "name", ["rolland-6-6", "3-rpr-merlet-p", pytest.param("ssm-exact", marks=pytest.mark.slow), "dietmaier"]
)
def test_the_page_of_a_golden_certificate(name: str) -> None:
    content, shown = golden(name), page(name)
    require_sound(shown)
    assert shown.tables["pose-table"] == 1 + len(content["poses"])
    assert shown.attribute("data-pose") == [str(k) for k in range(1, len(content["poses"]) + 1)]
    assert f"{len(content['poses'])} real poses, and it is proved that there is no other." in shown.text
    for text in (content["robot"]["name"], content["robot"]["source"], content["digest"].removeprefix("sha256:")):
        assert text in shown.text
    assert sha256(golden_bytes(name)).hexdigest() in shown.text
    for line in check_bytes(golden_bytes(name)).lines:
        assert line in shown.text


@pytest.mark.parametrize("name", ["rolland-6-6", "3-rpr-merlet-p"])
def test_the_data_are_those_of_the_certificate(name: str) -> None:
    content, data = golden(name), data_of(page(name))
    metric = [int(g) for g in content["robot"]["metric"]]
    assert metric == [1, 1, 1]
    for shown, joint in zip(data["base"], content["robot"]["base"], strict=True):
        assert shown == pytest.approx([float(Fraction(x)) for x in joint])
    squares = [float(Fraction(square)) for square in content["configuration"]["lengths_squared"]]
    for entry, pose in zip(content["poses"], data["poses"], strict=True):
        rows = [*entry["position"], *(cell for row in entry["rotation"] for cell in row), *entry["quaternion"]]
        assert [[low, high] for _, low, high in pose["bounds"]] == rows
        assert [name for name, _, _ in pose["bounds"]][:5] == ["x", "y", "z", "r11", "r12"]
        numbers = [*pose["position"], *(x for row in pose["rotation"] for x in row), *pose["quaternion"]]
        for text, (low, high) in zip(numbers, rows, strict=True):
            unit = Fraction(1, 10 ** len(text.partition(".")[2]))
            assert max(Fraction(high) - Fraction(text), Fraction(text) - Fraction(low)) <= unit
        cells = dict(zip(data["columns"], pose["cells"], strict=True))
        for text, (low, high) in zip(numbers[:2] + numbers[-4:], rows[:2] + rows[-4:], strict=True):
            assert text in (cells["x"], cells["y"], *(cells[f"q{k}"] for k in range(4)))
            assert max(Fraction(high) - Fraction(text), Fraction(text) - Fraction(low)) <= Fraction(cells["error"])
        legs = zip(data["base"], pose["platform"], strict=True)
        assert [sum((a - b) ** 2 for a, b in zip(*leg, strict=True)) for leg in legs] == pytest.approx(squares)


def test_joints_and_lengths_are_exact() -> None:
    content, shown = golden("rolland-6-6"), page("rolland-6-6")
    rows = [row for row in shown.cells if len(row) == 9 and row[0].isdigit()]
    sides = zip(content["robot"]["base"], content["robot"]["platform"], strict=True)
    assert [[Fraction(cell) for cell in row[1:7]] for row in rows] == [
        [Fraction(x) for x in (*base, *platform)] for base, platform in sides
    ]
    assert {(row[7], row[8]) for row in rows} == {("1250", "1562500")}


def test_short_numbers_of_the_table_are_right_to_one_unit() -> None:
    content, shown = golden("rolland-6-6"), page("rolland-6-6")
    rows = [row for row in shown.cells if len(row) == 13 and row[1].isdigit()]
    assert len(rows) == 16
    for entry, row in zip(content["poses"], rows, strict=True):
        for text, (low, high) in zip(row[2:9], [*entry["position"], *entry["quaternion"]], strict=True):
            digits = len(text.partition(".")[2])
            assert 3 <= digits <= 5
            assert abs(Fraction(text) - Fraction(low)) < Fraction(1, 10**digits) > abs(Fraction(text) - Fraction(high))
        width = max(Fraction(high) - Fraction(low) for low, high in entry["position"])
        assert width / 2 <= Fraction(row[12]) <= width * Fraction(6, 10)


@pytest.mark.parametrize("kind", OF_POSES)
def test_every_kind_of_certificate_has_a_page(kind: str) -> None:
    content = subject(kind)
    shown = Page(written(content))
    require_sound(shown)
    listed = content.get("boxes", content.get("poses"))
    assert listed is not None
    assert shown.tables.get("pose-table", 0) == (1 + len(listed) if listed else 0)
    assert len(data_of(shown)["poses"]) == len(listed)
    settled = content.get(
        "complete", content.get("claim") in ("complete", "inconsistent", "positive-dimensional-proved")
    )
    assert ("sheet claim proved" in shown.attribute("class")) is settled
    closed = content.get("complete", content.get("claim") == "complete")
    assert bool(re.search(r"there is no other\.|none elsewhere\.|cannot be assembled", shown.text)) is closed
    assert all(note in shown.text for note in content.get("notes", []))
    assert ("--pure" in shown.text) is ("boxes" not in content)


def test_texts_of_a_file_stay_texts() -> None:
    content = golden("3-rpr-merlet-p")
    hostile = {**content, "notes": [HOSTILE, HOSTILE]}
    hostile["robot"] = {**content["robot"], "name": HOSTILE, "unit": HOSTILE, "source": HOSTILE}
    hostile["configuration"] = {**content["configuration"], "name": HOSTILE}
    text = written(hostile, HOSTILE.replace("/", "-"))
    shown = Page(text)
    require_sound(shown)
    tame = {**content, "notes": ["a", "b"]}
    assert Counter(tag for tag, _ in shown.elements) == Counter(tag for tag, _ in Page(written(tame)).elements)
    assert text.count("<script") == 2
    assert "\u2028" not in text
    assert "\x00" not in text
    assert (
        "</script><script>hacked=1</script><img src=x onerror=hacked=1> \\u2028\\u2029\\x00\\u202e$name ${x} \"'&amp;"
        in shown.text
    )
    assert HOSTILE in data_of(shown)["unit"]


@pytest.mark.parametrize("name", ["-o.json", "a b'c.json", "$(id).json"])
def test_commands_quote_the_name_of_the_file(name: str) -> None:
    shown = Page(written(golden("3-rpr-merlet-p"), name))
    (command,) = re.findall(r"certify-poses check (?!--pure)(.*?)certify-poses", shown.text)
    output = run(["/bin/sh", "-c", f"printf %s {command}"], capture_output=True, text=True, check=True).stdout
    assert output in (name, f"./{name}")
    assert not output.startswith("-")


@given(st.text())
def test_any_text_is_escaped(text: str) -> None:
    shown = Page(element("p", text, title=text))
    assert [tag for tag, _ in shown.elements] == ["p"]
    assert json.loads(embedded_json({"text": text}))["text"] == text
    assert not set("<>&\u2028\u2029") & set(embedded_json(text))


def test_chains_are_drawn_with_the_model() -> None:
    content = golden("hexa")
    lines = check_bytes(golden_bytes("hexa")).lines
    text = report_page(content, lines, "hexa.json", read_robot(ROOT / "models" / "hexa.toml"))
    shown, data = Page(text), data_of(Page(text))
    require_sound(shown)
    assert "knee" in " ".join(cell for row in shown.cells for cell in row)
    assert "joint values" in shown.text
    knees = [[float(Fraction(x)) for x in joint] for joint in content["robot"]["base"]]
    metric = [int(g) for g in content["robot"]["metric"]]
    for pose in data["poses"]:
        assert len(pose["knees"]) == 6
        for shown_knee, knee in zip(pose["knees"], knees, strict=True):
            assert shown_knee == pytest.approx([x * g**0.5 for x, g in zip(knee, metric, strict=True)])
    assert all(not pose["knees"] for pose in data_of(page("hexa"))["poses"])


def test_numbers_beyond_drawing_are_refused() -> None:
    content = sealed(subject("tolerance, planar, complete"))
    far = [[str(10**500), "0", "0"], *content["robot"]["base"][1:]]
    with pytest.raises(InputError, match="too large"):
        report_page({**content, "robot": {**content["robot"], "base": far}}, (), "far.json")


# The command


def test_the_command_writes_the_same_bytes_always(tmp_path: Path, capsys: Capture) -> None:
    target = tmp_path / "page.html"
    assert main(["report", ROLLAND, "-o", str(target)]) == 0
    assert capsys.readouterr().out == f"{target}: 16 real poses, and it is proved that there is no other.\n"
    assert target.read_text(encoding="utf-8") == written(golden("rolland-6-6"), "rolland-6-6.json")
    again = tmp_path / "again.html"
    words = ["-m", "pkm_exact.cli.main", "report", ROLLAND, "-o", str(again)]
    run([sys.executable, *words], check=True, cwd=ROOT, env={"PYTHONHASHSEED": "7"}, capture_output=True)
    assert again.read_bytes() == target.read_bytes()


def test_a_rejected_certificate_has_no_page(tmp_path: Path, capsys: Capture) -> None:
    content = golden("3-rpr-merlet-p")
    source, target = tmp_path / "bad.json", tmp_path / "page.html"
    target.write_text("as before")
    source.write_bytes(canonical_bytes({**content, "real_poses": 3}))
    assert main(["report", str(source), "-o", str(target)]) == 1
    assert "the certificate is rejected (digest" in capsys.readouterr().err
    source.write_bytes(canonical_bytes(sealed({**content, "robot": {**content["robot"], "name": "x"}})))
    assert main(["report", str(source), "-o", str(target)]) == 0
    assert target.read_text() != "as before"


@pytest.mark.parametrize(
    ("source", "target", "more", "sentence"),
    [
        ("no.json", "page.html", [], "cannot be read"),
        ("text.json", "page.html", [], "is malformed"),
        ("good.json", "good.json", [], "is the certificate itself; give -o another path"),
        ("good.json", "nowhere/page.html", [], "does not exist; create it or give -o another path"),
        ("good.json", ".", [], "is a directory"),
        ("good.json", "page.html", ["--model", str(ROOT / "models" / "6-6p.toml")], "is not one of the model"),
        ("good.json", "page.html", ["--model", "no.toml"], "no.toml"),
        ("good.json", "model.toml", ["--model", "model.toml"], "is the model file itself"),
        ("tolerance.json", "page.html", ["--model", str(ROOT / "models" / "3-rrr.toml")], "leave it out"),
    ],
)
def test_what_cannot_be_done_is_one_sentence(
    tmp_path: Path,
    capsys: Capture,
    monkeypatch: pytest.MonkeyPatch,
    source: str,
    target: str,
    more: list[str],
    sentence: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("text.json").write_text("{}\n")
    Path("good.json").write_bytes(golden_bytes("3-rpr-merlet-p"))
    Path("model.toml").write_text("schema = 1\n")
    Path("tolerance.json").write_bytes(canonical_bytes(sealed(subject("tolerance, planar, complete"))))
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert main(["report", source, "-o", target, *more]) == 2
    error = capsys.readouterr().err
    assert sentence in error
    assert error.count("\n") == 1
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


# Numbers

numbers = st.fractions(max_denominator=10**6)


@given(numbers, st.integers(1, 50))
def test_exact_numbers_are_exact(value: Fraction, square: int) -> None:
    assert Fraction(exact(value)) == value
    text = times_root(value, square)
    factor, _, root = text.partition(" √")
    assert Fraction(factor) ** 2 * int(root or 1) == value**2 * square
    if value > 0:
        shown = root_of(value)
        about = Fraction(shown.rpartition("≈ ")[2])
        assert about**2 == value if "≈" not in shown else abs(about**2 / value - 1) < Fraction(1, 10**6)


@given(numbers, st.fractions(0, Fraction(1, 10), max_denominator=10**12), st.integers(0, 12))
def test_decimals_are_as_far_off_as_is_said(low: Fraction, width: Fraction, digits: int) -> None:
    interval = Interval(low, low + width)
    short, full = shortened(interval, digits), decimal(interval)
    assert len(short.partition(".")[2]) == min(digits, len(full.partition(".")[2]))
    for text in (short, full):
        unit = Fraction(1, 10 ** len(text.partition(".")[2]))
        off = distance([text], [interval])
        assert max(abs(end - Fraction(text)) for end in (interval.lo, interval.hi)) == off <= unit


@given(st.fractions(0, max_denominator=10**30))
def test_bounds_are_rounded_up(value: Fraction) -> None:
    assert value <= Fraction(bound(value)) <= value * Fraction(11, 10)


# What it looks like


def _luminance(colour: str) -> float:
    parts = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def _contrast(one: str, other: str) -> float:
    dark, light = sorted((_luminance(one), _luminance(other)))
    return (light + 0.05) / (dark + 0.05)


TEXTS = [
    *product(("ink", "soft"), ("page", "sheet", "raised", "chosen")),
    ("accent", "sheet"),
    ("on-accent", "accent"),
    ("proved", "proved-back"),
    ("weaker", "weaker-back"),
    ("axis-x", "page"),
    ("axis-y", "page"),
    ("axis-z", "page"),
]
GRAPHICS = [
    *product([f"leg-{k}" for k in range(1, 7)], ("page", "sheet")),
    *product(("edge",), ("page", "sheet")),
    ("body-platform", "page"),
    ("accent", "chosen"),
    ("proved", "sheet"),
]


@pytest.mark.parametrize("theme", [0, 1])
def test_colours_have_enough_contrast(theme: int) -> None:
    """WCAG 2.2, 1.4.3 and 1.4.11: 4.5 for text, 3 for what has to be told apart."""
    style = (files("pkm_exact.report_page") / "style.css").read_text()
    found = re.findall(r"--([\w-]+): light-dark\((#[0-9a-fA-F]{6}), (#[0-9a-fA-F]{6})\)", style)
    colours = {name: pair[theme] for name, *pair in found}
    assert len(colours) > 20
    for least, pairs in ((4.5, TEXTS), (3.0, GRAPHICS)):
        poor = {pair: _contrast(*(colours[name] for name in pair)) for pair in pairs}
        assert not {pair: value for pair, value in poor.items() if value < least}


def test_the_parts_of_the_page_are_in_the_package() -> None:
    patterns = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["package-data"]["pkm_exact"]
    folder = ROOT / "pkm_exact"
    shipped = {path for pattern in patterns for path in folder.glob(pattern)}
    parts = {path for path in (folder / "report_page").iterdir() if path.is_file() and path.suffix != ".py"}
    assert parts
    assert parts <= shipped

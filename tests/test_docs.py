"""The documentation says what is so: every sample runs, every link leads somewhere, every command and option exists."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import click
import doc_samples
import pytest
from doc_samples import LANGUAGES, ROOT, Block, SampleError, Session, blocks, commands
from test_report_browser import BROWSER, DRIVER, FLAGS

import pkm_exact
from pkm_exact.cli.commands import COMMANDS, command
from pkm_exact.cli.roots_commands import certify_roots

PAGES = sorted([*(ROOT / "docs").rglob("*.md"), *ROOT.glob("*.md")])
TEXTS = {page: page.read_text(encoding="utf-8") for page in PAGES}


def _name(page: Path) -> str:
    return str(page.relative_to(ROOT))


def _has_samples(page: Path) -> bool:
    return any(block.language in LANGUAGES - {"text"} for block in blocks(TEXTS[page]))


SLOW = ("docs/cli.md", "docs/pictures.md", "docs/quickstart.md", "docs/tutorial.md")
"""Pages with many samples, all of them of commands that other pages run too."""

LARGEST = "docs/formulations.md"


def _is_slow(page: Path) -> bool:
    return any(block.is_slow for block in blocks(TEXTS[page]))


def _with_samples() -> Iterator[Any]:
    for page in filter(_has_samples, PAGES):
        name = _name(page)
        yield pytest.param(page, id=name, marks=pytest.mark.slow if name in SLOW else ())


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Callable[..., None]:
    """Run a page's samples in a folder with copies of what a reader of the repository has."""
    for part in ("models", "certs"):
        shutil.copytree(ROOT / part, tmp_path / part)
    monkeypatch.chdir(tmp_path)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    for name, value in {"PATH": path, "MPLBACKEND": "Agg", "COLUMNS": "200", "HOME": str(tmp_path)}.items():
        monkeypatch.setenv(name, value)

    def run(page: Path, *flags: str) -> None:
        code = doc_samples.main([*flags, str(page)])
        assert code == 0, capfd.readouterr().err

    return run


@pytest.mark.parametrize("page", [*_with_samples()])
def test_the_samples_of_a_page_run(page: Path, run: Callable[..., None]) -> None:
    run(page)


def _with_slow_samples() -> Iterator[Any]:
    for page in filter(_is_slow, PAGES):
        name = _name(page)
        yield pytest.param(page, id=name, marks=pytest.mark.largest if name == LARGEST else ())


@pytest.mark.slow
@pytest.mark.parametrize("page", [*_with_slow_samples()])
def test_the_slow_samples_of_a_page_run(page: Path, run: Callable[..., None]) -> None:
    run(page, "--slow")


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_every_block_says_what_it_is(page: Path) -> None:
    unknown = [f"line {block.line}: {block.language!r}" for block in blocks(TEXTS[page])]
    assert [line for line in unknown if line.split("'")[1] not in LANGUAGES] == []


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_no_command_hides_in_an_indented_block(page: Path) -> None:
    outside = re.sub(r"^( *)```.*?^\1```$", "", TEXTS[page], flags=re.DOTALL | re.MULTILINE)
    assert re.findall(r"^(?: {4}|\t)(?:certify-poses|make|pip|python) .*$", outside, re.MULTILINE) == []


# Links. The site's builder follows those between its own pages; these are for readers of the repository.


def _links(page: Path) -> Iterator[str]:
    outside = re.sub(r"^( *)```.*?^\1```$", "", TEXTS[page], flags=re.DOTALL | re.MULTILINE)
    outside = re.sub(r"`[^`\n]*`", "code", outside)
    yield from re.findall(r"\]\(([^)\s]+)\)", outside)
    yield from re.findall(r"\bsrc(?:set)?=\"([^\"\s]+)\"", outside)


def _anchors(page: Path) -> set[str]:
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    named = {match[1] for heading in headings if (match := re.search(r"\{ ?#([\w-]+)", heading))}
    return named | {re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", heading).strip().lower()) for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_links_inside_the_repository_lead_somewhere(page: Path) -> None:
    for link in _links(page):
        target, _, anchor = link.partition("#")
        if re.match(r"[a-z]+:", target):
            continue
        file = page.parent / target if target else page
        assert file.exists(), link
        assert not anchor or anchor in _anchors(file), link


# Commands and options.


def _command_lines() -> Iterator[list[str]]:
    """The words of every command that some sample executes."""
    for text in TEXTS.values():
        for block in blocks(text):
            if block.language == "sh":
                yield from (command.split() for _, command, _ in commands(block))


def _options(command: click.Command) -> list[list[str]]:
    """The options, each with all its spellings."""
    return [[*option.opts, *option.secondary_opts] for option in command.params if isinstance(option, click.Option)]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_is_in_a_sample_and_every_option_in_the_text(name: str) -> None:
    assert ["certify-poses", name] in [words[:2] for words in _command_lines()]
    about = "\n".join(text for text in TEXTS.values() if f"certify-poses {name}" in text)
    said = set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", about))
    assert [names for names in _options(command(name)) if said.isdisjoint(names)] == []


@pytest.mark.parametrize("name", certify_roots.commands)
def test_every_option_for_systems_is_in_the_reference(name: str) -> None:
    page = (ROOT / "docs" / "cli.md").read_text(encoding="utf-8")
    section = page.partition("\n## `certify-roots`\n")[2].partition("\n## ")[0]
    lines = [line for block in blocks(section) if block.language == "sh" for _, line, _ in commands(block)]
    assert any(line.startswith("certify-roots check") == (name == "check") for line in lines)
    for spellings in _options(certify_roots.commands[name]):
        assert all(re.search(rf"`{spelling}[`, ]", section) for spelling in spellings)


def test_every_option_in_the_text_exists() -> None:
    every = [*map(command, COMMANDS), *certify_roots.commands.values()]
    known = {"--help", "--version"} | {name for command in every for names in _options(command) for name in names}
    for page, text in TEXTS.items():
        synopses = "".join(block.text for block in blocks(text) if block.language == "text")
        spans = re.findall(r"`(certify-poses [^`]*|--[^`]*)`", text) + re.findall(r"certify-poses .*", synopses)
        for span in spans:
            assert set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", span)) <= known, f"{_name(page)}: {span}"


def test_every_public_name_is_in_the_reference() -> None:
    text = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"^::: pkm_exact\.([\w.]+)", text, re.MULTILINE))
    assert set(pkm_exact.__all__) - {"__version__"} <= documented


def test_every_shipped_robot_is_in_the_readme() -> None:
    readme = TEXTS[ROOT / "README.md"]
    assert [path.name for path in (ROOT / "models").glob("*.toml") if f"`{path.name}`" not in readme] == []


# The site.


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built site; whatever its builder has doubts about is an error."""
    if find_spec("mkdocs") is None or find_spec("mkdocstrings") is None:
        pytest.skip("mkdocs is not installed")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr
    return folder


def test_the_site_has_every_page(site: Path) -> None:
    pages = {page.stem for page in (ROOT / "docs").glob("*.md")} | {"contributing", "changelog"}
    assert pages - {page.stem for page in site.glob("*.html")} == set()


def test_the_site_asks_no_other_host(site: Path) -> None:
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        loaded = re.findall(r"<(?:script|img|iframe)[^>]*\bsrc=\"?([^\"\s>]+)", text)
        loaded += re.findall(r"<link[^>]*rel=\"?(?:stylesheet|preload|preconnect)[^>]*href=\"?([^\"\s>]+)", text)
        assert [link for link in loaded if re.match(r"(?:https?:)?//", link)] == []


@pytest.mark.skipif(not (BROWSER and DRIVER), reason="no chromium with chromedriver is installed")
def test_the_site_is_searched_from_disk(site: Path, tmp_path: Path) -> None:
    """A page opened as a file finds words of other pages: no server, no worker."""
    selenium = pytest.importorskip("selenium.webdriver", reason="selenium is not installed: pip install '.[test]'")
    waiting = pytest.importorskip("selenium.webdriver.support.wait")
    options = selenium.ChromeOptions()
    options.binary_location = BROWSER
    for flag in (*FLAGS, f"user-data-dir={tmp_path}"):
        options.add_argument(f"--{flag}")
    driver = selenium.Chrome(options=options, service=selenium.ChromeService(executable_path=DRIVER))
    try:
        driver.get((site / "tolerances.html").as_uri())
        driver.execute_script("document.getElementById('__search').click()")
        driver.find_element("css selector", "input.md-search__input").send_keys("hexapod")
        links = waiting.WebDriverWait(driver, 60).until(
            lambda shown: shown.find_elements("css selector", ".md-search-result__item a")
        )
        found = [link.get_attribute("href") for link in links]
    finally:
        driver.quit()
    assert any(link.startswith((site / "hexapod.html").as_uri()) for link in found)


# The runner itself: a sample that is wrong is found.


@pytest.mark.parametrize(
    ("language", "text", "remark"),
    [
        ("sh", "certify-poses solve missing.toml", ""),
        ("sh", "certify-poses --version  # exit code 3", ""),
        ("sh", "false", ""),
        ("sh", "make no-such-target", ""),
        ("sh", "pip install '.[no-such-extra]'", ""),
        ("python", "raise ValueError", ""),
        ("python", "print(1)  # -> 2", ""),
        ("toml", "schema = 1\nname = 'no robot'", ""),
        ("toml", "joints = [...]", ""),
        ("yaml", "a: [", ""),
        ("json", "{", ""),
        ("text", "never printed", "<!-- output -->"),
    ],
)
def test_a_wrong_sample_is_found(
    language: str, text: str, remark: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture
) -> None:
    if language == "yaml":
        pytest.importorskip("yaml")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SampleError, match=r"line \d"):
        Session().run(Block(1, language, text + "\n", remark))


def test_blocks_are_found_with_their_marks() -> None:
    page = "text\n<!-- slow -->\n```sh\na \\\n  b  # exit code 3\n# only a remark\n```\n\n   ```python\n   x\n   ```\n"
    first, second = blocks(page)
    assert first.is_slow
    assert list(commands(first)) == [(4, "a b", 3)]
    assert (second.language, second.text, second.is_slow) == ("python", "x\n", False)


def test_a_block_without_an_end_is_found() -> None:
    with pytest.raises(SampleError, match="line 2"):
        blocks("a\n```sh\nb\n")


@pytest.mark.parametrize("page", ["docs/certificates.md", "docs/guarantees.md"])
def test_every_file_of_the_plain_checker_is_named(page: str) -> None:
    files = sorted(path.name for path in (ROOT / "pkm_exact" / "certify").glob("pure*.py"))
    assert [name for name in files if name not in TEXTS[ROOT / page]] == []

"""What is released: wheel and sources have what they need and nothing else, and work where the repository is not."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from datetime import date
from fnmatch import fnmatch
from pathlib import Path

import pytest

import pkm_exact

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
NEITHER = (".git", ".venv", "build", "dist", "*.egg-info", "__pycache__", ".*_cache", ".hypothesis", ".benchmarks")
SHIPPED = ("models", "certs", "docs", "tests", "notebooks", "benchmarks")
"""Folders of the source distribution besides the package."""


def _is_clutter(name: str) -> bool:
    return any(fnmatch(part, pattern) for part in Path(name).parts for pattern in (*NEITHER, "*.py[cod]", "*.tmp"))


def _files(folder: Path) -> set[str]:
    """The files below a folder of the repository, with their paths from the root, without those that tools left."""
    names = (str(path.relative_to(ROOT)) for path in folder.rglob("*") if path.is_file())
    return {name for name in names if not _is_clutter(name)}


def test_every_data_file_of_the_package_is_declared() -> None:
    patterns = PROJECT["tool"]["setuptools"]["package-data"]["pkm_exact"]
    data = {name for name in _files(ROOT / "pkm_exact") if not name.endswith(".py")}
    for name in data:
        inside = name.removeprefix("pkm_exact/")
        assert any(fnmatch(inside, pattern) for pattern in patterns), f"pyproject.toml, package-data: add {inside}"
    for pattern in patterns:
        assert any(fnmatch(name.removeprefix("pkm_exact/"), pattern) for name in data), f"{pattern}: matches nothing"


def test_every_folder_of_the_package_is_a_package() -> None:
    for name in _files(ROOT / "pkm_exact"):
        if name.endswith(".py"):
            assert (ROOT / name).with_name("__init__.py").is_file(), name


def test_the_python_versions_agree() -> None:
    """Those in the classifiers, the least one, and those that are looked for to test the wheel."""
    listed = [
        int(classifier.rpartition("3.")[2])
        for classifier in PROJECT["project"]["classifiers"]
        if re.fullmatch(r"Programming Language :: Python :: 3\.\d+", classifier)
    ]
    assert PROJECT["project"]["requires-python"] == f">=3.{min(listed)}"
    script = (ROOT / ".ci" / "test-versions").read_text(encoding="utf-8")
    looked_for = re.search(r"^for minor in ([\d ]+);", script, re.MULTILINE)
    assert looked_for is not None
    assert set(listed) <= set(map(int, looked_for[1].split()))


def test_the_changelog_is_in_order() -> None:
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    headings = re.findall(r"^## (.*)$", text, re.MULTILINE)
    assert headings[0] == "[Unreleased]"
    released = [re.fullmatch(r"\[(\d+)\.(\d+)\.(\d+)\] - (\d{4}-\d\d-\d\d)", heading) for heading in headings[1:]]
    assert all(released)
    versions = [tuple(map(int, match.groups()[:3])) for match in released if match]
    assert versions == sorted(versions, reverse=True)
    assert ".".join(map(str, versions[0])) == pkm_exact.__version__
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    day = released[0][4] if released[0] else ""
    assert date.fromisoformat(day)
    assert f"date-released: {day}\n" in citation


def test_what_is_packed_is_there() -> None:
    """MANIFEST.in names folders and files that exist: the builder only warns where they do not."""
    for line in (ROOT / "MANIFEST.in").read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words and words[0] in ("graft", "include"):
            for name in words[1:]:
                assert (ROOT / name).exists(), f"MANIFEST.in: {name} does not exist"


# Built and installed.


def _run(*command: str | Path, cwd: Path, **options: str) -> str:
    """The output of a command that must succeed, run without anything that points to this repository."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "VIRTUAL_ENV", "COV"))}
    done = subprocess.run(
        list(map(str, command)), capture_output=True, text=True, check=False, cwd=cwd, env=kept | options
    )
    assert done.returncode == 0, f"{command}: {done.stdout}\n{done.stderr}"
    return done.stdout


def _environment(folder: Path, *packages: str | Path) -> Path:
    """A new environment with some packages; its folder of programs."""
    _run(sys.executable, "-m", "venv", folder, cwd=folder.parent)
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    _run(programs / "python", "-m", "pip", "--quiet", "install", *packages, cwd=folder)
    return programs


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The wheel and the source distribution, built from a copy of the repository."""
    folder = tmp_path_factory.mktemp("build")
    try:
        programs = _environment(folder / "builder", "build")
    except AssertionError as error:
        pytest.skip(f"the package build cannot be installed here: {error}"[:300])
    copy = folder / "copy"
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*NEITHER))
    _run(programs / "python", "-m", "build", "--outdir", folder / "dist", copy, cwd=folder)
    (wheel,), (sources,) = (folder / "dist").glob("*.whl"), (folder / "dist").glob("*.tar.gz")
    return wheel, sources


@pytest.mark.slow
def test_the_wheel_has_the_package_and_nothing_else(built: tuple[Path, Path]) -> None:
    names = set(zipfile.ZipFile(built[0]).namelist())
    package = {name for name in names if ".dist-info/" not in name}
    assert package == _files(ROOT / "pkm_exact")
    assert any(name.endswith(".dist-info/licenses/LICENSE") for name in names)


@pytest.mark.slow
def test_the_sources_are_complete_and_without_clutter(built: tuple[Path, Path]) -> None:
    with tarfile.open(built[1]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames() if archive.getmember(name).isfile()}
    for folder in ("pkm_exact", *SHIPPED):
        assert _files(ROOT / folder) <= names
    assert {"README.md", "LICENSE", "CHANGELOG.md", "CITATION.cff", "CONTRIBUTING.md", "Makefile"} <= names
    rest = {name for name in names if not name.startswith("pkm_exact.egg-info/")}
    assert not [name for name in rest if _is_clutter(name)]


@pytest.mark.slow
@pytest.mark.parametrize(
    "number", [pytest.param(0, id="wheel"), pytest.param(1, id="sources", marks=pytest.mark.largest)]
)
def test_it_works_where_the_repository_is_not(number: int, built: tuple[Path, Path], tmp_path: Path) -> None:
    programs = _environment(tmp_path / "environment", built[number])
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    command = programs / "certify-poses"
    where = _run(programs / "python", "-c", "import pkm_exact; print(pkm_exact.__file__)", cwd=elsewhere)
    assert str(tmp_path) in where
    assert _run(command, "selftest", cwd=elsewhere).endswith("everything works\n")
    sides = ("--base-sides", "400,200", "--platform-sides", "100,300")
    _run(command, "new", "--kind", "6-6", *sides, "--height", "500", "-o", "my-robot.toml", cwd=elsewhere)
    _run(command, "solve", "my-robot.toml", "-o", "my-robot.json", cwd=elsewhere)
    assert _run(command, "check", "my-robot.json", cwd=elsewhere).endswith("my-robot.json: accepted\n")
    _run(command, "report", "my-robot.json", "-o", "my-robot.html", cwd=elsewhere)
    assert {path.name for path in elsewhere.iterdir()} == {"my-robot.toml", "my-robot.json", "my-robot.html"}

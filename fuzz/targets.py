"""What the fuzzer calls: each takes bytes, and raises only if the program is at fault."""

from __future__ import annotations

import io
import json
import os
import shutil
import sys
from collections.abc import Callable, Mapping
from contextlib import redirect_stderr, redirect_stdout
from math import prod
from pathlib import Path
from tempfile import TemporaryDirectory

from pkm_exact.certify import pure
from pkm_exact.certify.check import check_bytes
from pkm_exact.cli.main import ExitCode, main
from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.geometry.path_reader import read_path
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.robot import Robot
from pkm_exact.interactive.system_answers import solve_system
from pkm_exact.sweep.lengths import LengthRow, problem_of, read_lengths
from pkm_exact.systems.system_sources import read_system

ROOT = Path(__file__).parent.parent
QUICK = ROOT / "models" / "3-rpr-merlet-p.toml"
STATUSES = {"accepted", "rejected", "malformed", "too-large"}
TOO_LARGE = "too-large"
"""The second checker may say so where the first decides: it is the slower one."""


class Finding(Exception):  # noqa: N818 - what a fuzzer looks for
    """The program did what it never should."""


def fuzz_model(data: bytes) -> None:
    """A model file is read, or refused in one sentence; what is read can be posed as a problem."""
    try:
        robot = robot_from_toml(data.decode("utf-8-sig"))
        for configuration in robot.configurations:
            robot.problem(configuration)
    except UnicodeDecodeError:
        return
    except InputError as error:
        _require_sentence(str(error))


def fuzz_certificate(data: bytes) -> None:
    """The first checker has a verdict with a reason."""
    verdict = check_bytes(data)
    if str(verdict.status) not in STATUSES or not verdict.lines:
        raise Finding(f"{verdict.status}: {verdict.lines}")


def fuzz_checkers(data: bytes) -> None:
    """Both checkers have the same verdict."""
    first, second = check_bytes(data), pure.check_bytes(data)
    if str(first.status) != str(second.status) != TOO_LARGE:
        raise Finding(f"{first.status} {first.lines[-1:]}, but {second.status} {second.lines[-1:]}")


def fuzz_path(data: bytes) -> None:
    """A path is read, or refused in one sentence."""
    robot = read_robot(QUICK)
    with TemporaryDirectory() as name:
        file = Path(name) / "path.csv"
        file.write_bytes(data)
        try:
            path = read_path(file, robot)
        except InputError as error:
            _require_sentence(str(error))
            return
    if not path.rows or any(len(row) != 3 or min(row) <= 0 for row in path.rows):
        raise Finding(f"a path that is none: {path.rows[:2]}")


def fuzz_lengths(data: bytes) -> None:
    """Length vectors are read row by row, and each that is none, or the whole file, refused in one sentence."""
    robot = read_robot(QUICK)
    with TemporaryDirectory() as name:
        file = Path(name) / "lengths.csv"
        file.write_bytes(data)
        try:
            lengths = read_lengths(file, robot)
            for row in lengths.rows():
                _try_row(robot, row, lengths.names)
        except InputError as error:
            _require_sentence(str(error))


def _try_row(robot: Robot, row: LengthRow, names: tuple[str, ...]) -> None:
    try:
        problem = problem_of(robot, row, names, squared=False)
    except InputError as error:
        _require_sentence(str(error))
        return
    if any(leg.length_squared <= 0 for leg in problem.distances):
        raise Finding(f"lengths that are none: {row}")


SMALL_DEGREES = 12
"""Systems with a greater product of degrees are read only."""


def fuzz_system(data: bytes) -> None:
    """A system is read, or refused in one sentence; what is small is solved, and both checkers accept what is said."""
    with TemporaryDirectory() as name:
        file = Path(name) / "system.ms"
        file.write_bytes(data)
        try:
            system = read_system(file)
        except InputError as error:
            _require_sentence(str(error))
            return
    degrees = prod(max(int(polynomial.total_degree()), 1) for polynomial in system.polynomials)
    if degrees > SMALL_DEGREES or len(data) > 500:
        return
    try:
        found = solve_system(system)
    except PkmExactError as error:
        _require_sentence(str(error))
        return
    certificate = found.certificate().data
    for verdict in (check_bytes(certificate), pure.check_bytes(certificate)):
        if str(verdict.status) != "accepted":
            raise Finding(f"{found}: {verdict.lines[-1]}")


FILES = ("r.toml", "c.json", "p.csv", "none.toml", ".", "", "o.json", "/dev/null", "-", "no/o.json")
VOCABULARY = """
solve check track legs export new report plot completion --help --version -o --method exact krawczyk newton
--configuration home --lengths 7,5,5 1e-3,1/3,0 --width 1e-9 1e-400 2 --format json csv table -v --start 0,0,0 1
--position 1,2 --quaternion 1,0,0,0 --cayley 0,0,1 --matrix --to msolve singular latex --formulation SE3 AFD1:zxz
--tolerance 0 -1 --pure --localised --recompute nan inf 1e999999999 -- =
"""
WORDS = (*VOCABULARY.split(), "\x00", "\udcff", "--start=", "é", *FILES)
KEPT = {"r.toml", "c.json", "p.csv", "o.json"}
PLAIN = (
    "solve r.toml -o o.json",
    "check c.json",
    "track r.toml p.csv --start 1 -o o.json",
    "legs r.toml --position 1,2",
)


def fuzz_command(data: bytes) -> None:
    """A command line ends with one of the exit codes, and leaves nothing but whole files.

    The bytes choose words: of a list, or letters of their own after the byte 255.
    """
    words = _words(data)
    if not {"formulations", "compare", "sweep"}.isdisjoint(words):
        return
    home = Path.cwd()
    with TemporaryDirectory() as name:
        folder = Path(name)
        shutil.copy(QUICK, folder / "r.toml")
        shutil.copy(ROOT / "certs" / f"{QUICK.stem}.json", folder / "c.json")
        (folder / "p.csv").write_text("7,5,5\n7.01,5,5\n", encoding="ascii")
        os.chdir(folder)
        try:
            code, said = _run(words)
        finally:
            os.chdir(home)
        _require_tidy(folder, words, code)
    if code not in set(ExitCode):
        raise Finding(f"{words}: exit code {code}")
    if code in (ExitCode.BAD_INPUT, ExitCode.NO_ANSWER) and not said.strip():
        raise Finding(f"{words}: exit code {code} without a word")


def _words(data: bytes) -> list[str]:
    words, position = [], 0
    while position < len(data) and len(words) < 16:
        index = data[position]
        position += 1
        if index == 255:
            words.append(data[position : position + 6].decode("utf-8", errors="surrogateescape"))
            position += 6
        elif index >= 255 - len(PLAIN):
            words += PLAIN[255 - len(PLAIN) - index].split()
        else:
            words.append(WORDS[index % len(WORDS)])
    return words


def _run(words: list[str]) -> tuple[int, str]:
    output, errors = io.TextIOWrapper(io.BytesIO(), "utf-8"), io.TextIOWrapper(io.BytesIO(), "utf-8")
    with redirect_stdout(output), redirect_stderr(errors):
        try:
            code = main(words)
        except SystemExit as end:
            raise Finding(f"{words}: left by exit {end.code}") from end
        texts = []
        for stream in (output, errors):
            stream.flush()
            texts.append(stream.buffer.getvalue().decode(errors="replace"))  # type: ignore[attr-defined]
        return code, "".join(texts)


def _require_tidy(folder: Path, words: list[str], code: int) -> None:
    names = {path.name for path in folder.iterdir()}
    written = names - KEPT
    if any(name.startswith(".") or name.endswith((".part", ".tmp")) or "report" in name for name in written):
        raise Finding(f"{words}: exit code {code}, left {sorted(written)}")
    target = folder / "o.json"
    if target.is_file() and not target.read_bytes().strip():
        raise Finding(f"{words}: an empty file")
    if target.is_file() and target.read_bytes().startswith(b"{"):
        json.loads(target.read_bytes())


def _require_sentence(text: str) -> None:
    if not text or "\n" in text or len(text) > 2000:
        raise Finding(f"not a sentence: {text[:200]!r}")


TARGETS: Mapping[str, Callable[[bytes], None]] = {
    "model": fuzz_model,
    "certificate": fuzz_certificate,
    "checkers": fuzz_checkers,
    "path": fuzz_path,
    "lengths": fuzz_lengths,
    "system": fuzz_system,
    "command": fuzz_command,
}

if __name__ == "__main__":
    TARGETS[sys.argv[1]](Path(sys.argv[2]).read_bytes())

"""The samples of a documentation page: found, and executed as a reader would, in order, in one folder and one session.

Fenced blocks say what they are by their language tag:

sh      commands. ``certify-poses`` and ``certify-roots`` run inside this process. ``# exit code 3`` behind one says
        what it returns.
        ``make`` targets must exist, ``pip install`` extras must be those of pyproject.toml, other lines run in bash.
python  runs with the names of the page's earlier blocks. ``# -> text`` behind a ``print`` says what it prints.
toml    is a robot if it has a ``schema``; yaml, json must be valid.
text    is not executed. With ``<!-- output -->`` above it, its lines must be among those that the page printed.

A block with ``title="NAME"`` is also written to the file of that name, for the commands after it.
``<!-- slow -->`` above a block leaves it to the slow tests; ``<!-- needs NAME -->`` leaves it out without that package.
As a program: ``doc_samples.py [--slow] PAGE`` runs the page in the current folder and reports the first sample that
does not do what the page says.
"""

from __future__ import annotations

import io
import json
import re
import shlex
import subprocess
import sys
import tomllib
import traceback
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
LANGUAGES = frozenset({"sh", "python", "toml", "yaml", "json", "text"})
ELSEWHERE = ("git clone ", "cd ", ". .venv/", "source .venv/")
"""How lines begin that are about the reader's machine."""


class SampleError(Exception):
    """A sample does not do what its page says."""


@dataclass(frozen=True)
class Block:
    """A fenced block: its line in the page, its language tag, its text, the remark in the line above, and its title."""

    line: int
    language: str
    text: str
    remark: str = ""
    title: str = ""

    @property
    def is_slow(self) -> bool:
        """Whether the page leaves this block to the slow tests."""
        return "<!-- slow -->" in self.remark


def blocks(page: str) -> list[Block]:
    """All fenced blocks of a page, wherever they are indented to."""
    found: list[Block] = []
    lines = page.splitlines()
    number = 0
    while number < len(lines):
        opening = re.fullmatch(r"( *)(```+)\s*(\S*)(.*)", lines[number])
        number += 1
        if opening is None:
            continue
        indent, fence, language, rest = opening.groups()
        start = number
        while number < len(lines) and lines[number].strip() != fence:
            number += 1
        if number == len(lines):
            raise SampleError(f"line {start}: the block does not end")
        text = "\n".join(line.removeprefix(indent) for line in lines[start:number])
        above = lines[start - 2].strip() if start > 1 else ""
        remark = above if above.startswith("<!--") else ""
        title = re.search(r'title="([\w.-]+)"', rest)
        found.append(Block(start, language, text + "\n", remark, title[1] if title else ""))
        number += 1
    return found


def commands(block: Block) -> Iterator[tuple[int, str, int]]:
    """The commands of a ``sh`` block: line, command without its comment, exit code. A backslash continues a line."""
    pending, begin = "", 0
    for number, line in enumerate(block.text.splitlines(), block.line + 1):
        begin = begin if pending else number
        pending += line.strip()
        if pending.endswith("\\"):
            pending = pending[:-1]
            continue
        command, _, comment = pending.partition(" #")
        pending = ""
        if command.strip() and not command.startswith("#"):
            code = re.search(r"exit code (\d+)", comment)
            yield begin, command.strip(), int(code[1]) if code else 0


@dataclass
class Session:
    """A reader at work: the names that Python knows, and all that was printed."""

    names: dict[str, Any] = field(default_factory=lambda: {"__name__": "__main__"})
    printed: list[str] = field(default_factory=list)

    def run(self, block: Block) -> None:
        """Execute a block, or check that it is valid.

        Raises
        ------
        SampleError
            With the line of the page.
        """
        if block.title:
            Path(block.title).write_text(block.text, encoding="utf-8")
        needed = re.search(r"<!-- needs (\w+) -->", block.remark)
        if needed and find_spec(needed[1]) is None:
            return
        try:
            getattr(self, f"_{block.language}")(block)
        except (ValueError, KeyError) as error:
            raise SampleError(f"line {block.line}: {error}") from None

    def _sh(self, block: Block) -> None:
        for line, command, expected in commands(block):
            try:
                code = self._command(command)
            except ValueError as error:
                raise SampleError(f"line {line}: {error}") from None
            if code != expected:
                raise SampleError(f"line {line}: {command}: exit code {code}, the page says {expected}")

    def _command(self, command: str) -> int:
        words = shlex.split(command)
        programs = ("certify-poses", "certify-roots")
        if words[0] in programs and not set(words) & {"|", ">", ">>", "<", "&&", "||", ";", "*"}:
            from pkm_exact.cli.main import main

            with redirect_stdout(io.StringIO()) as out:
                code = int(main(words[1:], words[0]))
            self.printed += out.getvalue().splitlines()
            return code
        if words[0] == "make":
            return subprocess.run(["make", "-n", *words[1:]], cwd=ROOT, stdout=subprocess.DEVNULL).returncode
        if "install" in words[:4]:
            _require_extras(words)
            return 0
        if command.startswith(ELSEWHERE):
            return 0
        done = subprocess.run(["bash", "-c", command], stdout=subprocess.PIPE, text=True)
        self.printed += done.stdout.splitlines()
        return done.returncode

    def _python(self, block: Block) -> None:
        # As many lines before it as in the page, so that a traceback names the page's line.
        code = compile("\n" * block.line + block.text, "sample", "exec")
        with redirect_stdout(io.StringIO()) as out:
            try:
                exec(code, self.names)  # noqa: S102 - our own pages
            except Exception as error:
                line = traceback.extract_tb(error.__traceback__)[1].lineno
                raise SampleError(f"line {line}: {type(error).__name__}: {error}") from None
        printed = out.getvalue().splitlines()
        for comment in re.findall(r"# -> (.*)", block.text):
            if comment.strip() not in (line.strip() for line in printed):
                raise SampleError(f"line {block.line}: prints {printed}, the page says {comment!r}")
        self.printed += printed

    def _toml(self, block: Block) -> None:
        content = tomllib.loads(block.text)
        if "schema" in content:
            from pkm_exact import InputError
            from pkm_exact.geometry.reader import read_any

            path = Path("sample-of-the-page.toml")
            path.write_text(block.text, encoding="utf-8")
            try:
                read_any(path)
            except InputError as error:
                raise ValueError(f"no robot: {error}") from None

    def _yaml(self, block: Block) -> None:
        import yaml

        try:
            yaml.safe_load(block.text)
        except yaml.YAMLError as error:
            raise ValueError(f"no YAML: {error}") from None

    def _json(self, block: Block) -> None:
        json.loads(block.text)

    def _text(self, block: Block) -> None:
        if "<!-- output -->" not in block.remark:
            return
        printed = {" ".join(line.split()) for line in self.printed}
        for line in block.text.splitlines():
            if line.strip() not in ("", "...") and " ".join(line.split()) not in printed:
                raise SampleError(f"line {block.line}: {line!r} was not printed")


def _require_extras(words: list[str]) -> None:
    """Refuse extras that the package does not have."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    for word in words:
        match = re.fullmatch(r"(?:\.|pkm_exact|[^\[]*\.whl)\[([\w,-]+)\]", word)
        unknown = set(match[1].split(",")) - set(project["optional-dependencies"]) if match else set()
        if unknown:
            raise ValueError(f"{word}: the package has no extra {sorted(unknown)}")


def main(arguments: list[str]) -> int:
    """Run a page's samples in the current folder."""
    page = Path(arguments[-1])
    session = Session()
    for block in blocks(page.read_text(encoding="utf-8")):
        if block.is_slow and "--slow" not in arguments:
            continue
        try:
            session.run(block)
        except SampleError as error:
            print(f"{page}: {error}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

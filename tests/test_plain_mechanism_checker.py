"""The plain checker of version 2 answers what the first one answers: honest certificates and forged ones."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest
from certificate_tools import both
from mechanism_certificates import MADE, mechanism_bytes

from pkm_exact.certify import pure, pure_mechanism

SOURCES = [Path(module.__file__) for module in (pure, pure_mechanism)]
DEAR = ("3-RPS", "3-RPS, boxes")


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] * (n in DEAR)) for n in MADE])
def test_honest_certificates_are_accepted_with_the_same_lines(name: str) -> None:
    assert both(mechanism_bytes(name)).status == "accepted"


def test_both_files_run_alone(tmp_path: Path) -> None:
    (tmp_path / "good.json").write_bytes(mechanism_bytes("H4"))
    (tmp_path / "changed.json").write_bytes(mechanism_bytes("H4").replace(b"constraint 1", b"constraint 5"))
    command = [sys.executable, "-I", "-S", "program.py", "good.json", "changed.json"]

    def run() -> str:
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.stderr == ""
        return done.stdout

    (tmp_path / "program.py").write_bytes(SOURCES[0].read_bytes())
    assert "good.json: malformed" in run()
    (tmp_path / "pure_mechanism.py").write_bytes(SOURCES[1].read_bytes())
    lines = run().splitlines()
    assert "good.json: accepted" in lines
    assert "changed.json: rejected" in lines


def test_they_import_only_the_standard_library_and_each_other() -> None:
    for source in SOURCES:
        for node in ast.walk(ast.parse(source.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            names += [str(node.module)] if isinstance(node, ast.ImportFrom) else []
            own = ("pkm_exact.certify", "pure") if source == SOURCES[1] else ()
            assert all(name.split(".")[0] in sys.stdlib_module_names or name in own for name in names)

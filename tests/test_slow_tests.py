"""The list of slow tests names tests that there are, and marks them."""

import re
import subprocess
import sys

import pytest
from slow_tests import KEPT, LIST, MEASURED, is_listed

ROOT = LIST.parent.parent


def test_the_list_is_in_order_and_names_no_test_twice() -> None:
    lines = LIST.read_text(encoding="utf-8").splitlines()
    assert lines == sorted(set(lines))
    functions = {line for line in lines if "[" not in line}
    assert [line for line in lines if "[" in line and is_listed(line, functions)] == []
    assert not MEASURED & KEPT
    assert [line for line in lines if "[/" in line] == [], "of one machine only"


def test_every_function_in_the_list_is_there() -> None:
    texts: dict[str, str] = {}
    missing = []
    for line in MEASURED:
        path, _, name = line.partition("[")[0].partition("::")
        if path not in texts:
            texts[path] = (ROOT / path).read_text(encoding="utf-8") if (ROOT / path).exists() else ""
        # A doctest has the name of the module itself or of one of its parts.
        last = name.rpartition(".")[2]
        if not re.search(rf"\b{re.escape(last)}\b", texts[path]) and not path.endswith(f"{last}.py"):
            missing.append(line)
    assert missing == []


@pytest.mark.slow
def test_every_test_in_the_list_is_there_and_marked() -> None:
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:xdist", "-m", "slow and in_corpus"]
    output = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=True).stdout
    names = {line for line in output.splitlines() if "::" in line}
    known = names | {name.partition("[")[0] for name in names}
    assert [line for line in MEASURED if line not in known] == []

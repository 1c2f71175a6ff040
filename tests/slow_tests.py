"""Tests that were measured to take long: ``slow_tests.txt`` names them, and `make test-slow` runs them.

A line is the name of a test as pytest shows it, or of a function with all its parameters. As a program:
``slow_tests.py TIMES`` writes the list anew from what a run with ``PKM_EXACT_TIMES=TIMES`` has measured. Of every
function with parameters the quickest stays in the quick suite, unless it takes nearly a second. What a fixture costs is
counted to the test that asks for it first: where all tests that ask for it are to be slow, further runs name them.
"""

from __future__ import annotations

import json
import sys
from collections import defaultdict
from collections.abc import Collection, Mapping
from pathlib import Path

LIST = Path(__file__).with_suffix(".txt")
ALONE = 0.4
"""Seconds of processor time; a function without parameters that takes more is slow."""
ONE_OF_MANY = 0.1
"""The same for one of several parameters."""
QUICKEST = 0.8
"""The same for the quickest of them."""
KEPT = frozenset(
    {
        "tests/test_docs.py::test_the_samples_of_a_page_run[README.md]",
        "tests/test_imports.py::test_every_part_has_a_place_in_the_order",
        "tests/test_imports.py::test_only_the_command_line_imports_the_command_line",
        "tests/test_imports.py::test_other_modules_import_each_other_in_no_circle",
        "tests/test_imports.py::test_parts_import_from_those_above_them_only",
    }
)
"""In the quick suite however long they take: what everybody tries first, and what every change is held to."""


def _function(name: str) -> str:
    return name.partition("[")[0]


def is_listed(name: str, names: Collection[str]) -> bool:
    """Whether a test is one of those, or of a function that is.

    >>> is_listed("a.py::test[1]", {"a.py::test"}), is_listed("a.py::test[1]", {"a.py::test[2]"})
    (True, False)
    """
    return name in names or _function(name) in names


def measured(path: Path = LIST) -> frozenset[str]:
    """The names in the list."""
    return frozenset(path.read_text(encoding="utf-8").splitlines()) if path.exists() else frozenset()


MEASURED = measured()


def chosen(seconds: Mapping[str, float]) -> list[str]:
    """What belongs to the list, by the processor time of every test.

    >>> chosen({"a.py::f": 2.0, "a.py::g[1]": 0.1, "a.py::g[2]": 3.0, "a.py::h[1]": 5.0, "a.py::h[2]": 6.0})
    ['a.py::f', 'a.py::g[2]', 'a.py::h']
    """
    functions: dict[str, list[str]] = defaultdict(list)
    for name in seconds:
        functions[_function(name)].append(name)
    found = []
    for function, names in functions.items():
        quickest, *others = sorted(names, key=lambda name: (seconds[name], name))
        limit = QUICKEST if others else ALONE
        slow = [name for name in others if seconds[name] > ONE_OF_MANY]
        if seconds[quickest] > limit:
            slow.append(quickest)
        found += [function] if len(slow) == len(names) else slow
    return sorted({*found} - KEPT)


def main(times: Path) -> None:
    """Write the list anew."""
    seconds = dict(map(json.loads, times.read_text(encoding="utf-8").splitlines()))
    LIST.write_text("".join(f"{name}\n" for name in chosen(seconds)), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

"""The certificates that the tests feed to the checkers, honest and forged ones, collected by running the tests."""

from __future__ import annotations

import re
import sys
from collections import Counter
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import mutations
import pytest
from certificate_subjects import subject
from forged_bounds import NUMBERS
from forged_counts import COUNTS
from forged_mechanisms import MECHANISMS
from forged_motions import MOTIONS
from forged_neighbours import NEIGHBOURS

import pkm_exact.certify.check as first
from pkm_exact.certify import pure as plain
from pkm_exact.certify.build import canonical_bytes, sealed

HERE = Path(__file__).parent
FILES = (
    "test_*_certificates.py",
    "test_certificate_*.py",
    "test_forg*.py",
    "test_krawczyk_certificate.py",
    "test_limit_cases.py",
    "test_mixed_volumes.py",
    "test_multiplicities.py",
    "test_mutations.py",
    "test_plain_*.py",
    "test_pure_checker.py",
    "test_self_motion.py",
    "test_slices.py",
    "test_tolerances.py",
    "test_upright_legs.py",
)
WEAK = "test_any_json_in_place_of_an_entry_gets_a_verdict"
"""Tests that do not ask for a certain verdict."""


MANY = (
    *("kept-2, planar lines", "kept-2, Delta", "inconsistent-2, contradictory leg", "moving-2, few legs"),
    "kept-2, more legs than freedoms, a multiple solution",
)
SOME = (
    *("moving-2-slices, slices", "spatial-2-infinity, 3-PSS+C, general", "kept-2, cylinders"),
    *("kept-2, planar lines, boxes", "kept-2, redundant leg", "moving-2, joints on a line"),
)
CHANGED = dict.fromkeys(MANY, 1500) | dict.fromkeys(SOME, 700)
"""Certificates of which so many changes of single entries are kept besides, a sample of what ``mutations`` makes."""
ALIKE = 3
"""As many certificates are kept of those that one test checks and that get the same verdict for the same reason."""


class Collector:
    """A plugin of pytest that keeps what is checked, with the name of the first test that does."""

    def __init__(self) -> None:
        self.found: dict[bytes, str] = {}
        self.alike: Counter[tuple[str, str, str]] = Counter()
        self.test = ""
        self.failures = 0
        for checker in (first, plain):
            _replace_everywhere(checker.check_bytes, self.kept(checker.check_bytes))

    def kept(self, check: Any) -> Any:
        """A checker that keeps what it is given."""

        def check_bytes(data: bytes) -> Any:
            verdict = check(data)
            if self.test and WEAK not in self.test and data not in self.found:
                sort = self.test, str(verdict.status), re.sub(r"[0-9]+|\([^)]*\)", "", verdict.lines[-1])
                self.alike[sort] += 1
                if self.alike[sort] <= ALIKE:
                    self.found[data] = self.test
            return verdict

        return check_bytes

    def pytest_runtest_protocol(self, item: pytest.Item) -> None:
        """A test begins."""
        self.test = item.nodeid.partition("::")[2]

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """A test ends."""
        self.failures += report.failed


def _replace_everywhere(old: Any, new: Any) -> None:
    """Whatever module has it by name, also those that were imported before."""
    for module in list(sys.modules.values()):
        for name in [name for name, value in vars(module).items() if value is old]:
            setattr(module, name, new)


def collect(target: Path, tests: Sequence[str] = ()) -> int:
    """Run the tests, or those files of them that are named, and write what they check to a ZIP file; the exit code."""
    collector = Collector()
    files = list(tests) or sorted({str(path) for pattern in FILES for path in HERE.glob(pattern)})
    options = ["-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-m", "not slow or in_corpus"]
    code = pytest.main([*options, *files], plugins=[collector])
    if not tests:
        _add_changes(collector)
    target.parent.mkdir(parents=True, exist_ok=True)
    with ZipFile(target.with_suffix(".part"), "w", ZIP_DEFLATED) as archive:
        for data, test in collector.found.items():
            name = f"{sha256(data).hexdigest()[:16]} {test[:120].replace('/', '|')}"
            archive.writestr(ZipInfo(name), data, ZIP_DEFLATED, 1)
    target.with_suffix(".part").replace(target)
    print(f"{len(collector.found)} certificates")
    return int(code) or int(collector.failures > 0)


def _add_changes(collector: Collector) -> None:
    """What no test asks one by one: samples of the mutation suite, and all that the tables of forgeries make."""
    for name, most in CHANGED.items():
        collector.test = f"{name}, changed"
        for mutation in mutations.sampled(list(mutations.mutations(subject(name))), most, name):
            if isinstance(mutation.content, dict):
                first.check_bytes(canonical_bytes(sealed(mutation.content)))
    for name, (make, _) in (MECHANISMS | MOTIONS | NEIGHBOURS | NUMBERS | COUNTS).items():
        collector.test = f"forged: {name}"
        first.check_bytes(canonical_bytes(sealed(make())))


if __name__ == "__main__":
    sys.exit(collect(Path(sys.argv[1]), sys.argv[2:]))

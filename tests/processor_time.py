"""What tests cost: processor time, of the processes that they start too, by file; a busy machine changes it little.

With ``PKM_EXACT_TIMES=FILE`` every test's is written there, a line each: what ``slow_tests.py`` chooses from.
"""

from __future__ import annotations

import json
import os
from collections import Counter
from collections.abc import Generator
from pathlib import Path

import pytest

KEY = "processor time"
WORTH_SAYING = 30.0
"""Seconds; a run of a single file says nothing."""


def _seconds() -> float:
    return sum(os.times()[:4])


class ProcessorTime:
    """A pytest plugin: measured where a test runs, summed up where results are shown."""

    def __init__(self) -> None:
        self._start = _seconds()
        self._spent: Counter[str] = Counter()
        # Where results are shown; a worker's reports come there too.
        self._times = "" if "PYTEST_XDIST_WORKER" in os.environ else os.environ.get("PKM_EXACT_TIMES", "")

    def pytest_runtest_logstart(self) -> None:
        """A test begins."""
        self._start = _seconds()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, call: pytest.CallInfo[None]) -> Generator[None, pytest.TestReport]:
        """It is over, with all that was made for it taken down."""
        report = yield
        if call.when == "teardown":
            report.user_properties.append((KEY, _seconds() - self._start))
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Its result has arrived."""
        if report.when == "teardown":
            spent = dict(report.user_properties).get(KEY, 0)
            self._spent[report.nodeid.partition("::")[0]] += spent
            if self._times:
                with Path(self._times).open("a", encoding="utf-8") as stream:
                    stream.write(json.dumps([report.nodeid, round(spent, 3)]) + "\n")

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """All results are there."""
        total = sum(self._spent.values())
        if total >= WORTH_SAYING:
            most = ", ".join(f"{Path(name).name} {spent:.0f}" for name, spent in self._spent.most_common(10))
            terminalreporter.write_line(f"processor time: {total:.0f} s in tests; most of it in {most}")

"""What the fuzzer calls, on good inputs and on a few hundred changed ones; the fuzzer itself is not needed."""

from __future__ import annotations

import sys
from pathlib import Path
from random import Random
from typing import Any

import pytest

FOLDER = Path(__file__).parent.parent / "fuzz"
NAMES = ("model", "path", "lengths", "system", "certificate", "checkers", "command")


@pytest.fixture
def fuzzing(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The modules of the folder."""
    monkeypatch.syspath_prepend(str(FOLDER))
    import mutation
    import seeds
    import targets

    yield mutation, seeds, targets
    for name in ("mutation", "seeds", "targets"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("name", NAMES)
def test_good_inputs_are_no_findings(fuzzing: Any, name: str) -> None:
    _, seeds, targets = fuzzing
    found = seeds.seeds(name)
    assert found
    for data in found:
        targets.TARGETS[name](data)


@pytest.mark.parametrize("name", NAMES)
def test_changed_inputs_are_no_findings(fuzzing: Any, name: str) -> None:
    mutation, seeds, targets = fuzzing
    random = Random(name)
    found = seeds.seeds(name)
    for number in range(60):
        data = bytearray(random.choice(found))
        changed = mutation.mutated(bytes(data), number) if name in ("certificate", "checkers") else None
        for _ in range(3):
            data[random.randrange(len(data))] = random.randrange(256)
        targets.TARGETS[name](bytes(data) if changed is None else changed)


def test_changed_certificates_reach_the_checks(fuzzing: Any) -> None:
    mutation, seeds, _ = fuzzing
    from pkm_exact import check_bytes

    statuses = {
        str(check_bytes(mutation.mutated(data, seed)).status) for data in seeds.seeds("checkers") for seed in range(40)
    }
    assert statuses >= {"accepted", "rejected", "malformed"}


def test_a_fault_is_a_finding(fuzzing: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    _, seeds, targets = fuzzing
    monkeypatch.setattr(targets, "main", lambda _words: 17)
    with pytest.raises(targets.Finding, match="exit code 17"):
        targets.fuzz_command(bytes([254]))
    monkeypatch.setattr(targets.pure, "check_bytes", lambda _data: targets.check_bytes(b""))
    with pytest.raises(targets.Finding, match="but malformed"):
        targets.fuzz_checkers(seeds.seeds("checkers")[0])

"""What a checker does on one file is bounded: its work is counted before it is done."""

from __future__ import annotations

from pathlib import Path

import pytest

from pkm_exact.certify import check, pure

ROOT = Path(__file__).parents[1]
CASES = Path(__file__).parent / "cases"
LARGE = ("6-6p", "6-6pp", "dietmaier", "hexa", "linapod-n", "rolland-6-6", "ssm-rounded")
GOLDENS = [
    pytest.param(path, id=path.stem, marks=pytest.mark.slow if path.stem in LARGE else ())
    for path in sorted((ROOT / "certs").glob("*.json"))
]


@pytest.mark.parametrize("path", GOLDENS)
def test_honest_certificates_need_half_of_the_work_allowed_at_most(path: Path) -> None:
    data = path.read_bytes()
    verdict, budget = check.check_counted(data)
    assert verdict, verdict
    assert 0 < 2 * budget.spent <= budget.limit
    answer, work = pure.check_counted(data)
    assert answer.status == "accepted", answer
    assert 0 < 2 * work.spent <= work.allowed


def test_a_step_that_would_take_minutes_is_not_begun() -> None:
    """5,000 dense products in a file of 178 kB kept a checker busy for eight minutes."""
    data = (CASES / "slow-elimination.json").read_bytes()
    verdict, budget = check.check_counted(data)
    assert verdict.status is check.Status.TOO_LARGE
    assert budget.spent < budget.limit // 4
    answer, work = pure.check_counted(data)
    assert answer.status == "too-large"
    assert work.spent < work.allowed // 4

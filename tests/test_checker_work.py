"""What a checker does on one file is bounded: its work is counted before it is done."""

from __future__ import annotations

from pathlib import Path

import pytest

from pkm_exact.certify import check

ROOT = Path(__file__).parents[1]
CASES = Path(__file__).parent / "cases"
LONG = ("hexaglide", "ssm-rounded")
GOLDENS = [
    pytest.param(path, id=path.stem, marks=[pytest.mark.slow] * (path.stem in LONG))
    for path in sorted((ROOT / "certs").glob("*.json"))
]


@pytest.mark.parametrize("path", GOLDENS)
def test_honest_certificates_need_half_of_the_work_allowed_at_most(path: Path) -> None:
    verdict, budget = check.check_counted(path.read_bytes())
    assert verdict, verdict
    assert 0 < 2 * budget.spent <= budget.limit


def test_a_step_that_would_take_minutes_is_not_begun() -> None:
    """5,000 dense products in a file of 178 kB kept a checker busy for eight minutes."""
    verdict, budget = check.check_counted((CASES / "slow-elimination.json").read_bytes())
    assert verdict.status is check.Status.TOO_LARGE
    assert budget.spent < budget.limit // 4

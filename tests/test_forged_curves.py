"""Sections with curves in them are told from finite ones; and certificates that show one condition each."""

import pytest
from certificate_tools import both_resealed, check_resealed, last_line
from forged_curves import CURVES
from forged_singles import SINGLES


@pytest.mark.parametrize("name", CURVES)
def test_a_curve_in_the_section_is_seen(name: str) -> None:
    make, status, reason = CURVES[name]
    answer = check_resealed(make())
    assert (answer.status, last_line(answer)) == (status, reason)


@pytest.mark.slow
@pytest.mark.parametrize("name", CURVES)
def test_both_checkers_see_it(name: str) -> None:
    make, status, _ = CURVES[name]
    assert both_resealed(make()).status == status


@pytest.mark.parametrize("name", SINGLES)
def test_one_condition_decides(name: str) -> None:
    make, status, reason = SINGLES[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)
    assert last_line(answer).startswith(reason)

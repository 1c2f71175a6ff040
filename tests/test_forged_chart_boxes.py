"""Certificates that differ from each other, or from the truth, in one coordinate or by little, for both checkers."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_chart_boxes import CHART_BOXES


@pytest.mark.parametrize("name", CHART_BOXES)
def test_in_one_coordinate(name: str) -> None:
    make, status = CHART_BOXES[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)

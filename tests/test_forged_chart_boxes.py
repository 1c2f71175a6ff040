"""Certificates that differ from each other, or from the truth, in one coordinate or by little, for both checkers."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_chart_boxes import CHART_BOXES
from forged_isotropic import ISOTROPIC
from tables_of_rows import merged

ROWS = merged(CHART_BOXES, ISOTROPIC)


@pytest.mark.parametrize("name", ROWS)
def test_in_one_coordinate(name: str) -> None:
    make, status = ROWS[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)

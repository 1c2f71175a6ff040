"""Region certificates made by hand: both checkers say of each what is true."""

import forged_regions
import forged_regions_2
import forged_regular
import pytest
from region_certificates import verdicts
from tables_of_rows import merged

ROWS = merged(forged_regions.ROWS, forged_regions_2.ROWS, forged_regular.ROWS)


def is_long(name: str) -> bool:
    """Distances of two legs with roots in them, of which those of two lengths stay; the largest determinants."""
    distances = " nearest at " in name and not name.startswith("ll ")
    return distances or name.startswith(("determinant 12: ", "determinant 13: "))


MARKED = [pytest.param(name, marks=[pytest.mark.slow, pytest.mark.in_corpus] * is_long(name)) for name in ROWS]


@pytest.mark.parametrize("name", MARKED)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    for found, lines in verdicts(content):
        assert found == status, lines
        assert lines[-1].startswith(line), lines

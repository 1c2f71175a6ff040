"""Region certificates made by hand: both checkers say of each what is true."""

import forged_regions
import forged_regions_2
import pytest
from region_certificates import verdicts
from tables_of_rows import merged

ROWS = merged(forged_regions.ROWS, forged_regions_2.ROWS)


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    for found, lines in verdicts(content):
        assert found == status, lines
        assert lines[-1].startswith(line), lines

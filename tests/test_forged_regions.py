"""Region certificates made by hand: both checkers say of each what is true."""

import pytest
from forged_regions import ROWS
from region_certificates import verdicts


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    for found, lines in verdicts(content):
        assert found == status, lines
        assert lines[-1].startswith(line), lines

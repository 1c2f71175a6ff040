"""Links certificates made by hand: both checkers say of each what is true."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_links import ROWS


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    verdict = both_resealed(content)
    assert str(verdict.status) == status, verdict.lines
    assert last_line(verdict).startswith(line), verdict.lines

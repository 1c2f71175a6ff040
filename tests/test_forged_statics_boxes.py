"""Statics certificates of boxes made by hand: both checkers say of each what is true, for the same reason."""

import pytest
from certificate_tools import both
from forged_statics_boxes import ROWS

from pkm_exact.certify.build import canonical_bytes, sealed


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    verdict = both(canonical_bytes(sealed(content)))
    assert str(verdict.status) == status, verdict.lines
    assert verdict.lines[-1].startswith(line), verdict.lines

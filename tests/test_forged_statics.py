"""Statics certificates made by hand: both checkers say of each what is true."""

import pytest
from forged_driven_statics import DRIVEN
from forged_statics import ROWS

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes


@pytest.mark.parametrize("name", [*ROWS, *DRIVEN])
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = (ROWS | DRIVEN)[name]
    data = canonical_bytes(sealed(content))
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == status, verdict.lines
        assert verdict.lines[-1].startswith(line), verdict.lines

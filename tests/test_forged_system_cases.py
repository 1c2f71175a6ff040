"""Certificates of polynomial systems made by hand: both checkers say of each what is true."""

import pytest
from forged_system_cases import ROWS
from handmade_systems import sealed_bytes

from pkm_exact.certify import pure
from pkm_exact.certify.check import check_bytes


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status = ROWS[name]
    data = sealed_bytes(content)
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == status, verdict.lines

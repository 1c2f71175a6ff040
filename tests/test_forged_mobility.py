"""Mobility certificates made by hand: both checkers say of each what is true."""

import pytest
from forged_ideal import ROWS as THIRD
from forged_ideal_shapes import ROWS as SHAPES
from forged_mobility import ROWS as FIRST
from forged_second_order import ROWS as SECOND
from tables_of_rows import merged

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes

ROWS = merged(FIRST, SECOND, THIRD, SHAPES)


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    data = canonical_bytes(sealed(content))
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == status, verdict.lines
        assert verdict.lines[-1].startswith(line), verdict.lines

"""Certificates whose count rests on an algebra, for both checkers."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_algebras import ALGEBRAS


@pytest.mark.parametrize("name", ALGEBRAS)
def test_an_algebra(name: str) -> None:
    make, status = ALGEBRAS[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)

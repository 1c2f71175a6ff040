"""Forged certificates that one check alone tells from the truth, and honest ones close to them."""

import pytest
from certificate_tools import both_resealed, last_line
from forgeries import FORGERIES


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forgery(name: str) -> None:
    forgery = FORGERIES[name]
    answer = both_resealed(forgery.make())
    assert answer.status == forgery.status, last_line(answer)
    assert last_line(answer).startswith(forgery.reason)

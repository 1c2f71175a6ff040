"""Both checkers tell certificates of version 2 that are forged from the honest ones close to them."""

from collections.abc import Callable

import pytest
from certificate_subjects import Content
from certificate_tools import last_line
from forged_mechanisms import MECHANISMS
from forged_motions import MOTIONS

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes

EVERY = MECHANISMS | MOTIONS
QUICK = 4
"""One of so many is in the quick tests."""
CASES = [
    pytest.param(*case, id=name, marks=[pytest.mark.slow] * (number % QUICK > 0))
    for number, (name, case) in enumerate(EVERY.items())
]


@pytest.mark.parametrize(("make", "status"), CASES)
def test_a_certificate_of_version_2(make: Callable[[], Content], status: str) -> None:
    data = canonical_bytes(sealed(make()))
    one, other = check_bytes(data), pure.check_bytes(data)
    assert (str(one.status), other.status) == (status, status), (last_line(one), other.lines[-1])
    assert status != "accepted" or one.lines == other.lines

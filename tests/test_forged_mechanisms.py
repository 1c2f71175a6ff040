"""Both checkers tell certificates that are forged, most of them of version 2, from the honest ones close to them."""

from collections.abc import Callable

import pytest
from certificate_subjects import Content
from certificate_tools import last_line
from forged_bounds import NUMBERS
from forged_counts import COUNTS
from forged_mechanisms import MECHANISMS
from forged_motions import MOTIONS
from forged_neighbours import NEIGHBOURS

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes

QUICK = 4
"""Of the many of version 2 one of so many is in the quick tests."""
CASES = [
    *(pytest.param(*case, id=name) for name, case in NEIGHBOURS.items()),
    *(
        pytest.param(*case, id=name, marks=[pytest.mark.slow] * (number % QUICK > 0))
        for number, (name, case) in enumerate((MECHANISMS | MOTIONS | NUMBERS | COUNTS).items())
    ),
]


@pytest.mark.parametrize(("make", "status"), CASES)
def test_both_say_so(make: Callable[[], Content], status: str) -> None:
    data = canonical_bytes(sealed(make()))
    one, other = check_bytes(data), pure.check_bytes(data)
    assert (str(one.status), other.status) == (status, status), (last_line(one), other.lines[-1])
    assert status != "accepted" or one.lines == other.lines

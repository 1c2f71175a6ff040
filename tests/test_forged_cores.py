"""Tolerance certificates at the margin of what is proved, for both checkers."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_cores import CORES, PLAIN

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed


@pytest.mark.parametrize("name", CORES)
def test_a_core(name: str) -> None:
    make, status = CORES[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)


@pytest.mark.parametrize("name", PLAIN)
def test_the_plain_checker_proves_as_much_as_it_did(name: str) -> None:
    verdict = pure.check_bytes(canonical_bytes(sealed(PLAIN[name]())))
    assert verdict.status == "accepted", verdict.lines[-1]

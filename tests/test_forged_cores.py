"""Tolerance certificates at the margin of what is proved, for both checkers."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_cores import CORES, PLAIN, WIDE

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes


@pytest.mark.parametrize("name", CORES)
def test_a_core(name: str) -> None:
    make, status = CORES[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)


@pytest.mark.parametrize("name", PLAIN)
def test_the_plain_checker_proves_as_much_as_it_did(name: str) -> None:
    verdict = pure.check_bytes(canonical_bytes(sealed(PLAIN[name]())))
    assert verdict.status == "accepted", verdict.lines[-1]


@pytest.mark.parametrize("name", WIDE)
def test_wide_boxes_are_proved_by_intervals_alone(name: str) -> None:
    data = canonical_bytes(sealed(WIDE[name]()))
    assert (check_bytes(data).status, str(pure.check_bytes(data).status)) == ("rejected", "accepted")

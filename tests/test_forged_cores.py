"""Tolerance certificates at the margin of what is proved, for both checkers."""

import pytest
from certificate_tools import both_resealed, last_line
from forged_conjugates import AS_FAR, CONJUGATES, PLAIN_ENDS
from forged_cores import CORES, PLAIN, WIDE
from tables_of_rows import merged

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes

EVERY = merged(CORES, CONJUGATES)
PROVED = merged(WIDE, AS_FAR)


@pytest.mark.parametrize("name", EVERY)
def test_a_core(name: str) -> None:
    make, status = EVERY[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)


@pytest.mark.parametrize("name", PLAIN)
def test_the_plain_checker_proves_as_much_as_it_did(name: str) -> None:
    verdict = pure.check_bytes(canonical_bytes(sealed(PLAIN[name]())))
    assert verdict.status == "accepted", verdict.lines[-1]


@pytest.mark.parametrize("name", PLAIN_ENDS)
def test_the_last_digit_of_the_plain_checker(name: str) -> None:
    make, status = PLAIN_ENDS[name]
    verdict = pure.check_bytes(canonical_bytes(sealed(make())))
    assert verdict.status == status, verdict.lines[-1]


@pytest.mark.parametrize("name", PROVED)
def test_wide_boxes_are_proved_by_intervals_alone(name: str) -> None:
    data = canonical_bytes(sealed(PROVED[name]()))
    assert (check_bytes(data).status, str(pure.check_bytes(data).status)) == ("rejected", "accepted")

"""Forged certificates that one check alone tells from the truth, and honest ones close to them."""

from collections.abc import Callable

import pytest
from certificate_subjects import Content
from certificate_tools import both_resealed, last_line
from forged_boxes import BOXES
from forged_completions import COMPLETIONS
from forged_ends import first_and_last
from forged_poses import POSES
from forged_primes import PRIMES
from forgeries import FORGERIES


@pytest.mark.parametrize("name", FORGERIES)
def test_a_forgery(name: str) -> None:
    forgery = FORGERIES[name]
    answer = both_resealed(forgery.make())
    assert answer.status == forgery.status, last_line(answer)
    assert last_line(answer).startswith(forgery.reason)


@pytest.mark.parametrize("name", [*POSES, *BOXES, *COMPLETIONS, *PRIMES])
def test_one_condition_decides(name: str) -> None:
    make, status, reason = (POSES | BOXES | COMPLETIONS | PRIMES)[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)
    assert last_line(answer).startswith(reason)


@pytest.mark.parametrize(("make", "reason"), [pytest.param(*case, id=name) for name, *case in first_and_last()])
def test_the_first_or_the_last_is_wrong(make: Callable[[], Content], reason: str) -> None:
    answer = both_resealed(make())
    assert answer.status == "rejected", last_line(answer)
    assert last_line(answer).startswith(reason)

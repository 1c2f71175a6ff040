"""Every limit of the format of certificates, from both sides: both checkers keep to it."""

from collections.abc import Callable

import pytest
from certificate_tools import both
from limit_cases import cases


@pytest.mark.parametrize(("data", "status"), [pytest.param(*case, id=name) for name, *case in cases()])
def test_a_limit(data: Callable[[], bytes], status: str) -> None:
    assert both(data()).status == status

"""How many examples a property test looks at."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import settings


def budget(examples: int) -> Callable[[Any], Any]:
    """A property test of so many examples; ``make test-slow`` has three times as many, ``make test-largest`` ten."""
    times = int(os.environ.get("PKM_EXACT_LONGER", "1"))

    def decorated(test: Any) -> Any:
        return pytest.mark.longer(settings(max_examples=times * examples)(test))

    return decorated

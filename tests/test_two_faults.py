"""Of two faults in a certificate the first decides what its verdict is: both checkers look in the same order."""

import json
from copy import deepcopy
from typing import Any

import pytest
from certificate_tools import CERTS, both_resealed

HONEST: dict[str, Any] = json.loads((CERTS / "3-rps.json").read_bytes())
KEYS = [key for key in HONEST if key not in ("format", "version", "robot", "digest")]


def with_other_forms() -> dict[str, Any]:
    content = deepcopy(HONEST)
    content["robot"]["constraints"][0]["forms"][0][0] = "7"
    return content


def with_too_many_boxes() -> dict[str, Any]:
    box = [["0", "1"]] * 4
    return deepcopy(HONEST) | {"krawczyk": {"chart": [1, 0, 0, 0], "real": [box] * 99, "complex": []}}


@pytest.mark.parametrize("key", KEYS)
@pytest.mark.parametrize("other", [with_other_forms, with_too_many_boxes])
def test_a_second_fault(other: Any, key: str) -> None:
    content = other()
    assert both_resealed(content).status == "rejected"
    content[key] = {"none": "of these"}
    assert both_resealed(content).status in ("malformed", "rejected")

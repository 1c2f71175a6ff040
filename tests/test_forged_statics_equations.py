"""Statics certificates of machines given by equations: both checkers say of each what is true, for the same reason."""

import json
from pathlib import Path

import jsonschema
import pytest
from certificate_tools import both
from forged_statics_equations import HONEST, ROWS, SLOW

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed

SCHEMA = Path(pure.__file__).with_name("statics-certificate-4.schema.json")


@pytest.mark.parametrize("name", [pytest.param(x, marks=[pytest.mark.slow] * (x in SLOW)) for x in ROWS])
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, line = ROWS[name]
    verdict = both(canonical_bytes(sealed(content)))
    assert str(verdict.status) == status, verdict.lines
    assert verdict.lines[-1].startswith(line), verdict.lines


@pytest.mark.parametrize("name", HONEST)
def test_the_schema_knows_them(name: str) -> None:
    jsonschema.Draft202012Validator(json.loads(SCHEMA.read_text())).validate(sealed(HONEST[name]))

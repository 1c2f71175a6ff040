"""Shorter ways than the obvious one: a last step modulo a prime, and legs' equations of which one is subtracted."""

from __future__ import annotations

import pytest
from certificate_tools import both
from forged_last_steps import LAST_STEPS, LENGTHS

from pkm_exact.certify.build import canonical_bytes, sealed


@pytest.mark.parametrize("name", LAST_STEPS)
def test_a_last_step(name: str) -> None:
    make, status = LAST_STEPS[name]
    verdict = both(canonical_bytes(sealed(make())))
    assert verdict.status == status, verdict


@pytest.mark.parametrize("name", LENGTHS)
def test_longer_legs(name: str) -> None:
    make, status = LENGTHS[name]
    verdict = both(canonical_bytes(sealed(make())))
    assert verdict.status == status, verdict

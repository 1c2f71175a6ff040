"""Golden certificates: every shipped robot has one, the checker accepts it, and the same bytes come out again."""

from pathlib import Path

import pytest

from pkm_exact.geometry.reader import read_robot
from pkm_exact.recomputation import Outcome, recompute

ROOT = Path(__file__).parent.parent
MODELS = sorted(path.stem for path in (ROOT / "models").glob("*.toml"))
SLOW = ("hexaglide", "ssm-rounded")  # an elimination with long numbers
NAMES = [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in MODELS]


@pytest.mark.parametrize("name", NAMES)
def test_certificate_is_regenerated_byte_by_byte(name: str) -> None:
    data = (ROOT / "certs" / f"{name}.json").read_bytes()
    found = recompute(data, robot=read_robot(ROOT / "models" / f"{name}.toml"))
    assert (found.outcome, found.data) == (Outcome.SAME, data), found


def test_there_is_no_certificate_without_a_model() -> None:
    assert sorted(path.stem for path in (ROOT / "certs").glob("*.json")) == MODELS


def test_certificates_stay_small() -> None:
    assert sum(path.stat().st_size for path in (ROOT / "certs").iterdir()) < 10_000_000

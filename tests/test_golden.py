"""Golden certificates: there is one for every shipped robot, the same bytes come out again, and the checker accepts."""

from pathlib import Path

import pytest

from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import check_bytes
from pkm_exact.engine import solve
from pkm_exact.geometry.reader import read_robot

ROOT = Path(__file__).parent.parent
MODELS = sorted(path.stem for path in (ROOT / "models").glob("*.toml"))


@pytest.mark.parametrize("name", MODELS)
def test_certificate_is_regenerated_byte_by_byte(name: str) -> None:
    robot = read_robot(ROOT / "models" / f"{name}.toml")
    configuration = robot.configuration(None)
    solution = solve(robot.problem(configuration))
    found = canonical_bytes(certificate(robot, configuration.name, solution))
    assert found == (ROOT / "certs" / f"{name}.json").read_bytes()
    assert check_bytes(found).status == "accepted"


def test_there_is_no_certificate_without_a_model() -> None:
    assert sorted(path.stem for path in (ROOT / "certs").glob("*.json")) == MODELS


def test_certificates_stay_small() -> None:
    assert sum(path.stat().st_size for path in (ROOT / "certs").iterdir()) < 10_000_000

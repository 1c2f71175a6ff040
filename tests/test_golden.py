"""Every shipped robot: its golden certificate comes out again byte by byte, and has the published number of poses."""

from typing import Any

import pytest
from certificate_tools import CERTS, golden_bytes
from samples import MODELS, model, solved

from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import Status, check_bytes
from pkm_exact.claim import Claim

SLOW = ("hexaglide", "linuxcnc-hexapod", "ssm-exact", "ssm-rounded", "tssm")  # an elimination with long numbers
NAMES = [path.stem for path in MODELS]


def _marked(names: list[str]) -> list[Any]:
    return [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in names]


@pytest.mark.parametrize("name", _marked(NAMES))
def test_certificate_is_regenerated_byte_by_byte(name: str) -> None:
    robot = model(name)
    made = canonical_bytes(certificate(robot, robot.configuration().name, solved(name)))
    assert made == golden_bytes(name)
    assert check_bytes(made).status is Status.ACCEPTED


def test_there_is_no_certificate_without_a_model() -> None:
    assert sorted(path.stem for path in CERTS.glob("*.json")) == NAMES


def test_certificates_stay_small() -> None:
    assert sum(path.stat().st_size for path in CERTS.iterdir()) < 10_000_000


# Counts

COUNTS = {
    "mssm": (16, 16),
    "tssm": (16, 16),
    "ssm-exact": (28, 16),
    "6-6pp": (40, 16),
    "6-6p": (40, 16),
    "rolland-6-6": (40, 16),
    "dietmaier": (40, 40),
    "hexa": (40, 8),
    "hexaglide": (36, 8),
    "linapod-n": (40, 2),
    "linuxcnc-hexapod": (16, 8),
    "robocrane-r": (16, 4),
    "similar-planar-s": (16, 8),
}


def _is_complete(name: str, complex_solutions: int, real_poses: int) -> None:
    solution = solved(name)
    assert solution.claim is Claim.COMPLETE
    assert solution.complex_solutions == solution.distinct_solutions == complex_solutions
    assert len(solution.poses) == real_poses


@pytest.mark.parametrize("name", _marked([*COUNTS]))
def test_all_poses_are_found_and_proved_to_be_all(name: str) -> None:
    _is_complete(name, *COUNTS[name])


@pytest.mark.slow
def test_rounding_the_hexagons_adds_eight_complex_poses() -> None:
    _is_complete("ssm-rounded", 36, 16)

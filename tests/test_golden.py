"""Every shipped robot: its golden certificate comes out again byte by byte, and has the published number of poses."""

from pathlib import Path

import pytest
from certificate_tools import CERTS, FIRST
from samples import MODELS, model, solved

from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.certify.check import Status, check_bytes
from pkm_exact.claim import Claim

NAMES = [path.stem for path in MODELS]


@pytest.mark.parametrize("name", NAMES)
def test_certificate_is_regenerated_byte_by_byte(name: str) -> None:
    robot = model(name)
    made = canonical_bytes(certificate(robot, robot.configuration().name, solved(name)))
    assert made == (CERTS / f"{name}.json").read_bytes()
    assert check_bytes(made).status is Status.ACCEPTED


LONG = ("hexaglide", "ssm-rounded")
"""Of version 1: numbers of thousands of digits keep the plain checker busy for seconds."""
OLD = [
    pytest.param(path, id=path.stem, marks=[pytest.mark.slow] * (path.stem in LONG))
    for path in sorted(FIRST.glob("*.json"))
]


@pytest.mark.parametrize("path", OLD)
def test_certificates_of_version_1_are_accepted_for_ever(path: Path) -> None:
    verdict = check_bytes(path.read_bytes())
    assert verdict.status is Status.ACCEPTED
    assert verdict.lines[-1].startswith("complete")


def test_there_is_no_certificate_without_a_model() -> None:
    assert sorted(path.stem for path in CERTS.glob("*.json")) == sorted(NAMES)


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


@pytest.mark.parametrize("name", COUNTS)
def test_all_poses_are_found_and_proved_to_be_all(name: str) -> None:
    _is_complete(name, *COUNTS[name])


def test_rounding_the_hexagons_adds_eight_complex_poses() -> None:
    _is_complete("ssm-rounded", 36, 16)

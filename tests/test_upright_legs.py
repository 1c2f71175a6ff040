"""Planar robots whose joints lie off the plane: three upright legs have complex curves of poses, and one real pose."""

from typing import Any

import pytest

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.certify.check import check_bytes
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.rational import parse_vector


def _joint(*values: int) -> Vector:
    return parse_vector(list(values), "joint")


def certificate(height: int, *, real: bool) -> bytes:
    """Three equal legs of length 1, by ``height`` out of the plane; the witness is the platform where it was made."""
    corners = ((0, 0), (1, 0), (0, 1))
    legs = [
        Distance(_joint(x, y, 0), _joint(x + 1 - height, y, height), pure.Fraction(1), f"{x}{y}") for x, y in corners
    ]
    content: dict[str, Any] = {
        "format": "pkm_exact certificate",
        "version": 2,
        "robot": {
            "name": "three equal legs",
            "unit": "m",
            "source": "forged",
            "motion": "planar",
            "metric": ["1", "1", "1"],
            "constraints": [constraint_entry(leg, (1, 1, 1)) for leg in legs],
        },
        "configuration": None,
        "formulation": "SE3",
        "method": "exact",
        "claim": "positive-dimensional-proved",
        "completeness_route": None,
        "complex_solutions": 0,
        "distinct_solutions": 0,
        "real_poses": 0,
        "representation": {
            "chart": [1, 0, 0, 0],
            "separating_form": [0] * 8,
            "eliminant": ["0x0", "0x1"],
            "quaternion": [["0x1"], [], [], []],
            "translation": [[], [], [], []],
        },
        "infinity": None,
        "elimination": None,
        "self_motion": {"cause": "equal-legs", "real": real, "forms": [], "slices": []},
        "krawczyk": None,
        "box_exponent": 0,
        "poses": [],
        "notes": [],
    }
    return canonical_bytes(sealed(content))


@pytest.mark.parametrize("check", [check_bytes, pure.check_bytes])
@pytest.mark.parametrize(("height", "moves"), [(0, True), (1, False)])
def test_legs_that_stand_upright_hold_the_platform(check: Any, height: int, moves: bool) -> None:
    assert str(check(certificate(height, real=moves)).status) == "accepted"
    assert str(check(certificate(height, real=not moves)).status) == "rejected"

"""Errors of a pose to first order, against what is proved for every robot within tolerance."""

from fractions import Fraction

import numpy as np
import pytest
from samples import boxed, model, shipped
from test_statics import at

from pkm_exact.errors import InputError
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.deviations import MARGIN
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric.tolerance_result import ToleranceBox
from pkm_exact.statics.first_order_errors import beside_box, first_order_errors
from pkm_exact.statics.geometric_errors import geometric_jacobian
from pkm_exact.statics.machine_at_pose import machine_at

UNEQUAL = Tolerances(Fraction(1), Fraction(2), Fraction(5))
"""Of base, platform and lengths: a mistake in one of them is no other's."""


def boxes(name: str, scale: Fraction) -> tuple[ToleranceBox, ...]:
    return tolerance_boxes(shipped(name), UNEQUAL.scaled(scale), boxed(name)).boxes


def gaps(name: str, scale: Fraction) -> list[tuple[float, float]]:
    """Relative: from what some robot attains up to first order, and from there to the guaranteed bound."""
    found = []
    tolerances = UNEQUAL.scaled(scale)
    for pose, box in list(zip(boxed(name).poses, boxes(name, scale), strict=True))[:2]:
        beside = beside_box(machine_at(model(name), pose), tolerances, box)
        assert set(beside) == {"displacement", "turn"}
        for one in beside.values():
            first = float(one.first_order)
            found.append((1 - float(one.certified.lo) / first, float(one.certified.hi) / first - 1))
    return found


@pytest.mark.parametrize("name", ["3-rrr", "rolland-6-6"])
def test_first_order_is_the_limit_of_certified_boxes(name: str) -> None:
    """What the box proves differs from first order by a part that falls as the tolerances do, and by its margin."""
    wide, narrow = (gaps(name, Fraction(1, 10**6 * factor)) for factor in (1, 16))
    for before, after in zip(wide, narrow, strict=True):
        assert 0 < before[0] < 0.01
        assert 0 < before[1] < 0.01
        assert 15 * after[0] < before[0] < 17 * after[0]
        assert after[1] - (MARGIN - 1) < (before[1] - (MARGIN - 1)) / 15 + 1e-8  # radii have 30 bits


def test_what_cannot_be_compared_is_refused() -> None:
    first, second = (machine_at(model("3-rrr"), pose) for pose in boxed("3-rrr").poses[:2])
    tolerances = UNEQUAL.scaled(Fraction(1, 10**6))
    box = boxes("3-rrr", Fraction(1, 10**6))[0]
    assert beside_box(first, tolerances, box)
    with pytest.raises(InputError, match="that of another pose, 1"):
        beside_box(second, tolerances, box)
    with pytest.raises(InputError, match="no box is proved for pose 7"):
        beside_box(first, tolerances, ToleranceBox(7, Fraction(0), None, None, None))
    with pytest.raises(InputError, match="spatial and planar motions"):
        first_order_errors(machine_at(model("delta"), boxed("delta").poses[0]), tolerances)


def test_the_geometric_jacobian_of_a_planar_machine_is_the_derivative_of_its_legs() -> None:
    found, robot = at("3-rpr-merlet-p"), model("3-rpr-merlet-p")
    table, rows = geometric_jacobian(found), found.wrenches.to_numpy()
    position = np.array([float(x) for x in found.position])[:2]
    rotation = np.array([[float(x) for x in row] for row in found.rotation])[:2, :2]
    base, platform = (
        np.array([[float(x) for x in joint] for joint in joints])[:, :2]
        for joints in (robot.base_joints, robot.platform_joints)
    )
    assert table.to_numpy().shape == (3, 15)

    def legs(moved_base: np.ndarray, moved_platform: np.ndarray) -> np.ndarray:
        return np.asarray(np.linalg.norm(position + moved_platform @ rotation.T - moved_base, axis=1))

    for leg, axis in ((0, 0), (1, 1), (2, 0)):
        moved = np.zeros((3, 2))
        moved[leg, axis] = 1e-7
        for side, ends in (("base", (base + moved, platform)), ("platform", (base, platform + moved))):
            column = table.to_numpy()[:, table.columns.index(f"{side}.{'xy'[axis]}(leg {leg + 1})")]
            assert rows @ column == pytest.approx((legs(base, platform) - legs(*ends)) / 1e-7, abs=1e-5)

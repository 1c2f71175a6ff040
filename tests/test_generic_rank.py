"""Identities for every pose, freedoms at poses, and redundant actuation."""

import json
from fractions import Fraction
from pathlib import Path

import pytest
from flint import fmpz_mat

from pkm_exact import Distance, Screw, ScrewSystem, platform_mobility
from pkm_exact.cli.main import main
from pkm_exact.constraints.form import Form, integral
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.geometry.reader import read_robot
from pkm_exact.mobility import generic_rank as module
from pkm_exact.mobility.actuation import actuation
from pkm_exact.mobility.constraint_rows import within, wrench_rows
from pkm_exact.mobility.finite_mobility import finite
from pkm_exact.mobility.generic_rank import Route, generic_rank
from pkm_exact.mobility.instantaneous_mobility import instantaneous
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.screws.exact_matrix import rank

ROOT = Path(__file__).parent.parent
ZERO, ONE, HALF = Fraction(0), Fraction(1), Fraction(1, 2)
HEXAGON = [(ONE, ZERO), (HALF, HALF), (-HALF, HALF), (-ONE, ZERO), (-HALF, -HALF), (HALF, -HALF)]
"""Regular, in the metric (1, 3, 1)."""


def _forms(base: int, platform: int, turned: int = 0) -> list[Form]:
    """Six legs between regular hexagons; joint i of the base and joint i + turned of the platform."""
    legs = [
        Distance((base * x, base * y, ZERO), (platform * u, platform * v, ZERO), ONE)
        for (x, y), (u, v) in zip(HEXAGON, HEXAGON[turned:] + HEXAGON[:turned], strict=True)
    ]
    return [form for leg in legs for form in leg.forms((1, 3, 1))]


def test_the_hypothetical_robot_of_chapter_18_has_rank_5_at_every_pose() -> None:
    """Aligned hexagons of 100 and 50 mm: the wrenches with alternating signs sum up to 0 at every pose."""
    found = generic_rank(_forms(100, 50), SPATIAL, (1, 3, 1))
    assert (found.rank, found.most, found.route) == (5, 6, Route.COMBINATION)
    assert found.is_architecture_singularity
    assert [value / found.combination[1] for value in found.combination] == [-1, 1, -1, 1, -1, 1]


def test_hexagons_turned_by_a_side_are_no_architecture_singularity() -> None:
    found = generic_rank(_forms(100, 50, 1), SPATIAL, (1, 3, 1))
    assert (found.route, found.is_architecture_singularity) in ((Route.FULL, False), (Route.COMBINATION, True))
    quarter = [(x, y, ZERO) for x, y in HEXAGON]
    skew = [
        Distance(a, (b[1], b[0], Fraction(k * k)), ONE) for k, (a, b) in enumerate(zip(quarter, HEXAGON, strict=True))
    ]
    forms = [form for leg in skew for form in leg.forms((1, 3, 1))]
    assert generic_rank(forms, SPATIAL, (1, 3, 1)).route is Route.FULL


@pytest.mark.slow
def test_the_identity_of_polynomials_says_the_same() -> None:
    matrix = fmpz_mat(6, 17, [value for form in _forms(100, 50) for value in integral(form)])
    found = module._by_grid(matrix, (3, -2, 5, 7, -11, 13), SPATIAL, (1, 3, 1), 5, 6)
    assert (found.rank, found.route) == (5, Route.GRID)


def test_a_planar_identity_by_its_grid() -> None:
    """Equal triangles are singular in the same attitude only; with three joints in one point every pose is singular."""
    corners = [(ZERO, ZERO, ZERO), (ONE, ZERO, ZERO), (ZERO, ONE, ZERO)]
    forms = [form for c in corners for form in Distance(c, c, ONE).forms((1, 1, 1))]
    assert generic_rank(forms, PLANAR, (1, 1, 1)).route is Route.FULL
    merged = [form for c in corners for form in Distance(corners[0], c, ONE).forms((1, 1, 1))]
    assert (generic_rank(merged, PLANAR, (1, 1, 1)).rank, generic_rank(merged, PLANAR, (1, 1, 1)).route) == (
        2,
        Route.GRID,
    )
    point = [form for c in corners for form in Distance(c, corners[0], ONE).forms((1, 1, 1))]
    found = generic_rank(point, PLANAR, (1, 1, 1))
    assert (found.rank, found.is_architecture_singularity) == (2, True)
    matrix = fmpz_mat(3, 17, [value for form in point for value in integral(form)])
    again = module._by_grid(matrix, found.pose, PLANAR, (1, 1, 1), 2, 3)
    assert (again.rank, again.route) == (2, Route.GRID)


@pytest.mark.parametrize("metric", [(1, 1, 1), (1, 3, 1), (2, 3, 5)])
def test_the_rank_on_the_grid_is_that_of_the_wrenches(metric: tuple[int, int, int]) -> None:
    legs = [
        Distance((Fraction(k), Fraction(k * k), Fraction(3 - k)), (Fraction(1 - k), Fraction(2), Fraction(k * k)), ONE)
        for k in range(5)
    ]
    matrix = fmpz_mat(5, 17, [v for leg in legs for form in leg.forms(metric) for v in integral(form)])
    for pose in ((0, 0, 0, 0, 0, 0), (1, 0, 0, 0, 0, 0), (1, 2, 3, -1, 4, 2), (0, 0, 1, 0, 3, 0)):
        turn = rotation_of((ONE, *map(Fraction, pose[:3])), metric)
        place = tuple(map(Fraction, pose[3:]))
        rows = [row for leg in legs for row in wrench_rows(leg, metric, place, turn)]  # type: ignore[arg-type]
        assert module._rank_at(matrix, pose, SPATIAL, metric) == rank(within(rows, SPATIAL), 6)


# At a pose


def _level(*position: object) -> tuple[object, object]:
    return tuple(map(Fraction, position)), rotation_of((ONE, ZERO, ZERO, ZERO))  # type: ignore[arg-type]


def test_legs_that_meet_let_the_platform_turn() -> None:
    """A platform on four legs that are left of six, with lines through two points: it turns about the line of these."""
    robot = read_robot(ROOT / "models" / "mssm.toml")
    found = platform_mobility(robot, _level(1, 2, 30))  # type: ignore[arg-type]
    assert found.at is not None
    assert (found.at.free.number, found.at.locked.number) == (6, 0)
    pairs: dict[object, list[str]] = {}
    for name, joint in zip(robot.actuated, robot.platform_joints, strict=True):
        pairs.setdefault(joint, []).append(name)
    (corner, legs), (other, more), *_ = ((joint, names) for joint, names in pairs.items() if len(names) == 2)
    left = platform_mobility(robot, _level(1, 2, 30), [*legs, *more])  # type: ignore[arg-type]
    assert left.at is not None
    place = [tuple(c + x for c, x in zip((1, 2, 30), joint, strict=True)) for joint in (corner, other)]  # type: ignore[call-overload]
    axis = Screw.line(place[0], [b - a for a, b in zip(*place, strict=True)])
    screws = [Screw.couple(v) for v in left.at.locked.translations] + list(left.at.locked.turns)
    assert left.at.locked.number == 2
    assert axis in ScrewSystem.span(screws)


def test_a_failed_leg_leaves_one_freedom(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["mobility", str(ROOT / "models" / "rolland-6-6.toml"), "--at", "0,0,650,9,1,0,-1", "--json"]
    assert main([*words, "--actuated", "leg 1,leg 2,leg 3,leg 4,leg 5"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["pose"]["rank"] == 5
    assert answer["pose"]["locked"]["number"] == 1
    assert "screw motion of pitch" in answer["pose"]["locked"]["words"]
    assert answer["everywhere"]["rank"] == 5


def test_freedoms_in_a_metric_have_their_axes_in_the_coordinates_of_the_file() -> None:
    """The 3-RPS robot at its level pose: two tilts and a lift, its actuators free."""
    robot = read_robot(ROOT / "models" / "3-rps.toml")
    for height in ("1/2", "3/5", "2/3", "1"):
        found = platform_mobility(
            robot, ((ZERO, ZERO, Fraction(height)), rotation_of((ONE, ZERO, ZERO, ZERO), robot.metric))
        )
        assert found.at is not None
        assert str(found.at.free).startswith(
            "1 translation along (0, 0, 1), 2 rotations about axes perpendicular to (0, 0, 1)"
        )
        assert found.at.free.centre == (ZERO, ZERO, Fraction(height))
        assert (found.at.structural_rank, found.at.rank) == (3, 6)


# Redundant actuation: chapter 5.


def _planar_robot() -> Linkage:
    """RP/2RPR: three legs of hinge and slide that meet in the joint of the end-effector."""
    z, zero = (ZERO, ZERO, ONE), (ZERO, ZERO, ZERO)
    feet = [(ZERO, ZERO, ZERO), (ONE, ZERO, ZERO), (HALF, ONE, ZERO)]
    tip = (Fraction(2, 5), Fraction(1, 3), ZERO)
    joints, bodies = [], ["base", "effector"]
    for k, foot in enumerate(feet):
        end = "effector" if k == 0 else f"rod {k}"
        bodies += [f"leg {k}"] + ([] if k == 0 else [end])
        axis = tuple(a - b for a, b in zip(tip, foot, strict=True))
        joints.append(Joint(f"R{k}", "R", ("base", f"leg {k}"), JointGeometry(foot, (z,))))
        joints.append(Joint(f"P{k}", "P", (f"leg {k}", end), JointGeometry(zero, (axis,)), (1,)))  # type: ignore[arg-type]
        if k:
            joints.append(Joint(f"J{k}", "R", (end, "effector"), JointGeometry(tip, (z,))))
    return Linkage("RP/2RPR", "1", "chapter 5", tuple(bodies), tuple(joints), "base", "effector")


def test_a_redundantly_actuated_robot() -> None:
    robot = _planar_robot()
    found = instantaneous(robot)
    assert (found.total, found.platform.rank) == (2, 2)
    done = actuation(found, robot.actuated)
    assert (done.degree, done.redundancy, done.left) == (2, 1, 0)
    assert actuation(found, ["P0", "P1"]).left == 0
    assert finite(found).is_known

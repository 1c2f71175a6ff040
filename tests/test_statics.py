"""Wrenches, Jacobians and singularities at a pose, exact and enclosed."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from samples import model, solved

from pkm_exact import Mechanism, Robot
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.mechanism import LockedValues
from pkm_exact.geometry.mechanism import Mechanism as PlainMechanism
from pkm_exact.motions.motion_groups import PLANAR, SCHOENFLIES
from pkm_exact.radicals import RootSum
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.machine_at_pose import machine_at, machine_at_solution

Capture = pytest.CaptureFixture[str]
POSES: dict[str, dict[str, object]] = {
    "rolland-6-6": {"position": [10, 20, 650], "quaternion": [9, 1, 0, -1]},
    "robocrane-r": {"position": ["1/10", "1/20", "1/5"], "quaternion": [10, 1, 1, 2]},
    "3-rpr-merlet-p": {"position": [5, "9/2"], "half_tangent": "1/3"},
}


def vector(*values: object) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = (Fraction(str(value)) for value in values)
    return x, y, z


def at(name: str) -> AtPose:
    return machine_at(model(name), POSES[name])


def lengths(name: str, position: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """Leg lengths in ordinary coordinates, in floating point."""
    robot = model(name)
    axes = np.sqrt(np.array(robot.metric, dtype=float))
    base, platform = (
        np.array([[float(x) for x in joint] for joint in joints]) * axes
        for joints in (robot.base_joints, robot.platform_joints)
    )
    return np.linalg.norm(position + platform @ rotation.T - base, axis=1)


def turned(w: np.ndarray) -> np.ndarray:
    """Nearly the rotation by a small vector."""
    x, y, z = w
    return np.eye(3) + np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


@pytest.mark.parametrize("name", POSES)
def test_the_jacobian_is_the_derivative_of_the_lengths(name: str) -> None:
    found = at(name)
    robot = model(name)
    axes = np.sqrt(np.array(robot.metric, dtype=float))
    position = np.array([float(x) for x in found.position]) * axes
    rotation = np.array([[float(x) for x in row] for row in found.rotation]) * axes[:, None] / axes
    assert found.jacobian is not None
    jacobian, step = found.jacobian.to_numpy(), 1e-6
    for column, place in enumerate(robot.motion.twist):
        twist = np.eye(6)[place] * step
        ends = [lengths(name, position + sign * twist[:3], turned(sign * twist[3:]) @ rotation) for sign in (1, -1)]
        assert jacobian[:, column] == pytest.approx((ends[0] - ends[1]) / (2 * step), rel=1e-6, abs=1e-6)
    assert found.rank == robot.motion.dimension
    assert found.singular == ()


@pytest.mark.parametrize("name", ["3-rrr", "3-rpr-merlet-p"])
def test_a_pose_of_a_solution_and_exact_rows_nearby_agree(name: str) -> None:
    robot, pose = model(name), solved(name).poses[0]
    enclosed = machine_at(robot, pose)
    x, y, _ = pose.position
    half = pose.quaternion[3].midpoint / pose.quaternion[0].midpoint
    near = {"position": [x.midpoint, y.midpoint], "half_tangent": half}
    modes = [None] if not robot.chains else [f"{a}{b}{c}" for a in "+-" for b in "+-" for c in "+-"]
    assert enclosed.jacobian is not None
    wanted = enclosed.jacobian.to_numpy()
    found = [machine_at(robot, near, modes=mode).jacobian for mode in modes]
    assert any(jacobian is not None and np.allclose(jacobian, wanted, atol=1e-6) for jacobian in found)


def test_slides_and_cranks_at_an_exact_pose_need_a_working_mode() -> None:
    pose = {"position": [0, 0, 0], "quaternion": [1, 0, 0, 0]}
    with pytest.raises(InputError, match="give a sign for each slide or crank"):
        machine_at(model("linapod-n"), pose)
    up, down = (machine_at(model("linapod-n"), pose, modes=sign * 6) for sign in "+-")
    assert up.jacobian is not None
    assert down.jacobian is not None
    assert np.allclose(up.jacobian.to_numpy()[:, 2], 1)  # the slides stand above, and rise with the platform
    assert np.allclose(up.jacobian.to_numpy()[:, :2], -down.jacobian.to_numpy()[:, :2])


def test_a_delta_at_irrational_crank_angles_has_the_speeds_that_differences_give() -> None:
    base, arm, rod, step = 1.74, 1.73, 2.66, 1e-6

    def angle(z: float, side: int) -> float:
        """Of a crank, downwards from outwards, where the platform is on the axis: triangle of crank, rod and joints."""
        distance, inclination = np.hypot(base, z), np.arctan2(-z, -base)
        return float(inclination + side * np.arccos((distance**2 + arm**2 - rod**2) / (2 * arm * distance)))

    found = [machine_at(model("delta"), {"position": [0, 0, -2]}, modes=sign * 3) for sign in "+-"]
    assert all(at.is_exact for at in found)
    columns = [at.jacobian.to_numpy()[:, 2] for at in found if at.jacobian is not None]
    speeds = [(angle(-2 + step, side) - angle(-2 - step, side)) / (2 * step) for side in (-1, 1)]
    assert sorted(column[0] for column in columns) == pytest.approx(sorted(speeds), rel=1e-6)
    assert [column[1:] for column in columns] == [pytest.approx([column[0]] * 2) for column in columns]


def h4() -> Mechanism:
    """H4 with its slides along z, at home."""
    bases, sides = [(-48, -42), (-48, 42), (6, 42), (48, 0)], (-6, -6, 6, 6)
    squares = (5292, 5292, 3528, 3528)
    legs = tuple(
        Distance(vector(*base, 0), vector(side, 0, 0), Fraction(square), f"rod {k}")
        for k, (base, side, square) in enumerate(zip(bases, sides, squares, strict=True), 1)
    )
    drives = tuple(Drive(f"slide {k}", (Part(f"rod {k}", "base", (vector(0, 0, 1),)),)) for k in range(1, 5))
    names = tuple(drive.name for drive in drives)
    return Mechanism("H4", "mm", "chapter 19", legs, names, motion=SCHOENFLIES, drives=drives)


def test_h4_has_the_printed_jacobian_with_the_sign_corrected() -> None:
    found = h4().at({"position": [0, 0, -42], "quaternion": [1, 0, 0, 0]}, modes="++++")
    assert found.jacobian is not None
    inverse = [[-1, -1, 1, 6], [-1, 1, 1, -6], [0, 1, 1, 6], [1, 0, 1, 0]]
    assert found.jacobian.entries == tuple(tuple(map(_exactly, row)) for row in inverse)
    assert np.linalg.det(found.jacobian.to_numpy()) == pytest.approx(48)
    rates = np.linalg.solve(found.jacobian.to_numpy(), [1, -1, 1, 1])
    assert rates == pytest.approx([0.5, -0.25, 0.5, 0.125])  # printed: -0.125


def _exactly(value: int) -> object:
    from pkm_exact.poses.pose import Interval

    return Interval(Fraction(value), Fraction(value))


def dual_v() -> Mechanism:
    """DUAL V with rational dimensions: cranks of length 5, their ends carried about the base revolutes."""
    joints = [("2", 1, 1), ("2", 1, -1), ("-2", -1, -1), ("-2", -1, 1)]
    legs, drives = [], []
    for k, (end, x, y) in enumerate(joints, 1):
        legs.append(Distance(vector(9 * x, y, 0), vector(end, 0, 0), Fraction(25), f"leg {k}"))
        circle = vector(5, 0, 0), vector(0, 5, 0)
        drives.append(Drive(f"crank {k}", (Part(f"leg {k}", "base", circle),), weight=1))
    names = tuple(drive.name for drive in drives)
    home = LockedValues("home", tuple((Fraction(-4 * x, 5), Fraction(3 * y, 5)) for _, x, y in joints))
    return Mechanism(
        "DUAL V", "1", "invented", tuple(legs), names, PLANAR, configurations=(home,), drives=tuple(drives)
    )


def test_dual_v_is_exact() -> None:
    found = dual_v().at({"position": [0, 0], "half_tangent": 0}, configuration="home")
    assert found.jacobian is not None
    wanted = [[-3, -4, -8], [3, -4, -8], [3, 4, -8], [-3, 4, -8]]
    assert np.allclose(found.jacobian.to_numpy(), np.array(wanted) / 25, atol=1e-15)
    assert all(Fraction(n, 25) in found.jacobian[i, j] for i, row in enumerate(wanted) for j, n in enumerate(row))
    assert found.singular == ()


def mechanism(*constraints: object, **more: object) -> PlainMechanism:
    return PlainMechanism("made up", "1", "made up for a test", constraints, **more)  # type: ignore[arg-type]


def test_singularities_are_told_apart() -> None:
    pose = {"position": [0, 0], "half_tangent": 0}
    legs = ("leg 1", "leg 2", "leg 3")
    bases = [(1, 0), (0, 1), ("3/5", "4/5")]
    through = [Distance(vector(*base, 0), vector(0, 0, 0), Fraction(1), legs[k]) for k, base in enumerate(bases)]
    found = machine_at(mechanism(*through, motion=PLANAR, actuated=legs), pose)
    assert found.singular == ("type-2",)  # one platform joint: so it is everywhere, but the forms do not show it
    assert found.kinds.undecided == ("architecture",)
    assert found.singularities[0].constraints == legs
    ends = [((2, 0), (1, 0)), ((0, 2), (0, 1)), ((-2, 0), (-1, 0))]
    apart = [Distance(vector(*base, 0), vector(*end, 0), Fraction(1), legs[k]) for k, (base, end) in enumerate(ends)]
    found = machine_at(mechanism(*apart, motion=PLANAR, actuated=legs), pose)
    assert found.singular == ("type-2",)
    assert found.singularities[0].constraints == ("leg 1", "leg 3")  # on one line; leg 2 is not to blame
    turning = Drive("crank", (Part("leg 2", "base", (vector(1, 0, 0), vector(0, 1, 0))),), weight=1)
    legs_at = [apart[0], replace(apart[1], base=vector(0, 3, 0)), apart[2]]
    straight = mechanism(*legs_at, motion=PLANAR, actuated=("crank",), drives=(turning,))
    found = machine_at(straight, pose)
    assert "type-1" in found.singular
    assert found.singularities[0].constraints == ("crank",)
    assert found.jacobian is None


def test_similar_hexagons_on_a_circle_are_an_architecture_singularity() -> None:
    points = [("1", "0"), ("3/5", "4/5"), ("-3/5", "4/5"), ("-1", "0"), ("-5/13", "-12/13"), ("8/17", "-15/17")]
    base = tuple(vector(x, y, 0) for x, y in points)
    platform = tuple((x / 2, y / 2, z) for x, y, z in base)
    robot = Robot("similar", "6-UPS", "1", "made up for a test", base, platform)
    found = robot.at({"position": ["1/3", "1/5", 2], "quaternion": [7, 1, 2, 3]})
    assert found.singular == ("architecture", "type-2")
    assert found.rank == 5
    assert len(found.singularities[0].constraints) == 6


def test_a_hinge_that_fails_is_a_constraint_singularity() -> None:
    """Two planes that are one at this pose, and not elsewhere."""
    planes = [InPlane(vector(0, 0, 1), Fraction(0), vector(x, 0, 0), f"plane {x}") for x in (0, 1)]
    carried = Carries(vector(0, 0, 1), Fraction(0), vector(0, 0, 0), "carried")
    found = machine_at(mechanism(*planes, carried), {"position": [0, 0, 0], "quaternion": [1, 0, 0, 0]})
    assert found.singular == ("constraint",)
    assert found.singularities[0].constraints == ("plane 0", "carried")


def test_constraints_that_do_not_hold_are_named() -> None:
    hinge = InPlane(vector(0, 1, 0), Fraction(0), vector(1, 0, 0), "hinge")
    with pytest.raises(InputError, match="the constraint 'hinge' does not hold there"):
        machine_at(mechanism(hinge), {"position": [0, 1, 0], "quaternion": [1, 0, 0, 0]})


def test_square_roots_cancel_only_where_they_do() -> None:
    two, three = RootSum.root(Fraction(2)), RootSum.root(Fraction(3))
    assert ((two + three) * (two - three)).rational == -1
    assert (two * three - RootSum.root(Fraction(6))).sign() == 0
    near = RootSum.of(Fraction(99, 70)) - two  # a convergent: the difference is 7e-5
    assert near.sign() == 1
    big = Fraction(10**40 + 1)
    assert (RootSum.root(big) - 10**20).sign() == 1
    assert ((two + 1).inverse() * (two + 1)).rational == 1


def test_the_command_and_its_json(tmp_path: Path, capsys: Capture) -> None:
    words = ["statics", "certs/3-rpr-merlet-p.json", "--pose", "1", "--format", "json"]
    assert main(words) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["given"] == ["J_x", "J_q", "J"]
    assert found["twist"] == ["vx", "vy", "wz"]
    assert found["singular"] == []
    robot = model("3-rpr-merlet-p")
    enclosed = machine_at(robot, solved("3-rpr-merlet-p").poses[0])
    assert enclosed.jacobian is not None
    assert found["jacobian"] == enclosed.jacobian.as_object()
    assert main(["statics", "models/3-rpr-merlet-p.toml"]) == 2
    assert "there are 2 poses" in capsys.readouterr().err
    forged = json.loads(Path("certs/3-rpr-merlet-p.json").read_text())
    forged["real_poses"] = 3
    (tmp_path / "forged.json").write_text(json.dumps(forged))
    assert main(["statics", str(tmp_path / "forged.json"), "--pose", "1"]) in (1, 2)
    assert "certificate is" in capsys.readouterr().err


def test_a_singular_pose_of_a_solution_is_of_type_2() -> None:
    robot = Robot.load("models/3-rpr-double-q.toml")
    singular = [robot.at(pose).singular for pose in solved("3-rpr-double-q").poses]
    assert ("type-2",) in singular


def test_a_pose_of_other_lengths_is_refused() -> None:
    """Its lengths are not those of the configuration, and J would be wrong."""
    robot = model("3-rpr-merlet-p")
    other = robot.problem_at([Fraction(x) for x in ("7.1", "5.1", "5")])
    pose = solve(other).poses[0]
    with pytest.raises(InputError, match="leg 1 does not hold there, it is a pose of other joint values"):
        machine_at(robot, pose)
    assert machine_at_solution(robot, other, pose).rank == 3

"""Calibration of any machine: changes that nothing can show are in the null space, others are as derivatives say."""

import json
from fractions import Fraction
from pathlib import Path

import pytest
from samples import model

from pkm_exact.cli.main import main
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.at_point import AtPoint
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.on_line import OnLine
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.working_modes import platform_point
from pkm_exact.identification.calibration import observation
from pkm_exact.identification.constraint_calibration import Pose, geometric_parameters, geometric_rows
from pkm_exact.identification.measurement_plan import plan_from_csv
from pkm_exact.identification.observation import identify
from pkm_exact.screws.exact_matrix import Row

Capture = pytest.CaptureFixture[str]


def _vector(*numbers: object) -> Vector:
    x, y, z = (Fraction(str(number)) for number in numbers)
    return x, y, z


ZERO = _vector(0, 0, 0)
POSE: Pose = _vector(1, -2, 3), rotation_of((Fraction(2), Fraction(1), Fraction(-1), Fraction(3)))
JOINT, AXIS = _vector(3, 1, -2), _vector(2, -1, 2)
PLACE = platform_point(JOINT, *POSE)
TURNED = platform_point(AXIS, ZERO, POSE[1])


def _plus(a: Vector, b: Vector) -> Vector:
    x, y, z = (p + q for p, q in zip(a, b, strict=True))
    return x, y, z


def _dot(a: Vector, b: Vector) -> Fraction:
    return sum((p * q for p, q in zip(a, b, strict=True)), Fraction(0))


def _unturned(vector: Vector) -> Vector:
    """In the platform's frame."""
    columns = zip(*POSE[1], strict=True)
    x, y, z = (_dot((c[0], c[1], c[2]), vector) for c in columns)
    return x, y, z


ARM = _vector(1, 4, 1)  # from the point of an axis to the joint: its part across AXIS has the square 18
HELD: dict[str, tuple[Constraint, list[dict[str, object]]]] = {
    # Of every type changes of its fields that no pose can show.
    "plane": (InPlane(AXIS, _dot(AXIS, PLACE), JOINT, "it"), [{"normal": AXIS, "offset": _dot(AXIS, PLACE)}]),
    "carries": (
        Carries(AXIS, _dot(TURNED, _plus(PLACE, _vector(*(-x for x in POSE[0])))), PLACE, "it"),
        [{"normal": AXIS, "offset": _dot(TURNED, _plus(PLACE, _vector(*(-x for x in POSE[0]))))}],
    ),
    "line": (
        OnLine(_plus(PLACE, AXIS), AXIS, JOINT, "it"),
        [{"point": AXIS}, {"direction": AXIS}, {"point": _vector(1, 0, 0), "platform": _unturned(_vector(1, 0, 0))}],
    ),
    "line, a tie": (
        OnLine(_plus(PLACE, _vector(1, 1, 1)), _vector(1, 1, 1), JOINT, "it"),
        [{"point": _vector(1, 1, 1)}, {"direction": _vector(2, 2, 2)}],
    ),
    "point": (AtPoint(PLACE, JOINT, "it"), [{"point": _vector(0, 1, 0), "platform": _unturned(_vector(0, 1, 0))}]),
    "angle": (
        Angle(AXIS, AXIS, _dot(AXIS, TURNED), "it"),
        [{"base": AXIS, "product": _dot(AXIS, TURNED)}, {"base": AXIS, "platform": _vector(*(-x for x in AXIS))}],
    ),
    "axis": (
        AxisDistance(_plus(PLACE, _vector(-1, -4, -1)), AXIS, JOINT, Fraction(18), "it"),
        [{"point": AXIS}, {"direction": AXIS}],
    ),
}


def _machine(constraint: Constraint) -> Mechanism:
    return Mechanism("it", "1", "a test", (constraint,))


def _change(names: tuple[str, ...], changes: dict[str, object]) -> Row:
    found = dict.fromkeys(names, Fraction(0))
    for field, change in changes.items():
        if isinstance(change, tuple):
            found |= {f"it {field} {axis}": x for axis, x in zip("xyz", change, strict=True)}
        else:
            found[f"it {field}"] = Fraction(str(change))
    assert set(found) == set(names)
    return tuple(found.values())


@pytest.mark.parametrize("name", HELD)
def test_what_no_pose_can_show_is_not_seen(name: str) -> None:
    constraint, changes = HELD[name]
    machine = _machine(constraint)
    names, rows = geometric_parameters(machine, zeros=False), geometric_rows(machine, POSE, zeros=False)
    assert len(rows) == constraint.codimension
    for change in changes:
        x = _change(names, change)
        assert any(x)
        assert all(sum(a * b for a, b in zip(row, x, strict=True)) == 0 for row in rows)
    for row in rows:  # a joint that is moved is seen
        assert any(value for key, value in zip(names, row, strict=True) if "platform" in key or "base" in key)


@pytest.mark.parametrize("name", HELD)
def test_a_constraint_that_does_not_hold_is_refused(name: str) -> None:
    aside = _plus(POSE[0], _vector(1, 2, 1)), rotation_of((Fraction(1), *_vector(1, 0, 0)))
    with pytest.raises(InputError, match="'it': does not hold at the pose"):
        geometric_rows(_machine(HELD[name][0]), aside, zeros=False)


def test_of_legs_it_is_the_calibration_of_robots() -> None:
    robot = read_robot("models/rolland-6-6.toml")
    pose = _vector(1, 2, 700), rotation_of((Fraction(9), Fraction(1), Fraction(0), Fraction(-1)))
    assert geometric_rows(robot, pose, zeros=False) == observation(robot, [pose], offsets=False)[0]  # type: ignore[arg-type]


def test_the_zero_of_a_crank_is_a_turn_of_its_axes() -> None:
    shipped = model("3-rrr")
    pose = _vector(4, 3, 0), rotation_of((Fraction(1), *_vector(0, 0, "1/3")))
    knees = shipped.knees(shipped.configuration())
    arms = [
        _plus(platform_point(b, *pose), _vector(*(-x for x in k)))
        for b, k in zip(shipped.platform_joints, knees, strict=True)
    ]
    squares = ", ".join(f'"{_dot(arm, arm)}"' for arm in arms)
    text = Path("models/3-rrr.toml").read_text().replace("length = 8", f"lengths_squared = [{squares}]")
    robot = robot_from_toml(text)
    plan = plan_from_csv("x,y,half_tangent,crank 1,crank 2,crank 3\n4,3,1/3,1/2,1/3,-2\n", robot)
    assert plan[0].pose == pose
    names = geometric_parameters(robot, zeros=True)
    rows = geometric_rows(robot, pose, plan[0].values, zeros=True)
    assert len(rows) == 3
    for k in (1, 2, 3):
        change = {f"crank {k} zero": 1, f"crank {k} at_0 y": -4, f"crank {k} at_90 x": 4}
        x = [Fraction(change.get(name, 0)) for name in names]
        assert sum(map(bool, x)) == 3
        assert all(sum(a * b for a, b in zip(row, x, strict=True)) == 0 for row in rows)
        assert any(row[names.index(f"crank {k} zero")] for row in rows)


def test_slides_of_a_machine_have_axes_and_zeros() -> None:
    """Rods of length 5 on slides at x = -4 and 4: the point (1, 0) with the slides at -4 and 0."""
    text = """schema = 1
name = "two slides"
kind = "biglide"
unit = "1"
source = "a test"
[dimensions]
x = [4, -4]
rod = 5
"""
    machine = robot_from_toml(text)
    plan = plan_from_csv("x,y,z,slide 1,slide 2\n1,0,0,4,0\n1,0,0,-4,0\n1,2,0,6,2\n", machine)
    names = geometric_parameters(machine, zeros=True)
    rows = [row for found in plan for row in geometric_rows(machine, found.pose, found.values, zeros=True)]
    found = identify(rows, names)
    # The zero of a slide is a shift of its foot along it.
    shift = [Fraction({"slide 1 zero": 1, "rod 1 base y": -1}.get(name, 0)) for name in names]
    assert any(shift)
    assert all(sum(a * b for a, b in zip(row, shift, strict=True)) == 0 for row in rows)
    assert "slide 1 zero" not in found.seen_alone
    with pytest.raises(InputError, match="'slide 2': has no value"):
        geometric_rows(machine, plan[0].pose, {"slide 1": Fraction(4)}, zeros=False)
    with pytest.raises(InputError, match="'rod 1': does not hold"):
        geometric_rows(machine, plan[0].pose, {"slide 1": Fraction(5), "slide 2": Fraction(0)}, zeros=False)


def test_the_command_says_what_is_seen_and_what_is_not(tmp_path: Path, capsys: Capture) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text("x,y,half_tangent\n5,4,0\n6,3,0\n2,9,0\n")
    words = ["identify", "models/3-rpr-merlet-p.toml", str(plan)]
    assert main(words) == 0
    text = capsys.readouterr().out
    assert "rank 6: 6 combinations are not" in text
    assert "nothing shows a change of leg 2 base y by 1, leg 2 platform y by 1" in text
    assert "poses 2, 3: no fewer do" in text
    assert main([*words, "--known", "leg 1 base", "--known", "leg 2", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["determined_alone"] == ["leg 1 platform x", "leg 1 platform y"]
    assert found["rank"] == 4
    assert len(found["parameters"]) == 6
    assert len(found["null_space"]) == 2
    plan.write_text("x,y,half_tangent\n5,4,0\n6,3,1/3\n2,9,-1/2\n7,7,2\n")
    assert main(words) == 0
    assert "rank 12: all parameters are determined" in capsys.readouterr().out


BAD = {
    "no header": ("5,4,0\n", "has no poses"),
    "column": ("x,y,theta\n5,4,0\n", "line 1: column 'theta' is unknown"),
    "twice": ("x,y,x\n5,4,0\n", "line 1: two columns are called 'x'"),
    "values": ("x,y,half_tangent\n5,4\n", "line 2: 2 values; give 3"),
    "number": ("x,y,half_tangent\n5,4,a\n", "line 2, half_tangent: a is not a number"),
    "no turn": ("x,y\n5,4\n", "line 2: no angle given"),
    "half a position": ("x,half_tangent\n5,4\n", "line 2: only x given; give x, y"),
    "long": ("x,y,half_tangent\n" + "5,4,0\n" * 201, "has 201 poses; give at most 200"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_defect_of_a_plan_gives_one_sentence(name: str, tmp_path: Path, capsys: Capture) -> None:
    text, part = BAD[name]
    plan = tmp_path / "plan.csv"
    plan.write_text(text)
    assert main(["identify", "models/3-rpr-merlet-p.toml", str(plan)]) == 2
    error = capsys.readouterr().err
    assert part in error
    assert error.count("\n") == 1


def test_poses_need_lengths_and_joints_that_fit(tmp_path: Path, capsys: Capture) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text("x,y,half_tangent\n5,4,0\n")
    assert main(["identify", "models/3-rpr-merlet-p.toml", str(plan), "--zeros"]) == 2
    assert "lengths are irrational at the poses" in capsys.readouterr().err
    robot = read_robot("models/3-rpr-merlet-p.toml")
    with pytest.raises(InputError, match=r"'leg 1': has the length sqrt\(41\) at the pose, not rational"):
        geometric_rows(robot, plan_from_csv(plan.read_text(), robot)[0].pose, zeros=True)
    assert main(["identify", "models/3-rpr-merlet-p.toml", str(plan), "--known", "arm"]) == 2
    assert "--known: no parameter begins with 'arm'" in capsys.readouterr().err
    plan.write_text("x,y,z,q0,q1,q2,q3\n0,0,1,1,0,0,0\n1/10,0,1,1,0,0,0\n")
    assert main(["identify", "models/3-rps.toml", str(plan)]) == 2
    assert "pose 2: 'hinge" in capsys.readouterr().err

"""Cranks with up to four values at a pose: R-TCS, whose rods turn freely about their cranks, and cranks on ellipses."""

import json
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import prod
from pathlib import Path

import pytest
from test_machine_kinds import contains, fitted
from test_machines_reconfigurable import UNTURNED, robot

from pkm_exact.cli.main import main
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.geometry.drive_modes import JointModes, joint_values
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Matrix, rotation_of
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.quartic_roots import real_roots
from pkm_exact.geometry.working_modes import CrankMode, EnclosedCrank, FreeCrank, Mode, platform_point
from pkm_exact.radicals import RootSum
from pkm_exact.statics.exact_rows import exact_row
from pkm_exact.statics.placement import held_at
from pkm_exact.templates.machine_text import machine_text

Capture = pytest.CaptureFixture[str]
TILTED = rotation_of(tuple(map(Fraction, (9, 1, -1, 1))), (1, 3, 1))  # type: ignore[arg-type]


def vector(*values: object) -> Vector:
    x, y, z = (Fraction(str(value)) for value in values)
    return x, y, z


def numbers(mode: Mode) -> tuple[RootSum, RootSum]:
    """Cosine and sine of a mode, exactly."""
    if isinstance(mode, EnclosedCrank):
        cosine, sine = mode.cos.radicals, mode.sin.radicals
        assert cosine is not None
        assert sine is not None
        return cosine, sine
    assert isinstance(mode, CrankMode)
    return tuple(x.p + x.q * RootSum.root(Fraction(x.n)) for x in (mode.cos, mode.sin))  # type: ignore[return-value]


def turned(constraint: Constraint, drive: Drive, c: RootSum, s: RootSum) -> Constraint:
    """With what the drive adds to its field at an angle that square roots express."""
    part = drive.parts[0]
    moved = tuple(
        a + c * x + s * y
        for a, x, y in zip(getattr(constraint, part.field), *part.axes, strict=True)  # type: ignore[arg-type]
    )
    return replace(constraint, **{part.field: moved})  # type: ignore[type-var, arg-type]


def along_crank(machine: Mechanism, place: int, mode: Mode, position: Vector, rotation: Matrix) -> list[RootSum]:
    """d.u and d.u' of a free collar: u along the crank, u' a quarter turn on, d from its base to the rod's end."""
    c, s = numbers(mode)
    part = machine.drives[place].parts[0]
    constraint = next(found for found in machine.constraints if found.name == part.constraint)
    base, joint = constraint.point, constraint.platform  # type: ignore[attr-defined]
    end = platform_point(joint, position, rotation)
    d = [p - a for p, a in zip(end, base, strict=True)]
    across, up = ([c, s], [-s, c])
    first, second = part.axes
    return [
        sum((g * (x * a + y * b) * z for g, a, b, z in zip(machine.metric, first, second, d, strict=True)), RootSum())  # type: ignore[operator, arg-type]
        for x, y in (across, up)
    ]


@pytest.mark.parametrize("rotation", [UNTURNED, TILTED])
def test_a_rod_on_a_free_collar_has_four_modes_exactly(rotation: Matrix) -> None:
    """Twice as many as the book has, whose collars do not slide beyond the crank's axis: 64 of 512 with six legs."""
    machine, position = robot("R-TCS", 6), vector(3, 2, 160)
    joints = joint_values(machine, position, rotation)
    assert [len(joint.modes) for joint in joints] == [4, 4, 4, 2, 2, 2]
    before = {found.name: found for found in machine.constraints}
    kept = 1
    for place, joint in enumerate(joints):
        drive = machine.drives[place]
        for mode in joint.modes:
            c, s = numbers(mode)
            assert (c * c + s * s - 1).sign() == 0
            assert machine.holds(turned(before[drive.parts[0].constraint], drive, c, s), position, rotation)
        if place < 3:
            places = [along_crank(machine, place, mode, position, rotation)[0] for mode in joint.modes]
            kept *= sum(found.sign() > 0 for found in places)
        else:
            kept *= len(joint.modes)
        assert joint.discriminant is not None
        assert joint.discriminant > 0
    assert (kept, prod(len(joint.modes) for joint in joints)) == (64, 512)


def free_leg() -> tuple[Mechanism, tuple[JointModes, ...], Vector]:
    """Four freedoms: the third crank has a free collar; its rod as long as it must be at the values of home."""
    position = vector(0, 0, 150)
    plain = robot("R-TCS", 4)
    home = plain.configurations[0]
    values = tuple((Fraction(4, 5), Fraction(3, 5)) for _ in home.values)
    machine = fitted_at(plain, values, position)
    return machine, joint_values(machine, position, UNTURNED), position


def fitted_at(plain: Mechanism, values: tuple[tuple[Fraction, Fraction], ...], position: Vector) -> Mechanism:
    home = replace(plain.configurations[0], name="home", values=values)
    return fitted(replace(plain, configurations=(home,)), position, UNTURNED)


def rational(mode: Mode) -> tuple[Fraction, Fraction]:
    assert isinstance(mode, CrankMode)
    assert mode.cos.is_rational
    assert mode.sin.is_rational
    return mode.cos.p, mode.sin.p


@pytest.mark.parametrize("which", ["one", pytest.param("all", marks=[pytest.mark.slow, pytest.mark.largest])])
def test_forward_kinematics_contains_the_pose_in_all_modes(which: str) -> None:
    machine, joints, position = free_leg()
    assert [len(joint.modes) for joint in joints] == [2, 2, 4, 2]
    found = [[rational(mode) for mode in joint.modes] for joint in joints]
    combinations = list(product(*found))
    assert len(combinations) == 32
    # the fourth of the free collar's: half a turn
    chosen = [one for one in combinations if one[2] == (-1, 0)] if which == "one" else combinations
    for values in chosen[:1] if which == "one" else chosen:
        assert contains(solve(machine.problem(values)), position, UNTURNED)


@pytest.mark.slow
@pytest.mark.largest
def test_forward_kinematics_with_six_legs_contains_the_pose() -> None:
    position = vector(0, 0, 150)
    plain = robot("R-TCS", 6)
    machine = fitted_at(plain, tuple((Fraction(4, 5), Fraction(3, 5)) for _ in range(6)), position)
    joints = joint_values(machine, position, UNTURNED)
    assert [len(joint.modes) for joint in joints] == [4, 4, 4, 2, 2, 2]
    values = [rational(joint.modes[-1]) for joint in joints]
    solution = solve(machine.problem(values))
    assert solution.complex_solutions == 320
    assert contains(solution, position, UNTURNED)


@pytest.mark.parametrize(
    ("position", "count"),
    [
        (vector(-40, 0, 120), 2),  # |d| is the rod's length: the collar is on the crank's axis
        (vector(-40, 0, 119), 0),
        (vector(60, 50, 150), 4),
    ],
)
def test_where_modes_meet_the_discriminant_vanishes(position: Vector, count: int) -> None:
    joint = joint_values(robot("R-TCS", 6), position, UNTURNED)[0]
    assert len(joint.modes) == count
    assert (joint.discriminant == 0) == (count == 2)


def test_velocities_of_a_free_collar_are_the_derivative_of_its_equation() -> None:
    """|d|^2 - (d.u)^2 = l^2 changes by 2 (d.u) (d.u') per radian; in all modes, irrational ones too."""
    machine, position = robot("R-TCS", 6), vector(3, 2, 160)
    joints = joint_values(machine, position, TILTED)
    for number in "13":
        held = held_at(machine, position, TILTED, modes=f"{number * 3}+-+")
        for place in range(3):
            equation = held.equations[held.actuators[place].equation]
            rates = exact_row(equation, position, TILTED, machine.metric, range(6)).rates
            on, across = along_crank(machine, place, joints[place].modes[int(number) - 1], position, TILTED)
            assert (rates[place] - 2 * on * across).sign() == 0
    with pytest.raises(InputError, match="crank 1 reaches the pose at four joint values; give a sign"):
        held_at(machine, position, TILTED)
    with pytest.raises(InputError, match="crank 4 has 2 joint values at the pose, no 3; name another"):
        held_at(machine, position, TILTED, modes="111311")


# Circles that are none: an end that a crank moves along an ellipse


def on_ellipse(u: Vector, v: Vector, foot: Vector, square: object, *, weight: int = 1) -> Mechanism:
    rod: Constraint = Distance(foot, vector(0, 0, 0), Fraction(str(square)), "rod")
    drive = Drive("crank", (Part("rod", "base", (u, v)),), weight)
    return Mechanism("r", "m", "", (rod,), ("crank",), drives=(drive,), metric=(1, 1, 1))


def modes_at(machine: Mechanism, *position: object) -> JointModes:
    (joint,) = joint_values(machine, vector(*position), UNTURNED)
    return joint


def test_an_ellipse_has_roots_that_only_bounds_tell() -> None:
    machine = on_ellipse(vector(3, 0, 0), vector(0, 1, 0), vector(0, 0, 0), 5)
    joint = modes_at(machine, "1/4", "1/5", 0)
    assert len(joint.modes) == 4
    middles = []
    for mode in joint.modes:
        assert isinstance(mode, EnclosedCrank)
        assert mode.half_tangent.radicals is None
        width = Fraction(1, 10**20)
        c, s, t = (x.enclosure(width) for x in (mode.cos, mode.sin, mode.half_tangent))
        assert all(high - low <= width for low, high in (c, s, t))
        x, y = sum(c) / 2, sum(s) / 2
        assert abs((3 * x - Fraction(1, 4)) ** 2 + (y - Fraction(1, 5)) ** 2 - 5) < Fraction(1, 10**18)
        assert abs(x * x + y * y - 1) < Fraction(1, 10**18)
        middles.append(sum(t) / 2)
    assert middles == sorted(middles)
    with pytest.raises(InputError, match="crank reaches it at an angle that no square roots express"):
        held_at(machine, vector("1/4", "1/5", 0), UNTURNED, modes="2")


def test_an_ellipse_about_the_point_itself() -> None:
    """The circle is met at (3 cos)^2 + sin^2 = 5: cos^2 = 1/2; tangents of 22.5 and 67.5 degrees."""
    joint = modes_at(on_ellipse(vector(3, 0, 0), vector(0, 1, 0), vector(0, 0, 0), 5), 0, 0, 0)
    assert [str(mode.half_tangent) for mode in joint.modes] == [  # type: ignore[union-attr]
        "-1 - sqrt(2)",
        "1 - sqrt(2)",
        "-1 + sqrt(2)",
        "1 + sqrt(2)",
    ]
    assert {abs(numbers(mode)[0]).terms for mode in joint.modes} == {((2, Fraction(1, 2)),)}
    rim = modes_at(on_ellipse(vector(3, 0, 0), vector(0, 1, 0), vector(0, 0, 0), 9), 0, 0, 0)
    assert [rational(mode) for mode in rim.modes] == [(1, 0), (-1, 0)]
    assert rim.discriminant == 0


def test_a_weight_is_one_of_another_metric() -> None:
    """cos^2 + 3 s^2 = 1 with s = sin / sqrt(3): the same ellipse as before, written otherwise."""
    joint = modes_at(on_ellipse(vector(3, 0, 0), vector(0, 1, 0), vector(0, 0, 0), 5, weight=3), 0, 0, 0)
    assert len(joint.modes) == 4
    for mode in joint.modes:
        c, s = numbers(mode)
        assert (c * c + 3 * (s * s) - 1).sign() == 0
        assert (9 * (c * c) + s * s - 5).sign() == 0


def test_a_crank_that_moves_nothing_is_free() -> None:
    still = vector(0, 0, 0)
    machine = on_ellipse(vector(1, 0, 0), vector(0, 1, 0), still, 2)
    assert modes_at(machine, 0, 0, 1).modes == (FreeCrank(),)
    assert modes_at(on_ellipse(vector(1, 0, 0), vector(1, 0, 0), vector(0, 0, 1), 2), 0, 0, 1).modes != (FreeCrank(),)


@pytest.mark.parametrize("seed", range(12))
def test_roots_are_those_of_the_factors_they_were_made_of(seed: int) -> None:
    """Products of (x - a)^2 - b are met again, in order, each root once, and with their square roots."""
    first, second = (seed * 7 % 11 - 5, 1 + seed % 5), (seed * 3 % 7 - 3, 1 + seed * 5 % 7)
    polynomial = [1]
    for a, b in (first, second):
        factor = [a * a - b, -2 * a, 1]
        polynomial = [
            sum(polynomial[i] * factor[k - i] for i in range(len(polynomial)) if 0 <= k - i < 3)
            for k in range(len(polynomial) + 2)
        ]
    expected: list[RootSum] = []
    for a, b in (first, second):
        for sign in (-1, 1):
            value = RootSum.root(Fraction(b)) * sign + a
            if all((value - other).sign() for other in expected):
                expected.append(value)
    expected.sort(key=float)
    assert [root.radicals for root in real_roots(polynomial)] == expected


def test_the_command_lists_them(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "r-tcs.toml"
    text = machine_text(MACHINES["R-TCS"], "r", "mm", {"freedoms": '"4"'})
    path.write_text(text)
    assert main(["legs", str(path), "--position", "0,0,160", "--quaternion", "1,0,0,0"]) == 0
    out = capsys.readouterr().out
    assert "32 working modes\nactuator" in out
    tilted = ["--position", "0,2,160", "--quaternion", "30,1,0,0", "--in-metric"]
    assert main(["legs", str(path), *tilted, "--format", "json"]) == 0
    modes = json.loads(capsys.readouterr().out)["actuators"][2]["modes"]
    assert len(modes) == 4
    assert all("sqrt" in mode[key]["exact"] for mode in modes for key in ("cos", "sin", "half_tangent"))
    assert {len(mode["half_tangent"]["polynomial"]) for mode in modes} == {5}
    assert len({tuple(mode["half_tangent"]["polynomial"]) for mode in modes}) == 1
    words = ["statics", str(path), "--position", "0,0,160", "--quaternion", "1,0,0,0", "--modes"]
    assert main([*words, "++2-"]) == 0
    second = capsys.readouterr().out
    assert main([*words, "++3-"]) == 0
    assert capsys.readouterr().out != second

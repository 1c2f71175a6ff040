"""Every machine that has a recipe, by one body: solved as drawn, alike in other frames, and forward after inverse."""

import itertools
import tomllib
from dataclasses import replace
from fractions import Fraction
from functools import cache
from math import prod, sqrt
from pathlib import Path
from typing import Any

import pytest

from pkm_exact.claim import Claim
from pkm_exact.cli.main import main
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import Carries, InPlane
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.formulations.moved_platform import moved_platform
from pkm_exact.geometry.angle_degrees import angle_in_degrees
from pkm_exact.geometry.chains import JointValue
from pkm_exact.geometry.drive_modes import joint_values
from pkm_exact.geometry.inverse import Matrix, rotation_of
from pkm_exact.geometry.machines.machine_kinds import MACHINES
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.surds import Surd
from pkm_exact.geometry.working_modes import CrankMode, FreeCrank, Mode
from pkm_exact.interactive.answer_notes import answer_notes
from pkm_exact.motions.motion_groups import MOTIONS
from pkm_exact.solution import Solution
from pkm_exact.templates.machine_text import given_dimensions, machine_text

Capture = pytest.CaptureFixture[str]
TURN = (Fraction(3), Fraction(1), Fraction(-1), Fraction(2))


@cache
def drawn(name: str) -> Mechanism:
    robot = robot_from_toml(machine_text(MACHINES[name], "example", "mm"))
    assert isinstance(robot, Mechanism)
    return robot


@cache
def at_home(name: str) -> Solution:
    robot = drawn(name)
    return solve(robot.problem(robot.configuration("home")))


@pytest.mark.parametrize("name", MACHINES)
def test_the_example_of_every_kind_is_proved_complete(name: str) -> None:
    robot, solution = drawn(name), at_home(name)
    assert (robot.kind, robot.motion, robot.metric) == (name, MACHINES[name].motion, MACHINES[name].metric)
    assert solution.claim is Claim.COMPLETE
    assert solution.poses


def turned_over(constraint: Constraint) -> Constraint:
    """The same condition with the signs of its equation changed."""
    if isinstance(constraint, InPlane | Carries):
        x, y, z = constraint.normal
        return replace(constraint, normal=(-x, -y, -z), offset=-constraint.offset)
    if isinstance(constraint, Angle):
        x, y, z = constraint.base
        return replace(constraint, base=(-x, -y, -z), product=-constraint.product)
    return constraint


@pytest.mark.parametrize("name", MACHINES)
def test_signs_order_and_frames_do_not_matter(name: str) -> None:
    exact = at_home(name)
    changed = tuple(turned_over(found) for found in reversed(exact.problem.constraints))
    problem = ForwardProblem(changed, exact.problem.metric, exact.problem.motion)
    if exact.problem.motion in (MOTIONS["spatial"], MOTIONS["spherical"]) and not problem.squares:
        other = solve(moved_platform(problem, rotation_of(TURN, problem.metric)))
        places = [[p.position for p in found.poses] for found in (exact, other)]
        assert sorted(map(str, places[0])) == sorted(map(str, places[1]))
    else:
        other = solve(problem)
        assert [str(pose) for pose in other.poses] == [str(pose) for pose in exact.poses]
    assert (other.claim, other.complex_solutions) == (exact.claim, exact.complex_solutions)


def fitted(robot: Mechanism, position: Vector, rotation: Matrix) -> Mechanism:
    """The machine whose rods are as long as they must be for the home values to reach a pose."""
    home = robot.locked(robot.configuration("home").values, "home")
    moved = {part.constraint for drive in robot.drives for part in drive.parts}
    changed: list[Constraint] = []
    for own, locked in zip(robot.constraints, home, strict=True):
        field = own.value_field
        if own.name in moved and field is not None and field != "offset":
            rest = robot.equation_at(locked, position, rotation)
            value: Any = getattr(locked, field) + rest
            changed.append(replace(own, **{field: value}))  # type: ignore[type-var]
        else:
            changed.append(own)
    return replace(robot, constraints=tuple(changed))


def value_of(mode: Mode) -> JointValue | None:
    """The value of a working mode, if it is rational."""
    if isinstance(mode, FreeCrank):
        return None
    if isinstance(mode, CrankMode):
        return (mode.cos.p, mode.sin.p) if mode.cos.is_rational and mode.sin.is_rational else None
    return mode.position.p if mode.position.is_rational else None


def contains(solution: Solution, position: Vector, rotation: Matrix) -> bool:
    """Whether one of the boxes holds a pose that is rational in the metric."""
    metric = solution.problem.metric

    def signed(x: Fraction) -> Fraction:
        return x * abs(x)

    return any(
        all(
            signed(box.lo) <= g * signed(x) <= signed(box.hi)
            for box, x, g in zip(pose.position, position, metric, strict=True)
        )
        and all(
            signed(pose.rotation[i][j].lo) * metric[j] <= metric[i] * signed(rotation[i][j])
            and metric[i] * signed(rotation[i][j]) <= signed(pose.rotation[i][j].hi) * metric[j]
            for i in range(3)
            for j in range(3)
        )
        for pose in solution.poses
    )


WITH_MODES = [name for name, kind in MACHINES.items() if kind.has_modes]


@pytest.mark.parametrize("name", WITH_MODES)
@pytest.mark.parametrize("which", ["ends", pytest.param("all", marks=pytest.mark.slow)])
def test_forward_kinematics_of_every_working_mode_contains_the_pose(name: str, which: str) -> None:
    kind = MACHINES[name]
    (position, quaternion) = (tuple(map(Fraction, part)) for part in kind.pose)
    rotation = rotation_of(quaternion, kind.metric)  # type: ignore[arg-type]
    robot = fitted(drawn(name), position, rotation)  # type: ignore[arg-type]
    joints = joint_values(robot, position, rotation)  # type: ignore[arg-type]
    values = [[value_of(mode) for mode in joint.modes] for joint in joints]
    home = robot.configuration("home").values
    if robot.drives:
        assert all(value in found for value, found in zip(home, values, strict=True))
    assert all(joint.discriminant is None or joint.discriminant >= 0 for joint in joints)
    combinations = list(itertools.product(*values))
    assert len(combinations) == prod(len(joint.modes) for joint in joints)
    for combination in combinations if which == "all" else {combinations[0], combinations[-1]}:
        if None in combination:
            continue
        squares = [
            value * value if robot.drive(joint) is None and is_length else value  # type: ignore[operator]
            for joint, value, is_length in zip(robot.actuated, combination, robot.are_lengths, strict=True)
        ]
        assert contains(solve(robot.problem(squares)), position, rotation)  # type: ignore[arg-type]


def test_where_two_working_modes_meet_the_discriminant_vanishes() -> None:
    robot = drawn("linear-delta")
    height = Fraction(0)
    reach = [Fraction(250)] * 3
    assert [c.length_squared for c in robot.constraints] == [x * x for x in reach]  # type: ignore[attr-defined]
    stretched = (Fraction(150 - 40 - 250), Fraction(0), height)
    joints = joint_values(robot, stretched, rotation_of((Fraction(1), *(Fraction(0),) * 3), robot.metric))
    assert (joints[0].discriminant, len(joints[0].modes)) == (0, 1)
    beyond = (stretched[0] - 1, *stretched[1:])
    joints = joint_values(robot, beyond, rotation_of((Fraction(1), *(Fraction(0),) * 3), robot.metric))
    assert joints[0].modes == ()
    assert (joints[0].discriminant or 0) < 0


# Angles


@pytest.mark.parametrize(("degrees", "weight"), [(0, 1), (90, 1), (-90, 1), (180, 1), (60, 3), (-120, 3), (240, 3)])
def test_some_angles_are_exact(degrees: int, weight: int) -> None:
    (c, s), stand_in = angle_in_degrees(degrees, "x", weight)
    assert stand_in is None
    assert c * c + weight * s * s == 1
    from math import cos, radians, sin

    assert (float(c), float(s) * sqrt(weight)) == pytest.approx((cos(radians(degrees)), sin(radians(degrees))))


@pytest.mark.parametrize(("degrees", "weight"), [("37", 1), ("-179.999", 1), ("60", 1), ("90", 3), ("-0.001", 2)])
def test_other_angles_have_a_stand_in_that_is_near(degrees: str, weight: int) -> None:
    from mpmath import acos, mp, mpf

    (c, s), stand_in = angle_in_degrees(degrees, "x", weight)
    assert stand_in is not None
    assert c * c + weight * s * s == 1
    with mp.workdps(50):
        size = acos(mpf(c.numerator) / c.denominator) * 180 / mp.pi
        difference = abs(size - abs(mpf(degrees)))
        assert difference <= mpf(stand_in.off.numerator) / stand_in.off.denominator
    assert (s > 0) == (Fraction(degrees) > 0)
    assert stand_in.off < Fraction(1, 10**12)
    with pytest.raises(InputError, match="exact = true"):
        angle_in_degrees(degrees, "x", weight, exact=True)


def test_degrees_are_never_silently_rounded() -> None:
    text = machine_text(MACHINES["delta"], "r", "m").replace(MACHINES["delta"].home["half_tangents"], "[30, 37.5, 90]")
    text = text.replace("half_tangents", "degrees")
    robot = robot_from_toml(text)
    notes = answer_notes(robot, "home", solve(robot.problem(robot.configuration())))
    assert [note[:36] for note in notes[:2]] == [
        "arm 1 was given as 30 degrees, whose",
        "arm 2 was given as 37.5 degrees, who",
    ]
    assert robot.configuration().values[2] == (0, 1)
    with pytest.raises(InputError, match=r"configurations\[1\] \('home'\).degrees\[1\]: cosine and sine of 30 degrees"):
        robot_from_toml(text + "exact = true\n")


# Model files

DELTA = machine_text(MACHINES["delta"], "r", "m")
BAD = {
    "kind": (DELTA.replace('"delta"', '"deltas"'), "kind: 'deltas' is unknown; use one of: 6-UPS"),
    "key": (DELTA.replace("arm =", "arms ="), "dimensions: unknown key 'arms'; the known keys are: base_radius"),
    "table": (DELTA.replace("[dimensions]", "[dimension]"), "top level: unknown key 'dimension'"),
    "number": (DELTA.replace("arm = 1.73", "arm = -1"), "dimensions.arm: -1 is not positive"),
    "rods": (DELTA.replace("rod = 2.66", "rods = [1, 2]"), "dimensions.rods: 2 entries; give 3"),
    "no rod": (DELTA.replace("rod = 2.66", ""), "no rods given; give exactly one of rod, rods, rod_squared"),
    "values": (DELTA.replace('"2/3"]', '"2/3", 0]'), "half_tangents: 4 values; give 3: arm 1, arm 2, arm 3"),
    "none": (DELTA.replace("half_tangents", "# x"), "give exactly one of half_tangents, cos_sin, degrees"),
    "circle": (DELTA.replace("half_tangents", "cos_sin"), "cos_sin[1]: '3/4' is not a pair; give [cosine, sine]"),
    "range": (DELTA.replace('half_tangents = ["3/4"', "degrees = [361"), "361 is out of range; give an angle"),
    "metric": (DELTA.replace("[dimensions]", "metric = [1, 1, 1]\n[dimensions]"), "unknown key 'metric'"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_defect_gives_one_sentence(name: str) -> None:
    text, part = BAD[name]
    assert text != DELTA
    with pytest.raises(InputError) as caught:
        robot_from_toml(text)
    assert part in str(caught.value)
    assert str(caught.value).isprintable()


def test_another_number_of_legs_is_told_its_kind() -> None:
    text = (
        'schema = 1\nname = "r"\nkind = "6-UPS"\nunit = "m"\nsource = "x"\n'
        "[base]\njoints = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]\n"
        "[platform]\njoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
    )
    with pytest.raises(
        InputError, match='4 rows; give 6 joints of 3 coordinates, one per leg, or write kind = "4-UPS"'
    ):
        robot_from_toml(text)
    assert len(robot_from_toml(text.replace("6-UPS", "4-UPS")).actuated) == 4


def test_values_that_do_not_fit_are_refused() -> None:
    robot = drawn("delta")
    with pytest.raises(InputError, match="'arm 1': the squares of cosine and sine sum to"):
        robot.problem([(Fraction(1), Fraction(1))] * 3)
    with pytest.raises(InputError, match="is no number; give a slide's position"):
        drawn("triglide").problem([(Fraction(1), Fraction(0))] * 3)
    with pytest.raises(InputError, match="is no number; give one"):
        drawn("3-RPS").problem([(Fraction(1), Fraction(0))] * 3)
    assert robot.problem_at([Fraction(3, 4), Fraction(1, 2), Fraction(2, 3)]) == robot.problem(robot.configuration())


# Commands


@pytest.mark.parametrize("name", MACHINES)
def test_new_writes_every_kind(name: str, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "mine.toml"
    assert main(["new", "--kind", name, "-o", str(path)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out.startswith(f"{path}: {name}, home: ")
    assert read_robot(path) == replace(drawn(name), name="mine", source=tomllib.loads(path.read_text())["source"])


VARIANTS = [(name, word) for name, kind in MACHINES.items() for word in kind.homes]


def _is_quick(word: tuple[str, str]) -> bool:
    return word[0] == "driven"


def _marks(name: str, word: tuple[str, str]) -> list[pytest.MarkDecorator]:
    is_largest = name in ("CP-VS", "R-TCS") and word == ("freedoms", "5")
    return [] if _is_quick(word) else [pytest.mark.slow, *([pytest.mark.largest] if is_largest else [])]


@pytest.mark.parametrize(
    ("name", "word"),
    [pytest.param(*one, marks=_marks(*one)) for one in VARIANTS if one[1][1] != "6"],
)
def test_new_writes_kinds_with_other_joints(name: str, word: tuple[str, str], tmp_path: Path) -> None:
    """Those with six freedoms are solved by others: a joint on a cylinder makes 320 poses."""
    path = tmp_path / "mine.toml"
    assert main(["new", "--kind", name, "--dimension", "=".join(word), "-o", str(path)]) == 0
    robot = read_robot(path)
    assert isinstance(robot, Mechanism)
    assert len(robot.actuated) == (3 if word[0] == "driven" else int(word[1]))


@pytest.mark.parametrize(("name", "word"), VARIANTS)
def test_examples_with_other_joints_have_values_for_all_of_them(name: str, word: tuple[str, str]) -> None:
    kind = MACHINES[name]
    robot = robot_from_toml(machine_text(kind, "r", "mm", given_dimensions(kind, ("=".join(word),))))
    assert len(robot.configuration().values) == len(robot.actuated)  # type: ignore[union-attr]


NO_MACHINE = [
    (["--kind", "delta", "--dimension", "legs=3", "-o", "-"], "'legs=3' is none of a delta; give one of: base_radius"),
    (["--kind", "delta", "--dimension", "arm", "-o", "-"], "'arm' is none of a delta"),
    (["--kind", "delta", "--dimension", "arm=1\nx=2", "-o", "-"], "is no value"),
    (["--kind", "delta", "--dimension", "arm=[", "-o", "-"], "not valid TOML"),
    (["--kind", "delta", "--height", "3", "-o", "-"], "--height: a delta has dimensions of its own"),
    (["--kind", "delta"], "give -o as well"),
    (["--kind", "6-UPS", "--dimension", "arm=3", "-o", "-"], "--dimension: only machines with dimensions"),
]


@pytest.mark.parametrize(("words", "part"), NO_MACHINE, ids=range(len(NO_MACHINE)))
def test_what_cannot_be_drawn_gives_one_sentence(words: list[str], part: str, capsys: Capture) -> None:
    assert main(["new", *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert part in err


def test_legs_shows_working_modes(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "triglide.toml"
    path.write_text(machine_text(MACHINES["triglide"], "r", "mm"))
    assert main(["legs", str(path), "--position", "0,0,150", "--quaternion", "1,0,0,0"]) == 0
    out = capsys.readouterr().out
    assert "8 working modes\nactuator" in out
    assert out.count(" 40000\n") == 6
    assert {line.split()[2] for line in out.splitlines() if line.startswith(" slide")} == {
        "-160.000000000000000",
        "240.000000000000000",
    }
    assert Surd(Fraction(240)).is_rational


def test_limits_of_cranks_and_slides_are_compared() -> None:
    from pkm_exact.poses.limit_checks import limit_verdicts

    for name, limits, kept in (
        ("delta", "angles = [0, 90]", "yes"),
        ("delta", "angles = [0, 45]", "no"),
        ("triglide", "slides = [190, 210]", "yes"),
        ("triglide", "slides = [[0, 300], [0, 300], [191, 300]]", "no"),
    ):
        robot = robot_from_toml(machine_text(MACHINES[name], "r", "m") + f"\n[limits]\n{limits}\n")
        home = robot.configuration()
        solution = solve(robot.problem(home))
        found = limit_verdicts(robot, home, solution.problem, solution.poses)
        assert [str(verdict) for verdicts in found for verdict in verdicts.values()] == [kept] * len(solution.poses)
    with pytest.raises(InputError, match="limits"):
        robot_from_toml(DELTA + "\n[limits]\nslides = [0, 1]\n")

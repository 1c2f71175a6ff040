"""Constraints of every type in floating point: their errors and derivatives, and the iterations that use them."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from random import Random

import numpy as np
import pytest
from budgets import budget
from hypothesis import given
from hypothesis import strategies as st
from mechanism_samples import MECHANISMS, ORIGIN, Some, solved, vector

from pkm_exact.cli.main import main
from pkm_exact.comparison.numeric_distance import Judge, platform_points
from pkm_exact.comparison.numeric_engines import engines_for
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import value_at
from pkm_exact.constraints.linear import LinearForm
from pkm_exact.errors import InputError
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import MOTIONS, SCHOENFLIES
from pkm_exact.numeric.fallback import solve_within
from pkm_exact.numeric.home import home_pose, random_states
from pkm_exact.numeric.levenberg_marquardt import DescentPolicy, levenberg_marquardt, solve_levenberg_marquardt
from pkm_exact.numeric.newton_iteration import newton_from, solve_newton
from pkm_exact.numeric.numeric_machine import StartPose, centred, placed
from pkm_exact.numeric.numeric_mechanism import NumericMechanism, numeric_machine
from pkm_exact.numeric.numeric_robot import NumericRobot, numeric_robot
from pkm_exact.numeric.quaternions import turned
from pkm_exact.numeric.uncertified import Ending
from pkm_exact.poses.jacobian import characteristic_length

MODELS = Path(__file__).parent.parent / "models"
DELTA, H4, CYLINDERS = (str(MODELS / f"{name}.toml") for name in ("delta", "h4", "3-prrr"))
ANGLE = Angle(vector(1, 2, 0), vector(0, 1, -1), Fraction(1))
CYLINDER = AxisDistance(vector(1, 0, 2), vector(1, 1, 0), vector(3, -1, 2), Fraction(9))
FREE = LinearForm((Fraction(0), *(Fraction(k % 5 - 2) for k in range(1, 16)), Fraction(0)))
Capture = pytest.CaptureFixture[str]


def of_every_type(seed: int, metric: tuple[int, int, int]) -> ForwardProblem:
    some = Some(seed)
    drawn: list[Constraint] = [some.distance(), some.in_plane(), some.carries(), some.on_line(), some.at_point()]
    return ForwardProblem((*drawn, ANGLE, CYLINDER, FREE), metric)


@budget(20)
@given(seed=st.integers(0, 10**6), metric=st.sampled_from([(1, 1, 1), (1, 3, 1), (2, 3, 5)]))
def test_errors_are_those_of_the_exact_equations(seed: int, metric: tuple[int, int, int]) -> None:
    random, problem = Random(seed), of_every_type(seed, metric)
    x, y, z = (Fraction(random.randint(-90, 90), 10) for _ in range(3))
    e0, e1, e2, e3 = (Fraction(random.randint(-4, 4)) for _ in range(4))
    rotation = rotation_of((e0 + 5, e1, e2, e3), metric)
    length = characteristic_length(problem)
    exact = []
    for constraint in problem.constraints:
        sizes = constraint.scales(metric, length)
        values = [value_at(form, (x, y, z), rotation, metric) for form in constraint.forms(metric)]
        for square in constraint.squares(metric):
            linear, root = (value_at(f, (x, y, z), rotation, metric) for f in (square.linear, square.root))
            values.append(linear - square.factor * root**2)
        exact += [float(v) / float(s) ** 0.5 for v, s in zip(values, sizes, strict=True)]
    scales = np.sqrt(np.array(metric, dtype=float))
    machine = numeric_machine(problem)
    matrix = np.array([[float(v) for v in row] for row in rotation]) * scales[:, None] / scales
    place = scales * [float(v) for v in (x, y, z)]
    c = (place + matrix @ machine.platform_centre - machine.base_centre) / machine.unit
    found = machine.at(c, _quaternion(matrix)).errors * machine.unit
    # Quadrics come last there.
    assert sorted(found) == pytest.approx(sorted(exact), abs=1e-9 * max(map(abs, exact)))


def _quaternion(matrix: np.ndarray) -> tuple[float, ...]:
    trace = np.trace(matrix)
    q0 = (1 + trace) ** 0.5 / 2
    rest = (matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1])
    return (q0, *(value / (4 * q0) for value in rest))


@budget(20)
@given(seed=st.integers(0, 10**6))
def test_the_jacobian_is_the_derivative_of_the_errors(seed: int) -> None:
    machine, generator = numeric_machine(of_every_type(seed, (1, 3, 1))), np.random.default_rng(seed)
    c, q = generator.normal(size=3), turned(tuple(generator.normal(size=4)), (0.0, 0.0, 0.0))
    step, size = generator.normal(size=6), 1e-6
    ends = [machine.at(c + h * step[:3], turned(q, h * step[3:])).errors for h in (size, -size)]
    slopes = step @ machine.at(c, q).transposed_jacobian()
    assert slopes == pytest.approx((ends[0] - ends[1]) / (2 * size), rel=1e-6, abs=1e-6)
    many = machine.at(np.stack([-c, c]), tuple(np.stack([-np.array(q), q]).T))
    assert many.errors[1] == pytest.approx(machine.at(c, q).errors)
    assert many.transposed_jacobian()[1] == pytest.approx(machine.at(c, q).transposed_jacobian())
    assert many.worst.shape == (2,)


def test_legs_are_the_same_as_constraints_and_as_legs() -> None:
    """To first order an error of the squared length, divided by 2 l, is that of the length."""
    some = Some(5)
    legs = ForwardProblem(tuple(some.distance() for _ in range(6)))
    robot = numeric_robot(legs)
    seven = numeric_machine(replace(legs, constraints=(*legs.constraints, legs.constraints[0])))
    assert isinstance(numeric_machine(legs), NumericRobot)
    assert isinstance(seven, NumericMechanism)
    start = StartPose((3.0, -2.0, 8.0), (0.8, 0.0, 0.6, 0.0))
    exact = robot.at(*centred(robot, start)).errors * robot.unit
    lengths = np.sqrt([float(leg.length_squared) for leg in legs.distances])
    squares = (exact + lengths) ** 2
    found = seven.at(*centred(seven, start)).errors * seven.unit
    assert found[:6] == pytest.approx((squares - lengths**2) / (2 * lengths))
    assert found[6] == found[0]


NAMES = ("3 planes, 3 spheres", "3-RPS", "Delta", "H4", "3-PRRR, driven in turns", "3 legs about a point", "3 lines")


@pytest.mark.parametrize("name", NAMES)
def test_iterations_find_certified_poses_and_no_others(name: str) -> None:
    problem, solution = MECHANISMS[name][0](), solved(name)
    found = solve_levenberg_marquardt(problem, DescentPolicy(starts=40))
    judge = Judge(problem, solution.poses, characteristic_length(problem))
    modes = [judge.judge(pose).mode for pose in found.poses]
    assert None not in modes
    assert len(set(modes)) == len(modes) <= len(solution.poses)
    assert not solution.poses or modes
    machine = numeric_machine(problem)
    for pose in found.poses[:2]:
        again = newton_from(machine, *centred(machine, StartPose(pose.position, pose.quaternion)))
        assert again.converged
        assert again.iterations <= 2
        assert again.position == pytest.approx(pose.position)


@pytest.mark.parametrize("motion", MOTIONS.values(), ids=lambda motion: motion.name)
def test_starts_and_steps_stay_within_the_motions(motion) -> None:
    some = Some(3)
    cut = [replace(some.distance(), base=ORIGIN) for _ in range(motion.dimension)]
    if motion.is_planar:
        cut = [replace(leg, platform=(*leg.platform[:2], Fraction(0))) for leg in cut]
    problem = ForwardProblem((*cut, cut[0]), motion=motion)
    machine = numeric_machine(problem)
    ends = levenberg_marquardt(machine, DescentPolicy(starts=3, iterations=4))
    c, q = random_states(machine, 3, 1)
    starts = [placed(machine, c[k], tuple(q[:, k]))[0] for k in range(3)]
    fixed = [axis for axis in range(6) if axis not in motion.twist]
    poses = [(*pose.position, *pose.quaternion[1:]) for pose in ends]
    poses += [(*start, *q[1:, k]) for k, start in enumerate(starts)]
    home = home_pose(machine)
    for pose in [*poses, (*home.position, *home.quaternion[1:])]:
        assert all(pose[axis] == 0 for axis in fixed)
    if fixed:
        astray = [0.0] * 6
        astray[fixed[0]] = 0.5
        with pytest.raises(InputError, match="start: leaves the"):
            centred(machine, StartPose(tuple(astray[:3]), (1.0, *astray[3:])))


def test_too_few_constraints_are_singular_and_too_many_may_fail() -> None:
    some = Some(1)
    legs = tuple(some.distance() for _ in range(7))
    few = numeric_machine(ForwardProblem(legs[:3]))
    assert newton_from(few, np.ones(3), (1.0, 0.0, 0.0, 0.0)).ending is Ending.SINGULAR
    many = numeric_machine(ForwardProblem(legs))
    assert newton_from(many, np.ones(3), (1.0, 0.0, 0.0, 0.0)).ending in (Ending.STAGNATED, Ending.TOO_MANY_ITERATIONS)


def test_points_that_do_not_tell_turns_have_others_beside_them() -> None:
    delta = MECHANISMS["Delta"][0]()
    assert len(platform_points(delta)) == 3 + 3
    assert np.linalg.matrix_rank(numeric_machine(delta).markers) == 3
    some = Some(2)
    assert len(platform_points(ForwardProblem(tuple(some.distance() for _ in range(6))))) == 6


@pytest.mark.parametrize("size", [10**400, Fraction(1, 10**400)])
def test_what_doubles_do_not_hold_is_refused(size: Fraction | int) -> None:
    some = Some(2)
    legs = tuple(
        Distance(tuple(size * x for x in leg.base), tuple(size * x for x in leg.platform), size**2 * leg.length_squared)
        for leg in (some.distance() for _ in range(4))
    )
    with pytest.raises(InputError, match="out of reach of floating point"):
        numeric_machine(ForwardProblem(legs, motion=SCHOENFLIES))


def test_over_the_time_limit_a_mechanism_has_an_uncertified_answer_too() -> None:
    found = solve_within(_never, MECHANISMS["Delta"][0](), 0.01)
    assert (found.claim, len(found.poses)) == ("uncertified", 2)


def _never(problem: ForwardProblem, progress: object) -> None:
    while True:
        pass


# The command line


def test_newton_solves_a_mechanism(capsys: Capture) -> None:
    assert main(["solve", DELTA, "--method", "newton", "-v"]) == 3
    out, _ = capsys.readouterr()
    assert "1 pose found; uncertified: nothing is proved" in out
    assert "note: started from the home pose (" in out
    assert "legs" not in out.replace("squared leg lengths", "")
    words = ["solve", DELTA, "--method", "newton", "--start", "0,0,-3,1,0,0,0", "--format", "json"]
    assert main(words) == 3
    (pose,) = json.loads(capsys.readouterr().out)["poses"]
    assert pose["position"][2] == pytest.approx(-2.490163, abs=1e-5)
    assert pose["rotation"] == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (
            [DELTA, "--start", "0,0,1,1,0,0,1"],
            "leaves the motions of the robot (translations); give q1, q2 and q3 as 0",
        ),
        ([H4, "--start", "0,0,1,1,0.5,0,0"], "give q1 and q2 as 0"),
        ([DELTA, "--start", "0,0,1"], "3 numbers, but the robot is not planar"),
    ],
)
def test_a_start_outside_the_motions_is_refused(words: list[str], part: str, capsys: Capture) -> None:
    assert main(["solve", *words, "--method", "newton"]) == 2
    out, err = capsys.readouterr()
    *metric, sentence, end = err.split("\n")
    assert (out, end, len(metric)) == ("", "", int(words[0] == DELTA))
    assert sentence.startswith("certify-poses: error: ")
    assert part in sentence


def test_newton_that_fails_speaks_of_constraints(capsys: Capture) -> None:
    words = ["solve", CYLINDERS, "--method", "newton", "--start", "0,0,0,1,0,0,0"]
    assert main(words) == 4
    assert "error of a constraint: " in capsys.readouterr().err


@pytest.mark.parametrize(("model", "poses", "is_tracked"), [(DELTA, 2, True), (CYLINDERS, 8, False)])
def test_compare_holds_methods_against_a_mechanism(
    model: str, poses: int, is_tracked: bool, tmp_path: Path, capsys: Capture
) -> None:
    path = tmp_path / "compared.json"
    assert main(["compare", model, "--starts", "8", "--json", str(path)]) == 0
    out = capsys.readouterr().out
    content = json.loads(path.read_text())
    assert content["real_poses"] == poses
    names = [entry["engine"] for entry in content["engines"]]
    assert ("path tracking" in names) is is_tracked
    assert ("no paths lead to" in out) is not is_tracked
    assert all(entry["landings"]["spurious"] == 0 for entry in content["engines"])
    assert any(entry["hits"] for entry in content["engines"])


def test_paths_lead_to_as_many_forms_as_freedoms() -> None:
    assert "path tracking" in engines_for(MECHANISMS["3-RPS"][0]())
    some = Some(2)
    seven = ForwardProblem(tuple(some.distance() for _ in range(7)))
    assert "path tracking" not in engines_for(seven)
    assert solve_newton(MECHANISMS["Delta"][0]()).poses

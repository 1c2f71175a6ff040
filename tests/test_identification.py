"""What measurements can tell apart: Table 1 of the 3-RPS robot, calibration, feasible bodies, redundant sensors."""

from fractions import Fraction
from itertools import combinations
from random import Random

import pytest
from samples import solved

from pkm_exact import Distance, ForwardProblem, InputError, Robot, solve
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.reader import read_robot
from pkm_exact.identification.calibration import calibration_parameters, observation
from pkm_exact.identification.inertia import INERTIAL, feasibility, power_row
from pkm_exact.identification.observation import Identification, identify, minimal_plan
from pkm_exact.identification.sensors import line_reading, linear_method, plane_reading, point_reading, sensor_report
from pkm_exact.identification.three_rps import PARAMETERS, State, coefficient_in_side, measurements
from pkm_exact.screws.exact_matrix import Row, rank

ZERO, ONE = Fraction(0), Fraction(1)

# Table 1 of chapter 2: 25 base parameters of a 3-RPS robot with a platform of the side L, m for masses, S for sqrt(3).

LEADING = ["mx1", "my1", "Izz1", "mx2", "mz2", "Ixx3", "Ixy3", "Ixz3", "Iyy3", "Iyz3", "Izz3", "mx3", "mz3"]
LEADING += ["mx4", "my4", "Iyy5", "m5", "mx5", "mz5", "mx6", "my6", "Iyy7", "m7", "mx7", "mz7"]
MASSES = {"m2": (-ONE, 0, 2), "m3": (-ONE, 0, 2)}
TABLE = {
    "Izz1": {"Iyy2": (ONE, 0, 0)},
    "Ixx3": {"my3": (Fraction(-1, 2), 1, 1)},  # 0.3952 = L S / 2
    "Ixy3": {"my3": (Fraction(1, 2), 0, 1)},  # 0.2282 = L / 2
    "Iyy3": {"my3": (Fraction(1, 2), 1, 1), **MASSES},  # 0.2082 = L^2
    "Izz3": MASSES,
    "mx3": {"my3": (Fraction(1, 3), 1, 0), "m2": (-ONE, 0, 1), "m3": (-ONE, 0, 1)},  # 0.5774 = 1 / S, 0.4563 = L
    "Iyy5": {"Izz4": (ONE, 0, 0)},
    "m5": {"my3": (Fraction(-2, 3), 1, -1), "m2": (ONE, 0, 0), "m3": (ONE, 0, 0)},  # 2.531 = 2 / (L S)
    "Iyy7": {"Izz6": (ONE, 0, 0)},
    "m7": {"my3": (Fraction(2, 3), 1, -1)},
}
"""For each leading parameter the others of its combination with q, j, k of q S^j L^k."""

TILTS = (("-1/2", "2"), ("-1/2", "2/15"), ("-1/3", "63/40"), ("-1/4", "56/51"), ("1/2", "199/60"), ("3/4", "136/75"))
"""Tilts and heights at which, with the base radius 2, all legs have rational lengths."""


def _states(seed: int) -> list[State]:
    """States of motion, each tilt about three axes."""
    random, found = Random(seed), []
    for tilt, height in ((Fraction(t), Fraction(z)) for t, z in TILTS):
        for pose in ((tilt, ZERO), (-tilt / 2, 3 * tilt / 2), (-tilt / 2, -3 * tilt / 2)):
            speeds = [tuple(Fraction(random.randint(-5, 5)) for _ in range(3)) for _ in range(2)]
            found.append(State((*pose, height), *speeds))  # type: ignore[arg-type]
    return found


@pytest.fixture(scope="module")
def groups() -> list[tuple[Row, ...]]:
    return [measurements(state, Fraction(2), Fraction(10)) for state in _states(1)]


@pytest.fixture(scope="module")
def base(groups: list[tuple[Row, ...]]) -> Identification:
    return identify([row for group in groups for row in group], PARAMETERS, LEADING)


def test_the_3_rps_robot_has_25_base_parameters(base: Identification) -> None:
    assert base.rank == 25
    assert len(base.null_space) == 45
    assert "m1" in base.unseen
    assert set(base.seen_alone) >= {"mx1", "my1", "Ixz3", "Iyz3", "mz3", "mx7", "mz7"}


def test_table_1_with_its_coefficients_as_expressions_in_the_side(base: Identification) -> None:
    found = {}
    for row in base.base:
        pairs = [(name, value) for name, value in zip(base.parameters, row, strict=True) if value]
        leading, one = pairs[0]
        assert one == 1
        found[leading] = {name: coefficient_in_side(value, leading, name) for name, value in pairs[1:]}
    assert list(found) == LEADING
    assert {leading: others for leading, others in found.items() if others} == TABLE


def test_a_few_states_determine_as_much_as_all(groups: list[tuple[Row, ...]], base: Identification) -> None:
    plan = minimal_plan(groups, len(PARAMETERS))
    assert plan.rank == base.rank
    assert len(plan.chosen) >= 9  # three equations each
    chosen = [row for place in plan.chosen for row in groups[place]]
    assert rank(chosen, len(PARAMETERS)) == 25
    for left in plan.chosen:
        rows = [row for place in plan.chosen if place != left for row in groups[place]]
        assert rank(rows, len(PARAMETERS)) < 25


def test_robots_at_rest_determine_little() -> None:
    still = [State(state.pose, (ZERO,) * 3, (ZERO,) * 3) for state in _states(1)]
    rows = [row for state in still for row in measurements(state, Fraction(2), Fraction(10))]
    found = identify(rows, PARAMETERS, LEADING)
    assert found.rank < 15
    assert "Izz1" in found.unseen


def test_a_state_with_an_irrational_leg_is_refused() -> None:
    with pytest.raises(InputError, match="a leg has the length sqrt"):
        measurements(State((ZERO, ZERO, ONE), (ZERO,) * 3, (ZERO,) * 3), Fraction(5, 2), ZERO)


def test_the_power_of_a_body_is_that_of_its_points() -> None:
    """Inertial parameters of four point masses, and the sum of their powers."""
    random = Random(5)

    def vector() -> tuple[Fraction, ...]:
        return tuple(Fraction(random.randint(-4, 4)) for _ in range(3))

    metric = (3, 1, 2)
    virtual, acceleration = ((vector(), [vector() for _ in range(3)]) for _ in range(2))
    parameters, power = dict.fromkeys(INERTIAL, ZERO), ZERO
    for mass, point in ((Fraction(k), vector()) for k in (1, 2, 3, 4)):
        moved = [
            [a + sum(m * x for m, x in zip(row, point, strict=True)) for a, row in zip(*field, strict=True)]
            for field in (virtual, acceleration)
        ]
        power += mass * sum(g * x * y for g, x, y in zip(metric, *moved, strict=True))
        squares = [g * x * x for g, x in zip(metric, point, strict=True)]
        values = [mass, *(mass * x for x in point)]
        x, y, z = point
        values += [mass * (squares[1] + squares[2]), -mass * x * y, -mass * x * z]
        values += [mass * (squares[0] + squares[2]), -mass * y * z, mass * (squares[0] + squares[1])]
        for name, value in zip(INERTIAL, values, strict=True):
            parameters[name] += value
    row = power_row(virtual, acceleration, metric)  # type: ignore[arg-type]
    assert sum(a * b for a, b in zip(row, parameters.values(), strict=True)) == power


@pytest.mark.parametrize(
    ("parameters", "feasible"),
    [
        ((1, 0, 0, 0, 1, 0, 0, 1, 0, 1), True),
        ((1, 0, 0, 0, 1, 0, 0, 1, 0, "5/2"), False),  # positive, but beyond the triangle inequality
        ((1, 2, 0, 0, 1, 0, 0, 1, 0, 1), False),  # the centre of mass is too far out
        ((-1, 0, 0, 0, 1, 0, 0, 1, 0, 1), False),
        ((2, 2, 0, 0, 1, 0, 0, 3, 0, 3), True),
    ],
)
def test_feasible_bodies(parameters: tuple[object, ...], feasible: bool) -> None:
    assert feasibility([Fraction(value) for value in parameters]).is_feasible is feasible  # type: ignore[arg-type]


# Calibration


def _pose(x: int, y: int, half: str) -> tuple[tuple[Fraction, ...], object]:
    return (Fraction(x), Fraction(y), ZERO), rotation_of((ONE, ZERO, ZERO, Fraction(half)))


def test_calibration_of_a_planar_robot() -> None:
    robot = read_robot("models/3-rpr-merlet-p.toml")
    names = calibration_parameters(robot, offsets=False)
    poses = [_pose(x, y, t) for x, y, t in ((5, 4, "0"), (6, 3, "1/3"), (2, 9, "-1/2"), (7, 7, "2"), (1, 2, "1/5"))]
    plan = observation(robot, poses, offsets=False)  # type: ignore[arg-type]
    found = identify([row for group in plan for row in group], names)
    assert found.rank == 12
    assert found.seen_alone == names
    still = identify([row for group in plan[:1] for row in group], names)
    assert still.rank == 3
    assert len(still.confused()) == 9
    turned = observation(robot, [_pose(x, y, "0") for x, y in ((5, 4), (6, 3), (2, 9))], offsets=False)  # type: ignore[arg-type]
    level = identify([row for group in turned for row in group], names)
    # Without turning, joints of base and platform cannot be told apart.
    assert "nothing shows a change of A1x by 1, B1x by 1" in level.confused()
    assert len(minimal_plan(plan, len(names)).chosen) == 4


def test_calibration_needs_rational_lengths_for_offsets() -> None:
    robot = read_robot("models/3-rpr-merlet-p.toml")
    with pytest.raises(InputError, match="leg 1 has the length sqrt"):
        observation(robot, [_pose(5, 4, "0")], offsets=True)  # type: ignore[arg-type]
    found = observation(
        robot, [((Fraction(3), Fraction(4), ZERO), rotation_of((ONE, ZERO, ZERO, ZERO)))], offsets=False
    )
    assert len(found[0]) == 3


# Redundant sensors: chapter 7.

CUBE = [tuple(map(Fraction, c)) for c in ((0, 0, 0), (3, 0, 0), (0, 2, 0), (1, 1, 4), (2, -1, 1), (-1, 1, 2))]


def _direction(k: int) -> tuple[Fraction, ...]:
    return (Fraction(1 + k), Fraction(2 - k * k), Fraction(3 + k * k * k))


def test_nine_readings_are_needed_but_are_not_enough() -> None:
    lines = linear_method([line_reading(joint, _direction(k)) for k, joint in enumerate(CUBE)])  # type: ignore[arg-type]
    assert (lines.readings, lines.position_rank, lines.rank, lines.is_unique) == (12, 3, 9, True)
    five = linear_method([line_reading(joint, _direction(k)) for k, joint in enumerate(CUBE[:5])])  # type: ignore[arg-type]
    assert (five.readings, five.is_unique) == (10, False)
    flat = [(x, y, ZERO) for x, y, _ in CUBE]
    assert linear_method([point_reading(joint) for joint in flat]).rank == 6
    assert linear_method([point_reading(joint) for joint in CUBE[:4]]).is_unique
    planes = linear_method([plane_reading(joint, _direction(k)) for k, joint in enumerate(CUBE)])  # type: ignore[arg-type]
    assert (planes.readings, planes.rank) == (6, 3)


def test_a_fourth_length_makes_the_forward_kinematics_of_a_planar_robot_unique() -> None:
    solution = Robot.load("models/3-rpr-merlet-p.toml").solve()
    assert len(solution.poses) == 2
    aside = Distance((Fraction(30), ZERO, ZERO), (ZERO,) * 3, ONE)
    report = sensor_report(solution, aside)
    assert report.is_unique
    assert report.gap > 0
    again = Distance(solution.problem.distances[0].base, solution.problem.distances[0].platform, ONE)
    useless = sensor_report(solution, again)
    assert not useless.is_unique
    assert useless.confused == ((2,), (1,))


def test_a_seventh_length_makes_the_forward_kinematics_of_a_general_hexapod_unique() -> None:
    solution = solved("mourrain-l")
    assert len(solution.poses) > 1
    far = max(abs(x) for leg in solution.problem.distances for x in leg.base)
    wire = Distance((3 * far, ZERO, far), (far, 2 * far, ZERO), ONE)
    report = sensor_report(solution, wire)
    assert report.is_unique
    assert report.gap > 0


def test_four_lengths_of_a_planar_robot_leave_one_pose_exactly() -> None:
    """Seven lengths of a spatial one likewise: the engine takes more legs than freedoms."""
    robot = read_robot("models/3-rpr-merlet-p.toml")
    place, turn = _pose(5, 4, "1/3")
    problem = robot.problem(robot.configuration())
    legs = [(leg.base, leg.platform) for leg in problem.distances]
    legs.append(((Fraction(9), Fraction(-7), ZERO), (Fraction(2), Fraction(5), ZERO)))
    found = []
    for a, b in legs:
        arm = [
            c + sum(r * x for r, x in zip(row, b, strict=True)) - y for c, row, y in zip(place, turn, a, strict=True)
        ]  # type: ignore[call-overload]
        found.append(Distance(a, b, sum((x * x for x in arm), ZERO)))
    three, four = (ForwardProblem(tuple(found[:n]), motion=problem.motion) for n in (3, 4))
    assert len(solve(three).poses) > 1
    assert len(solve(four).poses) == 1
    assert str(solve(four).claim) == "complete"


# Failures: chapter 3.


def test_failures_of_an_orthogonal_platform_with_two_groups_of_four() -> None:
    from pkm_exact.mobility.leg_failures import relative_manipulability

    x, y = Fraction(2), Fraction(1)
    rows = []
    for s, c, u, v in ((Fraction(4, 5), Fraction(3, 5), x, y), (Fraction(3, 5), Fraction(4, 5), -x * 4 / 3, -y)):
        for cb, sb in ((1, 0), (0, 1), (-1, 0), (0, -1)):
            force = (s * cb, s * sb, c)
            moment = (u * sb + v * c * cb, -u * cb + v * c * sb, -v * s)
            assert sum(a * b for a, b in zip(force, moment, strict=True)) == 0
            rows.append((*force, *moment))
    gram = [[sum(row[i] * row[j] for row in rows) for j in range(6)] for i in range(6)]
    assert all(gram[i][j] == 0 for i, j in combinations(range(6), 2))
    one, two = relative_manipulability(rows, 1), relative_manipulability(rows, 2)
    assert set(one.values()) == {Fraction(1, 4)}
    assert sum(one.values()) == 2
    same = {pair: square for pair, square in two.items() if (pair[0] <= 4) == (pair[1] <= 4)}
    assert (len(same), set(same.values())) == (12, {ZERO})
    assert {square for pair, square in two.items() if pair not in same} == {Fraction(1, 16)}
    assert sum(two.values()) == 1
    assert set(relative_manipulability(rows, 3).values()) == {ZERO}
    with pytest.raises(InputError, match="singular with all"):
        relative_manipulability([*rows[:4], *rows[:4]], 1)

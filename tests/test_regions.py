"""Regions: answers against sampled poses, exact counterexamples, published numbers, and the words of questions."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import cos, pi, radians, sin, sqrt
from pathlib import Path
from random import Random

import numpy as np
import pytest
from flint import Ordering, fmpq, fmpq_mpoly_ctx
from hypothesis import given
from hypothesis import strategies as st
from samples import MODELS, model

from pkm_exact import InputError, Robot
from pkm_exact.cli.main import main
from pkm_exact.cli.region_report import as_text
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.geometry.rotation_degrees import half_turn_pair
from pkm_exact.pictures.region_figure import region_figure
from pkm_exact.pictures.region_surface import surface
from pkm_exact.regions.bernstein import bernstein_coefficients, error_factor, on_sub_boxes, subdivision_matrices
from pkm_exact.regions.chart import Chart
from pkm_exact.regions.compiled_formula import compiled_formula
from pkm_exact.regions.formula import Atom, Sign
from pkm_exact.regions.largest_region import largest
from pkm_exact.regions.paving import halving_axes, leaves
from pkm_exact.regions.placed_legs import PlacedLeg
from pkm_exact.regions.question_reader import of_size, question_from_toml
from pkm_exact.regions.region_components import components
from pkm_exact.regions.region_conditions import Conditions, asked_of, turned_within
from pkm_exact.regions.region_legs import OnCrank, RegionLeg, RegionMachine, region_machine
from pkm_exact.regions.region_points import PointJudge
from pkm_exact.regions.region_solver import RegionAnswer, answered
from pkm_exact.regions.region_workers import workers

Capture = pytest.CaptureFixture[str]
FILES = {path.stem: path for path in MODELS}
ZERO, ONE = Fraction(0), Fraction(1)


def asked(machine: RegionMachine, region: str, conditions: str, answer: str = 'kind = "all"') -> RegionAnswer:
    """The answer to a question, by the lines of its tables."""
    text = f"[region]\n{region}\n[conditions]\n{conditions}\n[answer]\n{answer}\n"
    return answered(machine, question_from_toml(text, machine))


def delta(rod: str, arm: str, radius: str) -> RegionMachine:
    """A rotary Delta, in the metric of the triangle."""
    l1, l2, r = map(Fraction, (rod, arm, radius))
    half = Fraction(1, 2)
    radial = ((ONE, ZERO), (-half, half), (-half, -half))
    legs = tuple(
        RegionLeg(
            f"rod {k}",
            (r * x, r * y, ZERO),
            (ZERO,) * 3,
            OnCrank((l2 * x, l2 * y, ZERO), (ZERO, ZERO, l2), 1, l1 * l1),
        )
        for k, (x, y) in enumerate(radial, 1)
    )
    return RegionMachine("Delta", "1", "an example", (1, 3, 1), "translation", (0, 1, 2), legs)


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=6), st.integers(0, 63))
def test_coefficients_on_parts_are_those_of_the_polynomial(coefficients: list[int], place: int) -> None:
    """In doubles they differ by no more than is said, and the exact ones have the ends' values."""
    degree = len(coefficients) - 1
    terms = {(k,): fmpq(c) for k, c in enumerate(coefficients)}
    whole = bernstein_coefficients(terms, [degree], [(ZERO, ONE)])
    low, high = Fraction(place, 64), Fraction(place + 1, 64)
    exact = bernstein_coefficients(terms, [degree], [(low, high)])
    assert exact[0] == sum(c * low**k for k, c in enumerate(coefficients))
    assert exact[-1] == sum(c * high**k for k, c in enumerate(coefficients))
    matrix = subdivision_matrices(degree, np.array([float(low)]), np.array([float(high)]))
    found = on_sub_boxes(np.array([float(b) for b in whole]), [matrix], first=0)[0]
    bound = Fraction(error_factor([degree])) * max(map(abs, whole))
    assert all(abs(Fraction(x) - y) <= bound for x, y in zip(found.tolist(), exact, strict=True))


def _distances(name: str, x: Sequence[float], turn: np.ndarray) -> list[float]:
    robot = model(name)
    return [
        float(np.linalg.norm(np.array(x) + turn @ np.array(b, dtype=float) - np.array(a, dtype=float)))
        for a, b in zip(robot.base_joints, robot.platform_joints, strict=True)
    ]


def _rpy(roll: float, pitch: float, yaw: float) -> np.ndarray:
    (cx, sx), (cy, sy), (cz, sz) = ((cos(a), sin(a)) for a in map(radians, (roll, pitch, yaw)))
    x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    z = np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]])
    return z @ y @ x


@pytest.mark.slow
def test_lengths_of_a_hexapod_with_angles_that_vary(tmp_path: Path) -> None:
    """Least and greatest lengths over random poses: just wider limits are proved, narrower ones refuted."""
    random, name = Random(7), "mourrain-l"
    found = []
    for _ in range(400):
        x = [random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.9, 1.1)]
        found.append(_distances(name, x, _rpy(random.uniform(-10, 10), random.uniform(-10, 10), 0)))
    least, greatest = np.min(found), np.max(found)
    region = "position = [[-0.1, 0.1], [-0.1, 0.1], [0.9, 1.1]]\nrpy_degrees = [[-10, 10], [-10, 10], 0]"
    for factor, verdict in ((1.1, True), (0.9, False)):
        middle, half = (least + greatest) / 2, (greatest - least) / 2 * factor
        path = tmp_path / "model.toml"
        table = f"[limits]\nlengths = [{middle - half:.6f}, {middle + half:.6f}]\n[[configurations]]"
        path.write_text(FILES[name].read_text().replace("[[configurations]]", table, 1))
        answer = asked(region_machine(Robot.load(path)), region, "limits = true", 'kind = "all"\nsteps = 9')
        assert answer.is_proved is verdict
        assert (answer.counterexample is None) is verdict


def test_the_determinant_is_that_of_the_legs() -> None:
    """Its sign at rational poses is that of numpy's, for legs, slides and cranks in their working modes."""
    random = Random(3)
    for name in ("rolland-6-6", "hexaglide", "hexa", "3-rpr-merlet-p", "3-prr", "3-rrr"):
        machine = region_machine(model(name))
        planar = machine.motion == "planar"
        for _ in range(4):
            modes = tuple(random.choice((1, -1)) for _ in machine.legs)
            quaternion = (ONE, ZERO, ZERO, Fraction(random.randint(-9, 9), 40))
            if not planar:
                quaternion = tuple(Fraction(random.randint(-9, 9), 40) if k else ONE for k in range(4))  # type: ignore[assignment]
            size = max(abs(x) for leg in machine.legs for x in leg.base)
            middle = [size * Fraction(random.randint(-3, 3), 20) for _ in range(2)]
            middle.append(ZERO if planar else size * Fraction(random.randint(10, 14), 10))
            chart = Chart(("x", *middle[1:]), quaternion, (), ("x",), ((middle[0], middle[0] + 1),))
            question = asked_of(machine, chart, Conditions(("no_type_2",), modes))
            judge = PointJudge(question, question.formula)
            rows, reached = _rows(machine, middle, quaternion, modes)
            sign = judge.determinant_sign((middle[0],))
            values = np.linalg.svd(rows / np.linalg.norm(rows, axis=0), compute_uv=False)
            assert sign == (np.sign(np.linalg.det(rows)) if reached else 0) or values[-1] < 1e-10 * values[0]


def _rows(
    machine: RegionMachine, c: Sequence[Fraction], quaternion: Sequence[Fraction], modes: Sequence[int]
) -> tuple[np.ndarray, bool]:
    g = np.sqrt(np.array(machine.metric, dtype=float))
    rotation = np.array(rotation_of(tuple(quaternion), machine.metric), dtype=float)  # type: ignore[arg-type]
    rotation = rotation * g[:, None] / g
    rows, reached = [], True
    for leg, mode in zip(machine.legs, modes, strict=True):
        arm = rotation @ (np.array(leg.platform, dtype=float) * g)
        tip, knee = np.array(c, dtype=float) * g + arm, np.array(leg.base, dtype=float) * g
        e, actuator = tip - knee, leg.actuator
        if hasattr(actuator, "direction"):
            d = np.array(actuator.direction, dtype=float) * g
            square = (d @ e) ** 2 - d @ d * (e @ e - float(actuator.rod_squared))
            reached &= bool(square >= 0)
            knee = knee + (d @ e + mode * sqrt(max(square, 0))) / (d @ d) * d
        elif hasattr(actuator, "at_0"):
            u, v = np.array(actuator.at_0, dtype=float) * g, np.array(actuator.at_90, dtype=float) * g
            a, p, h = 2 * u @ e, 2 * v @ e, e @ e + u @ u - float(actuator.rod_squared)
            square = a * a + p * p - h * h
            reached &= bool(square >= 0)
            y, m = sqrt(max(square, 0)), a * a + p * p
            knee = knee + (a * h - mode * p * y) / m * u + (p * h + mode * a * y) / m * v
            if square >= 0:
                assert abs((tip - knee) @ (tip - knee) - float(actuator.rod_squared)) < 1e-6 * float(
                    actuator.rod_squared
                )
        rod = tip - knee
        wrench = np.concatenate([rod, np.cross(arm, rod)])
        rows.append([wrench[k] for k in machine.twist])
    return np.array(rows), reached


@pytest.mark.parametrize(
    ("design", "height"),
    [(("2.66", "1.73", "1.74"), "1.01"), (("2.5", "1.91", "1.48"), "1.02"), (("2.5", "1.719", "1.48"), "1.02")],
)
def test_the_printed_deltas_reach_all_of_their_cubes(design: tuple[str, str, str], height: str) -> None:
    """Laribi, Romdhane and Zeghloul, tables 3 and 4; the latter also with arms that are a tenth shorter."""
    top = Fraction(height) + 2
    region = f"position = [[-1, 1], [-1, 1], [{height}, {float(top)}]]"
    answer = asked(delta(*design), region, "reachable = true")
    assert answer.is_proved
    assert answer.question.enlarged


def test_the_printed_delta_reaches_all_of_its_prism() -> None:
    """Table 6, with a height of 2 and a corner at the azimuth of the first arm."""
    region = "prism = { sides = 6, radius = 1, height = [1.67, 3.67] }"
    assert asked(delta("3.32", "1.4", "1.95"), region, "reachable = true").is_proved


def test_a_cube_whose_corners_are_reached_is_not_reached_in_the_middle() -> None:
    machine = delta("2.45808", "0.97868", "0")
    region = "position = [[-1, 1], [-1, 1], [1, 3]]"
    answer = asked(machine, region, "reachable = true")
    assert answer.counterexample is not None
    ((x, y, z),) = answer.counterexample.points
    l1, l2 = Fraction("2.45808"), Fraction("0.97868")
    for a, b in ((ONE, ZERO), (Fraction(-1, 2), Fraction(1, 2)), (Fraction(-1, 2), Fraction(-1, 2))):
        radial = x * a + 3 * y * b
        square = x * x + 3 * y * y + z * z
        h = (square + l2 * l2 - l1 * l1) ** 2 - 4 * l2 * l2 * (radial * radial + z * z)
        if h > 0:
            break
    else:
        pytest.fail("the counterexample is reached")
    question = question_from_toml(
        f"[region]\n{region}\n[conditions]\nreachable = true\n[answer]\nkind = 'map'\nsteps = 15\n", machine
    )
    found = answered(machine, question)
    assert found.shares["outside"] < Fraction(17, 100) < found.shares["outside"] + found.shares["undecided"]
    judge = PointJudge(
        asked_of(machine, question.chart, question.conditions),
        asked_of(machine, question.chart, question.conditions).formula,
    )
    assert judge.failing((ZERO, ZERO, ONE)) is not None


def test_a_disc_has_its_area_and_a_ring_one_piece() -> None:
    """Two legs would do; of three, two are never too short or too long."""
    text = FILES["3-rpr-merlet-p"].read_text()
    table = "[limits]\nlengths = [[3, 5], [0, 99], [0, 99]]\n[[configurations]]"
    from pkm_exact.geometry.reader import robot_from_toml

    machine = region_machine(robot_from_toml(text.replace("[[configurations]]", table, 1)))
    region = "position = [[-6, 6], [-6, 6]]\ndegrees = 0"
    answer = asked(machine, region, "limits = true", "kind = 'map'\nsteps = 14")
    assert answer.measures is not None
    low, high = map(float, answer.measures)
    assert low < pi * 16 < high < low + 10
    assert components(answer).separated == 1
    small = asked(
        machine, "ball = { center = [0, 0], radius = 4 }\ndegrees = 0", "limits = true", "kind = 'map'\nsteps = 14"
    )
    assert small.measures is not None
    assert float(small.measures[0]) < pi * 7 < float(small.measures[1])


def test_two_pieces_are_separated() -> None:
    text = FILES["3-rpr-merlet-p"].read_text()
    table = "[limits]\nlengths = [[0, 6], [0, 8], [0, 99]]\nposition = [[-99, 99], [-99, 99]]\n[[configurations]]"
    from pkm_exact.geometry.reader import robot_from_toml

    machine = region_machine(robot_from_toml(text.replace("[[configurations]]", table.replace("[0, 6]", "[5, 6]"), 1)))
    region = "position = [[-7, 7], [-7, 7]]\ndegrees = 0"
    assert components(asked(machine, region, "limits = true", "kind = 'map'\nsteps = 12")).separated == 1
    table = table.replace("lengths = [[0, 6], [0, 8]", "lengths = [[5, 6], [5, 6]")
    machine = region_machine(robot_from_toml(text.replace("[[configurations]]", table, 1)))
    found = components(asked(machine, region, "limits = true", "kind = 'map'\nsteps = 14"))
    assert (found.separated, found.connected) == (2, 2)


def test_parts_are_decided_rightly_everywhere() -> None:
    """In every part of a map random poses are as the part says; together the parts are the whole region."""
    random, machine = Random(1), region_machine(model("3-rrr"))
    question = question_from_toml(
        "[region]\nposition = [[0, 12], [-2, 10]]\ndegrees = 20\n".replace("degrees = 20", "degrees = 0")
        + "[conditions]\nno_type_1 = true\nno_type_2 = true\nworking_modes = ['+', '+', '-']\n"
        + "[answer]\nkind = 'map'\nsteps = 10\n",
        machine,
    )
    answer = answered(machine, question)
    assert sum(answer.shares.values()) == 1
    chart = question.chart
    seen = set()
    for letter, part in leaves(answer.word, answer.axes, 2):
        depths = [sum(axis == k for axis in answer.axes[: part.depth]) for k in range(2)]
        point = [
            low + (high - low) * (place + Fraction(random.randint(0, 64), 64)) / 2**depth
            for (low, high), place, depth in zip(chart.box, part.places, depths, strict=True)
        ]
        rows, reached = _rows(machine, [*point, ZERO], (ONE, ZERO, ZERO, ZERO), question.conditions.modes)
        assert letter == "u" or reached is (letter == "i")
        seen.add((letter, bool(reached and np.linalg.det(rows) > 0)))
    assert {letter for letter, _ in seen} == {"i", "o", "u"}


def test_a_singularity_is_refuted_by_two_poses() -> None:
    machine = region_machine(model("3-rpr-merlet-p"))
    answer = asked(machine, "position = [['1/7', '43/7'], ['1/7', '57/7']]\ndegrees = [-50, -3]", "no_type_2 = true")
    assert answer.counterexample is not None
    one, other = answer.counterexample.points
    judge = _judge(machine, answer)
    assert judge.determinant_sign(one) == -judge.determinant_sign(other) != 0


def _judge(machine: RegionMachine, answer: RegionAnswer) -> PointJudge:
    found = asked_of(machine, answer.question.chart, answer.question.conditions)
    return PointJudge(found, found.formula)


def test_the_largest_cube_about_a_pose() -> None:
    """To one part in a thousand: the next one is refuted."""
    machine = region_machine(model("rolland-6-6"))
    text = (
        "[region]\nrpy_degrees = [0, 0, 0]\n[conditions]\nno_type_2 = true\n"
        "[answer]\nkind = 'largest'\nshape = 'cube'\nabout = [0, 0, 770]\nprecision = '1/1000'\n"
    )
    question = question_from_toml(text, machine)
    answer = largest(machine, question, lambda size: of_size(question, machine, size))
    assert answer.refused is not None
    assert answer.refused_size is not None
    assert answer.refused.counterexample is not None
    assert answer.size < answer.refused_size <= answer.size * Fraction(1001, 1000)
    ball = question_from_toml(text.replace("cube", "ball"), machine)
    inner = largest(machine, ball, lambda size: of_size(ball, machine, size))
    assert answer.size / 2 <= inner.size < answer.size


RRR = "[region]\nposition = [[0, 12], [-2, 10]]\ndegrees = 0\n[conditions]\n"


def test_workers_give_the_same_words() -> None:
    machine = region_machine(model("3-rrr"))
    text = f"{RRR}no_type_1 = true\n[answer]\nkind = 'map'\nsteps = 10\n"
    question = question_from_toml(text, machine)
    alone = answered(machine, question)
    with workers(machine, 2) as run:
        assert answered(machine, question, run=run) == alone


class _Kept:
    def __init__(self, records: list[dict[str, object]]) -> None:
        self.records = records

    def add(self, record: dict[str, object]) -> None:
        self.records.append(record)


def test_what_was_done_is_not_done_again() -> None:
    machine = region_machine(model("3-rrr"))
    text = f"{RRR}reachable = true\n[answer]\nkind = 'map'\nsteps = 9\n"
    question = question_from_toml(text, machine)
    store = _Kept([])
    whole = answered(machine, question, store=store)
    done = len(store.records)
    half = _Kept(store.records[: done // 2])
    assert answered(machine, question, store=half) == whole
    assert len(half.records) == done


TAIL = "\n[conditions]\nlimits = true\n[answer]\nkind = 'all'"
ANSWER = "[region]\n[conditions]\nlimits = true\n[answer]\n"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "region: is missing"),
        ("region = 3", "region: is missing or no table"),
        ("[region]\n[conditions]\n[answer]\n[other]", "unknown key 'other'"),
        ("[region]\n[conditions]\n[answer]", "conditions: nothing is asked"),
        ("[region]\n[conditions]\nlimits = 1\n[answer]", "conditions.limits: 1 is neither true nor false"),
        ("[region]\n[conditions]\nlimits = true\nworking_modes = ['+']\n[answer]", "give 3 signs"),
        (ANSWER, "answer.kind: is missing"),
        (f"{ANSWER}kind = 'x'", "'x' is unknown"),
        (f"{ANSWER}kind = 'all'\nsteps = 0", "answer.steps: 0 is out of range"),
        (f"{ANSWER}kind = 'all'\nshape = 'cube'", "belongs to the kind largest"),
        (f"{ANSWER}kind = 'largest'", "answer.shape: is missing"),
        (f"[region]{TAIL}", "region: no shape given"),
        (f"[region]\nposition = [1, 2]{TAIL}", "no orientation given"),
        (f"[region]\nposition = [1, 2]\ndegrees = 0{TAIL}", "a single pose"),
        (f"[region]\nposition = [1]\ndegrees = 0{TAIL}", "1 entries; give 2"),
        (f"[region]\nposition = [[2, 1], 0]\ndegrees = 0{TAIL}", "2 is not less than 1"),
        (f"[region]\nposition = [[0, 1], 0]\ndegrees = 20{TAIL}", "a turn by 20 degrees"),
        (f"[region]\nposition = [[0, 1], 0]\ndegrees = [0, 180]{TAIL}", "reaches 180"),
        (f"[region]\nposition = [[0, 1], 0]\nquaternion = [1, 0, 0, 0]{TAIL}", "not for this robot"),
        (f"[region]\ncylinder = {{}}\ndegrees = 0{TAIL}", "the robot is planar"),
        (f"[region]\nball = {{ center = [0, 0], radius = 0 }}\ndegrees = 0{TAIL}", "0 is not positive"),
    ],
)
def test_a_question_that_is_none_is_refused_in_one_sentence(text: str, said: str) -> None:
    with pytest.raises(InputError) as error:
        question_from_toml(text, region_machine(model("3-rpr-merlet-p")))
    assert said in str(error.value)


def test_working_modes_are_asked_for_where_they_matter() -> None:
    machine = region_machine(model("3-rrr"))
    with pytest.raises(InputError, match="leg 1 has two working modes"):
        asked(machine, "position = [[0, 1], [0, 1]]\ndegrees = 0", "no_type_2 = true")


def test_a_mechanism_may_not_leave_what_its_joints_allow() -> None:
    machine = region_machine(model("2-ups-u"))
    with pytest.raises(InputError, match="joints of the mechanism allow"):
        asked(machine, "position = [0, 0, 0]\nrpy_degrees = [[-9, 9], [-9, 9], [-9, 9]]", "no_type_2 = true")
    region = "position = [0, 0, 0]\nrpy_degrees = [[-9, 9], [-9, 9], 0]"
    assert asked(machine, region, "no_type_2 = true").is_proved


def test_the_command(tmp_path: Path, capsys: Capture) -> None:
    question = tmp_path / "question.toml"
    lines = "[region]\nposition = [[4, 6], [4, 6]]\ndegrees = 0\n[conditions]\nno_type_2 = true\n[answer]\n"
    question.write_text(lines + "kind = 'all'\n")
    path = str(FILES["3-rpr-merlet-p"])
    assert main(["region", path, str(question)]) == 0
    assert "proved: all poses of the region are good" in capsys.readouterr().out
    assert main(["region", path, str(question), "--format", "json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert (content["verdict"], content["variables"]) == ("proved", ["x", "y"])
    question.write_text(lines.replace("[4, 6]", "[-9, 9]") + "kind = 'map'\nsteps = 9\n")
    pytest.importorskip("matplotlib")
    picture = tmp_path / "map.svg"
    assert main(["region", path, str(question), "--picture", str(picture)]) == 0
    assert "area of what is good: between" in capsys.readouterr().out
    assert picture.stat().st_size > 1000
    question.write_text(lines.replace("[4, 6]", "[-9, 9]") + "kind = 'all'\nsteps = 1\nboxes = 1\n")
    assert main(["region", path, str(question)]) in (0, 3)
    question.write_text("nothing")
    assert main(["region", path, str(question)]) == 2


def test_the_surface_of_what_is_inside_encloses_its_volume() -> None:
    """Exactly, along every axis: the sum of coordinate times area of its faces, lower ones negative."""
    region = "position = [[-2, 2], [-2, 2], ['1/5', 4]]"
    answer = asked(delta("2.45808", "0.97868", "0"), region, "reachable = true", "kind = 'map'\nsteps = 12")
    assert 0 < answer.shares["inside"] < 1
    volumes = [ZERO] * 3
    for axis, is_upper, box in surface(answer):
        width = [high - low for low, high in box]
        assert width[axis] == 0
        area = width[axis - 1] * width[axis - 2]
        assert area > 0
        volumes[axis] += (1 if is_upper else -1) * box[axis][0] * area
    assert set(volumes) == {answer.shares["inside"]}


def test_a_region_of_three_variables_is_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    region = "position = [[-2, 2], [-2, 2], ['1/5', 4]]"
    answer = asked(delta("2.45808", "0.97868", "0"), region, "reachable = true", "kind = 'map'\nsteps = 9")
    figure = region_figure(answer)
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == ["z = 2.1", "y = 0", "x = 0", "inside"]
    (faces,) = figure.axes[-1].collections
    assert faces.get_facecolors().shape[0] == len(surface(answer))


def test_parts_end_where_doubles_hold_their_ends() -> None:
    """Ends of parts are k / 2^52 of the region at the finest, and integers of 64 bits count them."""
    axes = halving_axes([ONE, Fraction(1, 4)], 120)
    assert (axes.count(0), axes.count(1)) == (52, 51)
    assert halving_axes([ONE], 120) == (0,) * 52


@pytest.mark.parametrize("more", ["0", "1e-11", "-1e-11", "1", "-1"])
def test_a_range_of_half_a_turn_is_decided_on_the_safe_side(more: str) -> None:
    """From 10 degrees to about 190: nothing false of a crank beside an end, and all that is far from it decided."""
    low, high = Fraction(10), 190 + Fraction(more)
    crank = OnCrank((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), 1, ONE)
    leg = RegionLeg("leg", (ZERO,) * 3, (ZERO,) * 3, crank, (low, high))
    machine = RegionMachine("made up", "m", "made up", (1, 1, 1), "translation", (0, 1, 2), (leg,))
    chart = Chart(("x", ZERO, ZERO), (ONE, ZERO, ZERO, ZERO), (), ("x",), ((ONE, Fraction(3, 2)),))
    question = asked_of(machine, chart, Conditions(("limits",), (1,)))
    for end, way in ((low, 1), (high, -1)):
        for beside in ("-3", "-1e-10", "-1e-11", "-1e-12", "1e-12", "1e-11", "1e-10", "3"):
            c, s = half_turn_pair(end + way * Fraction(beside), Fraction(1, 10**20))
            cosine, sine = (question.pose.constant(x) for x in (c * c - s * s, 2 * c * s))
            formula = turned_within(PlacedLeg(leg, [], [], (cosine, sine)), low, high)
            judge = PointJudge(replace(question, formula=formula), formula)
            is_kept, point = Fraction(beside) > 0, (ONE,)
            assert not (judge.is_inside(point) and not is_kept)
            assert not (judge.failing(point) is not None and is_kept)
            if abs(Fraction(beside)) > 1:
                assert judge.is_inside(point) is is_kept
                assert (judge.failing(point) is None) is is_kept


@pytest.mark.parametrize(
    ("name", "region", "is_wider"),
    [
        ("3-rpr-merlet-p", "position = [[4, 6], 5]\ndegrees = [-90, 0]", False),
        ("3-rpr-merlet-p", "position = [[4, 6], 5]\ndegrees = [-90, 1]", True),
        ("3-rpr-merlet-p", "arc = { center = [5, 5], radius = 1, degrees = [90, 180] }\ndegrees = 0", False),
        ("3-rpr-merlet-p", "arc = { center = [5, 5], radius = 1, degrees = [90, 170] }\ndegrees = 0", True),
        ("rolland-6-6", "position = [0, 0, [700, 701]]\nrpy_degrees = [0, [-90, 90], 0]", False),
        ("rolland-6-6", "position = [0, 0, [700, 701]]\nrpy_degrees = [0, 0, [0, 30]]", True),
        ("mssm", "position = [0, 0, [9, 10]]\nrpy_degrees = [0, 0, [0, 90]]", True),
    ],
)
def test_angles_that_are_rounded_outward_are_said(name: str, region: str, is_wider: bool) -> None:
    text = f"[region]\n{region}\n[conditions]\nreachable = true\n[answer]\nkind = 'all'\n"
    assert question_from_toml(text, region_machine(model(name))).enlarged is is_wider


def test_the_largest_ball_says_that_angles_are_rounded() -> None:
    machine = region_machine(model("3-rpr-merlet-p"))
    text = "[region]\ndegrees = [0, 1]\n[conditions]\nno_type_2 = true\n[answer]\nkind = 'largest'\nshape = 'ball'\n"
    question = question_from_toml(f"{text}about = [5, 5]\nprecision = 1\n", machine)
    found = largest(machine, question, lambda size: of_size(question, machine, size))
    assert "enlarged by less than 2^-40" in as_text(found)


def test_limits_that_a_model_has_not_are_not_kept_in_silence() -> None:
    machine = region_machine(model("3-rpr-merlet-p"))
    with pytest.raises(InputError, match=r"the model has no limits; give it a table \[limits\]"):
        asked(machine, "position = [[0, 1], [0, 1]]\ndegrees = 0", "limits = true")


@pytest.mark.parametrize(("kind", "count"), [("map", 4), ("all", 1)])
def test_a_determinant_that_is_0_everywhere_is_answered(kind: str, count: int) -> None:
    """On the line of two base joints the legs of this robot, not turned, meet in a point."""
    machine = region_machine(model("3-rpr-merlet-p"))
    answer = asked(
        machine,
        "position = [[-1, 1], 0]\ndegrees = 0",
        "no_type_2 = true",
        f'kind = "{kind}"\nsteps = {2 if kind == "map" else 1}',
    )
    assert not answer.is_proved
    assert (answer.counterexample is None) is (kind == "map")
    assert answer.word.count("i") == 0
    assert kind == "all" or answer.word.count("u") == count


def test_coefficients_that_doubles_do_not_reach_are_not_0() -> None:
    """-10^-400 beside a root that is 0: nothing proves that it is not negative."""
    ring = fmpq_mpoly_ctx.get(("x", "y0"), Ordering.lex)
    y = ring.gens()[1]
    atom = Atom("made up", y - fmpq(1, 10**400), Sign.NOT_NEGATIVE)
    ready = compiled_formula(atom, [atom], [ring.constant(fmpq(-1))], [(ZERO, ONE)])
    assert ready.truths([0], np.zeros((1, 1), dtype=np.int64)).tolist() != [1]

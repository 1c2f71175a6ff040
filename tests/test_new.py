"""First models by ``certify-poses new``: exact, solved, at home where they say, and never over another file."""

import math
import os
import re
import shlex
import subprocess
import sys
import tomllib
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest
from budgets import budget
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from pkm_exact import solve
from pkm_exact.claim import Claim
from pkm_exact.cli import new as new_module
from pkm_exact.cli.main import main
from pkm_exact.cli.new import new
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank
from pkm_exact.geometry.inverse import dot
from pkm_exact.geometry.kinds import KINDS
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.robot import Robot, jointed
from pkm_exact.solution import Solution
from pkm_exact.templates.design import Design, Draft, drawn, has_cranks
from pkm_exact.templates.layout import rounded_root, sides_on_circle
from pkm_exact.templates.model_text import model_text, toml_number

Capture = pytest.CaptureFixture[str]
SPATIAL = ["--base-sides", "400,200", "--platform-sides", "100,300", "--height", "500"]
CIRCLES = ["--kind", "6-6", "--base-circle", "150,20", "--platform-circle", "100,24", "--height", "220"]
CIRCLES += ["--platform-shift", "60"]
PLANAR = ["--base-sides", "600,500,500", "--platform-sides", "160,100,100", "--height", "300"]
SIDES = st.integers(0, 12).map(lambda k: Fraction(50 * k))


def _options(kind: str) -> list[str]:
    crank = ["--crank", "150"] if has_cranks(kind) else []
    return ["--kind", kind, *(PLANAR if KINDS[kind].motion.is_planar else SPATIAL), *crank]


def _design(kind: str, digits: int | None = None) -> Design:
    numbers = dict(zip(_options(kind)[::2], _options(kind)[1::2], strict=True))
    sides = [tuple(map(Fraction, numbers[f"--{part}-sides"].split(","))) for part in ("base", "platform")]
    crank = Fraction(numbers["--crank"]) if "--crank" in numbers else None
    return Design(kind, sides[0], sides[1], Fraction(numbers["--height"]), crank, digits)


def _robot(design: Design) -> tuple[Robot, Draft]:
    draft = drawn(design)
    return robot_from_toml(model_text(draft, "r", "mm")), draft


def _is_at_home(draft: Draft, solution: Solution) -> bool:
    """Whether one of the boxes holds the home pose: ordinary coordinates, compared by squares with their signs."""
    w = draft.metric[0] * draft.metric[1]
    t = draft.half_tangent
    cosine, sine = (1 - w * t * t) / (1 + w * t * t), 2 * t / (1 + w * t * t)

    def signed(x: Fraction) -> Fraction:
        return x * abs(x)

    return any(
        all(
            signed(c.lo) <= g * signed(number) <= signed(c.hi)
            for c, number, g in zip(pose.position, draft.position, draft.metric, strict=True)
        )
        and signed(pose.rotation[0][0].lo) <= signed(cosine) <= signed(pose.rotation[0][0].hi)
        and signed(pose.rotation[1][0].lo) <= w * signed(sine) <= signed(pose.rotation[1][0].hi)
        and pose.rotation[2][2].lo <= 1 <= pose.rotation[2][2].hi
        for pose in solution.poses
    )


ROUNDED = [
    kind if motion.is_planar else pytest.param(kind, marks=pytest.mark.slow)
    for kind, motion in ((kind, KINDS[kind].motion) for kind in KINDS)
]


@pytest.mark.parametrize("kind", ROUNDED)
def test_every_coordinate_is_ordinary_unless_exact_joints_are_asked_for(
    kind: str, tmp_path: Path, capsys: Capture
) -> None:
    """Joints from a drawing can take the place of those in the file: no metric is left that would scale them."""
    path = tmp_path / "my-robot.toml"
    isosceles = ["--base-sides", "6,6,6", "--platform-sides", "1,2,2"] if KINDS[kind].motion.is_planar else []
    assert main(["new", *_options(kind), *isosceles, "-o", str(path)]) == 0
    assert capsys.readouterr().err == ""
    assert "metric" not in tomllib.loads(path.read_text())
    assert "hexagon" not in path.read_text()
    assert read_robot(path).metric == (1, 1, 1)
    exact, _ = _robot(_design(kind)) if not isosceles else (None, None)
    if exact is not None:
        for side in ("base_joints", "platform_joints"):
            for joint, wanted in zip(getattr(read_robot(path), side), getattr(exact, side), strict=True):
                for x, y, g in zip(joint, wanted, exact.metric, strict=True):
                    assert abs(float(x) - math.sqrt(g) * float(y)) <= 0.6e-6


@pytest.mark.parametrize("kind", KINDS)
def test_the_file_of_every_kind_is_solved_as_written(kind: str, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "my-robot.toml"
    assert main(["new", *_options(kind), "--exact", "-o", str(path)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    robot = read_robot(path)
    assert (robot.name, robot.kind, robot.unit) == ("my-robot", kind, "mm")
    solution = solve(robot.problem(robot.configuration("home")))
    assert solution.claim is Claim.COMPLETE
    assert _is_at_home(drawn(_design(kind)), solution)
    real, complex_ = len(solution.poses), solution.complex_solutions
    assert f"{kind}, home: {real} real poses of {complex_} complex ones, proved complete\nnext: certify-poses" in out


@pytest.mark.parametrize("kind", KINDS)
def test_every_line_is_explained(kind: str) -> None:
    """Each key has a comment on its line or right above it."""
    text = model_text(drawn(_design(kind)), "r", "mm")
    above = ""
    for line in text.split("\n"):
        if re.match(r"[a-z_0-9]+ = ", line) and not line.startswith(("name", "pose")):
            assert "# " in line or above.startswith("#"), line
        above = line


@pytest.mark.parametrize("digits", [None, 3])
@pytest.mark.parametrize("kind", KINDS)
def test_what_stands_in_comments_holds_too(kind: str, digits: int | None) -> None:
    """The joints written out are those of the hexagon, and the further configuration and the limits can be read."""
    text = model_text(drawn(_design(kind, digits)), "r", "mm")
    pieces = re.sub(r"^hexagon = .*\n", "", text, flags=re.M)
    pieces = re.sub(
        r"^# (joints = \[|    \[.*|\]|\[limits\]|\[\[conf.*|name = .*|[a-z_]+ = \[.*)$", r"\1", pieces, flags=re.M
    )
    robot, spelled = robot_from_toml(text), robot_from_toml(pieces)
    assert (spelled.base_joints, spelled.platform_joints) == (robot.base_joints, robot.platform_joints)
    assert len(robot.configurations) == 1
    assert len(spelled.configurations) == 2
    assert spelled.configurations[0] == robot.configurations[0]
    assert robot.limits is None
    assert spelled.limits is not None
    (low, high), *_ = spelled.limits.lengths or spelled.limits.slides or spelled.limits.angles
    if robot.chains:
        assert low < 0 < high
    else:
        assert all(low**2 < square < high**2 for square in robot.configurations[0].lengths_squared)
    if not robot.chains:
        for measured, square in zip(
            spelled.configurations[1].lengths_squared, robot.configurations[0].lengths_squared, strict=True
        ):
            assert abs(math.sqrt(measured) - math.sqrt(square)) < 1e-6


@pytest.mark.parametrize("kind", KINDS)
def test_the_source_makes_the_same_file_again(kind: str, capsys: Capture) -> None:
    assert main(["new", *_options(kind), "--exact", "-o", "-", "--name", "r"]) == 0
    text = capsys.readouterr().out
    words = tomllib.loads(text)["source"].split("certify-poses new ")[1].split()
    assert main(["new", *words, "-o", "-", "--name", "r"]) == 0
    assert capsys.readouterr().out == text


@given(SIDES, SIDES, SIDES, SIDES, st.integers(1, 40), st.sampled_from([None, 0, 3]))
@example(Fraction(200), Fraction(0), Fraction(0), Fraction(100), 3, None)
def test_hexagons_have_the_sides_asked_for(
    p: Fraction, q: Fraction, a: Fraction, b: Fraction, height: int, digits: int | None
) -> None:
    try:
        robot, draft = _robot(Design("6-UPS", (p, q), (a, b), Fraction(10 * height), None, digits))
    except InputError as error:
        assert p == q == 0 or a == b == 0 or "join the same two points" in str(error)
        return
    slack = 0 if digits is None else 3 / Fraction(10) ** digits
    for joints, sides in ((robot.base_joints, (p, q)), (robot.platform_joints, (a, b))):
        for i in range(6):
            edge = [y - x for x, y in zip(joints[i], joints[(i + 1) % 6], strict=True)]
            side = sides[i % 2]
            assert abs(math.sqrt(dot(tuple(edge), tuple(edge), robot.metric)) - side) <= max(slack, 1e-9)
            if digits is None:
                assert dot(tuple(edge), tuple(edge), robot.metric) == side * side
    assert robot.configuration().lengths_squared == draft.lengths_squared


@given(
    st.tuples(*[st.integers(1, 30)] * 3),
    st.tuples(*[st.integers(1, 30)] * 3),
    st.integers(1, 30),
    st.sampled_from([None, 2]),
)
@example((6, 6, 6), (2, 2, 2), 5, None)
@example((13, 14, 15), (3, 4, 5), 5, None)
def test_triangles_have_the_sides_asked_for(
    base: tuple[int, ...], platform: tuple[int, ...], height: int, digits: int | None
) -> None:
    sides = [tuple(map(Fraction, given)) for given in (base, platform)]
    assume(all(2 * max(given) < sum(given) for given in sides))
    design = Design("3-RPR", sides[0], sides[1], Fraction(height), None, digits)
    try:
        robot, _ = _robot(design)
    except InputError as error:
        squares = [math.prod(sum(g) - 2 * x for x in g) * sum(g) for g in (base, platform)]
        assert digits is None
        assert math.isqrt(squares[0] * squares[1]) ** 2 != squares[0] * squares[1], error
        return
    for joints, wanted in ((robot.base_joints, sides[0]), (robot.platform_joints, sides[1])):
        for i in range(3):
            edge = tuple(y - x for x, y in zip(joints[i], joints[(i + 1) % 3], strict=True))
            square = dot(edge, edge, robot.metric)
            assert square == wanted[i] ** 2 if digits is None else abs(math.sqrt(square) - wanted[i]) < 0.1


@pytest.mark.slow
@budget(10)
@given(SIDES, SIDES, SIDES, SIDES, st.integers(1, 20), st.sampled_from(["6-UPS", "6-RUS", "6-PUS"]), st.integers(1, 8))
def test_what_new_accepts_is_complete_and_at_home(
    p: Fraction, q: Fraction, a: Fraction, b: Fraction, height: int, kind: str, crank: int
) -> None:
    try:
        design = Design(kind, (p, q), (a, b), Fraction(50 * height), Fraction(40 * crank) if kind == "6-RUS" else None)
        robot, draft = _robot(design)
        new_module._proved_at_home(draft, model_text(draft, "r", "mm"))
    except InputError as error:
        assert str(error).startswith(("--", "base.joints", "configurations[1]"))
        return
    solution = solve(robot.problem(robot.configuration()))
    assert solution.claim is Claim.COMPLETE
    assert _is_at_home(draft, solution)


@pytest.mark.slow
@settings(max_examples=60)
@given(
    st.tuples(*[st.integers(2, 12)] * 3),
    st.tuples(*[st.integers(2, 12)] * 3),
    st.integers(1, 12),
    st.sampled_from(["3-RPR", "3-RRR", "3-PRR"]),
)
def test_planar_robots_are_complete_and_at_home(
    base: tuple[int, ...], platform: tuple[int, ...], height: int, kind: str
) -> None:
    sides = [tuple(map(Fraction, given)) for given in (base, platform)]
    assume(all(2 * max(given) < sum(given) for given in sides))
    crank = Fraction(5) if kind == "3-RRR" else None
    robot, draft = _robot(Design(kind, sides[0], sides[1], Fraction(height), crank, 3))
    try:
        new_module._proved_at_home(draft, model_text(draft, "r", "mm"))
    except InputError as error:
        assert "no list of poses" in str(error)
        return
    assert _is_at_home(draft, solve(robot.problem(robot.configuration())))


@given(st.fractions(0, 10**6), st.integers(0, 9))
def test_rounded_roots_are_the_nearest(square: Fraction, digits: int) -> None:
    root, half = rounded_root(square, digits), Fraction(1, 2 * 10**digits)
    assert (root * 10**digits).denominator == 1
    assert max(root - half, Fraction(0)) ** 2 <= square <= (root + half) ** 2


@given(st.fractions("1/1000", 10**4, max_denominator=1000), st.fractions(0, 120, max_denominator=100))
def test_sides_on_a_circle(radius: Fraction, degrees: Fraction) -> None:
    p, q = map(float, sides_on_circle(radius, degrees))
    for side, angle in ((p, degrees), (q, 120 - degrees)):
        assert abs(side - 2 * radius * math.sin(math.radians(angle) / 2)) <= 1e-5 * radius


@pytest.mark.parametrize("azimuth", [None, "0", "17.5"])
def test_pairs_of_joints_stand_where_radius_and_angles_put_them(azimuth: str | None, capsys: Capture) -> None:
    assert main(["new", *CIRCLES, *(["--base-azimuth", azimuth] if azimuth else []), "-o", "-"]) == 0
    robot = jointed(robot_from_toml(capsys.readouterr().out), "this test")
    first = -90 if azimuth is None else float(azimuth)
    for joints, radius, pair, middle in (
        (robot.base_joints, 150, 20, first),
        (robot.platform_joints, 100, 24, first + 60),
    ):
        wanted = sorted((middle + k * 120 + s * pair / 2) % 360 for k in range(3) for s in (-1, 1))
        found = sorted(math.degrees(math.atan2(y, x)) % 360 for x, y, _ in joints)
        assert found == pytest.approx(wanted, abs=1e-4)
        assert [math.hypot(x, y) for x, y, _ in joints] == pytest.approx([radius] * 6, abs=1e-5)
    for (x, y, _), (u, v, _) in zip(robot.base_joints, robot.platform_joints, strict=True):
        assert math.degrees(math.acos((x * u + y * v) / 15000)) == pytest.approx(38, abs=1e-3)


@pytest.mark.slow
def test_the_line_source_draws_the_same_robot_again(capsys: Capture) -> None:
    assert main(["new", *CIRCLES, "--base-azimuth", "7", "-o", "-"]) == 0
    text = capsys.readouterr().out
    words = tomllib.loads(text)["source"].partition("new ")[2].split()
    assert main(["new", *words, "-o", "-"]) == 0
    assert capsys.readouterr().out == text


def test_a_robot_whose_pairs_face_each_other_is_not_drawn_in_silence(capsys: Capture) -> None:
    alike = [*CIRCLES[:4], "--platform-circle", "100,20", *CIRCLES[6:8]]
    assert main(["new", *alike, "-o", "-"]) == 0
    assert "--platform-shift 60" in capsys.readouterr().err
    assert main(["new", *alike, "--platform-shift", "60", "-o", "-"]) == 0
    assert capsys.readouterr().err == ""


def test_cranks_on_a_circle_are_tangent_and_turn_upwards(capsys: Capture) -> None:
    words = ["--kind", "6-RUS", *CIRCLES[2:], "--crank", "40", "-o", "-"]
    assert main(["new", *words]) == 0
    robot = jointed(robot_from_toml(capsys.readouterr().out), "this test")
    for i, (crank, (x, y, _)) in enumerate(zip(robot.chains, robot.base_joints, strict=True)):
        assert isinstance(crank, Crank)
        outward = crank.at_0[0] * -y + crank.at_0[1] * x
        assert (outward > 0) == (i % 2 == 1)
        assert sum(float(c) ** 2 for c in crank.at_0) == pytest.approx(1600)


@given(st.fractions())
def test_numbers_are_written_exactly(number: Fraction) -> None:
    value = tomllib.loads(f"x = {toml_number(number)}", parse_float=str)["x"]
    assert Fraction(value) == number


NO_DESIGN = [
    ([], "there is no terminal to ask on; give --kind, --base-sides, --platform-sides, --height, -o as well"),
    (["--kind", "6-RUS", "--base-circle", "1,2"], "give --platform-sides, --height, --crank, -o as well"),
    (["--kind", "7-UPS"], "'7-UPS' is not one of '6-UPS'"),
    ([*_options("6-UPS"), "--base-circle", "1,2", "-o", "-"], "--base-sides and --base-circle exclude each other"),
    ([*_options("6-UPS"), "--height", "0", "-o", "-"], "--height: '0' is not a length"),
    ([*_options("6-UPS"), "--platform-shift", "60", "-o", "-"], "goes with --base-circle and --platform-circle"),
    ([*_options("6-UPS"), "--base-azimuth", "60", "-o", "-"], "--base-azimuth: needs --platform-shift too"),
    ([*CIRCLES, "--base-azimuth", "1,2", "-o", "-"], "--base-azimuth: '1,2' is no angle"),
    ([*CIRCLES, "--exact", "-o", "-"], "--exact: joints at any azimuth are exact in no metric"),
    ([*_options("6-UPS"), "--height", "nan", "-o", "-"], "--height: nan is not a finite number"),
    ([*_options("6-UPS"), "--height", "9" * 31, "-o", "-"], "is too long; use at most 30 digits"),
    ([*_options("6-UPS"), "--base-sides", "1,-2", "-o", "-"], "--base-sides: -2 is not positive"),
    ([*_options("6-UPS"), "--base-sides", "1,2,3", "-o", "-"], "--base-sides: 3 numbers; give the two sides"),
    ([*_options("6-UPS"), "--base-sides", "0,0", "-o", "-"], "--base-sides: both are 0"),
    ([*_options("3-RPR"), "--base-sides", "1,2,3", "-o", "-"], "--base-sides: one side is not shorter"),
    (
        [*_options("3-RPR"), "--exact", "--base-sides", "3,2,2", "-o", "-"],
        "no exact coordinates suit both triangles; round",
    ),
    (
        [*_options("3-RRR"), "--exact", "--base-sides", "6,6,6", "--platform-sides", "1,1,1", "-o", "-"],
        "exact cranks need",
    ),
    ([*_options("6-RUS"), "--exact", "--digits", "3", "-o", "-"], "--exact and --digits exclude each other"),
    ([*_options("6-UPS"), "--crank", "3", "-o", "-"], "--crank: a 6-UPS robot has none"),
    ([*_options("6-UPS"), "--name", " ", "-o", "-"], "name: ' ' is not a label"),
    (
        [*_options("6-UPS"), "--platform-sides", "4,2", "-o", "-"],
        "proved: the robot moves with locked legs (positive-dimensional-proved)",
    ),
    ([*_options("6-UPS"), "--platform-sides", "200,400", "-o", "-"], "(positive-dimensional-proved); change"),
    ([*_options("6-UPS"), "-o", ""], "the path '' is empty"),
    ([*_options("6-UPS"), "-o", "nowhere/robot.toml"], "the folder nowhere does not exist"),
]


@pytest.mark.parametrize(("words", "part"), NO_DESIGN, ids=range(len(NO_DESIGN)))
def test_what_cannot_be_drawn_gives_one_sentence_and_no_file(
    words: list[str], part: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", *words]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert part in err
    assert err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_overwritten_only_by_force(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("mine")
    words = ["new", *_options("3-RPR"), "-o", str(path)]
    assert main(words) == 2
    assert "exists; give -o another path, or --force to overwrite it" in capsys.readouterr().err
    assert path.read_text() == "mine"
    assert main([*words, "--force"]) == 0
    assert read_robot(path).kind == "3-RPR"
    assert list(tmp_path.iterdir()) == [path]


def test_any_name_comes_back(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / 'a "quoted" \\ nåme.toml'
    assert main(["new", *_options("3-RPR"), "--unit", 'in "', "-o", str(path)]) == 0
    robot = read_robot(path)
    assert (robot.name, robot.unit) == ('a "quoted" \\ nåme', 'in "')
    following = capsys.readouterr().out.splitlines()[1].removeprefix("next: ")
    assert shlex.split(following) == ["certify-poses", "solve", str(path)]


def test_6_6_is_another_word_for_6_ups(capsys: Capture) -> None:
    assert main(["new", *_options("6-UPS"), "--exact", "-o", "-"]) == 0
    expected = capsys.readouterr().out
    assert main(["new", *_options("6-UPS"), "--kind", "6-6", "--exact", "-o", "-"]) == 0
    assert capsys.readouterr().out == expected


@pytest.fixture
def terminal() -> Callable[[list[str], str, Path], tuple[int, str]]:
    """Runs the command on a terminal of its own, where the answers are typed."""
    pty = pytest.importorskip("pty")

    def run(words: list[str], answers: str, folder: Path) -> tuple[int, str]:
        ours, theirs = pty.openpty()
        command = [sys.executable, "-m", "pkm_exact.cli.main", "new", *words]
        environment = {**os.environ, "TERM": "dumb", "COLUMNS": "200"}
        with subprocess.Popen(
            command, stdin=theirs, stdout=theirs, stderr=theirs, cwd=folder, env=environment, close_fds=True
        ) as process:
            os.close(theirs)
            os.write(ours, answers.encode())
            shown = b""
            while True:
                try:
                    piece = os.read(ours, 4096)
                except OSError:
                    break
                if not piece:
                    break
                shown += piece
        os.close(ours)
        return process.returncode, shown.decode()

    return run


def test_on_a_terminal_it_asks(terminal: Callable[..., tuple[int, str]], tmp_path: Path) -> None:
    answers = "9-UPS\n3-RPR\n6,5,5\n5,4,1\n1.6,1,1\n3\nexact\nm\nplanar.toml\n"
    code, shown = terminal([], answers, tmp_path)
    assert code == 0, shown
    for part in ("'9-UPS' is not one of", "one side is not shorter", "planar.toml: 3-RPR, home:", "[600,500,500]"):
        assert part in shown
    robot = read_robot(tmp_path / "planar.toml")
    assert (robot.kind, robot.unit, robot.metric) == ("3-RPR", "m", (1, 1, 1))
    assert robot.base_joints[2] == (3, 4, 0)


ON_CIRCLES = ["--base-circle", "100,20", "--platform-circle", "60,20", "--platform-shift", "60"]


def test_motors_stand_as_it_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["new", "--kind", "6-RUS", *ON_CIRCLES, "--crank", "20", "--rod", "120"]
    vectors = []
    for turn in ("0", "90", "180"):
        path = tmp_path / f"{turn}.toml"
        assert main([*words, "--motor-direction", turn, "-o", str(path)]) == 0
        assert f"--motor-direction {turn}" in read_robot(path).source or turn == "0"
        robot = read_robot(path)
        vectors.append([chain.at_0 for chain in robot.chains])
    capsys.readouterr()
    for along, outward, back, joint in zip(*vectors, robot.base_joints, strict=True):
        assert [-x for x in along] == pytest.approx(list(back))
        assert sum(x * y for x, y in zip(along, outward, strict=True)) == pytest.approx(0, abs=0.5)
        assert sum(x * y for x, y in zip(outward, joint, strict=True)) > 0
    assert main(["new", "--kind", "6-UPS", *ON_CIRCLES, "--height", "100", "--motor-direction", "90", "-o", "-"]) == 2
    assert "--motor-direction: is for cranks on circles" in capsys.readouterr().err


@pytest.mark.slow
def test_on_a_terminal_it_asks_for_arm_rod_and_motor_direction(
    terminal: Callable[..., tuple[int, str]], tmp_path: Path
) -> None:
    code, shown = terminal(ON_CIRCLES, "6-RUS\n120\n180\n20\n6\nmm\narms.toml\n", tmp_path)
    assert code == 0, shown
    for part in ("Length of the rods", "Direction of the cranks at 0 degrees", "Length of the cranks"):
        assert part in shown
    assert "--rod 120 --crank 20 --motor-direction 180" in read_robot(tmp_path / "arms.toml").source


def test_on_a_terminal_it_asks_only_for_what_is_missing(
    terminal: Callable[..., tuple[int, str]], tmp_path: Path
) -> None:
    words = ["--kind", "3-RPR", "--base-sides", "6,5,5", "--height", "3", "-o", "r.toml"]
    code, shown = terminal(words, "1.6,1,1\n", tmp_path)
    assert code == 0, shown
    assert "Sides of the platform" in shown
    assert "Sides of the base" not in shown
    assert read_robot(tmp_path / "r.toml").unit == "mm"


@pytest.mark.slow
def test_defaults_on_a_terminal_make_a_robot(terminal: Callable[..., tuple[int, str]], tmp_path: Path) -> None:
    code, shown = terminal([], "\n" * 7, tmp_path)
    assert code == 0, shown
    assert read_robot(tmp_path / "my-robot.toml").kind == "6-UPS"


def test_every_kind_can_be_chosen() -> None:
    option = next(parameter for parameter in new.params if parameter.name == "kind")
    assert set(KINDS) < set(option.type.choices)  # type: ignore[attr-defined]
    assert all(kind.description for kind in KINDS.values())


def test_rods_of_a_given_length(tmp_path: Path, capsys: Capture) -> None:
    """Arm, rod and circles of a servo hexapod; the platform is level at the height that follows."""
    target = tmp_path / "servo.toml"
    words = ["new", "--kind", "6-RUS", "--base-circle", "80,30", "--platform-circle", "60,30", "--platform-shift", "60"]
    assert main([*words, "--crank", "20", "--rod", "130", "-o", str(target)]) == 0
    robot = read_robot(target)
    assert {chain.rod_squared for chain in robot.chains} == {Fraction(130) ** 2}
    assert "# Squared lengths of the rods, exact, all 130 long.\n" in target.read_text()
    assert robot.nominal is not None
    assert main(["solve", str(target), "--nearest"]) == 0
    text = capsys.readouterr().out
    assert "its position is " in text
    assert main([*words, "--crank", "20", "--rod", "10", "-o", str(tmp_path / "no.toml")]) == 2
    assert "--rod: 10 is too short for any height" in capsys.readouterr().err
    assert main([*words, "--crank", "20", "--rod", "130", "--height", "9", "-o", str(tmp_path / "no.toml")]) == 2
    assert "exclude each other" in capsys.readouterr().err

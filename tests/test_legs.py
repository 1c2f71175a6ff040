"""Inverse kinematics: exact lengths and joint values, as numbers and as the command prints them."""

import json
from fractions import Fraction
from math import cos, radians, sin
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.cli.main import main
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import Crank, Slide, cosine_and_sine
from pkm_exact.geometry.inverse import dot, rotation_of
from pkm_exact.geometry.ordinary_pose import model_quaternion, ordinary_rotation, quaternion_of
from pkm_exact.geometry.reader import read_robot, robot_from_toml
from pkm_exact.geometry.surds import Surd, quadratic_roots
from pkm_exact.geometry.working_modes import CrankMode, FreeCrank, SlideMode, working_modes

MODELS = Path(__file__).parent.parent / "models"
ROLLAND, HEXA, GLIDE, PLANAR = (
    str(MODELS / f"{name}.toml") for name in ("rolland-6-6", "hexa", "hexaglide", "3-rpr-merlet-p")
)
Capture = pytest.CaptureFixture[str]

small = st.fractions(min_value=-4, max_value=4, max_denominator=6)
vectors = st.tuples(small, small, small)
metrics = st.sampled_from([(1, 1, 1), (1, 3, 1), (2, 1, 5)])
ZERO: Vector = (Fraction(0), Fraction(0), Fraction(0))


def _plus(a: Surd, b: Surd) -> Surd:
    assert a.n == b.n or 0 in (a.n, b.n)
    return Surd(a.p + b.p, a.q + b.q, max(a.n, b.n))


def _times(a: Surd, b: Surd) -> Surd:
    n = max(a.n, b.n)
    return Surd(a.p * b.p + a.q * b.q * n, a.p * b.q + a.q * b.p, n)


def _is(value: Surd, wanted: Fraction | int) -> bool:
    return value.p == wanted and value.q == 0


@given(small.filter(bool), small, small)
def test_quadratic_roots_are_roots(a: Fraction, b: Fraction, c: Fraction) -> None:
    roots = quadratic_roots(a, b, c)
    for x in roots:
        assert _is(_plus(_plus(_times(x, x).scaled(a), x.scaled(2 * b)), Surd(c)), 0)
    assert len(roots) == (b * b > a * c) + (b * b >= a * c)
    ends = [end for x in roots for end in x.enclosure(Fraction(1, 10**6))]
    assert ends == sorted(ends)


@given(st.fractions(min_value=0, max_value=10**6, max_denominator=10**4), st.integers(0, 12))
def test_enclosures_hold_the_root(square: Fraction, digits: int) -> None:
    width = Fraction(1, 10**digits)
    lo, hi = Surd.root_of(square).enclosure(width)
    assert lo * lo <= square <= hi * hi
    assert hi - lo <= width
    assert (lo == hi) == (lo * lo == square)


@given(vectors, vectors, small, metrics, vectors.filter(any))
def test_a_slide_finds_the_position_it_was_put_at(
    base: Vector, point: Vector, q: Fraction, metric: tuple[int, int, int], direction: Vector
) -> None:
    knee = Slide(direction, Fraction(1)).knee(base, q)
    gap = tuple(k - p for k, p in zip(knee, point, strict=True))
    rod = dot(gap, gap, metric)  # type: ignore[arg-type]
    if rod == 0:
        return
    modes = working_modes(Slide(direction, rod), base, point, metric)
    assert any(isinstance(mode, SlideMode) and _is(mode.position, q) for mode in modes)
    assert all(isinstance(mode, SlideMode) and mode.position.is_rational for mode in modes)


@given(vectors, vectors, small, st.sampled_from([(1, 3, 1), (1, 1, 1)]), st.booleans())
def test_a_crank_finds_the_angle_it_was_put_at(
    base: Vector, point: Vector, t: Fraction, metric: tuple[int, int, int], back: bool
) -> None:
    one, half = Fraction(1), Fraction(1, 2)
    at_0 = (half, half, Fraction(0)) if metric[1] == 3 else (one, Fraction(0), Fraction(0))
    at_90 = (Fraction(0), Fraction(0), one)
    angle = (Fraction(-1), Fraction(0)) if back else cosine_and_sine(t)
    knee = Crank(at_0, at_90, one).knee(base, angle)
    gap = tuple(k - p for k, p in zip(knee, point, strict=True))
    rod = dot(gap, gap, metric)  # type: ignore[arg-type]
    if rod == 0:
        return
    crank = Crank(at_0, at_90, rod)
    crank.require_exact(metric, "crank")
    modes = working_modes(crank, base, point, metric)
    if isinstance(modes[0], FreeCrank):
        return
    for mode in modes:
        assert isinstance(mode, CrankMode)
        assert _is(_plus(_times(mode.cos, mode.cos), _times(mode.sin, mode.sin)), 1)
        if mode.half_tangent is not None:
            assert mode.sin == _times(mode.half_tangent, _plus(mode.cos, Surd(one)))
    found = {(mode.cos.p, mode.sin.p) for mode in modes if isinstance(mode, CrankMode)}
    assert angle in found


def test_modes_of_a_crank() -> None:
    crank = Crank((2, 0, 0), (0, 0, 2), 9)  # type: ignore[arg-type]
    one = (1, 1, 1)
    at = lambda x, z: working_modes(crank, ZERO, (Fraction(x), Fraction(0), Fraction(z)), one)  # noqa: E731
    assert at(6, 0) == ()
    (stretched,) = at(5, 0)
    assert isinstance(stretched, CrankMode)
    assert _is(stretched.cos, 1)
    (back,) = at(-5, 0)
    assert isinstance(back, CrankMode)
    assert back.half_tangent is None
    assert len(at(3, 1)) == 2
    assert at(0, 0) == ()
    assert working_modes(crank, ZERO, (Fraction(0), Fraction(0), Fraction(0)), one) == ()
    tilted = Crank((2, 0, 0), (0, 0, 2), 13)  # type: ignore[arg-type]
    assert working_modes(tilted, ZERO, (Fraction(0), Fraction(3), Fraction(0)), one) == (FreeCrank(),)


def _answer(words: list[str], capsys: Capture) -> dict:
    assert main(["legs", *words, "--format", "json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_rotations_in_three_ways_give_the_same(capsys: Capture) -> None:
    for model in (ROLLAND, GLIDE):
        g = read_robot(model).metric[1]
        place = [model, "--in-metric", "--position", "1/2,-3,650"]
        first = _answer([*place, "--quaternion", "4,0,0,2"], capsys)
        norm = 16 * g + 4
        c, s = Fraction(16 * g - 4, norm), Fraction(16, norm)
        matrix = f"{c},{-s * g},0,{s},{c},0,0,0,1"
        assert _answer([*place, "--cayley", "0,0,1/2"], capsys) == first
        assert _answer([*place, "--matrix", matrix], capsys) == first


def test_poses_are_ordinary_and_never_rounded_silently(capsys: Capture) -> None:
    """In the metric (1, 3, 1) a rational y is no pose of the model; the nearest one is taken only if asked for."""
    place = [GLIDE, "--position", "1/2,-3,650", "--quaternion", "4,0,0,2"]
    assert main(["legs", *place]) == 2
    out, err = capsys.readouterr()
    note, error = err.splitlines()
    assert (out, "the ordinary y is sqrt(3) times the y in the file" in note) == ("", True)
    assert "--position: in the model's metric [1, 3, 1] these numbers are not rational" in error
    assert main(["legs", GLIDE, "--position", "1/2,0,650", "--quaternion", "4,0,0,2"]) == 2
    assert "--quaternion: in the model's metric" in capsys.readouterr().err
    near = _answer([*place, "--nearest", "1e-12"], capsys)
    assert near["nearest"] == "1/1000000000000"
    position = [_value(text) for text in near["pose"]["position"]]
    rotation = [[_value(text) for text in row] for row in near["pose"]["rotation"]]
    assert position == pytest.approx([0.5, -3, 650], abs=1e-12)
    assert rotation[0] == pytest.approx([0.6, -0.8, 0], abs=1e-12)
    assert _answer([GLIDE, "--position", "1/2,0,650", "--quaternion", "4,0,2,0"], capsys)["nearest"] is None


def test_the_same_pose_in_both_coordinates(capsys: Capture) -> None:
    half_turn = _answer([GLIDE, "--position", "1/2,0,650", "--matrix", "-1,0,0,0,1,0,0,0,-1"], capsys)
    assert _answer([GLIDE, "--in-metric", "--position", "1/2,0,650", "--quaternion", "0,0,1,0"], capsys) == half_turn
    turned = _answer([GLIDE, "--in-metric", "--position", "1/2,5,650", "--quaternion", "1,0,0,1"], capsys)["pose"]
    assert turned["position"] == ["1/2", "5*sqrt(3)", "650"]
    assert turned["rotation"][0] == ["1/2", "-1/2*sqrt(3)", "0"], "by 60 degrees: tan(30 degrees) is 1 / sqrt(3)"
    assert _answer([ROLLAND, "--position", "1,2,3", "--quaternion", "9,1,0,-1"], capsys) == _answer(
        [ROLLAND, "--in-metric", "--position", "1,2,3", "--quaternion", "9,1,0,-1"], capsys
    )


def _value(text: str) -> float:
    p, _, root = text.rpartition("*sqrt(")
    return float(Fraction(p)) * float(root[:-1]) ** 0.5 if p else float(Fraction(text))


@given(
    st.tuples(small, small, small, small).filter(any),
    st.sampled_from([(1, 3, 1), (2, 5, 7), (1, 1, 1), (4, 9, 1)]),
    st.integers(1, 12),
)
def test_a_quaternion_in_a_metric_is_as_near_as_asked_for(
    quaternion: tuple[Fraction, ...], metric: tuple[int, int, int], digits: int
) -> None:
    q0, q1, q2, q3 = quaternion
    wanted = rotation_of((q0, q1, q2, q3))
    exact, near = (model_quaternion((q0, q1, q2, q3), metric, width) for width in (None, Fraction(1, 10**digits)))
    assert near is not None
    if exact is not None:
        assert near == exact
    for row, ordinary in zip(wanted, ordinary_rotation(rotation_of(near, metric), metric), strict=True):
        for x, y in zip(row, ordinary, strict=True):
            low, high = y.enclosure(Fraction(1, 10**20))
            assert max(abs(low - x), abs(high - x)) <= (Fraction(1, 10**digits) if exact is None else 10**-20)
    assert [x * quaternion_of(wanted)[k] for k in range(4) for x in quaternion] == [
        quaternion_of(wanted)[i] * quaternion[k] for k in range(4) for i in range(4)
    ], "the same up to scale"


def test_lengths_are_those_of_a_posed_configuration(capsys: Capture) -> None:
    text = Path(ROLLAND).read_text()
    pose = "pose = { position = [1, 2, 800], quaternion = [9, 1, 0, -1] }"
    robot = robot_from_toml(text[: text.index("lengths =")] + pose + "\n")
    words = [ROLLAND, "--position", "1,2,800", "--quaternion", "9,1,0,-1"]
    answer = _answer(words, capsys)
    assert tuple(map(Fraction, answer["lengths_squared"])) == robot.configuration().lengths_squared
    for square, length in zip(answer["lengths_squared"], answer["lengths"], strict=True):
        lo, hi = map(Fraction, length["bounds"])
        assert lo * lo <= Fraction(square) <= hi * hi
    assert main(["legs", *words]) == 0
    line = capsys.readouterr().out.split("\n")[1]
    assert robot_from_toml(text[: text.index("lengths =")] + line) == robot


def test_joint_values_come_in_all_working_modes(capsys: Capture) -> None:
    place = ["--position", "0,0,500", "--quaternion", "1,0,0,0"]
    answer = _answer([HEXA, *place], capsys)
    assert answer["working_modes"] == 64
    assert [set(mode) for mode in answer["legs"][0]] == [{"cos", "sin", "half_tangent"}] * 2
    answer = _answer([GLIDE, *place], capsys)
    assert [[set(mode) for mode in leg] for leg in answer["legs"]] == [[{"position"}] * 2] * 6
    assert main(["legs", HEXA, *place]) == 0
    assert "64 working modes" in capsys.readouterr().out
    assert main(["legs", HEXA, "--position", "0,0,5000", "--cayley", "0,0,0"]) == 0
    assert capsys.readouterr().out.endswith("out of reach: leg 1, 2, 3, 4, 5, 6\n")


def test_rational_joint_values_can_be_copied(tmp_path: Path, capsys: Capture) -> None:
    text = Path(GLIDE).read_text().replace("length = 900", "lengths_squared = [10, 20, 29, 13, 25, 41]")
    joints = [[1, 0, 3], [2, 0, 4], [5, 0, 2], [2, 0, 3], [3, 0, 4], [4, 0, 5]]
    text = text.replace("hexagon = { sides = [613, 137], height = 236 }", f"joints = {joints}")
    text = text.replace("-340", "0").replace("230", "0").replace("120", "0")
    path = tmp_path / "slides.toml"
    path.write_text(text)
    assert main(["legs", str(path), "--position", "0,0,0", "--cayley", "0,0,0"]) == 0
    line = capsys.readouterr().out.split("\n")[2]
    assert line == "slides = [0, 0, 0, 0, 0, 0]"


@pytest.mark.parametrize("model", [ROLLAND, HEXA])
def test_roll_pitch_and_yaw_are_turns_about_the_fixed_axes_in_this_order(model: str, capsys: Capture) -> None:
    answer = _answer([model, "--position", "0,0,650", "--rpy", "10,-20,30.5"], capsys)
    cx, sx, cy, sy, cz, sz = (f(radians(a)) for a in (10, -20, 30.5) for f in (cos, sin))
    wanted = [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]
    found = [[_value(entry) for entry in row] for row in answer["pose"]["rotation"]]
    assert [x for row in found for x in row] == pytest.approx([x for row in wanted for x in row], abs=1e-11)
    assert answer["nearest"] == "1/1000000000000"


def test_right_angles_are_exact(capsys: Capture) -> None:
    answer = _answer([ROLLAND, "--position", "0,0,650", "--rpy", "180,-90,270"], capsys)
    assert answer["nearest"] is None
    assert {entry for row in answer["pose"]["rotation"] for entry in row} == {"0", "1", "-1"}
    planar = _answer([PLANAR, "--position", "1,2", "--degrees", "90"], capsys)
    assert planar["pose"]["planar"] == {"x": "1", "y": "2", "cos": "0", "sin": "1"}


def test_a_recorded_matrix_becomes_the_rotation_next_to_it(capsys: Capture) -> None:
    words = [ROLLAND, "--position", "0,0,650", "--matrix", "0.866,-0.5,0,0.5,0.866,0,0,0,1", "--nearest", "1e-3"]
    rows = [[Fraction(entry) for entry in row] for row in _answer(words, capsys)["pose"]["rotation"]]
    products = [[sum(x * y for x, y in zip(a, b, strict=True)) for b in rows] for a in rows]
    assert products == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    assert abs(rows[0][0] - Fraction("0.866")) < Fraction(1, 1000)


def test_a_machine_that_does_not_turn_needs_no_rotation(capsys: Capture) -> None:
    words = ["legs", str(MODELS / "delta.toml"), "--position", "0,0,-2"]
    assert main(words) == 0
    short = capsys.readouterr().out
    assert main([*words, "--quaternion", "1,0,0,0"]) == 0
    assert capsys.readouterr().out == short


BAD = [
    (["--quaternion", "1,0,0,0"], "missing option '--position'"),
    (["--position", "0,0,1"], "give exactly one of --quaternion, --cayley, --matrix and --rpy"),
    (["--position", "0,0,1", "--cayley", "0,0,0", "--quaternion", "1,0,0,0"], "give exactly one of"),
    (["--position", "0,0", "--cayley", "0,0,0"], "--position: 2 numbers given, 3 are needed"),
    (["--position", "0,0,x", "--cayley", "0,0,0"], "--position, number 3: x is not a number"),
    (["--position", "0,0,1", "--quaternion", "0,0,0,0"], "--quaternion: all four numbers are 0"),
    (["--position", "0,0,1", "--matrix", "1,0,0,0,1,0,0,0,2"], "columns 3 and 3 have the product 4 instead of 1"),
    (["--position", "0,0,1", "--matrix", "1,0,0,0,1,0,0,0,-1"], "its determinant is -1, a reflection"),
    (["--position", "0,0,1", "--rpy", "0,0,1e7"], "--rpy: 10000000 is out of range; give degrees"),
    (["--position", "0,0,1", "--rpy", "0,0,1", "--in-metric"], "--in-metric and --rpy exclude each other"),
    (["--position", "0,0,1", "--matrix", "9,0,0,0,9,0,0,0,9", "--nearest", "1e-3"], "is not even nearly a rotation"),
    (["--position", "0,0,1", "--matrix", "0.6,-0.8,0,0.8,0.6,0,0,0,0.99", "--nearest", "1e-3"], "differs by 0.01 "),
    (["--position", "0,0,1", "--cayley", "0,0,0", "--width", "0"], "--width: 0 is not positive"),
]


@pytest.mark.parametrize(("words", "part"), BAD, ids=range(len(BAD)))
def test_bad_usage_gives_one_sentence(words: list[str], part: str, capsys: Capture) -> None:
    assert main(["legs", ROLLAND, *words]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert part in err

"""The package as a user in a notebook meets it: what it takes, what it shows, and what it says if all is not well."""

import builtins
import os
import re
import subprocess
import sys
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from html.parser import HTMLParser
from math import inf, isinf, isnan, nan, sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pkm_exact
from pkm_exact import (
    Certificate,
    Claim,
    InputError,
    Interval,
    PkmExactError,
    Policy,
    Pose,
    Robot,
    Solution,
    Tolerances,
    check,
    solve,
    solve_many,
    tolerance_boxes,
)
from pkm_exact.interactive.facade import Question, posed

ROOT = Path(__file__).parent.parent
MODELS = ROOT / "models"
PLANAR = [7, 5, 5]


@pytest.fixture(scope="module")
def rolland() -> Robot:
    return Robot.load(MODELS / "rolland-6-6.toml")


@pytest.fixture(scope="module")
def planar() -> Robot:
    return Robot.load(str(MODELS / "3-rpr-merlet-p.toml"))


@pytest.fixture(scope="module")
def sixteen(rolland: Robot) -> Solution:
    return rolland.solve(method="krawczyk")


@pytest.fixture(scope="module")
def two(planar: Robot) -> Solution:
    return planar.solve()


@pytest.fixture(scope="module")
def none(planar: Robot) -> Solution:
    """An answer without a real pose."""
    return planar.solve([1, 100, 1])


@pytest.fixture(scope="module")
def triple() -> Solution:
    """An answer with a singular pose."""
    return Robot.load(MODELS / "3-rpr-triple.toml").solve()


# Solving.


def test_a_solution_is_that_of_the_parts(planar: Robot, two: Solution) -> None:
    assert two == solve(planar.problem(planar.configuration()))
    assert (two.robot, two.configuration) == (planar, "home")


@pytest.mark.parametrize("method", ["exact", "krawczyk"])
def test_both_methods_find_the_same_poses(rolland: Robot, sixteen: Solution, method: Any) -> None:
    found = rolland.solve(method=method)
    assert found.claim is Claim.COMPLETE
    assert len(found) == len(sixteen) == 16
    for one, other in zip(found, sixteen, strict=True):
        assert all(a.overlaps(b) for a, b in zip(one.position, other.position, strict=True))


EQUAL: list[Any] = [
    [7, "5.5", "16/3"],
    (Fraction(7), Fraction(11, 2), Fraction(16, 3)),
    [Decimal(7), Decimal("5.5"), Fraction(16, 3)],
    ["7e0", "0.55e1", "16/3"],
    np.array([7, "5.5", "16/3"], dtype=object),
    [np.int64(7), "5.5", "16/3"],
]


@pytest.mark.parametrize("lengths", EQUAL)
def test_lengths_are_exact_in_whatever_form(planar: Robot, lengths: Any) -> None:
    name, problem = posed(planar, Question(lengths))
    assert name is None
    assert [leg.length_squared for leg in problem.distances] == [49, Fraction(121, 4), Fraction(256, 9)]


def test_squared_lengths(planar: Robot, two: Solution) -> None:
    assert planar.solve([50, 26, 25], squared=True) == two


def test_doubles_if_they_are_meant(planar: Robot) -> None:
    for lengths in ([7.1, 5, 5], np.array([7.1, 5, 5]), [np.float64(7.1), 5, 5], [np.float32(7.1), 5, 5]):
        problem = posed(planar, Question(lengths, doubles_are_exact=True))[1]
        assert problem.distances[0].length_squared == Fraction(float(lengths[0])) ** 2


def test_a_configuration_made_for_the_occasion() -> None:
    hexa = Robot.load(MODELS / "hexa.toml")
    home = hexa.configuration("home")
    assert posed(hexa, Question(configuration=hexa.lock("mine", home.joint_values)))[1] == hexa.problem(home)


def test_the_width_is_kept(planar: Robot) -> None:
    for width in ("1e-20", Fraction(1, 10**20)):
        assert max(pose.half_width for pose in planar.solve(width=width)) <= Fraction(1, 2 * 10**20)


def test_options_reach_the_engine(planar: Robot) -> None:
    with pytest.raises(InputError, match="AFD5 is for spatial robots, but this one is planar; use SE3"):
        planar.solve(formulation="AFD5")
    assert Robot.load(MODELS / "mourrain-l.toml").solve(formulation="AFD5").formulation == "AFD5"
    with pytest.raises(PkmExactError, match="no representation over Q appeared within 1 bits"):
        planar.solve(policy=Policy(lifting_bits=1))


WRONG: list[tuple[dict[str, Any], str]] = [
    (dict(lengths=[7.5, 5, 5]), r'leg 1: 7\.5 is a binary float.*write "7\.5" or Fraction\(15, 2\).*doubles_are_exact'),
    (dict(lengths=[np.float64(0.1), 5, 5]), r'0\.1 is a binary float.*write "0\.1" or Fraction\(1, 10\)'),
    (dict(lengths=np.array([7.5, 5, 5])), r"leg 1: 7\.5 is a binary float"),
    (dict(lengths=[inf, 5, 5], doubles_are_exact=True), "leg 1: inf is not a finite number"),
    (dict(lengths=[nan, 5, 5]), "leg 1: nan is not a finite number"),
    (dict(lengths=[7, 5]), "2 numbers given, but a 3-RPR robot has 3 legs; give 3"),
    (dict(lengths=[7]), "1 number given"),
    (dict(lengths=[7, 5, 5, 5, 5, 5]), "6 numbers given, but a 3-RPR robot has 3 legs"),
    (dict(lengths=[[7, 5, 5]]), "1 number given"),
    (dict(lengths=[7, 5, 0]), "leg 3: 0 is not positive"),
    (dict(lengths=[7, 5, "five"]), "leg 3: five is not a number"),
    (dict(lengths=[7, 5, True]), "leg 3: true is not a number"),
    (dict(lengths=[7, 5, None]), "leg 3: None is not a number"),
    (dict(lengths="home"), "'home' is a text; give a list of numbers, or configuration='home'"),
    (dict(lengths=7), "7 is no list; give a list of 3 numbers"),
    (dict(lengths=PLANAR, configuration="home"), "give lengths or a configuration, not both"),
    (dict(squared=True), "are about given lengths; give them as well"),
    (dict(configuration="hone"), "'hone' is unknown, did you mean 'home'.*use one of: home"),
    (dict(configuration="qqq"), "'qqq' is unknown; use one of: home"),
    (dict(configuration=3), "3 is unknown; use one of: home"),
    (dict(method="newton"), "'newton' is unknown; use one of: exact, krawczyk; its poses are uncertified"),
    (dict(method="Exact"), "'Exact' is unknown; use one of: exact, krawczyk"),
    (dict(method="krawczyk", formulation="AFD5"), "formulation: belongs to the method exact"),
    (dict(formulation="AFD99"), "AFD99.*use one of"),
    (dict(formulation=5), "5 is no code; use one of: SE3"),
    (dict(width=1e-12), r'width: 1e-12 is a binary float, not exact; write it as a string, "1e-12"'),
    (dict(width="0"), "width: '?0'? is not positive"),
    (dict(width=2), "width: 2 is out of range"),
]


@pytest.mark.parametrize(("options", "message"), WRONG, ids=lambda value: str(value)[:50])
def test_wrong_questions_are_answered_with_the_remedy(planar: Robot, options: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        planar.solve(**options)


def test_the_remedy_for_a_float_is_one(planar: Robot) -> None:
    with pytest.raises(InputError) as caught:
        planar.solve([7.25, 5, 5])
    written = re.search(r'write ("[^"]*") or (Fraction\(.*?\)),', str(caught.value))
    assert written is not None
    assert posed(planar, Question([written[1].strip('"'), 5, 5])) == posed(planar, Question([Fraction(29, 4), 5, 5]))
    assert written[2] == repr(Fraction(29, 4))


def test_rods_of_fixed_length_are_explained() -> None:
    with pytest.raises(InputError, match=r"fixed lengths; give a configuration, .*'home', 'level'.*robot\.lock\(name"):
        Robot.load(MODELS / "hexa.toml").solve([1] * 6)


def test_a_robot_without_configurations(planar: Robot) -> None:
    with pytest.raises(InputError, match="has none; give the three leg lengths instead"):
        replace(planar, configurations=()).solve()


def test_a_missing_model() -> None:
    with pytest.raises(InputError, match="no-such"):
        Robot.load("no-such.toml")


# Solutions and poses.


def test_a_solution_is_a_collection_of_poses_and_always_true(two: Solution, none: Solution) -> None:
    assert list(two) == list(two.poses)
    assert (len(two), len(none)) == (2, 0)
    assert two
    assert none
    assert two.is_complete
    assert none.is_complete
    assert not replace(two, claim=Claim.NOT_PROVEN_COMPLETE).is_complete


def test_what_is_shown_is_short(two: Solution, planar: Robot) -> None:
    assert repr(two) == "<Solution: 6 complex solutions, 2 real poses; complete>"
    assert repr(two.poses[1]).startswith("<Pose: position (5.000000000, 5.000000000, 0.0")
    assert repr(planar) == "Robot('Merlet 3-RPR', kind='3-RPR')"
    assert str(planar) == "Merlet 3-RPR (3-RPR, lengths in 1), configurations: home"


def test_a_pose_without_a_jacobian(two: Solution) -> None:
    bare = replace(two.poses[0], jacobian=None)
    assert (bare.det_sign, bare.condition) == (None, None)
    arrays = bare.to_numpy()
    assert arrays.det_sign == 2
    assert isnan(arrays.condition)


# Intervals.

ENDS = st.fractions(-(10**6), 10**6, max_denominator=10**9)
WIDTHS = st.fractions(0, 1) | st.integers(0, 60).map(lambda k: Fraction(1, 3**k)) | st.just(Fraction(0))


@given(ENDS, WIDTHS)
def test_the_bound_that_is_shown_holds(lo: Fraction, width: Fraction) -> None:
    interval = Interval(lo, lo + width)
    match = re.fullmatch(r"\[(\S+)(?: \+/- (\S+))?\]", repr(interval))
    assert match is not None
    if match[2] is None:
        assert Fraction(match[1]) == lo == interval.hi
        return
    middle, bound = Fraction(match[1]), Fraction(match[2])
    assert match[1] == str(interval)
    assert middle - bound <= interval.lo <= interval.hi <= middle + bound
    last_digit = Fraction(1, 10 ** len(match[1].partition(".")[2]))
    assert width > 1 or bound <= last_digit * Fraction(11, 10)


@given(ENDS, WIDTHS)
def test_a_ball_covers_its_interval(lo: Fraction, width: Fraction) -> None:
    interval = Interval(lo, lo + width)
    middle, half_width = map(Fraction, interval.ball())
    assert middle - half_width <= interval.lo <= interval.hi <= middle + half_width
    assert middle == Fraction(float(interval))


def test_a_ball_out_of_reach() -> None:
    with pytest.raises(OverflowError):
        Interval(Fraction(10) ** 400, Fraction(10) ** 400).ball()


def test_membership_is_exact() -> None:
    tenth = Interval(Fraction(1, 10), Fraction(1, 10))
    assert Fraction(1, 10) in tenth
    assert Decimal("0.1") in tenth
    assert 0.1 not in tenth
    assert np.float64(0.5) in Interval(Fraction(0), Fraction(1, 2))
    assert 1 in Interval(Fraction(0), Fraction(1))
    assert nan not in tenth
    assert Decimal("nan") not in tenth
    assert Decimal("Infinity") not in tenth
    with pytest.raises(TypeError, match="give an int, Fraction or Decimal"):
        "0.1" in tenth  # noqa: B015


def test_numpy_takes_intervals_only_when_told_to(two: Solution) -> None:
    assert np.array(two.poses[0].position).dtype == object
    assert np.array(two.poses[0].position, dtype=float).tolist() == [float(x) for x in two.poses[0].position]


def test_an_interval_can_be_formatted() -> None:
    third = Interval(Fraction(1, 3), Fraction(1, 3))
    assert f"{third:.2f}" == "0.33"
    assert f"{third}" == str(third) == "0.333333333333333"
    assert repr(third) == "[1/3]"


# Arrays.


def _covered(intervals: list[Interval], middles: Any, half_widths: Any) -> bool:
    return all(
        Fraction(m) - Fraction(h) <= x.lo <= x.hi <= Fraction(m) + Fraction(h)
        for x, m, h in zip(intervals, middles.ravel().tolist(), half_widths.ravel().tolist(), strict=True)
    )


def test_arrays_cover_the_boxes(sixteen: Solution) -> None:
    arrays = sixteen.to_numpy()
    assert arrays.position.shape == arrays.position_half_width.shape == (16, 3)
    assert arrays.rotation.shape == arrays.rotation_half_width.shape == (16, 3, 3)
    assert arrays.quaternion.shape == arrays.quaternion_half_width.shape == (16, 4)
    entries = [[x for row in pose.rotation for x in row] for pose in sixteen]
    assert _covered([x for pose in sixteen for x in pose.position], arrays.position, arrays.position_half_width)
    assert _covered([x for row in entries for x in row], arrays.rotation, arrays.rotation_half_width)
    assert _covered([x for pose in sixteen for x in pose.quaternion], arrays.quaternion, arrays.quaternion_half_width)
    assert arrays.det_sign.tolist() == [pose.det_sign for pose in sixteen]
    assert arrays.multiplicity.tolist() == [1] * 16
    assert arrays.half_width.shape == (16,)
    assert (arrays.half_width <= 1e-9).all()


def test_a_transform_puts_the_joints_on_legs_of_the_right_length(rolland: Robot, sixteen: Solution) -> None:
    joints = np.array([[float(x) for x in joint] + [1] for joint in rolland.platform_joints])
    feet = np.array([[float(x) for x in joint] for joint in rolland.base_joints])
    placed = np.einsum("nij,kj->nki", sixteen.to_numpy().transform, joints)[..., :3]
    lengths = np.linalg.norm(placed - feet, axis=2)
    wanted = [sqrt(leg.length_squared) for leg in sixteen.problem.distances]
    assert np.allclose(lengths, wanted, rtol=0, atol=1e-6)


def test_the_arrays_of_one_pose_are_a_row(sixteen: Solution) -> None:
    whole, one = sixteen.to_numpy(), sixteen.poses[3].to_numpy()
    for name in set(whole.__dataclass_fields__) - {"indices"}:
        assert np.array_equal(getattr(one, name), getattr(whole, name)[3]), name
    assert one.indices == {name: values[3] for name, values in whole.indices.items()}
    assert one.transform.shape == (4, 4)
    assert np.array_equal(one.transform, whole.transform[3])
    assert (repr(one), repr(whole)) == ("<PoseArrays: one pose>", "<PoseArrays: 16 poses>")


def test_arrays_of_no_pose(none: Solution) -> None:
    arrays = none.to_numpy()
    assert (arrays.position.shape, arrays.rotation.shape, arrays.transform.shape) == ((0, 3), (0, 3, 3), (0, 4, 4))
    assert arrays.half_width.shape == (0,)


def test_a_singular_pose_has_infinite_condition(triple: Solution) -> None:
    arrays = triple.to_numpy()
    singular = [pose.det_sign == 0 for pose in triple]
    assert any(singular)
    assert [isinf(value) for value in arrays.condition] == singular


def test_numbers_too_large_for_doubles(two: Solution) -> None:
    huge = Interval(Fraction(10) ** 400, Fraction(10) ** 400)
    with pytest.raises(PkmExactError, match="too large for floating point; use its bounds"):
        replace(two.poses[0], position=(huge, huge, huge)).to_numpy()


def test_rotations_for_scipy(sixteen: Solution, two: Solution) -> None:
    pytest.importorskip("scipy")
    rotations, arrays = sixteen.to_scipy(), sixteen.to_numpy()
    assert len(rotations) == 16
    assert np.allclose(rotations.as_matrix(), arrays.rotation, rtol=0, atol=1e-8)
    assert np.allclose(sixteen.poses[5].to_scipy().as_matrix(), arrays.rotation[5], rtol=0, atol=1e-8)
    assert np.allclose(two.to_scipy().as_rotvec()[:, :2], 0)


def test_rotations_of_no_pose(none: Solution) -> None:
    pytest.importorskip("scipy", minversion="1.15")
    assert len(none.to_scipy()) == 0


def test_a_table_for_pandas(sixteen: Solution, none: Solution, triple: Solution, two: Solution) -> None:
    pytest.importorskip("pandas")
    frame = sixteen.to_frame()
    assert list(frame.columns) == [
        *("x", "y", "z", "qw", "qx", "qy", "qz"),
        *("det_sign", "condition", "multiplicity", "half_width"),
    ]
    assert (list(frame.index), frame.index.name) == (list(range(1, 17)), "pose")
    assert np.array_equal(frame[["x", "y", "z"]].to_numpy(), sixteen.to_numpy().position)
    assert frame["det_sign"].tolist() == [pose.det_sign for pose in sixteen]
    assert none.to_frame().shape == (0, 11)
    assert sorted(triple.to_frame()["multiplicity"]) == sorted(pose.multiplicity for pose in triple)
    bare = [replace(pose, jacobian=None, multiplicity=None) for pose in two]
    unknown = replace(two, poses=tuple(bare)).to_frame()
    assert unknown[["det_sign", "condition", "multiplicity"]].isna().all().all()


@pytest.mark.parametrize(
    ("package", "call", "command"),
    [
        ("scipy", "to_scipy", r'pip install "pkm_exact\[scipy\]"'),
        ("pandas", "to_frame", "pip install pandas"),
        ("matplotlib", "plot", r'pip install "pkm_exact\[plots\]"'),
    ],
)
def test_what_is_not_installed_is_named_with_its_command(
    two: Solution, package: str, call: str, command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.delitem(sys.modules, "scipy.spatial.transform", raising=False)
    with pytest.raises(PkmExactError, match=rf"{call}: {package} is not installed; get it with: {command}"):
        getattr(two, call)()


# What a notebook shows.


class Page(HTMLParser):
    """All text and all tags, each of which must be closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[str] = []
        self.text = ""
        self.images: list[str] = []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag: str, attrs: object) -> None:
        assert isinstance(attrs, list)
        self.tags.append(tag)
        self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag == "img"
        self.images.append(str(dict(attrs)["src"]))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data


def test_a_solution_shows_claim_poses_and_picture(two: Solution) -> None:
    pytest.importorskip("matplotlib")
    page = Page(two._repr_html_())
    assert "complete: it is proved that there is no other" in page.text
    assert "configuration home" in page.text
    assert page.tags.count("tr") == 3
    assert "6.216516215" in page.text
    assert [image[:22] for image in page.images] == ["data:image/png;base64,"]


def test_without_matplotlib_there_is_no_picture(two: Solution, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pkm_exact.interactive.display.find_spec", lambda _: None)
    page = Page(two._repr_html_())
    assert page.images == []
    assert page.tags.count("tr") == 3


def test_a_solution_of_parts_is_shown_too(two: Solution, none: Solution, sixteen: Solution) -> None:
    assert Page(replace(two, robot=None)._repr_html_()).images == []
    assert "0 real poses" in Page(none._repr_html_()).text
    assert "given leg lengths" in Page(none._repr_html_()).text


def test_what_cannot_be_drawn_is_shown_without_a_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib")
    text = (MODELS / "3-rpr-merlet-p.toml").read_text()
    assert "[10, 0]" in text
    robot = Robot.load(MODELS / "3-rpr-merlet-p.toml")
    scale = Fraction(10) ** 150
    large = replace(
        robot,
        base_joints=tuple(tuple(x * scale for x in joint) for joint in robot.base_joints),
        platform_joints=tuple(tuple(x * scale for x in joint) for joint in robot.platform_joints),
        configurations=(),
    )
    solution = large.solve([7 * scale, 5 * scale, 5 * scale])
    page = Page(solution._repr_html_())
    assert len(solution) == 2
    assert page.images == []
    assert "no picture" in page.text


def test_names_are_text_and_not_markup(two: Solution, planar: Robot) -> None:
    evil = "<script>alert(1)</script>\x1b[2J"
    robot = replace(planar, name=evil, source=evil, unit=evil, configurations=())
    solution = replace(two, robot=robot, configuration=evil, notes=(evil,))
    for page in map(Page, (robot._repr_html_(), solution._repr_html_())):
        assert "script" not in page.tags
        assert "<script>" in page.text
        assert "\x1b" not in page.text
    assert "\x1b" not in str(robot)


def test_a_robot_shows_its_joints(rolland: Robot) -> None:
    page = Page(rolland._repr_html_())
    assert page.tags.count("tr") == 7
    assert "configurations: home" in page.text
    scaled = Robot.load(MODELS / "mssm.toml")
    assert ("sqrt(3)" in Page(scaled._repr_html_()).text) == (3 in scaled.metric)


def test_many_rows_and_tolerances_are_shown(planar: Robot, two: Solution) -> None:
    many = solve_many(planar, [PLANAR, [7, 5, "-1"]] * 30)
    page = Page(many._repr_html_())
    assert "60 length vectors" in page.text
    assert "and 20 more" in page.text
    assert "give a number greater than 0" in page.text
    result = tolerance_boxes(two.problem, Tolerances.uniform("0.0001"), two)
    page = Page(result._repr_html_())
    assert page.tags.count("tr") == 3
    assert "100 %" in page.text
    assert repr(result) == f"<ToleranceResult: {result}>"


def test_a_figure_has_a_drawing_of_every_pose(two: Solution) -> None:
    pytest.importorskip("matplotlib")
    labels = [axes.get_label() for axes in two.plot().axes]
    assert {"pose 1", "pose 2"} <= set(labels)


# Certificates.


def test_a_certificate_is_saved_and_checked(two: Solution, tmp_path: Path) -> None:
    path = tmp_path / "planar.json"
    two.save(path)
    assert check(path)
    assert check(str(path)).status == "accepted"
    found = Certificate.load(path)
    assert found == two.certificate()
    assert check(found)
    assert found.content["real_poses"] == 2
    found.save(tmp_path / "again.json")
    assert (tmp_path / "again.json").read_bytes() == path.read_bytes()
    assert path.read_bytes() == (ROOT / "certs" / "3-rpr-merlet-p.json").read_bytes()


def test_a_forged_certificate_is_false(two: Solution) -> None:
    data = two.certificate().data
    forged = Certificate(data.replace(b'"real_poses": 2', b'"real_poses": 3'))
    verdict = check(forged)
    assert not verdict
    assert verdict.status == "rejected"
    assert not check(Certificate(b"{}"))


def test_free_lengths_have_a_certificate(planar: Robot, none: Solution) -> None:
    assert check(none.certificate())
    assert none.certificate().content["configuration"]["name"] is None


def test_cranks_have_a_certificate() -> None:
    assert check(Robot.load(MODELS / "hexa.toml").solve(configuration="level", method="krawczyk").certificate())


@pytest.mark.parametrize("call", [lambda s: s.certificate(), lambda s: s.save("x.json"), lambda s: s.plot()])
def test_a_solution_without_its_robot_says_so(two: Solution, call: Any) -> None:
    with pytest.raises(PkmExactError, match=r"not its robot; get it by robot\.solve"):
        call(solve(two.problem))


def test_files_that_cannot_be_read_or_written(two: Solution, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.json: cannot be read .*; give the path of a certificate"):
        check(tmp_path / "none.json")
    with pytest.raises(InputError, match=r"cannot be written .*; give another path"):
        two.save(tmp_path / "no" / "folder.json")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("data", [b"", b"[]", b"\xff", b"[" * 100_000])
def test_what_is_no_json_object(data: bytes) -> None:
    with pytest.raises(InputError, match="is not a JSON object"):
        _ = Certificate(data).content
    assert Certificate(data).check().status == "malformed"


# Names, progress, types, cost.


@pytest.mark.parametrize(("typo", "meant"), [("sovle", "solve"), ("robot", "Robot"), ("Certficate", "Certificate")])
def test_a_misspelt_name_is_corrected(typo: str, meant: str) -> None:
    with pytest.raises(AttributeError, match=rf"no attribute '{typo}'; did you mean '{meant}'\?"):
        getattr(pkm_exact, typo)


def test_progress_of_a_solve(planar: Robot, capfd: pytest.CaptureFixture[str]) -> None:
    lines: list[str] = []
    planar.solve(progress=lines.append)
    assert lines[:2] == ["self-motion", "formulation"]
    planar.solve(progress=True)
    planar.solve(progress=False)
    assert capfd.readouterr() == ("", "")


def test_a_notebook_sees_progress(
    planar: Robot, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "ipykernel", builtins)
    monkeypatch.setattr("pkm_exact.interactive.progress.PATIENCE", 0)
    planar.solve(progress=True)
    shown = capsys.readouterr().err
    assert "self-motion" in shown
    assert "\x1b" not in shown
    assert shown.rpartition("\r")[2] == ""


def test_loading_and_showing_a_robot_costs_nothing() -> None:
    script = (
        "import sys; from pkm_exact import Robot; robot = Robot.load('models/rolland-6-6.toml')\n"
        "str(robot), repr(robot), robot._repr_html_()\n"
        "print([m for m in ('sympy', 'flint', 'numpy', 'matplotlib', 'mpmath', 'rich') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout == "[]\n"


USER_SCRIPT = """
from fractions import Fraction
import pkm_exact
from pkm_exact import Certificate, Interval, Pose, Robot, Solution, Verdict, check

robot: Robot = Robot.load("models/rolland-6-6.toml")
solution: Solution = robot.solve(["1250.5", 1250, Fraction(5, 2), 1, 1, 1], method="krawczyk", width="1e-12")
count: int = len(solution)
for pose in solution:
    x: Interval = pose.position[0]
    bounds: tuple[Fraction, Fraction] = x.lo, x.hi
    nearest: float = float(x)
    sign: int | None = pose.det_sign
    reveal_type(pose)
reveal_type(solution.to_numpy().position)
reveal_type(pkm_exact.solve)
solution.save("x.json")
verdict: Verdict = check("x.json")
certificate: Certificate = solution.certificate()
robot.solve(method="newton")
"""


@pytest.mark.slow
def test_a_users_script_is_checked_by_types(tmp_path: Path) -> None:
    (tmp_path / "script.py").write_text(USER_SCRIPT)
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", "script.py"]
    environment = os.environ | {"MYPYPATH": str(ROOT), "MYPY_CACHE_DIR": str(tmp_path / "cache")}
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, env=environment)
    errors = [line for line in done.stdout.splitlines() if ": error:" in line]
    assert len(errors) == 1, done.stdout
    assert 'incompatible type "Literal[' in errors[0]
    assert f"script.py:{len(USER_SCRIPT.splitlines())}:" in errors[0]
    revealed = re.findall(r'Revealed type is "(.*)"', done.stdout)
    assert "pkm_exact.poses.pose.Pose" in revealed[0]
    assert "float64" in revealed[1]
    assert "Any" not in revealed[2]


def test_poses_of_old_are_still_made_by_hand(two: Solution) -> None:
    pose = two.poses[0]
    same = Pose(pose.parameter, pose.position, pose.rotation, pose.quaternion, pose.multiplicity, pose.jacobian)
    assert same == pose
    assert hash(same) == hash(pose)

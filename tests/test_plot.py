"""Pictures: true lengths, one scale, nothing cut off or overlapping, the same bytes always, errors in one sentence."""

import math
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import combinations, pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certificate_tools import golden
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox
from picture_tools import Drawn, length, line, on_paper, panels, render
from samples import model
from test_scene import inconsistent

from pkm_exact.certify.build import canonical_bytes, certificate, sealed
from pkm_exact.certify.tolerance_build import tolerance_certificate
from pkm_exact.cli.main import main
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.geometry.nominal_pose import nominal_from_numbers
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.pictures.camera import View, Window, camera, window
from pkm_exact.pictures.captions import round_length, rounded
from pkm_exact.pictures.clear_view import clear_view, clearness
from pkm_exact.pictures.drawn_robot import PoseView, Scene
from pkm_exact.pictures.output import figure_bytes
from pkm_exact.pictures.panels import HEADER, TITLE, grid
from pkm_exact.pictures.roots import Stretch, roots_figure, spread
from pkm_exact.pictures.scene import scene_of
from pkm_exact.pictures.style import LEG_COLOURS, drawable
from pkm_exact.pictures.views import overlay_figure, pose_figure, poses_figure

ROOT = Path(__file__).parent.parent
MERLET = str(ROOT / "certs" / "3-rpr-merlet-p.json")
CHAINS = ("hexa", "hexaglide", "linapod-n", "3-rrr", "3-prr")
LONGER = ("robocrane-r", "hexa", "hexaglide", "3-prr", "dietmaier")
Capture = pytest.CaptureFixture[str]


def slow(value: object) -> Any:
    """A parameter of the long run only."""
    return pytest.param(value, marks=pytest.mark.slow)


@cache
def scene(name: str) -> Scene:
    """The scene of a golden certificate, with cranks and slides."""
    robot = read_robot(ROOT / "models" / f"{name}.toml") if name in CHAINS else None
    return scene_of(golden(name), robot)


FIGURES = {
    "grid": poses_figure,
    "one": lambda shown, **options: pose_figure(shown, 1, **options),
    "one among ghosts": lambda shown, **options: pose_figure(shown, 1, ghosts=True, **options),
    "overlay": overlay_figure,
}


@cache
def standard(name: str, figure: str = "grid") -> tuple[Figure, Drawn]:
    """The picture of a golden certificate without options, drawn once for all that is asked of it."""
    made = FIGURES[figure](scene(name))
    return made, render(made)


# What is drawn


@pytest.mark.parametrize("name", ["mourrain-l", "3-rpr-double-q", "linapod-n", "3-rrr", *map(slow, LONGER)])
def test_there_is_a_panel_for_each_pose_with_its_title(name: str) -> None:
    shown = scene(name)
    figure, drawn = standard(name)
    assert [axes.get_label() for axes in panels(figure)] == [f"pose {pose.number}" for pose in shown.poses]
    titles = [text for text, _ in drawn.texts if text.split(":")[0].split(" ")[0].isdigit() and "det J" in text]
    for title, pose in zip(titles, shown.poses, strict=True):
        sign = {1: ">", -1: "<", 0: "="}[pose.det_sign]
        assert title.startswith(f"{pose.number}")
        assert f"det J {sign} 0" in title
        assert title.endswith(f"cond {rounded(pose.condition)}" if pose.condition else "(double): det J = 0")


@pytest.mark.parametrize("name", ["mourrain-l", "3-rpr-double-q", "linapod-n", "3-rrr", *map(slow, LONGER)])
def test_drawn_legs_have_their_true_lengths_and_stand_on_the_base(name: str) -> None:
    shown = scene(name)
    for axes, pose in zip(panels(standard(name)[0]), shown.poses, strict=True):
        for leg, (a, b) in enumerate(shown.legs):
            ends = line(axes, f"leg-{leg + 1}")
            assert length(ends) == pytest.approx(shown.lengths[leg], rel=1e-12)
            assert ends == [list_of(axes, shown.feet(pose)[a]), list_of(axes, pose.platform[b])]
            if shown.sorts:
                assert line(axes, f"chain-{leg + 1}") == [
                    list_of(axes, shown.base[leg]),
                    list_of(axes, pose.knees[leg]),
                ]


@pytest.mark.parametrize("number", [1, 3, 6])
@pytest.mark.parametrize("ghosts", [False, True])
def test_one_pose_is_the_one_that_was_asked_for(number: int, ghosts: bool) -> None:
    shown = scene("3-rrr")
    figure = pose_figure(shown, number, ghosts=ghosts)
    for leg in range(3):
        joint = shown.poses[number - 1].platform[leg]
        assert line(figure.axes[0], f"leg-{leg + 1}") == [shown.poses[0].knees[leg][:2], joint[:2]]
    texts = [text for text, _ in render(figure).texts]
    assert any(text.startswith(f"pose {number} of 6: ") for text in texts)
    others = {str(pose.number) for pose in shown.poses} - {str(number), "1", "2", "3"}  # legs have numbers too
    assert (others <= set(texts)) == ghosts


def list_of(axes: Any, point: tuple[float, ...]) -> tuple[float, ...]:
    """The coordinates that a line on these axes has."""
    return point if hasattr(axes, "get_proj") else point[:2]


@pytest.mark.parametrize(("name", "view"), [("mourrain-l", View()), ("linapod-n", View(-200, 90)), ("3-rrr", View())])
def test_all_panels_have_one_scale_and_no_distortion(name: str, view: View) -> None:
    """Distances on the paper are those of the orthographic view, times one number, which is that of the bar."""
    shown = scene(name)
    figure = poses_figure(shown, view=view)
    render(figure)
    shot = camera(shown, view)
    scales = []
    for axes, pose in zip(panels(figure), shown.poses, strict=True):
        for one, two in combinations([*shown.base, *pose.platform], 2):
            true = math.dist(shot.flat(one), shot.flat(two))
            if true > 0.1 * max(shown.lengths):
                scales.append(math.dist(on_paper(axes, one), on_paper(axes, two)) / true)
    assert scales == pytest.approx([scales[0]] * len(scales), rel=1e-6)
    key = next(axes for axes in figure.axes if axes.get_label() == "key")
    bar = key.lines[0]
    dots = math.dist(*(key.transData.transform(end) for end in zip(*bar.get_data(), strict=True)))
    (words,) = [text.get_text() for text in key.texts if any(c.isdigit() for c in text.get_text())]
    number = float(words.removeprefix("length ").split(" ")[0])
    assert dots / number == pytest.approx(scales[0], rel=1e-6)


def test_up_is_up_and_right_is_right() -> None:
    """Seen from the front: x to the right, z upwards."""
    shown = scene("mourrain-l")
    figure = poses_figure(shown, view=View(-90, 0))
    axes = panels(figure)[0]
    render(figure)
    here, right, above = (on_paper(axes, point) for point in ((0, 0, 0), (1, 0, 0), (0, 0, 1)))
    assert right[0] > here[0]
    assert above[1] > here[1]
    assert right[1] == pytest.approx(here[1], abs=1e-6)
    assert above[0] == pytest.approx(here[0], abs=1e-6)


def test_legs_have_their_colours_and_one_legend() -> None:
    figure, _ = standard("mourrain-l")
    for axes in panels(figure):
        drawn = {entry.get_gid(): entry.get_color() for entry in axes.lines if str(entry.get_gid()).startswith("leg")}
        assert drawn == {f"leg-{leg}": LEG_COLOURS[leg - 1] for leg in range(1, 7)}
    (legend,) = figure.legends
    entries = {text.get_text(): handle for text, handle in zip(legend.get_texts(), legend.legend_handles, strict=True)}
    assert {name: entries[name].get_color() for name in drawn_names()} == {
        name: LEG_COLOURS[leg] for leg, name in enumerate(drawn_names())
    }
    assert {"base", "platform"} < set(entries)


def drawn_names() -> list[str]:
    """What the legend calls the legs."""
    return [f"leg {leg}" for leg in range(1, 7)]


def test_cables_are_thin_and_called_so() -> None:
    shown = replace(scene("mourrain-l"), cables=True)
    figure = poses_figure(shown)
    entries = {text.get_text() for text in figure.legends[0].get_texts()}
    assert {f"cable {leg}" for leg in range(1, 7)} < entries
    widths = [
        [entry.get_linewidth() for axes in panels(one) for entry in axes.lines if entry.get_gid() == "leg-1"]
        for one in (figure, standard("mourrain-l")[0])
    ]
    assert max(widths[0]) < 0.5 * min(widths[1])


def test_an_overlay_numbers_all_poses() -> None:
    shown = scene("mourrain-l")
    texts = [text for text, _ in standard("mourrain-l", "overlay")[1].texts]
    assert {str(pose.number) for pose in shown.poses} <= set(texts)


# Nothing is cut off, nothing overlaps


@pytest.mark.parametrize("name", ["mourrain-l", *map(slow, ("hexa", "hexaglide", "linapod-n")), "3-prr"])
@pytest.mark.parametrize("figure", FIGURES)
def test_nothing_is_cut_off(name: str, figure: str) -> None:
    _, drawn = standard(name, figure)
    assert drawn.texts_inside()
    assert drawn.edge_is_white()


@pytest.mark.parametrize("figure", ["grid", "one", slow("overlay")])
@pytest.mark.parametrize(
    "view", [View(0, 0), slow(View(10, 89)), slow(View(-90, -90)), View(45, -35), slow(View(180, 5))]
)
def test_nothing_is_cut_off_from_any_side(figure: str, view: View) -> None:
    drawn = render(FIGURES[figure](scene("linapod-n"), view=view))
    assert drawn.texts_inside()
    assert drawn.edge_is_white()


@pytest.mark.parametrize("size", [(4.5, 9.0), slow((14.0, 4.0)), slow((6.0, 6.0)), slow((30.0, 30.0))])
@pytest.mark.parametrize("figure", FIGURES)
def test_nothing_is_cut_off_at_any_size(figure: str, size: tuple[float, float]) -> None:
    made = FIGURES[figure](scene("mourrain-l"), size=size)
    assert tuple(made.get_size_inches()) == size
    drawn = render(made)
    assert drawn.texts_inside()
    assert drawn.edge_is_white()


@pytest.mark.parametrize("factor", [slow(1e-6), slow(1e6), 1e90, slow(1e-90)])
@pytest.mark.parametrize("figure", FIGURES)
def test_nothing_is_cut_off_in_any_unit(figure: str, factor: float) -> None:
    drawn = render(FIGURES[figure](scaled(scene("mourrain-l"), factor)))
    assert drawn.texts_inside()
    assert drawn.edge_is_white()


def scaled(shown: Scene, factor: float) -> Scene:
    """The same robot in another unit of length."""

    def larger(points: tuple[tuple[float, ...], ...]) -> Any:
        return tuple(tuple(factor * x for x in point) for point in points)

    def moved(pose: PoseView) -> PoseView:
        return replace(pose, position=larger((pose.position,))[0], platform=larger(pose.platform))

    lengths = tuple(factor * x for x in shown.lengths)
    poses = tuple(map(moved, shown.poses))
    return replace(shown, base=larger(shown.base), platform=larger(shown.platform), lengths=lengths, poses=poses)


@pytest.mark.parametrize("name", ["mourrain-l", "3-rrr", slow("rolland-6-6"), slow("dietmaier")])
def test_titles_overlap_neither_each_other_nor_drawings(name: str) -> None:
    shown = scene(name)
    figure, drawn = standard(name)
    titles = [box for text, box in drawn.texts if "det J" in text and ":" in text]
    assert len(titles) == len(shown.poses)
    for one, two in combinations([*titles, *headlines(drawn)], 2):
        assert not one.overlaps(two)
    shot = camera(shown, View())
    joints = [*shown.base, *(joint for pose in shown.poses for joint in (*pose.platform, *pose.knees))]
    plan = grid(shown, window([shot.flat(joint) for joint in joints]), None)
    for cell in (plan.cell(place) for place in range(len(shown.poses))):
        ends = (cell.left, cell.bottom, cell.left + cell.width, cell.bottom + cell.height)
        inside = Bbox.from_extents(*(figure.dpi * end for end in ends))
        assert not any(inside.overlaps(title) for title in titles)
    for axes, joint in product(panels(figure), shown.base):
        x, y = on_paper(axes, joint)
        assert not any(box.x0 <= x <= box.x1 and box.y0 <= y <= box.y1 for box in titles)


def headlines(drawn: Drawn) -> list[Bbox]:
    """The two lines at the top."""
    return sorted((box for _, box in drawn.texts), key=lambda box: -box.y1)[:2]


@pytest.mark.parametrize("name", ["mourrain-l", slow("linapod-n"), "3-rrr", slow("hexa")])
@pytest.mark.parametrize("figure", FIGURES)
def test_headline_legend_and_drawing_are_apart(name: str, figure: str) -> None:
    made, drawn = standard(name, figure)
    legend = made.legends[0].get_window_extent()
    entries = {text.get_text() for text in made.legends[0].get_texts()}
    apart = [legend, *headlines(drawn)]
    for text, box in drawn.texts:
        if text not in entries and box not in apart:
            assert not any(box.overlaps(other) for other in apart), text
    for axes in made.axes:
        if axes.get_label() != "key":
            for end in (end for entry in axes.lines if entry.get_gid() for end in line(axes, entry.get_gid())):
                assert not any(box.contains(*on_paper(axes, end)) for box in apart)


@pytest.mark.parametrize(
    "name",
    ["x" * 10_000, "$\\frac{1}{2$ \\unknown", "六足 \u202e\x00\n机器人 🤖" * 3, "", "W" * 48, "%s {} <b>&amp;"],
)
@pytest.mark.parametrize("figure", ["grid", slow("one")])
def test_any_name_is_drawn_as_it_is(name: str, figure: str) -> None:
    shown = replace(scene("3-rpr-merlet-p"), name=name, unit=name, configuration=name)
    drawn = render(FIGURES[figure](shown))
    assert drawn.texts_inside()
    assert drawn.edge_is_white()
    assert any(drawable(name) in text for text, _ in drawn.texts)


def test_a_robot_without_poses_is_drawn_with_what_is_proved() -> None:
    shown = scene_of(inconsistent())
    drawn = render(poses_figure(shown))
    texts = [text for text, _ in drawn.texts]
    assert "proved: no pose, real or complex, has these leg lengths" in texts
    assert drawn.texts_inside()
    assert render(overlay_figure(shown)).edge_is_white()
    with pytest.raises(InputError, match="there is no pose 1"):
        pose_figure(shown, 1)


@pytest.mark.parametrize(
    ("claim", "part"),
    [
        ("not-proven-complete", "not proven complete"),
        ("positive-dimensional-detected", "(detected, not proved)"),
        ("positive-dimensional-proved", "(proved)"),
    ],
)
def test_no_more_is_claimed_than_is_proved(claim: str, part: str) -> None:
    figure = poses_figure(replace(scene("3-rpr-merlet-p"), claim=claim))
    (line_two,) = [text for text, _ in render(figure).texts if part in text]
    assert "complete" not in line_two.replace("not proven complete", "")


# The layout

sizes = st.floats(0.05, 20)


@given(st.integers(1, 40), sizes, sizes, st.one_of(st.none(), st.tuples(st.floats(12, 60), st.floats(12, 60))))
def test_panels_lie_side_by_side_between_header_and_footer(
    count: int, width: float, height: float, size: tuple[float, float] | None
) -> None:
    shown = replace(scene("mourrain-l"), poses=scene("mourrain-l").poses[:1] * count)
    corners = [(0.0, 0.0), (width, height)]
    frame = window(corners)
    plan = grid(shown, frame, size)
    if size is not None:
        assert plan.size == size
    cells = [plan.cell(place) for place in range(count)]
    assert plan.columns * plan.rows >= count > plan.columns * (plan.rows - 1)
    for cell in cells:
        assert cell.left >= 0
        assert cell.left + cell.width <= plan.size[0]
        assert cell.bottom >= plan.below
        assert cell.bottom + cell.height + TITLE <= plan.size[1] - HEADER + 1e-9
        assert plan.scale * frame.width <= cell.width
        assert plan.scale * frame.height <= cell.height
    for one, two in combinations(cells, 2):
        apart = one.left + one.width <= two.left + 1e-9 or one.bottom >= two.bottom + two.height + TITLE - 1e-9
        assert apart


@given(st.lists(st.tuples(sizes, sizes), min_size=1, max_size=9))
def test_a_window_holds_its_points(points: list[tuple[float, float]]) -> None:
    frame = window(points)
    assert isinstance(frame, Window)
    for x, y in points:
        assert abs(x - frame.centre[0]) <= frame.width / 2 * (1 + 1e-9)
        assert abs(y - frame.centre[1]) <= frame.height / 2 * (1 + 1e-9)


@given(st.floats(-360, 360), st.floats(-90, 90))
def test_a_camera_is_an_orthonormal_frame(azimuth: float, elevation: float) -> None:
    shot = camera(scene("mourrain-l"), View(azimuth, elevation))
    frame = np.array([shot.right, shot.up, shot.toward])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(frame) == pytest.approx(1)


@given(st.floats(1e-90, 1e90))
def test_round_lengths_are_the_longest_that_fit(longest: float) -> None:
    found = round_length(longest)
    assert found <= longest * (1 + 1e-8) < 2.5 * found * (1 + 1e-7)


@given(st.lists(st.floats(0, 1), min_size=1, max_size=12), st.floats(0.001, 1))
def test_spread_places_keep_their_order_and_distance(places: list[float], step: float) -> None:
    places, step = sorted(places), min(step, 1 / len(places))
    found = spread(places, step)
    assert all(second - first >= step - 1e-12 for first, second in pairwise(found))
    assert found[0] >= 0
    assert found[-1] <= 1 + 1e-12
    if all(second - first >= step for first, second in pairwise(places)):
        assert found == pytest.approx(places, abs=1e-9)


@given(st.floats(1e-12, 1e12), st.floats(-1e15, 1e15))
def test_stretched_axes_have_an_inverse(unit: float, t: float) -> None:
    for stretch in (Stretch(unit), Stretch(math.inf)):
        assert stretch.back(stretch.of(t)) == pytest.approx(t, rel=1e-9, abs=1e-9 * unit)


# Roots


def _arcs(figure: Figure) -> Any:
    return next(axes for axes in figure.axes if axes.get_label() == "arcs")


@pytest.mark.parametrize("name", ["3-rrr", "3-rpr-triple", slow("rolland-6-6"), slow("dietmaier")])
def test_arcs_change_their_sign_at_the_real_roots_and_only_there(name: str) -> None:
    content = golden(name)
    figure = roots_figure(content)
    curves = [curve for curve in _arcs(figure).lines if len(curve.get_xdata()) > 100]
    assert len(curves) == content["real_poses"] + 1
    signs = []
    for curve in curves:
        heights = np.array(curve.get_ydata())
        inner = heights[1:-1]
        assert (inner >= 0).all() or (inner <= 0).all()
        assert abs(heights).max() == pytest.approx(1)
        signs.append(np.sign(inner.sum()))
    assert all(a == -b for a, b in pairwise(signs))
    degree = len(content["representation"]["eliminant"]) - 1
    plane = next(axes for axes in figure.axes if axes.get_label() == "complex plane")
    counts = [len(entry.get_xdata()) for entry in plane.lines[1:]]
    assert counts == [degree - content["real_poses"], content["real_poses"]]


@pytest.mark.parametrize("name", ["3-rrr", "rolland-6-6", slow("dietmaier")])
def test_roots_carry_the_numbers_of_their_poses(name: str) -> None:
    content = golden(name)
    figure = roots_figure(content)
    order = sorted(range(content["real_poses"]), key=lambda place: Fraction(content["poses"][place]["parameter"][0]))
    numbers = [text.get_text() for text in _arcs(figure).texts if text.get_text().isdigit()]
    assert numbers == [str(place + 1) for place in order]


@pytest.mark.parametrize("name", ["3-rpr-double-q", *map(slow, ("rolland-6-6", "dietmaier", "6-6p", "hexa"))])
@pytest.mark.parametrize("size", [None, (4.0, 4.0), slow((20.0, 5.0))])
def test_nothing_of_the_roots_is_cut_off(name: str, size: tuple[float, float] | None) -> None:
    drawn = render(roots_figure(golden(name), size=size))
    assert drawn.texts_inside()
    assert drawn.edge_is_white()
    numbers = [box for text, box in drawn.texts if text.isdigit() and box.y0 > drawn.height / 2]
    for one, two in combinations(numbers, 2):
        assert not one.overlaps(two)


def test_without_eliminant_there_are_no_roots_to_draw() -> None:
    robot = read_robot(ROOT / "models" / "3-rpr-merlet-p.toml")
    content = certificate(robot, "home", solve_krawczyk(robot.problem(robot.configuration())))
    with pytest.raises(InputError, match="--method exact"):
        roots_figure(content)
    with pytest.raises(InputError, match="there are no solutions"):
        roots_figure(inconsistent())


def test_the_roots_of_witnesses_are_not_drawn(collinear_model: Path) -> None:
    robot = read_robot(collinear_model)
    content = certificate(robot, robot.configuration().name, solve(robot.problem(robot.configuration())))
    assert content["claim"] == "positive-dimensional-proved"
    with pytest.raises(InputError, match="witnesses"):
        roots_figure(content)
    assert "curves or surfaces (proved)" in " ".join(text for text, _ in render(poses_figure(scene_of(content))).texts)


# Files


def _run(words: list[str], folder: Path, **environment: str) -> None:
    command = [sys.executable, "-W", "error", "-m", "pkm_exact.cli.main", "plot", *words]
    subprocess.run(command, check=True, cwd=folder, env=os.environ | environment, stdout=subprocess.DEVNULL)


@pytest.mark.parametrize("suffix", ["svg", slow("png"), slow("pdf")])
def test_the_same_bytes_whatever_the_user_and_the_time(suffix: str, tmp_path: Path) -> None:
    settings = tmp_path / "settings"
    settings.mkdir()
    lines = ("font.size: 30", "savefig.bbox: tight", "figure.dpi: 40", "text.usetex: True", "axes.facecolor: black")
    (settings / "matplotlibrc").write_text("\n".join(lines) + "\n")
    words = [MERLET, "--dpi", "50", "-o"]
    _run([*words, f"one.{suffix}"], tmp_path, PYTHONHASHSEED="1", TZ="UTC")
    _run([*words, f"two.{suffix}"], tmp_path, PYTHONHASHSEED="2", MATPLOTLIBRC=str(settings), SOURCE_DATE_EPOCH="1")
    assert (tmp_path / f"one.{suffix}").read_bytes() == (tmp_path / f"two.{suffix}").read_bytes()


STARTS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.mark.parametrize(
    ("suffix", "options"),
    [
        ("png", []),
        ("svg", ["--pose", "2"]),
        ("pdf", ["--overlay"]),
        ("PNG", ["--overlay", "--pose", "1"]),
        ("svg", ["--roots"]),
    ],
)
def test_files_have_the_format_of_their_names(suffix: str, options: list[str], tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / f"picture.{suffix}"
    assert main(["plot", MERLET, "-o", str(path), *options]) == 0
    data = path.read_bytes()
    assert data.startswith(STARTS[suffix.lower()])
    assert not any(word in data for word in (b"CreationDate", b"dc:date", b"Software"))
    out, err = capsys.readouterr()
    assert out.startswith(f"{path}: ")
    assert err == ""
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["rolland-6-6", "mssm", "hexa"])
def test_a_single_pose_is_seen_from_where_legs_hide_each_other_least(name: str) -> None:
    shown = scene(name)
    for pose in shown.poses[:3]:
        chosen = clearness(shown, pose, clear_view(shown, pose))
        others = [clearness(shown, pose, View(azimuth, 30)) for azimuth in range(-180, 180, 30)]
        assert chosen >= max(0.98 * max(others), 0.3)


def test_legs_behind_each_other_and_legs_seen_from_their_ends_are_not_clear() -> None:
    """Two upright legs, of which one stands behind the other along the x-axis, and a third that lies along it."""
    legs = replace(scene("rolland-6-6"), base=((0, 0, 0), (9, 0, 0), (3, 5, 0)), legs=((0, 0), (1, 1), (2, 2)))
    pose = replace(legs.poses[0], platform=((0, 0, 4), (9, 0, 4), (9, 5, 0)), knees=())
    assert clearness(legs, pose, View(0, 0)) == 0
    assert clearness(legs, pose, View(-90, 0)) == pytest.approx(1, abs=0.1)
    assert clearness(legs, pose, View(-90, 89)) < 0.05
    view = clear_view(legs, pose)
    assert clearness(legs, pose, view) > 0.7


def test_the_command_says_from_where_a_pose_is_seen(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "pose.svg"
    source = str(ROOT / "certs" / "mssm.json")
    assert main(["plot", source, "-o", str(path), "--pose", "1"]) == 0
    assert re.fullmatch(r".*: pose 1 of \d+, seen from -?\d+,\d+\n", capsys.readouterr().out)
    chosen = path.read_bytes()
    assert main(["plot", source, "-o", str(path), "--pose", "1", "--view", "-60,20"]) == 0
    assert "seen from" not in capsys.readouterr().out
    assert path.read_bytes() != chosen


def test_the_pose_that_is_meant_is_marked(tmp_path: Path, capsys: Capture) -> None:
    near = ["--near", "5,5,1"]
    for options in ([], ["--overlay"]):
        assert main(["plot", MERLET, "-o", str(tmp_path / "all.png"), *options, *near]) == 0
        assert capsys.readouterr().out.endswith("; complete; 2*: nearest to the pose that is meant\n")
    marked = scene_of(golden("3-rpr-merlet-p"), None, [Fraction(5), Fraction(5), Fraction(1)])
    texts = [text for text, _ in render(poses_figure(marked)).texts]
    assert [text.split(":")[0] for text in texts if ": det J" in text] == ["1", "2*"]
    assert "2*" in [text for text, _ in render(overlay_figure(marked)).texts]
    assert "nearest" in " ".join(text for text, _ in render(pose_figure(marked, 2)).texts)
    assert "nearest" not in " ".join(text for text, _ in render(pose_figure(marked, 1)).texts)
    robot = replace(
        model("3-rpr-merlet-p"), nominal=nominal_from_numbers([Fraction(5), Fraction(5), Fraction(1)], "", PLANAR)
    )
    assert [pose.is_nearest for pose in scene_of(golden("3-rpr-merlet-p"), robot).poses] == [False, True]


def test_the_picture_in_the_documentation_is_the_command_s() -> None:
    import matplotlib as mpl

    kept = (ROOT / "docs" / "images" / "rolland-poses.svg").read_bytes()
    assert len(kept) < 200_000
    if f"Matplotlib v{mpl.__version__}," not in kept.decode():
        pytest.skip("drawn by another version of matplotlib")
    assert figure_bytes(poses_figure(scene("rolland-6-6")), "svg") == kept


def test_settings_of_the_user_come_back() -> None:
    import matplotlib as mpl

    with mpl.rc_context({"font.size": 17.0}):
        figure_bytes(poses_figure(scene("3-rpr-merlet-p")), "png", dpi=30)
        assert mpl.rcParams["font.size"] == 17.0
    assert "matplotlib.pyplot" not in sys.modules or not sys.modules["matplotlib.pyplot"].get_fignums()


@pytest.fixture
def stays_empty(tmp_path: Path) -> Iterator[Path]:
    """A folder in which nothing may appear."""
    yield tmp_path
    assert list(tmp_path.iterdir()) == []


def _fails(words: list[str], part: str, capsys: Capture, code: int = 2) -> None:
    assert main(["plot", *words]) == code
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.startswith("certify-poses: error: ")
    assert part in err


BAD_OPTIONS = [
    (["--pose", "0"], "there is no pose 0; give a number from 1 to 2"),
    (["--pose", "3"], "there is no pose 3"),
    (["--pose", "one"], "--pose: 'one' is not a whole number"),
    (["--roots", "--pose", "1"], "--roots excludes"),
    (["--roots", "--overlay"], "--roots excludes"),
    (["--roots", "--view", "0,0"], "--roots excludes"),
    (["--roots", "--model", "x.toml"], "--roots excludes"),
    (["--view", "10"], "1 numbers given, two are needed"),
    (["--view", "nan,0"], "--view: nan is not a finite number"),
    (["--view", "0,91"], "out of range"),
    (["--view", "1e999999999,0"], "too long"),
    (["--size", "1,5"], "--size: '1,5' is out of range"),
    (["--size", "5,inf"], "--size: inf is not"),
    (["--size", "2,2"], "inches are too small for 2 poses"),
    (["--size", "2,2", "--pose", "1"], "size: too small"),
    (["--size", "3,3", "--roots"], "at least 4,4 inches"),
    (["--size", "60,60", "--dpi", "600"], "more than 40 million"),
    (["--dpi", "19"], "--dpi"),
    (["--dpi", "601"], "--dpi"),
    (["--model", "missing.toml"], "missing.toml: no such file"),
    (["--near", "1,2"], "--near: 2 numbers; give X,Y,DEGREES"),
    (["--near", "1,x,2"], "--near, number 2: x is not a number"),
    (["--model", str(ROOT / "models" / "3-rrr.toml")], "is not one of the model '3-RRR'"),
]


@pytest.mark.parametrize(("options", "part"), BAD_OPTIONS, ids=[" ".join(row[0])[:40] for row in BAD_OPTIONS])
def test_bad_options_are_one_sentence(options: list[str], part: str, stays_empty: Path, capsys: Capture) -> None:
    _fails([MERLET, "-o", str(stays_empty / "x.png"), *options], part, capsys)


@pytest.mark.parametrize("name", ["x", "x.gif", "x.png.txt", ".png", "x.p\x1bng"])
def test_unknown_formats_are_refused(name: str, stays_empty: Path, capsys: Capture) -> None:
    _fails([MERLET, "-o", str(stays_empty / name)], "no known format", capsys)


def test_outputs_that_cannot_be_are_refused(stays_empty: Path, capsys: Capture) -> None:
    _fails([MERLET, "-o", str(stays_empty / "no" / "x.png")], "does not exist", capsys)


def test_an_output_that_is_an_input_is_refused(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "certificate.svg"
    path.write_bytes(Path(MERLET).read_bytes())
    _fails([str(path), "-o", str(path)], "is the certificate itself", capsys)
    model = tmp_path / "model.png"
    model.write_bytes((ROOT / "models" / "3-rpr-merlet-p.toml").read_bytes())
    _fails([MERLET, "-o", str(model), "--model", str(model)], "is the model file itself", capsys)
    assert path.read_bytes() == Path(MERLET).read_bytes()


def test_nothing_is_drawn_of_a_forged_certificate(tmp_path: Path, capsys: Capture) -> None:
    content = golden("3-rpr-merlet-p")
    content["poses"][0]["position"] = content["poses"][1]["position"]
    forged = tmp_path / "forged.json"
    forged.write_bytes(canonical_bytes(sealed(content)))
    _fails([str(forged), "-o", str(tmp_path / "x.png")], "is rejected", capsys, code=1)
    assert list(tmp_path.iterdir()) == [forged]


def test_a_certificate_of_tolerances_is_named(tmp_path: Path, capsys: Capture) -> None:
    robot = read_robot(ROOT / "models" / "3-rpr-merlet-p.toml")
    problem = robot.problem(robot.configuration())
    result = tolerance_boxes(problem, Tolerances.uniform("0.0001"), solve(problem))
    path = tmp_path / "tolerances.json"
    path.write_bytes(canonical_bytes(tolerance_certificate(robot, "home", result)))
    _fails([str(path), "-o", str(tmp_path / "x.png")], "without --tolerance", capsys)


def test_a_missing_matplotlib_is_named(stays_empty: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    _fails([MERLET, "-o", str(stays_empty / "x.png")], "pip install 'pkm_exact[plots]'", capsys)


def test_an_old_picture_stays_if_the_new_one_fails(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "x.png"
    path.write_bytes(b"old")
    _fails([MERLET, "-o", str(path), "--pose", "7"], "there is no pose 7", capsys)
    assert path.read_bytes() == b"old"

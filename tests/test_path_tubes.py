"""Tubes about paths: which poses they hold, their area, and answers about them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, product
from math import pi
from pathlib import Path

import numpy as np
import pytest
from samples import MODELS, model
from test_regions import asked

from pkm_exact import InputError
from pkm_exact.cli.main import main
from pkm_exact.regions.question_reader import question_from_toml
from pkm_exact.regions.region_conditions import asked_of
from pkm_exact.regions.region_legs import region_machine
from pkm_exact.regions.region_points import PointJudge
from pkm_exact.regions.singularity_locus import locus

FILES = {path.stem: path for path in MODELS}
PLANE = "tube = {{ path = {0}, radius = {1} }}\ndegrees = 0"
TAIL = "\n[conditions]\nreachable = true\n[answer]\nkind = 'all'\n"


@pytest.mark.parametrize(("name", "turned"), [("3-rpr-merlet-p", "degrees = 0"), ("mssm", "rpy_degrees = [0, 0, 0]")])
def test_positions_in_a_tube_are_near_its_path(name: str, turned: str) -> None:
    """Of a grid, in ordinary coordinates, the metric of one model with a root of 3 in it."""
    machine = region_machine(model(name))
    path = [[0, 0, 9], [4, 1, 9], [4, 3, 8]] if name == "mssm" else [[0, 0], [4, 1], [4, 3]]
    text = f"[region]\ntube = {{ path = {path}, radius = '3/2' }}\n{turned}{TAIL}"
    question = question_from_toml(text, machine)
    assert question.enlarged is (name == "mssm")
    asked_here = asked_of(machine, question.chart, question.conditions)
    judge = PointJudge(asked_here, question.region(asked_here, machine.metric))
    roots = [float(g) ** 0.5 for g in machine.metric]
    seen = set()
    for shares in product((0, 1, 2, 3, 4), repeat=len(question.chart.variables)):
        point = tuple(
            low + (high - low) * Fraction(k, 4) for (low, high), k in zip(question.chart.box, shares, strict=True)
        )
        place = np.array([float(x) * root for x, root in zip(point, roots, strict=False)])
        distances = []
        for one, other in pairwise(np.array(path, dtype=float)):
            share = np.clip((place - one) @ (other - one) / ((other - one) @ (other - one)), 0, 1)
            distances.append(np.linalg.norm(place - one - share * (other - one)))
        if abs(min(distances) - 1.5) > 1e-9:
            assert judge.is_inside(point) is bool(min(distances) < 1.5)
            seen.add(judge.is_inside(point))
    assert seen == {True, False}


def test_the_area_of_a_straight_tube() -> None:
    """2 r L + pi r^2: all of it can be reached by legs of any length."""
    machine = region_machine(model("3-rpr-merlet-p"))
    answer = asked(machine, PLANE.format("[[0, 0], [3, 4]]", 1), "reachable = true", "kind = 'map'\nsteps = 13")
    assert answer.measures is not None
    assert answer.measures[0] < 10 + pi < answer.measures[1] < answer.measures[0] + 2


def test_a_path_is_safe_with_a_margin_or_is_not(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Merlet's planar robot at the angle 0 is singular where y = 0, or 5 x + 2 y = 21."""
    machine = region_machine(model("3-rpr-merlet-p"))
    around = "[[6, 3], [6, 6], [3, 6]]"
    assert asked(machine, PLANE.format(around, "1"), "no_type_2 = true").is_proved
    wide = asked(machine, PLANE.format(around, "2.5"), "no_type_2 = true")
    assert wide.counterexample is not None
    question = tmp_path / "question.toml"
    text = f"[region]\n{PLANE.format(around, '1')}{TAIL}".replace("reachable", "no_type_2")
    question.write_text(text)
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question)]) == 0
    assert "proved: all poses of the region are good" in capsys.readouterr().out
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question), "-o", str(tmp_path / "a.json")]) == 0
    assert main(["check", str(tmp_path / "a.json")]) == 0


def test_where_a_straight_way_is_singular(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """From (1, 5) to (5, 3): 5 x + 2 y = 21 at 3/8 of the way; of rods on slides as one finds it along x alone."""
    machine = region_machine(model("3-rpr-merlet-p"))
    tail = "\n[conditions]\nno_type_2 = true\n{0}[answer]\nkind = 'locus'\n"
    text = f"[region]\nline = {{ from = [1, 5], to = [5, 3] }}\ndegrees = 0{tail.format('')}"
    found = locus(machine, question_from_toml(text, machine))
    assert found.points is not None
    assert [(point.lo, point.hi) for point in found.points] == [(Fraction(3, 8), Fraction(3, 8))]
    refuted = asked(machine, "line = { from = [1, 5], to = [5, 3] }\ndegrees = 0", "no_type_2 = true")
    assert refuted.counterexample is not None
    question = tmp_path / "question.toml"
    question.write_text(text.replace("'locus'", "'all'"))
    command = ["region", str(FILES["3-rpr-merlet-p"]), str(question)]
    assert main(command) == 0
    assert "\n  at along = " in capsys.readouterr().out
    assert main([*command, "-o", str(tmp_path / "a.json")]) == 0
    assert main(["check", "--pure", str(tmp_path / "a.json")]) == 0
    slides, modes = region_machine(model("3-prr")), "working_modes = ['+', '-', '-']\n"
    regions = "position = [[-2, 12], 1]", "line = { from = [12, 1], to = [-2, 1] }"
    along_x, back = (
        locus(slides, question_from_toml(f"[region]\n{region}\ndegrees = 0{tail.format(modes)}", slides))
        for region in regions
    )
    assert along_x.points is not None
    assert back.points is not None
    assert len(along_x.points) == len(back.points) == 2
    for one, other in zip(along_x.points, reversed(back.points), strict=True):
        assert abs(float(one.midpoint) - (12 - 14 * float(other.midpoint))) < 1e-9


@pytest.mark.parametrize(
    ("region", "said"),
    [
        ("tube = 3\ndegrees = 0", "is not a table"),
        ("line = 3\ndegrees = 0", "is not a table"),
        ("line = { from = [1, 2], to = [1, 2] }\ndegrees = 0", "is where it begins"),
        ("line = { from = [1, 2], to = [1, 3] }\nposition = [1, 2]\ndegrees = 0", "beside a line"),
        ("tube = { path = [[0, 0]], radius = 1 }\ndegrees = 0", "1 points; give 2"),
        ("tube = { path = [[0, 0], [0, 0]], radius = 1 }\ndegrees = 0", r"path\[2\]: is the point before it"),
        ("tube = { path = [[0, 0], [0]], radius = 1 }\ndegrees = 0", r"path\[2\]: 1 numbers; give 2"),
        ("tube = { path = [[0, 0], [0, 1]], radius = 0 }\ndegrees = 0", "not positive"),
        ("tube = { path = [[0, 0], [0, 1]], radius = 1 }", "no orientation given"),
        ("tube = { path = [[0, 0], [0, 1]], radius = 1 }\nposition = [1, 2]\ndegrees = 0", "beside a tube"),
    ],
)
def test_a_tube_that_is_none_is_refused(region: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        question_from_toml(f"[region]\n{region}{TAIL}", region_machine(model("3-rpr-merlet-p")))

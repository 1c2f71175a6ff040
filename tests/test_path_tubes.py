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
    assert main(["region", str(FILES["3-rpr-merlet-p"]), str(question), "-o", str(tmp_path / "a.json")]) == 2
    assert "no word for tubes" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("region", "said"),
    [
        ("tube = 3\ndegrees = 0", "is not a table"),
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

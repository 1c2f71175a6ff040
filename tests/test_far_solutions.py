"""Solutions far out: proved as by ball arithmetic alone, on the coarsest grids that bear a proof."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb
from samples import model, shipped

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import PLANAR
from pkm_exact.numeric import certification, far_solutions
from pkm_exact.numeric.certification import refined
from pkm_exact.numeric.certified_boxes import centre, certified
from pkm_exact.numeric.chart_equations import ChartSystem
from pkm_exact.numeric.double_boxes import DoubleBoxes
from pkm_exact.numeric.far_solutions import TRIED
from pkm_exact.numeric.grids import GRIDS, dyadic, first_grid, grid_exponents
from pkm_exact.numeric.poses import approximations, certified_solutions, real_poses
from pkm_exact.numeric.seeds import seeds
from pkm_exact.poses.boxes import DEFAULT_WIDTH
from pkm_exact.poses.isolated_solutions import Box
from pkm_exact.precision import working_precision

Patch = pytest.MonkeyPatch


def _problem(number: int) -> ForwardProblem:
    """Rolland's robot at lengths of its own."""
    random, robot = Random(number), model("rolland-6-6")
    lengths = [1250 + Fraction(random.randint(-15000, 15000), 100) for _ in range(6)]
    return robot.problem([length * length for length in lengths])


def _by_balls(problem: ForwardProblem, monkeypatch: Patch) -> Any:
    """Every grid is tried, from the first one on."""
    with monkeypatch.context() as changed:
        changed.setattr(certification, "_in_doubles", lambda _, points, __: DoubleBoxes.none(points))
        changed.setattr(certification, "_first_grid", lambda *_: GRIDS[0])
        return certified_solutions(problem, seeds(problem))[1]


def _grids(boxes: tuple[Box, ...]) -> Counter[int]:
    return Counter(box.exponents[0] for box in boxes)


@pytest.mark.parametrize("number", [1, *(pytest.param(n, marks=pytest.mark.slow) for n in range(2, 40))])
def test_boxes_are_those_of_ball_arithmetic(number: int, monkeypatch: Patch) -> None:
    problem = _problem(number)
    isolated = certified_solutions(problem, seeds(problem))[1]
    assert isolated == _by_balls(problem, monkeypatch)


def test_most_are_proved_at_once(monkeypatch: Patch) -> None:
    problem, asked = _problem(1), []

    def counted(system: Any, boxes: list[Box]) -> list[bool]:
        asked.extend(boxes)
        return certified(system, boxes)

    monkeypatch.setattr(certification, "certified", counted)
    isolated = certified_solutions(problem, seeds(problem))[1]
    grids = _grids(isolated.pairs)
    assert sum(grids[grid] for grid in TRIED) >= 5
    assert len(asked) <= 1


def test_what_is_proved_is_proved_by_the_operator_alone() -> None:
    problem = _problem(3)
    system, isolated = certified_solutions(problem, seeds(problem))
    far = [box for box in isolated.pairs if box.exponents[0] in TRIED]
    assert far
    assert all(certified(system, far))


def test_points_that_are_no_solutions_prove_nothing() -> None:
    """Points beside solutions lead to them or to nothing; those of no use to nothing."""
    problem = _problem(1)
    system, isolated = certified_solutions(problem, seeds(problem))
    boxes = [box for box in isolated.pairs if box.exponents[0] in TRIED]
    points = np.array([[complex(entry.mid()) for entry in centre(system, box).entries()] for box in boxes])
    assert far_solutions.far_solutions([system], [points])[0].boxes == boxes
    assert far_solutions.far_solutions([system], [points.conj()])[0].boxes == boxes
    random = np.random.default_rng(2)
    for size in (1e-12, 1e-9, 1e-6, 1e-2):
        moved: Any = points * (1 + size * random.standard_normal(points.shape))
        for far, box in zip(far_solutions.far_solutions([system], [moved])[0].boxes, boxes, strict=True):
            assert far in (None, box)
    useless: list[Any] = [0 * points, points * np.nan, points[:0], points * 1e300]
    for wrong in useless:
        assert far_solutions.far_solutions([system], [wrong])[0].boxes == [None] * len(wrong)


@pytest.mark.parametrize("name", ["rolland-6-6", "6-6pp"])
def test_what_is_not_proved_is_handed_on_as_exactly_as_it_says(name: str, monkeypatch: Patch) -> None:
    """With no proof in doubles, all solutions are handed on; ball arithmetic finds them where they are said to be."""
    problem = shipped(name)
    system, isolated = certified_solutions(problem, seeds(problem))
    boxes = [box for box in isolated.pairs if box.exponents[0] in TRIED]
    points = np.array([[complex(entry.mid()) for entry in centre(system, box).entries()] for box in boxes])
    monkeypatch.setattr(far_solutions, "SURE", 0.0)
    found = far_solutions.far_solutions([system], [points * (1 + 1e-9)])[0]
    assert found.boxes == [None] * len(boxes)
    limits = [limit for limit in found.limits if limit is not None]
    assert len(limits) == len(boxes) >= 5
    assert [limit.known for limit in limits].count(0) <= len(limits) // 4
    for limit in limits:
        column = certification._exactly(limit)
        true = refined(system, column, 200)
        assert true is not None
        exponents = grid_exponents(system, [dyadic(value) for value in true[0].entries()], limit.known)
        with working_precision(600):
            for index, entry in zip(system.support, (true[0] - column).entries(), strict=True):
                assert not limit.known or abs(entry) < arb(2) ** (-28 - exponents[index // 4])


BOUNDS = [
    *(("CLOSE", 2.0**20), ("STEPS", 1), ("LARGEST", 1.0), ("ASTRAY", 0.0), ("NEARBY", 0.0), ("SURE", 0.2)),
    *(("TRIED", (44,)), ("SLACK", 3.0), ("BITS", 200), ("SHORTER", 0.0), ("MOVED", 0.0), ("SETTLED", 0.0)),
]


@pytest.mark.parametrize(("bound", "value"), BOUNDS)
def test_what_is_not_as_usual_is_left_to_others(bound: str, value: Any, monkeypatch: Patch) -> None:
    problem = shipped("rolland-6-6")
    expected = certified_solutions(problem, seeds(problem))[1]
    monkeypatch.setattr(far_solutions, bound, value)
    assert certified_solutions(problem, seeds(problem))[1] == expected


def test_values_at_integers_are_exact_but_for_one_rounding() -> None:
    """Also of equations that are mixed, so that the square of the distance is in one of them only."""
    problem, random = shipped("rolland-6-6"), Random(4)
    system = ChartSystem(problem, (3, -1, 2, 1))
    mixed, original = system.mixed, system.in_doubles
    assert mixed is not None
    assert original is not None
    points = [[(random.randrange(-(1 << 70), 1 << 70), random.randrange(1 << 70)) for _ in range(8)] for _ in range(2)]
    parts = [[list(part) for part in zip(*x, strict=True)] for x in points]
    found = mixed.equations.forms.at_integers(parts, 64, [0, 0])
    for x, (reals, imaginaries) in zip(points, found.tolist(), strict=True):
        z = [(Fraction(a, 1 << 64), Fraction(b, 1 << 64)) for a, b in x]
        plain = [_value(quadric, z) for quadric in system.quadrics]
        real, imaginary = (sum(w * v[k] for w, v in zip(system.chart, z, strict=False)) for k in (0, 1))
        plain.append((Fraction(real - 1), Fraction(imaginary)))
        scaled = [[part / 2 ** int(k) for part in v] for v, k in zip(plain, original.forms.powers, strict=True)]
        for row, *value in zip(mixed.mixing.tolist(), reals, imaginaries, strict=True):
            for k, part in enumerate(value):
                exact = sum(Fraction(w) * v[k] for w, v in zip(row, scaled, strict=True))
                assert abs(Fraction(part) - exact) <= abs(exact) / 2**52
    forms = mixed.equations.forms
    assert np.count_nonzero(forms.head[:, (forms.first == 4) & (forms.second == 4)]) == 1


def _value(quadric: Any, z: list[tuple[Fraction, Fraction]]) -> tuple[Fraction, Fraction]:
    terms = [(c, z[i], z[j]) for (i, j), c in quadric.items()]
    real = sum((c * (a[0] * b[0] - a[1] * b[1]) for c, a, b in terms), Fraction(0))
    return real, sum((c * (a[0] * b[1] + a[1] * b[0]) for c, a, b in terms), Fraction(0))


def test_the_first_grid_is_the_first_that_bears_the_width() -> None:
    assert [first_grid(width, 44) for width in (0.55, 0.56, 0.5 * 2**28, 2**28, 2.0**-16 / 2)] == [44, 72, 72, 120, 28]
    assert first_grid(float("inf"), 44) == GRIDS[-1]


def test_real_solutions_close_to_each_other_are_proved_too(monkeypatch: Patch) -> None:
    robot = model("3-rpr-double-q")
    first, *rest = (leg.length_squared for leg in robot.problem(robot.configuration()).distances)
    problem = robot.problem([first + Fraction(1, 10**11), *rest])
    found = approximations(problem)
    system, isolated = certified_solutions(problem, found)
    near = [box for box in isolated.real if box.exponents[0] == 44 and box in system.double_solutions]
    assert len(near) == 2
    poses = real_poses(system, isolated, DEFAULT_WIDTH)
    with monkeypatch.context() as changed:
        changed.setattr(certification, "_in_doubles", lambda _, points, __: DoubleBoxes.none(points))
        system, again = certified_solutions(problem, found)
    assert (again, real_poses(system, again, DEFAULT_WIDTH)) == (isolated, poses)


def test_an_equation_that_is_a_multiple_of_another_is_left_to_others() -> None:
    legs = model("3-rpr-merlet-p").problem([Fraction(50), Fraction(26), Fraction(25)]).distances
    system = ChartSystem(ForwardProblem((legs[0], legs[0], legs[1]), motion=PLANAR), (3, -1, 0, 0))
    assert system.in_doubles is not None
    assert system.mixed is None
    found = far_solutions.far_solutions([system], [np.ones((1, 4), dtype=complex)])[0]
    assert found.boxes == [None]

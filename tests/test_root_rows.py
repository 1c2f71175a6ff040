"""Measurements whose rows have square roots: ranks and combinations are exact, or it is said that they are not."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from random import Random

import numpy as np
import pytest

from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.identification.observation import identify
from pkm_exact.identification.root_rows import identified_with_plan, identify_by_roots, least_rank, parts, plan_by_roots
from pkm_exact.radicals import Number, RootSum

Capture = pytest.CaptureFixture[str]
ROOT = Path(__file__).parent.parent
PLANE = str(ROOT / "models/3-rpr-merlet-p.toml")


def _root(n: int) -> RootSum:
    return RootSum.root(Fraction(n))


def test_rational_rows_are_those_of_before() -> None:
    groups = [[[1, 2, 0]], [[2, 4, 1], [0, 0, 1]]]
    found, plan = identified_with_plan(groups, ["a", "b", "c"])
    assert found == identify([row for rows in groups for row in rows], ["a", "b", "c"])
    assert (plan.chosen, plan.is_smallest) == ((1,), True)


def test_parts_of_one_class_are_put_together() -> None:
    row = [_root(8) + 1, _root(2) * 3, _root(18) - _root(3), Fraction(0)]
    found = parts(row)
    assert sorted(tuple(map(int, part)) for part in found) == [(0, 0, -1, 0), (1, 0, 0, 0), (2, 3, 3, 0)]


@pytest.mark.parametrize("seed", range(6))
def test_roots_in_a_column_are_told_from_rational_changes(seed: int) -> None:
    """The rows of a leg with a zero of its reading: the null space that is known is found, and nothing else."""
    random = Random(seed)
    seen = [[Fraction(random.randint(-5, 5)) for _ in range(3)] for _ in range(8)]
    rows: list[list[Number]] = [[*row, row[0] - 2 * row[2], _root(random.choice((2, 3, 5, 6, 7, 10)))] for row in seen]
    names = ["a", "b", "c", "mixed", "zero"]
    found = identify_by_roots(rows, names)
    assert found.rank == 4
    assert found.null_space == ((Fraction(-1), Fraction(0), Fraction(2), Fraction(1), Fraction(0)),)
    assert "zero" in found.seen_alone
    floats = np.array([[float(x) for x in row] for row in rows])
    assert np.linalg.matrix_rank(floats) == 4 == least_rank(rows)


def test_irrational_combinations_are_not_spelled() -> None:
    two = _root(2)
    with pytest.raises(InputError, match=r"irrational coefficients \(rank 1, as many as equations, of 2"):
        identify_by_roots([[1, two]], ["a", "b"])
    with pytest.raises(InputError, match="rank 1 at least"):
        identify_by_roots([[1, two], [two, 2]], ["a", "b"])
    assert least_rank([[0, 0]]) == 0


def test_a_plan_is_called_smallest_where_fewer_have_too_few_equations() -> None:
    two = _root(2)
    groups = [[[1, two], [two, 2]], [[1, two]], [[0, 1]]]
    assert plan_by_roots(groups, 2) == plan_by_roots(groups, 2)
    plan = plan_by_roots(groups, 2)
    assert plan.chosen == (0, 2)
    assert not plan.is_smallest, "one pose has two equations, and that they are dependent is not proved"
    assert plan_by_roots(groups[1:], 2).is_smallest


PLAN = "x,y,half_tangent\n5,4,0\n6,3,1/3\n2,9,-1/2\n7,7,2\n4,5,1\n3,3,-1/4\n"


def test_zeros_of_readings_at_irrational_lengths(tmp_path: Path, capsys: Capture) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text(PLAN)
    assert main(["identify", PLANE, str(plan), "--zeros"]) == 0
    out = capsys.readouterr().out
    assert "rank 15: all parameters are determined" in out
    assert "poses 1, 2, 3, 4, 5: no fewer do" in out


def test_a_platform_that_never_turns_does_not_tell_its_joints(tmp_path: Path, capsys: Capture) -> None:
    plan = tmp_path / "level.csv"
    plan.write_text("x,y,half_tangent\n5,4,0\n6,3,0\n2,9,0\n7,7,0\n")
    assert main(["identify", PLANE, str(plan), "--zeros", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["rank"] == 9
    assert {"leg 1 base x": "1", "leg 1 platform x": "-1"} in found["base"]
    assert {"leg 1 zero": "1"} in found["base"]


def test_too_few_poses_say_what_is_proved(tmp_path: Path, capsys: Capture) -> None:
    plan = tmp_path / "plan.csv"
    plan.write_text("\n".join(PLAN.splitlines()[:3]) + "\n")
    assert main(["identify", PLANE, str(plan), "--zeros"]) == 2
    error = capsys.readouterr().err
    assert "(rank 6, as many as equations, of 15 parameters); give more poses" in error
    assert error.count("\n") == 1

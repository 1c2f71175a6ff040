"""Many length vectors of one robot: arrays in and out, rows that fail, and what floats may not do."""

from __future__ import annotations

import sys
from decimal import Decimal
from fractions import Fraction
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st
from samples import MODELS

from pkm_exact import InputError, Interval, ManySolutions, PkmExactError, Robot, read_robot, solve, solve_many
from pkm_exact.batch.many import _table, ball_of
from pkm_exact.poses.pose import Pose

PLANAR = [[Fraction(7) + Fraction(k, 8), Fraction(5) - Fraction(k, 9), Fraction(5)] for k in range(5)]


def path(name: str) -> Path:
    return next(path for path in MODELS if path.stem == name)


@cache
def planar() -> Robot:
    corners = [[(0, 0), (10, 0), (3, 10)], [(0, 0), (4, 0), (2, 2)]]
    base, platform = (tuple(tuple(map(Fraction, point)) for point in points) for points in corners)
    return Robot("example", "3-RPR", "m", "made up", base, platform)  # type: ignore[arg-type]


@cache
def rolland() -> tuple[list[list[Fraction]], ManySolutions]:
    random = Random(3)
    rows = [[1250 + Fraction(random.randint(-300, 300), 10) for _ in range(6)] for _ in range(4)]
    return rows, solve_many(path("rolland-6-6"), rows)


def assert_encloses(entry: Any, pose: Pose) -> None:
    """The balls of an entry hold the boxes of the pose, and are hardly wider."""
    for name, intervals in (
        ("position", pose.position),
        ("rotation", sum(pose.rotation, ())),
        ("quaternion", pose.quaternion),
    ):
        pairs = zip(entry[name].flat, entry[f"{name}_half_width"].flat, intervals, strict=True)
        for middle, half_width, interval in pairs:
            low, high = Fraction(middle) - Fraction(half_width), Fraction(middle) + Fraction(half_width)
            assert low <= interval.lo <= interval.hi <= high
            assert high - low <= interval.width + Fraction(abs(middle)) / 2**50


@pytest.mark.parametrize("count", [1, pytest.param(4, marks=pytest.mark.slow)])
def test_rows_have_the_poses_of_the_exact_engine(count: int) -> None:
    rows, found = rolland()
    robot = read_robot(path("rolland-6-6"))
    assert found.fallbacks == found.errors == 0
    assert set(found.rows["method"]) == {"krawczyk"}
    for number, row in enumerate(rows[:count]):
        exact = solve(robot.problem([length * length for length in row]))
        entries = found.poses[found.poses["row"] == number]
        assert found.rows["claim"][number] == exact.claim.value == "complete"
        assert found.rows["complex_solutions"][number] == 40
        assert found.rows["count"][number] == len(entries) == len(exact.poses)
        for entry, pose in zip(entries, exact.poses, strict=True):
            sign = 1 if entry["quaternion"] @ [float(q.midpoint) for q in pose.quaternion] > 0 else -1
            entry["quaternion"] *= sign
            assert_encloses(entry, pose)
            assert pose.jacobian is not None
            assert entry["det_sign"] == pose.jacobian.det_sign


def test_poses_are_rigid_motions_with_the_lengths_of_their_row() -> None:
    rows, found = rolland()
    robot = read_robot(path("rolland-6-6"))
    base, platform = (np.array(joints, dtype=float) for joints in (robot.base_joints, robot.platform_joints))
    for entry in found.poses:
        rotation = entry["rotation"]
        assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-8)
        lengths = np.linalg.norm(entry["position"] + platform @ rotation.T - base, axis=1)
        assert np.allclose(lengths, np.array(rows[entry["row"]], dtype=float), atol=1e-5)


EXACT: list[Any] = [
    [[7, 5, 5], [8, 5, 5]],
    np.array([[7, 5, 5], [8, 5, 5]]),
    np.array([[7, 5, 5], [8, 5, 5]], dtype=np.uint8),
    np.array([["7", "5", "5"], ["8", "5", "5"]]),
    np.array([["14/2", "5.0", "5"], ["8.00", "5", "10/2"]]),
    np.array([[Fraction(7), Fraction(5), 5], [8, "5", Decimal("5.0")]], dtype=object),
    ((Fraction(7), "5", Decimal(5)), (8, 5, np.int64(5))),
]


@pytest.mark.parametrize("lengths", EXACT, ids=range(len(EXACT)))
def test_exact_numbers_of_any_kind_give_the_same(lengths: Any) -> None:
    found, usual = solve_many(planar(), lengths), solve_many(planar(), EXACT[0])
    assert found.rows.tolist() == usual.rows.tolist()
    assert found.poses.tobytes() == usual.poses.tobytes()
    assert found.errors == 0


def test_squared_lengths_are_not_squared_again() -> None:
    one, two = solve_many(planar(), [[7, 5, 5]]), solve_many(planar(), [[49, 25, 25]], squared=True)
    assert one.poses.tobytes() == two.poses.tobytes()
    assert len(one.poses) > 0


FLOATS: list[Any] = [
    *(np.array([[7, 5, 5]], dtype=kind) for kind in (np.float64, np.float32, np.float16)),
    [[7.0, 5, 5]],
    [[np.float64(7), 5, 5]],
    [[np.float32(7), 5, 5]],
    np.array([[7.0, "5", 5]], dtype=object),
    [[float("nan"), 5, 5]],
]


@pytest.mark.parametrize("lengths", FLOATS, ids=range(len(FLOATS)))
def test_floats_are_refused_with_the_remedy_wherever_they_come_from(lengths: Any) -> None:
    match = r'^lengths, row 1, leg 1: .* is a binary float, .* strings such as "1250\.5".*doubles_are_exact=True'
    with pytest.raises(InputError, match=match):
        solve_many(planar(), lengths)


def test_one_float_among_exact_rows_is_found() -> None:
    with pytest.raises(InputError, match=r"^lengths, row 3, leg 2: 5\.25 is a binary float"):
        solve_many(planar(), [[7, 5, 5], ["x", 5, 5], [7, 5.25, 5]])
    found = solve_many(planar(), [[7, 5, 5], ["x", 5, 5], [7, 5.25, 5]], doubles_are_exact=True)
    assert found.rows["claim"].tolist() == ["complete", "error", "complete"]


def test_doubles_are_exact_if_so_stated() -> None:
    doubles = np.array([[7.1, 5.3, 5.7]])
    meant = solve_many(planar(), doubles, doubles_are_exact=True)
    same = solve_many(planar(), [[Fraction(value) for value in doubles[0]]])
    assert meant.errors == 0
    assert meant.poses.tobytes() == same.poses.tobytes()
    wrong = solve_many(planar(), np.array([[np.nan, 5, 5], [np.inf, 5, 5], [7, 5, 5]]), doubles_are_exact=True)
    assert wrong.rows["claim"].tolist() == ["error", "error", "complete"]
    assert "lengths, row 1, leg 1: nan is not a finite number" in wrong.rows["note"][0]


def test_integers_too_large_for_numpy_stay_exact() -> None:
    """One in 2^70 is lost in a double, and moves the poses by more than the width of their boxes."""
    unit, width = 2**70, Fraction(1, 8)
    base, platform = (
        tuple(tuple(value * unit for value in joint[:2]) for joint in joints)
        for joints in (planar().base_joints, planar().platform_joints)
    )
    robot = Robot("large", "3-RPR", "m", "made up", base, platform)  # type: ignore[arg-type]
    one, two = (solve_many(robot, [[7 * unit + more, 5 * unit, 5 * unit]], width=width).poses for more in (0, 1))
    assert len(one) == len(two) == 2
    assert one.tobytes() != two.tobytes() or not np.array_equal(one["position_half_width"], two["position_half_width"])
    assert [type(value) for value in _table(robot, [[2**63, -1, 2**70]], False)[0]] == [int] * 3


@pytest.mark.parametrize("value", ["0", "-5", "x", "1/0", "nan", True, None, 1 + 2j, "1" * 300])
def test_a_wrong_row_does_not_stop_the_others(value: object) -> None:
    found = solve_many(planar(), [[7, 5, 5], [7, value, 5], [7, 5, 5]])
    assert found.rows["claim"].tolist() == ["complete", "error", "complete"]
    assert found.rows["note"][1].startswith("lengths, row 2, leg 2: ")
    assert set(found.poses["row"]) == {0, 2}
    assert found.rows["count"].tolist()[1] == 0
    assert "1 error" in str(found)


@pytest.mark.parametrize(
    "lengths", [[7, 5, 5], [[7, 5]], [[7, 5, 5, 5]], [[7, 5, 5], [7, 5]], 7, np.ones((1, 3, 1), dtype=int)]
)
def test_wrong_shapes_are_refused(lengths: Any) -> None:
    with pytest.raises(InputError, match=r"^lengths: "):
        solve_many(planar(), lengths)


def test_no_row_at_all_gives_empty_arrays() -> None:
    found = solve_many(planar(), np.zeros((0, 3), dtype=int))
    assert (len(found.rows), len(found.poses)) == (0, 0)
    assert str(found) == "0 length vectors, 0 real poses; rows: none; answered by the exact engine: 0"


def test_robots_with_cranks_have_no_lengths_to_vary() -> None:
    with pytest.raises(InputError, match="rods of a 3-RRR robot have fixed lengths"):
        solve_many(path("3-rrr"), [[1, 1, 1]])


def test_fallbacks_are_counted_and_say_why() -> None:
    """A robot with curves at infinity has 16 solutions, and no short proof that these are all."""
    lengths = read_robot(path("similar-planar-s")).configuration().lengths_squared
    found = solve_many(path("similar-planar-s"), [lengths] * 2, squared=True)
    assert found.fallbacks == 2
    assert all("the exact engine answered" in note for note in found.rows["note"])
    assert len(set(found.rows["count"])) == 1
    assert "answered by the exact engine: 2" in str(found)


def test_answers_do_not_depend_on_the_other_rows() -> None:
    together = solve_many(planar(), PLANAR)
    for number, row in enumerate(PLANAR):
        alone = solve_many(planar(), [row])
        entries = together.poses[together.poses["row"] == number].copy()
        for field in ("position", "position_half_width", "rotation", "rotation_half_width", "det_sign"):
            assert np.array_equal(entries[field], alone.poses[field])


def test_progress_is_told_after_every_row() -> None:
    seen: list[int] = []
    solve_many(planar(), PLANAR, progress=seen.append)
    assert seen == [1, 2, 3, 4, 5]


def test_rotations_are_those_of_scipy() -> None:
    pytest.importorskip("scipy")
    _, found = rolland()
    assert np.allclose(found.rotations().as_matrix(), found.poses["rotation"], atol=1e-7)


def test_without_scipy_rotations_are_one_clear_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.spatial.transform", None)
    with pytest.raises(PkmExactError, match=r"scipy is not installed; .*pkm_exact\[scipy\]"):
        rolland()[1].rotations()


@given(st.fractions(), st.fractions(min_value=0, max_value=1))
@hypothesis_settings(max_examples=200)
def test_balls_cover_their_intervals(low: Fraction, width: Fraction) -> None:
    interval = Interval(low, low + width)
    middle, half_width = ball_of(interval)
    assert Fraction(middle) - Fraction(half_width) <= interval.lo
    assert interval.hi <= Fraction(middle) + Fraction(half_width)
    assert Fraction(half_width) <= width / 2 + Fraction(abs(middle)) / 2**51 + Fraction(1, 10**300)


def test_intervals_out_of_reach_of_floats_are_an_error() -> None:
    huge = Fraction(10) ** 400
    with pytest.raises(PkmExactError, match="too large for floating point"):
        ball_of(Interval(huge, huge + 1))

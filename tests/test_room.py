"""Rooms for solutions and poses, asked in doubles: what is right passes there, what is moved is refused as by balls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from samples import boxed

from pkm_exact.errors import InternalContradictionError
from pkm_exact.geometry.study import pose_quadrics
from pkm_exact.numeric import box_consistency, pose_room
from pkm_exact.numeric.box_consistency import _combination, _have_room, _require_room, _require_room_in_integers
from pkm_exact.numeric.pose_room import require_poses_on_robot
from pkm_exact.poses.pose import Interval, Pose
from pkm_exact.poses.pose_consistency import require_on_robot

NAMES = ["mourrain-l", "ssm-exact", "3-rrr", "h4", pytest.param("dietmaier", marks=pytest.mark.slow)]


def _moved(values: Any, place: int, cells: int, exponent: int) -> Any:
    step = Fraction(cells, 1 << exponent)
    entry = values[place]
    return (*values[:place], Interval(entry.lo + step, entry.hi + step), *values[place + 1 :])


def _all_moved(pose: Pose, cells: int, exponent: int) -> list[Pose]:
    moved = [replace(pose, position=_moved(pose.position, k, cells, exponent)) for k in range(3)]
    for i in range(3):
        for j in range(3):
            row = _moved(pose.rotation[i], j, cells, exponent)
            moved.append(replace(pose, rotation=(*pose.rotation[:i], row, *pose.rotation[i + 1 :])))
    return moved + [replace(pose, quaternion=_moved(pose.quaternion, k, cells, exponent)) for k in range(4)]


def _is_refused(check: Callable[..., None], *arguments: Any) -> bool:
    try:
        check(*arguments)
    except InternalContradictionError:
        return True
    return False


@pytest.mark.parametrize("name", NAMES)
def test_right_poses_pass_in_doubles(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    solution = boxed(name)
    assert solution.isolated is not None
    left: list[int] = []
    monkeypatch.setattr(pose_room, "require_on_robot", lambda poses, *_: left.append(len(poses)))
    require_poses_on_robot(solution.poses, solution.problem, solution.box_exponent, solution.isolated.chart)
    assert left == [0]


@pytest.mark.parametrize("cells", [-1, 1, 2, 4, -40, 100000])
@pytest.mark.parametrize("name", ["mourrain-l", "3-rrr"])
def test_moved_poses_are_refused_as_by_balls(name: str, cells: int) -> None:
    solution = boxed(name)
    assert solution.isolated is not None
    rest = solution.problem, solution.box_exponent, solution.isolated.chart
    refused = 0
    for pose in _all_moved(solution.poses[0], cells, solution.box_exponent):
        verdict = _is_refused(require_poses_on_robot, [*solution.poses[1:], pose], *rest)
        assert verdict == _is_refused(require_on_robot, [*solution.poses[1:], pose], *rest)
        refused += verdict
    assert refused >= 15 or abs(cells) < 4


def test_the_other_sign_is_refused() -> None:
    solution = boxed("mourrain-l")
    assert solution.isolated is not None
    pose = solution.poses[0]
    other = replace(pose, quaternion=tuple(Interval(-q.hi, -q.lo) for q in pose.quaternion))
    with pytest.raises(InternalContradictionError, match="sign"):
        require_poses_on_robot([other], solution.problem, solution.box_exponent, solution.isolated.chart)


@pytest.mark.parametrize("name", ["mourrain-l", "3-rrr", pytest.param("rolland-6-6", marks=pytest.mark.slow)])
def test_boxes_have_room_in_doubles_and_moved_ones_have_none(name: str) -> None:
    solution = boxed(name)
    isolated, problem = solution.isolated, solution.problem
    assert isolated is not None
    boxes, combination = [*isolated.real, *isolated.pairs], _combination(pose_quadrics(problem))
    (found,) = _have_room([boxes], [isolated.chart], [combination])
    assert [has_room for box, has_room in zip(boxes, found, strict=True) if box.exponents[0] == 28].count(False) == 0
    _require_room_in_integers(boxes, isolated.chart, combination)
    for box in boxes:
        place = problem.motion.support[1]
        real, imaginary = box.centre[place]
        centre = (*box.centre[:place], (real + 1000, imaginary), *box.centre[place + 1 :])
        assert _have_room([[replace(box, centre=centre)]], [isolated.chart], [combination]) == [[False]]
        with pytest.raises(InternalContradictionError):
            _require_room([replace(box, centre=centre)], isolated.chart, problem)


def test_rooms_of_several_robots_are_those_of_each() -> None:
    """Also where a box or a pose is moved, the joints are others, or there is no pose at all."""
    names = ("mourrain-l", "rolland-6-6", "mourrain-l")
    listed = [(found, found.isolated) for found in map(boxed, names) if found.isolated is not None]
    boxes = [(isolated, found.problem) for found, isolated in listed]
    first = listed[0][1].real[0]
    wrong = replace(first, centre=((first.centre[0][0] + 10**6, 0), *first.centre[1:]))
    boxes[2] = replace(listed[2][1], real=(wrong, *listed[2][1].real[1:])), listed[2][0].problem
    together = box_consistency.boxes_have_room([*boxes, (replace(listed[0][1], real=(), pairs=()), boxes[0][1])])
    assert together == [*(box_consistency.boxes_have_room([row])[0] for row in boxes), []]
    assert (together[0][0], together[2][0]) == (True, False)
    poses = [(list(found.poses), found.problem, isolated.chart) for found, isolated in listed]
    moved = _all_moved(poses[0][0][0], 10**5, listed[0][0].box_exponent)[0]
    same = [poses[0], ([], *poses[0][1:]), ([*poses[0][0], moved], *poses[0][1:])]
    assert pose_room.poses_have_room([]) == box_consistency.boxes_have_room([]) == []
    for asked in (same, [*same, *poses]):
        found = pose_room.poses_have_room(asked)
        assert found == [pose_room.poses_have_room([row])[0] for row in asked]
        assert [len(row) for row in found] == [len(row[0]) for row in asked]
        assert all(found[0])
        assert found[2] == [*found[0], False]


def test_numbers_beyond_doubles_are_left_to_integers(monkeypatch: pytest.MonkeyPatch) -> None:
    isolated = boxed("mourrain-l").isolated
    assert isolated is not None
    huge = [[10**400 if i == j else 0 for j in range(8)] for i in range(8)]
    assert _have_room([isolated.real], [isolated.chart], [huge]) == [[False] * len(isolated.real)]
    monkeypatch.setattr(box_consistency, "gamma", lambda _: 1.0)
    combination = _combination(pose_quadrics(boxed("mourrain-l").problem))
    assert _have_room([isolated.real], [isolated.chart], [combination]) == [[False] * len(isolated.real)]


def test_what_rounding_may_lose_counts() -> None:
    """A value on the border of the room is left to balls, one beside it by more than roundings is not."""
    radius, size = np.ones((2, 1)), np.full((2, 1), 2.0)
    assert pose_room._fits(np.array([[1.0], [1 - 2.0**-40]]), radius, size).tolist() == [False, True]

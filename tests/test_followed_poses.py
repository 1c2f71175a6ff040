"""Poses followed over all robots within tolerance: sampled robots, untrue claims, and what the command says."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise
from itertools import product as product_of
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb
from numpy.typing import NDArray
from samples import MODELS, solved
from tolerance_tools import errors_of, poses_near, robots_with

from pkm_exact.certify.check import check_bytes
from pkm_exact.cli.main import main
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.interactive.display import tolerance_html
from pkm_exact.numeric.branch_bounds import branch_bounds
from pkm_exact.numeric.branch_proof import faces, joins, outer_faces, proved_cells
from pkm_exact.numeric.branch_regularity import CellErrors, LegErrors, is_definite
from pkm_exact.numeric.branch_robot import Box, BranchCell, BranchRobot, ProvedBranch, boxes_of
from pkm_exact.numeric.branch_search import BranchSearch
from pkm_exact.numeric.cell_proof import CellProof, places
from pkm_exact.numeric.centred import NORM, ROTATION, centred_frames, centred_robot
from pkm_exact.numeric.data_errors import DataErrors, data_errors
from pkm_exact.numeric.enclosed_arrays import Enclosed, are_positive, exact, lengths, product
from pkm_exact.numeric.followed_pose import followed_pose, grid_beyond
from pkm_exact.numeric.linearisation import Linearisation
from pkm_exact.numeric.nominal import certified_pose
from pkm_exact.numeric.tolerance import tolerance_boxes
from pkm_exact.precision import working_precision

Capture = pytest.CaptureFixture[str]

NAME = "3-rpr-merlet-p"
MODEL = next(path for path in MODELS if path.stem == NAME)
TOLERANCE = "0.03"
"""Beyond what a box is proved for, at both poses."""
TOLERANCES = (TOLERANCE, "0.045")
"""At the second pose this takes some cells."""
EXPONENT = 128


@cache
def _near(pose: int) -> Linearisation:
    solution = solved(NAME)
    with working_precision(256):
        robot = centred_robot(solution.problem, centred_frames(solution.problem))
        found = certified_pose(robot, solution.poses[pose], solution.poses, EXPONENT)
    assert found is not None
    return found


def _core() -> arb:
    return arb(2) ** -(EXPONENT // 2)


def _errors(pose: int) -> DataErrors:
    return data_errors(_near(pose).robot, Tolerances.uniform(TOLERANCES[pose]))


@cache
def _branch(pose: int) -> tuple[BranchRobot, ProvedBranch]:
    """What was proved, as it is written down."""
    with working_precision(256):
        search = BranchSearch(_near(pose), _errors(pose), _core())
        cells = search.proved(search.found(_errors(pose)))
    assert cells is not None
    assert search.branch is not None
    return cells[0].family, search.branch


def _is_proved(pose: int, **changed: Any) -> bool:
    family, branch = _branch(pose)
    with working_precision(256):
        return proved_cells(family, replace(branch, **changed), _core()) is not None


def _with_cell(branch: ProvedBranch, place: int, **changed: Any) -> tuple[BranchCell, ...]:
    cells = list(branch.cells)
    cells[place] = replace(cells[place], **changed)
    return tuple(cells)


@pytest.mark.parametrize("followed", [False, True])
def test_a_notebook_does_not_say_more_than_is_proved(followed: bool) -> None:
    """The share is rounded down."""
    solution = solved(NAME)
    result = tolerance_boxes(solution.problem, Tolerances.uniform(TOLERANCE), solution)
    box, share = result.boxes[0], Fraction(99999, 100000)
    found = None if box.followed is None else replace(box.followed, fraction=share)
    changed = replace(box, followed=found) if followed else replace(box, fraction=share, followed=None)
    assert ">99.9 %" in tolerance_html(replace(result, boxes=(changed,)))


def test_sampled_robots_have_their_pose_within_the_bounds() -> None:
    solution = solved(NAME)
    tolerances = Tolerances.uniform(TOLERANCE)
    result = tolerance_boxes(solution.problem, tolerances, solution)
    assert not any(box.is_proved for box in result.boxes)
    errors = errors_of(solution.problem, 2000, 3)
    for box in result.boxes:
        followed = box.followed
        assert followed is not None
        assert followed.is_whole
        assert followed.cells == 1
        pose = solution.poses[box.pose - 1]
        found = poses_near(robots_with(solution.problem, tolerances, errors), pose)
        components = followed.bounds.components
        for k in range(16):
            assert float(components[k].lo) <= found[:, k].min() <= found[:, k].max() <= float(components[k].hi)
        moved = np.linalg.norm(found[:, :3] - [float(x.midpoint) for x in pose.position], axis=1)
        bounds = followed.bounds.position_error
        assert 0 <= float(bounds.lo) < moved.max() < float(bounds.hi) < 4 * moved.max()
        assert 0 < float(followed.bounds.rotation_error.lo) < float(followed.bounds.rotation_error.hi) < 0.4


@pytest.mark.slow
def test_a_hexapod_is_followed_farther_than_boxes_reach() -> None:
    solution = solved("mourrain-l")
    result = tolerance_boxes(solution.problem, Tolerances.uniform("0.01"), solution, asked=[1])
    (box,) = result.boxes
    assert box.followed is not None
    assert box.followed.is_whole
    assert box.fraction < Fraction(1, 3)


@pytest.mark.slow
@pytest.mark.parametrize("pose", [1, pytest.param(2, marks=pytest.mark.largest)])
def test_what_is_followed_for_some_tolerances_is_followed_for_less(pose: int) -> None:
    """The limit is the same point of the grid, from wherever it is looked for; anything below it is followed whole."""
    solution = solved(NAME)

    def followed(tolerance: Fraction) -> Fraction:
        (box,) = tolerance_boxes(solution.problem, Tolerances.uniform(tolerance), solution, asked=[pose]).boxes
        assert box.followed is not None
        return box.followed.fraction * tolerance

    limit = followed(Fraction(6, 100))
    assert Fraction(4, 100) < limit == followed(Fraction(7, 100))
    for part in (Fraction(999, 1000), Fraction(92, 100), Fraction(7, 10)):
        assert followed(limit * part) == limit * part


class _Search:
    """Finds what is wanted, in place of cells."""

    founds: tuple[tuple[float, float], ...] = ()
    unproved: float = 0.0

    def __init__(self, near: Linearisation, errors: DataErrors, _: arb) -> None:
        self.size = float(errors.base.upper()) * float(near.robot.frames.unit)

    def found(self, _: DataErrors) -> object | None:
        return self.size if any(low < self.size < high for low, high in self.founds) else None

    def proved(self, found: float) -> list[CellProof] | None:
        return None if abs(found - self.unproved) < 1e-9 else []


def test_tolerances_are_tried_in_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Up to the first that is not found, whatever is found beyond; if one is not proved, a neighbour on the grid."""
    monkeypatch.setattr("pkm_exact.numeric.followed_pose.BranchSearch", _Search)
    monkeypatch.setattr("pkm_exact.numeric.followed_pose.branch_bounds", lambda *_: _branch(0))
    nothing = (Fraction(0), Fraction(0))

    def followed(tolerance: str) -> Fraction | None:
        found = followed_pose(_near(0), Tolerances.uniform(tolerance), Fraction(1, 10), nothing, EXPONENT)
        return None if found is None else found.fraction * Fraction(tolerance)

    with working_precision(256):
        monkeypatch.setattr(_Search, "founds", ((0, 0.03), (0.04, 9)))
        last = followed("0.05")
        assert last is not None
        assert 0.03 / 1.1 < last < 0.03
        assert followed("0.039") == followed("0.2") == followed(str(float(last) * 1.01)) == last
        tolerance = str(float(last) * 0.98)
        assert followed(tolerance) == Fraction(tolerance)
        monkeypatch.setattr(_Search, "unproved", float(tolerance))
        assert followed(tolerance) == Fraction(tolerance)
        monkeypatch.setattr(_Search, "unproved", float(last))
        before = followed("0.05")
        assert before is not None
        assert last / Fraction("1.1") < before < last
        monkeypatch.setattr(_Search, "founds", ())
        assert followed("0.05") is None


def test_points_of_the_grid_do_not_depend_on_what_is_asked() -> None:
    every = set(grid_beyond(Fraction(1, 1000), Fraction(1)))
    for tolerance in (Fraction(1, 7), Fraction(3), Fraction(10**9, 7)):
        for fraction in (Fraction(1, 500), Fraction(1, 300), Fraction(1, 1000)):
            points = grid_beyond(fraction / tolerance, 1 / tolerance)
            assert points[0] > fraction / tolerance
            assert {point * tolerance for point in points[: len(every) // 2]} <= every
            assert all(1.08 < high / low < 1.1 for low, high in pairwise(points))


def test_nothing_is_followed_through_a_singularity() -> None:
    # Random robots off by 0.06 are singular near the first pose.
    solution = solved(NAME)
    result = tolerance_boxes(solution.problem, Tolerances.uniform("0.06"), solution, asked=[1])
    first = result.boxes[0].followed
    assert first is not None
    assert Fraction(1, 2) <= first.fraction < 1
    assert not first.is_whole
    assert "followed" not in str(result)


@pytest.mark.parametrize("pose", [0, 1])
def test_what_is_written_down_is_proved_again(pose: int) -> None:
    assert _is_proved(pose)


@pytest.mark.parametrize(
    ("key", "factor"), [("slope", 0.99), ("bend", 0.99), ("radius", 0.5), ("bend", 8), ("bend", -1)]
)
@pytest.mark.parametrize("place", [0, 1])
def test_claims_that_are_untrue_or_too_weak(key: str, factor: float, place: int) -> None:
    branch = _branch(1)[1]
    value = int(getattr(branch.cells[place], key) * factor)
    assert not _is_proved(1, cells=_with_cell(branch, place, **{key: value}))


def test_metrics_that_are_not_definite() -> None:
    """A metric that turns, weights that are too great or small, and none at all."""
    branch = _branch(1)[1]
    cell = branch.cells[0]
    for metric in (tuple(tuple(-v for v in row) for row in cell.metric), cell.metric[::-1]):
        assert not _is_proved(1, cells=_with_cell(branch, 0, metric=metric))
    for factor in (2**12, Fraction(1, 2**12), 0, -1):
        weights = tuple(tuple(int(v * factor) for v in row) for row in cell.weights)
        assert not _is_proved(1, cells=_with_cell(branch, 0, weights=weights))


def test_jacobians_of_sampled_robots_are_definite() -> None:
    """And those of errors that are ten times as great are not all."""
    family, branch = _branch(1)
    with working_precision(256):
        box = boxes_of(branch.reach, branch.cuts)[0][0]
        errors = CellErrors(CellProof(family, branch.cells[0], box))
        assert is_definite(errors)
        random = np.random.default_rng(4)
        metric, cell = np.array(branch.cells[0].metric), errors.cell
        for factor, expected in ((1.0, True), (10.0, False)):
            found = []
            for slopes, effects in zip(errors.slopes.mid, errors.effects.mid, strict=True):
                for t in random.choice([-1.0, 1.0], (40, *effects.shape[:2])):
                    rows = cell.on_legs.mid @ np.einsum("le,lep->lp", t, effects)
                    jacobian = metric @ (np.eye(len(metric)) + factor * (slopes + rows))
                    found.append(np.linalg.eigvalsh(jacobian + jacobian.T)[0] > 0)
            assert all(found) == expected


def test_jacobians_must_be_definite_at_every_corner() -> None:
    """A greater slope, or effect of errors, at one corner is told."""
    with working_precision(256):
        cell = _cell(0)
        assert is_definite(CellErrors(cell))
        for corner in range(len(cell.points.mid)):
            errors = CellErrors(cell)
            errors.slopes.mid[corner] -= 1.5 * np.eye(3)
            assert not is_definite(errors)
            errors = CellErrors(cell)
            errors.effects.mid[corner] *= 10
            assert not is_definite(errors)


def _cell(place: int) -> CellProof:
    family, branch = _branch(1)
    return CellProof(family, branch.cells[place], boxes_of(branch.reach, branch.cuts)[0][place])


def _part(box: Box, leg: int) -> Box:
    """The upper end of a leg, and halves of the others."""
    low = [(low, (low + high) // 2) for low, high in box]
    return (*low[:leg], (box[leg][1], box[leg][1]), *low[leg + 1 :])


def _poses(cell: CellProof, s: NDArray[np.float64]) -> NDArray[np.float64]:
    """y of the poses for some s, by Newton's method in floating point."""
    family, basis = cell.family, cell.family.basis.mid
    y = -(s - cell.middle.mid) @ cell.on_legs.mid.T
    shift = np.zeros((len(s), len(family.quadrics.mid)))
    shift[:, family.first :] = s
    for _ in range(8):
        x = cell.centre.mid + y @ basis.T
        slopes = np.einsum("iab,sb->sia", family.quadrics.mid, x)
        values = np.einsum("sia,sa->si", slopes, x) / 2 + shift
        y = y - np.linalg.solve(slopes @ basis, values[..., None])[..., 0]
    assert np.abs(values).max() < 1e-13
    return y


def _is_near(cell: CellProof, box: Box) -> tuple[float, float]:
    """How far sampled poses of a part are from where they are proved to be, and how far they may be."""
    random = np.random.default_rng(6)
    centre, shifts, away = cell.poses_of(box)
    t = random.uniform(-1, 1, (400, 3))
    t[::2] = np.sign(t[::2])
    middle, half = (value.mid for value in places(box))
    x = cell.centre.mid + _poses(cell, middle + t * half) @ cell.family.basis.mid.T
    there = np.linalg.lstsq(cell.family.basis.mid, (x - centre.mid).T, rcond=None)[0].T
    return float(np.linalg.norm(there + t @ shifts.mid.T, axis=1).max()), away


@pytest.mark.parametrize("place", [0, 1])
def test_poses_of_a_part_of_a_cell_are_where_they_are_proved(place: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Much nearer to a parallelotope than those of the cell; farther if centre and shifts are not good, but proved."""
    inverse = np.linalg.inv
    with working_precision(256):
        family, branch = _branch(1)
        box = boxes_of(branch.reach, branch.cuts)[0][place]
        cell = CellProof(family, branch.cells[place], box)
        assert cell.distance > 0
        for leg in range(3):
            off, away = _is_near(cell, _part(box, leg))
            assert off <= away < min(cell.distance / 2, 12 * off)
        whole = cell.poses_of(tuple((high + 2**46, high + 2**46) for _, high in box))
        assert whole[2] == cell.distance
        with monkeypatch.context() as patched:
            patched.setattr("pkm_exact.numeric.cell_proof.NEWTON", 0)
            ends = tuple((high, high) for _, high in box)
            off, away = _is_near(cell, ends)
            assert 1e-6 < off <= away
        with monkeypatch.context() as patched:
            patched.setattr(np.linalg, "inv", lambda matrix: 1.05 * inverse(matrix))
            off, away = _is_near(cell, _part(box, 0))
            assert off <= away < 12 * off


@pytest.mark.parametrize("away", [0.0, 0.05])
def test_errors_of_legs_are_bounded_closely(away: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Sampled errors, to first order, at and beside sampled poses of parallelotopes so large that bends matter."""
    random = np.random.default_rng(7)
    monkeypatch.setattr(BranchRobot, "rest", lambda _, at: np.zeros(at.mid.shape[1:]))
    with working_precision(256):
        cell = _cell(0)
        family, bent = cell.family, []
        for _ in range(12):
            shifts = random.normal(size=(3, 3)) * 4
            centre = cell.centre.mid + random.normal(size=3) @ family.basis.mid.T
            greatest = LegErrors(family, exact(centre), exact(shifts), away).greatest
            t = random.uniform(-1, 1, (4000, 3))
            t[::2] = np.sign(t[::2])
            beside = random.normal(size=(4000, 3))
            y = t @ shifts.T + away * beside / np.linalg.norm(beside, axis=1)[:, None]
            x = centre + y @ family.basis.mid.T
            errors = np.abs(np.einsum("leab,sa,sb->sle", family.single.mid, x, x) / 2).sum(axis=2).max(axis=0)
            assert (errors <= greatest).all()
            bent += list(greatest / errors)
        assert min(bent) < 1.03
        assert max(bent) < 2


def test_errors_of_legs_have_terms_of_second_order(monkeypatch: pytest.MonkeyPatch) -> None:
    """At one pose the greatest error of all corners of the data is met, and more than it has to first order."""
    with working_precision(256):
        cell = _cell(0)
        family = cell.family
        nothing = exact(np.zeros((3, 3)))
        greatest = LegErrors(family, cell.centre, nothing, 0.0).greatest
        x = cell.centre.mid
        single = np.einsum("leab,a,b->le", family.single.mid, x, x) / 2
        values = np.einsum("kab,a,b->k", family.motions.mid, x, x) / 2
        turn = values[ROTATION:NORM].reshape(3, 3)[:2, :2]
        da, db, dl = (float(e.mid) for e in family.errors)
        signs = np.array(list(product_of((1.0, -1.0), repeat=5)))
        second = values[NORM] * (2 * da * da + 2 * db * db - dl * dl)
        second = second - 2 * da * db * np.einsum("vj,jk,vk->v", signs[:, :2], turn, signs[:, 2:4])
        errors = np.abs(signs @ single.T + second[:, None]).max(axis=0)
        assert (errors <= greatest).all()
        monkeypatch.setattr(BranchRobot, "rest", lambda _, at: np.zeros(at.mid.shape[1:]))
        assert (errors > LegErrors(family, cell.centre, nothing, 0.0).greatest).all()


def test_a_slope_must_be_right_at_opposite_corners_too() -> None:
    """Of two opposite corners one has the greater slope, and the other one if the shifts are reversed."""
    family, branch = _branch(1)
    with working_precision(256):
        written, box = branch.cells[0], boxes_of(branch.reach, branch.cuts)[0][0]
        first = CellProof(family, written, box)
        for turned, shifts in ((first.turned, first.shifts), (-first.turned, -first.shifts)):
            parts = product("vi,iaq->vaq", first.corners, turned).mid
            ends = np.linalg.eigvalsh((parts + np.swapaxes(parts, 1, 2)) / 2)
            slopes = sorted((-ends[:, 0].min(), ends[:, -1].max()))
            for claim, expected in ((int(sum(slopes) * 2**15), False), (written.slope, True)):
                cell = CellProof(family, replace(written, slope=claim), box)
                cell.turned, cell.shifts = turned, shifts
                assert cell.is_monotone() == expected


def test_images_of_a_parallelotope_are_bounded_closely() -> None:
    random = np.random.default_rng(8)
    with working_precision(256):
        cell = _cell(0)
        t = random.uniform(-1, 1, (4000, 3))
        t[::2] = np.sign(t[::2])
        for bent in (0.0, 1.0):
            value, pairs = random.normal(size=3), bent * random.normal(size=(3, 3, 3))
            found = np.linalg.norm(value + np.einsum("aij,vi,vj->va", pairs, t, t) / 2, axis=1).max()
            bound = cell.image(exact(value), exact(pairs))
            assert found <= bound < 1.6 * found
        # Squares alone: from value to value + 3 / 2, all on a line.
        squares = np.zeros((3, 3, 3))
        squares[0] = np.eye(3)
        for start, greatest in ((1.0, 2.5), (-0.75, 0.75), (-2.0, 2.0)):
            assert greatest <= cell.image(exact([start, 0.0, 0.0]), exact(squares)) < 1.001 * greatest


def test_cells_that_hold_other_poses_are_not_joined() -> None:
    """All cells are proved, but one with a pose that is not on this branch is not joined to its neighbour."""
    family, branch = _branch(1)
    with working_precision(256):
        boxes, _ = boxes_of(branch.reach, branch.cuts)
        cells = [CellProof(family, cell, box) for cell, box in zip(branch.cells, boxes, strict=True)]
        i, j, face = next(found for found in faces(boxes, boxes) if found[0] < found[1])
        s = places(face)[0]
        assert joins(cells[i], cells[j], s)
        assert cells[j].holds(cells[j].centre, cells[j].middle, 0.0)
        assert not cells[j].holds(cells[j].centre, cells[j].middle, cells[j].radius)
        far = replace(branch.cells[j], centre=tuple(v + 2**44 for v in branch.cells[j].centre))
        assert not joins(cells[i], CellProof(family, far, boxes[j]), s)


def test_all_neighbours_must_be_joined(monkeypatch: pytest.MonkeyPatch) -> None:
    family, branch = _branch(1)
    boxes, _ = boxes_of(branch.reach, branch.cuts)
    count = sum(i < j for i, j, _ in faces(boxes, boxes))
    assert count >= 2
    for apart in range(count + 1):
        asked = iter(range(count))
        monkeypatch.setattr("pkm_exact.numeric.branch_proof.joins", lambda *_, n=asked, k=apart: next(n) != k)
        with working_precision(256):
            assert (proved_cells(family, branch, _core()) is None) == (apart < count)


def test_no_robot_may_be_at_the_ends_of_cells() -> None:
    """Errors of legs that are at an end of the cells are not covered by what is left out."""
    family, branch = _branch(0)
    with working_precision(256):
        boxes, left_out = boxes_of(branch.reach, branch.cuts)
        (cell,) = branch.cells
        errors = CellErrors(CellProof(family, cell, boxes[0]))
        ends = [face for _, _, face in faces(boxes, left_out)] + [face for _, face in outer_faces(branch.reach, boxes)]
        assert len(ends) == 6
        for face in ends:
            assert errors.leaves(face)
            assert not errors.leaves(tuple((int(0.6 * low), int(0.6 * high)) for low, high in face))
    for leg in range(3):
        cuts = tuple((k, int(0.6 * place) if k == leg + 1 else place) for k, place in branch.cuts)
        reach = tuple(int(r * (0.6 if k == leg else 1)) for k, r in enumerate(branch.reach))
        assert not _is_proved(0, cuts=cuts, reach=reach)


def test_the_nominal_pose_must_be_on_the_branch() -> None:
    family, branch = _branch(0)
    with working_precision(256):
        cells = proved_cells(family, branch, _core())
        assert cells is not None
        nothing = exact(np.zeros(3))
        assert cells[0].holds(cells[0].centre, nothing, 0.0)
        moved = Enclosed(cells[0].centre.mid + 0.01, cells[0].centre.rad)
        assert not cells[0].holds(moved, nothing, 0.0)
        assert proved_cells(family, branch, arb(1) / 100) is None


def test_bounds_that_are_too_wide_for_an_angle() -> None:
    family, branch = _branch(0)
    with working_precision(256):
        cells = proved_cells(family, branch, _core())
        assert cells is not None
        assert branch_bounds(_near(0), cells, _core(), (Fraction(0), Fraction(0))) is not None
        assert branch_bounds(_near(0), cells, arb(4), (Fraction(0), Fraction(0))) is None


def test_boxes_are_cut_in_turn() -> None:
    cells, left_out = boxes_of((4, 8), ((2, 0), (0, 0), (1, 1), (-1, 0), (0, 0)))
    assert cells == [((-4, 4), (-8, 0)), ((1, 4), (0, 8))]
    assert left_out == [((-4, 1), (0, 8))]
    assert faces(cells, cells) == [(0, 1, ((1, 4), (0, 0))), (1, 0, ((1, 4), (0, 0)))]
    assert faces(cells, left_out) == [(0, 0, ((-4, 1), (0, 0))), (1, 0, ((1, 1), (0, 8)))]
    assert faces(cells, []) == []
    assert [place for place, _ in outer_faces((4, 8), cells)] == [0, 0, 0, 1, 1]
    # Cells that have only a corner in common are no neighbours.
    four, _ = boxes_of((1, 1), ((1, 0), (2, 0), (0, 0), (0, 0), (2, 0), (0, 0), (0, 0)))
    assert {pair[:2] for pair in faces(four, four) if pair[0] < pair[1]} == {(0, 1), (0, 2), (1, 3), (2, 3)}
    with pytest.raises(ValueError, match="outside"):
        boxes_of((4, 8), ((1, 4), (0, 0), (0, 0)))
    with pytest.raises(ValueError, match="1 boxes are neither"):
        boxes_of((4, 8), ((1, 1), (0, 0)))


def test_sums_of_products_are_enclosed() -> None:
    random = np.random.default_rng(5)
    a, b = (Enclosed(random.normal(size=(4, 4)), np.abs(random.normal(size=(4, 4))) * 1e-3) for _ in range(2))
    found = product("ij,jk->ik", a, b)
    for sign in (1, -1):
        left, right = (m.mid + sign * m.rad * (1 - 1e-12) for m in (a, b))
        for i in range(4):
            for k in range(4):
                true = sum(Fraction(left[i, j]) * Fraction(right[j, k]) for j in range(4))
                assert abs(true - Fraction(found.mid[i, k])) <= Fraction(found.rad[i, k])
                assert found.rad[i, k] < 0.1
    assert 5 <= lengths(exact([3.0, 4.0])) < 5.001


def test_matrices_that_are_nearly_singular_are_not_called_positive() -> None:
    matrix = np.array([[1.0, 1.0], [1.0, 1.0 + 1e-3]])
    assert are_positive(exact(matrix))
    assert not are_positive(Enclosed(matrix, np.full((2, 2), 6e-4)))
    assert not are_positive(exact([[[2.0, 0.0], [0.0, 1.0]], [[1.0, 2.0], [2.0, 1.0]]]))
    assert not are_positive(exact([[float("nan")]]))


def test_the_command_says_that_the_certificate_does_not_cover_it(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "tolerance.json"
    assert main(["solve", str(MODEL), "--tolerance", TOLERANCE, "-o", str(path)]) == 3
    text = capsys.readouterr().out
    assert "0 of 2 poses have a box for every robot within tolerance; 2 more without a box are followed" in text
    assert text.count("100 %, followed") == 2
    assert text.count("The certificate does not cover this, and lists the pose as not proved") == 2
    assert json.loads(path.read_text())["unproved"] == [1, 2]
    assert check_bytes(path.read_bytes()).status == "accepted"


@pytest.mark.slow
def test_json_has_what_is_followed(capsys: Capture) -> None:
    assert main(["solve", str(MODEL), "--tolerance", "0.06", "--format", "json"]) == 3
    box = json.loads(capsys.readouterr().out)["tolerance"]["boxes"][0]
    assert not box["proved"]
    assert Fraction(box["proved_fraction"]) < Fraction(box["followed"]["fraction"]) < 1
    assert len(box["followed"]["position"]) == 3

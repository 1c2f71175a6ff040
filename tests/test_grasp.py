"""Grasps with friction, errors of all geometric parameters, and pictures of polytopes."""

from fractions import Fraction

import numpy as np
import pytest
from samples import model, solved
from test_statics import POSES, at

from pkm_exact.errors import InputError
from pkm_exact.pictures.polytope_picture import polytope_figure
from pkm_exact.polytopes.rationals import rational_matrix
from pkm_exact.statics.geometric_errors import geometric_jacobian, worst_displacement
from pkm_exact.statics.grasp import Contact, grasp_matrix, internal_forces, is_closed_by_friction
from pkm_exact.statics.machine_at_pose import machine_at
from pkm_exact.statics.stiffness import rod_errors


def contact(x: object, y: object, nx: object, ny: object, *, has_moment: bool = False) -> Contact:
    a, b, c, d = (Fraction(str(value)) for value in (x, y, nx, ny))
    return Contact((a, b), (c, d), has_moment)


def hand(*, has_moment: bool) -> list[Contact]:
    """A thumb against four fingers, as in chapter 20."""
    fingers = [contact(1, y, -1, 0, has_moment=has_moment) for y in ("3/2", "1/2", "-1/2", "-3/2")]
    return [contact(-1, 0, 1, 0, has_moment=has_moment), *fingers]


def test_the_nullities_of_chapter_20() -> None:
    for has_moment, columns, nullity in ((False, 10, 7), (True, 15, 12)):
        rows = grasp_matrix(hand(has_moment=has_moment))
        assert len(rows[0]) == columns
        assert len(internal_forces(hand(has_moment=has_moment))) == nullity
        for force in internal_forces(hand(has_moment=has_moment)):
            assert all(sum(a * b for a, b in zip(row, force, strict=True)) == 0 for row in rows)
    pair = [contact(-1, 0, 1, 0, has_moment=True), contact(1, 0, -1, 0, has_moment=True)]
    assert len(internal_forces(pair)) == 3  # grip, opposite moments, and a tangential couple: before any twist
    assert rational_matrix(grasp_matrix(pair)).rank() == 3


def test_friction_closes_what_it_must() -> None:
    """Two contacts close exactly if the line between them lies in the inside of both cones."""
    for height, closed in ((0, True), ("1/5", True), ("2/5", False), ("1/2", False)):
        pair = [contact(-1, 0, 1, 0), contact(1, height, -1, 0)]
        assert is_closed_by_friction(pair, Fraction(1, 5)) == closed
    assert not is_closed_by_friction(hand(has_moment=False)[1:], Fraction(1))  # fingers without the thumb only push


def test_errors_of_all_parameters_move_the_pose_as_they_do() -> None:
    """Against the linear effect of each parameter on the lengths, by differences."""
    found = at("rolland-6-6")
    jacobian = geometric_jacobian(found)
    assert jacobian.shape == (6, 42)
    assert found.jacobian is not None
    rows, table = found.jacobian.to_numpy(), jacobian.to_numpy()
    robot, step = model("rolland-6-6"), 1e-6
    position = np.array([float(x) for x in found.position])
    rotation = np.array([[float(x) for x in row] for row in found.rotation])
    base, platform = (np.array([[float(x) for x in j] for j in joints]) for joints in
                      (robot.base_joints, robot.platform_joints))  # fmt: skip
    nominal = np.linalg.norm(position + platform @ rotation.T - base, axis=1)
    for leg, side, axis in ((0, "base", 0), (3, "platform", 2), (5, "base", 1)):
        moved_base, moved_platform = base.copy(), platform.copy()
        (moved_base if side == "base" else moved_platform)[leg, axis] += step
        change = (np.linalg.norm(position + moved_platform @ rotation.T - moved_base, axis=1) - nominal) / step
        column = table[:, jacobian.columns.index(f"{side}.{'xyz'[axis]}(leg {leg + 1})")]
        assert rows @ column == pytest.approx(-change, abs=1e-5)  # the pose makes up for what the parameter does
    assert np.allclose(table[:, ::7], rod_errors(found).to_numpy())


def test_the_worst_displacement_by_rods_is_that_of_their_errors() -> None:
    robot = model("linapod-n")
    found = machine_at(robot, solved("linapod-n").poses[0])
    bound = float(worst_displacement(found, Fraction(1, 10**6), Fraction(0)))
    parts = np.abs(rod_errors(found).to_numpy()[:3]).sum(axis=1) * 1e-6
    assert bound == pytest.approx(np.linalg.norm(parts))


def test_polytopes_of_two_and_three_dimensions_are_drawn() -> None:
    pytest.importorskip("matplotlib")
    found = at("3-rpr-merlet-p")
    figure = polytope_figure(found.velocity_polytope(1), found.twist, found.ellipsoid(1, 1))
    assert len(figure.axes[0].collections[0].get_facecolor()) >= 1
    measures = found.measures(forces=1)
    from pkm_exact.statics.capability import wrench_zonotope

    zonotope = wrench_zonotope(measures.freedom, *(measures.limits.force_ends or ((), ())))
    assert zonotope is not None
    section = zonotope.section({2: Fraction(0)}).polytope()
    drawn = polytope_figure(section).axes[0].patches[0].get_xy()
    assert len(drawn) >= len(section.vertices)
    with pytest.raises(InputError, match="6 dimensions cannot be drawn"):
        polytope_figure(machine_at(model("rolland-6-6"), POSES["rolland-6-6"]).velocity_polytope(1))

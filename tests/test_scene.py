"""Scenes: the robot in its true shape, the poses where they are, and nothing of a certificate that is not accepted."""

import json
import math
from dataclasses import replace
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certificate_tools import check_resealed, golden
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.certify.build import canonical_bytes, certificate, sealed
from pkm_exact.certify.check import Status
from pkm_exact.certify.legs_view import legs_view
from pkm_exact.engine import solve
from pkm_exact.errors import InputError
from pkm_exact.geometry.reader import read_robot
from pkm_exact.geometry.robot import Robot
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.pictures.drawn_robot import Scene
from pkm_exact.pictures.hull import faces
from pkm_exact.pictures.scene import RejectedError, accepted_document, scene_of, scene_of_solution

ROOT = Path(__file__).parent.parent
QUICK = ("3-prr", "3-rpr-double-q", "3-rpr-merlet-p", "3-rpr-triple", "3-rrr", "6-6p", "dietmaier", "hexa", "linapod-n")
EXACT = ("robocrane-r", "mssm", "rolland-6-6")
CHAINS = {"hexa": "crank", "hexaglide": "slide", "linapod-n": "slide", "3-rrr": "crank", "3-prr": "slide"}


def _model(name: str) -> Any:
    return read_robot(ROOT / "models" / f"{name}.toml")


def _without_box_widths(scene: Scene) -> Scene:
    return replace(scene, poses=tuple(replace(pose, position_half_width=0.0) for pose in scene.poses))


@pytest.mark.parametrize("name", [*QUICK, *EXACT])
def test_legs_have_their_true_lengths(name: str) -> None:
    content = legs_view(golden(name))
    scene = scene_of(content)
    squares = content["configuration"]["lengths_squared"]
    assert len(scene.poses) == content["real_poses"]
    for pose, (leg, (a, b)) in product(scene.poses, enumerate(scene.legs)):
        true = math.sqrt(Fraction(squares[leg]))
        assert math.dist(scene.feet(pose)[a], pose.platform[b]) == pytest.approx(true, rel=1e-14)
        assert scene.lengths[leg] == pytest.approx(true, rel=1e-15)


@pytest.mark.parametrize("name", [*QUICK, *EXACT])
def test_the_platform_is_rigid_and_not_reflected(name: str) -> None:
    scene = scene_of(golden(name))
    for pose in scene.poses:
        rotation = np.array(pose.rotation)
        assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-14)
        assert np.linalg.det(rotation) == pytest.approx(1, abs=1e-14)
        for i, j in product(range(len(scene.platform)), repeat=2):
            inside = math.dist(scene.platform[i], scene.platform[j])
            assert math.dist(pose.platform[i], pose.platform[j]) == pytest.approx(
                inside, abs=1e-12 * max(scene.lengths)
            )


@pytest.mark.parametrize("name", EXACT)
def test_metrics_give_the_true_shape(name: str) -> None:
    """Squared distances in the metric are rational; those drawn are their values."""
    content = legs_view(golden(name))
    scene = scene_of(content)
    g = [int(text) for text in content["robot"]["metric"]]
    for side, drawn in (("base", scene.base), ("platform", scene.platform)):
        joints = [[Fraction(x) for x in joint] for joint in content["robot"][side]]
        for i, j in product(range(6), repeat=2):
            square = sum(w * (x - y) ** 2 for w, x, y in zip(g, joints[i], joints[j], strict=True))
            assert math.dist(drawn[i], drawn[j]) == pytest.approx(math.sqrt(square), rel=1e-14)


def test_octahedral_robots_have_equilateral_triangles() -> None:
    scene = scene_of(golden("robocrane-r"))
    for joints, side in ((scene.base, 4), (scene.platform, 2)):
        corners = sorted(set(joints))
        assert [math.dist(*pair) for pair in zip(corners, corners[1:] + corners[:1], strict=True)] == pytest.approx(
            [side] * 3, rel=1e-14
        )


@pytest.mark.parametrize("name", [*QUICK, *EXACT])
def test_signs_and_condition_numbers_are_those_of_the_legs(name: str) -> None:
    """Against the determinant of plain floating point, at poses that are well conditioned enough for it."""
    scene = scene_of(golden(name))
    centre = np.mean(scene.platform, axis=0)
    size = math.sqrt(np.mean([math.dist(joint, centre) ** 2 for joint in scene.platform]))
    for pose in scene.poses:
        if pose.multiplicity != 1:
            assert (pose.det_sign, pose.condition) == (0, None)
            continue
        rows = []
        for a, b in scene.legs:
            arm = np.subtract(pose.platform[b], pose.position)
            unit = np.subtract(pose.platform[b], scene.feet(pose)[a])
            unit = unit / np.linalg.norm(unit)
            turns = np.cross(arm, unit) / size
            rows.append([*unit[:2], turns[2]] if scene.motion.is_planar else [*unit, *turns])
        assert pose.condition == pytest.approx(np.linalg.cond(rows), rel=1e-4)
        assert pose.det_sign == np.sign(np.linalg.det(rows))


@pytest.mark.parametrize(("name", "chain"), CHAINS.items())
def test_models_add_their_chains(name: str, chain: str) -> None:
    robot, content = _model(name), golden(name)
    plain, scene = scene_of(content), scene_of(content, robot)
    axes = [math.sqrt(g) for g in robot.metric]
    assert (scene.sorts, plain.sorts, scene.kind) == ((chain,), (), robot.kind)
    assert plain.poses[0].knees == ()
    for drawn, joint in zip(scene.base, robot.base_joints, strict=True):
        assert drawn == pytest.approx([float(x) * axis for x, axis in zip(joint, axes, strict=True)], rel=1e-15)
    values = robot.configuration().joint_values
    for pose in scene.poses:
        assert pose.knees == plain.base
        for leg, knee in enumerate(pose.knees):
            offset = np.subtract(knee, scene.base[leg])
            if chain == "crank":
                arm = [float(x) * axis for x, axis in zip(robot.chains[leg].at_0, axes, strict=True)]
                assert np.linalg.norm(offset) == pytest.approx(np.linalg.norm(arm), rel=1e-12)
            else:
                way = [float(x * values[leg]) * axis for x, axis in zip(robot.chains[leg].direction, axes, strict=True)]
                assert offset == pytest.approx(way, abs=1e-12 * max(scene.lengths))
            rod = math.sqrt(robot.chains[leg].rod_squared)
            assert math.dist(knee, pose.platform[leg]) == pytest.approx(rod, rel=1e-12)


@pytest.mark.parametrize(("name", "other"), [("hexa", "hexaglide"), ("3-rrr", "3-prr"), ("mourrain-l", "dietmaier")])
def test_another_model_is_refused(name: str, other: str) -> None:
    with pytest.raises(InputError, match="is not one of the model"):
        scene_of(golden(name), _model(other))


def test_a_model_with_changed_lengths_fits_but_with_a_changed_crank_does_not() -> None:
    robot = _model("mourrain-l")
    freely = certificate(robot, None, solve(robot.problem([4, 4, 3, 4, 4, 5])))
    assert scene_of(freely, robot).configuration is None
    crank = _model("3-rrr")
    turned = replace(crank.chains[0], at_0=crank.chains[0].at_90, at_90=crank.chains[0].at_0)
    with pytest.raises(InputError, match="is not one of the model"):
        scene_of(golden("3-rrr"), replace(crank, chains=(turned, *crank.chains[1:])))


def test_a_solution_and_its_certificate_give_the_same_scene() -> None:
    robot = _model("3-rrr")
    solution = solve(robot.problem(robot.configuration()))
    scene = scene_of_solution(robot, "six", solution)
    assert scene == scene_of(golden("3-rrr"), robot)
    assert [(pose.det_sign, pose.condition) for pose in scene.poses] == [
        (pose.jacobian.det_sign, pytest.approx(float(pose.jacobian.condition.midpoint), rel=1e-6))
        for pose in solution.poses
        if pose.jacobian is not None and pose.jacobian.condition is not None
    ]


@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "mourrain-l"])
def test_the_method_does_not_matter(name: str) -> None:
    """Poses from the boxes of Krawczyk's operator and from the eliminant are the same points."""
    robot = _model(name)
    content = certificate(robot, "home", solve_krawczyk(robot.problem(robot.configuration())))
    assert content["representation"] is None
    found, wanted = scene_of(content), scene_of(golden(name))
    for one, two in zip(found.poses, wanted.poses, strict=True):
        assert one.position == pytest.approx(two.position, rel=1e-14, abs=1e-14)
        assert one.det_sign == two.det_sign
        assert one.condition == pytest.approx(two.condition, rel=1e-6)


def test_isolated_poses_beside_a_self_motion_are_placed() -> None:
    """A parallelogram turns on a circle; two more poses turn the platform over. The eliminant is not theirs."""
    corners = tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, 0), (0, 4)))
    robot = Robot("parallelogram", "3-RPR", "m", "made up", corners, corners)  # type: ignore[arg-type]
    scene = scene_of_solution(robot, None, solve(robot.problem((9, 9, 9))))
    assert (scene.claim, scene.configuration, len(scene.poses)) == ("positive-dimensional-proved", None, 2)
    for pose, leg in product(scene.poses, range(3)):
        assert math.dist(scene.base[leg], pose.platform[leg]) == pytest.approx(3, rel=1e-14)


def test_wide_boxes_do_not_move_the_picture() -> None:
    robot = _model("3-rrr")
    content = certificate(robot, "six", solve(robot.problem(robot.configuration()), width=Fraction(1)))
    coarse, fine = scene_of(content), scene_of(golden("3-rrr"))
    assert max(pose.position_half_width for pose in coarse.poses) > 0.1
    assert all(pose.position_half_width < 1e-9 for pose in fine.poses)
    boxes = [pose["position"] for pose in content["poses"]]
    for pose, box in zip(coarse.poses, boxes, strict=True):
        assert all(Fraction(lo) <= Fraction(x) <= Fraction(hi) for x, (lo, hi) in zip(pose.position, box, strict=True))
    by_place = {pose.position: pose for pose in _without_box_widths(fine).poses}
    assert {pose.position for pose in coarse.poses} == set(by_place)


# Files


def test_an_accepted_file_is_read() -> None:
    assert accepted_document(ROOT / "certs" / "mourrain-l.json") == golden("mourrain-l")


def _file(folder: Path, data: bytes) -> Path:
    path = folder / "certificate.json"
    path.write_bytes(data)
    return path


def test_a_moved_pose_is_refused_even_with_the_right_digest(tmp_path: Path) -> None:
    content = golden("mourrain-l")
    lo, hi = content["poses"][0]["position"][0]
    content["poses"][0]["position"][0] = [str(Fraction(lo) + 1), str(Fraction(hi) + 1)]
    path = _file(tmp_path, canonical_bytes(sealed(content)))
    with pytest.raises(RejectedError, match=r"certificate.json: the certificate is rejected \(boxes: .*not proved"):
        accepted_document(path)


def test_a_changed_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RejectedError, match="digest"):
        accepted_document(_file(tmp_path, canonical_bytes(golden("mourrain-l") | {"real_poses": 5})))


@pytest.mark.parametrize("data", [b"", b"{}\n", b"\xff\x00", b"[" * 10**5, json.dumps(golden("hexa")).encode()])
def test_what_is_no_certificate_is_refused(tmp_path: Path, data: bytes) -> None:
    with pytest.raises(InputError, match="the certificate is malformed") as caught:
        accepted_document(_file(tmp_path, data))
    assert not isinstance(caught.value, RejectedError)
    assert "\n" not in str(caught.value)


def test_too_large_a_file_is_refused_unread(tmp_path: Path) -> None:
    path = tmp_path / "huge.json"
    with path.open("wb") as stream:
        stream.truncate(1 << 33)
    with pytest.raises(InputError, match="too-large"):
        accepted_document(path)


@pytest.mark.parametrize("name", ["missing.json", ".", "a\0b"])
def test_a_file_that_cannot_be_read_is_named(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        accepted_document(tmp_path / name)


def test_certificates_of_tolerances_have_no_scene() -> None:
    with pytest.raises(InputError, match=r"tolerance certificate.*without --tolerance"):
        scene_of({"format": "pkm_exact tolerance certificate"})


def inconsistent() -> dict[str, Any]:
    """Two legs between the same joints, of different lengths."""
    content = golden("robocrane-r") | {"claim": "inconsistent", "representation": None, "poses": [], "elimination": []}
    content |= {"complex_solutions": 0, "distinct_solutions": 0, "real_poses": 0, "box_exponent": 0}
    for side in ("base", "platform"):
        content["robot"][side][1] = content["robot"][side][0]
    assert check_resealed(content).status is Status.ACCEPTED
    return sealed(content)


def test_a_robot_without_poses_has_a_scene() -> None:
    scene = scene_of(inconsistent())
    assert (scene.claim, scene.poses, len(scene.base)) == ("inconsistent", (), 6)


@pytest.mark.parametrize("scale", [10**120, Fraction(1, 10**120)])
def test_what_floats_cannot_hold_is_refused(scale: Fraction) -> None:
    content = inconsistent()
    for side in ("base", "platform"):
        content["robot"][side] = [[str(Fraction(x) * scale) for x in row] for row in content["robot"][side]]
    with pytest.raises(InputError, match="too large or too small"):
        scene_of(sealed(content))


# Bodies

points = st.lists(st.tuples(*[st.integers(-5, 5).map(float)] * 3), min_size=3, max_size=7)


@given(points)
def test_bodies_hold_all_joints(joints: list[tuple[float, float, float]]) -> None:
    found = faces(joints)
    distinct = set(joints)
    assert (found == ()) == (len(distinct) == 1)
    assert all(len(set(face)) == len(face) for face in found)
    if len(found) == 1 and len(found[0]) > 2:
        assert {joints[i] for face in found for i in face} == distinct
    if len(found) == 1 and len(found[0]) == 2:
        first, last = (np.array(joints[i]) for i in found[0])
        for joint in joints:
            assert np.linalg.norm(np.cross(np.array(joint) - first, last - first)) < 1e-9
            assert -1e-9 <= (np.array(joint) - first) @ (last - first) <= (last - first) @ (last - first) + 1e-9
    if len(found) > 1:
        _assert_convex(joints, found)


def _assert_convex(joints: list[tuple[float, float, float]], found: tuple[tuple[int, ...], ...]) -> None:
    """All joints on one side of each face; every edge belongs to two faces; Euler's formula."""
    for face in found:
        a, b, c = (np.array(joints[i]) for i in face[:3])
        heights = [np.cross(b - a, c - a) @ (np.array(joint) - a) for joint in joints]
        assert max(heights) <= 1e-6 or min(heights) >= -1e-6
    edges = [frozenset((face[k - 1], face[k])) for face in found for k in range(len(face))]
    assert {edges.count(edge) for edge in edges} == {2}
    corners = {i for face in found for i in face}
    assert len(corners) - len(set(edges)) + len(found) == 2

"""What a machine can do, drawn at the platform of a pose to a scale that is said."""

from pathlib import Path

import numpy as np
import pytest
from certificate_tools import golden
from samples import model

from pkm_exact.certify.statics_of_poses import at_certified_poses
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.pictures.capability_picture import Capability, capabilities, points_of
from pkm_exact.statics.at_pose import AtPose

pytest.importorskip("matplotlib")
from pkm_exact.pictures.scene import scene_of
from pkm_exact.pictures.views import pose_figure

Capture = pytest.CaptureFixture[str]


def machine(name: str, number: int) -> AtPose:
    return at_certified_poses(golden(name), model(name), [number - 1])[0]


def corners(found: Capability) -> np.ndarray:
    """All corners, in units of speed or force."""
    return np.vstack(found.faces) * found.value / found.length


@pytest.mark.parametrize(("name", "force"), [("rolland-6-6", 5), ("3-rpr-merlet-p", 5), ("delta", 2)])
def test_corners_are_at_the_limits_of_the_actuators(name: str, force: int) -> None:
    at = machine(name, 1)
    assert at.jacobian is not None
    rows = at.jacobian.to_numpy()
    translations = sum(place < 3 for place in at.motion.twist)
    length = 100 if name == "rolland-6-6" else 3
    limits = at.measures(speeds=2, forces=force, length=length)
    velocities, forces = capabilities(limits, at.ellipsoid(2, length), 1.0)
    speeds = np.abs(corners(velocities) @ rows[:, :translations].T)
    assert np.sum(np.isclose(speeds, 2), axis=1).min() >= translations
    assert speeds.max() < 2 + 1e-9
    # Forces of corners alone, without moment, are borne within limits and reach them.
    wrenches = np.zeros((len(corners(forces)), rows.shape[1]))
    wrenches[:, :translations] = corners(forces)
    drives = np.abs(np.linalg.solve(rows.T, wrenches.T))
    assert np.allclose(drives.max(axis=0), force)
    root = velocities.ellipsoid * velocities.value / velocities.length
    reach = np.linalg.norm(rows[:, :translations] @ root, axis=1)
    assert reach.max() <= 2 + 1e-9
    assert max(np.linalg.norm(corner) for corner in np.vstack(velocities.faces)) <= 0.35 + 1e-9


def test_they_stand_at_the_platform_to_the_scale_that_is_said() -> None:
    scene, at = scene_of(golden("3-rpr-merlet-p"), model("3-rpr-merlet-p")), machine("3-rpr-merlet-p", 2)
    found = capabilities(at.measures(speeds="1/5", length=3), at.ellipsoid("1/5", 3), scene.size)
    figure = pose_figure(scene, 2, capabilities=found)
    drawn = next(p for p in figure.axes[0].patches if p.get_gid() == "velocity-polytope").get_xy()[:-1]  # type: ignore[attr-defined]
    origin = np.array(scene.poses[1].position[:2])
    assert np.allclose(drawn - origin, corners(found[0]) * found[0].length / found[0].value)
    assert np.allclose(drawn, np.array(points_of(found, scene.poses[1]))[:, :2])
    words = f"{found[0].value:g} drawn as long as {found[0].length:g}"
    assert any(text.get_text().endswith(words) and "orange" in text.get_text() for text in figure.texts)


def test_the_command_draws_and_says_the_scale(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "able.svg"
    command = ["plot", "certs/rolland-6-6.json", "-o", str(file), "--pose", "3", "--limits", "speeds=1"]
    assert main([*command, "--limits", "length=100", "--limits", "forces=5"]) == 0
    line = capsys.readouterr().out
    assert "velocities without turning (blue, of the largest ellipsoid orange): 1 drawn as long as 100 mm" in line
    assert "forces without moment (green): 2 drawn as long as 100 mm" in line
    content = file.read_text()
    assert all(name in content for name in ("velocity-polytope", "wrench-polytope", "ellipsoid"))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["certs/rolland-6-6.json", "--limits", "speeds=1"], "--limits: is drawn at one pose, give --pose K as well"),
        (["certs/rolland-6-6.json", "--pose", "1", "--limits", "speed"], "is not KEY=VALUES"),
        (["certs/rolland-6-6.json", "--pose", "1", "--limits", "length=3"], "no limits are known; give"),
        (["certs/rolland-6-6.json", "--roots", "--limits", "speeds=1"], "--roots excludes"),
        (["certs/rolland-6-6.json", "--pose", "17", "--limits", "speeds=1"], "there is no pose 17"),
        (["certs/3-rps.json", "--pose", "1", "--limits", "speeds=1"], "give --model"),
        (["certs/links/watt.json", "--pose", "1", "--limits", "speeds=1"], "this one has passive bodies"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_is_refused(tmp_path: Path, capsys: Capture, options: list[str], message: str) -> None:
    file = tmp_path / "able.svg"
    assert main(["plot", *options, "-o", str(file)]) == 2
    assert message in " ".join(capsys.readouterr().err.split())
    assert not file.exists()


def test_a_platform_that_does_not_translate_freely_is_refused() -> None:
    with pytest.raises(InputError, match="translate freely in the plane or in space"):
        capabilities(machine("3-rps", 1).measures(speeds=1), None, 1.0)

"""Pictures of what a machine can do at a pose."""

from pathlib import Path

import numpy as np
import pytest
from certificate_tools import golden
from samples import model, solved
from test_statics import at

from pkm_exact.certify.statics_of_poses import at_certified_poses
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.statics.machine_at_pose import machine_at

pytest.importorskip("matplotlib")
from pkm_exact.pictures.statics_picture import statics_figure, statics_panels

Capture = pytest.CaptureFixture[str]
PLANAR = ["statics", "models/3-rpr-merlet-p.toml", "--position", "5,9/2", "--half-tangent", "1/3"]


def corners(panel: object) -> np.ndarray:
    """Vertices in ordinary coordinates."""
    polytope = panel.polytope  # type: ignore[attr-defined]
    scale = np.sqrt([float(s) for s in polytope.squares])
    return np.array([[float(x) for x in vertex] for vertex in polytope.vertices]) * scale


def test_sections_of_a_hexapod_are_what_its_jacobian_says() -> None:
    """Vertices reach the speeds; the forces of least norm that bear each corner are within limits, and reach them."""
    found = at("rolland-6-6")
    assert found.jacobian is not None
    rows = found.jacobian.to_numpy()
    velocities, forces = statics_panels(found.measures(speeds=2, forces=3, length=100), found.ellipsoid(2, 100))
    assert (velocities.names, forces.names) == (("vx", "vy", "vz"), ("fx", "fy", "fz"))
    assert velocities.title == "velocities without turning"
    speeds = np.abs(corners(velocities) @ rows[:, :3].T)
    assert np.sum(np.isclose(speeds, 2), axis=1).min() >= 3
    assert speeds.max() < 2 + 1e-12
    wrenches = np.hstack([corners(forces), np.zeros((len(forces.polytope.vertices), 3))])
    borne = np.abs(np.linalg.solve(rows.T, wrenches.T))
    assert np.sum(np.isclose(borne, 3), axis=0).min() >= 3
    assert borne.max() < 3 + 1e-9
    # The ellipsoid without turning is in the polytope, and is the section of the whole one.
    assert np.einsum("ij,jk,ik->i", rows[:, :3], velocities.ellipsoid, rows[:, :3]).max() <= 4 + 1e-9
    whole = np.linalg.inv(found.ellipsoid(2, 100).matrix.to_numpy())
    assert np.allclose(np.linalg.inv(velocities.ellipsoid), whole[:3, :3])


def test_the_ellipsoid_of_a_planar_machine_is_drawn_without_its_length() -> None:
    found = at("3-rpr-merlet-p")
    assert found.jacobian is not None
    rows = found.jacobian.to_numpy()
    shapes = [statics_panels(found.measures(speeds=1, length=k), found.ellipsoid(1, k))[0] for k in (1, 7)]
    assert shapes[0].names == ("vx", "vy", "wz")
    assert np.allclose(shapes[0].ellipsoid, shapes[1].ellipsoid)
    assert np.einsum("ij,jk,ik->i", rows, shapes[0].ellipsoid, rows) == pytest.approx(1)  # three sides: it touches all


def test_the_ellipsoid_where_constraints_are_not_actuated_is_in_the_free_components() -> None:
    """Of a 3-RPS robot: three sides, which it touches; whatever turns are multiplied by."""
    found = at_certified_poses(golden("3-rps"), model("3-rps"), [1])[0]
    for length in (1, 3):
        measures = found.measures(speeds=2, length=length)
        ellipsoid = found.ellipsoid(2, length)
        assert ellipsoid.matrix.rows == measures.freedom.components == ("vz", "wx", "wy")
        rows = np.array([[float(x.mid()) for x in row] for row in measures.freedom.free_jacobian.tolist()])
        (panel,) = statics_panels(measures, ellipsoid)
        assert panel.names == ("vz", "wx", "wy")
        assert np.einsum("ij,jk,ik->i", rows, panel.ellipsoid, rows) == pytest.approx(4)
        assert len(statics_figure(measures, ellipsoid).axes[0].collections) == 2  # faces, and the wire frame in them


def test_an_enclosed_pose_has_the_sections_too() -> None:
    found = machine_at(model("rolland-6-6"), solved("rolland-6-6").poses[0])
    rows = found.jacobian.to_numpy()  # type: ignore[union-attr]
    panels = statics_panels(found.measures(speeds=1, forces=1))
    assert [len(panel.names) for panel in panels] == [3, 3]
    assert np.abs(corners(panels[0]) @ rows[:, :3].T).max() == pytest.approx(1)
    assert len(statics_figure(found.measures(speeds=1, forces=1)).axes) == 2


def test_the_command_draws_every_format_and_the_same_bytes_again(tmp_path: Path, capsys: Capture) -> None:
    files = [tmp_path / name for name in ("a.svg", "b.svg", "c.png", "d.pdf")]
    words = ["--limits", "speeds=1/2", "--limits", "forces=3", "--limits", "length=2", "--plot"]
    for file in files:
        assert main([*PLANAR, *words, str(file)]) == 0
    assert "velocity polytope: 8 vertices" in capsys.readouterr().out
    first, second, third, fourth = (file.read_bytes() for file in files)
    assert first == second
    assert (first[:5], third[1:4], fourth[:4]) == (b"<?xml", b"PNG", b"%PDF")


def test_what_cannot_be_drawn_is_said_and_nothing_is_written(tmp_path: Path, capsys: Capture) -> None:
    target = tmp_path / "pose.svg"
    for words, sentence in (
        (["--plot", str(target)], "--plot: there is nothing to draw"),
        (["--limits", "length=2", "--plot", str(target)], "--plot: there is nothing to draw"),
        (["--limits", "speeds=1", "--plot", str(tmp_path / "pose.gif")], "no known format of pictures"),
        (["--limits", "speeds=1", "--plot", str(tmp_path / "no" / "pose.svg")], "--plot"),
    ):
        assert main([*PLANAR, *words]) == 2
        said = capsys.readouterr()
        assert sentence in said.err
        assert not said.out
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(InputError, match="no limits are known"):
        statics_figure(at("3-rpr-merlet-p").measures())

"""Velocities and forces at the poses, as the web page of a certificate shows them."""

import json
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certificate_tools import golden, golden_bytes, tolerant_certificate
from test_report_page import Page, require_sound

from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.check import check_bytes
from pkm_exact.certify.statics_of_poses import at_certified_poses
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.geometry.reader import read_robot
from pkm_exact.report_page.page import report_page
from pkm_exact.statics.enclosed_matrix import shown_number

ROOT = Path(__file__).parent.parent
LIMITS = {"speeds": [1], "forces": [5], "length": [2]}
Capture = pytest.CaptureFixture[str]


def text_of(content: dict[str, Any], model: Any = None, limits: Any = None) -> str:
    return report_page(content, check_bytes(canonical_bytes(content)).lines, "cert.json", model, limits)


def table_of(page: Page, columns: list[str], after: int = 0) -> list[list[str]]:
    """The rows of the table with these headings, the one after so many others."""
    heads = [k for k, row in enumerate(page.cells) if row[1:] == columns]
    start = heads[after] + 1
    width = len(columns) + 1
    rest = range(start, len(page.cells))
    end = next((k for k in rest if len(page.cells[k]) != width or not page.cells[k][0]), len(page.cells))
    return page.cells[start:end]


@pytest.fixture(scope="module")
def planar() -> tuple[str, Page]:
    text = text_of(golden("3-rpr-merlet-p"), limits=LIMITS)
    return text, Page(text)


def test_the_matrices_of_every_pose_are_those_of_its_box(planar: tuple[str, Page]) -> None:
    _, page = planar
    require_sound(page)
    for place, at in enumerate(at_certified_poses(golden("3-rpr-merlet-p"))):
        assert at.jacobian is not None
        for columns, matrix in ((["fx", "fy", "mz"], at.wrenches), (["vx", "vy", "wz"], at.jacobian)):
            shown = table_of(page, columns, place)[:3]
            assert [row[0] for row in shown] == ["leg 1", "leg 2", "leg 3"]
            assert [row[1:] for row in shown] == [list(map(shown_number, row)) for row in matrix.entries]
            error = np.abs(np.array([row[1:] for row in shown], dtype=float) - matrix.to_numpy()).max()
            assert error < 1e-7


def test_indices_and_polytopes_are_those_of_the_limits(planar: tuple[str, Page]) -> None:
    text, page = planar
    rows = {row[0]: row for row in table_of(page, ["value", "unit", "definition"])}
    at = at_certified_poses(golden("3-rpr-merlet-p"))[0]
    indices = at.indices(speeds=1, forces=5, length=2)
    assert rows.keys() == indices.keys()
    assert all(rows[name][1] == shown_number(value) for name, value in indices.items())
    polytope = at.velocity_polytope(1)
    assert f"velocity polytope in vx, vy, wz: 8 vertices, 6 facets, volume {shown_number(polytope.volume)}" in page.text
    assert "greatest norm" not in page.text, "norms of velocities and turns together mean nothing"
    assert "What is not shown, and why" in page.text
    assert "resolution_p: needs limits: resolutions" in page.text
    pictures = re.findall(r'<svg viewBox="0 0 240 240".*?</svg>', text, re.DOTALL)
    assert len(pictures) == 4  # velocities and wrenches of two poses
    assert [picture.count("<polygon") for picture in pictures] == [6] * 4
    assert [picture.count('class="ellipsoid"') for picture in pictures] == [1, 0, 1, 0]
    assert text == text_of(golden("3-rpr-merlet-p"), limits=LIMITS)


def test_the_corners_of_a_drawn_polytope_are_its_vertices() -> None:
    """In the plane of a machine that only shifts: corners times one scale are the vertices."""
    content = golden("v-shape")
    model = read_robot(ROOT / "models" / "v-shape.toml")
    text = text_of(content, model, {"speeds": [1]})
    picture = re.search(r'<polygon points="([^"]+)" class="face">', text)
    assert picture is not None
    drawn = np.array([[float(x) for x in pair.split(",")] for pair in picture[1].split()]) - 120
    vertices = np.array(
        [[float(x.mid()) for x in v] for v in at_certified_poses(content, model)[0].velocity_polytope(1).vertices]
    )
    wanted = vertices * [1, -1]
    wanted *= 96 / np.abs(wanted).max()
    assert len(drawn) == len(wanted) == 4
    assert max(np.abs(wanted - corner).sum(axis=1).min() for corner in drawn) < 0.2


def test_without_its_model_the_page_of_a_mechanism_says_that_there_is_no_jacobian() -> None:
    assert "There is no J: no constraint is known to be actuated." in Page(text_of(golden("3-rps"))).text
    with_model = Page(text_of(golden("3-rps"), read_robot(ROOT / "models" / "3-rps.toml"), {"speeds": [1]}))
    assert "There is no J" not in with_model.text
    assert "velocity polytope in vz, wx, wy: 8 vertices, 6 facets" in with_model.text


def test_multiple_poses_are_singular_with_a_rank_that_is_proved() -> None:
    text = Page(text_of(golden("3-rpr-triple"))).text
    assert "Pose 1: 3 constraints of rank 2, 3 freedoms; singular, type-2 (leg 1, leg 2, leg 3)" in text
    assert "Pose 2: 3 constraints of rank 3, 3 freedoms; not singular" in text


def test_what_is_refused_at_a_pose_stands_on_the_page() -> None:
    """A box too wide for half axes, slides that begin in one point, a double pose: no reason for no page."""
    for name, model in (("rcid", None), ("pmar-120", "pmar-120"), ("3-rpr-double-q", None)):
        machine = None if model is None else read_robot(ROOT / "models" / f"{model}.toml")
        page = Page(text_of(golden(name), machine, LIMITS))
        require_sound(page)
        assert "Velocities and forces at the poses" in page.text


def test_unknown_limits_are_refused_without_a_jacobian_too() -> None:
    with pytest.raises(InputError, match="'swiftness' is unknown"):
        text_of(golden("3-rps"), limits={"swiftness": [Fraction(1)]})


def test_limits_that_mean_nothing_are_refused(tmp_path: Path, capsys: Capture) -> None:
    certificate = tmp_path / "cert.json"
    certificate.write_bytes(golden_bytes("3-rpr-merlet-p"))
    output = tmp_path / "page.html"
    for word, said in (
        ("speeds", "is not KEY=VALUES"),
        ("swiftness=1", "'swiftness' is unknown"),
        ("speeds=1,2", "speeds"),
    ):
        assert main(["report", str(certificate), "-o", str(output), "--limits", word]) == 2
        assert said in capsys.readouterr().err
        assert not output.exists()
    content = tolerant_certificate("3-rpr-merlet-p", "1/1000000")
    with pytest.raises(InputError, match="limits: are for the poses"):
        text_of(json.loads(json.dumps(content)), limits={"length": [Fraction(1)]})

"""Names of poses: what their parts say, how long they last, and what is proved of those carried from a certificate."""

from __future__ import annotations

import csv
import io
import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from certificate_tools import golden, without_proof
from flint import arb
from samples import boxed, model, shipped, solved

from pkm_exact import Robot
from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.sealing import sealed
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL, TRANSLATION
from pkm_exact.numeric.carried_names import NamedPoses, carried_names
from pkm_exact.numeric.centred import centred_frames, centred_leg
from pkm_exact.numeric.problem_path import ProblemPath, blended
from pkm_exact.numeric_engine import solve_krawczyk
from pkm_exact.poses.pose_names import pose_names, pose_signature
from pkm_exact.roots.interval import Interval

ROOT = Path(__file__).parent.parent
PLANE, CERTIFICATE = "3-rpr-merlet-p", str(ROOT / "certs/3-rpr-merlet-p.json")
MODEL = str(ROOT / f"models/{PLANE}.toml")


def _exact(*numbers: float | str) -> list[Interval]:
    return [Interval(Fraction(n), Fraction(n)) for n in numbers]


UNIT = [_exact(*row) for row in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]


@pytest.mark.parametrize("name", ["rolland-6-6", "hexa", "dietmaier"])
def test_a_name_says_sign_and_axes(name: str) -> None:
    solution = boxed(name)
    names = pose_names(solution.poses, SPATIAL)
    assert len(set(names)) == len(names) > 0
    letters = np.array(["E", "W", "N", "S", "U", "D"])
    axes = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
    for found, pose in zip(names, solution.poses, strict=True):
        sign, position, turned = found.partition(".")[0].split("-")
        turn = np.array([[float(x) for x in row] for row in pose.rotation])
        vectors = np.array([[float(x) for x in pose.position], turn[:, 0], turn[:, 2]])
        assert sign == {1: "P", -1: "N"}[pose.det_sign or 0]
        for letter, vector in zip(position + turned, vectors, strict=True):
            assert letter in ("X", letters[np.argmax(axes @ vector)])


def test_what_a_box_does_not_decide_is_said() -> None:
    name = pose_signature(_exact(1, 1, 0), UNIT, None, SPATIAL)
    assert name == "X-X-EU"
    wide = [Interval(Fraction(-1), Fraction(3)), *_exact("1/2", 0)]
    assert pose_signature(wide, UNIT, 0, SPATIAL) == "0-X-EU"
    assert pose_signature(_exact(-2, 1, "-3/2"), UNIT, -1, SPATIAL) == "N-W-EU"
    assert pose_signature(_exact(0, -2, 0), UNIT, 1, PLANAR) == "P-S-E"
    assert pose_signature(_exact(0, -2, -3), UNIT, 1, TRANSLATION) == "P-D"


def test_a_name_stays_where_a_number_moves() -> None:
    robot, before = model("rolland-6-6"), solved("rolland-6-6")
    lengths = [Fraction(n) for n in (1260, 1250, 1245, 1270, 1250, 1255)]
    after = solve_krawczyk(robot.problem([length**2 for length in lengths]))
    first, second = (pose_names(found.poses, SPATIAL) for found in (before, after))
    assert set(first) == set(second)
    assert first.index("P-U-EU") != second.index("P-U-EU")


def _named(problem: ForwardProblem, *labels: str) -> NamedPoses:
    poses = solve_krawczyk(problem).poses
    return NamedPoses("before", problem, poses, labels or pose_names(poses, problem.motion))


def test_a_carried_name_stays_where_one_of_its_own_would_change() -> None:
    robot, before = model(PLANE), _named(shipped(PLANE))
    there = solve_krawczyk(robot.problem([Fraction(n) ** 2 for n in ("7.1", "5.3", "5")]))
    found = carried_names(before, there)
    assert before.names == found.names == ("N-N-S", "P-X-E")
    assert pose_names(there.poses, PLANAR) == ("N-N-S", "P-E-E")
    assert found.carried == 2
    assert found.lost == ()
    assert len(found.notes) == 1


def test_joints_may_differ_a_little() -> None:
    before = _named(shipped("rolland-6-6"), *(f"mode {k}" for k in range(16)))
    off = [Fraction(k % 5 - 2, 10) for k in range(36)]
    legs = tuple(
        Distance(
            tuple(x + e for x, e in zip(leg.base, off[k : k + 3], strict=True)),  # type: ignore[arg-type]
            tuple(x - e for x, e in zip(leg.platform, off[k + 2 : k + 5], strict=True)),  # type: ignore[arg-type]
            leg.length_squared + 50 * off[k],
        )
        for k, leg in enumerate(before.problem.distances)
    )
    after = solve_krawczyk(ForwardProblem(legs))
    found = carried_names(before, after)
    assert not found.lost
    for name, pose in zip(found.names, after.poses, strict=True):
        start = before.poses[before.names.index(name)]
        assert np.allclose([float(x) for x in pose.position], [float(x) for x in start.position], atol=10)
        assert start.det_sign == pose.det_sign


def test_a_branch_that_ends_carries_no_name() -> None:
    robot, before = model(PLANE), _named(shipped("3-rpr-six"))
    far = ForwardProblem(
        tuple(
            replace(leg, length_squared=leg.length_squared * scale)
            for leg, scale in zip(before.problem.distances, (1, 2, 1), strict=True)
        ),
        robot.metric,
        PLANAR,
    )
    after = solve_krawczyk(far)
    found = carried_names(before, after)
    kept = [name for name in found.names if not name.startswith("new-")]
    assert set(kept) | {name for name, _ in found.lost} == set(before.names)
    assert len(found.lost) >= len(before.names) - len(after.poses) > 0
    assert "neither found nor excluded" in found.notes[1]
    for name in kept:
        assert before.poses[before.names.index(name)].det_sign == after.poses[found.names.index(name)].det_sign


def test_a_singular_pose_carries_no_name() -> None:
    before = _named(shipped("3-rpr-double-q"))
    after = solve_krawczyk(before.problem)
    found = carried_names(before, after)
    assert [name[0] for name, _ in found.lost] == ["0"] * sum(pose.det_sign == 0 for pose in before.poses)
    assert any(name.startswith("new-0") for name in found.names)


def test_an_incomplete_list_gets_no_names() -> None:
    before = _named(shipped(PLANE))
    after = replace(solved(PLANE), claim=solved("3-rpr-triple").claim.NOT_PROVEN_COMPLETE)
    with pytest.raises(InputError, match="not proved to be complete"):
        carried_names(before, after)


def test_the_equations_of_a_path_are_those_of_the_robots_on_it() -> None:
    first = shipped("rolland-6-6")
    moved = tuple(
        Distance(leg.platform, leg.base, leg.length_squared * (k + 1)) for k, leg in enumerate(first.distances)
    )
    path, frames = ProblemPath((first, ForwardProblem(moved))), centred_frames(first)
    zeroth, linear, square = path.forms(frames, 0).coefficients
    for share in (Fraction(1, 3), Fraction(7, 8)):
        s = arb(share.numerator) / share.denominator
        rows = (zeroth + s * linear + s * s * square).tolist()[1:]
        for row, leg in zip(rows, blended(first, path.problem(1), share).distances, strict=True):
            for found, expected in zip(row, centred_leg(leg, frames, (1, 1, 1)), strict=True):
                assert found.overlaps(expected)
                assert abs(found - expected) < arb(2) ** -30


def test_robots_of_other_makes_are_refused() -> None:
    plane, space, mixed = shipped(PLANE), shipped("rolland-6-6"), shipped("3-prs")
    with pytest.raises(InputError, match="motions, the metric or the number"):
        ProblemPath((plane, space)).require()
    renamed = tuple(replace(leg, name="a") for leg in space.distances)
    with pytest.raises(InputError, match="types or names"):
        ProblemPath((space, replace(space, constraints=renamed))).require()

    def with_planes(**changes: Any) -> ForwardProblem:
        return replace(
            mixed,
            constraints=tuple(replace(c, **changes) if isinstance(c, InPlane) else c for c in mixed.constraints),
        )

    ProblemPath((mixed, with_planes(offset=Fraction(7)))).require()
    with pytest.raises(InputError, match="differs in more than its value"):
        ProblemPath((mixed, with_planes(offset=Fraction(7), platform=(Fraction(1),) * 3))).require()


SOLVE = ["solve", MODEL, "--lengths", "7.1,5.3,5", "--names-from", CERTIFICATE]


def test_the_command_shows_carried_names(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(SOLVE) == 0
    table = capsys.readouterr().out
    assert "note: names from 3-rpr-merlet-p.json: 2 of 2 poses followed" in table
    assert table.splitlines()[-1].split()[-1] == "P-X-E"
    assert main([*SOLVE, "--format", "json"]) == 0
    assert [pose["name"] for pose in json.loads(capsys.readouterr().out)["poses"]] == ["N-N-S", "P-X-E"]
    for layout in ("csv", "csv_exact"):
        assert main([*SOLVE, "--format", layout]) == 0
        rows = csv.DictReader(io.StringIO(capsys.readouterr().out))
        assert [row["name"] for row in rows] == ["N-N-S", "P-X-E"]
    assert main([*SOLVE[:4], "--format", "csv"]) == 0
    assert ",P-E-E," in capsys.readouterr().out


def test_the_command_names_what_it_refuses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def refusal(*words: str) -> str:
        assert main(["solve", *words]) == 2
        return capsys.readouterr().err

    assert "of this robot" in refusal(str(ROOT / "models/3-rrr.toml"), "--names-from", str(ROOT / "certs/delta.json"))
    forged = json.loads(Path(CERTIFICATE).read_bytes())
    forged["real_poses"] = 1
    (tmp_path / "forged.json").write_text(json.dumps(forged))
    assert "not proved" in refusal(MODEL, "--names-from", str(tmp_path / "forged.json"))
    (tmp_path / "weak.json").write_bytes(canonical_bytes(sealed(without_proof(golden(PLANE)))))
    assert "certificate of all poses" in refusal(MODEL, "--names-from", str(tmp_path / "weak.json"))
    assert "--names-from: is for certified poses" in refusal(MODEL, "--method", "newton", "--names-from", CERTIFICATE)


def test_a_path_begins_at_a_named_pose(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, out = tmp_path / "path.csv", tmp_path / "out.json"
    path.write_text("7.05,5.1,5.1\n7.1,5,5\n")
    assert main(["track", MODEL, str(path), "--start", "P-W-E", "-o", str(out)]) == 2
    known = capsys.readouterr().err.rpartition("give one of ")[2].split(", ")
    assert main(["track", MODEL, str(path), "--start", known[0], "-o", str(out)]) == 0
    assert json.loads(out.read_bytes())["start_pose"] == 1


def test_the_page_of_a_certificate_has_the_names(tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert main(["report", CERTIFICATE, "-o", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    for name in pose_names(Robot.load(MODEL).solve().poses, PLANAR):
        assert f'["name","{name}"]' in text.replace(", ", ",")

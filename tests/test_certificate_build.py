"""Certificates are written in one spelling, whole or not at all, and fit the schema."""

import os
from dataclasses import replace
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from typing import Any

import pytest
from certificate_subjects import FIRST_VERSION
from certificate_tools import NAMES, golden, golden_bytes
from test_certificate_schema import schema_of

from pkm_exact import certificate, check_bytes, read_robot, solve, write_certificate
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.formulations.registry import formulation_codes

MODELS = Path(__file__).parent.parent / "models"


@pytest.fixture(scope="module")
def small() -> Any:
    """A robot that is solved quickly, and its solution."""
    robot = read_robot(MODELS / "robocrane-r.toml")
    return robot, solve(robot.problem(robot.configuration().lengths_squared), policy=FIRST_VERSION)


def test_a_certificate_says_what_was_found(small: Any) -> None:
    robot, solution = small
    content = certificate(robot, "home", solution)
    assert content["format"] == "pkm_exact certificate"
    assert content["version"] == 1
    assert content["robot"]["metric"] == ["1", "3", "1"]
    assert content["robot"]["base"][0] == ["-2", "-2/3", "-3"]
    assert content["configuration"]["name"] == "home"
    assert [Fraction(x) for x in content["configuration"]["lengths_squared"]] == [
        leg.length_squared for leg in solution.problem.distances
    ]
    assert content["claim"] == "complete"
    assert content["completeness_route"] == "exact-elimination"
    assert (content["distinct_solutions"], content["real_poses"], len(content["poses"])) == (16, 4, 4)
    assert [int(c, 16) for c in content["representation"]["eliminant"]] == list(solution.representation.eliminant)
    first, pose = content["poses"][0], solution.poses[0]
    assert [[Fraction(end) for end in interval] for interval in first["position"]] == [
        [interval.lo, interval.hi] for interval in pose.position
    ]


def test_the_same_input_gives_the_same_bytes(small: Any) -> None:
    robot, solution = small
    again = solve(robot.problem(robot.configuration().lengths_squared), policy=FIRST_VERSION)
    assert canonical_bytes(certificate(robot, "home", solution)) == canonical_bytes(certificate(robot, "home", again))


def test_lengths_given_freely_have_no_name(small: Any) -> None:
    robot, solution = small
    content = certificate(robot, None, solution)
    assert content["configuration"]["name"] is None
    assert check_bytes(canonical_bytes(content)).status == "accepted"


@pytest.mark.parametrize("code", formulation_codes())
def test_every_formulation_may_have_made_it(small: Any, code: str) -> None:
    robot, solution = small
    content = certificate(robot, "home", replace(solution, formulation=code))
    schema_of(content).validate(content)
    assert check_bytes(canonical_bytes(content)).status == "accepted"


def test_a_solution_of_another_robot_is_refused(small: Any) -> None:
    _, solution = small
    with pytest.raises(ValueError, match="joints or metric differ"):
        certificate(read_robot(MODELS / "dietmaier.toml"), None, solution)


def test_products_of_an_elimination_name_their_factors(small: Any) -> None:
    robot, solution = small
    content = certificate(robot, None, solution)
    (index, exponents), *_ = solution.completeness.elimination[0]
    first, *factors = map(int, content["elimination"][0][0].split())
    assert first == index
    assert [factors.count(unknown) for unknown in range(len(exponents))] == list(exponents)


def test_the_digest_is_that_of_everything_else() -> None:
    content = golden("mourrain-l")
    digest = content.pop("digest")
    assert digest == "sha256:" + sha256(canonical_bytes(content)).hexdigest()
    assert sealed({**content, "digest": "stale"})["digest"] == digest


@pytest.mark.parametrize("name", NAMES)
def test_golden_certificates_are_spelled_canonically(name: str) -> None:
    assert canonical_bytes(golden(name)) == golden_bytes(name)


def test_binary_floats_cannot_be_written() -> None:
    with pytest.raises(ValueError, match="JSON compliant"):
        canonical_bytes({"x": float("nan")})


def test_a_file_appears_whole(tmp_path: Path) -> None:
    target = tmp_path / "robot.json"
    target.write_text("what was there before")
    write_certificate(target, {"a": 1})
    assert target.read_bytes() == b'{\n "a": 1\n}\n'
    assert os.listdir(tmp_path) == ["robot.json"]  # noqa: PTH208


def test_a_failure_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "robot.json"
    target.write_text("what was there before")

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_certificate(target, {"a": 1})
    assert target.read_text() == "what was there before"
    assert [path.name for path in tmp_path.iterdir()] == ["robot.json"]


def test_only_regular_files_are_replaced(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="not a regular file"):
        write_certificate(tmp_path, {"a": 1})


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    target, link = tmp_path / "target.json", tmp_path / "link.json"
    target.write_text("old")
    link.symlink_to(target)
    write_certificate(link, {"a": 1})
    assert link.is_symlink()
    assert target.read_bytes() == b'{\n "a": 1\n}\n'

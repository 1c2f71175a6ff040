"""What is said of a claim is what is proved: the sentences of every output, against the definitions in the docs."""

from __future__ import annotations

import ast
import json
import re
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from certificate_subjects import SUBJECTS, subject
from certificate_tools import both
from samples import placed

from pkm_exact import Mechanism, claim_wording, read_robot
from pkm_exact.certify.build import canonical_bytes, certificate, sealed
from pkm_exact.claim import Claim, RealMotion
from pkm_exact.claim_wording import CONSTRAINTS, LEGS, REAL_MOTION, Subject, meaning
from pkm_exact.cli.main import main
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.engine import solve
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.robot import Robot
from pkm_exact.interactive.display import headline, solution_html
from pkm_exact.numeric.real_motion import real_motion
from pkm_exact.pictures.captions import statement
from pkm_exact.policy import Policy
from pkm_exact.poses.coaxial_motion import screws
from pkm_exact.poses.real_pose import are_out_of_reach, has_real_point
from pkm_exact.poses.self_motion import SelfMotion
from pkm_exact.report_page.words import meaning_of
from pkm_exact.solution import Solution

ROOT = Path(__file__).parent.parent
CASES = Path(__file__).parent / "cases"
GUARANTEES = " ".join((ROOT / "docs" / "guarantees.md").read_text(encoding="utf-8").split())
MOVING = re.compile(r"\b(?:robot|mechanism|\{robot\}|platform|it) (?:moves?|turns?|can move|can turn|screws?)\b")
"""Words by which a robot is said to move."""

UNREAL = CASES / "posdim_noreal.toml"
CIRCLE = tuple(
    (Fraction(x, r), Fraction(y, r), Fraction(0))
    for x, y, r in ((3, 4, 5), (5, 0, 5), (-3, 4, 5), (-5, 0, 5), (5, -12, 13), (-4, -3, 5))
)


def section(claim: Claim) -> str:
    start = GUARANTEES.index(f"### `{claim}`")
    return GUARANTEES[start : GUARANTEES.index("### `", start + 4)]


@pytest.mark.parametrize("of", [LEGS, CONSTRAINTS], ids=lambda of: of.robot)
@pytest.mark.parametrize("claim", Claim)
def test_the_docs_define_each_claim_in_these_words(claim: Claim, of: Subject) -> None:
    motions = RealMotion if claim is Claim.POSITIVE_DIMENSIONAL_PROVED else (None,)
    for motion in motions:
        sentence = meaning(claim, motion, of)
        _, _, last = sentence.rpartition(": ") if of is CONSTRAINTS else ("", "", sentence)
        assert last in section(claim)
        if motion is not None and of is LEGS:
            assert re.search(rf"\| `{motion}` \| {re.escape(sentence)}(?: \([^|]*\))? \|", section(claim))


def test_what_has_no_legs_is_not_said_to_have_any() -> None:
    """Of a robot with legs and of a mechanism, each in its own words, and no place of a sentence left open."""
    texts = (claim_wording.OF_CERTIFICATE_MEANING, claim_wording.OF_EVIDENCE, claim_wording.INCONSISTENT_NOTE)
    for text in (*texts, *REAL_MOTION.values()):
        assert "leg" not in CONSTRAINTS.says(text)
        assert "{" not in LEGS.says(text) + CONSTRAINTS.says(text)
    for claim in Claim:
        for motion in RealMotion:
            assert "leg" not in meaning(claim, motion, CONSTRAINTS)
            assert "{" not in meaning(claim, motion) + meaning(claim, motion, CONSTRAINTS)


def test_a_mechanism_that_moves_is_called_one() -> None:
    """Three planes through one line: the platform turns about it, and slides."""
    zero, one = Fraction(0), Fraction(1)
    planes = tuple(InPlane((one, Fraction(k), zero), zero, (zero, zero, Fraction(k)), f"plane {k}") for k in range(3))
    mechanism = Mechanism("planes", "m", "made up", planes)
    solution = mechanism.solve()
    assert (solution.claim, solution.real_motion) == (Claim.POSITIVE_DIMENSIONAL_PROVED, RealMotion.PROVED)
    said = " ".join((headline(solution), *solution.notes, meaning_of(certificate(mechanism, "home", solution)).meaning))
    assert "the mechanism moves with locked actuators" in said
    assert "along which the mechanism moves with its actuators locked" in said
    assert "robot" not in said
    assert "legs" not in said


def test_only_a_proved_motion_is_said_to_be_one() -> None:
    said = {motion for motion in RealMotion if MOVING.search(meaning(Claim.POSITIVE_DIMENSIONAL_PROVED, motion))}
    assert said == {RealMotion.PROVED}
    doubted = meaning(Claim.POSITIVE_DIMENSIONAL_DETECTED, RealMotion.OPEN)
    assert "not proved" in doubted
    assert doubted.endswith("whether the robot can move with locked legs is not known")
    assert LEGS.says(REAL_MOTION[RealMotion.OPEN]).endswith("that the robot moves, is neither proved nor excluded")
    assert not MOVING.search(REAL_MOTION[RealMotion.NO_REAL_POSE])


def test_no_other_module_says_that_a_robot_moves() -> None:
    """Sentences in the program, docstrings apart: all of them are in one module, the checkers' are in the docs."""
    found = {}
    for path in (ROOT / "pkm_exact").rglob("*.py"):
        source = path.read_text(encoding="utf-8")
        # Words of one string may stand on two lines, and only there.
        if not MOVING.search(re.sub(r'"?\s*\n\s*f?"?', "", source)) and not MOVING.search(source):
            continue
        tree = ast.parse(source)
        docs = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
        texts = (n.value for n in ast.walk(tree) if isinstance(n, ast.Constant) and id(n) not in docs)
        if any(isinstance(text, str) and MOVING.search(text) for text in texts):
            found[path.relative_to(ROOT / "pkm_exact").as_posix()] = path
    checkers = {name for name in found if name.startswith(("certify/checker/", "certify/pure"))}
    assert set(found) - checkers == {"claim_wording.py"}
    assert checkers


# Real motions: proved, excluded, open


SIMILAR = Robot("similar", "6-UPS", "m", "made up", CIRCLE, tuple((x / 2, -y / 2, z) for x, y, z in CIRCLE))
"""A circle of joints, and a half as large one: leg forms of rank 5. Equal legs reach from one to the other from 1/2."""
ROBOTS = {
    RealMotion.PROVED: (SIMILAR, Fraction(1)),
    RealMotion.OPEN: (SIMILAR, Fraction(1, 4)),
    RealMotion.NO_REAL_POSE: (read_robot(UNREAL), None),
}


@cache
def solved(motion: RealMotion) -> tuple[Robot, Solution]:
    robot, square = ROBOTS[motion]
    locked = robot.configuration() if square is None else [square] * 6
    return robot, solve(robot.problem(locked))


@pytest.mark.parametrize("motion", RealMotion)
def test_every_output_says_what_is_proved(motion: RealMotion, tmp_path: Path) -> None:
    robot, solution = solved(motion)
    assert (solution.claim, solution.real_motion) == (Claim.POSITIVE_DIMENSIONAL_PROVED, motion)
    sentence = meaning(solution.claim, motion)
    assert headline(solution) == sentence
    assert sentence in solution_html(solution, robot, None)
    assert LEGS.says(REAL_MOTION[motion]) in solution.notes[0]
    document = certificate(robot, None, solution)
    page = meaning_of(document)
    assert (page.headline, page.meaning) == (
        claim_wording.OF_CERTIFICATE,
        LEGS.says(claim_wording.OF_CERTIFICATE_MEANING),
    )
    scene = SimpleNamespace(poses=(), claim=document["claim"], complex_solutions=0)
    assert not MOVING.search(statement(cast("Any", scene)))
    if motion is not RealMotion.PROVED:
        said = " ".join((headline(solution), *solution.notes))
        assert not MOVING.search(said.replace(LEGS.says(REAL_MOTION[RealMotion.OPEN]), ""))


def test_a_robot_without_a_real_pose_is_not_said_to_move(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", str(UNREAL)]) == 3
    assert main(["solve", str(UNREAL), "--format", "json"]) == 3
    table, _, entry = capsys.readouterr().out.partition("{")
    assert not MOVING.search(table)
    assert "that none of them is real is proved" in table
    content = json.loads("{" + entry)
    assert (content["real_motion"], content["real_poses"], content["poses"]) == ("no-real-pose", 0, [])
    assert main(["compare", str(UNREAL)]) == 3
    out, err = capsys.readouterr()
    assert err == ""
    assert not MOVING.search(out)


@pytest.mark.parametrize("square", [7, 8, 9])
def test_a_point_is_reached_iff_its_distances_meet(square: int) -> None:
    """A platform on a base joint in one point: sqrt(8) is the distance of the triangle's centre."""
    triangle = [(Fraction(x), Fraction(y), Fraction(0)) for x, y in ((0, 0), (4, 0), (0, 4))]
    assert has_real_point(triangle, [Fraction(square)] * 3, (1, 1, 1)) is (square >= 8)
    spread = [*triangle, (Fraction(0), Fraction(0), Fraction(4))]
    assert has_real_point(spread, [Fraction(12)] * 4, (1, 1, 1))


def test_legs_that_cannot_close_are_out_of_reach() -> None:
    corners = [(Fraction(x), Fraction(y), Fraction(0)) for x, y in ((0, 0), (10, 0), (0, 10))]
    points = [(Fraction(x), Fraction(0), Fraction(0)) for x in (0, 1, 0)]
    legs = [Distance(a, b, Fraction(20)) for a, b in zip(corners, points, strict=True)]
    assert are_out_of_reach(ForwardProblem(tuple(legs)))
    longer = [Distance(leg.base, leg.platform, Fraction(64)) for leg in legs]
    assert not are_out_of_reach(ForwardProblem(tuple(longer)))


def test_a_regular_real_pose_proves_a_motion() -> None:
    """A similar robot in a general pose: its curve is regular there, and no symmetry is used."""
    position, quaternion = (Fraction(1), Fraction(0), Fraction(3)), [Fraction(n) for n in (3, 1, 0, 1)]
    robot = placed(CIRCLE, SIMILAR.platform_joints, position, quaternion)
    assert not screws(robot.problem)
    solution = solve(robot.problem)
    assert solution.real_motion is RealMotion.PROVED
    assert isinstance(solution.self_motion, SelfMotion)
    assert real_motion(robot.problem, solution.self_motion, Policy(seed=5)) is RealMotion.PROVED


# The checkers' lines

SPECIFIED = [
    (claim, re.compile(re.sub(r"\\{[^}]*\\}", r"(\\d+|sphere|circle)", re.escape(line))))
    for claim, line in re.findall(
        r"^\| ([a-z-]+) \| `([^`]*)` \|$", (ROOT / "docs" / "certificates.md").read_text(encoding="utf-8"), re.MULTILINE
    )
    if claim in set(Claim)
]


@pytest.mark.parametrize("name", [n for n, s in SUBJECTS.items() if s.quick >= 30 and not n.startswith("tolerance")])
def test_the_last_line_of_a_check_is_one_of_those_specified(name: str) -> None:
    content = subject(name)
    verdict = both(canonical_bytes(sealed(content)))
    assert verdict.status == "accepted"
    assert any(claim == content["claim"] and line.fullmatch(verdict.lines[-1]) for claim, line in SPECIFIED), (
        verdict.lines[-1]
    )


def test_the_specification_says_which_lines_prove_a_motion() -> None:
    lines = [line.pattern for claim, line in SPECIFIED if claim == Claim.POSITIVE_DIMENSIONAL_PROVED]
    assert len(lines) == 3
    for line in lines:
        assert line.endswith(("is\\ not\\ proved", "the\\ robot\\ moves\\ with\\ its\\ legs\\ locked"))

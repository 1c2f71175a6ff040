"""Certificates of the method krawczyk: accepted as they are, rejected whatever is changed."""

import json
from copy import deepcopy
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from certificate_tools import boxed_certificate, check_resealed, golden, last_line
from flint import arb, ctx

from pkm_exact import Robot, certificate, solve
from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.check import Status
from pkm_exact.certify.checker.krawczyk import Box, Equations, _place, narrowed
from pkm_exact.constraints.distance import Distance

MODELS = Path(__file__).parent.parent / "models"
SCHEMA = Path(__file__).parent.parent / "pkm_exact" / "certify" / "certificate-1.schema.json"


def _rejected(content: dict[str, Any], reason: str) -> None:
    verdict = check_resealed(content)
    assert (verdict.status, last_line(verdict).split(":")[0]) == (Status.REJECTED, reason), verdict


@pytest.mark.parametrize("name", ["mourrain-l", "rolland-6-6", "3-rrr", "3-rpr-merlet-p", "hexa"])
def test_it_is_accepted_small_and_fits_the_schema(name: str) -> None:
    content = boxed_certificate(name)
    verdict = check_resealed(content)
    assert verdict.status is Status.ACCEPTED, verdict
    assert (content["method"], content["claim"]) == ("krawczyk", "complete")
    assert any(line.startswith("complete: ") for line in verdict.lines)
    assert len(canonical_bytes(content)) < 64_000
    jsonschema.validate(content, json.loads(SCHEMA.read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", ["mourrain-l", "rolland-6-6", "3-rrr"])
def test_poses_are_those_of_the_exact_engine(name: str) -> None:
    exact = golden(name)
    numeric = boxed_certificate(name)
    for one, other in zip(exact["poses"], numeric["poses"], strict=True):
        assert one["position"] == other["position"]
        assert one["rotation"] == other["rotation"]


def test_a_pose_dropped_with_its_box_and_its_counts_leaves_the_list_incomplete() -> None:
    content = boxed_certificate("mourrain-l")
    content["krawczyk"]["real"].pop()
    content["poses"].pop()
    content |= {"real_poses": 3, "complex_solutions": 39, "distinct_solutions": 39}
    _rejected(content, "claim")
    content |= {"claim": "not-proven-complete", "completeness_route": None}
    assert check_resealed(content).status is Status.ACCEPTED


def test_a_solution_is_not_counted_twice() -> None:
    content = boxed_certificate("mourrain-l")
    content["krawczyk"]["complex"][1] = content["krawczyk"]["complex"][0]
    _rejected(content, "boxes")


def test_a_conjugate_box_is_the_same_solution_again() -> None:
    content = boxed_certificate("mourrain-l")
    box = deepcopy(content["krawczyk"]["complex"][0])
    box["centre"] = [[real, hex(-int(imaginary, 16))] for real, imaginary in box["centre"]]
    content["krawczyk"]["complex"][1] = box
    _rejected(content, "boxes")


def test_a_real_solution_is_not_listed_as_complex() -> None:
    content = boxed_certificate("mourrain-l")
    box = content["krawczyk"]["real"].pop()
    box["centre"] = [[value, "0x0"] for value in box["centre"]]
    content["krawczyk"]["complex"].append(box)
    content["poses"].pop()
    content |= {"real_poses": 3, "complex_solutions": 41, "distinct_solutions": 41}
    _rejected(content, "boxes")


def test_a_moved_box_is_rejected() -> None:
    content = boxed_certificate("mourrain-l")
    centre = content["krawczyk"]["real"][0]["centre"]
    for units in (1, 3, 8, -1):
        changed = deepcopy(content)
        changed["krawczyk"]["real"][0]["centre"][1] = hex(int(centre[1], 16) + units)
        _rejected(changed, "boxes")


def test_boxes_of_another_robot_are_rejected() -> None:
    content, other = boxed_certificate("mourrain-l"), boxed_certificate("linapod-n")
    content["krawczyk"] = other["krawczyk"]
    _rejected(content, "boxes")


def test_boxes_are_in_the_order_of_the_poses() -> None:
    content = boxed_certificate("mourrain-l")
    real = content["krawczyk"]["real"]
    real[0], real[1] = real[1], real[0]
    _rejected(content, "real poses")


def test_the_exact_method_lists_no_boxes_beside_a_complete_list() -> None:
    content = boxed_certificate("mourrain-l")
    content["method"] = "exact"
    _rejected(content, "method")


def test_isolated_poses_beside_a_self_motion_are_listed_and_checked() -> None:
    """A parallelogram turns on a circle; two more poses turn the platform over."""
    corners = tuple((Fraction(x), Fraction(y)) for x, y in ((0, 0), (4, 0), (0, 4)))
    robot = Robot("parallelogram", "3-RPR", "m", "made up", corners, corners)  # type: ignore[arg-type]
    solution = solve(robot.problem((9, 9, 9)))
    assert (str(solution.claim), len(solution.poses)) == ("positive-dimensional-proved", 2)
    content = certificate(robot, None, solution)
    assert check_resealed(content).status is Status.ACCEPTED
    _rejected(content | {"claim": "complete", "completeness_route": "refined-bezout"}, "real poses")
    _rejected({**content, "poses": [], "real_poses": 0}, "real poses")
    _rejected({**content, "krawczyk": None}, "claim")


def test_the_image_contains_the_solution_and_shrinks() -> None:
    """The only zero of the equations near a box lies in the Krawczyk image of any box around it."""
    content = boxed_certificate("mourrain-l")
    robot, lengths = content["robot"], content["configuration"]["lengths_squared"]
    legs = [
        Distance(tuple(map(Fraction, a)), tuple(map(Fraction, b)), Fraction(s))  # type: ignore[arg-type]
        for a, b, s in zip(robot["base"], robot["platform"], lengths, strict=True)
    ]
    equations = Equations(legs, (1, 1, 1), content["krawczyk"]["chart"])
    entry = content["krawczyk"]["real"][0]
    box = Box(tuple(entry["exponents"]), tuple((int(value, 16), 0) for value in entry["centre"]), True)  # type: ignore[arg-type]
    assert box.is_disjoint(Box(box.exponents, ((box.centre[0][0] + 9, 0), *box.centre[1:]), True))
    assert not box.is_disjoint(Box(box.exponents, ((box.centre[0][0] + 8, 0), *box.centre[1:]), True))
    with ctx.workprec(256):
        centre, spread = _place(equations, box)
        image = equations.image(centre, spread)
        assert image is not None
        fine = narrowed(equations, box, 100)
        for place, value in enumerate((centre + image).entries()):
            assert value.real.overlaps(fine[equations.kept[place]])
            assert value.real.rad() < spread[place, 0].real.rad()
            assert fine[equations.kept[place]].rad() < arb(2) ** -90 * (1 + abs(fine[equations.kept[place]]))

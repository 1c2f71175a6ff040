"""Certificates that a matrix is regular: written, checked by both checkers, and forged."""

from __future__ import annotations

from copy import deepcopy
from functools import cache
from typing import Any

import pytest
from region_certificates import verdicts
from test_regular_matrices import SMALL, TURNED, WIDE, question_of

from pkm_exact.certify.region_build import region_certificate
from pkm_exact.regions import region_solver
from pkm_exact.regions.paving import spliced

ASKED = SMALL | {"a general hexapod": ("rolland-6-6", TURNED, ""), "a singular box": ("rolland-6-6", WIDE, "")}
INSIDE = "is not proved to be inside"


@cache
def _content(name: str) -> dict[str, Any]:
    kind = "map" if name == "cranks" else "all"
    before = region_solver.MOST_OF_DETERMINANT
    region_solver.MOST_OF_DETERMINANT = -1
    try:
        answer = region_solver.answered(*question_of(*ASKED[name], more=f"kind = '{kind}'\nsteps = 9"))
    finally:
        region_solver.MOST_OF_DETERMINANT = before
    found = region_certificate(answer)
    del found["digest"]
    return found


@pytest.mark.parametrize("name", ASKED)
def test_both_checkers_accept_what_is_written(name: str) -> None:
    content = _content(name)
    assert (content["version"], content["conditions"]) == (2, ["regular"])
    assert content["claim"] == {"planar, singular": "not-all", "a singular box": "not-all", "cranks": "map"}.get(
        name, "all"
    )
    for status, lines in verdicts(content):
        assert status == "accepted", lines
        assert lines[1].startswith("conditions: regular, as polynomials")


def _with(content: dict[str, Any], word: str) -> dict[str, Any]:
    return deepcopy(content) | {"paving": word, "inside": word.count("i"), "undecided": word.count("u")}


@pytest.mark.parametrize("name", ["planar, regular", "cranks"])
def test_parts_that_are_too_large_are_rejected(name: str) -> None:
    """Two halves that are inside in the place of one that the solver, which is nearly as sharp, did not prove."""
    content = _content(name)
    word = content["paving"]
    places = [k for k in range(len(word)) if word.startswith("sii", k)]
    assert places
    rejected = 0
    for place in places[:6]:
        forged = _with(content, word[:place] + "i" + word[place + 3 :])
        answers = {status for status, _ in verdicts(forged | {"measure": None} if name != "cranks" else forged)}
        assert len(answers) == 1
        rejected += answers == {"rejected"}
    assert rejected


def test_undecided_parts_are_not_inside() -> None:
    content = _content("cranks")
    assert "u" in content["paving"]
    for count in (1, 7):
        words = ["u"] * content["undecided"]
        words[-count] = "i"
        for status, lines in verdicts(_with(content, spliced(content["paving"], words))):
            assert status == "rejected"
            assert INSIDE in lines[-1]


def test_signs_of_two_poses_are_not_exchanged_for_one() -> None:
    content = _content("a singular box")
    first, other = content["counterexample"]
    for points in ([first, first], [other, other]):
        for status, lines in verdicts(content | {"counterexample": points}):
            assert status == "rejected"
            assert "opposite signs" in lines[-1]
    for points in ([first], [other]):
        for status, lines in verdicts(content | {"counterexample": points}):
            assert status == "rejected"
            assert "no condition is proved to fail" in lines[-1]


def test_a_hexapod_is_not_regular_in_a_box_that_is_too_large() -> None:
    content = deepcopy(_content("a general hexapod"))
    content["chart"]["box"][2] = ["-400", "1300"]
    for status, lines in verdicts(content):
        assert status == "rejected"
        assert INSIDE in lines[-1]

"""Whatever is changed in a certificate, both checkers refuse it, but for what is listed in ``mutations.FREE``."""

import re
from fractions import Fraction
from typing import Any

import mutations
import pytest
from certificate_subjects import EACH, SUBJECTS, subject
from certificate_tools import CERTS, Path_, at, both_resealed, golden, golden_bytes, last_line, with_entry
from mutations import FREE, FREE_2, FREE_MOBILITY, FREE_PLATFORM, Free, Mutation, outcome, quick_names, report

from pkm_exact import solve_system
from pkm_exact.certify import pure
from pkm_exact.certify.check import Status, Verdict, check_bytes
from pkm_exact.certify.system_build import system_certificate


@pytest.mark.parametrize("name", quick_names())
def test_no_change_survives(name: str) -> None:
    found = report(name)
    print(f"{mutations.HEADING}\n{found}")
    assert not found.survivors
    assert found.outcomes["digest"] == SUBJECTS[name].quick


@pytest.mark.slow
@pytest.mark.parametrize("name", SUBJECTS)
def test_no_change_of_many_survives(name: str) -> None:
    """``make mutations MUTATIONS=--complete`` makes ten times as many."""
    found = report(name, "slow")
    print(f"{mutations.HEADING}\n{found}")
    assert not found.survivors
    assert sum(found.outcomes.values()) == 2 * found.outcomes["digest"]


@pytest.mark.parametrize("name", EACH)
def test_certificates_are_accepted_unchanged(name: str) -> None:
    content = subject(name)
    data = mutations.canonical_bytes(mutations.sealed(content))
    verdict = check_bytes(data)
    assert verdict.status is Status.ACCEPTED
    assert SUBJECTS[name].quick == 0 or pure.check_bytes(data).lines == verdict.lines


@pytest.mark.parametrize("what", ["first dropped", "first instead of last"])
def test_too_few_independent_constraints_are_refused_at_once_by_both(what: str) -> None:
    """Before the costly parts: the rank over Q at all solutions, and that the section is finite."""
    name, path = "spatial-2, 3-RPS", ("robot", "constraints")
    wanted = [each for each in mutations.mutations(subject(name)) if (each.path, each.what) == (path, what)]
    assert [outcome(name, each) for each in wanted] == ["rejected"]


# What is free


def _replaced(name: str, path: Path_, value: Any) -> str:
    content = {key: entry for key, entry in subject(name).items() if key != "digest"}
    new = value(at(content, path)) if callable(value) else value
    return outcome(name, Mutation(path, "", with_entry(content, path, new)))


def _by(step: int) -> Any:
    return lambda value: hex(int(value, 16) + step)


PLANAR, SPATIAL, OPEN = "tolerance, planar, complete", "tolerance, spatial, complete", "tolerance-open, planar"
NEEDED: dict[str, tuple[str, Path_, Any]] = {
    "robot.name": ("planar, boxes", ("robot", "name"), "another"),
    "robot.unit": ("planar, boxes", ("robot", "unit"), "inch"),
    "robot.source": ("tolerance, planar, complete", ("robot", "source"), "elsewhere"),
    "configuration.name": ("planar, boxes", ("configuration", "name"), None),
    "formulation": ("planar, boxes", ("formulation",), "AFP3:124"),
    "notes": ("planar, boxes", ("notes",), ["a remark"]),
    "representation.chart": ("planar, multiple solutions", ("representation", "chart", 1), 5),
    "representation.separating_form": ("planar, multiple solutions", ("representation", "separating_form", 1), 5),
    "elimination": ("planar, multiple solutions", ("elimination",), lambda steps: [*steps, ["0 0"]]),
    "complex_solutions": ("unproved multiplicities", ("complex_solutions",), 5),
    "claim": ("nothing known", ("claim",), "positive-dimensional-detected"),
    "robot": ("inconsistent, joints in a point", ("robot", "metric", 0), "2"),
    "configuration.lengths_squared": (
        "inconsistent, joints in a point",
        ("configuration", "lengths_squared", 0),
        "1000",
    ),
    "tolerances": (PLANAR, ("tolerances", "lengths"), "0"),
    "boxes.*.outer": (PLANAR, ("boxes", 0, "outer", 0), _by(1)),
    "boxes.*.inner": (PLANAR, ("boxes", 0, "inner", 0), _by(1)),
    "pairs.*.outer": (PLANAR, ("pairs", 0, "outer", 0), _by(1)),
    **{
        f"boxes.*.{key}": (PLANAR, ("boxes", 0, key, *place, 1), lambda end: str(Fraction(end) + Fraction(1, 2**60)))
        for key, place in (("position", (0,)), ("rotation", (0, 2)), ("quaternion", (1,)), ("centroid", (0,)))
    },
    "boxes.*.position_error": (PLANAR, ("boxes", 0, "position_error"), "1"),
    "boxes.*.rotation_error": (PLANAR, ("boxes", 0, "rotation_error"), "1"),
    "boxes": (OPEN, ("boxes",), lambda boxes: boxes[:-1]),
    "unproved": (OPEN, ("unproved",), lambda numbers: [*numbers, 7]),
}
"""For each entry of ``FREE`` a change that is accepted."""


H4, LINES, SLICES, INFINITY = (
    *("kept-2, H4", "kept-2, planar lines", "moving-2-slices, slices"),
    "spatial-2-infinity, 3-PSS+C, general",
)
CONCURRENT = "kept-2, more legs than freedoms, a multiple solution"


def _fourth_more(values: list[int]) -> list[int]:
    """Another weight of C1, which is 0 at these points at infinity."""
    return [*values[:4], values[4] + 1, *values[5:]]


def _with_a_form_of_the_plane(forms: list[list[str]]) -> list[list[str]]:
    """The last one and r33 - 1, which is 0."""
    *others, last = forms
    return [*others, [*last[:15], str(Fraction(last[15]) + 1), str(Fraction(last[16]) - 1)]]


NEEDED_2: dict[str, tuple[str, Path_, Any]] = {
    "configuration": (H4, ("configuration",), "another"),
    "robot.constraints.*.name": (H4, ("robot", "constraints", 2, "name"), "another"),
    "robot.constraints": ("kept-2, redundant leg", ("robot", "constraints"), lambda legs: legs[:-1]),
    "robot": ("inconsistent-2, contradictory leg", ("robot", "motion"), "translation"),
    "robot.motion": (CONCURRENT, ("robot", "motion"), "translation"),
    "robot.metric": (CONCURRENT, ("robot", "metric", 2), "5"),
    "representation.chart": (LINES, ("representation", "chart", 1), 5),
    "representation.separating_form": (LINES, ("representation", "separating_form", 1), 5),
    "infinity.chart": (INFINITY, ("infinity", "chart"), _fourth_more),
    "infinity.separating_form": (INFINITY, ("infinity", "separating_form"), _fourth_more),
    "self_motion.forms": (SLICES, ("self_motion", "forms"), _with_a_form_of_the_plane),
    "self_motion.slices": (SLICES, ("self_motion", "slices", 1, "representation", "chart", 1), 5),
}
"""The same for ``FREE_2``."""

SARRUS, OBLIQUE = "mobility, Sarrus", "mobility-2, seven-link"
NEEDED_MOBILITY: dict[str, tuple[str, Path_, Any]] = {
    "mechanism": (SARRUS, ("mechanism", "source"), "elsewhere"),
    "*.rows": (OBLIQUE, ("platform", "rows", 0), 4),
    "actuator_sets.*.complete": (SARRUS, ("actuator_sets", "platform", "complete"), False),
    "finite": (SARRUS, ("finite",), None),
    "finite.legs": (SARRUS, ("finite", "legs"), lambda legs: legs[::-1]),
    "finite.dependencies": (OBLIQUE, ("finite", "dependencies", 0, 2), "2"),
    "finite.above": (OBLIQUE, ("finite", "above", "degree"), 3),
    "finite.below": (OBLIQUE, ("finite", "below", "legs"), lambda legs: legs[::-1]),
}
"""The same for ``FREE_MOBILITY``."""

LEGS, SIX, EQUAL = "platform, five legs", "platform, six legs", "platform, equal legs"
NEEDED_PLATFORM: dict[str, tuple[str, Path_, Any]] = {
    "robot": (LEGS, ("robot", "source"), "elsewhere"),
    "pose.position": (SIX, ("pose", "position", 0), "100"),
    "pose.rotation": (SIX, ("pose", "rotation"), [["0", "-1", "0"], ["1", "0", "0"], ["0", "0", "1"]]),
    "*.rows": (EQUAL, ("everywhere", "rows"), [1, 2]),
    "*.columns": (LEGS, ("everywhere", "columns"), [0, 1, 2, 3, 5]),
    "everywhere.position": (LEGS, ("everywhere", "position", 0), "100"),
    "everywhere.rotation": (LEGS, ("everywhere", "rotation"), [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]),
    "everywhere.route": (LEGS, ("everywhere", "route"), "none"),
    "everywhere.combinations": (EQUAL, ("everywhere", "combinations", 0), ["2", "-2", "0"]),
    "pose": (LEGS, ("pose",), None),
    "everywhere": (LEGS, ("everywhere",), None),
}
"""The same for ``FREE_PLATFORM``."""


def test_no_entry_of_the_tables_is_there_for_nothing() -> None:
    assert [free.path for free in FREE] == list(NEEDED)
    assert [free.path for free in FREE_2] == list(NEEDED_2)
    assert [free.path for free in FREE_MOBILITY] == list(NEEDED_MOBILITY)
    assert [free.path for free in FREE_PLATFORM] == list(NEEDED_PLATFORM)


@pytest.mark.parametrize(
    ("path", "change"), [*NEEDED.items(), *NEEDED_2.items(), *NEEDED_MOBILITY.items(), *NEEDED_PLATFORM.items()]
)
def test_what_is_free_may_change(path: str, change: tuple[str, Path_, Any]) -> None:
    assert _replaced(*change) == "free", path


@pytest.mark.parametrize(
    ("page", "heading", "free"),
    [
        ("certificates.md", "### What the digest binds", FREE),
        ("certificates-2.md", "## What the digest binds", FREE_2),
        ("certificates-mobility.md", "## What the digest binds", FREE_MOBILITY),
        ("certificates-platform.md", "## What the digest binds", FREE_PLATFORM),
    ],
)
def test_the_pages_list_what_is_free(page: str, heading: str, free: tuple[Free, ...]) -> None:
    text = (CERTS.parent / "docs" / page).read_text()
    table = text.partition(heading)[2].partition("\n#")[0]
    listed = re.findall(r"^\| `([a-z_.*]+)` \|", table, flags=re.MULTILINE)
    assert listed == [entry.path for entry in free]


# The suite itself


def test_a_checker_that_accepts_everything_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mutations, "check_bytes", lambda _: Verdict(Status.ACCEPTED, ("fine: all of it",)))
    found = report("planar, boxes")
    assert len(found.survivors) > SUBJECTS["planar, boxes"].quick


def test_checkers_that_disagree_are_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pure, "near_inverse", lambda matrix, _: [[pure.NULL] * len(matrix)] * len(matrix))
    assert any(" but " in survivor for survivor in report("tolerance, planar, complete").survivors)


def test_a_refusal_without_a_reason_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    refusal = Verdict(Status.REJECTED, ("no",))
    monkeypatch.setattr(mutations, "check_bytes", lambda _: refusal)
    monkeypatch.setattr(pure, "check_bytes", lambda _: pure.Verdict("rejected", ("no",)))
    assert report("planar, boxes").survivors


@pytest.mark.parametrize(
    ("value", "key", "others"),
    [
        (5, "version", [6, 4, -5, 0, 5.0, "5", True, None]),
        ("3/7", "x", ["10/7", "-4/7", "-3/7", "0", "3/2", "03/7", "+3/7", "6/14", 3 / 7]),
        ("-0x1f", "x", ["-0x1e", "-0x20", "0x1f", "0x0", "-0x10", "-31", "-0x01f", "+-0x1f", -31, "-0X1F"]),
        ("36 2 5", "x", ["37 2 5", "36 5", "36 2 5 5", "36  2 5"]),
        ("complete", "claim", ["completex", "complet", "COMPLETE", "inconsistent"]),
        (True, "complete", [False, 1, None]),
        ([1, 2, 3], "x", [[], [2, 3], [1, 2], [1, 1, 2, 3], [1, 2, 3, 3], [2, 1, 3], [3, 2, 1], [1, 2, 3, None]]),
        (
            {"a": 1, "b": 2},
            "x",
            [{"a": 1}, {"b": 2}, {"b": 2, "a": 1}, {"a_": 1, "b": 2}, {"a": 1, "b": 2, "extra": None}],
        ),
    ],
)
def test_what_an_entry_is_changed_into(value: Any, key: str, others: list[Any]) -> None:
    found = [repr(new) for _, new in mutations.changed(value, (key,))]
    assert {repr(other) for other in others} <= set(found)


# Bytes


@pytest.mark.parametrize("name", ["3-rpr-triple", "mourrain-l"])
def test_a_changed_byte(name: str) -> None:
    data = golden_bytes(name)
    for place in range(0, len(data), len(data) // 50):
        for byte in (data[place] ^ 1, data[place] ^ 0x80):
            changed = data[:place] + bytes([byte]) + data[place + 1 :]
            one, other = check_bytes(changed), pure.check_bytes(changed)
            assert str(one.status) == other.status
            assert one.status in (Status.REJECTED, Status.MALFORMED)


OF_A_KIND = {
    "poses, version 1": lambda: golden("3-rpr-merlet-p"),
    "poses, version 2": lambda: golden("h4"),
    "tolerance": lambda: subject(PLANAR),
    "mobility": lambda: subject("mobility, Sarrus"),
    "platform": lambda: golden("mobility/3-rps"),
    "system": lambda: system_certificate(solve_system(["x*y - 2", "x + y - 3"])),
    "region": lambda: golden("regions/rolland-6-6"),
    "region, version 2": lambda: golden("regions/3-rpr-merlet-p"),
    "statics": lambda: golden("statics/3-rpr-merlet-p"),
    "statics, version 2": lambda: golden("statics/3-rps"),
    "statics, version 3": lambda: golden("statics/dual-v"),
    "links": lambda: golden("links/four-bar"),
    "links, version 2": lambda: golden("links/3-rrr-regular"),
}


@pytest.mark.parametrize("name", OF_A_KIND)
def test_keys_in_another_order_are_malformed_for_one_reason(name: str) -> None:
    content = OF_A_KIND[name]()
    verdict = both_resealed(dict(reversed(content.items())))
    assert verdict.status == "malformed"
    assert "in this order" in last_line(verdict)

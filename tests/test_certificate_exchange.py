"""Certificates put together from true parts that do not belong together; both checkers reject them, for one reason."""

from fractions import Fraction
from itertools import chain, combinations, product
from typing import Any

import pytest
from budgets import budget
from certificate_subjects import subject
from certificate_tools import Path_, at, both_resealed, last_line, leaves, nodes, with_entry
from hypothesis import given
from hypothesis import strategies as st

from pkm_exact.certify.checker import document

Content = dict[str, Any]

LISTED = ("general 6-6, representation", "special robot, exact elimination", "planar, representation")
BOXED: Any = ("planar, boxes", pytest.param("general 6-6, boxes", marks=pytest.mark.slow))
TOLERANT: Any = ("tolerance, planar, complete", pytest.param("tolerance, spatial, complete", marks=pytest.mark.slow))
WEAKER = (
    "moving, congruent hexagons",
    "moving, dependent legs",
    "moving, joints in a point",
    "moving beside isolated poses",
    "inconsistent, joints in a point",
    "unproved multiplicities",
    "not proven complete",
    "nothing known",
)
HEADS = {
    "general 6-6, representation": "special robot, exact elimination",
    "special robot, exact elimination": "general 6-6, representation",
    "general 6-6, boxes": "chain 6-RUS in a Gram metric, boxes",
    "planar, representation": "planar, boxes",
    "planar, multiple solutions": "planar, representation",
    "planar, boxes": "planar, representation",
    "tolerance, spatial, complete": "special robot, exact elimination",
    "tolerance, planar, complete": "tolerance-open, planar",
    "tolerance-open, planar": "tolerance, planar, complete",
    "moving, congruent hexagons": "moving, dependent legs",
    "moving, dependent legs": "moving, joints in a point",
    "moving beside isolated poses": "planar, boxes",
    "inconsistent, joints in a point": "general 6-6, representation",
}
"""Certificates, each with another one for the same number of legs."""


def _rejected(content: Content, reason: str = "") -> None:
    answer = both_resealed(content)
    assert answer.status == "rejected", answer
    assert last_line(answer).startswith(reason), last_line(answer)


def _body(name: str) -> Content:
    return {key: value for key, value in subject(name).items() if key != "digest"}


# Parts of other certificates


@pytest.mark.parametrize("name", HEADS)
def test_the_proof_of_one_robot_under_the_name_of_another(name: str) -> None:
    other = subject(HEADS[name])
    _rejected(_body(name) | {"robot": other["robot"], "configuration": other["configuration"]})


@pytest.mark.parametrize(
    ("name", "other", "key"),
    [
        ("general 6-6, representation", "special robot, exact elimination", "representation"),
        ("special robot, exact elimination", "Gram metric, exact elimination", "elimination"),
        ("planar, multiple solutions", "planar, representation", "representation"),
        ("planar, representation", "planar, multiple solutions", "poses"),
        ("planar, boxes", "moving beside isolated poses", "krawczyk"),
        ("moving, congruent hexagons", "moving, dependent legs", "representation"),
        ("moving beside isolated poses", "planar, boxes", "krawczyk"),
        ("tolerance, planar, complete", "tolerance-open, planar", "boxes"),
        ("tolerance, planar, complete", "tolerance-open, planar", "frames"),
    ],
)
def test_a_part_is_that_of_another_system(name: str, other: str, key: str) -> None:
    _rejected(_body(name) | {key: subject(other)[key]})


def test_an_elimination_proves_nothing_beside_boxes_or_witnesses() -> None:
    steps = subject("special robot, exact elimination")["elimination"]
    for name in ("moving, congruent hexagons", "nothing known"):
        _rejected(_body(name) | {"elimination": steps})


# Claims


@pytest.mark.parametrize("route", ["refined-bezout", "exact-elimination", None])
@pytest.mark.parametrize("name", WEAKER)
def test_a_weaker_claim_is_raised_to_complete(name: str, route: str | None) -> None:
    content = _body(name) | {"claim": "complete", "completeness_route": route}
    _rejected(content)
    degree = 6 if len(content["robot"]["base"]) == 3 else 40
    _rejected(content | {"complex_solutions": degree, "distinct_solutions": degree})
    if content["krawczyk"] is None:
        _rejected(content | {"elimination": []})


@pytest.mark.parametrize("name", BOXED)
@pytest.mark.parametrize("route", ["refined-bezout", "exact-elimination"])
def test_fewer_boxes_are_called_complete(name: str, route: str) -> None:
    _rejected(_without_a_box(_body(name)) | {"completeness_route": route}, "claim")


def _without_a_box(content: Content) -> Content:
    boxes = content["krawczyk"]
    counts = {key: content[key] - 2 for key in ("complex_solutions", "distinct_solutions")}
    return {**content, **counts, "krawczyk": {**boxes, "complex": boxes["complex"][1:]}}


@pytest.mark.parametrize("name", BOXED)
def test_fewer_boxes_prove_less(name: str) -> None:
    weaker = {"claim": "not-proven-complete", "completeness_route": None}
    assert both_resealed(_without_a_box(_body(name)) | weaker).status == "accepted"


def test_tolerances_are_called_complete() -> None:
    content = _body("tolerance-open, planar")
    _rejected(content | {"complete": True}, "complete")
    _rejected(content | {"complete": True, "unproved": []}, "boxes")
    boxes = [{**box, "pose": number} for number, box in enumerate(content["boxes"], 1)]
    _rejected(content | {"complete": True, "unproved": [], "boxes": boxes}, "complete")
    _rejected(content | {"complete": True, "unproved": [], "boxes": [*boxes, {**boxes[0], "pose": 6}]}, "boxes")


@pytest.mark.parametrize("name", TOLERANT)
def test_solutions_that_are_not_real_are_counted_twice(name: str) -> None:
    content = _body(name)
    _rejected(content | {"pairs": [content["pairs"][0], *content["pairs"][:-1]]}, "complete")
    _rejected(content | {"pairs": [content["pairs"][0], *content["pairs"]]}, "complete")
    _rejected(content | {"pairs": content["pairs"][1:]}, "complete")


# Poses


@pytest.mark.parametrize("name", LISTED)
def test_a_pose_is_dropped_together_with_its_count(name: str) -> None:
    content = _body(name)
    fewer = content["poses"][1:]
    _rejected(content | {"poses": fewer, "real_poses": len(fewer)}, "real poses")
    counts = {key: content[key] - 1 for key in ("complex_solutions", "distinct_solutions")}
    _rejected(content | {"poses": fewer, "real_poses": len(fewer)} | counts, "real poses")


@pytest.mark.parametrize("name", BOXED)
def test_a_pose_is_dropped_together_with_its_box_and_counts(name: str) -> None:
    content = _body(name)
    counts = {key: content[key] - 1 for key in ("complex_solutions", "distinct_solutions", "real_poses")}
    boxes = {**content["krawczyk"], "real": content["krawczyk"]["real"][1:]}
    _rejected(content | counts | {"krawczyk": boxes, "poses": content["poses"][1:]}, "claim")


@pytest.mark.parametrize("name", TOLERANT)
def test_a_pose_is_dropped_from_a_tolerance_certificate(name: str) -> None:
    content = _body(name)
    boxes = [{**box, "pose": number} for number, box in enumerate(content["boxes"][1:], 1)]
    _rejected(content | {"boxes": boxes}, "complete")


@pytest.mark.parametrize("name", [*LISTED, *BOXED])
def test_a_pose_is_listed_twice(name: str) -> None:
    content = _body(name)
    more = {"poses": [content["poses"][0], *content["poses"]], "real_poses": len(content["poses"]) + 1}
    _rejected(content | more, "real poses")
    same = {"poses": [content["poses"][0], content["poses"][0], *content["poses"][2:]]}
    _rejected(content | same)
    if content["krawczyk"] is not None:
        boxes = content["krawczyk"]
        counts = {key: content[key] + 1 for key in ("complex_solutions", "distinct_solutions")}
        twice = {**boxes, "real": [boxes["real"][0], *boxes["real"]]}
        if content["complex_solutions"] < 40:
            _rejected(content | more | counts | {"krawczyk": twice}, "boxes")
        twice = {**boxes, "real": [boxes["real"][0], boxes["real"][0], *boxes["real"][2:]]}
        _rejected(content | same | {"krawczyk": twice}, "boxes")


def test_two_boxes_hold_the_same_pose_of_every_robot() -> None:
    content = _body("tolerance, planar, complete")
    first = content["boxes"][0]
    _rejected(content | {"boxes": [first, {**first, "pose": 2}]}, "boxes: the poses 1 and 2")
    content = _body("tolerance-open, planar")
    first, *others = content["boxes"]
    _rejected(content | {"boxes": [first, *others[:-1], {**first, "pose": 6}]}, "boxes: the poses 1 and 6")
    _rejected(content | {"boxes": [*content["boxes"], {**others[0], "pose": 7}]}, "boxes: the poses 3 and 7")


@pytest.mark.parametrize("name", [*LISTED, *BOXED])
@pytest.mark.parametrize("cells", [1, -1])
def test_a_box_is_moved_by_less_than_its_width(name: str, cells: int) -> None:
    content = _body(name)
    for path in (("position", 0), ("rotation", 1, 1), ("quaternion", 3)):
        place: Path_ = ("poses", 0, *path)
        low, high = map(Fraction, at(content, place))
        step = Fraction(cells, 2 ** (content["box_exponent"] + 1))
        _rejected(with_entry(content, place, [str(low + step), str(high + step)]), "boxes")


@pytest.mark.parametrize("name", BOXED)
@pytest.mark.parametrize("units", [1, -1, 3])
def test_a_box_around_a_solution_is_moved_by_less_than_its_width(name: str, units: int) -> None:
    content = _body(name)
    place: Path_ = ("krawczyk", "real", 0, "centre", 0)
    _rejected(with_entry(content, place, hex(int(at(content, place), 16) + units)), "boxes")
    place = ("krawczyk", "complex", 0, "centre", 0, 1)
    _rejected(with_entry(content, place, hex(int(at(content, place), 16) + units)), "boxes")


@pytest.mark.parametrize("name", TOLERANT)
@pytest.mark.parametrize("units", [1, -1, 2**20])
def test_a_tolerance_box_is_moved_by_less_than_its_width(name: str, units: int) -> None:
    content = _body(name)
    for place in (("boxes", 0, "centre", 0, 0), ("pairs", 0, "centre", 1, 1)):
        _rejected(with_entry(content, place, hex(int(at(content, place), 16) + units)), str(place[0])[:3])


@pytest.mark.parametrize("name", TOLERANT)
def test_tolerances_are_greater_than_what_is_proved(name: str) -> None:
    content = _body(name)
    for key in ("base", "platform", "lengths"):
        more = str(Fraction(content["tolerances"][key]) * Fraction(3, 2))
        _rejected(with_entry(content, ("tolerances", key), more), "box of pose 1")


@pytest.mark.parametrize("name", TOLERANT)
@pytest.mark.parametrize("key", ["position", "rotation", "quaternion", "centroid"])
def test_bounds_are_narrower_than_what_is_proved(name: str, key: str) -> None:
    content = _body(name)
    place: Path_ = ("boxes", 0, key, 0, 0) if key == "rotation" else ("boxes", 0, key, 0)
    low, high = map(Fraction, at(content, place))
    step = (high - low) / 100
    _rejected(with_entry(content, place, [str(low + step), str(high)]), "box of pose 1: a bound")
    _rejected(with_entry(content, place, [str(low), str(high - step)]), "box of pose 1: a bound")
    _rejected(with_entry(content, place, [str(high), str(high)]), "box of pose 1: a bound")


@pytest.mark.parametrize("name", TOLERANT)
def test_bounds_are_so_wide_that_another_pose_could_satisfy_them(name: str) -> None:
    content = _body(name)
    for key in ("centroid", "quaternion"):
        place: Path_ = ("boxes", 0, key, 0)
        low, high = map(Fraction, at(content, place))
        wide = [str(low - 100 * (high - low)), str(high + 100 * (high - low))]
        _rejected(with_entry(content, place, wide), "box of pose 1: the bounds of the pose reach beyond")


@pytest.mark.parametrize("name", TOLERANT)
@pytest.mark.parametrize("key", ["position_error", "rotation_error"])
def test_errors_are_smaller_than_what_is_proved(name: str, key: str) -> None:
    content = _body(name)
    less = str(Fraction(at(content, ("boxes", 0, key))) * Fraction(99, 100))
    _rejected(with_entry(content, ("boxes", 0, key), less), f"box of pose 1: its {key.partition('_')[0]} error")


# What the format has no place for


@pytest.mark.parametrize("prime", [91, 3, 1, 0, -7, 2**9, "0x1fffffffffffffff"])
@pytest.mark.parametrize("place", [(), ("representation",), ("robot",)])
def test_no_prime_is_taken_from_a_file(prime: Any, place: Path_) -> None:
    """A checker uses primes of its own; one that is composite, or divides what it must not, cannot be given to it."""
    content = _body("planar, representation")
    answer = both_resealed(with_entry(content, place, {**at(content, place), "prime": prime}))
    assert answer.status == "malformed"


# Anything at all

ANYTHING = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.text(max_size=8)
    | st.sampled_from(["0x1", "-0x7f", "1/3", "-5", "0"]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)


@budget(40)
@given(st.data())
def test_any_json_in_place_of_an_entry_gets_one_verdict(data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(["tolerance, planar, complete", "tolerance-open, planar", "planar, boxes"]))
    content = _body(name)
    path = data.draw(st.sampled_from([path for path, _ in nodes(content) if path]))
    both_resealed(with_entry(content, path, data.draw(ANYTHING)))


EXTREMES = (
    "1/" + "9" * 599,
    "9" * 600,
    "1/" + "7" * 50,
    "7" * 50,
    "0",
    "-1",
    "0x0",
    "0x1",
    "0x" + "f" * 90,
    "0x" + "f" * 2048,
)
NUMBERS = (0, 1, 2, 40, 4096, 2048, 8192, 10**6, -(10**6))


@pytest.mark.parametrize(
    "entries",
    [4, pytest.param(12, marks=pytest.mark.slow), pytest.param(100, marks=[pytest.mark.slow, pytest.mark.largest])],
)
@pytest.mark.parametrize("place", ["frames", "exponent", "tolerances", "boxes", "pairs", "robot", "configuration"])
def test_extreme_numbers_in_a_tolerance_certificate_get_one_verdict(place: str, entries: int) -> None:
    content = _body("tolerance, planar, complete")
    paths = [path for path, value in leaves(content) if path[0] == place and isinstance(value, str | int)]
    for path in paths[:: max(len(paths) // entries, 1)]:
        for value in NUMBERS if isinstance(at(content, path), int) else EXTREMES:
            both_resealed(with_entry(content, path, value))


# Every combination of parts, claims and routes

PARTS = ("representation", "elimination", "krawczyk", "poses")
ACCEPTED = {
    ("nothing known", (), "not-proven-complete", None, "exact"),
    ("nothing known", (), "positive-dimensional-detected", None, "exact"),
    ("planar, multiple solutions", (), "not-proven-complete", None, "exact"),
    ("planar, multiple solutions", (), "positive-dimensional-detected", None, "exact"),
    (
        "planar, multiple solutions",
        ("representation", "elimination", "poses"),
        "complete",
        "exact-elimination",
        "exact",
    ),
    ("planar, boxes", (), "not-proven-complete", None, "exact"),
    ("planar, boxes", (), "positive-dimensional-detected", None, "exact"),
    ("planar, boxes", ("krawczyk", "poses"), "complete", "refined-bezout", "krawczyk"),
    ("moving beside isolated poses", (), "not-proven-complete", None, "exact"),
    ("moving beside isolated poses", (), "positive-dimensional-detected", None, "exact"),
    ("moving beside isolated poses", ("krawczyk", "poses"), "not-proven-complete", None, "krawczyk"),
    ("moving beside isolated poses", ("krawczyk", "poses"), "positive-dimensional-detected", None, "exact"),
    ("moving beside isolated poses", ("representation",), "positive-dimensional-proved", None, "exact"),
    (
        "moving beside isolated poses",
        ("representation", "krawczyk", "poses"),
        "positive-dimensional-proved",
        None,
        "exact",
    ),
    ("inconsistent, joints in a point", (), "not-proven-complete", None, "exact"),
    ("inconsistent, joints in a point", (), "positive-dimensional-detected", None, "exact"),
    ("inconsistent, joints in a point", ("elimination",), "inconsistent", "exact-elimination", "exact"),
}
"""Parts that are kept, claim, route and method; nothing else may be accepted."""


@pytest.mark.usefixtures("remembered")
@pytest.mark.parametrize("name", sorted({name for name, *_ in ACCEPTED}))
def test_parts_claims_and_routes_go_together_in_few_ways(name: str) -> None:
    body = _body(name)
    given = [key for key in PARTS if body[key] is not None and body[key] != []]
    given += ["elimination"] * (body["elimination"] == [])
    found = set()
    for keep in chain.from_iterable(combinations(given, size) for size in range(len(given) + 1)):
        part = {key: body[key] if key in keep else None for key in PARTS} | {"poses": body["poses"] * ("poses" in keep)}
        part |= {"real_poses": len(part["poses"])} | ({} if part["poses"] else {"box_exponent": 0})
        for counts in (body["complex_solutions"], body["distinct_solutions"]), (0, 0):
            part |= dict(zip(("complex_solutions", "distinct_solutions"), counts, strict=True))
            for claim, route, method in product(document.CLAIMS, (None, *document.ROUTES), document.METHODS):
                words = {"claim": claim, "completeness_route": route, "method": method}
                if both_resealed(body | part | words).status == "accepted":
                    found.add((name, tuple(key for key in PARTS if key in keep), claim, route, method))
    assert found == {entry for entry in ACCEPTED if entry[0] == name}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["moving beside isolated poses", "planar, boxes", "moving, congruent hexagons"])
def test_an_empty_elimination_is_not_overlooked(name: str) -> None:
    for claim, route in product(document.CLAIMS, (None, *document.ROUTES)):
        for method, parts in product(document.METHODS, ({}, {"representation": None})):
            words = {"claim": claim, "completeness_route": route, "method": method, "elimination": []}
            _rejected(_body(name) | words | parts)

"""Any change to a certificate is noticed, even when its digest is made to fit."""

from typing import Any

import pytest
from certificate_tools import (
    NAMES,
    Path_,
    at,
    check_resealed,
    golden,
    golden_bytes,
    leaves,
    neighbours,
    nodes,
    restructured,
    sample,
    with_entry,
    without_proof,
)

from pkm_exact.certify.build import canonical_bytes
from pkm_exact.certify.check import Status, check_bytes

REFUSED = (Status.REJECTED, Status.MALFORMED)
SMALL = ("robocrane-r", "mourrain-l", "similar-planar-s")

NOT_MATHEMATICS: tuple[Path_, ...] = (
    ("robot", "name"),
    ("robot", "unit"),
    ("robot", "source"),
    ("configuration", "name"),
    ("formulation",),
    ("notes",),
    ("digest",),
    ("elimination",),
)
"""Entries that describe, but enter no proof; the digest, made anew; a proof to be followed, tested on its own."""


def _is_mathematics(path: Path_) -> bool:
    return not any(path[: len(free)] == free for free in NOT_MATHEMATICS)


def _refused_after_resealing(content: dict[str, Any], path: Path_) -> None:
    for value in neighbours(at(content, path)):
        answer = check_resealed(with_entry(content, path, value))
        assert answer.status in REFUSED, (path, value)


@pytest.mark.parametrize("name", NAMES)
def test_a_changed_entry_without_a_new_digest(name: str) -> None:
    content = golden(name)
    for path in sample(content, 211):
        for value in neighbours(at(content, path)):
            data = canonical_bytes(with_entry(content, path, value))
            assert check_bytes(data).status is Status.REJECTED, (path, value)


@pytest.mark.parametrize("name", NAMES)
def test_a_changed_byte(name: str) -> None:
    data = golden_bytes(name)
    for place in range(0, len(data), len(data) // 50):
        for byte in (data[place] ^ 1, data[place] ^ 0x80):
            changed = data[:place] + bytes([byte]) + data[place + 1 :]
            assert check_bytes(changed).status in REFUSED, place


@pytest.mark.parametrize("name", SMALL)
def test_a_changed_entry_with_a_new_digest(name: str) -> None:
    content = without_proof(golden(name))
    for path in filter(_is_mathematics, sample(content, 13)):
        _refused_after_resealing(content, path)


def test_claims_and_counts_beside_an_elimination() -> None:
    content = golden("similar-planar-s")
    for path, _ in leaves(content):
        if len(path) == 1 and _is_mathematics(path):
            _refused_after_resealing(content, path)


@pytest.mark.parametrize("step", [29, pytest.param(1, marks=pytest.mark.slow)])
def test_a_changed_elimination_proves_the_same_or_nothing(step: int) -> None:
    content = golden("similar-planar-s")
    lines = check_resealed(content).lines
    products = [path for path, _ in leaves(content) if path[0] == "elimination"]
    for path in products[::step]:
        index, *factors = map(int, at(content, path).split())
        for product in ([index + 1, *factors], [index, *((factor + 1) % 10 for factor in factors)], [index]):
            value = " ".join(map(str, product))
            answer = check_resealed(with_entry(content, path, value))
            assert answer.status in REFUSED or answer.lines == lines, path


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_every_changed_entry_with_a_new_digest(name: str) -> None:
    content = without_proof(golden(name))
    for path, _ in leaves(content):
        if _is_mathematics(path):
            _refused_after_resealing(content, path)


@pytest.mark.parametrize("name", SMALL)
def test_entries_dropped_doubled_moved_or_renamed(name: str) -> None:
    content = without_proof(golden(name))
    del content["digest"]
    for number, (path, value) in enumerate(nodes(content)):
        deep = len(path) > 2 and path[0] in ("poses", "representation")
        if _is_mathematics(path) and not (deep and number % 7):
            for changed in restructured(value):
                assert check_resealed(with_entry(content, path, changed)).status in REFUSED, path


@pytest.mark.parametrize("name", SMALL)
def test_what_is_not_mathematics_may_change(name: str) -> None:
    content = golden(name)
    content["robot"] |= {"name": "another", "unit": "inch", "source": "elsewhere"}
    content["configuration"]["name"] = None
    content["formulation"] = "AFP3:124"
    content["notes"] = ["a remark"]
    assert check_resealed(content).status is Status.ACCEPTED

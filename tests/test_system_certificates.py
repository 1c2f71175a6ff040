"""Certificates of polynomial systems: both checkers accept what is honest and refuse what is forged or changed."""

from __future__ import annotations

import json
import re
from collections import Counter
from functools import cache
from importlib.resources import files

import jsonschema
import mutations
import pytest
from certificate_tools import both
from forged_systems import FORGERIES, MALFORMED
from handmade_systems import Content, handmade, sealed_bytes
from mutations import Free, Mutation, sampled

from pkm_exact.certify import pure
from pkm_exact.certify.check import check_bytes

MADE = handmade()

OPEN = ("algebra", "multiple", "nothing", "detected", "none", "few", "many")
"""First words of the names of certificates of which less is proved."""

FREE = (
    Free("title", "describes"),
    Free("notes", "describes"),
    Free("variables", "names; in another order, another system of which the same is proved"),
    Free("polynomials", "in another order, or one of them twice: the same system", below=False),
    Free("polynomials", "the question: the same is proved of the other system", OPEN),
    Free("subdivision", "other numbers, or reasons, prove the same"),
    Free("elimination", "steps to be followed: others that end the same prove the same"),
    Free("claim", "detected is evidence, nothing is proved either way", ("nothing", "detected")),
    Free("representation.separating_form", "any c with the same values, if numerators are dependent"),
    Free("infinity.chart", "any w with the same w.Z, if coordinates are dependent"),
    Free("infinity.separating_form", "any c with the same c.Z, if coordinates are dependent"),
    Free("witness.forms", "how to cut: other slices prove the same", ("many",)),
    Free("witness.slices", "more of them, or others, prove the same", ("many",)),
)
"""What a new digest can cover. Docs: ``docs/certificates-systems.md``, "What the digest binds"."""


@pytest.mark.parametrize("name", MADE)
def test_both_accept_with_the_same_lines(name: str) -> None:
    assert both(sealed_bytes(MADE[name])).status == "accepted"


@pytest.mark.parametrize("name", MADE)
def test_they_fit_the_schema(name: str) -> None:
    jsonschema.Draft202012Validator(_schema()).validate(json.loads(sealed_bytes(MADE[name])))


@cache
def _schema() -> Content:
    text = (files("pkm_exact.certify") / "system-certificate-1.schema.json").read_text(encoding="utf-8")
    schema: Content = json.loads(text)
    return schema


@pytest.mark.parametrize("name", FORGERIES)
def test_both_reject_what_is_forged(name: str) -> None:
    make, reason = FORGERIES[name]
    verdict = both(sealed_bytes(make()))
    assert verdict.status == "rejected", verdict.lines
    assert re.search(reason, verdict.lines[-1]), verdict.lines[-1]


@pytest.mark.parametrize("name", MALFORMED)
def test_both_call_malformed_what_is(name: str) -> None:
    assert both(sealed_bytes(MALFORMED[name]())).status == "malformed"


def outcome(name: str, mutation: Mutation) -> str:
    """What both say of a change whose digest was made to fit; "survives: .." if it should not be so."""
    whole = isinstance(mutation.content, dict)
    data = sealed_bytes(mutation.content) if whole else mutations.canonical_bytes(mutation.content)
    one, other = check_bytes(data), pure.check_bytes(data)
    if str(one.status) != other.status:
        return f"survives: {one.lines[-1]} ({one.status}), but {other.lines[-1]} ({other.status})"
    if one.status in ("rejected", "malformed") and ":" in one.lines[-1]:
        return str(one.status)
    if (
        one.status == "accepted"
        and one.lines == other.lines
        and any(free.includes(name, mutation.path) for free in FREE)
    ):
        return "free"
    return f"survives: {one.status}: {mutation.what}"


def _survivors(name: str, most: int | None) -> tuple[list[str], Counter[str]]:
    found, outcomes = [], Counter[str]()
    for mutation in sampled(list(mutations.mutations(MADE[name])), most, name):
        said = outcome(name, mutation)
        outcomes[said.partition(":")[0]] += 1
        if said.startswith("survives"):
            found.append(f"{'.'.join(map(str, mutation.path))}: {mutation.what}: {said}")
    return found, outcomes


@pytest.mark.parametrize("name", MADE)
def test_no_change_survives(name: str) -> None:
    found, outcomes = _survivors(name, 60)
    assert not found
    assert outcomes["rejected"] >= 2
    assert outcomes["malformed"] >= 30


@pytest.mark.slow
@pytest.mark.parametrize("name", MADE)
def test_no_change_of_all_survives(name: str) -> None:
    assert not _survivors(name, None)[0]

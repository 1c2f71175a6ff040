"""Certificates of the shipped robots, each made once in a test process, and ways to change them."""

import json
import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

from samples import boxed, model, tolerant

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, certificate, sealed
from pkm_exact.certify.check import Verdict, check_bytes
from pkm_exact.certify.tolerance_build import tolerance_certificate

CERTS = Path(__file__).parent.parent / "certs"
FIRST = Path(__file__).parent / "version-1"
"""Certificates of version 1 that were shipped before their robots had shorter proofs."""
NAMES = ("dietmaier", "mourrain-l", "robocrane-r", "rolland-6-6", "similar-planar-s")

Path_ = tuple[str | int, ...]


def golden_bytes(name: str) -> bytes:
    """A certificate of version 1 as it is in the repository: golden, or shipped once."""
    first = FIRST / f"{name}.json"
    return (first if first.exists() else CERTS / f"{name}.json").read_bytes()


def golden(name: str) -> dict[str, Any]:
    """The same, parsed."""
    return json.loads(golden_bytes(name))


@cache
def _boxed_bytes(name: str) -> bytes:
    robot = model(name)
    return canonical_bytes(certificate(robot, robot.configuration().name, boxed(name)))


def boxed_certificate(name: str) -> dict[str, Any]:
    """The certificate of the numeric engine for a shipped robot, parsed anew: it may be changed."""
    return json.loads(_boxed_bytes(name))


@cache
def _tolerance_bytes(name: str, tolerance: str) -> bytes:
    robot = model(name)
    return canonical_bytes(tolerance_certificate(robot, robot.configuration().name, tolerant(name, tolerance)))


def tolerant_certificate(name: str, tolerance: str) -> dict[str, Any]:
    """The tolerance certificate of a shipped robot, parsed anew: it may be changed."""
    return json.loads(_tolerance_bytes(name, tolerance))


def without_proof(content: dict[str, Any]) -> dict[str, Any]:
    """The weaker certificate that lacks the elimination and does not claim completeness by it; quicker to check."""
    if content["elimination"] is None:
        return content
    return {**content, "claim": "not-proven-complete", "completeness_route": None, "elimination": None}


def check_resealed(content: dict[str, Any]) -> Verdict:
    """The verdict on a changed certificate whose digest was made to fit."""
    return check_bytes(canonical_bytes(sealed(content)))


def both(data: bytes) -> Verdict:
    """The verdict of the first checker, after making sure that the second one gives it, for the same reason."""
    one, other = check_bytes(data), pure.check_bytes(data)
    assert (str(one.status), _reason(one.lines)) == (other.status, _reason(other.lines)), (one.lines, other.lines)
    if one.status == "accepted":
        assert one.lines == other.lines
    return one


def _reason(lines: tuple[str, ...]) -> str:
    return lines[-1].partition(":")[0].partition("[")[0]


def both_resealed(content: dict[str, Any]) -> Verdict:
    """The verdict of both on a changed certificate whose digest was made to fit."""
    return both(canonical_bytes(sealed(content)))


def last_line(verdict: Verdict) -> str:
    """The reason of a verdict other than accepted."""
    return verdict.lines[-1]


def at(content: Any, path: Path_) -> Any:
    """The entry at a path."""
    for key in path:
        content = content[key]
    return content


def nodes(value: Any, path: Path_ = ()) -> Iterator[tuple[Path_, Any]]:
    """All lists, objects and leaves below a value, with their paths."""
    yield path, value
    if isinstance(value, dict | list):
        for key, entry in value.items() if isinstance(value, dict) else enumerate(value):
            yield from nodes(entry, (*path, key))


def leaves(content: Any) -> Iterator[tuple[Path_, Any]]:
    """All texts, numbers and nulls, with their paths."""
    return ((path, value) for path, value in nodes(content) if not isinstance(value, dict | list))


def neighbours(value: Any) -> list[Any]:
    """Other values of the same kind that a leaf could have."""
    if value is None:
        return [0, 1, "refined-bezout"]
    if isinstance(value, int):
        return [value - 1, value + 1]
    if re.fullmatch(r"-?0x[0-9a-f]+", value):
        return [hex(int(value, 16) + step) for step in (-1, 1)]
    if re.fullmatch(r"-?[0-9]+(/[0-9]+)?", value):
        return [str(Fraction(value) + step) for step in (-1, 1)]
    return [value + "x", value[:-1]]


def with_entry(content: dict[str, Any], path: Path_, value: Any) -> dict[str, Any]:
    """The content with another value at a path; shares everything else with the original."""
    if not path:
        return value
    changed: Any = dict(content) if isinstance(content, dict) else list(content)
    changed[path[0]] = with_entry(content[path[0]], path[1:], value)  # type: ignore[index]
    return changed

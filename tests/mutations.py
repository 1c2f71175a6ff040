"""Every number, list, word and key of a certificate, changed: the checkers must refuse, and say why.

``make mutations`` prints how many changes were made to certificates of every kind and what became of them; with
``MUTATIONS=--complete`` it makes them all. A change is tried twice: in the file as it is, where the digest gives it
away whatever it is, and with a new digest, where the proof must. There is no third way out but ``FREE``.
"""

from __future__ import annotations

import re
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from random import Random
from typing import Any

from certificate_subjects import SUBJECTS, Content, subject
from certificate_tools import Path_, nodes, with_entry

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.check import check_bytes

# What may change: another certificate, as true as the first


@dataclass(frozen=True)
class Free:
    """Entries at and below a path ("*" is any index) that another digest may cover, in these kinds of certificates."""

    path: str
    reason: str
    kinds: tuple[str, ...] = ()
    below: bool = True

    def includes(self, kind: str, path: Path_) -> bool:
        """Whether an entry of a certificate of this kind is meant."""
        words = self.path.split(".")
        fits = (len(path) >= len(words) if self.below else len(path) == len(words)) and all(
            a in ("*", str(b)) for a, b in zip(words, path, strict=False)
        )
        return fits and (not self.kinds or re.split("[ ,]", kind)[0] in self.kinds)


MOVING_2 = ("moving-2", "moving-2-slices")
KEPT_2 = ("kept-2", *MOVING_2)
ALL_2 = ("spatial-2", "spatial-2-infinity", "spatial-2-elimination", "inconsistent-2", *KEPT_2)
DEPENDENT = ("planar", "moving", "unproved", "nothing")
FREE = (
    Free("robot.name", "describes"),
    Free("robot.unit", "describes"),
    Free("robot.source", "describes"),
    Free("configuration.name", "describes"),
    Free("formulation", "describes"),
    Free("notes", "describes"),
    Free("representation.chart", "any w with the same w.E, if entries of E are dependent", DEPENDENT),
    Free("representation.separating_form", "any c with the same c.(E, F), if entries are dependent", DEPENDENT),
    Free("elimination", "steps to be followed: others that end the same prove the same"),
    Free("complex_solutions", "not proved, and the line of the checker says so", ("unproved",)),
    Free("claim", "detected is evidence, nothing is proved either way", ("nothing",)),
    *(
        Free(path, "the question: the same is proved of the other robot", ("moving", "inconsistent", "nothing"))
        for path in ("robot", "configuration.lengths_squared")
    ),
    Free("tolerances", "the question: for smaller tolerances the same is true", ("tolerance",)),
    Free("boxes.*.outer", "where to look: any box that is proved serves", ("tolerance",)),
    Free("boxes.*.inner", "where to look: any box that is proved serves", ("tolerance",)),
    Free("pairs.*.outer", "where to look: any box that is proved serves", ("tolerance",)),
    *(
        Free(f"boxes.*.{key}", "a bound: others that are proved are true", ("tolerance",))
        for key in ("position", "rotation", "quaternion", "centroid", "position_error", "rotation_error")
    ),
    Free(
        "boxes", "claims less if it is shorter and nothing is claimed to be complete", ("tolerance-open",), below=False
    ),
    Free("unproved", "claims nothing", ("tolerance-open",)),
)
"""All entries that a new digest can cover, with the reason. Docs: ``docs/certificates.md``, "What a digest binds"."""

FREE_MOBILITY = (
    Free(
        "mechanism", "the question: the same is proved of the other mechanism", ("mobility", "mobility-2", "mobility-3")
    ),
    Free("*.rows", "another minor that is not 0", ("mobility", "mobility-2", "mobility-3")),
    Free("actuator_sets.*.complete", "claims less if it is false", ("mobility", "mobility-2", "mobility-3")),
    Free("finite", "null claims less", ("mobility",), below=False),
    Free("finite.legs", "another order of the legs", ("mobility",), below=False),
    Free("finite.dependencies", "others prove the same", ("mobility-2", "mobility-3")),
    Free("finite.above", "another section, or a greater degree", ("mobility-2", "mobility-3")),
    Free("finite.below", "another order of the legs, other freedoms, other vectors", ("mobility-2",)),
)
"""The same for certificates of mobility. Docs: ``docs/certificates-mobility.md``."""

FREE_PLATFORM = (
    Free("robot", "the question: the same is proved of the other robot", ("platform",)),
    Free("pose.position", "the same is true of another pose", ("platform",)),
    Free("pose.rotation", "the same is true of another pose", ("platform",)),
    Free("*.rows", "another minor that is not 0", ("platform",)),
    Free("*.columns", "another minor that is not 0", ("platform",)),
    Free("everywhere.position", "another pose with this rank", ("platform",)),
    Free("everywhere.rotation", "another pose with this rank", ("platform",)),
    Free("everywhere.route", "none claims less", ("platform",)),
    Free("everywhere.combinations", "others prove the same", ("platform",)),
    Free("pose", "null claims less", ("platform",), below=False),
    Free("everywhere", "null claims less", ("platform",), below=False),
)
"""The same for certificates of a platform's mobility. Docs: ``docs/certificates-platform.md``."""

FREE_2 = (
    Free("configuration", "describes", ALL_2),
    Free("robot.constraints.*.name", "describes", ALL_2),
    Free("robot.constraints", "the same poses in another order, or without one that the others imply", ALL_2, False),
    Free("robot", "the question: the same is proved of the other robot", (*MOVING_2, "inconsistent-2")),
    Free("robot.motion", "a group of motions with the same poses", KEPT_2),
    Free("robot.metric", "the third one enters nothing in the plane", KEPT_2),
    Free("representation.chart", "any w with the same w.E, if entries of E are dependent", KEPT_2),
    Free("representation.separating_form", "any c with the same c.(E, F), if entries are dependent", KEPT_2),
    Free("infinity.chart", "any w with the same w.Z, if entries of Z are dependent", ("spatial-2-infinity",)),
    Free("infinity.separating_form", "any c with the same c.Z", ("spatial-2-infinity",)),
    Free("self_motion.forms", "how to cut: other slices prove the same", ("moving-2-slices",)),
    Free("self_motion.slices", "more of them, or others, prove the same", ("moving-2-slices",)),
)
"""The same for certificates of version 2 only. Docs: ``docs/certificates-2.md``, "What the digest binds"."""


# The changes

WORDS: dict[str, tuple[str, ...]] = {
    "format": ("pkm_exact certificate", "pkm_exact tolerance certificate", "pkm_exact mobility certificate"),
    "route": ("full", "combination", "grid", "none"),
    "kind": ("6-UPS", "3-RPR", "3-RRR"),
    "argument": ("regular", "subgroups", "second-order", "rank", "cone", "definite", "indefinite"),
    "method": ("exact", "krawczyk", "newton"),
    "claim": (
        "complete",
        "not-proven-complete",
        "positive-dimensional-detected",
        "positive-dimensional-proved",
        "inconsistent",
    ),
    "completeness_route": (
        "refined-bezout",
        "exact-elimination",
        "product-bound",
        "modular-rank",
        "counting-at-infinity",
    ),
    "motion": ("spatial", "planar", "schoenflies", "translation", "spherical"),
    "type": ("distance", "in-plane", "carries", "on-line", "at-point", "angle", "axis-distance", "linear", *"RPHCUS"),
    "cause": ("dependent-forms", "symmetry", "equal-legs", "more-poses-than-bound"),
    "formulation": ("SE3", "AFD4", "AFP3:124", "AFD9"),
}


@dataclass(frozen=True)
class Mutation:
    """A certificate with another entry at a path."""

    path: Path_
    what: str
    content: Any


def mutations(content: Content) -> Iterator[Mutation]:
    """All changes of one entry, list or object; the digest is left out."""
    body = {key: value for key, value in content.items() if key != "digest"}
    for path, value in nodes(body):
        for what, new in changed(value, path):
            if not _is_same(new, value):
                yield Mutation(path, what, with_entry(body, path, new))


def _is_same(one: Any, other: Any) -> bool:
    return type(one) is type(other) and bool(one == other) and not (isinstance(one, dict) and [*one] != [*other])


def changed(value: Any, path: Path_) -> Iterator[tuple[str, Any]]:
    """Other values in place of one, with a name each."""
    if isinstance(value, list):
        yield from _changed_list(value)
    elif isinstance(value, dict):
        yield from _changed_object(value)
    elif value is None:
        yield from (("0 for null", 0), ("text for null", "x"), ("list for null", []), ("false for null", False))
        yield from (("another word", word) for word in WORDS.get(str(path[-1]), ()))
    elif isinstance(value, bool):
        yield from (("negated", not value), ("number for a truth value", int(value)), ("null", None))
    elif isinstance(value, int):
        yield from _changed_integer(value)
    else:
        yield from _changed_text(value, str(path[-1]))


def _changed_integer(value: int) -> Iterator[tuple[str, Any]]:
    yield from (("one more", value + 1), ("one less", value - 1), ("other sign", -value), ("0", 0))
    yield from (("float", float(value)), ("text", str(value)), ("truth value", bool(value)), ("null", None))
    yield "last digit", value // 10 * 10 + (value + 5) % 10


def _changed_text(value: str, key: str) -> Iterator[tuple[str, Any]]:
    yield from (("null", None), ("empty text", ""), ("list", [value]))
    if re.fullmatch(r"-?0x[0-9a-f]+", value):
        number = int(value, 16)
        yield from (("one more", hex(number + 1)), ("one less", hex(number - 1)), ("other sign", hex(-number)))
        yield from (("0", "0x0"), ("last digit", value[:-1] + hex(15 - int(value[-1], 16))[2:]))
        yield from (("decimal", str(number)), ("leading zero", value.replace("0x", "0x0")), ("plus", "+" + value))
        yield from (("float", f"{value}.0"), ("capitals", value.upper()))
        yield "no text", max(min(number, 10**9), -(10**9))
    elif re.fullmatch(r"-?[0-9]+(/[0-9]+)?", value):
        number = Fraction(value)
        yield from (("one more", str(number + 1)), ("one less", str(number - 1)), ("other sign", str(-number)))
        yield from (("0", "0"), ("last digit", value[:-1] + str(9 - int(value[-1]))), ("float", f"{float(number)!r}"))
        yield from (("leading zero", re.sub("([0-9])", "0\\1", value, count=1)), ("plus", "+" + value.lstrip("-")))
        yield from (("unreduced", f"{2 * number.numerator}/{2 * number.denominator}"), ("no text", float(number)))
    elif re.fullmatch(r"[0-9]+( [0-9]+)+", value):
        index, *factors = value.split(" ")
        yield from (
            ("one more", " ".join([str(int(index) + 1), *factors])),
            ("shorter", " ".join([index, *factors[1:]])),
        )
        yield from (("longer", f"{value} {factors[-1]}"), ("two spaces", value.replace(" ", "  ", 1)))
    else:
        yield from (("misspelled", value + "x"), ("shorter", value[:-1]), ("capitals", value.swapcase()))
        yield from (("another word", word) for word in WORDS.get(key, ()))


def _changed_list(value: list[Any]) -> Iterator[tuple[str, Any]]:
    yield from (("empty", []), ("null", None), ("null added", [*value, None]))
    if value:
        yield from (("first dropped", value[1:]), ("last dropped", value[:-1]))
        yield from (("first twice", [value[0], *value]), ("last twice", [*value, value[-1]]))
        yield "first instead of last", [*value[:-1], value[0]]
    for i, (one, other) in enumerate(pairwise(value)):
        if one != other:
            yield "two swapped", [*value[:i], other, one, *value[i + 2 :]]
            break
    if len(value) > 2:
        yield "first and last swapped", [value[-1], *value[1:-1], value[0]]


def _changed_object(value: Content) -> Iterator[tuple[str, Any]]:
    yield from (("unknown key", {**value, "extra": None}), ("other order", {key: value[key] for key in [*value][::-1]}))
    yield from (("null", None), ("list", [*value.values()]))
    for key in value:
        yield f"without {key}", {other: value[other] for other in value if other != key}
        yield f"{key} renamed", {other + "_" * (other == key): value[other] for other in value}


# What becomes of them


@dataclass(frozen=True)
class Report:
    """What became of the changes of a certificate: numbers by outcome, and those that were not refused as they must."""

    name: str
    entries: int
    outcomes: Counter[str]
    survivors: tuple[str, ...]
    seconds: float

    def __str__(self) -> str:
        counts = [self.outcomes[key] for key in ("digest", "rejected", "malformed", "free")]
        cells = (f"{count:>9}" for count in (self.entries, *counts, len(self.survivors)))
        return f"{self.name:<38}{''.join(cells)}{self.seconds:>8.1f}"


SLOW = 20
"""A slow test makes this part of the changes of a complete run."""
HEADING = (
    f"{'certificate':<38}{'entries':>9}{'digest':>9}{'rejected':>9}{'malformed':>9}{'free':>9}{'survive':>9}{'s':>8}"
)


def _answer(verdict: Any) -> tuple[str, str]:
    return str(verdict.status), verdict.lines[-1].partition(":")[0].partition("[")[0]


def outcome(name: str, mutation: Mutation) -> str:
    """What both checkers say of a change that has a digest made to fit; "survives: .." if it should not be so."""
    whole = isinstance(mutation.content, dict)
    data = canonical_bytes(sealed(mutation.content) if whole else mutation.content)
    one, other = check_bytes(data), pure.check_bytes(data)
    if one.status == other.status == "too-large" and _is_free(name, mutation.path):
        return "free"  # another question, and nothing is answered
    if _answer(one) != _answer(other) and _is_free(name, mutation.path) and _is_within_rounding(mutation, one, other):
        return "free"
    if _answer(one) != _answer(other):
        return f"survives: {one.lines[-1]} ({one.status}), but {other.lines[-1]} ({other.status})"
    if one.status in ("rejected", "malformed") and ":" in one.lines[-1]:
        return str(one.status)
    if one.status == "accepted" and one.lines == other.lines and _is_free(name, mutation.path):
        return "free"
    return f"survives: {one.status}"


def _is_within_rounding(mutation: Mutation, *verdicts: Any) -> bool:
    """Whether a last digit is proved by one checker alone: narrower enclosures prove more, all of it true.

    They may also stop at bounds of different poses.
    """
    if mutation.what != "last digit" or any(str(one.status) not in ("accepted", "rejected") for one in verdicts):
        return False
    refusals = [verdict.lines[-1] for verdict in verdicts if str(verdict.status) == "rejected"]
    return all(line.endswith("a bound of the pose is not proved") for line in refusals)


def _is_free(name: str, path: Path_) -> bool:
    names = {name, name.replace("-open", "")}
    return any(free.includes(kind, path) for free in (*FREE, *FREE_2, *FREE_MOBILITY, *FREE_PLATFORM) for kind in names)


def is_given_away(content: Content, mutation: Mutation) -> bool:
    """Whether both checkers refuse a change of the file itself, with the digest as it was."""
    if not isinstance(mutation.content, dict):
        return True  # the digest goes with the object
    data = canonical_bytes({**mutation.content, "digest": content["digest"]})
    statuses = {str(check_bytes(data).status), pure.check_bytes(data).status}
    return len(statuses) == 1 and statuses <= {"rejected", "malformed"}


def quick_names() -> list[str]:
    """The certificates of a quick run."""
    return [name for name, entry in SUBJECTS.items() if entry.quick]


def sampled(every: list[Mutation], most: int, seed: str) -> list[Mutation]:
    """As many of them, always the same ones: of each change of each part of the certificate one, then another, .."""
    seen: Counter[tuple[str, Any]] = Counter()
    ranked = []
    for mutation in Random(seed).sample(every, len(every)):
        group = mutation.what, (mutation.path or ("",))[0]
        ranked.append((seen[group], mutation))
        seen[group] += 1
    return [mutation for _, mutation in sorted(ranked, key=lambda pair: pair[0])[:most]]


def number(name: str, run: str, every: int) -> int:
    """How many changes of a certificate, of all that there are, a run makes: "quick", "slow" or "complete"."""
    entry = SUBJECTS[name]
    complete = every if entry.complete is None else min(entry.complete, every)
    return {"quick": entry.quick, "slow": max(entry.quick, complete // SLOW), "complete": complete}[run]


def report(name: str, run: str = "quick") -> Report:
    """The outcomes for a certificate: of all changes, or of a sample that is always the same."""
    start = time.perf_counter()
    content = subject(name)
    content = sealed(content)
    every = list(mutations(content))
    chosen = sampled(every, number(name, run, len(every)), name)
    found: Counter[str] = Counter()
    survivors = []
    for mutation in chosen:
        label = ".".join(map(str, mutation.path))
        if is_given_away(content, mutation):
            found["digest"] += 1
        else:
            survivors.append(f"{label}: {mutation.what}: not given away by the digest")
        result = outcome(name, mutation)
        if result.startswith("survives"):
            survivors.append(f"{label}: {mutation.what}: {result}")
        else:
            found[result] += 1
    entries = sum(1 for _ in nodes(content))
    return Report(name, entries, found, tuple(survivors), time.perf_counter() - start)


def main(words: list[str]) -> int:
    """Print the table; 1 if a change survives."""
    run = "complete" if words == ["--complete"] else "quick"
    print(HEADING)
    found = []
    for name in quick_names() if run == "quick" else SUBJECTS:
        found.append(report(name, run))
        print(found[-1], flush=True)
        for survivor in found[-1].survivors[:20]:
            print(f"  {survivor}")
    survivors = sum(len(entry.survivors) for entry in found)
    total = sum((entry.outcomes for entry in found), Counter())
    print(
        f"{len(found)} certificates, {total['digest']} changes refused by the digest; with a new digest {dict(total)}"
    )
    print(f"{survivors} survive")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Wrong versions of the checkers are made as they should, and found out by certificates that show the difference."""

import ast
import os
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from random import Random
from signal import SIGTERM
from zipfile import ZipFile

import checker_mutants
import checker_mutations
import pytest
from certificate_subjects import subject
from certificate_tools import golden_bytes
from checker_mutants import equivalents
from checker_mutations import CERTIFY, SOURCES, Mutant, mutants
from forgeries import on_circle
from limit_cases import cases
from mutant_hints import read_hints, short, told_by_hints, write_hints
from mutant_runs import Example, Reach, check, examples_in, lines_of, measured, outcome

from pkm_exact.certify.build import canonical_bytes, sealed

SAMPLE = '''
LIMIT = 7
NAME = re.compile(r"[a-f]{0,8}x[0-9]")

def check(values, limit=3):
    """Docs 5."""
    for value in values:
        if value < limit and not value == 4:
            raise rejected(f"{value}: above {limit + 1}")
    require(all(v > 0 for v in values if v), f"{1}")
    record(values)
    return any(values) or values[0] is None
'''

CHANGES = {
    "": [
        "LIMIT = 8",
        "LIMIT = 6",
        "NAME = re.compile('[a-f]{1,8}x[0-9]')",
        "NAME = re.compile('[a-f]{0,9}x[0-9]')",
        "NAME = re.compile('[a-f]{0,7}x[0-9]')",
        "NAME = re.compile('[a-f]{0,8}x[1-9]')",
        "NAME = re.compile('[a-f]{0,8}x[0-8]')",
    ],
    "for value in values:": ["for value in [*values][1:]:", "for value in [*values][:-1]:"],
    "value < limit and (not value == 4)": [
        "not (value < limit and (not value == 4))",
        "False",
        "not value == 4",
        "value < limit",
    ],
    "value < limit": ["value <= limit", "value >= limit"],
    "value == 4": ["value != 4", "value <= 4", "value >= 4", "value == 5", "value == 3"],
    "require(all((v > 0 for v in values if v)), f'{1}')": ["pass"],
    "all((v > 0 for v in values if v))": [
        "not all((v > 0 for v in values if v))",
        "any((v > 0 for v in values if v))",
        "all((v > 0 for v in [*values][1:] if v))",
        "all((v > 0 for v in [*values][:-1] if v))",
    ],
    "v > 0": ["v >= 0", "v <= 0", "v > 1", "v > -1"],
    "record(values)": ["pass"],
    "any(values) or values[0] is None": [
        "not (any(values) or values[0] is None)",
        "values[0] is None",
        "any(values)",
    ],
    "any(values)": ["all(values)"],
    "values[0] is None": ["values[0] is not None"],
}


def test_what_is_changed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "sample.py"
    path.write_text(SAMPLE)
    for name in ("CERTIFY", "PACKAGE"):
        monkeypatch.setattr(checker_mutations, name, tmp_path)
    found = list(checker_mutations._of_file("sample", path))
    whole = ast.dump(ast.parse(SAMPLE))
    for was, becomes in CHANGES.items():
        expected = [m.becomes for m in found if (m.was == was if was else not m.function)]
        assert sorted(expected) == sorted(becomes), was
    assert [m.becomes for m in found if m.function and m.was not in CHANGES] == ["for v in values if True"]
    assert all(m.code() for m in found)
    assert whole == ast.dump(ast.parse(SAMPLE))


def test_every_file_of_both_checkers_is_changed() -> None:
    assert [path.name for path in SOURCES["plain"]] == sorted(p.name for p in CERTIFY.glob("pure*.py"))
    changed = {mutant.path for checker in SOURCES for mutant in mutants(checker)}
    without = {"__init__.py"}
    assert changed == {path for files in SOURCES.values() for path in files if path.name not in without}


@pytest.mark.parametrize("checker", SOURCES)
def test_equal_descriptions_get_a_number(checker: str) -> None:
    every = mutants(checker)
    assert len({mutant.key for mutant in every}) == len(every)
    assert {mutant.key[2] == mutant.becomes for mutant in every if mutant.number == 1} == {True}
    assert {mutant.key[2].endswith(f" #{mutant.number}") for mutant in every if mutant.number > 1} == {True}


def test_what_is_listed_as_equivalent_exists() -> None:
    assert equivalents([mutant for checker in SOURCES for mutant in mutants(checker)])[1] == []


@pytest.fixture(scope="module")
def reaches(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Reach]:
    """Of few certificates, for both checkers."""
    planar = subject("planar, boxes")
    contents = [planar, {**planar, "real_poses": 5}, subject("nothing known")]
    content = [golden_bytes("3-rpr-triple"), *(canonical_bytes(sealed(content)) for content in contents), b"[]"]
    path = tmp_path_factory.mktemp("examples") / "corpus.zip"
    with ZipFile(path, "w") as archive:
        for number, data in enumerate(content):
            archive.writestr(f"{sha256(data).hexdigest()[:16]} test_{number}", data)
    return {checker: measured(checker, examples_in(path), lines_of(mutants(checker))) for checker in SOURCES}


def _named(checker: str, function: str, was: str, becomes: str) -> Mutant:
    return next(m for m in mutants(checker) if m.key[0].endswith(function) and m.key[1:] == (was, becomes))


KILLED = [
    ("first", "spelling.py count", "number < 0", "number <= 0", "accepted became malformed"),
    ("first", "study_motion.py", "PLANAR_LEGS = 3", "PLANAR_LEGS = 4", "accepted became"),
    (
        "first",
        "claims.py check_claims",
        "document.real_poses != len(document.poses)",
        "False",
        "rejected became accepted",
    ),
    ("plain", "pure.py a_number", "number >= 0", "number > 0", "accepted became malformed"),
    ("plain", "pure.py", "PLANAR_NUMBER: Final = 6", "PLANAR_NUMBER: Final = 5", "accepted became rejected"),
]


@pytest.mark.parametrize(("checker", "function", "was", "becomes", "how"), KILLED)
def test_a_difference_is_found(
    checker: str, function: str, was: str, becomes: str, how: str, reaches: dict[str, Reach]
) -> None:
    found = outcome(_named(checker, function, was, becomes), reaches[checker])
    assert not found.survives
    assert found.how.startswith(how)
    assert found.killer is not None
    again = outcome(_named(checker, function, was, becomes), reaches[checker], [found.killer])
    assert again == found


def test_what_changes_no_verdict_survives(reaches: dict[str, Reach]) -> None:
    mutant = _named("plain", "pure.py", "MAX_PRODUCTS: Final = 5000", "MAX_PRODUCTS: Final = 5001")
    assert outcome(mutant, reaches["plain"]).survives
    unreached = next(m for m in mutants("first") if m.function == "read_tolerances")
    assert outcome(unreached, reaches["first"]).survives


# Hints


def _examples(reaches: dict[str, Reach], checker: str = "first") -> list[Example]:
    """Certificates of which nothing is known yet."""
    return [Example(example.name, example.archive) for example in reaches[checker].examples]


COUNT = KILLED[0][:4]


def test_a_hint_is_run_and_found_by_digest_or_test(reaches: dict[str, Reach]) -> None:
    mutant = _named(*COUNT)
    killer = outcome(mutant, reaches["first"]).killer
    assert killer is not None
    digest, _, test = killer.partition(" ")
    for hint in (killer, f"{digest} another test", f"0123456789abcdef {test}"):
        ((told, found),) = told_by_hints([mutant], _examples(reaches), {mutant.key: hint})
        assert (told, found.killer, found.how) == (mutant, killer, "accepted became malformed")


def test_what_told_another_of_the_same_function_is_asked(reaches: dict[str, Reach]) -> None:
    mutant = _named(*COUNT)
    other = next(m for m in mutants("first") if m.place == mutant.place and m.key != mutant.key)
    killer = outcome(mutant, reaches["first"]).killer
    assert killer is not None
    ((_, found),) = told_by_hints([mutant], _examples(reaches), {other.key: killer})
    assert found.killer == killer


@pytest.mark.parametrize("hint", ["wrong", "unknown", "none"])
def test_a_wrong_hint_leads_to_the_search_and_never_counts(
    hint: str, reaches: dict[str, Reach], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = next(example.name for example in reaches["first"].examples if example.data == b"[]")
    mutant = _named(*COUNT)
    unseen = next(m for m in mutants("first") if m.function == "read_tolerances")
    named = {"wrong": wrong, "unknown": "0123456789abcdef no such test"}
    hints = dict.fromkeys((mutant, unseen), named[hint]) if hint in named else {}
    monkeypatch.setattr(checker_mutants, "read_hints", lambda: {short(m): name for m, name in hints.items()})
    monkeypatch.setattr(checker_mutants, "_reach", lambda *_: reaches["first"])
    monkeypatch.setattr(checker_mutants, "equivalents", lambda _: ({}, []))
    monkeypatch.setattr(checker_mutants, "mutants", lambda _: [mutant, unseen])
    monkeypatch.setattr(checker_mutants, "BUILD", tmp_path)
    assert list(told_by_hints([mutant, unseen], _examples(reaches), {m.key: hints[m] for m in hints})) == []
    found = dict(checker_mutants.run("first", _examples(reaches), "", float("inf")))
    assert found[mutant].how == "accepted became malformed"
    assert found[mutant].killer not in (None, wrong)
    assert found[unseen].survives


def test_hints_are_kept(tmp_path: Path) -> None:
    hints = {f"{number:08x}": f"{number % 3:016x} test_x[a b]" for number in range(40)}
    path = tmp_path / "hints.txt"
    assert read_hints(path) == {}
    write_hints(hints, path)
    assert read_hints(path) == hints
    assert max(map(len, path.read_text().splitlines())) < 120


def test_an_endless_loop_is_found_out(reaches: dict[str, Reach], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mutant_runs.PATIENCE", (0.2, 1.0))
    mutant = next(m for m in mutants("plain") if m.function == "real_roots")
    monkeypatch.setattr(Mutant, "code", lambda _: compile(ENDLESS, "endless", "exec"))
    found = outcome(mutant, reaches["plain"])
    assert (found.how, found.survives) == ("takes too long", False)


def test_a_process_that_is_ended_from_outside_says_nothing(
    reaches: dict[str, Reach], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Mutant, "code", lambda _: os.kill(os.getpid(), SIGTERM))
    with pytest.raises(RuntimeError, match="SIGTERM"):
        outcome(_named(*COUNT), reaches["first"])


ENDLESS = "def real_roots(h0, finest=0):\n    while True:\n        pass"


# A sample of those that read certificates: the limits of the format are certificates enough for them

READERS = {
    "first": ("document.py", "spelling.py", "tolerance_document.py"),
    "plain": ("pure.py a_", "pure.py one_of", "pure.py parsed", "pure.py read", "pure.py some_bounds"),
}
SAMPLE_SIZE = 5


def readers(checker: str) -> list[Mutant]:
    """The mutants of functions that read certificates of version 1, but for those that no certificate shows."""
    listed, _ = equivalents(mutants(checker))
    names = READERS[checker]
    chosen = [m for m in mutants(checker) if (m.path.name in names or m.place.startswith(names)) and m.function]
    costly = ("mechanism", "MAX_BYTES")
    return [m for m in chosen if m.key not in listed and not any(word in str(m) for word in costly)]


@pytest.fixture(scope="module")
def limits(tmp_path_factory: pytest.TempPathFactory) -> Reach:
    """Certificates at the limits of the format, and whole ones of all kinds; their verdicts are tested elsewhere."""
    path = tmp_path_factory.mktemp("limits") / "corpus.zip"
    names = ("planar, representation", "planar, multiple solutions", "planar, boxes", "tolerance, planar, complete")
    whole = [*names, "tolerance-open, planar", "not proven complete", "moving beside isolated poses", "nothing known"]
    whole += ["unproved multiplicities", "tolerance, spatial, complete"]
    found = [(canonical_bytes(sealed(subject(name))), "accepted") for name in whole]
    found.append((canonical_bytes(sealed(on_circle([(Fraction(3), Fraction(4))], (0, 1, 0)))), "accepted"))
    found += [(data, "malformed") for data in (b"[]", b"{", b'{"digest": 5}', b'{"digest": "", "digest": ""}')]
    found += [(make(), status) for _, make, status in cases()]
    examples = []
    with ZipFile(path, "w") as archive:
        for number, (data, status) in enumerate(sorted(found, key=lambda case: len(case[0]))):
            archive.writestr(f"{number}", data)
            examples.append(Example(f"{number}", path, (status, None)))
    return Reach(examples, everywhere=True)


@pytest.mark.slow
@pytest.mark.parametrize("checker", READERS)
def test_a_sample_of_mutants_is_told_apart(checker: str, limits: Reach) -> None:
    check(checker)
    sample = Random(7).sample(readers(checker), SAMPLE_SIZE)
    assert [str(mutant) for mutant in sample if outcome(mutant, limits).survives] == []

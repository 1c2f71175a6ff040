"""Is any check of the checkers vacuous? Wrong versions of them, and whether a certificate of the tests shows each.

``make checker-mutants`` makes all of them (``checker_mutations``), tries each on the certificates that the tests check
(``checker_corpus``) until one gets another verdict, and prints those that survive. A mutant that no certificate can
tell from the checker is listed in ``equivalent_mutants*.toml``, with the reason. What was found is kept in
``build/checker-mutants``: an interrupted run goes on where it was, and a later one asks first the certificate that was
right before. So does the first run of all, with those of ``mutant_hints.txt``; ``--keep-hints`` writes that file.
"""

from __future__ import annotations

import argparse
import json
import pickle
import resource
import subprocess
import sys
import time
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from hashlib import sha256
from math import inf
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from checker_mutations import PACKAGE, SOURCES, Mutant, mutants
from mutant_hints import neighbours, read_hints, short, told_by_hints, write_hints
from mutant_runs import Example, Outcome, Reach, examples_in, lines_of, measured, outcomes

HERE = Path(__file__).parent
BUILD = PACKAGE / "build" / "checker-mutants"
EQUIVALENT = sorted(HERE.glob("equivalent_mutants*.toml"))

RUNNERS = ("checker_mutants.py", "mutant_hints.py", "mutant_probes.py", "mutant_runs.py")
"""What may change without another certificate."""

Key = tuple[str, str, str]


def equivalents(every: Sequence[Mutant]) -> tuple[dict[Key, str], list[str]]:
    """The mutants that need not be told from the checker, with the reasons; and entries of the list that are wrong.

    A group lists mutants, or places whose mutants all are of this kind, as a constant's or a function's may be.
    """
    found: dict[Key, str] = {}
    wrong = []
    known = {mutant.key for mutant in every}
    for group in (group for path in EQUIVALENT for group in tomllib.loads(path.read_text("utf-8"))["equivalent"]):
        keys = [tuple(entry) for entry in group.get("mutants", [])]
        wrong += [f"there is no mutant {key}" for key in keys if key not in known]
        for place in group.get("places", []):
            there = [key for key in known if place in (key[0], f"{key[0]}: {key[1].partition(':')[0]}")]
            wrong += [] if there else [f"there is no mutant at {place}"]
            keys += there
        wrong += [f"listed twice: {key}" for key in keys if key in found]
        found |= dict.fromkeys(keys, group["reason"])
    return found, wrong


# Certificates


def _fresh_corpus(again: bool) -> list[Example]:
    """The certificates, collected anew if a test or the solver changed since, or if asked for."""
    sources = [*HERE.glob("*.py"), *(PACKAGE / "pkm_exact").rglob("*.py")]
    files = sorted(path for path in sources if path.name not in RUNNERS)
    state = sha256(b"".join(path.read_bytes() for path in files)).hexdigest()
    path, note = BUILD / "corpus.zip", BUILD / "corpus.state"
    if again or not path.exists() or not note.exists() or note.read_text() != state:
        print("collecting the certificates that the tests check", flush=True)
        subprocess.run([sys.executable, str(HERE / "checker_corpus.py"), str(path)], check=True)
        note.write_text(state)
    return examples_in(path)


# What was found before


class Journal:
    """Outcomes, one a line; those of the same checker and the same certificates need not be found again."""

    def __init__(self, path: Path, checker: str, examples: Sequence[Example], most: float) -> None:
        self.path, self.most = path, most
        sources = b"".join(source.read_bytes() for source in SOURCES[checker])
        self.checker = sha256(sources).hexdigest()[:16]
        self.names = {name for zipped in path.parent.glob("*.zip") for name in ZipFile(zipped).namelist()}
        self.corpus = sha256("\n".join(sorted(example.name for example in examples)).encode()).hexdigest()[:16]
        self.known: dict[Key, dict[str, Any]] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                entry = json.loads(line)
                self.known[tuple(entry["mutant"])] = entry  # type: ignore[index]

    def outcome(self, mutant: Mutant) -> Outcome | None:
        """What is still true of a mutant."""
        entry = self.known.get(mutant.key)
        if entry is None or entry["checker"] != self.checker or entry["line"] != mutant.line:
            return None
        if entry["killer"] is None:
            known = Outcome(None, entry["how"])
            is_enough = entry["corpus"] == self.corpus and (self.most < inf or known.is_complete)
            return known if is_enough else None
        return Outcome(entry["killer"], entry["how"]) if entry["killer"] in self.names else None

    def hints(self, checker: str) -> dict[Key, str]:
        """The certificate that told each mutant from the checker when last asked, here or by the file of hints."""
        kept = read_hints()
        found = {mutant.key: kept[short(mutant)] for mutant in mutants(checker) if short(mutant) in kept}
        return found | {key: entry["killer"] for key, entry in self.known.items() if entry["killer"] is not None}

    def write(self, mutant: Mutant, outcome: Outcome) -> None:
        """Keep an outcome."""
        entry = {"mutant": mutant.key, "line": mutant.line, "killer": outcome.killer, "how": outcome.how}
        entry |= {"checker": self.checker, "corpus": self.corpus}
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(entry) + "\n")


# The run


def _reach(checker: str, examples: list[Example], journal: Journal, left: Sequence[Mutant]) -> Reach:
    """What reaches the lines of mutants, from the last run if nothing has changed and these were among its lines."""
    path = BUILD / f"{checker}-{journal.corpus}.reach"
    state, wanted = f"{journal.checker} {journal.corpus}", lines_of(left)
    if path.exists():
        known, lines, reach = pickle.loads(path.read_bytes())  # noqa: S301 - our own, in build
        if known == state and wanted <= lines:
            return reach  # type: ignore[no-any-return]
    reach = measured(checker, examples, wanted)
    BUILD.mkdir(parents=True, exist_ok=True)
    path.write_bytes(pickle.dumps((state, wanted, reach)))
    return reach


def _outcomes(
    checker: str, pending: list[Mutant], examples: list[Example], journal: Journal, most: float
) -> Iterator[tuple[Mutant, Outcome]]:
    """Of all mutants: of most from the certificate of a hint, of the others when they were searched for one."""
    hints = journal.hints(checker)
    told = set()
    for mutant, outcome in told_by_hints(pending, examples, hints):
        told.add(mutant.key)
        yield mutant, outcome
    left = [mutant for mutant in pending if mutant.key not in told]
    if left:
        print(f"{checker} checker: hints told {len(told)} mutants, {len(left)} are searched for", flush=True)
        yield from outcomes(left, _reach(checker, examples, journal, left), most, neighbours(hints))


def run(checker: str, examples: list[Example], only: str, most: float) -> list[tuple[Mutant, Outcome]]:
    """What became of the mutants of a checker that are not listed as equivalent."""
    every = [mutant for mutant in mutants(checker) if only in str(mutant)]
    listed, _ = equivalents(mutants(checker))
    chosen = [mutant for mutant in every if mutant.key not in listed]
    journal = Journal(BUILD / f"{checker}.jsonl", checker, examples, most)
    found = [(mutant, outcome) for mutant in chosen if (outcome := journal.outcome(mutant)) is not None]
    pending = [mutant for mutant in chosen if journal.outcome(mutant) is None]
    start = time.monotonic()
    for number, (mutant, outcome) in enumerate(_outcomes(checker, pending, examples, journal, most), 1):
        journal.write(mutant, outcome)
        found.append((mutant, outcome))
        if outcome.survives:
            print(f"survives: {mutant}  ({outcome.how})", flush=True)
        if number % 200 == 0 and sys.stderr.isatty():
            print(f"{checker}: {number} of {len(pending)}, {time.monotonic() - start:.0f} s", file=sys.stderr)
    counts = Counter(outcome.how for _, outcome in found if not outcome.survives)
    print(f"{checker} checker, killed: " + ", ".join(f"{how} {n}" for how, n in counts.most_common()))
    print(
        f"{checker} checker: {len(every)} mutants; {counts.total()} killed, {len(every) - len(chosen)} listed as "
        f"equivalent, {len(found) - counts.total()} survive",
        flush=True,
    )
    return found


def keep_hints(found: Sequence[tuple[Mutant, Outcome]]) -> None:
    """Write which certificates told mutants from the checkers; what was known of others that there are stays."""
    there = {short(mutant) for checker in SOURCES for mutant in mutants(checker)}
    known = {mutant: name for mutant, name in read_hints().items() if mutant in there}
    write_hints(known | {short(mutant): outcome.killer for mutant, outcome in found if outcome.killer is not None})


def main(words: Sequence[str]) -> int:
    """Exit code 1 if a mutant survives or the list of equivalent ones is not up to date."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--checker", choices=[*SOURCES], action="append", help="one of the checkers (default: both)")
    parser.add_argument("--only", default="", metavar="TEXT", help="mutants whose description has this text")
    parser.add_argument("--collect", action="store_true", help="run the tests again for their certificates")
    parser.add_argument("--corpus", metavar="ZIP", help="these certificates, as checker_corpus.py wrote them, not all")
    parser.add_argument("--seconds", type=float, default=inf, help="of certificates to try on a mutant (default: all)")
    parser.add_argument("--keep-hints", action="store_true", help="write the certificates that were right to a file")
    options = parser.parse_args(words)
    listed, wrong = equivalents([mutant for checker in SOURCES for mutant in mutants(checker)])
    for line in wrong:
        print(f"equivalent mutants: {line}")
    examples = examples_in(Path(options.corpus)) if options.corpus else _fresh_corpus(options.collect)
    found = [
        entry
        for checker in options.checker or SOURCES
        for entry in run(checker, examples, options.only, options.seconds)
    ]
    if options.keep_hints:
        keep_hints(found)
    survivors = [(mutant, outcome) for mutant, outcome in found if outcome.survives]
    for mutant, outcome in survivors:
        print(f"{mutant}  ({outcome.how})")
    print(f"{len(survivors)} survive; {len(listed)} are listed as equivalent; {_minutes():.0f} min of processor time")
    return 1 if survivors or wrong else 0


def _minutes() -> float:
    """Of this process and those that it started."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(each.ru_utime + each.ru_stime for each in used) / 60


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

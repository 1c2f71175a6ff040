"""Which certificate told a mutant from the checker in an earlier run: asked first, and believed in nothing.

``mutant_hints.txt`` has a line for each such certificate, as the corpus names it, and below it a short digest of each
mutant. A hint only says where to begin: the mutant is run on that certificate, then on those that told others of the
same place. One that they do not tell from the checker is searched for like one without a hint.
"""

from __future__ import annotations

import time
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from pathlib import Path

from checker_mutations import Mutant
from mutant_probes import Key
from mutant_runs import Example, Outcome, Reach, check, forget, outcome, ready

FILE = Path(__file__).parent / "mutant_hints.txt"
IN_A_LINE = 12
"""Mutants named in a line."""
LIKELY = 12
"""So many certificates that told others of the same place, or file, are asked besides."""


def short(mutant: Mutant) -> str:
    """What stands for a mutant in the file: if two were alike, one would be tried in vain first."""
    return sha256("\t".join((mutant.checker, *mutant.key)).encode()).hexdigest()[:8]


def read_hints(path: Path = FILE) -> dict[str, str]:
    """For the digest of each mutant the certificate's name."""
    found: dict[str, str] = {}
    certificate = ""
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else ():
        if line.startswith(" "):
            found |= dict.fromkeys(line.split(), certificate)
        else:
            certificate = line
    return found


def write_hints(killers: dict[str, str], path: Path = FILE) -> None:
    """Keep the certificates' names by the digests of mutants."""
    by_name: dict[str, list[str]] = defaultdict(list)
    for mutant, name in sorted(killers.items()):
        by_name[name].append(mutant)
    lines = []
    for name, mutants in sorted(by_name.items()):
        lines.append(name)
        lines += [" " + " ".join(mutants[at : at + IN_A_LINE]) for at in range(0, len(mutants), IN_A_LINE)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


class Named:
    """Certificates by the names that hints give them."""

    def __init__(self, examples: Sequence[Example]) -> None:
        self.by_digest = {_digest(example.name): example for example in examples}
        self.by_test: dict[str, list[Example]] = defaultdict(list)
        for example in examples:
            self.by_test[_test(example.name)].append(example)

    def called(self, name: str) -> list[Example]:
        """The certificate of this digest; if there is none any longer, some of the same test."""
        exact = self.by_digest.get(_digest(name))
        return self.by_test.get(_test(name), [])[:LIKELY] if exact is None else [exact]


def _digest(name: str) -> str:
    return name.partition(" ")[0]


def _test(name: str) -> str:
    return name.partition(" ")[2]


def told_by_hints(
    chosen: Sequence[Mutant], examples: Sequence[Example], hints: Mapping[Key, str]
) -> Iterator[tuple[Mutant, Outcome]]:
    """Those mutants of a checker that a hint tells from it, each run on what it names; the others are left out.

    Its own hint comes first, then those of most mutants of the same function or constant, and of the same file. Only
    these certificates are checked with the right checker, once each.
    """
    named, near = Named(examples), neighbours(hints)
    known: set[str] = set()
    for checker in {mutant.checker for mutant in chosen}:
        ready(checker)
    for mutant in chosen:
        own = [hints[mutant.key]] if mutant.key in hints else []
        names = dict.fromkeys([*own, *near.get(mutant.place, ()), *near.get(mutant.path.name, ())])
        there = {example.name: example for name in names for example in named.called(name)}
        for example in (there[name] for name in there.keys() - known):
            _answer(mutant.checker, example)
        known |= there.keys()
        found = outcome(mutant, Reach([*there.values()], everywhere=True)) if there else None
        if found is not None and not found.survives:
            yield mutant, found


def neighbours(hints: Mapping[Key, str]) -> dict[str, list[str]]:
    """For each place, and each file by its name, the certificates that tell most mutants there."""
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for (place, *_), name in hints.items():
        for where in (place, place.partition(" ")[0].rpartition("/")[2]):
            counts[where][name] += 1
    return {where: [name for name, _ in found.most_common(LIKELY)] for where, found in counts.items()}


def _answer(checker: str, example: Example) -> None:
    """What the right checker says, and how long it takes."""
    answer, data = check(checker), example.data
    start = time.process_time()
    example.answer = answer(data)
    example.cost = time.process_time() - start
    forget(checker)

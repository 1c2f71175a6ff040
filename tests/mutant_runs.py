"""Runs a checker in which something was changed, in a process of its own, on certificates whose verdict is known."""

from __future__ import annotations

import gc
import importlib
import os
import re
import resource
import signal
import sys
import time
from array import array
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cache, partial
from importlib.machinery import ModuleSpec
from itertools import accumulate
from math import inf
from mmap import ACCESS_READ, mmap
from pathlib import Path
from tempfile import TemporaryFile
from types import CodeType, FrameType, FunctionType, MappingProxyType, ModuleType
from typing import Any
from zipfile import ZipFile

from checker_mutations import PACKAGE, SOURCES, Mutant, uses
from mutant_probes import Key, differing

ROOTS = {"first": "pkm_exact.certify.check", "plain": "pkm_exact.certify.pure"}
LIMITS = {
    "first": ("pkm_exact.certify.checker.budget", "BASE"),
    "plain": ("pkm_exact.certify.pure", "WORK_OF_ANY_FILE"),
}
"""Where each says how much work any file may cost."""
MEMORY = 2 << 30
"""A mutant may take so many bytes more than the checker."""
STATISTICS = Path("/proc/self/statm")
"""Where Linux tells how much that is."""
PATIENCE = 0.4, 6.0
"""A mutant may take so many seconds of processor time, and so many times that of the checker, with a certificate."""
FROM_OUTSIDE = frozenset((signal.SIGHUP, signal.SIGINT, signal.SIGKILL, signal.SIGTERM))
"""Signals that are no fault of a mutant's."""

HINTS = 5
"""So many certificates that told other mutants from the checker are tried first."""
FIRST_LOOK = 1.0
"""Seconds of the checker's work: where so many certificates show nothing it is asked on which ones a mutant differs."""

OFTEN = 500
"""Calls of a function that are traced for each certificate."""

Answer = tuple[str, tuple[str, ...] | None]
Line = tuple[str, int]
Places = dict[Line, "array[int]"]


@dataclass
class Example:
    """A certificate in a ZIP file, what the checker says of it, and the processor time that this takes.

    What is said of an accepted one may be None: then the status alone is compared.
    """

    name: str
    archive: Path
    answer: Answer = ("", ())
    cost: float = 0.0

    @property
    def data(self) -> bytes:
        """The certificate."""
        unpacked, places = _unpacked(self.archive)
        return unpacked[places[self.name]]


@cache
def _unpacked(path: Path) -> tuple[mmap, dict[str, slice]]:
    """What is in a ZIP file, in a file without a name, and where: a fork need not copy the memory it takes."""
    places, start = {}, 0
    with ZipFile(path) as archive, TemporaryFile(dir=path.parent) as stream:
        for name in archive.namelist():
            end = start + stream.write(archive.read(name))
            places[name], start = slice(start, end), end
        stream.flush()
        return mmap(stream.fileno(), 0, access=ACCESS_READ), places


def examples_in(path: Path) -> list[Example]:
    """The certificates in a ZIP file that ``checker_corpus`` wrote."""
    with ZipFile(path) as archive:
        return [Example(name, path) for name in archive.namelist()]


def check(checker: str) -> Callable[[bytes], Answer]:
    """The checker as it is now: the status, and what is proved of an accepted certificate."""
    root = importlib.import_module(ROOTS[checker])

    def answer(data: bytes) -> Answer:
        verdict = root.check_bytes(data)
        status = str(verdict.status)
        return status, verdict.lines if status == "accepted" else ()

    return answer


# What reaches what


@dataclass
class Reach:
    """Examples in the order in which they are tried, and which of them reach a line of a file, or that all do.

    ``differ`` has, for mutants of an expression, those on which it has another value at all.
    """

    examples: list[Example]
    by_line: Places = field(default_factory=dict)
    refused: Places = field(default_factory=dict)
    everywhere: bool = False
    differ: dict[Key, array[int]] = field(default_factory=dict)

    def of(self, mutant: Mutant) -> list[int]:
        """The examples that reach a mutant, or what uses a constant; the likely ones first.

        Those are what is refused there, which a check that is dropped no longer refuses, and what is accepted.
        """
        if self.everywhere:
            return list(range(len(self.examples)))
        lines, guarded = _lines_of(mutant)
        found = {number for line in lines for number in self.by_line.get(line, ())}
        found &= set(self.differ.get(mutant.key, found))
        there = sorted(found & {number for line in guarded for number in self.refused.get(line, ())})
        accepted = [number for number in sorted(found) if self.examples[number].answer[0] == "accepted"]
        return list(dict.fromkeys([*there[:4], *accepted[:6], *there, *accepted, *sorted(found)]))


def _lines_of(mutant: Mutant) -> tuple[set[Line], set[Line]]:
    """Where a mutant is, or where a constant is used; and what a check there guards."""
    if mutant.function:
        lines, guarded = ({(str(mutant.path), line) for line in lines} for lines in (mutant.lines, mutant.guarded))
        return lines, guarded
    names = re.findall(r"\w+", re.split("[:=]", mutant.was)[0])
    used = {line for name in names for line in uses(mutant.checker, name)}
    return used, used


def lines_of(chosen: Sequence[Mutant]) -> frozenset[Line]:
    """Where mutants are, or where constants are used."""
    return frozenset(line for mutant in chosen for lines in _lines_of(mutant) for line in lines)


def measured(checker: str, examples: Sequence[Example], wanted: Set[Line]) -> Reach:
    """Check all examples, note the answers and the time, and then again, note which of the lines are reached.

    Cheap ones are tried first, but of those that reach the same lines with the same answer only three at a time.
    """
    answer = check(checker)
    traces = []
    for example in examples:
        data = example.data
        start = time.process_time()
        example.answer = answer(data)
        example.cost = time.process_time() - start
        forget(checker)
        traces.append(_traced(partial(answer, data), wanted))
    seen: Counter[Any] = Counter()
    ranks = [0] * len(examples)
    for number in sorted(range(len(examples)), key=lambda number: examples[number].cost):
        sort = examples[number].answer[0], frozenset(traces[number][0])
        ranks[number] = seen[sort] // 3
        seen[sort] += 1
    order = sorted(range(len(examples)), key=lambda number: (ranks[number], examples[number].cost))
    places: tuple[Places, Places] = (defaultdict(_numbers), defaultdict(_numbers))
    for place, number in enumerate(order):
        for kept, lines in zip(places, traces[number], strict=True):
            for line in lines:
                kept[line].append(place)
    return Reach([examples[number] for number in order], *map(dict, places))


def _unlimited(checker: str) -> None:
    """Allow any work: what is computed twice costs twice as much."""
    module, name = LIMITS[checker]
    setattr(importlib.import_module(module), name, 1 << 60)


def forget(checker: str) -> None:
    """Clear what is remembered from certificate to certificate: each one must reach what it needs."""
    for name in _module_names(checker):
        for value in vars(importlib.import_module(name)).values():
            if hasattr(value, "cache_clear"):
                value.cache_clear()


def _module_names(checker: str) -> list[str]:
    return [".".join(path.relative_to(PACKAGE).with_suffix("").parts) for path in SOURCES[checker]]


def _numbers() -> array[int]:
    return array("H")


def _traced(call: Callable[[], Any], wanted: Set[Line]) -> tuple[set[Line], set[Line]]:
    """Which lines are reached, and those from which a refusal comes, through one function after another.

    A function whose lines are all reached is not traced any longer, nor one that is called very often. Of functions
    without such a line it is noted that they are called.
    """
    files = {name for name, _ in wanted}
    left: dict[CodeType, set[int]] = {}
    calls: Counter[CodeType] = Counter()
    reached: set[Line] = set()
    refused: set[Line] = set()

    def local(frame: FrameType, event: str, what: Any) -> Any:
        place = frame.f_code.co_filename, frame.f_lineno
        if event == "line":
            reached.add(place)
            left[frame.f_code].discard(frame.f_lineno)
        elif event == "exception" and what[0].__name__ == "Refusal":
            refused.add(place)
        return local

    def enter(frame: FrameType, _event: str, _: Any) -> Any:
        code = frame.f_code
        if code.co_filename not in files:
            return None
        if code not in left:
            left[code] = {line for _, _, line in code.co_lines() if (code.co_filename, line) in wanted}
            reached.add((code.co_filename, code.co_firstlineno))
        calls[code] += 1
        return local if left[code] and calls[code] <= OFTEN else None

    sys.settrace(enter)
    try:
        call()
    finally:
        sys.settrace(None)
    return reached, refused


# The change, in the process that is to be thrown away


def install(mutant: Mutant) -> None:
    """Put a mutant in place of the checker."""
    code = mutant.code()
    if mutant.function:
        _replace(mutant, code)
    else:
        _import_again(mutant, code)


def _replace(mutant: Mutant, code: CodeType) -> None:
    """Give the function its new code, wherever it is referred to."""
    owner, target = None, importlib.import_module(mutant.module)  # type: Any, Any
    for name in mutant.function.split("."):
        code = next(entry for entry in code.co_consts if isinstance(entry, CodeType) and entry.co_name == name)
        owner, target = target, vars(target)[name]
    if isinstance(target, FunctionType) and len(code.co_freevars) < len(target.__code__.co_freevars):
        # It speaks no longer of its class, as by super().
        setattr(owner, mutant.function.rpartition(".")[2], FunctionType(code, target.__globals__))
        return
    while not hasattr(target, "__code__"):
        if hasattr(target, "cache_clear"):
            target.cache_clear()
        target = next(
            getattr(target, name) for name in ("__wrapped__", "fget", "func", "__func__") if hasattr(target, name)
        )
    target.__code__ = code


def _import_again(mutant: Mutant, code: CodeType) -> None:
    """Import the checker anew, with a changed module: its constants stand in many others."""

    class Loader:
        def find_spec(self, name: str, *_: Any) -> ModuleSpec | None:
            return ModuleSpec(name, self) if name == mutant.module else None

        def create_module(self, _: ModuleSpec) -> None:
            return None

        def exec_module(self, module: ModuleType) -> None:
            exec(code, vars(module))  # noqa: S102 - a source file of the project

    names = _module_names(mutant.checker)
    for name in {*names, *(name.removesuffix(".__init__") for name in names)}:
        sys.modules.pop(name, None)
    sys.meta_path.insert(0, Loader())  # type: ignore[arg-type]


# Outcomes


@dataclass(frozen=True)
class Outcome:
    """What became of a mutant: the example that tells it from the checker and how, or how many were tried in vain."""

    killer: str | None
    how: str

    @property
    def survives(self) -> bool:
        """Whether no example tells it from the checker."""
        return self.killer is None

    @property
    def is_complete(self) -> bool:
        """Whether all examples that reach a mutant were tried in vain."""
        tried, _, there, *_ = self.how.split(" ")
        return self.survives and tried == there


def outcome(mutant: Mutant, reach: Reach, first: Sequence[str] = (), most: float = inf) -> Outcome:
    """Try the examples that reach a mutant, those named first before all, as many as take ``most`` seconds."""
    reaching = reach.of(mutant)
    chosen = _affordable(sorted(reaching, key=lambda number: reach.examples[number].name not in first), reach, most)
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        _try_all(mutant, [(number, reach.examples[number]) for number in chosen], writer)
    os.close(writer)
    with os.fdopen(reader) as stream:
        *_, last = [["-1", "", ""], *(line.rstrip("\n").split("\t") for line in stream)]
    _, status = os.waitpid(child, 0)
    number, how = int(last[0]), last[1]
    if how == "survives":
        return Outcome(None, f"{len(chosen)} of {len(reaching)} certificates")
    if not how:
        ended = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
        if ended in FROM_OUTSIDE:
            raise RuntimeError(f"{mutant}: its process was ended by {signal.Signals(ended).name}, which says nothing")
        how = "takes too long" if ended == signal.SIGPROF else "crashes"
    if number < 0:
        raise RuntimeError(f"{mutant}: {how} before a certificate is read")
    return Outcome(reach.examples[number].name, how)


def _affordable(chosen: Sequence[int], reach: Reach, most: float) -> list[int]:
    """As many as the checker checks in ``most`` seconds, three at least."""
    spent = accumulate(reach.examples[number].cost for number in chosen)
    return [number for place, (number, cost) in enumerate(zip(chosen, spent, strict=True)) if cost <= most or place < 3]


def _try_all(mutant: Mutant, chosen: Sequence[tuple[int, Example]], writer: int) -> None:
    """Tell which example is being tried, at last what came out; never returns."""
    how, number = "survives", -1
    try:
        gc.disable()
        if STATISTICS.exists():
            pages = int(STATISTICS.read_text().split()[0])
            resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + MEMORY,) * 2)
        signal.signal(signal.SIGPROF, signal.SIG_DFL)
        try:
            install(mutant)
            answer = check(mutant.checker)
        except Exception as error:
            if mutant.function:
                raise
            chosen, how, number = [], f"cannot be imported: {type(error).__name__}", chosen[0][0]
        for number, example in chosen:
            os.write(writer, f"{number}\t\n".encode())
            least, times = PATIENCE
            signal.setitimer(signal.ITIMER_PROF, least + times * example.cost)
            how = _difference(answer, example)
            if how != "survives":
                break
        os.write(writer, f"{number}\t{how}\n".encode())
    finally:
        os._exit(0)


def _difference(answer: Callable[[bytes], Answer], example: Example) -> str:
    try:
        found = answer(example.data)
    except BaseException as error:  # whatever is raised: a checker never raises
        return f"raises {type(error).__name__}"
    if found == example.answer or (found[0], None) == example.answer:
        return "survives"
    return f"{example.answer[0]} became {found[0]}" if found[0] != example.answer[0] else "says something else"


def ready(checker: str) -> None:
    """Import a checker once, in this process, and keep what is in memory out of the way of forks."""
    check(checker)
    gc.collect()
    gc.freeze()


def outcomes(
    chosen: Sequence[Mutant],
    reach: Reach,
    most: float = inf,
    likely: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> Iterator[tuple[Mutant, Outcome]]:
    """What becomes of mutants: of most after a first look, of the others when it is known where they differ at all.

    What told others of the same function, or of any, from the checker is tried first: ``likely`` has it by place.
    """
    for checker in {mutant.checker for mutant in chosen}:
        ready(checker)
    hints = defaultdict(list, {place: [*names] for place, names in likely.items()})
    left = []
    for mutant in chosen:
        names = mutant.place, ""
        found = outcome(mutant, reach, [name for place in names for name in hints[place]], min(most, FIRST_LOOK))
        if found.killer is None and not found.is_complete and most > FIRST_LOOK:
            left.append(mutant)
            continue
        if found.killer is not None:
            for place in names:
                hints[place] = [found.killer, *(name for name in hints[place] if name != found.killer)][:HINTS]
        yield mutant, found
    for checker in {mutant.checker for mutant in left}:
        there = [mutant for mutant in left if mutant.checker == checker]
        numbers = sorted({number for mutant in there for number in reach.of(mutant)})
        examples = [(number, reach.examples[number]) for number in numbers]
        reach.differ = differing(there, examples, check(checker), _replace, partial(_unlimited, checker))
        for mutant in there:
            yield mutant, outcome(mutant, reach, [], most)

"""On which certificates a changed expression has another value at all, found for all expressions in one go.

Every expression that mutants change is computed beside all its changes, while the checker goes on with the right
value. A mutant can show only on a certificate where its expression differed once: the others need not be tried. What is
changed otherwise (statements, loops, constants), and what is not computed twice without harm, is not looked at here.
"""

from __future__ import annotations

import ast
import builtins
import os
import pickle
import signal
import sys
from array import array
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from checker_mutations import Mutant

Key = tuple[str, str, str]
HARMFUL = frozenset(
    ("pop", "next", "append", "add", "remove", "update", "extend", "discard", "send", "narrow", "cell", "ball", "iter")
)
"""What is called by such a name changes something, or is used up."""
OFTEN = 300
"""An expression is computed so many times for each certificate."""
PATIENCE = 20.0, 20.0
"""Seconds of processor time, and times that of the checker, for a certificate."""


class Prober:
    """Compares values with what mutants have in their place."""

    def __init__(self) -> None:
        self.differ: set[int] = set()
        self.counts: Counter[int] = Counter()

    def begin(self) -> None:
        """Another certificate."""
        self.differ.clear()
        self.counts.clear()

    def __call__(self, value: Any, *changes: tuple[int, Callable[[], Any]]) -> Any:
        for number, change in changes:
            if number in self.differ or self.counts[number] >= OFTEN:
                continue
            self.counts[number] += 1
            try:
                other = change()
            except Exception:  # it is another value, whatever is raised
                self.differ.add(number)
                continue
            if other is not value and not _same(value, other):
                self.differ.add(number)
        return value


def _same(one: Any, other: Any) -> bool:
    """Whether values are surely the same; of types whose equality is another question nothing is said."""
    simple = (bool, int, str, bytes, tuple, list, type(None))
    return type(one) is type(other) and isinstance(one, simple) and bool(one == other)


def _is_harmless(node: ast.AST) -> bool:
    for child in ast.walk(node):
        if isinstance(child, ast.NamedExpr | ast.Yield | ast.YieldFrom | ast.Await | ast.Starred):
            return False
        if isinstance(child, ast.Call):
            called = child.func
            name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
            if name in HARMFUL:
                return False
    return True


def is_probed(mutant: Mutant) -> bool:
    """Whether an expression is changed that can be computed twice."""
    old = _old(mutant)
    is_expression = isinstance(old, ast.expr) and isinstance(mutant.new, ast.expr)
    return bool(mutant.function) and is_expression and _is_harmless(old) and _is_harmless(mutant.new)


def _old(mutant: Mutant) -> ast.AST:
    old = getattr(mutant.parent, mutant.field)
    return old if mutant.index is None else old[mutant.index]  # type: ignore[no-any-return]


def install(mutants: Sequence[Mutant], prober: Prober, replace: Callable[[Mutant, Any], None]) -> None:
    """Put the checker in place that compares; the syntax trees are changed for good."""
    vars(builtins)["__probe__"] = prober
    places: dict[tuple[int, str, int | None], list[int]] = defaultdict(list)
    for number, mutant in enumerate(mutants):
        if is_probed(mutant):
            places[id(mutant.parent), mutant.field, mutant.index].append(number)
    for numbers in places.values():
        first = mutants[numbers[0]]
        changes: list[ast.expr] = []
        for number in numbers:
            arguments = ast.arguments([], [], None, [], [], None, [])
            change = ast.Lambda(arguments, mutants[number].new)
            changes.append(ast.Tuple([ast.Constant(number), change], ast.Load()))
        call = ast.Call(ast.Name("__probe__", ast.Load()), [_old(first), *changes], [])  # type: ignore[list-item]
        call = ast.fix_missing_locations(ast.copy_location(call, _old(first)))
        if first.index is None:
            setattr(first.parent, first.field, call)
        else:
            getattr(first.parent, first.field)[first.index] = call
    done = set()
    for mutant in mutants:
        if is_probed_function(mutant) and (mutant.path, mutant.function) not in done:
            done.add((mutant.path, mutant.function))
            future = ast.parse("from __future__ import annotations").body[0]
            module = ast.fix_missing_locations(ast.Module([future, mutant.owner], []))
            replace(mutant, compile(module, str(mutant.path), "exec", dont_inherit=True))


def is_probed_function(mutant: Mutant) -> bool:
    """Whether it changes a function, no constant."""
    return bool(mutant.function)


def differing(
    mutants: Sequence[Mutant],
    examples: Sequence[tuple[int, Any]],
    check: Callable[[bytes], Any],
    replace: Callable[[Mutant, Any], None],
    unlimited: Callable[[], None],
) -> dict[Key, array[int]]:
    """For each mutant that is looked at, the numbers of the examples on which its expression differs."""
    probed = {number: mutant.key for number, mutant in enumerate(mutants) if is_probed(mutant)}
    found: dict[Key, array[int]] = {key: array("H") for key in probed.values()}
    for start in range(0, len(examples) if probed else 0, BATCH):
        batch = examples[start : start + BATCH]
        answers = _answers_of_a_child(partial(_probe_all, mutants, batch, check, replace, unlimited))
        for place, _ in batch:
            numbers = answers.get(place)
            for number in probed if numbers is None else numbers:
                found[probed[number]].append(place)
    return found


def _answers_of_a_child(work: Callable[[int], None]) -> dict[int, list[int] | None]:
    """What a process of its own writes about examples, until it ends."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        work(writer)
    os.close(writer)
    answers: dict[int, list[int] | None] = {}
    with os.fdopen(reader, "rb") as stream:
        while True:
            try:
                place, numbers = pickle.load(stream)  # noqa: S301 - our own child
            except (EOFError, pickle.UnpicklingError):
                break
            answers[place] = numbers
    os.waitpid(child, 0)
    return answers


BATCH = 1000
"""Certificates that one process looks at: what it does not answer is tried with all mutants."""


def _probe_all(
    mutants: Sequence[Mutant],
    examples: Sequence[tuple[int, Any]],
    check: Callable[[bytes], Any],
    replace: Callable[[Mutant, Any], None],
    unlimited: Callable[[], None],
    writer: int,
) -> None:
    """Tell what differs on each example; None if it could not be found. Never returns."""
    try:
        prober = Prober()
        unlimited()
        install(mutants, prober, replace)
        with os.fdopen(writer, "wb") as stream:
            for place, example in examples:
                prober.begin()
                pickle.dump((place, _differing_on(example, prober, check)), stream)
    except BaseException as error:
        print(f"probing failed: {error!r}", file=sys.stderr)
    finally:
        os._exit(0)


class _Late(BaseException):
    """It takes too long."""


def _late(*_: Any) -> None:
    raise _Late


def _differing_on(example: Any, prober: Prober, check: Callable[[bytes], Any]) -> list[int] | None:
    least, times = PATIENCE
    signal.signal(signal.SIGPROF, _late)
    signal.setitimer(signal.ITIMER_PROF, least + times * example.cost)
    try:
        answer = check(example.data)
    except BaseException:  # computing something twice did harm, or took too long
        return None
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    return sorted(prober.differ) if answer == example.answer else None

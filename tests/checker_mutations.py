"""Wrong versions of the checkers: every condition, comparison and bound negated, dropped or shifted by one.

A mutant is one change of the syntax tree of one source file. It is named by the function, the expression as it was and
as it becomes, not by a line, so that a list of mutants outlives other changes of the file.
"""

from __future__ import annotations

import ast
import copy
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

PACKAGE = Path(__file__).parent.parent
CERTIFY = PACKAGE / "pkm_exact" / "certify"
SOURCES = {
    "first": [CERTIFY / "check.py", *sorted((CERTIFY / "checker").glob("**/*.py"))],
    "plain": sorted(path for path in CERTIFY.glob("pure*/**/*.py")) + sorted(CERTIFY.glob("pure*.py")),
}
"""The files of both checkers; new ones join by themselves."""

REFUSERS = ("require", "well_formed", "affordable")
"""Functions that refuse a certificate unless their first argument holds; the second is the reason, in words."""
ESTIMATES = re.compile(r"charge\w*|spend\w*|\w*cost|limbs")
"""Functions that estimate how much work is about to be done, or are told it: ``test_checker_work`` is about them."""
COMMANDS = ("main", "check_file")
"""What reads files and prints: no certificate reaches it, the tests of command lines do."""

_ORDERED: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq, ast.LtE, ast.GtE),
    ast.NotEq: (ast.Eq, ast.Lt, ast.Gt),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
}
_SWAPPED = {"any": "all", "all": "any", "min": "max", "max": "min"}


@dataclass(frozen=True)
class Mutant:
    """One change: the entry ``index`` (None: all of it) of the field ``field`` of ``parent`` becomes ``new``.

    ``lines`` are those of the file that must be reached for it to show, ``guarded`` also what a condition guards.
    ``number`` counts those of one description: a function may ask the same twice.
    """

    checker: str
    path: Path
    function: str
    line: int
    lines: range
    guarded: range
    was: str
    becomes: str
    owner: ast.stmt
    parent: ast.AST
    field: str
    index: int | None
    new: ast.AST
    number: int = 1

    @property
    def module(self) -> str:
        """The name under which the file is imported."""
        return ".".join(self.path.relative_to(PACKAGE).with_suffix("").parts)

    @property
    def place(self) -> str:
        """File and function, as in lists of mutants."""
        return f"{self.path.relative_to(CERTIFY)} {self.function}".strip()

    @property
    def key(self) -> tuple[str, str, str]:
        """What names it: from the second on, those of equal description have their number behind it."""
        return self.place, self.was, self.becomes + (f" #{self.number}" if self.number > 1 else "")

    def __str__(self) -> str:
        return f"{self.path.relative_to(PACKAGE)}:{self.line}: {self.function}: {self.was}  ->  {self.key[2]}"

    def code(self) -> CodeType:
        """The changed definition, or module, compiled; the tree is as before when it returns."""
        old = getattr(self.parent, self.field)
        if self.index is None:
            setattr(self.parent, self.field, self.new)
        else:
            setattr(self.parent, self.field, [*old[: self.index], self.new, *old[self.index + 1 :]])
        body = self.owner.body if isinstance(self.owner, ast.Module) else [_future(), self.owner]
        try:
            return compile(ast.Module(body, []), str(self.path), "exec", dont_inherit=True)
        finally:
            setattr(self.parent, self.field, old)


def _future() -> ast.stmt:
    """Annotations are not evaluated in the checkers' modules."""
    return ast.parse("from __future__ import annotations").body[0]


@cache
def mutants(checker: str) -> tuple[Mutant, ...]:
    """All mutants of a checker, in the order of its source."""
    seen: Counter[tuple[str, str, str]] = Counter()
    found = []
    for mutant in (mutant for path in SOURCES[checker] for mutant in _of_file(checker, path)):
        seen[mutant.key] += 1
        found.append(replace(mutant, number=seen[mutant.key]))
    return tuple(found)


def _of_file(checker: str, path: Path) -> Iterator[Mutant]:
    module = ast.parse(path.read_text(encoding="utf-8"))
    for statement in module.body:
        if isinstance(statement, ast.FunctionDef | ast.ClassDef):
            for name, function in _functions(statement, ""):
                if name not in COMMANDS and not ESTIMATES.fullmatch(name.rpartition(".")[2]):
                    for site in _sites(function):
                        yield _mutant(checker, path, name, statement, site)
        elif isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
            for site in _constants(statement):
                yield _mutant(checker, path, "", module, site)  # type: ignore[arg-type]


def _functions(node: ast.stmt, prefix: str) -> Iterator[tuple[str, ast.FunctionDef]]:
    """The outermost functions, with their qualified names."""
    if isinstance(node, ast.FunctionDef):
        yield prefix + node.name, node
    elif isinstance(node, ast.ClassDef):
        for statement in node.body:
            yield from _functions(statement, f"{prefix}{node.name}.")


@dataclass(frozen=True)
class _Site:
    """Where something is changed: ``header`` is the statement, and ``shown`` what is printed of it."""

    parent: ast.AST
    field: str
    index: int | None
    old: ast.AST
    new: ast.AST
    header: ast.AST
    guarded: ast.AST
    shown: ast.AST


def _mutant(checker: str, path: Path, name: str, owner: ast.stmt, site: _Site) -> Mutant:
    new = ast.fix_missing_locations(ast.copy_location(site.new, site.old))
    line, last = site.header.lineno, site.header.end_lineno  # type: ignore[attr-defined]
    return Mutant(
        checker,
        path,
        name,
        site.old.lineno,  # type: ignore[attr-defined]
        range(line, last + 1),
        range(line, site.guarded.end_lineno + 1),  # type: ignore[attr-defined]
        _text(site.shown),
        _text(site.shown, site.old, new),
        owner,
        site.parent,
        site.field,
        site.index,
        new,
    )


def _text(node: ast.AST, old: ast.AST | None = None, new: ast.AST | None = None) -> str:
    """The source of a node, one node below it replaced; of a compound statement its first line."""

    class Replaced(ast.NodeTransformer):
        def visit(self, child: ast.AST) -> Any:
            return new if child is old else self.generic_visit(child)

    if old is not None:
        memo: dict[int, Any] = {id(old): old}
        node = Replaced().visit(copy.deepcopy(node, memo))
    written = ast.unparse(node).strip()
    return written.splitlines()[0] if isinstance(node, ast.stmt) else written


def uses(checker: str, name: str) -> set[tuple[str, int]]:
    """The lines of a checker that use a constant, or one made of it, and those that a condition with it guards."""
    names, waiting = {name}, [name]
    while waiting:
        used = waiting.pop()
        others = {other for path in SOURCES[checker] for other in _made_of(path).get(used, ())} - names
        names |= others
        waiting += others
    return {(str(path), line) for path in SOURCES[checker] for used in names for line in _lines_by_name(path)[used]}


@cache
def _made_of(path: Path) -> dict[str, set[str]]:
    """For each name the constants of a module that are computed from it."""
    found: dict[str, set[str]] = defaultdict(set)
    for statement in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
            targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]
            for node in ast.walk(statement.value):
                if isinstance(node, ast.Name):
                    found[node.id] |= {target.id for target in targets if isinstance(target, ast.Name)}
    return found


@cache
def _lines_by_name(path: Path) -> dict[str, set[int]]:
    found: dict[str, set[int]] = defaultdict(set)
    for statement in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(statement, ast.stmt) and not isinstance(statement, ast.FunctionDef | ast.ClassDef):
            last = statement.body[0] if isinstance(statement, ast.If | ast.For | ast.While) else statement
            for node in ast.walk(statement):
                if isinstance(node, ast.Name) and node.lineno <= (last.end_lineno or 0):
                    found[node.id].update(range(statement.lineno, (last.end_lineno or 0) + 1))
        elif isinstance(statement, ast.FunctionDef):
            for default in (*statement.args.defaults, *filter(None, statement.args.kw_defaults)):
                if isinstance(default, ast.Name):
                    found[default.id].update(range(statement.lineno, (statement.end_lineno or 0) + 1))
    return found


# Where


def _sites(function: ast.FunctionDef) -> Iterator[_Site]:
    """All changes of a function's body."""
    for statement in function.body:
        yield from _below(function, "body", None, statement, statement, None)


def _below(
    parent: ast.AST, field: str, index: int | None, node: ast.AST, header: ast.AST, bound: ast.AST | None
) -> Iterator[_Site]:
    """The changes of a node and of what is below it, but for messages, annotations and default values."""
    call = node.value if isinstance(node, ast.Expr) else node
    is_estimate = isinstance(call, ast.Call) and ESTIMATES.fullmatch(_called(call))
    if is_estimate or isinstance(node, ast.Raise | ast.JoinedStr | ast.arg | ast.Import | ast.ImportFrom):
        return
    if isinstance(node, ast.stmt):
        header, bound = node, None
    shown = _shown(node, bound)
    for new in _changes(node, parent, field):
        if isinstance(node, ast.stmt) and isinstance(parent, ast.FunctionDef) and index is None:
            index = parent.body.index(node)
        guarded = header.body[0] if isinstance(header, ast.If) else header
        yield _Site(parent, field, index, node, new, _range_of(header, node), guarded, shown or node)
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "args") and isinstance(
            node, ast.FunctionDef | ast.AnnAssign
        ):
            continue
        entries = list(enumerate(value)) if isinstance(value, list) else [(None, value)]
        for place, child in entries:
            if isinstance(child, ast.AST) and not _is_message(node, name, place):
                yield from _below(node, name, place, child, header, shown)


def _shown(node: ast.AST, bound: ast.AST | None) -> ast.AST | None:
    """What is printed of a change of a number or a name: the comparison, call, slice or statement around it."""
    if isinstance(node, ast.Compare | ast.Call | ast.Subscript | ast.BoolOp | ast.Lambda | ast.comprehension):
        return bound if isinstance(bound, ast.Compare) and not isinstance(node, ast.Compare) else node
    if isinstance(node, ast.Assign | ast.AugAssign | ast.AnnAssign | ast.Return | ast.Expr):
        return node
    return bound


def _range_of(header: ast.AST, node: ast.AST) -> ast.AST:
    """What must be reached: a simple statement, or the changed part of a compound one."""
    compound = isinstance(header, ast.If | ast.While | ast.For | ast.Try | ast.With | ast.FunctionDef)
    return node if compound and not isinstance(node, ast.stmt | ast.comprehension) else header


def _is_message(node: ast.AST, field: str, index: int | None) -> bool:
    """Whether a part of a node is the reason given to a refuser, or the first number of what reasons count.

    Neither is an index without a choice changed, nor whether ``zip`` insists on equal lengths: what is read has them.
    """
    if isinstance(node, ast.Call) and _called(node):
        is_number = _called(node) == "enumerate" and index == 1
        return field == "args" and (is_number or (_called(node) in REFUSERS and index == 1))
    if isinstance(node, ast.keyword):
        return node.arg == "strict"
    return isinstance(node, ast.Subscript) and field == "slice" and isinstance(node.slice, ast.Constant | ast.UnaryOp)


# What


def _changes(node: ast.AST, parent: ast.AST, field: str) -> Iterator[ast.AST]:
    if field in ("test", "ifs"):
        yield from _changed_test(node, parent)
    elif _is_returned_or_kept(parent, field) or _is_required(node, parent):
        yield _negated(node)
    if isinstance(node, ast.Constant):
        yield from _changed_value(node)
    match node:
        case ast.Expr(value=ast.Call()):
            yield ast.Pass()
        case ast.Compare():
            yield from _changed_comparison(node, parent)
        case ast.BoolOp():
            yield from _without_an_operand(node)
        case ast.For():
            yield from _shortened(node)
        case ast.Call(func=ast.Name(id=name)) if name in _SWAPPED:
            yield ast.Call(ast.Name(_SWAPPED[name], ast.Load()), node.args, node.keywords)
            yield from _shortened_generator(node)


def _is_returned_or_kept(parent: ast.AST, field: str) -> bool:
    """Whether a truth value that is no single comparison, negated elsewhere, is returned or given a name."""
    return isinstance(parent, ast.Return | ast.Assign) and field == "value" and _is_truth_value(parent.value)


def _is_required(node: ast.AST, parent: ast.AST) -> bool:
    """The same for what a refuser is given."""
    is_first = isinstance(parent, ast.Call) and _called(parent) in REFUSERS and node is parent.args[0]
    return is_first and not _is_single_comparison(node)


def _changed_value(node: ast.Constant) -> Iterator[ast.Constant]:
    if isinstance(node.value, bool):
        yield ast.Constant(not node.value)
    elif isinstance(node.value, int):
        yield from (ast.Constant(node.value + step) for step in (1, -1))


def _changed_test(node: ast.AST, parent: ast.AST) -> Iterator[ast.AST]:
    """A condition that never holds, or always, or is negated; guards that always refuse show in every test."""
    if not _is_single_comparison(node) and isinstance(parent, ast.If):
        yield _negated(node)
    if isinstance(parent, ast.comprehension):
        yield ast.Constant(True)
    else:
        yield ast.Constant(False)
        if isinstance(parent, ast.IfExp) or (isinstance(parent, ast.If) and parent.orelse):
            yield ast.Constant(True)


def _changed_comparison(node: ast.Compare, parent: ast.AST) -> Iterator[ast.AST]:
    """Other operators; an equality that only chooses is not weakened to an order, nor is one of texts."""
    is_word = any(isinstance(side, ast.Tuple) or _is_text(side) for side in (node.left, *node.comparators))
    is_word |= isinstance(parent, ast.IfExp) or (isinstance(parent, ast.If) and isinstance(node.ops[0], ast.Eq))
    for place, operator in enumerate(node.ops):
        for other in _ORDERED[type(operator)][: 1 if is_word else None]:
            yield ast.Compare(node.left, [*node.ops[:place], other(), *node.ops[place + 1 :]], node.comparators)


def _is_text(node: ast.AST) -> bool:
    """Whether a value is a text: such have no order."""
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _without_an_operand(node: ast.BoolOp) -> Iterator[ast.AST]:
    for place in range(len(node.values)):
        rest = [*node.values[:place], *node.values[place + 1 :]]
        yield rest[0] if len(rest) == 1 else ast.BoolOp(node.op, rest)


def _all_but_one(node: ast.expr) -> Iterator[ast.expr]:
    """All but the first, and all but the last, of what is gone through."""
    for part in (ast.Slice(ast.Constant(1), None), ast.Slice(None, ast.Constant(-1))):
        yield ast.Subscript(ast.List([ast.Starred(node, ast.Load())], ast.Load()), part, ast.Load())


def _shortened(node: ast.For) -> Iterator[ast.AST]:
    for other in _all_but_one(node.iter):
        yield ast.For(node.target, other, node.body, node.orelse)


def _shortened_generator(node: ast.Call) -> Iterator[ast.AST]:
    match node.args:
        case [ast.GeneratorExp(elt=entry, generators=[first, *others])] if _called(node) in ("any", "all"):
            for other in _all_but_one(first.iter):
                changed = ast.comprehension(first.target, other, first.ifs, first.is_async)
                yield ast.Call(node.func, [ast.GeneratorExp(entry, [changed, *others])], [])


def _negated(node: ast.AST) -> ast.AST:
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return node.operand
    return ast.UnaryOp(ast.Not(), node)  # type: ignore[arg-type]


def _called(node: ast.Call) -> str:
    """The name of the function that is called, if it has one, perhaps with that of its module."""
    match node.func:
        case ast.Name(id=name) | ast.Attribute(value=ast.Name(id="pure"), attr=name):
            return name
    return ""


def _is_single_comparison(node: ast.AST) -> bool:
    return isinstance(node, ast.Compare) and len(node.ops) == 1


def _is_truth_value(node: ast.AST) -> bool:
    is_chain = isinstance(node, ast.Compare) and len(node.ops) > 1
    is_not = isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not)
    return (
        isinstance(node, ast.BoolOp)
        or is_chain
        or is_not
        or (
            isinstance(node, ast.Call)
            and _called(node)
            in (
                "any",
                "all",
            )
        )
    )


def _constants(statement: ast.Assign | ast.AnnAssign) -> Iterator[_Site]:
    """The changes of a constant of a module: its numbers, and those in regular expressions."""
    for parent in ast.walk(statement):
        for field, value in ast.iter_fields(parent):
            if field in ("annotation", "slice"):
                continue
            for index, child in enumerate(value) if isinstance(value, list) else [(None, value)]:
                if isinstance(child, ast.Constant):
                    for new in _changed_constant(child, parent):
                        yield _Site(parent, field, index, child, new, statement, statement, statement)


def _changed_constant(node: ast.Constant, parent: ast.AST) -> Iterator[ast.Constant]:
    yield from _changed_value(node)
    is_pattern = isinstance(parent, ast.Call) and ast.unparse(parent.func) == "re.compile"
    if is_pattern and isinstance(node.value, str):
        for found in re.finditer(r"(?<=[{,\[-])[0-9]+(?=[}\],-])", node.value):
            start, end = found.span()
            for number in (int(found.group()) + 1, int(found.group()) - 1):
                if number >= 0 and (number <= 9 or node.value[end] != "]"):
                    yield ast.Constant(f"{node.value[:start]}{number}{node.value[end:]}")

"""What importing the package and starting the command cost."""

import ast
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import pkm_exact
from pkm_exact.cli.commands import COMMANDS

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "pkm_exact"
HEAVY = ("sympy", "matplotlib", "flint", "numpy", "mpmath", "rich")
PLANAR = ROOT / "models" / "3-rpr-merlet-p.toml"
MOST_OWN = 140
"""Modules of the package that are loaded to solve a planar robot, at most."""


def _loaded(code: str) -> set[str]:
    script = f"{code}\nimport sys; print(' '.join(m for m in {HEAVY!r} if m in sys.modules))"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT)
    return set(done.stdout.split("\n")[-2].split())


def test_importing_the_package_loads_nothing_heavy() -> None:
    assert _loaded("import pkm_exact; pkm_exact.__version__; dir(pkm_exact)") == set()


@pytest.mark.parametrize("words", [["--help"], ["solve"], *([name, "--help"] for name in COMMANDS)])
def test_the_command_starts_without_anything_heavy(words: list[str]) -> None:
    assert _loaded(f"from pkm_exact.cli.main import main; main({words!r})") == set()


def test_the_versions_load_nothing_but_flint() -> None:
    assert _loaded("from pkm_exact.cli.main import main; main(['--version'])") == {"flint"}


def test_reading_a_model_loads_nothing_heavy() -> None:
    assert _loaded("import pkm_exact; pkm_exact.read_robot('models/rolland-6-6.toml')") == set()


def test_solving_a_planar_robot_loads_flint_and_what_it_needs() -> None:
    """Counted, as seconds depend on the machine: each module of the package costs about half a millisecond."""
    script = (
        "import sys; from pkm_exact.cli.main import main; code = main(['solve', sys.argv[1]]); "
        "print(code, *sorted(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", script, str(PLANAR)], capture_output=True, text=True, check=True)
    code, *loaded = done.stdout.splitlines()[-1].split()
    assert code == "0"
    assert [name for name in HEAVY if name in loaded] == ["flint"]
    own = [name for name in loaded if name.split(".")[0] == "pkm_exact"]
    assert len(own) <= MOST_OWN, own
    parts = {".".join(name.split(".")[:2]) for name in own}
    unneeded = ("numeric", "certify", "systems", "regions", "pictures", "statics", "mobility")
    assert not parts & {f"pkm_exact.{part}" for part in unneeded}


@pytest.mark.parametrize(("name", "most"), [("3-rpr-merlet-p", 45), ("3-rps", 50)])
def test_checking_loads_what_the_kind_of_certificate_needs(name: str, most: int) -> None:
    script = (
        "import sys; from pkm_exact.cli.main import main; code = main(['check', sys.argv[1]]); "
        "print(code, *sorted(sys.modules))"
    )
    command = [sys.executable, "-c", script, str(ROOT / "certs" / f"{name}.json")]
    code, *loaded = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1].split()
    assert code == "0"
    assert [heavy for heavy in HEAVY if heavy in loaded] == ["flint"]
    own = [module for module in loaded if module.split(".")[0] == "pkm_exact"]
    assert len(own) <= most, own


def test_help_takes_little_processor_time() -> None:
    code = (
        "import resource, subprocess, sys\n"
        "command = [sys.executable, '-m', 'pkm_exact.cli.main', '--help']\n"
        "subprocess.run(command, stdout=subprocess.DEVNULL, check=True)\n"
        "used = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
        "print(used.ru_utime + used.ru_stime)"
    )
    pytest.importorskip("resource")
    times = [
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT).stdout)
        for _ in range(3)
    ]
    assert min(times) < 0.3


@pytest.mark.parametrize("name", pkm_exact.__all__)
def test_every_public_name_is_there(name: str) -> None:
    assert getattr(pkm_exact, name) is not None
    assert name in dir(pkm_exact)


@pytest.mark.parametrize("name", pkm_exact.__all__)
def test_every_public_name_has_an_example(name: str) -> None:
    value = getattr(pkm_exact, name)
    assert not callable(value) or ">>>" in (value.__doc__ or "")


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        pkm_exact.nonsense  # noqa: B018


def _imported(tree: ast.AST) -> Iterator[str]:
    """The modules of the package that are imported anywhere in a module: at load, inside functions, for types."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("pkm_exact"):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("pkm_exact."))


def _part(module: str) -> str:
    """The folder of the package, or the module beside the folders, to which a module belongs."""
    return f"{module}.".split(".")[1]


@cache
def modules() -> dict[str, ast.Module]:
    """The modules of the package, parsed when a test asks for them: every process collects this file."""
    return {
        ".".join(path.relative_to(ROOT).with_suffix("").parts): ast.parse(path.read_text(encoding="utf-8"))
        for path in PACKAGE.rglob("*.py")
        if path != PACKAGE / "__init__.py"
    }


STATED = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").partition("A robot becomes a certificate")[2]
ORDER = [line.split()[0] for line in STATED.split("```")[1].splitlines()[1:]]
"""The parts of the package in the order that CONTRIBUTING.md states."""


def test_every_part_has_a_place_in_the_order() -> None:
    assert sorted(ORDER) == sorted({_part(module) for module in modules()})


def test_parts_import_from_those_above_them_only() -> None:
    upwards = [
        f"{module} imports {name}"
        for module, tree in modules().items()
        for name in _imported(tree)
        if ORDER.index(_part(name)) > ORDER.index(_part(module))
    ]
    assert upwards == []


def test_only_the_command_line_imports_the_command_line() -> None:
    importing = {module for module, tree in modules().items() if "cli" in map(_part, _imported(tree))}
    assert {_part(module) for module in importing} == {"cli"}


def test_no_two_modules_have_the_same_name() -> None:
    names = [module.rpartition(".")[2] for module in modules() if not module.endswith("__init__")]
    assert sorted(name for name, count in Counter(names).items() if count > 1) == []


TOGETHER = [
    {"polytopes.combinations_of_polytopes", "polytopes.polytope", "polytopes.slabs"},
    {"poses.arrays", "poses.pose"},
]
"""Modules that know each other: of a value and its operators."""


def test_other_modules_import_each_other_in_no_circle() -> None:
    names = {module.partition(".")[2]: tree for module, tree in modules().items()}
    left = {
        module: {
            next(known for known in (name, name.rpartition(".")[0], "") if known in names or not known)
            for name in (found.partition(".")[2] for found in _imported(tree))
        }
        - {"", module}
        for module, tree in names.items()
    }
    for circle in TOGETHER:
        for module in circle:
            left[module] -= circle
    while free := [module for module, imported in left.items() if not imported & left.keys()]:
        for module in free:
            del left[module]
    assert not left, f"in a circle, or above one: {sorted(left)}"

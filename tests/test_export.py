"""Systems in other programs' syntax: exact text, read back by SymPy, counted by msolve and Singular where present."""

import ast
import shutil
import subprocess
from functools import cache
from pathlib import Path

import pytest
import sympy
from flint import fmpz_mpoly

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.backends.msolve_program import find_msolve, msolve_command, parse_msolve
from pkm_exact.cli.main import main
from pkm_exact.errors import InputError
from pkm_exact.export.targets import TARGETS, export
from pkm_exact.formulations.base import FormulatedProblem
from pkm_exact.formulations.registry import formulation, formulation_codes
from pkm_exact.geometry.reader import read_robot

MODELS = Path(__file__).parent.parent / "models"
GENERAL = str(MODELS / "mourrain-l.toml")
PLANAR = str(MODELS / "similar-planar-s.toml")
COUNTS = {"SE3": 40, "AFD4": 40, "AFP3": 40, "AFD5": 80, "AFD1": 80}
Capture = pytest.CaptureFixture[str]


@cache
def formulated(model: str, code: str) -> FormulatedProblem:
    robot = read_robot(model)
    return formulation(code).formulate(robot.problem(robot.configuration().lengths_squared))


def terms(polynomial: fmpz_mpoly) -> dict[tuple[int, ...], int]:
    return {tuple(map(int, exponents)): int(value) for exponents, value in polynomial.to_dict().items()}


def example() -> PolynomialSystem:
    e0, r12 = polynomial_ring(("e0", "r12")).gens()
    return PolynomialSystem(("e0", "r12"), (-e0 + 12 * e0 * r12**2 - 10**20, r12 - 1))


GOLDEN = {
    "msolve": "e0,r12\n0\n12*e0*r12^2-1*e0-100000000000000000000,\n1*r12-1\n",
    "singular": (
        "// A robot.\n"
        "// Solutions with multiplicity: vdim(std(I)); it is quicker modulo a prime, with 2147483647 for the 0 below.\n"
        "ring Q = 0,(e0,r12),dp;\nideal I =\n12*e0*r12^2-e0-100000000000000000000,\nr12-1;\n"
    ),
    "magma": (
        "// A robot.\n// Solutions with multiplicity: QuotientDimension(I);\n"
        'P<e0,r12> := PolynomialRing(RationalField(), 2, "grevlex");\n'
        "I := ideal<P |\n12*e0*r12^2-e0-100000000000000000000,\nr12-1>;\n"
    ),
    "maple": (
        "# A robot.\n# Solutions with multiplicity:\n"
        "# order := tdeg(op(unknowns)): nops(Groebner:-NormalSet(Groebner:-Basis(equations, order), order)[1]);\n"
        "unknowns := [e0,r12]:\nequations := [\n12*e0*r12^2-e0-100000000000000000000,\nr12-1]:\n"
    ),
    "phcpack": "2 2\n12*e0*r12^2-1*e0-1.00000000000000000000E+20;\n1*r12-1;\n",
    "sympy": (
        'from sympy import symbols\n\n# A robot.\ne0, r12 = unknowns = symbols("e0 r12")\n'
        "equations = [\n    12*e0*r12**2-e0-100000000000000000000,\n    r12-1,\n]\n"
    ),
    "latex": (
        "% A robot.\n\\documentclass{article}\n\\begin{document}\n\\raggedright\nUnknowns: $e_{0}, r_{12}$.\n"
        "\\begin{enumerate}\n\\item $12\\,e_{0}\\,r_{12}^{2}-e_{0}-100000000000000000000=0$\n\\item $r_{12}-1=0$\n"
        "\\end{enumerate}\n\\end{document}\n"
    ),
}


@pytest.mark.parametrize("target", TARGETS)
def test_the_text_is_exactly_this(target: str) -> None:
    assert export(example(), target, "A robot") == GOLDEN[target]


def test_an_unknown_target_is_one_sentence() -> None:
    with pytest.raises(InputError, match="'fortran' is unknown; use one of msolve, singular"):
        export(example(), "fortran")


@pytest.mark.parametrize("target", TARGETS)
def test_a_hostile_name_stays_in_its_comment(target: str) -> None:
    plain, hostile = (export(example(), target, name) for name in ("x", "coding: utf-16 \x1b[2J\n\u2028é \\"))
    assert hostile.isascii()
    assert "\x1b" not in hostile
    assert hostile.count("\n") == plain.count("\n")


@pytest.mark.parametrize("code", formulation_codes())
def test_sympy_reads_back_the_same_polynomials(code: str) -> None:
    system = formulated(GENERAL, code).system
    tree = ast.parse(export(system, "sympy", "coding: rot13"))
    names = dict(zip(system.unknowns, sympy.symbols(system.unknowns), strict=True))
    (value,) = (node.value for node in tree.body if isinstance(node, ast.Assign) and isinstance(node.value, ast.List))
    assert len(value.elts) == len(system.polynomials)
    for element, polynomial in zip(value.elts, system.polynomials, strict=True):
        read = sympy.Poly(sympy.parse_expr(ast.unparse(element), names), *names.values())
        assert dict(read.terms()) == terms(polynomial)


@pytest.mark.skipif(find_msolve() is None, reason="the program msolve is not installed")
@pytest.mark.parametrize("code", ["SE3", "AFD4", "AFP3", "AFD5"])
def test_msolve_counts_the_solutions_of_the_exported_file(code: str, tmp_path: Path, capsys: Capture) -> None:
    source, target = tmp_path / "system.ms", tmp_path / "answer.txt"
    assert main(["export", GENERAL, "--formulation", code, "--to", "msolve", "-o", str(source)]) == 0
    assert capsys.readouterr() == ("", "")
    program = find_msolve()
    assert program is not None
    subprocess.run(msolve_command(program, source, target), check=True, timeout=60, capture_output=True)
    answer = parse_msolve(target.read_text(), formulated(GENERAL, code).system.unknowns)
    assert (answer.degree, len(answer.real_solutions)) == (COUNTS[code], COUNTS[code] // 10)


@pytest.mark.skipif(shutil.which("Singular") is None, reason="the program Singular is not installed")
@pytest.mark.parametrize("code", COUNTS)
def test_singular_counts_the_solutions_modulo_a_prime(code: str, tmp_path: Path, capsys: Capture) -> None:
    assert main(["export", GENERAL, "--formulation", code, "--to", "singular"]) == 0
    text = capsys.readouterr().out.replace("ring Q = 0,", "ring Q = 2147483647,")
    script = tmp_path / "script.sing"
    script.write_text(text + "vdim(std(I));\nquit;\n")
    command = ["Singular", "-q", str(script)]
    done = subprocess.run(command, check=True, timeout=60, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    assert done.stdout.split() == [str(COUNTS[code])]


@pytest.mark.skipif(shutil.which("phc") is None, reason="the program phc is not installed")
def test_phc_reads_what_is_meant(tmp_path: Path) -> None:
    (tmp_path / "in").write_text(export(example(), "phcpack"))
    command = ["phc", "-b", "in", "out"]
    subprocess.run(command, cwd=tmp_path, timeout=60, capture_output=True, stdin=subprocess.DEVNULL, check=False)
    echo = (tmp_path / "out").read_text().split(";")
    assert "".join(echo[0].split()[1:]) == "12*e0*r12^2-e0-1.00000000000000E+20"


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="the program pdflatex is not installed")
def test_latex_compiles(tmp_path: Path) -> None:
    (tmp_path / "system.tex").write_text(export(formulated(GENERAL, "AFD1").system, "latex", "a robot"))
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "system.tex"]
    subprocess.run(command, cwd=tmp_path, timeout=120, capture_output=True, stdin=subprocess.DEVNULL, check=True)


@pytest.mark.parametrize("code", [*formulation_codes(), "AFD2:xyx", "AFP4:136"])
def test_every_formulation_is_written_for_every_program(code: str) -> None:
    system = formulated(PLANAR, code).system
    for target in TARGETS:
        text = export(system, target)
        assert text.endswith("\n")
        assert all(text.count(left) == text.count(right) for left, right in ("()", "[]", "{}"))
        assert max(map(len, text.split("\n"))) < 3000


@pytest.mark.parametrize("code", formulation_codes())
def test_localised_is_the_system_that_is_solved(code: str, capsys: Capture) -> None:
    assert main(["export", GENERAL, "--formulation", code, "--to", "msolve"]) == 0
    own = capsys.readouterr().out
    assert main(["export", GENERAL, "--formulation", code, "--to", "msolve", "--localised"]) == 0
    solved = capsys.readouterr().out
    assert own == export(formulated(GENERAL, code).system, "msolve")
    assert solved == export(formulated(GENERAL, code).branches[0], "msolve")
    assert (own != solved) == (code in ("AFD2", "AFP4"))


BAD_USAGE = [
    (["export", GENERAL], "missing option '--to'"),
    (["export", GENERAL, "--to", "fortran"], "'fortran' is not one of 'msolve', 'singular'"),
    (["export", GENERAL, "--to", "magma", "--formulation", "AFD99"], "--formulation: 'AFD99' is unknown; use one of"),
    (["export", GENERAL, "--to", "magma", "--formulation", "AFD1:zzx"], "'zzx' is no Euler convention"),
    (["export", "missing.toml", "--to", "magma"], "missing.toml: no such file"),
    (["export", GENERAL, "--to", "magma", "-o", str(MODELS)], "is a directory; give -o the path of a file"),
    (["export", GENERAL, "--to", "magma", "--configuration", "x"], "'x' is unknown; use one of: home"),
]


@pytest.mark.parametrize(("words", "part"), BAD_USAGE, ids=range(len(BAD_USAGE)))
def test_bad_usage_gives_one_sentence(words: list[str], part: str, capsys: Capture) -> None:
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert part in err


def test_a_formulation_that_does_not_apply_writes_nothing(collinear_model: Path, capsys: Capture) -> None:
    output = collinear_model.with_suffix(".ms")
    words = ["export", str(collinear_model), "--to", "msolve", "-o", str(output)]
    assert main([*words, "--formulation", "AFP1"]) == 2
    assert f"{collinear_model}: platform.joints: all platform joints lie on one line" in capsys.readouterr().err
    assert not output.exists()
    assert main([*words, "--formulation", "SE3"]) == 0
    assert output.exists()

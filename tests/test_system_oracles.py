"""Oracles that lie: a factor dropped, a root added, coefficients off by one. And a program that says nothing useful."""

import os
import signal
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from time import sleep

import pytest
from flint import fmpz_poly

from pkm_exact.algebra.representation import UnivariateRepresentation, from_common_fractions
from pkm_exact.algebra.system import PolynomialSystem
from pkm_exact.backends.msolve_oracle import msolve_proposal, parsed_proposal
from pkm_exact.backends.msolve_program import MsolveError, find_msolve
from pkm_exact.claim import Claim
from pkm_exact.errors import InputError
from pkm_exact.interactive.limited_solve import solve_within_limits
from pkm_exact.interactive.system_answers import solve_system
from pkm_exact.processes import signals_deferred
from pkm_exact.systems.solution_search import SolutionSearch
from pkm_exact.systems.system_engine import SYSTEM_POLICY, OracleError, solved_system
from pkm_exact.systems.system_sources import polynomial_system

SYSTEM = polynomial_system(["x^2 - 2", "y^2 - 3*x*y + x - 5"], ["x", "y"])
WITH_RATIONAL_ROOTS = polynomial_system(["x^2 - 1", "y^2 - x - 3"], ["x", "y"])
AT_INFINITY = polynomial_system(["x^2*y - 1", "x*y^2 - y - x"], ["x", "y"])


def truth(system: PolynomialSystem) -> UnivariateRepresentation:
    """The right answer."""
    found = SolutionSearch(system, SYSTEM_POLICY).found().representation
    assert found is not None
    return found


def of(form: tuple[int, ...], h: fmpz_poly, numerators: list[fmpz_poly]) -> UnivariateRepresentation:
    lists = [[int(value) for value in numerator.coeffs()] for numerator in numerators]
    return from_common_fractions(form, [int(value) for value in h.coeffs()], 1, lists, 1)


def with_a_root(found: UnivariateRepresentation) -> UnivariateRepresentation:
    """One solution too many, that is none."""
    t = fmpz_poly([-7, 1])
    h = found.polynomial * t
    return of(found.form, h, [numerator * t + found.polynomial for numerator in found.numerator_polynomials])


def off_by_one(found: UnivariateRepresentation) -> UnivariateRepresentation:
    first, *rest = found.numerators
    return UnivariateRepresentation(found.form, found.eliminant, ((first[0] + 1, *first[1:]), *rest))


def eliminant_off_by_one(found: UnivariateRepresentation) -> UnivariateRepresentation:
    return UnivariateRepresentation(found.form, (found.eliminant[0] + 1, *found.eliminant[1:]), found.numerators)


def twice_the_same(found: UnivariateRepresentation) -> UnivariateRepresentation:
    square = found.polynomial * found.polynomial
    return of(found.form, square, [2 * numerator * found.polynomial for numerator in found.numerator_polynomials])


@pytest.mark.parametrize("lie", [with_a_root, off_by_one, eliminant_off_by_one, twice_the_same])
@pytest.mark.parametrize("system", [SYSTEM, WITH_RATIONAL_ROOTS, AT_INFINITY], ids=["general", "rational", "infinity"])
def test_lies_are_found_out(
    system: PolynomialSystem, lie: Callable[[UnivariateRepresentation], UnivariateRepresentation]
) -> None:
    with pytest.raises(OracleError, match="answer is wrong"):
        solved_system(system, propose=lambda given: lie(truth(given)))


@pytest.mark.parametrize(
    ("polynomials", "part"),
    [
        (["x^2 - 1", "y^2 - x - 3"], ["x - 1", "y^2 - 4"]),
        (["x^2 - x", "y^2 - y", "x*y"], ["x", "y"]),
        (["x^3 - x^2", "y^2 - x*y"], ["x - 1", "y^2 - y"]),
        (["x^2*y - 1", "x*y^2 - y^2 - x*y + y"], ["x - 1", "y - 1"]),
    ],
    ids=["all finite", "more polynomials", "multiple", "infinity"],
)
def test_a_list_that_lacks_a_factor_is_never_called_complete(polynomials: list[str], part: list[str]) -> None:
    system, some = polynomial_system(polynomials, ["x", "y"]), polynomial_system(part, ["x", "y"])
    assert truth(system).degree > truth(some).degree
    found = solved_system(system, propose=lambda _: truth(some))
    assert found.claim is Claim.NOT_PROVEN_COMPLETE
    assert found.notes
    assert found.complex_solutions is None
    assert found.distinct_solutions == truth(some).degree


def test_an_honest_oracle_is_believed_after_verification() -> None:
    found = solved_system(SYSTEM, propose=truth)
    assert (found.claim, found.distinct_solutions) == (Claim.COMPLETE, 4)


@pytest.mark.parametrize("polynomials", [["x*y - 1", "x*y - 2"], ["x*y - 1"]])
def test_an_oracle_without_a_list_proves_nothing(polynomials: list[str]) -> None:
    system = polynomial_system(polynomials, ["x", "y"])
    assert solved_system(system, propose=lambda _: None) == solved_system(system)


def test_an_oracle_of_no_name() -> None:
    with pytest.raises(InputError, match="oracle: 'delphi' is not known"):
        solve_system(["x - 1"], oracle="delphi")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[0, [0, 2, 2, ['x', 'y'], [0, 1], [1, [[2, [-4, 0, 13]], [1, [0, 27]], [[[1, [-12, 0]], 1]]]]], [1, []]]:",
        "[0, [0, 2, 2, ['x', 'y'], [0, 1], [1, [[2, [-4, 0, 13]], [1, [0, 26]], []]]], [1, []]]:",
        "[0, [0, 2, 2, ['x', 'y'], [0, 1], [1, [[0, [4]], [0, []], [[[1, [-12, 0]], 1]]]]], [1, []]]:",
        "[0, [0, 2, 2, ['x', 'z'], [0, 1], [1, [[2, [-4, 0, 13]], [1, [0, 26]], [[[1, [-12, 0]], 1]]]]], [1, []]]:",
        "[0, [0, 2, 2, ['x', 'y'], [0, 1], [1, [[2, [-4, 0, 13]], [1, [0, 26]], [[[1, [-12, 0]], 0]]]]], [1, []]]:",
    ],
    ids=["nothing", "slope", "no numerators", "constant", "names", "divisor"],
)
def test_output_that_is_not_understood(text: str) -> None:
    with pytest.raises(MsolveError):
        parsed_proposal(text, ("x", "y"))


@pytest.mark.skipif(find_msolve() is None, reason="msolve is not installed")
@pytest.mark.parametrize(
    "polynomials",
    [
        ["x^2 + y^2 - 1", "2*x - 3*y"],
        ["x^2 - x", "y^2 - y"],
        ["x^2", "y^2 - 1"],
        ["A^2 - B - 1", "A*B - 3*B + 1/2"],
        ["x^2*y - 1", "x*y^2 - y - x"],
    ],
)
def test_msolve_and_the_internal_engine_agree(polynomials: list[str]) -> None:
    mine, theirs = solve_system(polynomials), solve_system(polynomials, oracle="msolve")
    assert [solution.values for solution in mine] == [solution.values for solution in theirs]
    assert [solution.multiplicity for solution in mine] == [solution.multiplicity for solution in theirs]
    assert (mine.claim, mine.complex_solutions) == (theirs.claim, theirs.complex_solutions)
    assert theirs.check()


@pytest.mark.skipif(find_msolve() is None, reason="msolve is not installed")
def test_msolve_proposes_a_representation() -> None:
    found = msolve_proposal(SYSTEM, seconds=60)
    assert found is not None
    assert found.degree == 4


W = Fraction(1)
SLEEPER = """#!/bin/sh
echo $$ > {note}
exec sleep 100
"""


def _is_gone(process: int) -> bool:
    """Whether there is no such process; one that was killed may be there a moment longer."""
    sleep(0.01)
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    return False


def test_a_program_that_is_asked_ends_with_us(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Interrupted, or when the time is over, we leave neither the program nor its files behind."""
    note, folder, program = tmp_path / "pid", tmp_path / "temporary", tmp_path / "msolve"
    folder.mkdir()
    program.write_text(SLEEPER.format(note=note))
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    monkeypatch.setenv("TMPDIR", str(folder))

    def interrupted(stage: str) -> None:
        while stage == "oracle" and not (note.exists() and note.read_text().endswith("\n")):
            sleep(0.01)
        if stage == "oracle":
            assert list(folder.iterdir())
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        solve_within_limits(
            SYSTEM, seconds=60, megabytes=None, width=Fraction(1), oracle="msolve", progress=interrupted
        )
    assert any(_is_gone(int(note.read_text())) for _ in range(1000))
    assert not list(folder.iterdir())


def test_a_signal_waits_until_what_is_started_is_known() -> None:
    """Between the start of a program and the moment we know it, an interrupt would leave it alone."""
    reached = []

    def started() -> None:
        with signals_deferred():
            signal.raise_signal(signal.SIGINT)
            reached.append(True)

    with pytest.raises(KeyboardInterrupt):
        started()
    assert reached == [True]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler

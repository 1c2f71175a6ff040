"""An independent program counts the same solutions of every shipped robot in every formulation."""

from fractions import Fraction

import pytest
from samples import CODES, MODELS, REFERENCE, shipped, solved, system

from pkm_exact.backends.msolve_program import MsolveError, find_msolve, msolve_input, parse_msolve, run_msolve
from pkm_exact.claim import Claim
from pkm_exact.formulations.registry import formulation

needs_msolve = pytest.mark.skipif(find_msolve() is None, reason="the program msolve is not installed")


EVERY_FORMULATION = "mourrain-l"
IN_ONE_FORMULATION = ("3-rpr-merlet-p", "3-rpr-triple", "3-rrr", "robocrane-r", "ssm-exact")


def _is_quick(name: str, code: str) -> bool:
    return name == EVERY_FORMULATION or (name in IN_ONE_FORMULATION and code == CODES[0])


CASES = [
    pytest.param(
        path.stem, code, id=f"{path.stem}-{code}", marks=() if _is_quick(path.stem, code) else pytest.mark.slow
    )
    for path in MODELS
    for code in (CODES if path.stem in REFERENCE else CODES[:1])
]


@needs_msolve
@pytest.mark.parametrize(("name", "code"), CASES)
def test_msolve_counts_the_same(name: str, code: str) -> None:
    """Or finds, as we do, that there is no pose, or that the robot moves."""
    formulated = formulation(code).formulate(shipped(name))
    theirs = run_msolve(formulated.system, seconds=60)
    ours = solved(name, code)
    if ours.claim == Claim.INCONSISTENT:
        assert theirs.dimension == -1
        return
    if ours.claim == Claim.POSITIVE_DIMENSIONAL_PROVED:
        assert theirs.dimension >= 1
        return
    assert theirs.dimension == 0
    assert theirs.degree == formulated.fibre * ours.complex_solutions
    assert len(theirs.real_solutions) == formulated.fibre * len(ours.poses)


@needs_msolve
@pytest.mark.parametrize("name", ["mourrain-l", pytest.param("rolland-6-6", marks=pytest.mark.slow)])
def test_msolve_finds_the_positions_of_our_boxes(name: str) -> None:
    equations = formulation("AFD4").formulate(shipped(name)).system
    position = [equations.unknowns.index(unknown) for unknown in ("c1", "c2", "c3")]
    poses = solved(name).poses
    for solution in run_msolve(equations, seconds=60).real_solutions:
        found = [pose for pose in poses if all(pose.position[i].overlaps(solution[position[i]]) for i in range(3))]
        assert len(found) == 1


@needs_msolve
def test_dimensions_are_told_apart() -> None:
    assert run_msolve(system("x y", "x - 1", "x - 2"), seconds=10).dimension == -1
    assert run_msolve(system("x y", "x - y"), seconds=10).dimension == 1
    double = run_msolve(system("x y", "x**2 - 2*x + 1", "y**2 - x"), seconds=10)
    assert (double.dimension, double.degree, len(double.real_solutions)) == (0, 4, 2)


@needs_msolve
def test_coordinates_come_in_the_order_of_the_unknowns() -> None:
    solutions = run_msolve(system("x y", "x**2 - 3*x + 2", "3*y - 1"), seconds=10).real_solutions
    assert sorted(point[0].lo for point in solutions) == [1, 2]
    assert all(point[1].contains(Fraction(1, 3)) for point in solutions)


def test_the_written_system_avoids_what_msolve_misreads() -> None:
    text = msolve_input(system("x y", "x*x*y - x*x + 0*y", "0*x", "-7*y**3"))
    assert text == "x,y\n0\n1*x^2*y-1*x^2,\n-7*y^3\n"


BAD_OUTPUT = ["", "[", "[2]:", "[0, [0, 1, 1]]:", "[-1] [-1]", "[0, [0, 2, 1, ['x', 'y']], [1, [[[]]]]]"]


@pytest.mark.parametrize("text", BAD_OUTPUT)
def test_other_output_is_refused(text: str) -> None:
    with pytest.raises(MsolveError):
        parse_msolve(text, ("x", "y"))


def test_a_missing_program_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pkm_exact.backends.msolve_program.find_msolve", lambda: None)
    with pytest.raises(MsolveError, match="not installed"):
        run_msolve(system("x y", "x", "y"), seconds=1)

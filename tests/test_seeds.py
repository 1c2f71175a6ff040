"""Solutions without paths: as many as there are, and the same answers, to the byte, as along paths."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from samples import model, shipped
from test_numeric_krawczyk import random_robot

from pkm_exact import numeric_engine
from pkm_exact.certify.build import canonical_bytes, certificate
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric import seeds as module
from pkm_exact.numeric.poses import certified_solutions
from pkm_exact.numeric.seeds import _fitting, has_seeds, seeds, study_points
from pkm_exact.numeric.study_system import motion_forms, numeric_section
from pkm_exact.numeric.template import motion_seeds
from pkm_exact.numeric_engine import solve_krawczyk

Patch = pytest.MonkeyPatch
COUNTS = {"rolland-6-6": 40, "dietmaier": 40, "6-6pp": 40, "hexaglide": 36, "ssm-exact": 28, "mssm": 16, "3-rps": 16}


def _without(monkeypatch: Patch) -> None:
    monkeypatch.setattr(numeric_engine, "has_seeds", lambda _: False)


def _no_paths(monkeypatch: Patch) -> None:
    monkeypatch.setattr(numeric_engine, "approximations", lambda *_, **__: pytest.fail("paths were tracked"))


@pytest.mark.parametrize("name", COUNTS)
def test_seeds_lead_to_all_finite_solutions(name: str) -> None:
    problem = shipped(name)
    assert certified_solutions(problem, seeds(problem))[1].count == COUNTS[name]


def test_guesses_are_on_the_forms_and_on_the_variety() -> None:
    forms = numeric_section(shipped("mourrain-l")).legs.real
    values = motion_seeds(forms[None])[0]
    values /= np.linalg.norm(values, axis=1)[:, None]
    assert values.shape == (22, 17)  # four are real
    assert np.abs(values @ forms.T).max() < 1e-12
    points = study_points(values)
    again = np.einsum("kij,pi,pj->pk", motion_forms()[:17], points, points)
    assert np.abs(again - values).max() < 1e-6


def test_a_singular_fit_does_not_spoil_the_others() -> None:
    random = np.random.default_rng(6)
    matrices, values = random.standard_normal((3, 7, 4)) + 0j, random.standard_normal((3, 4, 1)) + 0j
    matrices[1] = 0
    found = _fitting(matrices, matrices @ values)
    assert np.abs(found[[0, 2]] - values[[0, 2]]).max() < 1e-12
    assert not found[1].any()


def test_study_coordinates_are_those_of_the_quantities() -> None:
    random = np.random.default_rng(5)
    points = random.standard_normal((6, 8)) + 1j * random.standard_normal((6, 8))
    e = points[:, :4]
    points[:, 4:] -= (np.sum(e * points[:, 4:], axis=1) / np.sum(e * e, axis=1))[:, None] * e
    found = study_points(np.einsum("kij,pi,pj->pk", motion_forms()[:17], points, points))
    signs = np.sign(np.real(found[:, 0] / points[:, 0]))
    assert np.abs(found * signs[:, None] - points).max() < 1e-10


@pytest.mark.parametrize("name", ["mourrain-l", "3-rps", pytest.param("hexaglide", marks=pytest.mark.slow)])
def test_the_certificate_does_not_depend_on_what_found_the_solutions(name: str, monkeypatch: Patch) -> None:
    robot = model(name)

    def made() -> bytes:
        return canonical_bytes(certificate(robot, robot.configuration().name, solve_krawczyk(shipped(name))))

    by_seeds = made()
    _without(monkeypatch)
    assert made() == by_seeds


@pytest.mark.parametrize("seed", [1039, *(pytest.param(n, marks=pytest.mark.slow) for n in range(2, 40))])
def test_answers_do_not_depend_on_it_for_random_robots(seed: int, monkeypatch: Patch) -> None:
    problem = random_robot(seed)  # of 1039 a coordinate is a power of 2, which is where grids change
    by_seeds = solve_krawczyk(problem)
    _without(monkeypatch)
    by_paths = solve_krawczyk(problem)
    assert by_seeds.method == by_paths.method == "krawczyk"
    assert (by_seeds.isolated, by_seeds.poses) == (by_paths.isolated, by_paths.poses)


def test_points_at_infinity_are_no_solutions_however_small_corrections_are(monkeypatch: Patch) -> None:
    """There the equations have no isolated solution, and where Newton's method leads depends on roundings."""
    monkeypatch.setattr(module, "GREATEST_CHANGE", np.inf)
    for name in ("mssm", "3-rps"):
        assert len(seeds(shipped(name)).points) == COUNTS[name]


def test_no_path_is_tracked_where_seeds_do(monkeypatch: Patch) -> None:
    _no_paths(monkeypatch)
    assert solve_krawczyk(shipped("mssm")).method == "krawczyk"


def test_no_path_is_tracked_where_curves_at_infinity_leave_no_room(monkeypatch: Patch) -> None:
    _no_paths(monkeypatch)
    assert solve_krawczyk(shipped("similar-planar-s")).method == "exact"


def _nothing(_: object) -> Any:
    raise np.linalg.LinAlgError


def _nonsense(_: object) -> Any:
    return np.full((40, 17), np.nan, dtype=complex)


def _few(forms: Any) -> Any:
    return motion_seeds(forms)[:, :31]


@pytest.mark.parametrize("wrong", [_nothing, _nonsense, _few])
def test_paths_find_what_seeds_do_not(wrong: Any, monkeypatch: Patch) -> None:
    monkeypatch.setattr(module, "motion_seeds", wrong)
    found = solve_krawczyk(shipped("mourrain-l"))
    assert (found.method, found.complex_solutions) == ("krawczyk", 40)


def test_what_has_no_template() -> None:
    assert not has_seeds(shipped("3-rrr"))
    assert not has_seeds(shipped("8-8"))
    assert not has_seeds(ForwardProblem(()))
    assert has_seeds(shipped("rcid"))


def test_conjugate_solutions_are_left_out_or_added() -> None:
    problem = shipped("mourrain-l")
    half, whole = seeds(problem, conjugates=False).points, seeds(problem).points
    assert (len(half), len(whole)) == (22, 40)
    overlaps = np.abs(whole.conj() @ whole.T) > 1 - 1e-8
    assert np.count_nonzero(overlaps) == 40

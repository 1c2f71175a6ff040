"""Completeness by mixed volumes: what checkers accept and refuse, and what the solver finds."""

import re
from math import comb

import pytest
from certificate_tools import both
from forged_subdivisions import rows
from handmade_systems import complete, listed, represented, sealed_bytes

from pkm_exact import solve_system
from pkm_exact.certify import pure
from pkm_exact.certify.check import check_counted
from pkm_exact.policy import Policy
from pkm_exact.systems.mixed_volume import subdivision_for
from pkm_exact.systems.system_sources import parse_system

ROWS = rows()


@pytest.mark.parametrize("name", ROWS)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status, reason = ROWS[name]
    verdict = both(sealed_bytes(content))
    assert verdict.status == status, verdict.lines
    assert re.search(reason, verdict.lines[-1]), verdict.lines[-1]


def test_choices_are_not_kept_in_memory_before_they_are_measured() -> None:
    """The first volumes are too many; half a million pairs of the last polynomial's points are not looked at."""
    powers = range(1, 32)
    texts = ("x", "y", "+".join(["z", *(f"x^{a}*z^{b}" for a in powers for b in powers)]))
    cells = {"lifting": ["0 0", "0 0", " ".join("0" * (len(powers) ** 2 + 2))], "obstructions": []}
    origin = represented([(0, 0, 0)], (1, 1, 1))
    data = sealed_bytes(listed("x,y,z", texts, origin, **complete("mixed-volume", 1, subdivision=cells)))
    verdict, budget = check_counted(data)
    assert str(verdict.status) == "rejected"
    assert "its cells have the volume" in verdict.lines[-1]
    assert budget.spent < 3000 * comb(len(powers) ** 2 + 2, 2)
    answer, work = pure.check_counted(data)
    assert answer.status == "rejected"
    assert work.spent < 4000 * comb(len(powers) ** 2 + 2, 2)


def _cyclic(size: int) -> str:
    """The sums of products of neighbours on a circle, and the product of all less 1."""
    names = [f"x{i}" for i in range(size)]
    sums = ["+".join("*".join((names * 2)[i : i + k]) for i in range(size)) for k in range(1, size)]
    return f"{','.join(names)}\n0\n{','.join([*sums, '*'.join(names) + '-1'])}\n"


@pytest.mark.parametrize(
    ("text", "volume"),
    [
        ("x,y\n0\nx^3*y-900,x*y+x-19\n", 3),
        ("x,y\n0\nx*y-2,x*y-2*x-2*y+4\n", 2),
        ("x,y\n0\n(x-1)*(y-1),(x-2)*(y-2)\n", 2),
        (_cyclic(3), 6),
        (_cyclic(5), 70),
    ],
)
def test_the_cells_have_the_mixed_volume(text: str, volume: int) -> None:
    """Known ones: those of cyclic-3 and cyclic-5 are the numbers of their solutions."""
    system = parse_system(text)
    assert subdivision_for(system, volume, Policy()) is not None
    assert subdivision_for(system, volume - 1, Policy()) is None
    assert subdivision_for(system, volume + 1, Policy()) is None


CURVE_AT_INFINITY = ["x = 2 + 3*x*y*z^2", "y = 5 - x^2*z*y", "z = 1 + 7*x*y*z"]


def test_cells_are_counted_before_anything_is_eliminated(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pkm_exact.systems.no_more_solutions.exact_basis", None)
    found = solve_system(CURVE_AT_INFINITY)
    assert found.completeness_route == "mixed-volume"
    assert both(found.certificate().data).status == "accepted"


@pytest.mark.parametrize("work", [0, 10**4, 10**5])
def test_an_elimination_goes_on_where_cells_take_too_much_work(monkeypatch: pytest.MonkeyPatch, work: int) -> None:
    monkeypatch.setattr("pkm_exact.systems.mixed_volume.MOST_WORK", work)
    assert solve_system(CURVE_AT_INFINITY).completeness_route == "exact-elimination"


def test_an_elimination_goes_on_where_cells_are_too_many() -> None:
    assert solve_system(["x*y + x = 2", "x^2*y + x^2 = 2"]).completeness_route == "exact-elimination"


def test_no_obstruction_tells_less_than_another() -> None:
    found = subdivision_for(parse_system(_cyclic(5)), 70, Policy())
    assert found is not None
    low = [{place for place, weight in entry if weight < 0} for entry in found.obstructions]
    assert len(low) > 50
    assert not any(one is not other and one <= other for one in low for other in low)


def test_terms_in_a_plane_have_no_volume() -> None:
    assert subdivision_for(parse_system("x,y,z\n0\nx-y-1,x^2-y^2-3,x*y+x-z\n"), 1, Policy()) is None
    assert subdivision_for(parse_system("x,y\n0\nx*y-1,x^2*y^2+x*y-2\n"), 1, Policy()) is None

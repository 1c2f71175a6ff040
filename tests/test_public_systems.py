"""The public systems are those of their sources: numbers of solutions by two other programs, and modulo a prime."""

import random
from fractions import Fraction

import pytest
from independent_count import INFINITE, count_modulo, count_rational, signature_of
from public_systems import FAMILIES, FOLDER, PublicSystem, integral, parsed, public_systems, written

from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring
from pkm_exact.backends.msolve_program import find_msolve, run_msolve

needs_msolve = pytest.mark.skipif(find_msolve() is None, reason="the program msolve is not installed")

SYSTEMS = public_systems()
QUICK = ("caprasse", "chandra-4", "cohn2", "dz2", "eco-6", "katsura-4", "noon-3", "trinks")
LONG = ("cyclic-7", "discret3s", "filter9", "katsura-9", "reimer-5", "virasoro")
"""Minutes with msolve, over Q."""

EACH = [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in SYSTEMS]


def msolve_system(system: PublicSystem) -> PolynomialSystem:
    ring = polynomial_ring(system.unknowns)
    return PolynomialSystem(system.unknowns, tuple(ring.from_dict(integral(p)) for p in system.polynomials))


def test_every_file_has_a_row_with_a_source() -> None:
    assert {path.stem for path in FOLDER.glob("*.ms")} == set(SYSTEMS)
    assert all(len(system.source) > 10 for system in SYSTEMS.values())
    assert sum(system.degree is not None and bool(system.published) for system in SYSTEMS.values()) >= 60


@pytest.mark.parametrize("name", SYSTEMS)
def test_files_are_in_their_one_spelling(name: str) -> None:
    text = (FOLDER / f"{name}.ms").read_text(encoding="ascii")
    assert written(*parsed(text)) == text
    family, _, number = name.partition("-")
    if family in FAMILIES:
        assert written(*FAMILIES[family](int(number))) == text


@needs_msolve
@pytest.mark.parametrize("name", EACH)
def test_counted_modulo_a_prime(name: str) -> None:
    system = SYSTEMS[name]
    found = count_modulo(system.polynomials, len(system.unknowns), seconds=100)
    assert (found.degree, found.distinct) == (system.degree, system.distinct)


@needs_msolve
@pytest.mark.parametrize("name", [each for each in EACH if each.values[0] not in LONG])
def test_msolve_counts_the_same(name: str) -> None:
    system = SYSTEMS[name]
    found = run_msolve(msolve_system(system), seconds=100)
    if system.degree is None:
        assert found.dimension == 1
    else:
        assert (found.dimension, found.degree, len(found.real_solutions)) == (0, system.degree, system.real)


@pytest.mark.parametrize(
    "name", ["chandra-4", "decker2", "mickey", "ojika1", "ojika2", "ojika3", "quadfor2", "rediff3"]
)
def test_counted_over_the_rationals(name: str) -> None:
    system = SYSTEMS[name]
    found = count_rational(system.polynomials, len(system.unknowns))
    assert (found.degree, found.distinct, found.real) == (system.degree, system.distinct, system.real)


def test_positive_dimension_and_no_solution_are_counted_as_such() -> None:
    _, curve = parsed("x,y\n0\nx*y-1\n")
    assert count_rational(curve, 2) == INFINITE
    _, none = parsed("x,y\n0\nx*y-1,\nx\n")
    assert count_rational(none, 2).degree == 0


def test_signature_of_a_form() -> None:
    """Congruent forms have the same; that of u v is (2, 0)."""
    numbers = random.Random(1)
    for diagonal in ([1, -1, 2, 0], [0, 0, -1, 0], [1, 1, -1, -1]):
        change = [[Fraction(numbers.randint(-3, 3)) for _ in range(4)] for _ in range(4)]
        for i in range(4):
            change[i][i] += 9  # dominant, so regular
        form = [
            [sum((change[k][i] * diagonal[k] * change[k][j] for k in range(4)), Fraction(0)) for j in range(4)]
            for i in range(4)
        ]
        assert signature_of(form) == (sum(map(bool, diagonal)), sum((d > 0) - (d < 0) for d in diagonal))
    assert signature_of([[Fraction(0), Fraction(1)], [Fraction(1), Fraction(0)]]) == (2, 0)

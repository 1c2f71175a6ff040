"""Groebner bases modulo a prime: against sympy, against known counts, and along a learned trace."""

from random import Random

import pytest
import sympy
from samples import cyclic, katsura, random_quadrics, system

from pkm_exact.algebra.groebner import (
    GroebnerBasis,
    OutOfReachError,
    UnluckyPrimeError,
    apply,
    learn,
)
from pkm_exact.algebra.primes import primes_from
from pkm_exact.algebra.quotient import normal_set
from pkm_exact.algebra.reduction import FIRST_COMBINATIONS, new_rows, read_row, row_echelon, row_matrix
from pkm_exact.algebra.system import PolynomialSystem, polynomial_ring

SMALL_PRIME = 32003
BIG_PRIME = next(primes_from(1, 62))


def _learn(polynomials: PolynomialSystem, prime: int, degree_limit: int = 30) -> GroebnerBasis:
    return learn(polynomials.modulo(prime), polynomials.monomials, prime, degree_limit=degree_limit)


def _random_system(seed: int) -> PolynomialSystem:
    """Two to four sparse polynomials in three unknowns, of any dimension."""
    random = Random(seed)
    names = ("x", "y", "z")
    context = polynomial_ring(names)
    polynomials = []
    for _ in range(random.randint(2, 4)):
        terms = {tuple(random.randint(0, 2) for _ in names): random.randint(-9, 9) or 1 for _ in range(4)}
        polynomials.append(context.from_dict(terms))
    return PolynomialSystem(names, tuple(polynomials))


@pytest.mark.parametrize("seed", [*range(10), *(pytest.param(n, marks=pytest.mark.slow) for n in range(10, 100))])
def test_random_systems_have_the_basis_that_sympy_finds(seed: int) -> None:
    polynomials = _random_system(seed)
    ours = _learn(polynomials, SMALL_PRIME)
    unknowns = sympy.symbols(polynomials.unknowns)
    texts = [sympy.sympify(str(polynomial).replace("^", "**")) for polynomial in polynomials.polynomials]
    theirs = sympy.groebner(texts, *unknowns, modulus=SMALL_PRIME, order="grevlex")
    leading = {ours.ring.pack(sympy.Poly(g, *unknowns).monoms(order="grevlex")[0]) for g in theirs.exprs}
    assert set(ours.leading_monomials) == leading
    assert ours.is_zero_dimensional == (theirs.is_zero_dimensional or ours.is_unit_ideal)
    for monomials, coefficients in ours.elements:
        assert coefficients[0] == 1
        assert monomials == sorted(monomials, reverse=True)
        terms = dict(zip(map(ours.ring.unpack, monomials), coefficients, strict=True))
        assert theirs.contains(sympy.Poly.from_dict(terms, *unknowns).as_expr())


@pytest.mark.parametrize(
    ("polynomials", "count"),
    [(katsura(2), 4), (katsura(3), 8), (katsura(5), 32), (cyclic(3), 6), (cyclic(5), 70), (random_quadrics(4, 1), 16)],
    ids=["katsura-2", "katsura-3", "katsura-5", "cyclic-3", "cyclic-5", "quadrics-4"],
)
def test_known_numbers_of_solutions(polynomials: PolynomialSystem, count: int) -> None:
    basis = _learn(polynomials, BIG_PRIME)
    assert basis.is_zero_dimensional
    assert len(normal_set(basis, 100)) == count


def test_an_infinite_staircase_is_seen() -> None:
    assert not _learn(cyclic(4), BIG_PRIME).is_zero_dimensional


def test_the_unit_ideal_is_seen() -> None:
    basis = _learn(system("x y", "x*y - 1", "x**2*y - x + 3"), BIG_PRIME)
    assert basis.is_unit_ideal
    assert basis.is_zero_dimensional
    assert normal_set(basis, 10) == ()


@pytest.mark.parametrize(
    "polynomials", [katsura(4), cyclic(5), random_quadrics(3, 7)], ids=["katsura-4", "cyclic-5", "quadrics-3"]
)
def test_a_trace_gives_what_learning_gives(polynomials: PolynomialSystem) -> None:
    primes = primes_from(1, 62)
    basis = _learn(polynomials, next(primes))
    trace, way = basis.trace, basis.way()
    assert trace is not None
    assert way is not None
    assert basis.course is not None
    for one, other in zip(trace.steps, way.steps, strict=True):
        reducers = {basis.course.known[index][0][0] + multiplier for index, multiplier in other.rows}
        assert len(one.rows) == len(other.rows) == len(reducers) + len(other.new)
    for _ in range(2):
        prime = next(primes)
        fresh = _learn(polynomials, prime)
        for recorded in (trace, way):
            again = apply(recorded, polynomials.modulo(prime), polynomials.monomials, prime)
            assert again.elements == fresh.elements


def test_a_prime_that_moves_a_pivot_is_unlucky() -> None:
    # y f - x g = 101 y^2 - 5 x y, which begins with y modulo 101 only.
    polynomials = system("x y", "x**2 + 101*y", "x*y + 5*y")
    trace = _learn(polynomials, BIG_PRIME).trace
    assert trace is not None
    with pytest.raises(UnluckyPrimeError, match="a pivot is lost modulo 101"):
        apply(trace, polynomials.modulo(101), polynomials.monomials, 101)


def test_a_prime_that_moves_a_generator_is_unlucky() -> None:
    polynomials = system("x y", "7*x**2 + y", "y**2 - 2")
    trace = _learn(polynomials, BIG_PRIME).trace
    assert trace is not None
    with pytest.raises(UnluckyPrimeError, match="other leading monomials modulo 7"):
        apply(trace, polynomials.modulo(7), polynomials.monomials, 7)


def test_a_degree_beyond_the_limit_is_out_of_reach() -> None:
    with pytest.raises(OutOfReachError, match="exceeds the limit 3"):
        _learn(cyclic(5), BIG_PRIME, degree_limit=3)


@pytest.mark.parametrize("prime", [101, SMALL_PRIME, BIG_PRIME])
@pytest.mark.parametrize(("leads", "others", "rank"), [(3, 5, 2), (60, 9, 9), (120, 150, 12), (55, 260, 70), (1, 0, 0)])
def test_new_rows_are_those_of_the_whole_echelon_form(leads: int, others: int, rank: int, prime: int) -> None:
    random = Random(leads)
    width = leads + rank + 20
    tops = sorted(random.sample(range(20, width), leads), reverse=True)

    def polynomial(lead: int, support: list[int]) -> tuple[list[int], list[int]]:
        below = sorted({monomial for monomial in support if monomial < lead}, reverse=True)
        return [lead, *below], [1, *(random.randrange(1, prime) for _ in below)]

    known = [polynomial(lead, random.sample(range(width), 9)) for lead in tops]
    sources = [polynomial(random.choice(tops), random.sample(range(width), 9)) for _ in range(rank)]
    known += [random.choice(sources) for _ in range(others)] if rank else []
    rows = [(index, 0) for index in range(len(known))]
    random.shuffle(rows)
    columns = list(range(width - 1, -1, -1))
    echelon, pivots = row_echelon(row_matrix(rows, known, columns, prime))
    new = [row for row, pivot in enumerate(pivots) if columns[pivot] not in set(tops)]
    assert new_rows(rows, known, prime) == [read_row(echelon, row, columns, pivots[row]) for row in new]


def test_combinations_are_tried_and_do_not_suffice_at_once() -> None:
    # As many new rows as there are combinations at first: that they span everything cannot be concluded.
    size = FIRST_COMBINATIONS
    known = [([100], [1])] + [([100, index % size], [1, 1]) for index in range(5 * size)]
    found = new_rows([(index, 0) for index in range(len(known))], known, BIG_PRIME)
    assert found == [([index], [1]) for index in range(size - 1, -1, -1)]

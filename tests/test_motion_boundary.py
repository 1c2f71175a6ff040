"""What docs/completeness.md says of the equations of rigid motions, and of their singular points at infinity."""

from itertools import combinations
from random import Random

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx, nmod_mat

from pkm_exact.completeness.rigid_motions import Quadric, boundary_quadrics, variety_quadrics
from pkm_exact.geometry.study import motion_quadrics

PRIME = (1 << 61) - 1
ONES = (1, 1, 1)
RING = fmpq_mpoly_ctx.get(("e0", "e1", "e2", "e3", "f0", "f1", "f2", "f3"), Ordering.degrevlex)
E, F = RING.gens()[:4], RING.gens()[4:]


def _motion(e: list[int], f: list[int], metric: tuple[int, int, int]) -> list[int]:
    """(|C|^2; u; C; R; 1) of Study coordinates, times the norm."""
    x = [*e, *f]
    return [sum(c * x[i] * x[j] for (i, j), c in form.items()) for form in motion_quadrics(metric)]


def _random_motion(random: Random, metric: tuple[int, int, int] = ONES) -> list[int]:
    e = [random.randrange(1, PRIME) for _ in range(4)]
    f = [random.randrange(PRIME) for _ in range(3)]
    rest = -sum(a * b for a, b in zip(e[1:], f, strict=True)) * pow(e[0], -1, PRIME) % PRIME
    return [value % PRIME for value in _motion(e, [rest, *f], metric)]


def _value(quadric: Quadric, z: list[int]) -> int:
    return sum(c * z[i] * z[j] for (i, j), c in quadric.items()) % PRIME


def _rank(rows: list[list[int]]) -> int:
    return int(nmod_mat(len(rows), len(rows[0]), [value % PRIME for row in rows for value in row], PRIME).rank())


def _in_pairs() -> list[dict[tuple[int, int], int]]:
    """The entries of M = e e^T (i <= j), of W = e ^ f (i < j), and f.f, as linear forms on the 17 coordinates."""
    names = [(i, j) for i in range(4) for j in range(i, 4)]
    table = [
        [form.get(name, 0) for name in names] for form in [*motion_quadrics(ONES)[7:16], motion_quadrics(ONES)[16]]
    ]
    matrix = nmod_mat(10, 10, [value % PRIME for row in table for value in row], PRIME)
    inverse = matrix.inv()
    return [{(7 + k, 0): int(inverse[row, k]) for k in range(10)} for row in range(10)]


def _matrix(z: list[int]) -> tuple[list[list[int]], list[list[int]]]:
    """M and W at a point, by linear algebra from (h, R) and (C, u)."""
    entries = [sum(c * z[k] for (k, _), c in form.items()) % PRIME for form in _in_pairs()]
    names = [(i, j) for i in range(4) for j in range(i, 4)]
    m = [[0] * 4 for _ in range(4)]
    for (i, j), value in zip(names, entries, strict=True):
        m[i][j] = m[j][i] = value
    half = pow(2, -1, PRIME)
    u, c = z[1:4], z[4:7]
    w = [[0] * 4 for _ in range(4)]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        w[0][i + 1] = (c[i] + u[i]) * half % PRIME
        w[j + 1][k + 1] = (c[i] - u[i]) * half % PRIME
    for i, j in ((a, b) for a in range(4) for b in range(4)):
        if w[i][j] and not w[j][i]:
            w[j][i] = -w[i][j] % PRIME
    return m, w


def _equations(z: list[int]) -> list[int]:
    """(a), (b), (c), (d) of Theorem 17 at any point of P^16."""
    m, w = _matrix(z)
    rows = list(combinations(range(4), 2))
    found = [m[i][k] * m[j][n] - m[i][n] * m[j][k] for i, j in rows for k, n in rows]
    found += [
        m[row][i] * w[j][k] + m[row][j] * w[k][i] + m[row][k] * w[i][j]
        for row in range(4)
        for i, j, k in combinations(range(4), 3)
    ]
    found.append(w[0][1] * w[2][3] - w[0][2] * w[1][3] + w[0][3] * w[1][2])
    found.append(sum(w[i][j] ** 2 for i, j in rows) - z[0] * sum(m[i][i] for i in range(4)))
    return [value % PRIME for value in found]


def test_both_lists_of_quadrics_span_the_same_space() -> None:
    random = Random(5)
    points = [[random.randrange(PRIME) for _ in range(17)] for _ in range(160)]
    first = [[_value(quadric, z) for z in points] for quadric in variety_quadrics(ONES)]
    second = [list(column) for column in zip(*map(_equations, points), strict=True)]
    assert _rank(first) == _rank(second) == _rank(first + second) == 37


def test_no_other_quadric_vanishes_on_motions() -> None:
    random = Random(6)
    pairs = [(i, j) for i in range(17) for j in range(i, 17)]
    rows = []
    for _ in range(170):
        z = _random_motion(random)
        assert not any(_value(quadric, z) for quadric in variety_quadrics(ONES))
        rows.append([z[i] * z[j] for i, j in pairs])
    assert len(pairs) - _rank(rows) == 37


def test_a_metric_changes_nothing() -> None:
    random = Random(7)
    for metric in ((1, 3, 1), (2, 3, 5)):
        z = _random_motion(random, metric)
        assert not any(_value(quadric, z) for quadric in variety_quadrics(metric))
        assert len(variety_quadrics(metric)) == 38


def _polynomials(metric: tuple[int, int, int]) -> list[fmpq_mpoly]:
    x = [*E, *F]
    return [sum((c * x[i] * x[j] for (i, j), c in form.items()), RING.constant(0)) for form in motion_quadrics(metric)]


def test_where_points_at_infinity_are_singular() -> None:
    """2 (N C)(N u)^T G - f.f (N R) lies in the ideal of N and e.f, and so does every quadric of the boundary there."""
    for metric in (ONES, (1, 3, 1), (2, 3, 5)):
        square, *rest = _polynomials(metric)
        u, c, r, norm = rest[0:3], rest[3:6], rest[6:15], rest[15]
        study = sum((a * b for a, b in zip(E, F, strict=True)), RING.constant(0))
        for i in range(3):
            for j in range(3):
                value = 2 * metric[j] * c[i] * u[j] - square * r[3 * i + j]
                assert not _remainder(value, norm, study)
        z = [square, *u, *c, *r, norm]
        for quadric in boundary_quadrics(metric):
            value = sum((k * z[i] * z[j] for (i, j), k in quadric.items()), RING.constant(0))
            assert not _remainder(value, norm, study)


def _remainder(value: fmpq_mpoly, norm: fmpq_mpoly, study: fmpq_mpoly) -> fmpq_mpoly:
    """What division by N, e.f and a combination of them leaves; 0 only if the value lies in their ideal."""
    basis = [norm, study, norm * (1 / norm.coefficient(0)) * F[0] - study * E[0]]
    remainder = RING.constant(0)
    while value:
        lead = value.monomial(0)
        found = [divisor for divisor in basis if all(a >= b for a, b in zip(lead, divisor.monomial(0), strict=True))]
        if found:
            shift = tuple(int(a) - int(b) for a, b in zip(lead, found[0].monomial(0), strict=True))
            value -= RING.from_dict({shift: value.coefficient(0) / found[0].coefficient(0)}) * found[0]
        else:
            term = RING.from_dict({tuple(map(int, lead)): value.coefficient(0)})
            remainder, value = remainder + term, value - term
    return remainder

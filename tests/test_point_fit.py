"""Horn's quartic: the best fit of measured points is enclosed for all readings within their bounds."""

from fractions import Fraction
from math import cos, sin
from random import Random

import numpy as np
import pytest
from flint import arb_mat, fmpq, fmpq_mat, fmpq_poly

from pkm_exact import InputError
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.inverse import rotation_of
from pkm_exact.numeric.point_fit import Place, fitted_pose, horn_matrix, sensed_place
from pkm_exact.roots.interval import Interval

ZERO, ONE = Fraction(0), Fraction(1)
UNIT: tuple[Vector, ...] = ((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE))
SPACE: list[Vector] = [
    (Fraction(x), Fraction(y), Fraction(z)) for x, y, z in ((3, 0, 0), (-1, 2, 0), (0, -3, 1), (1, 1, 4), (2, -1, -2))
]


def vector(random: Random) -> Vector:
    x, y, z = (Fraction(random.randint(-9, 9), random.randint(1, 4)) for _ in range(3))
    return x, y, z


def placed(joints: list[Vector], position: Vector, rotation: tuple[Vector, ...], radius: Fraction) -> list[Place]:
    found = []
    for joint in joints:
        x, y, z = (
            c + sum((a * b for a, b in zip(row, joint, strict=True)), ZERO)
            for c, row in zip(position, rotation, strict=True)
        )
        found.append((*(Interval(v - radius, v + radius) for v in (x, y, z)),))
    return found  # type: ignore[return-value]


def best(joints: list[Vector], points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:  # type: ignore[type-arg]
    """By singular values: R = U diag(1, 1, det(U S)) S^T, C = mean of Q less R times mean of P."""
    p = np.array([[float(x) for x in joint] for joint in joints])
    moment = (points - points.mean(0)).T @ (p - p.mean(0))
    u, _, s = np.linalg.svd(moment)
    rotation = u @ np.diag([1, 1, np.linalg.det(u @ s)]) @ s
    return points.mean(0) - rotation @ p.mean(0), rotation


@pytest.mark.parametrize("count", [3, 5])
@pytest.mark.parametrize("radius", [ZERO, Fraction(1, 10**6), Fraction(1, 100)])
def test_every_reading_within_its_bounds_has_its_fit_in_the_box(count: int, radius: Fraction) -> None:
    random = Random(count)
    joints, position = SPACE[:count], vector(random)
    rotation = rotation_of((Fraction(2), *vector(random)))
    places = placed(joints, position, rotation, radius)
    found = fitted_pose(joints, places)
    bounds = [*found.position, *(x for row in found.rotation for x in row)]
    exact = [*position, *(x for row in rotation for x in row)]
    assert all(x.contains(value) for x, value in zip(bounds, exact, strict=True))
    assert max(float(x.width) for x in bounds) <= 200 * float(radius) + 1e-25
    draws = np.random.default_rng(count).choice([-1.0, 1.0], (20, count, 3)) * float(radius)
    middle = np.array([[float(x.midpoint) for x in place] for place in places])
    for draw in draws if radius else ():
        place, turn = best(joints, middle + draw)
        for x, value in zip(bounds, [*place, *turn.ravel()], strict=True):
            assert float(x.lo) - 1e-12 <= value <= float(x.hi) + 1e-12


def test_noise_that_asks_for_a_reflection_still_gives_the_best_rotation() -> None:
    joints = SPACE[:4]
    places = [(Interval(x, x), Interval(y, y), Interval(-z / 5, -z / 5)) for x, y, z in joints]
    found = fitted_pose(joints, places)
    points = np.array([[float(x.midpoint) for x in place] for place in places])
    _, rotation = best(joints, points)
    assert np.allclose([[float(x) for x in row] for row in found.rotation], rotation, atol=1e-9)
    assert np.linalg.det(rotation) == pytest.approx(1)


@pytest.mark.parametrize("seed", range(3))
def test_the_eigenvalues_are_the_roots_of_horns_quartic(seed: int) -> None:
    """l^4 - 2 |H|^2 l^2 - 8 det(H) l + det N, exactly; the largest root is in the bounds."""
    random = Random(seed)
    joints, targets = SPACE[: 3 + seed], [vector(random) for _ in range(3 + seed)]
    centre = [sum((p[k] for p in joints), ZERO) / len(joints) for k in range(3)]
    moments = [
        [sum((q[i] * (p[j] - centre[j]) for p, q in zip(joints, targets, strict=True)), ZERO) for j in range(3)]
        for i in range(3)
    ]
    h = fmpq_mat([[fmpq(x.numerator, x.denominator) for x in row] for row in moments])
    rows = [[h[i, j] for j in range(3)] for i in range(3)]
    n = horn_matrix(rows)  # type: ignore[arg-type]
    assert isinstance(n, arb_mat)
    exact = fmpq_mat(4, 4, [_entry(rows, i, j) for i in range(4) for j in range(4)])
    assert all(n[i, j].contains(exact[i, j]) for i in range(4) for j in range(4))
    norm = sum((x * x for x in h.entries()), fmpq(0))
    quartic = fmpq_poly([exact.det(), -8 * h.det(), -2 * norm, 0, 1])
    assert exact.charpoly() == quartic
    found = fitted_pose(joints, [(Interval(x, x), Interval(y, y), Interval(z, z)) for x, y, z in targets])
    low, high = (fmpq(x.numerator, x.denominator) for x in (found.eigenvalue.lo, found.eigenvalue.hi))
    assert quartic(low) * quartic(high) <= 0
    roots = [complex(root).real for root, _ in quartic.complex_roots()]
    assert max(roots) == pytest.approx(float(found.eigenvalue), rel=1e-9)
    if len(joints) == 3:
        assert h.det() == 0, "biquadratic"


def _entry(h: list[list[fmpq]], i: int, j: int) -> fmpq:
    """Of N by its definition: the quadratic form trace(R^T H), polarised."""

    def form(e: list[int]) -> fmpq:
        a, b, c, d = e
        rotation = [
            [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
        ]
        return sum((rotation[k][m] * h[k][m] for k in range(3) for m in range(3)), fmpq(0))

    one, other = ([int(k == place) for k in range(4)] for place in (i, j))
    both = [x + y for x, y in zip(one, other, strict=True)]
    return (form(both) - form(one) - form(other)) / 2


def test_angles_and_lengths_of_legs_are_enclosed() -> None:
    """v = i cos(f2) - (j sin(f1) + k cos(f1)) sin(f2), u.v = 0 for u = j cos(f1) - k sin(f1)."""
    base = (ONE, Fraction(2), Fraction(3))
    angles = Interval(Fraction(3, 10), Fraction(31, 100)), Interval(Fraction(-7, 5), Fraction(-139, 100))
    found = sensed_place(base, UNIT, angles, Interval(Fraction(5), Fraction(51, 10)))
    for first in (0.3, 0.305, 0.31):
        for second in (-1.4, -1.39):
            for length in (5, 5.1):
                v = (cos(second), -sin(first) * sin(second), -cos(first) * sin(second))
                assert v[1] * cos(first) - v[2] * sin(first) == pytest.approx(0)
                for x, start, part in zip(found, base, v, strict=True):
                    assert float(x.lo) - 1e-12 <= float(start) + length * part <= float(x.hi) + 1e-12
    assert max(float(x.width) for x in found) < 0.3
    with pytest.raises(InputError, match="triad: not three perpendicular"):
        sensed_place(base, UNIT[::-1], angles, Interval(ONE, ONE))


def test_what_is_not_proved_is_refused() -> None:
    line: list[Vector] = [(Fraction(k), Fraction(2 * k), ZERO) for k in range(4)]
    still = rotation_of((ONE, ZERO, ZERO, ZERO))
    origin = (ZERO, ZERO, ZERO)
    with pytest.raises(InputError, match="not on a line"):
        fitted_pose(line, placed(line, origin, still, ZERO))
    with pytest.raises(InputError, match="one best rotation"):
        fitted_pose(SPACE, placed(SPACE, origin, still, Fraction(4)))
    # A reflection of an equal-sided body: det(H) < 0 with two equal least singular values.
    cross: list[Vector] = [*UNIT, *((-x, -y, -z) for x, y, z in UNIT)]
    mirrored = placed(cross, origin, ((-ONE, ZERO, ZERO), *UNIT[1:]), ZERO)
    with pytest.raises(InputError, match="one best rotation"):
        fitted_pose(cross, mirrored)
    with pytest.raises(InputError, match="three at least"):
        fitted_pose(SPACE[:2], placed(SPACE[:2], origin, still, ZERO))

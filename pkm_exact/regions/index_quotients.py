"""Indices and actuator forces all over a region, as polynomials of its variables.

With rows r_i of legs, (r_i y)^2 = c_i q_i'^2 for a twist y in rational coordinates, K = J^T J = sum of r_i^T r_i / c_i.
Let P be the product of all c_i, and

    K_p = sum over i of r_i^T r_i times all other c_j:    K = K_p / P.

In ordinary coordinates, y_j = sqrt(k_j) t_j, with k = (1/g_1, 1/g_2, 1/g_3, 1/(g_2 g_3), 1/(g_3 g_1), 1/(g_1 g_2)),
turns multiplied by a length L:

    manipulability^2 = det J^T J = (product of k_j) det K_p / P^n
    transmission^2   = n^2 / (|J|^2 |J^-1|^2) = n^2 det K_p / (sum of k_j K_p,jj  sum of adj(K_p)_jj / k_j)

A load w is borne by forces s with sum of s_i r_i / sqrt(c_i) and the forces of the other constraints. By Cramer's rule
s_i = sqrt(c_i) d_i / d, d the determinant of all rows, d_i that with w in the place of row i. So |s_i| <= f exactly if
f^2 d^2 - c_i d_i^2 >= 0, where d is not 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any, Final

from pkm_exact.errors import InputError
from pkm_exact.regions.chart import Polynomial, PosePolynomials, rational
from pkm_exact.regions.placed_legs import PlacedLeg, exact_vector, without_squares
from pkm_exact.regions.region_determinants import determinant, leg_row
from pkm_exact.regions.region_legs import OnCrank, OnHinge, OnSlide, RegionMachine, product

INDEX_NAMES: Final = ("transmission", "manipulability")


@dataclass(frozen=True, eq=False)
class SpeedRow:
    """r_i on the freedoms, and c_i."""

    row: list[Any]
    square: Any


def speed_rows(machine: RegionMachine, pose: PosePolynomials, placed: Sequence[PlacedLeg]) -> list[SpeedRow]:
    """Rows and squares of all legs."""
    return [_speed_row(machine, pose, leg) for leg in placed]


def _speed_row(machine: RegionMachine, pose: PosePolynomials, leg: PlacedLeg) -> SpeedRow:
    row, n, g = leg_row(leg, pose, machine), pose.norm, machine.metric
    actuator = leg.leg.actuator
    if isinstance(actuator, OnHinge):
        raise InputError(f"conditions.indices: {leg.leg.name} is driven at its hinge, which this does not know")
    if isinstance(actuator, OnSlide):
        along = product(g, exact_vector(actuator.direction), leg.rod)
        return SpeedRow(row, without_squares(n * n * along * along, leg, pose))
    if isinstance(actuator, OnCrank) and leg.scale is not None:
        u, v = (product(g, exact_vector(axis), leg.rod) for axis in (actuator.at_0, actuator.at_90))
        cosine, sine = leg.value
        speed = cosine * v * rational(Fraction(1, actuator.weight)) - sine * u
        square = without_squares(speed * speed, leg, pose) * (n * n * actuator.weight)
        return SpeedRow([without_squares(entry * leg.scale, leg, pose) for entry in row], square)
    return SpeedRow(row, n * n * leg.value[0])


def weights_of(machine: RegionMachine, length: Fraction | None, kept: Sequence[int]) -> list[Fraction]:
    """k_j of the twist's components that are left, turns by the length.

    Raises
    ------
    InputError
        If there are translations and turns, and no length.
    """
    places = [machine.twist[j] for j in kept]
    if any(j < 3 for j in places) and any(j >= 3 for j in places) and length is None:
        raise InputError(
            "conditions.length: an index adds translations and turns; give the length that turns are times"
        )
    g1, g2, g3 = machine.metric
    found = [Fraction(1, w) for w in (g1, g2, g3, g2 * g3, g3 * g1, g1 * g2)]
    return [found[j] / ((length or 1) ** 2 if j >= 3 else 1) for j in places]


def index_square(
    name: str,
    machine: RegionMachine,
    pose: PosePolynomials,
    placed: Sequence[PlacedLeg],
    structure: Sequence[Sequence[Polynomial]],
    length: Fraction | None,
) -> tuple[Polynomial, Polynomial]:
    """Numerator and denominator, not negative, of the square of an index."""
    kept = _free(machine, structure)
    weights = weights_of(machine, length, kept)
    legs = speed_rows(machine, pose, placed)
    if len(legs) < len(kept):
        raise InputError(f"conditions.indices: {len(legs)} actuators for {len(kept)} freedoms")
    total = pose.constant(1)
    for leg in legs:
        total = _plain(total * leg.square, placed, pose)
    size = len(kept)
    matrix = [[pose.constant(0)] * size for _ in range(size)]
    for k, leg in enumerate(legs):
        others = pose.constant(1)
        for j, other in enumerate(legs):
            others = others * other.square if j != k else others
        for a in range(size):
            for b in range(a, size):
                entry = _plain(leg.row[kept[a]] * leg.row[kept[b]], placed, pose) * others
                matrix[a][b] = matrix[b][a] = _plain(matrix[a][b] + entry, placed, pose)
    whole = _plain(determinant(matrix, pose.constant(0)), placed, pose)
    if name == "manipulability":
        scale, power = Fraction(1), pose.constant(1)
        for weight in weights:
            scale, power = scale * weight, _plain(power * total, placed, pose)
        return whole * rational(scale), power
    trace = sum((matrix[a][a] * rational(weights[a]) for a in range(size)), pose.constant(0))
    minors = pose.constant(0)
    for a in range(size):
        rest = [j for j in range(size) if j != a]
        minor = determinant([[matrix[i][j] for j in rest] for i in rest], pose.constant(0))
        minors += minor * rational(1 / weights[a])
    return whole * (size * size), _plain(trace * _plain(minors, placed, pose), placed, pose)


def _plain(polynomial: Polynomial, placed: Sequence[PlacedLeg], pose: PosePolynomials) -> Polynomial:
    """With no y squared."""
    for leg in placed:
        polynomial = without_squares(polynomial, leg, pose)
    return polynomial


def _free(machine: RegionMachine, structure: Sequence[Sequence[Polynomial]]) -> list[int]:
    """The freedoms that the structure leaves, if it fixes coordinates only."""
    fixed = set()
    for row in structure:
        used = [j for j, entry in enumerate(row) if not entry.is_zero()]
        if len(used) != 1 or not row[used[0]].is_constant():
            raise InputError(
                "conditions.indices: known where joints that are not actuated fix coordinates, and no others"
            )
        fixed.add(used[0])
    return [j for j in range(len(machine.twist)) if j not in fixed]


def load_row(load: Sequence[Fraction], machine: RegionMachine) -> list[Fraction]:
    """A wrench on the freedoms, from ordinary into rational coordinates.

    Raises
    ------
    InputError
        If they are irrational.
    """
    g1, g2, g3 = machine.metric
    found = []
    for value, j in zip(load, machine.twist, strict=True):
        g = (g1, g2, g3, g2 * g3, g3 * g1, g1 * g2)[j]
        root = isqrt(g)
        if value and root * root != g:
            raise InputError(
                "conditions.forces.load: is not rational in the model's metric; use a model without metric"
            )
        found.append(value * root)
    return found


def force_polynomials(
    load: Sequence[Fraction],
    most: Fraction,
    machine: RegionMachine,
    pose: PosePolynomials,
    placed: Sequence[PlacedLeg],
    structure: Sequence[Sequence[Polynomial]],
) -> tuple[Polynomial, list[Polynomial]]:
    """d, and f^2 d^2 - c_i d_i^2 for every leg."""
    legs = speed_rows(machine, pose, placed)
    rows = [*(leg.row for leg in legs), *structure]
    if len(rows) != len(machine.twist):
        raise InputError(
            f"conditions.forces: {len(rows)} equations for {len(machine.twist)} freedoms; as many are needed"
        )
    zero = pose.constant(0)
    borne = [pose.constant(x) for x in load_row(load, machine)]
    whole = determinant(rows, zero)
    bound = _plain(whole * whole, placed, pose) * rational(most * most)
    found = []
    for k, leg in enumerate(legs):
        part = determinant([*rows[:k], borne, *rows[k + 1 :]], zero)
        square = _plain(part * part, placed, pose)
        found.append(bound - _plain(square * leg.square, placed, pose))
    return whole, found

"""Formulas of chapters 20 to 22 of *Parallel Manipulators* (2008) as identities: corrected where they are wrong."""

from fractions import Fraction
from itertools import combinations

import pytest
import sympy
from flint import fmpq_mat, fmpq_poly

from pkm_exact import Screw, ScrewSystem
from pkm_exact.geometry.joint_types import JointGeometry
from pkm_exact.geometry.linkage import Joint, Linkage
from pkm_exact.mobility.instantaneous_mobility import instantaneous
from pkm_exact.screws.exact_matrix import null_space, rank

HALVES = [Fraction(1, 3), Fraction(2, 5), Fraction(1), Fraction(7, 4), Fraction(-3, 2), Fraction(-1, 7)]
"""Tangents of half of an angle."""


def _turn(half: Fraction) -> tuple[Fraction, Fraction]:
    """Cosine and sine."""
    return (1 - half * half) / (1 + half * half), 2 * half / (1 + half * half)


@pytest.mark.parametrize("half", HALVES)
def test_the_condition_of_sarrus_constraints(half: Fraction) -> None:
    """Squares of singular values are 1 - |cos a| and 1 + |cos a|, each twice: the least condition 1 is at pi/2."""
    c, s = _turn(half)
    rows = [[0, 0, 0, 1], [1, 0, 0, 0], [0, 0, -s, c], [c, s, 0, 0]]  # forces x, y and moments y, z of four constraints
    table = [[sum((Fraction(a) * b for a, b in zip(x, y, strict=True)), Fraction(0)) for y in rows] for x in rows]
    found = fmpq_mat([[_flint(x) for x in row] for row in table]).charpoly()
    one, other = (fmpq_poly([_flint(-(1 + sign * c)), 1]) for sign in (1, -1))
    assert found == one * one * other * other
    assert (rank(rows, 4) == 4) is (s != 0)


def _flint(value: Fraction) -> object:
    from flint import fmpq

    return fmpq(value.numerator, value.denominator)


@pytest.mark.parametrize(("a", "b"), list(zip(HALVES, HALVES[1:] + HALVES[:1], strict=True)))
def test_the_speeds_of_a_four_bar_are_those_of_equation_28(a: Fraction, b: Fraction) -> None:
    first, second, third = Fraction(7), Fraction(3), Fraction(5)
    (ca, sa), (cb, sb) = _turn(a), _turn(b)
    crank = (second * ca, second * sa, Fraction(0))
    rocker = (first + third * cb, third * sb, Fraction(0))
    points = [(Fraction(0),) * 3, crank, rocker, (first, Fraction(0), Fraction(0))]
    up = ((Fraction(0), Fraction(0), Fraction(1)),)
    bodies = ("base", "crank", "coupler", "rocker")
    joints = tuple(
        Joint(f"j{k}", "R", (bodies[k], bodies[(k + 1) % 4]), JointGeometry(points[k], up)) for k in range(4)
    )
    (speeds,) = instantaneous(Linkage("four-bar", "1", "a test", bodies, joints, "base", "rocker")).speeds
    sine = sa * cb - ca * sb  # of a - b
    ratio = second * (first * sa + third * sine) / (third * (first * sb + second * sine))
    assert -speeds[3] == ratio * speeds[0]


def test_equation_27_has_equation_28_as_its_derivative() -> None:
    a, b, l1, l2, l3 = sympy.symbols("a b l1 l2 l3")
    closed = (l3 * sympy.cos(b) + l1 - l2 * sympy.cos(a)) ** 2 + (l3 * sympy.sin(b) - l2 * sympy.sin(a)) ** 2
    above = l2 * (l1 * sympy.sin(a) + l3 * sympy.sin(a - b))
    below = l3 * (l1 * sympy.sin(b) + l2 * sympy.sin(a - b))
    assert sympy.simplify(closed.diff(a) * below + closed.diff(b) * above) == 0


def test_the_equations_of_the_inverted_pendulum_with_their_signs() -> None:
    """(25) row 1 must have cos with the acceleration and -sin with the squared speed; printed the other way round."""
    t, big, m, length, g, force = sympy.symbols("t M m l g F")
    x, th = sympy.Function("x")(t), sympy.Function("th")(t)
    place = sympy.Matrix([x + length * sympy.sin(th), length * sympy.cos(th)])
    kinetic = big * x.diff(t) ** 2 / 2 + m * place.diff(t).dot(place.diff(t)) / 2
    lagrangian = kinetic - m * g * place[1]
    first = lagrangian.diff(x.diff(t)).diff(t) - lagrangian.diff(x)
    sine, cosine = sympy.sin(th), sympy.cos(th)
    corrected = (big + m) * x.diff(t, 2) + m * length * (th.diff(t, 2) * cosine - th.diff(t) ** 2 * sine)
    printed = (big + m) * x.diff(t, 2) + m * length * (th.diff(t, 2) * sine + th.diff(t) ** 2 * cosine)
    assert sympy.simplify(first - corrected) == 0
    assert sympy.simplify(first - printed) != 0
    assert sympy.simplify(lagrangian.diff(th) - m * length * (g - x.diff(t) * th.diff(t)) * sine) == 0
    assert force not in first.free_symbols


@pytest.mark.parametrize("tilt", [(0, 0, 1), (3, 0, 4), (-2, 5, 7)])
def test_the_force_of_a_leg_of_5_rrr_rr_is_along_its_parallel_hinges(tilt: tuple[int, int, int]) -> None:
    """5-(RRR)RR: not the base's vertical, as the source says, but what the platform's hinges are parallel to."""
    center, others = (0, 0, 0), [(4, 1, 30), (-2, 7, 35)]
    about = [Screw.line(center, axis) for axis in ((1, 0, 0), (3, 4, 1), (0, 2, 5))]
    leg = ScrewSystem.span([*about, *(Screw.line(point, tilt) for point in others)])
    assert leg.reciprocal() == ScrewSystem.span([Screw.line(center, tilt)])


def test_the_force_of_a_leg_with_two_centers_is_along_their_line() -> None:
    """5-(RRR)(RR): through both, so that their distance stays."""
    base, platform = (0, 0, 0), (3, -4, 30)
    about = [Screw.line(base, axis) for axis in ((1, 0, 0), (0, 1, 0), (1, 1, 3))]
    leg = ScrewSystem.span([*about, *(Screw.line(platform, axis) for axis in ((2, 0, 1), (0, 5, 1)))])
    assert leg.reciprocal() == ScrewSystem.span([Screw.line(base, platform)])


def test_thumb_and_virtual_finger_have_three_internal_forces_before_the_twist() -> None:
    """Chapter 20, in the plane, with forces and a moment of each of the two contacts."""
    points = [(-3, 0), (3, 1)]
    columns = []
    for x, y in points:
        columns += [(1, 0, -y), (0, 1, x), (0, 0, 1)]
    rows = [list(row) for row in zip(*columns, strict=True)]
    internal = null_space(rows, 6)
    assert (rank(rows, 6), len(internal)) == (3, 3)
    assert all(sum(row[k] * vector[k] for k in range(6)) == 0 for row in rows for vector in internal)


def test_the_cosine_of_24_degrees_is_algebraic_of_degree_four() -> None:
    """The arc of 5-RRR(RR): one quadratic extension does not have it, so that exact models turn it a little."""
    from flint import arb, fmpz_poly

    quartic = fmpz_poly([1, 8, -16, -8, 16])
    assert quartic.factor()[1] == [(quartic, 1)]
    assert quartic(arb.cos_pi(arb(24) / 180)).contains(0)
    others = [(arb.cos_pi(arb(24 * k) / 180)) for k in (2, 4, 7)]
    assert all(quartic(value).contains(0) for value in others)
    assert not any(left.overlaps(right) for left, right in combinations([*others, arb.cos_pi(arb(24) / 180)], 2))

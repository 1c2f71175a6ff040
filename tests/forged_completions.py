"""Certificates that are called complete but are not: a pose is left out beside multiple ones, or one counts for two."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import cache
from math import prod
from typing import Any

from flint import fmpq_poly, fmpz_poly
from forged_multiplicities import honest
from forged_representations import fit_real_poses, representation_through, set_representation

from pkm_exact import Robot, certificate, solve
from pkm_exact.certify import pure
from pkm_exact.certify.checker.solutions import primes_for

Content = dict[str, Any]
ROOT = fmpq_poly([0, 1])


def polynomials(content: Content) -> list[fmpq_poly]:
    """(h, E, F) of a certificate."""
    part = content["representation"]
    rows = (part["eliminant"], *part["quaternion"], *part["translation"])
    return [fmpq_poly(fmpz_poly([int(c, 16) for c in row])) for row in rows]


def with_representation(content: Content, rows: Sequence[fmpq_poly]) -> Content:
    """The certificate with other (h, E, F) in the same chart and with the same separating form."""
    found, part = {**content}, content["representation"]
    set_representation(found, rows, part["separating_form"])
    found["representation"] = {**found["representation"], "chart": part["chart"]}
    return found


def without_factor(content: Content, factor: fmpz_poly, multiplicity: int | None) -> Content:
    """The certificate without the solutions at the roots of a factor of h, and their poses; not called complete."""
    f = fmpq_poly(factor)
    h, *numerators = polynomials(content)
    left, rest = divmod(h, f)
    assert rest == 0
    # At the other roots h' = f left'.
    inverse = (f % left).xgcd(left)[1] if left.degree() else fmpq_poly([1])
    found = with_representation(content, [left, *(x * inverse % left for x in numerators)])
    fit_real_poses(found, multiplicity)
    return found


def without_root(content: Content, root: Fraction) -> Content:
    """The same for a rational root."""
    return without_factor(content, fmpz_poly([-root.numerator, root.denominator]), None)


def called_complete(content: Content, elimination: Any, total: int, double: Sequence[Fraction]) -> Content:
    """By an elimination that leaves so many monomials, with the poses at these parameters double."""
    poses = []
    for pose in content["poses"]:
        low, high = map(Fraction, pose["parameter"])
        poses.append({**pose, "multiplicity": 1 + any(low <= root <= high for root in double)})
    complete = {"claim": "complete", "completeness_route": "exact-elimination", "elimination": elimination}
    return {**content, **complete, "complex_solutions": total, "poses": poses}


# A pose left out


@cache
def _with_a_double_pose() -> Content:
    """Three poses, 1, 9 and -23 by their parameters; that at 9 is double."""
    turned = ((0, 1, 0), (-1, 0, 0), (0, 0, 1))
    base, platform = ((-2, 1, 0), (1, 1, 0), (-1, 0, 0)), ((1, 1, 0), (1, 1, 0), (2, 0, 0))
    return honest("3-RPR", base, platform, (turned, (1, 0, 0)))


def _left_out(root: int, *double: int) -> Content:
    content = _with_a_double_pose()
    left = without_root(content, Fraction(root))
    return called_complete(left, content["elimination"], 4, [Fraction(place) for place in double])


# A pose that no prime proves simple, counted twice


Point = tuple[Fraction, Fraction]
AT_ROOT: list[int] = [0, 1]
"""The polynomial T."""
PRIMES = {"first": list(primes_for(fmpz_poly(AT_ROOT))), "plain": list(pure.good_primes(AT_ROOT))}
"""All those by which each checker asks whether the poses at the parameter 0 are simple."""


def _direction(half_tangent: Fraction) -> Point:
    square = half_tangent * half_tangent
    return (1 - square) / (1 + square), 2 * half_tangent / (1 + square)


def _pose(half_tangent: Fraction, place: Point) -> tuple[Sequence[Fraction], Sequence[Fraction]]:
    """(e, f) of a planar pose."""
    (x, y), t, zero = place, half_tangent, Fraction(0)
    return (Fraction(1), zero, zero, t), (zero, x + t * y, y - t * x, zero)


def _far_apart(distance: int, turn: Fraction) -> tuple[Robot, list[Fraction]]:
    """Two legs end in the platform's origin, at (1, 2) or (1, -2); the third one is at distance 1 from it.

    It is stretched at the second place, where a pose with tan(angle / 2) = ``turn`` is double; at the first are two.

    One has R = 1. The determinant of the legs there has the distance of the first base joints as a factor.
    """
    (x, y), n = (Fraction(1), Fraction(2)), _direction(turn)
    reach = n[0] - 1, n[1] - 2 * y  # from where the third joint is at R = 1 to where it is at the double pose
    length = -(reach[0] ** 2 + reach[1] ** 2) / (2 * (n[0] * -1 + n[1] * -2 * y + 1))
    third = x + (1 + length) * n[0], -y + (1 + length) * n[1]
    zero, d = Fraction(0), Fraction(distance)
    base = ((zero, zero, zero), (d, zero, zero), (*third, zero))
    platform = ((zero, zero, zero), (zero, zero, zero), (Fraction(1), zero, zero))
    squares = [x * x + y * y, (d - x) ** 2 + y * y, length * length]
    return Robot("made up", "3-RPR", "m", "made up", base, platform), squares


@cache
def _counted_twice(checker: str, turn: Fraction, *, all_poses: bool = False) -> Content:
    """The pose with R = 1 counts for two instead of the other one at its place; or an honest certificate."""
    robot, squares = _far_apart(prod(PRIMES[checker]), turn)
    content = certificate(robot, None, solve(robot.problem(squares)))
    if all_poses:
        return content
    listed = {**content}
    poses = [_pose(Fraction(0), (Fraction(1), Fraction(2))), _pose(turn, (Fraction(1), Fraction(-2)))]
    set_representation(listed, representation_through([Fraction(0), turn], poses), (0, 0, 0, 1, 0, 0, 0, 0))
    fit_real_poses(listed, None)
    return called_complete(listed, content["elimination"], 4, [Fraction(0), turn])


Case = tuple[Callable[[], Content], str, str]
NOT_FILLED = "elimination: it leaves 4 monomials, the solutions are not proved to fill them"
COMPLETIONS: dict[str, Case] = {
    "a simple pose is left out beside a double one": (lambda: _left_out(1, 9), "rejected", NOT_FILLED),
    "another one is left out": (lambda: _left_out(-23, 9), "rejected", NOT_FILLED),
    "both that are left count for two": (lambda: _left_out(1, 9, -23), "rejected", NOT_FILLED),
    "the double pose is left out": (lambda: _left_out(9), "rejected", "elimination: it leaves 4 monomials, but the 2"),
    **{
        f"a pose that no prime of the {checker} checker proves simple counts for two, double at {turn}": (
            lambda checker=checker, turn=turn: _counted_twice(checker, turn),  # type: ignore[misc]
            "rejected",
            NOT_FILLED,
        )
        for checker in PRIMES
        for turn in (Fraction(1, 2), Fraction(3))
    },
    **{
        f"a pose that no prime of the {checker} checker proves simple": (
            lambda checker=checker: _counted_twice(checker, Fraction(1, 2), all_poses=True),  # type: ignore[misc]
            "accepted",
            "",
        )
        for checker in PRIMES
    },
}

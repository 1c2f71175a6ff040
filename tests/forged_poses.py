"""Forged and honest certificates around single conditions on representations, of few rational poses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import prod
from typing import Any

from certificate_subjects import Content, subject
from flint import fmpq_poly
from forged_representations import fit_real_poses, set_representation
from forgeries import FIRST_PRIMES, as_witnesses

from pkm_exact.certify import pure
from pkm_exact.certify.checker import solutions
from pkm_exact.certify.checker.study_motion import Leg, leg_form, motion

NONE: Any = fmpq_poly()
ONE = fmpq_poly([1])
ROOT = fmpq_poly([0, 1])
Numbers = Sequence[Fraction | int]

SIX = ((0, 0, 0), (7, 1, 0), (5, 6, 2), (-3, 5, 1), (-6, -2, 3), (1, -7, -2))
"""Joints in no special position."""


def _robot(content: Content, base: Sequence[Numbers], platform: Sequence[Numbers], squares: Numbers) -> Content:
    joints = [[[str(Fraction(x)) for x in joint] for joint in side] for side in (base, platform)]
    robot = {**content["robot"], "metric": ["1", "1", "1"], "base": joints[0], "platform": joints[1]}
    return {**content, "robot": robot, "configuration": {"name": None, "lengths_squared": [str(x) for x in squares]}}


def squares_at(base: Sequence[Numbers], platform: Sequence[Numbers], e: Numbers, f: Numbers) -> list[Fraction]:
    """The squared lengths with which the forms of all legs vanish at (e, f), a pose or not."""
    placed = motion([Fraction(x) for x in e], [Fraction(x) for x in f], (1, 1, 1))
    found = []
    for a, b in zip(base, platform, strict=True):
        form = leg_form(Leg(_point(a), _point(b), Fraction(0)), (1, 1, 1))
        value = sum((x * y for x, y in zip(form, placed.coordinates(), strict=True)), Fraction(0))
        found.append(value / form[-1] / placed.norm)
    return found


def _point(joint: Numbers) -> tuple[Fraction, Fraction, Fraction]:
    x, y, z = map(Fraction, joint)
    return x, y, z


def _with(
    content: Content, h: fmpq_poly, chart: Sequence[int], numerators: Sequence[Any], form: Sequence[int]
) -> Content:
    """A representation without real roots, or whose real poses are not listed."""
    content = {**content}
    set_representation(content, [h, *numerators], form)
    content["representation"] = {**content["representation"], "chart": list(chart)}
    return {**content, "poses": [], "real_poses": 0, "box_exponent": 0, "krawczyk": None, "method": "exact"}


def held(h: fmpq_poly, chart: Sequence[int], e: Sequence[Any], f: Sequence[Any], form: Sequence[int]) -> Content:
    """A platform whose joints are one point, the origin, that stays in the origin: all e are poses, with f = 0."""
    base = [(3, 4, 0), (0, 5, 0), (-4, 3, 0), (0, 3, 4), (5, 0, 0), (0, 0, 5)]
    content = _robot(subject("not proven complete"), base, [(0, 0, 0)] * 6, [25] * 6)
    return _with(content, h, chart, [*e, *f], form)


def two_roots(**numerators: Any) -> Content:
    """Two complex poses of such a platform, e = (1, t, -1, 0) / t; some numerators can be others."""
    h = ROOT * ROOT + 1
    e = [numerators.get(f"e{k}", value) for k, value in enumerate((ONE, 2 * ROOT, fmpq_poly([-2]), NONE))]
    f = [numerators.get(f"f{k}", NONE) for k in range(4)]
    return held(h, (0, 1, 0, 0), e, f, (0, 0, 1, 0, 0, 0, 0, 0))


def _negated(content: Content) -> Content:
    part = content["representation"]
    rows = {key: [[hex(-int(c, 16)) for c in row] for row in part[key]] for key in ("quaternion", "translation")}
    return {**content, "representation": {**part, **rows, "eliminant": [hex(-int(c, 16)) for c in part["eliminant"]]}}


def twice_each() -> Content:
    """Two poses, the double roots of (t^2 + 1)^2, counted as four: there w.E = 0 = h', but E is not 0."""
    h = (ROOT * ROOT + 1) ** 2
    e = [h.derivative(), -4 * (ROOT * ROOT + 1), ONE, NONE]
    return held(h, (1, 0, 0, 0), e, [NONE] * 4, (0, 1, 0, 0, 0, 0, 0, 0))


def no_motion() -> Content:
    """All six legs have the forms of their lengths at (e, f), but e.f is not 0."""
    e, f = (1, 0, 0, 0), (Fraction(1, 2), 1, 2, 20)
    platform = [(x + 1, y, z - 2) for x, y, z in SIX[::-1]]
    squares = squares_at(SIX, platform, e, f)
    return single(_robot(subject("not proven complete"), SIX, platform, squares), e, f)


def no_motion_far_from_integers() -> Content:
    """The root is -10, e = (1, 0, 0, 0) and e.f = 1: less than the value of h at the integer -1, 9."""
    f = (1, 1, 2, 20)
    return _unturned(ROOT + 10, f, [_constant(x) for x in f], (-10, 0, 0, 0, 0, 0, 0, 0))


def too_long_and_0_at_an_integer() -> Content:
    """At the root, 0, f3 = t + 1 is 1. The lengths are those without it; at the integer -1 it is 0 indeed."""
    f = (0, 1, 2, 0)
    return _unturned(ROOT, f, [*map(_constant, f[:3]), ROOT + 1], [0] * 8)


def _unturned(h: fmpq_poly, f: Numbers, numerators: Sequence[Any], form: Sequence[int]) -> Content:
    """One rational pose with e = (1, 0, 0, 0): legs have the forms of their lengths at f."""
    e = (1, 0, 0, 0)
    content = _robot(subject("not proven complete"), SIX, SIX[::-1], squares_at(SIX, SIX[::-1], e, f))
    content = _with(content, h, e, [*map(_constant, e), *numerators], form)
    content["box_exponent"] = 31
    fit_real_poses(content, 1)
    return content


def no_two_motions(*others: Any) -> Content:
    """Joints of the platform in one point, e = f = (2 t, -2, ..): all legs have their lengths, but e.f = N(e)."""
    e = [2 * ROOT, -2 * ONE, *others]
    content = held(ROOT * ROOT + 1, (1, 0, 0, 0), e, e, (0, 1, 0, 0, 0, 0, 0, 0))
    return {**content, "configuration": {"name": None, "lengths_squared": ["26"] * 6}}


def single(content: Content, e: Numbers, f: Numbers) -> Content:
    """One rational pose, the root of t, in the chart of its first coordinate that is not 0; called simple."""
    place = next(k for k, x in enumerate(e) if x)
    chart = [int(k == place) for k in range(4)]
    content = _with(content, ROOT, chart, [_constant(x) for x in (*e, *f)], [0] * 8)
    content["box_exponent"] = 31
    fit_real_poses(content, 1)
    return content


def _constant(x: Fraction | int) -> Any:
    value = Fraction(x)
    return fmpq_poly([value.numerator], value.denominator) if value else NONE


def out_of_plane(e: Numbers, f: Numbers) -> Content:
    """Three legs have their lengths where the platform is turned over, or lifted out of its plane."""
    base, platform = [(0, 0, 0), (9, 0, 0), (3, 8, 0)], [(1, 1, 0), (4, 2, 0), (2, 5, 0)]
    content = _robot(subject("planar, multiple solutions"), base, platform, squares_at(base, platform, e, f))
    return single(content, e, f)


def with_roots_alike(factor: int) -> Content:
    """Three witnesses of a motion, whose parameters are the same modulo a number."""
    h = ROOT * (ROOT - factor) * (ROOT - 2 * factor)
    e = [h.derivative(), ROOT * h.derivative() - 3 * h, NONE, NONE]
    return as_witnesses(held(h, (1, 0, 0, 0), e, [NONE] * 4, (0, 1, 0, 0, 0, 0, 0, 0)))


LAST_PRIMES = prod(solutions.PRIMES[:-1]) * prod(pure.PRIMES[:-1])
"""A number that is 0 modulo all primes that a checker tries, but for the last."""

Case = tuple[Callable[[], Content], str, str]
POSES: dict[str, Case] = {
    "two complex poses of a platform held in one point": (two_roots, "accepted", ""),
    "the leading coefficient is negative": (lambda: _negated(two_roots()), "rejected", "eliminant"),
    "two poses are counted as four": (twice_each, "rejected", "eliminant: not proved squarefree"),
    **{
        f"{name} has the degree of the eliminant": (
            lambda name=name, less=less: two_roots(**{name: ROOT * ROOT + 1 + less}),  # type: ignore[misc]
            "rejected",
            "representation",
        )
        for name, less in (("e0", 1), ("e3", 0), ("f0", 0), ("f1", 0), ("f2", 0), ("f3", 0))
    },
    "f3 has the degree of h, and 0 at an integer": (
        too_long_and_0_at_an_integer,
        "rejected",
        "representation",
    ),
    "no first prime tells the roots apart": (lambda: with_roots_alike(FIRST_PRIMES), "accepted", ""),
    "only the last prime tells the roots apart": (lambda: with_roots_alike(LAST_PRIMES), "accepted", ""),
    "e.f is not 0": (no_motion, "rejected", "motion: e.f"),
    "e.f is not 0, and smaller than h at an integer": (no_motion_far_from_integers, "rejected", "motion: e.f"),
    # At -2, -1 and 0, e.f is 69, 29, 29 and 5, 5, 13 times t^2 + 1.
    "e.f is not 0, the same multiple of h at all integers but the first": (
        lambda: no_two_motions(10 * ROOT + 5, 5 * ROOT),
        "rejected",
        "motion: e.f",
    ),
    "e.f is not 0, the same multiple of h at all integers but the last": (
        lambda: no_two_motions(-2 * ROOT - 3, ROOT),
        "rejected",
        "motion: e.f",
    ),
    **{
        f"a planar robot with {name}": (
            lambda e=e, f=f: out_of_plane(e, f),  # type: ignore[misc]
            "rejected",
            "motion: e1, e2, f0 and f3",
        )
        for name, e, f in (
            ("e1", (0, 1, 0, 0), (0, 0, 0, 0)),
            ("e2", (0, 0, 1, 0), (0, 0, 0, 0)),
            ("f0", (0, 0, 0, 1), (2, 0, 0, 0)),
            ("f3", (1, 0, 0, 0), (0, 0, 0, 2)),
        )
    },
}

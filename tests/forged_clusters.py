"""Certificates with a representation that is hard to compute with: parameters in clusters, or equal modulo primes.

The parameters are chosen; what is listed are poses of the robot, with their coordinates: most are honest.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache, partial
from math import prod

from certificate_subjects import Content
from certificate_tools import golden
from flint import fmpq_poly, fmpz_poly
from forged_completions import Point, _direction, _pose, called_complete
from forged_margins import ALIKE, BASES, PLATFORMS, _held_poses, in_version_1, leg_through
from forged_neighbours import _turned
from forged_representations import fit_real_poses, representation_through, set_representation, turning
from held_mechanisms import KEYS, Pose, listing

from pkm_exact import Robot, certificate, solve
from pkm_exact.certify import pure
from pkm_exact.certify.checker.solutions import primes_for

Case = tuple[Callable[[], Content], str]
REJECTED, ACCEPTED = "rejected", "accepted"
T = fmpz_poly([0, 1])


def _cluster(sign: int, gap: int, exponent: int) -> Content:
    """Angles with half tangents 1, 1 + 2 e and 1 + 3 sign e, e = 2^-gap: h' is 6 sign at 1, in units of 2^-2gap."""
    unit = 1 << gap
    content = turning((T - 1) * (unit * T - unit - 2) * (unit * T - unit - 3 * sign), exponent)
    fit_real_poses(content, None)
    return content


# Roots, and what is enclosed there

ROOTS: dict[str, Case] = {
    **{
        f"three parameters in a cluster, a slope whose bounds begin or end at 0, sign {sign}": (
            partial(_cluster, sign, 140, 18),
            REJECTED,
        )
        for sign in (1, -1)
    },
    "a dyadic root beside which the secant ends": (
        lambda: _turned(((1 << 27) * T - 527858757) * (T + 532) * (T - 532 * 532 - 7)),
        ACCEPTED,
    ),
    "a dyadic root beside 3 that is told from it on a coarser grid": (
        lambda: _turned((T - 3) * ((1 << 60) * T - (3 << 60) + (1 << 20) + 1)),
        ACCEPTED,
    ),
    "orientations in a cluster, one coordinate apart": (
        lambda: _held_poses(
            [(1, 1 + n * Fraction(1, 1 << 140), 0, far << 20) for n, far in ((0, 0), (2, 1), (3, 2))], 28
        ),
        ACCEPTED,
    ),
    "orientations that differ in r33 alone, in the other order": (
        lambda: _held_poses([(e[0], -e[1], e[2], e[3]) for e in ALIKE], 4),
        ACCEPTED,
    ),
}


# Numbers modulo primes


def _congruent(gap: int) -> Content:
    """Two poses of three legs, with half tangents 0 and ``gap``."""
    poses = [Pose((1, 0, 0, 0), (0, 0, 3, 0)), Pose((1, 0, 0, gap), (0, 1, 2, 0))]
    legs = [leg_through(poses, b, a) for b, a in zip(PLATFORMS, BASES, strict=True)]
    points = [(pose.e, pose.f) for pose in poses]
    content = listing("planar", poses[:1], legs, 1)
    set_representation(content, representation_through([Fraction(0), Fraction(gap)], points), (0, 0, 0, 1, 0, 0, 0, 0))
    content["poses"] = []
    fit_real_poses(content, 1)
    return in_version_1(content, legs)


def _moved(name: str, n: int, sign: int = 1) -> Content:
    """A golden certificate of multiple poses, with the parameters n + T, or n - T."""
    content = {key: value for key, value in golden(name).items() if key != "digest"}
    part, poses = content["representation"], content["poses"]
    rows = [
        fmpq_poly(fmpz_poly([int(c, 16) for c in row]))
        for row in (part["eliminant"], *part["quaternion"], *part["translation"])
    ]
    kept = {key: content[key] for key in ("claim", "completeness_route", "elimination", "complex_solutions")}
    form = [sign * c + n * w for c, w in zip(part["separating_form"], [*part["chart"], 0, 0, 0, 0], strict=True)]
    h, *numerators = (row(fmpq_poly([-sign * n, sign])) for row in rows)
    lead = 1 if h[h.degree()] > 0 else -1
    set_representation(content, [lead * h, *(sign * lead * row for row in numerators)], form)
    content |= kept
    fit_real_poses(content, 1)
    listed = zip(content["poses"], poses, strict=True)
    return content | {"poses": [{**pose, "multiplicity": old["multiplicity"]} for pose, old in listed]}


def _with_inverse(scale: int, number: int) -> Content:
    """A translation at x = 1 / q, where q and 2^n - 1 have a factor in common, for n = 1399 of the plain checker."""
    pose = Pose((1, 0, 0, 0), (0, Fraction(1, number), 2, 5))
    primes = prod({*primes_for(fmpz_poly([-1, number])), *pure.good_primes([-1, number])})
    normals = [(primes * scale, 0, 0), (0, primes, 0), (0, 0, primes), (0, primes, primes)]
    position = pose.quantities()[0]
    forms = []
    for place, row in enumerate(normals):
        sphere = int(place == 1)
        normal = [Fraction(x) - 2 * c * sphere for x, c in zip(row, position, strict=True)]
        forms.append(pose.linear([sphere, 0, 0, 0, *normal, *[0] * 9]))
    content = listing("translation", [pose], forms)
    rows = representation_through([Fraction(1, number)], [(pose.e, pose.f)])
    set_representation(content, rows, (0, 0, 0, 0, 0, 1, 0, 0))
    content["poses"] = []
    fit_real_poses(content, 1)
    return {key: content[key] for key in KEYS}


def _far_roots() -> Content:
    """Two of four simple poses, at (0, y) and (0, -y), each called double: the gradients are 0 modulo all primes tried.

    Those of the form with C1 are 0 modulo 2^643 - 1 as well, by h' = 8 T in all numerators. So large a bound is greater
    than the sizes of the numerators alone; the parameters, which are as great, must enter it by their powers.
    """
    y = Fraction((1 << 643) - 1, 2)
    poses = [Pose((1, 0, 0, 0), (0, 0, c, 0)) for c in (y, -y)]
    large = prod(pure.good_primes([-(y.numerator**2), 0, 4]))
    first, square, turn, beside = (
        {4: large},
        {0: large},
        {7: 2 * large, 10: large},  # R11 = 1 or 3/5
        {1: large, 2: 2 * large, 5: -2 * large},
    )
    forms = [poses[0].linear([form.get(k, int(k == 15)) for k in range(16)]) for form in (first, square, turn, beside)]
    content = listing("planar", poses, forms, 2, 2, form=(0, 0, 0, 0, 0, 0, 1, 0))
    steps = [[f"{i} {j}" for i in range(4) for j in range(3)]]
    return content | {"claim": "complete", "completeness_route": "exact-elimination", "elimination": steps}


MODULO: dict[str, Case] = {
    "two of four poses as double ones, at parameters of 643 bits": (_far_roots, REJECTED),
    "parameters that are equal modulo 2^61 - 1": (partial(_congruent, (1 << 61) - 1), ACCEPTED),
    "a parameter without an inverse modulo 2^1399 - 1": (partial(_with_inverse, 1 << 17, 28875361), ACCEPTED),
    **{
        f"{name}, parameters greater by {n}": (partial(_moved, name, n), ACCEPTED)
        for name in ("3-rpr-triple", "3-rpr-double-q")
        for n in (10**6, 10**9)
    },
    "3-rpr-triple, parameters of the other sign": (partial(_moved, "3-rpr-triple", 1, -1), ACCEPTED),
}


# A factor that is right modulo a prime alone

SMALL, HALF = Fraction(3), Fraction(1, 2)
LARGE = SMALL + (1 << 127) - 1


def _lines_dependent_beside() -> tuple[Robot, list[Fraction], list[tuple[Fraction, Point]]]:
    """Two legs end in the platform's origin, at (0, 0) or at d; the third one, as the parameter is LARGE, is stretched.

    The parameter is the half tangent: 0 and HALF at (0, 0). The numerators at SMALL, which is LARGE modulo 2^127 - 1,
    have dependent lines: that is linear in d and in the distance of the third base joint from d.
    """
    angles = Fraction(0), HALF, LARGE
    weights = [prod(SMALL - other for other in angles if other != t) for t in angles]
    e0, e3 = sum(weights), sum((w * t for w, t in zip(weights, angles, strict=True)), Fraction(0))
    arm, norm = (e0 * e0 - e3 * e3, 2 * e0 * e3), e0 * e0 + e3 * e3
    along = _direction(LARGE)

    def moment(shift: Point, reach: Fraction) -> Fraction:
        """Of the third leg about the platform's origin."""
        f1, f2 = (weights[2] * x for x in (shift[0] + LARGE * shift[1], shift[1] - LARGE * shift[0]))
        place = e0 * f1 - e3 * f2, e0 * f2 + e3 * f1
        line = [c - norm * (s + reach * n) for c, s, n in zip(place, shift, along, strict=True)]
        return arm[0] * line[1] - arm[1] * line[0]

    one, zero = Fraction(1), Fraction(0)
    ends = ((one, zero), zero), ((zero, one), zero), ((zero, zero), one)
    a, b, c = (moment(*end) / (LARGE - SMALL) for end in ends)
    (d, e, f) = -HALF, one, along[1] - HALF * along[0]  # the third base joint is in the direction of HALF from (0, 0)
    shift, reach = (b * f - c * e, c * d - a * f), a * e - b * d
    third = [s + reach * n for s, n in zip(shift, along, strict=True)]
    arm_length = (reach**2 - third[0] ** 2 - third[1] ** 2) / (2 * (reach - third[0]))
    base = [(shift[0] / 2 - k * shift[1], shift[1] / 2 + k * shift[0], zero) for k in (1, 2)]
    robot = Robot(
        "made up", "3-RPR", "m", "made up", (*base, (*third, zero)), (*[(zero,) * 3] * 2, (arm_length, zero, zero))
    )
    squares = [*(x * x + y * y for x, y, _ in base), (reach - arm_length) ** 2]
    return robot, squares, [(zero, (zero, zero)), (HALF, (zero, zero)), (LARGE, shift)]


@cache
def _beside(multiplicity: int) -> Content:
    """All poses, of which that at LARGE, double, is said to have this multiplicity."""
    robot, squares, places = _lines_dependent_beside()
    content = certificate(robot, None, solve(robot.problem(squares)))
    elimination = content["elimination"]
    poses = [_pose(t, place) for t, place in places]
    set_representation(content, representation_through([t for t, _ in places], poses), (0, 0, 0, 1, 0, 0, 0, 0))
    fit_real_poses(content, None)
    return called_complete(content, elimination, 4, [LARGE] if multiplicity == 2 else [])


BESIDE: dict[str, Case] = {
    f"lines that are dependent beside a double pose, multiplicity {m}": (partial(_beside, m), status)
    for m, status in ((1, REJECTED), (2, ACCEPTED))
}
CLUSTERS: dict[str, Case] = {**ROOTS, **MODULO, **BESIDE}

"""Forged certificates, each false or misspelled in one respect that one check sees, and honest ones close to them.

Digests are computed anew, and everything else is as it must be: what is forged here is told from the truth by one
condition of the checkers only. The honest ones lie just on the other side of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isqrt
from typing import Any

from certificate_subjects import Content, subject
from flint import fmpq_poly
from forged_representations import fit_real_poses, representation_through, set_representation, sliding

from pkm_exact.certify import pure
from pkm_exact.certify.checker import solutions


@dataclass(frozen=True)
class Forgery:
    """A certificate, what both checkers must say of it, and how the reason begins."""

    make: Callable[[], Content]
    status: str = "rejected"
    reason: str = ""


UNTURNED = (Fraction(1), Fraction(0), Fraction(0), Fraction(0))
TRIANGLE = [["0", "0", "0"], ["4", "0", "0"], ["0", "4", "0"]]
ROOT = fmpq_poly([0, 1])
NONE = fmpq_poly()


def on_circle(
    places: Sequence[tuple[Fraction, Fraction]], form: Sequence[int], exponent: int = 31, square: Fraction | None = None
) -> Content:
    """Unturned poses, at these places on a circle, of a planar robot whose base and platform are one triangle.

    The parameter is the combination of 1, C1 and C2 that ``form`` gives.
    """
    content = subject("planar, multiple solutions")
    square = places[0][0] ** 2 + places[0][1] ** 2 if square is None else square
    content = {**content, "robot": {**content["robot"], "base": TRIANGLE, "platform": TRIANGLE}}
    content["configuration"] = {"name": None, "lengths_squared": [str(square)] * 3}
    parameters = [form[0] + form[1] * x + form[2] * y for x, y in places]
    points = [(UNTURNED, (Fraction(0), x, y, Fraction(0))) for x, y in places]
    c = (form[0], 0, 0, 0, 0, *form[1:], 0)
    set_representation(content, representation_through(parameters, points), c)
    content["box_exponent"] = exponent
    fit_real_poses(content, None)
    return content


def point_near(x: Fraction, bits: int) -> tuple[Fraction, Fraction]:
    """A point of the unit circle with rational coordinates, the first of which is about 2^-bits from x, 0 < x < 1."""
    p, q = x.numerator, x.denominator
    half_tangent = Fraction((q << bits) - isqrt(q * q - p * p << 2 * bits), p << bits)
    u = Fraction(round(half_tangent * (1 << bits)), 1 << bits)
    return 2 * u / (1 + u * u), (1 - u * u) / (1 + u * u)


def as_witnesses(content: Content) -> Content:
    """The representation alone, as evidence of a motion."""
    counts = dict.fromkeys(("complex_solutions", "distinct_solutions", "real_poses", "box_exponent"), 0)
    return {**content, **counts, "poses": [], "claim": "positive-dimensional-proved"}


# Polynomials


FIRST_PRIMES = solutions.PRIMES[0] * pure.PRIMES[0]
"""A number that is 0 modulo the prime that each checker tries first."""


def _nowhere_a_rotation() -> Content:
    """N(e) = 0 at both roots of P^2 t^2 + 1, which is 1 modulo the first primes: nothing is proved by them."""
    content = subject("not proven complete")
    joints = [["0", "0", "0"]] * 6
    content = {**content, "robot": {**content["robot"], "base": joints, "platform": joints, "metric": ["1", "1", "1"]}}
    p = FIRST_PRIMES
    h = p * p * ROOT * ROOT + 1
    f = [fmpq_poly([-2]), 2 * p * ROOT, NONE, NONE]
    set_representation(content, [h, h.derivative(), fmpq_poly([2 * p]), NONE, NONE, *f], (0, 0, 0, 0, 1, 0, 0, 0))
    content["box_exponent"] = 0
    return {**content, "poses": [], "real_poses": 0}


def _one_pose_under_two_roots() -> Content:
    """The eliminant (P t - 1)^2, which is 1 modulo the first primes, but no square of anything modulo others."""
    content = on_circle([(Fraction(1, FIRST_PRIMES), Fraction(1))], (0, 1, 0))
    h = (FIRST_PRIMES * ROOT - 1) ** 2
    slope = h.derivative()
    f = [NONE, slope / FIRST_PRIMES, slope, NONE]
    set_representation(content, [h, slope, NONE, NONE, NONE, *f], (0, 0, 0, 0, 0, 1, 0, 0))
    return {**content, "poses": content["poses"] * 2, "real_poses": 2}


def _called_simple(content: Content) -> Content:
    return {**content, "poses": [{**pose, "multiplicity": 1} for pose in content["poses"]]}


POLYNOMIALS = {
    "forty witnesses": Forgery(lambda: as_witnesses(sliding(40)), "accepted"),
    "forty-one witnesses": Forgery(lambda: as_witnesses(sliding(41)), reason="eliminant"),
    "no prime that divides the leading coefficient proves N(e) not 0": Forgery(_nowhere_a_rotation, reason="motion"),
    "no prime that divides the leading coefficient proves roots distinct": Forgery(
        _one_pose_under_two_roots, reason="eliminant"
    ),
    "no prime that divides the leading coefficient proves poses simple": Forgery(
        lambda: _called_simple(on_circle([(Fraction(1, FIRST_PRIMES), Fraction(1))], (0, 1, 0))), reason="multiplicity"
    ),
    "a leading coefficient that the first primes divide": Forgery(
        lambda: on_circle([(Fraction(1, FIRST_PRIMES), Fraction(1))], (0, 1, 0)), "accepted"
    ),
}


# Cells


def _near(distance: Fraction) -> Callable[[], Content]:
    """A pose whose first coordinate, on the grid 1/4, has nearly this distance from the grid point 1/2."""
    bits = distance.denominator.bit_length() + 40
    return lambda: on_circle([point_near(Fraction(1, 2) + distance / 4, bits)], (0, 1, 0), 2)


STEP = Fraction(1, 1 << 32)
"""Beyond it by 9 2^-4126, the enclosure that is the last to decide ends at it in the plain checker."""
CELLS = {
    f"a coordinate at {name} from a grid point": Forgery(_near(distance), "accepted")
    for name, distance in {
        "3/4 2^-32": STEP * 3 / 4,
        "-3/4 2^-32": -STEP * 3 / 4,
        "3/2 2^-32": STEP * 3 / 2,
        "-3/2 2^-32": -STEP * 3 / 2,
        "2^-32 and 2^-3000": STEP + Fraction(1, 1 << 3000),
        "2^-32 and 2^-6000": STEP + Fraction(1, 1 << 6000),
        "2^-32 and 9 2^-4126": STEP + Fraction(9, 1 << 4126),
        "-2^-32 and -2^-3000": -STEP - Fraction(1, 1 << 3000),
        "-2^-32 and -2^-6000": -STEP - Fraction(1, 1 << 6000),
        "2^-32 less 2^-3000": STEP - Fraction(1, 1 << 3000),
        "2^-32 less 2^-6000": STEP - Fraction(1, 1 << 6000),
    }.items()
}


# Boxes around solutions


def _hexadecimal(x: Fraction, exponent: int) -> str:
    return hex(round(x * (1 << exponent)))


def _at_infinity() -> Content:
    """A solution of the equations with N(e) = 0, simple and isolated: two legs that end in one platform joint have it.

    With e = (1, i) s the form of a leg is s^2 (p + 2 (B1 - i B2)) (q - 2 (A1 + i A2)), p = f1 - i f2, q = f1 + i f2.
    """
    content = subject("planar, boxes")
    platform = [["0", "0", "0"], ["0", "0", "0"], ["2", "2", "0"]]
    x = ((3, 1), (0, 0), (0, 0), (1, -3), (0, 0), (19, -27), (27, 19), (0, 0))
    centre = [[_hexadecimal(Fraction(part, 10), 28) for part in pair] for pair in x]
    counts: Content = {"complex_solutions": 2, "distinct_solutions": 2, "real_poses": 0, "box_exponent": 0, "poses": []}
    return {
        **content,
        **counts,
        "robot": {**content["robot"], "platform": platform},
        "claim": "not-proven-complete",
        "completeness_route": None,
        "krawczyk": {"chart": [3, 0, 0, 1], "real": [], "complex": [{"exponents": [28, 28], "centre": centre}]},
    }


BOXES = {"solutions at infinity are no poses": Forgery(_at_infinity, reason="boxes: not proved that complex box 1")}

# Claims


def _circling(**entries: Any) -> Content:
    """A parallelogram that moves on a circle, with two complex poses as witnesses: C1 = 5, C2 = t, t^2 = -16.

    No box stands beside them, though a list of boxes does; no pose is listed.
    """
    content = {**subject("moving beside isolated poses")}
    h, slope = ROOT * ROOT + 16, 2 * ROOT
    f = [NONE, 5 * slope, fmpq_poly([-32]), NONE]
    set_representation(content, [h, slope, NONE, NONE, NONE, *f], (0, 0, 0, 0, 0, 0, 1, 0))
    return {
        **as_witnesses(content),
        "krawczyk": {"chart": [1, 0, 0, 0], "real": [], "complex": []},
        **entries,
    }


def _without(name: str, *keys: str, **entries: Any) -> Content:
    """A certificate that lacks some parts, which are null then, and has other entries."""
    return {**subject(name), **dict.fromkeys(keys), **entries}


NOTHING: Content = {"poses": [], "real_poses": 0, "complex_solutions": 0, "distinct_solutions": 0, "box_exponent": 0}
DETECTED = {"claim": "positive-dimensional-detected"}
PROVED = {"claim": "positive-dimensional-proved"}
OPEN = {"claim": "not-proven-complete", "completeness_route": None}


def _with_multiplicities(name: str, *multiplicities: int | None) -> Content:
    content = subject(name)
    poses = zip(content["poses"], multiplicities, strict=True)
    return {**content, "poses": [{**pose, "multiplicity": multiplicity} for pose, multiplicity in poses]}


CLAIMS = {
    "complex witnesses of a motion": Forgery(_circling, "accepted"),
    "a motion that is proved is called detected": Forgery(lambda: _circling(**DETECTED), reason="claim"),
    "a motion is called detected beside an elimination": Forgery(
        lambda: _circling(**DETECTED, representation=None, elimination=[]), reason="claim"
    ),
    "a motion is called detected, and complete": Forgery(
        lambda: _circling(**DETECTED, representation=None, completeness_route="refined-bezout"), reason="claim"
    ),
    "a motion is called detected beside boxes": Forgery(lambda: _circling(**DETECTED, representation=None), "accepted"),
    "a motion is proved by nothing": Forgery(lambda: _circling(**PROVED, representation=None), reason="claim"),
    **{
        f"boxes with multiplicities {here}": Forgery(
            lambda here=here: _with_multiplicities("planar, boxes", *here),
            reason="multiplicity",  # type: ignore[misc]
        )
        for here in ((2, 1), (1, 2), (0, 1), (1, 0), (None, 1), (1, None))
    },
    **{
        f"{key} of {name} is {step} off": Forgery(
            lambda name=name, key=key, step=step: _without(name, **{key: subject(name)[key] + step}),  # type: ignore[misc]
            reason=reason,
        )
        for name in ("planar, boxes", "planar, representation", "planar, multiple solutions", "not proven complete")
        for key, reason in (
            ("complex_solutions", "complex solutions"),
            ("distinct_solutions", ""),
            ("real_poses", "real poses"),
        )
        for step in (1, -1)
    },
    **{
        f"{key} where nothing is listed": Forgery(
            lambda key=key: _without("nothing known", **{key: 1}),  # type: ignore[misc]
        )
        for key in ("complex_solutions", "distinct_solutions", "real_poses", "box_exponent")
    },
    **{
        f"{key} where no pose is, by an elimination": Forgery(
            lambda key=key: _without("inconsistent, joints in a point", **{key: 1}),  # type: ignore[misc]
        )
        for key in ("complex_solutions", "distinct_solutions", "real_poses", "box_exponent")
    },
    **{
        f"{key} beside a motion": Forgery(
            lambda key=key: _without("moving, dependent legs", **{key: 1}),  # type: ignore[misc]
        )
        for key in ("complex_solutions", "distinct_solutions", "real_poses", "box_exponent")
    },
    "an elimination beside a motion": Forgery(
        lambda: _without("moving, dependent legs", elimination=[]), reason="claim"
    ),
    **{
        f"route {route} of {name}": Forgery(
            lambda name=name, route=route: _without(name, completeness_route=route),  # type: ignore[misc]
            reason="claim",
        )
        for name in ("moving, dependent legs", "moving beside isolated poses", "not proven complete", "nothing known")
        for route in ("refined-bezout", "exact-elimination")
    },
    "method krawczyk without boxes": Forgery(lambda: _without("nothing known", method="krawczyk"), reason="method"),
    "method krawczyk with a representation": Forgery(
        lambda: _without("planar, representation", method="krawczyk"), reason="method"
    ),
    "method krawczyk with boxes and a representation": Forgery(
        lambda: _circling(**OPEN, method="krawczyk"), reason="method"
    ),
    "method krawczyk with boxes and an elimination": Forgery(
        lambda: _circling(**OPEN, method="krawczyk", representation=None, elimination=[]), reason="method"
    ),
    "method krawczyk with boxes": Forgery(
        lambda: _circling(**OPEN, method="krawczyk", representation=None), "accepted"
    ),
}


FORGERIES: dict[str, Forgery] = {**POLYNOMIALS, **CELLS, **BOXES, **CLAIMS}

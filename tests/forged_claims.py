"""Certificates that say more than is true, by a little: what one bound, one count or one condition keeps out."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial

from certificate_subjects import Content, subject
from certificate_tools import golden
from flint import fmpq_poly, fmpz_poly
from forged_neighbours import witness_of
from forged_representations import fit_real_poses, representation_through, set_representation, sliding
from forgeries import UNTURNED
from held_mechanisms import Pose

Case = tuple[Callable[[], Content], str]
ACCEPTED, REJECTED = "accepted", "rejected"
FAR = 1 << 14
"""A small multiple of the power of 2 at which the plain checker would look if it forgot that there is such a number."""


def _far_away() -> Content:
    """C is (1, 0, 2^8) for legs of length 1: |C|^2 - 1 is a power of 2."""
    content = sliding(1)
    point = UNTURNED, (Fraction(0), Fraction(1), Fraction(0), Fraction(1 << 8))
    set_representation(content, representation_through([Fraction(0)], [point]), (0,) * 8)
    fit_real_poses(content, None)
    return content


def _nearly_one_vector(place: int) -> Content:
    """Planar legs that are the same vector, but for one, which has that length too; first that is the first pose."""
    base = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    platform = [*base]
    platform[place] = (base[place][0], base[place][1] + FAR, 0)
    return witness_of(Pose((1, 0, 0, 0), (0, 1, 2, 0)), base, platform)


def _forty() -> Content:
    """As many points of a sphere of poses as there may be isolated poses, called all."""
    content = sliding(40, box_exponent=8)
    poses = [{**pose, "multiplicity": 1} for pose in content["poses"]]
    return {**content, "poses": poses, "claim": "complete", "completeness_route": "refined-bezout"}


def _some(name: str, degree: int) -> Content:
    """All solutions are called those with the parameters of one factor; the elimination leaves room for more."""
    content = golden(name)
    part = content["representation"]
    h, *numerators = (
        fmpz_poly([int(c, 16) for c in row]) for row in (part["eliminant"], *part["quaternion"], *part["translation"])
    )
    kept = next(factor for factor, _ in h.factor()[1] if factor.degree() == degree)
    others = fmpq_poly(h) / fmpq_poly(kept)
    # E / h' is E / (others kept') at the roots that are kept.
    rows = [_over(fmpq_poly(row), others, fmpq_poly(kept)) for row in numerators]
    proof = {key: content[key] for key in ("elimination", "claim", "completeness_route")}
    chart = part["chart"]
    set_representation(content, [fmpq_poly(kept), *rows], part["separating_form"])
    content["representation"]["chart"] = chart
    content = {**content, **proof, "poses": []}
    fit_real_poses(content, 1)
    return content


def _over(numerator: fmpq_poly, denominator: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    """The quotient modulo a polynomial."""
    _, inverse, _ = denominator.xgcd(modulus)
    return (numerator * inverse) % modulus


def _counted(more: int) -> Content:
    content = subject("planar, boxes")
    return content | {key: content[key] + more for key in ("complex_solutions", "distinct_solutions")}


CLAIMS: dict[str, Case] = {
    "a pose so far away that it seems to fit": (_far_away, REJECTED),
    **{f"leg {k + 1} is not the same vector": (partial(_nearly_one_vector, k), REJECTED) for k in range(3)},
    "forty poses on a sphere, called all": (_forty, REJECTED),
    "two of six poses, called all": (partial(_some, "3-rpr-six", 2), REJECTED),
    "five of six poses, called all": (partial(_some, "3-rpr-merlet-p", 5), REJECTED),
    **{f"{more} solutions more than boxes": (partial(_counted, more), REJECTED) for more in (1, -1)},
}

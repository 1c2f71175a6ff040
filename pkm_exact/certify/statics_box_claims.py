"""What certificates of boxes say of an ellipsoid and of singular values, from P and E as they are listed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import frexp
from typing import Any

from flint import arb, arb_mat

from pkm_exact.certify.statics_box_parts import ellipsoid_entry, indices_entry
from pkm_exact.certify.statics_build import short_weights
from pkm_exact.errors import PkmExactError
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.largest_ellipsoid import proposed_weights
from pkm_exact.statics.measures import Measures, RefusedError


def both_ways(speeds: Sequence[Fraction] | None) -> list[tuple[Fraction, Fraction]]:
    """Ends of what is limited both ways alike."""
    return [(-speed, speed) for speed in speeds or ()]


def box_ellipsoid(rows: arb_mat, speeds: Sequence[Fraction]) -> dict[str, Any]:
    """A large ellipsoid among the twists, by weights that are proposed in floating point."""
    sizes = [_power(max(abs(float(x.mid())) for x in column)) for column in rows.transpose().tolist()]
    scaled = [
        [x / (ball_of(speed) * size) for x, size in zip(row, sizes, strict=True)]
        for speed, row in zip(speeds, rows.tolist(), strict=True)
    ]
    return ellipsoid_entry(rows, speeds, short_weights(proposed_weights(arb_mat(scaled))))


def box_indices(at: AtPose, rows: arb_mat, twists: arb_mat, measures: Measures) -> dict[str, Any]:
    """Bounds of singular values of a machine in a box."""
    measures.require_norms()
    if len(measures.freedom.units) > 1:
        raise RefusedError("mixes actuators of different units: the certificate has singular values of J unscaled")
    length = measures.limits.length
    scales = [Fraction(1) if k < 3 or length is None else length**2 for k in at.motion.twist]
    near = Measures(Freedom(at), measures.limits).singular_values
    pairs = [_positive(near[0]), _positive(near[-1])]
    return indices_entry(rows, twists, scales, pairs)


def _power(value: float) -> arb:
    """A power of 2 near a number: weights do not depend on the units of the coordinates."""
    return arb(2) ** frexp(value)[1]


def _positive(value: Any) -> tuple[Fraction, Fraction]:
    found = interval_of(value)
    return Fraction(found.lo), Fraction(found.hi)


def attempts(left_out: dict[str, str]) -> Callable[[str, Any, Callable[[], Any]], Any]:
    """A way to make a part if what it needs is given; why it could not be made is kept under its name."""

    def tried(name: str, needed: Any, make: Callable[[], Any]) -> Any:
        if needed is None:
            return None
        try:
            return make()
        except PkmExactError as error:
            left_out[name] = str(error)
            return None

    return tried

"""Mobility certificates of version 3: bounds of the finite mobility from the ideal of the loops, and from curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify import mobility_second_build

if TYPE_CHECKING:
    from pkm_exact.mobility.algebraic_curve import AlgebraicCurve
    from pkm_exact.mobility.analysis import LinkageMobility
    from pkm_exact.mobility.second_order_proof import SecondOrderProof

FORMAT: Final = "pkm_exact mobility certificate"
VERSION: Final = 3


def finite_entry(found: LinkageMobility, proof: SecondOrderProof) -> dict[str, Any]:
    """The entry ``finite`` of version 3: that of version 2 with curves, and without what only version 2 has."""
    entry = mobility_second_build.finite_entry(found, proof) | {"argument": "ideal"}
    del entry["above"]["series"]
    if entry["below"] is not None:
        del entry["below"]["curve"]
        entry["below"]["curves"] = [_curve(curve) for curve in proof.curves]
    return entry


def _curve(curve: AlgebraicCurve) -> dict[str, Any]:
    return {
        "relation": [list(map(str, row)) for row in curve.relation],
        "halves": [[[list(map(str, row)) for row in n], list(map(str, d))] for n, d in curve.halves],
    }

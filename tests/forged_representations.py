"""Certificates with a representation of one's own: poses with known coordinates, in any order and number.

They list what they are given, as a solver would: honest, unless what they are given is no pose.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import gcd, lcm
from typing import Any

from certificate_tools import golden
from flint import fmpq, fmpq_poly, fmpz_poly

from pkm_exact.certify.checker import realposes
from pkm_exact.certify.checker.descartes import real_roots
from pkm_exact.certify.checker.document import Representation

Points = Sequence[tuple[Sequence[Fraction], Sequence[Fraction]]]


def coefficients(values: Any) -> list[str]:
    """Integers as they are written."""
    return [hex(int(value)) for value in values]


def set_representation(content: dict[str, Any], polynomials: Sequence[fmpq_poly], form: Sequence[int]) -> None:
    """Put (h, E, F), brought to lowest terms, into a certificate without a claim; w = (1, 0, 0, 0)."""
    values = [[fmpq(c) for c in polynomial.coeffs()] for polynomial in polynomials]
    scale = lcm(*(int(c.q) for row in values for c in row))
    integers = [[int(c * scale) for c in row] for row in values]
    content_ = gcd(*(c for row in integers for c in row))
    rows = [coefficients(c // content_ for c in row) for row in integers]
    content["representation"] = {
        "chart": [1, 0, 0, 0],
        "separating_form": list(form),
        "eliminant": rows[0],
        "quaternion": rows[1:5],
        "translation": rows[5:9],
    }
    content |= {"claim": "not-proven-complete", "completeness_route": None, "elimination": None}
    content["distinct_solutions"] = content["complex_solutions"] = len(rows[0]) - 1


def representation_through(parameters: Sequence[Fraction], points: Points) -> list[fmpq_poly]:
    """(h, E, F) with h of the given roots and (e, f) the given points there."""
    t = fmpq_poly([0, 1])
    h = fmpq_poly([1])
    for parameter in parameters:
        h *= t - fmpq(parameter.numerator, parameter.denominator)
    numerators = [fmpq_poly()] * 8
    for parameter, (e, f) in zip(parameters, points, strict=True):
        others = divmod(h, t - fmpq(parameter.numerator, parameter.denominator))[0]
        for k, x in enumerate((*e, *f)):
            numerators[k] += others * fmpq(x.numerator, x.denominator)
    return [h, *numerators]


def fit_real_poses(content: dict[str, Any], multiplicity: int | None) -> None:
    """List the real poses that the representation has, as a solver would."""
    part = content["representation"]
    representation = Representation(
        tuple(part["chart"]),
        tuple(part["separating_form"]),
        fmpz_poly([int(c, 16) for c in part["eliminant"]]),
        tuple(fmpz_poly([int(c, 16) for c in row]) for row in part["quaternion"]),
        tuple(fmpz_poly([int(c, 16) for c in row]) for row in part["translation"]),
    )
    metric = tuple(int(g) for g in content["robot"]["metric"])
    roots = real_roots(representation.eliminant)
    cells, fineness = realposes.parameter_cells(representation.eliminant, roots)
    boxes = realposes.root_boxes(representation, metric, content["box_exponent"], roots)  # type: ignore[arg-type]
    poses = []
    for root in realposes.in_order(boxes):
        (low, high), box = cells[root], boxes[root]
        ends = [list(realposes.cell_ends(a, b, content["box_exponent"])) for a, b in box]
        poses.append(
            {
                "parameter": list(realposes.cell_ends(low, high, fineness)),
                "position": ends[:3],
                "rotation": [ends[3:6], ends[6:9], ends[9:12]],
                "quaternion": ends[12:],
                "multiplicity": multiplicity,
            }
        )
    content["poses"], content["real_poses"] = poses, len(poses)


def turning(h: fmpz_poly, box_exponent: int = 31) -> dict[str, Any]:
    """All joints of base and platform on an axis, about which the platform turns by any angle: h names some.

    No pose is listed yet; the parameter is the tangent of half the angle.
    """
    content = golden("similar-planar-s")
    content["robot"]["base"] = [["0", "0", str(n)] for n in range(1, 7)]
    content["robot"]["platform"] = [["0", "0", str(2 * n)] for n in range(1, 7)]
    content["configuration"]["lengths_squared"] = [str(n * n) for n in range(1, 7)]
    rational, zero = fmpq_poly(h), fmpq_poly()
    slope = rational.derivative()
    times = fmpq_poly([0, 1]) * slope - h.degree() * rational
    set_representation(content, [rational, slope, zero, zero, times, zero, zero, zero, zero], (0, 0, 0, 1, 0, 0, 0, 0))
    return content | {"poses": [], "real_poses": 0, "box_exponent": box_exponent}


def sliding(count: int, step: Fraction = Fraction(1, 7), box_exponent: int = 31) -> dict[str, Any]:
    """Congruent base and platform, all legs of length 1: the platform slides, unturned, on a sphere.

    ``count`` of the rational points on the sphere are listed, parametrised by their third coordinate.
    """
    content = golden("similar-planar-s")
    content["robot"]["platform"] = content["robot"]["base"]
    content["configuration"]["lengths_squared"] = ["1"] * 6
    parameters, points = [], []
    for n in range(1, count + 1):
        u = n * step
        c = (2 * u / (1 + u * u), Fraction(0), (1 - u * u) / (1 + u * u))
        parameters.append(c[2])
        points.append(((Fraction(1), Fraction(0), Fraction(0), Fraction(0)), (Fraction(0), *c)))
    set_representation(content, representation_through(parameters, points), (0, 0, 0, 0, 0, 0, 0, 1))
    content["box_exponent"] = box_exponent
    fit_real_poses(content, None)
    return content

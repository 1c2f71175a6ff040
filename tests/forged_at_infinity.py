"""No pose, as points at infinity are said to count for all: linear forms and points made to fit all checks but one."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from random import Random

from certificate_tools import CERTS
from flint import fmpq_mat, fmpq_poly, fmpz_poly
from forged_infinity import eliminant_of, infinity_of, isotropic_points
from forged_margins import ACCEPTED, NO_POSE, REJECTED, Case
from held_mechanisms import Content, mechanism
from mechanism_certificates import made, mechanism_content
from mechanisms import pssc, vector

from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.constraints.axis_distance import AxisDistance
from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.linear import LinearForm

Values = Sequence[complex]
"""A point: s, u (3), C (3), R by rows (9); Gaussian integers."""
SQUARE, U, C, R = 0, 1, 4, 7


def _point(**parts: Values) -> list[complex]:
    """A point with some of u, C and R, the other coordinates 0."""
    found: list[complex] = [0] * 16
    for name, start in (("u", U), ("c", C), ("r", R)):
        for place, value in enumerate(parts.get(name, ()), start):
            found[place] = value
    return found


def _outer(a: Values, b: Values) -> list[complex]:
    return [x * y for x in a for y in b]


def _forms(point: Values, number: int = 6) -> list[list[int]]:
    """Forms at random that vanish at a point, its conjugate, and where s alone is not 0."""
    places = range(1, 16)
    rows = [[int(part(point[k])) for k in places] for part in (lambda x: complex(x).real, lambda x: complex(x).imag)]
    kernel, _ = fmpq_mat([[*row] for row in rows if any(row)]).rref()
    pivots = {next(j for j in range(15) if kernel[i, j]): i for i in range(kernel.nrows())}
    random = Random(7)
    found = []
    for _ in range(number):
        form = {j: random.randint(-9, 9) for j in range(15) if j not in pivots}
        solved = {j: -sum(kernel[i, k] * value for k, value in form.items()) for j, i in pivots.items()}
        found.append([0, *(int((form | solved)[j]) for j in range(15)), random.randint(1, 9)])
    return found


def _ladder(point: Values, steps: Sequence[int], multiplicity: int, place: int = SQUARE) -> Content:
    """The points that differ from a given one in one coordinate, which is k: at t = k, or at k + i and k - i."""
    values = [fmpq_poly([int(complex(x).real)]) for x in point]
    one = next(k for k in range(16) if point[k] == 1)
    chart, form = [0] * 16, [0] * 16
    chart[one] = form[place] = 1
    turned = next((k for k in range(16) if point[k] == 1j), None)
    if turned is not None:
        form[turned] = 1
    parts = []
    for k in steps:
        i, here = fmpq_poly([-k, 1]), list(values)
        for j in range(16):
            here[j] = values[j] + int(complex(point[j]).imag) * i
        here[place] = fmpq_poly([k])
        factor = fmpz_poly([-k, 1]) if turned is None else fmpz_poly([k * k + 1, -2 * k, 1])
        parts.append((factor, [value % fmpq_poly(factor) for value in here]))
    return infinity_of(parts, chart, form, multiplicity)


def _no_pose(forms: Sequence[Sequence[int]], infinity: Content) -> Content:
    """A mechanism with these forms, said to have no pose at all."""
    constraints = [LinearForm(tuple(map(Fraction, form))) for form in forms]
    entries = {"robot": mechanism("spatial", (1, 1, 1), constraints), "infinity": infinity}
    return mechanism_content("contradictory leg") | NO_POSE | {"completeness_route": "counting-at-infinity"} | entries


ISOTROPIC, CONJUGATE, STRAIGHT = (1, 1j, 0), (1, -1j, 0), (0, 0, 1)
CORNER = {name: [int(k == place) for k in range(9)] for name, place in (("first", 0), ("second", 4), ("last", 8))}
OFF_THE_MOTIONS: dict[str, tuple[list[complex], bool]] = {
    "u.u": (_point(u=STRAIGHT), True),
    "C.C": (_point(c=STRAIGHT), True),
    **{f"the {name} diagonal entry of R alone": (_point(r=r), False) for name, r in CORNER.items()},
    "R u": (_point(u=CONJUGATE, r=_outer(ISOTROPIC, ISOTROPIC)), False),
    "R^T C": (_point(c=CONJUGATE, r=_outer(ISOTROPIC, ISOTROPIC)), False),
    "R^T R": (_point(r=_outer(STRAIGHT, ISOTROPIC)), False),
    "R R^T": (_point(r=_outer(ISOTROPIC, STRAIGHT)), False),
}
"""Points at which one of the quadrics is not 0, and whether each counts twice, R being 0."""


def _off_the_motions(name: str) -> Content:
    """Forty points, or twenty that count twice."""
    point, is_double = OFF_THE_MOTIONS[name]
    pairs = any(complex(x).imag for x in point)
    number = 40 // ((1 + is_double) * (1 + pairs))
    return _no_pose(_forms(point), _ladder(point, range(1, number + 1), 40))


def _off_a_form(number: int) -> Content:
    """Twenty singular points of the motions, which are on all forms but one."""
    point = _point(u=ISOTROPIC)
    forms = _forms(point)
    forms[number][SQUARE] = 1
    return _no_pose(forms, _ladder(point, range(1, 11), 40))


def _nowhere_squarefree() -> Content:
    """Any points of the forms, at the double roots of h = g^2: whatever is quadratic in 2 g z is 0 there."""
    point = _point(u=(1, 2, 3), r=range(9))
    infinity = _ladder(point, range(10), 40)
    g = eliminant_of(infinity)
    doubled = [2 * g * fmpz_poly([int(c, 16) for c in z]) for z in infinity["coordinates"]]
    spelled = [[hex(int(c)) for c in polynomial.coeffs()] for polynomial in (g * g, *doubled)]
    return _no_pose(_forms(point), infinity | {"eliminant": spelled[0], "coordinates": spelled[1:]})


def _on_a_cylinder_too() -> Content:
    """An honest certificate; a point that is on an axis is besides at a distance from another one."""
    content = mechanism_content("3-PSS+C, general")
    zero, axis = vector(0, 0, 0), vector(0, 0, 1)
    beside = constraint_entry(AxisDistance(vector(1, 0, 0), axis, zero, Fraction(1), "beside"), (1, 3, 1))
    return content | {"robot": content["robot"] | {"constraints": [*content["robot"]["constraints"], beside]}}


def _beside_a_surface(number: int) -> Content:
    """Forms in u and R, which leave all C with C.C = 0 and any s at infinity: as many singular points as one likes."""
    random = Random(3)
    forms = []
    for _ in range(number):
        form = [random.randint(-9, 9) if 1 <= place <= 3 or place >= R else 0 for place in range(16)]
        forms.append([*form, -(form[R] + form[R + 4] + form[R + 8])])  # C = 0 with R = 1 is a pose
    return _no_pose(forms, isotropic_points())


def _beside_lines(number: int, *, is_singular: bool) -> Content:
    """Forms without |C|^2 through a point: all that differ from it in |C|^2 are on them, singular ones if R = 0."""
    if is_singular:
        point, steps = _point(u=ISOTROPIC), range(1, 11)
    else:
        point, steps = _point(u=ISOTROPIC, c=ISOTROPIC, r=_outer(ISOTROPIC, ISOTROPIC)), range(3, 23)
    return _no_pose(_forms(point, number), _ladder(point, steps, 40))


def _off_in_one_power(h: fmpz_poly, turned: fmpq_poly, beside: int) -> Content:
    """Points u = (1, i, 0), |C|^2 = t at the roots of h, where i is a polynomial in t; the form is t + beside on them.

    The numerators of the points give it one coefficient alone that is not 0.
    """
    values = [fmpq_poly([0])] * 16
    values[SQUARE], values[U], values[U + 1] = fmpq_poly([0, 1]), fmpq_poly([1]), turned
    chart, form = [0] * 16, [0] * 16
    chart[U] = form[SQUARE] = 1
    forms = _forms(_point(u=ISOTROPIC))
    forms[2][SQUARE], forms[2][U], forms[2][U + 1] = 1, beside, 0
    return _no_pose(forms, infinity_of([(h, values)], chart, form, 40))


def _of_two_powers(constant: fmpz_poly) -> tuple[fmpz_poly, fmpq_poly]:
    """T^20 + q^20, for a polynomial q, and a square root of -1 modulo it: (T / q)^10."""
    h = fmpz_poly([0, 1]) ** 20 + constant**20
    inverse = fmpq_poly(constant**10).xgcd(fmpq_poly(h))[1]
    return h, fmpq_poly([0, 1]) ** 10 * inverse % fmpq_poly(h)


def _in_a_small_unit() -> Content:
    """An honest certificate of a mechanism whose lengths are multiples of a prime, and so are those at infinity."""
    unit = (1 << 61) - 1
    problem = pssc((Fraction(0), Fraction(1, 2), Fraction(-1, 4)))
    constraints: list[Constraint] = []
    for constraint in problem.constraints:
        if isinstance(constraint, Distance):
            ends = (vector(*(unit * x for x in side)) for side in (constraint.base, constraint.platform))
            constraints.append(Distance(*ends, unit**2 * constraint.length_squared))
        else:
            constraints.append(constraint)
    content: Content = json.loads(made(lambda: replace(problem, constraints=tuple(constraints))))
    del content["digest"]
    return content


def _beside_a_cylinder() -> Content:
    """An honest certificate with one constraint more, which follows: in a plane, a distance is one from an axis."""
    content: Content = json.loads((CERTS / "3-rps.json").read_bytes())
    del content["digest"]
    constraints = content["robot"]["constraints"]
    leg, hinge = constraints[:2]
    base, normal, platform = (vector(*map(Fraction, x)) for x in (leg["base"], hinge["normal"], leg["platform"]))
    cylinder = AxisDistance(base, normal, platform, Fraction(leg["length_squared"]))
    metric = [int(g) for g in content["robot"]["metric"]]
    constraints.append({**constraint_entry(cylinder, (metric[0], metric[1], metric[2])), "name": "it follows"})
    return content


AT_INFINITY: dict[str, Case] = {
    "points at infinity in a unit that a prime is of": (_in_a_small_unit, ACCEPTED),
    **{
        f"points of two lines at infinity, singular: {is_singular}, {number} forms": (
            partial(_beside_lines, number, is_singular=is_singular),
            REJECTED,
        )
        for number in (7, 9)
        for is_singular in (True, False)
    },
    "points that are off a form in the first power alone": (
        lambda: _off_in_one_power(*_of_two_powers(fmpz_poly([1])), 0),
        REJECTED,
    ),
    "points that are off a form in the last power alone": (
        lambda: _off_in_one_power(*_of_two_powers(fmpz_poly([1, 1])), 1),
        REJECTED,
    ),
    **{
        f"points of a surface at infinity, {number} forms": (partial(_beside_a_surface, number), REJECTED)
        for number in (7, 9, 12)
    },
    "points at infinity of a mechanism with a cylinder": (_on_a_cylinder_too, REJECTED),
    "points at infinity beside a cylinder that follows": (_beside_a_cylinder, REJECTED),
    **{f"points where {name} is not 0": (partial(_off_the_motions, name), REJECTED) for name in OFF_THE_MOTIONS},
    **{f"points that are not on the form {number}": (partial(_off_a_form, number), REJECTED) for number in (0, 3, 5)},
    "an eliminant that is a square": (_nowhere_squarefree, REJECTED),
}

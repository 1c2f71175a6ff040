"""The checks of a statics certificate of version 2, numbered as in ``docs/certificates-statics.md``, in balls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import comb
from typing import Final

from flint import arb, arb_mat, ctx, fmpq, fmpq_mat

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.statics_box_document import (
    BoxEllipsoid,
    BoxFacet,
    BoxLeg,
    BoxStatics,
    BoxVelocity,
    BoxWrench,
    Ends,
    Numbers,
    Side,
)
from pkm_exact.certify.checker.verdict import rejected, too_large

MAX_CHOICES: Final = 20_000
BITS: Final = 256
STEP: Final = 200_000
"""Charged for a determinant, an inverse or a product of matrices of at most six rows."""


def check_box_statics(document: BoxStatics) -> Iterator[str]:
    """One line per claim."""
    with ctx.workprec(BITS):
        _require_affordable(document)
        _check_rows(document)
        yield f"machine: {len(document.legs)} legs in a box of poses, {len(document.free)} freedoms, J in its bounds"
        box = _Listed(document)
        if document.load is not None and document.actuator_forces is not None:
            _check_forces(box, document.load, document.actuator_forces)
            yield "forces: those that bear the load, within their bounds"
        if document.velocity is not None and document.speeds is not None:
            _check_velocity(box, document.speeds, document.velocity)
            facets, vertices = len(document.velocity.facets), len(document.velocity.vertices)
            yield f"velocity polytope: {vertices} vertices, {facets} facets, and no others"
        if document.wrench is not None and document.forces is not None:
            _check_wrench(box, document.forces, document.wrench)
            facets, vertices = len(document.wrench.facets), len(document.wrench.vertices)
            yield f"wrench polytope: {vertices} vertices, {facets} facets, and no others"
        if document.ellipsoid is not None and document.speeds is not None:
            _check_ellipsoid(box, document.speeds, document.ellipsoid)
            yield "ellipsoid: in the velocity polytope, and no larger one but for the part that is said"
        if document.indices is not None:
            _check_indices(box, document, document.indices)
            yield "indices: singular values and condition within their bounds"


def _require_affordable(document: BoxStatics) -> None:
    m, f = len(document.legs), len(document.free)
    chosen = {"velocity_polytope": (document.velocity, f), "wrench_polytope": (document.wrench, f - 1)}
    for name, (claim, size) in chosen.items():
        if claim is not None and comb(m, size) << f > MAX_CHOICES:
            raise too_large(f"{name}: too many choices of legs")
    charge_steps(document, m, f)


def charge_steps(document: BoxStatics, m: int, f: int) -> None:
    """The work of a certificate of m legs and f free components."""
    steps = comb(m, f) * (20 + (2 << f if document.velocity else 0))
    if document.wrench is not None:
        steps += (comb(m, f - 1) << f) + 10 * len(document.wrench.facets)
    charge(STEP * (100 + steps))


def _ball(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


def _hull(ends: Ends) -> arb:
    return _ball(ends[0]).union(_ball(ends[1]))


def _holds(ends: Ends, value: arb) -> bool:
    """Whether an interval contains a ball, which is proved."""
    return bool(value >= _ball(ends[0])) and bool(value <= _ball(ends[1]))


def _check_rows(document: BoxStatics) -> None:
    """Check 1."""
    roots = [arb(g).sqrt() for g in document.metric]
    position = [_hull(ends) for ends in document.position]
    rotation = arb_mat([[_hull(ends) for ends in row] for row in document.rotation])
    n, free = len(document.freedoms), document.free
    others = [k for k in range(n) if k not in free]
    expansion = [[arb(int(k == place)) for place in free] for k in range(n)]
    if others:
        forms = [_form_row(form, roots, position, rotation) for form in document.constraints]
        rows = [[row[k] for k in document.freedoms] for row in forms]
        left = arb_mat([[row[k] for k in others] for row in rows])
        right = arb_mat([[row[k] for k in free] for row in rows])
        try:
            found = left.solve(right)
        except ZeroDivisionError:
            raise rejected("expansion: the constraints are not proved to leave the free components free") from None
        for i, place in enumerate(others):
            expansion[place] = [-found[i, j] for j in range(len(free))]
    for line, listed in zip(expansion, document.expansion, strict=True):
        if not all(_holds(ends, value) for ends, value in zip(listed, line, strict=True)):
            raise rejected("expansion: an entry is not within its bounds")
    for number, (leg, listed) in enumerate(zip(document.legs, document.jacobian, strict=True), 1):
        whole = _leg_row(leg, number, roots, position, rotation)
        row = arb_mat([[whole[k] for k in document.freedoms]]) * arb_mat(expansion)
        if not all(_holds(ends, row[0, j]) for j, ends in enumerate(listed)):
            raise rejected(f"jacobian: an entry of leg {number} is not within its bounds")


def _leg_row(leg: BoxLeg, number: int, roots: Sequence[arb], position: Sequence[arb], rotation: arb_mat) -> list[arb]:
    """(d; a x d) / p."""
    arm = (rotation * arb_mat([[root * _ball(x)] for root, x in zip(roots, leg.platform, strict=True)])).entries()
    d = [c + a - root * _ball(x) for c, a, root, x in zip(position, arm, roots, leg.base, strict=True)]
    if leg.direction is None:
        square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
        if not square > 0:
            raise rejected(f"legs[{number}]: its length may be 0")
        speed = square.sqrt()
    else:
        x, y, z = (root * _ball(n) * e for root, n, e in zip(roots, leg.direction, d, strict=True))
        speed = x + y + z
        if speed.contains(0):
            raise rejected(f"legs[{number}]: its actuator may not move it")
    moment = [arm[1] * d[2] - arm[2] * d[1], arm[2] * d[0] - arm[0] * d[2], arm[0] * d[1] - arm[1] * d[0]]
    return [value / speed for value in (*d, *moment)]


def _form_row(form: Numbers, roots: Sequence[arb], position: Sequence[arb], rotation: arb_mat) -> list[arb]:
    """The derivative of a form along a twist, in ordinary coordinates."""
    square = 2 * _ball(form[0])
    arm = rotation * arb_mat([[_ball(form[1 + k]) / roots[k]] for k in range(3)])
    force = [square * position[k] + arm[k, 0] + _ball(form[4 + k]) / roots[k] for k in range(3)]
    table = arb_mat([[_ball(form[7 + 3 * i + j]) * roots[j] / roots[i] for j in range(3)] for i in range(3)])
    # R_j x c_j for the columns of both, summed over j, is what is not symmetric in R c^T.
    turned = rotation * table.transpose()
    moment = []
    for j, k in ((1, 2), (2, 0), (0, 1)):
        own = arm[j, 0] * position[k] - arm[k, 0] * position[j]
        moment.append(own + turned[j, k] - turned[k, j])
    return [*force, *moment]


class _Listed:
    """P and E as they are listed, and determinants of rows of P."""

    def __init__(self, document: BoxStatics) -> None:
        self.rows = arb_mat([[_hull(ends) for ends in row] for row in document.jacobian])
        self.twists = arb_mat([[_hull(ends) for ends in row] for row in document.expansion])
        self.m, self.f = len(document.legs), len(document.free)

    def picked(self, chosen: Sequence[int]) -> arb_mat:
        """Some rows."""
        return arb_mat([[self.rows[k, j] for j in range(self.f)] for k in chosen])

    def weighted_minors(self, weights: Sequence[arb], *, squared: bool) -> arb:
        """The sum over all f rows of the determinant, or its square, times their weights."""
        total = arb(0)
        for chosen in combinations(range(self.m), self.f):
            part = self.picked(chosen).det()
            part = part * part if squared else abs(part)
            for k in chosen:
                part *= weights[k]
            total += part
        return total


def _check_forces(box: _Listed, load: Numbers, listed: Sequence[Ends]) -> None:
    """Check 2."""
    wanted = box.twists.transpose() * arb_mat([[-_ball(x)] for x in load])
    back = box.rows.transpose()
    try:
        found = back.solve(wanted) if box.m == box.f else box.rows * (back * box.rows).solve(wanted)
    except ZeroDivisionError:
        raise rejected("actuator_forces: not decided in this box") from None
    if not all(_holds(ends, found[k, 0]) for k, ends in enumerate(listed)):
        raise rejected("actuator_forces: one is not within its bounds")


def _check_velocity(box: _Listed, speeds: Numbers, claim: BoxVelocity) -> None:
    """Check 3."""
    wanted = _meeting_points(box, speeds)
    listed = dict(claim.vertices)
    if len(listed) != len(claim.vertices):
        raise rejected("velocity_polytope: a vertex is listed twice")
    if listed.keys() != wanted.keys():
        raise rejected("velocity_polytope: not all vertices are listed, or others are")
    for sides, point in wanted.items():
        if not all(_holds(ends, point[j, 0]) for j, ends in enumerate(listed[sides])):
            raise rejected("velocity_polytope: a vertex is not within its bounds")
    if len(set(claim.facets)) != len(claim.facets):
        raise rejected("velocity_polytope: a facet is listed twice")
    if set(claim.facets) != {side for sides in wanted for side in sides}:
        raise rejected("velocity_polytope: not all facets are listed, or others are")
    if claim.volume is not None:
        size = 1 / abs(box.rows.det())
        for speed in speeds:
            size *= 2 * _ball(speed)
        if not _holds(claim.volume, size):
            raise rejected("velocity_polytope: the volume is not within its bounds")


def _meeting_points(box: _Listed, speeds: Numbers) -> dict[tuple[Side, ...], arb_mat]:
    """All vertices under the sides that meet there."""
    found: dict[tuple[Side, ...], arb_mat] = {}
    for chosen in combinations(range(box.m), box.f):
        try:
            inverse = box.picked(chosen).inv()
        except ZeroDivisionError:
            raise rejected("velocity_polytope: legs may be dependent, or the box is too wide") from None
        reach = box.rows * inverse
        others = [k for k in range(box.m) if k not in chosen]
        for signs in product((-1, 1), repeat=box.f):
            bounds = arb_mat([[s * _ball(speeds[k])] for s, k in zip(signs, chosen, strict=True)])
            values = reach * bounds
            rooms = [_ball(speeds[k]) - abs(values[k, 0]) for k in others]
            if all(room > 0 for room in rooms):
                found[tuple(zip(chosen, signs, strict=True))] = inverse * bounds
            elif not any(room < 0 for room in rooms):
                raise rejected("velocity_polytope: whether there is a vertex is not decided in this box")
    return found


def _check_wrench(box: _Listed, forces: Sequence[Ends], claim: BoxWrench) -> None:
    """Check 4."""
    listed = {(facet.legs, facet.side): facet for facet in claim.facets}
    if len(listed) != len(claim.facets):
        raise rejected("wrench_polytope: a facet is listed twice")
    places = list(combinations(range(box.m), box.f - 1))
    if listed.keys() != set(product(places, (1, -1))):
        raise rejected("wrench_polytope: not all facets are listed, or others are")
    cells: set[tuple[int, ...]] = set()
    for facet in claim.facets:
        cell = _check_facet(box, forces, facet)
        for ends_of in product((-1, 1), repeat=len(facet.legs)):
            cell |= zip(facet.legs, ends_of, strict=True)
            cells.add(tuple(cell[k] for k in range(box.m)))
    if len(set(claim.vertices)) != len(claim.vertices):
        raise rejected("wrench_polytope: a vertex is listed twice")
    if set(claim.vertices) != cells:
        raise rejected("wrench_polytope: not all vertices are listed, or others are")
    if not _holds(claim.volume, box.weighted_minors([_ball(high - low) for low, high in forces], squared=False)):
        raise rejected("wrench_polytope: the volume is not within its bounds")


def _check_facet(box: _Listed, forces: Sequence[Ends], facet: BoxFacet) -> dict[int, int]:
    """At which end the forces of the other legs are on a facet, if it is where the certificate says."""
    normal = [facet.side * x for x in _vector_product(box, facet.legs)]
    if not all(_holds(ends, x) for ends, x in zip(facet.normal, normal, strict=True)):
        raise rejected("wrench_polytope: a normal is not within its bounds")
    signs, offset = {}, arb(0)
    for k in range(box.m):
        if k in facet.legs:
            continue
        value = sum((x * box.rows[k, j] for j, x in enumerate(normal)), arb(0))
        if not (value > 0 or value < 0):
            raise rejected("wrench_polytope: more legs than usual may lie in a hyperplane")
        signs[k] = 1 if value > 0 else -1
        offset += value * _ball(forces[k][value > 0])
    if not _holds(facet.offset, offset):
        raise rejected("wrench_polytope: an offset is not within its bounds")
    return signs


def _vector_product(box: _Listed, chosen: Sequence[int]) -> list[arb]:
    found = []
    for j in range(box.f):
        minor = arb_mat([[box.rows[k, i] for i in range(box.f) if i != j] for k in chosen]).det()
        found.append(-minor if j % 2 else minor)
    return found


def _check_ellipsoid(box: _Listed, speeds: Numbers, claim: BoxEllipsoid) -> None:
    """Check 5."""
    f = box.f
    exact = fmpq_mat(f, f, [fmpq(x.numerator, x.denominator) for row in claim.matrix for x in row])
    charge(STEP * (1 + max(x.numerator.bit_length() + x.denominator.bit_length() for row in claim.matrix for x in row)))
    table = exact.tolist()
    if exact != exact.transpose() or not all(
        fmpq_mat([line[:k] for line in table[:k]]).det() > 0 for k in range(1, f + 1)
    ):
        raise rejected("ellipsoid: not positive definite")
    if min(claim.weights) < 0 or sum(claim.weights) != 1:
        raise rejected("ellipsoid: weights are negative, or their sum is not 1")
    reach = box.rows * arb_mat(exact) * box.rows.transpose()
    if not all(reach[k, k] <= _ball(speed * speed) for k, speed in enumerate(speeds)):
        raise rejected("ellipsoid: may leave the velocity polytope")
    parts = [_ball(weight / (speed * speed)) for weight, speed in zip(claim.weights, speeds, strict=True)]
    share = arb(exact.det()) * box.weighted_minors(parts, squared=True) * f**f
    if not share >= _ball(1 - claim.gap):
        raise rejected("ellipsoid: not proved to be as large as that")


def _check_indices(box: _Listed, document: BoxStatics, indices: Sequence[Ends]) -> None:
    """Check 6."""
    length = Fraction(1) if document.length is None else document.length**2
    scales = [_ball(length) if k >= 3 else arb(1) for k in document.freedoms]
    gram = box.rows.transpose() * box.rows
    twists = box.twists.tolist()
    scaled = arb_mat([[scale * x for x in row] for scale, row in zip(scales, twists, strict=True)])
    norm = box.twists.transpose() * scaled

    def definite(s: Fraction, way: int) -> bool | None:
        return _definite(way * (gram - _ball(s * s) * norm))

    least, greatest, condition = indices
    if definite(least[0], 1) is not True:
        raise rejected("indices: sigma_min may be below its bounds")
    if definite(least[1], 1) is not False:
        raise rejected("indices: sigma_min may be above its bounds")
    if definite(greatest[1], -1) is not True:
        raise rejected("indices: sigma_max may be above its bounds")
    if definite(greatest[0], -1) is not False:
        raise rejected("indices: sigma_max may be below its bounds")
    if condition[0] * least[1] > greatest[0] or condition[1] * least[0] < greatest[1]:
        raise rejected("indices: condition may not be between its bounds")


def _definite(matrix: arb_mat) -> bool | None:
    """Whether a symmetric matrix is positive definite, by its pivots; None if they do not tell."""
    left = matrix.tolist()
    for place, line in enumerate(left):
        if line[place] < 0:
            return False
        if not line[place] > 0:
            return None
        for row in left[place + 1 :]:
            factor = row[place] / line[place]
            row[:] = [x - factor * y for x, y in zip(row, line, strict=True)]
    return True

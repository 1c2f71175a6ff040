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
    Table,
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
        box = ListedRows(document.jacobian, document.expansion)
        if document.load is not None and document.actuator_forces is not None:
            check_forces(box, document.load, document.actuator_forces)
            yield "forces: those that bear the load, within their bounds"
        if document.velocity is not None and document.speeds is not None:
            check_velocity(box, both_ways(document.speeds), document.velocity)
            facets, vertices = len(document.velocity.facets), len(document.velocity.vertices)
            yield f"velocity polytope: {vertices} vertices, {facets} facets, and no others"
        if document.wrench is not None and document.forces is not None:
            check_wrench(box, document.forces, document.wrench)
            facets, vertices = len(document.wrench.facets), len(document.wrench.vertices)
            yield f"wrench polytope: {vertices} vertices, {facets} facets, and no others"
        if document.ellipsoid is not None and document.speeds is not None:
            check_ellipsoid(box, document.speeds, document.ellipsoid)
            yield "ellipsoid: in the velocity polytope, and no larger one but for the part that is said"
        if document.indices is not None:
            check_indices(box, document.freedoms, document.length, document.indices)
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


def ball_around(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


def hull_of(ends: Ends) -> arb:
    return ball_around(ends[0]).union(ball_around(ends[1]))


def holds(ends: Ends, value: arb) -> bool:
    """Whether an interval contains a ball, which is proved."""
    return bool(value >= ball_around(ends[0])) and bool(value <= ball_around(ends[1]))


def _check_rows(document: BoxStatics) -> None:
    """Check 1."""
    roots = [arb(g).sqrt() for g in document.metric]
    position = [hull_of(ends) for ends in document.position]
    rotation = arb_mat([[hull_of(ends) for ends in row] for row in document.rotation])
    n, free = len(document.freedoms), document.free
    others = [k for k in range(n) if k not in free]
    expansion = [[arb(int(k == place)) for place in free] for k in range(n)]
    if others:
        forms = [form_row(form, roots, position, rotation) for form in document.constraints]
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
        if not all(holds(ends, value) for ends, value in zip(listed, line, strict=True)):
            raise rejected("expansion: an entry is not within its bounds")
    for number, (leg, listed) in enumerate(zip(document.legs, document.jacobian, strict=True), 1):
        whole = _leg_row(leg, number, roots, position, rotation)
        row = arb_mat([[whole[k] for k in document.freedoms]]) * arb_mat(expansion)
        if not all(holds(ends, row[0, j]) for j, ends in enumerate(listed)):
            raise rejected(f"jacobian: an entry of leg {number} is not within its bounds")


def _leg_row(leg: BoxLeg, number: int, roots: Sequence[arb], position: Sequence[arb], rotation: arb_mat) -> list[arb]:
    """(d; a x d) / p."""
    arm = (rotation * arb_mat([[root * ball_around(x)] for root, x in zip(roots, leg.platform, strict=True)])).entries()
    d = [c + a - root * ball_around(x) for c, a, root, x in zip(position, arm, roots, leg.base, strict=True)]
    if leg.direction is None:
        square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
        if not square > 0:
            raise rejected(f"legs[{number}]: its length may be 0")
        speed = square.sqrt()
    else:
        x, y, z = (root * ball_around(n) * e for root, n, e in zip(roots, leg.direction, d, strict=True))
        speed = x + y + z
        if speed.contains(0):
            raise rejected(f"legs[{number}]: its actuator may not move it")
    moment = [arm[1] * d[2] - arm[2] * d[1], arm[2] * d[0] - arm[0] * d[2], arm[0] * d[1] - arm[1] * d[0]]
    return [value / speed for value in (*d, *moment)]


def form_row(form: Numbers, roots: Sequence[arb], position: Sequence[arb], rotation: arb_mat) -> list[arb]:
    """The derivative of a form along a twist, in ordinary coordinates."""
    square = 2 * ball_around(form[0])
    arm = rotation * arb_mat([[ball_around(form[1 + k]) / roots[k]] for k in range(3)])
    force = [square * position[k] + arm[k, 0] + ball_around(form[4 + k]) / roots[k] for k in range(3)]
    table = arb_mat([[ball_around(form[7 + 3 * i + j]) * roots[j] / roots[i] for j in range(3)] for i in range(3)])
    # R_j x c_j for the columns of both, summed over j, is what is not symmetric in R c^T.
    turned = rotation * table.transpose()
    moment = []
    for j, k in ((1, 2), (2, 0), (0, 1)):
        own = arm[j, 0] * position[k] - arm[k, 0] * position[j]
        moment.append(own + turned[j, k] - turned[k, j])
    return [*force, *moment]


class ListedRows:
    """P and E as they are listed, and determinants of rows of P."""

    def __init__(self, jacobian: Table, expansion: Table) -> None:
        self.rows = arb_mat([[hull_of(ends) for ends in row] for row in jacobian])
        self.twists = arb_mat([[hull_of(ends) for ends in row] for row in expansion])
        self.m, self.f = len(jacobian), len(jacobian[0])

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


def check_forces(box: ListedRows, load: Numbers, listed: Sequence[Ends]) -> None:
    """Check 2."""
    wanted = box.twists.transpose() * arb_mat([[-ball_around(x)] for x in load])
    back = box.rows.transpose()
    try:
        found = back.solve(wanted) if box.m == box.f else box.rows * (back * box.rows).solve(wanted)
    except ZeroDivisionError:
        raise rejected("actuator_forces: not decided in this box") from None
    if not all(holds(ends, found[k, 0]) for k, ends in enumerate(listed)):
        raise rejected("actuator_forces: one is not within its bounds")


def both_ways(speeds: Numbers) -> list[Ends]:
    """Ends of what is limited both ways alike."""
    return [(-speed, speed) for speed in speeds]


def check_velocity(box: ListedRows, ends: Sequence[Ends], claim: BoxVelocity, where: str = "velocity_polytope") -> None:
    """Check 3, of what the rows map between the ends."""
    wanted = _meeting_points(box, ends, where)
    listed = dict(claim.vertices)
    if len(listed) != len(claim.vertices):
        raise rejected(f"{where}: a vertex is listed twice")
    if listed.keys() != wanted.keys():
        raise rejected(f"{where}: not all vertices are listed, or others are")
    for sides, point in wanted.items():
        if not all(holds(pair, point[j, 0]) for j, pair in enumerate(listed[sides])):
            raise rejected(f"{where}: a vertex is not within its bounds")
    if len(set(claim.facets)) != len(claim.facets):
        raise rejected(f"{where}: a facet is listed twice")
    if set(claim.facets) != {side for sides in wanted for side in sides}:
        raise rejected(f"{where}: not all facets are listed, or others are")
    if claim.volume is not None:
        size = 1 / abs(box.rows.det())
        for low, high in ends:
            size *= ball_around(high - low)
        if not holds(claim.volume, size):
            raise rejected(f"{where}: the volume is not within its bounds")


def _meeting_points(box: ListedRows, ends: Sequence[Ends], where: str) -> dict[tuple[Side, ...], arb_mat]:
    """All vertices under the sides that meet there."""
    found: dict[tuple[Side, ...], arb_mat] = {}
    for chosen in combinations(range(box.m), box.f):
        try:
            inverse = box.picked(chosen).inv()
        except ZeroDivisionError:
            raise rejected(f"{where}: legs may be dependent, or the box is too wide") from None
        reach = box.rows * inverse
        others = [k for k in range(box.m) if k not in chosen]
        for signs in product((-1, 1), repeat=box.f):
            bounds = arb_mat([[ball_around(ends[k][side > 0])] for side, k in zip(signs, chosen, strict=True)])
            values = reach * bounds
            rooms = [
                room
                for k in others
                for room in (values[k, 0] - ball_around(ends[k][0]), ball_around(ends[k][1]) - values[k, 0])
            ]
            if all(room > 0 for room in rooms):
                found[tuple(zip(chosen, signs, strict=True))] = inverse * bounds
            elif not any(room < 0 for room in rooms):
                raise rejected(f"{where}: whether there is a vertex is not decided in this box")
    return found


def check_wrench(box: ListedRows, forces: Sequence[Ends], claim: BoxWrench, where: str = "wrench_polytope") -> None:
    """Check 4."""
    listed = {(facet.legs, facet.side): facet for facet in claim.facets}
    if len(listed) != len(claim.facets):
        raise rejected(f"{where}: a facet is listed twice")
    places = list(combinations(range(box.m), box.f - 1))
    if listed.keys() != set(product(places, (1, -1))):
        raise rejected(f"{where}: not all facets are listed, or others are")
    cells: set[tuple[int, ...]] = set()
    for facet in claim.facets:
        cell = _check_facet(box, forces, facet, where)
        for ends_of in product((-1, 1), repeat=len(facet.legs)):
            cell |= zip(facet.legs, ends_of, strict=True)
            cells.add(tuple(cell[k] for k in range(box.m)))
    if len(set(claim.vertices)) != len(claim.vertices):
        raise rejected(f"{where}: a vertex is listed twice")
    if set(claim.vertices) != cells:
        raise rejected(f"{where}: not all vertices are listed, or others are")
    if not holds(claim.volume, box.weighted_minors([ball_around(high - low) for low, high in forces], squared=False)):
        raise rejected(f"{where}: the volume is not within its bounds")


def _check_facet(box: ListedRows, forces: Sequence[Ends], facet: BoxFacet, where: str) -> dict[int, int]:
    """At which end the forces of the other legs are on a facet, if it is where the certificate says."""
    normal = [facet.side * x for x in _vector_product(box, facet.legs)]
    if not all(holds(ends, x) for ends, x in zip(facet.normal, normal, strict=True)):
        raise rejected(f"{where}: a normal is not within its bounds")
    signs, offset = {}, arb(0)
    for k in range(box.m):
        if k in facet.legs:
            continue
        value = sum((x * box.rows[k, j] for j, x in enumerate(normal)), arb(0))
        if not (value > 0 or value < 0):
            raise rejected(f"{where}: more legs than usual may lie in a hyperplane")
        signs[k] = 1 if value > 0 else -1
        offset += value * ball_around(forces[k][value > 0])
    if not holds(facet.offset, offset):
        raise rejected(f"{where}: an offset is not within its bounds")
    return signs


def _vector_product(box: ListedRows, chosen: Sequence[int]) -> list[arb]:
    found = []
    for j in range(box.f):
        minor = arb_mat([[box.rows[k, i] for i in range(box.f) if i != j] for k in chosen]).det()
        found.append(-minor if j % 2 else minor)
    return found


def check_ellipsoid(box: ListedRows, speeds: Numbers, claim: BoxEllipsoid) -> None:
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
    if not all(reach[k, k] <= ball_around(speed * speed) for k, speed in enumerate(speeds)):
        raise rejected("ellipsoid: may leave the velocity polytope")
    parts = [ball_around(weight / (speed * speed)) for weight, speed in zip(claim.weights, speeds, strict=True)]
    share = arb(exact.det()) * box.weighted_minors(parts, squared=True) * f**f
    if not share >= ball_around(1 - claim.gap):
        raise rejected("ellipsoid: not proved to be as large as that")


def check_indices(box: ListedRows, freedoms: Sequence[int], length: Fraction | None, indices: Sequence[Ends]) -> None:
    """Check 6."""
    square = Fraction(1) if length is None else length**2
    scales = [ball_around(square) if k >= 3 else arb(1) for k in freedoms]
    gram = box.rows.transpose() * box.rows
    twists = box.twists.tolist()
    scaled = arb_mat([[scale * x for x in row] for scale, row in zip(scales, twists, strict=True)])
    norm = box.twists.transpose() * scaled

    def definite(s: Fraction, way: int) -> bool | None:
        return is_definite(way * (gram - ball_around(s * s) * norm))

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


def is_definite(matrix: arb_mat) -> bool | None:
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

"""Ball arithmetic on the equations of a robot whose data are uncertain, as the checker knows it.

A pose is x = (e, f) in ordinary coordinates, relative to two origins and a unit of length given in the certificate. The
quantities of ``motion`` and Study's condition are quadratic forms x^T M_k x; the legs are rows of coefficients on them.
The unknowns are those of e and f that do not vanish for every pose; the chart w.e = 1 is the last equation.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product
from typing import TypeAlias

from flint import acb, acb_mat, arb, arb_mat, fmpz_mat

from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric, motion

Balls: TypeAlias = list[arb]

ORDINARY: Metric = (1, 1, 1)
COUNT = 18
"""N, R (9), C (3), R^-1 C (3), |C|^2 and Study's condition."""
NARROWINGS = 8
"""Times that the derivatives are taken on a narrower enclosure of the nominal solution, and their widths squared."""
SHRINKINGS = 8
"""Times that a box is replaced by what may hold its solutions."""
IMAGES = 2
"""Images with the same derivatives."""
ROTATION, POSITION, TURNED, SQUARE = 1, 10, 13, 16


def ball(value: Fraction) -> arb:
    """A ball around a rational number."""
    return arb(value.numerator) / value.denominator


def unknowns(*, planar: bool) -> tuple[int, ...]:
    """The coordinates of (e, f) that are kept."""
    return (0, 3, 5, 6) if planar else tuple(range(8))


@cache
def polar_forms(*, planar: bool) -> fmpz_mat:
    """2 M_k, one below the other: from the values of the quadratic forms at sums of unit vectors."""
    kept = unknowns(planar=planar)

    def values(*places: int) -> list[int]:
        point = [places.count(place) for place in range(8)]
        placed = motion(point[:4], point[4:], ORDINARY)
        return [*map(int, placed.coordinates()), int(placed.study)]

    single = {place: values(place) for place in kept}
    table = {(i, j): values(i, j) for i in kept for j in kept}
    return fmpz_mat([[table[i, j][k] - single[i][k] - single[j][k] for j in kept] for k in range(COUNT) for i in kept])


@dataclass(frozen=True)
class Robot:
    """A robot with uncertain data; ``errors`` are balls around 0: base joints, platform joints, lengths."""

    base: list[Balls]
    platform: list[Balls]
    lengths: Balls
    errors: tuple[arb, arb, arb]
    origins: tuple[Balls, Balls]
    unit: arb
    planar: bool

    @property
    def axes(self) -> range:
        """The axes along which joints can err."""
        return range(2 if self.planar else 3)


def robot_of(
    legs: Sequence[Leg],
    metric: Metric,
    origins: Sequence[Sequence[Fraction]],
    unit: Fraction,
    tolerances: Sequence[Fraction],
) -> Robot:
    """The robot in its new frames, at the precision in force."""
    scales = [arb(g).sqrt() for g in metric]

    def joint(point: Sequence[Fraction], origin: Sequence[Fraction]) -> Balls:
        return [s * ball((x - m) / unit) for s, x, m in zip(scales, point, origin, strict=True)]

    bounds = [ball(t / unit).upper() for t in tolerances]
    return Robot(
        [joint(leg.base, origins[0]) for leg in legs],
        [joint(leg.platform, origins[1]) for leg in legs],
        [ball(leg.length_squared / unit**2).sqrt() for leg in legs],
        (arb(0, bounds[0]), arb(0, bounds[1]), arb(0, bounds[2])),
        (
            [s * ball(x) for s, x in zip(scales, origins[0], strict=True)],
            [s * ball(x) for s, x in zip(scales, origins[1], strict=True)],
        ),
        ball(unit),
        len(legs) == PLANAR_LEGS,
    )


def rows(robot: Robot) -> acb_mat:
    """The coefficients of the legs, and of Study's condition unless planar, of the nominal robot."""
    lines = [] if robot.planar else [[arb(0)] * (COUNT - 1) + [arb(1)]]
    for a, b, length in zip(robot.base, robot.platform, robot.lengths, strict=True):
        constant = sum((x * x for x in (*a, *b)), -length * length)
        lines.append(
            [constant, *(-2 * x * y for x in a for y in b), *(-2 * x for x in a), *(2 * x for x in b), arb(1), arb(0)]
        )
    return acb_mat(arb_mat(lines))


def slopes(x: acb_mat, *, planar: bool) -> acb_mat:
    """The derivatives of the quantities, 18 x n."""
    return acb_mat(COUNT, x.nrows(), (acb_mat(arb_mat(polar_forms(planar=planar))) * x).entries())


def values(derivatives: acb_mat, x: acb_mat) -> list[acb]:
    """The quantities themselves: half of the derivatives times x."""
    return [entry / 2 for entry in (derivatives * x).entries()]


def leg_changes(robot: Robot, at: Sequence[acb]) -> list[acb]:
    """By how much the equations of the legs can change at a point, from the quantities there.

    It is linear in the quantities: from their derivatives, by how much derivatives of the equations can change.

    N (2 d.(R b - a) - 2 l t + |R b - a|^2 - t^2) with d = C + R B - A, for errors a, b, t of the data.
    """
    da, db, dl = robot.errors
    norm, position, turned = at[0], at[POSITION:TURNED], at[TURNED:SQUARE]
    rotation = [at[ROTATION + 3 * i : ROTATION + 3 * i + 3] for i in range(3)]
    square = sum((norm * (da * da + db * db) for _ in robot.axes), acb(0))
    square -= sum((2 * da * db * rotation[j][k] for j in robot.axes for k in robot.axes), acb(0))
    changes = []
    for a, b, length in zip(robot.base, robot.platform, robot.lengths, strict=True):
        change = square - norm * dl * dl - 2 * length * norm * dl
        for j in robot.axes:
            along = position[j] + sum((rotation[j][k] * b[k] for k in range(3)), acb(0)) - a[j] * norm
            back = turned[j] + b[j] * norm - sum((rotation[k][j] * a[k] for k in range(3)), acb(0))
            change += 2 * back * db - 2 * along * da
        changes.append(change)
    return changes


@dataclass(frozen=True)
class Expansion:
    """The equations around a centre m: chart, Y, F(m), E(m, P) on the legs, Y F'(m), and its derivatives.

    ``curvature`` has a row for every entry of Y F', row by row: its derivatives by the unknowns.
    """

    robot: Robot
    weights: tuple[acb, ...]
    centre: acb_mat
    inverse: acb_mat
    residual: acb_mat
    changes: list[acb]
    slope: acb_mat
    curvature: acb_mat

    @property
    def first(self) -> int:
        """Place of the first leg among the equations."""
        return 0 if self.robot.planar else 1

    def on_legs(self, changes: Sequence[acb]) -> list[acb]:
        """Values for all equations, 0 for those that are no legs."""
        return [*[acb(0)] * self.first, *changes, acb(0)]

    def defect(self, box: acb_mat, *, uncertain: bool) -> acb_mat:
        """1 - Y F' on a box, given moved to 0, for the nominal robot or for all."""
        size = box.nrows()
        unit = acb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        found = unit - self.slope - acb_mat(size, size, (self.curvature * box).entries())
        if uncertain:
            by_unknown = slopes(self.centre + box, planar=self.robot.planar).transpose().tolist()
            columns = [self.on_legs(leg_changes(self.robot, column)) for column in by_unknown]
            found -= self.inverse * acb_mat(columns).transpose()
        return found


def expand(robot: Robot, weights: Sequence[acb], centre: acb_mat) -> Expansion | None:
    """The expansion at an exact point; None if the Jacobian seems singular."""
    forms, derivatives, size = rows(robot), slopes(centre, planar=robot.planar), centre.nrows()
    jacobian = acb_mat(size, size, [*(forms * derivatives).entries(), *weights, *[acb(0)] * (size - len(weights))])
    try:
        inverse = jacobian.inv()
    except ZeroDivisionError:
        return None
    exact = acb_mat(size, size, [acb(v.real.mid(), v.imag.mid()) for v in inverse.entries()])
    product_ = (jacobian * centre).entries()
    residual = acb_mat(size, 1, [*(v / 2 for v in product_[:-1]), product_[-1] - 1])
    quadrics = acb_mat(arb_mat(fmpz_mat(COUNT, size * size, polar_forms(planar=robot.planar).entries())))
    twice = acb_mat(size, size * size, [*(forms * quadrics).entries(), *[acb(0)] * size**2])
    return Expansion(
        robot,
        tuple(weights),
        centre,
        exact,
        residual,
        leg_changes(robot, values(derivatives, centre)),
        exact * jacobian,
        acb_mat(size * size, size, (exact * twice).entries()),
    )


def box_around(radii: Sequence[arb], *, real: bool) -> acb_mat:
    """Balls around 0 with these radii in the real, and unless real in the imaginary, parts."""
    return acb_mat(len(radii), 1, [acb(arb(0, r), arb(0) if real else arb(0, r)) for r in radii])


def is_contraction(at: Expansion, radii: Sequence[arb], *, real: bool) -> bool:
    """Whether Krawczyk's operator maps the box with these radii into its interior, for the nominal robot.

    Then it has exactly one solution there; N(e) must be away from 0 too.
    """
    box = box_around(radii, real=real)
    image = at.defect(box, uncertain=False) * box - at.inverse * at.residual
    return _is_inside(image, radii, real=real) and not _norm(at, box).contains(0)


def holds_a_solution(at: Expansion, radii: Sequence[arb], *, real: bool) -> bool:
    """Whether every robot has a solution in the interior of the box with these radii, if Y is regular.

    F(x) - F(m) = F'((x + m) / 2) (x - m), so that x -> x - Y F(x) maps the box into this image.
    """
    box = box_around(radii, real=real)
    right = at.residual + acb_mat(len(radii), 1, at.on_legs(at.changes))
    return _is_inside(at.defect(box / 2, uncertain=True) * box - at.inverse * right, radii, real=real)


def is_regular(at: Expansion, radii: Sequence[arb], *, real: bool) -> bool:
    """Whether F' is regular, and N(e) not 0, all over the box with these radii, for all robots.

    Then Y is regular, and no robot has two solutions there. |1 - Y F'| <= B is shown to have a spectral radius below 1:
    by a positive vector v with v - B v = 1.
    """
    box = box_around(radii, real=real)
    bounds = arb_mat([[v.abs_upper() for v in row] for row in at.defect(box, uncertain=True).tolist()])
    size = len(radii)
    unit = arb_mat([[int(i == j) for j in range(size)] for i in range(size)])
    vector = (unit - bounds).solve(arb_mat(size, 1, [1] * size), nonstop=True)  # NaN is not greater than 0
    return all(v > 0 for v in vector.entries()) and not _norm(at, box).contains(0)


def holds_at_most_one(at: Expansion, radii: Sequence[arb], *, real: bool) -> bool:
    """Whether no robot has two solutions in the box with these radii, and N(e) is not 0 in it.

    A solution x in the box has x - m = (x - m) - Y F(x), which lies in the image of the box: what the image leaves of
    it holds the same solutions, again and again, until F' is proved regular there.
    """
    if _norm(at, box_around(radii, real=real)).contains(0):
        return False
    right = at.inverse * (at.residual + acb_mat(len(radii), 1, at.on_legs(at.changes)))
    for _ in range(SHRINKINGS):
        if is_regular(at, radii, real=real):
            return True
        box = box_around(radii, real=real)
        image = (at.defect(box / 2, uncertain=True) * box - right).entries()
        sizes = [abs(value.real).max(abs(value.imag)).upper() for value in image]
        if not any(size < radius for size, radius in zip(sizes, radii, strict=True)):
            return False
        radii = [radius.min(size).upper() for size, radius in zip(sizes, radii, strict=True)]
    return is_regular(at, radii, real=real)


def _is_inside(image: acb_mat, radii: Sequence[arb], *, real: bool) -> bool:
    return all(
        abs(v.real) < r and (v.imag == 0 if real else abs(v.imag) < r)
        for v, r in zip(image.entries(), radii, strict=True)
    )


def _norm(at: Expansion, box: acb_mat) -> acb:
    """N(e) on a box, given moved to 0."""
    around = at.centre + box
    return values(slopes(around, planar=at.robot.planar), around)[0]


def is_within(at: Expansion, radii: Sequence[arb], limit: arb, *, real: bool) -> bool:
    """Whether the nominal solution, which is in the box with these radii, is within a limit of the centre.

    x - m = -Y F(m) + (1 - Y F'((x + m) / 2)) (x - m): an enclosure of x - m gives a narrower one, again and again.
    """
    found, step = box_around(radii, real=real), at.inverse * at.residual
    for _ in range(NARROWINGS):
        defect = at.defect(found / 2, uncertain=False)
        for _ in range(IMAGES):
            found = defect * found - step
            parts = [abs(part) for offset in found.entries() for part in (offset.real, offset.imag)]
            if all(part < limit for part in parts):
                return True
            if any(part > limit for part in parts):
                return False
    return False


def components(robot: Robot, x: acb_mat) -> tuple[Balls, arb_mat]:
    """Position, rotation matrix, unit quaternion and new platform origin at real x, and their derivatives.

    In ordinary coordinates of the model's base frame.
    """
    derivatives = slopes(x, planar=robot.planar)
    size = x.nrows()
    flat = [v.real for v in derivatives.entries()]
    at = [v.real for v in values(derivatives, x)]
    norm, by_norm = at[0], flat[:size]
    ratio = [value / norm for value in at]
    slope = [
        [(s - ratio[k] * t) / norm for s, t in zip(flat[k * size : (k + 1) * size], by_norm, strict=True)]
        for k in range(COUNT)
    ]
    found: list[tuple[arb, Balls]] = []
    (a, b), unit = robot.origins, robot.unit
    for i in range(3):
        turn = list(enumerate(range(ROTATION + 3 * i, ROTATION + 3 * i + 3)))
        value = a[i] + unit * ratio[POSITION + i] - sum((ratio[k] * b[j] for j, k in turn), arb(0))
        line = [
            unit * s - sum((slope[k][column] * b[j] for j, k in turn), arb(0))
            for column, s in enumerate(slope[POSITION + i])
        ]
        found.append((value, line))
    found += [(ratio[k], slope[k]) for k in range(ROTATION, POSITION)]
    length = norm.sqrt()
    kept = unknowns(planar=robot.planar)
    for k in range(4):
        entry = x[kept.index(k), 0].real / length if k in kept else arb(0)
        own = [1 / length if place == k else arb(0) for place in kept]
        found.append((entry, [o - entry * t / (2 * norm) for o, t in zip(own, by_norm, strict=True)]))
    found += [(a[i] + unit * ratio[POSITION + i], [unit * s for s in slope[POSITION + i]]) for i in range(3)]
    return [value for value, _ in found], arb_mat([line for _, line in found])


def changes_of_pose(at: Expansion, radii: Sequence[arb]) -> tuple[arb_mat, arb_mat] | None:
    """Z on the legs, and Z F(m): the pose of a robot is that at m, less Z (F(m) + E), over a box that holds it.

    F' is that on the box of half the size; it must be regular on the box. With M = 1 - Y F', |M| its upper bounds, the
    inverses are V = Y + M Y + M^2 Y + .., and |V - Y| is at most (1 - |M|)^-1 |M| |Y|; the inverse is the sum of the
    powers of |M|.
    """
    size, box = len(radii), box_around(radii, real=True)
    defect = arb_mat(size, size, [v.real.abs_upper() for v in at.defect(box / 2, uncertain=True).entries()])
    exact = arb_mat(size, size, [v.real for v in at.inverse.entries()])
    unit = arb_mat([[int(i == j) for j in range(size)] for i in range(size)])
    try:
        change = (unit - defect).solve(defect * arb_mat(size, size, [abs(v) for v in exact.entries()]))
    except ZeroDivisionError:
        return None
    solved = exact + arb_mat(size, size, [arb(0, v.abs_upper()) for v in change.entries()])
    effect = components(at.robot, at.centre + box)[1] * solved
    legs = range(at.first, size - 1)
    return (
        arb_mat([[effect[k, i] for i in legs] for k in range(effect.nrows())]),
        effect * arb_mat(size, 1, [v.real for v in at.residual.entries()]),
    )


def greatest_length(effect: arb_mat, bounds: Sequence[arb], places: Sequence[int]) -> arb:
    """The greatest length of the rows ``places`` of effect times E, for |E_i| up to the bounds: at a vertex."""
    part = arb_mat([[effect[k, i] for i in range(effect.ncols())] for k in places])
    greatest = arb(0)
    for signs in product((1, -1), repeat=len(bounds) - 1):
        vertex = arb_mat(len(bounds), 1, [bounds[0], *(s * b for s, b in zip(signs, bounds[1:], strict=True))])
        square = sum((v * v for v in (part * vertex).entries()), arb(0))
        greatest = greatest.max(square.abs_upper().sqrt().upper())
    return greatest


def points_of_box(robot: Robot, weights: Sequence[acb], centroid: Sequence[arb], q: Sequence[arb]) -> list[acb]:
    """The unknowns, in the chart, of all poses with these positions of the new platform origin and unit quaternions."""
    c = [(value - a) / robot.unit for value, a in zip(centroid, robot.origins[0], strict=True)]
    f = [
        -c[0] * q[1] - c[1] * q[2] - c[2] * q[3],
        c[0] * q[0] + c[1] * q[3] - c[2] * q[2],
        c[1] * q[0] + c[2] * q[1] - c[0] * q[3],
        c[2] * q[0] + c[0] * q[2] - c[1] * q[1],
    ]
    kept = [acb([*q, *f][k]) for k in unknowns(planar=robot.planar)]
    chart = sum((w * v for w, v in zip(weights, kept, strict=False)), acb(0))
    return [v / chart for v in kept]

"""All solutions that are known of a robot, real and complex, as points in ball arithmetic."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Final, cast

from flint import acb, acb_mat, acb_poly, arb, ctx

from pkm_exact.balls import ball, hull
from pkm_exact.motions.motion import Motion
from pkm_exact.numeric.centred import CentredRobot, Chart, centred_point
from pkm_exact.numeric.charts import in_chart
from pkm_exact.numeric.linearisation import Linearisation, chart_weights, is_proved, linearise, refined, rounded
from pkm_exact.numeric.pose_maps import pose_map
from pkm_exact.numeric.quaternions import quaternion_product
from pkm_exact.poses.pose import Pose
from pkm_exact.poses.pose_representation import PoseRepresentation
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.solution import Solution

CHART_SIZE: Final = 32
"""Size of the integers in w: the chart of a solution passes near its conjugate quaternion."""
ACCURATE_BITS: Final = 40
"""Accuracy of a root from which Newton's method goes on."""


def pose_point(robot: CentredRobot, pose: Pose) -> acb_mat:
    """The middle of a pose's box: e = q, f = C q."""
    q = [acb(_middle(bounds)) for bounds in pose.quaternion]
    c = [acb(0), *(acb(_middle(bounds)) for bounds in pose.position)]
    return centred_point(q, quaternion_product(c, q), robot)


def _middle(bounds: Interval) -> arb:
    return ball(bounds.midpoint)


def complex_points(robot: CentredRobot, solution: Solution) -> list[acb_mat]:
    """The solutions that are not real, one of each pair of conjugates."""
    if solution.isolated is not None:
        rows = [
            [_dyadic(parts, box.exponent(index)) for index, parts in enumerate(box.centre)]
            for box in solution.isolated.pairs
        ]
    elif solution.representation is not None:
        rows = _roots(solution.representation)
    else:
        rows = []
    return [_ordinary(robot, row) for row in rows]


def _dyadic(parts: tuple[int, int], exponent: int) -> acb:
    unit = arb(2) ** -exponent
    return acb(unit * parts[0], unit * parts[1])


def _roots(representation: PoseRepresentation) -> list[list[acb]]:
    """(e, f) at the roots of the eliminant in the upper half plane; the precision rises until they are accurate."""
    precision = ctx.prec
    while True:
        with working_precision(precision):
            h = representation.univariate.primitive_polynomial
            roots = [root for root, _ in cast("list[tuple[acb, int]]", h.complex_roots()) if root.imag > 0]
            numerators = [acb_poly(numerator) for numerator in representation.univariate.numerator_polynomials]
            slope = acb_poly(representation.denominator)
            rows = [[numerator(root) / slope(root) for numerator in numerators] for root in roots]
        if all(_is_accurate(row) for row in rows):
            return rows
        precision *= 2


def _is_accurate(row: Sequence[acb]) -> bool:
    """Whether the errors are small beside e, and those of f beside f, which may vanish.

    Not beside each coordinate: one that is 0 never has a small enclosure in proportion to itself.
    """
    small = arb(2) ** -ACCURATE_BITS
    sizes = [reduce(arb.max, (value.abs_upper() for value in half)) for half in (row[:4], row[4:])]
    errors = [reduce(arb.max, (value.rad() for value in half)) for half in (row[:4], row[4:])]
    if not errors[0] <= small * sizes[0]:
        return False
    return bool(errors[1] <= small * sizes[1] or sizes[1] <= small * small * sizes[0])


def _ordinary(robot: CentredRobot, row: Sequence[acb]) -> acb_mat:
    """From rational coordinates (e, f) with respect to the metric."""
    g = robot.problem.metric
    volume = g[0] * g[1] * g[2]
    e = [arb(volume).sqrt() * row[0], *(arb(g[i]).sqrt() * row[1 + i] for i in range(3))]
    f = [row[4], *((arb(volume) / g[i]).sqrt() * row[5 + i] for i in range(3))]
    return centred_point(e, f, robot)


def own_chart(x: acb_mat, motion: Motion) -> Chart:
    """The chart w.e = 1 with w near the conjugate of e, so that |e| is small and of one size in all directions."""
    turning = motion.rotation_support
    half = x.entries()[: len(turning)]
    size = sum((abs(value) * abs(value) for value in half), arb(0)).nonnegative_part().sqrt()
    weights = {
        k: (_integer(CHART_SIZE * v.real / size), _integer(-CHART_SIZE * v.imag / size))
        for k, v in zip(turning, half, strict=True)
    }
    return tuple(weights.get(k, (0, 0)) for k in range(4))


def _integer(value: arb) -> int:
    return exact_integer((value.mid() + arb(0.5)).floor().mid())


def exact_integer(value: arb) -> int:
    """The integer that an exact ball is."""
    mantissa, power = value.man_exp()
    return int(mantissa) << int(power) if int(power) >= 0 else int(mantissa) >> -int(power)


def certified_point(robot: CentredRobot, point: acb_mat, exponent: int) -> Linearisation | None:
    """The equations around the solution near a point, in a chart of its own, if it is proved to be one."""
    motion = robot.problem.motion
    chart = own_chart(point, motion)
    limit = refined(robot, chart, in_chart(point, chart_weights(chart, motion)), exponent)
    near = None if limit is None else linearise(robot, chart, rounded(limit, exponent))
    if near is None or not is_proved(near, None, core_radii(robot.size, exponent)):
        return None
    return near


def core_radii(size: int, exponent: int) -> list[arb]:
    """Radii of the boxes in which the nominal solutions are proved."""
    return [arb(2) ** -(exponent // 2)] * size


def certified_pose(robot: CentredRobot, pose: Pose, poses: Sequence[Pose], exponent: int) -> Linearisation | None:
    """The equations around a pose; None if it is singular, or nearly, or not told from another on this grid."""
    near = certified_point(robot, pose_point(robot, pose), exponent)
    if near is None:
        return None
    values = pose_map(robot, near.around(core_radii(robot.size, exponent))).values
    # Close to another pose, Newton's method may go there, or the enclosure reach so far.
    return near if all(meets(other, values) is (other is pose) for other in poses) else None


def meets(pose: Pose, values: Sequence[arb]) -> bool:
    """Whether enclosed components of a pose overlap the box of position and rotation."""
    bounds = [*pose.position, *(entry for row in pose.rotation for entry in row)]
    return all(hull(bound.lo, bound.hi).overlaps(value) for bound, value in zip(bounds, values[:12], strict=True))

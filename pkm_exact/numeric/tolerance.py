"""Poses of all robots within tolerance: for every pose one box that holds exactly one pose of each of them.

Around each certified pose Krawczyk's operator with the robot's data as parameters (``linearisation``) proves a box in
the chart of the pose; the pose's bounds in ordinary coordinates (``deviations``) must lie in it, so that they hold
exactly one pose too. If all 40 complex solutions (6 of a planar robot) are proved so, and the nominal ones are
distinct, then those of every robot within tolerance are distinct as well: two of them that met would do so for all
robots of the connected set. So the refined theorem of Bezout holds for each of them, and the list is complete for
each.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Final

from flint import acb, acb_mat, arb

from pkm_exact.balls import Balls, ball, hull
from pkm_exact.failures.contradiction import require
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.numeric.centred import (
    NORM,
    POSITION,
    CentredFrames,
    centred_frames,
    centred_robot,
    origins,
    quantities_at,
)
from pkm_exact.numeric.charts import in_chart
from pkm_exact.numeric.data_errors import data_errors
from pkm_exact.numeric.deviations import MARGIN, PoseBounds, dominant_influence, pose_bounds
from pkm_exact.numeric.followed_pose import followed_pose
from pkm_exact.numeric.linearisation import (
    Linearisation,
    chart_weights,
    enclosing_radii,
    has_at_most_one,
    is_proved,
    up,
)
from pkm_exact.numeric.nominal import certified_point, certified_pose, complex_points, core_radii, exact_integer
from pkm_exact.numeric.quaternions import quaternion_product
from pkm_exact.numeric.tolerance_result import ProvedBox, ToleranceBox, ToleranceResult
from pkm_exact.poses.pose import Pose
from pkm_exact.precision import working_precision
from pkm_exact.solution import Solution
from pkm_exact.stages import Amount, Progress, tell

GRID_BITS: Final = 96
"""The grid of centres and radii is by that many bits finer than the smallest tolerance, in the centred unit."""
GUARD_BITS: Final = 64
"""Bits beyond those of the grid, and beyond half as many: so many are lost at most where a core can be proved."""
SMALLEST_FRACTION: Final = 40
"""A pose that is not proved for 2^-40 of the tolerance counts as singular."""
FRACTION_BITS: Final = 5
"""Bits to which the greatest fraction of the tolerance is found that is proved."""


def tolerance_boxes(
    problem: ForwardProblem,
    tolerances: Tolerances,
    solution: Solution,
    progress: Progress | None = None,
    asked: Sequence[int] | None = None,
) -> ToleranceResult:
    """The answer to ``pkm_exact.tolerance_boxes``, which says what is asked and what is raised, as data only."""
    if solution.problem != problem:
        raise ValueError("the solution is not one of this problem")
    problem.gough_legs  # noqa: B018 - refuses other robots
    show = progress or (lambda _: None)
    every = range(1, len(solution.poses) + 1)
    chosen = sorted(every if asked is None else set(asked))
    unasked = tuple(number for number in every if number not in chosen)
    frames = centred_frames(problem)
    exponent = _grid(tolerances, frames)
    with working_precision(exponent + exponent // 2 + GUARD_BITS):
        robot = centred_robot(problem, frames)
        boxes: list[ToleranceBox] = []
        near: list[Linearisation] = []
        show("tolerance boxes")
        for number in chosen:
            tell(progress, Amount(len(boxes), len(chosen), "poses"))
            around = certified_pose(robot, solution.poses[number - 1], solution.poses, exponent)
            boxes.append(_tolerance_box(around, tolerances, number, exponent))
            near += [] if around is None else [around]
        found: list[Linearisation | None] = []
        if not unasked:
            show("solutions that are not real")
            found = [certified_point(robot, point, exponent) for point in complex_points(robot, solution)]
        pairs = [] if None in found else [around for around in found if around is not None]
        proofs = []
        for count, around in enumerate(pairs):
            tell(progress, Amount(count, len(pairs), "pairs"))
            proofs.append(_proved_pair(around, tolerances, exponent))
        proved = tuple(proof for proof in proofs if proof is not None)
        count = sum(box.is_proved for box in boxes) + 2 * len(proved)
        is_complete = (
            not unasked
            and all(box.is_proved for box in boxes)
            and len(proved) == len(found)
            and count == problem.solution_bound
            and are_distinct(
                [_core(around, exponent) for around in near], [_core(around, exponent) for around in pairs]
            )
        )
    require(count <= problem.solution_bound, "more solutions than the variety of motions allows", proved=count)
    for box in boxes:
        nominal = solution.poses[box.pose - 1]
        require(_may_hold(box, nominal), "a box of all robots does not hold the nominal pose", pose=box.pose)
    shown = proved if is_complete else ()
    return ToleranceResult(problem, tolerances, frames, exponent, tuple(boxes), shown, count, is_complete, unasked)


def _may_hold(box: ToleranceBox, pose: Pose) -> bool:
    """Whether position and rotation of a pose can lie in the bounds of its box."""
    if box.bounds is None:
        return True
    nominal = [*pose.position, *(entry for row in pose.rotation for entry in row)]
    return all(bound.overlaps(entry) for bound, entry in zip(box.bounds.components, nominal, strict=False))


def _grid(tolerances: Tolerances, frames: CentredFrames) -> int:
    smallest = min(t for t in (tolerances.base, tolerances.platform, tolerances.lengths) if t) / frames.unit
    return GRID_BITS + max(0, smallest.denominator.bit_length() - smallest.numerator.bit_length())


def _tolerance_box(near: Linearisation | None, tolerances: Tolerances, number: int, exponent: int) -> ToleranceBox:
    if near is None:
        return ToleranceBox(number, Fraction(0), None, None, None)
    dominant = dominant_influence(near, data_errors(near.robot, tolerances))
    found = _proved_pose(near, tolerances, exponent)
    if found is not None:
        return ToleranceBox(number, Fraction(1), found[1], dominant, found[0])

    def is_proved(fraction: Fraction) -> bool:
        return _proved_pose(near, tolerances.scaled(fraction), exponent) is not None

    fraction = _greatest_fraction(is_proved)
    attained = [_attained(near, tolerances, fraction / part, exponent) for part in (1, 2, 4)]
    least = [max(errors) for errors in zip(*attained, strict=True)]
    return ToleranceBox(
        number, fraction, None, dominant, None, followed_pose(near, tolerances, fraction, least, exponent)
    )


def _attained(
    near: Linearisation, tolerances: Tolerances, fraction: Fraction, exponent: int
) -> tuple[Fraction, Fraction]:
    """Errors of position and rotation that some robot within a fraction of the tolerances has."""
    found = _proved_pose(near, tolerances.scaled(fraction), exponent) if fraction else None
    return (Fraction(0), Fraction(0)) if found is None else (found[1].position_error.lo, found[1].rotation_error.lo)


def _greatest_fraction(is_proved: Callable[[Fraction], bool]) -> Fraction:
    """The greatest fraction below 1 that is proved, to a few bits; 0 if there seems to be none."""
    high = Fraction(1)
    for _ in range(SMALLEST_FRACTION):
        low = high / 2
        if is_proved(low):
            break
        high = low
    else:
        return Fraction(0)
    for _ in range(FRACTION_BITS):
        between = (low + high) / 2
        low, high = (between, high) if is_proved(between) else (low, between)
    return low


def _proved_pose(near: Linearisation, tolerances: Tolerances, exponent: int) -> tuple[ProvedBox, PoseBounds] | None:
    """A box for a real pose, and bounds of the pose that lie in it."""
    errors = data_errors(near.robot, tolerances)
    inner = enclosing_radii(near, errors, exponent)
    bounds = None if inner is None else pose_bounds(near, errors, inner)
    if inner is None or bounds is None:
        return None
    needed = _containing(near, bounds, exponent)
    if needed is None:
        return None
    core = core_radii(near.robot.size, exponent)
    outer = [max(radii) for radii in zip(inner, needed, core, strict=True)]
    if not has_at_most_one(near, errors, outer):
        return None
    return _boxed(near, outer, inner, exponent), bounds


def _containing(near: Linearisation, bounds: PoseBounds, exponent: int) -> list[arb] | None:
    """Radii of a box that contains all poses with these bounds of centroid and quaternion."""
    x = _points_of_box(near, bounds)
    if not all(value.is_finite() for value in x.entries()):
        return None
    return [up(MARGIN * abs(value.real), exponent) for value in (x - near.centre).entries()]


def _points_of_box(near: Linearisation, bounds: PoseBounds) -> Balls:
    """Balls with the coordinates of all poses with these bounds of centroid and quaternion: e = q, f = C' q."""
    q = [acb(hull(bound.lo, bound.hi)) for bound in bounds.quaternion]
    unit = ball(near.robot.frames.unit)
    centroid = [hull(bound.lo, bound.hi) for bound in bounds.centroid]
    c = [acb((value - a) / unit) for value, a in zip(centroid, origins(near.robot)[0], strict=True)]
    full = [*q, *quaternion_product([acb(0), *c], q)]
    motion = near.robot.problem.motion
    x = acb_mat(near.robot.size, 1, [full[k] for k in motion.support])
    return in_chart(x, chart_weights(near.chart, motion))


def _proved_pair(near: Linearisation, tolerances: Tolerances, exponent: int) -> ProvedBox | None:
    """A box for a solution that is not real."""
    errors = data_errors(near.robot, tolerances)
    inner = enclosing_radii(near, errors, exponent)
    if inner is None:
        return None
    outer = [max(radii) for radii in zip(inner, core_radii(near.robot.size, exponent), strict=True)]
    return _boxed(near, outer, inner, exponent) if is_proved(near, errors, outer) else None


def _boxed(near: Linearisation, outer: Sequence[arb], inner: Sequence[arb], exponent: int) -> ProvedBox:
    unit = arb(2) ** exponent

    def integers(values: Sequence[arb]) -> tuple[int, ...]:
        return tuple(exact_integer(value * unit) for value in values)

    entries = near.centre.entries()
    real, imaginary = integers([v.real for v in entries]), integers([v.imag for v in entries])
    return ProvedBox(near.chart, tuple(zip(real, imaginary, strict=True)), integers(outer), integers(inner))


def _core(near: Linearisation, exponent: int) -> list[acb]:
    """Position and rotation, in the centred frames, of the nominal solution."""
    values = quantities_at(near.around(core_radii(near.robot.size, exponent)), near.robot.problem.motion)
    return [value / values[NORM] for value in values[POSITION:NORM]]


def are_distinct(real: Sequence[Sequence[acb]], pairs: Sequence[Sequence[acb]]) -> bool:
    """Whether enclosed solutions are distinct: real ones, others, and the conjugates of the others."""
    conjugates = [[value.conjugate() for value in point] for point in pairs]
    return all(
        any(not a.overlaps(b) for a, b in zip(left, right, strict=True))
        for left, right in combinations([*real, *pairs, *conjugates], 2)
    )

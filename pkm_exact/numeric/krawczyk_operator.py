"""The Krawczyk operator on the leg equations: proof that a box holds exactly one solution.

In the chart w.e = 1 the poses are the zeros of n functions of n Study coordinates x: the quadrics q_k(x) = x^T Q_k x of
the legs, Study's condition, and w.e - 1. For a box X around m and any matrix Y,

    K(X) = m - Y F(m) + (1 - Y F'(X)) (X - m).

If K(X) lies in the interior of X, then X holds exactly one zero of F, and F' is regular there. For quadrics this needs
no mean value theorem: F(x) - F(y) = F'((x + y) / 2) (x - y) exactly. Boxes are real, or complex: rectangles in every
coordinate. Two exponents per box keep e and f each on a grid of its own size.

References: Krawczyk, Computing 4 (1969); Moore, SIAM J. Numer. Anal. 14 (1977); Rump, "Solving algebraic problems with
high accuracy" (1983).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any, Final, TypeAlias

from flint import acb, acb_mat, arb, arb_mat, fmpz_mat

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.study import Quadric, pose_quadrics, support
from pkm_exact.poses.isolated_solutions import RADIUS, Box
from pkm_exact.precision import working_precision

Balls: TypeAlias = Any
"""An ``arb_mat`` or an ``acb_mat``, which have the same methods: real points are kept real, which takes less time."""

GUARD_BITS = 64
"""A box on the grid 2^-k is tested with 2 k + 64 bits: enough unless the matrix is too ill-conditioned for it."""
ROOM: Final = 2
"""Boxes must be mapped into what is this many times smaller: checkers round otherwise, and need some room."""


class ChartSystem:
    """The equations of a robot's poses in a chart, in ball arithmetic.

    Parameters
    ----------
    problem : ForwardProblem
    chart : sequence of 4 int
        w in w.e = 1.
    """

    def __init__(self, problem: ForwardProblem, chart: Sequence[int]) -> None:
        self.problem = problem
        self.chart = tuple(chart)
        self.support = support(problem)
        self.quadrics = pose_quadrics(problem)
        """Over Z; n - 1 of them."""

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return len(self.support)

    @cached_property
    def _gradients(self) -> fmpz_mat:
        """((n - 1) n) x n: all 2 Q_k, one below the other."""
        return fmpz_mat([row for quadric in self.quadrics for row in self._twice(quadric)])

    @cached_property
    def _balls(self) -> tuple[arb_mat, acb_mat]:
        """The same, exactly, to multiply real and complex points with.

        Each equation is divided by the power of 2 next to its largest coefficient: elimination takes the largest pivot,
        and among equations of very different sizes that is a bad one.
        """
        rows = self._gradients.tolist()
        scaled: list[list[arb]] = []
        for start in range(0, len(rows), self.size):
            block = rows[start : start + self.size]
            power = -max(int(abs(value)).bit_length() for row in block for value in row)
            scaled += [[arb((value, power)) for value in row] for row in block]
        balls = arb_mat(scaled)
        return balls, acb_mat(balls)

    @cached_property
    def identities(self) -> tuple[arb_mat, acb_mat]:
        """The unit matrix, real and complex."""
        unit = arb_mat(self.size, self.size, [int(i == j) for i in range(self.size) for j in range(self.size)])
        return unit, acb_mat(unit)

    def _twice(self, quadric: Quadric) -> list[list[int]]:
        place = {index: position for position, index in enumerate(self.support)}
        rows = [[0] * self.size for _ in range(self.size)]
        for (k, m), value in quadric.items():
            rows[place[k]][place[m]] += value
            rows[place[m]][place[k]] += value
        return rows

    def jacobians(self, points: Balls) -> list[Balls]:
        """F' at points that are the columns of an n x p matrix."""
        kind = type(points)
        gradients = self._balls[kind is acb_mat] * points
        size, count = self.size, points.ncols()
        entries = gradients.transpose().entries()
        last = [self.chart[index] if index < 4 else 0 for index in self.support]
        stride = size * (size - 1)
        return [kind(size, size, entries[p * stride : (p + 1) * stride] + last) for p in range(count)]

    def values(self, jacobian: Balls, point: Balls) -> Balls:
        """F at a point, from F' there: q(x) = q'(x) x / 2, and w.e - 1."""
        *doubled, last = (jacobian * point).entries()
        return type(point)(self.size, 1, [*(value / 2 for value in doubled), last - 1])


def columns(points: Sequence[Balls]) -> Balls:
    """Points, each a column, as one matrix."""
    return type(points[0])([point.entries() for point in points]).transpose()


def middle(matrix: Balls) -> Balls:
    """The midpoints of the entries, exact."""
    return matrix.mid()


def certified(system: ChartSystem, boxes: Sequence[Box]) -> list[bool]:
    """For each box whether Krawczyk's operator proves that it holds exactly one solution, and that N(e) is not 0 there.

    "No" means only that the proof fails with this box.
    """
    if not boxes:
        return []
    with working_precision(2 * max(max(box.exponents) for box in boxes) + GUARD_BITS):
        answers = [
            dict(zip(same, _proved(system, same), strict=True))
            for is_real in (True, False)
            if (same := [box for box in boxes if box.is_real == is_real])
        ]
    return [next(answer[box] for answer in answers if box in answer) for box in boxes]


def _proved(system: ChartSystem, boxes: Sequence[Box]) -> list[bool]:
    """The same for boxes that are all real, or none."""
    centres = [centre(system, box) for box in boxes]
    spreads = [_spread(system, box) for box in boxes]
    balls = [centre + spread for centre, spread in zip(centres, spreads, strict=True)]
    at_centres = system.jacobians(columns(centres))
    at_balls = system.jacobians(columns(balls))
    return [
        _maps_into_itself(system, box, centre, spread, *at) and _is_motion(system, centre + ROOM * spread)
        for box, centre, spread, *at in zip(boxes, centres, spreads, at_centres, at_balls, strict=True)
    ]


def centre(system: ChartSystem, box: Box) -> Balls:
    """The centre as a column, real if the box is, exact if the precision suffices."""
    units = [arb(2) ** -exponent for exponent in box.exponents]
    parts = [(units[index // 4], *box.centre[index]) for index in system.support]
    if box.is_real:
        return arb_mat(system.size, 1, [unit * real for unit, real, _ in parts])
    return acb_mat(system.size, 1, [acb(unit * real, unit * imaginary) for unit, real, imaginary in parts])


def ball(system: ChartSystem, box: Box) -> Balls:
    """The box as a column of balls, which may be a little larger."""
    return centre(system, box) + _spread(system, box)


def _reach(box: Box, index: int) -> arb:
    """Half the width of the box in a coordinate, exactly."""
    return RADIUS * arb(2) ** -box.exponent(index)


def _spread(system: ChartSystem, box: Box) -> Balls:
    """Balls around 0 that hold the box moved to 0; they may be a little larger, as Arb rounds radii upwards."""
    balls = [arb(0, _reach(box, index)) for index in (0, 4)]
    if box.is_real:
        return arb_mat(system.size, 1, [balls[index // 4] for index in system.support])
    squares = [acb(ball, ball) for ball in balls]
    return acb_mat(system.size, 1, [squares[index // 4] for index in system.support])


def _maps_into_itself(
    system: ChartSystem, box: Box, centre: Balls, spread: Balls, at_centre: Balls, at_ball: Balls
) -> bool:
    """Whether K(X) - m lies in the interior of the box moved to 0, with room to spare."""
    image = krawczyk_image(system, centre, spread, at_centre, at_ball)
    if image is None:
        return False
    reaches = [_reach(box, index) / ROOM for index in (0, 4)]
    for value, index in zip(image.entries(), system.support, strict=True):
        reach = reaches[index // 4]
        if not (abs(value.real) < reach and abs(value.imag) < reach):
            return False
    return True


def krawczyk_image(system: ChartSystem, centre: Balls, spread: Balls, at_centre: Balls, at_ball: Balls) -> Balls | None:
    """An enclosure of K(X) - m from m, X - m, F'(m) and F'(X); None if no matrix Y is found.

    Y may be any matrix: an approximate inverse will do.
    """
    identity = system.identities[type(centre) is acb_mat]
    try:
        inverse = at_centre.solve(identity, algorithm="approx")
    except ZeroDivisionError:
        return None
    return (identity - inverse * at_ball) * spread - inverse * system.values(at_centre, centre)


def _is_motion(system: ChartSystem, ball: acb_mat) -> bool:
    """Whether N(e) is not 0 anywhere in a column of balls."""
    metric = system.problem.metric
    norm: arb | acb = arb(0)
    for entry, index in zip(ball.entries(), system.support, strict=True):
        if index < 4:
            norm += (metric[0] * metric[1] * metric[2] if index == 0 else metric[index - 1]) * entry * entry
    return not norm.contains(0)

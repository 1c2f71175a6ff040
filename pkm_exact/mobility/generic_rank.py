"""The rank of a mechanism's wrenches at every pose of its motions: a witness from below, an identity from above.

Times N(e), the wrench of a linear form is a polynomial in the pose: of degree 2 in the Cayley coordinates of the
rotation and of degree 1 in the position. In the three columns of forces only |C|^2 brings in the position, as a matrix
of rank 1. So a minor of r rows has degree at most 2 r in the rotation, and at most 1 more than its columns of moments
in the position. A polynomial that is 0 at all points (i, j, k) with i + j + k at most its degree is 0: if the rank is
below r at all of these poses, it is so at every pose, turns by half a circle included. This is a proof, not a sample.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from itertools import product as pairs_of
from math import comb
from typing import Final

from flint import fmpz_mat

from pkm_exact.constraints.form import Form, integral
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.rotation import quaternion_norm, scaled_rotation
from pkm_exact.motions.motion import Motion
from pkm_exact.screws.exact_matrix import Row, echelon, null_space, rank

MOST_POSES: Final = 20_000
"""Poses that are looked at for an identity."""
_TRIALS: Final = ((3, -2, 5, 7, -11, 13), (-5, 7, 2, 3, 17, -6), (11, 4, -9, -8, 5, 19), (2, 13, 7, 23, -3, -10))

Pose = tuple[int, ...]
"""Cayley coordinates of the rotation, then the position, in rational coordinates."""


class Route(StrEnum):
    """How the rank at every pose was proved."""

    FULL = "full at a pose"
    COMBINATION = "one combination"
    GRID = "polynomial identity"
    NONE = "not known"


@dataclass(frozen=True)
class GenericRank:
    """The largest rank at any pose.

    Attributes
    ----------
    rank : int
        The largest rank that was met, at ``pose``; proved to be the largest at any pose unless the route is ``NONE``.
    most : int
        What it could be at most: number of rows or of freedoms.
    pose : tuple of 6 int
        Cayley coordinates and position of a pose with this rank.
    route : Route
    combinations : tuple of rows
        Independent factors of sums of the rows that are 0 at every pose, if constant ones prove the rank.
    """

    rank: int
    most: int
    pose: Pose
    route: Route
    combinations: tuple[Row, ...] = ()

    @property
    def combination(self) -> Row:
        """Factors of one sum of the rows that is 0 at every pose, or nothing."""
        return self.combinations[0] if self.combinations else ()

    @property
    def is_architecture_singularity(self) -> bool:
        """Whether the rank is proved to be less than it could be, at every pose."""
        return self.route is not Route.NONE and self.rank < self.most


def generic_rank(forms: Sequence[Form], motion: Motion, metric: Metric) -> GenericRank:
    """The largest rank of the wrenches of forms at any pose of a group of motions.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_robot
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> problem = robot.problem(robot.configuration())
    >>> found = generic_rank(problem.forms, problem.motion, problem.metric)
    >>> found.rank, str(found.route)
    (3, 'full at a pose')
    """
    matrix = fmpz_mat(len(forms), 17, [value for form in forms for value in integral(form)])
    most = min(len(forms), motion.dimension)
    best, pose = -1, _TRIALS[0]
    for trial in _TRIALS:
        found = _rank_at(matrix, trial, motion, metric)
        if found > best:
            best, pose = found, trial
    if best == most:
        return GenericRank(best, most, pose, Route.FULL)
    slopes = _slopes(forms, motion)
    if len(forms) <= motion.dimension and rank(slopes, 16) == best:
        relation = null_space(list(zip(*slopes, strict=True)), len(forms))
        return GenericRank(best, most, pose, Route.COMBINATION, relation)
    return _by_grid(matrix, pose, motion, metric, best, most)


def _by_grid(matrix: fmpz_mat, pose: Pose, motion: Motion, metric: Metric, best: int, most: int) -> GenericRank:
    """The largest rank, by the poses at which all larger minors must be 0, from a rank that was met."""
    while best < most:
        for trial in _grid(best + 1, motion):
            found = _rank_at(matrix, trial, motion, metric)
            if found > best:
                best, pose = found, trial
                break
        else:
            known = _size_of_grid(best + 1, motion) <= MOST_POSES
            return GenericRank(best, most, pose, Route.GRID if known else Route.NONE)
    return GenericRank(best, most, pose, Route.FULL)


def _slopes(forms: Sequence[Form], motion: Motion) -> list[Row]:
    """The coefficients of forms, less constants, modulo forms that are 0 for every motion of the group."""
    kept = [tuple(Fraction(value) for value in form[:16]) for form in forms]
    given = [tuple(Fraction(value) for value in form[:16]) for form in motion.forms]
    if not given:
        return kept
    rows, pivots = echelon(given, 16)
    reduced = []
    for form in kept:
        entries = list(form)
        for row, pivot in zip(rows, pivots, strict=True):
            factor = entries[pivot]
            entries = [x - factor * y for x, y in zip(entries, row, strict=True)]
        reduced.append(tuple(entries))
    return reduced


def _degrees(rows: int, motion: Motion) -> tuple[int, int]:
    """Bounds of the degrees of a minor in rotation and position."""
    moments = len([k for k in motion.twist if k >= 3])
    return (2 * rows if moments else 0), (min(rows, 1 + moments) if 0 in motion.twist else 0)


def _variables(motion: Motion) -> tuple[list[int], list[int]]:
    """Which Cayley coordinates and which coordinates of the position are free."""
    return [k - 1 for k in motion.rotation_support if k], [k for k in motion.twist if k < 3]


def _size_of_grid(rows: int, motion: Motion) -> int:
    (turn, move), (turns, moves) = _degrees(rows, motion), _variables(motion)
    return comb(turn + len(turns), len(turns)) * comb(move + len(moves), len(moves))


def _grid(rows: int, motion: Motion) -> Iterator[Pose]:
    """The poses that a minor of so many rows must be 0 at to be 0; none if they are too many."""
    if _size_of_grid(rows, motion) > MOST_POSES:
        return
    (turn, move), (turns, moves) = _degrees(rows, motion), _variables(motion)
    for angles, places in pairs_of(_simplex(len(turns), turn), _simplex(len(moves), move)):
        pose = [0] * 6
        for place, value in (*zip(turns, angles, strict=True), *zip((3 + k for k in moves), places, strict=True)):
            pose[place] = value
        yield tuple(pose)


def _simplex(count: int, degree: int) -> list[tuple[int, ...]]:
    """All points of so many coordinates 0, 1, .. with a sum of at most the degree."""
    if not count:
        return [()]
    return [(first, *rest) for first in range(degree + 1) for rest in _simplex(count - 1, degree - first)]


def placed(pose: Pose, motion: Motion) -> tuple[list[int], list[int]]:
    """The Cayley coordinates and the position of a pose, 0 where the motions have none."""
    turns, moves = _variables(motion)
    angles = [value if k in turns else 0 for k, value in enumerate(pose[:3])]
    return angles, [value if k in moves else 0 for k, value in enumerate(pose[3:])]


def _rank_at(matrix: fmpz_mat, pose: Pose, motion: Motion, metric: Metric) -> int:
    return int((matrix * _wrenches(*placed(pose, motion), motion, metric)).rank())


def _wrenches(angles: Sequence[int], position: Sequence[int], motion: Motion, metric: Metric) -> fmpz_mat:
    """The wrenches of the 17 coordinates, 17 rows, times N(e) and products of the metric's numbers."""
    products = [[a * b for b in (1, *angles)] for a in (1, *angles)]
    norm, rotation = quaternion_norm(products, metric), scaled_rotation(products, metric)
    g, c = metric, position
    scale = g[0] * g[1] * g[2]
    rows = [[2 * scale * norm * g[i] * c[i] for i in range(3)] + [0, 0, 0]]
    for j in range(3):
        moved = [g[i] * rotation[i][j] * (scale // g[j]) for i in range(3)]
        moment = [g[b] * moved[a] * c[b] - g[a] * moved[b] * c[a] for a, b in ((1, 2), (2, 0), (0, 1))]
        # The moment of a force F at C has the components g_k F_j C_k - g_j F_k C_j.
        rows.append([*moved, *moment])
    rows += [[scale * norm * int(i == k) for k in range(3)] + [0, 0, 0] for i in range(3)]
    for i in range(3):
        for column in range(3):
            moment = [0, 0, 0]
            for place, (a, b) in enumerate(((1, 2), (2, 0), (0, 1))):
                if i == b:
                    moment[place] += scale * g[a] * rotation[a][column]
                if i == a:
                    moment[place] -= scale * g[b] * rotation[b][column]
            rows.append([0, 0, 0, *moment])
    rows.append([0] * 6)
    columns = motion.twist
    return fmpz_mat(17, len(columns), [row[k] for row in rows for k in columns])

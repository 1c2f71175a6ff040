"""A start section close to one robot: many length vectors are then solved along short paths.

The section has the robot's own joints, in the robot's own frames, and complex squared lengths around given ones: it is
generic among the sections of this robot. Its solutions are tracked once from the generic start. From there to real
lengths only the constants of the legs move, along a line that meets no singular robot, with probability one. They are
tracked to the given lengths at once: where others are so close that Newton's method leads from the one's solutions to
as many of the other's, no path is needed.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.numeric.poses import Approximations
from pkm_exact.numeric.seeds import has_seeds, seeds
from pkm_exact.numeric.start import SAME, StartSection, generic_start, joined, start_quadrics
from pkm_exact.numeric.study_system import Complex, numeric_section, section_quadrics
from pkm_exact.numeric.tracker import polished, track
from pkm_exact.stages import Amount

OFFSET: Final = 0.06
"""How far the complex squared lengths are from the real ones, for a robot of size 1."""
ATTEMPTS: Final = 3
"""Times that paths are tracked, each time others, before the robot counts as one with fewer solutions."""
GREATEST_CHANGE: Final = 1e-5
"""An end point that Newton's method still moves by more than this is not taken for a solution."""
HOME_STEPS: Final = 6
"""Newton steps from the solutions at home."""
ENOUGH: Final = 1e-8
"""Corrections of this size are the last ones."""
LONG: Final = 12
"""Steps of a path, near singular poses, that take longer than an elimination template."""


def nearby_start(problem: ForwardProblem, seed: int = 0) -> StartSection | None:
    """A section of the same robot with complex lengths, and all its solutions; None if there are fewer than usual.

    Parameters
    ----------
    problem : ForwardProblem
        The robot, with lengths in the midst of those that are to be solved.
    seed : int
        Of the complex lengths.

    Raises
    ------
    OverflowError
        If a number of the robot is too large for floating point.

    Examples
    --------
    >>> from fractions import Fraction
    >>> from pkm_exact.constraints.distance import Distance
    >>> from pkm_exact.motions.motion_groups import PLANAR
    >>> joints = [((0, 0), (0, 0), 50), ((10, 0), (4, 0), 26), ((3, 10), (2, 2), 25)]
    >>> rows = [[tuple(map(Fraction, (*a, 0))), tuple(map(Fraction, (*b, 0))), Fraction(l)] for a, b, l in joints]
    >>> start = nearby_start(ForwardProblem(tuple(Distance(*row) for row in rows), motion=PLANAR))
    >>> start.solutions.shape
    (6, 4)
    """
    section, start = numeric_section(problem), generic_start(problem.motion)
    legs = section.legs.copy()
    legs[:, -1] += OFFSET * np.exp(2j * np.pi * np.random.default_rng(seed).random(len(legs)))
    quadrics = section_quadrics(legs, problem.motion)
    solutions = start.solutions[:0]
    for attempt in range(ATTEMPTS):
        with np.errstate(all="ignore"):
            from_here = start_quadrics(start, seed + attempt, problem.motion)
            ends, arrived = track(start.solutions, from_here, quadrics)
            ends, change = polished(ends[arrived], quadrics)
        solutions = joined(solutions, ends[change < GREATEST_CHANGE])
        if len(solutions) == problem.solution_bound:
            steps: list[Amount] = []
            with np.errstate(all="ignore"):
                ends, _ = track(solutions, quadrics, section.quadrics, watch=steps.append)
            home = _all_different(ends, section.quadrics)
            if home is None and has_seeds(problem):
                home = _all_different(seeds(problem).points, section.quadrics)
            home = None if home is None else _without_conjugates(home)
            return StartSection(legs, solutions, section.frames, home, len(steps) > LONG)
    return None


def from_home(problem: ForwardProblem, start: StartSection) -> Approximations | None:
    """The solutions to which Newton's method leads from those at home; None if these are not as many.

    Raises
    ------
    OverflowError
        If a number of the robot is too large for floating point.
    """
    if start.home is None:
        return None
    section = numeric_section(problem, start.frames)
    points = _all_different(start.home, section.quadrics)
    return None if points is None or _count(points) < problem.solution_bound else Approximations(section, points)


def _all_different(points: Complex, quadrics: Complex) -> Complex | None:
    """Where Newton's method leads from the points; None if it does not come to rest, or twice at the same place."""
    with np.errstate(all="ignore"):
        found, change = polished(points, quadrics, HOME_STEPS, ENOUGH)
        overlaps = np.abs(found.conj() @ found.T)
    np.fill_diagonal(overlaps, 0)
    return found if bool((change < GREATEST_CHANGE).all() and (overlaps < 1 - SAME).all()) else None


def _without_conjugates(points: Complex) -> Complex:
    """The projective points without those that are conjugate to an earlier one."""
    overlaps = np.triu(np.abs(points @ points.T), 1)
    rest: Complex = points[~(overlaps > 1 - SAME).any(axis=0)]
    return rest


def _count(points: Complex) -> int:
    """How many they are with their conjugates; 0 if one is the conjugate of another."""
    overlaps = np.abs(points @ points.T) > 1 - SAME
    alone = int(np.count_nonzero(overlaps.diagonal()))
    return 2 * len(points) - alone if np.count_nonzero(overlaps) == alone else 0

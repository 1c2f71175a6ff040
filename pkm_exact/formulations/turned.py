"""Formulations in a turned platform frame, for charts that miss a pose in the given one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import count
from random import Random
from typing import Final

from pkm_exact.formulations.base import Expression, FormulatedProblem, PoseMap
from pkm_exact.formulations.moved_platform import moved_platform
from pkm_exact.formulations.protocol import Formulation
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.geometry.rotation import composition_matrix, quaternion_norm, scaled_rotation

Turn = tuple[int, int, int, int]
"""Integer quaternion coordinates of a rational rotation Q of the platform frame."""


NO_TURN: Turn = (1, 0, 0, 0)
COMMON_TURNS: Final = 5
"""Random rotations that are tried with every robot, before those that follow from its own data."""


def candidate_turns(seed: int, own: int) -> Iterator[Turn]:
    """Rotations of the platform frame to try: none, then random ones, first by ``seed``, then by the robot's ``own``.

    Examples
    --------
    >>> next(candidate_turns(0, 1))
    (1, 0, 0, 0)
    """
    yield NO_TURN
    for random, largest, number in ((Random(seed), 9, COMMON_TURNS), (Random(own), 99, None)):
        for _ in count() if number is None else range(number):
            x, y, z, w = (random.randint(1, largest) for _ in range(4))
            yield x, y, z, w


def turned_problem(problem: ForwardProblem, turn: Turn) -> ForwardProblem:
    """The same robot with platform joints Q B: its poses (C, R') belong to poses (C, R' Q)."""
    products = [[Fraction(a * b) for b in turn] for a in turn]
    norm = quaternion_norm(products, problem.metric)
    rotation = [[entry / norm for entry in row] for row in scaled_rotation(products, problem.metric)]
    return moved_platform(problem, rotation)


def formulate_turned(formulation: Formulation, problem: ForwardProblem, turn: Turn) -> FormulatedProblem:
    """The formulation of the turned problem, with a map to the poses of the given one."""
    if turn == NO_TURN:
        return formulation.formulate(problem)
    formulated = formulation.formulate(turned_problem(problem, turn))
    matrix = composition_matrix(turn, problem.metric)
    old = formulated.pose_map.quaternion_products
    half = [[_combination(row, [old[m][k] for m in range(4)]) for k in range(4)] for row in matrix]
    products = tuple(tuple(_combination(row, line) for row in matrix) for line in half)
    return replace(formulated, pose_map=PoseMap(products, formulated.pose_map.position))


def _combination(scalars: Sequence[int], values: Sequence[Expression]) -> Expression:
    total = values[0] * scalars[0]
    for scalar, value in zip(scalars[1:], values[1:], strict=True):
        total += value * scalar
    return total

"""Positive dimension: the solutions in the representation are witnesses, they lie on curves or surfaces of poses.

Two proofs are known. (1) The six leg forms, on the 17 coordinates of rigid motions, have rank r < 6. Rigid motions are
a variety of dimension 6, so each component of its section by the legs has dimension 6 - r at least, those through the
witnesses too. (2) At a witness all legs C + R B_i - A_i are the same vector. Then the platform can move on a sphere
without turning: with R as it is, any C for which this vector keeps its length.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import lcm

from flint import fmpz_mat

from pkm_exact.certify.checker.document import Document, Representation
from pkm_exact.certify.checker.motion import PLANAR_LEGS, Leg, Metric, combination, leg_form, motion
from pkm_exact.certify.checker.solutions import primitive_part, vanishes
from pkm_exact.certify.checker.verdict import rejected


def check_self_motion(document: Document, representation: Representation) -> Iterator[str]:
    """The witnesses, already checked to be poses, lie on a set of positive dimension; nothing else is claimed."""
    others = (document.complex_solutions, document.distinct_solutions, len(document.poses), document.route)
    if others != (0, 0, 0, None) or document.elimination is not None:
        raise rejected("claim: beside positive dimension, isolated solutions or completeness are claimed")
    if len(document.legs) == PLANAR_LEGS:
        raise rejected("claim: positive-dimensional-proved is not proved for planar robots")
    rank = int(fmpz_mat([leg_form(leg, document.metric) for leg in document.legs]).rank())
    if rank < 6:
        yield f"positive dimension: the legs have rank {rank}, the robot moves in dimension {6 - rank} at least"
    elif _are_parallel(representation, document.legs, document.metric):
        yield "positive dimension: all legs are the same vector, the platform moves on a sphere without turning"
    else:
        raise rejected("claim: positive-dimensional-proved is not proved by the witnesses")


def _are_parallel(representation: Representation, legs: Sequence[Leg], metric: Metric) -> bool:
    """Whether R B_i - A_i is the same for all legs, at every root of the eliminant."""
    h0 = primitive_part(representation.eliminant)
    placed = motion(representation.quaternion, representation.translation, metric)
    first = legs[0]
    for leg in legs[1:]:
        shift = [x - y for x, y in zip(leg.platform, first.platform, strict=True)]
        base = [x - y for x, y in zip(leg.base, first.base, strict=True)]
        scale = lcm(*(value.denominator for value in (*shift, *base)))
        for row, coordinate in zip(placed.rotation, base, strict=True):
            scalars = [*(int(value * scale) for value in shift), -int(coordinate * scale)]
            if not vanishes(combination(scalars, [*row, placed.norm]), h0):
                return False
    return True

"""Positive dimension: the solutions in the representation are witnesses, they lie on curves or surfaces of poses.

Three proofs are known. (1) The leg forms, on the 17 coordinates of rigid motions, have rank r < 6. Rigid motions are a
variety of dimension 6, so each component of its section by the legs has dimension 6 - r at least, those through the
witnesses too. Planar motions are a variety of dimension 3, and linear in 8 coordinates. (2) The joints of one side lie
on a line, or in one point: whatever the pose, the platform can be turned about it. (3) At a witness all legs
C + R B_i - A_i are the same vector. Then the platform can move on a sphere, in the plane on a circle, without turning:
with R as it is, any C for which this vector keeps its length. Only there the motion is proved to be real: R is, as the
joints of no side lie on a line (in the plane: in a point) and so determine it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import lcm
from typing import Final

from flint import fmpq, fmpq_mat, fmpz_mat

from pkm_exact.certify.checker.budget import charge, limbs
from pkm_exact.certify.checker.document import Document, Representation
from pkm_exact.certify.checker.solutions import charge_products, primitive_part, vanishes
from pkm_exact.certify.checker.study_motion import PLANAR_LEGS, Leg, Metric, Point, combination, leg_form, motion
from pkm_exact.certify.checker.verdict import rejected

_NOT_REAL: Final = "that one of them is real, and the robot moves, is not proved"


def check_self_motion(document: Document, representation: Representation) -> Iterator[str]:
    """The witnesses, already checked to be poses, lie on a set of positive dimension; isolated ones need boxes."""
    numbers = (document.complex_solutions, document.distinct_solutions, len(document.poses))
    if document.isolated is None and numbers != (0, 0, 0):
        raise rejected("claim: beside positive dimension, isolated solutions are claimed without boxes")
    if document.route is not None or document.elimination is not None:
        raise rejected("claim: beside positive dimension, completeness is claimed")
    planar = len(document.legs) == PLANAR_LEGS
    freedom = 3 if planar else 6
    rank = _planar_rank(document.legs, document.metric) if planar else _rank(document.legs, document.metric)
    sides = [leg.base for leg in document.legs], [leg.platform for leg in document.legs]
    turning = max(_turning(joints, planar=planar) for joints in sides)
    if freedom - rank > turning:
        least = f"sets of dimension {freedom - rank} at least"
        yield f"positive dimension: the legs have rank {rank}, complex poses form {least}; {_NOT_REAL}"
    elif turning:
        least = f"sets of dimension {turning} at least by turning about it"
        yield f"positive dimension: joints lie on a line or in a point, complex poses form {least}; {_NOT_REAL}"
    elif _are_parallel(representation, document.legs, document.metric):
        path = "circle" if planar else "sphere"
        what = f"real poses form a {path}; the robot moves with its legs locked"
        yield f"positive dimension: all legs are the same vector, {what}"
    else:
        raise rejected("claim: positive-dimensional-proved is not proved by the witnesses")


def _rank(legs: Sequence[Leg], metric: Metric) -> int:
    return _rank_of([leg_form(leg, metric) for leg in legs])


def _rank_of(rows: Sequence[Sequence[int]]) -> int:
    """The rank over Q of a few rows."""
    words = limbs(max(abs(value).bit_length() for row in rows for value in row))
    charge(10**6 + len(rows) * words * (10**5 + 3000 * words))
    return int(fmpz_mat(rows).rank())


def _planar_rank(legs: Sequence[Leg], metric: Metric) -> int:
    """The rank on 1, r11, r21 / g1, C1, C2, u1, u2, |C|^2: there r22 = r11, r12 = -g2 r21 / g1, and r33 = 1."""
    rows = []
    for leg in legs:
        form = leg_form(leg, metric)
        cosine, sine = form[1] + form[5], metric[0] * form[4] - metric[1] * form[2]
        rows.append([form[0], cosine, sine, *form[10:12], *form[13:15], form[16]])
    return _rank_of(rows)


def _turning(joints: Sequence[Point], *, planar: bool) -> int:
    """The dimension in which a body turns that is held at these joints: 3 or 1 if they are one point or on a line."""
    shifts = [[x - y for x, y in zip(joint, joints[0], strict=True)] for joint in joints]
    spanned = int(fmpq_mat([[fmpq(x.numerator, x.denominator) for x in shift] for shift in shifts]).rank())
    if planar:
        return 1 if spanned == 0 else 0
    return {0: 3, 1: 1}.get(spanned, 0)


def _are_parallel(representation: Representation, legs: Sequence[Leg], metric: Metric) -> bool:
    """Whether R B_i - A_i is the same for all legs, at every root of the eliminant."""
    h0 = primitive_part(representation.eliminant)
    charge_products(representation, 60)
    placed = motion(representation.quaternion, representation.translation, metric)
    first = legs[0]
    for leg in legs[1:]:
        shift = [x - y for x, y in zip(leg.platform, first.platform, strict=True)]
        base = [x - y for x, y in zip(leg.base, first.base, strict=True)]
        scale = lcm(*(value.denominator for value in (*shift, *base)))
        charge_products(representation, 4 * limbs(scale.bit_length()))
        for row, coordinate in zip(placed.rotation, base, strict=True):
            scalars = [*(int(value * scale) for value in shift), -int(coordinate * scale)]
            if not vanishes(combination(scalars, [*row, placed.norm]), h0):
                return False
    return True

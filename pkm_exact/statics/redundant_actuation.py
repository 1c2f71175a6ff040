"""Redundant actuation: how actuators move together, what an error of the model does, and the metric of Park and Kim.

With as many independent actuators 2 as there are freedoms, q' = A q_2', A = J J_2^-1. If the machine is A + dA and its
controller takes A, forces that should be internal, and those that should bear a load, act on the platform: to forces
A^T c = f belong (1 + S) f, S = dA^T (A^T)^+ (Mueller, in Parallel Manipulators: Towards New Applications (2008),
chapter 5).

Park and Kim's metric: with the loops A q_a' + P q_p' = 0 between actuated or independent joints and the others, and
weights e of all joints, 0 for passive ones, G = [1; -P^-1 A]^T diag(e) [1; -P^-1 A], M = F G^-1 F^T H for the map F
from independent joints to the platform and a metric H of the task (J. Mechanical Design 121 (1999), 589-596; as quoted
by Krut et al., Robotica 22 (2004), appendix).
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb_mat, fmpq_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import interval_of
from pkm_exact.polytopes.rationals import as_fraction, rational_matrix
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.eigenvalues import eigenvalues
from pkm_exact.statics.freedom import Freedom

Table = Sequence[Sequence[Fraction]]


def perturbation_norm(nominal: AtPose, real: AtPose, independent: Sequence[int]) -> Interval:
    """The greatest singular value of S for the model of a machine at a pose, and the machine as it is.

    Parameters
    ----------
    nominal, real : AtPose
    independent : sequence of int
        Indices of as many actuators as freedoms.

    Raises
    ------
    InputError
        If these actuators are or may be dependent.
    """
    with working_precision(BITS):
        first, second = (_from_independent(Freedom(at).ball_jacobian, independent) for at in (nominal, real))
        gram = first.transpose() * first
        perturbation = (second - first).transpose() * first * gram.inv()
        values = eigenvalues(perturbation.transpose() * perturbation)
        if values is None:
            raise InputError("perturbation: the poses are not enclosed narrowly enough")
        largest = values[-1]
        return interval_of(largest.nonnegative_part().sqrt())


def _from_independent(jacobian: arb_mat, independent: Sequence[int]) -> arb_mat:
    """A = J J_2^-1."""
    chosen = [[jacobian[i, j] for j in range(jacobian.ncols())] for i in independent]
    try:
        return jacobian * arb_mat(chosen).inv()
    except (ZeroDivisionError, ValueError):
        raise InputError("independent: these actuators are or may be dependent; name as many as freedoms") from None


def park_kim(
    actuated: Table, passive: Table, weights: Sequence[Fraction], forward: Table, task: Table
) -> tuple[list[list[Fraction]], list[list[Fraction]]]:
    """G and M of Park and Kim, exactly.

    Parameters
    ----------
    actuated, passive : matrices A and P
        A row for each loop equation.
    weights : sequence of Fraction
        Of the joints of A, then of those of P.
    forward, task : matrices F and H

    Raises
    ------
    InputError
        If P is not regular.

    Examples
    --------
    >>> one, zero = Fraction(1), Fraction(0)
    >>> g, m = park_kim([[one]], [[one]], [one, one], [[one]], [[one]])
    >>> print(g[0][0], m[0][0])
    2 1/2
    """
    a, p = rational_matrix(actuated), rational_matrix(passive)
    if p.nrows() != p.ncols() or p.det() == 0:
        raise InputError("passive: the loops do not determine the passive joints; give a regular P")
    below = -(p.inv() * a)
    count = a.ncols()
    unit = rational_matrix([[Fraction(int(i == k)) for i in range(count)] for k in range(count)])
    whole = rational_matrix([*_rows(unit), *_rows(below)])
    scaled = rational_matrix([[x * w for x in row] for row, w in zip(_rows(whole), weights, strict=True)])
    g = whole.transpose() * scaled
    f, h = rational_matrix(forward), rational_matrix(task)
    m = f * g.inv() * f.transpose() * h
    return _rows(g), _rows(m)


def _rows(matrix: fmpq_mat) -> list[list[Fraction]]:
    return [[as_fraction(value) for value in row] for row in matrix.table()]

"""Stiffness of the platform, and how errors of the machine's data become errors of its pose.

    K = J^T diag(k) J                stiffness by that of the actuators, no prestress
    delta t = J_g delta g            by errors of rods and joints, W t = dW.g with W the wrenches at unit force

A leg's length by e, its base joint by a, its platform joint by b, unit vector n of the leg: W t = e + n.a - n.(R b).
References: Pott and Hiller, in Parallel Manipulators: Towards New Applications (2008), chapter 8, equations 16 to 23.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.eigenvalues import eigenvalues
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.freedom import Freedom
from pkm_exact.statics.pose_rows import WRENCH


def stiffness_balls(freedom: Freedom, stiffnesses: Sequence[Fraction]) -> arb_mat:
    """K in balls."""
    rows = freedom.ball_jacobian
    if len(stiffnesses) != rows.nrows():
        raise InputError(f"stiffness: {len(stiffnesses)} numbers; give {rows.nrows()}, one each actuator")
    with working_precision(BITS):
        weighted = arb_mat([[ball_of(k) * rows[i, j] for j in range(rows.ncols())] for i, k in enumerate(stiffnesses)])
        return rows.transpose() * weighted


def stiffness(freedom: Freedom, stiffnesses: Sequence[Fraction]) -> EnclosedMatrix:
    """The stiffness matrix: the wrench for each unit of a small displacement."""
    found, at = stiffness_balls(freedom, stiffnesses), freedom.at
    size = found.ncols()
    names = [WRENCH[k] for k in at.motion.twist]
    return EnclosedMatrix.of(names, at.twist, [[found[i, j] for j in range(size)] for i in range(size)])


def least_stiffness(freedom: Freedom, stiffnesses: Sequence[Fraction], length: Fraction | None = None) -> Interval:
    """The least eigenvalue of K, turns multiplied by the length.

    Raises
    ------
    InputError
        If translations and turns are mixed without a length, or the pose is not enclosed narrowly enough.
    """
    if freedom.has_both and length is None:
        raise InputError("stiffness: its eigenvalues mix translations and turns; give a length")
    factors = [Fraction(1) if k < 3 or length is None else 1 / length for k in freedom.at.motion.twist]
    found = stiffness_balls(freedom, stiffnesses)
    with working_precision(BITS):
        size = found.ncols()
        scaled = arb_mat([[found[i, j] * ball_of(factors[i] * factors[j]) for j in range(size)] for i in range(size)])
        values = eigenvalues(scaled)
    if values is None:
        raise InputError("stiffness: the pose is not enclosed narrowly enough for eigenvalues")
    return interval_of(values[0])


def compliance_of_wrenches(at: AtPose) -> arb_mat:
    """The inverse of the wrenches at unit force: twists by errors of the constraints, each as a length along its own.

    Raises
    ------
    InputError
        If there are not as many constraints as freedoms, or the pose is or may be singular.
    """
    rows = arb_mat([list(row.wrench) for row in at.ball_rows])
    if rows.nrows() != rows.ncols():
        raise InputError("accuracy: is for as many constraints as freedoms; give such a machine")
    try:
        with working_precision(BITS):
            return rows.inv()
    except ZeroDivisionError:
        raise InputError("accuracy: the pose is or may be singular; give another") from None


def rod_errors(at: AtPose) -> EnclosedMatrix:
    """J_g for errors along each constraint: of legs and rods, of their lengths."""
    found = compliance_of_wrenches(at)
    names = [f"error({equation.name})" for equation in at.equations]
    rows = [[found[i, j] for j in range(found.ncols())] for i in range(found.nrows())]
    return EnclosedMatrix.of(at.twist, names, rows)


def greatest_displacement(at: AtPose, errors: Sequence[Fraction]) -> Interval:
    """First order: the norm of the displacement of the platform's origin for given errors along the constraints."""
    found = compliance_of_wrenches(at)
    with working_precision(BITS):
        total = arb(0)
        for i, k in enumerate(at.motion.twist):
            if k < 3:
                part = sum((found[i, j] * ball_of(error) for j, error in enumerate(errors)), arb(0))
                total += part * part
        return interval_of(total.nonnegative_part().sqrt())


def amplification(at: AtPose) -> Interval:
    """The norm of Frobenius of the position rows of J_g: how independent equal errors along constraints grow."""
    found = compliance_of_wrenches(at)
    with working_precision(BITS):
        total = arb(0)
        for i, k in enumerate(at.motion.twist):
            if k < 3:
                total += sum((found[i, j] * found[i, j] for j in range(found.ncols())), arb(0))
        return interval_of(total.nonnegative_part().sqrt())

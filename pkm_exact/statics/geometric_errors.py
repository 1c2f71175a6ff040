"""How errors of all geometric parameters of legs become errors of the pose, to first order: J_g.

For a leg with unit vector n, an error e of its length, a of its base joint in the base, b of its platform joint in the
platform: W t = e + n.a - n.(R b), W the wrenches at unit force, so that with C = W^-1 the columns of J_g are C_i, C_i
n_k and -C_i (R^T n)_k. An offset of an axis or a joint is such an error, along its direction: a virtual joint (Pott and
Hiller, in Parallel Manipulators: Towards New Applications (2008), chapter 8).
"""

from __future__ import annotations

from fractions import Fraction

from flint import arb

from pkm_exact.errors import InputError
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.precision import working_precision
from pkm_exact.radicals import RootSum
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import BITS, AtPose
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.stiffness import compliance_of_wrenches

_AXES = "xyz"


def geometric_jacobian(at: AtPose) -> EnclosedMatrix:
    """J_g of a spatial machine whose constraints are legs and rods: 7 columns for each, in ordinary coordinates.

    Raises
    ------
    InputError
        If the motion is not spatial, or the pose is or may be singular.
    """
    names, columns = _columns(at)
    rows = [[column[i] for column in columns] for i in range(6)]
    return EnclosedMatrix.of(at.twist, names, rows)


def worst_displacement(at: AtPose, lengths: Fraction, joints: Fraction) -> Interval:
    """First order: a bound of the displacement of the origin for errors of lengths and of coordinates up to these.

    The norm of the greatest errors of its three coordinates, each attained by some errors.
    """
    _, columns = _columns(at)
    with working_precision(BITS):
        total = arb(0)
        for i in range(3):
            part = arb(0)
            for k, column in enumerate(columns):
                part += abs(column[i]) * ball_of(lengths if k % 7 == 0 else joints)
            total += part * part
        return interval_of(total.sqrt())


def _columns(at: AtPose) -> tuple[list[str], list[list[arb]]]:
    if at.motion.name != "spatial":
        raise InputError("accuracy: errors of all parameters are for spatial motions; give such a machine")
    compliance = compliance_of_wrenches(at)
    names: list[str] = []
    columns: list[list[arb]] = []
    with working_precision(BITS):
        rotation = _rotation(at)
        for leg, (equation, row) in enumerate(zip(at.equations, at.ball_rows, strict=True)):
            force = row.wrench[:3]
            turned = [sum((rotation[i][k] * force[i] for i in range(3)), arb(0)) for k in range(3)]
            factors = [arb(1), *force, *(-x for x in turned)]
            columns += [[compliance[i, leg] * factor for i in range(6)] for factor in factors]
            names.append(f"length({equation.name})")
            names += [f"{side}.{axis}({equation.name})" for side in ("base", "platform") for axis in _AXES]
    return names, columns


def _rotation(at: AtPose) -> list[list[arb]]:
    if not at.is_exact:
        return [[ball_of(entry.lo).union(ball_of(entry.hi)) for entry in row] for row in at.rotation]
    g = at.metric
    return [
        [ball_of(RootSum.root(Fraction(g[i], g[j])) * entry) for j, entry in enumerate(row)]
        for i, row in enumerate(at.rotation)
    ]

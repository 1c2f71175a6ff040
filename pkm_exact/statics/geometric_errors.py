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
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.enclosed_matrix import EnclosedMatrix
from pkm_exact.statics.stiffness import compliance_of_wrenches

_AXES = "xyz"


def geometric_jacobian(at: AtPose) -> EnclosedMatrix:
    """J_g of a machine whose constraints are legs and rods, in ordinary coordinates.

    7 columns for each of a spatial machine, 5 of a planar one: length, base joint, platform joint.

    Raises
    ------
    InputError
        If the motion is neither spatial nor planar, a constraint exerts no force, or the pose is or may be singular.
    """
    names, columns = _columns(at)
    rows = [[column[i] for column in columns] for i in range(len(at.twist))]
    return EnclosedMatrix.of(at.twist, names, rows)


def worst_displacement(at: AtPose, lengths: Fraction, joints: Fraction) -> Interval:
    """First order: a bound of the displacement of the origin for errors of lengths and of coordinates up to these.

    The norm of the greatest errors of its three coordinates, each attained by some errors.
    """
    _, columns = _columns(at)
    size = _size(at)
    with working_precision(BITS):
        total = arb(0)
        for i in range(size):
            part = arb(0)
            for k, column in enumerate(columns):
                part += abs(column[i]) * ball_of(lengths if k % (2 * size + 1) == 0 else joints)
            total += part * part
        return interval_of(total.nonnegative_part().sqrt())


def force_parts(at: AtPose) -> list[tuple[list[arb], list[arb]]]:
    """Of every constraint the unit force n, in the base, and the same in coordinates of the platform, R^T n.

    Raises
    ------
    InputError
        As ``geometric_jacobian``.
    """
    size, found = _size(at), []
    with working_precision(BITS):
        rotation = ordinary_rotation(at)
        for equation, row in zip(at.equations, at.ball_rows, strict=True):
            force = list(row.wrench[:size])
            if all(x.contains(0) for x in force):
                raise InputError(f"accuracy: {equation.name} exerts no force; give a machine of legs and rods")
            turned = [sum((rotation[i][k] * force[i] for i in range(size)), arb(0)) for k in range(size)]
            found.append((force, turned))
    return found


def _size(at: AtPose) -> int:
    """Coordinates of a joint."""
    if at.motion.name not in ("spatial", "planar"):
        raise InputError("accuracy: errors of all parameters are for spatial and planar motions; give such a machine")
    return 2 if at.motion.is_planar else 3


def _columns(at: AtPose) -> tuple[list[str], list[list[arb]]]:
    size = _size(at)
    compliance = compliance_of_wrenches(at)
    names: list[str] = []
    columns: list[list[arb]] = []
    with working_precision(BITS):
        for leg, (equation, (force, turned)) in enumerate(zip(at.equations, force_parts(at), strict=True)):
            factors = [arb(1), *force, *(-x for x in turned)]
            columns += [[compliance[i, leg] * factor for i in range(len(at.twist))] for factor in factors]
            names.append(f"length({equation.name})")
            names += [f"{side}.{axis}({equation.name})" for side in ("base", "platform") for axis in _AXES[:size]]
    return names, columns


def ordinary_position(at: AtPose) -> list[arb]:
    """The platform's origin in ordinary coordinates."""
    if not at.is_exact:
        return [ball_of(entry.lo).union(ball_of(entry.hi)) for entry in at.position]
    return [ball_of(RootSum.root(Fraction(g)) * entry) for g, entry in zip(at.metric, at.position, strict=True)]


def ordinary_rotation(at: AtPose) -> list[list[arb]]:
    """The rotation matrix in ordinary coordinates."""
    if not at.is_exact:
        return [[ball_of(entry.lo).union(ball_of(entry.hi)) for entry in row] for row in at.rotation]
    g = at.metric
    return [
        [ball_of(RootSum.root(Fraction(g[i], g[j])) * entry) for j, entry in enumerate(row)]
        for i, row in enumerate(at.rotation)
    ]

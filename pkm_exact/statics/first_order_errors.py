"""Greatest errors of a pose to first order, and beside them what is proved for all robots within tolerance.

To first order an error of leg i moves the platform by C_i E_i, C = W^-1 and |E_i| at most

    e_i = lengths + base |n|_1 + platform |R^T n|_1,

which some errors within tolerance attain, each leg by itself. So a component k of the error is at most sum |C_ki| e_i,
and the greatest norm is taken at a vertex of the box of the E_i: all of them are tried. This is no bound for robots
with finite errors: ``numeric.tolerance`` proves one, and ``beside_box`` puts both side by side.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING

from flint import arb, arb_mat

from pkm_exact.errors import InputError
from pkm_exact.geometry.tolerances import Tolerances
from pkm_exact.polytopes.enclosures import ball_of, interval_of
from pkm_exact.precision import working_precision
from pkm_exact.roots.interval import Interval
from pkm_exact.statics.at_pose import AtPose
from pkm_exact.statics.ball_rows import BITS
from pkm_exact.statics.geometric_errors import force_parts, ordinary_position, ordinary_rotation
from pkm_exact.statics.stiffness import compliance_of_wrenches

if TYPE_CHECKING:
    from pkm_exact.numeric.tolerance_result import ToleranceBox


@dataclass(frozen=True)
class FirstOrderErrors:
    """Greatest errors to first order, each attained to first order by some errors of the data.

    Attributes
    ----------
    components : tuple of Interval
        Of the displacement (unit of length) and the turn (radians), in the order of the twist.
    displacement, turn : Interval
        The norms.
    """

    components: tuple[Interval, ...]
    displacement: Interval
    turn: Interval


@dataclass(frozen=True)
class BesideBox:
    """A greatest error to first order beside the proved one.

    Attributes
    ----------
    first_order : Interval
    certified : Interval
        The greatest error over all robots within tolerance lies in it.
    """

    first_order: Interval
    certified: Interval


def first_order_errors(at: AtPose, tolerances: Tolerances) -> FirstOrderErrors:
    """Greatest errors of the pose to first order for errors of joints and lengths within tolerance.

    Raises
    ------
    InputError
        If the machine is not one of legs and rods, as many as freedoms, or the pose is or may be singular.

    Examples
    --------
    >>> from pkm_exact import Robot, Tolerances
    >>> at = Robot.load("models/3-rpr-merlet-p.toml").at({"position": [5, "9/2"], "half_tangent": "1/3"})
    >>> found = first_order_errors(at, Tolerances.uniform("1/1000"))
    >>> len(found.components), found.turn.width < 1e-12, found.turn.lo > 0
    (3, True, True)
    """
    parts, compliance = force_parts(at), compliance_of_wrenches(at)
    with working_precision(BITS):
        base, platform, lengths = map(ball_of, (tolerances.base, tolerances.platform, tolerances.lengths))
        bounds = [lengths + base * _taxicab(force) + platform * _taxicab(turned) for force, turned in parts]
        effects = [[compliance[k, i] * e for i, e in enumerate(bounds)] for k in range(len(at.twist))]
        moved = [row for k, row in zip(at.motion.twist, effects, strict=True) if k < 3]
        turned_by = [row for k, row in zip(at.motion.twist, effects, strict=True) if k >= 3]
        return FirstOrderErrors(
            tuple(interval_of(_taxicab(row)) for row in effects), _greatest_norm(moved), _greatest_norm(turned_by)
        )


def beside_box(at: AtPose, tolerances: Tolerances, box: ToleranceBox) -> dict[str, BesideBox]:
    """ "displacement" and "turn" to first order, beside the box that is proved of the same pose and tolerances.

    Raises
    ------
    InputError
        If no box is proved, or it is that of another pose.
    """
    if box.bounds is None:
        raise InputError(f"accuracy: no box is proved for pose {box.pose}; give smaller tolerances")
    if not _is_same_pose(at, box.bounds.components):
        raise InputError(f"accuracy: the box is that of another pose, {box.pose}; give the one of this pose")
    found = first_order_errors(at, tolerances)
    return {
        "displacement": BesideBox(found.displacement, box.bounds.position_error),
        "turn": BesideBox(found.turn, box.bounds.rotation_error),
    }


def _is_same_pose(at: AtPose, components: Sequence[Interval]) -> bool:
    """Whether position and rotation can lie in the bounds."""
    with working_precision(BITS):
        mine = [*ordinary_position(at), *(entry for row in ordinary_rotation(at) for entry in row)]
        return all(a.overlaps(ball_of(b.lo).union(ball_of(b.hi))) for a, b in zip(mine, components, strict=False))


def _taxicab(values: Sequence[arb]) -> arb:
    return sum((abs(value) for value in values), arb(0))


def _greatest_norm(rows: Sequence[Sequence[arb]]) -> Interval:
    """The greatest norm of the sum of the columns with any signs."""
    if not rows:
        return interval_of(Fraction(0))
    matrix, count, best = arb_mat([list(row) for row in rows]), len(rows[0]), arb(0)
    for signs in product((1, -1), repeat=count - 1):
        moved = (matrix * arb_mat(count, 1, [1, *signs])).entries()
        best = best.max(sum((value * value for value in moved), arb(0)))
    return interval_of(best.nonnegative_part().sqrt())

"""A point in the plane on rods that stand on slides: biglide (PRRRP), V-shape, and machines with more slides than
freedoms.

    biglide    two vertical slides at x1 and x2                   (micabo f; Stan, Maties and Balan, ch. 14)
    V-shape    two perpendicular slides                           (Krut, Company and Pierrot, Robotica 22 (2004), fig.
    6) PMAR       slides through any points in any directions        (ibid., fig. 8 and 10: collinear; at 120 degrees)
    X-Y        two coordinates driven one by one

(x - K_i)^2 = l_i^2 with K_i = A_i + q_i d_i: two poses of two slides. Of three, the differences are linear, and their
one pose, if any, exists only if the positions fit together: the synchronisation equation.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.errors import InputError
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import numbers, rods, vectors
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.machines.triangle import ORIGIN, UP
from pkm_exact.motions.motion_groups import TRANSLATION

_ZERO: Final = Fraction(0)
_ONE: Final = Fraction(1)
_X: Final[Vector] = (_ONE, _ZERO, _ZERO)
_Y: Final[Vector] = (_ZERO, _ONE, _ZERO)
_PLANE: Final = InPlane(UP, _ZERO, ORIGIN, "plane")


def _on_slides(feet: tuple[Vector, ...], directions: tuple[Vector, ...], squares: tuple[Fraction, ...]) -> Assembly:
    if len(squares) == 1:
        squares = squares * len(feet)
    if not len(feet) == len(directions) == len(squares):
        raise InputError(
            f"dimensions: {len(feet)} feet, {len(directions)} directions and {len(squares)} rods; give one per slide"
        )
    rods_: list[Constraint] = []
    drives = []
    for k, (foot, direction, square) in enumerate(zip(feet, directions, squares, strict=True), 1):
        rods_.append(Distance(foot, ORIGIN, square, f"rod {k}"))
        drives.append(Drive(f"slide {k}", (Part(f"rod {k}", "base", (direction,)),)))
    group = Group(Joint.SLIDE, tuple(drive.name for drive in drives))
    return Assembly((*rods_, _PLANE), (group,), tuple(drives))


def _biglide(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - positions are given
    feet = tuple((x, _ZERO, _ZERO) for x in given["x"])
    return _on_slides(feet, (_Y, _Y), given["rod"])


def _v_shape(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001
    return _on_slides((ORIGIN, ORIGIN), (_X, _Y), given["rod"])


def _pmar(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001
    return _on_slides(given["feet"], given["directions"], given["rod"])


def _x_y(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001
    planes = InPlane(_X, _ZERO, ORIGIN, "x"), InPlane(_Y, _ZERO, ORIGIN, "y")
    return Assembly((*planes, _PLANE), (Group(Joint.OFFSET, ("x", "y")),))


BIGLIDE: Final = MachineKind(
    "biglide",
    "a point in the plane: two vertical slides, two rods (PRRRP)",
    TRANSLATION,
    (numbers("x", "where the slides are", "[4, -4]", 2), rods(2, "5")),
    _biglide,
    {"slides": "[3, 3]"},
    ((0, 0, 0), (1, 0, 0, 0)),
)
V_SHAPE: Final = MachineKind(
    "V-shape",
    "a point in the plane: two perpendicular slides, two rods",
    TRANSLATION,
    (rods(2, "5"),),
    _v_shape,
    {"slides": "[5, 5]"},
    ((0, 0, 0), (1, 0, 0, 0)),
)
PMAR: Final = MachineKind(
    "PMAR",
    "a point in the plane: more slides and rods than it has freedoms",
    TRANSLATION,
    (
        vectors("feet", "a point on each slide", "[[0, 0], [0, 0], [0, 0]]", None, 2),
        vectors("directions", "of the slides", '[[1, 0], ["-3/5", "4/5"], ["-3/5", "-4/5"]]', None, 2),
        rods(None, "5"),
    ),
    _pmar,
    {"slides": "[5, 5, 5]"},
    ((0, 0, 0), (1, 0, 0, 0)),
    own_metric=True,
)
X_Y: Final = MachineKind(
    "X-Y",
    "a point in the plane: both coordinates driven",
    TRANSLATION,
    (),
    _x_y,
    {"offsets": "[3, 4]"},
    ((3, 4, 0), (1, 0, 0, 0)),
)

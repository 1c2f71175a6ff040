"""A hexapod on a carriage: two slides, a heading, a tilted arm, and six legs of actuated length on the arm's end.

With the heading f, slides at X and Y, and the arm of length r1 tilted by t at the distance r0,

    A_i = (X, Y, 0) + Rz(f) ((0, r0, 0) + Rx(t) ((0, r1, 0) + a_i)),        |C + R B_i - A_i| = l_i

so that forward kinematics is that of the hexapod, forty poses in general. The arm's end is at z = r1 sin t,
x = X - (r0 + r1 cos t) sin f, y = Y + (r0 + r1 cos t) cos f: the source turns f by 90 degrees against its own axes.
Reference: Wu, Handroos and Pessi in Parallel Manipulators: Towards New Applications (2008), ch. 17, (3) to (10).
"""

from __future__ import annotations

from fractions import Fraction
from typing import Final

from pkm_exact.constraints.constraint import Constraint
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.chains import CosSin
from pkm_exact.geometry.drives import Drive, Part
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.machines.dimension_readers import length, turn, vectors
from pkm_exact.geometry.machines.machine_kind import Assembly, Dimensions, Group, Joint, MachineKind
from pkm_exact.geometry.surds import Surd
from pkm_exact.motions.motion_groups import SPATIAL

_ZERO: Final = Fraction(0)
_ONE: Final = Fraction(1)
_HEADINGS: Final = {"0": (_ONE, _ZERO), "90": (_ZERO, _ONE), "180": (-_ONE, _ZERO), "-90": (_ZERO, -_ONE)}
"""Cosine and sine."""


def assemble(given: Dimensions, metric: Metric) -> Assembly:  # noqa: ARG001 - no turns but exact ones
    """Six legs whose feet the carriage moves together."""
    heading = given["heading"]
    legs: list[Constraint] = []
    parts: dict[str, list[Part]] = {"X": [], "Y": [], "tilt": []}
    for k, ((x, y, z), joint) in enumerate(zip(given["base"], given["platform"], strict=True), 1):
        name = f"leg {k}"
        legs.append(Distance(_turned((x, given["reach"], _ZERO), heading), joint, Fraction(1), name))
        arm = y + given["arm"]
        tilted = _turned((_ZERO, arm, z), heading), _turned((_ZERO, -z, arm), heading)
        parts["X"].append(Part(name, "base", ((Fraction(1), _ZERO, _ZERO),)))
        parts["Y"].append(Part(name, "base", ((_ZERO, Fraction(1), _ZERO),)))
        parts["tilt"].append(Part(name, "base", tilted))
    drives = [
        Drive("X", tuple(parts["X"])),
        Drive("Y", tuple(parts["Y"])),
        Drive("tilt", tuple(parts["tilt"]), weight=1),
    ]
    groups = (
        Group(Joint.LENGTH, tuple(leg.name for leg in legs)),
        Group(Joint.SLIDE, ("X", "Y")),
        Group(Joint.CRANK, ("tilt",)),
    )
    return Assembly(tuple(legs), groups, tuple(drives))


def _turned(vector: Vector, heading: CosSin) -> Vector:
    (x, y, z), (c, s) = vector, heading
    return c * x - s * y, s * x + c * y, z


def carriage_branches(
    end: Vector, reach: Fraction, arm: Fraction, heading: str | CosSin
) -> tuple[tuple[Surd, Surd, Surd, Fraction], ...]:
    """The carriage positions X, Y and the cosine and sine of the tilt that bring the arm's end to a point.

    Two branches, which meet where the arm is upright, or none.

    Examples
    --------
    >>> found = carriage_branches((Fraction(1), Fraction(2), Fraction(3)), Fraction(2), Fraction(5), "0")
    >>> [[str(x) for x in branch] for branch in found]
    [['1', '4', '-4/5', '3/5'], ['1', '-4', '4/5', '3/5']]
    """
    x, y, z = end
    sine = z / arm
    square = 1 - sine * sine
    if square < 0:
        return ()
    root, (c, s) = Surd.root_of(square), _HEADINGS[heading] if isinstance(heading, str) else heading
    found = []
    for sign in (Fraction(-1), Fraction(1)) if square else (Fraction(1),):
        cosine = root.scaled(sign)
        found.append(
            (cosine.scaled(arm * s).plus(x + reach * s), cosine.scaled(-arm * c).plus(y - reach * c), cosine, sine)
        )
    return tuple(found)


_FEET: Final = "[[6, 0, 0], [0, 5, 1], [-5, 1, 0], [1, -6, 0], [4, 4, 0], [-3, 5, -1]]"
_JOINTS: Final = "[[3, 1, 0], [1, 3, 1], [-2, 1, 0], [0, -3, 1], [2, 2, -1], [-1, 2, 0]]"
CARRIAGE: Final = MachineKind(
    "carriage-hexapod",
    "a hexapod on a carriage with two slides, a heading and a tilted arm",
    SPATIAL,
    (
        vectors("base", "joints of the hexapod's base, from the arm's end", _FEET, 6),
        vectors("platform", "joints of its platform", _JOINTS, 6),
        length("reach", "r0, from the slides to the arm's hinge", "2"),
        length("arm", "r1, the length of the arm", "5"),
        turn("heading", "degrees about the vertical: 0, 90, 180, -90, or { degrees = 30 }", _HEADINGS),
    ),
    assemble,
    {
        "lengths_squared": '["6933/116", "10277/580", "22781/580", "178607/1740", "34763/1740", "20773/580"]',
        "slides": "[1, 2]",
        "half_tangents": '["1/3"]',
    },
    has_modes=False,
)

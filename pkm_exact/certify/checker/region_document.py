"""The content of a region certificate, read into typed values; nothing in it is believed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Final

from pkm_exact.certify.checker.spelling import choice, count, entries, integer, items, positive, rational, text
from pkm_exact.certify.checker.verdict import malformed, too_large

MOST_LEGS: Final = 12
MOST_FORMS: Final = 64
MOST_SHAPES: Final = 64
MOST_STEPS: Final = 120
NAMES: Final = ("x", "y", "z", "roll", "pitch", "yaw")
CONDITIONS: Final = ("reachable", "limits", "no_type_1", "no_type_2")
REGULAR: Final = "regular"
"""In version 2 in the place of ``no_type_2``."""
CLAIMS: Final = ("all", "not-all", "undecided", "map")
TWISTS: Final = {
    "spatial": (0, 1, 2, 3, 4, 5),
    "planar": (0, 1, 5),
    "schoenflies": (0, 1, 2, 5),
    "translation": (0, 1, 2),
    "spherical": (3, 4, 5),
}
SQUARED_COSINES: Final = {
    30: Fraction(3, 4),
    45: Fraction(1, 2),
    60: Fraction(1, 4),
    90: Fraction(0),
    120: Fraction(1, 4),
    135: Fraction(1, 2),
    150: Fraction(3, 4),
    180: Fraction(1),
}
KEYS: Final = (
    "format",
    "version",
    "robot",
    "chart",
    "shape",
    "conditions",
    "modes",
    "claim",
    "axes",
    "paving",
    "inside",
    "undecided",
    "measure",
    "counterexample",
)
ROBOT: Final = (
    "name",
    "unit",
    "source",
    "motion",
    "metric",
    "legs",
    "forms",
    "base_cones",
    "platform_cones",
    "position",
)

LEG: Final = ("name", "base", "platform", "actuator", "reach")
CHART: Final = ("variables", "box", "position", "quaternion", "turns")

Vector = tuple[Fraction, ...]
Pair = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class LegEntry:
    """A leg: its joints, what moves its lower end, and its limits.

    ``axes`` are empty for a leg of own length; d of a slide; u and v of a crank. Of a rod that slides along an axis
    what is perpendicular to it counts.
    """

    base: Vector
    platform: Vector
    axes: tuple[Vector, ...]
    weight: int
    rod_squared: Fraction
    reach: Pair | None
    axis: Vector | None = None


@dataclass(frozen=True)
class Cone:
    """An axis, and the greatest angle in degrees."""

    axis: Vector
    degrees: int


@dataclass(frozen=True)
class ShapePart:
    """constant + linear.p - sum of weights p^2 is not negative in the region."""

    constant: Fraction
    linear: Vector
    weights: Vector


@dataclass(frozen=True)
class Tube:
    """All positions at most the radius from the path through the corners."""

    corners: tuple[Vector, ...]
    radius: Fraction


@dataclass(frozen=True)
class RegionDocument:
    """What a region certificate says; what version 1 has no word for is at the end."""

    twist: tuple[int, ...]
    metric: tuple[int, ...]
    legs: tuple[LegEntry, ...]
    forms: tuple[Vector, ...]
    base_cones: tuple[Cone, ...]
    platform_cones: tuple[Cone, ...]
    position: tuple[Pair, ...]
    variables: tuple[str, ...]
    box: tuple[Pair, ...]
    place: tuple[Fraction | str, ...]
    quaternion: Vector | None
    turns: tuple[tuple[Fraction | str, ...], ...]
    shape: tuple[ShapePart, ...]
    conditions: tuple[str, ...]
    modes: tuple[int, ...]
    claim: str
    axes: tuple[int, ...]
    paving: str
    inside: int
    undecided: int
    measure: Pair | None
    points: tuple[Vector, ...]
    leg_distance: Fraction | None = None
    path: tuple[Vector, ...] | None = None
    tube: Tube | None = None
    joints: tuple[Pair, ...] = ()
    directions: tuple[Vector | None, ...] = ()
    member: Vector = ()
    parameters: tuple[str, ...] = ()
    by_matrix: bool = False

    @property
    def asked(self) -> tuple[str, ...]:
        """The conditions as the certificate names them: ``by_matrix`` the last one is "regular"."""
        return (*self.conditions[:-1], REGULAR) if self.by_matrix else self.conditions


def read_region(body: dict[str, Any], first: tuple[str, ...] = (), last: tuple[str, ...] = ()) -> RegionDocument:
    """The content of a region certificate of version 1, or a refusal if it has not the shape of one.

    Parameters
    ----------
    body : dict
    first, last : tuple of str
        Variables of version 2 that come before those of version 1, and parameters of designs that come after them.
    """
    values = entries(body, "certificate", KEYS)
    _, _, robot, chart, shape, conditions, modes, claim, axes, paving, inside, undecided, measure, points = values
    motion, metric, legs, forms, base_cones, platform_cones, position = _robot(robot)
    variables, box, place, quaternion, turns = _chart(chart, motion, first, last)
    asked = items(conditions, "conditions", None, lambda value, where: choice(value, where, CONDITIONS))
    if list(asked) != [name for name in CONDITIONS if name in asked] or not asked:
        raise malformed("conditions: none, or not in their order")
    steps = items(axes, "axes", None, integer)
    if len(steps) > MOST_STEPS:
        raise too_large(f"axes: more than {MOST_STEPS}")
    if any(not 0 <= axis < len(variables) - len(last) for axis in steps):
        raise malformed("axes: one is not that of a variable")
    signs = items(modes, "modes", len(legs), integer)
    if any(sign not in (-1, 0, 1) for sign in signs):
        raise malformed("modes: one is not -1, 0 or 1")
    letters = "siouynx+-" if last else "siou"
    if not isinstance(paving, str) or set(paving) - set(letters):
        raise malformed(f"paving: not a word of the letters {', '.join(letters)}")
    return RegionDocument(
        TWISTS[motion],
        metric,
        legs,
        forms,
        base_cones,
        platform_cones,
        position,
        variables,
        box,
        place,
        quaternion,
        turns,
        _limited(items(shape, "shape", None, _shape_part), "shape", MOST_SHAPES),
        asked,
        signs,
        choice(claim, "claim", ("designs",) if last else CLAIMS),
        steps,
        paving,
        count(inside, "inside"),
        count(undecided, "undecided"),
        None if measure is None else read_pair(measure, "measure"),
        items(points, "counterexample", None, lambda value, where: items(value, where, len(variables), rational)),
    )


def _limited(found: tuple[Any, ...], where: str, most: int) -> Any:
    if len(found) > most:
        raise too_large(f"{where}: more than {most}")
    return found


def read_vector(value: object, where: str) -> Vector:
    return items(value, where, 3, rational)


def read_pair(value: object, where: str) -> Pair:
    low, high = items(value, where, 2, rational)
    if low > high:
        raise malformed(f"{where}: ends out of order")
    return low, high


def _robot(value: object) -> tuple[Any, ...]:
    name, unit, source, motion, metric, legs, forms, base_cones, platform_cones, position = entries(
        value, "robot", ROBOT
    )
    for entry, key in ((name, "name"), (unit, "unit"), (source, "source")):
        text(entry, f"robot.{key}")
    moves = choice(motion, "robot.motion", tuple(TWISTS))
    numbers = items(metric, "robot.metric", 3, positive)
    if any(g.denominator != 1 for g in numbers):
        raise malformed("robot.metric: not whole numbers")
    found = _limited(items(legs, "robot.legs", None, _leg), "robot.legs", MOST_LEGS)
    if not found:
        raise malformed("robot.legs: none")
    read = items(forms, "robot.forms", None, lambda entry, where: items(entry, where, 17, rational))
    cones = [
        items(entry, where, None, _cone)
        for entry, where in ((base_cones, "base_cones"), (platform_cones, "platform_cones"))
    ]
    if any(len(entry) not in (0, len(found)) for entry in cones):
        raise malformed("robot: cones are not as many as legs")
    pairs = items(position, "robot.position", None, read_pair)
    if len(pairs) > 3:
        raise malformed("robot.position: more than 3")
    exact = tuple(map(int, numbers))
    _require_cranks(found, exact)
    return moves, exact, found, _limited(read, "robot.forms", MOST_FORMS), cones[0], cones[1], pairs


def _require_cranks(legs: Sequence[LegEntry], metric: Sequence[int]) -> None:
    for leg in legs:
        if not leg.axes:
            continue
        squares = [sum(g * x * x for g, x in zip(metric, axis, strict=True)) for axis in leg.axes]
        if not squares[0]:
            raise malformed("robot.legs: an axis is 0")
        if len(leg.axes) == 2:
            u, v = leg.axes
            product = sum(g * a * b for g, a, b in zip(metric, u, v, strict=True))
            if squares[1] != leg.weight * squares[0] or product != 0:
                raise malformed("robot.legs: a crank does not turn on a circle")


def _leg(value: object, where: str) -> LegEntry:
    name, base, platform, actuator, reach = entries(value, where, LEG)
    text(name, f"{where}.name")
    joints = read_vector(base, f"{where}.base"), read_vector(platform, f"{where}.platform")
    limits = None if reach is None else read_pair(reach, f"{where}.reach")
    kind = actuator.get("type") if isinstance(actuator, dict) else None
    inside = f"{where}.actuator"
    if kind == "slide":
        _, direction, rod = entries(actuator, inside, ("type", "direction", "rod_squared"))
        axes: tuple[Vector, ...] = (read_vector(direction, f"{inside}.direction"),)
        return LegEntry(*joints, axes, 1, positive(rod, f"{inside}.rod_squared"), limits)
    if kind == "crank":
        _, first, second, weight, rod = entries(actuator, inside, ("type", "at_0", "at_90", "weight", "rod_squared"))
        axes = read_vector(first, f"{inside}.at_0"), read_vector(second, f"{inside}.at_90")
        share = positive(weight, f"{inside}.weight")
        if share.denominator != 1 or (limits is not None and (share != 1 or any(end % 90 != 0 for end in limits))):
            raise malformed(
                f"{inside}: a weight that is no whole number, or limits that are no multiples of 90 degrees"
            )
        return LegEntry(*joints, axes, int(share), positive(rod, f"{inside}.rod_squared"), limits)
    entries(actuator, inside, ("type",))
    choice(kind, f"{inside}.type", ("length",))
    if limits is not None and limits[0] < 0:
        raise malformed(f"{where}.reach: a length is negative")
    return LegEntry(*joints, (), 1, Fraction(0), limits)


def _cone(value: object, where: str) -> Cone:
    axis, degrees = entries(value, where, ("axis", "degrees"))
    angle = rational(degrees, f"{where}.degrees")
    if angle not in SQUARED_COSINES:
        raise malformed(f"{where}.degrees: its cosine has no rational square")
    vector = read_vector(axis, f"{where}.axis")
    if not any(vector):
        raise malformed(f"{where}.axis: is 0")
    return Cone(vector, int(angle))


def _shape_part(value: object, where: str) -> ShapePart:
    constant, linear, weights = entries(value, where, ("constant", "linear", "weights"))
    return ShapePart(
        rational(constant, f"{where}.constant"),
        read_vector(linear, f"{where}.linear"),
        read_vector(weights, f"{where}.weights"),
    )


def _chart(value: object, motion: str, first: tuple[str, ...], last: tuple[str, ...]) -> tuple[Any, ...]:
    names, box, position, quaternion, turns = entries(value, "chart", CHART)
    known = (*first, *NAMES, *last)
    variables = items(names, "chart.variables", None, lambda entry, where: choice(entry, where, known))
    if list(variables) != [name for name in known if name in variables] or not variables:
        raise malformed("chart.variables: none, or not in their order")
    pairs = items(box, "chart.box", len(variables), read_pair)
    if any(low == high for low, high in pairs):
        raise malformed("chart.box: an interval is a point")
    place = items(position, "chart.position", 3, lambda entry, where: _fixed(entry, where, variables))
    fixed = None if quaternion is None else items(quaternion, "chart.quaternion", 4, rational)
    angles = items(turns, "chart.turns", 3 if fixed is None else 0, lambda entry, where: _turn(entry, where, variables))
    used = [value for value in place if isinstance(value, str)] + [turn[0] for turn in angles if len(turn) == 1]
    used = [*first, *used, *last]
    expected = [*first, *(name for name, value in zip(NAMES, place, strict=False) if isinstance(value, str))]
    expected += [name for name, turn in zip(NAMES[3:], angles, strict=False) if len(turn) == 1]
    expected += last
    if used != expected or tuple(used) != variables:
        raise malformed("chart: the variables are not those of position and turns")
    if fixed is not None and not any(fixed):
        raise malformed("chart.quaternion: is 0")
    _require_motion(motion, place, fixed, angles)
    return variables, pairs, place, fixed, angles


def _fixed(value: object, where: str, variables: Sequence[str]) -> Fraction | str:
    return str(value) if value in variables else rational(value, where)


def _turn(value: object, where: str, variables: Sequence[str]) -> tuple[Fraction | str, ...]:
    if isinstance(value, list) and len(value) == 1:
        return (choice(value[0], where, tuple(variables) or ("",)),)
    pair = items(value, where, 2, rational)
    if not any(pair):
        raise malformed(f"{where}: is 0")
    return pair


def _require_motion(motion: str, place: Sequence[Any], quaternion: Any, turns: Sequence[Any]) -> None:
    """All poses are motions of the group."""
    unturned = [len(turn) == 2 and not turn[1] for turn in turns]
    if motion == "planar" and place[2] != 0:
        raise malformed("chart.position: leaves the plane")
    if motion == "spherical" and any(value != 0 for value in place):
        raise malformed("chart.position: moves")
    if motion == "translation" and not (all(unturned) if quaternion is None else not any(quaternion[1:])):
        raise malformed("chart: turns, but the robot does not")
    if motion in ("planar", "schoenflies") and not (
        all(unturned[:2]) if quaternion is None else not any(quaternion[1:3])
    ):
        raise malformed("chart: turns about an axis that the robot does not turn about")

"""Checks region certificates with Python's integers and nothing else.

The part of the plain checker that ``pure.py``, beside this file, uses when it meets such a certificate. Written from
the definition of the format and its proofs, ``docs/certificates-regions.md``; it shares no line with the other checker.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial
from itertools import combinations, pairwise
from itertools import product as combinations_of
from math import comb, isqrt, lcm, prod
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TypeAlias

if TYPE_CHECKING or __package__:
    from pkm_exact.certify import pure
else:
    import pure

__all__ = ["replayed"]

Polynomial: TypeAlias = dict[tuple[int, ...], Fraction]
Numbers: TypeAlias = tuple[Fraction, ...]

KEYS: Final = (
    "format version robot chart shape conditions modes claim axes paving inside undecided measure counterexample"
)
KEYS_2: Final = (
    "format version robot chart shape tube joints directions conditions modes claim axes paving inside undecided "
    "measure member counterexample"
)
SCALED: Final = ("base.scale", "platform.scale", "rods.length")
CHART: Final = "variables box position quaternion turns"
ROBOT: Final = "name unit source motion metric legs forms base_cones platform_cones position"
VARIABLES: Final = ("x", "y", "z", "roll", "pitch", "yaw")
ASKED: Final = ("reachable", "limits", "no_type_1", "no_type_2")
FREEDOMS: Final = {
    "spatial": (0, 1, 2, 3, 4, 5),
    "planar": (0, 1, 5),
    "schoenflies": (0, 1, 2, 5),
    "translation": (0, 1, 2),
    "spherical": (3, 4, 5),
}
COSINES: Final = {30: "3/4", 45: "1/2", 60: "1/4", 90: "0", 120: "1/4", 135: "1/2", 150: "3/4", 180: "1"}
MAX_LEGS: Final = 12
MAX_PARTS: Final = 64
MAX_STEPS: Final = 120
MAX_CORNERS: Final = 64
MAX_POWERS: Final = 5
MAX_PARAMETERS: Final = 4
MAX_COEFFICIENTS: Final = 1 << 20
ROOT_BITS: Final = 80
DIGITS: Final = 48
PRECISIONS: Final = (64, 256, 1024)
ZERO: Final = Fraction(0)


class Leg(NamedTuple):
    """Joints, axes (none: own length; one: slide; two: crank), weight, rod squared, limits."""

    base: Numbers
    platform: Numbers
    axes: tuple[Numbers, ...]
    weight: int
    rod: Fraction
    reach: Numbers | None
    axis: Numbers | None = None


class Robot(NamedTuple):
    """As the certificate has it."""

    motion: str
    g: tuple[int, ...]
    legs: tuple[Leg, ...]
    forms: tuple[Numbers, ...]
    cones: tuple[tuple[tuple[Numbers, int], ...], ...]
    position: tuple[Numbers, ...]
    least: Fraction | None = None


class Chart(NamedTuple):
    """Variables, their intervals, and what else is fixed."""

    names: tuple[str, ...]
    box: tuple[Numbers, ...]
    position: tuple[Any, ...]
    quaternion: Numbers | None
    turns: tuple[tuple[Any, ...], ...]
    path: tuple[Numbers, ...] = ()
    parameters: tuple[str, ...] = ()


class Region(NamedTuple):
    """What a certificate says."""

    robot: Robot
    chart: Chart
    shape: tuple[tuple[Fraction, Numbers, Numbers], ...]
    asked: tuple[str, ...]
    modes: tuple[int, ...]
    claim: str
    axes: tuple[int, ...]
    paving: str
    inside: int
    undecided: int
    measure: Numbers | None
    points: tuple[Numbers, ...]
    corners: tuple[Numbers, ...] = ()
    radius: Fraction = Fraction(0)
    joints: tuple[Numbers, ...] = ()
    directions: tuple[Numbers | None, ...] = ()
    member: Numbers | None = None
    by_matrix: bool = False

    @property
    def named(self) -> tuple[str, ...]:
        """What is asked, in the words of the certificate."""
        return (*self.asked[:-1], "regular") if self.by_matrix else self.asked


# ---------------------------------------------------------------------------------------------------------------------
# Reading
# ---------------------------------------------------------------------------------------------------------------------


def read(body: dict[str, Any]) -> Region:
    """The content of a certificate."""
    version = body.get("version")
    known = type(version) is int and version in (1, 2)
    pure.well_formed(known, "format: not a pkm_exact region certificate, version 1 or 2")
    second, keys = version == 2, KEYS_2 if version == 2 else KEYS
    found = dict(zip(keys.split(), pure.an_object(body, "certificate", keys), strict=True))
    by_matrix = second and isinstance(found["conditions"], list) and found["conditions"][-1:] == ["regular"]
    if by_matrix:
        found["conditions"] = [*found["conditions"][:-1], "no_type_2"]
    region = first_part(found, second=second)._replace(by_matrix=by_matrix)
    alone = not by_matrix or not (region.chart.path or region.chart.parameters)
    pure.well_formed(alone, "conditions: regular has neither a path nor parameters beside it")
    return second_part(region, found) if second else region


def first_part(found: Mapping[str, Any], *, second: bool) -> Region:
    """What both versions have."""
    robot = a_robot(found["robot"], second=second)
    chart = a_chart(found["chart"], second=second)
    shape, asked, modes, claim, axes, paving, inside, undecided, measure, points = (
        found[key] for key in KEYS.split()[4:]
    )
    require_motion(robot.motion, chart)
    conditions = pure.a_list(pure.one_of(ASKED))(asked, "conditions")
    in_order = conditions and list(conditions) == [name for name in ASKED if name in conditions]
    pure.well_formed(in_order, "conditions: none, or not in their order")
    signs = pure.a_list(pure.an_integer, len(robot.legs))(modes, "modes")
    pure.well_formed(all(sign in (-1, 0, 1) for sign in signs), "modes: one is not -1, 0 or 1")
    steps = pure.a_list(pure.an_integer)(axes, "axes")
    pure.affordable(len(steps) <= MAX_STEPS, f"axes: more than {MAX_STEPS}")
    known = all(0 <= axis < len(chart.names) - len(chart.parameters) for axis in steps)
    pure.well_formed(known, "axes: one is not that of a variable")
    letters = "siouynx+-" if chart.parameters else "siou"
    is_word = isinstance(paving, str) and not set(paving) - set(letters)
    pure.well_formed(is_word, f"paving: not a word of the letters {', '.join(letters)}")
    claims = ("designs",) if chart.parameters else ("all", "not-all", "undecided", "map")
    parts = pure.a_list(a_shape)(shape, "shape")
    pure.affordable(len(parts) <= MAX_PARTS, f"shape: more than {MAX_PARTS}")
    return Region(
        robot,
        chart,
        parts,
        conditions,
        signs,
        pure.one_of(claims)(claim, "claim"),
        steps,
        paving,
        pure.a_number(inside, "inside"),
        pure.a_number(undecided, "undecided"),
        None if measure is None else a_pair(measure, "measure"),
        pure.a_list(pure.a_list(pure.a_rational, len(chart.names)))(points, "counterexample"),
    )


def a_vector(value: Any, where: str) -> Numbers:
    """Three rationals."""
    return tuple(pure.a_list(pure.a_rational, 3)(value, where))


def a_pair(value: Any, where: str) -> Numbers:
    """Two rationals in order."""
    pair: Numbers = pure.a_list(pure.a_rational, 2)(value, where)
    pure.well_formed(pair[0] <= pair[1], f"{where}: ends out of order")
    return pair


def a_shape(value: Any, where: str) -> tuple[Fraction, Numbers, Numbers]:
    """A part of the shape of the region."""
    constant, linear, weights = pure.an_object(value, where, "constant linear weights")
    found = a_vector(weights, f"{where}.weights")
    pure.well_formed(min(found) >= 0, "shape: a weight is negative")
    return pure.a_rational(constant, f"{where}.constant"), a_vector(linear, f"{where}.linear"), found


def a_robot(value: Any, *, second: bool) -> Robot:
    """The robot."""
    entries = pure.an_object(value, "robot", f"{ROBOT} leg_distance" if second else ROBOT)
    name, unit, source, motion, metric, legs, forms, base_cones, platform_cones, position, *least = entries
    for text, key in ((name, "name"), (unit, "unit"), (source, "source")):
        pure.a_text(text, f"robot.{key}")
    numbers = pure.a_list(pure.a_positive_rational, 3)(metric, "robot.metric")
    pure.well_formed(all(x.denominator == 1 for x in numbers), "robot.metric: not whole numbers")
    g = tuple(map(int, numbers))
    found = pure.a_list(partial(a_sliding_leg if second else a_leg, g))(legs, "robot.legs")
    pure.affordable(len(found) <= MAX_LEGS, f"robot.legs: more than {MAX_LEGS}")
    pure.well_formed(found, "robot.legs: none")
    linear = pure.a_list(pure.a_list(pure.a_rational, 17))(forms, "robot.forms")
    pure.affordable(len(linear) <= MAX_PARTS, f"robot.forms: more than {MAX_PARTS}")
    sides = [
        pure.a_list(a_cone)(cones, side)
        for cones, side in ((base_cones, "base_cones"), (platform_cones, "platform_cones"))
    ]
    pure.well_formed(all(len(side) in (0, len(found)) for side in sides), "robot: cones are not as many as legs")
    pairs = pure.a_list(a_pair)(position, "robot.position")
    pure.well_formed(len(pairs) <= 3, "robot.position: more than 3")
    apart = None if least in ([], [None]) else pure.a_positive_rational(least[0], "robot.leg_distance")
    return Robot(pure.one_of(tuple(FREEDOMS))(motion, "robot.motion"), g, found, linear, tuple(sides), pairs, apart)


def a_leg(g: Sequence[int], value: Any, where: str) -> Leg:
    """A leg."""
    name, base, platform, actuator, reach = pure.an_object(value, where, "name base platform actuator reach")
    pure.a_text(name, f"{where}.name")
    joints = a_vector(base, f"{where}.base"), a_vector(platform, f"{where}.platform")
    limits = None if reach is None else a_pair(reach, f"{where}.reach")
    kind = actuator.get("type") if isinstance(actuator, dict) else None
    inside = f"{where}.actuator"
    if kind not in ("slide", "crank"):
        pure.an_object(actuator, inside, "type")
        pure.one_of(("length",))(kind, f"{inside}.type")
        pure.well_formed(limits is None or limits[0] >= 0, f"{where}.reach: a length is negative")
        return Leg(*joints, (), 1, ZERO, limits)
    if kind == "slide":
        _, direction, rod = pure.an_object(actuator, inside, "type direction rod_squared")
        axes: tuple[Numbers, ...] = (a_vector(direction, f"{inside}.direction"),)
        weight = Fraction(1)
    else:
        _, first, second, share, rod = pure.an_object(actuator, inside, "type at_0 at_90 weight rod_squared")
        axes = a_vector(first, f"{inside}.at_0"), a_vector(second, f"{inside}.at_90")
        weight = pure.a_positive_rational(share, f"{inside}.weight")
        exact = weight.denominator == 1 and (limits is None or (weight == 1 and not any(x % 90 for x in limits)))
        pure.well_formed(
            exact, f"{inside}: a weight that is no whole number, or limits that are no multiples of 90 degrees"
        )
    squares = [pure.scalar_product(g, axis, axis) for axis in axes]
    pure.well_formed(squares[0] != 0, "robot.legs: an axis is 0")
    if len(axes) == 2:
        circle = squares[1] == weight * squares[0] and pure.scalar_product(g, *axes) == 0
        pure.well_formed(circle, "robot.legs: a crank does not turn on a circle")
    return Leg(*joints, axes, int(weight), pure.a_positive_rational(rod, f"{inside}.rod_squared"), limits)


def a_sliding_leg(g: Sequence[int], value: Any, where: str) -> Leg:
    """A leg of version 2, which may be a rod that slides along an axis."""
    keys = ("name", "base", "platform", "actuator", "reach", "axis")
    entries = pure.an_object(value, where, " ".join(keys))
    leg = a_leg(g, dict(zip(keys[:-1], entries, strict=False)), where)
    if entries[-1] is None:
        return leg
    axis = a_vector(entries[-1], f"{where}.axis")
    pure.well_formed(any(axis) and leg.axes, "robot.legs: an axis is 0, or that of a leg of its own length")
    across = all(pure.scalar_product(g, axis, moved) == 0 for moved in leg.axes)
    pure.well_formed(across, "robot.legs: a slide or crank does not move across the axis of its rod")
    return leg._replace(axis=axis)


def a_cone(value: Any, where: str) -> tuple[Numbers, int]:
    """An axis and an angle."""
    axis, degrees = pure.an_object(value, where, "axis degrees")
    angle = pure.a_rational(degrees, f"{where}.degrees")
    pure.well_formed(angle in COSINES, f"{where}.degrees: its cosine has no rational square")
    vector = a_vector(axis, f"{where}.axis")
    pure.well_formed(any(vector), f"{where}.axis: is 0")
    return vector, int(angle)


def a_chart(value: Any, *, second: bool) -> Chart:
    """The chart."""
    keys = "variables box position path quaternion turns parameters" if second else CHART
    found = dict(zip(keys.split(), pure.an_object(value, "chart", keys), strict=True))
    names_, box, position, quaternion, turns = (found[key] for key in CHART.split())
    curve, varied = [found.get("path")], a_list_of_parameters(found.get("parameters", []))
    more = tuple(f"p{k}" for k in range(1, len(varied) + 1))
    path = () if curve == [None] else a_path(curve[0])
    first = ("along",) if path else ()
    every = (*first, *VARIABLES, *more)
    names = pure.a_list(pure.one_of(every))(names_, "chart.variables")
    in_order = names and list(names) == [name for name in every if name in names]
    pure.well_formed(in_order, "chart.variables: none, or not in their order")
    pairs = pure.a_list(a_pair, len(names))(box, "chart.box")
    pure.well_formed(all(pair[0] < pair[1] for pair in pairs), "chart.box: an interval is a point")

    def a_place(entry: Any, where: str) -> Any:
        return entry if isinstance(entry, str) and entry in names else pure.a_rational(entry, where)

    def a_turn(entry: Any, where: str) -> tuple[Any, ...]:
        if isinstance(entry, list) and len(entry) == 1:
            return (pure.one_of(names)(entry[0], where),)
        pair: tuple[Any, ...] = pure.a_list(pure.a_rational, 2)(entry, where)
        pure.well_formed(any(pair), f"{where}: is 0")
        return pair

    places = pure.a_list(a_place, 3)(position, "chart.position")
    fixed = None if quaternion is None else pure.a_list(pure.a_rational, 4)(quaternion, "chart.quaternion")
    angles = pure.a_list(a_turn, 0 if fixed is not None else 3)(turns, "chart.turns")
    used = list(first)
    for name, entry in zip(VARIABLES, (*places, *angles), strict=False):
        variable = (
            entry if isinstance(entry, str) else entry[0] if isinstance(entry, tuple) and len(entry) == 1 else None
        )
        if variable is not None:
            pure.well_formed(variable == name, "chart: the variables are not those of position and turns")
            used.append(variable)
    pure.well_formed((*used, *more) == names, "chart: the variables are not those of position and turns")
    pure.well_formed(fixed is None or any(fixed), "chart.quaternion: is 0")
    pure.well_formed(not path or not any(places), "chart.path: there is a position beside it")
    return Chart(names, pairs, places, fixed, angles, path, varied)


def a_list_of_parameters(value: Any) -> tuple[str, ...]:
    """The names of the numbers of the robot that vary."""
    keys: tuple[str, ...] = pure.a_list(pure.a_text)(value, "chart.parameters")
    alone = len(keys) <= MAX_PARAMETERS and len(keys) == len(set(keys))
    pure.well_formed(alone, f"chart.parameters: more than {MAX_PARAMETERS}, or one twice")
    known = all(key in SCALED or coordinate(key) is not None for key in keys)
    pure.well_formed(known, "chart.parameters: one is no number of the robot")
    return keys


def coordinate(key: str) -> tuple[str, int, int] | None:
    """Side, leg and axis, from 0, of a coordinate such as base.joints.2.1."""
    side, *parts = key.split(".")
    if side not in ("base", "platform") or len(parts) != 3 or parts[0] != "joints":
        return None
    if parts[1] not in map(str, range(1, 100)) or parts[2] not in ("1", "2", "3"):
        return None
    return side, int(parts[1]) - 1, int(parts[2]) - 1


def require_parameters(region: Region) -> None:
    """Refuse parameters of what the robot has not, or that move one joint twice."""
    robot, keys = region.robot, region.chart.parameters
    plain = not keys or not (robot.forms or region.joints or any(leg.axis is not None for leg in robot.legs))
    pure.well_formed(plain, "chart.parameters: there are forms, axes of rods or joint values")
    driven = "rods.length" not in keys or all(leg.axes for leg in robot.legs)
    for key, ends in zip(reversed(keys), reversed(region.chart.box), strict=False):
        place = coordinate(key)
        positive = place is not None or ends[0] > 0
        pure.well_formed(positive, "chart.parameters: a scale or length is not positive")
        there = place is None or (place[1] < len(robot.legs) and f"{place[0]}.scale" not in keys)
        pure.well_formed(there, "chart.parameters: there is no such leg, or its joint is scaled too")
    pure.well_formed(driven, "chart.parameters: a leg has no rod")


def a_path(value: Any) -> tuple[Numbers, ...]:
    """Four polynomials of one variable, the first of them positive everywhere."""
    path: tuple[Numbers, ...] = pure.a_list(pure.a_list(pure.a_rational), 4)(value, "chart.path")
    short = all(1 <= len(entry) <= MAX_POWERS for entry in path)
    pure.well_formed(short, f"chart.path: not 1 to {MAX_POWERS} coefficients")
    even = all(x >= 0 if power % 2 == 0 else x == 0 for power, x in enumerate(path[0]))
    pure.well_formed(even and path[0][0] > 0, "chart.path: its denominator is not seen to be positive")
    return path


def second_part(region: Region, found: Mapping[str, Any]) -> Region:
    """What version 2 says beside."""
    corners: tuple[Numbers, ...] = ()
    radius = ZERO
    if found["tube"] is not None:
        corners_, radius_ = pure.an_object(found["tube"], "tube", "corners radius")
        corners = pure.a_list(a_vector)(corners_, "tube.corners")
        pure.affordable(len(corners) <= MAX_CORNERS, f"tube.corners: more than {MAX_CORNERS}")
        moves = len(corners) > 1 and all(a != b for a, b in pairwise(corners))
        pure.well_formed(moves, "tube.corners: fewer than two, or neighbours are the same")
        radius = pure.a_positive_rational(radius_, "tube.radius")
    member = pure.a_list(pure.a_rational)(found["member"], "member")
    expected = len(region.chart.names) if region.claim in ("all", "designs") else 0
    pure.well_formed(
        len(member) == expected,
        "member: not a value for each variable where the claim is all or designs, or some elsewhere",
    )
    region = region._replace(
        corners=corners,
        radius=radius,
        joints=pure.a_list(a_pair)(found["joints"], "joints"),
        directions=pure.a_list(a_direction)(found["directions"], "directions"),
        member=member,
    )
    require_parameters(region)
    require_positions(region)
    require_joints(region)
    require_directions(region)
    return region


def a_direction(value: Any, where: str) -> Numbers | None:
    """A covector and a bound of its length, or nothing."""
    if value is None:
        return None
    numbers: Numbers = pure.a_list(pure.a_rational, 4)(value, where)
    pure.well_formed(numbers[3] > 0, f"{where}: the last number is not positive")
    return numbers


def require_positions(region: Region) -> None:
    """Refuse more than one of shape, path and tube, and what the robot's motions or fixed coordinates forbid."""
    path, motion, chart = region.chart.path, region.robot.motion, region.chart
    alone = sum(map(bool, (path, region.corners, region.shape))) < 2
    pure.well_formed(alone, "shape: there is one beside a path or a tube, or both of these")
    moving = not path or motion != "spherical"
    pure.well_formed(moving, "chart.path: there is a position beside it, or the robot does not move")
    flat = not path or motion != "planar" or not any(path[3])
    pure.well_formed(flat, "chart.path: leaves the plane")
    for k, value in enumerate(chart.position):
        there = isinstance(value, str) or all(corner[k] == value for corner in region.corners)
        pure.well_formed(there, "tube.corners: one is not where a coordinate is fixed")


def require_joints(region: Region) -> None:
    """Refuse joint values that do not belong to the legs."""
    pure.well_formed(len(region.joints) in (0, len(region.robot.legs)), "joints: not as many as legs")
    for leg, (low, high), mode in zip(region.robot.legs, region.joints, region.modes, strict=False):
        pure.well_formed(leg.axes or low >= 0, "joints: a length is negative")
        pure.well_formed(mode or not leg.axes, "modes: a working mode is needed and not named")
        right = leg.weight == 1 and low % 90 == 0 and high % 90 == 0
        pure.well_formed(len(leg.axes) < 2 or right, "joints: limits of a crank that are no multiples of 90 degrees")


def pairs_apart(region: Region) -> list[tuple[int, int]]:
    """The numbers of the legs that must be apart."""
    if region.robot.least is None or "limits" not in region.asked:
        return []
    found, legs = [], region.robot.legs
    for i, j in combinations(range(len(legs)), 2):
        fixed = not legs[i].axes and not legs[j].axes
        (base, platform), (base_2, platform_2) = joints_of(region, i), joints_of(region, j)
        if platform != platform_2 and not (fixed and base == base_2):
            found.append((i, j))
    return found


def joints_of(region: Region, number: int) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Base and platform joint of a leg, the names of variables for coordinates that vary."""
    leg = region.robot.legs[number]
    joints: dict[str, list[Any]] = {"base": list(leg.base), "platform": list(leg.platform)}
    for k, key in enumerate(region.chart.parameters, 1):
        place = coordinate(key)
        if place is not None and place[1] == number:
            joints[place[0]][place[2]] = f"p{k}"
    return tuple(joints["base"]), tuple(joints["platform"])


def require_directions(region: Region) -> None:
    """Refuse directions that are not those of pairs of legs, or bounds of their lengths that are none."""
    pairs = pairs_apart(region)
    alone = not any(region.robot.cones) and not pairs
    for leg in region.robot.legs:
        free = leg.axis is None or alone
        pure.well_formed(free, "robot.legs: a rod along an axis has neither cones nor a distance from others")
    as_many = len(region.directions) == len(pairs)
    pure.well_formed(as_many, "directions: not one for every two legs that must be apart")
    named = not pairs or all(mode or not leg.axes for leg, mode in zip(region.robot.legs, region.modes, strict=True))
    pure.well_formed(named, "modes: a working mode is needed and not named")
    for way in region.directions:
        if way is not None:
            square = sum((c**2 / weight for c, weight in zip(way[:3], region.robot.g, strict=True)), ZERO)
            pure.well_formed(way[3] ** 2 >= square, "directions: the last number is less than the length of the others")


def require_motion(motion: str, chart: Chart) -> None:
    """Refuse a chart with poses that the robot's motions do not have."""

    def turns_about(axes: Sequence[int]) -> bool:
        if chart.quaternion is not None:
            return any(chart.quaternion[1 + axis] for axis in axes)
        return any(len(chart.turns[axis]) == 1 or chart.turns[axis][1] for axis in axes)

    flat = motion != "planar" or chart.position[2] == 0
    pure.well_formed(flat, "chart.position: leaves the plane")
    still = motion != "spherical" or all(value == 0 for value in chart.position)
    pure.well_formed(still, "chart.position: moves")
    straight = motion != "translation" or not turns_about((0, 1, 2))
    pure.well_formed(straight, "chart: turns, but the robot does not")
    upright = motion not in ("planar", "schoenflies") or not turns_about((0, 1))
    pure.well_formed(upright, "chart: turns about an axis that the robot does not turn about")


# ---------------------------------------------------------------------------------------------------------------------
# Polynomials: exponents of the variables, then of the roots y
# ---------------------------------------------------------------------------------------------------------------------


def plus(*terms: tuple[Any, Polynomial]) -> Polynomial:
    """A sum of multiples."""
    total: Polynomial = {}
    for factor, polynomial in terms:
        if factor:
            for key, value in polynomial.items():
                total[key] = total.get(key, ZERO) + factor * value
    return {key: value for key, value in total.items() if value}


def words_of(numbers: Iterable[Fraction]) -> int:
    """The words of 64 bits of the longest numerator or denominator."""
    sizes = (max(x.numerator.bit_length(), x.denominator.bit_length()) for x in numbers)
    return max(sizes, default=0) // 64 + 1


def size_factor(left: int, right: int) -> int:
    """By how much more numbers of so many words cost than short ones."""
    return max(1, left * right // 16)


def times(a: Polynomial, b: Polynomial) -> Polynomial:
    """A product."""
    pure.spend((3000 * len(a) * len(b) + 1000) * size_factor(words_of(a.values()), words_of(b.values())))
    total: Polynomial = {}
    for one, x in a.items():
        for other, y in b.items():
            key = tuple(map(int.__add__, one, other))
            total[key] = total.get(key, ZERO) + x * y
    return {key: value for key, value in total.items() if value}


class Signed(NamedTuple):
    """A polynomial and its sign: positive "+", not negative "0+", not zero "/"."""

    polynomial: Polynomial
    sign: str


class Later:
    """A condition that is made when it is asked for."""

    def __init__(self, make: Callable[[], Any]) -> None:
        self.make = make

    def __getitem__(self, place: int) -> Any:
        """ "and" or "or", and the parts."""
        return self.made[place]

    @cached_property
    def made(self) -> Any:
        """The condition."""
        return self.make()


class Conditions(NamedTuple):
    """What is asked; that a pose is one of the region; the tests of the shape; the D of legs; the determinant."""

    asked: Any
    region: Any
    shape: list[Signed]
    roots: list[Polynomial]
    determinant: Polynomial | Matrix | None


def pairwise_of(corners: Sequence[Numbers], number: int) -> Iterator[tuple[Fraction, Fraction]]:
    """The coordinates of a corner and of the next one."""
    return zip(corners[number], corners[number + 1], strict=True)


class Equations:
    """The conditions of a certificate as polynomials."""

    def __init__(self, region: Region) -> None:
        self.region, self.g = region, region.robot.g
        self.driven = [k for k, leg in enumerate(region.robot.legs) if leg.axes]
        self.count = len(region.chart.names)
        self.size = self.count + len(self.driven)
        self.norm, self.rotation = self.turned()
        self.center = [times(self.norm, self.entry(value)) for value in region.chart.position]
        if region.chart.path:
            self.follow(region.chart.path)
        self.square_norm = times(self.norm, self.norm)

    def number(self, value: Fraction | int) -> Polynomial:
        """A constant."""
        return {(0,) * self.size: Fraction(value)} if value else {}

    def generator(self, place: int) -> Polynomial:
        """A variable."""
        return {tuple(int(k == place) for k in range(self.size)): Fraction(1)}

    def entry(self, value: Any) -> Polynomial:
        """A number, or the variable of a name."""
        return self.generator(self.region.chart.names.index(value)) if isinstance(value, str) else self.number(value)

    def inner(self, a: Sequence[Polynomial], b: Sequence[Polynomial]) -> Polynomial:
        """The product in the metric."""
        return plus(*((weight, times(x, y)) for weight, x, y in zip(self.g, a, b, strict=True)))

    def numbers(self, values: Sequence[Fraction]) -> list[Polynomial]:
        """Constants."""
        return [self.number(value) for value in values]

    def turned(self) -> tuple[Polynomial, list[list[Polynomial]]]:
        """N and N R."""
        chart, g = self.region.chart, self.g
        if chart.quaternion is not None:
            e = chart.quaternion
            placed = pure.motion(e, (0, 0, 0, 0), g)  # type: ignore[arg-type]
            rows = [[self.number(Fraction(x) / placed.norm) for x in row] for row in placed.rotation]
            return self.number(1), rows
        norm = self.number(1)
        matrix = [[self.number(int(i == j)) for j in range(3)] for i in range(3)]
        for axis, turn in enumerate(chart.turns):
            c, s = (
                (self.number(1), self.entry(turn[0])) if len(turn) == 1 else (self.entry(turn[0]), self.entry(turn[1]))
            )
            i, j = (axis + 1) % 3, (axis + 2) % 3
            cc, ss, cs = times(c, c), times(s, s), times(c, s)
            weight = g[i] * g[j]
            factor = [[self.number(0) for _ in range(3)] for _ in range(3)]
            factor[axis][axis] = plus((1, cc), (weight, ss))
            factor[i][i] = factor[j][j] = plus((1, cc), (-weight, ss))
            factor[i][j], factor[j][i] = plus((-2 * g[j], cs)), plus((2 * g[i], cs))
            norm = times(norm, factor[axis][axis])
            matrix = [
                [plus(*((1, times(factor[a][k], matrix[k][b])) for k in range(3))) for b in range(3)] for a in range(3)
            ]
        return norm, matrix

    def follow(self, path: Sequence[Numbers]) -> None:
        """Positions on the curve: everything has its denominator as a factor."""
        rest = (0,) * (self.size - 1)
        curve = [{(power, *rest): x for power, x in enumerate(entry)} for entry in path]
        self.center = [times(self.norm, place) for place in curve[1:]]
        self.norm = times(self.norm, curve[0])
        self.rotation = [[times(entry, curve[0]) for entry in row] for row in self.rotation]

    def moved(self, vector: Sequence[Fraction]) -> list[Polynomial]:
        """N R v."""
        return [plus(*zip(vector, row, strict=True)) for row in self.rotation]

    def joints(self, number: int) -> tuple[list[Polynomial], list[Polynomial]]:
        """N A and N R B of a leg."""
        base, platform = (list(map(self.entry, joint)) for joint in joints_of(self.region, number))
        keys = self.region.chart.parameters
        for side, entries in (("base.scale", base), ("platform.scale", platform)):
            if side in keys:
                entries[:] = [times(self.entry(f"p{keys.index(side) + 1}"), x) for x in entries]
        arm = [plus(*((1, times(x, b)) for x, b in zip(row, platform, strict=True))) for row in self.rotation]
        return [times(self.norm, a) for a in base], arm

    def rod(self, leg: Leg) -> Polynomial:
        """N^2 times its square."""
        keys = self.region.chart.parameters
        if "rods.length" not in keys:
            return plus((leg.rod, self.square_norm))
        length = times(self.entry(f"p{keys.index('rods.length') + 1}"), self.norm)
        return times(length, length)

    def all(self) -> Conditions:
        """All of them, and the polynomials that checks need besides."""
        region = self.region
        for form in region.robot.forms:
            pure.require(
                not self.value_of(form), "chart: its poses are not all among those that the joints of the robot allow"
            )
        legs = [Placed(self, k) for k in range(len(region.robot.legs))]
        parts: list[Any] = [Signed(leg.root, "0+") for leg in legs if leg.root is not None]
        if "limits" in region.asked:
            for leg in legs:
                parts += leg.limits()
            for side, cones in enumerate(region.robot.cones):
                parts += [
                    leg.cone(axis, angle, platform=bool(side)) for leg, (axis, angle) in zip(legs, cones, strict=False)
                ]
            for c, (low, high) in zip(self.center, region.robot.position, strict=False):
                parts += [Signed(plus((1, c), (-low, self.norm)), "0+"), Signed(plus((high, self.norm), (-1, c)), "0+")]
            for (i, j), way in zip(pairs_apart(region), region.directions, strict=True):
                parts.append(Pair(self, legs[i], legs[j]).condition(way))
        if "no_type_1" in region.asked:
            parts += [Signed(leg.square if leg.root is None else leg.root, "+") for leg in legs]
        determinant = self.singular(legs)
        if determinant is not None:
            parts.append(determinant if isinstance(determinant, Matrix) else Signed(determinant, "/"))
        shape = [Signed(self.shape(*part), "0+") for part in region.shape]
        inside: list[Any] = [*shape, *self.tube()]
        for leg, pair in zip(legs, region.joints, strict=False):
            inside += leg.within(pair)
        roots = [leg.root for leg in legs if leg.root is not None]
        return Conditions(("and", parts), ("and", inside), shape, roots, determinant)

    def tube(self) -> list[Any]:
        """That a position is near the path: one condition, if there is a path."""
        region = self.region
        parts: list[Any] = []
        offsets = [
            [plus((1, c), (-x, self.norm)) for c, x in zip(self.center, corner, strict=True)]
            for corner in region.corners
        ]
        for number, o in enumerate(offsets):
            ball = plus((region.radius**2, self.square_norm), (-1, self.inner(o, o)))
            parts.append(Signed(ball, "0+"))
            if number + 1 < len(offsets):
                way = [b - a for a, b in pairwise_of(region.corners, number)]
                square = pure.scalar_product(self.g, way, way)
                along = plus(*((weight * x, p) for weight, x, p in zip(self.g, way, o, strict=True)))
                rest = plus((square, ball), (1, times(along, along)))
                sides = Signed(along, "0+"), Signed(plus((square, self.norm), (-1, along)), "0+"), Signed(rest, "0+")
                parts.append(("and", sides))
        return [("or", parts)] if parts else []

    def shape(self, constant: Fraction, linear: Numbers, weights: Numbers) -> Polynomial:
        """N^2 times a part of the shape."""
        terms = [(constant, self.square_norm)]
        for c, slope, weight in zip(self.center, linear, weights, strict=True):
            terms += [(slope, times(self.norm, c)), (-weight, times(c, c))]
        return plus(*terms)

    def value_of(self, form: Numbers) -> Polynomial:
        """N^2 times the value of a form."""
        g, c, r = self.g, self.center, self.rotation
        terms: list[tuple[Any, Polynomial]] = [(form[0], self.inner(c, c)), (form[16], self.square_norm)]
        for i in range(3):
            terms += [(form[1 + i] * Fraction(g[k], g[i]), times(r[k][i], c[k])) for k in range(3)]
            terms.append((form[4 + i], times(self.norm, c[i])))
            terms += [(form[7 + 3 * i + j], times(self.norm, r[i][j])) for j in range(3)]
        return plus(*terms)

    def wrench(self, form: Numbers) -> list[Polynomial]:
        """N^2 times the wrench of a form: derivatives along C_i, and along the turns of the table of rows."""
        g, c, r, n = self.g, self.center, self.rotation, self.norm
        a = [plus(*((Fraction(g[i], g[j]) * form[1 + j], r[i][j]) for j in range(3))) for i in range(3)]
        force = [times(n, plus((2 * g[i] * form[0], c[i]), (1, a[i]), (form[4 + i], n))) for i in range(3)]
        moment = []
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            terms: list[tuple[Any, Polynomial]] = [(g[k], times(a[j], c[k])), (-g[j], times(a[k], c[j]))]
            for b in range(3):
                terms += [
                    (g[j] * form[7 + 3 * k + b], times(n, r[j][b])),
                    (-g[k] * form[7 + 3 * j + b], times(n, r[k][b])),
                ]
            moment.append(plus(*terms))
        return [*force, *moment]

    def singular(self, legs: Sequence[Placed]) -> Polynomial | Matrix | None:
        """The determinant, or the matrix, if it is asked for."""
        if self.region.by_matrix:
            return self.matrix(legs)
        return self.determinant(legs) if "no_type_2" in self.region.asked else None

    def determinant(self, legs: Sequence[Placed]) -> Polynomial:
        """Of the rows of legs and of the other constraints, on the freedoms."""
        return self.expanded(self.square([leg.row() for leg in legs]))

    def matrix(self, legs: Sequence[Placed]) -> Matrix:
        """The same rows, but those of legs of own length over N, and none multiplied with another."""
        rows = self.square([leg.row() if leg.leg.axes else leg.own_row() for leg in legs])
        roots = [self.driven.index(k) if leg.leg.axes else None for k, leg in enumerate(legs)]
        return matrix_of(rows, [*roots, *[None] * (len(rows) - len(roots))], self.count)

    def square(self, rows: list[list[Polynomial]]) -> list[list[Polynomial]]:
        """The rows of legs, and those of other constraints, on the freedoms: as many of these as of those."""
        freedoms = FREEDOMS[self.region.robot.motion]
        rows = rows + [self.wrench(form) for form in self.region.robot.forms]
        square = len(rows) == len(freedoms)
        pure.well_formed(square, "conditions: as many equations as freedoms are needed for no_type_2")
        return [[row[k] for k in freedoms] for row in rows]

    def expanded(self, rows: list[list[Polynomial]]) -> Polynomial:
        """A determinant: the minors of the last rows, from those of one row less."""
        minors: dict[tuple[int, ...], Polynomial] = {(): self.number(1)}
        for row in reversed(rows):
            wider: dict[tuple[int, ...], list[tuple[int, Polynomial]]] = {}
            for columns, minor in minors.items():
                for column, entry in enumerate(row):
                    if column not in columns and entry:
                        chosen = tuple(sorted((*columns, column)))
                        sign = -1 if chosen.index(column) % 2 else 1
                        wider.setdefault(chosen, []).append((sign, times(entry, minor)))
            minors = {chosen: plus(*terms) for chosen, terms in wider.items()}
        return minors.get(tuple(range(len(rows))), {})


class Placed:
    """A leg at the poses of the chart."""

    def __init__(self, equations: Equations, k: int) -> None:
        self.equations, self.leg, self.mode = equations, equations.region.robot.legs[k], equations.region.modes[k]
        leg = self.leg
        base, self.arm = equations.joints(k)
        e = [plus((1, c), (1, b), (-1, a)) for c, b, a in zip(equations.center, self.arm, base, strict=True)]
        if leg.axis is not None:
            size = pure.scalar_product(equations.g, leg.axis, leg.axis)
            along = equations.inner(equations.numbers(leg.axis), e)
            e = [plus((1, x), (-axis / size, along)) for x, axis in zip(e, leg.axis, strict=True)]
        self.square = equations.inner(e, e)
        self.rod = e
        self.root: Polynomial | None = None
        self.value = self.square, equations.square_norm
        self.length = equations.rod(leg) if leg.axes else self.square
        self.crank: Polynomial | None = None
        self.place = -1
        if leg.axes:
            self.require_mode()
            self.place = equations.count + equations.driven.index(k)
            self.drive(e)

    def require_mode(self) -> None:
        """Refuse a leg whose working mode matters and is not named."""
        asked, robot = self.equations.region.asked, self.equations.region.robot
        limited = "limits" in asked and (self.leg.reach is not None or any(robot.cones))
        needed = "no_type_2" in asked or limited
        pure.well_formed(self.mode or not needed, "modes: a working mode is needed and not named")

    def drive(self, e: list[Polynomial]) -> None:
        """The rod of a slide or a crank, its value and its root."""
        eq, leg = self.equations, self.leg
        y, axes = eq.generator(self.place), [eq.numbers(axis) for axis in leg.axes]
        if len(axes) == 1:
            length = pure.scalar_product(eq.g, leg.axes[0], leg.axes[0])
            along_it = eq.inner(axes[0], e)
            way = plus((1, along_it), (self.mode, y))
            terms = (1, times(along_it, along_it)), (-length, self.square), (length, self.length)
            self.root = plus(*terms)
            self.rod = [plus((length, x), (-d, way)) for x, d in zip(e, leg.axes[0], strict=True)]
            self.value = way, plus((length, eq.norm))
            return
        a, p = (plus((2, times(eq.norm, eq.inner(axis, e)))) for axis in axes)
        size = pure.scalar_product(eq.g, leg.axes[0], leg.axes[0])
        h = plus((1, self.square), (size, eq.square_norm), (-1, self.length))
        w = Fraction(1, leg.weight)
        m = self.crank = plus((1, times(a, a)), (w, times(p, p)))
        self.root = plus((w, m), (-w, times(h, h)))
        cosine = plus((1, times(a, h)), (-self.mode, times(p, y)))
        sine = plus((w, times(p, h)), (self.mode, times(a, y)))
        self.value = cosine, sine
        turned = [plus((u, cosine), (v, sine)) for u, v in zip(*leg.axes, strict=True)]
        self.rod = [plus((1, times(m, x)), (-1, times(eq.norm, t))) for x, t in zip(e, turned, strict=True)]

    def limits(self) -> list[Any]:
        """Those of its length, slide or crank."""
        return [] if self.leg.reach is None else self.range(self.leg.reach)

    def within(self, ends: Numbers) -> list[Any]:
        """That it reaches, and that its length, position or angle is between two ends."""
        reached = [] if self.root is None else [Signed(self.root, "0+")]
        return [*reached, *self.range(ends)]

    def range(self, ends: Numbers) -> list[Any]:
        """That its length, position or angle is between two ends."""
        low, high = ends
        first, second = self.value
        if len(self.leg.axes) == 2:
            return [self.between(low, high)]
        if not self.leg.axes:
            low, high = low * low, high * high
        return [Signed(plus((1, first), (-low, second)), "0+"), Signed(plus((high, second), (-1, first)), "0+")]

    def between(self, low: Fraction, high: Fraction) -> Any:
        """Whether the crank's angle is in a range of right angles."""
        cosine, sine = self.value
        (c1, s1), (c2, s2) = ([(1, 0), (0, 1), (-1, 0), (0, -1)][int(angle / 90) % 4] for angle in (low, high))
        parts = [Signed(plus((c1, sine), (-s1, cosine)), "0+"), Signed(plus((s2, cosine), (-c2, sine)), "0+")]
        if low == high:
            parts.append(Signed(plus((c1, cosine), (s1, sine)), "0+"))
        if high - low >= 360:
            return ("and", [])
        return ("or", parts) if high - low > 180 else ("and", parts)

    def cone(self, axis: Numbers, angle: int, *, platform: bool) -> Any:
        """Whether the rod is in a cone about an axis of the base, or the opposite of it in one of the platform."""
        eq = self.equations
        direction = eq.moved(axis) if platform else eq.numbers(axis)
        along = plus((-1 if platform else 1, eq.inner(direction, self.rod)))
        squares = self.without_squares(times(along, along))
        squared = self.without_squares(eq.inner(self.rod, self.rod))
        pure.require(squared, "cones: a leg has no direction all over the chart")
        sizes = times(eq.inner(direction, direction), squared)
        rest = plus((1, squares), (-Fraction(COSINES[angle]), sizes))
        if angle > 90:
            return ("or", [Signed(along, "0+"), Signed(plus((-1, rest)), "0+")])
        return ("and", [Signed(along, "0+"), Signed(rest, "0+")])

    def without_squares(self, polynomial: Polynomial) -> Polynomial:
        """With y^2 = D."""
        if self.root is None:
            return polynomial
        total: list[tuple[int, Polynomial]] = []
        for key, value in polynomial.items():
            power = key[self.place]
            term: Polynomial = {tuple(power % 2 if k == self.place else x for k, x in enumerate(key)): value}
            for _ in range(power // 2):
                term = times(term, self.root)
            total.append((1, term))
        return plus(*total)

    def row(self) -> list[Polynomial]:
        """Its row of the matrix of wrenches."""
        g, b, k = self.equations.g, self.arm, self.rod
        force = [plus((g[i], times(self.equations.norm, k[i]))) for i in range(3)]
        moment = []
        for i in range(3):
            j, l = (i + 1) % 3, (i + 2) % 3  # noqa: E741 - cyclic indices
            weight = g[j] * g[l]
            moment.append(plus((weight, times(b[j], k[l])), (-weight, times(b[l], k[j]))))
        return [*force, *moment]

    def own_row(self) -> list[Polynomial]:
        """Its row over N, of its own length: e, and b x (C - A)."""
        eq, b = self.equations, self.arm
        g = eq.g
        o = [
            plus((1, eq.entry(c)), (-1, eq.number(a)))
            for c, a in zip(eq.region.chart.position, self.leg.base, strict=True)
        ]
        force = [plus((weight, x)) for weight, x in zip(g, self.rod, strict=True)]
        turned = [plus((1, times(b[i - 2], o[i - 1])), (-1, times(b[i - 1], o[i - 2]))) for i in range(3)]
        return [*force, *(plus((g[i - 2] * g[i - 1], x)) for i, x in enumerate(turned))]


class Pair:
    """Two legs that must be apart, in the letters of the specification: m, n, U, V, W, A, B."""

    def __init__(self, equations: Equations, one: Placed, other: Placed) -> None:
        self.eq, self.legs = equations, (one, other)
        self.least = equations.region.robot.least or ZERO
        self.m, self.n = (equations.number(1) if leg.crank is None else leg.crank for leg in self.legs)
        self.u, self.v = map(self.lowered, self.legs)
        self.w = [plus((1, b), (-1, a)) for a, b in zip(one.arm, other.arm, strict=True)]
        self.a, self.b = one.length, other.length

    def lowered(self, leg: Placed) -> list[Polynomial]:
        """U: from the upper end to the lower one."""
        factor = Fraction(-1)
        if len(leg.leg.axes) == 1:
            factor /= pure.scalar_product(self.eq.g, leg.leg.axes[0], leg.leg.axes[0])
        return [plus((factor, x)) for x in leg.rod]

    def mul(self, *factors: Polynomial) -> Polynomial:
        """A product with y^2 = D, where the factors are."""
        total = self.reduced(factors[-1])
        for factor in reversed(factors[:-1]):
            total = self.reduced(times(factor, total))
        return total

    def reduced(self, polynomial: Polynomial) -> Polynomial:
        """With y^2 = D for both legs."""
        return self.legs[1].without_squares(self.legs[0].without_squares(polynomial))

    def condition(self, direction: Numbers | None) -> Any:
        """That they are apart."""
        exact = Later(self.apart)
        return exact if direction is None else ("or", (self.separated(direction), exact))

    def turned(self) -> list[Signed]:
        """That cranks have an angle."""
        return [Signed(leg.crank, "+") for leg in self.legs if leg.crank is not None]

    def separated(self, direction: Numbers) -> Any:
        """All ends of the second are beyond those of the first."""
        *c, e = direction
        w, u, v = (plus(*zip(c, way, strict=True)) for way in (self.w, self.u, self.v))
        h = plus((1, w), (-self.least * e, self.eq.norm))
        high, low = plus((1, self.mul(self.m, h)), (-1, u)), plus((1, self.mul(self.n, h)), (1, v))
        both = plus((1, self.mul(self.m, self.n, h)), (-1, self.mul(self.n, u)), (1, self.mul(self.m, v)))
        return ("and", [*self.turned(), *(Signed(x, "0+") for x in (h, high, low, both))])

    def apart(self) -> Any:
        """Ends, feet and lines."""
        mul, inner, m, n, a, b = self.mul, self.eq.inner, self.m, self.n, self.a, self.b
        c = inner(self.w, self.w)
        x, y, z = (self.reduced(inner(*two)) for two in ((self.u, self.w), (self.v, self.w), (self.u, self.v)))
        p = plus((1, c), (-(self.least**2), self.eq.square_norm))
        q = plus((1, mul(m, plus((1, p), (1, a)))), (-2, x))
        s = plus((1, mul(n, plus((1, p), (1, b)))), (2, y))
        lower = plus((1, mul(m, n, plus((1, p), (1, a), (1, b)))), (2, mul(m, y)), (-2, mul(n, x)), (-2, z))
        parts: list[Any] = [*self.turned(), *(Signed(value, "0+") for value in (p, q, s, lower))]
        feet = (
            (plus((-1, y)), mul(n, b), mul(n, n, p, b)),
            (plus((1, z), (-1, mul(m, y))), mul(m, n, b), mul(m, n, n, b, q)),
            (x, mul(m, a), mul(m, m, p, a)),
            (plus((1, z), (1, mul(n, x))), mul(m, n, a), mul(n, m, m, a, s)),
        )
        for along, whole, square in feet:
            sides = plus((-1, along)), plus((1, along), (-1, whole)), plus((1, square), (-1, mul(along, along)))
            parts.append(("or", [Signed(side, "0+") for side in sides]))
        gram = plus((1, mul(m, m, n, n, a, b)), (-1, mul(z, z)))
        first = plus((1, mul(n, n, b, x)), (-1, mul(z, y)))
        second = plus((1, mul(z, x)), (-1, mul(m, m, a, y)))
        line = plus((1, mul(p, gram)), (-1, mul(first, x)), (1, mul(second, y)))
        sides_ = (
            plus((-1, first)),
            plus((1, mul(m, first)), (-1, gram)),
            plus((-1, second)),
            plus((1, mul(n, second)), (-1, gram)),
            line,
        )
        return ("and", [*parts, ("or", [Signed(side, "0+") for side in sides_])])


# ---------------------------------------------------------------------------------------------------------------------
# Bernstein coefficients
# ---------------------------------------------------------------------------------------------------------------------


class Table(NamedTuple):
    """For each combination of roots integers, 2^exponent over a denominator times coefficients, row by row."""

    roots: tuple[int, ...]
    degrees: tuple[int, ...]
    parts: dict[tuple[int, ...], list[int]]
    denominator: int
    exponent: int
    bits: int


def table_of(polynomial: Polynomial, box: Sequence[Numbers], roots: int) -> Table:
    """The coefficients on a box."""
    count = len(box)
    degrees = tuple(max((key[k] for key in polynomial), default=0) for k in range(count))
    if isinstance(polynomial, Wide):
        degrees = polynomial.degrees
    used = tuple(k for k in range(roots) if any(key[count + k] for key in polynomial))
    pure.well_formed(all(key[count + k] <= 1 for key in polynomial for k in used), "conditions: a root appears squared")
    size = prod(d + 1 for d in degrees) << len(used)
    pure.affordable(size <= MAX_COEFFICIENTS, f"conditions: a polynomial of more than {MAX_COEFFICIENTS} coefficients")
    words = words_of(polynomial.values()) + words_of([end for pair in box for end in pair]) * max(degrees)
    pure.spend(20_000 * size * (1 + max(degrees)) * size_factor(words // 5, words // 5))
    parts: dict[tuple[int, ...], list[Fraction]] = {}
    for combination in combinations_of((0, 1), repeat=len(used)):
        values = [ZERO] * (size >> len(used))
        for key, value in polynomial.items():
            if tuple(key[count + k] for k in used) == combination:
                place = 0
                for exponent, degree in zip(key, degrees, strict=False):
                    place = place * (degree + 1) + exponent
                values[place] = value
        for k, (low, high) in enumerate(box):
            values = along(values, degrees, k, partial(converted, low=low, width=high - low))
        parts[combination] = values
    denominator = lcm(1, *(number.denominator for values in parts.values() for number in values))
    whole = {key: [int(value * denominator) for value in values] for key, values in parts.items()}
    return Table(used, degrees, whole, denominator, 0, max(map(pure.most_bits, whole.values())))


def along(values: list[Any], degrees: Sequence[int], k: int, change: Callable[[list[Any]], list[Any]]) -> list[Any]:
    """The table with every line along a variable changed."""
    stride = prod(d + 1 for d in degrees[k + 1 :])
    length = degrees[k] + 1
    found = list(values)
    for block in range(0, len(values), stride * length):
        for start in range(block, block + stride):
            place = slice(start, start + stride * length, stride)
            found[place] = change(values[place])
    return found


def converted(line: list[Fraction], low: Fraction, width: Fraction) -> list[Fraction]:
    """From powers of x to Bernstein coefficients on [low, low + width]."""
    d = len(line) - 1
    moved = [
        sum((comb(p, j) * low ** (p - j) * line[p] for p in range(j, d + 1)), ZERO) * width**j for j in range(d + 1)
    ]
    return [sum((Fraction(comb(i, j), comb(d, j)) * moved[j] for j in range(i + 1)), ZERO) for i in range(d + 1)]


def lower(line: list[int]) -> list[int]:
    """2^d times the coefficients on the lower half."""
    d = len(line) - 1
    found, level = [line[0] << d], line
    for r in range(1, d + 1):
        level = [a + b for a, b in pairwise(level)]
        found.append(level[0] << d - r)
    return found


def upper(line: list[int]) -> list[int]:
    """The same on the upper half."""
    return lower(line[::-1])[::-1]


def halves(table: Table, k: int) -> tuple[Table, Table]:
    """A table on both halves along a variable."""
    exponent = table.exponent + table.degrees[k]
    first, second = (
        {key: along(values, table.degrees, k, half) for key, values in table.parts.items()} for half in (lower, upper)
    )
    return table._replace(parts=first, exponent=exponent), table._replace(parts=second, exponent=exponent)


def extremes(table: Table, ends: Sequence[tuple[Fraction, Fraction]]) -> tuple[Any, Any]:
    """The least and the greatest coefficient at the corners of the intervals of the roots, times something positive."""
    if not table.roots:
        values = table.parts[()]
        return min(values), max(values)
    scale = 1
    for k in table.roots:
        scale *= max(ends[k][0].denominator, ends[k][1].denominator)  # powers of two
    low = high = None
    for corner in combinations_of((0, 1), repeat=len(table.roots)):
        y = [ends[k][side] for k, side in zip(table.roots, corner, strict=True)]
        weights = {
            key: int(prod((b for b, used in zip(y, key, strict=True) if used), start=Fraction(scale)))
            for key in table.parts
        }
        values = [
            sum(x) for x in zip(*([weights[key] * v for v in line] for key, line in table.parts.items()), strict=True)
        ]
        low = min(values) if low is None else min(low, *values)
        high = max(values) if high is None else max(high, *values)
    return low, high


def root_ends(table: Table) -> tuple[Fraction, Fraction]:
    """Rational bounds of the root of a D on a part."""
    unit = Fraction(1, table.denominator << table.exponent)
    low, high = (value * unit for value in extremes(table, ()))
    return rational_root(low, up=False), rational_root(high, up=True)


def rational_root(square: Fraction, *, up: bool) -> Fraction:
    """A root rounded down or up to a multiple of 2^-k, by less than 2^-80 of it; 0 of what is not positive."""
    if square <= 0:
        return ZERO
    size = square.numerator.bit_length() - square.denominator.bit_length()
    shift = max(0, ROOT_BITS + 2 - size // 2)
    scaled = square * (1 << 2 * shift)
    floor = isqrt(scaled.numerator // scaled.denominator)
    return Fraction(floor + (up and floor * floor < scaled), 1 << shift)


# ---------------------------------------------------------------------------------------------------------------------
# Matrices that are regular
# ---------------------------------------------------------------------------------------------------------------------


class Wide(dict[tuple[int, ...], Fraction]):
    """A polynomial whose table has at least certain degrees."""

    degrees: tuple[int, ...] = ()


class Matrix(NamedTuple):
    """That a square matrix is regular: its rows, and the place of the root of each, or none."""

    rows: list[list[Wide]]
    roots: list[int | None]


def matrix_of(rows: Sequence[Sequence[Polynomial]], roots: Sequence[int | None], count: int) -> Matrix:
    """The condition: entries of a column get the same degrees in the variables, of which there are so many."""
    found = [[Wide(entry) for entry in row] for row in rows]
    for column in zip(*found, strict=True):
        most = tuple(max((key[k] for entry in column for key in entry), default=0) for k in range(count))
        for entry in column:
            entry.degrees = most
    return Matrix(found, list(roots))


def is_regular(matrix: Matrix, part: Part) -> bool:
    """Whether I - E has leading minors above 0, with E the greatest coefficients of I - C M on a part."""
    tables = [[part.table(entry) for entry in row] for row in matrix.rows]
    size = len(tables)
    columns = []
    for column in zip(*tables, strict=True):
        spend_on_column(column)
        columns.append(column_of(column, matrix.roots, part))
    spend_on_inverse(columns)
    # Rows of M are multiplied by nothing, columns by their scales.
    middles = [[min(low[k]) + max(high[k]) for low, high, _ in columns] for k in range(size)]
    inverse = inverse_of(middles)
    if inverse is None:
        return False
    entries, divisor = inverse
    rest: list[list[int]] = []
    for i in range(size):
        exact = [Fraction(2 * columns[i][2] * entry, divisor) for entry in entries[i]]
        near = [first_digits(value) for value in exact]
        unit = lcm(*(value.denominator for value in near))
        weights = [int(value * unit) for value in near]
        row = []
        for j, (low, high, scale) in enumerate(columns):
            one = unit * scale * (i == j)
            row.append(one - distance(weights, low, high, one))
        rest.append(row)
    return has_positive_minors(rest)


def spend_on_column(tables: Sequence[Table]) -> None:
    """The work of making the tables of a column multiples of one number, and of looking at them for every row."""
    words = sum(table.denominator.bit_length() + table.exponent for table in tables) // 64 + 1
    pure.spend(len(tables) * sum(map(cost_of, tables)) * size_factor(words // 8, 1) // 2)


def spend_on_inverse(columns: Sequence[tuple[list[list[int]], list[list[int]], int]]) -> None:
    """The work of an inverse, and of minors."""
    size = len(columns)
    longest = max(scale.bit_length() + max(map(pure.most_bits, (*low, *high))) for low, high, scale in columns)
    words = size * longest // 64 + 1
    pure.spend(40 * size**3 * size_factor(words, words))


def column_of(
    tables: Sequence[Table], roots: Sequence[int | None], part: Part
) -> tuple[list[list[int]], list[list[int]], int]:
    """By rows the lesser and the greater of the coefficients at both ends of the root, all times a number."""
    scale = lcm(*(table.denominator << table.exponent for table in tables))
    scale *= lcm(*(end.denominator for k in roots if k is not None for end in part.ends[k]))
    lows, highs = [], []
    for table in tables:
        factor = scale // (table.denominator << table.exponent)
        constant = table.parts[(0,) * len(table.roots)]
        if not table.roots:
            lows.append([factor * value for value in constant])
            highs.append(lows[-1])
            continue
        (root,) = table.roots
        one, other = (int(factor * end) for end in part.ends[root])
        pairs = [
            (factor * a + one * b, factor * a + other * b) for a, b in zip(constant, table.parts[(1,)], strict=True)
        ]
        lows.append([min(pair) for pair in pairs])
        highs.append([max(pair) for pair in pairs])
    return lows, highs, scale


def inverse_of(matrix: Sequence[Sequence[int]]) -> tuple[list[list[int]], int] | None:
    """The inverse of a matrix of integers: integers and what they are divided by; none if it is singular."""
    size = len(matrix)
    rows = [[*row, *(int(i == k) for k in range(size))] for i, row in enumerate(matrix)]
    divisor = 1
    for p in range(size):
        chosen = next((r for r in range(p, size) if rows[r][p]), None)
        if chosen is None:
            return None
        rows[p], rows[chosen] = rows[chosen], rows[p]
        pivot = rows[p]
        for r in range(size):
            if r != p:
                factor = rows[r][p]
                rows[r] = [(pivot[p] * x - factor * y) // divisor for x, y in zip(rows[r], pivot, strict=True)]
        divisor = pivot[p]
    return [row[size:] for row in rows], divisor


def first_digits(value: Fraction) -> Fraction:
    """A number with its first binary digits only, nearer to 0."""
    unit = Fraction(2) ** (value.numerator.bit_length() - value.denominator.bit_length() - DIGITS)
    if int(value / unit).bit_length() > DIGITS:
        unit *= 2
    return int(value / unit) * unit


def distance(weights: Sequence[int], low: Sequence[Sequence[int]], high: Sequence[Sequence[int]], one: int) -> int:
    """The greatest distance of a number from what the rows between bounds add up to, with weights."""
    under = [a if w == abs(w) else b for w, a, b in zip(weights, low, high, strict=True)]
    over = [b if w == abs(w) else a for w, a, b in zip(weights, low, high, strict=True)]
    least = min(sum(map(int.__mul__, weights, values)) for values in zip(*under, strict=True))
    most = max(sum(map(int.__mul__, weights, values)) for values in zip(*over, strict=True))
    return max(one - least, most - one)


def has_positive_minors(matrix: Sequence[Sequence[int]]) -> bool:
    """Whether the determinants of the first 1, 2, .. rows and columns are positive: pivots without division."""
    rows, divisor = [list(row) for row in matrix], 1
    while rows:
        first, *others = rows
        if first[0] <= 0:
            return False
        rows = [
            [(first[0] * x - row[0] * y) // divisor for x, y in zip(row[1:], first[1:], strict=True)] for row in others
        ]
        divisor = first[0]
    return True


def determinant_at(matrix: Matrix, point: Numbers, count: int) -> Polynomial:
    """The determinant at a point, a polynomial in the roots, of which there are so many; each is in one row."""
    lines = []
    for row, root in zip(matrix.rows, matrix.roots, strict=True):
        choices: list[tuple[int | None, list[Fraction]]] = [(None, [value_at(entry, point, ()) for entry in row])]
        if root is not None:
            choices.append((root, [value_at(entry, point, (root,)) for entry in row]))
        lines.append(choices)
    found: Polynomial = {}
    words = words_of([value for choices in lines for _, row in choices for value in row])
    for chosen in combinations_of(*lines):
        pure.spend(20_000 * len(lines) ** 3 * size_factor(len(lines) * words, len(lines) * words))
        used = {root for root, _ in chosen}
        key = (0,) * len(point) + tuple(int(k in used) for k in range(count))
        found[key] = found.get(key, ZERO) + determinant_of([row for _, row in chosen])
    return {key: value for key, value in found.items() if value}


def determinant_of(matrix: Sequence[Sequence[Fraction]]) -> Fraction:
    """That of a rational matrix."""
    rows, found = [list(row) for row in matrix], Fraction(1)
    while rows:
        place = next((k for k, row in enumerate(rows) if row[0]), None)
        if place is None:
            return ZERO
        first = rows.pop(place)
        found *= -first[0] if place % 2 else first[0]
        rows = [[x - row[0] / first[0] * y for x, y in zip(row[1:], first[1:], strict=True)] for row in rows]
    return found


# ---------------------------------------------------------------------------------------------------------------------
# Checks
# ---------------------------------------------------------------------------------------------------------------------


def replayed(body: dict[str, Any]) -> Iterator[str]:
    """The content, read at once, and its checks, one after another."""
    return checks(read(body))


def checks(region: Region) -> Iterator[str]:
    """One line per claim that is proved."""
    require_held(region)
    found = Equations(region).all()
    yield f"conditions: {', '.join(region.named)}, as polynomials in {', '.join(region.chart.names)}"
    if region.claim == "not-all":
        nothing = not region.paving and not region.inside and not region.undecided and region.measure is None
        pure.well_formed(nothing, "paving: there is one, but a pose refutes the question")
        yield refuted(region, found)
        return
    pure.well_formed(not region.points, "counterexample: there is one, but the claim is another")
    if region.claim == "designs":
        pure.well_formed(region.measure is None, "measure: claimed where there is none")
        good, bad, undecided = Designs(region, found).counted()
        agree = (good, undecided) == (region.inside, region.undecided)
        pure.require(agree, "inside, undecided: not as many boxes of designs as the paving has")
        yield f"paving: {good} boxes of designs good, {bad} not, each proved; {undecided} undecided"
        require_poses(region, found)
        yield "claim: what the boxes of designs say is true for every design in them"
        return
    is_map = region.claim == "map"
    condition = ("and", [found.region, found.asked]) if is_map else ("or", [opposite(found.region), found.asked])
    shares = followed(region, condition, found.roots)
    outside, undecided = region.paving.count("o"), region.paving.count("u")
    agree = (region.paving.count("i"), undecided) == (region.inside, region.undecided)
    pure.require(agree, "inside, undecided: not as many parts as the paving has")
    yield f"paving: {region.inside} parts inside, {outside} outside, each proved; {undecided} undecided"
    if region.claim == "all":
        pure.require(not outside and not undecided, "claim: not all parts are inside")
        require_poses(region, found)
        yield "claim: all poses of the region are good"
    if region.claim == "undecided":
        pure.require(outside or undecided, "claim: all parts are inside, which is more than claimed")
        yield "claim: none but what is proved of the parts"
    if region.claim == "map" and set(region.chart.names) <= {"x", "y", "z"}:
        size = prod((high - low for low, high in region.chart.box), start=Fraction(1))
        bounds = size * shares["i"], size * (shares["i"] + shares["u"])
        pure.require(
            region.measure == bounds, "measure: not that of the parts inside, and of these with the undecided ones"
        )
        yield "measure: between that of the parts inside, and that of these with the undecided ones"
    else:
        pure.require(region.measure is None, "measure: claimed where there is none")


def require_held(region: Region) -> None:
    """Reject a box that does not hold the balls about all corners of a tube."""
    for name, (low, high) in zip(region.chart.names, region.chart.box, strict=True):
        if name in VARIABLES[:3]:
            k = VARIABLES.index(name)
            for corner in region.corners:
                nearest = min(corner[k] - low, high - corner[k])
                held = nearest >= 0 and nearest**2 * region.robot.g[k] >= region.radius**2
                pure.require(held, "tube: the box does not hold it")


def require_poses(region: Region, found: Conditions) -> None:
    """Reject a region that is not shown to have a pose."""
    if region.member is not None:
        shown = is_in_region(region, found, region.member)
        pure.require(shown, "member: is not proved to be in the region, so nothing shows that the region has poses")
        return
    center = tuple((low + high) / 2 for low, high in region.chart.box)
    has_poses = all(value_at(part.polynomial, center, ()) >= 0 for part in found.shape)
    pure.require(has_poses, "shape: the middle of the box is not in it, so nothing shows that the region has poses")


def is_in_region(region: Region, found: Conditions, point: Numbers) -> bool:
    """Whether a point is in the box, and proved to be in the region."""
    boxed = all(low <= x <= high for x, (low, high) in zip(point, region.chart.box, strict=True))
    return boxed and is_kept(found.region, point, found.roots)


def opposite(condition: Any) -> Any:
    """That a condition fails whose tests are all that something is not negative."""
    if isinstance(condition, Signed):
        return Signed(plus((-1, condition.polynomial)), "+")
    return ("and" if condition[0] == "or" else "or", [opposite(part) for part in condition[1]])


class Part:
    """A part of the box: polynomials get their coefficients on it when they are asked for."""

    def __init__(
        self, region: Region, roots: Sequence[Polynomial], above: Part | None = None, axis: int = 0, side: int = 0
    ) -> None:
        self.region, self.roots, self.above, self.axis, self.side = region, roots, above, axis, side
        self.depth: int = 0 if above is None else above.depth + 1
        self.tables: dict[int, Table] = {}
        self.split: dict[int, tuple[Table, Table]] = {}
        self.known: dict[int, tuple[Any, Any]] = {}

    def halved(self, axis: int) -> list[Part]:
        """The upper and the lower half along a variable."""
        return [Part(self.region, self.roots, self, axis, side) for side in (1, 0)]

    def table(self, polynomial: Polynomial) -> Table:
        """The coefficients, from those of the part above."""
        name = id(polynomial)
        if name not in self.tables:
            if self.above is None:
                self.tables[name] = table_of(polynomial, self.region.chart.box, len(self.roots))
            else:
                if name not in self.above.split:
                    whole = self.above.table(polynomial)
                    pure.spend(cost_of(whole))
                    self.above.split[name] = halves(whole, self.axis)
                self.tables[name] = self.above.split[name][self.side]
        return self.tables[name]

    def range(self, test: Signed | Matrix) -> Any:
        """The least and the greatest coefficient; of a matrix whether it is regular."""
        if isinstance(test, Matrix):
            return is_regular(test, self)
        name = id(test.polynomial)
        if name not in self.known:
            table = self.table(test.polynomial)
            pure.spend(cost_of(table))
            self.known[name] = extremes(table, self.ends)
        return self.known[name]

    @cached_property
    def ends(self) -> list[tuple[Fraction, Fraction]]:
        """Bounds of the roots."""
        tables = [self.table(root) for root in self.roots]
        pure.spend(sum(map(cost_of, tables)))
        return [root_ends(table) for table in tables]


def cost_of(table: Table) -> int:
    """Operations for halving a table, or for looking at it."""
    degree = max(table.degrees, default=0)
    words = (table.bits + table.exponent) // 64 + 1
    coefficients = sum(len(values) for values in table.parts.values()) << len(table.roots)
    return 5000 + 25 * coefficients * (2 + degree) * (4 + words)


def followed(region: Region, condition: Any, roots: Sequence[Polynomial]) -> dict[str, Fraction]:
    """The shares of the letters of a paving, each of which is proved."""
    shares = dict.fromkeys("iou", ZERO)
    waiting = [Part(region, roots)]
    for number, letter in enumerate(region.paving, 1):
        pure.require(waiting, "paving: it goes on after its end")
        part = waiting.pop()
        pure.spend(50_000)
        if letter == "s":
            deep = part.depth < len(region.axes)
            pure.require(deep, f"paving: letter {number} halves a part deeper than the axes say")
            waiting += part.halved(region.axes[part.depth])
            continue
        if letter != "u":
            proved = holds(condition, part.range) if letter == "i" else fails(condition, part.range)
            name = "inside" if letter == "i" else "outside"
            pure.require(proved, f"paving: the part of letter {number} is not proved to be {name}")
        shares[letter] += Fraction(1, 1 << part.depth)
    pure.require(not waiting, "paving: parts of the region are missing")
    return shares


class Designs:
    """The word of a certificate about designs, read from left to right."""

    def __init__(self, region: Region, found: Conditions) -> None:
        self.region, self.found = region, found
        self.letters = enumerate(region.paving, 1)
        self.good = ("or", [opposite(found.region), found.asked])
        self.sided: dict[str, Any] = {}
        determinant = found.determinant if isinstance(found.determinant, dict) else {}
        for sign, factor in (("+", 1), ("-", -1)):
            side = Signed(plus((factor, determinant)), "+")
            self.sided[sign] = ("and", [found.region, *(Signed(root, "0+") for root in found.roots), side])

    def letter(self) -> tuple[int, str]:
        """The next one, and which it is."""
        pure.spend(50_000)
        number, letter = next(self.letters, (0, ""))
        pure.require(number, "paving: parts of the region are missing")
        return number, letter

    def counted(self) -> tuple[int, int, int]:
        """The boxes of designs that are good, bad and undecided, the former two proved."""
        count = len(self.region.chart.parameters)
        start = len(self.region.chart.names) - count
        verdicts: list[str] = []
        waiting = [Part(self.region, self.found.roots)]
        while waiting:
            part = waiting.pop()
            number, letter = self.letter()
            if letter == "s":
                shallow = part.depth < MAX_STEPS
                pure.require(shallow, f"paving: letter {number} halves designs more often than {MAX_STEPS} times")
                waiting += part.halved(start + part.depth % count)
                continue
            pure.require(letter in "ynu", f"paving: letter {number} says nothing of designs")
            verdicts.append(letter)
            if letter == "y":
                self.follow(part, "i")
            if letter == "n":
                said = self.follow(part, "xo+-")
                refuted = "o" in said or {"+", "-"} <= said
                pure.require(refuted, f"paving: the designs of letter {number} are not refuted")
        pure.require(next(self.letters, None) is None, "paving: it goes on after its end")
        good, bad, undecided = map(verdicts.count, "ynu")
        return good, bad, undecided

    def follow(self, designs: Part, known: str) -> set[str]:
        """The letters of the region's word for a box of designs, each proved."""
        said: set[str] = set()
        waiting = [designs]
        while waiting:
            part = waiting.pop()
            number, letter = self.letter()
            depth = part.depth - designs.depth
            if letter == "s":
                deep = depth < len(self.region.axes)
                pure.require(deep, f"paving: letter {number} halves a part deeper than the axes say")
                waiting += part.halved(self.region.axes[depth])
                continue
            pure.require(letter in known, f"paving: letter {number} does not belong to what is said of the designs")
            proved = letter == "x" or self.is_shown(letter, part)
            pure.require(proved, f"paving: what letter {number} says is not proved")
            said.add(letter)
        return said

    def is_shown(self, letter: str, part: Part) -> bool:
        """Whether what a letter says holds all over a part."""
        if letter == "i":
            return holds(self.good, part.range)
        if letter == "o":
            return holds(self.found.region, part.range) and fails(self.found.asked, part.range)
        return holds(self.sided[letter], part.range)


def holds(condition: Any, ranges: Callable[[Any], Any]) -> bool:
    """Whether a condition holds all over a part."""
    if isinstance(condition, Matrix):
        return bool(ranges(condition))
    if isinstance(condition, Signed):
        low, high = ranges(condition)
        return bool(low > 0 or (condition.sign == "0+" and low >= 0) or (condition.sign == "/" and high < 0))
    results = (holds(part, ranges) for part in condition[1])
    return all(results) if condition[0] == "and" else any(results)


def fails(condition: Any, ranges: Callable[[Any], Any]) -> bool:
    """Whether a condition holds nowhere in a part."""
    if isinstance(condition, Matrix):
        return False
    if isinstance(condition, Signed):
        if condition.sign == "/":
            return False
        _, high = ranges(condition)
        return bool(high < 0 or (condition.sign == "+" and high <= 0))
    results = (fails(part, ranges) for part in condition[1])
    return any(results) if condition[0] == "and" else all(results)


def refuted(region: Region, found: Conditions) -> str:
    """One pose that is not good, or two with determinants of opposite signs, in the region."""
    for point in region.points:
        inside = is_in_region(region, found, point)
        pure.require(inside, "counterexample: a pose is not one of the region")
    if len(region.points) == 1:
        broken = is_broken(found.asked, region.points[0], found.roots)
        pure.require(broken, "counterexample: no condition is proved to fail there")
        return "claim: not all poses of the region are good, as one shows"
    pair = len(region.points) == 2 and found.determinant is not None and not region.joints
    pure.well_formed(pair, "counterexample: neither one pose, nor two between which a determinant changes its sign")
    signs = [determinant_sign(found.determinant or {}, point, found.roots) for point in region.points]
    apart = sorted(signs, key=repr) == [-1, 1]
    pure.require(apart, "counterexample: the determinants are not proved to have opposite signs")
    return "claim: not all poses of the region are good, as the determinant has both signs in it, which is connected"


def is_kept(condition: Any, point: Numbers, roots: Sequence[Polynomial]) -> bool:
    """Whether a condition is proved to hold at a pose whose tests are all that something is not negative."""
    if isinstance(condition, Signed):
        sign = sign_at(condition.polynomial, point, roots)
        return sign is not None and sign >= 0
    results = (is_kept(part, point, roots) for part in condition[1])
    return all(results) if condition[0] == "and" else any(results)


def is_broken(condition: Any, point: Numbers, roots: Sequence[Polynomial]) -> bool:
    """Whether a condition is proved to fail at a pose."""
    if isinstance(condition, Matrix):
        return determinant_sign(condition, point, roots) == 0
    if isinstance(condition, Signed):
        sign = sign_at(condition.polynomial, point, roots)
        if sign is None:
            return False
        return {"+": sign <= 0, "0+": sign < 0, "/": sign == 0}[condition.sign]
    results = (is_broken(part, point, roots) for part in condition[1])
    return any(results) if condition[0] == "and" else all(results)


def determinant_sign(determinant: Polynomial | Matrix, point: Numbers, roots: Sequence[Polynomial]) -> int | None:
    """The sign at a point of a determinant, or of that of a matrix."""
    if isinstance(determinant, Matrix):
        determinant = determinant_at(determinant, point, len(roots))
    return sign_at(determinant, point, roots)


def value_at(polynomial: Polynomial, point: Numbers, used: tuple[int, ...]) -> Fraction:
    """The value at a point of the terms with exactly these roots."""
    count = len(point)
    degree = max((sum(key[:count]) for key in polynomial), default=0)
    words = words_of(polynomial.values()) + words_of(point) * degree
    pure.spend(20_000 * (1 + len(polynomial)) * size_factor(words // 5, words // 5))
    total = ZERO
    for key, coefficient in polynomial.items():
        if tuple(k for k, power in enumerate(key[count:]) if power) == used:
            total += prod((x**power for x, power in zip(point, key, strict=False)), start=coefficient)
    return total


def sign_at(polynomial: Polynomial, point: Numbers, roots: Sequence[Polynomial]) -> int | None:
    """The sign at a point, if it is proved."""
    count = len(point)
    groups = {tuple(k for k, power in enumerate(key[count:]) if power) for key in polynomial}
    values = {group: value_at(polynomial, point, group) for group in groups}
    if groups <= {()}:
        value = values.get((), ZERO)
        return (value > 0) - (value < 0)
    squares = [value_at(root, point, ()) for root in roots]
    if min(squares) < 0:
        return None
    for bits in PRECISIONS:
        floors = [isqrt((square.numerator << 2 * bits) // square.denominator) for square in squares]
        low = high = ZERO
        for group, value in values.items():
            small = prod((Fraction(floors[k], 1 << bits) for k in group), start=Fraction(1))
            great = prod((Fraction(floors[k] + 1, 1 << bits) for k in group), start=Fraction(1))
            low, high = low + min(value * small, value * great), high + max(value * small, value * great)
        if low > 0:
            return 1
        if high < 0:
            return -1
    return None

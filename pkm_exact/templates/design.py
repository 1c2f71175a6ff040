"""What a first model is made from: its kind and a few lengths."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from math import isqrt
from typing import TYPE_CHECKING, Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.chains import Crank, JointValue, Slide, cosine_and_sine
from pkm_exact.geometry.inverse import UNIT_METRIC, Matrix, Metric, distance_squared, rotation_of
from pkm_exact.geometry.kinds import KINDS, Joints, Kind, knees
from pkm_exact.geometry.planar_rotation import quarter_turn, turn_of, weight
from pkm_exact.templates import MOST_DECIMALS
from pkm_exact.templates.layout import joints_and_metric, rounded_root
from pkm_exact.templates.rings import Ring, facing, motor_directions, ring_joints
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.geometry.chains import Chain

_CRANKS: Final = ((-2, 0), (2, 0), (1, -1), (-1, 1), (1, 1), (-1, -1))
"""Outward along the sides 1-2, 3-4 and 5-6 of the base, in the metric (1, 3, 1): of length 2, 60 degrees apart."""
_SIXTY_DEGREES: Final = cosine_and_sine(Fraction(15, 26))
"""Nearly, by 0.04 degrees: in ordinary coordinates a rational crank has no rational length at 60 degrees."""


@dataclass(frozen=True)
class Design:
    """A robot by a few numbers, and the pose in which it is at home.

    Attributes
    ----------
    kind : str
        Key in ``KINDS``.
    base, platform : tuple of Fraction
        Sides of the base and of the platform: two of a semi-regular hexagon, or three of a triangle if it is planar.
        Empty if they are on circles.
    height : Fraction
        Where the platform is in its home pose: its distance from the base's plane; y of its frame if it is planar.
    crank : Fraction or None
        Length of the cranks, for a kind that has them.
    digits : int or None
        None for exact joints; else the number of decimals to which they are rounded.
    circles : tuple of 2 Ring, or None
        Instead of sides: where the pairs of joints of base and platform are.
    rod : Fraction or None
        Length of all rods, if it is given; the height is then one at which they nearly fit.
    motor_direction : Fraction
        Degrees between a crank at 0 and the tangent, of joints on circles (``rings.motor_directions``).
    """

    kind: str
    base: tuple[Fraction, ...]
    platform: tuple[Fraction, ...]
    height: Fraction
    crank: Fraction | None = None
    digits: int | None = None
    circles: tuple[Ring, Ring] | None = None
    rod: Fraction | None = None
    motor_direction: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise InputError(f"--kind: {shown(self.kind)} is unknown; use one of: {', '.join(KINDS)}")
        if self.circles is None:
            for option, sides in (("--base-sides", self.base), ("--platform-sides", self.platform)):
                require_sides(KINDS[self.kind], sides, option)
        elif self.digits is None:
            raise InputError("--exact: joints at any azimuth are exact in no metric; leave it out")
        if self.height <= 0:
            raise InputError(f"--height: {shown(self.height)} is not positive; give a length")
        if has_cranks(self.kind) != (self.crank is not None):
            remedy = f"a {self.kind} robot has cranks; give their length" if has_cranks(self.kind) else "leave it out"
            raise InputError(f"--crank: does not fit the kind {self.kind}; {remedy}")
        if self.crank is not None and self.crank <= 0:
            raise InputError(f"--crank: {shown(self.crank)} is not positive; give a length")
        if self.digits is not None and not 0 <= self.digits <= MOST_DECIMALS:
            raise InputError(f"--digits: {self.digits} is out of range; give 0 to {MOST_DECIMALS}")


@dataclass(frozen=True)
class Draft:
    """The robot of a design, in coordinates.

    Attributes
    ----------
    design : Design
    base, platform : tuple of vectors
        Joints with respect to the metric.
    metric : tuple of 3 int
    position : vector
        Of the platform's frame in the home pose.
    half_tangent : Fraction
        Of the platform's turn in the home pose of a planar robot (see ``geometry.planar_rotation``); 0 if it is level.
    chains : tuple of Crank or Slide
        Empty if the legs themselves are actuated. Their rods have no length of their own: ``lengths_squared`` has it.
    lengths_squared : tuple of Fraction
        Of legs or rods in the home pose.
    """

    design: Design
    base: Joints
    platform: Joints
    metric: Metric
    position: Vector
    half_tangent: Fraction
    chains: tuple[Chain, ...]
    lengths_squared: tuple[Fraction, ...]


def has_cranks(kind: str) -> bool:
    """Whether the actuators of a kind are cranks."""
    return KINDS[kind].chain is Crank


def require_sides(kind: Kind, sides: tuple[Fraction, ...], option: str) -> None:
    """Refuse sides that are not those of a hexagon or a triangle."""
    wanted = 3 if kind.motion.is_planar else 2
    if len(sides) != wanted:
        shape = "the three sides of a triangle" if kind.motion.is_planar else "the two sides of a hexagon"
        raise InputError(f"{option}: {len(sides)} numbers; give {shape}, with commas between")
    for side in sides:
        if side < 0 or (kind.motion.is_planar and side == 0):
            raise InputError(f"{option}: {shown(side)} is not positive; give lengths")
    if kind.motion.is_planar and 2 * max(sides) >= sum(sides):
        raise InputError(f"{option}: one side is not shorter than the others together; give the sides of a triangle")
    if not any(sides):
        raise InputError(f"{option}: both are 0; give at least one that is positive")


def drawn(design: Design) -> Draft:
    """The robot of a design in coordinates, its platform level at home; turned a little if it is planar.

    At home cranks are at 0 degrees and slides at 0, and rods are as long as that makes them. (A planar robot is turned
    because three legs of a level one meet in a point where its triangles are isosceles: a singular pose.)

    Examples
    --------
    >>> draft = drawn(Design("6-UPS", (Fraction(4), Fraction(2)), (Fraction(1), Fraction(3)), Fraction(5)))
    >>> draft.metric, str(draft.lengths_squared[0])
    ((1, 3, 1), '82/3')
    """
    planar = KINDS[design.kind].motion.is_planar
    (base, platform), metric = _joints(design)
    zero = Fraction(0)
    if planar:
        position = ((design.base[0] - design.platform[0]) / 2, design.height, zero)
        half_tangent = Fraction(1, isqrt(25 * weight(metric)))
        rotation = turn_of(cosine_and_sine(half_tangent, weight(metric)), metric)
    else:
        position, half_tangent = (zero, zero, design.height), zero
        rotation = rotation_of((Fraction(1), zero, zero, zero))
    chains = _chains(design, metric)
    at_home: JointValue = (Fraction(1), zero) if has_cranks(design.kind) else zero
    feet = knees(base, chains, (at_home,) * len(chains)) if chains else base
    squares = _squares(feet, platform, position, rotation, metric)
    if design.rod is not None:
        squares = (design.rod**2,) * len(squares)
    return Draft(design, base, platform, metric, position, half_tangent, chains, squares)


def with_rods(design: Design, rod: Fraction) -> Design:
    """The design with rods of this length, and at a height where they nearly fit with the actuators at home.

    Raises
    ------
    InputError
        If the kind has no rods, or is planar, or the rods are too short for any height.

    Examples
    --------
    >>> sides = (Fraction(4), Fraction(2)), (Fraction(1), Fraction(3))
    >>> float(with_rods(Design("6-RUS", *sides, Fraction(1), crank=Fraction(1)), Fraction(8)).height)
    7.593857
    """
    kind = KINDS[design.kind]
    if kind.chain is None or kind.motion.is_planar:
        raise InputError(
            f"--rod: is for cranks or slides of a platform in space, not for a {design.kind}; leave it out"
        )
    across = [square - design.height**2 for square in drawn(design).lengths_squared]
    square = rod**2 - sum(across, Fraction(0)) / len(across)
    if rod <= 0 or square <= 0:
        raise InputError(
            f"--rod: {shown(rod)} is too short for any height; give more than {float(max(across)) ** 0.5:.6g}"
        )
    return replace(design, height=rounded_root(square, MOST_DECIMALS // 2), rod=rod)


def _joints(design: Design) -> tuple[list[Joints], Metric]:
    if design.circles is None or design.digits is None:
        return joints_and_metric((design.base, design.platform), design.digits)
    base, platform = design.circles
    azimuths = (base.azimuths, facing(base, platform))
    rows = zip(design.circles, azimuths, strict=True)
    return [ring_joints(ring, places, design.digits) for ring, places in rows], UNIT_METRIC


def _squares(
    feet: Joints, platform: Joints, position: Vector, rotation: Matrix, metric: Metric
) -> tuple[Fraction, ...]:
    squares = tuple(distance_squared(a, b, position, rotation, metric) for a, b in zip(feet, platform, strict=True))
    if 0 in squares:
        raise InputError(f"--height: leg {squares.index(Fraction(0)) + 1} would have length 0; give another height")
    return squares


def _chains(design: Design, metric: Metric) -> tuple[Chain, ...]:
    """Cranks or slides; the rods have length 1 until the home pose says what theirs is."""
    kind, one = KINDS[design.kind], Fraction(1)
    zero = 0 * one
    if kind.chain is Slide:
        direction = (one, zero, zero) if kind.motion.is_planar else (zero, zero, one)
        return (Slide(direction, one),) * kind.legs
    if design.crank is None:
        return ()
    if kind.motion.is_planar:
        crank = (design.crank, zero, zero)
        try:
            return (Crank(crank, quarter_turn(crank, metric, "cranks"), one),) * kind.legs
        except InputError:
            raise InputError(
                "--base-sides and --platform-sides: exact cranks need triangles whose areas are rational; round the "
                "joints with --digits 3, or choose sides such as 13,14,15"
            ) from None
    up, half = (zero, zero, design.crank), design.crank / 2
    if design.circles is not None:
        length = design.crank
        outward = motor_directions(design.circles[0], design.motor_direction)
        return tuple(Crank((x * length, y * length, z * length), up, one) for x, y, z in outward)
    if metric != UNIT_METRIC:
        return tuple(Crank((x * half, y * half, zero), up, one) for x, y in _CRANKS)
    cosine, sine = (value * design.crank for value in _SIXTY_DEGREES)
    steps = [(x * half, zero) if y == 0 else (x * cosine, y * sine) for x, y in _CRANKS]
    return tuple(Crank((x, y, zero), up, one) for x, y in steps)

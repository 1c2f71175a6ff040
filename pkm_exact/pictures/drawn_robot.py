"""A robot and its poses in floating point, ready to be drawn: data of a picture, from whatever they were made."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeAlias

from pkm_exact.motions.motion import Motion
from pkm_exact.pictures.shapes import Shape

if TYPE_CHECKING:
    from pkm_exact.pictures.coordinates import Placed
    from pkm_exact.poses.leg_jacobian import LegJacobian

Point: TypeAlias = tuple[float, float, float]

BODY, BAR = "body", "bar"


@dataclass(frozen=True)
class Part:
    """A passive body of a mechanism, a bar between two bodies, or the line or plane along which a joint slides.

    Attributes
    ----------
    kind : {"body", "bar", "line", "axis", "plane"}
    number : int
        Of the body or the constraint, from 1.
    name : str
    points : tuple of points
        Joints of a body, or the line that shows it, in the fixed frame.
    """

    kind: str
    number: int
    name: str
    points: tuple[Point, ...]


@dataclass(frozen=True)
class PoseView:
    """A pose, ready to be drawn.

    Attributes
    ----------
    number : int
        From 1, in the order of the certificate and of what ``solve`` prints.
    position : tuple of 3 float
        The mobile frame's origin, to the last digits of a double.
    position_half_width : float
        Greatest half width of the listed box in x, y and z.
    rotation : 3 x 3 tuple of float
    platform : tuple of points
        The platform joints in the fixed frame, one per leg.
    det_sign : int or None
        Certified sign of the determinant of the leg Jacobian; 0 at a singular pose, None where it is not decided.
    jacobian : LegJacobian or None
        What is certified of it; None at a singular pose or where it is not decided.
    multiplicity : int or None
        None where it is not proved.
    knees : tuple of points
        Where cranks or slides hold the lower ends of the rods, one per leg; empty if the legs themselves are actuated.
    limits : str or None
        Whether the pose keeps the limits of the model, in words; None if it has none or no model was given.
    parts : tuple of Part
        What else moves: of mechanisms with passive bodies.
    has_jacobian : bool
        Whether there is a leg Jacobian to speak of.
    is_nearest : bool
        Whether it is proved to be the nearest to the pose that is meant.
    """

    number: int
    position: Point
    position_half_width: float
    rotation: tuple[Point, Point, Point]
    platform: tuple[Point, ...]
    det_sign: int | None
    jacobian: LegJacobian | None
    multiplicity: int | None
    knees: tuple[Point, ...] = ()
    limits: str | None = None
    parts: tuple[Part, ...] = ()
    has_jacobian: bool = True
    is_nearest: bool = False

    @property
    def joints(self) -> tuple[Point, ...]:
        """Of the platform, cranks, slides and passive bodies, in the fixed frame."""
        return (*self.platform, *self.knees, *(point for part in self.parts for point in part.points))

    @property
    def condition(self) -> float | None:
        """Condition number of the leg Jacobian; None at a singular pose or where it is not decided."""
        return None if self.jacobian is None or self.jacobian.condition is None else float(self.jacobian.condition)


@dataclass(frozen=True)
class Scene:
    """A robot and all its listed poses, in ordinary coordinates.

    Attributes
    ----------
    name, kind, unit : str
    configuration : str or None
    motion : Motion
        Whether everything lies in the plane of the first two axes.
    claim : str
        What the certificate proves of the list: "complete", "inconsistent", ..
    complex_solutions : int
        Finite complex solutions with multiplicity, as the certificate says.
    base : tuple of points
        Base joints in the fixed frame, one per leg; a crank turns about its own, a slide passes through it.
    platform : tuple of points
        Platform joints in the mobile frame, one per leg.
    legs : tuple of pairs of int
        For each leg the indices of its base and its platform joint.
    lengths : tuple of float
        Of the legs, or of the rods if there are cranks or slides.
    chains : tuple of str
        For each leg "crank" or "slide" if one stands between base joint and rod; otherwise empty.
    poses : tuple of PoseView
    shapes : tuple of Shape
        What holds joints without being a leg: planes, lines, points, axes.
    cables : bool
        Whether the legs are cables.
    bars : tuple of points
        For each leg, if there are any: a bar that does not turn, from the platform's joint to the leg's end.
    """

    name: str
    configuration: str | None
    kind: str
    unit: str
    motion: Motion
    claim: str
    complex_solutions: int
    base: tuple[Point, ...]
    platform: tuple[Point, ...]
    legs: tuple[tuple[int, int], ...]
    lengths: tuple[float, ...]
    chains: tuple[str, ...]
    poses: tuple[PoseView, ...]
    shapes: tuple[Shape, ...] = ()
    cables: bool = False
    bars: tuple[Point, ...] = ()

    @property
    def sorts(self) -> tuple[str, ...]:
        """What stands below rods: cranks, slides, both or nothing."""
        return tuple(dict.fromkeys(filter(None, self.chains)))

    @property
    def size(self) -> float:
        """How large the robot is in all its poses."""
        return extent([*self.base, *(joint for pose in self.poses for joint in pose.joints)])

    @property
    def has_jacobians(self) -> bool:
        """Whether poses have a leg Jacobian to speak of."""
        return all(pose.has_jacobian for pose in self.poses)

    @property
    def parts(self) -> tuple[Part, ...]:
        """What else is drawn, as in the first pose: all bodies, and one bar, line, plane if there are any."""
        first = self.poses[0].parts if self.poses else ()
        return tuple({part.name if part.kind == BODY else (part.kind,): part for part in first}.values())

    def ends(self, pose: PoseView) -> list[tuple[Point, Point]]:
        """The lower and the upper end of each leg or rod."""
        feet = self.feet(pose)
        ends = [(feet[a], pose.platform[b]) for a, b in self.legs]
        if not self.bars:
            return ends
        return [(foot, _plus(joint, bar)) for (foot, joint), bar in zip(ends, self.bars, strict=True)]

    def feet(self, pose: PoseView) -> tuple[Point, ...]:
        """The lower ends of the legs or rods: knees, or base joints."""
        return pose.knees or self.base


def view_of(
    number: int, listed: Mapping[str, Any], place: Placed, platform: Sequence[Point], knees: tuple[Point, ...]
) -> PoseView:
    """A listed pose with its coordinates, ready to be drawn."""
    x = place.coordinates
    position = (x[0], x[1], x[2])
    rotation = ((x[3], x[4], x[5]), (x[6], x[7], x[8]), (x[9], x[10], x[11]))
    return PoseView(
        number=number,
        position=position,
        position_half_width=max(float(Fraction(hi) - Fraction(lo)) / 2 for lo, hi in listed["position"]),
        rotation=rotation,
        platform=tuple(moved(position, rotation, joint) for joint in platform),
        det_sign=place.det_sign,
        jacobian=place.jacobian,
        multiplicity=listed["multiplicity"],
        knees=knees,
    )


def _plus(point: Point, vector: Point) -> Point:
    return point[0] + vector[0], point[1] + vector[1], point[2] + vector[2]


def extent(points: Sequence[Point]) -> float:
    """The greatest difference of a coordinate of points; 1 if there is none."""
    return max(max(values) - min(values) for values in zip(*points, strict=True)) or 1.0


def moved(position: Point, rotation: tuple[Point, Point, Point], joint: Point) -> Point:
    """Where a platform joint stands in a pose: C + R B."""
    x, y, z = (
        c + sum(r * b for r, b in zip(row, joint, strict=True)) for c, row in zip(position, rotation, strict=True)
    )
    return x, y, z

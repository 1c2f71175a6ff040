"""The scene of a mechanism declared by constraints: legs between joints, and planes, lines, points and axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import sqrt
from typing import Any

from pkm_exact.certify.certified_machine import certified_configuration
from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.geometry.machine import CONSTRAINTS_KIND, Machine
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.pictures.coordinates import listed_poses, placed_poses
from pkm_exact.pictures.drawn_robot import Point, Scene, view_of
from pkm_exact.pictures.shapes import AXIS, LINE, PLANE, POINT, Shape, unit

_ROOTS = tuple[float, float, float]


def mechanism_scene(document: Mapping[str, Any], mechanism: ForwardProblem, machine: Machine | None = None) -> Scene:
    """The scene of an accepted certificate of a mechanism, the problem that it answers, and its model if that is known.

    With the model, cranks or slides are drawn, if every rod stands on one of the same sort.
    """
    robot = document["robot"]
    axes = sqrt(mechanism.metric[0]), sqrt(mechanism.metric[1]), sqrt(mechanism.metric[2])
    legs = [found for found in mechanism.constraints if isinstance(found, Distance)]
    base, platform = (
        _joints(mechanism.constraints, Role.BASE_POINT, axes),
        _joints(mechanism.constraints, Role.PLATFORM_POINT, axes),
    )
    pairs = tuple(
        (base.index(_ordinary(leg.base, axes)), platform.index(_ordinary(leg.platform, axes))) for leg in legs
    )
    feet, chain = _feet(machine, legs)
    knees: tuple[Point, ...] = ()
    if feet:
        knees = tuple(_ordinary(leg.base, axes) for leg in legs)
        base, platform = (
            tuple(_ordinary(point, axes) for point in points) for points in (feet, [leg.platform for leg in legs])
        )
        pairs = tuple((k, k) for k in range(len(legs)))
    places = placed_poses(listed_poses(document), mechanism)
    poses = zip(document["poses"], places, strict=True)
    return Scene(
        name=robot["name"],
        configuration=certified_configuration(document),
        kind=CONSTRAINTS_KIND,
        unit=robot["unit"],
        motion=mechanism.motion,
        claim=document["claim"],
        complex_solutions=document["complex_solutions"],
        base=base,
        platform=platform,
        legs=pairs,
        lengths=tuple(sqrt(leg.length_squared) for leg in legs),
        chain=chain,
        poses=tuple(view_of(number, listed, place, platform, knees) for number, (listed, place) in enumerate(poses, 1)),
        shapes=tuple(
            shape
            for number, constraint in enumerate(mechanism.constraints, 1)
            if (shape := shape_of(number, constraint, axes, mechanism.metric)) is not None
        ),
    )


def _feet(machine: Machine | None, legs: Sequence[Distance]) -> tuple[list[Vector], str]:
    """Where the cranks or slides of the rods stand, and which of them they are; nothing if they are not all alike."""
    if not isinstance(machine, Mechanism):
        return [], ""
    own = {constraint.name: constraint for constraint in machine.constraints}
    feet: list[Vector] = []
    sorts = set()
    for leg in legs:
        drives = [
            drive for drive in machine.drives if (leg.name, "base") in ((p.constraint, p.field) for p in drive.parts)
        ]
        if len(drives) != 1:
            return [], ""
        found = own[leg.name]
        feet += [found.base] if isinstance(found, Distance) else []
        sorts.add("crank" if drives[0].is_crank else "slide")
    return (feet, sorts.pop()) if len(sorts) == 1 else ([], "")


def _joints(constraints: Sequence[Constraint], role: Role, axes: _ROOTS) -> tuple[Point, ...]:
    """The different points of one side, in the order in which they are met; the origin if there are none."""
    found: dict[Point, None] = {}
    for constraint in constraints:
        for field, own in constraint.fields.items():
            # A line and an axis have a point of their own, which is no joint.
            if own == role and not (field == "point" and "direction" in constraint.fields):
                found[_ordinary(getattr(constraint, field), axes)] = None
    return tuple(found) or ((0.0, 0.0, 0.0),)


def shape_of(number: int, constraint: Constraint, axes: _ROOTS, metric: tuple[int, int, int]) -> Shape | None:
    """What a constraint looks like beside its joints; None for a leg, an angle or any other form."""
    roles = constraint.fields
    moves = Role.PLATFORM_DIRECTION in roles.values()
    directions = [field for field, role in roles.items() if role in (Role.BASE_DIRECTION, Role.PLATFORM_DIRECTION)]
    points = {role: getattr(constraint, field) for field, role in roles.items() if role in _POINTS}
    if len(directions) == 2 or not points or isinstance(constraint, Distance):
        return None
    held = _ordinary(points[Role.BASE_POINT if moves else Role.PLATFORM_POINT], axes)
    if not directions:
        return Shape(POINT, number, constraint.name, _ordinary(points[Role.BASE_POINT], axes), (0.0, 0.0, 0.0), held)
    vector = getattr(constraint, directions[0])
    direction = unit(_ordinary(vector, axes))
    if Role.BASE_POINT in points and not moves:
        kind = AXIS if Role.POSITIVE in roles.values() else LINE
        return Shape(kind, number, constraint.name, _ordinary(points[Role.BASE_POINT], axes), direction, held)
    return Shape(PLANE, number, constraint.name, _in_plane(constraint, vector, axes, metric), direction, held, moves)


_POINTS = (Role.BASE_POINT, Role.PLATFORM_POINT)


def _in_plane(constraint: Constraint, normal: Vector, axes: _ROOTS, metric: tuple[int, int, int]) -> Point:
    """The point of a plane that is nearest to the origin of its frame."""
    square = sum((g * n * n for g, n in zip(metric, normal, strict=True)), Fraction(0))
    offset: Fraction = getattr(constraint, constraint.value_field or "")
    x, y, z = (offset * n / square for n in normal)
    return _ordinary((x, y, z), axes)


def _ordinary(vector: Sequence[Fraction], axes: _ROOTS) -> Point:
    x, y, z = (float(value) * axis for value, axis in zip(vector, axes, strict=True))
    return x, y, z

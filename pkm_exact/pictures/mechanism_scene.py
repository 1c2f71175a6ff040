"""The scene of a mechanism declared by constraints: legs between joints, and planes, lines, points and axes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from math import sqrt
from typing import Any

from pkm_exact.certify.certified_machine import certified_configuration
from pkm_exact.constraints.angle import Angle
from pkm_exact.constraints.constraint import Constraint, Role
from pkm_exact.constraints.distance import Distance
from pkm_exact.constraints.form import Vector
from pkm_exact.constraints.point_in_plane import InPlane
from pkm_exact.geometry.drives import Part, coefficients
from pkm_exact.geometry.kind_names import CONSTRAINTS_KIND
from pkm_exact.geometry.machine import Machine
from pkm_exact.geometry.machines.triangle import along
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.problem import ForwardProblem
from pkm_exact.motions.motion_groups import SPHERICAL
from pkm_exact.pictures.coordinates import listed_poses, placed_poses
from pkm_exact.pictures.drawn_robot import Point, Scene, view_of
from pkm_exact.pictures.shapes import ARC, ARM, AXES, AXIS, LINE, PLANE, POINT, STRUT, Shape, arc, cross, unit

_ROOTS = tuple[float, float, float]
_ORIGIN = (0.0, 0.0, 0.0)


def mechanism_scene(document: Mapping[str, Any], mechanism: ForwardProblem, machine: Machine | None = None) -> Scene:
    """The scene of an accepted certificate of a mechanism, the problem that it answers, and its model if that is known.

    With the model, cranks and slides are drawn, and what else drives put between base and constraint.
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
    feet, chains = legs_on_chains(machine, legs)
    knees: tuple[Point, ...] = ()
    bars = [_ordinary(bar, axes) for bar in machine.bars] if isinstance(machine, Mechanism) else []
    if any(chains):
        # What the constraint of a leg has without the bar stands beside the machine.
        aside = bars or [_ORIGIN] * len(legs)
        knees = tuple(_beside(leg.base, axes, bar) for leg, bar in zip(legs, aside, strict=True))
        base = tuple(_beside(foot, axes, bar) for foot, bar in zip(feet, aside, strict=True))
        held = [_ordinary(leg.platform, axes) for leg in legs]
        platform = (*held, *(point for point in platform if point not in held and point != _ORIGIN))
        pairs = tuple((k, k) for k in range(len(legs)))
    on_sphere = not legs and mechanism.motion.name == SPHERICAL.name
    if on_sphere:
        base, platform = _on_sphere(mechanism.constraints, axes)
    arms = tuple(drive_shapes(machine, mechanism, axes, on_sphere=on_sphere))
    if on_sphere and arms:
        base = tuple(arm.place for arm in arms)
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
        chains=chains if any(chains) else ("",) * len(legs),
        poses=tuple(view_of(number, listed, place, platform, knees) for number, (listed, place) in enumerate(poses, 1)),
        shapes=(
            *_shapes(mechanism, axes, struts_of(machine, mechanism, axes), on_sphere=on_sphere),
            *arms,
        ),
        bars=tuple(bars),
    )


def _shapes(
    mechanism: ForwardProblem, axes: _ROOTS, struts: Mapping[str, Shape], *, on_sphere: bool
) -> Iterator[Shape]:
    for number, constraint in enumerate(mechanism.constraints, 1):
        shape = struts.get(constraint.name) or shape_of(number, constraint, axes, mechanism.metric)
        if shape is not None:
            yield replace(shape, kind=ARC) if on_sphere and shape.kind == AXES else shape


def struts_of(machine: Machine | None, mechanism: ForwardProblem, axes: _ROOTS) -> dict[str, Shape]:
    """Planes of a model that stand for a strut upright on a rail or a crank, by their names."""
    found: dict[str, Shape] = {}
    feet = dict(machine.feet) if isinstance(machine, Mechanism) else {}
    for number, constraint in enumerate(mechanism.constraints, 1):
        if constraint.name not in feet or not isinstance(constraint, InPlane):
            continue
        normal, foot = _ordinary(constraint.normal, axes), _ordinary(feet[constraint.name], axes)
        square = sum(x * x for x in normal)
        share = (float(constraint.offset) - sum(n * x for n, x in zip(normal, foot, strict=True))) / square
        strut = share * normal[0], share * normal[1], share * normal[2]
        held = _ordinary(constraint.platform, axes)
        found[constraint.name] = Shape(STRUT, number, constraint.name, foot, strut, held)
    return found


def _on_sphere(constraints: Sequence[Constraint], axes: _ROOTS) -> tuple[tuple[Point, ...], tuple[Point, ...]]:
    """Where the axes of base and platform meet the sphere about the point in which all of them meet."""
    angles = [found for found in constraints if isinstance(found, Angle)]
    base, platform = ([unit(_ordinary(getattr(a, side), axes)) for a in angles] for side in ("base", "platform"))
    return tuple(base) or (_ORIGIN,), tuple(platform) or (_ORIGIN,)


def drive_shapes(
    machine: Machine | None, mechanism: ForwardProblem, axes: _ROOTS, *, on_sphere: bool = False
) -> Iterator[Shape]:
    """What the drives of a model put between base and the constraints that are no legs: arms, from joint to joint."""
    if not isinstance(machine, Mechanism) or not machine.drives:
        return
    locked = {constraint.name: constraint for constraint in mechanism.constraints}
    values = machine.values_of(locked)
    own = {constraint.name: constraint for constraint in machine.constraints}
    numbers = {constraint.name: number for number, constraint in enumerate(machine.constraints, 1)}
    at = dict(zip(machine.actuated, values or (), strict=False))
    for number, (label, way) in enumerate(_carriages(machine, at), len(own) + 1):
        places = tuple(_ordinary(point, axes) for point in way)
        yield Shape(ARM, number, label, places[0], _ORIGIN, _ORIGIN, path=places)
    for name, constraint in own.items():
        field = _driven_point(constraint)
        moving = [(drive, part) for drive in machine.drives for part in drive.parts if part.constraint == name]
        paths = [(drive, part) for drive, part in moving if part.field == field and drive.name in at]
        if field and paths:
            points = [getattr(constraint, field)]
            for drive, part in paths:
                factors = coefficients(at[drive.name])
                points.append(along((1, points[-1]), *zip(factors, part.axes, strict=True)))  # type: ignore[arg-type]
            label = ", ".join(drive.name for drive, _ in paths)
            path = tuple(_ordinary(point, axes) for point in points)
            own_shape = shape_of(numbers[name], locked[name], axes, mechanism.metric)
            shift, held = (own_shape.direction, own_shape.joint) if own_shape else (_ORIGIN, _ORIGIN)
            yield Shape(ARM, numbers[name], label, path[0], shift, held, path=path)
        turned = [drive.name for drive, part in moving if field and part.field == "direction"]
        axis = shape_of(numbers[name], locked[name], axes, mechanism.metric) if turned else None
        if axis is not None and axis.kind == AXIS:
            ends = (axis.place, axis.place)
            yield Shape(ARM, numbers[name], turned[0], axis.place, axis.direction, axis.joint, path=ends, standing=1)
        if on_sphere and isinstance(constraint, Angle):
            for drive, part in moving:
                u, v = (_ordinary(axis, axes) for axis in part.axes)  # type: ignore[arg-type]
                end = unit(_ordinary(getattr(locked[name], "base"), axes))  # noqa: B009
                path = arc(unit(cross(u, v)), end)
                yield Shape(ARM, numbers[name], drive.name, path[0], _ORIGIN, _ORIGIN, path=path)


def _carriages(machine: Mechanism, at: Mapping[str, Any]) -> Iterator[tuple[str, list[Vector]]]:
    """Of legs whose feet several drives move together: these drives, and the way of the middle of the feet."""
    legs: dict[tuple[str, ...], list[tuple[Distance, list[Part]]]] = {}
    for constraint in machine.constraints:
        parts = [
            (drive.name, part)
            for drive in machine.drives
            for part in drive.parts
            if (part.constraint, part.field) == (constraint.name, "base") and drive.name in at
        ]
        if isinstance(constraint, Distance) and len(parts) > 1:
            legs.setdefault(tuple(name for name, _ in parts), []).append((constraint, [part for _, part in parts]))
    for names, moved in legs.items():
        share = Fraction(1, len(moved))
        points = [along(*((share, leg.base) for leg, _ in moved))]
        for k, name in enumerate(names):
            factors = coefficients(at[name])
            steps = [(share * x, axis) for _, parts in moved for x, axis in zip(factors, parts[k].axes, strict=True)]
            points.append(along((1, points[-1]), *steps))  # type: ignore[arg-type]
        yield ", ".join(names), points


def _driven_point(constraint: Constraint) -> str:
    """The field of the point that a drive moves, of constraints that are no legs."""
    if isinstance(constraint, Distance):
        return ""
    return next((field for field, role in constraint.fields.items() if role == Role.BASE_POINT), "")


def legs_on_chains(machine: Machine | None, legs: Sequence[Distance]) -> tuple[list[Vector], tuple[str, ...]]:
    """Where the legs stand, on what sort of chain each of them does, if a single one moves it."""
    own = {found.name: found for found in machine.constraints} if isinstance(machine, Mechanism) else {}
    feet: list[Vector] = []
    sorts: list[str] = []
    for leg in legs:
        drives = (
            []
            if not isinstance(machine, Mechanism)
            else [
                drive
                for drive in machine.drives
                if (leg.name, "base") in ((p.constraint, p.field) for p in drive.parts)
            ]
        )
        found = own.get(leg.name)
        is_single = len(drives) == 1 and isinstance(found, Distance)
        feet.append(found.base if is_single and isinstance(found, Distance) else leg.base)
        sorts.append(("crank" if drives[0].is_crank else "slide") if is_single else "")
    return feet, tuple(sorts)


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
    """What a constraint looks like beside its joints; None for a leg or any other form."""
    roles = constraint.fields
    moves = Role.PLATFORM_DIRECTION in roles.values()
    directions = [field for field, role in roles.items() if role in (Role.BASE_DIRECTION, Role.PLATFORM_DIRECTION)]
    points = {role: getattr(constraint, field) for field, role in roles.items() if role in _POINTS}
    if isinstance(constraint, Angle):
        n, m = (unit(_ordinary(direction, axes)) for direction in (constraint.base, constraint.platform))
        return Shape(AXES, number, constraint.name, _ORIGIN, n, m)
    if not points or isinstance(constraint, Distance):
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


def _beside(vector: Sequence[Fraction], axes: _ROOTS, bar: Point) -> Point:
    x, y, z = (value + shift for value, shift in zip(_ordinary(vector, axes), bar, strict=True))
    return x, y, z


def _ordinary(vector: Sequence[Fraction], axes: _ROOTS) -> Point:
    x, y, z = (float(value) * axis for value, axis in zip(vector, axes, strict=True))
    return x, y, z

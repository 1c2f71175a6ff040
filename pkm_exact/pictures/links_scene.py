"""The scene of a mechanism with passive bodies: a body through its joints, bars between bodies, lines and planes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from math import sqrt
from typing import Any, Final, TypeAlias

from pkm_exact.certify.certified_links import (
    BodyPlace,
    JoinedConstraint,
    assemblies,
    certified_metric,
    joined_constraints,
)
from pkm_exact.claim import Claim
from pkm_exact.constraints.constraint import Role
from pkm_exact.constraints.distance import Distance
from pkm_exact.geometry.inverse import Metric
from pkm_exact.geometry.kind_names import LINKS_KIND
from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.pictures.drawn_robot import BAR, BODY, Part, Point, PoseView, Scene, extent, moved
from pkm_exact.pictures.mechanism_scene import shape_of
from pkm_exact.pictures.shapes import AXES, Turn

_Roots: TypeAlias = tuple[float, float, float]
_ORIGIN: Final = (0.0, 0.0, 0.0)
_Place: TypeAlias = tuple[Point, Turn]
_GROUND: Final[_Place] = _ORIGIN, ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def links_scene(document: Mapping[str, Any]) -> Scene:
    """The scene of an accepted links certificate; the body that is asked about is the platform.

    Examples
    --------
    >>> import json
    >>> from pathlib import Path
    >>> scene = links_scene(json.loads(Path("certs/links/watt.json").read_text()))
    >>> [part.name for part in scene.poses[0].parts], len(scene.poses)
    (['first coupler', 'middle', 'second coupler'], 2)
    """
    mechanism, system = document["mechanism"], document["system"]
    joined, asked, metric = joined_constraints(document), mechanism["platform"], certified_metric(mechanism)
    roots = sqrt(metric[0]), sqrt(metric[1]), sqrt(metric[2])
    joints = [_joints(joined, body, roots) for body in range(len(mechanism["bodies"]) + 1)]
    names = [body["name"] for body in mechanism["bodies"]]
    found = list(assemblies(document))
    stood = [[_GROUND, *(_place(place, roots) for place in places)] for places, _ in found]
    size = extent([*joints[0], *chain.from_iterable(_moved(joints, places) for places in stood)] or [_ORIGIN])
    poses = []
    for number, (places, (bodies, multiplicity)) in enumerate(zip(stood, found, strict=True), 1):
        standing = [tuple(moved(*place, joint) for joint in own) for place, own in zip(places, joints, strict=True)]
        passive = [
            Part(BODY, body, name, standing[body])
            for body, name in enumerate(names, 1)
            if body != asked and joints[body]
        ]
        poses.append(
            PoseView(
                number=number,
                position=places[asked][0],
                position_half_width=float(bodies[asked - 1].half_width) * max(roots),
                rotation=places[asked][1],
                platform=standing[asked] or (places[asked][0],),
                det_sign=None,
                jacobian=None,
                multiplicity=multiplicity,
                parts=(*passive, *_between(joined, places, size, metric)),
                has_jacobian=False,
            )
        )
    return Scene(
        name=mechanism["name"],
        configuration=document["configuration"],
        kind=LINKS_KIND,
        unit=mechanism["unit"],
        motion=PLANAR if mechanism["planar"] else SPATIAL,
        claim=str(Claim.NOT_PROVEN_COMPLETE) if system is None else system["claim"],
        complex_solutions=0 if system is None else system["complex_solutions"],
        base=joints[0] or (_ORIGIN,),
        platform=joints[asked] or (_ORIGIN,),
        legs=(),
        lengths=(),
        chains=(),
        poses=tuple(poses),
    )


def _joints(joined: Sequence[JoinedConstraint], body: int, roots: _Roots) -> tuple[Point, ...]:
    """The different points of a body that constraints hold, in its frame; a point of a line is none."""
    found: dict[Point, None] = {}
    for one in joined:
        fields = one.constraint.fields
        for field, role in fields.items():
            owner = {Role.BASE_POINT: one.first, Role.PLATFORM_POINT: one.second}.get(role)
            if owner == body and not (field == "point" and "direction" in fields):
                found[_ordinary(getattr(one.constraint, field), roots)] = None
    return tuple(found)


def _between(
    joined: Sequence[JoinedConstraint], places: Sequence[_Place], size: float, metric: Metric
) -> Iterator[Part]:
    """Bars of known length between two bodies; lines, axes and planes of one at the joints of another."""
    roots = sqrt(metric[0]), sqrt(metric[1]), sqrt(metric[2])
    for number, one in enumerate(joined, 1):
        constraint, first, second = one.constraint, places[one.first], places[one.second]
        if isinstance(constraint, Distance):
            base, platform = (_ordinary(point, roots) for point in (constraint.base, constraint.platform))
            ends = moved(*first, base), moved(*second, platform)
            yield Part(BAR, number, constraint.name, ends)
            continue
        shape = shape_of(number, constraint, roots, metric)
        if shape is not None and shape.kind != AXES:
            for line in shape.lines(*_seen(first, second), size):
                yield Part(shape.kind, number, constraint.name, tuple(moved(*first, point) for point in line))


def _seen(first: _Place, second: _Place) -> _Place:
    """The place of the second body seen from the first."""
    columns = tuple(zip(*first[1], strict=True))
    away = [b - a for a, b in zip(first[0], second[0], strict=True)]
    x, y, z = (sum(a * b for a, b in zip(axis, away, strict=True)) for axis in columns)
    rows = (
        _point([sum(a * b for a, b in zip(axis, other, strict=True)) for other in zip(*second[1], strict=True)])
        for axis in columns
    )
    u, v, w = rows
    return (x, y, z), (u, v, w)


def _moved(joints: Sequence[Sequence[Point]], places: Sequence[_Place]) -> Iterator[Point]:
    for place, own in zip(places, joints, strict=True):
        yield from (moved(*place, joint) for joint in own)


def _place(place: BodyPlace, roots: _Roots) -> _Place:
    u, v, w = (
        _point([root * float(entry) / other for entry, other in zip(row, roots, strict=True)])
        for row, root in zip(place.rotation, roots, strict=True)
    )
    return _ordinary(place.position, roots), (u, v, w)


def _ordinary(vector: Sequence[Any], roots: _Roots) -> Point:
    return _point([float(value) * root for value, root in zip(vector, roots, strict=True)])


def _point(vector: Sequence[Any]) -> Point:
    x, y, z = map(float, vector)
    return x, y, z

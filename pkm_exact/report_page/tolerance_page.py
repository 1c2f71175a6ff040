"""The poses of a tolerance certificate: boxes that hold one pose of every robot within tolerance."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import sqrt
from typing import Any, Final

from pkm_exact.motions.motion_groups import PLANAR, SPATIAL
from pkm_exact.pictures.drawn_robot import Point, PoseView, Scene, moved
from pkm_exact.report_page.numerals import bound, distance, in_unit
from pkm_exact.report_page.rows import QUATERNION, Box, Cell, Column, PoseRows, Row, box_of, enclosed, half_width
from pkm_exact.roots.interval import decimal

DEGREES: Final = Fraction(180 * 10**16, 31415926535897932)
"""An upper bound for 180 / pi."""
_DIGITS: Final = 5


def tolerance_rows(document: Mapping[str, Any], scene: Scene) -> PoseRows:
    """The rows of a tolerance certificate."""
    axes = ("x", "y") if scene.motion.is_planar else ("x", "y", "z")
    columns = [Column(axis, f"middle of the bounds of {axis}{in_unit(scene.unit)}") for axis in axes]
    if not scene.motion.is_planar:
        columns += [Column(name, "middle of its bounds; unit quaternion, scalar first") for name in QUATERNION]
    columns += [Column(f"{axis} ±", f"half width of the bounds of {axis}{in_unit(scene.unit)}") for axis in axes]
    columns += [
        Column(
            "position error", f"no robot within tolerance is farther from the nominal position{in_unit(scene.unit)}"
        ),
        Column("rotation error", "no robot within tolerance is turned more from the nominal orientation [degrees]"),
    ]
    rows = tuple(_row(entry, scene) for entry in document["boxes"])
    plain = ("pose", "x", "y", "z", *QUATERNION, "error", "position_error", "rotation_error")
    return PoseRows(tuple(columns), rows, plain, ("pose", "position_error", "rotation_error"))


def _row(entry: Mapping[str, Any], scene: Scene) -> Row:
    box = box_of(entry)
    count = 2 if scene.motion.is_planar else 3
    position, quaternion = (tuple(map(decimal, part)) for part in (box.position, box.quaternion))
    coordinates = (*box.position[:count], *(() if scene.motion.is_planar else box.quaternion))
    moved, turned = Fraction(entry["position_error"]), Fraction(entry["rotation_error"])
    errors = (bound(moved), bound(turned * DEGREES))
    error = bound(distance([*position, *quaternion], [*box.position, *box.quaternion]))
    cells = (
        *(enclosed(interval, _DIGITS) for interval in coordinates),
        *(half_width([interval]) for interval in box.position[:count]),
        *(Cell(text, text, float(value)) for text, value in zip(errors, (moved, turned), strict=True)),
    )
    number = str(entry["pose"])
    return Row(
        entry["pose"],
        cells,
        _lines(box, scene, position[:count], errors),
        f"Position error at most {errors[0]}, rotation error at most {errors[1]} degrees.",
        position,
        quaternion,
        tuple(tuple(map(decimal, row)) for row in box.rotation),
        box.bounds,
        (number, *position, *quaternion, error, *(str(value) for value in (moved, turned))),
        (number, str(moved), str(turned)),
    )


def _lines(box: Box, scene: Scene, position: Sequence[str], errors: tuple[str, str]) -> tuple[tuple[str, str], ...]:
    widths = ", ".join(half_width([interval]).text for interval in box.position[: len(position)])
    return (
        (f"middle of the box{in_unit(scene.unit)}", f"({', '.join(position)})"),
        ("half widths of the box", f"({widths})"),
        (f"greatest position error{in_unit(scene.unit)}", errors[0]),
        ("greatest rotation error [degrees]", errors[1]),
    )


def tolerance_scene(document: Mapping[str, Any]) -> Scene:
    """The nominal robot, with its platform in the middle of each box."""
    robot, configuration = document["robot"], document["configuration"]
    axes = [sqrt(int(g)) for g in robot["metric"]]
    base, platform = (tuple(_ordinary(joint, axes) for joint in robot[key]) for key in ("base", "platform"))
    return Scene(
        name=robot["name"],
        configuration=configuration["name"],
        kind=robot["kind"],
        unit=robot["unit"],
        motion=PLANAR if len(base) == 3 else SPATIAL,
        claim="",
        complex_solutions=0,
        base=base,
        platform=platform,
        legs=tuple((i, i) for i in range(len(base))),
        lengths=tuple(sqrt(Fraction(square)) for square in configuration["lengths_squared"]),
        chains=(),
        poses=tuple(_view(entry, platform) for entry in document["boxes"]),
    )


def _view(entry: Mapping[str, Any], platform: Sequence[Point]) -> PoseView:
    box = box_of(entry)
    x, y, z = (float(interval.midpoint) for interval in box.position)
    first, second, third = (_point([float(interval.midpoint) for interval in row]) for row in box.rotation)
    rotation = (first, second, third)
    return PoseView(
        number=entry["pose"],
        position=(x, y, z),
        position_half_width=float(max(interval.width for interval in box.position) / 2),
        rotation=rotation,
        platform=tuple(moved((x, y, z), rotation, joint) for joint in platform),
        det_sign=None,
        jacobian=None,
        multiplicity=None,
    )


def _ordinary(joint: Sequence[str], axes: Sequence[float]) -> Point:
    return _point([float(Fraction(value)) * axis for value, axis in zip(joint, axes, strict=True)])


def _point(values: Sequence[float]) -> Point:
    x, y, z = values
    return x, y, z

"""The poses of a certificate as the page needs them: cells of the table, numbers in full, and points to draw."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import floor, log10
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.indices.index import Index, Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.poses.pose_names import pose_signature, told_apart
from pkm_exact.report_page.numerals import bound, distance, in_unit, shortened
from pkm_exact.roots.interval import Interval, decimal

if TYPE_CHECKING:
    from pkm_exact.pictures.drawn_robot import PoseView, Scene

QUATERNION: Final = ("q0", "q1", "q2", "q3")
_SHORT_QUATERNION: Final = 5
_SHORT_SIGNIFICANT: Final = 7


@dataclass(frozen=True)
class Cell:
    """Text of a cell, the same with all certain digits, and the number to sort by; None where there is none."""

    text: str
    full: str
    value: float | None


@dataclass(frozen=True)
class Column:
    """Title of a column and what it says, in words."""

    title: str
    meaning: str


@dataclass(frozen=True)
class Row:
    """One pose.

    Attributes
    ----------
    number : int
    cells : tuple of Cell
        For the table, without the number.
    lines : tuple of pairs of str
        Names and values of what is shown of one pose.
    summary : str
        What is read out when it is shown.
    position, quaternion : tuple of str
        Decimals, with all digits that are certain.
    rotation : 3 x 3 tuple of str
    bounds : tuple of triples of str
        Name, lower and upper end of every interval of the box, as they stand in the certificate.
    plain : tuple of str
        For the table of decimals to be copied.
    first : tuple of str
        For the table of exact bounds, what precedes them.
    is_nearest : bool
        Whether it is the pose nearest to the one that is meant.
    """

    number: int
    cells: tuple[Cell, ...]
    lines: tuple[tuple[str, str], ...]
    summary: str
    position: tuple[str, ...]
    quaternion: tuple[str, ...]
    rotation: tuple[tuple[str, ...], ...]
    bounds: tuple[tuple[str, str, str], ...]
    plain: tuple[str, ...]
    first: tuple[str, ...]
    is_nearest: bool = False


@dataclass(frozen=True)
class PoseRows:
    """All poses, the columns of their table, and those of the two tables to be copied."""

    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    plain: tuple[str, ...]
    first: tuple[str, ...]


@dataclass(frozen=True)
class Box:
    """The intervals of an entry of a certificate, and their ends as they are written there."""

    position: tuple[Interval, ...]
    rotation: tuple[tuple[Interval, ...], ...]
    quaternion: tuple[Interval, ...]
    bounds: tuple[tuple[str, str, str], ...]


def box_of(entry: Mapping[str, Any]) -> Box:
    """The box of an entry: position, rotation by rows, quaternion, in ordinary coordinates.

    Examples
    --------
    >>> unit = ["0", "1"]
    >>> box = box_of({"position": [["0", "1/2"]] * 3, "rotation": [[unit] * 3] * 3, "quaternion": [unit] * 4})
    >>> box.bounds[0], str(box.position[0].midpoint)
    (('x', '0', '1/2'), '1/4')
    """
    named = dict(zip(("x", "y", "z"), entry["position"], strict=True))
    named |= {f"r{i}{j}": entry["rotation"][i - 1][j - 1] for i in (1, 2, 3) for j in (1, 2, 3)}
    named |= dict(zip(QUATERNION, entry["quaternion"], strict=True))
    return Box(
        tuple(_interval(ends) for ends in entry["position"]),
        tuple(tuple(_interval(ends) for ends in row) for row in entry["rotation"]),
        tuple(_interval(ends) for ends in entry["quaternion"]),
        tuple((name, low, high) for name, (low, high) in named.items()),
    )


def _interval(ends: Sequence[str]) -> Interval:
    return Interval(Fraction(ends[0]), Fraction(ends[1]))


def short_digits(size: float) -> int:
    """Digits after the point of a position in the table, for a robot of this size.

    Examples
    --------
    >>> short_digits(1250.0), short_digits(0.5), short_digits(1e9)
    (3, 7, 0)
    """
    return max(0, _SHORT_SIGNIFICANT - 1 - floor(log10(size)))


def enclosed(interval: Interval, digits: int) -> Cell:
    """A cell for a number that lies in an interval."""
    return Cell(shortened(interval, digits), decimal(interval), float(interval.midpoint))


def half_width(intervals: Sequence[Interval]) -> Cell:
    """A cell for the greatest half width of some intervals."""
    greatest = max(interval.width for interval in intervals) / 2
    return Cell(bound(greatest), bound(greatest), float(greatest))


def _size(scene: Scene) -> float:
    return max(abs(x) for view in scene.poses for joint in (*scene.base, *view.platform, *view.knees) for x in joint)


def certified_rows(document: Mapping[str, Any], scene: Scene) -> PoseRows:
    """The rows of a pose certificate."""
    columns = (*_coordinate_columns(scene), *_common_columns(scene))
    names = ("x", "y", "theta") if scene.motion.is_planar else ("x", "y", "z")
    plain = (
        "pose",
        "name",
        *names,
        *QUATERNION,
        "error",
        *(index.name for index in shown_in(Output.PAGE)),
        "multiplicity",
    )
    boxes = [box_of(entry) for entry in document["poses"]]
    signatures = [
        pose_signature(box.position, box.rotation, view.det_sign, scene.motion)
        for box, view in zip(boxes, scene.poses, strict=True)
    ]
    found = zip(document["poses"], boxes, scene.poses, told_apart(signatures), strict=True)
    rows = tuple(_row(document, *parts, scene) for parts in found)
    return PoseRows(columns, rows, plain, ("pose", "name", "claim", "multiplicity", "t_lo", "t_hi"))


def _coordinate_columns(scene: Scene) -> list[Column]:
    axes = [Column(axis, f"position {axis}{in_unit(scene.unit)}") for axis in ("x", "y", "z")]
    if scene.motion.is_planar:
        return [*axes[:2], Column("theta", "angle [degrees]")]
    return axes + [Column(name, "unit quaternion, scalar first") for name in QUATERNION]


def _common_columns(scene: Scene) -> list[Column]:
    return [
        *(Column(index.heading, index.meaning) for index in shown_in(Output.PAGE)),
        Column("mult.", "multiplicity of the solution"),
        Column("box ±", f"half width of the box of the position{in_unit(scene.unit)}"),
    ]


def _row(
    document: Mapping[str, Any], entry: Mapping[str, Any], box: Box, view: PoseView, name: str, scene: Scene
) -> Row:
    position, quaternion = (tuple(map(decimal, part)) for part in (box.position, box.quaternion))
    digits = short_digits(_size(scene))
    angle = _angle(box) if scene.motion.is_planar else None
    if scene.motion.is_planar:
        turned = Cell("?", "?", None) if angle is None else enclosed(angle, _SHORT_QUATERNION)
        coordinates = [*(enclosed(c, digits) for c in box.position[:2]), turned]
    else:
        coordinates = [enclosed(c, digits) for c in box.position]
        coordinates += [enclosed(q, _SHORT_QUATERNION) for q in box.quaternion]
    texts, intervals = [*position, *quaternion], [*box.position, *box.quaternion]
    place = position
    if scene.motion.is_planar:
        place = (*position[:2], "" if angle is None else decimal(angle))
        texts, intervals = ([*texts, place[2]], [*intervals, angle]) if angle else (texts, intervals)
    error = bound(distance(texts, intervals))
    multiplicity = str(view.multiplicity)
    indices = shown_in(Output.PAGE)
    parameter = entry["parameter"] or ["", ""]
    return Row(
        view.number,
        (*coordinates, *_common_cells(view, box)),
        (*_lines(view, scene, box, place), ("name", name)),
        f"{', '.join(f'{index.heading} is {index.in_words(view)}' for index in indices)}.",
        position,
        quaternion,
        tuple(tuple(map(decimal, row)) for row in box.rotation),
        box.bounds,
        (str(view.number), name, *place, *quaternion, error, *(_plain(index, view) for index in indices), multiplicity),
        (str(view.number), name, document["claim"], multiplicity, *parameter),
        view.is_nearest,
    )


def _angle(box: Box) -> Interval | None:
    from pkm_exact.poses.planar_coordinates import angle_in_degrees

    return angle_in_degrees(box.rotation[0][0], box.rotation[1][0])


def _plain(index: Index, view: PoseView) -> str:
    """An index for a program: an integer as it is, nothing where it is not decided."""
    value = index.value(view)
    return index.text(view) if not index.is_integer else "" if value is None else str(value)


def _common_cells(view: PoseView, box: Box) -> list[Cell]:
    multiplicity = view.multiplicity
    texts = ((index.text(view), index.number(view)) for index in shown_in(Output.PAGE))
    return [
        *(Cell(text, text, number) for text, number in texts),
        Cell(str(multiplicity or "?"), str(multiplicity or "?"), multiplicity),
        half_width(box.position),
    ]


def _lines(view: PoseView, scene: Scene, box: Box, place: Sequence[str]) -> tuple[tuple[str, str], ...]:
    lines = [(f"position{in_unit(scene.unit)}", f"({', '.join(place[:2] if scene.motion.is_planar else place)})")]
    if scene.motion.is_planar:
        lines.append(("angle [degrees]", place[2] or "not decided"))
    else:
        lines.append(("unit quaternion, scalar first", f"({', '.join(map(decimal, box.quaternion))})"))
    widths = f"{half_width(box.position).text} (position), {half_width(box.quaternion).text} (quaternion)"
    return (
        *lines,
        ("half widths of the box", widths),
        *((index.heading, index.in_words(view)) for index in shown_in(Output.PAGE)),
        ("multiplicity", "not proved" if view.multiplicity is None else str(view.multiplicity)),
        *(() if view.limits is None else (("limits of the model kept", view.limits),)),
        *((("nearest", "of all poses to the one that is meant"),) if view.is_nearest else ()),
    )

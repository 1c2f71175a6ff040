"""Poses in model files: a position, and a rotation by a quaternion, a matrix or angles. All exact.

Angles in degrees stand for the rational rotation next to them (``degrees``): the pose is that one.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.form import Vector, value_at
from pkm_exact.errors import InputError
from pkm_exact.geometry.fields import known_keys, list_field, required
from pkm_exact.geometry.inverse import Matrix, Metric, cross, dot, rotation_of
from pkm_exact.geometry.planar_rotation import parse_half_tangent, parse_turn
from pkm_exact.geometry.rational import parse_positive, parse_rational, parse_vector
from pkm_exact.geometry.rotation_degrees import checked_degrees, quaternion_of_angles
from pkm_exact.motions.motion import Motion
from pkm_exact.wording import shown, three_digits

_PLANAR_TURNS: Final = ("half_tangent", "cos_sin", "degrees")
_SPATIAL_TURNS: Final = ("quaternion", "rpy_degrees", "matrix")
_ORIGIN: Final = (Fraction(0), Fraction(0), Fraction(0))
_UNTURNED: Final = (Fraction(1), *_ORIGIN)


def read_pose(pose: object, where: str, motion: Motion, metric: Metric) -> tuple[Vector, Matrix]:
    """Position and rotation matrix, in rational coordinates, of the pose that a table gives.

    What all motions of the group have in common may be left out: the position of turns about the origin, the quaternion
    of translations.

    Raises
    ------
    InputError
        If it is no pose of the motion.

    Examples
    --------
    >>> from pkm_exact.motions.motion_groups import TRANSLATION
    >>> position, rotation = read_pose({"position": [1, "1/2", 3]}, "pose", TRANSLATION, (1, 1, 1))
    >>> [str(x) for x in (*position, *rotation[0])]
    ['1', '1/2', '3', '1', '0', '0']
    """
    turns = _PLANAR_TURNS if motion.is_planar else _SPATIAL_TURNS
    if not isinstance(pose, dict):
        rotation = "half_tangent = ..." if motion.is_planar else "quaternion = [...]"
        raise InputError(f"{where}: {shown(pose)} is not a table; write {{ position = [...], {rotation} }}")
    known_keys(pose, ("position", *turns, *(("nearest",) if "matrix" in pose else ())), where)
    moves, turning = 0 in motion.twist, bool({3, 4, 5} & set(motion.twist))
    position = _ORIGIN
    if moves or "position" in pose:
        dimension = 2 if motion.is_planar else 3
        position = parse_vector(required(pose, "position", f"{where}."), f"{where}.position", dimension)
    if motion.is_planar:
        return position, _planar_rotation(pose, where, metric)
    given = any(key in pose for key in _SPATIAL_TURNS)
    turned = _rotation(pose, where, metric) if turning or given else rotation_of(_UNTURNED, metric)
    if any(value_at(form, position, turned, metric) for form in motion.forms):
        raise InputError(f"{where}: is not among the {motion.title} that the mechanism is capable of; give one that is")
    return position, turned


def _rotation(pose: dict[str, Any], where: str, metric: Metric) -> Matrix:
    if "rpy_degrees" in pose:
        _given_once(pose, _SPATIAL_TURNS, where)
        roll, pitch, yaw = _angles(pose["rpy_degrees"], f"{where}.rpy_degrees", 3, metric)
        return rotation_of(quaternion_of_angles(roll, pitch, yaw), metric)
    if "matrix" in pose:
        _given_once(pose, _SPATIAL_TURNS, where)
        return _matrix(pose, where, metric)
    row = list_field(required(pose, "quaternion", f"{where}."), f"{where}.quaternion", 4)
    if len(row) != 4:
        raise InputError(f"{where}.quaternion: {len(row)} numbers; give 4, scalar first")
    e0, e1, e2, e3 = (parse_rational(e, f"{where}.quaternion[{i}]") for i, e in enumerate(row, 1))
    if not any((e0, e1, e2, e3)):
        raise InputError(f"{where}.quaternion: all four numbers are 0; give one that is not")
    return rotation_of((e0, e1, e2, e3), metric)


def _matrix(pose: dict[str, Any], where: str, metric: Metric) -> Matrix:
    """A rotation by its matrix, which is one exactly, or the one next to it, off by ``nearest`` at most."""
    from pkm_exact.geometry.nearest_rotation import nearest_rotation

    if any(g != 1 for g in metric):
        raise InputError(f"{where}.matrix: is for ordinary coordinates; in a metric give a quaternion")
    rows = list_field(pose["matrix"], f"{where}.matrix", 3)
    if len(rows) != 3:
        raise InputError(f"{where}.matrix: {len(rows)} rows; give 3 of 3 numbers")
    first, second, third = (parse_vector(row, f"{where}.matrix[{i}]", 3) for i, row in enumerate(rows, 1))
    quaternion, off = nearest_rotation((first, second, third), f"{where}.matrix")
    if "nearest" in pose:
        room = parse_positive(pose["nearest"], f"{where}.nearest")
    elif (
        cross(first, second) == third
        and dot(first, first) == 1
        and dot(first, second) == 0
        and dot(second, second) == 1
    ):
        return first, second, third
    else:
        room = Fraction(0)
    if off > room:
        raise InputError(
            f"{where}.matrix: is no rotation, the next one differs by up to {three_digits(off, up=True)}; give an "
            "exact matrix, or nearest = W as well to take the rotation next to it, off by at most W"
        )
    return rotation_of(quaternion, metric)


def _planar_rotation(pose: dict[str, Any], where: str, metric: Metric) -> Matrix:
    key = _given_once(pose, _PLANAR_TURNS, where)
    if key == "degrees":
        (angle,) = _angles([pose[key]], f"{where}.{key}", 1, metric)
        return rotation_of(quaternion_of_angles(_ORIGIN[0], _ORIGIN[0], angle), metric)
    parse = parse_half_tangent if key == "half_tangent" else parse_turn
    return parse(pose[key], f"{where}.{key}", metric)


def _given_once(pose: dict[str, Any], keys: tuple[str, ...], where: str) -> str:
    given = [key for key in keys if key in pose]
    if len(given) != 1:
        raise InputError(f"{where}: {' and '.join(given) or 'no angle'} given; give one of {', '.join(keys)}")
    return given[0]


def _angles(values: object, where: str, count: int, metric: Metric) -> list[Fraction]:
    if any(g != 1 for g in metric):
        raise InputError(
            f"{where}: angles in degrees are not rational in the metric [{', '.join(map(str, metric))}]; give numbers "
            "of the metric, or a model in ordinary coordinates"
        )
    row = list_field(values, where, count)
    if len(row) != count:
        raise InputError(f"{where}: {len(row)} numbers; give {count}: roll, pitch, yaw")
    return [checked_degrees(parse_rational(angle, f"{where}[{i}]"), where) for i, angle in enumerate(row, 1)]

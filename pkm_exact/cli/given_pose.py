"""A pose on the command line: an exact position and rotation, in ordinary coordinates or in those of the file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.errors import InputError, InternalContradictionError
from pkm_exact.geometry.rotation_degrees import NEAREST_TURN
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Vector
    from pkm_exact.geometry.inverse import Matrix, Metric, Quaternion
    from pkm_exact.geometry.machine import Machine

_PLANAR: Final = ("--half-tangent", "--cos-sin", "--degrees")
_IN_DEGREES: Final = ("--rpy", "--degrees")
_NO_ROTATION: Final = (
    "give exactly one of --quaternion, --cayley, --matrix and --rpy; of --half-tangent, --cos-sin and --degrees if it "
    "is planar; none only if it does not turn."
)
_COUNTS: Final = {
    "--quaternion": 4,
    "--cayley": 3,
    "--matrix": 9,
    "--rpy": 3,
    "--half-tangent": 1,
    "--cos-sin": 2,
    "--degrees": 1,
}


@dataclass(frozen=True)
class GivenPose:
    """What was given: numbers, not yet a pose of a robot."""

    position: Vector
    option: str
    values: list[Fraction]
    nearest: Fraction | None
    in_metric: bool


def pose_options(*, required: bool) -> Callable[[Any], Any]:
    """The options of a pose, as a decorator of a command."""
    origin = "The platform's origin, exact: 0,-1/3,12.5. X,Y if planar."
    options = [
        click.option("--position", metavar="X,Y,Z", required=required, help=origin),
        click.option("--quaternion", metavar="E0,E1,E2,E3", help="Its rotation, scalar first, of any norm."),
        click.option("--cayley", metavar="A,B,C", help="Its rotation as a Cayley vector: the quaternion 1,A,B,C."),
        click.option("--matrix", metavar="R11,..,R33", help="Its rotation matrix row by row, checked exactly."),
        click.option(
            "--rpy",
            metavar="R,P,Y",
            help="Its rotation by roll, pitch and yaw in degrees: R = Rz(yaw) Ry(pitch) Rx(roll).",
        ),
        click.option("--half-tangent", metavar="T", help="A planar robot's rotation: the tangent of half its angle."),
        click.option("--cos-sin", metavar="C,S", help="Or cosine and sine of its angle, checked exactly."),
        click.option("--degrees", metavar="A", help="Or the angle itself."),
        click.option(
            "--nearest",
            callback=arguments.nearest,
            metavar="W",
            help="Where there is no such pose exactly (angles in degrees, a rounded matrix, a metric): take one that "
            "differs by at most W in any coordinate.  [default for angles in degrees: 1e-12]",
        ),
        click.option(
            "--in-metric", is_flag=True, help="The pose is in the coordinates of the file, as a pose in it is."
        ),
    ]

    def decorated(command: Any) -> Any:
        for option in reversed(options):
            command = option(command)
        return command

    return decorated


def given_pose(position: str, *, in_metric: bool, nearest: Fraction | None, **turns: str | None) -> GivenPose:
    """The numbers that the options denote.

    Raises
    ------
    click.UsageError
        If they are not numbers, or too many or too few.
    """
    words = {f"--{name.replace('_', '-')}": text for name, text in turns.items()}
    given = [(name, text) for name, text in words.items() if text is not None]
    if not given and position.count(",") == 2:
        # Enough for a machine that only moves; for others `pose_of` asks for the rotation.
        return GivenPose(_vector(numbers(position, "--position", 3)), "", [], nearest, in_metric)
    if len(given) != 1:
        raise click.UsageError(_NO_ROTATION)
    if in_metric and nearest is not None:
        raise click.UsageError("--in-metric and --nearest exclude each other: a pose of the file is exact.")
    if in_metric and given[0][0] in _IN_DEGREES:
        raise click.UsageError(f"--in-metric and {given[0][0]} exclude each other: angles are ordinary ones.")
    option, text = given[0]
    origin = numbers(position, "--position", 2 if option in _PLANAR else 3)
    values = numbers(text, option, _COUNTS[option])
    if option == "--quaternion" and not any(values):
        raise click.UsageError("--quaternion: all four numbers are 0, give one that is not.")
    return GivenPose(_vector(origin), option, values, nearest, in_metric)


def pose_of(given: GivenPose, robot: Machine, model: str) -> tuple[Vector, Matrix, Fraction | None]:
    """The pose in the coordinates of the model, and by how much it may be off; None if it is exact."""
    from pkm_exact.motions.motion_groups import TRANSLATION

    if not given.option:
        if robot.motion != TRANSLATION:
            raise click.UsageError(_NO_ROTATION)
        given = replace(given, option="--quaternion", values=[Fraction(n) for n in (1, 0, 0, 0)])
    _require_kind(given.option, robot, model)
    if given.in_metric:
        return given.position, _rotation(given.option, given.values, robot.metric), None
    return _in_model(given.position, given.option, given.values, robot.metric, given.nearest)


def _in_model(
    position: Vector, option: str, values: list[Fraction], metric: Metric, nearest: Fraction | None
) -> tuple[Vector, Matrix, Fraction | None]:
    """An ordinary pose in the coordinates of the model, and by how much it may be off; None if it is exact."""
    from pkm_exact.geometry.inverse import rotation_of
    from pkm_exact.geometry.ordinary_pose import model_position, model_quaternion

    ordinary, off = _ordinary_quaternion(option, values, nearest)
    if off:
        nearest = nearest or NEAREST_TURN
    room = None if nearest is None else nearest - off
    place, quaternion = model_position(position, metric), model_quaternion(ordinary, metric)
    used = None if place is not None and quaternion is not None and not off else nearest
    for found, where in ((place, "--position"), (quaternion, option)):
        if found is None and room is None:
            raise InputError(
                f"{where}: in the model's metric [{', '.join(map(str, metric))}] these numbers are not rational, so "
                "that no pose of it is exactly there; give --nearest 1e-9 to take one that near, or --in-metric with a "
                "pose in the coordinates of the file"
            )
    place = place or model_position(position, metric, room)
    quaternion = quaternion or model_quaternion(ordinary, metric, room)
    if place is None or quaternion is None:
        raise InternalContradictionError("a pose near the given one was not found")
    return place, rotation_of(quaternion, metric), used


def _ordinary_quaternion(option: str, values: list[Fraction], nearest: Fraction | None) -> tuple[Quaternion, Fraction]:
    """An ordinary quaternion of the rotation, and by how much its matrix may be off: half of what is allowed."""
    from pkm_exact.geometry.nearest_rotation import nearest_rotation
    from pkm_exact.geometry.ordinary_pose import quaternion_of
    from pkm_exact.geometry.rotation_degrees import checked_degrees, is_exact_turn, quaternion_of_angles

    if option in _IN_DEGREES:
        angles = [checked_degrees(angle, option) for angle in values]
        roll, pitch, yaw = angles if option == "--rpy" else (Fraction(0), Fraction(0), angles[0])
        off = Fraction(0) if all(map(is_exact_turn, angles)) else (nearest or NEAREST_TURN) / 2
        return quaternion_of_angles(roll, pitch, yaw, off or NEAREST_TURN), off
    if option == "--matrix" and nearest is not None:
        quaternion, off = nearest_rotation((values[:3], values[3:6], values[6:]), option)
        if off > nearest / 2:
            raise InputError(
                f"{option}: the rotation next to this matrix differs by {float(off):.1g} from it in some entry, more "
                f"than half of what --nearest allows; give --nearest {float(2.1 * float(off)):.1g} or more digits"
            )
        return quaternion, off
    return quaternion_of(_rotation(option, values, (1, 1, 1))), Fraction(0)


def numbers(text: str, option: str, count: int) -> list[Fraction]:
    """So many exact numbers between commas."""
    from pkm_exact.geometry.rational import NumberText, parse_rational

    words = [word.strip() for word in text.split(",")]
    if len(words) != count:
        raise click.UsageError(f"{option}: {len(words)} numbers given, {count} are needed between commas.")
    try:
        return [
            parse_rational(word if "/" in word else NumberText(word), f"{option}, number {i}")
            for i, word in enumerate(words, 1)
        ]
    except InputError as error:
        raise click.UsageError(str(error)) from None


def _vector(values: list[Fraction]) -> Vector:
    x, y, z = values if len(values) == 3 else [*values, Fraction(0)]
    return x, y, z


def _require_kind(option: str, robot: Machine, model: str) -> None:
    """Refuse the rotation of a planar robot for a spatial one, and the other way round."""
    planar = robot.motion.is_planar
    if planar and option not in _PLANAR:
        raise InputError(
            f"{model}: {option} is for spatial robots, but a {robot.kind} robot is planar; "
            "give --position X,Y and --half-tangent, --cos-sin or --degrees"
        )
    if not planar and option in _PLANAR:
        raise InputError(
            f"{model}: {option} is for planar robots, but a {robot.kind} robot is spatial; "
            "give --position X,Y,Z and --quaternion, --cayley, --matrix or --rpy"
        )


def _rotation(option: str, values: list[Fraction], metric: Metric) -> Matrix:
    from pkm_exact.geometry.inverse import rotation_of
    from pkm_exact.geometry.planar_rotation import parse_half_tangent, parse_turn

    if option == "--matrix":
        matrix = (_vector(values[:3]), _vector(values[3:6]), _vector(values[6:]))
        _require_rotation(matrix, metric)
        return matrix
    if option == "--half-tangent":
        return parse_half_tangent(values[0], option, metric)
    if option == "--cos-sin":
        return parse_turn(values, option, metric)
    e0, e1, e2, e3 = values if option == "--quaternion" else [Fraction(1), *values]
    return rotation_of((e0, e1, e2, e3), metric)


def _in(metric: Metric) -> str:
    return "" if set(metric) == {1} else f" in the metric {', '.join(map(str, metric))}"


def _require_rotation(matrix: Matrix, metric: Metric) -> None:
    """Refuse a matrix R unless R^T G R = G and det R = 1."""
    from pkm_exact.geometry.inverse import dot

    columns = [_vector(list(column)) for column in zip(*matrix, strict=True)]
    for i in range(3):
        for j in range(i + 1):
            product, wanted = dot(columns[i], columns[j], metric), metric[i] if i == j else 0
            if product != wanted:
                raise InputError(
                    f"--matrix: not a rotation{_in(metric)}: columns {j + 1} and {i + 1} have the product "
                    f"{shown(product)} instead of {wanted}; give an exact rotation matrix, or --nearest W to take the "
                    "rotation next to it"
                )
    (a, b, c), (d, e, f), (x, y, z) = matrix
    if a * (e * z - f * y) - b * (d * z - f * x) + c * (d * y - e * x) != 1:
        raise InputError("--matrix: its determinant is -1, a reflection; give a rotation matrix")

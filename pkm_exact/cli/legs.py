"""The command ``legs``: inverse kinematics, exact leg lengths and joint values at a rational pose."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Final

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.main import ExitCode
from pkm_exact.errors import InputError, InternalContradictionError
from pkm_exact.geometry.degrees import NEAREST_TURN
from pkm_exact.wording import shown

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Vector
    from pkm_exact.geometry.inverse import Matrix, Metric, Quaternion
    from pkm_exact.geometry.machine import Machine

_PLANAR: Final = ("--half-tangent", "--cos-sin", "--degrees")
_IN_DEGREES: Final = ("--rpy", "--degrees")


@click.command(short_help="Leg lengths and joint values at a given pose.")
@click.argument("model", type=arguments.FilePath())
@click.option(
    "--position", metavar="X,Y,Z", required=True, help="The platform's origin, exact: 0,-1/3,12.5. X,Y if planar."
)
@click.option("--quaternion", metavar="E0,E1,E2,E3", help="Its rotation, scalar first, of any norm.")
@click.option("--cayley", metavar="A,B,C", help="Its rotation as a Cayley vector: the quaternion 1,A,B,C.")
@click.option("--matrix", metavar="R11,..,R33", help="Its rotation matrix row by row, checked exactly.")
@click.option(
    "--rpy", metavar="R,P,Y", help="Its rotation by roll, pitch and yaw in degrees: R = Rz(yaw) Ry(pitch) Rx(roll)."
)
@click.option("--half-tangent", metavar="T", help="A planar robot's rotation: the tangent of half its angle.")
@click.option("--cos-sin", metavar="C,S", help="Or cosine and sine of its angle, checked exactly.")
@click.option("--degrees", metavar="A", help="Or the angle itself.")
@click.option(
    "--nearest",
    callback=arguments.nearest,
    metavar="W",
    help="Where there is no such pose exactly (angles in degrees, a rounded matrix, a metric): take one that differs "
    "by at most W in any coordinate.  [default for angles in degrees: 1e-12]",
)
@click.option("--in-metric", is_flag=True, help="The pose is in the coordinates of the file, as a pose in it is.")
@click.option(
    "--width",
    callback=arguments.width,
    metavar="W",
    default="1e-9",
    show_default=True,
    help="Greatest width of a bound on an irrational number, exact: 1e-9 or 1/1000.",
)
@click.option(
    "--format",
    "layout",
    type=click.Choice(["table", "json"]),
    default="table",
    show_default=True,
    help="What to print: decimals, or exact values and bounds as json.",
)
def legs(
    model: str,
    position: str,
    quaternion: str | None,
    cayley: str | None,
    matrix: str | None,
    rpy: str | None,
    half_tangent: str | None,
    cos_sin: str | None,
    degrees: str | None,
    nearest: Fraction | None,
    in_metric: bool,
    width: Fraction,
    layout: str,
) -> int:
    """Print what the legs of the robot in the file MODEL must be for its platform to stand at a pose.

    Leg lengths where these are actuated; else every crank angle or slide position, all working modes; of a mechanism
    declared by constraints the values of all of them, and whether those that are not actuated hold. Coordinates are
    ordinary ones, as in every output. In the table, a line to copy into a configuration comes first if the values are
    rational.

    \b
    Examples:
      certify-poses legs models/rolland-6-6.toml --position 0,0,650 --quaternion 9,1,0,-1
      certify-poses legs models/hexa.toml --position 0,0,650 --cayley 0,1/9,0 --format json
      certify-poses legs models/rolland-6-6.toml --position 0,0,650 --rpy 0,10,-2.5
      certify-poses legs models/3-rpr-merlet-p.toml --position 5,9/2 --half-tangent 1/3
    """
    words = {
        "--quaternion": (quaternion, 4),
        "--cayley": (cayley, 3),
        "--matrix": (matrix, 9),
        "--rpy": (rpy, 3),
        "--half-tangent": (half_tangent, 1),
        "--cos-sin": (cos_sin, 2),
        "--degrees": (degrees, 1),
    }
    given = [(name, text, count) for name, (text, count) in words.items() if text is not None]
    if len(given) != 1:
        raise click.UsageError(
            "give exactly one of --quaternion, --cayley, --matrix and --rpy; of --half-tangent, --cos-sin and "
            "--degrees if it is planar."
        )
    if in_metric and nearest is not None:
        raise click.UsageError("--in-metric and --nearest exclude each other: a pose of the file is exact.")
    if in_metric and given[0][0] in _IN_DEGREES:
        raise click.UsageError(f"--in-metric and {given[0][0]} exclude each other: angles are ordinary ones.")
    # Before the file is read: what is wrong with the words is said first.
    option, text, count = given[0]
    origin = _numbers(position, "--position", 2 if option in _PLANAR else 3)
    values = _numbers(text, option, count)
    if option == "--quaternion" and not any(values):
        raise click.UsageError("--quaternion: all four numbers are 0, give one that is not.")

    from pkm_exact.cli import constraint_values_report, legs_report
    from pkm_exact.cli.model_reading import announced_model
    from pkm_exact.geometry.mechanism import Mechanism

    robot = announced_model(model)
    _require_kind(option, robot, model)
    if in_metric:
        place, rotation, used = _vector(origin), _rotation(option, values, robot.metric), None
    else:
        place, rotation, used = _in_model(_vector(origin), option, values, robot.metric, nearest)
    answer: dict[str, Any] | str
    as_json = layout == "json"
    if isinstance(robot, Mechanism):
        report = constraint_values_report.as_object if as_json else constraint_values_report.as_text
        answer = report(robot, place, rotation, width, used)
    else:
        answer = (legs_report.as_object if as_json else legs_report.as_text)(robot, place, rotation, width, used)
    sys.stdout.write(answer if isinstance(answer, str) else json.dumps(answer, indent=1) + "\n")
    return ExitCode.DONE


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
    from pkm_exact.geometry.degrees import checked_degrees, is_exact_turn, quaternion_of_angles
    from pkm_exact.geometry.nearest_rotation import nearest_rotation
    from pkm_exact.geometry.ordinary_pose import quaternion_of

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


def _numbers(text: str, option: str, count: int) -> list[Fraction]:
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

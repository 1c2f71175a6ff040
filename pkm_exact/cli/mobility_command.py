"""The command ``mobility``: how a mechanism can move, and which actuators hold it."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Vector
    from pkm_exact.geometry.inverse import Matrix
    from pkm_exact.geometry.linkage import Linkage
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.robot import Robot


def _names(_context: click.Context, _option: click.Parameter, value: str | None) -> tuple[str, ...] | None:
    """The names between commas; none at all if the text is empty."""
    return None if value is None else tuple(word.strip() for word in value.split(",") if word.strip())


@click.command()
@click.argument("model", type=arguments.FilePath())
@click.option(
    "--at",
    "pose",
    metavar="X,Y,Z,E0,..,E3",
    help="Pose of the platform, exact, in the coordinates of the file: position and quaternion; if it is planar X,Y,T "
    "with T the tangent of half the angle.",
)
@click.option("--actuated", callback=_names, metavar="NAMES", help="What is actuated, instead of what the model says.")
@click.option("--among", callback=_names, metavar="NAMES", help="Joints that minimal sets of actuators may be made of.")
@arguments.configuration_option
@click.option(
    "-o",
    "--output",
    type=arguments.FilePath(),
    metavar="CERT.json",
    help="Write a certificate: ranks by their minors and null spaces, for the command check.",
)
@click.option("--json", "as_json", is_flag=True, help="Print all of it as a JSON object, every number exact.")
def mobility(
    model: str,
    pose: str | None,
    actuated: tuple[str, ...] | None,
    among: tuple[str, ...] | None,
    configuration: str | None,
    output: str | None,
    as_json: bool,
) -> int:
    """Print how the mechanism in the file MODEL can move: exact ranks, freedoms in words, actuators that hold it.

    Of a mechanism of bodies and joints (kind "chains"): its instantaneous mobility beside the count of Gruebler and
    Kutzbach, its finite mobility where that is proved, passive freedoms, constraints of the legs, and all minimal
    sets of actuators. Of a robot or of a mechanism declared by constraints: the freedoms of the platform at a pose,
    with actuators free and locked, and whether it is singular at every pose. Exit code 3: the finite mobility, or
    what holds at every pose, is not proved.

    \b
    Examples:
      certify-poses mobility models/chains/3-pprr.toml
      certify-poses mobility models/chains/3-pprr.toml --actuated A1,B1 --json
      certify-poses mobility models/chains/sarrus.toml -o sarrus-mobility.json
      certify-poses mobility models/rolland-6-6.toml --at 0,0,650,9,1,0,-1 -o rolland-mobility.json
    """
    from pkm_exact.cli.model_reading import announced_any
    from pkm_exact.geometry.linkage import Linkage

    if output is not None:
        arguments.require_other_file(Path(output), model, "-o")
        arguments.require_writable(Path(output), "-o")
    found = announced_any(model)
    try:
        if isinstance(found, Linkage):
            for option, given in (("--at", pose), ("--configuration", configuration)):
                if given is not None:
                    raise InputError(
                        f"{option}: a mechanism of bodies and joints stands as its file says; leave it out"
                    )
            answer, known = _of_linkage(found, actuated, among, output, as_json=as_json)
        else:
            if among is not None:
                raise InputError("--among: belongs to mechanisms of bodies and joints; leave it out")
            answer, known = _of_platform(found, pose, actuated, configuration, output, as_json=as_json)
    except InputError as error:
        raise InputError(f"{model}: {error}") from None
    sys.stdout.write(answer if isinstance(answer, str) else json.dumps(answer, indent=1) + "\n")
    return ExitCode.DONE if known else ExitCode.WEAKER_CLAIM


def _of_linkage(
    linkage: Linkage,
    actuated: tuple[str, ...] | None,
    among: tuple[str, ...] | None,
    output: str | None,
    *,
    as_json: bool,
) -> tuple[dict[str, Any] | str, bool]:
    from pkm_exact.cli import mobility_report
    from pkm_exact.mobility.analysis import mobility_of

    found = mobility_of(linkage, actuated, among)
    if output is not None:
        from pkm_exact.certify.build import canonical_bytes
        from pkm_exact.certify.mobility_build import mobility_certificate

        arguments.write_output(output, canonical_bytes(mobility_certificate(found)))
    report = mobility_report.linkage_object if as_json else mobility_report.linkage_text
    return report(found), found.finite.is_known


def _of_platform(
    robot: Robot | Mechanism,
    pose: str | None,
    actuated: tuple[str, ...] | None,
    configuration: str | None,
    output: str | None,
    *,
    as_json: bool,
) -> tuple[dict[str, Any] | str, bool]:
    from pkm_exact.cli import platform_mobility_report
    from pkm_exact.mobility.generic_rank import Route
    from pkm_exact.mobility.platform_mobility import platform_mobility

    place = None if pose is None else _pose(robot, pose)
    found = platform_mobility(robot, place, actuated, configuration)
    if output is not None:
        from pkm_exact.certify.build import canonical_bytes
        from pkm_exact.certify.platform_build import platform_certificate

        content = platform_certificate(found, (robot.name, robot.unit, robot.source))
        arguments.write_output(output, canonical_bytes(content))
    report = platform_mobility_report.as_object if as_json else platform_mobility_report.as_text
    return report(robot, found), found.everywhere is None or found.everywhere.route is not Route.NONE


def _pose(robot: Robot | Mechanism, text: str) -> tuple[Vector, Matrix]:
    """The pose that --at denotes, refused unless it is among the motions that the mechanism is capable of."""
    from pkm_exact.geometry.pose_reader import read_pose
    from pkm_exact.geometry.rational import NumberText, parse_rational

    words = [word.strip() for word in text.split(",")]
    count = 3 if robot.motion.is_planar else 7
    if len(words) != count:
        raise InputError(f"--at: {len(words)} numbers given; give {count} between commas")
    numbers: list[Fraction] = [
        parse_rational(word if "/" in word else NumberText(word), f"--at, number {i}")
        for i, word in enumerate(words, 1)
    ]
    if robot.motion.is_planar:
        table: dict[str, object] = {"position": numbers[:2], "half_tangent": numbers[2]}
    else:
        table = {"position": numbers[:3], "quaternion": numbers[3:]}
    return read_pose(table, "--at", robot.motion, robot.metric)

"""What a picture shows: a robot and its certified poses in floating point, in the robot's true shape.

Everything comes from an accepted certificate; floats serve the drawing alone. Joints are turned into ordinary
coordinates, sqrt(g_i) times the rational ones of the metric, so that angles and lengths drawn are those of the robot.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from math import sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify import certified_links
from pkm_exact.errors import InputError
from pkm_exact.geometry.mechanism import Mechanism
from pkm_exact.geometry.nominal_pose import nominal_from_numbers
from pkm_exact.geometry.robot import Robot, jointed
from pkm_exact.pictures.drawn_robot import Point, Scene, view_of
from pkm_exact.wording import printable, shown

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.geometry.robot import Configuration
    from pkm_exact.solution import Solution

_POSES: Final = "pkm_exact certificate"
OF_POSES: Final = (_POSES, "pkm_exact tolerance certificate")
"""Formats of certificates that list poses of a robot."""
DRAWN: Final = (_POSES, certified_links.FORMAT)
"""Those whose poses are drawn."""
LARGEST: Final = 1e100
"""Coordinates beyond this, or robots all of whose coordinates are below its inverse, are not drawn."""
_OUT_OF_RANGE: Final = "robot: its coordinates are too large or too small to be drawn; use another unit of length"


class RejectedError(InputError):
    """A certificate that the checker rejects: nothing in it is proved."""


def accepted_document(path: Path, *, formats: Collection[str] = OF_POSES) -> dict[str, Any]:
    """The content of a certificate file that the checker accepts, of one of these formats.

    Raises
    ------
    RejectedError, InputError
        As ``accepted_with_lines``.
    """
    return accepted_with_lines(path, formats=formats)[0]


def accepted_with_lines(path: Path, *, formats: Collection[str] = OF_POSES) -> tuple[dict[str, Any], tuple[str, ...]]:
    """The content of an accepted certificate file, and what the checker said, line by line.

    Raises
    ------
    RejectedError
        If the checker rejects it.
    InputError
        If it cannot be read or is no certificate, or checking it exceeds a limit.
    """
    from pkm_exact.certify.certificate import content_of
    from pkm_exact.certify.check import Status, check_bytes

    name = printable(str(path))
    data = content_of(path)
    verdict = check_bytes(data)
    if verdict.status == Status.ACCEPTED:
        document = json.loads(data)
        if document["format"] not in formats:
            raise InputError(
                f"{name}: format: {shown(document['format'])} lists no poses of a robot; give a certificate that does, "
                "or ask check what this says"
            )
        return document, verdict.lines
    reason = f"{name}: the certificate is {verdict.status} ({verdict.lines[-1]})"
    remedy = "write one with certify-poses solve MODEL -o CERT.json"
    if verdict.status == Status.REJECTED:
        raise RejectedError(f"{reason}, what it says is not proved; {remedy}")
    raise InputError(f"{reason}; {remedy}")


def scene_of(
    document: Mapping[str, Any], robot: Machine | None = None, near: Sequence[Fraction] | None = None
) -> Scene:
    """The scene of an accepted certificate of poses, of a robot or of a mechanism with passive bodies.

    Parameters
    ----------
    document : mapping
        From ``accepted_document``, or made by ``certify.build.certificate``.
    robot : Machine, optional
        Its model. A certificate knows legs only; the model adds the cranks or slides below the rods, and its limits.
        A mechanism with passive bodies is whole without.
    near : sequence of Fraction, optional
        The pose that is meant, as ``nominal_from_numbers`` takes it; otherwise the nominal one of the model, if it has
        one. The pose nearest to it is marked.

    Raises
    ------
    InputError
        If it is a certificate of tolerances, or not one of the given robot, or its numbers are too large for floats.
    """
    if document.get("format") not in DRAWN:
        raise InputError(
            f"format: {shown(document.get('format'))} has no poses to draw; give the certificate of the nominal poses, "
            "which certify-poses solve writes without --tolerance"
        )
    try:
        scene = _limited(_scene(document, robot), document, robot)
        scene = _with_nearest(scene, document, robot, near)
        scene = replace(scene, cables=robot is not None and robot.cables)
    except OverflowError:
        raise InputError(_OUT_OF_RANGE) from None
    points = [*scene.base, *scene.platform]
    points += [joint for pose in scene.poses for joint in pose.joints]
    if not 1 / LARGEST < max(abs(x) for point in points for x in point) < LARGEST:
        raise InputError(_OUT_OF_RANGE)
    return scene


def _scene(document: Mapping[str, Any], machine: Machine | None) -> Scene:
    from pkm_exact.certify.certified_machine import certified_configuration, certified_problem, is_of_legs
    from pkm_exact.pictures.coordinates import listed_poses, placed_poses
    from pkm_exact.pictures.mechanism_scene import mechanism_scene

    if document["format"] == certified_links.FORMAT:
        from pkm_exact.pictures.links_scene import links_scene

        return links_scene(document)
    problem = certified_problem(document)
    if not is_of_legs(document):
        if isinstance(machine, Robot):
            raise InputError(f"robot: the certificate is not one of a {machine.kind} robot; give its model, or none")
        if machine is not None:
            _require_problem(machine, problem)
        return mechanism_scene(document, problem, machine)
    robot = None if machine is None else jointed(machine, "a certificate of legs")
    legs = problem.distances
    axes = _axes(problem.metric)
    locked = None if robot is None else configuration_of(document, robot)
    base = tuple(_ordinary(leg.base, axes) for leg in legs)
    platform = tuple(_ordinary(leg.platform, axes) for leg in legs)
    knees: tuple[Point, ...] = ()
    if robot is not None and robot.chains and locked is not None:
        base, knees = tuple(_ordinary(joint, axes) for joint in robot.base_joints), base
    places = placed_poses(listed_poses(document), problem)
    return Scene(
        name=str(document["robot"]["name"]),
        configuration=certified_configuration(document),
        kind=robot.kind if robot is not None else _kind(problem),
        unit=str(document["robot"]["unit"]),
        motion=problem.motion,
        claim=document["claim"],
        complex_solutions=document["complex_solutions"],
        base=base,
        platform=platform,
        legs=tuple((i, i) for i in range(len(legs))),
        lengths=tuple(sqrt(leg.length_squared) for leg in legs),
        chains=(_chain(robot),) * len(legs),
        poses=tuple(
            view_of(number, listed, place, platform, knees)
            for number, (listed, place) in enumerate(zip(document["poses"], places, strict=True), 1)
        ),
    )


def _require_problem(machine: Machine, problem: ForwardProblem) -> None:
    """Refuse a model that a certificate is not one of."""
    same = isinstance(machine, Mechanism) and machine.asks(problem)
    if not same:
        raise InputError(
            f"robot: the certificate is not one of the model {shown(machine.name)}, constraints, metric or values "
            "differ; give the model that it was made from, or none"
        )


def _limited(scene: Scene, document: Mapping[str, Any], robot: Machine | None) -> Scene:
    """The scene with what is proved of the limits of a model at every pose."""
    if robot is None or robot.limits is None:
        return scene
    from pkm_exact.certify.certified_machine import certified_problem
    from pkm_exact.poses.limit_checks import in_words, limit_verdicts
    from pkm_exact.poses.pose_spelling import pose_of

    locked = configuration_of(document, robot) if isinstance(robot, Robot) else None
    poses = [pose_of(entry) for entry in document["poses"]]
    verdicts = limit_verdicts(robot, locked, certified_problem(document), poses)
    views = (replace(view, limits=in_words(found)) for view, found in zip(scene.poses, verdicts, strict=True))
    return replace(scene, poses=tuple(views))


def _with_nearest(
    scene: Scene, document: Mapping[str, Any], robot: Machine | None, near: Sequence[Fraction] | None
) -> Scene:
    """The scene with a mark on the pose nearest to the one that is meant; none if the boxes do not tell which."""
    if near is not None and document["format"] == certified_links.FORMAT:
        raise InputError("--near: is for certificates of a robot or mechanism; this one has passive bodies")
    nominal = None if robot is None else robot.nominal
    if near is not None:
        nominal = nominal_from_numbers(near, "--near", scene.motion)
    if nominal is None:
        return scene
    from pkm_exact.poses.nearest_pose import nearest_pose
    from pkm_exact.poses.pose_spelling import pose_of

    poses = [
        replace(pose_of(entry), jacobian=view.jacobian)
        for entry, view in zip(document["poses"], scene.poses, strict=True)
    ]
    found = nearest_pose(poses, nominal)
    if found is None or len(found.numbers) > 1:
        return scene
    views = (replace(view, is_nearest=(view.number,) == found.numbers) for view in scene.poses)
    return replace(scene, poses=tuple(views))


def scene_of_solution(robot: Robot, configuration_name: str | None, solution: Solution) -> Scene:
    """The scene of what ``solve`` found for a robot; the configuration is None if the lengths were given freely.

    Examples
    --------
    >>> from pkm_exact import read_robot, solve
    >>> robot = read_robot("models/3-rpr-merlet-p.toml")
    >>> scene = scene_of_solution(robot, "home", solve(robot.problem(robot.configuration())))
    >>> [(pose.number, pose.det_sign) for pose in scene.poses]
    [(1, -1), (2, 1)]
    """
    from pkm_exact.certify.build import certificate

    return scene_of(certificate(robot, configuration_name, solution), robot)


def _axes(metric: Sequence[int]) -> Point:
    x, y, z = (sqrt(g) for g in metric)
    return x, y, z


def _ordinary(joint: Sequence[Fraction], axes: Point) -> Point:
    x, y, z = (float(value) * axis for value, axis in zip(joint, axes, strict=True))
    return x, y, z


def _kind(problem: ForwardProblem) -> str:
    """The kind of robot whose legs themselves are actuated."""
    return "3-RPR" if problem.motion.is_planar else "6-UPS"


def _chain(robot: Robot | None) -> str:
    from pkm_exact.geometry.chains import Crank

    if robot is None or not robot.chains:
        return ""
    return "crank" if isinstance(robot.chains[0], Crank) else "slide"


def configuration_of(document: Mapping[str, Any], robot: Robot) -> Configuration | None:
    """The robot's configuration that the certificate answers, exactly; None if its lengths were given freely."""
    from pkm_exact.certify.legs_view import legs_view

    document = legs_view(document)
    content, squares = document["robot"], document["configuration"]["lengths_squared"]

    def fits(reduced: Robot, lengths: Sequence[Fraction]) -> bool:
        return bool(
            content["kind"] == reduced.kind
            and content["metric"] == [str(g) for g in reduced.metric]
            and content["base"] == [[str(x) for x in joint] for joint in reduced.base_joints]
            and content["platform"] == [[str(x) for x in joint] for joint in reduced.platform_joints]
            and squares == [str(square) for square in lengths]
        )

    for configuration in robot.configurations:
        if fits(robot.as_gough(configuration), configuration.lengths_squared):
            return configuration
    if robot.chains or not fits(robot, [Fraction(square) for square in squares]):
        raise InputError(
            f"robot: the certificate is not one of the model {shown(robot.name)}, joints, metric, cranks, slides or "
            "lengths differ; give the model that it was made from, or none"
        )
    return None

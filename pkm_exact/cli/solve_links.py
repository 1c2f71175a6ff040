"""The command ``solve`` for mechanisms with passive bodies. Everything heavy is imported inside it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from math import cos, radians, sin, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click
from click.core import ParameterSource

from pkm_exact.cli import arguments
from pkm_exact.cli.program import ExitCode
from pkm_exact.errors import InputError

if TYPE_CHECKING:
    from pkm_exact.constraints.form import Vector
    from pkm_exact.geometry.inverse import Matrix
    from pkm_exact.geometry.links import Links
    from pkm_exact.geometry.mechanism import LockedValues
    from pkm_exact.interactive.progress import Progress
    from pkm_exact.links.link_solution import LinkSolution

_NOT_FOR_LINKS: Final = (
    ("lengths", "--lengths: belongs to robots with legs; give --joints, or name a configuration"),
    ("formulation", "--formulation: a mechanism with passive bodies has one polynomial system; leave it out"),
    ("tolerance", "--tolerance: is for robots with legs; leave it out"),
    ("near", "--near: a mechanism with passive bodies has no nominal pose; leave it out"),
    ("nearest", "--nearest: a mechanism with passive bodies has no nominal pose; leave it out"),
    ("sort", "--sort: poses of a mechanism with passive bodies have one order; leave it out"),
    ("joined", "--joined: is for robots with legs of variable length; leave it out"),
    ("source", "--names-from: is for robots with one platform; leave it out"),
    ("feasible", "--feasible: a mechanism with passive bodies has no limits; leave it out"),
)


@dataclass(frozen=True)
class Request:
    """What the command line asks of a mechanism with passive bodies."""

    model: str
    configuration: str | None
    joints: tuple[arguments.JointWord, ...] | None
    method: str
    start: tuple[float, ...] | None
    width: Fraction
    time_limit: float | None
    output: str | None
    layout: str
    verbose: bool


def solve_links_model(links: Links, asked: Request) -> ExitCode:
    """Solve, print, write the certificate; the exit code."""
    _require_fitting(asked)
    links, chosen = _chosen(links, asked)
    if asked.output is not None:
        arguments.require_other_file(Path(asked.output), asked.model, "-o")
        arguments.require_writable(Path(asked.output), "-o")
    from pkm_exact.cli.links_report import report_links
    from pkm_exact.interactive.progress import Progress

    with Progress(verbose=asked.verbose) as progress:
        try:
            solution = _solved(links, chosen, asked, progress)
        except InputError as error:
            raise InputError(f"{asked.model}: {error}") from None
    if asked.output is not None:
        from pkm_exact.certify.links_build import links_certificate_bytes

        arguments.write_output(asked.output, links_certificate_bytes(solution))
    report_links(solution, asked.layout, verbose=asked.verbose)
    return ExitCode.DONE if solution.is_complete else ExitCode.WEAKER_CLAIM


def _solved(links: Links, chosen: LockedValues, asked: Request, progress: Progress) -> LinkSolution:
    """All poses, or the one near the start."""
    if asked.method == "krawczyk":
        from pkm_exact.links.start_box import solve_from_start

        if asked.start is not None:
            links = links.with_start(_start_pose(links, asked.start))
        return solve_from_start(links, chosen, width=asked.width, progress=progress)
    from pkm_exact.links.link_engine import solve_links

    if asked.time_limit is None:
        return solve_links(links, chosen, width=asked.width, progress=progress)
    from pkm_exact.interactive.limited_solve import solve_within_limits

    solver = partial(solve_within_limits, seconds=asked.time_limit, megabytes=None)
    return solve_links(links, chosen, width=asked.width, progress=progress, solver=solver)


def _start_pose(links: Links, numbers: tuple[float, ...]) -> tuple[Vector, Matrix]:
    """Where the platform starts, as --start says: rational numbers near what is written."""
    from pkm_exact.geometry.inverse import UNIT_METRIC, rotation_of

    g = links.declared.metric
    wanted = 3 if links.is_planar else 7
    if len(numbers) != wanted:
        what = "planar; give X,Y,DEGREES" if links.is_planar else "not planar; give X,Y,Z,Q0,Q1,Q2,Q3"
        raise InputError(f"--start: {len(numbers)} numbers, but the mechanism is {what}")
    if links.is_planar:
        half = radians(numbers[2] % 360) / 2
        numbers = (*numbers[:2], 0.0, cos(half), 0.0, 0.0, sin(half))
    x, y, z, q0, q1, q2, q3 = map(Fraction, numbers)
    if not any((q0, q1, q2, q3)):
        raise InputError("--start: all four numbers of the quaternion are 0; give one that is not")
    turned = rotation_of((q0, q1, q2, q3), UNIT_METRIC)
    if g == UNIT_METRIC:
        return (x, y, z), turned
    # Given in ordinary coordinates, looked for in those of the file: only near, as it is a start.
    u, v, w = (Fraction(float(value) / sqrt(weight)) for value, weight in zip((x, y, z), g, strict=True))
    first, second, third = (
        tuple(Fraction(float(turned[i][j]) * sqrt(g[j] / g[i])) for j in range(3)) for i in range(3)
    )
    return (u, v, w), (first, second, third)  # type: ignore[return-value]


def _require_fitting(asked: Request) -> None:
    """Refuse an option that means nothing for mechanisms with passive bodies."""
    context = click.get_current_context()
    for name, sentence in _NOT_FOR_LINKS:
        if context.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise InputError(f"{asked.model}: {sentence}")
    if asked.layout not in ("table", "json"):
        raise InputError(
            f"{asked.model}: --format {asked.layout}: has no place for several bodies; choose table or json"
        )
    newton = "--method newton: is not for mechanisms with passive bodies; choose exact or krawczyk"
    for is_wrong, what in (
        (asked.method == "newton", newton),
        (asked.method == "exact" and asked.start is not None, "--start: belongs to the method krawczyk; leave it out"),
        (asked.method == "krawczyk" and asked.time_limit is not None, "--time-limit: belongs to the method exact"),
    ):
        if is_wrong:
            raise InputError(f"{asked.model}: {what}")


def _chosen(links: Links, asked: Request) -> tuple[Links, LockedValues]:
    try:
        if asked.joints is None:
            return links, links.configuration(asked.configuration)
        from pkm_exact.cli.joint_words import say_joint_notes
        from pkm_exact.geometry.given_joints import joint_configuration

        declared, name = joint_configuration(links.declared, asked.joints, "--joints")
        say_joint_notes(declared, name)
        return links, declared.configuration(name)
    except InputError as error:
        raise InputError(f"{asked.model}: {error}") from None

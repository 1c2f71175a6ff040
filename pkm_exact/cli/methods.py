"""The methods of ``solve``: which options belong to which, and how each is run. Heavy imports are inside functions."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from math import cos, radians, sin
from typing import TYPE_CHECKING, Final

import click
from click.core import ParameterSource

from pkm_exact.cli.program import PROGRAM, ExitCode
from pkm_exact.errors import InputError
from pkm_exact.motions.motion import Motion
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.geometry.machine import Machine
    from pkm_exact.geometry.problem import ForwardProblem
    from pkm_exact.numeric.numeric_machine import StartPose
    from pkm_exact.numeric.uncertified import UncertifiedSolution
    from pkm_exact.solution import Solution

METHODS: Final = ("exact", "krawczyk", "newton")

_MISFITS: Final = (
    ("formulation", ("krawczyk", "newton"), "--formulation: belongs to the method exact"),
    ("start", ("exact", "krawczyk"), "--start: belongs to the method newton"),
    ("width", ("newton",), "--width: a pose of the method newton is a point and has no box"),
    ("time_limit", ("newton",), "--time-limit: belongs to the methods exact and krawczyk; newton ends by itself"),
    ("output", ("newton",), "-o: a pose of the method newton is uncertified and has no certificate"),
)


def require_fitting(context: click.Context, method: str) -> None:
    """Refuse an option that was given and means nothing for the method."""
    for name, methods, sentence in _MISFITS:
        if method in methods and context.get_parameter_source(name) is not ParameterSource.DEFAULT:
            raise click.UsageError(f"{sentence}; leave it out or choose another method.", context)


def solved(
    problem: ForwardProblem,
    method: str,
    formulation: str,
    start: tuple[float, ...] | None,
    width: Fraction,
    time_limit: float | None,
    progress: Callable[[str], None],
) -> Solution | UncertifiedSolution:
    """The solution by a method; or what takes the place of a certified one when its time is over."""
    if method == "newton":
        return solved_by_newton(problem, start)
    engine: Callable[..., Solution]
    if method == "krawczyk":
        from pkm_exact.numeric_engine import solve_krawczyk

        engine = partial(solve_krawczyk, width=width)
    else:
        from pkm_exact.engine import solve

        engine = partial(solve, formulation=formulation, width=width)
    if time_limit is None:
        return engine(problem, progress=progress)
    from pkm_exact.numeric.fallback import solve_within

    return solve_within(engine, problem, time_limit, progress=progress)


def solved_by_newton(problem: ForwardProblem, start: tuple[float, ...] | None) -> UncertifiedSolution:
    """The pose to which Newton's method converges.

    Raises
    ------
    InputError
        If the start does not fit the robot.
    NotConvergedError
        If the method does not converge.
    """
    from pkm_exact.numeric.newton_iteration import solve_newton

    return solve_newton(problem, None if start is None else _start_pose(start, problem.motion))


def _start_pose(values: tuple[float, ...], motion: Motion) -> StartPose:
    from pkm_exact.numeric.numeric_machine import StartPose

    if motion.is_planar and len(values) == 3:
        x, y, angle = values
        half = radians(angle % 360) / 2
        return StartPose((x, y, 0.0), (cos(half), 0.0, 0.0, sin(half)))
    if not motion.is_planar and len(values) == 7:
        x, y, z, *quaternion = values
        q0, q1, q2, q3 = quaternion
        return StartPose((x, y, z), (q0, q1, q2, q3))
    planar, others = "planar; give X,Y,DEGREES", "not planar; give X,Y,Z,Q0,Q1,Q2,Q3"
    wanted = f"the robot is {planar if motion.is_planar else others}"
    raise InputError(f"--start: {len(values)} numbers, but {wanted}")


def report_uncertified(
    robot: Machine, name: str | None, solution: UncertifiedSolution, layout: str, output: str | None, *, verbose: bool
) -> ExitCode:
    """Print a solution without a certificate; say on stderr that none was written, if one was asked for."""
    from pkm_exact.cli.numeric_report import report

    if output is not None:
        click.echo(f"{PROGRAM}: no certificate written to {printable(output)}: the poses are uncertified", err=True)
    report(robot, name, solution, layout, verbose=verbose)
    return ExitCode.WEAKER_CLAIM
